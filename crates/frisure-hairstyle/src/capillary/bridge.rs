//! A liquid between two parallel fibres.

use std::f64::consts::{FRAC_PI_2, PI};

/// A liquid that wets hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Liquid {
    /// Surface tension (N/m).
    pub surface_tension: f64,
    /// Contact angle on hair (rad), 0 to π/2.
    pub contact_angle: f64,
}

impl Liquid {
    /// Water at 25 °C (\[CRC\]: 72.0 mN/m) on soaked hair. The angle is chosen: untreated dry hair has about 90° while
    /// water advances, and hair that has been soaked is wetted far better.
    pub const WATER: Self = Self { surface_tension: 0.072, contact_angle: 0.7 };

    /// Energy (J/m) that two parallel fibres of the radius `radius` (m) gain per length by touching, with `share` of the
    /// liquid that fills the gap between them to flat surfaces, 0 to 1. docs/theory.md (C2)
    ///
    /// ```
    /// use frisure_hairstyle::capillary::Liquid;
    ///
    /// let wetting = Liquid { contact_angle: 0.0, ..Liquid::WATER };
    /// // (2π − 4) γr: two half circles are covered, and two surfaces as wide as a fibre remain.
    /// let full = (2.0 * std::f64::consts::PI - 4.0) * 0.072 * 35e-6;
    /// assert!((wetting.adhesion(35e-6, 1.0) / full - 1.0).abs() < 1e-9);
    /// assert_eq!(wetting.adhesion(35e-6, 0.0), 0.0);
    /// ```
    #[must_use]
    pub fn adhesion(&self, radius: f64, share: f64) -> f64 {
        if share <= 0.0 {
            return 0.0;
        }
        let bridge = Bridge { liquid: *self, radius, distance: 2.0 * radius };
        let flat = bridge.flattest();
        let area = share.min(1.0) * bridge.area(flat);
        -bridge.energy(bridge.wetted(area, flat))
    }
}

/// Liquid between two fibres, by the angle α from the line through their centres up to which it wets them.
///
/// Its surfaces are arcs of the radius R = c/sin β with c half their chord and 2β their angle, β = π/2 − α − θ. With β the
/// formulas have no pole where the surfaces are flat.
struct Bridge {
    liquid: Liquid,
    /// Radius of the fibres (m).
    radius: f64,
    /// Distance of their centres (m).
    distance: f64,
}

/// Halvings of the range of α: to 1e-15 of it.
const HALVINGS: usize = 50;

/// β (rad) below which the area's series is taken: its next term is 1e-8 of it.
const FLAT: f64 = 1e-4;

impl Bridge {
    /// α (rad) at which the surfaces are flat.
    fn flattest(&self) -> f64 {
        FRAC_PI_2 - self.liquid.contact_angle
    }

    /// Half the chord (m) of a surface.
    fn half_chord(&self, wetted: f64) -> f64 {
        0.5 * self.distance - self.radius * wetted.cos()
    }

    /// Cross-section (m²) of the liquid. docs/theory.md (C1)
    fn area(&self, wetted: f64) -> f64 {
        let (r, c) = (self.radius, self.half_chord(wetted));
        let bend = FRAC_PI_2 - wetted - self.liquid.contact_angle;
        // (sin 2β − 2β)/sin²β, what the arcs cut off from the chords.
        let cut_off = if bend.abs() < FLAT {
            -4.0 / 3.0 * bend
        } else {
            ((2.0 * bend).sin() - 2.0 * bend) / bend.sin().powi(2)
        };
        c * c * cut_off + 4.0 * r * c * wetted.sin() - r * r * (2.0 * wetted - (2.0 * wetted).sin())
    }

    /// Energy of the surfaces (J/m), against dry fibres. docs/theory.md (C2)
    fn energy(&self, wetted: f64) -> f64 {
        let bend = FRAC_PI_2 - wetted - self.liquid.contact_angle;
        let arc = if bend.abs() < FLAT { 1.0 } else { bend / bend.sin() };
        let surfaces = 4.0 * self.half_chord(wetted) * arc;
        let covered = 4.0 * wetted * self.radius * self.liquid.contact_angle.cos();
        self.liquid.surface_tension * (surfaces - covered)
    }

    /// α (rad) at which the liquid has a cross-section (m²), at most `most`: the area grows with it.
    fn wetted(&self, area: f64, most: f64) -> f64 {
        let (mut low, mut high) = (0.0, most.min(PI));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.area(middle) < area { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Force per length (N/m) between the fibres, from a cut through the middle of the liquid: both surfaces pull, and so
    /// does the pressure in it. (shared with the law of libWetHair, Fei et al. 2017)
    fn force(bridge: &Bridge, wetted: f64) -> f64 {
        let Liquid { surface_tension, contact_angle } = bridge.liquid;
        let bend = FRAC_PI_2 - wetted - contact_angle;
        let over_arc = bend.sin() / bridge.half_chord(wetted);
        let r = bridge.radius;
        2.0 * surface_tension * ((wetted + contact_angle).sin() + r * over_arc * wetted.sin())
    }

    #[test]
    fn the_force_is_the_derivative_of_the_energy_with_the_liquid_kept() {
        for contact_angle in [0.0, 0.4, 0.9] {
            let liquid = Liquid { contact_angle, ..Liquid::WATER };
            for distance in [2.05, 2.2, 2.4] {
                let at = |distance: f64| Bridge { liquid, radius: 1.0, distance };
                let bridge = at(distance);
                let wetted = 0.7 * bridge.flattest();
                let area = bridge.area(wetted);
                let energy = |distance: f64| {
                    let bridge = at(distance);
                    bridge.energy(bridge.wetted(area, bridge.flattest()))
                };
                let h = 1e-5;
                let slope = (energy(distance + h) - energy(distance - h)) / (2.0 * h);
                let expected = force(&bridge, wetted);
                assert!((slope / expected - 1.0).abs() < 1e-6, "{slope} {expected}");
            }
        }
    }

    #[test]
    fn the_area_is_that_of_its_parts() {
        // θ = 0, α = 60°, touching: R = r, and 0.3224 r² by a triangle less sectors.
        let liquid = Liquid { contact_angle: 0.0, ..Liquid::WATER };
        let bridge = Bridge { liquid, radius: 1.0, distance: 2.0 };
        let half = 3.0_f64.sqrt() - PI / 3.0 - PI / 6.0;
        assert!((bridge.area(PI / 3.0) - 2.0 * half).abs() < 1e-12);
    }

    #[test]
    fn more_liquid_sticks_more_and_none_not_at_all() {
        let of = |share| Liquid::WATER.adhesion(35e-6, share);
        let all: Vec<f64> = (0..=20).map(|k| of(f64::from(k) / 20.0)).collect();
        assert!(all.windows(2).all(|pair| pair[1] > pair[0]), "{all:?}");
        assert_eq!(of(2.0), of(1.0));
    }
}
