//! What is done to the hair of a scene, step by step.

use std::fmt::Write;

use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::{Clip, Cut, CutLine, Operation, StyleError};
use frisure::hairstyle::{Hairstyle, StyleOptions, selected, style};
use frisure::progress::Progress;
use frisure::rod::Equilibrium;
use frisure::scene::Scene;
use frisure_engine::Error;
use serde::Serialize;

use crate::failure::Failure;

/// What a step did.
#[derive(Clone, Debug, Serialize)]
pub(super) struct StepNumbers {
    operation: &'static str,
    /// Wisps that it was about, and how many of them it changed.
    wisps: usize,
    changed: usize,
    /// Of a clip: wisps that do not reach it.
    #[serde(skip_serializing_if = "Option::is_none")]
    short: Option<usize>,
    /// Mass of all hair after it (kg), and how much more or less that is than before.
    mass: f64,
    mass_change: f64,
    /// Mean height of the tips of those wisps before and after it (m).
    tips: [f64; 2],
    /// Of a cut below a height.
    #[serde(skip_serializing_if = "Option::is_none")]
    cut: Option<CutNumbers>,
}

/// Where the ends of wisps are that were cut below a height.
#[derive(Clone, Debug, Serialize)]
struct CutNumbers {
    /// The height (m).
    line: f64,
    /// Mean height of their tips above it (m): when they had been cut, and after all steps.
    above_when_cut: f64,
    above_at_the_end: f64,
}

/// The hairstyles on the way: at first, and after each stage of each step.
pub(super) struct Styled {
    /// All of them if they are wanted, or the last.
    pub(super) hairstyles: Vec<Hairstyle>,
    pub(super) steps: Vec<StepNumbers>,
}

/// Does all steps of a scene.
pub(super) fn all(
    scene: &Scene,
    head: &Head,
    start: Hairstyle,
    each: bool,
    progress: &dyn Progress,
) -> Result<Styled, Failure> {
    let mut styled = Styled { hairstyles: vec![start], steps: Vec::new() };
    let mut cuts: Vec<(usize, Vec<bool>, f64)> = Vec::new();
    for (index, operation) in scene.steps().iter().enumerate() {
        let before = styled.hairstyles.last().expect("there is one to begin with");
        let refused = |e: StyleError| Failure::from(Error::of_step(index, &e, scene));
        let chosen = match operation.selection() {
            Some(selection) => selected(before, head, selection).map_err(refused)?,
            None => vec![true; before.guides().len()],
        };
        let mut stages = Vec::new();
        let options =
            StyleOptions { stages: each.then_some(&mut stages), ..StyleOptions::default() };
        let after = style(before, head, operation, options, progress).map_err(refused)?;
        styled.steps.push(StepNumbers {
            operation: operation.name(),
            wisps: chosen.iter().filter(|chosen| **chosen).count(),
            changed: changed(before, &after),
            short: short_of(operation, &after, &chosen),
            mass: after.mass(),
            mass_change: after.mass() - before.mass(),
            tips: [mean_tip(before, &chosen), mean_tip(&after, &chosen)],
            cut: None,
        });
        if let Operation::Cut(Cut { line: CutLine::Below(height), .. }) = operation {
            cuts.push((index, chosen, height.on(head)));
        }
        if !each {
            styled.hairstyles.clear();
        }
        styled.hairstyles.extend(stages);
        styled.hairstyles.push(after);
    }
    let end = styled.hairstyles.last().expect("there is one to begin with");
    for (index, chosen, line) in cuts {
        let step = &mut styled.steps[index];
        step.cut = Some(CutNumbers {
            line,
            above_when_cut: step.tips[1] - line,
            above_at_the_end: mean_tip(end, &chosen) - line,
        });
    }
    Ok(styled)
}

/// How many wisps are another thing than before.
fn changed(before: &Hairstyle, after: &Hairstyle) -> usize {
    let rods = before.guides().iter().zip(after.guides()).map(|(a, b)| a.rod != b.rod);
    let states = before.wisps().iter().zip(after.wisps()).map(|(a, b)| a != b);
    rods.zip(states).filter(|(rod, state)| *rod || *state).count()
}

/// How far (m) hair may be from a clip that holds it.
const AT_CLIP: f64 = 0.01;

/// How many wisps a clip does not hold: they are too short for it, or the head is in the way.
fn short_of(operation: &Operation, after: &Hairstyle, chosen: &[bool]) -> Option<usize> {
    let Operation::Clip(Clip { at, to, .. }) = operation else { return None };
    let away = |rest: &Equilibrium| rest.at(&rest.chain(), *at).0.distance(*to);
    let wisps = after.equilibria().iter().zip(chosen).filter(|(_, chosen)| **chosen);
    Some(wisps.filter(|(rest, _)| away(rest) > AT_CLIP).count())
}

/// Mean height (m) of the tips of chosen wisps.
fn mean_tip(hairstyle: &Hairstyle, chosen: &[bool]) -> f64 {
    let tips = hairstyle.equilibria().iter().zip(chosen).filter(|(_, chosen)| **chosen);
    let (sum, count) = tips.fold((0.0, 0.0), |(sum, n), (rest, _)| (sum + rest.tip().z, n + 1.0));
    sum / count
}

impl StepNumbers {
    /// One line for a person, where there is something to tell.
    pub(super) fn tell(&self, out: &mut String) {
        let Self { operation, wisps, changed, .. } = self;
        // Writing to a String cannot fail.
        let _ = match changed {
            0 => write!(out, "{operation}: nothing changed"),
            n if n < wisps => write!(out, "{operation}: {n} of {wisps} wisps"),
            _ => write!(out, "{operation}: {wisps} wisps"),
        };
        if *operation == "cut" && *changed > 0 {
            let _ = write!(out, ", {:.1} g fell", -self.mass_change * 1e3);
        }
        if let Some(cut) = self.cut.as_ref().filter(|_| *changed > 0) {
            let _ = write!(
                out,
                "; tips {} the line, {} at the end",
                beside(cut.above_when_cut),
                beside(cut.above_at_the_end)
            );
        }
        if let Some(short) = self.short.filter(|short| *short > 0) {
            let _ = write!(out, ", {short} of which do not reach the clip");
        }
        out.push('\n');
    }
}

/// A height above something, in words.
fn beside(height: f64) -> String {
    let side = if height < 0.0 { "below" } else { "above" };
    format!("{:.1} cm {side}", height.abs() * 1e2)
}

/// How many hairstyles there are on the way.
pub(super) fn count(scene: &Scene) -> usize {
    let stages = |operation: &Operation| match operation {
        Operation::Grow(grow) => grow.stages,
        _ => 1,
    };
    1 + scene.steps().iter().map(stages).sum::<usize>()
}
