//! The picture that a scene asks for.
//!
//! Lengths are metres, angles radians; the frame is the head's: x to its left, the face towards −y, z
//! up. Light is scene-linear sRGB.

use frisure::files::Files;
use frisure::formats::environment::Environment;
use frisure::look::{
    Aperture, AreaLight, Background, Camera, CameraError, Daylight, DistantLight, Dye,
    EnvironmentLight, EnvironmentMap, Fade, Floor, HairLook, HairSurface, InvalidLight, Lamp,
    Lights, Look, Melanin, PointLight, SOFTBOX, Setup, SkinLook, ToneCurve, absorption_of_colour,
    beside_camera, colour_of_temperature,
};
use frisure::render::{self, Image};
use frisure::scene::{
    self, Face, LampColour, LampFace, LampPlace, NaturalColour, Scene, SceneError,
};
use frisure::strands::{Strands, Surface};
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// Part of the picture's width or height that stays free on each side.
const MARGIN: f64 = 0.05;

/// The renderer's scene: camera, lamps and colours as `scene` says; all of `framed` would be in the
/// picture.
///
/// # Errors
/// [`InvalidLight`], for lamps that cannot be where the scene has them.
pub fn scene<'a>(
    scene: &Scene,
    strands: &'a Strands,
    framed: &Strands,
    surface: Option<&'a Surface>,
    environment: Option<&EnvironmentMap>,
) -> Result<render::Scene<'a>, InvalidLight> {
    let camera = framing(scene, framed, surface, aspect(scene));
    seen_from(scene, camera, (strands, framed), surface, environment)
}

/// The renderer's scene, seen from a camera of one's own; a floor is under all of `framed`.
///
/// # Errors
/// As [`scene()`].
pub fn seen_from<'a>(
    scene: &Scene,
    camera: Camera,
    (strands, framed): (&'a Strands, &Strands),
    surface: Option<&'a Surface>,
    environment: Option<&EnvironmentMap>,
) -> Result<render::Scene<'a>, InvalidLight> {
    let middle = render::head_centre(strands, surface);
    let (mut look, lights) = look_and_lights(scene, &camera, middle, environment)?;
    if let Some(colour) = scene.look.floor {
        look.floor = Some(floor(colour, framed, surface));
    }
    Ok(render::Scene { strands, surface, camera, lights, look })
}

/// What hair, skin and background look like, and what lights them, for a head with its middle
/// ([`render::head_centre`], m) somewhere. Studio lamps turn with the camera; sky and environment stay. There
/// is no floor in it.
///
/// # Errors
/// As [`scene()`].
pub fn look_and_lights(
    scene: &Scene,
    camera: &Camera,
    middle: DVec3,
    environment: Option<&EnvironmentMap>,
) -> Result<(Look, Lights), InvalidLight> {
    let lights = lights(&scene.light, camera, middle, environment)?;
    let behind = behind(scene.look.background, &lights, camera, middle);
    Ok((look(&scene.look, behind), lights))
}

/// The scene's camera in front of strands and the head without its shoulders, as near as it can be with
/// all of them in a picture of a width over height (`aspect`).
#[must_use]
pub fn framing(scene: &Scene, strands: &Strands, surface: Option<&Surface>, aspect: f64) -> Camera {
    camera(&scene.camera, shown(strands, surface), aspect)
}

/// The scene's lens at another place: `eye` and `target` in m, `field_of_view` from the picture's bottom
/// to its top.
///
/// # Errors
/// [`CameraError`], for an eye at the target, or a field of view that no lens has.
pub fn camera_at(
    scene: &Scene,
    eye: DVec3,
    target: DVec3,
    field_of_view: f64,
    aspect: f64,
) -> Result<Camera, CameraError> {
    let camera = Camera::look_at(eye, target, DVec3::Z, field_of_view)?;
    match scene.camera.f_number {
        Some(n) => {
            let asked = scene::Camera { field_of_view, ..scene.camera };
            camera.with_aperture(aperture(&asked, n, aspect))
        }
        None => Ok(camera),
    }
}

