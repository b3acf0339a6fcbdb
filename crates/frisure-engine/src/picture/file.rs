//! Pictures as files, in the format that the extension names.

use std::path::Path;

use frisure::formats::picture::exr::{self, Channel, Values};
use frisure::formats::picture::{Format, PictureError, png};
use frisure::render::Image;
use frisure::render::trace::Layers;
use frisure::scene::Output;

use super::options::developed;
use crate::error::Error;

/// Writes an image that has no layers.
///
/// # Errors
/// [`Error::Failed`].
pub fn write(path: &Path, image: &Image, output: &Output) -> Result<(), Error> {
    write_as(path, image, output, || (light(image), "a preview".into()))
}

/// Writes a traced image, in OpenEXR with its layers and, if `denoised` is another, with the image before noise was removed.
pub(super) fn write_traced(
    path: &Path,
    (image, denoised): (&Image, Option<&Image>),
    layers: Layers,
    mean_samples: f64,
    output: &Output,
) -> Result<(), Error> {
    let shown = denoised.unwrap_or(image);
    write_as(path, shown, output, || {
        let mut channels = light(shown);
        channels.extend(layer_channels(layers));
        if denoised.is_some() {
            channels.extend(noisy(image));
        }
        let comment = format!(
            "{mean_samples:.0} paths per pixel; lengths in metres, z up, the face towards -y; wisps from 1"
        );
        (channels, comment)
    })
}

/// Writes an image as PNG, or its channels with a comment as OpenEXR.
fn write_as(
    path: &Path,
    image: &Image,
    output: &Output,
    channels: impl FnOnce() -> (Vec<Channel>, String),
) -> Result<(), Error> {
    let write = || -> Result<(), PictureError> {
        let (width, height) = (image.width(), image.height());
        match Format::of(path)? {
            // Both sides are at most 16384.
            Format::Png => png::write(path, width as u32, height as u32, &developed(image, output)),
            Format::Exr => {
                let (channels, comment) = channels();
                exr::write(path, width, height, channels, &comment)
            }
        }
    };
    write().map_err(|e| Error::failed(&e, ""))
}

fn light(image: &Image) -> Vec<Channel> {
    let of = |i: usize| Values::Half(image.pixels().iter().map(|pixel| pixel[i]).collect());
    ["R", "G", "B", "A"].into_iter().enumerate().map(|(i, name)| channel(name, of(i))).collect()
}

/// The light before noise was removed.
fn noisy(image: &Image) -> Vec<Channel> {
    let mut channels = light(image);
    channels.truncate(3);
    channels.iter_mut().for_each(|channel| channel.name.insert_str(0, "noisy."));
    channels
}

fn layer_channels(layers: Layers) -> Vec<Channel> {
    let Layers { albedo, normal, tangent, depth, hair, wisp, samples } = layers;
    let three = |layer: &str, names: [&str; 3], values: &[[f32; 3]]| {
        let of = |i: usize| Values::Half(values.iter().map(|v| v[i]).collect());
        (0..3).map(|i| channel(&format!("{layer}.{}", names[i]), of(i))).collect::<Vec<_>>()
    };
    let mut channels = three("albedo", ["R", "G", "B"], &albedo);
    channels.extend(three("normal", ["X", "Y", "Z"], &normal));
    channels.extend(three("tangent", ["X", "Y", "Z"], &tangent));
    channels.extend([
        channel("depth.Z", Values::Single(depth)),
        channel("hair.A", Values::Half(hair)),
        channel("wisp.id", Values::Whole(wisp)),
        channel("paths.count", Values::Whole(samples)),
    ]);
    channels
}

fn channel(name: &str, values: Values) -> Channel {
    Channel { name: name.into(), values }
}
