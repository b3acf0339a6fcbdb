//! Guides coming to rest, on all cores.

use frisure_rod::{Equilibrium, Options, Resolution, Stability, equilibrium, equilibrium_from};
use rayon::prelude::*;

use crate::contact::BodyContact;
use crate::guides::Guide;
use crate::head::Head;
use crate::monitor::{Cancelled, Monitor, Stage};
use crate::spec::{Body, HairstyleSpec};

/// Most elements of a guide, whatever accuracy is asked for.
const MOST_ELEMENTS: usize = 512;

/// Stiffnesses of the body, as fractions of its own: the first while gravity is turned on.
const HARDNESS: [f64; 3] = [0.0016, 0.04, 1.0];

/// Depth (m) in the body beyond which another way out is sought.
const DEEPEST: f64 = 3e-4;

/// Relative gradient at which a guide is at rest.
const TOLERANCE: f64 = 1e-8;

/// Most iterations at each step: contact comes and goes, so it can take hundreds.
const MAX_ITERATIONS: usize = 1000;

/// Brings every guide to rest.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    monitor: &dyn Monitor,
) -> Result<Vec<Equilibrium>, Cancelled> {
    let stage = Stage::new(monitor, "settling guides", guides.len());
    guides
        .par_iter()
        .map(|guide| {
            stage.check()?;
            let rest = settle_one(spec, head, guide);
            stage.advance();
            Ok(rest)
        })
        .collect()
}

fn settle_one(spec: &HairstyleSpec, head: &Head, guide: &Guide) -> Equilibrium {
    let options = Options {
        resolution: spec.equilibrium.resolution,
        element: spec.equilibrium.element,
        max_elements: MOST_ELEMENTS,
        tolerance: TOLERANCE,
        max_iterations: MAX_ITERATIONS,
        estimate_error: false,
        eigenvalue: false,
        ..Options::default()
    };
    if spec.contact.body == Body::None {
        return equilibrium(&guide.rod, &[], &options);
    }
    // Extrapolation needs a smooth answer, and contact comes and goes: the division that the
    // accuracy takes without contact is taken over.
    let elements = match spec.equilibrium.resolution {
        Resolution::Elements(n) => n,
        Resolution::Accuracy(_)
            if 4 * spec.equilibrium.element.resolving_elements(&guide.rod) > MOST_ELEMENTS =>
        {
            MOST_ELEMENTS
        }
        Resolution::Accuracy(_) => equilibrium(&guide.rod, &[], &options).elements,
    };
    let options = Options { resolution: Resolution::Elements(elements), ..options };
    // On a soft body the branch of gravity is followed in a fifth of the iterations; from one
    // hardness to the next the answer is near. But hair can sink into a soft ear and stay there.
    let rest = harden(spec, head, guide, &options, &HARDNESS);
    if depth(head, &rest) <= DEEPEST {
        return rest;
    }
    let hard = harden(spec, head, guide, &options, &HARDNESS[HARDNESS.len() - 1..]);
    if depth(head, &hard) < depth(head, &rest) { hard } else { rest }
}

/// Settles a guide on ever harder bodies, each from the shape on the one before.
fn harden(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    options: &Options,
    hardness: &[f64],
) -> Equilibrium {
    let contact = |hardness: f64| {
        let stiffness = spec.contact.stiffness * hardness;
        BodyContact::new(head, spec.contact.body, stiffness, guide.clearance)
    };
    let first = equilibrium(&guide.rod, &[&contact(hardness[0])], options);
    hardness[1..].iter().fold(first, |softer, &hardness| {
        let mut next = equilibrium_from(&guide.rod, &[&contact(hardness)], options, &softer);
        next.certificate.iterations += softer.certificate.iterations;
        next
    })
}

/// Deepest that a node of a guide, other than its root, is inside the body (m); 0 if none is.
fn depth(head: &Head, guide: &Equilibrium) -> f64 {
    let inside = |p: &glam::DVec3| -head.signed_distance().value(*p);
    guide.shape.positions.iter().skip(1).map(inside).fold(0.0, f64::max)
}

/// How a set of guides came to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SettlingReport {
    /// Number of guides.
    pub guides: usize,
    /// Those at a minimum of their energy.
    pub stable: usize,
    /// Those at a saddle.
    pub saddles: usize,
    /// Those that did not come to rest.
    pub not_converged: usize,
    /// Iterations of the minimiser, of all guides.
    pub iterations: usize,
    /// Elements, of all guides.
    pub elements: usize,
    /// Largest relative gradient.
    pub gradient_norm: f64,
    /// Deepest that a guide is inside the body (m); 0 if none is.
    pub penetration: f64,
    /// Energies of all guides (J).
    pub energy: frisure_rod::Energy,
}

impl SettlingReport {
    pub(crate) fn new(head: &Head, guides: &[Equilibrium]) -> Self {
        let mut report = Self { guides: guides.len(), ..Self::default() };
        for guide in guides {
            let c = &guide.certificate;
            match c.stability {
                Stability::Stable => report.stable += 1,
                Stability::Saddle => report.saddles += 1,
                Stability::NotConverged => report.not_converged += 1,
            }
            report.iterations += c.iterations;
            report.elements += guide.elements;
            report.gradient_norm = report.gradient_norm.max(c.gradient_norm);
            report.energy.elastic += guide.energy.elastic;
            report.energy.gravity += guide.energy.gravity;
            report.energy.external += guide.energy.external;
        }
        report.penetration =
            guides.par_iter().map(|guide| depth(head, guide)).reduce(|| 0.0, f64::max);
        report
    }
}
