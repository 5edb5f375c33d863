//! What VTK's two file formats share: cells as connectivity, ends and types, and the cell data that
//! carry levels, parents and tags.

use std::collections::{HashMap, HashSet};

use super::cell_collector::{CellAttributes, CellCollector};
use super::cell_kind::CellKind;
use super::cell_view::Cells;
use super::refusal::{code, refuse};
use super::scalars::Column;
use super::tag_interner::CellTags;
use super::tag_numbers::Names;
use super::{Format, ReadError};
use crate::mesh::SecondOrderHex;

/// Cell data array of refinement levels.
pub(super) const LEVEL: &str = "Level";
/// Cell data array of the input cells that cells are part of.
pub(super) const PARENT: &str = "Parent";
/// Cell data array of tags.
pub(super) const TAG: &str = "Tag";

/// Arrays that other programs keep the groups of cells in, by preference: ours, meshio's from Gmsh
/// and from MEDIT files, Gmsh's, VTK's filters'.
const TAG_ARRAYS: [&str; 5] = [TAG, "gmsh:physical", "medit:ref", "CellEntityIds", "MaterialIds"];

/// Array of bits that say what cells are beside the mesh's own, and those of the cells that are left out: another piece has
/// the cell too (1), or it is hidden (32).
const GHOST_TYPE: (&str, i64) = ("vtkGhostType", 1 | 32);
/// Array of the first versions that says how far within another piece cells are; 0 are the mesh's own.
const GHOST_LEVELS: &str = "vtkGhostLevels";

/// VTK's type of a cell that is none.
const EMPTY: i64 = 0;
/// VTK's type of a quad.
const QUAD: u8 = 9;

/// VTK's type of a face of hexes with so many nodes.
pub(super) fn face_type(size: usize) -> u8 {
    match size {
        4 => QUAD,
        8 => 23,
        _ => 28,
    }
}

/// VTK's type of a cell.
pub(super) fn cell_type(cells: Cells<'_>, cell: usize) -> u8 {
    match cells {
        Cells::Hexes(_) => 12,
        Cells::SecondOrder(hexes) => match hexes.hex {
            SecondOrderHex::Hex20 => 25,
            SecondOrderHex::Hex27 => 29,
        },
        Cells::Quads(_) => QUAD,
        Cells::Polygons(mesh) => match mesh.face(cell).len() {
            3 => 5,
            4 => QUAD,
            _ => 7,
        },
    }
}

/// Hands the cells to `collector`: cell `i` has the type `types[i]` and the nodes that end at `ends[i]`
/// in `connectivity`.
pub(super) fn collect_cells(
    collector: &mut CellCollector,
    format: Format,
    connectivity: &[i64],
    ends: &[i64],
    types: &[i64],
) -> Result<(), ReadError> {
    if ends.len() != types.len() {
        let message = format!("there are {} cell types for {} cells", types.len(), ends.len());
        return Err(refuse(format, None, code::INCONSISTENT, message));
    }
    let mut start = 0;
    for (cell, (&end, &number)) in ends.iter().zip(types).enumerate() {
        let nodes = usize::try_from(end).ok().and_then(|end| connectivity.get(start..end)).ok_or_else(|| {
            let message = format!(
                "cell {cell} (counted from 0) has the nodes {start} to {end} of {} in the connectivity — its offset is wrong",
                connectivity.len()
            );
            refuse(format, None, code::INCONSISTENT, message)
        })?;
        let kind = CellKind::from_vtk(number)
            .map_err(|name| collector.refuse_cell(&format!("{name} (VTK type {number})"), None))?;
        collector.push(kind, nodes, None)?;
        start += nodes.len();
    }
    Ok(())
}

/// True if the cell data array `name` is one that is read.
pub(super) fn is_wanted(name: &str) -> bool {
    name == LEVEL || name == PARENT || TAG_ARRAYS.contains(&name) || hides(name).is_some()
}

