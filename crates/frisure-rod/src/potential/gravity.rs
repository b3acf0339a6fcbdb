//! The energy of the weight.

use glam::DVec3;

use super::term::{Derivatives, ElementState, Potential};

/// `ρSg ∫ (L − s) t·e_z ds`: the potential of the weight with the root at height zero. Each
/// element lifts all that hangs below it. \[paper\] (2.4)
#[derive(Clone, Copy, Debug)]
pub struct Gravity {
    /// Weight per length ρSg (N/m).
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
        // ∫ z dm over the element and what hangs below its end: hanging · p + ρSg ∫ (r − r_start) ds, upwards. [paper] (2.4)
        e.work(DVec3::Z, self.hanging(e), self.weight)
    }

    #[inline]
    fn add_element_derivatives(&self, e: &ElementState<'_>, sum: &mut Derivatives) {
        e.add_work_derivatives(DVec3::Z, self.hanging(e), self.weight, sum);
    }
}
