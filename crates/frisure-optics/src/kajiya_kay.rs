//! The model of \[Kajiya & Kay 1989\]: its two terms, without their constants K_d and K_s.

use glam::Vec3;

/// Diffuse term sin(t, l): a thin cylinder of Lambertian surface, all of whose lit half is seen.
#[must_use]
pub fn diffuse(tangent: Vec3, light: Vec3) -> f32 {
    sine(tangent.dot(light))
}

/// Specular term cos^p of the angle between the eye and the cone of mirrored light.
///
/// The paper writes ((t·l)(t·e) + sin(t,l) sin(t,e))^p with one of the two directions along the
/// ray. Here both point away from the fibre, so the first product changes sign and the maximum is
/// where t·e = −t·l: on the mirror cone. Below zero it counts as zero.
#[must_use]
pub fn specular(tangent: Vec3, light: Vec3, eye: Vec3, exponent: f32) -> f32 {
    // cos(θ_l + θ_e) with θ measured from the normal plane: sines along the fibre multiply with a minus.
    let (tl, te) = (tangent.dot(light), tangent.dot(eye));
    (sine(tl) * sine(te) - tl * te).max(0.0).powf(exponent)
}

fn sine(cosine: f32) -> f32 {
    (1.0 - cosine * cosine).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tilted(angle: f32) -> Vec3 {
        Vec3::new(angle.cos(), 0.0, angle.sin())
    }

    #[test]
    fn a_fibre_along_the_light_is_dark() {
        assert_eq!(diffuse(Vec3::Z, Vec3::Z), 0.0);
        assert_eq!(diffuse(Vec3::Z, Vec3::X), 1.0);
    }

    #[test]
    fn the_highlight_is_on_the_mirror_cone() {
        let (light, mirror) = (tilted(0.4), tilted(-0.4));
        assert!((specular(Vec3::Z, light, mirror, 50.0) - 1.0).abs() < 1e-5);
        // The whole cone, not only the plane of incidence.
        let around = glam::Quat::from_rotation_z(2.0) * mirror;
        assert!((specular(Vec3::Z, light, around, 50.0) - 1.0).abs() < 1e-5);
        assert!(specular(Vec3::Z, light, light, 50.0) < 0.02);
    }

    #[test]
    fn light_and_eye_can_be_exchanged_and_the_tangent_turned() {
        let (l, e, t) = (tilted(0.3), Vec3::new(0.2, 0.5, -0.6).normalize(), tilted(1.2));
        assert!((specular(t, l, e, 8.0) - specular(t, e, l, 8.0)).abs() < 1e-6);
        assert!((specular(t, l, e, 8.0) - specular(-t, l, e, 8.0)).abs() < 1e-6);
    }
}
