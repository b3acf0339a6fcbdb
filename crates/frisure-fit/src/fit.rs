//! Fibres to numbers with error bars.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use frisure_progress::{Cancelled, Progress, StageCounter};
use glam::{DMat3, DVec3};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use serde::Serialize;

use crate::blind::{Blind, blind_directions};
use crate::dense::Symmetric;
use crate::known::{Estimate, Known, Options};
use crate::pose::Fibre;
use crate::solve::{Job, Minimum, run, shared_information};
use crate::start::elements;
use crate::unknowns::{Layout, Unknowns};

/// How a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FitStatus {
    /// The points deviate from the rods no more than noise does; with a noise that is not given, the fit has converged.
    Fitted,
    /// The fit has converged, and the points deviate by more than the noise that was given. The deviations of the numbers say nothing then.
    Misfit,
    /// The fit did not converge. The numbers say nothing.
    NotConverged,
}

/// What was found of one fibre. Numbers whose deviation is not much less than they are were not told by the lines: see
/// [`Fit::blind`] and [`Fit::statements`].
#[derive(Clone, Debug, Serialize)]
pub struct Fit {
    /// How it ended.
    pub status: FitStatus,
    /// Natural curvature (rad/m), at least 0, and torsion (rad/m), negative for a left-handed curl; the means where they vary.
    pub curvature: Estimate,
    /// Natural torsion (rad/m).
    pub torsion: Estimate,
    /// Radius (m) of the natural helix, κ/(κ² + τ²).
    pub curl_radius: Estimate,
    /// Pitch (m) of the natural helix, 2πτ/(κ² + τ²); negative: left-handed.
    pub curl_pitch: Estimate,
    /// EI/(ρSg) (m³) in each state of wetness, with the smaller bending stiffness and g = 9.81 m/s².
    pub stiffness_over_weight: Vec<Estimate>,
    /// GJ/EI in the first state.
    pub torsion_ratio: Estimate,
    /// GJ/EI in each state of wetness.
    pub torsion_ratio_by_state: Vec<Estimate>,
    /// Longer over shorter axis of the section: the root of the bending stiffness across the natural curl over that along it. Lines seldom
    /// tell it; what is known of it decides how well they tell EI/(ρSg).
    pub axis_ratio: Estimate,
    /// Length (m) in each state of wetness.
    pub length: Vec<Estimate>,
    /// Natural curvature and torsion (rad/m) at each knot, if there are several.
    pub profile: Vec<[Estimate; 2]>,
    /// Covariance of curvature and torsion (rad/m), and of the logarithms of EI/(ρSg) in the first state and of GJ/EI, by rows.
    pub covariance: [[f64; 4]; 4],
    /// What the lines do not tell, with the numbers that trade with each other.
    pub blind: Vec<Blind>,
    /// Standard deviation of a coordinate (m): given, or estimated from what the fit leaves over.
    pub noise: f64,
    /// Mean square of the distance from the rods, in units of what the noise makes it.
    pub reduced_square: f64,
    /// Position (m) and directors d1, d2, t of the clamp in each pose, in its axes.
    #[serde(skip)]
    pub roots: Vec<(DVec3, DMat3)>,
    /// Where the points of each pose are on its rod (m).
    #[serde(skip)]
    pub lines: Vec<Vec<DVec3>>,
    /// Elements of each rod.
    pub elements: usize,
    /// How often the rods were solved.
    pub iterations: usize,
}

/// Chunks per thread, of at least so many fibres: few chunks keep lanes full, since the last fibres of a chunk may take a hundred times the steps of others
/// and go on alone.
const CHUNKS_PER_THREAD: usize = 2;
const SMALLEST_CHUNK: usize = 16;

