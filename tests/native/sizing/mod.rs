//! Regions met by refined meshes, told from the meshes alone.

use std::f64::consts::PI;

use glam::DQuat;
use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh, QuadMesh};
use hexmill::refine::{QuadOptions, refine_quads};
use hexmill::sizing::{Region, Shape, Target};
use proptest::prelude::*;

/// A bent sheet of 6 by 5 quads, each about 1 long.
fn sheet() -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for j in 0..=5 {
        mesh.positions.extend((0..=6).map(|i| {
            let (x, y) = (f64::from(i), f64::from(j));
            Point::new(x, y + 0.2 * x.sin(), 0.5 * (0.7 * x).cos() + 0.1 * y)
        }));
    }
    for j in 0..5 {
        for i in 0..6 {
            mesh.push_face([(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| NodeId((j + v) * 7 + i + u)));
        }
    }
    mesh
}

/// Part of a pipe of radius 2: 9 facets of 10 degrees, one long.
fn pipe() -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for z in [0.0, 0.35] {
        mesh.positions.extend((0..=9).map(|i| {
            let angle = f64::from(i) * PI / 18.0;
            Point::new(2.0 * angle.cos(), 2.0 * angle.sin(), z)
        }));
    }
    for i in 0..9 {
        mesh.push_face([i, i + 1, i + 11, i + 10].map(NodeId));
    }
    mesh
}

fn corners(mesh: &QuadMesh, q: usize) -> [Point; 4] {
    mesh.quads[q].map(|n| mesh.positions[n.index()])
}

fn longest(corners: [Point; 4]) -> f64 {
    (0..4).map(|i| corners[i].distance(corners[(i + 1) % 4])).fold(0.0, f64::max)
}

/// The mean of a quad's corners, a point of it well away from its edges.
fn middle(corners: [Point; 4]) -> Point {
    corners.iter().sum::<Point>() / 4.0
}

/// How far a point is from a shape, and 0 inside.
type Distance = Box<dyn Fn(Point) -> f64>;

