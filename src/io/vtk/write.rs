//! Writes legacy VTK.

use crate::io::cell_view::CellView;
use crate::io::refusal::{code, refuse_writing};
use crate::io::text::Text;
use crate::io::vtk_cells::{LEVEL, PARENT, TAG, cell_type, face_type};
use crate::io::{Document, Format, WriteError};

/// The file as bytes: the same for any number of threads.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    let view = CellView::new(document, Format::Vtk)?;
    let (cells, nodes, faces) = (view.cells, view.positions.len(), view.grouped_faces());
    let count = cells.len() + faces.len();
    let entries = count + cells.corners().len() + faces.nodes.len();
    if i32::try_from(entries).is_err() || i32::try_from(nodes).is_err() {
        let message = "the mesh has more than 2^31 nodes or corners, too many for this format; write VTU";
        return Err(refuse_writing(Format::Vtk, code::TOO_LARGE, message));
    }
    let mut file = Text::default();
    file.word("# vtk DataFile Version 3.0\nhexmill\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ");
    file.integer(nodes).word(" double\n");
    file.items(nodes, |line, node| {
        let p = view.positions[node];
        line.float(p.x).word(" ").float(p.y).word(" ").float(p.z).word("\n");
    });
    file.word("CELLS ").integer(count).word(" ").integer(entries).word("\n");
    file.items(count, |line, cell| {
        let nodes = cell.checked_sub(cells.len()).map_or_else(|| cells.nodes(cell), |face| faces.face(face));
        line.integer(nodes.len());
        for node in nodes {
            line.word(" ").integer(node.0);
        }
        line.word("\n");
    });
    file.word("CELL_TYPES ").integer(count).word("\n");
    let of_faces = face_type(faces.size);
    column(&mut file, count, |cell| if cell < cells.len() { cell_type(cells, cell) } else { of_faces });
    write_cell_data(&mut file, &view);
    Ok(file.into_bytes())
}

fn write_cell_data(file: &mut Text, view: &CellView<'_>) {
    let numbers = view.numbers();
    if view.level.is_empty() && view.parent.is_empty() && numbers.is_empty() {
        return;
    }
    file.word("CELL_DATA ").integer(view.cells.len() + view.groups.sides().len()).word("\n");
    let scalars = |file: &mut Text, name: &str, kind: &str| {
        file.word("SCALARS ").word(name).word(" ").word(kind).word(" 1\nLOOKUP_TABLE default\n");
    };
    if !view.level.is_empty() {
        scalars(file, LEVEL, "int");
        let level = view.with_grouped_faces(view.level);
        column(file, level.len(), |cell| level[cell]);
    }
    if !view.parent.is_empty() {
        scalars(file, PARENT, "unsigned_int");
        let parent = view.with_grouped_faces(view.parent);
        column(file, parent.len(), |cell| parent[cell].0);
    }
    if !numbers.is_empty() {
        let is_wide = numbers.iter().any(|&number| i32::try_from(number).is_err());
        scalars(file, TAG, if is_wide { "long" } else { "int" });
        column(file, numbers.len(), |cell| numbers[cell]);
    }
}

/// A number a line.
fn column<T: itoa::Integer>(file: &mut Text, count: usize, number: impl Fn(usize) -> T + Sync) {
    file.items(count, |line, index| {
        line.integer(number(index)).word("\n");
    });
}
