//! Gives up soft curves that cost cells, and smooths the worst cells once more.
//!
//! On shapes that nobody drew with features some creases are found all the same: where they end or branch within a surface,
//! or go round a small part of it, nodes are held at places that have no room for good cells. As long as cells are poor,
//!
//! 1. the curve at each that is missed least is given up: its nodes slide on the surface from now on;
//! 2. the cells around are smoothed, with many sweeps, since they are few; from the second time on those where a curve was
//!    given up, and the worst alone. Nodes that are off the solid come no farther from where they belong;
//! 3. nodes of poor cells that are off the solid may go a little farther, and those that belong on curves that are noise may
//!    leave these. On free forms all nodes of poor cells may leave the surface: no curve tells what has to be where.

use std::collections::BTreeSet;

use super::super::correspondence::{Anchor, Correspondence, CurveFate, Reason};
use super::holds::{Hold, Holds};
use super::rings::widen;
use super::target::{OnSolid, Target};
use super::{FITTING, LEAVE, LOW};
use crate::geometry::Point;
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::quality::scaled_jacobian;
use crate::mesh::{HexMesh, NodeId};
use crate::monitor::Part;
use crate::optimize::{OptimizeOptions, Problem, smooth};
use crate::solid::{CurveId, SolidModel, SurfaceClass, SurfaceId};
use crate::{Cancelled, Monitor, parallel};

/// Cells whose scaled Jacobian is below this are poor.
const POOR: f64 = 0.46;

/// A curve is soft if its sides meet at an angle that is nearer to a straight one than this, in degrees, and unless that is
/// a crease of a free form, one of them is neither planar nor extruded, and they are one surface, or the square root of the
/// area of one is less than so many edges.
const SOFT: f64 = 60.0;
const SMALL: f64 = 0.8;

/// A curve that nobody drew is noise if its sides are general, or smaller than so many edges.
const NOISE: f64 = 2.0;

/// A node that is nearer to where it belongs than this share of an edge has not left it.
const THERE: f64 = 1e-6;

/// On free forms nodes may be so many edges from where they belong for the sake of cells.
const LEAVE_FORM: f64 = 0.3;

/// Where no curve is left, cells are smoothed as long as that raises the worst by this.
const ENOUGH: f64 = 0.002;

/// Cells that were smoothed before are smoothed again where they are no better than the worst by more than this.
const WORST: f64 = 0.03;

/// How often curves are given up.
const ROUNDS: usize = 12;

/// Rings of cells around poor ones whose nodes move.
const RINGS: usize = 3;

/// How the cells there are smoothed.
pub(super) const SMOOTHING: OptimizeOptions = OptimizeOptions {
    target: 0.65,
    untangle_sweeps: 0,
    courses: 5,
    smooth_sweeps: 6,
    low: LOW,
    worst_sweeps: 20,
    ..OptimizeOptions::DEFAULT
};

/// Mends what can be mended; nodes leave where they belong by no more than half of `max_distance`, if they are not farther
/// already. Returns the number of sweeps.
pub(super) fn soften(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    holds: &mut [Hold],
    solid: &SolidModel,
    max_distance: f64,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let (mut sweeps, mut worst, mut was_last) = (0, 0.0, false);
    for round in 0..ROUNDS {
        let part = |from: usize| from as f64 / ROUNDS as f64;
        monitor.checkpoint(FITTING, part(round))?;
        let jacobians = parallel::collect(mesh.hexes.len(), |h| {
            scaled_jacobian(&mesh.hexes[h].map(|n| mesh.positions[n.index()]))
        });
        let before = std::mem::replace(&mut worst, jacobians.iter().copied().fold(1.0, f64::min));
        let is_worst = |h: u32| round == 0 || jacobians[h as usize] < worst + WORST;
        let poor = parallel::filter(jacobians.len(), |h| jacobians[h] < POOR);
        let (low, curves) = mendable(mesh, on, solid, &poor, is_worst);
        if low.is_empty() || was_last && worst < before + ENOUGH {
            break;
        }
        was_last = curves.is_empty();
        for curve in curves {
            on.give_up(solid, curve, Reason::Costly);
        }
        let mut near = vec![false; mesh.positions.len()];
        low.iter().flat_map(|&h| mesh.hexes[h as usize]).for_each(|n| near[n.index()] = true);
        widen(mesh, &mut near, RINGS, monitor)?;
        let mut problem = Problem::within(&mesh.positions, &mesh.hexes, &|n| near[n.index()], monitor)?;
        problem.order_by(4, |n| on.anchors[n.index()].freedom());
        let target = OnSolid::new(solid, &on.reduction);
        let mut guide = Holds::kept(&target, &on.anchors, holds, &mesh.positions);
        let leaving = leaving(mesh, on, holds, &low, solid);
        for &n in &leaving {
            let leave = if solid.is_free_form() { LEAVE_FORM } else { LEAVE };
            // The boundary cuts across between its nodes, too.
            let length = (0.5 * max_distance).min(leave * problem.edge(problem.local(n)));
            guide.leash(n, length.max(guide.leash_of(n)));
        }
        let part = Part { whole: monitor, stage: FITTING, range: [part(round), part(round + 1)] };
        sweeps += smooth(&mut problem, &guide, &SMOOTHING, None, &part)?;
        problem.write_back(&mut mesh.positions);
        for n in leaving {
            let place = mesh.positions[n.index()];
            let there = THERE * problem.edge(problem.local(n));
            let foot = target.foot(on.anchors[n.index()], place);
            let has_left = foot.is_some_and(|foot| foot.point.distance(place) > there);
            if has_left && holds[n.index()] == Hold::Held {
                holds[n.index()] = Hold::Leashed;
            }
        }
    }
    Ok(sweeps)
}

