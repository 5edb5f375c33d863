// Faces of a polygon surface, flat-shaded, with their edges.
//
// A vertex is a node id; positions come from a texture of nodes, what belongs to a face from textures
// of faces. Edges are drawn by the fragments of the face itself: the distance to a side is its
// barycentric coordinate over the length of that coordinate's gradient, both in pixels.

struct Mesh {
    // Log2 of the width of the data textures.
    width_bits: u32,
    // 1: faces take their colour from the palette.
    coloured: u32,
    // 1: edges are drawn.
    edges: u32,
    // WebGL2 wants whole rows of 16 bytes.
    padding: u32,
}

@group(1) @binding(0) var<uniform> mesh: Mesh;
@group(1) @binding(1) var positions: texture_2d<f32>;
@group(1) @binding(2) var normals: texture_2d<u32>;
@group(1) @binding(3) var colours: texture_2d<u32>;
@group(1) @binding(4) var palette: texture_2d<f32>;
@group(2) @binding(0) var tags: texture_2d<u32>;

const FLAG_BITS: u32 = 5u;
const FLAG_POLYGON: u32 = 8u;
const FLAG_CAP: u32 = 16u;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    // Barycentric coordinates; 1 throughout where the side is a diagonal.
    @location(1) sides: vec3<f32>,
    @location(2) @interpolate(flat, either) normal: vec3<f32>,
    @location(3) @interpolate(flat, either) colour: vec3<f32>,
    // 1: the size of the triangle says nothing of the size of its face.
    @location(4) @interpolate(flat, either) polygon: f32,
    // 1: a cap, which stays bright whatever way it faces: what is in it matters more than its shape.
    @location(5) @interpolate(flat, either) cap: f32,
}

fn texel(index: u32) -> vec2<u32> {
    return vec2<u32>(index & ((1u << mesh.width_bits) - 1u), index >> mesh.width_bits);
}

fn unpack_normal(packed: u32) -> vec3<f32> {
    let octahedral = vec2<f32>(f32(packed & 0xffffu), f32(packed >> 16u)) / 65535.0 * 2.0 - 1.0;
    let z = 1.0 - abs(octahedral.x) - abs(octahedral.y);
    let fold = max(-z, 0.0);
    let signs = select(vec2<f32>(-1.0), vec2<f32>(1.0), octahedral >= vec2<f32>(0.0));
    return normalize(vec3<f32>(octahedral - fold * signs, z));
}

@vertex
fn vertex(@location(0) node: u32, @builtin(vertex_index) index: u32) -> Varying {
    let tag = textureLoad(tags, texel(index / 3u), 0).x;
    let face = texel(tag >> FLAG_BITS);
    let position = textureLoad(positions, texel(node), 0).xyz;
    let corner = index % 3u;
    let here = vec3<f32>(f32(corner == 0u), f32(corner == 1u), f32(corner == 2u));
    let is_diagonal = vec3<f32>(f32((tag & 1u) == 0u), f32((tag & 2u) == 0u), f32((tag & 4u) == 0u));
    var out: Varying;
    out.clip = frame.clip_from_scene * vec4<f32>(position, 1.0);
    out.position = position;
    out.sides = max(here, is_diagonal);
    out.normal = unpack_normal(textureLoad(normals, face, 0).x);
    out.cap = select(0.0, 1.0, (tag & FLAG_CAP) != 0u);
    out.colour = mix(frame.front.rgb, frame.cap.rgb, out.cap);
    if mesh.coloured != 0u {
        out.colour = textureLoad(palette, vec2<u32>(textureLoad(colours, face, 0).x, 0u), 0).rgb;
    }
    out.polygon = select(0.0, 1.0, (tag & FLAG_POLYGON) != 0u);
    return out;
}

