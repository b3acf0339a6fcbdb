//! The room that a hair has for itself among others.

use glam::DVec3;

use super::lanes::{Lanes, Sym3, Vec3};
use super::touch::Felt;

/// A ball in which a place on a hair is left alone by its neighbours; along the hair, a tube.
///
/// At the distance e beyond it they push back with the energy `k e³/6ρ` per length of hair: softly at first, as
/// fibres do (van Wyk 1946), and with the stiffness k one radius ρ beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfinementTube {
    /// Its middle (m, world).
    pub centre: DVec3,
    /// ρ (m).
    pub radius: f64,
    /// k (N/m²): force per length of hair and per distance.
    pub stiffness: f64,
    /// A distance (m) from the middle within which nothing else is felt; negative: none is known.
    pub clearance: f64,
}

impl ConfinementTube {
    /// All the room there is.
    pub const UNBOUNDED: Self =
        Self { centre: DVec3::ZERO, radius: f64::INFINITY, stiffness: 0.0, clearance: -1.0 };
}

/// Those of the same joint of all hairs.
#[derive(Clone, Copy)]
pub(super) struct Tubes<F> {
    centre: Vec3<F>,
    radius: F,
    /// k/ρ times the length of hair that it stands for (N/m²).
    stiffness: F,
}

impl<F: Lanes> Tubes<F> {
    #[inline(always)]
    pub(super) fn none(zero: F) -> Self {
        Self { centre: Vec3::all(zero), radius: zero.all(f64::INFINITY), stiffness: zero }
    }

    /// Takes over one hair's, for `share` (m) of its length.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, tube: &ConfinementTube, share: f64) {
        self.centre.set(lane, tube.centre);
        self.radius.set(lane, tube.radius);
        self.stiffness.set(lane, tube.stiffness / tube.radius * share);
    }

    /// What hairs feel of them that are at `end` (m).
    #[inline(always)]
    pub(super) fn felt(&self, end: &Vec3<F>, nothing: &Felt<F>) -> Felt<F> {
        let away = end.minus(self.centre);
        let square = away.dot(away);
        if !F::any((self.radius * self.radius).less(square)) {
            return *nothing;
        }
        let zero = square.all(0.0);
        let distance = square.largest(square.all(1e-30)).root();
        let beyond = (distance - self.radius).largest(zero);
        let stiffness = self.stiffness * beyond;
        let force = square.all(0.5) * stiffness * beyond;
        let round = force / distance;
        let along = away.scaled(square.all(1.0) / distance);
        Felt {
            energy: square.all(1.0 / 3.0) * force * beyond,
            gradient: along.scaled(force),
            hessian: Sym3::all(zero)
                .plus_diagonal(Vec3::all(round))
                .minus_square(round - stiffness, along),
        }
    }
}
