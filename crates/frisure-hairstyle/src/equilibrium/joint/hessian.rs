//! The second variation of the energy of a whole head, and the preconditioner of its equations.
//!
//! By guides it is `H = diag(H_i) − Σ J_iᵀ K_kl J_j` over the pairs of points k and l of guides i and j that touch, with the
//! displacements `J_i x_i` of points and the second derivative K_kl of a pair's energy by its separation; H_i contains the sum
//! of K_kl over what guide i touches. It is never formed: H_i is applied in linear time, K_kl is three by three.
//! docs/theory.md, "All guides at once" (H1)

use frisure_rod::minimise::{SecondVariation, SecondVariationFactor};
use glam::DVec3;

use crate::contact::{Contact, DensityVariation};
use crate::parallel;

/// One vector for each element of each guide.
pub(super) type Controls = Vec<Vec<DVec3>>;

/// The second variation at one state of the head.
pub(super) struct JointHessian {
    /// H_i of each guide while the others hold still.
    pub(super) guides: Vec<SecondVariation>,
    /// What couples them.
    pub(super) coupling: Coupling,
}

/// The second derivatives of the energy that guides share, but for what H_i has of it.
pub(super) enum Coupling {
    /// What each guide touches.
    Pairs(Vec<Vec<Contact>>),
    /// That of density.
    Density(DensityVariation),
}

impl Coupling {
    /// What displacements (m) of the points of all guides change ∂E/∂x (N) at each point by, without what a guide has while the others hold still.
    fn forces(&self, moved: &[&[DVec3]]) -> Vec<Vec<DVec3>> {
        let contacts = match self {
            Self::Density(variation) => return variation.forces(moved),
            Self::Pairs(contacts) => contacts,
        };
        parallel::map(contacts.len(), |i| {
            let mut forces = vec![DVec3::ZERO; moved[i].len()];
            // −Σ_l K_kl (J_j x_j)_l: K_kl of the guide's own motion is in H_i. (H1)
            for contact in &contacts[i] {
                let (other, point) = contact.other;
                let displacement = moved[other as usize][point as usize];
                forces[contact.point as usize] -= contact.apply(displacement);
            }
            forces
        })
    }
}

impl JointHessian {
    /// Derivative of the energy by every control (N m).
    pub(super) fn gradient(&self) -> Controls {
        self.guides.iter().map(|guide| guide.gradient().to_vec()).collect()
    }

    /// What displacements (m) of the sample points of all guides change ∂E/∂x (N) at each by, without what a guide has while the others hold still.
    pub(super) fn forces(&self, moved: &[Vec<DVec3>]) -> Vec<Vec<DVec3>> {
        let moved: Vec<&[DVec3]> = moved.iter().map(Vec::as_slice).collect();
        self.coupling.forces(&moved)
    }

    /// H x for a step x (rad), and by how much the step moves the points of guides. (H1)
    pub(super) fn apply(&self, step: &Controls) -> Product {
        let (guides, count) = (&self.guides, self.guides.len());
        // 1. J_i x_i, by how much the points of each guide move …
        let changes = parallel::map(count, |i| guides[i].node_changes(&step[i]));
        let moved = parallel::map(count, |i| guides[i].displacements_with(&step[i], &changes[i]));
        // 2. … the forces that this makes on the points of the others …
        let forces = self.forces(&moved);
        // 3. … and H_i x_i with J_iᵀ of these forces, in one sweep from the tip of each guide to its root. docs/theory.md, "Product"
        let moments =
            parallel::map(count, |i| guides[i].apply_with(&step[i], &changes[i], &forces[i]));
        Product { moments, moved }
    }
}

/// The second variation applied to a step.
pub(super) struct Product {
    /// H x (N m).
    pub(super) moments: Controls,
    /// By how much the step moves the points of each guide (m), to first order.
    pub(super) moved: Vec<Vec<DVec3>>,
}

/// Damping of a guide's second variation that is not positive definite, as a fraction of its elastic stiffness: the first
/// try, and the factor from one to the next. Chosen by trial, as in Newton's method for one rod.
pub(super) const FIRST_DAMPING: f64 = 0.3;
pub(super) const DAMPING_GROWTH: f64 = 4.0;

/// Damping above which numbers are too large for any step.
pub(super) const LARGEST_DAMPING: f64 = 1e12;

/// The factors of each guide's own second variation, damped where it is not positive definite: `M = diag(H_i + σ_i K/h)`.
pub(super) struct Preconditioner<'a> {
    factors: Vec<SecondVariationFactor<'a>>,
    /// Whether no guide is damped.
    pub(super) exact: bool,
}

impl<'a> Preconditioner<'a> {
    /// `None` if a guide's numbers are so large that no damping makes them positive definite.
    pub(super) fn new(hessian: &'a JointHessian) -> Option<Self> {
        let factor = |guide: &'a SecondVariation| {
            // σ_i grows until every pivot of the block factorisation is positive definite: then M is, as conjugate gradients need.
            let mut damping = 0.0;
            loop {
                match guide.factor(damping) {
                    Some(factor) => return Some((factor, damping == 0.0)),
                    None if damping > LARGEST_DAMPING => return None,
                    None => damping = FIRST_DAMPING.max(damping * DAMPING_GROWTH),
                }
            }
        };
        let factors: Option<Vec<_>> =
            parallel::map_slice(&hessian.guides, factor).into_iter().collect();
        let (factors, exact): (Vec<_>, Vec<bool>) = factors?.into_iter().unzip();
        Some(Self { factors, exact: !exact.contains(&false) })
    }

    /// M⁻¹ r (rad) for a residual r (N m).
    pub(super) fn solve(&self, residual: &Controls) -> Controls {
        parallel::map(residual.len(), |i| self.factors[i].solve(&residual[i]))
    }
}

/// xᵀ y, summed guide by guide in their order, so that it does not depend on threads.
pub(super) fn dot(x: &Controls, y: &Controls) -> f64 {
    let of_guide = |i: usize| -> f64 { x[i].iter().zip(&y[i]).map(|(a, b)| a.dot(*b)).sum() };
    parallel::map(x.len(), of_guide).iter().sum()
}

/// x ← x + factor · y.
pub(super) fn add(x: &mut Controls, factor: f64, y: &Controls) {
    parallel::for_each_mut(x, |i, x| x.iter_mut().zip(&y[i]).for_each(|(a, b)| *a += *b * factor));
}

/// x ← y + factor · x.
pub(super) fn add_scaled(x: &mut Controls, factor: f64, y: &Controls) {
    parallel::for_each_mut(x, |i, x| {
        x.iter_mut().zip(&y[i]).for_each(|(a, b)| *a = *b + *a * factor);
    });
}

/// −x.
pub(super) fn negative(x: &Controls) -> Controls {
    x.iter().map(|guide| guide.iter().map(|v| -*v).collect()).collect()
}

/// Zero, of the size of x.
pub(super) fn zero(x: &Controls) -> Controls {
    x.iter().map(|guide| vec![DVec3::ZERO; guide.len()]).collect()
}
