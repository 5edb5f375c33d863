//! A grid along the solid's axes, with lines in its planar surfaces, where the solid is.
//!
//! 1. Lines: through planar surfaces, even between them (`lines`).
//! 2. Cells that the surface touches, and those beside whose halves it touches (`touched`, `rows`).
//! 3. Gaps between them along x that are inside.
//! 4. A few cells more where cells would touch at an edge or a node only.
//!
//! So each cell whose centre is inside has all its neighbours: on the way from that to one outside the surface is met in the
//! half on this side, or beyond. Few cells are outside, and none is further from the solid than about two edges.

use glam::DMat3;

use super::lines::{self, Plane, lines};
use super::rows::Rows;
use super::swept::SweepError;
use super::touched::touched;
use crate::geometry::{Aabb, Point};
use crate::hexing::face::FaceError;
use crate::mesh::HexMesh;
use crate::mesh::numbering::hex::CORNERS;
use crate::refine::hex::{HexBlocks, HexRefineError};
use crate::solid::{SolidModel, Surface, SurfaceClass};
use crate::{Cancelled, Monitor, Stage, parallel};

/// What [`grid`] is to make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlignedGrid {
    /// How long the hexes' edges are, about, in model units.
    pub edge_length: f64,
    /// The directions of the grid's lines, as orthonormal right-handed columns.
    pub axes: DMat3,
    /// How the lines are moved along each axis, as a share of an edge from 0 to 1: so that another try may succeed
    /// where one failed. Between lines that planar surfaces hold there are more of them instead.
    pub shift: [f64; 3],
    /// Do lines stand in both sides of walls and slots that are thinner than cells are to be? Cells in them are as thin.
    pub holds_walls: bool,
    /// Refuse a grid of more hexes than this.
    pub max_hexes: u64,
}

impl AlignedGrid {
    /// A grid along x, y and z of at most 16 million hexes.
    pub fn new(edge_length: f64) -> Self {
        Self {
            edge_length,
            axes: DMat3::IDENTITY,
            shift: [0.0; 3],
            holds_walls: false,
            max_hexes: 16_000_000,
        }
    }
}

/// Why there is no background mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BackgroundError {
    /// The edge length is no positive number.
    #[error("the edge length is {0}; give a positive number")]
    EdgeLength(f64),
    /// There would be more hexes than allowed.
    #[error("about {hexes:.3e} hexes are more than the limit of {limit}; raise the edge length or the limit")]
    TooManyHexes {
        /// How many hexes, about.
        hexes: f64,
        /// The limit.
        limit: u64,
    },
    /// The edge length is too small for the digits of the coordinates.
    #[error(
        "an edge length of {edge_length:e} is too small for coordinates that reach {reach:e}; raise it, or move the solid"
    )]
    TooFewDigits {
        /// The edge length.
        edge_length: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
    /// The background cannot be refined.
    #[error(transparent)]
    Refine(HexRefineError),
    /// No direction suggests itself for a sweep.
    #[error("the solid has neither a plane nor an axis to sweep along; choose another background")]
    NoDirection,
    /// The solid is no shell.
    #[error(
        "the solid is no thin shell: it has not two sides that face each other nearly everywhere; choose another background"
    )]
    NoShell,
    /// There is no principal face to sweep.
    #[error("the solid cannot be swept: {0}; choose another background")]
    Face(FaceError),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl BackgroundError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::EdgeLength(_) => "edge-length-out-of-range",
            Self::TooManyHexes { .. } => "too-many-hexes",
            Self::TooFewDigits { .. } => "too-few-digits",
            Self::Refine(error) => error.code(),
            Self::NoDirection => "no-direction",
            Self::NoShell => "no-shell",
            Self::Face(error) => error.code(),
            Self::Cancelled(_) => "cancelled",
        }
    }
}

impl From<HexRefineError> for BackgroundError {
    fn from(error: HexRefineError) -> Self {
        match error {
            HexRefineError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Refine(error),
        }
    }
}

impl From<SweepError> for BackgroundError {
    fn from(error: SweepError) -> Self {
        match error {
            SweepError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            SweepError::TooManyHexes { hexes, limit } => Self::TooManyHexes { hexes, limit },
            SweepError::Face(error) => Self::Face(error),
        }
    }
}

const BACKGROUND: Stage = Stage("background");

