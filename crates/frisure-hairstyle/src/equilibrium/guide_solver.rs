//! Each guide by itself, on the body and on the bed of hair.

use frisure_rod::potential::{FieldPotential, Potential, Yielding};
use frisure_rod::{
    AccuracyStatus, Branch, Equilibrium, Options, Resolution, equilibrium, equilibrium_from,
};

use super::fields::{
    MAX_ITERATIONS, MOST_ELEMENTS, MOST_EXTRAPOLATED, along, body, body_samples, depth, layer,
    options,
};
use super::friction_solver::{FrictionalRod, Hold, Rested};
use super::letting_down::let_down;
use super::letting_go::LETTING_GO;
use super::lock::{self, LockStart};
use super::start::{Change, GuideStart};
use crate::contact::Pull;
use crate::guides::Guide;
use crate::head::Head;
use crate::parallel;
use crate::spec::{Body, HairContact, HairstyleSpec};
use frisure_progress::{Cancelled, Progress, StageCounter};

/// Stiffnesses of the body, as fractions of its own: the first while gravity is turned on.
/// docs/theory.md, "Contact with the body".
const HARDNESS: [f64; 3] = [0.0016, 0.04, 1.0];

/// Depth (m) in the body beyond which another way out is sought. docs/theory.md, "Contact with the body".
const DEEPEST: f64 = 3e-4;

/// The same (m) for a guide that is held at a point: drawn tight over an ear it presses harder, and what fell anew would not
/// come there. Chosen: less than the hair on the skin is thick.
const DEEPEST_HELD: f64 = 2e-3;

/// Shapes that are tried for a guide that is still deeper. Chosen by trial; not measured further.
const STARTS: u32 = 8;

/// Relative gradient at which a guide is at rest after a warm start, which has to follow a slider. Chosen; a thousand times
/// that of a cold start.
const WARM_TOLERANCE: f64 = 1e-5;

/// What every guide comes to rest with.
pub(super) struct GuideOptions<'a> {
    /// Where guides start from.
    pub(super) start: GuideStart<'a>,
    /// How the hairs of each wisp begin.
    pub(super) locks: &'a [LockStart],
    /// Most iterations of each.
    pub(super) iterations: usize,
    /// Whether a guide that lay among wisps stays as it lay: it comes to rest with them.
    pub(super) held_by_wisps: bool,
}

/// Brings every guide to rest by itself, in at most `iterations` iterations from where it rested before. With
/// fewer than [`MAX_ITERATIONS`] a changed guide that was not put into another shape comes nearer to rest.
///
/// # Errors
/// [`Cancelled`], if the work is cancelled.
pub(super) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    GuideOptions { start, locks, iterations, held_by_wisps }: GuideOptions<'_>,
    progress: &dyn Progress,
) -> Result<Vec<Rested>, Cancelled> {
    let stage = StageCounter::new(progress, "settling guides", guides.len());
    let rest = |index: usize| {
        stage.check()?;
        let (guide, lock) = (&guides[index], &locks[index]);
        let rest = match start {
            GuideStart::Natural => Rested::free(settle_one(spec, head, guide)),
            GuideStart::At(before) => {
                let free = &LockStart::Free;
                settle_one_from(spec, head, guide, &before[index], free, iterations, Hold::Free)
            }
            GuideStart::Like(before) => {
                let hold = Hold::ByFriction;
                settle_one_from(spec, head, guide, &before[index], lock, iterations, hold)
            }
            GuideStart::Changed { before, changes }
                if held_by_wisps && changes[index].leaves_it_lying(guide) =>
            {
                let rest = in_shape_of(spec, guide, &before[index]);
                let lock = lock::started(spec, head, guide, &rest, lock);
                Rested { lock, ..Rested::free(rest) }
            }
            GuideStart::Changed { before, changes } => {
                let (before, change) = (&before[index], changes[index]);
                settle_changed(spec, head, guide, before, lock, change, iterations)
            }
        };
        stage.advance();
        Ok(rest)
    };
    parallel::try_map(guides.len(), rest)
}

/// Brings a guide to rest after something was done to it.
fn settle_changed(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    before: &Equilibrium,
    lock: &LockStart,
    change: Change,
    iterations: usize,
) -> Rested {
    match change {
        Change::None => {
            let lock = lock::started(spec, head, guide, before, lock);
            Rested { lock, ..Rested::free(before.clone()) }
        }
        Change::Moulded => Rested::free(settle_one(spec, head, guide)),
        Change::Handled => handled(spec, head, guide, before, lock),
        _ if iterations < MAX_ITERATIONS => {
            settle_one_from(spec, head, guide, before, lock, iterations, Hold::ByFriction)
        }
        _ => resettle_one(spec, head, guide, before, lock, &pulls(guide, change)),
    }
}

