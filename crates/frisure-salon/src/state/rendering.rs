//! Background jobs: final pictures, turntables, and the hair to compare with.

use std::sync::Arc;

use frisure::formats::picture::scene_text;
use frisure_engine::{Quality, Request, Response, SceneRef};

use super::jobs::{Destination, Effect, Purpose, Save};
use super::salon::{Compared, Comparison, PartialPicture, Salon, parse, scene_ref};
use crate::locale::tr;

/// A picture or film to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RenderTask {
    /// A path-traced picture.
    Picture {
        /// Width and height (pixels).
        size: [usize; 2],
        /// Maximum number of paths per pixel.
        paths: usize,
        /// Noise at which rendering stops (as a fraction of the display's range).
        noise: f64,
    },
    /// A film around the head (animated PNG).
    Turntable {
        /// Width and height (pixels).
        size: [usize; 2],
        /// Number of frames.
        frames: usize,
    },
    /// A film of the edits so far, from the first one (animated PNG).
    Film {
        /// Width and height (pixels).
        size: [usize; 2],
    },
}

impl Salon {
    pub(super) fn render(&mut self, task: RenderTask, to: Destination) {
        let Some(scene) = self.scene_ref() else { return };
        let (asked, viewpoint) = (scene.clone(), Some(self.orbit.viewpoint()));
        let request = match task {
            RenderTask::Picture { size, paths, noise } => {
                Request::Picture { scene: asked, viewpoint, size, paths, noise }
            }
            RenderTask::Turntable { size, frames } => {
                Request::Turntable { scene: asked, viewpoint, size, frames }
            }
            RenderTask::Film { size } => Request::Film { scenes: self.edits(), viewpoint, size },
        };
        self.partial_picture = None;
        self.jobs.enqueue(Purpose::File(to), scene, request);
    }

    /// The texts of the edits so far.
    fn edits(&self) -> Vec<SceneRef> {
        let Some(document) = &self.document else { return Vec::new() };
        let edits = document.edits().iter().take(document.at() + 1);
        let scene = |text: &str| {
            let parsed = parse(document, text).ok()?;
            Some(scene_ref(document, text, &parsed))
        };
        edits.filter_map(|edit| scene(&edit.text)).collect()
    }

    /// Shows the hair of an earlier text beside the current one; `None` ends it.
    pub(super) fn compare(&mut self, edit: Option<usize>) {
        self.comparison = None;
        let Some((document, edit)) = self.document.as_ref().zip(edit) else { return };
        let Some(before) = document.edits().get(edit) else { return };
        let Ok(parsed) = parse(document, &before.text) else { return };
        let scene = scene_ref(document, &before.text, &parsed);
        let label = before.label.clone();
        self.comparison =
            Some(Comparison { of: Compared::Edit(edit), label, hair: None, version: 0 });
        let request = Request::Preview { scene: scene.clone(), quality: Quality::Exact };
        self.jobs.enqueue(Purpose::Compare(edit), scene, request);
    }

    /// Takes a response to a background job.
    pub(super) fn receive_background(&mut self, response: Response) {
        match response {
            Response::Progress { stage, fraction } => {
                self.background_progress = Some((stage, fraction));
                return;
            }
            Response::PartialPicture { size, rgba, fraction, noise } => {
                self.version += 1;
                let (rgba, version) = (Arc::new(rgba), self.version);
                self.partial_picture = Some(PartialPicture { size, rgba, noise, version });
                self.background_progress = Some(("picture".into(), fraction));
                return;
            }
            _ => {}
        }
        let Some(job) = self.jobs.background.take() else { return };
        self.background_progress = None;
        match (response, job.purpose) {
            _ if job.outdated => self.notify(tr!("stopped"), "", false),
            (Response::File { bytes, .. }, Purpose::File(to)) => {
                // A picture opens again as the scene that it shows; grooms are left as they are.
                let bytes = scene_text::embed(bytes, &job.scene.text);
                self.jobs.effects.push_back(Effect::Save(Save { to, bytes, is_scene: false }));
            }
            (Response::Preview(hair), Purpose::Compare(edit)) => {
                self.version += 1;
                let version = self.version;
                if let Some(comparison) =
                    self.comparison.as_mut().filter(|c| c.of == Compared::Edit(edit))
                {
                    (comparison.hair, comparison.version) = (Some(Arc::new(*hair)), version);
                }
            }
            (Response::Preview(hair), Purpose::Exercise(version, part)) => {
                self.take_goal(version, part, *hair);
            }
            (Response::Failed(error), purpose) => {
                self.report_error(&error);
                if matches!(purpose, Purpose::Compare(_)) {
                    self.comparison = None;
                }
            }
            _ => {}
        }
        self.jobs.advance();
    }
}
