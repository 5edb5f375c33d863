// Discs of constant size on the screen.

// Opacity of this pass: discs behind the mesh are drawn again, faintly.
override opacity: f32 = 1.0;
// 1: over everything, 0: where the disc's middle is.
override on_top: f32 = 0.0;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    // From the middle, in device pixels.
    @location(0) offset: vec2<f32>,
    // Radius and width of the ring, in device pixels.
    @location(1) @interpolate(flat, either) size: vec2<f32>,
    @location(2) fill: vec4<f32>,
    @location(3) rim: vec4<f32>,
}

@vertex
fn vertex(
    @builtin(vertex_index) index: u32,
    @location(0) center: vec3<f32>,
    @location(1) size: vec2<f32>,
    @location(2) fill: vec4<f32>,
    @location(3) rim: vec4<f32>,
) -> Varying {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let pixels = size * frame.canvas.z;
    let offset = corner * (pixels.x + 1.0);
    var clip = frame.clip_from_scene * vec4<f32>(center, 1.0);
    clip += vec4<f32>(offset / (0.5 * frame.canvas.xy) * clip.w, 0.0, 0.0);
    // A hair towards the eye: corners lie on surfaces.
    clip.z = mix(clip.z - 4e-5 * clip.w, 0.0, on_top);
    return Varying(clip, offset, pixels, fill, rim);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let distance = length(in.offset);
    let inside = 1.0 - smoothstep(in.size.x - in.size.y - 0.5, in.size.x - in.size.y + 0.5, distance);
    let cover = 1.0 - smoothstep(in.size.x - 0.5, in.size.x + 0.5, distance);
    let colour = mix(in.rim, in.fill, inside);
    return vec4<f32>(colour.rgb, colour.a * cover * opacity);
}
