//! Derivatives of a head at rest: how all guides move together when fibres, gravity or contact change.
//!
//! The equations are (D1) and (D2) of docs/theory.md with the Hessian H of all guides together, (H1), in place of that of one rod; conjugate gradients
//! solve them, preconditioned by each guide's own factor. docs/theory.md (D7)

use frisure_progress::{Progress, StageCounter};
use frisure_rod::Shape;
use frisure_rod::derivatives::{
    DerivativeError, ParameterChange, ParameterGradient, Regularity, Sensitivity, ShapeChange,
};
use frisure_rod::minimise::SecondVariation;
use glam::DVec3;
use std::fmt;
use thiserror::Error;

use super::super::friction_solver::Hold;
use super::certificate::{LowestEigenvalue, lowest_eigenvalue};
use super::hessian::{Controls, JointHessian, Preconditioner, add, add_scaled, dot, zero};
use super::newton::minimise;
use super::state::HeadState;
use crate::contact::SwitchDistance;
use crate::hairstyle::Hairstyle;
use crate::head::Head;

/// Relative gradient to which the head is brought to rest; rounding of contact between wisps often ends it before. Chosen.
const POLISHED: f64 = 1e-12;

/// Most steps of that. A guard; two or three are usual from a head that was certified.
const MOST_STEPS: usize = 20;

/// Relative gradient above which a head is not at rest. That of its certificate: EI/L + ρSgL² times this moves no tip by a micrometre.
const AT_REST: f64 = 1e-8;

/// Residual of the linear equations in the norm of the preconditioner, relative to the right side, and the most iterations. Chosen: far below the error
/// that a gradient of [`AT_REST`] leaves.
const RESIDUAL: f64 = 1e-11;
const MOST_CG: usize = 5000;

/// Lowest eigenvalue, relative to that of each guide while the others hold still, below which derivatives are ill-conditioned. Chosen as that of one rod.
const LEAST_EIGENVALUE: f64 = 1e-3;

/// Why a head has no derivatives.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HeadDerivativeError {
    /// Where friction holds hair depends on how it came there.
    #[error(
        "hair with friction has no derivatives: it rests where it stuck; set contact.friction, contact.skin_friction and contact.lock_friction to 0, and use \
         no product"
    )]
    Friction,
    /// The head does not come to rest as exactly as derivatives need.
    #[error(
        "the head is not at rest: its relative gradient is {gradient}; it must be at most {AT_REST}. Wisps that touch come to rest with \
         equilibrium.method = \"continuation\""
    )]
    NotAtRest {
        /// Relative gradient of the head, see [`crate::JointCertificate::gradient_norm`].
        gradient: f64,
    },
    /// The second variation of the head is not positive definite.
    #[error("the head is not at a minimum: its second variation is not positive")]
    NotAMinimum,
    /// Conjugate gradients do not converge.
    #[error(
        "the equations of the derivatives are not solved: the residual is {residual} of the right side; are all numbers finite?"
    )]
    NotSolved {
        /// What is left of the right side, in the norm of the preconditioner.
        residual: f64,
    },
    /// There is not one entry for each guide.
    #[error("there are {given} entries; the head has {guides} guides")]
    Guides {
        /// How many were given.
        given: usize,
        /// How many there are.
        guides: usize,
    },
    /// A root moves by itself.
    #[error(
        "guide {guide}: the root has no derivative by itself; see `rotation` for the head as a whole"
    )]
    Root {
        /// Which one.
        guide: usize,
    },
    /// What is wrong with one guide.
    #[error("guide {guide}: {error}")]
    Guide {
        /// Which one.
        guide: usize,
        /// What is wrong.
        error: DerivativeError,
    },
    /// The work was cancelled.
    #[error("cancelled")]
    Cancelled,
}

/// A change of what a head of hair is made of; zero by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeadChange {
    /// Change of natural strain, stiffness and load of each guide, in the order of [`Hairstyle::guides`]; empty for none. Roots and lengths have none.
    pub guides: Vec<ParameterChange>,
    /// Change of the stiffness of hair per length of hair (Pa), `contact.hair_stiffness`.
    pub hair_stiffness: f64,
    /// Change of the stiffness of skin per length of hair (Pa), `contact.stiffness`.
    pub skin_stiffness: f64,
    /// Rotation (rad, world) of the head about the origin, with all that holds and pulls its hair, while gravity stays.
    pub rotation: DVec3,
}

