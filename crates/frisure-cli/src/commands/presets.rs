//! `frisure presets`: the hair types that a scene can start from.

use std::fmt::Write;

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{HairType, PRESETS, Preset, Wetting};
use frisure_engine::Error;
use serde::Serialize;

use crate::args::Presets;
use crate::console;
use crate::diagnostics::ExitStatus;

/// Prints a table of the hair types, or all numbers of one.
pub(crate) fn run(arguments: &Presets) -> Result<ExitStatus, Error> {
    let text = match (arguments.hair_type, arguments.json) {
        (None, false) => table(),
        (Some(preset), false) => sheet(preset),
        (None, true) => console::json(&PRESETS.iter().map(Described::new).collect::<Vec<_>>())?,
        (Some(preset), true) => console::json(&Described::new(preset))?,
    };
    console::print(&text)?;
    Ok(ExitStatus::Success)
}

fn table() -> String {
    let mut out = format!(
        "{:<19} {:>8} {:>5} {:>8}  {}\n",
        "type", "diameter", "axes", "curl", "description"
    );
    for preset in PRESETS {
        let hair = preset.hair_type();
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "{:<19} {:>5.0} um {:>5.2} {:>8}  {}",
            preset.name,
            hair.diameter * 1e6,
            hair.axis_ratio,
            curl(hair.curl.curve_diameter()),
            preset.description,
        );
    }
    let heads: Vec<_> = Head::names().collect();
    // Writing to a String cannot fail.
    let _ = writeln!(out, "\nheads (`model` in `[head]`): {}", heads.join(", "));
    out.push_str("\naxes: longer over shorter axis of the section; curl: diameter of the curve\n");
    out
}

/// A curve diameter (m) for people.
fn curl(diameter: f64) -> String {
    if diameter > 0.1 {
        format!("{:.0} cm", diameter * 1e2)
    } else {
        format!("{:.0} mm", diameter * 1e3)
    }
}

/// Every number of one type, for people.
fn sheet(preset: &Preset) -> String {
    let mut out = format!("{}: {}\n\n", preset.name, preset.description);
    for (name, value) in rows(preset.hair_type()) {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{name:<24} {value}");
    }
    out
}

fn rows(hair: &HairType) -> Vec<(&'static str, String)> {
    let c = &hair.curl;
    let gigapascal = |x: f64| format!("{:.2} GPa", x * 1e-9);
    let percent = |x: f64| format!("{:.0} %", x * 1e2);
    let month = 30.44 * 86_400.0;
    vec![
        ("diameter", format!("{:.0} um", hair.diameter * 1e6)),
        ("  between hairs", format!("+- {}", percent(hair.diameter_variation))),
        ("axis ratio", format!("{:.2}", hair.axis_ratio)),
        ("  between hairs", format!("+- {:.2}", hair.axis_ratio_deviation)),
        ("  eccentricity (paper)", format!("{:.2}", hair.paper_eccentricity)),
        ("Young's modulus", gigapascal(hair.youngs_modulus)),
        ("shear modulus", gigapascal(hair.shear_modulus)),
        ("mass", format!("{:.2} g/cm^3", hair.mass_density * 1e-3)),
        ("wet, measured", wetting(&hair.wetting)),
        ("wet, in the paper", wetting(&hair.paper_wetting)),
        ("curl radius", format!("{:.1} mm", c.radius * 1e3)),
        ("curl pitch", format!("{:.1} mm", c.pitch * 1e3)),
        ("  curve diameter", curl(c.curve_diameter())),
        ("  curl index", format!("{:.2}", c.curl_index())),
        ("  turns", format!("{:.2} per 5 cm", c.turns_per_length() * 0.05)),
        ("  between wisps", format!("+- {}", percent(c.variation_between))),
        (
            "  along a hair",
            format!("+- {} over {:.0} mm", percent(c.variation_along), c.variation_scale * 1e3),
        ),
        ("hairs", format!("{:.0} per cm^2", hair.density * 1e-4)),
        ("angle to the skin", format!("{:.1} times the regional means", hair.lift_scale)),
        ("growth", format!("{:.2} cm a month", hair.growth_rate * month * 1e2)),
    ]
}

fn wetting(wet: &Wetting) -> String {
    format!(
        "E x {:.2}, G x {:.2}, diameter x {:.3}, length x {:.3}, wisps x {:.1}",
        wet.youngs_modulus, wet.shear_modulus, wet.diameter, wet.length, wet.wisp
    )
}

/// A type for programs; SI units.
#[derive(Debug, Serialize)]
struct Described {
    name: &'static str,
    description: &'static str,
    diameter: f64,
    diameter_variation: f64,
    axis_ratio: f64,
    axis_ratio_deviation: f64,
    paper_eccentricity: f64,
    youngs_modulus: f64,
    shear_modulus: f64,
    mass_density: f64,
    wetting: Wet,
    paper_wetting: Wet,
    curl: Curl,
    density: f64,
    lift_scale: f64,
    growth_rate: f64,
}

#[derive(Debug, Serialize)]
struct Curl {
    radius: f64,
    pitch: f64,
    curve_diameter: f64,
    curl_index: f64,
    turns_per_length: f64,
    variation_between: f64,
    variation_along: f64,
    variation_scale: f64,
}

/// Factors.
#[derive(Debug, Serialize)]
struct Wet {
    youngs_modulus: f64,
    shear_modulus: f64,
    diameter: f64,
    length: f64,
    wisp: f64,
}

impl Described {
    fn new(preset: &Preset) -> Self {
        let (hair, c) = (preset.hair_type(), &preset.hair_type().curl);
        Self {
            name: preset.name,
            description: preset.description,
            diameter: hair.diameter,
            diameter_variation: hair.diameter_variation,
            axis_ratio: hair.axis_ratio,
            axis_ratio_deviation: hair.axis_ratio_deviation,
            paper_eccentricity: hair.paper_eccentricity,
            youngs_modulus: hair.youngs_modulus,
            shear_modulus: hair.shear_modulus,
            mass_density: hair.mass_density,
            wetting: Wet::new(&hair.wetting),
            paper_wetting: Wet::new(&hair.paper_wetting),
            curl: Curl {
                radius: c.radius,
                pitch: c.pitch,
                curve_diameter: c.curve_diameter(),
                curl_index: c.curl_index(),
                turns_per_length: c.turns_per_length(),
                variation_between: c.variation_between,
                variation_along: c.variation_along,
                variation_scale: c.variation_scale,
            },
            density: hair.density,
            lift_scale: hair.lift_scale,
            growth_rate: hair.growth_rate,
        }
    }
}

impl Wet {
    fn new(wet: &Wetting) -> Self {
        let Wetting { youngs_modulus, shear_modulus, diameter, length, wisp, locks: _ } = *wet;
        Self { youngs_modulus, shear_modulus, diameter, length, wisp }
    }
}
