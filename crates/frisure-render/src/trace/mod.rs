//! The final picture: light followed from the eye through hair, head and lamps.
//!
//! An unbiased path tracer on the CPU. Beside the attributes of [`crate::preview::Scene`] it uses `d1`
//! (three numbers per point), the director along the semi-axis a of the section, and `axis_ratio` (a/b,
//! per strand); without them fibres are round. Rays meet round tubes of the mean radius.
//!
//! A [`Tracer`] is a scene ready for rays. It exposes an [`Exposure`], tile by tile, as long as it is let:
//! what there is then can be looked at, put away, and exposed further. In the order of the computation:
//! `lens` sends rays through the picture, `sampler` gives each sample of each pixel its numbers,
//! `integrator` follows the light, scattered by the fibres of `hair` and by the `surface` of skin and
//! `ground`, to the `lights`.

mod check;
mod exposure;
mod fingerprint;
mod ground;
mod hair;
mod integrator;
mod lens;
mod lights;
mod matter;
mod sampler;
mod surface;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use crate::accel::{self, CurveOptions};
use crate::preview::Scene;
use crate::{Background, Camera, Image, Lights};
use exposure::{Pixel, Tile};
use fingerprint::Fingerprint;
use ground::Ground;
use hair::Fibres;
use integrator::{First, Seen, Thing, World};
use lens::Lens;
use lights::Outside;
use sampler::Sampler;

pub use check::{MAX_PIXELS, MAX_SAMPLES, TraceError, TraceOptions};
pub use exposure::{
    Exposure, ExposureError, Layers, MARK as EXPOSURE_MARK, VERSION as EXPOSURE_VERSION,
};

/// Samples after which noise is measured, and may be little enough.
const SURE_SAMPLES: u32 = 32;

/// Most samples that a pixel is given at a time.
const ROUND: u32 = 16;

/// A scene, ready for rays.
pub struct Tracer {
    world: World,
    lens: Lens,
    background: Background,
    options: TraceOptions,
    /// The wisp of each strand.
    wisps: Option<Vec<u32>>,
    /// Of everything but camera and lights, and of all.
    things: Fingerprint,
    fingerprint: u64,
}

impl Tracer {
    /// Checks the options and makes the scene ready for rays.
    ///
    /// # Errors
    /// [`TraceError`], if an option or the scene is impossible.
    pub fn new(scene: &Scene<'_>, options: &TraceOptions) -> Result<Self, TraceError> {
        options.check()?;
        check::strands(scene.strands)?;
        let fibres = Fibres::new(scene.strands, &scene.look.hair).map_err(TraceError::Fibre)?;
        let world = World {
            scene: accel::Scene::new(scene.strands, scene.surface, &CurveOptions::default())?,
            fibres,
            outside: Outside::new(&scene.lights),
            skin: scene.look.skin,
            ground: scene.look.ground.as_ref().map(Ground::new),
            bounces: options.bounces,
        };
        let things = check::fingerprint(scene, options);
        let mut tracer = Self {
            lens: Lens::new(&scene.camera, options, 1.0),
            world,
            background: scene.look.background,
            options: *options,
            wisps: check::wisps(scene.strands),
            things,
            fingerprint: 0,
        };
        tracer.look_from(&scene.camera, &scene.lights)?;
        Ok(tracer)
    }

    /// Moves camera and lights: for the next picture of a turntable.
    ///
    /// # Errors
    /// [`TraceError::Inside`], if the camera is inside the head.
    pub fn look_from(&mut self, camera: &Camera, lights: &Lights) -> Result<(), TraceError> {
        if self.world.scene.is_inside_head(camera.eye().as_vec3()) {
            return Err(TraceError::Inside { eye: camera.eye() });
        }
        self.world.outside = Outside::new(lights);
        let sharp = Lens::new(camera, &self.options, 1.0);
        self.lens = Lens::new(camera, &self.options, sharp.focus(&self.world));
        let mut all = self.things.clone();
        all.put(format!("{camera:?} {lights:?}").as_bytes());
        self.fingerprint = all.value();
        Ok(())
    }

    /// A number that tells one picture from another: of the strands, the look, the camera, the lights,
    /// and of the size, bounces and seed; not of the number of paths.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// An exposure without light.
    #[must_use]
    pub fn exposure(&self) -> Exposure {
        Exposure::new(self.options.width, self.options.height, self.fingerprint)
    }

    /// Whether an exposure is one of this picture, and can go on.
    #[must_use]
    pub fn knows(&self, exposure: &Exposure) -> bool {
        exposure.fingerprint == self.fingerprint
            && (exposure.width, exposure.height) == (self.options.width, self.options.height)
    }

