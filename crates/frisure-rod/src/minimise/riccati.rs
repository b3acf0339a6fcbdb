//! Newton's method in linear time: differential dynamic programming.
//!
//! A rod is a discrete optimal-control problem: the state is the frame (and the position where a
//! potential asks for it), the control is the element's. One backward Riccati sweep gives the
//! exact quadratic model of the energy below each node with all later controls eliminated, and a
//! feedback law; one forward rollout applies it to the nonlinear chain. Jacobson & Mayne,
//! *Differential Dynamic Programming* (1970); the second-order terms of rotations are kept, so that
//! convergence is quadratic.
//!
//! The pivots of the undamped sweep are those of the Hessian: all positive means a minimum.

use glam::{DMat3, DVec3};

use super::pivot::{Pivot, lowest_eigenpair};
use super::{Minimiser, Minimum, Problem, Stability, StoppingCriteria};
use crate::chain::Shape;
use crate::potential::{Derivatives, ElementState};
use crate::rotation::{cross_matrix, deviation, scaled_identity, symmetric_outer};

/// Differential dynamic programming with Levenberg damping.
#[derive(Clone, Copy, Debug)]
pub struct Newton {
    /// Damping after a first failed pivot, as a fraction of the elastic stiffness. Starting high
    /// saves sweeps: PHYSICS_NOTES, "The minimiser".
    pub first_damping: f64,
    /// Whether to leave a saddle along negative curvature; without it the saddle is the answer.
    pub escape_saddles: bool,
}

impl Default for Newton {
    fn default() -> Self {
        Self { first_damping: 0.3, escape_saddles: true }
    }
}

/// The largest turn of one element's control in one step (rad).
const LARGEST_TURN: f64 = 1.0;

/// A relative gradient that may be as small as rounding lets it be.
const ROUNDED: f64 = 1e-6;

/// Most saddles left in one descent.
const LARGEST_ESCAPES: usize = 40;

/// Damping above which a step is shorter than rounding.
const LARGEST_DAMPING: f64 = 1e12;

impl Minimiser for Newton {
    fn minimise(&self, problem: &Problem<'_>, start: Shape, stopping: StoppingCriteria) -> Minimum {
        if problem.with_position {
            self.descend::<true>(problem, start, stopping)
        } else {
            self.descend::<false>(problem, start, stopping)
        }
    }
}

/// Newton's step at a shape: where the quadratic model of the energy has its minimum.
#[derive(Clone, Debug)]
pub struct NewtonStep {
    /// Derivative of the energy by each element's control (N m).
    pub gradient: Vec<DVec3>,
    /// Change of each element's control (rad).
    pub step: Vec<DVec3>,
    /// Whether the second variation is positive, or zero but for rounding, so that the step is
    /// Newton's own. Otherwise it is damped until it goes downhill.
    pub positive_definite: bool,
}

impl Newton {
    /// One step of Newton's method, for those who minimise the energy of several rods together.
    #[must_use]
    pub fn newton_step(&self, problem: &Problem<'_>, shape: &Shape) -> NewtonStep {
        if problem.with_position {
            self.newton_step_of::<true>(problem, shape)
        } else {
            self.newton_step_of::<false>(problem, shape)
        }
    }

    fn newton_step_of<const POSITION: bool>(
        &self,
        problem: &Problem<'_>,
        shape: &Shape,
    ) -> NewtonStep {
        let stages = Stages::<POSITION>::new(problem, shape);
        let mut damping = 0.0;
        let laws = loop {
            match stages.sweep(damping) {
                Ok(sweep) => break sweep.laws,
                // A shape with numbers so large that nothing is positive has no step.
                Err(_) if damping > LARGEST_DAMPING => break vec![Law::NONE; stages.stages.len()],
                Err(_) => damping = self.first_damping.max(4.0 * damping),
            }
        };
        let step = unrolled::<POSITION>(problem, shape, &laws);
        let positive_definite = damping == 0.0 || stages.negative_pivot().is_none();
        NewtonStep { gradient: stages.gradient, step, positive_definite }
    }

