//! What is refined beyond what is asked for: told, and refused where that is wanted.

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::{check_hexes, mesh_hash};
use hexmill::refine::hex::{Growth, HexOptions, HexPlan, HexRefineError, Method, refine_hexes};
use hexmill::sizing::Region;

use super::acceptance::block;
use super::meshes::{cells, cubes, i_beam};

const METHODS: [Method; 4] = [Method::One, Method::Two, Method::Three, Method::Auto];

fn options(method: Method, growth: Growth, regions: &[Region]) -> HexOptions {
    HexOptions { method, growth, regions: regions.to_vec(), ..HexOptions::default() }
}

/// Two cubes that touch at an edge: Method II can part them, Method I fills the corners between them.
fn touching() -> Vec<Region> {
    vec![block([1.0; 3], [2.0; 3], 2), block([2.0, 2.0, 1.0], [3.0, 3.0, 2.0], 2)]
}

/// Methods I and II refine the whole input once, Method II by itself only what it can group, and 27 children need no
/// families.
#[test]
fn hexes_of_the_input_that_nothing_asks_for_are_told() {
    // The middle 3 x 3 x 3 of 5 x 5 x 5 cannot be grouped two by two, but with a layer on three sides; the middle
    // 2 x 2 x 2 of 4 x 4 x 4 can.
    let (odd, even) = (block([1.0; 3], [4.0; 3], 1), block([1.0; 3], [3.0; 3], 1));
    for (size, region, rest, auto) in [(5, odd, 125 - 27, 64 - 27), (4, even, 64 - 8, 0)] {
        let input = cubes(size);
        for (method, base) in METHODS.into_iter().zip([rest, rest, 0, auto]) {
            let options = options(method, Growth::Allow, std::slice::from_ref(&region));
            let plan = HexPlan::new(&input, &options, &Silent).expect("a plan");
            assert_eq!(plan.added().base, base, "{size}, {method:?}");
            let refined = plan.carry_out(&Silent).expect("a mesh");
            assert_eq!(refined.added.base, base);
            let asked = size.pow(3) as usize - rest;
            assert_eq!(refined.stages[0].refined, asked + base, "{size}, {method:?}");
        }
    }
}

/// What cannot be grouped calls for hexes beside it alone: not beside what can be, and not in bodies that it does not touch.
#[test]
fn only_what_cannot_be_grouped_calls_for_more() {
    let layer = block([0.0; 3], [8.0, 8.0, 1.0], 1);
    let far = block([6.0; 3], [7.0; 3], 1);
    // A plate of one layer, where there are no blocks, and a cube away from it.
    let apart =
        cells([13, 8, 8], |[x, y, z]| if x < 4 { y < 4 && z == 0 } else { x > 4 }, std::convert::identity);
    let of_plate = block([1.0, 1.0, 0.0], [2.0, 2.0, 1.0], 1);
    for (input, regions, base, hexes) in
        [(cubes(8), vec![layer, far], 7, 1632), (apart, vec![of_plate], 15, 8 * 16 + 512)]
    {
        let options = options(Method::Auto, Growth::Allow, &regions);
        let refined = refine_hexes(&input, &options, &Silent).expect("a mesh");
        assert_eq!(check_hexes(&refined.mesh), []);
        assert_eq!((refined.added.base, refined.added.growth()), (base, base));
        assert_eq!(refined.mesh.hexes.len(), hexes);
    }
}

#[test]
fn growth_is_refused_with_the_place_if_that_is_wanted() {
    let input = cubes(4);
    let grown =
        refine_hexes(&input, &options(Method::One, Growth::Allow, &touching()), &Silent).expect("a mesh");
    assert!(grown.added.closure.method > 0);
    let refused = HexOptions { levels: Some(1), ..options(Method::One, Growth::Refuse, &touching()) };
    let error = refine_hexes(&input, &refused, &Silent);
    let Err(HexRefineError::GrowthRefused { elements, level, near, .. }) = &error else {
        panic!("{error:?}")
    };
    assert!(*elements > 0 && *level == 1);
    // Beside the edge where the two cubes touch.
    assert!(
        (near.x - 2.0).abs() < 1.0 && (near.y - 2.0).abs() < 1.0 && near.z > 0.0 && near.z < 3.0,
        "{near}"
    );
    assert_eq!(error.as_ref().unwrap_err().code(), "growth-refused");
}

