use super::super::testing::{cubes, side_of_box, told, voxels};
use super::super::tests::{apart, assert_true, euler, euler_of_folds};
use super::*;
use crate::Silent;
use crate::geometry::Point;

/// A mesh with a sheet over some surfaces, and wedges at the thin curves between them.
struct Wedged {
    mesh: HexMesh,
    on: Correspondence,
    boundary: Boundary,
    groups: Groups,
    wedges: usize,
}

impl Wedged {
    /// Covers these surfaces with a sheet and inserts wedges. Each edge on a thin curve between them then has one hex; what is
    /// taken back leaves nothing.
    fn new(mut mesh: HexMesh, mut on: Correspondence, groups: Groups, surfaces: &[u32]) -> Self {
        let mut boundary = Boundary::of(&mesh, &on);
        let quads: Vec<u32> =
            (0..).zip(&boundary.surface).filter(|(_, s)| surfaces.contains(&s.0)).map(|(q, _)| q).collect();
        pillow(&mut mesh, &mut on, &mut boundary, &ShrinkSet::Sheet(&quads)).unwrap();
        on.faces = boundary.in_order();
        let mut layers = Layers::default();
        let mut wedged = Self { mesh, on, boundary, groups, wedges: 0 };
        let hexes = |wedged: &Self| wedged.hexes_at(|edge| wedged.groups.is_thin(edge.curve));
        assert!(hexes(&wedged).iter().all(|&hexes| hexes == 2));
        let before = (wedged.mesh.clone(), wedged.on.clone(), euler(&wedged.mesh));
        let Self { mesh, on, boundary, groups, .. } = &mut wedged;
        assert_eq!(insert(mesh, on, boundary, groups, &mut layers, &Silent), Ok(vec![]));
        on.faces = boundary.in_order();
        assert_eq!(euler_of_folds(mesh), before.2);
        assert_true(mesh, on);
        let (mut undone, mut undone_on) = (mesh.clone(), on.clone());
        let after = hexes(&wedged);
        assert!(!after.is_empty() && after.iter().all(|&hexes| hexes == 1), "{after:?}");
        wedged.wedges = layers.len();
        while let Some(layer) = layers.pop() {
            layer.take_back(&mut undone, &mut undone_on);
            assert_true(&undone, &undone_on);
        }
        assert_eq!((undone, undone_on), (before.0, before.1));
        wedged
    }

    /// How many hexes each of the wanted edges has, in the order of their ends.
    fn hexes_at(&self, is_wanted: impl Fn(&CurveEdge) -> bool) -> Vec<u32> {
        let edges = Look::new(&self.mesh, &self.on, &self.boundary, &self.groups).curve_edges();
        edges.iter().filter(|edge| is_wanted(edge)).map(|edge| edge.hexes).collect()
    }
}

/// How many wedges there are where the sides of a box that are given are covered and meet thinly, but at flat curves.
fn wedges_between(mesh: HexMesh, surfaces: &[u32], flat: impl Fn(Point, Point) -> bool) -> usize {
    let on = told(&mesh, side_of_box);
    let boundary = Boundary::of(&mesh, &on);
    let curves = on.edges.iter().map(|&(_, curve)| curve.index() + 1).max().unwrap();
    let mut is_flat = vec![false; curves];
    for &([a, b], curve) in &on.edges {
        is_flat[curve.index()] |= flat(mesh.positions[a.index()], mesh.positions[b.index()]);
    }
    let none = apart(6, curves);
    let mut thin = Look::new(&mesh, &on, &boundary, &none).curve_edges();
    thin.retain(|edge| {
        let is_covered = |&q: &u32| surfaces.contains(&boundary.surface[q as usize].0);
        edge.quads.iter().all(is_covered) && !is_flat[edge.curve.index()]
    });
    let thin: Vec<CurveId> = thin.iter().map(|edge| edge.curve).collect();
    let groups = Groups::given(&[0, 1, 2, 3, 4, 5], &is_flat).with_thin(&thin);
    Wedged::new(mesh, on, groups, surfaces).wedges
}

