//! The part of a mesh that smoothing a stage's transition looks at: the hexes around the nodes that may move. All work
//! and memory for smoothing follows from it, not from the mesh.

use super::labels::{group_of, label_of};
use super::stage::{StageMesh, StageResult};
use crate::geometry::Point;
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::topology::{HexFaces, Side, hex_of};
use crate::mesh::{FaceId, HexId, NodeId, QuadMesh};
use crate::optimize::{BoundarySurface, Constraints, FaceKind, OptimizeOptions, OptimizeReport, optimize};
use crate::{Cancelled, Monitor, parallel};

/// Nodes that are further off the boundary than this share of the shortest edge have left it.
const STRAYED: f64 = 1e-6;

/// Some hexes of a mesh, over nodes of their own.
pub(super) struct Local {
    /// Coordinates of the nodes, in the mesh's order.
    positions: Vec<Point>,
    /// The nodes' numbers in the mesh, ascending.
    nodes: Vec<NodeId>,
    /// The hexes, in the mesh's order.
    hexes: Vec<[NodeId; 8]>,
    /// Their numbers in the mesh.
    pub(super) hex_ids: Vec<HexId>,
    /// For each node: may it move? All hexes of the mesh at such a node are here.
    movable: Vec<bool>,
    /// For each node: does it stay where the surface is curved? Empty if none does.
    stays_if_curved: Vec<bool>,
}

impl Local {
    /// The hexes at the nodes of a stage's layer, which may move, and those that came from the same hexes.
    pub(super) fn around(stage: &StageResult, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        Self::of_movable(stage, &is_of_layer(stage), monitor)
    }

    /// The hexes at nodes up to `rings` of hexes away from those of `some`, which may move; where the surface is curved only
    /// if they are the layer's, since what is divided later stands on the chords between the others.
    pub(super) fn beside(
        stage: &StageResult,
        some: &[HexId],
        rings: usize,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let near = near(stage, some, rings, monitor)?;
        let local = Self::of_movable(stage, &near, monitor)?;
        let is_of_layer = |n: &NodeId| stage.layer_nodes.binary_search(n).is_ok();
        Ok(Self { stays_if_curved: local.nodes.iter().map(|n| !is_of_layer(n)).collect(), ..local })
    }

    fn of_movable(stage: &StageResult, moves: &[bool], monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let mesh = &stage.mesh;
        Self::of_hexes(&mesh.positions, |h| mesh.hexes[h], of_same(stage, moves, monitor)?, moves, monitor)
    }

    /// Those of `count` hexes that are at the nodes that move.
    pub(super) fn at(
        positions: &[Point],
        (count, hex): (usize, impl Fn(usize) -> [NodeId; 8] + Sync),
        moves: &[bool],
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let is_near = |h: usize| hex(h).iter().any(|n| moves[n.index()]);
        let hex_ids = parallel::try_filter(count, monitor, is_near)?.into_iter().map(HexId).collect();
        Self::of_hexes(positions, hex, hex_ids, moves, monitor)
    }

    fn of_hexes(
        positions: &[Point],
        hex: impl Fn(usize) -> [NodeId; 8] + Sync,
        hex_ids: Vec<HexId>,
        moves: &[bool],
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let nodes_of = |k: usize| hex(hex_ids[k].index()).map(NodeId::index);
        let has = parallel::flags(positions.len(), hex_ids.len(), nodes_of);
        let nodes: Vec<NodeId> =
            parallel::try_filter(has.len(), monitor, |n| has[n])?.into_iter().map(NodeId).collect();
        drop(has);
        let mut number = vec![NodeId(u32::MAX); positions.len()];
        nodes.iter().enumerate().for_each(|(k, n)| number[n.index()] = NodeId::new(k));
        monitor.proceed()?;
        Ok(Self {
            positions: nodes.iter().map(|n| positions[n.index()]).collect(),
            hexes: parallel::try_collect(hex_ids.len(), monitor, |k| nodes_of(k).map(|n| number[n]))?,
            movable: nodes.iter().map(|n| moves[n.index()]).collect(),
            stays_if_curved: Vec::new(),
            nodes,
            hex_ids,
        })
    }

