//! The points of all wisps, how dense hair is at them, and how they press on each other.

use std::f64::consts::PI;
use std::ops::Range;

use glam::{DMat3, DVec3};

use super::kernel::Kernel;
use super::lanes::{CloseRun, SiteLanes};
use super::site::Site;
use crate::contact::nearby::{NearLists, SearchPoint};
use crate::contact::sieve::{Run, Sieve, SievePoint};
use crate::contact::thickness::Thickness;
use crate::math::outer;
use crate::parallel;

/// Reach of the kernel of two wisps, in the mean of their radii. Chosen: wide enough that some 16 wisps share it where hair is as
/// dense as it packs, so that the answer is smooth, and about as wide as hair is thick on a head.
const REACH: f64 = 4.0;

/// φ₀, the fraction of space that hair takes at which wisps begin to press on each other, where curls keep hairs apart. Chosen by
/// trial: with 2 wisps of straight hair jump for a millionth of its length, and with 1 a good part. docs/theory.md, "Density"
const ONSET: f64 = 2.5;

/// [`Thickness::springiness`] (Pa) from which hair is as hard as curls. Chosen: below that of wavy types (0.03 to 0.05; curly 0.15,
/// straight 0.002 to 0.003).
const SPRINGY: f64 = 0.025;

/// Fraction of space that fibres take at which straight hair begins to press, whose curl is too weak to keep them apart. Chosen:
/// parallel cylinders that touch take 0.91, those of a bundle in disorder some 0.8.
const SOLID: f64 = 0.8;

/// The stiffness of hair over the energy per volume at φ − φ₀ = 1. Chosen: the hydrostatic pressure of hair a centimetre high is
/// borne at φ − φ₀ of about a half.
const STIFFNESS_PER_MODULUS: f64 = 48.0;

/// The points of one guide at which density is evaluated: evenly spaced, without the root.
pub(crate) struct Strand {
    /// Distance between points along the guide (m).
    pub(crate) spacing: f64,
    pub(crate) positions: Vec<DVec3>,
    pub(crate) thickness: Thickness,
    /// The piece (arc lengths, m) that is held in a braid: it presses on nothing there, and nothing on it.
    pub(crate) braided: Option<[f64; 2]>,
}

/// All wisps of a head as a density.
pub(crate) struct Density {
    /// Where the points of each guide begin; one more than guides.
    pub(super) starts: Vec<usize>,
    /// Distance between points along each guide (m).
    pub(super) spacing: Vec<f64>,
    pub(super) points: Points,
    /// The points again, each with half of the reach of its kernel, for a first look at what is near.
    sieve: Sieve,
    /// The points once more, for sums over many of them.
    lanes: SiteLanes,
    /// What may be within reach of the points of each guide.
    near: NearLists,
    /// Fraction of space that hair takes at each point.
    pub(super) dense: Vec<f64>,
    /// Derivative (J) of the energy of each point by its density.
    pressure: Vec<f64>,
}

/// What is known of every point, in the order of guides.
pub(super) struct Points {
    /// The guide of each.
    pub(super) guide: Vec<u32>,
    /// Length of hair (m) that each stands for.
    pub(super) length: Vec<f64>,
    /// What others need of it.
    pub(super) sites: Vec<Site>,
    /// Fraction of space that its own wisp, straight, takes there.
    pub(super) own: Vec<f64>,
    /// Energy per volume (Pa) of its hair at an excess of 1.
    modulus: Vec<f64>,
    /// Fraction of space at which its hair begins to press.
    onset: Vec<f64>,
}

/// Stiffness of a wisp's hair, as a share of that of curls, and the fraction of space at which it begins to press, from those at the
/// arc length `s` (m). docs/theory.md (D5)
fn hardness(thickness: &Thickness, s: f64) -> (f64, f64) {
    // Squared: chosen by trial. In proportion to its springiness 11 of 150 wisps of `scenes/long-straight.toml` jump.
    let share = (thickness.springiness(s) / SPRINGY).min(1.0).powi(2);
    let solid = (SOLID / thickness.packing(s)).max(ONSET);
    (share, solid + (ONSET - solid) * share)
}

