use std::collections::BTreeMap;

use super::target::Foot;
use super::*;
use crate::Silent;
use crate::hexing::core::{CoreOptions, core};
use crate::hexing::correspondence::{Anchor, correspond};
use crate::hexing::sheets::insert_sheets;
use crate::hexing::sheets::testing::{cubes, insert_in_groups, side_of_box, told, voxels};
use crate::mesh::PolygonMesh;
use crate::mesh::numbering::hex::{CORNERS, FACES};
use crate::mesh::quality::{Certainty, hex_quality};
use crate::solid::{CornerId, CurveId, SolidOptions, SurfaceId};

/// A ball about the middle.
struct Ball {
    middle: Point,
    radius: f64,
}

impl Target for Ball {
    fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot> {
        let direction = (p - self.middle).normalize_or(Point::X);
        let foot = Foot { point: self.middle + direction * self.radius, direction };
        (anchor != Anchor::Inside).then_some(foot)
    }
}

/// A solid whose surfaces are planes, and perhaps cylinders about the z axis.
struct Shapes {
    shapes: Vec<Shape>,
    /// The surfaces at each curve and each corner.
    curves: BTreeMap<CurveId, Vec<SurfaceId>>,
    corners: BTreeMap<CornerId, Vec<SurfaceId>>,
}

#[derive(Clone, Copy)]
enum Shape {
    /// Normal, and distance from the origin along it.
    Plane(Point, f64),
    /// About the z axis through this point.
    Cylinder(Point, f64),
}

impl Shape {
    fn foot(self, p: Point) -> Foot {
        match self {
            Self::Plane(normal, d) => Foot { point: p - normal * (normal.dot(p) - d), direction: normal },
            Self::Cylinder(axis, radius) => {
                let out = (p - axis) * Point::new(1.0, 1.0, 0.0);
                let direction = out.normalize_or(Point::X);
                Foot { point: p + direction * (radius - out.length()), direction }
            }
        }
    }
}

impl Shapes {
    fn new(shapes: &[Shape], on: &Correspondence) -> Self {
        let (mut curves, mut corners) = (BTreeMap::new(), BTreeMap::new());
        for &(ends, curve) in &on.edges {
            let near = |quad: &[NodeId; 4]| ends.iter().all(|n| quad.contains(n));
            curves.insert(curve, on.faces.iter().filter(|(quad, _)| near(quad)).map(|f| f.1).collect());
        }
        for (n, anchor) in on.anchors.iter().enumerate() {
            if let Anchor::Corner(corner) = *anchor {
                let near = |quad: &[NodeId; 4]| quad.contains(&NodeId::new(n));
                let mut surfaces: Vec<SurfaceId> =
                    on.faces.iter().filter(|(quad, _)| near(quad)).map(|f| f.1).collect();
                surfaces.sort_unstable();
                surfaces.dedup();
                corners.insert(corner, surfaces);
            }
        }
        Self { shapes: shapes.to_vec(), curves, corners }
    }

    /// A point of all the surfaces near to `p`, by going from one to the next.
    fn common(&self, surfaces: &[SurfaceId], p: Point) -> Point {
        (0..200).fold(p, |p, _| surfaces.iter().fold(p, |p, s| self.shapes[s.index()].foot(p).point))
    }
}

impl Target for Shapes {
    fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot> {
        Some(match anchor {
            Anchor::Inside => return None,
            Anchor::Surface(s) => self.shapes[s.index()].foot(p),
            Anchor::Curve(c) => {
                let surfaces = &self.curves[&c];
                let point = self.common(surfaces, p);
                let [a, b] = [0, 1].map(|k| self.shapes[surfaces[k].index()].foot(point).direction);
                Foot { point, direction: a.cross(b).normalize() }
            }
            Anchor::Corner(c) => Foot { point: self.common(&self.corners[&c], p), direction: Point::ZERO },
        })
    }
}

struct Fitted {
    mesh: HexMesh,
    on: Correspondence,
    sheets: SheetReport,
    report: FitReport,
}

/// Inserts sheets, with each surface in its given group, and fits.
fn fitted(mut mesh: HexMesh, mut on: Correspondence, groups: &[u32], target: &dyn Target) -> Fitted {
    let mut sheets = insert_in_groups(&mut mesh, &mut on, groups);
    let report = fit_to(&mut mesh, &mut on, &mut sheets, target, &FitOptions::default(), &Silent).unwrap();
    let quality = hex_quality(&mesh);
    assert!(quality.positive.iter().all(|&positive| positive == Certainty::Positive));
    let least = quality.scaled_jacobian.iter().copied().fold(1.0, f32::min);
    assert!((f64::from(least) - report.worst.unwrap()).abs() < 1e-6);
    assert_eq!(report.inverted, []);
    Fitted { mesh, on, sheets, report }
}

