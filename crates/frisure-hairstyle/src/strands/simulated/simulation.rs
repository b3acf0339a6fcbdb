//! Counts of simulated hairs.

use crate::strand_contact::StrandCertificate;

/// How many hairs were simulated, and how they came to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Simulation {
    /// Hairs that are rods.
    pub hairs: usize,
    /// Those that rest in a minimum of their energy; the others are drawn between their guides.
    pub at_rest: usize,
    /// Elements of all of them.
    pub elements: usize,
    /// Iterations of all of them.
    pub iterations: usize,
    /// How near to rest they are together, if they are in contact with each other. `at_rest` counts those that came to rest in
    /// their tubes then, where contact begins.
    pub contact: Option<StrandCertificate>,
}

impl Simulation {
    /// What two parts of a head are together.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            hairs: self.hairs + other.hairs,
            at_rest: self.at_rest + other.at_rest,
            elements: self.elements + other.elements,
            iterations: self.iterations + other.iterations,
            // That of a whole head is no sum.
            contact: None,
        }
    }
}
