//! Jointed elements in their pieces: how a shape depends on the natural strain of each half.
//!
//! The motion of a jointed element is that of half its natural helix, its joint, and the other half. As three elements, of
//! which only the joint has stiffness, they have the same energy, and the natural strain of a half is the control of its piece
//! over h/2. So ∂²E/∂c∂u⁰ is a part of the second variation of that longer rod. docs/theory.md (D4)

use glam::DVec3;

use super::DerivativeError;
use crate::chain::Shape;
use crate::minimise::{NodeChanges, Problem, SecondVariation};
use crate::potential::Potential;

/// The second variation of a rod of jointed elements in pieces.
#[derive(Clone, Debug)]
pub(super) struct Pieces {
    variation: SecondVariation,
    /// Half the length of an element (m).
    half: f64,
    /// Natural strain of both halves of each element (rad/m).
    natural: Vec<[DVec3; 2]>,
    /// Sample points of a whole element, and so of a piece.
    samples: usize,
}

impl Pieces {
    /// At a shape, with so many sample points per element; `None` for helix elements.
    pub(super) fn new(
        problem: &Problem<'_>,
        shape: &Shape,
        samples: u32,
    ) -> Result<Option<Self>, DerivativeError> {
        let Some(chain) = problem.chain().in_pieces() else { return Ok(None) };
        let external = problem.external.iter().map(|p| p.on_pieces());
        let external: Option<Vec<_>> = external.collect();
        let external = external.ok_or(DerivativeError::JointedElements)?;
        let external: Vec<&dyn Potential> = external.iter().map(|p| &**p).collect();
        let at_rest = |i: usize| chain.geometry(i).rest();
        let controls = shape.controls.iter().enumerate();
        let controls = controls.flat_map(|(i, c)| [at_rest(3 * i), *c, at_rest(3 * i + 2)]);
        let pieces = chain.shape(controls.collect());
        let half = 0.5 * problem.chain().rod().length() / problem.chain().len() as f64;
        let natural = |i: usize| [at_rest(3 * i) / half, at_rest(3 * i + 2) / half];
        let whole = Problem {
            chain: &chain,
            gravity: problem.gravity,
            external: &external,
            with_position: problem.with_position,
        };
        Ok(Some(Self {
            variation: whole.second_variation(&pieces, samples),
            half,
            natural: (0..shape.controls.len()).map(natural).collect(),
            samples: samples as usize,
        }))
    }

    /// Natural strain of both halves of each element (rad/m).
    pub(super) fn natural(&self) -> &[[DVec3; 2]] {
        &self.natural
    }

    /// Derivative of the energy by the natural strain of both halves of each element, with the controls as they are.
    pub(super) fn energy_by_strain(&self) -> Vec<[DVec3; 2]> {
        self.halves(self.variation.gradient())
    }

    /// `∂ℓ/∂u⁰ − aᵀ ∂g/∂u⁰` of both halves of each element, from the derivatives of the loss by the nodes.
    pub(super) fn by_strain(&self, by_nodes: &NodeChanges, adjoint: &[DVec3]) -> Vec<[DVec3; 2]> {
        // 1. What halves move by themselves: only the nodes between elements count.
        let zero = (DVec3::ZERO, DVec3::ZERO);
        let spread = |(i, node): (usize, (DVec3, DVec3))| {
            let joints = if i == 0 { 0 } else { 2 };
            std::iter::repeat_n(zero, joints).chain([node])
        };
        let spread = NodeChanges::new(by_nodes.iter().enumerate().flat_map(spread));
        let direct = self.variation.by_node_changes(&spread);
        // 2. aᵀ ∂g/∂u⁰: the second variation is symmetric.
        let step = adjoint.iter().flat_map(|a| [DVec3::ZERO, *a, DVec3::ZERO]).collect::<Vec<_>>();
        let mixed = self.variation.apply(&step);
        let sum: Vec<DVec3> = direct.iter().zip(&mixed).map(|(d, m)| *d - *m).collect();
        self.halves(&sum)
    }

    /// For a change of the natural strain of both halves of each element: −∂g/∂u⁰ δu⁰ of each control (N m), and how the
    /// nodes between elements move with the controls as they are.
    pub(super) fn along(&self, change: &[[DVec3; 2]]) -> (Vec<DVec3>, NodeChanges) {
        let step = self.step(change);
        let right = self.variation.apply(&step).chunks_exact(3).map(|piece| -piece[1]).collect();
        let moved = self.variation.node_changes(&step);
        (right, NodeChanges::new(moved.iter().step_by(3)))
    }

    /// How a change of the natural strain of both halves of each element moves the sample points of whole elements (m), with the controls as they
    /// are.
    pub(super) fn displacements(&self, change: &[[DVec3; 2]]) -> Vec<DVec3> {
        let all = self.variation.displacements(&self.step(change));
        (0..self.natural.len() * self.samples).map(|point| all[self.on_piece(point)]).collect()
    }

    /// The transpose of [`Self::displacements`]: the derivative by the natural strain of both halves of each element of an energy whose derivatives by
    /// the sample points are `forces` (N).
    pub(super) fn by_forces(&self, forces: &[DVec3]) -> Vec<[DVec3; 2]> {
        assert_eq!(forces.len(), self.natural.len() * self.samples, "one force per sample point");
        let mut all = vec![DVec3::ZERO; self.variation.sample_count()];
        for (point, force) in forces.iter().enumerate() {
            all[self.on_piece(point)] = *force;
        }
        self.halves(&self.variation.by_controls(&all))
    }

    /// Which sample point of the pieces is a sample point of the whole elements: the point k of n, from 1, is the point 2 k of the first half, or
    /// 2 k − n of the second.
    fn on_piece(&self, point: usize) -> usize {
        let (element, k) = (point / self.samples, point % self.samples + 1);
        let (piece, k) = if 2 * k <= self.samples { (0, 2 * k) } else { (2, 2 * k - self.samples) };
        (3 * element + piece) * self.samples + k - 1
    }

    /// A change of natural strain as one of the controls of the pieces (rad).
    fn step(&self, change: &[[DVec3; 2]]) -> Vec<DVec3> {
        let pieces = change.iter().map(|[a, b]| [*a * self.half, DVec3::ZERO, *b * self.half]);
        pieces.flatten().collect()
    }

    fn halves(&self, by_pieces: &[DVec3]) -> Vec<[DVec3; 2]> {
        let halves = by_pieces.chunks_exact(3);
        halves.map(|piece| [piece[0] * self.half, piece[2] * self.half]).collect()
    }
}
