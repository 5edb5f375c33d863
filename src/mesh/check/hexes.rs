//! Is a hex mesh conforming, and what else is there to know of it? In this order:
//!
//! 1. node ids (if these fail, nothing below is looked at);
//! 2. coordinates are finite;
//! 3. per hex: repeated nodes, corners that are inside out;
//! 4. hexes with the same nodes;
//! 5. per face: three or more hexes, two hexes on one side, the same nodes in another order; groups of faces that
//!    do not exist, or from both sides;
//! 6. per edge: faces that share three nodes, boundary faces other than two;
//! 7. per node: unused, links that are neither a sphere nor, on the boundary, a disc;
//! 8. boundary nodes inside boundary edges and faces that they are no corner of.
//!
//! Time grows linearly with the mesh, but for the search trees over the boundary of step 8.

use super::hanging::{self, InEdge, InFace};
use super::{Defect, not_finite, repeated_node};
use crate::geometry::Point;
use crate::mesh::orientation::inverted_corners;
use crate::mesh::topology::{Bins, HexFaces, HexTopology, NodeSets, Side, degrees, hex_of, side_nodes};
use crate::mesh::{EdgeId, FaceId, HexId, HexMesh, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent, parallel};

/// Everything wrong with a hex mesh; empty for a conforming manifold with boundary, without loose nodes, whose
/// hexes are the right way out at all corners.
pub fn check_hexes(mesh: &HexMesh) -> Vec<Defect> {
    check_hexes_within(mesh, &Silent).expect("nobody stops it")
}

