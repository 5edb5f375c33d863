//! What a plan's stages will make, told before the work: counts of section 3, from the trees alone.
//!
//! Each stage's interface is the one between refined and coarse elements of a level of the trees, whose elements
//! around it are all there. From it follow the transition cells:
//!
//! | method | cells |
//! |---|---|
//! | I | 8, 6, 4, 15, 22 in place of a coarse element with 4, 2, 1, 6, 7 nodes of the interface |
//! | II | 7 a face |
//! | 3-refinement | 13 a face |
//!
//! Whether an interface can be separated, from ridges and from faces between materials too, is seen on the trees as it will
//! be on the mesh. So the figures are exact, unless a stage is made again with more refined for hexes that cannot be
//! untangled.

use serde::Serialize;

use super::heritage::Heritage;
use super::interface::Interface;
use super::options::Method;
use super::part::Part;
use super::pillow::can_be_separated;
use super::stage::StageError;
use super::trees::TreeLevel;
use crate::Monitor;
use crate::geometry::Point;

/// What a stage will make.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct StageForecast {
    /// Elements that will be divided.
    pub refined: usize,
    /// Faces between them and coarse elements.
    pub interface_faces: usize,
    /// Transition hexes.
    pub transition: usize,
    /// Hexes of the mesh after the stage.
    pub hexes: usize,
}

/// What a refinement will make.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct HexForecast {
    /// Hexes of the mesh.
    pub hexes: usize,
    /// How many transition hexes the stages make. Those that are not touched again are hexes of the mesh.
    pub transition: usize,
    /// Peak memory of the work in bytes, about.
    pub bytes: u64,
    /// Coarse to fine.
    pub stages: Vec<StageForecast>,
}

impl HexForecast {
    /// Peak memory of refinement in bytes for each hex of the result: `cargo bench --bench memory -- hexes` counts 224 to
    /// 320 for shells of 0.1 M hexes, in planning or in the last stage; this is the greatest, rounded up. Pages that an
    /// allocator keeps come on top.
    pub const BYTES_PER_HEX: u64 = 330;

    pub(super) fn new(input_hexes: usize, stages: Vec<StageForecast>) -> Self {
        let hexes = stages.last().map_or(input_hexes, |stage| stage.hexes);
        let transition = stages.iter().map(|stage| stage.transition).sum();
        Self { hexes, transition, bytes: hexes as u64 * Self::BYTES_PER_HEX, stages }
    }
}

/// Looks at the interface within a level of trees with so many `children`, over nodes at `positions`. The stage will be made
/// so, from a mesh of no hexes: those of the mesh come on top.
///
/// # Errors
/// The elements that must be refined too where the interface cannot be separated, or if the monitor stops it.
pub(super) fn foresee(
    (level, heritage): (TreeLevel, &Heritage),
    (positions, children): (&[Point], usize),
    method: Method,
    monitor: &dyn Monitor,
) -> Result<StageForecast, StageError> {
    let refined = level.refined.len();
    if refined == level.elements.len() {
        return Ok(StageForecast { refined, hexes: (children - 1) * refined, ..Default::default() });
    }
    let whole = heritage.with(positions, level.elements);
    let part = Part::around(whole, level.refined, monitor)?;
    let flags = part.as_ref().map(|part| part.flags(level.is_refined));
    let looked_at = part.as_ref().map_or(whole, |part| part.mesh.whole());
    let is_refined = flags.as_deref().unwrap_or(level.is_refined);
    let mut interface = Interface::new(looked_at, is_refined, monitor)?;
    let faces = interface.faces(monitor)?.len();
    let (transition, replaced) = match method {
        Method::One => layer_cells(&interface),
        Method::Two | Method::Auto | Method::Three => {
            can_be_separated(looked_at.positions, &mut interface, monitor)
                .map_err(|error| as_whole(error, part.as_ref()))?;
            (if method == Method::Three { 13 } else { 7 } * faces, 0)
        }
    };
    let hexes = (children - 1) * refined + transition - replaced;
    Ok(StageForecast { refined, interface_faces: faces, transition, hexes })
}

/// Gives the hexes of an error their numbers in the whole.
fn as_whole(mut error: StageError, part: Option<&Part>) -> StageError {
    if let (StageError::Conflict(hexes), Some(part)) = (&mut error, part) {
        part.number_as_whole(hexes);
    }
    error
}

/// The cells of Method I's layer, and the coarse elements in whose place they are.
fn layer_cells(interface: &Interface) -> (usize, usize) {
    let coarse = interface.shell.iter().filter(|&&e| !interface.refined[e as usize]);
    let nodes = |e: &u32| {
        let nodes = &interface.hexes[*e as usize];
        nodes.iter().filter(|n| interface.place(**n).is_some()).count()
    };
    let cells = |nodes: usize| match nodes {
        1 => 4,
        2 => 6,
        4 => 8,
        6 => 15,
        7 => 22,
        _ => 1,
    };
    coarse.map(nodes).fold((0, 0), |(sum, count), nodes| (sum + cells(nodes), count + 1))
}