impl Fitted {
    /// Every boundary node is on the target, and cells are at least so good.
    fn expect(&self, target: &dyn Target, worst: f64, mean: f64) {
        let Self { mesh, on, report, .. } = self;
        assert_eq!(report.off, [], "{report:?}");
        for (anchor, p) in on.anchors.iter().zip(&mesh.positions) {
            if let Some(foot) = target.foot(*anchor, *p) {
                assert!(foot.point.distance(*p) < 1e-9, "{anchor:?} at {p}, not {}", foot.point);
            }
        }
        assert!(report.worst.unwrap() >= worst && report.mean >= mean, "{:?} {}", report.worst, report.mean);
    }
}

#[test]
fn a_ball_of_cubes_becomes_round() {
    let mesh = voxels(&cubes(8, |p| p.length() < 3.7));
    let on = told(&mesh, |_, _| 0);
    let ball = Ball { middle: Point::splat(4.0), radius: 3.8 };
    let fitted = fitted(mesh, on, &[0], &ball);
    assert_eq!((fitted.sheets.sheets, fitted.report.taken_back), (1, 0));
    fitted.expect(&ball, 0.6, 0.8);
}

#[test]
fn a_box_in_its_place_stays_perfect() {
    let mesh = voxels(&cubes(3, |_| true));
    let on = told(&mesh, side_of_box);
    let planes: Vec<Shape> = (0..6)
        .map(|s| {
            let axis = Point::AXES[s / 2];
            Shape::Plane(axis * if s % 2 == 1 { 1.0 } else { -1.0 }, if s % 2 == 1 { 3.0 } else { 0.0 })
        })
        .collect();
    let target = Shapes::new(&planes, &on);
    let before = mesh.positions.clone();
    let fitted = fitted(mesh, on, &[0, 1, 2, 3, 4, 5], &target);
    fitted.expect(&target, 1.0 - 1e-12, 1.0 - 1e-12);
    assert!(before.iter().zip(&fitted.mesh.positions).all(|(p, q)| p.distance(*q) < 1e-12));
}

/// Half spaces cut out of a grid of n^3 cubes: the cubes whose middles are inside, and what they stand for.
fn cut(n: i32, planes: &[Shape]) -> (HexMesh, Correspondence) {
    let above = |shape: &Shape, p: Point| match *shape {
        Shape::Plane(normal, d) => normal.dot(p) - d,
        Shape::Cylinder(axis, radius) => ((p - axis) * Point::new(1.0, 1.0, 0.0)).length() - radius,
    };
    let half = f64::from(n) / 2.0;
    let mesh = voxels(&cubes(n, |p| planes.iter().all(|plane| above(plane, p + half) < 0.0)));
    let on = told(&mesh, |middle, _| {
        let nearest = (0..planes.len())
            .max_by(|&a, &b| above(&planes[a], middle).total_cmp(&above(&planes[b], middle)));
        nearest.unwrap() as u32
    });
    (mesh, on)
}

/// The whole way from triangles: a core cut out of cubes, corners and edges found on it, sheets, fit.
#[test]
fn a_box_across_the_grid_keeps_its_edges() {
    let turn = glam::DMat3::from_axis_angle(Point::new(1.0, 2.0, 3.0).normalize(), 0.35);
    let half = Point::new(4.0, 3.5, 4.5);
    let mut surface = PolygonMesh {
        positions: CORNERS
            .map(|c| turn * ((Point::from(c.map(f64::from)) - 0.5) * 2.0 * half) + 7.0)
            .to_vec(),
        ..Default::default()
    };
    FACES.iter().for_each(|face| surface.push_face(face.map(|k| NodeId(u32::from(k)))));
    let (solid, _) = SolidModel::new(&surface, &SolidOptions::default(), &Silent).unwrap();
    let mut mesh =
        core(&voxels(&cubes(14, |_| true)), &solid, &CoreOptions::default(), &Silent).unwrap().mesh;
    let mut on = correspond(&mesh, &solid, &Silent).unwrap();
    let mut sheets = insert_sheets(&mut mesh, &mut on, &solid, &Silent).unwrap();
    let report =
        fit(&mut mesh, &mut on, &mut sheets, &solid, &FitOptions::default(), &Silent).unwrap().0.report;
    let reduction = on.reduction.clone();
    let target = OnSolid::new(&solid, &reduction);
    Fitted { mesh, on, sheets, report }.expect(&target, 0.5, 0.85);
}

