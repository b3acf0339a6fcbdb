//! Where guides start from on their way to rest.

use frisure_rod::Equilibrium;

use crate::contact::Pull;
use crate::guides::Guide;

/// Where each guide starts from.
#[derive(Clone, Copy)]
pub(crate) enum GuideStart<'a> {
    /// From its natural shape, while gravity is turned on.
    Natural,
    /// From where the guide of the same index rested before. Friction does not hold it there: the rest of a description
    /// does not depend on which description was there before.
    At(&'a [Equilibrium]),
    /// From where it rested after nearly the same operation, held there by friction if there is any.
    Like(&'a [Equilibrium]),
    /// From where it rested before, by what was done to it since.
    Changed {
        /// How guides rested before.
        before: &'a [Equilibrium],
        /// What was done to each.
        changes: &'a [Change],
    },
}

/// What was done to a guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Change {
    /// Nothing: it stays where it is, unless a wisp pushes it.
    None,
    /// It comes to rest from where it lay before.
    Changed,
    /// It was in a hand and is let go: it comes to the lower of two rests, from where it lay and from
    /// its root.
    Handled,
    /// It was put into another shape by hand.
    Moulded,
    /// What pulled at it lets go, gently.
    LetGo(Pull),
    /// It was held by this and is held somewhere else now, without having been let go.
    HeldElsewhere(Pull),
    /// It was held and is held in the same way, however its fibre has changed: nothing has let go of it in between.
    StillHeld,
}

impl Change {
    /// Whether the guide lies where it lay, and nothing pulls at it any more.
    pub(super) fn leaves_it_lying(self, guide: &Guide) -> bool {
        matches!(self, Self::Changed | Self::LetGo(_)) && guide.pull.is_none()
    }
}