/// Share of an edge: a planar surface no thicker than this along an axis is perpendicular to it.
const FLAT: f64 = 0.02;

/// Share of a cell: what comes so near to a face touches the cell beyond. A little more than half: rounding is not to decide
/// on planes halfway.
const REACH: f64 = 0.501;

/// How many of the least steps between coordinates an edge must keep, so that the hexes are alike to three digits.
const LEAST_STEPS: f64 = 1024.0;

/// Layers of cells that a grid has outside a solid, about; a mesh has as many, where sheets are inserted.
const LAYERS: f64 = 1.5;

/// About how many hexes an edge length gives, be it of a grid or of a mesh: those in the solid, and one and a half layers
/// at its surface.
pub fn estimate_hexes(solid: &SolidModel, edge_length: f64) -> f64 {
    let area: f64 = solid.surfaces().iter().map(|surface| surface.area).sum();
    solid.volume() / (edge_length * edge_length * edge_length) + LAYERS * area / (edge_length * edge_length)
}

/// Makes the grid. Nodes and hexes are numbered along the first axis, then the second, then the third. The mesh is a
/// manifold with boundary.
///
/// # Errors
/// See [`BackgroundError`]. The number of hexes is held against the limit before and after their places are found, and
/// before they are made.
pub fn grid(
    solid: &SolidModel,
    options: &AlignedGrid,
    monitor: &dyn Monitor,
) -> Result<HexMesh, BackgroundError> {
    grid_to_refine(solid, options, 0, monitor)
}

/// As [`grid`], but of whole blocks.
pub(super) fn grid_of_blocks(
    solid: &SolidModel,
    options: &AlignedGrid,
    monitor: &dyn Monitor,
) -> Result<(HexMesh, HexBlocks), BackgroundError> {
    laid(solid, options, (REACH, true), monitor)
}

/// As [`grid`], but to be refined at the boundary by so many levels: it is these cells that have all their neighbours.
pub(super) fn grid_to_refine(
    solid: &SolidModel,
    options: &AlignedGrid,
    boundary_level: u8,
    monitor: &dyn Monitor,
) -> Result<HexMesh, BackgroundError> {
    let reach = REACH / f64::from(1u32 << boundary_level.min(31));
    Ok(laid(solid, options, (reach, false), monitor)?.0)
}

/// As [`grid`], with all cells that come so near to the solid, as a share of a cell.
pub(super) fn grid_around(
    solid: &SolidModel,
    options: &AlignedGrid,
    reach: f64,
    monitor: &dyn Monitor,
) -> Result<HexMesh, BackgroundError> {
    Ok(laid(solid, options, (reach, false), monitor)?.0)
}

#[inline(never)] // Compiled once for all that call it.
fn laid(
    solid: &SolidModel,
    options: &AlignedGrid,
    (reach, in_blocks): (f64, bool),
    monitor: &dyn Monitor,
) -> Result<(HexMesh, HexBlocks), BackgroundError> {
    let &AlignedGrid { edge_length, axes, shift, holds_walls, max_hexes } = options;
    check_size(solid, edge_length, max_hexes)?;
    monitor.checkpoint(BACKGROUND, 0.0)?;
    let points = along(solid, axes, monitor)?;
    let corners = |t: usize| solid.triangles()[t].map(|p| points[p as usize]);
    let planes = planes(solid, axes, &points, edge_length);
    let lines: [Vec<f64>; 3] = std::array::from_fn(|axis| {
        let Planes { extent, planes } = &planes[axis];
        lines(*extent, planes, edge_length, shift[axis], holds_walls)
    });
    monitor.checkpoint(BACKGROUND, 0.1)?;
    let shell = touched(&lines, reach, solid.triangles().len(), corners, monitor)?;
    monitor.checkpoint(BACKGROUND, 0.5)?;
    let position = |at: [u32; 3]| Point::from([0, 1, 2].map(|i| lines[i][at[i] as usize]));
    let centre = |at: [u32; 3]| axes * position(at).midpoint(position(at.map(|c| c + 1)));
    let mut cells = shell.filled(|cell| solid.contains(centre(cell))).made_manifold();
    if in_blocks {
        let mut whole = cells.in_blocks();
        while whole != cells {
            cells = whole.made_manifold();
            whole = cells.in_blocks();
        }
    }
    if cells.len() > max_hexes {
        return Err(BackgroundError::TooManyHexes { hexes: cells.len() as f64, limit: max_hexes });
    }
    monitor.checkpoint(BACKGROUND, 0.8)?;
    let nodes = cells.nodes();
    let positions = nodes.map(|at| axes * position(at));
    let mesh = HexMesh { positions, hexes: cells.hexes(&nodes), ..HexMesh::default() };
    let blocks = if in_blocks { blocks_of(&cells) } else { HexBlocks::default() };
    monitor.checkpoint(BACKGROUND, 1.0)?;
    Ok((mesh, blocks))
}

