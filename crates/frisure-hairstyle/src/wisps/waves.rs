//! How hairs stray from their place in a wisp.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::random::Stream;

/// Root mean square of a deviation's slope at most: √(1 + 0.25²) is 3 % more length. Of few, wide wisps, or of a hair that strays more
/// than others, waves in proportion to the wisp would be so steep that a hair is drawn a third longer than it is. Chosen.
const STEEPEST: f64 = 0.25;

/// A coherent deviation along a hair: amplitude (m), wave number (rad per length) and phase.
#[derive(Clone, Copy)]
pub(crate) struct Waves([Wave; 3]);

/// One wave of a deviation.
#[derive(Clone, Copy)]
struct Wave {
    /// Amplitude (m); zero: there is none.
    amplitude: DVec3,
    /// Angle from root to tip, at the root, and the sine of the latter.
    number: f64,
    phase: f64,
    root: f64,
}

impl Waves {
    /// No deviation.
    pub(crate) const NONE: Self =
        Self([Wave { amplitude: DVec3::ZERO, number: 0.0, phase: 0.0, root: 0.0 }; 3]);

    /// Draws waves of about `amplitude` (m) for hair of `length` (m).
    pub(crate) fn new(amplitude: f64, length: f64, random: &mut Stream) -> Self {
        let mut wave = |wavelength: f64, share: f64| {
            // Wavelengths vary by a factor with a deviation of 0.3 between hairs, so that no two run in step. Chosen by eye.
            let number = TAU * length / (wavelength * random.factor(0.3));
            let direction = DVec3::new(random.normal(), random.normal(), random.normal());
            let phase = TAU * random.unit();
            Wave { amplitude: direction * (amplitude * share), number, phase, root: phase.sin() }
        };
        // Wavelength (m) and share of the amplitude: 16, 6 and 2.5 cm. docs/theory.md, "Wisps"; shares chosen by eye.
        let mut waves = [wave(0.16, 0.6), wave(0.06, 0.3), wave(0.025, 0.12)];
        // The derivative of A sin(n x) with x = s/L is (A n/L) cos(n x), whose mean square is (A n/L)²/2.
        let square = |w: &Wave| (w.amplitude * (w.number / length)).length_squared() / 2.0;
        let slope = waves.iter().map(square).sum::<f64>().sqrt();
        if slope > STEEPEST {
            waves.iter_mut().for_each(|wave| wave.amplitude *= STEEPEST / slope);
        }
        Self(waves)
    }

    /// Deviation (m) at `x` from 0 (root) to 1 (tip); none at the root.
    pub(crate) fn at(&self, x: f64) -> DVec3 {
        let wave = |w: &Wave| match w.amplitude == DVec3::ZERO {
            true => DVec3::ZERO,
            false => w.amplitude * ((w.number * x + w.phase).sin() - w.root),
        };
        self.0.iter().map(wave).sum()
    }
}
