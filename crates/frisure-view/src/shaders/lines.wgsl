// Lines over the picture. Needs `common`.

struct Stroke {
    @builtin(position) at: vec4<f32>,
    @location(0) colour: vec4<f32>,
    @location(1) offset: f32,
    @location(2) @interpolate(flat) half: f32,
}

// The part of the line in front of the eye; w: whether there is any.
fn kept(p: vec3<f32>, q: vec3<f32>) -> vec4<f32> {
    let near = 2.0 * NEAR;
    let dp = dot(p - picture.eye.xyz, picture.forward.xyz);
    let dq = dot(q - picture.eye.xyz, picture.forward.xyz);
    if dp >= near {
        return vec4<f32>(p, 1.0);
    }
    if dq < near {
        return vec4<f32>(p, 0.0);
    }
    return vec4<f32>(mix(p, q, (near - dp) / (dq - dp)), 1.0);
}

@vertex
fn stroke(
    @builtin(vertex_index) corner: u32,
    @location(0) from_width: vec4<f32>,
    @location(1) to: vec4<f32>,
    @location(2) colour: vec4<f32>,
) -> Stroke {
    let start = kept(from_width.xyz, to.xyz);
    let stop = kept(to.xyz, from_width.xyz);
    let p = project(start.xyz);
    let q = project(stop.xyz);
    let end = (corner & 1u) == 1u;
    let side = select(-1.0, 1.0, corner >= 2u);
    let way = q.xy - p.xy;
    let along = way / max(length(way), 1e-4);
    let half = 0.5 * from_width.w;
    let reach = half + 0.5;
    let tip = select(-half, half, end);
    let at = select(p.xy, q.xy, end) + along * tip + side * reach * vec2<f32>(-along.y, along.x);
    let size = vec2<f32>(picture.right.w, picture.up.w);
    let ndc = vec2<f32>(2.0, -2.0) * (at / size - 0.5);
    var out: Stroke;
    out.at = vec4<f32>(ndc, buffer_depth(max(select(p.z, q.z, end), NEAR)), 1.0);
    if start.w * stop.w == 0.0 {
        out.at = vec4<f32>(2.0, 2.0, 2.0, 1.0);
    }
    out.colour = colour;
    out.offset = side * reach;
    out.half = half;
    return out;
}

@fragment
fn ink(in: Stroke) -> @location(0) vec4<f32> {
    let alpha = clamp(in.half + 0.5 - abs(in.offset), 0.0, 1.0);
    return vec4<f32>(in.colour.rgb, in.colour.a * alpha);
}
