//! Hair types to start from: what is measured of each, and a style to wear it in.

mod fibres;
mod hair_type;
mod humidity;
mod styles;

use crate::spec::{
    Contact, Hairs, HairstyleSpec, Implantation, Length, Lift, Pose, Settling, Wind, Wisps,
};
pub use hair_type::{Ellipticity, HairType, NaturalCurl};
pub use humidity::Moisture;
use styles::Style;

/// A named hair type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Name as scenes write it.
    pub name: &'static str,
    /// One sentence for a list.
    pub description: &'static str,
    hair_type: HairType,
    style: Style,
}

/// Every preset: by population, by the words that people use, and by curl type.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "asian-straight",
        description: "thick, round, straight, leaving the scalp steeply",
        hair_type: fibres::ASIAN_STRAIGHT,
        style: styles::STRAIGHT,
    },
    Preset {
        name: "asian-wavy",
        description: "thick and round, with a wave",
        hair_type: fibres::ASIAN_WAVY,
        style: styles::WAVY,
    },
    Preset {
        name: "caucasian-straight",
        description: "fine and straight",
        hair_type: fibres::CAUCASIAN_STRAIGHT,
        style: styles::STRAIGHT,
    },
    Preset {
        name: "caucasian-wavy",
        description: "loose waves of a few centimetres",
        hair_type: fibres::CAUCASIAN_WAVY,
        style: styles::WAVY,
    },
    Preset {
        name: "caucasian-curly",
        description: "ringlets a finger wide",
        hair_type: fibres::CAUCASIAN_CURLY,
        style: styles::CURLY,
    },
    Preset {
        name: "african-coily",
        description: "elliptical section, coils a few millimetres wide",
        hair_type: fibres::AFRICAN_COILY,
        style: styles::COILY,
    },
    Preset {
        name: "african-kinky",
        description: "elliptical section, coils so tight and irregular that they zigzag",
        hair_type: fibres::AFRICAN_KINKY,
        style: styles::KINKY,
    },
    Preset {
        name: "straight",
        description: "straight hair of no one population",
        hair_type: fibres::STRAIGHT,
        style: styles::STRAIGHT,
    },
    Preset {
        name: "wavy",
        description: "wavy hair of no one population",
        hair_type: fibres::WAVY,
        style: styles::WAVY,
    },
    Preset {
        name: "curly",
        description: "curls two fingers wide or less",
        hair_type: fibres::CURLY,
        style: styles::CURLY,
    },
    Preset {
        name: "frizzy",
        description: "tight, irregular curls that stand off the head",
        hair_type: fibres::FRIZZY,
        style: styles::FRIZZY,
    },
    Preset {
        name: "coily",
        description: "springs as wide as a pencil",
        hair_type: fibres::COILY,
        style: styles::SPRINGY,
    },
    Preset {
        name: "kinky",
        description: "coils of a few millimetres, tight and irregular",
        hair_type: fibres::KINKY,
        style: styles::KINKY,
    },
    curl_type(1, "type-1", "curl type I: straight", styles::STRAIGHT),
    curl_type(2, "type-2", "curl type II: a slight wave", styles::WAVY),
    curl_type(3, "type-3", "curl type III: wavy", styles::WAVY),
    curl_type(4, "type-4", "curl type IV: loose curls", styles::LOOSE),
    curl_type(5, "type-5", "curl type V: curly", styles::CURLY),
    curl_type(6, "type-6", "curl type VI: tight curls", styles::SPRINGY),
    curl_type(7, "type-7", "curl type VII: coils", styles::COILY),
    curl_type(8, "type-8", "curl type VIII: the tightest coils, irregular", styles::KINKY),
];

const fn curl_type(
    number: usize,
    name: &'static str,
    description: &'static str,
    style: Style,
) -> Preset {
    Preset { name, description, hair_type: fibres::CURL_TYPES[number - 1], style }
}

/// The preset of that name.
#[must_use]
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|p| p.name == name)
}

impl Preset {
    /// What is measured of the type.
    #[must_use]
    pub fn hair_type(&self) -> &HairType {
        &self.hair_type
    }

    /// A whole hairstyle of this type.
    ///
    /// # Panics
    /// Never: a test makes every preset.
    #[must_use]
    pub fn spec(&self) -> HairstyleSpec {
        let (hair, style) = (&self.hair_type, &self.style);
        HairstyleSpec {
            seed: 1,
            fibre: hair.fibre(Ellipticity::Measured).expect("presets are valid"),
            curl: hair.curl.curl().expect("presets are valid"),
            wetting: hair.paper_wetting,
            length: Length {
                mean: style.length,
                growth_rate: hair.growth_rate,
                ..Length::default()
            },
            implantation: Implantation {
                flow: style.flow,
                lift: Lift::Regional { scale: hair.lift_scale },
                jitter: style.jitter,
                density: hair.density,
                ..Implantation::default()
            },
            regions: Vec::new(),
            wisps: style.wisps(Hairs::Density(hair.density)),
            contact: Contact { hair: style.contact, ..Contact::default() },
            equilibrium: Settling::default(),
            gravity: 9.81,
            pose: Pose::default(),
            wind: Wind::default(),
        }
    }
}

impl Style {
    fn wisps(&self, hairs: Hairs) -> Wisps {
        Wisps {
            count: self.count,
            hairs,
            clumping: self.clumping,
            splits: self.splits,
            split_variation: self.split_variation,
            split_clumping: self.split_clumping,
            subsplits: self.subsplits,
            split_phase: self.split_phase,
            hair_phase: self.hair_phase,
            radius_variation: self.radius_variation,
            fuzziness: self.fuzziness,
            flyaways: self.flyaways,
            growing: self.growing,
            blending: self.blending,
            points: self.points,
            ..Wisps::default()
        }
    }
}

#[cfg(test)]
mod tests;
