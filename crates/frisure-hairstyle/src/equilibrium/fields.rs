//! The external potentials of a guide, and the options of its equilibrium.

use std::f64::consts::TAU;

use frisure_rod::potential::{Field, FieldPotential};
use frisure_rod::{Equilibrium, Options, Resolution, Rod};
use glam::DVec3;

use crate::contact::{Bed, BodyContact, CombedHold, FrictionCoefficients, Layer, Thickness};
use crate::guides::Guide;
use crate::head::Head;
use crate::spec::{HairContact, HairstyleSpec};

/// Most elements of a guide, whatever the accuracy: as many as a scene may ask for.
/// A guard on time: an accuracy that needs more is not reached.
pub const MOST_ELEMENTS: usize = 1000;

/// Most elements with which the error of a guide is sought by extrapolation. Chosen: a guard on time.
pub(super) const MOST_EXTRAPOLATED: usize = 512;

/// Relative gradient at which a guide is at rest. Far below what can be seen; chosen, not measured further.
pub(super) const TOLERANCE: f64 = 1e-8;

/// Most iterations at each step: contact comes and goes, so it can take hundreds.
/// Chosen with room; a guide that needs more is reported.
pub(super) const MAX_ITERATIONS: usize = 1000;

/// Farthest (m) that a node of a guide moves in an iteration. Chosen by trial: hair that falls off the head comes down on the same
/// side for lengths that differ by a millionth. With 10 mm two of 620 guides of straight hair do not, without a bound six; a
/// bound of 5 mm takes a sixth more time.
const LONGEST_STEP: f64 = 5e-3;

/// Options of the equilibrium of one guide.
pub(super) fn options(spec: &HairstyleSpec) -> Options {
    Options {
        resolution: spec.equilibrium.resolution,
        element: spec.equilibrium.element,
        max_elements: MOST_EXTRAPOLATED,
        tolerance: TOLERANCE,
        max_iterations: MAX_ITERATIONS,
        longest_step: LONGEST_STEP,
        estimate_error: false,
        eigenvalue: false,
        ..Options::default()
    }
}

/// Accuracy (m) with which the fibre of a groom is sought. A tenth of a millimetre: chosen, not measured further.
const HOLDING: f64 = 1e-4;

/// Contact that holds a strand of a groom up besides its own curl.
pub(crate) fn held_up<'a>(
    spec: &HairstyleSpec,
    head: &'a Head,
    rod: &Rod,
    bed: &'a Bed,
    hold: CombedHold,
) -> BodyContact<'a> {
    BodyContact {
        head,
        body: spec.contact.body,
        skin: spec.contact.stiffness,
        hair: spec.contact.hair_stiffness,
        // The bed is as high as it is, whatever wisp lies on it.
        thickness: Thickness::new(rod, DVec3::ZERO, 1.0, 1.0, 0.0, 0.0),
        layer: Layer::NONE,
        bed: Some(bed),
        // What the groom shows is held by normal forces and by that which holds combed hair, and by no other friction.
        friction: FrictionCoefficients::default(),
        hold,
    }
}

/// How the rest of a groom's strand is sought, whose fibre is to be found.
pub(crate) fn holding(spec: &HairstyleSpec) -> Options {
    let resolution = match spec.equilibrium.resolution {
        Resolution::Accuracy(accuracy) => Resolution::Accuracy(accuracy.min(HOLDING)),
        elements @ Resolution::Elements(_) => elements,
    };
    Options { resolution, ..options(spec) }
}

/// Largest distance (m) between the points at which contact with the body is evaluated; docs/theory.md, "Hair on the body".
const BODY_SPACING: f64 = 3e-3;

/// Largest natural turn (rad) between these points, so that no coil slips into the skin;
/// docs/theory.md, "Hair on the body".
const BODY_TURN: f64 = 0.7;

/// How deep (m) a curl may press itself into the skin beside its root. Chosen: half of what the report calls inside the head.
const CURL_DEPTH: f64 = 2.5e-4;

/// Stiffest skin (Pa); the largest `contact.stiffness`.
const HARDEST: f64 = 1e5;

/// Stiffness of skin per length of hair (Pa): that of the description, or what the guide's own curl needs.
///
/// A curl that grows towards the skin presses on it with its natural moment M = EI κ. A long beam on an elastic foundation of
/// the stiffness k, with the moment M at its end, has the depth 2Mβ²/k there, β⁴ = k/4EI (Hetényi 1946, *Beams on elastic
/// foundation*, ch. 3): κ √(EI/k). docs/theory.md, "Hair on the body".
fn skin_stiffness(spec: &HairstyleSpec, guide: &Guide) -> f64 {
    spec.contact.stiffness.max(skin_for_curl(guide))
}

