//! Regions of many shapes: what is promised holds, and cells are good.

use glam::DVec2;
use proptest::prelude::*;

use super::graph::{Graph, Segment};
use super::sample::{SampleError, sample};
use super::*;
use crate::geometry::Point;
use crate::mesh::{NodeId, QuadMesh, check_quads};
use crate::{Cancelled, Monitor, Silent, Stage};

/// Closed curves, around the region and around holes, and inner curves.
fn region(loops: &[Vec<DVec2>], inner: &[Vec<DVec2>]) -> Region {
    let mut region = Region::default();
    let add = |region: &mut Region, curve: &[DVec2]| {
        let first = region.points.len() as u32;
        region.points.extend(curve);
        (first..region.points.len() as u32).collect::<Vec<u32>>()
    };
    for curve in loops {
        let ids = add(&mut region, curve);
        region.outline.extend((0..ids.len()).map(|k| [ids[k], ids[(k + 1) % ids.len()]]));
    }
    for curve in inner {
        let ids = add(&mut region, curve);
        region.inner.push(ids);
    }
    region
}

fn points(coordinates: &[[f64; 2]]) -> Vec<DVec2> {
    coordinates.iter().copied().map(DVec2::from).collect()
}

fn rectangle(a: [f64; 2], b: [f64; 2]) -> Vec<DVec2> {
    points(&[a, [b[0], a[1]], b, [a[0], b[1]]])
}

fn circle(x: f64, y: f64, r: f64, n: usize) -> Vec<DVec2> {
    let at = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        DVec2::new(x + r * libm::cos(angle), y + r * libm::sin(angle))
    };
    (0..n).map(at).collect()
}

fn closed(mut curve: Vec<DVec2>) -> Vec<DVec2> {
    curve.push(curve[0]);
    curve
}

/// A plate of 10 by 6 with three holes and two inner loops.
fn plate() -> Region {
    let holes = [circle(2.0, 2.0, 0.8, 48), circle(8.0, 4.0, 1.1, 48), circle(5.2, 1.3, 0.5, 32)];
    let inner = [closed(circle(4.5, 3.8, 1.0, 48)), closed(rectangle([1.0, 4.0], [2.5, 5.2]))];
    region(&[&[rectangle([0.0, 0.0], [10.0, 6.0])], &holes[..]].concat(), &inner)
}

fn try_meshed(region: &Region, edge_length: f64) -> Result<RegionMesh, FaceError> {
    quad_region(region, &RegionOptions::new(edge_length), &Silent)
}

/// Meshes a region and checks what is promised: a conforming mesh, every quad positive, nodes on curves on them.
fn meshed(region: &Region, edge_length: f64) -> RegionMesh {
    let mesh = try_meshed(region, edge_length).unwrap();
    let positions = mesh.points.iter().map(|p| Point::new(p.x, p.y, 0.0)).collect();
    let quads = mesh.quads.iter().map(|quad| quad.map(NodeId)).collect();
    assert_eq!(check_quads(&QuadMesh { positions, quads }), []);
    assert!(mesh.worst > 0.0, "{}", mesh.worst);
    mesh
}

/// How far nodes on curves are from all curves of the region, at most.
fn farthest_off(region: &Region, mesh: &RegionMesh) -> f64 {
    let inner = region.inner.iter().flat_map(|curve| curve.windows(2)).map(|w| [w[0], w[1]]);
    let segments: Vec<[u32; 2]> = region.outline.iter().copied().chain(inner).collect();
    let off = |p: DVec2| {
        let to = |s: &[u32; 2]| {
            let [a, b] = s.map(|n| region.points[n as usize]);
            a.lerp(b, ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0)).distance(p)
        };
        segments.iter().map(to).fold(f64::INFINITY, f64::min)
    };
    let on_curve = mesh.points.iter().zip(&mesh.on_curve).filter(|(_, on)| **on);
    on_curve.map(|(p, _)| off(*p)).fold(0.0, f64::max)
}

