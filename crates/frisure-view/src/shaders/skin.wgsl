// The head. Needs `common`, `layers` and `shadows`.

@group(2) @binding(0) var hair: texture_2d<f32>;

// Coverage by hair from which on the head behind it is not shaded. Chosen: half a step of an 8-bit picture.
const HIDDEN: f32 = 0.998;

// Whether hair keeps light out, and the head's shadows may be soft. Of a pipeline each: software computes both sides of a branch.
override SHADOWS: bool = true;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) ambient: vec3<f32>,
    @location(3) tint: vec4<f32>,
}

struct Skin {
    @builtin(position) at: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) ambient: vec3<f32>,
    // Lamps, whether the head's shadows are soft, and planes.
    @location(3) @interpolate(flat) kinds: vec3<i32>,
    // Red of lips, blood beneath the skin, whether a garment covers it (above one half), and half of how much hair grows there. Of an
    // accessory its colour, and one plus the strength of its gloss.
    @location(4) tint: vec4<f32>,
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
    return Skin(projected(in.position), in.position, in.normal, in.ambient, vec3<i32>(i32(picture.film.z), i32(picture.hair.y), i32(picture.film.w)), in.tint);
}

// Places on a lamp as wide as a soft box: the middle, a ring of eight of which four come first, and a ring of four
// within.
const FEW: i32 = 5;
const ALL: i32 = 13;

fn on_lamp(lamp: Lamp, i: i32, radius: f32) -> vec3<f32> {
    let outer = i < 9;
    let turn = TAU / 8.0 * (select(2.0 * f32(i - 9) + 1.0, 2.0 * f32(i - 1) + select(0.5, 1.5, i > 4), outer));
    let r = radius * select(0.44, 0.855, outer) * min(f32(i), 1.0);
    return r * (cos(turn) * lamp.right.xyz + sin(turn) * lamp.down.xyz);
}

// Part of the lamp that the head does not hide: of `places` places on it, of which the first few tell that all are
// open or none. One loop and not thirteen calls: software compiles each call anew.
fn past_head_from(lamp: Lamp, p: vec3<f32>, bias: f32, places: i32) -> f32 {
    // The farther away what casts the shadow is, the wider the blur (percentage-closer soft shadows).
    var radius = picture.skin_shape.z;
    if SHADOWS && places > 1 {
        var distance = 0.0;
        var casting = 0.0;
        for (var i = 0; i < FEW; i += 1) {
            let gap = blocker(lamp, p + on_lamp(lamp, i, picture.skin_blur.x), bias);
            distance += gap;
            casting += select(0.0, 1.0, gap > 0.0);
        }
        radius = clamp(picture.skin_depth.w * distance / max(casting, 1.0), radius, picture.skin_blur.x);
    }
    var open = 0.0;
    var count = select(1, places, SHADOWS);
    for (var i = 0; i < count; i += 1) {
        open += past_head(lamp, p + on_lamp(lamp, i, radius), bias);
        if i + 1 == FEW && (open == 0.0 || open == f32(FEW)) {
            count = FEW;
        }
    }
    return open / f32(count);
}

// What a place of the head is made of: skin with its reds, a garment, an eye or an accessory.
struct Cover {
    colour: vec3<f32>,
    // Whether light goes beneath the surface (1).
    deep: f32,
    // Strength and exponent of the gloss.
    gloss: vec2<f32>,
    normal: vec3<f32>,
}

// Materials as `complexion.rs` has them.
const LIPS: vec3<f32> = vec3<f32>(0.83, 0.58, 0.60);
const FLUSH: vec3<f32> = vec3<f32>(0.98, 0.80, 0.80);
const SCALP: vec3<f32> = vec3<f32>(0.76, 0.68, 0.65);
const SCLERA: vec3<f32> = vec3<f32>(0.40, 0.365, 0.34);
const CORNER: vec3<f32> = vec3<f32>(0.38, 0.25, 0.22);
const IRIS: f32 = 0.44;
const PUPIL: f32 = 0.15;
const UNDER_LID: vec2<f32> = vec2<f32>(-0.05, 0.28);
const LID_SHADE: f32 = 0.7;
// Gloss of a wet eye, Blinn-Phong: its mirror image of a lamp is a small bright spot. Chosen by eye.
const WET_EYE: vec2<f32> = vec2<f32>(6.0, 900.0);

