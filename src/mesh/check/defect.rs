//! What can be wrong with a mesh.

use serde::Serialize;

use crate::mesh::{FaceId, HexId, NodeId};

/// One thing wrong with a mesh, with the ids at fault. Ids count from 0.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum Defect {
    /// The table of faces does not add up: see the invariants of `PolygonMesh`.
    BrokenOffsets {
        /// The first face whose corners are not where they should be.
        face: FaceId,
    },
    /// A face with fewer than three nodes.
    TooFewNodes {
        /// The face.
        face: FaceId,
        /// How many nodes it has.
        count: u32,
    },
    /// A face names a node that does not exist.
    NodeOutOfRange {
        /// The face.
        face: FaceId,
        /// What it names.
        node: NodeId,
        /// How many nodes there are.
        nodes: u32,
    },
    /// A coordinate is infinite or not a number.
    NotFinite {
        /// The node.
        node: NodeId,
    },
    /// A face meets a node twice.
    RepeatedNode {
        /// The face.
        face: FaceId,
        /// The node.
        node: NodeId,
    },
    /// Two faces have the same set of nodes.
    SameNodes {
        /// The faces, the earlier first.
        faces: [FaceId; 2],
    },
    /// A node lies inside an edge that does not end there, so that the faces beside the edge and those
    /// around the node do not fit together.
    HangingNode {
        /// The node.
        node: NodeId,
        /// The ends of the edge.
        edge: [NodeId; 2],
    },
    /// A node that no face uses.
    UnusedNode {
        /// The node.
        node: NodeId,
    },
    /// Three or more faces meet at an edge.
    NonManifoldEdge {
        /// The ends of the edge.
        edge: [NodeId; 2],
        /// The faces.
        faces: Vec<FaceId>,
    },
    /// The faces around a node form several fans that share the node alone.
    NonManifoldNode {
        /// The node.
        node: NodeId,
        /// How many fans there are.
        fans: u32,
    },
    /// Two faces walk their common edge in the same direction, so that their normals disagree.
    Disagreement {
        /// The ends of the edge, in the direction in which both walk it.
        edge: [NodeId; 2],
        /// The faces.
        faces: [FaceId; 2],
    },
    /// A face without area.
    ZeroArea {
        /// The face.
        face: FaceId,
    },
    /// A hex names a node that does not exist.
    HexNodeOutOfRange {
        /// The hex.
        hex: HexId,
        /// What it names.
        node: NodeId,
        /// How many nodes there are.
        nodes: u32,
    },
    /// A hex has a node twice.
    HexRepeatedNode {
        /// The hex.
        hex: HexId,
        /// The node.
        node: NodeId,
    },
    /// A hex is inside out at some of its corners.
    InvertedHex {
        /// The hex.
        hex: HexId,
        /// At how many.
        corners: u32,
    },
    /// Two hexes have the same set of nodes.
    SameHexes {
        /// The hexes, the earlier first.
        hexes: [HexId; 2],
    },
    /// Three or more hexes have the same face.
    NonManifoldFace {
        /// The face.
        face: [NodeId; 4],
        /// The hexes.
        hexes: Vec<HexId>,
    },
    /// Two hexes lie on the same side of their common face.
    FaceDisagreement {
        /// The face, as both walk it.
        face: [NodeId; 4],
        /// The hexes.
        hexes: [HexId; 2],
    },
    /// Two hexes go around the same four nodes in different orders.
    CrossedFace {
        /// The face as the first hex walks it.
        face: [NodeId; 4],
        /// And as the second does.
        other: [NodeId; 4],
        /// The hexes.
        hexes: [HexId; 2],
    },
    /// Two faces have three nodes in common.
    ThreeSharedNodes {
        /// The faces.
        faces: [[NodeId; 4]; 2],
        /// A hex of each.
        hexes: [HexId; 2],
    },
    /// A node lies inside a boundary face of which it is no corner, so that the hex there and those around the node
    /// do not fit together.
    HangingNodeInFace {
        /// The node.
        node: NodeId,
        /// The face.
        face: [NodeId; 4],
        /// The face's hex.
        hex: HexId,
    },
    /// One boundary face, or more than two, at an edge of a hex mesh.
    NonManifoldRim {
        /// The ends of the edge.
        edge: [NodeId; 2],
        /// The hexes of the boundary faces.
        hexes: Vec<HexId>,
    },
    /// A group has a face of a hex that does not exist.
    NoSuchFace {
        /// The hex.
        hex: HexId,
        /// The face's number there.
        face: u8,
    },
    /// A face between two hexes is in groups from both of them.
    FaceGroupedTwice {
        /// The hex from which it comes for the second time.
        hex: HexId,
        /// The face's number there.
        face: u8,
    },
    /// The hexes around a node fill neither a ball nor, on the boundary, half of one: its link is no sphere or disc.
    OddLink {
        /// The node.
        node: NodeId,
        /// The Euler characteristic of its link: 2 for a sphere, 1 for a disc.
        euler: i32,
        /// Is the node on the boundary?
        boundary: bool,
    },
}

