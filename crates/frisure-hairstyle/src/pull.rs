//! What a comb or a clip pulls at a guide with.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

/// A pull at a guide, as an energy per length of hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pull {
    /// A comb: the same force on every length of hair, energy `−f·r`.
    Comb {
        /// Force per length (N/m).
        force: DVec3,
    },
    /// A clip: a short piece of hair is held at a point, energy `½ c |r − p|²`.
    Clip {
        /// Arc length (m) at which the piece begins and ends.
        piece: [f64; 2],
        /// The point p (m).
        point: DVec3,
        /// Stiffness c (Pa).
        stiffness: f64,
    },
}

impl Pull {
    /// The same, so many times as strong.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Comb { force } => Self::Comb { force: force * factor },
            Self::Clip { piece, point, stiffness } => {
                Self::Clip { piece, point, stiffness: stiffness * factor }
            }
        }
    }
}

impl Field for Pull {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        match *self {
            Self::Comb { force } => -force.dot(p),
            Self::Clip { piece: [from, to], point, stiffness } => {
                let held = (from..=to).contains(&s);
                if held { 0.5 * stiffness * p.distance_squared(point) } else { 0.0 }
            }
        }
    }

    fn derivatives(&self, s: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        match *self {
            Self::Comb { force } => Some((-force, DMat3::ZERO)),
            Self::Clip { piece: [from, to], point, stiffness } => (from..=to)
                .contains(&s)
                .then(|| ((p - point) * stiffness, DMat3::IDENTITY * stiffness)),
        }
    }
}
