//! A lock of fibres that stick to each other and slip as it bends: a yield on the bending strain of each element.
//!
//! docs/theory.md, "A lock that yields"

use glam::{DMat3, DVec2};

use super::term::{Derivatives, ElementState, Potential};
use crate::chain::{Chain, Shape};

/// How much stiffer a lock is while its fibres stick, and the moment at which they slip, at one place along it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct YieldLaw {
    /// Extra bending stiffness K_f (N m²) while fibres stick; none if it is not positive.
    pub stiffness: f64,
    /// Moment m_y (N m) at which they slip; none if it is not positive.
    pub moment: f64,
}

/// What is known of the fibres along a piece of a rod.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    law: YieldLaw,
    /// e_p: bending strain (1/m) beyond the natural one at which they stick without a moment.
    stuck: DVec2,
}

/// `min over e_p′ of ½ K_f |e − e_p′|² + m_y |e_p′ − e_p|` per length of rod, with the bending strain e of an element beyond its
/// natural one and the strain e_p at which its fibres stick: a Huber function of e, convex and once differentiable.
///
/// While |e − e_p| is less than m_y/K_f the rod is stiffer by K_f; beyond, it carries the moment m_y more. After a step of the load
/// [`Self::follow`] lets e_p follow what has slipped, so that a bend that is released leaves a set. Twist has no part in it.
///
/// ```
/// use frisure_rod::potential::{YieldLaw, Yielding};
/// use frisure_rod::*;
/// use glam::DVec3;
///
/// let spec = RodSpec {
///     length: 0.05,
///     section: Section::circular(35e-6)?,
///     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
///     torsion: TorsionConstant::SaintVenant,
///     natural: NaturalStrain::STRAIGHT,
///     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
///     load: Load::down(9.81),
/// };
/// let (loaded, free) = (Rod::new(spec.clone())?, Rod::new(RodSpec { load: Load::NONE, ..spec })?);
/// let options = Options { resolution: Resolution::Elements(20), estimate_error: false, ..Options::default() };
/// let straight = equilibrium(&free, &[], &options);
///
/// // Its fibres slip at a hundredth of the moment of its weight.
/// let moment = 5e-3 * loaded.weight() * loaded.length().powi(2);
/// let law = |_| YieldLaw { stiffness: 10.0 * loaded.stiffness().x, moment };
/// let mut lock = Yielding::stuck_at(&straight.chain(), &straight.shape, law);
/// let bent = equilibrium_from(&loaded, &[&lock], &options, &straight);
/// lock.follow(&bent.chain(), &bent.shape);
/// let released = equilibrium_from(&free, &[&lock], &options, &bent);
/// assert!(released.tip().z < -1e-4, "it keeps part of the bend");
/// # Ok::<(), InvalidQuantity>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Yielding {
    /// Length of each piece (m).
    step: f64,
    pieces: Vec<Piece>,
}

/// How the fibres of a lock hold at one shape.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct YieldState {
    /// Largest moment of any element over m_y: 1 where its fibres slip, 0 without any.
    pub ratio: f64,
    /// Share of the length that has fibres which stick whose moment is m_y, to rounding.
    pub slipping: f64,
}

/// Moment over m_y from which fibres count as slipping. Chosen: rounding.
const SLIPS: f64 = 1.0 - 1e-9;

impl Yielding {
    /// Fibres that stick as a shape of a divided rod has them, without a moment; `law` has theirs as a function of arc length (m).
    #[must_use]
    pub fn stuck_at(chain: &Chain<'_>, shape: &Shape, law: impl Fn(f64) -> YieldLaw) -> Self {
        let step = chain.rod().length() / chain.len() as f64;
        let piece = |i: usize| {
            let law = law((i as f64 + 0.5) * step);
            Piece { law, stuck: strain(&chain.element_state(shape, i)) }
        };
        Self { step, pieces: (0..chain.len()).map(piece).collect() }
    }

    /// The same fibres, which stick at the strains at which those of `before` do; `None` unless both have the same pieces.
    #[must_use]
    pub fn sticking_like(&self, before: &Self) -> Option<Self> {
        let same = self.step == before.step && self.pieces.len() == before.pieces.len();
        let pieces = self.pieces.iter().zip(&before.pieces);
        let pieces = pieces.map(|(new, old)| Piece { stuck: old.stuck, ..*new });
        same.then(|| Self { step: self.step, pieces: pieces.collect() })
    }

