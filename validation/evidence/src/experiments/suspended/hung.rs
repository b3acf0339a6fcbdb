//! One suspended hair and the shape that it takes.

use frisure::rod::{Stability, equilibrium};
use glam::DVec3;

use crate::Stopped;
use crate::experiments::buckling::hanging_curl;
use crate::rods::{LENGTH, to_accuracy};

/// EI/GJ of the rods.
pub(super) const B: f64 = 1.5;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Phase {
    Planar,
    Local,
    Global,
}

/// A hair of the diagram.
pub(super) struct Hung {
    pub(super) gamma: f64,
    pub(super) kappa: f64,
    pub(super) line: Vec<DVec3>,
    pub(super) stable: bool,
}

impl Hung {
    pub(super) fn new(gamma: f64, kappa: f64) -> Result<Self, Stopped> {
        let rod = hanging_curl(gamma, kappa).rod()?;
        let found = equilibrium(&rod, &[], &to_accuracy(&rod, 1e-4));
        let line = found.centre_line(2001).iter().map(|p| *p / LENGTH).collect();
        let stable = found.certificate.stability == Stability::Stable;
        Ok(Self { gamma, kappa, line, stable })
    }

    pub(super) fn leaves(&self) -> bool {
        self.line.iter().any(|p| !(p.y.abs() <= 1e-3))
    }

    /// The helix is global if the hair between 5 and 25 % of its length descends by less than 0.95 of its arc length.
    pub(super) fn phase(&self) -> Phase {
        let upper = &self.line[100..500];
        let descent = (upper[0].z - upper[upper.len() - 1].z) * 2000.0 / (upper.len() - 1) as f64;
        match self.leaves() {
            false => Phase::Planar,
            true if descent < 0.95 => Phase::Global,
            true => Phase::Local,
        }
    }
}
