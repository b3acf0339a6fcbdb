//! The second variation of a rod's energy at one shape as a linear operator on its controls: applied to a step,
//! factorised and solved, each in time proportional to the number of elements.
//!
//! [`super::Newton`] eliminates while it sweeps and keeps only its feedback laws. Here the blocks and the factors are
//! kept, so that one factorisation serves many right-hand sides: as the preconditioner of several rods in contact, for
//! the eigenvalues of their joint Hessian, and for derivatives of an equilibrium by its parameters.
//! docs/theory.md, "The second variation as an operator".

use glam::{DMat3, DVec3};

use super::block::BlockFactor;
use super::linearise::Linearisation;
use super::problem::Problem;
use super::riccati::ValueFunction;
use crate::chain::Shape;
use crate::potential::Derivatives;
use crate::rotation::cross_matrix;

/// The Hessian H of a rod's energy by its controls (N m per rad), at one shape.
///
/// It is exact also where the gradient does not vanish. Arguments and results have one vector per element.
#[derive(Clone, Debug)]
pub struct SecondVariation {
    elements: Vec<ElementBlocks>,
    /// Derivatives at the end of each element; empty without external potentials.
    nodes: Vec<NodeBlocks>,
    /// Derivatives of each sample point inside its element and at its end, see [`Self::displacements`].
    samples: Vec<SampleBlocks>,
    samples_per_element: usize,
    /// K/h of each element (N m), the unit of damping.
    stiffness: Vec<DVec3>,
    gradient: Vec<DVec3>,
}

/// How a step of the controls changes the state at each node of a rod, to first order.
/// See [`SecondVariation::node_changes`].
#[derive(Clone, Debug)]
pub struct NodeChanges(Vec<State>);

impl NodeChanges {
    /// Changes of positions (m, world) and rotations of frames (rad, in each material frame), one for each node, the root's
    /// first; or the derivatives of a number by them, see [`SecondVariation::by_node_changes`].
    pub(crate) fn new(changes: impl Iterator<Item = (DVec3, DVec3)>) -> Self {
        Self(changes.map(|(position, rotation)| State { rotation, position }).collect())
    }

    /// Change of the position (m, world) and rotation of the frame (rad, in the material frame) of each node.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        self.0.iter().map(|state| (state.position, state.rotation))
    }
}

/// How one element moves its end, and the second derivatives of its own energy. docs/theory.md (M1)
#[derive(Clone, Copy, Debug)]
struct ElementBlocks {
    /// η⁺ = Qᵀ η + J x.
    rotation: DMat3,
    turning: DMat3,
    /// ξ⁺ = ξ + S η + T x (m).
    lever: DMat3,
    advance: DMat3,
    /// Of the element's energy, with the second derivatives of the motion contracted with λ and f.
    own: Blocks,
}

/// Symmetric second derivatives by η, ξ and x.
#[derive(Clone, Copy, Debug)]
struct Blocks {
    rotation_rotation: DMat3,
    rotation_position: DMat3,
    position_position: DMat3,
    rotation_control: DMat3,
    position_control: DMat3,
    control_control: DMat3,
}

