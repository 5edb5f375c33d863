//! Correspondence between a hex mesh and a solid (paper 5.2): which boundary nodes stand for the solid's corners, which
//! paths of boundary edges for its curves, which boundary faces for its surfaces.
//!
//! [`correspond`] promises what [`Correspondence`] lists, whatever the mesh and the solid. It needs a mesh whose boundary
//! is a manifold. What the mesh cannot show is given up and said, in [`Reduction`]. The steps:
//!
//! 1. Curves of steps far lower than edges are given up (`low`), and those too short for the edges: these are contracted to
//!    corners where they have two (`network`).
//! 2. Corners, and some places on closed curves, get nodes; the curves at a corner get edges there, in the cyclic order
//!    that the solid has them in (`stops`, `place`, `arms`).
//! 3. All curves are routed, by negotiation: paths share no nodes (`corridor`, `route`).
//! 4. Where routing failed, 2 and 3 are repeated with other nodes; at last curves are given up (`capture`).
//! 5. Surfaces are flood fills between the paths (`label`).
//!
//! Topology is held by construction: the order of edges at nodes is read from the mesh, the order of curves at corners
//! from the solid's triangles, left and right from orientation. Positions only say which of all that is possible is
//! near.

mod anchor;
mod arms;
mod boundary;
mod capture;
mod check;
mod corridor;
mod label;
mod low;
mod network;
mod place;
mod reduction;
mod route;
mod stops;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;

use crate::mesh::{HexMesh, NodeId};
use crate::solid::{CornerId, SolidModel, SurfaceId};
use crate::{Cancelled, Monitor, Stage};
pub use anchor::{Anchor, Correspondence};
use boundary::{Boundary, NONE};
use capture::Capture;
pub use check::{Fault, check_correspondence};
use label::Labels;
use network::Network;
pub use reduction::{CurveFate, LostCurve, LostSurface, Reason, Reduction};
use stops::StopKey;

const CORRESPONDENCE: Stage = Stage("correspondence");

/// Finds a solid's corners, curves and surfaces on the boundary of a hex mesh.
///
/// # Errors
/// If the monitor stops it.
pub fn correspond(
    mesh: &HexMesh,
    solid: &SolidModel,
    monitor: &dyn Monitor,
) -> Result<Correspondence, Cancelled> {
    found(mesh, solid, false, monitor)
}

/// The same of a mesh whose faces look the way the solid's do, which tells apart sides that are near each other.
///
/// # Errors
/// If the monitor stops it.
pub fn correspond_alike(
    mesh: &HexMesh,
    solid: &SolidModel,
    monitor: &dyn Monitor,
) -> Result<Correspondence, Cancelled> {
    found(mesh, solid, true, monitor)
}

#[inline(never)] // Compiled once for all that call it.
fn found(
    mesh: &HexMesh,
    solid: &SolidModel,
    looks_alike: bool,
    monitor: &dyn Monitor,
) -> Result<Correspondence, Cancelled> {
    monitor.checkpoint(CORRESPONDENCE, 0.0)?;
    let boundary = Boundary::of(mesh, looks_alike, monitor)?;
    let mut network = Network::of(solid);
    low::give_up_low(&mut network, &boundary);
    network::give_up_short(&mut network, &boundary);
    monitor.checkpoint(CORRESPONDENCE, 0.1)?;
    let capture = capture::capture(&boundary, &mut network, monitor)?;
    monitor.checkpoint(CORRESPONDENCE, 0.9)?;
    let sides = sides_of_spokes(&boundary, solid, &capture);
    let labels = label::label_quads(&boundary, solid, &sides, &low::united(&network), monitor)?;
    monitor.checkpoint(CORRESPONDENCE, 1.0)?;
    Ok(correspondence(mesh, &boundary, network, &capture, labels))
}

/// For each spoke on a path the surface at its left.
fn sides_of_spokes(boundary: &Boundary, solid: &SolidModel, capture: &Capture) -> Vec<Option<SurfaceId>> {
    let mut sides = vec![None; boundary.spokes.len()];
    for (leg, path) in capture.legs.iter().zip(&capture.paths) {
        let [left, right] = solid.curves()[leg.curve.index()].sides;
        for &spoke in path {
            sides[spoke as usize] = Some(left);
            sides[boundary.spokes[spoke as usize].twin as usize] = Some(right);
        }
    }
    sides
}

fn correspondence(
    mesh: &HexMesh,
    boundary: &Boundary,
    network: Network,
    capture: &Capture,
    labels: Labels,
) -> Correspondence {
    let node_of = |n: u32| boundary.nodes[n as usize];
    let mut anchors = vec![Anchor::Inside; mesh.positions.len()];
    let mut faces = Vec::with_capacity(boundary.quads.len());
    for (quad, &surface) in boundary.quads.iter().zip(&labels.of_quads) {
        let nodes: [NodeId; 4] = quad.map(node_of);
        nodes.iter().for_each(|node| anchors[node.index()] = Anchor::Surface(surface));
        faces.push((nodes, surface));
    }
    let mut edges = Vec::new();
    for (leg, path) in capture.legs.iter().zip(&capture.paths) {
        for &spoke in path {
            let [a, b] =
                [boundary.spokes[spoke as usize].from, boundary.spokes[spoke as usize].to].map(node_of);
            [a, b].into_iter().for_each(|node| anchors[node.index()] = Anchor::Curve(leg.curve));
            edges.push(([a.min(b), a.max(b)], leg.curve));
        }
    }
    edges.sort_unstable();
    let mut placed = vec![false; network.solid.corners().len()];
    for (stop, &node) in capture.stops.iter().zip(&capture.placement.nodes) {
        if let (StopKey::Corner(corner), true) = (stop.key, node != NONE) {
            anchors[node_of(node).index()] = Anchor::Corner(corner);
            placed[corner.index()] = true;
        }
    }
    Correspondence { anchors, edges, faces, reduction: reduction(network, &placed, labels) }
}

fn reduction(network: Network, placed: &[bool], labels: Labels) -> Reduction {
    let solid = network.solid;
    let ids = |count: usize| (0..count).map(SurfaceId::new);
    let mut members = vec![Vec::new(); solid.surfaces().len()];
    for surface in ids(members.len()).filter(|s| !labels.is_lost[s.index()]) {
        members[labels.surfaces[surface.index()].index()].push(surface);
    }
    let lost = ids(members.len()).filter(|s| labels.is_lost[s.index()]).map(|surface| {
        let of_solid = &solid.surfaces()[surface.index()];
        LostSurface { surface, place: of_solid.bounds.center(), area: of_solid.area }
    });
    let corners: Vec<CornerId> = (0..placed.len()).map(|c| network.corner(CornerId::new(c))).collect();
    let lost_corners = (0..placed.len()).map(CornerId::new);
    let lost_corners = lost_corners.filter(|c| corners[c.index()] == *c && !placed[c.index()]).collect();
    let mut lost_curves = network.lost.clone();
    lost_curves.sort_unstable_by_key(|lost| lost.curve);
    Reduction {
        curves: network.fates().to_vec(),
        corners,
        lost_surfaces: lost.collect(),
        lost_curves,
        lost_corners,
        surfaces: labels.surfaces,
        members,
    }
}
