//! What lies over the mesh: regions, handles, the pivot and the triad of axes, as draw buffers.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, Vec3};

use super::{Frame, Grip, Handle, Placement, Rgba, Scene, Solid, Theme, camera::corners};
use crate::geometry::{Aabb, Point};

/// A corner of a translucent surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SolidVertex {
    /// Scene coordinates.
    pub position: Vec3,
    /// Outward unit normal times 127.
    pub normal: [i8; 4],
    /// Colour, with the opacity where the surface faces the eye.
    pub colour: Rgba,
}

/// A line of constant width on the screen.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Segment {
    /// One end, in scene coordinates.
    pub from: Vec3,
    /// The other end.
    pub to: Vec3,
    /// Width in CSS pixels.
    pub width: f32,
    /// Colour.
    pub colour: Rgba,
}

/// A disc of constant size on the screen.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Disc {
    /// Its middle, in scene coordinates.
    pub center: Vec3,
    /// Radius with the ring, in CSS pixels.
    pub radius: f32,
    /// Width of the ring, in CSS pixels.
    pub ring: f32,
    /// Colour inside.
    pub fill: Rgba,
    /// Colour of the ring.
    pub rim: Rgba,
}

/// Regions, and the features of a solid: they change only when those do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RegionBuffers {
    /// Triangles, three corners each.
    pub solids: Vec<SolidVertex>,
    /// Outlines, and lines of features.
    pub outlines: Vec<Segment>,
    /// Points of features.
    pub discs: Vec<Disc>,
}

/// What is drawn over everything else; it depends on the camera.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrontBuffers {
    /// Lines, drawn in order.
    pub lines: Vec<Segment>,
    /// Discs, drawn in order after the lines.
    pub discs: Vec<Disc>,
}

/// Opacity of a region where it faces the eye, and the selected one's.
const OPACITY: u8 = 20;
const OPACITY_SELECTED: u8 = 34;
/// Widths and radii in CSS pixels.
const OUTLINE: f32 = 1.25;
const OUTLINE_SELECTED: f32 = 1.75;
/// Opacity of outlines; the circles of a ball are only there to show that it is round.
const OUTLINE_OPACITY: u8 = 230;
const CIRCLE_OPACITY: u8 = 110;
pub(super) const KNOB: f32 = 6.5;
pub(super) const KNOB_HOVERED: f32 = 8.5;
pub(super) const KNOB_RING: f32 = 2.0;
const PIVOT: f32 = 4.5;
/// Where the triad stands, from the lower left corner that is not covered, and the length of its arms.
const TRIAD: f64 = 46.0;
const TRIAD_ARM: f64 = 27.0;
const TRIAD_LETTER: f64 = 3.6;
/// A view that is free over fewer CSS pixels than this is too narrow for the triad beside what covers its lower end.
const TRIAD_BESIDE: f64 = 640.0;

fn with_alpha([r, g, b, _]: Rgba, alpha: u8) -> Rgba {
    [r, g, b, alpha]
}

/// Buffers of all regions.
pub(super) fn region_buffers(
    placements: &[Option<Placement>],
    selected: Option<usize>,
    frame: &Frame,
    theme: &Theme,
) -> RegionBuffers {
    let mut out = RegionBuffers::default();
    for (i, placement) in placements.iter().enumerate() {
        let Some(placement) = placement else { continue };
        let is_selected = selected == Some(i);
        let colour = if is_selected { theme.selected } else { theme.region };
        let opacity = if is_selected { OPACITY_SELECTED } else { OPACITY };
        let width = if is_selected { OUTLINE_SELECTED } else { OUTLINE };
        let line_opacity = if placement.solid == Solid::Ball { CIRCLE_OPACITY } else { OUTLINE_OPACITY };
        out.solids.extend(placement.surface().into_iter().map(|p| {
            let n = (p.normal * 127.0).round();
            SolidVertex {
                position: frame.scene(p.position),
                normal: [n.x as i8, n.y as i8, n.z as i8, 0],
                colour: with_alpha(colour, opacity),
            }
        }));
        out.outlines.extend(placement.outline().into_iter().map(|[a, b]| Segment {
            from: frame.scene(a),
            to: frame.scene(b),
            width,
            colour: with_alpha(colour, line_opacity),
        }));
    }
    out
}

