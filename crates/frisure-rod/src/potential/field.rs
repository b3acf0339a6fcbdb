//! The energy of a rod in a field in space, such as contact with a body.

use glam::{DMat3, DVec3};

use super::term::{Derivatives, ElementState, NodeState, Potential};
use crate::chain::{Chain, Shape};
use crate::rotation::{cross_matrix, scaled_identity, symmetric_outer};

/// An energy per length of rod, as a function of where that piece of the rod is.
pub trait Field: Sync {
    /// Energy per length (J/m) of the rod at arc length `s` (m) and `position` (m, world).
    fn energy(&self, s: f64, position: DVec3) -> f64;

    /// Gradient (J/m²) and symmetric Hessian (J/m³) of [`Self::energy`] by the position; `None`
    /// where both vanish.
    fn derivatives(&self, s: f64, position: DVec3) -> Option<(DVec3, DMat3)>;
}

/// `∫ field ds` along a rod, by the trapezoidal rule on evenly spaced points.
///
/// The points are the nodes and `samples − 1` more inside each element, so that a field with
/// details finer than an element is seen; the root, which is clamped, is left out.
#[derive(Clone, Copy, Debug)]
pub struct FieldPotential<'a, F: ?Sized> {
    field: &'a F,
    samples: u32,
}

impl<'a, F: Field + ?Sized> FieldPotential<'a, F> {
    /// The integral with `samples` points per element; at least one.
    #[must_use]
    pub fn new(field: &'a F, samples: u32) -> Self {
        Self { field, samples: samples.max(1) }
    }

    /// Fraction of the element, and arc length (m), of each point inside an element.
    fn inside(&self, element: &ElementState<'_>) -> impl Iterator<Item = (f64, f64)> {
        // The nodes are terms of their own (k = 0 and k = samples), each evaluated once.
        let (samples, start, h) = (self.samples, element.end - element.length, element.length);
        (1..samples).map(move |k| {
            let x = f64::from(k) / f64::from(samples);
            (x, start + x * h)
        })
    }
}

impl<F: Field + ?Sized> Potential for FieldPotential<'_, F> {
    fn depends_on_position(&self) -> bool {
        true
    }

    fn element_energy(&self, element: &ElementState<'_>) -> f64 {
        let weight = element.length / f64::from(self.samples);
        let energy = |(x, s)| self.field.energy(s, element.point(x));
        self.inside(element).map(energy).sum::<f64>() * weight
    }

    fn add_element_derivatives(&self, element: &ElementState<'_>, sum: &mut Derivatives) {
        // A point inside an element depends on its frame, its position and its control: no more than an element's own energy may.
        let weight = element.length / f64::from(self.samples);
        for (x, s) in self.inside(element) {
            if let Some((gradient, hessian)) = self.field.derivatives(s, element.point(x)) {
                element.add_point_derivatives(x, gradient * weight, &(hessian * weight), sum);
            }
        }
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        self.field.energy(node.s, node.position) * node.weight / f64::from(self.samples)
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        if let Some((gradient, hessian)) = self.field.derivatives(node.s, node.position) {
            let weight = node.weight / f64::from(self.samples);
            sum.position += gradient * weight;
            sum.position_position += hessian * weight;
        }
    }

    fn on_pieces(&self) -> Option<Box<dyn Potential + '_>> {
        Some(Box::new(FieldOnPieces(FieldPotential { field: self.field, samples: self.samples })))
    }
}

/// A [`FieldPotential`] on a rod whose jointed elements are in pieces, with the points and weights of the whole elements.
struct FieldOnPieces<'a, F: ?Sized>(FieldPotential<'a, F>);

