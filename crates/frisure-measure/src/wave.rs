//! A wave whose length and height change slowly along a line, fitted to samples of it.
//!
//! ```text
//! v(u) = p(t) + A(t) cos E,   E + σ k A sin E = Φ(t) = φ + ∫ k du,   ln k and ln A polynomials of third degree in t,
//! ```
//!
//! with t from −1 to 1 over the samples and p of third degree: the side view of a helix about a line, whose radius A and
//! pitch 2π/k change along it. σ is the sine of the angle between the line and the picture: the far side of a helix that leans away is seen higher than
//! its near side, by which the wave is skewed (Kepler's equation). It is linear in t, since a camera that is near sees the upper end from below.

use crate::dense::Normal;

/// A place along a line, how far the line is off its axis there, and what that counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub(crate) u: f64,
    pub(crate) v: f64,
    pub(crate) weight: f64,
}

/// Coefficients of ln k and of ln A: Legendre polynomials up to the third degree.
pub(crate) const DEGREES: usize = 4;

/// Coefficients of the trend: an axis with a bow.
const TREND: usize = 4;

/// Unknowns: trend, ln k, ln A, phase, lean in the middle and its change by t.
const UNKNOWNS: usize = TREND + 2 * DEGREES + 3;
const PHASE: usize = UNKNOWNS - 3;
const LEAN: usize = UNKNOWNS - 2;

/// Sine of the angle between the line and the picture: standard deviation of what is expected before. Chosen: 6°.
const EXPECTED_LEAN: f64 = 0.1;

/// Largest skew σ k A: at 1 a wave would overhang. Chosen.
const MOST_SKEW: f64 = 0.9;

/// How much ln k and ln A change along a lock, by degree: standard deviations of what is expected before. Chosen: a hanging lock whose pitch doubles from tip
/// to root has 0.35 in the first.
const EXPECTED: [f64; DEGREES] = [f64::INFINITY, 0.5, 0.2, 0.1];

/// Bow of the axis by degree from 2, of the amplitude and for each turn: standard deviation of what is expected before. Chosen: a short wave is not a bow.
const EXPECTED_BOW: [f64; 2] = [0.25, 0.1];

/// Samples of the line in a wavelength that count as independent. Chosen: what a lock's line deviates by is correlated along it.
const INDEPENDENT: f64 = 8.0;

/// Most steps of Gauss and Newton.
const STEPS: usize = 40;

/// Deviations, in standard deviations, beyond which a sample counts less (Huber). Chosen.
const HUBER: f64 = 2.0;

/// The fitted wave.
#[derive(Clone, Debug)]
pub(crate) struct Wave {
    /// First and last place.
    pub(crate) ends: [f64; 2],
    /// Trend, ln k, ln A, phase, lean in the middle and its change.
    x: [f64; UNKNOWNS],
    /// Places, evenly spaced, and the integral of k P_j from the middle to each.
    step: f64,
    table: Vec<[f64; DEGREES]>,
    /// Root mean square of what is left over.
    pub(crate) residual: f64,
    /// Part of the variance about the trend that is explained.
    pub(crate) explained: f64,
}

fn legendre(t: f64) -> [f64; DEGREES] {
    [1.0, t, 0.5 * (3.0 * t * t - 1.0), 0.5 * t * (5.0 * t * t - 3.0)]
}

fn sum(coefficients: &[f64], values: &[f64]) -> f64 {
    coefficients.iter().zip(values).map(|(c, x)| c * x).sum()
}

