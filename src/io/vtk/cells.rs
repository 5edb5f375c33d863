//! Lists of cells of a legacy VTK file, in the form of version 5 or of those before.

use super::file::LegacyFile;
use crate::io::ReadError;
use crate::io::refusal::code;
use crate::io::scalars::Scalar;

/// Cells by their nodes: cell `i` has those up to `ends[i]`.
#[derive(Default)]
pub(super) struct CellList {
    pub nodes: Vec<i64>,
    pub ends: Vec<i64>,
}

impl CellList {
    /// Adds the cells of another list.
    pub fn append(&mut self, other: &Self) {
        let first = self.nodes.len() as i64;
        self.nodes.extend_from_slice(&other.nodes);
        self.ends.extend(other.ends.iter().map(|end| end.saturating_add(first)));
    }
}

/// The list after its keyword.
pub(super) fn read_cells(file: &mut LegacyFile<'_>) -> Result<CellList, ReadError> {
    let count = file.number("the number of cells")?;
    let size = file.number("the size of the list of cells")?;
    file.start_data();
    if file.line_begins_with(b"OFFSETS") {
        read_offsets(file, count, size)
    } else {
        read_counted(file, count, size)
    }
}

/// Version 5: where each cell begins and the last ends, then the nodes.
fn read_offsets(file: &mut LegacyFile<'_>, count: usize, size: usize) -> Result<CellList, ReadError> {
    let mut ends = read_named(file, "OFFSETS", count)?;
    let nodes = read_named(file, "CONNECTIVITY", size)?;
    if !ends.is_empty() && ends.remove(0) != 0 {
        return Err(file.tokens.refuse(code::INCONSISTENT, "the offsets of the cells do not begin with 0"));
    }
    Ok(CellList { nodes, ends })
}

fn read_named(file: &mut LegacyFile<'_>, name: &str, count: usize) -> Result<Vec<i64>, ReadError> {
    let word = file.tokens.expect(name)?;
    if !word.eq_ignore_ascii_case(name.as_bytes()) {
        return Err(file.tokens.refuse(code::SYNTAX, format!("the list of cells lacks its {name}")));
    }
    let scalar = file.scalar()?;
    file.start_data();
    file.integers(count, scalar, "the cells")
}

/// Up to version 4: each cell's number of nodes, then these.
fn read_counted(file: &mut LegacyFile<'_>, count: usize, size: usize) -> Result<CellList, ReadError> {
    let numbers = file.integers(size, Scalar::Signed(4), "the cells")?;
    let mut list = CellList::default();
    let mut rest = numbers.as_slice();
    while let Some((&length, after)) = rest.split_first() {
        let cell = usize::try_from(length).ok().and_then(|length| after.split_at_checked(length));
        let Some((nodes, after)) = cell else {
            let message = format!(
                "cell {} (counted from 0) has {length} nodes, but the list ends before them",
                list.ends.len()
            );
            return Err(file.tokens.refuse(code::INCONSISTENT, message));
        };
        list.nodes.extend_from_slice(nodes);
        list.ends.push(list.nodes.len() as i64);
        rest = after;
    }
    if list.ends.len() == count {
        return Ok(list);
    }
    let message = format!("the file says it has {count} cells, but their list holds {}", list.ends.len());
    Err(file.tokens.refuse(code::INCONSISTENT, message))
}
