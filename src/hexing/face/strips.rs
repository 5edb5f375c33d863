//! Narrow strips between arcs, such as thin walls seen along the direction: nodes on both sides stand across from each other.
//!
//! ```text
//!   +-----+-----+----+            Each side by itself: cells lean, the more so the narrower the strip.
//!    \     \     \    \
//!     +-----+-----+----+
//! ```
//!
//! 1. Two arcs that are nowhere farther apart than half an edge are the sides of a strip. Both get as many segments as either,
//!    and so many that cells bend no farther from the arcs than a share of the strip's width.
//! 2. On the first side nodes stand in its sharp turns, and evenly between them; on the other one nearest to those.

use glam::DVec2;

use super::course::Course;
use crate::geometry::BoxIndex;
use crate::mesh::topology::Sets;

/// Arcs that are nowhere farther apart than this are the sides of a narrow strip: half an edge.
const NARROW: f64 = 0.25;

/// Places of an arc, evenly spread, that are looked at for how wide a strip is.
const LOOKS: usize = 8;

/// A turn by more than this, in degrees, is sharp: cells of a strip end there.
const SHARP: f64 = 20.0;

/// The share of a strip's width that half segments may be from its sides.
const BENT: f64 = 0.15;

/// How many times as many segments a side may get for that.
const MOST: usize = 16;

/// Half segments across from each other are no shorter than this share of what they would be.
const LEAST_STEP: f64 = 0.2;

/// The strips between some arcs.
pub(super) struct Strips<'a> {
    courses: &'a [Course],
    /// For each arc its strip, which may have more than two sides.
    pub(super) strip: Vec<u32>,
    /// How wide the narrowest strip beside each arc is.
    width: Vec<f64>,
    /// For each arc, the first one on the other side of a strip, if it is an earlier one.
    pub(super) across: Vec<Option<usize>>,
}

impl<'a> Strips<'a> {
    /// Those between all arcs, or those of the outline alone.
    pub(super) fn between(courses: &'a [Course], all: bool) -> Self {
        let bounds: Vec<_> = courses.iter().map(Course::bounds).collect();
        let index = BoxIndex::new(bounds.clone());
        let mut sets = Sets::new(courses.len());
        let (mut width, mut across) = (vec![f64::INFINITY; courses.len()], vec![None; courses.len()]);
        let is_side = |arc: usize| all || courses[arc].outline;
        for (arc, around) in bounds.iter().enumerate().filter(|&(arc, _)| is_side(arc)) {
            let is_like = |other: &usize| {
                let (a, b) = (around, &bounds[*other]);
                *other > arc
                    && is_side(*other)
                    && (a.min - b.min).abs().max((a.max - b.max).abs()).max_element() < NARROW
            };
            for other in index.touching(&around.grown(NARROW)).filter(is_like) {
                let Some(apart) = width_between(&courses[arc], &courses[other]) else { continue };
                sets.join(arc as u32, other as u32, false);
                [arc, other].into_iter().for_each(|side| width[side] = apart.min(width[side]));
                let first = across[other].get_or_insert(arc);
                *first = arc.min(*first);
            }
        }
        Self { courses, strip: sets.numbers(), width, across }
    }

    /// How many segments each arc gets.
    pub(super) fn counts(&self) -> Vec<usize> {
        let mut most = vec![0; self.courses.len()];
        for (arc, course) in self.courses.iter().enumerate() {
            let least = course.count();
            let mut count = least;
            while self.width[arc].is_finite()
                && count < MOST * least
                && self.bend(arc, count) > BENT * self.width[arc]
            {
                count *= 2;
            }
            let most = &mut most[self.strip[arc] as usize];
            *most = count.max(*most);
        }
        self.strip.iter().map(|&strip| most[strip as usize]).collect()
    }

    /// How far half segments are from the arc in their middle, at most, if there are so many segments.
    fn bend(&self, arc: usize, count: usize) -> f64 {
        let course = &self.courses[arc];
        let quarters = self.shares(arc, count, 4);
        let bend = |three: &[f64]| {
            let [a, middle, b] = [0, 1, 2].map(|k| course.at(three[k]));
            middle.distance(a.midpoint(b))
        };
        quarters.windows(3).step_by(2).map(bend).fold(0.0, f64::max)
    }

