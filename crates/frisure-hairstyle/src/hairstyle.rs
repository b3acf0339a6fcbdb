//! A hairstyle: guides at rest on a head.

use std::sync::Arc;

use frisure_rod::{Equilibrium, InvalidQuantity};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::DVec3;
use rayon::prelude::*;
use thiserror::Error;

use crate::equilibrium::{Effort, Rest, SettlingReport, settle, settle_from, settle_roughly};
use crate::grid::Grid;
use crate::guides::{Crowded, Guide, Planting, plan};
use crate::head::Head;
use crate::implantation::{Layout, PartingError};
use crate::monitor::{Cancelled, Monitor};
use crate::spec::{HairstyleSpec, Implantation, InvalidSpec, Wisps};
use crate::strands::{self, Keep, Simulation};
use crate::styling::{Styling, WispState};

/// Guides at rest on a head, and the description that they were predicted from.
#[derive(Clone, Debug)]
pub struct Hairstyle {
    pub(crate) spec: HairstyleSpec,
    pub(crate) planting: Planting,
    pub(crate) layout: Layout,
    pub(crate) guides: Vec<Guide>,
    pub(crate) rest: Rest,
    pub(crate) styling: Styling,
    /// What is done to it is done roughly.
    pub(crate) rough: Option<Rough>,
}

/// How roughly something is done to a hairstyle.
#[derive(Clone, Debug)]
pub(crate) struct Rough {
    pub(crate) effort: Effort,
    /// Of drawn hairs only every so manyth is cut.
    pub(crate) every: usize,
    /// Where guides are to start from.
    pub(crate) like: Option<Arc<[Equilibrium]>>,
}

