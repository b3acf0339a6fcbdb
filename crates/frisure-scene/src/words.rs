//! The words that keys of a scene can take.

use frisure_hairstyle::head::Region;
use frisure_hairstyle::{
    Comb, Ellipticity, HairModel, Handedness, Level, PRESETS, Parting, Place, Preset, Turn, Wetting,
};
use frisure_look::{Daylight, SHADES, Setup, Shade, ToneCurve};
use frisure_rod::{ElementKind, TorsionConstant};
use schemars::{Schema, json_schema};
use toml::Value;

use super::key::{Choice, Kind, Length, OneOf, Refusal, ToText};
use frisure_files::frame::UpAxis;

/// A hair type, by its name.
#[derive(Clone, Copy)]
pub(super) struct HairType(pub(super) &'static Preset);

impl Choice for HairType {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        PRESETS.iter().map(|p| (p.name, p.description, Self(p))).collect()
    }
}

/// A colour of natural hair, by its name.
#[derive(Clone, Copy)]
pub(super) struct ShadeWord(pub(super) &'static Shade);

impl Choice for ShadeWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        SHADES.iter().map(|shade| (shade.name, shade.description, Self(shade))).collect()
    }

    fn synonyms() -> &'static [(&'static str, &'static str)] {
        &[
            ("blonde", "blond"),
            ("fair", "blond"),
            ("golden", "blond"),
            ("light-blonde", "light-blond"),
            ("dark-blonde", "dark-blond"),
            ("gray", "grey"),
            ("silver", "grey"),
            ("pepper-and-salt", "salt-and-pepper"),
            ("chestnut", "brown"),
            ("brunette", "dark-brown"),
            ("ginger", "copper"),
            ("strawberry-blond", "copper"),
        ]
    }
}

/// A value that is itself one of a few: each word stands for it.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Which<T>(pub(super) T);

impl Choice for Which<UpAxis> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("y", "y up, the face looks along +z", Self(UpAxis::Y)),
            ("z", "z up, the face looks along -y", Self(UpAxis::Z)),
        ]
    }
}

impl Choice for ToneCurve {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("plain", "as it is, cut off at white", Self::Plain),
            ("shoulder", "as it is, and softly towards white", Self::Shoulder),
            ("filmic", "as a film, with a toe and a long shoulder", Self::Filmic),
        ]
    }
}

/// Metres per unit of a mesh.
#[derive(Clone, Copy)]
pub(super) struct UnitWord(pub(super) f64);

impl Choice for UnitWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("m", "metres", Self(1.0)),
            ("dm", "decimetres", Self(0.1)),
            ("cm", "centimetres", Self(0.01)),
            ("mm", "millimetres", Self(0.001)),
            ("in", "inches", Self(0.0254)),
        ]
    }
}

impl Choice for Which<Ellipticity> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("measured", "the measured axis ratio and its spread", Self(Ellipticity::Measured)),
            ("paper", "the paper's eccentricity, nearly a circle", Self(Ellipticity::Paper)),
        ]
    }
}

/// Which of a type's two answers to water is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WettingWord {
    Paper,
    Measured,
}

impl WettingWord {
    pub(super) fn of(self, hair: &frisure_hairstyle::HairType) -> Wetting {
        match self {
            Self::Paper => hair.paper_wetting,
            Self::Measured => hair.wetting,
        }
    }
}

impl Choice for Which<WettingWord> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("paper", "a fifth of the stiffness, as in the paper", Self(WettingWord::Paper)),
            ("measured", "as measured on such hair", Self(WettingWord::Measured)),
        ]
    }
}

/// Which equilibrium of one hair is asked for, where there are several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum BranchKind {
    /// The one that the natural shape comes to as gravity grows from nothing.
    #[default]
    Gravity,
    /// The one of lowest energy that several starting shapes lead to.
    Lowest,
}

impl Choice for Which<BranchKind> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            (
                "gravity",
                "followed from the natural shape as gravity grows",
                Self(BranchKind::Gravity),
            ),
            ("lowest", "the lowest energy that several starts lead to", Self(BranchKind::Lowest)),
        ]
    }
}

impl Choice for Which<TorsionConstant> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("saint-venant", "exact for an ellipse", Self(TorsionConstant::SaintVenant)),
            ("polar", "I1 + I2, as in the paper", Self(TorsionConstant::Polar)),
        ]
    }
}

