//! The tracer: adds samples to an accumulator, tile by tile.

use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, Ordering};

use frisure_digest::Digest;
use frisure_progress::{Cancelled, Progress};
use frisure_strands::{AttributeValues, Domain, Strands};
use glam::Vec3;
use rayon::prelude::*;

use super::accumulator::{self, Accumulator, Pixel, Tile};
use super::fibres::Fibres;
use super::floor::Floor;
use super::integrator::{Integrator, Object, PathSample, PrimaryHit};
use super::lens::Lens;
use super::light_sampler::LightSampler;
use super::options::{TraceError, TraceOptions};
use super::sampler::Sampler;
use super::scene_digest::scene_digest;
use crate::Image;
use crate::accel::{CurveOptions, SceneBvh};
use crate::scene::Scene;
use frisure_look::{Background, Camera, Lights};

/// Samples per pixel after which the noise of a tile is measured; chosen.
const MIN_SAMPLES: u32 = 32;

/// Most samples that a pixel gets in one round over the picture; a power of two, chosen.
const ROUND: u32 = 16;

/// A scene, ready for rays.
pub struct Tracer {
    integrator: Integrator,
    lens: Lens,
    background: Background,
    options: TraceOptions,
    /// The wisp of each strand.
    wisps: Option<Vec<u32>>,
    /// Strands with a smaller index are hair; others are brows and lashes.
    hairs: usize,
    /// Digest of everything but camera and lights.
    scene_digest: Digest,
    /// Digest of everything.
    digest: u64,
}

impl Tracer {
    /// Checks the options and builds the BVH, the fibres and the light sampler.
    ///
    /// # Errors
    /// [`TraceError`], if an option or the scene is impossible.
    pub fn new(scene: &Scene<'_>, options: &TraceOptions) -> Result<Self, TraceError> {
        options.check()?;
        if !scene.strands.iter().any(|strand| strand.points.len() >= 2) {
            return Err(TraceError::NoHair);
        }
        let hair = scene.all_hair();
        let fibres = Fibres::new(&hair, &scene.look.hair).map_err(TraceError::Fibre)?;
        let surfaces = scene.all_surfaces();
        let integrator = Integrator {
            bvh: SceneBvh::new(&hair, surfaces.as_deref(), &CurveOptions::default())?,
            fibres,
            lights: LightSampler::new(&scene.lights),
            skin: scene.look.skin,
            head: surfaces.map(Cow::into_owned),
            floor: scene.look.floor.as_ref().map(Floor::new),
            max_bounces: options.bounces,
            clamp: options.clamp,
        };
        let mut tracer = Self {
            lens: Lens::new(&scene.camera, options, 1.0),
            integrator,
            background: scene.look.background,
            options: *options,
            wisps: wisps(&hair),
            hairs: scene.strands.len(),
            scene_digest: scene_digest(scene, options),
            digest: 0,
        };
        tracer.look_from(&scene.camera, &scene.lights)?;
        Ok(tracer)
    }

    /// Replaces camera and lights: for the next picture of a turntable.
    ///
    /// # Errors
    /// [`TraceError::Inside`], if the camera is inside the head.
    pub fn look_from(&mut self, camera: &Camera, lights: &Lights) -> Result<(), TraceError> {
        if self.integrator.bvh.is_inside_head(camera.eye().as_vec3()) {
            return Err(TraceError::Inside { eye: camera.eye() });
        }
        self.integrator.lights = LightSampler::new(lights);
        let pinhole = Lens::new(camera, &self.options, 1.0);
        let focus = pinhole.focus_distance(&self.integrator);
        self.lens = Lens::new(camera, &self.options, focus);
        let digest = self.scene_digest.clone();
        self.digest = digest.with("camera", camera).with("lights", lights).key();
        Ok(())
    }

    /// The checkpoint digest: a number that identifies strands, look, camera, lights, size, bounces and seed, but
    /// not the number of paths.
    #[must_use]
    pub fn digest(&self) -> u64 {
        self.digest
    }

