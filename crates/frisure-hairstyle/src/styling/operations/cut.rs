//! Cutting.

use super::apply::{Apply, FARTHEST, check_direction, check_point};
use super::cut_line::{CutLine, Held};
use super::scissors::{Scissors, enough};
use super::trim;
use crate::equilibrium::Change;
use crate::hairstyle::Ends;
use crate::hairstyle::Hairstyle;
use crate::implantation::Root;
use crate::parallel;
use crate::random::{Purpose, Stream};
use crate::spec::Level;
use crate::spec::{InvalidSpec, Range};
use crate::strands::Population;
use crate::styling::error::StyleError;
use crate::styling::height::Height;
use crate::styling::mirror::mirrored;
use crate::styling::selection::Selection;
use crate::styling::settle::Act;

/// Cuts hair. \[paper\] §3.2
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// Which wisps.
    pub selection: Selection,
    /// Where the scissors go.
    pub line: CutLine,
    /// How the hair is held meanwhile.
    pub held: Held,
    /// Whether hair that is cut as it hangs is trimmed until it rests at the line: what fell no longer pulls at it.
    pub resting: bool,
    /// Point cutting: each hair ends up to this far (m, along the fibre) before the line, by chance. Guides end at the line.
    pub point_cut: f64,
    /// Thinning scissors: the fraction of hairs that is cut, by chance. Below 1 guides keep their lengths.
    pub share: f64,
}

impl Default for Cut {
    fn default() -> Self {
        let line = CutLine::Below(Height::Above(Level::Chin, 0.0));
        Self {
            selection: Selection::Everything,
            line,
            held: Held::Hanging,
            resting: false,
            point_cut: 0.0,
            share: 1.0,
        }
    }
}

impl Cut {
    /// Range of a height in the head's frame (m).
    pub const BELOW: Range =
        Range::new("cut.below", -FARTHEST, FARTHEST, "within 100 m of the origin");
    /// Range of a height above a level of the head (m).
    pub const RAISE: Range = Range::new("cut.raise", -1.0, 1.0, "between -1 and 1 m");
    /// Range of a sphere's radius (m).
    pub const RADIUS: Range =
        Range::new("cut.sphere.radius", 1e-3, FARTHEST, "between 1 mm and 100 m");
    /// Range of a distance from the skin (m).
    pub const OFF_SKIN: Range = Range::new("cut.off_skin", 0.0, 3.0, "between 0 and 3 m");
    /// Range of the length that is left (m).
    pub const LENGTH: Range = Range::new("cut.length", 1e-3, 3.0, "between 1 mm and 3 m");
    /// Range of the elevation (rad).
    pub const ELEVATION: Range = Range::new(
        "cut.elevation",
        0.0,
        std::f64::consts::PI,
        "between 0 (along the skin) and 180 deg",
    );

    /// Range of how far before the line hairs end (m).
    pub const POINT_CUT: Range = Range::new("cut.point_cut", 0.0, 0.5, "between 0 and 50 cm");
    /// Range of the fraction of hairs that is cut.
    pub const SHARE: Range = Range::new("cut.share", 0.0, 1.0, "between 0 and 1");

    fn check_line(&self) -> Result<(), InvalidSpec> {
        match self.line {
            CutLine::Below(Height::At(z)) => Self::BELOW.check(z),
            CutLine::Below(Height::Above(_, by)) => Self::RAISE.check(by),
            CutLine::Plane { point, normal } => {
                check_point("cut.plane.point", point)?;
                check_direction("cut.plane.normal", normal)
            }
            CutLine::Sphere { centre, radius } => {
                check_point("cut.sphere.centre", centre)?;
                Self::RADIUS.check(radius)
            }
            CutLine::OffSkin(distance) => Self::OFF_SKIN.check(distance),
            CutLine::Length(length) => Self::LENGTH.check(length),
            CutLine::Gathered(point) => check_point("cut.gathered", point),
        }
    }
}

impl Apply for Cut {
    fn check(&self) -> Result<(), InvalidSpec> {
        self.check_line()?;
        Self::POINT_CUT.check(self.point_cut)?;
        Self::SHARE.check(self.share)?;
        let free = matches!(self.line, CutLine::Length(_) | CutLine::Gathered(_));
        if free && self.held != Held::default() {
            let (field, value) = ("cut.held", "given with `length` or `gathered`".to_owned());
            let allowed = "left out there: how the hair is held does not matter";
            return Err(InvalidSpec { field, value, allowed });
        }
        if self.resting && (free || self.held != Held::Hanging) {
            let (field, value) = ("cut.resting", "given for hair that is held".to_owned());
            let allowed = "left out unless hair is cut at a line as it hangs";
            return Err(InvalidSpec { field, value, allowed });
        }
        match self.held {
            Held::Elevated(angle) => Self::ELEVATION.check(angle),
            Held::Down | Held::Hanging => Ok(()),
        }
    }

