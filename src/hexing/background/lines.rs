//! Where the lines of an aligned grid stand along one axis.
//!
//! 1. Planar surfaces perpendicular to the axis with more than half of a square of edges, the larger first, take a line
//!    unless there is one within .45 edges: so thin that cells still are good. Those of a solid that is thinner than that, such as
//!    a sheet, both do, however thin it is. So do, where that is wanted, both sides of a wall, or of a slot.
//! 2. Between two such lines cells are alike and about an edge long.
//! 3. Beyond the first and the last, or everywhere if there are none, cells are an edge long.

use crate::parallel::put_greatest_first;

/// Share of a square of edges: a smaller surface moves no line.
const LEAST_AREA: f64 = 0.5;
/// Share of an edge: lines are no closer.
pub(in super::super) const LEAST_GAP: f64 = 0.45;
/// Share of an edge: surfaces that are no further apart share a line.
const SAME: f64 = 0.01;
/// Lines beyond the solid on each side: what touches it has cells around it.
const BEYOND: f64 = 3.0;

/// A planar surface perpendicular to the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    /// Where along the axis.
    pub at: f64,
    /// Its area.
    pub area: f64,
    /// Is the solid below it?
    pub is_above: bool,
    /// Where it is across the axis.
    pub across: [[f64; 2]; 2],
}

impl Plane {
    /// Is there a wall between this plane and another, or a slot, with sides of about so large an area at least?
    fn faces(&self, other: &Self, area: f64) -> bool {
        let both = |k: usize| {
            let ([a, b], [c, d]) = (self.across[k], other.across[k]);
            (b.min(d) - a.max(c)).max(0.0)
        };
        self.is_above != other.is_above && both(0) * both(1) > area
    }
}

/// The lines around a solid that reaches from `least` to `most`, ascending, [`BEYOND`] it on both sides. `shift` is a
/// share of an edge, 0 to 1: lines that no surface holds move by it, and between lines that surfaces hold there are
/// more, the larger it is. `holds_walls` says whether both sides of walls and slots hold lines.
pub(super) fn lines(
    [least, most]: [f64; 2],
    planes: &[Plane],
    edge: f64,
    shift: f64,
    holds_walls: bool,
) -> Vec<f64> {
    let held = held([least, most], planes, edge, holds_walls);
    let (Some(&first), Some(&last)) = (held.first(), held.last()) else {
        let steps = (((most - least) / edge - SAME).ceil()).max(1.0);
        let first = (least + most) / 2.0 + (shift - 0.5 * steps) * edge;
        return outwards(vec![first], [least, most], edge);
    };
    let mut lines = vec![first];
    for pair in held.windows(2) {
        let steps = steps(pair[1] - pair[0], edge, shift);
        lines.extend((1..steps).map(|k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / f64::from(steps)));
        lines.push(pair[1]);
    }
    debug_assert!(lines.last() == Some(&last));
    outwards(lines, [least, most], edge)
}

/// Cells between two lines. Only where there is room for it do more lines not make them much shorter.
fn steps(gap: f64, edge: f64, shift: f64) -> u32 {
    let edges = gap / edge;
    let more = if edges > 3.0 { shift } else { 0.0 };
    (edges + more).round().max(1.0) as u32
}

/// The lines that surfaces hold, ascending.
fn held([least, most]: [f64; 2], planes: &[Plane], edge: f64, holds_walls: bool) -> Vec<f64> {
    let is_at = |plane: &&Plane, end: f64| (plane.at - end).abs() < 0.25 * (most - least);
    let area = |end: f64| planes.iter().filter(|p| is_at(p, end)).map(|plane| plane.area).sum::<f64>();
    let is_held = |end: f64| area(end) > LEAST_AREA * edge * edge;
    if most - least < LEAST_GAP * edge && is_held(least) && is_held(most) {
        return vec![least, most];
    }
    let mut groups = groups(planes, edge);
    groups.retain(|group| group.area > LEAST_AREA * edge * edge || holds_walls && group.length() > edge);
    put_greatest_first(&mut groups, |group| group.area);
    let mut held: Vec<Group> = Vec::new();
    for group in groups {
        let place = held.partition_point(|line| line.at < group.at);
        let mut beside = held[place.saturating_sub(1)..].iter().take(if place > 0 { 2 } else { 1 });
        let has_room = |line: &Group| {
            (line.at - group.at).abs() >= LEAST_GAP * edge || holds_walls && line.faces(&group, edge)
        };
        if beside.all(has_room) {
            held.insert(place, group);
        }
    }
    held.into_iter().map(|group| group.at).collect()
}

