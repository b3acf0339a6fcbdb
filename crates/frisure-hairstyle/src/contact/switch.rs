//! How near contact is to where it begins or ends.

/// How far (m) the points of a guide at which contact is evaluated are from where contact begins or ends, or a clip pulls as hard as it
/// can; infinite where there is none near.
///
/// There the second derivative of the energy jumps for skin and for clips. That of hair on hair (the bed, wisps, density) is continuous
/// and begins at zero, so that derivatives are the same on both sides, and change fast on the side of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwitchDistance {
    /// From the surface of the skin.
    pub skin: f64,
    /// From where a clip, a tie or a braid pulls with its largest force.
    pub hold: f64,
    /// From the surface of the bed of hair, and from where the nearest wisps touch; density has none.
    pub hair: f64,
}

impl SwitchDistance {
    /// Nothing near.
    pub const FAR: Self = Self { skin: f64::INFINITY, hold: f64::INFINITY, hair: f64::INFINITY };

    /// Distance (m) below which a guide is taken to be where contact begins: its derivatives hold on one side only. Chosen: skin is firm, so that
    /// hair that lies on it with its weight is 1e-7 m deep, and with a hundredth of its weight 1e-9 m.
    pub const ONE_SIDED: f64 = 1e-9;

    /// The smaller distances of both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            skin: self.skin.min(other.skin),
            hold: self.hold.min(other.hold),
            hair: self.hair.min(other.hair),
        }
    }

    /// Whether derivatives hold on one side only: a point is within [`Self::ONE_SIDED`] of where a second derivative jumps.
    #[must_use]
    pub fn is_one_sided(&self) -> bool {
        self.skin.min(self.hold) < Self::ONE_SIDED
    }
}
