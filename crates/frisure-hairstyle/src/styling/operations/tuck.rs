//! Hair behind the ears.

use glam::DVec3;

use super::apply::Apply;
use crate::hairstyle::{Fastener, Grip, Hairstyle};
use crate::head::Head;
use crate::styling::error::StyleError;
use crate::styling::gather::{Gathering, gathered, onto_skin};
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// Lays hair that hangs in front of an ear behind it, and lets it go there unless it is to be held.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuck {
    /// Which wisps; of these only those that hang in front of an ear.
    pub selection: Selection,
    /// Behind which ears.
    pub sides: Sides,
    /// Whether it is held there, as by a pin, until it is released; otherwise friction alone keeps it.
    pub hold: bool,
}

/// One ear, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// Both ears.
    Both,
    /// The head's left ear.
    Left,
    /// The head's right ear.
    Right,
}

impl Default for Tuck {
    fn default() -> Self {
        Self { selection: Selection::Everything, sides: Sides::Both, hold: false }
    }
}

/// How far (m) behind the middle of the ear, and above it, hair is laid. Chosen: in the groove behind the auricle, in its upper half.
const BEHIND: f64 = 0.024;
const UP: f64 = 0.006;

/// Height (m) above the skin of the nearest hair behind the ear. Chosen.
const CLEAR: f64 = 2e-3;

/// Where a hand holds hair before it lays it behind the ear: outwards, back and up (m) from the ear. Chosen: clear of it.
const LIFTED: [f64; 3] = [0.07, 0.06, 0.09];

/// How far (m) in front of the middle of the ear hair is rooted that is tucked. Chosen: what is rooted above and behind the ear hangs behind
/// it without help.
const AHEAD: f64 = 0.005;

/// Points of a guide that tell on which side of the head it hangs. Chosen.
const LOOKED_AT: usize = 16;

/// One side of a head.
struct Ear<'a> {
    head: &'a Head,
    /// Middle of the ear (m).
    middle: DVec3,
    /// Direction (unit) out of the head.
    out: DVec3,
}

impl<'a> Ear<'a> {
    fn new(head: &'a Head, left: bool) -> Self {
        let land = head.landmarks();
        let side = DVec3::Z.cross(land.face);
        let out = if left { side } else { -side };
        // The landmark is that of the left ear.
        let away = land.ear - land.cranium_centre;
        let middle = land.ear + if left { DVec3::ZERO } else { -2.0 * side.dot(away) * side };
        Self { head, middle, out }
    }

    /// Whether a guide is rooted in front of the ear and hangs on its side.
    fn is_before(&self, root: DVec3, line: &[DVec3]) -> bool {
        let land = self.head.landmarks();
        let across = |p: &DVec3| (*p - land.cranium_centre).dot(self.out);
        (root - self.middle).dot(land.face) > AHEAD && line.iter().map(across).sum::<f64>() > 0.0
    }

    /// The middle (m) of a bundle of this radius (m) in the groove behind the ear, and the direction (unit) in which it leaves.
    fn bundle(&self, radius: f64) -> (DVec3, DVec3) {
        let land = self.head.landmarks();
        let place = self.middle - land.face * BEHIND + DVec3::Z * UP;
        let skin = onto_skin(self.head, (place - land.cranium_centre).normalize_or(self.out));
        let (_, normal) = self.head.signed_distance().value_gradient(skin);
        let middle = skin + normal.normalize_or(self.out) * (radius + CLEAR);
        (middle, (-land.face - DVec3::Z).normalize_or(DVec3::NEG_Z))
    }

    fn lifted(&self) -> DVec3 {
        let [out, back, up] = LIFTED;
        self.middle + self.out * out - self.head.landmarks().face * back + DVec3::Z * up
    }

    /// Hair laid behind the ear and held there.
    fn tucked(&self, act: &Act<'_>, selected: &[bool]) -> Result<Hairstyle, StyleError> {
        let before = act.before;
        let line = |i: usize| before.rest.guides[i].centre_line(LOOKED_AT);
        let is_before = |i: usize| self.is_before(before.guides[i].root.position, &line(i));
        // What is in a tie or on a roller does not hang before the ear.
        let is_free = |i: usize| !before.styling.wisps[i].grip.is_some_and(Grip::presses);
        let chosen: Vec<bool> =
            selected.iter().enumerate().map(|(i, &is)| is && is_free(i) && is_before(i)).collect();
        if !chosen.contains(&true) {
            return Err(StyleError::NothingBeforeEar);
        }
        let to = Gathering {
            bundle: &|radius| self.bundle(radius),
            lifted: &|_| self.lifted(),
            by: |middle, _| Fastener::Pin { middle },
            in_hand: false,
        };
        gathered(act, &chosen, &to)
    }
}

impl Apply for Tuck {
    fn mirror(&mut self) {
        self.sides = match self.sides {
            Sides::Left => Sides::Right,
            Sides::Right => Sides::Left,
            Sides::Both => Sides::Both,
        };
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let selected = act.selected(&self.selection)?;
        let ears: &[bool] = match self.sides {
            Sides::Both => &[true, false],
            Sides::Left => &[true],
            Sides::Right => &[false],
        };
        let mut hair = act.before.clone();
        let mut refused = None;
        for &left in ears {
            match Ear::new(act.head, left).tucked(&act.on(&hair), &selected) {
                Ok(tucked) => hair = tucked,
                Err(error @ (StyleError::NothingBeforeEar | StyleError::NothingGathered { .. })) => {
                    refused = Some(error);
                }
                Err(error) => return Err(error),
            }
        }
        let newly_held = |i: usize| hair.styling.wisps[i].grip != act.before.styling.wisps[i].grip;
        let tucked: Vec<bool> = (0..selected.len()).map(newly_held).collect();
        match refused {
            Some(error) if !tucked.contains(&true) => return Err(error),
            _ if self.hold => return Ok(hair),
            _ => {}
        }
        // The hand lets go: what friction does not keep falls to the front again.
        let free = hair.styling.changed(&tucked, |_, wisp| wisp.grip = None);
        act.on(&hair).with(free)
    }
}
