//! The natural strain of the boundary-value problem's rod.

use std::sync::Arc;

use glam::DVec3;

/// A natural strain that is linear between knots and constant outside of them. Two knots very near to each other are a
/// jump.
#[derive(Clone, Debug)]
pub struct Natural {
    /// Arc length over length, increasing, and strain times length.
    knots: Arc<[(f64, DVec3)]>,
}

impl Natural {
    /// The same strain times length everywhere.
    #[must_use]
    pub fn uniform(strain: DVec3) -> Self {
        Self { knots: Arc::new([(0.0, strain)]) }
    }

    /// Pairs of arc length over length, increasing, and strain times length; at least one.
    #[must_use]
    pub fn varying(knots: impl IntoIterator<Item = (f64, DVec3)>) -> Self {
        Self { knots: knots.into_iter().collect() }
    }

    /// Strain times length at an arc length over length.
    pub(super) fn at(&self, s: f64) -> DVec3 {
        let mut before = self.knots[0];
        for &knot in &self.knots[..] {
            if knot.0 > s {
                let part = (s - before.0) / (knot.0 - before.0);
                return if knot.0 > before.0 { before.1.lerp(knot.1, part) } else { knot.1 };
            }
            before = knot;
        }
        before.1
    }

    /// Largest strain times length.
    pub(super) fn largest(&self) -> f64 {
        self.knots.iter().map(|k| k.1.length()).fold(0.0, f64::max)
    }

    /// The strain times a factor.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self::varying(self.knots.iter().map(|k| (k.0, k.1 * factor)))
    }

    /// An interval, in either direction, cut at the knots within it: between two cuts the strain is smooth.
    pub(super) fn cuts(&self, from: f64, to: f64) -> Vec<f64> {
        let within = |s: &f64| *s > from.min(to) && *s < from.max(to);
        let mut cuts: Vec<f64> = self.knots.iter().map(|k| k.0).filter(within).collect();
        if to < from {
            cuts.reverse();
        }
        cuts.insert(0, from);
        cuts.push(to);
        cuts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_linear_between_knots_and_constant_outside() {
        let natural = Natural::varying([(0.2, DVec3::X), (0.6, DVec3::X * 3.0)]);
        for (s, x) in [(0.0, 1.0), (0.2, 1.0), (0.4, 2.0), (0.6, 3.0), (1.0, 3.0)] {
            assert!((natural.at(s).x - x).abs() < 1e-15, "{s}");
        }
        assert_eq!(natural.cuts(0.0, 1.0), [0.0, 0.2, 0.6, 1.0]);
        assert_eq!(natural.cuts(0.5, 0.1), [0.5, 0.2, 0.1]);
        assert_eq!(natural.cuts(0.2, 0.3), [0.2, 0.3]);
    }
}