    /// Lets fibres that slipped on the way to a shape stick there at the moment m_y; returns the energy (J) that this has
    /// dissipated, `m_y |Δe_p|` per length. The shape is that of a division into as many elements as there were, or into a multiple.
    pub fn follow(&mut self, chain: &Chain<'_>, shape: &Shape) -> f64 {
        let mut strains = vec![(DVec2::ZERO, 0.0); self.pieces.len()];
        for i in 0..chain.len() {
            let element = chain.element_state(shape, i);
            let (sum, count) = &mut strains[self.index(&element)];
            *sum += strain(&element);
            *count += 1.0;
        }
        let mut dissipated = 0.0;
        for (piece, (sum, count)) in self.pieces.iter_mut().zip(strains) {
            if count == 0.0 || !piece.holds() {
                continue;
            }
            let away = sum / count - piece.stuck;
            let over = away.length() - piece.give();
            if over > 0.0 {
                piece.stuck += away.normalize() * over;
                dissipated += piece.law.moment * over * self.step;
            }
        }
        dissipated
    }

    /// How fibres hold at a shape.
    #[must_use]
    pub fn state(&self, chain: &Chain<'_>, shape: &Shape) -> YieldState {
        let (mut ratio, mut slipping, mut all) = (0.0_f64, 0.0, 0.0);
        for i in 0..chain.len() {
            let element = chain.element_state(shape, i);
            let piece = self.piece(&element);
            if piece.holds() {
                let used = (piece.away(&element).length() / piece.give()).min(1.0);
                ratio = ratio.max(used);
                all += element.length;
                slipping += if used >= SLIPS { element.length } else { 0.0 };
            }
        }
        YieldState { ratio, slipping: if all > 0.0 { slipping / all } else { 0.0 } }
    }

    /// Bending strain (1/m) beyond the natural one at which the fibres of each piece stick.
    pub fn stuck(&self) -> impl Iterator<Item = DVec2> {
        self.pieces.iter().map(|piece| piece.stuck)
    }

    fn index(&self, element: &ElementState<'_>) -> usize {
        // By the middle of the element, so that a division into a multiple of the pieces has them, too.
        let middle = element.end - 0.5 * element.length;
        ((middle / self.step) as usize).min(self.pieces.len() - 1)
    }

    fn piece(&self, element: &ElementState<'_>) -> &Piece {
        &self.pieces[self.index(element)]
    }
}

/// Bending strain (1/m) of an element beyond its natural one.
fn strain(element: &ElementState<'_>) -> DVec2 {
    (element.control - element.rest).truncate() / element.length
}

impl Piece {
    /// Whether fibres stick here at all.
    fn holds(&self) -> bool {
        self.law.stiffness > 0.0 && self.law.moment > 0.0
    }

    /// m_y/K_f: how far the strain (1/m) goes before they slip.
    fn give(&self) -> f64 {
        self.law.moment / self.law.stiffness
    }

    /// How far the strain (1/m) of an element is from where they stick.
    fn away(&self, element: &ElementState<'_>) -> DVec2 {
        strain(element) - self.stuck
    }
}

impl Potential for Yielding {
    fn depends_on_position(&self) -> bool {
        false
    }

    fn element_energy(&self, element: &ElementState<'_>) -> f64 {
        let piece = self.piece(element);
        if !piece.holds() {
            return 0.0;
        }
        let (away, give) = (piece.away(element).length(), piece.give());
        let YieldLaw { stiffness, moment } = piece.law;
        let density =
            if away <= give { 0.5 * stiffness * away * away } else { moment * (away - 0.5 * give) };
        density * element.length
    }

