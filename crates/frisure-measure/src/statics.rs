//! The natural curl of a lock that hangs as seen: inverse statics.
//!
//! Two unknowns, the logarithms of natural radius and pitch, by Gauss and Newton: each candidate fibre is hung up by [`frisure_rod::equilibrium`], the
//! side views of its line are fitted with the same kind of wave as the photo's, and wavelengths and amplitudes at three places are compared.

use std::f64::consts::TAU;

use frisure_progress::{Cancelled, Progress};
use frisure_rod::{
    Load, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Section,
    TorsionConstant, equilibrium,
};
use glam::DVec3;

use crate::dense::Normal;
use crate::spring::{hanging_of_natural, natural_of_hanging};
use crate::wave::{Sample, Wave};

/// Standard gravity (m/s²).
const GRAVITY: f64 = 9.80665;

/// Places along the seen part, from −1 at its top to 1 at its lower end, at which wavelength and amplitude are compared. Chosen.
const PLACES: [f64; 3] = [-0.7, 0.0, 0.7];

/// Wavelengths and amplitudes that are compared.
pub(crate) const OBSERVED: usize = 2 * PLACES.len();

/// Least standard deviation of a logarithm that is compared: what the model leaves out. Chosen.
const LEAST_DEVIATION: f64 = 0.01;

/// Most steps of Gauss and Newton.
const STEPS: usize = 8;

/// Largest difference of the mean logarithm of wavelengths or of amplitudes from what is seen, of a fibre that hangs as seen. Chosen: locks whose numbers
/// are right to a tenth are within a twentieth.
const MOST_OFF: f64 = 0.15;

/// Change of the logarithms at which the iteration ends: a thousandth.
const SMALL: f64 = 1e-3;

/// Points of a line for each of its turns.
const PER_TURN: f64 = 32.0;

/// The fibres of a lock.
#[derive(Clone, Copy, Debug)]
pub struct Fibre {
    /// Section of one hair.
    pub section: Section,
    /// Moduli and density.
    pub material: Material,
    /// Torsion constant.
    pub torsion: TorsionConstant,
    /// Standard deviation of stiffness over weight, as a part of it: what is not known of the fibre.
    pub spread: f64,
}

/// How a lock hangs in a photo.
pub(crate) struct Hanging<'a> {
    pub(crate) fibre: &'a Fibre,
    /// Length of the fibres (m).
    pub(crate) length: f64,
    /// The seen part: from here to there above the tip, along the axis (m).
    pub(crate) above_tip: [f64; 2],
}

/// The logarithms of natural radius and pitch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Natural {
    pub(crate) x: [f64; 2],
    /// How they change with what is compared.
    pub(crate) gain: [[f64; OBSERVED]; 2],
}

/// Logarithms of the wavelengths, then of the amplitudes, at [`PLACES`].
pub(crate) fn observables(wave: &Wave) -> [f64; OBSERVED] {
    let mut found = [0.0; OBSERVED];
    for (i, place) in PLACES.iter().enumerate() {
        let u = 0.5 * (wave.ends[0] + wave.ends[1] + place * (wave.ends[1] - wave.ends[0]));
        found[i] = (TAU / wave.wave_number(u)).ln();
        found[PLACES.len() + i] = wave.amplitude(u).ln();
    }
    found
}

