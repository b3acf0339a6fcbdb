//! Levenberg–Marquardt for many fibres at once: their rods are solved and differentiated together, in the lanes of SIMD vectors.

use frisure_progress::{Cancelled, StageCounter};
use frisure_rod::batch::{Batch, BatchSolution, BatchTangents, Direction};
use frisure_rod::{Rod, Stability};
use glam::DVec3;

use crate::dense::Symmetric;
use crate::known::{
    Estimate, Known, TORSION_RATIO_OF_STATES, USUAL_AXIS_RATIO, USUAL_STIFFNESS,
    USUAL_TORSION_RATIO, of_ellipse,
};
use crate::observe::{Normal, Observed, Rods, spacing};
use crate::pose::Fibre;
use crate::start::{Expected, noise_of, start};
use crate::unknowns::{Layout, OF_POSE, Unknowns, directions};

/// Relative gradient of rods at rest: derivatives need 1e-9.
const AT_REST: f64 = 5e-10;

/// Most steps of a rod side by side with others, and of one by itself. Rods near where they were need 4, and 97 of 100 at most 10: one that needs more keeps the
/// others of its lanes waiting.
const STEPS_SIDE_BY_SIDE: usize = 16;
const STEPS_ALONE: usize = 100;

/// Most steps of a fit from one start. A guard; 6 to 15 are usual.
const FIT_STEPS: usize = 120;

/// First damping, the least one, the factor by which it falls at most, and that at which a fit is given up. A first fall by more than Nielsen's third saves a step.
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-9;
const SHRINKAGE: f64 = 0.1;
const LARGEST_DAMPING: f64 = 1e7;

/// Square of a step, in standard deviations, at which a fit ends: a fiftieth of a deviation.
const SMALL: f64 = 4e-4;

/// Largest step, in the unit of [`Unknowns::scale`]. Chosen.
const LARGEST_STEP: f64 = 0.7;

/// Deviations of the square of the distance from its expectation above which a line does not fit, and another start is tried.
const MISFIT: f64 = 6.0;

/// Deviation that stands for a number that is known exactly, relative to the number or to the scale of its unknown.
const EXACT: f64 = 1e-7;

/// A fibre that is fitted.
pub(crate) struct Job<'a> {
    pub(crate) fibre: &'a Fibre,
    pub(crate) layout: Layout,
    pub(crate) priors: Vec<(usize, f64, f64)>,
    pub(crate) observed: Vec<Observed>,
    /// Standard deviation of a coordinate (m): given, or estimated so far.
    pub(crate) noise: f64,
    given_noise: bool,
    expected: Expected,
    /// The rank of the next start.
    next: usize,
    iterate: Iterate,
    pub(crate) best: Option<Minimum>,
    pub(crate) iterations: usize,
    done: bool,
    /// Whether the noise was estimated from a fit.
    polished: bool,
}

/// A place at which a fit has arrived, and where it tries to go.
struct Iterate {
    at: Option<Arrival>,
    trial: Unknowns,
    /// Turns of joints (rad) near which the rods of the first trial come to rest; empty for none.
    near: Vec<DVec3>,
    damping: f64,
    /// Factor by which the damping grows next, and the decrease that the last step promised.
    growth: f64,
    promised: f64,
    steps: usize,
}

impl Iterate {
    fn from(trial: Unknowns, near: Vec<DVec3>) -> Self {
        let (damping, growth) = (FIRST_DAMPING, 2.0);
        Self { at: None, trial, near, damping, growth, promised: 0.0, steps: 0 }
    }

    /// The damping after a step that lowered the square by `decrease`, or did not. Nielsen 1999, *Damping parameter in Marquardt's method*.
    fn adapt(&mut self, decrease: Option<f64>) {
        match decrease {
            Some(decrease) => {
                let gain = (decrease / self.promised).clamp(0.0, 1.0);
                let factor = (1.0 - (2.0 * gain - 1.0).powi(3)).max(SHRINKAGE);
                self.damping = (self.damping * factor).max(LEAST_DAMPING);
                self.growth = 2.0;
            }
            None => {
                self.damping = (self.damping * self.growth).max(FIRST_DAMPING);
                self.growth *= 2.0;
            }
        }
    }
}

/// Unknowns of a fibre whose rods are at rest, and the measured points beside them.
#[derive(Clone)]
pub(crate) struct Arrival {
    pub(crate) unknowns: Unknowns,
    /// The distance with what is known, and that of the points alone.
    normal: Normal,
    pub(crate) beside: Beside,
}

