//! The linear system of Newton's step of all hairs: conjugate gradients, with the Hessian of each hair as the preconditioner.
//!
//! The Hessian of all is H = M + Jᵀ (K − D) J, with M the Hessians of hairs by themselves, in which the interaction has the stiffness D
//! of points by themselves, K that of the interaction, and J the motion of points by turns of joints. Each solution `z = M⁻¹ r` comes
//! with its motion J z, and M z = r: so neither M nor J has to be applied, their products follow by the recursion of directions.

use std::ops::Range;

use frisure_rod::batch::chain_factor::{JointFactor, Symmetric, solve, subtract_gradient};
use glam::DVec3;

use super::energy::{Head, State};
use super::interaction::Interaction;
use crate::parallel;

/// Damping of a hair whose Hessian is not positive definite, and the factor by which it grows until it is: (1 + damping) times the
/// stiffness of joints. As for rods in lanes.
const FIRST_DAMPING: f64 = 0.3;
const GROWTH: f64 = 4.0;

/// Factor on the damping from step to step, and where it ends. As for rods in lanes.
const SHRINKAGE: f64 = 0.2;
const LEAST_DAMPING: f64 = 0.01;

/// Largest damping: a hair hardly moves then. Chosen.
const MOST_DAMPING: f64 = 1e6;

/// Stiffness by which a hair is held back next time, over that which it lacked. Chosen by trial.
const HOLD: f64 = 4.0;

/// Least pivot over the stiffness of a joint. Chosen: numbers are in single precision.
const LEAST_PIVOT: f64 = 1e-4;

/// Hairs that one thread looks after.
struct Part {
    strands: Range<usize>,
    factors: Vec<JointFactor>,
    /// By joint: residual r, solution x, preconditioned residual z, direction p and M p.
    residual: Vec<DVec3>,
    solution: Vec<DVec3>,
    preconditioned: Vec<DVec3>,
    direction: Vec<DVec3>,
    image: Vec<DVec3>,
    /// By point: J z and J x.
    moved: Vec<DVec3>,
    solution_moved: Vec<DVec3>,
    /// By hair: whether its step is no longer changed.
    frozen: Vec<bool>,
}

/// The system at one shape, and the memory for the next.
pub(super) struct LinearModel {
    parts: Vec<Part>,
    /// By hair.
    pub(super) damping: Vec<f64>,
    /// Stiffness per length (N/m²) that holds the points of each hair where they are, in the model alone.
    pub(super) drag: Vec<f64>,
    /// D by point (N/m).
    own: Vec<Symmetric>,
    /// J p by point (m), and K J p (N).
    motion: Vec<DVec3>,
    forces: Vec<DVec3>,
}

/// When the linear system is solved.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinearRule {
    /// Norm of the residual over the first.
    pub(super) reduction: f64,
    pub(super) most: usize,
    pub(super) least: usize,
}

impl LinearModel {
    pub(super) fn new(head: &Head<'_>) -> Self {
        let layout = &head.layout;
        let part = |strands: &Range<usize>| {
            let joints = layout.joints(strands.end - 1).end - layout.joints(strands.start).start;
            let zeros = || vec![DVec3::ZERO; joints];
            let points = || vec![DVec3::ZERO; joints + strands.len()];
            Part {
                strands: strands.clone(),
                factors: vec![JointFactor::default(); joints],
                residual: zeros(),
                solution: zeros(),
                preconditioned: zeros(),
                direction: zeros(),
                image: zeros(),
                moved: points(),
                solution_moved: points(),
                frozen: vec![false; strands.len()],
            }
        };
        let points = layout.point_count();
        Self {
            parts: parallel::map_slice(layout.chunks(), part),
            damping: vec![0.0; layout.strands()],
            drag: vec![0.0; layout.strands()],
            own: vec![Symmetric::default(); points],
            motion: vec![DVec3::ZERO; points],
            forces: vec![DVec3::ZERO; points],
        }
    }

    /// Takes over the stiffness of the interaction at an evaluated shape.
    pub(super) fn linearise(&mut self, interaction: &mut dyn Interaction, state: &State) {
        self.own.fill(Symmetric::default());
        interaction.linearise(&state.points, &mut self.own);
    }

    /// Factorises at the same shape.
    pub(super) fn factorise(&mut self, head: &Head<'_>, state: &State) {
        let layout = &head.layout;
        let damping = layout.by_strand(&mut self.damping);
        // Only D is of the interaction alone: what is outside of hairs is in M and in H alike.
        let (own, drag) = (&self.own, &self.drag);
        let mut work: Vec<_> = self.parts.iter_mut().zip(damping).collect();
        parallel::for_each_mut(&mut work, |_, (part, damping)| {
            let mut stiffness = Vec::new();
            let first = layout.joints(part.strands.start).start;
            for (strand, damping) in part.strands.clone().zip(damping.iter_mut()) {
                let (joints, points) = (layout.joints(strand), layout.points(strand));
                stiffness.clear();
                stiffness.extend_from_slice(&own[points]);
                head.add_outside_stiffness(strand, state, &mut stiffness);
                if drag[strand] > 0.0 {
                    for (k, sum) in stiffness.iter_mut().enumerate().skip(1) {
                        *sum += Symmetric::identity(drag[strand] * head.chains[strand].at(k).1);
                    }
                }
                let factors = &mut part.factors[joints.start - first..joints.end - first];
                let weaker = SHRINKAGE * *damping;
                *damping = if weaker < LEAST_DAMPING { 0.0 } else { weaker };
                // A pivot that is not a number is not less than anything: hence the negated comparison.
                while *damping < MOST_DAMPING
                    && !(head.factorise(strand, state, &stiffness, *damping, factors) > LEAST_PIVOT)
                {
                    *damping = (GROWTH * *damping).max(FIRST_DAMPING);
                }
            }
        });
    }

