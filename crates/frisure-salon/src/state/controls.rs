//! What can be set in the panels: each slider and each choice, with the key of the scene it writes.
//!
//! One table for the window, its tests and its help; a new slider is a new row.

use frisure::hairstyle::HairstyleSpec;
use frisure::look::{Melanin, SHADES};
use frisure::scene::Scene;

/// The panels, in the order in which a person meets them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Panel {
    /// Files that the hair or the head come from.
    Files,
    /// Section and material.
    Fibre,
    /// Natural curl.
    Curl,
    /// How long.
    Length,
    /// Guides and the hairs around them.
    Wisps,
    /// How hair leaves the scalp.
    Implantation,
    /// Colours and light.
    Look,
}

impl Panel {
    /// All, in order.
    pub const ALL: [Self; 7] = [
        Self::Files,
        Self::Fibre,
        Self::Curl,
        Self::Length,
        Self::Wisps,
        Self::Implantation,
        Self::Look,
    ];

    /// What it is called.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Files => super::FILES_PANEL,
            Self::Fibre => "Fibre",
            Self::Curl => "Curl",
            Self::Length => "Length",
            Self::Wisps => "Wisps",
            Self::Implantation => "Implantation",
            Self::Look => "Look and light",
        }
    }
}

/// Reads a number (SI) of a scene.
type Read = fn(&Scene, &HairstyleSpec) -> f64;

/// A number that a slider sets.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// Where it is.
    pub panel: Panel,
    /// What it is called.
    pub label: &'static str,
    /// The key of the scene.
    pub key: &'static str,
    /// What a person reads behind the number.
    pub unit: &'static str,
    /// The unit as a scene writes it; empty for pure numbers and counts.
    pub written: &'static str,
    /// The unit in SI.
    pub factor: f64,
    /// Range of the slider, in the unit. What is typed may not leave it either.
    pub range: (f64, f64),
    /// Decimals that are shown and written.
    pub decimals: usize,
    /// Whether equal factors are equally far apart on the slider.
    pub logarithmic: bool,
    /// One sentence: what it does to the hair.
    pub help: &'static str,
    /// Whether hair has to be computed anew when it changes.
    pub moves_hair: bool,
    read: Read,
}

/// Keys of the panels of shape that count for hair of another program, too.
const COUNT_ANYWAY: [&str; 2] = ["hair.growth_rate", "gravity"];

impl Control {
    /// Whether it does anything to hair that another program has shaped.
    #[must_use]
    pub fn counts_for_groom(&self) -> bool {
        let is_shape = matches!(self.panel, Panel::Curl | Panel::Length | Panel::Implantation)
            || self.key == "wisps.count";
        !is_shape || COUNT_ANYWAY.contains(&self.key)
    }

    /// Its value in a scene, in its unit.
    #[must_use]
    pub fn value(&self, scene: &Scene, spec: &HairstyleSpec) -> f64 {
        (self.read)(scene, spec) / self.factor
    }

    /// A value in its unit, inside its range and rounded as it is written; what is no number becomes
    /// the lower end.
    #[must_use]
    pub fn clean(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        let inside = if value.is_nan() { low } else { value.clamp(low, high) };
        let scale = 10_f64.powi(self.decimals as i32);
        (inside * scale).round() / scale
    }

    /// A value as the scene writes it.
    #[must_use]
    pub fn written(&self, value: f64) -> String {
        let value = self.clean(value);
        let number = format!("{value:.*}", self.decimals);
        let number = match number.contains('.') {
            true => number.trim_end_matches('0').trim_end_matches('.'),
            false => number.as_str(),
        };
        match self.written {
            "" => number.to_owned(),
            unit => format!("\"{number} {unit}\""),
        }
    }

    /// A value as a person reads it, such as "28 cm".
    #[must_use]
    pub fn said(&self, value: f64) -> String {
        let value = format!("{:.*}", self.decimals, self.clean(value));
        if self.unit.is_empty() { value } else { format!("{value} {}", self.unit) }
    }
}

/// A word that a list sets.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Where it is.
    pub panel: Panel,
    /// What it is called.
    pub label: &'static str,
    /// The key of the scene.
    pub key: &'static str,
    /// What holds where nothing was chosen, in words.
    pub usual: &'static str,
    /// What can be chosen: as the scene writes it (TOML), and in words.
    pub options: Vec<(String, String)>,
    /// One sentence: what it does.
    pub help: &'static str,
    /// Whether hair has to be computed anew when it changes.
    pub moves_hair: bool,
}

