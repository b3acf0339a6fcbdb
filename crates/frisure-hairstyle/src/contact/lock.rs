//! How much the hairs of a wisp stick to each other as it bends.
//!
//! Where a wisp bends, neighbouring hairs slide along each other. docs/theory.md, "A lock that yields", (Y1) to (Y4)

use std::f64::consts::{FRAC_1_PI, PI};

use frisure_rod::Rod;
use frisure_rod::potential::YieldLaw;

use super::body::FrictionCoefficients;
use super::thickness::Thickness;

/// Most that hairs which stick make a wisp stiffer, over the stiffness of one. Chosen: a wisp whose sections stay plane would be hundreds
/// to thousands of times as stiff, (Y2), if hairs did not give way between the places where they touch; how much they do is not known.
/// Of a comb 20 wisps of straight hair, 6 cm long, keep 0.45 with 10, 0.55 with 50 and 0.58 with 500, which takes up to twice the iterations.
const MOST_STIFFENING: f64 = 50.0;

/// Number of neighbours that a hair touches, along its length. Parallel cylinders that just hold each other in place without friction touch
/// four: the isostatic number in the plane.
const TOUCHING: f64 = 4.0;

/// What is needed to know how the hairs of a wisp stick.
pub(crate) struct LockFriction<'a> {
    /// The guide as a rod.
    pub(crate) rod: &'a Rod,
    pub(crate) thickness: &'a Thickness,
    pub(crate) friction: FrictionCoefficients,
    /// Force per length of hair (N/m) with which the body presses on the wisp, at evenly spaced points from the first after the root to
    /// the tip.
    pub(crate) pressed: &'a [f64],
}

impl LockFriction<'_> {
    /// Stiffness and moment at which hairs slip in the middle of each of `count` equal pieces, from the root to the tip.
    pub(crate) fn laws(&self, count: usize) -> Vec<YieldLaw> {
        let length = self.rod.length();
        let step = length / count as f64;
        let middle = |i: usize| (i as f64 + 0.5) * step;
        // Moment per length that it takes to slide what is beyond, summed from the root on.
        let mut sums = vec![0.0];
        for i in 0..count {
            sums.push(sums[i] + self.resistance(middle(i)) * step);
        }
        let up_to = |s: f64| {
            let at = (s / step).clamp(0.0, count as f64);
            let i = (at as usize).min(count - 1);
            sums[i] + (sums[i + 1] - sums[i]) * (at - i as f64)
        };
        // A natural turn of a radian later the next bend goes to another side.
        let turn = self.rod.natural().mean(0.0, length).length();
        let reach = if turn * length > 1.0 { turn.recip() } else { length };
        let law = |i: usize| {
            let s = middle(i);
            YieldLaw { stiffness: self.stiffness(s), moment: up_to(s + reach) - up_to(s) }
        };
        (0..count).map(law).collect()
    }

    /// K_f (N m²): what hairs that stick add to the bending stiffness of each.
    fn stiffness(&self, s: f64) -> f64 {
        let bending = self.rod.stiffness();
        let whole = self.thickness.hairs() / self.thickness.packing(s);
        (bending.x * bending.y).sqrt() * whole.min(MOST_STIFFENING)
    }

    /// Moment per length (N) of each hair that it takes to slide it along its neighbours as the wisp turns, (Y3).
    fn resistance(&self, s: f64) -> f64 {
        let (thickness, friction) = (self.thickness, self.friction);
        // Pressure times the area of a hair: by the hairs themselves, which keep each other from wandering, and by what presses on the
        // wisp from below, which carries all of it at the bottom and nothing at the top.
        let crowded = 0.25 * thickness.crowding() * thickness.distance(s);
        let spacing = self.rod.length() / self.pressed.len().max(1) as f64;
        let point = ((s / spacing).ceil() as usize).clamp(1, self.pressed.len().max(1));
        let below = self.pressed.get(point - 1).copied().unwrap_or(0.0);
        let lying = below * thickness.at(s);
        let diameter = 2.0 * self.rod.spec().section.mean_radius();
        friction.lock * (crowded + lying) * 4.0 / PI
            + TOUCHING * friction.lock_cohesion * diameter * FRAC_1_PI
    }
}

#[cfg(test)]
mod tests {
    use frisure_rod::{Load, Material, NaturalStrain, RodSpec, Root, Section, TorsionConstant};
    use glam::DVec3;

    use super::*;

    fn straight() -> Rod {
        Rod::new(RodSpec {
            length: 0.2,
            section: Section::from_diameter(70e-6, 1.0).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::STRAIGHT,
            root: Root::from_tangent(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap(),
            load: Load::down(9.81),
        })
        .unwrap()
    }

    #[test]
    fn the_moment_of_a_stack_is_that_of_all_friction_beyond() {
        // Pressed with λ all along by what lies below: m_y = 4/π μ λ a (L − s) far from the root.
        let rod = straight();
        let thickness = Thickness::new(&rod, DVec3::ZERO, 400.0, 2e-4, 0.0, 1.0);
        let friction = FrictionCoefficients { lock: 0.5, ..FrictionCoefficients::default() };
        let lock =
            LockFriction { rod: &rod, thickness: &thickness, friction, pressed: &[1e-4; 50] };
        let laws = lock.laws(100);
        let expected = 4.0 / PI * 0.5 * 1e-4 * thickness.at(0.15) * (0.2 - 0.151);
        assert!((laws[75].moment / expected - 1.0).abs() < 1e-9, "{} {expected}", laws[75].moment);
        assert!(laws.windows(2).all(|pair| pair[1].moment < pair[0].moment));
        // A wisp of two hairs is as stiff as its sections make it, one of 400 as was chosen.
        let bending = rod.stiffness().x;
        assert!((laws[0].stiffness / bending - MOST_STIFFENING).abs() < 1e-9);
        let two = Thickness::new(&rod, DVec3::ZERO, 2.0, 2e-4, 0.0, 1.0);
        let two = LockFriction { thickness: &two, ..lock };
        assert!((two.laws(100)[0].stiffness / bending - 2.0 * 12.0_f64.sqrt() / PI).abs() < 1e-9);
    }

    #[test]
    fn a_product_holds_by_its_yield_stress() {
        let rod = straight();
        let thickness = Thickness::new(&rod, DVec3::ZERO, 400.0, 2e-4, 0.0, 1.0);
        let friction =
            FrictionCoefficients { lock_cohesion: 60.0 * 70e-6, ..FrictionCoefficients::default() };
        let laws =
            LockFriction { rod: &rod, thickness: &thickness, friction, pressed: &[] }.laws(100);
        // 4 τ_y d²/π over the length beyond: 7.5e-8 N m at the root, as much as it takes to bend a hair to 16 1/m.
        let expected = 4.0 / PI * 60.0 * 70e-6_f64.powi(2) * 0.199;
        assert!((laws[0].moment / expected - 1.0).abs() < 1e-9, "{}", laws[0].moment);
    }
}
