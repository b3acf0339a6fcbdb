//! Where one hair goes: the guides that it follows, and how it differs from them.

use glam::DVec3;

use super::population::Population;
use crate::bound_strands::{BoundStrand, BoundStrands};
use crate::implantation::smooth;
use crate::random::Stream;
use crate::roots::Root;
use crate::spec::Wisps;
use crate::splits::{Split, Waves};

/// Least length (m) along which hair gathers into wisps: stubble stands by itself.
const GATHERING: f64 = 0.06;

/// How much of the way to the middle of its split a hair has come at the tip.
const GATHERED: f64 = 0.75;

/// Length (m) along which hair that would be stretched is drawn in to its guides.
const DRAWN_IN: f64 = 0.02;

/// What makes one hair differ from its neighbours.
pub(super) struct Character {
    /// Length as a fraction of its guides'.
    pub(super) length: f64,
    /// Factor on the arc length at which it follows its guides: how its curl drifts.
    drift: f64,
    /// Coherent deviation.
    waves: Waves,
    /// Whether it leaves its wisp.
    stray: bool,
}

impl Character {
    pub(super) fn new(wisps: &Wisps, length: f64, spacing: f64, random: &mut Stream) -> Self {
        let stray = random.unit() < wisps.flyaways;
        let fuzz = wisps.fuzziness * random.factor(0.5) * if stray { 2.5 } else { 1.0 };
        Self {
            waves: Waves::new(0.3 * fuzz * spacing, length, random),
            length: (1.0 - wisps.length_variation * random.normal().abs()).max(0.2),
            drift: 1.0 + (0.006 + 0.06 * wisps.fuzziness) * random.normal(),
            stray,
        }
    }

    /// The same without any deviation.
    pub(super) fn still(self) -> Self {
        Self { drift: 1.0, waves: Waves::NONE, ..self }
    }
}

/// Where one hair goes.
pub(super) struct Course<'a> {
    pub(super) root: Root,
    /// Guides that it follows, with weights that sum to one; its own first.
    pub(super) followed: Vec<(usize, f64)>,
    pub(super) character: Character,
    /// The thinner wisp that it belongs to.
    pub(super) split: Option<&'a Split>,
    /// Length of its guides (m).
    pub(super) length: f64,
    /// Length that they were planned with, and that they would have if they had never been cut (m):
    /// waves do not shrink when hair is cut, and what is left does not gather more.
    pub(super) planned: f64,
    pub(super) uncut: f64,
    /// Where it ends, in their length.
    pub(super) end: f64,
    /// Its length (m) when it is dry, and whether it has been cut.
    pub(super) dry: f64,
    pub(super) cut: bool,
    /// Factor on its diameter.
    pub(super) thickness: f64,
    /// Factor on how far it is from its guides, for hair that would be stretched by going round them
    /// that far out.
    pub(super) narrow: f64,
    /// Its own shape, if it is a groom's.
    pub(super) own: Option<BoundStrand>,
}

impl Course<'_> {
    /// Whether it leaves its wisp.
    pub(super) fn stray(&self) -> bool {
        self.character.stray
    }

    /// Its own guide.
    pub(super) fn main(&self) -> usize {
        self.followed[0].0
    }
}

impl Population<'_> {
    /// Point of a hair at `x` of its guides' length.
    pub(super) fn followed_point(&self, course: &Course<'_>, x: f64) -> DVec3 {
        if let (Some(own), Some(carried)) = (&course.own, self.bound) {
            return self.carried_point(course, own, carried, x);
        }
        let Course { root, followed, character, split, length, planned, uncut, narrow, .. } =
            course;
        let along = x * length;
        let rise = smooth(0.0, 0.06_f64.min(0.5 * length), along);
        let gathered = smooth(0.0, 1.0, (along / uncut.max(GATHERING)).powf(0.8));
        let drifted = x * (1.0 + (character.drift - 1.0) * rise);
        let mut carried = character.waves.at(along / planned) * (rise * narrow);
        let drawn_in = 1.0 + (narrow - 1.0) * smooth(0.0, DRAWN_IN.min(0.5 * length), along);
        for (rank, &(g, weight)) in followed.iter().enumerate() {
            let (centre, turn) = self.wisps[g].at(drifted);
            let mut place = root.position - self.roots[g];
            if rank == 0
                && let Some(split) = split
            {
                // All of the hair goes with its split, of which only the first wisp knows.
                place += (split.middle - place) * (GATHERED * gathered / weight);
                carried += split.waves.at(along / planned) * (rise * narrow);
            }
            carried +=
                (centre + turn * place * (drawn_in * self.narrowing(g, along, gathered))) * weight;
        }
        carried
    }

    /// The same, of a hair of a groom.
    ///
    /// What a hair is away from a guide is known as far as the guide was and still is; from there on it goes
    /// straight on. What has grown since stays as far away as the tip is.
    fn carried_point(
        &self,
        course: &Course<'_>,
        own: &BoundStrand,
        carried: &BoundStrands,
        x: f64,
    ) -> DVec3 {
        let dry = x / course.end.max(1e-12) * course.dry;
        let (s, grown) = (dry.min(own.length()), (dry - own.length()).max(0.0));
        let at = own.at(s);
        let along = x * course.length;
        let narrow =
            1.0 + (course.narrow - 1.0) * smooth(0.0, DRAWN_IN.min(0.5 * course.length), along);
        let mut point = DVec3::ZERO;
        for &(g, weight) in &course.followed {
            let (now, before) = (&self.wisps[g], &carried.wisps[g]);
            // Lengths (m) of dry hair.
            let length = self.states[g].length;
            let known = before.length.min(now.end() * length);
            let (old, turned) = before.at(s.min(known) / before.length);
            let (new, turn) = now.at((s.min(known) + grown) / length);
            point += (new + turn * (turned.inverse() * (at - old)) * narrow) * weight;
        }
        point
    }

    /// Width of a wisp at arc length `s` (m), as a fraction of its patch of skin.
    fn narrowing(&self, guide: usize, s: f64, gathered: f64) -> f64 {
        let packed = self.guides[guide].thickness.packed(s) / self.patch;
        let [root, middle, tip] = self.spec.wisps.profile;
        let x = (s / self.states[guide].uncut).min(1.0);
        let along = if x < 0.5 {
            root + (middle - root) * 2.0 * x
        } else {
            middle + (tip - middle) * (2.0 * x - 1.0)
        };
        (1.0 + self.spec.wisps.clumping * gathered * (packed - 1.0)) * along
    }
}
