//! What tells the amplitude besides the lock's middle line: ridge lines, and the directions of hairs.

use glam::DVec2;
use serde::Serialize;

use crate::contrast::SMOOTHING;
use crate::dense::{Normal, median};
use crate::estimate::Estimate;
use crate::lock::Line;
use crate::ridges::{RidgePoint, SCALES};
use crate::wave::Wave;

/// Least part of a wave along which a ridge line tells its amplitude. Chosen.
const LEAST_TURN: f64 = 0.8;

/// Ridge lines, together, that are enough, in waves: fewer tell less than the middle line. Chosen.
const ENOUGH: f64 = 2.0;

/// Error of the factor by hairs that cover each other, where phases take a tenth of the amplitude. Tuned on renders with seeds below 1000.
const OVERLAP: f64 = 0.03;

/// Largest variance (rad²) of the phases in a lock: more is no lock. Chosen.
const MOST_VARIANCE: f64 = 1.0;

/// What is seen of the curl, besides the wave. Lengths in metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cues {
    /// Amplitude of the middle line (m), as fitted.
    pub line: f64,
    /// Amplitude of single ridge lines (m), if there are enough.
    pub ridges: Option<Estimate>,
    /// Ridge lines of which each covers most of a wave.
    pub ridge_lines: usize,
    /// Amplitude (m) by the directions of hairs: their mean square slope is ½ (2πR/P)².
    pub slopes: Option<f64>,
    /// Mean coherence of the structure tensor on ridges: 1 where neighbours run in parallel.
    pub coherence: f64,
    /// Half width of the lock about its middle line (m), root mean square.
    pub half_width: f64,
}

/// The factor from the amplitude of the middle line to that of a hair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ratio {
    pub(crate) value: f64,
    /// Relative standard deviation.
    pub(crate) deviation: f64,
}

/// Compares the ridge lines with the wave; `pixel` is the size (m) of a pixel.
pub(crate) fn cues(
    line: &Line,
    wave: &Wave,
    ridges: &[Vec<RidgePoint>],
    pixel: f64,
) -> (Cues, Ratio) {
    let k = std::f64::consts::TAU / wave.mean_wavelength();
    let [variance, error] = phase_variance(line, wave);
    // A spread of phases, and blur along the axis, which is the same, take the factor exp(−σ²/2) from the middle line.
    let amplitude = wave.mean_amplitude();
    // The ridge filter has blurred.
    let wider = (0.5 * k * k * (SCALES[0] * SCALES[0] + SMOOTHING * SMOOTHING)).exp();
    let mut ratios: Vec<(f64, f64)> =
        ridges.iter().filter_map(|ridge| ridge_amplitude(line, wave, ridge)).collect();
    ratios.iter_mut().for_each(|(ratio, _)| *ratio *= wider);
    ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = ratios.iter().map(|r| r.1).sum();
    let middle = weighted_median(&ratios, total);
    let mut off: Vec<f64> = ratios.iter().map(|r| (r.0 - middle).abs()).collect();
    let scatter = 1.48 * median(&mut off) / (ratios.len() as f64).sqrt().max(1.0);
    let enough = total > ENOUGH && middle.is_finite();
    let value = (0.5 * variance).exp();
    // Where ridge lines disagree, neither is right for sure.
    let apart = if enough { (0.5 * (middle / value - 1.0)).clamp(-0.1, 0.1) } else { 0.0 };
    let overlap = OVERLAP * (value - 1.0).min(0.1) / 0.1;
    let ratio = Ratio { value, deviation: (0.5 * error).hypot(apart).hypot(overlap) };
    let points: Vec<&RidgePoint> = ridges.iter().flatten().collect();
    let coherence = points.iter().map(|p| p.coherence).sum::<f64>() / points.len().max(1) as f64;
    let weight: f64 = line.rows.iter().map(|r| r.weight).sum();
    let spread: f64 = line.rows.iter().map(|r| r.weight * r.variance).sum();
    let cues = Cues {
        line: amplitude * pixel,
        ridges: enough.then_some(Estimate {
            value: middle * amplitude * pixel,
            deviation: scatter * amplitude * pixel,
        }),
        ridge_lines: ratios.len(),
        slopes: slopes(line, wave, &points).map(|a| a * pixel),
        coherence,
        half_width: (spread / weight.max(1e-300)).sqrt() * pixel,
    };
    (cues, ratio)
}

