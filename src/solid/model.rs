//! The solid and what can be asked of it.

use super::curves::{CurveGraph, curve_graph};
use super::entities::{Corner, Curve, CurveId, Surface, SurfaceClass, SurfaceId};
use super::error::SolidError;
use super::features::{close_gaps, drop_noise, sharp_edges};
use super::import::{Imported, import};
use super::options::{SolidOptions, SolidReport};
use super::search::{CurveFoot, CurveSearch, Foot, Sides, TriangleSearch};
use super::shell::Shell;
use super::surfaces::{flood, groups_of_file, surfaces};
use crate::geometry::{Aabb, Point, area_vector};
use crate::mesh::{FaceId, PolygonMesh, crossings};
use crate::{Cancelled, Monitor, Stage, parallel};

/// More than this share of the boundary of a free form is neither planar nor cylindrical.
const FREE_FORM: f64 = 0.9;

/// Nobody drew a curve of a free form whose sides meet at an angle nearer to a straight one than this, in degrees.
const CREASED: f64 = 90.0;

/// A solid by its boundary: a closed surface of triangles that look outward, in surfaces that meet at curves, which meet
/// at corners. There may be several disjoint bodies, and voids within them.
#[derive(Debug)]
pub struct SolidModel {
    parts: Parts,
    normals: Vec<Point>,
    sides: Sides,
    surface_of: Vec<SurfaceId>,
    corners: Vec<Corner>,
    curves: Vec<Curve>,
    surfaces: Vec<Surface>,
    is_free_form: bool,
    bounds: Aabb,
    search: TriangleSearch,
    by_curve: Vec<CurveSearch>,
}

/// What a model is made of.
#[derive(Debug)]
struct Parts {
    shell: Shell,
    /// For each half-edge whether it is part of a curve.
    is_feature: Vec<bool>,
    /// For each half-edge whether that is so because the file says it: tags meet there, or a line or crease runs there.
    tagged: Vec<bool>,
    /// The body of each triangle.
    body_of: Vec<u32>,
    /// Degrees: where a curve turns by more it has a corner.
    corner_angle: f64,
}

impl SolidModel {
    /// Reading the surface, mending it and finding its features.
    pub const STAGE: Stage = Stage("solid");

    /// The solid inside a closed surface of polygons.
    ///
    /// # Errors
    /// If the surface bounds no solid, with the place, or the monitor stops it.
    pub fn new(
        surface: &PolygonMesh,
        options: &SolidOptions,
        monitor: &dyn Monitor,
    ) -> Result<(Self, SolidReport), SolidError> {
        options.check()?;
        let mut report = SolidReport::default();
        monitor.checkpoint(Self::STAGE, 0.0)?;
        let Imported { shell, tagged, body_of, face_of, tolerance } =
            import(surface, options, &mut report, monitor)?;
        monitor.checkpoint(Self::STAGE, 0.3)?;
        refuse_crossings(&shell, &face_of, tolerance, monitor)?;
        monitor.checkpoint(Self::STAGE, 0.6)?;
        let normals = normals(&shell);
        let mut is_feature = sharp_edges(&shell, &normals, options.feature_angle);
        is_feature.iter_mut().zip(&tagged).for_each(|(is_feature, tagged)| *is_feature |= tagged);
        if let Some(length) = options.edge_length {
            report.noise_edges = drop_noise(&shell, &mut is_feature, &tagged, length);
        }
        close_gaps(&shell, &normals, &mut is_feature, &tagged, options.feature_angle);
        monitor.checkpoint(Self::STAGE, 0.7)?;
        let parts = Parts { shell, is_feature, tagged, body_of, corner_angle: options.corner_angle };
        let solid = Self::of_parts(parts, monitor)?;
        monitor.checkpoint(Self::STAGE, 1.0)?;
        solid.count(&mut report);
        report.surface_groups = groups_of_file(&solid.surfaces, &surface.tags, &face_of);
        Ok((solid, report))
    }

