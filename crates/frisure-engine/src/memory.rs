//! The memory that a prediction and its picture take, estimated before the work.

use frisure::hairstyle::{HairContact, HairModel, Hairs, HairstyleSpec, StrandContact};
use frisure::rod::Resolution;
use std::path::Path;

use crate::error::Error;

/// What is made of the hairs of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Nothing: the guides alone.
    Guides,
    /// Numbers or files.
    Hairs,
    /// Files of hair at so many times.
    Motion(usize),
    /// A preview of so many pixels.
    Preview(usize),
    /// A traced picture of so many pixels.
    Traced(usize),
    /// Pictures with maps of at most so many hairs, for a batch.
    Views {
        /// Most hairs that are drawn.
        hairs: usize,
        /// Pixels of one picture.
        pixels: usize,
        /// Pixels of all pictures that are kept until they are written.
        kept: usize,
    },
}

// All measured as the largest resident size of `frisure predict` and `frisure render` on x86-64 Linux, as differences
// between two sizes, and rounded up.

/// A program with a head and few hairs (bytes). Measured: 84 MB, 101 with a small preview.
const PROGRAM: f64 = 100e6;

/// A program without a head (bytes). Measured: 9 MB.
const WITHOUT_HEAD: f64 = 20e6;

/// What a wisp takes that touches others.
struct Touching {
    /// Where it is a metre long, and where there are [`CROWD`] wisps (bytes).
    metre: f64,
    /// Power of its length (m) with which it grows.
    power: f64,
    /// For each element, where their number is given (bytes).
    element: f64,
}

/// Wisps that touch one by one. Measured beside a program with few: each of 400 wavy wisps 262 kB with 25 cm and 427 kB with 40 cm, each of
/// 800 wisps of 25 cm 366 kB, each of 1600 of 10 cm 198 kB, each of 4000 of 6 cm 270 kB, and each of 200 of 20 cm in 300 elements 645 kB.
/// Shorter and fewer ones take less: 71 kB each of 800 of 10 cm.
const TOUCHING: Touching = Touching { metre: 1.45e6, power: 1.0, element: 1.6e3 };

/// Wisps that press on each other as a volume. Measured: each of 400 wavy wisps 388 kB with 40 cm, each of 800 of 40 cm 0.62 MB in 330 s,
/// when it had not ended, each of 1600 of 10 cm 131 kB, and each of 200 of 20 cm in 300 elements 1.2 MB.
const PRESSING: Touching = Touching { metre: 2e6, power: 1.34, element: 4.6e3 };

/// Wisps at which the lengths above hold. More of them are nearer, and touch in more places: what each takes grows about as the square root of
/// their number.
const CROWD: f64 = 400.0;

/// A simulated hair in contact with others (bytes). Measured between 1 000 and 10 000 straight hairs of 25 cm: 45 kB.
const HAIR_IN_CONTACT: f64 = 6e4;

/// A point of a drawn hair, in a report or a file (bytes). Measured with 4 to 7 million points: 41 in `.hair`, `.obj` and `.ply`, 45 in
/// `.abc`, 53 to 65 in `.npz`, 77 to 94 in `.usda` and `.usdc`.
const POINT: f64 = 95.0;

/// A point at a time in a file of several times (bytes). Measured with six times of 2 million points: 13 in `.abc`, 41 in
/// `.usdc`.
const MOVING_POINT: f64 = 45.0;

/// A point of a hair in a preview (bytes), beside its pieces and lumps. Measured with 3 to 7 million points, with both: 117 in straight hair of
/// 3 cm, 200 and 203 of 25 cm, 197 in curly and 249 in kinky hair.
const PREVIEWED_POINT: f64 = 70.0;

/// A straight piece that a preview draws (bytes): 40 of a vertex, its radiance, and its places in the lists of tiles. With [`LUMP`] fitted to
/// what was measured of points.
const PIECE: f64 = 45.0;

/// A lump of hair, which grids of a preview are filled with (bytes), and its length (m): 1.2 of the finest cells of 2.2 mm, as `frisure-render` has them.
const LUMP: f64 = 30.0;
const LUMP_LENGTH: f64 = 2.6e-3;

/// Pieces of a preview: largest turn (rad), length (m), and length on the picture (pixels), as `frisure-render` has them.
const PIECE_TURN: f64 = 0.3;
const PIECE_LENGTH: f64 = 6e-3;
const PIECE_PIXELS: f64 = 16.0;

