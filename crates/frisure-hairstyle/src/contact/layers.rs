//! Hair rooted higher lies over hair rooted lower.

/// The bed of hair that a wisp lies on: the distance (m) that it keeps from the skin.
///
/// After Lee & Ko 2001 (\[paper\] §3.1) a wisp lies on an envelope of the head whose offset grows with what is
/// beneath. How thick is the bed? Beneath a hair, at the arc length s from its root, run the hairs rooted on the way
/// there: ν per area, each of which takes the cross-section A of its wisp. Hence the bed is `ν A s` thick, until the
/// hair has passed the last root on its way, after the distance m along the skin: `ν A min(s, m)`. Lee & Ko take m from the
/// altitude of the root, which puts a bed beneath hair that falls over a bare forehead, and none beneath hair that is
/// combed up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Growth of the bed per arc length, ν A, at most 0.6.
    pub slope: f64,
    /// Distance m along the skin to the last root on the way of the hair (m).
    pub most: f64,
}

frisure_digest::digest_fields!(Layer { slope, most });

/// The steepest bed: hair that stands up by more has no hair beneath it, but beside it.
/// docs/theory.md, "Hair against hair: layers and wisps"; chosen by trial.
const STEEPEST: f64 = 0.6;

impl Layer {
    /// No hair beneath.
    pub const NONE: Self = Self { slope: 0.0, most: 0.0 };

    /// The bed of a hair that lies over `way` (m) of skin on which hairs grow that take `cover` of cross-section per area of
    /// skin (ν A).
    #[must_use]
    pub fn new(way: f64, cover: f64) -> Self {
        Self { slope: cover.min(STEEPEST), most: way }
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
    fn the_bed_grows_along_the_hair_as_far_as_hair_grows_there() {
        let bed = Layer::new(1.0, 0.5);
        assert_eq!([0.0, 0.5, 1.0, 9.0].map(|s| bed.at(s)), [0.0, 0.25, 0.5, 0.5]);
        assert_eq!(Layer::new(0.0, 0.05).at(1.0), 0.0);
        assert_eq!(Layer::new(1.0, 3.0).at(1.0), STEEPEST);
    }
}
