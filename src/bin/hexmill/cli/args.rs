//! The command line's options, with their help.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use hexmill::hexing::HexingOptions;
use hexmill::hexing::face::RegionOptions;
use hexmill::refine::QuadOptions;
use hexmill::refine::hex::{HexOptions, Method};

use super::region::RegionArg;

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
    #[command(after_long_help = REFINE_EXAMPLES)]
    Refine(RefineArgs),
    /// Mesh the solid that a closed surface bounds with hexes
    #[command(after_long_help = HEX_EXAMPLES)]
    Hex(HexArgs),
    /// Say what is wrong with a mesh, and how good it is
    #[command(after_long_help = CHECK_EXAMPLES)]
    Check(CheckArgs),
    /// Write a mesh in another format
    #[command(after_long_help = CONVERT_EXAMPLES)]
    Convert(ConvertArgs),
    /// Make a box of hexes around a mesh
    #[command(after_long_help = GRID_EXAMPLES)]
    Grid(GridArgs),
    /// Mesh a planar face with quads alone, along its outline, holes and inner curves
    #[command(after_long_help = QUAD_EXAMPLES)]
    Quad(QuadArgs),
}

const REFINE_EXAMPLES: &str = "\
Examples:
  No edge longer than 2 model units, for ParaView:
    hexmill refine part.obj -o part.vtu --edge-length 2

  Twice finer everywhere, whatever the size (each level halves the edges):
    hexmill refine part.obj -o fine.obj --levels 1

  Edges of 5, but of 0.5 in a ball of radius 10 around the origin:
    hexmill refine part.obj -o part.vtu --edge-length 5 --region sphere:0,0,0,10:h=0.5

  Three levels in a box, four along a bore, everything else as coarse as it gets:
    hexmill refine part.obj -o part.msh \\
      --region box:0,0,0,10,10,5:level=3 --region cylinder:5,5,-1,5,5,6,2:level=4

  A box turned by 30 degrees about z (about x, then y, then z, through its centre):
    hexmill refine part.obj -o part.vtu --region box:0,0,0,10,2,2,0,0,30:h=0.2

  Near the nodes of one mesh and within 1.5 of the surface of another:
    hexmill refine part.obj -o part.vtu --region points:probes.obj,0.5:level=4 \\
      --region surface:shock.obj,1.5:h=0.25

  Hexes around a hull (see hexmill grid), three levels deep at its surface:
    hexmill refine sea.vtu -o fine.vtu --method two --region surface:hull.obj,0:level=3

  Follow curvature, ten degrees an edge, and keep a record:
    hexmill refine part.obj -o part.vtu --curvature 10 --report part.json

Regions are KIND:NUMBERS:h=SIZE (no edge longer than SIZE in it) or KIND:NUMBERS:level=N (N levels
deep; the input is level 0):
  box:x0,y0,z0,x1,y1,z1              from corner to corner
  box:x0,y0,z0,x1,y1,z1,ax,ay,az     turned about x, y and z (fixed axes, degrees, in this order)
  box:x0,y0,z0,x1,y1,z1,qx,qy,qz,qw  turned by a quaternion
  sphere:cx,cy,cz,r
  cylinder:ax,ay,az,bx,by,bz,r       capped, from a to b
  points:FILE,r                      within r of a node of FILE
  surface:FILE,d                     within d of a face of FILE";

const HEX_EXAMPLES: &str = "\
Examples:
  Edges of about 2 model units, for ParaView:
    hexmill hex part.obj -o part.vtu --edge-length 2

  Surfaces meet where faces turn by more than 20 degrees; a record of what came of each feature:
    hexmill hex part.obj -o part.msh -e 2 --feature-angle 20 --report part.json";

const CHECK_EXAMPLES: &str = "\
Exit code 1 if the mesh is not conforming (repeated or hanging nodes, faces twice, ...). Open borders,
non-manifold edges and the like are noted, but are no reason to refuse.

Examples:
  hexmill check part.vtu
  hexmill check part.vtu --surface part.obj      how far the mesh and the surface are from each other
  hexmill check part.vtu --report part.json      everything, as JSON";

const CONVERT_EXAMPLES: &str = "\
Examples:
  hexmill convert part.obj -o part.vtu
  hexmill convert part.mesh -o part.inp";

const GRID_EXAMPLES: &str = "\
The grid runs along the axes, with the mesh in its middle.

Examples:
  hexmill grid hull.obj --spacing 0.5 -o sea.vtu                 cubes of edge 0.5
  hexmill grid hull.obj --spacing 0.5 --margin 4 -o sea.vtu      reaching 4 beyond the hull at least
  hexmill grid hull.obj --spacing 0.5 --margin 4 --fit -o sea.vtu    and no farther: edges up to 0.5";

const QUAD_EXAMPLES: &str = "\
The polygons of IN lie in one plane, any plane. Their common outline and their holes are kept, and so are the polylines
(OBJ l lines) in it: edges of the quads follow them. Corners of more than 40 degrees are nodes, and so are nodes with a
sharpness (OBJ t corner).

Examples:
  hexmill quad plate.obj -o quads.vtu --edge-length 0.5";

