//! Pictures: traced, with partial pictures while samples accumulate; and turntables.

use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use frisure::formats::picture::{PictureError, png};
use frisure::hairstyle::head::Head;
use frisure::look::{Camera, EnvironmentMap};
use frisure::progress::{Cancelled, Progress, SubStage, Until};
use frisure::render::preview::{self, PreviewError, PreviewOptions};
use frisure::render::trace::{Accumulator, MAX_PIXELS, TraceError, TraceOptions, Tracer};
use frisure::render::{self, MAX_SIZE, PictureSpec};
use frisure::scene::Scene;
use frisure::strands::Strands;
use glam::DVec3;
use web_time::Instant;

use crate::error::Error;
use crate::picture;
use crate::request::Viewpoint;
use crate::response::Response;

/// Time between partial pictures; chosen.
const PARTIAL_EVERY: Duration = Duration::from_secs(1);

/// Most pixels of all frames of a turntable together: a quarter of a gigabyte.
const MOST_TURNTABLE_PIXELS: usize = 1 << 26;

/// Duration of a turn of the animated picture (ms); chosen.
const TURN: usize = 6000;

/// The content of a picture.
pub(crate) struct Subject<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) strands: &'a Strands,
    pub(crate) head: &'a Head,
    pub(crate) environment: Option<&'a EnvironmentMap>,
}

/// Size and sampling of a traced picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampling {
    pub(crate) size: [usize; 2],
    pub(crate) paths: usize,
    pub(crate) noise: f64,
}

impl Sampling {
    /// The options of the tracer, checked.
    pub(crate) fn options(self, scene: &Scene) -> Result<TraceOptions, Error> {
        let options = TraceOptions {
            width: self.size[0],
            height: self.size[1],
            samples: self.paths,
            noise: Some(self.noise as f32).filter(|noise| *noise != 0.0),
            // The cast takes the low bits, which is as good a seed.
            seed: scene.look.hair.seed,
            ..TraceOptions::default()
        };
        options.check().map_err(|e| Error::because(&e, ""))?;
        Ok(options)
    }
}

/// Keeps the last fraction, which is reported with the partial picture.
struct LastFraction<'a> {
    progress: &'a dyn Progress,
    fraction: AtomicU32,
}

impl Progress for LastFraction<'_> {
    fn report(&self, _stage: &str, fraction: f64) {
        self.fraction.store((fraction as f32).to_bits(), Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        self.progress.is_cancelled()
    }
}