    /// The faces of the hexes.
    pub(super) fn faces(&self, monitor: &dyn Monitor) -> Result<HexFaces, Cancelled> {
        HexFaces::within(self.positions.len(), &self.hexes, monitor)
    }

    /// The faces of the hexes, as nodes are kept on some; none where the boundary is free, since such a mesh is of one material.
    pub(super) fn kept_faces(
        &self,
        mesh: &StageMesh,
        monitor: &dyn Monitor,
    ) -> Result<Option<HexFaces>, Cancelled> {
        if mesh.has_free_boundary { Ok(None) } else { self.faces(monitor).map(Some) }
    }

    /// Where the nodes may go. Only what is said of movable ones counts: a boundary face with such a node is known for
    /// one, and one between materials too, since all hexes there are at hand.
    pub(super) fn constraints<'a>(
        &self,
        faces: HexFaces,
        mesh: &StageMesh,
        surface: &'a BoundarySurface,
        monitor: &dyn Monitor,
    ) -> Result<Constraints<'a>, Cancelled> {
        let has_movable = |nodes: &[NodeId; 4]| nodes.iter().any(|n| self.movable[n.index()]);
        let in_mesh = |side: Side| self.hex_ids[hex_of(side).index()];
        let label = |side: Side| label_of(&mesh.labels, 6 * in_mesh(side).0 + side % 6);
        let kind = |f: FaceId| match *faces.sides(f) {
            [side] => Some(FaceKind::boundary(label(side), mesh.material(in_mesh(side)))),
            [a, b] => FaceKind::between([a, b].map(|s| mesh.material(in_mesh(s))), || group_of(label(a))),
            _ => None,
        };
        let movable = faces.ids().filter(|&f| has_movable(&faces.nodes[f.index()]));
        let (quads, kinds): (Vec<[NodeId; 4]>, Vec<FaceKind>) =
            movable.filter_map(|f| Some((faces.nodes[f.index()], kind(f)?))).unzip();
        drop(faces);
        let middle = |quad: &[NodeId; 4]| quad.iter().map(|n| self.positions[n.index()]).sum::<Point>() / 4.0;
        let patch = |k: usize| surface.patch_of(kinds[k], middle(&quads[k])).expect("faces keep their kinds");
        let patches = parallel::try_collect(quads.len(), monitor, patch)?;
        let boundary = QuadMesh { positions: self.positions.clone(), quads };
        let constraints = Constraints::of_boundary(&boundary, &patches, surface);
        if self.stays_if_curved.is_empty() {
            return Ok(constraints);
        }
        Ok(constraints.fixed_where_curved(|node| self.stays_if_curved[node.index()]))
    }

    /// Untangles and smooths the hexes of a stage, whose faces tell what their nodes are kept on: nothing, if there are none.
    /// Those that stay inverted, by their numbers in the mesh.
    pub(super) fn relax(
        &mut self,
        stage: &StageResult,
        faces: Option<HexFaces>,
        surface: &BoundarySurface,
        options: &OptimizeOptions,
        monitor: &dyn Monitor,
    ) -> Result<Vec<HexId>, Cancelled> {
        let constraints = match faces {
            Some(faces) => self.constraints(faces, &stage.mesh, surface, monitor)?,
            None => Constraints::none(self.node_count()),
        };
        let mut report = self.optimize(&constraints, options, monitor)?;
        if report.off_boundary > STRAYED * self.shortest_edge() {
            // A node has passed the end of its patch: it lies in the plane of that, but no more on the boundary.
            self.put_back(&stage.mesh.positions);
            report = self.optimize(&constraints.bounded(), options, monitor)?;
        }
        Ok(report.inverted.iter().map(|h| self.hex_ids[h.index()]).collect())
    }

    /// Untangles and smooths the hexes.
    pub(super) fn optimize(
        &mut self,
        constraints: &Constraints,
        options: &OptimizeOptions,
        monitor: &dyn Monitor,
    ) -> Result<OptimizeReport, Cancelled> {
        let Self { positions, hexes, movable, .. } = self;
        optimize(positions, hexes, movable, constraints, options, monitor)
    }

    /// How many nodes there are.
    pub(super) fn node_count(&self) -> usize {
        self.positions.len()
    }

    /// Is no movable node on the boundary? All hexes at such a node are here, so that its faces show it.
    pub(super) fn is_inside(&self, faces: &HexFaces) -> bool {
        let is_movable = |f: FaceId| faces.nodes[f.index()].iter().any(|n| self.movable[n.index()]);
        !faces.ids().any(|f| faces.is_boundary(f) && is_movable(f))
    }

    /// The length of the shortest edge.
    fn shortest_edge(&self) -> f64 {
        let length = |hex: &[NodeId; 8], [a, b]: [u8; 2]| {
            let [a, b] = [a, b].map(|k| self.positions[hex[usize::from(k)].index()]);
            a.distance_squared(b)
        };
        let of_hex =
            |hex: &[NodeId; 8]| EDGES.map(|ends| length(hex, ends)).into_iter().fold(f64::INFINITY, f64::min);
        self.hexes.iter().map(of_hex).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Moves the nodes back to where the mesh's are.
    fn put_back(&mut self, positions: &[Point]) {
        for (node, point) in self.nodes.iter().zip(&mut self.positions) {
            *point = positions[node.index()];
        }
    }

    /// Moves the mesh's nodes to where these are.
    pub(super) fn write_back(&self, positions: &mut [Point]) {
        for (node, point) in self.nodes.iter().zip(&self.positions) {
            positions[node.index()] = *point;
        }
    }
}

