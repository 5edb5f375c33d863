//! From facets that each have their own vertices to a mesh.

use crate::geometry::Point;
use crate::io::refusal::{code, refuse};
use crate::io::{Document, Format, ReadError};
use crate::mesh::{NodeId, PolygonMesh, Tags, first_of_same};

/// The most facets: their vertices are numbered in 32 bits before they are welded.
pub(super) const MOST: usize = u32::MAX as usize / 3;

/// The mesh of facets, by their vertices, three for three.
pub(super) fn document(vertices: Vec<Point>, tags: Tags) -> Result<Document, ReadError> {
    if vertices.is_empty() {
        return Err(refuse(
            Format::Stl,
            None,
            code::NO_CELLS,
            "the file has no facets: export the model again",
        ));
    }
    let first = first_of_same(&vertices);
    let mut number = vec![0; vertices.len()];
    let mut positions = Vec::new();
    let corners = first.iter().enumerate().map(|(v, &first)| {
        if first as usize == v {
            number[v] = positions.len() as u32;
            positions.push(vertices[v]);
        }
        NodeId(number[first as usize])
    });
    let corners: Vec<NodeId> = corners.collect();
    let offsets = (0..=corners.len() as u32).step_by(3).collect();
    Ok(Document::from(PolygonMesh { positions, offsets, corners, tags, ..PolygonMesh::default() }))
}
