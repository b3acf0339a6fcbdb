//! The penalty energy of the body.

use frisure_rod::potential::{Derivatives, NodeState, Potential};
use glam::{DMat3, DVec3};

use super::{Clearance, outer};
use crate::head::{Head, Sphere};
use crate::spec::Body;

/// `½ k d²` per length of hair, d the depth of a node in the body thickened by the clearance.
#[derive(Clone, Copy, Debug)]
pub struct BodyContact<'a> {
    head: &'a Head,
    body: Body,
    stiffness: f64,
    clearance: Clearance,
}

impl<'a> BodyContact<'a> {
    /// Contact of one guide with a head; `stiffness` per length of hair (Pa).
    #[must_use]
    pub fn new(head: &'a Head, body: Body, stiffness: f64, clearance: Clearance) -> Self {
        Self { head, body, stiffness, clearance }
    }

    /// Calls `touch` with the depth (m, positive), its gradient and its Hessian (1/m), for each
    /// part of the body that the node is in.
    fn for_each_depth(&self, node: &NodeState, mut touch: impl FnMut(f64, DVec3, DMat3)) {
        let keep = self.clearance.at(node.s);
        match self.body {
            Body::None => {}
            Body::Spheres => {
                for sphere in self.head.spheres() {
                    if let Some((depth, gradient, hessian)) = sphere_depth(sphere, keep, node) {
                        touch(depth, gradient, hessian);
                    }
                }
            }
            Body::SignedDistance => {
                let field = self.head.signed_distance();
                let (distance, gradient, hessian) = field.value_gradient_hessian(node.position);
                if distance < keep {
                    touch(keep - distance, -gradient, hessian * -1.0);
                }
            }
        }
    }
}

/// Depth of a node in a sphere grown by `keep`, with derivatives.
fn sphere_depth(sphere: &Sphere, keep: f64, node: &NodeState) -> Option<(f64, DVec3, DMat3)> {
    let away = node.position - sphere.centre;
    let distance = away.length();
    let depth = sphere.radius + keep - distance;
    if !(depth > 0.0 && distance > 0.0) {
        return None;
    }
    let normal = away / distance;
    let hessian = (outer(normal, normal) - DMat3::IDENTITY) * (1.0 / distance);
    Some((depth, -normal, hessian))
}

impl Potential for BodyContact<'_> {
    fn depends_on_position(&self) -> bool {
        self.body != Body::None
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        let mut energy = 0.0;
        self.for_each_depth(node, |depth, _, _| energy += 0.5 * depth * depth);
        energy * self.stiffness * node.weight
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        let k = self.stiffness * node.weight;
        self.for_each_depth(node, |depth, gradient, hessian| {
            sum.position += gradient * (k * depth);
            sum.position_position += outer(gradient, gradient) * k + hessian * (k * depth);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_agree_with_differences() {
        let head = Head::mannequin();
        let clearance = Clearance { full: 0.01, rise: 0.05 };
        let p = head.landmarks().whorl + DVec3::new(0.003, 0.001, 0.002);
        let node = |p: DVec3| NodeState {
            index: 1,
            s: 0.04,
            weight: 0.01,
            position: p,
            frame: DMat3::IDENTITY,
        };
        for body in [Body::Spheres, Body::SignedDistance] {
            let contact = BodyContact::new(&head, body, 100.0, clearance);
            let mut at = Derivatives::ZERO;
            contact.add_node_derivatives(&node(p), &mut at);
            assert!(contact.node_energy(&node(p)) > 0.0, "{body:?}");
            for axis in 0..3 {
                let mut h = DVec3::ZERO;
                h[axis] = 1e-6;
                let slope =
                    (contact.node_energy(&node(p + h)) - contact.node_energy(&node(p - h))) / 2e-6;
                let scale = at.position.length();
                assert!((slope - at.position[axis]).abs() < 1e-5 * scale, "{body:?}");
                let (mut up, mut down) = (Derivatives::ZERO, Derivatives::ZERO);
                contact.add_node_derivatives(&node(p + h), &mut up);
                contact.add_node_derivatives(&node(p - h), &mut down);
                let column = (up.position - down.position) / 2e-6;
                let error = (column - at.position_position.col(axis)).length();
                assert!(error < 1e-3 * at.position_position.col(axis).length(), "{body:?} {error}");
            }
        }
    }
}
