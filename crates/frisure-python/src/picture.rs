//! Pictures of hairstyles.

use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;

use frisure::files::Files;
use frisure::formats::picture::png;
use frisure::hairstyle::add_sections;
use frisure::progress::Progress;
use frisure::render::Image;
use frisure::render::preview::PreviewOptions;
use frisure::render::trace::TraceOptions;
use frisure::scene::Output;
use frisure_engine::memory::{self, Work};
use frisure_engine::picture::{developed, write};
use frisure_engine::{Error, LoadedScene, environment_map};
use pyo3::prelude::*;

use crate::array::Memory;
use crate::hairstyle::{Hair, Prediction};
use crate::work;

/// The picture that is asked for.
struct Picture {
    /// Pixels across and down; those of the scene where they are not given.
    size: (Option<usize>, Option<usize>),
    /// Direction of the camera around the head (rad), if it is not the scene's.
    azimuth: Option<f64>,
    /// How a final picture is traced; none for a preview.
    tracing: Option<Tracing>,
}

/// Quality of a final picture, as the options of `frisure render`.
struct Tracing {
    paths: usize,
    noise: f32,
    bounces: u32,
    clamp: Option<f32>,
}

/// A picture of the light, and how it is shown.
struct Rendered {
    image: Image,
    output: Output,
}

impl Picture {
    fn render(&self, hair: &Hair, progress: &dyn Progress) -> Result<Rendered, Error> {
        let mut scene = (*hair.loaded.scene).clone();
        let output = &mut scene.output;
        output.width = self.size.0.unwrap_or(output.width);
        output.height = self.size.1.unwrap_or(output.height);
        scene.camera.azimuth = self.azimuth.unwrap_or(scene.camera.azimuth);
        let environment = environment_map(&scene, &Files::default())?;
        let output = scene.output;
        let (width, height) = (output.width, output.height);
        let pixels = width.saturating_mul(height);
        let work = self.tracing.as_ref().map_or(Work::Preview(pixels), |_| Work::Traced(pixels));
        memory::check(hair.loaded.hairstyle.spec(), work)?;
        let drawn = hair.drawn(progress)?;
        let loaded = LoadedScene { scene: Arc::new(scene), ..hair.loaded.clone() };
        let image = match &self.tracing {
            None => {
                let samples = output.samples;
                let options =
                    PreviewOptions { width, height, samples, ..PreviewOptions::default() };
                let subject = loaded.subject(&drawn.strands, environment.as_ref());
                subject.preview(&options, progress)?
            }
            Some(tracing) => {
                let mut strands = drawn.strands.clone();
                add_sections(&mut strands, &loaded.hairstyle, &loaded.head);
                let options = TraceOptions {
                    width,
                    height,
                    samples: tracing.paths,
                    noise: Some(tracing.noise).filter(|noise| *noise > 0.0),
                    bounces: tracing.bounces,
                    clamp: tracing.clamp,
                    seed: loaded.scene.look.hair.seed,
                };
                options.check().map_err(|e| Error::because(&e, ""))?;
                loaded.subject(&strands, environment.as_ref()).traced(&options, progress)?
            }
        };
        Ok(Rendered { image, output })
    }
}

/// A picture of a hairstyle as an array: rows from the top, pixels, red, green, blue (and alpha).
///
/// `tracing` is the most paths of light per pixel, the noise (0 to 1), the most bounces and the firefly clamp of a final picture.
#[pyfunction]
#[pyo3(signature = (prediction, size, azimuth, tracing, alpha, progress))]
pub(crate) fn render(
    py: Python<'_>,
    prediction: &Prediction,
    size: (Option<usize>, Option<usize>),
    azimuth: Option<f64>,
    tracing: Option<(usize, f32, u32, Option<f32>)>,
    alpha: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Memory> {
    let tracing =
        tracing.map(|(paths, noise, bounces, clamp)| Tracing { paths, noise, bounces, clamp });
    let (picture, hair) = (Picture { size, azimuth, tracing }, prediction.hair.clone());
    let pixels = work::run(py, progress, move |p| {
        let Rendered { image, output } = picture.render(&hair, p)?;
        let mut pixels = developed(&image, &output);
        if !alpha {
            pixels = pixels.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
        }
        Ok((pixels, vec![image.height(), image.width(), if alpha { 4 } else { 3 }]))
    });
    pixels.map(|(bytes, shape)| Memory::whole(bytes, shape))
}

/// A preview of a hairstyle as the bytes of a PNG.
#[pyfunction]
pub(crate) fn render_png(
    py: Python<'_>,
    prediction: &Prediction,
    width: usize,
    height: usize,
) -> PyResult<Cow<'static, [u8]>> {
    let picture = Picture { size: (Some(width), Some(height)), azimuth: None, tracing: None };
    let hair = prediction.hair.clone();
    let encoded = work::run(py, None, move |p| {
        let Rendered { image, output } = picture.render(&hair, p)?;
        // A preview has at most 16384 pixels a side.
        let encoded = png::encode(width as u32, height as u32, &developed(&image, &output));
        encoded.map_err(|e| Error::failed(&e, ""))
    });
    encoded.map(Cow::Owned)
}

/// Writes a preview of a hairstyle to a file, in the size of the scene.
#[pyfunction]
#[pyo3(signature = (prediction, path, progress))]
pub(crate) fn save_picture(
    py: Python<'_>,
    prediction: &Prediction,
    path: PathBuf,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let picture = Picture { size: (None, None), azimuth: None, tracing: None };
    let hair = prediction.hair.clone();
    work::run(py, progress, move |p| {
        let Rendered { image, output } = picture.render(&hair, p)?;
        p.check()?;
        write(&path, &image, &output)
    })
}

/// The pixels of a PNG as an array: rows from the top, pixels, channels; without the last axis for one channel.
#[pyfunction]
pub(crate) fn read_png(py: Python<'_>, png: &[u8]) -> PyResult<Memory> {
    let read = py.detach(|| png::decode(png));
    let read = read.map_err(|problem| {
        let error = Error::invalid(format!("this is no PNG: {problem}"), "");
        crate::errors::raise(py, &error)
    })?;
    let png::Decoded { width, height, channels, pixels } = read;
    let shape = if channels == 1 { vec![height, width] } else { vec![height, width, channels] };
    Ok(Memory::whole(pixels, shape))
}
