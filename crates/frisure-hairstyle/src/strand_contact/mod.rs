//! Hairs that push and rub each other: contact of every hair with every other, equal and opposite on both.
//!
//! A point of one hair and the line of another repel each other closer than their contact distance, and stick together until they
//! slip; or all hairs are a volume that presses where it is too dense. All hairs come to rest together, by Newton's method on the energy of
//! all. docs/theory.md, "Hairs that push each other"
//!
//! Files: `layout` (hairs in long arrays), `curve` (their lines), `interaction` (what couples hairs), `segment_grid`, `candidates`, `pairs` and `pair_system`
//! (contacts), `density_system` (a volume), `energy` (of a shape of all hairs), `linear` (the linear system of a step), `newton` (a step),
//! `settle` (until rest, certificate).

mod candidates;
mod curve;
mod density_system;
mod energy;
mod interaction;
mod layout;
mod linear;
mod newton;
mod pair_system;
mod pairs;
mod segment_grid;
mod settle;
#[cfg(test)]
mod tests;

use frisure_rod::Rod;
use frisure_rod::batch::ContactField;
use glam::DVec3;

use crate::contact::FrictionCoefficients;
pub(crate) use settle::{settle, stages};

/// How hairs act on each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InteractionForm {
    /// Each pushes and rubs those that it touches.
    #[default]
    Contacts,
    /// All together are a volume that presses where it is too dense; without friction.
    Density,
}

/// Hairs in contact with each other.
pub(crate) struct StrandSystem<'a> {
    pub(crate) rods: Vec<Rod>,
    /// Elements of each hair, at least two; hairs of as many are best side by side.
    pub(crate) elements: Vec<usize>,
    /// Contact radius (m) of each hair: half of the distance at which two such hairs begin to touch.
    pub(crate) radii: Vec<f64>,
    /// Friction of each hair.
    pub(crate) friction: Vec<FrictionCoefficients>,
    /// How they act on each other.
    pub(crate) form: InteractionForm,
    /// Contact with all else, by the index of the hair.
    pub(crate) field: &'a dyn ContactField,
}

/// Hairs after they were settled.
pub(crate) struct SettledStrands {
    /// Turns of joints (rad), those of a hair one after the other.
    pub(crate) controls: Vec<DVec3>,
    pub(crate) certificate: StrandCertificate,
}

/// Contact between simulated hairs, and how near to rest all of them are together.
///
/// Gradients are those of the energy of all hairs at once, with friction as it is at the shape itself. That the shape is a
/// minimum in all directions is not checked: the second variation of the whole is not computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StrandCertificate {
    /// How hairs act on each other.
    pub form: InteractionForm,
    /// Hairs in contact with each other.
    pub strands: usize,
    /// How many hairs that grow each of them stands for.
    pub represented: f64,
    /// Contacts: points of a hair that touch another hair; of a density, points of hairs on which it presses.
    pub contacts: usize,
    /// Hairs whose gradient is at most the tolerance.
    pub balanced: usize,
    /// Largest gradient of a hair by the turn of a joint, relative to ρSgL² + EI/L.
    pub largest_gradient: f64,
    /// Root mean square over the hairs of the largest gradient of each.
    pub rms_gradient: f64,
    /// Deepest overlap of two hairs over their contact distance; of a density, that of a bundle as dense as the densest place.
    pub deepest_overlap: f64,
    /// Largest |f_t|/(μ f_n) of contacts that bear more than a tenth of the mean; 0 without friction.
    pub friction_ratio: f64,
    /// Change of the friction limits at the last search over their sum; 0 without friction.
    pub friction_change: f64,
    /// Magnitude of the sum of all contact forces between hairs over the sum of their magnitudes: rounding.
    pub imbalance: f64,
    /// Iterations on all hairs together.
    pub iterations: usize,
}
