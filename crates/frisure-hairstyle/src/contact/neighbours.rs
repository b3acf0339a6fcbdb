//! Wisps that repel each other where they overlap.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

use super::body::FrictionCoefficients;
use super::friction::{FrictionGap, Scales, directions};
use super::nearby::{NearLists, SearchPoint};
use super::sieve::{Run, Sieve, SievePoint};
use super::thickness::Thickness;
use super::wisp_friction::{Hold, Holds, Touching};
use crate::math::outer;
use crate::parallel;

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

    /// The same, with no radius at points of a piece (arc lengths, m) that is held in a braid: it presses on nothing there.
    pub(crate) fn braided(mut self, piece: Option<[f64; 2]>) -> Self {
        if let Some([from, to]) = piece {
            for (k, radius) in self.radii.iter_mut().enumerate() {
                if (from..=to).contains(&((k + 1) as f64 * self.spacing)) {
                    *radius = 0.0;
                }
            }
        }
        self
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
    /// The same points, for a first look at what is near.
    sieve: Sieve,
    /// Per guide, what its points may touch.
    nearby: NearLists,
    /// Per guide, the friction of its hair; empty without friction.
    friction: Vec<FrictionCoefficients>,
    /// Per guide, what sticks to its points; empty without friction.
    holds: Vec<Holds>,
}

/// Two points that touch, seen from the guide of the first, and the second derivative of their energy by the separation
/// of the two, which is `a aᵀ − b bᵀ − s I`: that by both points themselves, and minus that by one and the other.
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
    /// b (√(N/m)) of friction, which subtracts b bᵀ; zero but for what slips.
    slip: DVec3,
}

impl Contact {
    /// The second derivative times a relative displacement (m): a change of force (N).
    #[inline]
    pub(crate) fn apply(&self, displacement: DVec3) -> DVec3 {
        self.along * self.along.dot(displacement)
            - self.slip * self.slip.dot(displacement)
            - displacement * self.across
    }
}

impl ContactPairs {
    pub(crate) fn new(samples: Vec<Samples>, stiffness: f64) -> Self {
        let sieve = Sieve::new(samples.iter().map(|own| (&own.positions[..], &own.radii[..])));
        let (nearby, friction, holds) = (NearLists::default(), Vec::new(), Vec::new());
        Self { stiffness, samples, sieve, nearby, friction, holds }
    }

    /// The same with the friction of each guide's hair; without, if there is none.
    pub(crate) fn with_friction(self, friction: Vec<FrictionCoefficients>) -> Self {
        let rubs = friction.iter().any(|of| of.hair > 0.0);
        let friction = if rubs { friction } else { Vec::new() };
        Self { friction, ..self }
    }

    /// Takes over how wisps are pressed together where they are now: what touches sticks, what slipped is followed by its
    /// anchors. Returns how far each guide's forces of friction were from the law. docs/theory.md (F2), (F3)
    pub(crate) fn press(&mut self) -> Vec<FrictionGap> {
        let (holds, gaps) = self.pressed();
        self.holds = holds;
        gaps
    }

    /// How far each guide's forces of friction are from the law where wisps are now.
    pub(crate) fn friction_gaps(&self) -> Vec<FrictionGap> {
        self.pressed().1
    }

    fn pressed(&self) -> (Vec<Holds>, Vec<FrictionGap>) {
        if self.friction.is_empty() {
            return (Vec::new(), vec![FrictionGap::default(); self.samples.len()]);
        }
        let none = Holds::default();
        let along = parallel::map_slice(&self.samples, |own| directions(&own.positions));
        let pressed = parallel::map(self.samples.len(), |guide| {
            let (field, own) = (self.around(guide), &self.samples[guide]);
            let touching = (0..own.positions.len()).map(|k| field.touching(k, &along));
            let before = self.holds.get(guide).unwrap_or(&none);
            before.pressed(touching, own.spacing)
        });
        pressed.into_iter().unzip()
    }

