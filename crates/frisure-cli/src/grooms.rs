//! Files of grooms: which strands, with how many points, in which unit.

use std::path::PathBuf;

use frisure::formats::groom::{Format, Groom, GroomError, write_groom};
use frisure::strands::Strands;
use frisure_engine::Error;

use crate::args::{Content, Writing};
use crate::interrupt;

/// The hint for an output whose format prescribes a unit and axes.
const FRAME_HINT: &str = "write it in a run of its own, without `--unit` and `--up`";

/// Checks that the format of every output can hold the content, in the unit and axes chosen.
pub(crate) fn check(outputs: &[PathBuf], writing: Writing) -> Result<(), Error> {
    for path in outputs {
        let format = Format::of(path).map_err(|e| Error::because(&e, hint_of(path)))?;
        if writing.content == Some(Content::Both) && !format.holds_guides() {
            let what = "both guides and hairs: it does not distinguish them".into();
            let error = GroomError::CannotHold { format: format.extension(), what };
            return Err(Error::because(&error, "write each with `--content` to a file of its own"));
        }
        format.check_frame(writing.axes.choice()).map_err(|e| Error::because(&e, FRAME_HINT))?;
    }
    Ok(())
}

/// A groom with another number of points per strand.
struct Resampled {
    points: usize,
    groom: Groom,
    /// Largest distance from the strands before (m).
    error: f32,
}

/// Writes a groom to each path; returns a line about each.
pub(crate) fn write(
    groom: Groom,
    paths: &[PathBuf],
    writing: Writing,
) -> Result<Vec<String>, Error> {
    let groom = with_content(groom, writing.content);
    // Formats with the same number of points share the resampled groom.
    let mut resampled: Option<Resampled> = None;
    let mut lines = Vec::new();
    for path in paths {
        interrupt::check()?;
        let format = Format::of(path).map_err(|e| Error::because(&e, ""))?;
        let mut line = path.display().to_string();
        let mut written = &groom;
        if let Some(points) = writing.points.or(format.other_points(&groom)) {
            let known = resampled.take().filter(|known| known.points == points);
            let Resampled { groom, error, .. } = resampled.insert(known.unwrap_or_else(|| {
                let (groom, error) = groom.resampled(points);
                Resampled { points, groom, error }
            }));
            let error = f64::from(*error) * 1e3;
            line += &format!(" ({points} points each, within {error:.3} mm of what they were)");
            written = groom;
        }
        let write = || write_groom(path, written, writing.axes.choice());
        interrupt::writing(write).map_err(|e| match e {
            GroomError::CannotHold { .. } => Error::because(&e, ""),
            GroomError::Frame { .. } => Error::because(&e, FRAME_HINT),
            _ => Error::failed(&e, ""),
        })?;
        lines.push(line);
    }
    Ok(lines)
}

/// The groom with only the strands that are wanted.
fn with_content(groom: Groom, content: Option<Content>) -> Groom {
    match content {
        None | Some(Content::Both) => groom,
        Some(Content::Hairs) => Groom { guides: Strands::new(), ..groom },
        Some(Content::Guides) => Groom { hairs: Strands::new(), ..groom },
    }
}

/// The flag for an output that is no groom.
fn hint_of(path: &std::path::Path) -> &'static str {
    match path.extension() {
        Some(e) if ["png", "exr"].iter().any(|known| e.eq_ignore_ascii_case(known)) => {
            "pictures go to `--image`"
        }
        Some(e) if e.eq_ignore_ascii_case("json") => "numbers go to `--report`",
        _ => "",
    }
}
