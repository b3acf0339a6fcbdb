//! What is drawn, and how.

use frisure_look::{Camera, Lights, Look, ToneCurve};
use glam::Vec3;

use crate::{Hair, Skin};

/// One picture.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// Where it is seen from.
    pub camera: Camera,
    /// What lights it.
    pub lights: &'a Lights,
    /// What skin, hair's surface and background are; the hair's colours are those it was made with.
    pub look: &'a Look,
    /// The hair.
    pub hair: Option<&'a Hair>,
    /// The head.
    pub skin: Option<&'a Skin>,
    /// Part of the hairs that is drawn (0 to 1), chosen evenly and wider, so that they cover as all would.
    pub share: f32,
    /// How well shadows are done.
    pub shadows: Shadows,
    /// Lines.
    pub lines: &'a [Line],
    /// Planes that let light through; the first [`MAX_PLANES`] are drawn.
    pub planes: &'a [Plane],
    /// How light becomes colours of the screen.
    pub tone: ToneCurve,
    /// How much lighter the picture is, in factors of two.
    pub stops: f32,
    /// What marks look like.
    pub mark_colours: MarkColours,
}

impl<'a> Frame<'a> {
    /// Nothing yet, in these lights and this look.
    #[must_use]
    pub fn new(camera: Camera, lights: &'a Lights, look: &'a Look) -> Self {
        Self {
            camera,
            lights,
            look,
            hair: None,
            skin: None,
            share: 1.0,
            shadows: Shadows::Fine,
            lines: &[],
            planes: &[],
            tone: ToneCurve::default(),
            stops: 0.0,
            mark_colours: MarkColours::default(),
        }
    }
}

/// How well shadows are done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// Hair keeps no lamp's light out; the head does.
    None,
    /// From few hairs: while something moves.
    Coarse,
    /// From many.
    #[default]
    Fine,
}

/// What is special about one strand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Drawn towards the colour of what is chosen.
    pub chosen: bool,
    /// Part of the length (0 to 1, from the root) from which the strand will be cut off; 1 or more is nothing.
    pub falls_from: f32,
}

impl Default for Mark {
    /// Nothing.
    fn default() -> Self {
        Self { chosen: false, falls_from: 1.0 }
    }
}

/// What marks look like, as on the screen (sRGB, 0 to 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkColours {
    /// Chosen hair.
    pub chosen: [f32; 3],
    /// How far chosen hair is drawn towards it (0 to 1).
    pub strength: f32,
    /// Hair that will fall.
    pub falling: [f32; 3],
    /// How much of hair that will fall is still seen (0 to 1).
    pub remains: f32,
}

impl Default for MarkColours {
    fn default() -> Self {
        Self { chosen: [0.25, 0.62, 1.0], strength: 0.5, falling: [0.95, 0.2, 0.15], remains: 0.35 }
    }
}

/// A straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Where it begins (m).
    pub from: Vec3,
    /// Where it ends (m).
    pub to: Vec3,
    /// Its width (pixels).
    pub width: f32,
    /// Its colour as on the screen (sRGB, 0 to 1), and how much of it is seen.
    pub colour: [f32; 4],
    /// Whether it is seen through head and hair.
    pub on_top: bool,
}

/// Most planes in one picture.
pub const MAX_PLANES: usize = 4;

/// A flat rectangle that tints what is behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Its middle (m).
    pub centre: Vec3,
    /// From the middle to the middles of two edges, at right angles (m).
    pub arms: [Vec3; 2],
    /// Its colour as on the screen (sRGB, 0 to 1), and how much of it is seen.
    pub colour: [f32; 4],
}

impl Plane {
    /// A square of half size `half` (m) about `centre` (m) across `normal`; one arm is level.
    #[must_use]
    pub fn across(centre: Vec3, normal: Vec3, half: f32, colour: [f32; 4]) -> Self {
        let normal = normal.normalize_or(Vec3::Z);
        let right = Vec3::Z.cross(normal).normalize_or(Vec3::X);
        Self { centre, arms: [right * half, normal.cross(right) * half], colour }
    }
}

/// Linear value of one as on the screen (IEC 61966-2-1).
pub(crate) fn linear(c: f32) -> f32 {
    let c = if c.is_finite() { c.clamp(0.0, 1.0) } else { 0.0 };
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}
