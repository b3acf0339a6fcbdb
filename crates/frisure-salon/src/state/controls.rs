//! The controls of the panels: each slider and each choice, with the scene key that it edits.

use frisure::hairstyle::HairstyleSpec;
use frisure::look::{Melanin, SHADES};
use frisure::scene::Scene;

/// The title of the panel about files, which hints name.
pub const FILES_PANEL: &str = "Head and groom";

/// The panels, in the order of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Panel {
    /// The files of the head and the groom.
    Files,
    /// The section and the material of the fibre.
    Fibre,
    /// The natural curl.
    Curl,
    /// Length and growth.
    Length,
    /// The guides and the strands around them.
    Wisps,
    /// Where and in which direction hair grows.
    Implantation,
    /// Colour and light.
    Look,
}

impl Panel {
    /// All panels, in order.
    pub const ALL: [Self; 7] = [
        Self::Files,
        Self::Fibre,
        Self::Curl,
        Self::Length,
        Self::Wisps,
        Self::Implantation,
        Self::Look,
    ];

    /// Its title.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Files => FILES_PANEL,
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

/// A slider for a number.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// Its panel.
    pub panel: Panel,
    /// Its label.
    pub label: &'static str,
    /// The scene key.
    pub key: &'static str,
    /// The displayed unit.
    pub unit: &'static str,
    /// The unit in scenes; empty for pure numbers and counts.
    pub written: &'static str,
    /// The unit (SI).
    pub factor: f64,
    /// The range of slider and number field, in the unit.
    pub range: (f64, f64),
    /// The number of decimals.
    pub decimals: usize,
    /// Whether the slider has a logarithmic scale.
    pub logarithmic: bool,
    /// The tooltip.
    pub help: &'static str,
    read: Read,
}

/// Keys of the panels of shape that also apply to a groom.
const APPLY_TO_GROOMS: [&str; 2] = ["hair.growth_rate", "gravity"];

impl Control {
    /// Whether it has an effect on a groom.
    #[must_use]
    pub fn applies_to_groom(&self) -> bool {
        let is_shape = matches!(self.panel, Panel::Curl | Panel::Length | Panel::Implantation)
            || self.key == "wisps.count";
        !is_shape || APPLY_TO_GROOMS.contains(&self.key)
    }

    /// Its value in a scene, in its unit.
    #[must_use]
    pub fn value(&self, scene: &Scene, spec: &HairstyleSpec) -> f64 {
        (self.read)(scene, spec) / self.factor
    }

    /// Clamps and rounds a value in its unit; NaN becomes the lower end of the range.
    #[must_use]
    pub fn clean(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        let inside = if value.is_nan() { low } else { value.clamp(low, high) };
        let scale = 10_f64.powi(self.decimals as i32);
        (inside * scale).round() / scale
    }

    /// A value as TOML.
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

    /// A value with its unit, such as "28 cm".
    #[must_use]
    pub fn displayed(&self, value: f64) -> String {
        let value = format!("{:.*}", self.decimals, self.clean(value));
        if self.unit.is_empty() { value } else { format!("{value} {}", self.unit) }
    }
}

/// A list of options for a key.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Its panel.
    pub panel: Panel,
    /// Its label.
    pub label: &'static str,
    /// The scene key.
    pub key: &'static str,
    /// The name of the default, where the key is not set.
    pub default: &'static str,
    /// The options: the value as TOML, and its title.
    pub options: Vec<(String, String)>,
    /// The tooltip.
    pub help: &'static str,
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
    let logarithmic = false;
    Control { panel, label, key, unit, written, factor, range, decimals, logarithmic, help, read }
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
/// The month is the mean month, as in scenes.
const SPEED: Unit = ("cm/month", "cm/month", 0.01 / (365.2425 / 12.0 * 86_400.0));

/// All sliders.
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
        "Mass per volume.",
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
        "How far a curl advances in a turn, without weight. A negative pitch reverses the handedness.",
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
        "Number of guides, the hairs that are simulated. The others follow them.",
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

/// Radius and pitch (m) of the natural helix; for straight hair the largest radius of the slider.
fn helix(spec: &HairstyleSpec) -> [f64; 2] {
    let strain = spec.curl.strain;
    let (bend, twist) = (strain.x.hypot(strain.y), strain.z);
    let total = bend * bend + twist * twist;
    if total < 1e-6 {
        return [0.2, 0.0];
    }
    [(bend / total).max(5e-4), std::f64::consts::TAU * twist / total]
}

/// Eumelanin and pheomelanin; those of brown hair where the colour is given in another way.
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

/// All choices.
#[must_use]
pub fn choices() -> Vec<Choice> {
    let choice = |panel, label, key, options, help| {
        let default = if panel == Panel::Files { "as in the file" } else { "default" };
        Choice { panel, label, key, default, options, help }
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

/// The slider of a key.
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
    fn every_slider_can_show_the_value_of_each_hair_type() {
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
    fn absurd_values_are_clamped() {
        for control in CONTROLS {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 0.0, -0.0] {
                let clean = control.clean(value);
                assert!(clean >= control.range.0 && clean <= control.range.1, "{}", control.key);
                assert!(!control.written(value).contains("inf"), "{}", control.key);
            }
        }
    }
}
