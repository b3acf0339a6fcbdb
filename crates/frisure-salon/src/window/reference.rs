//! A photo to compare with: in a window of its own beside the picture, or over it.

use eframe::egui::{
    Align2, Color32, ColorImage, Id, Image, Rect, Slider, TextureHandle, TextureOptions, Ui,
    Window, pos2, vec2,
};

use super::{icons, widgets};
use crate::locale::tr;
use crate::state::{Command, Reference, Salon};

/// The texture of the photo.
#[derive(Default)]
pub(super) struct Photo(Option<(u64, TextureHandle)>);

/// Longest side of the photo beside the picture (points), until its window is resized.
const SIDE: f32 = 240.0;

/// Opacity of a photo that is laid over the picture at first. Chosen.
const OPACITY: f32 = 0.5;

impl Photo {
    /// Shows the photo, if there is one.
    pub(super) fn show(&mut self, ui: &Ui, salon: &Salon, out: &mut Vec<Command>) {
        let Some(reference) = &salon.reference else {
            self.0 = None;
            return;
        };
        let texture = self.texture(ui, reference);
        let image = Image::new(&texture);
        let size = vec2(reference.size[0] as f32, reference.size[1] as f32);
        if let Some(opacity) = reference.over {
            lay_over(ui, &texture, opacity);
        }
        let window = Window::new(tr!("reference", name = reference.name.as_str()));
        let window = window.id(Id::unique("reference")).default_width(SIDE).resizable(true);
        // The badge is at the left, the panels beyond the right edge.
        let place = ui.max_rect().right_top() + vec2(-SIDE - 350.0, 12.0);
        window.default_pos(place).pivot(Align2::LEFT_TOP).show(ui.ctx(), |ui| {
            if reference.over.is_none() {
                let scale = (ui.available_width() / size.x).min(1.0);
                ui.add(image.fit_to_exact_size(size * scale));
            }
            controls(ui, reference, out);
        });
    }

    fn texture(&mut self, ui: &Ui, reference: &Reference) -> TextureHandle {
        match &self.0 {
            Some((version, texture)) if *version == reference.version => texture.clone(),
            _ => {
                let image = ColorImage::from_rgb(reference.size, &reference.rgb);
                let texture = ui.ctx().load_texture("reference", image, TextureOptions::LINEAR);
                self.0 = Some((reference.version, texture.clone()));
                texture
            }
        }
    }
}

fn controls(ui: &mut Ui, reference: &Reference, out: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let over = reference.over.is_some();
        if widgets::icon_toggle(ui, icons::REFERENCE, "reference-over", over).clicked() {
            out.push(Command::ReferOver((!over).then_some(OPACITY)));
        }
        if widgets::plain(ui, "reference-end").clicked() {
            out.push(Command::EndReference);
        }
    });
    if let Some(mut opacity) = reference.over {
        let slider = Slider::new(&mut opacity, 0.0..=1.0).max_decimals(2);
        if widgets::labelled(ui, "reference-opacity", slider).changed() {
            out.push(Command::ReferOver(Some(opacity)));
        }
    }
}

/// Draws the photo over the picture, as large as fits.
fn lay_over(ui: &Ui, texture: &TextureHandle, opacity: f32) {
    let (rect, size) = (ui.max_rect(), texture.size_vec2());
    let scale = (rect.width() / size.x).min(rect.height() / size.y);
    let place = Rect::from_center_size(rect.center(), size * scale);
    let tint = Color32::from_white_alpha((opacity * 255.0) as u8);
    let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter().image(texture.id(), place, uv, tint);
}