/// The cameras of a turntable, all at one distance, each with its lights: they walk around the head to
/// its left, so that it seems to turn to its right.
///
/// # Errors
/// As [`scene()`].
pub fn turntable(
    scene: &Scene,
    strands: &Strands,
    surface: Option<&Surface>,
    frames: usize,
    environment: Option<&EnvironmentMap>,
) -> Result<Vec<(Camera, Lights)>, InvalidLight> {
    let (low, high) = render::framed_bounds(strands, surface);
    let axis = 0.5 * (low + high);
    let points: Vec<DVec3> = shown(strands, surface).collect();
    let around = points.iter().step_by(AROUND).flat_map(|p| {
        let (radius, height) = ((*p - axis).truncate().length(), p.z);
        (0..AROUND).map(move |i| {
            let (s, c) = (i as f64 / AROUND as f64 * TAU).sin_cos();
            DVec3::new(axis.x + radius * c, axis.y + radius * s, height)
        })
    });
    let first = camera(&scene.camera, around, aspect(scene));
    turned(scene, first, (strands, surface), frames, environment)
}

/// The cameras of a turntable that begins at one of one's own, each with its lights.
///
/// # Errors
/// As [`scene()`].
pub fn turned(
    scene: &Scene,
    first: Camera,
    (strands, surface): (&Strands, Option<&Surface>),
    frames: usize,
    environment: Option<&EnvironmentMap>,
) -> Result<Vec<(Camera, Lights)>, InvalidLight> {
    let (low, high) = render::framed_bounds(strands, surface);
    let (axis, middle) = (0.5 * (low + high), render::head_centre(strands, surface));
    let frame = |i: usize| {
        let camera = first.turned(axis, i as f64 / frames as f64 * TAU);
        Ok((camera, lights(&scene.light, &camera, middle, environment)?))
    };
    (0..frames).map(frame).collect()
}

/// Places around the axis of a turntable at which its picture is framed.
const AROUND: usize = 24;

fn aspect(scene: &Scene) -> f64 {
    scene.output.width as f64 / scene.output.height as f64
}

/// Bytes for a PNG, four per pixel (red, green, blue, alpha; sRGB), rows from the top: light developed
/// as the scene says.
#[must_use]
pub fn developed(image: &Image, output: &scene::Output) -> Vec<u8> {
    let tone = match output.tone {
        scene::Tone::Plain => ToneCurve::Plain,
        scene::Tone::Shoulder => ToneCurve::Shoulder,
        scene::Tone::Filmic => ToneCurve::Filmic,
    };
    image.to_srgb8_with(tone, output.exposure as f32)
}

/// A floor under all there is.
fn floor(colour: [f64; 3], strands: &Strands, surface: Option<&Surface>) -> Floor {
    /// How far a bust, whose foot is round at its edge, sinks in (m), or it would seem to float.
    const FOOT: f64 = 0.02;
    /// Distance at which the floor is lost in the wall (m).
    const REACH: f64 = 1.6;
    let hair = strands.bounds().map(|(low, high)| (low.as_dvec3(), high.as_dvec3()));
    let (low, high) = match (surface.map(Surface::bounds), hair) {
        (Some(a), Some(b)) => (a.0.min(b.0), a.1.max(b.1)),
        (a, b) => a.or(b).unwrap_or_default(),
    };
    let stands = if surface.is_some_and(|s| s.bounds().0.z <= low.z) { FOOT } else { 0.0 };
    let middle = (0.5 * (low + high)).with_z(low.z + stands);
    Floor { centre: middle, radius: REACH, colour: linear(colour) }
}

/// The surroundings that a scene names, read and ready.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub fn environment(scene: &Scene, files: &Files) -> Result<Option<EnvironmentMap>, SceneError> {
    let Some(Environment { width, height, pixels }) = scene.environment_in(files)? else {
        return Ok(None);
    };
    let map = EnvironmentMap::new(width, height, pixels);
    map.map(Some).map_err(|e| scene.fault("light.environment", e.to_string(), ""))
}

/// Every so many points of the hair are enough to frame it.
const FRAMED_POINTS: usize = 50_000;

