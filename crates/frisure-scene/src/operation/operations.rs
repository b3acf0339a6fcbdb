//! How operations are written: their keys, one declaration each.
//!
//! Doc comments are the descriptions in the JSON Schema and in `docs/scene.md`; `{}` in them is the
//! range, which stands with the operation in `frisure-hairstyle`.

use std::sync::LazyLock;

use frisure_hairstyle::styling::{
    Braid, Clip, Comb, Cut, CutLine, Dry, Grow, Growth, Height, Held, Humidity, Operation, Part,
    Product, Release, Roll, Sides, Straighten, Tie, TiePlace, Tuck, Twist, Wet,
};
use frisure_hairstyle::{Parting, Range};

use super::declare::{Button, Declaration, Group, StepKey, doc, keys, operations, schema_of};
use super::shapes::{Below, Months, Plane, Sphere, Tied, Towards};
use crate::choice::OneOf;
use crate::error::ValueError;
use crate::keywords::{Keyword, PartingPlace};
use crate::kind::{Angle, Count, Flag, Kind, Length, Point, Points, Ratio, Time, ToText};
use crate::quantity::MONTH;
use crate::similar::nearest;

operations! {
    /// Wets hair.
    wet: Wet {
        example: "wet = {}",
        main: Some("to"),
        synonyms: &["shampoo", "wash", "soak"],
    } keys {
        /// How wet the hair is then; 0 (dry) to 1. Default 1.
        to: Ratio, in Wet::TO;
        /// Mass of the water in fully wet hair, as a fraction of that of dry hair; {}. Default 0,
        /// as in the paper.
        water: Ratio, in Wet::WATER;
    }

    /// Dries hair: the inverse.
    dry: Dry {
        example: "dry = {}",
        main: Some("keep"),
        synonyms: &["blow_dry"],
    } keys {
        /// How much of the shape in which wet hair is held while it dries it keeps until it is wet
        /// again; {}. Default 0.6.
        keep: Ratio, in Dry::KEEP;
    }

    /// Leaves hair in air of some humidity.
    humidity: Humidity {
        example: "humidity = 0.9",
        main: None,
    } keys {
        /// Leaves all hair in air of this relative humidity; {}. Damp air takes a part of sets for good. A hairstyle begins
        /// at 0.6.
        relative: Ratio, in Humidity::RELATIVE, needed "humidity = 0.9";
    }

    /// Puts a styling product on hair, in place of one that was there. Water washes gel and mousse out.
    product: Product {
        example: "product = { kind = \"gel\" }",
        main: Some("kind"),
        synonyms: &["gel", "mousse", "oil", "wax", "pomade", "spray"],
        buttons: &[Button { label: "Gel", step: "product = { kind = \"gel\" }" }],
    } keys {
        /// Which product.
        kind: OneOf<Keyword<frisure_hairstyle::Product>>, needed "kind = \"gel\"",
            set |product, kind| product.kind = kind.0,
            get |product| Some(Keyword(product.kind));
        /// How much of it; {}, the usual amount. Default 1.
        amount: Ratio, in Product::AMOUNT;
    }

    /// Cuts hair along one line: `below`, `plane`, `sphere`, `off_skin`, `length` or `gathered`.
    cut: Cut {
        example: "cut = { below = \"chin\" }",
        main: Some("below"),
        synonyms: &["snip", "trim", "shorten", "thin"],
        groups: &[
            Group {
                keys: &["below", "plane", "sphere", "off_skin", "length", "gathered"],
                needed: Some((
                    "does not say where",
                    "add `below = \"chin\"`, or one of `plane`, `sphere`, `off_skin`, `length`, \
                     `gathered`",
                )),
            },
            Group { keys: &["held", "elevation"], needed: None },
        ],
    } keys {
        /// A horizontal plane, what is below falls: a level of the head, or a height in the head's frame
        /// (the mannequin's cranium has its centre at 0).
        below: Below,
            set |cut, height| cut.line = CutLine::Below(height),
            get |cut| match cut.line {
                CutLine::Below(height) => Some(height),
                _ => None,
            };
        /// A plane through a point; what is on the side that the normal points to falls.
        plane: Plane,
            set |cut, plane| cut.line = CutLine::Plane { point: plane.0, normal: plane.1 },
            get |cut| match cut.line {
                CutLine::Plane { point, normal } => Some((point, normal)),
                _ => None,
            };
        /// A sphere around the head; what is outside falls. The radius is 1 mm to 100 m.
        sphere: Sphere,
            set |cut, sphere| cut.line = CutLine::Sphere { centre: sphere.0, radius: sphere.1 },
            get |cut| match cut.line {
                CutLine::Sphere { centre, radius } => Some((centre, radius)),
                _ => None,
            };
        /// What is farther than this from the skin falls; {}.
        off_skin: Length, in Cut::OFF_SKIN,
            set |cut, distance| cut.line = CutLine::OffSkin(distance),
            get |cut| match cut.line {
                CutLine::OffSkin(distance) => Some(distance),
                _ => None,
            };
        /// How much hair is left along the fibre, wherever it is rooted; {}.
        length: Length, in Cut::LENGTH,
            set |cut, length| cut.line = CutLine::Length(length),
            get |cut| match cut.line {
                CutLine::Length(length) => Some(length),
                _ => None,
            };
        /// All hair is pulled straight to this point and cut there, which leaves hair the longer the
        /// farther it is rooted.
        gathered: Point,
            set |cut, point| cut.line = CutLine::Gathered(point),
            get |cut| match cut.line {
                CutLine::Gathered(point) => Some(point),
                _ => None,
            };
        // After all lines: `unless` sees those that are read before it.
        /// How much higher than a level of the head (`below`); {}. Default 0.
        raise: Length, in Cut::RAISE,
            unless |cut| (!matches!(cut.line, CutLine::Below(Height::Above(..)))).then(|| {
                let hint = match cut.line {
                    CutLine::Below(_) => "write `below = \"brows\"` or another level beside it",
                    _ => "take it away, or cut below a level: `below = \"brows\"`",
                };
                ValueError::because("only a level of the head is raised").hint(hint)
            }),
            set |cut, by| if let CutLine::Below(Height::Above(_, above)) = &mut cut.line {
                *above = by;
            },
            get |cut| match cut.line {
                CutLine::Below(Height::Above(_, by)) if by.to_bits() != 0 => Some(by),
                _ => None,
            };
        /// How the hair is held meanwhile, unless it is cut to a length or gathered. Default "hanging".
        held: OneOf<Keyword<Held>>,
            unless |cut| held_for_nothing(cut),
            set |cut, held| cut.held = held.0,
            get |cut| (cut.held == Held::Down).then_some(Keyword(cut.held));
        /// Instead of `held`: straight out from the root at this angle, 0 (down along the skin) to 180
        /// deg; 45 deg graduates, 90 deg makes layers.
        elevation: Angle, in Cut::ELEVATION,
            unless |cut| held_for_nothing(cut),
            set |cut, angle| cut.held = Held::Elevated(angle),
            get |cut| match cut.held {
                Held::Elevated(angle) => Some(angle),
                _ => None,
            };
        /// Whether hair that is cut as it hangs is trimmed until it rests at the line: without the weight
        /// of what fell it would spring up. Default false.
        resting: Flag,
            unless |cut| only_where_it_hangs(cut),
            set |cut, resting| cut.resting = resting,
            get |cut| cut.resting.then_some(true);
        /// Point cutting: each hair ends up to this far before the line, by chance, which makes a soft
        /// edge; {}. Default 0: a blunt one.
        point_cut: Length, in Cut::POINT_CUT;
        /// Thinning scissors: the fraction of hairs that is cut, by chance, while the others keep their
        /// length; {}. Default 1.
        share: Ratio, in Cut::SHARE;
    }

    /// Lets hair grow: `by` or `to` a length, or for a time.
    grow: Grow {
        example: "grow = { by = \"2 cm\" }",
        main: Some("by"),
        synonyms: &["lengthen"],
        groups: &[Group {
            keys: &["by", "to", "months", "time"],
            needed: Some((
                "does not say how much",
                "add `by = \"2 cm\"`, `to = \"20 cm\"`, `months = 3` or `time = \"6 weeks\"`",
            )),
        }],
    } keys {
        /// By a length; {}.
        by: Length, in Grow::BY,
            set |grow, length| grow.amount = Growth::By(length),
            get |grow| match grow.amount {
                Growth::By(length) => Some(length),
                _ => None,
            };
        /// To a mean length: each guide to its own share of it, longer ones stay as they are; {}.
        to: Length, in Grow::TO,
            set |grow, length| grow.amount = Growth::To(length),
            get |grow| match grow.amount {
                Growth::To(length) => Some(length),
                _ => None,
            };
        /// For a number of months of 30.44 days, at the hair's own rate; {}.
        months: Months, in Range::new("grow.months", 0.0, 240.0, "between 0 and 240"),
            set |grow, months| grow.amount = Growth::For(months * MONTH),
            get |grow| months(grow);
        /// For a time, at the hair's own rate; {}.
        time: Time, in Grow::TIME,
            set |grow, time| grow.amount = Growth::For(time),
            get |grow| match grow.amount {
                Growth::For(time) if months(grow).is_none() => Some(time),
                _ => None,
            };
        /// In how many steps of equal length, each of which comes to rest before the next; {}.
        /// Default 1.
        stages: Count, in Grow::STAGES;
    }

    /// Drags hair aside, and lets it go unless it is to be held.
    comb: Comb {
        example: "comb = { to = \"left\" }",
        main: Some("to"),
        synonyms: &["brush"],
    } keys {
        /// Where to: a word, or a direction.
        to: Towards, needed "to = \"left\"",
            set |comb, towards| comb.towards = towards,
            get |comb| Some(comb.towards);
        /// How hard, in what it takes to bend the hair or to carry its weight, whichever is more; {}.
        /// Default 3.
        strength: Ratio, in Comb::STRENGTHS;
        /// Where the comb stops, a point within 100 m of the origin: what of a hair is farther from its root hangs free. Left out, the comb
        /// goes through to the tips.
        until: Point,
            set |comb, point| comb.until = Some(point),
            get |comb| comb.until;
        /// Whether the comb stays until the hair is released. Default false.
        hold: Flag;
    }

    /// Parts all hair anew: roots turn away from a line to both sides, and hair falls as it does from
    /// there. The line is `at` a place, or a
    /// `line` through points.
    part: Part {
        example: "part = { at = \"middle\" }",
        main: Some("at"),
        synonyms: &["parting"],
        groups: &[Group {
            keys: &["at", "line"],
            needed: Some(("needs `at`", "write for example `at = \"middle\"`")),
        }],
    } keys {
        /// Where a straight one is: a word, or its distance from the middle at the hairline, positive to
        /// the head's left; within 6 cm.
        at: PartingPlace,
            set |part, line| part.line = line,
            get |part| (!matches!(part.line, Parting::Through(_))).then(|| part.line.clone());
        /// Points that it goes smoothly through, as in `[[implantation.partings]]`.
        line: Points,
            set |part, points| part.line = Parting::Through(points),
            get |part| match &part.line {
                Parting::Through(points) => Some(points.clone()),
                _ => None,
            };
    }

    /// Winds each wisp on a roller, and holds it.
    roll: Roll {
        example: "roll = { radius = \"1 cm\" }",
        main: Some("radius"),
        synonyms: &["curl", "roller", "perm"],
        buttons: &[Button {
            label: "On rollers",
            step: "roll = { radius = \"12 mm\", pitch = \"6 mm\" }",
        }],
    } keys {
        /// Radius of the roller; {}.
        radius: Length, in Roll::RADIUS, needed "radius = \"1 cm\"";
        /// Advance per turn along the roller; {}. Default 5 mm.
        pitch: Length, in Roll::PITCH;
    }

    /// Braids hair in three, and holds it.
    braid: Braid {
        example: "braid = { width = \"2 cm\", pitch = \"4 cm\" }",
        main: Some("width"),
        synonyms: &["plait"],
        buttons: &[Button {
            label: "In braids",
            step: "braid = { width = \"2 cm\", pitch = \"4 cm\" }",
        }],
    } keys {
        /// Width of the braid; {}.
        width: Length, in Braid::WIDTH, needed "width = \"2 cm\"";
        /// Length in which a part comes back to its place; {}.
        pitch: Length, in Braid::PITCH, needed "pitch = \"4 cm\"";
    }

    /// Winds two locks round each other, each wisp one of the two, and holds them. Dried so and released,
    /// the hair keeps waves: a twist-out.
    twist: Twist {
        example: "twist = {}",
        main: Some("width"),
        synonyms: &["rope", "two_strand_twist"],
        buttons: &[Button { label: "In twists", step: "twist = {}" }],
    } keys {
        /// Width of the twist; {}. Default 12 mm.
        width: Length, in Twist::WIDTH;
        /// Length in which a lock comes back to its side; {}. Default 3 cm.
        pitch: Length, in Twist::PITCH;
    }

    /// Draws hair straight, as between hot plates or under a brush, and holds it.
    straighten: Straighten {
        example: "straighten = {}",
        synonyms: &["iron"],
        buttons: &[Button {
            label: "Straight",
            step: "straighten = {}",
        }],
    } keys {}

    /// Holds a place of each wisp at a point.
    clip: Clip {
        example: "clip = { at = 0.5, to = [0, \"-10 cm\", \"12 cm\"] }",
        main: Some("to"),
        synonyms: &["bun", "pin"],
    } keys {
        /// Which place of each wisp; 0.05 (near the root) to 1 (the tip).
        at: Ratio, in Clip::AT, needed "at = 0.5";
        /// The point, within 100 m of the origin.
        to: Point, needed "to = [0, \"-10 cm\", \"12 cm\"]";
    }

    /// Gathers hair with a hair tie, and holds it: a ponytail. Hair that is too short to reach the tie stays out.
    tie: Tie {
        example: "tie = { to = \"high\" }",
        main: Some("to"),
        synonyms: &["ponytail", "gather", "elastic", "bunch"],
        buttons: &[
            Button { label: "In a tie", step: "tie = {}" },
            Button { label: "In a braid", step: "tie = { to = \"low\", braided = true }" },
        ],
    } keys {
        /// Where the tie is: a word, or a point. Default "middle".
        to: Tied,
            set |tie, place| tie.to = place,
            get |tie| (tie.to != TiePlace::Middle).then_some(tie.to);
        /// Whether the tail is braided in three, with an elastic at its end. Default false.
        braided: Flag;
    }

    /// Lays hair that hangs in front of an ear behind it, and lets it go there: friction keeps it, where there is some. Hair
    /// that is too short to reach the place behind the ear stays out.
    tuck: Tuck {
        example: "tuck = {}",
        main: Some("side"),
        synonyms: &["behind_ear", "ear"],
        buttons: &[Button { label: "Behind the ears", step: "tuck = {}" }],
    } keys {
        /// Behind which ear. Default "both".
        side: OneOf<Keyword<Sides>>,
            set |tuck, sides| tuck.sides = sides.0,
            get |tuck| (tuck.sides != Sides::Both).then_some(Keyword(tuck.sides));
        /// Whether it is held there, as by a pin, until it is released. Default false.
        hold: Flag;
    }

    /// Lets go of what is held.
    release: Release {
        example: "release = {}",
        synonyms: &["undo", "loosen"],
    } keys {}
}

