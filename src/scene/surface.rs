//! A polygon surface as the GPU draws it.
//!
//! Drawn without an index buffer: a vertex is a node id (4 bytes), its position comes from a texture
//! of nodes and all that belongs to a face from textures of faces. A triangle knows its face and which
//! of its sides are sides of the face, so that one draw call shows flat-shaded faces with their edges
//! and without the triangulation's diagonals. A quad costs 24 bytes of vertices, 8 of triangles, 4 of
//! normal, 1 of colour, and about one node of 16: 53 bytes.

use std::{ops::Range, sync::Arc};

use glam::{DVec3, Vec3};

use super::Frame;
use crate::{
    geometry::{Aabb, Point, area_vector, triangulate},
    mesh::{PolygonMesh, QuadMesh},
};

/// Number of low bits of a triangle's tag that are flags; the face id stands above them.
const FLAG_BITS: u32 = 5;
/// Flag of a triangle of a polygon with more than four corners: the size of such a triangle says
/// nothing of the size of its face.
const FLAG_POLYGON: u32 = 1 << 3;
/// Flag of a triangle of a cap: a face inside a hex mesh that a cut brings to light.
const FLAG_CAP: u32 = 1 << 4;

/// A polygon surface in scene coordinates.
#[derive(Clone, Debug)]
pub struct Surface {
    frame: Frame,
    bounds: Aabb,
    /// Shared by the surfaces that different cuts leave of one mesh.
    positions: Arc<[Vec3]>,
    /// Where each face's corners start and the last ends; `None`: every face has four.
    offsets: Option<Vec<u32>>,
    corners: Vec<u32>,
    /// Whether each face is a cap; empty: none is.
    is_cap: Vec<bool>,
}

/// Why arrays are no surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// Coordinates do not come in threes.
    #[error("{0} coordinates are no whole number of points; give x, y and z of each node")]
    Coordinates(usize),
    /// A coordinate is infinite or not a number.
    #[error("node {0} has a coordinate that is not a finite number")]
    NotFinite(usize),
    /// Nodes of hexes do not come in eights.
    #[error("{0} nodes are no whole number of hexes; give the eight nodes of each")]
    Hexes(usize),
    /// Offsets do not start at 0, fall, end elsewhere than the corners, or give a face of two corners.
    #[error("offsets are wrong at face {0}: each face needs at least three corners, all of them listed")]
    Offsets(usize),
    /// A face names a node that is not there.
    #[error("face {face} uses node {node}, but there are {nodes} nodes")]
    Node {
        /// The face.
        face: usize,
        /// The node it names.
        node: u32,
        /// How many nodes there are.
        nodes: usize,
    },
    /// More faces than a triangle's tag can name.
    #[error("{0} faces are more than can be drawn ({max})", max = 1u32 << (32 - FLAG_BITS))]
    TooManyFaces(usize),
}

/// What a run of faces is drawn from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleBuffers {
    /// Three node ids a triangle.
    pub nodes: Vec<u32>,
    /// One tag a triangle: `face << 5 | cap << 4 | polygon << 3 | sides`, where bit k of `sides` says that the
    /// side opposite the triangle's corner k is a side of the face.
    pub tags: Vec<u32>,
}

impl Surface {
    /// A surface from flat arrays: three coordinates a node, and faces as in
    /// [`PolygonMesh`](crate::mesh::PolygonMesh), or quads if `offsets` is `None`.
    pub fn new(
        coordinates: &[f64],
        offsets: Option<Vec<u32>>,
        corners: Vec<u32>,
    ) -> Result<Self, SurfaceError> {
        if !coordinates.len().is_multiple_of(3) {
            return Err(SurfaceError::Coordinates(coordinates.len()));
        }
        if let Some(bad) = coordinates.iter().position(|c| !c.is_finite()) {
            return Err(SurfaceError::NotFinite(bad / 3));
        }
        let points = || coordinates.chunks_exact(3).map(Point::from_slice);
        let bounds = points().fold(Aabb::EMPTY, Aabb::with);
        let frame = Frame::around(&bounds);
        let positions = points().map(|p| frame.scene(p)).collect();
        let surface = Self { frame, bounds, positions, offsets, corners, is_cap: Vec::new() };
        surface.validate()?;
        Ok(surface)
    }