    fn mirror(&mut self) {
        self.line = match self.line {
            CutLine::Plane { point, normal } => {
                CutLine::Plane { point: mirrored(point), normal: mirrored(normal) }
            }
            CutLine::Sphere { centre, radius } => {
                CutLine::Sphere { centre: mirrored(centre), radius }
            }
            CutLine::Gathered(point) => CutLine::Gathered(mirrored(point)),
            line @ (CutLine::Below(_) | CutLine::OffSkin(_) | CutLine::Length(_)) => line,
        };
    }

    fn apply(&self, act: &Act<'_>) -> Result<Hairstyle, StyleError> {
        let Act { before: hair, head, .. } = *act;
        let chosen = act.selected(&self.selection)?;
        let scissors = Scissors::new(self.line, self.held, head);
        let left = parallel::map(hair.guides.len(), |i| match scissors.hanging() {
            true => scissors.left_hanging(&hair.rest.guides[i]),
            false => scissors.left_straight(&hair.guides[i].root),
        });
        let none = |i: &usize| chosen[*i] && !enough(left[*i]);
        let wisps: Vec<usize> = (0..left.len()).filter(none).collect();
        if !wisps.is_empty() {
            let selected = chosen.iter().filter(|chosen| **chosen).count();
            return Err(StyleError::AboveRoot { wisps, selected });
        }
        // Lengths of wisps are those of dry hair; wet hair is longer when it is cut.
        let stretch = |i: usize| hair.guides[i].rod.length() / hair.styling.wisps[i].length;
        let mut styling = hair.styling.changed(&chosen, |index, wisp| {
            // A guide stands for most hairs of its wisp, which thinning scissors leave as they are.
            if self.share >= 1.0 {
                wisp.length = wisp.length.min(left[index] / stretch(index));
            }
        });
        let stride = act.draft.map_or(1, |draft| draft.stride);
        let cuts = hair.styling.ends.as_ref().map_or(0, |ends| ends.cuts);
        let chance = Chance { cut: self, seed: hair.spec.seed, cuts };
        let hanging = |population: &Population<'_>, root: &Root, index: usize| {
            population.cut_where(root, index, |p| scissors.beyond(p))
        };
        if self.resting && self.share >= 1.0 {
            let most: Vec<f64> = hair.styling.wisps.iter().map(|wisp| wisp.length).collect();
            let cut = act.with(styling)?;
            let mut rested = trim::trimmed(act, cut, &scissors, &chosen, &most)?;
            // Hairs end where they cross the line at rest, or with their guides.
            rested.styling.ends = Some(Ends::before(hair, head, stride));
            let left = |population: &Population<'_>, root: &Root, index: usize, _: usize| {
                let crossed = hanging(population, root, index);
                let left = crossed.unwrap_or_else(|| population.followed_length(root, index));
                left - chance.of(index).unwrap_or_default()
            };
            let mut ends = Ends::cut(&rested, head, stride, &chosen, false, left);
            ends.cuts = cuts + 1;
            rested.styling.ends = Some(ends);
            return Ok(rested);
        }
        let left = |population: &Population<'_>, root: &Root, index: usize, wisp: usize| {
            let Some(before_line) = chance.of(index) else { return f64::INFINITY };
            let left = if scissors.hanging() {
                hanging(population, root, index).unwrap_or(f64::INFINITY)
            } else {
                scissors.left_straight(root) / stretch(wisp)
            };
            left - before_line
        };
        let ends = Ends::cut(hair, head, stride, &chosen, !scissors.hanging(), left);
        styling.ends = Some(match self.share {
            share if share < 1.0 => ends.thinned(hair.styling.ends.as_ref(), stride),
            _ => ends,
        });
        if scissors.hanging() {
            return act.with(styling);
        }
        act.at_rest(styling, Change::Handled)
    }
}

/// What chance does to each hair of a cut.
struct Chance<'a> {
    cut: &'a Cut,
    seed: u64,
    /// How many cuts there have been: the same scissors meet other hairs the next time.
    cuts: u32,
}

impl Chance<'_> {
    /// How far (m) before the line the hair of this index is cut, if it is.
    fn of(&self, index: usize) -> Option<f64> {
        let seed = self.seed.wrapping_add(u64::from(self.cuts) << 32);
        let mut random = Stream::new(seed, Purpose::Scissors, index);
        (random.unit() < self.cut.share).then(|| random.unit() * self.cut.point_cut)
    }
}
