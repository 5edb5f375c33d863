//! The cells of a background mesh: what they border on, where they are, how large.

use crate::geometry::Point;
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::topology::{Bins, HexFaces, hex_of};
use crate::mesh::{HexMesh, NodeId};
use crate::{Cancelled, Monitor, parallel};

/// The cells of a background mesh.
pub(in super::super) struct Cells<'a> {
    pub mesh: &'a HexMesh,
    /// For each cell the cells across its faces, or [`NONE`] on the boundary of the mesh.
    pub neighbours: Vec<[u32; 6]>,
    /// For each node the corners of cells that are there, as `8 * cell + corner`.
    pub at_node: Bins,
}

/// No cell.
pub(in super::super) const NONE: u32 = u32::MAX;

/// Each value once, ascending.
pub(super) fn distinct<T: Ord>(mut all: Vec<T>) -> Vec<T> {
    all.sort_unstable();
    all.dedup();
    all
}

impl<'a> Cells<'a> {
    /// Looks a conforming mesh over.
    #[inline(never)] // Compiled once for all that call it.
    pub fn of(mesh: &'a HexMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let node_count = mesh.positions.len();
        let faces = HexFaces::within(node_count, &mesh.hexes, monitor)?;
        let across = |h: usize, k: usize| {
            let sides = faces.sides(faces.of_hex[h][k]).iter();
            sides.map(|&side| hex_of(side).0).find(|&other| other as usize != h).unwrap_or(NONE)
        };
        let neighbours =
            parallel::try_collect(mesh.hexes.len(), monitor, |h| std::array::from_fn(|k| across(h, k)))?;
        let corners = mesh.hexes.as_flattened();
        let at_node = Bins::monitored(node_count, corners.len(), |k| corners[k].index(), monitor)?;
        Ok(Self { mesh, neighbours, at_node })
    }

    pub fn len(&self) -> usize {
        self.neighbours.len()
    }

    pub fn corners(&self, cell: usize) -> [Point; 8] {
        self.mesh.hexes[cell].map(|n| self.mesh.positions[n.index()])
    }

    /// The mean of the corners.
    pub fn barycentre(&self, cell: usize) -> Point {
        self.corners(cell).iter().sum::<Point>() / 8.0
    }

    /// The mean length of the edges.
    pub fn edge_length(&self, cell: usize) -> f64 {
        let at = self.corners(cell);
        EDGES.iter().map(|&[a, b]| at[usize::from(a)].distance(at[usize::from(b)])).sum::<f64>() / 12.0
    }

    /// The cells at a node, each with its corner there.
    pub fn around(&self, node: NodeId) -> impl ExactSizeIterator<Item = (usize, usize)> + '_ {
        self.at_node.at(node.index()).iter().map(|&place| (place as usize / 8, place as usize % 8))
    }

    /// The cells across the faces of a cell that are there.
    pub fn beside(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        self.neighbours[cell].iter().filter(|&&other| other != NONE).map(|&other| other as usize)
    }
}
