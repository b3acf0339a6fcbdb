//! Growing.

use crate::hairstyle::{Hairstyle, WispState};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::Apply;

/// Longest guide (m): that of a description.
const LONGEST: f64 = 3.0;

/// A factor for the rounding of a length that is subtracted from another and added again.
const ROUNDING: f64 = 1.0 + 1e-12;

/// How much longer than before hair may be when it comes to rest again while it grows, as a factor
/// and as a length (m), whichever is more: it buckles and falls on its way, not at its end. Chosen by trial.
const GROWN_AT_ONCE: (f64, f64) = (1.25, 5e-3);

/// Lets hair grow. \[paper\] §3.2, §4.1
#[derive(Clone, Debug, PartialEq)]
pub struct Grow {
    /// Which wisps.
    pub selection: Selection,
    /// How much.
    pub amount: Growth,
    /// In how many steps of equal length, each of which comes to rest before the next.
    pub stages: usize,
}

/// How much hair grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growth {
    /// By a length (m).
    By(f64),
    /// To a length of the guides (m); longer ones stay as they are.
    To(f64),
    /// For a time (s), at the hair's own rate.
    For(f64),
}

impl Default for Grow {
    fn default() -> Self {
        Self { selection: Selection::Everything, amount: Growth::By(0.01), stages: 1 }
    }
}

impl Grow {
    /// Longest time (s) that hair grows in one step: twenty years. A guard on time.
    const LONGEST_TIME: f64 = 20.0 * 365.25 * 86_400.0;
    /// Range of [`Growth::By`].
    pub const BY: Range = Range::new("grow.by", 0.0, 3.0, "between 0 and 3 m");
    /// Range of [`Growth::To`].
    pub const TO: Range = Range::new("grow.to", 1e-3, 3.0, "between 1 mm and 3 m");
    /// Range of [`Growth::For`].
    pub const TIME: Range =
        Range::new("grow.time", 0.0, Self::LONGEST_TIME, "between 0 and 20 years");
    /// Range of [`stages`](field@Self::stages).
    pub const STAGES: Range =
        Range::new("grow.stages", 1.0, 1000.0, "a whole number between 1 and 1000");
}

impl Apply for Grow {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::STAGES.check(self.stages as f64)?;
        match self.amount {
            Growth::By(length) => Self::BY.check(length),
            Growth::To(length) => Self::TO.check(length),
            Growth::For(time) => Self::TIME.check(time),
        }
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        self.stages(act).map(|mut stages| stages.pop().expect("at least one stage"))
    }

    fn stages(&self, act: &Act<'_>) -> Result<Vec<Hairstyle>, StyleError> {
        let hair = act.before;
        let chosen = act.selected(&self.selection)?;
        let spec = &hair.spec.length;
        let by: Vec<f64> = (hair.styling.wisps.iter().zip(&hair.guides).zip(&chosen))
            .map(|((wisp, guide), &chosen)| match self.amount {
                _ if !chosen => 0.0,
                Growth::By(length) => length,
                Growth::For(time) => time * spec.growth_rate,
                // Guides that are longer than the mean end at the longest that is computed.
                Growth::To(length) => ((length * guide.share).min(LONGEST) - wisp.length).max(0.0),
            })
            .collect();
        let too_long =
            |(wisp, by): (&WispState, &f64)| *by > 0.0 && wisp.length + by > LONGEST * ROUNDING;
        if let Some(wisp) = hair.styling.wisps.iter().zip(&by).position(too_long) {
            let length = hair.styling.wisps[wisp].length + by[wisp];
            return Err(StyleError::TooLong { wisp, length, most: LONGEST });
        }
        let mut stages: Vec<Hairstyle> = Vec::with_capacity(self.stages);
        for _ in 0..self.stages {
            let before = stages.last().unwrap_or(hair);
            let share: Vec<f64> = by.iter().map(|by| by / self.stages as f64).collect();
            let stage = grown_by(&act.on(before), &share)?;
            stages.push(stage);
        }
        Ok(stages)
    }
}

/// Every wisp longer by a length (m), in as many steps as that takes.
fn grown_by(act: &Act<'_>, by: &[f64]) -> Result<Hairstyle, StyleError> {
    let hair = act.before;
    let (factor, least) = GROWN_AT_ONCE;
    let steps = |(wisp, by): (&WispState, &f64)| {
        let steps = ((wisp.length + by) / wisp.length).ln() / factor.ln();
        steps.min(by / least).ceil().max(1.0) as usize
    };
    let steps = hair.styling.wisps.iter().zip(by).map(steps).max().unwrap_or(1);
    let mut grown = hair.clone();
    for step in 1..=steps {
        // In equal ratios: short hair buckles soon.
        let share = |length: f64, by: f64| {
            let ratio = (length + by) / length;
            if step == steps {
                by
            } else {
                length * (ratio.powf(step as f64 / steps as f64) - 1.0)
            }
        };
        let mut styling = hair.styling.clone();
        let now: Vec<f64> = (styling.wisps.iter().zip(by))
            .map(|(wisp, &by)| if by > 0.0 { share(wisp.length, by) } else { 0.0 })
            .collect();
        for (wisp, &by) in styling.wisps.iter_mut().zip(&now) {
            wisp.grow(by);
        }
        styling.ends = styling.ends.as_ref().map(|ends| ends.grown(&now));
        grown = act.on(&grown).with(styling)?;
    }
    Ok(grown)
}
