//! A hairstyle comes to rest after an operation.

use std::sync::Arc;

use frisure_rod::Equilibrium;

use super::apply_state;
use super::error::StyleError;
use super::selection::Selection;
use crate::equilibrium::{Change, Effort, GuideStart, LockStart, SettleOptions, settle};
use crate::guides::Guide;
use crate::hairstyle::Hairstyle;
use crate::hairstyle::Rest;
use crate::hairstyle::{Grip, Lay, Styling, WispState};
use crate::head::Head;
use crate::parallel;
use frisure_progress::Progress;

/// What an operation acts on: a hairstyle, its head, and how the result is brought to rest.
#[derive(Clone, Copy)]
pub(super) struct Act<'a> {
    /// The hairstyle before the operation.
    pub(super) before: &'a Hairstyle,
    pub(super) head: &'a Head,
    /// How roughly it is done; none for the exact result.
    pub(super) draft: Option<DraftRest<'a>>,
    pub(super) progress: &'a dyn Progress,
}

/// How roughly a hairstyle is brought to rest.
#[derive(Clone, Copy)]
pub(super) struct DraftRest<'a> {
    /// How much work is done at most each time that hair comes to rest.
    pub(super) effort: Effort,
    /// Only every `stride`-th drawn hair is cut.
    pub(super) stride: usize,
    /// Where guides start from.
    pub(super) like: Option<&'a [Equilibrium]>,
}

