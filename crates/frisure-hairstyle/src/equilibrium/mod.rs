//! Guides coming to rest: each alone on the body, then all together among each other.

mod alone;
mod report;
mod together;
mod wisp;

pub use report::SettlingReport;

use frisure_rod::potential::{Field, FieldPotential};
use frisure_rod::{Equilibrium, Options, Resolution, Rod};
use glam::DVec3;

use crate::contact::{Bed, BodyContact, Layer, Thickness};
use crate::guides::Guide;
use crate::head::Head;
use crate::monitor::{Cancelled, Monitor};
use crate::pull::Pull;
use crate::spec::{HairContact, HairstyleSpec};

/// Guides at rest.
#[derive(Clone, Debug)]
pub(crate) struct Rest {
    pub(crate) guides: Vec<Equilibrium>,
    /// Energy of wisps that overlap (J), each pair counted once.
    pub(crate) crowding: f64,
    /// Sweeps over the guides.
    pub(crate) sweeps: usize,
}

/// Brings every guide to rest.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    monitor: &dyn Monitor,
) -> Result<Rest, Cancelled> {
    let alone = alone::settle(spec, head, guides, monitor)?;
    if spec.contact.hair == HairContact::Wisps {
        return together::settle(spec, head, guides, &alone, monitor);
    }
    Ok(Rest { guides: alone, crowding: 0.0, sweeps: 0 })
}

/// How much work a warm start may do: what does not fit is left for the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Most iterations of each guide on its own.
    pub iterations: usize,
    /// Most sweeps over all guides in which wisps make way for each other.
    pub sweeps: usize,
}

impl Effort {
    /// As much as [`crate::predict`] would do.
    pub const FULL: Self = Self { iterations: alone::MAX_ITERATIONS, sweeps: together::MOST_STEPS };

    /// Nothing at all: guides are in the shapes that they start from.
    pub const NONE: Self = Self { iterations: 0, sweeps: 0 };
}

impl Default for Effort {
    fn default() -> Self {
        Self::FULL
    }
}

/// Brings every guide to rest from where the guide of the same index rested before.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn settle_from(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    before: &[Equilibrium],
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Rest, Cancelled> {
    if effort == Effort::NONE || spec.contact.hair == HairContact::Wisps {
        let start = alone::carried(spec, guides, before);
        return among(spec, head, guides, start, effort, monitor);
    }
    let alone = alone::settle_from(spec, head, guides, before, effort.iterations, monitor)?;
    Ok(Rest { guides: alone, crowding: 0.0, sweeps: 0 })
}

/// Brings every guide to rest alone, and then does no more than `effort`.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn settle_roughly(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Rest, Cancelled> {
    let alone = alone::settle(spec, head, guides, monitor)?;
    among(spec, head, guides, alone, effort, monitor)
}

/// Wisps make way for each other, where they do, in no more than `effort`.
fn among(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    alone: Vec<Equilibrium>,
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Rest, Cancelled> {
    if spec.contact.hair == HairContact::Wisps && effort.sweeps > 0 {
        return together::go_on(spec, head, guides, &alone, effort.sweeps, monitor);
    }
    Ok(Rest { guides: alone, crowding: 0.0, sweeps: 0 })
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

/// Brings guides to rest again after something was done to some of them.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn resettle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    (before, changes): (&[Equilibrium], &[Change]),
    monitor: &dyn Monitor,
) -> Result<Rest, Cancelled> {
    let most = Effort::FULL.iterations;
    let alone = alone::resettle(spec, head, guides, (before, changes), most, monitor)?;
    if spec.contact.hair == HairContact::Wisps {
        return together::settle(spec, head, guides, &alone, monitor);
    }
    Ok(Rest { guides: alone, crowding: 0.0, sweeps: 0 })
}

/// As [`resettle`], doing no more than `effort`.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn resettle_roughly(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    (before, changes): (&[Equilibrium], &[Change]),
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Rest, Cancelled> {
    let most = effort.iterations;
    let alone = alone::resettle(spec, head, guides, (before, changes), most, monitor)?;
    among(spec, head, guides, alone, effort, monitor)
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
