//! The model of Marschner et al. 2003, *Light scattering from human hair fibers*, as it is printed.
//!
//! For fidelity to what was published; for pictures take [`super::HairBsdf`]. It is far-field (the
//! mean over the fibre's width), stops at TRT and does not conserve energy: its Gaussians are
//! normalised in the half angle θh, which by itself counts light twice, 1/cos²θd rises without bound
//! at grazing angles, and the transmittance exp(−2σ(1 + cos 2γt)) is of a way cos γt times 2 too long.
//! The ellipse enters TRT alone, by an index that depends on the azimuth. Where light goes can be
//! sampled with the conserving model's density.
//!
//! Written from memory of the paper and compared, formula by formula, with a public transcription of
//! it; equation numbers are left out since they could not be checked.

use core::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::Vec3;

use crate::HAIR_INDEX;

/// The paper's fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marschner2003 {
    /// Semi-axis along d1 over that along d2.
    pub axis_ratio: f32,
    /// Refractive index η.
    pub index: f32,
    /// Shift of R, α_R (rad), −10° to −5°; TT has −½ and TRT −3/2 of it.
    pub shift: f32,
    /// Width of R, β_R (rad), 5° to 10°; TT has half and TRT twice of it.
    pub width: f32,
    /// Absorption coefficient σ_a per radius.
    pub absorption: Vec3,
    /// Strength of the glints, k_G, 0.5 to 5.
    pub glint: f32,
    /// Azimuthal width of the caustics, w_c (rad), 10° to 25°.
    pub caustic_width: f32,
    /// Range of η' over which merged caustics fade, Δη', 0.2 to 0.4.
    pub caustic_fade: f32,
    /// Limit of the caustics' strength, Δh_M.
    pub caustic_limit: f32,
}

impl Default for Marschner2003 {
    /// The middles of the paper's ranges, without colour.
    fn default() -> Self {
        Self {
            axis_ratio: 1.0,
            index: HAIR_INDEX,
            shift: -7.5_f32.to_radians(),
            width: 7.5_f32.to_radians(),
            absorption: Vec3::ZERO,
            glint: 2.0,
            caustic_width: 15.0_f32.to_radians(),
            caustic_fade: 0.3,
            caustic_limit: 0.5,
        }
    }
}

/// A fibre seen at one difference angle θd: the indices that replace η in the section.
#[derive(Clone, Copy, Debug)]
struct Bravais {
    /// η' for the way of the ray and for perpendicular polarisation.
    perpendicular: f32,
    /// η'' for parallel polarisation.
    parallel: f32,
}

impl Bravais {
    fn new(index: f32, sine: f32, cosine: f32) -> Self {
        // η' = √(η² − sin²θd)/cos θd and η'' = η² cos θd/√(η² − sin²θd).
        let root = (index * index - sine * sine).sqrt();
        Self { perpendicular: root / cosine, parallel: index * index * cosine / root }
    }

    /// Reflectance at angle of incidence γ from outside.
    fn enter(&self, gamma: f32) -> f32 {
        reflectance(self.perpendicular, self.parallel, gamma)
    }

    /// Reflectance at angle of incidence γ from inside.
    fn leave(&self, gamma: f32) -> f32 {
        reflectance(1.0 / self.perpendicular, 1.0 / self.parallel, gamma)
    }
}

impl Marschner2003 {
    /// S cos θi (1/sr) for unit local directions to eye and light: mean radiance over the fibre's
    /// width per irradiance, as [`super::Evaluation::f_cos`] averaged over the offset.
    #[must_use]
    pub fn evaluate(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let (theta_o, theta_i) = (inclination(wo), inclination(wi));
        let (half, difference) = (0.5 * (theta_o + theta_i), 0.5 * (theta_o - theta_i));
        let (sine, cosine) = (difference.sin(), difference.cos().max(1e-3));
        let (phi_o, phi_i) = (wo.y.atan2(wo.x), wi.y.atan2(wi.x));
        let phi = wrap(phi_o - phi_i);
        // Ways inside are longer by 1/cos θt.
        let depth = self.absorption / (1.0 - (sine / self.index).powi(2)).sqrt();
        let round = Bravais::new(self.index, sine, cosine);
        let elliptic = Bravais::new(self.elliptic_index(0.5 * (phi_o + phi_i)), sine, cosine);
        let m = |shift: f32, width: f32| gaussian(half - shift * self.shift, width * self.width);
        let sum = around(0, round, phi, depth) * m(1.0, 1.0)
            + around(1, round, wrap(phi - PI), depth) * m(-0.5, 0.5)
            + self.around_trt(elliptic, phi, depth) * m(-1.5, 2.0);
        sum * theta_i.cos() / (cosine * cosine)
    }

