//! The hairstyles of a scene from before its first step to after its last.

use std::sync::Arc;

use frisure::hairstyle::styling::{Cut, CutLine, Operation, StyleError};
use frisure::hairstyle::{StyleOptions, guide_strands, selected, style};
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
        let mut styled = StyledScene { stages: Vec::new(), steps: Vec::new() };
        let mut cuts: Vec<(usize, Vec<bool>, f64)> = Vec::new();
        for (index, operation) in scene.steps().iter().enumerate() {
            let failed = |e: StyleError| Error::of_step(index, &e, scene);
            let (before, head) = (&last.hairstyle, &last.head);
            let wisps = match operation.selection() {
                Some(selection) => selected(before, head, selection).map_err(failed)?,
                None => vec![true; before.guides().len()],
            };
            let mut stages = Vec::new();
            let options =
                StyleOptions { stages: all.then_some(&mut stages), ..StyleOptions::default() };
            let after = style(before, head, operation, options, progress).map_err(failed)?;
            styled.steps.push(StepReport::new(operation, before, &after, &wisps));
            if let Operation::Cut(Cut { line: CutLine::Below(height), .. }) = operation {
                cuts.push((index, wisps, height.on(head)));
            }
            for hairstyle in stages.into_iter().chain([after]) {
                let next = LoadedScene { hairstyle: Arc::new(hairstyle), ..last.clone() };
                let before = std::mem::replace(&mut last, next);
                if all {
                    styled.stages.push(before);
                }
            }
        }
        for (index, wisps, line) in cuts {
            styled.steps[index].add_cut(line, &last.hairstyle, &wisps);
        }
        styled.stages.push(last);
        Ok(styled)
    }
}
