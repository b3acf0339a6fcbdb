//! The report of `frisure predict`, and its summary.

use std::fmt::Write;

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{Body, HairContact, Hairstyle, Simulation, Volume, settling_report};
use frisure::scene::Scene;
use frisure::strands::Strands;
use frisure_engine::AdoptionReport;
use serde::Serialize;

use super::steps::StepNumbers;

/// The report; SI units. No time and no machine: the same scene gives the same bytes.
#[derive(Debug, Serialize)]
pub(super) struct Numbers {
    pub(super) scene: String,
    pub(super) hair_type: &'static str,
    seed: u64,
    pub(super) guides: Guides,
    /// How well the strands of the scene's groom were held; left out without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) groom: Option<AdoptionReport>,
    /// What had to be guessed of the head: told, not reported.
    #[serde(skip)]
    pub(super) head_note: Option<String>,
    contact: Contact,
    thickness: Thickness,
    /// Of all guides (J).
    energy: Energies,
    pub(super) hairs: usize,
    pub(super) points: usize,
    /// How the drawn hairs came to rest, if they are simulated; left out otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    simulated: Option<Simulated>,
    /// Deepest that a drawn hair is inside the head (m); measured for the report alone.
    pub(super) hair_penetration: Option<f64>,
    /// Of the drawn hairs; without them there is none.
    pub(super) volume: Option<Litres>,
    /// Smallest and largest corner of the box around the hair (m).
    bounds: Option<[[f32; 3]; 2]>,
    /// Mass of all hair that grows on the head, with the water in it (kg).
    mass: f64,
    /// What was done, in order; left out where nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) steps: Vec<StepNumbers>,
}

/// How the guides came to rest.
#[derive(Debug, Serialize)]
pub(super) struct Guides {
    pub(super) count: usize,
    pub(super) stable: usize,
    pub(super) saddles: usize,
    pub(super) not_converged: usize,
    elements: usize,
    iterations: usize,
    /// Over all guides, in which wisps made way for each other.
    sweeps: usize,
    /// Largest relative gradient.
    gradient_norm: f64,
    /// The relative gradient that wisps among each other were to reach.
    tolerance: f64,
    /// Deepest that a guide is inside the head (m).
    penetration: f64,
}

/// How simulated hairs came to rest.
#[derive(Debug, Serialize)]
struct Simulated {
    hairs: usize,
    stable: usize,
    elements: usize,
    iterations: usize,
}

/// The models of contact.
#[derive(Debug, Serialize)]
pub(super) struct Contact {
    body: &'static str,
    hair: &'static str,
}

/// Mean over wisps, half-way along.
#[derive(Debug, Serialize)]
pub(super) struct Thickness {
    /// Packed radius (m).
    radius: f64,
    /// Fraction of a wisp that is hair.
    packing: f64,
}

/// Space that the drawn hairs take (m³).
#[derive(Debug, Serialize)]
pub(super) struct Litres {
    /// Air between hairs included.
    pub(super) region: f64,
    /// The hairs themselves, for as many as grow.
    hair: f64,
    /// Side of the cells over which hair was averaged (m).
    cell: f64,
}

#[derive(Debug, Serialize)]
pub(super) struct Energies {
    elastic: f64,
    gravity: f64,
    contact: f64,
    total: f64,
}

/// The numbers of a hairstyle and of its drawn hairs.
pub(super) fn numbers(
    scene: &Scene,
    hairstyle: &Hairstyle,
    head: &Head,
    (strands, simulation): (&Strands, Simulation),
) -> Numbers {
    let (spec, settling) = (hairstyle.spec(), settling_report(hairstyle, head));
    let energy = &settling.energy;
    Numbers {
        scene: scene.name.clone(),
        hair_type: scene.hair_type,
        seed: spec.seed,
        guides: Guides {
            count: settling.guides,
            stable: settling.stable,
            saddles: settling.saddles,
            not_converged: settling.not_converged,
            elements: settling.elements,
            iterations: settling.iterations,
            sweeps: settling.sweeps,
            gradient_norm: settling.gradient_norm,
            tolerance: spec.equilibrium.tolerance,
            penetration: settling.penetration,
        },
        groom: None,
        head_note: None,
        contact: Contact { body: body(spec.contact.body), hair: hair(spec.contact.hair) },
        thickness: thickness(hairstyle),
        energy: Energies {
            elastic: energy.elastic,
            gravity: energy.gravity,
            contact: energy.external,
            total: energy.total(),
        },
        hairs: strands.len(),
        points: strands.points().len(),
        simulated: (simulation.hairs > 0).then_some(Simulated {
            hairs: simulation.hairs,
            stable: simulation.at_rest,
            elements: simulation.elements,
            iterations: simulation.iterations,
        }),
        hair_penetration: None,
        volume: None,
        mass: hairstyle.mass(),
        steps: Vec::new(),
        bounds: strands.bounds().map(|(low, high)| [low.to_array(), high.to_array()]),
    }
}

fn body(body: Body) -> &'static str {
    match body {
        Body::None => "none",
        Body::Spheres => "spheres",
        Body::SignedDistance => "signed-distance",
    }
}

fn hair(hair: HairContact) -> &'static str {
    match hair {
        HairContact::None => "none",
        HairContact::Layers => "layers",
        HairContact::Wisps => "wisps",
    }
}

fn thickness(hairstyle: &Hairstyle) -> Thickness {
    let guides = hairstyle.guides();
    let mean = |of: fn(&frisure::hairstyle::contact::Thickness, f64) -> f64| {
        let sum: f64 = guides.iter().map(|g| of(&g.thickness, 0.5 * g.rod.length())).sum();
        sum / guides.len().max(1) as f64
    };
    Thickness {
        radius: mean(frisure::hairstyle::contact::Thickness::packed),
        packing: mean(frisure::hairstyle::contact::Thickness::packing),
    }
}

pub(super) fn litres(volume: &Volume) -> Litres {
    Litres { region: volume.region, hair: volume.hair, cell: volume.cell }
}

/// What a person reads when it is done.
pub(super) fn summary(numbers: &Numbers, written: &[String]) -> String {
    let guides = &numbers.guides;
    let name = if numbers.scene.is_empty() { numbers.hair_type } else { &numbers.scene };
    let mut out = String::new();
    // Writing to a String cannot fail.
    if let Some(note) = &numbers.head_note {
        let _ = writeln!(out, "{note}");
    }
    let _ = write!(out, "{name}: {} of {} guides at rest", guides.stable, guides.count);
    if guides.saddles > 0 {
        let _ = write!(out, ", {} on a saddle", guides.saddles);
    }
    if guides.not_converged > 0 {
        let _ = write!(out, ", {} not converged", guides.not_converged);
    }
    if written.is_empty() {
        let hint = "add `-o hair.hair`, `--image hair.png` or `--report hair.json`";
        let _ = writeln!(out, "\nnothing was written: {hint}");
        return out;
    }
    let _ = write!(out, "; {} hairs of {} points in all", numbers.hairs, numbers.points);
    if let Some(volume) = &numbers.volume {
        let _ = write!(out, ", {:.1} litres of hair", volume.region * 1e3);
    }
    out.push('\n');
    if let Some(Simulated { hairs, stable, .. }) = &numbers.simulated {
        let _ = writeln!(out, "simulated: {stable} of {hairs} hairs at rest");
    }
    if let Some(groom) = &numbers.groom {
        let _ = writeln!(out, "groom: {groom}");
    }
    for step in &numbers.steps {
        step.tell(&mut out);
    }
    for path in written {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}