impl Wave {
    /// A wave by its wavelength and amplitude at some places: least squares for the coefficients.
    pub(crate) fn through(
        ends: [f64; 2],
        places: &[(f64, f64, f64)],
        samples: &[Sample],
    ) -> Option<Self> {
        let mut normals = [Normal::new(DEGREES), Normal::new(DEGREES)];
        let unit = |u: f64| (2.0 * u - ends[0] - ends[1]) / (ends[1] - ends[0]);
        for &(u, k, amplitude) in places {
            let row = legendre(unit(u));
            normals[0].add(&row, k.ln(), 1.0);
            normals[1].add(&row, amplitude.max(1e-9).ln(), 1.0);
        }
        for normal in &mut normals {
            for (i, expected) in EXPECTED.iter().enumerate().skip(1) {
                normal.pull(i, 0.0, 0.01 * places.len() as f64 / (expected * expected));
            }
        }
        let mut x = [0.0; UNKNOWNS];
        x[TREND..TREND + DEGREES].copy_from_slice(&normals[0].solve()?);
        x[TREND + DEGREES..TREND + 2 * DEGREES].copy_from_slice(&normals[1].solve()?);
        let mut wave =
            Self { ends, x, step: 1.0, table: Vec::new(), residual: 0.0, explained: 0.0 };
        wave.tabulate();
        wave.fit_phase(samples)?;
        Some(wave)
    }

    /// Place along the wave from −1 to 1.
    fn unit(&self, u: f64) -> f64 {
        (2.0 * u - self.ends[0] - self.ends[1]) / (self.ends[1] - self.ends[0])
    }

    fn ln_k(&self) -> &[f64] {
        &self.x[TREND..TREND + DEGREES]
    }

    fn ln_a(&self) -> &[f64] {
        &self.x[TREND + DEGREES..TREND + 2 * DEGREES]
    }

    /// Wave number 2π/wavelength at a place.
    pub(crate) fn wave_number(&self, u: f64) -> f64 {
        sum(self.ln_k(), &legendre(self.unit(u))).exp()
    }

    /// Amplitude at a place.
    pub(crate) fn amplitude(&self, u: f64) -> f64 {
        sum(self.ln_a(), &legendre(self.unit(u))).exp()
    }

    /// Phase at a place.
    pub(crate) fn phase(&self, u: f64) -> f64 {
        self.x[PHASE] + self.integrals(u)[0]
    }

    /// The axis at a place.
    pub(crate) fn trend(&self, u: f64) -> f64 {
        sum(&self.x[..TREND], &legendre(self.unit(u)))
    }

    /// Slope of the axis, in the middle.
    pub(crate) fn slope(&self) -> f64 {
        self.x[1] * 2.0 / (self.ends[1] - self.ends[0])
    }

    /// The line at a place.
    pub(crate) fn value(&self, u: f64) -> f64 {
        self.trend(u) + self.amplitude(u) * self.eccentric(u).0.cos()
    }

    /// The angle E about the axis at a place, and dE/dΦ.
    pub(crate) fn eccentric(&self, u: f64) -> (f64, f64) {
        eccentric(self.phase(u), self.skew(u))
    }

    /// σ k A at a place.
    fn skew(&self, u: f64) -> f64 {
        let lean = self.x[LEAN] + self.x[LEAN + 1] * self.unit(u);
        (lean * self.wave_number(u) * self.amplitude(u)).clamp(-MOST_SKEW, MOST_SKEW)
    }

    /// Number of waves.
    pub(crate) fn turns(&self) -> f64 {
        (self.phase(self.ends[1]) - self.phase(self.ends[0])) / std::f64::consts::TAU
    }

    /// Length over the number of waves.
    pub(crate) fn mean_wavelength(&self) -> f64 {
        (self.ends[1] - self.ends[0]) / self.turns()
    }

    /// Root mean square of the amplitude.
    pub(crate) fn mean_amplitude(&self) -> f64 {
        let n = 64;
        let at = |i: i32| {
            self.ends[0] + (self.ends[1] - self.ends[0]) * (f64::from(i) + 0.5) / f64::from(n)
        };
        ((0..n).map(|i| self.amplitude(at(i)).powi(2)).sum::<f64>() / f64::from(n)).sqrt()
    }

