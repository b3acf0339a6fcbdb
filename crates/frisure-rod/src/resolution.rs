//! How finely a rod is divided, and into what.

use crate::error::InvalidQuantity;
use crate::rod::Rod;

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
    /// [`Self::Jointed`] for curls, [`Self::Helix`] for the rest, whichever is more accurate:
    /// docs/theory.md, "Elements".
    #[default]
    Auto,
    /// Two pieces of the natural helix and a joint between them that carries the moment: five to
    /// twenty times as accurate as a helix on a curl, half as accurate on straight hair.
    Jointed,
    /// A helix: constant strain. \[paper\] §2.4
    Helix,
}

/// Natural turn of the whole rod over √Γ (rad) from which on joints are chosen. Tuned on nineteen reference cases: it
/// takes the better kind in eighteen (docs/theory.md, "The study of elements").
const JOINTED_FROM: f64 = 1.5;

/// Least elements per turn of the natural curl, by kind, and per √Γ (boundary layers of the length L/√Γ in the rod).
/// Tuned on the same cases: the least with which shapes and errors behave.
const HELICES_PER_TURN: f64 = 6.0;
const JOINTS_PER_TURN: f64 = 3.5;
const PER_LAYER: f64 = 0.6;

/// √(GJ/EI) with the larger EI below which elements are as many times more. Tuned on 400 random fibres with G/E from 1e-4 to
/// 3e-3, of which 99 missed the accuracy asked for without it, 9 of 300 with 0.1, none with 0.2; below that of hair (0.36), whose number is the same with it.
const PER_TWIST_LAYER: f64 = 0.3;

/// Fewest and most elements of a first division. Chosen: three doublings of the most reach [`MAX_ELEMENTS`].
const FIRST_DIVISION: (f64, f64) = (12.0, 1250.0);

impl ElementKind {
    /// The kind that [`Self::Auto`] stands for; the others stand for themselves.
    ///
    /// Constant strain errs where the natural curl turns within an element, joints err where the
    /// weight bends within one, over lengths L/√Γ. Measured on the reference cases, the two break
    /// even where the natural turn of the whole hair is about 1.3 √Γ radians.
    #[must_use]
    pub fn chosen_for(self, rod: &Rod) -> Self {
        // The largest turn that the strain could make: a fibre that varies is resolved where it turns most.
        let turn = rod.natural().max_magnitude(rod.length()) * rod.length();
        match self {
            Self::Auto if turn > JOINTED_FROM * rod.heaviness().sqrt() => Self::Jointed,
            Self::Auto => Self::Helix,
            kind => kind,
        }
    }

    /// Number of elements that resolve the turns of the curl, the bend under the weight, and how fast
    /// the section of a fibre that hardly resists twist turns in either: the least with which shapes and errors behave. Between 12 and 1 250.
    #[must_use]
    pub fn resolving_elements(self, rod: &Rod) -> usize {
        let length = rod.length();
        let turns = rod.natural().max_magnitude(length) * length / std::f64::consts::TAU;
        let helix = self.chosen_for(rod) == Self::Helix;
        let per_turn = if helix { HELICES_PER_TURN } else { JOINTS_PER_TURN };
        // The boundary layer at the root has the length L/√Γ.
        let bends = PER_LAYER * rod.heaviness().sqrt();
        let (fewest, most) = FIRST_DIVISION;
        // A section that turns on its way does so within √(GJ/EI) of the radius of the bend: there GJ θ'' balances
        // EI κ² sin θ cos θ, docs/theory.md, "Extrapolation, accuracy and the estimate of error".
        let stiffness = rod.stiffness();
        let softness = (stiffness.z / stiffness.x.max(stiffness.y)).sqrt();
        let finer = (PER_TWIST_LAYER / softness).max(1.0);
        ((per_turn * turns).max(bends) * finer).ceil().clamp(fewest, most) as usize
    }
}

/// Most by which an element may turn with the natural curl (rad) for a division to say something of the rod. Chosen: of 1 147 random rods in 1 to
/// 50 elements those above 1.3 times their estimate mostly turn by more than 4 rad in each, and of the reference cases some with 2 rad have a good one.
const WIDEST_ELEMENT: f64 = std::f64::consts::PI;

/// Whether so many elements follow the natural curl of a rod: by how much each turns in the mean.
pub(crate) fn follows_curl(rod: &Rod, elements: usize) -> bool {
    let h = rod.length() / elements as f64;
    let mut means = rod.natural().means(h).take(elements);
    means.all(|mean| mean.length() * h <= WIDEST_ELEMENT)
}

/// The largest number of elements in a rod. Chosen: at second order it leaves 1/28 000 of the error of 60 elements.
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
