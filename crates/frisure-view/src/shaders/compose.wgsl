// Hair over head over background, developed for a screen. Needs `common`.

@group(1) @binding(0) var hair: texture_2d<f32>;
@group(1) @binding(1) var head: texture_2d<f32>;
@group(1) @binding(2) var around: texture_2d<f32>;
@group(1) @binding(3) var smooth_sampler: sampler;

// Whether the environment is the background. Of a pipeline each: software computes both sides of a branch.
override AROUND: bool = true;

struct Whole {
    @builtin(position) at: vec4<f32>,
    // Kinds of background and of tone curve, and how many planes there are.
    @location(0) @interpolate(flat) kinds: vec3<i32>,
}

@vertex
fn whole(@builtin(vertex_index) corner: u32) -> Whole {
    return Whole(everything(corner), vec3<i32>(i32(picture.centre.w), i32(picture.film.y), i32(picture.film.w)));
}

// Hable's curve, as `frisure_look`'s tone curves have it (docs/rendering.md, "Sources").
fn hable(x: vec3<f32>) -> vec3<f32> {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.0666667;
}

fn developed(light: vec3<f32>, kind: i32) -> vec3<f32> {
    let x = max(light, vec3<f32>(0.0));
    // The shoulder begins at 0.55, as in `frisure_look`.
    if kind == 1 {
        let bent = 0.55 + 0.45 * (1.0 - exp((0.55 - x) / 0.45));
        return select(x, bent, x > vec3<f32>(0.55));
    }
    if kind == 2 {
        return clamp(hable(2.0 * min(x, vec3<f32>(1e4))) / hable(vec3<f32>(11.2)), vec3<f32>(0.0), vec3<f32>(1.0));
    }
    return min(x, vec3<f32>(1.0));
}

// The transfer function of sRGB.
fn encoded(linear: vec3<f32>) -> vec3<f32> {
    let high = 1.055 * pow(max(linear, vec3<f32>(0.0)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, 12.92 * linear, linear <= vec3<f32>(0.0031308));
}

// Less than a step of the screen, different from pixel to pixel: smooth backgrounds show no bands.
fn dither(at: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(at, vec2<f32>(0.06711056, 0.00583715)))) - 0.5;
}

fn behind(at: vec2<f32>, kind: i32, planes: i32) -> vec4<f32> {
    let size = vec2<f32>(picture.right.w, picture.up.w);
    let from_middle = at - 0.5 * size;
    let way = normalize(picture.eye.w * picture.forward.xyz
        + from_middle.x * picture.right.xyz - from_middle.y * picture.up.xyz);
    let uv = 2.0 * at / size - 1.0;
    let r = min(0.5 * dot(uv, uv), 1.0);
    var light = mix(picture.centre.rgb, picture.corner.rgb, r * (2.0 - r));
    if AROUND {
        let turn = atan2(way.y, way.x) / TAU + 0.5;
        light = textureSampleLevel(around, smooth_sampler, vec2<f32>(turn, acos(clamp(way.z, -1.0, 1.0)) / PI), 0.0).rgb;
    }
    let seen = vec4<f32>(behind_planes(light, picture.eye.xyz + 50.0 * way, planes), 1.0);
    return select(seen, vec4<f32>(0.0), kind == 0);
}

// Hair over background beside the head's edge: what the part of a pixel shows that the head leaves free, where
// the head's depth has hidden the hair behind; elsewhere the background. A loop without rounds and no branch: software
// computes both sides of that for every pixel.
fn beside(texel_: vec2<i32>, back: vec4<f32>, at_edge: bool) -> vec4<f32> {
    let most = vec2<i32>(textureDimensions(hair)) - 1;
    var sum = vec4<f32>(0.0);
    var weight = 1e-6;
    for (var i = 0; i < select(0, 9, at_edge); i += 1) {
        let at = clamp(texel_ + vec2<i32>(i % 3 - 1, i / 3 - 1), vec2<i32>(0), most);
        let free = 1.0 - textureLoad(head, at, 0).a;
        // Neighbours count by how much of them is free of the head; the pixel itself hardly. Chosen by eye.
        let own = select(free * free, 0.02 * free, i == 4);
        let front = textureLoad(hair, at, 0);
        sum += own * (front + (1.0 - front.a) * back);
        weight += own;
    }
    return select(back, sum / weight, at_edge);
}

@fragment
fn compose(in: Whole) -> @location(0) vec4<f32> {
    let texel_ = vec2<i32>(in.at.xy);
    let skin = textureLoad(head, texel_, 0);
    var back = behind(in.at.xy, in.kinds.x, in.kinds.z);
    back = beside(texel_, back, skin.a > 0.003 && skin.a < 0.997);
    let front = textureLoad(hair, texel_, 0);
    var all = skin + (1.0 - skin.a) * back;
    all = front + (1.0 - front.a) * all;
    let light = all.rgb * picture.film.x / max(all.a, 1e-6);
    return vec4<f32>(encoded(developed(light, in.kinds.y)) + dither(in.at.xy) / 255.0, all.a);
}
