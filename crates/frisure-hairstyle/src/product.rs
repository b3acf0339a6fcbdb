//! Styling products: what gel, mousse and oil make of hair.

/// A styling product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    /// A gel of polymer and water, such as carbomer: it has a yield stress, and dries to a film that bridges hairs.
    Gel,
    /// A foam of polymer and water: a thinner film.
    Mousse,
    /// An oil or a wax: it makes hair slide, and draws it together a little; it does not dry.
    Oil,
}

/// What a product makes of the hair that it is on, in its usual amount.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProductLaw {
    /// Stress (Pa) at which what bridges two hairs yields.
    pub yield_stress: f64,
    /// Factor on the coefficients of friction.
    pub friction: f64,
    /// Share of what hair would lose of a shape in which it dries that the film keeps.
    pub keeps: f64,
    /// Factor on the radius of wisps and on the distances that contact keeps.
    pub wisp: f64,
    /// Whether water washes it out.
    pub washes_out: bool,
}

/// Share of the length of hairs that lie on each other that a product bridges. Chosen: hairs cross more than they lie side by side.
const BRIDGED: f64 = 0.1;

impl Product {
    /// Its numbers. Yield stresses of hair gels are 10 to 100 Pa (carbomer in water); all numbers here are chosen within what
    /// such products are said to do, none is fitted to a measurement. docs/hair-types.md, "Products"
    #[must_use]
    pub const fn law(self) -> ProductLaw {
        match self {
            Self::Gel => ProductLaw {
                yield_stress: 60.0,
                friction: 1.0,
                keeps: 0.75,
                wisp: 0.8,
                washes_out: true,
            },
            Self::Mousse => ProductLaw {
                yield_stress: 15.0,
                friction: 1.0,
                keeps: 0.4,
                wisp: 1.0,
                washes_out: true,
            },
            Self::Oil => ProductLaw {
                yield_stress: 2.0,
                friction: 0.7,
                keeps: 0.0,
                wisp: 0.9,
                washes_out: false,
            },
        }
    }
}

/// A product on a wisp, and how much of it: 0 to 1, the usual amount.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Applied {
    pub(crate) product: Product,
    pub(crate) amount: f64,
}

impl Applied {
    /// Force per length (N/m) at which hair of a diameter (m) begins to slide on the hair or skin that it sticks to: the yield stress on a
    /// bridge as wide as the hair.
    pub(crate) fn cohesion(self, diameter: f64) -> f64 {
        self.amount * self.product.law().yield_stress * diameter * BRIDGED
    }

    /// The same of hair of a diameter (m) on the hair beside it in a wisp, which it touches along its length.
    pub(crate) fn cohesion_in_wisp(self, diameter: f64) -> f64 {
        self.amount * self.product.law().yield_stress * diameter
    }

    /// Factor on the coefficients of friction.
    pub(crate) fn friction(self) -> f64 {
        1.0 + self.amount * (self.product.law().friction - 1.0)
    }

    /// Factor on the radius of wisps.
    pub(crate) fn wisp(self) -> f64 {
        1.0 + self.amount * (self.product.law().wisp - 1.0)
    }

    /// How much of a held shape is kept, of which bare hair would keep `keep`.
    pub(crate) fn keep(self, keep: f64) -> f64 {
        keep + (1.0 - keep) * self.amount * self.product.law().keeps
    }

    /// What is left where `share` of what water washes out is left.
    pub(crate) fn washed(self, share: f64) -> Option<Self> {
        let amount = if self.product.law().washes_out { self.amount * share } else { self.amount };
        // Less than a thousandth of the usual amount changes nothing that is seen.
        (amount > 1e-3).then_some(Self { amount, ..self })
    }
}