    /// Integrals of k P_j from the middle to a place.
    fn integrals(&self, u: f64) -> [f64; DEGREES] {
        let at = ((u - self.ends[0]) / self.step).clamp(0.0, (self.table.len() - 1) as f64);
        let i = (at as usize).min(self.table.len() - 2);
        let part = at - i as f64;
        let (a, b) = (&self.table[i], &self.table[i + 1]);
        let mut found = [0.0; DEGREES];
        for (j, value) in found.iter_mut().enumerate() {
            *value = a[j] + (b[j] - a[j]) * part;
        }
        found
    }

    fn tabulate(&mut self) {
        const INTERVALS: usize = 1200;
        let step = (self.ends[1] - self.ends[0]) / INTERVALS as f64;
        let rate = |wave: &Self, u: f64| {
            let p = legendre(wave.unit(u));
            let k = sum(wave.ln_k(), &p).clamp(-50.0, 50.0).exp();
            p.map(|p| k * p)
        };
        let mut table = vec![[0.0; DEGREES]];
        let mut before = rate(self, self.ends[0]);
        for i in 0..INTERVALS {
            let after = rate(self, self.ends[0] + step * (i + 1) as f64);
            let last = table[i];
            let mut next = [0.0; DEGREES];
            for j in 0..DEGREES {
                next[j] = last[j] + 0.5 * step * (before[j] + after[j]);
            }
            table.push(next);
            before = after;
        }
        let middle = table[INTERVALS / 2];
        for row in &mut table {
            row.iter_mut().zip(middle).for_each(|(x, m)| *x -= m);
        }
        (self.step, self.table) = (step, table);
    }

    /// Trend, amplitude and phase for the given ln k, by linear least squares; the amplitude keeps its shape.
    fn fit_phase(&mut self, samples: &[Sample]) -> Option<()> {
        let mut normal = Normal::new(TREND + 2);
        for s in samples {
            let p = legendre(self.unit(s.u));
            let a = self.amplitude(s.u);
            let (sin, cos) = self.eccentric(s.u).0.sin_cos();
            normal.add(&[p[0], p[1], p[2], p[3], a * cos, a * sin], s.v, s.weight);
        }
        let unit: f64 = samples.iter().map(|s| s.weight).sum();
        // A bow costs something, so that it does not take the place of a wave.
        (2..TREND).for_each(|i| normal.pull(i, 0.0, 0.02 * unit));
        let found = normal.damped(1e-9).solve()?;
        self.x[..TREND].copy_from_slice(&found[..TREND]);
        let (cos, sin) = (found[TREND], found[TREND + 1]);
        self.x[PHASE] += (-sin).atan2(cos);
        self.x[TREND + DEGREES] += cos.hypot(sin).max(1e-12).ln();
        Some(())
    }

    /// Moves the phase to what windows of the samples say, which removes what is left of errors in k.
    pub(crate) fn follow_phase(&mut self, samples: &[Sample], windows: usize) -> Option<()> {
        let mut places = Vec::new();
        let mut before: Option<f64> = None;
        for i in 0..windows {
            let centre =
                self.ends[0] + (self.ends[1] - self.ends[0]) * i as f64 / (windows - 1) as f64;
            let reach = 1.25 * std::f64::consts::TAU / self.wave_number(centre);
            let mut normal = Normal::new(4);
            for s in window(samples, centre, reach) {
                let x = (s.u - centre) / reach;
                let (sin, cos) = self.phase(s.u).sin_cos();
                normal.add(&[1.0, x, cos, sin], s.v, s.weight * hann(x));
            }
            let Some(found) = normal.damped(1e-9).solve() else { continue };
            let raw = (-found[3]).atan2(found[2]);
            let last = before.unwrap_or(raw);
            let shift = last + turned(raw - last);
            before = Some(shift);
            places.push((centre, shift, found[2].hypot(found[3])));
        }
        // The slope of the shift, by a cubic.
        let mut normal = Normal::new(5);
        for &(u, shift, _) in &places {
            let t = self.unit(u);
            normal.add(&[1.0, t, t * t, t.powi(3), t.powi(4)], shift, 1.0);
        }
        (1..5).for_each(|i| normal.pull(i, 0.0, 1e-3));
        let c = normal.solve()?;
        let by_place = 2.0 / (self.ends[1] - self.ends[0]);
        let least = 0.3;
        let corrected: Vec<(f64, f64, f64)> = places
            .iter()
            .map(|&(u, _, amplitude)| {
                let (t, k) = (self.unit(u), self.wave_number(u));
                let slope = c[1] + 2.0 * c[2] * t + 3.0 * c[3] * t * t + 4.0 * c[4] * t.powi(3);
                (u, (k + slope * by_place).max(least * k), amplitude)
            })
            .collect();
        *self = Self::through(self.ends, &corrected, samples)?;
        Some(())
    }

