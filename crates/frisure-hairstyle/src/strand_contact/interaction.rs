//! What couples hairs with each other.

use frisure_rod::batch::chain_factor::Symmetric;
use glam::DVec3;

/// An energy of the contact points of all hairs, which is all that one hair knows of another.
pub(super) trait Interaction: Sync {
    /// Finds out what is near at these points (m), and what friction is there. Without `exact` it may miss contact of a few hairs that have
    /// moved far since the last time.
    fn search(&mut self, points: &[DVec3], exact: bool) -> InteractionSummary;

    /// Makes it so hard, of what it is, from the next search on. What begins where hairs rest apart is always as hard as it is.
    fn harden(&mut self, _hardness: f64) {}

    /// Adds the gradient (N) by these points (m) to `forces`; returns the energy (J).
    fn add_forces(&mut self, points: &[DVec3], forces: &mut [DVec3]) -> f64;

    /// Prepares products with the Hessian at these points (m), and adds what it has of each point by itself (N/m) to `own`: as
    /// much or more, so that what couples points may be left out where only that is needed.
    fn linearise(&mut self, points: &[DVec3], own: &mut [Symmetric]);

    /// Puts the Hessian times a motion of points (m) into `forces` (N); returns half of what that motion costs, twice (J).
    fn product(&mut self, motion: &[DVec3], forces: &mut [DVec3]) -> f64;
}

/// Contact of a head of hair in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct InteractionSummary {
    /// Contacts.
    pub(super) touching: usize,
    /// Largest overlap over contact distance.
    pub(super) deepest: f64,
    /// Largest |f_t|/(μ f_n) of what is pressed with more than a small share of the mean.
    pub(super) ratio: f64,
    /// Sum of the changes of limits since the last search over the sum of limits.
    pub(super) change: f64,
    /// Magnitude of the sum of all contact forces over the sum of their magnitudes.
    pub(super) imbalance: f64,
}