    /// Solves `H x = −g` for the step x (rad), as well as `rule` says. Hairs in a direction of
    /// which the Hessian is not positive are taken out.
    pub(super) fn solve(
        &mut self,
        head: &Head<'_>,
        interaction: &mut dyn Interaction,
        gradient: &[DVec3],
        rule: LinearRule,
    ) {
        let layout = &head.layout;
        parallel::for_each_mut(&mut self.parts, |_, part| {
            part.begin(layout.joints(part.strands.start).start, gradient);
        });
        self.motion.fill(DVec3::ZERO);
        let (mut first, mut before, mut step) = (0.0, f64::INFINITY, None);
        // Preconditioned conjugate gradients, [Nocedal & Wright] algorithm 5.3; r is the residual −g − H x.
        for iteration in 0..=rule.most {
            // 1. x and r along the direction of before; z = M⁻¹ r, and r·z.
            let product = self.residual(head, step);
            first = if iteration == 0 { product } else { first };
            let small = product <= rule.reduction * rule.reduction * first;
            if iteration == rule.most || (iteration >= rule.least && small) {
                return;
            }
            // 2. p = z + β p with β = (r·z)/(r·z of before): zero after the first, and where hairs were taken out.
            let beta = product / before;
            before = product;
            // 3. The step to the minimum along p is (r·z)/(pᵀ H p), if the energy curves upwards there.
            let curvature = self.turn(head, interaction, beta);
            step = if curvature > 0.0 {
                Some(product / curvature)
            } else {
                if self.hold(head) == 0 {
                    return;
                }
                before = f64::INFINITY;
                None
            };
        }
    }

    /// Takes a step along the direction, if there is one, and preconditions the residual. Returns r·z.
    fn residual(&mut self, head: &Head<'_>, step: Option<f64>) -> f64 {
        let layout = &head.layout;
        let Self { parts, own, motion, forces, .. } = self;
        let mut work: Vec<_> = parts.iter_mut().zip(layout.by_point(forces)).collect();
        let products = parallel::map_mut(&mut work, |_, (part, forces)| {
            let first = layout.points(part.strands.start).start;
            let points = first..first + forces.len();
            if let Some(step) = step {
                part.advance(head, step, (&motion[points.clone()], forces), &own[points]);
            }
            part.precondition(head)
        });
        products.iter().sum()
    }

    /// The next direction. Returns its `pᵀ H p`.
    fn turn(&mut self, head: &Head<'_>, interaction: &mut dyn Interaction, beta: f64) -> f64 {
        let layout = &head.layout;
        let Self { parts, own, motion, forces, .. } = self;
        let mut work: Vec<_> = parts.iter_mut().zip(layout.by_point(motion)).collect();
        let curvatures = parallel::map_mut(&mut work, |_, (part, motion)| {
            let first = layout.points(part.strands.start).start;
            part.turn(beta, motion, &own[first..first + motion.len()])
        });
        curvatures.iter().sum::<f64>() + interaction.product(motion, forces)
    }

    /// Takes hairs out of the system whose part `pᵀ H p` of a direction is negative, of those the worst, and holds them back the next
    /// time. Returns how many.
    fn hold(&mut self, head: &Head<'_>) -> usize {
        let layout = &head.layout;
        let Self { parts, own, motion, forces, drag, .. } = self;
        let curvatures: Vec<Vec<(f64, f64)>> = parallel::map_slice(parts, |part| {
            let mut joint = 0;
            let of_strand = |strand: usize| {
                let n = layout.joints(strand).len();
                let of = joint..joint + n;
                joint += n;
                let products = part.direction[of.clone()].iter().zip(&part.image[of]);
                let mut curvature: f64 = products.map(|(p, q)| p.dot(*q)).sum();
                // (p_i)ᵀ (H p)_i, and ∫ |u|² ds for the stiffness per length that makes up for it.
                let mut square = 0.0;
                for (k, at) in layout.points(strand).enumerate() {
                    let u = motion[at];
                    curvature += u.dot(forces[at] - own[at] * u);
                    square += u.length_squared() * head.chains[strand].at(k).1;
                }
                (curvature, square)
            };
            part.strands.clone().map(of_strand).collect()
        });
        let worst = curvatures.iter().flatten().map(|of| of.0).fold(0.0, f64::min);
        let mut count = 0;
        for ((part, curvatures), drag) in
            parts.iter_mut().zip(curvatures).zip(layout.by_strand(drag))
        {
            for ((frozen, (curvature, square)), drag) in
                part.frozen.iter_mut().zip(curvatures).zip(drag)
            {
                if curvature < 0.1 * worst && !*frozen {
                    *frozen = true;
                    *drag += HOLD * -curvature / square;
                    count += 1;
                }
            }
        }
        count
    }

