//! Triangles in pieces.

use crate::geometry::Point;

/// Halves a triangle across its longest edge, and its halves, until `is_small` says so of a piece, and calls `take` with
/// the pieces. Their number grows with the area, and with the length of slivers.
pub(super) fn pieces(
    corners: [Point; 3],
    is_small: impl Fn(&[Point; 3]) -> bool,
    take: &mut impl FnMut([Point; 3]),
) {
    let mut left = vec![corners];
    while let Some(piece) = left.pop() {
        if is_small(&piece) {
            take(piece);
            continue;
        }
        // a-b is the longest edge.
        let [a, b, c] = piece;
        let (ab, bc, ca) = (a.distance_squared(b), b.distance_squared(c), c.distance_squared(a));
        let [a, b, c] = match () {
            () if ab >= bc && ab >= ca => [a, b, c],
            () if bc >= ca => [b, c, a],
            () => [c, a, b],
        };
        let middle = a.midpoint(b);
        left.extend([[a, middle, c], [middle, b, c]]);
    }
}