/// Fits fibres, on all threads of the current pool.
///
/// `known` has what is known of each, or one for all. Neither [`Known::check`] nor [`Options::check`] may fail for them. The result of a fibre does not depend
/// on the others.
///
/// # Errors
/// [`Cancelled`].
///
/// # Panics
/// If there is neither one `known` nor one for each fibre.
pub fn fit(
    fibres: &[Fibre],
    known: &[Known],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Vec<Fit>, Cancelled> {
    assert!(known.len() == 1 || known.len() == fibres.len(), "one for all, or one for each");
    let stage = StageCounter::new(progress, "fitting", fibres.len());
    // 1. Where each starts, and how many elements its rods need.
    let jobs: Vec<(usize, usize, Job<'_>)> = (0..fibres.len())
        .into_par_iter()
        .map(|i| {
            let known = if known.len() == 1 { &known[0] } else { &known[i] };
            let job = Job::new(&fibres[i], known, options.noise, options.knots);
            (elements(&fibres[i], job.start()), i, job)
        })
        .collect();
    // 2. Those with as many elements together; the order of the fibres decides, so that the result does not depend on threads.
    let mut groups: BTreeMap<usize, Vec<(usize, Job<'_>)>> = BTreeMap::new();
    for (elements, i, job) in jobs {
        groups.entry(elements).or_default().push((i, job));
    }
    let mut chunks: Vec<(usize, Vec<(usize, Job<'_>)>)> = Vec::new();
    for (elements, mut group) in groups {
        let share = group.len().div_ceil(CHUNKS_PER_THREAD * rayon::current_num_threads());
        let size = share.max(SMALLEST_CHUNK);
        while !group.is_empty() {
            let rest = group.split_off(size.min(group.len()));
            chunks.push((elements, std::mem::replace(&mut group, rest)));
        }
    }
    let found: Result<Vec<Vec<(usize, Fit)>>, Cancelled> = chunks
        .into_par_iter()
        .map(|(elements, chunk)| {
            let (order, mut jobs): (Vec<usize>, Vec<Job<'_>>) = chunk.into_iter().unzip();
            run(&mut jobs, elements, options.knots, &stage)?;
            let fits = order.into_iter().zip(&jobs);
            Ok(fits.map(|(i, job)| (i, Fit::of(job, elements))).collect())
        })
        .collect();
    let mut found: Vec<(usize, Fit)> = found?.into_iter().flatten().collect();
    found.sort_by_key(|(i, _)| *i);
    Ok(found.into_iter().map(|(_, fit)| fit).collect())
}

impl Fit {
    fn of(job: &Job<'_>, elements: usize) -> Self {
        let Some(Minimum { at, converged }) = &job.best else {
            return Self::none(job, elements);
        };
        let layout = job.layout;
        let information = job.information(&at.unknowns, &at.beside.data);
        let Some(factor) = information.cholesky() else { return Self::none(job, elements) };
        let covariance = factor.inverse();
        let turned = at.unknowns.clone().with_positive_curvature();
        let sign = if at.unknowns.mean_strain().0 < 0.0 { -1.0 } else { 1.0 };
        let matrix = covariance_of_means(layout, &covariance, sign);
        let deviation = |unknown: usize| covariance.at(unknown, unknown).max(0.0).sqrt();
        let positive = |logarithm: f64, unknown: usize| {
            let value = logarithm.exp();
            Estimate { value, deviation: value * deviation(unknown) }
        };
        let mean = turned.mean_strain();
        let [radius, pitch] = helix(mean, &matrix);
        let profile = |(k, (u1, u3)): (usize, &(f64, f64))| {
            [(*u1, layout.curvature(k)), (*u3, layout.torsion(k))]
                .map(|(value, unknown)| Estimate { value, deviation: deviation(unknown) })
        };
        let states = 0..layout.states;
        let square = at.beside.data.square;
        let misfit = job.given_noise() && job.misfits(square);
        Self {
            status: match (*converged, misfit) {
                (false, _) => FitStatus::NotConverged,
                (true, true) => FitStatus::Misfit,
                (true, false) => FitStatus::Fitted,
            },
            curvature: Estimate { value: mean.0, deviation: matrix[0][0].max(0.0).sqrt() },
            torsion: Estimate { value: mean.1, deviation: matrix[1][1].max(0.0).sqrt() },
            curl_radius: radius,
            curl_pitch: pitch,
            stiffness_over_weight: states
                .clone()
                .map(|s| positive(turned.stiffness[s], layout.stiffness(s)))
                .collect(),
            torsion_ratio: positive(turned.ratio[0], layout.ratio(0)),
            torsion_ratio_by_state: states
                .clone()
                .map(|s| positive(turned.ratio[s], layout.ratio(s)))
                .collect(),
            axis_ratio: {
                let value = (0.5 * turned.section).exp();
                Estimate { value, deviation: 0.5 * value * deviation(layout.section()) }
            },
            length: states.map(|s| positive(turned.length[s], layout.length(s))).collect(),
            profile: match layout.knots {
                1 => Vec::new(),
                _ => turned.strain.iter().enumerate().map(profile).collect(),
            },
            covariance: matrix,
            blind: blind_directions(job, &turned, &covariance),
            noise: job.noise,
            reduced_square: square / job.degrees(),
            roots: roots(job, &turned),
            lines: at.beside.lines.clone(),
            elements,
            iterations: job.iterations,
        }
    }

    /// Of a fibre for which nothing was found.
    fn none(job: &Job<'_>, elements: usize) -> Self {
        let unknown = Estimate { value: f64::NAN, deviation: f64::INFINITY };
        Self {
            status: FitStatus::NotConverged,
            curvature: unknown,
            torsion: unknown,
            curl_radius: unknown,
            curl_pitch: unknown,
            stiffness_over_weight: vec![unknown; job.layout.states],
            torsion_ratio: unknown,
            torsion_ratio_by_state: vec![unknown; job.layout.states],
            axis_ratio: unknown,
            length: vec![unknown; job.layout.states],
            profile: match job.layout.knots {
                1 => Vec::new(),
                knots => vec![[unknown; 2]; knots],
            },
            covariance: [[f64::NAN; 4]; 4],
            blind: Vec::new(),
            noise: job.noise,
            reduced_square: f64::INFINITY,
            roots: Vec::new(),
            lines: Vec::new(),
            elements,
            iterations: job.iterations,
        }
    }
}

/// The covariance of the means of curvature, times `sign`, and torsion over the knots, and of the logarithms of EI/(ρSg) and GJ/EI in the first state.
fn covariance_of_means(layout: Layout, covariance: &Symmetric, sign: f64) -> [[f64; 4]; 4] {
    let mean = |first: usize, weight: f64| {
        let mut row = vec![0.0; layout.shared()];
        row[first..first + layout.knots].fill(weight / layout.knots as f64);
        row
    };
    let unit = |unknown: usize| {
        let mut row = vec![0.0; layout.shared()];
        row[unknown] = 1.0;
        row
    };
    let rows = [
        mean(layout.curvature(0), sign),
        mean(layout.torsion(0), 1.0),
        unit(layout.stiffness(0)),
        unit(layout.ratio(0)),
    ];
    let between = |a: &[f64], b: &[f64]| -> f64 {
        let row = |i: usize| -> f64 { (0..b.len()).map(|j| covariance.at(i, j) * b[j]).sum() };
        (0..a.len()).map(|i| a[i] * row(i)).sum()
    };
    [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| between(&rows[i], &rows[j])))
}

/// Radius and pitch (m) of the helix of a curvature and a torsion (rad/m), with deviations to first order.
fn helix((k, t): (f64, f64), covariance: &[[f64; 4]; 4]) -> [Estimate; 2] {
    let square = k * k + t * t;
    let of = |value: f64, by_k: f64, by_t: f64| {
        let variance = by_k * by_k * covariance[0][0]
            + 2.0 * by_k * by_t * covariance[0][1]
            + by_t * by_t * covariance[1][1];
        Estimate { value, deviation: variance.max(0.0).sqrt() }
    };
    if square == 0.0 {
        let none = Estimate { value: 0.0, deviation: f64::INFINITY };
        return [none; 2];
    }
    let (difference, product) = (t * t - k * k, 2.0 * k * t);
    let by = square.powi(-2);
    [
        of(k / square, difference * by, -product * by),
        of(TAU * t / square, -TAU * product * by, -TAU * difference * by),
    ]
}

/// The clamps in the axes of the poses.
fn roots(job: &Job<'_>, unknowns: &Unknowns) -> Vec<(DVec3, DMat3)> {
    let back = |((position, frame), observed): (&(DVec3, DMat3), &crate::observe::Observed)| {
        let turn = observed.turn.inverse();
        (turn * *position, DMat3::from_quat(turn) * *frame)
    };
    unknowns.roots.iter().zip(&job.observed).map(back).collect()
}

impl Job<'_> {
    /// What the points and what is known tell of the shared unknowns, with the roots eliminated.
    fn information(&self, unknowns: &Unknowns, data: &crate::observe::Normal) -> Symmetric {
        shared_information(self.layout, &self.with_priors(unknowns, data).matrix)
    }
}
