//! What each place of a head is made of: skin with its reds, lips, a garment, and eyes; and what accessories are made of.

use frisure_look::SkinLook;
use frisure_strands::{AccessoryMaterial, Eye, Features, Tint};
use glam::{DVec3, Vec3};

use crate::noise::{cell, noise, unit};

/// The material of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Diffuse reflectance, linear sRGB.
    pub colour: Vec3,
    /// Strength of the gloss, in units of [`SkinLook::gloss`].
    pub gloss: f32,
    /// Roughness of the gloss (α of GGX).
    pub roughness: f32,
    /// Whether light scatters beneath the surface.
    pub scatters: bool,
    /// The normal of the surface, where it is known better than from the mesh.
    pub normal: Option<Vec3>,
    /// The place (m) of the surface, where it is known better than from the mesh.
    pub place: Option<Vec3>,
}

/// Roughness of the coat of skin (α of GGX); chosen by eye.
pub const SKIN_ROUGHNESS: f32 = 0.3;

/// Roughness of a wet cornea (α of GGX); chosen.
const CORNEA_ROUGHNESS: f32 = 0.05;

/// Reflectance of lips and of skin with blood near its surface, over that of the skin around. Chosen: after the ratio of
/// lip and cheek to forehead in portraits, about −10 in CIELAB's L* and +8 in a* for lips.
const LIPS: Vec3 = Vec3::new(0.83, 0.58, 0.60);
const FLUSH: Vec3 = Vec3::new(0.98, 0.80, 0.80);

/// Reflectance of the scalp over that of the face: hairs beneath the skin show through, as they do on a shaven head. Chosen by eye.
const SCALP: Vec3 = Vec3::new(0.76, 0.68, 0.65);

/// Linear reflectance of the white of an eye, and of its corners. Chosen by eye: about two thirds of that of fair skin, as in portraits, where
/// sockets, lids and lashes keep off more light than those of the built-in heads do.
const SCLERA: Vec3 = Vec3::new(0.40, 0.365, 0.34);
const CORNER: Vec3 = Vec3::new(0.38, 0.25, 0.22);

/// Sine of the angle from the gaze to the edge of the iris and of the pupil: an iris of 11.8 mm on a ball of 24 mm
/// (Rüfer et al. 2005, doi:10.1097/01.ico.0000148312.01805.53), and a pupil of 4 mm in a lit room.
const IRIS: f32 = 0.44;

/// Heights above the gaze, in radii of the ball, from which on the upper lid darkens it, and where it does so most; and by how much. Chosen by eye.
const UNDER_LID: [f32; 2] = [-0.05, 0.28];
const LID_SHADE: f32 = 0.7;

/// Radius of the ball over that of the cornea: 12 over 7.8 mm.
const CORNEA: f32 = 1.54;
const PUPIL: f32 = 0.15;

/// How far (radii of the ball) before the cornea the light is taken that falls on it: the lids of the built-in heads are thicker at their edge than those of people,
/// and would hide every lamp above the eyes. Chosen by eye.
const LIDS: f32 = 0.17;

/// Scales of the relief of skin (m), and the root mean square of the slope of each. The furrows of skin are 0.3 to 1 mm apart and slope by 0.1 to 0.3 in profiles;
/// the finest are left to the roughness. Chosen by eye among those.
const SKIN_RELIEF: [(f32, f32); 3] = [(2.6e-3, 0.05), (1.1e-3, 0.09), (0.5e-3, 0.10)];

/// Scales of the spots of skin (m) and relative deviation of the reflectance of each. Chosen by eye.
const SKIN_SPOTS: [(f32, f32); 3] = [(8e-3, 0.03), (2.5e-3, 0.03), (0.8e-3, 0.03)];

/// Deviation of the blood near the surface from place to place, in units of [`FLUSH`], and its scale (m). Chosen.
const BLOOD: (f32, f32) = (0.15, 11e-3);

