//! Coordinate frames: a place and an orientation.

use glam::{DMat3, DQuat};

use super::Point;

/// A right-handed orthonormal frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    origin: Point,
    /// Rows are the frame's axes.
    local_from_world: DMat3,
}

impl Frame {
    /// The frame at `origin`, turned by a unit quaternion.
    pub fn new(origin: Point, rotation: DQuat) -> Self {
        Self { origin, local_from_world: DMat3::from_quat(rotation).transpose() }
    }

    /// The frame at `origin` with these axes: right-handed, of unit length, perpendicular.
    pub fn with_axes(origin: Point, axes: DMat3) -> Self {
        Self { origin, local_from_world: axes.transpose() }
    }

    /// A frame at `origin` whose z axis has the direction of the unit vector `z`.
    pub fn along(origin: Point, z: Point) -> Self {
        let (x, y) = z.any_orthonormal_pair();
        Self { origin, local_from_world: DMat3::from_cols(x, y, z).transpose() }
    }

    /// The coordinates of `p` in this frame.
    pub fn local(&self, p: Point) -> Point {
        self.local_from_world * (p - self.origin)
    }

    /// The point that has the coordinates `p` in this frame.
    pub fn world(&self, p: Point) -> Point {
        self.local_from_world.transpose() * p + self.origin
    }

    /// Half the edge lengths, in the world's axes, of the smallest box around a local box with half edges `half`.
    pub fn world_half(&self, half: Point) -> Point {
        self.local_from_world.transpose().abs() * half
    }

    /// Its axes, as columns.
    pub fn axes(&self) -> DMat3 {
        self.local_from_world.transpose()
    }

    /// The origin.
    pub fn origin(&self) -> Point {
        self.origin
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let p = Point::new(1.0, -2.0, 3.0);
        let turned = Frame::new(Point::ONE, DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5));
        assert_eq!(turned.world(Point::X), Point::ONE + Point::Y, "the turn takes x to y");
        assert!(turned.world(turned.local(p)).distance(p) < 1e-15);
        let along = Frame::along(Point::ONE, Point::new(0.6, 0.0, -0.8));
        assert!(along.local(Point::ONE + Point::new(0.6, 0.0, -0.8)).distance(Point::Z) < 1e-15);
        assert!(along.world(along.local(p)).distance(p) < 1e-15);
    }
}
