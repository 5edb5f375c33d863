//! Files that JavaScript gave.

use std::collections::BTreeMap;

use super::errors::Failure;
use super::pool::on_pool;
use crate::io::losses::losses_of;
use crate::io::{self, Document, Format};
use crate::mesh::{FaceGroups, Tags};

/// What a file of the named format holds; without a name the content tells the format.
///
/// # Errors
/// What the format's reader refuses, and unknown formats.
pub(super) fn read(bytes: &[u8], format: Option<String>) -> Result<Document, Failure> {
    let format = format.map_or_else(|| Ok(io::detect(bytes)?), |name| format_named(&name))?;
    Ok(on_pool(|| io::read(bytes, format))?)
}

/// What files of each format cannot say of groups, by the formats' names; formats that keep all are left out.
pub(super) fn losses(tags: &Tags, groups: Option<&FaceGroups>) -> BTreeMap<&'static str, Vec<String>> {
    let mut of_formats = BTreeMap::new();
    for format in Format::ALL {
        let losses = losses_of(tags, groups, format);
        if !losses.is_empty() {
            of_formats.insert(format.name(), losses);
        }
    }
    of_formats
}

/// The format of a name that JavaScript gave.
pub(super) fn format_named(name: &str) -> Result<Format, Failure> {
    Format::from_extension(name).ok_or_else(|| {
        let known: Vec<_> = Format::ALL.iter().map(|f| f.name()).collect();
        let message = format!("there is no format {name:?}; the formats are {}", known.join(", "));
        Failure::options("format-unknown", &message)
    })
}
