//! Structured datasets of a legacy VTK file: nodes in rows, columns and layers, and the cells between them.

use super::file::LegacyFile;
use crate::geometry::Point;
use crate::io::cell_collector::CellCollector;
use crate::io::cell_kind::CellKind;
use crate::io::refusal::{code, refuse};
use crate::io::{Format, ReadError};

/// Nodes that a dataset may have for each byte of the file, and in any file: three numbers make a dataset, so that a small
/// file could ask for any amount of memory.
const NODES: (usize, usize) = (16, 1 << 20);

/// VTK's types of the cells between the nodes: pixels and voxels.
const PIXEL: i64 = 8;
const VOXEL: i64 = 11;

/// Where the nodes of a dataset stand.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// At equal steps: `STRUCTURED_POINTS`.
    Points,
    /// At the coordinates that each axis has: `RECTILINEAR_GRID`.
    Rectilinear,
    /// Anywhere: `STRUCTURED_GRID`.
    Grid,
}

/// What a file says of a structured dataset.
pub(super) struct Structured {
    kind: Kind,
    /// The size of the file.
    size: usize,
    /// How many nodes there are along each axis; `None` until it is told.
    dimensions: Option<[usize; 3]>,
    /// The place of the first node in the steps from the origin.
    first: [i64; 3],
    origin: [f64; 3],
    spacing: [f64; 3],
    coordinates: [Vec<f64>; 3],
}

impl Structured {
    /// A dataset in a file of `size` bytes, of which nothing is told yet.
    pub fn new(kind: Kind, size: usize) -> Self {
        let coordinates = [const { Vec::new() }; 3];
        Self { kind, size, dimensions: None, first: [0; 3], origin: [0.0; 3], spacing: [1.0; 3], coordinates }
    }

    /// Are its nodes in a section of points?
    pub fn has_points(&self) -> bool {
        self.kind == Kind::Grid
    }

