//! Planar faces of a file, meshed in their plane in space.

use glam::DVec2;

use super::mesher::FaceError;
use super::region::{Region, RegionOptions, quad_region};
use crate::Monitor;
use crate::geometry::{Point, area_vector};
use crate::mesh::check::{check_faces, summary};
use crate::mesh::topology::Edges;
use crate::mesh::{NodeId, PolygonMesh, QuadMesh};

/// How far points may be off the plane, in units of the diagonal of the box around the faces.
const OFF_PLANE: f64 = 1e-6;

/// Quads that fill planar faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlanarQuads {
    /// The mesh, in the plane of the faces and turned as most of their area is.
    pub mesh: QuadMesh,
    /// Nodes that could not be brought to their curve without a quad turning over, and how far off they stand.
    pub off_curve: Vec<(NodeId, f64)>,
    /// Polylines that lie along the outline or other polylines, or outside, and add nothing: as numbered in the input.
    pub dropped: Vec<u32>,
}

/// Meshes what planar polygons cover with quads alone. The outline, of holes too, are the edges of one polygon; polylines
/// are curves that the mesh is to follow; nodes with a sharpness are corners that it keeps.
///
/// # Errors
/// See [`FaceError`]; points that are farther than a millionth of the faces' diagonal off their plane are refused.
pub fn quad_planar_faces(
    faces: &PolygonMesh,
    options: &RegionOptions,
    monitor: &dyn Monitor,
) -> Result<PlanarQuads, FaceError> {
    if faces.face_count() == 0 {
        return Err(FaceError::Empty);
    }
    let defects = check_faces(faces, monitor)?;
    if !defects.is_empty() {
        return Err(FaceError::Invalid(summary(&defects).iter().map(ToString::to_string).collect()));
    }
    let plane = Plane::of(faces)?;
    let welded = weld(&faces.positions);
    let (points, ids) = used(faces, &welded);
    let id = |node: NodeId| ids[welded[node.index()].index()];
    let curve = |polyline: &Vec<NodeId>| polyline.iter().map(|&node| id(node)).collect();
    let region = Region {
        points: points.iter().map(|&node| plane.plane_from_space(faces.positions[node.index()])).collect(),
        outline: outline(faces, &welded).iter().map(|ends| ends.map(id)).collect(),
        inner: faces.features.polylines.iter().map(curve).collect(),
        corners: faces
            .features
            .corners
            .iter()
            .map(|&(node, _)| id(node))
            .filter(|&p| p != NO_POINT)
            .collect(),
    };
    let meshed = quad_region(&region, options, monitor).map_err(|error| error.with_nodes(&points))?;
    let mesh = QuadMesh {
        positions: meshed.points.iter().map(|&p| plane.space_from_plane(p)).collect(),
        quads: meshed.quads.iter().map(|quad| quad.map(NodeId)).collect(),
    };
    let off_curve = meshed.off_curve.iter().map(|&(node, off)| (NodeId(node), off)).collect();
    Ok(PlanarQuads { mesh, off_curve, dropped: meshed.dropped })
}

/// A plane with coordinates in it.
struct Plane {
    /// Unit vectors in the plane, and its normal, right-handed.
    axes: [Point; 3],
    /// How far the plane is along its normal.
    height: f64,
}

