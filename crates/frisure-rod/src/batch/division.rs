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

    /// Arm (N m) of its own weight, `weight` per length (N/m), and of what hangs from its end (N).
    fn bears(&self, hanging: f64, weight: f64) -> DVec3 {
        self.advance * hanging + self.moment * weight
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
        self.h = h;
        self.vertical = rod.up();
        self.root = (rod.root().position(), rod.root().frame());
        self.turns.clear();
        self.arms.clear();
        self.links.clear();
        self.halves.clear();
        // ½ cᵀ (K/h) c: the joint carries the bending of its whole element.
        self.stiffness = rod.stiffness() / h;
        match rod.natural() {
            NaturalStrain::Uniform(strain) => {
                self.halves.push([Piece::of(*strain, half); 2]);
                self.join_equal(rod, n);
            }
            NaturalStrain::Varying(_) => {
                // Each half has the mean natural strain of its own, as in crate::element.
                let mut pieces = rod.natural().means(half).map(|strain| Piece::of(strain, half));
                let mut piece = || pieces.next().expect("an endless iterator");
                self.halves.extend((0..n).map(|_| [piece(), piece()]));
                self.join(rod, n);
            }
        }
    }

    /// The joints between elements that differ.
    fn join(&mut self, rod: &Rod, n: usize) {
        let weight = rod.weight();
        let mut before: Option<Piece> = None;
        for i in 0..n {
            let [first, second] = self.halves[i];
            // Weight (N) of the rod beyond the element.
            let hanging = weight * self.h * (n - 1 - i) as f64;
            let bears = first.bears(hanging + weight * 0.5 * self.h, weight);
            match before {
                None => self.begin(rod, &first, bears),
                // The first piece moves rigidly with the joint before: it belongs to that joint's arm and link.
                Some(before) => {
                    // C = B A⁺. (L2)
                    self.turns.push(before.turn * first.turn);
                    self.arms[i - 1] += before.turn * bears;
                    self.links[i - 1] += before.turn * first.advance;
                }
            }
            self.arms.push(second.bears(hanging, weight));
            self.links.push(second.advance);
            before = Some(second);
        }
    }

    /// [`Self::join`] where all pieces are the same: what a joint bears grows by as much from each to the one before.
    fn join_equal(&mut self, rod: &Rod, n: usize) {
        let weight = rod.weight();
        let element = weight * self.h;
        let [piece, _] = self.halves[0];
        self.begin(rod, &piece, piece.bears(element * (n as f64 - 0.5), weight));
        if n > 1 {
            self.turns.push(piece.turn * piece.turn);
        }
        let link = piece.advance + piece.turn * piece.advance;
        // Of the weight beyond the element the next one is half a piece closer to the tip.
        let own = piece.moment * weight + piece.turn * piece.bears(-0.5 * element, weight);
        self.arms.extend((1..n).map(|i| own + link * (element * (n - i) as f64)));
        self.arms.push(piece.bears(0.0, weight));
        self.links.extend((1..n).map(|_| link));
        self.links.push(piece.advance);
    }

    /// What is before the first joint: the clamp and the piece `first` under the arm `bears` (N m), whose energy is a constant.
    fn begin(&mut self, rod: &Rod, first: &Piece, bears: DVec3) {
        let (position, clamp) = self.root;
        self.constant = (clamp * bears).dot(rod.up());
        self.frame = clamp * first.turn;
        self.start = position + clamp * first.advance;
        self.up = self.frame.transpose() * rod.up();
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
