//! Where a groom of another program lies on the head.

use frisure_files::frame::rotation;
use glam::{DMat3, DVec3};

/// How a groom is scaled, turned and moved onto the head, after its unit and its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Factor on all lengths.
    pub scale: f64,
    /// Turns about the axes x, y and z of the head (rad), one after the other.
    pub turn: DVec3,
    /// Displacement (m), after scale and turns; x to the head's left, y backwards, z up.
    pub shift: DVec3,
}

impl Default for Placement {
    fn default() -> Self {
        Self { scale: 1.0, turn: DVec3::ZERO, shift: DVec3::ZERO }
    }
}

impl Placement {
    /// The turns as one rotation `R_z R_y R_x`.
    #[must_use]
    pub fn rotation(&self) -> DMat3 {
        rotation(self.turn)
    }

    /// Where a point of the groom (m) lies on the head (m).
    #[must_use]
    pub fn position(&self, p: DVec3) -> DVec3 {
        self.rotation() * (self.scale * p) + self.shift
    }
}
