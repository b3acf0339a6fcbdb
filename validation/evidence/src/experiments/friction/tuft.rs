//! A brush that a plate compresses and lets go again.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicU64, Ordering};

use frisure::hairstyle::FrictionalRod;
use frisure::hairstyle::contact::{FrictionSurface, Pressed};
use frisure::rod::potential::{Field, FieldPotential};
use frisure::rod::{Load, NaturalStrain, Rod, Root, equilibrium};
use glam::{DMat3, DVec3};

use super::fibre::{at_rest, fibre, options};
use crate::extremes::{largest, smallest};
use crate::plot::{Mark, Plot, Scale};
use crate::random::stream;
use crate::{Effort, Finding, Limit, Stopped, Table};

/// Length (m) of the hairs of the brush.
const LENGTH: f64 = 0.01;

/// How far (m) the plate goes down from where the brush begins, and in how many steps.
const WAY: f64 = 2e-3;

/// A hard plate that faces down at a height (m) which changes between steps of the load.
struct Plate {
    stiffness: f64,
    coefficient: f64,
    /// The bits of the height.
    height: AtomicU64,
}

impl Plate {
    fn depth(&self, p: DVec3) -> f64 {
        p.z - f64::from_bits(self.height.load(Ordering::Relaxed))
    }

    fn go_to(&self, height: f64) {
        self.height.store(height.to_bits(), Ordering::Relaxed);
    }
}

impl Field for Plate {
    fn energy(&self, _: f64, p: DVec3) -> f64 {
        0.5 * self.stiffness * self.depth(p).max(0.0).powi(2)
    }

    fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let (k, depth) = (self.stiffness, self.depth(p));
        (depth > 0.0).then(|| (DVec3::Z * (k * depth), DMat3::from_diagonal(DVec3::Z * k)))
    }
}

impl FrictionSurface for Plate {
    fn pressed(&self, _: f64, p: DVec3) -> Option<Pressed> {
        let limit = self.coefficient * self.stiffness * self.depth(p);
        (limit > 0.0).then_some(Pressed { normal: DVec3::NEG_Z, limit })
    }
}

/// Hairs that stand on a plane, each leaning another way by 20° to 40°.
fn brush(count: usize) -> Result<Vec<Rod>, Stopped> {
    let hair = |index: usize| {
        let mut random = stream(11, index);
        let (lean, about) = (random.between(20.0, 40.0).to_radians(), random.between(0.0, TAU));
        let out = DVec3::new(about.cos(), about.sin(), 0.0);
        let root = Root::from_tangent(DVec3::ZERO, out * lean.sin() + DVec3::Z * lean.cos(), out)?;
        Ok(fibre(LENGTH, 35e-6, Load::NONE, NaturalStrain::STRAIGHT, root)?)
    };
    (0..count).map(hair).collect()
}

/// Force (N) with which a plate presses on a hair at each of the heights (m), one after the other.
fn forces(rod: &Rod, coefficient: f64, heights: &[f64]) -> Result<Vec<f64>, Stopped> {
    let (options, samples) = (options(20), 8);
    let spacing = LENGTH / f64::from(20 * samples);
    let start = equilibrium(rod, &[], &options);
    let height = AtomicU64::new(LENGTH.to_bits());
    let plate = Plate { stiffness: 1e5, coefficient, height };
    let mut pressed = FrictionalRod::new(rod, &plate, samples, options, &start);
    let force = |height: &f64| {
        plate.go_to(*height);
        pressed.step(&[&FieldPotential::new(&plate, samples)]);
        at_rest(pressed.rest())?;
        let points = pressed.rest().chain().sample_points(&pressed.rest().shape, samples);
        let last = points.len() - 1;
        let at = |(k, p): (usize, &DVec3)| {
            let share = if k == last { 0.5 } else { 1.0 };
            plate.depth(*p).max(0.0) * plate.stiffness * spacing * share
        };
        Ok(points.iter().enumerate().map(at).sum())
    };
    heights.iter().map(force).collect()
}

/// Height (m) over force (N) of a whole brush, down and up again.
fn cycle(hairs: usize, coefficient: f64, steps: u32) -> Result<Vec<(f64, f64)>, Stopped> {
    let top = LENGTH * 20.0_f64.to_radians().cos();
    let down = (0..=steps).map(|k| top - WAY * f64::from(k) / f64::from(steps));
    let heights: Vec<f64> = down.clone().chain(down.rev().skip(1)).collect();
    let mut all = vec![0.0; heights.len()];
    for rod in brush(hairs)? {
        for (sum, force) in all.iter_mut().zip(forces(&rod, coefficient, &heights)?) {
            *sum += force;
        }
    }
    Ok(heights.into_iter().zip(all).collect())
}

/// Work (J) over the way down, and what is lost of it over the cycle, by trapezia.
fn works(cycle: &[(f64, f64)]) -> [f64; 2] {
    let work = |path: &[(f64, f64)]| -> f64 {
        path.windows(2).map(|p| 0.5 * (p[0].1 + p[1].1) * (p[0].0 - p[1].0)).sum()
    };
    [work(&cycle[..=cycle.len() / 2]), work(cycle)]
}

/// Adds the table, the plot and the criteria of the brush.
pub(super) fn add(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let coefficients: &[f64] = effort.pick(&[0.0, 0.1, 0.3], &[0.0, 0.05, 0.1, 0.2, 0.3, 0.4]);
    let (hairs, steps) = effort.pick((2, 10), (12, 40));
    let mut table = Table::new(
        "A brush under a plate that goes down by a fifth of its height and up again",
        &["μ", "work on the way down (µJ)", "lost (µJ)", "share lost"],
    );
    let mut plot = Plot::new(
        "Force of a plate on a brush, down and up",
        "way of the plate (mm)",
        "force (mN)",
        [Scale::Linear; 2],
    );
    let mut shares = Vec::new();
    for &coefficient in coefficients {
        let cycle = cycle(hairs, coefficient, steps)?;
        let [work, lost] = works(&cycle);
        let top = cycle[0].0;
        let points = cycle.iter().map(|(height, force)| (1e3 * (top - height), 1e3 * force));
        plot.add(&format!("μ = {coefficient}"), Mark::Line, points);
        table.row([
            format!("{coefficient}"),
            format!("{:.4}", 1e6 * work),
            format!("{:.4}", 1e6 * lost),
            format!("{:.4}", lost / work),
        ]);
        shares.push(lost / work);
    }
    finding.table(table);
    finding.plot(plot);
    finding.check(
        "brush: share of the work that is lost without friction",
        shares[0].abs(),
        Limit::AtMost(1e-6),
    );
    let rises = || shares.windows(2).map(|pair| pair[1] - pair[0]);
    finding.check(
        "brush: least rise of that share from one coefficient to the next",
        smallest(rises()),
        Limit::AtLeast(1e-3),
    );
    finding.check("brush: largest share", largest(shares.iter().copied()), Limit::AtMost(1.0));
    Ok(())
}
