//! The bars around the head: what to do, with which tool, and what is under way.

use eframe::egui::{self, ComboBox, DragValue, ProgressBar, RichText, Slider, Ui};
use frisure::hairstyle::Comb as Named;

use super::dialogs::Dialog;
use super::{keys, theme, widgets};
use crate::state::{Command, Growing, Hold, Mode, PLACES, Plane, Salon, Tool, VIEWS};

/// The bar at the top.
pub(super) fn top(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>, dialog: &mut Option<Dialog>) {
    let open = salon.document().is_some();
    ui.horizontal_centered(|ui| {
        if widgets::toggle(ui, "Gallery", salon.is_gallery(), "Hair to begin with").clicked() {
            out.push(Command::Gallery(!salon.is_gallery()));
        }
        let mut ask = |ui: &mut Ui, label, key, help, which, enabled| {
            ui.add_enabled_ui(enabled, |ui| {
                if widgets::plain(ui, label, &format!("{help} ({key})")).clicked() {
                    *dialog = Some(which);
                }
            });
        };
        ask(ui, "Open…", "Ctrl O", "Open a scene, a head or a groom", Dialog::Open, true);
        ask(ui, "Save…", "Ctrl S", "Save the scene", Dialog::Save, open);
        ask(ui, "Export…", "Ctrl E", "Write the hair as a groom", Dialog::Export, open);
        ask(
            ui,
            "Picture…",
            "Ctrl P",
            "Render a final picture or a turntable",
            Dialog::Picture,
            open,
        );
        ui.separator();
        ui.add_enabled_ui(open && !salon.is_gallery(), |ui| {
            let (at, last) = salon.document().map_or((0, 0), |d| (d.at(), d.edits().len() - 1));
            ui.add_enabled_ui(at > 0, |ui| {
                if widgets::plain(ui, "Undo", "Ctrl Z").clicked() {
                    out.push(Command::Undo);
                }
            });
            ui.add_enabled_ui(at < last, |ui| {
                if widgets::plain(ui, "Redo", "Ctrl Shift Z").clicked() {
                    out.push(Command::Redo);
                }
            });
            ui.separator();
            let label = if salon.is_wet() { "Dry" } else { "Wet" };
            let text = RichText::new(label).strong().size(16.0);
            let button = egui::Button::new(text).min_size(egui::vec2(64.0, 28.0));
            if ui.add(button).on_hover_text("Wet or dry what is chosen (W)").clicked() {
                out.push(Command::Water);
            }
            if widgets::plain(ui, "Grow a month", "Let what is chosen grow (G)").clicked() {
                out.push(Command::Grow(Growing::Months(1.0)));
            }
            let compared = salon.compared().is_some();
            if widgets::toggle(ui, "Compare", compared, "Before and after, side by side (X)")
                .clicked()
            {
                out.push(keys::compare(salon));
            }
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if widgets::plain(ui, "Help", "Keys and tools (F1)").clicked() {
                *dialog = Some(Dialog::Help);
            }
            let dark = ui.visuals().dark_mode;
            let other = if dark { "Light" } else { "Dark" };
            if widgets::plain(ui, other, "A light or a dark window").clicked() {
                ui.ctx().set_theme(if dark { egui::Theme::Light } else { egui::Theme::Dark });
            }
            if let Some(document) = salon.document() {
                let changed = if document.is_changed() { " •" } else { "" };
                ui.weak(format!("{}{changed}", document.name()));
            }
        });
    });
}

