//! Groups that one sheet has to lie over, since it would be pinched at a corner.
//!
//! ```text
//!   around a corner v with four surfaces, the curves between them:
//!
//!        A                    A          A sheet over A alone takes the old v along. What is left has two curves, those
//!     1  |  2              1  |  2       between B, C and D, and its copy of v would have to be on both. Over A and D
//!   D ---v--- B   is     D ---v'-- B     together it leaves one curve, on which its copy v' is.
//!     4  |  3                 |  3
//!        C                    C
//! ```
//!
//! A sheet that leaves two surfaces at a corner, or fewer, is not pinched there; in the end it is closed. Between the two
//! groups there are two hexes then, for which there is the more room the more flatly they meet.

use super::need::{CurveEdge, Look};
use crate::mesh::NodeId;
use crate::solid::CurveId;

/// The group to unite with a `group` whose sheet would be pinched at the nodes `pinched`, which are ascending: of those
/// beside it there that take a sheet one that has none yet, and of these the one that it meets most flatly. None if there is
/// none.
pub(super) fn partner(
    look: &Look,
    group: u32,
    pinched: &[NodeId],
    takes_sheet: impl Fn(u32) -> bool,
    has_none: impl Fn(u32) -> bool,
) -> Option<u32> {
    let other = |edge: &CurveEdge| match edge.quads.map(|quad| look.group(quad)) {
        [a, b] if a == group && b != group => Some(b),
        [a, b] if a != group && b == group => Some(a),
        _ => None,
    };
    let is_pinched = |edge: &&CurveEdge| edge.ends.iter().any(|n| pinched.binary_search(n).is_ok());
    let edges = look.curve_edges();
    let beside = edges.iter().filter(is_pinched).filter_map(|edge| Some((other(edge)?, edge.curve)));
    let order = |&(a, over_a): &(u32, CurveId), &(b, over_b): &(u32, CurveId)| {
        let flatter = look.groups.angle(over_a).total_cmp(&look.groups.angle(over_b));
        has_none(a).cmp(&has_none(b)).then(flatter).then(b.cmp(&a))
    };
    beside.filter(|&(other, _)| takes_sheet(other)).max_by(order).map(|(other, _)| other)
}