impl From<Derivatives> for Blocks {
    fn from(d: Derivatives) -> Self {
        Self {
            rotation_rotation: d.rotation_rotation,
            rotation_position: d.rotation_position,
            position_position: d.position_position,
            rotation_control: d.rotation_control,
            position_control: d.position_control,
            control_control: d.control_control,
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct NodeBlocks {
    rotation_rotation: DMat3,
    rotation_position: DMat3,
    position_position: DMat3,
}

/// A sample point moves by ξ + S η + T x.
#[derive(Clone, Copy, Debug)]
struct SampleBlocks {
    lever: DMat3,
    advance: DMat3,
}

/// A change of the state: η (rad, material frame) and ξ (m, world).
#[derive(Clone, Copy, Debug, Default)]
struct State {
    rotation: DVec3,
    position: DVec3,
}

impl ElementBlocks {
    /// The state at the end from that at the start and the step. (M1)
    #[inline]
    fn forward(&self, from: State, step: DVec3) -> State {
        State {
            rotation: self.rotation.transpose() * from.rotation + self.turning * step,
            position: from.position + self.lever * from.rotation + self.advance * step,
        }
    }

    /// The transpose of [`Self::forward`]: derivatives by the state at the start and by the step from those by the
    /// state at the end.
    #[inline]
    fn backward(&self, by_end: State) -> (State, DVec3) {
        let start = State {
            rotation: self.rotation * by_end.rotation + self.lever.transpose() * by_end.position,
            position: by_end.position,
        };
        let step =
            self.turning.transpose() * by_end.rotation + self.advance.transpose() * by_end.position;
        (start, step)
    }
}

impl Problem<'_> {
    /// The second variation of the energy at a shape, with `samples` sample points per element for
    /// [`SecondVariation::displacements`]; at least one.
    #[must_use]
    pub fn second_variation(&self, shape: &Shape, samples: u32) -> SecondVariation {
        if self.with_position {
            SecondVariation::of(&Linearisation::<true>::new(self, shape), samples)
        } else {
            SecondVariation::of(&Linearisation::<false>::new(self, shape), samples)
        }
    }
}

impl SecondVariation {
    fn of<const POSITION: bool>(at: &Linearisation<'_, POSITION>, samples: u32) -> Self {
        let n = at.stages.len();
        let samples_per_element = samples.max(1) as usize;
        let mut elements = Vec::with_capacity(n);
        let mut points = Vec::with_capacity(n * samples_per_element);
        // λ and f of everything beyond the present node, without elimination. (M4)
        let mut value = ValueFunction::ZERO;
        for i in (0..n).rev() {
            if let Some(node) = at.nodes.get(i) {
                value.rotation += node.rotation;
                value.position += node.position;
            }
            let stage = &at.stages[i];
            // V without second derivatives: what is left are those of the motion, contracted with λ and f.
            let model = stage.model::<POSITION>(&value);
            let frame = stage.element.frame;
            let reach = stage.element.motion.reach(1.0, 0.0);
            elements.push(ElementBlocks {
                rotation: stage.rotation,
                turning: stage.turning,
                lever: frame * cross_matrix(reach.value()) * -1.0,
                advance: frame * reach.jacobian(),
                own: model.into(),
            });
            value = ValueFunction {
                rotation: model.rotation,
                position: model.position,
                ..ValueFunction::ZERO
            };
            for k in (1..=samples_per_element).rev() {
                let part = stage.element.motion.part(k as f64 / samples_per_element as f64);
                points.push(SampleBlocks {
                    lever: frame * cross_matrix(part.value()) * -1.0,
                    advance: frame * part.jacobian(),
                });
            }
        }
        elements.reverse();
        points.reverse();
        let node = |d: &Derivatives| NodeBlocks {
            rotation_rotation: d.rotation_rotation,
            rotation_position: d.rotation_position,
            position_position: d.position_position,
        };
        Self {
            elements,
            nodes: at.nodes.iter().map(node).collect(),
            samples: points,
            samples_per_element,
            stiffness: at.stages.iter().map(|stage| stage.element.stiffness).collect(),
            gradient: at.gradient.clone(),
        }
    }

    /// Adds the second derivative of tethers that hold each node where it is, `½ c |ξ|²` with the stiffness c (N/m) and the displacement ξ of
    /// the node: a trust region in space.
    pub fn tether(&mut self, stiffness: f64) {
        let stiffness = DMat3::from_diagonal(DVec3::splat(stiffness));
        let none = NodeBlocks {
            rotation_rotation: DMat3::ZERO,
            rotation_position: DMat3::ZERO,
            position_position: DMat3::ZERO,
        };
        // There are none without external potentials.
        self.nodes.resize(self.elements.len(), none);
        self.nodes.iter_mut().for_each(|node| node.position_position += stiffness);
    }

    /// Derivative of the energy by each element's control (N m) at the same shape.
    #[must_use]
    pub fn gradient(&self) -> &[DVec3] {
        &self.gradient
    }

    /// Number of sample points, see [`Self::displacements`].
    #[must_use]
    pub fn sample_count(&self) -> usize {
        self.samples.len()
    }

    /// H x (N m) for a step x (rad) of the controls.
    #[must_use]
    pub fn apply(&self, step: &[DVec3]) -> Vec<DVec3> {
        self.apply_with(step, &self.node_changes(step), &[])
    }

    /// H x + Jᵀ f (N m) in one pass, as the Hessian of several rods in contact needs it: what [`Self::apply`] and
    /// [`Self::by_controls`] give for the step x (rad) and the forces f (N) on the sample points. `changes` are those of the
    /// step; without forces `forces` is empty.
    #[must_use]
    pub fn apply_with(
        &self,
        step: &[DVec3],
        changes: &NodeChanges,
        forces: &[DVec3],
    ) -> Vec<DVec3> {
        // 1. The states at all nodes, from root to tip. (M7)
        let states = &changes.0;
        // 2. Derivatives by states and steps, from tip to root. (M7)
        let mut product = vec![DVec3::ZERO; self.elements.len()];
        let mut beyond = State::default();
        for (i, element) in self.elements.iter().enumerate().rev() {
            if let Some(node) = self.nodes.get(i) {
                let State { rotation, position } = states[i + 1];
                beyond.rotation +=
                    node.rotation_rotation * rotation + node.rotation_position * position;
                beyond.position += node.rotation_position.transpose() * rotation
                    + node.position_position * position;
            }
            let (own, State { rotation, position }, x) = (&element.own, states[i], step[i]);
            let (mut start, by_step) = element.backward(beyond);
            product[i] = by_step
                + own.rotation_control.transpose() * rotation
                + own.position_control.transpose() * position
                + own.control_control * x;
            if !forces.is_empty() {
                product[i] += self.add_forces(i, forces, &mut start);
            }
            start.rotation += own.rotation_rotation * rotation
                + own.rotation_position * position
                + own.rotation_control * x;
            start.position += own.rotation_position.transpose() * rotation
                + own.position_position * position
                + own.position_control * x;
            beyond = start;
        }
        product
    }

    /// Adds the forces (N) on the sample points of element `i` to the derivatives by the state at its start, and gives the
    /// derivative by its control (N m).
    fn add_forces(&self, i: usize, forces: &[DVec3], start: &mut State) -> DVec3 {
        let points = i * self.samples_per_element..(i + 1) * self.samples_per_element;
        let mut by_step = DVec3::ZERO;
        for (force, sample) in forces[points.clone()].iter().zip(&self.samples[points]) {
            start.position += *force;
            start.rotation += sample.lever.transpose() * *force;
            by_step += sample.advance.transpose() * *force;
        }
        by_step
    }

    /// The change of the state at each node for a step (rad) of the controls; the root's is zero.
    #[must_use]
    pub fn node_changes(&self, step: &[DVec3]) -> NodeChanges {
        let mut states = Vec::with_capacity(self.elements.len() + 1);
        let mut state = State::default();
        states.push(state);
        for (element, x) in self.elements.iter().zip(step) {
            state = element.forward(state, *x);
            states.push(state);
        }
        NodeChanges(states)
    }

    /// The transpose of [`Self::node_changes`]: the derivative of a number by each control from those by the positions (per m,
    /// world) and rotations (per rad, in each material frame) of the nodes. The root's do not count.
    #[must_use]
    pub fn by_node_changes(&self, by_nodes: &NodeChanges) -> Vec<DVec3> {
        let mut sum = vec![DVec3::ZERO; self.elements.len()];
        let mut beyond = State::default();
        for (i, element) in self.elements.iter().enumerate().rev() {
            let State { rotation, position } = by_nodes.0[i + 1];
            beyond.rotation += rotation;
            beyond.position += position;
            (beyond, sum[i]) = element.backward(beyond);
        }
        sum
    }

    /// How a step x (rad) moves each sample point (m), to first order. The points are those of
    /// [`crate::Chain::sample_points`].
    #[must_use]
    pub fn displacements(&self, step: &[DVec3]) -> Vec<DVec3> {
        self.displacements_with(step, &self.node_changes(step))
    }

    /// [`Self::displacements`] of a step whose changes at the nodes are known.
    #[must_use]
    pub fn displacements_with(&self, step: &[DVec3], changes: &NodeChanges) -> Vec<DVec3> {
        let states = &changes.0;
        let moved = |(k, sample): (usize, &SampleBlocks)| {
            let i = k / self.samples_per_element;
            states[i].position + sample.lever * states[i].rotation + sample.advance * step[i]
        };
        self.samples.iter().enumerate().map(moved).collect()
    }

    /// The transpose of [`Self::displacements`]: the derivative by each control (N m) of an energy whose derivatives by
    /// the sample points are `forces` (N).
    #[must_use]
    pub fn by_controls(&self, forces: &[DVec3]) -> Vec<DVec3> {
        let mut sum = vec![DVec3::ZERO; self.elements.len()];
        let mut beyond = State::default();
        for (i, element) in self.elements.iter().enumerate().rev() {
            let (mut start, by_step) = element.backward(beyond);
            sum[i] = by_step + self.add_forces(i, forces, &mut start);
            beyond = start;
        }
        sum
    }

    /// The factors of `H + σ K/h`; `None` if a pivot is not positive definite, so that H + σ K/h is not. `damping` is σ.
    #[must_use]
    pub fn factor(&self, damping: f64) -> Option<SecondVariationFactor<'_>> {
        let mut eliminated = Vec::with_capacity(self.elements.len());
        let mut value = NodeBlocks {
            rotation_rotation: DMat3::ZERO,
            rotation_position: DMat3::ZERO,
            position_position: DMat3::ZERO,
        };
        for (i, element) in self.elements.iter().enumerate().rev() {
            // 1. V″ at the end of the element.
            if let Some(node) = self.nodes.get(i) {
                value.rotation_rotation += node.rotation_rotation;
                value.rotation_position += node.rotation_position;
                value.position_position += node.position_position;
            }
            // 2. q″: that of the element, and V″ through the motion. (M2)
            let m = element.with_value(&value);
            // 3. The pivot and the feedback. (M3)
            let pivot = m.control_control + DMat3::from_diagonal(self.stiffness[i] * damping);
            let factor = BlockFactor::new(&pivot)?;
            let by_rotation = factor.solve_transposed(&m.rotation_control) * -1.0;
            let by_position = factor.solve_transposed(&m.position_control) * -1.0;
            // 4. V″ of the node before. (M5)
            value = NodeBlocks {
                rotation_rotation: m.rotation_rotation + m.rotation_control * by_rotation,
                rotation_position: m.rotation_position + m.rotation_control * by_position,
                position_position: m.position_position + m.position_control * by_position,
            };
            eliminated.push(Elimination { factor, by_rotation, by_position });
        }
        eliminated.reverse();
        Some(SecondVariationFactor { of: self, eliminated })
    }
}

impl ElementBlocks {
    /// The second derivatives of the element's energy and of V beyond it, by its start and its control.
    fn with_value(&self, value: &NodeBlocks) -> Blocks {
        // The end moves by A (η, ξ) + B x with A = [Qᵀ 0; S 1], B = [J; T]: Aᵀ V″ A, Aᵀ V″ B, Bᵀ V″ B.
        let (a, j, s, t) = (self.rotation.transpose(), self.turning, self.lever, self.advance);
        let (rr, rp, pp) =
            (value.rotation_rotation, value.rotation_position, value.position_position);
        let pr = rp.transpose();
        // V″ A by columns η and ξ, and V″ B; rows η⁺ and ξ⁺.
        let (rotation_a, position_a) = (rr * a + rp * s, pr * a + pp * s);
        let (rotation_b, position_b) = (rr * j + rp * t, pr * j + pp * t);
        let (at, st) = (a.transpose(), s.transpose());
        let own = &self.own;
        Blocks {
            rotation_rotation: own.rotation_rotation + at * rotation_a + st * position_a,
            rotation_position: own.rotation_position + at * rp + st * pp,
            position_position: own.position_position + pp,
            rotation_control: own.rotation_control + at * rotation_b + st * position_b,
            position_control: own.position_control + position_b,
            control_control: own.control_control
                + j.transpose() * rotation_b
                + t.transpose() * position_b,
        }
    }
}

/// The block factors of a [`SecondVariation`].
#[derive(Clone, Debug)]
pub struct SecondVariationFactor<'a> {
    of: &'a SecondVariation,
    eliminated: Vec<Elimination>,
}