/// The lower of two rests: what lay looped over an ear does not stay so when it is cut.
fn handled(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    before: &Equilibrium,
    lock: &LockStart,
) -> Rested {
    // Two minima of the same energy: downhill from where it lay, and along gravity's branch from its root. A hand that lifts
    // hair frees it of friction: what falls has none. What holds the hair goes on holding it.
    let lying = resettle_one(spec, head, guide, before, lock, &pulls(guide, Change::StillHeld));
    let fallen = settle_one(spec, head, guide);
    let lower = fallen.energy.total() < lying.rest.energy.total();
    if lower && depth(head, &fallen) <= DEEPEST { Rested::free(fallen) } else { lying }
}

/// How hard a comb or a clip pulls, in steps: it does not tear hair through the head …
/// Chosen by trial; not measured further.
const PULLS: [f64; 4] = [0.01, 0.05, 0.25, 1.0];

/// How far a clip has come from one place to another in steps. Chosen: hair follows it around the head.
const MOVING: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];

/// What pulls at a changed guide, in steps, each from the shape of the one before. docs/theory.md, "Styling"
fn pulls(guide: &Guide, change: Change) -> Vec<Option<Pull>> {
    match (guide.pull, change) {
        (Some(pull), Change::HeldElsewhere(from)) => {
            MOVING.iter().map(|&share| Some(from.moved(pull, share))).collect()
        }
        (Some(pull), Change::StillHeld) => vec![Some(pull)],
        (Some(pull), _) => PULLS.iter().map(|&share| Some(pull.scaled(share))).collect(),
        (None, Change::LetGo(gone)) => {
            let going = LETTING_GO.iter().map(|&share| Some(gone.scaled(share)));
            going.chain([None]).collect()
        }
        (None, _) => vec![None],
    }
}

/// Brings a guide to rest from where it lay while `pulls` act one after the other, held by friction if there is any.
fn resettle_one(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    before: &Equilibrium,
    lock: &LockStart,
    pulls: &[Option<Pull>],
) -> Rested {
    // 1. Without a body and without a pull the rod's own search needs no steps.
    let alone = pulls.iter().all(Option::is_none);
    let slides = guide.friction.lock == 0.0 || matches!(lock, LockStart::Free);
    if spec.contact.body == Body::None && alone && slides {
        return Rested::free(equilibrium_from(&guide.rod, &[], &options(spec), before));
    }
    let (elements, accuracy) = division(spec, guide);
    let options = Options { resolution: Resolution::Elements(elements), ..options(spec) };
    let surface = body(spec, head, guide, layer(spec, guide));
    let body = along(&surface, guide, elements);
    // 2. The pulls, each from the shape of the one before; what slips inside the wisp follows each.
    let mut lock = match slides {
        true => None,
        false => lock::started(spec, head, guide, &lying_as(guide, before, options), lock),
    };
    let mut rested = if surface.friction.is_zero() {
        let mut rest = before.clone();
        for pull in pulls {
            let pull = pull.as_ref().map(|pull| along(pull, guide, elements));
            rest = equilibrium_from(&guide.rod, &all(&body, &pull, &lock), &options, &rest);
            lock::follow(&mut lock, &rest);
        }
        Rested::free(rest)
    } else {
        let samples = body_samples(guide, elements);
        let mut rubbing = FrictionalRod::new(&guide.rod, &surface, samples, options, before);
        for pull in pulls {
            let pull = pull.as_ref().map(|pull| along(pull, guide, elements));
            rubbing.step(&all(&body, &pull, &lock));
            lock::follow(&mut lock, rubbing.rest());
        }
        rubbing.finish()
    };
    rested.lock = lock;
    rested.rest.certificate.accuracy = accuracy;
    // 3. It may have been pushed into the body, or have been there when it was held: then it comes down
    // from its root again.
    let deep = depth(head, &rested.rest);
    let held = matches!(guide.pull, Some(Pull::Clip { .. }));
    if deep <= if held { DEEPEST_HELD } else { DEEPEST } {
        return rested;
    }
    let fallen = settle_one(spec, head, guide);
    if depth(head, &fallen) < deep { Rested::free(fallen) } else { rested }
}

/// All that a guide feels but its weight and friction.
fn all<'a>(
    body: &'a dyn Potential,
    pull: &'a Option<FieldPotential<'_, Pull>>,
    lock: &'a Option<Yielding>,
) -> Vec<&'a dyn Potential> {
    let mut felt = vec![body];
    felt.extend(pull.iter().map(|pull| pull as &dyn Potential));
    felt.extend(lock::felt(lock.as_ref()));
    felt
}

