//! Into how large locks wet fibres gather that are rooted side by side.

use std::f64::consts::{LN_2, PI};

use frisure_rod::Rod;

use super::bridge::Liquid;

/// Fraction of a wet lock that is hair. Chosen: that of parallel cylinders that touch in disorder.
pub const PACKING: f64 = 0.8;

/// Coalescence of parallel fibres by a liquid (elastocapillary coalescence: Bico et al. 2004, Py et al. 2007).
///
/// Bundles of n fibres rooted d apart have their middles d√n apart and each the bending stiffness n EI: the liquid lets
/// fibres slide along each other. Two of them that meet at the distance l from their roots, clamped there, cost
///
/// ```text
/// U = 3 n EI d² n/l³ + 0.3 n T d² n/l + (L − l) n ½ EI (σκ)² − (L − l) G √n
/// ```
///
/// of bending, of the weight below that is lifted, and of curvature that they do not share, against the surface that they
/// save, as the perimeter of a bundle. The least U by l says where bundles of n meet:
///
/// ```text
/// G √n = n² d² (9 EI/l⁴ + 0.3 T(l)/l²) + n ½ EI (σκ)²,      T(l) = ρSg (L − l)
/// ```
///
/// docs/theory.md (C3). For two single fibres without weight and alike that is `l⁴ = 9 EI d²/G`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coalescence {
    /// Energy per length (J/m) that two fibres gain by touching, G.
    pub adhesion: f64,
    /// Bending stiffness of a fibre EI (N m²).
    pub bending: f64,
    /// Weight of a fibre per length ρSg (N/m).
    pub weight: f64,
    /// Length L (m).
    pub length: f64,
    /// Distance d of roots (m).
    pub spacing: f64,
    /// Curvature σκ (1/m) that a fibre does not share with its neighbours.
    pub spread: f64,
    /// Radius of a fibre (m).
    pub radius: f64,
}

/// Halvings of a range of factors: to 1e-12 of a factor of 1e6.
const HALVINGS: usize = 60;

/// Nearest to its root that a fibre can meet another, as a share of its length. A bound for the search.
const NEAREST: f64 = 1e-4;

/// Largest patch of skin (m, side of a square) whose hair gathers to one lock. Chosen: the law is that of fibres rooted on a plane,
/// and over 2 cm of a head, whose radius is 9 cm, hair turns by 13°; what is rooted farther away falls another way.
const PATCH: f64 = 0.02;

impl Coalescence {
    /// That of a hair like `rod` with `share` of the liquid that fills the gap between two hairs, on skin with `density` hairs
    /// per area (1/m²), of which `spread` (1/m) of the natural curvature is its own.
    #[must_use]
    pub fn new(liquid: Liquid, share: f64, rod: &Rod, density: f64, spread: f64) -> Self {
        let stiffness = rod.stiffness();
        let radius = rod.spec().section.mean_radius();
        Self {
            adhesion: liquid.adhesion(radius, share),
            // Hairs of a lock turn their soft axes every way.
            bending: (stiffness.x * stiffness.y).sqrt(),
            weight: rod.weight(),
            length: rod.length(),
            spacing: density.sqrt().recip(),
            spread,
            radius,
        }
    }

    /// 9 EI/l⁴ + 0.3 T(l)/l² (N/m³).
    fn stiffness(&self, l: f64) -> f64 {
        let tension = self.weight * (self.length - l).max(0.0);
        9.0 * self.bending / l.powi(4) + 0.3 * tension / (l * l)
    }

    /// What is left per length (N) of what two bundles of `count` fibres save, over n² d² (m²).
    fn gain(&self, count: f64) -> f64 {
        let unshared = 0.5 * self.bending * self.spread * self.spread;
        let gain = self.adhesion * count.sqrt() - count * unshared;
        gain / (count * self.spacing).powi(2)
    }

