//! The input, checked and put right.

use super::bounds::RIDGE_DEGREES;
use super::labels::{self, group_of, label_of};
use super::options::HexRefineError;
use super::sheets::materials_of;
use crate::geometry::{Extent, Point};
use crate::mesh::check::{Defect, summary};
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::quality::four;
use crate::mesh::topology::{HexFaces, Side, hex_of};
use crate::mesh::{
    FaceId, HexId, HexMesh, NodeId, QuadMesh, check_hexes_within, first_of_same, orient_hexes,
};
use crate::monitor::batches;
use crate::optimize::{BoundarySurface, FaceKind};
use crate::{Cancelled, Monitor, Stage, parallel};

/// The stage that this file reports.
const INPUT: Stage = Stage("input");

/// The input with its hexes turned the right way, all of them positive inside, without unused nodes; and how many were
/// turned.
pub(super) fn oriented(input: &HexMesh, monitor: &dyn Monitor) -> Result<(HexMesh, usize), HexRefineError> {
    if input.hexes.is_empty() {
        return Err(HexRefineError::NoHexes);
    }
    monitor.checkpoint(INPUT, 0.0)?;
    let mut mesh = input.clone();
    let is_bad = |h: usize| mesh.hexes[h].iter().any(|n| n.index() >= mesh.positions.len());
    let ids_are_good = !parallel::try_any(mesh.hexes.len(), monitor, is_bad)?;
    if ids_are_good {
        refuse_extent(&mesh, monitor)?;
    }
    let turned = if ids_are_good { orient_hexes(&mut mesh)? } else { 0 };
    monitor.checkpoint(INPUT, 0.1)?;
    let mut defects = check_hexes_within(&mesh, monitor)?;
    defects.retain(|defect| !matches!(defect, Defect::UnusedNode { .. }));
    keep_causes(&mut defects);
    if !defects.is_empty() {
        let kinds = summary(&defects).iter().map(ToString::to_string).collect();
        return Err(HexRefineError::InvalidInput(kinds));
    }
    monitor.checkpoint(INPUT, 0.8)?;
    refuse_doubtful(&mesh, monitor)?;
    drop_unused_nodes(&mut mesh);
    monitor.checkpoint(INPUT, 1.0)?;
    Ok((mesh, turned))
}

/// Refuses what cannot be refined of the meshes that were made here: they conform, their hexes are turned the right way, and all
/// of their nodes are used.
pub(super) fn refuse_unfit(input: &HexMesh, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
    debug_assert_eq!(check_hexes_within(input, monitor)?, [], "it conforms");
    if input.hexes.is_empty() {
        return Err(HexRefineError::NoHexes);
    }
    monitor.checkpoint(INPUT, 0.0)?;
    refuse_extent(input, monitor)?;
    refuse_doubtful(input, monitor)?;
    monitor.checkpoint(INPUT, 1.0)?;
    Ok(())
}

/// Refuses hexes that are not certainly positive inside.
fn refuse_doubtful(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
    let corners = |h: usize| mesh.hexes[h].map(|n| mesh.positions[n.index()]);
    let positive = four::are_positive(mesh.hexes.len(), monitor, corners)?;
    let doubtful = (0..positive.len()).filter(|&h| !positive[h]).map(HexId::new);
    let doubtful: Vec<HexId> = doubtful.collect();
    if doubtful.is_empty() { Ok(()) } else { Err(HexRefineError::NotPositive(doubtful)) }
}

/// Refuses coordinates that hexes cannot be reckoned with. What is not finite is told with the other defects.
fn refuse_extent(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
    let nodes = mesh.hexes.as_flattened().iter().map(|n| &mesh.positions[n.index()]);
    let extent = Extent::of(nodes.filter(|p| p.is_finite()));
    let Extent { size, reach } = extent;
    if !extent.is_in_range() {
        return Err(HexRefineError::Extent { size, reach });
    }
    let longest = longest_edge_of(mesh, monitor)?;
    if !extent.has_digits_for(longest) {
        return Err(HexRefineError::TooFewDigits { level: 0, longest, reach });
    }
    Ok(())
}