/// What a picture should have in it: the hair, and of the surface the head without the shoulders.
fn shown<'a>(
    strands: &'a Strands,
    surface: Option<&'a Surface>,
) -> impl Iterator<Item = DVec3> + Clone {
    let (low, high) = render::framed_bounds(strands, surface);
    // Whole hairs, or points at one distance from the root may all be left out; and every tip.
    let step = strands.points().len() / FRAMED_POINTS + 1;
    let points = |ends: &'a [u32]| &strands.points()[ends[0] as usize..ends[1] as usize];
    let whole = strands.offsets().windows(2).step_by(step).flat_map(points);
    let tips = strands.offsets().windows(2).filter_map(move |ends| points(ends).last());
    let hair = whole.chain(tips).map(|p| p.as_dvec3());
    let inside = move |p: &DVec3| p.cmpge(low).all() && p.cmple(high).all();
    let skin = surface.into_iter().flat_map(|s| s.positions().iter().copied());
    hair.chain(skin).filter(inside)
}

/// The camera that has all points in its picture, at the field of view asked for.
fn camera(
    asked: &scene::Camera,
    points: impl Iterator<Item = DVec3> + Clone,
    aspect: f64,
) -> Camera {
    let ends = |axis: DVec3| {
        points
            .clone()
            .map(|p| p.dot(axis))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
    };
    let unit = (DVec3::splat(-1.0), DVec3::ONE);
    let framed = Camera::framing(unit, asked.azimuth, asked.elevation, aspect);
    let (right, up, forward) = (framed.right(), framed.up(), framed.forward());
    let centre: DVec3 = [right, up, forward]
        .map(|axis| {
            let (low, high) = ends(axis);
            axis * (0.5 * (low + high))
        })
        .iter()
        .sum();
    let tan_v = (0.5 * asked.field_of_view).tan() * (1.0 - 2.0 * MARGIN);
    let tan_h = tan_v * aspect;
    let distance = points
        .map(|p| {
            let d = p - centre;
            (d.dot(right).abs() / tan_h).max(d.dot(up).abs() / tan_v) - d.dot(forward)
        })
        .fold(0.0, f64::max);
    let eye = centre - distance * forward;
    // Points of no extent have no direction to look in; the framing has one all the same.
    let camera = Camera::look_at(eye, centre, DVec3::Z, asked.field_of_view).unwrap_or(framed);
    match asked.f_number {
        // The scene's numbers were checked, and a lens that cannot be is a pinhole.
        Some(n) => camera.with_aperture(aperture(asked, n, aspect)).unwrap_or(camera),
        None => camera,
    }
}

/// The lens that has the field of view on a film of 24 × 36 mm.
fn aperture(asked: &scene::Camera, f_number: f64, aspect: f64) -> Aperture {
    let height = if aspect > 1.0 { 0.024 } else { 0.036 };
    let focal_length = 0.5 * height / (0.5 * asked.field_of_view).tan();
    Aperture { radius: 0.5 * focal_length / f_number, focus: asked.focus }
}

/// The lights that a scene asks for, around what stands in `middle` (m).
fn lights(
    asked: &scene::Light,
    camera: &Camera,
    middle: DVec3,
    environment: Option<&EnvironmentMap>,
) -> Result<Lights, InvalidLight> {
    let mut lights = Lights::setup(&setup(asked), camera)?;
    if let Some(Lamp::Distant(main)) = lights.lamps.first_mut() {
        if let Some((azimuth, elevation)) = asked.direction {
            *main = main.from_direction(beside_camera(camera, azimuth, elevation))?;
        }
        if let Some(size) = asked.size {
            *main = main.with_radius(0.5 * size)?;
        }
    }
    for asked in &asked.lamps {
        lights.lamps.push(lamp(asked, camera, middle)?);
    }
    let strength = Vec3::splat(asked.strength as f32);
    for lamp in &mut lights.lamps {
        *lamp = lamp.scaled(strength)?;
    }
    if let (Some(map), Some(file)) = (environment, &asked.environment) {
        lights.environment = EnvironmentLight::Map(map.clone().turned(file.rotation));
    }
    lights.environment = lights.environment.scaled(asked.sky_strength as f32);
    Ok(lights)
}