/// A minimum of the distance.
#[derive(Clone)]
pub(crate) struct Minimum {
    pub(crate) at: Arrival,
    pub(crate) converged: bool,
}

impl<'a> Job<'a> {
    pub(crate) fn new(fibre: &'a Fibre, known: &Known, noise: Option<f64>, knots: usize) -> Self {
        let layout = Layout::of(fibre, knots);
        let observed: Vec<Observed> =
            fibre.poses().iter().map(|p| Observed::new(p, fibre.length(p.state()))).collect();
        let guess = observed.iter().map(|o| noise_of(&o.points)).fold(0.0, f64::max);
        // Rounding of points that have no noise.
        let sigma = noise.unwrap_or(guess).max(1e-9);
        let priors = priors(fibre, layout, known);
        let at = |unknown: usize| {
            priors.iter().find(|prior| prior.0 == unknown).map_or(0.0, |prior| prior.1)
        };
        let states = 0..layout.states;
        let stiffness = states.clone().map(|state| at(layout.stiffness(state)).exp()).collect();
        let ratio = states.map(|state| at(layout.ratio(state)).exp()).collect();
        let axis_ratio = (0.5 * at(layout.section())).exp();
        let expected = Expected { stiffness, ratio, axis_ratio, knots, noise: sigma };
        let trial = start(fibre, &observed, &expected, 0).expect("a first start");
        let mut job = Self {
            fibre,
            layout,
            priors,
            observed,
            noise: sigma,
            given_noise: noise.is_some(),
            expected,
            next: 1,
            iterate: Iterate::from(trial.clone(), Vec::new()),
            best: None,
            iterations: 0,
            done: false,
            polished: false,
        };
        job.begin(trial, Vec::new());
        job
    }

    /// The numbers that the fit starts with.
    pub(crate) fn start(&self) -> &Unknowns {
        &self.iterate.trial
    }

    /// Whether the noise was given.
    pub(crate) fn given_noise(&self) -> bool {
        self.given_noise
    }

    /// How many numbers were measured.
    pub(crate) fn count(&self) -> usize {
        self.observed.iter().map(Observed::count).sum()
    }

    /// Measured numbers less those that they determine: all but the ones that are known exactly.
    pub(crate) fn degrees(&self) -> f64 {
        let exact = self.priors.iter().filter(|prior| prior.2 <= 2.0 * EXACT).count();
        (self.count() as f64 - (self.layout.len() - exact) as f64).max(1.0)
    }

    /// Whether a square of the distance is larger than noise makes it.
    pub(crate) fn misfits(&self, square: f64) -> bool {
        let degrees = self.degrees();
        square > degrees + MISFIT * (2.0 * degrees).sqrt()
    }

    fn begin(&mut self, trial: Unknowns, near: Vec<DVec3>) {
        for observed in self.observed.iter_mut().filter(|observed| !observed.placed) {
            observed.fractions = by_chords(&observed.points);
        }
        self.iterate = Iterate::from(trial, near);
    }

    /// The rods of some unknowns; `None`, if they make none.
    fn rods(&self, unknowns: &Unknowns) -> Option<Vec<Rod>> {
        let poses = self.fibre.poses().iter().enumerate();
        poses.map(|(i, pose)| unknowns.rod(pose, i)).collect()
    }

    /// The sums of all points, and of what is known.
    pub(crate) fn with_priors(&self, unknowns: &Unknowns, data: &Normal) -> Normal {
        let mut normal = data.clone();
        for &(unknown, value, deviation) in &self.priors {
            normal.add_prior(unknown, unknowns.value(self.layout, unknown) - value, deviation);
        }
        for unknown in 0..self.layout.len() {
            // A wide prior about the present value: what nothing tells stays. A uniform angle deviates by π/√3.
            let scale = 1.8 * unknowns.scale(self.layout, unknown);
            let scale = if self.is_turn(unknown) { scale } else { 1e3 * scale };
            normal.matrix.add_diagonal(unknown, scale.powi(-2));
        }
        normal
    }

    fn is_turn(&self, unknown: usize) -> bool {
        let shared = self.layout.shared();
        unknown >= shared && (unknown - shared) % OF_POSE >= 3
    }

