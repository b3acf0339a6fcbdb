//! Final pictures: exposed until they are good enough, and saved while they grow.

use std::fmt;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use frisure::denoise::{Denoiser, Noisy, VARIABLE};
use frisure::files::{self, ReadError, WriteError, write_atomically};
use frisure::formats::picture::exr::{self, Channel, Values};
use frisure::formats::picture::{Format, PictureError, png};
use frisure::look::{Camera, Lights};
use frisure::progress::{SubStage, Until};
use frisure::render::Image;
use frisure::render::trace::{ACCUMULATOR_MAGIC, Accumulator, Layers, Tracer};
use frisure::scene;

use frisure_engine::picture;

use crate::failure::Failure;
use crate::progress::Bar;
use crate::{console, interrupt};

/// How often an unfinished picture is saved.
const SAVED_EVERY: Duration = Duration::from_mins(1);

/// Largest unfinished picture that is read (bytes).
const MAX_PART: u64 = 8 << 30;

/// A scene ready for rays, and where it is seen from.
pub(crate) struct Shot {
    pub(crate) tracer: Tracer,
    /// What differs from picture to picture; without any, there is the one that the tracer has.
    pub(crate) views: Vec<(Camera, Lights)>,
    /// The first view that is wanted.
    pub(crate) from: usize,
    /// Takes out the noise, if that is wanted.
    pub(crate) denoiser: Option<Cleaner>,
}

/// Takes out a part of the noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cleaner {
    denoiser: Denoiser,
    /// 0 to 1.
    part: f32,
}

/// The denoiser for so many percent of the noise, if it is wanted: to be known before the work.
pub(crate) fn denoiser(percent: Option<f32>) -> Result<Option<Cleaner>, Failure> {
    let hint = format!(
        "install Open Image Denoise (openimagedenoise.org), or name its library in {VARIABLE} (what it \
         needs itself must be found, too: LD_LIBRARY_PATH); \
         without --denoise, more --paths have the same effect"
    );
    let find = |percent| Denoiser::find().map(|d| Cleaner { denoiser: d, part: 0.01 * percent });
    let found = percent.map(find).transpose();
    found.map_err(|e| Failure::failed_because(&e, &hint))
}

/// What is told of a picture when it is done.
#[derive(Clone, Debug)]
pub(crate) struct Exposed {
    pub(crate) path: PathBuf,
    /// Paths per pixel, in the mean.
    pub(crate) paths: f64,
    /// Standard error, as a part of the way from black to white.
    pub(crate) noise: f32,
    /// Paths per pixel that there were already.
    pub(crate) before: f64,
}

impl fmt::Display for Exposed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, paths, noise, before } = self;
        write!(f, "{}: {paths:.0} paths per pixel", path.display())?;
        if *before > 0.0 {
            write!(f, ", {before:.0} of them from before")?;
        }
        // Of very few paths nobody knows.
        if noise.is_finite() { write!(f, ", noise {:.1} %", 100.0 * noise) } else { Ok(()) }
    }
}

/// The names of the pictures of a turntable, or the one name.
pub(crate) fn names(path: &Path, turntable: Option<usize>) -> Vec<PathBuf> {
    match turntable {
        Some(frames) => (0..frames).map(|frame| numbered(path, frame, frames)).collect(),
        None => vec![path.to_owned()],
    }
}

/// The name of an output with a number before the extension: `out/hair.png` is `out/hair-07.png`.
pub(crate) fn numbered(path: &Path, number: usize, count: usize) -> PathBuf {
    let digits = count.saturating_sub(1).to_string().len().max(2);
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number:0digits$}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

/// The file that keeps an unfinished picture.
pub(crate) fn part(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    path.with_file_name(name)
}

/// Those of all pictures that will be made under a name.
pub(crate) fn parts(path: &Path, turntable: Option<usize>) -> Vec<PathBuf> {
    names(path, turntable).iter().map(|path| part(path)).collect()
}

