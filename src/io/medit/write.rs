//! Writes MEDIT meshes.

use std::collections::HashMap;

use crate::io::cell_view::{CellView, Cells};
use crate::io::refusal::{code, refuse_writing};
use crate::io::tag_numbers::{Label, cell_numbers, has_no_names, labels, number_sets};
use crate::io::text::Text;
use crate::io::{Document, Format, WriteError};
use crate::mesh::{Features, NodeId, Tags};

/// The file as bytes: the same for any number of threads.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    let view = CellView::new(document, Format::Medit)?;
    view.refuse_polygons(Format::Medit)?;
    let mut file = Text::default();
    let references = cell_numbers(view.tags);
    let of_faces = cell_numbers(view.groups.tags());
    let is_wide = references.iter().chain(&of_faces).any(|&number| i32::try_from(number).is_err());
    file.word("MeshVersionFormatted ").word(if is_wide { "4" } else { "2" }).word("\nDimension 3\n");
    write_names(&mut file, view.tags, "reference");
    write_names(&mut file, view.groups.tags(), "reference of quadrilaterals");
    file.word("\nVertices\n").integer(view.positions.len()).word("\n");
    file.items(view.positions.len(), |line, node| {
        let p = view.positions[node];
        line.float(p.x).word(" ").float(p.y).word(" ").float(p.z).word(" 0\n");
    });
    match view.cells {
        Cells::Hexes(_) => {
            write_cells(&mut file, &view, &references, "Hexahedra", 8);
            write_grouped_faces(&mut file, &view, &of_faces);
        }
        Cells::SecondOrder(_) => {
            let message = "MEDIT is written with hexes of eight nodes only: write VTU, VTK, MSH or INP";
            return Err(refuse_writing(Format::Medit, code::FORMAT_HOLDS_NO_SECOND_ORDER, message));
        }
        Cells::Quads(_) => write_cells(&mut file, &view, &references, "Quadrilaterals", 4),
        Cells::Polygons(mesh) => {
            write_cells(&mut file, &view, &references, "Triangles", 3);
            write_cells(&mut file, &view, &references, "Quadrilaterals", 4);
            write_features(&mut file, &mesh.features, view.positions.len())?;
        }
    }
    file.word("\nEnd\n");
    Ok(file.into_bytes())
}

/// What the references mean, as comments: readers pass over them.
fn write_names(file: &mut Text, tags: &Tags, what: &str) {
    let named = tags.sets.iter().zip(number_sets(tags)).filter(|(set, _)| !has_no_names(set));
    for (set, number) in named {
        let names: Vec<String> = labels(set).iter().map(Label::to_string).collect();
        let names = names.join(", ").replace(['\n', '\r'], " ");
        file.word("# ").word(what).word(" ").integer(number).word(": ").word(&names).word("\n");
    }
}

/// The cells of `size` nodes with their references.
fn write_cells(file: &mut Text, view: &CellView<'_>, references: &[i64], section: &str, size: usize) {
    let cells = view.cells;
    let members: Vec<usize> = (0..cells.len()).filter(|&cell| cells.nodes(cell).len() == size).collect();
    if members.is_empty() {
        return;
    }
    file.word("\n").word(section).word("\n").integer(members.len()).word("\n");
    file.items(members.len(), |line, index| {
        let cell = members[index];
        for node in cells.nodes(cell) {
            line.integer(u64::from(node.0) + 1).word(" ");
        }
        line.integer(references.get(cell).copied().unwrap_or(0)).word("\n");
    });
}

/// The faces of hexes that are in groups.
fn write_grouped_faces(file: &mut Text, view: &CellView<'_>, references: &[i64]) {
    let faces = view.grouped_faces();
    if faces.len() == 0 {
        return;
    }
    file.word("\nQuadrilaterals\n").integer(faces.len()).word("\n");
    file.items(faces.len(), |line, face| {
        for node in faces.face(face) {
            line.integer(u64::from(node.0) + 1).word(" ");
        }
        line.integer(references[face]).word("\n");
    });
}

/// Polylines and creases as edges, of which the creases are ridges.
fn write_features(file: &mut Text, features: &Features, node_count: usize) -> Result<(), WriteError> {
    let mut edges: Vec<[NodeId; 2]> =
        features.polylines.iter().flat_map(|line| line.windows(2).map(|pair| [pair[0], pair[1]])).collect();
    let undirected = |[a, b]: [NodeId; 2]| [a.min(b), a.max(b)];
    let mut place: HashMap<[NodeId; 2], usize> = HashMap::new();
    for (index, &edge) in edges.iter().enumerate() {
        place.entry(undirected(edge)).or_insert(index);
    }
    let mut ridges = Vec::new();
    for &(edge, _) in features.creases.iter().filter(|(_, sharpness)| *sharpness > 0.0) {
        let index = *place.entry(undirected(edge)).or_insert_with(|| {
            edges.push(edge);
            edges.len() - 1
        });
        ridges.push(index);
    }
    let corners: Vec<usize> = features
        .corners
        .iter()
        .filter(|(_, sharpness)| *sharpness > 0.0)
        .map(|(node, _)| node.index())
        .collect();
    let named = edges.as_flattened().iter().map(|node| node.index()).chain(corners.iter().copied());
    if let Some(node) = named.max().filter(|&node| node >= node_count) {
        let message = format!("an edge or a corner names node {node} of {node_count}");
        return Err(refuse_writing(Format::Medit, code::NODE_OUT_OF_RANGE, message));
    }
    if !edges.is_empty() {
        file.word("\nEdges\n").integer(edges.len()).word("\n");
        for [a, b] in &edges {
            file.integer(u64::from(a.0) + 1).word(" ").integer(u64::from(b.0) + 1).word(" 0\n");
        }
    }
    write_list(file, "Ridges", &ridges);
    write_list(file, "Corners", &corners);
    Ok(())
}

/// A section of numbers from 1.
fn write_list(file: &mut Text, section: &str, indices: &[usize]) {
    if indices.is_empty() {
        return;
    }
    file.word("\n").word(section).word("\n").integer(indices.len()).word("\n");
    for index in indices {
        file.integer(index + 1).word("\n");
    }
}
