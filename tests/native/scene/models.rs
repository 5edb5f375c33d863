//! Draw buffers, camera and picking on real models.

use std::collections::BTreeSet;

use glam::DVec2;
use hexmill::{
    io::{self, Format},
    scene::{Axis, FeatureKind, FeatureLine, Projection, Scene, Style, Surface, Viewport},
    sizing::Shape,
};

const VIEW: Viewport = Viewport { width: 900.0, height: 700.0 };
const MODELS: [&str; 4] = ["solids/spot.obj", "quads/car.obj", "quads/rook.obj", "solids/3holes.obj"];

fn surface(name: &str) -> Surface {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name);
    let document = io::read(&std::fs::read(path).unwrap(), Format::Obj).unwrap();
    Surface::try_from(&document.into_surface().unwrap()).unwrap()
}

fn scene(name: &str, axis: Axis, projection: Projection) -> Scene {
    let mut scene = Scene::default();
    scene.viewport = VIEW;
    scene.set_surface(Some(surface(name)));
    scene.camera.projection = projection;
    scene.camera = scene.along(axis);
    scene
}

#[test]
fn buffers_hold_every_side_of_every_face_once() {
    for name in MODELS {
        let surface = surface(name);
        let faces = surface.face_count();
        let corners: usize = (0..faces).map(|f| surface.face(f).len()).sum();
        let mut triangles = 0;
        let mut sides = 0;
        for run in surface.runs(1000) {
            let buffers = surface.triangles(run);
            assert_eq!(buffers.nodes.len(), 3 * buffers.tags.len());
            triangles += buffers.tags.len();
            sides += buffers.tags.iter().map(|t| (t & 7).count_ones() as usize).sum::<usize>();
        }
        assert_eq!(triangles, surface.triangle_count(), "{name}");
        assert_eq!(triangles, corners - 2 * faces, "{name}");
        assert_eq!(sides, corners, "{name}: one side a corner");
        assert_eq!(surface.normals().len(), faces, "{name}");
        let reach = surface.positions().iter().map(|p| p.abs().max_element()).fold(0.0, f32::max);
        assert!((reach - 0.5).abs() < 1e-6, "{name}: the longest side is 1 in the scene");
    }
}

#[test]
fn framed_models_touch_the_margin_and_stay_inside() {
    for name in MODELS {
        for projection in [Projection::Perspective, Projection::Orthographic] {
            for axis in [Axis::Iso, Axis::PlusX, Axis::MinusZ] {
                let scene = scene(name, axis, projection);
                let clip_from_scene = scene.clip_from_scene();
                let reach = scene
                    .surface()
                    .unwrap()
                    .positions()
                    .iter()
                    .map(|&p| clip_from_scene.project_point3(p))
                    .inspect(|clip| assert!((0.0..=1.0).contains(&clip.z), "{name}: {clip}"))
                    .map(|clip| clip.truncate().abs().max_element())
                    .fold(0.0, f32::max);
                assert!((reach - 1.0 / 1.08).abs() < 1e-3, "{name} {projection:?} {axis:?}: {reach}");
            }
        }
    }
}

#[test]
fn faces_are_picked_where_they_are_drawn() {
    for name in MODELS {
        let scene = scene(name, Axis::Iso, Projection::Perspective);
        let surface = scene.surface().unwrap();
        let mut picked = BTreeSet::new();
        for i in 0..60 {
            for j in 0..50 {
                let pixel = DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) * 15.0 - 7.0;
                let Some(hit) = scene.pick(pixel) else { continue };
                let seen = scene.camera.pixel(hit.point, VIEW).unwrap();
                assert!(seen.distance(pixel) < 1e-3, "{name}: picked at {pixel}, seen at {seen}");
                let room = 1e-6 * surface.bounds().diagonal();
                let face = surface.face_bounds(hit.face).grown(room);
                assert!(hit.point.cmpge(face.min).all() && hit.point.cmple(face.max).all(), "{name}");
                picked.insert(hit.face);
            }
        }
        assert!(picked.len() > 50, "{name}: {} faces", picked.len());
    }
}

