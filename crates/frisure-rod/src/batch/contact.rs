//! What rods of a batch can be in contact with: the interface that a caller implements.

use glam::{DMat3, DVec3};

/// Contact of rods with bodies and with their neighbours.
pub trait ContactField: Sync {
    /// The tube that neighbours leave to the rod of an index at arc length `s` (m).
    fn confinement(&self, rod: usize, s: f64) -> ConfinementTube {
        let _ = (rod, s);
        ConfinementTube::UNBOUNDED
    }

    /// Any other contact at arc length `s` (m), with the rod there at `position` (m, world).
    fn contact(&self, rod: usize, s: f64, position: DVec3) -> Contact;
}

/// Contact at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// None, nor anywhere within this distance (m).
    Clear(f64),
    /// A contact energy with its derivatives.
    Active {
        /// Energy per length of rod (J/m).
        energy: f64,
        /// Its gradient by the position (J/m²).
        gradient: DVec3,
        /// Its symmetric Hessian (J/m³).
        hessian: DMat3,
    },
}

/// A ball in which a point of a rod is free of its neighbours; along the rod, a tube.
///
/// At the distance e beyond it they push back with the energy `k e³/6ρ` per length of rod: softly at first, as
/// fibres do (van Wyk 1946), and with the stiffness k one radius ρ beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfinementTube {
    /// Its centre (m, world).
    pub centre: DVec3,
    /// ρ (m).
    pub radius: f64,
    /// k (N/m²): force per length of rod and per distance.
    pub stiffness: f64,
    /// Distance (m) from the centre within which there is no other contact; negative if none is known.
    pub clearance: f64,
}

impl ConfinementTube {
    /// No confinement.
    pub const UNBOUNDED: Self =
        Self { centre: DVec3::ZERO, radius: f64::INFINITY, stiffness: 0.0, clearance: -1.0 };
}