/// Freckles and moles: side of the cells (m) of which a part has one, their radius (m), and reflectance over that of the skin around. Chosen by eye.
const FRECKLES: (f32, f32) = (7e-3, 0.16);
const FRECKLE_RADIUS: [f32; 2] = [0.35e-3, 0.9e-3];
const FRECKLE: Vec3 = Vec3::new(0.70, 0.58, 0.48);

/// Furrows of lips: distances (m) across, in depth and along, and their slope. Chosen by eye.
const LIP_FURROWS: Vec3 = Vec3::new(0.9e-3, 3e-3, 4.5e-3);
const LIP_SLOPE: f32 = 0.22;

/// Threads of the jersey of a garment: their distances (m), the deviation of their colour and their slope; and the wrinkles of the cloth. Chosen by eye.
const THREADS: Vec3 = Vec3::new(0.7e-3, 0.7e-3, 1.6e-3);
const THREAD_COLOUR: f32 = 0.22;
const THREAD_SLOPE: f32 = 0.25;
const WRINKLES: [(f32, f32); 2] = [(60e-3, 0.10), (22e-3, 0.05)];

/// Standard deviation of [`noise`], and root mean square of its gradient.
const NOISE: f32 = 0.25;
const NOISE_SLOPE: f32 = 0.75;

/// The material at `p` (m), where the tint is `tint`. With the unit `normal` of the surface it has the relief of what it is made of; without it
/// only spots, for pictures whose pixels are larger than a pore.
#[must_use]
pub fn material(
    features: Option<&Features>,
    tint: Tint,
    (p, normal): (Vec3, Option<Vec3>),
    look: &SkinLook,
) -> Material {
    if let Some(eye) = features.and_then(|features| features.eye_at(p.as_dvec3())) {
        return eyeball(eye, p.as_dvec3(), look);
    }
    let skin = Material {
        colour: look.colour,
        gloss: look.gloss,
        roughness: SKIN_ROUGHNESS,
        scatters: true,
        normal: None,
        place: None,
    };
    let normal = normal.filter(|_| look.texture > 0.0);
    if is_garment(tint.garment) {
        let colour = (look.garment * cloth_shade(p, look.texture)).min(Vec3::ONE);
        let normal = normal.map(|normal| bent(normal, cloth_slope(p), look.texture));
        return Material { colour, gloss: 0.0, scatters: false, normal, ..skin };
    }
    let mix = |to: Vec3, part: f32| Vec3::ONE.lerp(to, part.clamp(-1.0, 1.0));
    let lips = tint.lips.clamp(0.0, 1.0);
    let spots = if look.texture > 0.0 { spots(p, look.texture * (1.0 - lips)) } else { Vec3::ONE };
    let colour = look.colour
        * mix(FLUSH, tint.flush)
        * mix(LIPS, tint.lips.max(0.0))
        * mix(SCALP, tint.scalp.max(0.0))
        * spots;
    // Spots lighter than the palest skin would give back more light than falls in.
    let colour = colour.min(Vec3::ONE);
    // Lips are moist.
    let roughness = SKIN_ROUGHNESS + (0.2 - SKIN_ROUGHNESS) * lips;
    let normal = normal.map(|normal| bent(normal, skin_slope(p, lips), look.texture));
    Material { colour, roughness, gloss: look.gloss * (1.0 + 0.4 * tint.lips), normal, ..skin }
}

/// Whether a place is a garment, where that much of its tint is one ([`Tint::garment`]).
pub(crate) fn is_garment(tint: f32) -> bool {
    tint > 0.5
}

/// A unit normal on a surface that rises by `slope` (m/m, of which only the part along the surface counts).
fn bent(normal: Vec3, slope: Vec3, strength: f32) -> Vec3 {
    let along = slope - normal * slope.dot(normal);
    (normal - along * strength).normalize_or(normal)
}

/// Slope of the relief of skin.
fn skin_slope(p: Vec3, lips: f32) -> Vec3 {
    let skin: Vec3 = (0..).zip(SKIN_RELIEF).map(|(seed, scale)| slope(p, scale, seed)).sum();
    if lips <= 0.0 {
        return skin;
    }
    let furrows = noise(p / LIP_FURROWS, 11).1 * (LIP_FURROWS.x / LIP_FURROWS);
    skin.lerp(0.5 * skin + furrows * (LIP_SLOPE / NOISE_SLOPE), lips)
}

