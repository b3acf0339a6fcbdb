//! Contacts between hairs: a point of one and the line of another, their energy, and friction between them.
//!
//! docs/theory.md, "Hairs that push each other"

use frisure_rod::batch::chain_factor::Symmetric;
use glam::DVec3;

use super::candidates::Candidates;
use super::curve::{Nearest, Place, nearest};
use super::interaction::InteractionSummary;
use super::layout::{Layout, split_mut};
use crate::contact::{FrictionCoefficients, SLIP_DISTANCE, Scales, Way};
use crate::parallel;

/// Overlap, as a share of the contact distance, at which two hairs bear the force scale of a hair. Chosen: a hair lies a tenth of the
/// distance in the one that it lies on; not measured further.
const OVERLAP: f64 = 0.1;

/// Share of the contact distance beyond it up to which pairs are kept, so that contact that begins between two searches is
/// found. Chosen by trial; not measured further.
const MARGIN: f64 = 0.5;

/// Share of the mean friction limit of all contacts below which one does not count in the ratio of forces, as between wisps.
const LIGHT: f64 = 0.1;

/// What a pair needs to know of hairs.
pub(super) struct StrandProperties<'a> {
    /// Where points are.
    pub(super) layout: &'a Layout,
    /// Contact radius of each hair (m).
    pub(super) radii: &'a [f64],
    /// Force per length (N/m) that bends a hair as much as its weight, or as it bends: moment scale over length squared; of each hair.
    pub(super) force_scale: Vec<f64>,
    /// Of each hair.
    pub(super) friction: &'a [FrictionCoefficients],
    /// Length of hair (m) at each point.
    pub(super) shares: Vec<f64>,
    /// Factor on all stiffnesses.
    pub(super) hardness: f64,
}

/// A point of one hair near the line of another. Half of the energy of two hairs is that of points of the one, half that of the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) point: u32,
    /// The other hair, and the point of it at which it was nearest at the last search.
    pub(super) strand: u32,
    near: u32,
    /// Contact distance D (m).
    distance: f64,
    /// Half of the length at the point times the stiffness: k (N/m) of `k e³/6D`.
    stiffness: f64,
    stick: Stick,
}

/// Friction of a pair: where it stuck, and how much it bears, from the last search.
#[derive(Clone, Copy, Debug)]
struct Stick {
    /// Most friction μ f_n (N); 0: it slides freely.
    limit: f64,
    /// Separation (m) at which it stuck.
    anchor: DVec3,
    normal: DVec3,
    scales: [Scales; 2],
    /// The place on the other hair that it stuck to.
    place: Place,
}

/// The gradients (N) of a pair by its point, and where their opposites act.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PairForce {
    /// Energy (J).
    energy: f64,
    place: Place,
    pub(super) normal: DVec3,
    pub(super) friction: DVec3,
}

/// Pairs of all hairs.
#[derive(Default)]
pub(super) struct Pairs {
    pairs: Vec<Pair>,
    /// Where the pairs of the points of each hair begin; one more than hairs.
    starts: Vec<u32>,
    /// Pairs with the line of each hair, in their order, and where those of each hair begin.
    incoming: Vec<u32>,
    incoming_starts: Vec<u32>,
}

impl Pair {
    /// Where its point is nearest to the other hair, from the place of the last search on downhill.
    fn nearest(&self, layout: &Layout, points: &[DVec3]) -> Nearest {
        nearest(layout, points, self.strand, self.near, points[self.point as usize])
    }

    /// Energy (J), force (N) and stiffness (N/m) along the normal at a distance (m): `k e³/6D`, `k e²/2D`, `k e/D`.
    fn normal(&self, distance: f64) -> (f64, f64, f64) {
        let e = (self.distance - distance).max(0.0);
        let stiffness = self.stiffness * e / self.distance;
        let force = 0.5 * stiffness * e;
        (force * e / 3.0, force, stiffness)
    }

    /// The tangential way (m) from where it stuck.
    fn slid(&self, points: &[DVec3]) -> DVec3 {
        let Stick { place, anchor, normal, .. } = self.stick;
        let way = points[self.point as usize] - place.of(points) - anchor;
        way - normal * normal.dot(way)
    }

    fn way(&self, points: &[DVec3]) -> Way {
        Way::new(self.slid(points), self.stick.scales)
    }

