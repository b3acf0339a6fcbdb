//! Hair against the body and hair against hair, as penalty energies of the rod.
//!
//! A wisp is a soft tube about its guide: a [`Thickness`] that follows from how many hairs it has
//! and how curly they are. The body is hard skin ([`BodyContact`]). What lies between a wisp and the
//! skin is other hair, and there are two models of it: a bed that is the thicker the higher the wisp
//! is rooted ([`Layer`], the paper's way), or the other wisps themselves ([`Neighbours`]).
//!
//! All energies are per length of hair (\[paper\] §3.1 takes them per sample), so that they do not
//! depend on how finely a guide is divided.

mod bed;
mod body;
mod braid;
mod density;
mod friction;
mod layers;
mod lock;
mod nearby;
mod neighbours;
mod pull;
mod sieve;
mod switch;
#[cfg(test)]
mod test_field;
mod thickness;
mod wisp_friction;

pub use bed::Bed;
pub use body::{BodyContact, CombedHold, FrictionCoefficients};
pub(crate) use braid::{BraidPath, HAIR_PER_LENGTH};
pub(crate) use density::{Arrival, Density, DensityVariation, Departure, Strand};
pub(crate) use friction::{Friction, FrictionGap, SLIP_DISTANCE, Scales, Way};
pub use friction::{FrictionSurface, Pressed};
pub use layers::Layer;
pub(crate) use lock::LockFriction;
pub use neighbours::Neighbours;
pub(crate) use neighbours::{Contact, ContactPairs, Samples};
pub use pull::Pull;
pub use switch::SwitchDistance;
pub use thickness::Thickness;
