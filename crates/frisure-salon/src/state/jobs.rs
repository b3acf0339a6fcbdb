//! The jobs of the engine that are running or queued, and the effects for the program around the salon.
//!
//! The hair queue computes the shown hair; an outdated job in it is cancelled. The background queue computes
//! final pictures, files and the hair to compare with.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use frisure::formats::groom::Format;
use frisure_engine::{Quality, Request, SceneRef};

use crate::locale::Locale;

/// Identifies one request and its responses.
pub type JobId = u64;

/// A queue of jobs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Queue {
    /// The shown hair.
    Hair,
    /// Pictures, files, and hair to compare with.
    Background,
}

/// An effect for the program around the salon to execute.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Executes a request; its responses come back through [`super::Salon::receive`].
    Execute(Queue, JobId, Box<Request>),
    /// Cancels a request; its response is ignored.
    Cancel(Queue, JobId),
    /// Writes a file, or passes it to the browser as a download.
    Save(Save),
    /// Keeps the chosen language for the next start.
    KeepLanguage(Locale),
    /// Stores a text for recovery at the next start; `None` deletes it.
    Autosave(Option<String>),
}

/// A file to write.
#[derive(Clone, Debug, PartialEq)]
pub struct Save {
    /// Its destination.
    pub to: Destination,
    /// Its contents.
    pub bytes: Vec<u8>,
    /// Whether it is the scene itself.
    pub is_scene: bool,
}

/// The destination of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination {
    /// To a path.
    Path(PathBuf),
    /// To the browser's downloads, under a name.
    Download(String),
}

impl Destination {
    fn path(&self) -> &Path {
        match self {
            Self::Path(path) => path.as_path(),
            Self::Download(name) => Path::new(name),
        }
    }

    /// Its extension in lower case.
    #[must_use]
    pub fn extension(&self) -> String {
        let extension = self.path().extension();
        extension.map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
    }

    /// The path or name, for messages.
    #[must_use]
    pub fn display(&self) -> String {
        self.path().display().to_string()
    }
}

/// Groom formats that can be exported: extension and title.
pub const FORMATS: [(&str, &str); Format::ALL.len()] = {
    let mut formats = [("", ""); Format::ALL.len()];
    let mut i = 0;
    while i < formats.len() {
        formats[i] = (Format::ALL[i].extensions()[0], Format::ALL[i].title());
        i += 1;
    }
    formats
};

/// The purpose of a job's response.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Purpose {
    /// Whether a file has a head, hair or both.
    Contents,
    Show(Quality),
    Select,
    Isolate,
    /// The wisps of a section.
    Section(usize),
    Compare(usize),
    /// The hair to begin the exercise of a version with (0), or its goal (1).
    Exercise(u64, usize),
    File(Destination),
}

#[derive(Clone, Debug)]
pub(super) struct Job {
    pub(super) id: JobId,
    pub(super) purpose: Purpose,
    pub(super) scene: SceneRef,
    /// Its response is ignored.
    pub(super) outdated: bool,
}

/// The running jobs, the queued jobs, and the queued effects.
#[derive(Debug, Default)]
pub(super) struct Jobs {
    last_id: JobId,
    pub(super) hair: Option<Job>,
    pub(super) background: Option<Job>,
    waiting: VecDeque<(Purpose, SceneRef, Request)>,
    pub(super) effects: VecDeque<Effect>,
}

impl Jobs {
    fn execute(
        &mut self,
        queue: Queue,
        purpose: Purpose,
        scene: SceneRef,
        request: Request,
    ) -> Job {
        self.last_id += 1;
        let id = self.last_id;
        self.effects.push_back(Effect::Execute(queue, id, Box::new(request)));
        Job { id, purpose, scene, outdated: false }
    }

    /// Starts a job for the shown hair; none is running.
    pub(super) fn start(&mut self, purpose: Purpose, scene: SceneRef, request: Request) {
        self.hair = Some(self.execute(Queue::Hair, purpose, scene, request));
    }

    /// Cancels the job for the shown hair.
    pub(super) fn cancel_hair(&mut self) {
        cancel(self.hair.as_mut(), Queue::Hair, &mut self.effects);
    }

    /// Queues a background job.
    pub(super) fn enqueue(&mut self, purpose: Purpose, scene: SceneRef, request: Request) {
        self.waiting.push_back((purpose, scene, request));
        self.advance();
    }

    /// Starts the next background job, if none is running.
    pub(super) fn advance(&mut self) {
        if self.background.is_none()
            && let Some((purpose, scene, request)) = self.waiting.pop_front()
        {
            self.background = Some(self.execute(Queue::Background, purpose, scene, request));
        }
    }

    /// Cancels the background job and those behind it.
    pub(super) fn cancel_background(&mut self) {
        self.waiting.clear();
        cancel(self.background.as_mut(), Queue::Background, &mut self.effects);
    }

    /// Removes all jobs.
    pub(super) fn clear(&mut self) {
        (self.hair, self.background) = (None, None);
        self.waiting.clear();
        self.effects.retain(|effect| !matches!(effect, Effect::Execute(..) | Effect::Cancel(..)));
    }

    /// The queue in which a job is running.
    pub(super) fn queue_of(&self, id: JobId) -> Option<Queue> {
        let is = |job: &Option<Job>| job.as_ref().is_some_and(|job| job.id == id);
        match (is(&self.hair), is(&self.background)) {
            (true, _) => Some(Queue::Hair),
            (_, true) => Some(Queue::Background),
            _ => None,
        }
    }

    /// Number of queued background jobs.
    pub(super) fn waiting(&self) -> usize {
        self.waiting.len()
    }
}

fn cancel(job: Option<&mut Job>, queue: Queue, effects: &mut VecDeque<Effect>) {
    if let Some(job) = job.filter(|job| !job.outdated) {
        job.outdated = true;
        effects.push_back(Effect::Cancel(queue, job.id));
    }
}
