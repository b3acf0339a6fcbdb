// Uniforms of every shader: the camera, the lamps and the look of one picture.
//
// No branch and no loop is decided by these numbers alone: Mesa's software rasteriser would compile the shader
// anew for each camera. What has to be decided by them comes as a number that vertex shaders hand on.

struct Lamp {
    // Unit direction to it; w: its number as a layer.
    towards: vec4<f32>,
    // Irradiance; w: 1 if hair keeps its light out.
    light: vec4<f32>,
    // Unit direction across, to the right in its maps; w: centre of the hair's map (m).
    right: vec4<f32>,
    // Unit direction across, downwards in its maps; w: centre of the hair's map (m).
    down: vec4<f32>,
    // Hair's map: 1 / half its side (1/m), nearest depth (m), texels along a side, half a texel (m).
    hair: vec4<f32>,
    // Head's map: centre (m), 1 / half its side (1/m), texels along a side, or 0 without a head.
    head: vec4<f32>,
    // Head's map: nearest depth (m), 1 / range of depths (1/m).
    head_range: vec4<f32>,
}

struct Plane {
    // Centre (m).
    centre: vec4<f32>,
    // From the centre to the edges over the squared length of each (1/m); w: 1 if there is one.
    right: vec4<f32>,
    up: vec4<f32>,
    // Unit normal.
    normal: vec4<f32>,
    // Linear colour and opacity.
    colour: vec4<f32>,
}

struct Eye {
    // Centre and radius of the ball (m); without an eye the radius is 0.
    ball: vec4<f32>,
    // Unit direction of the gaze.
    gaze: vec4<f32>,
    // Two unit directions across it.
    across: vec4<f32>,
    upright: vec4<f32>,
}

struct Picture {
    // Eye (m); w: pixels per unit of slope.
    eye: vec4<f32>,
    // To the right; w: width (pixels).
    right: vec4<f32>,
    // Upwards; w: height (pixels).
    up: vec4<f32>,
    // Into the picture; w: factor on the width of hairs.
    forward: vec4<f32>,
    // Extinction per hair; w: vertices of hair.
    extinction: vec4<f32>,
    // Energy reflected at a hair's surface; w: share of the environment mirrored.
    reflected: vec4<f32>,
    // Deviation along the fibre, tilt, deviation around the fibre; w: share lost to other hair that is seen.
    lobes: vec4<f32>,
    // What wet hair has less of: diffuse, returned, reflected, width.
    wet: vec4<f32>,
    // Skin's colour and gloss.
    skin: vec4<f32>,
    // Skin: wrap, bias (m), penumbra (m), exponent.
    skin_shape: vec4<f32>,
    // How much farther light beneath the skin makes each colour reach; w: blur of shadows per distance of what casts them.
    skin_depth: vec4<f32>,
    // Widest blur of shadows on skin (m); three numbers unused.
    skin_blur: vec4<f32>,
    // Ambient grid: low corner (m), 1 / distance of nodes (1/m).
    room_low: vec4<f32>,
    // Ambient grid: nodes along each side; w: how far hair is lifted to a lamp (m).
    room_size: vec4<f32>,
    // Background: radiance at the centre and at the corners; w: its kind.
    centre: vec4<f32>,
    corner: vec4<f32>,
    // Gain, kind of tone curve, lamps, planes.
    film: vec4<f32>,
    // Linear colour of chosen hair and how strong it is.
    chosen: vec4<f32>,
    // Linear colour of hair that will fall; w: its opacity.
    falling: vec4<f32>,
    // Material per vertex (1) or per strand (0); whether the head's shadows on itself are soft (1) or not (0);
    // how much nearer to a lamp hair looks up how much
    // hair is before it, and half of what counts as around it (m).
    hair: vec4<f32>,
    lamps: array<Lamp, 4>,
    planes: array<Plane, 4>,
    eyes: array<Eye, 2>,
    // Linear reflectance of irises and of the garment.
    iris: vec4<f32>,
    garment: vec4<f32>,
}

@group(0) @binding(0) var<uniform> picture: Picture;

const NEAR: f32 = 0.01;
const FAR: f32 = 100.0;
const PI: f32 = 3.14159265;
const TAU: f32 = 6.2831853;

// Texels along a row of vertices.
const ROW: u32 = 2048u;

fn texel(index: u32) -> vec2<i32> {
    return vec2<i32>(i32(index % ROW), i32(index / ROW));
}

// A triangle that covers everything.
fn everything(corner: u32) -> vec4<f32> {
    let x = f32((corner << 1u) & 2u);
    let y = f32(corner & 2u);
    return vec4<f32>(2.0 * x - 1.0, 2.0 * y - 1.0, 0.0, 1.0);
}

// Depth buffer's value at a distance along the view (m).
fn buffer_depth(depth: f32) -> f32 {
    // 0 at NEAR, 1 at FAR, linear in 1/depth as a perspective projection has it.
    return FAR / (FAR - NEAR) * (1.0 - NEAR / depth);
}

// Position in the picture (pixels) and depth (m).
fn project(p: vec3<f32>) -> vec3<f32> {
    let d = p - picture.eye.xyz;
    let depth = dot(d, picture.forward.xyz);
    let scale = picture.eye.w / max(depth, NEAR);
    return vec3<f32>(
        0.5 * picture.right.w + scale * dot(d, picture.right.xyz),
        0.5 * picture.up.w - scale * dot(d, picture.up.xyz),
        depth,
    );
}

// A point in a lamp's maps: right, down and away from the lamp (m).
fn in_maps(lamp: Lamp, p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(p, lamp.right.xyz), dot(p, lamp.down.xyz), -dot(p, lamp.towards.xyz));
}

// The same in the hair's map: pixels, and depth from its nearest (m).
fn in_hair_map(lamp: Lamp, p: vec3<f32>) -> vec3<f32> {
    let m = in_maps(lamp, p);
    let uv = (m.xy - vec2<f32>(lamp.right.w, lamp.down.w)) * lamp.hair.x;
    return vec3<f32>((0.5 + 0.5 * uv) * lamp.hair.z, m.z - lamp.hair.y);
}

// Light from behind a plane, if that is between the eye and a point.
fn behind_plane(light: vec3<f32>, p: vec3<f32>, plane: Plane) -> vec3<f32> {
    let way = p - picture.eye.xyz;
    let slope = dot(way, plane.normal.xyz);
    // The way from the eye meets the plane at the fraction t: the plane is in between for t from 0 to 1.
    let t = dot(plane.centre.xyz - picture.eye.xyz, plane.normal.xyz)
        / select(slope, 1e-9, abs(slope) < 1e-9);
    let h = picture.eye.xyz + t * way - plane.centre.xyz;
    let inside = max(abs(dot(h, plane.right.xyz)), abs(dot(h, plane.up.xyz)));
    let edge = smoothstep(0.975, 0.985, inside);
    // Seen along itself it would be a row of dots.
    let facing = smoothstep(0.01, 0.04, abs(slope) / max(length(way), 1e-6));
    let opacity = plane.colour.a * facing * (1.0 + 1.5 * edge) * step(t, 1.0) * step(1e-9, t) * step(inside, 1.0);
    return mix(light, plane.colour.rgb, min(opacity, 1.0));
}

// Light from behind the first `count` planes.
fn behind_planes(light: vec3<f32>, p: vec3<f32>, count: i32) -> vec3<f32> {
    var left = light;
    for (var i = 0; i < count; i += 1) {
        left = behind_plane(left, p, picture.planes[i]);
    }
    return left;
}