    /// Gauss and Newton with Levenberg's and Marquardt's damping, and Huber's weights.
    pub(crate) fn refine(&mut self, samples: &[Sample]) -> Option<()> {
        let mut damping = 1e-3;
        let mut scale = self.scale(samples);
        let mut cost = self.cost(samples, scale);
        for step in 0..STEPS {
            if step == 6 || step == 12 {
                scale = self.scale(samples);
                cost = self.cost(samples, scale);
            }
            let normal = self.normal(samples, scale);
            let Some(change) = normal.damped(damping).solve() else { break };
            let mut next = self.clone();
            next.x.iter_mut().zip(&change).for_each(|(x, d)| *x += d);
            next.tabulate();
            let after = next.cost(samples, scale);
            if after.is_finite() && after < cost {
                let gain = (cost - after) / cost.max(1e-300);
                (*self, cost) = (next, after);
                damping = (damping * 0.2).max(1e-9);
                if gain < 1e-6 && step > 12 {
                    break;
                }
            } else {
                damping *= 8.0;
                if damping > 1e6 {
                    break;
                }
            }
        }
        self.judge(samples);
        self.x.iter().all(|x| x.is_finite()).then_some(())
    }

    /// Standard deviation of what is left over, by the median.
    fn scale(&self, samples: &[Sample]) -> f64 {
        let mut off: Vec<f64> = samples.iter().map(|s| (s.v - self.value(s.u)).abs()).collect();
        let length = self.ends[1] - self.ends[0];
        (crate::dense::median(&mut off) * 1.4826)
            .max(1e-4 * self.mean_amplitude())
            .max(1e-9 * length)
    }

    /// What a sample counts beside what is expected before: samples of a wave are not independent.
    fn share(&self, samples: &[Sample]) -> f64 {
        (INDEPENDENT * self.turns().max(0.5) / samples.len() as f64).min(1.0)
    }

    /// Weight of what is expected before of each unknown.
    fn priors(&self) -> [f64; UNKNOWNS] {
        let mut weights = [0.0; UNKNOWNS];
        let unit = self.mean_amplitude() * self.turns().max(1.0);
        for (i, expected) in EXPECTED_BOW.iter().enumerate() {
            weights[2 + i] = (expected * unit).max(1e-12).powi(-2);
        }
        weights[LEAN..].fill(EXPECTED_LEAN.powi(-2));
        for (i, expected) in EXPECTED.iter().enumerate() {
            weights[TREND + i] = expected.powi(-2);
            weights[TREND + DEGREES + i] = expected.powi(-2);
        }
        weights
    }

    fn cost(&self, samples: &[Sample], scale: f64) -> f64 {
        let share = self.share(samples);
        let of = |s: &Sample| {
            let r = ((s.v - self.value(s.u)) / scale).abs();
            let loss = if r < HUBER { r * r } else { HUBER * (2.0 * r - HUBER) };
            share * s.weight * loss
        };
        let before: f64 = self.priors().iter().zip(&self.x).map(|(w, x)| w * x * x).sum();
        samples.iter().map(of).sum::<f64>() + before
    }

