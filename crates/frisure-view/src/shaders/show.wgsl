// The finished picture in a pass of the caller.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var smooth_sampler: sampler;

struct Shown {
    @builtin(position) at: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn whole(@builtin(vertex_index) corner: u32) -> Shown {
    let uv = vec2<f32>(f32((corner << 1u) & 2u), f32(corner & 2u));
    return Shown(vec4<f32>(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 0.0, 1.0), uv);
}

// For targets in sRGB.
@fragment
fn show_encoded(in: Shown) -> @location(0) vec4<f32> {
    let c = textureSampleLevel(picture, smooth_sampler, in.uv, 0.0);
    return vec4<f32>(c.rgb * c.a, c.a);
}

fn decoded(c: vec3<f32>) -> vec3<f32> {
    return select(pow((c + 0.055) / 1.055, vec3<f32>(2.4)), c / 12.92, c <= vec3<f32>(0.04045));
}

// For targets that encode what they are given.
@fragment
fn show_linear(in: Shown) -> @location(0) vec4<f32> {
    let c = textureSampleLevel(picture, smooth_sampler, in.uv, 0.0);
    return vec4<f32>(decoded(c.rgb) * c.a, c.a);
}
