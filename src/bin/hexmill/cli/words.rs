//! Numbers in words.

use std::fmt::Display;

/// So many of something, such as `1 hex` and `2 hexes`.
pub(super) fn counted<N: Display + PartialEq + From<u8>>(count: N, one: &str, many: &str) -> String {
    let noun = if count == N::from(1) { one } else { many };
    format!("{count} {noun}")
}
