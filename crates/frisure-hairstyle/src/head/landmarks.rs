//! Where things are on a head.

use glam::DVec3;

/// Places on a head (m) that other parts measure from. The head looks towards −y, left is +x, and
/// the two sides are taken as mirror images about the plane through the cranium's centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Landmarks {
    /// Centre of the cranium (m).
    pub cranium_centre: DVec3,
    /// Half width, half depth, and height of the vertex above the centre (m).
    pub cranium_radii: DVec3,
    /// Where the hair turns at the crown, on the skin (m).
    pub whorl: DVec3,
    /// Unit vector from the centre to the face.
    pub face: DVec3,
    /// Greatest width of the head without the ears (m).
    pub width: f64,
    /// Middle of the forehead's hairline, on or near the skin (m).
    pub hairline: DVec3,
    /// Between the brows, on or near the skin (m).
    pub brow: DVec3,
    /// Middle of the left ear (m).
    pub ear: DVec3,
    /// Lowest hair in the middle of the neck, on or near the skin (m).
    pub nape: DVec3,
}

/// Parts of the scalp, as a hairdresser names them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Region {
    /// Behind the forehead's hairline.
    Fringe,
    /// The upper skull between fringe and crown.
    Top,
    /// Around the whorl.
    Crown,
    /// Temples and above the ears.
    Sides,
    /// The back of the head above the nape.
    Back,
    /// Below the occiput.
    Nape,
}

impl Landmarks {
    /// `p` (m) relative to the cranium, in its radii: its surface is near length 1 above the ears.
    #[must_use]
    pub fn normalized(&self, p: DVec3) -> DVec3 {
        (p - self.cranium_centre) / self.cranium_radii
    }

    /// Angle about the vertical (rad): 0 at the face, π/2 at the left ear, −π/2 at the right, ±π
    /// behind.
    #[must_use]
    pub fn azimuth(&self, p: DVec3) -> f64 {
        let d = p - self.cranium_centre;
        d.x.atan2(-d.y)
    }

    /// Angle above the horizontal plane through the cranium's centre (rad).
    #[must_use]
    pub fn elevation(&self, p: DVec3) -> f64 {
        let d = p - self.cranium_centre;
        d.z.atan2(d.x.hypot(d.y))
    }

    /// The part of the scalp that the skin point `p` (m) belongs to.
    #[must_use]
    pub fn region(&self, p: DVec3) -> Region {
        let d = self.normalized(p).normalize_or(DVec3::Z);
        let whorl = self.normalized(self.whorl).normalize_or(DVec3::Z);
        let azimuth = self.azimuth(p).abs();
        if d.dot(whorl) > 0.92 {
            Region::Crown
        } else if d.z < -0.35 && azimuth > 1.9 {
            Region::Nape
        } else if azimuth > 2.2 && d.z < 0.75 {
            Region::Back
        } else if d.z < 0.62 && azimuth > 0.75 {
            Region::Sides
        } else if d.y < -0.45 {
            Region::Fringe
        } else {
            Region::Top
        }
    }
}