/// Why there is no hairstyle.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PredictError {
    /// A number of the description is out of range.
    #[error(transparent)]
    Spec(#[from] InvalidSpec),
    /// A physical quantity of a guide is out of range.
    #[error(transparent)]
    Quantity(#[from] InvalidQuantity),
    /// A parting is not on the scalp.
    #[error(transparent)]
    Parting(#[from] PartingError),
    /// The scalp has no room for the guides.
    #[error(transparent)]
    Crowded(#[from] Crowded),
    /// The monitor said to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Predicts how hair falls: plants the guides on the head and brings each to the minimum of its
/// energy.
///
/// # Errors
/// [`PredictError`], if the description is out of range or the monitor says to stop. A guide that
/// does not come to rest is not an error: [`Hairstyle::report`] counts it.
pub fn predict(
    spec: &HairstyleSpec,
    head: &Head,
    monitor: &dyn Monitor,
) -> Result<Hairstyle, PredictError> {
    predict_again(spec, head, None, monitor)
}

/// As [`predict`], to the same bytes; what it has in common with `previous`, such as where hairs are
/// rooted, is not computed again.
///
/// # Errors
/// As [`predict`].
pub fn predict_again(
    spec: &HairstyleSpec,
    head: &Head,
    previous: Option<&Hairstyle>,
    monitor: &dyn Monitor,
) -> Result<Hairstyle, PredictError> {
    spec.check()?;
    let known = previous.and_then(|previous| previous.planting.fitting(spec, head));
    let planting = known.map_or_else(|| Planting::new(spec, head), Ok)?;
    let layout = Layout::new(spec, head)?;
    let guides = plan(spec, head, &layout, &planting)?;
    let rest = settle(spec, head, &guides, monitor)?;
    let styling = Styling::none(&guides);
    Ok(Hairstyle { spec: spec.clone(), planting, layout, guides, rest, styling, rough: None })
}

/// As [`predict`], but each guide starts from where that of the same index rests in `previous`
/// instead of from its natural shape: for a description that was changed a little, as by a slider.
///
/// It gives the equilibrium downhill from there, which need not be the one that gravity leads to.
/// Work that does not fit into `effort` is left for the next call, with the answer of this one; until
/// it is done [`Hairstyle::report`] counts guides that are not at rest. Where the number of guides
/// has changed, this is [`predict`]. What styling made of `previous` is not carried over: a
/// [`crate::History`] does its steps again.
///
/// # Errors
/// As [`predict`].
pub fn predict_from(
    spec: &HairstyleSpec,
    head: &Head,
    previous: &Hairstyle,
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Hairstyle, PredictError> {
    if spec.wisps.count != previous.guides.len() {
        return predict(spec, head, monitor);
    }
    spec.check()?;
    let planting = match previous.planting.fitting(spec, head) {
        Some(planting) => planting,
        None => Planting::new(spec, head)?,
    };
    let layout = Layout::new(spec, head)?;
    let guides = plan(spec, head, &layout, &planting)?;
    let rest = settle_from(spec, head, &guides, &previous.rest.guides, effort, monitor)?;
    let styling = Styling::none(&guides);
    Ok(Hairstyle { spec: spec.clone(), planting, layout, guides, rest, styling, rough: None })
}

/// A hairstyle for the eye, in about the time that a slider needs: the guides start from where the
/// nearest guide of `previous` rests, and do no more than `effort`. Unlike in [`predict_from`], another
/// number of guides, another seed or another head may be described. Without `previous` each guide comes
/// to rest alone, and `effort` is what follows.
///
/// # Errors
/// As [`predict`].
pub fn predict_roughly(
    spec: &HairstyleSpec,
    head: &Head,
    previous: Option<&Hairstyle>,
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Hairstyle, PredictError> {
    spec.check()?;
    let known = previous.and_then(|previous| previous.planting.fitting(spec, head));
    let same = known.is_some();
    let planting = known.map_or_else(|| Planting::new(spec, head), Ok)?;
    let layout = Layout::new(spec, head)?;
    let guides = plan(spec, head, &layout, &planting)?;
    let rest = match previous {
        None => settle_roughly(spec, head, &guides, effort, monitor)?,
        Some(previous) if same => {
            settle_from(spec, head, &guides, &previous.rest.guides, effort, monitor)?
        }
        Some(previous) => {
            let before = nearest(&guides, previous);
            settle_from(spec, head, &guides, &before, effort, monitor)?
        }
    };
    let styling = Styling::none(&guides);
    Ok(Hairstyle { spec: spec.clone(), planting, layout, guides, rest, styling, rough: None })
}

/// For each guide, how the one that is rooted nearest to it rests in another hairstyle.
fn nearest(guides: &[Guide], other: &Hairstyle) -> Vec<Equilibrium> {
    let roots: Vec<DVec3> = other.guides.iter().map(|guide| guide.root.position).collect();
    let spacing = (other.planting.area() / roots.len() as f64).sqrt();
    let grid = Grid::new(&roots, spacing);
    let like = |guide: &Guide| {
        let nearest = grid.nearest(guide.root.position, 1, &roots);
        other.rest.guides[nearest[0]].clone()
    };
    guides.par_iter().map(like).collect()
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
        self.styling.wisps()
    }

    /// Mass (kg) of all hair that grows on the head, with the water in it, each hair taken to be as
    /// long as its guide.
    #[must_use]
    pub fn mass(&self) -> f64 {
        let each = self.grown() / self.guides.len() as f64;
        let mass = |guide: &Guide| {
            let rod = guide.rod.spec();
            rod.material.density() * rod.section.area() * rod.length
        };
        self.guides.iter().map(mass).sum::<f64>() * each
    }

    /// The guides, as they were planted, cut, grown and wetted.
    #[must_use]
    pub fn guides(&self) -> &[Guide] {
        &self.guides
    }

    /// The guides, as they came to rest, in the order of [`Self::guides`].
    #[must_use]
    pub fn equilibria(&self) -> &[Equilibrium] {
        &self.rest.guides
    }

    /// How the guides came to rest on the head they were predicted on.
    #[must_use]
    pub fn report(&self, head: &Head) -> SettlingReport {
        SettlingReport::new(head, &self.rest)
    }

    /// How many hairs grow on the scalp, drawn or not.
    #[must_use]
    pub fn grown(&self) -> f64 {
        self.planting.area() * self.spec.implantation.density
    }

    /// The guides as strands of `points` points, with the attribute `guide`.
    #[must_use]
    pub fn guide_strands(&self, points: usize) -> Strands {
        let mut strands = Strands::new();
        for guide in &self.rest.guides {
            let radii = vec![guide.rod.spec().section.mean_radius() as f32; points.max(2)];
            let line: Vec<_> = guide.centre_line(points).iter().map(|p| p.as_vec3()).collect();
            strands.push(&line, &radii);
        }
        let values = AttributeValues::U32((0..self.rest.guides.len() as u32).collect());
        let guide = Attribute { name: "guide".into(), domain: Domain::Strand, values };
        strands.set_attribute(guide).expect("one guide per strand, set once");
        strands
    }

    /// Adds to the drawn hairs of [`Self::strands`] what light needs to know of their sections: `d1`
    /// (three numbers per point), the director along the semi-axis a, and `axis_ratio` (a/b, a number
    /// per strand). Twelve bytes per point.
    ///
    /// # Panics
    /// If they have been added before.
    pub fn add_sections(&self, strands: &mut Strands, head: &Head) {
        strands::add_sections(strands, self, head);
    }

    /// Adds to the drawn hairs of [`Self::strands`], all of them, what programs that groom want to know:
    /// `closest_guides`, `guide_weights`, `id`, `group` and `root_uv`, as [`frisure_strands::names`] has them.
    /// The texture coordinates of roots are a map of the head from above (azimuthal equidistant): (½, ½)
    /// is above the middle of the cranium, u grows to the head's left, v to the back, and the distance from the
    /// middle is the angle from the vertical over 2π.
    ///
    /// # Panics
    /// If they have been added before, or these are not all drawn hairs.
    pub fn describe(&self, strands: &mut Strands, head: &Head) {
        strands::describe_hairs(strands, self, head);
    }

    /// Adds to drawn hairs the natural strains (rad/m) of the guides that they follow, `natural_strain`.
    ///
    /// # Panics
    /// If they have been added before.
    pub fn add_natural_strains(&self, strands: &mut Strands) {
        strands::add_natural_strains(strands, self);
    }

    /// The guides as strands of `points` points, at least 2, with `id`, `group`, `root_uv`, `axis_ratio`, `d1`,
    /// `natural_strain`, and `wetness` if any is wet.
    #[must_use]
    pub fn described_guides(&self, head: &Head, points: usize) -> Strands {
        strands::described_guides(self, head, points)
    }

    /// The drawn hairs around the guides, with the attribute `guide`, the nearest guide of each.
    ///
    /// # Errors
    /// [`Cancelled`], if the monitor says to stop.
    pub fn strands(&self, head: &Head, monitor: &dyn Monitor) -> Result<Strands, Cancelled> {
        Ok(strands::draw(self, head, 1, monitor, None)?.0)
    }

    /// As [`Self::strands`], with how simulated hairs came to rest ([`crate::HairModel::Simulated`]; nothing for others).
    ///
    /// Simulated hairs are found and kept part by part where `keep` says, if it does; what is there has to be of the same
    /// [`Self::simulation_key`].
    ///
    /// # Errors
    /// [`Cancelled`], if the monitor says to stop.
    pub fn strands_and_simulation(
        &self,
        head: &Head,
        monitor: &dyn Monitor,
        keep: Option<&dyn Keep>,
    ) -> Result<(Strands, Simulation), Cancelled> {
        strands::draw(self, head, 1, monitor, keep)
    }

    /// A digest of all that the simulated hairs depend on, for the same build; none if hairs are not simulated.
    #[must_use]
    pub fn simulation_key(&self, head: &Head) -> Option<u64> {
        strands::simulation_key(self, head)
    }

    /// Of the hairs of [`Self::strands`] the first and every so manyth after it, the same to the last
    /// bit: for a view that has to be quick.
    ///
    /// # Errors
    /// [`Cancelled`], if the monitor says to stop.
    pub fn some_strands(
        &self,
        head: &Head,
        every: usize,
        monitor: &dyn Monitor,
    ) -> Result<Strands, Cancelled> {
        Ok(strands::draw(self, head, every, monitor, None)?.0)
    }

    /// The hairstyle of another description as [`predict`] would give it, if the two differ in nothing but
    /// which hairs are drawn around the guides; none also for a hairstyle that was styled.
    #[must_use]
    pub fn redrawn(&self, spec: &HairstyleSpec) -> Option<Self> {
        let Wisps { count, fuzziness, .. } = spec.wisps;
        let wisps = Wisps { count, fuzziness, ..self.spec.wisps };
        let baby_hairs = self.spec.implantation.baby_hairs;
        let implantation = Implantation { baby_hairs, ..spec.implantation.clone() };
        let same = HairstyleSpec { wisps, implantation, ..spec.clone() } == self.spec;
        let unstyled = || self.styling.is_none(&self.guides);
        let possible =
            || spec.check().is_ok() && spec.wisps.check_size(self.planting.area()).is_ok();
        (same && unstyled() && possible()).then(|| Self { spec: spec.clone(), ..self.clone() })
    }

    /// How many hairs [`Self::strands`] draws.
    #[must_use]
    pub fn drawn(&self) -> usize {
        self.spec.wisps.hair_count(self.planting.area())
    }
}
