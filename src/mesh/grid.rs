//! Grids of hexes around a box.

use super::numbering::hex::CORNERS;
use super::{HexMesh, NodeId};
use crate::geometry::{Aabb, Point};
use crate::parallel;

/// What [`hex_grid`] is to make. Lengths are in model units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridOptions {
    /// The edge length of the hexes.
    pub spacing: f64,
    /// How far the grid reaches beyond the box, at least.
    pub margin: f64,
    /// Shorten the edges, along each axis alike, so that the grid ends where the margin does. Else they are `spacing`
    /// exactly, and the grid reaches beyond the margin by less than that, equally on both sides.
    pub fitted: bool,
    /// Refuse a grid of more hexes than this.
    pub max_hexes: u64,
}

/// Why a grid was not made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GridError {
    /// The spacing is no positive number.
    #[error("the spacing is {0}; give a positive number")]
    Spacing(f64),
    /// The margin is negative or no number.
    #[error("the margin is {0}; give 0 or a positive number")]
    Margin(f64),
    /// There is nothing to make a grid around.
    #[error("there are no nodes with finite coordinates to make a grid around")]
    Empty,
    /// The grid would have more hexes than allowed.
    #[error(
        "{} by {} by {} hexes are more than the limit of {limit}; raise the spacing or the limit",
        in_digits(.counts[0]), in_digits(.counts[1]), in_digits(.counts[2])
    )]
    TooManyHexes {
        /// Hexes along x, y and z, about.
        counts: [f64; 3],
        /// The limit.
        limit: u64,
    },
    /// The spacing is too small for the digits of the coordinates.
    #[error(
        "a spacing of {spacing:e} is too small for coordinates that reach {reach:e}; raise it, or move the surface"
    )]
    TooFewDigits {
        /// The spacing.
        spacing: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
}

/// A count as people read it: in digits, one that is very large by its power of ten.
pub(crate) fn in_digits(count: f64) -> String {
    if count.is_infinite() {
        return "more than 1e308".to_owned();
    }
    if count < 1e15 { format!("{count}") } else { format!("{count:.1e}") }
}

impl GridError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Spacing(_) => "spacing-out-of-range",
            Self::Margin(_) => "margin-out-of-range",
            Self::Empty => "surface-empty",
            Self::TooManyHexes { .. } => "too-many-hexes",
            Self::TooFewDigits { .. } => "too-few-digits",
        }
    }
}

/// A length that is this share of a spacing longer than a whole number of spacings is that number of spacings.
const ROUNDING: f64 = 1e-9;

/// How many of the least steps between coordinates a spacing must keep, so that the hexes are alike to three digits.
const LEAST_STEPS: f64 = 1024.0;

/// Node ids have 32 bits, and those of edges and faces of the first refinement too.
const MOST_HEXES: u64 = 1 << 27;

/// A box of hexes along the axes, around `bounds`; of one layer where `bounds` and margin have no extent. Nodes and
/// hexes are numbered along x, then y, then z.
///
/// # Errors
/// See [`GridError`]. The number of hexes is held against the limit before anything is made.
///
/// ```
/// use hexmill::geometry::{Aabb, Point};
/// use hexmill::mesh::{GridOptions, hex_grid};
/// let bounds = Aabb { min: Point::ZERO, max: Point::new(2.0, 1.0, 0.5) };
/// let options = GridOptions { spacing: 0.5, margin: 0.5, fitted: false, max_hexes: 1000 };
/// let grid = hex_grid(bounds, &options)?;
/// assert_eq!(grid.hexes.len(), 6 * 4 * 3);
/// assert_eq!(grid.positions[0], Point::splat(-0.5));
/// # Ok::<(), hexmill::mesh::GridError>(())
/// ```
pub fn hex_grid(bounds: Aabb, options: &GridOptions) -> Result<HexMesh, GridError> {
    let (counts, spacing) = layout(bounds, options)?;
    let [nx, ny, nz] = counts;
    let (sx, sy) = (nx + 1, ny + 1);
    let size = spacing * Point::from(counts.map(|n| n as f64));
    let least = bounds.center() - size * 0.5;
    let position = |m: usize| {
        let at = [m % sx, m / sx % sy, m / sx / sy].map(|c| c as f64);
        least + Point::from(at) * spacing
    };
    let hex = |m: usize| {
        let at = [m % nx, m / nx % ny, m / nx / ny];
        CORNERS.map(|corner| {
            let [x, y, z] = [0, 1, 2].map(|i| at[i] + usize::from(corner[i]));
            NodeId::new(x + sx * (y + sy * z))
        })
    };
    Ok(HexMesh {
        positions: parallel::collect(sx * sy * (nz + 1), position),
        hexes: parallel::collect(nx * ny * nz, hex),
        ..HexMesh::default()
    })
}

