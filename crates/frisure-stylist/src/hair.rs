//! Hair that is known already, and the least that has to be done for other hair.
//!
//! An exact hairstyle follows from its description and its steps alone, whatever was computed before:
//! guides start from their natural shape, and only what is the same to the last bit is taken over. A
//! coarse one goes on from the last that was looked at.

use std::mem::discriminant;
use std::sync::Arc;

use frisure::files::{Files, Stamp};
use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::Operation;
use frisure::hairstyle::{
    self, Effort, Hairstyle, HairstyleSpec, History, Monitor, PredictOptions, Start, StyleOptions,
    predict, style,
};
use frisure::scene::{GroomFile, Scene};

use crate::held::Held;
use crate::refusal::Stop;
use crate::{carry, order, shown};

/// How many descriptions are remembered with all that was done to them.
const KEPT: usize = 4;

/// What a slider leaves time for. A slider asks again, and each answer goes on from the last.
const COARSE: Effort = Effort { iterations: 2, sweeps: 1 };

/// The same for more guides than …
const MANY: Effort = Effort { iterations: 1, sweeps: 1 };
/// … these.
const FEW: usize = 400;

/// A hairstyle to compute.
pub(crate) struct Wanted<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) spec: HairstyleSpec,
    pub(crate) head: &'a Arc<Head>,
    /// How many of the scene's steps are done.
    pub(crate) done: usize,
    pub(crate) files: &'a Files,
}

impl Wanted<'_> {
    /// The groom that the hair is made of, as it is now.
    fn groom(&self) -> Option<(GroomFile, Option<Stamp>)> {
        self.scene.groom.as_ref().map(|file| (file.clone(), self.files.stamp(&file.path)))
    }
}

/// Hairstyles that are known.
#[derive(Debug, Default)]
pub(crate) struct Hair {
    /// The last used at the end.
    exact: Vec<Exact>,
    /// What was looked at last.
    draft: Option<Draft>,
}

/// All that was done to hair of one description, on one head.
#[derive(Debug)]
struct Exact {
    head: Arc<Head>,
    /// The description it was asked for with, and the groom that it was made of.
    spec: HairstyleSpec,
    groom: Option<(GroomFile, Option<Stamp>)>,
    /// How well that was held.
    held: Option<Held>,
    history: History,
}

/// Hair on its way to the last that was looked at.
#[derive(Debug)]
struct Draft {
    start: Arc<Hairstyle>,
    /// Each step, and the hair after it, if it is known.
    steps: Vec<(Operation, Option<Arc<Hairstyle>>)>,
}

impl Hair {
    /// The hairstyle at rest.
    pub(crate) fn exact(
        &mut self,
        wanted: &Wanted<'_>,
        monitor: &dyn Monitor,
    ) -> Result<Arc<Hairstyle>, Stop> {
        let place = match self.place(wanted) {
            Some(place) => place,
            None => self.predict(wanted, monitor)?,
        };
        // The last used is the last to be forgotten.
        let used = self.exact.remove(place);
        self.exact.push(used);
        let known = &mut self.exact.last_mut().expect("just pushed").history;
        let (operations, done) = (wanted.scene.steps().to_vec(), wanted.done);
        if let Err(error) = known.follow(operations, done, wanted.head, monitor) {
            return Err(stopped(carry::not_followed(&error, wanted.scene)));
        }
        let steps = (1..=known.done())
            .map(|i| (known.operations()[i - 1].clone(), known.known(i).cloned()))
            .collect();
        let start = known.known(0).expect("the start is always known").clone();
        let last = known.known(known.done()).expect("it was just done").clone();
        self.draft = Some(Draft { start, steps });
        Ok(last)
    }

    /// How well the groom of a hairstyle that is known was held.
    pub(crate) fn held(&self, wanted: &Wanted<'_>) -> Option<Held> {
        self.place(wanted).and_then(|place| self.exact[place].held.clone())
    }

    /// Where a description is remembered.
    fn place(&self, wanted: &Wanted<'_>) -> Option<usize> {
        self.exact.iter().position(|known| {
            Arc::ptr_eq(&known.head, wanted.head)
                && known.spec == wanted.spec
                && known.groom == wanted.groom()
        })
    }

    fn predict(&mut self, wanted: &Wanted<'_>, monitor: &dyn Monitor) -> Result<usize, Stop> {
        let mut held = None;
        let start = match self.redrawn(wanted) {
            Some(start) => start,
            None if wanted.scene.groom.is_some() => {
                let Wanted { scene, spec, head, files, .. } = wanted;
                let (hairstyle, adoption) =
                    carry::beginning(scene, spec, head, files, monitor).map_err(stopped)?;
                held = adoption.as_ref().map(Held::of);
                hairstyle
            }
            None => {
                let before = self.draft.as_ref().map(|draft| &*draft.start);
                let options = PredictOptions { previous: before, ..PredictOptions::default() };
                predict(&wanted.spec, wanted.head, options, monitor)
                    .map_err(|e| stopped(carry::not_predicted(&e, wanted.scene)))?
            }
        };
        let (head, spec, groom) = (wanted.head.clone(), wanted.spec.clone(), wanted.groom());
        self.exact.push(Exact { head, spec, groom, held, history: History::new(start) });
        if self.exact.len() > KEPT {
            self.exact.remove(0);
        }
        Ok(self.exact.len() - 1)
    }

