//! The turn about the vertical that costs a rod nothing: a round straight one, clamped upright or upside down.

use glam::{DQuat, DVec3};

use crate::chain::{Chain, Shape};
use crate::rod::Rod;
use crate::strain::NaturalStrain;

/// Relative difference up to which stiffnesses, and directions, are the same: a hundred times the rounding of f64.
const SAME: f64 = 1e-14;

/// Distance of the tip from the vertical through the root, over the length, below which a rod is upright: a turn leaves it
/// where it is. Chosen: above rounding, below any accuracy.
const UPRIGHT: f64 = 1e-9;

/// Whether a rod in its weight may turn about the vertical through its root freely.
pub(super) fn turns_freely(rod: &Rod) -> bool {
    let stiffness = rod.stiffness();
    let round = (stiffness.x - stiffness.y).abs() <= SAME * stiffness.x;
    let tangent = rod.root().frame().z_axis;
    let vertical = tangent.x.abs().max(tangent.y.abs()) <= SAME;
    // A natural torsion turns the section alone, which is round.
    let straight = match rod.natural() {
        NaturalStrain::Uniform(strain) => strain.x == 0.0 && strain.y == 0.0,
        NaturalStrain::Varying(_) => false,
    };
    round && vertical && straight
}

/// Whether a shape of such a rod is off the vertical, so that a turn moves it.
pub(super) fn is_off_the_vertical(rod: &Rod, shape: &Shape) -> bool {
    away(rod, shape).truncate().length() > UPRIGHT * rod.length()
}

/// From root to tip (m).
fn away(rod: &Rod, shape: &Shape) -> DVec3 {
    shape.positions[shape.positions.len() - 1] - rod.root().position()
}

/// A shape turned freely until its tip is in the same vertical plane as that of another division.
pub(super) fn turned_towards(chain: &Chain<'_>, shape: Shape, other: &Shape) -> Shape {
    let (from, to) = (away(chain.rod(), &shape).truncate(), away(chain.rod(), other).truncate());
    let angle = from.perp_dot(to).atan2(from.dot(to));
    // Upside down the tangent at the root is −z.
    let angle = angle * chain.rod().root().frame().z_axis.z.signum();
    // All directors turn about the vertical, and back about their tangents, so that the root stays clamped: the strain
    // κ1, κ2 turns in the section.
    let turn = DQuat::from_rotation_z(angle);
    chain.shape(shape.controls.into_iter().map(|control| turn * control).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::minimise::Problem;
    use crate::{ElementKind, Material, RodSpec, Root, Section, TorsionConstant};

    #[test]
    fn a_free_turn_costs_nothing() {
        for (up, twist) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 30.0)] {
            let rod = Rod::new(RodSpec {
                length: 0.15,
                section: Section::circular(35e-6).unwrap(),
                material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
                torsion: TorsionConstant::SaintVenant,
                natural: NaturalStrain::Uniform(DVec3::Z * twist),
                root: Root::from_tangent(DVec3::ZERO, DVec3::Z * up, DVec3::new(0.6, 0.8, 0.0))
                    .unwrap(),
                gravity: 9.81,
            })
            .unwrap();
            assert!(turns_freely(&rod));
            for kind in [ElementKind::Helix, ElementKind::Jointed] {
                let chain = Chain::uniform(&rod, kind, 5);
                let bent = |x, y| chain.shape(vec![DVec3::new(x, y, 0.15 * twist / 5.0); 5]);
                let (one, other) = (bent(0.2, -0.1), bent(-0.05, 0.12));
                let turned = turned_towards(&chain, one.clone(), &other);
                let energy = |shape: &Shape| Problem::new(&chain, &[]).energy(shape).total();
                assert!((energy(&turned) / energy(&one) - 1.0).abs() < 1e-12);
                let (a, b) = (away(&rod, &turned), away(&rod, &other));
                assert!((a.z - away(&rod, &one).z).abs() < 1e-15);
                assert!(a.truncate().perp_dot(b.truncate()).abs() < 1e-15);
                assert!(a.truncate().dot(b.truncate()) > 0.0);
            }
        }
    }
}
