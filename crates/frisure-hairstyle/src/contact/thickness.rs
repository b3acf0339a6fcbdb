//! How thick a wisp is.

use std::f64::consts::PI;

use frisure_rod::Rod;
use glam::DVec3;

use crate::math::smooth_step;

/// Radius of a wisp along its guide, from the number of its hairs and their curliness.
///
/// Hairs of one wisp share its curl, but for a spread σ of their natural curvature. A fibre under
/// the tension T follows a natural curvature κ of wave number q with the amplitude
///
/// ```text
/// w(s) = σ κ / (q² + T(s)/EI),      T(s) = ρSg max(L − s, ℓ),   ℓ³ = EI/ρSg
/// ```
///
/// (linearised Kirchhoff rod, `EI y⁗ − T y″ = EI κ″`; the same response as in Goldstein, Warren &
/// Ball 2012, whose ponytail swells by the random curvature of its hairs). q is the natural turn
/// per length; near the tip, where there is no tension, a fibre still sags over its
/// elasto-gravitational length ℓ. A hair gives way to its neighbour by half of that, and tubes of
/// radius `r + w/2` pack hexagonally: a hair takes `A(s) = √12 (r + w/2)²`, but no more than the skin
/// that it grows on, and n hairs make a wisp of radius `√(n A/π)`. Curly, frizzy and short hair is fluffy; long, straight, wet hair is dense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thickness {
    hairs: f64,
    /// Mean radius of a fibre (m).
    fibre: f64,
    /// Curvature that a hair does not share with its wisp, σ κ (1/m).
    spread: f64,
    /// q² (1/m²).
    wave: f64,
    /// κ q (1/m²).
    slope: f64,
    /// 1/ℓ³ (1/m³).
    sag: f64,
    /// ℓ (m).
    slack: f64,
    length: f64,
    /// Skin that a hair grows on (m²).
    ground: f64,
    /// Factor on radii.
    volume: f64,
}

frisure_digest::digest_fields!(Thickness {
    hairs,
    fibre,
    spread,
    wave,
    slope,
    sag,
    slack,
    length,
    ground,
    volume,
});

/// How gently a wisp grows from nothing at the root: arc length per radius.
/// docs/theory.md, "Thickness of a wisp"; chosen by trial.
const GATHERING: f64 = 4.0;

impl Thickness {
    /// The thickness of a wisp of `hairs` hairs like `rod` from a patch of skin of the area `patch` (m²), on a head of the
    /// mean natural strain `natural` (rad/m), whose natural curvatures differ by the relative spread
    /// `spread`; `volume` is a factor on the radius.
    #[must_use]
    pub fn new(
        rod: &Rod,
        natural: DVec3,
        hairs: f64,
        patch: f64,
        spread: f64,
        volume: f64,
    ) -> Self {
        // The geometric mean of both bending stiffnesses: hairs of a wisp turn their soft axes every way.
        let stiffness = rod.stiffness();
        let sag = rod.weight() / (stiffness.x * stiffness.y).sqrt();
        Self {
            hairs,
            fibre: rod.spec().section.mean_radius(),
            spread: spread * natural.truncate().length(),
            wave: natural.length_squared(),
            slope: natural.truncate().length() * natural.length(),
            sag,
            // Without weight there is no tension, however far from the tip.
            slack: if sag > 0.0 { sag.cbrt().recip() } else { 0.0 },
            length: rod.length(),
            ground: patch / hairs,
            volume,
        }
    }

    /// The same with another factor on the radius.
    #[must_use]
    pub fn scaled(self, volume: f64) -> Self {
        Self { volume, ..self }
    }

    /// Cross-section that one hair takes (m²) across the axis of its wisp at arc length `s` (m), without the factor.
    #[must_use]
    pub fn area_per_hair(&self, s: f64) -> f64 {
        let tube = self.tube(s);
        // A hexagon about a circle of radius t has the area √12 t². The skin bounds it where a curl without pitch never rises.
        (12.0_f64.sqrt() * tube * tube / self.rise(s)).min(self.ground)
    }

    /// How far (m) the axis of the curl rises per metre of hair at arc length `s` (m): cos ψ, 1 for straight hair.
    #[must_use]
    pub fn rise(&self, s: f64) -> f64 {
        let sine = self.slope / (self.wave + self.tension(s)).max(1e-12);
        (1.0 - sine * sine).max(0.0).sqrt()
    }

    /// T/EI (1/m²).
    fn tension(&self, s: f64) -> f64 {
        self.sag * (self.length - s).max(self.slack)
    }

    /// Radius (m) of the tube that one hair has for itself at arc length `s` (m), `r + w/2`.
    #[must_use]
    pub fn tube(&self, s: f64) -> f64 {
        // w = σκ/(q² + T/EI); the bound stands for straight hair without weight, where σκ is zero too.
        let wander = self.spread / (self.wave + self.tension(s)).max(1e-12);
        self.fibre + 0.5 * wander
    }

    /// Fraction of a wisp that is hair, at arc length `s` (m).
    #[must_use]
    pub fn packing(&self, s: f64) -> f64 {
        // A section across the axis cuts a fibre in an ellipse of 1/cos ψ times its own section.
        PI * self.fibre * self.fibre / (self.rise(s) * self.area_per_hair(s))
    }

    /// Radius (m) of the wisp at arc length `s` (m), far from the root.
    #[must_use]
    pub fn packed(&self, s: f64) -> f64 {
        self.volume * (self.hairs * self.area_per_hair(s) / PI).sqrt()
    }

