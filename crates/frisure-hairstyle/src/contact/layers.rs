//! Hair rooted higher lies over hair rooted lower.

/// The bed of hair that a wisp lies on: the distance (m) that it keeps from the skin.
///
/// After Lee & Ko 2001 (\[paper\] §3.1) a wisp lies on an envelope of the head whose offset grows
/// with the altitude of its root. How thick is the bed? Beneath a hair, at the arc length s from its
/// root, run the hairs rooted on the way there: ν per area, each of which takes the cross-section A
/// of its wisp. Hence the bed is `ν A s` thick, until the hair has passed the lowest root, which is
/// the distance m away along the skin: `ν A min(s, m)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Growth of the bed per arc length, ν A, at most 0.6.
    pub slope: f64,
    /// Distance m along the skin down to the lowest root (m).
    pub most: f64,
}

frisure_digest::digest_fields!(Layer { slope, most });

/// The steepest bed: hair that stands up by more has no hair beneath it, but beside it.
/// docs/theory.md, "Hair against hair: layers and wisps"; chosen by trial.
const STEEPEST: f64 = 0.6;

impl Layer {
    /// No hair beneath.
    pub const NONE: Self = Self { slope: 0.0, most: 0.0 };

    /// The bed of a root at `altitude` (0 the lowest of the scalp, 1 the highest), on a scalp of the
    /// area `scalp` (m²), taken for half a sphere, whose hairs take `cover` of cross-section per
    /// area of skin (ν A).
    #[must_use]
    pub fn new(altitude: f64, scalp: f64, cover: f64) -> Self {
        // Half a sphere has the area 2πR². The altitude is the sine of the angle up from its rim, R times that angle the way.
        let radius = (scalp / std::f64::consts::TAU).sqrt();
        Self { slope: cover.min(STEEPEST), most: radius * altitude.clamp(0.0, 1.0).asin() }
    }

    /// The same with another growth of the bed per arc length, ν A.
    #[must_use]
    pub fn with_slope(self, slope: f64) -> Self {
        Self { slope: slope.min(STEEPEST), ..self }
    }

    /// The same, thicker by a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { slope: self.slope * factor, ..self }
    }

    /// Distance to keep at arc length `s` (m), in m.
    #[must_use]
    pub fn at(&self, s: f64) -> f64 {
        self.slope * s.min(self.most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bed_grows_with_the_altitude_of_the_root_and_along_the_hair() {
        let full = |altitude| Layer::new(altitude, 0.06, 0.05).at(1.0);
        assert_eq!(full(0.0), 0.0);
        assert!(full(0.3) < full(0.6) && full(0.6) < full(1.0));
        // From the crown down to the hairline: a quarter of the great circle.
        assert!((full(1.0) - 0.05 * 0.1535).abs() < 1e-4);
        let crown = Layer::new(1.0, 0.06, 0.05);
        assert!(crown.at(0.01) < crown.at(0.02));
    }
}
