//! The session: executes requests and returns responses.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use frisure::files::frame::FrameChoice;
use frisure::formats::contents;
use frisure::formats::groom::{self, Format};
use frisure::formats::picture::png;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{add_sections, selected};
use frisure::progress::{Progress, Silent};
use frisure::render::trace::{Accumulator, TraceOptions};
use frisure::scene::{Output, Scene, parse_step};
use frisure::strands::Strands;
use web_time::Instant;

use crate::error::{Error, catch_panic};
use crate::inputs::environment_map;
use crate::picture::{self, Pauses, Subject, Viewpoint, accumulate};
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
        let response = catch_panic(|| self.response(request, progress, partial));
        if let Err(Error::Internal(_)) = &response {
            // The caches may be half changed.
            self.runner.clear();
            self.sent_head = None;
        }
        response.unwrap_or_else(Response::from)
    }

    fn response(
        &mut self,
        request: &Request,
        progress: &dyn Progress,
        partial: &mut dyn FnMut(Response),
    ) -> Result<Response, Error> {
        match request {
            Request::ProvideFile { path, bytes } => {
                self.runner.provide_file(path, bytes);
                Ok(Response::FileProvided)
            }
            Request::Contents { path } => self.contents(path),
            Request::Preview { scene, quality } => self.preview(scene, *quality, progress),
            Request::Select { scene, step } => self.select(scene, step, progress),
            Request::Guide { scene, wisp, points } => self.guide(scene, *wisp, *points, progress),
            Request::Groom { scene, format } => self.groom(scene, format, progress),
            Request::Picture { scene, viewpoint, size, paths, noise } => {
                let [width, height] = *size;
                let noise = Some(*noise as f32).filter(|noise| *noise != 0.0);
                let options = TraceOptions {
                    width,
                    height,
                    samples: *paths,
                    noise,
                    ..TraceOptions::default()
                };
                self.picture(scene, *viewpoint, options, progress, partial)
            }
            Request::Turntable { scene, viewpoint, size, frames } => {
                self.turntable(scene, *viewpoint, (*size, *frames), progress)
            }
        }
    }

    fn contents(&self, path: &str) -> Result<Response, Error> {
        let found = contents::of(Path::new(path), self.runner.files());
        Ok(Response::Contents(found.map_err(|e| Error::because(&e, ""))?))
    }

    fn preview(
        &mut self,
        scene: &SceneRef,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<Response, Error> {
        let since = Instant::now();
        let loaded = self.load(scene, quality, progress)?;
        let stride = quality.stride(&loaded.hairstyle);
        let strands = self.runner.strands(&loaded, stride, progress)?;
        let mut preview = preview::preview(quality, &loaded, &strands, stride);
        let LoadedScene { head, note, .. } = loaded;
        let sent = self.sent_head.as_ref().is_some_and(|sent| Arc::ptr_eq(sent, &head));
        preview.head = (!sent).then(|| preview::head_data(&head, note.as_ref()));
        preview.numbers.seconds = since.elapsed().as_secs_f64();
        self.sent_head = Some(head);
        Ok(Response::Preview(Box::new(preview)))
    }

    fn select(
        &mut self,
        scene: &SceneRef,
        step: &str,
        progress: &dyn Progress,
    ) -> Result<Response, Error> {
        let operation = parse_step(STEP, step)?;
        let LoadedScene { head, hairstyle, .. } = self.load(scene, Quality::Coarse, progress)?;
        let wisps = match operation.selection() {
            None => vec![true; hairstyle.guides().len()],
            Some(selection) => {
                selected(&hairstyle, &head, selection).map_err(|e| Error::because(&e, ""))?
            }
        };
        Ok(Response::Selected(wisps))
    }

    fn guide(
        &mut self,
        scene: &SceneRef,
        wisp: usize,
        points: usize,
        progress: &dyn Progress,
    ) -> Result<Response, Error> {
        let LoadedScene { hairstyle, .. } = self.load(scene, Quality::Coarse, progress)?;
        Ok(Response::Guide(Box::new(preview::guide(&hairstyle, wisp, points)?)))
    }

    fn groom(
        &mut self,
        scene: &SceneRef,
        format: &str,
        progress: &dyn Progress,
    ) -> Result<Response, Error> {
        let path = format!("hair.{format}");
        let format = Format::of(Path::new(&path)).map_err(|e| Error::because(&e, ""))?;
        let loaded = self.load(scene, Quality::Exact, progress)?;
        let strands = self.runner.strands(&loaded, 1, progress)?;
        let groom = loaded.groom(Strands::clone(&strands), false);
        let groom = match format.usual_points() {
            Some(points) => groom.resampled(points).0,
            None => groom,
        };
        let bytes = groom::encode(format, &groom, FrameChoice::default())
            .map_err(|e| Error::because(&e, ""))?;
        let extension = path.rsplit('.').next().unwrap_or_default();
        Ok(Response::File { name: preview::file_name(&loaded.scene, extension), bytes })
    }

    fn picture(
        &mut self,
        scene: &SceneRef,
        viewpoint: Option<Viewpoint>,
        options: TraceOptions,
        progress: &dyn Progress,
        partial: &mut dyn FnMut(Response),
    ) -> Result<Response, Error> {
        let loaded = self.load(scene, Quality::Exact, progress)?;
        let LoadedScene { scene, head, hairstyle, .. } = &loaded;
        // The cast takes the low bits, which is as good a seed.
        let options = TraceOptions { seed: scene.look.hair.seed, ..options };
        options.check().map_err(|e| Error::because(&e, ""))?;
        let environment = environment_map(scene, self.runner.files())?;
        let mut strands = Strands::clone(&*self.runner.strands(&loaded, 1, progress)?);
        add_sections(&mut strands, hairstyle, head);
        let subject = Subject {
            scene,
            strands: &strands,
            framed: &strands,
            surface: Some(head.surface()),
            environment: environment.as_ref(),
        };
        progress.report("preparing the light", 0.0);
        let tracer = subject.tracer(viewpoint, &options)?;
        let mut accumulator = tracer.accumulator();
        accumulate(
            &tracer,
            &mut accumulator,
            PAUSES,
            &Silent(progress),
            &mut |so_far, fraction| {
                progress.check()?;
                partial(partial_picture(so_far, fraction, &scene.output));
                Ok(())
            },
        )?;
        let rgba = picture::developed(&accumulator.image(), &scene.output);
        // Both sides are at most 16384.
        let bytes = png::encode(options.width as u32, options.height as u32, &rgba);
        let bytes = bytes.map_err(|e| Error::because(&e, ""))?;
        Ok(Response::File { name: preview::file_name(scene, "png"), bytes })
    }

    fn turntable(
        &mut self,
        scene: &SceneRef,
        viewpoint: Option<Viewpoint>,
        (size, frames): ([usize; 2], usize),
        progress: &dyn Progress,
    ) -> Result<Response, Error> {
        picture::check_turntable(size, frames)?;
        let loaded = self.load(scene, Quality::Exact, progress)?;
        let environment = environment_map(&loaded.scene, self.runner.files())?;
        let strands = self.runner.strands(&loaded, 1, progress)?;
        let subject = Subject {
            scene: &loaded.scene,
            strands: &strands,
            framed: &strands,
            surface: Some(loaded.head.surface()),
            environment: environment.as_ref(),
        };
        let bytes = picture::turntable(&subject, viewpoint, size, frames, progress)?;
        Ok(Response::File { name: preview::file_name(&loaded.scene, "png"), bytes })
    }

    fn load(
        &mut self,
        scene: &SceneRef,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<LoadedScene, Error> {
        let SceneRef { name, text, folder, done } = scene;
        let scene = Scene::parse(name, text.as_str(), Path::new(folder))?;
        self.runner.load(&Arc::new(scene), *done, quality, progress)
    }
}

fn partial_picture(accumulator: &Accumulator, fraction: f32, output: &Output) -> Response {
    Response::PartialPicture {
        size: [accumulator.width(), accumulator.height()],
        rgba: picture::developed(&accumulator.image(), output),
        fraction,
        noise: accumulator.noise(),
    }
}