#[expect(clippy::too_many_arguments, reason = "a row of the table below")]
const fn control(
    panel: Panel,
    label: &'static str,
    key: &'static str,
    (unit, written, factor): (&'static str, &'static str, f64),
    range: (f64, f64),
    decimals: usize,
    read: Read,
    help: &'static str,
) -> Control {
    let moves_hair = !matches!(panel, Panel::Look);
    let logarithmic = false;
    Control {
        panel,
        label,
        key,
        unit,
        written,
        factor,
        range,
        decimals,
        logarithmic,
        help,
        moves_hair,
        read,
    }
}

const fn logarithmic(control: Control) -> Control {
    Control { logarithmic: true, ..control }
}

type Unit = (&'static str, &'static str, f64);
const UM: Unit = ("µm", "um", 1e-6);
const MM: Unit = ("mm", "mm", 1e-3);
const CM: Unit = ("cm", "cm", 1e-2);
const GPA: Unit = ("GPa", "GPa", 1e9);
const DENSITY: Unit = ("g/cm³", "g/cm^3", 1e3);
const PERCENT: Unit = ("%", "%", 1e-2);
const DEGREES: Unit = ("°", "deg", std::f64::consts::PI / 180.0);
const PER_CM2: Unit = ("/cm²", "1/cm^2", 1e4);
const NUMBER: Unit = ("", "", 1.0);
const TIMES: Unit = ("×", "", 1.0);
/// A mean month, as scenes count it.
const SPEED: Unit = ("cm/month", "cm/month", 0.01 / (365.2425 / 12.0 * 86_400.0));

