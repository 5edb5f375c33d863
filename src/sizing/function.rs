//! A caller's own idea of sizes.

use rayon::prelude::*;

use super::SizingError;
use crate::geometry::Point;

/// Tells how long the edges of elements may be. Asked once a level about all elements that could be
/// refined next; a function of a centre and a longest edge is one too.
pub trait SizeFunction: Sync {
    /// For each element the greatest length its edges may have (model units), infinite where any will do.
    /// `centers` and `longest` run in parallel: the mean of an element's nodes, its longest edge.
    fn targets(&self, centers: &[Point], longest: &[f64]) -> Vec<f64>;
}

impl<F: Fn(Point, f64) -> f64 + Sync> SizeFunction for F {
    fn targets(&self, centers: &[Point], longest: &[f64]) -> Vec<f64> {
        centers.par_iter().zip(longest).map(|(&center, &longest)| self(center, longest)).collect()
    }
}

/// Checks what a size function gave for `wanted` elements.
///
/// # Errors
/// If there is not one number for each, or one is not positive.
pub fn check_targets(targets: &[f64], wanted: usize) -> Result<(), SizingError> {
    if targets.len() != wanted {
        return Err(SizingError::TargetCount { given: targets.len(), wanted });
    }
    match targets.iter().position(|&t| t.is_nan() || t <= 0.0) {
        Some(element) => Err(SizingError::TargetValue { element, value: targets[element] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closures_are_size_functions() {
        let function = |center: Point, longest: f64| center.x + longest;
        let given = function.targets(&[Point::X, Point::Y], &[0.5, 0.25]);
        assert_eq!(given, [1.5, 0.25]);
    }

    #[test]
    fn targets_are_positive_numbers_one_for_each() {
        assert_eq!(check_targets(&[1.0, f64::INFINITY], 2), Ok(()));
        let count = check_targets(&[1.0], 2).unwrap_err();
        assert_eq!(count.to_string(), "the size function gave 1 lengths for 2 elements; give one for each");
        for value in [0.0, -1.0, f64::NAN] {
            let wrong = check_targets(&[1.0, value], 2).unwrap_err();
            assert_eq!(wrong.code(), "size-function-value");
            assert!(wrong.to_string().contains("for element 1"), "{wrong}");
        }
    }
}