/// Which numbers of the cell data array `name` say that a cell is left out; `None` if it says nothing of that.
fn hides(name: &str) -> Option<fn(i64) -> bool> {
    match name {
        GHOST_LEVELS => Some(|level| level > 0),
        _ if name == GHOST_TYPE.0 => Some(|bits| bits & GHOST_TYPE.1 != 0),
        _ => None,
    }
}

/// The cell data of a file.
#[derive(Default)]
pub(super) struct CellData {
    /// The arrays that [`is_wanted`] and that say what cells are.
    wanted: HashMap<String, Column>,
    /// Is the cell left out? Cells without an entry are not.
    is_hidden: Vec<bool>,
    /// The names of all arrays, of nodes too, each once, in the file's order.
    names: Vec<String>,
    known: HashSet<String>,
}

impl CellData {
    /// Notes that the file has an array of this name.
    pub fn note(&mut self, name: &str) {
        if self.known.insert(name.to_owned()) {
            self.names.push(name.to_owned());
        }
    }

    /// Adds the array `name`, which [`is_wanted`], of the cells from `first` on. One that cells before these do not have is
    /// dropped by its wrong length.
    pub fn add(&mut self, name: &str, first: usize, column: Column) {
        if let Some(hides) = hides(name) {
            if let Some(numbers) = column.into_integers() {
                self.is_hidden.resize(self.is_hidden.len().max(first + numbers.len()), false);
                let cells = self.is_hidden[first..].iter_mut();
                cells.zip(numbers).for_each(|(is_hidden, number)| *is_hidden |= hides(number));
            }
            return;
        }
        match self.wanted.get_mut(name) {
            _ if first == 0 => drop(self.wanted.insert(name.to_owned(), column)),
            None => {}
            Some(Column::Integers(values)) => values.extend(column.into_integers().unwrap_or_default()),
            Some(Column::Floats(values)) => values.extend(column.into_floats()),
        }
    }

    /// Takes the cells that are left out for cells of no type; how many there are.
    pub fn hide(&self, types: &mut [i64]) -> usize {
        let hidden = types.iter_mut().zip(&self.is_hidden).filter(|&(_, &is_hidden)| is_hidden);
        hidden.map(|(number, _)| *number = EMPTY).count()
    }

    /// The attributes of the cells of the given types, and the names of the arrays that say nothing of them.
    pub fn attributes(self, types: &[i64], named: &Names) -> (CellAttributes, Vec<String>) {
        let Self { wanted, is_hidden, mut names, .. } = self;
        let (attributes, read) = cell_attributes(wanted, types, named);
        let are_hidden_read = !is_hidden.is_empty();
        names.retain(|name| !(read.contains(&name.as_str()) || are_hidden_read && hides(name).is_some()));
        (attributes, names)
    }
}

/// The attributes of the cells of the given types from the arrays that [`is_wanted`], and the names of those that were
/// used. Arrays of the wrong length or with numbers that are not whole are another program's, and left alone.
fn cell_attributes(
    mut arrays: HashMap<String, Column>,
    types: &[i64],
    named: &Names,
) -> (CellAttributes, Vec<&'static str>) {
    let is_hex = |number: &i64| CellKind::from_vtk(*number).is_ok_and(CellKind::is_hex);
    let has_hexes = types.iter().any(is_hex);
    let mut read = Vec::new();
    let mut whole = |name: &'static str| {
        let column = arrays.remove(name).filter(|column| column.len() == types.len());
        let numbers = column.and_then(Column::into_integers);
        read.extend(numbers.is_some().then_some(name));
        numbers
    };
    let attributes = CellAttributes {
        level: whole(LEVEL),
        parent: whole(PARENT),
        tags: TAG_ARRAYS.iter().find_map(|name| whole(name)).map(|numbers| {
            CellTags::from_numbers(&numbers, named, |cell| has_hexes && !is_hex(&types[cell]))
        }),
    };
    (attributes, read)
}