impl Subject<'_> {
    fn picture(&self) -> PictureSpec<'_> {
        picture::spec(self.scene, self.environment)
    }

    fn camera(&self, viewpoint: Option<Viewpoint>, [w, h]: [usize; 2]) -> Result<Camera, Error> {
        let aspect = w as f64 / h as f64;
        let Some(Viewpoint { eye, target, field_of_view }) = viewpoint else {
            let surface = Some(self.head.surface());
            return Ok(self.picture().frame(self.strands, surface, aspect));
        };
        let [eye, target] = [eye, target].map(DVec3::from_array);
        let camera = self.scene.camera.at(eye, target, field_of_view, aspect);
        camera.map_err(|e| Error::because(&e, "look from somewhere else"))
    }

    fn drawn(&self, camera: Camera) -> Result<render::Scene<'_>, Error> {
        let drawn =
            self.picture().scene(camera, self.strands, self.strands, Some(self.head.surface()));
        drawn.map_err(|e| Error::because(&e, ""))
    }

    /// The traced picture as a PNG.
    pub(crate) fn trace(
        &self,
        viewpoint: Option<Viewpoint>,
        options: &TraceOptions,
        progress: &dyn Progress,
        partial: &mut dyn FnMut(Response),
    ) -> Result<Vec<u8>, Error> {
        let size = [options.width, options.height];
        let drawn = self.drawn(self.camera(viewpoint, size)?)?;
        progress.report("preparing the light", 0.0);
        let tracer = Tracer::new(&drawn, options).map_err(|e| match e {
            TraceError::Cancelled => Error::Cancelled(Cancelled),
            e => Error::because(&e, ""),
        })?;
        let mut accumulator = tracer.accumulator();
        let mut pause = PARTIAL_EVERY;
        let last = LastFraction { progress, fraction: AtomicU32::new(0) };
        loop {
            let since = Instant::now();
            let stop = || since.elapsed() > pause;
            if tracer.accumulate(&mut accumulator, &Until { progress: &last, stop: &stop }).is_ok()
            {
                break;
            }
            progress.check()?;
            let developing = Instant::now();
            let fraction = f32::from_bits(last.fraction.load(Ordering::Relaxed));
            partial(self.partial_picture(&accumulator, fraction));
            // Large pictures take long to develop: most of the time is for tracing.
            pause = PARTIAL_EVERY.max(10 * developing.elapsed());
        }
        let rgba = picture::developed(&accumulator.image(), &self.scene.output);
        encoded(size, |w, h| png::encode(w, h, &rgba))
    }

    fn partial_picture(&self, accumulator: &Accumulator, fraction: f32) -> Response {
        Response::PartialPicture {
            size: [accumulator.width(), accumulator.height()],
            rgba: picture::developed(&accumulator.image(), &self.scene.output),
            fraction,
            noise: accumulator.noise(),
        }
    }

    /// Previews from all around as an animated PNG.
    pub(crate) fn turntable(
        &self,
        viewpoint: Option<Viewpoint>,
        size: [usize; 2],
        frames: usize,
        progress: &dyn Progress,
    ) -> Result<Vec<u8>, Error> {
        let (scene, surface) = (self.scene, Some(self.head.surface()));
        let views = match viewpoint {
            Some(_) => {
                let first = self.camera(viewpoint, size)?;
                self.picture().turntable_from(first, self.strands, surface, frames)
            }
            None => {
                let aspect = size[0] as f64 / size[1] as f64;
                self.picture().turntable(self.strands, surface, frames, aspect)
            }
        };
        let views = views.map_err(|e| Error::because(&e, ""))?;
        let mut drawn = self.drawn(views[0].0)?;
        let [width, height] = size;
        let samples = scene.output.samples;
        let options = PreviewOptions { width, height, samples, ..Default::default() };
        let mut pictures = Vec::with_capacity(frames);
        for (frame, (camera, lights)) in views.into_iter().enumerate() {
            (drawn.camera, drawn.lights) = (camera, lights);
            let at = |part: f64| (frame as f64 + part) / frames as f64;
            let range = [at(0.0), at(1.0)];
            let stage = SubStage { progress, stage: "turntable", range };
            let image = preview::render(&drawn, &options, &stage).map_err(|e| match e {
                PreviewError::Cancelled => Error::Cancelled(Cancelled),
                e @ PreviewError::Size { .. } => Error::because(&e, ""),
            })?;
            pictures.push(picture::developed(&image, &scene.output));
        }
        let pause = u16::try_from((TURN / frames).clamp(20, 1000)).unwrap_or(100);
        encoded(size, |w, h| png::encode_animated(w, h, &pictures, pause))
    }
}

/// An error if a turntable is impossible.
pub(crate) fn check_turntable([width, height]: [usize; 2], frames: usize) -> Result<(), Error> {
    let sides = 1..=MAX_SIZE;
    if !sides.contains(&width) || !sides.contains(&height) || width * height > MAX_PIXELS {
        let error = PreviewError::Size { width, height };
        return Err(Error::because(&error, "choose a smaller picture"));
    }
    let most = (MOST_TURNTABLE_PIXELS / (width * height)).min(720);
    if (1..=most).contains(&frames) {
        return Ok(());
    }
    let problem = format!(
        "{frames} pictures of {width}×{height} pixels: a turntable of this size has 1 to {most}"
    );
    Err(Error::invalid(problem, "choose fewer pictures, or smaller ones"))
}

fn encoded(
    [width, height]: [usize; 2],
    encode: impl FnOnce(u32, u32) -> Result<Vec<u8>, PictureError>,
) -> Result<Vec<u8>, Error> {
    // Both are at most 16384.
    encode(width as u32, height as u32).map_err(|e| Error::because(&e, ""))
}
