//! The `$Nodes` of an MSH file.

use super::file::{MshFile, Version};
use crate::geometry::Point;
use crate::io::node_numbers::NodeNumbers;
use crate::io::refusal::{code, refuse_not_finite};
use crate::io::{Format, ReadError};

/// Nodes and the numbers that the file gives them.
#[derive(Default)]
pub(super) struct Nodes {
    pub positions: Vec<Point>,
    pub numbers: NodeNumbers,
}

/// Bytes that a node takes at least: three coordinates in words.
const LEAST_NODE: usize = 6;

impl Nodes {
    /// Reads the section after its name.
    pub fn read(&mut self, file: &mut MshFile<'_>) -> Result<(), ReadError> {
        match file.version {
            Version::Two => self.read_version_2(file),
            Version::Four => self.read_version_4(file),
        }
    }

    fn read_version_2(&mut self, file: &mut MshFile<'_>) -> Result<(), ReadError> {
        let count = file.tokens.count("the number of nodes", LEAST_NODE)?;
        file.start_data();
        for _ in 0..count {
            let number = file.int("the number of a node")?;
            self.add_number(file, number)?;
            self.read_position(file, number)?;
        }
        Ok(())
    }

    fn read_version_4(&mut self, file: &mut MshFile<'_>) -> Result<(), ReadError> {
        let blocks = file.size("the number of blocks of nodes")?;
        for what in ["the number of nodes", "the least node number", "the greatest node number"] {
            file.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = file.int("the dimension of an entity")?;
            file.int("the number of an entity")?;
            let parametric = file.int("whether nodes are parametric")? != 0;
            let count = file.size("the number of nodes of a block")?;
            let count = file.checked(count, LEAST_NODE, "the number of nodes of a block")?;
            let mut numbers = Vec::new();
            for _ in 0..count {
                let number = file.size("the number of a node")?;
                self.add_number(file, number)?;
                numbers.push(number);
            }
            let parameters = if parametric { dimension.clamp(0, 3) } else { 0 };
            for number in numbers {
                self.read_position(file, number)?;
                for _ in 0..parameters {
                    file.double("a parameter of a node")?;
                }
            }
        }
        Ok(())
    }

    fn add_number(&mut self, file: &MshFile<'_>, number: i64) -> Result<(), ReadError> {
        self.numbers.add(number).map(drop).ok_or_else(|| {
            let message = format!("node {number} comes twice — give one of the two another number");
            file.tokens.refuse(code::DUPLICATE_NUMBER, message)
        })
    }

    fn read_position(&mut self, file: &mut MshFile<'_>, number: i64) -> Result<(), ReadError> {
        let mut coordinate = || file.double("a coordinate");
        let position = Point::new(coordinate()?, coordinate()?, coordinate()?);
        if !position.is_finite() {
            return Err(refuse_not_finite(Format::Msh, file.tokens.line(), number));
        }
        self.positions.push(position);
        Ok(())
    }
}
