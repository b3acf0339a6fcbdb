//! Natural strain: the curvatures and the torsion of a fibre without loads.

use std::sync::Arc;

use glam::DVec3;

use crate::error::{InvalidQuantity, finite, positive};

/// The natural material strain u⁰ = (κ1⁰, κ2⁰, τ⁰) (rad/m) as a function of arc length.
///
/// ```
/// use frisure_rod::NaturalStrain;
///
/// // A curl with a radius of 5 mm that advances 1 cm per turn.
/// let curl = NaturalStrain::helix(0.005, 0.010)?;
/// let strain = curl.at(0.0);
/// // Radius κ/(κ² + τ²) and pitch 2π τ/(κ² + τ²) of the helix.
/// let square = strain.length_squared();
/// assert!((strain.x / square - 0.005).abs() < 1e-12);
/// assert!((std::f64::consts::TAU * strain.z / square - 0.010).abs() < 1e-12);
/// # Ok::<(), frisure_rod::InvalidQuantity>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum NaturalStrain {
    /// The same all along: the natural shape is a helix. \[paper\] §2.2
    Uniform(DVec3),
    /// Varying along the fibre.
    Varying(StrainProfile),
}

/// A strain given at increasing arc lengths, linear between them and constant outside.
#[derive(Clone, Debug, PartialEq)]
pub struct StrainProfile {
    knots: Arc<[(f64, DVec3)]>,
    /// Integral of the strain from the first knot to each knot (rad).
    integrals: Arc<[DVec3]>,
}

impl StrainProfile {
    /// Creates a profile from pairs of arc length (m) and strain (rad/m).
    ///
    /// # Errors
    /// [`InvalidQuantity`] without knots, if arc lengths do not increase strictly, or if a number
    /// is not finite.
    pub fn new(knots: Vec<(f64, DVec3)>) -> Result<Self, InvalidQuantity> {
        #[expect(clippy::cast_precision_loss, reason = "a count for an error message")]
        if knots.is_empty() {
            return Err(InvalidQuantity {
                quantity: "number of knots of the natural strain",
                value: knots.len() as f64,
                unit: "",
                allowed: "at least 1",
            });
        }
        for &(s, u) in &knots {
            finite("arc length of a natural strain", s, "m")?;
            for x in u.to_array() {
                finite("natural strain", x, "rad/m")?;
            }
        }
        for pair in knots.windows(2) {
            positive("step between arc lengths of a natural strain", pair[1].0 - pair[0].0, "m")?;
        }
        // The trapezoidal rule is exact for a linear strain, so means over elements of any length are exact too.
        let mut integral = DVec3::ZERO;
        let mut integrals = vec![integral];
        for pair in knots.windows(2) {
            integral += 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1);
            integrals.push(integral);
        }
        Ok(Self { knots: knots.into(), integrals: integrals.into() })
    }

    /// Arc lengths (m) and strains (rad/m) between which it is linear.
    #[must_use]
    pub fn knots(&self) -> &[(f64, DVec3)] {
        &self.knots
    }

    /// The strain at arc length `s` (m), in rad/m.
    #[must_use]
    pub fn at(&self, s: f64) -> DVec3 {
        let after = self.knots.partition_point(|k| k.0 <= s);
        match (after.checked_sub(1).map(|i| self.knots[i]), self.knots.get(after)) {
            (Some((s0, u0)), Some(&(s1, u1))) => u0.lerp(u1, (s - s0) / (s1 - s0)),
            (Some((_, u)), None) | (None, Some(&(_, u))) => u,
            (None, None) => DVec3::ZERO,
        }
    }

    /// Integral of the strain from the first knot to `s` (rad).
    pub(crate) fn integral(&self, s: f64) -> DVec3 {
        // Whole trapezia up to the knot before s, and the part of the next.
        let after = self.knots.partition_point(|k| k.0 <= s);
        // Before the first knot the strain is constant, and the integral negative.
        let Some(i) = after.checked_sub(1) else {
            return (s - self.knots[0].0) * self.knots[0].1;
        };
        let (s0, u0) = self.knots[i];
        let u = self.knots.get(after).map_or(u0, |&(s1, u1)| u0.lerp(u1, (s - s0) / (s1 - s0)));
        self.integrals[i] + 0.5 * (s - s0) * (u0 + u)
    }
}