    fn descend<const POSITION: bool>(
        &self,
        problem: &Problem<'_>,
        start: Shape,
        stopping: StoppingCriteria,
    ) -> Minimum {
        let scale = problem.chain.rod().moment_scale();
        let mut damping = 0.0;
        let mut shape = start;
        let mut energy = problem.energy(&shape).total();
        let mut iterations = 0;
        let mut escapes = 0;
        let mut stalled = 0;
        let mut last_gradient = f64::INFINITY;
        loop {
            let stages = Stages::<POSITION>::new(problem, &shape);
            let gradient_norm = stages.gradient_norm() / scale;
            let end = |shape, iterations, stability| Minimum {
                shape,
                gradient_norm,
                iterations,
                stability,
            };
            let mut at_rest = gradient_norm <= stopping.tolerance;
            if !at_rest {
                if iterations >= stopping.max_iterations {
                    return end(shape, iterations, Stability::NotConverged);
                }
                iterations += 1;
                let step = self.step(problem, &stages, &shape, energy, &mut damping);
                let drowned = step.as_ref().is_none_or(|s| s.drowned);
                stalled =
                    if drowned && gradient_norm > 0.5 * last_gradient { stalled + 1 } else { 0 };
                last_gradient = gradient_norm;
                match step {
                    Some(step) if stalled < 3 => (shape, energy) = (step.shape, step.energy),
                    // This is as far as rounding lets one go.
                    _ if gradient_norm <= ROUNDED => at_rest = true,
                    Some(step) => (shape, energy) = (step.shape, step.energy),
                    None => return end(shape, iterations, Stability::NotConverged),
                }
            }
            if at_rest {
                let Some(failed) = stages.negative_pivot() else {
                    return end(shape, iterations, Stability::Stable);
                };
                escapes += 1;
                let left = (self.escape_saddles && escapes <= LARGEST_ESCAPES)
                    .then(|| leave_saddle(problem, &shape, energy, &failed));
                match left.flatten() {
                    Some(left) => (shape, energy) = left,
                    None => return end(shape, iterations, Stability::Saddle),
                }
                iterations += 1;
                (stalled, last_gradient) = (0, f64::INFINITY);
            }
        }
    }

    /// One sweep and rollout that lowers the energy, at whatever damping that takes.
    fn step<const POSITION: bool>(
        &self,
        problem: &Problem<'_>,
        stages: &Stages<'_, POSITION>,
        shape: &Shape,
        energy: f64,
        damping: &mut f64,
    ) -> Option<Step> {
        while *damping < LARGEST_DAMPING {
            let Ok(sweep) = stages.sweep(*damping) else {
                *damping = self.first_damping.max(4.0 * *damping);
                continue;
            };
            // Near the minimum the decrease drowns in rounding; there the gradient decides.
            let noise = 1e-14 * energy.abs();
            if sweep.decrease < noise && *damping > 1.0 {
                return None;
            }
            // Damping shortens a step better than halving does: it keeps the soft directions.
            let trials = if *damping == 0.0 { 4 } else { 2 };
            let mut fraction = 1.0;
            for trial in 0..trials {
                let (next, lowered) = rollout::<POSITION>(problem, shape, &sweep.laws, fraction);
                let expected = sweep.decrease * fraction * (2.0 - fraction);
                if lowered <= energy - 1e-4 * expected
                    || (expected < noise && lowered <= energy + noise)
                {
                    *damping = match trial {
                        0 if *damping < 0.05 => 0.0,
                        0 => *damping * 0.2,
                        1 => *damping,
                        _ => (2.0 * *damping).max(0.01),
                    };
                    let drowned = expected < noise;
                    return Some(Step { shape: next, energy: lowered, drowned });
                }
                fraction *= 0.5;
            }
            *damping = self.first_damping.max(4.0 * *damping);
        }
        None
    }
}

/// An accepted step.
struct Step {
    shape: Shape,
    energy: f64,
    /// Whether the decrease of the energy drowns in rounding.
    drowned: bool,
}

/// What an element contributes at the present shape, apart from what follows it.
struct Stage<'a> {
    element: ElementState<'a>,
    rotation: DMat3,
    turning: DMat3,
    /// Advance (m) in the start frame, and its derivative by the control.
    advance: DVec3,
    advance_jacobian: DMat3,
    own: Derivatives,
}

struct Stages<'a, const POSITION: bool> {
    problem: &'a Problem<'a>,
    stages: Vec<Stage<'a>>,
    /// Derivatives at each node but the root; empty without external potentials.
    nodes: Vec<Derivatives>,
    gradient: Vec<DVec3>,
}