/// The longest edge of all hexes.
pub(super) fn longest_edge_of(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<f64, Cancelled> {
    parallel::try_greatest(mesh.hexes.len(), monitor, |h| {
        longest_edge(&mesh.hexes[h].map(|n| mesh.positions[n.index()]))
    })
}

/// The longest edge of a hex.
pub(super) fn longest_edge(corners: &[Point; 8]) -> f64 {
    let length = |[a, b]: [u8; 2]| corners[usize::from(a)].distance_squared(corners[usize::from(b)]);
    EDGES.map(length).into_iter().fold(0.0, f64::max).sqrt()
}

/// Drops what follows from other defects: where hexes come twice or nodes hang, faces have too many hexes, and links are
/// odd.
fn keep_causes(defects: &mut Vec<Defect>) {
    let (mut twice, mut cause) = (false, false);
    for defect in defects.iter() {
        twice |= matches!(defect, Defect::SameHexes { .. });
        cause |= matches!(
            defect,
            Defect::HexRepeatedNode { .. } | Defect::HangingNode { .. } | Defect::HangingNodeInFace { .. }
        );
    }
    defects.retain(|defect| match defect {
        Defect::OddLink { .. } | Defect::NonManifoldRim { .. } => !(twice || cause),
        Defect::NonManifoldFace { .. } | Defect::FaceDisagreement { .. } => !twice,
        _ => true,
    });
}

/// How many nodes stand exactly where earlier ones do: what is not welded there is no neighbour.
pub(super) fn coincident_nodes(positions: &[Point]) -> usize {
    first_of_same(positions).iter().zip(0..).filter(|&(&first, node)| first != node).count()
}

fn drop_unused_nodes(mesh: &mut HexMesh) {
    let mut is_used = vec![false; mesh.positions.len()];
    mesh.hexes.iter().flatten().for_each(|n| is_used[n.index()] = true);
    let mut number = Vec::with_capacity(is_used.len());
    let mut count = 0;
    for &used in &is_used {
        number.push(NodeId(count));
        count += u32::from(used);
    }
    let mut used = is_used.iter();
    mesh.positions.retain(|_| *used.next().expect("a flag a node"));
    parallel::for_each_mut(&mut mesh.hexes, |_, hex| *hex = hex.map(|n| number[n.index()]));
}

/// The surfaces on which nodes are kept: the input's boundary, in its groups, and what lies between its materials.
pub(super) fn boundary_surface(input: &HexMesh, monitor: &dyn Monitor) -> Result<BoundarySurface, Cancelled> {
    let faces = HexFaces::within(input.positions.len(), &input.hexes, monitor)?;
    let (mut quads, mut kinds) = (Vec::new(), Vec::new());
    let labels = labels::of_mesh(input);
    let materials = materials_of(input, &labels, monitor)?;
    let material = |side: Side| materials.get(hex_of(side).index()).copied().unwrap_or(0);
    for batch in batches(faces.nodes.len(), monitor) {
        for f in batch?.map(FaceId::new) {
            let kind = match *faces.sides(f) {
                [side] => Some(FaceKind::boundary(label_of(&labels, side), material(side))),
                [a, b] => {
                    let group = || group_of(label_of(&labels, a));
                    FaceKind::between([a, b].map(material), group)
                }
                _ => None,
            };
            if let Some(kind) = kind {
                quads.push(faces.nodes[f.index()]);
                kinds.push(kind);
            }
        }
    }
    drop(faces);
    let surface = QuadMesh { positions: input.positions.clone(), quads };
    BoundarySurface::of_kinds(&surface, RIDGE_DEGREES, |f| kinds[f], monitor)
}
