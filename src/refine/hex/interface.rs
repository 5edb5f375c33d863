//! The interface: where refined hexes and coarse ones meet.

use super::blocks::in_blocks;
use super::labels::{Label, group_of, label_of};
use super::part::Whole;
use super::skeleton::{Stars, one_way};
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES_AT;
use crate::mesh::topology::Side;
use crate::optimize::FaceKind;
use crate::{Cancelled, Monitor, parallel};

/// The nodes that refined and coarse hexes share, and the hexes there.
pub(super) struct Interface<'a> {
    pub(super) hexes: &'a [[NodeId; 8]],
    pub(super) refined: &'a [bool],
    /// The labels of faces.
    pub(super) labels: &'a [Label],
    /// The input hex of each hex, and the material of each of these; empty if there is one material.
    root: &'a [u32],
    pub(super) materials: &'a [u32],
    /// May nodes leave the boundary? Then it is as though there were none.
    pub(super) has_free_boundary: bool,
    /// Of the faces between refined and coarse hexes of different materials those that the coarse side keeps: their
    /// refined sides, ascending.
    pub(super) kept_by_coarse: Vec<Side>,
    /// The nodes, ascending.
    pub(super) nodes: Vec<NodeId>,
    /// Place of each node of the mesh in `nodes`, or [`NONE`].
    place: Vec<u32>,
    /// The hexes that have such a node, ascending.
    pub(super) shell: Vec<u32>,
    /// Their uses of the nodes.
    pub(super) stars: Stars,
}

const NONE: u32 = u32::MAX;

/// Hexes that are looked at before the monitor is asked again.
const BATCH: usize = 1 << 20;

impl<'a> Interface<'a> {
    /// The interface of the set `refined` of the hexes.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub(super) fn new(
        whole: Whole<'a>,
        refined: &'a [bool],
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let Whole { positions, hexes, labels, root, materials, has_free_boundary } = whole;
        let node_count = positions.len();
        // For each node whether a coarse hex has it, then whether a refined one does.
        let mut sides = vec![false; 2 * node_count];
        for batch in hexes.chunks(BATCH).zip(refined.chunks(BATCH)) {
            monitor.proceed()?;
            let (hexes, refined) = batch;
            let place = |k: usize| hexes[k].map(|n| 2 * n.index() + usize::from(refined[k]));
            parallel::raise(&mut sides, hexes.len(), place);
        }
        let nodes = parallel::try_filter(node_count, monitor, |n| sides[2 * n] && sides[2 * n + 1])?;
        let nodes: Vec<NodeId> = nodes.into_iter().map(NodeId).collect();
        drop(sides);
        let mut place = vec![NONE; node_count];
        (0..).zip(&nodes).for_each(|(k, n)| place[n.index()] = k);
        let is_shell = |hex: usize| hexes[hex].iter().any(|n| place[n.index()] != NONE);
        let shell = parallel::try_filter(hexes.len(), monitor, is_shell)?;
        // Nodes that are none of the interface share a last star, which is never asked for.
        let last = NodeId::new(nodes.len());
        let at = |node: NodeId| if place[node.index()] == NONE { last } else { NodeId(place[node.index()]) };
        let stars = Stars::new(nodes.len() + 1, shell.len(), |k| hexes[shell[k] as usize].map(at));
        monitor.proceed()?;
        let kept_by_coarse = Vec::new();
        Ok(Self {
            hexes,
            refined,
            labels,
            root,
            materials,
            has_free_boundary,
            kept_by_coarse,
            nodes,
            place,
            shell,
            stars,
        })
    }

    /// The material of a hex.
    pub(super) fn material(&self, hex: u32) -> u32 {
        if self.materials.is_empty() { 0 } else { self.materials[self.root[hex as usize] as usize] }
    }

    /// What a face of a star is, if nodes are kept on it: it is on the boundary or between materials.
    pub(super) fn kind(&self, star: &Star, face: &StarFace) -> Option<FaceKind> {
        let (hex, side) = face.first;
        let id = star.hexes[hex].0;
        match face.second {
            None if self.has_free_boundary => None,
            None => {
                let label = label_of(self.labels, 6 * id + Side::from(side));
                Some(FaceKind::boundary(label, self.material(id)))
            }
            Some(_) if self.materials.is_empty() => None,
            Some((second, _)) => {
                let materials = [id, star.hexes[second].0].map(|hex| self.material(hex));
                let group = || group_of(label_of(self.labels, 6 * id + Side::from(side)));
                FaceKind::between(materials, group)
            }
        }
    }

    /// Who keeps the faces between materials.
    pub(super) fn kept(&self) -> Kept<'_> {
        Kept::ByCoarse(&self.kept_by_coarse)
    }

    /// The place of a node of the mesh in `nodes`, if it is there.
    pub(super) fn place(&self, node: NodeId) -> Option<usize> {
        let place = self.place[node.index()];
        (place != NONE).then_some(place as usize)
    }

    /// The faces between refined and coarse hexes, in the order of their least nodes.
    pub(super) fn faces(&self, monitor: &dyn Monitor) -> Result<Vec<InterfaceFace>, Cancelled> {
        let at = |star: &mut Star, place: usize, found: &mut Vec<InterfaceFace>| {
            star.load(self, place);
            let least = |face: &&StarFace| face.rest.iter().all(|&n| n > star.node);
            let sides = star.faces.iter().filter(least).filter_map(|face| {
                let [fine, coarse] = star.sides(face)?;
                Some(InterfaceFace {
                    refined: star.hexes[fine.0].0,
                    refined_face: fine.1,
                    coarse: star.hexes[coarse.0].0,
                    coarse_face: coarse.1,
                })
            });
            found.extend(sides);
        };
        in_blocks(self.nodes.len(), monitor, Star::default, at)
    }
}

