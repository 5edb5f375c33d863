//! From the polygons of a file to a closed, manifold, outward shell of triangles.
//!
//! 1. Polygons are checked and cut into triangles (`cut`).
//! 2. Points are welded, exactly and then within a tolerance; triangles that lose a corner or lie on another one go
//!    (`weld`, `doubles`).
//! 3. Small holes are filled (`holes`). Then every edge must have two triangles (`refuse`).
//! 4. The triangles of each component are made to agree, and then to look outward by the sign of its volume (`orient`).
//! 5. Where fans of triangles share a point alone, each gets its own (`fans`).
//! 6. Components within others are voids, and are turned inward (`nesting`).
//! 7. Flat triangles are flipped away (`flat`).
//! 8. Edges that the file marks as features are noted (`tagged`).
//!
//! What moves, moves by no more than the tolerance.

mod cut;
mod doubles;
mod fans;
mod flat;
mod holes;
mod nesting;
mod orient;
mod refuse;
mod tagged;
mod weld;

use super::error::SolidError;
use super::options::{SolidOptions, SolidReport};
use super::shell::{EdgeTable, Shell, Triangles};
use crate::geometry::Aabb;
use crate::mesh::{FaceId, PolygonMesh, first_of_same};
use crate::{Cancelled, Monitor, parallel};

/// Points closer than this share of the diagonal of the surface's box are one.
const TOLERANCE: f64 = 1e-6;

/// A shell and what else the file says of it.
pub(super) struct Imported {
    pub shell: Shell,
    /// For each half-edge whether the file marks it as a feature.
    pub tagged: Vec<bool>,
    /// The body of each triangle.
    pub body_of: Vec<u32>,
    /// The face of the file that each triangle is part of.
    pub face_of: Vec<FaceId>,
    /// Lengths below this are nothing.
    pub tolerance: f64,
}

/// Triangles that need not fit together yet.
struct Soup {
    mesh: Triangles,
    /// The face of the file that each triangle is part of.
    face_of: Vec<FaceId>,
    /// The vertex that each node of the file has become; `NONE` if no triangle uses it.
    vertex_of: Vec<u32>,
}

impl Soup {
    /// Keeps the triangles with the given numbers alone.
    fn keep(&mut self, kept: &[u32]) {
        self.mesh.triangles = kept.iter().map(|&t| self.mesh.triangles[t as usize]).collect();
        self.face_of = kept.iter().map(|&t| self.face_of[t as usize]).collect();
    }

    /// Keeps the triangles that `keeps` accepts. Returns how many went.
    fn retain(&mut self, keeps: impl Fn(usize) -> bool + Sync) -> usize {
        let kept = parallel::filter(self.face_of.len(), keeps);
        let gone = self.face_of.len() - kept.len();
        self.keep(&kept);
        gone
    }
}

/// Makes a shell of a surface; what was mended is added to `report`.
pub(super) fn import(
    surface: &PolygonMesh,
    options: &SolidOptions,
    report: &mut SolidReport,
    monitor: &dyn Monitor,
) -> Result<Imported, SolidError> {
    let first = first_of_same(&surface.positions);
    let mut soup = cut::triangles(surface, &first, monitor)?;
    let diagonal = Aabb::around(cut::points_of(surface)).diagonal();
    let tolerance = TOLERANCE * diagonal;
    weld::weld(&mut soup, &first, tolerance, report, monitor)?;
    if soup.face_of.is_empty() {
        let face = FaceId(0);
        return Err(SolidError::NoVolume { at: surface.positions[surface.face(0)[0].index()], face });
    }
    let mut table = EdgeTable::new(&soup.mesh, monitor)?;
    refuse::non_manifold(&soup, &table)?;
    report.filled_holes = holes::fill(&mut soup, &table, options.hole_size * diagonal);
    if !report.filled_holes.is_empty() {
        table = EdgeTable::new(&soup.mesh, monitor)?;
    }
    refuse::open(&soup, &table)?;
    let turned = orient::orient(&mut soup, &table, tolerance)?;
    monitor.proceed()?;
    let mut shell = shell_of(&mut soup, monitor)?;
    monitor.proceed()?;
    let copies = fans::split(&mut shell);
    monitor.proceed()?;
    let nesting = nesting::nesting(&shell, monitor)?;
    report.voids = nesting.voids;
    // The walls of voids were turned to look out of these, and are turned back.
    report.turned_triangles =
        turned.iter().zip(&nesting.in_void).filter(|(turned, back)| turned != back).count();
    if nesting.voids > 0 {
        nesting::turn_voids(&mut shell.mesh, &nesting);
        soup.mesh = shell.mesh;
        shell = shell_of(&mut soup, monitor)?;
    }
    monitor.proceed()?;
    let mut face_of = std::mem::take(&mut soup.face_of);
    report.flipped_triangles = flat::flip(&mut shell, &mut face_of, tolerance);
    let nodes = tagged::Nodes { vertex_of: &soup.vertex_of, copies: &copies };
    let tagged = tagged::tagged_edges(&shell, surface, &face_of, &nodes, options, report);
    report.split_points = fans::distinct(copies);
    Ok(Imported { shell, tagged, body_of: nesting.body_of, face_of, tolerance })
}

fn shell_of(soup: &mut Soup, monitor: &dyn Monitor) -> Result<Shell, Cancelled> {
    let table = EdgeTable::new(&soup.mesh, monitor)?;
    Ok(Shell::new(std::mem::take(&mut soup.mesh), &table))
}
