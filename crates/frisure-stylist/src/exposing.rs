//! Pictures: traced, told while they grow; and turntables.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use frisure::formats::picture::{PictureError, png};
use frisure::hairstyle::head::Head;
use frisure::look::{Camera, EnvironmentMap};
use frisure::render::preview::{self, PreviewError, PreviewOptions};
use frisure::render::trace::{Accumulator, MAX_PIXELS, TraceError, TraceOptions, Tracer};
use frisure::render::{self, MAX_SIZE, PictureSpec};
use frisure::scene::Scene;
use frisure::strands::Strands;
use glam::DVec3;
use web_time::Instant;

use crate::order::{Answer, Refusal, Viewpoint};
use crate::picture;
use crate::refusal::Stop;
use crate::watch::{Watch, going, progress};

/// How often a picture is told of while it grows.
const TOLD_EVERY: Duration = Duration::from_secs(1);

/// Most pixels of all frames of a turntable together: a quarter of a gigabyte.
const MOST_FRAME_PIXELS: usize = 1 << 26;

/// How long a turn takes to look at (ms).
const TURN: usize = 6000;

/// What a picture is of.
pub(crate) struct Subject<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) strands: &'a Strands,
    pub(crate) head: &'a Head,
    pub(crate) environment: Option<&'a EnvironmentMap>,
}

/// How good a traced picture is to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quality {
    pub(crate) size: [usize; 2],
    pub(crate) paths: usize,
    pub(crate) noise: f64,
}

impl Quality {
    /// The tracer's options; known to be possible before the work.
    pub(crate) fn options(self, scene: &Scene) -> Result<TraceOptions, Refusal> {
        let options = TraceOptions {
            width: self.size[0],
            height: self.size[1],
            samples: self.paths,
            noise: Some(self.noise as f32).filter(|noise| *noise != 0.0),
            // The cast takes the low bits, which is as good a seed.
            seed: scene.look.hair.seed,
            ..TraceOptions::default()
        };
        options.check().map_err(|e| Refusal::of(&e, ""))?;
        Ok(options)
    }
}

impl Subject<'_> {
    fn picture(&self) -> PictureSpec<'_> {
        picture::spec(self.scene, self.environment)
    }

    fn camera(&self, viewpoint: Option<Viewpoint>, [w, h]: [usize; 2]) -> Result<Camera, Refusal> {
        let aspect = w as f64 / h as f64;
        let Some(Viewpoint { eye, target, field_of_view }) = viewpoint else {
            let surface = Some(self.head.surface());
            return Ok(self.picture().frame(self.strands, surface, aspect));
        };
        let [eye, target] = [eye, target].map(DVec3::from_array);
        let camera = self.scene.camera.at(eye, target, field_of_view, aspect);
        camera.map_err(|e| Refusal::of(&e, "look from somewhere else"))
    }

    fn drawn(&self, camera: Camera) -> Result<render::Scene<'_>, Refusal> {
        let drawn =
            self.picture().scene(camera, self.strands, self.strands, Some(self.head.surface()));
        drawn.map_err(|e| Refusal::of(&e, ""))
    }

    /// The traced picture as a PNG.
    pub(crate) fn trace(
        &self,
        viewpoint: Option<Viewpoint>,
        options: &TraceOptions,
        watch: &dyn Watch,
    ) -> Result<Vec<u8>, Stop> {
        let size = [options.width, options.height];
        let drawn = self.drawn(self.camera(viewpoint, size)?)?;
        progress(watch, "preparing the light", 0.0);
        let tracer = Tracer::new(&drawn, options).map_err(|e| match e {
            TraceError::Cancelled => Stop::Cancelled,
            e => Refusal::of(&e, "").into(),
        })?;
        let mut accumulator = tracer.accumulator();
        let mut pause = TOLD_EVERY;
        let done = AtomicU32::new(0);
        loop {
            let since = Instant::now();
            let look = |part: f64| {
                done.store((part as f32).to_bits(), Ordering::Relaxed);
                match since.elapsed() > pause {
                    true => ControlFlow::Break(()),
                    false => going(watch),
                }
            };
            if tracer.accumulate(&mut accumulator, &look).is_continue() {
                break;
            }
            if watch.cancelled() {
                return Err(Stop::Cancelled);
            }
            let telling = Instant::now();
            watch.tell(self.exposed(&accumulator, f32::from_bits(done.load(Ordering::Relaxed))));
            // Large pictures take long to develop: most of the time is for light.
            pause = TOLD_EVERY.max(10 * telling.elapsed());
        }
        let rgba = picture::developed(&accumulator.image(), &self.scene.output);
        Ok(encoded(size, |w, h| png::encode(w, h, &rgba))?)
    }

    fn exposed(&self, accumulator: &Accumulator, fraction: f32) -> Answer {
        Answer::Exposed {
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
        watch: &dyn Watch,
    ) -> Result<Vec<u8>, Stop> {
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
        let views = views.map_err(|e| Refusal::of(&e, ""))?;
        let mut drawn = self.drawn(views[0].0)?;
        let [width, height] = size;
        let samples = scene.output.samples;
        let options = PreviewOptions { width, height, samples, ..Default::default() };
        let mut pictures = Vec::with_capacity(frames);
        for (frame, (camera, lights)) in views.into_iter().enumerate() {
            (drawn.camera, drawn.lights) = (camera, lights);
            let at = |part: f64| (frame as f64 + part) / frames as f64;
            let look = |part: f64| {
                progress(watch, "turntable", at(part));
                going(watch)
            };
            let image = preview::render(&drawn, &options, &look).map_err(|e| match e {
                PreviewError::Cancelled => Stop::Cancelled,
                e @ PreviewError::Size { .. } => Refusal::of(&e, "").into(),
            })?;
            pictures.push(picture::developed(&image, &scene.output));
        }
        let pause = u16::try_from((TURN / frames).clamp(20, 1000)).unwrap_or(100);
        Ok(encoded(size, |w, h| png::encode_animated(w, h, &pictures, pause))?)
    }
}

/// Whether a turntable is possible: to be known before the work.
pub(crate) fn check_turntable([width, height]: [usize; 2], frames: usize) -> Result<(), Refusal> {
    let sides = 1..=MAX_SIZE;
    if !sides.contains(&width) || !sides.contains(&height) || width * height > MAX_PIXELS {
        let error = PreviewError::Size { width, height };
        return Err(Refusal::of(&error, "choose a smaller picture"));
    }
    let most = (MOST_FRAME_PIXELS / (width * height)).min(720);
    if (1..=most).contains(&frames) {
        return Ok(());
    }
    let problem = format!(
        "{frames} pictures of {width}×{height} pixels: a turntable of this size has 1 to {most}"
    );
    Err(Refusal::because(problem, "choose fewer pictures, or smaller ones"))
}

fn encoded(
    [width, height]: [usize; 2],
    encode: impl FnOnce(u32, u32) -> Result<Vec<u8>, PictureError>,
) -> Result<Vec<u8>, Refusal> {
    // Both are at most 16384.
    encode(width as u32, height as u32).map_err(|e| Refusal::of(&e, ""))
}
