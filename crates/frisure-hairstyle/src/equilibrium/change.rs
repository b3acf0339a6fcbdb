//! What happened to a guide since it rested.

use crate::contact::Pull;

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
}
