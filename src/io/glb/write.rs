//! Writes GLB.

use super::json::json_of;
use super::shape::Shape;
use crate::io::cell_view::CellView;
use crate::io::refusal::{code, refuse_writing};
use crate::io::{Document, Format, WriteError};

/// What to write beside the faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlbOptions {
    /// The edges of the mesh as lines.
    pub edges: bool,
}

impl Default for GlbOptions {
    fn default() -> Self {
        Self { edges: true }
    }
}

/// The mesh as a GLB with its edges.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    write_with(document, GlbOptions::default())
}

/// The mesh as a GLB.
pub fn write_with(document: &Document, options: GlbOptions) -> Result<Vec<u8>, WriteError> {
    let view = CellView::new(document, Format::Glb)?;
    if view.cells.len() == 0 {
        return Err(refuse_writing(
            Format::Glb,
            code::NO_CELLS,
            "the mesh has no faces; there is nothing to show",
        ));
    }
    let shape = Shape::of(&view, options.edges);
    if shape.positions.as_flattened().iter().any(|coordinate| !coordinate.is_finite()) {
        let message = "the mesh is larger than single precision can say (3e38); scale it down";
        return Err(refuse_writing(Format::Glb, code::TOO_LARGE, message));
    }
    let json = json_of(&shape, view.tags).to_string();
    let mut data = Vec::new();
    numbers(&mut data, shape.positions.as_flattened(), f32::to_le_bytes);
    for triangles in shape.triangles.values() {
        numbers(&mut data, triangles.as_flattened(), u32::to_le_bytes);
    }
    numbers(&mut data, shape.edges.as_flattened(), u32::to_le_bytes);
    assemble(json.into_bytes(), &data)
}

fn numbers<T: Copy>(data: &mut Vec<u8>, numbers: &[T], bytes: fn(T) -> [u8; 4]) {
    data.reserve(4 * numbers.len());
    data.extend(numbers.iter().flat_map(|&number| bytes(number)));
}

/// Header, chunk of JSON, chunk of data: each chunk padded to four bytes.
fn assemble(mut json: Vec<u8>, data: &[u8]) -> Result<Vec<u8>, WriteError> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + json.len() + 8 + data.len();
    let Ok(total) = u32::try_from(total) else {
        let message = format!(
            "the file would take {total} bytes, more than the 4 GiB of the format; show a coarser mesh"
        );
        return Err(refuse_writing(Format::Glb, code::TOO_LARGE, message));
    };
    let mut file = Vec::with_capacity(total as usize);
    file.extend_from_slice(b"glTF");
    file.extend_from_slice(&2_u32.to_le_bytes());
    file.extend_from_slice(&total.to_le_bytes());
    for (kind, chunk) in [(b"JSON", json.as_slice()), (b"BIN\0", data)] {
        file.extend_from_slice(&(chunk.len() as u32).to_le_bytes());
        file.extend_from_slice(kind);
        file.extend_from_slice(chunk);
    }
    Ok(file)
}