    /// An accumulator without samples.
    #[must_use]
    pub fn accumulator(&self) -> Accumulator {
        Accumulator::new(self.options.width, self.options.height, self.digest)
    }

    /// Whether an accumulator is of this picture, so that [`Self::accumulate`] can resume it.
    #[must_use]
    pub fn can_resume(&self, accumulator: &Accumulator) -> bool {
        accumulator.digest == self.digest
            && (accumulator.width, accumulator.height) == (self.options.width, self.options.height)
    }

    /// Adds samples until every tile has all of them or is as free of noise as the options ask, or `progress`
    /// cancels.
    ///
    /// Reports the stage `picture`. An accumulator that was stopped and resumed has the same bytes as one that never
    /// was, on any number of threads.
    ///
    /// # Errors
    /// [`Cancelled`], if `progress` cancels; the accumulator can be resumed.
    ///
    /// # Panics
    /// If the accumulator is of another size: see [`Self::can_resume`].
    pub fn accumulate(
        &self,
        accumulator: &mut Accumulator,
        progress: &dyn Progress,
    ) -> Result<(), Cancelled> {
        let TraceOptions { width, height, samples, .. } = self.options;
        let size = (accumulator.width, accumulator.height);
        assert_eq!(size, (width, height), "the size of the picture");
        // Progress counts samples that tiles may still get; a tile below the noise threshold has none left.
        let all = (width * height) as f64 * samples as f64;
        let due = |tile: &Tile| tile.pixels.len() as u64 * u64::from(self.due(tile));
        let left = AtomicU64::new(accumulator.tiles.iter().map(due).sum());
        let done = || 1.0 - left.load(Ordering::Relaxed) as f64 / all;
        let report = || {
            progress.report("picture", done());
            progress.check()
        };
        report()?;
        while let Some(least) = self.unfinished(accumulator).map(|tile| tile.samples).min() {
            // All tiles reach the same number of samples before any gets more.
            let goal = next_goal(least);
            let tiles = accumulator.tiles.par_iter_mut();
            let short = tiles.filter(|tile| tile.samples < goal && self.due(tile) > 0);
            short.try_for_each(|tile| {
                let before = due(tile);
                self.sample_tile(tile, goal.min(samples as u32));
                left.fetch_sub(before - due(tile), Ordering::Relaxed);
                report()
            })?;
        }
        Ok(())
    }

    fn unfinished<'a>(&'a self, accumulator: &'a Accumulator) -> impl Iterator<Item = &'a Tile> {
        accumulator.tiles.iter().filter(|tile| self.due(tile) > 0)
    }

    /// Samples per pixel that a tile may still get.
    fn due(&self, tile: &Tile) -> u32 {
        let rest = (self.options.samples as u32).saturating_sub(tile.samples);
        match self.options.noise {
            Some(noise)
                if tile.samples >= MIN_SAMPLES
                    && tile.samples.is_multiple_of(ROUND)
                    && tile.noise() <= noise =>
            {
                0
            }
            _ => rest,
        }
    }

    /// Samples every pixel of a tile until it has `goal` samples.
    fn sample_tile(&self, tile: &mut Tile, goal: u32) {
        for i in 0..tile.pixels.len() {
            let column_row = (tile.x + i % tile.width, tile.y + i / tile.width);
            for index in tile.samples..goal {
                self.sample_pixel(column_row, index, &mut tile.pixels[i]);
            }
        }
        tile.samples = goal;
    }

