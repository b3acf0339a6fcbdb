//! The other way to the same truth: Kirchhoff's equations as a boundary-value problem.
//!
//! Nothing here uses frisure's solver. Of ours it has the numbers of a rod as frisure converts them: a helix of a radius and
//! a pitch to strains, a diameter and an axis ratio to semi-axes, directors to a frame. A hanging rod obeys, in its material frame,
//!
//! ```text
//! ζ' = ζ × u        M' = M × u + w(L − s) e₃ × ζ        u = u⁰ + K⁻¹ M
//! ζ(0) = R(0)ᵀ e_z                  M(L) = 0
//! ```
//!
//! with ζ the vertical as the section sees it, M the internal moment, w the weight per length. Lengths are in
//! units of L and moments of EI/L inside. The interval is cut into pieces, each is integrated by
//! Gauss–Legendre collocation of order six (`gauss`), and Newton's method joins them (`shooting`): multiple
//! shooting, without any minimisation of energy. The weight is turned on in steps.
//!
//! Whether a solution is stable is Jacobi's condition: no neighbouring solution that leaves the tip free may
//! meet it on the way to the root. How many do is Morse's index, the number of ways downhill.

mod banded;
mod gauss;
mod hanging;
mod linear;
mod morse;
mod shooting;
mod solution;

pub use hanging::{Hanging, NoSolution, POINTS};
pub use linear::{anjyo, greenhill, prandtl_michell};
pub use solution::Solution;

#[cfg(test)]
mod tests;
