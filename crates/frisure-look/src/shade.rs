//! Named colours of natural hair.
//!
//! The scale of eumelanin is that of d'Eon et al. 2011, for which `pbrt-v3` prints 0.3 blond, 1.3
//! brown and 8 black. The numbers here were chosen by eye, as a colourist would name them, on a head of
//! 125 000 straight hairs in the traced studio (`docs/pictures/colours.jpg`). There light meets many hairs
//! on its way, so that 0.3 is already a light brown, 1.3 a dark brown, and blonds have a tenth. For the
//! same reason pheomelanin of 1.7 is auburn rather than red. Hair of every colour but red has little
//! pheomelanin, or blond would be orange; it is left out where eumelanin hides it.

use crate::pigment::Melanin;

/// A colour that natural hair has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shade {
    /// Its name in scenes.
    pub name: &'static str,
    /// A description in a few words.
    pub description: &'static str,
    /// Its pigments.
    pub melanin: Melanin,
    /// Share of the hairs that have none of them.
    pub white_share: f32,
}

const fn shade(
    name: &'static str,
    description: &'static str,
    eumelanin: f32,
    pheomelanin: f32,
) -> Shade {
    Shade { name, description, melanin: Melanin { eumelanin, pheomelanin }, white_share: 0.0 }
}

const fn grey(name: &'static str, description: &'static str, white_share: f32) -> Shade {
    Shade { white_share, ..shade(name, description, 3.0, 0.0) }
}

/// The colours that have names: the scale from light to dark, then the reds, and hair of which a part is white.
pub const SHADES: [Shade; 15] = [
    shade("white", "no pigment", 0.0, 0.0),
    shade("platinum", "the lightest blond", 0.01, 0.004),
    shade("light-blond", "", 0.045, 0.015),
    shade("blond", "", 0.09, 0.03),
    shade("dark-blond", "", 0.18, 0.05),
    shade("light-brown", "", 0.36, 0.08),
    shade("brown", "", 0.8, 0.0),
    shade("dark-brown", "", 1.3, 0.0),
    shade("black", "brown where light comes through", 3.0, 0.0),
    shade("jet-black", "the darkest", 9.0, 0.0),
    shade("copper", "light red", 0.03, 0.7),
    shade("red", "", 0.08, 1.1),
    shade("auburn", "dark red", 0.35, 1.6),
    grey("grey", "dark hair of which three quarters are white", 0.75),
    grey("salt-and-pepper", "dark hair of which two fifths are white", 0.4),
];

impl Shade {
    /// The colour of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        SHADES.iter().find(|shade| shade.name == name)
    }
}
