//! Photos of locks whose curl is known, measured.

use frisure::formats::picture::png;
use frisure::measure::{Abstention, Fibre, Hang, Options, Outcome, Photo, Scale, draw, measure};
use frisure::progress::Progress;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::experiment::check;
use crate::finding::{Finding, Limit, Picture, Table};
use crate::photos::{KnownLock, KnownPhoto, photo};
use crate::plot::{Mark, Plot, Scale as Axis};
use crate::{Effort, Experiment, Stopped};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "photo",
    title: "The curl of a lock in a photo",
    question: "How well does `frisure measure` find the natural radius and pitch of a lock's curl from one photo, and how often does it abstain?",
    method: "Locks of known curl are rendered. The hair type is drawn from all presets, straight ones included; radius and pitch are those of the type \
             times a factor of 0.8 to 1.25 each; diameter and axis ratio vary as the type's do; the length is that of 4 to 12 natural turns, within 5 to \
             45 cm. A third are single hairs, the others have 3 to 40 hairs whose phases differ by 0.1 to 0.4 rad, and by up to another 0.25 along \
             the lock, beside each other within 5 to 30 % of the radius. They hang at equilibrium, held within 10° of where their axis is vertical, in \
             front of paper (dark hair) or dark cloth (blond hair) in uneven light. The camera is 2.5 to 5 times the picture's height away, rolled by up to 5° and up to \
             3° above or below. The preview draws 1400 to 2400 rows; blur of 0.5 to 0.9 pixels and noise of 0.5 to 1.5 % are added.\n\n\
             Each photo is measured twice: with the fibre and the length of the lock given (within 5 % of stiffness over weight), and with nothing but \
             its hair type. Thresholds were chosen on seeds below 1000; these photos have seeds from 10000. A lock that shows fewer than 1.5 turns as it hangs counts as \
             straight; its photo has no radius, and to abstain is right. All numbers are of renders: none is of a real photo.",
    run,
};

/// The first seed. Seeds below 1000 were used to choose thresholds.
const FIRST_SEED: u64 = 10_000;

/// Turns below which a lock counts as straight: what `frisure measure` needs.
const STRAIGHT: f64 = 1.5;

/// Relative error that is good.
const GOOD: f64 = 0.1;

/// Standard deviation of stiffness over weight of a fibre whose section and modulus were measured, relative.
const KNOWN_SPREAD: f64 = 0.05;

/// Standard deviations of stiffness over weight of a type's fibres besides its diameter: as the command has it.
const TYPE_MODULUS: f64 = 0.15;

/// A photo with both measurements.
struct Trial {
    known: KnownLock,
    outcomes: [Outcome; 2],
}

/// What a set of measurements comes to.
#[derive(Default)]
struct Tally {
    curled: usize,
    answered: usize,
    /// Within [`GOOD`]: radius, pitch, both.
    good: [usize; 3],
    /// Errors of radius and pitch, and over their deviations.
    errors: [Vec<f64>; 2],
    units: [Vec<f64>; 2],
    straight: usize,
    /// Straight locks that got a radius.
    invented: usize,
}

fn options(photo: &KnownPhoto, given: bool) -> Result<Options, Stopped> {
    let kind = photo.lock.preset.hair_type();
    let scale = Scale::new(photo.scale).map_err(|e| Stopped::Other(e.to_string()))?;
    let fibre = if given {
        Fibre { spread: KNOWN_SPREAD, ..photo.lock.fibre }
    } else {
        let usual = kind.fibre(Default::default())?;
        let parts = [
            2.0 * kind.diameter_variation,
            kind.axis_ratio_deviation / kind.axis_ratio,
            TYPE_MODULUS,
        ];
        let spread = parts.iter().map(|x| x * x).sum::<f64>().sqrt();
        Fibre { section: usual.section, material: usual.material, torsion: usual.torsion, spread }
    };
    Ok(Options { scale, hang: Hang::Down, fibre, length: given.then_some(photo.lock.length) })
}

fn trial(seed: u64) -> Result<(Trial, KnownPhoto), Stopped> {
    let known = photo(seed)?;
    let pixels = Photo::new(known.size[0], known.size[1], &known.rgb, None)
        .map_err(|e| Stopped::Other(e.to_string()))?;
    let of = |given| Ok::<_, Stopped>(measure(&pixels, &options(&known, given)?, &())?);
    let outcomes = [of(true)?, of(false)?];
    Ok((Trial { known: known.lock.clone(), outcomes }, known))
}

