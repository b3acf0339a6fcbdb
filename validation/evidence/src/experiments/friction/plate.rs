//! A fibre that is pressed on a plate and pulled along it.

use std::f64::consts::PI;

use frisure::hairstyle::FrictionalRod;
use frisure::hairstyle::contact::FrictionSurface;
use frisure::rod::potential::FieldPotential;
use frisure::rod::{Load, NaturalStrain, Root, StrainProfile, equilibrium};
use glam::DVec3;

use super::super::surfaces::{Form, Ground, Push};
use super::fibre::{at_rest, fibre, options};
use crate::extremes::{largest, smallest};
use crate::{Effort, Finding, Limit, Stopped, Table};

/// Farthest (m) that the fibre moves while it holds, and least that it moves when it has slipped.
const STUCK: f64 = 2e-4;
const SLIPPED: f64 = 1e-3;

/// Pulls over μN that are tried.
const SHARES: [f64; 6] = [0.25, 0.5, 0.9, 0.99, 0.9995, 1.0005];

/// Between which pulls a fibre slips, over μ times the force N that the plate presses back with.
fn slips(coefficient: f64, force: f64) -> Result<[f64; 2], Stopped> {
    // From the root a U-turn that gives way, then straight along the plate.
    let (turn, straight) = (0.01, 0.06);
    let u = PI * turn;
    let length = u + straight;
    let bend = DVec3::NEG_X / turn;
    let knots = vec![(0.0, bend), (u - 1e-9, bend), (u + 1e-9, DVec3::ZERO)];
    let natural = NaturalStrain::Varying(StrainProfile::new(knots)?);
    let root = Root::from_tangent(DVec3::Z * (2.0 * turn), DVec3::NEG_X, DVec3::Y)?;
    let rod = fibre(length, 1e-5, Load::NONE, natural, root)?;
    let (options, samples) = (options(300), 8);
    let count = 300 * samples;
    let spacing = length / f64::from(count);
    let start = equilibrium(&rod, &[], &options);
    let ground = Ground { stiffness: 4e4, coefficient, form: Form::Plane(DVec3::Z) };
    let mut pulled = FrictionalRod::new(&rod, &ground, samples, options, &start);
    // At the tip, so that all of it is in tension; the pull is the force of the points that the piece has.
    let piece = [length - 0.004, length - 0.001];
    let inside = |k: &u32| (piece[0]..piece[1]).contains(&(f64::from(*k) * spacing));
    let points = f64::from(u32::try_from((1..=count).filter(inside).count()).unwrap_or(0));
    let press = Push { piece: [u + 0.01, 2.0 * length], force: DVec3::NEG_Z * force };
    let mut step = |pull: f64| {
        let pull = Push { piece, force: DVec3::X * (pull / (points * spacing)) };
        pulled.step(&[
            &FieldPotential::new(&ground, samples),
            &FieldPotential::new(&press, samples),
            &FieldPotential::new(&pull, samples),
        ]);
        let line = pulled.rest().chain().sample_points(&pulled.rest().shape, samples);
        let tip = pulled.rest().tip();
        // N: what the plate presses back with, by the rule of the potential: half a point at the tip.
        let normal = |(k, p): (usize, &DVec3)| {
            let share = if k + 1 == line.len() { 0.5 } else { 1.0 };
            ground.pressed(0.0, *p).map_or(0.0, |p| p.limit / coefficient * spacing * share)
        };
        at_rest(pulled.rest()).map(|()| (tip, line.iter().enumerate().map(normal).sum::<f64>()))
    };
    let (mut tip, mut normal) = step(0.0)?;
    let start = tip;
    let mut held = 0.0;
    for share in SHARES {
        // Of the N of the last pull: once it slips, the U-turn lifts it.
        let pull = share * coefficient * normal;
        (tip, normal) = step(pull)?;
        let moved = tip.distance(start);
        if moved > STUCK {
            return Ok([held, if moved > SLIPPED { share } else { f64::NAN }]);
        }
        held = pull / (coefficient * normal);
    }
    Ok([held, f64::NAN])
}

/// Adds the table and criteria of the plate.
pub(super) fn add(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let cases: &[(f64, f64)] =
        effort.pick(&[(0.3, 0.02)], &[(0.1, 0.02), (0.3, 0.02), (0.3, 0.2), (0.6, 0.02)]);
    let mut table = Table::new(
        "A fibre that is pressed on a plate and pulled along it",
        &["μ", "pressed with (N/m)", "holds a pull of, over μN", "slips at, over μN"],
    );
    let (mut held, mut slipped) = (Vec::new(), Vec::new());
    for &(coefficient, force) in cases {
        let [holds, slips] = slips(coefficient, force)?;
        table.row([
            format!("{coefficient}"),
            format!("{force}"),
            format!("{holds:.4}"),
            format!("{slips:.4}"),
        ]);
        held.push(holds);
        slipped.push(slips);
    }
    finding.table(table);
    finding.check("plate: pull that holds, over μN", smallest(held), Limit::AtLeast(0.999));
    finding.check("plate: pull that slips, over μN", largest(slipped), Limit::AtMost(1.001));
    Ok(())
}