/// Refuses to begin where a file of somebody else's would be overwritten.
pub(crate) fn check_parts(parts: &[PathBuf]) -> Result<(), Failure> {
    let foreign = |path: &&PathBuf| {
        let mut mark = [0; 8];
        let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut mark));
        match read {
            Ok(()) => mark != ACCUMULATOR_MAGIC,
            // What is not there is nobody's; what is too short or cannot be read is not ours.
            Err(error) => error.kind() != ErrorKind::NotFound,
        }
    };
    match parts.iter().find(foreign) {
        Some(path) => {
            let message = format!(
                "`{}` is in the way: it is no unfinished picture of this version",
                path.display()
            );
            Err(Failure::wrong_because(
                message,
                "the picture so far is kept under that name; move the file away",
            ))
        }
        None => Ok(()),
    }
}

/// Exposes and writes all pictures of a shot.
pub(crate) fn shoot(
    mut shot: Shot,
    path: &Path,
    output: &scene::Output,
    progress: &Bar,
) -> Result<Vec<Exposed>, Failure> {
    let Shot { tracer, views, from, denoiser } = &mut shot;
    let denoiser = denoiser.as_ref();
    if views.is_empty() {
        let writer = Writer { path: path.to_owned(), output: *output, denoiser };
        return Ok(vec![writer.expose(tracer, progress, "picture")?]);
    }
    let count = views.len();
    let mut all = Vec::new();
    for (frame, (camera, lights)) in views.iter().enumerate().skip(*from) {
        tracer.look_from(camera, lights).map_err(|e| Failure::wrong(&e, ""))?;
        let writer = Writer { path: numbered(path, frame, count), output: *output, denoiser };
        let name = format!("picture {} of {count}", frame + 1);
        all.push(writer.expose(tracer, progress, &name).map_err(|e| match e {
            Failure::Paused(what) => Failure::Paused(format!(
                "{what} With `--from {frame}` the frames before are not drawn again."
            )),
            e => e,
        })?);
    }
    Ok(all)
}

/// Where a picture goes, and how it is developed.
struct Writer<'a> {
    path: PathBuf,
    output: scene::Output,
    denoiser: Option<&'a Cleaner>,
}

impl Writer<'_> {
    fn expose(&self, tracer: &Tracer, progress: &Bar, name: &str) -> Result<Exposed, Failure> {
        let unfinished = self.unfinished(tracer)?;
        let mut accumulator = unfinished.unwrap_or_else(|| tracer.accumulator());
        let before = accumulator.mean_samples();
        let mut pause = SAVED_EVERY;
        loop {
            let since = Instant::now();
            let stop = || since.elapsed() > pause;
            let stage = SubStage { progress, stage: name, range: [0.0, 1.0] };
            let until = Until { progress: &stage, stop: &stop };
            let finished = tracer.accumulate(&mut accumulator, &until).is_ok();
            let saving = Instant::now();
            self.write(&accumulator)?;
            if finished {
                // A part that cannot be removed is one that nobody needs.
                let _ = std::fs::remove_file(part(&self.path));
                break;
            }
            // If it cannot be kept now, it may be at the next time; the picture goes on.
            let kept = self.put_away(&accumulator);
            if interrupt::interrupted() {
                return Err(Failure::Paused(self.so_far(&accumulator, kept.err())));
            }
            // Large pictures take long to write: most of the time is for tracing.
            pause = SAVED_EVERY.max(20 * saving.elapsed());
        }
        let (paths, noise) = (accumulator.mean_samples(), accumulator.noise());
        Ok(Exposed { path: self.path.clone(), paths, noise, before })
    }

    /// The accumulator that was put away, if it is one of this picture. One of another is hours of work,
    /// too: it is kept under another name.
    fn unfinished(&self, tracer: &Tracer) -> Result<Option<Accumulator>, Failure> {
        let path = part(&self.path);
        let bytes = match files::read_bytes(&path, MAX_PART, "an unfinished picture") {
            Ok(bytes) => bytes,
            Err(ReadError::Missing { .. }) => return Ok(None),
            Err(error) => return Err(error.into()),
        };
        let found = Accumulator::from_bytes(&bytes)
            .ok()
            .filter(|accumulator| tracer.can_resume(accumulator));
        if found.is_none() {
            let mut name = path.clone().into_os_string();
            name.push(".old");
            std::fs::rename(&path, &name).map_err(|e| Failure::failed(&e))?;
            let (path, old) = (path.display(), Path::new(&name).display());
            console::note(&format!(
                "`{path}` is of another picture, or damaged; it is now `{old}`"
            ));
        }
        Ok(found)
    }

    fn put_away(&self, accumulator: &Accumulator) -> Result<(), WriteError> {
        write_atomically(&part(&self.path), |out| out.write_all(&accumulator.to_bytes()))
    }

    fn so_far(&self, accumulator: &Accumulator, lost: Option<WriteError>) -> String {
        let (path, paths) = (self.path.display(), accumulator.mean_samples());
        let so_far = format!("`{path}` is what there is so far, {paths:.0} paths per pixel;");
        match lost {
            None => format!("{so_far} the same command goes on from there."),
            Some(error) => format!("{so_far} it cannot go on from there: {error}."),
        }
    }

    fn write(&self, accumulator: &Accumulator) -> Result<(), Failure> {
        let (image, layers) = (accumulator.image(), accumulator.layers());
        let clean = self.denoiser.map(|denoiser| clean(denoiser, &image, &layers)).transpose()?;
        let shown = clean.as_ref().unwrap_or(&image);
        let format = Format::of(&self.path).map_err(|e| Failure::failed(&e))?;
        let written = match format {
            Format::Png => write_png(&self.path, shown, &self.output),
            Format::Exr => {
                let mut channels = light(shown);
                channels.extend(layer_channels(layers));
                if clean.is_some() {
                    channels.extend(noisy(&image));
                }
                let comment = format!(
                    "{:.0} paths per pixel; lengths in metres, z up, the face towards -y; wisps from 1",
                    accumulator.mean_samples()
                );
                exr::write(&self.path, image.width(), image.height(), channels, &comment)
            }
        };
        written.map_err(|e| Failure::failed(&e))
    }
}