/// Whether the skin beneath a guide has the stiffness of the description, not that which its curl needs.
pub(super) fn own_skin(spec: &HairstyleSpec, guide: &Guide) -> bool {
    spec.contact.stiffness >= skin_for_curl(guide)
}

/// The stiffness of skin (Pa) that a guide's own curl needs.
fn skin_for_curl(guide: &Guide) -> f64 {
    let curvature = guide.rod.natural().mean(0.0, guide.rod.length()).truncate();
    let bending = guide.rod.stiffness().truncate();
    let needed = bending.min_element() * curvature.length_squared() / CURL_DEPTH.powi(2);
    needed.min(HARDEST)
}

/// Length (m) of combed hair that lies on the head, from the forehead's hairline to above the ears, and the most of a hair that
/// does. Chosen by eye; not measured.
const HELD: f64 = 0.12;
const HELD_SHARE: f64 = 0.6;

/// What holds a rod that was combed, with `hold` times its weight per length.
pub(crate) fn combed_hold(rod: &Rod, hold: DVec3) -> CombedHold {
    CombedHold {
        force: hold * rod.weight(),
        reach: (HELD * winding(rod)).min(HELD_SHARE * rod.length()),
    }
}

/// Length of a rod over that of the axis that its curl winds about, at most [`MOST_WINDING`]; 1 for straight hair.
fn winding(rod: &Rod) -> f64 {
    let strain = rod.natural().mean(0.0, rod.length());
    let (all, along) = (strain.length(), strain.z.abs());
    if all * rod.length() < TAU { 1.0 } else { (all / along.max(1e-9)).min(MOST_WINDING) }
}

/// Most that a curl shortens combed hair: its weight draws tighter curls out. Chosen by eye; not measured.
const MOST_WINDING: f64 = 2.0;

/// Contact of a guide with the body, on a bed of hair or without.
pub(super) fn body<'a>(
    spec: &HairstyleSpec,
    head: &'a Head,
    guide: &'a Guide,
    layer: Layer,
) -> BodyContact<'a> {
    BodyContact {
        head,
        body: spec.contact.body,
        skin: skin_stiffness(spec, guide) * guide.firmness,
        hair: spec.contact.hair_stiffness,
        thickness: guide.thickness,
        layer,
        bed: guide.bed.as_deref(),
        friction: guide.friction,
        hold: combed_hold(&guide.rod, guide.hold),
    }
}

/// The bed of hair that a guide lies on while it is alone.
pub(super) fn layer(spec: &HairstyleSpec, guide: &Guide) -> Layer {
    if spec.contact.hair == HairContact::None { Layer::NONE } else { guide.layer }
}

/// The body, or what pulls, along a guide of `elements` elements.
pub(super) fn along<'a, F: Field>(
    field: &'a F,
    guide: &Guide,
    elements: usize,
) -> FieldPotential<'a, F> {
    FieldPotential::new(field, body_samples(guide, elements))
}

/// Points per element of a guide at which contact with the body is evaluated.
pub(super) fn body_samples(guide: &Guide, elements: usize) -> u32 {
    let strain = guide.rod.natural().mean(0.0, guide.rod.length()).length();
    // The bound (rad/m) stands for straight hair, where the spacing alone decides.
    samples(guide, elements, BODY_SPACING.min(BODY_TURN / strain.max(1e-9)))
}

/// Most points per element: a guard on time for extreme scenes.
const MOST_SAMPLES: f64 = 1000.0;

/// Points per element so that they are at most `spacing` (m) apart.
pub(super) fn samples(guide: &Guide, elements: usize, spacing: f64) -> u32 {
    (guide.rod.length() / (elements as f64 * spacing)).ceil().clamp(1.0, MOST_SAMPLES) as u32
}

/// Distance (m) between the points at which a guide is measured. Chosen by trial; not measured further.
const MEASURE: f64 = 2e-3;

/// Deepest that a point of a guide is inside the body (m), other than in its first
/// [`MEASURE`]; 0 if none is.
pub(super) fn depth(head: &Head, guide: &Equilibrium) -> f64 {
    let samples = (guide.rod.length() / (guide.elements as f64 * MEASURE)).ceil().max(1.0);
    let points = guide.chain().sample_points(&guide.shape, samples as u32);
    // The clamp is below the skin, where the follicle is: the first point does not count.
    let inside = |p: &DVec3| -head.signed_distance().value(*p);
    points.iter().skip(1).map(inside).fold(0.0, f64::max)
}
