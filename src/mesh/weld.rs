//! Points at the same place.

use crate::geometry::Point;
use crate::parallel;

/// For each point the first that has the same coordinates, to the last bit; 0 and -0 are the same.
pub fn first_of_same(points: &[Point]) -> Vec<u32> {
    // Adding 0 makes of -0 a 0, whose bits differ.
    let mut order: Vec<([u64; 3], u32)> =
        points.iter().zip(0..).map(|(&p, v)| ((p + 0.0).to_array().map(f64::to_bits), v)).collect();
    parallel::sort(&mut order);
    let mut first: Vec<u32> = (0..points.len() as u32).collect();
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        same.iter().for_each(|&(_, v)| first[v as usize] = same[0].1);
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_stands_for_all() {
        let points = [[1.0, 2.0, 3.0], [0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [-0.0, 0.0, -0.0], [1.0, 2.0, 3.5]];
        assert_eq!(first_of_same(&points.map(Point::from)), [0, 1, 0, 1, 4]);
        assert_eq!(first_of_same(&[]), [0; 0]);
    }
}
