//! Regions as the command line writes them: `KIND:NUMBERS:h=SIZE` and `KIND:NUMBERS:level=N`.

use std::path::{Path, PathBuf};

use glam::DQuat;
use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh};
use hexmill::sizing::{Region, Shape, Target};

use super::failure::Failure;
use super::files::load;

/// A region of the command line, its files not yet read.
#[derive(Clone, Debug)]
pub(crate) struct RegionArg {
    /// As it was given.
    pub(crate) text: String,
    shape: ShapeArg,
    target: Target,
}

#[derive(Clone, Debug)]
enum ShapeArg {
    Ready(Shape),
    Points { file: PathBuf, radius: f64 },
    Surface { file: PathBuf, distance: f64 },
}

/// Reads a region; the error says how to write it.
pub(crate) fn parse(text: &str) -> Result<RegionArg, String> {
    let (kind, rest) =
        text.split_once(':').ok_or("write it as KIND:NUMBERS:h=SIZE or KIND:NUMBERS:level=N")?;
    let (values, target) =
        rest.rsplit_once(':').ok_or("a target is missing at the end: write :h=SIZE or :level=N")?;
    let shape = match kind {
        "box" => box_shape(&numbers(values)?)?,
        "sphere" => match numbers(values)?[..] {
            [x, y, z, radius] => {
                ShapeArg::Ready(Shape::Sphere { center: Point::new(x, y, z), radius: reach(radius)? })
            }
            _ => return Err("a sphere is sphere:cx,cy,cz,r".to_owned()),
        },
        "cylinder" => match numbers(values)?[..] {
            [ax, ay, az, bx, by, bz, radius] => ShapeArg::Ready(Shape::Cylinder {
                from: Point::new(ax, ay, az),
                to: Point::new(bx, by, bz),
                radius: reach(radius)?,
            }),
            _ => return Err("a cylinder is cylinder:ax,ay,az,bx,by,bz,r".to_owned()),
        },
        "points" => {
            let (file, radius) =
                file_and_reach(values).ok_or("points are points:FILE,r with r of 0 or more")?;
            ShapeArg::Points { file, radius }
        }
        "surface" => {
            let (file, distance) =
                file_and_reach(values).ok_or("a surface is surface:FILE,d with d of 0 or more")?;
            ShapeArg::Surface { file, distance }
        }
        _ => {
            return Err(format!("there is no region '{kind}': use box, sphere, cylinder, points or surface"));
        }
    };
    Ok(RegionArg { text: text.to_owned(), shape, target: parse_target(target)? })
}

fn parse_target(text: &str) -> Result<Target, String> {
    if let Some(size) = text.strip_prefix("h=") {
        return match size.parse() {
            Ok(size) if size > 0.0 && f64::is_finite(size) => Ok(Target::Size(size)),
            _ => Err(format!("the size '{size}' is not a number above 0")),
        };
    }
    if let Some(level) = text.strip_prefix("level=") {
        let level =
            level.parse().map_err(|_| format!("the level '{level}' is not a whole number from 0 to 255"))?;
        return Ok(Target::Level(level));
    }
    Err(format!("'{text}' is no target: end the region with :h=SIZE or :level=N"))
}

fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("'{text}' is not a number")),
    }
}

fn numbers(text: &str) -> Result<Vec<f64>, String> {
    text.split(',').map(number).collect()
}

fn reach(radius: f64) -> Result<f64, String> {
    if radius > 0.0 { Ok(radius) } else { Err(format!("the radius is {radius}: give a number above 0")) }
}

/// `FILE,NUMBER`; the file's name may hold commas and colons.
fn file_and_reach(text: &str) -> Option<(PathBuf, f64)> {
    let (file, reach) = text.rsplit_once(',')?;
    let reach = number(reach).ok().filter(|&r| r >= 0.0)?;
    (!file.is_empty()).then(|| (PathBuf::from(file), reach))
}

fn box_shape(values: &[f64]) -> Result<ShapeArg, String> {
    let (corners, turn) = values.split_at_checked(6).ok_or("a box is box:x0,y0,z0,x1,y1,z1")?;
    let rotation = match *turn {
        [] => DQuat::IDENTITY,
        [x, y, z] => turned(x, y, z),
        [x, y, z, w] => {
            let quaternion = DQuat::from_xyzw(x, y, z, w);
            if quaternion.length() < f64::MIN_POSITIVE {
                return Err("the box's quaternion is 0: write 0,0,0,1 for no turn".to_owned());
            }
            quaternion.normalize()
        }
        _ => {
            return Err(
                "a box has 6 numbers, with a turn 9 (degrees about x, y, z) or 10 (a quaternion)".to_owned()
            );
        }
    };
    let (a, b) = (Point::from_slice(&corners[..3]), Point::from_slice(&corners[3..]));
    Ok(ShapeArg::Ready(Shape::Box { min: a.min(b), max: a.max(b), rotation }))
}

/// The turn about the fixed axes x, then y, then z, in degrees. Through libm, so that it is the same on
/// every platform.
fn turned(x: f64, y: f64, z: f64) -> DQuat {
    let about = |axis: Point, degrees: f64| {
        let half = degrees.to_radians() / 2.0;
        let v = axis * libm::sin(half);
        DQuat::from_xyzw(v.x, v.y, v.z, libm::cos(half))
    };
    about(Point::Z, z) * about(Point::Y, y) * about(Point::X, x)
}

