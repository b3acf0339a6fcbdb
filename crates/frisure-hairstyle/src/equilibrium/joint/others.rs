//! What the guides of a head make of each other, while all come to rest together.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

use super::hessian::Coupling;
use crate::contact::{Arrival, ContactPairs, Density, Departure};
use crate::parallel;

/// The energy that guides share.
pub(super) enum Others {
    /// Wisps repel each other where they overlap.
    Pairs(Box<ContactPairs>),
    /// Hair is pressed where it is denser than it packs.
    Density(Box<Density>),
    /// Each guide lies on the bed of hair alone.
    Apart,
}

/// What guides that lie apart feel of each other.
struct Nothing;

impl Field for Nothing {
    fn energy(&self, _: f64, _: DVec3) -> f64 {
        0.0
    }

    fn derivatives(&self, _: f64, _: DVec3) -> Option<(DVec3, DMat3)> {
        None
    }
}

impl Others {
    /// What a guide feels while the others hold still.
    pub(super) fn around(&self, guide: usize) -> Box<dyn Field + '_> {
        match self {
            Self::Pairs(pairs) => Box::new(pairs.around(guide)),
            Self::Density(density) => Box::new(density.around(guide)),
            Self::Apart => Box::new(Nothing),
        }
    }

    /// The same, where the coupling of all guides is known.
    pub(super) fn around_with<'a>(
        &'a self,
        guide: usize,
        coupling: &'a Coupling,
    ) -> Box<dyn Field + 'a> {
        match (self, coupling) {
            (Self::Density(density), Coupling::Density(variation)) => {
                Box::new(density.around_with(guide, variation))
            }
            _ => self.around(guide),
        }
    }

    /// The part of the energy that counts as the guide's: a sum over all guides counts it once.
    pub(super) fn shared(&self, guide: usize) -> Box<dyn Field + '_> {
        match self {
            Self::Pairs(pairs) => Box::new(pairs.shared(guide)),
            Self::Density(density) => Box::new(density.around(guide)),
            Self::Apart => Box::new(Nothing),
        }
    }

    /// Moves the points (m) of all guides.
    pub(super) fn place(&mut self, points: Vec<Vec<DVec3>>) {
        match self {
            Self::Pairs(pairs) => points.into_iter().enumerate().for_each(|(i, points)| {
                pairs.place(i, points);
            }),
            Self::Density(density) => {
                points.iter().enumerate().for_each(|(i, points)| density.place(i, points));
                density.measure();
            }
            Self::Apart => {}
        }
    }

    /// What the energy that guides share loses if one leaves where it is; nothing, where it is known from places alone.
    pub(super) fn departure(&self, guide: usize) -> Option<Departure> {
        match self {
            Self::Density(density) => Some(density.departure(guide)),
            Self::Pairs(_) | Self::Apart => None,
        }
    }

    /// What it is if the guide that has left arrives at other places (m).
    pub(super) fn arrival(&self, from: Option<&Departure>, points: &[DVec3]) -> Option<Arrival> {
        match self {
            Self::Density(density) => from.map(|from| density.arrival(from, points)),
            Self::Pairs(_) | Self::Apart => None,
        }
    }

    /// The guide's own part of the energy where it arrives.
    pub(super) fn around_at<'a>(
        &'a self,
        guide: usize,
        arrival: Option<&'a Arrival>,
    ) -> Box<dyn Field + 'a> {
        match (self, arrival) {
            (Self::Density(density), Some(arrival)) => Box::new(density.around_at(guide, arrival)),
            _ => self.around(guide),
        }
    }

    /// Moves the points (m) of one guide alone to where it arrives.
    pub(super) fn arrive(&mut self, guide: usize, points: Vec<DVec3>, arrival: Option<&Arrival>) {
        match (self, arrival) {
            (Self::Pairs(pairs), _) => {
                pairs.place(guide, points);
            }
            (Self::Density(density), Some(arrival)) => density.arrive(guide, &points, arrival),
            (Self::Density(_) | Self::Apart, _) => {}
        }
    }

    /// Guides in groups of which no two change what the other feels, taken in the given order.
    pub(super) fn groups_apart(&self, order: &[usize]) -> Vec<Vec<usize>> {
        match self {
            // The energy of a pair is that of its two guides.
            Self::Pairs(pairs) => pairs.groups(order),
            Self::Density(density) => density.groups_apart(order),
            Self::Apart => vec![order.to_vec()],
        }
    }

    /// Measures where all guides are, at first and after [`Self::arrive`].
    pub(super) fn measure(&mut self) {
        if let Self::Density(density) = self {
            density.measure();
        }
    }

    /// Finds what can touch while each guide moves by at most its margin (m), of guides that are looked at `again`.
    pub(super) fn update_neighbours(&mut self, margins: &[f64], again: &[bool]) {
        match self {
            Self::Pairs(pairs) => pairs.update_neighbours(margins, again),
            // Who may touch whom changes no density.
            Self::Density(density) => density.update_neighbours(margins, again),
            Self::Apart => {}
        }
    }

    /// How far (m) a guide is from where it begins to touch, or to leave, another; see [`crate::contact::SwitchDistance::hair`].
    pub(super) fn switch_distance(&self, guide: usize) -> f64 {
        self.pairs().map_or(f64::INFINITY, |pairs| pairs.switch_distance(guide))
    }

    /// The pairs of wisps, if there are any.
    pub(super) fn pairs(&self) -> Option<&ContactPairs> {
        match self {
            Self::Pairs(pairs) => Some(pairs),
            Self::Density(_) | Self::Apart => None,
        }
    }

    /// The same, to be changed.
    pub(super) fn pairs_mut(&mut self) -> Option<&mut ContactPairs> {
        match self {
            Self::Pairs(pairs) => Some(pairs),
            Self::Density(_) | Self::Apart => None,
        }
    }

    /// Whether hair is a density.
    pub(super) fn is_density(&self) -> bool {
        matches!(self, Self::Density(_))
    }

    /// The second derivatives between guides.
    pub(super) fn coupling(&self, guides: usize) -> Coupling {
        match self {
            Self::Pairs(pairs) => Coupling::Pairs(parallel::map(guides, |i| pairs.contacts(i))),
            Self::Density(density) => Coupling::Density(density.variation()),
            Self::Apart => Coupling::Pairs(vec![Vec::new(); guides]),
        }
    }
}
