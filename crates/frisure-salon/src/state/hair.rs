//! The hair that follows from the text: when it is asked for, and how well.

use std::sync::Arc;

use frisure::hairstyle::HairstyleSpec;
use frisure::hairstyle::styling::{Operation, Release};
use frisure::scene::{GroomFile, HeadSource, write_step};
use frisure_engine::{Diagnostic, Preview, Quality, Request, Response};

use super::desk::{Job, Purpose};
use super::{FILES_PANEL, HeadMesh, Salon, Seen, Understood};

/// What the shape of the hair depends on: two scenes with the same key have the same hair.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct HairKey {
    spec: HairstyleSpec,
    steps: Vec<Operation>,
    head: HeadSource,
    groom: Option<GroomFile>,
}

impl HairKey {
    pub(super) fn of(understood: &Understood) -> Self {
        Self {
            spec: understood.spec.clone(),
            steps: understood.scene.steps().to_vec(),
            head: understood.scene.head.clone(),
            groom: understood.scene.groom.clone(),
        }
    }
}

/// How the hair that is seen stands to the text.
#[derive(Clone, Debug, PartialEq)]
pub enum Badge {
    /// There is none.
    Empty,
    /// It is on its way.
    Settling,
    /// It is at rest, every guide at a minimum of its energy.
    AtRest,
    /// It has come to rest where a breath would move it, or not come to rest: so many guides.
    Unstable(usize),
    /// What the text says cannot be; the hair is what it was before.
    Refused(String),
}

/// Most coarse answers one after the other to one text, while a slider is held and when it is not: exact
/// work takes seconds, and hair that has not come far yet is no sight.
const ROUGH_HELD: usize = 30;
const ROUGH: usize = 3;

/// Points along a hair that is looked at alone.
const ALONE: usize = 120;

impl Salon {
    /// How the hair stands.
    #[must_use]
    pub fn badge(&self) -> Badge {
        let Some(understood) = &self.scene else { return Badge::Empty };
        let key = HairKey::of(understood);
        if let Some((_, refusal)) = self.refused.as_ref().filter(|(refused, _)| *refused == key) {
            return Badge::Refused(refusal.problem.clone());
        }
        let Some(seen) = self.shown.as_ref().filter(|seen| seen.key.as_ref() == Some(&key)) else {
            return Badge::Settling;
        };
        let numbers = &seen.hair.numbers;
        match numbers.unstable + numbers.moving {
            _ if seen.hair.quality == Quality::Coarse => Badge::Settling,
            0 => Badge::AtRest,
            n => Badge::Unstable(n),
        }
    }