impl RegionArg {
    /// The file that the region is read from, if any.
    pub(crate) fn file(&self) -> Option<&Path> {
        match &self.shape {
            ShapeArg::Ready(_) => None,
            ShapeArg::Points { file, .. } | ShapeArg::Surface { file, .. } => Some(file),
        }
    }

    /// The region, with its file read if it names one.
    pub(crate) fn load(&self) -> Result<Region, Failure> {
        let shape = match &self.shape {
            ShapeArg::Ready(shape) => shape.clone(),
            ShapeArg::Points { file, radius } => {
                Shape::Points { points: load(file)?.document.mesh.positions().to_vec(), radius: *radius }
            }
            ShapeArg::Surface { file, distance } => {
                let (positions, triangles) = load_triangles(file)?;
                Shape::Surface { positions, triangles, distance: *distance }
            }
        };
        Ok(Region { shape, target: self.target })
    }
}

/// The faces of a file as triangles: see [`triangles_of`].
pub(crate) fn load_triangles(path: &Path) -> Result<(Vec<Point>, Vec<[u32; 3]>), Failure> {
    let surface = load(path)?.document.into_surface().ok_or_else(|| {
        let message = "holds hexes, but a surface is wanted here; give a mesh of triangles or quads";
        Failure::refused("surface-needed", format!("{}: {message}", path.display()))
    })?;
    let triangles = triangles_of(&surface, path)?;
    Ok((surface.positions, triangles))
}

/// The faces of the surface in `path` as triangles: each polygon as a fan around its first node.
pub(crate) fn triangles_of(surface: &PolygonMesh, path: &Path) -> Result<Vec<[u32; 3]>, Failure> {
    let fan = |face: &[NodeId]| -> Vec<[u32; 3]> {
        face[1..].windows(2).map(|pair| [face[0].0, pair[0].0, pair[1].0]).collect()
    };
    let triangles: Vec<[u32; 3]> = surface.faces().flat_map(fan).collect();
    if triangles.is_empty() {
        let message = format!("{}: holds no faces; give a mesh with at least one", path.display());
        return Err(Failure::refused("surface-empty", message));
    }
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(text: &str) -> Shape {
        match parse(text).unwrap().shape {
            ShapeArg::Ready(shape) => shape,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn kinds_and_targets() {
        assert_eq!(
            shape("sphere:1,2,3,4:h=0.5"),
            Shape::Sphere { center: Point::new(1.0, 2.0, 3.0), radius: 4.0 }
        );
        assert_eq!(parse("sphere:1,2,3,4:h=0.5").unwrap().target, Target::Size(0.5));
        assert_eq!(parse("box:0,0,0,1,1,1:level=3").unwrap().target, Target::Level(3));
        let cylinder = Shape::Cylinder { from: Point::ZERO, to: Point::Z, radius: 0.25 };
        assert_eq!(shape("cylinder:0,0,0,0,0,1,0.25:h=1"), cylinder);
    }

    #[test]
    fn box_corners_in_any_order() {
        let expected = Shape::Box { min: Point::ZERO, max: Point::ONE, rotation: DQuat::IDENTITY };
        assert_eq!(shape("box:1,0,1,0,1,0:h=1"), expected);
    }

    #[test]
    fn turned_boxes() {
        let rotation = |text: &str| match shape(text) {
            Shape::Box { rotation, .. } => rotation,
            other => panic!("{other:?}"),
        };
        let quarter = rotation("box:0,0,0,1,1,1,0,0,90:h=1");
        assert!((quarter * Point::X).distance(Point::Y) < 1e-15, "{quarter}");
        let x_then_z = rotation("box:0,0,0,1,1,1,90,0,90:h=1");
        assert!((x_then_z * Point::Y).distance(Point::Z) < 1e-15, "{x_then_z}");
        assert_eq!(rotation("box:0,0,0,1,1,1,0,0,0,2:h=1"), DQuat::IDENTITY);
    }

    #[test]
    fn files_with_odd_names() {
        match parse("points:C:\\a,b.obj,0.5:level=2").unwrap().shape {
            ShapeArg::Points { file, radius } => {
                assert_eq!((file.to_str(), radius), (Some("C:\\a,b.obj"), 0.5))
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, part) in [
            ("sphere", "write it as KIND"),
            ("sphere:1,2,3,4", "a target is missing"),
            ("sphere:1,2,3:h=1", "a sphere is"),
            ("sphere:1,2,3,0:h=1", "the radius is 0"),
            ("sphere:1,2,x,4:h=1", "'x' is not a number"),
            ("sphere:1,2,nan,4:h=1", "'nan' is not a number"),
            ("sphere:1,2,3,4:h=-1", "the size '-1' is not"),
            ("sphere:1,2,3,4:level=300", "the level '300' is not"),
            ("sphere:1,2,3,4:size", "'size' is no target"),
            ("cone:1:h=1", "there is no region 'cone'"),
            ("box:1,2,3:h=1", "a box is"),
            ("box:1,2,3,4,5,6,7:h=1", "a box has 6 numbers"),
            ("box:1,2,3,4,5,6,0,0,0,0:h=1", "quaternion is 0"),
            ("cylinder:1,2:h=1", "a cylinder is"),
            ("points:a.obj:h=1", "points are"),
            ("surface:,1:h=1", "a surface is"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
