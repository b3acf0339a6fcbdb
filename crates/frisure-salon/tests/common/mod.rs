//! A salon without a window, with sessions that execute requests at once, and files in memory.

use std::collections::BTreeMap;

use frisure_engine::Session;
use frisure_engine::{Request, Response};
use frisure_salon::locale::Locale;
use frisure_salon::state::{Command, Effect, Salon, Save};

/// A salon, and everything around it.
pub(crate) struct World {
    pub(crate) salon: Salon,
    sessions: [Session; 2],
    /// Written files by path or name.
    pub(crate) files: BTreeMap<String, Vec<u8>>,
    /// The autosaved text.
    pub(crate) autosaved: Option<String>,
    /// Whether writing fails.
    pub(crate) full: bool,
    /// The language that was kept for the next start.
    pub(crate) language: Option<Locale>,
    now: f64,
}

impl World {
    pub(crate) fn new() -> Self {
        Self {
            salon: Salon::new(),
            sessions: [Session::new(), Session::new()],
            files: BTreeMap::new(),
            autosaved: None,
            full: false,
            language: None,
            now: 0.0,
        }
    }

    /// Runs a command and all jobs that follow from it.
    pub(crate) fn run(&mut self, command: Command) {
        self.salon.run(command);
        self.settle();
    }

    /// Carries out effects until there are none; time passes.
    pub(crate) fn settle(&mut self) {
        for _ in 0..100 {
            self.now += 2.0;
            self.salon.tick(self.now);
            let effects = self.salon.effects();
            if effects.is_empty() {
                return;
            }
            for effect in effects {
                self.effect(effect);
            }
        }
        panic!("the salon never comes to rest");
    }

    fn effect(&mut self, effect: Effect) {
        match effect {
            Effect::Execute(queue, job, request) => {
                let response = self.sessions[queue as usize].execute(&request, &());
                self.salon.receive(job, response);
            }
            // Every request is complete before the next one.
            Effect::Cancel(..) => {}
            Effect::Save(save) => self.save(&save),
            Effect::Autosave(text) => self.autosaved = text,
            Effect::KeepLanguage(locale) => self.language = Some(locale),
        }
    }

    fn save(&mut self, save: &Save) {
        let result = match self.full {
            true => Err("no space left".to_owned()),
            false => {
                self.files.insert(save.to.display(), save.bytes.clone());
                Ok(())
            }
        };
        self.salon.saved(save, result);
    }

    /// A head with few hairs, so that tests are quick.
    pub(crate) fn small(&mut self, hair_type: &str) {
        self.of(hair_type, 40);
    }

    /// A head with so many wisps of a type.
    pub(crate) fn of(&mut self, hair_type: &str, wisps: usize) {
        let hairs = 6 * wisps;
        let text = format!(
            "[hair]\ntype = \"{hair_type}\"\n\n[wisps]\ncount = {wisps}\nhairs = {hairs}\npoints = 12\n"
        );
        let name = "small".to_owned();
        self.run(Command::Open { path: None, name, text });
        assert!(self.salon.is_settled(), "{:?} {:?}", self.salon.badge(), self.salon.messages);
    }

    /// Uploads a file without a path to the sessions, as a page does.
    #[allow(dead_code, reason = "not every test drops a file")]
    pub(crate) fn upload(&mut self, name: &str, bytes: &[u8]) {
        let request = Request::ProvideFile { path: name.into(), bytes: bytes.into() };
        for session in &mut self.sessions {
            assert_eq!(session.execute(&request, &()), Response::FileProvided);
        }
    }

    /// Drops a file on a page.
    #[allow(dead_code, reason = "not every test drops a file")]
    pub(crate) fn drop(&mut self, name: &str, bytes: &[u8]) {
        self.upload(name, bytes);
        self.run(Command::File(name.into()));
    }

    /// The text that is edited.
    pub(crate) fn text(&self) -> &str {
        self.salon.document.as_ref().expect("a document").text()
    }

    /// Mean height of the tips (m).
    #[allow(dead_code, reason = "not every test asks")]
    pub(crate) fn tips(&self) -> f64 {
        self.salon.preview().expect("hair").0.numbers.tips
    }
}

/// A response for a job that does not exist.
#[allow(dead_code, reason = "not every test sends one")]
pub(crate) const STRAY: Response = Response::Cancelled;
