//! A hair as a chain of joints, for one hair; what the sweeps then do is the same for all.
//!
//! An element is two pieces of the natural helix, A and B, and a joint between them (see
//! [`crate::element`]). Weight alone sees nothing of a frame but ζ, which way up is in it. Between joints
//! ζ turns by constant matrices C = B A⁺ (⁺: of the next element), so that the hair is ζ⁺ = Cᵀ y,
//! y = exp(−\[c\]) ζ, and its energy Σ ½ cᵀ K c + y·a: all that hangs from a joint hangs in its frame from an
//! arm a, to which what the next element's first piece bears belongs too.

use glam::{DMat3, DVec3};

use crate::Rod;
use crate::element::helix_piece;

/// A hair divided into joints.
#[derive(Clone, Debug, Default)]
pub(super) struct Joints {
    /// C after each joint but the last; one for all if they are alike.
    pub(super) turns: Vec<DMat3>,
    /// a (N m).
    pub(super) arms: Vec<DVec3>,
    /// From each joint to the next, the last to the tip (m), in the frame after the joint.
    pub(super) links: Vec<DVec3>,
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
#[derive(Clone, Copy)]
struct Piece {
    turn: DMat3,
    /// What it adds to the arm of the joint: how far (m) it goes, and the first moment (m²).
    advance: DVec3,
    moment: DVec3,
}

impl Piece {
    fn of(strain: DVec3, half: f64) -> Self {
        let (turn, advance, moment) = helix_piece(strain * half, half);
        Self { turn, advance, moment }
    }
}

impl Joints {
    /// Divides a hair into `n` elements.
    pub(super) fn divide(&mut self, rod: &Rod, n: usize) {
        let h = rod.length() / n as f64;
        let half = 0.5 * h;
        let (natural, weight) = (rod.natural(), rod.weight());
        let uniform = matches!(natural, crate::NaturalStrain::Uniform(_));
        let piece = |k: usize| {
            let from = k as f64 * half;
            let strain = if uniform { natural.at(0.0) } else { natural.mean(from, from + half) };
            Piece::of(strain, half)
        };
        let alike = uniform.then(|| piece(0));
        self.h = h;
        self.turns.clear();
        self.arms.clear();
        self.links.clear();
        self.stiffness = rod.stiffness() / h;
        let mut before: Option<Piece> = None;
        for i in 0..n {
            let [first, second] = [2 * i, 2 * i + 1].map(|k| alike.unwrap_or_else(|| piece(k)));
            // The weight (N) of all that hangs beyond the element.
            let hanging = weight * h * (n - 1 - i) as f64;
            let bears = first.advance * (hanging + weight * half) + first.moment * weight;
            match before {
                None => {
                    let clamp = rod.root().frame();
                    self.constant = (clamp * bears).z;
                    self.frame = clamp * first.turn;
                    self.start = rod.root().position() + clamp * first.advance;
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

    /// C after a joint.
    pub(super) fn turn(&self, joint: usize) -> &DMat3 {
        if self.turns.len() == 1 { &self.turns[0] } else { &self.turns[joint] }
    }
}
