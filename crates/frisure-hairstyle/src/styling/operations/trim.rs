//! Trims hair until it rests at a line.
//!
//! Hair that is cut as it hangs does not end at the line: without the weight of what fell it springs up, and its neighbours move. So
//! guides are cut, come to rest together, and are cut again or left longer, each by the secant method on the length that is left.

use frisure_rod::Equilibrium;

use super::scissors::{Scissors, enough};
use crate::hairstyle::Hairstyle;
use crate::parallel;
use crate::styling::error::StyleError;
use crate::styling::settle::Act;

/// How often hair is trimmed at most. Chosen: then all but one in fifty of straight, wavy and coily guides and one in twenty-five of
/// curly ones rest within [`ON_LINE`].
const ROUNDS: usize = 6;

/// The same of a draft. Chosen: within a few millimetres for the eye.
const DRAFT_ROUNDS: usize = 1;

/// How far (m) from the line hair may rest. Chosen: less than a pixel of a picture of a head.
const ON_LINE: f64 = 2e-4;

/// Least and most that hair comes nearer to the line per length that is left longer: less where it lies on shoulders, more where its
/// weight stretches curls. Guards on the secant; chosen.
const RATES: (f64, f64) = (0.25, 3.0);

/// Trims the chosen guides of a hairstyle that was cut until what rests farthest is at the line, as far as no guide becomes longer
/// than `most` (m, dry).
pub(super) fn trimmed(
    act: &Act<'_>,
    cut: Hairstyle,
    scissors: &Scissors<'_>,
    chosen: &[bool],
    most: &[f64],
) -> Result<Hairstyle, StyleError> {
    let mut hair = cut;
    let mut searches: Vec<Search> = most.iter().map(|most| Search::new(*most)).collect();
    for _ in 0..act.draft.map_or(ROUNDS, |_| DRAFT_ROUNDS) {
        let now = &hair;
        let next: Vec<Option<f64>> = parallel::map_mut(&mut searches, |i, search| {
            let rest = chosen[i].then(|| &now.rest.guides[i])?;
            search.next(now.styling.wisps[i].length, scissors, rest)
        });
        if next.iter().all(Option::is_none) {
            break;
        }
        let changed: Vec<bool> = next.iter().map(Option::is_some).collect();
        let styling = hair.styling.changed(&changed, |i, wisp| {
            wisp.length = next[i].unwrap_or(wisp.length);
        });
        hair = act.on(&hair).with(styling)?;
    }
    Ok(hair)
}

/// The search for the length (m, dry) at which a guide rests at a line.
struct Search {
    /// Length of the whole guide.
    most: f64,
    /// Lengths between which it is: at the first the guide ends before the line, at the second beyond it, if one did.
    between: (f64, Option<f64>),
    /// A length that has been tried, and how far (m) beyond the line the guide reached.
    tried: Option<(f64, f64)>,
}

impl Search {
    fn new(most: f64) -> Self {
        Self { most, between: (0.0, None), tried: None }
    }

    /// The length to try after `length`, with which the guide rests so; none if that will do.
    fn next(&mut self, length: f64, scissors: &Scissors<'_>, rest: &Equilibrium) -> Option<f64> {
        let reach = scissors.reach(rest);
        if reach.abs() <= ON_LINE || (reach < 0.0 && length >= self.most) {
            return None;
        }
        let rate = self.tried.replace((length, reach)).and_then(|(other, before)| {
            let rate = (reach - before) / (length - other);
            (length != other).then(|| rate.clamp(RATES.0, RATES.1))
        });
        let next = match rate {
            Some(rate) => length - reach / rate,
            // Where its curve crosses the line; or by as much as is missing.
            None if reach > 0.0 => scissors.left_hanging(rest) / rest.rod.length() * length,
            None => length - reach,
        };
        if reach > 0.0 {
            self.between.1 = Some(length);
        } else {
            self.between.0 = length;
        }
        let next = match self.between {
            // As long as no length was beyond the line, there is no other bound than the hair.
            (low, None) if next > low => next.min(self.most),
            (low, Some(high)) if next > low && next < high => next,
            (low, high) => 0.5 * (low + high.unwrap_or(self.most)),
        };
        enough(next).then_some(next)
    }
}