impl Tally {
    fn of(trials: &[Trial], which: usize) -> Self {
        let mut tally = Self::default();
        for trial in trials {
            let natural =
                trial.outcomes[which].result.as_ref().ok().and_then(|found| found.natural);
            if trial.known.turns < STRAIGHT {
                tally.straight += 1;
                tally.invented += usize::from(natural.is_some());
                continue;
            }
            tally.curled += 1;
            let Some(natural) = natural else { continue };
            tally.answered += 1;
            let mut good = [false; 2];
            for (i, (estimate, truth)) in natural.iter().zip(trial.known.natural).enumerate() {
                let error = estimate.value / truth - 1.0;
                good[i] = error.abs() <= GOOD;
                tally.errors[i].push(error.abs());
                tally.units[i].push((estimate.value - truth) / estimate.deviation);
            }
            for (count, is) in tally.good.iter_mut().zip([good[0], good[1], good[0] && good[1]]) {
                *count += usize::from(is);
            }
        }
        tally.errors.iter_mut().for_each(|e| e.sort_by(f64::total_cmp));
        tally
    }

    fn part(&self, count: usize) -> f64 {
        count as f64 / self.answered.max(1) as f64
    }

    fn abstained(&self) -> f64 {
        1.0 - self.answered as f64 / self.curled.max(1) as f64
    }

    /// Part of the intervals of 95 % that contain the truth.
    fn covered(&self, i: usize) -> f64 {
        let inside = self.units[i].iter().filter(|u| u.abs() <= 1.96).count();
        self.part(inside)
    }

    fn row(&self, name: &str) -> Vec<String> {
        let percent = |x: f64| format!("{:.0} %", 100.0 * x);
        let at = |i: usize, part: f64| {
            let errors = &self.errors[i];
            let place = (part * errors.len() as f64) as usize;
            errors
                .get(place.min(errors.len().saturating_sub(1)))
                .map_or("–".to_owned(), |x| format!("{:.1} %", 100.0 * x))
        };
        vec![
            name.to_owned(),
            self.curled.to_string(),
            percent(self.abstained()),
            percent(self.part(self.good[0])),
            percent(self.part(self.good[1])),
            percent(self.part(self.good[2])),
            format!("{}, {}", at(0, 0.5), at(0, 0.95)),
            format!("{}, {}", at(1, 0.5), at(1, 0.95)),
            format!("{}, {}", percent(self.covered(0)), percent(self.covered(1))),
        ]
    }
}

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let count: u64 = effort.pick(20, 200);
    let pictures: u64 = effort.pick(2, 6);
    let mut finding = Finding::default();
    let mut trials = Vec::new();
    const TOGETHER: u64 = 8;
    for first in (0..count).step_by(TOGETHER as usize) {
        check(progress, EXPERIMENT.name, first as f64 / count as f64)?;
        let found: Result<Vec<(Trial, KnownPhoto)>, Stopped> = (first
            ..(first + TOGETHER).min(count))
            .into_par_iter()
            .map(|i| trial(FIRST_SEED + i))
            .collect();
        for (i, (trial, known)) in (first..).zip(found?) {
            if i < pictures {
                finding.picture(picture(i, &trial, known)?);
            }
            trials.push(trial);
        }
    }
    tables(&mut finding, &trials);
    plots(&mut finding, &trials);
    let (given, by_type) = (Tally::of(&trials, 0), Tally::of(&trials, 1));
    let share = |what: &str| {
        format!("{what} within 10 % with the fibre given, of locks that were answered")
    };
    finding.check(share("natural radius"), given.part(given.good[0]), Limit::AtLeast(0.9));
    finding.check(share("natural pitch"), given.part(given.good[1]), Limit::AtLeast(0.9));
    finding.check(
        "curled locks without an answer, with the fibre given",
        given.abstained(),
        Limit::AtMost(0.2),
    );
    finding.check(
        "straight locks that got a radius",
        (given.invented + by_type.invented) as f64,
        Limit::AtMost(0.0),
    );
    Ok(finding)
}

/// Rows of a picture in the report, about.
const SHOWN: usize = 600;

/// The photo beside itself with what was found, reduced.
fn picture(i: u64, trial: &Trial, mut known: KnownPhoto) -> Result<Picture, Stopped> {
    let plain = known.rgb.clone();
    draw(known.size[0], &mut known.rgb, &trial.outcomes[0].drawing);
    let n = known.size[1].div_ceil(SHOWN);
    let [width, height] = known.size.map(|size| size / n);
    let mut rgba = Vec::with_capacity(8 * width * height);
    for (y, source, x) in (0..height)
        .flat_map(|y| [&plain, &known.rgb].map(|source| (y, source)))
        .flat_map(|(y, source)| (0..width).map(move |x| (y, source, x)))
    {
        let pixel = |k: usize| 3 * ((n * y + k / n) * known.size[0] + n * x + k % n);
        let sum = |c: usize| (0..n * n).map(|k| usize::from(source[pixel(k) + c])).sum::<usize>();
        // A mean of bytes.
        let mean = |c: usize| (sum(c) / (n * n)) as u8;
        rgba.extend([mean(0), mean(1), mean(2), 255]);
    }
    let png = png::encode(2 * width as u32, height as u32, &rgba)
        .map_err(|e| Stopped::Other(e.to_string()))?;
    let lock = &trial.known;
    let said = match &trial.outcomes[0].result {
        Ok(found) => {
            found.natural.map_or("no natural curl was found".to_owned(), |[radius, pitch]| {
                format!("measured {:.2} and {:.2} mm", 1e3 * radius.value, 1e3 * pitch.value)
            })
        }
        Err(why) => format!("not measured: {why}"),
    };
    let caption = format!(
        "{}, {} hairs: natural radius {:.2} mm, pitch {:.2} mm; {said}. Left: the photo; right: ridge lines and the fitted wave.",
        lock.preset.name,
        lock.hairs,
        1e3 * lock.natural[0],
        1e3 * lock.natural[1],
    );
    Ok(Picture { name: format!("photo-lock-{i}"), caption, width: 2 * width, png })
}

