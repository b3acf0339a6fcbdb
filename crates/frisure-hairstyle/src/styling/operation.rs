//! What can be done to a hairstyle, as data.

use glam::DVec3;

use super::height::Height;
use super::selection::Selection;
use crate::hairstyle::Holder;
use crate::spec::{self, InvalidSpec, Parting, range};

/// One thing that is done to a hairstyle.
#[derive(Clone, Debug, PartialEq)]
pub enum Operation {
    /// Wets hair. \[paper\] §3.2
    Wet(Wet),
    /// Dries hair: the inverse. \[paper\] §3.2
    Dry(Dry),
    /// Leaves hair in damp or dry air.
    Humidity(Humidity),
    /// Cuts hair. \[paper\] §3.2
    Cut(Cut),
    /// Lets hair grow. \[paper\] §3.2, §4.1
    Grow(Grow),
    /// Drags hair aside, and lets it go unless it is to be held.
    Comb(Comb),
    /// Parts hair anew.
    Part(Part),
    /// Winds, braids, straightens or clips hair, and holds it so.
    Hold(Hold),
    /// Lets go of what is held.
    Release(Release),
}

/// Wets hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Wet {
    /// Which wisps.
    pub selection: Selection,
    /// How wet they are then: 0 (dry) to 1.
    pub to: f64,
    /// Mass of the water in fully wet hair, as a fraction of the dry hair's, 0 to 0.4; the paper
    /// counts none.
    pub water: f64,
}

impl Default for Wet {
    fn default() -> Self {
        Self { selection: Selection::Everything, to: 1.0, water: 0.0 }
    }
}

/// Dries hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Dry {
    /// Which wisps.
    pub selection: Selection,
    /// How much of the shape in which wet hair is held while it dries it keeps until it is wet
    /// again, 0 to 1.
    pub keep: f64,
}

impl Default for Dry {
    fn default() -> Self {
        Self { selection: Selection::Everything, keep: 0.6 }
    }
}

/// Leaves all hair that is not wet in air of some humidity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Humidity {
    /// Relative humidity, 0 to 1; every hairstyle begins at 0.6.
    pub relative: f64,
}

/// Cuts hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// Which wisps.
    pub selection: Selection,
    /// Where the scissors go.
    pub line: CutLine,
    /// How the hair is held meanwhile.
    pub held: Held,
}

/// Where the scissors go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutLine {
    /// A horizontal plane; what is below falls. \[paper\] §3.2
    Below(Height),
    /// A plane; what is on the side that the normal points to falls.
    Plane {
        /// A point of the plane (m).
        point: DVec3,
        /// Towards the hair that falls; any length but zero.
        normal: DVec3,
    },
    /// A sphere around the head; what is outside falls.
    Sphere {
        /// Centre (m).
        centre: DVec3,
        /// Radius (m).
        radius: f64,
    },
    /// The skin, so many metres farther out: what is farther away falls.
    OffSkin(f64),
    /// This much hair is left (m), along the fibre, wherever it is rooted.
    Length(f64),
    /// All hair is pulled straight to this point (m) and cut there: a stationary guide, which leaves
    /// hair the longer the farther it is rooted.
    Gathered(DVec3),
}

/// How hair is held while it is cut; [`CutLine::Length`] and [`CutLine::Gathered`] need no hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Held {
    /// Combed straight down from its root, as if the head were not in the way: below a horizontal
    /// plane at z_c the paper's rule, L = z_root − z_c. \[paper\] §3.2
    #[default]
    Down,
    /// Not at all: each hair is cut where its curve first meets the line.
    Hanging,
    /// Straight out from its root at an elevation (rad): 0 is flat along the skin downwards (one
    /// length), π/4 graduates, π/2 is perpendicular to the skin (layers), more turns it upwards.
    Elevated(f64),
}

/// Lets hair grow.
#[derive(Clone, Debug, PartialEq)]
pub struct Grow {
    /// Which wisps.
    pub selection: Selection,
    /// How much.
    pub amount: Growth,
    /// In how many steps of equal length, each of which comes to rest before the next.
    pub stages: usize,
}

