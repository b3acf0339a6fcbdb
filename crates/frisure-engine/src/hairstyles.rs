//! The cache of hairstyles, and the least work for the next one.
//!
//! An exact hairstyle depends on its description and its steps alone, whatever was computed before:
//! guides start from their natural shape, and only what is the same to the last bit is reused. A
//! coarse one continues from the last that was previewed.

use std::mem::discriminant;
use std::sync::Arc;

use frisure::files::{Files, Stamp};
use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::Operation;
use frisure::hairstyle::{
    self, Effort, Hairstyle, HairstyleSpec, History, PredictOptions, Start, StyleOptions, predict,
    style,
};
use frisure::progress::Progress;
use frisure::scene::{GroomFile, Scene};

use crate::adoption::AdoptionReport;
use crate::error::Error;
use crate::initial::initial_hairstyle;
use crate::inputs::groom_files;
use crate::quality::Quality;

/// Most descriptions in the cache, each with its history; chosen.
const CAPACITY: usize = 4;

/// Work of a coarse hairstyle while a slider moves; each continues from the last. Chosen by trial.
const COARSE: Effort = Effort { iterations: 2, sweeps: 1 };

/// The same for many guides, and before a step that depends on how the hair lies.
const COARSER: Effort = Effort { iterations: 1, sweeps: 1 };

/// Guides above which it is used; chosen by trial.
const MANY_GUIDES: usize = 400;

/// A groom with the stamps of its files.
type StampedGroom = (GroomFile, Vec<Option<Stamp>>);

/// What a hairstyle depends on.
pub(crate) struct Input<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) spec: HairstyleSpec,
    pub(crate) head: &'a Arc<Head>,
    /// Number of the steps of the scene that are applied.
    pub(crate) done: usize,
    pub(crate) files: &'a Files,
}

impl Input<'_> {
    /// The groom that the hair is adopted from.
    fn groom(&self) -> Option<StampedGroom> {
        let file = self.scene.groom.clone()?;
        let stamps = groom_files(&file).map(|path| self.files.stamp(path)).collect();
        Some((file, stamps))
    }
}

/// Hairstyles that were computed.
#[derive(Debug, Default)]
pub(crate) struct HairstyleCache {
    /// The last used at the end.
    exact: Vec<Exact>,
    /// The last that was previewed.
    draft: Option<Draft>,
}

/// The history of a hairstyle of one description on one head.
#[derive(Debug)]
struct Exact {
    head: Arc<Head>,
    /// Its description, and the groom that it is adopted from.
    spec: HairstyleSpec,
    groom: Option<StampedGroom>,
    adoption: Option<AdoptionReport>,
    history: History,
}

/// The hairstyles up to the last that was previewed.
#[derive(Debug)]
struct Draft {
    start: Arc<Hairstyle>,
    /// Each step, and the hairstyle after it, if it is cached.
    steps: Vec<(Operation, Option<Arc<Hairstyle>>)>,
}

impl HairstyleCache {
    /// The hairstyle in equilibrium.
    pub(crate) fn exact(
        &mut self,
        input: &Input<'_>,
        progress: &dyn Progress,
    ) -> Result<Arc<Hairstyle>, Error> {
        let index = match self.index(input) {
            Some(index) => index,
            None => self.predict(input, progress)?,
        };
        // The last used is the last to be evicted.
        let used = self.exact.remove(index);
        self.exact.push(used);
        let known = &mut self.exact.last_mut().expect("just pushed").history;
        let (operations, done) = (input.scene.steps().to_vec(), input.done);
        if let Err(error) = known.follow(operations, done, input.head, progress) {
            return Err(Error::of_history(&error, input.scene));
        }
        let steps = (1..=known.done())
            .map(|i| (known.operations()[i - 1].clone(), known.known(i).cloned()))
            .collect();
        let start = known.known(0).expect("the start is always cached").clone();
        let last = known.known(known.done()).expect("it was just computed").clone();
        self.draft = Some(Draft { start, steps });
        Ok(last)
    }

    /// How well the groom of a cached hairstyle keeps its shape.
    pub(crate) fn adoption(&self, input: &Input<'_>) -> Option<AdoptionReport> {
        self.index(input).and_then(|index| self.exact[index].adoption.clone())
    }

    /// The index of a description in the cache.
    fn index(&self, input: &Input<'_>) -> Option<usize> {
        self.exact.iter().position(|known| {
            Arc::ptr_eq(&known.head, input.head)
                && known.spec == input.spec
                && known.groom == input.groom()
        })
    }