/// Every slider.
pub const CONTROLS: &[Control] = &[
    control(
        Panel::Fibre,
        "Diameter",
        "hair.fibre.diameter",
        UM,
        (20.0, 200.0),
        0,
        |_, s| 2.0 * s.fibre.section.mean_radius(),
        "Mean diameter of a hair. Twice the diameter is sixteen times as stiff and four times as heavy.",
    ),
    control(
        Panel::Fibre,
        "Ellipticity",
        "hair.fibre.axis_ratio",
        (": 1", "", 1.0),
        (1.0, 3.0),
        2,
        |_, s| s.fibre.section.axis_ratio(),
        "Longer over shorter axis of the section. A flat hair bends one way only, and curls more regularly.",
    ),
    logarithmic(control(
        Panel::Fibre,
        "Stiffness",
        "hair.fibre.youngs_modulus",
        GPA,
        (0.2, 20.0),
        2,
        |_, s| s.fibre.material.youngs_modulus(),
        "Young's modulus: how hard it is to bend. Human hair has some 4 GPa when dry.",
    )),
    logarithmic(control(
        Panel::Fibre,
        "Torsional stiffness",
        "hair.fibre.shear_modulus",
        GPA,
        (0.05, 8.0),
        2,
        |_, s| s.fibre.material.shear_modulus(),
        "Shear modulus: how hard it is to twist.",
    )),
    control(
        Panel::Fibre,
        "Density",
        "hair.fibre.density",
        DENSITY,
        (0.5, 3.0),
        2,
        |_, s| s.fibre.material.density(),
        "Mass per volume: what gravity pulls at.",
    ),
    control(
        Panel::Fibre,
        "Diameter varies by",
        "hair.fibre.variation",
        PERCENT,
        (0.0, 50.0),
        0,
        |_, s| s.fibre.variation,
        "Standard deviation of the diameter from wisp to wisp.",
    ),
    logarithmic(control(
        Panel::Curl,
        "Curl radius",
        "hair.curl.radius",
        MM,
        (0.5, 200.0),
        1,
        |_, s| helix(s)[0],
        "Radius of the curl that a hair would have without weight.",
    )),
    logarithmic(control(
        Panel::Curl,
        "Curl pitch",
        "hair.curl.pitch",
        MM,
        (-500.0, 500.0),
        1,
        |_, s| helix(s)[1],
        "How far a curl advances in a turn, without weight. Negative turns the other way.",
    )),
    control(
        Panel::Curl,
        "Varies between wisps by",
        "hair.curl.variation_between",
        PERCENT,
        (0.0, 100.0),
        0,
        |_, s| s.curl.variation_between,
        "Standard deviation of the curl from wisp to wisp.",
    ),
    control(
        Panel::Curl,
        "Varies along a hair by",
        "hair.curl.variation_along",
        PERCENT,
        (0.0, 100.0),
        0,
        |_, s| s.curl.variation_along,
        "Standard deviation of the curl along a hair: much of it is frizz.",
    ),
    control(
        Panel::Curl,
        "… over a distance of",
        "hair.curl.variation_scale",
        CM,
        (0.1, 20.0),
        1,
        |_, s| s.curl.variation_scale,
        "Distance along a hair over which its curl changes.",
    ),
    logarithmic(control(
        Panel::Length,
        "Length",
        "hair.length",
        CM,
        (0.5, 150.0),
        1,
        |_, s| s.length.mean,
        "Mean length along the hair, however curly.",
    )),
    control(
        Panel::Length,
        "Length varies by",
        "hair.length_variation",
        PERCENT,
        (0.0, 50.0),
        0,
        |_, s| s.length.variation_between,
        "Standard deviation of the length from wisp to wisp.",
    ),
    control(
        Panel::Length,
        "Growth",
        "hair.growth_rate",
        SPEED,
        (0.0, 5.0),
        2,
        |_, s| s.length.growth_rate,
        "How fast it grows when time passes.",
    ),
    logarithmic(control(
        Panel::Wisps,
        "Wisps",
        "wisps.count",
        NUMBER,
        (20.0, 1500.0),
        0,
        |_, s| s.wisps.count as f64,
        "Number of guides: hairs that are computed. The others follow them.",
    )),
    control(
        Panel::Wisps,
        "Hairs",
        "wisps.density",
        PER_CM2,
        (5.0, 400.0),
        0,
        |_, s| match s.wisps.hairs {
            frisure::hairstyle::Hairs::Density(density) => density,
            _ => s.implantation.density,
        },
        "Hairs drawn for each square centimetre of scalp; some 200 grow there.",
    ),
    control(
        Panel::Wisps,
        "Clumping",
        "wisps.clumping",
        PERCENT,
        (0.0, 100.0),
        0,
        |_, s| s.wisps.clumping,
        "How far the hairs of a wisp gather.",
    ),
    control(
        Panel::Wisps,
        "Splits",
        "wisps.splits",
        NUMBER,
        (1.0, 20.0),
        0,
        |_, s| s.wisps.splits as f64,
        "Thinner wisps into which each wisp parts.",
    ),
    control(
        Panel::Wisps,
        "Fuzziness",
        "wisps.fuzziness",
        TIMES,
        (0.0, 2.0),
        2,
        |_, s| s.wisps.fuzziness,
        "How far hairs stray from their wisp.",
    ),
    control(
        Panel::Wisps,
        "Flyaways",
        "wisps.flyaways",
        PERCENT,
        (0.0, 20.0),
        1,
        |_, s| s.wisps.flyaways,
        "Share of the hairs that stand off.",
    ),
    control(
        Panel::Wisps,
        "Blending",
        "wisps.blending",
        PERCENT,
        (0.0, 100.0),
        0,
        |_, s| s.wisps.blending,
        "How far hairs follow the neighbouring wisps, too: straight hair is a smooth mass.",
    ),
    control(
        Panel::Wisps,
        "Volume",
        "contact.volume",
        TIMES,
        (0.0, 4.0),
        2,
        |_, s| s.contact.volume,
        "Factor on how much room wisps take from each other.",
    ),
    control(
        Panel::Implantation,
        "Lift",
        "implantation.lift_scale",
        TIMES,
        (0.0, 4.0),
        2,
        |_, s| match s.implantation.lift {
            frisure::hairstyle::Lift::Regional { scale } => scale,
            frisure::hairstyle::Lift::Uniform(_) => 1.0,
        },
        "Factor on the angle at which hair leaves the skin, as measured by region.",
    ),
    control(
        Panel::Implantation,
        "Disorder",
        "implantation.jitter",
        DEGREES,
        (0.0, 57.0),
        0,
        |_, s| s.implantation.jitter,
        "Standard deviation of the direction in which neighbouring wisps leave the scalp.",
    ),
    control(
        Panel::Implantation,
        "Hairline",
        "implantation.hairline.height",
        CM,
        (-3.0, 5.0),
        1,
        |_, s| s.implantation.hairline.height,
        "How much higher than usual the hair begins over the forehead.",
    ),
    control(
        Panel::Implantation,
        "Receding temples",
        "implantation.hairline.recession",
        CM,
        (0.0, 4.0),
        1,
        |_, s| s.implantation.hairline.recession,
        "How far the hairline recedes at the temples.",
    ),
    control(
        Panel::Implantation,
        "Widow's peak",
        "implantation.hairline.widows_peak",
        CM,
        (0.0, 3.0),
        1,
        |_, s| s.implantation.hairline.widows_peak,
        "How far the hairline comes forward in the middle.",
    ),
    control(
        Panel::Implantation,
        "Baby hairs",
        "implantation.baby_hairs",
        PERCENT,
        (0.0, 100.0),
        0,
        |_, s| s.implantation.baby_hairs,
        "Share of short thin hairs along the edge.",
    ),
    control(
        Panel::Implantation,
        "Gravity",
        "gravity",
        ("m/s²", "m/s^2", 1.0),
        (0.0, 30.0),
        2,
        |_, s| s.gravity,
        "9.81 on Earth, 1.62 on the Moon.",
    ),
    control(
        Panel::Look,
        "Eumelanin",
        "look.eumelanin",
        NUMBER,
        (0.0, 10.0),
        2,
        |scene, _| pigments(scene)[0],
        "The brown pigment: about 0.1 in blond hair, 0.8 in brown, 8 in black.",
    ),
    control(
        Panel::Look,
        "Pheomelanin",
        "look.pheomelanin",
        NUMBER,
        (0.0, 5.0),
        2,
        |scene, _| pigments(scene)[1],
        "The red pigment.",
    ),
    control(
        Panel::Look,
        "White hairs",
        "look.white_share",
        PERCENT,
        (0.0, 100.0),
        0,
        |scene, _| rounded(scene.look.hair.white_share),
        "Share of the hairs that have no pigment.",
    ),
    control(
        Panel::Look,
        "Roughness",
        "look.roughness",
        NUMBER,
        (0.05, 1.0),
        2,
        |scene, _| rounded(scene.look.hair.surface.longitudinal_roughness),
        "How wide the highlights are: 0.1 is glossy, 0.5 is matt.",
    ),
    control(
        Panel::Look,
        "Lamps",
        "light.strength",
        TIMES,
        (0.0, 4.0),
        2,
        |scene, _| scene.light.strength,
        "Factor on the strength of all lamps.",
    ),
    control(
        Panel::Look,
        "Sky",
        "light.sky_strength",
        TIMES,
        (0.0, 4.0),
        2,
        |scene, _| scene.light.sky_strength,
        "Factor on the light that comes from all around.",
    ),
    control(
        Panel::Look,
        "Exposure",
        "output.exposure",
        ("stops", "", 1.0),
        (-4.0, 4.0),
        1,
        |scene, _| scene.output.exposure,
        "Stops by which the picture is lighter.",
    ),
];

