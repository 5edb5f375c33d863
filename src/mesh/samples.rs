//! Surfaces, and points that stand for them where distances are measured.

use super::NodeId;
use crate::geometry::{CutQuad, Facet, NearestFacet, Point};
use crate::{Cancelled, Monitor};

/// A surface of triangles.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// Points, of which triangles need not use all.
    pub positions: &'a [Point],
    /// The corners of each triangle, as numbers of positions.
    pub triangles: &'a [[u32; 3]],
}

/// A surface of quads, each cut in two along either diagonal: the farther cut counts.
#[derive(Clone, Copy, Debug)]
pub struct Quads<'a> {
    /// Points, of which quads need not use all.
    pub positions: &'a [Point],
    /// The corners of each quad, in order.
    pub quads: &'a [[NodeId; 4]],
}

/// Samples of a side are so many mean sides of the mesh from each other at most. Faces with a side longer than the second are cut
/// into pieces, each with a sample.
const STEP: f64 = 0.3;
const PIECE: f64 = 1.2;

/// Samples of a surface so large that it has more with such steps are farther from each other.
const MOST: f64 = 4e6;

/// The share of the work that the sides are.
const SIDES: f64 = 0.6;

/// Samples that are given at once.
const BATCH: usize = 1 << 14;

/// A surface that is sampled, and searched for what is nearest to samples of another one.
pub(crate) trait Sampled: Copy {
    /// A face by its corners' places among the positions.
    type Places: Facet<Shared = Vec<Point>> + Sync;
    /// A face by its corners.
    type Facet: AsRef<[Point]>;
    /// Those of a face.
    type Middles: IntoIterator<Item = Point>;
    /// Those of a face.
    type Triangles: IntoIterator<Item = [Point; 3]>;

    /// What its faces are between.
    fn positions(&self) -> &[Point];

    /// The two nodes of each side, in the order of the faces.
    fn sides(&self) -> impl Iterator<Item = [u32; 2]>;

    /// The faces by the places of their corners.
    fn places(&self) -> impl Iterator<Item = Self::Places>;

    /// The same by their corners.
    fn facets(&self) -> impl Iterator<Item = Self::Facet>;

    /// The middles of a face, which are sampled however small it is.
    fn middles(facet: &Self::Facet) -> Self::Middles;

    /// The triangles that it may be cut into.
    fn triangles(facet: &Self::Facet) -> Self::Triangles;

    /// Finds the face that is nearest to a point.
    fn search(&self, monitor: &dyn Monitor) -> Result<NearestFacet<Self::Places>, Cancelled> {
        NearestFacet::sharing(self.positions().to_vec(), self.places(), monitor)
    }

    /// The mean length of the sides of the faces.
    fn mean_side(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for length in self.sides().map(|side| length(self.positions(), side)) {
            (sum, count) = (sum + length, count + 1);
        }
        sum / f64::from(count.max(1))
    }

    /// Gives the nodes in use, points of the sides, the middles of the faces, and the centroids of the pieces of large ones, for a
    /// mesh with sides of about this length, some at a time, with the share of the surface that is sampled then.
    fn sample(
        &self,
        edge: f64,
        monitor: &dyn Monitor,
        take: &mut dyn FnMut(&[Point], f64),
    ) -> Result<(), Cancelled> {
        let positions = self.positions();
        let edge = edge.max(self.least_edge());
        let mut giving = Giving { batch: Vec::with_capacity(BATCH), done: 0.0, take, monitor };
        let mut used = vec![false; positions.len()];
        self.sides().for_each(|[node, _]| used[node as usize] = true);
        giving.all(positions.iter().zip(used).filter(|(_, used)| *used).map(|(p, _)| *p))?;
        let long = self.sides().filter(|&side| length(positions, side) > STEP * edge);
        let long = once(long.map(|[a, b]| [NodeId(a.min(b)), NodeId(a.max(b))]).collect());
        let count = long.len().max(1) as f64;
        for (k, side) in long.into_iter().enumerate() {
            giving.done = SIDES * k as f64 / count;
            let [a, b] = side.map(|n| positions[n.index()]);
            let steps = (a.distance(b) / (STEP * edge)).ceil() as u32;
            giving.all((1..steps).map(|k| a.lerp(b, f64::from(k) / f64::from(steps))))?;
        }
        let mut pieces: Vec<[Point; 3]> = Vec::new();
        let count = self.facets().count() as f64;
        for (k, facet) in self.facets().enumerate() {
            giving.done = SIDES + (1.0 - SIDES) * k as f64 / count;
            giving.all(Self::middles(&facet))?;
            if longest(facet.as_ref()) > PIECE * edge {
                pieces.extend(Self::triangles(&facet));
            }
            while let Some(piece) = pieces.pop() {
                match halved(piece, PIECE * edge) {
                    Some(halves) => pieces.extend(halves),
                    None => giving.all([centroid(piece)])?,
                }
            }
        }
        giving.flush()
    }

