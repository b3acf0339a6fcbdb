// The head. Needs `common`, `layers` and `shadows`.

@group(2) @binding(0) var hair: texture_2d<f32>;

// What a pixel's hair covers when nobody sees the head behind it.
const HIDDEN: f32 = 0.998;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) room: vec3<f32>,
}

struct Skin {
    @builtin(position) at: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) room: vec3<f32>,
    // Lamps, and whether the head's shadows are soft.
    @location(3) @interpolate(flat) kinds: vec2<i32>,
}

fn projected(p: vec3<f32>) -> vec4<f32> {
    let d = p - picture.eye.xyz;
    let depth = dot(d, picture.forward.xyz);
    let half = 0.5 * vec2<f32>(picture.right.w, picture.up.w);
    let across = vec2<f32>(dot(d, picture.right.xyz), dot(d, picture.up.xyz));
    return vec4<f32>(across * picture.eye.w / half, FAR / (FAR - NEAR) * (depth - NEAR), depth);
}

@vertex
fn skin_vertex(in: Vertex) -> Skin {
    return Skin(projected(in.position), in.position, in.normal, in.room, vec2<i32>(i32(picture.film.z), i32(picture.hair.y)));
}

fn aside(lamp: Lamp, p: vec3<f32>, bias: f32, radius: f32, eighths: f32) -> f32 {
    let angle = TAU / 8.0 * eighths;
    return past_head(lamp, p + radius * (cos(angle) * lamp.right.xyz + sin(angle) * lamp.down.xyz), bias);
}

// Mean over a lamp as wide as a soft box: over the middle and two rings of four and of eight places. Most of the
// head is all lit or all dark, and four places of the outer ring tell.
fn softly_past_head(lamp: Lamp, p: vec3<f32>, bias: f32, radius: f32, middle: f32) -> f32 {
    let outer = 0.855 * radius;
    var open = middle + aside(lamp, p, bias, outer, 0.5) + aside(lamp, p, bias, outer, 2.5)
        + aside(lamp, p, bias, outer, 4.5) + aside(lamp, p, bias, outer, 6.5);
    if open == 0.0 || open == 5.0 {
        return open / 5.0;
    }
    let inner = 0.44 * radius;
    open += aside(lamp, p, bias, outer, 1.5) + aside(lamp, p, bias, outer, 3.5)
        + aside(lamp, p, bias, outer, 5.5) + aside(lamp, p, bias, outer, 7.5);
    open += aside(lamp, p, bias, inner, 1.0) + aside(lamp, p, bias, inner, 3.0)
        + aside(lamp, p, bias, inner, 5.0) + aside(lamp, p, bias, inner, 7.0);
    return open / 13.0;
}

// The light of a lamp that skin at a place sends to the eye.
fn skin_from(lamp: Lamp, place: vec3<f32>, normal: vec3<f32>, eye: vec3<f32>, soft: bool) -> vec3<f32> {
    let wrap = picture.skin_shape.x;
    let bias = picture.skin_shape.y;
    let facing = (dot(normal, lamp.towards.xyz) + wrap) / (1.0 + wrap);
    if facing <= 0.0 {
        return vec3<f32>(0.0);
    }
    let lifted = place + bias * normal;
    var open = past_head(lamp, lifted, bias);
    if soft {
        open = softly_past_head(lamp, lifted, bias, picture.skin_shape.z, open);
    }
    let met = hairs_met(lamp, lifted, picture.hair.z, picture.hair.w);
    let passed = open * exp(-met.before * picture.taken.rgb);
    let half = normalize(lamp.towards.xyz + eye);
    let gloss = picture.skin.a * pow(max(dot(normal, half), 0.0), picture.skin_shape.w);
    return passed * lamp.light.rgb / PI * (facing * picture.skin.rgb + min(facing, 1.0) * gloss);
}

// The room's light and the lamps', as the preview has it.
@fragment
fn skin(in: Skin) -> @location(0) vec4<f32> {
    if textureLoad(hair, vec2<i32>(in.at.xy), 0).a > HIDDEN {
        return vec4<f32>(0.0, 0.0, 0.0, 1.0);
    }
    let eye = normalize(picture.eye.xyz - in.place);
    var normal = normalize(in.normal);
    normal = select(normal, -normal, dot(normal, eye) < 0.0);
    var light = in.room * picture.skin.rgb;
    for (var i = 0; i < in.kinds.x; i += 1) {
        light += skin_from(picture.lamps[i], in.place, normal, eye, in.kinds.y > 0);
    }
    return vec4<f32>(behind_planes(light, in.place), 1.0);
}
