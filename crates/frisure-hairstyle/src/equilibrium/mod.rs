//! Guides coming to rest: each alone on the body, then all together among each other.

mod alone;
mod report;
mod together;
mod wisp;

pub use report::{SettlingReport, settling_report};

use frisure_rod::potential::{Field, FieldPotential};
use frisure_rod::{Equilibrium, Options, Resolution, Rod};
use glam::DVec3;

use crate::contact::{Bed, BodyContact, Layer, Thickness};
use crate::guides::Guide;
use crate::head::Head;
use crate::monitor::{Cancelled, Monitor};
use crate::pull::Pull;
use crate::rest::Rest;
use crate::spec::{HairContact, HairstyleSpec};

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
    pub const FULL: Self = Self { iterations: alone::MAX_ITERATIONS, sweeps: together::MOST_STEPS };

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

/// Where each guide starts from.
pub(crate) enum GuideStart<'a> {
    /// From its natural shape, while gravity is turned on.
    Natural,
    /// From where the guide of the same index rested before.
    At(&'a [Equilibrium]),
    /// From where it rested before, by what was done to it since.
    Changed {
        /// How guides rested before.
        before: &'a [Equilibrium],
        /// What was done to each.
        changes: &'a [Change],
    },
}

/// Brings every guide to rest: first each alone on the body, then, if wisps repel each other, all together.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    SettleOptions { start, effort }: SettleOptions<'_>,
    monitor: &dyn Monitor,
) -> Result<Rest, Cancelled> {
    let wisps_repel = spec.contact.hair == HairContact::Wisps;
    let warm = matches!(start, GuideStart::At(_));
    let alone = match start {
        GuideStart::Natural => alone::settle(spec, head, guides, monitor)?,
        // Among wisps the guides go on from where the other wisps left them.
        GuideStart::At(before) if effort == Effort::NONE || wisps_repel => {
            alone::in_shapes_of(spec, guides, before)
        }
        GuideStart::At(before) => {
            alone::settle_from(spec, head, guides, before, effort.iterations, monitor)?
        }
        GuideStart::Changed { before, changes } => {
            alone::resettle(spec, head, guides, (before, changes), effort.iterations, monitor)?
        }
    };
    if !wisps_repel || effort.sweeps == 0 {
        return Ok(Rest::apart(alone));
    }
    if effort == Effort::FULL && !warm {
        return together::settle(spec, head, guides, &alone, monitor);
    }
    together::go_on(spec, head, guides, &alone, effort.sweeps, monitor)
}

/// Accuracy (m) with which the fibre of a groom is sought.
const HOLDING: f64 = 1e-4;

/// What holds a strand of a groom up besides its own curl.
pub(crate) fn held_up<'a>(
    spec: &HairstyleSpec,
    head: &'a Head,
    rod: &Rod,
    bed: &'a Bed,
) -> BodyContact<'a> {
    BodyContact {
        head,
        body: spec.contact.body,
        skin: spec.contact.stiffness,
        hair: spec.contact.hair_stiffness,
        // The bed is as high as it is, whatever wisp lies on it.
        thickness: Thickness::new(rod, DVec3::ZERO, (1.0, 1.0), 0.0, 0.0),
        layer: Layer::NONE,
        bed: Some(bed),
    }
}

/// How the rest of a groom's strand is sought, whose fibre is to be found.
pub(crate) fn holding(spec: &HairstyleSpec) -> Options {
    let resolution = match spec.equilibrium.resolution {
        Resolution::Accuracy(accuracy) => Resolution::Accuracy(accuracy.min(HOLDING)),
        elements @ Resolution::Elements(_) => elements,
    };
    Options { resolution, ..alone::options(spec) }
}

/// What was done to a guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Change {
    /// Nothing: it stays where it is, unless a wisp pushes it.
    None,
    /// It comes to rest from where it lay before.
    Changed,
    /// It was in a hand and is let go: it comes to the lower of two rests, from where it lay and from
    /// its root.
    Handled,
    /// It was put into another shape by hand.
    Moulded,
    /// What pulled at it lets go, gently.
    LetGo(Pull),
}

/// Largest distance (m) between the points at which a guide feels the body …
const BODY_SPACING: f64 = 3e-3;

/// … and the largest natural turn between them (rad), so that no coil slips into the skin.
const BODY_TURN: f64 = 0.7;

/// What a guide feels of the body, on a bed of hair or without.
fn body<'a>(
    spec: &HairstyleSpec,
    head: &'a Head,
    guide: &'a Guide,
    layer: Layer,
) -> BodyContact<'a> {
    BodyContact {
        head,
        body: spec.contact.body,
        skin: spec.contact.stiffness * guide.firmness,
        hair: spec.contact.hair_stiffness,
        thickness: guide.thickness,
        layer,
        bed: guide.bed.as_deref(),
    }
}

/// The body, or what pulls, along a guide of so many elements.
fn along<'a, F: Field>(field: &'a F, guide: &Guide, elements: usize) -> FieldPotential<'a, F> {
    let strain = guide.rod.natural().mean(0.0, guide.rod.length()).length();
    FieldPotential::new(
        field,
        samples(guide, elements, BODY_SPACING.min(BODY_TURN / strain.max(1e-9))),
    )
}

/// Points per element so that they are at most `spacing` (m) apart.
fn samples(guide: &Guide, elements: usize, spacing: f64) -> u32 {
    (guide.rod.length() / (elements as f64 * spacing)).ceil().clamp(1.0, 1000.0) as u32
}
