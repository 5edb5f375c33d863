//! What options may be, and how that is told.

use hexmill::refine::QuadOptions;
use hexmill::refine::hex::HexOptions;

/// A finite number above zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("give a number above 0".to_owned()),
    }
}

/// Levels that can be asked for, of surfaces; the fewer of hexes are held against what is read.
pub(super) fn levels(text: &str) -> Result<u8, String> {
    let (most, of_hexes) = (QuadOptions::DEEPEST_LEVEL, HexOptions::DEEPEST_LEVEL);
    let levels = text.parse().ok().filter(|&levels| levels <= most);
    levels.ok_or_else(|| format!("give a whole number from 0 to {most}, of hexes to {of_hexes}"))
}

/// Degrees of a turn.
pub(super) fn angle(text: &str) -> Result<f64, String> {
    positive(text).ok().filter(|&angle| angle <= 180.0).ok_or("give a number above 0, at most 180".to_owned())
}

/// Degrees between the normals of two faces, less than those of faces that lie on each other.
pub(super) fn feature_angle(text: &str) -> Result<f64, String> {
    positive(text).ok().filter(|&angle| angle < 180.0).ok_or("give a number above 0, below 180".to_owned())
}

/// A growth from element to element.
pub(super) fn gradation(text: &str) -> Result<f64, String> {
    positive(text).ok().filter(|&g| g > 1.0 && g <= 2.0).ok_or("give a number above 1, at most 2".to_owned())
}
