//! Binary STL.

use super::facets::{MOST, document};
use crate::geometry::Point;
use crate::io::refusal::{code, refuse};
use crate::io::{Document, Format, ReadError};
use crate::mesh::Tags;

/// Bytes before the facets: 80 free ones and their number.
pub(super) const HEAD: usize = 84;
/// Bytes of a facet.
const FACET: usize = 50;
/// Bytes of a facet's normal, which come first.
const NORMAL: usize = 12;

/// The number of facets that a binary file names.
pub(super) fn facet_count(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(80..HEAD)?;
    Some(u32::from_le_bytes([count[0], count[1], count[2], count[3]]))
}

/// The length of a binary file with so many facets.
pub(super) fn length(count: u32) -> u64 {
    HEAD as u64 + FACET as u64 * u64::from(count)
}

/// The mesh of a binary file of at least [`HEAD`] bytes. What follows the facets is left alone.
pub(super) fn read(bytes: &[u8]) -> Result<Document, ReadError> {
    let count = facet_count(bytes).unwrap_or_default();
    if length(count) > bytes.len() as u64 {
        let message = format!(
            "the number of facets (byte 80) is {count}, which take {} bytes, but the file has {} — it is cut short or \
             damaged, or no STL file",
            length(count),
            bytes.len()
        );
        return Err(refuse(Format::Stl, None, code::TRUNCATED, message));
    }
    if count as usize > MOST {
        let message = format!("the file has {count} facets (byte 80), more than {MOST}: split it");
        return Err(refuse(Format::Stl, None, code::TOO_LARGE, message));
    }
    let mut vertices = Vec::with_capacity(3 * count as usize);
    for (f, facet) in bytes[HEAD..].chunks_exact(FACET).take(count as usize).enumerate() {
        for (v, vertex) in facet[NORMAL..FACET - 2].chunks_exact(12).enumerate() {
            let number = |i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|b| vertex[4 * i + b]));
            let point = Point::from([0, 1, 2].map(|i| f64::from(number(i))));
            if !point.is_finite() {
                let byte = HEAD + f * FACET + NORMAL + 12 * v;
                let message =
                    format!("byte {byte}: vertex {v} of facet {f} has a coordinate that is no finite number");
                return Err(refuse(Format::Stl, None, code::NOT_FINITE, message));
            }
            vertices.push(point);
        }
    }
    document(vertices, Tags::default())
}
