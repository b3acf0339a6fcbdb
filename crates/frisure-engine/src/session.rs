//! The session: executes requests and returns responses.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use frisure::files::frame::FrameChoice;
use frisure::formats::contents;
use frisure::formats::groom::{self, Fit, Format};
use frisure::formats::picture::png;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{add_sections, selected};
use frisure::progress::{Progress, Silent};
use frisure::render::trace::{TraceOptions, Tracer};
use frisure::scene::{Output, Scene, parse_step};
use frisure::strands::Strands;
use web_time::Instant;

use crate::error::{Error, catch_panic};
use crate::inputs::environment_map;
use crate::memory::{self, Work};
use crate::picture::{self, Pauses, Viewpoint, accumulate};
use crate::preview;
use crate::quality::Quality;
use crate::request::{Request, SceneRef};
use crate::response::Response;
use crate::runner::{LoadedScene, Runner};

/// The name in errors of a step that is not in a scene.
const STEP: &str = "step";

/// When partial pictures are sent: every second, and for at most a tenth of the time; chosen.
const PAUSES: Pauses = Pauses { every: Duration::from_secs(1), spacing: 10 };

/// Executes requests with a [`Runner`], one after the other; each computes only what differs from those before.
#[derive(Debug, Default)]
pub struct Session {
    runner: Runner,
    /// The head in the last preview.
    sent_head: Option<Arc<Head>>,
}

/// The execution of one request.
struct Execution<'a> {
    session: &'a mut Session,
    progress: &'a dyn Progress,
    /// Receives partial pictures.
    partial: &'a mut dyn FnMut(Response),
}

impl Session {
    /// A session with empty caches.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Executes a request; whatever is wrong is a response, too.
    ///
    /// After [`Response::Cancelled`] and [`Response::Failed`] the caches are still valid.
    pub fn execute(&mut self, request: &Request, progress: &dyn Progress) -> Response {
        self.execute_with(request, progress, &mut |_| {})
    }

    /// The same; `partial` receives each [`Response::PartialPicture`] on the way.
    pub fn execute_with(
        &mut self,
        request: &Request,
        progress: &dyn Progress,
        partial: &mut dyn FnMut(Response),
    ) -> Response {
        let mut execution = Execution { session: &mut *self, progress, partial };
        let response = catch_panic(|| execution.response(request));
        if let Err(Error::Internal(_)) = &response {
            // The caches may be half changed.
            self.runner.clear();
            self.sent_head = None;
        }
        response.unwrap_or_else(Response::from)
    }
}