fn slope(p: Vec3, (scale, slope): (f32, f32), seed: u32) -> Vec3 {
    noise(p / scale, seed).1 * (slope / NOISE_SLOPE)
}

/// Reflectance of skin over its mean: blotches, blood and freckles.
fn spots(p: Vec3, strength: f32) -> Vec3 {
    let blotches: f32 = (20..)
        .zip(SKIN_SPOTS)
        .map(|(seed, (scale, deviation))| noise(p / scale, seed).0 * (deviation / NOISE))
        .sum();
    let (part, scale) = BLOOD;
    let blood = Vec3::ONE.lerp(FLUSH, strength * noise(p / scale, 30).0 * (part / NOISE));
    let freckle = Vec3::ONE.lerp(FRECKLE, strength.min(1.0) * freckle(p));
    blood * freckle * (1.0 + strength * blotches).max(0.2)
}

/// How much of a freckle there is at a place, from 0 to 1.
fn freckle(p: Vec3) -> f32 {
    let (side, part) = FRECKLES;
    let at = (p / side).floor();
    let bits = cell(at.as_ivec3(), 40);
    if unit(bits) >= part {
        return 0.0;
    }
    let number = |seed: u32| unit(cell(at.as_ivec3(), seed));
    let centre = (at + Vec3::new(number(41), number(42), number(43)) * 0.6 + 0.2) * side;
    let radius = FRECKLE_RADIUS[0] + (FRECKLE_RADIUS[1] - FRECKLE_RADIUS[0]) * number(44).powi(2);
    // Its edge is uneven.
    let distance = p.distance(centre) * (1.0 + 0.6 * noise(p / 0.9e-3, 45).0);
    let inside = (1.4 - distance / radius).clamp(0.0, 1.0);
    inside * inside * (3.0 - 2.0 * inside) * (0.3 + 0.5 * number(46))
}

/// Reflectance of a garment over its mean: threads of a heathered jersey.
fn cloth_shade(p: Vec3, strength: f32) -> f32 {
    let threads = noise(p / THREADS, 50).0 * (THREAD_COLOUR / NOISE);
    (1.0 + strength * threads).max(0.3)
}

fn cloth_slope(p: Vec3) -> Vec3 {
    let threads = noise(p / THREADS, 51).1 * (THREADS.x / THREADS) * (THREAD_SLOPE / NOISE_SLOPE);
    (60..).zip(WRINKLES).map(|(seed, scale)| slope(p, scale, seed)).sum::<Vec3>() + threads
}

