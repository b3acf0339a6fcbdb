//! Errors of cards.

use thiserror::Error;

/// Why there are no cards.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum CardsError {
    /// No strand has a length.
    #[error("the groom has no strand with a length and a width")]
    NoStrands,
    /// A number is outside of its range.
    #[error("{what} {value} is not between {least} and {most}")]
    Range {
        /// What it is.
        what: &'static str,
        /// The number given.
        value: usize,
        /// The least that it can be.
        least: usize,
        /// The most that it can be.
        most: usize,
    },
    /// The strips do not fit into the texture.
    #[error("{cards} cards do not fit into a texture of {size}x{size} texels")]
    Texture {
        /// Number of cards.
        cards: usize,
        /// Texels along a side.
        size: usize,
    },
    /// The caller asked to stop.
    #[error("the cards were cancelled")]
    Cancelled,
}