    /// Quads between the same nodes, and which of them are caps. The nodes must be there.
    pub(super) fn with_quads(&self, quads: Vec<[u32; 4]>, is_cap: Vec<bool>) -> Self {
        let corners = quads.into_flattened();
        Self { positions: self.positions.clone(), offsets: None, corners, is_cap, ..*self }
    }

    fn validate(&self) -> Result<(), SurfaceError> {
        match &self.offsets {
            Some(offsets) => {
                let ends_match = offsets.first() == Some(&0)
                    && offsets.last().is_some_and(|&end| end as usize == self.corners.len());
                let short = offsets.windows(2).position(|w| w[1] < w[0].saturating_add(3));
                if let Some(face) = short.or((!ends_match).then(|| offsets.len().saturating_sub(2))) {
                    return Err(SurfaceError::Offsets(face));
                }
            }
            None if !self.corners.len().is_multiple_of(4) => {
                return Err(SurfaceError::Offsets(self.corners.len() / 4));
            }
            None => {}
        }
        if self.face_count() > 1 << (32 - FLAG_BITS) {
            return Err(SurfaceError::TooManyFaces(self.face_count()));
        }
        let nodes = self.positions.len();
        match self.corners.iter().position(|&n| n as usize >= nodes) {
            Some(at) => {
                Err(SurfaceError::Node { face: self.face_of_corner(at), node: self.corners[at], nodes })
            }
            None => Ok(()),
        }
    }

    fn face_of_corner(&self, at: usize) -> usize {
        match &self.offsets {
            Some(offsets) => offsets.partition_point(|&o| o as usize <= at) - 1,
            None => at / 4,
        }
    }

    /// Where the scene stands in the world.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The box around all nodes, in world coordinates.
    pub fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// The nodes, in scene coordinates.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.offsets.as_ref().map_or(self.corners.len() / 4, |o| o.len() - 1)
    }

    /// Number of triangles that the faces are drawn with: n - 2 for a face of n corners.
    pub fn triangle_count(&self) -> usize {
        self.corners.len() - 2 * self.face_count()
    }

    /// The nodes of a face, in order around it.
    pub fn face(&self, face: usize) -> &[u32] {
        let range = match &self.offsets {
            Some(offsets) => offsets[face] as usize..offsets[face + 1] as usize,
            None => 4 * face..4 * face + 4,
        };
        &self.corners[range]
    }

    /// The corner points of a face in scene coordinates, into `out`.
    pub(super) fn face_points(&self, face: usize, out: &mut Vec<DVec3>) {
        out.clear();
        out.extend(self.face(face).iter().map(|&n| self.positions[n as usize].as_dvec3()));
    }

    /// The box around a face, in world coordinates.
    pub fn face_bounds(&self, face: usize) -> Aabb {
        self.bounds_of(self.face(face))
    }

    /// The box around some nodes, in world coordinates.
    pub(super) fn bounds_of(&self, nodes: &[u32]) -> Aabb {
        let point = |&n: &u32| self.frame.world(self.positions[n as usize].as_dvec3());
        nodes.iter().map(point).fold(Aabb::EMPTY, Aabb::with)
    }

    /// Consecutive runs of faces of at most `limit` triangles each (a face of more is a run of its own).
    pub fn runs(&self, limit: usize) -> Vec<Range<usize>> {
        let mut runs = Vec::new();
        let mut start = 0;
        let mut triangles = 0;
        for face in 0..self.face_count() {
            let more = self.face(face).len() - 2;
            if triangles + more > limit && face > start {
                runs.push(start..face);
                (start, triangles) = (face, 0);
            }
            triangles += more;
        }
        if start < self.face_count() {
            runs.push(start..self.face_count());
        }
        runs
    }

    /// The triangles of a run of faces.
    pub fn triangles(&self, faces: Range<usize>) -> TriangleBuffers {
        let count: usize = faces.clone().map(|f| self.face(f).len() - 2).sum();
        let mut out =
            TriangleBuffers { nodes: Vec::with_capacity(3 * count), tags: Vec::with_capacity(count) };
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        for face in faces {
            let nodes = self.face(face);
            self.face_points(face, &mut points);
            triangles.clear();
            triangulate(&points, &mut triangles);
            let flags = if self.is_cap.get(face) == Some(&true) { FLAG_CAP } else { 0 };
            for &triangle in &triangles {
                out.nodes.extend(triangle.map(|corner| nodes[corner as usize]));
                out.tags.push(tag(face, nodes.len(), triangle) | flags);
            }
        }
        out
    }

    /// The unit normal of each face in octahedral coordinates, x in the low 16 bits.
    pub fn normals(&self) -> Vec<u32> {
        let mut points = Vec::new();
        (0..self.face_count())
            .map(|face| {
                self.face_points(face, &mut points);
                pack_normal(area_vector(&points).try_normalize().unwrap_or(DVec3::Z))
            })
            .collect()
    }
}

