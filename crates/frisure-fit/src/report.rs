//! Reports of fits: sentences, JSON, and a page of HTML with plots.

use std::fmt::Write;

use glam::DVec3;
use serde_json::{Value, json};

use crate::blind::sentence;
use crate::fit::{Fit, FitStatus};
use crate::known::Estimate;
use crate::pose::Fibre;

impl Fit {
    /// What the fit cannot say, in sentences; empty if all numbers were told.
    #[must_use]
    pub fn statements(&self) -> Vec<String> {
        let mut said = Vec::new();
        match self.status {
            FitStatus::Fitted => {}
            FitStatus::Misfit => {
                let distance = self.reduced_square.sqrt();
                said.push(format!(
                    "the points deviate from every such fibre by {distance:.1} times the noise: the numbers and their deviations say nothing (a \
                     natural strain that varies, a fibre that touches something, points in a wrong order, or more noise than given)",
                ));
                return said;
            }
            FitStatus::NotConverged => {
                said.push(
                    "no fibre was found that hangs like these points: the numbers say nothing"
                        .to_owned(),
                );
                return said;
            }
        }
        if self.curvature.value < 2.0 * self.curvature.deviation
            || self.curl_radius.value < self.radius_of_noise()
        {
            said.push(
                "the fibre is straight within the noise: radius and pitch have no meaning"
                    .to_owned(),
            );
        }
        said.extend(self.blind.iter().map(|blind| sentence(blind, self.lines.len())));
        said
    }

    /// Radius (m) of a helix that noise alone stays below but with a probability of [`BY_CHANCE`].
    ///
    /// Of N points with a deviation σ of each coordinate a helix of radius a explains the square N a²/σ², distributed as χ² with two degrees of freedom where there
    /// is nothing but noise. The fit takes the largest of N independent ones, N/2 numbers of turns of either hand.
    fn radius_of_noise(&self) -> f64 {
        let points = self.lines.iter().map(Vec::len).sum::<usize>().max(1) as f64;
        self.noise * (2.0 * (points / BY_CHANCE).ln() / points).sqrt()
    }
}

/// Probability with which a straight fibre counts as curled by its noise. Chosen.
const BY_CHANCE: f64 = 1e-3;

/// A fibre and its fit, with a name.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// The name.
    pub name: &'a str,
    /// What was measured.
    pub fibre: &'a Fibre,
    /// What was found.
    pub fit: &'a Fit,
}

/// All numbers of fits as JSON, in SI units: an object with the list `fibres`.
///
/// # Panics
/// Never: the numbers of a fit have a form in JSON, in which those that are not finite are null.
#[must_use]
pub fn json(entries: &[Entry<'_>]) -> String {
    let one = |entry: &Entry<'_>| -> Value {
        let mut value = serde_json::to_value(entry.fit).expect("numbers, lists and names");
        if let Value::Object(fields) = &mut value {
            fields.insert("name".to_owned(), entry.name.into());
            fields.insert("poses".to_owned(), entry.fibre.poses().len().into());
            fields.insert("statements".to_owned(), entry.fit.statements().into());
        }
        value
    };
    let units = json!({
        "curvature": "rad/m", "torsion": "rad/m", "curl_radius": "m", "curl_pitch": "m", "length": "m", "noise": "m",
        "stiffness_over_weight": "m^3: EI/(rho S g) at g = 9.81 m/s^2", "torsion_ratio": "GJ/EI in the first state",
        "torsion_ratio_by_state": "GJ/EI", "axis_ratio": "longer over shorter axis of the section",
        "covariance": "of curvature, torsion (rad/m), ln stiffness_over_weight, ln torsion_ratio",
    });
    let fibres: Vec<Value> = entries.iter().map(one).collect();
    let mut text = serde_json::to_string_pretty(&json!({ "units": units, "fibres": fibres }))
        .expect("a value has a text");
    text.push('\n');
    text
}

