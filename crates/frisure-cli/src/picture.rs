//! The picture that a scene asks for.

use frisure::io::scene::{self, NaturalColour, Scene};
use frisure::optics::{Melanin, absorption_of_colour};
use frisure::render::preview;
use frisure::render::{
    Aperture, Background, Camera, DirectionalLight, Dye, Fade, Ground, HairLook, HairSurface,
    Image, Lights, Look, SkinLook, ToneCurve,
};
use frisure::strands::{Strands, Surface};
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// Part of the picture's width or height that stays free on each side.
const MARGIN: f64 = 0.05;

/// The renderer's scene: camera, lamps and colours as `scene` says; all of `framed` would be in the
/// picture.
pub(crate) fn scene<'a>(
    scene: &Scene,
    strands: &'a Strands,
    framed: &Strands,
    surface: Option<&'a Surface>,
) -> preview::Scene<'a> {
    let camera = camera(&scene.camera, shown(framed, surface), aspect(scene));
    let lights = lights(&scene.light, &camera);
    let mut look = look(&scene.look);
    if let Some(colour) = scene.look.floor {
        look.ground = Some(floor(colour, framed, surface));
    }
    preview::Scene { strands, surface, camera, lights, look }
}

/// The cameras of a turntable, all at one distance, each with its lights: they walk around the head to
/// its left, so that it seems to turn to its right.
pub(crate) fn turntable(
    scene: &Scene,
    strands: &Strands,
    surface: Option<&Surface>,
    frames: usize,
) -> Vec<(Camera, Lights)> {
    let (low, high) = preview::bounds(strands, surface);
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
    let frame = |i: usize| {
        let camera = first.turned(axis, i as f64 / frames as f64 * TAU);
        (camera, lights(&scene.light, &camera))
    };
    (0..frames).map(frame).collect()
}

/// Places around the axis of a turntable at which its picture is framed.
const AROUND: usize = 24;

fn aspect(scene: &Scene) -> f64 {
    scene.output.width as f64 / scene.output.height as f64
}

/// Bytes for a PNG: light developed as the scene says.
pub(crate) fn developed(image: &Image, output: &scene::Output) -> Vec<u8> {
    let tone = match output.tone {
        scene::Tone::Plain => ToneCurve::Plain,
        scene::Tone::Shoulder => ToneCurve::Shoulder,
        scene::Tone::Filmic => ToneCurve::Filmic,
    };
    image.to_srgb8_with(tone, output.exposure as f32)
}

/// A floor under all there is.
fn floor(colour: [f64; 3], strands: &Strands, surface: Option<&Surface>) -> Ground {
    /// Distance at which the floor is lost in the wall (m).
    const REACH: f64 = 1.6;
    let hair = strands.bounds().map(|(low, high)| (low.as_dvec3(), high.as_dvec3()));
    let (low, high) = match (surface.map(Surface::bounds), hair) {
        (Some(a), Some(b)) => (a.0.min(b.0), a.1.max(b.1)),
        (a, b) => a.or(b).unwrap_or_default(),
    };
    let middle = (0.5 * (low + high)).with_z(low.z);
    Ground { middle, reach: REACH, colour: linear(colour) }
}

/// Every so many points of the hair are enough to frame it.
const FRAMED_POINTS: usize = 50_000;

/// What a picture should have in it: the hair, and of the surface the head without the shoulders.
fn shown<'a>(
    strands: &'a Strands,
    surface: Option<&'a Surface>,
) -> impl Iterator<Item = DVec3> + Clone {
    let (low, high) = preview::bounds(strands, surface);
    let step = strands.points().len() / FRAMED_POINTS + 1;
    let hair = strands.points().iter().step_by(step).map(|p| p.as_dvec3());
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

fn lights(asked: &scene::Light, camera: &Camera) -> Lights {
    let mut lights = Lights::studio(camera);
    if let (Some((azimuth, elevation)), Some(key)) = (asked.direction, lights.lamps.first_mut()) {
        let (right, back) = (camera.right(), camera.right().cross(DVec3::Z));
        let (sa, ca) = azimuth.sin_cos();
        let level = sa * right + ca * back;
        let direction = elevation.cos() * level + elevation.sin() * DVec3::Z;
        *key = DirectionalLight { direction: direction.normalize(), ..*key };
    }
    let strength = asked.strength as f32;
    for lamp in &mut lights.lamps {
        lamp.irradiance *= strength;
    }
    lights
}

fn look(asked: &scene::Look) -> Look {
    let default = Look::default();
    let colour = asked.skin.map_or(default.skin.colour, linear);
    let background = match asked.background {
        scene::Behind::Wall => default.background,
        scene::Behind::Transparent => Background::Transparent,
        scene::Behind::Surroundings => Background::Surroundings,
        scene::Behind::Colour(colour) => {
            let colour = linear(colour);
            Background::Gradient { centre: colour, corner: colour }
        }
    };
    Look { hair: hair(asked), skin: SkinLook { colour, ..default.skin }, background, ground: None }
}

fn hair(asked: &scene::Look) -> HairLook {
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
    fn a_portrait_lens_at_2_8_opens_by_15_mm() {
        let asked = scene::Camera { f_number: Some(2.8), ..straight() };
        let asked = scene::Camera { field_of_view: f64::to_radians(23.9), ..asked };
        let camera = camera(&asked, corners(), 0.8);
        assert!((camera.aperture().unwrap().radius - 0.0152).abs() < 2e-4);
    }

    #[test]
    fn the_lamp_stands_where_it_is_asked_for() {
        let asked = straight();
        let camera = camera(&asked, corners(), 1.0);
        let lamp = |azimuth, elevation| {
            let light = scene::Light { direction: Some((azimuth, elevation)), strength: 1.0 };
            lights(&light, &camera).lamps[0].direction
        };
        let right = std::f64::consts::FRAC_PI_2;
        // The camera faces the face, which looks along −y.
        assert!(lamp(0.0, 0.0).distance(-DVec3::Y) < 1e-12);
        assert!(lamp(right, 0.0).distance(camera.right()) < 1e-12);
        assert!(lamp(0.3, right).distance(DVec3::Z) < 1e-12);
    }
}
