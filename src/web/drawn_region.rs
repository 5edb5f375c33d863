//! The regions and the section that the viewer draws, as JavaScript has them.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::{scene::Section, sizing::Shape};

/// `{ kind: 'box', min, max, rotation? } | { kind: 'sphere', center, radius } | { kind: 'cylinder', from,
/// to, radius }`, vectors as arrays. Other keys are ignored.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub enum DrawnRegion {
    /// See [`Shape::Box`].
    Box {
        min: DVec3,
        max: DVec3,
        #[serde(default)]
        rotation: DQuat,
    },
    /// See [`Shape::Sphere`].
    Sphere { center: DVec3, radius: f64 },
    /// See [`Shape::Cylinder`].
    Cylinder { from: DVec3, to: DVec3, radius: f64 },
}

impl From<DrawnRegion> for Shape {
    fn from(region: DrawnRegion) -> Self {
        match region {
            DrawnRegion::Box { min, max, rotation } => Self::Box { min, max, rotation },
            DrawnRegion::Sphere { center, radius } => Self::Sphere { center, radius },
            DrawnRegion::Cylinder { from, to, radius } => Self::Cylinder { from, to, radius },
        }
    }
}

impl DrawnRegion {
    /// The region of a shape; `None` if the viewer does not draw such shapes.
    pub fn of(shape: &Shape) -> Option<Self> {
        match *shape {
            Shape::Box { min, max, rotation } => Some(Self::Box { min, max, rotation }),
            Shape::Sphere { center, radius } => Some(Self::Sphere { center, radius }),
            Shape::Cylinder { from, to, radius } => Some(Self::Cylinder { from, to, radius }),
            Shape::Points { .. } | Shape::Surface { .. } => None,
        }
    }
}

/// The plane that cuts a hex mesh: `{ kind: 'section', normal, offset }`, the normal as an array.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename = "section")]
pub struct DrawnSection {
    normal: DVec3,
    offset: f64,
}

impl DrawnSection {
    /// The plane, if it is one.
    pub fn plane(self) -> Result<Section, String> {
        let Self { normal, offset } = self;
        Section::new(normal, offset)
            .ok_or_else(|| format!("normal {normal} and offset {offset} are no plane"))
    }

    /// The plane as JavaScript has it.
    pub fn of(section: &Section) -> Self {
        Self { normal: section.normal(), offset: section.offset() }
    }
}
