//! Correspondences of small solids with plain cores: the cells of a grid whose centres are inside.

use super::*;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::numbering::hex::apart;
use crate::mesh::{GridOptions, PolygonMesh, hex_grid};
use crate::solid::testing::{cuboid, cylinder, ell, holed, moved, solid, voxels};

/// The cells of a grid of edge length `h` whose centres are inside, and as many more as make a manifold of them.
fn core(solid: &SolidModel, h: f64) -> HexMesh {
    let options = GridOptions { spacing: h, margin: 2.0 * h, fitted: false, max_hexes: 1 << 20 };
    let grid = hex_grid(solid.bounds(), &options).unwrap();
    let center = |hex: &[NodeId; 8]| hex.iter().map(|n| grid.positions[n.index()]).sum::<Point>() / 8.0;
    let mut full: Vec<bool> = grid.hexes.iter().map(|hex| solid.contains(center(hex))).collect();
    while fill_pinches(&grid, &mut full) {}
    let hexes = grid.hexes.iter().zip(full).filter_map(|(hex, full)| full.then_some(*hex)).collect();
    HexMesh { positions: grid.positions.clone(), hexes, ..HexMesh::default() }
}

/// Fills the cells around nodes where full cells, or empty ones, do not hang together by faces.
fn fill_pinches(grid: &HexMesh, full: &mut [bool]) -> bool {
    let mut around: Vec<Vec<(usize, usize)>> = vec![Vec::new(); grid.positions.len()];
    for (h, hex) in grid.hexes.iter().enumerate() {
        (0..8).for_each(|k| around[hex[k].index()].push((k, h)));
    }
    let mut changed = false;
    for cells in around {
        let hangs_together = |kind: bool| {
            let of_kind: Vec<usize> =
                cells.iter().filter(|&&(_, h)| full[h] == kind).map(|&(k, _)| k).collect();
            let mut reached: Vec<usize> = of_kind.first().copied().into_iter().collect();
            let mut at = 0;
            while at < reached.len() {
                let next = |&k: &usize| apart(reached[at], k) == 1 && !reached.contains(&k);
                let more: Vec<usize> = of_kind.iter().copied().filter(next).collect();
                reached.extend(more);
                at += 1;
            }
            reached.len() == of_kind.len()
        };
        if !(hangs_together(true) && hangs_together(false)) {
            cells.iter().for_each(|&(_, h)| full[h] = true);
            changed = true;
        }
    }
    changed
}

/// The correspondence holds all that it promises, and has so many curves captured, contracted and suppressed.
#[track_caller]
fn check(mesh: &HexMesh, solid: &SolidModel, expected: [usize; 3]) -> Correspondence {
    let on = correspond(mesh, solid, &Silent).unwrap();
    assert_eq!(check_correspondence(mesh, solid, &on), []);
    let fates = [CurveFate::Captured, CurveFate::Contracted, CurveFate::Suppressed];
    let counts = fates.map(|fate| on.reduction.count(fate));
    assert_eq!(counts, expected, "{:?}", on.reduction.lost_curves);
    assert_eq!(on.reduction.lost_curves.len(), counts[1] + counts[2]);
    on
}

/// The same surface, turned about a skew axis and scaled.
fn turned(mut surface: PolygonMesh, angle: f64) -> PolygonMesh {
    let turn = glam::DMat3::from_axis_angle(Point::new(0.48, 0.6, 0.64), angle);
    surface.positions.iter_mut().for_each(|p| *p = turn * *p);
    surface
}

/// A pyramid of height 1.5 over a regular polygon of `n` corners on a circle of radius 1.
fn pyramid(n: u32) -> PolygonMesh {
    let mut mesh = cylinder(n);
    let base: Vec<Point> = mesh.positions[..n as usize].to_vec();
    mesh = PolygonMesh { positions: base, ..PolygonMesh::default() };
    mesh.positions.push(Point::new(0.0, 0.0, 1.5));
    mesh.push_face((0..n).rev().map(NodeId));
    for i in 0..n {
        mesh.push_face([i, (i + 1) % n, n].map(NodeId));
    }
    mesh
}

