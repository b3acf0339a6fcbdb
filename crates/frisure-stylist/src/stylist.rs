//! Who does what is asked for, and remembers what has been done.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

use frisure::files::Files;
use frisure::files::frame::FrameChoice;
use frisure::formats::contents;
use frisure::formats::groom::{self, Format};
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{Hairstyle, add_sections, selected};
use frisure::scene::{Scene, parse_step};
use frisure::strands::Strands;
use web_time::Instant;

use crate::exposing::{Quality, Subject, check_turntable};
use crate::hair::{Hair, Wanted};
use crate::heads::Heads;
use crate::held::Held;
use crate::order::{Answer, Asked, Effort, Order, Refusal, Viewpoint};
use crate::refusal::Stop;
use crate::shown::{self, Drawn};
use crate::watch::{Watch, Watched};

/// What a step that is only thought of is called in errors.
const STEP: &str = "step";

/// Most points of a groom where there are 4 GiB of memory in all.
const MOST_POINTS_OF_A_PAGE: usize = 32_000_000;

/// Carries out orders, one after the other, and does no more for each than its difference from those
/// before needs.
///
/// An answer at [`Effort::Exact`] depends on the order alone, to the last bit; that is what
/// [`frisure::hairstyle::predict`] and then each step give. An answer at [`Effort::Coarse`] is for the eye,
/// and goes on from what was looked at last.
#[derive(Debug, Default)]
pub struct Stylist {
    files: Files,
    heads: Heads,
    hair: Hair,
    drawn: Drawn,
    /// The head in the last answer.
    told: Option<Arc<Head>>,
}

/// A scene that was understood.
struct Read {
    scene: Scene,
    head: Arc<Head>,
    /// What had to be guessed of the head.
    note: Option<String>,
    hairstyle: Arc<Hairstyle>,
    /// How well its groom was held.
    held: Option<Held>,
}

impl Stylist {
    /// Knows nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Does what is asked for. What is told on the way and the last answer are those that [`Order`] says;
    /// whatever is wrong is an answer, too. After [`Answer::Cancelled`] and [`Answer::Refused`] everything
    /// that was known is known still.
    pub fn carry_out(&mut self, order: &Order, watch: &dyn Watch) -> Answer {
        let answer = catch_unwind(AssertUnwindSafe(|| self.answer(order, watch)));
        answer.unwrap_or_else(|panic| {
            // What was being changed may be half changed.
            *self = Self { files: std::mem::take(&mut self.files), ..Self::default() };
            Answer::Refused(broken(&*panic))
        })
    }

    fn answer(&mut self, order: &Order, watch: &dyn Watch) -> Answer {
        let answer = match order {
            Order::Keep { path, bytes } => {
                self.files.provide(path.as_str(), bytes.as_slice());
                Ok(Answer::Kept)
            }
            Order::Contents { path } => self.contents(path),
            Order::Show { asked, effort } => self.show(asked, *effort, watch),
            Order::Choose { asked, step } => self.choose(asked, step, watch),
            Order::Hair { asked, wisp, points } => self.one_hair(asked, *wisp, *points, watch),
            Order::Groom { asked, format } => self.groom(asked, format, watch),
            Order::Picture { asked, viewpoint, size, paths, noise } => {
                let quality = Quality { size: *size, paths: *paths, noise: *noise };
                self.picture(asked, *viewpoint, quality, watch)
            }
            Order::Turntable { asked, viewpoint, size, frames } => {
                self.turntable(asked, *viewpoint, (*size, *frames), watch)
            }
        };
        answer.unwrap_or_else(Answer::from)
    }

    fn contents(&self, path: &str) -> Result<Answer, Stop> {
        let found = contents::of(Path::new(path), &self.files);
        Ok(Answer::Contents(found.map_err(|e| Refusal::of(&e, ""))?))
    }

    fn show(&mut self, asked: &Asked, effort: Effort, watch: &dyn Watch) -> Result<Answer, Stop> {
        let since = Instant::now();
        let Read { head, note, hairstyle, held, .. } = self.hair(asked, effort, watch)?;
        let every = shown::every(&hairstyle, effort);
        let strands = self.drawn.strands(&hairstyle, &head, every, &Watched(watch))?;
        let mut shown = shown::shown(effort, &hairstyle, &head, (&strands, every));
        let known = self.told.as_ref().is_some_and(|told| Arc::ptr_eq(told, &head));
        shown.head = (!known).then(|| shown::head_data(&head, note.as_ref()));
        shown.held = held;
        shown.numbers.seconds = since.elapsed().as_secs_f64();
        self.told = Some(head);
        Ok(Answer::Shown(Box::new(shown)))
    }

    fn choose(&mut self, asked: &Asked, step: &str, watch: &dyn Watch) -> Result<Answer, Stop> {
        let operation = parse_step(STEP, step)?;
        let Read { head, hairstyle, .. } = self.hair(asked, Effort::Coarse, watch)?;
        let chosen = match operation.selection() {
            None => vec![true; hairstyle.guides().len()],
            Some(selection) => {
                selected(&hairstyle, &head, selection).map_err(|e| Refusal::of(&e, ""))?
            }
        };
        Ok(Answer::Chosen(chosen))
    }

