//! Which region keeps a node of the interface, and where the copies of the others go.
//!
//! A copy moves by [`THICKNESS`] of the node's shortest edge: towards the mean of the region's hexes within the
//! domain, of its boundary faces on a smooth boundary, along the ridge on a ridge of the boundary, be it sharp or the
//! border of a group of boundary faces. Away from ridges it turns away from faces of the interface that it would hardly
//! leave (`folds`). So copies stay on the boundary, and on its ridges. A region that owns two ridges
//! at the node, or boundary faces on both sides of a ridge that is not its own, cannot move.
//!
//! Faces between materials are boundary faces in all of this: of the region that has the hexes on both sides, or, if
//! these are of two, of the one that is to keep them (`materials`).
//!
//! One region keeps the node. In this order it is one
//! 1. that the outside joins at a pinched edge,
//! 2. of the side that stays along a ridge (`ridges`),
//! 3. that owns a boundary face,
//! 4. that cannot move,
//! 5. of the side that stays along a ridge beside the node, if the other leaves that along the interface's plane,
//! 6. with the most neighbours,
//! 7. of refined hexes.

use super::bounds::{ALONG, Bound, Bounds, Freedom, RIDGE};
use super::folds::Folds;
use super::interface::{Interface, Kept, Star};
use super::pillow::THICKNESS;
use super::regions::{Regions, interface_ends};
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::NEIGHBOURS;

/// How far the layer leans over beside a ridge, in thicknesses.
const LEAN: f64 = 0.7;

/// Where the regions of a node can go. Its buffers serve one node after another.
#[derive(Default)]
pub(super) struct Shifts {
    at: Point,
    /// How far copies move.
    distance: f64,
    /// How far the region that keeps the node moves itself.
    lean: Point,
    bounds: Bounds,
    folds: Folds,
    regions: Vec<Shift>,
    /// Edges of the interface along ridges, by their other ends.
    pub(super) ridges: Vec<NodeId>,
}

/// What a region can do.
#[derive(Clone, Copy, Default)]
struct Shift {
    is_on_boundary: bool,
    /// Has it a ridge of its own?
    is_on_ridge: bool,
    /// Has it boundary faces at a ridge whose other faces are the other side's?
    is_at_ridge: bool,
    /// Which way it moves, if it can; of length 1.
    direction: Option<Point>,
    keeps: bool,
    /// 0 if it keeps the node, else its copy's number among those of the node, from 1.
    copy: u32,
}

impl Shifts {
    /// Takes the regions of a star.
    pub(super) fn load(
        &mut self,
        positions: &[Point],
        interface: &Interface,
        star: &Star,
        regions: &Regions,
        kept: Kept,
    ) {
        let at = |n: NodeId| positions[n.index()];
        self.at = at(star.node);
        self.lean = Point::ZERO;
        self.regions.clear();
        self.regions.resize(regions.all.len(), Shift::default());
        let region = |hex: usize| regions.of_hex[hex];
        self.bounds.load(positions, interface, star, region, kept);
        self.folds.load(positions, interface, star, regions);
        self.ridges.clear();
        let mut shortest = f64::INFINITY;
        for &(hex, corner, _) in &star.hexes {
            let nodes = &interface.hexes[hex as usize];
            for k in NEIGHBOURS[usize::from(corner)] {
                shortest = shortest.min(at(nodes[usize::from(k)]).distance_squared(self.at));
            }
        }
        self.distance = THICKNESS * shortest.sqrt();
        for region in 0..regions.all.len() {
            let is_on_boundary = self.bounds.all.iter().any(|bound| bound.region == region as u32);
            let (towards, is_on_ridge) = if is_on_boundary {
                self.along_boundary(positions, star, region as u32)
            } else {
                let center = mean_center(positions, interface, star, regions, region as u32);
                (Some(center - self.at), false)
            };
            let mut direction = towards.and_then(Point::try_normalize);
            // At a ridge only the region's own faces are to be had of their plane.
            let freedom = match (is_on_boundary, self.bounds.freedom(positions)) {
                (false, _) => Freedom::Free,
                (true, smooth @ Freedom::Plane(_)) => smooth,
                _ => Freedom::Fixed,
            };
            direction = direction.map(|direction| self.folds.steeper(region as u32, direction, freedom));
            self.regions[region] = Shift { is_on_boundary, is_on_ridge, direction, ..Shift::default() };
        }
        self.find_ridges(regions);
    }

