//! The area of the shadow that a solid throws along a direction: the paper's projection surface.
//!
//! Drawn as an image of bits; only the half of the triangles that looks along the direction is needed. On the solids of
//! the tests it agrees with the exact area to 0.4 %.

use crate::geometry::{Aabb, Frame, Point};
use crate::solid::SolidModel;

/// Pixels along the longer side of the shadow.
const PIXELS: usize = 512;

/// A solid's shadow along a direction, and how long it is that way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shadow {
    pub area: f64,
    pub depth: f64,
}

/// The shadow of a solid along a unit direction.
pub(super) fn shadow(solid: &SolidModel, direction: Point) -> Shadow {
    let frame = Frame::along(solid.bounds().center(), direction);
    let points: Vec<Point> = solid.points().iter().map(|&p| frame.local(p)).collect();
    let bounds = Aabb::around(&points);
    let size = bounds.size();
    let pixel = size.x.max(size.y) / PIXELS as f64;
    let mut image = Image::default();
    for (triangle, normal) in solid.triangles().iter().zip(solid.normals()) {
        if normal.dot(direction) > 0.0 {
            image.draw(triangle.map(|v| (points[v as usize] - bounds.min) / pixel));
        }
    }
    Shadow { area: image.filled() as f64 * pixel * pixel, depth: size.z }
}

/// Rows of bits.
struct Image {
    words: Vec<u64>,
}

/// Words in a row: one more than its pixels need, so that no run ends outside.
const WORDS: usize = PIXELS / 64 + 1;

impl Default for Image {
    fn default() -> Self {
        Self { words: vec![0; PIXELS * WORDS] }
    }
}

impl Image {
    /// Fills the pixels whose middles lie in a triangle; a unit is a pixel.
    fn draw(&mut self, corners: [Point; 3]) {
        let bounds = Aabb::around(&corners);
        for row in middles(bounds.min.y, bounds.max.y) {
            let y = row as f64 + 0.5;
            let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
            for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j])) {
                if (a.y <= y) != (b.y <= y) {
                    let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
                    (left, right) = (left.min(x), right.max(x));
                }
            }
            if left <= right {
                self.fill(row, middles(left, right));
            }
        }
    }

    fn fill(&mut self, row: usize, pixels: std::ops::Range<usize>) {
        let row = &mut self.words[row * WORDS..(row + 1) * WORDS];
        let mut at = pixels.start;
        while at < pixels.end {
            let (word, bit) = (at / 64, at % 64);
            let run = (64 - bit).min(pixels.end - at);
            row[word] |= (u64::MAX >> (64 - run)) << bit;
            at += run;
        }
    }

    fn filled(&self) -> u32 {
        self.words.iter().map(|w| w.count_ones()).sum()
    }
}

/// The pixels whose middles lie between two places.
fn middles(from: f64, to: f64) -> std::ops::Range<usize> {
    let place = |x: f64| ((x + 0.5).floor().max(0.0) as usize).min(PIXELS);
    place(from)..place(to)
}