fn eyeball(eye: Eye, out: vec3<f32>) -> Cover {
    let across = out - eye.gaze.xyz * dot(out, eye.gaze.xyz);
    let sine = select(1.0, length(across), dot(out, eye.gaze.xyz) > 0.0);
    let turn = atan2(dot(across, eye.upright.xyz), dot(across, eye.across.xyz));
    var fibres = 0.0;
    fibres += sin(11.0 * turn + 0.3 + 5.0 * sine) + sin(23.0 * turn + 1.7 + 5.0 * sine);
    fibres += sin(37.0 * turn + 4.1 + 5.0 * sine) + sin(58.0 * turn + 2.2 + 5.0 * sine);
    let own = picture.iris.rgb;
    var iris = own * (0.75 + 0.10 * fibres) * (1.5 - 1.6 * sine);
    iris = mix(iris, own * 0.12, smoothstep(0.36, IRIS, sine));
    let white = mix(SCLERA, CORNER, 0.7 * smoothstep(0.62, 0.95, sine));
    var colour = mix(vec3<f32>(0.006), iris, smoothstep(PUPIL - 0.015, PUPIL + 0.015, sine));
    colour = mix(colour, white, smoothstep(IRIS - 0.03, IRIS + 0.02, sine));
    colour *= 1.0 - LID_SHADE * smoothstep(UNDER_LID.x, UNDER_LID.y, dot(out, eye.upright.xyz));
    return Cover(colour, 0.0, WET_EYE, out);
}

fn cover(place: vec3<f32>, normal: vec3<f32>, tint: vec4<f32>) -> Cover {
    if tint.w > 0.75 {
        return Cover(tint.xyz, 0.0, vec2<f32>(tint.w - 1.0, picture.skin_shape.w), normal);
    }
    let part = clamp(tint.xyz, vec3<f32>(0.0), vec3<f32>(1.0));
    let roots = mix(vec3<f32>(1.0), SCALP, clamp(2.0 * tint.w, 0.0, 1.0));
    let reds = mix(vec3<f32>(1.0), FLUSH, part.y) * mix(vec3<f32>(1.0), LIPS, part.x) * roots;
    let gloss = vec2<f32>(picture.skin.a * (1.0 + 0.4 * part.x), picture.skin_shape.w);
    var found = Cover(picture.skin.rgb * reds, 1.0, gloss, normal);
    if tint.z > 0.5 {
        found = Cover(picture.garment.rgb, 0.0, vec2<f32>(0.0, 1.0), normal);
    }
    var eye = picture.eyes[0];
    if distance(place, picture.eyes[1].ball.xyz) < distance(place, eye.ball.xyz) {
        eye = picture.eyes[1];
    }
    let away = place - eye.ball.xyz;
    // Lids are thicker than a hundredth of the ball.
    if abs(length(away) - eye.ball.w) < 0.01 * eye.ball.w {
        found = eyeball(eye, normalize(away));
    }
    return found;
}

// The light of a lamp that skin at a place sends to the eye.
fn skin_from(lamp: Lamp, made: Cover, place: vec3<f32>, eye: vec3<f32>, places: i32) -> vec3<f32> {
    let normal = made.normal;
    let wrap = picture.skin_shape.x;
    let bias = picture.skin_shape.y;
    // Diffuse light wrapped past the terminator, and a Blinn-Phong gloss, as `preview/shading.rs` has them.
    let facing = (dot(normal, lamp.towards.xyz) + wrap) / (1.0 + wrap);
    if facing <= 0.0 {
        return vec3<f32>(0.0);
    }
    let lifted = place + bias * normal;
    let open = past_head_from(lamp, lifted, bias, places);
    var passed = vec3<f32>(open);
    if SHADOWS {
        let met = hairs_met(lamp, lifted, picture.hair.z, picture.hair.w);
        passed *= exp(-met.before * picture.extinction.rgb);
    }
    let half = normalize(lamp.towards.xyz + eye);
    let gloss = made.gloss.x * pow(max(dot(normal, half), 0.0), made.gloss.y);
    // Red light goes far beneath the skin.
    let more = picture.skin_depth.rgb * made.deep;
    let lit = max((facing + more) / (1.0 + more), vec3<f32>(0.0));
    return passed * lamp.light.rgb / PI * (lit * made.colour + min(facing, 1.0) * gloss);
}

// The ambient light and the lamps', as the preview has it.
@fragment
fn skin(in: Skin) -> @location(0) vec4<f32> {
    if textureLoad(hair, vec2<i32>(in.at.xy), 0).a > HIDDEN {
        return vec4<f32>(0.0, 0.0, 0.0, 1.0);
    }
    let eye = normalize(picture.eye.xyz - in.place);
    var normal = normalize(in.normal);
    normal = select(normal, -normal, dot(normal, eye) < 0.0);
    let made = cover(in.place, normal, in.tint);
    var light = in.ambient * made.colour;
    for (var i = 0; i < in.kinds.x; i += 1) {
        light += skin_from(picture.lamps[i], made, in.place, eye, select(1, ALL, in.kinds.y > 0));
    }
    return vec4<f32>(behind_planes(light, in.place, in.kinds.z), 1.0);
}