impl Points {
    /// The points of wisps; those of curls have the energy per volume `modulus` (Pa) at an excess of 1.
    fn new(strands: Vec<Strand>, modulus: f64) -> Self {
        let mut points = Self {
            guide: Vec::new(),
            length: Vec::new(),
            sites: Vec::new(),
            own: Vec::new(),
            modulus: Vec::new(),
            onset: Vec::new(),
        };
        for (guide, strand) in strands.into_iter().enumerate() {
            let last = strand.positions.len();
            let (share, onset) = hardness(&strand.thickness, 0.5 * strand.spacing * last as f64);
            for (k, position) in (1..=last).zip(strand.positions) {
                let s = k as f64 * strand.spacing;
                // The trapezoidal rule; the root, which is clamped, is no point.
                let length = if k == last { 0.5 * strand.spacing } else { strand.spacing };
                let radius = strand.thickness.at(s);
                let section = PI * radius * radius;
                // Radii far from the root, where a wisp begins with none: a kernel has a width everywhere.
                let half = 0.5 * REACH * strand.thickness.packed(s);
                points.guide.push(guide as u32);
                points.length.push(length);
                // What is held in a braid presses on nothing, and nothing on it.
                let is_in = |[from, to]: [f64; 2]| (from..=to).contains(&s);
                let braided = strand.braided.is_some_and(is_in);
                let volume = if braided { 0.0 } else { section * length };
                points.sites.push(Site { position, half_reach: half, volume });
                points.own.push(section * Kernel::new(2.0 * half).line());
                points.modulus.push(share * modulus);
                points.onset.push(onset);
            }
        }
        points
    }

    pub(super) fn len(&self) -> usize {
        self.guide.len()
    }
}

impl Density {
    /// Wisps as a density; `stiffness` is that of hair per length of hair (Pa).
    pub(crate) fn new(strands: Vec<Strand>, stiffness: f64) -> Self {
        let mut starts = vec![0];
        for strand in &strands {
            starts.push(starts[starts.len() - 1] + strand.positions.len());
        }
        let spacing = strands.iter().map(|strand| strand.spacing).collect();
        let points = Points::new(strands, stiffness / STIFFNESS_PER_MODULUS);
        let (dense, pressure) = (vec![0.0; points.len()], vec![0.0; points.len()]);
        let reaches: Vec<f64> = points.sites.iter().map(|site| site.half_reach).collect();
        let positions: Vec<DVec3> = points.sites.iter().map(|site| site.position).collect();
        let ranges = starts.windows(2).map(|w| w[0]..w[1]);
        let sieve = Sieve::new(ranges.map(|range| (&positions[range.clone()], &reaches[range])));
        let (lanes, near) = (SiteLanes::new(&points.sites), NearLists::default());
        Self { starts, spacing, points, sieve, lanes, near, dense, pressure }
    }

    /// The points of a guide.
    pub(super) fn of_guide(&self, guide: usize) -> Range<usize> {
        self.starts[guide]..self.starts[guide + 1]
    }

    /// Moves the points of a guide. [`Self::measure`] has to follow.
    pub(crate) fn place(&mut self, guide: usize, positions: &[DVec3]) {
        let range = self.of_guide(guide);
        for (k, &position) in range.clone().zip(positions) {
            self.place_point(k, position);
        }
    }

    /// Moves one point. [`Self::measure`] has to follow, or [`Self::set_dense`].
    pub(super) fn place_point(&mut self, k: usize, position: DVec3) {
        let site = &mut self.points.sites[k];
        site.position = position;
        self.sieve.place_point(k, position, site.half_reach);
        self.lanes.place_point(k, site);
    }

