//! How much the input surface turns.

use rayon::prelude::*;

use crate::geometry::Point;
use crate::mesh::topology::EdgeUses;
use crate::mesh::{EdgeId, Edges, PolygonMesh};

/// Where the normals of two neighbours differ by more degrees than this, the edge between them is a
/// feature of the model, not a coarse picture of something round: no refinement makes it smoother. A
/// circle drawn with six sides turns 60 degrees an edge.
const FEATURE: f64 = 60.0;

/// For each face how far the surface's normal turns along it, in degrees per unit of length: the most of
///
/// - across each edge to one neighbour, the angle between the two faces' normals over the distance
///   between their centres, measured through the edge;
/// - along each edge, the angle between the normals at its ends over its length, where the normal at a
///   node is the mean, by area, of the faces around it that are smooth with this face.
///
/// Edges of one face, and those where three or more meet, turn nothing; nor do edges sharper than 60
/// degrees. Flat parts give 0. The faces' orientations need not agree.
pub(super) fn turn_per_length(mesh: &PolygonMesh) -> Vec<f64> {
    let surface = Surface::new(mesh);
    (0..mesh.face_count()).into_par_iter().map(|f| surface.across(f).max(surface.along(f))).collect()
}

struct Surface<'a> {
    mesh: &'a PolygonMesh,
    edges: Edges,
    uses: EdgeUses,
    face_of_corner: Vec<u32>,
    /// Vector areas: normals, as long as the faces are large.
    areas: Vec<Point>,
    centers: Vec<Point>,
    /// Where each node's faces start in `faces_at`.
    offsets: Vec<u32>,
    faces_at: Vec<u32>,
}

impl<'a> Surface<'a> {
    fn new(mesh: &'a PolygonMesh) -> Self {
        let edges = Edges::of_polygons(mesh);
        let sizes = mesh.faces().map(<[_]>::len).enumerate();
        let face_of_corner: Vec<u32> = sizes.flat_map(|(f, n)| std::iter::repeat_n(f as u32, n)).collect();
        let (offsets, faces_at) = faces_at_nodes(mesh, &face_of_corner);
        Self {
            mesh,
            uses: EdgeUses::of(&edges),
            edges,
            face_of_corner,
            areas: (0..mesh.face_count()).map(|f| vector_area(mesh, f)).collect(),
            centers: (0..mesh.face_count()).map(|f| center(mesh, f)).collect(),
            offsets,
            faces_at,
        }
    }

    fn position(&self, corner: usize) -> Point {
        self.mesh.positions[self.mesh.corners[corner].index()]
    }

    fn corners(&self, f: usize) -> std::ops::Range<usize> {
        self.mesh.offsets[f] as usize..self.mesh.offsets[f + 1] as usize
    }

    /// The vector area of face `g`, turned to the side of face `f`, if the two are smooth.
    fn smooth_with(&self, f: usize, g: usize) -> Option<Point> {
        let area = self.areas[g] * 1f64.copysign(self.areas[f].dot(self.areas[g]));
        (angle(self.areas[f], area) <= FEATURE).then_some(area)
    }

    /// The most that the normal turns from `f` to a neighbour.
    fn across(&self, f: usize) -> f64 {
        let turns = self.corners(f).map(|k| self.across_edge(f, self.edges.of_corner[k]));
        turns.fold(0.0, f64::max)
    }

    fn across_edge(&self, f: usize, e: EdgeId) -> f64 {
        let &[k, l] = self.uses.at(e) else { return 0.0 };
        let [g, h] = [k, l].map(|k| self.face_of_corner[k as usize] as usize);
        let neighbour = if g == f { h } else { g };
        let Some(area) = self.smooth_with(f, neighbour) else { return 0.0 };
        let [a, b] = self.edges.ends[e.index()].map(|n| self.mesh.positions[n.index()]);
        let along = (b - a).normalize_or_zero();
        let from_edge = |g: usize| (self.centers[g] - a).reject_from_normalized(along).length();
        rate(angle(self.areas[f], area), from_edge(f) + from_edge(neighbour))
    }

    /// The most that the nodes' normals turn along an edge of `f`.
    fn along(&self, f: usize) -> f64 {
        let corners = self.corners(f);
        let normal = |k: usize| self.normal_at(f, self.mesh.corners[k].index());
        let last = corners.end - 1;
        let (mut before, mut most) = ((normal(last), self.position(last)), 0.0);
        for k in corners {
            let here = (normal(k), self.position(k));
            most = f64::max(most, rate(angle(before.0, here.0), before.1.distance(here.1)));
            before = here;
        }
        most
    }

