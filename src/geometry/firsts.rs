//! Of many points a few that stand for those around.

use std::collections::HashMap;

use super::Point;

/// Tells of points that come one after the other which of them are the first in their cubes.
pub(crate) struct Firsts {
    origin: Point,
    /// The side of a cube.
    size: f64,
    /// Of each block of four by four by four cubes those that have a point.
    taken: HashMap<[u32; 3], u64>,
}

impl Firsts {
    /// None yet of the points beyond `origin`, in cubes of this size.
    pub(crate) fn new(origin: Point, size: f64) -> Self {
        Self { origin, size, taken: HashMap::new() }
    }

    /// Is a point the first in its cube?
    pub(crate) fn is_first(&mut self, p: Point) -> bool {
        let cube = ((p - self.origin) / self.size).to_array().map(|x| x as u32);
        let [x, y, z] = cube.map(|x| x % 4);
        let (taken, cube) = (self.taken.entry(cube.map(|x| x / 4)).or_default(), 1 << (16 * z + 4 * y + x));
        let is_first = *taken & cube == 0;
        *taken |= cube;
        is_first
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten cubes a side, each with three points that come one after the other and once more in the end.
    #[test]
    fn each_cube_has_one_first_point() {
        let origin = Point::new(-7.0, 3.0, 1e3);
        let mut firsts = Firsts::new(origin, 0.5);
        let cubes =
            (0..1000).map(|k| Point::new(f64::from(k % 10), f64::from(k / 10 % 10), f64::from(k / 100)));
        let points = |at: f64| cubes.clone().map(move |cube| origin + 0.5 * (cube + at));
        assert!(points(0.5).all(|p| firsts.is_first(p)));
        assert!([0.01, 0.99, 0.5].into_iter().flat_map(points).all(|p| !firsts.is_first(p)));
    }
}
