// A soft gradient over the whole canvas.

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) height: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    // One triangle that covers the canvas.
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return Varying(vec4<f32>(corner, 0.0, 1.0), corner.y * 0.5 + 0.5);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    // A step of noise below what an eye sees keeps the gradient from banding.
    let noise = fract(sin(dot(in.clip.xy, vec2<f32>(12.9898, 78.233))) * 43758.547) - 0.5;
    return mix(frame.ground_bottom, frame.ground_top, in.height) + noise / 255.0;
}
