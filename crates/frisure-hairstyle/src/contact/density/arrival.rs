//! What one guide that moves alone changes of the density of all, without moving it yet.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

use super::hair::Density;
use super::site::Site;

/// What density loses at the points that may be near a guide if the guide leaves where it is.
pub(crate) struct Departure {
    guide: usize,
    near: NearPoints,
    /// Change of density at each of them.
    changes: Vec<f64>,
}

/// Where the points of the guides that may be near one are in a list of them, in the order of guides.
struct NearPoints {
    /// Where the first point of each guide is, of those that are near.
    first: Vec<u32>,
    count: usize,
}

/// What density is if the guide is at other places.
pub(crate) struct Arrival {
    /// Change of density at each point of a near guide, with what its departure takes.
    changes: Vec<f64>,
    /// Density at each point of the guide.
    dense: Vec<f64>,
    /// By how much the energy of all other points grows (J).
    pub(crate) growth: f64,
}

impl Density {
    /// A guide leaves where it is.
    pub(crate) fn departure(&self, guide: usize) -> Departure {
        // φ_l without the terms V_k W_kl of the guide's points k, (D1).
        let near = NearPoints::of(self, guide);
        let mut changes = vec![0.0; near.count];
        for k in self.of_guide(guide) {
            let own = &self.points.sites[k];
            self.for_each_close_to(k, own, |l| {
                changes[near.place(self, l)] -= self.points.sites[l].density_of(own);
            });
        }
        Departure { guide, near, changes }
    }

    /// A guide that has left arrives at other places (m), which are within the margin of the last search.
    pub(crate) fn arrival(&self, from: &Departure, positions: &[DVec3]) -> Arrival {
        // 1. φ_k of the guide's points from those of others, and V_k W_kl at these, (D1). The first term of φ_k, of its own hairs, does not move.
        let mut changes = from.changes.clone();
        let at = |(k, &position): (usize, &DVec3)| {
            let own = Site { position, ..self.points.sites[k] };
            let mut dense = self.points.own[k];
            self.for_each_close_to(k, &own, |l| {
                let other = &self.points.sites[l];
                dense += own.density_of(other);
                changes[from.near.place(self, l)] += other.density_of(&own);
            });
            dense
        };
        let dense = (self.starts[from.guide]..).zip(positions).map(at).collect();
        // 2. What the others pay, (D2): only where the guide was or will be, as W has a radius.
        let mut growth = 0.0;
        for (l, &change) in self.near_points(from.guide).zip(&changes) {
            if change != 0.0 {
                growth += self.energy_at(l, self.dense[l] + change) - self.energy(l);
            }
        }
        Arrival { changes, dense, growth }
    }

    /// Moves a guide to the places (m) where it arrives.
    ///
    /// What is added to a density and taken away again leaves a rounding error there until [`Self::measure`].
    pub(crate) fn arrive(&mut self, guide: usize, positions: &[DVec3], arrival: &Arrival) {
        let near: Vec<usize> = self.near_points(guide).collect();
        for (l, &change) in near.into_iter().zip(&arrival.changes) {
            if change != 0.0 {
                self.set_dense(l, self.dense[l] + change);
            }
        }
        for ((k, &position), &dense) in (self.starts[guide]..).zip(positions).zip(&arrival.dense) {
            self.place_point(k, position);
            self.set_dense(k, dense);
        }
    }

    /// The energy of a guide's own points where it arrives, as a field.
    pub(crate) fn around_at<'a>(&'a self, guide: usize, arrival: &'a Arrival) -> Arrived<'a> {
        Arrived { density: self, guide, dense: &arrival.dense }
    }

    /// The points of the guides that may be near one.
    fn near_points(&self, guide: usize) -> impl Iterator<Item = usize> {
        self.near_guides(guide).flat_map(|near| self.of_guide(near))
    }
}

impl NearPoints {
    fn of(density: &Density, guide: usize) -> Self {
        let mut first = vec![0; density.starts.len() - 1];
        let mut count = 0;
        for near in density.near_guides(guide) {
            first[near] = count as u32;
            count += density.of_guide(near).len();
        }
        Self { first, count }
    }

    /// Which of them a point is.
    #[inline]
    fn place(&self, density: &Density, l: usize) -> usize {
        let guide = density.points.guide[l] as usize;
        self.first[guide] as usize + l - density.starts[guide]
    }
}

/// One guide in the density that is where it arrives, as a field: the guide's own term of the sum over the head, at its points. It has no
/// derivatives.
pub(crate) struct Arrived<'a> {
    density: &'a Density,
    guide: usize,
    dense: &'a [f64],
}

impl Field for Arrived<'_> {
    fn energy(&self, s: f64, _: DVec3) -> f64 {
        let k = self.density.point_at(self.guide, s);
        let dense = self.dense[k - self.density.starts[self.guide]];
        // (D2) is an energy of a point; a field's is per length of hair.
        self.density.energy_at(k, dense) / self.density.points.length[k]
    }

    fn derivatives(&self, _: f64, _: DVec3) -> Option<(DVec3, DMat3)> {
        None
    }
}
