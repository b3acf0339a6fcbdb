//! Hits: where a ray intersects hair or head.

use glam::Vec3;

/// The closest intersection of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hit {
    /// A strand.
    Hair(HairHit),
    /// The head.
    Skin(SkinHit),
}

/// The hit of a ray on a strand.
///
/// A fibre is met where a ray enters it, never where it leaves it: what a fibre does to the light
/// inside is its scattering's business. A ray that starts inside a fibre does not meet that fibre;
/// the flat ends of roots and tips are open. Light that goes on starts outside, at [`Self::ray_origin`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairHit {
    /// Distance (m).
    pub t: f32,
    /// Index of the strand.
    pub strand: u32,
    /// Index in its strand of the point before.
    pub segment: u32,
    /// Way from that point (0) to the next (1), as the parameter of the spline.
    pub u: f32,
    /// Unit tangent of the smooth curve, root to tip. The pieces that are met are straight; this is
    /// what to shade with.
    pub tangent: Vec3,
    /// Radius (m).
    pub radius: f32,
    /// Offset of the ray across the width, −1 to 1: positive where it passes the axis on the side of
    /// `direction × tangent`. That is pbrt's h = −1 + 2v.
    ///
    /// [`frisure_optics::scattering`] counts along `wo × tangent`, with `wo` back along the ray, which
    /// is the other way round: **give it −h**.
    pub h: f32,
    /// Outward unit normal of the surface met.
    pub normal: Vec3,
    /// The point of the axis at the height of the hit (m).
    pub centre: Vec3,
    /// Unit direction of the straight piece met, root to tip.
    pub axis: Vec3,
}

/// The hit of a ray on the head, from either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkinHit {
    /// Distance (m).
    pub t: f32,
    /// Index of the face.
    pub face: u32,
    /// Weights of its three corners; they sum to 1.
    pub barycentric: [f32; 3],
    /// Position (m).
    pub position: Vec3,
    /// Unit normal of the face, outwards.
    pub normal: Vec3,
    /// Unit normal interpolated between the corners.
    pub smooth_normal: Vec3,
}

/// Distance of the origin of a secondary ray from the fibre, in radii; chosen: single precision is a thousandth of a
/// hair's radius at arm's length from the origin.
const CLEARANCE: f32 = 0.01;

/// Distance of the origin of a secondary ray from the skin (m); chosen.
const SKIN_CLEARANCE: f32 = 1e-6;

impl Hit {
    /// Distance (m).
    #[must_use]
    pub fn t(&self) -> f32 {
        match self {
            Self::Hair(hit) => hit.t,
            Self::Skin(hit) => hit.t,
        }
    }

    /// Origin (m) of a ray that leaves in the direction `towards`.
    #[must_use]
    pub fn ray_origin(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Hair(hit) => hit.ray_origin(towards),
            Self::Skin(hit) => hit.ray_origin(towards),
        }
    }
}

impl HairHit {
    /// Origin (m) of a ray that leaves in the direction `towards`: at the height of the hit, just
    /// outside the fibre on the side it goes to. From there a ray only gets farther from the axis of
    /// the piece, so that it cannot meet this piece again; it may meet other windings of a curl.
    #[must_use]
    pub fn ray_origin(&self, towards: Vec3) -> Vec3 {
        let across = |v: Vec3| (v - v.dot(self.axis) * self.axis).try_normalize();
        let out = across(towards).or_else(|| across(self.normal)).unwrap_or(self.normal);
        self.centre + (1.0 + CLEARANCE) * self.radius * out
    }
}

impl SkinHit {
    /// Origin (m) of a ray that leaves in the direction `towards`: just off the face, on the side it goes to.
    #[must_use]
    pub fn ray_origin(&self, towards: Vec3) -> Vec3 {
        self.position + SKIN_CLEARANCE.copysign(towards.dot(self.normal)) * self.normal
    }
}