    fn force(&self, layout: &Layout, points: &[DVec3]) -> PairForce {
        let nearest = self.nearest(layout, points);
        let distance = nearest.away.length();
        let (mut energy, force, _) = self.normal(distance);
        let normal = nearest.away * (-force / distance.max(1e-12));
        let mut friction = DVec3::ZERO;
        if self.stick.limit > 0.0 {
            let way = self.way(points);
            energy += self.stick.limit * way.energy(SLIP_DISTANCE);
            friction = way.force(SLIP_DISTANCE) * self.stick.limit;
        }
        PairForce { energy, place: nearest.place, normal, friction }
    }

    /// Stiffness (N/m) by its point: along the normal, and of friction, neither of them negative in any direction.
    pub(super) fn stiffness(
        &self,
        layout: &Layout,
        points: &[DVec3],
    ) -> (Nearest, Symmetric, Symmetric) {
        let nearest = self.nearest(layout, points);
        let distance = nearest.away.length();
        let (_, _, stiffness) = self.normal(distance);
        let n = nearest.away / distance.max(1e-12);
        let mut friction = Symmetric::default();
        if self.stick.limit > 0.0 {
            let (way, n) = (self.way(points), self.stick.normal);
            // What has slipped is where it begins to stick: it goes on, since that is what the load does.
            let (s, b) = way.stiffness(SLIP_DISTANCE * 0.98);
            friction += Symmetric::identity(s * self.stick.limit);
            friction += Symmetric::square(n, -s * self.stick.limit);
            for ridge in way.ridges {
                friction += Symmetric::square(ridge, s * self.stick.limit);
            }
            friction += Symmetric::square(b, -self.stick.limit);
        }
        (nearest, Symmetric::square(n, stiffness), friction)
    }

    /// Normal force (N) at a distance (m).
    pub(super) fn force_at(&self, distance: f64) -> f64 {
        self.normal(distance).1
    }

    /// The place on the other hair that it stuck to.
    pub(super) fn stuck_to(&self) -> Place {
        self.stick.place
    }
}

impl Pairs {
    /// The reach (m) of a search.
    pub(super) fn reach(of: &StrandProperties<'_>) -> f64 {
        2.0 * of.radii.iter().copied().fold(0.0, f64::max) * (1.0 + MARGIN)
    }

    /// The pairs of hairs at these points (m), of those that are near; what stuck before sticks on, and slips if it has to.
    pub(super) fn search(
        &self,
        of: &StrandProperties<'_>,
        points: &[DVec3],
        near: &Candidates,
    ) -> (Self, InteractionSummary) {
        let of_strand = |strand| self.of_strand(of, points, near, strand);
        let found = parallel::map(of.layout.strands(), of_strand);
        let mut next = Self { starts: vec![0], ..Self::default() };
        let mut tally = Tally::default();
        for (some, of) in found {
            next.pairs.extend(some);
            next.starts.push(next.pairs.len() as u32);
            tally = tally.and(of);
        }
        next.sort_incoming(of.layout.strands());
        let summary = next.summary(of, points, &tally);
        (next, summary)
    }

    fn of_strand(
        &self,
        of: &StrandProperties<'_>,
        points: &[DVec3],
        near: &Candidates,
        strand: usize,
    ) -> (Vec<Pair>, Tally) {
        let mut pairs = Vec::new();
        let mut tally = Tally::default();
        let mut before = self.of(strand);
        for point in of.layout.points(strand).skip(1) {
            let x = points[point];
            // Segments of the same hair lead to the same nearest place.
            let first = pairs.len();
            let known = before.iter().take_while(|pair| pair.point == point as u32).count();
            let (known, later) = before.split_at(known);
            before = later;
            tally.before += known.iter().map(|pair| pair.stick.limit).sum::<f64>();
            for &(other, segment) in near.of(point) {
                let nearest = nearest(of.layout, points, other, segment, x);
                let middle = nearest.place.first + 1;
                let same = |pair: &Pair| pair.strand == other && pair.near.abs_diff(middle) <= 1;
                if pairs[first..].iter().rev().any(same) {
                    continue;
                }
                let pair = Pair::new(of, points, (strand, point), (other, &nearest));
                let Some(mut pair) = pair else { continue };
                pair.press(of, points, strand, known, &mut tally);
                pairs.push(pair);
            }
        }
        (pairs, tally)
    }

