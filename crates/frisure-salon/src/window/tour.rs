//! The tour, in a small window over the picture.

use eframe::egui::{Align2, RichText, Ui, Window, vec2};

use super::{icons, widgets};
use crate::state::{Command, Salon, TOUR};

/// Width of the window (points).
const WIDTH: f32 = 300.0;

/// Shows the present step, if there is a tour.
pub(super) fn show(ui: &Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some(tour) = &salon.tour else { return };
    let window = Window::new("Tour").collapsible(false).resizable(false);
    // Over the lower left of the picture, where least of the hair is.
    let window = window.anchor(Align2::LEFT_BOTTOM, vec2(12.0, -96.0)).fixed_size([WIDTH, 0.0]);
    window.show(ui.ctx(), |ui| {
        ui.set_width(WIDTH);
        let Some(step) = TOUR.get(tour.at) else {
            ui.strong("That was the tour");
            ui.label("Picture… renders a final picture, Save… keeps the scene, Gallery has other hair. Help (F1) lists all keys.");
            if widgets::plain(ui, "End", "Close the tour").clicked() {
                out.push(Command::NextOfTour);
            }
            return;
        };
        ui.strong(format!("{} of {}: {}", tour.at + 1, TOUR.len(), step.title));
        ui.label(step.text);
        ui.horizontal(|ui| {
            let done = salon.is_step_done();
            let label = if done { "Next" } else { "Skip" };
            if widgets::plain(ui, label, "Go to the next step").clicked() {
                out.push(Command::NextOfTour);
            }
            if widgets::plain(ui, "End the tour", "").clicked() {
                out.push(Command::EndTour);
            }
            if done {
                ui.label(RichText::new(format!("{} Done", icons::DONE)).strong());
            }
        });
    });
}