#[test]
fn a_cylinder_keeps_its_circles() {
    let shapes =
        [Shape::Plane(-Point::Z, -1.0), Shape::Plane(Point::Z, 7.0), Shape::Cylinder(Point::splat(5.0), 4.2)];
    let (mesh, on) = cut(10, &shapes);
    let target = Shapes::new(&shapes, &on);
    fitted(mesh, on, &[0, 1, 2], &target).expect(&target, 0.4, 0.85);
}

/// A wedge whose two long sides meet at 40 degrees.
#[test]
fn a_sharp_wedge_stays_positive() {
    let slope = 40.0_f64.to_radians();
    let planes = [
        Shape::Plane(-Point::Z, -1.0),
        Shape::Plane(Point::Z, 7.0),
        Shape::Plane(-Point::Y, -1.0),
        Shape::Plane(Point::X, 11.0),
        Shape::Plane(Point::new(-slope.sin(), slope.cos(), 0.0), slope.cos() - 1.2 * slope.sin()),
    ];
    let (mesh, on) = cut(12, &planes);
    let target = Shapes::new(&planes, &on);
    let fitted = fitted(mesh, on, &[0, 1, 2, 3, 4], &target);
    assert!(fitted.report.worst.unwrap() > 0.02 && fitted.report.mean > 0.7, "{:?}", fitted.report);
}

#[test]
fn the_same_bytes_come_of_any_number_of_threads() {
    let fit = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mesh = voxels(&cubes(6, |p| p.length() < 2.9));
            let on = told(&mesh, |_, _| 0);
            let ball = Ball { middle: Point::splat(3.0), radius: 3.0 };
            let bits = |p: &Point| p.to_array().map(f64::to_bits);
            fitted(mesh, on, &[0], &ball).mesh.positions.iter().map(bits).collect::<Vec<_>>()
        })
    };
    let one = fit(1);
    assert!(one == fit(2) && one == fit(4));
}

/// Stops after some questions, and sees that nothing was done.
#[test]
fn a_stopped_fit_leaves_nodes_where_they_were() {
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
    struct After(AtomicUsize);
    impl Monitor for After {
        fn progress(&self, _: Stage, _: f64) {}
        fn cancelled(&self) -> bool {
            self.0.fetch_update(Relaxed, Relaxed, |left| left.checked_sub(1)).is_err()
        }
    }
    let ball = Ball { middle: Point::splat(2.0), radius: 2.2 };
    for questions in [0, 10, 100, 400] {
        let mut mesh = voxels(&cubes(4, |p| p.length() < 2.2));
        let mut on = told(&mesh, |_, _| 0);
        let mut sheets = insert_in_groups(&mut mesh, &mut on, &[0]);
        let before = mesh.positions.clone();
        let monitor = After(AtomicUsize::new(questions));
        let stopped = fit_to(&mut mesh, &mut on, &mut sheets, &ball, &FitOptions::default(), &monitor);
        assert_eq!((stopped, mesh.positions), (Err(Cancelled), before), "{questions}");
    }
}

#[cfg(not(target_arch = "wasm32"))]
mod random {
    use super::*;

    /// Feet anywhere: where a hash of the node's place says, or all in one point.
    struct Anywhere(u64);

    impl Target for Anywhere {
        fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot> {
            let mut state = self.0;
            let mut next = || {
                state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
            };
            let direction = Point::new(next(), next(), next()).normalize_or(Point::X);
            let scale = [0.0, 1.0, 10.0, 1e6, -3.0][self.0 as usize % 5];
            let point = direction * scale + p * f64::from(self.0.is_multiple_of(3));
            (anchor != Anchor::Inside).then_some(Foot { point, direction })
        }
    }

    proptest::proptest! {
        #![proptest_config(proptest::test_runner::Config::with_cases(12))]
        /// Wherever nodes are drawn, no cell is turned over.
        #[test]
        fn no_cell_is_inverted_whatever_the_target(seed in 0u64..1000, wanted in 1u32..(1 << 27)) {
            let mesh = voxels(&cubes(3, |p| {
                let [x, y, z] = (p + 1.0).to_array().map(|c| c.round() as u32);
                wanted >> (9 * x + 3 * y + z) & 1 == 1
            }));
            let on = told(&mesh, |_, normal| side_of_box(normal, normal) % 3);
            fitted(mesh, on, &[0, 1, 2], &Anywhere(seed));
        }
    }
}
