//! The exercise that somebody does, in a small window over the picture.

use eframe::egui::{Align2, Id, ProgressBar, RichText, Ui, Window, vec2};

use super::{icons, theme, widgets};
use crate::locale::tr;
use crate::state::{Command, Compared, Nearness, Salon};

/// Width of the window (points).
const WIDTH: f32 = 310.0;

/// Shows the exercise, if there is one.
pub(super) fn show(ui: &Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    let nearness = salon.nearness();
    let Some(exercise) = &salon.exercise else { return };
    let title = tr!("exercise-title", title = exercise.title.as_str());
    let window = Window::new(title).id(Id::unique("exercise")).resizable(false);
    // Over the lower left of the picture, where least of the hair is.
    let window = window.anchor(Align2::LEFT_BOTTOM, vec2(12.0, -96.0)).fixed_size([WIDTH, 0.0]);
    window.show(ui.ctx(), |ui| {
        ui.set_width(WIDTH);
        ui.label(&exercise.text);
        measure(ui, nearness, exercise.goal().is_some());
        ui.horizontal_wrapped(|ui| {
            let shown = salon.comparison.as_ref().is_some_and(|c| c.of == Compared::Goal);
            if widgets::icon_toggle(ui, icons::GOAL, "exercise-show-goal", shown).clicked() {
                out.push(Command::CompareGoal);
            }
            let marked = exercise.marks;
            if widgets::icon_toggle(ui, icons::CUT, "exercise-show-left", marked).clicked() {
                out.push(Command::ToggleGoalMarks);
            }
            let (icon, id) = match exercise.replay {
                None => (icons::PLAY, "exercise-show-solution"),
                Some(_) => (icons::STOP, "exercise-stop"),
            };
            if widgets::with_icon(ui, icon, id).clicked() {
                out.push(Command::ToggleReplay);
            }
            if widgets::plain(ui, "exercise-restart").clicked() {
                out.push(Command::RestartExercise);
            }
            if widgets::plain(ui, "exercise-end").clicked() {
                out.push(Command::EndExercise);
            }
        });
    });
}

/// How near the hair is, and what is left to do.
fn measure(ui: &mut Ui, nearness: Option<Nearness>, has_goal: bool) {
    let Some(nearness) = nearness else {
        ui.weak(if has_goal { tr!("exercise-other-hair") } else { tr!("exercise-computing") });
        return;
    };
    let done = nearness.done.clamp(0.0, 1.0);
    let percent = |part: f64| format!("{:.0}", 100.0 * part);
    let text = tr!("exercise-done", percent = percent(done));
    ui.add(ProgressBar::new(done as f32).text(text).fill(theme::ACCENT));
    let parts = [
        ("exercise-long", nearness.long),
        ("exercise-short", nearness.short),
        ("exercise-elsewhere", nearness.elsewhere),
    ];
    // What is less than a hundredth is not worth a line.
    let left = parts.iter().filter(|(_, part)| *part >= 0.01);
    let left: Vec<_> = left.map(|(id, part)| tr!(id, percent = percent(*part))).collect();
    if nearness.is_passed() {
        ui.label(RichText::new(format!("{} {}", icons::DONE, tr!("exercise-passed"))).strong());
    }
    if !left.is_empty() {
        ui.weak(left.join(" · "));
    }
}
