//! Friction and cohesion against closed forms, and what a combed head keeps.

mod combed;
mod fibre;
mod lock;
mod plate;
mod tuft;

use std::f64::consts::{FRAC_PI_2, PI};

use frisure::hairstyle::FrictionalRod;
use frisure::hairstyle::capillary::{Coalescence, Liquid};
use frisure::progress::Progress;
use frisure::rod::potential::FieldPotential;
use frisure::rod::{
    ElementKind, Load, NaturalStrain, Options, Resolution, Root, StrainProfile, equilibrium,
    equilibrium_from,
};
use glam::DVec3;

use self::fibre::{at_rest, fibre, options};
use super::surfaces::{Form, Ground, Push, StickyPlane};
use crate::experiment::check;
use crate::extremes::{largest, smallest};
use crate::finding::{Finding, Limit, Table};
use crate::{Effort, Experiment, Stopped};

pub(super) const EXPERIMENT: Experiment = Experiment {
    name: "friction",
    title: "Friction and cohesion",
    question: "Does hair stick up to Coulomb's limit and slip at it, does wet hair meet where the balance of bending and surface \
               tension says, and does combed hair hold the better the higher the friction?",
    method: "Incline: a straight fibre lies along a plane and slides down sideways. It bends as a cantilever under what friction \
             leaves of its weight, w (sin α − μ cos α), so its tip moves by a known length. Where it has not \
             slipped, near the clamp, it gives way as a spring: some 1e-3 of the way. Its weight comes at once, and in 2 to 16 steps.\n\n\
             Capstan: a light fibre lies around a quarter of a cylinder, drawn at both ends. It slips at the ratio of tensions \
             exp(μφ) (Euler, Eytelwein). The tension grows in steps, and the experiment asks between which two it slips.\n\n\
             Plate: a fibre that is pressed on a plate is pulled along it. It slips at μ times the force that the plate presses back with.\n\n\
             Zipper: a fibre that sticks to a plane lifts off where l⁴ = 9 EI d²/G, with the energy G of water between two fibres, \
             each of which has half of the way. The plane attracts within a fiftieth of that way.\n\n\
             Brush: hairs that lean every way stand on a plane, and a plate goes down on them by a fifth of their height and up again. They touch the plate, not \
             each other. What is lost of its work has no closed form; it has to be nothing without friction and to grow with it.\n\n\
             Lock: the hairs of a wisp stick to each other and slip as it bends. A level cantilever with that yield is bent to and fro by a light load. What it loses \
             over the cycle is 4 m_y (e − m_y/K_f) per length where hairs slip, with the bend e = (qξ²/2 − m_y)/K at ξ from the tip, and the set of the tip that is left \
             when the load is taken off has a closed form, too.\n\n\
             Head: a comb draws 40 wisps back and lets them go, on six heads. How much of the way that it moved the tips is left has no closed \
             form; it has to be nothing without friction and to grow with it. Hair of 6 cm has the same with friction inside wisps alone.",
    run,
};

fn run(effort: Effort, progress: &dyn Progress) -> Result<Finding, Stopped> {
    let mut finding = Finding::default();
    incline(&mut finding, effort)?;
    halved_steps(&mut finding, effort)?;
    check(progress, EXPERIMENT.name, 0.2)?;
    capstan(&mut finding, effort)?;
    plate::add(&mut finding, effort)?;
    check(progress, EXPERIMENT.name, 0.4)?;
    zipper(&mut finding, effort)?;
    check(progress, EXPERIMENT.name, 0.5)?;
    tuft::add(&mut finding, effort)?;
    lock::add(&mut finding, effort)?;
    check(progress, EXPERIMENT.name, 0.6)?;
    combed::add(&mut finding, effort, progress)?;
    combed::add_locks(&mut finding, effort, progress)?;
    Ok(finding)
}

/// A fibre that slides down an incline.
struct Slide {
    /// How far its tip goes (m), and how far a cantilever's would.
    moved: f64,
    expected: f64,
    /// Largest friction over its limit.
    ratio: f64,
}