    fn normal(&self, samples: &[Sample], scale: f64) -> Normal {
        let mut normal = Normal::new(UNKNOWNS);
        let share = self.share(samples);
        for s in samples {
            let p = legendre(self.unit(s.u));
            let a = sum(self.ln_a(), &p).exp();
            let integrals = self.integrals(s.u);
            let skew = self.skew(s.u);
            let (angle, rate) = eccentric(self.x[PHASE] + integrals[0], skew);
            let (sin, cos) = angle.sin_cos();
            // ∂E/∂Φ is `rate`, ∂E/∂(skew) is −sin E · rate, and the skew is proportional to k and A.
            let (by_phase, by_skew) = (-a * sin * rate, a * sin * sin * rate);
            let mut row = [0.0; UNKNOWNS];
            row[..TREND].copy_from_slice(&p[..TREND]);
            for j in 0..DEGREES {
                row[TREND + j] = by_phase * integrals[j] + by_skew * skew * p[j];
                row[TREND + DEGREES + j] = (a * cos + by_skew * skew) * p[j];
            }
            row[PHASE] = by_phase;
            row[LEAN] = by_skew * a * self.wave_number(s.u);
            row[LEAN + 1] = row[LEAN] * p[1];
            let rest = s.v - sum(&self.x[..TREND], &p) - a * cos;
            let huber = (HUBER * scale / rest.abs().max(1e-300)).min(1.0);
            normal.add(&row, rest, share * s.weight * huber / (scale * scale));
        }
        for (i, weight) in self.priors().into_iter().enumerate() {
            normal.pull(i, -self.x[i], weight);
        }
        normal
    }

    /// The wave in another unit of length, with places counted from another one.
    pub(crate) fn scaled(&self, unit: f64, from: f64) -> Self {
        let mut wave = self.clone();
        wave.ends = self.ends.map(|u| (u - from) * unit);
        wave.x[..TREND].iter_mut().for_each(|x| *x *= unit);
        wave.x[TREND] -= unit.ln();
        wave.x[TREND + DEGREES] += unit.ln();
        wave.residual *= unit;
        wave.tabulate();
        wave
    }

    /// Computes what is left over and what is explained.
    fn judge(&mut self, samples: &[Sample]) {
        let (mut rest, mut all, mut total) = (0.0, 0.0, 0.0);
        for s in samples {
            rest += s.weight * (s.v - self.value(s.u)).powi(2);
            all += s.weight * (s.v - self.trend(s.u)).powi(2);
            total += s.weight;
        }
        self.residual = (rest / total).sqrt();
        self.explained = 1.0 - rest / all.max(1e-300);
    }
}

/// E and dE/dΦ with E + e sin E = Φ, by Newton's method.
fn eccentric(phase: f64, e: f64) -> (f64, f64) {
    let mut angle = phase - e * phase.sin();
    if e != 0.0 {
        for _ in 0..8 {
            let (sin, cos) = angle.sin_cos();
            let step = (angle + e * sin - phase) / (1.0 + e * cos);
            angle -= step;
            if step.abs() < 1e-12 {
                break;
            }
        }
    }
    (angle, (1.0 + e * angle.cos()).recip())
}

/// An angle between −π and π.
fn turned(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    (angle + PI).rem_euclid(TAU) - PI
}

/// Hann's window from −1 to 1.
pub(crate) fn hann(x: f64) -> f64 {
    let cos = (0.5 * std::f64::consts::PI * x.clamp(-1.0, 1.0)).cos();
    cos * cos
}

/// The samples within `reach` of a place.
pub(crate) fn window(samples: &[Sample], centre: f64, reach: f64) -> &[Sample] {
    let from = samples.partition_point(|s| s.u < centre - reach);
    let to = samples.partition_point(|s| s.u <= centre + reach);
    &samples[from..to]
}