/// What a preview shows across (m): a head with some room.
const SHOWN: f64 = 0.4;

/// A point of a hair in a traced picture (bytes). Measured: 207 in straight hair of 3 cm, 229 in kinky hair, 240 in straight hair of 25 cm.
const TRACED_POINT: f64 = 240.0;

/// A pixel of a preview with its file (bytes). Measured between 500² and 4000² pixels: 30 to 36.
const PREVIEWED_PIXEL: f64 = 36.0;

/// A pixel of a traced picture with its checkpoint and its file (bytes). Measured between 512² and 1536² pixels: 154.
const TRACED_PIXEL: f64 = 160.0;

/// A point of a hair in a picture with maps (bytes), beside its pieces: that of a preview and of the tree of a traced picture.
const VIEWED_POINT: f64 = PREVIEWED_POINT + TRACED_POINT;

/// A pixel of a picture with maps, while they are made (bytes): a preview, the maps, and both encoded.
const VIEWED_PIXEL: f64 = PREVIEWED_PIXEL + 100.0;

/// A pixel of a picture with maps in a file (bytes). All maps without compression.
const KEPT_PIXEL: f64 = 25.0;

/// Hairs over the density of the scalp (m²). Measured: 0.051 on the mannequin and 0.053 on the built-in woman's head, whose scalp thins out at
/// its edge.
const SCALP: f64 = 0.056;

/// Most hairs, and most points of all, that a head can have.
const MOST_HAIRS: f64 = 1e6;
const MOST_POINTS: f64 = 2e8;

/// An estimate of the memory (bytes) that hair of a description takes, with what is made of it.
#[must_use]
pub fn estimate(spec: &HairstyleSpec, work: Work) -> f64 {
    let wisps = spec.wisps.count as f64;
    let hairs = match spec.wisps.hairs {
        Hairs::Count(count) => count as f64,
        Hairs::PerWisp(each) => each as f64 * wisps,
        Hairs::Density(density) => density * SCALP,
    };
    let hairs = match work {
        Work::Views { hairs: most, .. } => hairs.min(most as f64),
        _ => hairs,
    };
    let points = hairs * spec.wisps.points as f64;
    let pushing = spec.wisps.strands == HairModel::Simulated
        && spec.wisps.contact != StrandContact::Tube
        && work != Work::Guides;
    let contact = if pushing { hairs.min(MOST_HAIRS) * HAIR_IN_CONTACT } else { 0.0 };
    // More are refused by the key that asks for them, when the area of the scalp is known.
    let drawn = if hairs > MOST_HAIRS || points > MOST_POINTS { 0.0 } else { hairs };
    let hair = spec.wisps.points as f64 * point(work) + pieces(spec, work);
    PROGRAM + touching(spec) + contact + drawn * hair + picture(work)
}

/// Memory of wisps that touch each other (bytes).
fn touching(spec: &HairstyleSpec) -> f64 {
    let Touching { metre, power, element } = match spec.contact.hair {
        HairContact::Wisps => TOUCHING,
        HairContact::Density => PRESSING,
        HairContact::None | HairContact::Layers => return 0.0,
    };
    let wisps = spec.wisps.count as f64;
    let elements = match spec.equilibrium.resolution {
        Resolution::Elements(n) => n as f64,
        // As many as the length asks for, which are in the memory of each metre.
        Resolution::Accuracy(_) => 0.0,
    };
    wisps * (metre * spec.length.mean.powf(power) * (wisps / CROWD).sqrt() + elements * element)
}

/// Memory of the straight pieces of a hair in a preview, one between two points and as many more as its turns, its length and its pixels
/// need, and of its lumps (bytes).
fn pieces(spec: &HairstyleSpec, work: Work) -> f64 {
    let pixels = match work {
        Work::Guides | Work::Hairs | Work::Motion(_) | Work::Traced(_) => return 0.0,
        Work::Preview(pixels) | Work::Views { pixels, .. } => pixels as f64,
    };
    let length = spec.length.mean;
    let turns = spec.curl.strain.truncate().length() * length / PIECE_TURN;
    let across = length / SHOWN * pixels.sqrt() / PIECE_PIXELS;
    let pieces = spec.wisps.points as f64 + turns.max(length / PIECE_LENGTH).max(across);
    pieces * PIECE + length / LUMP_LENGTH * LUMP
}

