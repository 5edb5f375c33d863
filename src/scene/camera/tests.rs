use super::*;

const VIEW: Viewport = Viewport { width: 800.0, height: 500.0 };
const PROJECTIONS: [Projection; 2] = [Projection::Perspective, Projection::Orthographic];
const AXES: [Axis; 7] =
    [Axis::PlusX, Axis::MinusX, Axis::PlusY, Axis::MinusY, Axis::PlusZ, Axis::MinusZ, Axis::Iso];

fn part() -> Aabb {
    Aabb { min: Point::new(100.0, -3.0, 2.0), max: Point::new(104.0, 5.0, 3.5) }
}

fn framed(projection: Projection, axis: Axis) -> Camera {
    let mut camera = Camera { projection, ..Camera::default() };
    camera.look_along(axis);
    camera.frame(corners(&part()), VIEW, DVec2::ONE);
    camera
}

#[track_caller]
fn near(a: DVec2, b: DVec2) {
    assert!(a.distance(b) < 1e-6, "{a} {b}");
}

#[test]
fn framing_shows_all_and_fills_the_view() {
    for projection in PROJECTIONS {
        for axis in AXES {
            let camera = framed(projection, axis);
            let mut reach = DVec2::ZERO;
            for corner in corners(&part()) {
                let at = camera.pixel(corner, VIEW).unwrap();
                let clip = camera.clip_from_world(&part(), VIEW).project_point3(corner);
                assert!(clip.abs().max_element() <= 1.0 && clip.z >= 0.0, "{axis:?} {clip}");
                near(at, DVec2::new((clip.x + 1.0) * 400.0, (1.0 - clip.y) * 250.0));
                reach = reach.max(clip.truncate().abs());
            }
            assert!(
                (reach.max_element() - 1.0 / FRAME_MARGIN).abs() < 1e-9,
                "{projection:?} {axis:?} {reach}"
            );
        }
    }
}

#[test]
fn up_is_up_and_right_is_right() {
    let seen = |axis| framed(Projection::Orthographic, axis).axes();
    let check = |axis, right: DVec3, up: DVec3| {
        let [r, u, _] = seen(axis);
        assert!(r.distance(right) < 1e-12 && u.distance(up) < 1e-12, "{axis:?} {r} {u}");
    };
    check(Axis::PlusY, DVec3::X, DVec3::Z);
    check(Axis::MinusX, DVec3::Y, DVec3::Z);
    check(Axis::PlusX, DVec3::NEG_Y, DVec3::Z);
    check(Axis::MinusZ, DVec3::X, DVec3::Y);
    let [right, up, forward] = seen(Axis::Iso);
    assert!(up.z > 0.8 && forward.z < 0.0 && forward.y > 0.0 && forward.x < 0.0, "{right} {up} {forward}");
}

#[test]
fn with_y_up_the_axes_keep_their_meaning() {
    for axis in AXES.into_iter().filter(|&axis| axis != Axis::Iso) {
        let z_up = Camera::default();
        let mut y_up = Camera { up: Up::Y, ..z_up };
        y_up.look_along(axis);
        let mut same = z_up;
        same.look_along(axis);
        assert!((y_up.axes()[2] - same.axes()[2]).length() < 1e-12, "{axis:?} is a direction of the world");
    }
    let mut camera = Camera { up: Up::Y, ..Camera::default() };
    camera.look_along(Axis::Iso);
    let [right, up, forward] = camera.axes();
    assert!(up.y > 0.8 && right.y.abs() < 1e-12, "Y is up");
    assert!(forward.z < 0.0 && forward.x < 0.0, "seen from the front and right");
    camera.orbit(Point::ONE, 0.4, 0.1);
    assert!(camera.axes()[0].y.abs() < 1e-12, "the horizon stays level");
}

#[test]
fn orbit_keeps_the_pivot_on_its_pixel() {
    for projection in PROJECTIONS {
        let mut camera = framed(projection, Axis::Iso);
        let pivot = Point::new(103.0, 4.0, 2.5);
        let before = camera.pixel(pivot, VIEW).unwrap();
        let distance = camera.eye.distance(pivot);
        camera.orbit(pivot, 0.7, -0.2);
        near(camera.pixel(pivot, VIEW).unwrap(), before);
        assert!((camera.eye.distance(pivot) - distance).abs() < 1e-9);
        camera.orbit(pivot, 0.0, 10.0);
        assert_eq!(camera.pitch, FRAC_PI_2);
        near(camera.pixel(pivot, VIEW).unwrap(), before);
    }
}

#[test]
fn dolly_keeps_the_anchor_and_pan_moves_it_with_the_pointer() {
    for projection in PROJECTIONS {
        let mut camera = framed(projection, Axis::Iso);
        let pixel = DVec2::new(200.0, 130.0);
        let anchor = camera.point_at_depth_of(camera.target(), pixel, VIEW);
        near(camera.pixel(anchor, VIEW).unwrap(), pixel);
        let size = camera.pixel_size(camera.target(), VIEW);
        camera.dolly(anchor, 0.25);
        near(camera.pixel(anchor, VIEW).unwrap(), pixel);
        assert!((camera.pixel_size(camera.target(), VIEW) / size - 0.25).abs() < 1e-9);
        camera.pan(anchor, DVec2::new(31.0, -17.0), VIEW);
        near(camera.pixel(anchor, VIEW).unwrap(), pixel + DVec2::new(31.0, -17.0));
    }
}

#[test]
fn rays_go_through_their_pixels() {
    for projection in PROJECTIONS {
        let camera = framed(projection, Axis::Iso);
        let pixel = DVec2::new(612.0, 77.0);
        let ray = camera.ray(pixel, VIEW);
        let along = camera.eye.distance(ray.origin) + camera.distance * 2.0;
        near(camera.pixel(ray.origin + ray.direction * along, VIEW).unwrap(), pixel);
    }
}

#[test]
fn switching_projection_keeps_the_size_of_the_target() {
    let mut camera = framed(Projection::Perspective, Axis::Iso);
    let size = camera.pixel_size(camera.target(), VIEW);
    camera.projection = Projection::Orthographic;
    assert!((camera.pixel_size(camera.target(), VIEW) - size).abs() < 1e-12);
}

#[test]
fn flights_start_and_end_where_they_should() {
    let from = framed(Projection::Perspective, Axis::PlusX);
    let to = framed(Projection::Perspective, Axis::MinusY);
    assert!(from.between(&to, 0.0).eye.distance(from.eye) < 1e-9);
    assert!(from.between(&to, 1.0).eye.distance(to.eye) < 1e-9);
    // The short way from 0 to 270 degrees passes 315.
    assert!((from.between(&to, 0.5).yaw.rem_euclid(TAU) - 7.0 * FRAC_PI_4).abs() < 1e-9);
}

#[test]
fn an_eye_inside_the_part_still_sees_something() {
    let mut camera = framed(Projection::Perspective, Axis::Iso);
    camera.dolly(part().center(), 1e-3);
    let (near, far) = camera.depths(&part());
    assert!(near > 0.0 && near < camera.distance && far > camera.distance, "{near} {far}");
}
