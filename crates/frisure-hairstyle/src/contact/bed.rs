//! The hair beneath a strand of another program's groom, as that shows it.

/// How high a strand lies on what is beneath it: such that it bears there what it was found to bear.
#[derive(Clone, Debug, PartialEq)]
pub struct Bed {
    /// Distance (m) along the strand of two heights.
    spacing: f64,
    /// Distances (m) from the skin at which the contact energy begins.
    heights: Vec<f64>,
}

frisure_digest::digest_fields!(Bed { spacing, heights });

impl Bed {
    /// Creates a bed from the distance (m) from the skin and the force per length (N/m) borne at points `spacing` (m)
    /// apart, from the root on, where hair has the stiffness `hair` (Pa); see [`super::BodyContact`] for the law.
    #[must_use]
    pub fn new(spacing: f64, borne: impl IntoIterator<Item = (f64, f64)>, hair: f64) -> Self {
        let height = |(distance, force): (f64, f64)| {
            if force <= 0.0 {
                return 0.0;
            }
            // hair (K − D)² / 2K = force, for the height K: K² − 2 (D + force/hair) K + D² = 0, of whose two solutions the
            // larger is above the strand.
            let (distance, sink) = (distance.max(0.0), force / hair);
            let half = distance + sink;
            half + (half * half - distance * distance).max(0.0).sqrt()
        };
        Self { spacing, heights: borne.into_iter().map(height).collect() }
    }

    /// The height (m) at arc length `s` (m).
    #[must_use]
    pub fn at(&self, s: f64) -> f64 {
        let Some(last) = self.heights.len().checked_sub(1) else { return 0.0 };
        let x = (s / self.spacing).clamp(0.0, last as f64);
        let i = (x as usize).min(last.saturating_sub(1));
        let (from, to) = (self.heights[i], self.heights[(i + 1).min(last)]);
        from + (to - from) * (x - i as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bed_bears_what_it_is_to_bear() {
        let hair = 0.5;
        for (distance, force) in [(0.002, 5e-5), (0.0, 1e-5), (0.03, 2e-4)] {
            let bed = Bed::new(0.01, [(distance, force), (distance, force)], hair);
            let pressed = bed.at(0.005) - distance;
            let borne = 0.5 * hair * pressed * pressed / bed.at(0.005);
            assert!((borne / force - 1.0).abs() < 1e-9, "{borne} for {force}");
        }
        assert_eq!(Bed::new(0.01, [(0.002, 0.0)], hair).at(1.0), 0.0);
    }
}
