//! The energy of all hairs together, and its gradient.

use frisure_rod::Stability;
use frisure_rod::batch::chain_factor::{ChainShape, JointFactor, Symmetric};
use frisure_rod::batch::{Batch, ConfinementTube, Contact, InitialShape, JointChain};
use glam::{DMat3, DVec3};

use super::StrandSystem;
use super::interaction::Interaction;
use super::layout::Layout;
use super::pairs::StrandProperties;
use crate::parallel;

/// Most iterations of a hair by itself. As in a tube.
const ALONE: usize = 400;

/// A head of hair, ready for evaluation.
pub(super) struct Head<'a> {
    pub(super) system: &'a StrandSystem<'a>,
    pub(super) layout: Layout,
    pub(super) chains: Vec<JointChain>,
    /// By point.
    tubes: Vec<ConfinementTube>,
    /// Moment (N m) that the gradients of each hair are relative to.
    pub(super) moments: Vec<f64>,
}

/// A shape of all hairs.
#[derive(Clone, Default)]
pub(super) struct State {
    /// Turns of joints (rad).
    pub(super) controls: Vec<DVec3>,
    /// Contact points (m).
    pub(super) points: Vec<DVec3>,
    frames: Vec<DMat3>,
    /// Gradient (N) by points of all but elasticity and weight.
    pub(super) forces: Vec<DVec3>,
    /// Gradient (N m) by turns.
    pub(super) gradient: Vec<DVec3>,
    /// Energy (J).
    pub(super) energy: f64,
    /// Around each point: centre (m) and radius (m) of a ball in which the field has no contact but its tubes.
    pub(super) clear: Vec<(DVec3, f64)>,
}

impl<'a> Head<'a> {
    pub(super) fn new(system: &'a StrandSystem<'a>) -> Self {
        let layout = Layout::new(&system.elements);
        let chain = |strand: usize| JointChain::new(&system.rods[strand], system.elements[strand]);
        let chains = parallel::map(layout.strands(), chain);
        let moments = system.rods.iter().map(frisure_rod::Rod::moment_scale).collect();
        let tubes = parallel::map(chains.len(), |strand| {
            let (chain, field) = (&chains[strand], system.field);
            let tubes = (0..=chain.joints()).map(|k| field.confinement(strand, chain.at(k).0));
            tubes.collect::<Vec<_>>()
        });
        Self { system, layout, chains, tubes: tubes.concat(), moments }
    }

