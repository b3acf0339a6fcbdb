//! The session: executes requests and caches their intermediate results.

use std::path::Path;
use std::sync::Arc;

use frisure::files::Files;
use frisure::files::frame::FrameChoice;
use frisure::formats::contents;
use frisure::formats::groom::{self, Format};
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{Hairstyle, add_sections, selected};
use frisure::progress::Progress;
use frisure::scene::{Scene, parse_step};
use frisure::strands::Strands;
use web_time::Instant;

use crate::accumulate::{Sampling, Subject, check_turntable};
use crate::adoption::AdoptionReport;
use crate::error::{Error, catch_panic};
use crate::hairstyles::{HairstyleCache, Input};
use crate::heads::{HeadCache, LoadedHead};
use crate::inputs::environment_map;
use crate::preview::{self, StrandCache};
use crate::request::{Quality, Request, SceneRef, Viewpoint};
use crate::response::Response;

/// The name in errors of a step that is not in a scene.
const STEP: &str = "step";

/// Most points of a groom in a browser, where there are 4 GiB of memory in all.
const MOST_POINTS_OF_A_PAGE: usize = 32_000_000;

/// Executes requests, one after the other; each computes only what differs from those before.
///
/// A response at [`Quality::Exact`] depends on the request alone, to the last bit: it is the result of
/// [`frisure::hairstyle::predict`] and of each step after it. A response at [`Quality::Coarse`] is an
/// approximation that continues from the last preview.
#[derive(Debug, Default)]
pub struct Session {
    files: Files,
    heads: HeadCache,
    hairstyles: HairstyleCache,
    strands: StrandCache,
    /// The head in the last preview.
    sent_head: Option<Arc<Head>>,
}

/// A scene with its head and its hairstyle.
struct LoadedScene {
    scene: Scene,
    head: Arc<Head>,
    /// What was guessed of the head.
    note: Option<String>,
    hairstyle: Arc<Hairstyle>,
    adoption: Option<AdoptionReport>,
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
            *self = Self { files: std::mem::take(&mut self.files), ..Self::default() };
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
                self.files.provide(path.as_str(), bytes.as_slice());
                Ok(Response::FileProvided)
            }
            Request::Contents { path } => self.contents(path),
            Request::Preview { scene, quality } => self.preview(scene, *quality, progress),
            Request::Select { scene, step } => self.select(scene, step, progress),
            Request::Guide { scene, wisp, points } => self.guide(scene, *wisp, *points, progress),
            Request::Groom { scene, format } => self.groom(scene, format, progress),
            Request::Picture { scene, viewpoint, size, paths, noise } => {
                let sampling = Sampling { size: *size, paths: *paths, noise: *noise };
                self.picture(scene, *viewpoint, sampling, progress, partial)
            }
            Request::Turntable { scene, viewpoint, size, frames } => {
                self.turntable(scene, *viewpoint, (*size, *frames), progress)
            }
        }
    }

    fn contents(&self, path: &str) -> Result<Response, Error> {
        let found = contents::of(Path::new(path), &self.files);
        Ok(Response::Contents(found.map_err(|e| Error::because(&e, ""))?))
    }

    fn preview(
        &mut self,
        scene: &SceneRef,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<Response, Error> {
        let since = Instant::now();
        let LoadedScene { head, note, hairstyle, adoption, .. } =
            self.load(scene, quality, progress)?;
        let stride = preview::stride(&hairstyle, quality);
        let strands = self.strands.strands(&hairstyle, &head, stride, progress)?;
        let mut preview = preview::preview(quality, &hairstyle, &head, (&strands, stride));
        let sent = self.sent_head.as_ref().is_some_and(|sent| Arc::ptr_eq(sent, &head));
        preview.head = (!sent).then(|| preview::head_data(&head, note.as_ref()));
        preview.adoption = adoption;
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
        let strands = self.all_strands(&loaded, progress)?;
        let hairs = Strands::clone(&*strands);
        let groom =
            crate::groom::groom(&loaded.scene, &loaded.hairstyle, &loaded.head, hairs, false);
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
        sampling: Sampling,
        progress: &dyn Progress,
        partial: &mut dyn FnMut(Response),
    ) -> Result<Response, Error> {
        let loaded = self.load(scene, Quality::Exact, progress)?;
        let options = sampling.options(&loaded.scene)?;
        let environment = environment_map(&loaded.scene, &self.files)?;
        let mut strands = Strands::clone(&*self.all_strands(&loaded, progress)?);
        add_sections(&mut strands, &loaded.hairstyle, &loaded.head);
        let bytes = Subject {
            scene: &loaded.scene,
            strands: &strands,
            head: &loaded.head,
            environment: environment.as_ref(),
        }
        .trace(viewpoint, &options, progress, partial)?;
        Ok(Response::File { name: preview::file_name(&loaded.scene, "png"), bytes })
    }

    fn turntable(
        &mut self,
        scene: &SceneRef,
        viewpoint: Option<Viewpoint>,
        (size, frames): ([usize; 2], usize),
        progress: &dyn Progress,
    ) -> Result<Response, Error> {
        check_turntable(size, frames)?;
        let loaded = self.load(scene, Quality::Exact, progress)?;
        let environment = environment_map(&loaded.scene, &self.files)?;
        let strands = self.all_strands(&loaded, progress)?;
        let bytes = Subject {
            scene: &loaded.scene,
            strands: &strands,
            head: &loaded.head,
            environment: environment.as_ref(),
        }
        .turntable(viewpoint, size, frames, progress)?;
        Ok(Response::File { name: preview::file_name(&loaded.scene, "png"), bytes })
    }

    fn load(
        &mut self,
        scene: &SceneRef,
        quality: Quality,
        progress: &dyn Progress,
    ) -> Result<LoadedScene, Error> {
        let (scene, done) = (parse(scene)?, scene.done);
        let spec = scene.hairstyle_spec()?;
        let LoadedHead { head, note } = self.heads.load(&scene, &self.files)?;
        let input = Input { scene: &scene, spec, head: &head, done, files: &self.files };
        let hairstyle = match quality {
            Quality::Coarse => self.hairstyles.coarse(&input, progress)?,
            Quality::Exact => self.hairstyles.exact(&input, progress)?,
        };
        let adoption = self.hairstyles.adoption(&input);
        Ok(LoadedScene { scene, head, note, hairstyle, adoption })
    }

    /// All hairs, for a file or a picture.
    fn all_strands(
        &mut self,
        loaded: &LoadedScene,
        progress: &dyn Progress,
    ) -> Result<Arc<Strands>, Error> {
        let hairstyle = &loaded.hairstyle;
        let points = hairstyle.drawn().saturating_mul(hairstyle.spec().wisps.points);
        if cfg!(target_arch = "wasm32") && points > MOST_POINTS_OF_A_PAGE {
            let problem = format!("{points} points of hair are more than a page has memory for");
            return Err(Error::invalid(problem, "lower `wisps.density` or `wisps.points`"));
        }
        Ok(self.strands.strands(hairstyle, &loaded.head, 1, progress)?)
    }
}

fn parse(scene: &SceneRef) -> Result<Scene, Error> {
    Ok(Scene::parse(&scene.name, scene.text.as_str(), Path::new(&scene.folder))?)
}
