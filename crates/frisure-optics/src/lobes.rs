//! Where the light goes that a fibre reflects (R), lets through (TT) or returns (TRT).
//!
//! The lobes of Marschner et al. 2003, simplified as real-time renderers do since Scheuermann 2004:
//! Gaussians along the fibre, shifted by the tilt of the cuticle; around the fibre a cosine for R,
//! a Gaussian for TT, a broad backward lobe for TRT instead of its caustics. Each is normalised, so
//! that it shares out the energies of [`crate::fibre_energy`].

use core::f32::consts::{PI, TAU};

use glam::Vec3;

/// Directions to light and eye, measured from a fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angles {
    /// Inclination of the light from the plane across the fibre (rad), positive towards the tip.
    pub theta_light: f32,
    /// Inclination of the eye (rad).
    pub theta_eye: f32,
    /// Cosine of the angle between light and eye around the fibre: 1 if they are on one side.
    pub cos_phi: f32,
}

impl Angles {
    /// Measures unit directions `light` and `eye` from a fibre of unit `tangent`, root to tip.
    #[must_use]
    pub fn new(tangent: Vec3, light: Vec3, eye: Vec3) -> Self {
        let (sl, se) = (tangent.dot(light).clamp(-1.0, 1.0), tangent.dot(eye).clamp(-1.0, 1.0));
        let across = ((1.0 - sl * sl) * (1.0 - se * se)).max(1e-12).sqrt();
        let cos_phi = ((light.dot(eye) - sl * se) / across).clamp(-1.0, 1.0);
        Self { theta_light: sl.asin(), theta_eye: se.asin(), cos_phi }
    }
}

/// Widths and shifts of the lobes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LobeShape {
    /// Standard deviation of R along the fibre, in θ_light + θ_eye (rad). TT has half of it and TRT
    /// twice, as in Marschner et al. 2003, table 1.
    pub width: f32,
    /// Tilt of the cuticle's scales (rad), 2° to 4°: R moves by −2, TT by 1, TRT by 4 times this.
    pub tilt: f32,
    /// Standard deviation of TT around the fibre (rad).
    pub azimuthal_width: f32,
}

impl Default for LobeShape {
    /// Clean, healthy hair.
    fn default() -> Self {
        Self { width: 0.17, tilt: 0.055, azimuthal_width: 0.45 }
    }
}

impl LobeShape {
    /// The lobes of a fibre of roughness `along` (β_M) and `around` (β_N), and of a tilt (rad).
    ///
    /// Deviations of Chiang et al. 2016, §4.1; light that goes through is also spread by where it meets
    /// the fibre, by about 0.4 rad.
    #[must_use]
    pub fn of(along: f32, around: f32, tilt: f32) -> Self {
        let width = 0.726 * along + 0.812 * along.powi(2) + 3.7 * along.powi(20);
        let scale =
            (PI / 8.0).sqrt() * (0.265 * around + 1.194 * around.powi(2) + 5.372 * around.powi(22));
        // The deviation of a logistic of that scale.
        let spread = scale * PI / 3.0_f32.sqrt();
        Self { width: width.max(1e-3), tilt, azimuthal_width: spread.hypot(0.4) }
    }

    /// Sum θ_light + θ_eye at which R, TT and TRT are brightest (rad).
    ///
    /// Scales open towards the tip, so a reflection off them turns towards the root; light that
    /// crosses the surface or comes back from the far side turns the other way: −2α, α, 4α
    /// (`pbrt-v3`, `HairBSDF::f`, after Marschner et al. 2003, table 1).
    #[must_use]
    pub fn shifts(&self) -> [f32; 3] {
        [-2.0 * self.tilt, self.tilt, 4.0 * self.tilt]
    }
}

/// Values of the lobes (1/sr): radiance per irradiance on the width of the fibre, before energy and
/// colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobes {
    /// Reflected: the white highlight.
    pub r: f32,
    /// Transmitted: the glow against the light.
    pub tt: f32,
    /// Returned from inside: the coloured highlight.
    pub trt: f32,
}

