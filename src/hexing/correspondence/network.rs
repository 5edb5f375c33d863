//! The solid's corners and curves as long as some of them are given up.
//!
//! The cyclic order of curves at a corner is the solid's, from the fan of triangles, and is kept: a curve that is
//! contracted leaves one corner with the curves of both, those of the other in its place.
//!
//! ```text
//!     a   d              a d
//!      \ /                \|
//!   b---A---B---e    b-----A---e      around A, from where B was: a, b, c of A, then f, e, d of B
//!      / \                /|
//!     c   f              c f
//! ```
//!
//! The angles between them are kept too: at both sides of a curve that is given up they become one.

use std::f64::consts::PI;

use super::boundary::Boundary;
use super::reduction::{CurveFate, LostCurve, Reason};
use crate::geometry::Point;
use crate::solid::{Arm, CornerId, CurveId, SolidModel};

pub(super) struct Network<'a> {
    pub solid: &'a SolidModel,
    /// The curves that end at each corner, anticlockwise seen from outside.
    arms: Vec<Vec<Arm>>,
    /// Per corner itself, or the one that it was joined to.
    joined_to: Vec<CornerId>,
    /// Per curve.
    fates: Vec<CurveFate>,
    /// Per curve its length, longer by what was contracted at its ends.
    lengths: Vec<f64>,
    pub lost: Vec<LostCurve>,
}

impl<'a> Network<'a> {
    pub fn of(solid: &'a SolidModel) -> Self {
        Self {
            solid,
            arms: solid.corners().iter().map(|corner| corner.arms.clone()).collect(),
            joined_to: (0..solid.corners().len()).map(CornerId::new).collect(),
            fates: vec![CurveFate::Captured; solid.curves().len()],
            lengths: solid.curves().iter().map(|curve| curve.length).collect(),
            lost: Vec::new(),
        }
    }