impl Hanging<'_> {
    fn stiffness(&self) -> [f64; 2] {
        let Fibre { section, material, torsion, .. } = self.fibre;
        let bending = material.youngs_modulus() * section.i1().min(section.i2());
        [bending, material.shear_modulus() * section.j(*torsion)]
    }

    /// Weight per length (N/m), with a factor on gravity.
    fn weight(&self, gravity: f64) -> f64 {
        self.fibre.material.density() * self.fibre.section.area() * GRAVITY * gravity
    }

    /// Height above the tip (m) of a place from −1 at the top of the seen part to 1 at its lower end.
    fn height(&self, place: f64) -> f64 {
        let [low, high] = self.above_tip;
        0.5 * (low + high - place * (high - low))
    }

    /// The natural curl by the closed form at each place: the mean over places, the lower the more.
    fn start(&self, seen: &[f64; OBSERVED], gravity: f64) -> [f64; 2] {
        let (stiffness, weight) = (self.stiffness(), self.weight(gravity));
        let mut sums = [0.0; 3];
        for (i, place) in PLACES.iter().enumerate() {
            let (pitch, radius) = (seen[i].exp(), seen[PLACES.len() + i].exp());
            let slope = TAU * radius / pitch;
            let arc = self.height(*place) * slope.hypot(1.0);
            let [curvature, torsion] = natural_of_hanging(radius, pitch, weight * arc, stiffness);
            let torsion = torsion.max(0.02 * curvature);
            // The pull is least below.
            let share = 1.0 + 0.9 * place;
            for (sum, x) in sums.iter_mut().zip([curvature, torsion, 1.0]) {
                *sum += share * x;
            }
        }
        let [curvature, torsion] = [sums[0] / sums[2], sums[1] / sums[2]];
        let square = curvature * curvature + torsion * torsion;
        [(curvature / square).ln(), (TAU * torsion / square).ln()]
    }

    /// What would be seen of a fibre of a natural radius and pitch (logarithms): two side views at right angles, averaged.
    fn seen(&self, x: [f64; 2], gravity: f64) -> Option<[f64; OBSERVED]> {
        let line = self.line(x, gravity)?;
        let tip = line.last()?.z;
        let [low, high] = self.above_tip;
        let start = self.expected(x, gravity)?;
        let mut total = [0.0; OBSERVED];
        for view in [DVec3::X, DVec3::Y] {
            let mut samples: Vec<Sample> = line
                .iter()
                .map(|p| (high - (p.z - tip), p.dot(view)))
                .filter(|(u, _)| (0.0..=high - low).contains(u))
                .map(|(u, v)| Sample { u, v, weight: 1.0 })
                .collect();
            samples.sort_by(|a, b| a.u.total_cmp(&b.u));
            // Evenly along the axis, as rows of pixels are: a sample counts as far as its neighbours are apart.
            let places: Vec<f64> = samples.iter().map(|s| s.u).collect();
            let mean = (high - low) / samples.len() as f64;
            for i in 1..places.len().saturating_sub(1) {
                samples[i].weight = 0.5 * (places[i + 1] - places[i - 1]) / mean;
            }
            if samples.len() < 20 {
                return None;
            }
            let mut wave = Wave::through([0.0, high - low], &start, &samples)?;
            for _ in 0..2 {
                wave.follow_phase(&samples, 33)?;
            }
            wave.refine(&samples)?;
            total.iter_mut().zip(observables(&wave)).for_each(|(t, x)| *t += 0.5 * x);
        }
        total.iter().all(|x| x.is_finite()).then_some(total)
    }

    /// Wave numbers and amplitudes by the closed form.
    fn expected(&self, x: [f64; 2], gravity: f64) -> Option<Vec<(f64, f64, f64)>> {
        let (stiffness, weight) = (self.stiffness(), self.weight(gravity));
        let natural = strain(x);
        let [low, high] = self.above_tip;
        let mut stretch = 1.0;
        (0..9)
            .map(|i| {
                let u = (high - low) * f64::from(8 - i) / 8.0;
                let pull = weight * (high - u) * stretch;
                let [radius, pitch] = hanging_of_natural(natural, pull, stiffness)?;
                stretch = (TAU * radius / pitch).hypot(1.0);
                Some((u, TAU / pitch, radius))
            })
            .collect()
    }

    /// The line of a fibre that is clamped at its upper end (m).
    fn line(&self, x: [f64; 2], gravity: f64) -> Option<Vec<DVec3>> {
        let Fibre { section, material, torsion, .. } = *self.fibre;
        // Held so that the axis of its natural helix, along κ d1 + τ t, hangs down.
        let [curvature, twist] = strain(x);
        let (sin, cos) = curvature.atan2(twist).sin_cos();
        let tangent = DVec3::new(sin, 0.0, -cos);
        let root = Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(-cos, 0.0, -sin)).ok()?;
        let rod = Rod::new(RodSpec {
            length: self.length,
            section,
            material,
            torsion,
            natural: NaturalStrain::helix(x[0].exp(), x[1].exp()).ok()?,
            root,
            load: Load::down(GRAVITY * gravity),
        })
        .ok()?;
        let accuracy = (0.01 * x[0].exp()).clamp(2e-5, 2e-4);
        let options = Options {
            resolution: Resolution::Accuracy(accuracy),
            max_elements: 400,
            eigenvalue: false,
            ..Options::default()
        };
        let turns = self.length * curvature.hypot(twist) / TAU;
        let points = (PER_TURN * turns).clamp(200.0, 4000.0) as usize;
        Some(equilibrium(&rod, &[], &options).centre_line(points))
    }

    /// The natural radius and pitch with which the lock hangs as seen; `deviations` are those of what was seen. None where the iteration does not
    /// converge, or no fibre hangs so.
    pub(crate) fn solve(
        &self,
        seen: &[f64; OBSERVED],
        deviations: &[f64; OBSERVED],
        gravity: f64,
        start: Option<[f64; 2]>,
        progress: &dyn Progress,
    ) -> Result<Option<Natural>, Cancelled> {
        let weights = deviations.map(|d| (d * d + LEAST_DEVIATION * LEAST_DEVIATION).recip());
        let mut x = start.unwrap_or_else(|| self.start(seen, gravity));
        let off = |found: &[f64; OBSERVED]| {
            let mut off = [0.0; OBSERVED];
            for i in 0..OBSERVED {
                off[i] = seen[i] - found[i];
            }
            off
        };
        let cost = |off: &[f64; OBSERVED]| -> f64 {
            off.iter().zip(&weights).map(|(o, w)| w * o * o).sum()
        };
        let Some(mut found) = self.seen(x, gravity) else { return Ok(None) };
        let mut natural = None;
        for _ in 0..STEPS {
            progress.check()?;
            let Some(jacobian) = self.jacobian(x, &found, gravity) else { return Ok(None) };
            let rest = off(&found);
            let mut normal = Normal::new(2);
            for i in 0..OBSERVED {
                normal.add(&jacobian[i], rest[i], weights[i]);
            }
            let (Some(change), Some(inverse)) = (normal.solve(), normal.inverse()) else {
                return Ok(None);
            };
            let gain = [0, 1].map(|row: usize| {
                let mut gain = [0.0; OBSERVED];
                for i in 0..OBSERVED {
                    gain[i] =
                        weights[i] * (0..2).map(|k| inverse[row][k] * jacobian[i][k]).sum::<f64>();
                }
                gain
            });
            // Half of the step, if all of it makes it worse.
            let mut part = 1.0;
            let mut better = None;
            while part > 0.1 {
                let step = |i: usize| x[i] + (part * change[i]).clamp(-0.4, 0.4);
                let next = [step(0), step(1)];
                if let Some(seen) = self.seen(next, gravity)
                    && cost(&off(&seen)) <= cost(&rest)
                {
                    better = Some((next, seen));
                    break;
                }
                part *= 0.5;
            }
            let before = x;
            if let Some((next, seen)) = better {
                (x, found) = (next, seen);
            }
            natural = Some(Natural { x, gain });
            if (x[0] - before[0]).abs().max((x[1] - before[1]).abs()) < SMALL {
                break;
            }
        }
        // Not every wave is that of a fibre which hangs: the nearest one may be far from what is seen.
        let rest = off(&found);
        let count = PLACES.len();
        let mean = |part: &[f64]| part.iter().sum::<f64>().abs() / count as f64;
        let fits = mean(&rest[..count]) < MOST_OFF && mean(&rest[count..]) < MOST_OFF;
        Ok(natural.filter(|_| fits))
    }

    /// Differences of what is seen by both unknowns.
    fn jacobian(
        &self,
        x: [f64; 2],
        found: &[f64; OBSERVED],
        gravity: f64,
    ) -> Option<[[f64; 2]; OBSERVED]> {
        let d = 0.02;
        let by = [self.seen([x[0] + d, x[1]], gravity)?, self.seen([x[0], x[1] + d], gravity)?];
        let mut jacobian = [[0.0; 2]; OBSERVED];
        for (i, row) in jacobian.iter_mut().enumerate() {
            *row = [(by[0][i] - found[i]) / d, (by[1][i] - found[i]) / d];
        }
        Some(jacobian)
    }
}

/// Curvature and torsion (rad/m) of the logarithms of radius and pitch.
fn strain(x: [f64; 2]) -> [f64; 2] {
    let (radius, advance) = (x[0].exp(), x[1].exp() / TAU);
    let square = radius * radius + advance * advance;
    [radius / square, advance / square]
}
