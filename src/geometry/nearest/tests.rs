use super::*;
use crate::Silent;
use crate::geometry::closest_on_triangle;

/// A zigzag of triangles over the unit square, `n` times `n` pairs.
fn sheet(n: usize) -> Vec<[Point; 3]> {
    let at = |i: usize, j: usize| {
        let [x, y] = [i, j].map(|k| k as f64 / n as f64);
        Point::new(x, y, if (i + j).is_multiple_of(2) { 0.0 } else { 0.1 })
    };
    let cell =
        |i, j| [[at(i, j), at(i + 1, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]];
    (0..n * n).flat_map(|k| cell(k % n, k / n)).collect()
}

#[test]
fn the_tree_finds_what_a_walk_over_all_finds() {
    let triangles = sheet(9);
    let index = NearestTriangle::of(triangles.iter().copied());
    for k in 0..200 {
        let p =
            Point::new(f64::from(k % 7) / 4.0 - 0.3, f64::from(k % 11) / 7.0 - 0.2, f64::from(k % 5) - 2.0);
        let walked =
            triangles.iter().map(|t| closest_on_triangle(p, *t).distance(p)).fold(f64::INFINITY, f64::min);
        let nearest = index.nearest(p).unwrap();
        assert_eq!(nearest.point.distance(p), walked, "{p}");
        assert_eq!(closest_on_triangle(p, triangles[nearest.facet]), nearest.point, "{p}");
    }
}

fn of_quads(quads: &[CutQuad]) -> NearestQuad {
    let corners = (0..quads.len() as u32).map(|q| [0, 1, 2, 3].map(|k| 4 * q + k));
    NearestQuad::sharing(quads.iter().flat_map(|quad| quad.0).collect(), corners, &Silent).unwrap()
}

#[test]
fn a_quad_is_found_by_the_cut_that_is_farther() {
    let quads: Vec<_> = sheet(9).chunks(2).map(|t| CutQuad([t[0][0], t[0][1], t[1][1], t[0][2]])).collect();
    let index = of_quads(&quads);
    for k in 0..200 {
        let p =
            Point::new(f64::from(k % 7) / 4.0 - 0.3, f64::from(k % 11) / 7.0 - 0.2, f64::from(k % 5) / 9.0);
        let walked = quads.iter().map(|quad| quad.distance_squared(p)).fold(f64::INFINITY, f64::min);
        let nearest = index.nearest(p).unwrap();
        assert_eq!(nearest.point.distance_squared(p), walked, "{p}");
        assert_eq!(quads[nearest.facet].distance_squared(p), walked, "{p}");
    }
}

/// Above a corner that is bent up the other diagonal's middle is a half up, its own is on the ground.
#[test]
fn a_quad_is_as_far_as_the_farther_cut() {
    let quad = CutQuad([Point::ZERO, Point::X, Point::new(1.0, 1.0, 1.0), Point::Y]);
    let [low, high] = [0.0, 0.5].map(|z| Point::new(0.5, 0.5, z));
    assert_eq!(quad.middles(), [high, low]);
    for middle in quad.middles() {
        let distances = quad.triangles().map(|t| closest_on_triangle(middle, t).distance(middle));
        let of_cuts = [0, 2].map(|k| f64::min(distances[k], distances[k + 1]));
        assert!(of_cuts.contains(&0.0) && of_cuts.iter().any(|&d| d > 0.2), "{of_cuts:?}");
        assert_eq!(quad.distance_squared(middle).sqrt(), of_cuts[0].max(of_cuts[1]));
        let index = of_quads(&[quad]);
        assert_eq!(index.closest_point(middle).unwrap().distance(middle), of_cuts[0].max(of_cuts[1]));
    }
}

#[test]
fn the_first_of_equal_triangles_is_found() {
    let twice: Vec<[Point; 3]> = sheet(5).into_iter().chain(sheet(5)).collect();
    let index = NearestTriangle::of(twice.iter().copied());
    for t in &twice[..50] {
        let found = index.nearest((t[0] + t[1] + t[2]) / 3.0).unwrap();
        assert_eq!(twice[found.facet], *t);
        assert!(found.facet < 50);
    }
}

#[test]
fn all_is_full_in_a_tree_but_for_what_is_last() {
    for n in [1, 2, 4, 5, 11, 16, 17, 40] {
        let tree = NearestTriangle::of(sheet(n));
        let (mut left, mut branches) = ((2 * n * n).div_ceil(LANES), 0);
        assert_eq!(tree.tree.leaves.len(), left + 1);
        while left > 1 {
            // What would be alone in a branch is in the one above.
            branches += left / SINGLES + usize::from(left % SINGLES > 1);
            left = left.div_ceil(SINGLES);
        }
        assert_eq!(tree.tree.branches.len(), branches);
    }
}

/// In another order, and in other trees.
#[test]
fn what_is_found_does_not_depend_on_the_searches_before() {
    let triangles: Vec<[Point; 3]> = sheet(9).into_iter().chain(sheet(9)).collect();
    let points: Vec<Point> = (0..60)
        .map(|k| Point::new(f64::from(k % 10), f64::from(k / 10), f64::from(k % 3) - 1.0) / 9.0)
        .collect();
    let index = NearestTriangle::of(triangles.iter().copied());
    let forward: Vec<_> = points.iter().map(|&p| index.nearest(p)).collect();
    let mut backward: Vec<_> = points.iter().rev().map(|&p| index.nearest(p)).collect();
    backward.reverse();
    assert_eq!(forward, backward);
    let anew = |p: Point| NearestTriangle::of(triangles.iter().copied()).nearest(p);
    assert!(points.iter().zip(&forward).all(|(&p, found)| anew(p) == *found));
}

/// In groups of one and many, of all and of each; triangles are given twice, in two groups each.
#[test]
fn groups_are_searched_by_themselves_and_together() {
    let triangles: Vec<[Point; 3]> = sheet(9).into_iter().chain(sheet(9)).collect();
    let of_group = |g: usize| (0..triangles.len()).filter(move |t| [t % 5, t % 7 + 1, 8][t % 3] == g);
    let corners = |t: usize| [0, 1, 2].map(|k| 3 * t as u32 + k);
    let numbered = |t: usize| (t, corners(t));
    let groups: Vec<usize> = (0..9).filter(|&g| of_group(g).next().is_some()).collect();
    let of_groups = groups.iter().map(|&g| of_group(g).map(numbered));
    let together = NearestTriangle::of_groups(triangles.as_flattened().to_vec(), of_groups, &Silent).unwrap();
    let alone = NearestTriangle::of(triangles.iter().copied());
    assert_eq!(groups.len(), 9);
    for k in 0..300 {
        let p = Point::new(f64::from(k % 7), f64::from(k % 11), f64::from(k % 5) - 2.0) / 6.0;
        assert_eq!(together.nearest(p), alone.nearest(p), "{p}");
        let squared = alone.nearest(p).unwrap().point.distance_squared(p);
        assert_eq!(together.nearest_within(p, squared), alone.nearest(p), "{p}");
        for (place, &g) in groups.iter().enumerate() {
            let members: Vec<usize> = of_group(g).collect();
            let found = NearestTriangle::of(members.iter().map(|&t| triangles[t])).nearest(p).unwrap();
            let found = Nearest { facet: members[found.facet], ..found };
            assert_eq!(together.nearest_of(place, p), Some(found), "{p} {g}");
        }
    }
}

#[test]
fn no_triangles_have_no_nearest_point() {
    let none = NearestTriangle::of([]);
    assert_eq!(none.closest_point(Point::ZERO), None);
    assert_eq!(none.nearest_within(Point::ZERO, f64::INFINITY), None);
}

#[cfg(not(target_arch = "wasm32"))]
mod random {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::Aabb;
    use crate::geometry::samples::{point, points};

    proptest! {
        /// What leads from one cut to the other passes through the patch.
        #[test]
        fn a_patch_is_no_farther_than_the_farther_cut(corners in points::<4>(1.0), p in point(2.0)) {
            const STEPS: usize = 40;
            let [a, b, c, d] = corners;
            let share = |k: usize| k as f64 / STEPS as f64;
            let at = |(i, j): (usize, usize)| a.lerp(b, share(i)).lerp(d.lerp(c, share(i)), share(j));
            let places = (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |j| at((i, j))));
            let nearest = places.map(|place| place.distance(p)).fold(f64::INFINITY, f64::min);
            let between = Aabb::around(&corners).size().length() / STEPS as f64;
            prop_assert!(nearest <= CutQuad(corners).distance_squared(p).sqrt() + between);
        }

        #[test]
        fn the_closest_point_agrees_with_a_search_of_all(
            triangles in prop::collection::vec(points::<3>(1.0), 1..60), p in point(2.0),
        ) {
            let found = NearestTriangle::of(triangles.iter().copied()).closest_point(p).unwrap();
            let distances = triangles.iter().map(|t| closest_on_triangle(p, *t).distance(p));
            prop_assert_eq!(found.distance(p), distances.fold(f64::INFINITY, f64::min));
        }

        #[test]
        fn what_is_no_farther_is_found(
            triangles in prop::collection::vec(points::<3>(1.0), 1..60), p in point(2.0),
        ) {
            let index = NearestTriangle::of(triangles.iter().copied());
            let nearest = index.nearest(p);
            let squared = nearest.unwrap().point.distance_squared(p);
            prop_assert_eq!(index.nearest_within(p, squared), nearest);
            prop_assert_eq!(index.nearest_within(p, squared.next_down()), None);
        }
    }
}

/// On a facet it is none, off it that to the nearest.
#[test]
fn a_distance_is_that_to_the_nearest_facet() {
    let triangles = sheet(9);
    let index = NearestTriangle::of(triangles.iter().copied());
    for (k, &[a, b, c]) in triangles.iter().enumerate() {
        let on = (a + b + c) / 3.0;
        let normal = (b - a).cross(c - a).normalize();
        for off in [0.0, 1e-15, 1e-6, 1e-3, 0.2, 3.0] {
            let p = on + normal * off;
            let exact = index.nearest(p).unwrap().point.distance(p);
            assert_eq!(index.distance(p), if off < 1e-14 { 0.0 } else { exact }, "{k} {off}");
        }
    }
    assert_eq!(NearestTriangle::of([]).distance(Point::ZERO), f64::INFINITY);
}
