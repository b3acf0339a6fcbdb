//! frisure's times and errors: the hairs in a batch, and one by one.

use std::hint::black_box;

use frisure::rod::batch::{Batch, BatchSolution};
use frisure::rod::{ElementKind, Options, Resolution, Rod, Stability, equilibrium};
use glam::DVec3;
use serde::Serialize;

use crate::cpu;
use crate::hairs::LENGTH;

/// Distance from the true tip, over the length, beyond which a hair is in another equilibrium.
const ELSEWHERE: f64 = 0.1;

/// Elements tried.
const ELEMENTS: [usize; 14] = [6, 8, 10, 12, 15, 20, 24, 30, 40, 60, 90, 120, 180, 240];

/// Requested accuracies (m) of the scalar solver.
const ACCURACIES: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// One method at one resolution.
#[derive(Debug, Serialize)]
pub(crate) struct Measured {
    /// Name of the method.
    way: &'static str,
    /// Elements, or the requested accuracy (m).
    setting: f64,
    /// Distance of the one hair's tip from the true one (m).
    error_one: f64,
    /// Processor time (s) of the one hair alone.
    seconds_one: f64,
    /// Number of hairs.
    hairs: usize,
    /// Number of them without a certificate of a minimum.
    failed: usize,
    /// Number of them at another equilibrium.
    elsewhere: usize,
    /// Distance of each tip from the true one (m).
    errors: Vec<f64>,
    /// Processor time (s) per hair of the many.
    seconds_many: f64,
}

/// One hair and many hairs, each with its true tip.
pub(crate) struct Sample {
    pub(crate) one: (Rod, DVec3),
    pub(crate) rods: Vec<Rod>,
    pub(crate) tips: Vec<DVec3>,
}

/// The result of a hair: its tip (m), and whether its certificate states a minimum.
type End = (DVec3, bool);

impl Sample {
    /// All methods at all resolutions; `quick` runs each once, for a test.
    pub(crate) fn measure(&self, quick: bool) -> Vec<Measured> {
        let mut found = Vec::new();
        let cut = if quick { 4 } else { ELEMENTS.len() };
        for elements in &ELEMENTS[..cut] {
            let batch = Batch { elements: *elements, ..Batch::default() };
            let tips = |rods: &[Rod]| ends(&batch, rods);
            found.push(self.run("side by side", *elements as f64, self.rods.len(), quick, tips));
            let tips = |rods: &[Rod]| extrapolated(&batch, rods);
            let way = "side by side, extrapolated";
            found.push(self.run(way, *elements as f64, self.rods.len(), quick, tips));
        }
        for accuracy in &ACCURACIES[..cut.min(ACCURACIES.len())] {
            let tips = |rods: &[Rod]| rods.iter().map(|rod| alone(rod, *accuracy)).collect();
            // These are slow, so fewer hairs are enough.
            let few = self.rods.len().min(100);
            found.push(self.run("one by one, to an accuracy", *accuracy, few, quick, tips));
        }
        found
    }

    fn run(
        &self,
        way: &'static str,
        setting: f64,
        hairs: usize,
        quick: bool,
        tips: impl Fn(&[Rod]) -> Vec<End>,
    ) -> Measured {
        let one = std::slice::from_ref(&self.one.0);
        let error_one = tips(one)[0].0.distance(self.one.1);
        let rods = &self.rods[..hairs];
        let ends = tips(rods);
        let errors: Vec<f64> =
            ends.iter().zip(&self.tips).map(|(end, tip)| end.0.distance(*tip)).collect();
        let (runs, least) = if quick { (1, 0.0) } else { (5, 0.02) };
        let work = |rods: &[Rod]| drop(black_box(tips(black_box(rods))));
        Measured {
            way,
            setting,
            error_one,
            seconds_one: cpu::middle(runs, least, || work(one)),
            hairs,
            failed: ends.iter().filter(|end| !end.1).count(),
            elsewhere: errors.iter().filter(|e| **e > ELSEWHERE * LENGTH).count(),
            errors,
            seconds_many: cpu::middle(runs, 2.0 * least, || work(rods)) / hairs as f64,
        }
    }
}

fn ends(batch: &Batch, rods: &[Rod]) -> Vec<End> {
    let rest = batch.solve(rods);
    let end = |(hair, rod): (usize, &Rod)| end(&rest, rod, hair);
    rods.iter().enumerate().map(end).collect()
}

fn end(rest: &BatchSolution, rod: &Rod, hair: usize) -> End {
    let tip = rest.shape(rod, hair).positions[rest.elements];
    (tip, rest.rods[hair].stability == Stability::Stable)
}

/// Richardson's extrapolation of the tip from `elements` and twice as many, which start from the coarse equilibrium.
fn extrapolated(batch: &Batch, rods: &[Rod]) -> Vec<End> {
    let coarse = batch.solve(rods);
    let halves = coarse.controls.iter().flat_map(|turn| [*turn * 0.5; 2]).collect();
    let fine = Batch { elements: 2 * batch.elements, ..*batch }.solve_from(rods, halves);
    let both = |(hair, rod): (usize, &Rod)| {
        let ((a, first), (b, second)) = (end(&coarse, rod, hair), end(&fine, rod, hair));
        ((b * 4.0 - a) / 3.0, first && second)
    };
    rods.iter().enumerate().map(both).collect()
}

fn alone(rod: &Rod, accuracy: f64) -> End {
    let options = Options {
        resolution: Resolution::Accuracy(accuracy),
        element: ElementKind::Jointed,
        eigenvalue: false,
        ..Options::default()
    };
    let rest = equilibrium(rod, &[], &options);
    (rest.tip(), rest.certificate.stability == Stability::Stable)
}