/// Variance of the phases of the hairs (rad²) with that of blur along the axis, and its standard deviation.
///
/// A hair with the phase Φ + δ is off the middle by −A δ sin Φ, so that the variance across the axis is c + σ² A² sin² Φ, with c of hairs that are side by
/// side: a straight line by A² sin² Φ, fitted to each turn.
fn phase_variance(line: &Line, wave: &Wave) -> [f64; 2] {
    let blocks = (wave.turns().floor() as usize).clamp(1, 40);
    let mut sums = vec![Normal::new(2); blocks];
    let [from, to] = [wave.phase(wave.ends[0]), wave.phase(wave.ends[1])];
    for row in &line.rows {
        if !(wave.ends[0]..=wave.ends[1]).contains(&row.along) {
            continue;
        }
        let at = ((wave.phase(row.along) - from) / (to - from) * blocks as f64) as usize;
        let (angle, rate) = wave.eccentric(row.along);
        let lever = (wave.amplitude(row.along) * angle.sin() * rate).powi(2);
        sums[at.min(blocks - 1)].add(&[1.0, lever], row.variance, row.weight);
    }
    let mut found: Vec<f64> =
        sums.into_iter().filter_map(|sum| sum.damped(1e-9).solve()).map(|x| x[1]).collect();
    let n = found.len() as f64;
    if found.is_empty() {
        return [0.0, MOST_VARIANCE];
    }
    let middle = median(&mut found);
    let mut off: Vec<f64> = found.iter().map(|x| (x - middle).abs()).collect();
    // Blocks of a lock are alike: their scatter says little of what they have in common.
    let error = (1.48 * median(&mut off) / n.sqrt()).hypot(0.25 * middle);
    [middle.clamp(0.0, MOST_VARIANCE), error]
}

/// Amplitude of a ridge line over that of the wave, and how many waves it covers.
fn ridge_amplitude(line: &Line, wave: &Wave, ridge: &[RidgePoint]) -> Option<(f64, f64)> {
    let place = |p: &RidgePoint| {
        let d = p.place - line.origin;
        (d.dot(line.axis), d.dot(line.axis.perp()))
    };
    let inside = |u: &f64| (wave.ends[0]..=wave.ends[1]).contains(u);
    let places: Vec<(f64, f64)> = ridge.iter().map(place).filter(|(u, _)| inside(u)).collect();
    let (low, high) =
        places.iter().fold((f64::MAX, f64::MIN), |(l, h), (u, _)| (l.min(*u), h.max(*u)));
    if !(high > low) {
        return None;
    }
    let turns = (wave.phase(high) - wave.phase(low)) / std::f64::consts::TAU;
    if turns < LEAST_TURN {
        return None;
    }
    let columns = if turns > 1.5 { 4 } else { 3 };
    let mut normal = Normal::new(columns);
    let middle = 0.5 * (low + high);
    for (u, v) in &places {
        let a = wave.amplitude(*u);
        let (sin, cos) = wave.eccentric(*u).0.sin_cos();
        let row = [1.0, a * cos, a * sin, (u - middle) / (high - low)];
        normal.add(&row[..columns], v - wave.trend(*u), 1.0);
    }
    let found = normal.damped(1e-9).solve()?;
    Some((found[1].hypot(found[2]), turns))
}

fn weighted_median(sorted: &[(f64, f64)], total: f64) -> f64 {
    let mut sum = 0.0;
    for (value, weight) in sorted {
        sum += weight;
        if sum >= 0.5 * total {
            return *value;
        }
    }
    f64::NAN
}

/// The amplitude (pixels) of a wave of the mean length whose slopes have the mean square of those of the ridges.
fn slopes(line: &Line, wave: &Wave, points: &[&RidgePoint]) -> Option<f64> {
    const STEEPEST: f64 = 8.0;
    let (mut sum, mut total) = (0.0, 0.0);
    for p in points {
        let along = p.direction.dot(line.axis).abs();
        let across = p.direction.dot(DVec2::perp(line.axis)).abs();
        if along < f64::EPSILON || p.coherence < 0.3 {
            continue;
        }
        // A point of a steep line covers less of the axis.
        let slope = (across / along).min(STEEPEST);
        sum += along * slope * slope;
        total += along;
    }
    let square = sum / total;
    let k = std::f64::consts::TAU / wave.mean_wavelength();
    (total > 20.0).then(|| (2.0 * square).sqrt() / k)
}
