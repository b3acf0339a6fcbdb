//! A hairstyle comes to rest after an operation.

use std::sync::Arc;

use frisure_rod::InvalidQuantity;
use rayon::prelude::*;

use super::fibre_now;
use super::wisp_state::{Grip, WispState};
use super::{Lay, StyleError, Styling};
use crate::equilibrium::{Change, Rest, resettle, resettle_roughly, settle_from};
use crate::guides::Guide;
use crate::hairstyle::{Hairstyle, Rough};
use crate::head::Head;
use crate::monitor::Monitor;

impl Hairstyle {
    /// How dry wisps lie now, and those that are wet lay before they were wetted.
    pub(super) fn lay(&self) -> Arc<Lay> {
        let Styling { wisps, humidity, lay: before, .. } = &self.styling;
        let before = before.as_ref().filter(|before| before.humidity == *humidity);
        let all_dry = wisps.iter().all(|wisp| wisp.wetness == 0.0);
        let now = |(index, wisp): (usize, &WispState)| match (wisp.wetness, before) {
            (0.0, _) => Some((wisp.clone(), self.rest.guides[index].clone())),
            (_, before) => before.and_then(|before| before.wisps[index].clone()),
        };
        let whole = all_dry.then(|| (wisps.clone(), self.rest.clone()));
        let whole = whole.or_else(|| before.and_then(|before| before.whole.clone()));
        Arc::new(Lay {
            humidity: *humidity,
            wisps: wisps.iter().enumerate().map(now).collect(),
            whole,
        })
    }

    /// The hairstyle that styling makes of this one, at rest from where it lay.
    pub(super) fn with(
        &self,
        head: &Head,
        styling: Styling,
        monitor: &dyn Monitor,
    ) -> Result<Self, StyleError> {
        self.at_rest(head, styling, Change::Changed, monitor)
    }

    /// The hairstyle that styling makes of this one, at rest; `change` is what was done to wisps that
    /// are another thing now and have not been put into another shape.
    pub(super) fn at_rest(
        &self,
        head: &Head,
        styling: Styling,
        change: Change,
        monitor: &dyn Monitor,
    ) -> Result<Self, StyleError> {
        let old = &self.styling;
        let air = styling.humidity != old.humidity;
        let changed: Vec<bool> =
            styling.wisps.iter().zip(&old.wisps).map(|(new, old)| air || new != old).collect();
        if !changed.contains(&true) {
            return Ok(Self { styling, ..self.clone() });
        }
        let area = self.planting.area();
        let guides: Vec<Guide> = (0..self.guides.len())
            .into_par_iter()
            .map(|i| match changed[i] {
                false => Ok(self.guides[i].clone()),
                true => fibre_now::guide(
                    &self.spec,
                    area,
                    (i, &styling.planned[i]),
                    &styling.wisps[i],
                    styling.humidity,
                ),
            })
            .collect::<Result<_, InvalidQuantity>>()?;
        let rest = match &self.rough {
            None => self.rest_of(head, &styling, &guides, (changed, change), monitor)?,
            Some(rough) => {
                self.rough_rest_of(head, &styling, &guides, (&changed, change, rough), monitor)?
            }
        };
        Ok(Self { guides, rest, styling, ..self.clone() })
    }

    /// Brings changed guides to rest; those that lie as they lay before they were wetted are known.
    fn rest_of(
        &self,
        head: &Head,
        styling: &Styling,
        guides: &[Guide],
        (changed, otherwise): (Vec<bool>, Change),
        monitor: &dyn Monitor,
    ) -> Result<Rest, StyleError> {
        let mut before = self.rest.guides.clone();
        let change = |(wisp, &changed): (usize, &bool)| match changed {
            true => self.change(styling, wisp, otherwise),
            false => Change::None,
        };
        let mut changes: Vec<Change> = changed.iter().enumerate().map(change).collect();
        let lay = styling.lay.as_ref().filter(|lay| lay.humidity == styling.humidity);
        if let Some(lay) = lay {
            if let Some((states, rest)) = &lay.whole
                && *states == styling.wisps
            {
                return Ok(rest.clone());
            }
            for (i, known) in lay.wisps.iter().enumerate() {
                if let Some((state, rest)) = known
                    && *state == styling.wisps[i]
                    && changed[i]
                {
                    before[i].clone_from(rest);
                    changes[i] = Change::None;
                }
            }
        }
        Ok(resettle(&self.spec, head, guides, (&before, &changes), monitor)?)
    }

    /// Brings changed guides nearer to rest, from where they are likely to end.
    fn rough_rest_of(
        &self,
        head: &Head,
        styling: &Styling,
        guides: &[Guide],
        (changed, otherwise, rough): (&[bool], Change, &Rough),
        monitor: &dyn Monitor,
    ) -> Result<Rest, StyleError> {
        if let Some(like) = &rough.like {
            return Ok(settle_from(&self.spec, head, guides, like, rough.effort, monitor)?);
        }
        let change = |(wisp, &changed): (usize, &bool)| match changed {
            true => self.change(styling, wisp, otherwise),
            false => Change::None,
        };
        let changes: Vec<Change> = changed.iter().enumerate().map(change).collect();
        let from = (self.rest.guides.as_slice(), changes.as_slice());
        Ok(resettle_roughly(&self.spec, head, guides, from, rough.effort, monitor)?)
    }

    /// What was done to a wisp that changed.
    fn change(&self, styling: &Styling, wisp: usize, otherwise: Change) -> Change {
        let (old, new) = (self.styling.wisps[wisp].grip, styling.wisps[wisp].grip);
        let replanted = !Arc::ptr_eq(&styling.planned, &self.styling.planned);
        let moulded = new != old && new.is_some_and(Grip::moulds);
        match self.guides[wisp].pull {
            _ if replanted || moulded => Change::Moulded,
            Some(pull) if new.is_none() => Change::LetGo(pull),
            _ => otherwise,
        }
    }
}