impl<F: Field + ?Sized> FieldOnPieces<'_, F> {
    /// Length (m) that each point inside a whole element stands for.
    fn weight(&self, piece: &ElementState<'_>) -> f64 {
        2.0 * piece.length / f64::from(self.0.samples)
    }

    /// Fraction of the piece, and arc length (m), of each point inside the whole element, the joint's own in the first half.
    fn inside(&self, piece: &ElementState<'_>) -> impl Iterator<Item = (f64, f64)> {
        let (samples, start, half) = (self.0.samples, piece.end - piece.length, piece.length);
        let which = piece.index % 3;
        (1..samples).filter_map(move |k| {
            let x = 2.0 * f64::from(k) / f64::from(samples);
            let x = match which {
                0 if x <= 1.0 => x,
                2 if x > 1.0 => x - 1.0,
                _ => return None,
            };
            Some((x, start + x * half))
        })
    }

    /// The node of the whole elements, with the length that it stands for (m): twice that of a node of halves.
    fn whole(node: &NodeState) -> Option<NodeState> {
        (node.index.is_multiple_of(3)).then_some(NodeState { weight: 2.0 * node.weight, ..*node })
    }
}

impl<F: Field + ?Sized> Potential for FieldOnPieces<'_, F> {
    fn depends_on_position(&self) -> bool {
        true
    }

    fn element_energy(&self, piece: &ElementState<'_>) -> f64 {
        let energy = |(x, s)| self.0.field.energy(s, piece.point(x));
        self.inside(piece).map(energy).sum::<f64>() * self.weight(piece)
    }

    fn add_element_derivatives(&self, piece: &ElementState<'_>, sum: &mut Derivatives) {
        let weight = self.weight(piece);
        for (x, s) in self.inside(piece) {
            if let Some((gradient, hessian)) = self.0.field.derivatives(s, piece.point(x)) {
                piece.add_point_derivatives(x, gradient * weight, &(hessian * weight), sum);
            }
        }
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        Self::whole(node).map_or(0.0, |node| self.0.node_energy(&node))
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        if let Some(node) = Self::whole(node) {
            self.0.add_node_derivatives(&node, sum);
        }
    }
}

impl Chain<'_> {
    /// The points (m) of a shape at which [`FieldPotential`] with `samples` points per element evaluates its
    /// field, from the first after the root to the tip.
    #[must_use]
    pub fn sample_points(&self, shape: &Shape, samples: u32) -> Vec<DVec3> {
        let samples = samples.max(1);
        let mut points = Vec::with_capacity(self.len() * samples as usize);
        for i in 0..self.len() {
            let element = self.element_state(shape, i);
            points.extend((1..samples).map(|k| element.point(f64::from(k) / f64::from(samples))));
            points.push(shape.positions[i + 1]);
        }
        points
    }
}

impl ElementState<'_> {
    /// Position (m) of the rod at the fraction `x`, 0 to 1, of the element's length. The joint of a
    /// jointed element is at one half.
    #[must_use]
    #[inline]
    pub fn point(&self, x: f64) -> DVec3 {
        self.position + self.frame * self.motion.plain_part(x)
    }

    /// Adds the derivatives of an energy of [`Self::point`] with this gradient (J/m) and Hessian
    /// (J/m²) by the position.
    pub fn add_point_derivatives(
        &self,
        x: f64,
        gradient: DVec3,
        hessian: &DMat3,
        sum: &mut Derivatives,
    ) {
        // 1. The point r = r₀ + ξ + R exp[η] p(c + x): ∂r/∂ξ = I, ∂r/∂η = −R [p]×, ∂r/∂c = R P. (E6)
        let part = self.motion.part(x);
        let (p, by_control) = (part.value(), part.jacobian());
        let pull = self.frame.transpose() * gradient;
        let (slope, curvature) = part.contracted(pull);
        let turned = cross_matrix(p);
        let inside = self.frame.transpose() * *hessian;
        let local = inside * self.frame;
        // [p]×ᵀ = −[p]×, which absorbs the signs below.
        let local_control = local * by_control;

        // 2. Gradient by ξ, η and x.
        sum.position += gradient;
        sum.rotation += p.cross(pull);
        sum.control += slope;
        // 3. Hessian: that of the field through ∂r, and the gradient contracted with the second derivatives of r.
        sum.position_position += *hessian;
        sum.rotation_position += turned * inside;
        sum.rotation_rotation += turned * local * turned * -1.0 + symmetric_outer(pull, p) * 0.5
            - scaled_identity(pull.dot(p));
        sum.rotation_control += turned * local_control - cross_matrix(pull) * by_control;
        sum.position_control += self.frame * local_control;
        sum.control_control += by_control.transpose() * local_control + curvature;
    }
}