    /// η* at half azimuth φ_h from d1.
    ///
    /// η* = ½[(e1 + e2) + cos 2φ_h (e1 − e2)], e1 = 2(η−1)a² − η + 2, e2 = 2(η−1)a⁻² − η + 2, with a ≤ 1
    /// the minor axis over the major and φ_h from the major. Kept above 1.05, which only sections
    /// flatter than the paper's reach.
    fn elliptic_index(&self, half: f32) -> f32 {
        let (eta, r2) = (self.index, self.axis_ratio * self.axis_ratio);
        let (a2, sign) = if r2 > 1.0 { (1.0 / r2, 1.0) } else { (r2, -1.0) };
        let e1 = 2.0 * (eta - 1.0) * a2 - eta + 2.0;
        let e2 = 2.0 * (eta - 1.0) / a2 - eta + 2.0;
        (0.5 * ((e1 + e2) + sign * (2.0 * half).cos() * (e1 - e2))).max(1.05)
    }

    /// N of TRT, with the singularities at its caustics replaced by Gaussians of their energy.
    fn around_trt(&self, index: Bravais, phi: f32, depth: Vec3) -> Vec3 {
        let way = Azimuth::new(2, index);
        // Below η' = 2 there are two caustics, where dφ/dγ = 0; each is as strong as its second derivative lets it be. Above,
        // they have merged at γ = 0 and fade over Δη'.
        let (gamma, strength, t) = if index.perpendicular < 2.0 {
            let gamma = (way.linear / (-3.0 * way.cubic)).sqrt();
            let bend = 6.0 * way.cubic * gamma / gamma.cos().powi(2);
            let strength = 2.0 * (2.0 * self.caustic_width / bend.abs().max(1e-6)).sqrt();
            (gamma, strength.min(self.caustic_limit), 1.0)
        } else {
            let x = ((index.perpendicular - 2.0) / self.caustic_fade).clamp(0.0, 1.0);
            (0.0, self.caustic_limit, 1.0 - x * x * (3.0 - 2.0 * x))
        };
        let caustic = way.at(gamma);
        let width = self.caustic_width;
        let (left, right) = (gaussian(phi - caustic, width), gaussian(phi + caustic, width));
        let top = gaussian(0.0, width);
        let smooth =
            around(2, index, phi, depth) * (1.0 - t * left / top) * (1.0 - t * right / top);
        smooth + energy(2, index, gamma, depth) * (t * self.glint * strength * (left + right))
    }
}

/// The cubic that stands for φ(p, γ) = 2pγt − 2γ, less pπ.
#[derive(Clone, Copy, Debug)]
struct Azimuth {
    linear: f32,
    cubic: f32,
}

impl Azimuth {
    fn new(p: u8, index: Bravais) -> Self {
        // γt(γ) ≈ 3c/π γ − 4c/π³ γ³ with c = asin(1/η'), exact at γ = 0 and ±π/2; twice p of it, less 2γ.
        let c = f32::from(p) * (1.0 / index.perpendicular).asin();
        Self { linear: 6.0 * c / PI - 2.0, cubic: -8.0 * c / PI.powi(3) }
    }

    fn at(&self, gamma: f32) -> f32 {
        gamma * (self.linear + self.cubic * gamma * gamma)
    }

    /// |dφ/dh| at h = sin γ.
    fn slope(&self, gamma: f32) -> f32 {
        ((self.linear + 3.0 * self.cubic * gamma * gamma) / gamma.cos().max(1e-6)).abs()
    }

