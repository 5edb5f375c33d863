//! Regions as JSON and as JavaScript objects: the keys of shape and target side by side.
//!
//! Written out, because serde's `flatten` cannot refuse unknown keys. A map is asked for rather than a struct, because
//! some formats (JavaScript objects) give a struct's known keys alone, and a misspelt key would pass unseen.

use std::fmt;

use glam::DQuat;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::{Region, Shape, Target};
use crate::geometry::Point;

impl Serialize for Region {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("kind", self.shape.kind())?;
        match &self.shape {
            Shape::Box { min, max, rotation } => {
                map.serialize_entry("min", min)?;
                map.serialize_entry("max", max)?;
                if *rotation != DQuat::IDENTITY {
                    map.serialize_entry("rotation", rotation)?;
                }
            }
            Shape::Sphere { center, radius } => {
                map.serialize_entry("center", center)?;
                map.serialize_entry("radius", radius)?;
            }
            Shape::Cylinder { from, to, radius } => {
                map.serialize_entry("from", from)?;
                map.serialize_entry("to", to)?;
                map.serialize_entry("radius", radius)?;
            }
            Shape::Points { points, radius } => {
                map.serialize_entry("points", points)?;
                map.serialize_entry("radius", radius)?;
            }
            Shape::Surface { positions, triangles, distance } => {
                map.serialize_entry("positions", positions)?;
                map.serialize_entry("triangles", triangles)?;
                map.serialize_entry("distance", distance)?;
            }
        }
        match self.target {
            Target::Size(size) => map.serialize_entry("size", &size)?,
            Target::Level(level) => map.serialize_entry("level", &level)?,
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Region {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Keys)
    }
}

/// Reads the keys of a region in any order.
struct Keys;

impl<'de> Visitor<'de> for Keys {
    type Value = Region;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(
            "a region such as {\"kind\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 1, \"size\": 0.1}",
        )
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Region, A::Error> {
        let mut values = Values::default();
        while let Some(key) = map.next_key::<String>()? {
            values.read(&key, &mut map)?;
        }
        values.region()
    }
}

/// What has been read so far.
#[derive(Default)]
struct Values {
    kind: Option<String>,
    min: Option<Point>,
    max: Option<Point>,
    rotation: Option<DQuat>,
    center: Option<Point>,
    from: Option<Point>,
    to: Option<Point>,
    points: Option<Vec<Point>>,
    positions: Option<Vec<Point>>,
    triangles: Option<Vec<[u32; 3]>>,
    radius: Option<f64>,
    distance: Option<f64>,
    size: Option<f64>,
    level: Option<u8>,
}

impl Values {
    /// Reads the value of `key`.
    fn read<'de, A: MapAccess<'de>>(&mut self, key: &str, map: &mut A) -> Result<(), A::Error> {
        fn fill<'de, T: Deserialize<'de>, A: MapAccess<'de>>(
            slot: &mut Option<T>,
            key: &str,
            map: &mut A,
        ) -> Result<(), A::Error> {
            match slot.replace(map.next_value()?) {
                None => Ok(()),
                Some(_) => {
                    Err(A::Error::custom(format_args!("a region has the key '{key}' twice; give it once")))
                }
            }
        }
        match key {
            "kind" => fill(&mut self.kind, key, map),
            "min" => fill(&mut self.min, key, map),
            "max" => fill(&mut self.max, key, map),
            "rotation" => fill(&mut self.rotation, key, map),
            "center" => fill(&mut self.center, key, map),
            "from" => fill(&mut self.from, key, map),
            "to" => fill(&mut self.to, key, map),
            "points" => fill(&mut self.points, key, map),
            "positions" => fill(&mut self.positions, key, map),
            "triangles" => fill(&mut self.triangles, key, map),
            "radius" => fill(&mut self.radius, key, map),
            "distance" => fill(&mut self.distance, key, map),
            "size" => fill(&mut self.size, key, map),
            "level" => fill(&mut self.level, key, map),
            _ => Err(A::Error::custom(format_args!(
                "a region has no key '{key}'; remove it or correct its name"
            ))),
        }
    }

    /// The region that the values make up, if they are those of its kind and no others.
    fn region<E: Error>(mut self) -> Result<Region, E> {
        let Some(kind) = self.kind.take() else {
            return Err(E::custom(format_args!("a region needs 'kind': {KINDS}")));
        };
        let shape = match kind.as_str() {
            "box" => Shape::Box {
                min: needed(self.min.take(), &kind, "min")?,
                max: needed(self.max.take(), &kind, "max")?,
                rotation: self.rotation.take().unwrap_or(DQuat::IDENTITY),
            },
            "sphere" => Shape::Sphere {
                center: needed(self.center.take(), &kind, "center")?,
                radius: needed(self.radius.take(), &kind, "radius")?,
            },
            "cylinder" => Shape::Cylinder {
                from: needed(self.from.take(), &kind, "from")?,
                to: needed(self.to.take(), &kind, "to")?,
                radius: needed(self.radius.take(), &kind, "radius")?,
            },
            "points" => Shape::Points {
                points: needed(self.points.take(), &kind, "points")?,
                radius: needed(self.radius.take(), &kind, "radius")?,
            },
            "surface" => Shape::Surface {
                positions: needed(self.positions.take(), &kind, "positions")?,
                triangles: needed(self.triangles.take(), &kind, "triangles")?,
                distance: needed(self.distance.take(), &kind, "distance")?,
            },
            _ => return Err(E::custom(format_args!("there is no region of kind '{kind}'; use {KINDS}"))),
        };
        if let Some(key) = self.left_over() {
            return Err(E::custom(format_args!("a {kind} region has no key '{key}'; remove it")));
        }
        Ok(Region { shape, target: self.target(&kind)? })
    }

    fn target<E: Error>(&mut self, kind: &str) -> Result<Target, E> {
        match (self.size.take(), self.level.take()) {
            (Some(size), None) => Ok(Target::Size(size)),
            (None, Some(level)) => Ok(Target::Level(level)),
            (None, None) => Err(E::custom(format_args!("a {kind} region needs 'size' or 'level'"))),
            (Some(_), Some(_)) => {
                Err(E::custom(format_args!("a {kind} region has both 'size' and 'level'; give one of them")))
            }
        }
    }

    /// A key whose value was not taken.
    fn left_over(&self) -> Option<&'static str> {
        let given = [
            ("min", self.min.is_some()),
            ("max", self.max.is_some()),
            ("rotation", self.rotation.is_some()),
            ("center", self.center.is_some()),
            ("from", self.from.is_some()),
            ("to", self.to.is_some()),
            ("points", self.points.is_some()),
            ("positions", self.positions.is_some()),
            ("triangles", self.triangles.is_some()),
            ("radius", self.radius.is_some()),
            ("distance", self.distance.is_some()),
        ];
        given.into_iter().find(|&(_, given)| given).map(|(key, _)| key)
    }
}

const KINDS: &str = "'box', 'sphere', 'cylinder', 'points' or 'surface'";

fn needed<T, E: Error>(value: Option<T>, kind: &str, key: &str) -> Result<T, E> {
    value.ok_or_else(|| E::custom(format_args!("a {kind} region needs '{key}'")))
}
