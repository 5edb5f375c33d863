use super::*;
use crate::Silent;
use crate::geometry::Point;
use crate::hexing::background::{AlignedGrid, grid};
use crate::mesh::{PolygonMesh, check_hexes, mesh_hash};
use crate::solid::testing::{cuboid, cylinder, ell, holed, solid, voxels};

/// A ball of radius 1 of many quads.
fn ball() -> PolygonMesh {
    let mut mesh = cuboid([8, 8, 8]);
    for p in &mut mesh.positions {
        *p = (*p - Point::splat(4.0)).normalize();
    }
    mesh
}

fn turned(mut mesh: PolygonMesh) -> PolygonMesh {
    let turn = glam::DQuat::from_xyzw(0.1, 0.2, 0.3, 0.9).normalize();
    mesh.positions.iter_mut().for_each(|p| *p = turn * *p);
    mesh
}

/// The core of a solid by a grid; checks that it is a mesh and has the solid's Euler number.
#[track_caller]
fn core_of(surface: &PolygonMesh, edge_length: f64) -> Core {
    core_by(surface, edge_length, &CoreOptions::default())
}

#[track_caller]
fn core_by(surface: &PolygonMesh, edge_length: f64, options: &CoreOptions<'_>) -> Core {
    let solid = solid(surface);
    let background = grid(&solid, &AlignedGrid::new(edge_length), &Silent).unwrap();
    assert_eq!(check_hexes(&background), []);
    let core = core(&background, &solid, options, &Silent).unwrap();
    assert_eq!(check_hexes(&core.mesh), []);
    assert_eq!(core.report.euler, core.report.solid_euler, "{:?}", core.report);
    assert_eq!((core.report.cells, core.cells.len()), (core.mesh.hexes.len(), core.mesh.hexes.len()));
    assert!(core.lost.is_empty());
    core
}

#[test]
fn solids_along_the_axes_are_captured_exactly() {
    for (surface, edge_length, cells) in
        [(cuboid([3, 2, 1]), 0.37, 8 * 5 * 3), (holed(), 0.34, 9 * 9 * 6 - 9 * 6), (ell(), 0.26, 3 * 64)]
    {
        let core = core_of(&surface, edge_length);
        assert!((core.report.volume_ratio - 1.0).abs() < 1e-12, "{:?}", core.report);
        assert_eq!((core.report.cells, core.report.flips), (cells, 0));
    }
}

#[test]
fn round_and_turned_solids_keep_kind_and_volume() {
    for (surface, edge_length) in [
        (cylinder(48), 0.2),
        (ball(), 0.15),
        (turned(cuboid([3, 2, 1])), 0.17),
        (turned(holed()), 0.17),
        (turned(ell()), 0.12),
        (turned(cylinder(48)), 0.15),
    ] {
        let cut = core_by(&surface, edge_length, &CoreOptions { level: false, ..CoreOptions::default() });
        assert!((cut.report.volume_ratio - 1.0).abs() < 0.05, "{:?}", cut.report);
        core_of(&surface, edge_length);
    }
}

#[test]
fn round_solids_are_levelled_and_planes_and_cylinders_are_not() {
    for surface in [turned(cuboid([3, 2, 1])), cylinder(48), turned(cylinder(48))] {
        assert_eq!(core_of(&surface, 0.15).report.terraces, 0);
    }
    let ball = core_of(&ball(), 0.15);
    assert!(ball.report.terraces > 10 && ball.report.volume_ratio > 0.9, "{:?}", ball.report);
}

#[test]
fn any_number_of_threads_cuts_the_same_core() {
    let solid = solid(&turned(holed()));
    let hashes = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let background = grid(&solid, &AlignedGrid::new(0.11), &Silent).unwrap();
            let core = core(&background, &solid, &CoreOptions::default(), &Silent).unwrap();
            let all = |mesh: &HexMesh| mesh_hash(&mesh.positions, &mesh.hexes);
            (all(&background), all(&core.mesh))
        })
    });
    assert_eq!(hashes[0], hashes[1]);
}

#[test]
fn two_bodies_are_kept_each_and_crumbs_are_not() {
    let mut two = cuboid([2, 2, 2]);
    let mut other = turned(cuboid([2, 2, 3]));
    other.positions.iter_mut().for_each(|p| p.x += 5.0);
    let first = two.positions.len() as u32;
    for face in 0..other.face_count() {
        two.push_face(other.face(face).iter().map(|n| NodeId(n.0 + first)));
    }
    two.positions.extend(&other.positions);
    let core = core_of(&two, 0.3);
    assert_eq!(core.report.euler, 4);
    assert!((core.report.volume_ratio - 1.0).abs() < 0.05, "{:?}", core.report);
}