    /// Finds which points can come within reach while each guide moves by at most its margin (m) from where it is now, of guides that
    /// are looked at again, or from where it was when it last was.
    pub(crate) fn update_neighbours(&mut self, margins: &[f64], again: &[bool]) {
        let point = |k: usize| {
            let (site, guide) = (&self.points.sites[k], self.points.guide[k]);
            SearchPoint {
                position: site.position,
                reach: site.half_reach + margins[guide as usize],
                guide,
                index: (k - self.starts[guide as usize]) as u32,
            }
        };
        let points: Vec<SearchPoint> = (0..self.points.len()).map(point).collect();
        self.near.update(&points, again);
    }

    /// Guides in groups of which no two can come near each other, or near the same guide, taken in the given order.
    pub(crate) fn groups_apart(&self, order: &[usize]) -> Vec<Vec<usize>> {
        self.near.groups_apart(order)
    }

    /// Calls `close` with each point of another guide that is within reach of a point, and with some that hardly are not.
    #[inline]
    pub(super) fn for_each_close(&self, k: usize, close: impl FnMut(usize)) {
        self.for_each_close_to(k, &self.points.sites[k], close);
    }

    /// The same if the point were at another place, within the margin of the last search.
    #[inline]
    pub(super) fn for_each_close_to(&self, k: usize, at: &Site, mut close: impl FnMut(usize)) {
        let own = SievePoint::new(at.position, at.half_reach);
        self.sieve.for_each_close(own, self.near_to(k), |run, l| {
            close(self.starts[run.guide as usize] + l);
        });
    }

    /// What may be within reach of a point.
    fn near_to(&self, k: usize) -> &[Run] {
        let guide = self.points.guide[k] as usize;
        self.near.of_guide(guide).of_point(k - self.starts[guide])
    }

    /// The guides that may be within reach of one, in order.
    pub(super) fn near_guides(&self, guide: usize) -> impl Iterator<Item = usize> {
        self.near.of_guide(guide).guides()
    }

    /// Measures how dense hair is at every point where it is now.
    pub(crate) fn measure(&mut self) {
        let of_guide = |guide: usize| {
            let mut runs = Vec::new();
            let dense = self.of_guide(guide).map(|k| {
                let site = &self.points.sites[k];
                let own = SievePoint::new(site.position, site.half_reach);
                runs.clear();
                self.sieve.for_each_close_run(own, self.near_to(k), |run, close| {
                    let first = self.starts[run.guide as usize] + run.first as usize;
                    runs.push(CloseRun { first, close });
                });
                self.points.own[k] + self.lanes.density(site, &runs)
            });
            dense.collect::<Vec<f64>>()
        };
        self.dense = parallel::map(self.starts.len() - 1, of_guide).concat();
        self.pressure = (0..self.points.len()).map(|k| self.by_density(k).0).collect();
    }

    /// Sets the density at a point.
    pub(super) fn set_dense(&mut self, k: usize, dense: f64) {
        self.dense[k] = dense;
        self.pressure[k] = self.by_density(k).0;
    }

    /// How much denser than at the onset hair is at a point; 0 where it is not.
    pub(super) fn excess(&self, k: usize) -> f64 {
        self.excess_at(k, self.dense[k])
    }

    fn excess_at(&self, k: usize, dense: f64) -> f64 {
        (dense - self.points.onset[k]).max(0.0)
    }
}

/// A pair of points that press on each other, seen from the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) other: u32,
    /// ∇W by the own point (1/m⁴).
    pub(super) slope: DVec3,
    /// Of the pressure that both feel, `t I + q ∇W ∇Wᵀ` (N/m): t, and q (N m⁷).
    pub(super) across: f64,
    pub(super) along: f64,
    /// q of the part that stiffens, without t (N m⁷).
    pub(super) stiff: f64,
}

impl Density {
    /// Energy of a point (J). docs/theory.md (D2)
    pub(super) fn energy(&self, k: usize) -> f64 {
        self.energy_at(k, self.dense[k])
    }

    /// The same at another density.
    pub(super) fn energy_at(&self, k: usize, dense: f64) -> f64 {
        self.points.modulus[k] * self.points.sites[k].volume * self.excess_at(k, dense).powi(3)
    }

