//! Wisps that repel each other where they overlap.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::thickness::Thickness;
use crate::math::{Grid, outer};

/// The points of one guide at which contact is evaluated: evenly spaced, without the root.
#[derive(Clone, Debug)]
pub(crate) struct Samples {
    /// Distance between points along the guide (m).
    spacing: f64,
    positions: Vec<DVec3>,
    /// Radius of the wisp at each point (m).
    radii: Vec<f64>,
}

impl Samples {
    /// Creates samples at positions (m) spaced by `spacing` (m), the first of them that far from the root.
    pub(crate) fn new(positions: Vec<DVec3>, spacing: f64, thickness: &Thickness) -> Self {
        let radius = |k: usize| thickness.at((k + 1) as f64 * spacing);
        let radii = (0..positions.len()).map(radius).collect();
        Self { spacing, positions, radii }
    }

    /// Length of hair (m) that a point stands for: half as much at the tip.
    fn weight(&self, k: usize) -> f64 {
        // The trapezoidal rule; the root, which is clamped, is no point.
        if k + 1 == self.positions.len() { 0.5 * self.spacing } else { self.spacing }
    }
}

/// All wisps of a head, and which points of them may touch.
pub(crate) struct ContactPairs {
    /// Stiffness of hair per length of hair (Pa).
    stiffness: f64,
    samples: Vec<Samples>,
    /// Per guide, what its points may touch.
    nearby: Vec<Nearby>,
}

/// What the points of one guide may touch.
#[derive(Clone, Debug, Default)]
struct Nearby {
    /// Where the touches of each point begin; one more than points.
    starts: Vec<u32>,
    /// Guide and point.
    touches: Vec<(u32, u32)>,
    /// The guides among them, in order.
    guides: Vec<u32>,
}

/// A point while neighbours are looked for.
#[derive(Clone, Copy)]
struct Point {
    position: DVec3,
    /// Radius and margin (m).
    reach: f64,
    guide: u32,
    index: u32,
}

/// Points of about the same reach, so that a few that reach far do not make all searches wide.
struct GridLevel {
    /// The largest of them (m).
    reach: f64,
    grid: Grid,
    /// In the order of the grid.
    points: Vec<Point>,
}

/// Levels, each for half the reach of the one before; the last for all that is less. No result depends on it.
const LEVELS: usize = 3;

impl GridLevel {
    fn sort(points: &[Point]) -> Vec<Self> {
        let most = points.iter().map(|p| p.reach).fold(0.0, f64::max);
        let mut levels = vec![Vec::new(); LEVELS];
        for p in points {
            // The bound (m) keeps the ratio finite; the cast takes the whole part.
            let halvings = (most / p.reach.max(1e-9)).log2() as usize;
            levels[halvings.min(LEVELS - 1)].push(*p);
        }
        levels.into_iter().filter(|points| !points.is_empty()).map(Self::new).collect()
    }

    fn new(points: Vec<Point>) -> Self {
        let reach = points.iter().map(|p| p.reach).fold(0.0, f64::max);
        let positions: Vec<DVec3> = points.iter().map(|p| p.position).collect();
        let grid = Grid::new(&positions, 2.0 * reach);
        let points = grid.order().iter().map(|&i| points[i as usize]).collect();
        Self { reach, grid, points }
    }

    /// Calls `found` with those that may be within reach of a point.
    fn for_each_near(&self, p: &Point, mut found: impl FnMut(&Point)) {
        let rings = self.grid.rings(p.reach + self.reach);
        for row in self.grid.rows(p.position, rings) {
            self.points[row].iter().for_each(&mut found);
        }
    }
}

/// Two points that touch, seen from the guide of the first, and the second derivative of their energy by the separation
/// of the two, which is `a aᵀ − s I`: that by both points themselves, and minus that by one and the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    /// Index of the own point.
    pub(crate) point: u32,
    /// The other guide, and the index of its point.
    pub(crate) other: (u32, u32),
    /// a (√(N/m)).
    along: DVec3,
    /// s (N/m).
    across: f64,
}

impl Contact {
    /// The second derivative times a relative displacement (m): a change of force (N).
    #[inline]
    pub(crate) fn apply(&self, displacement: DVec3) -> DVec3 {
        self.along * self.along.dot(displacement) - displacement * self.across
    }
}

/// A point of one guide, and guide and point of what it may touch.
type Touch = (u32, (u32, u32));