    fn predict(&mut self, input: &Input<'_>, progress: &dyn Progress) -> Result<usize, Error> {
        let mut report = None;
        let start = match self.redrawn(input) {
            Some(start) => start,
            None if input.scene.groom.is_some() => {
                let Input { scene, spec, head, files, .. } = input;
                let (hairstyle, adoption) = initial_hairstyle(scene, spec, head, files, progress)?;
                report = adoption.as_ref().map(AdoptionReport::of);
                hairstyle
            }
            None => {
                let before = self.draft.as_ref().map(|draft| &*draft.start);
                let options = PredictOptions { previous: before, ..PredictOptions::default() };
                predict(&input.spec, input.head, options, progress)
                    .map_err(|e| Error::of_prediction(&e, input.scene))?
            }
        };
        let (head, spec, groom) = (input.head.clone(), input.spec.clone(), input.groom());
        self.exact.push(Exact {
            head,
            spec,
            groom,
            adoption: report,
            history: History::new(start),
        });
        if self.exact.len() > CAPACITY {
            self.exact.remove(0);
        }
        Ok(self.exact.len() - 1)
    }

    /// A cached hairstyle that differs only in the drawn hairs.
    fn redrawn(&self, input: &Input<'_>) -> Option<Hairstyle> {
        if input.scene.groom.is_some() {
            return None;
        }
        let same_head = |known: &&Exact| Arc::ptr_eq(&known.head, input.head);
        let mut known = self.exact.iter().rev().filter(same_head);
        known.find_map(|known| hairstyle::redrawn(known.history.start(), &input.spec))
    }

    /// An approximate hairstyle in little time; exact where that is cached.
    pub(crate) fn coarse(
        &mut self,
        input: &Input<'_>,
        progress: &dyn Progress,
    ) -> Result<Arc<Hairstyle>, Error> {
        let steps = &input.scene.steps()[..input.done.min(input.scene.steps().len())];
        if input.scene.groom.is_some() && self.index(input).is_none() {
            self.predict(input, progress)?;
        }
        let mut draft = self.start(input, steps, progress)?;
        for index in draft.steps.len()..steps.len() {
            let after = self.next(&draft, index, steps, input, progress)?;
            draft.steps.push((steps[index].clone(), Some(after)));
        }
        let last = draft.last().clone();
        self.draft = Some(draft);
        Ok(last)
    }

    /// The hairstyle as far as it is cached, or its start.
    fn start(
        &self,
        input: &Input<'_>,
        steps: &[Operation],
        progress: &dyn Progress,
    ) -> Result<Draft, Error> {
        if let Some(index) = self.index(input) {
            return Ok(self.exact[index].draft(steps));
        }
        let start = match self.redrawn(input) {
            Some(start) => start,
            None => {
                let before = self.draft.as_ref().map(|draft| &*draft.start);
                let effort = effort(steps, 0, input);
                let options = PredictOptions { previous: before, start: Start::Previous, effort };
                predict(&input.spec, input.head, options, progress)
                    .map_err(|e| Error::of_prediction(&e, input.scene))?
            }
        };
        Ok(Draft { start: Arc::new(start), steps: Vec::new() })
    }

    /// The approximate hairstyle after the next step.
    fn next(
        &self,
        draft: &Draft,
        index: usize,
        steps: &[Operation],
        input: &Input<'_>,
        progress: &dyn Progress,
    ) -> Result<Arc<Hairstyle>, Error> {
        let like = self.draft.as_ref().and_then(|before| before.after(index, &steps[index]));
        let done = if like.is_some() { index + 1 } else { steps.len() };
        let effort = effort(steps, done, input);
        let stride = Quality::Coarse.stride(draft.last());
        let options = StyleOptions {
            draft: Some(hairstyle::Draft { effort, stride, like }),
            ..StyleOptions::default()
        };
        let styled = style(draft.last(), input.head, &steps[index], options, progress);
        styled.map(Arc::new).map_err(|e| Error::of_step(index, &e, input.scene))
    }
}

/// The work after `done` steps: the last is visible, and cutting and drying depend on how the hair lies.
fn effort(steps: &[Operation], done: usize, input: &Input<'_>) -> Effort {
    match steps.get(done) {
        Some(Operation::Cut(_) | Operation::Dry(_)) => COARSER,
        Some(_) => Effort::NONE,
        None if input.spec.wisps.count > MANY_GUIDES => COARSER,
        None => COARSE,
    }
}

impl Exact {
    /// The cached hairstyles of a list of steps.
    fn draft(&self, steps: &[Operation]) -> Draft {
        let known = &self.history;
        let same = known.operations().iter().zip(steps).take_while(|(a, b)| a == b).count();
        let last = (0..=same).rev().find(|&done| known.known(done).is_some()).unwrap_or(0);
        let step = |i: usize| (steps[i - 1].clone(), known.known(i).cloned());
        Draft {
            start: known.known(0).expect("the start is always cached").clone(),
            steps: (1..=last).map(step).collect(),
        }
    }
}

impl Draft {
    /// The hairstyle after the last step.
    fn last(&self) -> &Arc<Hairstyle> {
        let known = self.steps.last().and_then(|(_, hair)| hair.as_ref());
        known.unwrap_or(&self.start)
    }

    /// The hairstyle after the step at an index, if that is of the same kind as `operation`.
    fn after(&self, index: usize, operation: &Operation) -> Option<&Hairstyle> {
        let (step, hair) = self.steps.get(index)?;
        let same = discriminant(step) == discriminant(operation);
        hair.as_deref().filter(|_| same)
    }
}
