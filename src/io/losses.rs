//! What a format has no room for: to be told before or after a file is written.

use super::tag_numbers::{Label, labels};
use super::{AnyMesh, Document, Format, msh};
use crate::mesh::{FaceGroups, TagSet, Tags};

/// Combinations of groups that are named.
const NAMED: usize = 4;

/// What a file of `format` cannot say of the groups of a document, a sentence each; nothing where all of it is kept.
///
/// VTK, VTU and MEDIT have one number for a cell, so that each combination of groups is one more number; VTU has their names
/// and numbers beside, which other programs do not read. MSH has numbers from 1 to 2^31 - 1, one a name.
pub fn losses(document: &Document, format: Format) -> Vec<String> {
    let groups = match &document.mesh {
        AnyMesh::Hexes(mesh) => Some(&mesh.groups),
        AnyMesh::Polygons(_) | AnyMesh::Quads(_) => None,
    };
    losses_of(&document.tags, groups, format)
}

/// As [`losses`], of the tags of a surface, or of those of hexes and the groups of their faces.
pub(crate) fn losses_of(tags: &Tags, groups: Option<&FaceGroups>, format: Format) -> Vec<String> {
    let of_cells = loss(if groups.is_some() { "hexes" } else { "faces" }, tags, format);
    let of_faces = groups.and_then(|groups| loss("faces of hexes", groups.tags(), format));
    of_cells.into_iter().chain(of_faces).collect()
}

fn loss(what: &str, tags: &Tags, format: Format) -> Option<String> {
    let is_lost: fn(&TagSet) -> bool = match format {
        Format::Vtk | Format::Medit => |set| labels(set).len() > 1,
        Format::Vtu => |set| labels(set).iter().filter(|label| label.number.is_some()).count() > 1,
        Format::Msh => {
            let others = msh::renumbered(tags);
            return (!others.is_empty()).then(|| {
                format!(
                    "groups of {what} get other numbers, as MSH has numbers from 1 to 2147483647 and one name for each: {}",
                    first(&others)
                )
            });
        }
        Format::Obj | Format::Stl | Format::Inp | Format::Glb => return None,
    };
    let words = |set: &TagSet| labels(set).iter().map(Label::to_string).collect::<Vec<String>>().join(" + ");
    let lost: Vec<String> = tags.sets.iter().filter(|set| is_lost(set)).map(words).collect();
    let name = match format {
        Format::Medit => "MEDIT",
        Format::Vtk => "VTK",
        _ => "VTU",
    };
    let keeps = if format == Format::Vtu {
        "; programs that do not read its field TagNames see no others"
    } else {
        "; write MSH or INP to keep all of them"
    };
    (!lost.is_empty()).then(|| {
        format!(
            "{what} in several groups have one number for each combination, as {name} holds one a cell{keeps}: {}",
            first(&lost)
        )
    })
}

/// The first few in words.
fn first(names: &[String]) -> String {
    let more = if names.len() > NAMED { ", \u{2026}" } else { "" };
    format!("{}{more}", names[..names.len().min(NAMED)].join(", "))
}