/// How bad a [`Defect`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Severity {
    /// The mesh is conforming; the finding is reported because few expect it. Open, non-manifold and
    /// inconsistently oriented surfaces are a matter of what is modelled.
    Note,
    /// The mesh is not a conforming mesh: two faces meet in something other than nothing, a common
    /// node or a common edge, or a face is no polygon at all; two hexes meet in something else than nothing or a
    /// common node, edge or face, or a hex is inside out.
    Error,
}

impl Defect {
    /// A stable name of the kind of defect, the same as `kind` in JSON.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::BrokenOffsets { .. } => "brokenOffsets",
            Self::TooFewNodes { .. } => "tooFewNodes",
            Self::NodeOutOfRange { .. } => "nodeOutOfRange",
            Self::NotFinite { .. } => "notFinite",
            Self::RepeatedNode { .. } => "repeatedNode",
            Self::SameNodes { .. } => "sameNodes",
            Self::HangingNode { .. } => "hangingNode",
            Self::UnusedNode { .. } => "unusedNode",
            Self::NonManifoldEdge { .. } => "nonManifoldEdge",
            Self::NonManifoldNode { .. } => "nonManifoldNode",
            Self::Disagreement { .. } => "disagreement",
            Self::ZeroArea { .. } => "zeroArea",
            Self::HexNodeOutOfRange { .. } => "hexNodeOutOfRange",
            Self::HexRepeatedNode { .. } => "hexRepeatedNode",
            Self::InvertedHex { .. } => "invertedHex",
            Self::SameHexes { .. } => "sameHexes",
            Self::NonManifoldFace { .. } => "nonManifoldFace",
            Self::FaceDisagreement { .. } => "faceDisagreement",
            Self::CrossedFace { .. } => "crossedFace",
            Self::ThreeSharedNodes { .. } => "threeSharedNodes",
            Self::HangingNodeInFace { .. } => "hangingNodeInFace",
            Self::NonManifoldRim { .. } => "nonManifoldRim",
            Self::NoSuchFace { .. } => "noSuchFace",
            Self::FaceGroupedTwice { .. } => "faceGroupedTwice",
            Self::OddLink { .. } => "oddLink",
        }
    }

    /// How bad it is.
    pub fn severity(&self) -> Severity {
        match self {
            Self::BrokenOffsets { .. }
            | Self::TooFewNodes { .. }
            | Self::NodeOutOfRange { .. }
            | Self::NotFinite { .. }
            | Self::RepeatedNode { .. }
            | Self::SameNodes { .. }
            | Self::HangingNode { .. }
            | Self::HexNodeOutOfRange { .. }
            | Self::HexRepeatedNode { .. }
            | Self::InvertedHex { .. }
            | Self::SameHexes { .. }
            | Self::NonManifoldFace { .. }
            | Self::FaceDisagreement { .. }
            | Self::CrossedFace { .. }
            | Self::ThreeSharedNodes { .. }
            | Self::NoSuchFace { .. }
            | Self::FaceGroupedTwice { .. }
            | Self::HangingNodeInFace { .. } => Severity::Error,
            Self::UnusedNode { .. }
            | Self::NonManifoldEdge { .. }
            | Self::NonManifoldNode { .. }
            | Self::Disagreement { .. }
            | Self::ZeroArea { .. }
            | Self::NonManifoldRim { .. }
            | Self::OddLink { .. } => Severity::Note,
        }
    }

    /// True if the mesh is not conforming because of it.
    pub fn is_error(&self) -> bool {
        self.severity() == Severity::Error
    }
}

/// The defect in words, with its ids as they are: counted from 0, which the words say.
impl std::fmt::Display for Defect {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.tell(f)?;
        f.write_str(" (counted from 0)")
    }
}