fn point(work: Work) -> f64 {
    match work {
        Work::Guides => 0.0,
        Work::Hairs => POINT,
        Work::Motion(samples) => POINT + MOVING_POINT * samples as f64,
        Work::Preview(_) => PREVIEWED_POINT,
        Work::Traced(_) => TRACED_POINT,
        Work::Views { .. } => VIEWED_POINT,
    }
}

/// Memory of a picture alone (bytes).
fn picture(work: Work) -> f64 {
    match work {
        Work::Guides | Work::Hairs | Work::Motion(_) => 0.0,
        Work::Preview(pixels) => pixels as f64 * PREVIEWED_PIXEL,
        Work::Traced(pixels) => pixels as f64 * TRACED_PIXEL,
        Work::Views { pixels, kept, .. } => pixels as f64 * VIEWED_PIXEL + kept as f64 * KEPT_PIXEL,
    }
}

/// Checks that hair of a description, and what is made of it, has room in memory.
///
/// Where the system does not tell how much there is, everything has room.
///
/// # Errors
/// [`Error::Invalid`], with both numbers.
pub fn check(spec: &HairstyleSpec, work: Work) -> Result<(), Error> {
    check_among(1, spec, work)
}

/// The same of one of so many computations at the same time, each of which has its share of what is free.
///
/// # Errors
/// As [`check`].
pub fn check_among(computations: usize, spec: &HairstyleSpec, work: Work) -> Result<(), Error> {
    let share = available().map(|room| room / computations.max(1) as u64);
    check_within(|work| estimate(spec, work), touching(spec), work, share)
}

/// The same of a picture of hair that is read from a file.
///
/// # Errors
/// As [`check`].
pub fn check_picture(work: Work) -> Result<(), Error> {
    check_within(|work| PROGRAM + picture(work), 0.0, work, available())
}

/// The same of the atlas of cards with so many pixels across and down, whose maps take about what a preview of that size does.
///
/// # Errors
/// As [`check`].
pub fn check_atlas(texture: usize) -> Result<(), Error> {
    let needed = |texture: usize| PROGRAM + picture(Work::Preview(texture * texture));
    let Some(room) = available().filter(|&room| needed(texture) > room as f64) else {
        return Ok(());
    };
    let smaller = std::iter::successors(Some(texture), |texture| Some(texture / 2));
    let fits =
        smaller.take_while(|texture| *texture > 0).find(|&texture| needed(texture) <= room as f64);
    let hint = match fits {
        Some(texture) => format!("`--texture-size {texture}` has room"),
        None => "have more memory free".to_owned(),
    };
    let (needed, room) = (amount(needed(texture)), amount(room as f64));
    Err(Error::invalid(format!("it takes about {needed} of memory, and {room} are free"), &hint))
}

/// A point of a hair that is read and written anew (bytes). Measured with 40 000 hairs between 100 and 400 points: 50.
pub const CONVERTED_POINT: f64 = 60.0;

/// What a groom takes while it is read and written anew, over the size of its file. Measured of 6.7 million points, written as `.hair`: 5.6 of
/// `.hair`, `.abc` and `.npz`, 6.6 of `.usdc`, 6.7 of `.data`, 4.1 of `.ply`, 2.9 of `.obj`, 2.6 of `.usda`; the addresses that `ulimit -v` bounds
/// are up to four fifths more (`.usda`). What is compressed takes more.
const GROOM: [(&str, f64); 6] =
    [("data", 8.0), ("usdc", 8.2), ("usdz", 8.2), ("ply", 4.2), ("obj", 3.0), ("usda", 4.8)];
const BINARY_GROOM: f64 = 5.6;

/// A pixel of a photo that is read and measured (bytes). Measured between 3000² and 12 000² pixels: 7.3.
pub const PHOTO_PIXEL: f64 = 8.0;

/// A pixel of an environment map, beside its file (bytes). Measured between 8192 × 4096 and 16 384 × 8192 pixels: 11.6.
pub const ENVIRONMENT_PIXEL: f64 = 12.5;

/// How many things of so many bytes have room in memory, beside the program and `taken` bytes; all where the system does not tell.
#[must_use]
pub fn room(each: f64, taken: f64) -> usize {
    // Rounded down; no number is above the largest.
    available()
        .map_or(usize::MAX, |room| ((room as f64 - PROGRAM - taken).max(0.0) / each) as usize)
}