/// Untangles and smooths what is around the layer of a stage whose nodes are kept nowhere: so nothing has to be taken out of its
/// mesh. The hexes that stay inverted, and those that were looked at.
pub(super) fn relax_freely(
    stage: &mut StageResult,
    options: &OptimizeOptions,
    monitor: &dyn Monitor,
) -> Result<(Vec<HexId>, Vec<HexId>), Cancelled> {
    let moves = is_of_layer(stage);
    let around = of_same(stage, &moves, monitor)?;
    let StageMesh { positions, hexes, .. } = &mut stage.mesh;
    let anywhere = Constraints::none(positions.len());
    let mut inverted = optimize(positions, hexes, &moves, &anywhere, options, monitor)?.inverted;
    // What is doubtful elsewhere was so before.
    inverted.retain(|hex| around.binary_search(hex).is_ok());
    Ok((inverted, around))
}

/// For each node: is it of the stage's layer?
fn is_of_layer(stage: &StageResult) -> Vec<bool> {
    let mut is_of_layer = vec![false; stage.mesh.positions.len()];
    stage.layer_nodes.iter().for_each(|n| is_of_layer[n.index()] = true);
    is_of_layer
}

/// The hexes at nodes that move, and those that came from the same hexes: all that is left of a hex which lost room to the layer
/// is to be positive, and not at its nodes alone.
fn of_same(stage: &StageResult, moves: &[bool], monitor: &dyn Monitor) -> Result<Vec<HexId>, Cancelled> {
    let StageResult { mesh, from, .. } = stage;
    let is_near = |h: usize| mesh.hexes[h].iter().any(|n| moves[n.index()]);
    let near = parallel::try_filter(mesh.hexes.len(), monitor, is_near)?;
    let mut has_near = vec![false; from.iter().max().map_or(0, |&most| most as usize + 1)];
    near.iter().for_each(|&h| has_near[from[h as usize] as usize] = true);
    let of_same = parallel::try_filter(mesh.hexes.len(), monitor, |h| has_near[from[h] as usize])?;
    Ok(of_same.into_iter().map(HexId).collect())
}

/// The nodes up to `rings` of hexes away from those of some hexes.
fn near(
    stage: &StageResult,
    of: &[HexId],
    rings: usize,
    monitor: &dyn Monitor,
) -> Result<Vec<bool>, Cancelled> {
    let hexes = &stage.mesh.hexes;
    let mut near = vec![false; stage.mesh.positions.len()];
    of.iter().flat_map(|h| hexes[h.index()]).for_each(|n| near[n.index()] = true);
    for _ in 0..rings {
        let ring = parallel::try_filter(hexes.len(), monitor, |h| hexes[h].iter().any(|n| near[n.index()]))?;
        ring.iter().flat_map(|&h| hexes[h as usize]).for_each(|n| near[n.index()] = true);
    }
    Ok(near)
}
