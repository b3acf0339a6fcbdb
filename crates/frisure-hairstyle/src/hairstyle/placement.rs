//! Where guides and drawn hairs are rooted.

use std::sync::{Arc, Mutex, PoisonError};

use crate::head::Head;
use crate::implantation::{Root, Scalp};
use crate::random::Purpose;
use crate::spec::{Hairline, HairstyleSpec};
use crate::wisps::BoundStrands;

/// Most guides on a skin (1/m²): 0.3 mm apart, some five times as many as there are hairs.
const DENSEST: f64 = 1e7;

/// More guides than the scalp has room for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{count} wisps are too many for a scalp of {} cm²; at most {most} have room", short(*area))]
pub struct Crowded {
    /// Number of guides in the description.
    pub count: usize,
    /// Weighted area of the scalp (m²).
    pub area: f64,
    /// How many there can be.
    pub most: usize,
}

fn short(area: f64) -> f64 {
    (area * 1e7).round() / 1e3
}

/// Where guides and drawn hairs of a head are rooted.
#[derive(Clone, Debug)]
pub(crate) struct RootPlacement {
    /// What it depends on: head, seed, hairline.
    pub(crate) of: (u64, u64, Hairline),
    /// Weighted area of the scalp (m²).
    pub(crate) area: f64,
    pub(crate) roots: Vec<Root>,
    /// Where drawn hairs are rooted, once computed; shared by all clones.
    pub(crate) hairs: Arc<Mutex<Option<Arc<[Root]>>>>,
    /// Strands of a groom, which keep their own shapes.
    pub(crate) bound: Option<Arc<BoundStrands>>,
}

impl RootPlacement {
    /// Places the guides of a description evenly on the scalp.
    ///
    /// # Errors
    /// [`Crowded`], if the scalp is too small.
    pub(crate) fn new(spec: &HairstyleSpec, head: &Head) -> Result<Self, Crowded> {
        let scalp = Scalp::grown(head, spec);
        let (count, area) = (spec.wisps.count, scalp.area());
        let most = (area * DENSEST) as usize;
        if count > most {
            return Err(Crowded { count, area, most });
        }
        let roots = scalp.even(count, spec.seed, Purpose::GuideRoots);
        Ok(Self { of: Self::key(spec, head), area, roots, hairs: Arc::default(), bound: None })
    }

    /// Weighted area of the scalp (m²).
    pub(crate) fn area(&self) -> f64 {
        self.area
    }

    /// This one, if it is that of the description, too.
    pub(crate) fn fitting(&self, spec: &HairstyleSpec, head: &Head) -> Option<Self> {
        let same = self.of == Self::key(spec, head) && self.roots.len() == spec.wisps.count;
        same.then(|| self.clone())
    }

    /// Where the drawn hairs of the description are rooted, before they gather along partings.
    pub(crate) fn hairs(&self, spec: &HairstyleSpec, head: &Head) -> Arc<[Root]> {
        let compute = || -> Arc<[Root]> {
            let scalp = Scalp::grown(head, spec);
            let count = spec.wisps.hair_count(scalp.area());
            scalp.stratified(count, spec.seed, Purpose::HairRoots).into()
        };
        if self.of != Self::key(spec, head) {
            return compute();
        }
        let count = spec.wisps.hair_count(self.area);
        // A poisoned lock guards a whole list all the same: it is only ever replaced.
        let mut known = self.hairs.lock().unwrap_or_else(PoisonError::into_inner);
        match &*known {
            Some(roots) if roots.len() == count => roots.clone(),
            _ => known.insert(compute()).clone(),
        }
    }

    /// Strands of a groom, as long as the description is the one that they were bound for.
    pub(crate) fn bound(&self, spec: &HairstyleSpec, head: &Head) -> Option<&BoundStrands> {
        let bound = self.bound.as_deref();
        let fits = |b: &&BoundStrands| b.len() == spec.wisps.hair_count(self.area);
        bound.filter(fits).filter(|_| self.of == Self::key(spec, head))
    }

    /// Where guides are rooted.
    pub(crate) fn roots(&self) -> &[Root] {
        &self.roots
    }

    pub(crate) fn key(spec: &HairstyleSpec, head: &Head) -> (u64, u64, Hairline) {
        (head.fingerprint(), spec.seed, spec.implantation.hairline)
    }
}
