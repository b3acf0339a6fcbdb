//! How hair of a type is worn, for a picture to start from. Nothing here is measured.

use crate::spec::Flow;

/// Length, direction and wisps of a hairstyle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    /// Mean length (m).
    pub(super) length: f64,
    pub(super) flow: Flow,
    /// Deviation of the direction between wisps (rad).
    pub(super) jitter: f64,
    pub(super) clumping: f64,
    pub(super) fuzziness: f64,
    pub(super) flyaways: f64,
    pub(super) blending: f64,
    pub(super) count: usize,
    pub(super) points: usize,
}

pub(super) const STRAIGHT: Style = Style {
    length: 0.25,
    flow: Flow::Parted { offset: 0.02 },
    jitter: 0.05,
    clumping: 0.45,
    fuzziness: 0.12,
    flyaways: 0.01,
    blending: 0.7,
    count: 300,
    points: 32,
};

pub(super) const WAVY: Style = Style {
    length: 0.28,
    clumping: 0.6,
    fuzziness: 0.15,
    blending: 0.35,
    points: 48,
    count: 200,
    ..STRAIGHT
};

/// Waves that turn into loose ringlets.
pub(super) const LOOSE: Style = Style {
    flow: Flow::SweptBack,
    clumping: 0.7,
    flyaways: 0.015,
    blending: 0.2,
    count: 250,
    ..WAVY
};

pub(super) const CURLY: Style = Style {
    length: 0.28,
    flow: Flow::SweptBack,
    clumping: 0.75,
    fuzziness: 0.18,
    flyaways: 0.02,
    blending: 0.15,
    points: 48,
    count: 250,
    ..STRAIGHT
};

pub(super) const FRIZZY: Style = Style {
    length: 0.18,
    flow: Flow::SweptBack,
    jitter: 0.3,
    clumping: 0.45,
    fuzziness: 0.4,
    flyaways: 0.05,
    blending: 0.2,
    points: 64,
    count: 800,
};

pub(super) const COILY: Style = Style {
    length: 0.14,
    flow: Flow::SweptBack,
    jitter: 0.3,
    clumping: 0.5,
    fuzziness: 0.2,
    flyaways: 0.04,
    blending: 0.1,
    points: 72,
    count: 1200,
};

/// Springs as wide as a pencil, in locks.
pub(super) const SPRINGY: Style =
    Style { length: 0.20, clumping: 0.6, flyaways: 0.03, count: 900, ..COILY };

pub(super) const KINKY: Style = Style {
    length: 0.11,
    clumping: 0.35,
    fuzziness: 0.35,
    flyaways: 0.05,
    points: 80,
    count: 1500,
    ..COILY
};
