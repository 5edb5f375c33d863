//! Faces with the same set of nodes.

use super::Defect;
use crate::mesh::{FaceId, Faces, NodeId};

/// Each face that has the same nodes as an earlier one, with the first such.
///
/// Every face hangs in a list at that of its nodes where fewest faces meet, and is compared with those
/// before it: on surfaces these lists are short, as for [`Edges`](crate::mesh::Edges).
pub(super) fn same_nodes(mesh: &impl Faces) -> Vec<Defect> {
    const NONE: u32 = u32::MAX;
    let mut degree = vec![0u32; mesh.node_count()];
    for n in mesh.corners() {
        degree[n.index()] += 1;
    }
    let mut head = vec![NONE; mesh.node_count()];
    let mut next = vec![NONE; mesh.face_count()];
    let mut defects = Vec::new();
    for f in 0..mesh.face_count() {
        let nodes = mesh.nodes_of(f);
        let Some(owner) = nodes.iter().min_by_key(|n| (degree[n.index()], **n)).map(|n| n.index()) else {
            continue;
        };
        let mut other = head[owner];
        while other != NONE && !is_same_set(nodes, mesh.nodes_of(other as usize)) {
            other = next[other as usize];
        }
        if other != NONE {
            defects.push(Defect::SameNodes { faces: [FaceId(other), FaceId::new(f)] });
        } else {
            next[f] = head[owner];
            head[owner] = f as u32;
        }
    }
    defects
}

fn is_same_set(a: &[NodeId], b: &[NodeId]) -> bool {
    let sum = |nodes: &[NodeId]| nodes.iter().fold(0u32, |s, n| s.wrapping_add(n.0));
    if a.len() != b.len() || sum(a) != sum(b) {
        return false;
    }
    let sorted = |nodes: &[NodeId]| {
        let mut nodes = nodes.to_vec();
        nodes.sort_unstable();
        nodes
    };
    sorted(a) == sorted(b)
}