/// `x = k + G_η η + G_ξ ξ`: an element's best step, given how its start moved.
#[derive(Clone, Copy)]
struct Law {
    step: DVec3,
    by_rotation: DMat3,
    by_position: DMat3,
}

struct Sweep {
    laws: Vec<Law>,
    /// Half the decrease that a full step of the quadratic model promises, doubled: Σ qᵀH⁻¹q / 2.
    decrease: f64,
}

/// A pivot that is not positive, with the laws of all elements after it.
struct FailedPivot {
    element: usize,
    pivot: DMat3,
    laws: Vec<Law>,
}

impl<'a, const POSITION: bool> Stages<'a, POSITION> {
    fn new(problem: &'a Problem<'a>, shape: &Shape) -> Self {
        let chain = problem.chain;
        let mut stages = Vec::with_capacity(chain.len());
        for i in 0..chain.len() {
            let element = chain.element_state(shape, i);
            let motion = element.motion;
            let (advance, advance_jacobian) = if POSITION {
                let reach = motion.reach(1.0, 0.0);
                (reach.value(), reach.jacobian())
            } else {
                (DVec3::ZERO, DMat3::ZERO)
            };
            stages.push(Stage {
                rotation: motion.rotation(),
                turning: motion.turning(),
                advance,
                advance_jacobian,
                own: Derivatives::ZERO,
                element,
            });
            let stage = &mut stages[i];
            problem.add_element_derivatives(&stage.element, &mut stage.own);
        }
        let nodes = if problem.external.is_empty() {
            Vec::new()
        } else {
            (1..=chain.len())
                .map(|i| problem.node_derivatives(i, shape.positions[i], shape.frames[i]))
                .collect()
        };
        let mut built = Self { problem, stages, nodes, gradient: Vec::new() };
        built.gradient = built.gradient();
        built
    }

    fn gradient(&self) -> Vec<DVec3> {
        let n = self.stages.len();
        let mut gradient = vec![DVec3::ZERO; n];
        let (mut moment, mut force) = (DVec3::ZERO, DVec3::ZERO);
        for i in (0..n).rev() {
            if let Some(node) = self.nodes.get(i) {
                moment += node.rotation;
                force += node.position;
            }
            let stage = &self.stages[i];
            gradient[i] = stage.own.control + stage.turning.transpose() * moment;
            moment = stage.own.rotation + stage.rotation * moment;
            if POSITION {
                let pull = stage.element.frame.transpose() * force;
                gradient[i] += stage.advance_jacobian.transpose() * pull;
                moment += stage.advance.cross(pull);
                force += stage.own.position;
            }
        }
        gradient
    }

    fn gradient_norm(&self) -> f64 {
        self.gradient.iter().map(|g| g.length()).fold(0.0, f64::max)
    }

    /// The pivot that shows a direction of negative curvature, beyond what rounding may.
    fn negative_pivot(&self) -> Option<FailedPivot> {
        let failed = self.sweep(0.0).err()?;
        self.sweep(self.problem.neutral()).is_err().then_some(failed)
    }

    /// The backward sweep. `damping` adds that fraction of the elastic stiffness to each pivot.
    fn sweep(&self, damping: f64) -> Result<Sweep, FailedPivot> {
        let n = self.stages.len();
        let mut laws = vec![Law::NONE; n];
        let mut decrease = 0.0;
        let mut below = Value::ZERO;
        for i in (0..n).rev() {
            if let Some(node) = self.nodes.get(i) {
                below.add(node);
            }
            let model = self.stages[i].model::<POSITION>(&below);
            let stiffness = self.stages[i].element.stiffness;
            let pivot = model.control_control + DMat3::from_diagonal(stiffness * damping);
            let Some(factor) = Pivot::new(&pivot) else {
                return Err(FailedPivot { element: i, pivot, laws });
            };
            let step = -factor.solve(model.control);
            let by_rotation = factor.solve_transposed(&model.rotation_control) * -1.0;
            decrease -= 0.5 * step.dot(model.control);
            below.rotation = model.rotation + model.rotation_control * step;
            below.rotation_rotation =
                symmetric(model.rotation_rotation + model.rotation_control * by_rotation);
            let by_position = if POSITION {
                let by_position = factor.solve_transposed(&model.position_control) * -1.0;
                below.position = model.position + model.position_control * step;
                below.rotation_position =
                    model.rotation_position + model.rotation_control * by_position;
                below.position_position =
                    symmetric(model.position_position + model.position_control * by_position);
                by_position
            } else {
                DMat3::ZERO
            };
            laws[i] = Law { step, by_rotation, by_position };
        }
        debug_assert!(self.problem.chain.len() == n);
        Ok(Sweep { laws, decrease })
    }
}