/// Checks that the groom in a file has room in memory, by the size of the file: what has none is told by the reader.
///
/// # Errors
/// [`Error::Invalid`], with both numbers.
pub fn check_groom(path: &Path) -> Result<(), Error> {
    let Ok(about) = std::fs::metadata(path) else { return Ok(()) };
    check_groom_within(path, about.len(), available())
}

fn check_groom_within(path: &Path, size: u64, available: Option<u64>) -> Result<(), Error> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let of_format = GROOM.iter().find(|(name, _)| extension == *name);
    let needed = WITHOUT_HEAD + size as f64 * of_format.map_or(BINARY_GROOM, |(_, times)| *times);
    let Some(available) = available.filter(|&room| needed > room as f64) else { return Ok(()) };
    let (needed, room) = (amount(needed), amount(available as f64));
    let problem = format!(
        "`{}`: a groom of this size takes about {needed} of memory, and {room} are free",
        path.display()
    );
    Err(Error::invalid(problem, "write it with fewer hairs or points where it was made"))
}

/// A point of a hair that was read, in a preview with its pieces (bytes): the most that was measured for [`PREVIEWED_POINT`].
const PREVIEWED_GROOM_POINT: f64 = 250.0;

/// Checks that a picture of hair of so many points, which is in memory already, has room beside it.
///
/// # Errors
/// [`Error::Invalid`], with both numbers.
pub fn check_drawn(points: usize, work: Work) -> Result<(), Error> {
    check_within(|work| drawn(points, work), 0.0, work, available())
}

/// Memory of a picture of hair of so many points, beside that hair (bytes).
fn drawn(points: usize, work: Work) -> f64 {
    let each = match work {
        Work::Preview(_) => PREVIEWED_GROOM_POINT,
        work => point(work),
    };
    points as f64 * each + picture(work)
}

/// A point of one hair in JSON (bytes). Measured with a million: 287, and 450 of addresses, because a text that grows is twice as long.
pub const PRINTED_POINT: f64 = 450.0;

/// The same of a number of points with so many bytes each, beside the program.
///
/// # Errors
/// As [`check`].
pub fn check_points(points: f64, each: f64) -> Result<(), Error> {
    check_within(|_| WITHOUT_HEAD + points * each, 0.0, Work::Hairs, available())
}

/// Memory for a person.
fn amount(bytes: f64) -> String {
    match bytes / 1e9 {
        gigabytes if gigabytes < 1.0 => format!("{:.0} MB", 1e3 * gigabytes),
        gigabytes => format!("{gigabytes:.1} GB"),
    }
}

/// What helps where wisps that touch each other are what is too large.
const FEWER_WISPS: &str = "make fewer wisps (`wisps.count`), or set `contact.hair = \"layers\"`";

/// Compares what a work needs, of which so much is for wisps that touch, with what is available (bytes).
fn check_within(
    needs: impl Fn(Work) -> f64,
    touching: f64,
    work: Work,
    available: Option<u64>,
) -> Result<(), Error> {
    let needed = needs(work);
    let Some(available) = available.filter(|&room| needed > room as f64) else { return Ok(()) };
    let has_room = |pixels: usize| needs(with_pixels(work, pixels)) <= available as f64;
    let hint = match work {
        Work::Guides => FEWER_WISPS,
        _ if touching > 0.5 * needed => FEWER_WISPS,
        Work::Hairs | Work::Motion(_) => "draw fewer hairs, or give them fewer points",
        Work::Views { .. } => {
            "make smaller views (`views.size`) or fewer (`views.cameras`), draw fewer hairs (`views.hairs`), have fewer \
             heads in a file (`rows`), or compute on fewer threads"
        }
        // Where the picture is not what is too large.
        _ if !has_room(1) || needs(with_pixels(work, 1)) > 0.5 * needed => {
            "draw fewer hairs, or give them fewer points"
        }
        Work::Preview(pixels) | Work::Traced(pixels) => {
            &format!("a picture of {} pixels has room", largest(pixels, has_room))
        }
    };
    let (needed, room) = (amount(needed), amount(available as f64));
    let problem = format!("it takes about {needed} of memory, and {room} are free");
    Err(Error::invalid(problem, hint))
}