impl Plane {
    /// The plane of the faces, turned as most of their area is.
    fn of(faces: &PolygonMesh) -> Result<Self, FaceError> {
        let middle = faces.bounds().center();
        let vector = |face: &[NodeId]| {
            let corners: Vec<Point> = face.iter().map(|n| faces.positions[n.index()] - middle).collect();
            area_vector(&corners)
        };
        let vectors: Vec<Point> = faces.faces().map(vector).collect();
        // Faces may be turned either way.
        let largest = vectors
            .iter()
            .copied()
            .fold(Point::ZERO, |a, b| if b.length_squared() > a.length_squared() { b } else { a });
        let turned = vectors.iter().map(|&v| if v.dot(largest) < 0.0 { -v } else { v }).sum::<Point>();
        let sign = if vectors.iter().copied().sum::<Point>().dot(turned) < 0.0 { -1.0 } else { 1.0 };
        let Some(normal) = turned.try_normalize() else { return Err(FaceError::Empty) };
        let mut plane = Self { axes: axes(normal * sign), height: 0.0 };
        let nodes: Vec<NodeId> = named(faces).collect();
        let at = |node: &NodeId| faces.positions[node.index()];
        plane.height = nodes.iter().map(|node| at(node).dot(plane.axes[2])).sum::<f64>() / nodes.len() as f64;
        let diagonal = faces.bounds().diagonal();
        let off = |node: &NodeId| (at(node).dot(plane.axes[2]) - plane.height).abs();
        let farthest = nodes.iter().max_by(|a, b| off(a).total_cmp(&off(b))).expect("a face has nodes");
        if off(farthest) > OFF_PLANE * diagonal {
            return Err(FaceError::NotPlanar {
                node: farthest.0,
                off: off(farthest),
                allowed: OFF_PLANE * diagonal,
            });
        }
        Ok(plane)
    }

    fn plane_from_space(&self, p: Point) -> DVec2 {
        DVec2::new(p.dot(self.axes[0]), p.dot(self.axes[1]))
    }

    fn space_from_plane(&self, p: DVec2) -> Point {
        self.axes[0] * p.x + self.axes[1] * p.y + self.axes[2] * self.height
    }
}

/// A right-handed frame with this normal; that of the coordinates where the normal is one of theirs.
pub(super) fn axes(normal: Point) -> [Point; 3] {
    let size = normal.abs();
    let k = if size.z >= size.x && size.z >= size.y { 2 } else { usize::from(size.y > size.x) };
    let first = [Point::Y, Point::Z, Point::X][k];
    let u = (first - normal * normal.dot(first)).normalize();
    [u, normal.cross(u), normal]
}

/// All nodes that a face or polyline names, as often as they do.
fn named(faces: &PolygonMesh) -> impl Iterator<Item = NodeId> {
    faces.corners.iter().chain(faces.features.polylines.iter().flatten()).copied()
}

/// For each node the first one at the same place.
fn weld(positions: &[Point]) -> Vec<NodeId> {
    let key = |n: &u32| (positions[*n as usize] + Point::ZERO).to_array().map(f64::to_bits);
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|n| (key(n), *n));
    let mut first: Vec<NodeId> = (0..positions.len()).map(NodeId::new).collect();
    for pair in order.windows(2) {
        if key(&pair[0]) == key(&pair[1]) {
            first[pair[1] as usize] = first[pair[0] as usize];
        }
    }
    first
}

/// No point of the region.
const NO_POINT: u32 = u32::MAX;

/// The welded nodes that are in use, in order of first use, and the number of each among them.
fn used(faces: &PolygonMesh, welded: &[NodeId]) -> (Vec<NodeId>, Vec<u32>) {
    let (mut points, mut ids) = (Vec::new(), vec![NO_POINT; faces.positions.len()]);
    for node in named(faces) {
        let node = welded[node.index()];
        if ids[node.index()] == NO_POINT {
            ids[node.index()] = points.len() as u32;
            points.push(node);
        }
    }
    (points, ids)
}

/// The edges with an odd number of polygons.
fn outline(faces: &PolygonMesh, welded: &[NodeId]) -> Vec<[NodeId; 2]> {
    let mut welded_faces = faces.clone();
    welded_faces.corners.iter_mut().for_each(|node| *node = welded[node.index()]);
    let edges = Edges::of(&welded_faces);
    let mut uses = vec![0_u32; edges.ends.len()];
    edges.of_corner.iter().for_each(|edge| uses[edge.index()] += 1);
    edges
        .ends
        .iter()
        .zip(uses)
        .filter(|(ends, uses)| uses % 2 == 1 && ends[0] != ends[1])
        .map(|(e, _)| *e)
        .collect()
}
