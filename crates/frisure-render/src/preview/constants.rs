//! Constants of the preview's shading that the interactive view shares. Those without a source were chosen by eye
//! against traced heads and not measured further.

use glam::Vec3;

/// Distance (m) by which hair is lifted towards a lamp before the head can hide it: roots lie in the scalp.
pub const HAIR_BIAS: f32 = 2.5e-3;
/// The same for the head itself (m), whose facets would shade each other.
pub const SKIN_BIAS: f32 = 3e-3;
/// Radius over which the head's shadow on itself is blurred (m) at least.
pub const SKIN_PENUMBRA: f32 = 5e-3;
/// How much wider the blur is with the distance of what casts the shadow: 0.09 of a soft box, and as much again because
/// light scatters within skin and between jaw and neck.
pub const SKIN_SPREAD: f32 = 0.2;
/// Radius of the widest blur (m).
pub const SKIN_WIDEST: f32 = 0.02;
/// How much farther than the wrap light beneath the skin makes each colour reach, for a mean free path of red light (m):
/// red goes far, blue hardly.
#[must_use]
pub fn seeping_reach(scatter: f32) -> Vec3 {
    (scatter / 3.7e-3).clamp(0.0, 2.0) * Vec3::new(0.10, 0.03, 0.0)
}

/// Radius over which the shadow of hair on skin is blurred (m).
pub const SKIN_HAIR_BLUR: f32 = 6e-3;
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

/// Strength and exponent of the glint of a wet eye, and the share of the environment that it mirrors.
pub const WET_GLINT: f32 = 6.0;
/// See [`WET_GLINT`].
pub const WET_GLOSS: i32 = 400;
/// See [`WET_GLINT`].
pub const WET_MIRROR: f32 = 0.03;

/// Exponent of the skin's soft gloss.
pub const SKIN_GLOSS: i32 = 24;
