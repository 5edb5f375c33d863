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
        let degrees = degrees(node_count, hexes.as_flattened());
        let shares = parallel::shares(node_count, 6 * hexes.len());
        let (nodes, of_hex) = match shares.len() {
            1 => numbered(&degrees, hexes, FACES, FaceId, monitor)?,
            _ => faces_in_shares(&degrees, &shares, hexes, monitor)?,
        };
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
        let degrees = degrees(node_count, hexes.as_flattened());
        let (ends, of_hex) = numbered(&degrees, hexes, EDGES, EdgeId, monitor)?;
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
fn numbered<const N: usize, const PARTS: usize, Id>(
    degrees: &[u32],
    hexes: &[[NodeId; 8]],
    table: [[u8; N]; PARTS],
    id: impl Fn(u32) -> Id,
    monitor: &dyn Monitor,
) -> Result<Numbered<N, PARTS, Id>, Cancelled> {
    let mut sets = NodeSets::new(degrees, expected(hexes));
    let mut of_hex = Vec::with_capacity(hexes.len());
    for batch in batches(hexes.len(), monitor) {
        let parts = |hex: &[NodeId; 8]| table.map(|local| id(sets.number(corners(hex, local))));
        of_hex.extend(hexes[batch?].iter().map(parts));
    }
    Ok((sets.into_nodes(), of_hex))
}

/// How many faces or edges so many hexes have: three for each hex inside and more on the boundary, seldom more than three and a
/// half.
fn expected(hexes: &[[NodeId; 8]]) -> usize {
    7 * hexes.len() / 2
}

/// Numbers faces by many threads, each of which finds those that a share of the nodes own. The number of a face is the place of
/// its first side among the first sides of all.
fn faces_in_shares(
    degrees: &[u32],
    shares: &[Range<usize>],
    hexes: &[[NodeId; 8]],
    monitor: &dyn Monitor,
) -> Result<Numbered<4, 6, FaceId>, Cancelled> {
    /// Is set with the first side of a face in all others.
    const LATER: u32 = 1 << 31;
    let sides = 6 * hexes.len();
    assert!(sides <= LATER as usize, "no more than 2^31 sides");
    let number: Vec<AtomicU32> = parallel::try_collect(sides, monitor, |_| AtomicU32::new(0))?;
    let expected = expected(hexes) / shares.len();
    let done = parallel::try_collect(shares.len(), monitor, |k| {
        let mut sets = NodeSets::of_owners(degrees, shares[k].clone(), expected);
        let mut first: Vec<Side> = Vec::with_capacity(expected);
        for batch in batches(sides, monitor) {
            for side in batch?.map(|side| side as Side) {
                match sets.number_if_owned(side_nodes(hexes, side)).map(|set| first.get(set as usize)) {
                    Some(Some(first)) => number[side as usize].store(LATER | first, Relaxed),
                    Some(None) => first.push(side),
                    None => {}
                }
            }
        }
        Ok(())
    })?;
    done.into_iter().collect::<Result<(), Cancelled>>()?;
    let first = parallel::try_filter(sides, monitor, |side| number[side].load(Relaxed) < LATER)?;
    parallel::for_each(first.len(), |k| number[first[k] as usize].store(k as u32, Relaxed));
    let nodes = parallel::try_collect(first.len(), monitor, |k| side_nodes(hexes, first[k]))?;
    drop(first);
    let of_hex = parallel::try_collect(hexes.len(), monitor, |h| {
        std::array::from_fn(|k| match number[6 * h + k].load(Relaxed) {
            later if later >= LATER => FaceId(number[(later - LATER) as usize].load(Relaxed)),
            number => FaceId(number),
        })
    })?;
    Ok((nodes, of_hex))
}

/// Some corners of a hex.
pub(super) fn corners<const N: usize>(hex: &[NodeId; 8], local: [u8; N]) -> [NodeId; N] {
    local.map(|k| hex[usize::from(k)])
}
