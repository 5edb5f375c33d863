// What all drawables share: one uniform a frame, and conversions of clip space.

// A region: where faces cross its surface they are marked.
struct Region {
    // Scene to the coordinates of its unit solid.
    unit_from_scene: mat4x4<f32>,
    // Colour, and the solid: 0 cube, 1 ball, 2 cylinder.
    colour_solid: vec4<f32>,
}

const REGIONS: u32 = 16u;

struct Frame {
    clip_from_scene: mat4x4<f32>,
    // Directions: scene to view, x right, y up, z towards the eye.
    view_from_scene: mat4x4<f32>,
    // The eye in the scene (w = 1), or the direction towards it of an orthographic view (w = 0).
    eye: vec4<f32>,
    // Canvas in device pixels, device pixels a CSS pixel, edge width in device pixels.
    canvas: vec4<f32>,
    ground_top: vec4<f32>,
    ground_bottom: vec4<f32>,
    front: vec4<f32>,
    back: vec4<f32>,
    // Faces inside a hex mesh that a cut brings to light.
    cap: vec4<f32>,
    edge: vec4<f32>,
    // x: how many regions there are. y: 1 where the colours of faces mean something.
    counts: vec4<u32>,
    regions: array<Region, REGIONS>,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// Unit vector from a scene point towards the eye.
fn towards_eye(position: vec3<f32>) -> vec3<f32> {
    return normalize(frame.eye.xyz - position * frame.eye.w);
}
