//! Reading `[head]` and `[groom]`.

use std::path::Path;

use frisure_files::frame::FrameChoice;
use frisure_files::head::{HeadFile, ScalpSource};
use glam::DVec3;

use crate::choice::OneOf;
use crate::document::Document;
use crate::error::Result;
use crate::key_groups::{GROOM, HEAD};
use crate::keywords::{Keyword, ModelWord, UnitWord};
use crate::kind::{Point, Text, Vector};
use crate::placement::Placement;
use crate::scene::{GroomFile, HeadSource};

/// The head; paths are relative to `folder`.
pub(super) fn head(document: &Document<'_>, folder: &Path) -> Result<HeadSource> {
    let Some(mesh) = document.get::<Text>(HEAD[0])? else {
        return match document.first(&HEAD[1..]) {
            None => built_in(document),
            Some(key) => {
                let problem = format!("`{key}` is about a mesh, and the scene has none");
                Err(document.error(key, problem, "add `mesh = \"head.obj\"` to `[head]`"))
            }
        };
    };
    let scale = document.number("head.scale");
    if scale.is_some_and(|scale| scale <= 0.0) {
        return Err(document.outside("head.scale", "greater than zero (metres per unit)"));
    }
    let text = |key: &str| document.get::<Text>(key);
    let scalp = if let Some(group) = text("head.scalp_group")? {
        ScalpSource::Group(group)
    } else if let Some(name) = text("head.scalp_colour")? {
        ScalpSource::Colour(name)
    } else if let Some(mask) = text("head.scalp_mask")? {
        ScalpSource::Mask(folder.join(mask))
    } else if let Some(weights) = text("head.scalp_weights")? {
        ScalpSource::Weights(folder.join(weights))
    } else {
        ScalpSource::Guess
    };
    let frame = frame(document, "head")?;
    let frame = FrameChoice { metres: scale.or(frame.metres), ..frame };
    let turn = turn(document, "head.turn")?;
    Ok(HeadSource::Mesh(HeadFile { path: folder.join(mesh), frame, turn, scalp }))
}

/// Unit and axes of a file, where its table gives them.
fn frame(document: &Document<'_>, table: &str) -> Result<FrameChoice> {
    let unit = document.get::<OneOf<UnitWord>>(&format!("{table}.unit"))?;
    let up = document.get::<OneOf<Keyword<_>>>(&format!("{table}.up"))?;
    Ok(FrameChoice {
        metres: unit.map(|unit| unit.0),
        up: up.map(|Keyword(up)| up),
        ..FrameChoice::default()
    })
}

/// The groom, if there is one; its path is relative to `folder`.
pub(super) fn groom(document: &Document<'_>, folder: &Path) -> Result<Option<GroomFile>> {
    let Some(path) = document.get::<Text>(GROOM[0])? else {
        return match document.first(&GROOM[1..]) {
            None => Ok(None),
            Some(key) => {
                let problem = format!("`{key}` is about a groom, and the scene has none");
                Err(document.error(key, problem, "add `file = \"hair.usd\"` to `[groom]`"))
            }
        };
    };
    let frame = frame(document, "groom")?;
    let placement = placement(document)?;
    let head = groom_head(document, folder)?;
    let mut groom = GroomFile { frame, head, placement, ..GroomFile::new(folder.join(path)) };
    if let Some(guides) = document.number("groom.guides") {
        groom.guides = guides as usize;
    }
    Ok(Some(groom))
}

/// The head that a groom was made on, where the scene gives one.
fn groom_head(document: &Document<'_>, folder: &Path) -> Result<Option<HeadSource>> {
    if let Some(mesh) = document.get::<Text>("groom.head_mesh")? {
        return Ok(Some(HeadSource::Mesh(HeadFile::new(folder.join(mesh)))));
    }
    model(document, "groom.head_model")
}

/// The built-in head of the scene.
fn built_in(document: &Document<'_>) -> Result<HeadSource> {
    let mut head = model(document, "head.model")?.unwrap_or(HeadSource::Mannequin);
    let seed = document.number("head.face").unwrap_or(0.0) as u32;
    match &mut head {
        HeadSource::Person { face, .. } => *face = seed,
        _ if seed == 0 => {}
        _ => {
            let problem = "the mannequin has one face";
            let hint =
                "name a person in `head.model`, such as \"european-woman\", or leave `face` out";
            return Err(document.error("head.face", problem, hint));
        }
    }
    Ok(head)
}

/// The built-in head that a key names.
fn model(document: &Document<'_>, key: &str) -> Result<Option<HeadSource>> {
    let word = document.get::<OneOf<ModelWord>>(key)?;
    Ok(word.and_then(|ModelWord(name)| HeadSource::built_in(name)))
}

/// Largest displacement of a groom along an axis (m). Chosen: what is farther away has lost the precision of a hair.
const FARTHEST: f64 = 1000.0;

/// Where the groom lies on the head.
fn placement(document: &Document<'_>) -> Result<Placement> {
    let scale = document.number("groom.scale").unwrap_or(1.0);
    let turn = turn(document, "groom.turn")?.unwrap_or_default();
    let shift = document.get::<Point>("groom.move")?.unwrap_or_default();
    if shift.abs().max_element() > FARTHEST {
        return Err(document.outside("groom.move", "three lengths of at most 1 km"));
    }
    Ok(Placement { scale, turn, shift })
}

/// Turns about x, y and z (rad), which a scene gives in degrees.
fn turn(document: &Document<'_>, key: &str) -> Result<Option<DVec3>> {
    let Some(turn) = document.get::<Vector>(key)? else { return Ok(None) };
    match turn.abs().max_element() <= 360.0 {
        true => Ok(Some(turn.map(f64::to_radians))),
        false => Err(document.outside(key, "three angles between -360 and 360 degrees")),
    }
}
