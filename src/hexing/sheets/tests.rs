use super::need::CurveEdge;
use super::testing::{cubes, side_of_box, told, voxels};
use super::*;
use crate::Silent;
use crate::geometry::Point;
use crate::hexing::correspondence::Anchor;
use crate::mesh::PolygonMesh;
use crate::mesh::check::{Defect, check_hexes};
use crate::mesh::topology::{HexTopology, hex_boundary, hex_report};
use crate::solid::{CornerId, CurveId, SolidOptions, SurfaceId};

/// Euler characteristic of a mesh that has to be conforming, a manifold and without loose nodes.
pub(super) fn euler(mesh: &HexMesh) -> i64 {
    euler_but(mesh, |_| false)
}

/// The same of one whose new cells draw back from one side alone: not fitted yet they are folded, and nodes lie in the faces
/// of such. `assert_true` sees if a face hangs.
pub(super) fn euler_of_folds(mesh: &HexMesh) -> i64 {
    euler_but(mesh, |defect| matches!(defect, Defect::HangingNodeInFace { .. }))
}

fn euler_but(mesh: &HexMesh, allowed: impl Fn(&Defect) -> bool) -> i64 {
    let allowed = |defect: &Defect| matches!(defect, Defect::InvertedHex { .. }) || allowed(defect);
    let defects: Vec<Defect> = check_hexes(mesh).into_iter().filter(|d| !allowed(d)).collect();
    assert_eq!(defects, []);
    let report = hex_report(&HexTopology::of(mesh));
    assert!(report.is_manifold(), "{report:?}");
    report.euler
}

/// What has to be true of a correspondence for a mesh.
pub(super) fn assert_true(mesh: &HexMesh, on: &Correspondence) {
    let boundary: Vec<[NodeId; 4]> = hex_boundary(&mesh.hexes).into_iter().map(|(quad, _)| quad).collect();
    assert_eq!(boundary, on.quads());
    assert_eq!(on.anchors.len(), mesh.positions.len());
    assert!(on.edges.is_sorted());
    // Edges between surfaces are those on curves, and nothing else is.
    let again = labelled(mesh, on);
    let ends = |on: &Correspondence| on.edges.iter().map(|&(ends, _)| ends).collect::<Vec<_>>();
    assert_eq!(ends(&again), ends(on));
    for (n, (now, told)) in on.anchors.iter().zip(&again.anchors).enumerate() {
        match (now, told) {
            (Anchor::Surface(a), Anchor::Surface(b)) => assert_eq!(a, b),
            _ => assert_eq!(now.freedom(), told.freedom(), "node {n}: {now:?} {told:?}"),
        }
    }
    for (ends, curve) in &on.edges {
        for n in ends {
            match on.anchors[n.index()] {
                Anchor::Curve(c) => assert_eq!(c, *curve),
                anchor => assert!(matches!(anchor, Anchor::Corner(_)), "{anchor:?}"),
            }
        }
    }
}

/// The correspondence that the surfaces of the faces make, with curves and corners numbered anew.
fn labelled(mesh: &HexMesh, on: &Correspondence) -> Correspondence {
    // `told` sees faces by their order.
    let next = std::cell::Cell::new(0);
    told(mesh, |_, _| {
        let surface = on.faces[next.get()].1;
        next.set(next.get() + 1);
        surface.0
    })
}

struct Case {
    mesh: HexMesh,
    on: Correspondence,
    report: SheetReport,
}

