//! The numbers of a picture as the shaders have them (`shaders/common.wgsl`).

use frisure_look::{Background, Camera, ToneCurve};
use frisure_optics::LobeShape;
use frisure_render::preview::constants;
use frisure_strands::Eye;
use glam::{DVec3, Vec3};

use crate::ambient::AmbientVolume;
use crate::frame::{Frame, MAX_PLANES, Plane, Shadows, linear};
use crate::lamps::{LAMPS, Lamp};

/// Distance (m) towards a lamp at which hair looks up the hair in front of it, so that it does not shade itself; chosen
/// by trial.
const LIFT: f32 = 2.3e-3;
/// Half of what counts as around a hair (m): of a cell of the preview's finest maps.
const HALF_CELL: f32 = 1.1e-3;

/// Bytes of all of them.
pub(crate) const BYTES: usize = 16 * (20 + 7 * LAMPS + 5 * MAX_PLANES + 4 * EYES + 2);

/// Most eyes of a head.
const EYES: usize = 2;

/// A vector and a number.
fn four(v: Vec3, w: f32) -> [f32; 4] {
    [v.x, v.y, v.z, w]
}

/// All numbers, in their order.
pub(crate) fn packed(
    frame: &Frame<'_>,
    [width, height]: [u32; 2],
    environment: &AmbientVolume,
    lamps: &[Lamp],
    width_factor: f32,
    vertices: usize,
) -> Vec<[f32; 4]> {
    let mut all = Vec::with_capacity(BYTES / 16);
    all.extend(view(&frame.camera, width, height, width_factor));
    all.extend(materials(frame, vertices));
    all.push(four(environment.low, environment.per_metre));
    all.push(four(environment.size, constants::HAIR_BIAS));
    all.extend(background(frame.look.background));
    let planes: Vec<_> = frame.planes.iter().filter_map(plane).take(MAX_PLANES).collect();
    all.push([frame.stops.exp2(), tone(frame.tone), lamps.len() as f32, planes.len() as f32]);
    all.extend(marks(frame));
    let varies = frame.hair.is_some_and(crate::hair::Hair::varies);
    let soft = frame.shadows == Shadows::Fine;
    all.push([f32::from(u8::from(varies)), f32::from(u8::from(soft)), LIFT, HALF_CELL]);
    for i in 0..LAMPS {
        all.extend(lamps.get(i).map_or([[0.0; 4]; 7], |lamp| lamp.packed(i)));
    }
    for i in 0..MAX_PLANES {
        all.extend(planes.get(i).copied().unwrap_or([[0.0; 4]; 5]));
    }
    let features = frame.skin.and_then(|skin| skin.surface().features());
    let eyes = features.map_or(&[][..], |features| &features.eyes);
    for i in 0..EYES {
        all.extend(eyes.get(i).map_or([[0.0; 4]; 4], eye));
    }
    all.extend([four(frame.look.skin.iris, 0.0), four(frame.look.skin.garment, 0.0)]);
    all
}

/// An eye as the shaders have it.
fn eye(eye: &Eye) -> [[f32; 4]; 4] {
    let gaze = eye.gaze.as_vec3();
    let (across, upright) = gaze.any_orthonormal_pair();
    let ball = four(eye.centre.as_vec3(), eye.radius as f32);
    [ball, four(gaze, 0.0), four(across, 0.0), four(upright, 0.0)]
}

fn view(camera: &Camera, width: u32, height: u32, width_factor: f32) -> [[f32; 4]; 4] {
    let v = |d: DVec3| d.as_vec3();
    let focal = 0.5 * f64::from(height) / (0.5 * camera.vertical_fov()).tan();
    [
        four(v(camera.eye()), focal as f32),
        four(v(camera.right()), width as f32),
        four(v(camera.up()), height as f32),
        four(v(camera.forward()), width_factor),
    ]
}

fn materials(frame: &Frame<'_>, vertices: usize) -> [[f32; 4]; 8] {
    let surface = frame.look.hair.surface;
    let shape =
        LobeShape::of(surface.longitudinal_roughness, surface.azimuthal_roughness, surface.tilt);
    let (extinction, reflected) =
        frame.hair.map_or((Vec3::ONE, Vec3::ZERO), |hair| (hair.extinction(), hair.reflected()));
    let skin = frame.look.skin;
    [
        four(extinction, vertices as f32),
        four(reflected, constants::ENVIRONMENT_GLOSS),
        [shape.width, shape.tilt, shape.azimuthal_width, constants::OVERLAP],
        [
            constants::WET_DIFFUSE,
            constants::WET_RETURNED,
            constants::WET_REFLECTED,
            constants::WET_WIDTH,
        ],
        four(skin.colour, skin.gloss),
        [
            constants::WRAP,
            constants::SKIN_BIAS,
            constants::SKIN_PENUMBRA,
            constants::SKIN_GLOSS as f32,
        ],
        four(constants::seeping_reach(skin.scatter), constants::SKIN_SPREAD),
        [constants::SKIN_WIDEST, 0.0, 0.0, 0.0],
    ]
}

fn background(background: Background) -> [[f32; 4]; 2] {
    match background {
        Background::Transparent => [[0.0; 4]; 2],
        Background::Gradient { centre, corner } => [four(centre, 1.0), four(corner, 0.0)],
        Background::Environment => [[0.0, 0.0, 0.0, 2.0], [0.0; 4]],
    }
}

fn tone(tone: ToneCurve) -> f32 {
    match tone {
        ToneCurve::Plain => 0.0,
        ToneCurve::Shoulder => 1.0,
        ToneCurve::Filmic => 2.0,
    }
}

fn marks(frame: &Frame<'_>) -> [[f32; 4]; 2] {
    let colours = frame.mark_colours;
    let of = |c: [f32; 3]| Vec3::from(c.map(linear));
    [four(of(colours.chosen), colours.strength), four(of(colours.falling), colours.remains)]
}

/// A plane as the shaders have it, if it is one.
fn plane(plane: &Plane) -> Option<[[f32; 4]; 5]> {
    let [right, up] = plane.arms;
    let normal = right.cross(up).try_normalize()?;
    let over = |arm: Vec3| arm / arm.length_squared();
    let [r, g, b, a] = plane.colour;
    let sound = plane.centre.is_finite() && over(right).is_finite() && over(up).is_finite();
    let colour =
        [linear(r), linear(g), linear(b), if a.is_finite() { a.clamp(0.0, 1.0) } else { 0.0 }];
    sound.then(|| {
        [
            four(plane.centre, 1.0),
            four(over(right), 1.0),
            four(over(up), 0.0),
            four(normal, 0.0),
            colour,
        ]
    })
}