/// A fibre of the weight at `gravity` (m/s²) on a plane inclined by `angle` (rad).
fn slide(gravity: f64, angle: f64, coefficient: f64) -> Result<Slide, Stopped> {
    let (length, gravity) = (0.2, Load::down(gravity));
    let normal = DVec3::new(0.0, angle.sin(), angle.cos());
    let ground = Ground { stiffness: 50.0, coefficient, form: Form::Plane(normal) };
    let lying = |depth: f64, load| {
        let root = Root::from_tangent(normal * -depth, DVec3::X, normal)?;
        fibre(length, 1e-4, load, NaturalStrain::STRAIGHT, root)
    };
    // The root is as deep as the fibre sinks in, so that it does not bend.
    let depth = lying(0.0, gravity)?.weight() * angle.cos() / ground.stiffness;
    let (rod, weightless) = (lying(depth, gravity)?, lying(depth, Load::NONE)?);
    let (options, samples) = (options(40), 32);
    let start = equilibrium(&weightless, &[], &options);
    let mut sliding = FrictionalRod::new(&rod, &ground, samples, options, &start);
    sliding.step(&[&FieldPotential::new(&ground, samples)]);
    at_rest(sliding.rest())?;
    let downhill = DVec3::new(0.0, angle.cos(), -angle.sin());
    let moved = (sliding.rest().tip() - start.tip()).dot(downhill);
    // q L⁴/8EI
    let left = rod.weight() * (angle.sin() - coefficient * angle.cos());
    let expected = left * rod.length().powi(4) / (8.0 * rod.stiffness().x);
    Ok(Slide { moved, expected, ratio: sliding.friction_ratio() })
}

/// Gravity (m/s²) in which the fibre stays nearly straight and slides by forty times the distance δ at which friction slips.
const LIGHT: f64 = 0.15;

fn incline(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let cases: &[(f64, f64)] = effort
        .pick(&[(45.0, 0.3)], &[(45.0, 0.3), (45.0, 0.1), (45.0, 0.5), (60.0, 0.3), (60.0, 0.9)]);
    let mut table = Table::new(
        "A fibre that slides down an incline",
        &["α (°)", "μ", "move of the tip over the closed form", "friction over its limit, at most"],
    );
    let (mut errors, mut ratios) = (Vec::new(), Vec::new());
    for &(degrees, coefficient) in cases {
        let Slide { moved, expected, ratio } = slide(LIGHT, degrees.to_radians(), coefficient)?;
        let moved = moved / expected;
        table.row([
            format!("{degrees:.0}"),
            format!("{coefficient}"),
            format!("{moved:.5}"),
            format!("{ratio:.4}"),
        ]);
        errors.push((moved - 1.0).abs());
        ratios.push(ratio);
    }
    finding.table(table);
    finding.check(
        "incline: relative error of the way of the tip at 45° with μ = 0.3",
        errors[0],
        Limit::AtMost(1e-3),
    );
    finding.check(
        "incline: largest relative error of the way of the tip",
        largest(errors),
        Limit::AtMost(1.5e-3),
    );
    finding.check(
        "incline: largest friction over its limit",
        largest(ratios),
        Limit::AtMost(1.001),
    );
    // On earth, a twentieth below the angle of friction and above it. Nearer to it the springs of what sticks overshoot by the clamp.
    let way = |share: f64| Ok::<_, Stopped>(slide(9.81, (share * 0.4_f64).atan(), 0.4)?.moved);
    finding.check(
        "incline: way of the tip at 0.95 of the tangent at which friction gives way (m)",
        way(0.95)?,
        Limit::AtMost(5e-5),
    );
    finding.check("incline: the same at 1.05 (m)", way(1.05)?, Limit::AtLeast(1e-3));
    Ok(())
}

/// Way (m) of the tip of a fibre that slides down an incline of 45° with μ = 0.3, when its weight comes in so many equal steps.
fn slide_in_steps(steps: u32) -> Result<f64, Stopped> {
    let (length, gravity, normal) = (0.2, 0.15, DVec3::new(0.0, 1.0, 1.0).normalize());
    let ground = Ground { stiffness: 50.0, coefficient: 0.3, form: Form::Plane(normal) };
    let root = Root::from_tangent(DVec3::ZERO, DVec3::X, normal)?;
    let rod = |load| fibre(length, 1e-4, load, NaturalStrain::STRAIGHT, root);
    let (weight, rod) = (rod(Load::down(gravity))?.weight(), rod(Load::NONE)?);
    let (options, samples) = (options(40), 32);
    let start = equilibrium(&rod, &[], &options);
    let mut sliding = FrictionalRod::new(&rod, &ground, samples, options, &start);
    for step in 1..=steps {
        let force = DVec3::NEG_Z * (weight * f64::from(step) / f64::from(steps));
        let load = Push { piece: [0.0, 2.0 * length], force };
        sliding
            .step(&[&FieldPotential::new(&ground, samples), &FieldPotential::new(&load, samples)]);
    }
    at_rest(sliding.rest())?;
    Ok((sliding.rest().tip() - start.tip()).dot(DVec3::new(0.0, 1.0, -1.0).normalize()))
}

