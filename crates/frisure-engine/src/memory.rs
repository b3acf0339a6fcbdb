//! The memory that a prediction and its picture take, estimated before the work.

use frisure::hairstyle::{HairContact, HairModel, Hairs, HairstyleSpec, StrandContact};

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

/// A program with a head and few hairs (bytes). Measured: 50 to 60 MB.
const PROGRAM: f64 = 64e6;

/// A wisp that touches others (bytes). Measured between 400 and 1600 wavy wisps of 10 cm: 172 kB.
const TOUCHING_WISP: f64 = 2e5;

/// A simulated hair in contact with others (bytes). Measured between 1 000 and 10 000 straight hairs of 25 cm: 45 kB.
const HAIR_IN_CONTACT: f64 = 6e4;

/// A point of a drawn hair, in a report or a file (bytes). Measured between 2 and 8 million points: 29 and 58.
const POINT: f64 = 60.0;

/// A point at a time in a file of several times (bytes). Measured with six times of 2 million points: 13 in `.abc`, 41 in
/// `.usdc`.
const MOVING_POINT: f64 = 45.0;

/// The same in a preview (bytes). Measured: 74.
const PREVIEWED_POINT: f64 = 80.0;

/// The same in a traced picture (bytes). Measured: 144.
const TRACED_POINT: f64 = 150.0;

/// A pixel of a preview with its file (bytes). Measured between 500² and 4000² pixels: 30 to 36.
const PREVIEWED_PIXEL: f64 = 36.0;

/// A pixel of a traced picture with its checkpoint and its file (bytes). Measured between 512² and 1536² pixels: 154.
const TRACED_PIXEL: f64 = 160.0;

/// A point of a hair in a picture with maps (bytes): that of a preview and of the tree of a traced picture.
const VIEWED_POINT: f64 = PREVIEWED_POINT + TRACED_POINT;

/// A pixel of a picture with maps, while they are made (bytes): a preview, the maps, and both encoded.
const VIEWED_PIXEL: f64 = PREVIEWED_PIXEL + 100.0;

/// A pixel of a picture with maps in a file (bytes). All maps without compression.
const KEPT_PIXEL: f64 = 25.0;

/// Area on which hair grows (m²). That of the mannequin is 0.07.
const SCALP: f64 = 0.07;

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
    let touch = matches!(spec.contact.hair, HairContact::Wisps | HairContact::Density);
    let touching = if touch { wisps } else { 0.0 };
    let points = hairs * spec.wisps.points as f64;
    let pushing = spec.wisps.strands == HairModel::Simulated
        && spec.wisps.contact != StrandContact::Tube
        && work != Work::Guides;
    let contact = if pushing { hairs.min(MOST_HAIRS) * HAIR_IN_CONTACT } else { 0.0 };
    // More are refused by the key that asks for them, when the area of the scalp is known.
    let points = if hairs > MOST_HAIRS || points > MOST_POINTS { 0.0 } else { points };
    PROGRAM + touching * TOUCHING_WISP + contact + points * point(work) + picture(work)
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
    check_within(estimate(spec, work), work, share)
}

/// The same of a picture of hair that is read from a file.
///
/// # Errors
/// As [`check`].
pub fn check_picture(work: Work) -> Result<(), Error> {
    check_within(PROGRAM + picture(work), work, available())
}

/// A point of a hair that is read and written anew (bytes). Measured with 40 000 hairs between 100 and 400 points: 50.
pub const CONVERTED_POINT: f64 = 60.0;

/// A point of one hair in JSON (bytes). Measured between 100 000 and a million: 282.
pub const PRINTED_POINT: f64 = 300.0;

/// The same of a number of points with so many bytes each, beside the program.
///
/// # Errors
/// As [`check`].
pub fn check_points(points: f64, each: f64) -> Result<(), Error> {
    check_within(PROGRAM + points * each, Work::Hairs, available())
}

fn check_within(needed: f64, work: Work, available: Option<u64>) -> Result<(), Error> {
    let Some(available) = available.filter(|&room| needed > room as f64) else { return Ok(()) };
    let amount = |bytes: f64| match bytes / 1e9 {
        gigabytes if gigabytes < 1.0 => format!("{:.0} MB", 1e3 * gigabytes),
        gigabytes => format!("{gigabytes:.1} GB"),
    };
    let most = (available as f64 - (needed - picture(work))).max(0.0);
    let hint = match work {
        Work::Guides => "make fewer wisps (`wisps.count`), or set `contact.hair = \"layers\"`",
        Work::Hairs | Work::Motion(_) => "draw fewer hairs, or give them fewer points",
        Work::Views { .. } => {
            "make smaller views (`views.size`) or fewer (`views.cameras`), draw fewer hairs (`views.hairs`), have fewer \
             heads in a file (`rows`), or compute on fewer threads"
        }
        // Where the picture is not what is too large.
        _ if picture(work) < 0.5 * needed => "draw fewer hairs, or give them fewer points",
        Work::Preview(_) => &format!("a picture of {:.0} pixels has room", most / PREVIEWED_PIXEL),
        Work::Traced(_) => &format!("a picture of {:.0} pixels has room", most / TRACED_PIXEL),
    };
    let (needed, room) = (amount(needed), amount(available as f64));
    let problem = format!("it takes about {needed} of memory, and {room} are free");
    Err(Error::invalid(problem, hint))
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
    [free, limit.map(|limit| limit.saturating_sub(used)), group].into_iter().flatten().min()
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
        let error = check_within(estimate(&spec, work), work, Some(room)).err()?;
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
        assert!(check_within(1e18, Work::Hairs, None).is_ok());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn linux_tells_how_much_memory_is_free() {
        assert!(available().is_some_and(|bytes| bytes > 1 << 20));
        assert_eq!(kilobytes("A: 1 kB\nMemAvailable:   12 kB\n", "MemAvailable:"), Some(12 << 10));
    }
}
