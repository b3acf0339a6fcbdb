//! How the guides came to rest, in numbers.

use frisure_rod::potential::YieldState;
use frisure_rod::{AccuracyStatus, Stability};

use super::fields::depth;
use super::lock;
use crate::hairstyle::{Hairstyle, JointCertificate, Rest};
use crate::head::Head;
use crate::parallel;

/// How a set of guides came to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SettlingReport {
    /// Number of guides.
    pub guides: usize,
    /// Those at a minimum of their energy among all others.
    pub stable: usize,
    /// Those at a saddle.
    pub saddles: usize,
    /// Those at a minimum or a saddle, which their divisions cannot tell apart.
    pub undecided: usize,
    /// Those that did not come to rest.
    pub not_converged: usize,
    /// Those whose division misses a requested accuracy, measured without contact.
    pub accuracy_missed: usize,
    /// Iterations of the minimiser, of all guides.
    pub iterations: usize,
    /// Sweeps over all guides in which wisps made way for each other.
    pub sweeps: usize,
    /// Elements, of all guides.
    pub elements: usize,
    /// Largest relative gradient.
    pub gradient_norm: f64,
    /// Deepest that a guide is inside the body (m); 0 if none is.
    pub penetration: f64,
    /// Energies of all guides (J). What a pair of wisps pays for overlapping is counted once.
    pub energy: frisure_rod::Energy,
    /// What was checked of all guides together; none where each was settled while the others held still.
    pub joint: Option<JointCertificate>,
    /// Largest |f_t| / μ f_n of any guide, friction over what the law allows: at most 1 but for the agreement of normal forces
    /// and shape; 0 where no friction was felt. docs/theory.md (F3)
    pub friction: f64,
    /// How the hairs inside wisps hold: the largest moment over that at which they slip, and the share of the length where it is
    /// reached; zeros where they slide freely.
    pub lock: YieldState,
}

/// Reports how the guides of a hairstyle came to rest on its head.
#[must_use]
pub fn settling_report(hairstyle: &Hairstyle, head: &Head) -> SettlingReport {
    let Rest { guides, overlap_energy, sweeps, joint, friction, .. } = &hairstyle.rest;
    let locks: Vec<YieldState> = lock::states(&hairstyle.rest).collect();
    let mut report = SettlingReport {
        guides: guides.len(),
        sweeps: *sweeps,
        joint: *joint,
        friction: friction.iter().copied().fold(0.0, f64::max),
        lock: YieldState {
            ratio: locks.iter().map(|lock| lock.ratio).fold(0.0, f64::max),
            slipping: locks.iter().fold(0.0, |sum, lock| sum + lock.slipping)
                / locks.len().max(1) as f64,
        },
        ..SettlingReport::default()
    };
    for guide in guides {
        let c = &guide.certificate;
        match c.stability {
            Stability::Stable => report.stable += 1,
            Stability::Saddle => report.saddles += 1,
            Stability::Undecided => report.undecided += 1,
            Stability::NotConverged => report.not_converged += 1,
        }
        report.accuracy_missed += usize::from(c.accuracy == AccuracyStatus::Missed);
        report.iterations += c.iterations;
        report.elements += guide.elements;
        report.gradient_norm = report.gradient_norm.max(c.gradient_norm);
        report.energy.elastic += guide.energy.elastic;
        report.energy.gravity += guide.energy.gravity;
        report.energy.external += guide.energy.external;
    }
    // Each guide counts the energy that it shares with other wisps in full.
    report.energy.external -= overlap_energy;
    let depths = parallel::map_slice(guides, |guide| depth(head, guide));
    report.penetration = depths.into_iter().fold(0.0, f64::max);
    report
}