/// Inserts sheets, and takes them back once to see that everything is as before.
fn inserted(mesh: HexMesh, on: Correspondence, groups: &Groups) -> Case {
    let before = (mesh.clone(), on.clone(), euler(&mesh));
    assert_true(&mesh, &on);
    let (mut mesh, mut on) = (mesh, on);
    let report = insert(&mut mesh, &mut on, groups.clone(), &Silent).unwrap();
    let after = if report.wedges > 0 { euler_of_folds(&mesh) } else { euler(&mesh) };
    assert_eq!(after, before.2);
    assert_true(&mesh, &on);
    assert_eq!(report.hexes, mesh.hexes.len() - before.0.hexes.len());
    assert_eq!(on.anchors[..before.1.anchors.len()], before.1.anchors, "old nodes stay what they were");
    assert_eq!(mesh.positions[..before.0.positions.len()], before.0.positions);
    let (mut undone, mut undone_on, mut left) = (mesh.clone(), on.clone(), report.clone());
    while left.take_back(&mut undone, &mut undone_on) {
        assert_true(&undone, &undone_on);
    }
    assert_eq!((undone, undone_on), (before.0, before.1));
    assert_eq!((left.sheets, left.wedges, left.collars, left.hexes), (0, 0, 0, 0));
    // Nobody needs anything any more.
    let look = (Boundary::of(&mesh, &on), &on);
    let look = Look::new(&mesh, look.1, &look.0, &report.groups);
    assert!(look.needs().iter().all(|&needs| !needs) || !report.pinched.is_empty());
    assert_eq!(look.flat_corners().is_empty(), report.flat.is_empty());
    Case { mesh, on, report }
}

/// Each surface a group of its own, no curve flat.
pub(super) fn apart(surfaces: u32, curves: usize) -> Groups {
    Groups::given(&(0..surfaces).collect::<Vec<_>>(), &vec![false; curves])
}

#[test]
fn a_smooth_ball_gets_one_sheet_all_over() {
    let mesh = voxels(&cubes(6, |p| p.length() < 2.9));
    let on = told(&mesh, |_, _| 0);
    let (hexes, quads, nodes) = (mesh.hexes.len(), on.faces.len(), mesh.positions.len());
    let Case { mesh, on, report } = inserted(mesh, on, &apart(1, 0));
    assert_eq!((report.sheets, report.collars, report.hexes), (1, 0, quads));
    assert_eq!(mesh.hexes.len(), hexes + quads);
    assert_eq!(on.faces.len(), quads);
    // A closed surface of quads has two more nodes than quads, and each was copied.
    assert_eq!(mesh.positions.len(), nodes + quads + 2);
    assert!(on.anchors[nodes..].iter().all(|&anchor| anchor == Anchor::Inside));
}

#[test]
fn a_box_that_fits_needs_no_sheet() {
    let mesh = voxels(&cubes(3, |_| true));
    let on = told(&mesh, side_of_box);
    assert_eq!(on.edges.len(), 36);
    let Case { report, .. } = inserted(mesh, on, &apart(6, 12));
    assert!(report.is_empty() && report.pinched.is_empty() && report.flat.is_empty(), "{report:?}");
}

/// Of a cylinder the wall alone: the sheet ends at the circles and adds a ring of quads to both ends.
#[test]
fn a_cylinder_gets_a_sheet_around() {
    let mesh = voxels(&cubes(6, |p| p.truncate().length() < 2.9));
    let wall = |_: Point, normal: Point| {
        if normal.z > 0.5 { 2 } else { u32::from(normal.z > -0.5) }
    };
    let on = told(&mesh, wall);
    let count = |on: &Correspondence, s: u32| on.faces.iter().filter(|f| f.1 == SurfaceId(s)).count();
    let (ends, around) = (count(&on, 0), count(&on, 1) / 6);
    let Case { on, report, .. } = inserted(mesh, on, &apart(3, 2));
    assert_eq!((report.sheets, report.collars, report.hexes), (1, 0, 6 * around));
    assert_eq!([0, 1, 2].map(|s| count(&on, s)), [ends + around, 6 * around, ends + around]);
    assert_eq!(on.edges.len(), 2 * around, "the circles have as many edges as before");
}