    fn sample_pixel(&self, (x, y): (usize, usize), index: u32, pixel: &mut Pixel) {
        // 1. A camera ray. Pixel and index of the sample alone determine its random numbers.
        let number = (y * self.options.width + x) as u32;
        let mut sampler = Sampler::new(self.options.seed, number, index);
        let film_point = self.lens.film_point((x, y), sampler.pair());
        let (ray, cosine) = self.lens.camera_ray(film_point, &mut sampler);
        // 2. The radiance along it.
        let PathSample { radiance, primary_hit } = self.integrator.radiance(ray, &mut sampler);
        // 3. The background where nothing is hit, and where the floor fades into it.
        let (behind, behind_alpha) = self.background(film_point, ray.direction());
        let (mut light, mut alpha) = (radiance, 1.0);
        match &primary_hit {
            Some(PrimaryHit { object: Object::Floor { faded }, .. }) => {
                light = light.lerp(behind, *faded);
                alpha += (behind_alpha - alpha) * faded;
            }
            Some(_) => {}
            None => (light, alpha) = (behind, behind_alpha),
        }
        // 4. The sums of the pixel.
        pixel.light += light;
        if accumulator::in_first_half(index) {
            pixel.half += light;
        }
        pixel.alpha += alpha;
        if let Some(hit) = primary_hit {
            self.add_primary_hit(&hit, cosine, pixel);
        }
    }

    /// Radiance and alpha of the background.
    fn background(&self, film_point: [f32; 2], towards: Vec3) -> (Vec3, f32) {
        match self.background {
            Background::Environment => (self.integrator.lights.background(towards), 1.0),
            other => other.at(film_point[0], film_point[1]),
        }
    }

    fn add_primary_hit(&self, hit: &PrimaryHit, cosine: f32, pixel: &mut Pixel) {
        pixel.albedo += hit.albedo;
        pixel.normal += hit.normal;
        pixel.depth += hit.t * cosine;
        pixel.hits += 1.0;
        if let Object::Hair { strand, tangent } = hit.object
            && (strand as usize) < self.hairs
        {
            pixel.tangent += tangent;
            pixel.hair += 1.0;
            let wisp = self.wisps.as_ref().map_or(strand, |wisps| wisps[strand as usize]);
            pixel.vote(wisp.saturating_add(1));
        }
    }
}

/// The wisp of each strand, if the strands have the attribute `guide`.
fn wisps(strands: &Strands) -> Option<Vec<u32>> {
    let guide = strands.attribute("guide").filter(|a| a.domain == Domain::Strand)?;
    match &guide.values {
        AttributeValues::U32(wisps) => Some(wisps.clone()),
        _ => None,
    }
}

/// The number of samples after `now`: doubled up to [`ROUND`], then its next multiple.
fn next_goal(now: u32) -> u32 {
    if now < ROUND { (2 * now).max(1) } else { (now / ROUND + 1) * ROUND }
}

/// Path-traces the scene in one go; a [`Tracer`] can be stopped and resumed.
///
/// ```
/// use frisure_render::Scene;
/// use frisure_render::trace::{TraceOptions, render};
/// use frisure_strands::Strands;
/// use glam::Vec3;
///
/// let mut strands = Strands::new();
/// strands.push(&[Vec3::ZERO, Vec3::new(0.0, 0.02, -0.1)], &[4e-5; 2]);
/// let options = TraceOptions { width: 16, height: 16, samples: 4, ..TraceOptions::default() };
/// let image = render(&Scene::portrait(&strands, None), &options, &())?;
/// assert!(image.pixels().iter().flatten().all(|x| x.is_finite()));
/// # Ok::<(), frisure_render::trace::TraceError>(())
/// ```
///
/// Reports the stage `picture`. The same input gives the same bytes on any number of threads.
///
/// # Errors
/// [`TraceError`], if an option or the scene is impossible, or `progress` cancels.
pub fn render(
    scene: &Scene<'_>,
    options: &TraceOptions,
    progress: &dyn Progress,
) -> Result<Image, TraceError> {
    let tracer = Tracer::new(scene, options)?;
    let mut accumulator = tracer.accumulator();
    tracer.accumulate(&mut accumulator, progress).map_err(|_| TraceError::Cancelled)?;
    Ok(accumulator.image())
}
