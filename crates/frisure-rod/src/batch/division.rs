//! A rod divided into joints and rigid pieces, docs/theory.md, "Rods in lanes", (L2).
//!
//! An element is two pieces of the natural helix, A and B, and a joint between them (see [`crate::element`]). Under
//! weight alone the energy depends on a frame only through ζ, the vertical seen in it. Between joints ζ turns by the
//! constant C = B A⁺ (⁺: of the next element): `y = exp(−[c]) ζ`, `ζ⁺ = Cᵀ y`, and the energy is `Σ ½ cᵀ K c + y·a`.
//! The arm a collects the weight of everything beyond the joint that moves rigidly with it, up to the next joint.

use glam::{DMat3, DVec3};

use crate::element::helix_piece;
use crate::rod::Rod;
use crate::strain::NaturalStrain;

/// A rod divided into joints.
#[derive(Clone, Debug, Default)]
pub(super) struct Joints {
    /// C after each joint but the last; one for all if they are equal.
    pub(super) turns: Vec<DMat3>,
    /// a: arm (N m) of the weight that each joint bears, in the frame after it.
    pub(super) arms: Vec<DVec3>,
    /// From each joint to the next, the last to the tip (m), in the frame after the joint.
    pub(super) links: Vec<DVec3>,
    /// The halves of each element, before and after its joint; those of one for all if they are equal.
    halves: Vec<[Piece; 2]>,
    /// Position (m) and frame of the clamp.
    pub(super) root: (DVec3, DMat3),
    /// Frame and position (m) before the first joint.
    pub(super) frame: DMat3,
    pub(super) start: DVec3,
    /// Length of an element (m).
    pub(super) h: f64,
    /// e: the apparent vertical (world).
    pub(super) vertical: DVec3,
    /// ζ: the vertical in the frame before the first joint.
    pub(super) up: DVec3,
    /// K: stiffness of each joint (N m).
    pub(super) stiffness: DVec3,
    /// The part of the energy that no joint changes (J).
    pub(super) constant: f64,
}

/// Half of an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) turn: DMat3,
    /// Advance (m) and first moment (m²): its share of the arm of a joint.
    pub(super) advance: DVec3,
    moment: DVec3,
}

impl Piece {
    fn of(strain: DVec3, half: f64) -> Self {
        let (turn, advance, moment) = helix_piece(strain * half, half);
        Self { turn, advance, moment }
    }
}

impl Joints {
    /// Divides a rod into `n` elements, reusing the memory.
    ///
    /// # Panics
    /// If there are no elements.
    pub(super) fn divide(&mut self, rod: &Rod, n: usize) {
        assert!(n > 0, "a rod has at least one element");
        let h = rod.length() / n as f64;
        let half = 0.5 * h;
        let weight = rod.weight();
        self.h = h;
        self.vertical = rod.up();
        self.root = (rod.root().position(), rod.root().frame());
        self.turns.clear();
        self.arms.clear();
        self.links.clear();
        self.halves.clear();
        let uniform = match rod.natural() {
            NaturalStrain::Uniform(strain) => {
                self.halves.push([Piece::of(*strain, half); 2]);
                true
            }
            NaturalStrain::Varying(_) => {
                // Each half has the mean natural strain of its own, as in crate::element.
                let mut pieces = rod.natural().means(half).map(|strain| Piece::of(strain, half));
                let mut piece = || pieces.next().expect("an endless iterator");
                self.halves.extend((0..n).map(|_| [piece(), piece()]));
                false
            }
        };
        // ½ cᵀ (K/h) c: the joint carries the bending of its whole element.
        self.stiffness = rod.stiffness() / h;
        let mut before: Option<Piece> = None;
        for i in 0..n {
            let [first, second] = *self.halves(i);
            // Weight (N) of the rod beyond the element, and the moment arm (N m) of the first piece under it.
            let hanging = weight * h * (n - 1 - i) as f64;
            let bears = first.advance * (hanging + weight * half) + first.moment * weight;
            match before {
                // Before the first joint there is the clamp: its weight is a constant.
                None => {
                    let (position, clamp) = self.root;
                    self.constant = (clamp * bears).dot(rod.up());
                    self.frame = clamp * first.turn;
                    self.start = position + clamp * first.advance;
                    self.up = self.frame.transpose() * rod.up();
                }
                // The first piece moves rigidly with the joint before: it belongs to that joint's arm and link.
                Some(before) => {
                    if i == 1 || !uniform {
                        // C = B A⁺. (L2)
                        self.turns.push(before.turn * first.turn);
                    }
                    self.arms[i - 1] += before.turn * bears;
                    self.links[i - 1] += before.turn * first.advance;
                }
            }
            self.arms.push(second.advance * hanging + second.moment * weight);
            self.links.push(second.advance);
            before = Some(second);
        }
    }

    /// The halves of an element, before and after its joint.
    pub(super) fn halves(&self, element: usize) -> &[Piece; 2] {
        if self.halves.len() == 1 { &self.halves[0] } else { &self.halves[element] }
    }

    /// The half of each element after its joint; one for all if they are equal.
    pub(super) fn seconds(&self) -> impl Iterator<Item = &Piece> {
        self.halves.iter().map(|[_, second]| second)
    }

    /// C after a joint.
    pub(super) fn turn(&self, joint: usize) -> &DMat3 {
        if self.turns.len() == 1 { &self.turns[0] } else { &self.turns[joint] }
    }
}
