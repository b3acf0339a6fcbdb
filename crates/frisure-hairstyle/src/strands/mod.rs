//! The drawn hairs: a stochastic population around the guides.
//!
//! After Choe & Ko 2005, the hairs of a wisp keep their place in a cross-section that gathers from
//! the patch of skin where they grow to the thickness of the wisp, deviate from it by a coherent
//! random process (never white noise), and vary in length. Beyond it: a wisp splits into thinner
//! ones, neighbouring wisps blend where hair is a smooth mass, every hair is rooted in the skin where
//! its root is, and hairs that would lie in the body are laid on it, in the order in which they lay.

mod attributes;
mod binding;
mod curve;
mod described;
mod gathering;
mod locks;
mod population;
mod simulated;
mod skin;
mod splits;
mod winding;

use frisure_strands::{AttributeValues, Domain, Strands, names};
use glam::DVec3;

use crate::guides::Guide;
use crate::hairstyle::Hairstyle;
use crate::head::Head;
use crate::math::smooth_step;
use crate::parallel;
use crate::spec::{HairModel, HairstyleSpec, StrandContact};
use crate::strand_contact::InteractionForm;
use frisure_progress::{Cancelled, Progress, StageCounter};

use attributes::put;
use curve::Hair;
pub use described::{add_natural_strains, describe, described_guides, guide_strands};
pub(crate) use population::{Population, roots};
use simulated::Simulated;
pub use simulated::{Checkpoint, Simulation};

/// Radius at the tip, as a fraction of the fibre's. Chosen by eye; not measured.
const TIP: f64 = 0.35;

/// Share of its length from which on an uncut hair tapers. Chosen by eye; not measured.
const TAPER: f64 = 0.85;

/// How [`strands`] draws. The default draws every hair.
#[derive(Clone, Copy)]
pub struct StrandOptions<'a> {
    /// Draws the first hair and every `stride`-th after it, each the same to the last bit as among all: for
    /// a view that has to be quick. 0 counts as 1. Hairs in contact with each other ([`StrandContact::Contacts`]) are
    /// not the same then: each stands for more hairs.
    pub stride: usize,
    /// Where simulated hairs are saved part by part as they come to rest, and found again; it has to be of
    /// the same [`simulation_key`] and the same stride. Hairs in contact with each other are not saved: no part of
    /// them is at rest before all are.
    pub checkpoint: Option<&'a dyn Checkpoint>,
}

impl Default for StrandOptions<'_> {
    fn default() -> Self {
        Self { stride: 1, checkpoint: None }
    }
}

/// The drawn hairs of a head.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnHair {
    /// The hairs, with the attribute `guide`, the nearest guide of each, and `wetness` if any is wet.
    pub strands: Strands,
    /// How hairs that are rods came to rest ([`HairModel::Simulated`]; zeros for others).
    pub simulation: Simulation,
}

/// Draws the hairs around the guides of a hairstyle.
///
/// ```
/// use frisure_hairstyle::{Hairs, PredictOptions, StrandOptions, head::Head, predict, preset, strands};
///
/// let mut spec = preset("straight").expect("a preset").spec();
/// spec.wisps.count = 12;
/// spec.wisps.hairs = Hairs::Count(60);
/// let head = Head::mannequin();
/// let hairstyle = predict(&spec, &head, PredictOptions::default(), &())?;
///
/// let all = strands(&hairstyle, &head, StrandOptions::default(), &())?.strands;
/// assert_eq!(all.len(), 60);
/// // Every tenth hair for a quick view, each the same as among all.
/// let options = StrandOptions { stride: 10, ..StrandOptions::default() };
/// let few = strands(&hairstyle, &head, options, &())?.strands;
/// assert_eq!(few.strand(1).points, all.strand(10).points);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Cancelled`], if the work is cancelled.
pub fn strands(
    hairstyle: &Hairstyle,
    head: &Head,
    options: StrandOptions<'_>,
    progress: &dyn Progress,
) -> Result<DrawnHair, Cancelled> {
    let population = Population::new(hairstyle, head);
    let roots = roots(hairstyle, head, options.stride);
    let (hairs, simulation) = match hairstyle.spec.wisps.strands {
        HairModel::Simulated if population.bound.is_none() => {
            let stage = StageCounter::new(progress, "simulating hairs", roots.len());
            let simulated = Simulated::new(&population, hairstyle);
            match hairstyle.spec.wisps.contact {
                StrandContact::Tube => simulated.hairs(&roots, &stage, options.checkpoint)?,
                StrandContact::Contacts => {
                    simulated.in_contact(&roots, InteractionForm::Contacts, &stage, progress)?
                }
                StrandContact::Density => {
                    simulated.in_contact(&roots, InteractionForm::Density, &stage, progress)?
                }
            }
        }
        _ => {
            let stage = StageCounter::new(progress, "drawing hairs", roots.len());
            let hair = |i: usize| {
                stage.check()?;
                let (index, root) = &roots[i];
                let hair = population.hair(root, *index);
                stage.advance();
                Ok(hair)
            };
            (parallel::try_map(roots.len(), hair)?, Simulation::default())
        }
    };
    let mut strands = assemble(&hairstyle.spec, &hairstyle.guides, &hairs);
    wet(&mut strands, hairstyle, &hairs);
    Ok(DrawnHair { strands, simulation })
}