    fn of_parts(parts: Parts, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let shell = &parts.shell;
        let normals = normals(shell);
        monitor.proceed()?;
        let surface_of = flood(shell, &parts.is_feature);
        monitor.proceed()?;
        let CurveGraph { corners, curves } =
            curve_graph(shell, &normals, &parts.is_feature, &surface_of, parts.corner_angle);
        monitor.proceed()?;
        let surfaces = surfaces(shell, &surface_of, &parts.body_of, &curves);
        let points_of =
            |c: &Curve| c.vertices.iter().map(|&v| shell.mesh.points[v as usize]).collect::<Vec<_>>();
        Ok(Self {
            search: TriangleSearch::new(shell, surfaces.iter().map(|s| &*s.triangles), monitor)?,
            by_curve: parallel::try_collect(curves.len(), monitor, |c| {
                CurveSearch::new(points_of(&curves[c]))
            })?,
            sides: Sides::new(shell, &normals, monitor)?,
            bounds: Aabb::around(&shell.mesh.points),
            is_free_form: is_free_form(&surfaces, &parts.tagged),
            parts,
            normals,
            surface_of,
            corners,
            curves,
            surfaces,
        })
    }

    /// One of the disjoint bodies as a solid of its own, with its voids and features: its corners, curves and surfaces are
    /// in the same order as here.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn body(&self, body: u32, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let Parts { shell, is_feature, tagged, body_of, corner_angle } = &self.parts;
        let kept: Vec<usize> = (0..body_of.len()).filter(|&t| body_of[t] == body).collect();
        let part = shell.part(&kept);
        let of_part = |flags: &[bool]| kept.iter().flat_map(|&t| flags[3 * t..3 * t + 3].to_vec()).collect();
        let parts = Parts {
            is_feature: of_part(is_feature),
            tagged: of_part(tagged),
            body_of: vec![0; kept.len()],
            shell: part,
            corner_angle: *corner_angle,
        };
        Self::of_parts(parts, monitor)
    }

    /// Number of disjoint bodies.
    pub fn body_count(&self) -> usize {
        self.parts.body_of.iter().max().map_or(0, |&b| b as usize + 1)
    }

    fn count(&self, report: &mut SolidReport) {
        report.points = self.points().len();
        report.triangles = self.triangles().len();
        report.bodies = self.body_count();
        report.corners = self.corners.len();
        report.curves = self.curves.len();
        report.surfaces = self.surfaces.len();
        report.euler = self.euler_number();
    }

    /// Coordinates of the vertices.
    pub fn points(&self) -> &[Point] {
        &self.parts.shell.mesh.points
    }

    /// The vertices of each triangle, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.parts.shell.mesh.triangles
    }

    /// The outward unit normal of each triangle; zero if it has no area.
    pub fn normals(&self) -> &[Point] {
        &self.normals
    }

    /// The outward unit normal at vertex `v`: of the triangles around, by their angles there.
    pub fn normal_at(&self, v: u32) -> Point {
        self.sides.normal_at(v)
    }

    /// The corners of a triangle.
    pub fn corners_of(&self, triangle: usize) -> [Point; 3] {
        self.parts.shell.mesh.at(triangle)
    }

    /// The triangle on the other side of an edge: `side` runs from the triangle's corner `side` to the next.
    pub fn across(&self, triangle: usize, side: usize) -> u32 {
        self.parts.shell.twins[3 * triangle + side] / 3
    }

    /// The surface of a triangle.
    pub fn surface_of(&self, triangle: usize) -> SurfaceId {
        self.surface_of[triangle]
    }

    /// The corners; `CornerId` counts them.
    pub fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// The curves; `CurveId` counts them.
    pub fn curves(&self) -> &[Curve] {
        &self.curves
    }

    /// The surfaces; `SurfaceId` counts them.
    pub fn surfaces(&self) -> &[Surface] {
        &self.surfaces
    }

    /// The box around the solid.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The length of that box's diagonal.
    pub fn diagonal(&self) -> f64 {
        self.bounds.diagonal()
    }

    /// The Euler characteristic of the boundary: vertices - edges + triangles; 2 - 2 genus for each closed surface.
    pub fn euler_number(&self) -> i64 {
        self.points().len() as i64 - self.parts.shell.len() as i64 / 2 + self.triangles().len() as i64
    }

    /// The volume inside.
    pub fn volume(&self) -> f64 {
        let origin = self.bounds.center();
        let six = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.points()[v as usize] - origin);
            a.dot(b.cross(c))
        };
        self.triangles().iter().map(six).sum::<f64>() / 6.0
    }

    /// The area of the boundary.
    pub fn area(&self) -> f64 {
        self.surfaces.iter().map(|s| s.area).sum()
    }

    /// Is nearly all of its boundary neither planar nor cylindrical, without a curve that the file tells? Then most of
    /// its curves are creases of a scan, or of an organic shape.
    pub fn is_free_form(&self) -> bool {
        self.is_free_form
    }

    /// Did somebody draw the curve? Of a free form that is believed of those alone whose sides meet at an angle that is
    /// farther from a straight one than 90 degrees.
    pub fn is_drawn(&self, curve: CurveId) -> bool {
        !self.is_free_form || self.curves[curve.index()].sharpness() >= CREASED
    }

    /// The point of the boundary nearest to `p`.
    pub fn nearest(&self, p: Point) -> Foot {
        let found = self.search.nearest(p);
        self.foot(p, found.facet, found.point)
    }

    /// How far `p` is from the boundary: 0 where that is no more than rounding makes.
    pub fn distance(&self, p: Point) -> f64 {
        self.search.distance(p)
    }

    /// The point of a surface nearest to `p`.
    pub fn nearest_on_surface(&self, s: SurfaceId, p: Point) -> Foot {
        let found = self.search.nearest_of(s.index(), p);
        self.foot(p, found.facet, found.point)
    }

    fn foot(&self, p: Point, triangle: usize, point: Point) -> Foot {
        let normal = self.normals[triangle];
        Foot { point, normal, distance: point.distance(p), triangle: triangle as u32 }
    }

    /// The point of a curve nearest to `p`.
    pub fn nearest_on_curve(&self, c: CurveId, p: Point) -> CurveFoot {
        self.by_curve[c.index()].nearest(p)
    }

    /// The point of a curve that is so far along it from its start; beyond its ends these.
    pub fn point_on_curve(&self, c: CurveId, at: f64) -> Point {
        self.by_curve[c.index()].point_at(at)
    }

    /// How far `p` is from the boundary; negative inside.
    pub fn signed_distance(&self, p: Point) -> f64 {
        self.signed_nearest(p).0
    }

    /// The same, and the point of the boundary nearest to `p`.
    pub fn signed_nearest(&self, p: Point) -> (f64, Foot) {
        let foot = self.nearest(p);
        let Parts { shell, .. } = &self.parts;
        (self.sides.signed(shell, &self.normals, foot.triangle as usize, foot.point, p), foot)
    }

    /// Is `p` inside?
    pub fn contains(&self, p: Point) -> bool {
        self.signed_distance(p) < 0.0
    }
}

fn normals(shell: &Shell) -> Vec<Point> {
    parallel::collect(shell.mesh.triangles.len(), |t| area_vector(&shell.mesh.at(t)).normalize_or_zero())
}

/// Is nearly all of the boundary general, and no half-edge tagged?
fn is_free_form(surfaces: &[Surface], tagged: &[bool]) -> bool {
    let area_of = |is: &dyn Fn(&&Surface) -> bool| surfaces.iter().filter(is).map(|s| s.area).sum::<f64>();
    let general = area_of(&|s| s.class == SurfaceClass::General);
    general > FREE_FORM * area_of(&|_| true) && !tagged.contains(&true)
}

fn refuse_crossings(
    shell: &Shell,
    face_of: &[FaceId],
    tolerance: f64,
    monitor: &dyn Monitor,
) -> Result<(), SolidError> {
    let all = crossings(&shell.mesh.points, &shell.mesh.triangles, tolerance, monitor)?;
    let Some(first) = all.first() else { return Ok(()) };
    let faces = first.triangles.map(|t| face_of[t as usize]);
    Err(SolidError::SelfIntersection { pairs: all.len(), at: first.at, faces })
}
