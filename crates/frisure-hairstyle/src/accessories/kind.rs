//! The kinds of accessories, and what each is made of.

use frisure_strands::AccessoryMaterial;

/// A kind of object that holds hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AccessoryKind {
    /// A roller that hair is wound on.
    Roller,
    /// A hair tie round gathered hair.
    Tie,
    /// A small elastic at the end of a braid or a twist.
    Elastic,
    /// A bobby pin over tucked hair.
    Pin,
    /// A bar clip.
    Clip,
}

// Colours are linear sRGB, gloss is in the unit of `look.gloss` (0.12 is skin, 0.04 of reflectance at normal incidence is 0.17), and
// roughness is the α of GGX. All are chosen: usual colours of such objects, that differ from hair of any colour.

/// Matt plastic, a pale rose as rollers often are.
const PLASTIC: AccessoryMaterial =
    AccessoryMaterial { name: "plastic", colour: [0.36, 0.17, 0.21], gloss: 0.08, roughness: 0.45 };

/// Cloth over rubber, dark red.
const CLOTH: AccessoryMaterial =
    AccessoryMaterial { name: "cloth", colour: [0.12, 0.012, 0.03], gloss: 0.02, roughness: 0.7 };

/// Dark rubber.
const RUBBER: AccessoryMaterial = AccessoryMaterial {
    name: "rubber",
    colour: [0.022, 0.017, 0.015],
    gloss: 0.06,
    roughness: 0.5,
};

/// Dark metal: little diffuse light, and much of its gloss.
const METAL: AccessoryMaterial =
    AccessoryMaterial { name: "metal", colour: [0.035, 0.033, 0.032], gloss: 0.6, roughness: 0.25 };

impl AccessoryKind {
    /// All kinds, in the order in which [`super::accessories`] lists them.
    pub const ALL: [Self; 5] = [Self::Roller, Self::Tie, Self::Elastic, Self::Pin, Self::Clip];

    /// Returns its name in files, in lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Roller => "roller",
            Self::Tie => "tie",
            Self::Elastic => "elastic",
            Self::Pin => "pin",
            Self::Clip => "clip",
        }
    }

    /// Returns what it is made of.
    #[must_use]
    pub const fn material(self) -> AccessoryMaterial {
        match self {
            Self::Roller => PLASTIC,
            Self::Tie => CLOTH,
            Self::Elastic => RUBBER,
            Self::Pin | Self::Clip => METAL,
        }
    }
}