/// The tag of a triangle of face `face`, whose polygon has `corners` corners.
fn tag(face: usize, corners: usize, triangle: [u32; 3]) -> u32 {
    let n = corners as u32;
    let is_side = |a: u32, b: u32| (a + 1) % n == b || (b + 1) % n == a;
    let [a, b, c] = triangle;
    let sides = u32::from(is_side(b, c)) | u32::from(is_side(c, a)) << 1 | u32::from(is_side(a, b)) << 2;
    let polygon = if corners > 4 { FLAG_POLYGON } else { 0 };
    (face as u32) << FLAG_BITS | polygon | sides
}

/// A unit vector on the octahedron unfolded to a square, 16 bits a coordinate (Cigolle et al. 2014, "A
/// survey of efficient representations for independent unit vectors").
fn pack_normal(n: DVec3) -> u32 {
    let n = n / n.abs().element_sum();
    let fold =
        |a: f64, b: f64| if n.z < 0.0 { (1.0 - b.abs()) * if a < 0.0 { -1.0 } else { 1.0 } } else { a };
    let quantize = |v: f64| ((v * 0.5 + 0.5) * 65535.0).round() as u32;
    quantize(fold(n.x, n.y)) | quantize(fold(n.y, n.x)) << 16
}

impl TryFrom<&PolygonMesh> for Surface {
    type Error = SurfaceError;

    fn try_from(mesh: &PolygonMesh) -> Result<Self, SurfaceError> {
        let corners = bytemuck::cast_slice(&mesh.corners).to_vec();
        Self::new(&flat(&mesh.positions), Some(mesh.offsets.clone()), corners)
    }
}

impl TryFrom<&QuadMesh> for Surface {
    type Error = SurfaceError;

    fn try_from(mesh: &QuadMesh) -> Result<Self, SurfaceError> {
        Self::new(&flat(&mesh.positions), None, bytemuck::cast_slice(&mesh.quads).to_vec())
    }
}

