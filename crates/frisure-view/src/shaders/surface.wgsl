// Depths of the head, from the eye and from a lamp. Needs `common`.

@group(1) @binding(0) var<uniform> current: vec4<f32>;

@vertex
fn from_eye(@location(0) p: vec3<f32>) -> @builtin(position) vec4<f32> {
    let d = p - picture.eye.xyz;
    let depth = dot(d, picture.forward.xyz);
    let half = 0.5 * vec2<f32>(picture.right.w, picture.up.w);
    let across = vec2<f32>(dot(d, picture.right.xyz), dot(d, picture.up.xyz));
    return vec4<f32>(across * picture.eye.w / half, FAR / (FAR - NEAR) * (depth - NEAR), depth);
}

struct Seen {
    @builtin(position) at: vec4<f32>,
    @location(0) depth: f32,
}

@vertex
fn from_lamp(@location(0) p: vec3<f32>) -> Seen {
    let lamp = picture.lamps[i32(current.x)];
    let m = in_maps(lamp, p);
    let uv = (m.xy - lamp.head.xy) * lamp.head.z;
    return Seen(vec4<f32>(uv.x, -uv.y, clamp((m.z - lamp.head_range.x) * lamp.head_range.y, 0.0, 1.0), 1.0), m.z - lamp.head_range.x);
}

@fragment
fn depth(in: Seen) -> @location(0) vec4<f32> {
    return vec4<f32>(in.depth, 0.0, 0.0, 0.0);
}
