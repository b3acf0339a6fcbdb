//! Combing.

use glam::DVec3;

use crate::hairstyle::{Grip, Hairstyle};
use crate::spec::{InvalidSpec, Range};
use crate::styling::error::StyleError;
use crate::styling::mirror::mirrored;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;
use super::apply::{Apply, check_direction, check_point};
use crate::spec;

/// Drags hair aside.
#[derive(Clone, Debug, PartialEq)]
pub struct Comb {
    /// Which wisps.
    pub selection: Selection,
    /// Where to.
    pub towards: Direction,
    /// How hard, in what it takes to bend the hair or to carry its weight, whichever is more; 0 to
    /// 100.
    pub strength: f64,
    /// Where the comb stops (m, in the head's frame): what of a hair is farther from its root than that hangs free. None for a comb that goes through
    /// to the tips.
    pub until: Option<DVec3>,
    /// Whether the comb stays, until the hair is released.
    pub hold: bool,
}

impl Default for Comb {
    fn default() -> Self {
        let towards = Direction::Named(spec::Comb::Back);
        Self {
            selection: Selection::Everything,
            towards,
            strength: Self::STRENGTH,
            until: None,
            hold: false,
        }
    }
}

impl Comb {
    /// How hard a comb pulls by default. Chosen by eye.
    pub const STRENGTH: f64 = 3.0;
    /// Range of [`Self::strength`].
    pub const STRENGTHS: Range = Range::new("comb.strength", 0.0, 100.0, "between 0 and 100");
}

/// A direction in which hair is combed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// As hairdressers say it.
    Named(spec::Comb),
    /// Along a vector of any length but zero.
    Along(DVec3),
}

impl Direction {
    /// Returns the direction (unit) of the pull, in the head's frame.
    #[must_use]
    pub fn vector(self) -> DVec3 {
        let d = match self {
            Self::Along(d) => d,
            // A comb draws hair along the head, not off it: 50° downwards. Chosen by eye.
            Self::Named(spec::Comb::Forward) => DVec3::new(0.0, -1.0, -1.2),
            Self::Named(spec::Comb::Back) => DVec3::new(0.0, 1.0, -1.2),
            Self::Named(spec::Comb::Down) => DVec3::NEG_Z,
            Self::Named(spec::Comb::Left) => DVec3::new(1.0, 0.0, -1.2),
            Self::Named(spec::Comb::Right) => DVec3::new(-1.0, 0.0, -1.2),
        };
        d.normalize_or_zero()
    }
}

impl Apply for Comb {
    fn check(&self) -> Result<(), InvalidSpec> {
        Self::STRENGTHS.check(self.strength)?;
        if let Some(until) = self.until {
            check_point("comb.until", until)?;
        }
        match self.towards {
            Direction::Named(_) => Ok(()),
            Direction::Along(d) => check_direction("comb.to", d),
        }
    }

    fn mirror(&mut self) {
        self.until = self.until.map(mirrored);
        self.towards = match self.towards {
            Direction::Named(spec::Comb::Left) => Direction::Named(spec::Comb::Right),
            Direction::Named(spec::Comb::Right) => Direction::Named(spec::Comb::Left),
            Direction::Named(side) => Direction::Named(side),
            Direction::Along(d) => Direction::Along(mirrored(d)),
        };
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let (direction, strength, until) = (self.towards.vector(), self.strength, self.until);
        let combed = act.held(&self.selection, Grip::Comb { direction, strength, until })?;
        if self.hold {
            return Ok(combed);
        }
        let chosen = act.selected(&self.selection)?;
        let free = combed.styling.changed(&chosen, |_, wisp| wisp.grip = None);
        act.on(&combed).with(free)
    }
}