impl Nearby {
    /// What the points `own` of one guide may touch.
    fn search(own: &[Point], levels: &[GridLevel]) -> Self {
        let mut found = Vec::new();
        for p in own {
            for level in levels {
                level.for_each_near(p, |q| {
                    let reach = p.reach + q.reach;
                    // Radii and margins of both: neither can come to touch the other before its margin is used up.
                    let near = q.position.distance_squared(p.position) < reach * reach;
                    if near && q.guide != p.guide {
                        found.push((p.index, (q.guide, q.index)));
                    }
                });
            }
        }
        Self::new(found, own.len())
    }

    fn new(mut found: Vec<Touch>, points: usize) -> Self {
        // Of runs that are in order already.
        found.sort_by_key(|t| t.0);
        let start = |k: usize| found.partition_point(|t| (t.0 as usize) < k) as u32;
        let starts = (0..=points).map(start).collect();
        let touches: Vec<(u32, u32)> = found.into_iter().map(|t| t.1).collect();
        let mut guides: Vec<u32> = touches.iter().map(|t| t.0).collect();
        guides.sort_unstable();
        guides.dedup();
        Self { starts, touches, guides }
    }

    fn points(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    fn of_point(&self, k: usize) -> &[(u32, u32)] {
        &self.touches[self.starts[k] as usize..self.starts[k + 1] as usize]
    }

    fn iter(&self) -> impl Iterator<Item = Touch> {
        (0..self.points()).flat_map(|k| self.of_point(k).iter().map(move |t| (k as u32, *t)))
    }

    /// The same, but for what it may touch of those guides that were looked at again.
    fn amended(self, met: Vec<Touch>, again: &[bool]) -> Self {
        if met.is_empty() && !self.guides.iter().any(|&g| again[g as usize]) {
            return self;
        }
        let stays = |t: &Touch| !again[t.1.0 as usize];
        Self::new(self.iter().filter(stays).chain(met).collect(), self.points())
    }
}

impl ContactPairs {
    pub(crate) fn new(samples: Vec<Samples>, stiffness: f64) -> Self {
        Self { stiffness, samples, nearby: Vec::new() }
    }

    /// Moves the points of a guide; who may touch whom stays until [`Self::update_neighbours`]. Gives the
    /// largest distance that a point has moved (m).
    pub(crate) fn place(&mut self, guide: usize, positions: Vec<DVec3>) -> f64 {
        let moved = positions.iter().zip(&self.samples[guide].positions);
        let farthest = moved.map(|(p, q)| p.distance_squared(*q)).fold(0.0, f64::max);
        self.samples[guide].positions = positions;
        farthest.sqrt()
    }

    /// Finds which points can touch while each guide moves by at most its margin (m) from where it
    /// is now, of guides that are looked at again, or from where it was when it last was.
    pub(crate) fn update_neighbours(&mut self, margins: &[f64], again: &[bool]) {
        let points = self.points(margins);
        let levels = GridLevel::sort(&points);
        let found: Vec<Option<Nearby>> = points
            .par_chunk_by(|a, b| a.guide == b.guide)
            .map(|own| again[own[0].guide as usize].then(|| Nearby::search(own, &levels)))
            .collect();
        // A touch belongs to both guides: what a search found is entered with those that were not searched, too. So the
        // energy of a pair is the same from either side.
        let mut met: Vec<Vec<Touch>> = vec![Vec::new(); found.len()];
        for (guide, near) in found.iter().enumerate() {
            for (k, (other, point)) in near.iter().flat_map(Nearby::iter) {
                if !again[other as usize] {
                    met[other as usize].push((point, (guide as u32, k)));
                }
            }
        }
        let mut before = std::mem::take(&mut self.nearby);
        before.resize_with(found.len(), Nearby::default);
        let kept = found.into_par_iter().zip(before).zip(met);
        self.nearby = kept
            .map(|((found, before), met)| found.unwrap_or_else(|| before.amended(met, again)))
            .collect();
    }

    /// All points, guide by guide.
    fn points(&self, margins: &[f64]) -> Vec<Point> {
        let of = |(guide, s): (usize, &Samples)| {
            let point = |k: usize| Point {
                position: s.positions[k],
                reach: s.radii[k] + margins[guide],
                guide: guide as u32,
                index: k as u32,
            };
            (0..s.positions.len()).map(point).collect::<Vec<_>>()
        };
        self.samples.iter().enumerate().flat_map(of).collect()
    }