#[test]
fn a_region_is_selected_and_dragged_by_its_handles() {
    let mut scene = scene("solids/spot.obj", Axis::PlusY, Projection::Orthographic);
    let middle = scene.surface().unwrap().bounds().center();
    let sphere = Shape::Sphere { center: middle, radius: 0.3 };
    scene.set_regions(vec![sphere], None);
    let at = scene.camera.pixel(middle, VIEW).unwrap();
    assert_eq!(scene.region_at(at), Some(0));
    assert!(scene.handles().is_empty(), "no handles without selection");

    scene.set_regions(scene.regions().to_vec(), Some(0));
    let radius = scene.handles().iter().find(|h| h.grip.name() == "radius").unwrap().at;
    let from = scene.camera.pixel(radius, VIEW).unwrap();
    assert!(!scene.drag_start(from + DVec2::new(40.0, 40.0), 8.0));
    assert!(scene.drag_start(from, 8.0));
    let pixels = 0.1 / scene.camera.pixel_size(radius, VIEW);
    let Some(Shape::Sphere { center, radius }) = scene.drag_to(from + DVec2::X * pixels).cloned() else {
        panic!("a sphere")
    };
    assert!((radius - 0.4).abs() < 1e-9 && center == middle, "{center} {radius}");

    // The page hands the regions back while the drag goes on.
    scene.set_regions(scene.regions().to_vec(), Some(0));
    let Some(Shape::Sphere { radius, .. }) = scene.drag_to(from) else { panic!("a sphere") };
    assert!((radius - 0.3).abs() < 1e-9);
    scene.release();
    assert_eq!(scene.drag_to(from), None);
}

#[test]
fn zooming_stops_before_the_picture_falls_apart() {
    let mut scene = scene("solids/bunny.obj", Axis::Iso, Projection::Perspective);
    let anchor = scene.point_under(DVec2::new(450.0, 350.0));
    for factor in [0.5, 2.0] {
        for _ in 0..200 {
            scene.zoom(anchor, factor);
        }
        let clip = scene.clip_from_scene();
        assert!(clip.is_finite() && scene.camera.distance.is_normal());
        let seen = scene.camera.pixel(anchor, VIEW).unwrap();
        assert!(seen.distance(DVec2::new(450.0, 350.0)) < 1e-3, "{seen}");
    }
}

#[test]
fn the_overlay_follows_the_selection() {
    let mut scene = scene("quads/rook.obj", Axis::Iso, Projection::Perspective);
    let triad = scene.front_buffers();
    assert_eq!((triad.lines.len(), triad.discs.len()), (3 + 2 + 3 + 3, 0), "arms and letters");
    let bounds = *scene.surface().unwrap().bounds();
    let part = Shape::Box { min: bounds.min, max: bounds.center(), rotation: glam::DQuat::IDENTITY };
    scene.set_regions(vec![part], Some(0));
    let regions = scene.region_buffers();
    assert_eq!((regions.solids.len(), regions.outlines.len()), (36, 12));
    let front = scene.front_buffers();
    assert_eq!(front.discs.len(), scene.handles().len());
    assert_eq!(front.lines.len(), triad.lines.len() + 3);
    scene.grab(DVec2::new(450.0, 350.0));
    assert_eq!(scene.front_buffers().discs.len(), front.discs.len() + 1, "the pivot shows while it turns");
    scene.release();
    assert_eq!(scene.front_buffers().discs.len(), front.discs.len());
}

#[test]
fn features_are_lines_and_points_that_lost_ones_stand_out_of() {
    let mut scene = scene("quads/rook.obj", Axis::Iso, Projection::Perspective);
    let line =
        |kind, points: &[[f64; 3]]| FeatureLine { kind, points: points.iter().map(|&p| p.into()).collect() };
    let path = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let features = [FeatureKind::Convex, FeatureKind::Lost].map(|kind| line(kind, &path));
    scene.set_features(features.into_iter().chain([line(FeatureKind::Corner, &path[..1])]).collect());
    let drawn = scene.region_buffers();
    assert_eq!((drawn.outlines.len(), drawn.discs.len()), (4, 1));
    assert_eq!(drawn.outlines[0].to, drawn.outlines[1].from);
    assert_ne!(drawn.outlines[0].colour, drawn.outlines[2].colour);
    assert!(drawn.outlines[0].width < drawn.outlines[2].width);
    scene.set_features(Vec::new());
    assert!(scene.region_buffers().outlines.is_empty());
}

#[test]
fn the_triad_stands_above_what_covers_a_narrow_view() {
    let lowest = |width: f64| {
        let mut scene = Scene::default();
        scene.viewport = Viewport { width, height: 700.0 };
        scene.style = Style { covered: [292.0, 84.0], ..Style::default() };
        let world = |p: glam::Vec3| scene.frame().world(p.as_dvec3());
        let ends = scene.front_buffers().lines.into_iter().flat_map(|line| [line.from, line.to]);
        ends.map(|p| scene.camera.pixel(world(p), scene.viewport).unwrap().y).fold(0.0, f64::max)
    };
    assert!(lowest(1024.0) < 700.0 - 84.0, "{}", lowest(1024.0));
    assert!(lowest(1440.0) > 700.0 - 84.0, "{}", lowest(1440.0));
}