/// The area of the quads.
fn area(mesh: &RegionMesh) -> f64 {
    let of = |quad: &[u32; 4]| {
        let [a, b, c, d] = quad.map(|n| mesh.points[n as usize]);
        0.5 * (c - a).perp_dot(d - b)
    };
    mesh.quads.iter().map(of).sum()
}

#[test]
fn rectangles_become_grids() {
    for (size, n, count) in [([1.0, 1.0], 6.0, 36), ([1.0, 1.0], 24.0, 576), ([1.0, 0.73], 24.0, 24 * 18)] {
        let mesh = meshed(&region(&[rectangle([0.0, 0.0], size)], &[]), 1.0 / n);
        assert_eq!(mesh.quads.len(), count);
        assert!(mesh.worst > 0.999_999, "{}", mesh.worst);
        assert!((area(&mesh) - size[0] * size[1]).abs() < 1e-12);
    }
}

#[test]
fn an_edge_length_beyond_the_region_gives_the_coarsest_mesh() {
    let square = region(&[rectangle([0.0, 0.0], [1.0, 1.0])], &[]);
    assert_eq!(meshed(&square, 1e6).quads.len(), 4);
    let triangle = region(&[points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])], &[]);
    assert_eq!(meshed(&triangle, 1e6).quads.len(), 3);
}

#[test]
fn disks_and_corners_are_good() {
    let corner = points(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    let shapes = [
        (region(&[circle(0.0, 0.0, 1.0, 96)], &[]), 12.0, 0.4, 0.9),
        (region(&[circle(0.0, 0.0, 1.0, 96)], &[]), 24.0, 0.7, 0.95),
        (region(std::slice::from_ref(&corner), &[]), 12.0, 0.999, 0.999),
        (region(&[corner], &[]), 7.0, 0.6, 0.95),
        (region(&[points(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1.7]])], &[]), 16.0, 0.7, 0.93),
    ];
    for (shape, n, worst, mean) in shapes {
        let mesh = meshed(&shape, 2.0 / n);
        assert!(mesh.worst > worst && mesh.mean > mean, "{n}: {} {}", mesh.worst, mesh.mean);
    }
}

#[test]
fn a_plate_with_holes_and_loops_beats_recombination() {
    // Recombined by gmsh, such a plate has a least scaled Jacobian of 0.24 to 0.71 and a mean of 0.91 to 0.94.
    for (n, worst, mean) in [(24.0, 0.35, 0.91), (48.0, 0.5, 0.95)] {
        let (plate, edge_length) = (plate(), 10.0 / n);
        let mesh = meshed(&plate, edge_length);
        assert!(mesh.worst > worst && mesh.mean > mean, "{n}: {} {}", mesh.worst, mesh.mean);
        assert_eq!((mesh.off_curve.len(), mesh.dropped.len()), (0, 0));
        assert!(farthest_off(&plate, &mesh) < 1e-9 * edge_length);
        // Of the four corners of the outline and of the inner rectangle, each is a node.
        for corner in plate.points[..4].iter().chain(&plate.points[plate.points.len() - 5..]) {
            assert!(mesh.points.iter().any(|p| p.distance(*corner) < 1e-9));
        }
    }
}

#[test]
fn thin_regions_are_meshed() {
    let ring = region(&[circle(0.0, 0.0, 1.0, 96), circle(0.0, 0.0, 0.93, 96)], &[]);
    let sliver = region(&[points(&[[0.0, 0.0], [10.0, 0.0], [10.0, 0.3]])], &[]);
    let slot = region(&[rectangle([0.0, 0.0], [4.0, 1.0]), rectangle([0.001, 0.2], [3.999, 0.8])], &[]);
    for (shape, edge_lengths) in
        [(ring, [0.3, 0.1, 0.04]), (sliver, [2.0, 0.5, 0.1]), (slot, [1.0, 0.3, 0.1])]
    {
        for edge_length in edge_lengths {
            meshed(&shape, edge_length);
        }
    }
}

