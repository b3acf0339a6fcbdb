//! Files of grooms: which strands, with how many points, in which unit.

use std::path::PathBuf;

use frisure::formats::groom::{Format, Groom, GroomError, write_groom};
use frisure::strands::Strands;
use frisure_engine::Error;

use crate::args::{Content, Writing};
use crate::interrupt;

/// Writes grooms as the arguments say.
pub(crate) struct GroomWriter {
    writing: Writing,
}

impl GroomWriter {
    /// A writer, if the format of every output can hold the content.
    pub(crate) fn new(outputs: &[PathBuf], writing: Writing) -> Result<Self, Error> {
        for path in outputs {
            let format = Format::of(path).map_err(|e| Error::because(&e, hint_of(path)))?;
            if writing.content == Some(Content::Both) && !format.tells_guides() {
                let what = "both guides and hairs: it does not tell them apart".into();
                let error = GroomError::CannotHold { format: format.extension(), what };
                return Err(Error::because(
                    &error,
                    "write each with `--content` to a file of its own",
                ));
            }
        }
        Ok(Self { writing })
    }

    /// Writes a groom to each path; returns a line about each.
    pub(crate) fn write(&self, groom: Groom, paths: &[PathBuf]) -> Result<Vec<String>, Error> {
        let Writing { content, points, axes } = self.writing;
        let groom = chosen(groom, content);
        // Formats of the same number of points share what was resampled.
        let mut done: Option<(usize, Groom, f32)> = None;
        let mut lines = Vec::new();
        for path in paths {
            interrupt::check()?;
            let format = Format::of(path).map_err(|e| Error::because(&e, ""))?;
            let mut line = path.display().to_string();
            // What has as many points as its readers expect stays as it is.
            let strands = || groom.hairs.iter().chain(groom.guides.iter());
            let usual = format.usual_points();
            let usual = usual.filter(|n| strands().any(|strand| strand.points.len() != *n));
            let shown = match points.or(usual) {
                None => &groom,
                Some(points) => {
                    if done.as_ref().is_none_or(|d| d.0 != points) {
                        let (groom, error) = groom.resampled(points);
                        done = Some((points, groom, error));
                    }
                    let (_, groom, error) = done.as_ref().expect("just resampled");
                    let error = f64::from(*error) * 1e3;
                    line +=
                        &format!(" ({points} points each, within {error:.3} mm of what they were)");
                    groom
                }
            };
            write_groom(path, shown, axes.choice()).map_err(|e| match e {
                GroomError::CannotHold { .. } => Error::because(&e, ""),
                _ => Error::failed(&e, ""),
            })?;
            lines.push(line);
        }
        Ok(lines)
    }
}

/// What of a groom is written.
fn chosen(groom: Groom, content: Option<Content>) -> Groom {
    match content {
        None | Some(Content::Both) => groom,
        Some(Content::Hairs) => Groom { guides: Strands::new(), ..groom },
        Some(Content::Guides) => Groom { hairs: Strands::new(), ..groom },
    }
}

/// Where something goes that is no groom.
fn hint_of(path: &std::path::Path) -> &'static str {
    match path.extension() {
        Some(e) if ["png", "exr"].iter().any(|known| e.eq_ignore_ascii_case(known)) => {
            "pictures go to `--image`"
        }
        Some(e) if e.eq_ignore_ascii_case("json") => "numbers go to `--report`",
        _ => "",
    }
}
