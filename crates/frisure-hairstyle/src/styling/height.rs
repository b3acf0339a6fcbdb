//! A height on a head.

use crate::head::Head;
use crate::implantation::regions::height;
use crate::spec::Level;

/// A height on a head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Height {
    /// So high (m) in the head's frame; the mannequin's cranium has its centre at 0.
    At(f64),
    /// Above a level of the head (m), or below it if negative.
    Above(Level, f64),
}

impl Height {
    /// The height (m) on a head.
    #[must_use]
    pub fn on(self, head: &Head) -> f64 {
        match self {
            Self::At(z) => z,
            Self::Above(level, by) => height(level, head.landmarks()) + by,
        }
    }
}