    /// The ends and middles of so many segments of an arc, along it: across from those of an earlier arc, of which there are as
    /// many.
    pub(super) fn halves(&self, arc: usize, count: usize, earlier: Option<&[DVec2]>) -> Vec<DVec2> {
        let course = &self.courses[arc];
        let earlier = earlier.filter(|earlier| earlier.len() == 2 * count + 1);
        let across = earlier.and_then(|earlier| across(course, earlier));
        let shares = across.unwrap_or_else(|| self.shares(arc, count, 2));
        shares.into_iter().map(|share| course.at(if share > 1.0 { share - 1.0 } else { share })).collect()
    }

    /// The shares of an arc's length where parts of so many segments end, each of as many `parts`: they are as long as each
    /// other, but for those of a strip's sides, where segments end in sharp turns.
    fn shares(&self, arc: usize, count: usize, parts: usize) -> Vec<f64> {
        let mut knots = vec![(0, 0.0)];
        if self.width[arc].is_finite() {
            for (_, share) in self.courses[arc].turns().filter(|&(turn, _)| turn > SHARP) {
                let place = (share * count as f64).round() as usize;
                if place > knots[knots.len() - 1].0 && place < count {
                    knots.push((place, share));
                }
            }
        }
        knots.push((count, 1.0));
        let mut shares = vec![0.0];
        for pair in knots.windows(2) {
            let [(from, start), (to, end)] = [pair[0], pair[1]];
            let steps = parts * (to - from);
            shares.extend((1..=steps).map(|k| start + (end - start) * k as f64 / steps as f64));
        }
        shares
    }
}

/// How wide the strip between two arcs is, if it is narrow from end to end, and longer than wide.
fn width_between(a: &Course, b: &Course) -> Option<f64> {
    let length = a.length().min(b.length());
    let limit = NARROW.min(0.5 * length);
    let mut width = 0.0_f64;
    for k in 0..=LOOKS {
        for (from, to) in [(a, b), (b, a)] {
            let p = from.at(k as f64 / LOOKS as f64);
            width = width.max(to.at(to.nearest(p)).distance(p));
        }
        if width >= limit {
            return None;
        }
    }
    (a.closed == b.closed).then_some(width)
}

/// The shares of an arc that are nearest to those points, from end to end, if they follow each other as the points do. One that
/// may start anywhere starts beside the first point, and has shares above one.
fn across(course: &Course, points: &[DVec2]) -> Option<Vec<f64>> {
    let parts = points.len() - 1;
    let mut shares: Vec<f64> = points.iter().map(|&p| course.nearest(p)).collect();
    if course.is_loose {
        let first = shares[0];
        let after = |share: f64| if share < first { share + 1.0 } else { share };
        shares.iter_mut().for_each(|share| *share = after(*share));
        if shares[1] > shares[parts - 1] {
            shares[0] = first + 1.0;
            shares.reverse();
        }
        (shares[0], shares[parts]) = (first, first + 1.0);
    } else {
        if shares[1] > shares[parts - 1] {
            shares.reverse();
        }
        (shares[0], shares[parts]) = (0.0, 1.0);
    }
    let least = LEAST_STEP / parts as f64;
    shares.windows(2).all(|pair| pair[1] - pair[0] >= least).then_some(shares)
}

#[cfg(test)]
mod tests {
    use super::super::graph::{Graph, Segment};
    use super::*;

    /// The curves through these points.
    fn courses(curves: &[Vec<DVec2>]) -> Vec<Course> {
        let mut graph = Graph::default();
        for curve in curves {
            let is_closed = curve[0] == curve[curve.len() - 1];
            let points = &curve[..curve.len() - usize::from(is_closed)];
            let ids: Vec<u32> = points.iter().map(|&p| graph.add(p, !is_closed)).collect();
            let ends = |k: usize| [ids[k % ids.len()], ids[(k + 1) % ids.len()]];
            let segments = (0..curve.len() - 1).map(|k| Segment { ends: ends(k), outline: true });
            graph.segments.extend(segments);
            if !is_closed {
                ids[1..ids.len() - 1].iter().for_each(|&p| graph.kept[p as usize] = false);
            }
        }
        graph.arcs().iter().map(|arc| Course::new(&graph, arc)).collect()
    }