/// A round boss on a plate: the wall and the plate's top meet at a concave circle and get one sheet, and at each place
/// where the circle of cubes turns outwards the plate's quad there a collar.
#[test]
fn a_boss_gets_collars_at_its_foot() {
    let mesh = voxels(&cubes(8, |p| p.z < -2.0 || p.z < 2.0 && p.truncate().length() < 2.9));
    let place = |middle: Point, normal: Point| match side_of_box(middle, normal) {
        side if (middle.x - 4.0).abs().max((middle.y - 4.0).abs()) > 3.9 => side,
        5 if middle.z > 3.0 => 6,
        side @ (4 | 5) => side,
        _ => 7,
    };
    let on = told(&mesh, place);
    // Surfaces 5, the plate's top, and 7, the wall, are one group; the circle between them is flat.
    let foot = on.edges.iter().find(|(ends, _)| {
        ends.iter().all(|n| mesh.positions[n.index()].z == 2.0)
            && ends.iter().all(|n| (mesh.positions[n.index()].truncate() - 4.0).abs().max_element() < 4.0)
    });
    let curves = on.edges.iter().map(|&(_, curve)| curve.index() + 1).max().unwrap();
    let mut is_flat = vec![false; curves];
    is_flat[foot.unwrap().1.index()] = true;
    let groups = Groups::given(&[0, 1, 2, 3, 4, 5, 6, 5], &is_flat);
    let Case { report, .. } = inserted(mesh, on, &groups);
    assert_eq!((report.sheets, report.flat.len(), report.pinched.len()), (1, 0, 0), "{report:?}");
    assert!(report.collars > 0 && report.collars <= 8, "{report:?}");
}

/// A box whose top has a crease that crosses its cubes in steps: at every step a quad on each side of it has two edges
/// there. What its surfaces' groups are, and which curve the crease is.
fn creased(slope: f64) -> (HexMesh, Correspondence, Groups, CurveId) {
    let mesh = voxels(&cubes(8, |_| true));
    let on = told(&mesh, |p, normal| match side_of_box(p, normal) {
        5 => 5 + u32::from(p.y - 3.0 > slope * (p.x - 3.0)),
        side => side,
    });
    let is_inside = |n: &NodeId| {
        let p = mesh.positions[n.index()];
        p.z == 8.0 && (p.truncate() - 4.0).abs().max_element() < 4.0
    };
    let crease = on.edges.iter().find(|(ends, _)| ends.iter().all(is_inside)).unwrap().1;
    let mut is_flat = vec![false; on.edges.iter().map(|&(_, curve)| curve.index() + 1).max().unwrap()];
    is_flat[crease.index()] = true;
    (mesh, on, Groups::given(&[0, 1, 2, 3, 4, 5, 5], &is_flat), crease)
}

#[test]
fn a_crease_in_steps_gets_collars_on_both_sides() {
    for slope in [0.25, 0.5, 1.0] {
        let (mesh, on, groups, crease) = creased(slope);
        let Case { on, report, .. } = inserted(mesh, on, &groups);
        assert_eq!((report.sheets, report.flat.len()), (0, 0), "{report:?}");
        assert!(report.collars >= 2, "{report:?}");
        // At most three quads on each side.
        let quads_at = |n: usize| on.faces.iter().filter(|(quad, _)| quad.contains(&NodeId::new(n))).count();
        let on_crease = (0..on.anchors.len()).filter(|&n| on.anchors[n] == Anchor::Curve(crease));
        assert!(on_crease.map(quads_at).all(|count| (4..=6).contains(&count)));
    }
}

/// A ball of eight surfaces: at each of its six corners four meet, and a sheet over one or three of them would be pinched.
#[test]
fn where_four_surfaces_meet_a_sheet_lies_over_two() {
    let mesh = voxels(&cubes(6, |p| p.length() < 2.9));
    let octant = |p: Point, _: Point| (0..3).map(|k| u32::from(p[k] > 3.0) << k).sum();
    let on = told(&mesh, octant);
    let corners = on.anchors.iter().filter(|anchor| matches!(anchor, Anchor::Corner(_))).count();
    let groups = apart(8, 12);
    let Case { report, .. } = inserted(mesh.clone(), on.clone(), &groups);
    assert!(corners == 6 && report.sheets > 0 && report.pinched.is_empty(), "{report:?}");
    // Those that were left out find no partner.
    let (mut left_mesh, mut left_on) = (mesh, on);
    let mut left = insert(&mut left_mesh, &mut left_on, groups, &Silent).unwrap();
    let sheets: Vec<usize> = (0..left.len()).filter(|&layer| left.is_sheet(layer)).collect();
    left.leave_out(&mut left_mesh, &mut left_on, &sheets, &Silent).unwrap();
    assert!(left.sheets < report.sheets, "{left:?}");
}

