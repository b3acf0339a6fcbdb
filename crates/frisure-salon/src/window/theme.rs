//! The light and the dark theme.

use eframe::egui::emath::format_with_decimals_in_range;
use eframe::egui::style::NumberFormatter;
use eframe::egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, FontTweak,
    Stroke, Style, TextStyle, Theme,
};
use epaint_default_fonts::UBUNTU_LIGHT;

use crate::locale;

/// The colour of the selection and of toggles that are on.
pub(super) const ACCENT: Color32 = Color32::from_rgb(0x2f, 0x8f, 0xd8);
/// The colour of hair that is cut off, and of errors.
pub(super) const CUT_COLOUR: Color32 = Color32::from_rgb(0xd8, 0x4a, 0x3a);

/// The icons among other letters: [`super::icons`] has their names.
const ICONS: &[u8] = include_bytes!("../../icons/icons.ttf");

/// Installs both themes, and the icons.
pub(super) fn install(context: &Context) {
    // One font of egui's for all text: its font for source code has nothing to show here, and is a twentieth of the page.
    let mut fonts = FontDefinitions::empty();
    fonts.font_data.insert("text".to_owned(), FontData::from_static(UBUNTU_LIGHT).into());
    // The font has its icons as high as its em, with less below the line than letters have.
    let tweak = FontTweak { y_offset_factor: 0.06, scale: 1.1, ..FontTweak::default() };
    fonts.font_data.insert("icons".to_owned(), FontData::from_static(ICONS).tweak(tweak).into());
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.insert(family, vec!["text".to_owned(), "icons".to_owned()]);
    }
    context.set_fonts(fonts);
    context.style_mut_of(Theme::Dark, |style| set(style, true));
    context.style_mut_of(Theme::Light, |style| set(style, false));
}

fn set(style: &mut Style, dark: bool) {
    let visuals = &mut style.visuals;
    visuals.selection.bg_fill = if dark { ACCENT.gamma_multiply(0.75) } else { ACCENT };
    visuals.selection.stroke = Stroke::new(1.0, Color32::WHITE);
    visuals.hyperlink_color = ACCENT;
    let round = CornerRadius::same(5);
    for widget in [
        &mut visuals.widgets.noninteractive,
        &mut visuals.widgets.inactive,
        &mut visuals.widgets.hovered,
        &mut visuals.widgets.active,
        &mut visuals.widgets.open,
    ] {
        widget.corner_radius = round;
    }
    if dark {
        visuals.panel_fill = Color32::from_gray(30);
        visuals.override_text_color = Some(Color32::from_gray(222));
    } else {
        visuals.panel_fill = Color32::from_gray(246);
        visuals.override_text_color = Some(Color32::from_gray(25));
    }
    style.number_formatter = NumberFormatter::new(|number, decimals| {
        locale::localized(&format_with_decimals_in_range(number, decimals))
    });
    style.spacing.item_spacing.y = 5.0;
    style.spacing.button_padding = eframe::egui::vec2(8.0, 4.0);
    style.text_styles.insert(TextStyle::Body, FontId::proportional(14.0));
    style.text_styles.insert(TextStyle::Button, FontId::proportional(14.0));
    style.text_styles.insert(TextStyle::Small, FontId::proportional(12.0));
    style.text_styles.insert(TextStyle::Heading, FontId::proportional(19.0));
}