/// Are there walls or slots so thin that lines stand in both their sides only where that is wanted?
pub(super) fn has_walls([least, most]: [f64; 2], planes: &[Plane], edge: f64) -> bool {
    let held = |holds_walls| held([least, most], planes, edge, holds_walls);
    let is_thin = |pair: &[f64]| pair[1] - pair[0] < LEAST_GAP * edge;
    held(true).windows(2).any(is_thin) && held(true) != held(false)
}

/// Surfaces of one plane.
#[derive(Clone)]
struct Group {
    /// Where the largest is.
    at: f64,
    /// Of all.
    area: f64,
    planes: Vec<Plane>,
}

impl Group {
    /// The greatest length of a surface: of the end of a wall that is thin.
    fn length(&self) -> f64 {
        let lengths = self.planes.iter().flat_map(|plane| plane.across.map(|[least, most]| most - least));
        lengths.fold(0.0, f64::max)
    }

    fn faces(&self, other: &Self, edge: f64) -> bool {
        let area = LEAST_AREA * edge * edge;
        self.planes.iter().any(|plane| other.planes.iter().any(|other| plane.faces(other, area)))
    }
}

/// The planes, as far as surfaces share them.
fn groups(planes: &[Plane], edge: f64) -> Vec<Group> {
    let mut sorted = planes.to_vec();
    put_greatest_first(&mut sorted, |plane| -plane.at);
    let of = |group: &[Plane]| {
        let largest = group.iter().fold(group[0], |a, &b| if b.area > a.area { b } else { a });
        Group { at: largest.at, area: group.iter().map(|plane| plane.area).sum(), planes: group.to_vec() }
    };
    sorted.chunk_by(|a, b| b.at - a.at <= SAME * edge).map(of).collect()
}

