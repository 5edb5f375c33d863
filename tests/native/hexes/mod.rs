//! Stages of conforming hex refinement.

mod acceptance;
mod accepted;
mod counts;
mod groups;
mod growth;
mod inner_groups;
mod judge;
mod levels;
mod limits;
mod materials;
pub(crate) mod meshes;
mod octants;
mod pipeline;
mod sets;
mod steps;
mod worlds;

use hexmill::Silent;
use hexmill::refine::hex::{Method, StageError, StageMesh, StageResult, stage};

/// Every hex of the mesh refined once.
fn refined_once(mesh: &StageMesh) -> StageMesh {
    stage(mesh, &vec![true; mesh.hexes.len()], Method::Two, &Silent).expect("nothing to join").mesh
}

/// Refines the hexes that are wanted and what the method needs besides; whole families where there are some.
/// Returns the set that was refined, too.
fn refine(mesh: &StageMesh, wanted: Vec<bool>, method: Method) -> (StageResult, Vec<bool>) {
    let mut refined = wanted;
    loop {
        let more = match stage(mesh, &refined, method, &Silent) {
            Ok(stage) => return (stage, refined),
            Err(StageError::Conflict(more) | StageError::Forbidden(more)) => more,
            Err(error) => panic!("{error}"),
        };
        assert!(!more.is_empty() && more.iter().all(|&hex| !refined[hex as usize]), "coarse hexes");
        for hex in more {
            let hex = hex as usize;
            let family = |h: usize| (mesh.level[h], mesh.element[h] / 8);
            for (other, refined) in refined.iter_mut().enumerate() {
                let is_sibling =
                    mesh.octant[hex] < 8 && mesh.octant[other] < 8 && family(other) == family(hex);
                *refined |= other == hex || (is_sibling && method != Method::Three);
            }
        }
    }
}

/// Refines by a rule on the centers of whole families (of hexes for 3-refinement).
fn refine_where(
    mesh: &StageMesh,
    method: Method,
    wanted: impl Fn([f64; 3]) -> bool,
) -> (StageResult, Vec<bool>) {
    let set = (0..mesh.hexes.len()).map(|h| wanted(judge::center(mesh, h).to_array())).collect();
    refine(mesh, set, method)
}
