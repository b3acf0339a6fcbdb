//! The files of `frisure predict`.

use std::path::{Path, PathBuf};

use frisure::hairstyle::HairstyleSpec;
use frisure::scene::Scene;
use frisure_engine::checkpoint::HairCheckpoint;
use frisure_engine::{Error, input_files, stage_count};

use crate::args::{Predict, Quality};
use crate::outputs::numbered;
use crate::pictures::{self, Views};

/// The files of one hairstyle.
pub(super) struct StageFiles {
    pub(super) grooms: Vec<PathBuf>,
    pub(super) image: Option<PathBuf>,
    /// Where simulated hairs are saved until the other files are written.
    pub(super) hair_checkpoint: Option<PathBuf>,
}

/// The files of each hairstyle: numbered with `--each-step`, or those of the last alone; the last writes those of all
/// times.
pub(super) fn stages(arguments: &Predict, scene: &Scene, spec: &HairstyleSpec) -> Vec<StageFiles> {
    let Predict { outputs, image, report, each_step, time_samples, .. } = arguments;
    let count = if *each_step { stage_count(scene) } else { 1 };
    let files = |stage: usize| {
        let named = |path: &PathBuf| match each_step {
            true => numbered(path, stage, count),
            false => path.clone(),
        };
        let first = outputs.first().or(image.as_ref()).or(report.as_ref());
        let grooms = match time_samples {
            true if stage + 1 < count => Vec::new(),
            true => outputs.clone(),
            false => outputs.iter().map(named).collect(),
        };
        StageFiles {
            grooms,
            image: image.as_ref().map(named),
            hair_checkpoint: first.and_then(|p| HairCheckpoint::path_for(&named(p), spec)),
        }
    };
    (0..count).map(files).collect()
}

/// Checks that all files can be written and that none is read.
pub(super) fn prepare(
    arguments: &Predict,
    scene: &Scene,
    stages: &[StageFiles],
    views: &Views,
) -> Result<(), Error> {
    let mut inputs = input_files(scene);
    inputs.push(&arguments.scene);
    let images = stages.iter().filter_map(|stage| stage.image.as_deref());
    let images: Vec<PathBuf> = images.flat_map(|path| views.paths(path)).collect();
    let mut others: Vec<&Path> =
        stages.iter().flat_map(|stage| &stage.grooms).map(PathBuf::as_path).collect();
    others.extend(arguments.report.as_deref());
    let finals = match arguments.quality {
        Quality::Final => &images[..],
        Quality::Preview => {
            others.extend(images.iter().map(PathBuf::as_path));
            &[]
        }
    };
    pictures::prepare(finals, &others, &inputs)?;
    stages.iter().filter_map(|s| s.hair_checkpoint.as_deref()).try_for_each(HairCheckpoint::check)
}
