//! Raises the mean: cells that are neither poor nor perfect, such as those of transitions between levels, are smoothed
//! together with the boundary's, whose nodes slide on the solid. Those that are off it come no farther
//! from where they belong.

use super::super::correspondence::Correspondence;
use super::holds::{Hold, Holds};
use super::target::OnSolid;
use crate::mesh::{HexMesh, NodeId};
use crate::optimize::{Evening, Problem, even_out};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// Evens out the cells around the nodes that move. Returns the number of sweeps.
pub(super) fn even(
    mesh: &mut HexMesh,
    on: &Correspondence,
    holds: &[Hold],
    solid: &SolidModel,
    evening: Evening,
    moves: &(dyn Fn(NodeId) -> bool + Sync),
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    sliding(mesh, on, holds, solid, moves, monitor, &|problem, guide| {
        even_out(problem, guide, evening, monitor)
    })
}

/// What smooths a part of a mesh. Returns the number of sweeps.
type Smoothing<'a> = &'a dyn Fn(&mut Problem, &mut Holds) -> Result<usize, Cancelled>;

/// Smooths the cells around the nodes that move in some way, while those of the boundary slide.
pub(super) fn sliding(
    mesh: &mut HexMesh,
    on: &Correspondence,
    holds: &[Hold],
    solid: &SolidModel,
    moves: &(dyn Fn(NodeId) -> bool + Sync),
    monitor: &dyn Monitor,
    smooth: Smoothing,
) -> Result<usize, Cancelled> {
    let mut problem = Problem::within(&mesh.positions, &mesh.hexes, moves, monitor)?;
    problem.order_by(4, |n| on.anchors[n.index()].freedom());
    let target = OnSolid::new(solid, &on.reduction);
    let mut guide = Holds::kept(&target, &on.anchors, holds, &mesh.positions);
    let sweeps = smooth(&mut problem, &mut guide)?;
    problem.write_back(&mut mesh.positions);
    Ok(sweeps)
}