/// Of these hexes those that are among the worst or at a soft curve, and the soft curve at each that is missed least.
fn mendable(
    mesh: &HexMesh,
    on: &Correspondence,
    solid: &SolidModel,
    poor: &[u32],
    is_worst: impl Fn(u32) -> bool,
) -> (Vec<u32>, BTreeSet<CurveId>) {
    let (mut low, mut curves) = (Vec::new(), BTreeSet::new());
    for &h in poor {
        let hex = &mesh.hexes[h as usize];
        let curve = least_missed(hex, mean_edge(&hex.map(|n| mesh.positions[n.index()])), on, solid);
        if curve.is_some() || is_worst(h) {
            low.push(h);
        }
        curves.extend(curve);
    }
    (low, curves)
}

/// The nodes of these hexes that are off the solid, those on curves and corners that nobody drew, and of free forms those on
/// surfaces.
fn leaving(
    mesh: &HexMesh,
    on: &Correspondence,
    holds: &[Hold],
    hexes: &[u32],
    solid: &SolidModel,
) -> Vec<NodeId> {
    let mut leaving = Vec::new();
    for hex in hexes.iter().map(|&h| &mesh.hexes[h as usize]) {
        let size = mean_edge(&hex.map(|n| mesh.positions[n.index()]));
        let is_on_noise = |n: NodeId| {
            let curves = curves_at(n, on, solid);
            !curves.is_empty() && curves.into_iter().all(|curve| is_noise(solid, curve, size))
        };
        let is_on_form =
            |n: NodeId| solid.is_free_form() && matches!(on.anchors[n.index()], Anchor::Surface(_));
        let leaves = |&n: &NodeId| holds[n.index()].is_off() || is_on_noise(n) || is_on_form(n);
        leaving.extend(hex.iter().copied().filter(leaves));
    }
    leaving.sort_unstable();
    leaving.dedup();
    leaving
}

/// The curves that a node is on.
fn curves_at(node: NodeId, on: &Correspondence, solid: &SolidModel) -> Vec<CurveId> {
    match on.anchors[node.index()] {
        Anchor::Curve(curve) => vec![curve],
        Anchor::Corner(corner) => on.curves_at(solid, corner),
        _ => Vec::new(),
    }
}

/// Is it a curve that nobody drew, among hexes with edges of that `size`?
fn is_noise(solid: &SolidModel, curve: CurveId, size: f64) -> bool {
    let of_noise = |s: &SurfaceId| is_general(solid, *s) || is_smaller(solid, *s, NOISE * size);
    !solid.is_drawn(curve) && solid.curves()[curve.index()].sides.iter().all(of_noise)
}

fn is_general(solid: &SolidModel, surface: SurfaceId) -> bool {
    solid.surfaces()[surface.index()].class == SurfaceClass::General
}

/// Is its area less than that of a square with this side?
fn is_smaller(solid: &SolidModel, surface: SurfaceId, side: f64) -> bool {
    solid.surfaces()[surface.index()].area < side * side
}

/// The mean length of a hex's edges.
fn mean_edge(corners: &[Point; 8]) -> f64 {
    let length = |&[a, b]: &[u8; 2]| corners[usize::from(a)].distance(corners[usize::from(b)]);
    EDGES.iter().map(length).sum::<f64>() / EDGES.len() as f64
}

