//! The views of a head: pictures and maps as they are stored.

use bytes::Bytes;
use frisure::formats::picture::png;
use frisure::progress::Progress;
use frisure::render::maps::MappedPixel;
use frisure::scene::batch::{Batch, ViewOutput, Views};
use frisure_engine::memory::{self, Work};
use frisure_engine::picture::{View, Viewed};
use frisure_engine::{Error, LoadedScene};
use half::f16;

use crate::parquet;
use crate::row::StoredView;

/// The views of the head of an index as a Parquet file of one group of rows, if the batch has views.
pub(crate) fn views(
    batch: &Batch,
    index: usize,
    loaded: &LoadedScene,
    progress: &dyn Progress,
) -> Result<Bytes, Error> {
    let Some(views) = batch.views() else { return Ok(Bytes::new()) };
    // So many heads are computed at the same time, and those of a part are kept until it is written.
    let threads = rayon::current_num_threads();
    let kept =
        views.pixels() * views.cameras.len() * batch.rows().min(batch.heads()).div_ceil(threads);
    let work = Work::Views { hairs: views.hairs, pixels: views.pixels(), kept };
    memory::check_among(threads, loaded.hairstyle.spec(), work)?;
    let viewed = Viewed::new(loaded, views, progress)?;
    let stored = views.cameras.iter().map(|camera| {
        let view = viewed.view(camera, progress)?;
        let outputs = views.outputs.iter().map(|output| encoded(*output, &view, &viewed, views));
        let outputs = outputs.collect::<Result<_, Error>>()?;
        Ok(StoredView { camera: view.camera, width: viewed.width(), outputs })
    });
    let stored: Vec<StoredView> = stored.collect::<Result<_, Error>>()?;
    parquet::encode_views(index, views, &stored).map_err(|problem| Error::invalid(problem, ""))
}

/// A share of a pixel as a byte.
fn level(share: f32) -> u8 {
    (share * 255.0).round() as u8
}

/// The share of the body in a pixel, as a byte: with that of the hair it is at most 255, however both are rounded.
fn body(pixel: &MappedPixel) -> u8 {
    level(pixel.hair + pixel.body) - level(pixel.hair)
}

/// The bytes of an output: PNG, or numbers in little-endian order, row by row from the top left.
fn encoded(
    output: ViewOutput,
    view: &View,
    viewed: &Viewed<'_>,
    views: &Views,
) -> Result<Bytes, Error> {
    let png = |channels: u8, bytes: &[u8]| {
        // Sides have at most 4096 pixels.
        let (width, height) = (views.width as u32, views.height as u32);
        png::encode_channels(width, height, channels, bytes).map_err(|e| Error::failed(&e, ""))
    };
    let cover = |of: fn(&MappedPixel) -> u8| {
        let bytes: Vec<u8> = view.pixels.iter().map(of).collect();
        png(1, &bytes)
    };
    let strand = |of: &dyn Fn(u32) -> Option<u32>| {
        let index = |p: &MappedPixel| {
            let index = p.strand.and_then(|hair| of(hair.index));
            index.and_then(|index| i32::try_from(index).ok()).unwrap_or(-1).to_le_bytes()
        };
        view.pixels.iter().flat_map(index).collect::<Vec<u8>>()
    };
    let bytes = match output {
        ViewOutput::Color if view.color.chunks_exact(4).all(|pixel| pixel[3] == 255) => {
            let opaque: Vec<u8> =
                view.color.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
            png(3, &opaque)?
        }
        ViewOutput::Color => png(4, &view.color)?,
        ViewOutput::Mask => cover(|p| level(p.hair))?,
        ViewOutput::Body => cover(body)?,
        ViewOutput::Depth => view.pixels.iter().flat_map(|p| p.depth.to_le_bytes()).collect(),
        ViewOutput::Direction => {
            view.pixels.iter().flat_map(|p| halves(p.strand.map(|h| h.direction))).collect()
        }
        ViewOutput::Tangent => {
            view.pixels.iter().flat_map(|p| halves(p.strand.map(|h| h.tangent))).collect()
        }
        ViewOutput::Strand => strand(&Some),
        ViewOutput::Guide => strand(&|hair| viewed.guide(hair)),
    };
    Ok(bytes.into())
}

/// Numbers in half precision; zeros where there is no hair.
fn halves<const N: usize>(numbers: Option<[f32; N]>) -> impl Iterator<Item = u8> {
    let numbers = numbers.unwrap_or([0.0; N]);
    numbers.into_iter().flat_map(|x| f16::from_f32(x).to_le_bytes())
}