    /// Exposes further, until every tile has all its samples or is as free of noise as asked for, or
    /// `watch` says to stop.
    ///
    /// `watch` is called with the part that is done, 0 to 1, from any of rayon's threads. Whoever goes
    /// on later gets the bytes of an exposure that was never stopped, on any number of threads.
    ///
    /// # Panics
    /// If the exposure is of another size: see [`Self::knows`].
    pub fn expose(
        &self,
        exposure: &mut Exposure,
        watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
    ) -> ControlFlow<()> {
        let TraceOptions { width, height, samples, .. } = self.options;
        assert_eq!((exposure.width, exposure.height), (width, height), "the size of the picture");
        let all = (width * height) as f64 * samples as f64;
        let due = |tile: &Tile| tile.pixels.len() as u64 * u64::from(self.due(tile));
        let left = AtomicU64::new(exposure.tiles.iter().map(due).sum());
        let done = || 1.0 - left.load(Ordering::Relaxed) as f64 / all;
        watch(done())?;
        while let Some(least) = self.unfinished(exposure).map(|tile| tile.samples).min() {
            // All tiles come to the same number before any gets more: the picture is even.
            let goal = next(least);
            let tiles = exposure.tiles.par_iter_mut();
            let short = tiles.filter(|tile| tile.samples < goal && self.due(tile) > 0);
            short.try_for_each(|tile| {
                let before = due(tile);
                self.tile(tile, goal.min(samples as u32));
                left.fetch_sub(before - due(tile), Ordering::Relaxed);
                watch(done())
            })?;
        }
        ControlFlow::Continue(())
    }

    fn unfinished<'a>(&'a self, exposure: &'a Exposure) -> impl Iterator<Item = &'a Tile> {
        exposure.tiles.iter().filter(|tile| self.due(tile) > 0)
    }

    /// Samples that a tile still may get.
    fn due(&self, tile: &Tile) -> u32 {
        let rest = (self.options.samples as u32).saturating_sub(tile.samples);
        match self.options.noise {
            Some(noise)
                if tile.samples >= SURE_SAMPLES
                    && tile.samples.is_multiple_of(ROUND)
                    && tile.noise() <= noise =>
            {
                0
            }
            _ => rest,
        }
    }

    /// Brings a tile to a number of samples.
    fn tile(&self, tile: &mut Tile, goal: u32) {
        for i in 0..tile.pixels.len() {
            let place = (tile.x + i % tile.width, tile.y + i / tile.width);
            for index in tile.samples..goal {
                self.sample(place, index, &mut tile.pixels[i]);
            }
        }
        tile.samples = goal;
    }

    fn sample(&self, (x, y): (usize, usize), index: u32, pixel: &mut Pixel) {
        let number = (y * self.options.width + x) as u32;
        let mut sampler = Sampler::new(self.options.seed, number, index);
        let place = self.lens.place((x, y), sampler.pair());
        let (ray, along) = self.lens.ray(place, &mut sampler);
        let Seen { radiance, first } = self.world.seen(ray, &mut sampler);
        let (behind, covers) = self.background(place, ray.direction());
        let (mut light, mut alpha) = (radiance, 1.0);
        match &first {
            Some(First { thing: Thing::Ground { faded }, .. }) => {
                light = light.lerp(behind, *faded);
                alpha += (covers - alpha) * faded;
            }
            Some(_) => {}
            None => (light, alpha) = (behind, covers),
        }
        pixel.light += light;
        if exposure::in_first_half(index) {
            pixel.half += light;
        }
        pixel.alpha += alpha;
        if let Some(first) = first {
            self.note(&first, along, pixel);
        }
    }

    fn background(&self, place: [f32; 2], towards: Vec3) -> (Vec3, f32) {
        match self.background {
            Background::Surroundings => (self.world.outside.seen(towards), 1.0),
            other => other.at(place[0], place[1]),
        }
    }

    /// Adds what was met first.
    fn note(&self, first: &First, along: f32, pixel: &mut Pixel) {
        pixel.albedo += first.albedo;
        pixel.normal += first.normal;
        pixel.depth += first.t * along;
        pixel.met += 1.0;
        if let Thing::Hair { strand, tangent } = first.thing {
            pixel.tangent += tangent;
            pixel.hair += 1.0;
            let wisp = self.wisps.as_ref().map_or(strand, |wisps| wisps[strand as usize]);
            pixel.vote(wisp.saturating_add(1));
        }
    }
}

/// The number of samples after `now`: doubled, until rounds are long enough to be looked at.
fn next(now: u32) -> u32 {
    if now < ROUND { (2 * now).max(1) } else { (now / ROUND + 1) * ROUND }
}

/// Traces the scene in one go.
///
/// `watch` is called with the part that is done, 0 to 1, from any of rayon's threads; the picture is
/// given up when it answers [`ControlFlow::Break`]. The same input gives the same bytes on any number
/// of threads.
///
/// # Errors
/// [`TraceError`], if an option or the scene is impossible, or `watch` said to stop.
pub fn render(
    scene: &Scene<'_>,
    options: &TraceOptions,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Image, TraceError> {
    let tracer = Tracer::new(scene, options)?;
    let mut exposure = tracer.exposure();
    match tracer.expose(&mut exposure, watch) {
        ControlFlow::Continue(()) => Ok(exposure.image()),
        ControlFlow::Break(()) => Err(TraceError::Cancelled),
    }
}
