//! How programs display keys: sliders for numbers, lists of options for keywords.

use std::f64::consts::PI;

use crate::quantity::MONTH;

/// A group of controls.
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
    /// Gravity, the pose of the head, and wind.
    Surroundings,
    /// Colour and light.
    Look,
}

impl Panel {
    /// All panels, in the order in which programs display them.
    pub const ALL: [Self; 8] = [
        Self::Files,
        Self::Fibre,
        Self::Curl,
        Self::Length,
        Self::Wisps,
        Self::Implantation,
        Self::Surroundings,
        Self::Look,
    ];

    /// Its title.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Files => "Head and groom",
            Self::Fibre => "Fibre",
            Self::Curl => "Curl",
            Self::Length => "Length",
            Self::Wisps => "Wisps",
            Self::Implantation => "Implantation",
            Self::Surroundings => "Pose and wind",
            Self::Look => "Look and light",
        }
    }
}

/// A unit in which a number is displayed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// As it is displayed.
    pub displayed: &'static str,
    /// As scenes write it; empty for pure numbers and counts.
    pub written: &'static str,
    /// The unit in SI units.
    pub factor: f64,
}

const fn unit(displayed: &'static str, written: &'static str, factor: f64) -> Unit {
    Unit { displayed, written, factor }
}

pub(crate) const UM: Unit = unit("µm", "um", 1e-6);
pub(crate) const MM: Unit = unit("mm", "mm", 1e-3);
pub(crate) const CM: Unit = unit("cm", "cm", 1e-2);
pub(crate) const GPA: Unit = unit("GPa", "GPa", 1e9);
pub(crate) const DENSITY: Unit = unit("g/cm³", "g/cm^3", 1e3);
pub(crate) const PERCENT: Unit = unit("%", "%", 1e-2);
pub(crate) const DEGREES: Unit = unit("°", "deg", PI / 180.0);
pub(crate) const PER_CM2: Unit = unit("/cm²", "1/cm^2", 1e4);
pub(crate) const ACCELERATION: Unit = unit("m/s²", "m/s^2", 1.0);
pub(crate) const SPEED: Unit = unit("cm/month", "cm/month", 0.01 / MONTH);
pub(crate) const METRES_PER_SECOND: Unit = unit("m/s", "m/s", 1.0);
pub(crate) const NUMBER: Unit = unit("", "", 1.0);
pub(crate) const TIMES: Unit = unit("×", "", 1.0);
pub(crate) const TO_ONE: Unit = unit(": 1", "", 1.0);
pub(crate) const STOPS: Unit = unit("stops", "", 1.0);

/// A slider for a number.
#[derive(Clone, Copy, Debug)]
pub struct Slider {
    /// Its panel.
    pub panel: Panel,
    /// Its label.
    pub label: &'static str,
    /// The unit in which the number is displayed.
    pub unit: Unit,
    /// The range of the slider, in the unit.
    pub range: (f64, f64),
    /// The number of decimals.
    pub decimals: usize,
    /// Whether it has a logarithmic scale.
    pub logarithmic: bool,
    /// The tooltip.
    pub help: &'static str,
}

/// A list of options for a key that takes a keyword.
#[derive(Clone, Copy, Debug)]
pub struct OptionList {
    /// Its panel.
    pub panel: Panel,
    /// Its label.
    pub label: &'static str,
    /// The tooltip.
    pub help: &'static str,
}
