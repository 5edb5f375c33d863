//! The unique faces and edges of a hex mesh.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::{Bins, NodeSets, degrees};
use crate::mesh::numbering::hex::{EDGES, FACES};
use crate::mesh::{EdgeId, FaceId, HexId, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent, parallel};

/// A side: face `k` of hex `h`, in the order of [`FACES`], as `6 * h + k`.
pub type Side = u32;

/// The unique faces of a hex mesh, numbered in the order in which a walk over the hexes and their faces (in the order
/// of [`FACES`]) meets them. Faces are one if their sets of nodes are.
///
/// ```
/// use hexmill::mesh::{FaceId, NodeId, topology::HexFaces};
/// let two = [[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]].map(|hex| hex.map(NodeId));
/// let faces = HexFaces::of(12, &two);
/// assert_eq!(faces.nodes.len(), 11);
/// assert_eq!(faces.of_hex[0][3], faces.of_hex[1][5]);
/// assert_eq!(faces.sides(faces.of_hex[0][3]), [3, 6 + 5]);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HexFaces {
    /// The nodes of each face, anticlockwise seen from outside the first hex that has it.
    pub nodes: Vec<[NodeId; 4]>,
    /// The faces of each hex.
    pub of_hex: Vec<[FaceId; 6]>,
    /// The sides of each face.
    sides: Bins,
}

impl HexFaces {
    /// The faces of `hexes`, whose nodes are less than `node_count`.
    ///
    /// # Panics
    /// If a node id is out of range: `check_hexes` tells before.
    pub fn of(node_count: usize, hexes: &[[NodeId; 8]]) -> Self {
        Self::within(node_count, hexes, &Silent).expect("nobody stops it")
    }

    /// As [`HexFaces::of`], unless the monitor stops it.
    pub(crate) fn within(
        node_count: usize,
        hexes: &[[NodeId; 8]],
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let (nodes, of_hex) = numbered(node_count, hexes, FACES, FaceId, monitor)?;
        let sides =
            Bins::monitored(nodes.len(), 6 * of_hex.len(), |k| of_hex.as_flattened()[k].index(), monitor)?;
        Ok(Self { nodes, of_hex, sides })
    }

    /// The nodes of each face, the faces of each hex, and the sides of each face, ascending.
    pub(crate) fn into_parts(self) -> (Vec<[NodeId; 4]>, Vec<[FaceId; 6]>, Bins) {
        (self.nodes, self.of_hex, self.sides)
    }

    /// The sides of face `f`, ascending: one on the boundary, two inside.
    pub fn sides(&self, f: FaceId) -> &[Side] {
        self.sides.at(f.index())
    }

    /// True if one hex alone has face `f`.
    pub fn is_boundary(&self, f: FaceId) -> bool {
        self.sides(f).len() == 1
    }

    /// The faces in order.
    pub fn ids(&self) -> impl Iterator<Item = FaceId> + use<> {
        (0..self.nodes.len()).map(FaceId::new)
    }
}

/// The unique edges of a hex mesh, numbered in the order in which a walk over the hexes and their edges (in the
/// order of [`EDGES`]) meets them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HexEdges {
    /// The ends of each edge, in the order in which its first hex has them.
    pub ends: Vec<[NodeId; 2]>,
    /// The edges of each hex.
    pub of_hex: Vec<[EdgeId; 12]>,
}

impl HexEdges {
    /// The edges of `hexes`, whose nodes are less than `node_count`.
    ///
    /// # Panics
    /// If a node id is out of range: `check_hexes` tells before.
    pub fn of(node_count: usize, hexes: &[[NodeId; 8]]) -> Self {
        Self::within(node_count, hexes, &Silent).expect("nobody stops it")
    }

    /// As [`HexEdges::of`], unless the monitor stops it.
    pub(crate) fn within(
        node_count: usize,
        hexes: &[[NodeId; 8]],
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let (ends, of_hex) = numbered(node_count, hexes, EDGES, EdgeId, monitor)?;
        Ok(Self { ends, of_hex })
    }
}

/// The hex that has a side.
pub fn hex_of(side: Side) -> HexId {
    HexId(side / 6)
}

/// The nodes of a side, anticlockwise seen from outside its hex.
pub fn side_nodes(hexes: &[[NodeId; 8]], side: Side) -> [NodeId; 4] {
    corners(&hexes[side as usize / 6], FACES[side as usize % 6])
}