/// The tools, and what the one in hand can be told.
pub(super) fn tools(ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let tools = [
            (Tool::Orbit, "Turn", "V: turn, move, come nearer"),
            (Tool::Lasso, "Lasso", "L: draw around hair to choose it"),
            (Tool::Brush, "Brush", "B: paint over the scalp to choose what is rooted there"),
            (Tool::Cut, "Cut", "C: drag a cutting plane"),
            (Tool::Comb, "Comb", "K: drag along the way hair is to go"),
            (Tool::Pick, "One hair", "H: click to see one hair with its material frames"),
        ];
        for (tool, label, help) in tools {
            if widgets::toggle(ui, label, salon.tool() == tool, help).clicked() {
                out.push(Command::Take(tool));
            }
        }
        ui.separator();
        match salon.tool() {
            Tool::Cut => cut(ui, salon, out),
            Tool::Brush | Tool::Comb => brush(ui, salon, out),
            Tool::Pick => one_hair(ui, salon, out),
            Tool::Lasso => {
                ui.weak("Draw around hair. Shift adds, Alt takes away.");
            }
            Tool::Orbit => views(ui, out),
        }
    });
}

fn views(ui: &mut Ui, out: &mut Vec<Command>) {
    for (label, azimuth, elevation) in VIEWS {
        if widgets::plain(ui, label, "Look from here").clicked() {
            out.push(Command::LookFrom(f64::to_radians(azimuth), f64::to_radians(elevation)));
        }
    }
    if widgets::plain(ui, "Keep this view", "Make it the scene's camera").clicked() {
        out.push(Command::KeepView);
    }
}

fn cut(ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    let mut plane = *salon.plane();
    let mut height = plane.point.z * 100.0;
    let lean = |ui: &mut Ui, label: &str, angle: &mut f64| {
        let mut degrees = angle.to_degrees();
        let name = ui.label(label);
        let field = DragValue::new(&mut degrees).range(-80.0..=80.0).suffix("°").max_decimals(0);
        if ui.add(field).labelled_by(name.id).changed() {
            *angle = degrees.to_radians();
        }
    };
    let name = ui.label("Height");
    let field = DragValue::new(&mut height).range(-150.0..=20.0).suffix(" cm").max_decimals(1);
    if ui.add(field.speed(0.1)).labelled_by(name.id).changed() {
        plane.point = glam::DVec3::new(0.0, 0.0, height / 100.0);
    }
    lean(ui, "to its left", &mut plane.roll);
    lean(ui, "to the back", &mut plane.pitch);
    let mut down = plane.held == Hold::Down;
    if ui
        .checkbox(&mut down, "combed down")
        .on_hover_text("Each hair is drawn straight down before it is cut, as in the paper")
        .changed()
    {
        plane.held = if down { Hold::Down } else { Hold::Hanging };
    }
    if plane != *salon.plane() {
        out.push(Command::Plane(plane));
    }
    if widgets::plain(ui, "Level", "Make the plane level").clicked() {
        let level = Plane { roll: 0.0, pitch: 0.0, ..*salon.plane() };
        out.push(Command::Plane(level));
    }
    let falling = salon.falling();
    let any = falling.as_ref().is_some_and(|f| f.hairs > 0);
    ui.add_enabled_ui(any, |ui| {
        let button = egui::Button::new(RichText::new("Cut here").strong()).fill(theme::FALLING);
        if ui.add(button).on_hover_text("Enter").clicked() {
            out.push(Command::Cut);
        }
    });
    if let (Some(falling), Some((hair, _))) = (falling, salon.shown()) {
        let grams = falling.share * hair.numbers.mass * 1e3;
        let part = falling.hairs as f64 / hair.numbers.drawn.max(1) as f64 * 100.0;
        ui.label(format!("{part:.0} % of the hairs lose {grams:.1} g"));
    }
}

fn brush(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let mut radius = salon.brush() * 100.0;
    let name = ui.label("Radius");
    let slider = Slider::new(&mut radius, 0.2..=6.0).suffix(" cm").max_decimals(1);
    if ui.add(slider).labelled_by(name.id).changed() {
        out.push(Command::BrushSize(radius / 100.0));
    }
    if salon.tool() == Tool::Comb {
        let ways = [
            ("Forward", Named::Forward),
            ("Back", Named::Back),
            ("Down", Named::Down),
            ("Left", Named::Left),
            ("Right", Named::Right),
        ];
        for (label, way) in ways {
            if widgets::plain(ui, label, "Comb what is chosen this way").clicked() {
                out.push(Command::Comb(way));
            }
        }
    }
}

