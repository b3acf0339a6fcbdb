//! What each place of a head is made of: skin with its reds, lips, a garment, and eyes; and what accessories are made of.

use frisure_look::SkinLook;
use frisure_strands::{AccessoryMaterial, Eye, Features, Tint};
use glam::{DVec3, Vec3};

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
}

/// Roughness of the coat of skin (α of GGX); chosen by eye.
pub const SKIN_ROUGHNESS: f32 = 0.3;

/// Roughness of a wet cornea (α of GGX); chosen.
const CORNEA_ROUGHNESS: f32 = 0.05;

/// Reflectance of lips and of skin with blood near its surface, over that of the skin around. Chosen: after the ratio of
/// lip and cheek to forehead in portraits, about −10 in CIELAB's L* and +8 in a* for lips.
const LIPS: Vec3 = Vec3::new(0.83, 0.58, 0.60);
const FLUSH: Vec3 = Vec3::new(0.98, 0.80, 0.80);

/// Linear reflectance of the white of an eye, and of its corners. Chosen.
const SCLERA: Vec3 = Vec3::new(0.60, 0.56, 0.52);
const CORNER: Vec3 = Vec3::new(0.50, 0.33, 0.29);

/// Sine of the angle from the gaze to the edge of the iris and of the pupil: an iris of 11.8 mm on a ball of 24 mm
/// (Rüfer et al. 2005, doi:10.1097/01.ico.0000148312.01805.53), and a pupil of 4 mm in a lit room.
const IRIS: f32 = 0.44;
const PUPIL: f32 = 0.15;

/// The material at `p` (m), where the tint is `tint`.
#[must_use]
pub fn material(features: Option<&Features>, tint: Tint, p: Vec3, look: &SkinLook) -> Material {
    if let Some(eye) = features.and_then(|features| features.eye_at(p.as_dvec3())) {
        return eyeball(eye, p.as_dvec3(), look);
    }
    let skin = Material {
        colour: look.colour,
        gloss: look.gloss,
        roughness: SKIN_ROUGHNESS,
        scatters: true,
        normal: None,
    };
    if tint.garment > 0.5 {
        return Material { colour: look.garment, gloss: 0.0, scatters: false, ..skin };
    }
    let mix = |to: Vec3, part: f32| Vec3::ONE.lerp(to, part.clamp(0.0, 1.0));
    let colour = look.colour * mix(FLUSH, tint.flush) * mix(LIPS, tint.lips);
    // Lips are moist.
    let roughness = SKIN_ROUGHNESS + (0.2 - SKIN_ROUGHNESS) * tint.lips.clamp(0.0, 1.0);
    Material { colour, roughness, gloss: look.gloss * (1.0 + 0.4 * tint.lips), ..skin }
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
    // Fibres of the iris: waves around the pupil, lighter towards its middle, dark at the rim.
    let waves = [(11.0, 0.3), (23.0, 1.7), (37.0, 4.1), (58.0, 2.2)];
    let fibres: f32 = waves.iter().map(|(n, at)| (n * turn + at + 5.0 * sine).sin()).sum();
    let iris = look.iris * (1.15 + 0.16 * fibres) * (1.5 - 1.6 * sine);
    let iris = iris.lerp(look.iris * 0.12, smooth(0.36, IRIS));
    let white = SCLERA.lerp(CORNER, 0.7 * smooth(0.62, 0.95));
    let colour = Vec3::splat(0.006).lerp(iris, smooth(PUPIL - 0.015, PUPIL + 0.015));
    let colour = colour.lerp(white, smooth(IRIS - 0.03, IRIS + 0.02));
    Material {
        colour,
        // A refractive index of 1.376 of the cornea: 2.5 % at normal incidence.
        gloss: 0.105,
        roughness: CORNEA_ROUGHNESS,
        scatters: false,
        normal: Some(out.normalize_or(gaze)),
    }
}

/// The material of an accessory.
#[must_use]
pub fn accessory_material(of: &AccessoryMaterial) -> Material {
    let AccessoryMaterial { colour, gloss, roughness, .. } = *of;
    Material { colour: colour.into(), gloss, roughness, scatters: false, normal: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eye_has_a_dark_pupil_a_coloured_iris_and_a_white() {
        let eye = Eye { centre: DVec3::ZERO, radius: 0.012, gaze: -DVec3::Y };
        let features = Features { eyes: vec![eye], ..Features::default() };
        let look = SkinLook { iris: Vec3::new(0.05, 0.1, 0.3), ..SkinLook::default() };
        let at = |sine: f64| {
            let out = DVec3::new(sine, -(1.0 - sine * sine).sqrt(), 0.0);
            material(Some(&features), Tint::default(), (0.012 * out).as_vec3(), &look)
        };
        assert!(at(0.05).colour.max_element() < 0.02);
        assert!(at(0.25).colour.z > 2.0 * at(0.25).colour.x);
        assert!(at(0.6).colour.min_element() > 0.4);
        assert!(!at(0.6).scatters && at(0.6).normal.is_some());
        let skin = material(Some(&features), Tint::default(), Vec3::X, &look);
        assert_eq!(skin.colour, look.colour);
        let lips = Tint { lips: 1.0, ..Tint::default() };
        let lips = material(None, lips, Vec3::X, &look).colour / look.colour;
        assert!(lips.x > 1.3 * lips.y);
        let dressed = Tint { garment: 0.9, ..Tint::default() };
        assert_eq!(material(None, dressed, Vec3::X, &look).colour, look.garment);
    }
}