/// The picture without its noise; coverage stays.
fn clean(cleaner: &Cleaner, image: &Image, layers: &Layers) -> Result<Image, Failure> {
    let light: Vec<[f32; 3]> = image.pixels().iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    // A hair's normal turns across its width; its tangent is what it shares with its neighbours.
    let ways = layers.hair.iter().zip(layers.tangent.iter().zip(&layers.normal));
    let direction: Vec<[f32; 3]> =
        ways.map(|(hair, (t, n))| if *hair > 0.5 { *t } else { *n }).collect();
    let (width, height) = (image.width(), image.height());
    let noisy =
        Noisy { width, height, light: &light, albedo: &layers.albedo, direction: &direction };
    let clean = cleaner.denoiser.denoise(&noisy).map_err(|e| Failure::failed(&e))?;
    let mut image = image.clone();
    for (pixel, light) in image.pixels_mut().iter_mut().zip(clean) {
        for (noisy, clean) in pixel.iter_mut().zip(light) {
            *noisy += cleaner.part * (clean - *noisy);
        }
    }
    Ok(image)
}

/// Writes an image that has no layers, in the format that the path names.
pub(crate) fn write(
    path: &Path,
    image: &Image,
    output: &scene::Output,
) -> Result<(), PictureError> {
    match Format::of(path)? {
        Format::Png => write_png(path, image, output),
        Format::Exr => exr::write(path, image.width(), image.height(), light(image), "a preview"),
    }
}

fn write_png(path: &Path, image: &Image, output: &scene::Output) -> Result<(), PictureError> {
    let [width, height] = [image.width(), image.height()]
        .map(|n| u32::try_from(n).expect("pictures have at most 16384 pixels a side"));
    png::write(path, width, height, &picture::developed(image, output))
}

fn light(image: &Image) -> Vec<Channel> {
    let of = |i: usize| Values::Half(image.pixels().iter().map(|pixel| pixel[i]).collect());
    ["R", "G", "B", "A"].into_iter().enumerate().map(|(i, name)| channel(name, of(i))).collect()
}

/// The light before the noise was taken out.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_go_before_the_extension() {
        let name = |path: &str, number, count| numbered(Path::new(path), number, count);
        assert_eq!(name("out/hair.png", 7, 12), Path::new("out/hair-07.png"));
        assert_eq!(name("hair", 7, 1200), Path::new("hair-0007"));
    }
}