/// `hexmill refine`.
#[derive(Args, Debug)]
pub(crate) struct RefineArgs {
    /// The surface, triangles, quads and polygons in any mixture; or the hex mesh
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// Where to write the mesh
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,

    /// No edge longer than this, in model units
    #[arg(long, short = 'e', value_name = "L", value_parser = positive)]
    pub(crate) edge_length: Option<f64>,

    /// Where to refine further, as KIND:NUMBERS:h=SIZE or KIND:NUMBERS:level=N; may be given many times
    #[arg(long = "region", short = 'r', value_name = "REGION", value_parser = super::region::parse)]
    pub(crate) regions: Vec<RegionArg>,

    /// Refine everything at least this many times
    #[arg(long, short, value_name = "N", value_parser = levels())]
    pub(crate) levels: Option<u8>,

    /// How refined hexes and coarse ones are joined; hexes only [default: auto]
    #[arg(long, value_enum, value_name = "METHOD")]
    pub(crate) method: Option<MethodArg>,

    /// Turn of the surface's normal that one edge may span, in degrees; surfaces only
    #[arg(long, value_name = "DEG", value_parser = angle)]
    pub(crate) curvature: Option<f64>,

    /// How much larger an element may be than its neighbour around a region with a size (1 < G <= 2)
    #[arg(long, value_name = "G", value_parser = gradation)]
    pub(crate) gradation: Option<f64>,

    /// Leave untouched quads as they are (all-quad surfaces whose nodes can be two-coloured)
    #[arg(long)]
    pub(crate) keep_coarse: bool,

    /// Refine no element more often than this [default: 12; of hexes 8]
    #[arg(long, value_name = "N", value_parser = levels())]
    pub(crate) max_levels: Option<u8>,

    /// Refuse to make more quads than this [default: 64000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=QuadOptions::MOST_QUADS))]
    pub(crate) max_quads: Option<u64>,

    /// Refuse to make more hexes than this [default: 16000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=HexOptions::MOST_HEXES))]
    pub(crate) max_hexes: Option<u64>,

    /// Threads to use [default: one a core]; the result does not depend on it
    #[arg(long, short = 'j', value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// Where to write a record of the work as JSON (see docs/report.md)
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
}

/// `hexmill hex`.
#[derive(Args, Debug)]
pub(crate) struct HexArgs {
    /// The closed surface of the solid, or of several
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// Where to write the mesh
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,

    /// How long edges are to be, in model units
    #[arg(long, short = 'e', value_name = "L", value_parser = positive)]
    pub(crate) edge_length: f64,

    /// Faces that meet at more than this are parts of different surfaces, in degrees
    #[arg(long, value_name = "DEG", value_parser = angle, default_value_t = 35.0)]
    pub(crate) feature_angle: f64,

    /// Refuse to make a background of more hexes than this [default: 4000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=HexingOptions::MOST_HEXES))]
    pub(crate) max_hexes: Option<u64>,

    /// Threads to use [default: one a core]; the result does not depend on it
    #[arg(long, short = 'j', value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

    /// Where to write a record of the work as JSON (see docs/report.md)
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
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
    /// Method two, or three where the set cannot be grouped two by two
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

    /// Where to write everything found as JSON (see docs/report.md)
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
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

/// Levels that can be asked for.
fn levels() -> clap::builder::RangedI64ValueParser<u8> {
    clap::value_parser!(u8).range(0..=i64::from(QuadOptions::DEEPEST_LEVEL))
}

/// Degrees of a turn.
fn angle(text: &str) -> Result<f64, String> {
    positive(text).ok().filter(|&angle| angle <= 180.0).ok_or("give a number above 0, at most 180".to_owned())
}

/// A growth from element to element.
fn gradation(text: &str) -> Result<f64, String> {
    positive(text).ok().filter(|&g| g > 1.0 && g <= 2.0).ok_or("give a number above 1, at most 2".to_owned())
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
    #[arg(long, value_name = "H", value_parser = positive)]
    pub(crate) spacing: f64,

    /// How far the grid reaches beyond the mesh, at least
    #[arg(long, value_name = "M", default_value_t = 0.0)]
    pub(crate) margin: f64,

    /// Shorten the edges so that the grid ends where the margin does
    #[arg(long)]
    pub(crate) fit: bool,

    /// Refuse to make more hexes than this [default: 16000000]
    #[arg(long, value_name = "N")]
    pub(crate) max_hexes: Option<u64>,
}

/// `hexmill quad`.
#[derive(Args, Debug)]
pub(crate) struct QuadArgs {
    /// The planar face: polygons, and polylines for inner curves
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,

    /// Where to write the mesh
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: PathBuf,

    /// About how long the edges are to be, in model units
    #[arg(long, short = 'e', value_name = "L", value_parser = positive)]
    pub(crate) edge_length: f64,

    /// Refuse to make more quads than this [default: 16000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=RegionOptions::MOST_QUADS))]
    pub(crate) max_quads: Option<u64>,

    /// Where to write a record of the work as JSON (see docs/report.md)
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
}

/// A finite number above zero.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("give a number above 0".to_owned()),
    }
}