    /// Radius (m) for contact at arc length `s` (m): it grows from zero at the root, where
    /// hairs stand side by side in the skin.
    #[must_use]
    pub fn at(&self, s: f64) -> f64 {
        let packed = self.packed(s);
        let width = (GATHERING * packed).min(0.5 * self.length);
        packed * smooth_step(0.0, width.max(1e-9), s)
    }
}

#[cfg(test)]
mod tests {
    use frisure_rod::{Material, NaturalStrain, RodSpec, Root, Section, TorsionConstant};

    use super::*;

    fn rod(length: f64, curl: (f64, f64), gravity: f64) -> Rod {
        Rod::new(RodSpec {
            length,
            section: Section::from_diameter(70e-6, 1.0).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(curl.0, curl.1).unwrap(),
            root: Root::from_tangent(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap(),
            gravity,
        })
        .unwrap()
    }

    fn wisp(rod: &Rod, hairs: f64, spread: f64) -> Thickness {
        Thickness::new(rod, rod.natural().at(0.0), hairs, 1.0, spread, 1.0)
    }

    #[test]
    fn hair_that_shares_its_curl_packs_like_wires() {
        let t = wisp(&rod(0.2, (0.01, 0.02), 9.81), 400.0, 0.0);
        assert!((t.packing(0.1) - PI / 12.0_f64.sqrt()).abs() < 1e-12);
        let along = 400.0 / t.rise(0.1);
        assert!((t.packed(0.1) - 35e-6 * (along / t.packing(0.1)).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn without_weight_a_hair_wanders_by_its_own_curl() {
        // κ/q² is the radius of the natural helix.
        let t = wisp(&rod(0.2, (0.01, 0.02), 0.0), 1.0, 0.1);
        let tube = t.tube(0.1);
        assert!((tube - (35e-6 + 0.5 * 0.1 * 0.01)).abs() < 1e-12, "{tube}");
    }

    #[test]
    fn a_section_across_the_axis_of_a_curl_has_room_for_its_hairs() {
        // A helix of radius R that rises by P a turn is √((2πR)² + P²) of hair a turn: so many times the volume of its hairs.
        for (radius, pitch) in [(0.010, 0.024), (0.005, 0.024), (0.0025, 0.024), (0.0015, 0.004)] {
            let t = wisp(&rod(0.15, (radius, pitch), 0.0), 400.0, 0.0);
            let turn = (2.0 * PI * radius).hypot(pitch);
            let wires = 12.0_f64.sqrt() * 35e-6 * 35e-6;
            let taken = t.area_per_hair(0.1) * pitch / turn;
            assert!((taken / wires - 1.0).abs() < 1e-9, "{radius} {pitch}: {}", taken / wires);
            assert!((t.packing(0.1) - PI / 12.0_f64.sqrt()).abs() < 1e-9);
        }
        // Under the same weight the slope is less, and straight hair has none.
        let (curl, hangs) = (rod(0.15, (0.01, 0.024), 0.0), rod(0.15, (0.01, 0.024), 9.81));
        assert!(wisp(&hangs, 1.0, 0.0).rise(0.0) > wisp(&curl, 1.0, 0.0).rise(0.0));
        let straight = Thickness::new(&hangs, DVec3::ZERO, 400.0, 1.0, 0.05, 1.0);
        assert_eq!(straight.rise(0.1), 1.0);
        assert!(
            (straight.area_per_hair(0.1) / (12.0_f64.sqrt() * 35e-6 * 35e-6) - 1.0).abs() < 1e-12
        );
    }

    #[test]
    fn coils_of_one_shape_take_more_room_per_length_of_hair_than_straight_hair() {
        let hangs = rod(0.15, (0.01, 0.024), 9.81);
        let straight = Thickness::new(&hangs, DVec3::ZERO, 1000.0, 1.0, 0.05, 1.0).packed(0.075);
        for scale in [1.0, 0.5, 0.25, 0.125] {
            let coil = wisp(&rod(0.15, (0.01 * scale, 0.024 * scale), 9.81), 1000.0, 0.05);
            // The area by the length of the helix over its pitch, 2.8, less what its weight stretches the curl.
            assert!(coil.packed(0.075) > 1.5 * straight, "{scale}: {}", coil.packed(0.075));
        }
    }

    #[test]
    fn weight_and_length_make_wisps_dense_and_numbers_make_them_thick() {
        let wisp = |length, hairs, gravity| wisp(&rod(length, (0.02, 0.05), gravity), hairs, 0.05);
        let short = wisp(0.1, 300.0, 9.81);
        assert!(wisp(0.5, 300.0, 9.81).packed(0.05) < short.packed(0.05));
        assert!(wisp(0.1, 300.0, 0.0).packed(0.05) > short.packed(0.05));
        assert!(short.packed(0.1) >= short.packed(0.0));
        let double = wisp(0.1, 600.0, 9.81);
        assert!((double.packed(0.05) / short.packed(0.05) - 2.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(short.at(0.0), 0.0);
        // No wisp is thicker than the skin it grows on is wide.
        let free = rod(0.2, (0.3, 0.5), 0.0);
        let strain = free.natural().at(0.0);
        let wide = Thickness::new(&free, strain, 400.0, 2e-4, 0.5, 1.0);
        assert!((wide.packed(0.1) - (2e-4 / PI).sqrt()).abs() < 1e-12);
    }
}