impl Defect {
    fn tell(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::BrokenOffsets { face } => {
                write!(f, "the corners of face {face} are not where its offsets say")
            }
            Self::TooFewNodes { face, count } => {
                write!(f, "face {face} has {count} nodes; a face needs at least 3")
            }
            Self::NodeOutOfRange { face, node, nodes } => {
                write!(f, "face {face} names node {node}, but there are only {nodes} nodes")
            }
            Self::NotFinite { node } => write!(f, "node {node} has a coordinate that is not a finite number"),
            Self::RepeatedNode { face, node } => write!(f, "face {face} meets node {node} twice"),
            Self::SameNodes { faces: [a, b] } => write!(f, "faces {a} and {b} have the same nodes"),
            Self::HangingNode { node, edge: [a, b] } => {
                write!(f, "node {node} hangs inside the edge {a}\u{2013}{b}")
            }
            Self::UnusedNode { node } => write!(f, "node {node} is used by no face"),
            Self::NonManifoldEdge { edge: [a, b], faces } => {
                write!(f, "{} faces meet at the edge {a}\u{2013}{b}: {}", faces.len(), listed(faces))
            }
            Self::NonManifoldNode { node, fans } => {
                write!(f, "{fans} fans of faces share node {node} and nothing else there")
            }
            Self::Disagreement { edge: [a, b], faces: [g, h] } => {
                write!(f, "faces {g} and {h} both walk the edge from {a} to {b}, so their normals disagree")
            }
            Self::ZeroArea { face } => write!(f, "face {face} has no area"),
            Self::HexNodeOutOfRange { hex, node, nodes } => {
                write!(f, "hex {hex} names node {node}, but there are only {nodes} nodes")
            }
            Self::HexRepeatedNode { hex, node } => write!(f, "hex {hex} has node {node} twice"),
            Self::InvertedHex { hex, corners } => write!(f, "hex {hex} is inside out at {corners} corners"),
            Self::SameHexes { hexes: [a, b] } => write!(f, "hexes {a} and {b} have the same nodes"),
            Self::NonManifoldFace { face, hexes } => {
                write!(f, "{} hexes have the face {}: {}", hexes.len(), around(face), listed(hexes))
            }
            Self::FaceDisagreement { face, hexes: [a, b] } => {
                write!(f, "hexes {a} and {b} lie on the same side of their face {}", around(face))
            }
            Self::CrossedFace { face, other, hexes: [a, b] } => {
                write!(f, "hex {a} has the face {}, and hex {b} {}", around(face), around(other))
            }
            Self::ThreeSharedNodes { faces: [g, h], hexes: [a, b] } => {
                let (g, h) = (around(g), around(h));
                write!(f, "the faces {g} of hex {a} and {h} of hex {b} have three nodes in common")
            }
            Self::HangingNodeInFace { node, face, hex } => {
                write!(f, "node {node} hangs inside the face {} of hex {hex}", around(face))
            }
            Self::NonManifoldRim { edge: [a, b], hexes } => {
                let (count, hexes) = (hexes.len(), listed(hexes));
                let (meet, of) =
                    if count == 1 { ("boundary face is", "hex") } else { ("boundary faces meet", "hexes") };
                write!(f, "{count} {meet} at the edge {a}\u{2013}{b}, of {of} {hexes}")
            }
            Self::NoSuchFace { hex, face } => {
                write!(f, "a group has face {face} of hex {hex}, and there is no such hex")
            }
            Self::FaceGroupedTwice { hex, face } => {
                write!(f, "face {face} of hex {hex} is in groups from the hex on its other side, too")
            }
            Self::OddLink { node, euler, boundary } => {
                let (whole, wanted) = if *boundary { ("half a ball", 1) } else { ("a ball", 2) };
                write!(
                    f,
                    "the hexes around node {node} do not fill {whole}: its link has Euler number {euler}, not {wanted}"
                )
            }
        }
    }
}

/// The first few ids in words.
pub(crate) fn listed(ids: &[impl std::fmt::Display]) -> String {
    const SHOWN: usize = 8;
    let mut words: Vec<String> = ids.iter().take(SHOWN).map(ToString::to_string).collect();
    if ids.len() > SHOWN {
        words.push("\u{2026}".into());
    }
    words.join(", ")
}

/// A face by its nodes.
fn around([a, b, c, d]: &[NodeId; 4]) -> String {
    format!("{a}\u{2013}{b}\u{2013}{c}\u{2013}{d}")
}

/// How many defects of one kind there are.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct DefectCount {
    /// The kind, as [`Defect::kind`].
    pub kind: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// How many.
    pub count: usize,
    /// The first of them.
    pub first: Defect,
}

impl std::fmt::Display for DefectCount {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.first.tell(f)?;
        match self.count {
            1 => f.write_str(" (counted from 0)"),
            n => write!(f, " (counted from 0; and {} more like it)", n - 1),
        }
    }
}

/// Sums defects up: one entry a kind, errors first, then in order of first appearance.
pub fn summary(defects: &[Defect]) -> Vec<DefectCount> {
    let mut counts: Vec<DefectCount> = Vec::new();
    for defect in defects {
        match counts.iter_mut().find(|c| c.kind == defect.kind()) {
            Some(c) => c.count += 1,
            None => counts.push(DefectCount {
                kind: defect.kind(),
                severity: defect.severity(),
                count: 1,
                first: defect.clone(),
            }),
        }
    }
    counts.sort_by_key(|c| std::cmp::Reverse(c.severity));
    counts
}
