//! Constants of the preview's shading that the interactive view shares. Those without a source were chosen by eye
//! against traced heads and not measured further.

/// Distance (m) by which hair is lifted towards a lamp before the head can hide it: roots lie in the scalp.
pub const HAIR_BIAS: f32 = 2.5e-3;
/// The same for the head itself (m), whose facets would shade each other.
pub const SKIN_BIAS: f32 = 3e-3;
/// Radius over which the head's shadow on itself is blurred (m).
pub const SKIN_PENUMBRA: f32 = 5e-3;
/// How far skin is lit past the terminator, as light seeps through it.
pub const WRAP: f32 = 0.2;

/// Part of the environment that hair mirrors: its neighbours hide the rest.
pub const ENVIRONMENT_GLOSS: f32 = 0.45;

/// How much less diffuse light comes back from wet hair: this and the next two make a wet head of brown hair
/// have the traced 0.84, 0.79 and 0.72 of its dry colour, a fifth less light, as in the paper (§3.2.1).
pub const WET_DIFFUSE: f32 = 0.1;
/// How much less light that was inside the fibre comes back from wet hair.
pub const WET_RETURNED: f32 = 0.4;
/// How much less light the surface of wet hair reflects.
pub const WET_REFLECTED: f32 = 0.3;

/// Share of the light of a lamp that hair which is seen takes from other such hair, where it is dense: of
/// two directions through a dense layer, each counts for half (Lommel and Seeliger).
pub const OVERLAP: f32 = 0.5;

/// How much narrower along the fibre the highlights of wet hair are.
pub const WET_WIDTH: f32 = 0.5;

/// Exponent of the skin's soft gloss.
pub const SKIN_GLOSS: i32 = 24;