    fn one_hair(
        &mut self,
        asked: &Asked,
        wisp: usize,
        points: usize,
        watch: &dyn Watch,
    ) -> Result<Answer, Stop> {
        let Read { hairstyle, .. } = self.hair(asked, Effort::Coarse, watch)?;
        Ok(Answer::Hair(Box::new(shown::one_hair(&hairstyle, wisp, points)?)))
    }

    fn groom(&mut self, asked: &Asked, format: &str, watch: &dyn Watch) -> Result<Answer, Stop> {
        let path = format!("hair.{format}");
        let format = Format::of(Path::new(&path)).map_err(|e| Refusal::of(&e, ""))?;
        let read = self.hair(asked, Effort::Exact, watch)?;
        let strands = self.all_strands(&read, watch)?;
        let hairs = Strands::clone(&*strands);
        let groom = crate::groom::groom(&read.scene, &read.hairstyle, &read.head, hairs, false);
        let groom = match format.usual_points() {
            Some(points) => groom.resampled(points).0,
            None => groom,
        };
        let bytes = groom::encode(format, &groom, FrameChoice::default())
            .map_err(|e| Refusal::of(&e, ""))?;
        let extension = path.rsplit('.').next().unwrap_or_default();
        Ok(Answer::File { name: shown::file_name(&read.scene, extension), bytes })
    }

    fn picture(
        &mut self,
        asked: &Asked,
        viewpoint: Option<Viewpoint>,
        quality: Quality,
        watch: &dyn Watch,
    ) -> Result<Answer, Stop> {
        let read = self.hair_of(self.read(asked)?, Effort::Exact, asked.done, watch)?;
        let options = quality.options(&read.scene)?;
        let environment = read.scene.environment_in(&self.files)?;
        let mut strands = Strands::clone(&*self.all_strands(&read, watch)?);
        add_sections(&mut strands, &read.hairstyle, &read.head);
        let bytes = Subject {
            scene: &read.scene,
            strands: &strands,
            head: &read.head,
            environment: environment.as_ref(),
        }
        .trace(viewpoint, &options, watch)?;
        Ok(Answer::File { name: shown::file_name(&read.scene, "png"), bytes })
    }

    fn turntable(
        &mut self,
        asked: &Asked,
        viewpoint: Option<Viewpoint>,
        (size, frames): ([usize; 2], usize),
        watch: &dyn Watch,
    ) -> Result<Answer, Stop> {
        check_turntable(size, frames)?;
        let read = self.hair(asked, Effort::Exact, watch)?;
        let environment = read.scene.environment_in(&self.files)?;
        let strands = self.all_strands(&read, watch)?;
        let bytes = Subject {
            scene: &read.scene,
            strands: &strands,
            head: &read.head,
            environment: environment.as_ref(),
        }
        .turntable(viewpoint, size, frames, watch)?;
        Ok(Answer::File { name: shown::file_name(&read.scene, "png"), bytes })
    }

    fn read(&self, asked: &Asked) -> Result<Scene, Stop> {
        Ok(Scene::parse(&asked.name, asked.text.as_str(), Path::new(&asked.folder))?)
    }

    fn hair(&mut self, asked: &Asked, effort: Effort, watch: &dyn Watch) -> Result<Read, Stop> {
        self.hair_of(self.read(asked)?, effort, asked.done, watch)
    }

    fn hair_of(
        &mut self,
        scene: Scene,
        effort: Effort,
        done: usize,
        watch: &dyn Watch,
    ) -> Result<Read, Stop> {
        let spec = scene.hairstyle_spec()?;
        let (head, note) = self.heads.of(&scene, &self.files)?;
        let monitor = Watched(watch);
        let wanted = Wanted { scene: &scene, spec, head: &head, done, files: &self.files };
        let hairstyle = match effort {
            Effort::Coarse => self.hair.coarse(&wanted, &monitor)?,
            Effort::Exact => self.hair.exact(&wanted, &monitor)?,
        };
        let held = self.hair.held(&wanted);
        Ok(Read { scene, head, note, hairstyle, held })
    }

    /// All hairs, for a file or a picture.
    fn all_strands(&mut self, read: &Read, watch: &dyn Watch) -> Result<Arc<Strands>, Stop> {
        let hairstyle = &read.hairstyle;
        let points = hairstyle.drawn().saturating_mul(hairstyle.spec().wisps.points);
        if cfg!(target_arch = "wasm32") && points > MOST_POINTS_OF_A_PAGE {
            let problem = format!("{points} points of hair are more than a page has memory for");
            return Err(Refusal::because(problem, "lower `wisps.density` or `wisps.points`").into());
        }
        Ok(self.drawn.strands(hairstyle, &read.head, 1, &Watched(watch))?)
    }
}

/// An error of ours, which must not take the window with it.
fn broken(panic: &(dyn Any + Send)) -> Refusal {
    let message = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let message = message.or_else(|| panic.downcast_ref::<String>().cloned());
    let problem = format!("internal error: {}", message.unwrap_or_default());
    Refusal::because(problem, "please report it, with the scene; go on with another change")
}
