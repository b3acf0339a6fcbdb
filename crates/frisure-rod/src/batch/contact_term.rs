//! Contact energies at the ends of links, in lanes.

use super::contact::ConfinementTube;
use super::lanes::Lanes;
use super::linear::{Sym3, Vec3};

/// Contact at the end of a link: energy (J), gradient and Hessian by its position.
#[derive(Clone, Copy)]
pub(super) struct ContactTerm<F> {
    pub(super) energy: F,
    pub(super) gradient: Vec3<F>,
    pub(super) hessian: Sym3<F>,
}

impl<F: Lanes> ContactTerm<F> {
    pub(super) fn zero(zero: F) -> Self {
        Self { energy: zero, gradient: Vec3::splat(zero), hessian: Sym3::splat(zero) }
    }

    /// Adds the contact of one rod.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        lane: usize,
        energy: f64,
        gradient: glam::DVec3,
        hessian: &glam::DMat3,
    ) {
        self.energy.set(lane, self.energy.get(lane) + energy);
        self.gradient.set(lane, self.gradient.get(lane) + gradient);
        self.hessian.add_to(lane, hessian);
    }

    #[inline(always)]
    pub(super) fn select(mask: F::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            energy: F::select(mask, yes.energy, no.energy),
            gradient: Vec3::select(mask, yes.gradient, no.gradient),
            hessian: Sym3::select(mask, yes.hessian, no.hessian),
        }
    }
}

/// The confinement tubes of the same joint of all rods.
#[derive(Clone, Copy)]
pub(super) struct TubeTerm<F> {
    centre: Vec3<F>,
    radius: F,
    /// k/ρ times the length of rod at this joint (N/m²).
    stiffness: F,
}

impl<F: Lanes> TubeTerm<F> {
    #[inline(always)]
    pub(super) fn unbounded(zero: F) -> Self {
        Self { centre: Vec3::splat(zero), radius: zero.splat(f64::INFINITY), stiffness: zero }
    }

    /// Sets the tube of one rod, for `share` (m) of its length.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, tube: &ConfinementTube, share: f64) {
        self.centre.set(lane, tube.centre);
        self.radius.set(lane, tube.radius);
        self.stiffness.set(lane, tube.stiffness / tube.radius * share);
    }

    /// The contact of rods whose links end at `end` (m); `none` is that of a rod inside its tube.
    ///
    /// With e the distance beyond the radius: energy `k e³/6ρ`, force `k e²/2ρ`, stiffness along the normal `k e/ρ`.
    #[inline(always)]
    pub(super) fn contact(&self, end: &Vec3<F>, none: &ContactTerm<F>) -> ContactTerm<F> {
        let away = *end - self.centre;
        let square = away.dot(away);
        if !F::any_true((self.radius * self.radius).lt(square)) {
            return *none;
        }
        let zero = square.splat(0.0);
        // The bound (m²) keeps the normal finite at the centre of the tube, where the force is zero anyway.
        let distance = square.max(square.splat(1e-30)).sqrt();
        let beyond = (distance - self.radius).max(zero);
        let stiffness = self.stiffness * beyond;
        let force = square.splat(0.5) * stiffness * beyond;
        // Hessian: (force/distance) (I − n nᵀ) + stiffness n nᵀ, with n the normal.
        let across = force / distance;
        let normal = away * (square.splat(1.0) / distance);
        ContactTerm {
            // k e³/6ρ = ⅓ e (k e²/2ρ).
            energy: square.splat(1.0 / 3.0) * force * beyond,
            gradient: normal * force,
            hessian: Sym3::splat(zero)
                .add_diagonal(Vec3::splat(across))
                .sub_square(across - stiffness, normal),
        }
    }
}