/// A digest of everything that the simulated hairs of a hairstyle depend on, for the same build; none if its
/// hairs are not simulated.
#[must_use]
pub fn simulation_key(hairstyle: &Hairstyle, head: &Head) -> Option<u64> {
    let simulated = hairstyle.spec.wisps.strands == HairModel::Simulated;
    simulated.then(|| simulated::key(hairstyle, head, &roots(hairstyle, head, 1)))
}

/// Adds to drawn hairs the attributes of their sections for rendering: `d1` (three numbers per point), the
/// director along the semi-axis a, and `axis_ratio` (a/b, a number per strand). Twelve bytes per point.
///
/// # Panics
/// If they have been added before.
pub fn add_sections(strands: &mut Strands, hairstyle: &Hairstyle, head: &Head) {
    let Some(AttributeValues::U32(guides)) = strands.attribute(names::GUIDE).map(|a| &a.values)
    else {
        return;
    };
    let population = Population::new(hairstyle, head);
    let points = hairstyle.spec.wisps.points;
    let directors = parallel::map(guides.len(), |strand| -> Vec<[f32; 3]> {
        // Hairs of a wisp turn with their guide, at the same distance from the root.
        let line = strands.strand(strand).points;
        let length = line.windows(2).map(|p| p[0].distance(p[1])).sum::<f32>();
        let wisp = population.wisp(guides[strand] as usize);
        let step = f64::from(length) / wisp.length / (points - 1) as f64;
        (0..points).map(|k| wisp.director(k as f64 * step).to_array()).collect()
    });
    let ratio = |&guide: &u32| {
        let section = hairstyle.guides[guide as usize].rod.spec().section;
        (section.a() / section.b()) as f32
    };
    let ratios = AttributeValues::F32(guides.iter().map(ratio).collect());
    put(strands, Domain::Point, names::DIRECTOR, AttributeValues::F32x3(directors.concat()));
    put(strands, Domain::Strand, names::AXIS_RATIO, ratios);
}

/// Deepest that the strands are inside the body of a head (m), other than in their first 2 mm, where the follicle is; 0 if none is.
///
/// Points are measured, and the lines between them every 2 mm where they could be inside.
#[must_use]
pub fn penetration(strands: &Strands, head: &Head) -> f64 {
    let height = |p: DVec3| head.signed_distance().value(p);
    let depths = parallel::map(strands.len(), |i| {
        let points = strands.strand(i).points;
        let Some(root) = points.first() else { return 0.0 };
        let (mut before, mut above) = (root.as_dvec3(), 0.0);
        let (mut deepest, mut arc) = (0.0_f64, 0.0);
        for point in &points[1..] {
            let point = point.as_dvec3();
            let (length, here) = (before.distance(point), height(point));
            deepest = deepest.max(-here);
            // No point of the piece is nearer to the body than this: a distance changes by a way at most.
            let lowest = 0.5 * (above + here - length);
            if lowest < -deepest {
                for share in skin::looked_at(length, arc) {
                    deepest = deepest.max(-height(before.lerp(point, share)));
                }
            }
            (before, above, arc) = (point, here, arc + length);
        }
        deepest
    });
    depths.into_iter().fold(0.0, f64::max)
}

/// The strands, each as thick as its guide.
fn assemble(spec: &HairstyleSpec, guides: &[Guide], hairs: &[Hair]) -> Strands {
    let points = spec.wisps.points;
    let taper: Vec<f64> = (0..points)
        .map(|i| 1.0 - (1.0 - TIP) * smooth_step(TAPER, 1.0, i as f64 / (points - 1) as f64))
        .collect();
    let mut strands = Strands::with_capacity(hairs.len(), hairs.len() * points);
    let mut radii = vec![0.0; points];
    for hair in hairs {
        let radius = guides[hair.guide as usize].rod.spec().section.mean_radius() * hair.thickness;
        for (here, taper) in radii.iter_mut().zip(&taper) {
            // Scissors leave blunt ends.
            *here = (radius * if hair.cut { 1.0 } else { *taper }) as f32;
        }
        strands.push(&hair.points, &radii);
    }
    let values = AttributeValues::U32(hairs.iter().map(|h| h.guide).collect());
    put(&mut strands, Domain::Strand, names::GUIDE, values);
    strands
}

/// How wet the hair is at each point, if any is.
fn wet(strands: &mut Strands, hairstyle: &Hairstyle, hairs: &[Hair]) {
    let wisps = hairstyle.wisps();
    if wisps.iter().all(|wisp| wisp.wetness == 0.0) {
        return;
    }
    let wetness = |hair: &Hair| {
        let wetness = wisps[hair.guide as usize].wetness as f32;
        std::iter::repeat_n(wetness, hair.points.len())
    };
    let values = AttributeValues::F32(hairs.iter().flat_map(wetness).collect());
    put(strands, Domain::Point, names::WETNESS, values);
}
