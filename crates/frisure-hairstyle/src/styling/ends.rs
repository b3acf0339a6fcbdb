//! Where drawn hairs have been cut.

use std::sync::Arc;

use rayon::prelude::*;

use crate::hairstyle::Hairstyle;
use crate::head::Head;
use crate::roots::Root;
use crate::strands::{Population, roots};

/// The length at which each drawn hair has been cut.
#[derive(Clone, Debug)]
pub(super) struct Ends {
    /// Length (m) of the dry hair, infinite where it has never been cut.
    limits: Arc<[f32]>,
    /// The wisp of each hair.
    wisps: Arc<[u32]>,
}

impl Ends {
    pub(super) fn limits(&self) -> &[f32] {
        &self.limits
    }

    /// Cuts hairs of the chosen wisps: `left` gives how much (m, dry) is left of a hair at least, by
    /// its root, its index and its wisp.
    pub(super) fn cut(
        hairstyle: &Hairstyle,
        head: &Head,
        chosen: &[bool],
        left: impl Fn(&Population<'_>, &Root, usize, usize) -> f64 + Sync,
    ) -> Self {
        let population = Population::new(hairstyle, head);
        let roots = roots(hairstyle, head, 1);
        let before = hairstyle.styling.ends.as_ref();
        let wisps: Arc<[u32]> = match before {
            Some(ends) => ends.wisps.clone(),
            None => roots.par_iter().map(|(_, root)| population.main(root) as u32).collect(),
        };
        let limit = |&(index, ref root): &(usize, Root)| {
            let limit = before.map_or(f32::INFINITY, |ends| ends.limits[index]);
            let wisp = wisps[index] as usize;
            if !chosen[wisp] {
                return limit;
            }
            limit.min(left(&population, root, index, wisp).max(STUBBLE) as f32)
        };
        let limits = roots.par_iter().map(limit).collect();
        Self { limits, wisps }
    }

    /// The same hairs where they follow other guides.
    pub(super) fn replanted(self, hairstyle: &Hairstyle, head: &Head) -> Self {
        let population = Population::new(hairstyle, head);
        let wisp = |(_, root): &(usize, Root)| population.main(root) as u32;
        let wisps = roots(hairstyle, head, 1).par_iter().map(wisp).collect();
        Self { wisps, ..self }
    }

    /// Lets hairs grow by the length (m) that each wisp grows by.
    pub(super) fn grown(&self, by: &[f64]) -> Self {
        let grown = |(limit, &wisp): (&f32, &u32)| limit + by[wisp as usize] as f32;
        let limits = self.limits.iter().zip(self.wisps.iter()).map(grown).collect();
        Self { limits, wisps: self.wisps.clone() }
    }
}

/// Length (m) that is left of a hair whose root is beyond the scissors.
const STUBBLE: f64 = 1e-3;
