//! From a photo to the radius and pitch of a curl, in the order of the computation.

use frisure_progress::{Cancelled, Progress};
use glam::DVec2;
use serde::Serialize;

use crate::abstain::{
    Abstention, LEAST_AMPLITUDE, LEAST_EXPLAINED, LEAST_WAVELENGTH, LEAST_WAVES, LENGTHS,
    MOST_APART, MOST_DEVIATION, MOST_TILT, SHORTEST,
};
use crate::contrast::Contrast;
use crate::cues::{Cues, Ratio, cues};
use crate::estimate::Estimate;
use crate::lock::{Line, Lock};
use crate::photo::Photo;
use crate::ridges::ridge_lines;
use crate::scale::Scale;
use crate::search::{Found, search};
use crate::statics::{Fibre, Hanging, Natural, OBSERVED, observables};
use crate::wave::{Sample, Wave};

/// Deviation from a straight line, over its length, below which a line without a clear wave is straight. Chosen.
const STRAIGHT: f64 = 0.02;

/// What is left over by a second wave beside what is left by the first, at which both are equally likely. Chosen.
const EQUALLY_LIKELY: f64 = 1.25;

/// Part of a wave next to the root that is left out: there the lock is still held. Chosen.
const HELD: f64 = 0.4;

/// What no picture tells, as a part of radius and pitch: the scale, the lens, the tilt of the lock towards the camera (cos 5° is 0.996). Chosen.
const UNSEEN: f64 = 0.01;

/// Whether weight stretched the lock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Hang {
    /// It hangs by its root, and down is down in the photo.
    #[default]
    Down,
    /// It lies flat, without weight.
    None,
}

/// What is known besides the photo.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Pixels per metre of the photo as it was given.
    pub scale: Scale,
    /// Whether weight stretched the lock.
    pub hang: Hang,
    /// Its fibres.
    pub fibre: Fibre,
    /// Their length (m); without it, that of the line that is seen.
    pub length: Option<f64>,
}

/// What was measured. Lengths in metres.
#[derive(Clone, Debug, Serialize)]
pub struct Measurement {
    /// Radius as seen: root mean square along the seen part (m).
    pub apparent_radius: Estimate,
    /// Pitch as seen: length of the seen part over its turns (m).
    pub apparent_pitch: Estimate,
    /// Natural radius and pitch (m): without weight. None where no fibre was found that hangs so.
    pub natural: Option<[Estimate; 2]>,
    /// Turns seen.
    pub turns: f64,
    /// Angle of the lock's axis to the photo's vertical (rad), positive where its lower end is to the right.
    pub tilt: f64,
    /// Length of the fibres (m): given, or that of the line that is seen.
    pub length: f64,
    /// Part of the line's variance that the wave explains.
    pub explained: f64,
    /// What the measurement is based on.
    pub cues: Cues,
}

/// Lines to draw over the photo, in its pixels from the top left.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// Ridge lines.
    pub ridges: Vec<Vec<[f64; 2]>>,
    /// The fitted wave, and its axis.
    pub curve: Vec<[f64; 2]>,
    /// The axis of the wave.
    pub axis: Vec<[f64; 2]>,
}

/// The end of a measurement.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The numbers, or why there are none.
    pub result: Result<Measurement, Abstention>,
    /// What was found in the photo.
    pub drawing: Drawing,
}

