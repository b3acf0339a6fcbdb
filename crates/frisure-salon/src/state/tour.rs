//! Where somebody is in the tour.

use super::orbit::Orbit;

/// Where somebody is in the tour.
#[derive(Clone, Debug, PartialEq)]
pub struct Tour {
    /// Index of the step; as many as there are steps at the end.
    pub at: usize,
    /// The view when the step began.
    pub(super) before: Orbit,
}
