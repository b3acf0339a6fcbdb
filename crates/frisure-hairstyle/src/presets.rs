//! Hair types to start from.
//!
//! Numbers are round values inside measured ranges: diameters and axis ratios after the tables in
//! Robbins (2012) and Loussouarn et al. (2007), moduli after Robbins (E 3.9 GPa, G 0.9 GPa), curls
//! by the eye from the curl types of de la Mettrie et al. (2007).

use frisure_rod::{ElementKind, Material, Resolution, Section, TorsionConstant};

use crate::fibre::{Curl, Fibre};
use crate::spec::{
    Body, Contact, Flow, HairstyleSpec, Implantation, Length, Lift, Settling, Wisps,
};

/// A named hair type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Name as scenes write it.
    pub name: &'static str,
    /// One sentence for a list.
    pub description: &'static str,
    numbers: Numbers,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Numbers {
    /// Mean diameter (m).
    diameter: f64,
    axis_ratio: f64,
    /// Curl radius and pitch (m).
    curl: (f64, f64),
    variation_between: f64,
    variation_along: f64,
    /// Mean length (m).
    length: f64,
    flow: Flow,
    lift_scale: f64,
    /// Deviation of the direction between wisps (rad).
    jitter: f64,
    clumping: f64,
    fuzziness: f64,
    flyaways: f64,
    blending: f64,
    count: usize,
    points: usize,
    volume: f64,
}

const STRAIGHT: Numbers = Numbers {
    diameter: 70e-6,
    axis_ratio: 1.3,
    curl: (0.30, 0.50),
    variation_between: 0.5,
    variation_along: 0.2,
    length: 0.25,
    flow: Flow::Parted { offset: 0.02 },
    lift_scale: 0.8,
    jitter: 0.05,
    clumping: 0.45,
    fuzziness: 0.12,
    flyaways: 0.01,
    blending: 0.7,
    count: 300,
    points: 32,
    volume: 1.0,
};

/// Every preset, in the order in which curls tighten.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "asian-straight",
        description: "thick, round, straight, leaving the scalp steeply",
        numbers: Numbers { diameter: 85e-6, axis_ratio: 1.15, lift_scale: 1.1, ..STRAIGHT },
    },
    Preset { name: "caucasian-straight", description: "fine and straight", numbers: STRAIGHT },
    Preset {
        name: "caucasian-wavy",
        description: "loose waves of a few centimetres",
        numbers: Numbers {
            axis_ratio: 1.4,
            curl: (0.012, 0.09),
            variation_between: 0.2,
            variation_along: 0.15,
            length: 0.28,
            clumping: 0.6,
            fuzziness: 0.15,
            blending: 0.35,
            points: 48,
            count: 200,
            ..STRAIGHT
        },
    },
    Preset {
        name: "caucasian-curly",
        description: "ringlets a finger wide",
        numbers: Numbers {
            axis_ratio: 1.45,
            curl: (0.010, 0.024),
            variation_between: 0.12,
            variation_along: 0.08,
            length: 0.28,
            flow: Flow::SweptBack,
            clumping: 0.75,
            fuzziness: 0.18,
            flyaways: 0.02,
            blending: 0.15,
            volume: 1.5,
            points: 48,
            count: 250,
            ..STRAIGHT
        },
    },
    Preset {
        name: "frizzy",
        description: "tight, irregular curls that stand off the head",
        numbers: Numbers {
            diameter: 68e-6,
            axis_ratio: 1.7,
            curl: (0.0045, 0.012),
            variation_between: 0.3,
            variation_along: 0.35,
            length: 0.18,
            flow: Flow::SweptBack,
            lift_scale: 2.0,
            jitter: 0.3,
            clumping: 0.45,
            fuzziness: 0.4,
            flyaways: 0.05,
            blending: 0.2,
            volume: 2.0,
            points: 64,
            count: 800,
        },
    },
    Preset {
        name: "african-coily",
        description: "elliptical section, coils a few millimetres wide",
        numbers: Numbers {
            diameter: 66e-6,
            axis_ratio: 1.8,
            curl: (0.0028, 0.006),
            variation_between: 0.25,
            variation_along: 0.25,
            length: 0.14,
            flow: Flow::SweptBack,
            lift_scale: 2.0,
            jitter: 0.3,
            clumping: 0.5,
            fuzziness: 0.2,
            flyaways: 0.04,
            blending: 0.1,
            volume: 3.0,
            points: 72,
            count: 1200,
        },
    },
];

/// The preset of that name.
#[must_use]
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|p| p.name == name)
}

impl Preset {
    /// A whole hairstyle of this type.
    ///
    /// # Panics
    /// Never: a test makes every preset.
    #[must_use]
    pub fn spec(&self) -> HairstyleSpec {
        let n = &self.numbers;
        let curl = Curl::helix(n.curl.0, n.curl.1).expect("presets are valid");
        HairstyleSpec {
            seed: 1,
            fibre: Fibre {
                section: Section::from_diameter(n.diameter, n.axis_ratio)
                    .expect("presets are valid"),
                material: Material::new(3.9e9, 0.9e9, 1300.0).expect("presets are valid"),
                torsion: TorsionConstant::SaintVenant,
            },
            curl: Curl {
                variation_between: n.variation_between,
                variation_along: n.variation_along,
                ..curl
            },
            length: Length { mean: n.length, variation_between: 0.05 },
            implantation: Implantation {
                flow: n.flow,
                lift: Lift::Regional { scale: n.lift_scale },
                jitter: n.jitter,
            },
            wisps: Wisps {
                count: n.count,
                hairs: 100_000,
                clumping: n.clumping,
                fuzziness: n.fuzziness,
                length_variation: 0.06,
                flyaways: n.flyaways,
                blending: n.blending,
                points: n.points,
            },
            contact: Contact { body: Body::SignedDistance, stiffness: 1000.0, volume: n.volume },
            equilibrium: Settling {
                resolution: Resolution::Accuracy(1e-4),
                element: ElementKind::default(),
            },
            gravity: 9.81,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_valid_and_found_by_name() {
        for p in PRESETS {
            assert_eq!(p.spec().check(), Ok(()), "{}", p.name);
            assert_eq!(preset(p.name), Some(p));
        }
        assert_eq!(preset("no-such"), None);
    }
}