    /// After the trial was computed: `None`, if it makes no rod at rest.
    fn decide(&mut self, found: Option<Beside>) {
        self.iterations += 1;
        self.iterate.steps += 1;
        let before = self.iterate.at.as_ref().map(|at| at.normal.square);
        let trial = &self.iterate.trial;
        let normal = found.as_ref().map(|beside| self.with_priors(trial, &beside.data));
        let square = normal.as_ref().map_or(f64::INFINITY, |normal| normal.square);
        let lower = square < before.unwrap_or(f64::INFINITY);
        match (lower, before) {
            (true, Some(before)) => self.iterate.adapt(Some(before - square)),
            (true, None) => {}
            (false, _) => self.iterate.adapt(None),
        }
        if let Some((normal, beside)) = normal.zip(found).filter(|_| lower) {
            let unknowns = self.iterate.trial.clone();
            self.iterate.at = Some(Arrival { unknowns, normal, beside });
        }
        let Some(Arrival { unknowns: at, normal, .. }) = &self.iterate.at else {
            self.finish(false);
            return;
        };
        let mut damped = normal.matrix.clone();
        for i in 0..damped.len() {
            damped.add_diagonal(i, self.iterate.damping * normal.matrix.at(i, i));
        }
        let Some(factor) = damped.cholesky() else {
            self.finish(false);
            return;
        };
        let mut step = factor.solve(&normal.gradient);
        step.iter_mut().for_each(|x| *x = -*x);
        let size = normal.matrix.square(&step);
        if size < SMALL && (lower || self.iterate.damping > 1.0) {
            self.finish(true);
            return;
        }
        if self.iterate.steps > FIT_STEPS || self.iterate.damping > LARGEST_DAMPING {
            self.finish(false);
            return;
        }
        let layout = self.layout;
        let largest = step.iter().enumerate();
        let largest = largest.map(|(i, x)| x.abs() / at.scale(layout, i)).fold(0.0, f64::max);
        if largest > LARGEST_STEP {
            step.iter_mut().for_each(|x| *x *= LARGEST_STEP / largest);
        }
        let slope: f64 = step.iter().zip(&normal.gradient).map(|(x, g)| x * g).sum();
        self.iterate.promised = -2.0 * slope - normal.matrix.square(&step);
        self.iterate.trial = at.stepped(layout, &step);
    }

    /// The end of the fit from one start.
    fn finish(&mut self, converged: bool) {
        if let Some(at) = self.iterate.at.take() {
            let square = at.normal.square;
            if self.best.as_ref().is_none_or(|best| square < best.at.normal.square || self.polished)
            {
                self.best = Some(Minimum { at, converged });
            }
        }
        let misfits = self.best.as_ref().is_none_or(|best| self.misfits(best.at.normal.square));
        if misfits
            && !self.polished
            && let Some(start) = start(self.fibre, &self.observed, &self.expected, self.next)
        {
            self.next += 1;
            self.begin(start, Vec::new());
            return;
        }
        let degrees = self.degrees();
        if !self.given_noise
            && !self.polished
            && let Some(Minimum { at, .. }) = &mut self.best
        {
            // What is left over is the noise: once more with it, since it weighs what is known.
            self.polished = true;
            let factor = (at.normal.square / degrees).sqrt().max(1e-6);
            let noise = (self.noise * factor).max(1e-12);
            at.beside.data.scale((self.noise / noise).powi(2));
            self.noise = noise;
            let (unknowns, beside) = (at.unknowns.clone(), at.beside.clone());
            self.begin(unknowns, beside.controls);
            self.observed = beside.observed;
            return;
        }
        self.done = true;
    }
}

/// What is known of the unknowns: which, its value and its deviation.
fn priors(fibre: &Fibre, layout: Layout, known: &Known) -> Vec<(usize, f64, f64)> {
    let mut priors = Vec::new();
    let logarithm = |known: Option<Estimate>, usual: Estimate| match known {
        Some(known) => (known.value.ln(), known.relative_deviation().max(EXACT)),
        None => (usual.value.ln(), usual.deviation),
    };
    for state in 0..layout.states {
        let of_state = known.stiffness_over_weight.filter(|_| state == 0);
        let (value, deviation) = logarithm(of_state, USUAL_STIFFNESS);
        priors.push((layout.stiffness(state), value, deviation));
        if let Some(length) = fibre.length(state) {
            priors.push((layout.length(state), length.ln(), EXACT));
        }
    }
    let (axis_ratio, deviation) = logarithm(known.axis_ratio, USUAL_AXIS_RATIO);
    priors.push((layout.section(), 2.0 * axis_ratio, 2.0 * deviation));
    let usual = USUAL_TORSION_RATIO.value * of_ellipse(axis_ratio.exp());
    for state in 0..layout.states {
        let of_state = known.torsion_ratio.filter(|_| state == 0);
        let deviation = match state {
            0 => USUAL_TORSION_RATIO.deviation,
            _ => TORSION_RATIO_OF_STATES,
        };
        let (value, deviation) = logarithm(of_state, Estimate { value: usual, deviation });
        priors.push((layout.ratio(state), value, deviation));
    }
    // What is known of the mean over the knots is known of each, with a deviation that makes it so.
    let spread = (layout.knots as f64).sqrt();
    for knot in 0..layout.knots {
        for (unknown, known) in
            [(layout.curvature(knot), known.curvature), (layout.torsion(knot), known.torsion)]
        {
            if let Some(Estimate { value, deviation }) = known {
                let deviation = (deviation * spread).max(EXACT * value.abs().max(1.0));
                priors.push((unknown, value, deviation));
            }
        }
    }
    priors
}