/// Has the solid walls or slots that lines stand in both sides of only where that is wanted?
pub(in super::super) fn has_walls(
    solid: &SolidModel,
    axes: DMat3,
    edge_length: f64,
    monitor: &dyn Monitor,
) -> Result<bool, Cancelled> {
    let points = along(solid, axes, monitor)?;
    let planes = planes(solid, axes, &points, edge_length);
    Ok(planes.iter().any(|Planes { extent, planes }| lines::has_walls(*extent, planes, edge_length)))
}

/// The solid's points along the axes.
fn along(solid: &SolidModel, axes: DMat3, monitor: &dyn Monitor) -> Result<Vec<Point>, Cancelled> {
    let to_grid = axes.transpose();
    parallel::try_collect(solid.points().len(), monitor, |p| to_grid * solid.points()[p])
}

/// The planar surfaces perpendicular to an axis, and how far the solid reaches along it.
struct Planes {
    extent: [f64; 2],
    planes: Vec<Plane>,
}

/// Those of each axis, of a solid with these points along the axes.
fn planes(solid: &SolidModel, axes: DMat3, points: &[Point], edge_length: f64) -> [Planes; 3] {
    let bounds = Aabb::around(points);
    let corners = |t: usize| solid.triangles()[t].map(|p| points[p as usize]);
    std::array::from_fn(|axis| {
        let surfaces = solid.surfaces().iter();
        let planes =
            surfaces.filter_map(|s| perpendicular(s, axes.col(axis), axis, &corners, edge_length)).collect();
        Planes { extent: [bounds.min[axis], bounds.max[axis]], planes }
    })
}

/// The blocks of two by two by two cells, as even and odd places make them.
fn blocks_of(cells: &Rows) -> HexBlocks {
    let places = cells.map(|place| place);
    let mut blocks: Vec<[u32; 3]> = cells.map(|place| place.map(|c| c / 2));
    parallel::sort(&mut blocks);
    blocks.dedup();
    let number = |k: usize| blocks.partition_point(|block| *block < places[k].map(|c| c / 2)) as u32;
    let octant = |k: usize| {
        let corner = places[k].map(|c| (c % 2) as u8);
        CORNERS.iter().position(|&other| other == corner).expect("a corner of a cube") as u8
    };
    HexBlocks {
        block: parallel::collect(places.len(), number),
        octant: parallel::collect(places.len(), octant),
    }
}

/// Refuses what cannot be made, before any work: of several bodies too.
///
/// # Errors
/// See [`BackgroundError`].
pub fn check_size(solid: &SolidModel, edge_length: f64, max_hexes: u64) -> Result<(), BackgroundError> {
    if !(edge_length > 0.0 && edge_length.is_finite()) {
        return Err(BackgroundError::EdgeLength(edge_length));
    }
    let hexes = estimate_hexes(solid, edge_length);
    // Lines along an axis are counted too: a needle askew has far more of them than cells.
    let across = solid.diagonal() / edge_length;
    if hexes.is_nan() || hexes > 2.0 * max_hexes as f64 || across > max_hexes as f64 {
        return Err(BackgroundError::TooManyHexes { hexes: hexes.max(across), limit: max_hexes });
    }
    let bounds = solid.bounds();
    let reach = bounds.min.abs().max_element().max(bounds.max.abs().max_element());
    if edge_length < LEAST_STEPS * f64::EPSILON * reach {
        return Err(BackgroundError::TooFewDigits { edge_length, reach });
    }
    Ok(())
}

