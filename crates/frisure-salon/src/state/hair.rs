//! Scheduling of requests for the hair of the current text, and their effort.

use std::sync::Arc;

use frisure::hairstyle::styling::{Operation, Release, Selection};
use frisure::scene::write_step;
use frisure_engine::{Diagnostic, GuideData, Preview, Quality, Request, Response, SceneRef};
use glam::{DVec3, Vec3};

use super::controls::files_panel;
use super::head_mesh::HeadMesh;
use super::jobs::{Job, Purpose};
use super::salon::{CurrentHair, HairKey, IsolatedHair, Salon, parse};
use super::selection::Selected;
use crate::locale::{self, tr};

/// Whether the shown hair is that of the text, and in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub enum Badge {
    /// There is no hair.
    Empty,
    /// The computation of the hair is running.
    Settling,
    /// Every guide is at a minimum of its energy.
    AtRest,
    /// The number of guides that are unstable or not converged.
    Unstable(usize),
    /// The hair of the text cannot be computed; that of an earlier text is shown.
    Refused(String),
}

/// Maximum number of coarse responses to one text before the exact one, during a drag of a slider or of the comb and otherwise. An exact
/// computation takes seconds, and early coarse hair is far from its equilibrium. Chosen by trial.
const MAX_COARSE_DRAGGING: usize = 30;
const MAX_COARSE: usize = 3;

/// Number of points along a hair that is shown alone.
const ISOLATED_POINTS: usize = 120;

impl Salon {
    /// Whether the shown hair is that of the text, and in equilibrium.
    #[must_use]
    pub fn badge(&self) -> Badge {
        let Some(parsed) = &self.scene else { return Badge::Empty };
        let key = HairKey::of(parsed);
        if let Some((_, error)) = self.refused.as_ref().filter(|(refused, _)| *refused == key) {
            return Badge::Refused(error.problem.clone());
        }
        let Some(current) = self.current_of(&key) else { return Badge::Settling };
        let numbers = &current.hair.numbers;
        match numbers.unstable + numbers.moving {
            _ if current.hair.quality == Quality::Coarse => Badge::Settling,
            0 => Badge::AtRest,
            n => Badge::Unstable(n),
        }
    }

