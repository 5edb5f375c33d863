//! All-hex meshes of solids, from the surface to the mesh (section 3).
//!
//! 1. The solid, its corners, curves and surfaces ([`solid`](crate::solid)); then for each of its bodies (`body`):
//! 2. A background mesh (`ground`, section 4).
//! 3. Its core (`core`, 5.1), where the solid's features are on the core's boundary (`correspondence`, 5.2), sheets and
//!    the fit (`sheets`, `fit`, section 6): one `attempt`.
//! 4. Where that missed something, another attempt; the best is kept.
//! 5. Hexes of the second order, if asked for (`second_order`).
//!
//! **Promises.** The mesh conforms, its boundary is a 2-manifold, every hex has a positive Jacobian, at its corners and
//! inside. What of the solid it does not show is reported with its place.

use std::borrow::Borrow;

use super::asked::mesh_body;
use super::background::{BackgroundError, check_size};
use super::body::{Best, Body};
use super::crossings::crossing_surfaces;
use super::ground::coarsest;
use super::groups::{body_tags, sides_of, surface_groups};
use super::options::{HexingError, HexingOptions, validate};
use super::report::{BodyReport, HexingReport, LostFeature, ResultReport};
use super::second_order::SecondOrderBodies;
use crate::mesh::{HexMesh, NodeId, PolygonMesh, SecondOrder};
use crate::refine::hex::HexRefineError;
use crate::sizing::{Region, SizeField, SizeOptions, SizedElement};
use crate::solid::{CurveId, SolidModel, SolidReport, SurfaceId};
use crate::{Cancelled, Monitor, Stage};

/// A mesh of a solid.
#[derive(Clone, Debug)]
pub struct HexedSolid {
    /// The mesh. The surfaces of the solid are groups of its boundary faces: `surface-1` and so on, and where the file has
    /// groups that all of a surface is in, those too. Where there are several bodies they are groups of hexes, `body-1` and
    /// so on, and share no node.
    pub mesh: HexMesh,
    /// All boundary quads, outward, each with the surface that it stands for.
    pub faces: Vec<([NodeId; 4], SurfaceId)>,
    /// What makes the hexes hexes of the second order, if that was asked for.
    pub second_order: Option<SecondOrder>,
    /// What was done, and what came of it.
    pub report: HexingReport,
}

impl HexedSolid {
    /// All boundary faces by their hex and their number there (6 times the hex and the number), ascending, each with the
    /// surface that it stands for: what [`surface_groups`](super::surface_groups) makes groups of.
    pub fn sides(&self) -> Vec<(u32, SurfaceId)> {
        sides_of(&self.mesh, &self.faces)
    }

    /// The regions that overlap none of the hexes, by their places among these.
    ///
    /// # Errors
    /// If a region is out of range, or the monitor stops it.
    pub fn idle_regions(&self, regions: &[Region], monitor: &dyn Monitor) -> Result<Vec<u32>, HexingError> {
        let sizes = SizeOptions { edge_length: None, curvature: None, gradation: 2.0, regions };
        let field = SizeField::of_hexes(&self.mesh, sizes)
            .map_err(|error| BackgroundError::from(HexRefineError::from(error)))?;
        let idle = field.idle_regions(self.mesh.hexes.len(), monitor, |hex| {
            let corners = self.mesh.hexes[hex].map(|n| self.mesh.positions[n.index()]);
            // Overlaps do not depend on lengths.
            [SizedElement { corners, longest: 0.0, level: 0, root: None }]
        });
        Ok(idle?)
    }
}

/// The stage in which the surface becomes a solid.
const SOLID: Stage = Stage("solid");

/// Fills the solid that a closed surface bounds with hexes. A surface that is handed over is freed as soon as the solid is
/// known.
///
/// # Errors
/// See [`HexingError`]; nothing is returned in part.
///
/// ```
/// use hexmill::hexing::{HexingOptions, hex_solid};
/// use hexmill::{Silent, mesh::check_hexes};
/// let cube = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
///     f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
/// let surface = hexmill::io::obj::read(cube)?.into_surface().unwrap();
/// let options = HexingOptions { edge_length: 0.25, ..HexingOptions::default() };
/// let hexed = hex_solid(&surface, &options, &Silent)?;
/// assert_eq!(hexed.mesh.hexes.len(), 64);
/// assert!(check_hexes(&hexed.mesh).is_empty() && hexed.report.result().worst > 0.999);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn hex_solid(
    surface: impl Borrow<PolygonMesh>,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<HexedSolid, HexingError> {
    validate(options)?;
    let (solid, found) = SolidModel::new(surface.borrow(), &options.solid(), monitor)?;
    drop(surface);
    hexed(&solid, found, options, monitor)
}