impl Execution<'_> {
    fn response(&mut self, request: &Request) -> Result<Response, Error> {
        match request {
            Request::ProvideFile { path, bytes } => {
                self.session.runner.files.provide(path.as_str(), bytes.as_slice());
                Ok(Response::FileProvided)
            }
            Request::Contents { path } => self.contents(path),
            Request::Preview { scene, quality } => self.preview(scene, *quality),
            Request::Select { scene, step } => self.select(scene, step),
            Request::Guide { scene, wisp, points } => {
                let LoadedScene { hairstyle, .. } = self.load(scene, Quality::Coarse)?;
                Ok(Response::Guide(Box::new(preview::guide(&hairstyle, *wisp, *points)?)))
            }
            Request::Groom { scene, format } => self.groom(scene, format),
            Request::Picture { scene, viewpoint, size: [width, height], paths, noise } => {
                let options = TraceOptions {
                    width: *width,
                    height: *height,
                    samples: *paths,
                    noise: Some(*noise as f32).filter(|noise| *noise != 0.0),
                    ..TraceOptions::default()
                };
                self.picture(scene, *viewpoint, options)
            }
            Request::Turntable { scene, viewpoint, size, frames } => {
                self.turntable(scene, *viewpoint, *size, *frames)
            }
            Request::Film { scenes, viewpoint, size } => self.film(scenes, *viewpoint, *size),
        }
    }

    fn load(&mut self, scene: &SceneRef, quality: Quality) -> Result<LoadedScene, Error> {
        let SceneRef { name, text, folder, done } = scene;
        let scene = Arc::new(Scene::parse(name, text.as_str(), Path::new(folder))?);
        self.session.runner.load(&scene, *done, quality, self.progress)
    }

    fn strands(&mut self, loaded: &LoadedScene, stride: usize) -> Result<Arc<Strands>, Error> {
        self.session.runner.strands(loaded, stride, self.progress)
    }

    fn contents(&self, path: &str) -> Result<Response, Error> {
        let found = contents::of(Path::new(path), &self.session.runner.files);
        Ok(Response::Contents(found.map_err(|e| Error::because(&e, ""))?))
    }

    fn preview(&mut self, scene: &SceneRef, quality: Quality) -> Result<Response, Error> {
        let since = Instant::now();
        let loaded = self.load(scene, quality)?;
        let stride = quality.stride(&loaded.hairstyle);
        let strands = self.strands(&loaded, stride)?;
        let mut preview = preview::preview(quality, &loaded, &strands, stride);
        let LoadedScene { head, note, .. } = loaded;
        let sent = self.session.sent_head.as_ref().is_some_and(|sent| Arc::ptr_eq(sent, &head));
        preview.head = (!sent).then(|| preview::head_data(&head, note));
        preview.numbers.seconds = since.elapsed().as_secs_f64();
        self.session.sent_head = Some(head);
        Ok(Response::Preview(Box::new(preview)))
    }

    fn select(&mut self, scene: &SceneRef, step: &str) -> Result<Response, Error> {
        let operation = parse_step(STEP, step)?;
        let LoadedScene { head, hairstyle, .. } = self.load(scene, Quality::Coarse)?;
        let wisps = match operation.selection() {
            None => vec![true; hairstyle.guides().len()],
            Some(selection) => {
                selected(&hairstyle, &head, selection).map_err(|e| Error::because(&e, ""))?
            }
        };
        Ok(Response::Selected(wisps))
    }

    fn groom(&mut self, scene: &SceneRef, extension: &str) -> Result<Response, Error> {
        let format = Format::of(Path::new(&format!("hair.{extension}")));
        let format = format.map_err(|e| Error::because(&e, ""))?;
        let loaded = self.load(scene, Quality::Exact)?;
        let strands = self.strands(&loaded, 1)?;
        let groom = loaded.groom(Strands::clone(&strands), false);
        let fit = Fit::default().or_usual(format, None, &groom);
        let groom = match fit.is_nothing() {
            true => groom,
            false => groom.fitted(fit).map_err(|e| Error::because(&e, ""))?.groom,
        };
        let bytes = groom::encode(format, &groom, FrameChoice::default())
            .map_err(|e| Error::because(&e, ""))?;
        let extension = extension.rsplit('.').next().unwrap_or_default();
        Ok(Response::File { name: preview::file_name(&loaded.scene, extension), bytes })
    }

    fn picture(
        &mut self,
        scene: &SceneRef,
        viewpoint: Option<Viewpoint>,
        options: TraceOptions,
    ) -> Result<Response, Error> {
        let loaded = self.load(scene, Quality::Exact)?;
        let LoadedScene { scene, head, hairstyle, .. } = &loaded;
        // The cast takes the low bits, which is as good a seed.
        let options = TraceOptions { seed: scene.look.hair.seed, ..options };
        options.check().map_err(|e| Error::because(&e, ""))?;
        memory::check_picture(Work::Traced(options.width * options.height))?;
        let environment = environment_map(scene, &self.session.runner.files)?;
        let mut strands = Strands::clone(&*self.strands(&loaded, 1)?);
        add_sections(&mut strands, hairstyle, head);
        self.progress.report("preparing the light", 0.0);
        let subject = loaded.subject(&strands, environment.as_ref());
        let rgba = self.trace(&subject.tracer(viewpoint, &options)?, &scene.output)?;
        // Both sides are at most 16384.
        let bytes = png::encode(options.width as u32, options.height as u32, &rgba);
        let bytes = bytes.map_err(|e| Error::because(&e, ""))?;
        Ok(Response::File { name: preview::file_name(scene, "png"), bytes })
    }

    /// The developed picture of a tracer.
    fn trace(&mut self, tracer: &Tracer, output: &Output) -> Result<Vec<u8>, Error> {
        let Self { progress, partial, .. } = self;
        let mut accumulator = tracer.accumulator();
        accumulate(
            tracer,
            &mut accumulator,
            PAUSES,
            &Silent(*progress),
            &mut |so_far, fraction| {
                progress.check()?;
                partial(Response::PartialPicture {
                    size: [so_far.width(), so_far.height()],
                    rgba: picture::developed(&so_far.image(), output),
                    fraction,
                    noise: so_far.noise(),
                });
                Ok(())
            },
        )?;
        Ok(picture::developed(&accumulator.image(), output))
    }

    fn turntable(
        &mut self,
        scene: &SceneRef,
        viewpoint: Option<Viewpoint>,
        size: [usize; 2],
        frames: usize,
    ) -> Result<Response, Error> {
        picture::check_turntable(size, frames)?;
        let loaded = self.load(scene, Quality::Exact)?;
        let environment = environment_map(&loaded.scene, &self.session.runner.files)?;
        let strands = self.strands(&loaded, 1)?;
        let subject = loaded.subject(&strands, environment.as_ref());
        let bytes = picture::turntable(&subject, viewpoint, size, frames, self.progress)?;
        Ok(Response::File { name: preview::file_name(&loaded.scene, "png"), bytes })
    }

    fn film(
        &mut self,
        scenes: &[SceneRef],
        viewpoint: Option<Viewpoint>,
        size: [usize; 2],
    ) -> Result<Response, Error> {
        picture::check_turntable(size, scenes.len())?;
        let (mut pictures, mut name) = (Vec::with_capacity(scenes.len()), String::new());
        for (index, scene) in scenes.iter().enumerate() {
            let silent = Silent(self.progress);
            self.progress.report("film", index as f64 / scenes.len() as f64);
            self.progress.check()?;
            let loaded = self.load(scene, Quality::Exact)?;
            let environment = environment_map(&loaded.scene, &self.session.runner.files)?;
            let strands = self.strands(&loaded, 1)?;
            let subject = loaded.subject(&strands, environment.as_ref());
            pictures.extend(picture::previews(&subject, viewpoint, size, 1, &silent)?);
            name = preview::file_name(&loaded.scene, "png");
        }
        Ok(Response::File { name, bytes: picture::film(size, pictures)? })
    }
}
