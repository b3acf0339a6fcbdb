//! The controls of the panels: a slider or a list of options for each scene key that declares one.

use std::borrow::Cow;
use std::ops::Deref;
use std::sync::LazyLock;

use frisure::scene::keys::KEYS;
use frisure::scene::{Declaration, Panel, Scene, Slider, options};

use crate::locale::{self, tr};

/// The title of a panel.
#[must_use]
pub fn panel_title(panel: Panel) -> Cow<'static, str> {
    locale::named("panel", panel.title(), panel.title())
}

/// The title of the panel about files, which hints name.
pub(super) fn files_panel() -> Cow<'static, str> {
    panel_title(Panel::Files)
}

/// A slider for a number, with the properties that its key declares.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// The scene key.
    pub key: &'static str,
    slider: &'static Slider,
    declared: &'static Declaration,
}

impl Deref for Control {
    type Target = Slider;

    fn deref(&self) -> &Slider {
        self.slider
    }
}

/// Keys of the panels of shape that also apply to a groom.
const APPLY_TO_GROOMS: [&str; 1] = ["hair.growth_rate"];

impl Control {
    fn of(declared: &'static Declaration) -> Option<Self> {
        Some(Self { key: declared.path, slider: declared.slider()?, declared })
    }

    /// Whether it has an effect on a groom.
    #[must_use]
    pub fn applies_to_groom(&self) -> bool {
        let is_shape = matches!(self.panel, Panel::Curl | Panel::Length | Panel::Implantation)
            || self.key == "wisps.count";
        !is_shape || APPLY_TO_GROOMS.contains(&self.key)
    }

    /// Its value in a scene, in its unit.
    #[must_use]
    pub fn value(&self, scene: &Scene) -> f64 {
        self.declared.number_in(scene) / self.unit.factor
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
        match self.unit.written {
            "" => number.to_owned(),
            unit => format!("\"{number} {unit}\""),
        }
    }

    /// Its label.
    #[must_use]
    pub fn label(&self) -> Cow<'static, str> {
        locale::named("key", self.key, self.slider.label)
    }

    /// Its tooltip.
    #[must_use]
    pub fn help(&self) -> Cow<'static, str> {
        locale::named("key", &format!("{}#help", self.key), self.slider.help)
    }

    /// Its unit as it is displayed.
    #[must_use]
    pub fn displayed_unit(&self) -> Cow<'static, str> {
        locale::named("unit", self.unit.displayed, self.unit.displayed)
    }

    /// A value with its unit, such as "28 cm".
    #[must_use]
    pub fn displayed(&self, value: f64) -> String {
        let value = locale::number(self.clean(value), self.decimals);
        match &*self.displayed_unit() {
            "" => value,
            unit => format!("{value} {unit}"),
        }
    }
}

/// All sliders.
pub static CONTROLS: LazyLock<Vec<Control>> =
    LazyLock::new(|| KEYS.iter().filter_map(Control::of).collect());

/// The slider of a key.
#[must_use]
pub fn control_of(key: &str) -> Option<&'static Control> {
    CONTROLS.iter().find(|control| control.key == key)
}

/// A list of options for a key.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Its panel.
    pub panel: Panel,
    /// The scene key.
    pub key: &'static str,
    /// The options: the value as TOML, and its title in English.
    pub options: Vec<(String, &'static str)>,
    label: &'static str,
    help: &'static str,
}

/// All lists of options.
pub static CHOICES: LazyLock<Vec<Choice>> =
    LazyLock::new(|| KEYS.iter().filter_map(Choice::of).collect());

impl Choice {
    fn of(declared: &'static Declaration) -> Option<Self> {
        let list = declared.option_list()?;
        let written = |(word, title): (&str, _)| (format!("\"{word}\""), title);
        Some(Self {
            panel: list.panel,
            key: declared.path,
            options: options(declared).into_iter().map(written).collect(),
            label: list.label,
            help: list.help,
        })
    }

    /// Its label.
    #[must_use]
    pub fn label(&self) -> Cow<'static, str> {
        locale::named("key", self.key, self.label)
    }

    /// Its tooltip.
    #[must_use]
    pub fn help(&self) -> Cow<'static, str> {
        locale::named("key", &format!("{}#help", self.key), self.help)
    }

    /// The name of the default, where the key is not set.
    #[must_use]
    pub fn default(&self) -> String {
        tr!(if self.panel == Panel::Files { "as-in-the-file" } else { "default" })
    }

    /// The title of an option: an element of [`Self::options`].
    #[must_use]
    pub fn title(&self, (written, english): &(String, &'static str)) -> Cow<'static, str> {
        locale::named("option", written, english)
    }
}

/// The list of a key.
#[must_use]
pub fn choice_of(key: &str) -> Option<&'static Choice> {
    CHOICES.iter().find(|choice| choice.key == key)
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
            for control in CONTROLS.iter() {
                let value = control.value(&scene);
                let near = (control.clean(value) - value).abs();
                let step = 0.5 * 10_f64.powi(-(control.decimals as i32)) + 1e-9;
                assert!(near <= step, "{} of {} is {value}", control.key, preset.name);
            }
        }
    }

    #[test]
    fn absurd_values_are_clamped() {
        for control in CONTROLS.iter() {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 0.0, -0.0] {
                let clean = control.clean(value);
                assert!(clean >= control.range.0 && clean <= control.range.1, "{}", control.key);
                assert!(!control.written(value).contains("inf"), "{}", control.key);
            }
        }
    }
}