/// The derivative of a number by what a head of hair is made of; units are those of the number over those of [`HeadChange`].
#[derive(Clone, Debug, PartialEq)]
pub struct HeadGradient {
    /// By natural strain, stiffness and load of each guide. `length` is `None`, and what concerns the root is zero: it has no derivative by itself.
    pub guides: Vec<ParameterGradient>,
    /// By the stiffness of hair (1/Pa).
    pub hair_stiffness: f64,
    /// By the stiffness of skin (1/Pa). Where a tight curl needs firmer skin than the description gives it, it has that whatever the description says.
    pub skin_stiffness: f64,
    /// By a rotation of the head about the origin.
    pub rotation: DVec3,
}

impl HeadGradient {
    /// The derivative along a change.
    #[must_use]
    pub fn along(&self, change: &HeadChange) -> f64 {
        let guides = self.guides.iter().zip(&change.guides);
        guides.map(|(gradient, change)| gradient.along(change)).sum::<f64>()
            + self.hair_stiffness * change.hair_stiffness
            + self.skin_stiffness * change.skin_stiffness
            + self.rotation.dot(change.rotation)
    }
}

/// A head of hair at rest with the second variation of all guides together, from which its derivatives follow.
///
/// Contact with skin and with other hair, combs and clips push and pull as their laws say where the guides move; numbers that the program derives from a
/// fibre besides its rod (the thickness of its wisp, the bed of hair beneath it, the force that holds combed hair, firmer skin under tight curls) stay as they
/// are. Where the second derivative of a contact jumps, as where a guide just touches skin, the derivatives are those of the side on which the head is:
/// [`Self::switch_distances`] says how near each guide is to that.
///
/// ```
/// use frisure_hairstyle::{HeadSensitivity, PredictOptions, head::Head, predict, preset};
/// use frisure_rod::derivatives::ShapeChange;
/// use glam::DVec3;
///
/// let mut spec = preset("wavy").expect("a preset").spec();
/// spec.wisps.count = 20; // few guides: quick
/// let head = Head::mannequin();
/// let hairstyle = predict(&spec, &head, PredictOptions::default(), &())?;
/// let at_rest = HeadSensitivity::new(&hairstyle, &head, &())?;
///
/// // The height of the first guide's tip, by the curl of all guides.
/// let mut loss = at_rest.no_change();
/// *loss[0].positions.last_mut().expect("nodes") = DVec3::Z;
/// let gradient = at_rest.vjp(&loss)?;
/// assert!(gradient.guides[0].uniform_strain().length() > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct HeadSensitivity {
    guides: Vec<Sensitivity>,
    hessian: JointHessian,
    /// ∂g/∂p (N m/Pa) by the stiffness of hair and by that of skin.
    by_stiffness: [Controls; 2],
    gradient_norm: f64,
    lowest: LowestEigenvalue,
    switches: Vec<SwitchDistance>,
}

impl fmt::Debug for HeadSensitivity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("HeadSensitivity")
            .field("guides", &self.guides.len())
            .field("gradient_norm", &self.gradient_norm)
            .field("lowest", &self.lowest)
            .finish_non_exhaustive()
    }
}