/// The edges of a box.
pub(super) fn box_outline(bounds: &Aabb, frame: &Frame, theme: &Theme) -> Vec<Segment> {
    let ends: Vec<_> = corners(bounds).map(|p| frame.scene(p)).collect();
    let edge = |a: usize, bit: usize| Segment {
        from: ends[a],
        to: ends[a | bit],
        width: OUTLINE,
        colour: with_alpha(theme.section, CIRCLE_OPACITY),
    };
    let edges = (0..ends.len()).flat_map(|a| [1, 2, 4].map(|bit| (a, bit)));
    edges.filter(|(a, bit)| a & bit == 0).map(|(a, bit)| edge(a, bit)).collect()
}

/// Buffers of handles, pivot and triad.
pub(super) fn front_buffers(scene: &Scene) -> FrontBuffers {
    let theme = scene.style.background.theme();
    let frame = scene.frame();
    let mut out = FrontBuffers::default();
    if let Some(pivot) = scene.pivot_shown() {
        out.discs.push(Disc {
            center: frame.scene(pivot),
            radius: PIVOT,
            ring: 1.5,
            fill: theme.selected,
            rim: theme.handle,
        });
    }
    scene.add_cutaway(&mut out, &theme);
    add_handles(&mut out, &scene.handles(), scene.hovered(), &frame, &theme);
    add_triad(&mut out, scene, &frame, &theme);
    out
}

fn add_handles(
    out: &mut FrontBuffers,
    handles: &[Handle],
    hovered: Option<Grip>,
    frame: &Frame,
    theme: &Theme,
) {
    let Some(center) = handles.last() else { return };
    for handle in handles {
        let colour = match handle.grip {
            Grip::Axis(axis) => theme.axes[axis],
            _ => theme.selected,
        };
        let is_hovered = hovered == Some(handle.grip);
        if let Grip::Axis(_) = handle.grip {
            out.lines.push(Segment {
                from: frame.scene(center.at),
                to: frame.scene(handle.at),
                width: if is_hovered { 3.5 } else { 2.5 },
                colour,
            });
        }
        let is_solid = is_hovered || matches!(handle.grip, Grip::Axis(_));
        out.discs.push(Disc {
            center: frame.scene(handle.at),
            radius: if is_hovered { KNOB_HOVERED } else { KNOB },
            ring: KNOB_RING,
            fill: if is_solid { colour } else { theme.handle },
            rim: if is_solid { theme.handle } else { colour },
        });
    }
}

/// The strokes of the letters x, y and z in a square from -1 to 1, y down.
const LETTERS: [&[[[f64; 2]; 2]]; 3] = [
    &[[[-0.8, -1.0], [0.8, 1.0]], [[-0.8, 1.0], [0.8, -1.0]]],
    &[[[-0.8, -1.0], [0.0, 0.0]], [[0.8, -1.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, 1.0]]],
    &[[[-0.8, -1.0], [0.8, -1.0]], [[0.8, -1.0], [-0.8, 1.0]], [[-0.8, 1.0], [0.8, 1.0]]],
];

/// Three arms that show where x, y and z go; those that point away are drawn first.
fn add_triad(out: &mut FrontBuffers, scene: &Scene, frame: &Frame, theme: &Theme) {
    let [right, up, forward] = scene.camera.axes();
    let [side, end] = scene.style.covered;
    let is_narrow = scene.viewport.width - 2.0 * side < TRIAD_BESIDE;
    let floor = scene.viewport.height - if is_narrow { end } else { 0.0 };
    let origin = DVec2::new(side + TRIAD, floor - TRIAD);
    let place = |pixel: DVec2| {
        let at: Point = scene.camera.point_at_depth_of(scene.camera.target(), pixel, scene.viewport);
        frame.scene(at)
    };
    let mut arms = [0, 1, 2];
    arms.sort_by(|&a, &b| forward[b].total_cmp(&forward[a]));
    for axis in arms {
        let direction = DVec2::new(right[axis], -up[axis]);
        let tip = origin + direction * TRIAD_ARM;
        let colour = theme.axes[axis];
        out.lines.push(Segment { from: place(origin), to: place(tip), width: 2.0, colour });
        // A letter stands beyond the tip; an arm that points at the eye or away has no room for one.
        let length = direction.length();
        if length < 0.2 {
            continue;
        }
        let middle = tip + direction / length * 9.0;
        for stroke in LETTERS[axis] {
            let [from, to] = stroke.map(|p| place(middle + DVec2::from_array(p) * TRIAD_LETTER));
            out.lines.push(Segment { from, to, width: 1.6, colour });
        }
    }
}
