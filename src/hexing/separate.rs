//! Boundary nodes that came to lie on other parts of the boundary, or beyond them, are drawn in.
//!
//! Where two parts of the mesh's boundary stand for one part of the solid's, as when a slot between them was too narrow
//! for a cell, the fit lays them on each other: the mesh would look as if it hung together there. Where parts of the solid
//! are nearer to each other than cells are long, faces that stand for them may go through each other. Validity comes before
//! fidelity, so that the boundary yields.

use super::crossings::crossing_faces;
use crate::geometry::{Aabb, BoxIndex, Point};
use crate::mesh::quality::{Certainty, is_positive, scaled_jacobian};
use crate::mesh::topology::Bins;
use crate::mesh::{HexMesh, NodeId, hanging_on};
use crate::solid::SurfaceId;
use crate::{Cancelled, Monitor, parallel};

/// How far a node is drawn in at a time, as a share of the way to the middle of its hexes.
const STEP: f64 = 0.05;

/// Halvings of a step after which a node stays where it is.
const HALVINGS: usize = 6;

/// Rounds of looking and moving.
const ROUNDS: usize = 16;

/// No cell becomes worse than this share of what its nodes had at worst.
const KEPT: f64 = 0.5;

/// Two nodes nearer than this share of the mesh's size are one to whoever reads the file.
const SAME: f64 = 1e-9;

/// Whatever goes wrong at a face does so within its box and this share of the mesh's diagonal around it.
const AROUND: f64 = 1e-5;

/// A face of the boundary and what it stands for.
type Face = ([NodeId; 4], SurfaceId);

/// Draws in what lies on other parts of the boundary or goes through them; these are all its faces. Returns the nodes that
/// were moved.
///
/// # Errors
/// [`Cancelled`] when the monitor says so.
pub(super) fn separate(
    mesh: &mut HexMesh,
    faces: &[Face],
    monitor: &dyn Monitor,
) -> Result<Vec<NodeId>, Cancelled> {
    let mut moved = Vec::new();
    let mut hexes_at: Option<Bins> = None;
    let mut nodes = astray(mesh, faces, monitor)?;
    for _ in 0..ROUNDS {
        if nodes.is_empty() {
            break;
        }
        let corners = mesh.hexes.as_flattened();
        let at = hexes_at
            .get_or_insert_with(|| Bins::of(mesh.positions.len(), corners.len(), |k| corners[k].index()));
        for &node in &nodes {
            let hexes: Vec<usize> = at.at(node.index()).iter().map(|&k| k as usize / 8).collect();
            if draw_in(mesh, node, &hexes) {
                moved.push(node);
            }
        }
        nodes = astray(mesh, &faces_near(mesh, faces, &nodes), monitor)?;
    }
    moved.sort_unstable();
    moved.dedup();
    Ok(moved)
}

/// The nodes of these faces that lie where they do not belong, ascending: on others, inside edges or faces, or on faces that go
/// through others.
fn astray(mesh: &HexMesh, faces: &[Face], monitor: &dyn Monitor) -> Result<Vec<NodeId>, Cancelled> {
    let quads: Vec<[NodeId; 4]> = faces.iter().map(|&(quad, _)| quad).collect();
    let mut boundary = quads.as_flattened().to_vec();
    boundary.sort_unstable();
    boundary.dedup();
    let mut nodes = coincident(mesh, &boundary);
    nodes.extend(hanging_on(mesh, &quads, monitor)?);
    let crossed = crossing_faces(mesh, faces, monitor)?;
    nodes.extend(crossed.into_iter().flat_map(|(pair, _)| pair).flat_map(|face| quads[face]));
    nodes.sort_unstable();
    nodes.dedup();
    Ok(nodes)
}

/// The faces that are near to one of the nodes', which ascend. Where only these were moved, nothing is wrong elsewhere.
fn faces_near(mesh: &HexMesh, faces: &[Face], nodes: &[NodeId]) -> Vec<Face> {
    let around = AROUND * mesh.bounds().diagonal();
    let bounds = |quad: [NodeId; 4]| Aabb::around(&quad.map(|n| mesh.positions[n.index()])).grown(around);
    let is_of_them = |&&(quad, _): &&Face| quad.iter().any(|n| nodes.binary_search(n).is_ok());
    let of_them: Vec<Aabb> = faces.iter().filter(is_of_them).map(|&(quad, _)| bounds(quad)).collect();
    let theirs = BoxIndex::new(of_them);
    let is_near = |&(quad, _): &Face| theirs.touching(&bounds(quad)).next().is_some();
    faces.iter().copied().filter(is_near).collect()
}