    /// Guides in groups of which no two may touch, taken in the given order.
    pub(crate) fn groups(&self, order: &[usize]) -> Vec<Vec<usize>> {
        const NONE: usize = usize::MAX;
        let mut group = vec![NONE; self.samples.len()];
        let mut groups: Vec<Vec<usize>> = Vec::new();
        // Greedy colouring of the graph of touches: the first group in which no neighbour is.
        for &guide in order {
            let taken: Vec<usize> =
                self.nearby[guide].guides.iter().map(|&g| group[g as usize]).collect();
            let free = (0..=groups.len()).find(|g| !taken.contains(g)).unwrap_or(groups.len());
            if free == groups.len() {
                groups.push(Vec::new());
            }
            group[guide] = free;
            groups[free].push(guide);
        }
        groups
    }

    /// The guides that one guide may touch.
    pub(crate) fn touched_by(&self, guide: usize) -> impl Iterator<Item = usize> {
        self.nearby[guide].guides.iter().map(|&g| g as usize)
    }

    /// Sets the stiffness of hair per length of hair (Pa).
    pub(crate) fn set_stiffness(&mut self, stiffness: f64) {
        self.stiffness = stiffness;
    }

    /// The contacts of one guide, in the order of its points.
    pub(crate) fn contacts(&self, guide: usize) -> Vec<Contact> {
        let (own, near) = (&self.samples[guide], &self.nearby[guide]);
        let mut contacts = Vec::new();
        for (k, other) in near.iter() {
            let samples = &self.samples[other.0 as usize];
            let (here, there) = (k as usize, other.1 as usize);
            let away = own.positions[here] - samples.positions[there];
            let reach = own.radii[here] + samples.radii[there];
            let square = 1.0 / (reach * reach);
            let overlap = 1.0 - away.length_squared() * square;
            if overlap > 0.0 {
                // ∇²E of [`Neighbours::derivatives`], integrated along both guides.
                let length = own.weight(here) * samples.weight(there);
                let scale = 0.75 * self.stiffness * length / reach * overlap;
                contacts.push(Contact {
                    point: k,
                    other,
                    along: away * (4.0 * scale * square).sqrt(),
                    across: scale * overlap,
                });
            }
        }
        contacts
    }

    /// The contact energy of one guide with the others.
    pub(crate) fn around(&self, guide: usize) -> Neighbours<'_> {
        Neighbours { pairs: self, guide, share: 1.0 }
    }

    /// Half of it: a sum over all guides counts each pair once.
    pub(crate) fn shared(&self, guide: usize) -> Neighbours<'_> {
        Neighbours { pairs: self, guide, share: 0.5 }
    }
}

/// The other wisps around one wisp, as a field in which its guide lies.
///
/// Two wisps of radii a pay for overlapping with
///
/// ```text
/// E = ∫∫ (k D / 8) max(0, 1 − r²/D²)³ ds ds′,      D = a(s) + a(s′),
/// ```
///
/// r the distance of a point of one to a point of the other. Hair is soft where wisps begin to touch
/// and stiffens as they are pressed together (van Wyk 1946 found the pressure of fibres to grow with
/// the cube of their density); the energy is smooth, also where two guides cross, and it is the same
/// seen from either side.
#[derive(Clone, Copy)]
pub struct Neighbours<'a> {
    pairs: &'a ContactPairs,
    guide: usize,
    /// How much of the energy counts.
    share: f64,
}

impl Neighbours<'_> {
    /// Calls `touch` with the separation (m), the sum of radii (m) and the length (m) of what
    /// touches the point at arc length `s`.
    #[inline]
    fn for_each_touch(&self, s: f64, p: DVec3, mut touch: impl FnMut(DVec3, f64, f64)) {
        let own = &self.pairs.samples[self.guide];
        let near = &self.pairs.nearby[self.guide];
        // The field is evaluated at these points alone: rounding finds the one at s. Point 0 is one spacing from the root.
        let k = ((s / own.spacing).round() as usize).clamp(1, own.positions.len()) - 1;
        let radius = own.radii[k];
        for &(guide, point) in near.of_point(k) {
            let other = &self.pairs.samples[guide as usize];
            let point = point as usize;
            let reach = radius + other.radii[point];
            let away = p - other.positions[point];
            if away.length_squared() < reach * reach {
                touch(away, reach, self.share * other.weight(point));
            }
        }
    }
}

