//! The cards of the gallery: hair types and hairstyles.

use std::borrow::Cow;

use frisure::hairstyle::{PRESETS, preset};
use frisure::scene::NaturalLook;

use crate::locale;

/// A card of the gallery.
#[derive(Clone, Copy, Debug)]
pub struct Card {
    title: &'static str,
    /// The name of the hair type or of the scene.
    pub name: &'static str,
    description: &'static str,
    /// Its picture (JPEG).
    pub picture: &'static [u8],
    /// Its scene; empty for a hair type, whose scene is one line.
    scene: &'static str,
}

macro_rules! card {
    (type $name:literal, $title:literal) => {
        Card {
            title: $title,
            name: $name,
            description: "",
            picture: include_bytes!(concat!("../../gallery/", $name, ".jpg")),
            scene: "",
        }
    };
    (scene $name:literal, $title:literal, $description:literal) => {
        Card {
            title: $title,
            name: $name,
            description: $description,
            picture: include_bytes!(concat!("../../gallery/scene-", $name, ".jpg")),
            scene: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/", $name, ".toml")),
        }
    };
}

/// Hair types.
pub const TYPES: &[Card] = &[
    card!(type "straight", "Straight"),
    card!(type "wavy", "Wavy"),
    card!(type "curly", "Curly"),
    card!(type "coily", "Coily"),
    card!(type "frizzy", "Frizzy"),
    card!(type "asian-straight", "Asian, straight"),
    card!(type "asian-wavy", "Asian, wavy"),
    card!(type "caucasian-straight", "Caucasian, straight"),
    card!(type "caucasian-wavy", "Caucasian, wavy"),
    card!(type "caucasian-curly", "Caucasian, curly"),
    card!(type "african-coily", "African, coily"),
    card!(type "african-kinky", "African, kinky"),
    card!(type "kinky", "Kinky"),
    card!(type "type-1", "Type I"),
    card!(type "type-2", "Type II"),
    card!(type "type-3", "Type III"),
    card!(type "type-4", "Type IV"),
    card!(type "type-5", "Type V"),
    card!(type "type-6", "Type VI"),
    card!(type "type-7", "Type VII"),
    card!(type "type-8", "Type VIII"),
];

/// Hairstyles.
pub const SCENES: &[Card] = &[
    card!(scene "bob", "Bob", "cut to one length"),
    card!(scene "fringe", "Fringe", "long, with a fringe"),
    card!(scene "ringlets", "Ringlets", "long curls of one radius"),
    card!(scene "long-straight", "Long", "down the back"),
    card!(scene "afro", "Afro", "kinky hair that stands up"),
    card!(scene "short-asian", "Short", "short, and stands up"),
    card!(scene "parting", "Parting", "parted at the side"),
    card!(scene "rollers", "Rollers", "set on rollers and dried"),
];

/// The card with a name.
#[must_use]
pub fn card(name: &str) -> Option<&'static Card> {
    TYPES.iter().chain(SCENES).find(|card| card.name == name)
}

impl Card {
    /// The text of its scene.
    #[must_use]
    pub fn text(&self) -> String {
        match self.scene {
            "" => self.begun(),
            text => text.to_owned(),
        }
    }

    /// A scene of a hair type, on the head that goes with it.
    fn begun(&self) -> String {
        let (name, title) = (self.name, self.title());
        let model = preset(name).map_or("mannequin", |preset| NaturalLook::of(preset).model);
        format!("name = \"{title}\"\n\n[head]\nmodel = \"{model}\"\n\n[hair]\ntype = \"{name}\"\n")
    }

    /// Its title.
    #[must_use]
    pub fn title(&self) -> Cow<'static, str> {
        locale::named("card", self.name, self.title)
    }

    /// A short description.
    #[must_use]
    pub fn about(&self) -> Cow<'static, str> {
        let preset = PRESETS.iter().find(|p| p.name == self.name && self.scene.is_empty());
        let english = preset.map_or(self.description, |p| p.description);
        locale::named("card", &format!("{}#about", self.name), english)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frisure::scene::{HeadSource, Scene};
    use std::path::Path;

    #[test]
    fn every_card_is_a_valid_scene_and_every_hair_type_has_a_card() {
        for card in TYPES.iter().chain(SCENES) {
            let scene = Scene::parse(card.name, card.text(), Path::new("")).unwrap();
            assert!(scene.hairstyle_spec().is_ok(), "{}", card.name);
            assert!(!matches!(scene.head, HeadSource::Mesh(_)), "{} needs no file", card.name);
            assert!(!card.about().is_empty(), "{}", card.name);
        }
        let carded = |name: &str| TYPES.iter().any(|card| card.name == name);
        for preset in PRESETS {
            assert!(carded(preset.name), "{} has no card", preset.name);
        }
    }
}