    /// Whether the shown hair is that of the text, in equilibrium.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        matches!(self.badge(), Badge::AtRest | Badge::Unstable(_))
    }

    /// The shown hair, if it has a key.
    fn current_of(&self, key: &HairKey) -> Option<&CurrentHair> {
        self.current.as_ref().filter(|current| current.key.as_ref() == Some(key))
    }

    /// Starts the next job for the shown hair, or cancels an outdated one.
    pub(super) fn schedule(&mut self) {
        if self.inspect_next_file() {
            return;
        }
        self.update_sections();
        let (Some(parsed), Some(scene)) = (self.scene.clone(), self.scene_ref()) else { return };
        let key = HairKey::of(&parsed);
        let effort = self.wanted(&key);
        if let Some(job) = &self.jobs.hair {
            // A coarse job is short and its hair is shown; an exact one for another text is cancelled.
            let other = job.scene != scene || effort.is_some_and(|e| e == Quality::Coarse);
            // A coarse job for a groom takes as long as an exact one.
            let is_long = matches!(job.purpose, Purpose::Show(Quality::Exact))
                || key.groom.is_some() && !self.is_dragging();
            if other && is_long && self.differs(&job.scene.text, &key) {
                self.jobs.cancel_hair();
            }
            return;
        }
        match effort {
            Some(effort) => {
                self.progress = None;
                let request = Request::Preview { scene: scene.clone(), quality: effort };
                self.jobs.start(Purpose::Show(effort), scene, request);
            }
            None => self.request_details(scene),
        }
    }

    /// Whether the hair of a text has another key.
    fn differs(&self, text: &str, key: &HairKey) -> bool {
        let Some(document) = &self.document else { return true };
        !parse(document, text).is_ok_and(|other| HairKey::of(&other) == *key)
    }

    /// The effort of the next computation of a key's hair; `None` if the hair is complete or refused.
    fn wanted(&self, key: &HairKey) -> Option<Quality> {
        if self.refused.as_ref().is_some_and(|(refused, _)| refused == key) {
            return None;
        }
        let dragging = self.is_dragging();
        let Some(current) = self.current_of(key) else { return Some(Quality::Coarse) };
        let most = if dragging { MAX_COARSE_DRAGGING } else { MAX_COARSE };
        match current.hair.quality {
            Quality::Exact => None,
            // Each coarse response continues from the one before.
            Quality::Coarse if current.hair.numbers.moving > 0 && current.coarse_count < most => {
                Some(Quality::Coarse)
            }
            Quality::Coarse if dragging => None,
            Quality::Coarse => Some(Quality::Exact),
        }
    }

    /// Requests the wisps of a new selection, or the hair that is shown alone.
    fn request_details(&mut self, scene: SceneRef) {
        let Some(version) = self.current.as_ref().map(|current| current.version) else { return };
        if !self.selected.is_everything() && self.selected.wisps.is_none() {
            let selection = self.selected.selection.clone();
            match self.select_request(&scene, &selection) {
                Some(request) => self.jobs.start(Purpose::Select, scene, request),
                None => self.selected = Selected::default(),
            }
            return;
        }
        if self.request_section(&scene) {
            return;
        }
        if let Some(isolated) = self.isolated.as_ref().filter(|hair| hair.version != version) {
            let (asked, wisp) = (scene.clone(), isolated.wisp);
            let request = Request::Guide { scene: asked, wisp, points: ISOLATED_POINTS };
            self.jobs.start(Purpose::Isolate, scene, request);
        }
    }

    /// The request for the wisps of a selection; `None` and a message for one that no step can say.
    pub(super) fn select_request(
        &mut self,
        scene: &SceneRef,
        selection: &Selection,
    ) -> Option<Request> {
        match write_step(&Operation::Release(Release { selection: selection.clone() })) {
            Ok(text) => {
                let step = text.trim_start_matches("[[step]]").trim().to_owned();
                Some(Request::Select { scene: scene.clone(), step })
            }
            Err(e) => {
                self.notify(e.to_string(), tr!("select-other"), true);
                None
            }
        }
    }

    /// Takes a response to a job for the shown hair.
    pub(super) fn receive_hair(&mut self, response: Response) {
        if let Response::Progress { stage, fraction } = response {
            self.progress = Some((stage, fraction));
            return;
        }
        let Some(job) = self.jobs.hair.take() else { return };
        if job.purpose == Purpose::Contents {
            return self.file_inspected(response);
        }
        match response {
            Response::Preview(hair) => self.show(&job.scene.text, *hair, job.outdated),
            _ if job.outdated => {}
            Response::Selected(wisps) => match job.purpose {
                Purpose::Section(index) => self.take_section(index, wisps),
                _ => self.selected.wisps = Some(wisps),
            },
            Response::Guide(hair) => self.show_isolated(*hair),
            Response::Failed(error) => self.refuse(&job, error),
            _ => {}
        }
    }

    fn refuse(&mut self, job: &Job, error: Diagnostic) {
        match job.purpose {
            Purpose::Select => self.selected = Selected::default(),
            Purpose::Isolate => self.isolated = None,
            // A section without hair of this scene is a list entry without effect.
            Purpose::Section(index) => self.take_section(index, Vec::new()),
            _ => {
                // An error of a text that is not the current one is not reported.
                let now = self.scene.as_ref().map(|parsed| HairKey::of(parsed));
                let Some(key) = now.filter(|key| !self.differs(&job.scene.text, key)) else {
                    return;
                };
                self.refused = Some((key, error.clone()));
            }
        }
        self.report_error(&error);
    }

    fn show(&mut self, text: &str, mut hair: Preview, outdated: bool) {
        if let Some(head) = hair.head.take() {
            if !head.note.is_empty() {
                let hint = tr!("choose-under", panel = &*files_panel());
                self.notify(head.note.clone(), hint, false);
            }
            self.head = Some(Arc::new(HeadMesh::new(head)));
        }
        let Some(document) = &self.document else { return };
        let Ok(parsed) = parse(document, text) else { return };
        let key = HairKey::of(&parsed);
        // Outdated hair is shown only if its text has the same hair as the current one.
        let newest = self.scene.as_ref().is_some_and(|parsed| HairKey::of(parsed) == key);
        if outdated && !newest {
            return;
        }
        self.version += 1;
        if hair.quality == Quality::Exact {
            self.report_cut_mass(&hair);
            self.report_groom_fit(&hair);
        }
        let coarse_count = self.current_of(&key).map_or(0, |current| current.coarse_count) + 1;
        let (key, hair, version) = (Some(key), Arc::new(hair), self.version);
        self.current = Some(CurrentHair { key, hair, version, coarse_count });
        self.cut_preview = None;
        if !self.framed {
            self.framed = true;
            self.frame_all(1.0);
        }
    }

    fn show_isolated(&mut self, hair: GuideData) {
        let version = self.current.as_ref().map_or(0, |current| current.version);
        let wisp = hair.wisp;
        self.isolated = Some(IsolatedHair { wisp, hair: Some(Arc::new(hair)), version });
    }

    /// After a cut, reports the mass of the hair that was cut off.
    fn report_cut_mass(&mut self, hair: &Preview) {
        let Some(mass) = self.mass_before.take() else { return };
        let cut_off = mass - hair.numbers.mass;
        if cut_off > 1e-7 {
            let grams = locale::number(cut_off * 1e3, 1);
            self.notify(tr!("cut-off", grams = grams), "", false);
        }
    }

    /// Reports how closely a groom's hair keeps its modelled shape, when that changes.
    fn report_groom_fit(&mut self, hair: &Preview) {
        if hair.adoption == self.held {
            return;
        }
        self.held.clone_from(&hair.adoption);
        let Some(held) = &hair.adoption else { return };
        let hint = match held.unstable {
            0 => String::new(),
            _ => tr!("groom-fit.hint"),
        };
        self.notify(tr!("groom-fit", report = held.to_string()), hint, false);
    }

    /// Frames the hair and the head in a picture of an aspect ratio.
    pub(super) fn frame_all(&mut self, aspect: f64) {
        let Some(current) = &self.current else { return };
        let hair = bounds(&current.hair.strands.points);
        let head = self.head.as_ref().map(|head| head.framed());
        let boxes = hair.into_iter().chain(head);
        if let Some(all) = boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) {
            self.orbit.frame(all, aspect);
        }
    }
}

/// The bounding box of points, three numbers each (m).
fn bounds(points: &[f32]) -> Option<(DVec3, DVec3)> {
    let points = points.chunks_exact(3).map(|p| Vec3::new(p[0], p[1], p[2]).as_dvec3());
    let points = points.filter(|p| p.is_finite());
    points.map(|p| (p, p)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}