/// Of the soft curves at a hex with edges of that `size` the one that is missed least, the shortest.
fn least_missed(hex: &[NodeId; 8], size: f64, on: &Correspondence, solid: &SolidModel) -> Option<CurveId> {
    let curves = hex.iter().flat_map(|&n| curves_at(n, on, solid));
    let is_soft = |curve: &CurveId| {
        let curve = &solid.curves()[curve.index()];
        let [a, b] = curve.sides;
        let is_small = |s: SurfaceId| is_smaller(solid, s, SMALL * size);
        let is_of_scan = || solid.is_free_form();
        let is_blend = || is_general(solid, a) || is_general(solid, b);
        curve.sharpness() < SOFT && (is_of_scan() || is_blend() && (a == b || is_small(a) || is_small(b)))
    };
    let kept = curves.filter(|curve| on.reduction.curve(*curve) == CurveFate::Captured).filter(is_soft);
    kept.min_by(|a, b| {
        let length = |c: &CurveId| solid.curves()[c.index()].length;
        length(a).total_cmp(&length(b)).then(a.cmp(b))
    })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::geometry::Aabb;
    use crate::hexing::correspondence::correspond;
    use crate::mesh::{GridOptions, PolygonMesh, hex_grid};
    use crate::solid::testing::{moved, voxels};

    /// A house of 2 by 2 whose roof has slopes of 20 degrees.
    fn house() -> SolidModel {
        let profile = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.5], [1.0, 1.864], [0.0, 1.5]];
        let end = |y: f64| profile.map(|[x, z]| Point::new(x, y, z));
        let mut surface = PolygonMesh { positions: [end(0.0), end(2.0)].concat(), ..PolygonMesh::default() };
        surface.push_face([0, 1, 2, 3, 4].map(NodeId));
        surface.push_face([9, 8, 7, 6, 5].map(NodeId));
        for k in 0..5 {
            let next = (k + 1) % 5;
            surface.push_face([next, k, k + 5, next + 5].map(NodeId));
        }
        crate::solid::testing::solid(&surface)
    }

    #[test]
    fn poor_cells_are_smoothed_and_planes_keep_their_curves() {
        let solid = house();
        let options = GridOptions { spacing: 0.5, margin: 0.0, fitted: true, max_hexes: 1000 };
        let mut mesh = hex_grid(solid.bounds(), &options).unwrap();
        // Up to the roof.
        for p in &mut mesh.positions {
            p.z *= (1.864 - 0.364 * (p.x - 1.0).abs()) / 1.864;
        }
        let mut on = correspond(&mesh, &solid, &Silent).unwrap();
        let curves = solid.curves().len();
        assert_eq!(on.reduction.count(CurveFate::Captured), curves);
        let hold = |anchor: &Anchor| if *anchor == Anchor::Inside { Hold::Free } else { Hold::Held };
        let mut holds: Vec<Hold> = on.anchors.iter().map(hold).collect();
        let unbounded = f64::INFINITY;
        assert_eq!(soften(&mut mesh, &mut on, &mut holds, &solid, unbounded, &Silent), Ok(0));
        let worst = |mesh: &HexMesh| {
            let jacobian = |hex: &[NodeId; 8]| scaled_jacobian(&hex.map(|n| mesh.positions[n.index()]));
            mesh.hexes.iter().map(jacobian).fold(1.0, f64::min)
        };
        let top = Point::new(1.0, 1.0, 1.864);
        let below = (0..mesh.positions.len()).filter(|&n| on.anchors[n] == Anchor::Inside);
        let below = below
            .min_by(|&a, &b| mesh.positions[a].distance(top).total_cmp(&mesh.positions[b].distance(top)));
        mesh.positions[below.unwrap()] += Point::X * 0.32;
        assert!((0.0..POOR).contains(&worst(&mesh)));
        assert!(soften(&mut mesh, &mut on, &mut holds, &solid, unbounded, &Silent).unwrap() > 0);
        assert!(worst(&mesh) > POOR);
        assert_eq!(on.reduction.count(CurveFate::Captured), curves);
    }

    /// Where the corners of a cube were on a ball its cells are poor as long as their nodes are on it.
    #[test]
    fn nodes_leave_free_forms_for_the_sake_of_cells() {
        let round = |p: Point| {
            let v = p - 4.0;
            Point::splat(4.0) + v.normalize_or_zero() * v.abs().max_element()
        };
        let solid = crate::solid::testing::solid(&moved(voxels([8, 8, 8], |_| true), round));
        assert!(solid.is_free_form());
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 1000 };
        let softened = |max_distance: f64| {
            let bounds = Aabb { min: Point::ZERO, max: Point::splat(8.0) };
            let mut mesh = hex_grid(bounds, &options).unwrap();
            mesh.positions.iter_mut().for_each(|p| *p = round(*p));
            let mut on = correspond(&mesh, &solid, &Silent).unwrap();
            let hold = |anchor: &Anchor| if *anchor == Anchor::Inside { Hold::Free } else { Hold::Held };
            let mut holds: Vec<Hold> = on.anchors.iter().map(hold).collect();
            soften(&mut mesh, &mut on, &mut holds, &solid, max_distance, &Silent).unwrap();
            let off = |n: usize| solid.nearest(mesh.positions[n]).distance;
            let boundary = (0..holds.len()).filter(|&n| on.anchors[n] != Anchor::Inside);
            let farthest = boundary.clone().map(off).fold(0.0, f64::max);
            assert!(boundary.clone().all(|n| holds[n] == Hold::Leashed || off(n) < 1e-9));
            let jacobian = |hex: &[NodeId; 8]| scaled_jacobian(&hex.map(|n| mesh.positions[n.index()]));
            (mesh.hexes.iter().map(jacobian).fold(1.0, f64::min), farthest)
        };
        let (on_it, _) = softened(0.0);
        let (near_it, little) = softened(0.1);
        let (freely, far) = softened(f64::INFINITY);
        assert!(on_it < near_it && near_it < freely, "{on_it} {near_it} {freely}");
        assert!(little <= 0.05 + 1e-9 && 0.05 < far && far < 1.1 * LEAVE_FORM, "{little} {far}");
    }

    /// The rim of a lens is one of a free form, that of a cylinder is not.
    #[test]
    fn all_creases_of_free_forms_are_soft() {
        let on_lens = |p: Point| {
            let v = p - 4.0;
            let ball = v.normalize_or_zero() * v.abs().max_element();
            let height = v.z.signum() * (4.0 - ball.truncate().length_squared() / 4.0);
            Point::splat(4.0) + if v.z == 0.0 { ball } else { ball.with_z(height) }
        };
        let on_cylinder = |p: Point| {
            let v = (p - 4.0).with_z(0.0);
            Point::new(4.0, 4.0, p.z) + v.normalize_or_zero() * v.abs().max_element()
        };
        let softened = |surface: PolygonMesh| {
            let solid = crate::solid::testing::solid(&surface);
            let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 1000 };
            let mesh = hex_grid(solid.bounds(), &options).unwrap();
            let on = correspond(&mesh, &solid, &Silent).unwrap();
            let all: Vec<u32> = (0..mesh.hexes.len() as u32).collect();
            (
                solid.is_free_form(),
                solid.curves().len(),
                mendable(&mesh, &on, &solid, &all, |_| false).1.len(),
            )
        };
        let cube = || voxels([8, 8, 8], |_| true);
        assert_eq!(softened(moved(cube(), on_lens)), (true, 1, 1));
        assert_eq!(softened(moved(cube(), on_cylinder)), (false, 2, 0));
    }

    /// The foot of a dome is a soft curve: hexes there are mended whether they are the worst or not.
    #[test]
    fn hexes_at_soft_curves_and_the_worst_are_mended() {
        let dome = |p: Point| {
            let out = 1.0 - (p.truncate() - 4.0).length() / 2.5;
            if p.z == 4.0 && out > 0.0 { p + Point::Z * out } else { p }
        };
        let solid = crate::solid::testing::solid(&moved(voxels([8, 8, 4], |_| true), dome));
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 1000 };
        let mesh = hex_grid(solid.bounds(), &options).unwrap();
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let all: Vec<u32> = (0..mesh.hexes.len() as u32).collect();
        let (at_curves, curves) = mendable(&mesh, &on, &solid, &all, |_| false);
        let is_at_one = |h: &u32| {
            let nodes = mesh.hexes[*h as usize];
            nodes.iter().any(|&n| curves_at(n, &on, &solid).iter().any(|c| curves.contains(c)))
        };
        assert!(!at_curves.is_empty() && at_curves.iter().all(is_at_one), "{at_curves:?} {curves:?}");
        let other = all.iter().copied().find(|h| !at_curves.contains(h)).unwrap();
        let (with_other, same) = mendable(&mesh, &on, &solid, &all, |h| h == other);
        assert_eq!(same, curves);
        let mut expected = at_curves;
        expected.push(other);
        expected.sort_unstable();
        assert_eq!(with_other, expected);
    }
}
