//! The command line's options, with their help.

mod examples;
mod values;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use hexmill::hexing::face::RegionOptions;
use hexmill::hexing::{Background, HexingOptions};
use hexmill::mesh::SecondOrderHex;
use hexmill::refine::QuadOptions;
use hexmill::refine::hex::{HexOptions, Method};

use super::region::RegionArg;
use values::{angle, feature_angle, gradation, levels, positive};

/// Conforming quad and hex meshes of surfaces and solids, refined where they are wanted finer.
///
/// The format of a file is told by its extension: obj, stl (input only), vtu, vtk, msh, inp, mesh (MEDIT), glb (output only).
///
/// Exit codes: 0 done; 1 a file or mesh was refused; 2 the command line makes no sense; 130 interrupted.
#[derive(Debug, Parser)]
#[command(name = "hexmill", version, max_term_width = 100)]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,

    /// Print nothing but errors
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Refine a surface to a conforming quad mesh, or a hex mesh to a conforming hex mesh
    #[command(after_long_help = examples::REFINE)]
    Refine(RefineArgs),
    /// Mesh the solid that a closed surface bounds with hexes
    #[command(after_long_help = examples::HEX)]
    Hex(HexArgs),
    /// Say what is wrong with a mesh, and how good it is
    #[command(after_long_help = examples::CHECK)]
    Check(CheckArgs),
    /// Write a mesh in another format
    #[command(after_long_help = examples::CONVERT)]
    Convert(ConvertArgs),
    /// Make a box of hexes around a mesh
    #[command(after_long_help = examples::GRID)]
    Grid(GridArgs),
    /// Mesh a planar face with quads alone, along its outline, holes and inner curves
    #[command(after_long_help = examples::QUAD)]
    Quad(QuadArgs),
}

/// What every command that makes a mesh takes.
#[derive(Args, Clone, Debug)]
pub(crate) struct Making {
    /// Where to write the mesh
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) working: Working,
}

/// How such a command works, and what it records.
#[derive(Args, Clone, Debug)]
pub(crate) struct Working {
    /// Threads to use [default: one a core]; the result does not depend on it
    #[arg(long, short = 'j', value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), allow_negative_numbers = true)]
    pub(crate) threads: Option<u16>,

    /// Where to write a record of the work as JSON (see docs/report.md)
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
}

/// `hexmill refine`.
#[derive(Args, Debug)]
pub(crate) struct RefineArgs {
    /// The surface, triangles, quads and polygons in any mixture; or the hex mesh
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// No edge longer than this, in model units
    #[arg(long, short = 'e', value_name = "L", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) edge_length: Option<f64>,

    /// Where to refine further, as KIND:NUMBERS:h=SIZE or KIND:NUMBERS:level=N; may be given many times
    #[arg(long = "region", short = 'r', value_name = "REGION", value_parser = super::region::parse)]
    pub(crate) regions: Vec<RegionArg>,

    /// Refine everything at least this many times
    #[arg(long, short, value_name = "N", value_parser = levels, allow_negative_numbers = true)]
    pub(crate) levels: Option<u8>,

    /// How refined hexes and coarse ones are joined; hexes only [default: auto]
    #[arg(long, value_enum, value_name = "METHOD")]
    pub(crate) method: Option<MethodArg>,

    /// Refuse to refine more than is asked for, where the method needs that; hexes only. Siblings of refined hexes and
    /// levels that differ by one are no growth; that methods one and two refine all hexes once is, without --levels
    #[arg(long)]
    pub(crate) no_growth: bool,

    /// Turn of the surface's normal that one edge may span, in degrees; surfaces only
    #[arg(long, value_name = "DEG", value_parser = angle, allow_negative_numbers = true)]
    pub(crate) curvature: Option<f64>,

    /// How much larger an element may be than its neighbour around a region with a size (1 < G <= 2)
    #[arg(long, value_name = "G", value_parser = gradation, allow_negative_numbers = true)]
    pub(crate) gradation: Option<f64>,

    /// Leave untouched quads as they are (all-quad surfaces whose nodes can be two-coloured)
    #[arg(long)]
    pub(crate) keep_coarse: bool,

    /// Refine no element more often than this [default: 12; of hexes 8]
    #[arg(long, value_name = "N", value_parser = levels, allow_negative_numbers = true)]
    pub(crate) max_levels: Option<u8>,

    /// Refuse to make more quads than this [default: 64000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=QuadOptions::MOST_QUADS), allow_negative_numbers = true)]
    pub(crate) max_quads: Option<u64>,

    /// Refuse to make more hexes than this [default: 16000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=HexOptions::MOST_HEXES), allow_negative_numbers = true)]
    pub(crate) max_hexes: Option<u64>,

    /// Where to write the mesh
    #[arg(long, short, value_name = "OUT", required_unless_present = "plan")]
    pub(crate) output: Option<PathBuf>,

    /// Tell how much would be made, and what is refined beside what is asked for, and make nothing
    #[arg(long, conflicts_with = "output")]
    pub(crate) plan: bool,

    #[command(flatten)]
    pub(crate) working: Working,
}

/// `hexmill hex`.
#[derive(Args, Debug)]
pub(crate) struct HexArgs {
    /// The closed surface of the solid, or of several
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// How long edges are to be, in model units
    #[arg(long, short = 'e', value_name = "L", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) edge_length: f64,