    /// First and second derivative of a point's energy by its density (J).
    #[inline]
    pub(super) fn by_density(&self, k: usize) -> (f64, f64) {
        let x = self.excess(k);
        let scale = self.points.modulus[k] * self.points.sites[k].volume;
        (3.0 * scale * x * x, 6.0 * scale * x)
    }

    /// Calls `pressed` with the pairs of a point that press on each other.
    #[inline]
    fn for_each_pair(&self, k: usize, mut pressed: impl FnMut(&Pair)) {
        let (site, own) = (&self.points.sites[k], self.pressure[k]);
        self.for_each_close(k, |l| {
            let (other, theirs) = (&self.points.sites[l], self.pressure[l]);
            if own <= 0.0 && theirs <= 0.0 {
                return;
            }
            let away = site.position - other.position;
            let distance = away.length();
            let (across, bend) = site.kernel(other).derivatives(distance);
            if across == 0.0 {
                return;
            }
            // Each feels the volume of the other: E′_k V_l + E′_l V_k.
            let pressure = own * other.volume + theirs * site.volume;
            let slope = away * across;
            let square = slope.length_squared();
            let along = if square > 0.0 { pressure * (bend - across) / square } else { 0.0 };
            // At the very centre both vanish together: W″ = W′/r.
            let along = if distance > 1e-9 { along } else { 0.0 };
            let stiff = if bend > 0.0 && square > 0.0 { pressure * bend / square } else { 0.0 };
            let across = pressure * across;
            pressed(&Pair { other: l as u32, slope, across, along, stiff });
        });
    }

    /// Gradient (N) of the energy by a point, and the part of its Hessian (N/m) that is positive semidefinite: what its own
    /// density and that of others make of it, and pairs that stiffen.
    pub(super) fn derivatives(&self, k: usize) -> Option<(DVec3, DMat3)> {
        self.derivatives_with(k, |_| ())
    }