/// Adds lines an edge apart on both sides, until they are beyond the solid.
fn outwards(mut lines: Vec<f64>, [least, most]: [f64; 2], edge: f64) -> Vec<f64> {
    let (first, last) = (lines[0], lines[lines.len() - 1]);
    let count = |reach: f64| (reach / edge + BEYOND).ceil().max(0.0) as u32;
    let below = (1..=count(first - least)).rev().map(|k| first - f64::from(k) * edge);
    let above = (1..=count(most - last)).map(|k| last + f64::from(k) * edge);
    lines.splice(0..0, below);
    lines.extend(above);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(at: f64, area: f64) -> Plane {
        Plane { at, area, is_above: true, across: [[0.0, area], [0.0, 1.0]] }
    }

    /// The lines within the solid.
    fn within(extent: [f64; 2], planes: &[Plane], shift: f64) -> Vec<f64> {
        let all = lines(extent, planes, 1.0, shift, false);
        assert!(all.windows(2).all(|pair| (LEAST_GAP..1.6).contains(&(pair[1] - pair[0]))), "{all:?}");
        assert!(all[2] < extent[0] && all[all.len() - 3] > extent[1], "{all:?}");
        all.into_iter().filter(|line| (extent[0]..=extent[1]).contains(line)).collect()
    }

    #[test]
    fn planes_hold_lines_and_cells_between_them_are_alike() {
        let found = within([0.0, 7.3], &[plane(0.0, 10.0), plane(7.3, 10.0), plane(2.4, 1.0)], 0.0);
        let expected = [0.0, 1.2, 2.4, 3.38, 4.36, 5.34, 6.32, 7.3];
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        assert!([0.0, 2.4, 7.3].iter().all(|at| found.contains(at)), "exactly at the planes");
    }

    #[test]
    fn of_planes_too_close_the_larger_and_of_small_ones_none_hold_a_line() {
        assert!(
            !within([0.0, 5.0], &[plane(0.0, 9.0), plane(5.0, 9.0), plane(0.4, 8.0)], 0.0).contains(&0.4)
        );
        assert!(within([0.0, 5.0], &[plane(0.0, 7.0), plane(5.0, 9.0), plane(0.4, 8.0)], 0.0).contains(&0.4));
        assert!(!within([0.0, 5.0], &[plane(0.0, 7.0), plane(2.2, 0.5)], 0.0).contains(&2.2));
        // Two halves of one plane count together.
        let halves = [plane(0.0, 7.0), plane(2.2, 0.4), plane(2.2, 0.3)];
        assert!(within([0.0, 5.0], &halves, 0.0).contains(&2.2));
    }

    #[test]
    fn both_sides_of_a_sheet_hold_lines() {
        let between = |sides: &[Plane]| {
            let all = lines([0.0, 0.1], sides, 1.0, 0.0, false);
            all.into_iter().filter(|line| (0.0..=0.1).contains(line)).collect::<Vec<_>>()
        };
        assert_eq!(between(&[plane(1e-9, 9.0), plane(0.1, 9.0)]), [0.0, 0.1]);
        assert_eq!(between(&[plane(0.0, 9.0), plane(0.1, 0.2), plane(0.1, 0.4)]), [0.0, 0.1]);
        // A disc with a pin, whose end is as large as half a square of edges at most.
        assert_eq!(between(&[plane(0.0, 9.0), plane(0.1, 0.5), plane(0.03, 8.0)]).len(), 1);
    }

    /// A plane that looks up, or down, where `x` is so along the first axis across, and `y` along the second.
    fn facing(is_above: bool, at: f64, across: [[f64; 2]; 2]) -> Plane {
        let area = across.map(|[a, b]| b - a).iter().product();
        Plane { at, area, is_above, across }
    }

    #[test]
    fn both_sides_of_walls_and_slots_hold_lines_where_that_is_wanted() {
        let wide = [[0.0, 9.0], [0.0, 5.0]];
        let between = |planes: &[Plane], holds_walls: bool| {
            let all = lines([0.0, 5.0], planes, 1.0, 0.0, holds_walls);
            all.into_iter().filter(|line| (0.0..1.0).contains(line)).collect::<Vec<_>>()
        };
        let wall = [facing(false, 0.0, wide), facing(true, 0.1, wide)];
        assert_eq!([between(&wall, false).len(), between(&wall, true).len()], [1, 2]);
        assert!(has_walls([0.0, 5.0], &wall, 1.0));
        // A slot between two walls: each plane faces those beside it.
        let slot = [wall.as_slice(), &[facing(false, 0.15, wide), facing(true, 0.3, wide)]].concat();
        assert_eq!(between(&slot, true), [0.0, 0.1, 0.15, 0.3]);
        // A step, and planes that are not across from each other.
        let step = [facing(true, 0.0, wide), facing(true, 0.1, wide)];
        let aside = [facing(false, 0.0, wide), facing(true, 0.1, [[9.5, 20.0], [0.0, 5.0]])];
        for planes in [step, aside] {
            assert_eq!(between(&planes, true).len(), 1, "{planes:?}");
            assert!(!has_walls([0.0, 5.0], &planes, 1.0));
        }
    }

    #[test]
    fn the_end_of_a_thin_wall_holds_a_line_where_walls_do() {
        let end =
            [facing(false, 0.0, [[0.0, 9.0], [0.0, 5.0]]), facing(true, 3.3, [[0.0, 0.05], [0.0, 5.0]])];
        let held = |holds_walls| lines([0.0, 3.3], &end, 1.0, 0.0, holds_walls).contains(&3.3);
        assert_eq!([held(false), held(true)], [false, true]);
        assert!(!has_walls([0.0, 3.3], &end, 1.0), "no wall is across");
    }

    #[test]
    fn without_planes_lines_stand_evenly_about_the_middle() {
        assert_eq!(within([-1.5, 1.5], &[], 0.0), [-1.5, -0.5, 0.5, 1.5]);
        assert_eq!(within([-1.5, 1.5], &[], 0.5), [-1.0, 0.0, 1.0]);
        assert_eq!(within([-0.2, 0.2], &[], 0.5), [0.0]);
    }

    #[test]
    fn a_shift_puts_more_lines_where_there_is_room() {
        let ends = [plane(0.0, 9.0), plane(4.0, 9.0)];
        assert_eq!(within([0.0, 4.0], &ends, 0.0).len(), 5);
        assert_eq!(within([0.0, 4.0], &ends, 0.5).len(), 6);
    }
}
