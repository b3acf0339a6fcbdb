//! Why something cannot be done to a hairstyle.

use std::fmt;

use frisure_rod::InvalidQuantity;
use glam::DVec3;
use thiserror::Error;

use crate::implantation::PartingError;
use crate::spec::InvalidSpec;
use frisure_progress::Cancelled;

/// Why an operation cannot be applied; the hairstyle is as it was.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StyleError {
    /// A number of the operation is out of range.
    #[error(transparent)]
    Invalid(#[from] InvalidSpec),
    /// The selection has no wisp in it.
    #[error("no wisp is selected")]
    NothingSelected,
    /// A wisp is selected that there is not.
    #[error("there is no wisp {wisp}; this head has the wisps 0 to {}", count - 1)]
    NoSuchWisp {
        /// The number asked for.
        wisp: usize,
        /// How many wisps the head has.
        count: usize,
    },
    /// The cut goes through the scalp: it would leave nothing of some wisps.
    #[error("the cut passes above the roots of {} of {selected} wisps: {}", wisps.len(), List(wisps))]
    AboveRoot {
        /// The wisps that would be left without hair.
        wisps: Vec<usize>,
        /// How many are selected.
        selected: usize,
    },
    /// No selected wisp hangs where it could be tucked.
    #[error("none of the selected wisps is rooted and hangs in front of an ear")]
    NothingBeforeEar,
    /// No selected wisp is long enough to be tied, clipped or tucked there.
    #[error(
        "no hair is gathered: the wisp that comes nearest needs {:.1} cm to reach it, and has {:.1} cm",
        100.0 * needed, 100.0 * length
    )]
    NothingGathered {
        /// Length (m) that the wisp needs which comes nearest.
        needed: f64,
        /// Its length (m).
        length: f64,
    },
    /// Hair is held at a point inside the head.
    #[error(
        "the point is {:.1} mm inside the head; there is skin at [{:.3}, {:.3}, {:.3}] m",
        1e3 * depth, skin.x, skin.y, skin.z
    )]
    InsideHead {
        /// How deep it is (m).
        depth: f64,
        /// A near point of the skin (m, head's frame).
        skin: DVec3,
    },
    /// Every wisp that is long enough to be tied there catches on its way.
    #[error(
        "no hair is gathered: each of the {long_enough} wisps that are long enough catches on its way, or ends short of the tie"
    )]
    NothingReached {
        /// The number of wisps that are long enough.
        long_enough: usize,
    },
    /// No tail is long enough to be braided.
    #[error(
        "the hair is too short to be braided: half of it has {:.1} cm beyond the tie, and {:.1} cm are needed",
        100.0 * beyond, 100.0 * needed
    )]
    TooShortToBraid {
        /// Length (m) beyond the tie that half of the hair has.
        beyond: f64,
        /// Length (m) that is needed.
        needed: f64,
    },
    /// Hair would become longer than can be computed.
    #[error("wisp {wisp} would grow to {length:.2} m; at most {most} m can be computed")]
    TooLong {
        /// The wisp.
        wisp: usize,
        /// The length it would have (m).
        length: f64,
        /// The most (m).
        most: f64,
    },
    /// A physical quantity of a guide is out of range.
    #[error(transparent)]
    Quantity(#[from] InvalidQuantity),
    /// A parting is not on the scalp.
    #[error(transparent)]
    Parting(#[from] PartingError),
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The first of some numbers.
struct List<'a>(&'a [usize]);

impl fmt::Display for List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 12;
        let first: Vec<_> = self.0.iter().take(SHOWN).map(ToString::to_string).collect();
        write!(f, "{}", first.join(", "))?;
        if self.0.len() > SHOWN {
            write!(f, " and {} more", self.0.len() - SHOWN)?;
        }
        Ok(())
    }
}