    /// Such that there are not too many samples.
    fn least_edge(&self) -> f64 {
        let around: f64 = self.sides().map(|side| length(self.positions(), side)).sum();
        let triangles = self.facets().flat_map(|facet| Self::triangles(&facet));
        let area: f64 = triangles.map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum();
        (around / MOST).max((area / MOST).sqrt())
    }
}

/// Samples on their way.
struct Giving<'a> {
    batch: Vec<Point>,
    /// The share of the surface that is sampled.
    done: f64,
    take: &'a mut dyn FnMut(&[Point], f64),
    monitor: &'a dyn Monitor,
}

impl Giving<'_> {
    fn all(&mut self, samples: impl IntoIterator<Item = Point>) -> Result<(), Cancelled> {
        for sample in samples {
            self.batch.push(sample);
            if self.batch.len() == BATCH {
                self.flush()?;
            }
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<(), Cancelled> {
        self.monitor.proceed()?;
        (self.take)(&self.batch, self.done);
        self.batch.clear();
        Ok(())
    }
}

/// Sides, which are told by their two nodes, the lesser first, without those that were there before.
fn once(mut sides: Vec<[NodeId; 2]>) -> Vec<[NodeId; 2]> {
    sides.sort_unstable();
    sides.dedup();
    sides
}

impl Sampled for Triangles<'_> {
    type Places = [u32; 3];
    type Facet = [Point; 3];
    type Middles = [Point; 1];
    type Triangles = [[Point; 3]; 1];

    fn positions(&self) -> &[Point] {
        self.positions
    }

    fn sides(&self) -> impl Iterator<Item = [u32; 2]> {
        self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
    }

    fn places(&self) -> impl Iterator<Item = [u32; 3]> {
        self.triangles.iter().copied()
    }

    fn facets(&self) -> impl Iterator<Item = [Point; 3]> {
        self.triangles.iter().map(|t| t.map(|n| self.positions[n as usize]))
    }

    fn middles(facet: &[Point; 3]) -> [Point; 1] {
        [centroid(*facet)]
    }

    fn triangles(facet: &[Point; 3]) -> [[Point; 3]; 1] {
        [*facet]
    }
}

impl Sampled for Quads<'_> {
    type Places = [u32; 4];
    type Facet = CutQuad;
    type Middles = [Point; 2];
    type Triangles = [[Point; 3]; 4];

    fn positions(&self) -> &[Point] {
        self.positions
    }

    fn sides(&self) -> impl Iterator<Item = [u32; 2]> {
        self.quads.iter().flat_map(|quad| (0..4).map(|k| [quad[k].0, quad[(k + 1) % 4].0]))
    }

    fn places(&self) -> impl Iterator<Item = [u32; 4]> {
        self.quads.iter().map(|quad| quad.map(|n| n.0))
    }

    fn facets(&self) -> impl Iterator<Item = CutQuad> {
        self.quads.iter().map(|quad| CutQuad(quad.map(|n| self.positions[n.index()])))
    }

    fn middles(facet: &CutQuad) -> [Point; 2] {
        facet.middles()
    }

    fn triangles(facet: &CutQuad) -> [[Point; 3]; 4] {
        facet.triangles()
    }
}

fn centroid([a, b, c]: [Point; 3]) -> Point {
    (a + b + c) / 3.0
}

/// How long a side is.
fn length(positions: &[Point], side: [u32; 2]) -> f64 {
    let [a, b] = side.map(|n| positions[n as usize]);
    a.distance(b)
}

/// The length of the longest side of a face with these corners.
fn longest(corners: &[Point]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.distance_squared(*b)).fold(0.0, f64::max).sqrt()
}