/// Hexes of the input that are refined once for families count alike: where all are, and where what cannot be grouped needs
/// the rest.
#[test]
fn the_rest_of_the_input_is_growth_by_every_method() {
    let odd = [block([1.0; 3], [4.0; 3], 1)];
    for (method, rest) in [(Method::One, 98), (Method::Two, 98), (Method::Auto, 37)] {
        let error = refine_hexes(&cubes(5), &options(method, Growth::Refuse, &odd), &Silent);
        let Err(HexRefineError::GrowthRefused { elements, level: 0, near, .. }) = error else {
            panic!("{method:?}: {error:?}")
        };
        assert_eq!((elements, near), (rest, Point::splat(0.5)), "{method:?}");
        let asked = HexOptions { levels: Some(1), ..options(method, Growth::Refuse, &odd) };
        assert_eq!(refine_hexes(&cubes(5), &asked, &Silent).expect("a mesh").added.growth(), 0, "{method:?}");
    }
    assert!(refine_hexes(&cubes(5), &options(Method::Three, Growth::Refuse, &odd), &Silent).is_ok());
}

/// What is told as growth is what is refused, by every method.
#[test]
fn what_is_told_is_what_is_refused() {
    let input = cubes(4);
    let sets = [
        touching(),
        vec![block([1.0; 3], [3.0; 3], 1)],
        vec![block([1.2; 3], [1.4; 3], 3)],
        vec![block([0.0; 3], [1.0; 3], 2), block([1.0; 3], [2.0; 3], 1)],
    ];
    for (regions, method) in sets.iter().flat_map(|regions| METHODS.map(|method| (regions, method))) {
        for levels in [None, Some(1)] {
            let [allowed, refused] = [Growth::Allow, Growth::Refuse].map(|growth| {
                refine_hexes(&input, &HexOptions { levels, ..options(method, growth, regions) }, &Silent)
            });
            let growth = allowed.expect("a mesh").added.growth();
            match refused {
                Ok(refined) => assert_eq!((growth, refined.added.growth()), (0, 0), "{method:?} {regions:?}"),
                Err(HexRefineError::GrowthRefused { .. }) => assert!(growth > 0, "{method:?} {regions:?}"),
                Err(error) => panic!("{error}"),
            }
        }
    }
}

/// Along an inner ridge of the beam neither side can leave everywhere: that is seen when the pillow is made.
#[test]
fn growth_during_the_work_is_refused_too() {
    let cells = [[2.0, 0.0, 4.0], [2.0, 1.0, 4.0], [2.0, 0.0, 5.0], [2.0, 1.0, 5.0], [1.0, 0.0, 5.0]];
    let regions = cells.map(|at| block(at, at.map(|x| x + 1.0), 2));
    let grown =
        refine_hexes(&i_beam(), &options(Method::Two, Growth::Allow, &regions), &Silent).expect("a mesh");
    assert!(grown.added.conflicts > 0);
    let refused = HexOptions { levels: Some(1), ..options(Method::Two, Growth::Refuse, &regions) };
    let error = refine_hexes(&i_beam(), &refused, &Silent);
    assert!(matches!(error, Err(HexRefineError::GrowthRefused { level: 1, .. })), "{error:?}");
}

/// Where nothing has to grow the mesh is the same, and nothing is refused.
#[test]
fn refusing_growth_changes_no_mesh() {
    let input = cubes(4);
    for (method, regions) in [
        (Method::One, vec![block([1.0; 3], [3.0; 3], 2)]),
        (Method::Two, touching()),
        (Method::Two, vec![block([1.0; 3], [3.0; 3], 3)]),
        (Method::Three, vec![block([1.0; 3], [3.0; 3], 2)]),
        (Method::Auto, vec![block([1.0; 3], [3.0; 3], 2)]),
    ] {
        let [allowed, refused] = [Growth::Allow, Growth::Refuse].map(|growth| {
            let levels = matches!(method, Method::One | Method::Two).then_some(1);
            let options = HexOptions { levels, ..options(method, growth, &regions) };
            refine_hexes(&input, &options, &Silent).expect("nothing has to grow")
        });
        let hash = |mesh: &hexmill::mesh::HexMesh| mesh_hash(&mesh.positions, &mesh.hexes);
        assert_eq!(hash(&allowed.mesh), hash(&refused.mesh), "{method:?}");
        assert_eq!(allowed.added, refused.added);
        assert!(check_hexes(&refused.mesh).is_empty());
    }
}

#[test]
fn regions_that_meet_no_hex_are_told() {
    let (input, away) = (cubes(3), block([7.0; 3], [8.0; 3], 2));
    let regions = [away.clone(), block([1.0; 3], [2.0; 3], 1), away];
    for method in METHODS {
        let options = options(method, Growth::Allow, &regions);
        assert_eq!(
            HexPlan::new(&input, &options, &Silent).expect("a plan").idle_regions(),
            [0, 2],
            "{method:?}"
        );
    }
}
