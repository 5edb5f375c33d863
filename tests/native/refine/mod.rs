//! Conforming refinement of quad meshes.

mod cancel;
mod counts;
mod estimate;
mod exhaustive;
mod judge;
mod models;
mod random;
mod results;
mod worlds;

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::PolygonMesh;
use hexmill::refine::{QuadOptions, QuadRefinement, RefinedQuads};

/// Refines the elements for which `wanted(level, center)` holds.
fn refine_where(
    input: &PolygonMesh,
    options: &QuadOptions,
    wanted: impl Fn(usize, Point) -> bool,
) -> RefinedQuads {
    let mut refinement = QuadRefinement::new(input, options, &Silent).expect("a valid surface");
    for level in 0.. {
        let candidates = refinement.candidates();
        let targets: Vec<f64> = candidates
            .centers
            .iter()
            .map(|&center| if wanted(level, center) { f64::MIN_POSITIVE } else { f64::INFINITY })
            .collect();
        if !refinement.advance(Some(&targets), &Silent).expect("within limits") {
            break;
        }
    }
    refinement.finish(&Silent).expect("within limits")
}
