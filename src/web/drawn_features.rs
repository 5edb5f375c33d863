//! The features of a solid that the viewer draws, as JavaScript has them.

use glam::DVec3;
use serde::Deserialize;

use crate::scene::{FeatureKind, FeatureLine};

/// `{ kind: 'convex' | 'concave' | 'corner' | 'lost', points }`, vectors as arrays; one point alone is drawn as a point.
#[derive(Clone, Debug, Deserialize)]
pub struct DrawnFeature {
    kind: DrawnKind,
    points: Vec<DVec3>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
enum DrawnKind {
    Convex,
    Concave,
    Corner,
    Lost,
}

impl From<DrawnFeature> for FeatureLine {
    fn from(DrawnFeature { kind, points }: DrawnFeature) -> Self {
        let kind = match kind {
            DrawnKind::Convex => FeatureKind::Convex,
            DrawnKind::Concave => FeatureKind::Concave,
            DrawnKind::Corner => FeatureKind::Corner,
            DrawnKind::Lost => FeatureKind::Lost,
        };
        Self { kind, points }
    }
}
