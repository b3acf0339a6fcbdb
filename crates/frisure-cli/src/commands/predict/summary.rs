//! The summary of `frisure predict`.

use std::fmt::Write;

use frisure::hairstyle::{Body, HairstyleSpec};
use frisure::rod::Resolution;
use frisure::scene::quoted;
use frisure_engine::ReplicaReport;
use frisure_engine::report::{
    CoarseLines, DEEP, HairstyleReport, SimulationReport, StepReport, StrandContactReport,
    WetLockReport,
};

/// The summary of a prediction of a description; `notes` say what was guessed of the head, and `written` has a line about each file.
pub(super) fn summary(
    report: &HairstyleReport,
    spec: &HairstyleSpec,
    notes: &[&String],
    written: &[String],
) -> String {
    let guides = &report.guides;
    let name = quoted(if report.scene.is_empty() { report.hair_type } else { &report.scene });
    let mut out = String::new();
    // Writing to a String cannot fail.
    for note in notes {
        let _ = writeln!(out, "{note}");
    }
    let _ = write!(out, "{name}: {} of {} guides at rest", guides.stable, guides.count);
    if guides.joint.as_ref().is_some_and(|joint| joint.stable) {
        out += ", all together";
    } else if guides.sweeps > 0 {
        // Each was settled while the others held still, to a gradient that can be seen: the summary does not claim more.
        let _ = write!(
            out,
            " within {:.1} % of the moment of their weight",
            guides.gradient_norm * 100.0
        );
    }
    if guides.friction.is_some() {
        out += ", held by friction";
    }
    if guides.saddles > 0 {
        let _ = write!(out, ", {} on a saddle", guides.saddles);
    }
    if guides.undecided > 0 {
        let _ = write!(out, ", {} perhaps on a saddle", guides.undecided);
    }
    if guides.not_converged > 0 {
        let _ = write!(out, ", {} not converged", guides.not_converged);
    }
    if let (1.., Resolution::Accuracy(accuracy)) =
        (guides.accuracy_missed, spec.equilibrium.resolution)
    {
        // Without the last digits, which are those of the conversion.
        let mm: f64 = format!("{:.9e}", 1e3 * accuracy).parse().unwrap_or(1e3 * accuracy);
        let _ = write!(out, ", {} less accurate than {mm:?} mm", guides.accuracy_missed);
    }
    let buried = buried(report, spec);
    let replicas = guides.replicas.as_ref().map(replicas_line).unwrap_or_default();
    if written.is_empty() {
        let hint = "add `-o hair.hair`, `--image hair.png` or `--report hair.json`";
        let _ = writeln!(out, "\n{buried}{replicas}nothing was written: {hint}");
        return out;
    }
    let _ = write!(out, "; {} hairs of {} points in all", report.hairs, report.points);
    if let Some(volume) = &report.volume {
        let _ = write!(out, ", {:.1} litres of hair", volume.region * 1e3);
    }
    out.push('\n');
    out += &buried;
    out += &coarse_lines(report);
    out += &replicas;
    if let Some(SimulationReport { hairs, stable, contact, .. }) = &report.simulated {
        let _ = match contact {
            None => writeln!(out, "simulated: {stable} of {hairs} hairs at rest"),
            Some(contact) => writeln!(out, "simulated: {}", contact_line(contact)),
        };
    }
    if let Some(groom) = &report.groom {
        let _ = writeln!(out, "groom: {groom}");
    }
    for step in &report.steps {
        out += &step_line(step);
    }
    if let Some(locks) = &report.wet_locks {
        out += &wet_line(locks);
    }
    for path in written {
        let _ = writeln!(out, "wrote {path}");
    }
    out
}

/// A warning of hair whose lines have too few points, if there is some.
fn coarse_lines(report: &HairstyleReport) -> String {
    let Some(CoarseLines { guides, shortest, points }) = report.coarse_lines else {
        return String::new();
    };
    format!(
        "warning: {guides} of {} guides wind too tightly for the points of their lines, which are up to {:.0} % too short; \
         `wisps.points = {points}` follows them\n",
        report.guides.count,
        (1.0 - shortest) * 100.0
    )
}

/// A line about how far guides move in replicas.
fn replicas_line(replicas: &ReplicaReport) -> String {
    let ReplicaReport { count, median, percentile_99, largest, jumped, spread, .. } = replicas;
    let [median, percentile_99, largest] = [median, percentile_99, largest].map(|x| x * 1e3);
    format!(
        "{count} replicas whose lengths and curl are changed by up to a millionth: guides move by {median:.3} mm (median), {percentile_99:.3} mm \
         (99 %), {largest:.3} mm (the most); {jumped} of {} by more than 0.5 mm\n",
        spread.len()
    )
}