    /// The normal at a node as face `f` sees it, of any length.
    fn normal_at(&self, f: usize, node: usize) -> Point {
        let faces = &self.faces_at[self.offsets[node] as usize..self.offsets[node + 1] as usize];
        faces.iter().filter_map(|&g| self.smooth_with(f, g as usize)).sum()
    }
}

fn rate(degrees: f64, length: f64) -> f64 {
    if length > 0.0 { degrees / length } else { 0.0 }
}

/// The angle between two vectors in degrees; 0 if one of them is zero.
fn angle(a: Point, b: Point) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees()
}

fn vector_area(mesh: &PolygonMesh, f: usize) -> Point {
    let face = mesh.face(f);
    let at = |i: usize| mesh.positions[face[i].index()] - mesh.positions[face[0].index()];
    (1..face.len().saturating_sub(1)).map(|i| at(i).cross(at(i + 1)) * 0.5).sum()
}

fn center(mesh: &PolygonMesh, f: usize) -> Point {
    let face = mesh.face(f);
    face.iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / face.len() as f64
}

/// For each node the faces around it, by a counting sort: offsets and faces.
fn faces_at_nodes(mesh: &PolygonMesh, face_of_corner: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut offsets = vec![0u32; mesh.positions.len() + 1];
    for n in &mesh.corners {
        offsets[n.index()] += 1;
    }
    let mut end = 0;
    for count in &mut offsets {
        end += *count;
        *count = end;
    }
    let mut faces = vec![0u32; mesh.corners.len()];
    for (n, &f) in mesh.corners.iter().zip(face_of_corner).rev() {
        offsets[n.index()] -= 1;
        faces[offsets[n.index()] as usize] = f;
    }
    (offsets, faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::NodeId;

    fn mesh(positions: Vec<Point>, faces: impl IntoIterator<Item = [u32; 4]>) -> PolygonMesh {
        let mut mesh = PolygonMesh { positions, ..Default::default() };
        faces.into_iter().for_each(|f| mesh.push_face(f.map(NodeId)));
        mesh
    }

    /// The side of a prism of `n` sides, `rings` high, around a circle of the given radius.
    fn tube(n: u32, rings: u32, radius: f64) -> PolygonMesh {
        let at = |i: u32| f64::from(i) * std::f64::consts::TAU / f64::from(n);
        let points = (0..=rings).flat_map(|j| {
            (0..n)
                .map(move |i| Point::new(radius * libm::cos(at(i)), radius * libm::sin(at(i)), f64::from(j)))
        });
        let quads = (0..rings)
            .flat_map(|j| (0..n).map(move |i| [i, (i + 1) % n].map(|i| j * n + i)))
            .map(|[a, b]| [a, b, b + n, a + n]);
        mesh(points.collect(), quads)
    }

    #[test]
    fn a_tube_turns_by_its_radius() {
        for (n, radius) in [(8, 1.0), (36, 2.5)] {
            let side = 2.0 * radius * libm::sin(std::f64::consts::PI / f64::from(n));
            let expected = 360.0 / f64::from(n) / side;
            for turn in turn_per_length(&tube(n, 3, radius)) {
                assert!((turn - expected).abs() < 1e-9 * expected, "{turn} is not {expected}");
            }
        }
    }

    #[test]
    fn flat_parts_boundaries_and_features_turn_nothing() {
        assert!(turn_per_length(&tube(4, 2, 1.0)).iter().all(|&t| t == 0.0), "edges of 90 degrees");
        let grid = |i: u32| Point::new(f64::from(i % 4), f64::from(i / 4), 0.0);
        let flat = mesh(
            (0..12).map(grid).collect(),
            (0..6).map(|q| q % 3 + q / 3 * 4).map(|a| [a, a + 1, a + 5, a + 4]),
        );
        assert_eq!(turn_per_length(&flat), [0.0; 6]);
    }

    #[test]
    fn orientations_need_not_agree() {
        let tube = tube(12, 2, 1.0);
        let mut turned = tube.clone();
        turned.corners[4..8].reverse();
        turned.corners[20..24].reverse();
        for (a, b) in turn_per_length(&tube).into_iter().zip(turn_per_length(&turned)) {
            assert!((a - b).abs() < 1e-9);
        }
    }

    #[test]
    fn faces_without_area_are_harmless() {
        let mut tube = tube(12, 2, 1.0);
        tube.push_face([0, 0, 1, 1].map(NodeId));
        tube.push_face([0, 0, 0].map(NodeId));
        assert!(turn_per_length(&tube).iter().all(|t| t.is_finite()));
    }
}
