//! What was measured as text: a table for people, and a part of a scene.

use std::fmt::Write;

use crate::estimate::Estimate;
use crate::measure::{Hang, Measurement};

/// The measurement as a table with bounds of 95 %.
#[must_use]
pub fn table(found: &Measurement, hang: Hang) -> String {
    let mut out = String::new();
    let mut row = |name: &str, value: String| {
        let _ = writeln!(out, "{name:<18} {value}");
    };
    let seen = if hang == Hang::Down { " as it hangs" } else { "" };
    row("radius", format!("{}{seen}", millimetres(found.apparent_radius)));
    row("pitch", format!("{}{seen}", millimetres(found.apparent_pitch)));
    match (hang, found.natural) {
        (Hang::None, _) => {}
        (Hang::Down, Some([radius, pitch])) => {
            row("natural radius", format!("{} without weight", millimetres(radius)));
            row("natural pitch", format!("{} without weight", millimetres(pitch)));
        }
        (Hang::Down, None) => {
            row("natural curl", "not found: no fibre of this kind hangs so; see --type".to_owned());
        }
    }
    row("curls seen", format!("{:.1}", found.turns));
    row("direction", format!("{:.1} deg from the vertical", found.tilt.to_degrees()));
    row("length of fibre", format!("{:.0} mm", 1e3 * found.length));
    let cues = &found.cues;
    let mut used = format!("middle line {:.2} mm", 1e3 * cues.line);
    if let Some(ridges) = cues.ridges {
        let _ = write!(used, ", {} ridge lines {:.2} mm", cues.ridge_lines, 1e3 * ridges.value);
    }
    if let Some(slopes) = cues.slopes {
        let _ = write!(used, ", directions {:.2} mm", 1e3 * slopes);
    }
    row("amplitude by", used);
    row("wave explains", format!("{:.1} % of the line", 100.0 * found.explained));
    out
}

fn millimetres(estimate: Estimate) -> String {
    let half = 1.96 * estimate.deviation;
    format!("{:.2} ± {:.2} mm", 1e3 * estimate.value, 1e3 * half)
}

/// What the fibre was taken to be where that is not the type's, in SI units; [`scene`] writes it.
#[derive(Clone, Copy, Debug, Default)]
pub struct GivenFibre {
    /// Length of the hairs (m).
    pub length: Option<f64>,
    /// Mean diameter (m).
    pub diameter: Option<f64>,
    /// Longer over shorter axis of the section.
    pub axis_ratio: Option<f64>,
    /// Young's and shear modulus (Pa).
    pub moduli: Option<[f64; 2]>,
}

/// A scene with the natural curl: `[hair.curl]` with comments, for `frisure predict`; none without a natural curl. `hair_type` is the type of the other
/// numbers, `given` those of the fibre that the measurement used instead, `source` what was measured.
#[must_use]
pub fn scene(
    found: &Measurement,
    hair_type: &str,
    given: &GivenFibre,
    source: &str,
) -> Option<String> {
    let [radius, pitch] = found.natural?;
    let source: String = source.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut out = format!("# Measured by `frisure measure` from {source}.\n");
    let _ = writeln!(out, "# {:.1} curls, {} as seen.\n", found.turns, seen(found));
    let _ = writeln!(out, "[hair]\ntype = \"{hair_type}\" # every number that is not below");
    if let Some(length) = given.length {
        let _ = writeln!(out, "length = \"{:.1} mm\"", 1e3 * length);
    }
    out.push('\n');
    out.push_str(&fibre(given));
    out.push_str("[hair.curl]\n");
    for (name, estimate) in [("radius", radius), ("pitch", pitch)] {
        let [low, high] = estimate.bounds().map(|x| 1e3 * x);
        let value = 1e3 * estimate.value;
        let _ = writeln!(
            out,
            "{name} = \"{value:.3} mm\" # without weight; 95 %: {low:.2} to {high:.2} mm"
        );
    }
    Some(out)
}

/// The table of the fibre, if something of it was given.
fn fibre(given: &GivenFibre) -> String {
    let mut keys = String::new();
    if let Some(diameter) = given.diameter {
        let _ = writeln!(keys, "diameter = \"{:.2} um\"", 1e6 * diameter);
    }
    if let Some(ratio) = given.axis_ratio {
        let _ = writeln!(keys, "axis_ratio = {ratio:.4}");
    }
    if let Some([young, shear]) = given.moduli {
        let _ = writeln!(keys, "youngs_modulus = \"{:.4} GPa\"", 1e-9 * young);
        let _ = writeln!(keys, "shear_modulus = \"{:.4} GPa\"", 1e-9 * shear);
    }
    if keys.is_empty() {
        keys
    } else {
        format!("[hair.fibre] # as the measurement took it\n{keys}\n")
    }
}

fn seen(found: &Measurement) -> String {
    let (radius, pitch) = (found.apparent_radius, found.apparent_pitch);
    format!("radius {}, pitch {}", millimetres(radius), millimetres(pitch))
}