    /// The angles γ at which light leaves at azimuth `phi`, up to three.
    fn roots(&self, phi: f32) -> impl Iterator<Item = f32> {
        let found = if self.cubic == 0.0 {
            [phi / self.linear, f32::NAN, f32::NAN]
        } else {
            depressed_cubic(self.linear / self.cubic, -phi / self.cubic)
        };
        found.into_iter().filter(|gamma| gamma.abs() <= FRAC_PI_2 + 1e-4)
    }
}

/// Real roots of x³ + p x + q; NaN where there is none.
fn depressed_cubic(p: f32, q: f32) -> [f32; 3] {
    // Cardano's formula with one real root, Viète's with three; in f64, since the discriminant cancels at caustics.
    let (third, half) = (f64::from(p) / 3.0, 0.5 * f64::from(q));
    let discriminant = half * half + third * third * third;
    if discriminant > 0.0 {
        let root = discriminant.sqrt();
        return [((root - half).cbrt() - (root + half).cbrt()) as f32, f32::NAN, f32::NAN];
    }
    let radius = (-third).sqrt();
    let angle = (-half / radius.powi(3).max(1e-300)).clamp(-1.0, 1.0).acos() / 3.0;
    [0.0, 1.0, 2.0]
        .map(|k| (2.0 * radius * (angle + k * core::f64::consts::TAU / 3.0).cos()) as f32)
}

/// N_p: the sum over ways to leave at azimuth `phi` (less pπ) of A(p, h) / |2 dφ/dh|.
fn around(p: u8, index: Bravais, phi: f32, depth: Vec3) -> Vec3 {
    let way = Azimuth::new(p, index);
    way.roots(phi)
        .map(|gamma| energy(p, index, gamma, depth) / (2.0 * way.slope(gamma)).max(1e-5))
        .sum()
}

/// A(p, γ): what a ray at angle of incidence γ gives to R, TT or TRT.
fn energy(p: u8, index: Bravais, gamma: f32, depth: Vec3) -> Vec3 {
    let enters = 1.0 - index.enter(gamma);
    if p == 0 {
        return Vec3::splat(1.0 - enters);
    }
    let inner = (gamma.sin() / index.perpendicular).clamp(-1.0, 1.0).asin();
    // As printed; the way through a circle is 2 cos γt, of which 1 + cos 2γt = 2 cos²γt is cos γt.
    let through = (-2.0 * depth * (1.0 + (2.0 * inner).cos())).exp();
    let passes = through * (enters * enters);
    if p == 1 { passes } else { passes * through * index.leave(inner) }
}

/// Fresnel's reflectance with an index for each polarisation.
fn reflectance(perpendicular: f32, parallel: f32, gamma: f32) -> f32 {
    let (sine, cosine) = (gamma.sin(), gamma.cos().max(0.0));
    let inner = |index: f32| (1.0 - (sine / index).powi(2)).max(0.0).sqrt();
    let (s, p) = (perpendicular * inner(perpendicular), inner(parallel));
    let s = (cosine - s) / (cosine + s).max(1e-9);
    let p = (parallel * cosine - p) / (parallel * cosine + p).max(1e-9);
    0.5 * ((s * s).min(1.0) + (p * p).min(1.0))
}

fn inclination(w: Vec3) -> f32 {
    w.z.clamp(-1.0, 1.0).asin()
}

fn wrap(angle: f32) -> f32 {
    angle - TAU * (angle / TAU).round()
}