fn halved_steps(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let counts: &[u32] = effort.pick(&[1, 4], &[1, 2, 4, 8, 16]);
    let ways = counts.iter().map(|&steps| slide_in_steps(steps)).collect::<Result<Vec<_>, _>>()?;
    let mut table = Table::new(
        "The same, as its weight comes in steps",
        &["steps", "way of the tip (mm)", "over that of the most steps"],
    );
    let last = ways[ways.len() - 1];
    for (steps, way) in counts.iter().zip(&ways) {
        table.row([format!("{steps}"), format!("{:.4}", 1e3 * way), format!("{:.5}", way / last)]);
    }
    finding.table(table);
    let changes = ways.windows(2).map(|pair| (pair[0] / pair[1] - 1.0).abs());
    finding.check(
        "incline: largest relative change of the way when steps of the load are halved",
        largest(changes),
        Limit::AtMost(0.01),
    );
    Ok(())
}

/// Farthest (m) that the end of a fibre moves while it holds, and least that it moves when it has slipped.
const STUCK: f64 = 2e-4;
const SLIPPED: f64 = 1e-2;

/// Between which ratios of tensions a light fibre around a quarter of a cylinder slips, over exp(μφ).
fn slips(coefficient: f64, shares: &[f64]) -> Result<[f64; 2], Stopped> {
    let (radius, held) = (5e-3, 0.02);
    // From the root a U-turn that gives way, a straight piece, the quarter turn downwards, a straight tail.
    let (turn, straight, tail) = (0.01, 0.02, 0.02);
    let (u, quarter) = (PI * turn, FRAC_PI_2 * radius);
    let wrap = u + straight;
    let length = wrap + quarter + tail;
    let step = |at: f64| [at - 1e-9, at + 1e-9];
    let bends = [
        (u, [-1.0 / turn, 0.0]),
        (wrap, [0.0, 1.0 / radius]),
        (wrap + quarter, [1.0 / radius, 0.0]),
    ];
    let mut knots = vec![(0.0, DVec3::NEG_X / turn)];
    for (at, [before, after]) in bends {
        let [low, high] = step(at);
        knots.extend([(low, DVec3::X * before), (high, DVec3::X * after)]);
    }
    let natural = NaturalStrain::Varying(StrainProfile::new(knots)?);
    let top = DVec3::new(-straight, 0.0, radius + 2.0 * turn);
    let root = Root::from_tangent(top, DVec3::NEG_X, DVec3::Y)?;
    let rod = fibre(length, 1e-5, Load::NONE, natural, root)?;
    let (options, samples) = (options(400), 8);
    let start = equilibrium(&rod, &[], &options);
    let ground = Ground { stiffness: 4e6, coefficient, form: Form::Cylinder(radius) };
    let count = 400 * samples;
    let spacing = length / f64::from(count);
    let mut drawn = FrictionalRod::new(&rod, &ground, samples, options, &start);
    let (before, after) = ([u + 0.005, u + 0.007], [length - 0.005, length - 0.003]);
    // The force is that of the points which the piece has.
    let push = |piece: [f64; 2], force: DVec3| {
        let inside = |k: &u32| (piece[0]..piece[1]).contains(&(f64::from(*k) * spacing));
        let points = (1..=count).filter(inside).count();
        Push { piece, force: force / (points as f64 * spacing) }
    };
    let capstan = (coefficient * FRAC_PI_2).exp();
    // Drawn tight without slip, then ever harder until it slips.
    let tight = [0.25, 0.5, 1.0].map(|share| (share, 1.0));
    let harder = shares.iter().map(|share| (1.0, share * capstan));
    let mut held_at = 0.0;
    for (tension, ratio) in tight.into_iter().chain(harder) {
        let back = push(before, DVec3::NEG_X * held * tension);
        let ahead = push(after, DVec3::NEG_Z * (held * tension * ratio));
        drawn.step(&[
            &FieldPotential::new(&ground, samples),
            &FieldPotential::new(&back, samples),
            &FieldPotential::new(&ahead, samples),
        ]);
        // What sticks gives way by the springs of friction; what slips runs until the U-turn holds it.
        let moved = drawn.rest().tip().distance(start.tip());
        if moved > STUCK {
            return Ok([held_at, if moved > SLIPPED { ratio / capstan } else { f64::NAN }]);
        }
        held_at = ratio / capstan;
    }
    Ok([held_at, f64::NAN])
}

