//! Curvature of the input, face by face: by how much the normal turns along the surface.
//!
//! The surface's facets are flat; it turns at their edges. Averaged over a face, with half of the turn at each edge
//! as its share, that is the curvature tensor of Cohen-Steiner and Morvan (2003):
//!
//! ```text
//! T = 1/area · sum over edges of  turn/2 · length · (direction ⊗ direction)
//! ```
//!
//! with turns positive at convex and negative at concave edges. Its greatest eigenvalue, by magnitude, is the turn per
//! length in the direction in which the face turns most: 1/R on a cylinder or a ball of radius R, whether it is made of
//! triangles or quads.
//!
//! **Not curvature** are sharp edges (see [`SHARP`]), creases that the file marks, boundary edges, and edges of
//! three or more faces. There the other side is unknown, so faces at a curved surface's rim count as less curved than
//! those inside.

use crate::geometry::Point;
use crate::mesh::topology::EdgeUses;
use crate::mesh::{EdgeId, Edges, Faces, PolygonMesh};
use crate::parallel;
use crate::{Cancelled, Monitor};

/// Degrees. A greater turn at one edge is a sharp edge of the design, not a curved surface cut into facets: exporters cut
/// circles into at least 12 facets (30 degrees each), while chamfers and ribs meet at 45 degrees and more.
const SHARP: f64 = 40.0;

/// The turn of the normal of each face, in degrees per unit of length.
///
/// # Errors
/// If the monitor stops it.
///
/// # Panics
/// If the mesh has node ids out of range.
pub(crate) fn turn_per_length(mesh: &PolygonMesh, monitor: &dyn Monitor) -> Result<Vec<f64>, Cancelled> {
    let edges = Edges::monitored(mesh, monitor)?;
    let uses = EdgeUses::monitored(&edges, monitor)?;
    let normals = parallel::try_collect(mesh.face_count(), monitor, |f| area_normal(mesh, f))?;
    let turns = turns(mesh, &edges, &uses, &normals, monitor)?;
    let face = |f: usize| {
        let corners = mesh.offsets[f] as usize..mesh.offsets[f + 1] as usize;
        let at = corners.map(|k| {
            let e = edges.of_corner[k];
            let ends = edges.ends[e.index()];
            let [a, b] = ends.map(|n| mesh.positions[n.index()]);
            let like_first = uses.at(e)[0] as usize == k || mesh.corners[k] != ends[0];
            (b - a, if like_first { turns[e.index()] } else { -turns[e.index()] })
        });
        greatest_turn(at, normals[f])
    };
    parallel::try_collect(mesh.face_count(), monitor, face)
}

/// The turn at each edge, in degrees; 0 where there is none that counts. Convex as seen from the side that is up in the
/// edge's first face is positive.
fn turns(
    mesh: &PolygonMesh,
    edges: &Edges,
    uses: &EdgeUses,
    normals: &[Point],
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, Cancelled> {
    let mut creases: Vec<_> = mesh.features.creases.iter().map(|(ends, _)| sorted(*ends)).collect();
    creases.sort_unstable();
    let turn = |e: usize| {
        let ends = edges.ends[e];
        let &[first, second] = uses.at(EdgeId::new(e)) else { return 0.0 };
        if creases.binary_search(&sorted(ends)).is_ok() {
            return 0.0;
        }
        let [f, g] = [first, second].map(|corner| mesh.face_of(corner as usize));
        let against = mesh.corners[first as usize] != mesh.corners[second as usize];
        // Faces that run along the edge the same way have opposite sides up.
        let (m, n) = (normals[f], if against { normals[g] } else { -normals[g] });
        let [a, b] = ends.map(|n| mesh.positions[n.index()]);
        let across = m.cross(n);
        let turn = libm::atan2(across.length(), m.dot(n)).to_degrees();
        if turn > SHARP { 0.0 } else { turn.copysign(across.dot(b - a)) }
    };
    parallel::try_collect(edges.len(), monitor, turn)
}

fn sorted<T: Ord>([a, b]: [T; 2]) -> [T; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// The face's normal, as long as its area (Newell).
fn area_normal(mesh: &PolygonMesh, f: usize) -> Point {
    let nodes = mesh.face(f);
    let at = |k: usize| mesh.positions[nodes[k].index()] - mesh.positions[nodes[0].index()];
    let sum: Point = (1..nodes.len().saturating_sub(1)).map(|k| at(k).cross(at(k + 1))).sum();
    sum * 0.5
}

/// The greatest eigenvalue, by magnitude, of a face's tensor in its plane, from its edges and their turns.
fn greatest_turn(edges: impl Iterator<Item = (Point, f64)>, area_normal: Point) -> f64 {
    let Some(normal) = area_normal.try_normalize() else { return 0.0 };
    let (u, v) = normal.any_orthonormal_pair();
    let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
    for (edge, turn) in edges {
        let length = edge.length();
        if turn != 0.0 && length > 0.0 {
            let (x, y, weight) = (edge.dot(u), edge.dot(v), turn * 0.5 / length);
            uu += weight * x * x;
            uv += weight * x * y;
            vv += weight * y * y;
        }
    }
    let (mean, half) = ((uu + vv) * 0.5, (uu - vv) * 0.5);
    (mean.abs() + (half * half + uv * uv).sqrt()) / area_normal.length()
}
