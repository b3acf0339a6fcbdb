//! The wavelength along a line, without a start: a periodogram in windows, and the best path through it.

use std::f64::consts::TAU;

use crate::dense::Normal;
use crate::wave::{Sample, Wave, hann, window};

/// Steps of the wavelength, and how many windows there are along the line. Chosen.
const STEP: f64 = 1.06;
const WINDOWS: usize = 49;

/// Half of a window, in wavelengths. Chosen: wide enough to tell a wave from the trend, narrow enough for one that changes.
const REACH: f64 = 1.25;

/// Most samples in a window; more are thinned out. Chosen.
const IN_WINDOW: usize = 120;

/// Cost of a change of the wavelength by a step from one window to the next, of an explained variance of 1. Chosen.
const CHANGE: f64 = 0.02;

/// Ratio of two wavelengths that are not the same. Chosen.
const OTHER: f64 = 1.3;

/// A wave that was found without a start.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) wave: Wave,
    /// The next best wave of another length, if there is one.
    pub(crate) rival: Option<Wave>,
}

/// The wave along a line, of at most `longest`.
pub(crate) fn search(samples: &[Sample], shortest: f64, longest: f64) -> Option<Found> {
    let (first, last) = (samples.first()?.u, samples.last()?.u);
    if !(longest > shortest && last > first) {
        return None;
    }
    let count = ((longest / shortest).ln() / STEP.ln()).ceil() as usize + 1;
    let wavelengths: Vec<f64> = (0..count).map(|i| shortest * STEP.powi(i as i32)).collect();
    let centre = |i: usize| first + (last - first) * i as f64 / (WINDOWS - 1) as f64;
    let explained: Vec<Vec<Window>> = (0..WINDOWS)
        .map(|i| {
            wavelengths.iter().map(|&length| periodogram(samples, centre(i), length)).collect()
        })
        .collect();
    let fit = |path: &[usize]| {
        let places: Vec<(f64, f64, f64)> = path
            .iter()
            .enumerate()
            .map(|(i, &l)| (centre(i), TAU / wavelengths[l], explained[i][l].amplitude))
            .collect();
        let mut wave = Wave::through([first, last], &places, samples)?;
        for _ in 0..3 {
            wave.follow_phase(samples, WINDOWS)?;
        }
        wave.refine(samples)?;
        Some(wave)
    };
    let best = path(&explained, None)?;
    let rival = path(&explained, Some(&best));
    let wave = fit(&best);
    let rival = rival.and_then(|path| fit(&path));
    match (wave, rival) {
        (Some(wave), Some(rival)) if rival.explained > wave.explained => {
            Some(Found { wave: rival, rival: Some(wave) })
        }
        (Some(wave), rival) => Some(Found { wave, rival }),
        (None, Some(rival)) => Some(Found { wave: rival, rival: None }),
        (None, None) => None,
    }
    .map(|found| Found { rival: found.rival.filter(|r| different(r, &found.wave)), ..found })
}

fn different(a: &Wave, b: &Wave) -> bool {
    let ratio = a.mean_wavelength() / b.mean_wavelength();
    ratio > OTHER || ratio < OTHER.recip()
}

/// What a wave of one length explains in one window.
#[derive(Clone, Copy, Debug)]
struct Window {
    explained: f64,
    amplitude: f64,
}

fn periodogram(samples: &[Sample], centre: f64, wavelength: f64) -> Window {
    let reach = REACH * wavelength;
    let near = window(samples, centre, reach);
    let none = Window { explained: 0.0, amplitude: 0.0 };
    if near.len() < 8 {
        return none;
    }
    let (mut line, mut wave) = (Normal::new(2), Normal::new(4));
    let step = near.len().div_ceil(IN_WINDOW);
    let rows = near.iter().step_by(step).map(|s| {
        let x = (s.u - centre) / reach;
        let (sin, cos) = (TAU * (s.u - centre) / wavelength).sin_cos();
        ([1.0, x, cos, sin], s.v, s.weight * hann(x))
    });
    let rows: Vec<([f64; 4], f64, f64)> = rows.collect();
    for (row, v, weight) in &rows {
        line.add(&row[..2], *v, *weight);
        wave.add(row, *v, *weight);
    }
    let (Some(straight), Some(found)) = (line.damped(1e-9).solve(), wave.damped(1e-6).solve())
    else {
        return none;
    };
    let left = |x: &[f64]| -> f64 {
        let off = |row: &[f64; 4], v: f64| v - x.iter().zip(row).map(|(a, b)| a * b).sum::<f64>();
        rows.iter().map(|(row, v, weight)| weight * off(row, *v).powi(2)).sum()
    };
    let all = left(&straight);
    let explained = if all > 0.0 { 1.0 - left(&found) / all } else { 0.0 };
    Window { explained, amplitude: found[2].hypot(found[3]) }
}

/// The indices of the wavelengths, one per window, that explain most together, with changes that cost; not near those of another path.
fn path(explained: &[Vec<Window>], other: Option<&[usize]>) -> Option<Vec<usize>> {
    let apart = (OTHER.ln() / STEP.ln()).ceil() as usize;
    let score = |i: usize, l: usize| match other {
        Some(path) if path[i].abs_diff(l) < apart => f64::NEG_INFINITY,
        _ => explained[i][l].explained,
    };
    let count = explained.first()?.len();
    let mut totals: Vec<f64> = (0..count).map(|l| score(0, l)).collect();
    let mut from: Vec<Vec<usize>> = Vec::new();
    for i in 1..explained.len() {
        let mut next = vec![f64::NEG_INFINITY; count];
        let mut back = vec![0; count];
        for l in 0..count {
            let near = totals.iter().enumerate().take(l + 3).skip(l.saturating_sub(2));
            for (before, total) in near {
                let change = before.abs_diff(l) as f64;
                let total = total - CHANGE * change * change;
                if total > next[l] {
                    (next[l], back[l]) = (total, before);
                }
            }
            next[l] += score(i, l);
        }
        totals = next;
        from.push(back);
    }
    let mut at = (0..count).max_by(|a, b| totals[*a].total_cmp(&totals[*b]))?;
    if !totals[at].is_finite() {
        return None;
    }
    let mut path = vec![at];
    for back in from.iter().rev() {
        at = back[at];
        path.push(at);
    }
    path.reverse();
    Some(path)
}
