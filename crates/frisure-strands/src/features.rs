//! What a head has besides its skin: lips, eyes, clothes, brows and lashes.

use glam::DVec3;

use crate::Strands;

/// An eyeball, whose front the lids leave open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Its centre (m).
    pub centre: DVec3,
    /// Its radius (m).
    pub radius: f64,
    /// Unit direction in which it looks.
    pub gaze: DVec3,
}

/// What one vertex of a skin is like, beyond the colour that all have; each from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tint {
    /// The red of lips.
    pub lips: f32,
    /// The blood near the surface of cheeks, nose and ears.
    pub flush: f32,
    /// Above one half, a garment covers the skin.
    pub garment: f32,
    /// The scalp, which is darker than the face by the roots of hair in it.
    pub scalp: f32,
}

/// The features of a head: data beside its mesh that renderers draw and that no hairstyle depends on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// One for each vertex, or none at all.
    pub tints: Vec<Tint>,
    /// The eyes; their balls are part of the mesh.
    pub eyes: Vec<Eye>,
    /// Brows, followed by lashes (m).
    pub hairs: Strands,
    /// How many of the hairs are lashes.
    pub lashes: usize,
}

impl Features {
    /// The eye on whose ball a point (m) of the skin lies, if it lies on one.
    #[must_use]
    pub fn eye_at(&self, p: DVec3) -> Option<&Eye> {
        // Lids are thicker than a hundredth of the ball. Chosen.
        let near = |eye: &&Eye| (p.distance(eye.centre) / eye.radius - 1.0).abs() < 0.01;
        self.eyes.iter().find(near)
    }
}

impl std::ops::Add for Tint {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            lips: self.lips + other.lips,
            flush: self.flush + other.flush,
            garment: self.garment + other.garment,
            scalp: self.scalp + other.scalp,
        }
    }
}

impl std::ops::Mul<f32> for Tint {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self {
            lips: self.lips * factor,
            flush: self.flush * factor,
            garment: self.garment * factor,
            scalp: self.scalp * factor,
        }
    }
}
