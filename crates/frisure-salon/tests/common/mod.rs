//! A world for a salon without a window: a stylist who works at once, and files in memory.

use std::collections::BTreeMap;

use frisure_engine::Session;
use frisure_engine::{Request, Response};
use frisure_salon::state::{Command, Errand, Lane, Salon, Save};

/// A salon, and the world outside it.
pub(crate) struct World {
    pub(crate) salon: Salon,
    hair: Session,
    aside: Session,
    /// Files by what a person calls them.
    pub(crate) files: BTreeMap<String, Vec<u8>>,
    /// What survives a crash.
    pub(crate) kept: Option<String>,
    /// Whether writing fails.
    pub(crate) full: bool,
    now: f64,
}

impl World {
    pub(crate) fn new() -> Self {
        Self {
            salon: Salon::new(),
            hair: Session::new(),
            aside: Session::new(),
            files: BTreeMap::new(),
            kept: None,
            full: false,
            now: 0.0,
        }
    }

    /// Does a command and all that comes of it.
    pub(crate) fn run(&mut self, command: Command) {
        self.salon.run(command);
        self.settle();
    }

    /// Carries errands out until there are none; time passes.
    pub(crate) fn settle(&mut self) {
        for _ in 0..100 {
            self.now += 2.0;
            self.salon.tick(self.now);
            let errands = self.salon.errands();
            if errands.is_empty() {
                return;
            }
            for errand in errands {
                self.errand(errand);
            }
        }
        panic!("the salon never rests");
    }

    fn errand(&mut self, errand: Errand) {
        match errand {
            Errand::Work(lane, ticket, order) => {
                let stylist = match lane {
                    Lane::Hair => &mut self.hair,
                    Lane::Aside => &mut self.aside,
                };
                let answer = stylist.execute(&order, &());
                self.salon.receive(ticket, answer);
            }
            // All is done at once here, so that nothing is left to cancel.
            Errand::Cancel(..) => {}
            Errand::Save(save) => self.save(&save),
            Errand::Autosave(text) => self.kept = text,
        }
    }

    fn save(&mut self, save: &Save) {
        let result = match self.full {
            true => Err("no space left".to_owned()),
            false => {
                self.files.insert(save.to.said(), save.bytes.clone());
                Ok(())
            }
        };
        self.salon.saved(save, result);
    }

    /// A head with few hairs, so that tests are quick.
    pub(crate) fn small(&mut self, hair_type: &str) {
        let text = format!(
            "[hair]\ntype = \"{hair_type}\"\n\n[wisps]\ncount = 40\nhairs = 800\npoints = 12\n"
        );
        let name = "small".to_owned();
        self.run(Command::Open { path: None, name, text });
        assert!(self.salon.is_settled(), "{:?} {:?}", self.salon.badge(), self.salon.messages());
    }

    /// Has the stylists keep a file that has no path, as a page does.
    #[allow(dead_code, reason = "not every test drops a file")]
    pub(crate) fn keep(&mut self, name: &str, bytes: &[u8]) {
        let order = Request::ProvideFile { path: name.into(), bytes: bytes.into() };
        for stylist in [&mut self.hair, &mut self.aside] {
            assert_eq!(stylist.execute(&order, &()), Response::FileProvided);
        }
    }

    /// Drops a file on a page.
    #[allow(dead_code, reason = "not every test drops a file")]
    pub(crate) fn drop(&mut self, name: &str, bytes: &[u8]) {
        self.keep(name, bytes);
        self.run(Command::File(name.into()));
    }

    /// The text that is edited.
    pub(crate) fn text(&self) -> &str {
        self.salon.document().expect("a document").text()
    }

    /// Mean height of the tips (m).
    #[allow(dead_code, reason = "not every test asks")]
    pub(crate) fn tips(&self) -> f64 {
        self.salon.shown().expect("hair").0.numbers.tips
    }
}

/// An answer that is none, for tickets nobody gave.
#[allow(dead_code, reason = "not every test sends one")]
pub(crate) const STRAY: Response = Response::Cancelled;