fn corner_nodes(mesh: &HexMesh, on: &Correspondence) -> Vec<(CornerId, Point)> {
    let of_node = |(anchor, p): (&Anchor, &Point)| match anchor {
        Anchor::Corner(corner) => Some((*corner, *p)),
        _ => None,
    };
    on.anchors.iter().zip(&mesh.positions).filter_map(of_node).collect()
}

#[test]
fn an_aligned_box_is_found_where_it_is() {
    let solid = solid(&cuboid([4, 3, 2]));
    let mesh = core(&solid, 0.5);
    assert_eq!(mesh.hexes.len(), 8 * 6 * 4);
    let on = check(&mesh, &solid, [12, 0, 0]);
    for (corner, p) in corner_nodes(&mesh, &on) {
        assert_eq!(p, solid.corners()[corner.index()].point);
    }
    assert_eq!(on.edges.len(), 4 * (8 + 6 + 4));
    for (nodes, surface) in &on.faces {
        let middle = nodes.iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 4.0;
        assert_eq!(on.reduction.nearest_on_surface(&solid, *surface, middle).distance, 0.0);
    }
    let freedom = on.anchors.iter().filter(|a| **a != Anchor::Inside).map(|a| a.freedom());
    assert_eq!(freedom.sum::<usize>(), on.edges.len() - 12 + 2 * (2 * (7 * 5 + 5 * 3 + 7 * 3)));
}

#[test]
fn prisms_keep_all_their_curves() {
    for (surface, h, curves) in [(ell(), 0.2, 18), (holed(), 0.25, 24), (cylinder(24), 0.17, 2)] {
        let solid = solid(&surface);
        check(&core(&solid, h), &solid, [curves, 0, 0]);
    }
}

#[test]
fn a_turned_solid_keeps_all_its_curves() {
    for (surface, curves) in [(cuboid([4, 3, 2]), 12), (ell(), 18), (holed(), 24), (cylinder(24), 2)] {
        for angle in [0.2, 0.5, 0.8] {
            let solid = solid(&turned(surface.clone(), angle));
            let h = solid.bounds().size().max_element() / 16.0;
            check(&core(&solid, h), &solid, [curves, 0, 0]);
        }
    }
}

#[test]
fn crossing_holes_are_kept_apart() {
    let full =
        |[x, y, z]: [i32; 3]| !((2..4).contains(&x) && (2..4).contains(&y) || (3..5).contains(&y) && z == 2);
    let solid = solid(&voxels([6, 6, 5], full));
    let on = check(&core(&solid, 0.5), &solid, [solid.curves().len(), 0, 0]);
    assert_eq!(on.reduction.lost_surfaces, []);
}

#[test]
fn an_apex_has_as_many_edges_as_curves() {
    let four = solid(&pyramid(4));
    check(&core(&four, 0.16), &four, [8, 0, 0]);
    for n in [5, 6] {
        let solid = solid(&pyramid(n));
        let mesh = core(&solid, 0.12);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        assert_eq!(check_correspondence(&mesh, &solid, &on), []);
        // The base is found whole; at the apex curves are given up only for want of edges.
        assert!(on.reduction.count(CurveFate::Captured) >= n as usize + 3, "{:?}", on.reduction.lost_curves);
    }
}

#[test]
fn a_plate_of_one_layer_keeps_both_faces() {
    let solid = solid(&cuboid([6, 5, 1]));
    check(&core(&solid, 1.0), &solid, [12, 0, 0]);
    let solid = crate::solid::testing::solid(&turned(cuboid([6, 5, 1]), 0.3));
    check(&core(&solid, 0.45), &solid, [12, 0, 0]);
}

/// Where cells are wide and low, a curve as short as they are high, or as two layers are together, is one edge, or two.
#[test]
fn a_flat_plate_keeps_its_short_curves() {
    for (layers, height) in [(1, 0.45), (2, 0.1)] {
        let (plate, flat) = (cuboid([6, 5, layers]), |p: Point| p.with_z(height * p.z));
        let mut mesh = core(&solid(&plate), 1.0);
        mesh.positions.iter_mut().for_each(|p| *p = flat(*p));
        check(&mesh, &solid(&moved(plate, flat)), [12, 0, 0]);
    }
}

