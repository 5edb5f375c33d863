//! Surfaces, and points that stand for them where distances are measured.

use super::NodeId;
use crate::geometry::{Facet, Point, QuadPatch};
use crate::{Cancelled, Monitor};

/// A surface of triangles.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// Points, of which triangles need not use all.
    pub positions: &'a [Point],
    /// The corners of each triangle, as numbers of positions.
    pub triangles: &'a [[u32; 3]],
}

/// A surface of quads, each four triangles around the mean of its corners.
#[derive(Clone, Copy, Debug)]
pub struct Quads<'a> {
    /// Points, of which quads need not use all.
    pub positions: &'a [Point],
    /// The corners of each quad, in order.
    pub quads: &'a [[NodeId; 4]],
}

/// Sides have a sample each so many sides of the mesh, and triangles with longer sides than the second are cut into pieces,
/// each with a sample.
const STEP: f64 = 0.6;
const PIECE: f64 = 1.2;

/// Samples of a surface so large that it has more with such steps are farther from each other.
const MOST: f64 = 4e6;

/// Samples between two questions to the monitor.
const BATCH: usize = 1 << 14;

/// A surface that is sampled, and searched for what is nearest to samples of another one.
pub(crate) trait Sampled: Copy {
    type Facet: Facet + Copy + Send + Sync;

    /// Some triangles.
    type Triangles: AsRef<[[Point; 3]]> + IntoIterator<Item = [Point; 3]>;

    /// What its faces are between.
    fn positions(&self) -> &[Point];

    /// The two nodes of each side, in the order of the faces.
    fn sides(&self) -> impl Iterator<Item = [u32; 2]>;

    /// The faces.
    fn facets(&self) -> impl Iterator<Item = Self::Facet>;

    /// The middle of a face, and the triangles that it is taken for.
    fn parts(facet: Self::Facet) -> (Point, Self::Triangles);

    /// The mean length of the sides of the faces.
    fn mean_side(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for length in self.sides().map(|side| length(self.positions(), side)) {
            (sum, count) = (sum + length, count + 1);
        }
        sum / f64::from(count.max(1))
    }

    /// The nodes in use, points of the sides, and the middles of the faces or the centroids of their pieces, for a mesh with sides
    /// of about this length.
    fn samples(&self, edge: f64, monitor: &dyn Monitor) -> Result<Vec<Point>, Cancelled> {
        let positions = self.positions();
        let edge = edge.max(self.least_edge());
        let mut used = vec![false; positions.len()];
        self.sides().for_each(|[node, _]| used[node as usize] = true);
        let nodes = positions.iter().zip(used).filter(|(_, used)| *used).map(|(p, _)| *p);
        let mut taken = Taken { samples: nodes.collect(), edge, pieces: Vec::new() };
        let long = self.sides().filter(|&side| length(positions, side) > STEP * edge);
        taken.along(positions, long.map(|[a, b]| [NodeId(a.min(b)), NodeId(a.max(b))]).collect());
        for facet in self.facets() {
            let (middle, triangles) = Self::parts(facet);
            taken.within(middle, triangles.as_ref(), monitor)?;
        }
        Ok(taken.samples)
    }

    /// Such that there are not too many samples.
    fn least_edge(&self) -> f64 {
        let around: f64 = self.sides().map(|side| length(self.positions(), side)).sum();
        let triangles = self.facets().flat_map(|facet| Self::parts(facet).1);
        let area: f64 = triangles.map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum();
        (around / MOST).max((area / MOST).sqrt())
    }
}

/// The samples that were taken.
struct Taken {
    samples: Vec<Point>,
    edge: f64,
    /// Of a face that is being cut.
    pieces: Vec<[Point; 3]>,
}

impl Taken {
    /// Points of sides, which are told by their two nodes, the lesser first; of one that is told twice once.
    fn along(&mut self, positions: &[Point], mut sides: Vec<[NodeId; 2]>) {
        sides.sort_unstable();
        sides.dedup();
        for side in sides {
            let [a, b] = side.map(|n| positions[n.index()]);
            let steps = (a.distance(b) / (STEP * self.edge)).ceil() as u32;
            self.samples.extend((1..steps).map(|k| a.lerp(b, f64::from(k) / f64::from(steps))));
        }
    }

