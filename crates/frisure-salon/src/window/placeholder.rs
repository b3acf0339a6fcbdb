//! Something in a window until the salon's is there.

use crate::window::probe;
use crate::work::Worker;
use crate::work::web::WebWorker;
use eframe::egui;
use frisure_stylist::order::{Answer, Asked, Effort, Order};
use std::rc::Rc;

pub struct App {
    worker: WebWorker,
    ticket: u64,
    told: Vec<String>,
    wet: bool,
    head: bool,
}

impl App {
    pub fn new(cc: &eframe::CreationContext<'_>) -> Self {
        let ctx = cc.egui_ctx.clone();
        let mut worker = WebWorker::new(Rc::new(move || ctx.request_repaint())).unwrap();
        let asked = Asked {
            name: "first".into(),
            text: "[hair]\ntype = \"caucasian-curly\"\n[output]\nhairs = 2000\n".into(),
            ..Default::default()
        };
        worker.send(1, Order::Show { asked, effort: Effort::Exact });
        Self { worker, ticket: 1, told: vec![], wet: false, head: false }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        while let Some(command) = probe::asked() {
            match command.as_str() {
                "panic" => panic!("asked to"),
                "wet" => self.wet = !self.wet,
                _ => {}
            }
        }
        while let Some((ticket, answer)) = self.worker.poll() {
            let words = match answer {
                Answer::Progress { stage, fraction } => format!("{stage} {fraction}"),
                Answer::Shown(shown) => {
                    self.head = true;
                    format!("shown {} s", shown.numbers.seconds)
                }
                Answer::Cancelled => "cancelled".into(),
                other => format!("{other:?}").chars().take(200).collect(),
            };
            self.told.push(format!("{ticket}: {words}"));
        }
        egui::CentralPanel::default().show(ui, |ui| {
            ui.heading("The salon");
            if ui.button("Wet").clicked() {
                self.wet = !self.wet;
            }
            ui.label(if self.wet { "wet" } else { "dry" });
            if ui.button("Work").clicked() {
                self.ticket += 1;
                let asked = Asked {
                    name: "again".into(),
                    text: "[hair]\ntype = \"caucasian-curly\"\n".into(),
                    ..Default::default()
                };
                self.worker.send(self.ticket, Order::Show { asked, effort: Effort::Exact });
            }
            if ui.button("Cancel").clicked() {
                self.worker.cancel(self.ticket);
            }
            if ui.button("Save").clicked() {
                crate::page::files::download("scene.toml", b"[hair]\n").unwrap();
            }
            for line in &self.told {
                ui.label(line);
            }
        });
        probe::tell(|| {
            format!("{{\"wet\":{},\"head\":{},\"told\":{:?}}}", self.wet, self.head, self.told)
        });
    }
}
