//! The distance that a wisp keeps from the skin because of the hair beneath it.

/// Distance (m) to keep from the body along a guide.
///
/// It starts at zero, since the root is in the skin, and reaches its full value over a few
/// centimetres. Hair rooted higher lies over hair rooted lower, so the full value grows with the
/// altitude of the root (\[paper\] §3.1, after Lee & Ko 2001).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Distance far from the root (m).
    pub full: f64,
    /// Arc length over which it is reached (m).
    pub rise: f64,
}

/// Thickness (m) of the hair of a head without curl under the lowest and above the highest root.
const LAYERS: (f64, f64) = (0.0015, 0.009);

/// Arc length (m) over which a wisp rises to its layer.
const RISE: f64 = 0.05;

impl Clearance {
    /// For a root at `altitude` (0 the lowest of the scalp, 1 the highest) in hair of `volume`
    /// times the thickness of straight hair.
    #[must_use]
    pub fn layered(altitude: f64, volume: f64) -> Self {
        let full = volume * (LAYERS.0 + (LAYERS.1 - LAYERS.0) * altitude.clamp(0.0, 1.0));
        Self { full, rise: RISE }
    }

    /// Distance to keep at arc length `s` (m), in m.
    #[must_use]
    pub fn at(&self, s: f64) -> f64 {
        let x = (s / self.rise).clamp(0.0, 1.0);
        self.full * x * x * (3.0 - 2.0 * x)
    }
}