/// As [`hex_solid`], with the solid and what was found of it.
fn hexed(
    solid: &SolidModel,
    found: SolidReport,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<HexedSolid, HexingError> {
    check_size(solid, coarsest(options), options.max_hexes)?;
    let mut whole = Whole::new(options);
    if solid.body_count() == 1 {
        let all = |count: usize| 0..count as u32;
        let (curves, surfaces) = (all(solid.curves().len()), all(solid.surfaces().len()));
        let ids = (curves.map(CurveId).collect(), surfaces.map(SurfaceId).collect());
        whole.add(0, solid, ids, mesh_body(solid, options, monitor)?, monitor)?;
    } else {
        for body in 0..solid.body_count() as u32 {
            monitor.checkpoint(SOLID, 1.0)?;
            let alone = solid.body(body, monitor)?;
            whole.add(body, &alone, ids_of(solid, body), mesh_body(&alone, options, monitor)?, monitor)?;
        }
    }
    let Whole { mut mesh, faces, body_of, bodies, mut result, second_order } = whole;
    if mesh.hexes.is_empty() {
        return Err(HexingError::NothingLeft { edge_length: options.edge_length });
    }
    result.crossings = crossing_surfaces(&mesh, &faces, monitor)?;
    mesh.groups =
        surface_groups(&sides_of(&mesh, &faces), &found.surface_groups).expect("sides are ascending");
    if bodies.len() > 1 {
        mesh.tags = body_tags(&body_of);
    }
    let (second_order, of_second_order) =
        second_order.map(|bodies| bodies.joined(mesh.positions.len())).unzip();
    let report = HexingReport { solid: found, bodies, result, second_order: of_second_order };
    Ok(HexedSolid { mesh, faces, second_order, report })
}

/// The curves and surfaces of a body as it has them alone, which is in the same order.
fn ids_of(solid: &SolidModel, body: u32) -> (Vec<CurveId>, Vec<SurfaceId>) {
    let surfaces: Vec<SurfaceId> = (0..solid.surfaces().len()).map(SurfaceId::new).collect();
    let is_part = |s: SurfaceId| solid.surfaces()[s.index()].body == body;
    let curves = (0..solid.curves().len()).map(CurveId::new);
    let curves = curves.filter(|c| is_part(solid.curves()[c.index()].sides[0])).collect();
    (curves, surfaces.into_iter().filter(|&s| is_part(s)).collect())
}

/// The meshes of the bodies so far.
struct Whole {
    mesh: HexMesh,
    faces: Vec<([NodeId; 4], SurfaceId)>,
    /// The body of each hex.
    body_of: Vec<u32>,
    bodies: Vec<BodyReport>,
    result: ResultReport,
    /// Of the second order, if that is asked for.
    second_order: Option<SecondOrderBodies>,
}

impl Whole {
    fn new(options: &HexingOptions) -> Self {
        Self {
            mesh: HexMesh::default(),
            faces: Vec::new(),
            body_of: Vec::new(),
            bodies: Vec::new(),
            result: ResultReport::none(options.max_distance),
            second_order: options.second_order.map(SecondOrderBodies::new),
        }
    }

    /// Adds a body whose curves and surfaces have other ids in the solid.
    fn add(
        &mut self,
        body: u32,
        solid: &SolidModel,
        ids: (Vec<CurveId>, Vec<SurfaceId>),
        made: Body,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let Body { best, mut report } = made;
        let (curves, surfaces) = ids;
        let features = report.attempts.iter_mut().filter_map(|attempt| attempt.features.as_mut());
        features.for_each(|features| features.renumber(&curves, &surfaces));
        match best {
            Some(Best { meshed, number, .. }) => {
                let kept = &report.attempts[number];
                let (features, mesh) =
                    kept.features.as_ref().zip(kept.mesh.as_ref()).expect("a mesh is kept");
                self.result.add(&kept.core, features, mesh);
                if let Some(second_order) = &mut self.second_order {
                    second_order.add(&meshed, solid, self.mesh.positions.len(), monitor)?;
                }
                self.append(body, meshed.mesh, meshed.on.faces, &surfaces);
            }
            None => {
                let place = solid.bounds().center().to_array();
                self.result.solid_euler += solid.euler_number();
                self.result.lost_bodies.push(LostFeature { id: body, place, size: solid.diagonal() });
            }
        }
        self.bodies.push(report);
        Ok(())
    }

    fn append(
        &mut self,
        body: u32,
        mesh: HexMesh,
        faces: Vec<([NodeId; 4], SurfaceId)>,
        surfaces: &[SurfaceId],
    ) {
        let first = self.mesh.positions.len() as u32;
        let node = |n: NodeId| NodeId(first + n.0);
        self.mesh.positions.extend(mesh.positions);
        self.body_of.resize(self.body_of.len() + mesh.hexes.len(), body);
        self.mesh.hexes.extend(mesh.hexes.into_iter().map(|hex| hex.map(node)));
        self.faces.extend(faces.into_iter().map(|(quad, s)| (quad.map(node), surfaces[s.index()])));
    }
}
