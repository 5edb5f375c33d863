//! A mesh of a body as near to it as was asked for, if need be with shorter edges everywhere.
//!
//! Smaller cells in places come first (`body`). Where too much is too far for that, or they do not suffice, all edges become
//! shorter: of a curved boundary the most part is too far if anything is, and cells that are cut in places are poorer than whole
//! ones, as are those beside them. How far a mesh is from what is curved goes with the square of its edges: so they become
//! shorter by the root of what is too far, and no shorter than those of cells as many levels finer as the options allow.
//! Where nothing brings mesh and body as near as was asked for, the nearest is kept, by what `merit` weighs.

use super::background::check_size;
use super::body::{Best, Body, best_mesh};
use super::ground::{coarsest, edge_length_of};
use super::merit::{Taste, distance, is_better};
use super::options::{HexingError, HexingOptions};
use super::report::{AttemptReport, RefusedAttempt};
use crate::Monitor;
use crate::sizing::{Region, Target};
use crate::solid::SolidModel;

/// Edges become no shorter than the first of these shares of what they were, and no longer than the second: one step is not to
/// overshoot by far, nor a mesh to be made for little.
const SHORTER: [f64; 2] = [0.5, 0.8];

/// Somewhat shorter than it takes.
const SPARE: f64 = 0.9;

/// Edges that may become no shorter than this share are as short as they may be.
const LEAST: f64 = 0.95;