/// How much hair grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growth {
    /// By a length (m).
    By(f64),
    /// To a length of the guides (m); longer ones stay as they are.
    To(f64),
    /// For a time (s), at the hair's own rate.
    For(f64),
}

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
    /// Whether the comb stays, until the hair is released.
    pub hold: bool,
}

impl Comb {
    /// How hard a comb pulls if nothing is said.
    pub const STRENGTH: f64 = 3.0;
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
    /// The direction (unit) of the pull, in the head's frame.
    #[must_use]
    pub fn vector(self) -> DVec3 {
        let d = match self {
            Self::Along(d) => d,
            // A comb draws hair along the head, not off it.
            Self::Named(spec::Comb::Forward) => DVec3::new(0.0, -1.0, -1.2),
            Self::Named(spec::Comb::Back) => DVec3::new(0.0, 1.0, -1.2),
            Self::Named(spec::Comb::Down) => DVec3::NEG_Z,
            Self::Named(spec::Comb::Left) => DVec3::new(1.0, 0.0, -1.2),
            Self::Named(spec::Comb::Right) => DVec3::new(-1.0, 0.0, -1.2),
        };
        d.normalize_or_zero()
    }
}

/// Parts all hair anew: roots turn away from the line to both sides, and hair falls to the side that
/// it is turned to. What keeps it there is the hair beside it, as with [`crate::Flow::Parted`].
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The line.
    pub line: Parting,
}

/// Holds hair in a shape or at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Hold {
    /// Which wisps.
    pub selection: Selection,
    /// How.
    pub by: Holder,
}

/// Lets go of what is held.
#[derive(Clone, Debug, PartialEq)]
pub struct Release {
    /// Which wisps.
    pub selection: Selection,
}

/// Farthest (m) from the origin that a line, a point or an eye may be.
const FARTHEST: f64 = 100.0;

/// A check of one number of a step.
fn near(field: &'static str, p: DVec3) -> Result<(), InvalidSpec> {
    let far =
        p.to_array().into_iter().fold(0.0, |far: f64, x| if x.abs() <= far { far } else { x });
    range(field, far, -FARTHEST, FARTHEST, "three numbers within 100 m of the origin")
}

/// A direction has some length.
fn direction(field: &'static str, d: DVec3) -> Result<(), InvalidSpec> {
    range(field, d.length(), 1e-9, 1e9, "a direction, which has a length between 1e-9 and 1e9")
}

impl Operation {
    /// Checks every number against the range in which it means something.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first field that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        let fraction = "between 0 and 1";
        if let Some(selection) = self.selection() {
            selection.check()?;
        }
        match self {
            Self::Wet(wet) => {
                range("wet.to", wet.to, 0.0, 1.0, fraction)?;
                range("wet.water", wet.water, 0.0, 0.4, "between 0 and 0.4")
            }
            Self::Dry(dry) => range("dry.keep", dry.keep, 0.0, 1.0, fraction),
            Self::Humidity(air) => range("humidity.relative", air.relative, 0.0, 1.0, fraction),
            Self::Cut(cut) => cut.check(),
            Self::Grow(grow) => grow.check(),
            Self::Comb(comb) => {
                range("comb.strength", comb.strength, 0.0, 100.0, "between 0 and 100")?;
                match comb.towards {
                    Direction::Named(_) => Ok(()),
                    Direction::Along(d) => direction("comb.towards", d),
                }
            }
            Self::Part(part) => part.line.check(),
            Self::Hold(hold) => hold.by.check(),
            Self::Release(_) => Ok(()),
        }
    }

    /// The wisps that it is about; none if it is about all hair at once.
    #[must_use]
    pub fn selection(&self) -> Option<&Selection> {
        match self {
            Self::Wet(Wet { selection, .. })
            | Self::Dry(Dry { selection, .. })
            | Self::Cut(Cut { selection, .. })
            | Self::Grow(Grow { selection, .. })
            | Self::Comb(Comb { selection, .. })
            | Self::Hold(Hold { selection, .. })
            | Self::Release(Release { selection }) => Some(selection),
            Self::Humidity(_) | Self::Part(_) => None,
        }
    }

    /// What it is called, as scenes name it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Wet(_) => "wet",
            Self::Dry(_) => "dry",
            Self::Humidity(_) => "humidity",
            Self::Cut(_) => "cut",
            Self::Grow(_) => "grow",
            Self::Comb(_) => "comb",
            Self::Part(_) => "part",
            Self::Hold(hold) => match hold.by {
                Holder::Roller { .. } => "roll",
                Holder::Braid { .. } => "braid",
                Holder::Straight => "straighten",
                Holder::Clip { .. } => "clip",
            },
            Self::Release(_) => "release",
        }
    }
}