/// The three lobes for one pair of directions.
///
/// They include the cosine of the light's inclination (how much light the fibre's length catches)
/// and leave out 1/cos²θ_d, whose pole at grazing angles would only make sparks in a preview.
#[must_use]
pub fn lobes(angles: Angles, shape: &LobeShape) -> Lobes {
    let sum = angles.theta_light + angles.theta_eye;
    let [r, tt, trt] = shape.shifts();
    let caught = angles.theta_light.cos();
    let phi = angles.cos_phi.acos();
    // N_R of Marschner et al. 2003, (7) with the flux at equal Fresnel: |cos(φ/2)|/4.
    let n_r = 0.25 * (0.5 * phi).cos();
    let n_tt = gaussian(PI - phi, shape.azimuthal_width);
    // Integrates to 1 over the turn; a fair outline of TRT smoothed over its caustics.
    let n_trt = (1.0 + angles.cos_phi) / TAU;
    Lobes {
        r: caught * gaussian(sum - r, shape.width) * n_r,
        tt: caught * gaussian(sum - tt, 0.5 * shape.width) * n_tt,
        trt: caught * gaussian(sum - trt, 2.0 * shape.width) * n_trt,
    }
}

/// Normal density of standard deviation `width`.
fn gaussian(x: f32, width: f32) -> f32 {
    let u = x / width;
    (-0.5 * u * u).exp() / (width * TAU.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(theta_light: f32, theta_eye: f32, phi: f32) -> Lobes {
        lobes(Angles { theta_light, theta_eye, cos_phi: phi.cos() }, &LobeShape::default())
    }

    #[test]
    fn angles_of_known_directions() {
        let a = Angles::new(Vec3::Z, Vec3::X, Vec3::Y);
        assert!(a.theta_light.abs() < 1e-6 && a.theta_eye.abs() < 1e-6 && a.cos_phi.abs() < 1e-6);
        let light = Vec3::new(0.6, 0.0, 0.8);
        let a = Angles::new(Vec3::Z, light, light);
        assert!((a.theta_light - 0.8_f32.asin()).abs() < 1e-6 && (a.cos_phi - 1.0).abs() < 1e-5);
    }

    #[test]
    fn directions_along_the_fibre_are_not_a_pole() {
        let a = Angles::new(Vec3::Z, Vec3::Z, -Vec3::Z);
        let l = lobes(a, &LobeShape::default());
        assert!(l.r.is_finite() && l.tt.is_finite() && l.trt.is_finite());
    }

    #[test]
    fn white_highlight_moves_to_the_root_and_the_coloured_one_to_the_tip() {
        let (towards_root, towards_tip) = (at(0.0, -0.1, 0.0), at(0.0, 0.2, 0.0));
        assert!(towards_root.r > towards_tip.r);
        assert!(towards_root.trt < towards_tip.trt);
    }

    #[test]
    fn each_lobe_shares_out_at_most_its_energy() {
        // ∫ S dω over the sphere of eyes, light square to the fibre; dω = cos θ dθ dφ. The Gaussian
        // along the fibre loses a little to cos θ, more where it is wide.
        let n = 400;
        let (mut r, mut tt, mut trt) = (0.0, 0.0, 0.0);
        for i in 0..n {
            let theta = PI * ((i as f32 + 0.5) / n as f32 - 0.5);
            for j in 0..n {
                let phi = PI * (j as f32 + 0.5) / n as f32;
                let d = theta.cos() * (PI / n as f32) * (TAU / n as f32);
                let l = at(0.0, theta, phi);
                r += l.r * d;
                tt += l.tt * d;
                trt += l.trt * d;
            }
        }
        for (share, least) in [(r, 0.97), (tt, 0.97), (trt, 0.9)] {
            assert!(share <= 1.001 && share >= least, "{r} {tt} {trt}");
        }
    }
}
