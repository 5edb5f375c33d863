//! Regions as JSON.

use glam::DQuat;
use serde_json::json;

use super::{Region, Shape, Target};
use crate::geometry::Point;

#[test]
fn every_kind_goes_there_and_back() {
    let cases = [
        (
            json!({"kind": "sphere", "center": [1.0, 2.0, 3.0], "radius": 1.5, "size": 0.1}),
            Shape::Sphere { center: Point::new(1.0, 2.0, 3.0), radius: 1.5 },
            Target::Size(0.1),
        ),
        (
            json!({"kind": "box", "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 1.0], "level": 3}),
            Shape::Box { min: Point::ZERO, max: Point::ONE, rotation: DQuat::IDENTITY },
            Target::Level(3),
        ),
        (
            json!({"kind": "box", "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 1.0], "rotation": [0.0, 0.6, 0.0, 0.8], "level": 3}),
            Shape::Box { min: Point::ZERO, max: Point::ONE, rotation: DQuat::from_xyzw(0.0, 0.6, 0.0, 0.8) },
            Target::Level(3),
        ),
        (
            json!({"kind": "cylinder", "from": [0.0, 0.0, 0.0], "to": [0.0, 0.0, 2.0], "radius": 1.0, "size": 2.0}),
            Shape::Cylinder { from: Point::ZERO, to: Point::Z * 2.0, radius: 1.0 },
            Target::Size(2.0),
        ),
        (
            json!({"kind": "points", "points": [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]], "radius": 0.0, "level": 1}),
            Shape::Points { points: vec![Point::ZERO, Point::ONE], radius: 0.0 },
            Target::Level(1),
        ),
        (
            json!({
                "kind": "surface", "positions": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
                "triangles": [[0, 1, 2]], "distance": 0.5, "size": 0.25,
            }),
            Shape::Surface {
                positions: vec![Point::ZERO, Point::X, Point::Y],
                triangles: vec![[0, 1, 2]],
                distance: 0.5,
            },
            Target::Size(0.25),
        ),
    ];
    for (value, shape, target) in cases {
        let region = Region { shape, target };
        assert_eq!(serde_json::to_value(&region).unwrap(), value);
        assert_eq!(serde_json::from_value::<Region>(value.clone()).unwrap(), region);
        assert_eq!(serde_json::from_str::<Region>(&value.to_string()).unwrap(), region);
    }
}

#[test]
fn integers_are_numbers_too() {
    let region: Region =
        serde_json::from_str(r#"{"size": 1, "radius": 2, "center": [0, 0, 0], "kind": "sphere"}"#).unwrap();
    assert_eq!(region.target, Target::Size(1.0));
}

#[test]
fn refusals_say_what_is_wrong() {
    let cases = [
        (r#"{"center":[0,0,0],"radius":1,"size":1}"#, "a region needs 'kind'"),
        (
            r#"{"kind":"ball","center":[0,0,0],"radius":1,"size":1}"#,
            "there is no region of kind 'ball'; use 'box', 'sphere',",
        ),
        (r#"{"kind":"sphere","center":[0,0,0],"radius":1}"#, "a sphere region needs 'size' or 'level'"),
        (
            r#"{"kind":"sphere","center":[0,0,0],"radius":1,"size":1,"level":1}"#,
            "has both 'size' and 'level'",
        ),
        (r#"{"kind":"sphere","radius":1,"size":1}"#, "a sphere region needs 'center'"),
        (r#"{"kind":"sphere","center":[0,0,0],"radius":1,"siz":1}"#, "a region has no key 'siz'"),
        (
            r#"{"kind":"sphere","center":[0,0,0],"radius":1,"min":[0,0,0],"size":1}"#,
            "a sphere region has no key 'min'",
        ),
        (r#"{"kind":"sphere","center":[0,0,0],"radius":1,"radius":2,"size":1}"#, "the key 'radius' twice"),
        (r#"{"kind":"sphere","center":[0,0],"radius":1,"size":1}"#, "3"),
        (r#"{"kind":"sphere","center":[0,0,0],"radius":"1","size":1}"#, "invalid type: string"),
        (r#"{"kind":"sphere","center":[0,0,0],"radius":1,"level":-1}"#, "-1"),
        (r#"{"kind":"sphere","center":[0,0,0],"radius":1,"level":300}"#, "300"),
        ("3", "expected a region such as"),
        ("null", "expected a region such as"),
    ];
    for (text, expected) in cases {
        let message = serde_json::from_str::<Region>(text).unwrap_err().to_string();
        assert!(message.contains(expected), "{text}: {message}");
    }
}
