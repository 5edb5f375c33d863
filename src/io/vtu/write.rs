//! Writes VTU.

use std::borrow::Cow;

use super::TAG_NAMES;
use crate::io::cell_view::{CellView, Cells, GroupedFaces};
use crate::io::refusal::{code, refuse_writing};
use crate::io::tag_numbers::names_to_json;
use crate::io::text::Text;
use crate::io::vtk_cells::{LEVEL, PARENT, TAG, cell_type, face_type};
use crate::io::{Document, Format, WriteError};
use crate::parallel;

/// Bytes of an array that are compressed together: enough that a block pays its own start, little
/// enough that a small mesh keeps several threads busy.
const BLOCK: usize = 1 << 20;

/// zlib's level. Above 1 the time grows several times for a few percent of size.
const COMPRESSION_LEVEL: u8 = 1;

/// The file as bytes: the same for any number of threads.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    let view = CellView::new(document, Format::Vtu)?;
    let mut file = File::default();
    file.header
        .word("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"");
    file.header.word(if cfg!(target_endian = "big") { "BigEndian" } else { "LittleEndian" });
    file.header.word("\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n");
    if let Some(names) = names_to_json(view.tags, view.groups.tags()) {
        file.header.word("<FieldData>\n");
        let attributes = format!("NumberOfTuples=\"{}\"", names.len());
        file.array(TAG_NAMES, "UInt8", &attributes, &names);
        file.header.word("</FieldData>\n");
    }
    file.header.word("<Piece NumberOfPoints=\"").integer(view.positions.len());
    let faces = view.grouped_faces();
    file.header.word("\" NumberOfCells=\"").integer(view.cells.len() + faces.len()).word("\">\n<Points>\n");
    let coordinates = bytemuck::cast_slice(&view.positions);
    file.array("Points", "Float64", "NumberOfComponents=\"3\"", coordinates);
    file.header.word("</Points>\n<Cells>\n");
    write_cells(&mut file, view.cells, &faces)?;
    file.header.word("</Cells>\n<CellData>\n");
    write_cell_data(&mut file, &view);
    file.header.word("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    let mut bytes = file.header.into_bytes();
    bytes.reserve_exact(file.appended.len() + 32);
    bytes.append(&mut file.appended);
    bytes.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    Ok(bytes)
}

/// The cells, then the faces that are in groups.
fn write_cells(file: &mut File, cells: Cells<'_>, faces: &GroupedFaces) -> Result<(), WriteError> {
    let corners = match faces.nodes.as_slice() {
        [] => Cow::Borrowed(cells.corners()),
        nodes => Cow::Owned([cells.corners(), nodes].concat()),
    };
    let (kind, corners) = signed(bytemuck::cast_slice(&corners));
    file.array("connectivity", kind, "", &corners);
    let mut ends: Cow<'_, [u32]> = match cells {
        Cells::Polygons(mesh) => Cow::Borrowed(&mesh.offsets[1..]),
        Cells::Quads(quads) => Cow::Owned(regular_ends(quads.len(), 4)?),
        Cells::Hexes(hexes) => Cow::Owned(regular_ends(hexes.len(), 8)?),
        Cells::SecondOrder(hexes) => Cow::Owned(regular_ends(cells.len(), hexes.hex.nodes())?),
    };
    if faces.len() > 0 {
        let after = cells.corners().len();
        if u32::try_from(after + faces.nodes.len()).is_err() {
            return Err(too_many(cells.len() + faces.len()));
        }
        ends.to_mut().extend((1..=faces.len()).map(|face| (after + faces.size * face) as u32));
    }
    let (kind, ends) = signed(&ends);
    file.array("offsets", kind, "", &ends);
    let mut types: Vec<u8> = (0..cells.len()).map(|cell| cell_type(cells, cell)).collect();
    types.resize(types.len() + faces.len(), face_type(faces.size));
    file.array("types", "UInt8", "", &types);
    Ok(())
}

fn write_cell_data(file: &mut File, view: &CellView<'_>) {
    if !view.level.is_empty() {
        file.array(LEVEL, "UInt8", "", &view.with_grouped_faces(view.level));
    }
    if !view.parent.is_empty() {
        let parents = view.with_grouped_faces(view.parent);
        let (kind, parents) = signed(bytemuck::cast_slice(&parents));
        file.array(PARENT, kind, "", &parents);
    }
    let numbers = view.numbers();
    if !numbers.is_empty() {
        match numbers.iter().map(|&number| i32::try_from(number)).collect::<Result<Vec<i32>, _>>() {
            Ok(narrow) => file.array(TAG, "Int32", "", bytemuck::cast_slice(&narrow)),
            Err(_) => file.array(TAG, "Int64", "", bytemuck::cast_slice(&numbers)),
        }
    }
}

/// Where the cells end in the connectivity if each has `size` nodes.
fn regular_ends(count: usize, size: usize) -> Result<Vec<u32>, WriteError> {
    if u32::try_from(count * size).is_err() {
        return Err(too_many(count));
    }
    Ok((1..=count).map(|cell| (cell * size) as u32).collect())
}

fn too_many(cells: usize) -> WriteError {
    let message = format!("{cells} cells have more than 2^32 corners; split the mesh");
    refuse_writing(Format::Vtu, code::TOO_LARGE, message)
}

/// The ids as bytes of VTK's signed integers: of 32 bits where they fit.
fn signed(ids: &[u32]) -> (&'static str, Cow<'_, [u8]>) {
    if !parallel::any(ids.len(), |k| ids[k] > i32::MAX as u32) {
        return ("Int32", Cow::Borrowed(bytemuck::cast_slice(ids)));
    }
    let wide: Vec<i64> = ids.iter().map(|&id| i64::from(id)).collect();
    ("Int64", Cow::Owned(bytemuck::cast_slice(&wide).to_vec()))
}

/// The XML so far, and the data that it points into.
#[derive(Default)]
struct File {
    header: Text,
    appended: Vec<u8>,
}

impl File {
    /// Adds an array: its element to the XML, its data in compressed blocks to the appended part.
    fn array(&mut self, name: &str, kind: &str, attributes: &str, data: &[u8]) {
        let offset = self.appended.len();
        self.header.word("<DataArray type=\"").word(kind).word("\" Name=\"").word(name).word("\" ");
        if !attributes.is_empty() {
            self.header.word(attributes).word(" ");
        }
        self.header.word("format=\"appended\" offset=\"").integer(offset).word("\"/>\n");
        let blocks: Vec<Vec<u8>> = parallel::blocks(data.len(), BLOCK, |block| {
            miniz_oxide::deflate::compress_to_vec_zlib(&data[block], COMPRESSION_LEVEL)
        });
        let sizes = [blocks.len(), BLOCK, data.len() % BLOCK];
        for size in sizes.into_iter().chain(blocks.iter().map(Vec::len)) {
            self.appended.extend_from_slice(&(size as u64).to_ne_bytes());
        }
        for block in blocks {
            self.appended.extend_from_slice(&block);
        }
    }
}
