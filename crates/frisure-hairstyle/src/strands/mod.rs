//! The drawn hairs: a stochastic population around the guides.
//!
//! After Choe & Ko 2005, the hairs of a wisp keep their place in a cross-section that gathers from
//! the patch of skin where they grow to the thickness of the wisp, deviate from it by a coherent
//! random process (never white noise), and vary in length. Beyond it: a wisp splits into thinner
//! ones, neighbouring wisps blend where hair is a smooth mass, every hair is rooted in the skin where
//! its root is, and hairs that would lie in the body are laid on it, in the order in which they lay.

mod carried;
mod course;
mod described;
mod population;
mod simulated;
mod skin;

use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::Vec3;
use rayon::prelude::*;

use crate::guides::Guide;
use crate::hairstyle::Hairstyle;
use crate::head::Head;
use crate::implantation::smooth;
use crate::monitor::{Cancelled, Monitor, Stage};
use crate::spec::{HairModel, HairstyleSpec};

pub(crate) use carried::Carried;
pub(crate) use described::{add_natural_strains, describe_hairs, described_guides};
use population::Hair;
pub(crate) use population::{Population, roots};
use simulated::Simulated;
pub use simulated::{Keep, Simulation};

/// Radius at the tip, as a fraction of the fibre's.
const TIP: f64 = 0.35;

/// Draws every so manyth hair of a head, the first among them; parts of simulated hairs can be kept.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn draw(
    hairstyle: &Hairstyle,
    head: &Head,
    every: usize,
    monitor: &dyn Monitor,
    keep: Option<&dyn Keep>,
) -> Result<(Strands, Simulation), Cancelled> {
    let population = Population::new(hairstyle, head);
    let roots = roots(hairstyle, head, every);
    let (hairs, simulation) = match hairstyle.spec.wisps.strands {
        HairModel::Simulated if population.carried.is_none() => {
            let stage = Stage::new(monitor, "simulating hairs", roots.len());
            Simulated::new(&population, hairstyle).hairs(&roots, &stage, keep)?
        }
        _ => {
            let stage = Stage::new(monitor, "drawing hairs", roots.len());
            let hairs = roots.par_iter().map(|(index, root)| {
                stage.check()?;
                let hair = population.hair(root, *index);
                stage.advance();
                Ok(hair)
            });
            (hairs.collect::<Result<_, Cancelled>>()?, Simulation::default())
        }
    };
    let mut strands = assemble(&hairstyle.spec, &hairstyle.guides, &hairs);
    wet(&mut strands, hairstyle, &hairs);
    Ok((strands, simulation))
}

/// What the simulated hairs of a hairstyle depend on; none if there are none.
pub(crate) fn simulation_key(hairstyle: &Hairstyle, head: &Head) -> Option<u64> {
    let simulated = hairstyle.spec.wisps.strands == HairModel::Simulated;
    simulated.then(|| simulated::key(hairstyle, head, &roots(hairstyle, head, 1)))
}

/// Adds the sections of the drawn hairs: the director d1 at each point, and the axis ratio of each
/// strand.
pub(crate) fn add_sections(strands: &mut Strands, hairstyle: &Hairstyle, head: &Head) {
    let Some(AttributeValues::U32(guides)) = strands.attribute("guide").map(|a| &a.values) else {
        return;
    };
    let population = Population::new(hairstyle, head);
    let points = hairstyle.spec.wisps.points;
    let directors: Vec<[f32; 3]> = (guides.par_iter().enumerate())
        .flat_map_iter(|(strand, &guide)| {
            // Hairs of a wisp turn with their guide, at the same distance from the root.
            let line = strands.strand(strand).points;
            let length = line.windows(2).map(|p| p[0].distance(p[1])).sum::<f32>();
            let wisp = population.wisp(guide as usize);
            let step = f64::from(length) / wisp.length / (points - 1) as f64;
            (0..points).map(move |k| wisp.director(k as f64 * step).to_array())
        })
        .collect();
    let ratio = |&guide: &u32| {
        let section = hairstyle.guides[guide as usize].rod.spec().section;
        (section.a() / section.b()) as f32
    };
    let ratios = AttributeValues::F32(guides.iter().map(ratio).collect());
    let d1 = AttributeValues::F32x3(directors);
    let d1 = Attribute { name: "d1".into(), domain: Domain::Point, values: d1 };
    let ratios = Attribute { name: "axis_ratio".into(), domain: Domain::Strand, values: ratios };
    for attribute in [d1, ratios] {
        strands.set_attribute(attribute).expect("one value each, set once");
    }
}

/// Deepest that a point of the strands, other than a root, is inside the body of a head (m); 0 if
/// none is.
#[must_use]
pub fn penetration(strands: &Strands, head: &Head) -> f64 {
    (0..strands.len())
        .into_par_iter()
        .map(|i| {
            let depth = |p: &Vec3| -head.signed_distance().value(p.as_dvec3());
            strands.strand(i).points.iter().skip(1).map(depth).fold(0.0, f64::max)
        })
        .reduce(|| 0.0, f64::max)
}

/// The strands, each as thick as its guide.
fn assemble(spec: &HairstyleSpec, guides: &[Guide], hairs: &[Hair]) -> Strands {
    let points = spec.wisps.points;
    let taper: Vec<f64> = (0..points)
        .map(|i| 1.0 - (1.0 - TIP) * smooth(0.85, 1.0, i as f64 / (points - 1) as f64))
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
    let guide = Attribute { name: "guide".into(), domain: Domain::Strand, values };
    strands.set_attribute(guide).expect("one guide per strand, set once");
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
    let wetness = Attribute { name: "wetness".into(), domain: Domain::Point, values };
    strands.set_attribute(wetness).expect("one number per point, set once");
}