    /// Those of the points of one hair.
    pub(super) fn of(&self, strand: usize) -> &[Pair] {
        match self.starts.get(strand..strand + 2) {
            Some(&[from, to]) => &self.pairs[from as usize..to as usize],
            _ => &[],
        }
    }

    fn sort_incoming(&mut self, strands: usize) {
        let mut starts = vec![0_u32; strands + 1];
        for pair in &self.pairs {
            starts[pair.strand as usize + 1] += 1;
        }
        for k in 0..strands {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        self.incoming = vec![0; self.pairs.len()];
        for (k, pair) in self.pairs.iter().enumerate() {
            let to = &mut next[pair.strand as usize];
            self.incoming[*to as usize] = k as u32;
            *to += 1;
        }
        self.incoming_starts = starts;
    }

    /// The forces of all pairs at these points (m), and their energy (J).
    pub(super) fn forces(
        &self,
        layout: &Layout,
        points: &[DVec3],
        forces: &mut Vec<PairForce>,
    ) -> f64 {
        forces.resize(self.pairs.len(), PairForce::default());
        let strands = layout.chunks();
        let lengths = strands
            .iter()
            .map(|range| (self.starts[range.end] - self.starts[range.start]) as usize);
        let energies = parallel::map_mut(&mut split_mut(forces, lengths), |index, forces| {
            let from = self.starts[strands[index].start] as usize;
            for (force, pair) in forces.iter_mut().zip(&self.pairs[from..]) {
                *force = pair.force(layout, points);
            }
            forces.iter().map(|force| force.energy).sum::<f64>()
        });
        energies.iter().sum()
    }

    /// Adds the gradients (N) of all pairs by the points of one hair, whose first point has the index `first`.
    pub(super) fn add_forces(
        &self,
        strand: usize,
        first: usize,
        all: &[PairForce],
        sum: &mut [DVec3],
    ) {
        let own = self.starts[strand] as usize..self.starts[strand + 1] as usize;
        for (pair, force) in self.pairs[own.clone()].iter().zip(&all[own]) {
            sum[pair.point as usize - first] += force.normal + force.friction;
        }
        for &k in self.onto(strand) {
            let (pair, force) = (&self.pairs[k as usize], &all[k as usize]);
            let mut act = |place: Place, f: DVec3| {
                let at = place.first as usize - first;
                for (sum, weight) in sum[at..].iter_mut().zip(place.weights) {
                    *sum -= f * weight;
                }
            };
            act(force.place, force.normal);
            act(pair.stick.place, force.friction);
        }
    }

    fn onto(&self, strand: usize) -> &[u32] {
        let range =
            self.incoming_starts[strand] as usize..self.incoming_starts[strand + 1] as usize;
        &self.incoming[range]
    }

    /// The sum of the forces of pairs on all points over the sum of their magnitudes.
    fn imbalance(&self, layout: &Layout, forces: &[PairForce]) -> f64 {
        let mut on = vec![DVec3::ZERO; layout.point_count()];
        for strand in 0..layout.strands() {
            let points = layout.points(strand);
            self.add_forces(strand, points.start, forces, &mut on[points]);
        }
        let all: f64 = on.iter().map(|force| force.length()).sum();
        if all > 0.0 { on.iter().sum::<DVec3>().length() / all } else { 0.0 }
    }

    fn summary(
        &self,
        of: &StrandProperties<'_>,
        points: &[DVec3],
        tally: &Tally,
    ) -> InteractionSummary {
        let limits: f64 = self.pairs.iter().map(|pair| pair.stick.limit).sum();
        let rubbing = self.pairs.iter().filter(|pair| pair.stick.limit > 0.0).count().max(1);
        let light = LIGHT * limits / rubbing as f64;
        let heavy = tally.used.iter().filter(|(_, limit)| *limit > light);
        // What does not touch any more has lost its limit.
        let change = tally.change + (tally.before - tally.followed).max(0.0);
        let mut forces = Vec::new();
        self.forces(of.layout, points, &mut forces);
        let touching = |force: &&PairForce| force.normal != DVec3::ZERO;
        let overlap = |(pair, force): (&Pair, &PairForce)| {
            let away = points[pair.point as usize] - force.place.of(points);
            1.0 - away.length() / pair.distance
        };
        InteractionSummary {
            touching: forces.iter().filter(touching).count(),
            deepest: self.pairs.iter().zip(&forces).map(overlap).fold(0.0, f64::max),
            ratio: heavy.map(|(used, limit)| used / limit).fold(0.0, f64::max),
            change: if limits > 0.0 { change / limits } else { 0.0 },
            imbalance: self.imbalance(of.layout, &forces),
        }
    }
}

/// How friction has changed between two searches.
#[derive(Default)]
struct Tally {
    /// Force and limit (N) of pairs that are kept.
    used: Vec<(f64, f64)>,
    change: f64,
    /// Sum of the limits of the last search, and of those whose pairs are kept (N).
    before: f64,
    followed: f64,
}

impl Tally {
    fn and(mut self, other: Self) -> Self {
        self.used.extend(other.used);
        Self {
            used: self.used,
            change: self.change + other.change,
            before: self.before + other.before,
            followed: self.followed + other.followed,
        }
    }
}

impl Pair {
    /// The pair of a point of a hair and another hair, if they are near; it slides freely.
    fn new(
        of: &StrandProperties<'_>,
        points: &[DVec3],
        (own, point): (usize, usize),
        (strand, nearest): (u32, &Nearest),
    ) -> Option<Self> {
        let &Nearest { place, away, .. } = nearest;
        let at = place.first as usize;
        let distance = of.radii[own] + of.radii[strand as usize];
        if away.length_squared() > (distance * (1.0 + MARGIN)).powi(2) {
            return None;
        }
        // k e²/2D is the force scale of the softer hair at an overlap of OVERLAP D.
        let scale = of.force_scale[own].min(of.force_scale[strand as usize]);
        let stiffness = 2.0 * scale / (OVERLAP * OVERLAP * distance);
        let along = points[at + 1] - points[at];
        let normal = away.normalize_or(along.any_orthonormal_vector());
        let (limit, scales) = (0.0, [Scales::NONE; 2]);
        Some(Self {
            point: point as u32,
            strand,
            near: place.first + 1,
            distance,
            stiffness: 0.5 * of.shares[point] * stiffness * of.hardness,
            stick: Stick { limit, anchor: away, normal, scales, place },
        })
    }

