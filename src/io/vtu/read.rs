//! Reads VTU.

use super::TAG_NAMES;
use super::array::{Decoder, Wanted};
use super::xml::{DataArray, Piece, parse};
use crate::geometry::Point;
use crate::io::cell_collector::CellCollector;
use crate::io::refusal::{code, refuse, refuse_not_finite};
use crate::io::tag_numbers::{Names, names_from_json};
use crate::io::vtk_cells::{CellData, collect_cells, is_wanted};
use crate::io::{Document, Format, ReadError};

/// The mesh in a VTU file.
pub fn read(bytes: &[u8]) -> Result<Document, ReadError> {
    let file = parse(bytes)?;
    let decoder = Decoder::new(bytes, &file);
    let mut grid = Grid::default();
    for piece in &file.pieces {
        grid.add(&decoder, piece)?;
    }
    let mut named = Names::default();
    if let Some(array) = file.field_data.iter().find(|array| array.name == TAG_NAMES)
        && let Some(json) = decoder.decode(array, None)?.into_integers()
    {
        let json: Vec<u8> = json.into_iter().filter_map(|b| u8::try_from(b).ok()).collect();
        named = names_from_json(&json);
    }
    let mut collector = CellCollector::new(Format::Vtu, grid.positions.len(), 0);
    collector.hide(grid.cell_data.hide(&mut grid.types));
    collect_cells(&mut collector, Format::Vtu, &grid.connectivity, &grid.ends, &grid.types)?;
    let (attributes, dropped_arrays) = grid.cell_data.attributes(&grid.types, &named);
    Ok(Document { dropped_arrays, ..collector.finish(grid.positions, attributes)? })
}

/// The pieces so far, as one grid.
#[derive(Default)]
struct Grid {
    positions: Vec<Point>,
    connectivity: Vec<i64>,
    ends: Vec<i64>,
    types: Vec<i64>,
    cell_data: CellData,
}

impl Grid {
    fn add<'a>(&mut self, decoder: &Decoder<'a>, piece: &Piece<'a>) -> Result<(), ReadError> {
        let first_node = self.positions.len();
        let first_corner = self.connectivity.len() as i64;
        let first_cell = self.ends.len();
        piece.cell_data.iter().chain(&piece.point_data).for_each(|array| self.cell_data.note(&array.name));
        match &piece.points {
            Some(points) => self.add_points(decoder, points, piece.node_count)?,
            None if piece.node_count == 0 => {}
            None => {
                let message = format!("a piece says it has {} points, but has no Points", piece.node_count);
                return Err(refuse(Format::Vtu, None, code::INCONSISTENT, message));
            }
        }
        if piece.cell_count == 0 {
            return Ok(());
        }
        let find = |name: &str| {
            let array = piece.cells.iter().find(|array| array.name == name);
            array.ok_or_else(|| {
                let message = format!("a piece has no array '{name}' in its Cells");
                refuse(Format::Vtu, None, code::SYNTAX, message)
            })
        };
        let a_cell = Some(Wanted { attribute: "NumberOfCells", count: piece.cell_count, each: 1 });
        let nodes = decoder.integers(find("connectivity")?, None)?;
        check_nodes(decoder, find("connectivity")?, &nodes, piece.node_count)?;
        self.connectivity.extend(nodes.iter().map(|node| node + first_node as i64));
        let ends = decoder.integers(find("offsets")?, a_cell)?;
        self.ends.extend(ends.iter().map(|end| end.saturating_add(first_corner)));
        self.types.extend(decoder.integers(find("types")?, a_cell)?);
        for array in piece.cell_data.iter().filter(|array| is_wanted(&array.name) && array.components == 1) {
            self.cell_data.add(&array.name, first_cell, decoder.decode(array, a_cell)?);
        }
        Ok(())
    }

    fn add_points<'a>(
        &mut self,
        decoder: &Decoder<'a>,
        array: &DataArray<'a>,
        count: u64,
    ) -> Result<(), ReadError> {
        let size = array.components;
        if !(2..=3).contains(&size) {
            let message = &format!("has numbers in groups of {size}; points have 3");
            return Err(decoder.refuse(array, code::INCONSISTENT, message));
        }
        let wanted = Wanted { attribute: "NumberOfPoints", count, each: size };
        let values = decoder.decode(array, Some(wanted))?.into_floats();
        if let Some(place) = values.iter().position(|x| !x.is_finite()) {
            let node = self.positions.len() + place / size;
            return Err(refuse_not_finite(Format::Vtu, decoder.line_of(array, place), node));
        }
        let points = values.chunks_exact(size);
        self.positions.extend(points.map(|p| Point::new(p[0], p[1], p.get(2).copied().unwrap_or(0.0))));
        Ok(())
    }
}

/// A node of another piece must not pass for one of this.
fn check_nodes(
    decoder: &Decoder<'_>,
    array: &DataArray<'_>,
    nodes: &[i64],
    count: u64,
) -> Result<(), ReadError> {
    match nodes.iter().find(|&&node| u64::try_from(node).map_or(true, |node| node >= count)) {
        None => Ok(()),
        Some(node) => {
            let message = &match count.checked_sub(1) {
                Some(last) => format!("names node {node}, but the nodes are numbered 0 to {last}"),
                None => format!("names node {node}, but its piece has no nodes"),
            };
            Err(decoder.refuse(array, code::NODE_OUT_OF_RANGE, message))
        }
    }
}