fn setup(asked: &scene::Light) -> Setup {
    let scene::Sun { azimuth, elevation, turbidity } = asked.sun;
    match asked.setup {
        scene::Setup::Studio => Setup::Studio,
        scene::Setup::Soft => Setup::Soft,
        scene::Setup::Butterfly => Setup::Butterfly,
        scene::Setup::Rembrandt => Setup::Rembrandt,
        scene::Setup::Rim => Setup::Rim,
        scene::Setup::Daylight => {
            Setup::Daylight(Daylight { sun_azimuth: azimuth, sun_elevation: elevation, turbidity })
        }
        scene::Setup::Overcast => Setup::Overcast,
        scene::Setup::Dark => Setup::Dark,
    }
}

/// Irradiance of the studio's main lamp.
const MAIN: f32 = 5.0;

fn lamp(asked: &scene::Lamp, camera: &Camera, middle: DVec3) -> Result<Lamp, InvalidLight> {
    let towards = |(azimuth, elevation)| beside_camera(camera, azimuth, elevation);
    let lamp: Lamp = match asked.place {
        LampPlace::Far { direction, angle } => {
            let radius = angle.map_or(SOFTBOX, |angle| 0.5 * angle);
            DistantLight::new(towards(direction), Vec3::ONE, radius)?.into()
        }
        LampPlace::Beside { direction, distance, face } => {
            placed(middle + distance * towards(direction), middle, face)?
        }
        LampPlace::At { position, face } => placed(position, middle, face)?,
    };
    let given = lamp.arriving(middle).map_or(1.0, |(_, irradiance)| irradiance.x);
    let colour = match asked.colour {
        LampColour::Srgb(colour) => linear(colour),
        LampColour::Temperature(kelvin) => colour_of_temperature(kelvin),
    };
    lamp.scaled(colour * (MAIN * asked.strength as f32 / given))
}

/// A lamp at a place that looks at the middle.
fn placed(at: DVec3, middle: DVec3, face: Option<LampFace>) -> Result<Lamp, InvalidLight> {
    let Some(LampFace { size, shown }) = face else {
        return Ok(PointLight::new(at, Vec3::ONE)?.into());
    };
    let facing = middle - at;
    let up =
        if facing.cross(DVec3::Z).length() > 1e-6 * facing.length() { DVec3::Z } else { DVec3::Y };
    let lamp = match size {
        Face::Disc(diameter) => AreaLight::disc(at, facing, 0.5 * diameter, Vec3::ONE)?,
        Face::Rectangle(sides) => AreaLight::rectangle(at, facing, up, sides, Vec3::ONE)?,
    };
    Ok(lamp.shown(shown).into())
}

/// What is behind a head that stands in `middle` (m).
fn behind(asked: scene::Behind, lights: &Lights, camera: &Camera, middle: DVec3) -> Background {
    match asked {
        scene::Behind::Wall => wall(lights, camera, middle),
        scene::Behind::Transparent => Background::Transparent,
        scene::Behind::Surroundings => Background::Environment,
        scene::Behind::Colour(colour) => {
            let colour = linear(colour);
            Background::Gradient { centre: colour, corner: colour }
        }
    }
}

/// The studio's wall in these lights: it is as bright as it looks in the studio's own.
fn wall(lights: &Lights, camera: &Camera, middle: DVec3) -> Background {
    let studio = on_wall(&Lights::studio(camera), camera, middle);
    let factor = on_wall(lights, camera, middle) / studio;
    match Background::default() {
        Background::Gradient { centre, corner } => {
            Background::Gradient { centre: centre * factor, corner: corner * factor }
        }
        other => other,
    }
}

/// Irradiance on a wall that faces the camera, as far behind the head as the lamps are before it, so
/// that a quarter of their light arrives.
fn on_wall(lights: &Lights, camera: &Camera, middle: DVec3) -> Vec3 {
    let lamps = lights.lamps.iter().filter_map(|lamp| lamp.arriving(middle));
    let faced = |towards: DVec3| (-towards.dot(camera.forward())).max(0.0) as f32;
    let lamps: Vec3 = lamps.map(|(towards, light)| 0.25 * faced(towards) * light).sum();
    lamps + std::f32::consts::PI * lights.environment.mean()
}