    /// A known hairstyle of which only other hairs are to be drawn.
    fn redrawn(&self, wanted: &Wanted<'_>) -> Option<Hairstyle> {
        if wanted.scene.groom.is_some() {
            return None;
        }
        let same_head = |known: &&Exact| Arc::ptr_eq(&known.head, wanted.head);
        let mut known = self.exact.iter().rev().filter(same_head);
        known.find_map(|known| hairstyle::redrawn(known.history.start(), &wanted.spec))
    }

    /// The hairstyle for the eye, in little time; at rest if it is known so.
    pub(crate) fn coarse(
        &mut self,
        wanted: &Wanted<'_>,
        monitor: &dyn Monitor,
    ) -> Result<Arc<Hairstyle>, Stop> {
        let steps = &wanted.scene.steps()[..wanted.done.min(wanted.scene.steps().len())];
        if wanted.scene.groom.is_some() && self.place(wanted).is_none() {
            self.predict(wanted, monitor)?;
        }
        let mut draft = self.beginning(wanted, steps, monitor)?;
        for index in draft.steps.len()..steps.len() {
            let after = self.next(&draft, index, steps, wanted, monitor)?;
            draft.steps.push((steps[index].clone(), Some(after)));
        }
        let last = draft.last().clone();
        self.draft = Some(draft);
        Ok(last)
    }

    /// As far as the hairstyle is known, or its start.
    fn beginning(
        &self,
        wanted: &Wanted<'_>,
        steps: &[Operation],
        monitor: &dyn Monitor,
    ) -> Result<Draft, Stop> {
        if let Some(place) = self.place(wanted) {
            return Ok(self.exact[place].draft(steps));
        }
        let start = match self.redrawn(wanted) {
            Some(start) => start,
            None => {
                let before = self.draft.as_ref().map(|draft| &*draft.start);
                let effort = effort(steps, 0, wanted);
                let options = PredictOptions { previous: before, start: Start::Previous, effort };
                predict(&wanted.spec, wanted.head, options, monitor)
                    .map_err(|e| stopped(carry::not_predicted(&e, wanted.scene)))?
            }
        };
        Ok(Draft { start: Arc::new(start), steps: Vec::new() })
    }

    /// The hair after the next step, roughly.
    fn next(
        &self,
        draft: &Draft,
        index: usize,
        steps: &[Operation],
        wanted: &Wanted<'_>,
        monitor: &dyn Monitor,
    ) -> Result<Arc<Hairstyle>, Stop> {
        let like = self.draft.as_ref().and_then(|before| before.after(index, &steps[index]));
        let done = if like.is_some() { index + 1 } else { steps.len() };
        let effort = effort(steps, done, wanted);
        let stride = shown::every(draft.last(), order::Effort::Coarse);
        let options = StyleOptions {
            draft: Some(hairstyle::Draft { effort, stride, like }),
            ..StyleOptions::default()
        };
        let styled = style(draft.last(), wanted.head, &steps[index], options, monitor);
        styled.map(Arc::new).map_err(|e| stopped(carry::not_done(index, &e, wanted.scene)))
    }
}

/// How well hair has to lie after so many steps: the last is seen, and scissors and what keeps a shape
/// go by how it lies.
fn effort(steps: &[Operation], done: usize, wanted: &Wanted<'_>) -> Effort {
    match steps.get(done) {
        Some(Operation::Cut(_) | Operation::Dry(_)) => MANY,
        Some(_) => Effort::NONE,
        None if wanted.spec.wisps.count > FEW => MANY,
        None => COARSE,
    }
}

impl Exact {
    /// What is known of a list of steps.
    fn draft(&self, steps: &[Operation]) -> Draft {
        let known = &self.history;
        let same = known.operations().iter().zip(steps).take_while(|(a, b)| a == b).count();
        let last = (0..=same).rev().find(|&done| known.known(done).is_some()).unwrap_or(0);
        let step = |i: usize| (steps[i - 1].clone(), known.known(i).cloned());
        Draft {
            start: known.known(0).expect("the start is always known").clone(),
            steps: (1..=last).map(step).collect(),
        }
    }
}

impl Draft {
    /// The hair after the last step.
    fn last(&self) -> &Arc<Hairstyle> {
        let known = self.steps.last().and_then(|(_, hair)| hair.as_ref());
        known.unwrap_or(&self.start)
    }

    /// The hair after the step of a number, if it is of the same kind as another.
    fn after(&self, index: usize, operation: &Operation) -> Option<&Hairstyle> {
        let (step, hair) = self.steps.get(index)?;
        let same = discriminant(step) == discriminant(operation);
        hair.as_deref().filter(|_| same)
    }
}

/// Why it was stopped: cancelled, if nothing is wrong.
fn stopped(error: Option<frisure::scene::SceneError>) -> Stop {
    error.map_or(Stop::Cancelled, Stop::from)
}
