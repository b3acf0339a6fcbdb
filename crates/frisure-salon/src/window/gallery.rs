//! The gallery: cards with hair types and hairstyles.

use eframe::egui::{
    self, Align2, ColorImage, FontId, Rect, Sense, StrokeKind, TextureHandle, TextureOptions, Ui,
    Vec2, vec2,
};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;

use frisure::formats::picture::photo;

use super::{icons, theme, widgets};
use crate::locale::tr;
use crate::state::{Card, Command, EXERCISES, ExerciseCard, SCENES, Salon, TYPES};

/// The textures of the cards, by the place of their picture in memory.
#[derive(Default)]
pub(super) struct Pictures(BTreeMap<usize, TextureHandle>);

const CARD: Vec2 = vec2(150.0, 184.0);
const CAPTION: f32 = 66.0;

impl Pictures {
    /// The texture of a picture, which is decoded once.
    pub(super) fn of(&mut self, ui: &Ui, picture: &'static [u8]) -> Option<&TextureHandle> {
        let key = picture.as_ptr() as usize;
        match self.0.entry(key) {
            Entry::Occupied(known) => Some(known.into_mut()),
            Entry::Vacant(new) => {
                let image = decoded(picture)?;
                Some(new.insert(ui.ctx().load_texture("card", image, TextureOptions::LINEAR)))
            }
        }
    }
}

/// Shows the picture of a hair type in a rectangle until the first hair is computed.
pub(super) fn placeholder(ui: &Ui, rect: Rect, hair_type: &str, pictures: &mut Pictures) {
    let Some(card) = TYPES.iter().find(|card| card.name == hair_type) else { return };
    let Some(texture) = pictures.of(ui, card.picture) else { return };
    let size = texture.size_vec2();
    let size = size * (0.6 * rect.height() / size.y);
    let place = Rect::from_center_size(rect.center(), size);
    let uv = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
    let faint = egui::Color32::from_white_alpha(70);
    ui.painter().image(texture.id(), place, uv, faint);
    let text = tr!("computing-first");
    let (at, font) = (place.center_bottom() + vec2(0.0, 14.0), FontId::proportional(16.0));
    ui.painter().text(at, Align2::CENTER_TOP, text, font, egui::Color32::from_gray(200));
}

/// Decodes a picture.
fn decoded(bytes: &[u8]) -> Option<ColorImage> {
    // The path is for errors alone.
    let photo = photo::decode(bytes, Path::new("card")).ok()?;
    Some(ColorImage::from_rgb([photo.width, photo.height], &photo.rgb))
}

pub(super) fn show(ui: &mut Ui, salon: &Salon, pictures: &mut Pictures, out: &mut Vec<Command>) {
    egui::ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(12.0);
        ui.horizontal_wrapped(|ui| {
            ui.heading(tr!("gallery-title"));
            if salon.document.is_some() {
                let back = widgets::plain(ui, "back-to-head");
                if back.clicked() {
                    out.push(Command::Gallery(false));
                }
            }
            if widgets::with_icon(ui, icons::TOUR, "take-tour").clicked() {
                out.push(Command::BeginTour);
            }
        });
        ui.weak(tr!("gallery-text"));
        ui.add_space(8.0);
        row(ui, &tr!("hair-types"), TYPES.iter().map(Shown::of), pictures, out);
        row(ui, &tr!("hairstyles"), SCENES.iter().map(Shown::of), pictures, out);
        row(ui, &tr!("exercises"), EXERCISES.iter().map(Shown::of_exercise), pictures, out);
        ui.weak(tr!("exercises-text"));
        ui.add_space(12.0);
    });
}

/// What a card shows, and does when it is clicked.
struct Shown {
    picture: &'static [u8],
    title: String,
    about: String,
    command: Command,
}

impl Shown {
    fn of(card: &Card) -> Self {
        Self {
            picture: card.picture,
            title: card.title().into_owned(),
            about: card.about().into_owned(),
            command: Command::Begin(card.name.to_owned()),
        }
    }

    fn of_exercise(exercise: &ExerciseCard) -> Self {
        Self {
            picture: exercise.picture,
            title: exercise.says(""),
            about: exercise.says("about"),
            command: Command::BeginExercise(exercise.name.to_owned()),
        }
    }
}

fn row(
    ui: &mut Ui,
    title: &str,
    all: impl Iterator<Item = Shown>,
    pictures: &mut Pictures,
    out: &mut Vec<Command>,
) {
    ui.add_space(6.0);
    ui.label(egui::RichText::new(title).strong().size(16.0));
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(10.0, 10.0);
        for one in all {
            if card(ui, &one, pictures) {
                out.push(one.command);
            }
        }
    });
}

/// Shows a card; returns whether it was clicked.
fn card(ui: &mut Ui, card: &Shown, pictures: &mut Pictures) -> bool {
    let Shown { title, about, .. } = card;
    let (rect, response) = ui.allocate_exact_size(CARD + vec2(0.0, CAPTION), Sense::click());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(
            egui::Role::Button,
            true,
            tr!("begin-card", title = title.as_str()),
        )
    });
    if ui.is_rect_visible(rect) {
        let visuals = ui.style().interact(&response);
        let (fill, text) = (visuals.bg_fill, ui.visuals().text_color());
        let weak = ui.visuals().weak_text_color();
        ui.painter().rect_filled(rect, 8.0, fill);
        let top = Rect::from_min_size(rect.min, CARD);
        if let Some(texture) = pictures.of(ui, card.picture) {
            let uv = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter().image(texture.id(), top.shrink(3.0), uv, egui::Color32::WHITE);
        }
        let at = |y: f32| egui::pos2(rect.left() + 8.0, top.bottom() + y);
        let painter = ui.painter().with_clip_rect(rect);
        painter.text(at(3.0), Align2::LEFT_TOP, title, FontId::proportional(14.0), text);
        let about =
            painter.layout(about.clone(), FontId::proportional(11.0), weak, rect.width() - 14.0);
        painter.galley(at(21.0), about, weak);
        if response.hovered() || response.has_focus() {
            let stroke = egui::Stroke::new(2.0, theme::ACCENT);
            ui.painter().rect_stroke(rect, 8.0, stroke, StrokeKind::Inside);
        }
    }
    response.on_hover_text(about).clicked()
}
