//! Reading `[look]`.

use frisure_look::{
    Backdrop, Dye, Fade, HairLook, LookSpec, Melanin, Scattering, SkinLook, absorption_of_colour,
    linear_from_srgb,
};
use glam::Vec3;

use crate::choice::OneOf;
use crate::document::Document;
use crate::error::Result;
use crate::keywords::{BackdropKind, Keyword, ShadeWord};
use crate::kind::{Colour, Vector};
use crate::natural_look::NaturalLook;

/// Distance over which the pigment of roots and tips fades, if the scene gives none (m).
const FADE: f32 = 0.05;

/// Materials, whose other fields are [numbers](Document::set_fields); `natural` has the colours of the hair type, and
/// `backdrop` is the default background.
pub(super) fn look(
    document: &Document<'_>,
    natural: &NaturalLook,
    seed: u64,
    backdrop: Backdrop,
) -> Result<LookSpec> {
    let colour = |key: &str| -> Result<Option<Vec3>> {
        Ok(document.get::<Colour>(key)?.map(linear_from_srgb))
    };
    let mut hair = HairLook {
        roots: fade(document, "look.roots"),
        tips: fade(document, "look.tips"),
        // The low bits of the seed are a seed, too.
        seed: seed as u32,
        ..natural.hair()
    };
    // One pigment by number is a colour of its own, not a change of the type's: the other is that of brown.
    if document.first(&["look.eumelanin", "look.pheomelanin"]).is_some() {
        (hair.melanin, hair.white_share) = (Melanin::default(), 0.0);
    }
    if let Some(ShadeWord(shade)) = document.get::<OneOf<ShadeWord>>("look.colour")? {
        (hair.melanin, hair.white_share) = (shade.melanin, shade.white_share);
    }
    let around = document.number("look.roughness_around").map(|roughness| roughness as f32);
    let around = around.unwrap_or(hair.surface.azimuthal_roughness);
    let absorption_of = |colour: Vec3| absorption_of_colour(colour, around);
    hair.absorption = match colour("look.reflectance")? {
        Some(colour) => Some(absorption_of(colour)),
        None => absorption(document)?,
    };
    let dye_colour = colour("look.dye.colour")?;
    if dye_colour.is_none()
        && let Some(key) = document.first(&["look.dye.strength", "look.dye.regrowth"])
    {
        return Err(document.missing(key, "colour"));
    }
    let number = |key: &str, default| document.number(key).unwrap_or(default) as f32;
    hair.dye = dye_colour.map(|colour| Dye {
        absorption: absorption_of(colour),
        strength: number("look.dye.strength", 1.0),
        regrowth: number("look.dye.regrowth", 0.0),
    });
    if let Some(Keyword(scattering)) =
        document.get::<OneOf<Keyword<Scattering>>>("look.scattering")?
    {
        hair.surface.scattering = scattering;
    }
    let skin = natural.skin();
    Ok(LookSpec {
        hair,
        skin: SkinLook {
            colour: colour("look.skin")?.unwrap_or(skin.colour),
            iris: colour("look.iris")?.unwrap_or(skin.iris),
            garment: colour("look.garment")?.unwrap_or(skin.garment),
            ..skin
        },
        backdrop: document.get_or::<BackdropKind>("look.background", backdrop)?,
        floor: colour("look.floor")?,
    })
}

fn absorption(document: &Document<'_>) -> Result<Option<Vec3>> {
    let path = "look.absorption";
    let Some(absorption) = document.get::<Vector>(path)? else { return Ok(None) };
    match absorption.to_array().iter().all(|a| (0.0..=1000.0).contains(a)) {
        true => Ok(Some(absorption.as_vec3())),
        false => Err(document.outside(path, "each between 0 and 1000")),
    }
}

/// The pigment at one end of the hairs.
fn fade(document: &Document<'_>, table: &str) -> Fade {
    let number = |key: &str| document.number(&format!("{table}.{key}")).map(|x| x as f32);
    match number("pigment") {
        Some(factor) => Fade { factor, length: number("fade").unwrap_or(FADE) },
        None => Fade::default(),
    }
}