/// Where along an axis of the grid a planar surface stands that is perpendicular to it.
fn perpendicular(
    surface: &Surface,
    direction: Point,
    axis: usize,
    corners: &impl Fn(usize) -> [Point; 3],
    edge_length: f64,
) -> Option<Plane> {
    let SurfaceClass::Planar { normal } = surface.class else { return None };
    if normal.dot(direction).abs() < 0.9 {
        return None;
    }
    let points = surface.triangles.iter().flat_map(|&t| corners(t as usize)).collect::<Vec<Point>>();
    let bounds = Aabb::around(&points);
    let [least, most] = [bounds.min[axis], bounds.max[axis]];
    let across = [1, 2].map(|k| (axis + k) % 3).map(|k| [bounds.min[k], bounds.max[k]]);
    let is_above = normal.dot(direction) > 0.0;
    (most - least <= FLAT * edge_length).then_some(Plane {
        at: least.midpoint(most),
        area: surface.area,
        is_above,
        across,
    })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::mesh::check_hexes;
    use crate::solid::testing::{cuboid, cylinder, ell, solid};

    #[test]
    fn planar_surfaces_have_nodes_in_them_exactly() {
        let solid = solid(&ell());
        let mesh = grid(&solid, &AlignedGrid::new(0.3), &Silent).unwrap();
        assert_eq!(check_hexes(&mesh), []);
        for at in [0.0, 1.0, 2.0] {
            assert!(mesh.positions.iter().any(|p| p.x == at) && mesh.positions.iter().any(|p| p.y == at));
        }
        let bounds = mesh.bounds();
        assert!(solid.bounds().grown(0.29).min.cmpge(bounds.min).all() && bounds.max.x < 2.0 + 3.0 * 0.4);
    }

    #[test]
    fn a_turned_grid_is_the_grid_of_a_turned_solid() {
        let turn = glam::DQuat::from_xyzw(0.1, -0.2, 0.3, 0.9).normalize();
        let mut surface = ell();
        surface.positions.iter_mut().for_each(|p| *p = turn * *p);
        let straight = grid(&solid(&ell()), &AlignedGrid::new(0.3), &Silent).unwrap();
        let options = AlignedGrid { axes: DMat3::from_quat(turn), ..AlignedGrid::new(0.3) };
        let turned = grid(&solid(&surface), &options, &Silent).unwrap();
        assert_eq!(turned.hexes, straight.hexes);
        assert!(turned.positions.iter().zip(&straight.positions).all(|(a, &b)| a.distance(turn * b) < 1e-12));
    }

    #[test]
    fn cells_are_near_the_solid_or_in_it_and_those_in_it_have_all_neighbours() {
        let solid = solid(&cylinder(40));
        let edge_length = 0.11;
        let mesh = grid(&solid, &AlignedGrid::new(edge_length), &Silent).unwrap();
        let centre = |hex: &[crate::mesh::NodeId; 8]| {
            hex.iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 8.0
        };
        let far = mesh.hexes.iter().map(|hex| solid.signed_distance(centre(hex))).fold(0.0, f64::max);
        assert!(far < 2.2 * edge_length, "{far}");
        // What is missing around a cell would leave a boundary face at its corners.
        let faces = crate::mesh::topology::hex_boundary(&mesh.hexes);
        let rim: std::collections::BTreeSet<_> = faces.iter().flat_map(|(face, _)| *face).collect();
        let inner = mesh.hexes.iter().filter(|hex| solid.contains(centre(hex)));
        assert!(inner.flatten().all(|n| !rim.contains(n)));
        let estimate = estimate_hexes(&solid, edge_length);
        assert!(
            (0.7..1.4).contains(&(mesh.hexes.len() as f64 / estimate)),
            "{} for {estimate}",
            mesh.hexes.len()
        );
    }

    #[test]
    fn what_cannot_be_made_is_refused_before() {
        let solid = solid(&cuboid([2, 2, 2]));
        let refused = |options: AlignedGrid| grid(&solid, &options, &Silent).unwrap_err().code();
        for edge_length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(refused(AlignedGrid::new(edge_length)), "edge-length-out-of-range");
        }
        for edge_length in [1e-4, 1e-200] {
            assert_eq!(refused(AlignedGrid::new(edge_length)), "too-many-hexes");
        }
        assert_eq!(refused(AlignedGrid { max_hexes: 100, ..AlignedGrid::new(0.2) }), "too-many-hexes");
        // Larger than the solid: a few cells around it.
        assert!(grid(&solid, &AlignedGrid::new(50.0), &Silent).unwrap().hexes.len() <= 150);
    }
}
