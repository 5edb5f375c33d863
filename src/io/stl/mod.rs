//! STL (3D Systems, "StereoLithography Interface Specification", 1988), ASCII and binary. Only read: what is written of a
//! mesh in STL has lost how its faces hang together.
//!
//! An ASCII file holds solids of facets, keywords in any case:
//!
//! ```text
//! solid NAME
//!   facet normal NX NY NZ
//!     outer loop
//!       vertex X Y Z          three of them
//!     endloop
//!   endfacet
//! endsolid NAME
//! ```
//!
//! A binary file is 80 free bytes, the number of facets (u32), and 50 bytes a facet: normal and three vertices as f32,
//! and two bytes that are free; little-endian. Many begin with `solid` too, so the length
//! decides which it is, and where that fits none whether there are zeros in the head.
//!
//! Vertices with the same coordinates become one node. Normals are not taken: the order of the vertices says the same.
//! The name of a solid becomes the tag `object` of its faces.

mod ascii;
mod binary;
mod facets;

use super::refusal::{code, excerpt, refuse};
use super::{Document, Format, ReadError};

/// The mesh in an STL file.
///
/// # Errors
/// With the line, or in a binary file the byte.
pub fn read(bytes: &[u8]) -> Result<Document, ReadError> {
    if is_binary(bytes) {
        return binary::read(bytes);
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    // The number of facets of a binary file, however it begins, has a zero.
    let is_text = !bytes[..bytes.len().min(binary::HEAD)].contains(&0);
    if starts_as_ascii(text) && is_text {
        return ascii::read(text);
    }
    if bytes.len() < binary::HEAD {
        let message = match bytes {
            [] => "the file is empty".into(),
            _ => format!("the file begins with {}, not with solid", excerpt(bytes)),
        };
        return Err(refuse(Format::Stl, 1, code::NOT_THIS_FORMAT, message));
    }
    binary::read(bytes)
}

/// Has the file the length of a binary STL file with the number of facets that it names?
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    binary::facet_count(bytes).is_some_and(|count| count > 0 && bytes.len() as u64 == binary::length(count))
}

/// Is the text that of an ASCII STL file, as far as its beginning says?
pub(super) fn is_ascii(text: &[u8]) -> bool {
    const HEAD: usize = 1024;
    let head = text[..text.len().min(HEAD)].to_ascii_lowercase();
    starts_as_ascii(text) && memchr::memmem::find(&head, b"facet").is_some()
}

fn starts_as_ascii(text: &[u8]) -> bool {
    let first = text.split(u8::is_ascii_whitespace).find(|word| !word.is_empty());
    first.is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}