// Light from above left of the eye, a weaker one from the right, and from all around. On average 0.8, at
// most 1.
fn light(normal: vec3<f32>, to_eye: vec3<f32>) -> f32 {
    let n = (frame.view_from_scene * vec4<f32>(normal, 0.0)).xyz;
    let key = max(dot(n, normalize(vec3<f32>(-0.45, 0.65, 0.75))), 0.0);
    let fill = max(dot(n, normalize(vec3<f32>(0.8, -0.1, 0.5))), 0.0);
    let head = max(dot(normal, to_eye), 0.0);
    let sky = 0.5 + 0.5 * n.y;
    return min(0.28 + 0.14 * sky + 0.42 * key + 0.14 * fill + 0.14 * head, 1.0);
}

// How much of the pixel the edges cover. They fade where cells are too small to be told apart: all edges of a cell
// alike, by its area.
fn edge_cover(sides: vec3<f32>, polygon: f32) -> f32 {
    let dx = dpdx(sides);
    let dy = dpdy(sides);
    let gradient = max(sqrt(dx * dx + dy * dy), vec3<f32>(1e-9));
    let half_width = 0.5 * frame.canvas.w;
    let distance = max(sides, vec3<f32>(0.0)) / gradient;
    let cover = 1.0 - smoothstep(vec3<f32>(half_width - 0.5), vec3<f32>(half_width + 0.5), distance);
    // Two coordinates change by the inverse of twice the triangle's area; the third is a diagonal's, or does as they do.
    let change = abs(cross(dx, dy));
    let width = inverseSqrt(max(max(change.x, change.y), max(change.z, 1e-9))) / frame.canvas.w;
    let fade = max(smoothstep(2.5, 8.0, width), polygon);
    return fade * max(cover.x, max(cover.y, cover.z));
}

// How far outside the unit solid a point is: 0 on its surface, negative inside.
fn outside(solid: f32, p: vec3<f32>) -> f32 {
    if solid < 0.5 {
        return max(abs(p.x), max(abs(p.y), abs(p.z))) - 1.0;
    }
    if solid < 1.5 {
        return length(p) - 1.0;
    }
    return max(length(p.xy), abs(p.z)) - 1.0;
}

// The colour with what lies in a region tinted, unless colours mean something, and a line where the surface crosses
// a region's.
fn mark_regions(position: vec3<f32>, plain: vec3<f32>) -> vec3<f32> {
    var colour = plain;
    for (var i = 0u; i < min(frame.counts.x, REGIONS); i++) {
        let region = frame.regions[i];
        let depth = outside(region.colour_solid.w, (region.unit_from_scene * vec4<f32>(position, 1.0)).xyz);
        let pixels = depth / max(length(vec2<f32>(dpdx(depth), dpdy(depth))), 1e-9);
        let line = 1.0 - smoothstep(frame.canvas.z - 0.5, frame.canvas.z + 0.5, abs(pixels));
        let inside = 1.0 - smoothstep(-0.5, 0.5, pixels);
        let tint = 0.16 * inside * (1.0 - f32(mesh.coloured));
        colour = mix(colour, region.colour_solid.rgb, max(tint, 0.9 * line));
    }
    return colour;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let to_eye = towards_eye(in.position);
    // The face's own normal decides on its side: a bent quad shows one side, not two. Faces seen along
    // their plane count as fronts, which keeps silhouettes clean.
    let facing = dot(in.normal, to_eye);
    let is_back = smoothstep(0.02, 0.1, -facing);
    let normal = in.normal * select(-1.0, 1.0, facing >= 0.0);
    var colour: vec3<f32>;
    if mesh.coloured != 0u {
        // Less shade and no tint: a colour must be found again in the legend.
        colour = in.colour * mix(0.55 + 0.45 * light(normal, to_eye), 0.6, 0.6 * is_back);
    } else {
        let shade = light(normal, to_eye);
        colour = mix(in.colour, frame.back.rgb, is_back) * mix(shade, 0.55 + 0.45 * shade, in.cap);
    }
    let cover = edge_cover(in.sides, in.polygon) * f32(mesh.edges) * frame.edge.a;
    return vec4<f32>(mark_regions(in.position, mix(colour, frame.edge.rgb, cover)), 1.0);
}
