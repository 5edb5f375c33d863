//! Reads MSH: one section after the other, in any order.

use super::elements::Elements;
use super::file::MshFile;
use super::groups::Groups;
use super::nodes::Nodes;
use crate::io::cell_collector::{CellAttributes, CellCollector};
use crate::io::refusal::{code, excerpt};
use crate::io::{Document, Format, ReadError};

/// The mesh in an MSH file.
pub fn read(bytes: &[u8]) -> Result<Document, ReadError> {
    let mut file = MshFile::open(bytes)?;
    let (mut nodes, mut elements) = (Nodes::default(), Elements::default());
    let mut groups = Groups::new(bytes.len());
    while let Some(name) = file.tokens.next() {
        match name {
            b"$PhysicalNames" => groups.read_names(&mut file)?,
            b"$Entities" => {
                file.start_data();
                groups.read_entities(&mut file)?;
            }
            b"$Nodes" => {
                start_blocks(&mut file);
                nodes.read(&mut file)?;
            }
            b"$Elements" => {
                start_blocks(&mut file);
                elements.read(&mut file, &mut groups)?;
            }
            _ if name.starts_with(b"$") && !name.starts_with(b"$End") => {
                file.skip_section(name);
                continue;
            }
            _ => {
                let message = format!("{} stands where a section should begin", excerpt(name));
                return Err(file.tokens.refuse(code::SYNTAX, message));
            }
        }
        file.end_section(name)?;
    }
    let mut collector = CellCollector::new(Format::Msh, nodes.positions.len(), 0);
    elements.collect(&nodes, &mut groups, &mut collector)?;
    collector.drop_groups(groups.below_surfaces());
    let attributes = CellAttributes { tags: Some(groups.tags), ..CellAttributes::default() };
    collector.finish(nodes.positions, attributes)
}

/// Version 4 begins with numbers in the file's encoding, version 2 with a count that is always in words.
fn start_blocks(file: &mut MshFile<'_>) {
    if file.version == super::file::Version::Four {
        file.start_data();
    }
}
