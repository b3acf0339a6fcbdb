//! Guides coming to rest: each alone on the body, then all together among each other.

mod fields;
mod guide_solver;
mod head_solver;
mod joint;
mod report;
mod start;
mod wisp;

pub(crate) use fields::{held_up, holding};
pub use report::{SettlingReport, settling_report};
pub(crate) use start::{Change, GuideStart};

use crate::guides::Guide;
use crate::hairstyle::Rest;
use crate::head::Head;
use crate::spec::{HairContact, HairstyleSpec, HeadMethod};
use frisure_progress::{Cancelled, Progress};

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
}

/// Brings every guide to rest: first each alone on the body, then, if wisps repel each other, all together.
///
/// # Errors
/// [`Cancelled`], if the progress says so.
pub(crate) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    SettleOptions { start, effort }: SettleOptions<'_>,
    progress: &dyn Progress,
) -> Result<Rest, Cancelled> {
    let wisps_repel = spec.contact.hair == HairContact::Wisps;
    let warm = matches!(start, GuideStart::At(_));
    let alone = match start {
        // Among wisps the guides go on from where the other wisps left them.
        GuideStart::At(before) if effort == Effort::NONE || wisps_repel => {
            guide_solver::in_shapes_of(spec, guides, before)
        }
        _ => guide_solver::settle(spec, head, guides, start, effort.iterations, progress)?,
    };
    if !wisps_repel || effort.sweeps == 0 {
        return Ok(Rest::apart(alone));
    }
    if spec.equilibrium.method == HeadMethod::Continuation && effort == Effort::FULL {
        return joint::settle(spec, head, guides, &alone, warm, progress);
    }
    // Sweeps decide which wisp lies on which; a warm start has decided it.
    let sweep_first = effort == Effort::FULL && !warm;
    let mut rest =
        head_solver::settle(spec, head, guides, &alone, sweep_first, effort.sweeps, progress)?;
    // Among wisps a guide has the division that it has alone.
    for (guide, alone) in rest.guides.iter_mut().zip(&alone) {
        guide.certificate.accuracy = alone.certificate.accuracy;
    }
    Ok(rest)
}
