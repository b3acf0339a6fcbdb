//! How finely a rod is divided, and into what.

use crate::error::InvalidQuantity;

/// How finely a rod is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// That many elements, 1 to 10 000.
    Elements(usize),
    /// As many as it takes for every point of the centre line to be within this distance (m) of
    /// the exact equilibrium.
    Accuracy(f64),
}

/// The curve that an element can take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ElementKind {
    /// Two pieces of the natural helix and a joint between them that carries the moment.
    #[default]
    Jointed,
    /// A helix: constant strain. \[paper\] §2.4
    Helix,
}

/// The largest number of elements in a rod.
pub const MAX_ELEMENTS: usize = 10_000;

impl Resolution {
    /// Checks the range.
    ///
    /// # Errors
    /// [`InvalidQuantity`] for no element, too many, or an accuracy that is not positive.
    pub fn check(&self) -> Result<(), InvalidQuantity> {
        #[expect(clippy::cast_precision_loss, reason = "a count for an error message")]
        match *self {
            Self::Elements(n) if n == 0 || n > MAX_ELEMENTS => Err(InvalidQuantity {
                quantity: "number of elements",
                value: n as f64,
                unit: "",
                allowed: "between 1 and 10000",
            }),
            Self::Accuracy(a) if !(a > 0.0 && a.is_finite()) => Err(InvalidQuantity {
                quantity: "accuracy",
                value: a,
                unit: "m",
                allowed: "a finite length greater than zero",
            }),
            Self::Elements(_) | Self::Accuracy(_) => Ok(()),
        }
    }
}