/// Of those beside it the one that has no sheet yet, then that which it meets most flatly.
#[test]
fn the_partner_is_the_flattest_without_a_sheet() {
    let mesh = voxels(&cubes(4, |_| true));
    let on = told(&mesh, side_of_box);
    let boundary = Boundary::of(&mesh, &on);
    let of_sides = |a: u32, b: u32| {
        let is_between = |edge: &&CurveEdge| {
            let [p, q] = edge.quads.map(|quad| boundary.surface[quad as usize].0);
            [p, q] == [a, b] || [q, p] == [a, b]
        };
        Look::new(&mesh, &on, &boundary, &apart(6, 12)).curve_edges().iter().find(is_between).unwrap().curve
    };
    // From the side 0 the sides 2 and 5 are across a flat curve.
    let mut is_flat = vec![false; 12];
    [2, 5].into_iter().for_each(|side| is_flat[of_sides(0, side).index()] = true);
    let groups = Groups::given(&[0, 1, 2, 3, 4, 5], &is_flat);
    let look = Look::new(&mesh, &on, &boundary, &groups);
    let node = |p: Point| NodeId::new(mesh.positions.iter().position(|&q| q == p).unwrap());
    let corners = [Point::ZERO, Point::new(0.0, 4.0, 4.0)].map(node);
    let partner = |takes: &[u32], has_none: &[u32]| {
        unite::partner(&look, 0, &corners, |g| takes.contains(&g), |g| has_none.contains(&g))
    };
    assert_eq!(partner(&[1, 2, 3, 4, 5], &[1, 2, 3, 4, 5]), Some(2));
    assert_eq!(partner(&[1, 3, 4, 5], &[1, 3, 4, 5]), Some(5));
    assert_eq!(partner(&[2, 3, 4, 5], &[3, 4]), Some(3));
    assert_eq!((partner(&[1], &[1]), partner(&[], &[])), (None, None));
}

/// What is left out is not inserted again, all else is, and the mesh is as good as any.
#[test]
fn collars_are_left_out_one_by_one() {
    let (core, on_core, groups, _) = creased(0.25);
    let (mut mesh, mut on) = (core.clone(), on_core.clone());
    let mut report = insert(&mut mesh, &mut on, groups, &Silent).unwrap();
    let mut left = report.collars;
    assert!(left > 2, "{report:?}");
    let mut flat = Vec::new();
    while left > 0 {
        // The first is taken, on which the numbers of all other nodes depend.
        report.leave_out(&mut mesh, &mut on, &[0], &Silent).unwrap();
        assert_eq!((report.collars, report.sheets, report.wedges), (left - 1, 0, 0));
        assert_eq!(report.hexes, mesh.hexes.len() - core.hexes.len());
        assert_eq!(euler(&mesh), 1);
        assert_true(&mesh, &on);
        assert!(flat.iter().all(|n| report.flat.contains(n)) && report.flat.len() > flat.len(), "{report:?}");
        (left, flat) = (report.collars, report.flat.clone());
    }
    assert_eq!((mesh, on), (core, on_core));
}

#[test]
fn sheets_and_wedges_are_left_out() {
    let (core, on_core, groups) = upright_edge();
    let (mut mesh, mut on) = (core.clone(), on_core.clone());
    let mut report = insert(&mut mesh, &mut on, groups, &Silent).unwrap();
    assert_eq!((report.sheets, report.wedges), (1, 1));
    report.leave_out(&mut mesh, &mut on, &[report.len() - 1], &Silent).unwrap();
    assert_eq!((report.sheets, report.wedges), (1, 0));
    assert_eq!(euler(&mesh), 1);
    assert_true(&mesh, &on);
    report.leave_out(&mut mesh, &mut on, &[0], &Silent).unwrap();
    assert_eq!((report.sheets, report.wedges), (0, 0));
}

/// Where this goes on for too long, collars and wedges are left out altogether.
#[test]
fn in_the_end_no_collar_is_inserted() {
    let (core, on_core, groups, _) = creased(0.25);
    let (mut mesh, mut on) = (core.clone(), on_core.clone());
    let mut report = insert(&mut mesh, &mut on, groups, &Silent).unwrap();
    let collars = report.collars;
    let mut rounds = 0;
    while !report.is_empty() {
        assert_eq!(report.collars, collars);
        report.leave_out(&mut mesh, &mut on, &[], &Silent).unwrap();
        rounds += 1;
    }
    assert!(rounds > 2);
    assert_eq!((mesh, on), (core, on_core));
}

