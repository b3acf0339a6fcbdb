//! How hairs stray, and the thinner wisps that a wisp splits into.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::guides::Guide;
use crate::random::{Purpose, Stream};
use crate::spec::HairstyleSpec;

/// How far a split strays from its wisp, as a fraction of fuzziness times the patch's radius.
/// Chosen by eye; not measured.
const STRAY: f64 = 0.5;

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
        Self([wave(0.16, 0.6), wave(0.06, 0.3), wave(0.025, 0.12)])
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

/// A thinner wisp that a wisp splits into.
#[derive(Clone, Copy)]
pub(crate) struct Split {
    /// Its middle in the wisp's patch of skin (m, from the guide's root).
    pub(crate) middle: DVec3,
    /// How it strays.
    pub(crate) waves: Waves,
}

/// The thinner wisps of each wisp, spread over its patch.
pub(crate) fn splits(spec: &HairstyleSpec, guides: &[Guide], patch: f64) -> Vec<Vec<Split>> {
    let split = |guide: &Guide, random: &mut Stream| {
        let normal = guide.root.normal;
        let (u, v) = normal.any_orthonormal_pair();
        // Uniform on the disc of the patch.
        let (radius, angle) = (patch * random.unit().sqrt(), TAU * random.unit());
        let amplitude = STRAY * spec.wisps.fuzziness * patch;
        let length = guide.rod.length();
        Split {
            middle: (u * angle.cos() + v * angle.sin()) * radius,
            waves: Waves::new(amplitude, length, random),
        }
    };
    (guides.iter().enumerate())
        .map(|(index, guide)| {
            let mut random = Stream::new(spec.seed, Purpose::Split, index);
            (0..spec.wisps.splits).map(|_| split(guide, &mut random)).collect()
        })
        .collect()
}