    /// Which way a region that owns boundary faces moves, if it can; and whether it has a ridge of its own. It cannot move
    /// where faces between materials that it owns go all around the node, nor in line with an edge of the interface that
    /// lies on a ridge: the layer's hexes there would have three nodes on that.
    fn along_boundary(&self, positions: &[Point], star: &Star, region: u32) -> (Option<Point>, bool) {
        let own = || self.bounds.all.iter().filter(move |bound| bound.region == region);
        let Some(first) = own().next() else { return (None, false) };
        if !own().any(|bound| bound.has_ridge_to(first)) {
            let ends_twice = |end| own().filter(|bound| bound.ends.contains(&end)).count() == 2;
            if first.kind.is_inner() && own().flat_map(|bound| bound.ends).all(ends_twice) {
                return (None, false);
            }
            let (sum, count) = own().fold((Point::ZERO, 0.0), |(s, n), bound| (s + bound.center, n + 1.0));
            return (Some(sum / count - self.at), false);
        }
        let mut ends = self.bounds.ridge_pairs().filter(|(a, b, _)| a.region == region && b.region == region);
        let Some((_, _, end)) = ends.next() else { return (None, false) };
        let direction = positions[end.index()] - self.at;
        let is_alone = ends.all(|(.., other)| other == end);
        let unit = direction.normalize_or_zero();
        let is_along = |other: NodeId| {
            let edge = positions[other.index()] - self.at;
            edge.dot(unit).abs() > RIDGE * edge.length()
        };
        // A ridge of the boundary that one region has on both sides is a pinched edge: there fewer hexes are refined if it
        // is tried.
        let is_tried =
            |a: &Bound, b: &Bound| a.region == b.region && !a.kind.is_inner() && !b.kind.is_inner();
        let is_of_interface = |other: NodeId| interface_ends(star).any(|end| end == other);
        let in_line = |(a, b, other): (&Bound, &Bound, NodeId)| {
            !is_tried(a, b) && is_along(other) && is_of_interface(other)
        };
        let can_move = is_alone
            && own().all(|bound| bound.normal.dot(unit).abs() < ALONG)
            && !self.bounds.ridge_pairs().any(in_line);
        (can_move.then_some(direction), true)
    }

    /// Finds the ridges whose faces belong to regions of different sides.
    fn find_ridges(&mut self, regions: &Regions) {
        let is_refined = |bound: &Bound| regions.all[bound.region as usize].is_refined;
        let between = self.bounds.ridge_pairs().filter(|(a, b, _)| is_refined(a) != is_refined(b));
        let between: Vec<_> = between.map(|(a, b, end)| ([a.region, b.region], end)).collect();
        for (beside, end) in between {
            self.ridges.push(end);
            beside.into_iter().for_each(|region| self.regions[region as usize].is_at_ridge = true);
        }
    }

    /// The regions of a side that are at a ridge between the sides.
    fn at_ridge<'a>(&'a self, regions: &'a Regions, refined: bool) -> impl Iterator<Item = &'a Shift> {
        let of_side =
            regions.all.iter().zip(&self.regions).filter(move |(region, _)| region.is_refined == refined);
        of_side.map(|(_, shift)| shift).filter(|shift| shift.is_at_ridge)
    }

    /// Do all regions of the side that is to stay on the ridges keep the node?
    pub(super) fn keeps_ridges(&self, regions: &Regions, staying_side: Option<bool>) -> bool {
        staying_side.is_none_or(|refined| self.at_ridge(regions, refined).all(|shift| shift.keeps))
    }

    /// How steeply the regions of a side leave the interface: the least sine of their angles to it.
    pub(super) fn steepness(&self, regions: &Regions, refined: bool) -> f64 {
        let own = self.folds.mean_inward() * if refined { 1.0 } else { -1.0 };
        let of_side =
            regions.all.iter().zip(&self.regions).filter(|(region, _)| region.is_refined == refined);
        of_side.filter_map(|(_, shift)| shift.direction).map(|d| d.dot(own)).fold(1.0, f64::min)
    }

    /// Does the layer fold at the node for good? `freedom` tells where other nodes of the interface can go.
    pub(super) fn is_folded(&self, freedom: impl FnMut(NodeId) -> Freedom) -> bool {
        let moved = |region: u32| {
            let shift = &self.regions[region as usize];
            shift.direction.filter(|_| !shift.keeps).unwrap_or(Point::ZERO)
        };
        !self.bounds.all.is_empty() && self.folds.any(moved, freedom)
    }