#[test]
fn what_is_smaller_than_cells_is_told() {
    // Two blocks, joined by a bar that is thinner than a cell and beside the lines.
    let is_bar = |[x, y, z]: [i32; 3]| (8..24).contains(&x) && y == 3 && z == 3;
    let blocks = voxels([32, 8, 8], |at| !(8..24).contains(&at[0]) || is_bar(at));
    let solid = solid(&blocks);
    let background = grid(&solid, &AlignedGrid::new(2.6), &Silent).unwrap();
    let options = CoreOptions { keep_thin: false, ..CoreOptions::default() };
    let core = core(&background, &solid, &options, &Silent).unwrap();
    assert_eq!(check_hexes(&core.mesh), []);
    let [lost] = &core.lost[..] else { panic!("{:?}", core.lost) };
    assert!(lost.centers.iter().all(|p| p.x > 23.0), "{lost:?}");
    assert_eq!(lost.centers.len(), core.report.crumbs);
    assert!(core.report.crumbs > 0 && core.report.volume_ratio < 0.6, "{:?}", core.report);
}

#[test]
fn in_refined_domains_the_papers_energy_is_cut() {
    let solid = solid(&ball());
    let background = grid(&solid, &AlignedGrid::new(0.2), &Silent).unwrap();
    // The layers of cells around the surface are the domain.
    let cells = Cells::of(&background, &Silent).unwrap();
    let domain: Vec<bool> =
        (0..cells.len()).map(|c| solid.signed_distance(cells.barycentre(c)).abs() < 0.25).collect();
    let options =
        CoreOptions { energy: Energy::Paper, domain: Some(&domain), keep_thin: false, level: false };
    let cut = core(&background, &solid, &options, &Silent).unwrap();
    assert_eq!(check_hexes(&cut.mesh), []);
    assert!(cut.report.is_of_kind() && cut.report.undecided == domain.iter().filter(|&&is| is).count());
    // Cells whose faces would be bad are left out.
    assert!((0.7..1.0).contains(&cut.report.volume_ratio), "{:?}", cut.report);

    // Half of the domain alone is levelled.
    let domain: Vec<bool> = (0..cells.len()).map(|c| domain[c] && cells.barycentre(c).x > 0.0).collect();
    let [flat, stepped] = [true, false].map(|level| {
        let options = CoreOptions { level, domain: Some(&domain), ..CoreOptions::default() };
        core(&background, &solid, &options, &Silent).unwrap()
    });
    assert!(flat.report.terraces > 0 && flat.report.is_of_kind(), "{:?}", flat.report);
    let beyond = |core: &Core| core.cells.iter().copied().filter(|c| !domain[c.index()]).collect::<Vec<_>>();
    assert!(flat.cells != stepped.cells && beyond(&flat) == beyond(&stepped));
}

#[test]
fn what_is_thinner_than_cells_is_kept() {
    let thin = |mut surface: PolygonMesh, scale: Point| {
        surface.positions.iter_mut().for_each(|p| *p *= scale);
        turned(surface)
    };
    // A wall, a rod, a hole and a slot, askew, for cells of edge 1.
    let hole = voxels([9, 9, 6], |[x, y, _]| (x, y) != (4, 4));
    let slot = voxels([9, 9, 6], |[x, _, z]| x != 4 || z < 3);
    for (name, surface, scale) in [
        ("wall", cuboid([12, 12, 1]), Point::new(1.0, 1.0, 0.6)),
        ("rod", cuboid([16, 1, 1]), Point::new(1.0, 0.7, 0.7)),
        ("hole", hole, Point::new(0.8, 0.8, 1.0)),
        ("slot", slot, Point::new(0.6, 1.0, 1.0)),
    ] {
        let solid = solid(&thin(surface, scale));
        let background = grid(&solid, &AlignedGrid::new(1.0), &Silent).unwrap();
        let made = |keep_thin| {
            core(&background, &solid, &CoreOptions { keep_thin, ..Default::default() }, &Silent).unwrap()
        };
        let (kept, plain) = (made(true), made(false));
        assert_eq!(check_hexes(&kept.mesh), [], "{name}");
        assert!(kept.report.is_of_kind() && kept.lost.is_empty(), "{name}: {:?}", kept.report);
        // At either end along each axis no more than an edge is missing.
        let (reach, wanted) = (kept.mesh.bounds(), solid.bounds());
        let missing = (reach.min - wanted.min).max(wanted.max - reach.max).max_element();
        assert!(missing < 1.0, "{name}: {missing}");
        assert!(kept.report.thin > 0 && plain.report.thin == 0, "{name}");
    }
}

/// Of a plate thinner than cells a crumb may be left, which is a ball as the plate is.
#[test]
fn what_lacks_most_of_the_solid_is_not_of_its_kind() {
    let report =
        |euler, volume_ratio| CoreReport { euler, solid_euler: 2, volume_ratio, ..CoreReport::default() };
    let off = [(2, 0.6), (0, 3.0), (-20, 1.0), (2, 0.4), (0, 0.4)].map(|(e, v)| report(e, v).off_kind());
    assert!(off[0] == 0 && off.is_sorted_by(|a, b| a < b), "{off:?}");
    assert!(report(2, 0.5).is_of_kind() && !report(2, 0.49).is_of_kind());
}