impl Choice for Which<ElementKind> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("auto", "the better of the two for the hair", Self(ElementKind::Auto)),
            ("jointed", "two pieces of the natural helix and a joint", Self(ElementKind::Jointed)),
            ("helix", "constant strain, as in the paper", Self(ElementKind::Helix)),
        ]
    }
}

/// Which way curls turn.
#[derive(Clone, Copy)]
pub(super) struct Handed(pub(super) Handedness);

impl Choice for Handed {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("random", "each wisp as given or mirrored", Self(Handedness::Random)),
            ("as-given", "all as the strain says", Self(Handedness::AsGiven)),
        ]
    }
}

/// The direction in which hair leaves the scalp; the parting's place is a key of its own.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FlowWord {
    Whorl,
    Parted,
    SweptBack,
}

impl Choice for FlowWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("whorl", "as it grows, around the crown and over the forehead", Self::Whorl),
            ("parted", "to both sides of a parting", Self::Parted),
            ("swept-back", "back from the forehead", Self::SweptBack),
        ]
    }
}

/// Where a parting is: a word or a distance from the middle.
pub(super) struct PartingPlace;

/// A parting by a word of its own.
#[derive(Clone, Copy)]
struct PartingWord {
    offset: f64,
    zigzag: bool,
}

impl Choice for PartingWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        let straight = |offset| Self { offset, zigzag: false };
        vec![
            ("middle", "in the middle", straight(0.0)),
            ("left", "4 cm to the head's left", straight(0.04)),
            ("right", "4 cm to the head's right", straight(-0.04)),
            ("zigzag", "in the middle, in a zigzag", Self { offset: 0.0, zigzag: true }),
        ]
    }
}

impl Kind for PartingPlace {
    type Value = Parting;

    fn read(value: &Value) -> Result<Parting, Refusal> {
        let is_length = match value {
            Value::String(text) => !text.trim_start().starts_with(char::is_alphabetic),
            _ => true,
        };
        if is_length {
            return Length::read(value).map(|offset| Parting::Straight { offset });
        }
        let PartingWord { offset, zigzag } = OneOf::<PartingWord>::read(value)?;
        Ok(if zigzag { Parting::Zigzag { offset } } else { Parting::Straight { offset } })
    }

    fn schema() -> Schema {
        json_schema!({ "anyOf": [OneOf::<PartingWord>::schema(), Length::schema()] })
    }
}

impl ToText for PartingPlace {
    fn text(parting: &Parting) -> String {
        match parting {
            Parting::Straight { offset } if offset.to_bits() == 0 => "\"middle\"".into(),
            Parting::Straight { offset } => Length::text(offset),
            // The one zigzag that has a word.
            Parting::Zigzag { .. } | Parting::Through(_) => "\"zigzag\"".into(),
        }
    }
}

impl Choice for Place {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        let region = Self::Region;
        vec![
            ("fringe", "behind the forehead's hairline", region(Region::Fringe)),
            ("top", "between fringe and crown", region(Region::Top)),
            ("crown", "around the whorl", region(Region::Crown)),
            ("sides", "temples and above the ears", region(Region::Sides)),
            ("back", "the back of the head", region(Region::Back)),
            ("nape", "below the occiput", region(Region::Nape)),
            ("left-side", "the left of the sides", Self::LeftOf(Region::Sides)),
            ("right-side", "the right of the sides", Self::RightOf(Region::Sides)),
            ("left-fringe", "the left of the fringe", Self::LeftOf(Region::Fringe)),
            ("right-fringe", "the right of the fringe", Self::RightOf(Region::Fringe)),
            ("left", "the head's left half", Self::Left),
            ("right", "the head's right half", Self::Right),
            ("all", "the whole scalp", Self::Everywhere),
        ]
    }

    fn synonyms() -> &'static [(&'static str, &'static str)] {
        &[
            ("bangs", "fringe"),
            ("forehead", "fringe"),
            ("front", "fringe"),
            ("hairline", "fringe"),
            ("neck", "nape"),
            ("neckline", "nape"),
            ("ears", "sides"),
            ("temples", "sides"),
            ("whorl", "crown"),
            ("vertex", "crown"),
            ("occiput", "back"),
            ("head", "all"),
            ("scalp", "all"),
            ("everywhere", "all"),
        ]
    }
}

/// Parts of the scalp: one word, or a list.
pub(super) struct Places;

impl Kind for Places {
    type Value = Vec<Place>;