    /// Must a side stay on the ridges, because regions of it cannot move, the outside joins them, or the other side's
    /// cannot all stay?
    pub(super) fn must_stay(&self, regions: &Regions, refined: bool) -> bool {
        if self.at_ridge(regions, !refined).nth(1).is_some() {
            return true;
        }
        let of_side =
            regions.all.iter().zip(&self.regions).filter(|(region, _)| region.is_refined == refined);
        of_side.into_iter().any(|(region, shift)| region.is_forced || shift.direction.is_none())
    }

    /// Chooses the region that keeps the node, one for each part of the star.
    pub(super) fn choose_keepers(
        &mut self,
        regions: &Regions,
        staying_side: Option<bool>,
        side_beside: Option<bool>,
    ) {
        for part in 0..regions.all.len() as u32 {
            let of_part = (0..regions.all.len()).filter(|&k| regions.all[k].part == part);
            let keeper = of_part.max_by_key(|&k| {
                let (region, shift) = (&regions.all[k], &self.regions[k]);
                (
                    region.is_forced,
                    staying_side == Some(region.is_refined),
                    shift.is_on_boundary,
                    shift.direction.is_none(),
                    side_beside == Some(region.is_refined),
                    region.degree,
                    region.is_refined,
                    std::cmp::Reverse(k),
                )
            });
            if let Some(keeper) = keeper {
                self.regions[keeper].keeps = true;
            }
        }
        let mut copies = 0;
        for shift in self.regions.iter_mut().filter(|shift| !shift.keeps) {
            copies += 1;
            shift.copy = copies;
        }
    }

    /// Can the regions of a side move?
    pub(super) fn can_leave(&self, regions: &Regions, refined: bool) -> bool {
        let mut of_side =
            regions.all.iter().zip(&self.regions).filter(|(region, _)| region.is_refined == refined);
        of_side.all(|(_, shift)| shift.direction.is_some())
    }

    /// Is there a region that must move and cannot?
    pub(super) fn is_stuck(&self) -> bool {
        self.regions.iter().any(|shift| !shift.keeps && shift.direction.is_none())
    }

    /// The number of a region's copy of the node, from 1; 0 is the node itself.
    pub(super) fn copy(&self, region: usize) -> u32 {
        self.regions[region].copy
    }

    /// Where the copies are, in order.
    pub(super) fn points(&self) -> impl Iterator<Item = Point> + '_ {
        let moved = self.regions.iter().filter(|shift| !shift.keeps);
        let kept = self.kept();
        moved.map(move |shift| kept + shift.direction.unwrap_or(Point::ZERO) * self.distance)
    }

    /// Where the node itself is from now on.
    pub(super) fn kept(&self) -> Point {
        self.at + self.lean
    }

    /// Leans the layer over to the side that leaves ridges beside the node along the interface's plane, so that it does not
    /// fold there: the angle between the two at the ridge is half a turn and more.
    pub(super) fn lean(&mut self, regions: &Regions, side_beside: Option<bool>) {
        let Some(side) = side_beside else { return };
        let [a, b] = [0, 1].map(|k| (regions.all.get(k), self.regions.get(k)));
        let (keeper, leaver) = if a.1.is_some_and(|shift| shift.keeps) { (a, b) } else { (b, a) };
        if let ((Some(region), Some(keeper)), (_, Some(leaver))) = (keeper, leaver)
            && regions.all.len() == 2
            && region.is_refined == side
            && keeper.is_on_boundary == leaver.is_on_boundary
            && !keeper.is_on_ridge
            && !leaver.is_on_ridge
            && let Some(direction) = leaver.direction
        {
            self.lean = direction * (LEAN * self.distance);
        }
    }
}

/// The nodes of the interface beside one. Its buffers serve one after another.
#[derive(Default)]
pub(super) struct Beside {
    star: Star,
    bounds: Bounds,
}

impl Beside {
    /// Where a node of the interface can go.
    pub(super) fn freedom(&mut self, positions: &[Point], interface: &Interface, node: NodeId) -> Freedom {
        let Some(place) = interface.place(node) else { return Freedom::Free };
        self.star.load(interface, place);
        self.bounds.load(positions, interface, &self.star, |_| 0, interface.kept());
        self.bounds.freedom(positions)
    }
}

/// The mean of the centers of a region's hexes.
fn mean_center(
    positions: &[Point],
    interface: &Interface,
    star: &Star,
    regions: &Regions,
    region: u32,
) -> Point {
    let (mut sum, mut count) = (Point::ZERO, 0.0);
    for (&(hex, ..), _) in star.hexes.iter().zip(&regions.of_hex).filter(|(_, r)| **r == region) {
        sum += interface.hexes[hex as usize].iter().map(|n| positions[n.index()]).sum::<Point>() / 8.0;
        count += 1.0;
    }
    sum / count
}
