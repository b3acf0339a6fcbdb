//! The reference solver: Kirchhoff's equations as a boundary-value problem.
//!
//! Nothing here uses frisure's solver. The only shared code converts the numbers of a rod: a radius and
//! a pitch to strains, a diameter and an axis ratio to semi-axes, directors to a frame. In its material frame, a hanging rod satisfies
//!
//! ```text
//! ζ' = ζ × u        M' = M × u + w(L − s) e₃ × ζ        u = u⁰ + K⁻¹ M
//! ζ(0) = R(0)ᵀ e_z                  M(L) = 0
//! ```
//!
//! with ζ the vertical in the material frame, M the internal moment, w the weight per length. Lengths are in
//! units of L and moments of EI/L inside. The interval is divided into pieces, each is integrated by
//! Gauss–Legendre collocation of order six (`gauss`), cut at the kinks and jumps of the natural strain, and Newton's method joins them (`shooting`): multiple
//! shooting, without any minimisation of energy. The weight increases in steps.
//!
//! A solution is stable if it satisfies Jacobi's condition: no neighbouring solution with a free tip
//! meets it between tip and root. The number of those that do is Morse's index, the number of unstable directions.

pub(crate) mod banded;
mod gauss;
mod hanging;
mod linear;
mod morse;
mod natural;
mod shooting;
mod solution;

pub use hanging::{Hanging, NoSolution, POINTS};
pub use linear::{anjyo, greenhill, prandtl_michell};
pub use natural::Natural;
pub use solution::Solution;

#[cfg(test)]
mod tests;
