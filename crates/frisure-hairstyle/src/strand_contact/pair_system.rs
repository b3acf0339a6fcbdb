//! Pairs as what couples hairs: their forces by points, and products with their stiffness.

use frisure_rod::batch::chain_factor::Symmetric;
use glam::DVec3;

use super::candidates::Candidates;
use super::curve::{Nearest, Place, farthest_from_links};
use super::interaction::{Interaction, InteractionSummary};
use super::layout::{Layout, split_mut};
use super::pairs::{Pair, PairForce, Pairs, StrandProperties};
use crate::parallel;

/// Share of what turning normals take away from the stiffness that is taken: with all of it, linear systems are often not positive
/// definite; with less, steps along the other hair are too short. Chosen by trial.
const TURNING: f64 = 0.8;

/// How far hairs may move until those near them are found anew, over the reach of a search. Chosen by trial; no result depends on it.
const SKIN: f64 = 0.5;

/// Share of hairs that may have moved farther, on the way: that they are at rest is only said without any. Chosen by trial.
const OUTDATED: f64 = 0.05;

/// The contacts of all hairs with each other.
pub(super) struct PairSystem<'a> {
    of: StrandProperties<'a>,
    pairs: Pairs,
    candidates: Candidates,
    forces: Vec<PairForce>,
    springs: Springs,
}

/// The stiffness of a pair between a point and a place on a line.
#[derive(Clone, Copy, Debug, Default)]
struct Spring {
    point: u32,
    place: Place,
    stiffness: Symmetric,
    turning: Turning,
}

/// What the normal force takes away from the stiffness of a pair as the normal turns: for the motion u of the point against the place on
/// the line, and Δ of the line's derivative by its parameter, `−(f/d) (|u|² − (n·u)² − (u·τ + (d/ℓ) n·Δ)²)`, with the direction τ of that
/// derivative and its length ℓ; without the last square where the place is an end of the line. What the bend of the line changes is left out. [D]
#[derive(Clone, Copy, Debug, Default)]
struct Turning {
    /// f/d (N/m).
    across: f64,
    normal: DVec3,
    along: DVec3,
    /// d/ℓ.
    lever: f64,
    /// The weights of the place's points in the derivative.
    slopes: [f64; 3],
}

impl Turning {
    fn new(pair: &Pair, nearest: &Nearest) -> Self {
        let distance = nearest.away.length().max(1e-12);
        let (across, normal) =
            (TURNING * pair.force_at(distance) / distance, nearest.away / distance);
        match nearest.along {
            Some((along, slopes)) => {
                let length = along.length().max(1e-12);
                Self { across, normal, along: along / length, lever: distance / length, slopes }
            }
            None => Self { across, normal, ..Self::default() },
        }
    }

    /// Adds to the force (N) on the point; returns that on the line's derivative, and the cost (J).
    #[inline]
    fn product(&self, apart: DVec3, turned: DVec3, force: &mut DVec3) -> (DVec3, f64) {
        let Self { across, normal: n, along, lever, .. } = *self;
        // u·τ + (d/ℓ) n·Δ: by how much the nearest place slides along the line.
        let slide = apart.dot(along) + lever * n.dot(turned);
        let by = apart - n * n.dot(apart) - along * slide;
        *force -= by * across;
        (n * (across * slide * lever), -across * (by.dot(apart) - lever * slide * n.dot(turned)))
    }
}

/// The stiffness of all pairs that have any.
#[derive(Default)]
struct Springs {
    springs: Vec<Spring>,
    /// Where those of the points of each chunk of hairs begin; one more than chunks.
    starts: Vec<usize>,
    /// Springs by the chunk of their places, and where those of each chunk begin.
    incoming: Vec<u32>,
    incoming_starts: Vec<usize>,
    /// Of each, in a product.
    forces: Vec<(DVec3, DVec3)>,
}

impl<'a> PairSystem<'a> {
    pub(super) fn new(of: StrandProperties<'a>) -> Self {
        Self {
            of,
            pairs: Pairs::default(),
            candidates: Candidates::default(),
            forces: Vec::new(),
            springs: Springs::default(),
        }
    }
}

impl Interaction for PairSystem<'_> {
    fn search(&mut self, points: &[DVec3], exact: bool) -> InteractionSummary {
        // Candidates are links: lines leave them by a little.
        let reach = Pairs::reach(&self.of) + farthest_from_links(self.of.layout, points);
        let skin = SKIN * reach;
        let most = if exact { 0.0 } else { OUTDATED };
        if self.candidates.outdated(self.of.layout, points, skin) > most {
            self.candidates = Candidates::new(self.of.layout, points, reach + 2.0 * skin);
        }
        let (pairs, summary) = self.pairs.search(&self.of, points, &self.candidates);
        self.pairs = pairs;
        summary
    }

    fn harden(&mut self, hardness: f64) {
        self.of.hardness = hardness;
    }

    fn add_forces(&mut self, points: &[DVec3], forces: &mut [DVec3]) -> f64 {
        let layout = self.of.layout;
        let energy = self.pairs.forces(layout, points, &mut self.forces);
        parallel::for_each_mut(&mut layout.by_point(forces), |index, forces| {
            let mut point = 0;
            for strand in layout.chunks()[index].clone() {
                let range = layout.points(strand);
                let own = &mut forces[point..point + range.len()];
                self.pairs.add_forces(strand, range.start, &self.forces, own);
                point += range.len();
            }
        });
        energy
    }

    fn linearise(&mut self, points: &[DVec3], own: &mut [Symmetric]) {
        self.springs.renew(&self.pairs, self.of.layout, points);
        self.springs.add_own(self.of.layout, own);
    }

    fn product(&mut self, motion: &[DVec3], forces: &mut [DVec3]) -> f64 {
        self.springs.product(self.of.layout, motion, forces)
    }
}

