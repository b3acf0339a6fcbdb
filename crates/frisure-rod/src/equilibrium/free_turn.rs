//! The turn that costs a rod nothing: a round straight one in loads that are the same all around its root's tangent, such
//! as its weight if it is clamped upright.

use glam::{DQuat, DVec2, DVec3};

use crate::chain::{Chain, Shape};
use crate::minimise::Problem;
use crate::rod::Rod;
use crate::strain::NaturalStrain;

/// Relative difference up to which stiffnesses are the same: a hundred times the rounding of f64.
const SAME_STIFFNESS: f64 = 1e-14;

/// Relative difference up to which energies are the same: rounding of a sum over elements, as in the minimiser, times a
/// hundred.
const SAME_ENERGY: f64 = 1e-12;

/// Distance of the tip from the axis over the length, below which a turn leaves a rod where it is. Chosen: above
/// rounding, below any accuracy.
const STRAIGHT: f64 = 1e-9;

/// Turn (rad) at which the energy is compared. Chosen: no simple part of a whole turn.
const TRIAL: f64 = 1.0;

/// Whether a shape may turn about the tangent of its root freely, and is moved by it.
pub(super) fn turns_freely(problem: &Problem<'_>, shape: &Shape) -> bool {
    let (chain, rod) = (problem.chain(), problem.chain().rod());
    let stiffness = rod.stiffness();
    let round = (stiffness.x - stiffness.y).abs() <= SAME_STIFFNESS * stiffness.x;
    // A natural torsion turns the section alone, which is round.
    let straight = match rod.natural() {
        NaturalStrain::Uniform(strain) => strain.x == 0.0 && strain.y == 0.0,
        NaturalStrain::Varying(_) => false,
    };
    if !round || !straight || across(rod, shape).length() <= STRAIGHT * rod.length() {
        return false;
    }
    let (here, there) = (problem.energy(shape), problem.energy(&turned(chain, shape, TRIAL)));
    let scale = here.elastic.abs() + here.gravity.abs() + here.external.abs();
    (here.total() - there.total()).abs() <= SAME_ENERGY * scale
}

/// From the axis to the tip (m), in the root's section.
fn across(rod: &Rod, shape: &Shape) -> DVec2 {
    let tip = shape.positions[shape.positions.len() - 1] - rod.root().position();
    (rod.root().frame().transpose() * tip).truncate()
}

/// A shape turned about the tangent of its root by an angle (rad).
fn turned(chain: &Chain<'_>, shape: &Shape, angle: f64) -> Shape {
    // All directors turn about the axis, and back about their tangents, so that the root stays clamped: the strain κ1, κ2
    // turns in the section.
    let turn = DQuat::from_rotation_z(angle);
    let turned = |control: &DVec3| turn * *control;
    chain.shape(shape.controls.iter().map(turned).collect())
}

/// A shape turned freely until its tip is on the same side of the axis as that of another division.
pub(super) fn turned_towards(chain: &Chain<'_>, shape: &Shape, other: &Shape) -> Shape {
    let (from, to) = (across(chain.rod(), shape), across(chain.rod(), other));
    turned(chain, shape, from.perp_dot(to).atan2(from.dot(to)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ElementKind, Load, Material, RodSpec, Root, Section, TorsionConstant};

    fn rod(tangent: DVec3, natural: DVec3) -> Rod {
        Rod::new(RodSpec {
            length: 0.15,
            section: Section::circular(35e-6).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::Uniform(natural),
            root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(0.6, 0.8, 0.0)).unwrap(),
            load: Load::down(9.81),
        })
        .unwrap()
    }

    #[test]
    fn a_round_straight_rod_turns_freely_about_the_vertical() {
        for (up, twist) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 30.0)] {
            let rod = rod(DVec3::Z * up, DVec3::Z * twist);
            for kind in [ElementKind::Helix, ElementKind::Jointed] {
                let chain = Chain::uniform(&rod, kind, 5);
                let problem = Problem::new(&chain, &[]);
                // The control of a joint has no natural part.
                let own = chain.natural_shape().controls[0];
                let bent = |x, y| chain.shape(vec![own + DVec3::new(x, y, 0.0); 5]);
                let (one, other) = (bent(0.2, -0.1), bent(-0.05, 0.12));
                assert!(turns_freely(&problem, &one));
                assert!(!turns_freely(&problem, &chain.natural_shape()));
                let turned = turned_towards(&chain, &one, &other);
                let [a, b] = [&turned, &other].map(|shape| across(&rod, shape));
                assert!(a.perp_dot(b).abs() < 1e-15 && a.dot(b) > 0.0);
                let energy = |shape: &Shape| problem.energy(shape).total();
                assert!((energy(&turned) / energy(&one) - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_leaning_or_curled_rod_does_not() {
        let leaning = rod(DVec3::new(1e-6, 0.0, 1.0), DVec3::ZERO);
        let curled = rod(DVec3::Z, DVec3::X * 1e-3);
        for rod in [leaning, curled] {
            let chain = Chain::uniform(&rod, ElementKind::Helix, 5);
            let bent = chain.shape(vec![DVec3::new(0.2, -0.1, 0.0); 5]);
            assert!(!turns_freely(&Problem::new(&chain, &[]), &bent));
        }
    }
}
