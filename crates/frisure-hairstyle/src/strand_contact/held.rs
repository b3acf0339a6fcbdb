//! Newton's step of each hair while the others hold still: the preconditioner of all hairs.

use frisure_rod::batch::{Batch, ConfinementTube, Contact, ContactField, InitialShape};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::energy::{Head, State};
use super::pairs::Pairs;

/// Iterations of a hair: it is loaded, and takes a step, which is tried again with more damping where it raises the energy.
/// Chosen by trial; not measured further.
const ITERATIONS: usize = 4;

/// The same of a hair that has not found a step by then.
const PATIENT_ITERATIONS: usize = 24;

/// Farthest that a point moves in a step of its hair, in contact radii: hairs must not pass through each other between two searches for
/// contacts. Chosen; not measured further.
const FARTHEST: f64 = 0.5;

/// Largest turn of a joint (rad) in a step straight down the gradient. Chosen; not measured further.
const STEEPEST_TURN: f64 = 0.02;

/// One hair among others that hold still: contact with them to the second order about the present shape.
struct Held<'a> {
    head: &'a Head<'a>,
    state: &'a State,
    /// By point: gradient (N) and stiffness (N/m) of pairs.
    gradient: &'a [DVec3],
    stiffness: &'a [DMat3],
}

impl Held<'_> {
    /// Contact point of a hair at an arc length (m).
    fn point(&self, strand: usize, s: f64) -> usize {
        let chain = &self.head.chains[strand];
        let h = chain.at(1).1.max(f64::MIN_POSITIVE);
        let n = chain.joints();
        // (k + ½) h, but for the tip at n h.
        let k = if n == 1 { 1 } else { ((s / h - 0.25).round() as usize).clamp(1, n) };
        self.head.layout.points(strand).start + k
    }
}

impl ContactField for Held<'_> {
    fn confinement(&self, strand: usize, s: f64) -> ConfinementTube {
        // What is known of the field is not known of the pairs.
        ConfinementTube { clearance: -1.0, ..self.head.system.field.confinement(strand, s) }
    }

    fn contact(&self, strand: usize, s: f64, position: DVec3) -> Contact {
        let k = self.point(strand, s);
        let (centre, radius) = self.state.clear[k];
        let outside = if position.distance_squared(centre) < radius * radius.abs() {
            Contact::Clear(0.0)
        } else {
            self.head.system.field.contact(strand, s, position)
        };
        if self.gradient[k] == DVec3::ZERO && self.stiffness[k] == DMat3::ZERO {
            return match outside {
                Contact::Clear(0.0) => Contact::Clear(radius - position.distance(centre)),
                other => other,
            };
        }
        let share = self.head.chains[strand].at(k - self.head.layout.points(strand).start).1;
        let moved = position - self.state.points[k];
        let pull = self.stiffness[k] * moved;
        let (mut energy, mut gradient, mut hessian) = (
            moved.dot(self.gradient[k] + 0.5 * pull) / share,
            (self.gradient[k] + pull) / share,
            self.stiffness[k] * share.recip(),
        );
        if let Contact::Active { energy: e, gradient: g, hessian: h } = outside {
            (energy, gradient, hessian) = (energy + e, gradient + g, hessian + h);
        }
        Contact::Active { energy, gradient, hessian }
    }
}

impl Head<'_> {
    /// The factor on the step of a hair to turns `after` (rad) that keeps its points from moving farther than [`FARTHEST`].
    fn shorter(&self, strand: usize, state: &State, after: &[DVec3]) -> f64 {
        let n = after.len();
        let (mut points, mut frames) = (vec![DVec3::ZERO; n + 1], vec![DMat3::ZERO; n]);
        self.chains[strand].shape(after, &mut points, &mut frames);
        let range = self.layout.points(strand);
        let before = &state.points[range];
        let moved = points.iter().zip(before).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        (FARTHEST * self.system.radii[strand] / moved.max(1e-300)).min(1.0)
    }

    /// A short step (rad) of a hair straight down its gradient: of one that others hold so that Newton's method finds none.
    fn steepest(&self, strand: usize, state: &State, step: &mut [DVec3]) {
        let joints = self.layout.joints(strand);
        let (controls, gradient) = (&state.controls[joints.clone()], &state.gradient[joints]);
        let largest = gradient.iter().map(|g| g.length()).fold(0.0, f64::max);
        let scale = STEEPEST_TURN / largest.max(1e-300);
        let after: Vec<DVec3> =
            controls.iter().zip(gradient).map(|(c, g)| *c - *g * scale).collect();
        let shorter = scale * self.shorter(strand, state, &after);
        step.iter_mut().zip(gradient).for_each(|(step, g)| *step = *g * -shorter);
    }

    /// Puts the step of each hair (rad) into `step`, from an evaluated shape.
    pub(super) fn step_while_held(&self, pairs: &Pairs, state: &State, step: &mut [DVec3]) {
        let layout = &self.layout;
        let count = layout.point_count();
        let (mut gradient, mut stiffness) = (vec![DVec3::ZERO; count], vec![DMat3::ZERO; count]);
        let work = (layout.chunks().par_iter())
            .zip(layout.by_point(&mut gradient))
            .zip(layout.by_point(&mut stiffness));
        work.for_each(|((chunk, gradient), stiffness)| {
            let mut point = 0;
            for strand in chunk.clone() {
                let range = layout.points(strand);
                let mine = point..point + range.len();
                let first = range.start;
                pairs.add_forces(strand, first, &state.pair_forces, &mut gradient[mine.clone()]);
                pairs.add_stiffness(layout, strand, &state.points, &mut stiffness[mine]);
                point += range.len();
            }
        });
        let held = Held { head: self, state, gradient: &gradient, stiffness: &stiffness };
        let steps = layout.by_joint(step);
        (layout.chunks().par_iter()).zip(steps).for_each(|(chunk, step)| {
            let joints = layout.joints(chunk.start).start..layout.joints(chunk.end - 1).end;
            let before = &state.controls[joints];
            let n = self.system.elements[chunk.start];
            let rods = &self.system.rods[chunk.clone()];
            let solve = |first: usize, count: usize, before: &[DVec3], max_iterations| {
                // A hair that is at rest by itself takes no step.
                let batch =
                    Batch { elements: n, tolerance: 1e-12, max_iterations, ..Batch::default() };
                let start = InitialShape::Controls(before.to_vec());
                let rods = &rods[first..first + count];
                batch.solve_in_contact(rods, start, &held, chunk.start + first).0.controls
            };
            let mut found = solve(0, rods.len(), before, ITERATIONS);
            for (k, after) in found.chunks_mut(n).enumerate() {
                let before = &before[k * n..(k + 1) * n];
                if after == before {
                    after.copy_from_slice(&solve(k, 1, before, PATIENT_ITERATIONS));
                }
                let shorter = self.shorter(chunk.start + k, state, after);
                let step = &mut step[k * n..(k + 1) * n];
                for ((step, after), before) in step.iter_mut().zip(after).zip(before) {
                    *step = (*after - *before) * shorter;
                }
                // A long step can end downhill though it begins uphill; one such hair would stop all others.
                let gradient = &state.gradient[layout.joints(chunk.start + k)];
                let slope: f64 = gradient.iter().zip(&*step).map(|(g, s)| g.dot(*s)).sum();
                if slope >= 0.0 {
                    self.steepest(chunk.start + k, state, step);
                }
            }
        });
    }
}