/// Part of the largest strain by which a jump changes it. Chosen: profiles that are sampled finely change by less
/// between neighbouring knots.
const JUMP: f64 = 0.1;

/// Part of an element within which a change is a step, of which several together are as a jump. Chosen: of a profile with 64 knots only the
/// first divisions have such elements.
const STEP: f64 = 0.25;

impl NaturalStrain {
    /// A straight fibre.
    pub const STRAIGHT: Self = Self::Uniform(DVec3::ZERO);

    /// The helix of radius `radius` (m) and pitch `pitch` (m of advance per turn); a negative
    /// pitch turns it left-handed. With p = P/2π, κ1 = R/(R² + p²) and τ = p/(R² + p²), bending
    /// about d1, the axis of least inertia. docs/theory.md, "Strain and energy"
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the radius is finite and positive and the pitch finite.
    pub fn helix(radius: f64, pitch: f64) -> Result<Self, InvalidQuantity> {
        let r = positive("curl radius", radius, "m")?;
        let p = finite("curl pitch", pitch, "m")? / std::f64::consts::TAU;
        let d = r * r + p * p;
        Ok(Self::Uniform(DVec3::new(r / d, 0.0, p / d)))
    }

    /// The strain at arc length `s` (m), in rad/m.
    #[must_use]
    pub fn at(&self, s: f64) -> DVec3 {
        match self {
            Self::Uniform(u) => *u,
            Self::Varying(profile) => profile.at(s),
        }
    }

    /// The mean strain between two arc lengths (m), in rad/m; exact for both kinds.
    #[must_use]
    pub fn mean(&self, from: f64, to: f64) -> DVec3 {
        match self {
            Self::Uniform(u) => *u,
            Self::Varying(p) if to > from => (p.integral(to) - p.integral(from)) / (to - from),
            Self::Varying(p) => p.at(from),
        }
    }

    /// The mean strains (rad/m) of pieces of the length `step` (m), from the root on.
    pub(crate) fn means(&self, step: f64) -> impl Iterator<Item = DVec3> {
        let total = |s: f64| match self {
            Self::Uniform(u) => *u * s,
            Self::Varying(profile) => profile.integral(s),
        };
        // Differences of one running integral: consecutive pieces share their end, so that their turns add up exactly.
        let mut before = total(0.0);
        (1..).map(move |k: u32| {
            let after = total(step * f64::from(k));
            (after - std::mem::replace(&mut before, after)) / step
        })
    }

    /// Largest magnitude of the strain on `[0, length]` (rad/m).
    #[must_use]
    pub fn max_magnitude(&self, length: f64) -> f64 {
        match self {
            Self::Uniform(u) => u.length(),
            Self::Varying(p) => {
                // Between knots the strain is linear, so the largest magnitude is at an end.
                let inside = p.knots.iter().filter(|k| k.0 > 0.0 && k.0 < length);
                inside
                    .map(|k| k.1.length())
                    .fold(p.at(0.0).length().max(p.at(length).length()), f64::max)
            }
        }
    }

    /// Whether the strain of a fibre of some length (m) changes within less than an element of the length `h` (m) by so much that no
    /// element resolves it: at once, or in many small steps.
    pub(crate) fn jumps_within(&self, h: f64, length: f64) -> bool {
        let Self::Varying(p) = self else { return false };
        // What is beyond the tip is no part of the fibre.
        let most = JUMP * self.max_magnitude(length);
        let inside = |pair: &&[(f64, DVec3)]| pair[1].0 > 0.0 && pair[0].0 < length;
        let mut steps = 0.0;
        p.knots.windows(2).filter(inside).any(|pair| {
            let [(from, before), (to, after)] = [pair[0], pair[1]];
            let change = before.distance(after);
            if to - from < STEP * h {
                steps += change;
            }
            steps > most || (to - from < h && change > most)
        })
    }