/// Meshes a body.
pub(super) fn mesh_body(
    solid: &SolidModel,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<Body, HexingError> {
    let shortest = options.edge_length / f64::from(1_u32 << options.max_levels);
    let mut body = best_mesh(solid, options, shortest, monitor)?;
    let mut tried = options.clone();
    tried.regions.iter_mut().for_each(|region| region.target = sized(region, options));
    let mut last = body.apart();
    while let Some(edge_length) = shorter(last, &tried, shortest) {
        tried.edge_length = edge_length;
        tried.max_levels = libm::log2(edge_length / shortest) as u8;
        let made = check_size(solid, coarsest(&tried), tried.max_hexes)
            .map_err(HexingError::from)
            .and_then(|()| best_mesh(solid, &tried, 0.0, monitor));
        match made {
            Ok(other) => {
                last = other.apart();
                body.add(other, options, Taste::of(solid));
            }
            Err(HexingError::Background(error)) => {
                body.report.refused.push(RefusedAttempt {
                    edge_length,
                    background: body.report.choice.kind,
                    shift: [0.0; 3],
                    holds_walls: false,
                    limit: tried.max_hexes,
                    code: error.code(),
                    reason: error.to_string(),
                });
                break;
            }
            Err(HexingError::NothingLeft { .. } | HexingError::Tangled(_)) => break,
            Err(error) => return Err(error),
        }
    }
    if let Some(Best { meshed, number }) = &mut body.best {
        let report = body.report.attempts[*number].mesh.as_mut().expect("a mesh is kept");
        meshed.finish(solid, report, monitor)?;
    }
    Ok(body)
}

/// How long edges are to be after a mesh that is so far `apart` from its body; none if that is near enough, or the shortest would
/// hardly help: they are taken to bring it nearer by the cube of what they are shorter, since they also show what was not shown.
pub(super) fn shorter(apart: f64, options: &HexingOptions, shortest: f64) -> Option<f64> {
    let asked = options.max_distance?;
    let may_be = shortest / options.edge_length;
    let is_in_reach = apart * may_be * may_be * may_be <= asked;
    let [most, least] = SHORTER;
    let share = (SPARE * (asked / apart).sqrt()).clamp(most, least);
    (apart > asked && may_be < LEAST && is_in_reach).then(|| options.edge_length * share.max(may_be))
}

/// What a region wants, whatever the edges are otherwise.
fn sized(region: &Region, options: &HexingOptions) -> Target {
    match region.target {
        Target::Level(level) => {
            Target::Size(edge_length_of(options.background, options) * 0.5_f64.powi(level.into()))
        }
        size => size,
    }
}

impl Body {
    fn best_report(&self) -> Option<&AttemptReport> {
        self.best.as_ref().map(|best| &self.report.attempts[best.number])
    }

    /// How far the best mesh is from the body; infinitely without one.
    fn apart(&self) -> f64 {
        self.best_report().map_or(f64::INFINITY, distance)
    }

    /// Takes over what was tried with other edges, and the mesh that came of it if it is better.
    fn add(&mut self, other: Self, options: &HexingOptions, taste: Taste) {
        let is_better = other.best_report().is_some_and(|theirs| {
            self.best_report().is_none_or(|ours| is_better(theirs, ours, options, taste))
        });
        let first = self.report.attempts.len();
        self.report.attempts.extend(other.report.attempts);
        self.report.refused.extend(other.report.refused);
        if is_better {
            self.best = other.best.map(|best| Best { number: first + best.number, ..best });
            self.report.kept = self.best.as_ref().map(|best| best.number);
            self.report.choice = other.report.choice;
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::background::Background;
    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::sizing::Shape;
    use crate::solid::testing::{cuboid, moved, solid, voxels};

    /// Edges of 1 that may become as short as a quarter.
    fn options(max_distance: f64) -> HexingOptions {
        HexingOptions { edge_length: 1.0, max_distance: Some(max_distance), ..HexingOptions::default() }
    }

    /// A plate with bent walls and a dimple in the top that edges of 1.5 show too coarsely.
    fn dimpled() -> SolidModel {
        let dimple = |p: Point| 0.4 * (1.0 - (p.truncate() - 10.0).length() / 3.0).max(0.0);
        let bent = |p: Point| Point::new(p.x + 3.0 * libm::sin(p.y / 4.0), p.y, p.z);
        let plate = voxels([20, 20, 6], |_| true);
        solid(&moved(plate, |p| bent(if p.z == 6.0 { p - Point::Z * dimple(p) } else { p })))
    }

    #[test]
    fn edges_become_shorter_by_the_root_of_what_is_too_far() {
        let next = |apart: f64| shorter(apart, &options(0.1), 0.25);
        assert_eq!(next(0.1), None, "it is near enough");
        assert_eq!(next(0.101), Some(0.8));
        assert!((next(0.2).unwrap() - 0.9 * 0.5_f64.sqrt()).abs() < 1e-12);
        assert_eq!([0.4, 6.4].map(next), [Some(0.5); 2]);
        assert_eq!([6.5, f64::INFINITY].map(next), [None; 2], "no edges that short suffice");
        assert_eq!(shorter(0.11, &options(0.1), 0.9), Some(0.9));
        assert_eq!(shorter(0.11, &options(0.1), 0.96), None, "hardly any shorter");
        let unasked = HexingOptions { max_distance: None, ..options(1.0) };
        assert_eq!(shorter(9.0, &unasked, 0.25), None);
    }

    #[test]
    fn a_mesh_is_as_near_as_was_asked_for() {
        let dimpled = dimpled();
        let lengths = |max_levels: u8| {
            let options = HexingOptions { edge_length: 1.5, max_levels, ..options(0.095) };
            let Body { report, best } = mesh_body(&dimpled, &options, &Silent).unwrap();
            let kept = &report.attempts[best.unwrap().number];
            assert_eq!(report.kept, report.attempts.iter().position(|attempt| attempt == kept));
            (report.attempts.iter().map(|a| a.edge_length).collect::<Vec<_>>(), distance(kept) <= 0.095)
        };
        assert!(lengths(0).0.iter().all(|&length| length == 1.5));
        assert_eq!(lengths(2), (vec![1.5, 0.8 * 1.5], true));
    }

    #[test]
    fn shorter_edges_that_would_be_too_many_hexes_are_noted() {
        let options = HexingOptions { edge_length: 1.5, max_hexes: 1000, ..options(0.095) };
        let Body { report, best } = mesh_body(&dimpled(), &options, &Silent).unwrap();
        assert!(best.is_some_and(|best| best.number == 0) && report.attempts.len() == 1);
        let refused = report.refused.last().unwrap();
        assert_eq!((refused.edge_length, refused.limit, refused.code), (0.8 * 1.5, 1000, "too-many-hexes"));
    }

    /// A cube is shown as it is: there is nothing that shorter edges would bring nearer.
    #[test]
    fn what_is_near_enough_keeps_its_edges() {
        let cube = solid(&cuboid([4, 4, 4]));
        let Body { report, .. } = mesh_body(&cube, &options(1e-9), &Silent).unwrap();
        assert_eq!(report.attempts.iter().map(|a| a.edge_length).collect::<Vec<_>>(), [1.0]);
    }

    #[test]
    fn levels_of_regions_are_sizes_of_what_was_asked_for() {
        let region =
            |target: Target| Region { shape: Shape::Sphere { center: Point::ZERO, radius: 1.0 }, target };
        let of = |target: Target, background: Background| {
            sized(&region(target), &HexingOptions { background, ..options(1.0) })
        };
        assert_eq!(of(Target::Level(2), Background::Auto), Target::Size(0.25));
        assert_eq!(of(Target::Level(2), Background::Octree), Target::Size(0.5));
        assert_eq!(of(Target::Size(0.3), Background::Auto), Target::Size(0.3));
    }
}