/// A triangle cut in two across its longest side, if that is longer than this.
fn halved([a, b, c]: [Point; 3], length: f64) -> Option<[[Point; 3]; 2]> {
    let sides = [[a, b, c], [b, c, a], [c, a, b]];
    let squared = |[a, b, _]: &[Point; 3]| a.distance_squared(*b);
    let [a, b, c] = sides.into_iter().max_by(|s, t| squared(s).total_cmp(&squared(t)))?;
    let middle = a.midpoint(b);
    (a.distance_squared(b) > length * length).then_some([[a, middle, c], [middle, b, c]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;

    /// All at once.
    fn samples(surface: impl Sampled, edge: f64) -> Vec<Point> {
        let mut samples = Vec::new();
        surface.sample(edge, &Silent, &mut |batch, _| samples.extend(batch)).unwrap();
        samples
    }

    const SQUARE: [Point; 5] = [
        Point::new(0.0, 0.0, 0.0),
        Point::new(4.0, 0.0, 0.0),
        Point::new(4.0, 4.0, 0.0),
        Point::new(0.0, 4.0, 0.0),
        Point::new(9.0, 9.0, 9.0),
    ];

    fn square() -> Triangles<'static> {
        Triangles { positions: &SQUARE, triangles: &[[0, 1, 2], [0, 2, 3]] }
    }

    #[test]
    fn small_faces_have_samples_at_nodes_and_centroids_alone() {
        let samples = samples(square(), 20.0);
        let [a, b, c, d, _] = SQUARE;
        assert_eq!(samples, [a, b, c, d, (a + b + c) / 3.0, (a + c + d) / 3.0]);
    }

    /// From any place of a face the nearest sample is within an edge, also in a needle, and there are not many more than that
    /// takes.
    #[test]
    fn no_place_is_far_from_a_sample() {
        let needle =
            Triangles { triangles: &[[0, 1, 2]], positions: &[SQUARE[0], SQUARE[1], SQUARE[1] * 0.5] };
        let quads = [[0, 1, 2, 3].map(NodeId)];
        let quad = Quads { positions: &SQUARE, quads: &quads };
        for edge in [0.1, 0.3, 1.0] {
            let [square, needle, quad] =
                [samples(square(), edge), samples(needle, edge), samples(quad, edge)];
            for k in 0..1000 {
                let p = Point::new(f64::from(k % 37) / 9.0, f64::from(k % 41) / 10.0, 0.0);
                for (samples, p) in [(&square, p), (&quad, p), (&needle, p.with_y(0.0))] {
                    let nearest = samples.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
                    assert!(nearest <= edge, "{nearest} from {p} with edges of {edge}");
                }
            }
            assert!(
                (square.len() as f64) < 25.0 + 80.0 / edge + 6.0 * 16.0 / (edge * edge),
                "{} {edge}",
                square.len()
            );
            assert!((needle.len() as f64) < 25.0 + 80.0 / edge, "{} {edge}", needle.len());
        }
    }

    #[test]
    fn sides_are_sampled_once() {
        let samples = samples(square(), 2.0);
        let diagonal = samples.iter().filter(|p| p.x == p.y && p.x > 0.0 && p.x < 4.0).count();
        assert_eq!(diagonal, (32_f64.sqrt() / (STEP * 2.0)).ceil() as usize - 1);
        let mut places: Vec<_> = samples.iter().map(|p| p.to_array().map(f64::to_bits)).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), samples.len());
    }

    #[test]
    fn a_quad_has_a_sample_in_the_middle_of_each_diagonal() {
        let mut positions = SQUARE;
        positions[2].z = 4.0;
        let quads = [[0, 1, 2, 3].map(NodeId)];
        let quad = Quads { positions: &positions, quads: &quads };
        let middles = [0.0, 2.0].map(|z| Point::new(2.0, 2.0, z));
        let samples = samples(quad, 20.0);
        assert!(samples.len() == 6 && middles.iter().all(|middle| samples.contains(middle)), "{samples:?}");
        assert_eq!(quad.mean_side(), (8.0 + 2.0 * 32_f64.sqrt()) / 4.0);
    }

    /// However small the mesh is beside the surface.
    #[test]
    fn there_are_not_too_many_samples() {
        let most = 40.0 * MOST;
        assert!(square().least_edge() > 0.0);
        for edge in [0.0, 1e-12] {
            let edge = f64::max(edge, square().least_edge());
            let area = 16.0 / (edge * edge);
            assert!(area <= most && 24.0 / edge <= most, "{edge}");
        }
        let point = Triangles { positions: &[Point::ZERO], triangles: &[[0, 0, 0]] };
        assert_eq!(samples(point, 0.0), [Point::ZERO; 2]);
    }
}
