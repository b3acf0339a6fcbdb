//! The energy of the weight.

use glam::DVec3;

use super::term::{Derivatives, ElementState, Potential};

/// `w ∫ (L − s) t·e ds`: the potential of a uniform load w along −e, weight for one, with the root at height zero. Each
/// element lifts all that hangs below it. \[paper\] (2.4), with e for e_z.
#[derive(Clone, Copy, Debug)]
pub struct Gravity {
    /// e: against the load (world, unit).
    pub up: DVec3,
    /// Apparent weight per length w, ρSg (N/m).
    pub weight: f64,
    /// Length L of the rod (m).
    pub length: f64,
}

impl Gravity {
    /// Weight of the rod below the end of an element (N).
    #[inline]
    fn hanging(&self, e: &ElementState<'_>) -> f64 {
        self.weight * (self.length - e.end)
    }
}

impl Potential for Gravity {
    fn depends_on_position(&self) -> bool {
        false
    }

    #[inline]
    fn element_energy(&self, e: &ElementState<'_>) -> f64 {
        // Over the element and what hangs below its end: hanging · p + w ∫ (r − r_start) ds, upwards. [paper] (2.4)
        e.work(self.up, self.hanging(e), self.weight)
    }

    #[inline]
    fn add_element_derivatives(&self, e: &ElementState<'_>, sum: &mut Derivatives) {
        e.add_work_derivatives(self.up, self.hanging(e), self.weight, sum);
    }
}