fn eyeball(eye: &Eye, p: DVec3, look: &SkinLook) -> Material {
    let out = ((p - eye.centre) / eye.radius).as_vec3();
    let gaze = eye.gaze.as_vec3();
    let across = out - gaze * out.dot(gaze);
    let sine = if out.dot(gaze) > 0.0 { across.length() } else { 1.0 };
    let (x, z) = gaze.any_orthonormal_pair();
    let turn = across.dot(z).atan2(across.dot(x));
    let smooth = |from: f32, to: f32| {
        let t = ((sine - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    // Fibres of the iris: waves around the pupil, of which each part of the iris has its own, and a collarette a third of the way out.
    let (sin, cos) = turn.sin_cos();
    let fine = noise(Vec3::new(13.0 * cos, 13.0 * sin, 9.0 * sine), 70).0;
    let coarse = noise(Vec3::new(5.0 * cos, 5.0 * sin, 5.0 * sine), 71).0;
    let collarette = 1.0 - ((sine - 0.23) / 0.05).abs().min(1.0);
    let warm = Vec3::new(1.35, 1.05, 0.75);
    let iris = look.iris * (0.65 + 0.6 * fine + 0.35 * coarse + 0.25 * collarette).max(0.1);
    let iris =
        iris * Vec3::ONE.lerp(warm, 1.0 - smooth(0.17, 0.30)) * (1.0 - 0.3 * smooth(0.15, 0.40));
    let iris = iris.lerp(look.iris * 0.10, smooth(0.33, IRIS));
    // Veins towards the corners.
    let veins = noise(out * Vec3::new(9.0, 9.0, 22.0), 72).0.abs();
    let veins = (1.0 - veins / 0.08).max(0.0) * smooth(0.5, 0.8) * look.texture.min(1.0);
    let white = SCLERA.lerp(CORNER, (0.7 * smooth(0.62, 0.95) + 0.25 * veins).min(1.0));
    let colour = Vec3::splat(0.004).lerp(iris, smooth(PUPIL - 0.015, PUPIL + 0.015));
    let colour = colour.lerp(white, smooth(IRIS - 0.04, IRIS + 0.03));
    // Lashes and the edge of the upper lid, which are finer than the mesh, keep light from what is just beneath them.
    let up = (DVec3::Z - eye.gaze * eye.gaze.z).normalize_or_zero().as_vec3();
    let under = ((out.dot(up) - UNDER_LID[0]) / (UNDER_LID[1] - UNDER_LID[0])).clamp(0.0, 1.0);
    let colour = colour * (1.0 - LID_SHADE * under * under * (3.0 - 2.0 * under));
    // The cornea bulges: over the iris its normal turns by the ratio of the radii faster.
    let steep = sine * (CORNEA + (1.0 - CORNEA) * smooth(IRIS - 0.02, IRIS + 0.08));
    let normal = gaze * (1.0 - steep * steep).max(0.0).sqrt() + across.normalize_or_zero() * steep;
    let place = (out.dot(gaze) > 0.0 && sine < IRIS).then(|| {
        (eye.centre + eye.radius * (gaze * (cornea_height(sine) + LIDS) + across).as_dvec3())
            .as_vec3()
    });
    Material {
        colour,
        // A refractive index of 1.376 of the cornea: 2.5 % at normal incidence.
        gloss: 0.105,
        roughness: CORNEA_ROUGHNESS,
        scatters: false,
        normal: Some(if out.dot(gaze) > 0.0 {
            normal.normalize_or(gaze)
        } else {
            out.normalize_or(gaze)
        }),
        place,
    }
}

/// How far along the gaze the cornea stands before the middle of the ball, `sine` beside the gaze (radii of the ball): a cap of
/// its own radius on the edge of the iris.
fn cornea_height(sine: f32) -> f32 {
    let sagitta = |at: f32| (1.0 / (CORNEA * CORNEA) - at * at).max(0.0).sqrt();
    (1.0 - IRIS * IRIS).sqrt() + sagitta(sine) - sagitta(IRIS)
}

/// The material of an accessory.
#[must_use]
pub fn accessory_material(of: &AccessoryMaterial) -> Material {
    let AccessoryMaterial { colour, gloss, roughness, .. } = *of;
    Material { colour: colour.into(), gloss, roughness, scatters: false, normal: None, place: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texture_keeps_the_mean_colour_and_bends_normals_a_little() {
        let look = SkinLook { texture: 1.0, ..SkinLook::default() };
        let smooth = SkinLook { texture: 0.0, ..look };
        for tint in [Tint::default(), Tint { garment: 1.0, ..Tint::default() }] {
            let place = |i: usize| Vec3::new(0.061, 0.037, 0.029) * i as f32;
            let at =
                |i: usize, look: &SkinLook| material(None, tint, (place(i), Some(Vec3::Z)), look);
            let plain = at(0, &smooth);
            assert!(plain.normal.is_none() && at(7, &smooth) == plain);
            let count = 5000;
            let mean = (0..count).map(|i| at(i, &look).colour).sum::<Vec3>() / count as f32;
            let ratio = mean / plain.colour;
            // Freckles darken it a little.
            assert!(ratio.max_element() < 1.01 && ratio.min_element() > 0.96, "{ratio}");
            let bends: Vec<f32> =
                (0..count).map(|i| at(i, &look).normal.unwrap().angle_between(Vec3::Z)).collect();
            let mean = bends.iter().sum::<f32>() / count as f32;
            assert!((0.05..0.4).contains(&mean), "{mean}");
            assert!(bends.iter().all(|angle| *angle < 1.2));
            let pale = SkinLook { colour: Vec3::ONE, garment: Vec3::ONE, texture: 3.0, ..look };
            assert!((0..count).all(|i| at(i, &pale).colour.max_element() <= 1.0));
        }
    }

    #[test]
    fn a_cornea_bulges_over_the_iris_alone() {
        let eye = Eye { centre: DVec3::ZERO, radius: 0.012, gaze: -DVec3::Y };
        let features = Features { eyes: vec![eye], ..Features::default() };
        let normal = |sine: f64| {
            let out = DVec3::new(sine, -(1.0 - sine * sine).sqrt(), 0.0);
            let place = ((0.012 * out).as_vec3(), None);
            let found = material(Some(&features), Tint::default(), place, &SkinLook::default());
            (found.normal.unwrap().x, found.normal.unwrap().length())
        };
        assert!((normal(0.3).0 - 0.3 * CORNEA).abs() < 1e-3);
        assert!((normal(0.7).0 - 0.7).abs() < 1e-3);
        assert!((0..20).all(|i| (normal(0.05 * f64::from(i)).1 - 1.0).abs() < 1e-5));
    }

    #[test]
    fn a_cornea_is_a_cap_on_the_edge_of_the_iris() {
        let ball = |sine: f32| (1.0 - sine * sine).sqrt();
        assert!((cornea_height(IRIS) - ball(IRIS)).abs() < 1e-6);
        // Sagittae of an iris of 5.3 mm on balls of 7.8 and 12 mm: 2.08 and 1.23 mm.
        let bulge = 12.0 * (cornea_height(0.0) - ball(0.0));
        assert!((bulge - (2.08 - 1.23)).abs() < 0.02, "{bulge}");
        // Its slope is that of a sphere of 7.8 mm.
        let slope = (cornea_height(0.31) - cornea_height(0.29)) / 0.02;
        let sine = 0.3 * CORNEA;
        assert!((slope + sine / (1.0 - sine * sine).sqrt()).abs() < 1e-2, "{slope}");
    }

    #[test]
    fn an_eye_has_a_dark_pupil_a_coloured_iris_and_a_white() {
        let eye = Eye { centre: DVec3::ZERO, radius: 0.012, gaze: -DVec3::Y };
        let features = Features { eyes: vec![eye], ..Features::default() };
        let look = SkinLook { iris: Vec3::new(0.05, 0.1, 0.3), ..SkinLook::default() };
        let at = |sine: f64| {
            let out = DVec3::new(sine, -(1.0 - sine * sine).sqrt(), 0.0);
            material(Some(&features), Tint::default(), ((0.012 * out).as_vec3(), None), &look)
        };
        assert!(at(0.05).colour.max_element() < 0.02);
        assert!(at(0.25).colour.z > 2.0 * at(0.25).colour.x);
        assert!(at(0.6).colour.min_element() > 0.3);
        assert!(!at(0.6).scatters && at(0.6).normal.is_some());
        let skin = material(Some(&features), Tint::default(), (Vec3::X, None), &look);
        assert_eq!(skin.colour, look.colour);
        let scalp = Tint { scalp: 1.0, ..Tint::default() };
        let scalp = material(None, scalp, (Vec3::X, None), &look).colour / look.colour;
        assert!(scalp.distance(SCALP) < 1e-6);
        let lips = Tint { lips: 1.0, ..Tint::default() };
        let lips = material(None, lips, (Vec3::X, None), &look).colour / look.colour;
        assert!(lips.x > 1.3 * lips.y);
        let dressed = Tint { garment: 0.9, ..Tint::default() };
        assert_eq!(material(None, dressed, (Vec3::X, None), &look).colour, look.garment);
    }
}
