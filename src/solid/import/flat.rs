//! Flips flat triangles away: those with a corner on the opposite edge, which have no normal.
//!
//! ```text
//!   a---c---b          a---c---b     The flat triangle a b c and its neighbour d b a become two of the
//!    \     /     ->     \  |  /      neighbour's kind. Nothing moves but by the height of the flat one.
//!     \   /              \ | /
//!      \ /                \|/
//!       d                  d
//! ```

use crate::geometry::Point;
use crate::mesh::FaceId;
use crate::solid::shell::{Shell, next, previous, triangle_of};

/// Rows of points on an edge take a round a triangle of the row, at most.
const ROUNDS: usize = 64;

/// Flips the triangles that are lower than `tolerance`, where that gives higher ones. Returns how many.
pub(super) fn flip(shell: &mut Shell, face_of: &mut [FaceId], tolerance: f64) -> usize {
    let height = |shell: &Shell, t: usize| lowest(shell.mesh.at(t)).0;
    let mut flat: Vec<usize> = (0..face_of.len()).filter(|&t| height(shell, t) < tolerance).collect();
    let mut flipped = 0;
    for _ in 0..ROUNDS {
        let mut left = Vec::new();
        let before = flipped;
        for &t in &flat {
            let (low, side) = lowest(shell.mesh.at(t));
            let k = 3 * t as u32 + side;
            let [a, b, c, d] = [k, next(k), previous(k), previous(shell.twin(k))].map(|l| shell.from(l));
            let [pa, pb, pc, pd] = [a, b, c, d].map(|v| shell.mesh.points[v as usize]);
            let gained = lowest([pa, pd, pc]).0.min(lowest([pb, pc, pd]).0);
            let is_new = c != d && shell.fan(previous(k)).all(|l| shell.to(l) != d);
            if low < tolerance && is_new && gained > low {
                let neighbour = triangle_of(shell.twin(k));
                shell.flip(k);
                face_of[t] = face_of[neighbour];
                flipped += 1;
                left.extend([t, neighbour]);
            } else if low < tolerance {
                left.push(t);
            }
        }
        if flipped == before {
            break;
        }
        left.retain(|&t| height(shell, t) < tolerance);
        left.sort_unstable();
        left.dedup();
        flat = left;
    }
    flipped
}

/// The least height of a triangle and the side it stands on, the longest.
fn lowest(corners: [Point; 3]) -> (f64, u32) {
    let [a, b, c] = corners;
    let lengths = [a.distance(b), b.distance(c), c.distance(a)];
    let side = (0..3).fold(0, |best, i| if lengths[i] > lengths[best] { i } else { best });
    let twice = (b - a).cross(c - a).length();
    (if lengths[side] > 0.0 { twice / lengths[side] } else { 0.0 }, side as u32)
}
