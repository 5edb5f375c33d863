//! A surface as OBJ text.

use crate::geometry::Point;
use crate::io::{AnyMesh, Document, Format, WriteError};
use crate::mesh::{Features, NodeId, TagSet, Tags};

/// Bytes that a vertex or a face takes, about.
const BYTES_PER_LINE: usize = 40;

/// Writes the surface of `document` with its tags and features. Coordinates are written with as few
/// digits as read back to the same double.
///
/// Blanks in a group's name become `_`, since OBJ parts groups by blanks; a group's number becomes the
/// group `tag_N`. Levels and parents have no place in OBJ.
///
/// # Errors
/// If the document holds hexes, or a coordinate that is not finite.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    let mut writer = Writer { out: b"# hexmill\n".to_vec(), integer: itoa::Buffer::new() };
    let (nodes, cells) = (document.mesh.node_count(), document.mesh.cell_count());
    writer.out.reserve((nodes + cells) * BYTES_PER_LINE);
    match &document.mesh {
        AnyMesh::Polygons(mesh) => {
            writer.vertices(&mesh.positions)?;
            writer.features(&mesh.features);
            writer.faces(mesh.faces(), &document.tags);
        }
        AnyMesh::Quads(mesh) => {
            writer.vertices(&mesh.positions)?;
            writer.faces(mesh.quads.iter().map(<[NodeId; 4]>::as_slice), &document.tags);
        }
        AnyMesh::Hexes(_) => {
            let message = "OBJ holds no hexes: write VTU, VTK, MSH, INP or MEDIT".to_owned();
            return Err(WriteError { format: Format::Obj, code: "format-holds-no-hexes", message });
        }
    }
    Ok(writer.out)
}

struct Writer {
    out: Vec<u8>,
    integer: itoa::Buffer,
}

impl Writer {
    fn vertices(&mut self, positions: &[Point]) -> Result<(), WriteError> {
        let mut buffer = zmij::Buffer::new();
        for (node, position) in positions.iter().enumerate() {
            if !position.is_finite() {
                let message =
                    format!("node {node} stands at {position}, which is not finite: mend the mesh first");
                return Err(WriteError { format: Format::Obj, code: "coordinate-not-finite", message });
            }
            self.out.push(b'v');
            for coordinate in position.to_array() {
                self.out.push(b' ');
                let text = buffer.format_finite(coordinate);
                self.out.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
            }
            self.out.push(b'\n');
        }
        Ok(())
    }

    fn features(&mut self, features: &Features) {
        for polyline in &features.polylines {
            self.indices(b'l', polyline);
        }
        if let Some(rule) = features.interpolate_boundary {
            self.out.extend_from_slice(format!("t interpolateboundary 1/0/0 {rule}\n").as_bytes());
        }
        for ([a, b], sharpness) in &features.creases {
            self.out.extend_from_slice(format!("t crease 2/1/0 {a} {b} {sharpness:?}\n").as_bytes());
        }
        for (node, sharpness) in &features.corners {
            self.out.extend_from_slice(format!("t corner 1/1/0 {node} {sharpness:?}\n").as_bytes());
        }
    }

    fn faces<'a>(&mut self, faces: impl Iterator<Item = &'a [NodeId]>, tags: &Tags) {
        let untagged = TagSet::default();
        let mut current = &untagged;
        for (face, nodes) in faces.enumerate() {
            let names = tags.of(face).unwrap_or(&untagged);
            if !std::ptr::eq(names, current) {
                self.names(current, names);
                current = names;
            }
            self.indices(b'f', nodes);
        }
    }

    /// Writes what changes from the names `before` to the names `now`.
    fn names(&mut self, before: &TagSet, now: &TagSet) {
        if before.object != now.object {
            self.name("o", now.object.iter().map(|name| one_line(name)));
        }
        if (&before.groups, before.number) != (&now.groups, now.number) {
            let names = now.groups.iter().filter(|group| !group.name.is_empty());
            let names = names.map(|group| one_word(&group.name));
            let own = now.number.filter(|_| now.groups.iter().all(|group| group.number != now.number));
            let numbers = own.into_iter().chain(now.groups.iter().filter_map(|group| group.number));
            self.name("g", names.chain(numbers.map(|number| format!("tag_{number}"))));
        }
        if before.material != now.material {
            self.name("usemtl", now.material.iter().map(|name| one_line(name)));
        }
    }

    fn name(&mut self, keyword: &str, names: impl Iterator<Item = String>) {
        self.out.extend_from_slice(keyword.as_bytes());
        for name in names {
            self.out.push(b' ');
            self.out.extend_from_slice(name.as_bytes());
        }
        self.out.push(b'\n');
    }

    fn indices(&mut self, keyword: u8, nodes: &[NodeId]) {
        self.out.push(keyword);
        for node in nodes {
            self.out.push(b' ');
            self.out.extend_from_slice(self.integer.format(u64::from(node.0) + 1).as_bytes());
        }
        self.out.push(b'\n');
    }
}

/// `name` as the rest of a line can hold it: ends of lines become blanks, and no `\` ends it.
fn one_line(name: &str) -> String {
    let name: String = name.chars().map(|c| if c.is_ascii_control() { ' ' } else { c }).collect();
    name.trim_ascii().trim_end_matches('\\').to_owned()
}

/// `name` as one word of a line.
fn one_word(name: &str) -> String {
    let is_blank = |c: char| c.is_ascii_control() || c == ' ';
    let name: String = name.chars().map(|c| if is_blank(c) { '_' } else { c }).collect();
    // A '#' would start a comment and a '\' at the end of the line would continue it.
    name.trim_end_matches('\\').replacen('#', "_", usize::from(name.starts_with('#')))
}
