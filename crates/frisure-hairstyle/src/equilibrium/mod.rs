//! Guides coming to rest: each alone on the body, then all together among each other.

mod fields;
mod friction_solver;
mod guide_solver;
mod head_solver;
mod joint;
mod letting_down;
mod letting_go;
mod lock;
mod report;
mod start;
mod tether;
mod wisp;

pub use fields::MOST_ELEMENTS;
pub(crate) use fields::{combed_hold, held_up, holding};
pub use friction_solver::FrictionalRod;
pub use joint::{HeadChange, HeadDerivativeError, HeadGradient, HeadSensitivity};
pub(crate) use lock::LockStart;
pub use report::{SettlingReport, settling_report};
pub(crate) use start::{Change, GuideStart};

use self::friction_solver::{Hold, Rested};
use self::guide_solver::GuideOptions;
use self::head_solver::SweepOptions;
use self::joint::JointOptions;
use crate::guides::Guide;
use crate::hairstyle::Rest;
use crate::head::Head;
use crate::parallel;
use crate::spec::{HairContact, HairstyleSpec, HeadMethod};
use frisure_progress::{Cancelled, Progress};
use frisure_rod::potential::Yielding;

/// How much work is done at most; what does not fit is left for the next call, which starts warm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Most iterations of each guide on its own.
    pub iterations: usize,
    /// Most sweeps over all guides in which wisps make way for each other.
    pub sweeps: usize,
}

impl Effort {
    /// Until everything is at rest.
    pub const FULL: Self =
        Self { iterations: fields::MAX_ITERATIONS, sweeps: head_solver::MOST_STEPS };

    /// Guides stay in the shapes that they start from; without any they come to rest alone.
    pub const NONE: Self = Self { iterations: 0, sweeps: 0 };
}

impl Default for Effort {
    fn default() -> Self {
        Self::FULL
    }
}

/// How [`settle`] works.
pub(crate) struct SettleOptions<'a> {
    /// Where guides start from.
    pub(crate) start: GuideStart<'a>,
    /// How much work is done at most.
    pub(crate) effort: Effort,
    /// How the hairs inside each wisp begin; as they lie if it is empty.
    pub(crate) locks: Vec<LockStart>,
}

/// Brings every guide to rest: first each alone on the body, then, if wisps repel each other, all together.
///
/// # Errors
/// [`Cancelled`], if the progress says so.
pub(crate) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    SettleOptions { start, effort, mut locks }: SettleOptions<'_>,
    progress: &dyn Progress,
) -> Result<Rest, Cancelled> {
    locks.resize(guides.len(), LockStart::Anew);
    let together = spec.contact.hair == HairContact::Density;
    let wisps_repel = spec.contact.hair == HairContact::Wisps || together;
    let hold = match start {
        GuideStart::At(_) => Hold::Free,
        GuideStart::Natural | GuideStart::Like(_) | GuideStart::Changed { .. } => Hold::ByFriction,
    };
    let warm = matches!(start, GuideStart::At(_) | GuideStart::Like(_));
    let full = effort == Effort::FULL;
    let gone = letting_go::among_wisps(spec, guides, start).filter(|_| full);
    let among = gone.is_some();
    // Whether guides go on from the shapes in which they were, among each other. In a density they come to rest alone first if they are to
    // rest at all, as they do without a start: from there Newton's method for all takes a tenth of the steps (bench `head`, `warm`).
    let goes_on = match spec.contact.hair {
        HairContact::Wisps => true,
        HairContact::Density => !full,
        HairContact::None | HairContact::Layers => effort == Effort::NONE,
    };
    let alone: Vec<Rested> = match start {
        GuideStart::At(before) | GuideStart::Like(before) if goes_on => {
            let shapes = guide_solver::in_shapes_of(spec, guides, before);
            shapes.into_iter().map(Rested::free).collect()
        }
        _ => {
            let (locks, iterations) = (&*locks, effort.iterations);
            let options = GuideOptions { start, locks, iterations, held_by_wisps: among };
            guide_solver::settle(spec, head, guides, options, progress)?
        }
    };
    let mut stuck = Vec::new();
    let (mut rests, mut friction) = (Vec::new(), Vec::new());
    for rested in alone {
        rests.push(rested.rest);
        friction.push(rested.friction);
        stuck.push(rested.lock);
    }
    let alone = rests;
    if !wisps_repel || effort.sweeps == 0 {
        let rest = Rest { friction, locks: stuck, ..Rest::apart(alone) };
        return Ok(all_stuck(spec, head, guides, rest));
    }
    let begins = |(i, lock): (usize, Option<Yielding>)| {
        let begins = hold == Hold::ByFriction && lock.is_none();
        if begins { lock::started(spec, head, &guides[i], &alone[i], &locks[i]) } else { lock }
    };
    let locks: Vec<_> = stuck.into_iter().enumerate().map(begins).collect();
    let gone = gone.unwrap_or_else(|| vec![None; guides.len()]);
    let mut rest = if together || (spec.equilibrium.method == HeadMethod::Continuation && full) {
        let among_each_other = warm || among;
        let most = (!full).then_some(effort.sweeps);
        let options = JointOptions { among_each_other, hold, locks, gone: &gone, most };
        joint::settle(spec, head, guides, &alone, options, progress)?
    } else {
        // Sweeps decide which wisp lies on which; a warm start has decided it.
        let sweep_first = full && !warm;
        let options = SweepOptions { sweep_first, most: effort.sweeps, hold, locks };
        head_solver::settle(spec, head, guides, &alone, &gone, options, progress)?
    };
    rest.divided_like(&alone);
    Ok(all_stuck(spec, head, guides, rest))
}

/// Guides at rest, the hairs of whose wisps stick as they lie if they slid on the way.
fn all_stuck(spec: &HairstyleSpec, head: &Head, guides: &[Guide], mut rest: Rest) -> Rest {
    if guides.iter().all(|guide| guide.friction.lock == 0.0) {
        return Rest { locks: Vec::new(), ..rest };
    }
    rest.locks.resize(guides.len(), None);
    parallel::for_each_mut(&mut rest.locks, |i, lock| {
        if lock.is_none() {
            *lock = lock::stuck(spec, head, &guides[i], &rest.guides[i]);
        }
    });
    rest
}