    /// Reads a section of the dataset; false if `section` is none.
    pub fn read_section(&mut self, section: &[u8], file: &mut LegacyFile<'_>) -> Result<bool, ReadError> {
        match (section, self.kind) {
            (b"DIMENSIONS", _) => {
                let mut size = || file.number("a dimension");
                self.dimensions = Some([size()?, size()?, size()?]);
            }
            (b"EXTENT", _) => self.read_extent(file)?,
            (b"ORIGIN", Kind::Points) => self.origin = read_vector(file)?,
            // The second name is that of the first versions.
            (b"SPACING" | b"ASPECT_RATIO", Kind::Points) => self.spacing = read_vector(file)?,
            (b"X_COORDINATES", Kind::Rectilinear) => self.coordinates[0] = read_coordinates(file)?,
            (b"Y_COORDINATES", Kind::Rectilinear) => self.coordinates[1] = read_coordinates(file)?,
            (b"Z_COORDINATES", Kind::Rectilinear) => self.coordinates[2] = read_coordinates(file)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Dimensions by the first and the last place along each axis.
    fn read_extent(&mut self, file: &mut LegacyFile<'_>) -> Result<(), ReadError> {
        let mut dimensions = [0; 3];
        for (dimension, start) in dimensions.iter_mut().zip(&mut self.first) {
            let (first, last) = (file.tokens.integer("an extent")?, file.tokens.integer("an extent")?);
            let size = last.checked_sub(first).and_then(|steps| usize::try_from(steps).ok()?.checked_add(1));
            *dimension = size.ok_or_else(|| {
                let wrong = if last < first { "it must not go backwards" } else { "it is too large" };
                file.tokens
                    .refuse(code::BAD_NUMBER, format!("an extent goes from {first} to {last}; {wrong}"))
            })?;
            *start = first;
        }
        self.dimensions = Some(dimensions);
        Ok(())
    }

    /// The nodes, of which `points` stood in a section, and how many there are along each axis.
    pub fn positions(self, points: Vec<Point>) -> Result<(Vec<Point>, [usize; 3]), ReadError> {
        let refused = |code, message| refuse(Format::Vtk, None, code, message);
        let Some(dimensions) = self.dimensions else {
            return Err(refused(code::SYNTAX, "the dataset has no DIMENSIONS".to_owned()));
        };
        let count = self.node_count(dimensions)?;
        let positions = match self.kind {
            Kind::Grid if points.len() == count => points,
            Kind::Grid => {
                let message = format!("there are {} points for {count} nodes", points.len());
                return Err(refused(code::INCONSISTENT, message));
            }
            Kind::Points => positions(dimensions, |axis, place| {
                self.origin[axis] + (self.first[axis] as f64 + place as f64) * self.spacing[axis]
            }),
            Kind::Rectilinear => {
                for (axis, (found, wanted)) in self.coordinates.iter().zip(dimensions).enumerate() {
                    if found.len() != wanted {
                        let (axis, found) = (["x", "y", "z"][axis], found.len());
                        let message =
                            format!("there are {found} coordinates along {axis} for {wanted} nodes");
                        return Err(refused(code::INCONSISTENT, message));
                    }
                }
                positions(dimensions, |axis, place| self.coordinates[axis][place])
            }
        };
        Ok((positions, dimensions))
    }

    /// How many nodes there are, if there are cells between them and memory enough for so small a file.
    fn node_count(&self, dimensions: [usize; 3]) -> Result<usize, ReadError> {
        let [x, y, z] = dimensions;
        if dimensions.contains(&0) || dimensions.iter().filter(|&&size| size > 1).count() < 2 {
            let message = format!(
                "the dimensions are {x} x {y} x {z}, and there are no faces or hexahedra between such nodes — at least two \
                 dimensions have to be 2 or more"
            );
            return Err(refuse(Format::Vtk, None, code::NO_CELLS, message));
        }
        let most = self.size.saturating_mul(NODES.0).saturating_add(NODES.1).min(u32::MAX as usize);
        let count = x.checked_mul(y).and_then(|count| count.checked_mul(z)).filter(|&count| count <= most);
        count.ok_or_else(|| {
            let message = format!(
                "the dimensions are {x} x {y} x {z}, more than the {most} nodes that a file of this size may have — give a \
                 coarser grid, or an unstructured one"
            );
            refuse(Format::Vtk, None, code::TOO_LARGE, message)
        })
    }
}

fn read_vector(file: &mut LegacyFile<'_>) -> Result<[f64; 3], ReadError> {
    let mut number = || file.tokens.float("an origin or a spacing");
    Ok([number()?, number()?, number()?])
}

fn read_coordinates(file: &mut LegacyFile<'_>) -> Result<Vec<f64>, ReadError> {
    let count = file.number("the number of coordinates")?;
    let scalar = file.scalar()?;
    file.start_data();
    Ok(file.column(count, scalar, "the coordinates")?.into_floats())
}

/// The nodes of a dataset that has a coordinate at each place along an axis; x runs first, then y.
fn positions([x, y, z]: [usize; 3], coordinate: impl Fn(usize, usize) -> f64) -> Vec<Point> {
    let mut positions = Vec::with_capacity(x * y * z);
    for k in 0..z {
        for j in 0..y {
            let row = (0..x).map(|i| Point::new(coordinate(0, i), coordinate(1, j), coordinate(2, k)));
            positions.extend(row);
        }
    }
    positions
}

/// VTK's type of each cell between so many nodes along each axis.
pub(super) fn cell_types(dimensions: [usize; 3]) -> Vec<i64> {
    let number = if dimensions.contains(&1) { PIXEL } else { VOXEL };
    vec![number; dimensions.map(|size| (size - 1).max(1)).iter().product()]
}

/// Hands over the cells between the nodes, of the given types, in VTK's order: x runs first, then y. An axis with one node is
/// none of theirs.
pub(super) fn push_cells(
    collector: &mut CellCollector,
    dimensions: [usize; 3],
    types: &[i64],
) -> Result<(), ReadError> {
    let [x, y, _] = dimensions;
    let steps = [1, x, x * y];
    let axes: Vec<usize> = (0..3).filter(|&axis| dimensions[axis] > 1).collect();
    // Each corner's node after that of the first corner.
    let corners: Vec<usize> = (0..1 << axes.len())
        .map(|corner: usize| (0..axes.len()).map(|k| (corner >> k & 1) * steps[axes[k]]).sum())
        .collect();
    let [cells_x, cells_y, cells_z] = dimensions.map(|size| (size - 1).max(1));
    let mut nodes = vec![0; corners.len()];
    let mut types = types.iter();
    for k in 0..cells_z {
        for j in 0..cells_y {
            for i in 0..cells_x {
                let first = i + steps[1] * j + steps[2] * k;
                for (node, corner) in nodes.iter_mut().zip(&corners) {
                    *node = (first + corner) as i64;
                }
                let kind = match types.next() {
                    Some(&VOXEL) => CellKind::Voxel,
                    Some(&PIXEL) => CellKind::Pixel,
                    _ => CellKind::Skipped,
                };
                collector.push(kind, &nodes, None)?;
            }
        }
    }
    Ok(())
}