fn symmetric(m: DMat3) -> DMat3 {
    (m + m.transpose()) * 0.5
}

/// Quadratic model of the energy below a node by its frame (η) and position (ξ).
#[derive(Clone, Copy)]
struct Value {
    rotation: DVec3,
    position: DVec3,
    rotation_rotation: DMat3,
    rotation_position: DMat3,
    position_position: DMat3,
}

impl Law {
    const NONE: Self =
        Self { step: DVec3::ZERO, by_rotation: DMat3::ZERO, by_position: DMat3::ZERO };
}

impl Value {
    const ZERO: Self = Self {
        rotation: DVec3::ZERO,
        position: DVec3::ZERO,
        rotation_rotation: DMat3::ZERO,
        rotation_position: DMat3::ZERO,
        position_position: DMat3::ZERO,
    };

    fn add(&mut self, node: &Derivatives) {
        self.rotation += node.rotation;
        self.position += node.position;
        self.rotation_rotation += node.rotation_rotation;
        self.rotation_position += node.rotation_position;
        self.position_position += node.position_position;
    }
}

impl Stage<'_> {
    /// Quadratic model of the energy from this element on, by its start and its control.
    ///
    /// The end moves by `η⁺ = Qᵀη + J x + ½ (Qᵀη)×(J x) + ½ D(x, x)` and
    /// `ξ⁺ = ξ + R (exp[η] p(c + x) − p)`, to second order.
    #[inline]
    fn model<const POSITION: bool>(&self, below: &Value) -> Derivatives {
        let (q, j) = (&self.rotation, &self.turning);
        let qt = q.transpose();
        let jt = j.transpose();
        let mut m = self.own;
        let lambda = below.rotation;
        let hessian = &below.rotation_rotation;
        let hessian_j = *hessian * *j;

        m.rotation += *q * lambda;
        m.control += jt * lambda;
        m.rotation_rotation += *q * (*hessian * qt);
        m.control_control += jt * hessian_j + self.element.motion.turning_derivative(lambda);
        m.rotation_control += *q * (hessian_j - cross_matrix(lambda) * *j * 0.5);
        if POSITION {
            self.add_position(below, &mut m);
        }
        m
    }

    fn add_position(&self, below: &Value, m: &mut Derivatives) {
        let (q, j, r) = (&self.rotation, &self.turning, &self.element.frame);
        let p = self.advance;
        let pull = r.transpose() * below.position;
        let (gradient, hessian) = self.element.motion.reach(1.0, 0.0).contracted(pull);
        // ξ⁺ = ξ + S η + T x + …
        let s = *r * cross_matrix(p) * -1.0;
        let t = *r * self.advance_jacobian;
        let (st, tt) = (s.transpose(), t.transpose());
        let rp = &below.rotation_position;
        let pp = &below.position_position;
        let rp_t = *rp * t;
        let pp_t = *pp * t;
        let jt_rp_t = j.transpose() * rp_t;
        let q_rp_s = *q * (*rp * s);

        m.position += below.position;
        m.rotation += p.cross(pull);
        m.control += gradient;
        m.rotation_rotation +=
            q_rp_s + q_rp_s.transpose() + st * (*pp * s) + symmetric_outer(pull, p) * 0.5
                - scaled_identity(pull.dot(p));
        m.control_control += jt_rp_t + jt_rp_t.transpose() + tt * pp_t + hessian;
        let rp_j = rp.transpose() * *j;
        m.rotation_control +=
            *q * rp_t + st * (rp_j + pp_t) - cross_matrix(pull) * self.advance_jacobian;
        m.position_control += rp_j + pp_t;
        m.rotation_position += *q * *rp + st * *pp;
        m.position_position += *pp;
    }
}