    /// The curves that are not given up, ascending.
    pub fn curves(&self) -> impl Iterator<Item = CurveId> + use<'_> {
        (0..self.fates.len()).map(CurveId::new).filter(|&c| self.is_kept(c))
    }

    pub fn is_kept(&self, curve: CurveId) -> bool {
        self.fate(curve) == CurveFate::Captured
    }

    pub fn fate(&self, curve: CurveId) -> CurveFate {
        self.fates[curve.index()]
    }

    /// The corners at a curve's ends; `None` if it has none.
    pub fn ends(&self, curve: CurveId) -> Option<[CornerId; 2]> {
        self.solid.curves()[curve.index()].ends.map(|ends| ends.map(|end| self.corner(end)))
    }

    /// The corner that stands for `corner`.
    pub fn corner(&self, corner: CornerId) -> CornerId {
        let up = self.joined_to[corner.index()];
        if up == corner { corner } else { self.corner(up) }
    }

    pub fn arms(&self, corner: CornerId) -> &[Arm] {
        &self.arms[corner.index()]
    }

    /// The outward unit normal so far along a curve from its start.
    pub fn normals_along(&self, curve: CurveId) -> impl Fn(f64) -> Point {
        let vertices = &self.solid.curves()[curve.index()].vertices;
        let place = |v: u32| self.solid.points()[v as usize];
        let ends = vertices.windows(2).scan(0.0, |end, ends| {
            *end += place(ends[0]).distance(place(ends[1]));
            Some(*end)
        });
        let ends: Vec<f64> = ends.collect();
        move |at| {
            let edge = ends.partition_point(|&end| end < at).min(ends.len() - 1);
            let both = [edge, edge + 1].map(|k| self.solid.normal_at(vertices[k]));
            both.iter().sum::<Point>().normalize_or_zero()
        }
    }

    /// Corners that stand for themselves, ascending, and either have a curve or never had one.
    pub fn standing_corners(&self) -> impl Iterator<Item = CornerId> + use<'_> {
        let stands = |&c: &CornerId| {
            let bare = self.solid.corners()[c.index()].arms.is_empty();
            self.corner(c) == c && (bare || !self.arms(c).is_empty())
        };
        (0..self.joined_to.len()).map(CornerId::new).filter(stands)
    }

    pub fn point(&self, corner: CornerId) -> Point {
        self.solid.corners()[corner.index()].point
    }

    /// The curve's length, from the corners that now stand at its ends.
    pub fn length(&self, curve: CurveId) -> f64 {
        self.lengths[curve.index()]
    }

    /// How far a curve is from smooth, in degrees.
    pub fn sharpness(&self, curve: CurveId) -> f64 {
        self.solid.curves()[curve.index()].sharpness()
    }

    pub fn fates(&self) -> &[CurveFate] {
        &self.fates
    }

    /// Gives a curve up: its corners become one if it has two, else nothing stands for it.
    pub fn contract(&mut self, curve: CurveId, reason: Reason) {
        let Some([a, b]) = self.ends(curve).filter(|[a, b]| a != b) else {
            return self.suppress(curve, reason);
        };
        // The corner with more curves stays.
        let stays = if (self.arms(b).len(), a) > (self.arms(a).len(), b) { b } else { a };
        let goes = if stays == a { b } else { a };
        let (mut joined, after) = self.arms_after(stays, curve);
        let (of_other, after_other) = self.arms_after(goes, curve);
        for arm in &of_other {
            self.lengths[arm.curve.index()] += self.length(curve);
        }
        // Along the curve it is half a turn at both of its sides.
        let mut beside = after_other - PI;
        if let Some(last) = joined.last_mut() {
            last.sector += std::mem::take(&mut beside);
        }
        joined.extend(of_other);
        if let Some(last) = joined.last_mut() {
            last.sector += beside + after - PI;
        }
        self.arms[stays.index()] = joined;
        self.arms[goes.index()].clear();
        self.joined_to[goes.index()] = stays;
        self.give_up(curve, CurveFate::Contracted, reason);
    }

    /// Gives a curve up: nothing stands for it.
    pub fn suppress(&mut self, curve: CurveId, reason: Reason) {
        for end in self.ends(curve).into_iter().flatten() {
            self.remove(end, curve);
        }
        self.give_up(curve, CurveFate::Suppressed, reason);
    }

    /// Takes the arms of a curve away from a corner.
    fn remove(&mut self, corner: CornerId, curve: CurveId) {
        let arms = &mut self.arms[corner.index()];
        while let Some(at) = arms.iter().position(|arm| arm.curve == curve) {
            let Arm { sector, .. } = arms.remove(at);
            if let Some(before) = at.checked_sub(1).or(arms.len().checked_sub(1)) {
                arms[before].sector += sector;
            }
        }
    }

    /// The arms of a corner from the one after `curve` to the one before it, and the angle before the first of them.
    fn arms_after(&self, corner: CornerId, curve: CurveId) -> (Vec<Arm>, f64) {
        let arms = self.arms(corner);
        let at = arms.iter().position(|arm| arm.curve == curve).unwrap_or(0);
        let around = arms[at..].iter().chain(&arms[..at]);
        (
            around.filter(|arm| arm.curve != curve).copied().collect(),
            arms.get(at).map_or(0.0, |arm| arm.sector),
        )
    }

    fn give_up(&mut self, curve: CurveId, fate: CurveFate, reason: Reason) {
        self.fates[curve.index()] = fate;
        let length = self.solid.curves()[curve.index()].length;
        let place = self.point_along(curve, 0.5 * length);
        self.lost.push(LostCurve { curve, fate, reason, place, length });
    }

    /// Points of a curve, so many that none of its others is farther than `spacing` from the nearest.
    pub fn samples(&self, curve: CurveId, spacing: f64) -> Vec<Point> {
        let points = self.solid.points();
        let vertices = &self.solid.curves()[curve.index()].vertices;
        let mut samples = vec![points[vertices[0] as usize]];
        // How far the walk has come since the last sample.
        let mut since = 0.0;
        for pair in vertices.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|v| points[v as usize]);
            let length = a.distance(b);
            let mut at = spacing - since;
            while at < length && spacing > 0.0 {
                samples.push(a + (b - a) * (at / length));
                at += spacing;
            }
            since = length - (at - spacing);
        }
        samples
    }

    /// The point of a curve at a distance along it from its start.
    pub fn point_along(&self, curve: CurveId, mut along: f64) -> Point {
        let points = self.solid.points();
        let vertices = &self.solid.curves()[curve.index()].vertices;
        for pair in vertices.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|v| points[v as usize]);
            let length = a.distance(b);
            if along < length {
                return a + (b - a) * (along / length).max(0.0);
            }
            along -= length;
        }
        points[vertices[vertices.len() - 1] as usize]
    }
}

