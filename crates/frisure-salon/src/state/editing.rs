//! Edits of the document's text: opening, sliders, choices, undo and redo.

use std::path::Path;
use std::sync::Arc;

use frisure::scene::{Scene, edit};
use frisure_engine::Diagnostic;

use super::controls::{CONTROLS, Control, choice_of, control_of};
use super::document::Document;
use super::gallery::card;
use super::salon::{ParsedScene, Salon, Tool, parse};
use super::selection::Selected;
use super::sharing;
use crate::locale::tr;

impl Salon {
    /// Opens a card of the gallery, or the scene of a link.
    pub(super) fn begin(&mut self, name: &str) {
        match sharing::decoded(name) {
            Some(Ok(text)) => {
                self.open_document(Document::new(tr!("shared"), None, tr!("from-a-link"), text));
                return;
            }
            Some(Err(problem)) => {
                let text = tr!("link-damaged", problem = problem);
                return self.notify(text, tr!("link-damaged.hint"), true);
            }
            None => {}
        }
        let Some(card) = card(name) else {
            let text = tr!("no-such-card", name = name);
            return self.notify(text, tr!("no-such-card.hint"), true);
        };
        let title = card.title();
        self.open_document(Document::new(&*title, None, &*title, card.text()));
    }

    /// Replaces the document, unless the new one does not parse; returns whether it does.
    pub(super) fn open_document(&mut self, document: Document) -> bool {
        match parse(&document, document.text()) {
            Ok(parsed) => {
                self.jobs.cancel_hair();
                let view = parsed.scene.camera;
                self.orbit.look_from(view.azimuth, view.elevation);
                self.orbit.field_of_view = view.field_of_view;
                self.scene = Some(Arc::new(parsed));
                self.document = Some(document);
                (self.selected, self.comparison, self.isolated) = (Selected::default(), None, None);
                (self.refused, self.held, self.gallery, self.framed) = (None, None, false, false);
                (self.tool, self.cut_preview, self.mass_before) = (Tool::Orbit, None, None);
                self.exercise = None;
                true
            }
            Err(error) => {
                self.report_error(&(&error).into());
                false
            }
        }
    }

    /// Makes a text the current one, or a draft while a slider or the comb is dragged. Returns whether it is a valid scene;
    /// an invalid one is reported and changes nothing.
    pub(super) fn change(
        &mut self,
        label: &str,
        text: Result<String, edit::EditError>,
        draft: bool,
    ) -> bool {
        let Some(document) = &mut self.document else { return false };
        let text = text.map_err(|error| match error {
            edit::EditError::Scene(error) => (&error).into(),
            other => Diagnostic { problem: other.to_string(), ..Diagnostic::default() },
        });
        let parsed = text.and_then(|text| match parse(document, &text) {
            Ok(parsed) => Ok((text, parsed)),
            Err(error) => Err((&error).into()),
        });
        match parsed {
            Ok((text, parsed)) => {
                match draft {
                    true => document.draft(text),
                    false => document.change(label, text),
                }
                self.scene = Some(Arc::new(parsed));
                true
            }
            Err(error) => {
                self.report_error(&error);
                false
            }
        }
    }

    /// Sets a key to a value in its control's unit.
    pub(super) fn set(&mut self, key: &'static str, value: f64, draft: bool) {
        let (Some(control), Some(base)) = (control_of(key), self.base()) else { return };
        let text = edit::set_key(base, key, &control.written(value));
        self.change(&label(control, value), text, draft);
    }

    /// Ends the drag of a slider: its draft becomes an edit.
    pub(super) fn end_drag(&mut self) {
        let Some(document) = self.document.as_mut().filter(|d| d.is_draft()) else { return };
        let before = &document.edits()[document.at()].text;
        let label = self.scene.as_ref().and_then(|parsed| changed(before, parsed));
        document.keep_draft(label.unwrap_or_else(|| tr!("changed")));
    }

    /// Drops a draft: the last edit is what is shown again.
    pub(super) fn drop_draft(&mut self) {
        let Some(document) = self.document.as_mut().filter(|d| d.is_draft()) else { return };
        document.drop_draft();
        if let Ok(parsed) = parse(document, document.text()) {
            self.scene = Some(Arc::new(parsed));
        }
    }

    /// Sets a key to an option of its choice, as TOML.
    pub(super) fn set_option(&mut self, key: &'static str, value: &str) {
        let Some(base) = self.base() else { return };
        let label = choice_of(key).and_then(|choice| {
            let option = choice.options.iter().find(|(written, _)| written == value)?;
            Some(set_to(&choice.label(), &choice.title(option).to_lowercase()))
        });
        let text = edit::set_key(base, key, value);
        self.change(&label.unwrap_or_else(|| tr!("changed")), text, false);
    }

    /// Gives the built-in person the face of a seed.
    pub(super) fn set_face(&mut self, face: u32) {
        let Some(base) = self.base() else { return };
        let text = edit::set_key(base, "head.face", &face.to_string());
        self.change(&tr!("another-face"), text, false);
    }

    /// Removes a key, so that its default holds.
    pub(super) fn reset(&mut self, key: &'static str) {
        let Some(base) = self.base() else { return };
        let text = edit::unset_key(base, key);
        let label = match choice_of(key) {
            Some(choice) => set_to(&choice.label(), &choice.default()),
            None => {
                let name = control_of(key).map_or(key.into(), Control::label);
                set_to(&name, &tr!("default-of-type"))
            }
        };
        self.change(&label, text, false);
    }

    /// Goes to another text of the document, chosen from the index of the current one.
    pub(super) fn go_to(&mut self, to: impl FnOnce(usize) -> Option<usize>) {
        let Some(document) = &mut self.document else { return };
        document.drop_draft();
        let Some(to) = to(document.at()) else { return };
        if document.go_to(to)
            && let Ok(parsed) = parse(document, document.text())
        {
            self.scene = Some(Arc::new(parsed));
            self.mass_before = None;
        }
    }

    /// Writes the view to the scene's camera, which the command line renders from.
    pub(super) fn keep_view(&mut self) {
        let Some(base) = self.base() else { return };
        let degrees = |angle: f64| (angle.to_degrees() * 10.0).round() / 10.0;
        let azimuth = (degrees(self.orbit.azimuth) + 180.0).rem_euclid(360.0) - 180.0;
        let azimuth = format!("\"{azimuth} deg\"");
        let elevation = format!("\"{} deg\"", degrees(self.orbit.elevation));
        let keys = [("camera.azimuth", Some(&*azimuth)), ("camera.elevation", Some(&*elevation))];
        let text = edit::set_keys(base, &keys);
        self.change(&tr!("scene-camera"), text, false);
    }
}

fn label(control: &Control, value: f64) -> String {
    set_to(&control.label(), &control.displayed(value))
}

/// The label of an edit that sets something to a value.
fn set_to(name: &str, value: &str) -> String {
    tr!("set-to", name = name, value = value)
}

/// The label of a dragged slider: that of the first control whose value differs between two scenes.
fn changed(before: &str, now: &ParsedScene) -> Option<String> {
    let before = Scene::parse("before", before, Path::new("")).ok()?;
    before.hairstyle_spec().ok()?;
    CONTROLS.iter().find_map(|control| {
        let (old, new) = (control.value(&before), control.value(&now.scene));
        (control.clean(old) != control.clean(new)).then(|| label(control, new))
    })
}