/// Applies the feedback laws to the nonlinear chain, and the energy there.
fn rollout<const POSITION: bool>(
    problem: &Problem<'_>,
    from: &Shape,
    laws: &[Law],
    fraction: f64,
) -> (Shape, f64) {
    let chain = problem.chain;
    let n = chain.len();
    let mut shape = Shape {
        controls: Vec::with_capacity(n),
        frames: Vec::with_capacity(n + 1),
        positions: Vec::with_capacity(n + 1),
    };
    let (mut frame, mut position) = (from.frames[0], from.positions[0]);
    shape.frames.push(frame);
    shape.positions.push(position);
    let mut energy = 0.0;
    for (i, law) in laws.iter().enumerate() {
        let turned = deviation(&(from.frames[i].transpose() * frame));
        let mut step = law.step * fraction + law.by_rotation * turned;
        if POSITION {
            step += law.by_position * (position - from.positions[i]);
        }
        let control = from.controls[i] + step.clamp_length_max(LARGEST_TURN);
        let element = chain.element_at(i, position, frame, control);
        position += frame * element.motion.advance();
        frame *= element.motion.rotation();
        energy += problem.step_energy(&element, (position, frame));
        shape.controls.push(control);
        shape.frames.push(frame);
        shape.positions.push(position);
    }
    (shape, energy)
}

/// The change of each control (rad) that the feedback laws ask for on the nonlinear chain.
fn unrolled<const POSITION: bool>(problem: &Problem<'_>, from: &Shape, laws: &[Law]) -> Vec<DVec3> {
    let (mut frame, mut position) = (from.frames[0], from.positions[0]);
    (laws.iter().enumerate())
        .map(|(i, law)| {
            let mut step =
                law.step + law.by_rotation * deviation(&(from.frames[i].transpose() * frame));
            if POSITION {
                step += law.by_position * (position - from.positions[i]);
            }
            let step = step.clamp_length_max(LARGEST_TURN);
            let motion = problem.chain.geometry(i).motion(from.controls[i] + step);
            if POSITION {
                position += frame * motion.advance();
            }
            frame *= motion.rotation();
            step
        })
        .collect()
}

/// Leaves a saddle along the failed pivot's negative direction, with all later elements following
/// their laws; the energy is exactly quadratic with negative curvature that way.
fn leave_saddle(
    problem: &Problem<'_>,
    shape: &Shape,
    energy: f64,
    failed: &FailedPivot,
) -> Option<(Shape, f64)> {
    let (_, direction) = lowest_eigenpair(&failed.pivot);
    let mut laws = failed.laws.clone();
    for law in &mut laws {
        law.step = DVec3::ZERO;
    }
    let mut turn = 0.8;
    for _ in 0..40 {
        // Mirror images have the same energy; the first one wins, so that the answer is one.
        for sign in [1.0, -1.0] {
            laws[failed.element].step = direction * (sign * turn);
            let (next, lowered) = if problem.with_position {
                rollout::<true>(problem, shape, &laws, 1.0)
            } else {
                rollout::<false>(problem, shape, &laws, 1.0)
            };
            if lowered < energy - 1e-15 * energy.abs() {
                return Some((next, lowered));
            }
        }
        turn *= 0.5;
    }
    None
}

/// The smallest eigenvalue of the second variation against the elastic energy's: `H x = λ (K/h) x`;
/// 1 without loads, 0 where stability is lost.
pub(crate) fn second_variation(problem: &Problem<'_>, shape: &Shape) -> f64 {
    if problem.with_position {
        smallest_eigenvalue(&Stages::<true>::new(problem, shape))
    } else {
        smallest_eigenvalue(&Stages::<false>::new(problem, shape))
    }
}

/// Bisection on the inertia: `H + σ K/h` has only positive pivots exactly when σ > −λ_min.
fn smallest_eigenvalue<const POSITION: bool>(stages: &Stages<'_, POSITION>) -> f64 {
    let stable_at = |sigma: f64| stages.sweep(sigma).is_ok();
    let (mut low, mut high) = (-1.0, 0.0);
    if stable_at(0.0) {
        while stable_at(low) {
            (low, high) = (2.0 * low, low);
            if low < -1e12 {
                return -low;
            }
        }
    } else {
        (low, high) = (0.0, 1.0);
        while !stable_at(high) {
            (low, high) = (high, 2.0 * high);
            if high > 1e12 {
                return -high;
            }
        }
    }
    for _ in 0..44 {
        let middle = 0.5 * (low + high);
        if stable_at(middle) {
            high = middle;
        } else {
            low = middle;
        }
        if high - low < 1e-10 * low.abs().max(high.abs()) {
            break;
        }
    }
    -0.5 * (low + high)
}