/// How many hexes along each axis, and how long they are.
fn layout(bounds: Aabb, options: &GridOptions) -> Result<([usize; 3], Point), GridError> {
    let &GridOptions { spacing, margin, fitted, max_hexes } = options;
    if !(spacing > 0.0 && spacing.is_finite()) {
        return Err(GridError::Spacing(spacing));
    }
    if !(margin >= 0.0 && margin.is_finite()) {
        return Err(GridError::Margin(margin));
    }
    if bounds.is_empty() || !bounds.min.is_finite() || !bounds.max.is_finite() {
        return Err(GridError::Empty);
    }
    let grown = bounds.grown(margin);
    let counts = (grown.size() / spacing - Point::splat(ROUNDING)).ceil().max(Point::ONE);
    let limit = max_hexes.min(MOST_HEXES);
    let whole = counts.x * counts.y * counts.z;
    if whole.is_nan() || whole > limit as f64 {
        return Err(GridError::TooManyHexes { counts: counts.to_array(), limit });
    }
    let reach = grown.min.abs().max_element().max(grown.max.abs().max_element());
    if spacing < LEAST_STEPS * f64::EPSILON * reach {
        return Err(GridError::TooFewDigits { spacing, reach });
    }
    let fit = grown.size() / counts;
    let length = |along: f64| if fitted && along > 0.0 { along } else { spacing };
    Ok((counts.to_array().map(|n| n as usize), fit.map(length)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Volumes, check_hexes};

    const OPTIONS: GridOptions =
        GridOptions { spacing: 0.3, margin: 0.25, fitted: false, max_hexes: 1_000_000 };

    fn bounds() -> Aabb {
        Aabb { min: Point::new(-1.0, 2.0, 0.5), max: Point::new(1.0, 2.4, 1.7) }
    }

    #[test]
    fn grids_conform_and_hold_the_box_with_its_margin() {
        for fitted in [false, true] {
            let grid = hex_grid(bounds(), &GridOptions { fitted, ..OPTIONS }).unwrap();
            assert_eq!(grid.hexes.len(), 9 * 3 * 6);
            assert_eq!(check_hexes(&grid), []);
            let (inner, outer) = (bounds().grown(0.25 - 1e-12), grid.bounds());
            assert!(outer.min.cmple(inner.min).all() && outer.max.cmpge(inner.max).all());
            assert!(outer.center().distance(bounds().center()) < 1e-12);
            let volume = Volumes::of(&grid).unwrap();
            let expected = if fitted { 2.5 * 0.9 * 1.7 } else { 2.7 * 0.9 * 1.8 };
            assert!((volume.total - expected).abs() < 1e-12, "{volume:?}");
            let hex = expected / (9.0 * 3.0 * 6.0);
            assert!((volume.min - hex).abs() < 1e-12 && (volume.max - hex).abs() < 1e-12);
        }
    }

    #[test]
    fn whole_numbers_of_spacings_make_no_sliver() {
        let tenth = GridOptions { spacing: 0.1, margin: 0.0, ..OPTIONS };
        let unit = Aabb { min: Point::splat(0.2), max: Point::splat(0.5) };
        assert_eq!(hex_grid(unit, &tenth).unwrap().hexes.len(), 27);
    }

    #[test]
    fn a_flat_box_gets_one_layer() {
        let flat = Aabb { min: Point::ZERO, max: Point::new(1.0, 1.0, 0.0) };
        for fitted in [false, true] {
            let grid = hex_grid(flat, &GridOptions { spacing: 0.5, margin: 0.0, fitted, ..OPTIONS }).unwrap();
            assert_eq!(grid.hexes.len(), 4);
            assert_eq!(check_hexes(&grid), []);
        }
    }

    #[test]
    fn what_cannot_be_made_is_refused_before() {
        let refused = |options: GridOptions, bounds: Aabb| hex_grid(bounds, &options).unwrap_err().code();
        for spacing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(refused(GridOptions { spacing, ..OPTIONS }, bounds()), "spacing-out-of-range");
        }
        for margin in [-1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(refused(GridOptions { margin, ..OPTIONS }, bounds()), "margin-out-of-range");
        }
        assert_eq!(refused(OPTIONS, Aabb::EMPTY), "surface-empty");
        assert_eq!(refused(GridOptions { max_hexes: 100, ..OPTIONS }, bounds()), "too-many-hexes");
        let everything = GridOptions { max_hexes: u64::MAX, spacing: 1e-300, ..OPTIONS };
        assert_eq!(refused(everything, bounds()), "too-many-hexes");
        let far = Aabb { min: Point::splat(1e15), max: Point::splat(1e15) };
        assert_eq!(refused(OPTIONS, far), "too-few-digits");
        for (spacing, margin, words) in
            [(1.0, 1e300, "2.0e300 by 2.0e300 by"), (1e-320, 0.0, "more than 1e308 by")]
        {
            let options = GridOptions { spacing, margin, ..OPTIONS };
            let error = hex_grid(Aabb { min: Point::ZERO, max: Point::ONE }, &options).unwrap_err();
            assert!(error.to_string().starts_with(words), "{error}");
        }
        let error = hex_grid(bounds(), &GridOptions { max_hexes: 100, ..OPTIONS }).unwrap_err();
        assert_eq!(
            error.to_string(),
            "9 by 3 by 6 hexes are more than the limit of 100; raise the spacing or the limit"
        );
    }
}