#[test]
fn a_thin_curve_gets_one_hex() {
    let cube = voxels(&cubes(4, |_| true));
    let nothing = |_: Point, _: Point| false;
    // Between other groups, and with a corner where the row turns.
    assert_eq!(wedges_between(cube.clone(), &[1, 3], nothing), 1);
    assert_eq!(wedges_between(cube.clone(), &[1, 3, 5], nothing), 2);
    // All around: three curves meet at each corner.
    assert!(wedges_between(cube, &[0, 1, 2, 3, 4, 5], nothing) >= 3);
}

/// The row on the side of the first curve that ends at a flat one would be shorter.
#[test]
fn a_wedge_turns_to_the_next_thin_curve() {
    let is_flat = |a: Point, b: Point| [a, b].iter().all(|p| p.y == 4.0 && p.z == 4.0);
    assert_eq!(wedges_between(voxels(&cubes(4, |_| true)), &[1, 3, 5], is_flat), 1);
}

/// An edge that stands upright on a plate, with flat curves at its foot.
#[test]
fn a_thin_curve_ends_at_the_foot() {
    let mesh = voxels(&cubes(6, |p| p.z < -1.0 || p.x < 0.0 && p.y < 0.0));
    let is_foot = |a: Point, b: Point| a.z == 2.0 && b.z == 2.0;
    assert_eq!(wedges_between(mesh, &[1, 3, 5], is_foot), 1);
}

/// A notch through a plate, whose one wall meets the top thinly.
#[test]
fn all_hexes_draw_back_where_a_wedge_ends_beside_a_concave_curve() {
    let mesh = voxels(&cubes(6, |p| p.x < 0.0 || p.y < 0.0));
    let [x_wall, y_wall, top, other] = [0, 1, 2, 3];
    let on = told(&mesh, |middle, normal| match side_of_box(middle, normal) {
        1 if middle.x == 3.0 => x_wall,
        3 if middle.y == 3.0 => y_wall,
        5 => top,
        _ => other,
    });
    let is_between = |edge: &CurveEdge, surfaces: [u32; 2], boundary: &Boundary| {
        let mut sides = edge.quads.map(|q| boundary.surface[q as usize].0);
        sides.sort_unstable();
        sides == surfaces
    };
    let boundary = Boundary::of(&mesh, &on);
    let curves = on.edges.iter().map(|&(_, curve)| curve.index() + 1).max().unwrap();
    let edges = Look::new(&mesh, &on, &boundary, &apart(4, curves)).curve_edges();
    let curve = |surfaces| edges.iter().find(|edge| is_between(edge, surfaces, &boundary)).unwrap().curve;
    let mut is_flat = vec![false; curves];
    is_flat[curve([x_wall, y_wall]).index()] = true;
    let groups = Groups::given(&[0, 0, 0, 3], &is_flat).with_thin(&[curve([x_wall, top])]);
    let wedged = Wedged::new(mesh, on, groups, &[x_wall, y_wall, top]);
    assert_eq!(wedged.wedges, 1);
    let hexes = |surfaces| wedged.hexes_at(|edge| is_between(edge, surfaces, &wedged.boundary));
    assert_eq!(hexes([x_wall, top]), [1; 3]);
    assert_eq!(hexes([x_wall, y_wall]), [2; 6]);
    let mut of_sharp = hexes([y_wall, top]);
    of_sharp.sort_unstable();
    assert_eq!(of_sharp, [1, 2, 2]);
    let corner = wedged.mesh.positions.iter().position(|&p| p == Point::new(3.0, 3.0, 6.0)).unwrap();
    let quads = |surface: u32| {
        let of_surface = wedged.on.faces.iter().filter(|(_, s)| s.0 == surface);
        of_surface.filter(|(quad, _)| quad.contains(&NodeId::new(corner))).count()
    };
    assert_eq!([x_wall, y_wall, top].map(quads), [1, 1, 2]);
}