/// Normal density of standard deviation `width`.
fn gaussian(x: f32, width: f32) -> f32 {
    let u = x / width;
    (-0.5 * u * u).exp() / (width * TAU.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn normal() -> Bravais {
        Bravais::new(1.55, 0.0, 1.0)
    }

    /// ∫ N dφ.
    fn sum(n: impl Fn(f32) -> Vec3) -> f32 {
        let steps = 4000_u16;
        let phis = (0..steps).map(|i| TAU * (f32::from(i) + 0.5) / f32::from(steps) - PI);
        phis.map(|phi| n(phi).x).sum::<f32>() * TAU / f32::from(steps)
    }

    #[test]
    fn lobes_around_the_fibre_share_out_the_energies() {
        let r = sum(|phi| around(0, normal(), phi, Vec3::ZERO));
        let tt = sum(|phi| around(1, normal(), phi, Vec3::ZERO));
        // The exact ray trace of a circle, and what the cubic costs.
        assert!((r - 0.075).abs() < 1e-3 && (tt - 0.862).abs() < 1e-2, "{r} {tt}");
    }

    #[test]
    fn the_cubic_is_near_the_exact_azimuth() {
        for p in [1_u8, 2] {
            for i in 0..16_u8 {
                let gamma = f32::from(i) * 0.1;
                let exact = 2.0 * f32::from(p) * (gamma.sin() / 1.55).asin() - 2.0 * gamma;
                assert!((Azimuth::new(p, normal()).at(gamma) - exact).abs() < 0.06 * f32::from(p));
            }
        }
    }

    #[test]
    fn roots_of_cubics() {
        for [a, b] in [[0.3, 0.5], [-1.0, 0.2], [0.0, 0.7]] {
            // (x − a)(x − b)(x + a + b).
            let (p, q) = (a * b - (a + b) * (a + b), a * b * (a + b));
            let roots = depressed_cubic(p, q);
            for x in [a, b, -a - b] {
                assert!(roots.iter().any(|r| (r - x).abs() < 1e-4), "{roots:?} {x}");
            }
        }
        assert!((depressed_cubic(1.0, -2.0)[0] - 1.0).abs() < 1e-6);
    }

    #[test]
    fn reflectances_agree_from_both_sides_and_at_normal_incidence() {
        let outer = 0.9_f32;
        let inner = (outer.sin() / 1.55).asin();
        assert!((normal().enter(outer) - normal().leave(inner)).abs() < 1e-5);
        assert!((normal().enter(0.0) - (0.55_f32 / 2.55).powi(2)).abs() < 1e-6);
    }

    #[test]
    fn a_circle_has_the_index_of_the_material_and_an_ellipse_turns_with_d1() {
        let of = |axis_ratio, half| {
            Marschner2003 { axis_ratio, ..Default::default() }.elliptic_index(half)
        };
        assert!((of(1.0, 0.7) - 1.55).abs() < 1e-6);
        assert!((of(1.2, 0.0) - of(1.0 / 1.2, FRAC_PI_2)).abs() < 1e-5);
        // e1 and e2 at the paper's a = 0.85.
        assert!((of(1.0 / 0.85, 0.0) - 1.244_75).abs() < 1e-4);
        assert!((of(1.0 / 0.85, FRAC_PI_2) - 1.972_49).abs() < 1e-4);
    }

    #[test]
    fn the_white_furnace_at_normal_incidence_gives_twice_the_light() {
        let fibre = Marschner2003 { shift: 0.0, glint: 1.0, ..Default::default() };
        let (n, mut sum) = (300_u16, 0.0);
        for i in 0..n {
            let theta = PI * (f32::from(i) + 0.5) / f32::from(n) - FRAC_PI_2;
            for j in 0..n {
                let phi = TAU * (f32::from(j) + 0.5) / f32::from(n);
                let wi = Vec3::new(theta.cos() * phi.cos(), theta.cos() * phi.sin(), theta.sin());
                sum += fibre.evaluate(Vec3::X, wi).x * theta.cos();
            }
        }
        sum *= PI * TAU / f32::from(n) / f32::from(n);
        assert!((sum - 2.0).abs() < 0.1, "{sum}");
    }

    #[test]
    fn is_finite_everywhere() {
        for axis_ratio in [0.2, 1.0, 1.3, 5.0] {
            let fibre = Marschner2003 { axis_ratio, ..Default::default() };
            for i in 0..40_u8 {
                for j in 0..40_u8 {
                    let (theta, phi) = (f32::from(i) * 0.08 - 1.57, f32::from(j) * 0.16 - PI);
                    let wi =
                        Vec3::new(theta.cos() * phi.cos(), theta.cos() * phi.sin(), theta.sin());
                    for wo in [Vec3::X, -Vec3::Y, Vec3::Z, Vec3::new(0.6, 0.0, -0.8)] {
                        let f = fibre.evaluate(wo, wi);
                        assert!(f.is_finite() && f.min_element() >= -1e-6, "{wo} {wi} {f}");
                    }
                }
            }
        }
    }
}
