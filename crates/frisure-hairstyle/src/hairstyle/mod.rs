//! A hairstyle as plain data: what was described, what was planned from it, how it rests, what styling made of it.
//!
//! [`crate::predict()`] makes one, [`crate::style`] makes another from it, [`crate::strands()`] draws it.

mod placement;
mod rest;
mod wet_locks;
mod wisp_state;

use frisure_rod::Equilibrium;

use crate::guides::Guide;
use crate::implantation::Layout;
use crate::spec::HairstyleSpec;

pub use placement::Crowded;
pub(crate) use placement::RootPlacement;
pub use rest::JointCertificate;
pub(crate) use rest::Rest;
pub(crate) use wet_locks::COUNTED;
pub use wet_locks::WetLockSizes;
pub use wisp_state::WispState;
pub(crate) use wisp_state::{
    DRAWN, Ends, Fastener, Grip, Lay, Mould, ROOM, Styling, Thinned, strain_of,
};

/// Guides at rest on a head, the description that they were predicted from, and what styling made of them.
#[derive(Clone, Debug)]
pub struct Hairstyle {
    pub(crate) spec: HairstyleSpec,
    pub(crate) placement: RootPlacement,
    pub(crate) layout: Layout,
    pub(crate) guides: Vec<Guide>,
    pub(crate) rest: Rest,
    pub(crate) styling: Styling,
}

impl Hairstyle {
    /// The description.
    #[must_use]
    pub fn spec(&self) -> &HairstyleSpec {
        &self.spec
    }

    /// What styling has made of each wisp, in the order of [`Self::guides`].
    #[must_use]
    pub fn wisps(&self) -> &[WispState] {
        &self.styling.wisps
    }

    /// Takes over a wisp and how it rests from another state of the same hair.
    pub(crate) fn take_wisp(&mut self, index: usize, other: &Self) {
        self.guides[index].clone_from(&other.guides[index]);
        self.rest.guides[index].clone_from(&other.rest.guides[index]);
        self.rest.friction[index] = other.rest.friction[index];
        if let Some(lock) = self.rest.locks.get_mut(index) {
            lock.clone_from(&other.rest.locks[index]);
        }
        self.styling.wisps[index].clone_from(&other.styling.wisps[index]);
    }

    /// Whether anything was done to it since it was predicted.
    #[must_use]
    pub fn is_styled(&self) -> bool {
        !self.styling.is_none(&self.guides)
    }

    /// Mass (kg) of all hair that grows on the head, each hair taken to be as long as its guide but for what thinning scissors have cut
    /// off. Water does not change it (the paper, §3.2.1).
    #[must_use]
    pub fn mass(&self) -> f64 {
        let each = self.grown() / self.guides.len() as f64;
        let mass = |(guide, left): (&Guide, f64)| {
            let rod = guide.rod.spec();
            rod.material.density() * rod.section.area() * rod.length * left
        };
        self.guides.iter().zip(self.left_by_thinning()).map(mass).sum::<f64>() * each
    }

    /// The share (0 to 1) of the hair of each wisp that thinning scissors have left, which cut hairs and no guides; 1 where they did
    /// nothing. In the order of [`Self::guides`].
    #[must_use]
    pub fn left_by_thinning(&self) -> Vec<f64> {
        let wisps = &self.styling.wisps;
        let Some(ends) = &self.styling.ends else { return vec![1.0; wisps.len()] };
        let Some(Thinned { limits, every }) = &ends.thinned else { return vec![1.0; wisps.len()] };
        let mut shares = vec![(0.0, 0_u32); wisps.len()];
        for (limit, &wisp) in limits.iter().zip(&*ends.wisps).step_by(*every) {
            let (sum, count) = &mut shares[wisp as usize];
            *sum += (f64::from(*limit) / wisps[wisp as usize].length).min(1.0);
            *count += 1;
        }
        shares.into_iter().map(|(sum, n)| if n > 0 { sum / f64::from(n) } else { 1.0 }).collect()
    }

    /// The guides, as they were planted, cut, grown and wetted.
    #[must_use]
    pub fn guides(&self) -> &[Guide] {
        &self.guides
    }

    /// The guides, as they were planned: room-dry, of their first lengths, held by nothing. In the order of [`Self::guides`].
    #[must_use]
    pub fn planned(&self) -> &[Guide] {
        &self.styling.planned
    }

    /// The guides, as they came to rest, in the order of [`Self::guides`].
    #[must_use]
    pub fn equilibria(&self) -> &[Equilibrium] {
        &self.rest.guides
    }

    /// Number of hairs that grow on the scalp, drawn or not.
    #[must_use]
    pub fn grown(&self) -> f64 {
        self.placement.area() * self.spec.implantation.density
    }

    /// Number of hairs that [`crate::strands()`] draws.
    #[must_use]
    pub fn drawn(&self) -> usize {
        self.spec.wisps.hair_count(self.placement.area())
    }
}
