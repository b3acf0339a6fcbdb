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
    pub(super) split_variation: f64,
    pub(super) split_clumping: f64,
    pub(super) subsplits: usize,
    pub(super) split_phase: f64,
    pub(super) hair_phase: f64,
    pub(super) radius_variation: f64,
    pub(super) fuzziness: f64,
    pub(super) flyaways: f64,
    pub(super) growing: f64,
    pub(super) blending: f64,
    pub(super) count: usize,
    pub(super) points: usize,
    /// What wisps make of each other: tight coils need so many guides that they lie on a bed; straight hair, waves and curls press on
    /// each other as a density, whose rest is a function of the scene. docs/theory.md, "Density"
    pub(super) contact: HairContact,
}

pub(super) const STRAIGHT: Style = Style {
    length: 0.25,
    flow: Flow::Parted { offset: 0.02 },
    jitter: 0.05,
    clumping: 0.2,
    splits: 8,
    split_variation: 0.5,
    split_clumping: 0.5,
    subsplits: 6,
    split_phase: 0.0,
    hair_phase: 0.0,
    radius_variation: 0.1,
    fuzziness: 0.25,
    flyaways: 0.01,
    growing: 0.12,
    blending: 0.9,
    count: 220,
    points: 32,
    contact: HairContact::Density,
};

pub(super) const WAVY: Style = Style {
    length: 0.28,
    clumping: 0.4,
    split_clumping: 0.7,
    split_phase: 0.3,
    hair_phase: 0.1,
    fuzziness: 0.25,
    blending: 0.6,
    points: 48,
    count: 200,
    ..STRAIGHT
};

/// Waves that turn into loose ringlets.
pub(super) const LOOSE: Style = Style {
    flow: Flow::SweptBack,
    clumping: 0.6,
    split_clumping: 0.8,
    fuzziness: 0.2,
    flyaways: 0.015,
    blending: 0.5,
    count: 200,
    ..WAVY
};

pub(super) const CURLY: Style = Style {
    length: 0.28,
    flow: Flow::SweptBack,
    clumping: 0.6,
    splits: 8,
    split_clumping: 0.85,
    subsplits: 5,
    split_phase: 0.6,
    hair_phase: 0.15,
    radius_variation: 0.2,
    fuzziness: 0.15,
    flyaways: 0.02,
    blending: 0.5,
    points: 48,
    count: 200,
    ..STRAIGHT
};

pub(super) const FRIZZY: Style = Style {
    length: 0.18,
    flow: Flow::SweptBack,
    jitter: 0.12,
    clumping: 0.2,
    splits: 8,
    split_variation: 0.5,
    split_clumping: 0.5,
    subsplits: 3,
    split_phase: 1.0,
    hair_phase: 0.5,
    radius_variation: 0.25,
    fuzziness: 0.4,
    flyaways: 0.05,
    growing: 0.15,
    blending: 0.8,
    points: 64,
    count: 800,
    contact: HairContact::Layers,
};

pub(super) const COILY: Style = Style {
    length: 0.14,
    flow: Flow::SweptBack,
    jitter: 0.12,
    clumping: 0.3,
    splits: 4,
    split_variation: 0.5,
    split_clumping: 0.85,
    subsplits: 1,
    split_phase: 1.0,
    hair_phase: 0.15,
    radius_variation: 0.2,
    fuzziness: 0.35,
    flyaways: 0.04,
    growing: 0.15,
    blending: 0.8,
    points: 72,
    count: 1200,
    contact: HairContact::Layers,
};

/// Springs as wide as a pencil, in locks.
pub(super) const SPRINGY: Style =
    Style { length: 0.20, clumping: 0.4, flyaways: 0.03, count: 900, ..COILY };

pub(super) const KINKY: Style = Style {
    length: 0.11,
    clumping: 0.1,
    splits: 8,
    split_clumping: 0.4,
    hair_phase: 1.0,
    fuzziness: 0.35,
    flyaways: 0.05,
    points: 80,
    count: 1500,
    ..COILY
};
