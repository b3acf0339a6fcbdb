//! Where things are on a head.

use glam::{DMat3, DVec3};

use crate::math::smooth_step;

/// Places on a head (m) that other parts measure from. Once it is [upright](Self::upright), the head looks towards −y, left is +x, and
/// the two sides are taken as mirror images about the plane through the cranium's centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Landmarks {
    /// Centre of the cranium (m).
    pub cranium_centre: DVec3,
    /// Half width, half depth, and height of the vertex above the centre (m).
    pub cranium_radii: DVec3,
    /// Where the hair turns at the crown, on the skin (m).
    pub whorl: DVec3,
    /// Rotation that stands the head upright; none for heads that stand, as far as can be told.
    pub upright: DMat3,
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

/// Half the axes of the outline of an ear on the mannequin, along and up (m).
const EAR: [f64; 2] = [0.026, 0.038];

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

impl Region {
    /// Every region, from the front to the neck.
    pub const ALL: [Self; 6] =
        [Self::Fringe, Self::Top, Self::Crown, Self::Sides, Self::Back, Self::Nape];
}

impl Landmarks {
    /// `p` (m) relative to the cranium's centre, once the head is upright: to its left, back and up (m).
    pub(crate) fn local(&self, p: DVec3) -> DVec3 {
        self.upright * (p - self.cranium_centre)
    }

    /// `p` (m) relative to the cranium, in its radii: its surface is near length 1 above the ears.
    #[must_use]
    pub fn normalized(&self, p: DVec3) -> DVec3 {
        self.local(p) / self.cranium_radii
    }

    /// The size of the head over that of the mannequin.
    pub(crate) fn scale(&self) -> f64 {
        self.width / 0.155
    }

    /// Distance of a point (m) from the middle of the ear beside it, seen from the side, over that of the ear's outline there: an
    /// ellipse of 26 × 38 mm, longer than the ear because hair grows around it. Chosen by eye.
    pub(crate) fn about_ear(&self, p: DVec3) -> f64 {
        let d = self.upright * (p - self.ear);
        (d.y / EAR[0]).hypot(d.z / EAR[1]) / self.scale()
    }

    /// Distance (m) of a point beside an ear from its outline, towards the middle of the ear; negative on it.
    pub(crate) fn off_ear(&self, p: DVec3) -> f64 {
        let d = self.upright * (p - self.ear);
        d.y.hypot(d.z) * (1.0 - 1.0 / self.about_ear(p).max(1e-9))
    }

    /// Angle about the vertical of the upright head (rad): 0 at the face, π/2 at the left ear, −π/2 at the right, ±π
    /// behind.
    #[must_use]
    pub fn azimuth(&self, p: DVec3) -> f64 {
        let d = self.local(p);
        d.x.atan2(-d.y)
    }

    /// Angle above the horizontal plane through the cranium's centre (rad).
    #[must_use]
    pub fn elevation(&self, p: DVec3) -> f64 {
        let d = self.local(p);
        d.z.atan2(d.x.hypot(d.y))
    }

    /// The part of the scalp that the skin point `p` (m) belongs to.
    #[must_use]
    pub fn region(&self, p: DVec3) -> Region {
        // Borders in directions from the cranium's centre and azimuths (rad), chosen by eye; `shares` has the same.
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

    /// How much of each region the skin point `p` (m) has, in the order of [`Region::ALL`]; the sum
    /// is 1. Shares change over about a centimetre where [`Self::region`] jumps.
    #[must_use]
    pub fn shares(&self, p: DVec3) -> [f64; 6] {
        let d = self.normalized(p).normalize_or(DVec3::Z);
        let whorl = self.normalized(self.whorl).normalize_or(DVec3::Z);
        let azimuth = self.azimuth(p).abs();
        // Half a centimetre to both sides: about 0.06 of the cranium's radius.
        let above = |x: f64, at: f64, half: f64| smooth_step(at - half, at + half, x);
        let below = |x: f64, at: f64, half: f64| 1.0 - above(x, at, half);
        let crown = above(d.dot(whorl), 0.92, 0.022);
        let nape = below(d.z, -0.35, 0.06) * above(azimuth, 1.9, 0.06);
        let back = above(azimuth, 2.2, 0.06) * below(d.z, 0.75, 0.05);
        let sides = below(d.z, 0.62, 0.05) * above(azimuth, 0.75, 0.06);
        let fringe = below(d.y, -0.45, 0.06);
        // In the order of `region`: each takes its share of what those before it left, so that all sum to 1.
        let mut left = 1.0;
        let mut take = |share: f64| {
            let taken = left * share;
            left -= taken;
            taken
        };
        let [crown, nape, back, sides, fringe] = [crown, nape, back, sides, fringe].map(&mut take);
        [fringe, left, crown, sides, back, nape]
    }
}
