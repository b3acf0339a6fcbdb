//! Pictures and films, made beside while styling goes on.

use std::sync::Arc;

use frisure_engine::{Request, Response};

use super::desk::Purpose;
use super::{Destination, Errand, Salon, Save};

/// What is to be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shot {
    /// A traced picture.
    Picture {
        /// Pixels across and down.
        size: [usize; 2],
        /// Most paths per pixel.
        paths: usize,
        /// Noise at which it is good enough (part of a display's scale).
        noise: f64,
    },
    /// A film around the head (animated PNG).
    Turntable {
        /// Pixels across and down.
        size: [usize; 2],
        /// How many pictures.
        frames: usize,
    },
}

/// A final picture as it is so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposed {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Red, green, blue, alpha (sRGB), rows from the top.
    pub rgba: Arc<Vec<u8>>,
    /// How far it is (0 to 1).
    pub fraction: f32,
    /// Its noise (part of a display's scale).
    pub noise: f32,
    /// Differs for each state of it.
    pub version: u64,
}

impl Salon {
    pub(super) fn shoot(&mut self, shot: Shot, to: Destination) {
        let Some(asked) = self.asked() else { return };
        let viewpoint = Some(self.orbit.viewpoint());
        let order = match shot {
            Shot::Picture { size, paths, noise } => {
                Request::Picture { scene: asked.clone(), viewpoint, size, paths, noise }
            }
            Shot::Turntable { size, frames } => {
                Request::Turntable { scene: asked.clone(), viewpoint, size, frames }
            }
        };
        self.exposed = None;
        self.desk.queue(Purpose::File(to), asked, order);
    }

    /// Takes an answer about work that is done beside.
    pub(super) fn receive_aside(&mut self, answer: Response) {
        match answer {
            Response::Progress { stage, fraction } => {
                self.aside_progress = Some((stage, fraction));
                return;
            }
            Response::PartialPicture { size, rgba, fraction, noise } => {
                self.version += 1;
                let (rgba, version) = (Arc::new(rgba), self.version);
                self.exposed = Some(Exposed { size, rgba, fraction, noise, version });
                self.aside_progress = Some(("picture".into(), fraction));
                return;
            }
            _ => {}
        }
        let Some(job) = self.desk.aside.take() else { return };
        self.aside_progress = None;
        match (answer, job.purpose) {
            _ if job.outdated => self.tell("Stopped.", "", false),
            (Response::File { bytes, .. }, Purpose::File(to)) => {
                let save = Save { to, bytes, is_scene: false };
                self.desk.errands.push_back(Errand::Save(save));
            }
            (Response::Preview(hair), Purpose::Compare(edit)) => {
                self.version += 1;
                let version = self.version;
                if let Some(compared) = self.compared.as_mut().filter(|c| c.edit == edit) {
                    (compared.hair, compared.version) = (Some(Arc::new(*hair)), version);
                }
            }
            (Response::Failed(refusal), purpose) => {
                self.complain(&refusal);
                if matches!(purpose, Purpose::Compare(_)) {
                    self.compared = None;
                }
            }
            _ => {}
        }
        self.desk.advance();
    }
}
