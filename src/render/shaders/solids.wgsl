// Translucent surfaces of regions: clear where they face the eye, denser towards their silhouette, and nothing but
// their silhouette over faces whose colours mean something.

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) colour: vec4<f32>,
}

@vertex
fn vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec4<f32>,
    @location(2) colour: vec4<f32>,
) -> Varying {
    return Varying(frame.clip_from_scene * vec4<f32>(position, 1.0), position, normal.xyz, colour);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let facing = abs(dot(normalize(in.normal), towards_eye(in.position)));
    let rim = pow(1.0 - facing, 3.0);
    let body = 1.0 - f32(frame.counts.y);
    return vec4<f32>(in.colour.rgb, in.colour.a * (body + 3.0 * rim));
}