impl HeadSensitivity {
    /// Brings a head to rest as far as rounding allows, from where it is.
    ///
    /// # Errors
    /// [`HeadDerivativeError`], if hair has friction, if the head does not come to rest or is at no minimum, or if the work is
    /// cancelled.
    pub fn new(
        hairstyle: &Hairstyle,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<Self, HeadDerivativeError> {
        let Hairstyle { spec, guides, rest, .. } = hairstyle;
        let rubs = |guide: &crate::guides::Guide| {
            let friction = guide.friction;
            !friction.is_zero() || friction.lock != 0.0 || friction.lock_cohesion != 0.0
        };
        if guides.iter().any(rubs) {
            return Err(HeadDerivativeError::Friction);
        }
        let mut state = HeadState::new(spec, head, guides, &rest.guides, Hold::Free);
        let stage = StageCounter::new(progress, "bringing the head to rest", 1);
        minimise(&mut state, POLISHED, MOST_STEPS, &stage)
            .map_err(|_| HeadDerivativeError::Cancelled)?;
        let hessian = state.hessian();
        let gradient = state.relative(&hessian.gradient());
        if !(gradient <= AT_REST) {
            return Err(HeadDerivativeError::NotAtRest { gradient });
        }
        let lowest = Preconditioner::new(&hessian)
            .filter(|preconditioner| preconditioner.exact)
            .map(|preconditioner| lowest_eigenvalue(&hessian, &preconditioner, spec.seed))
            .filter(|lowest| lowest.value > lowest.error)
            .ok_or(HeadDerivativeError::NotAMinimum)?;
        Ok(Self {
            guides: state.sensitivities().map_err(|(guide, error)| in_guide(guide)(error))?,
            by_stiffness: state.gradients_by_stiffness(spec),
            switches: state.switch_distances(),
            hessian,
            gradient_norm: gradient,
            lowest,
        })
    }

    /// The shape of each guide at rest, in the order of [`Hairstyle::guides`].
    pub fn shapes(&self) -> impl Iterator<Item = &Shape> {
        self.guides.iter().map(Sensitivity::shape)
    }

    /// Zero for each node of each guide: of a loss, to be filled in.
    #[must_use]
    pub fn no_change(&self) -> Vec<ShapeChange> {
        self.shapes().map(|shape| vec![DVec3::ZERO; shape.positions.len()].into()).collect()
    }

    /// Largest derivative of the energy of the head by any control, relative to EI/L + ρSgL² of its guide.
    #[must_use]
    pub fn gradient_norm(&self) -> f64 {
        self.gradient_norm
    }

    /// Lowest eigenvalue of the second variation of the head, relative to that of each guide while the others hold still, and its residual.
    /// docs/theory.md (H4)
    #[must_use]
    pub fn lowest_eigenvalue(&self) -> (f64, f64) {
        (self.lowest.value, self.lowest.error)
    }

    /// How far the derivatives can be relied on: those of a head are large where a guide would be near a loss of stability by itself, or all together.
    #[must_use]
    pub fn regularity(&self) -> Regularity {
        let alone = |guide: &Sensitivity| guide.regularity() == Regularity::IllConditioned;
        let together = self.lowest.value - self.lowest.error < LEAST_EIGENVALUE;
        if together || self.guides.iter().any(alone) {
            Regularity::IllConditioned
        } else {
            Regularity::Regular
        }
    }

    /// How near each guide is to where contact begins or ends, in the order of [`Hairstyle::guides`].
    #[must_use]
    pub fn switch_distances(&self) -> &[SwitchDistance] {
        &self.switches
    }

    /// The guides whose contact is within [`SwitchDistance::ONE_SIDED`] of where its second derivative jumps, in order: derivatives hold for changes
    /// towards the side on which those are, and guides that they move move along.
    pub fn one_sided(&self) -> impl Iterator<Item = usize> {
        let switches = self.switches.iter().enumerate();
        switches.filter(|(_, distance)| distance.is_one_sided()).map(|(guide, _)| guide)
    }

    /// The derivative of a loss by what the head is made of, from that by the nodes of each guide (loss per m and per rad). docs/theory.md (D7)
    ///
    /// # Errors
    /// [`HeadDerivativeError`], if there is not one entry for each guide or not one vector for each node, or if the equations cannot be solved.
    pub fn vjp(&self, by_nodes: &[ShapeChange]) -> Result<HeadGradient, HeadDerivativeError> {
        self.one_per_guide(by_nodes.len())?;
        // 1. H a = Jᵀ ∂ℓ/∂x of all guides together.
        let right = (self.guides.iter().zip(by_nodes).enumerate())
            .map(|(i, (guide, by_nodes))| guide.moments_of(by_nodes).map_err(in_guide(i)))
            .collect::<Result<Controls, _>>()?;
        let adjoint = self.solve(&right)?;
        // f of (D8): halves of jointed elements move against what guides share.
        let moved = self.hessian.guides.iter().zip(&adjoint);
        let moved: Vec<_> = moved.map(|(guide, a)| guide.displacements(a)).collect();
        let forces = self.hessian.forces(&moved);
        // 2. −aᵀ ∂g/∂p of each parameter of each guide, and of contact.
        let mut rotation = DVec3::ZERO;
        let mut guides = Vec::with_capacity(self.guides.len());
        for (i, ((guide, by_nodes), a)) in
            self.guides.iter().zip(by_nodes).zip(&adjoint).enumerate()
        {
            let gradient = guide.vjp_by_adjoint(by_nodes, a, &forces[i]).map_err(in_guide(i))?;
            // 3. About the origin in place of the root; the load of each is turned back.
            let root = guide.shape().positions[0];
            rotation += gradient.root_rotation + root.cross(gradient.root_position);
            let (root_position, root_rotation) = (DVec3::ZERO, DVec3::ZERO);
            guides.push(ParameterGradient {
                root_position,
                root_rotation,
                length: None,
                ..gradient
            });
        }
        let [hair_stiffness, skin_stiffness] =
            self.by_stiffness.each_ref().map(|by| -dot(&adjoint, by));
        Ok(HeadGradient { guides, hair_stiffness, skin_stiffness, rotation })
    }

    /// How a change of what the head is made of moves each node of each guide, to first order. docs/theory.md (D7)
    ///
    /// # Errors
    /// As [`Self::vjp`], and if a root or a length changes.
    pub fn jvp(&self, change: &HeadChange) -> Result<Vec<ShapeChange>, HeadDerivativeError> {
        let none = vec![ParameterChange::default(); self.guides.len()];
        let changes = if change.guides.is_empty() { &none } else { &change.guides };
        self.one_per_guide(changes.len())?;
        // 1. −∂g/∂p δp of guides, which turn with the head, and of contact.
        let turned = (self.guides.iter().zip(changes).enumerate())
            .map(|(guide, (of, given))| {
                if given.root_position != DVec3::ZERO || given.root_rotation != DVec3::ZERO {
                    return Err(HeadDerivativeError::Root { guide });
                }
                if given.length != 0.0 {
                    return Err(in_guide(guide)(DerivativeError::Length));
                }
                Ok(ParameterChange {
                    root_position: change.rotation.cross(of.shape().positions[0]),
                    root_rotation: change.rotation,
                    ..given.clone()
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        let mut right = (self.guides.iter().zip(&turned).enumerate())
            .map(|(i, (guide, change))| guide.moments_of_change(change).map_err(in_guide(i)))
            .collect::<Result<Controls, _>>()?;
        let [by_hair, by_skin] = &self.by_stiffness;
        add(&mut right, -change.hair_stiffness, by_hair);
        add(&mut right, -change.skin_stiffness, by_skin);
        self.add_by_halves(&turned, &mut right)?;
        // 2. H δc = −∂g/∂p δp, and how that moves nodes.
        let controls = self.solve(&right)?;
        (self.guides.iter().zip(&turned).zip(&controls).enumerate())
            .map(|(i, ((guide, change), x))| guide.jvp_by_controls(change, x).map_err(in_guide(i)))
            .collect()
    }

    /// Adds −∂g/∂p δp of guides whose jointed elements a change of natural strain moves against others at once. docs/theory.md (D8)
    fn add_by_halves(
        &self,
        changes: &[ParameterChange],
        right: &mut Controls,
    ) -> Result<(), HeadDerivativeError> {
        let moved = (self.guides.iter().zip(changes).enumerate())
            .map(|(i, (guide, change))| guide.displacements_of_change(change).map_err(in_guide(i)))
            .collect::<Result<Vec<_>, _>>()?;
        if moved.iter().all(Option::is_none) {
            return Ok(());
        }
        let guides = &self.hessian.guides;
        let still = |(moved, guide): (Option<Vec<DVec3>>, &SecondVariation)| {
            moved.unwrap_or_else(|| vec![DVec3::ZERO; guide.sample_count()])
        };
        let moved: Vec<Vec<DVec3>> = moved.into_iter().zip(guides).map(still).collect();
        let forces = self.hessian.forces(&moved);
        for ((right, guide), forces) in right.iter_mut().zip(guides).zip(&forces) {
            let more = guide.by_controls(forces);
            right.iter_mut().zip(more).for_each(|(right, more)| *right -= more);
        }
        Ok(())
    }

    /// Conjugate gradients for H x = b, preconditioned by each guide's own Hessian, \[Nocedal & Wright\] algorithm 5.3.
    fn solve(&self, right: &Controls) -> Result<Controls, HeadDerivativeError> {
        let preconditioner =
            Preconditioner::new(&self.hessian).ok_or(HeadDerivativeError::NotAMinimum)?;
        let mut x = zero(right);
        let mut residual = right.clone();
        let mut z = preconditioner.solve(&residual);
        let mut way = z.clone();
        let first = dot(&residual, &z);
        let mut norm = first;
        for _ in 0..MOST_CG {
            if norm.is_nan() {
                break;
            }
            if norm <= RESIDUAL * RESIDUAL * first {
                return Ok(x);
            }
            let product = self.hessian.apply(&way).moments;
            let bend = dot(&way, &product);
            if bend <= 0.0 {
                return Err(HeadDerivativeError::NotAMinimum);
            }
            add(&mut x, norm / bend, &way);
            add(&mut residual, -norm / bend, &product);
            z = preconditioner.solve(&residual);
            let next = dot(&residual, &z);
            add_scaled(&mut way, next / norm, &z);
            norm = next;
        }
        Err(HeadDerivativeError::NotSolved { residual: (norm / first).sqrt() })
    }

    fn one_per_guide(&self, given: usize) -> Result<(), HeadDerivativeError> {
        let guides = self.guides.len();
        if given == guides { Ok(()) } else { Err(HeadDerivativeError::Guides { given, guides }) }
    }
}

fn in_guide(guide: usize) -> impl Fn(DerivativeError) -> HeadDerivativeError {
    move |error| HeadDerivativeError::Guide { guide, error }
}

#[cfg(test)]
mod tests {
    use super::super::super::{Effort, GuideStart, SettleOptions, settle};
    use super::*;
    use crate::spec::{HairContact, HairstyleSpec, HeadMethod};
    use crate::{PredictOptions, predict, preset};
    use frisure_rod::{Chain, ElementKind, NaturalStrain, Resolution, Rod, Root};
    use glam::DQuat;

    fn described(contact: HairContact, element: ElementKind) -> HairstyleSpec {
        let mut spec = preset("caucasian-curly").unwrap().spec();
        if contact == HairContact::Density {
            // So few wisps press on each other only where they are long and hang together.
            spec.contact.volume = 2.5;
            spec.length.mean = 0.4;
        }
        if contact == HairContact::None {
            // Soft enough for guides to lie on skin, which is firmer than what any of these curls needs.
            spec.contact.hair_stiffness = 0.05;
            spec.contact.stiffness = 2e3;
        }
        spec.contact.hair = contact;
        spec.equilibrium.method = HeadMethod::Continuation;
        // What holds combed hair reaches as far as its curl lets it: no derivative has that.
        spec.implantation.hold = 0.0;
        spec.wisps.count = 30;
        spec.equilibrium.element = element;
        spec.equilibrium.resolution = Resolution::Elements(12);
        spec
    }

    /// The positions of all nodes of the head that `change` has made of another.
    fn moved(
        hairstyle: &Hairstyle,
        head: &Head,
        change: impl FnOnce(&mut Hairstyle),
    ) -> Vec<DVec3> {
        let mut other = hairstyle.clone();
        change(&mut other);
        let at_rest = HeadSensitivity::new(&other, head, &()).unwrap();
        at_rest.shapes().flat_map(|shape| shape.positions.clone()).collect()
    }

    /// Gives a guide another rod, which the same controls bend.
    fn set_rod(hairstyle: &mut Hairstyle, guide: usize, rod: &Rod) {
        let rest = &mut hairstyle.rest.guides[guide];
        let chain = Chain::uniform(rod, rest.element, rest.elements);
        rest.shape = chain.shape(rest.shape.controls.clone());
        rest.rod = rod.clone();
        hairstyle.guides[guide].rod = rod.clone();
    }

    /// The rod of a guide with a change of its uniform part of natural strain and of its moduli.
    fn changed(rod: &Rod, strain: DVec3) -> Rod {
        let mut spec = rod.spec().clone();
        spec.natural = NaturalStrain::Uniform(rod.natural().mean(0.0, rod.length()) + strain);
        Rod::new(spec).unwrap()
    }

    fn product(a: &[DVec3], b: &[DVec3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
    }

    /// jvp and vjp against central differences of the whole head brought to rest.
    fn agrees(contact: HairContact, element: ElementKind, most: f64) {
        let head = Head::mannequin();
        // The guides; how they lie together comes below.
        let spec = described(contact, element);
        let mut alone = spec.clone();
        alone.contact.hair = HairContact::None;
        let mut hairstyle = predict(&alone, &head, PredictOptions::default(), &()).unwrap();
        hairstyle.spec = spec;
        // Uniform strain, so that its change is that of `ParameterChange`.
        for i in 0..hairstyle.guides.len() {
            let rod = changed(&hairstyle.guides[i].rod, DVec3::ZERO);
            set_rod(&mut hairstyle, i, &rod);
        }
        let options =
            SettleOptions { start: GuideStart::Natural, effort: Effort::FULL, locks: Vec::new() };
        hairstyle.rest = settle(&hairstyle.spec, &head, &hairstyle.guides, options, &()).unwrap();
        let at_rest = HeadSensitivity::new(&hairstyle, &head, &()).unwrap();
        let mut loss = at_rest.no_change();
        for (i, change) in loss.iter_mut().enumerate() {
            for (k, g) in change.positions.iter_mut().enumerate() {
                *g = DVec3::new((i as f64).sin(), (k as f64).cos(), 0.3);
            }
        }
        let gradient = at_rest.vjp(&loss).unwrap();
        let elements = at_rest.shapes().map(|shape| shape.controls.len()).collect::<Vec<_>>();
        assert_coupled(&at_rest, &elements, contact);
        let mut changes = vec![
            HeadChange { hair_stiffness: 1.0, ..HeadChange::default() },
            HeadChange { skin_stiffness: 1.0, ..HeadChange::default() },
        ];
        let strain = |i: usize| DVec3::new(1.0, 0.3, -0.5) * (1.0 + 0.5 * (i as f64).cos());
        let guides = elements.iter().enumerate().map(|(i, n)| ParameterChange {
            natural_strain: vec![strain(i); *n],
            ..ParameterChange::default()
        });
        changes.push(HeadChange { guides: guides.collect(), ..HeadChange::default() });
        let turn = DVec3::new(0.3, -0.5, 0.2);
        changes.push(HeadChange { rotation: turn, ..HeadChange::default() });
        let steps = [1e-5 * hairstyle.spec.contact.hair_stiffness, 0.3, 2e-5, 1e-6];
        for (k, (change, step)) in changes.iter().zip(steps).enumerate() {
            let at = |sign: f64| {
                moved(&hairstyle, &head, |other| match k {
                    0 => other.spec.contact.hair_stiffness += sign * step,
                    1 => other.spec.contact.stiffness += sign * step,
                    2 => (0..other.guides.len()).for_each(|i| {
                        let rod = changed(&other.guides[i].rod, strain(i) * (sign * step));
                        set_rod(other, i, &rod);
                    }),
                    // Seen from the head gravity turns the other way.
                    _ => (0..other.guides.len()).for_each(|i| {
                        let mut rod = other.guides[i].rod.spec().clone();
                        let back = DQuat::from_scaled_axis(turn * -(sign * step));
                        rod.load.gravity = back * rod.load.gravity;
                        set_rod(other, i, &Rod::new(rod).unwrap());
                    }),
                })
            };
            let (ahead, behind) = (at(1.0), at(-1.0));
            let nodes = at_rest.shapes().flat_map(|shape| &shape.positions);
            let expected: Vec<DVec3> = (ahead.iter().zip(&behind).zip(nodes))
                .map(|((a, b), x)| (*a - *b) / (2.0 * step) + change.rotation.cross(*x))
                .collect();
            let found = at_rest.jvp(change).unwrap();
            let found: Vec<DVec3> = found.into_iter().flat_map(|change| change.positions).collect();
            let gap: Vec<DVec3> = found.iter().zip(&expected).map(|(a, b)| *a - *b).collect();
            let [gap, size] = [&gap, &expected].map(|x| product(x, x).sqrt());
            assert!(
                size > 0.0 || (k == 1 && contact != HairContact::None),
                "{contact:?} {element:?} {k}"
            );
            assert!(gap <= most * size, "{contact:?} {element:?} {k}: {gap} of {size}");
            // The two products are each other's transposes.
            let weights: Vec<DVec3> = loss.iter().flat_map(|of| of.positions.clone()).collect();
            let (along, by) = (product(&weights, &found), gradient.along(change));
            assert!(
                (along - by).abs() <= 1e-7 * along.abs(),
                "{contact:?} {element:?} {k}: {along} {by}"
            );
        }
    }

    /// Whether the curl of one guide moves another.
    fn assert_coupled(at_rest: &HeadSensitivity, elements: &[usize], contact: HairContact) {
        let moves = |of: usize| {
            let mut guides = vec![ParameterChange::default(); elements.len()];
            guides[of].natural_strain = vec![DVec3::X; elements[of]];
            let change = HeadChange { guides, ..HeadChange::default() };
            let moved = at_rest.jvp(&change).unwrap();
            let others = moved.iter().enumerate().filter(|(i, _)| *i != of);
            others.flat_map(|(_, of)| &of.positions).any(|x| *x != DVec3::ZERO)
        };
        let coupled = matches!(contact, HairContact::Wisps | HairContact::Density);
        assert_eq!((0..elements.len()).any(moves), coupled, "{contact:?}");
    }

    #[test]
    fn derivatives_of_a_head_agree_with_differences() {
        // Contact is twice differentiable only: differences are exact to first order.
        for element in [ElementKind::Helix, ElementKind::Jointed] {
            agrees(HairContact::Wisps, element, 5e-6);
            agrees(HairContact::Density, element, 5e-6);
            agrees(HairContact::Layers, element, 1e-6);
            agrees(HairContact::None, element, 1e-5);
        }
    }

    /// A node of a guide is brought to touch skin exactly, by how far out the guide is rooted.
    #[test]
    fn a_guide_that_just_touches_skin_is_one_sided() {
        let head = Head::mannequin();
        let skin = head.signed_distance();
        let spec = described(HairContact::None, ElementKind::Helix);
        let hairstyle = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
        let rooted = |guide: usize, shift: DVec3| {
            let mut other = hairstyle.clone();
            let mut spec = other.guides[guide].rod.spec().clone();
            let (place, frame) = (spec.root.position() + shift, spec.root.frame());
            spec.root = Root::from_tangent(place, frame.z_axis, frame.x_axis).unwrap();
            set_rod(&mut other, guide, &Rod::new(spec).unwrap());
            HeadSensitivity::new(&other, &head, &()).ok()
        };
        // 1. The nodes off the skin and near it, the first of them that a shift of the root presses on it.
        let first = HeadSensitivity::new(&hairstyle, &head, &()).unwrap();
        let nodes = first.shapes().enumerate().flat_map(|(guide, shape)| {
            let nodes = shape.positions.iter().enumerate().skip(2);
            nodes.map(move |(node, x)| (guide, node, *x))
        });
        let mut nodes: Vec<_> = nodes.collect();
        nodes.retain(|(_, _, x)| skin.value(*x) > 1e-5);
        nodes.sort_by(|a, b| skin.value(a.2).total_cmp(&skin.value(b.2)));
        let depth = |guide: usize, node: usize, shift: DVec3| {
            let at = rooted(guide, shift)?;
            Some(skin.value(at.shapes().nth(guide)?.positions[node]))
        };
        let pressed = nodes.iter().take(10).find_map(|&(guide, node, x)| {
            let out = skin.value_gradient_hessian(x).1 * (2.0 * skin.value(x));
            let shifts = [1.0, -1.0, 2.0, -2.0, 4.0, -4.0];
            let far =
                shifts.iter().find(|&&k| depth(guide, node, out * k).is_some_and(|d| d < 0.0));
            Some((guide, node, out * *far?))
        });
        let (guide, node, shift) = pressed.expect("a node that comes to touch");
        assert!(first.switch_distances()[guide].skin > SwitchDistance::ONE_SIDED);
        assert!(first.one_sided().all(|i| i != guide));
        // 2. Where it touches, by bisection.
        let (mut off, mut on) = (0.0, 1.0);
        for _ in 0..45 {
            let middle = 0.5 * (off + on);
            if depth(guide, node, shift * middle).unwrap() > 0.0 {
                off = middle;
            } else {
                on = middle;
            }
        }
        let touching = rooted(guide, shift * off).unwrap();
        let distance = touching.switch_distances()[guide];
        assert!(distance.is_one_sided(), "{distance:?}");
        assert!(touching.one_sided().any(|i| i == guide));
        // 3. Its derivatives are others on the two sides: skin is firm as soon as it is touched.
        let moves = |side: f64| {
            let at = rooted(guide, shift * off + shift.normalize() * (side * 1e-6)).unwrap();
            let mut guides = vec![ParameterChange::default(); hairstyle.guides.len()];
            let elements = at.shapes().nth(guide).unwrap().controls.len();
            guides[guide].natural_strain = vec![DVec3::new(1.0, 1.0, 0.0); elements];
            let change = HeadChange { guides, ..HeadChange::default() };
            at.jvp(&change).unwrap()[guide].positions.clone()
        };
        let (before, after) = (moves(-1.0), moves(1.0));
        let gap: Vec<DVec3> = before.iter().zip(&after).map(|(a, b)| *a - *b).collect();
        let [gap, size] = [&gap, &before].map(|x| product(x, x).sqrt());
        assert!(gap > 1e-3 * size, "{gap} of {size}");
    }

    #[test]
    fn what_has_no_derivatives_is_told() {
        let head = Head::mannequin();
        let predicted =
            |spec: &HairstyleSpec| predict(spec, &head, PredictOptions::default(), &()).unwrap();
        let mut spec = described(HairContact::Layers, ElementKind::Helix);
        spec.wisps.count = 4;
        let hairstyle = predicted(&spec);
        let at_rest = HeadSensitivity::new(&hairstyle, &head, &()).unwrap();
        assert_eq!(at_rest.vjp(&[]), Err(HeadDerivativeError::Guides { given: 0, guides: 4 }));
        let short = vec![ShapeChange::from(vec![DVec3::ZERO]); 4];
        assert!(matches!(at_rest.vjp(&short), Err(HeadDerivativeError::Guide { guide: 0, .. })));
        let moved = ParameterChange { root_position: DVec3::X, ..ParameterChange::default() };
        let change = HeadChange { guides: vec![moved; 4], ..HeadChange::default() };
        assert_eq!(at_rest.jvp(&change), Err(HeadDerivativeError::Root { guide: 0 }));
        let longer = ParameterChange { length: 1.0, ..ParameterChange::default() };
        let change = HeadChange { guides: vec![longer; 4], ..HeadChange::default() };
        let error = DerivativeError::Length;
        assert_eq!(at_rest.jvp(&change), Err(HeadDerivativeError::Guide { guide: 0, error }));
        let error =
            |spec: &HairstyleSpec| HeadSensitivity::new(&predicted(spec), &head, &()).unwrap_err();
        let mut rubs = spec.clone();
        rubs.contact.skin_friction = 0.3;
        assert_eq!(error(&rubs), HeadDerivativeError::Friction);
        // Wisps whose order is decided, but which are not at rest.
        let mut swept = described(HairContact::Wisps, ElementKind::Helix);
        swept.equilibrium.method = HeadMethod::Sweeps;
        swept.contact.volume = 4.0;
        let error = error(&swept).to_string();
        assert!(error.contains("continuation"), "{error}");
    }
}