    /// Takes over what stuck before, and the limit of the normal force as it is now. (F2), (F3)
    fn press(
        &mut self,
        of: &StrandProperties<'_>,
        points: &[DVec3],
        own: usize,
        known: &[Self],
        tally: &mut Tally,
    ) {
        let (a, b) = (of.friction[own], of.friction[self.strand as usize]);
        let coefficient = 0.5 * (a.hair + b.hair);
        if coefficient == 0.0 {
            return;
        }
        let Stick { normal, place, .. } = self.stick;
        let limit = coefficient * self.normal(self.stick.anchor.length()).1;
        let flat = |v: DVec3| (v - normal * normal.dot(v)).normalize_or_zero();
        let along = |at: usize| flat(points[at + 1] - points[at]);
        // The link that the place is on.
        let other = place.first as usize + usize::from(place.weights[2] > place.weights[0]);
        let scales = [
            Scales::new(along(self.point as usize - 1), a.against_scales),
            Scales::new(along(other), b.against_scales).of_other(),
        ];
        // As between wisps, half of the scales of either.
        self.stick.scales = scales.map(|scales| scales.weighed(0.5));
        let near = self.near;
        let same = |pair: &&Self| pair.strand == self.strand && pair.near.abs_diff(near) <= 1;
        if let Some(before) = known.iter().find(same) {
            let (slid, way) = (before.slid(points), before.way(points));
            tally.used.push((before.stick.limit * way.used(SLIP_DISTANCE), limit));
            tally.change += (before.stick.limit - limit).abs();
            tally.followed += before.stick.limit;
            if before.stick.limit > 0.0 {
                // It goes on from where it stuck, or from where it has slipped to.
                let left = slid * (SLIP_DISTANCE / way.length.max(SLIP_DISTANCE));
                self.stick.anchor -= left - normal * normal.dot(left);
            }
        } else {
            tally.change += limit;
        }
        self.stick.limit = limit;
    }
}