/// Brings a guide nearer to rest from where it lay, in at most `iterations` iterations for each set of normal forces.
fn settle_one_from(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    before: &Equilibrium,
    lock: &LockStart,
    iterations: usize,
    hold: Hold,
) -> Rested {
    let elements = elements_like(spec, before);
    let options = Options {
        resolution: Resolution::Elements(elements),
        max_iterations: iterations,
        tolerance: WARM_TOLERANCE,
        // It is near rest, and iterations are few.
        longest_step: f64::INFINITY,
        ..options(spec)
    };
    let slides = guide.friction.lock == 0.0 || matches!(lock, LockStart::Free);
    if spec.contact.body == Body::None && guide.pull.is_none() && slides {
        return Rested::free(equilibrium_from(&guide.rod, &[], &options, before));
    }
    let surface = body(spec, head, guide, layer(spec, guide));
    let body = along(&surface, guide, elements);
    let pull = guide.pull.as_ref().map(|pull| along(pull, guide, elements));
    let mut lock = match slides {
        true => None,
        false => lock::started(spec, head, guide, &lying_as(guide, before, options), lock),
    };
    let felt = all(&body, &pull, &lock);
    let mut rested = if hold == Hold::Free || surface.friction.is_zero() {
        Rested::free(equilibrium_from(&guide.rod, &felt, &options, before))
    } else {
        let samples = body_samples(guide, elements);
        let mut rubbing = FrictionalRod::new(&guide.rod, &surface, samples, options, before);
        rubbing.step(&felt);
        rubbing.finish()
    };
    lock::follow(&mut lock, &rested.rest);
    rested.lock = lock;
    rested.rest.certificate.accuracy = before.certificate.accuracy;
    // It may have been pushed into the body: then it comes down from its root again. One that lay deep before stays.
    let deep = depth(head, &rested.rest);
    if deep > DEEPEST && deep > depth(head, before) + DEEPEST {
        return Rested::free(settle_one(spec, head, guide));
    }
    rested
}

/// Guides in the shapes of those before them.
pub(super) fn in_shapes_of(
    spec: &HairstyleSpec,
    guides: &[Guide],
    before: &[Equilibrium],
) -> Vec<Equilibrium> {
    parallel::map(guides.len(), |i| in_shape_of(spec, &guides[i], &before[i]))
}

/// A guide in the shape of the one before it.
fn in_shape_of(spec: &HairstyleSpec, guide: &Guide, before: &Equilibrium) -> Equilibrium {
    let resolution = Resolution::Elements(elements_like(spec, before));
    let mut transferred = lying_as(guide, before, Options { resolution, ..options(spec) });
    transferred.certificate.iterations = 0;
    transferred.certificate.accuracy = before.certificate.accuracy;
    transferred
}

/// A guide in the shape of the one before it, with the division of the options.
fn lying_as(guide: &Guide, before: &Equilibrium, options: Options) -> Equilibrium {
    // No iteration: the shape is transferred by its frames and stays as it is. docs/theory.md, "Warm starts"
    let still = Options { max_iterations: 0, tolerance: 0.0, ..options };
    equilibrium_from(&guide.rod, &[], &still, before)
}

/// The division of a guide: that of the one before it, if the description gives an accuracy.
fn elements_like(spec: &HairstyleSpec, before: &Equilibrium) -> usize {
    match spec.equilibrium.resolution {
        Resolution::Elements(n) => n,
        Resolution::Accuracy(_) => before.elements,
    }
}

fn settle_one(spec: &HairstyleSpec, head: &Head, guide: &Guide) -> Equilibrium {
    let options = options(spec);
    let alone = spec.contact.body == Body::None && guide.pull.is_none();
    if alone && !matches!(spec.contact.hair, HairContact::Wisps | HairContact::Density) {
        return equilibrium(&guide.rod, &[], &options);
    }
    let (elements, accuracy) = division(spec, guide);
    let options = Options { resolution: Resolution::Elements(elements), ..options };
    let mut rest = match alone {
        true => equilibrium(&guide.rod, &[], &options),
        false => settle_on_body(spec, head, guide, &options),
    };
    rest.certificate.accuracy = accuracy;
    rest
}

