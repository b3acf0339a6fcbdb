// The density map of a lamp. Needs `common`, `layers` and `ribbon`.

@group(1) @binding(0) var places: texture_2d<f32>;
@group(1) @binding(1) var first_hair: texture_2d_array<f32>;
@group(1) @binding(2) var smooth_sampler: sampler;
// x: the lamp; y: factor on the width of hairs.
@group(2) @binding(0) var<uniform> current: vec4<f32>;
// First vertices of pieces.
@group(3) @binding(0) var pieces: texture_2d<u32>;

struct First {
    @builtin(position) at: vec4<f32>,
    @location(0) @interpolate(flat) depth: f32,
}

// The nearest hair: a square of three texels around each vertex.
@vertex
fn first_vertex(@builtin(vertex_index) vertex: u32) -> First {
    var out: First;
    let first = textureLoad(pieces, texel(piece_of(vertex)), 0).x;
    let corner = corner_of(vertex);
    let lamp = picture.lamps[i32(current.x)];
    let m = in_hair_map(lamp, textureLoad(places, texel(first), 0).xyz);
    let side = vec2<f32>(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    let uv = m.xy / lamp.hair.z * 2.0 - 1.0 + side * 3.0 / current.z;
    out.at = vec4<f32>(uv.x, -uv.y, 0.5, 1.0);
    out.depth = m.z;
    return out;
}

@fragment
fn nearest(in: First) -> @location(0) vec4<f32> {
    return vec4<f32>(in.depth, 0.0, 0.0, 0.0);
}

struct Ribbon {
    @builtin(position) at: vec4<f32>,
    @location(0) offset: f32,
    @location(1) depth: f32,
    @location(2) @interpolate(flat) shape: vec2<f32>,
}

@vertex
fn ribbon(@builtin(vertex_index) vertex: u32) -> Ribbon {
    var out: Ribbon;
    let first = textureLoad(pieces, texel(piece_of(vertex)), 0).x;
    let lamp = picture.lamps[i32(current.x)];
    let a = textureLoad(places, texel(first), 0);
    let b = textureLoad(places, texel(first + 1u), 0);
    let p = in_hair_map(lamp, a.xyz);
    let q = in_hair_map(lamp, b.xyz);
    let width = 0.25 * (a.w + b.w) * current.y * lamp.hair.x * lamp.hair.z;
    // About as soft as the preview's maps: the pieces drawn are a sample of all.
    let line = ribbon_corner(p.xy, q.xy, width, vec2<f32>(3.5, 3.5), corner_of(vertex));
    let ndc = line.at / lamp.hair.z * 2.0 - 1.0;
    out.offset = line.offset;
    out.depth = select(p.z, q.z, line.end > 0.5);
    out.shape = vec2<f32>(line.half, line.rise);
    out.at = vec4<f32>(ndc.x, -ndc.y, 0.5, 1.0);
    if !line.exists {
        out.at = vec4<f32>(2.0, 2.0, 2.0, 1.0);
    }
    return out;
}

struct Layers {
    @location(0) a: vec4<f32>,
    @location(1) b: vec4<f32>,
    @location(2) c: vec4<f32>,
    @location(3) d: vec4<f32>,
}

// Adds a piece of hair to all layers behind it.
@fragment
fn lay(in: Ribbon) -> Layers {
    let lamp = picture.lamps[i32(current.x)];
    let uv = in.at.xy / lamp.hair.z;
    let front = textureSampleLevel(first_hair, smooth_sampler, uv, i32(current.x), 0.0).x;
    let k = layer(in.depth - front);
    // Wide hair that stands for many counts as many do.
    let met = covered(in.offset, in.shape.x, in.shape.y);
    // A layer has all of a hair in front of it, none of one behind it, and a part of one within half a layer of it.
    let four = vec4<f32>(0.5, 1.5, 2.5, 3.5) - k;
    var out: Layers;
    out.a = met * clamp(four, vec4<f32>(0.0), vec4<f32>(1.0));
    out.b = met * clamp(four + 4.0, vec4<f32>(0.0), vec4<f32>(1.0));
    out.c = met * clamp(four + 8.0, vec4<f32>(0.0), vec4<f32>(1.0));
    out.d = met * clamp(four + 12.0, vec4<f32>(0.0), vec4<f32>(1.0));
    return out;
}
