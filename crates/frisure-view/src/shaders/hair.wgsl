// Hair on the picture, nearest first. Needs `common` and `ribbon`.

@group(1) @binding(0) var places: texture_2d<f32>;
@group(1) @binding(1) var lights: texture_2d<f32>;
// First vertices of pieces.
@group(2) @binding(0) var pieces: texture_2d<u32>;

struct Ribbon {
    @builtin(position) at: vec4<f32>,
    // Light to the eye; w: how far past the cut (part of the length).
    @location(0) light: vec4<f32>,
    @location(1) offset: f32,
    @location(2) @interpolate(flat) shape: vec2<f32>,
}

// Half of the width that is drawn (m); brows and lashes, marked by the sign, are never wider than they are.
fn widened(half: f32) -> f32 {
    return select(half * picture.forward.w, -half, half < 0.0);
}

@vertex
fn ribbon(@builtin(vertex_index) vertex: u32) -> Ribbon {
    var out: Ribbon;
    let first = textureLoad(pieces, texel(piece_of(vertex)), 0).x;
    let a = textureLoad(places, texel(first), 0);
    let b = textureLoad(places, texel(first + 1u), 0);
    let p = project(a.xyz);
    let q = project(b.xyz);
    let width = (widened(a.w) + widened(b.w)) * picture.eye.w / max(p.z + q.z, 1e-6);
    // The least softening is that of the preview (`preview/composite.rs`).
    let line = ribbon_corner(p.xy, q.xy, width, vec2<f32>(0.35, 1.0), corner_of(vertex));
    let end = line.end > 0.5;
    out.light = textureLoad(lights, texel(select(first, first + 1u, end)), 0);
    out.offset = line.offset;
    out.shape = vec2<f32>(line.half, line.rise);
    let depth = select(p.z, q.z, end);
    let size = vec2<f32>(picture.right.w, picture.up.w);
    let ndc = vec2<f32>(2.0, -2.0) * (line.at / size - 0.5);
    // w is 1: everything is interpolated evenly across the screen.
    out.at = vec4<f32>(ndc, buffer_depth(max(depth, NEAR)), 1.0);
    if min(p.z, q.z) <= NEAR || !line.exists {
        out.at = vec4<f32>(2.0, 2.0, 2.0, 1.0);
    }
    return out;
}

@fragment
fn paint(in: Ribbon) -> @location(0) vec4<f32> {
    let alpha = min(covered(in.offset, in.shape.x, in.shape.y), 1.0);
    if in.light.w > 0.0 {
        let faint = alpha * picture.falling.w;
        let bright = max(max(in.light.r, in.light.g), in.light.b);
        // Hair beyond a cut is tinted by three quarters, brighter where it is lit. Chosen by eye.
        return vec4<f32>(faint * mix(in.light.rgb, picture.falling.rgb * (0.3 + bright), 0.75), faint);
    }
    return vec4<f32>(alpha * in.light.rgb, alpha);
}
