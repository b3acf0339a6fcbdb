//! Where drawn hairs have been cut.

use crate::hairstyle::Hairstyle;
use crate::hairstyle::{Ends, Thinned};
use crate::head::Head;
use crate::implantation::Root;
use crate::parallel;
use crate::strands::{Population, roots};

impl Ends {
    /// Cuts hairs of the chosen wisps, of all hairs every `stride`-th: `left` gives how much (m, dry) is left
    /// of a hair at least, by its root, its index and its wisp; of hair that is held `straight` that is its own length, else the length along its
    /// guides.
    pub(super) fn cut(
        hairstyle: &Hairstyle,
        head: &Head,
        stride: usize,
        chosen: &[bool],
        straight: bool,
        left: impl Fn(&Population<'_>, &Root, usize, usize) -> f64 + Sync,
    ) -> Self {
        let population = Population::new(hairstyle, head);
        let roots = roots(hairstyle, head, stride);
        let before = hairstyle.styling.ends.as_ref();
        let cut: Vec<(usize, u32, f32)> = parallel::map_slice(&roots, |&(index, ref root)| {
            let wisp = match before {
                Some(ends) => ends.wisps[index],
                None => population.main(root, index) as u32,
            };
            let chosen = chosen[wisp as usize];
            let left = || left(&population, root, index, wisp as usize).max(STUBBLE) as f32;
            (index, wisp, if chosen { left() } else { f32::INFINITY })
        });
        let count = hairstyle.drawn();
        let mut limits = before.map_or(vec![f32::INFINITY; count], |ends| ends.limits.to_vec());
        let mut wisps = before.map_or(vec![0; count], |ends| ends.wisps.to_vec());
        let mut held = before.map_or(vec![false; count], |ends| ends.straight.to_vec());
        for (index, wisp, left) in cut {
            wisps[index] = wisp;
            if left < limits[index] {
                (limits[index], held[index]) = (left, straight);
            }
        }
        let cuts = before.map_or(0, |ends| ends.cuts) + 1;
        let thinned = before.and_then(|ends| ends.thinned.clone());
        Self { limits: limits.into(), straight: held.into(), wisps: wisps.into(), cuts, thinned }
    }

    /// Notes that those of every `stride`-th hair that are shorter than `before` were cut by thinning scissors.
    pub(super) fn thinned(mut self, before: Option<&Self>, stride: usize) -> Self {
        let known = self.thinned.as_ref();
        let mut limits =
            known.map_or(vec![f32::INFINITY; self.limits.len()], |known| known.limits.to_vec());
        for (index, thinned) in limits.iter_mut().enumerate().step_by(stride.max(1)) {
            let earlier = before.map_or(f32::INFINITY, |ends| ends.limits[index]);
            if self.limits[index] < earlier {
                *thinned = thinned.min(self.limits[index]);
            }
        }
        let every = known.map_or(1, |known| known.every).max(stride);
        self.thinned = Some(Thinned { limits: limits.into(), every });
        self
    }

    /// Where the drawn hairs, of all every `stride`-th, have been cut so far: infinite where they have not.
    pub(super) fn before(hairstyle: &Hairstyle, head: &Head, stride: usize) -> Self {
        let uncut = || {
            let none = vec![false; hairstyle.guides.len()];
            let uncut =
                Self::cut(hairstyle, head, stride, &none, false, |_, _, _, _| f64::INFINITY);
            Self { cuts: 0, ..uncut }
        };
        hairstyle.styling.ends.clone().unwrap_or_else(uncut)
    }

    /// The same hairs where they follow other guides.
    pub(super) fn replanted(self, hairstyle: &Hairstyle, head: &Head) -> Self {
        let population = Population::new(hairstyle, head);
        let wisp = |(index, root): &(usize, Root)| population.main(root, *index) as u32;
        let wisps = parallel::map_slice(&roots(hairstyle, head, 1), wisp).into();
        Self { wisps, ..self }
    }

    /// Lets hairs grow by the length (m) that each wisp grows by.
    pub(super) fn grown(&self, by: &[f64]) -> Self {
        let grown = |(limit, &wisp): (&f32, &u32)| limit + by[wisp as usize] as f32;
        let all = |limits: &[f32]| limits.iter().zip(self.wisps.iter()).map(grown).collect();
        let thinned = self
            .thinned
            .as_ref()
            .map(|known| Thinned { limits: all(&known.limits), every: known.every });
        Self { limits: all(&self.limits), thinned, ..self.clone() }
    }
}

/// Length (m) that is left of a hair whose root is beyond the scissors. Chosen.
const STUBBLE: f64 = 1e-3;