/// Addresses (bytes) that the allocator of the C library reserves for a thread and does not use. Measured: at its end, a process has 60 to
/// 250 MB more of addresses than at its beginning beside what it takes.
#[cfg(target_os = "linux")]
const RESERVED: u64 = 64 << 20;

/// The same work with a picture of so many pixels.
fn with_pixels(work: Work, pixels: usize) -> Work {
    match work {
        Work::Preview(_) => Work::Preview(pixels),
        Work::Traced(_) => Work::Traced(pixels),
        Work::Guides | Work::Hairs | Work::Motion(_) | Work::Views { .. } => work,
    }
}

/// The largest number of which something holds, between one, of which it holds, and `most`, of which it does not.
fn largest(most: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut good, mut bad) = (1, most);
    while bad > good + 1 {
        let middle = good + (bad - good) / 2;
        *(if holds(middle) { &mut good } else { &mut bad }) = middle;
    }
    good
}

/// Memory that this process can still take (bytes), if the system tells: what is free, what the limit of its address
/// space leaves (`ulimit -v`), and what its control group leaves.
#[cfg(target_os = "linux")]
fn available() -> Option<u64> {
    let read = |path: &str| std::fs::read_to_string(path).ok();
    let free = read("/proc/meminfo").and_then(|text| kilobytes(&text, "MemAvailable:"));
    let status = read("/proc/self/status");
    let used = status.and_then(|text| kilobytes(&text, "VmSize:")).unwrap_or(0);
    let limit = read("/proc/self/limits").and_then(|text| {
        let line = text.lines().find_map(|line| line.strip_prefix("Max address space"))?;
        line.split_whitespace().next()?.parse::<u64>().ok()
    });
    let group = read("/sys/fs/cgroup/memory.max").and_then(|text| {
        let used = read("/sys/fs/cgroup/memory.stat")?;
        let anonymous = used.lines().find_map(|line| line.strip_prefix("anon "))?;
        Some(text.trim().parse::<u64>().ok()?.saturating_sub(anonymous.trim().parse().ok()?))
    });
    let addresses = limit.map(|limit| limit.saturating_sub(used + RESERVED));
    [free, addresses, group].into_iter().flatten().min()
}

/// A number of kilobytes in a text of the system, in bytes.
#[cfg(target_os = "linux")]
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? * 1024)
}