/// Cells that touch have one culprit, the last layer at them; far from all layers it is the nearest.
#[test]
fn culprits_are_the_last_layers_at_cells() {
    let (mut mesh, mut on, groups, _) = creased(0.25);
    assert_eq!(SheetReport::default().culprits(&mesh, &[0]), []);
    let core = mesh.hexes.len() as u32;
    let report = insert(&mut mesh, &mut on, groups, &Silent).unwrap();
    let count = mesh.hexes.len() as u32;
    let of_first = report.culprits(&mesh, &[core]);
    assert_eq!(of_first, [(0, vec![core])]);
    // A corner of the box below the first layer's cells, and a cell of the last.
    let corner = mesh.hexes.iter().position(|hex| hex.contains(&NodeId(0))).unwrap() as u32;
    let parts = report.culprits(&mesh, &[corner, count - 1]);
    assert_eq!(parts.len(), 2);
    assert_eq!(parts[0].1, [corner]);
    assert_eq!(parts[1], (report.len() - 1, vec![count - 1]));
    assert_eq!(report.culprits(&mesh, &[core, core + 1]).len(), 1);
}

/// An edge that stands upright on a plate, with flat curves at its foot and at the top, so that the group needs its sheet.
#[test]
fn a_thin_curve_ends_at_flat_ones() {
    let (mesh, on, groups) = upright_edge();
    let Case { report, .. } = inserted(mesh, on, &groups);
    assert_eq!((report.sheets, report.wedges, report.pinched.len()), (1, 1, 0), "{report:?}");
}

fn upright_edge() -> (HexMesh, Correspondence, Groups) {
    let mesh = voxels(&cubes(6, |p| p.z < -1.0 || p.x < 0.0 && p.y < 0.0));
    let is_foot = |a: Point, b: Point| a.z == 2.0 && b.z == 2.0;
    let on = told(&mesh, side_of_box);
    let mut is_flat = vec![false; on.edges.iter().map(|&(_, curve)| curve.index() + 1).max().unwrap()];
    let mut thin = Vec::new();
    for &([a, b], curve) in &on.edges {
        let [a, b] = [a, b].map(|n| mesh.positions[n.index()]);
        is_flat[curve.index()] |= is_foot(a, b);
        if a.truncate() == Point::splat(3.0).truncate() && a.truncate() == b.truncate() {
            thin.push(curve);
        }
    }
    (mesh, on, Groups::given(&[0, 1, 2, 1, 4, 1], &is_flat).with_thin(&thin))
}

/// A surface that touches itself at a node alone cannot be covered.
#[test]
fn a_pinched_sheet_is_refused() {
    let mut mesh = voxels(&cubes(4, |_| true));
    let is_chequered = |p: Point| (p.x < 2.0) == (p.y < 2.0);
    let mut on = told(&mesh, |p, normal| u32::from(normal.z > 0.5 && is_chequered(p)));
    let before = (mesh.clone(), on.clone());
    let mut boundary = Boundary::of(&mesh, &on);
    let quads = quads_of(&boundary, &apart(2, 1), 1);
    let torn = pillow(&mut mesh, &mut on, &mut boundary, &ShrinkSet::Sheet(&quads));
    let middle = mesh.positions.iter().position(|&p| p == Point::new(2.0, 2.0, 4.0)).unwrap();
    assert_eq!(torn, Err(Torn(vec![NodeId::new(middle)])));
    assert_eq!((mesh, on), before);
}

/// The solid over a polygon in the plane z = 0, as high as 1.
fn prism(polygon: &[[f64; 2]]) -> SolidModel {
    let n = polygon.len() as u32;
    let mut surface = PolygonMesh::default();
    for z in [0.0, 1.0] {
        surface.positions.extend(polygon.iter().map(|&[x, y]| Point::new(x, y, z)));
    }
    surface.push_face((0..n).rev().map(NodeId));
    surface.push_face((n..2 * n).map(NodeId));
    for k in 0..n {
        let next = (k + 1) % n;
        surface.push_face([k, next, n + next, n + k].map(NodeId));
    }
    SolidModel::new(&surface, &SolidOptions::default(), &Silent).unwrap().0
}

