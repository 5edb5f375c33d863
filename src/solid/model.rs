//! The solid and what can be asked of it.

use super::curves::{CurveGraph, curve_graph};
use super::entities::{Corner, Curve, CurveId, Surface, SurfaceId};
use super::error::SolidError;
use super::features::feature_edges;
use super::import::import;
use super::options::{SolidOptions, SolidReport};
use super::search::{CurveFoot, CurveSearch, Foot, TriangleSearch, pseudo_normal, vertex_normals};
use super::shell::Shell;
use super::surfaces::{components, flood, surfaces};
use crate::geometry::{Aabb, Point, area_vector};
use crate::mesh::PolygonMesh;
use crate::{Monitor, Stage, parallel};

/// A solid by its boundary: a closed surface of triangles that look outward, in surfaces that meet at curves, which meet
/// at corners.
#[derive(Debug)]
pub struct SolidModel {
    shell: Shell,
    normals: Vec<Point>,
    vertex_normals: Vec<Point>,
    surface_of: Vec<SurfaceId>,
    corners: Vec<Corner>,
    curves: Vec<Curve>,
    surfaces: Vec<Surface>,
    bounds: Aabb,
    all: TriangleSearch,
    by_surface: Vec<TriangleSearch>,
    by_curve: Vec<CurveSearch>,
}

impl SolidModel {
    /// Reading the surface and mending it.
    pub const IMPORT: Stage = Stage("solid");

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
        monitor.checkpoint(Self::IMPORT, 0.0)?;
        let shell = import(surface, &mut report, monitor)?;
        monitor.checkpoint(Self::IMPORT, 0.5)?;
        let normals = parallel::collect(shell.mesh.triangles.len(), |t| {
            area_vector(&shell.mesh.at(t)).normalize_or_zero()
        });
        let is_feature = feature_edges(&shell, &normals, options.feature_angle);
        let surface_of = flood(&shell, &is_feature);
        let CurveGraph { corners, curves } =
            curve_graph(&shell, &normals, &is_feature, &surface_of, options.corner_angle);
        let body_of = components(&shell);
        let surfaces = surfaces(&shell, &surface_of, &body_of, &curves);
        monitor.checkpoint(Self::IMPORT, 0.75)?;
        let points_of =
            |c: &Curve| c.vertices.iter().map(|&v| shell.mesh.points[v as usize]).collect::<Vec<_>>();
        let solid = Self {
            all: TriangleSearch::new(&shell, 0..shell.mesh.triangles.len()),
            by_surface: parallel::collect(surfaces.len(), |s| {
                TriangleSearch::new(&shell, surfaces[s].triangles.iter().map(|&t| t as usize))
            }),
            by_curve: parallel::collect(curves.len(), |c| CurveSearch::new(points_of(&curves[c]))),
            vertex_normals: vertex_normals(&shell, &normals),
            bounds: Aabb::around(&shell.mesh.points),
            shell,
            normals,
            surface_of,
            corners,
            curves,
            surfaces,
        };
        monitor.checkpoint(Self::IMPORT, 1.0)?;
        solid.count(&mut report);
        Ok((solid, report))
    }

    fn count(&self, report: &mut SolidReport) {
        report.points = self.points().len();
        report.triangles = self.triangles().len();
        report.bodies = self.surfaces.iter().map(|s| s.body as usize + 1).max().unwrap_or(0);
        report.corners = self.corners.len();
        report.curves = self.curves.len();
        report.surfaces = self.surfaces.len();
    }

    /// Coordinates of the vertices.
    pub fn points(&self) -> &[Point] {
        &self.shell.mesh.points
    }

    /// The vertices of each triangle, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.shell.mesh.triangles
    }

    /// The outward unit normal of each triangle; zero if it has no area.
    pub fn normals(&self) -> &[Point] {
        &self.normals
    }

    /// The outward unit normal at vertex `v`: of the triangles around, by their angles there.
    pub fn normal_at(&self, v: u32) -> Point {
        self.vertex_normals[v as usize].normalize_or_zero()
    }

    /// The corners of a triangle.
    pub fn corners_of(&self, triangle: usize) -> [Point; 3] {
        self.shell.mesh.at(triangle)
    }

    /// The triangle on the other side of an edge: `side` runs from the triangle's corner `side` to the next.
    pub fn across(&self, triangle: usize, side: usize) -> u32 {
        self.shell.twins[3 * triangle + side] / 3
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
        self.points().len() as i64 - self.shell.len() as i64 / 2 + self.triangles().len() as i64
    }

    /// The point of the boundary nearest to `p`.
    pub fn nearest(&self, p: Point) -> Foot {
        let found = self.all.nearest(p);
        self.foot(p, found.triangle, found.point)
    }

    /// The point of a surface nearest to `p`.
    pub fn nearest_on_surface(&self, s: SurfaceId, p: Point) -> Foot {
        let found = self.by_surface[s.index()].nearest(p);
        self.foot(p, self.surfaces[s.index()].triangles[found.triangle] as usize, found.point)
    }

    fn foot(&self, p: Point, triangle: usize, point: Point) -> Foot {
        let normal = self.normals[triangle];
        Foot { point, normal, distance: point.distance(p), triangle: triangle as u32 }
    }

    /// The point of a curve nearest to `p`.
    pub fn nearest_on_curve(&self, c: CurveId, p: Point) -> CurveFoot {
        self.by_curve[c.index()].nearest(p)
    }

    /// How far `p` is from the boundary; negative inside.
    pub fn signed_distance(&self, p: Point) -> f64 {
        let found = self.all.nearest(p);
        let normal = pseudo_normal(&self.shell, &self.normals, &self.vertex_normals, found.triangle, p);
        let away = p - found.point;
        away.length().copysign(away.dot(normal))
    }

    /// Is `p` inside?
    pub fn contains(&self, p: Point) -> bool {
        self.signed_distance(p) < 0.0
    }
}
