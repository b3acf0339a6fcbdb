//! What lines do not tell: the directions in which a fit is uncertain, by the names of the numbers that trade with each other.

use serde::Serialize;

use crate::dense::Symmetric;
use crate::solve::Job;
use crate::unknowns::Unknowns;

/// A number of a fibre.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Natural curvature.
    Curvature,
    /// Natural torsion.
    Torsion,
    /// EI/(ρSg).
    StiffnessOverWeight,
    /// GJ/EI.
    TorsionRatio,
}

impl Quantity {
    const ALL: [Self; 4] =
        [Self::Curvature, Self::Torsion, Self::StiffnessOverWeight, Self::TorsionRatio];

    /// Its name in a sentence.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Curvature => "natural curvature",
            Self::Torsion => "natural torsion",
            Self::StiffnessOverWeight => "stiffness over weight",
            Self::TorsionRatio => "torsional over bending stiffness",
        }
    }
}

/// A combination of numbers that the lines do not tell.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Blind {
    /// Its relative standard deviation: of strains over the whole strain, of the logarithms of stiffnesses.
    pub deviation: f64,
    /// The numbers in it, the largest part first, each with its part; the squares of the parts of all numbers are 1 together.
    pub parts: Vec<(Quantity, f64)>,
}

/// Relative deviation above which a combination counts as not told. Chosen: with half of it a number is known to 10 %.
const NOT_TOLD: f64 = 0.2;

/// Least part of a number in a combination that is named. Chosen.
const LEAST_PART: f64 = 0.3;

/// The directions of uncertainty of the shared unknowns in the first state: eigenvectors of their covariance, in relative units.
pub(crate) fn blind_directions(
    job: &Job<'_>,
    unknowns: &Unknowns,
    covariance: &Symmetric,
) -> Vec<Blind> {
    let layout = job.layout;
    let (k, t) = unknowns.mean_strain();
    // A fibre that is nearly straight: one turn in its length instead.
    let strain = k.hypot(t).max(std::f64::consts::TAU / unknowns.length[0].exp());
    let middle = layout.knots / 2;
    let indices =
        [layout.curvature(middle), layout.torsion(middle), layout.stiffness(0), layout.ratio(0)];
    let mut relative = covariance.part(&indices);
    for i in 0..4 {
        for j in 0..=i {
            let unit = |n: usize| if n < 2 { strain } else { 1.0 };
            relative.set(i, j, relative.at(i, j) / (unit(i) * unit(j)));
        }
    }
    let (values, vectors) = relative.eigen();
    let mut blind: Vec<Blind> = values
        .iter()
        .zip(&vectors)
        .filter(|(value, _)| value.max(0.0).sqrt() > NOT_TOLD)
        .map(|(value, vector)| {
            let mut parts: Vec<(Quantity, f64)> = Quantity::ALL
                .into_iter()
                .zip(vector.iter().copied())
                .filter(|(_, part)| part.abs() >= LEAST_PART)
                .collect();
            parts.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            Blind { deviation: value.sqrt(), parts }
        })
        .collect();
    blind.sort_by(|a, b| b.deviation.total_cmp(&a.deviation));
    blind
}

/// A sentence about a combination, for a fibre with this many poses.
pub(crate) fn sentence(blind: &Blind, poses: usize) -> String {
    let pose = if poses == 1 { "this pose" } else { "these poses" };
    let names: Vec<&str> = blind.parts.iter().map(|(quantity, _)| quantity.name()).collect();
    let percent = 100.0 * blind.deviation;
    let more = if poses == 1 {
        "add a second pose (with weight, clamped in another direction or upside down; or without weight, lying flat, if this one has weight)"
    } else {
        "add a pose in which gravity bends the fibre in another way"
    };
    match names.as_slice() {
        [] => format!("{pose} does not tell everything apart (±{percent:.0} %): {more}"),
        [one] => {
            let name =
                if *one == "torsional over bending stiffness" || *one == "stiffness over weight" {
                    *one
                } else {
                    "natural strain"
                };
            format!(
                "{one} cannot be told from {pose} (±{percent:.0} %): {more}, or give a known {name}"
            )
        }
        [first, rest @ ..] => {
            let rest = rest.join(" and ");
            format!(
                "{first} and {rest} cannot be told apart in {pose} (±{percent:.0} % along their combination): {more}, or give \
                 one of them as known"
            )
        }
    }
}
