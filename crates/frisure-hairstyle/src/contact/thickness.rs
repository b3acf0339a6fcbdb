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
    /// Bending stiffness EI (N m²).
    bending: f64,
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
    bending,
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
        let bending = (stiffness.x * stiffness.y).sqrt();
        let sag = rod.weight() / bending;
        Self {
            hairs,
            fibre: rod.spec().section.mean_radius(),
            spread: spread * natural.truncate().length(),
            wave: natural.length_squared(),
            bending,
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

    /// Cross-section that one hair takes (m²) at arc length `s` (m), without the factor.
    #[must_use]
    pub fn area_per_hair(&self, s: f64) -> f64 {
        let tube = self.tube(s);
        // A hexagon about a circle of radius t has the area √12 t².
        (12.0_f64.sqrt() * tube * tube).min(self.ground)
    }

    /// Radius (m) of the tube that one hair has for itself at arc length `s` (m), `r + w/2`.
    #[must_use]
    pub fn tube(&self, s: f64) -> f64 {
        // T/EI (1/m²), and w = σκ/(q² + T/EI); the bound stands for straight hair without weight, where σκ is zero too.
        let tension = self.sag * (self.length - s).max(self.slack);
        let wander = self.spread / (self.wave + tension).max(1e-12);
        self.fibre + 0.5 * wander
    }

    /// Energy per volume (Pa) that it takes to straighten what keeps the hairs of the wisp apart at arc length `s` (m):
    /// `½ EI (σκ)²` per length of hair, over the cross-section that a hair takes. docs/theory.md, "Density"
    #[must_use]
    pub fn springiness(&self, s: f64) -> f64 {
        0.5 * self.bending * self.spread * self.spread / self.area_per_hair(s)
    }

    /// Natural curvature (1/m) that a hair does not share with its wisp, σκ.
    #[must_use]
    pub fn spread(&self) -> f64 {
        self.spread
    }

    /// Fraction of a wisp that is hair, at arc length `s` (m).
    #[must_use]
    pub fn packing(&self, s: f64) -> f64 {
        PI * self.fibre * self.fibre / self.area_per_hair(s)
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
    use frisure_rod::{Load, Material, NaturalStrain, RodSpec, Root, Section, TorsionConstant};

    use super::*;

    fn rod(length: f64, curl: (f64, f64), gravity: f64) -> Rod {
        Rod::new(RodSpec {
            length,
            section: Section::from_diameter(70e-6, 1.0).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(curl.0, curl.1).unwrap(),
            root: Root::from_tangent(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap(),
            load: Load::down(gravity),
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
        assert!((t.packed(0.1) - 35e-6 * (400.0 / t.packing(0.1)).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn without_weight_a_hair_wanders_by_its_own_curl() {
        // κ/q² is the radius of the natural helix.
        let t = wisp(&rod(0.2, (0.01, 0.02), 0.0), 1.0, 0.1);
        let tube = (t.area_per_hair(0.1) / 12.0_f64.sqrt()).sqrt();
        assert!((tube - (35e-6 + 0.5 * 0.1 * 0.01)).abs() < 1e-12, "{tube}");
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
