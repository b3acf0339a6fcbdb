//! Contact of a simulated hair: the skin, and the confinement tube of the hairs around it.

use frisure_rod::batch::{ConfinementTube, Contact, ContactField};
use glam::DVec3;

use crate::head::Head;
use crate::math::outer;
use crate::spec::Body;
use crate::strands::binding::StrandBinding;
use crate::strands::population::Population;
use crate::strands::skin::LEAST_DISTANCE;

/// The skin, and around each hair a tube between its neighbours.
///
/// Hairs of a wisp lie side by side: each has the tube of the radius ρ for itself in which hairs of one wisp wander
/// (see [`crate::contact::Thickness`]), about the place where its guides put it. Beyond it neighbours push
/// back with the stiffness of hair, as [`ConfinementTube`] says. That is a mean field: neighbours do not answer.
///
/// Skin begins a little outside, where the line of a hair has to be: `k e³/6m` for the depth e below that margin m, k
/// the stiffness of skin. It begins as softly as hair, since what begins at once takes Newton's steps to and fro.
pub(super) struct Envelope<'a> {
    population: &'a Population<'a>,
    elements: usize,
    room: Room,
    /// Factor on all stiffnesses.
    pub(super) hardness: f64,
    /// Length of an element of each hair (m).
    lengths: Vec<f64>,
    /// Of the ends of links, those of a hair one after the other.
    tubes: Vec<ConfinementTube>,
}

/// What a tube leaves a hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Room {
    /// The room of one hair, which others do not enter.
    Hair,
    /// The room of its wisp, which it shares with all others.
    Wisp,
}

/// Steepest slope of the distance from the skin: it is 1 but for the smoothing.
/// Chosen by trial; not measured further.
const STEEPEST: f64 = 1.25;

/// How much wider the tube of a hair is that leaves its wisp. Chosen by eye; not measured.
const STRAY: f64 = 12.0;

/// From which distance (m) on it is enough to know that skin is as far. No result depends on it.
const FAR: f64 = 0.02;

/// Arc length (m) over which the margin over the skin grows to its full size. Chosen; not measured further.
const MARGIN_GROWTH: f64 = 0.003;

impl<'a> Envelope<'a> {
    pub(super) fn new(
        population: &'a Population<'a>,
        room: Room,
        elements: usize,
        hairs: usize,
    ) -> Self {
        let tubes = Vec::with_capacity(elements * hairs);
        Self {
            population,
            elements,
            room,
            hardness: 1.0,
            lengths: Vec::with_capacity(hairs),
            tubes,
        }
    }

    /// The next hair, of a length (m).
    pub(super) fn add(&mut self, binding: &StrandBinding<'_>, length: f64) {
        let Population { spec, head, guides, .. } = self.population;
        let h = length / self.elements as f64;
        let thickness = &guides[binding.main()].thickness;
        let wide = if binding.stray() { STRAY } else { 1.0 };
        let mut before = (DVec3::ZERO, -1.0);
        for joint in 0..self.elements {
            let s = (h * (joint as f64 + 1.5)).min(length);
            let centre = self.population.followed_point(binding, s / binding.length);
            let clear = match spec.contact.body {
                Body::None => f64::INFINITY,
                _ => {
                    // From the tube before: a distance that is far enough needs no query.
                    let at_least = before.1 - centre.distance(before.0);
                    if at_least > FAR { at_least } else { self.clear(head, centre, s) }
                }
            };
            before = (centre, clear);
            let own = wide * thickness.tube(s);
            let radius = match self.room {
                Room::Hair => own,
                Room::Wisp => own.max(thickness.packed(s)),
            };
            let stiffness = spec.contact.hair_stiffness;
            self.tubes.push(ConfinementTube { centre, radius, stiffness, clearance: clear });
        }
        self.lengths.push(h);
    }

    /// How far (m) from a place at arc length `s` (m) it is to the skin at least.
    fn clear(&self, head: &Head, place: DVec3, s: f64) -> f64 {
        (head.signed_distance().value(place) - margin(s)) / STEEPEST
    }

    fn joint(&self, hair: usize, s: f64) -> usize {
        hair * self.elements + ((s / self.lengths[hair] - 1.0) as usize).min(self.elements - 1)
    }
}

/// How far (m) outside the skin it begins.
fn margin(s: f64) -> f64 {
    // It grows from zero at the follicle.
    LEAST_DISTANCE * (s / MARGIN_GROWTH).min(1.0)
}

impl ContactField for Envelope<'_> {
    fn confinement(&self, hair: usize, s: f64) -> ConfinementTube {
        let tube = self.tubes[self.joint(hair, s)];
        ConfinementTube { stiffness: self.hardness * tube.stiffness, ..tube }
    }

    fn contact(&self, _: usize, s: f64, position: DVec3) -> Contact {
        let margin = margin(s);
        let skin = self.population.head.signed_distance();
        // The distance falls by at most STEEPEST per length: a ball of that radius has no skin in it.
        let out = skin.value(position) - margin;
        if out > 0.0 {
            return Contact::Clear(out / STEEPEST);
        }
        let (distance, gradient, hessian) = skin.value_gradient_hessian(position);
        // k e³/6m with e the depth: force k e²/2m against ∇φ, stiffness k e/m along it. docs/theory.md, "Hairs that are rods
        // themselves"
        let depth = margin - distance;
        let stiffness = self.hardness * self.population.spec.contact.stiffness * depth / margin;
        let force = 0.5 * stiffness * depth;
        Contact::Active {
            energy: force * depth / 3.0,
            gradient: gradient * -force,
            hessian: outer(gradient, gradient) * stiffness - hessian * force,
        }
    }
}