/// Why hair that is cut to a length or gathered is not held in some way.
fn held_for_nothing(cut: &Cut) -> Option<ValueError> {
    matches!(cut.line, CutLine::Length(_) | CutLine::Gathered(_)).then(|| {
        let problem =
            "how the hair is held changes nothing where it is cut to a length or gathered";
        ValueError::because(problem).hint("take it away")
    })
}

/// Why hair that is cut so cannot be trimmed until it rests at the line.
fn only_where_it_hangs(cut: &Cut) -> Option<ValueError> {
    let free = matches!(cut.line, CutLine::Length(_) | CutLine::Gathered(_));
    (free || cut.held != Held::Hanging).then(|| {
        let problem = "only hair that is cut at a line as it hangs is trimmed until it rests there";
        let hint = if free {
            "take it away"
        } else {
            "write `held = \"hanging\"`, or take `resting` away"
        };
        ValueError::because(problem).hint(hint)
    })
}

/// The months that an amount is, if it is a number of months to the last bit.
fn months(grow: &Grow) -> Option<f64> {
    let Growth::For(time) = grow.amount else { return None };
    // Not every number of seconds is a number of months times those of one.
    let months = time / MONTH;
    let short: f64 = format!("{months:.5e}").parse().unwrap_or(months);
    [short, months].into_iter().find(|m| (m * MONTH).to_bits() == time.to_bits())
}

/// The operation of a name.
pub(super) fn find(name: &str) -> Option<&'static Declaration> {
    ALL.iter().find(|declared| declared.name == name)
}

/// The operation that a word stands for which is the name of none.
pub(crate) fn suggestion(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase().replace('-', "_");
    let synonym = ALL.iter().find(|declared| declared.synonyms.contains(&word.as_str()));
    let near = || nearest(&word, ALL.iter().map(|declared| declared.name));
    synonym.map(|declared| declared.name).or_else(near)
}