/// Which side keeps the faces between refined and coarse hexes of different materials.
#[derive(Clone, Copy)]
pub(super) enum Kept<'a> {
    /// All by one side: true for the refined one.
    All(bool),
    /// These by the coarse side, given as sides of refined hexes, ascending, and the others by the refined one.
    ByCoarse(&'a [Side]),
}

impl Kept<'_> {
    /// The hex, by its place in the star, that keeps a face, and which of its faces it is.
    pub(super) fn keeper(self, star: &Star, face: &StarFace) -> (usize, u8) {
        let Some([refined, coarse]) = star.sides(face) else { return face.first };
        let is_by_refined = match self {
            Self::All(refined) => refined,
            Self::ByCoarse(sides) => sides.binary_search(&star.side(refined)).is_err(),
        };
        if is_by_refined { refined } else { coarse }
    }
}

/// A face between a refined and a coarse hex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct InterfaceFace {
    /// The refined hex.
    pub(super) refined: u32,
    /// Which of its faces it is.
    pub(super) refined_face: u8,
    /// The coarse hex.
    pub(super) coarse: u32,
    /// Which of its faces it is.
    pub(super) coarse_face: u8,
}

impl InterfaceFace {
    /// The face as a side of the refined hex.
    pub(super) fn refined_side(&self) -> Side {
        6 * self.refined + Side::from(self.refined_face)
    }

    /// The face as a side of the coarse hex.
    pub(super) fn coarse_side(&self) -> Side {
        6 * self.coarse + Side::from(self.coarse_face)
    }
}

/// The hexes around a node and the faces between them. Its buffers serve one node after another.
#[derive(Default)]
pub(super) struct Star {
    pub(super) node: NodeId,
    /// Each hex, the node's corner there, and whether the hex is refined.
    pub(super) hexes: Vec<(u32, u8, bool)>,
    pub(super) faces: Vec<StarFace>,
}

/// A face at a star's node.
pub(super) struct StarFace {
    /// The other nodes, from the lesser neighbour of the star's node around the face to the greater.
    pub(super) rest: [NodeId; 3],
    /// The place in the star of the first hex that has it, and which of its faces it is.
    pub(super) first: (usize, u8),
    /// The same of the second; none on the boundary.
    pub(super) second: Option<(usize, u8)>,
}

impl StarFace {
    /// Does the face have the edge from the star's node to `end`?
    pub(super) fn has_edge(&self, end: NodeId) -> bool {
        self.rest[0] == end || self.rest[2] == end
    }
}

impl Star {
    /// Takes the star of node `place` of the interface.
    pub(super) fn load(&mut self, interface: &Interface, place: usize) {
        self.node = interface.nodes[place];
        self.hexes.clear();
        self.faces.clear();
        for (k, (in_shell, corner)) in interface.stars.at(place).enumerate() {
            let hex = interface.shell[in_shell];
            self.hexes.push((hex, corner as u8, interface.refined[hex as usize]));
            let nodes = &interface.hexes[hex as usize];
            for (face, following) in FACES_AT[corner] {
                let rest = one_way(following.map(|k| nodes[usize::from(k)]));
                let open = |f: &&mut StarFace| f.rest == rest && f.second.is_none();
                match self.faces.iter_mut().find(open) {
                    Some(known) => known.second = Some((k, face)),
                    None => self.faces.push(StarFace { rest, first: (k, face), second: None }),
                }
            }
        }
    }

    pub(super) fn is_refined(&self, hex: usize) -> bool {
        self.hexes[hex].2
    }

    /// Is the face between a refined and a coarse hex?
    pub(super) fn is_interface(&self, face: &StarFace) -> bool {
        face.second.is_some_and(|(second, _)| self.is_refined(face.first.0) != self.is_refined(second))
    }

    /// The refined and the coarse hex of a face of the interface, by their places, and which of their faces it is.
    pub(super) fn sides(&self, face: &StarFace) -> Option<[(usize, u8); 2]> {
        let (a, b) = (face.first, face.second?);
        match (self.is_refined(a.0), self.is_refined(b.0)) {
            (true, false) => Some([a, b]),
            (false, true) => Some([b, a]),
            _ => None,
        }
    }

    /// The side that a face of a hex of the star is.
    pub(super) fn side(&self, (hex, face): (usize, u8)) -> Side {
        6 * self.hexes[hex].0 + Side::from(face)
    }
}
