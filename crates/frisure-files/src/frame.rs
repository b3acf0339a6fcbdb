//! Units and axes: how positions in a file lie to those inside, which are metres with z up and the
//! face towards −y.

use glam::{DMat3, DVec3, Vec3};

/// The axis of a file that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// y up, face towards +z, as most OBJ files are.
    #[default]
    Y,
    /// z up, face towards −y, as frisure itself.
    Z,
}

impl UpAxis {
    /// The name of the axis, `y` or `z`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

/// Unit and axes of the positions in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Metres per unit.
    pub metres: f64,
    /// The axis that points up.
    pub up: UpAxis,
}

impl Frame {
    /// Metres, z up: as inside.
    pub const METRES_Z: Self = Self { metres: 1.0, up: UpAxis::Z };
    /// Metres, y up.
    pub const METRES_Y: Self = Self { metres: 1.0, up: UpAxis::Y };
    /// Centimetres, z up.
    pub const CENTIMETRES_Z: Self = Self { metres: 0.01, up: UpAxis::Z };
    /// Centimetres, y up.
    pub const CENTIMETRES_Y: Self = Self { metres: 0.01, up: UpAxis::Y };

    /// A position (m) in the file's unit and axes.
    #[must_use]
    pub fn position_to_file(self, p: Vec3) -> Vec3 {
        (self.direction_to_file(p).as_dvec3() / self.metres).as_vec3()
    }

    /// A position of the file in metres.
    #[must_use]
    pub fn position_from_file(self, p: DVec3) -> DVec3 {
        let p = p * self.metres;
        match self.up {
            UpAxis::Y => DVec3::new(p.x, -p.z, p.y),
            UpAxis::Z => p,
        }
    }

    /// A direction in the file's axes.
    #[must_use]
    pub fn direction_to_file(self, d: Vec3) -> Vec3 {
        match self.up {
            UpAxis::Y => Vec3::new(d.x, d.z, -d.y),
            UpAxis::Z => d,
        }
    }

    /// A direction of the file.
    #[must_use]
    pub fn direction_from_file(self, d: Vec3) -> Vec3 {
        match self.up {
            UpAxis::Y => Vec3::new(d.x, -d.z, d.y),
            UpAxis::Z => d,
        }
    }

    /// A length (m) in the file's unit.
    #[must_use]
    pub fn length_to_file(self, length: f32) -> f32 {
        (f64::from(length) / self.metres) as f32
    }

    /// A length of the file in metres.
    #[must_use]
    pub fn length_from_file(self, length: f32) -> f32 {
        (f64::from(length) * self.metres) as f32
    }
}

/// Turns about x, y and z (rad), one after the other, as one rotation `R_z R_y R_x`.
#[must_use]
pub fn rotation(turn: DVec3) -> DMat3 {
    DMat3::from_rotation_z(turn.z) * DMat3::from_rotation_y(turn.y) * DMat3::from_rotation_x(turn.x)
}

/// Unit and axes of a file that take precedence over those of its format.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameChoice {
    /// Metres per unit.
    pub metres: Option<f64>,
    /// The axis that points up.
    pub up: Option<UpAxis>,
    /// Factor on all lengths, whatever the unit is; 1 leaves them as they are.
    pub scale: f64,
}

impl Default for FrameChoice {
    fn default() -> Self {
        Self { metres: None, up: None, scale: 1.0 }
    }
}

impl FrameChoice {
    /// The frame, where `usual` is what holds without a choice.
    #[must_use]
    pub fn or(self, usual: Frame) -> Frame {
        let metres = self.scale * self.metres.unwrap_or(usual.metres);
        Frame { metres, up: self.up.unwrap_or(usual.up) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_out_comes_in() {
        let p = Vec3::new(0.25, -0.5, 1.75);
        for frame in [Frame::METRES_Z, Frame::METRES_Y, Frame::CENTIMETRES_Y] {
            let back = frame.position_from_file(frame.position_to_file(p).as_dvec3());
            assert!((back.as_vec3() - p).length() < 1e-7, "{frame:?}");
            assert_eq!(frame.direction_from_file(frame.direction_to_file(p)), p);
        }
    }

    #[test]
    fn the_face_looks_along_z_where_y_is_up() {
        assert_eq!(Frame::CENTIMETRES_Y.position_to_file(Vec3::NEG_Y), Vec3::Z * 100.0);
        assert_eq!(Frame::CENTIMETRES_Y.position_to_file(Vec3::Z), Vec3::Y * 100.0);
    }
}
