//! The cells of a background mesh: what they border on, where they are, how large.

use crate::geometry::Point;
use crate::mesh::numbering::hex::{EDGES, FACES};
use crate::mesh::topology::Bins;
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
        let corners = mesh.hexes.as_flattened();
        let at_node = Bins::monitored(mesh.positions.len(), corners.len(), |k| corners[k].index(), monitor)?;
        let neighbours = parallel::try_collect(mesh.hexes.len(), monitor, |h| {
            FACES.map(|face| across(mesh, &at_node, h, face.map(|k| mesh.hexes[h][usize::from(k)])))
        })?;
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

/// The other cell that has a face of `cell`, or [`NONE`]: of those at both ends of a diagonal the one that has all of it. Looking
/// there takes no list of all faces, which would be several times as large as what comes of it.
fn across(mesh: &HexMesh, at_node: &Bins, cell: usize, [a, b, c, d]: [NodeId; 4]) -> u32 {
    let [at_a, mut at_c] = [a, c].map(|n| at_node.at(n.index()));
    for &place in at_a {
        let other = place / 8;
        while let [first, rest @ ..] = at_c
            && first / 8 < other
        {
            at_c = rest;
        }
        let has = |n: NodeId| mesh.hexes[other as usize].contains(&n);
        if at_c.first().is_some_and(|first| first / 8 == other) && other as usize != cell && has(b) && has(d)
        {
            return other;
        }
    }
    NONE
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::mesh::topology::{HexFaces, hex_of};
    use crate::mesh::{GridOptions, hex_grid};
    use crate::refine::hex::{HexOptions, refine_hexes};
    use crate::sizing::{Region, Shape, Target};

    /// Of a grid that is refined at a corner, with transitions.
    #[test]
    fn neighbours_are_those_that_share_faces() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 1000 };
        let grid = hex_grid(crate::geometry::Aabb { min: Point::ZERO, max: Point::splat(4.0) }, &options);
        let corner = Shape::Sphere { center: Point::ZERO, radius: 1.0 };
        let regions = vec![Region { shape: corner, target: Target::Level(2) }];
        let options = HexOptions { regions, ..HexOptions::default() };
        let mesh = refine_hexes(&grid.unwrap(), &options, &Silent).unwrap().mesh;
        let cells = Cells::of(&mesh, &Silent).unwrap();
        let faces = HexFaces::of(mesh.positions.len(), &mesh.hexes);
        for cell in 0..cells.len() {
            let across = faces.of_hex[cell].map(|face| {
                let others = faces.sides(face).iter().map(|&side| hex_of(side).0);
                others.filter(|&other| other as usize != cell).collect::<Vec<_>>()
            });
            let neighbours = cells.neighbours[cell].map(|other| [other].repeat((other != NONE).into()));
            assert_eq!(neighbours, across, "{cell}");
        }
        assert!(cells.len() > 300, "{}", cells.len());
    }
}
