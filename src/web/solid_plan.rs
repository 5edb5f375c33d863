//! What is told of a solid before it is meshed: its features, and about how many hexes will fill it.

use serde::Serialize;

use super::convert::Bounds;
use super::solids::BYTES_PER_HEX;
use crate::Monitor;
use crate::geometry::Point;
use crate::hexing::{HexingError, HexingOptions, SolidForecast, forecast_hexes};
use crate::mesh::PolygonMesh;
use crate::solid::{self, SolidModel, SolidReport, SurfaceClass};

/// What is told of a solid.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Plan {
    found: SolidReport,
    bounds: Bounds,
    volume: f64,
    area: f64,
    corners: Vec<Point>,
    curves: Vec<Curve>,
    surfaces: Vec<Surface>,
    /// About; without an edge length null.
    hexes: Option<f64>,
    bytes: Option<f64>,
    idle_regions: Vec<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Curve {
    points: Vec<Point>,
    corners: Option<[u32; 2]>,
    surfaces: [u32; 2],
    interior_angle: f64,
    length: f64,
    is_straight: bool,
}

#[derive(Serialize)]
struct Surface {
    class: Class,
    area: f64,
    curves: Vec<u32>,
    bounds: Bounds,
    body: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase", tag = "kind")]
enum Class {
    Planar { normal: Point },
    Cylindrical { axis: Point },
    General,
}

impl Plan {
    /// Finds the solid in a surface and tells of it.
    ///
    /// # Errors
    /// If the surface bounds no solid, or the monitor stops it.
    pub(super) fn new(
        surface: &PolygonMesh,
        options: &HexingOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, HexingError> {
        let (solid, found) = SolidModel::new(surface, &options.solid(), monitor)?;
        let has_length = options.edge_length != 0.0;
        let forecast = has_length.then(|| forecast_hexes(&solid, options, monitor)).transpose()?;
        let (hexes, idle_regions) =
            forecast.map(|SolidForecast { hexes, idle_regions }| (hexes.ceil(), idle_regions)).unzip();
        Ok(Self {
            found,
            bounds: solid.bounds().into(),
            volume: solid.volume(),
            area: solid.area(),
            corners: solid.corners().iter().map(|corner| corner.point).collect(),
            curves: solid.curves().iter().map(|curve| Curve::of(&solid, curve)).collect(),
            surfaces: solid.surfaces().iter().map(Surface::from).collect(),
            hexes,
            bytes: hexes.map(|hexes| hexes * BYTES_PER_HEX as f64),
            idle_regions: idle_regions.unwrap_or_default(),
        })
    }
}

impl Curve {
    fn of(solid: &SolidModel, curve: &solid::Curve) -> Self {
        Self {
            points: curve.vertices.iter().map(|&v| solid.points()[v as usize]).collect(),
            corners: curve.ends.map(|ends| ends.map(|corner| corner.0)),
            surfaces: curve.sides.map(|surface| surface.0),
            interior_angle: curve.interior_angle,
            length: curve.length,
            is_straight: curve.is_straight,
        }
    }
}

impl From<&solid::Surface> for Surface {
    fn from(surface: &solid::Surface) -> Self {
        Self {
            class: surface.class.into(),
            area: surface.area,
            curves: surface.curves.iter().map(|curve| curve.0).collect(),
            bounds: surface.bounds.into(),
            body: surface.body,
        }
    }
}

impl From<SurfaceClass> for Class {
    fn from(class: SurfaceClass) -> Self {
        match class {
            SurfaceClass::Planar { normal } => Self::Planar { normal },
            SurfaceClass::Cylindrical { axis } => Self::Cylindrical { axis },
            SurfaceClass::General => Self::General,
        }
    }
}
