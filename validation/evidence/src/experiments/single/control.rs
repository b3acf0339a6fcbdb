//! The reason why ellipticity changes a curl: round hair with one of the stiffnesses of elliptical hair.

use frisure::rod::{Material, Rod, RodSpec, Section, TorsionConstant};
use rayon::prelude::*;

use super::claim::{CURLS, curl, irregular};
use crate::{Finding, Stopped, Table};

/// Stiffnesses that a round hair takes from the elliptical hair; its weight is always that of the elliptical hair.
#[derive(Clone, Copy)]
struct Given {
    name: &'static str,
    /// EI about the axis of the curl.
    bend: bool,
    /// GJ.
    twist: bool,
}

const GIVEN: [Given; 3] = [
    Given { name: "round, with the EI of the curl's axis and GJ", bend: true, twist: true },
    Given { name: "round, with that EI alone", bend: true, twist: false },
    Given { name: "round, with that GJ alone", bend: false, twist: true },
];

const ECCENTRICITIES: [f64; 4] = [0.2, 0.6, 0.75, 0.9];

const TORSION: TorsionConstant = TorsionConstant::SaintVenant;

fn round(elliptical: &RodSpec, soft: bool, given: Given) -> Result<RodSpec, Stopped> {
    let section = Section::from_mean_radius(elliptical.section.mean_radius(), 0.0)?;
    let whole = Rod::new(elliptical.clone())?.stiffness();
    let plain = Rod::new(RodSpec { section, ..elliptical.clone() })?.stiffness();
    let axis = if soft { whole.x } else { whole.y };
    let material = elliptical.material;
    let young = if given.bend { axis / plain.x } else { 1.0 };
    let shear = if given.twist { whole.z / plain.z } else { 1.0 };
    let material = Material::new(
        material.youngs_modulus() * young,
        material.shear_modulus() * shear,
        material.density(),
    )?;
    Ok(RodSpec { section, material, ..elliptical.clone() })
}

/// Mean over the curls of the irregularity of curvature over that of unmodified round hair.
fn mean(soft: bool, e: f64, given: Option<Given>) -> Result<f64, Stopped> {
    let one = |k: usize| -> Result<f64, Stopped> {
        let elliptical = curl(k, soft, TORSION, e)?;
        let hair = match given {
            Some(given) => round(&elliptical, soft, given)?,
            None => elliptical,
        };
        Ok(irregular(&hair)?[0] / irregular(&curl(k, soft, TORSION, 0.0)?)?[0])
    };
    let all: Vec<f64> =
        (0..CURLS.len()).into_par_iter().map(one).collect::<Result<_, Stopped>>()?;
    Ok(all.iter().sum::<f64>() / all.len() as f64)
}

pub(super) fn add(finding: &mut Finding) -> Result<(), Stopped> {
    let mut table = Table::new(
        "The reason: irregularity of curvature over that at ε = 0, for elliptical hair and for round hair with a stiffness of the elliptical \
         (Saint-Venant)",
        &["curl about", "hair", "ε = 0.2", "0.6", "0.75", "0.9"],
    );
    for (soft, axis) in [(true, "soft axis"), (false, "stiff axis")] {
        for given in [None].into_iter().chain(GIVEN.map(Some)) {
            let name = given.map_or("elliptical", |g| g.name);
            let mut cells = vec![axis.to_owned(), name.to_owned()];
            for e in ECCENTRICITIES {
                cells.push(format!("{:.3}", mean(soft, e, given)?));
            }
            table.row(cells);
        }
    }
    finding.table(table);
    finding.text(
        "Round hair that has the elliptical one's stiffness EI about the axis of the curl, EI(1 − ε²)^(½) about the soft and \
         EI(1 − ε²)^(−½) about the stiff axis at constant mean radius, has seven to nine tenths of its change. The twisting \
         stiffness GJ hardly matters. The rest, where both are equal, is due to the stiffness of elliptical hair about its other \
         axis.",
    );
    Ok(())
}