#[test]
fn curves_that_cross_touch_or_run_along_others_are_laid_in() {
    let square = rectangle([0.0, 0.0], [1.0, 1.0]);
    let cross = [points(&[[0.2, 0.5], [0.8, 0.5]]), points(&[[0.5, 0.1], [0.5, 1.4]])];
    let region = region(&[square], &[&cross[..], &[points(&[[-0.5, 0.0], [1.5, 0.001]])]].concat());
    let mesh = meshed(&region, 0.05);
    let has = |x, y| mesh.points.iter().any(|p| p.distance(DVec2::new(x, y)) < 1e-9);
    // Ends inside, the crossing, and where the second curve leaves the region.
    assert!(has(0.2, 0.5) && has(0.8, 0.5) && has(0.5, 0.1) && has(0.5, 0.5) && has(0.5, 1.0));
    assert!((area(&mesh) - 1.0).abs() < 1e-12);
}

#[test]
fn turned_scaled_and_far_regions_are_meshed_alike() {
    let plate = plate();
    let plain = meshed(&plate, 10.0 / 24.0);
    for (scale, shift) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e6)] {
        let points = plate.points.iter().map(|p| *p * scale + DVec2::splat(shift)).collect();
        let mesh = meshed(&Region { points, ..plate.clone() }, scale * 10.0 / 24.0);
        assert!((mesh.mean - plain.mean).abs() < 0.02 && mesh.worst > 0.3, "{scale}: {}", mesh.worst);
    }
    for degrees in [1.0_f64, 30.0, 45.0, 77.0] {
        let (sine, cosine) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        let points = plate.points.iter().map(|p| DVec2::new(cosine, sine).rotate(*p)).collect();
        let mesh = meshed(&Region { points, ..plate.clone() }, 10.0 / 24.0);
        assert!((mesh.mean - plain.mean).abs() < 0.03 && mesh.worst > 0.25, "{degrees}: {}", mesh.worst);
    }
}

#[test]
fn the_same_region_gives_the_same_mesh() {
    let (a, b) = (meshed(&plate(), 0.3), meshed(&plate(), 0.3));
    assert_eq!(a, b);
}

#[test]
fn what_cannot_be_meshed_is_refused() {
    let square = region(&[rectangle([0.0, 0.0], [1.0, 1.0])], &[]);
    let code = |region: &Region, edge_length| try_meshed(region, edge_length).unwrap_err().code();
    for edge_length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(code(&square, edge_length), "edge-length-out-of-range");
    }
    assert_eq!(code(&square, 1e-5), "too-many-quads");
    assert_eq!(code(&square, 1e-300), "too-few-digits");
    assert_eq!(code(&Region::default(), 1.0), "region-empty");
    let line = region(&[points(&[[0.0, 0.0], [1.0, 0.0]])], &[]);
    assert!(["region-empty", "outline-crosses-itself"].contains(&code(&line, 1.0)));
    let mut open = square.clone();
    open.outline.pop();
    assert_eq!(code(&open, 0.1), "outline-open");
    let bow = region(&[points(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])], &[]);
    assert_eq!(code(&bow, 0.1), "outline-crosses-itself");
    let mut broken = square;
    broken.points[2].x = f64::NAN;
    assert_eq!(code(&broken, 0.1), "region-not-finite");
}

/// Two squares that nearly meet in a corner each, or do, and each with a node of its own there.
#[test]
fn nodes_at_one_place_are_too_close() {
    let mesh = |gap: f64| {
        let mut graph = Graph::default();
        for corner in [0.0, 4.0 + gap] {
            let square = rectangle([corner; 2], [corner + 4.0; 2]);
            let nodes: Vec<u32> = square.into_iter().map(|point| graph.add(point, true)).collect();
            let ends = (0..4).map(|k| [nodes[k], nodes[(k + 1) % 4]]);
            graph.segments.extend(ends.map(|ends| Segment { ends, outline: true }));
        }
        mesher::mesh(&sample(&graph, &graph.arcs(), true, &Silent)?, 32.0, &Silent)
    };
    assert_eq!(mesh(0.5).unwrap().cells.len(), 128);
    assert!(matches!(mesh(0.0), Err(FaceError::TooClose)));
}