fn flat(points: &[Point]) -> Vec<f64> {
    points.iter().flat_map(|p| p.to_array()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the shader does to a packed normal.
    fn unpack_normal(packed: u32) -> DVec3 {
        let x = f64::from(packed & 0xffff) / 65535.0 * 2.0 - 1.0;
        let y = f64::from(packed >> 16) / 65535.0 * 2.0 - 1.0;
        let z = 1.0 - x.abs() - y.abs();
        let t = (-z).max(0.0);
        DVec3::new(x - t.copysign(x), y - t.copysign(y), z).normalize()
    }

    #[test]
    fn normals_survive_packing() {
        for i in 0..2000 {
            let t = f64::from(i);
            let n = DVec3::new((t * 0.7).sin(), (t * 1.3).cos(), (t * 0.31).sin()).normalize();
            assert!(unpack_normal(pack_normal(n)).distance(n) < 1e-4, "{n}");
        }
        for n in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
            assert!(unpack_normal(pack_normal(n)).distance(n) < 1e-4, "{n}");
        }
    }

    fn square() -> Vec<f64> {
        vec![0., 0., 0., 2., 0., 0., 2., 1., 0., 0., 1., 0.]
    }

    #[test]
    fn a_quad_shows_its_sides_and_hides_its_diagonal() {
        let surface = Surface::new(&square(), None, vec![0, 1, 2, 3]).unwrap();
        let buffers = surface.triangles(0..1);
        assert_eq!(buffers.nodes, [0, 1, 2, 0, 2, 3]);
        // Sides 1-2 and 0-1 of the first triangle, 2-3 and 3-0 of the second; 0-2 is the diagonal.
        assert_eq!(buffers.tags, [0b101, 0b011]);
        assert_eq!(surface.normals().len(), 1);
        assert_eq!(surface.positions()[0], Vec3::new(-0.5, -0.25, 0.0));
    }

    #[test]
    fn far_from_the_origin_the_scene_stays_near_it() {
        let far: Vec<f64> = square().iter().map(|c| c * 1e-3 + 1e7).collect();
        let surface = Surface::new(&far, None, vec![0, 1, 2, 3]).unwrap();
        let size = surface.positions()[1] - surface.positions()[0];
        assert!((size - Vec3::X).length() < 1e-5, "{size}");
    }

    #[test]
    fn runs_cover_all_faces_within_the_limit() {
        let coordinates: Vec<f64> = (0..30).map(f64::from).collect();
        let surface =
            Surface::new(&coordinates, Some(vec![0, 3, 7, 12, 15]), (0..15).map(|i| i % 10).collect())
                .unwrap();
        assert_eq!(surface.triangle_count(), 7);
        assert_eq!(surface.runs(100), vec![0..4; 1]);
        assert_eq!(surface.runs(3), [0..2, 2..3, 3..4]);
        assert_eq!(surface.runs(1), [0..1, 1..2, 2..3, 3..4]);
        let tags = surface.triangles(2..3).tags;
        assert!(tags.iter().all(|t| t >> FLAG_BITS == 2 && t & FLAG_POLYGON != 0), "{tags:?}");
    }

    #[test]
    fn bad_arrays_are_refused() {
        let check = |coordinates: &[f64], offsets: Option<&[u32]>, corners: &[u32], expect: SurfaceError| {
            let got = Surface::new(coordinates, offsets.map(<[u32]>::to_vec), corners.to_vec());
            assert_eq!(got.unwrap_err(), expect);
        };
        let p = square();
        check(&p[..11], None, &[0, 1, 2, 3], SurfaceError::Coordinates(11));
        check(&[0., 0., 0., 1., f64::NAN, 0.], None, &[], SurfaceError::NotFinite(1));
        check(&p, None, &[0, 1, 2], SurfaceError::Offsets(0));
        check(&p, None, &[0, 1, 2, 4], SurfaceError::Node { face: 0, node: 4, nodes: 4 });
        check(&p, Some(&[0, 3, 5]), &[0, 1, 2, 0, 1], SurfaceError::Offsets(1));
        check(&p, Some(&[0, 3, 1]), &[0, 1, 2], SurfaceError::Offsets(1));
        check(&p, Some(&[0, 3]), &[0, 1, 2, 3], SurfaceError::Offsets(0));
        check(&p, Some(&[]), &[], SurfaceError::Offsets(0));
        check(&p, Some(&[0, 3, 6]), &[0, 1, 2, 0, 1, 9], SurfaceError::Node { face: 1, node: 9, nodes: 4 });
    }

    #[test]
    fn an_empty_mesh_is_a_surface_of_nothing() {
        let surface = Surface::new(&[], Some(vec![0]), vec![]).unwrap();
        assert_eq!((surface.face_count(), surface.triangle_count()), (0, 0));
        assert!(surface.runs(10).is_empty());
    }
}
