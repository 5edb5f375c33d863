//! MEDIT's `.mesh`, ASCII (P. Frey, "MEDIT: an interactive mesh visualization software", INRIA RT-0253, 2001;
//! the keywords as libMeshb has them), which Mmg, FreeFEM, Gmsh and meshio exchange.
//!
//! Written: version 2 (double precision; version 4 where a reference has more than 32 bits), three dimensions; triangles, quadrilaterals or hexahedra with the
//! number of their tag set as reference (0 for none; names only as comments for people); polylines and
//! creases of a surface as `Edges` and `Ridges`, its sharp corners as `Corners`. Triangles come before
//! quadrilaterals, so a surface that mixes them comes back in another order. Polygons of more than
//! four nodes are refused.
//!
//! Read: versions 1 to 4, dimensions 2 and 3, references as tags, `Edges`, `Ridges` and `Corners`; of hexahedra of the
//! second order and their faces the corners; required entities, normals, tangents and sections of other programs are stepped over.

mod read;
mod write;

pub use read::read;
pub use write::write;

/// The sharpness of ridges and corners: OpenSubdiv's for what never gets smooth.
const SHARP: f64 = 10.0;