/// The faces that one hex alone has, anticlockwise seen from outside, each with its hex; in the order of
/// the hexes and of their faces in [`FACES`].
///
/// ```
/// use hexmill::mesh::{NodeId, topology::hex_boundary};
/// let two = [[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]].map(|hex| hex.map(NodeId));
/// assert_eq!(hex_boundary(&two).len(), 10);
/// ```
pub fn hex_boundary(hexes: &[[NodeId; 8]]) -> Vec<([NodeId; 4], HexId)> {
    let node_count = hexes.as_flattened().iter().max().map_or(0, |node| node.index() + 1);
    let faces = HexFaces::of(node_count, hexes);
    let boundary = faces.ids().filter(|&f| faces.is_boundary(f));
    boundary.map(|f| (faces.nodes[f.index()], hex_of(faces.sides(f)[0]))).collect()
}

/// The nodes of each part of some hexes, and the parts of each hex.
type Numbered<const N: usize, const PARTS: usize, Id> = (Vec<[NodeId; N]>, Vec<[Id; PARTS]>);

/// Numbers the parts of the hexes: each hex has one for each row of `table`.
fn numbered<const N: usize, const PARTS: usize, Id: Send>(
    node_count: usize,
    hexes: &[[NodeId; 8]],
    table: [[u8; N]; PARTS],
    id: impl Fn(u32) -> Id + Sync,
    monitor: &dyn Monitor,
) -> Result<Numbered<N, PARTS, Id>, Cancelled> {
    // Three for each hex inside and more on the boundary: seldom more than three and a half.
    let expected = 7 * hexes.len() / 2;
    let degrees = degrees(node_count, hexes.as_flattened());
    let shares = parallel::shares(node_count, PARTS * hexes.len());
    if shares.len() > 1 {
        return numbered_in_shares((&degrees, expected, shares), hexes, table, id, monitor);
    }
    let mut sets = NodeSets::new(&degrees, expected);
    let mut of_hex = Vec::with_capacity(hexes.len());
    for batch in batches(hexes.len(), monitor) {
        let parts = |hex: &[NodeId; 8]| table.map(|local| id(sets.number(corners(hex, local))));
        of_hex.extend(hexes[batch?].iter().map(parts));
    }
    Ok((sets.into_nodes(), of_hex))
}

/// The same by many threads, each of which finds those that a share of the nodes own. A use is `PARTS` times a hex, and the
/// row of the table there; the number of a part is the place of its first use among all such.
fn numbered_in_shares<const N: usize, const PARTS: usize, Id: Send>(
    (degrees, expected, shares): (&[u32], usize, Vec<Range<usize>>),
    hexes: &[[NodeId; 8]],
    table: [[u8; N]; PARTS],
    id: impl Fn(u32) -> Id + Sync,
    monitor: &dyn Monitor,
) -> Result<Numbered<N, PARTS, Id>, Cancelled> {
    /// Is set with the first use of a part in all others.
    const LATER: u32 = 1 << 31;
    let uses = PARTS * hexes.len();
    assert!(uses <= LATER as usize, "no more than 2^31 uses");
    let number: Vec<AtomicU32> = parallel::try_collect(uses, monitor, |_| AtomicU32::new(0))?;
    let expected = expected / shares.len();
    parallel::try_each_part(shares, monitor, |share| {
        let mut sets = NodeSets::of_owners(degrees, share.clone(), expected);
        let mut first: Vec<u32> = Vec::with_capacity(expected);
        for batch in batches(hexes.len(), monitor) {
            for h in batch? {
                for (k, local) in table.into_iter().enumerate() {
                    let part = PARTS * h + k;
                    match sets.number_if_owned(corners(&hexes[h], local)).map(|set| first.get(set as usize)) {
                        Some(Some(first)) => number[part].store(LATER | first, Relaxed),
                        Some(None) => first.push(part as u32),
                        None => {}
                    }
                }
            }
        }
        Ok(())
    })?;
    let first = parallel::try_filter(uses, monitor, |part| number[part].load(Relaxed) < LATER)?;
    parallel::for_each(first.len(), |k| number[first[k] as usize].store(k as u32, Relaxed));
    let part = |part: u32| corners(&hexes[part as usize / PARTS], table[part as usize % PARTS]);
    let nodes = parallel::try_collect(first.len(), monitor, |k| part(first[k]))?;
    drop(first);
    let of_hex = parallel::try_collect(hexes.len(), monitor, |h| {
        std::array::from_fn(|k| match number[PARTS * h + k].load(Relaxed) {
            later if later >= LATER => id(number[(later - LATER) as usize].load(Relaxed)),
            number => id(number),
        })
    })?;
    Ok((nodes, of_hex))
}

/// Some corners of a hex.
pub(super) fn corners<const N: usize>(hex: &[NodeId; 8], local: [u8; N]) -> [NodeId; N] {
    local.map(|k| hex[usize::from(k)])
}