    pub(crate) fn check(&self) -> Result<(), InvalidQuantity> {
        if let Self::Uniform(u) = self {
            for x in u.to_array() {
                finite("natural strain", x, "rad/m")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_interpolates_and_integrates() {
        let p =
            StrainProfile::new(vec![(0.0, DVec3::ZERO), (1.0, DVec3::X), (3.0, DVec3::X)]).unwrap();
        let u = NaturalStrain::Varying(p);
        assert_eq!(u.at(0.5).x, 0.5);
        assert_eq!(u.at(-1.0).x, 0.0);
        assert_eq!(u.at(9.0).x, 1.0);
        assert!((u.mean(0.0, 2.0).x - 0.75).abs() < 1e-15);
        assert!((u.mean(0.25, 0.75).x - 0.5).abs() < 1e-15);
        assert!((u.mean(-1.0, 0.0).x).abs() < 1e-15);
        assert_eq!(u.max_magnitude(0.5), 0.5);
        for (k, mean) in u.means(0.3).take(12).enumerate() {
            let from = 0.3 * k as f64;
            assert!(mean.distance(u.mean(from, from + 0.3)) < 1e-15 / 0.3);
        }
    }

    #[test]
    fn a_profile_jumps_where_elements_do_not_resolve_it() {
        let profile = |knots: &[(f64, DVec3)]| {
            NaturalStrain::Varying(StrainProfile::new(knots.to_vec()).unwrap())
        };
        let jump =
            [(0.0, DVec3::X), (0.5, DVec3::X), (0.501, 1.2 * DVec3::X), (1.0, 1.2 * DVec3::X)];
        assert!(profile(&jump).jumps_within(0.01, 1.0));
        assert!(!profile(&jump).jumps_within(0.0005, 1.0));
        // What is beyond the tip neither hides a jump nor is one.
        let beyond = (2.0, 1000.0 * DVec3::X);
        assert!(profile(&[&jump[..], &[beyond]].concat()).jumps_within(0.01, 1.0));
        let after = [(0.0, DVec3::X), (1.5, DVec3::X), (1.501, 9.0 * DVec3::X)];
        assert!(!profile(&after).jumps_within(0.01, 1.0));
        // Many small steps are as a jump.
        let stairs: Vec<_> = (0..6)
            .flat_map(|k| {
                let (s, u) = (0.15 * f64::from(k), (1.0 + 0.05 * f64::from(k)) * DVec3::X);
                [(s + 1e-6, u), (s + 0.15, u)]
            })
            .collect();
        assert!(profile(&stairs).jumps_within(0.01, 1.0));
        // A smooth profile with many knots is none.
        let smooth: Vec<_> = (0..65)
            .map(|k| (f64::from(k) / 64.0, (f64::from(k) / 10.0).cos() * DVec3::X))
            .collect();
        assert!(!profile(&smooth).jumps_within(1.0 / 24.0, 1.0));
    }

    #[test]
    fn bad_profiles_are_refused() {
        assert!(StrainProfile::new(vec![]).is_err());
        assert!(StrainProfile::new(vec![(0.0, DVec3::X), (0.0, DVec3::X)]).is_err());
        assert!(StrainProfile::new(vec![(0.0, DVec3::NAN)]).is_err());
    }

    #[test]
    fn a_helix_has_the_curvature_of_its_radius_and_pitch() {
        let NaturalStrain::Uniform(u) = NaturalStrain::helix(0.005, 0.0).unwrap() else {
            unreachable!()
        };
        assert!((u.x - 200.0).abs() < 1e-9 && u.z == 0.0);
    }
}