/// Measures the lock in a photo.
///
/// # Errors
/// [`Cancelled`].
pub fn measure(
    photo: &Photo,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Outcome, Cancelled> {
    let mut drawing = Drawing::default();
    let result = match look(photo, options, progress, &mut drawing)? {
        Ok(seen) => seen.conclude(options, progress)?,
        Err(abstention) => Err(abstention),
    };
    progress.report("measuring", 1.0);
    Ok(Outcome { result, drawing })
}

/// What the photo tells, in metres: u along the axis from the upper end, v across.
struct Seen {
    wave: Wave,
    samples: Vec<Sample>,
    /// Lower end of the lock along the axis (m).
    foot: f64,
    /// Factor on the amplitude: what blur and phases that differ take away; and its standard deviation.
    widening: [f64; 2],
    tilt: f64,
    cues: Cues,
    /// Upper end of the lock (m).
    head: f64,
}

fn look(
    photo: &Photo,
    options: &Options,
    progress: &dyn Progress,
    drawing: &mut Drawing,
) -> Result<Result<Seen, Abstention>, Cancelled> {
    let step = |done: f64| {
        progress.report("measuring", done);
        progress.check()
    };
    step(0.0)?;
    let contrast = match Contrast::new(photo) {
        Ok(contrast) => contrast,
        Err(why) => return Ok(Err(why)),
    };
    step(0.1)?;
    let lock = match Lock::find(&contrast) {
        Ok(lock) => lock,
        Err(why) => return Ok(Err(why)),
    };
    step(0.2)?;
    let ridges = ridge_lines(&lock);
    let original = |p: DVec2| {
        let reduction = photo.reduction() as f64;
        let [x, y] = photo.origin();
        let of = |working: f64, corner: usize| corner as f64 + (working + 0.5) * reduction - 0.5;
        [of(p.x, x), of(p.y, y)]
    };
    drawing.ridges =
        ridges.iter().map(|line| line.iter().map(|p| original(p.place)).collect()).collect();
    step(0.4)?;
    let (line, found) = match follow(&lock, options.hang) {
        Ok(found) => found,
        Err(why) => return Ok(Err(why.in_metres(photo, options))),
    };
    let wave = &found.wave;
    let ends = wave.ends;
    let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / 600.0;
    drawing.curve = (0..=600).map(|i| original(line.place(at(i), wave.value(at(i))))).collect();
    drawing.axis =
        (0..=600).step_by(20).map(|i| original(line.place(at(i), wave.trend(at(i))))).collect();
    step(0.6)?;
    let pixel = photo.reduction() as f64 / options.scale.pixels_per_metre();
    if let Err(why) = clear(&found, photo.reduction() as f64, pixel) {
        return Ok(Err(why));
    }
    let (cues, ratio) = cues(&line, wave, &ridges, pixel);
    let seen = Seen::new(&line, wave, ratio, cues, pixel);
    Ok(match supported(&cues).and_then(|()| hangs(&seen, options.hang)) {
        Ok(()) => Ok(seen),
        Err(why) => Err(why),
    })
}

/// Whether hairs run as the wave does: an outline alone is no lock.
fn supported(cues: &Cues) -> Result<(), Abstention> {
    let others = [cues.ridges.map(|ridges| ridges.value), cues.slopes];
    let mut others = others.into_iter().flatten().peekable();
    if others.peek().is_none() {
        return Err(Abstention::Unsupported);
    }
    let apart = |other: &f64| !(1.0 / MOST_APART..=MOST_APART).contains(&(other / cues.line));
    match others.find(apart) {
        Some(other) => Err(Abstention::Disagree { line: cues.line, other }),
        None => Ok(()),
    }
}

/// Whether a lock that is said to hang does.
fn hangs(seen: &Seen, hang: Hang) -> Result<(), Abstention> {
    let tilt = seen.tilt;
    match hang {
        Hang::Down if tilt.abs() > MOST_TILT => Err(Abstention::Aslant { tilt }),
        _ => Ok(()),
    }
}

/// Why no wave was found, with lengths in pixels that are worked at.
enum Unseen {
    Nothing(Abstention),
    Line { deviation: f64, length: f64, waves: f64, explained: f64 },
}

impl Unseen {
    fn in_metres(self, photo: &Photo, options: &Options) -> Abstention {
        let pixel = photo.reduction() as f64 / options.scale.pixels_per_metre();
        match self {
            Self::Nothing(why) => why,
            Self::Line { deviation, length, waves, explained } => {
                if deviation < STRAIGHT * length {
                    // The widest wave of which fewer than 1.5 are seen and that deviates no more: κ = A k².
                    let k = std::f64::consts::TAU * LEAST_WAVES / (length * pixel);
                    let amplitude = (deviation + 1.0) * pixel * std::f64::consts::SQRT_2;
                    let most_curvature = amplitude * k * k;
                    return Abstention::Straight { deviation: deviation * pixel, most_curvature };
                }
                if waves < LEAST_WAVES {
                    return Abstention::FewWaves { waves };
                }
                Abstention::NoWave { explained }
            }
        }
    }
}

/// The line of the lock and its wave (pixels that are worked at), with the axis turned to that of the wave.
fn follow(lock: &Lock, hang: Hang) -> Result<(Line, Found), Unseen> {
    let (mut origin, mut axis) = lock.axis(hang == Hang::Down);
    let mut held = 0.0;
    let mut last: Option<(Line, Found)> = None;
    for _ in 0..3 {
        let line = lock.line(origin, axis);
        let samples = samples(&line, held);
        let [Some(first), Some(end)] = [samples.first(), samples.last()].map(|s| s.map(|s| s.u))
        else {
            return Err(Unseen::Nothing(Abstention::NoHair));
        };
        let length = end - first;
        let found = search(&samples, 8.0, length / 1.2);
        let Some(found) = found.filter(|f| f.wave.explained > 0.3) else {
            return match last {
                Some(last) => Ok(last),
                None => Err(no_wave(&samples, length, None)),
            };
        };
        let wave = &found.wave;
        if wave.turns() < LEAST_WAVES || wave.explained < LEAST_EXPLAINED {
            return Err(no_wave(&samples, length, Some(wave)));
        }
        let middle = 0.5 * (wave.ends[0] + wave.ends[1]);
        let slope = wave.slope();
        held = match hang {
            Hang::Down => HELD * std::f64::consts::TAU / wave.wave_number(wave.ends[0]),
            Hang::None => 0.0,
        };
        let (turned, centre) =
            ((axis + axis.perp() * slope).normalize(), line.place(middle, wave.trend(middle)));
        let straight = slope.abs() < 0.002 && last.is_some();
        last = Some((line, found));
        if straight {
            break;
        }
        (axis, origin) = (turned, centre);
    }
    last.ok_or(Unseen::Nothing(Abstention::NoHair))
}

fn samples(line: &Line, held: f64) -> Vec<Sample> {
    let Some(first) = line.rows.first() else { return Vec::new() };
    let from = first.along + held;
    let rows = line.rows.iter().filter(|row| row.along >= from);
    rows.map(|row| Sample { u: row.along, v: row.across, weight: row.weight }).collect()
}

/// The deviation of a line from a straight one, and what a wave explains.
fn no_wave(samples: &[Sample], length: f64, wave: Option<&Wave>) -> Unseen {
    let mut normal = crate::dense::Normal::new(2);
    for s in samples {
        normal.add(&[1.0, s.u], s.v, s.weight);
    }
    let fit = normal.damped(1e-9).solve().unwrap_or(vec![0.0; 2]);
    let total: f64 = samples.iter().map(|s| s.weight).sum();
    let square: f64 =
        samples.iter().map(|s| s.weight * (s.v - fit[0] - fit[1] * s.u).powi(2)).sum();
    Unseen::Line {
        deviation: (square / total).sqrt(),
        length,
        waves: wave.map_or(0.0, Wave::turns),
        explained: wave.map_or(0.0, |w| w.explained),
    }
}

/// Whether a wave is large and clear enough; `reduction` is the photo's, `pixel` the size (m) of one that is worked at.
fn clear(found: &Found, reduction: f64, pixel: f64) -> Result<(), Abstention> {
    let wave = &found.wave;
    let [amplitude, wavelength] =
        [wave.mean_amplitude(), wave.mean_wavelength()].map(|x| x * reduction);
    if amplitude < LEAST_AMPLITUDE || wavelength < LEAST_WAVELENGTH {
        return Err(Abstention::Coarse { amplitude, wavelength });
    }
    if let Some(rival) = &found.rival
        && rival.turns() >= LEAST_WAVES
        && rival.residual < EQUALLY_LIKELY * wave.residual
    {
        let (first, second) = (wave.mean_wavelength() * pixel, rival.mean_wavelength() * pixel);
        return Err(Abstention::Ambiguous { first, second });
    }
    Ok(())
}

impl Seen {
    fn new(line: &Line, wave: &Wave, ratio: Ratio, cues: Cues, pixel: f64) -> Self {
        let widening = [ratio.value, ratio.deviation.hypot(UNSEEN)];
        let rows = &line.rows;
        let [head, foot] = [rows[0].along, rows[rows.len() - 1].along];
        let from = wave.ends[0];
        let samples = line.rows.iter().filter(|r| r.along >= from).map(|r| Sample {
            u: (r.along - head) * pixel,
            v: r.across * pixel,
            weight: r.weight,
        });
        let tilt = line.axis.x.atan2(line.axis.y);
        let scaled = wave.scaled(pixel, head);
        Self {
            wave: scaled,
            samples: samples.collect(),
            foot: (foot - head) * pixel,
            head: 0.0,
            widening,
            tilt,
            cues,
        }
    }

    /// The wave without each of some parts of the line in turn (block jackknife).
    fn replicates(&self) -> Vec<Wave> {
        let blocks = (self.wave.turns().round() as usize).clamp(4, 12);
        let [from, to] = self.wave.ends;
        let block = |s: &Sample| ((s.u - from) / (to - from) * blocks as f64) as usize;
        let without = |left_out: usize| {
            let kept: Vec<Sample> = self
                .samples
                .iter()
                .filter(|s| block(s).min(blocks - 1) != left_out)
                .copied()
                .collect();
            let mut wave = self.wave.clone();
            wave.refine(&kept)?;
            Some(wave)
        };
        (0..blocks).filter_map(without).collect()
    }

    fn conclude(
        self,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Result<Measurement, Abstention>, Cancelled> {
        let replicates = self.replicates();
        let wave = &self.wave;
        let of = |wave: &Wave| [wave.mean_amplitude().ln(), wave.mean_wavelength().ln()];
        let deviations = jackknife(&replicates, of);
        let [widening, widening_error] = self.widening;
        let apparent_radius = Estimate::of_logarithm(
            wave.mean_amplitude() * widening,
            deviations[0].hypot(widening_error),
        );
        let apparent_pitch =
            Estimate::of_logarithm(wave.mean_wavelength(), deviations[1].hypot(UNSEEN));
        let slope = std::f64::consts::TAU * apparent_radius.value / apparent_pitch.value;
        let arc = (self.foot - self.head) * mean_stretch(wave, widening, slope);
        if !(LENGTHS[0]..=LENGTHS[1]).contains(&arc) {
            return Ok(Err(Abstention::Scale { length: arc }));
        }
        let length = options.length.unwrap_or(arc);
        if length < SHORTEST * arc {
            return Ok(Err(Abstention::Short { seen: arc, given: length }));
        }
        let natural = match options.hang {
            Hang::None => Some([apparent_radius, apparent_pitch]),
            Hang::Down => self.natural(&replicates, options, length, progress)?,
        };
        let checked = natural.unwrap_or([apparent_radius, apparent_pitch]);
        let [radius, pitch] = checked.map(|e| e.deviation / e.value);
        if !(radius.max(pitch) <= MOST_DEVIATION) {
            return Ok(Err(Abstention::Uncertain { radius, pitch }));
        }
        Ok(Ok(Measurement {
            apparent_radius,
            apparent_pitch,
            natural,
            turns: wave.turns(),
            tilt: self.tilt,
            length,
            explained: wave.explained,
            cues: self.cues,
        }))
    }

    /// Natural radius and pitch by inverse statics, with deviations by the replicates, the widening and the spread of the fibres.
    fn natural(
        &self,
        replicates: &[Wave],
        options: &Options,
        length: f64,
        progress: &dyn Progress,
    ) -> Result<Option<[Estimate; 2]>, Cancelled> {
        let widened = |wave: &Wave| {
            let mut seen = observables(wave);
            seen[OBSERVED / 2..].iter_mut().for_each(|a| *a += self.widening[0].ln());
            seen
        };
        let seen = widened(&self.wave);
        let deviations = jackknife(replicates, widened);
        let [from, to] = self.wave.ends;
        let above_tip = [self.foot - to, self.foot - from];
        let hanging = Hanging { fibre: &options.fibre, length, above_tip };
        let Some(Natural { x, gain }) = hanging.solve(&seen, &deviations, 1.0, None, progress)?
        else {
            return Ok(None);
        };
        let mapped = |wave: &Wave| {
            let other = widened(wave);
            let by = |row: usize| {
                (0..OBSERVED).map(|i| gain[row][i] * (other[i] - seen[i])).sum::<f64>()
            };
            [by(0), by(1)]
        };
        let image = jackknife(replicates, mapped);
        let amplitudes = |row: usize| gain[row][OBSERVED / 2..].iter().sum::<f64>();
        // Softer and heavier by one standard deviation: the same as more gravity.
        let gravity = 1.0 + options.fibre.spread;
        let other = hanging.solve(&seen, &deviations, gravity, Some(x), progress)?;
        let fibre = other.map_or([f64::INFINITY; 2], |o| [o.x[0] - x[0], o.x[1] - x[1]]);
        let estimate = |i: usize| {
            let deviation = (image[i].powi(2)
                + (amplitudes(i) * self.widening[1]).powi(2)
                + fibre[i].powi(2)
                + UNSEEN.powi(2))
            .sqrt();
            Estimate::of_logarithm(x[i].exp(), deviation)
        };
        Ok(Some([estimate(0), estimate(1)]))
    }
}

/// Arc length over length along the axis, averaged along the wave.
fn mean_stretch(wave: &Wave, widening: f64, otherwise: f64) -> f64 {
    let [from, to] = wave.ends;
    let n = 50;
    let at = |i: i32| from + (to - from) * (f64::from(i) + 0.5) / f64::from(n);
    let stretch = |u: f64| (wave.amplitude(u) * widening * wave.wave_number(u)).hypot(1.0);
    let mean = (0..n).map(|i| stretch(at(i))).sum::<f64>() / f64::from(n);
    if mean.is_finite() { mean } else { otherwise.hypot(1.0) }
}

/// Standard deviations of some numbers of a wave, from waves without a part of the line each.
fn jackknife<const N: usize>(replicates: &[Wave], of: impl Fn(&Wave) -> [f64; N]) -> [f64; N] {
    let n = replicates.len() as f64;
    if replicates.len() < 2 {
        return [f64::INFINITY; N];
    }
    let values: Vec<[f64; N]> = replicates.iter().map(of).collect();
    let mut found = [0.0; N];
    for (i, deviation) in found.iter_mut().enumerate() {
        let mean = values.iter().map(|v| v[i]).sum::<f64>() / n;
        let square: f64 = values.iter().map(|v| (v[i] - mean).powi(2)).sum();
        *deviation = ((n - 1.0) / n * square).sqrt();
    }
    found
}
