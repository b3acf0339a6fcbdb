//! A hair as a chain of joints, for one hair; what the sweeps then do is the same for all.
//!
//! An element is two pieces of the natural helix, A and B, and a joint between them (see
//! [`crate::element`]). Weight alone sees nothing of a frame but ζ, which way up is in it. Between joints
//! ζ turns by constant matrices C = B A⁺ (⁺: of the next element), so that the hair is ζ⁺ = Cᵀ y,
//! y = exp(−\[c\]) ζ, and its energy Σ ½ cᵀ K c + y·a: all that hangs from a joint hangs in its frame from an
//! arm a, to which what the next element's first piece bears belongs too.

use glam::{DMat3, DVec3};

use crate::element::helix_piece;
use crate::{NaturalStrain, Rod};

/// A hair divided into joints.
#[derive(Clone, Debug, Default)]
pub(super) struct Joints {
    /// C after each joint but the last; one for all if they are alike.
    pub(super) turns: Vec<DMat3>,
    /// a (N m).
    pub(super) arms: Vec<DVec3>,
    /// From each joint to the next, the last to the tip (m), in the frame after the joint.
    pub(super) links: Vec<DVec3>,
    /// The halves of each element, before and after its joint; those of one for all if they are alike.
    halves: Vec<[Piece; 2]>,
    /// Where (m) it is rooted, and the clamp's frame.
    pub(super) root: (DVec3, DMat3),
    /// The frame before the first joint, and where that is (m).
    pub(super) frame: DMat3,
    pub(super) start: DVec3,
    /// Length of an element (m).
    pub(super) h: f64,
    /// ζ before the first joint.
    pub(super) up: DVec3,
    /// K (N m).
    pub(super) stiffness: DVec3,
    /// What no joint can change (J).
    pub(super) constant: f64,
}

/// Half of an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) turn: DMat3,
    /// What it adds to the arm of the joint: how far (m) it goes, and the first moment (m²).
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
    /// Divides a hair into `n` elements, in place of what was divided before.
    ///
    /// # Panics
    /// If there are no elements.
    pub(super) fn divide(&mut self, rod: &Rod, n: usize) {
        assert!(n > 0, "a hair has at least one element");
        let h = rod.length() / n as f64;
        let half = 0.5 * h;
        let weight = rod.weight();
        self.h = h;
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
                let mut pieces = rod.natural().means(half).map(|strain| Piece::of(strain, half));
                let mut piece = || pieces.next().expect("they do not end");
                self.halves.extend((0..n).map(|_| [piece(), piece()]));
                false
            }
        };
        self.stiffness = rod.stiffness() / h;
        let mut before: Option<Piece> = None;
        for i in 0..n {
            let [first, second] = *self.halves(i);
            // The weight (N) of all that hangs beyond the element.
            let hanging = weight * h * (n - 1 - i) as f64;
            let bears = first.advance * (hanging + weight * half) + first.moment * weight;
            match before {
                None => {
                    let (position, clamp) = self.root;
                    self.constant = (clamp * bears).z;
                    self.frame = clamp * first.turn;
                    self.start = position + clamp * first.advance;
                    self.up = self.frame.transpose() * DVec3::Z;
                }
                Some(before) => {
                    if i == 1 || !uniform {
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

    /// The half of each element after its joint; one for all if they are alike.
    pub(super) fn seconds(&self) -> impl Iterator<Item = &Piece> {
        self.halves.iter().map(|[_, second]| second)
    }

    /// C after a joint.
    pub(super) fn turn(&self, joint: usize) -> &DMat3 {
        if self.turns.len() == 1 { &self.turns[0] } else { &self.turns[joint] }
    }
}