/// Some shapes over the sheet, and how far a point is from them.
fn shapes() -> [(Shape, Distance); 4] {
    let (center, half) = (Point::new(2.3, 2.6, 0.4), Point::new(1.5, 0.4, 2.0));
    let rotation = DQuat::from_xyzw(0.1, 0.0, 0.5, 0.8).normalize();
    let (from, to) = (Point::new(4.0, 4.0, -1.0), Point::new(4.6, 3.4, 2.0));
    let points = vec![Point::new(1.0, 1.0, 0.5), Point::new(5.0, 1.5, -0.2)];
    let box_gap = move |p: Point| ((rotation.inverse() * (p - center)).abs() - half).max(Point::ZERO).length();
    let axis = (to - from).normalize();
    let cylinder_gap = move |p: Point| {
        let along = (p - from.midpoint(to)).dot(axis);
        let across = (p - from.midpoint(to) - axis * along).length();
        (along.abs() - from.distance(to) * 0.5).max(0.0).hypot((across - 0.6).max(0.0))
    };
    let cloud = points.clone();
    let points_gap =
        move |p: Point| cloud.iter().map(|q| (p.distance(*q) - 0.3).max(0.0)).fold(f64::MAX, f64::min);
    [
        (Shape::Box { min: center - half, max: center + half, rotation }, Box::new(box_gap)),
        (
            Shape::Sphere { center, radius: 0.9 },
            Box::new(move |p: Point| (p.distance(center) - 0.9).max(0.0)),
        ),
        (Shape::Cylinder { from, to, radius: 0.6 }, Box::new(cylinder_gap)),
        (Shape::Points { points, radius: 0.3 }, Box::new(points_gap)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn quads_in_a_region_have_its_size_and_grow_away_from_it(size in 0.05..0.4_f64, gradation in 1.2..2.0_f64) {
        for (shape, distance) in shapes() {
            let regions = vec![Region { shape, target: Target::Size(size) }];
            let options = QuadOptions { regions, gradation, ..QuadOptions::default() };
            let refined = refine_quads(&sheet(), &options, &Silent).expect("within limits");
            let mut inside = 0;
            for q in 0..refined.mesh.quads.len() {
                let corners = corners(&refined.mesh, q);
                let gap = distance(middle(corners));
                inside += usize::from(gap == 0.0);
                let target = size + (gradation - 1.0) * gap;
                prop_assert!(longest(corners) <= target * (1.0 + 1e-6), "{} at {gap}", longest(corners));
            }
            prop_assert!(inside > 0);
        }
    }

    #[test]
    fn far_from_a_region_nothing_is_finer_than_balance_makes_it(size in 0.03..0.2_f64) {
        for (shape, distance) in shapes() {
            let regions = vec![Region { shape, target: Target::Size(size) }];
            let options = QuadOptions { regions, ..QuadOptions::default() };
            let refined = refine_quads(&sheet(), &options, &Silent).expect("within limits");
            for q in 0..refined.mesh.quads.len() {
                // All is refined once; beyond a few quads' breadth no more than that.
                if distance(middle(corners(&refined.mesh, q))) > 4.0 {
                    prop_assert!(refined.level[q] <= 1);
                }
            }
        }
    }
}

#[test]
fn levels_count_from_the_input() {
    for (shape, distance) in shapes() {
        let regions = vec![Region { shape, target: Target::Level(4) }];
        let refined =
            refine_quads(&sheet(), &QuadOptions { regions, ..QuadOptions::default() }, &Silent).unwrap();
        assert_eq!(refined.level.iter().max(), Some(&4));
        for q in 0..refined.mesh.quads.len() {
            let inside = distance(middle(corners(&refined.mesh, q))) == 0.0;
            assert!(!inside || refined.level[q] == 4);
        }
    }
}

#[test]
fn a_curved_surface_is_refined_by_the_angle_an_edge_spans() {
    // Facets of 10 degrees are 0.3486 long: two of half that span 5 degrees each, four 2.5.
    for (degrees, level) in [(11.0, 0), (6.0, 1), (3.0, 2)] {
        let options = QuadOptions { curvature: Some(degrees), ..QuadOptions::default() };
        let refined = refine_quads(&pipe(), &options, &Silent).expect("within limits");
        let inner = |q: &usize| (2..7).contains(&refined.parent[*q].0);
        let quads: Vec<usize> = (0..refined.mesh.quads.len()).filter(inner).collect();
        assert!(!quads.is_empty());
        for q in quads {
            assert_eq!(refined.level[q], level, "{degrees} degrees");
        }
    }
}

#[test]
fn a_region_that_ends_at_the_input_edges_refines_nothing_beyond() {
    let mut grid = PolygonMesh::default();
    for j in 0..=4 {
        grid.positions.extend((0..=4).map(|i| Point::new(f64::from(i), f64::from(j), 0.0)));
    }
    for j in 0..4 {
        for i in 0..4 {
            grid.push_face([(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| NodeId((j + v) * 5 + i + u)));
        }
    }
    let shape = Shape::Box {
        min: Point::new(0.0, 0.0, 0.0),
        max: Point::new(2.0, 4.0, 0.0),
        rotation: DQuat::IDENTITY,
    };
    let regions = vec![Region { shape, target: Target::Level(3) }];
    let refined = refine_quads(&grid, &QuadOptions { regions, ..QuadOptions::default() }, &Silent).unwrap();
    let level = |x: f64| {
        let of = |q: usize| middle(corners(&refined.mesh, q)).x;
        (0..refined.mesh.quads.len()).filter(|&q| (of(q) - x).abs() < 0.2).map(|q| refined.level[q]).max()
    };
    assert_eq!(level(1.8), Some(3));
    assert_eq!(level(2.25), Some(2), "a transition from the third level to the second, no more");
    assert_eq!(level(3.75), Some(1));
    let exact = refined.level.iter().filter(|&&l| l == 3).count();
    assert_eq!(exact, 8 * 64, "the region's 8 squares, each 8 by 8");
}