/// Curves that are given up later, one after the other, leave a correspondence that holds what it promises.
#[test]
fn captured_curves_can_be_given_up() {
    for (surface, h) in [(ell(), 0.2), (holed(), 0.25), (cylinder(24), 0.17), (pyramid(4), 0.16)] {
        let solid = solid(&surface);
        let mesh = core(&solid, h);
        let mut on = correspond(&mesh, &solid, &Silent).unwrap();
        for curve in (0..solid.curves().len()).map(crate::solid::CurveId::new) {
            on.give_up(&solid, curve, Reason::Costly);
            assert_eq!(check_correspondence(&mesh, &solid, &on), [], "{curve:?}");
        }
        assert_eq!((on.edges.len(), on.reduction.count(CurveFate::Captured)), (0, 0));
        let lost = &on.reduction.lost_curves;
        assert!(lost.is_sorted_by_key(|lost| lost.curve) && lost.iter().all(|l| l.reason == Reason::Costly));
        assert!(on.anchors.iter().all(|anchor| matches!(anchor, Anchor::Inside | Anchor::Surface(_))));
    }
}

/// A plate of 12 x 12 x 3 with unit quads, and its top lower by `depth` where that `is_low`.
fn stepped(depth: f64, is_low: impl Fn(i32, i32) -> bool) -> PolygonMesh {
    moved(voxels([12, 12, 3], |[x, y, z]| z < 2 || !is_low(x, y)), |p| {
        p.with_z([0.0, 1.5, 3.0 - depth, 3.0][p.z as usize])
    })
}

#[test]
fn steps_far_lower_than_edges_are_given_up() {
    let pocket = |x: i32, y: i32| (4..8).contains(&x) && (3..9).contains(&y);
    // Of the pocket top, foot and what joins them; of the ledge top and foot, and two ends that join the plate's rim.
    for (is_low, counts) in [(&pocket as &dyn Fn(i32, i32) -> bool, [12, 4, 8]), (&|x, _| x < 4, [14, 2, 2])]
    {
        let low = solid(&stepped(0.1, is_low));
        let on = check(&core(&low, 1.0), &low, counts);
        assert!(on.reduction.lost_curves.iter().all(|lost| lost.reason == Reason::Low));
        assert_eq!(on.reduction.lost_surfaces, []);
        let high = solid(&stepped(1.0, is_low));
        check(&core(&high, 1.0), &high, [high.curves().len(), 0, 0]);
    }
}

/// The angles of quads at the solid's corners in degrees, if those between two arms share theirs evenly.
fn shares(solid: &SolidModel, on: &Correspondence) -> Vec<f64> {
    let mut shares = Vec::new();
    for (node, anchor) in on.anchors.iter().enumerate() {
        let Anchor::Corner(corner) = anchor else { continue };
        for arm in &solid.corners()[corner.index()].arms {
            let surface = solid.curves()[arm.curve.index()].sides[usize::from(!arm.at_start)];
            let is_there =
                |(quad, on): &&([NodeId; 4], SurfaceId)| *on == surface && quad.contains(&NodeId::new(node));
            shares.push(arm.sector.to_degrees() / on.faces.iter().filter(is_there).count() as f64);
        }
    }
    shares
}

/// Of the nodes near a corner one would do as well otherwise, but has two quads where there is room for one.
#[test]
fn corners_have_as_many_quads_as_their_angles_have_room_for() {
    for angle in [0.2, 0.5] {
        let solid = solid(&turned(pyramid(3), angle));
        let mesh = core(&solid, solid.bounds().size().max_element() / 12.0);
        let shares = shares(&solid, &correspond(&mesh, &solid, &Silent).unwrap());
        assert_eq!(shares.len(), 12);
        assert!(shares.iter().all(|&share| share > 35.0), "{shares:?}");
    }
}
