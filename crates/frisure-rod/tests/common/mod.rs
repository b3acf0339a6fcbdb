//! Rods that several tests use.

#![allow(dead_code, reason = "each test file uses some of these")]

use frisure_rod::potential::{Derivatives, NodeState, Potential};
use frisure_rod::{Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant};
use glam::{DMat3, DVec3};

/// A 15 cm curl of radius 5 mm and pitch 10 mm, its elliptical section 80 µm wide.
pub fn curl() -> RodSpec {
    RodSpec {
        length: 0.15,
        section: Section::from_semi_axes(50e-6, 35e-6).unwrap(),
        material: Material::new(3e9, 1.1e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.005, 0.010).unwrap(),
        root: Root::from_tangent(DVec3::ZERO, DVec3::new(1.0, 0.3, 0.4), DVec3::Y).unwrap(),
        gravity: 9.81,
    }
}

/// A straight circular rod of given heaviness Γ = ρSgL³/EI, leaving along `tangent`.
pub fn straight(gamma: f64, tangent: DVec3) -> Rod {
    let section = Section::circular(40e-6).unwrap();
    let material = Material::isotropic(3e9, 0.45, 1300.0).unwrap();
    let ei = 3e9 * section.i1();
    let length = (gamma * ei / (1300.0 * section.area() * 9.81)).cbrt();
    let across = tangent.any_orthonormal_vector();
    Rod::new(RodSpec {
        length,
        section,
        material,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::STRAIGHT,
        root: Root::from_tangent(DVec3::ZERO, tangent, across).unwrap(),
        gravity: 9.81,
    })
    .unwrap()
}

/// A spring that pulls every node to a point: a user's own potential.
pub struct Spring {
    /// Stiffness per length of rod (N/m²).
    pub stiffness: f64,
    /// Where it pulls (m).
    pub anchor: DVec3,
}

impl Potential for Spring {
    fn depends_on_position(&self) -> bool {
        true
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        let away = node.position - self.anchor;
        0.5 * self.stiffness * node.weight * away.length_squared()
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        let k = self.stiffness * node.weight;
        sum.position += (node.position - self.anchor) * k;
        sum.position_position += DMat3::from_diagonal(DVec3::splat(k));
    }
}
