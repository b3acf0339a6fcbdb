//! The keys of a step, as they stand in the file; like those in `file`, the comments are the
//! reference.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::Deserialize;

use super::chosen::Where;
use super::shapes::{Below, Months, Plane, Sphere, Towards};
use crate::key::{Angle, Count, Flag, Key, Length, OneOf, Point, Points, Ratio, Table, Time};
use crate::words::{PartingPlace, Which};

/// One of `[[step]]`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Step {
    /// Wets hair.
    pub(super) wet: Table<Wet>,
    /// Dries hair: the inverse.
    pub(super) dry: Table<Dry>,
    /// Leaves all hair that is not wet in air of this relative humidity; 0 to 1. A hairstyle begins
    /// at 0.6.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) humidity: Key<Ratio>,
    /// Cuts hair along one line: `below`, `plane`, `sphere`, `off_skin`, `length` or `gathered`.
    pub(super) cut: Table<Cut>,
    /// Lets hair grow: `by` or `to` a length, or for a time.
    pub(super) grow: Table<Grow>,
    /// Drags hair aside, and lets it go unless it is to be held.
    pub(super) comb: Table<Comb>,
    /// Parts all hair anew: roots turn away from a line to both sides, and hair falls as it does from
    /// there. The line is `at` a place, or a
    /// `line` through points.
    pub(super) part: Table<Part>,
    /// Winds each wisp on a roller, and holds it.
    pub(super) roll: Table<Roll>,
    /// Braids hair in three, and holds it.
    pub(super) braid: Table<Braid>,
    /// Draws hair straight, as between hot plates or under a brush, and holds it.
    pub(super) straighten: Table<All>,
    /// Holds a place of each wisp at a point.
    pub(super) clip: Table<Clip>,
    /// Lets go of what is held.
    pub(super) release: Table<All>,
}

/// `wet`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Wet {
    /// How wet the hair is then; 0 (dry) to 1. Default 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) to: Key<Ratio>,
    /// Mass of the water in fully wet hair, as a fraction of that of dry hair; 0 to 0.4. Default 0,
    /// as in the paper.
    #[schemars(range(min = 0.0, max = 0.4))]
    pub(super) water: Key<Ratio>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `dry`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Dry {
    /// How much of the shape in which wet hair is held while it dries it keeps until it is wet
    /// again; 0 to 1. Default 0.6.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(super) keep: Key<Ratio>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `cut`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Cut {
    /// A horizontal plane, what is below falls: a level of the head, or a height in the head's frame
    /// (the mannequin's cranium has its centre at 0).
    pub(super) below: Key<Below>,
    /// How much higher than a level of the head; -1 to 1 m. Default 0.
    #[schemars(range(min = -1.0, max = 1.0))]
    pub(super) raise: Key<Length>,
    /// A plane through a point; what is on the side that the normal points to falls.
    pub(super) plane: Key<Plane>,
    /// A sphere around the head; what is outside falls. The radius is 1 mm to 100 m.
    pub(super) sphere: Key<Sphere>,
    /// What is farther than this from the skin falls; 0 to 3 m.
    #[schemars(range(min = 0.0, max = 3.0))]
    pub(super) off_skin: Key<Length>,
    /// How much hair is left along the fibre, wherever it is rooted; 1 mm to 3 m.
    #[schemars(range(min = 0.001, max = 3.0))]
    pub(super) length: Key<Length>,
    /// All hair is pulled straight to this point and cut there, which leaves hair the longer the
    /// farther it is rooted.
    pub(super) gathered: Key<Point>,
    /// How the hair is held meanwhile, unless it is cut to a length or gathered. Default "down".
    pub(super) held: Key<OneOf<Which<frisure_hairstyle::styling::Held>>>,
    /// Instead of `held`: straight out from the root at this angle, 0 (down along the skin) to 180
    /// deg; 45 deg graduates, 90 deg makes layers.
    #[schemars(range(min = 0.0, max = PI))]
    pub(super) elevation: Key<Angle>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `grow`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Grow {
    /// By a length; 0 to 3 m.
    #[schemars(range(min = 0.0, max = 3.0))]
    pub(super) by: Key<Length>,
    /// To a length of the guides, longer ones stay as they are; 1 mm to 3 m.
    #[schemars(range(min = 0.001, max = 3.0))]
    pub(super) to: Key<Length>,
    /// For so many months of 30.44 days, at the hair's own rate; 0 to 240.
    #[schemars(range(min = 0.0, max = 240.0))]
    pub(super) months: Key<Months>,
    /// For a time, at the hair's own rate; 0 to 20 years.
    #[schemars(range(min = 0.0, max = 631_152_000.0))]
    pub(super) time: Key<Time>,
    /// In how many steps of equal length, each of which comes to rest before the next; 1 to 1000.
    /// Default 1.
    #[schemars(range(min = 1, max = 1000))]
    pub(super) stages: Key<Count>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `comb`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Comb {
    /// Where to: a word, or a direction.
    pub(super) to: Key<Towards>,
    /// How hard, in what it takes to bend the hair or to carry its weight, whichever is more; 0 to
    /// 100. Default 3.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub(super) strength: Key<Ratio>,
    /// Whether the comb stays until the hair is released. Default false.
    pub(super) hold: Key<Flag>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `part`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Part {
    /// Where a straight one is: a word, or its distance from the middle at the hairline, positive to
    /// the head's left; within 6 cm.
    #[schemars(range(min = -0.06, max = 0.06))]
    pub(super) at: Key<PartingPlace>,
    /// Points that it goes smoothly through, as in `[[implantation.partings]]`.
    pub(super) line: Key<Points>,
}

/// `roll`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Roll {
    /// Radius of the roller; 1 mm to 10 cm.
    #[schemars(range(min = 0.001, max = 0.1))]
    pub(super) radius: Key<Length>,
    /// Advance per turn along the roller; 0 to 10 cm. Default 5 mm.
    #[schemars(range(min = 0.0, max = 0.1))]
    pub(super) pitch: Key<Length>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `braid`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Braid {
    /// Width of the braid; 1 mm to 10 cm.
    #[schemars(range(min = 0.001, max = 0.1))]
    pub(super) width: Key<Length>,
    /// Length in which a part comes back to its place; 5 mm to 50 cm.
    #[schemars(range(min = 0.005, max = 0.5))]
    pub(super) pitch: Key<Length>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `clip`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Clip {
    /// Which place of each wisp; 0.05 (near the root) to 1 (the tip).
    #[schemars(range(min = 0.05, max = 1.0))]
    pub(super) at: Key<Ratio>,
    /// The point, within 100 m of the origin.
    pub(super) to: Key<Point>,
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}

/// `straighten` and `release`, which ask only what for.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct All {
    /// Which wisps. Default all.
    #[serde(rename = "where")]
    pub(super) place: Key<Where>,
}
