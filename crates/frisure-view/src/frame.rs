//! The description of a frame.

use frisure_look::{Camera, Lights, Look, ToneCurve};
use glam::Vec3;

use crate::hair::Hair;
use crate::marks::MarkColours;
use crate::skin::Skin;

/// One picture.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// The camera.
    pub camera: Camera,
    /// The lights.
    pub lights: &'a Lights,
    /// Materials of skin, hair's surface and background; the hair's colours are in [`Hair`].
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
    /// Colours of marks.
    pub mark_colours: MarkColours,
}

impl<'a> Frame<'a> {
    /// A frame without hair and head, in these lights and this look.
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

/// A straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Start (m).
    pub from: Vec3,
    /// End (m).
    pub to: Vec3,
    /// Its width (pixels).
    pub width: f32,
    /// Its colour as on the screen (sRGB, 0 to 1), and how much of it is seen.
    pub colour: [f32; 4],
    /// Whether it is seen through head and hair.
    pub on_top: bool,
}

/// Most planes in one picture. Chosen; the shaders have as many.
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