    /// Distance (m) from the roots at which bundles of `count` fibres meet two by two; none if they do not.
    #[must_use]
    pub fn meeting(&self, count: f64) -> Option<f64> {
        let gain = self.gain(count);
        if gain <= self.stiffness(self.length) {
            return None;
        }
        // The stiffness falls with l.
        let (mut low, mut high) = (NEAREST * self.length, self.length);
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            if self.stiffness(middle) > gain { low = middle } else { high = middle }
        }
        Some((low * high).sqrt())
    }

    /// Mean number of fibres of a lock at the distance `l` (m) from the roots; 1 where none have met.
    ///
    /// Bundles meet two by two until those of n do not meet any more: a lock has between n and 2n, as likely by equal
    /// factors, so n/ln 2 in the mean. No lock has more hairs than grow on 2 cm by 2 cm.
    #[must_use]
    pub fn lock(&self, l: f64) -> f64 {
        let stiffness = self.stiffness(l.min(self.length));
        if self.gain(1.0) <= stiffness {
            return 1.0;
        }
        let (mut low, mut high) = (1.0, (PATCH / self.spacing).powi(2).max(1.0));
        if self.gain(high) > stiffness {
            return high;
        }
        for _ in 0..HALVINGS {
            let middle = f64::sqrt(low * high);
            if self.gain(middle) > stiffness { low = middle } else { high = middle }
        }
        ((low * high).sqrt() / LN_2).min((PATCH / self.spacing).powi(2))
    }

    /// Number of fibres of the bundles that meet to a lock of `lock` fibres.
    #[must_use]
    pub fn bundle(lock: f64) -> f64 {
        lock * LN_2
    }

    /// Cross-section (m²) that a hair takes in a lock.
    #[must_use]
    pub fn area_per_hair(&self) -> f64 {
        PI * self.radius * self.radius / PACKING
    }

    /// Radius (m) of a lock of `count` fibres.
    #[must_use]
    pub fn lock_radius(&self, count: f64) -> f64 {
        (count * self.area_per_hair() / PI).sqrt()
    }

    /// Factor on the radius of a wisp whose hairs take the cross-section `dry` (m²) each when they are dry: as much of it is
    /// in locks as is beyond where two hairs meet.
    #[must_use]
    pub fn closeness(&self, dry: f64) -> f64 {
        let joined = self.meeting(1.0).map_or(0.0, |l| 1.0 - l / self.length);
        let wet = self.area_per_hair().min(dry);
        (1.0 + joined * (wet / dry - 1.0)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hair() -> Coalescence {
        Coalescence {
            adhesion: 5e-6,
            bending: 1.8e-9,
            weight: 5e-5,
            length: 0.2,
            spacing: 7e-4,
            spread: 0.0,
            radius: 35e-6,
        }
    }

    #[test]
    fn two_weightless_fibres_meet_where_the_closed_form_says() {
        let pair = Coalescence { weight: 0.0, ..hair() };
        // l⁴ = 9 EI d²/G
        let l = (9.0 * pair.bending * pair.spacing.powi(2) / pair.adhesion).powf(0.25);
        assert!((pair.meeting(1.0).unwrap() / l - 1.0).abs() < 1e-9);
        // Bundles of n as far as n^(3/8) times that.
        let ratio = pair.meeting(64.0).unwrap() / l;
        assert!((ratio / 64.0_f64.powf(0.375) - 1.0).abs() < 1e-9, "{ratio}");
    }

    #[test]
    fn locks_are_what_met_before() {
        let hair = hair();
        for n in [1.0, 30.0, 500.0] {
            let l = hair.meeting(n).unwrap();
            assert!((Coalescence::bundle(hair.lock(l)) / n - 1.0).abs() < 1e-6, "{n}");
        }
        assert_eq!(hair.lock(1e-3), 1.0);
        // No more than grow on a patch of skin.
        assert_eq!(hair.lock(0.2), (0.02_f64 / 7e-4).powi(2));
        // The weight below keeps bundles apart.
        assert!(Coalescence { weight: 0.0, ..hair }.lock(0.05) > 1.2 * hair.lock(0.05));
        assert_eq!(Coalescence { adhesion: 0.0, ..hair }.meeting(1.0), None);
    }

    #[test]
    fn coils_that_share_no_curl_do_not_meet() {
        let hair = hair();
        // ½ EI (σκ)² > G
        let own = Coalescence { spread: 80.0, ..hair };
        assert_eq!(own.meeting(1.0), None);
        assert_eq!(own.lock(0.2), 1.0);
        assert_eq!(own.closeness(5e-8), 1.0);
        let some = Coalescence { spread: 20.0, ..hair };
        assert!(some.lock(0.2) > 1.0 && some.lock(0.2) < hair.lock(0.2));
    }
}