    fn read(value: &Value) -> Result<Vec<Place>, Refusal> {
        match value {
            Value::Array(list) => list.iter().map(OneOf::<Place>::read).collect(),
            one => OneOf::<Place>::read(one).map(|place| vec![place]),
        }
    }

    fn schema() -> Schema {
        let word = OneOf::<Place>::schema();
        json_schema!({ "anyOf": [word, { "type": "array", "items": word, "minItems": 1 }] })
    }
}

impl Choice for Which<Level> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("brows", "the brows", Self(Level::Brows)),
            ("eyes", "the eyes", Self(Level::Eyes)),
            ("ears", "the middle of the ears", Self(Level::Ears)),
            ("chin", "the chin", Self(Level::Chin)),
            ("nape", "the lowest hair in the neck", Self(Level::Nape)),
        ]
    }

    fn synonyms() -> &'static [(&'static str, &'static str)] {
        &[("eyebrows", "brows"), ("eyebrow", "brows"), ("jaw", "chin"), ("neck", "nape")]
    }
}

impl Choice for Which<Comb> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("forward", "over the head to the face", Self(Comb::Forward)),
            ("back", "over the head to the neck", Self(Comb::Back)),
            ("down", "down", Self(Comb::Down)),
            ("left", "to the head's left, and down", Self(Comb::Left)),
            ("right", "to the head's right, and down", Self(Comb::Right)),
        ]
    }
}

impl Choice for Which<Turn> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            ("clockwise", "as in most people", Self(Turn::Clockwise)),
            ("anticlockwise", "the other way", Self(Turn::Anticlockwise)),
        ]
    }
}

/// What a wisp makes of the others.
#[derive(Clone, Copy)]
pub(super) struct HairContactWord(pub(super) frisure_hairstyle::HairContact);

impl Choice for HairContactWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        use frisure_hairstyle::HairContact;
        vec![
            ("none", "wisps pass through each other", Self(HairContact::None)),
            (
                "layers",
                "a bed of hair by the altitude of the root, as in the paper",
                Self(HairContact::Layers),
            ),
            ("wisps", "wisps repel each other where they overlap", Self(HairContact::Wisps)),
        ]
    }
}

/// What hair lies on.
#[derive(Clone, Copy)]
pub(super) struct BodyWord(pub(super) frisure_hairstyle::Body);

impl Choice for BodyWord {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        use frisure_hairstyle::Body;
        vec![
            ("none", "hair passes through the head", Self(Body::None)),
            ("spheres", "spheres fitted to the head, as in the paper", Self(Body::Spheres)),
            ("signed-distance", "the mesh itself", Self(Body::SignedDistance)),
        ]
    }
}

impl Choice for Which<HairModel> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            (
                "interpolated",
                "hairs that go with the guides around them",
                Self(HairModel::Interpolated),
            ),
            (
                "simulated",
                "each a rod with a fibre of its own, at rest on the skin and between its neighbours",
                Self(HairModel::Simulated),
            ),
        ]
    }
}

impl Choice for Which<Setup> {
    fn words() -> Vec<(&'static str, &'static str, Self)> {
        vec![
            (
                "studio",
                "a main lamp high at the left, a weak one at the right, one behind, a soft room",
                Self(Setup::Studio),
            ),
            ("soft", "large soft lamps in a bright room: colour more than form", Self(Setup::Soft)),
            (
                "butterfly",
                "one lamp before the face and above it: symmetrical, glossy",
                Self(Setup::Butterfly),
            ),
            (
                "rembrandt",
                "one lamp at the side in a dark room: half of the hair in shadow",
                Self(Setup::Rembrandt),
            ),
            ("rim", "two lamps behind: a bright edge, light through the hair", Self(Setup::Rim)),
            (
                "daylight",
                "sun and clear sky over pale ground",
                Self(Setup::Daylight(Daylight::default())),
            ),
            ("overcast", "a sky full of clouds", Self(Setup::Overcast)),
            ("dark", "no light but what else is given", Self(Setup::Dark)),
        ]
    }

    fn synonyms() -> &'static [(&'static str, &'static str)] {
        &[
            ("beauty", "butterfly"),
            ("paramount", "butterfly"),
            ("back", "rim"),
            ("backlight", "rim"),
            ("sun", "daylight"),
            ("sky", "daylight"),
            ("outdoor", "daylight"),
            ("cloudy", "overcast"),
            ("none", "dark"),
            ("black", "dark"),
        ]
    }
}
