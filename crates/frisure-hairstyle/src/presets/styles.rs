//! How hair of a type is worn, for a picture to start from. Nothing here is measured.

use crate::spec::{Flow, HairContact};

/// Length, direction and wisps of a hairstyle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    /// Mean length (m).
    pub(super) length: f64,
    pub(super) flow: Flow,
    /// Deviation of the direction between wisps (rad).
    pub(super) jitter: f64,
    pub(super) clumping: f64,
    pub(super) splits: usize,
    pub(super) fuzziness: f64,
    pub(super) flyaways: f64,
    pub(super) blending: f64,
    pub(super) count: usize,
    pub(super) points: usize,
    /// What wisps make of each other: tight coils need so many guides that they lie on a bed.
    pub(super) contact: HairContact,
}

pub(super) const STRAIGHT: Style = Style {
    length: 0.25,
    flow: Flow::Parted { offset: 0.02 },
    jitter: 0.05,
    clumping: 0.6,
    splits: 3,
    fuzziness: 0.06,
    flyaways: 0.01,
    blending: 0.7,
    count: 220,
    points: 32,
    contact: HairContact::Wisps,
};

pub(super) const WAVY: Style = Style {
    length: 0.28,
    clumping: 0.8,
    fuzziness: 0.12,
    blending: 0.35,
    points: 48,
    count: 200,
    ..STRAIGHT
};

/// Waves that turn into loose ringlets.
pub(super) const LOOSE: Style = Style {
    flow: Flow::SweptBack,
    clumping: 0.9,
    flyaways: 0.015,
    blending: 0.2,
    count: 200,
    ..WAVY
};

pub(super) const CURLY: Style = Style {
    length: 0.28,
    flow: Flow::SweptBack,
    clumping: 1.0,
    splits: 4,
    fuzziness: 0.15,
    flyaways: 0.02,
    blending: 0.15,
    points: 48,
    count: 200,
    ..STRAIGHT
};

pub(super) const FRIZZY: Style = Style {
    length: 0.18,
    flow: Flow::SweptBack,
    jitter: 0.3,
    clumping: 0.9,
    splits: 8,
    fuzziness: 0.4,
    flyaways: 0.05,
    blending: 0.2,
    points: 64,
    count: 800,
    contact: HairContact::Layers,
};

pub(super) const COILY: Style = Style {
    length: 0.14,
    flow: Flow::SweptBack,
    jitter: 0.3,
    clumping: 1.0,
    splits: 3,
    fuzziness: 0.2,
    flyaways: 0.04,
    blending: 0.1,
    points: 72,
    count: 1200,
    contact: HairContact::Layers,
};

/// Springs as wide as a pencil, in locks.
pub(super) const SPRINGY: Style =
    Style { length: 0.20, clumping: 1.0, flyaways: 0.03, count: 900, ..COILY };

pub(super) const KINKY: Style = Style {
    length: 0.11,
    clumping: 0.8,
    splits: 6,
    fuzziness: 0.35,
    flyaways: 0.05,
    points: 80,
    count: 1500,
    ..COILY
};