    fn add_element_derivatives(&self, element: &ElementState<'_>, sum: &mut Derivatives) {
        let piece = self.piece(element);
        if !piece.holds() {
            return;
        }
        let away = piece.away(element);
        let length = away.length();
        let YieldLaw { stiffness, moment } = piece.law;
        // ∂e/∂c = 1/h, so that the gradient of h H(e) by c is H′ and its Hessian H″/h.
        let (gradient, hessian) = if length <= piece.give() {
            (away * stiffness, [stiffness, 0.0, stiffness])
        } else {
            // m_y x̂, and m_y/|x| across x̂: what slips keeps the size of its moment.
            let along = away / length;
            let across = moment / length;
            let [xx, xy, yy] = [along.x * along.x, along.x * along.y, along.y * along.y];
            (along * moment, [across * (1.0 - xx), -across * xy, across * (1.0 - yy)])
        };
        sum.control += gradient.extend(0.0);
        let [xx, xy, yy] = hessian.map(|h| h / element.length);
        sum.control_control += DMat3::from_cols_array(&[xx, xy, 0.0, xy, yy, 0.0, 0.0, 0.0, 0.0]);
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::{
        ElementKind, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, SplitMix64,
        TorsionConstant,
    };

    fn curl() -> Rod {
        Rod::new(RodSpec {
            length: 0.1,
            section: Section::from_semi_axes(50e-6, 35e-6).unwrap(),
            material: Material::new(3e9, 1.1e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(0.01, 0.02).unwrap(),
            root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap(),
            load: Load::down(9.81),
        })
        .unwrap()
    }

    const LAW: YieldLaw = YieldLaw { stiffness: 3e-8, moment: 2e-7 };

    /// The natural shape with every control changed at random, by up to `size` (rad).
    fn shaken(chain: &Chain<'_>, size: f64, random: &mut SplitMix64) -> Shape {
        let natural = chain.natural_shape().controls;
        let mut x = || 2.0 * random.unit() - 1.0;
        chain.shape(natural.iter().map(|c| *c + DVec3::new(x(), x(), x()) * size).collect())
    }

    #[test]
    fn derivatives_agree_with_differences_where_fibres_stick_and_where_they_slip() {
        let (rod, mut random) = (curl(), SplitMix64(1));
        for kind in [ElementKind::Helix, ElementKind::Jointed] {
            let chain = Chain::uniform(&rod, kind, 8);
            let lock = Yielding::stuck_at(&chain, &chain.natural_shape(), |_| LAW);
            // m_y/K_f times the length of an element is 0.083 rad.
            for size in [0.03, 0.8] {
                let shape = shaken(&chain, size, &mut random);
                for i in 0..8 {
                    let at = |step: DVec3| {
                        let mut element = chain.element_state(&shape, i);
                        element.control += step;
                        let mut sum = Derivatives::ZERO;
                        lock.add_element_derivatives(&element, &mut sum);
                        (lock.element_energy(&element), sum)
                    };
                    let (_, exact) = at(DVec3::ZERO);
                    let h = 1e-5;
                    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                        let ((low, from), (high, to)) = (at(-axis * h), at(axis * h));
                        let slope = (high - low) / (2.0 * h);
                        assert!((slope - exact.control.dot(axis)).abs() < 1e-6 * LAW.moment);
                        let bend = (to.control - from.control) / (2.0 * h);
                        let gap = (bend - exact.control_control * axis).length();
                        assert!(gap < 1e-5 * LAW.stiffness / 0.0125, "{size} {i}: {gap}");
                    }
                }
            }
        }
    }

    #[test]
    fn energy_is_convex_in_the_controls() {
        let (rod, mut random) = (curl(), SplitMix64(2));
        let chain = Chain::uniform(&rod, ElementKind::Helix, 8);
        let lock = Yielding::stuck_at(&chain, &chain.natural_shape(), |_| LAW);
        for _ in 0..200 {
            let size = 0.5 * random.unit();
            let [a, b] = [(); 2].map(|()| shaken(&chain, size, &mut random));
            let middle = a.controls.iter().zip(&b.controls).map(|(a, b)| (*a + *b) * 0.5);
            let middle = chain.shape(middle.collect());
            let [a, b, middle] = [a, b, middle].map(|shape| chain.energy(&shape, &lock));
            assert!(middle <= 0.5 * (a + b) * (1.0 + 1e-12));
        }
    }

    #[test]
    fn the_energy_is_the_least_over_where_fibres_may_stick() {
        // The definition, by a search along the way to the shape.
        let rod = curl();
        let chain = Chain::uniform(&rod, ElementKind::Helix, 1);
        let natural = chain.natural_shape();
        let lock = Yielding::stuck_at(&chain, &natural, |_| LAW);
        for strain in [2.0, 15.0] {
            let shape = chain.shape(vec![natural.controls[0] + DVec3::X * (strain * 0.1)]);
            let paid = |stuck: f64| {
                0.5 * LAW.stiffness * (strain - stuck).powi(2) + LAW.moment * stuck.abs()
            };
            let least = (0..=4000).map(|k| paid(strain * f64::from(k) / 4000.0));
            let least = 0.1 * least.fold(f64::INFINITY, f64::min);
            assert!((chain.energy(&shape, &lock) / least - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn what_slipped_sticks_at_the_moment_at_which_it_slips() {
        let (rod, mut random) = (curl(), SplitMix64(3));
        let chain = Chain::uniform(&rod, ElementKind::Jointed, 8);
        let mut lock = Yielding::stuck_at(&chain, &chain.natural_shape(), |_| LAW);
        let shape = shaken(&chain, 0.8, &mut random);
        let moments = |lock: &Yielding| -> Vec<DVec3> {
            let of = |i| {
                let mut sum = Derivatives::ZERO;
                lock.add_element_derivatives(&chain.element_state(&shape, i), &mut sum);
                sum.control
            };
            (0..8).map(of).collect()
        };
        let (before, energy) = (moments(&lock), chain.energy(&shape, &lock));
        let dissipated = lock.follow(&chain, &shape);
        assert!(dissipated > 0.0 && lock.follow(&chain, &shape) < 1e-12 * dissipated);
        // What was paid is what is stored and what is lost.
        let stored = chain.energy(&shape, &lock);
        assert!((stored + dissipated - energy).abs() < 1e-12 * energy);
        for (before, after) in before.iter().zip(moments(&lock)) {
            assert!(before.distance(after) < 1e-12 * LAW.moment);
        }
        let state = lock.state(&chain, &shape);
        assert!((state.ratio - 1.0).abs() < 1e-12 && state.slipping > 0.5, "{state:?}");
    }
}