/// Of these nodes, which ascend, those that stand where another does, of which the first stays.
fn coincident(mesh: &HexMesh, nodes: &[NodeId]) -> Vec<NodeId> {
    let at = |n: NodeId| mesh.positions[n.index()];
    let bounds = mesh.bounds();
    let near = Point::splat(SAME * (bounds.max - bounds.min).max_element());
    let index = BoxIndex::of_points(nodes.iter().map(|&n| &mesh.positions[n.index()]));
    let is_second = |k: usize| {
        let around = Aabb { min: at(nodes[k]) - near, max: at(nodes[k]) + near };
        index.touching(&around).any(|other| other < k)
    };
    parallel::filter(nodes.len(), is_second).into_iter().map(|k| nodes[k as usize]).collect()
}

/// Moves a node towards the middle of its hexes, as far as these bear it. Returns whether it could be moved.
fn draw_in(mesh: &mut HexMesh, node: NodeId, hexes: &[usize]) -> bool {
    let corners = |mesh: &HexMesh, h: usize| mesh.hexes[h].map(|n| mesh.positions[n.index()]);
    let middle = |h: usize| corners(mesh, h).iter().sum::<Point>() / 8.0;
    let target = hexes.iter().map(|&h| middle(h)).sum::<Point>() / hexes.len() as f64;
    let worst = |mesh: &HexMesh| {
        hexes.iter().map(|&h| scaled_jacobian(&corners(mesh, h))).fold(f64::INFINITY, f64::min)
    };
    let (before, least) = (mesh.positions[node.index()], KEPT * worst(mesh));
    let mut step = STEP;
    for _ in 0..HALVINGS {
        mesh.positions[node.index()] = before.lerp(target, step);
        let is_sound = |&h: &usize| is_positive(&corners(mesh, h)) == Certainty::Positive;
        if worst(mesh) >= least && hexes.iter().all(is_sound) {
            return true;
        }
        step *= 0.5;
    }
    mesh.positions[node.index()] = before;
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::mesh::topology::hex_boundary;
    use crate::mesh::{GridOptions, check_hexes, hex_grid};

    fn faces(mesh: &HexMesh) -> Vec<([NodeId; 4], SurfaceId)> {
        hex_boundary(&mesh.hexes).into_iter().map(|(quad, _)| (quad, SurfaceId(0))).collect()
    }

    /// Two boxes of 2 x 2 x 2 cells, `gap` apart along x.
    fn boxes(gap: f64) -> HexMesh {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 8 };
        let mut mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(2.0) }, &options).unwrap();
        let (nodes, hexes) = (mesh.positions.len(), mesh.hexes.len());
        for n in 0..nodes {
            mesh.positions.push(mesh.positions[n] + Point::new(2.0 + gap, 0.5, 0.25));
        }
        for h in 0..hexes {
            mesh.hexes.push(mesh.hexes[h].map(|n| NodeId::new(n.index() + nodes)));
        }
        mesh
    }

    /// Draws two boxes apart: of each the side towards the other moves, and no more than faces beside it.
    fn drawn_apart(gap: f64, is_wrong: impl Fn(&HexMesh) -> bool) {
        let mut mesh = boxes(gap);
        assert!(is_wrong(&mesh));
        let before = mesh.positions.clone();
        let faces = faces(&mesh);
        let moved = separate(&mut mesh, &faces, &Silent).unwrap();
        assert_eq!(check_hexes(&mesh), []);
        assert_eq!(crossing_faces(&mesh, &faces, &Silent).unwrap(), []);
        let is_near = |n: &NodeId| (1.0 + gap..=3.0).contains(&before[n.index()].x);
        assert!(!moved.is_empty() && moved.is_sorted() && moved.iter().all(is_near), "{moved:?}");
        let stays = |n: usize| mesh.positions[n] == before[n] || moved.contains(&NodeId::new(n));
        assert!((0..before.len()).all(stays));
    }

    #[test]
    fn what_touches_is_drawn_apart() {
        let quads = |mesh: &HexMesh| faces(mesh).into_iter().map(|(quad, _)| quad).collect::<Vec<_>>();
        drawn_apart(0.0, |mesh| !hanging_on(mesh, &quads(mesh), &Silent).unwrap().is_empty());
    }

    #[test]
    fn what_goes_through_each_other_is_drawn_apart() {
        drawn_apart(-0.1, |mesh| !crossing_faces(mesh, &faces(mesh), &Silent).unwrap().is_empty());
    }

    #[test]
    fn what_stands_apart_stays() {
        let mut mesh = boxes(0.01);
        let before = mesh.clone();
        let faces = faces(&mesh);
        assert_eq!(separate(&mut mesh, &faces, &Silent).unwrap(), []);
        assert_eq!(mesh, before);
    }
}