/// As [`check_hexes`], told by a monitor when to stop.
///
/// # Errors
/// If the monitor stops it.
pub fn check_hexes_within(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<Vec<Defect>, Cancelled> {
    monitor.proceed()?;
    let defects = per_hex(mesh, |h| ids(mesh, h), monitor)?;
    if !defects.is_empty() {
        return Ok(defects);
    }
    let topology = HexTopology::within(mesh, monitor)?;
    let mut defects = by_topology(mesh, &topology, monitor)?;
    let boundary = Boundary::of(&topology);
    // It takes several times what the search trees do.
    drop(topology);
    defects.extend(boundary.hanging(mesh, monitor)?);
    Ok(defects)
}

/// As [`check_hexes_within`], for callers that have the mesh's topology; its node ids are in range.
///
/// # Errors
/// If the monitor stops it.
pub fn check_hexes_on(
    mesh: &HexMesh,
    topology: &HexTopology,
    monitor: &dyn Monitor,
) -> Result<Vec<Defect>, Cancelled> {
    let mut defects = by_topology(mesh, topology, monitor)?;
    defects.extend(Boundary::of(topology).hanging(mesh, monitor)?);
    Ok(defects)
}

/// Steps 2 to 7.
fn by_topology(
    mesh: &HexMesh,
    topology: &HexTopology,
    monitor: &dyn Monitor,
) -> Result<Vec<Defect>, Cancelled> {
    monitor.proceed()?;
    let HexTopology { faces, links, .. } = topology;
    let mut defects = not_finite(&mesh.positions);
    defects.extend(per_hex(mesh, |h| shape(mesh, h), monitor)?);
    defects.extend(same_hexes(mesh, monitor)?);
    defects.extend(parallel::try_gather(faces.nodes.len(), monitor, |f, found| {
        found.extend(face_defect(mesh, faces, FaceId::new(f)));
    })?);
    defects.extend(mesh.groups.sides().iter().filter_map(|&side| group_defect(mesh, faces, side)));
    defects.extend(edge_defects(topology, monitor)?);
    let unused = (0..links.len()).filter(|&n| !links.is_used(n));
    defects.extend(unused.map(|n| Defect::UnusedNode { node: NodeId::new(n) }));
    let odd = |(node, euler): (NodeId, i32)| {
        let boundary = links.on_boundary[node.index()];
        Defect::OddLink { node, euler, boundary }
    };
    defects.extend(links.odd().map(odd));
    monitor.proceed()?;
    Ok(defects)
}

/// What step 8 looks at.
struct Boundary {
    faces: Vec<[NodeId; 4]>,
    /// The hex of each.
    hexes: Vec<HexId>,
    /// Is a node on it?
    has: Vec<bool>,
}

impl Boundary {
    fn of(topology: &HexTopology) -> Self {
        let HexTopology { faces, links, .. } = topology;
        let open = || faces.ids().filter(|&f| faces.is_boundary(f));
        Self {
            faces: open().map(|f| faces.nodes[f.index()]).collect(),
            hexes: open().map(|f| hex_of(faces.sides(f)[0])).collect(),
            has: links.on_boundary.clone(),
        }
    }

    /// Step 8, if all coordinates are finite.
    fn hanging(self, mesh: &HexMesh, monitor: &dyn Monitor) -> Result<Vec<Defect>, Cancelled> {
        let Self { faces, hexes, has } = self;
        if !not_finite(&mesh.positions).is_empty() {
            return Ok(Vec::new());
        }
        let (in_edges, in_faces) = hanging_in(&mesh.positions, &has, &faces, monitor)?;
        let in_face = |(node, place): InFace| {
            let (face, hex) = (faces[place as usize], hexes[place as usize]);
            Defect::HangingNodeInFace { node, face, hex }
        };
        Ok(in_edges.into_iter().map(hanging::defect).chain(in_faces.into_iter().map(in_face)).collect())
    }
}

/// The nodes that lie inside an edge or a face of a boundary of which these are all faces, or some, in no order. All coordinates
/// are finite.
///
/// # Errors
/// If the monitor stops it.
pub(crate) fn hanging_on(
    mesh: &HexMesh,
    faces: &[[NodeId; 4]],
    monitor: &dyn Monitor,
) -> Result<Vec<NodeId>, Cancelled> {
    let mut has = vec![false; mesh.positions.len()];
    faces.as_flattened().iter().for_each(|n| has[n.index()] = true);
    let (in_edges, in_faces) = hanging_in(&mesh.positions, &has, faces, monitor)?;
    let nodes = in_edges.into_iter().map(|(node, _)| node).chain(in_faces.into_iter().map(|(node, _)| node));
    Ok(nodes.collect())
}

/// Of the `used` nodes those inside edges of the faces, and those inside faces, each with what it is inside of.
fn hanging_in(
    positions: &[Point],
    used: &[bool],
    faces: &[[NodeId; 4]],
    monitor: &dyn Monitor,
) -> Result<(Vec<InEdge>, Vec<InFace>), Cancelled> {
    let mut edges: Vec<[NodeId; 2]> = faces.iter().flat_map(edges_around).collect();
    edges.sort_unstable();
    edges.dedup();
    monitor.proceed()?;
    let in_edges = hanging::inside(positions, used, edges, monitor)?;
    Ok((in_edges, hanging::inside_faces(positions, used, faces, monitor)?))
}

/// The edges around a face, the lesser end first.
fn edges_around(face: &[NodeId; 4]) -> [[NodeId; 2]; 4] {
    std::array::from_fn(|k| {
        let (a, b) = (face[k], face[(k + 1) % 4]);
        [a.min(b), a.max(b)]
    })
}

/// What `look` finds at each hex, in order of hexes.
fn per_hex(
    mesh: &HexMesh,
    look: impl Fn(usize) -> Option<Defect> + Sync,
    monitor: &dyn Monitor,
) -> Result<Vec<Defect>, Cancelled> {
    parallel::try_gather(mesh.hexes.len(), monitor, |h, found| found.extend(look(h)))
}

/// Step 1 at one hex.
fn ids(mesh: &HexMesh, h: usize) -> Option<Defect> {
    let count = mesh.positions.len();
    let wrong = mesh.hexes[h].iter().find(|n| n.index() >= count);
    wrong.map(|&node| Defect::HexNodeOutOfRange { hex: HexId::new(h), node, nodes: count as u32 })
}

/// Step 3 at one hex: a hex with a repeated node is not told to be inside out as well.
fn shape(mesh: &HexMesh, h: usize) -> Option<Defect> {
    let (hex, nodes) = (HexId::new(h), &mesh.hexes[h]);
    if let Some(node) = repeated_node(nodes) {
        return Some(Defect::HexRepeatedNode { hex, node });
    }
    let corners = inverted_corners(&nodes.map(|n| mesh.positions[n.index()])).count_ones();
    (corners > 0).then_some(Defect::InvertedHex { hex, corners })
}

/// Step 4.
fn same_hexes(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<Vec<Defect>, Cancelled> {
    let degrees = degrees(mesh.positions.len(), mesh.hexes.as_flattened());
    let mut sets = NodeSets::new(&degrees, mesh.hexes.len());
    let mut first_of_set = Vec::with_capacity(mesh.hexes.len());
    let mut defects = Vec::new();
    for batch in batches(mesh.hexes.len(), monitor) {
        for h in batch? {
            let hex_id = HexId::new(h);
            match first_of_set.get(sets.number(mesh.hexes[h]) as usize) {
                None => first_of_set.push(hex_id),
                Some(&first) => defects.push(Defect::SameHexes { hexes: [first, hex_id] }),
            }
        }
    }
    Ok(defects)
}

/// Step 5 at one face.
fn face_defect(mesh: &HexMesh, faces: &HexFaces, f: FaceId) -> Option<Defect> {
    let face = faces.nodes[f.index()];
    match *faces.sides(f) {
        [_] => None,
        [first, second] => {
            let hexes = [first, second].map(hex_of);
            let other = side_nodes(&mesh.hexes, second);
            if is_turned(face, other) {
                return None;
            }
            let reversed = [other[0], other[3], other[2], other[1]];
            Some(if is_turned(face, reversed) {
                Defect::FaceDisagreement { face, hexes }
            } else {
                Defect::CrossedFace { face, other, hexes }
            })
        }
        ref sides => {
            Some(Defect::NonManifoldFace { face, hexes: sides.iter().map(|&s| hex_of(s)).collect() })
        }
    }
}

/// Step 5 at one side of a group.
fn group_defect(mesh: &HexMesh, faces: &HexFaces, side: Side) -> Option<Defect> {
    let (hex, face) = (hex_of(side), (side % 6) as u8);
    let Some(of_hex) = faces.of_hex.get(hex.index()) else {
        return Some(Defect::NoSuchFace { hex, face });
    };
    let comes_before = |other: &Side| *other < side && mesh.groups.sides().binary_search(other).is_ok();
    let sides = faces.sides(of_hex[usize::from(face)]);
    sides.iter().any(comes_before).then_some(Defect::FaceGroupedTwice { hex, face })
}

/// True if `b` walks around the nodes of `a` the other way: as it should be seen from the hex on the other side.
fn is_turned(a: [NodeId; 4], b: [NodeId; 4]) -> bool {
    (0..4).any(|shift| (0..4).all(|k| a[k] == b[(shift + 4 - k) % 4]))
}

/// Step 6.
fn edge_defects(topology: &HexTopology, monitor: &dyn Monitor) -> Result<Vec<Defect>, Cancelled> {
    let HexTopology { faces, edges, .. } = topology;
    let uses = topology.uses(monitor)?;
    let mut shared: Vec<[FaceId; 2]> = parallel::try_gather(edges.ends.len(), monitor, |e, found| {
        let e = EdgeId::new(e);
        if !beside_each_other(topology, &uses, e) {
            found.extend(sharing_three_nodes(topology, &uses, e));
        }
    })?;
    // Faces with three common nodes may have two common edges.
    parallel::sort(&mut shared);
    shared.dedup();
    let hex = |f: FaceId| hex_of(faces.sides(f)[0]);
    let told = shared.into_iter().map(|pair| Defect::ThreeSharedNodes {
        faces: pair.map(|f| faces.nodes[f.index()]),
        hexes: pair.map(hex),
    });
    let odd: Vec<EdgeId> = topology.odd_rims().collect();
    let boundary = topology.boundary_faces_at(&odd);
    let rims = boundary.chunk_by(|a, b| a.0 == b.0).map(|at| Defect::NonManifoldRim {
        edge: edges.ends[at[0].0.index()],
        hexes: at.iter().map(|&(_, f)| hex(f)).collect(),
    });
    Ok(told.chain(rims).collect())
}

/// Most faces at an edge that are looked at without lists.
const FEW: usize = 8;

/// Are there few faces at an edge, which share no node but its ends? That is so at nearly every edge, and soon seen.
fn beside_each_other(topology: &HexTopology, uses: &Bins, e: EdgeId) -> bool {
    let ends = topology.edges.ends[e.index()];
    let (mut faces, mut count) = ([FaceId(u32::MAX); FEW], 0);
    let mut beside = [NodeId(u32::MAX); 2 * FEW];
    for f in uses.at(e.index()).iter().flat_map(|&u| topology.faces_at_use(u)) {
        if faces[..count].contains(&f) {
            continue;
        }
        if count == FEW {
            return false;
        }
        let others = topology.faces.nodes[f.index()].into_iter().filter(|n| !ends.contains(n));
        for (k, node) in others.enumerate() {
            if k == 2 || beside[..2 * count].contains(&node) {
                return false;
            }
            beside[2 * count + k] = node;
        }
        faces[count] = f;
        count += 1;
    }
    true
}

/// The pairs of faces at an edge that have another node in common: two triples of nodes in a quad share an edge of
/// each, so all pairs with three common nodes are found at edges.
fn sharing_three_nodes(topology: &HexTopology, uses: &Bins, e: EdgeId) -> Vec<[FaceId; 2]> {
    let ends = topology.edges.ends[e.index()];
    let at_edge = uses.at(e.index()).iter().flat_map(|&u| topology.faces_at_use(u));
    let mut beside: Vec<(NodeId, FaceId)> = at_edge
        .flat_map(|f| topology.faces.nodes[f.index()].map(|n| (n, f)))
        .filter(|(n, _)| !ends.contains(n))
        .collect();
    beside.sort_unstable();
    beside.dedup();
    let twice = beside.windows(2).filter(|w| w[0].0 == w[1].0);
    twice.map(|w| [w[0].1, w[1].1]).collect()
}

#[cfg(test)]
mod tests;
