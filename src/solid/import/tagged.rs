//! Features that the file marks: borders of its groups and materials, polylines, creases.

use crate::mesh::{FaceId, NodeId, PolygonMesh};
use crate::solid::options::{SolidOptions, SolidReport};
use crate::solid::shell::{NONE, Shell, triangle_of};

/// How nodes of the file and vertices belong together.
pub(super) struct Nodes<'a> {
    /// The vertex of each node; `NONE` if no triangle uses it.
    pub vertex_of: &'a [u32],
    /// For each of the last vertices the one that it was split from.
    pub copies: &'a [u32],
}

/// For each half-edge whether the file marks it as a feature.
pub(super) fn tagged_edges(
    shell: &Shell,
    surface: &PolygonMesh,
    face_of: &[FaceId],
    nodes: &Nodes,
    options: &SolidOptions,
    report: &mut SolidReport,
) -> Vec<bool> {
    if !options.tags {
        return vec![false; shell.len()];
    }
    let set_of = |k: u32| surface.tags.of(face_of[triangle_of(k)].index());
    let mut tagged: Vec<bool> = if surface.tags.sets.len() > 1 {
        (0..shell.len() as u32).map(|k| set_of(k) != set_of(shell.twin(k))).collect()
    } else {
        vec![false; shell.len()]
    };
    let features = &surface.features;
    let polylines = features.polylines.iter().flat_map(|line| line.windows(2)).map(|w| [w[0], w[1]]);
    let creases = features.creases.iter().filter(|(_, sharpness)| *sharpness > 0.0).map(|(ends, _)| *ends);
    let marked: Vec<[NodeId; 2]> = polylines.chain(creases).collect();
    if marked.is_empty() {
        return tagged;
    }
    let first_copy = shell.mesh.points.len() - nodes.copies.len();
    let original = |v: u32| (v as usize).checked_sub(first_copy).map_or(v, |i| nodes.copies[i]);
    let mut by_ends: Vec<([u32; 2], u32)> =
        (0..shell.len() as u32).map(|k| ([shell.from(k), shell.to(k)].map(original), k)).collect();
    crate::parallel::sort(&mut by_ends);
    for ends in marked {
        let [a, b] = ends.map(|n| nodes.vertex_of.get(n.index()).copied().unwrap_or(NONE));
        match by_ends.binary_search_by_key(&[a, b], |&(ends, _)| ends) {
            Ok(found) => {
                let k = by_ends[found].1;
                tagged[k as usize] = true;
                tagged[shell.twin(k) as usize] = true;
            }
            // A welded edge without length marks nothing and is missed by nobody.
            Err(_) => report.unmatched_edges += usize::from(a == NONE || a != b),
        }
    }
    tagged
}
