//! The tour, in a small window over the picture.

use eframe::egui::{Align2, RichText, Ui, Window, vec2};

use super::{icons, widgets};
use crate::locale::tr;
use crate::state::{Command, Salon, TOUR};

/// Width of the window (points).
const WIDTH: f32 = 300.0;

/// Shows the present step, if there is a tour.
pub(super) fn show(ui: &Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some(tour) = &salon.tour else { return };
    let window = Window::new(tr!("tour")).collapsible(false).resizable(false);
    // Over the lower left of the picture, where least of the hair is.
    let window = window.anchor(Align2::LEFT_BOTTOM, vec2(12.0, -96.0)).fixed_size([WIDTH, 0.0]);
    window.show(ui.ctx(), |ui| {
        ui.set_width(WIDTH);
        let Some(step) = TOUR.get(tour.at) else {
            ui.strong(tr!("tour-over"));
            ui.label(tr!("tour-over.text"));
            if widgets::plain(ui, "tour-close").clicked() {
                out.push(Command::NextOfTour);
            }
            return;
        };
        let title = tr!(step.id);
        let (at, count) = (tour.at + 1, TOUR.len());
        ui.strong(tr!("tour-step", at = at, count = count, title = title));
        ui.label(tr!(&format!("{}.text", step.id)));
        ui.horizontal(|ui| {
            let done = salon.is_step_done();
            let id = if done { "tour-next" } else { "tour-skip" };
            if widgets::plain(ui, id).clicked() {
                out.push(Command::NextOfTour);
            }
            if widgets::plain(ui, "tour-end").clicked() {
                out.push(Command::EndTour);
            }
            if done {
                ui.label(RichText::new(format!("{} {}", icons::DONE, tr!("tour-done"))).strong());
            }
        });
    });
}