    /// The middle of a face, or the centroids of its pieces if it is large.
    fn within(
        &mut self,
        middle: Point,
        triangles: &[[Point; 3]],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        if triangles.iter().all(|&t| halved(t, PIECE * self.edge).is_none()) {
            self.samples.push(middle);
            return Ok(());
        }
        self.pieces.extend(triangles);
        while let Some(piece) = self.pieces.pop() {
            match halved(piece, PIECE * self.edge) {
                Some(halves) => self.pieces.extend(halves),
                None => self.samples.push(centroid(piece)),
            }
            if self.samples.len().is_multiple_of(BATCH) {
                monitor.proceed()?;
            }
        }
        Ok(())
    }
}

impl Sampled for Triangles<'_> {
    type Facet = [Point; 3];
    type Triangles = [[Point; 3]; 1];

    fn positions(&self) -> &[Point] {
        self.positions
    }

    fn sides(&self) -> impl Iterator<Item = [u32; 2]> {
        self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
    }

    fn facets(&self) -> impl Iterator<Item = [Point; 3]> {
        self.triangles.iter().map(|t| t.map(|n| self.positions[n as usize]))
    }

    fn parts(facet: [Point; 3]) -> (Point, Self::Triangles) {
        (centroid(facet), [facet])
    }
}

impl Sampled for Quads<'_> {
    type Facet = QuadPatch;
    type Triangles = [[Point; 3]; 4];

    fn positions(&self) -> &[Point] {
        self.positions
    }

    fn sides(&self) -> impl Iterator<Item = [u32; 2]> {
        self.quads.iter().flat_map(|quad| (0..4).map(|k| [quad[k].0, quad[(k + 1) % 4].0]))
    }

    fn facets(&self) -> impl Iterator<Item = QuadPatch> {
        self.quads.iter().map(|quad| QuadPatch(quad.map(|n| self.positions[n.index()])))
    }

    fn parts(facet: QuadPatch) -> (Point, Self::Triangles) {
        (facet.middle(), facet.triangles())
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
        let samples = square().samples(10.0, &Silent).unwrap();
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
            let samples =
                [square().samples(edge, &Silent), needle.samples(edge, &Silent), quad.samples(edge, &Silent)];
            let [square, needle, quad] = samples.map(Result::unwrap);
            for k in 0..1000 {
                let p = Point::new(f64::from(k % 37) / 9.0, f64::from(k % 41) / 10.0, 0.0);
                for (samples, p) in [(&square, p), (&quad, p), (&needle, p.with_y(0.0))] {
                    let nearest = samples.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
                    assert!(nearest <= edge, "{nearest} from {p} with edges of {edge}");
                }
            }
            assert!((square.len() as f64) < 25.0 + 6.0 * 16.0 / (edge * edge), "{} {edge}", square.len());
            assert!((needle.len() as f64) < 25.0 + 80.0 / edge, "{} {edge}", needle.len());
        }
    }

    #[test]
    fn sides_are_sampled_once() {
        let samples = square().samples(2.0, &Silent).unwrap();
        let diagonal = samples.iter().filter(|p| p.x == p.y && p.x > 0.0 && p.x < 4.0).count();
        assert_eq!(diagonal, (32_f64.sqrt() / (STEP * 2.0)).ceil() as usize - 1);
        let mut places: Vec<_> = samples.iter().map(|p| p.to_array().map(f64::to_bits)).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), samples.len());
    }

    #[test]
    fn a_quad_has_a_sample_in_its_middle() {
        let mut positions = SQUARE;
        positions[2].z = 4.0;
        let quads = [[0, 1, 2, 3].map(NodeId)];
        let quad = Quads { positions: &positions, quads: &quads };
        assert!(quad.samples(10.0, &Silent).unwrap().contains(&Point::new(2.0, 2.0, 1.0)));
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
        assert_eq!(point.samples(0.0, &Silent).unwrap(), [Point::ZERO; 2]);
    }
}
