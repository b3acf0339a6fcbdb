//! Exact derivatives of an equilibrium by what the rod is made of, how it is loaded and how it is clamped.
//!
//! At rest the gradient of the energy by the controls vanishes, g(c, p) = 0, for every parameter p. So a change of p moves the
//! controls by `−H⁻¹ ∂g/∂p`, with the Hessian H that [`SecondVariation`](crate::minimise::SecondVariation) has, and a loss ℓ of the shape has
//! `dℓ/dp = ∂ℓ/∂p − aᵀ ∂g/∂p` with `H a = (∂x/∂c)ᵀ ∂ℓ/∂x`: one linear pass from tip to root and one back, in time proportional to
//! the number of elements, whatever the number of parameters. docs/theory.md, "Derivatives of an equilibrium"

mod parameters;
mod pieces;
mod sensitivity;

use thiserror::Error;

pub use parameters::{FibreChange, ParameterChange, ParameterGradient, ShapeChange};
pub use sensitivity::Sensitivity;

/// Gradient, relative to the moment scale, above which a shape is not at rest. Chosen: far above rounding.
pub(crate) const AT_REST: f64 = 1e-9;

/// Smallest eigenvalue, relative to the elastic energy, below which derivatives are [`Regularity::IllConditioned`]. Chosen; of the
/// hairs that were compared with differences some have 0.04.
pub const LEAST_EIGENVALUE: f64 = 1e-3;

/// Why an equilibrium has no derivatives.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum DerivativeError {
    /// A potential that has no form for the halves of jointed elements, see
    /// [`Potential::on_pieces`](crate::potential::Potential::on_pieces).
    #[error("a potential has no derivatives with jointed elements; use helix elements")]
    JointedElements,
    /// A change of the length, where other potentials act, which do not change with it.
    #[error("the length has no derivative where other potentials than the weight act")]
    Length,
    /// Newton's method does not come to rest from the shape.
    #[error(
        "the shape is not at rest: its relative gradient is {gradient}; it must be at most {AT_REST}"
    )]
    NotAtRest {
        /// Relative gradient, see [`crate::minimise::Problem::gradient_norm`].
        gradient: f64,
    },
    /// The Hessian is not positive definite: the shape is at a saddle or at the end of its branch.
    #[error("the shape is not a minimum: its second variation is not positive")]
    NotAMinimum,
    /// There is not one vector for each node.
    #[error("there are {given} vectors; the rod has {nodes} nodes, the root's included")]
    Nodes {
        /// How many were given.
        given: usize,
        /// How many there are, the root's included.
        nodes: usize,
    },
    /// There is not one strain for each element.
    #[error("there are {given} natural strains; the rod has {elements} elements")]
    Elements {
        /// How many were given.
        given: usize,
        /// How many there are.
        elements: usize,
    },
}

/// How far derivatives can be relied on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regularity {
    /// They agree with differences.
    Regular,
    /// Near a loss of stability: derivatives are large, and grow without bound towards it.
    IllConditioned,
}
