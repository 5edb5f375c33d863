//! All that the nodes of a hex mesh's hexes say: its faces and edges, and how they meet.

use super::{Bins, HexEdges, HexFaces, Links};
use crate::mesh::numbering::hex::{EDGES_OF_FACE, FACES_AT_EDGE};
use crate::mesh::{EdgeId, FaceId, HexMesh};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent, parallel};

/// The faces and edges of a hex mesh, and how they meet: what [`hex_report`](super::hex_report) and
/// [`check_hexes_on`](crate::mesh::check::check_hexes_on) read.
///
/// ```
/// use hexmill::geometry::{Aabb, Point};
/// use hexmill::mesh::{GridOptions, hex_grid, topology::{HexTopology, hex_report}};
/// let grid = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 8 };
/// let cubes = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(2.0) }, &grid)?;
/// let topology = HexTopology::of(&cubes);
/// assert_eq!((topology.faces.nodes.len(), topology.edges.ends.len()), (36, 54));
/// assert!(hex_report(&topology).is_manifold());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HexTopology {
    /// The faces.
    pub faces: HexFaces,
    /// The edges.
    pub edges: HexEdges,
    /// The links of the nodes.
    pub(crate) links: Links,
    /// How many boundary faces each edge has; [`u8::MAX`] for more.
    rims: Vec<u8>,
}

impl HexTopology {
    /// The topology of a mesh.
    ///
    /// # Panics
    /// If a node id is out of range: `check_hexes` tells before.
    pub fn of(mesh: &HexMesh) -> Self {
        Self::within(mesh, &Silent).expect("nobody stops it")
    }

    /// As [`HexTopology::of`], unless the monitor stops it.
    pub(crate) fn within(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let (node_count, hexes) = (mesh.positions.len(), mesh.hexes.as_slice());
        let (faces, edges) = parallel::join(
            || HexFaces::within(node_count, hexes, monitor),
            || HexEdges::within(node_count, hexes, monitor),
        );
        let (faces, edges) = (faces?, edges?);
        let (links, rims) = parallel::join(
            || Links::within(node_count, hexes, &faces, &edges, monitor),
            || rims(&faces, &edges, monitor),
        );
        let (links, rims) = (links?, rims?);
        Ok(Self { faces, edges, links, rims })
    }

    /// The edges with boundary faces, but not two.
    pub(crate) fn odd_rims(&self) -> impl Iterator<Item = EdgeId> {
        let is_odd = |(_, count): &(usize, &u8)| !matches!(count, 0 | 2);
        self.rims.iter().enumerate().filter(is_odd).map(|(e, _)| EdgeId::new(e))
    }

    /// The hexes at each edge, as `12 * h + k` for edge `k` of hex `h`.
    pub(crate) fn uses(&self, monitor: &dyn Monitor) -> Result<Bins, Cancelled> {
        let edges = self.edges.of_hex.as_flattened();
        Bins::monitored(self.edges.ends.len(), edges.len(), |k| edges[k].index(), monitor)
    }

    /// The two faces at edge `k` of hex `h`, where `u` is `12 * h + k`.
    pub(crate) fn faces_at_use(&self, u: u32) -> [FaceId; 2] {
        let of_hex = self.faces.of_hex[u as usize / 12];
        FACES_AT_EDGE[u as usize % 12].map(|k| of_hex[usize::from(k)])
    }

    /// The boundary faces at some edges, by edge, then by face. `odd` ascends.
    pub(crate) fn boundary_faces_at(&self, odd: &[EdgeId]) -> Vec<(EdgeId, FaceId)> {
        let is_wanted = |e: &EdgeId| odd.binary_search(e).is_ok();
        let mut found: Vec<(EdgeId, FaceId)> =
            boundary_with_edges(&self.faces, &self.edges, 0..self.faces.nodes.len())
                .flat_map(|(f, edges)| edges.into_iter().filter(is_wanted).map(move |e| (e, f)))
                .collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// How many boundary faces each edge has.
fn rims(faces: &HexFaces, edges: &HexEdges, monitor: &dyn Monitor) -> Result<Vec<u8>, Cancelled> {
    let mut rims = vec![0_u8; edges.ends.len()];
    for batch in batches(faces.nodes.len(), monitor) {
        for (_, edges) in boundary_with_edges(faces, edges, batch?) {
            for (k, e) in edges.iter().enumerate() {
                // A face that walks an edge twice has it once.
                if !edges[..k].contains(e) {
                    rims[e.index()] = rims[e.index()].saturating_add(1);
                }
            }
        }
    }
    Ok(rims)
}

/// The boundary faces of a range, each with its edges.
fn boundary_with_edges(
    faces: &HexFaces,
    edges: &HexEdges,
    range: std::ops::Range<usize>,
) -> impl Iterator<Item = (FaceId, [EdgeId; 4])> {
    range.map(FaceId::new).filter(|&f| faces.is_boundary(f)).map(|f| {
        let side = faces.sides(f)[0] as usize;
        let of_hex = edges.of_hex[side / 6];
        (f, EDGES_OF_FACE[side % 6].map(|k| of_hex[usize::from(k)]))
    })
}
