//! Predicting how hair falls: roots and guides of a description, and their equilibrium.

use frisure_rod::{Equilibrium, InvalidQuantity};
use glam::DVec3;
use thiserror::Error;

use crate::equilibrium::{Effort, GuideStart, SettleOptions, settle};
use crate::guides::{Guide, plan};
use crate::hairstyle::Hairstyle;
use crate::hairstyle::Styling;
use crate::hairstyle::{Crowded, RootPlacement};
use crate::head::Head;
use crate::implantation::{Layout, PartingError};
use crate::math::Grid;
use crate::parallel;
use crate::spec::{HairstyleSpec, Implantation, InvalidSpec, Wisps};
use frisure_progress::{Cancelled, Progress};

/// How [`predict`] computes. The default is the exact prediction, from nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct PredictOptions<'a> {
    /// A hairstyle that was predicted before. What it has in common with this one, such as where
    /// hairs are rooted, is not computed again; that changes no byte of the result.
    pub previous: Option<&'a Hairstyle>,
    /// Where guides start from.
    pub start: Start,
    /// How much work is done at most.
    pub effort: Effort,
}

/// Where guides start from on their way to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// From their natural shape, following gravity as it is turned on: the exact prediction.
    #[default]
    Natural,
    /// From where the guide of [`PredictOptions::previous`] rests that has the same root, or the
    /// nearest. This gives the equilibrium downhill from there, which need not be the one that
    /// gravity leads to. Without a previous hairstyle each guide comes to rest alone first, at any
    /// [`PredictOptions::effort`].
    Previous,
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
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Predicts how hair falls: places the guides on the head and brings each to the minimum of its
/// energy.
///
/// With less than [`Effort::FULL`], or from [`Start::Previous`], it gives a hairstyle for the eye, as
/// quick as a slider needs; what is left undone is done by a further call that starts from it, and
/// [`crate::settling_report`] counts the guides that are not at rest yet. What styling made of the
/// previous hairstyle is not carried over: a [`crate::History`] does its steps again.
///
/// ```
/// use frisure_hairstyle::{
///     Effort, PredictOptions, Start, head::Head, predict, preset, settling_report,
/// };
///
/// let mut spec = preset("wavy").expect("a preset").spec();
/// spec.wisps.count = 12;
/// let head = Head::mannequin();
/// let exact = predict(&spec, &head, PredictOptions::default(), &())?;
/// assert_eq!(settling_report(&exact, &head).stable, 12);
///
/// // A longer head of hair for a slider: each guide starts from where it lay, with a bound on the work.
/// spec.length.mean *= 1.1;
/// let options = PredictOptions {
///     previous: Some(&exact),
///     start: Start::Previous,
///     effort: Effort { iterations: 4, sweeps: 0 },
/// };
/// let rough = predict(&spec, &head, options, &())?;
/// assert_eq!(rough.equilibria().len(), 12);
/// # Ok::<(), frisure_hairstyle::PredictError>(())
/// ```
///
/// # Errors
/// [`PredictError`], if the description is out of range or the work is cancelled. A guide that
/// does not come to rest is not an error: [`crate::settling_report`] counts it.
pub fn predict(
    spec: &HairstyleSpec,
    head: &Head,
    options: PredictOptions<'_>,
    progress: &dyn Progress,
) -> Result<Hairstyle, PredictError> {
    spec.check()?;
    let PredictOptions { previous, start, effort } = options;
    let known = previous.and_then(|previous| previous.placement.fitting(spec, head));
    let same_roots = known.is_some();
    let placement = known.map_or_else(|| RootPlacement::new(spec, head), Ok)?;
    let layout = Layout::new(spec, head)?;
    spec.wisps.check_size(placement.area())?;
    let guides = plan(spec, head, &layout, placement.roots(), placement.area())?;
    let nearest_rests;
    let start = match previous.filter(|_| start == Start::Previous) {
        None => GuideStart::Natural,
        Some(previous) if same_roots => GuideStart::At(&previous.rest.guides),
        Some(previous) => {
            nearest_rests = nearest(&guides, previous);
            GuideStart::At(&nearest_rests)
        }
    };
    let options = SettleOptions { start, effort, locks: Vec::new() };
    let rest = settle(spec, head, &guides, options, progress)?;
    let styling = Styling::none(&guides);
    Ok(Hairstyle { spec: spec.clone(), placement, layout, guides, rest, styling })
}

/// The equilibrium, for each guide, of the guide rooted nearest to it in another hairstyle.
fn nearest(guides: &[Guide], other: &Hairstyle) -> Vec<Equilibrium> {
    let roots: Vec<DVec3> = other.guides.iter().map(|guide| guide.root.position).collect();
    let spacing = (other.placement.area() / roots.len() as f64).sqrt();
    let grid = Grid::new(&roots, spacing);
    let like = |guide: &Guide| {
        let nearest = grid.nearest(guide.root.position, 1, &roots);
        other.rest.guides[nearest[0]].clone()
    };
    parallel::map_slice(guides, like)
}

/// The hairstyle of another description as [`predict`] gives it, if the two differ in nothing but
/// which hairs are drawn around the guides; none also for a hairstyle that was styled.
#[must_use]
pub fn redrawn(hairstyle: &Hairstyle, spec: &HairstyleSpec) -> Option<Hairstyle> {
    let Wisps { count, fuzziness, .. } = spec.wisps;
    let wisps = Wisps { count, fuzziness, ..hairstyle.spec.wisps };
    let baby_hairs = hairstyle.spec.implantation.baby_hairs;
    let implantation = Implantation { baby_hairs, ..spec.implantation.clone() };
    let same = HairstyleSpec { wisps, implantation, ..spec.clone() } == hairstyle.spec;
    let possible =
        || spec.check().is_ok() && spec.wisps.check_size(hairstyle.placement.area()).is_ok();
    (same && !hairstyle.is_styled() && possible())
        .then(|| Hairstyle { spec: spec.clone(), ..hairstyle.clone() })
}