    pub(super) fn properties(&self) -> StrandProperties<'_> {
        let shares = self.chains.iter();
        let force_scale = |(rod, moment): (&frisure_rod::Rod, &f64)| moment / rod.length().powi(2);
        StrandProperties {
            layout: &self.layout,
            radii: &self.system.radii,
            force_scale: self.system.rods.iter().zip(&self.moments).map(force_scale).collect(),
            friction: &self.system.friction,
            hardness: 1.0,
            shares: shares.flat_map(|c| (0..=c.joints()).map(move |p| c.at(p).1)).collect(),
        }
    }

    /// The shape with these turns (rad), not evaluated.
    pub(super) fn state(&self, controls: Vec<DVec3>) -> State {
        let (joints, points) = (self.layout.joint_count(), self.layout.point_count());
        assert_eq!(controls.len(), joints, "a turn for every joint");
        State {
            controls,
            points: vec![DVec3::ZERO; points],
            frames: vec![DMat3::ZERO; joints],
            forces: vec![DVec3::ZERO; points],
            gradient: vec![DVec3::ZERO; joints],
            energy: 0.0,
            clear: vec![(DVec3::ZERO, -1.0); points],
        }
    }

    /// Computes points of a shape from its turns, with all but pairs: its energy (J), and the gradient by points.
    pub(super) fn place(&self, state: &mut State) {
        let layout = &self.layout;
        let State { controls, points, frames, forces, clear, .. } = state;
        let mut work: Vec<_> = (layout.by_point(points).into_iter())
            .zip(layout.by_joint(frames))
            .zip(layout.by_point(forces))
            .zip(layout.by_point(clear))
            .collect();
        let energies =
            parallel::map_mut(&mut work, |index, (((points, frames), forces), clear)| {
                let (mut joint, mut point, mut energy) = (0, 0, 0.0);
                for strand in layout.chunks()[index].clone() {
                    let chain = &self.chains[strand];
                    let n = chain.joints();
                    let points = &mut points[point..=point + n];
                    let controls = &controls[layout.joints(strand)];
                    energy += chain.shape(controls, points, &mut frames[joint..joint + n]);
                    let forces = &mut forces[point..=point + n];
                    energy += self.outside(strand, points, forces, &mut clear[point..=point + n]);
                    (joint, point) = (joint + n, point + n + 1);
                }
                energy
            });
        state.energy = energies.iter().sum();
    }

    /// Contact of one hair with all but hairs: energy (J), and its gradient (N) by points.
    fn outside(
        &self,
        strand: usize,
        points: &[DVec3],
        forces: &mut [DVec3],
        clear: &mut [(DVec3, f64)],
    ) -> f64 {
        let chain = &self.chains[strand];
        let tubes = &self.tubes[self.layout.points(strand)];
        forces[0] = DVec3::ZERO;
        let mut sum = 0.0;
        for (k, &p) in points.iter().enumerate().skip(1) {
            let (s, share) = chain.at(k);
            let ConfinementTube { centre, radius, stiffness, .. } = tubes[k];
            let away = p - centre;
            let distance = away.length();
            let beyond = (distance - radius).max(0.0);
            forces[k] = DVec3::ZERO;
            if beyond > 0.0 {
                // k e³/6ρ, as the tube of a rod in the lanes.
                let force = 0.5 * stiffness * beyond * beyond / radius * share;
                sum += force * beyond / 3.0;
                forces[k] = away * (force / distance);
            }
            // Within a ball that was found free of contact nothing is looked up; its radius is negative where there is none.
            if p.distance_squared(clear[k].0) < clear[k].1 * clear[k].1.abs() {
                continue;
            }
            match self.system.field.contact(strand, s, p) {
                Contact::Clear(radius) => clear[k] = (p, radius),
                Contact::Active { energy, gradient, .. } => {
                    sum += energy * share;
                    forces[k] += gradient * share;
                }
            }
        }
        sum
    }

    /// Computes energy and gradient of a shape from its turns.
    pub(super) fn evaluate(&self, interaction: &mut dyn Interaction, state: &mut State) {
        // 1. Points from turns, with weight, elasticity and contact with all but hairs; 2. forces of other hairs by points.
        self.place(state);
        let layout = &self.layout;
        state.energy += interaction.add_forces(&state.points, &mut state.forces);
        let State { controls, points, frames, forces, gradient, .. } = state;
        // 3. The derivative by turns: moments of all forces beyond a joint, from the tip to the root of each hair.
        parallel::for_each_mut(&mut layout.by_joint(gradient), |index, gradient| {
            let mut joint = 0;
            for strand in layout.chunks()[index].clone() {
                let chain = &self.chains[strand];
                let n = chain.joints();
                let (joints, range) = (layout.joints(strand), layout.points(strand));
                chain.gradient(
                    &controls[joints.clone()],
                    &points[range.clone()],
                    &frames[joints],
                    &forces[range],
                    &mut gradient[joint..joint + n],
                );
                joint += n;
            }
        });
    }

    /// Adds the stiffness (N/m) of contact of one hair with all but hairs, none of it negative, to `sum` by its points.
    pub(super) fn add_outside_stiffness(
        &self,
        strand: usize,
        state: &State,
        sum: &mut [Symmetric],
    ) {
        let chain = &self.chains[strand];
        let range = self.layout.points(strand);
        for (k, at) in range.enumerate().skip(1) {
            let (s, share) = chain.at(k);
            let (p, tube) = (state.points[at], &self.tubes[at]);
            let away = p - tube.centre;
            let distance = away.length();
            let beyond = distance - tube.radius;
            if beyond > 0.0 {
                // Of k e³/6ρ: k e/ρ along the way out, and the force over the distance, k e²/2ρd, at right angles to it.
                let stiffness = tube.stiffness * beyond / tube.radius * share;
                let across = 0.5 * stiffness * beyond / distance;
                sum[k] += Symmetric::square(away / distance, stiffness - across);
                sum[k] += Symmetric::identity(across);
            }
            let (centre, radius) = state.clear[at];
            if p.distance_squared(centre) < radius * radius.abs() {
                continue;
            }
            if let Contact::Active { hessian, .. } = self.system.field.contact(strand, s, p) {
                sum[k] += Symmetric::of(&(hessian * share));
            }
        }
    }

    /// Factorises the Hessian of one hair at an evaluated shape, with `stiffness` (N/m) by its points. Returns the least pivot.
    pub(super) fn factorise(
        &self,
        strand: usize,
        state: &State,
        stiffness: &[Symmetric],
        damping: f64,
        factors: &mut [JointFactor],
    ) -> f64 {
        let (joints, points) = (self.layout.joints(strand), self.layout.points(strand));
        let shape = ChainShape {
            controls: &state.controls[joints.clone()],
            points: &state.points[points.clone()],
            frames: &state.frames[joints],
            forces: &state.forces[points],
            stiffness,
        };
        self.chains[strand].factorise(&shape, damping, factors)
    }

    /// The turns (rad) of hairs each at rest by itself, from others; those that find no rest keep theirs.
    pub(super) fn alone(&self, mut controls: Vec<DVec3>, tolerance: f64) -> Vec<DVec3> {
        parallel::for_each_mut(&mut self.layout.by_joint(&mut controls), |index, controls| {
            let chunk = &self.layout.chunks()[index];
            let n = self.system.elements[chunk.start];
            let batch = Batch { elements: n, tolerance, max_iterations: ALONE, ..Batch::default() };
            let start = InitialShape::Controls(controls.to_vec());
            let rods = &self.system.rods[chunk.clone()];
            let (found, _) = batch.solve_in_contact(rods, start, self.system.field, chunk.start);
            let shapes = found.controls.chunks(n).zip(&found.rods);
            for (before, (after, rod)) in controls.chunks_mut(n).zip(shapes) {
                if rod.stability == Stability::Stable {
                    before.copy_from_slice(after);
                }
            }
        });
        controls
    }

    /// How far (m) the points of one hair have moved at most.
    pub(super) fn moved(&self, strand: usize, from: &[DVec3], to: &[DVec3]) -> f64 {
        let far = |k: usize| from[k].distance_squared(to[k]);
        self.layout.points(strand).map(far).fold(0.0, f64::max).sqrt()
    }

    /// The largest gradient of each hair by the turn of a joint, relative to its moment scale.
    pub(super) fn gradients(&self, state: &State) -> Vec<f64> {
        let largest = |strand: usize| {
            let of = &state.gradient[self.layout.joints(strand)];
            of.iter().map(|g| g.length()).fold(0.0, f64::max) / self.moments[strand]
        };
        parallel::map(self.layout.strands(), largest)
    }
}
