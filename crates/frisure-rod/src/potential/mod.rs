//! Energies of a rod behind one interface: elastic energy, weight, and fields in space.
//!
//! A [`Potential`] is a sum of terms, one per element and one per node. A term depends on its own element or node
//! alone ([`ElementState`], [`NodeState`]) and adds its gradient and Hessian ([`Derivatives`]) with respect to
//!
//! - the node's frame, `R → R exp([η]×)`, η (rad) in the material frame,
//! - the node's position, `r → r + ξ`, ξ (m) in the world frame,
//! - the element's control, `c → c + x` (rad).
//!
//! A minimiser needs nothing else, so contact or any other conservative force plugs in without a change to it.

mod elastic;
mod field;
mod gravity;
mod term;
mod yielding;

pub use elastic::Elastic;
pub use field::{Field, FieldPotential};
pub use gravity::Gravity;
pub use term::{Derivatives, ElementState, NodeState, Potential};
pub use yielding::{YieldLaw, YieldState, Yielding};
