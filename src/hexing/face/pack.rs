//! Points inside a region, about 2h apart, in rows along its curves where a field says which way these run.
//!
//! A front goes out from the constrained nodes: each point puts one in each of the four directions of the cross, a length
//! away, unless it would be outside, or too close to another point or to a constrained segment. (After Baudouin, Remacle,
//! Marchandise, Henrotte, Geuzaine, "A frontal approach to hex-dominant mesh generation", 2014, whose measure of
//! closeness is another one.)

use std::collections::HashMap;

use glam::DVec2;

use super::field::{Field, Frame};
use super::mesher::PACK;
use super::sample::Samples;
use super::triangulation::Triangulation;
use crate::{Cancelled, Monitor};

/// Points closer than this, in units of the lengths there, are not put.
const APART: f64 = 0.7;

/// Points closer than this to a constrained segment, in units of the length across, are not put.
const OFF_CURVES: f64 = 0.6;

/// Points between two questions to the monitor.
const BATCH: usize = 1 << 10;

/// The region to be filled.
pub(super) struct Ground<'a> {
    pub(super) samples: &'a Samples,
    /// The triangulation of the coarse samples alone, and which of its faces are of the region.
    pub(super) triangulation: &'a Triangulation,
    pub(super) inside: &'a [bool],
    /// About how many points are to be expected, for the progress.
    pub(super) expected: f64,
}

/// The coarse samples, and points between them. Without a field, rows follow the nearest segments.
pub(super) fn pack(
    ground: &Ground,
    field: Option<&Field>,
    part: [f64; 2],
    monitor: &dyn Monitor,
) -> Result<Vec<DVec2>, Cancelled> {
    let mut packing = Packing::new(ground);
    let mut next = 0;
    while next < packing.points.len() {
        if next % BATCH == 0 {
            let done = (next as f64 / ground.expected).min(1.0);
            monitor.checkpoint(PACK, part[0] + (part[1] - part[0]) * done)?;
        }
        packing.spread(next, field);
        next += 1;
    }
    Ok(packing.points)
}

struct Packing<'a> {
    ground: &'a Ground<'a>,
    points: Vec<DVec2>,
    /// What each point is found by.
    near: Vec<Near>,
    /// The frame that each point was put by.
    frames: Vec<Frame>,
    bins: HashMap<[i32; 2], Vec<u32>>,
    segments: HashMap<[i32; 2], Vec<u32>>,
}

/// Nodes close to a point, where the search for its triangle begins.
#[derive(Clone, Copy)]
struct Near {
    sample: u32,
    of_field: u32,
}

fn bin(p: DVec2) -> [i32; 2] {
    [p.x.floor() as i32, p.y.floor() as i32]
}

impl<'a> Packing<'a> {
    fn new(ground: &'a Ground<'a>) -> Self {
        let samples = ground.samples;
        let points = samples.points[..samples.coarse].to_vec();
        let mut frames = vec![Frame { axes: [DVec2::X, DVec2::Y], lengths: [1.0; 2] }; points.len()];
        let mut bins: HashMap<_, Vec<u32>> = HashMap::new();
        for (p, &point) in points.iter().enumerate() {
            bins.entry(bin(point)).or_default().push(p as u32);
        }
        let mut segments: HashMap<_, Vec<u32>> = HashMap::new();
        for (s, segment) in samples.segments.iter().enumerate() {
            let [a, b] = segment.ends.map(|end| points[end as usize]);
            let ([x0, y0], [x1, y1]) = (bin(a.min(b)), bin(a.max(b)));
            for x in x0..=x1 {
                for y in y0..=y1 {
                    segments.entry([x, y]).or_default().push(s as u32);
                }
            }
            let axis = (b - a).normalize();
            for end in segment.ends {
                frames[end as usize].axes = [axis, axis.perp()];
            }
        }
        let near = (0..points.len() as u32).map(|sample| Near { sample, of_field: sample }).collect();
        Self { ground, points, near, frames, bins, segments }
    }

    /// Puts points around the one with number `p`.
    fn spread(&mut self, p: usize, field: Option<&Field>) {
        let (from, near) = (self.points[p], self.near[p]);
        let here = match field {
            None => self.frames[p],
            Some(field) if p < self.ground.samples.coarse => field.at_node(p as u32),
            Some(field) => field.at(from, near.of_field).map_or(self.frames[p], |(frame, _)| frame),
        };
        let ways = [here.axes[0], here.axes[1], -here.axes[0], -here.axes[1]];
        for (k, way) in ways.into_iter().enumerate() {
            let step = way * here.lengths[k % 2];
            let (mut to, mut frame, mut near) = (from + step, here, near);
            if let Some(field) = field {
                // The midpoint rule: half as far along, the way has turned half as much.
                if let Some((middle, at)) = field.at(from + step * 0.5, near.of_field) {
                    let (way, length) = middle.along(way);
                    (to, near.of_field) = (from + way * length, at);
                }
                (frame, near.of_field) = field.at(to, near.of_field).unwrap_or((here, near.of_field));
            }
            if self.is_free(to, &frame, near.sample) {
                self.put(to, near, frame);
            }
        }
    }

    fn put(&mut self, point: DVec2, near: Near, frame: Frame) {
        self.bins.entry(bin(point)).or_default().push(self.points.len() as u32);
        self.points.push(point);
        self.near.push(near);
        self.frames.push(frame);
    }

    fn is_free(&self, point: DVec2, frame: &Frame, sample: u32) -> bool {
        let [x, y] = bin(point);
        let around = (-2..=2).flat_map(|dx| (-2..=2).map(move |dy| [x + dx, y + dy]));
        let crowded = around.clone().filter_map(|b| self.bins.get(&b)).flatten().any(|&p| {
            let way = frame.measure(self.points[p as usize] - point);
            way.length_squared() < APART * APART
        });
        if crowded {
            return false;
        }
        let at_curve = around.filter_map(|b| self.segments.get(&b)).flatten().any(|&s| {
            let [a, b] = self.ground.samples.segments[s as usize].ends.map(|end| self.points[end as usize]);
            let along = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            frame.measure(a.lerp(b, along) - point).length_squared() < OFF_CURVES * OFF_CURVES
        });
        let located = self.ground.triangulation.locate(point, sample);
        !at_curve && located.is_some_and(|(face, _)| self.ground.inside[face])
    }
}