fn look(asked: &scene::Look, background: Background) -> Look {
    let default = Look::default();
    let colour = asked.skin.map_or(default.skin.colour, linear);
    Look {
        hair: hair_look(asked),
        skin: SkinLook { colour, ..default.skin },
        background,
        floor: None,
    }
}

/// What a scene says that its hair looks like.
#[must_use]
pub fn hair_look(asked: &scene::Look) -> HairLook {
    let default = HairLook::default();
    let or = |asked: Option<f64>, default: f32| asked.map_or(default, |value| value as f32);
    let plain = default.surface;
    let surface = HairSurface {
        longitudinal_roughness: or(asked.roughness, plain.longitudinal_roughness),
        azimuthal_roughness: or(asked.roughness_around, plain.azimuthal_roughness),
        tilt: or(asked.tilt, plain.tilt),
        index: or(asked.index, plain.index),
    };
    let of_colour = |srgb| absorption_of_colour(linear(srgb), surface.azimuthal_roughness);
    let (melanin, absorption) = match asked.natural {
        NaturalColour::Pigments { eumelanin, pheomelanin } => {
            let (eumelanin, pheomelanin) = (eumelanin as f32, pheomelanin as f32);
            (Melanin { eumelanin, pheomelanin }, None)
        }
        NaturalColour::Reflectance(srgb) => (default.melanin, Some(of_colour(srgb))),
        NaturalColour::Absorption(rgb) => {
            (default.melanin, Some(Vec3::from_array(rgb.map(|a| a as f32))))
        }
    };
    let fade = |asked: Option<scene::Fade>| {
        asked.map_or(Fade::default(), |fade| Fade {
            factor: fade.pigment as f32,
            length: fade.length as f32,
        })
    };
    let dye = asked.dye.map(|dye| Dye {
        absorption: of_colour(dye.colour),
        strength: dye.strength as f32,
        regrowth: dye.regrowth as f32,
    });
    HairLook {
        melanin,
        absorption,
        white_share: asked.white_share as f32,
        variation: or(asked.variation, default.variation),
        roots: fade(asked.roots),
        tips: fade(asked.tips),
        dye,
        surface,
        // The cast takes the low bits, which is as good a seed.
        seed: asked.seed as u32,
    }
}

