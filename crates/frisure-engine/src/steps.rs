//! The hairstyles of a scene from before its first step to after its last.

use std::sync::Arc;

use frisure::hairstyle::styling::{Cut, CutLine, Operation};
use frisure::hairstyle::{Hairstyle, StyleOptions, guide_strands, selected, style};
use frisure::progress::Progress;
use frisure::scene::Scene;
use frisure::strands::Strands;

use crate::error::Error;
use crate::quality::Quality;
use crate::report::StepReport;
use crate::runner::{LoadedScene, Runner};

/// Points of each guide by which the camera of several pictures is placed; chosen.
const FRAMED_POINTS: usize = 24;

/// A scene after its steps.
#[derive(Debug)]
pub struct StyledScene {
    /// The hairstyle before the first step and after each stage of each step if all are wanted, or the last alone.
    pub stages: Vec<LoadedScene>,
    /// The effect of each step.
    pub steps: Vec<StepReport>,
}

/// The length of [`StyledScene::stages`] if all are wanted.
#[must_use]
pub fn stage_count(scene: &Scene) -> usize {
    let stages = |operation: &Operation| match operation {
        Operation::Grow(grow) => grow.stages,
        _ => 1,
    };
    1 + scene.steps().iter().map(stages).sum::<usize>()
}

impl StyledScene {
    /// The guides of all stages, so that the pictures of all have one camera.
    #[must_use]
    pub fn all_guides(&self) -> Strands {
        let mut all = Strands::new();
        for stage in &self.stages {
            for guide in guide_strands(&stage.hairstyle, FRAMED_POINTS).iter() {
                all.push(guide.points, guide.radii);
            }
        }
        all
    }
}

/// The effects of steps, one by one.
#[derive(Default)]
struct StepReports {
    reports: Vec<StepReport>,
    /// Steps that cut below a height (m): their index, the wisps that they act on, the height.
    cuts: Vec<(usize, Vec<bool>, f64)>,
}

impl StepReports {
    /// Adds the next step of a scene, from the hairstyles before and after it.
    fn add(
        &mut self,
        operation: &Operation,
        before: &LoadedScene,
        after: &Hairstyle,
    ) -> Result<(), Error> {
        let (index, head) = (self.reports.len(), &before.head);
        let wisps = match operation.selection() {
            Some(selection) => selected(&before.hairstyle, head, selection)
                .map_err(|e| Error::of_step(index, &e, &before.scene))?,
            None => vec![true; before.hairstyle.guides().len()],
        };
        self.reports.push(StepReport::new(operation, &before.hairstyle, after, &wisps));
        if let Operation::Cut(Cut { line: CutLine::Below(height), .. }) = operation {
            self.cuts.push((index, wisps, height.on(head)));
        }
        Ok(())
    }

    /// The reports, given the hairstyle after all steps.
    fn finish(mut self, last: &Hairstyle) -> Vec<StepReport> {
        for (index, wisps, line) in self.cuts {
            self.reports[index].add_cut(line, last, &wisps);
        }
        self.reports
    }
}

impl Runner {
    /// Executes all steps of a scene and reports the effect of each; keeps all stages, or the last alone.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn load_stages(
        &mut self,
        scene: &Arc<Scene>,
        all: bool,
        progress: &dyn Progress,
    ) -> Result<StyledScene, Error> {
        let mut last = self.load(scene, 0, Quality::Exact, progress)?;
        let mut kept = Vec::new();
        let mut reports = StepReports::default();
        for (index, operation) in scene.steps().iter().enumerate() {
            let mut stages = Vec::new();
            let options =
                StyleOptions { stages: all.then_some(&mut stages), ..StyleOptions::default() };
            let after = style(&last.hairstyle, &last.head, operation, options, progress)
                .map_err(|e| Error::of_step(index, &e, scene))?;
            reports.add(operation, &last, &after)?;
            for hairstyle in stages.into_iter().chain([after]) {
                let next = LoadedScene { hairstyle: Arc::new(hairstyle), ..last.clone() };
                let before = std::mem::replace(&mut last, next);
                if all {
                    kept.push(before);
                }
            }
        }
        let steps = reports.finish(&last.hairstyle);
        kept.push(last);
        Ok(StyledScene { stages: kept, steps })
    }

    /// Reports the effect of each step of a scene, as [`Self::load_stages`], from hairstyles that are cached as far as possible.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn step_reports(
        &mut self,
        scene: &Arc<Scene>,
        progress: &dyn Progress,
    ) -> Result<Vec<StepReport>, Error> {
        let mut reports = StepReports::default();
        let mut last = self.load(scene, 0, Quality::Exact, progress)?;
        for (index, operation) in scene.steps().iter().enumerate() {
            let after = self.load(scene, index + 1, Quality::Exact, progress)?;
            reports.add(operation, &last, &after.hairstyle)?;
            last = after;
        }
        Ok(reports.finish(&last.hairstyle))
    }
}
