// Lines of constant width on the screen: each segment is a rectangle of pixels around it.

// Opacity of this pass: lines behind the mesh are drawn again, faintly.
override opacity: f32 = 1.0;
// 1: over everything, 0: where the line is.
override on_top: f32 = 0.0;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) colour: vec4<f32>,
    // Distance from the line's middle, and half its width, in device pixels.
    @location(1) across: f32,
    @location(2) @interpolate(flat, either) half_width: f32,
}

// Clip positions behind the eye have no place on the screen: such an end is moved to just before it.
fn before_eye(end: vec4<f32>, other: vec4<f32>) -> vec4<f32> {
    let least = 1e-5 * max(abs(end.w), abs(other.w));
    if end.w >= least || other.w < least {
        return end;
    }
    return mix(other, end, (other.w - least) / (other.w - end.w));
}

@vertex
fn vertex(
    @builtin(vertex_index) index: u32,
    @location(0) start: vec3<f32>,
    @location(1) end: vec3<f32>,
    @location(2) width: f32,
    @location(3) colour: vec4<f32>,
) -> Varying {
    let a = frame.clip_from_scene * vec4<f32>(start, 1.0);
    let b = frame.clip_from_scene * vec4<f32>(end, 1.0);
    let from_clip = before_eye(a, b);
    let to_clip = before_eye(b, a);
    let half_canvas = 0.5 * frame.canvas.xy;
    let way = (to_clip.xy / to_clip.w - from_clip.xy / from_clip.w) * half_canvas;
    let along = select(vec2<f32>(1.0, 0.0), normalize(way), dot(way, way) > 1e-12);
    let across = vec2<f32>(-along.y, along.x);
    // Corners 0 and 1 at the start, 2 and 3 at the end; half a pixel of room for the soft side.
    let at_end = f32(index >> 1u);
    let side = f32(index & 1u) * 2.0 - 1.0;
    let half_width = 0.5 * width * frame.canvas.z;
    let room = half_width + 0.5;
    let offset = across * side * room + along * (at_end * 2.0 - 1.0) * half_width * 0.5;
    let place = mix(from_clip.xyz / from_clip.w, to_clip.xyz / to_clip.w, at_end);
    // Divided by w already, so that the distance across is interpolated along the screen. A hair towards
    // the eye: outlines lie on surfaces.
    let depth = mix(place.z - 2e-5, 0.0, on_top);
    let clip = vec4<f32>(place.xy + offset / half_canvas, depth, 1.0);
    return Varying(clip, vec4<f32>(colour.rgb, colour.a * opacity), side * room, half_width);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let cover = 1.0 - smoothstep(in.half_width - 0.5, in.half_width + 0.5, abs(in.across));
    return vec4<f32>(in.colour.rgb, in.colour.a * cover);
}