fn capstan(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let mut table = Table::new(
        "A light fibre around a quarter of a cylinder",
        &["μ", "exp(μφ)", "holds at, over that", "slips at, over that"],
    );
    let (mut held, mut slipped) = (Vec::new(), Vec::new());
    for &coefficient in effort.pick(&[0.3][..], &[0.1, 0.3, 0.6]) {
        let [holds, slips] = slips(coefficient, &[0.8, 0.9, 0.99, 0.999, 1.001])?;
        table.row([
            format!("{coefficient}"),
            format!("{:.4}", (coefficient * FRAC_PI_2).exp()),
            format!("{holds:.3}"),
            format!("{slips:.3}"),
        ]);
        held.push(holds);
        slipped.push(slips);
    }
    finding.table(table);
    finding.check(
        "capstan: tension at which it holds, over the law",
        smallest(held),
        Limit::AtLeast(0.9989),
    );
    finding.check(
        "capstan: tension at which it slips, over the law",
        largest(slipped),
        Limit::AtMost(1.0011),
    );
    Ok(())
}

/// Where a rod that starts `height` (m) above a plane meets it, over the closed form; with `share` of the water.
fn meets(height: f64, share: f64) -> Result<f64, Stopped> {
    let (length, radius) = (0.02, 35e-6);
    let of = |load| {
        let root = Root::from_tangent(DVec3::Z * height, DVec3::X, DVec3::Y)?;
        fibre(length, radius, load, NaturalStrain::STRAIGHT, root)
    };
    let rod = of(Load::NONE)?;
    let law = Coalescence {
        spacing: 2.0 * height,
        ..Coalescence::new(Liquid::WATER, share, &rod, 1.0, 0.0)
    };
    let expected =
        law.meeting(1.0).ok_or_else(|| Stopped::Other("the law has no meeting".to_owned()))?;
    let plane = StickyPlane { adhesion: 0.5 * law.adhesion, reach: height / 50.0 };
    let field = FieldPotential::new(&plane, 2);
    let options = Options {
        element: ElementKind::Jointed,
        resolution: Resolution::Elements(800),
        max_elements: 800,
        tolerance: 1e-9,
        max_iterations: 20_000,
        longest_step: 1e-4,
        ..Options::default()
    };
    // A weight presses it on the plane before it is let go.
    let pressed = equilibrium(&of(Load::down(400.0))?, &[&field], &options);
    let rest = equilibrium_from(&rod, &[&field], &options, &pressed);
    at_rest(&rest)?;
    // A clamped beam that touches with a slope of zero is half-way down in the middle of its way.
    let line = rest.sample(2001);
    let next = line.iter().position(|(p, _)| p.z < 0.5 * height).unwrap_or(1).max(1);
    let (a, b) = (line[next - 1].0, line[next].0);
    let middle = a.x + (b.x - a.x) * (a.z - 0.5 * height) / (a.z - b.z);
    Ok(2.0 * middle / expected)
}

fn zipper(finding: &mut Finding, effort: Effort) -> Result<(), Stopped> {
    let mut table = Table::new(
        "A fibre that water draws to its neighbour",
        &[
            "distance of the roots (mm)",
            "share of the water",
            "place of meeting over the closed form",
        ],
    );
    let cases: &[(f64, f64)] = effort
        .pick(&[(7e-4, 1.0)], &[(3e-4, 1.0), (7e-4, 0.1), (7e-4, 0.5), (7e-4, 1.0), (1e-3, 1.0)]);
    let mut errors = Vec::new();
    for &(distance, share) in cases {
        let ratio = meets(0.5 * distance, share)?;
        table.row([format!("{:.1}", 1e3 * distance), format!("{share}"), format!("{ratio:.5}")]);
        errors.push((ratio - 1.0).abs());
    }
    finding.table(table);
    finding.check(
        "zipper: largest relative error of the place of meeting",
        largest(errors),
        Limit::AtMost(1e-3),
    );
    Ok(())
}
