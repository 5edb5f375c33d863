//! What refinement of hexes is to do, and what it returns.

use serde::{Deserialize, Serialize};

use super::stage::{StageMesh, StageReport};
use crate::mesh::HexMesh;

/// How refined hexes and coarse ones are joined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Method {
    /// Method I: layer templates. No hex is inverted, and the refined set grows to what they allow.
    One,
    /// Method II: a pillow, then one template. The refined set hardly grows; the layer is to be smoothed.
    Two,
    /// 3-refinement: a pillow, then hexes in 27 and a template that needs no groups. Any set.
    Three,
    /// Method II, or 3-refinement of sets whose interface cannot be grouped two by two.
    #[default]
    Auto,
}

/// What refinement of a hex mesh is to do.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct HexOptions {
    /// How refined hexes and coarse ones are joined.
    pub method: Method,
}

/// A conforming hex mesh and where its hexes came from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RefinedHexes {
    /// The mesh. Tags are the input's, by root.
    pub mesh: HexMesh,
    /// The refinement level of each hex; a transition hex has that of the coarse hex it is part of.
    pub level: Vec<u8>,
    /// The input hex that each hex is part of.
    pub root: Vec<u32>,
    /// How many elements were refined beyond those asked for, because the method needs them.
    pub added: usize,
    /// What each stage did, coarse to fine.
    pub stages: Vec<StageReport>,
}

impl RefinedHexes {
    /// The result after the last stage.
    pub fn new(input: &HexMesh, mesh: StageMesh, added: usize, stages: Vec<StageReport>) -> Self {
        let StageMesh { positions, hexes, level, root, .. } = mesh;
        let tags = input.tags.inherited(&root);
        Self { mesh: HexMesh { positions, hexes, tags }, level, root, added, stages }
    }
}
