//! Hair ties.

use glam::DVec3;

use super::apply::{Apply, check_outside, check_point};
use crate::hairstyle::{Fastener, Hairstyle};
use crate::head::Head;
use crate::spec::InvalidSpec;
use crate::styling::braiding::braided;
use crate::styling::error::StyleError;
use crate::styling::gather::{Gathering, gathered, onto_skin};
use crate::styling::mirror::mirrored;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// Gathers hair at a place with a hair tie: a ponytail. What is too short to reach it stays out.
#[derive(Clone, Debug, PartialEq)]
pub struct Tie {
    /// Which wisps.
    pub selection: Selection,
    /// Where the tie is.
    pub to: TiePlace,
    /// Whether the tail is braided in three, with an elastic at the end.
    pub braided: bool,
}

/// Where a hair tie is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TiePlace {
    /// High at the back, below the crown.
    High,
    /// In the middle of the back of the head.
    Middle,
    /// Low, above the nape.
    Low,
    /// On the head's left side, behind the ear.
    Left,
    /// On the right.
    Right,
    /// At a point (m, head's frame).
    At(DVec3),
}

impl Default for Tie {
    fn default() -> Self {
        Self { selection: Selection::Everything, to: TiePlace::Middle, braided: false }
    }
}

/// Height (m) of the nearest hair in the tie above the skin. Chosen.
const CLEAR: f64 = 4e-3;

/// Distance (m) from the middle of the cranium at which hair is held before it is tied. Chosen: clear of head and ears.
const LIFTED: f64 = 0.25;

impl TiePlace {
    /// The direction (unit) from the middle of the cranium.
    fn direction(self, head: &Head) -> DVec3 {
        let land = head.landmarks();
        let back = -land.face;
        let left = DVec3::Z.cross(back);
        let direction = match self {
            Self::High => back + DVec3::Z * 0.75,
            Self::Middle => back + DVec3::Z * 0.05,
            Self::Low => back - DVec3::Z * 0.6,
            Self::Left => back * 0.35 - left - DVec3::Z * 0.45,
            Self::Right => back * 0.35 + left - DVec3::Z * 0.45,
            Self::At(p) => p - land.cranium_centre,
        };
        direction.normalize_or(back)
    }

    /// The middle (m) of a bundle of a radius (m) that is tied there, and the direction (unit) in which it leaves the head.
    fn bundle(self, head: &Head, radius: f64) -> (DVec3, DVec3) {
        let direction = self.direction(head);
        match self {
            Self::At(p) => (p, direction),
            _ => {
                let skin = onto_skin(head, direction);
                let (_, normal) = head.signed_distance().value_gradient(skin);
                let normal = normal.normalize_or(direction);
                (skin + normal * (radius + CLEAR), normal)
            }
        }
    }
}

impl Apply for Tie {
    fn check(&self) -> Result<(), InvalidSpec> {
        match self.to {
            TiePlace::At(p) => check_point("tie.to", p),
            _ => Ok(()),
        }
    }

    fn mirror(&mut self) {
        self.to = match self.to {
            TiePlace::Left => TiePlace::Right,
            TiePlace::Right => TiePlace::Left,
            TiePlace::At(point) => TiePlace::At(mirrored(point)),
            place @ (TiePlace::High | TiePlace::Middle | TiePlace::Low) => place,
        };
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        if let TiePlace::At(point) = self.to {
            check_outside(act.head, point)?;
        }
        let chosen = act.selected(&self.selection)?;
        let centre = act.head.landmarks().cranium_centre;
        let tied = gathered(
            act,
            &chosen,
            &Gathering {
                bundle: &|radius| self.to.bundle(act.head, radius),
                lifted: &|axis| centre + (axis + DVec3::Z).normalize_or(DVec3::Z) * LIFTED,
                by: |middle, axis| Fastener::Tie { middle, axis },
                in_hand: self.braided,
            },
        )?;
        if self.braided { braided(&act.on(&tied), &chosen) } else { Ok(tied) }
    }
}