/// Linear light of an sRGB colour (IEC 61966-2-1).
fn linear(srgb: [f64; 3]) -> Vec3 {
    let decode = |c: f64| {
        if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    Vec3::from_array(srgb.map(|c| decode(c) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: (DVec3, DVec3) = (DVec3::new(-0.1, -0.12, -0.3), DVec3::new(0.1, 0.09, 0.15));

    fn corners() -> impl Iterator<Item = DVec3> + Clone {
        (0..8_u8).map(|corner| {
            let pick = |bit: u8| f64::from(corner >> bit & 1);
            BOX.0 + DVec3::new(pick(0), pick(1), pick(2)) * (BOX.1 - BOX.0)
        })
    }

    #[test]
    fn the_whole_box_is_in_every_picture() {
        for degrees in [1.0, 24.0, 120.0] {
            for (azimuth, elevation, aspect) in
                [(0.0, 0.0, 1.0), (2.0, 1.4, 0.3), (-9.0, -1.4, 4.0)]
            {
                let field_of_view = f64::to_radians(degrees);
                let asked = scene::Camera {
                    azimuth,
                    elevation,
                    field_of_view,
                    f_number: None,
                    focus: None,
                };
                let camera = camera(&asked, corners(), aspect);
                let tan = (0.5 * field_of_view).tan();
                assert!((camera.vertical_fov() - field_of_view).abs() < 1e-12);
                for corner in corners() {
                    let d = corner - camera.eye();
                    let depth = d.dot(camera.forward());
                    assert!(depth > 0.0);
                    assert!(d.dot(camera.up()).abs() < depth * tan);
                    assert!(d.dot(camera.right()).abs() < depth * tan * aspect);
                }
            }
        }
    }

    fn straight() -> scene::Camera {
        let (azimuth, elevation, field_of_view) = (0.0, 0.0, 0.4);
        scene::Camera { azimuth, elevation, field_of_view, f_number: None, focus: None }
    }

    #[test]
    fn every_tip_is_in_the_picture_however_many_points_there_are() {
        // As many points that every so manyth is never a tip, and one hair longer than all others.
        let mut strands = Strands::new();
        for i in 0..4000_u16 {
            let length = if i == 1234 { 0.4 } else { 0.2 };
            let points: Vec<Vec3> =
                (0..50_u8).map(|k| Vec3::NEG_Z * length * f32::from(k) / 49.0).collect();
            strands.push(&points, &[3e-5; 50]);
        }
        let lowest = shown(&strands, None).map(|p| p.z).fold(0.0, f64::min);
        assert!((lowest + 0.4).abs() < 1e-6, "{lowest}");
    }

    #[test]
    fn a_portrait_lens_at_2_8_opens_by_15_mm() {
        let asked = scene::Camera { f_number: Some(2.8), ..straight() };
        let asked = scene::Camera { field_of_view: f64::to_radians(23.9), ..asked };
        let camera = camera(&asked, corners(), 0.8);
        assert!((camera.aperture().unwrap().radius - 0.0152).abs() < 2e-4);
    }

    fn lit(text: &str) -> Lights {
        let asked = straight();
        let camera = camera(&asked, corners(), 1.0);
        let text = format!("[light]\n{text}");
        let scene = Scene::parse("a", text, std::path::Path::new("")).unwrap();
        lights(&scene.light, &camera, DVec3::ZERO, None).unwrap()
    }

    #[test]
    fn the_lamp_stands_where_it_is_asked_for() {
        let direction = |text: &str| lit(text).lamps[0].arriving(DVec3::ZERO).unwrap().0;
        // The camera faces the face, which looks along −y.
        assert!(direction("azimuth = 0\nelevation = 0").distance(-DVec3::Y) < 1e-12);
        assert!(direction("azimuth = '90 deg'\nelevation = 0").distance(-DVec3::X) > 1.9);
        assert!(direction("azimuth = 0.3\nelevation = '90 deg'").distance(DVec3::Z) < 1e-9);
    }

    fn wall_of(text: &str) -> Vec3 {
        let camera = camera(&straight(), corners(), 1.0);
        match wall(&lit(text), &camera, DVec3::ZERO) {
            Background::Gradient { centre, .. } => centre,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_wall_has_the_light_of_the_setup() {
        let Background::Gradient { centre: studio, .. } = Background::default() else {
            unreachable!()
        };
        assert_eq!(wall_of(""), studio);
        assert_eq!(wall_of("setup = 'dark'"), Vec3::ZERO);
        let of = |setup| wall_of(&format!("setup = '{setup}'")).y / studio.y;
        let scale = ["soft", "studio", "butterfly", "rembrandt", "rim"].map(of);
        assert!(scale.is_sorted_by(|a, b| a > b), "{scale:?}");
        // Lamps behind the head do not reach the wall's face, and are seen against it.
        let behind = "setup = 'dark'\n[[light.lamp]]\nazimuth = '180 deg'";
        assert_eq!(wall_of(behind), Vec3::ZERO);
        let twice = wall_of("strength = 2\nsky_strength = 2");
        assert!((twice / studio - Vec3::splat(2.0)).abs().max_element() < 1e-5);
    }

    #[test]
    fn a_lamp_is_as_bright_wherever_it_stands_and_however_large_it_is() {
        let ways = [
            "azimuth = 0",
            "azimuth = 0\nangle = '40 deg'",
            "azimuth = 0\ndistance = '1 m'",
            "azimuth = 0\ndistance = '3 m'\nsize = '1 m'",
            "position = [0, -2, 0]\nsize = ['50 cm', '2 m']",
            "elevation = '90 deg'\ndistance = '70 cm'\nsize = ['50 cm', '2 m']",
        ];
        for way in ways {
            let lights = lit(&format!("setup = 'dark'\n[[light.lamp]]\nstrength = 2\n{way}"));
            let (towards, irradiance) = lights.lamps[0].arriving(DVec3::ZERO).unwrap();
            assert!((irradiance - Vec3::splat(2.0 * MAIN)).abs().max_element() < 1e-3, "{way}");
            assert!(towards.y < -0.99 || towards.z > 0.99);
        }
    }
}