    /// Where edges are to be shorter, as KIND:NUMBERS:h=SIZE or KIND:NUMBERS:level=N; may be given many times;
    /// with --background octree levels count from twice the edge length
    #[arg(long = "region", short = 'r', value_name = "REGION", value_parser = super::region::parse)]
    pub(crate) regions: Vec<RegionArg>,

    /// What the mesh is cut out of
    #[arg(long, value_enum, value_name = "KIND", default_value_t = BackgroundArg::Auto)]
    pub(crate) background: BackgroundArg,

    /// Turn of the surface's normal that one edge may span, in degrees
    #[arg(long, value_name = "DEG", value_parser = angle, allow_negative_numbers = true)]
    pub(crate) curvature: Option<f64>,

    /// Faces that meet at more than this are parts of different surfaces, in degrees
    #[arg(long, value_name = "DEG", value_parser = feature_angle, allow_negative_numbers = true, default_value_t = 35.0)]
    pub(crate) feature_angle: f64,

    /// How far mesh and solid may be from each other: else hexes are made smaller, there or everywhere, by --max-levels at most
    #[arg(long, value_name = "D", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) max_distance: Option<f64>,

    /// Make hexes at most this many levels finer to show what was missed, and for --curvature [default: 2]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=i64::from(HexingOptions::MOST_LEVELS)), allow_negative_numbers = true)]
    pub(crate) max_levels: Option<u8>,

    /// Refuse to make a background of more hexes than this [default: 4000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=HexingOptions::MOST_HEXES), allow_negative_numbers = true)]
    pub(crate) max_hexes: Option<u64>,

    /// Make hexes of the second order, curved along the solid (VTU, VTK, MSH and INP)
    #[arg(long, value_enum, value_name = "HEX")]
    pub(crate) second_order: Option<SecondOrderArg>,

    #[command(flatten)]
    pub(crate) making: Making,
}

/// What a mesh of a solid is cut out of.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(crate) enum BackgroundArg {
    /// What is likely to capture the solid best, another one if that does not show it
    Auto,
    /// A quad mesh of the principal face, swept along the principal direction
    Swept,
    /// A grid along the solid's main axes, its planes moved to planar surfaces
    Grid,
    /// A layer of hexes between the two sides of a thin shell, however curved
    Shell,
    /// A grid of edges twice as long, refined at the boundary, and more where smaller hexes are wanted
    Octree,
}

impl From<BackgroundArg> for Background {
    fn from(background: BackgroundArg) -> Self {
        match background {
            BackgroundArg::Auto => Self::Auto,
            BackgroundArg::Swept => Self::Swept,
            BackgroundArg::Grid => Self::Grid,
            BackgroundArg::Shell => Self::Shell,
            BackgroundArg::Octree => Self::Octree,
        }
    }
}

/// A hex of the second order.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(crate) enum SecondOrderArg {
    /// With a node on each edge
    Hex20,
    /// With nodes on edges, on faces and inside
    Hex27,
}

impl From<SecondOrderArg> for SecondOrderHex {
    fn from(hex: SecondOrderArg) -> Self {
        match hex {
            SecondOrderArg::Hex20 => Self::Hex20,
            SecondOrderArg::Hex27 => Self::Hex27,
        }
    }
}

/// How refined hexes and coarse ones are joined.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(crate) enum MethodArg {
    /// Layer templates: the refined set grows to what they allow, the worst hexes are best
    One,
    /// A pillow and one template: the refined set hardly grows
    Two,
    /// A pillow, hexes in 27
    Three,
    /// Method two; of the input what is asked for is refined, where that cannot be joined whole blocks of 2 x 2 x 2 hexes, and
    /// all of a body only where there are none
    Auto,
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Self {
        match method {
            MethodArg::One => Self::One,
            MethodArg::Two => Self::Two,
            MethodArg::Three => Self::Three,
            MethodArg::Auto => Self::Auto,
        }
    }
}

/// `hexmill check`.
#[derive(Args, Debug)]
pub(crate) struct CheckArgs {
    /// The mesh
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,

    /// A surface to measure the distance from and to
    #[arg(long, value_name = "SURFACE")]
    pub(crate) surface: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) working: Working,
}

/// `hexmill convert`.
#[derive(Args, Debug)]
pub(crate) struct ConvertArgs {
    /// The mesh
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// Where to write it
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,
}

/// `hexmill grid`.
#[derive(Args, Debug)]
pub(crate) struct GridArgs {
    /// The mesh to make a grid around
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// Where to write the grid
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,

    /// The edge length of the hexes, in model units
    #[arg(long, value_name = "H", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) spacing: f64,

    /// How far the grid reaches beyond the mesh, at least
    #[arg(long, value_name = "M", allow_negative_numbers = true, default_value_t = 0.0)]
    pub(crate) margin: f64,

    /// Shorten the edges so that the grid ends where the margin does
    #[arg(long)]
    pub(crate) fit: bool,

    /// Refuse to make more hexes than this [default: 16000000]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) max_hexes: Option<u64>,
}

/// `hexmill quad`.
#[derive(Args, Debug)]
pub(crate) struct QuadArgs {
    /// The planar face: polygons, and polylines for inner curves
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// About how long the edges are to be, in model units
    #[arg(long, short = 'e', value_name = "L", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) edge_length: f64,

    /// Refuse to make more quads than this [default: 16000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=RegionOptions::MOST_QUADS), allow_negative_numbers = true)]
    pub(crate) max_quads: Option<u64>,

    #[command(flatten)]
    pub(crate) making: Making,
}