/// A square with two bows across it that are hardly apart, the upper one with a node on it.
#[test]
fn of_curves_that_cannot_be_told_apart_the_shortest_is_given_up() {
    const POINTS: u32 = 2000;
    let mut graph = Graph::default();
    let square = [[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]];
    let corners = square.map(|p| graph.add(p.into(), false));
    let mut bow = |rise: f64, node: u32| -> Vec<u32> {
        let at = |k: u32| 8.0 * f64::from(k) / f64::from(POINTS);
        let place = |x: f64| DVec2::new(x, 4.0 + rise + libm::sin(x * std::f64::consts::PI / 8.0));
        (0..=POINTS).map(|k| graph.add(place(at(k)), k == node)).collect()
    };
    let [lower, upper] = [bow(0.0, POINTS), bow(1e-6, POINTS / 3)];
    let mut lay = |nodes: &[u32], outline: bool| {
        let ends = nodes.windows(2).map(|pair| [pair[0], pair[1]]);
        graph.segments.extend(ends.map(|ends| Segment { ends, outline }));
    };
    let [a, b, c, d] = corners;
    let last = POINTS as usize;
    lay(&[a, b, lower[last], upper[last], c, d, upper[0], lower[0], a], true);
    lay(&lower, false);
    lay(&upper, false);
    let arcs = graph.arcs();
    let Err(SampleError::Crowded(crowded)) = sample(&graph, &arcs, true, &Silent) else {
        panic!("too close")
    };
    let crowded: Vec<_> = crowded.into_iter().map(|arc| arcs[arc].clone()).collect();
    assert_eq!(relax::part(&mut graph, &crowded), 2, "the shorter part, and what ends in it");
    let inner = |graph: &Graph| graph.segments.iter().filter(|s| !s.outline).map(|s| s.ends[0]).collect();
    let left: Vec<u32> = inner(&graph);
    assert_eq!(left, lower[..last]);
    assert!(sample(&graph, &graph.arcs(), true, &Silent).is_ok());
    let outline: Vec<_> = graph.arcs().into_iter().filter(|arc| arc.outline).collect();
    assert_eq!(relax::part(&mut graph, &outline), 0);
}

/// Says stop after so many questions.
struct Patience(std::sync::atomic::AtomicUsize);

impl Monitor for Patience {
    fn progress(&self, _: Stage, _: f64) {}
    fn cancelled(&self) -> bool {
        let less = |left: usize| left.checked_sub(1);
        use std::sync::atomic::Ordering::Relaxed;
        self.0.fetch_update(Relaxed, Relaxed, less).is_err()
    }
}

#[test]
fn work_stops_when_asked_to() {
    let options = RegionOptions::new(0.1);
    for questions in [0, 1, 5, 20, 50] {
        let stopped = quad_region(&plate(), &options, &Patience(questions.into()));
        assert_eq!(stopped, Err(FaceError::Cancelled(Cancelled)), "{questions}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn random_polygons_with_holes_are_meshed(
        radii in prop::collection::vec(0.6_f64..1.4, 5..14),
        holes in prop::collection::vec((0.0_f64..0.24, 3_usize..16), 0..3),
        curve in prop::collection::vec((-1.2_f64..1.2, -1.2_f64..1.2), 0..4),
        edge_length in 0.04_f64..0.6,
    ) {
        let n = radii.len();
        let outer = circle(0.0, 0.0, 1.0, n).into_iter().zip(&radii).map(|(p, r)| p * *r).collect();
        let hole = |(k, &(r, n)): (usize, &(f64, usize))| circle(0.25 - 0.5 * k as f64, 0.03, r.max(0.02), n);
        let loops = [vec![outer], holes.iter().enumerate().map(hole).collect()].concat();
        let inner: Vec<DVec2> = curve.into_iter().map(DVec2::from).collect();
        let inner = if inner.len() > 1 { vec![inner] } else { Vec::new() };
        let shape = region(&loops, &inner);
        match try_meshed(&shape, edge_length) {
            Ok(_) => { meshed(&shape, edge_length); }
            // A hole may reach over a notch of the outline.
            Err(error) => prop_assert_eq!(error.code(), "outline-crosses-itself"),
        }
    }
}
