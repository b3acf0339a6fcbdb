//! Programs that grooms are written for: the formats, the unit, the axes and the sizes that each takes.

use std::path::Path;

use frisure_files::frame::{Frame, FrameChoice};
use frisure_strands::Strands;

use super::attributes::{CLOSEST_GUIDES, CLUMP, COLOUR, GROUP, GUIDE, GUIDE_WEIGHTS, ID, ROOT_UV};
use super::data::Groom;
use super::fit::{Fit, Points};
use super::format::Format;

/// A program that opens grooms. `docs/grooms.md` says what of it was tried.
#[derive(Debug)]
pub struct Program {
    /// The name by which it is chosen.
    pub name: &'static str,
    /// What it is.
    pub title: &'static str,
    /// The extensions that it opens, each with the unit and axes that it expects there.
    pub formats: &'static [(&'static str, Frame)],
    /// The most hairs, if it is slow with more.
    pub most_hairs: Option<usize>,
    /// The points that it takes.
    pub points: Points,
    /// Whether it knows guides; else they would be drawn as hairs.
    pub guides: bool,
    /// Whether it binds roots to a head by their texture coordinates.
    pub binds: bool,
    /// The attributes that it reads; none: all.
    pub attributes: Option<&'static [&'static str]>,
}

/// Why a file cannot be for a program.
#[derive(Clone, Debug, thiserror::Error, PartialEq, Eq)]
#[error("`{path}` is not for {program}, which opens {known}")]
pub struct ProgramError {
    /// The path given.
    pub path: String,
    /// The program's name.
    pub program: &'static str,
    /// The extensions that it opens.
    pub known: String,
}

/// Blender converts y up to z up and takes a unit of Alembic for a metre.
const BLENDER: &[(&str, Frame)] = &[
    ("usdc", Frame::METRES_Z),
    ("usda", Frame::METRES_Z),
    ("usdz", Frame::METRES_Z),
    ("abc", Frame::METRES_Y),
];

impl Program {
    /// All programs.
    pub const ALL: &[Self] = &[
        Self {
            name: "unreal",
            title: "Unreal Engine: Alembic by Epic's specification of grooms",
            formats: &[("abc", Frame::CENTIMETRES_Y)],
            most_hairs: None,
            // HAIR_MAX_NUM_POINT_PER_CURVE of the engine's HairStrandsDefinitions: further points are cut off.
            points: Points::AtMost(255),
            guides: true,
            binds: true,
            attributes: Some(&[
                GUIDE,
                CLOSEST_GUIDES,
                GUIDE_WEIGHTS,
                ID,
                GROUP,
                ROOT_UV,
                COLOUR,
                CLUMP,
            ]),
        },
        Self {
            name: "blender",
            title: "Blender: USD, or Alembic in metres",
            formats: BLENDER,
            most_hairs: None,
            points: Points::Own,
            guides: true,
            binds: true,
            attributes: None,
        },
        Self {
            name: "unity",
            title: "Unity's hair package: Alembic of all hairs, no guides, 32 even points",
            formats: &[("abc", Frame::CENTIMETRES_Y)],
            most_hairs: None,
            // The package resamples curves whose numbers of points differ, evenly, to at most 128.
            points: Points::Even(32),
            guides: false,
            binds: false,
            attributes: Some(&[ID, GROUP, ROOT_UV, COLOUR]),
        },
        Self {
            name: "web",
            title: "browsers: a page or glTF, 20 000 hairs of at most 32 points",
            formats: &[("html", Frame::METRES_Z), ("glb", Frame::METRES_Y)],
            most_hairs: Some(20_000),
            points: Points::AtMost(32),
            guides: false,
            binds: false,
            attributes: Some(&[COLOUR]),
        },
    ];

    /// The unit and axes that it expects in a file.
    ///
    /// # Errors
    /// [`ProgramError`], if it does not open such files.
    pub fn frame(&self, path: &Path, format: Format) -> Result<FrameChoice, ProgramError> {
        let known = |(extension, _): &&(&str, Frame)| format.extensions().contains(extension);
        let found = self.formats.iter().find(known).ok_or_else(|| ProgramError {
            path: path.display().to_string(),
            program: self.name,
            known: self.formats.iter().map(|f| format!(".{}", f.0)).collect::<Vec<_>>().join(", "),
        })?;
        Ok(FrameChoice {
            metres: Some(found.1.metres),
            up: Some(found.1.up),
            ..FrameChoice::default()
        })
    }

    /// The groom without what the program does not know.
    #[must_use]
    pub fn known(&self, groom: Groom) -> Groom {
        let Groom { hairs, guides, .. } = groom;
        let keep = |strands: Strands| match self.attributes {
            None => strands,
            Some(known) => strands.with_attributes(|name| known.contains(&name)),
        };
        // A file of guides alone keeps them: they are all there is.
        let guides = if self.guides || hairs.is_empty() { keep(guides) } else { Strands::new() };
        Groom { hairs: keep(hairs), guides, ..groom }
    }
}

impl Fit {
    /// What a format asks for of a groom, for a program if one is named, where `self` leaves it open.
    #[must_use]
    pub fn or_usual(self, format: Format, program: Option<&Program>, groom: &Groom) -> Self {
        let most = program.and_then(|p| p.most_hairs).or(format.most_hairs());
        let hairs = self.hairs.or(most.filter(|most| *most < groom.hairs.len()));
        let usual = format.other_points(groom).map(Points::Even);
        let usual = usual.or(program.map(|p| p.points)).unwrap_or_default();
        let points = if self.points == Points::Own { usual } else { self.points };
        Self { hairs, points, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_of_a_program_can_have_its_unit_and_axes() {
        for program in Program::ALL {
            for (extension, frame) in program.formats {
                let Some(format) = Format::named(extension) else { continue };
                let choice = program.frame(Path::new("a"), format).unwrap();
                assert_eq!(choice.or(format.frame()), *frame);
                format.check_frame(choice).unwrap();
            }
        }
    }

    #[test]
    fn another_extension_is_told() {
        let obj = Format::named("obj").unwrap();
        let error = Program::ALL[0].frame(Path::new("a.obj"), obj).unwrap_err().to_string();
        assert_eq!(error, "`a.obj` is not for unreal, which opens .abc");
    }
}
