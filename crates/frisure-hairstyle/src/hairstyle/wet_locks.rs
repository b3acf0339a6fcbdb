//! How large the locks of wet hair are.

use super::Hairstyle;
use crate::capillary::Coalescence;

/// Where along wet hair its locks are counted, as a share of its length. Chosen: farther out they are fewer and fewer, as the weight
/// below vanishes.
pub(crate) const COUNTED: f64 = 0.75;

/// Locks of wet hair at three quarters of its length, by the law of capillarity ([`crate::capillary`]); means over wet guides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WetLockSizes {
    /// Number of wet hairs on the head.
    pub hairs: f64,
    /// Hairs of a lock; 1 where hair forms none.
    pub hairs_per_lock: f64,
    /// Radius of a lock (m).
    pub radius: f64,
    /// Distance (m) from the roots at which two hairs meet; none if they do not.
    pub meeting: Option<f64>,
}

impl Hairstyle {
    /// The locks of its wet hair; none if nothing is wet or `wetting` has no law of them.
    #[must_use]
    pub fn wet_locks(&self) -> Option<WetLockSizes> {
        let law = |(guide, wisp): (&crate::Guide, &super::WispState)| {
            wisp.coalescence(&self.spec, &guide.rod, &guide.thickness)
        };
        let laws: Vec<Coalescence> =
            self.guides.iter().zip(&self.styling.wisps).filter_map(law).collect();
        if laws.is_empty() {
            return None;
        }
        let count = laws.len() as f64;
        let mean = |of: &dyn Fn(&Coalescence) -> f64| laws.iter().map(of).sum::<f64>() / count;
        // The mean of logarithms: sizes vary by factors.
        let hairs_per_lock = mean(&|law| law.lock(COUNTED * law.length).ln()).exp();
        let meeting = laws.iter().all(|law| law.meeting(1.0).is_some());
        Some(WetLockSizes {
            hairs: self.grown() * count / self.guides.len() as f64,
            hairs_per_lock,
            radius: mean(&|law| law.lock_radius(hairs_per_lock)),
            meeting: meeting.then(|| mean(&|law| law.meeting(1.0).unwrap_or(law.length))),
        })
    }
}