impl Springs {
    fn renew(&mut self, pairs: &Pairs, layout: &Layout, points: &[DVec3]) {
        let of_chunk = |chunk: &std::ops::Range<usize>| {
            let mut springs = Vec::new();
            for pair in chunk.clone().flat_map(|strand| pairs.of(strand)) {
                let (nearest, normal, friction) = pair.stiffness(layout, points);
                let turning = Turning::new(pair, &nearest);
                let mut push = |place, stiffness, turning| {
                    if stiffness != Symmetric::default() {
                        springs.push(Spring { point: pair.point, place, stiffness, turning });
                    }
                };
                // What presses acts at the nearest place of the line, friction at the place where the point stuck: one spring where both are the same.
                let stuck = pair.stuck_to();
                if stuck == nearest.place {
                    let mut both = normal;
                    both += friction;
                    push(stuck, both, turning);
                } else {
                    push(nearest.place, normal, turning);
                    push(stuck, friction, Turning::default());
                }
            }
            springs
        };
        let found = parallel::map_slice(layout.chunks(), of_chunk);
        self.springs.clear();
        self.starts.clear();
        self.starts.push(0);
        for some in found {
            self.springs.extend(some);
            self.starts.push(self.springs.len());
        }
        self.forces.resize(self.springs.len(), (DVec3::ZERO, DVec3::ZERO));
        // A counting sort by the chunk of the place.
        let ends: Vec<usize> =
            layout.chunks().iter().map(|c| layout.points(c.end - 1).end).collect();
        let chunk_of = |spring: &Spring| {
            ends.partition_point(|&end| end <= spring.place.first as usize) as u32
        };
        let chunk_of: Vec<u32> = parallel::map(ends.len(), |index| {
            let springs = &self.springs[self.starts[index]..self.starts[index + 1]];
            springs.iter().map(chunk_of).collect::<Vec<_>>()
        })
        .concat();
        let mut starts = vec![0; layout.chunks().len() + 1];
        chunk_of.iter().for_each(|&chunk| starts[chunk as usize + 1] += 1);
        (1..starts.len()).for_each(|k| starts[k] += starts[k - 1]);
        let mut next = starts.clone();
        self.incoming.resize(self.springs.len(), 0);
        for (k, &chunk) in chunk_of.iter().enumerate() {
            self.incoming[next[chunk as usize]] = k as u32;
            next[chunk as usize] += 1;
        }
        self.incoming_starts = starts;
    }

    /// Adds to the stiffness (N/m) of each point that of all springs while other points hold still.
    ///
    /// The weights of a place's points in a pair are lumped: `v vᵀ ≤ diag(v)` for shares v that sum to one.
    fn add_own(&self, layout: &Layout, own: &mut [Symmetric]) {
        parallel::for_each_mut(&mut layout.by_point(own), |index, own| {
            let first = layout.points(layout.chunks()[index].start).start;
            for spring in &self.springs[self.starts[index]..self.starts[index + 1]] {
                own[spring.point as usize - first] += spring.stiffness;
            }
            for &k in &self.incoming[self.incoming_starts[index]..self.incoming_starts[index + 1]] {
                let Spring { place, stiffness, .. } = self.springs[k as usize];
                let at = place.first as usize - first;
                for (own, weight) in own[at..].iter_mut().zip(place.weights) {
                    *own += stiffness * weight;
                }
            }
        });
    }

    fn product(&mut self, layout: &Layout, motion: &[DVec3], sum: &mut [DVec3]) -> f64 {
        let Self { springs, starts, incoming, incoming_starts, forces } = self;
        let mut pieces = split_mut(forces, starts.windows(2).map(|w| w[1] - w[0]));
        let costs = parallel::map_mut(&mut pieces, |index, forces| {
            let mut cost = 0.0;
            for (force, spring) in forces.iter_mut().zip(&springs[starts[index]..]) {
                // u = J p of the point less that of the place, then K u and uᵀ K u.
                let apart = motion[spring.point as usize] - spring.place.of(motion);
                let mut on = spring.stiffness * apart;
                cost += on.dot(apart);
                // What the turning normal takes away of it.
                let slopes = Place { weights: spring.turning.slopes, ..spring.place };
                let turned = slopes.of(motion);
                let (end, more) = spring.turning.product(apart, turned, &mut on);
                *force = (on, end);
                cost += more;
            }
            cost
        });
        // Forces on the points of each chunk, and their opposites on its places, each summed in the order of springs, whatever the threads.
        parallel::for_each_mut(&mut layout.by_point(sum), |index, sum| {
            let first = layout.points(layout.chunks()[index].start).start;
            sum.fill(DVec3::ZERO);
            for k in starts[index]..starts[index + 1] {
                sum[springs[k].point as usize - first] += forces[k].0;
            }
            for &k in &incoming[incoming_starts[index]..incoming_starts[index + 1]] {
                let (Spring { place, turning, .. }, (force, end)) =
                    (&springs[k as usize], forces[k as usize]);
                let at = place.first as usize - first;
                let weights = place.weights.into_iter().zip(turning.slopes);
                for (sum, (weight, slope)) in sum[at..].iter_mut().zip(weights) {
                    *sum -= force * weight - end * slope;
                }
            }
        });
        costs.iter().sum()
    }
}
