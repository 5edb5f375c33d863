//! Reads legacy VTK: the header, and one section after the other.

use super::attributes::{Array, read_attribute};
use super::cells::{CellList, read_cells};
use super::file::LegacyFile;
use super::structured::{Kind, Structured, cell_types, push_cells};
use crate::geometry::Point;
use crate::io::cell_collector::CellCollector;
use crate::io::refusal::{code, excerpt, refuse, refuse_not_finite};
use crate::io::scalars::Scalar;
use crate::io::tag_numbers::Names;
use crate::io::vtk_cells::{CellData, collect_cells, is_wanted};
use crate::io::{Document, Format, ReadError};

/// The mesh in a legacy VTK file.
pub fn read(bytes: &[u8]) -> Result<Document, ReadError> {
    let mut file = LegacyFile::open(bytes)?;
    let mut grid = Grid { size: bytes.len(), ..Grid::default() };
    // What the attributes to come belong to: how many there are, and whether they are cells.
    let mut owner = None;
    while let Some(word) = file.tokens.next() {
        let section = word.to_ascii_uppercase();
        match section.as_slice() {
            b"CELL_DATA" => owner = Some((file.number("the number of cells")?, true)),
            b"POINT_DATA" => owner = Some((file.number("the number of points")?, false)),
            b"METADATA" => file.skip_metadata(),
            _ if grid.read_section(&section, &mut file)? => {}
            _ => {
                let (count, of_cells) = owner.unwrap_or((0, false));
                let arrays = read_attribute(&mut file, &section, count)?;
                let Some(arrays) = arrays else {
                    let message = format!("{} is no section of the format", excerpt(word));
                    return Err(file.tokens.refuse(code::SYNTAX, message));
                };
                for array in arrays {
                    grid.cell_data.note(&array.name);
                    if of_cells && is_wanted(&array.name) {
                        grid.arrays.push(array);
                    }
                }
            }
        }
    }
    grid.finish()
}

/// The sections so far. The four lists of polygonal data stand in the order of its cell data.
#[derive(Default)]
struct Grid {
    /// The size of the file.
    size: usize,
    has_dataset: bool,
    /// The dataset, if it is structured.
    structured: Option<Structured>,
    positions: Vec<Point>,
    cells: CellList,
    types: Vec<i64>,
    polygonal: [CellList; 3],
    cell_data: CellData,
    /// The arrays of cells that are read.
    arrays: Vec<Array>,
}

/// VTK types of the cells in `VERTICES`, `LINES` and `POLYGONS`.
const POLYGONAL_TYPES: [i64; 3] = [2, 4, 7];