/// Arcs shorter than this many local edges, such as run where edges are short, are contracted from the start.
const SHORT_ARC: f64 = 0.6;

/// Closed curves shorter than this many local edges are suppressed from the start: three edges would make a triangle
/// smaller than the quads around it.
const SHORT_LOOP: f64 = 2.5;

/// Gives up, shortest first, the curves that are too short for the edges of the boundary.
pub(super) fn give_up_short(network: &mut Network, boundary: &Boundary) {
    let is_short = |network: &Network, curve: CurveId| {
        let length = network.solid.curves()[curve.index()].length;
        let [start, middle, end] = [0.0, 0.5, 1.0].map(|share| network.point_along(curve, share * length));
        let is_arc = network.ends(curve).is_some_and(|[a, b]| a != b);
        if is_arc {
            network.length(curve) < SHORT_ARC * boundary.short_length_near(middle)
                && !boundary.has_edges(start, end)
        } else {
            network.length(curve) < SHORT_LOOP * boundary.length_near(middle)
        }
    };
    // Filled one by one, since what is collected is sorted first: each sort is some kilobytes of the modules.
    let mut queue = std::collections::BTreeSet::new();
    queue.extend(network.curves().map(|c| (network.length(c).to_bits(), c)));
    // Lengths are positive, so their bits are in their order. A curve that a contraction lengthens or closes is
    // looked at once more when it comes to its length.
    while let Some((bits, curve)) = queue.pop_first() {
        if !network.is_kept(curve) || !is_short(network, curve) {
            continue;
        }
        if network.length(curve).to_bits() != bits {
            queue.insert((network.length(curve).to_bits(), curve));
            continue;
        }
        let corners = network.ends(curve);
        network.contract(curve, Reason::Short);
        let arms = corners.into_iter().flatten().flat_map(|c| network.arms(network.corner(c)).to_vec());
        let closed: Vec<CurveId> = arms.map(|arm| arm.curve).collect();
        queue.extend(closed.into_iter().map(|c| (network.length(c).to_bits(), c)));
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::solid::testing::{ell, solid};

    fn around(network: &Network, corner: CornerId) -> f64 {
        network.arms(corner).iter().map(|arm| arm.sector).sum()
    }

    /// An angle is lost nowhere; along what is contracted it is half a turn on both sides.
    #[test]
    fn the_angles_beside_a_curve_become_one() {
        let solid = solid(&ell());
        for curve in (0..solid.curves().len()).map(CurveId::new) {
            let mut network = Network::of(&solid);
            let ends @ [a, b] = network.ends(curve).unwrap();
            let before = ends.map(|end| around(&network, end));
            network.suppress(curve, Reason::Costly);
            let after = ends.map(|end| around(&network, end));
            assert!((0..2).all(|k| (before[k] - after[k]).abs() < 1e-12), "{before:?} {after:?}");
            assert!(ends.iter().all(|&end| network.arms(end).len() == 2));

            let expected = before[0] + before[1] - 2.0 * PI;
            let mut network = Network::of(&solid);
            network.contract(curve, Reason::Short);
            let joined = network.corner(a);
            assert_eq!((network.arms(joined).len(), joined), (4, network.corner(b)));
            assert!((around(&network, joined) - expected).abs() < 1e-12);

            // The same where no other curve is left at one of its ends.
            for end in ends {
                let mut network = Network::of(&solid);
                for arm in solid.corners()[end.index()].arms.iter().filter(|arm| arm.curve != curve) {
                    network.suppress(arm.curve, Reason::Costly);
                }
                network.contract(curve, Reason::Short);
                let joined = network.corner(end);
                assert_eq!(network.arms(joined).len(), 2);
                assert!((around(&network, joined) - expected).abs() < 1e-12);
            }
        }
    }
}
