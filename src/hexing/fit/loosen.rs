//! Lets nodes that cannot get to their curve or corner rest on a surface beside it: the mesh is nearer to the solid then,
//! and cells around sharp edges are better. They are still reported as off.

use std::collections::BTreeMap;

use super::super::correspondence::{Anchor, Correspondence};
use super::FITTING;
use super::holds::{Hold, Holds};
use super::regions::{Mark, drawn};
use super::unlock::unlock;
use crate::mesh::NodeId;
use crate::monitor::Part;
use crate::optimize::{OptimizeOptions, Problem, smooth};
use crate::solid::{SolidModel, SurfaceId};
use crate::{Cancelled, Monitor};

/// The share of the work that is done when nodes were drawn to surfaces and cells are smoothed.
const UNLOCK: f64 = 0.5;

/// Draws those nodes to the nearest surface beside, where that does not take the mesh away from where they belong, and smooths
/// the cells where something moved. Not on free forms, whose curves nobody drew. Returns the number of sweeps.
pub(super) fn loosen(
    problem: &mut Problem,
    holds: &mut Holds,
    on: &Correspondence,
    smoothing: &OptimizeOptions,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let Some(solid) = holds.target.solid().filter(|solid| !solid.is_free_form()) else { return Ok(0) };
    let part = |from, to| Part { whole: monitor, stage: FITTING, range: [from, to] };
    let mut anchors = holds.anchors.to_vec();
    let mut nodes = Vec::new();
    for n in drawn(problem, holds) {
        let (id, place) = (problem.nodes[n as usize], problem.points[n as usize]);
        let distance = |&s: &SurfaceId| {
            let foot = holds.target.foot(Anchor::Surface(s), place);
            foot.map_or(f64::INFINITY, |foot| foot.point.distance(place))
        };
        let beside = beside(holds.anchors[id.index()], on, solid);
        let nearest = beside.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(surface) = nearest {
            anchors[id.index()] = Anchor::Surface(surface);
            nodes.push(id);
        }
    }
    if nodes.is_empty() {
        return Ok(0);
    }
    let marks = marks(problem, holds, on, &nodes);
    let mut loose = Holds::of(holds.target, &anchors, std::mem::take(&mut holds.holds));
    let unlocked = unlock(problem, &mut loose, &marks, &part(0.0, UNLOCK))?;
    let mut sweeps = unlocked.sweeps;
    if unlocked.gain > 0.0 {
        loose.weight = 0.0;
        // Sliding they would go farther from where they belong.
        let unpinned = loose.holds.clone();
        nodes.iter().for_each(|id| loose.holds[id.index()] = Hold::Pinned);
        sweeps += smooth(problem, &loose, smoothing, Some(&unlocked.moved), &part(UNLOCK, 1.0))?;
        loose.holds = unpinned;
    }
    holds.holds = loose.holds;
    for &id in &nodes {
        holds.holds[id.index()] = Hold::Drawn;
    }
    Ok(sweeps)
}

/// The surfaces beside a curve. None beside a corner: the mesh would lack all of a tip.
fn beside(anchor: Anchor, on: &Correspondence, solid: &SolidModel) -> Vec<SurfaceId> {
    let Anchor::Curve(curve) = anchor else { return Vec::new() };
    solid.curves()[curve.index()].sides.map(|s| on.reduction.surface(s)).to_vec()
}

/// Where the nodes belong, and the boundary around them.
fn marks(problem: &Problem, holds: &Holds, on: &Correspondence, nodes: &[NodeId]) -> Vec<Mark> {
    let mut quads: BTreeMap<NodeId, Vec<[u32; 4]>> = BTreeMap::new();
    for &id in nodes {
        quads.insert(id, Vec::new());
    }
    for (quad, _) in &on.faces {
        for node in quad {
            if let Some(around) = quads.get_mut(node) {
                around.push(quad.map(|node| problem.local(node)));
            }
        }
    }
    let mark = |(id, quads): (NodeId, Vec<[u32; 4]>)| {
        let node = problem.local(id);
        let foot = holds.target.foot(holds.anchors[id.index()], problem.points[node as usize])?;
        Some(Mark { node, place: foot.point, quads })
    };
    quads.into_iter().filter_map(mark).collect()
}

#[cfg(test)]
mod tests {
    use super::super::target::OnSolid;
    use super::*;
    use crate::Silent;
    use crate::geometry::{Aabb, Point};
    use crate::hexing::correspondence::correspond;
    use crate::mesh::{GridOptions, hex_grid};
    use crate::solid::testing::{cuboid, solid};

    /// A node in the middle of a cube's edge is off it, and no step of it alone gets it there.
    #[test]
    fn a_node_that_is_off_its_curve_comes_to_rest_beside_it() {
        let solid = solid(&cuboid([4, 4, 4]));
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100 };
        let mut mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(4.0) }, &options).unwrap();
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let node = mesh.positions.iter().position(|&p| p == Point::Z * 2.0).unwrap();
        assert!(matches!(on.anchors[node], Anchor::Curve(_)));
        mesh.positions[node] = Point::new(0.3, 0.1, 2.0);
        let target = OnSolid::new(&solid, &on.reduction);
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|_| true);
        let held = |anchor: &Anchor| if *anchor == Anchor::Inside { Hold::Free } else { Hold::Held };
        let mut holds = Holds::of(&target, &on.anchors, on.anchors.iter().map(held).collect());
        holds.holds[node] = Hold::Drawn;
        let sweeps = loosen(&mut problem, &mut holds, &on, &OptimizeOptions::default(), &Silent).unwrap();
        let place = problem.place(NodeId::new(node));
        assert!(sweeps > 0 && place.y == 0.0 && place.x > 0.0 && place.x < 0.5, "{place}");
        assert!(holds.is(NodeId::new(node), Hold::Drawn), "it is still off its curve");
        assert_eq!(drawn(&problem, &holds).count(), 1);
        assert!(problem.positive.iter().all(|&positive| positive));
    }
}
