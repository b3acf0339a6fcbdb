//! Files of grooms: which strands, with how many points, in which unit.

use std::path::{Path, PathBuf};

use frisure::files::frame::FrameChoice;
use frisure::formats::groom::{
    Fit, FitError, Fitted, Format, Groom, GroomError, Motion, MotionError, Points, write_groom,
    write_motion,
};
use frisure::strands::Strands;
use frisure_engine::{Error, memory};

use crate::args::{Content, Writing};
use crate::{console, interrupt};

/// The hint for an output whose format prescribes a unit and axes.
const FRAME_HINT: &str = "write it in a run of its own, without `--unit` and `--up`";

/// Checks that the format of every output can hold the content, in the unit and axes chosen, and that the program
/// opens it.
pub(crate) fn check(outputs: &[PathBuf], writing: Writing) -> Result<(), Error> {
    for path in outputs {
        let format = Format::of(path).map_err(|e| Error::because(&e, hint_of(path)))?;
        if writing.content == Some(Content::Both) && !format.holds_guides() {
            let what = "both guides and hairs: it does not distinguish them".into();
            let error = GroomError::CannotHold { format: format.extension(), what };
            return Err(Error::because(&error, "write each with `--content` to a file of its own"));
        }
        let choice = choice(path, format, writing)?;
        format.check_frame(choice).map_err(|e| Error::because(&e, FRAME_HINT))?;
    }
    Ok(())
}

/// Unit and axes of a file: given, or those of the program.
fn choice(path: &Path, format: Format, writing: Writing) -> Result<FrameChoice, Error> {
    let given = writing.axes.choice();
    let Some(program) = writing.program else { return Ok(given) };
    let hint = "write other files in a run of their own, without `--for`";
    let usual = program.frame(path, format).map_err(|e| Error::because(&e, hint))?;
    Ok(FrameChoice { metres: given.metres.or(usual.metres), up: given.up.or(usual.up), ..given })
}

/// The same for files that hold the hair at several times.
pub(crate) fn check_motion(outputs: &[PathBuf]) -> Result<(), Error> {
    let check = |path: &PathBuf| Format::of(path).and_then(Format::check_motion);
    let hint = "leave `--time-samples` out, for a numbered file of each step";
    outputs.iter().try_for_each(check).map_err(|e| Error::because(&e, hint))
}

/// The same for files that hold accessories.
pub(crate) fn check_accessories(outputs: &[PathBuf]) -> Result<(), Error> {
    let check = |path: &PathBuf| Format::of(path).and_then(Format::check_accessories);
    let hint = "leave `--accessories` out, or write another format in a run of its own";
    outputs.iter().try_for_each(check).map_err(|e| Error::because(&e, hint))
}

/// Writes a groom to each path; returns a line about each.
pub(crate) fn write(
    groom: Groom,
    paths: &[PathBuf],
    writing: Writing,
) -> Result<Vec<String>, Error> {
    if let Points::Even(points) = writing.fit().points {
        let hairs = groom.hairs.len().min(writing.hairs.unwrap_or(usize::MAX));
        memory::check_points(hairs as f64 * points as f64, memory::CONVERTED_POINT)?;
    }
    let mut lines = Vec::new();
    fitted(groom, paths, writing, |path, groom, note| {
        write_file(path, writing, |choice| write_groom(path, groom, choice))?;
        lines.push(format!("{}{note}", console::shown(path)));
        Ok(())
    })?;
    Ok(lines)
}

/// Writes a file with its unit and axes.
fn write_file(
    path: &Path,
    writing: Writing,
    write: impl FnOnce(FrameChoice) -> Result<(), GroomError>,
) -> Result<(), Error> {
    let format = Format::of(path).map_err(|e| Error::because(&e, ""))?;
    let choice = choice(path, format, writing)?;
    interrupt::writing(|| write(choice)).map_err(|e| match e {
        GroomError::CannotHold { .. } => Error::because(&e, ""),
        GroomError::Frame { .. } => Error::because(&e, FRAME_HINT),
        _ => Error::failed(&e, ""),
    })
}