fn tables(finding: &mut Finding, trials: &[Trial]) {
    let head = [
        "known",
        "curled locks",
        "abstained",
        "radius within 10 %",
        "pitch within 10 %",
        "both",
        "error of the radius: median, 95 %",
        "of the pitch",
        "in the interval of 95 %: radius, pitch",
    ];
    let mut table = Table::new("Natural radius and pitch", &head);
    table.row(Tally::of(trials, 0).row("fibre and length"));
    table.row(Tally::of(trials, 1).row("hair type"));
    finding.table(table);
    let straight = Tally::of(trials, 0);
    finding.text(format!(
        "{} locks are straight as they hang; {} of them got a radius with the fibre given. Of all {} photos, {:.0} % got no answer.",
        straight.straight,
        straight.invented,
        trials.len(),
        100.0 * (1.0 - (straight.answered + straight.invented) as f64 / trials.len() as f64),
    ));
    let mut reasons: Vec<(&'static str, usize, usize)> = Vec::new();
    for trial in trials {
        let Err(why) = &trial.outcomes[0].result else { continue };
        let name = reason(why);
        let slot = reasons.iter_mut().find(|(known, ..)| *known == name);
        let is_straight = usize::from(trial.known.turns < STRAIGHT);
        match slot {
            Some((_, curled, straight)) => {
                *curled += 1 - is_straight;
                *straight += is_straight;
            }
            None => reasons.push((name, 1 - is_straight, is_straight)),
        }
    }
    let mut table = Table::new(
        "Why it abstained, with the fibre given",
        &["reason", "curled locks", "straight locks"],
    );
    for (name, curled, straight) in reasons {
        table.row([name.to_owned(), curled.to_string(), straight.to_string()]);
    }
    finding.table(table);
    type_table(finding, trials);
}

/// By the natural radius, which goes with the type.
fn type_table(finding: &mut Finding, trials: &[Trial]) {
    let mut table = Table::new(
        "By hair type, with the fibre given",
        &["type", "locks", "answered", "both within 10 %"],
    );
    let mut names: Vec<&str> = trials.iter().map(|t| t.known.preset.name).collect();
    names.sort_unstable();
    names.dedup();
    for name in names {
        let of_type = trials.iter().filter(|t| t.known.preset.name == name);
        let (mut locks, mut answered, mut good) = (0, 0, 0);
        for trial in of_type {
            locks += 1;
            let natural = trial.outcomes[0].result.as_ref().ok().and_then(|found| found.natural);
            let Some(natural) = natural else { continue };
            answered += 1;
            let near = |i: usize| (natural[i].value / trial.known.natural[i] - 1.0).abs() <= GOOD;
            good += usize::from(near(0) && near(1));
        }
        table.row([name.to_owned(), locks.to_string(), answered.to_string(), good.to_string()]);
    }
    finding.table(table);
}

fn reason(why: &Abstention) -> &'static str {
    match why {
        Abstention::Background { .. } => "background not plain",
        Abstention::NoHair => "no hair found",
        Abstention::Crowded { .. } => "too much hair",
        Abstention::Several { .. } => "several things",
        Abstention::Straight { .. } => "straight",
        Abstention::FewWaves { .. } => "too few waves",
        Abstention::Coarse { .. } => "too few pixels",
        Abstention::NoWave { .. } => "no wave",
        Abstention::Ambiguous { .. } => "two pitches equally likely",
        Abstention::Aslant { .. } => "aslant",
        Abstention::Disagree { .. } | Abstention::Unsupported => "hairs off the wave",
        Abstention::Uncertain { .. } => "error bars too wide",
        Abstention::Scale { .. } | Abstention::Short { .. } => "length of the hair",
    }
}

fn plots(finding: &mut Finding, trials: &[Trial]) {
    for (i, what) in ["radius", "pitch"].into_iter().enumerate() {
        let points: Vec<(f64, f64)> = trials
            .iter()
            .filter_map(|trial| {
                let natural = trial.outcomes[0].result.as_ref().ok()?.natural?;
                let truth = trial.known.natural[i];
                Some((1e3 * truth, 100.0 * (natural[i].value / truth - 1.0)))
            })
            .collect();
        let title = format!("Error of the natural {what}, with the fibre given");
        let name = format!("natural {what} (mm)");
        let mut plot = Plot::new(&title, &name, "error (%)", [Axis::Log, Axis::Linear]);
        plot.add("a lock", Mark::Points, points);
        finding.plot(plot);
    }
}
