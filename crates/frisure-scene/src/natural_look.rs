//! The colours of hair and skin that a hair type brings with it, a head, and whether it is cut.

use frisure_hairstyle::Preset;
use frisure_look::{HairLook, Shade, SkinLook, linear_from_srgb};

/// The look of one hair type; a scene overrides it with `look.colour`, `look.skin` and `head.model`.
///
/// ```
/// use frisure_hairstyle::preset;
/// use frisure_scene::NaturalLook;
///
/// let of = |name| NaturalLook::of(preset(name).expect("a preset"));
/// assert_eq!(of("asian-straight").colour.name, "black");
/// assert_ne!(of("african-coily").skin, of("caucasian-straight").skin);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NaturalLook {
    /// Colour of the hair.
    pub colour: &'static Shade,
    /// Diffuse reflectance of the skin, sRGB from 0 to 1.
    pub skin: [f64; 3],
    /// The built-in head of a scene that begins with the type ([`template`](crate::template)); without `head.model` it is the mannequin.
    pub model: &'static str,
    /// Whether the hair is worn cut ([`worn_template`](crate::worn_template)) to a soft line at the shoulders: hair of one length that hangs ends in a
    /// point at the back, as nobody wears it. Short coils stand.
    pub cut: bool,
    /// Whether it is held there better than usual out of the face ([`hold`](frisure_hairstyle::Implantation::hold)): curls that hang fall into it.
    pub pinned: bool,
}

/// Skins (sRGB) from light to dark. Chosen: lightness falls in steps of about 10 CIELAB units from L* = 65 to L* = 37, with
/// a* from 9 to 13 and b* from 15 to 19.
const LIGHT: [f64; 3] = rgb(0xbb, 0x96, 0x84);
const LIGHT_WARM: [f64; 3] = rgb(0xb8, 0x97, 0x82);
const MEDIUM: [f64; 3] = rgb(0xa3, 0x7b, 0x63);
const BROWN: [f64; 3] = rgb(0x8b, 0x64, 0x50);
const DARK: [f64; 3] = rgb(0x70, 0x50, 0x3f);

const fn rgb(red: u8, green: u8, blue: u8) -> [f64; 3] {
    [red as f64 / 255.0, green as f64 / 255.0, blue as f64 / 255.0]
}

/// Built-in heads on which new scenes begin.
const AFRICAN: &str = "african-woman";
const ASIAN: &str = "asian-man";
const EUROPEAN: &str = "european-woman";

/// Hair types that are worn uncut: they stand off the head. Chosen.
const UNCUT: [&str; 8] =
    ["african-coily", "african-kinky", "frizzy", "coily", "kinky", "type-6", "type-7", "type-8"];

/// Hair types that are pinned out of the face while they dry. Chosen.
const PINNED: [&str; 4] = ["caucasian-curly", "curly", "type-4", "type-5"];

/// Hair type, colour of the hair, skin, head. What is chosen and why: `docs/hair-types.md`, "Colour and skin".
const LOOKS: [(&str, &str, [f64; 3], &str); 21] = [
    ("asian-straight", "black", LIGHT_WARM, ASIAN),
    ("asian-wavy", "black", LIGHT_WARM, ASIAN),
    ("caucasian-straight", "dark-blond", LIGHT, EUROPEAN),
    ("caucasian-wavy", "light-brown", LIGHT, EUROPEAN),
    ("caucasian-curly", "brown", LIGHT, EUROPEAN),
    ("african-coily", "black", DARK, AFRICAN),
    ("african-kinky", "black", DARK, AFRICAN),
    ("straight", "brown", LIGHT, EUROPEAN),
    ("wavy", "brown", LIGHT, EUROPEAN),
    ("curly", "brown", LIGHT_WARM, EUROPEAN),
    ("frizzy", "dark-brown", MEDIUM, AFRICAN),
    ("coily", "black", BROWN, AFRICAN),
    ("kinky", "black", DARK, AFRICAN),
    ("type-1", "black", LIGHT_WARM, ASIAN),
    ("type-2", "dark-blond", LIGHT, EUROPEAN),
    ("type-3", "light-brown", LIGHT, EUROPEAN),
    ("type-4", "brown", LIGHT_WARM, EUROPEAN),
    ("type-5", "dark-brown", MEDIUM, EUROPEAN),
    ("type-6", "dark-brown", BROWN, AFRICAN),
    ("type-7", "black", BROWN, AFRICAN),
    ("type-8", "black", DARK, AFRICAN),
];

impl NaturalLook {
    /// The colours of a hair type.
    ///
    /// # Panics
    /// Never: a test asks for every preset.
    #[must_use]
    pub fn of(preset: &Preset) -> Self {
        let (_, colour, skin, model) =
            LOOKS.iter().find(|look| look.0 == preset.name).expect("each preset has a look");
        let colour = Shade::named(colour).expect("a shade of the list");
        let is_in = |names: &[&str]| names.contains(&preset.name);
        Self { colour, skin: *skin, model, cut: !is_in(&UNCUT), pinned: is_in(&PINNED) }
    }

    /// Hair of this colour.
    #[must_use]
    pub fn hair(&self) -> HairLook {
        HairLook {
            melanin: self.colour.melanin,
            white_share: self.colour.white_share,
            ..HairLook::default()
        }
    }

    /// Skin of this colour.
    #[must_use]
    pub fn skin(&self) -> SkinLook {
        // Eyes are dark where hair is; light hair goes with grey-blue ones more often than not. Chosen.
        let iris = match self.colour.melanin.eumelanin {
            dark if dark >= 0.7 => rgb(0x3f, 0x2a, 0x1b),
            medium if medium >= 0.3 => rgb(0x4d, 0x42, 0x2d),
            _ => rgb(0x4c, 0x5e, 0x70),
        };
        SkinLook {
            colour: linear_from_srgb(self.skin),
            iris: linear_from_srgb(iris),
            texture: 1.0,
            ..SkinLook::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frisure_hairstyle::PRESETS;

    #[test]
    fn every_hair_type_has_colours_and_no_other_name_has() {
        for preset in PRESETS {
            let look = NaturalLook::of(preset);
            assert!(look.hair().natural().is_finite() && look.skin().colour.min_element() > 0.0);
        }
        assert_eq!(LOOKS.len(), PRESETS.len());
        assert!(
            UNCUT
                .iter()
                .chain(&PINNED)
                .all(|name| PRESETS.iter().any(|preset| preset.name == *name))
        );
    }
}
