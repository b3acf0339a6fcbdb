//! The presets of light as pictures of the same head.

use eframe::egui::{Button, Image, Role, Ui, WidgetInfo, vec2};

use super::gallery::Pictures;
use crate::state::{Choice, Command};

/// The key of the presets.
pub(super) const KEY: &str = "light.setup";

/// Side of a picture (points).
const SIDE: f32 = 60.0;

macro_rules! light {
    ($name:literal) => {
        (
            concat!("\"", $name, "\""),
            include_bytes!(concat!("../../gallery/light-", $name, ".jpg")).as_slice(),
        )
    };
}

/// The presets as scenes write them, with their pictures (JPEG).
const LIGHTS: [(&str, &[u8]); 8] = [
    light!("studio"),
    light!("soft"),
    light!("butterfly"),
    light!("rembrandt"),
    light!("rim"),
    light!("daylight"),
    light!("overcast"),
    light!("dark"),
];

/// Shows the options of a choice as pictures; `current` is the one that the scene has.
pub(super) fn show(
    ui: &mut Ui,
    choice: &Choice,
    current: Option<&String>,
    pictures: &mut Pictures,
    out: &mut Vec<Command>,
) {
    ui.label(&*choice.label()).on_hover_text(&*choice.help());
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        for option in &choice.options {
            let (written, title) = (&option.0, choice.title(option));
            let Some((_, picture)) = LIGHTS.iter().find(|(name, _)| name == written) else {
                continue;
            };
            let Some(texture) = pictures.of(ui, picture) else { continue };
            let image = Image::new(texture).fit_to_exact_size(vec2(SIDE, SIDE));
            let on = current == Some(written);
            let response = ui.add(Button::image(image).selected(on)).on_hover_text(&*title);
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, &*title));
            if response.clicked() && !on {
                out.push(Command::SetOption(choice.key, written.clone()));
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::choice_of;

    #[test]
    fn every_preset_has_a_picture() {
        let choice = choice_of(KEY).expect("presets of light");
        for (written, _) in &choice.options {
            assert!(LIGHTS.iter().any(|(name, _)| name == written), "{written}");
        }
    }
}