    /// The same; calls `pressed` with the pairs.
    #[inline]
    pub(super) fn derivatives_with(
        &self,
        k: usize,
        mut pressed: impl FnMut(&Pair),
    ) -> Option<(DVec3, DMat3)> {
        let sites = &self.points.sites;
        let volume = sites[k].volume;
        let (own, own_bulk) = self.by_density(k);
        let mut sum: Option<(DVec3, DMat3)> = None;
        let mut gathered = DVec3::ZERO;
        self.for_each_pair(k, |pair| {
            let (force, stiffness) = sum.get_or_insert((DVec3::ZERO, DMat3::ZERO));
            let other = pair.other as usize;
            let (theirs, bulk) = self.by_density(other);
            *force += pair.slope * (own * sites[other].volume + theirs * volume);
            *stiffness += outer(pair.slope, pair.slope) * (bulk * volume * volume + pair.stiff);
            gathered += pair.slope * sites[other].volume;
            pressed(pair);
        });
        let (force, stiffness) = sum?;
        Some((force, stiffness + outer(gathered, gathered) * own_bulk))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::test_field::wisp;
    use frisure_rod::potential::Field;
    use glam::DQuat;

    /// Straight wisps along x through places in the plane across.
    fn lines(places: &[DVec3], points: u32, spacing: f64) -> Vec<Strand> {
        let line = |place: &DVec3| Strand {
            spacing,
            positions: (1..=points).map(|k| *place + DVec3::X * (spacing * f64::from(k))).collect(),
            thickness: wisp(),
            braided: None,
        };
        places.iter().map(line).collect()
    }

    fn measured(strands: Vec<Strand>) -> Density {
        let guides = strands.len();
        let mut density = Density::new(strands, 2.0);
        density.update_neighbours(&vec![1e-3; guides], &vec![true; guides]);
        density.measure();
        density
    }

    fn energy(density: &Density) -> f64 {
        (0..density.points.len()).map(|k| density.energy(k)).sum()
    }

    /// Ten wisps in a bundle that is much too narrow for them.
    fn bundle() -> Density {
        let place = |i: i32| {
            let angle = 2.4 * f64::from(i);
            DVec3::new(0.0, angle.cos(), angle.sin()) * (4e-4 * f64::from(i))
        };
        let places: Vec<DVec3> = (0..10).map(place).collect();
        measured(lines(&places, 12, 2e-3))
    }

    /// Forces (N), minus the gradient's sign: the derivative of the energy by every point.
    fn gradient(density: &Density) -> Vec<DVec3> {
        let of = |k| density.derivatives(k).map_or(DVec3::ZERO, |(gradient, _)| gradient);
        (0..density.points.len()).map(of).collect()
    }

    fn moved(density: &mut Density, step: &[DVec3], fraction: f64) {
        for (k, x) in step.iter().enumerate() {
            density.place_point(k, density.points.sites[k].position + *x * fraction);
        }
        density.measure();
    }

    /// Displacements (m) without order.
    fn step(count: usize) -> Vec<DVec3> {
        let at = |k: usize| {
            let x = k as f64;
            DVec3::new((3.1 * x).sin(), (1.7 * x).cos(), (0.9 * x + 1.0).sin()) * 1e-6
        };
        (0..count).map(at).collect()
    }

    #[test]
    fn the_gradient_is_the_derivative_of_the_energy_and_sums_to_zero() {
        let mut density = bundle();
        let gradient = gradient(&density);
        assert!((0..density.points.len()).filter(|&k| density.excess(k) > 0.1).count() > 20);
        let size = gradient.iter().map(|g| g.length()).sum::<f64>();
        // No force and no couple on the whole.
        let positions = density.points.sites.iter().map(|site| site.position);
        let sum: DVec3 = gradient.iter().sum();
        let couple: DVec3 = positions.zip(&gradient).map(|(p, g)| p.cross(*g)).sum();
        assert!(sum.length() < 1e-12 * size && couple.length() < 1e-14 * size, "{sum} {couple}");
        let step = step(gradient.len());
        let expected: f64 = gradient.iter().zip(&step).map(|(g, x)| g.dot(*x)).sum();
        moved(&mut density, &step, 1.0);
        let above = energy(&density);
        moved(&mut density, &step, -2.0);
        let slope = 0.5 * (above - energy(&density));
        assert!((slope / expected - 1.0).abs() < 1e-5, "{slope} {expected}");
    }

    #[test]
    fn the_variation_and_the_blocks_are_the_derivative_of_the_gradient() {
        let mut density = bundle();
        let (variation, step) = (density.variation(), step(density.points.len()));
        let guides: Vec<&[DVec3]> = step.chunks(12).collect();
        let others = variation.forces(&guides).concat();
        let own = |k: usize| density.derivatives(k).map_or(DMat3::ZERO, |(_, block)| block);
        let product: Vec<DVec3> = (0..step.len()).map(|k| others[k] + own(k) * step[k]).collect();
        moved(&mut density, &step, 1.0);
        let above = gradient(&density);
        moved(&mut density, &step, -2.0);
        let below = gradient(&density);
        let (mut error, mut size) = (0.0, 0.0);
        for ((a, b), p) in above.iter().zip(&below).zip(&product) {
            error += ((*a - *b) * 0.5 - *p).length();
            size += p.length();
        }
        assert!(error < 1e-4 * size, "{error} of {size}");
    }

    #[test]
    fn one_guide_that_moves_alone_changes_what_a_measure_of_all_finds() {
        let mut density = bundle();
        let others = |density: &Density| -> f64 {
            (0..density.points.len())
                .filter(|k| !(36..48).contains(k))
                .map(|k| density.energy(k))
                .sum()
        };
        let before = others(&density);
        // Across the bundle, and within the margin of the search.
        let positions = density.points.sites[36..48].iter().map(|site| site.position);
        let moved: Vec<DVec3> = positions.map(|p| p + DVec3::new(1e-4, 6e-4, -7e-4)).collect();
        let departure = density.departure(3);
        let arrival = density.arrival(&departure, &moved);
        let own: f64 = (0..12)
            .map(|k| density.around_at(3, &arrival).energy(2e-3 * f64::from(k + 1), moved[0]))
            .zip(&density.points.length[36..48])
            .map(|(energy, length)| energy * length)
            .sum();
        density.arrive(3, &moved, &arrival);
        let growth = arrival.growth;
        let (dense, pressure) = (density.dense.clone(), density.pressure.clone());
        density.measure();
        let expected = others(&density) - before;
        assert!(expected.abs() > 1e-3 * before, "{expected}");
        assert!((growth - expected).abs() < 1e-12 * before, "{growth} {expected}");
        let expected: f64 = (36..48).map(|k| density.energy(k)).sum();
        assert!((own - expected).abs() < 1e-12 * expected, "{own} {expected}");
        for (a, b) in dense.iter().zip(&density.dense) {
            assert!((a - b).abs() < 1e-13 * b, "{a} {b}");
        }
        assert!(
            pressure
                .iter()
                .zip(&density.pressure)
                .all(|(a, b)| (a - b).abs() <= 1e-12 * b.max(1e-12))
        );
    }

    #[test]
    fn turning_everything_turns_the_forces() {
        let turn = DQuat::from_rotation_z(0.83);
        let density = bundle();
        let strands = lines(&[DVec3::ZERO; 10], 12, 2e-3);
        let turned =
            strands.into_iter().zip(density.points.sites.chunks(12)).map(|(strand, sites)| {
                Strand {
                    positions: sites.iter().map(|site| turn * site.position).collect(),
                    ..strand
                }
            });
        let turned = measured(turned.collect());
        assert!((energy(&turned) / energy(&density) - 1.0).abs() < 1e-12);
        for (a, b) in gradient(&density).iter().zip(gradient(&turned)) {
            assert!((turn * *a).distance(b) < 1e-12 * (b.length() + 1e-9), "{a} {b}");
        }
    }

    #[test]
    fn a_lattice_has_the_density_and_the_pressure_of_its_packing() {
        // Parallel wisps, each alone on the area a²: the fraction of space is the cross-section over it, whatever the kernel.
        // Wisps grow thicker towards their tips: the one at the middle of the lattice counts.
        let (half, points, spacing) = (7, 40, 2.5e-3);
        let radius = wisp().packed(spacing * f64::from(points / 2 + 1));
        let section = PI * radius * radius;
        let lattice = |a: f64, b: f64| {
            let row = |i: i32| (-half..=half).map(move |j| (i, j));
            let places: Vec<DVec3> = (-half..=half)
                .flat_map(row)
                .map(|(i, j)| DVec3::new(0.0, a * f64::from(i), b * f64::from(j)))
                .collect();
            measured(lines(&places, points, spacing))
        };
        let middle = |density: &Density| {
            let guide = density.starts.len() / 2 - 1;
            density.starts[guide] + points as usize / 2
        };
        let side = (section / 3.1).sqrt();
        let density = lattice(side, side);
        let k = middle(&density);
        let onset = density.points.onset[k];
        assert!((density.excess(k) + onset - 3.1).abs() < 0.03, "{}", density.excess(k) + onset);
        // The energy per volume of hair Ψ/φ = m (φ − φ₀)³ gives the pressure P = φ² d(Ψ/φ)/dφ: what it takes to bring one
        // side of the cell nearer.
        let per_length = |density: &Density| {
            let k = middle(density);
            density.points.modulus[k] * section * density.excess(k).powi(3)
        };
        let h = 1e-3 * side;
        let force = (per_length(&lattice(side - h, side)) - per_length(&lattice(side + h, side)))
            / (2.0 * h);
        let pressure = force / side;
        let expected = 3.1_f64.powi(2) * 3.0 * density.points.modulus[k] * 0.6_f64.powi(2);
        assert!((pressure / expected - 1.0).abs() < 0.1, "{pressure} Pa, not {expected}");
    }
}