    /// Of both curves, where segments and their halves end.
    fn both(curves: [Vec<DVec2>; 2]) -> [Vec<DVec2>; 2] {
        let courses = courses(&curves);
        let strips = Strips::between(&courses, true);
        let counts = strips.counts();
        assert_eq!((counts[0], strips.across[1]), (counts[1], Some(0)));
        let first = strips.halves(0, counts[0], None);
        let other = strips.halves(1, counts[1], Some(&first));
        [first, other]
    }

    fn line(points: &[[f64; 2]]) -> Vec<DVec2> {
        points.iter().map(|&p| DVec2::from(p)).collect()
    }

    fn arc(radius: f64, angles: [f64; 2], pieces: u32) -> Vec<DVec2> {
        let angle = |k: u32| angles[0] + (angles[1] - angles[0]) * f64::from(k) / f64::from(pieces);
        let at = |k: u32| DVec2::from(<[f64; 2]>::from(libm::sincos(angle(k)))) * radius;
        let mut points: Vec<DVec2> = (0..=pieces).map(at).collect();
        if angles[1] - angles[0] == std::f64::consts::TAU {
            points[pieces as usize] = points[0];
        }
        points
    }

    #[test]
    fn nodes_stand_across_from_each_other_whichever_way_sides_run() {
        // A strip that turns by 30 degrees at a third: its outer side is longer, and would get a segment more.
        let turn = 30.0_f64.to_radians();
        let (way, width) = (DVec2::new(libm::cos(turn), libm::sin(turn)), 0.1);
        let miter = width * libm::tan(turn / 2.0);
        let outer = vec![DVec2::ZERO, DVec2::new(1.7, 0.0), DVec2::new(1.7, 0.0) + way * 2.82];
        let inner_turn = DVec2::new(1.7 - miter, width);
        let inner_end = outer[2] + way.perp() * width;
        let inner = vec![DVec2::new(0.0, width), inner_turn, inner_end];
        let [first, other] = both([outer.clone(), inner.clone()]);
        assert!(first.contains(&outer[1]), "a node in the turn: {first:?}");
        let lean =
            |a: &[DVec2], b: &[DVec2]| a.iter().zip(b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        assert!(lean(&first, &other) < width * 1.05, "{first:?} {other:?}");
        let [first, mut other] = both([outer, inner.into_iter().rev().collect()]);
        other.reverse();
        assert!(lean(&first, &other) < width * 1.05, "{first:?} {other:?}");
    }

    #[test]
    fn segments_are_as_short_as_the_bend_of_a_narrow_strip_needs() {
        let quarter = [0.0, std::f64::consts::FRAC_PI_2];
        for (width, expected) in [(0.2, 2), (0.05, 4), (0.01, 8)] {
            let [first, other] = both([arc(1.0, quarter, 90), arc(1.0 + width, quarter, 90)]);
            assert_eq!((first.len(), other.len()), (2 * expected + 1, 2 * expected + 1), "{width}");
        }
    }

    #[test]
    fn closed_sides_start_across_from_each_other() {
        let tau = std::f64::consts::TAU;
        for from in [0.0, 2.0] {
            let [first, other] = both([arc(3.0, [0.0, tau], 400), arc(3.1, [from, from + tau], 400)]);
            let apart = first.iter().zip(&other).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
            assert!(apart < 0.11, "{from}: {apart}");
        }
    }

    #[test]
    fn arcs_that_are_far_or_not_across_are_no_strip() {
        let base = line(&[[0.0, 0.0], [4.0, 0.0]]);
        for other in [
            line(&[[0.0, 0.3], [4.0, 0.3]]),
            line(&[[0.0, 0.1], [2.0, 0.1]]),
            line(&[[4.0, 0.1], [8.0, 0.1]]),
            line(&[[0.0, 0.0], [4.0, 0.4]]),
        ] {
            let courses = courses(&[base.clone(), other]);
            let strips = Strips::between(&courses, true);
            assert_eq!(strips.across, [None, None]);
            assert_ne!(strips.strip[0], strips.strip[1]);
        }
    }
}