/// The fraction of the length at each point, by the chords.
fn by_chords(points: &[DVec3]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut fractions = vec![0.0];
    for pair in points.windows(2) {
        sum += pair[0].distance(pair[1]);
        fractions.push(sum);
    }
    fractions.iter().map(|s| s / sum).collect()
}

/// Fibres that are fitted side by side. The next one takes the place of one that is done, so that lanes stay full where a few fibres take far more steps than
/// others. Chosen by trial.
const SIDE_BY_SIDE: usize = 64;

/// Fibres whose rods are differentiated at once: their motions stay in the cache of a processor. Chosen by trial.
const AT_ONCE: usize = 16;

/// Fits fibres whose rods have the same number of elements. `stage` counts those that are done.
pub(crate) fn run(
    jobs: &mut [Job<'_>],
    elements: usize,
    knots: usize,
    stage: &StageCounter<'_>,
) -> Result<(), Cancelled> {
    let solver = Solver::new(elements, knots);
    let mut running: Vec<usize> = Vec::new();
    let mut waiting = 0..jobs.len();
    loop {
        stage.check()?;
        running.retain(|&index| {
            let done = jobs[index].done;
            if done {
                stage.advance();
            }
            !done
        });
        let free = SIDE_BY_SIDE - running.len();
        running.extend(waiting.by_ref().take(free));
        if running.is_empty() {
            return Ok(());
        }
        for (&index, found) in running.iter().zip(solver.evaluate(jobs, &running)) {
            jobs[index].decide(found);
        }
    }
}

/// The points of a fibre beside its rods at rest.
#[derive(Clone)]
pub(crate) struct Beside {
    /// The distance of the points alone.
    pub(crate) data: Normal,
    /// Turns of the joints of all rods (rad).
    controls: Vec<DVec3>,
    pub(crate) observed: Vec<Observed>,
    /// The points on the rods (m), in the axes of each pose.
    pub(crate) lines: Vec<Vec<DVec3>>,
}

/// Rods of one number of elements, and the directions in which they are differentiated.
struct Solver {
    batch: Batch,
    directions: Vec<Direction>,
}

impl Solver {
    fn new(elements: usize, knots: usize) -> Self {
        let batch = Batch {
            elements,
            tolerance: AT_REST,
            max_iterations: STEPS_SIDE_BY_SIDE,
            ..Batch::default()
        };
        Self { batch, directions: directions(knots, elements) }
    }

    /// Solves the rods of the trials of some jobs side by side, and adds up the points of each; `None`, if a trial makes no rods at rest.
    fn evaluate(&self, jobs: &[Job<'_>], running: &[usize]) -> Vec<Option<Beside>> {
        let elements = self.batch.elements;
        let (mut rods, mut controls, mut ranges) = (Vec::new(), Vec::new(), Vec::new());
        let mut fresh = Vec::new();
        for &index in running {
            let Iterate { at, trial, near, .. } = &jobs[index].iterate;
            let near = at.as_ref().map_or(near, |at| &at.beside.controls);
            let first = rods.len();
            for (pose, rod) in jobs[index].rods(trial).into_iter().flatten().enumerate() {
                match near.get(pose * elements..(pose + 1) * elements) {
                    Some(near) => controls.extend_from_slice(near),
                    None => {
                        fresh.push(rods.len());
                        controls.resize(controls.len() + elements, DVec3::ZERO);
                    }
                }
                rods.push(rod);
            }
            ranges.push(first..rods.len());
        }
        let mut found = self.batch.solve_near(&rods, controls);
        self.bring_to_rest(&rods, &fresh, &mut found);
        let mut beside = Vec::with_capacity(running.len());
        for (running, ranges) in running.chunks(AT_ONCE).zip(ranges.chunks(AT_ONCE)) {
            let all = ranges[0].start..ranges[ranges.len() - 1].end;
            let part = BatchSolution {
                elements,
                controls: found.controls[all.start * elements..all.end * elements].to_vec(),
                rods: found.rods[all.clone()].to_vec(),
            };
            let tangents = self.batch.jvp(&rods[all.clone()], &part, &self.directions);
            beside.extend(running.iter().zip(ranges).map(|(&index, range)| {
                let of_part = range.start - all.start..range.end - all.start;
                let exist = tangents.existence[of_part.clone()].iter().all(Result::is_ok);
                let controls = &part.controls[of_part.start * elements..of_part.end * elements];
                (exist && !range.is_empty())
                    .then(|| self.compare(&jobs[index], of_part.start, &tangents, controls))
            }));
        }
        beside
    }

    /// The points of a job beside the rods of its trial, the first of which has the index `first`.
    fn compare(
        &self,
        job: &Job<'_>,
        first: usize,
        tangents: &BatchTangents,
        controls: &[DVec3],
    ) -> Beside {
        let rods = Rods { tangents, first, layout: job.layout, noise: job.noise };
        let before = job.iterate.at.as_ref().map_or(&job.observed, |at| &at.beside.observed);
        let mut observed = before.clone();
        let mut data = Normal::zero(job.layout.len());
        let mut lines = Vec::new();
        for (p, pose) in job.fibre.poses().iter().enumerate() {
            let spacing = spacing(&job.iterate.trial, pose, self.batch.elements);
            rods.place(p, spacing, &mut observed[p]);
            rods.add(p, pose.state(), spacing, &observed[p], &mut data);
            let back = observed[p].turn.inverse();
            let line = rods.line(p, spacing, &observed[p]);
            lines.push(line.into_iter().map(|x| back * x).collect());
        }
        Beside { data, controls: controls.to_vec(), observed, lines }
    }

    /// Brings rods to rest that started at their natural shapes and did not come to rest, along gravity's branch. A rod that was near another one is left:
    /// the step of its fibre was too long, and a shorter one costs less.
    fn bring_to_rest(&self, rods: &[Rod], fresh: &[usize], found: &mut BatchSolution) {
        let n = self.batch.elements;
        let lost = fresh.iter().copied();
        let lost = lost.filter(|&rod| found.rods[rod].stability == Stability::NotConverged);
        let alone = Batch { max_iterations: STEPS_ALONE, ..self.batch };
        for rod in lost.collect::<Vec<_>>() {
            let along = alone.solve(&rods[rod..=rod]);
            found.rods[rod] = along.rods[0];
            found.controls[rod * n..(rod + 1) * n].copy_from_slice(&along.controls);
        }
    }
}

impl Unknowns {
    /// The value of one that something may be known of: strain, stiffness, ratio, section or length.
    fn value(&self, layout: Layout, unknown: usize) -> f64 {
        if unknown < layout.torsion(0) {
            self.strain[unknown].0
        } else if unknown < layout.stiffness(0) {
            self.strain[unknown - layout.torsion(0)].1
        } else if unknown < layout.ratio(0) {
            self.stiffness[unknown - layout.stiffness(0)]
        } else if unknown < layout.section() {
            self.ratio[unknown - layout.ratio(0)]
        } else if unknown == layout.section() {
            self.section
        } else {
            self.length[unknown - layout.length(0)]
        }
    }
}

/// What the points alone tell of the unknowns that all poses share, with the roots of the poses eliminated.
pub(crate) fn shared_information(layout: Layout, data: &Symmetric) -> Symmetric {
    let shared: Vec<usize> = (0..layout.shared()).collect();
    let roots: Vec<usize> = (layout.shared()..layout.len()).collect();
    let mut information = data.part(&shared);
    let mut of_roots = data.part(&roots);
    for i in 0..of_roots.len() {
        // The turn of a straight fibre about itself is told by nothing.
        of_roots.add_diagonal(i, 1e-12 * of_roots.at(i, i).max(1e-300));
    }
    let Some(factor) = of_roots.cholesky() else { return information };
    let columns: Vec<Vec<f64>> = shared
        .iter()
        .map(|&i| factor.solve(&roots.iter().map(|&r| data.at(r, i)).collect::<Vec<_>>()))
        .collect();
    for (a, column) in columns.iter().enumerate() {
        for &b in &shared[..=a] {
            let taken: f64 = roots.iter().zip(column).map(|(&r, x)| data.at(r, b) * x).sum();
            information.set(a, b, information.at(a, b) - taken);
        }
    }
    information
}