    /// Moves the points of a guide; who may touch whom stays until [`Self::update_neighbours`]. Gives the
    /// largest distance that a point has moved (m).
    pub(crate) fn place(&mut self, guide: usize, positions: Vec<DVec3>) -> f64 {
        let moved = positions.iter().zip(&self.samples[guide].positions);
        let farthest = moved.map(|(p, q)| p.distance_squared(*q)).fold(0.0, f64::max);
        self.sieve.place(guide, &positions, &self.samples[guide].radii);
        self.samples[guide].positions = positions;
        farthest.sqrt()
    }

    /// Finds which points can touch while each guide moves by at most its margin (m) from where it
    /// is now, of guides that are looked at again, or from where it was when it last was.
    pub(crate) fn update_neighbours(&mut self, margins: &[f64], again: &[bool]) {
        self.nearby.update(&self.points(margins), again);
    }

    /// All points, guide by guide.
    fn points(&self, margins: &[f64]) -> Vec<SearchPoint> {
        let of = |(guide, s): (usize, &Samples)| {
            let point = |k: usize| SearchPoint {
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
        self.nearby.groups(order)
    }

    /// The guides that one guide may touch.
    pub(crate) fn touched_by(&self, guide: usize) -> impl Iterator<Item = usize> {
        self.nearby.of_guide(guide).guides()
    }

    /// Sets the stiffness of hair per length of hair (Pa).
    pub(crate) fn set_stiffness(&mut self, stiffness: f64) {
        self.stiffness = stiffness;
    }

    /// The contacts of one guide, in the order of its points.
    pub(crate) fn contacts(&self, guide: usize) -> Vec<Contact> {
        let own = &self.samples[guide];
        let mut contacts = Vec::new();
        for here in 0..self.nearby.of_guide(guide).points() {
            self.for_each_close(guide, here, own.positions[here], |other, there| {
                let samples = &self.samples[other as usize];
                let away = own.positions[here] - samples.positions[there];
                let reach = own.radii[here] + samples.radii[there];
                let square = 1.0 / (reach * reach);
                let overlap = 1.0 - away.length_squared() * square;
                if overlap > 0.0 {
                    // ∇²E of [`Neighbours::derivatives`], integrated along both guides.
                    let length = own.weight(here) * samples.weight(there);
                    let scale = 0.75 * self.stiffness * length / reach * overlap;
                    contacts.push(Contact {
                        point: here as u32,
                        other: (other, there as u32),
                        along: away * (4.0 * scale * square).sqrt(),
                        across: scale * overlap,
                        slip: DVec3::ZERO,
                    });
                }
            });
        }
        self.add_held_contacts(guide, &mut contacts);
        contacts
    }

    /// How far (m) the points of a guide are from where they begin to touch, or to leave, those of others; infinite where none is near.
    pub(crate) fn switch_distance(&self, guide: usize) -> f64 {
        let (own, near) = (&self.samples[guide], self.nearby.of_guide(guide));
        let gap = |(here, run): (u32, &Run)| {
            let (here, other) = (here as usize, &self.samples[run.guide as usize]);
            let points = run.first as usize..run.end as usize;
            // Without a radius nothing touches: a piece in a braid.
            points
                .map(|there| {
                    let reach = own.radii[here] + other.radii[there];
                    let away = own.positions[here].distance(other.positions[there]);
                    if reach > 0.0 { (away - reach).abs() } else { f64::INFINITY }
                })
                .fold(f64::INFINITY, f64::min)
        };
        near.iter().map(gap).fold(f64::INFINITY, f64::min)
    }

    /// Calls `close` with guide and point of what touches point `k` of a guide at `p` (m), and of a few that hardly do not.
    #[inline]
    fn for_each_close(&self, guide: usize, k: usize, p: DVec3, mut close: impl FnMut(u32, usize)) {
        let own = SievePoint::new(p, self.samples[guide].radii[k]);
        let near = self.nearby.of_guide(guide).of_point(k);
        self.sieve.for_each_close(own, near, |run, point| close(run.guide, point));
    }

    /// Adds those by which friction holds one guide.
    fn add_held_contacts(&self, guide: usize, contacts: &mut Vec<Contact>) {
        let Some(holds) = self.holds.get(guide) else { return };
        let own = &self.samples[guide];
        for here in 0..own.positions.len() {
            for hold in holds.of_point(here) {
                let away = own.positions[here] - self.position(hold.other);
                let (s, b, [c, d]) = hold.stiffness(away);
                let (length, point, other) = (own.weight(here), here as u32, hold.other);
                contacts.push(Contact {
                    point,
                    other,
                    along: c * length.sqrt(),
                    across: -s * length,
                    slip: b * length.sqrt(),
                });
                if d != DVec3::ZERO {
                    let along = d * length.sqrt();
                    contacts.push(Contact { point, other, along, across: 0.0, slip: DVec3::ZERO });
                }
            }
        }
    }

    /// Where a point of a guide is (m).
    fn position(&self, (guide, point): (u32, u32)) -> DVec3 {
        self.samples[guide as usize].positions[point as usize]
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
    /// What touches own point `k` now; `along` has the directions of all guides.
    fn touching(&self, k: usize, along: &[Vec<DVec3>]) -> Vec<Touching> {
        let own = &self.pairs.samples[self.guide];
        let mut touching = Vec::new();
        self.pairs.for_each_close(self.guide, k, own.positions[k], |guide, point| {
            let other = &self.pairs.samples[guide as usize];
            let away = own.positions[k] - other.positions[point];
            let reach = own.radii[k] + other.radii[point];
            let overlap = 1.0 - away.length_squared() / (reach * reach);
            if overlap > 0.0 {
                // |∇E| of [`Self::derivatives`].
                let scale = 0.75 * self.pairs.stiffness * other.weight(point) / reach;
                let guides = [self.guide, guide as usize];
                let of = guides.map(|guide| self.pairs.friction[guide]);
                touching.push(Touching {
                    other: (guide, point as u32),
                    separation: away,
                    force: scale * overlap * overlap * away.length(),
                    // Hair of two kinds: the mean, chosen.
                    coefficient: 0.5 * (of[0].hair + of[1].hair),
                    scales: [
                        Scales::new(along[self.guide][k], of[0].against_scales),
                        Scales::new(along[guides[1]][point], of[1].against_scales),
                    ],
                });
            }
        });
        touching
    }

    /// Calls `held` with the separation (m) of what sticks to the point at arc length `s`.
    #[inline]
    fn for_each_hold(&self, s: f64, p: DVec3, mut held: impl FnMut(DVec3, &Hold)) {
        let Some(holds) = self.pairs.holds.get(self.guide) else { return };
        let own = &self.pairs.samples[self.guide];
        let k = ((s / own.spacing).round() as usize).clamp(1, own.positions.len()) - 1;
        for hold in holds.of_point(k) {
            held(p - self.pairs.position(hold.other), hold);
        }
    }

    /// Calls `touch` with the separation (m), the sum of radii (m) and the length (m) of what
    /// touches the point at arc length `s`.
    #[inline]
    fn for_each_touch(&self, s: f64, p: DVec3, mut touch: impl FnMut(DVec3, f64, f64)) {
        let own = &self.pairs.samples[self.guide];
        // The field is evaluated at these points alone: rounding finds the one at s. Point 0 is one spacing from the root.
        let k = ((s / own.spacing).round() as usize).clamp(1, own.positions.len()) - 1;
        let radius = own.radii[k];
        self.pairs.for_each_close(self.guide, k, p, |guide, point| {
            let other = &self.pairs.samples[guide as usize];
            let reach = radius + other.radii[point];
            let away = p - other.positions[point];
            if away.length_squared() < reach * reach {
                touch(away, reach, self.share * other.weight(point));
            }
        });
    }
}

impl Field for Neighbours<'_> {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        let mut sum = 0.0;
        self.for_each_touch(s, p, |away, reach, length| {
            let overlap = 1.0 - away.length_squared() / (reach * reach);
            sum += length * reach * overlap.powi(3);
        });
        let mut rubbing = 0.0;
        self.for_each_hold(s, p, |away, hold| rubbing += self.share * hold.energy(away));
        0.125 * self.pairs.stiffness * sum + rubbing
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
        self.for_each_hold(s, p, |away, hold| {
            let (force, stiffness) = sum.get_or_insert((DVec3::ZERO, DMat3::ZERO));
            *force += hold.force(away) * self.share;
            *stiffness += hold.hessian(away) * self.share;
        });
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::sieve::LANES;
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

    /// A guide that winds among the others.
    fn winding(guide: u32, turn: f64) -> Samples {
        let (a, b) = (1.7 * f64::from(guide), 0.9 * f64::from(guide));
        let at = |k: u32| {
            let s = f64::from(k) * 2e-3;
            let away = DVec3::new(0.0, (a + 30.0 * s + turn).sin(), (b - 20.0 * s).cos());
            DVec3::X * s + 0.012 * away
        };
        Samples::new((1..=60).map(at).collect(), 2e-3, &wisp())
    }

    /// Guide and point of what a point may touch.
    fn found(pairs: &ContactPairs, guide: usize, k: usize) -> Vec<(u32, u32)> {
        let runs = pairs.nearby.of_guide(guide).of_point(k).iter();
        let mut found: Vec<_> =
            runs.flat_map(|run| (run.first..run.end).map(|p| (run.guide, p))).collect();
        found.sort_unstable();
        found
    }

    /// The same, by comparing with all points where they were.
    fn compared(seen: &[Samples], margins: &[f64], guide: usize, k: usize) -> Vec<(u32, u32)> {
        let own = &seen[guide];
        let near = |other: usize, point: usize| {
            let s = &seen[other];
            let reach = own.radii[k] + s.radii[point] + margins[guide] + margins[other];
            other != guide && own.positions[k].distance(s.positions[point]) < reach
        };
        let points = (0..seen.len()).flat_map(|g| (0..seen[g].radii.len()).map(move |p| (g, p)));
        points.filter(|&(g, p)| near(g, p)).map(|(g, p)| (g as u32, p as u32)).collect()
    }

    #[test]
    fn what_may_touch_is_what_comparing_all_points_finds() {
        let guides: Vec<Samples> = (0..24).map(|g| winding(g, 0.0)).collect();
        let margins: Vec<f64> = (0..24).map(|g| 1e-3 * f64::from(g % 5)).collect();
        let mut pairs = ContactPairs::new(guides.clone(), 1.0);
        pairs.update_neighbours(&margins, &[true; 24]);
        for (guide, k) in (0..24).flat_map(|g| (0..60).map(move |k| (g, k))) {
            assert_eq!(found(&pairs, guide, k), compared(&guides, &margins, guide, k));
        }
        // A third of the guides moves and is looked at again; the lists of the others keep what they have of each other.
        let again: Vec<bool> = (0..24).map(|g| g % 3 == 0).collect();
        let moved: Vec<Samples> =
            (0..24).map(|g| winding(g, if g % 3 == 0 { 0.4 } else { 0.0 })).collect();
        for guide in (0..24).step_by(3) {
            pairs.place(guide, moved[guide].positions.clone());
        }
        pairs.update_neighbours(&margins, &again);
        for (guide, k) in (0..24).flat_map(|g| (0..60).map(move |k| (g, k))) {
            assert_eq!(found(&pairs, guide, k), compared(&moved, &margins, guide, k));
        }
    }

    #[test]
    fn points_in_a_row_are_kept_as_few_runs() {
        let pairs = pairs(3e-3);
        let near = pairs.nearby.of_guide(0);
        let points: u32 = near.iter().map(|(_, run)| run.end - run.first).sum();
        // One that is not full where the guide passes out of reach, and full ones.
        let most = points as usize / LANES + near.points();
        assert!(near.iter().count() <= most && points > 5 * 100, "{points}");
    }
}