impl<'a> Act<'a> {
    /// The same on another hairstyle.
    pub(super) fn on<'b>(&self, before: &'b Hairstyle) -> Act<'b>
    where
        'a: 'b,
    {
        Act { before, ..*self }
    }

    /// Which wisps a selection has.
    ///
    /// # Errors
    /// [`StyleError`], if there is none, or one is named that does not exist.
    pub(super) fn selected(&self, selection: &Selection) -> Result<Vec<bool>, StyleError> {
        selection.wisps(self.head, &self.before.guides, &self.before.rest.guides)
    }

    /// How dry wisps lie now, and those that are wet lay before they were wetted.
    pub(super) fn lay(&self) -> Arc<Lay> {
        let Styling { wisps, humidity, lay: before, .. } = &self.before.styling;
        let rest = &self.before.rest;
        let before = before.as_ref().filter(|before| before.humidity == *humidity);
        let all_dry = wisps.iter().all(|wisp| wisp.wetness == 0.0);
        let now = |(index, wisp): (usize, &WispState)| match (wisp.wetness, before) {
            (0.0, _) => {
                let lock = rest.locks.get(index).cloned().flatten();
                Some((wisp.clone(), rest.guides[index].clone(), lock))
            }
            (_, before) => before.and_then(|before| before.wisps[index].clone()),
        };
        let whole = all_dry.then(|| (wisps.clone(), rest.clone()));
        let whole = whole.or_else(|| before.and_then(|before| before.whole.clone()));
        Arc::new(Lay {
            humidity: *humidity,
            wisps: wisps.iter().enumerate().map(now).collect(),
            whole,
        })
    }

    /// The hairstyle that styling makes of this one, at rest from where it lay.
    pub(super) fn with(&self, styling: Styling) -> Result<Hairstyle, StyleError> {
        self.at_rest(styling, Change::Changed)
    }

    /// The hairstyle that styling makes of this one, at rest; `change` is what was done to wisps that
    /// changed and have not been put into another shape.
    pub(super) fn at_rest(
        &self,
        styling: Styling,
        change: Change,
    ) -> Result<Hairstyle, StyleError> {
        let before = self.before;
        let old = &before.styling;
        let air = styling.humidity != old.humidity;
        let changed: Vec<bool> =
            styling.wisps.iter().zip(&old.wisps).map(|(new, old)| air || new != old).collect();
        if !changed.contains(&true) {
            return Ok(Hairstyle { styling, ..before.clone() });
        }
        let guides: Vec<Guide> = parallel::try_map(before.guides.len(), |i| match changed[i] {
            false => Ok(before.guides[i].clone()),
            true => apply_state::guide(&before.spec, before.placement.area(), i, &styling),
        })?;
        let changes = self.changes(&styling, &changed, change);
        let rest = match self.draft {
            None => self.exact_rest(&styling, &guides, &changed, changes)?,
            Some(draft) => self.draft_rest(&styling, &guides, &changes, draft)?,
        };
        Ok(Hairstyle { guides, rest, styling, ..before.clone() })
    }

    /// Brings changed guides to rest; those that lie as they lay before they were wetted are known.
    fn exact_rest(
        &self,
        styling: &Styling,
        guides: &[Guide],
        changed: &[bool],
        mut changes: Vec<Change>,
    ) -> Result<Rest, StyleError> {
        let mut before = self.before.rest.guides.clone();
        let mut locks = self.locks(styling, guides);
        let lay = styling.lay.as_ref().filter(|lay| lay.humidity == styling.humidity);
        if let Some(lay) = lay {
            if let Some((states, rest)) = &lay.whole
                && *states == styling.wisps
            {
                return Ok(rest.clone());
            }
            for (i, known) in lay.wisps.iter().enumerate() {
                if let Some((state, rest, lock)) = known
                    && *state == styling.wisps[i]
                    && changed[i]
                {
                    before[i].clone_from(rest);
                    locks[i] = LockStart::like(lock.as_ref());
                    changes[i] = Change::None;
                }
            }
        }
        let start = GuideStart::Changed { before: &before, changes: &changes };
        let mut rest = self.settle(guides, SettleOptions { start, effort: Effort::FULL, locks })?;
        // What did not move is held as before.
        let held = self.before.rest.friction.iter().zip(&changes);
        for (ratio, (before, change)) in rest.friction.iter_mut().zip(held) {
            if *change == Change::None {
                *ratio = ratio.max(*before);
            }
        }
        Ok(rest)
    }

    /// Brings changed guides nearer to rest, from where they are likely to end.
    fn draft_rest(
        &self,
        styling: &Styling,
        guides: &[Guide],
        changes: &[Change],
        draft: DraftRest<'_>,
    ) -> Result<Rest, StyleError> {
        let start = match draft.like {
            Some(like) => GuideStart::Like(like),
            None => GuideStart::Changed { before: &self.before.rest.guides, changes },
        };
        let locks = self.locks(styling, guides);
        self.settle(guides, SettleOptions { start, effort: draft.effort, locks })
    }

    /// How the hairs inside each wisp begin: as they stuck before, anew where the fibre has another natural shape, or sliding where
    /// water or growth has freed them.
    fn locks(&self, styling: &Styling, guides: &[Guide]) -> Vec<LockStart> {
        let (before, old) = (self.before, &self.before.styling);
        let start = |(wisp, new): (usize, &WispState)| {
            let old = &old.wisps[wisp];
            // The strain at which they stick is that beyond the natural one.
            let same = before.guides[wisp].rod.natural() == guides[wisp].rod.natural();
            if new.wetness > old.wetness || new.uncut > old.uncut {
                LockStart::Free
            } else if same {
                LockStart::like(before.rest.locks.get(wisp).and_then(Option::as_ref))
            } else {
                LockStart::Anew
            }
        };
        styling.wisps.iter().enumerate().map(start).collect()
    }

    fn settle(&self, guides: &[Guide], options: SettleOptions<'_>) -> Result<Rest, StyleError> {
        Ok(settle(&self.before.spec, self.head, guides, options, self.progress)?)
    }

    /// What was done to each wisp; `otherwise` to those that changed but were not put into another shape.
    fn changes(&self, styling: &Styling, changed: &[bool], otherwise: Change) -> Vec<Change> {
        let old = &self.before.styling;
        let replanted = !Arc::ptr_eq(&styling.planned, &old.planned);
        let change = |(wisp, &changed): (usize, &bool)| {
            let (old, new) = (old.wisps[wisp].grip, styling.wisps[wisp].grip);
            let moulded = new != old && new.is_some_and(Grip::moulds);
            match self.before.guides[wisp].pull {
                _ if !changed => Change::None,
                _ if replanted || moulded => Change::Moulded,
                Some(pull) if new.is_none() => Change::LetGo(pull),
                Some(pull) if new != old && matches!(new, Some(Grip::Clip { .. })) => {
                    Change::HeldElsewhere(pull)
                }
                // The fibre has changed, or a hand has gone over it, but nothing has let go.
                Some(_) if new == old && otherwise == Change::Changed => Change::StillHeld,
                _ => otherwise,
            }
        };
        changed.iter().enumerate().map(change).collect()
    }
}