impl Field for Neighbours<'_> {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        let mut sum = 0.0;
        self.for_each_touch(s, p, |away, reach, length| {
            let overlap = 1.0 - away.length_squared() / (reach * reach);
            sum += length * reach * overlap.powi(3);
        });
        0.125 * self.pairs.stiffness * sum
    }

    fn derivatives(&self, s: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let mut sum: Option<(DVec3, DMat3)> = None;
        self.for_each_touch(s, p, |away, reach, length| {
            // With o = 1 − r²/D²: E = (k D/8) o³, ∇E = −(¾ k/D) o² r, ∇²E = (¾ k/D) o (4 r rᵀ/D² − o I).
            let square = 1.0 / (reach * reach);
            let overlap = 1.0 - away.length_squared() * square;
            let scale = 0.75 * self.pairs.stiffness * length / reach * overlap;
            let (force, stiffness) = sum.get_or_insert((DVec3::ZERO, DMat3::ZERO));
            *force -= away * (scale * overlap);
            *stiffness += outer(away, away) * (4.0 * scale * square)
                - DMat3::from_diagonal(DVec3::splat(scale * overlap));
        });
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::test_field::{agrees_with_differences, wisp};

    /// A straight guide along x through `offset`, of 100 points.
    fn line(offset: DVec3) -> Samples {
        let points = (1..=100).map(|k| offset + DVec3::X * f64::from(k) * 1e-3).collect();
        Samples::new(points, 1e-3, &wisp())
    }

    fn pairs(gap: f64) -> ContactPairs {
        let mut pairs = ContactPairs::new(vec![line(DVec3::ZERO), line(DVec3::Y * gap)], 2.0);
        pairs.update_neighbours(&[1e-3, 0.0], &[true; 2]);
        pairs
    }

    fn energy(pairs: &ContactPairs, guide: usize) -> f64 {
        let (field, own) = (pairs.around(guide), &pairs.samples[guide]);
        let point = |k: usize| (k + 1) as f64 * own.spacing;
        (0..100).map(|k| own.weight(k) * field.energy(point(k), own.positions[k])).sum()
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let pairs = pairs(3e-3);
        let p = DVec3::new(0.0501, 3e-4, -4e-4);
        agrees_with_differences(&pairs.around(0), 0.05, p);
    }

    #[test]
    fn contacts_add_up_to_the_second_derivative() {
        let pairs = pairs(3e-3);
        let (own, k) = (&pairs.samples[0], 49);
        let (_, hessian) = pairs.around(0).derivatives(0.05, own.positions[k]).unwrap();
        let displacement = DVec3::new(0.3, -0.5, 0.2);
        let contacts = pairs.contacts(0);
        let at_point = contacts.iter().filter(|contact| contact.point == k as u32);
        let sum: DVec3 = at_point.map(|contact| contact.apply(displacement)).sum();
        let expected = hessian * displacement * own.weight(k);
        assert!(sum.distance(expected) < 1e-12 * expected.length(), "{sum} {expected}");
        // From either side the same pairs.
        assert_eq!(contacts.len(), pairs.contacts(1).len());
    }

    #[test]
    fn both_sides_see_the_same_energy() {
        let pairs = pairs(3e-3);
        assert!(energy(&pairs, 0) > 0.0);
        assert!((energy(&pairs, 0) / energy(&pairs, 1) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn parallel_wisps_pay_as_their_overlap_says() {
        // ∫ (k D/8)(1 − (d² + z²)/D²)³ dz = (k D/8)(32/35) (1 − d²/D²)^{7/2} D, far from the ends.
        let radius = wisp().at(0.05);
        let (d, reach) = (1.4 * radius, 2.0 * radius);
        let exact = 2.0 * reach * reach / 8.0 * 32.0 / 35.0 * (1.0 - 0.49_f64).powf(3.5);
        let found = pairs(d).around(0).energy(0.05, DVec3::X * 0.05);
        assert!((found / exact - 1.0).abs() < 0.02, "{found} {exact}");
    }

    #[test]
    fn wisps_apart_do_not_feel_each_other_and_share_a_group() {
        let apart = pairs(0.05);
        assert_eq!(energy(&apart, 0), 0.0);
        assert_eq!(apart.groups(&[0, 1]), [vec![0, 1]]);
        assert_eq!(pairs(3e-3).groups(&[1, 0]), [vec![1], vec![0]]);
    }
}
