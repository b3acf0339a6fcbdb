//! The forward sweep: feedback laws applied to the nonlinear chain, docs/theory.md (M6).

use glam::{DMat3, DVec3};

use super::problem::Problem;
use super::riccati::FeedbackLaw;
use crate::chain::Shape;
use crate::rotation::deviation;

/// Trust region: the largest turn of one element's control in one step (rad). Chosen by trial; not measured further.
pub(super) const LARGEST_TURN: f64 = 1.0;

impl FeedbackLaw {
    /// The step x (rad) of element `i` whose start, at `from`, is now at `position` with `frame`; `fraction` of the
    /// feedforward k, the length of the step in a line search.
    #[inline]
    fn applied<const POSITION: bool>(
        &self,
        from: &Shape,
        i: usize,
        position: DVec3,
        frame: &DMat3,
        fraction: f64,
    ) -> DVec3 {
        // η of the nonlinear chain, in the old frame.
        let turned = deviation(&(from.frames[i].transpose() * *frame));
        let mut step = self.step * fraction + self.by_rotation * turned;
        if POSITION {
            step += self.by_position * (position - from.positions[i]);
        }
        // The model is quadratic in turns, which sines and cosines are not beyond about a radian.
        step.clamp_length_max(LARGEST_TURN)
    }
}

/// The shape to which the laws lead from another, and its energy (J).
pub(super) fn rollout<const POSITION: bool>(
    problem: &Problem<'_>,
    from: &Shape,
    laws: &[FeedbackLaw],
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
        let step = law.applied::<POSITION>(from, i, position, &frame, fraction);
        let control = from.controls[i] + step;
        // The control is final here, since all elements before have moved: η and ξ above are exact, not linearised. (M6)
        let element = chain.element_at(i, position, frame, control);
        position += frame * element.motion.advance();
        frame *= element.motion.rotation();
        energy += problem.step_energy(&element, position, frame);
        shape.controls.push(control);
        shape.frames.push(frame);
        shape.positions.push(position);
    }
    (shape, energy)
}

/// The change of each control (rad) in a rollout of a whole step, without its energy.
pub(super) fn rollout_steps<const POSITION: bool>(
    problem: &Problem<'_>,
    from: &Shape,
    laws: &[FeedbackLaw],
) -> Vec<DVec3> {
    let (mut frame, mut position) = (from.frames[0], from.positions[0]);
    (laws.iter().enumerate())
        .map(|(i, law)| {
            let step = law.applied::<POSITION>(from, i, position, &frame, 1.0);
            let motion = problem.chain.geometry(i).motion(from.controls[i] + step);
            if POSITION {
                position += frame * motion.advance();
            }
            frame *= motion.rotation();
            step
        })
        .collect()
}

/// The damped Newton step (rad) at a shape without feedback and by a rollout; `None` if a pivot is not positive definite.
#[cfg(test)]
pub(crate) fn damped_step(
    problem: &Problem<'_>,
    shape: &Shape,
    damping: f64,
) -> Option<[Vec<DVec3>; 2]> {
    let (laws, rollout) = if problem.with_position {
        let laws =
            super::linearise::Linearisation::<true>::new(problem, shape).sweep(damping).ok()?.laws;
        let rollout = rollout_steps::<true>(problem, shape, &laws);
        (laws, rollout)
    } else {
        let laws =
            super::linearise::Linearisation::<false>::new(problem, shape).sweep(damping).ok()?.laws;
        let rollout = rollout_steps::<false>(problem, shape, &laws);
        (laws, rollout)
    };
    Some([laws.iter().map(|law| law.step).collect(), rollout])
}