impl Cut {
    fn check(&self) -> Result<(), InvalidSpec> {
        let far = "within 100 m of the origin";
        match self.line {
            CutLine::Below(Height::At(z)) => range("cut.below", z, -FARTHEST, FARTHEST, far),
            CutLine::Below(Height::Above(_, by)) => {
                range("cut.raise", by, -1.0, 1.0, "between -1 and 1 m")
            }
            CutLine::Plane { point, normal } => {
                near("cut.plane.point", point)?;
                direction("cut.plane.normal", normal)
            }
            CutLine::Sphere { centre, radius } => {
                near("cut.sphere.centre", centre)?;
                range("cut.sphere.radius", radius, 1e-3, FARTHEST, "between 1 mm and 100 m")
            }
            CutLine::OffSkin(distance) => {
                range("cut.off_skin", distance, 0.0, 3.0, "between 0 and 3 m")
            }
            CutLine::Length(length) => {
                range("cut.length", length, 1e-3, 3.0, "between 1 mm and 3 m")
            }
            CutLine::Gathered(point) => near("cut.gathered", point),
        }?;
        if matches!(self.line, CutLine::Length(_) | CutLine::Gathered(_)) {
            let given = self.held != Held::default();
            let (field, value) = ("cut.held", "given with `length` or `gathered`".to_owned());
            let allowed = "left out there: how the hair is held does not matter";
            return if given { Err(InvalidSpec { field, value, allowed }) } else { Ok(()) };
        }
        match self.held {
            Held::Elevated(angle) => {
                let allowed = "between 0 (along the skin) and 180 deg";
                range("cut.elevation", angle, 0.0, std::f64::consts::PI, allowed)
            }
            Held::Down | Held::Hanging => Ok(()),
        }
    }
}

impl Grow {
    /// Longest time (s) that hair grows in one step: twenty years.
    const LONGEST: f64 = 20.0 * 365.25 * 86_400.0;

    fn check(&self) -> Result<(), InvalidSpec> {
        let stages = self.stages as f64;
        range("grow.stages", stages, 1.0, 1000.0, "a whole number between 1 and 1000")?;
        match self.amount {
            Growth::By(length) => range("grow.by", length, 0.0, 3.0, "between 0 and 3 m"),
            Growth::To(length) => range("grow.to", length, 1e-3, 3.0, "between 1 mm and 3 m"),
            Growth::For(time) => {
                range("grow.time", time, 0.0, Self::LONGEST, "between 0 and 20 years")
            }
        }
    }
}

impl Holder {
    fn check(&self) -> Result<(), InvalidSpec> {
        match *self {
            Self::Roller { radius, pitch } => {
                range("roll.radius", radius, 1e-3, 0.1, "between 1 mm and 10 cm")?;
                range("roll.pitch", pitch, 0.0, 0.1, "between 0 and 10 cm")
            }
            Self::Braid { width, pitch } => {
                range("braid.width", width, 1e-3, 0.1, "between 1 mm and 10 cm")?;
                range("braid.pitch", pitch, 5e-3, 0.5, "between 5 mm and 50 cm")
            }
            Self::Straight => Ok(()),
            Self::Clip { at, to } => {
                range("clip.at", at, 0.05, 1.0, "between 0.05 and 1")?;
                near("clip.to", to)
            }
        }
    }
}
