//! `frisure transfer`: the hair of a groom, on another head.

use std::path::Path;

use frisure::scene::{GroomFile, Scene};
use frisure_engine::Error;

use super::predict;
use crate::args::{Predict, Quality, Tracing, Transfer};
use crate::diagnostics::ExitStatus;
use crate::pictures::Views;

/// Predicts the scene of the groom on the other head.
pub(crate) fn run(arguments: Transfer, quiet: bool) -> Result<ExitStatus, Error> {
    let Transfer { groom, from, to, outputs, writing, image, report, hair_type, read } = arguments;
    let text = hair_type.map_or(String::new(), |of| format!("hair.type = \"{}\"\n", of.name));
    let mut scene = Scene::parse("", text, Path::new(""))?;
    let frame = read.axes().choice();
    let file = GroomFile { frame, head: Some(from), ..GroomFile::new(groom.clone()) };
    (scene.head, scene.groom) = (to, Some(file));
    let arguments = Predict {
        scene: groom,
        outputs,
        image,
        report,
        camera: Vec::new(),
        quality: Quality::Preview,
        tracing: Tracing::default(),
        each_step: false,
        time_samples: false,
        interval: 1.0,
        replicas: None,
        writing,
        fibres: false,
        accessories: false,
    };
    predict::run_scene(&arguments, scene, Views::Cameras(Vec::new()), quiet)
}
