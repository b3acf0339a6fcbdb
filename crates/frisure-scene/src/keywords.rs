//! The keywords of scene keys.

use frisure_files::frame::UpAxis;
use frisure_hairstyle::head::{Head, Region};
use frisure_hairstyle::{
    Body, Comb, Ellipticity, HairContact, HairModel, Handedness, HeadMethod, Level, PRESETS,
    Parting, Place, Preset, StrandContact, Turn, WetLocks, Wetting,
};
use frisure_look::{
    Backdrop, Daylight, SHADES, Scattering, Setup, Shade, ToneCurve, linear_from_srgb,
};
use frisure_rod::{ElementKind, TorsionConstant};
use schemars::{Schema, json_schema};
use toml::Value;

use crate::choice::{Choice, OneOf};
use crate::error::ValueError;
use crate::kind::{Colour, Kind, Length, ToText};
use crate::similar::nearest;

/// Declares sets of keywords: each keyword with its synonyms, its value, what it means, and its title where programs display another.
macro_rules! keywords {
    ($($Type:ty {
        $($word:literal $(| $synonym:literal)* => $value:expr, $meaning:literal $(, title $title:literal)?;)*
    })*) => {$(
        impl Choice for $Type {
            fn keywords() -> Vec<(&'static str, &'static str, Self)> {
                vec![$(($word, $meaning, $value)),*]
            }

            fn synonyms() -> &'static [(&'static str, &'static str)] {
                &[$($(($synonym, $word),)*)*]
            }

            fn titles() -> &'static [(&'static str, &'static str)] {
                &[$($(($word, $title),)?)*]
            }
        }
    )*};
}

pub(crate) use keywords;

/// The levels of a head that cuts are named by, from the brows down, with their names in scenes.
pub fn levels() -> impl Iterator<Item = (&'static str, Level)> {
    Keyword::<Level>::keywords().into_iter().map(|(name, _, Keyword(level))| (name, level))
}