impl Grid {
    /// Reads a section of the grid itself; false if `section` is none.
    fn read_section(&mut self, section: &[u8], file: &mut LegacyFile<'_>) -> Result<bool, ReadError> {
        if let Some(structured) = &mut self.structured {
            if section == b"POINTS" && structured.has_points() {
                self.positions = read_points(file)?;
                return Ok(true);
            }
            if section != b"DATASET" {
                return structured.read_section(section, file);
            }
        }
        match section {
            b"DATASET" => self.read_dataset(file)?,
            b"POINTS" => self.positions = read_points(file)?,
            b"CELLS" => self.cells = read_cells(file)?,
            b"CELL_TYPES" => {
                let count = file.number("the number of cell types")?;
                file.start_data();
                self.types = file.integers(count, Scalar::Signed(4), "the cell types")?;
            }
            b"VERTICES" => self.polygonal[0] = read_cells(file)?,
            b"LINES" => self.polygonal[1] = read_cells(file)?,
            b"POLYGONS" => self.polygonal[2] = read_cells(file)?,
            b"TRIANGLE_STRIPS" => {
                if !read_cells(file)?.ends.is_empty() {
                    let message = "triangle strips are not read — turn them into triangles first";
                    return Err(file.tokens.refuse(code::UNSUPPORTED_CELL, message));
                }
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn read_dataset(&mut self, file: &mut LegacyFile<'_>) -> Result<(), ReadError> {
        if std::mem::replace(&mut self.has_dataset, true) {
            return Err(file.tokens.refuse(code::SYNTAX, "the file has a second dataset"));
        }
        let name = file.tokens.expect("the kind of dataset")?.to_ascii_uppercase();
        let kind = match name.as_slice() {
            b"UNSTRUCTURED_GRID" | b"POLYDATA" => return Ok(()),
            b"STRUCTURED_POINTS" => Kind::Points,
            b"RECTILINEAR_GRID" => Kind::Rectilinear,
            b"STRUCTURED_GRID" => Kind::Grid,
            _ => {
                let message = format!(
                    "the dataset is {}; unstructured and structured grids, structured points, rectilinear grids and \
                     polygonal data are read — convert it, in ParaView for instance",
                    excerpt(&name)
                );
                return Err(file.tokens.refuse(code::UNSUPPORTED_FEATURE, message));
            }
        };
        self.structured = Some(Structured::new(kind, self.size));
        Ok(())
    }

    fn finish(mut self) -> Result<Document, ReadError> {
        if let Some(structured) = self.structured.take() {
            let points = std::mem::take(&mut self.positions);
            let (positions, dimensions) = structured.positions(points)?;
            let mut types = cell_types(dimensions);
            let mut collector = CellCollector::new(Format::Vtk, positions.len(), 0);
            self.hide(&mut collector, types.len(), &mut types)?;
            push_cells(&mut collector, dimensions, &types)?;
            let (attributes, dropped_arrays) = self.cell_data.attributes(&types, &Names::default());
            return Ok(Document { dropped_arrays, ..collector.finish(positions, attributes)? });
        }
        for (list, number) in self.polygonal.iter().zip(POLYGONAL_TYPES) {
            self.types.resize(self.types.len() + list.ends.len(), number);
            self.cells.append(list);
        }
        let mut collector = CellCollector::new(Format::Vtk, self.positions.len(), 0);
        let mut types = std::mem::take(&mut self.types);
        self.hide(&mut collector, self.cells.ends.len(), &mut types)?;
        collect_cells(&mut collector, Format::Vtk, &self.cells.nodes, &self.cells.ends, &types)?;
        let (attributes, dropped_arrays) = self.cell_data.attributes(&types, &Names::default());
        Ok(Document { dropped_arrays, ..collector.finish(self.positions, attributes)? })
    }

    /// Looks at what the arrays say of `count` cells of the given types, and takes those that are hidden for cells of no type.
    fn hide(
        &mut self,
        collector: &mut CellCollector,
        count: usize,
        types: &mut [i64],
    ) -> Result<(), ReadError> {
        for Array { name, line, numbers } in std::mem::take(&mut self.arrays) {
            let Some(numbers) = numbers else { continue };
            if numbers.len() != count {
                let (name, found) = (excerpt(name.as_bytes()), numbers.len());
                let message = format!("the array {name} holds {found} numbers, but there are {count} cells");
                return Err(refuse(Format::Vtk, line, code::INCONSISTENT, message));
            }
            self.cell_data.add(&name, 0, numbers);
        }
        collector.hide(self.cell_data.hide(types));
        Ok(())
    }
}

fn read_points(file: &mut LegacyFile<'_>) -> Result<Vec<Point>, ReadError> {
    let count = file.number("the number of points")?;
    let scalar = file.scalar()?;
    file.start_data();
    if file.is_binary() {
        let values = file.column(count.saturating_mul(3), scalar, "the points")?.into_floats();
        return Ok(values.chunks_exact(3).map(|p| Point::new(p[0], p[1], p[2])).collect());
    }
    file.check_words(count.saturating_mul(3), "the points")?;
    let mut positions = Vec::with_capacity(count);
    for node in 0..count {
        let mut coordinate = || file.tokens.float("the points");
        let position = Point::new(coordinate()?, coordinate()?, coordinate()?);
        if !position.is_finite() {
            return Err(refuse_not_finite(Format::Vtk, file.tokens.line(), node));
        }
        positions.push(position);
    }
    Ok(positions)
}