/// How near to rest simulated hairs in contact with each other are.
fn contact_line(contact: &StrandContactReport) -> String {
    let StrandContactReport { hairs, contacts, balanced, represented, .. } = contact;
    let StrandContactReport { largest_gradient, rms_gradient, deepest_overlap, .. } = contact;
    let StrandContactReport { friction_ratio, iterations, .. } = contact;
    let between = match contact.form {
        "density" => "points at which they press on each other as a volume, without friction",
        _ => "contacts between them",
    };
    let mut out = format!(
        "{balanced} of {hairs} hairs in balance at {contacts} {between} (gradient {largest_gradient:.1e} at most, \
         {rms_gradient:.1e} rms, after {iterations} iterations; overlaps up to {:.0} % of the contact distance; each stands for {represented:.1})",
        deepest_overlap * 1e2
    );
    if *friction_ratio > 0.0 {
        // Writing to a String cannot fail.
        let _ = write!(out, "; friction up to {friction_ratio:.3} of its limit");
    }
    out
}

/// A line about a step.
fn step_line(step: &StepReport) -> String {
    let StepReport { operation, wisps, changed, taken_out, .. } = step;
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = match changed {
        0 => write!(out, "{operation}: nothing changed"),
        n if n < wisps => write!(out, "{operation}: {n} of {wisps} wisps"),
        _ => write!(out, "{operation}: {wisps} wisps"),
    };
    if *operation == "cut" && *changed > 0 {
        let _ = write!(out, ", {:.1} g fell", -step.mass_change * 1e3);
    }
    if let Some(cut) = step.cut.as_ref().filter(|_| *changed > 0) {
        let _ = write!(
            out,
            "; tips {} the line, {} at the end",
            beside(cut.above_when_cut),
            beside(cut.above_at_the_end)
        );
    }
    if let Some(short) = step.short.filter(|short| *short > 0) {
        let does = if short == 1 { "does" } else { "do" };
        let _ = write!(out, "; {short} {does} not reach the {operation}");
    }
    if !taken_out.is_empty() {
        let of = taken_out.iter().map(|(by, count)| format!("{count} out of a {by}"));
        let _ = write!(out, "; took {}", of.collect::<Vec<_>>().join(", "));
    }
    out.push('\n');
    out
}

/// A height above something, in words.
fn beside(height: f64) -> String {
    let side = if height < 0.0 { "below" } else { "above" };
    format!("{:.1} cm {side}", height.abs() * 1e2)
}

/// What is said of the locks of wet hair.
fn wet_line(locks: &WetLockReport) -> String {
    let WetLockReport { hairs, hairs_per_lock, radius, .. } = locks;
    if *hairs_per_lock < 2.0 {
        return "wet hair forms no locks: it is too short, or its hairs share too little of their curl\n".to_owned();
    }
    format!(
        "wet hair in about {:.0} locks of {hairs_per_lock:.0} hairs, {:.1} mm thick, at three quarters of its length\n",
        hairs / hairs_per_lock,
        2e3 * radius
    )
}

/// A warning of hair inside the head, if there is some.
pub(super) fn buried(report: &HairstyleReport, spec: &HairstyleSpec) -> String {
    let depth = report.guides.penetration.max(report.hair_penetration.unwrap_or(0.0));
    if depth <= DEEP {
        return String::new();
    }
    let is_within = report.groom.as_ref().is_some_and(|groom| groom.inside > 0);
    let way_out = if is_within { GROOM_WITHIN } else { way_out(spec) };
    format!("warning: hair is {:.1} mm inside the head; {way_out}\n", depth * 1e3)
}

/// What keeps hair of a groom out of the head that is inside it in the groom.
const GROOM_WITHIN: &str = "the groom itself goes into it: check that it was made on this head, and that it is the right way round; `turn` and \
                            `move` of `[groom]` place it";

/// What keeps hair of a description out of the head.
fn way_out(spec: &HairstyleSpec) -> &'static str {
    match (spec.contact.body, spec.equilibrium.resolution) {
        (Body::None, _) => "`contact.body` is \"none\"",
        (Body::Spheres, _) => {
            "the spheres are smaller than it; `contact.body = \"signed-distance\"` keeps hair out"
        }
        // What sinks in is mostly a curl between the nodes of a coarse division.
        (Body::SignedDistance, Resolution::Accuracy(_)) => {
            "a smaller `equilibrium.accuracy` may lift it, or a larger `contact.stiffness`, which says how far hair sinks into skin"
        }
        (Body::SignedDistance, Resolution::Elements(_)) => {
            "more `equilibrium.elements`, or `accuracy` instead, may lift it"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_out_names_the_key_that_the_scene_has() {
        let mut spec = frisure::hairstyle::preset("curly").unwrap().spec();
        spec.contact.body = Body::SignedDistance;
        assert!(way_out(&spec).contains("a smaller `equilibrium.accuracy`"));
        spec.equilibrium.resolution = Resolution::Elements(30);
        assert!(way_out(&spec).contains("more `equilibrium.elements`"));
        spec.contact.body = Body::Spheres;
        assert!(way_out(&spec).contains("`contact.body"));
    }
}