/// The groups of a prism's surfaces, each with as many surfaces as given, and the surfaces wide at corners.
fn expect_groups(polygon: &[[f64; 2]], sizes: &[usize], wide: usize) {
    let solid = prism(polygon);
    let alone = |s: SurfaceId| s;
    let groups = Groups::with(&solid, alone, |c| c);
    let mut counts = vec![0; groups.bound()];
    (0..groups.bound()).for_each(|s| counts[groups.group(SurfaceId::new(s)) as usize] += 1);
    counts.retain(|&count| count > 0);
    counts.sort_unstable();
    assert_eq!(counts, sizes);
    let corners = (0..solid.corners().len()).map(|c| Anchor::Corner(CornerId::new(c)));
    let is_wide = |&(corner, s): &(Anchor, usize)| groups.is_wide(corner, SurfaceId::new(s));
    let pairs = corners.flat_map(|corner| (0..groups.bound()).map(move |s| (corner, s)));
    assert_eq!(pairs.filter(is_wide).count(), wide);
}

#[test]
fn surfaces_are_grouped_where_they_are_flat_or_concave() {
    expect_groups(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &[1; 6], 0);
    // At the concave edge two walls are one group; both ends have a wide sector there.
    let corner = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    expect_groups(&corner, &[1, 1, 1, 1, 1, 1, 2], 2);
    // A wall with a bend of 36 degrees is one group and flat at both ends of the bend.
    let bend = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.325], [0.0, 2.0]];
    expect_groups(&bend, &[1, 1, 1, 1, 1, 2], 2);
}

#[test]
fn a_monitor_stops_sheets() {
    struct Stopped;
    impl Monitor for Stopped {
        fn progress(&self, _: Stage, _: f64) {}
        fn cancelled(&self) -> bool {
            true
        }
    }
    let mut mesh = voxels(&cubes(3, |_| true));
    let mut on = told(&mesh, |_, _| 0);
    assert_eq!(insert(&mut mesh, &mut on, apart(1, 0), &Stopped), Err(Cancelled));
}

#[cfg(not(target_arch = "wasm32"))]
proptest::proptest! {
    /// Any set of cells, and any part of the boundary: a pillow is refused, or leaves a conforming manifold.
    #[test]
    fn pillows_are_conforming_or_refused(
        chosen in proptest::collection::vec(0u32..54, 1..6),
        is_complement in proptest::bool::ANY,
        is_sheet in proptest::bool::ANY,
        covered in proptest::collection::vec(0u32..54, 0..6),
    ) {
        let mut mesh = voxels(&cubes(3, |_| true));
        let mut on = told(&mesh, side_of_box);
        let before = (mesh.clone(), on.clone());
        let mut boundary = Boundary::of(&mesh, &on);
        let count = if is_sheet { 54 } else { 27 };
        let chosen: Vec<u32> =
            (0..count).filter(|i| chosen.iter().any(|c| c % count == *i) != is_complement).collect();
        let is_chosen = |&q: &u32| chosen.contains(&(boundary.hex(q) as u32));
        let covered: Vec<u32> = (0..54).filter(|q| covered.contains(q)).filter(is_chosen).collect();
        let set = if is_sheet {
            ShrinkSet::Sheet(&chosen)
        } else {
            ShrinkSet::Hexes { hexes: &chosen, covered: &covered }
        };
        match pillow(&mut mesh, &mut on, &mut boundary, &set) {
            Err(torn) => proptest::prop_assert!(!torn.0.is_empty() && (&mesh, &on) == (&before.0, &before.1)),
            Ok(layer) => {
                on.faces = boundary.in_order();
                let euler = if covered.is_empty() { euler(&mesh) } else { euler_of_folds(&mesh) };
                proptest::prop_assert_eq!(euler, 1);
                assert_true(&mesh, &on);
                layer.take_back(&mut mesh, &mut on);
                proptest::prop_assert_eq!((mesh, on), before);
            }
        }
    }
}