/// Brings a guide to rest on the body, with the number of elements of the options.
fn settle_on_body(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    options: &Options,
) -> Equilibrium {
    let hard = &HARDNESS[HARDNESS.len() - 1..];
    let far = Options { longest_step: f64::INFINITY, ..*options };
    let lowest = Options { branch: Branch::Lowest { starts: STARTS, seed: spec.seed }, ..far };
    let harden = |options, hardness| harden(spec, head, guide, options, hardness);
    let ways: [&dyn Fn() -> Equilibrium; 5] = [
        // 1. On a soft body the branch of gravity is followed in a fifth of the iterations; from one
        // hardness to the next the answer is near.
        &|| harden(options, &HARDNESS),
        // 2. But hair can sink into a soft ear and stay there: on the hard body from the start.
        &|| harden(options, hard),
        // 3. Short steps follow the way down, also where it ends in the body: long ones go past it.
        &|| harden(&far, hard),
        // 4. Its natural shape is in the body: of several random starts the one that is not in it has the least energy.
        &|| harden(&lowest, hard),
        // 5. It grows against an ear, where all of these begin: held off the head and let down on it.
        &|| let_down(spec, head, guide, options),
    ];
    // Spheres have no ears, and no other shape lies less deep in a body that is not there.
    let count = if spec.contact.body == Body::SignedDistance { ways.len() } else { ways.len() - 1 };
    let mut best: Option<(f64, Equilibrium)> = None;
    for way in &ways[..count] {
        let rest = way();
        let deep = depth(head, &rest);
        if deep <= DEEPEST {
            return rest;
        }
        if best.as_ref().is_none_or(|(least, _)| deep < *least) {
            best = Some((deep, rest));
        }
    }
    best.expect("there are ways").1
}

/// The division of a guide, and whether it meets a requested accuracy. Extrapolation needs a smooth answer, and
/// contact comes and goes: the division by itself is as accurate as that without contact.
fn division(spec: &HairstyleSpec, guide: &Guide) -> (usize, AccuracyStatus) {
    let accuracy = match spec.equilibrium.resolution {
        Resolution::Elements(n) => return (n, AccuracyStatus::NotRequested),
        Resolution::Accuracy(accuracy) => accuracy,
    };
    let first = spec.equilibrium.element.resolving_elements(&guide.rod);
    // 1. An accuracy by extrapolation takes at least two doublings of the first division. Where these are too many,
    // one division and one doubling tell the error of the division.
    let options = match 4 * first > MOST_EXTRAPOLATED {
        false => options(spec),
        true => Options {
            resolution: Resolution::Elements((2 * first).min(MOST_ELEMENTS)),
            estimate_error: true,
            ..options(spec)
        },
    };
    let alone = equilibrium(&guide.rod, &[], &options);
    if alone.certificate.accuracy == AccuracyStatus::Missed {
        return (alone.elements, AccuracyStatus::Missed);
    }
    // 2. What is not extrapolated takes more elements than what is.
    match alone.division_error().map(|error| divided_for(accuracy, alone.elements, error)) {
        Some(elements) if elements <= MOST_ELEMENTS => (elements, AccuracyStatus::Met),
        _ => (MOST_ELEMENTS, AccuracyStatus::Missed),
    }
}

/// Order at which the error of a division decreases with the length of its elements: the second, read cautiously as a third
/// for each doubling in place of a quarter.
const CAUTIOUS_ORDER: f64 = 1.585;

/// Elements with which an error (m) is within an accuracy (m), from the error with fewer.
fn divided_for(accuracy: f64, elements: usize, error: f64) -> usize {
    let times = (error / accuracy).max(1.0).powf(1.0 / CAUTIOUS_ORDER);
    (elements as f64 * times).ceil() as usize
}

/// Settles a guide on ever harder bodies, each from the shape on the one before.
fn harden(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    options: &Options,
    hardness: &[f64],
) -> Equilibrium {
    let Resolution::Elements(elements) = options.resolution else {
        unreachable!("the division is fixed before")
    };
    let layer = layer(spec, guide);
    let settle = |hardness: f64, previous: Option<&Equilibrium>| {
        let mut body = body(spec, head, guide, layer);
        // Skin alone is softened; hair over it is soft already.
        body.skin *= hardness;
        let body = along(&body, guide, elements);
        let pull = guide.pull.as_ref().map(|pull| along(pull, guide, elements));
        let mut felt: Vec<&dyn Potential> = vec![&body];
        felt.extend(pull.iter().map(|pull| pull as &dyn Potential));
        match previous {
            None => equilibrium(&guide.rod, &felt, options),
            Some(previous) => equilibrium_from(&guide.rod, &felt, options, previous),
        }
    };
    hardness[1..].iter().fold(settle(hardness[0], None), |softer, &hardness| {
        let mut next = settle(hardness, Some(&softer));
        next.certificate.iterations += softer.certificate.iterations;
        next
    })
}
