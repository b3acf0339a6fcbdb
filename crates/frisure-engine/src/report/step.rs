//! The report of a step.

use std::collections::BTreeMap;

use frisure::hairstyle::Hairstyle;
use frisure::hairstyle::styling::{Operation, WispState};
use frisure::rod::Equilibrium;
use serde::Serialize;

/// How far (m) hair may be from a clip that holds it; chosen.
const AT_CLIP: f64 = 0.01;

/// The effect of a step; SI units.
#[derive(Clone, Debug, Serialize)]
pub struct StepReport {
    /// Name of the operation.
    pub operation: &'static str,
    /// Wisps that it acts on.
    pub wisps: usize,
    /// Those of them that it changed.
    pub changed: usize,
    /// Of a clip: wisps that do not reach it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub short: Option<usize>,
    /// Wisps that it takes out of what held them, by what that was: out of a tie, off a roller.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub taken_out: BTreeMap<&'static str, usize>,
    /// Mass of all hair and the water in it after it (kg).
    pub mass: f64,
    /// How much more that is than before (kg).
    pub mass_change: f64,
    /// Mean height of the tips of those wisps before and after it (m).
    pub tips: [f64; 2],
    /// Of a cut below a height.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<CutReport>,
}

/// Where the ends of wisps are that were cut below a height.
#[derive(Clone, Debug, Serialize)]
pub struct CutReport {
    /// The height (m).
    pub line: f64,
    /// Mean height of their tips above it after the cut (m).
    pub above_when_cut: f64,
    /// Mean height of their tips above it after all steps (m).
    pub above_at_the_end: f64,
}

impl StepReport {
    /// Compares the hairstyles before and after an operation on selected wisps.
    pub(crate) fn new(
        operation: &Operation,
        before: &Hairstyle,
        after: &Hairstyle,
        selected: &[bool],
    ) -> Self {
        Self {
            operation: operation.name(),
            wisps: selected.iter().filter(|selected| **selected).count(),
            changed: changed(before, after),
            short: short_of(operation, after, selected),
            taken_out: taken_out(operation, before, after),
            mass: after.mass(),
            mass_change: after.mass() - before.mass(),
            tips: [mean_tip(before, selected), mean_tip(after, selected)],
            cut: None,
        }
    }

    /// Adds that the selected wisps were cut at a height `line` (m); `end` is the hairstyle after all steps.
    pub(crate) fn add_cut(&mut self, line: f64, end: &Hairstyle, selected: &[bool]) {
        self.cut = Some(CutReport {
            line,
            above_when_cut: self.tips[1] - line,
            above_at_the_end: mean_tip(end, selected) - line,
        });
    }
}

/// The number of wisps that differ.
fn changed(before: &Hairstyle, after: &Hairstyle) -> usize {
    let rods = before.guides().iter().zip(after.guides()).map(|(a, b)| a.rod != b.rod);
    let states = before.wisps().iter().zip(after.wisps()).map(|(a, b)| a != b);
    // Thinning scissors cut hairs and no guides.
    let left = before.left_by_thinning().into_iter().zip(after.left_by_thinning());
    let thinned = left.map(|(a, b)| a != b);
    rods.zip(states)
        .zip(thinned)
        .filter(|((rod, state), thinned)| *rod || *state || *thinned)
        .count()
}

/// The wisps that an operation takes out of what held them, without being told to let go.
fn taken_out(
    operation: &Operation,
    before: &Hairstyle,
    after: &Hairstyle,
) -> BTreeMap<&'static str, usize> {
    let mut all = BTreeMap::new();
    if matches!(operation, Operation::Release(_)) {
        return all;
    }
    for (before, after) in before.wisps().iter().zip(after.wisps()) {
        match before.held_by() {
            // A comb that is passed on is the same comb.
            Some(by) if by != "comb" && after.held_by() != Some(by) => {
                *all.entry(by).or_default() += 1;
            }
            _ => {}
        }
    }
    all
}

/// The number of wisps that a clip or a tie does not hold where it is: they are too short for it, or the head is in the way.
fn short_of(operation: &Operation, after: &Hairstyle, selected: &[bool]) -> Option<usize> {
    if !matches!(operation, Operation::Clip(_) | Operation::Tie(_)) {
        return None;
    }
    let tie = matches!(operation, Operation::Tie(_));
    let held = |(wisp, rest): (&WispState, &Equilibrium)| {
        let clipped = wisp.clipped();
        // A tie holds no hair but what has reached it.
        if tie {
            return clipped.is_some();
        }
        clipped.is_some_and(|(at, to)| rest.at(&rest.chain(), at).0.distance(to) <= AT_CLIP)
    };
    let wisps = after.wisps().iter().zip(after.equilibria()).zip(selected);
    Some(wisps.filter(|(wisp, selected)| **selected && !held(*wisp)).count())
}

/// Mean height (m) of the tips of selected wisps.
fn mean_tip(hairstyle: &Hairstyle, selected: &[bool]) -> f64 {
    let tips = hairstyle.equilibria().iter().zip(selected).filter(|(_, selected)| **selected);
    let (sum, count) = tips.fold((0.0, 0.0), |(sum, n), (rest, _)| (sum + rest.tip().z, n + 1.0));
    sum / count
}