/// Calls `each` with each path, the groom for it, and what was done to that.
fn fitted(
    groom: Groom,
    paths: &[PathBuf],
    writing: Writing,
    mut each: impl FnMut(&Path, &Groom, &str) -> Result<(), Error>,
) -> Result<(), Error> {
    let groom = with_content(groom, writing.content);
    let groom =
        writing.program.map_or_else(|| groom.clone(), |program| program.known(groom.clone()));
    // Formats that ask for the same share the groom.
    let mut known: Option<(Fit, Fitted)> = None;
    for path in paths {
        interrupt::check()?;
        let format = Format::of(path).map_err(|e| Error::because(&e, ""))?;
        let fit = writing.fit().or_usual(format, writing.program, &groom);
        if fit.is_nothing() {
            each(path, &groom, "")?;
            continue;
        }
        let fitted = match known.take().filter(|(of, _)| *of == fit) {
            Some((_, fitted)) => fitted,
            None => groom.fitted(fit).map_err(|e| Error::because(&e, hint_of_fit(&e)))?,
        };
        let (_, fitted) = known.insert((fit, fitted));
        each(path, &fitted.groom, &told(fit, fitted))?;
    }
    Ok(())
}

/// Files that hold the hair at several times: it is added time by time, and written at the end.
pub(crate) struct MotionFiles<'a> {
    paths: &'a [PathBuf],
    writing: Writing,
    /// From one time to the next (s).
    interval: f64,
    /// Of each path, with what was done to the first groom; none before that.
    motions: Vec<(Motion, String)>,
}

impl<'a> MotionFiles<'a> {
    pub(crate) fn new(paths: &'a [PathBuf], writing: Writing, interval: f64) -> Self {
        Self { paths, writing, interval, motions: Vec::new() }
    }

    /// Adds the hair at the next time.
    pub(crate) fn push(&mut self, groom: Groom) -> Result<(), Error> {
        let (motions, interval) = (&mut self.motions, self.interval);
        let is_first = motions.is_empty();
        let mut file = 0;
        fitted(groom, self.paths, self.writing, |_, groom, note| {
            if is_first {
                motions.push((Motion::new(groom.clone(), interval), note.to_owned()));
                return Ok(());
            }
            let added = motions[file].0.push(groom);
            file += 1;
            added.map_err(|e| Error::because(&e, hint_of_motion(&e)))
        })
    }

    /// Writes the files; returns a line about each.
    pub(crate) fn write(self) -> Result<Vec<String>, Error> {
        let mut lines = Vec::new();
        for (path, (motion, note)) in self.paths.iter().zip(self.motions) {
            interrupt::check()?;
            write_file(path, self.writing, |choice| write_motion(path, &motion, choice))?;
            lines.push(format!(
                "{} ({} time samples){note}",
                console::shown(path),
                motion.times().len()
            ));
        }
        Ok(lines)
    }
}

/// What was done to a groom, in brackets; nothing if it is as it was.
fn told(fit: Fit, fitted: &Fitted) -> String {
    let mut parts = Vec::new();
    if let Some(before) = fitted.hairs_before {
        let (count, wider) = (fitted.groom.hairs.len(), fitted.widening);
        let wider =
            if wider == 1.0 { "as wide".into() } else { format!("{wider:.2} times as wide") };
        parts.push(format!("{count} of {before} hairs, {wider}"));
    }
    let error = f64::from(fitted.error) * 1e3;
    match fit.points {
        Points::Own => {}
        Points::Even(points) => {
            parts.push(format!("{points} points each, within {error:.3} mm of what they were"));
        }
        Points::AtMost(points) => parts
            .push(format!("at most {points} points each, within {error:.3} mm of what they were")),
    }
    if parts.is_empty() { String::new() } else { format!(" ({})", parts.join("; ")) }
}

/// How to ask for a groom that there is.
fn hint_of_fit(error: &FitError) -> &'static str {
    match error {
        FitError::Hairs { .. } => "ask for at most as many, or leave `--hairs` out",
        FitError::NoHairs => "leave `--hairs` out",
        FitError::Thick { .. } => "ask for more hairs, or add `--keep-widths`",
    }
}

/// How to ask for hair that can be written at several times.
fn hint_of_motion(error: &MotionError) -> &'static str {
    match error {
        MotionError::Points { .. } => "add `--points N`, so that every strand has N points",
        _ => "leave `--time-samples` out, for a numbered file of each step",
    }
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
fn hint_of(path: &Path) -> &'static str {
    match path.extension() {
        Some(e) if ["png", "exr"].iter().any(|known| e.eq_ignore_ascii_case(known)) => {
            "pictures go to `--image`"
        }
        Some(e) if e.eq_ignore_ascii_case("json") => "numbers go to `--report`",
        _ => "",
    }
}
