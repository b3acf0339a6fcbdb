// How much of a lamp's light gets to a point. Needs `common` and `layers`.

@group(1) @binding(0) var first_hair: texture_2d_array<f32>;
@group(1) @binding(1) var hair_met: texture_2d_array<f32>;
@group(1) @binding(2) var head_depth: texture_2d_array<f32>;
@group(1) @binding(3) var smooth_sampler: sampler;

struct Met {
    // Hairs between the lamp and the point.
    before: f32,
    // Hairs around it, along the light.
    around: f32,
}

// Weights of four layers for linear interpolation at the layer `k`.
fn tent(k: f32, first: f32) -> vec4<f32> {
    return max(vec4<f32>(0.0), 1.0 - abs(vec4<f32>(first, first + 1.0, first + 2.0, first + 3.0) - k));
}

// Hairs met around a point, seen `lift` nearer to the lamp (m).
fn hairs_met(lamp: Lamp, p: vec3<f32>, lift: f32, half_cell: f32) -> Met {
    let m = in_hair_map(lamp, p);
    let uv = m.xy / lamp.hair.z;
    // Where hair keeps no light out, all is beside the map.
    let beside = abs(uv - 0.5) + 1.0 - lamp.light.w;
    if max(beside.x, beside.y) > 0.5 {
        return Met(0.0, 0.0);
    }
    let index = i32(lamp.towards.w);
    let depth = m.z - textureSampleLevel(first_hair, smooth_sampler, uv, index, 0.0).x;
    let here = min(layer(depth - lift), LAST_LAYER);
    let near = min(layer(depth - half_cell), LAST_LAYER);
    let far = min(layer(depth + half_cell), LAST_LAYER);
    let a = textureSampleLevel(hair_met, smooth_sampler, uv, 4 * index, 0.0);
    let b = textureSampleLevel(hair_met, smooth_sampler, uv, 4 * index + 1, 0.0);
    let c = textureSampleLevel(hair_met, smooth_sampler, uv, 4 * index + 2, 0.0);
    let d = textureSampleLevel(hair_met, smooth_sampler, uv, 4 * index + 3, 0.0);
    let before = dot(a, tent(here, 0.0)) + dot(b, tent(here, 4.0))
        + dot(c, tent(here, 8.0)) + dot(d, tent(here, 12.0));
    let around = dot(a, tent(far, 0.0) - tent(near, 0.0)) + dot(b, tent(far, 4.0) - tent(near, 4.0))
        + dot(c, tent(far, 8.0) - tent(near, 8.0)) + dot(d, tent(far, 12.0) - tent(near, 12.0));
    return Met(before, max(around, 0.0));
}

// How far before a place the head is, as a lamp sees it (m); 0 where nothing is.
fn blocker(lamp: Lamp, p: vec3<f32>, bias: f32) -> f32 {
    let m = in_maps(lamp, p);
    let size = lamp.head.w;
    let g = (0.5 + 0.5 * (m.xy - lamp.head.xy) * lamp.head.z) * size;
    if any(g < vec2<f32>(1.0)) || any(g > vec2<f32>(size - 2.0)) {
        return 0.0;
    }
    let gap = m.z - lamp.head_range.x - textureLoad(head_depth, vec2<i32>(g), i32(lamp.towards.w), 0).x;
    return select(0.0, gap, gap > bias);
}

// Part of the lamp that the head does not hide from a point, moved towards it by `bias` (m).
fn past_head(lamp: Lamp, p: vec3<f32>, bias: f32) -> f32 {
    let m = in_maps(lamp, p);
    let size = lamp.head.w;
    let g = (0.5 + 0.5 * (m.xy - lamp.head.xy) * lamp.head.z) * size - 0.5;
    if any(g < vec2<f32>(1.0)) || any(g > vec2<f32>(size - 2.0)) {
        return 1.0;
    }
    let cell = floor(g);
    let f = g - cell;
    // Smooth weights over 2 x 2 texels: a soft edge without the creases of linear ones.
    let weight = f * f * (3.0 - 2.0 * f);
    let at = vec2<i32>(cell);
    let index = i32(lamp.towards.w);
    let nearer = m.z - lamp.head_range.x - bias;
    let a = step(nearer, textureLoad(head_depth, at, index, 0).x);
    let b = step(nearer, textureLoad(head_depth, at + vec2<i32>(1, 0), index, 0).x);
    let c = step(nearer, textureLoad(head_depth, at + vec2<i32>(0, 1), index, 0).x);
    let d = step(nearer, textureLoad(head_depth, at + vec2<i32>(1, 1), index, 0).x);
    return mix(mix(a, b, weight.x), mix(c, d, weight.x), weight.y);
}