    /// Whether the hair that is seen is that of the text, at rest.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        matches!(self.badge(), Badge::AtRest | Badge::Unstable(_))
    }

    /// Starts what is to be done next for the hair, and stops what is for nothing.
    pub(super) fn schedule(&mut self) {
        if self.look_into_files() {
            return;
        }
        let (Some(understood), Some(asked)) = (self.scene.clone(), self.asked()) else { return };
        let key = HairKey::of(&understood);
        let effort = self.wanted(&key);
        if let Some(job) = &self.desk.hair {
            // Coarse work is short, and shows the way; exact work on another text is for nothing.
            let other = job.asked != asked || effort.is_some_and(|e| e == Quality::Coarse);
            // Hair of another program takes as long for the eye.
            let held = self.document.as_ref().is_some_and(super::Document::is_draft);
            let is_long = matches!(job.purpose, Purpose::Show(Quality::Exact))
                || key.groom.is_some() && !held;
            if other && is_long && self.differs(&job.asked.text, &key) {
                self.desk.outdate();
            }
            return;
        }
        match effort {
            Some(effort) => {
                self.progress = None;
                let order = Request::Preview { scene: asked.clone(), quality: effort };
                self.desk.start(Purpose::Show(effort), asked, order);
            }
            None => self.ask_about_it(asked),
        }
    }

    /// Whether a text has other hair than a key.
    fn differs(&self, text: &str, key: &HairKey) -> bool {
        let Some(document) = &self.document else { return true };
        let other = super::command::understand(document, text);
        !other.is_ok_and(|other| HairKey::of(&other) == *key)
    }

    /// How well the hair of a key is to be computed now; `None` if it is there, or cannot be.
    fn wanted(&self, key: &HairKey) -> Option<Quality> {
        if self.refused.as_ref().is_some_and(|(refused, _)| refused == key) {
            return None;
        }
        let held = self.document.as_ref().is_some_and(super::Document::is_draft);
        let Some(seen) = self.shown.as_ref().filter(|seen| seen.key.as_ref() == Some(key)) else {
            return Some(Quality::Coarse);
        };
        let most = if held { ROUGH_HELD } else { ROUGH };
        match seen.hair.quality {
            Quality::Exact => None,
            // Each coarse answer goes on from the last.
            Quality::Coarse if seen.hair.numbers.moving > 0 && seen.rough < most => {
                Some(Quality::Coarse)
            }
            Quality::Coarse if held => None,
            Quality::Coarse => Some(Quality::Exact),
        }
    }

    /// What else is asked about hair that is there.
    fn ask_about_it(&mut self, asked: frisure_engine::SceneRef) {
        let Some(version) = self.shown.as_ref().map(|seen| seen.version) else { return };
        if !self.chosen.is_everything() && self.chosen.wisps.is_none() {
            let step = Operation::Release(Release { selection: self.chosen.selection.clone() });
            match write_step(&step) {
                Ok(text) => {
                    let step = text.trim_start_matches("[[step]]").trim().to_owned();
                    let order = Request::Select { scene: asked.clone(), step };
                    self.desk.start(Purpose::Choose, asked, order);
                }
                Err(e) => {
                    self.tell(e.to_string(), "Choose other hair.", true);
                    self.chosen = super::Chosen::default();
                }
            }
            return;
        }
        if let Some(alone) = self.alone.as_ref().filter(|alone| alone.version != version) {
            let order = Request::Guide { scene: asked.clone(), wisp: alone.wisp, points: ALONE };
            self.desk.start(Purpose::Hair, asked, order);
        }
    }

    /// Takes an answer about the hair.
    pub(super) fn receive_hair(&mut self, answer: Response) {
        if let Response::Progress { stage, fraction } = answer {
            self.progress = Some((stage, fraction));
            return;
        }
        let Some(job) = self.desk.hair.take() else { return };
        if job.purpose == Purpose::Contents {
            return self.looked_into(answer);
        }
        match answer {
            Response::Preview(hair) => self.show(&job.asked.text, *hair, job.outdated),
            _ if job.outdated => {}
            Response::Selected(wisps) => self.chosen.wisps = Some(wisps),
            Response::Guide(hair) => self.show_alone(*hair),
            Response::Failed(refusal) => self.refuse(&job, refusal),
            _ => {}
        }
    }

    fn refuse(&mut self, job: &Job, refusal: Diagnostic) {
        match job.purpose {
            Purpose::Choose => self.chosen = super::Chosen::default(),
            Purpose::Hair => self.alone = None,
            _ => {
                // Of a text that nobody edits any more nobody wants to know.
                let now = self.scene.as_ref().map(|understood| HairKey::of(understood));
                let Some(key) = now.filter(|key| !self.differs(&job.asked.text, key)) else {
                    return;
                };
                self.refused = Some((key, refusal.clone()));
            }
        }
        self.complain(&refusal);
    }

    fn show(&mut self, text: &str, mut hair: Preview, outdated: bool) {
        if let Some(head) = hair.head.take() {
            if !head.note.is_empty() {
                let hint = format!("Choose another under “{FILES_PANEL}”.");
                self.tell(head.note.clone(), hint, false);
            }
            self.head = Some(Arc::new(HeadMesh::new(head)));
        }
        let Some(document) = &self.document else { return };
        let Ok(understood) = super::command::understand(document, text) else { return };
        let key = HairKey::of(&understood);
        // Hair that is out of date is better than older hair while a slider moves, but not
        // than newer.
        let newest = self.scene.as_ref().is_some_and(|u| HairKey::of(u) == key);
        if outdated && !newest {
            return;
        }
        self.version += 1;
        self.tell_what_fell(&hair);
        self.tell_how_it_was_held(&hair);
        let known = self.shown.as_ref().filter(|seen| seen.key.as_ref() == Some(&key));
        let rough = known.map_or(0, |seen| seen.rough) + 1;
        self.shown =
            Some(Seen { key: Some(key), hair: Arc::new(hair), version: self.version, rough });
        self.falling = None;
        if !self.framed {
            self.framed = true;
            self.frame_all(1.0);
        }
    }

    fn show_alone(&mut self, hair: frisure_engine::GuideData) {
        let version = self.shown.as_ref().map_or(0, |seen| seen.version);
        let wisp = hair.wisp;
        self.alone = Some(super::Alone { wisp, hair: Some(Arc::new(hair)), version });
    }

    /// After a step that took hair away, how much.
    fn tell_what_fell(&mut self, hair: &Preview) {
        if hair.quality != Quality::Exact {
            return;
        }
        let Some(mass) = self.mass_before.take() else { return };
        let fell = mass - hair.numbers.mass;
        if fell > 1e-7 {
            self.tell(format!("{:.1} g of hair fell.", fell * 1e3), "", false);
        }
    }

    /// How well hair of another program hangs as it was modelled, when that is new.
    fn tell_how_it_was_held(&mut self, hair: &Preview) {
        if hair.quality != Quality::Exact || hair.adoption == self.held {
            return;
        }
        self.held.clone_from(&hair.adoption);
        let Some(held) = &hair.adoption else { return };
        let hint = match held.unstable {
            0 => "",
            _ => "A stiffer or thicker fibre, or a shorter lock, holds more.",
        };
        self.tell(format!("groom: {held}"), hint, false);
    }

    /// Brings all of the hair and the head into a picture of an aspect.
    pub(super) fn frame_all(&mut self, aspect: f64) {
        let Some(seen) = &self.shown else { return };
        let hair = bounds(&seen.hair.strands.points);
        let head = self.head.as_ref().map(|head| head.framed());
        let all = match (hair, head) {
            (Some(a), Some(b)) => (a.0.min(b.0), a.1.max(b.1)),
            (Some(a), None) | (None, Some(a)) => a,
            (None, None) => return,
        };
        self.orbit.frame(all, aspect);
    }
}

/// The box around points, three numbers each (m).
fn bounds(points: &[f32]) -> Option<(glam::DVec3, glam::DVec3)> {
    let points = points.chunks_exact(3).map(|p| glam::Vec3::new(p[0], p[1], p[2]).as_dvec3());
    let mut points = points.filter(|p| p.is_finite());
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
}