fn one_hair(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some((hair, _)) = salon.shown() else { return };
    let last = hair.numbers.wisps.saturating_sub(1);
    let mut wisp = salon.alone().map_or(0, |alone| alone.wisp);
    let name = ui.label("Wisp");
    let field = DragValue::new(&mut wisp).range(0..=last);
    if ui.add(field).labelled_by(name.id).changed() {
        out.push(Command::Alone(Some(wisp)));
    }
    match salon.alone() {
        Some(_) => {
            if widgets::plain(ui, "All hair", "See all hair again").clicked() {
                out.push(Command::Alone(None));
            }
        }
        None => {
            ui.weak("Click on the head, or choose a number.");
        }
    }
}

/// What is chosen, and what can be done to it.
pub(super) fn choosing(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let mode = ui.input(|i| match (i.modifiers.shift, i.modifiers.alt) {
        (_, true) => Mode::Remove,
        (true, _) => Mode::Add,
        _ => Mode::Replace,
    });
    ui.horizontal_wrapped(|ui| {
        ui.strong("Chosen:");
        let chosen = salon.chosen();
        let count = match chosen.count() {
            Some(count) => format!("{} ({count} wisps)", chosen.label),
            None => chosen.label.clone(),
        };
        ui.label(count);
        if widgets::toggle(ui, "All", chosen.is_everything(), "Choose all hair (A)").clicked() {
            out.push(Command::ChooseAll);
        }
        if widgets::plain(ui, "Invert", "Choose what is not chosen (I)").clicked() {
            out.push(Command::Invert);
        }
        for (label, place) in PLACES {
            let help = "Choose this part of the scalp. Shift adds, Alt takes away.";
            if widgets::plain(ui, label, help).clicked() {
                out.push(Command::Choose(place, mode));
            }
        }
        ui.separator();
        holds(ui, out);
    });
}

fn holds(ui: &mut Ui, out: &mut Vec<Command>) {
    let list = ComboBox::from_id_salt("hold").selected_text("Hold…").width(80.0);
    let shown = list.show_ui(ui, |ui| {
        for button in frisure::scene::buttons() {
            if ui.selectable_label(false, button.label).clicked() {
                out.push(Command::Hold(*button));
            }
        }
    });
    shown.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, "Hold"));
    if widgets::plain(ui, "Let go", "Let go of what is held (R)").clicked() {
        out.push(Command::Release);
    }
    if widgets::plain(ui, "Grow 1 cm", "Let what is chosen grow").clicked() {
        out.push(Command::Grow(Growing::By(0.01)));
    }
}

/// What is under way, and what there is to tell.
pub(super) fn status(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    for (index, message) in salon.messages().iter().enumerate().rev().take(2) {
        ui.horizontal_wrapped(|ui| {
            if ui.small_button("×").on_hover_text("Dismiss").clicked() {
                out.push(Command::Dismiss(index));
            }
            let colour = if message.is_error { theme::FALLING } else { ui.visuals().text_color() };
            ui.colored_label(colour, &message.text);
            if !message.hint.is_empty() {
                ui.weak(&message.hint);
            }
        });
    }
    ui.horizontal(|ui| {
        if let Some((hair, _)) = salon.shown() {
            let n = &hair.numbers;
            ui.weak(format!(
                "{} wisps · {:.0} hairs · {:.1} cm mean · {:.0} g",
                n.wisps,
                n.hairs,
                n.length * 100.0,
                n.mass * 1e3
            ));
        }
        if let Some((stage, done, waiting)) = salon.aside() {
            ui.separator();
            let text = format!("{stage} {:.0} %", done * 100.0);
            ui.add(ProgressBar::new(done).text(text).desired_width(220.0));
            if waiting > 0 {
                ui.weak(format!("{waiting} more"));
            }
            if widgets::plain(ui, "Stop", "Stop what is done in the background").clicked() {
                out.push(Command::Stop);
            }
        }
    });
}