/// Radius and pitch (m) of the natural helix; hair that is straight has the widest radius that a
/// slider knows.
fn helix(spec: &HairstyleSpec) -> [f64; 2] {
    let strain = spec.curl.strain;
    let (bend, twist) = (strain.x.hypot(strain.y), strain.z);
    let total = bend * bend + twist * twist;
    if total < 1e-6 {
        return [0.2, 0.0];
    }
    [(bend / total).max(5e-4), std::f64::consts::TAU * twist / total]
}

/// Eumelanin and pheomelanin; of colours that are said otherwise, those of brown hair.
fn pigments(scene: &Scene) -> [f64; 2] {
    let Melanin { eumelanin, pheomelanin } = scene.look.hair.melanin;
    [rounded(eumelanin), rounded(pheomelanin)]
}

/// The decimal number that a single-precision number was read from.
fn rounded(value: f32) -> f64 {
    (f64::from(value) * 1e6).round() / 1e6
}

fn words(options: &[(&str, &str)]) -> Vec<(String, String)> {
    options.iter().map(|(word, said)| (format!("\"{word}\""), (*said).to_owned())).collect()
}

/// Every list.
#[must_use]
pub fn choices() -> Vec<Choice> {
    let choice = |panel, label, key, options, help| {
        let moves_hair = panel != Panel::Look;
        let usual = if panel == Panel::Files { "as the file says" } else { "as usual" };
        Choice { panel, label, key, usual, options, help, moves_hair }
    };
    let units = || {
        words(&[
            ("m", "Metres"),
            ("dm", "Decimetres"),
            ("cm", "Centimetres"),
            ("mm", "Millimetres"),
            ("in", "Inches"),
        ])
    };
    let axes = || words(&[("y", "y, the face along z"), ("z", "z, the face against y")]);
    let said = |word: &str| {
        let mut said = word.replace('-', " ");
        if let Some(first) = said.get_mut(0..1) {
            first.make_ascii_uppercase();
        }
        said
    };
    let colours = SHADES.iter().map(|s| (format!("\"{}\"", s.name), said(s.name))).collect();
    vec![
        choice(Panel::Files, "Unit of the head", "head.unit", units(), "What the mesh is in."),
        choice(
            Panel::Files,
            "Up in the head",
            "head.up",
            axes(),
            "The axis of the mesh that points up.",
        ),
        choice(Panel::Files, "Unit of the groom", "groom.unit", units(), "What the groom is in."),
        choice(
            Panel::Files,
            "Up in the groom",
            "groom.up",
            axes(),
            "The axis of the groom that points up.",
        ),
        choice(
            Panel::Fibre,
            "Water",
            "hair.wetting",
            words(&[("paper", "As in the paper"), ("measured", "As measured")]),
            "What water makes of a fibre.",
        ),
        choice(
            Panel::Implantation,
            "Flow",
            "implantation.flow",
            words(&[("whorl", "As it grows"), ("parted", "Parted"), ("swept-back", "Swept back")]),
            "The direction in which hair leaves the scalp.",
        ),
        choice(
            Panel::Implantation,
            "Parting",
            "implantation.parting",
            words(&[
                ("middle", "In the middle"),
                ("left", "On the left"),
                ("right", "On the right"),
                ("zigzag", "Zigzag"),
            ]),
            "Where hair parts.",
        ),
        choice(Panel::Look, "Colour", "look.colour", colours, "Natural colours by name."),
        choice(
            Panel::Look,
            "Light",
            "light.setup",
            words(&[
                ("studio", "Studio"),
                ("soft", "Soft"),
                ("butterfly", "Butterfly"),
                ("rembrandt", "Rembrandt"),
                ("rim", "Rim"),
                ("daylight", "Daylight"),
                ("overcast", "Overcast"),
                ("dark", "Dark room"),
            ]),
            "How the head is lit, as photographers set it.",
        ),
        choice(
            Panel::Look,
            "Background",
            "look.background",
            words(&[
                ("wall", "Wall"),
                ("surroundings", "Surroundings"),
                ("transparent", "Transparent"),
            ]),
            "What is behind the head.",
        ),
    ]
}

/// The slider that sets a key.
#[must_use]
pub fn control_of(key: &str) -> Option<&'static Control> {
    CONTROLS.iter().find(|control| control.key == key)
}

#[cfg(test)]
mod tests {
    use super::*;
    use frisure::hairstyle::PRESETS;
    use std::path::Path;

    #[test]
    fn every_slider_shows_what_each_hair_type_has() {
        for preset in PRESETS {
            let text = format!("[hair]\ntype = \"{}\"\n", preset.name);
            let scene = Scene::parse("scene", text, Path::new("")).unwrap();
            let spec = scene.hairstyle_spec().unwrap();
            for control in CONTROLS {
                let value = control.value(&scene, &spec);
                let near = (control.clean(value) - value).abs();
                let step = 0.5 * 10_f64.powi(-(control.decimals as i32)) + 1e-9;
                assert!(near <= step, "{} of {} is {value}", control.key, preset.name);
            }
        }
    }

    #[test]
    fn absurd_values_become_what_can_be() {
        for control in CONTROLS {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 0.0, -0.0] {
                let clean = control.clean(value);
                assert!(clean >= control.range.0 && clean <= control.range.1, "{}", control.key);
                assert!(!control.written(value).contains("inf"), "{}", control.key);
            }
        }
    }
}