/// A hair type, by its name.
#[derive(Clone, Copy)]
pub(crate) struct HairType(pub(crate) &'static Preset);

impl Choice for HairType {
    fn keywords() -> Vec<(&'static str, &'static str, Self)> {
        PRESETS.iter().map(|p| (p.name, p.description, Self(p))).collect()
    }
}

/// A colour of natural hair, by its name.
#[derive(Clone, Copy)]
pub(crate) struct ShadeWord(pub(crate) &'static Shade);

impl Choice for ShadeWord {
    fn keywords() -> Vec<(&'static str, &'static str, Self)> {
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

/// Name of the head that a scene has, if it names none.
pub(crate) const MANNEQUIN: &str = "mannequin";

/// The name of a built-in head.
#[derive(Clone, Copy)]
pub(crate) struct ModelWord(pub(crate) &'static str);

impl Choice for ModelWord {
    fn keywords() -> Vec<(&'static str, &'static str, Self)> {
        let about = |name: &str| match name {
            MANNEQUIN => "a training head with closed eyes",
            _ => "a person with open eyes and a garment",
        };
        Head::names().map(|name| (name, about(name), Self(name))).collect()
    }
}

/// A value that keywords stand for.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Keyword<T>(pub(crate) T);

keywords! {
    Keyword<UpAxis> {
        "y" => Self(UpAxis::Y), "y up, the face looks along +z", title "y, the face along z";
        "z" => Self(UpAxis::Z), "z up, the face looks along -y", title "z, the face against y";
    }

    ToneCurve {
        "plain" => Self::Plain, "as it is, cut off at white";
        "shoulder" => Self::Shoulder, "as it is, and softly towards white";
        "filmic" => Self::Filmic, "as a film, with a toe and a long shoulder";
    }
}

/// Metres per unit of a mesh.
#[derive(Clone, Copy)]
pub(crate) struct UnitWord(pub(crate) f64);

keywords! {
    UnitWord {
        "m" => Self(1.0), "metres", title "Metres";
        "dm" => Self(0.1), "decimetres", title "Decimetres";
        "cm" => Self(0.01), "centimetres", title "Centimetres";
        "mm" => Self(0.001), "millimetres", title "Millimetres";
        "in" => Self(0.0254), "inches", title "Inches";
    }

    Keyword<Ellipticity> {
        "measured" => Self(Ellipticity::Measured), "the measured axis ratio and its spread";
        "paper" => Self(Ellipticity::Paper), "the paper's eccentricity, nearly a circle";
    }
}

/// What water makes of the fibres of a hair type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WettingWord {
    Paper,
    Measured,
    Capillary,
}

impl WettingWord {
    pub(crate) fn of(self, hair: &frisure_hairstyle::HairType) -> Wetting {
        match self {
            Self::Paper => hair.paper_wetting,
            Self::Measured => hair.wetting,
            Self::Capillary => Wetting { locks: WetLocks::Capillary, ..hair.wetting },
        }
    }
}

keywords! {
    WettingWord {
        "paper" => Self::Paper, "a fifth of the stiffness, as in the paper", title "As in the paper";
        "measured" => Self::Measured, "as measured on such hair", title "As measured";
        "capillary" => Self::Capillary, "as measured, and hairs gather into locks by surface tension", title "Locks by capillarity";
    }
}

/// Where coefficients of friction come from that a scene does not give.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FrictionWord {
    Free,
    Measured,
}

keywords! {
    FrictionWord {
        "free" => Self::Free, "hair slides freely", title "None";
        "measured" => Self::Measured, "as measured on hair of this type, and on skin as much", title "As measured";
    }
}

/// An equilibrium of one hair, where there are several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum BranchKind {
    /// The one that is followed from the natural shape as gravity grows from 0.
    #[default]
    Gravity,
    /// The one of lowest energy among those that several starting shapes lead to.
    Lowest,
}

keywords! {
    BranchKind {
        "gravity" => Self::Gravity, "followed from the natural shape as gravity grows";
        "lowest" => Self::Lowest, "the lowest energy that several starts lead to";
    }

    Keyword<TorsionConstant> {
        "saint-venant" => Self(TorsionConstant::SaintVenant), "exact for an ellipse";
        "polar" => Self(TorsionConstant::Polar), "I1 + I2, as in the paper";
    }

    Keyword<ElementKind> {
        "auto" => Self(ElementKind::Auto), "the better of the two for the hair";
        "jointed" => Self(ElementKind::Jointed), "two pieces of the natural helix and a joint";
        "helix" => Self(ElementKind::Helix), "constant strain, as in the paper";
    }

    Keyword<Handedness> {
        "random" => Self(Handedness::Random), "each wisp as given or mirrored";
        "as-given" => Self(Handedness::AsGiven), "all as the strain says";
    }
}

/// The direction in which hair leaves the scalp; the parting's place is a key of its own.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum FlowWord {
    Whorl,
    Parted,
    SweptBack,
}

keywords! {
    FlowWord {
        "whorl" => Self::Whorl, "as it grows, around the crown and over the forehead", title "As it grows";
        "parted" => Self::Parted, "to both sides of a parting";
        "swept-back" => Self::SweptBack, "back from the forehead";
    }
}

/// Where a parting is: a word or a distance from the middle.
pub(crate) struct PartingPlace;

/// A parting by a word of its own.
#[derive(Clone, Copy)]
struct PartingWord {
    offset: f64,
    zigzag: bool,
}

keywords! {
    PartingWord {
        "middle" => Self { offset: 0.0, zigzag: false }, "in the middle", title "In the middle";
        "left" => Self { offset: 0.04, zigzag: false }, "4 cm to the head's left", title "On the left";
        "right" => Self { offset: -0.04, zigzag: false }, "4 cm to the head's right", title "On the right";
        "zigzag" => Self { offset: 0.0, zigzag: true }, "in the middle, in a zigzag";
    }
}

impl Kind for PartingPlace {
    type Value = Parting;

    fn read(value: &Value) -> Result<Parting, ValueError> {
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

keywords! {
    Place {
        "fringe" | "bangs" | "forehead" | "front" | "hairline" => Self::Region(Region::Fringe),
            "behind the forehead's hairline";
        "top" => Self::Region(Region::Top), "between fringe and crown";
        "crown" | "whorl" | "vertex" => Self::Region(Region::Crown), "around the whorl";
        "sides" | "ears" | "temples" => Self::Region(Region::Sides), "temples and above the ears";
        "back" | "occiput" => Self::Region(Region::Back), "the back of the head";
        "nape" | "neck" | "neckline" => Self::Region(Region::Nape), "below the occiput";
        "left-side" => Self::LeftOf(Region::Sides), "the left of the sides";
        "right-side" => Self::RightOf(Region::Sides), "the right of the sides";
        "left-fringe" => Self::LeftOf(Region::Fringe), "the left of the fringe";
        "right-fringe" => Self::RightOf(Region::Fringe), "the right of the fringe";
        "left" => Self::Left, "the head's left half";
        "right" => Self::Right, "the head's right half";
        "all" | "head" | "scalp" | "everywhere" => Self::Everywhere, "the whole scalp";
    }
}

/// Parts of the scalp: one word, or a list.
pub(crate) struct Places;

/// Most parts of the scalp of a region. Chosen: several times as many as there are.
const MOST_PLACES: usize = 100;

impl Kind for Places {
    type Value = Vec<Place>;

    fn read(value: &Value) -> Result<Vec<Place>, ValueError> {
        match value {
            Value::Array(list) if list.len() > MOST_PLACES => {
                let problem = format!("{} parts; there are at most {MOST_PLACES}", list.len());
                Err(ValueError::because(problem).hint("name each part once"))
            }
            Value::Array(list) => list.iter().map(OneOf::<Place>::read).collect(),
            one => OneOf::<Place>::read(one).map(|place| vec![place]),
        }
    }

    fn schema() -> Schema {
        let word = OneOf::<Place>::schema();
        let list = json_schema!({
            "type": "array", "items": word, "minItems": 1, "maxItems": MOST_PLACES,
        });
        json_schema!({ "anyOf": [word, list] })
    }
}

keywords! {
    Keyword<Level> {
        "brows" | "eyebrows" | "eyebrow" => Self(Level::Brows), "the brows";
        "eyes" => Self(Level::Eyes), "the eyes";
        "ears" => Self(Level::Ears), "the middle of the ears";
        "chin" | "jaw" => Self(Level::Chin), "the chin";
        "nape" | "neck" => Self(Level::Nape), "the lowest hair in the neck";
        "shoulders" | "shoulder" => Self(Level::Shoulders), "the shoulders, where the neck meets them";
        "chest" | "armpits" => Self(Level::Chest), "the chest, as high as the armpits";
    }

    Keyword<Comb> {
        "forward" => Self(Comb::Forward), "over the head to the face";
        "back" => Self(Comb::Back), "over the head to the neck";
        "down" => Self(Comb::Down), "down";
        "left" => Self(Comb::Left), "to the head's left, and down";
        "right" => Self(Comb::Right), "to the head's right, and down";
    }

    Keyword<Turn> {
        "clockwise" => Self(Turn::Clockwise), "as in most people";
        "anticlockwise" => Self(Turn::Anticlockwise), "the other way";
    }

    Keyword<HairContact> {
        "none" => Self(HairContact::None), "wisps pass through each other";
        "layers" => Self(HairContact::Layers), "a bed of the hair that is rooted on the way, after the paper's envelopes";
        "wisps" => Self(HairContact::Wisps), "wisps repel each other where they overlap";
        "density" => Self(HairContact::Density), "a bed of hair as with layers, and wisps press on each other where together they take more room than there is";
    }

    Keyword<HeadMethod> {
        "sweeps" => Self(HeadMethod::Sweeps), "one after the other, to `tolerance`: fast, but a small change of the scene can move wisps by centimetres";
        "continuation" => Self(HeadMethod::Continuation), "all together while their hardness grows: several times slower, with a certificate of the whole head, and a small change of the scene mostly moves wisps little";
    }

    Keyword<Body> {
        "none" => Self(Body::None), "hair passes through the head";
        "spheres" => Self(Body::Spheres), "spheres fitted to the head, as in the paper";
        "signed-distance" => Self(Body::SignedDistance), "the mesh itself";
    }

    Keyword<HairModel> {
        "interpolated" => Self(HairModel::Interpolated), "hairs that go with the guides around them";
        "simulated" => Self(HairModel::Simulated),
            "each a rod with a fibre of its own, at rest on the skin and between its neighbours";
    }

    Keyword<StrandContact> {
        "tube" => Self(StrandContact::Tube), "each hair in a tube that its neighbours leave it, without pushing them";
        "contacts" => Self(StrandContact::Contacts), "each hair pushes and rubs the hairs that it touches: slower, and with a certificate of all hairs together";
        "density" => Self(StrandContact::Density), "all hairs are a volume that presses where it is denser than hair packs, without friction between them; with the same certificate";
    }

    Keyword<Setup> {
        "studio" => Self(Setup::Studio),
            "a main lamp high at the left, a weak one at the right, one behind, a soft room";
        "soft" => Self(Setup::Soft), "large soft lamps in a bright room: colour more than form";
        "butterfly" | "beauty" | "paramount" => Self(Setup::Butterfly),
            "one lamp before the face and above it: symmetrical, glossy";
        "rembrandt" => Self(Setup::Rembrandt), "one lamp at the side in a dark room: half of the hair in shadow";
        "rim" | "back" | "backlight" => Self(Setup::Rim), "two lamps behind: a bright edge, light through the hair";
        "daylight" | "sun" | "sky" | "outdoor" => Self(Setup::Daylight(Daylight::default())),
            "sun and clear sky over pale ground";
        "overcast" | "cloudy" => Self(Setup::Overcast), "a sky full of clouds";
        "dark" | "none" | "black" => Self(Setup::Dark), "no light but what else is given", title "Dark room";
    }

    Keyword<Scattering> {
        "chiang" => Self(Scattering::Chiang), "Chiang et al. 2016 with the elliptical section, which scatters no more light than there is";
        "marschner" => Self(Scattering::Marschner), "Marschner et al. 2003, to compare with: a tenth more or less light than falls in, and slower";
    }

    Keyword<Backdrop> {
        "wall" => Self(Backdrop::Wall), "a grey wall that the lights fall on";
        "transparent" => Self(Backdrop::Transparent), "nothing: the picture can be laid over another";
        "surroundings" => Self(Backdrop::Environment), "the room, the sky or the environment that light it";
    }
}

/// What is behind the head: a keyword, or a colour.
pub(crate) struct BackdropKind;

impl Kind for BackdropKind {
    type Value = Backdrop;

    fn read(value: &Value) -> Result<Backdrop, ValueError> {
        if let Ok(Keyword(backdrop)) = OneOf::<Keyword<Backdrop>>::read(value) {
            return Ok(backdrop);
        }
        Colour::read(value).map(|colour| Backdrop::Colour(linear_from_srgb(colour))).map_err(|_| {
            let words: Vec<_> = Keyword::<Backdrop>::keywords().iter().map(|word| word.0).collect();
            let allowed = format!("\"{}\", or a colour such as \"#d8b49c\"", words.join("\", \""));
            let near = value.as_str().and_then(|word| nearest(word, words));
            let hint = near.map(|near| format!("did you mean \"{near}\"?"));
            ValueError::new(allowed).hint(hint.unwrap_or_default())
        })
    }

    fn schema() -> Schema {
        json_schema!({ "anyOf": [OneOf::<Keyword<Backdrop>>::schema(), Colour::schema()] })
    }
}