    /// Puts the step of each hair (rad) into `step`, and how far (m) its points move and its joints turn (rad) at most into `far`.
    pub(super) fn step(&self, head: &Head<'_>, step: &mut [DVec3], far: &mut [(f64, f64)]) {
        let layout = &head.layout;
        let far = layout.by_strand(far);
        let most =
            |values: &[DVec3]| values.iter().map(|v| v.length_squared()).fold(0.0, f64::max).sqrt();
        let mut work: Vec<_> = layout.by_joint(step).into_iter().zip(far).collect();
        parallel::for_each_mut(&mut work, |index, (step, far)| {
            let part = &self.parts[index];
            let (mut joint, mut point) = (0, 0);
            for (strand, far) in part.strands.clone().zip(far.iter_mut()) {
                let n = layout.joints(strand).len();
                let x = &part.solution[joint..joint + n];
                *far = (most(&part.solution_moved[point..=point + n]), most(x));
                step[joint..joint + n].copy_from_slice(x);
                (joint, point) = (joint + n, point + n + 1);
            }
        });
    }
}

impl Part {
    fn begin(&mut self, first: usize, gradient: &[DVec3]) {
        let n = self.residual.len();
        for (residual, g) in self.residual.iter_mut().zip(&gradient[first..first + n]) {
            *residual = -*g;
        }
        for zero in [&mut self.solution, &mut self.direction, &mut self.image] {
            zero.fill(DVec3::ZERO);
        }
        self.solution_moved.fill(DVec3::ZERO);
        self.frozen.fill(false);
    }

    /// Goes `step` along the direction: x, J x and r. `motion` is J p and `forces` K J p, which becomes K J p − D J p.
    fn advance(
        &mut self,
        head: &Head<'_>,
        step: f64,
        (motion, forces): (&[DVec3], &mut [DVec3]),
        own: &[Symmetric],
    ) {
        for ((force, own), motion) in forces.iter_mut().zip(own).zip(motion) {
            *force -= *own * *motion;
        }
        for (moved, motion) in self.solution_moved.iter_mut().zip(motion) {
            *moved += *motion * step;
        }
        for (x, p) in self.solution.iter_mut().zip(&self.direction) {
            *x += *p * step;
        }
        for (r, image) in self.residual.iter_mut().zip(&self.image) {
            *r -= *image * step;
        }
        // H p = M p + Jᵀ (K − D) J p: the second part goes from points to joints along each hair.
        let (mut joint, mut point) = (0, 0);
        for strand in self.strands.clone() {
            let n = head.layout.joints(strand).len();
            subtract_gradient(
                &self.factors[joint..joint + n],
                &forces[point..=point + n],
                step,
                &mut self.residual[joint..joint + n],
            );
            (joint, point) = (joint + n, point + n + 1);
        }
    }

    /// z and J z. Returns r·z.
    fn precondition(&mut self, head: &Head<'_>) -> f64 {
        let (mut joint, mut point) = (0, 0);
        for (strand, frozen) in self.strands.clone().zip(&self.frozen) {
            let n = head.layout.joints(strand).len();
            let z = &mut self.preconditioned[joint..joint + n];
            let moved = &mut self.moved[point..=point + n];
            if *frozen {
                self.residual[joint..joint + n].fill(DVec3::ZERO);
                z.fill(DVec3::ZERO);
                moved.fill(DVec3::ZERO);
            } else {
                solve(&self.factors[joint..joint + n], &self.residual[joint..joint + n], z, moved);
            }
            (joint, point) = (joint + n, point + n + 1);
        }
        self.residual.iter().zip(&self.preconditioned).map(|(r, z)| r.dot(*z)).sum()
    }

    /// The next direction p = z + β p, with J p and M p. Returns `pᵀ M p − (J p)ᵀ D J p`.
    fn turn(&mut self, beta: f64, motion: &mut [DVec3], own: &[Symmetric]) -> f64 {
        let mut curvature = 0.0;
        for (((p, image), z), r) in (self.direction.iter_mut().zip(&mut self.image))
            .zip(&self.preconditioned)
            .zip(&self.residual)
        {
            *p = *z + *p * beta;
            // M p = M z + β M p of before, and M z = r.
            *image = *r + *image * beta;
            curvature += p.dot(*image);
        }
        for ((motion, moved), own) in motion.iter_mut().zip(&self.moved).zip(own) {
            *motion = *moved + *motion * beta;
            curvature -= motion.dot(*own * *motion);
        }
        curvature
    }
}
