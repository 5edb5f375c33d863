//! Nothing but size and place changes where a solid is moved.

use proptest::prelude::*;

use super::super::testing::{cuboid, cylinder, ell, holed, moved, solid};
use super::check_graph;
use crate::geometry::Point;
use crate::geometry::samples::{point, rotation};
use crate::solid::SolidModel;

/// Vertices of each curve, and whether it is straight.
fn chains(solid: &SolidModel) -> Vec<(usize, bool)> {
    let mut chains: Vec<_> = solid.curves().iter().map(|c| (c.vertices.len(), c.is_straight)).collect();
    chains.sort_unstable();
    chains
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]
    #[test]
    fn rigid_motions_and_scales_change_no_feature(
        turn in rotation(), by in point(1000.0), scale in prop::sample::select(vec![1e-6, 1.0, 1e6]), p in point(3.0),
    ) {
        let motion = |p: Point| (turn * p + by) * scale;
        for surface in [cuboid([2, 3, 1]), ell(), holed(), cylinder(16)] {
            let at_home = solid(&surface);
            let away = solid(&moved(surface, motion));
            check_graph(&away);
            // Which diagonal cuts a square is up to rounding, and with it the order of points and curves.
            prop_assert_eq!(chains(&away), chains(&at_home));
            prop_assert_eq!(away.corners().len(), at_home.corners().len());
            for (a, b) in away.surfaces().iter().zip(at_home.surfaces()) {
                prop_assert_eq!(&a.triangles, &b.triangles);
                prop_assert_eq!(std::mem::discriminant(&a.class), std::mem::discriminant(&b.class));
            }
            let (there, here) = (away.signed_distance(motion(p)) / scale, at_home.signed_distance(p));
            prop_assert!((there - here).abs() < 1e-9, "{} for {}", there, here);
            prop_assert!((away.volume() / scale.powi(3) - at_home.volume()).abs() < 1e-8);
        }
    }
}