/// Other systems do not tell without foreign code.
#[cfg(not(target_os = "linux"))]
fn available() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use frisure::hairstyle::preset;

    use super::*;

    fn fault(work: Work, room: u64) -> Option<(String, String)> {
        let spec = preset("wavy").unwrap().spec();
        let error =
            check_within(|work| estimate(&spec, work), touching(&spec), work, Some(room)).err()?;
        Some((error.to_string(), error.hint().to_owned()))
    }

    #[test]
    fn what_has_no_room_is_refused_with_what_has() {
        assert_eq!(fault(Work::Preview(1024 * 1024), 4 << 30), None);
        let (problem, hint) = fault(Work::Preview(16_384 * 16_384), 4 << 30).unwrap();
        assert!(problem.contains("GB of memory, and 4.3 GB are free"), "{problem}");
        let pixels = hint.split(' ').find_map(|word| word.parse::<usize>().ok()).unwrap();
        assert_eq!(fault(Work::Preview(pixels - 1), 4 << 30), None);
        assert!(fault(Work::Preview(pixels + pixels / 100), 4 << 30).is_some());
        let (problem, _) = fault(Work::Traced(8192 * 8192), 4 << 30).unwrap();
        assert!(problem.contains("4.3 GB are free"), "{problem}");
        let (_, hint) = fault(Work::Hairs, 1 << 28).unwrap();
        assert!(hint.starts_with("draw fewer hairs"), "{hint}");
        let views = |pixels| Work::Views { hairs: 20_000, pixels, kept: 16 * pixels };
        assert_eq!(fault(views(512 * 512), 1 << 30), None);
        let (_, hint) = fault(views(4096 * 4096), 4 << 30).unwrap();
        assert!(hint.contains("`views.size`"), "{hint}");
        // Guides need no room for hairs.
        assert_eq!(fault(Work::Guides, 1 << 28), None);
        let (_, hint) = fault(Work::Guides, 1 << 24).unwrap();
        assert!(hint.contains("`wisps.count`"), "{hint}");
        assert!(check_within(|_| 1e18, 0.0, Work::Hairs, None).is_ok());
        let groom = |name: &str, room| check_groom_within(Path::new(name), 1 << 30, room);
        assert!(groom("a.hair", None).is_ok() && groom("a.hair", Some(7 << 30)).is_ok());
        let error = groom("a.HAIR", Some(5 << 30)).unwrap_err();
        assert!(
            error.to_string().contains("`a.HAIR`: a groom of this size takes about 6.0 GB"),
            "{error}"
        );
        // Lines of text take less than binary points.
        assert!(groom("a.USDA", Some(5 << 30)).is_ok() && groom("a.data", Some(6 << 30)).is_err());
    }

    /// The estimate over what was measured, as the largest resident size (MB) of `frisure predict` on scenes in the form of
    /// [`estimate`]'s arguments.
    #[test]
    fn estimates_are_above_what_was_measured_and_not_far() {
        let estimated = |name: &str, work, change: &dyn Fn(&mut HairstyleSpec)| {
            let mut spec = preset(name).unwrap().spec();
            change(&mut spec);
            estimate(&spec, work) * 1e-6
        };
        let same = |_: &mut HairstyleSpec| {};
        let drawn = |length: f64, hairs: usize, points: usize| {
            move |spec: &mut HairstyleSpec| {
                spec.length.mean = length;
                (spec.wisps.hairs, spec.wisps.points) = (Hairs::Count(hairs), points);
            }
        };
        let touch = |hair: HairContact, wisps: usize, length: f64| {
            move |spec: &mut HairstyleSpec| {
                spec.length.mean = length;
                (spec.wisps.count, spec.wisps.points) = (wisps, 4);
                spec.wisps.hairs = Hairs::Count(100);
                spec.contact.hair = hair;
            }
        };
        let in_elements = |hair: HairContact| {
            move |spec: &mut HairstyleSpec| {
                touch(hair, 200, 0.2)(spec);
                spec.equilibrium.resolution = Resolution::Elements(300);
            }
        };
        let page = 900 * 1100;
        let (wisps, density) = (HairContact::Wisps, HairContact::Density);
        let scenes: [(f64, f64); 17] = [
            (1528.0, estimated("african-kinky", Work::Preview(page), &same)),
            (930.0, estimated("caucasian-straight", Work::Preview(page), &same)),
            (1324.0, estimated("caucasian-curly", Work::Preview(page), &same)),
            (1145.0, estimated("caucasian-straight", Work::Traced(page), &same)),
            (734.0, estimated("african-kinky", Work::Hairs, &same)),
            (575.0, estimated("straight", Work::Preview(200 * 200), &drawn(0.03, 40_000, 100))),
            (792.0, estimated("straight", Work::Preview(1000 * 1000), &drawn(0.25, 100_000, 32))),
            (915.0, estimated("straight", Work::Traced(200 * 200), &drawn(0.03, 40_000, 100))),
            (393.0, estimated("straight", Work::Hairs, &drawn(0.03, 40_000, 100))),
            (1166.0, estimated("wavy", Work::Hairs, &touch(wisps, 4000, 0.06))),
            (400.0, estimated("wavy", Work::Hairs, &touch(wisps, 1600, 0.1))),
            (255.0, estimated("wavy", Work::Hairs, &touch(wisps, 400, 0.4))),
            (255.0, estimated("wavy", Work::Hairs, &touch(density, 400, 0.4))),
            (310.0, estimated("wavy", Work::Hairs, &touch(density, 1600, 0.1))),
            (213.0, estimated("wavy", Work::Hairs, &in_elements(wisps))),
            (335.0, estimated("wavy", Work::Hairs, &in_elements(density))),
            (598.0, estimated("wavy", Work::Hairs, &touch(density, 800, 0.4))),
        ];
        for (i, (measured, estimated)) in scenes.into_iter().enumerate() {
            let ratio = estimated / measured;
            assert!((1.0..=1.55).contains(&ratio), "scene {i}: {estimated:.0} of {measured} MB");
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn linux_tells_how_much_memory_is_free() {
        assert!(available().is_some_and(|bytes| bytes > 1 << 20));
        assert_eq!(kilobytes("A: 1 kB\nMemAvailable:   12 kB\n", "MemAvailable:"), Some(12 << 10));
    }
}