#[derive(Clone, Copy, Debug)]
struct Elimination {
    factor: BlockFactor,
    by_rotation: DMat3,
    by_position: DMat3,
}

impl SecondVariationFactor<'_> {
    /// The solution x (rad) of `(H + σ K/h) x = right` (N m).
    #[must_use]
    pub fn solve(&self, right: &[DVec3]) -> Vec<DVec3> {
        let n = self.eliminated.len();
        // 1. Backwards: the linear terms of V, each control eliminated. (M8)
        let mut feedforward = vec![DVec3::ZERO; n];
        let mut beyond = State::default();
        for i in (0..n).rev() {
            let (mut start, by_step) = self.of.elements[i].backward(beyond);
            let Elimination { factor, by_rotation, by_position } = &self.eliminated[i];
            let q = by_step - right[i];
            feedforward[i] = -factor.solve(q);
            // q_·x k = −q_·x H_xx⁻¹ q = Gᵀ q.
            start.rotation += by_rotation.transpose() * q;
            start.position += by_position.transpose() * q;
            beyond = start;
        }
        // 2. Forwards: the feedback laws. (M8)
        let mut state = State::default();
        let mut solution = Vec::with_capacity(n);
        for (i, k) in feedforward.into_iter().enumerate() {
            let Elimination { by_rotation, by_position, .. } = &self.eliminated[i];
            let x = k + *by_rotation * state.rotation + *by_position * state.position;
            state = self.of.elements[i].forward(state, x);
            solution.push(x);
        }
        solution
    }
}