/// A page of HTML: a table of all fibres, and for each its sentences and plots of its lines from two sides. It needs no other file.
#[must_use]
pub fn html(entries: &[Entry<'_>]) -> String {
    let mut page = String::from(HEAD);
    let fitted = entries.iter().filter(|entry| entry.fit.status == FitStatus::Fitted).count();
    let _ = writeln!(page, "<p>{} fibres, {fitted} of them fitted.</p>\n<table>", entries.len());
    page.push_str(
        "<tr><th>fibre<th>status<th>curl radius (mm)<th>curl pitch (mm)<th>hand<th>EI/(ρSg) (cm³)<th>GJ/EI<th>length (mm)\
         <th>noise (mm)<th>distance / noise</tr>\n",
    );
    for entry in entries {
        row(&mut page, entry);
    }
    page.push_str("</table>\n");
    for entry in entries.iter().take(PLOTTED) {
        let _ = writeln!(page, "<h2>{}</h2>", escaped(entry.name));
        for said in entry.fit.statements() {
            let _ = writeln!(page, "<p class=said>{}</p>", escaped(&said));
        }
        for (pose, (measured, line)) in entry.fibre.poses().iter().zip(&entry.fit.lines).enumerate()
        {
            let _ = writeln!(page, "<h3>pose {}</h3>", pose + 1);
            page.push_str(&views(measured.points(), line, measured.gravity()));
        }
    }
    if entries.len() > PLOTTED {
        let _ = writeln!(page, "<p>The first {PLOTTED} fibres are plotted.</p>");
    }
    page.push_str("</body></html>\n");
    page
}

/// Most fibres that are plotted. A page of more is slow to open.
const PLOTTED: usize = 100;

const HEAD: &str = "<!DOCTYPE html>
<html lang=en><head><meta charset=utf-8><title>Fits of measured fibres</title>
<style>
body { font: 15px/1.5 sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff }
table { border-collapse: collapse } th, td { padding: .2em .7em; text-align: right; border-bottom: 1px solid #ddd }
th { border-bottom: 1px solid #222; font-weight: 600 } td:first-child, th:first-child { text-align: left }
.said { color: #8a3200 } svg { margin-right: 1.5em } svg text { font-size: 12px; fill: #555 }
</style></head><body>
<h1>Fits of measured fibres</h1>
<p>A number and its standard deviation, from the Fisher information of the points and what was known before. Radius and pitch are those of the natural
shape, without weight.</p>
";

fn row(page: &mut String, entry: &Entry<'_>) {
    let fit = entry.fit;
    let status = match fit.status {
        FitStatus::Fitted => "fitted",
        FitStatus::Misfit => "does not fit",
        FitStatus::NotConverged => "not converged",
    };
    let hand = if fit.curl_pitch.value < 0.0 { "left" } else { "right" };
    let first = |list: &[Estimate]| list.first().copied();
    let pitch = Estimate { value: fit.curl_pitch.value.abs(), ..fit.curl_pitch };
    let _ = write!(page, "<tr><td>{}<td>{status}", escaped(entry.name));
    for (estimate, unit) in [(Some(fit.curl_radius), 1e3), (Some(pitch), 1e3)] {
        let _ = write!(page, "<td>{}", with_deviation(estimate, unit));
    }
    let _ = write!(page, "<td>{hand}");
    for (estimate, unit) in [
        (first(&fit.stiffness_over_weight), 1e6),
        (Some(fit.torsion_ratio), 1.0),
        (first(&fit.length), 1e3),
    ] {
        let _ = write!(page, "<td>{}", with_deviation(estimate, unit));
    }
    let distance = fit.reduced_square.sqrt();
    let _ = writeln!(page, "<td>{:.3}<td>{distance:.2}</tr>", fit.noise * 1e3);
}

/// A number in another unit and its deviation, with as many digits as the deviation allows.
fn with_deviation(estimate: Option<Estimate>, unit: f64) -> String {
    let Some(Estimate { value, deviation }) = estimate else { return String::new() };
    let (value, deviation) = (value * unit, deviation * unit);
    if !(value.is_finite() && deviation.is_finite()) {
        return "–".to_owned();
    }
    // Two digits of the deviation; a number that is known exactly has four of its own.
    let size = if deviation > 1e-5 * value.abs() { deviation / 10.0 } else { value.abs() / 1e3 };
    let digits = (-size.max(1e-9).log10().floor()).clamp(0.0, 9.0) as usize;
    if deviation > 1e-5 * value.abs() {
        format!("{value:.digits$} ± {deviation:.digits$}")
    } else {
        format!("{value:.digits$}")
    }
}

/// Width and height of a plot (px), and its margin.
const SIZE: f64 = 300.0;
const MARGIN: f64 = 24.0;

/// Points and line of a pose from two sides, with gravity down the page.
fn views(points: &[DVec3], line: &[DVec3], gravity: DVec3) -> String {
    let down = gravity.normalize_or(DVec3::NEG_Z);
    let side = down.any_orthonormal_vector();
    let other = down.cross(side);
    [(side, "from the front"), (other, "from the side")]
        .map(|(across, title)| view(points, line, across, down, title))
        .concat()
        + "\n"
}

fn view(points: &[DVec3], line: &[DVec3], across: DVec3, down: DVec3, title: &str) -> String {
    let project = |p: &DVec3| (p.dot(across), p.dot(down));
    let all: Vec<(f64, f64)> = points.iter().chain(line).map(project).collect();
    let range = |of: fn(&(f64, f64)) -> f64| {
        let values = || all.iter().map(of);
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
    };
    let ((left, right), (top, bottom)) = (range(|p| p.0), range(|p| p.1));
    let extent = (right - left).max(bottom - top).max(1e-6);
    let scale = (SIZE - 2.0 * MARGIN) / extent;
    let place = |p: &DVec3| {
        let (x, y) = project(p);
        let middle = 0.5 * SIZE;
        (middle + (x - 0.5 * (left + right)) * scale, middle + (y - 0.5 * (top + bottom)) * scale)
    };
    let mut svg = format!(
        "<svg width={SIZE} height={SIZE} viewBox='0 0 {SIZE} {SIZE}' role=img aria-label='points and fitted line {title}'>"
    );
    let path: Vec<String> = line.iter().map(place).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    let _ = write!(
        svg,
        "<polyline points='{}' fill=none stroke='#06c' stroke-width=1.5 />",
        path.join(" ")
    );
    for (x, y) in points.iter().map(place) {
        let _ = write!(svg, "<circle cx={x:.1} cy={y:.1} r=2 fill='#c40' />");
    }
    // A bar of a round length.
    let round = 10.0_f64.powf((0.4 * extent).log10().floor());
    let (bar, height) = (round * scale, SIZE - 6.0);
    let _ = write!(
        svg,
        "<line x1=6 y1={height} x2={:.1} y2={height} stroke='#222' stroke-width=2 /><text x=6 y={:.1}>{} mm, {title}</text></svg>",
        6.0 + bar,
        height - 5.0,
        round * 1e3
    );
    svg
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_their_deviation_allows() {
        let of = |value, deviation| with_deviation(Some(Estimate { value, deviation }), 1e3);
        assert_eq!(of(0.0061234, 0.0000456), "6.123 ± 0.046");
        assert_eq!(of(0.12, 0.0), "120.0");
        assert_eq!(of(f64::NAN, 1.0), "–");
        assert_eq!(escaped("<a & b>"), "&lt;a &amp; b&gt;");
    }
}
