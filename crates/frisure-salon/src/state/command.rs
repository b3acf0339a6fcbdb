//! Everything that a person can do.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use frisure::formats::contents::Contents;
use frisure::hairstyle::styling::{
    Comb, Direction, Dry, Grow, Growth, Lasso, Operation, Release,
    Selection, Spot, View, Wet,
};
use frisure::hairstyle::{Comb as Named, Place};
use frisure::scene::{Button, Scene, SceneError, edit};
use frisure_engine::Diagnostic;
use glam::DVec3;

use super::{
    Alone, Choice, Chosen, Compared, Control, Destination, Document, Hold, Mode, Plane, Salon,
    Shot, Understood, card,
};

/// What the hand holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Turns the head.
    #[default]
    Orbit,
    /// Draws around hair to choose it.
    Lasso,
    /// Paints over the scalp to choose what is rooted there.
    Brush,
    /// Moves the cutting plane.
    Cut,
    /// Drags hair aside.
    Comb,
    /// Picks one hair to look at.
    Pick,
}

/// How much hair grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growing {
    /// By a length (m).
    By(f64),
    /// For so many months.
    Months(f64),
}

/// Something that a person does.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Begin with a card of the gallery, by its name.
    Begin(String),
    /// Open the text of a scene.
    Open {
        /// Its file, if it has one.
        path: Option<PathBuf>,
        /// What it is called.
        name: String,
        /// The text.
        text: String,
    },
    /// Open or close the gallery.
    Gallery(bool),
    /// Move a slider (by its key) to a value in its unit; it is still held.
    Drag(&'static str, f64),
    /// Let it go.
    LetGo,
    /// Type a value for a slider, in its unit.
    Set(&'static str, f64),
    /// Choose a word: the key, and the word as scenes write it.
    Word(&'static str, String),
    /// Give a key back to the hair type.
    Reset(&'static str),
    /// Open a file by its path, or the name under which it was kept: as head, as groom, or both, as it turns out.
    File(String),
    /// What a refused scene lacked may be there now.
    TryAgain,
    /// Use a mesh (a path) as the head; `None` is the mannequin.
    Head(Option<String>),
    /// Use the hair of a file (a path); `None` is that of the scene's own.
    Groom(Option<String>),
    /// Take up a tool.
    Take(Tool),
    /// Choose a part of the scalp.
    Choose(Place, Mode),
    /// Choose all hair.
    ChooseAll,
    /// Choose what is not chosen.
    Invert,
    /// Choose what is inside a polygon in the picture (−1 to 1 to the right and up) of an aspect.
    DrawLasso {
        /// Its corners.
        polygon: Vec<[f64; 2]>,
        /// Width over height of the picture.
        aspect: f64,
        /// What becomes of what was chosen.
        mode: Mode,
    },
    /// Choose what is rooted near places on the skin (m).
    Paint(Vec<DVec3>, Mode),
    /// Radius of the brush (m).
    BrushSize(f64),
    /// Wet what is chosen, or dry it if it is wet.
    Water,
    /// Wet it.
    Wet,
    /// Dry it, and keep so much of a shape it was held in (0 to 1).
    Dry(f64),
    /// Let it grow.
    Grow(Growing),
    /// Comb it to a side.
    Comb(Named),
    /// Comb hair rooted near places on the skin along a direction (m).
    Stroke(Vec<DVec3>, DVec3),
    /// Put the cutting plane somewhere.
    Plane(Plane),
    /// Cut what is chosen at the plane.
    Cut,
    /// Does what a button says to what is chosen.
    Hold(Button),
    /// Let go of it.
    Release,
    /// Another step, as it is.
    Step(Operation),
    /// One back.
    Undo,
    /// One forth.
    Redo,
    /// To one of the document's texts.
    GoTo(usize),
    /// Look at one hair alone; `None` at all.
    Alone(Option<usize>),
    /// See one of the document's texts beside the current one; `None` ends it.
    Compare(Option<usize>),
    /// Turn the camera, by angles (rad).
    Turn(f64, f64),
    /// Move the picture, by parts of its height.
    Pan(f64, f64),
    /// Come nearer.
    Zoom(f64),
    /// Look from a side: azimuth and elevation (rad).
    LookFrom(f64, f64),
    /// Bring all into a picture of an aspect.
    Frame(f64),
    /// Make the view the scene's camera.
    KeepView,
    /// Write the scene.
    Save(Destination),
    /// Write the hair; the extension names the format.
    Export(Destination),
    /// Make a final picture, or a film around the head.
    Shoot(Shot, Destination),
    /// Stop what is done beside.
    Stop,
    /// Take up what a crash left, or forget it.
    Recover(bool),
    /// Forget a message.
    Dismiss(usize),
}

const HEAD: Contents = Contents { head: true, groom: false };
const GROOM: Contents = Contents { head: false, groom: true };

/// Understands a text of a document.
pub(super) fn understand(document: &Document, text: &str) -> Result<Understood, SceneError> {
    let scene = Scene::parse(document.name(), text, document.folder())?;
    let spec = scene.hairstyle_spec()?;
    Ok(Understood { scene, spec })
}

/// What a person reads of a scene that is none.
fn refusal(error: SceneError) -> Diagnostic {
    (&error).into()
}

impl Salon {
    /// Does it.
    pub fn run(&mut self, command: Command) {
        match command {
            Command::Begin(name) => self.begin(&name),
            Command::Open { path, name, text } => {
                self.open_document(Document::new(name, path, "Opened", text));
            }
            Command::Gallery(open) => self.gallery = open,
            Command::Drag(key, value) => self.set(key, value, true),
            Command::LetGo => self.let_go(),
            Command::Set(key, value) => self.set(key, value, false),
            Command::Word(key, word) => self.word(key, &word),
            Command::Reset(key) => self.reset(key),
            Command::File(path) => self.take_file(path),
            Command::TryAgain => self.try_again(),
            Command::Head(path) => self.set_file(path, HEAD),
            Command::Groom(path) => self.set_file(path, GROOM),
            Command::Take(tool) => self.take(tool),
            Command::Choose(..)
            | Command::ChooseAll
            | Command::Invert
            | Command::DrawLasso { .. }
            | Command::Paint(..)
            | Command::BrushSize(_) => self.choose(command),
            Command::Undo => self.go_to(|at| at.checked_sub(1)),
            Command::Redo => self.go_to(|at| Some(at + 1)),
            Command::GoTo(to) => self.go_to(|_| Some(to)),
            Command::Alone(wisp) => {
                let alone = |wisp| Alone { wisp, hair: None, version: 0 };
                self.alone = wisp.map(alone);
            }
            Command::Compare(edit) => self.compare(edit),
            Command::Turn(right, up) => self.orbit.turn(right, up),
            Command::Pan(right, up) => self.orbit.pan(right, up),
            Command::Zoom(factor) => self.orbit.zoom(factor),
            Command::LookFrom(azimuth, elevation) => self.orbit.look_from(azimuth, elevation),
            Command::Frame(aspect) => self.frame_all(aspect),
            Command::KeepView => self.keep_view(),
            Command::Save(to) => self.save(to),
            Command::Export(to) => self.export(to),
            Command::Shoot(shot, to) => self.shoot(shot, to),
            Command::Stop => self.desk.stop_aside(),
            Command::Recover(wanted) => self.recover(wanted),
            Command::Dismiss(index) => {
                if index < self.messages.len() {
                    self.messages.remove(index);
                }
            }
            other => self.style(other),
        }
        self.schedule();
    }

    fn begin(&mut self, name: &str) {
        let Some(card) = card(name) else {
            let hint = "The gallery shows what there is.";
            return self.tell(format!("there is no hair called `{name}`"), hint, true);
        };
        self.open_document(Document::new(card.title, None, card.title, card.text()));
    }

    /// Makes a document the one that is edited, if it can be understood.
    pub(super) fn open_document(&mut self, document: Document) {
        match understand(&document, document.text()) {
            Ok(understood) => {
                self.desk.outdate();
                let view = understood.scene.camera;
                self.scene = Some(Arc::new(understood));
                self.document = Some(document);
                (self.chosen, self.compared, self.alone) = (Chosen::default(), None, None);
                (self.refused, self.gallery, self.framed) = (None, false, false);
                self.held = None;
                (self.tool, self.falling, self.mass_before) = (Tool::Orbit, None, None);
                self.orbit.look_from(view.azimuth, view.elevation);
                self.orbit.field_of_view = view.field_of_view;
            }
            Err(error) => self.complain(&refusal(error)),
        }
    }

    /// Makes a text the current one; `held` while a slider is. A text that is no scene is refused.
    pub(super) fn change(
        &mut self,
        label: &str,
        text: Result<String, edit::EditError>,
        held: bool,
    ) -> bool {
        let Some(document) = &mut self.document else { return false };
        let text = match text {
            Ok(text) => text,
            Err(error) => {
                let refusal = match error {
                    edit::EditError::Scene(error) => refusal(error),
                    other => Diagnostic { problem: other.to_string(), ..Diagnostic::default() },
                };
                self.complain(&refusal);
                return false;
            }
        };
        match understand(document, &text) {
            Ok(understood) => {
                match held {
                    true => document.draft(text),
                    false => document.change(label, text),
                }
                self.scene = Some(Arc::new(understood));
                true
            }
            Err(error) => {
                self.complain(&refusal(error));
                false
            }
        }
    }

    /// The text without what a held slider does to it.
    pub(super) fn base(&self) -> Option<&str> {
        let document = self.document.as_ref()?;
        Some(&document.edits()[document.at()].text)
    }

    fn set(&mut self, key: &'static str, value: f64, held: bool) {
        let (Some(control), Some(base)) = (super::control_of(key), self.base()) else { return };
        let text = edit::set_key(base, key, &control.written(value));
        self.change(&label(control, value), text, held);
    }

    fn let_go(&mut self) {
        let Some(document) = &mut self.document else { return };
        if !document.is_draft() {
            return;
        }
        let label = match &self.scene {
            Some(understood) => changed(&document.edits()[document.at()].text, understood),
            None => "Changed".into(),
        };
        document.keep_draft(label);
    }

    fn word(&mut self, key: &'static str, word: &str) {
        let Some(base) = self.base() else { return };
        let all = super::choices();
        let said = |choice: &Choice| {
            let option = choice.options.iter().find(|(written, _)| written == word);
            option.map(|(_, said)| format!("{}: {}", choice.label, said.to_lowercase()))
        };
        let label = all.iter().find(|c| c.key == key).and_then(said);
        let text = edit::set_key(base, key, word);
        self.change(label.as_deref().unwrap_or("Changed"), text, false);
    }

    fn reset(&mut self, key: &'static str) {
        let Some(base) = self.base() else { return };
        let text = edit::unset_key(base, key);
        let label = match super::choices().into_iter().find(|choice| choice.key == key) {
            Some(choice) => format!("{}: {}", choice.label, choice.usual),
            None => {
                let name = super::control_of(key).map_or(key, |control| control.label);
                format!("{name} as the hair type has it")
            }
        };
        self.change(&label, text, false);
    }

    fn set_file(&mut self, path: Option<String>, what: Contents) {
        match path {
            Some(path) => self.use_file(&path, what),
            None => self.without_file(what),
        }
    }

    fn take(&mut self, tool: Tool) {
        if tool == Tool::Cut && self.tool != Tool::Cut {
            // A plane that cuts something is seen at once.
            let tips = self.shown.as_ref().map_or(-0.1, |seen| seen.hair.numbers.tips);
            self.plane = Plane { held: self.plane.held, ..Plane::level(tips + 0.02) };
        }
        if tool != Tool::Pick {
            self.alone = None;
        }
        self.tool = tool;
    }

    fn choose(&mut self, command: Command) {
        let before = self.chosen.clone();
        self.chosen = match command {
            Command::Choose(place, mode) => {
                let name = super::PLACES.iter().find(|(_, p)| *p == place);
                let name = name.map_or_else(|| "a part".to_owned(), |(n, _)| n.to_lowercase());
                self.chosen.with(Selection::Place(place), &name, mode)
            }
            Command::Invert => self.chosen.inverted(),
            Command::DrawLasso { polygon, aspect, mode } => {
                let orbit = &self.orbit;
                let view = View {
                    eye: tidy(orbit.eye(), 1e-5),
                    target: tidy(orbit.target, 1e-5),
                    field_of_view: orbit.field_of_view,
                    aspect: (aspect * 1e4).round() / 1e4,
                };
                let polygon = simplified(&polygon);
                let lasso = Lasso { view, polygon, through: false };
                self.chosen.with(Selection::Lasso(lasso), "a lasso", mode)
            }
            Command::Paint(places, mode) => match self.painted(&places) {
                Some(selection) => self.chosen.with(selection, "a brush stroke", mode),
                None => return,
            },
            Command::BrushSize(radius) => {
                self.brush = if radius.is_nan() { 0.02 } else { radius.clamp(0.002, 0.1) };
                return;
            }
            _ => Chosen::default(),
        };
        self.chosen_in = self.base().map(str::to_owned);
        if let Err(error) = self.chosen.selection.check() {
            self.tell(error.to_string(), "Draw a larger shape.", true);
            self.chosen = before;
        }
        self.falling = None;
    }

    /// What is rooted under a brush that went over places on the skin (m).
    fn painted(&self, places: &[DVec3]) -> Option<Selection> {
        let mut spots: Vec<DVec3> = Vec::new();
        for &place in places.iter().filter(|p| p.is_finite()) {
            // A stroke is told by places a third of the brush apart.
            if spots.last().is_none_or(|last| last.distance(place) > self.brush / 3.0) {
                spots.push(place);
            }
        }
        let spots: Vec<Spot> = spots.into_iter().map(|p| Spot::At(tidy(p, 1e-4))).collect();
        (!spots.is_empty()).then_some(Selection::Brush { spots, radius: self.brush })
    }

    /// A step on what is chosen.
    fn style(&mut self, command: Command) {
        let Some(seen) = &self.shown else { return };
        let is_same = self.base().is_some_and(|base| self.chosen_in.as_deref() == Some(base));
        let chosen = if is_same { self.chosen.clone() } else { self.chosen.fixed() };
        let (selection, of) = (chosen.selection.clone(), chosen.label);
        let wet = self.is_wet();
        let mass = seen.hair.numbers.mass;
        let (operation, label) = match command {
            Command::Water if wet => {
                (Operation::Dry(Dry { selection, ..Dry::default() }), format!("Dried {of}"))
            }
            Command::Wet | Command::Water => {
                (Operation::Wet(Wet { selection, ..Wet::default() }), format!("Wetted {of}"))
            }
            Command::Dry(keep) => (Operation::Dry(Dry { selection, keep }), format!("Dried {of}")),
            Command::Grow(growing) => {
                let (amount, said) = match growing {
                    Growing::By(length) => {
                        (Growth::By(length), format!("{:.1} cm", length * 100.0))
                    }
                    Growing::Months(months) => {
                        let plural = if months == 1.0 { "" } else { "s" };
                        (Growth::For(months * MONTH), format!("{months} month{plural}"))
                    }
                };
                let grow = Grow { selection, amount, stages: 1 };
                (Operation::Grow(grow), format!("Grew {of} by {said}"))
            }
            Command::Comb(way) => {
                let comb = comb(selection, Direction::Named(way));
                let said = format!("{way:?}").to_lowercase();
                (comb, format!("Combed {of} {said}"))
            }
            Command::Stroke(places, way) => {
                let Some(way) = way.try_normalize() else { return };
                let Some(under) = self.painted(&places) else { return };
                let all = chosen.selection == Selection::Everything;
                let selection = if all { under } else { Selection::All(vec![selection, under]) };
                let comb = comb(selection, Direction::Along(tidy(way, 1e-3)));
                (comb, "Combed along a stroke".into())
            }
            Command::Cut => {
                self.mass_before = Some(mass);
                (self.plane.operation(selection), format!("Cut {of}"))
            }
            Command::Hold(button) => {
                (button.operation().on(selection), format!("{}: {of}", button.label))
            }
            Command::Release => {
                (Operation::Release(Release { selection }), format!("Let go of {of}"))
            }
            Command::Plane(plane) => {
                if plane.point.is_finite() && plane.normal().is_finite() {
                    self.plane = plane;
                }
                return;
            }
            Command::Step(operation) => {
                let label = format!("Step: {}", operation.name());
                (operation, label)
            }
            _ => return,
        };
        self.step(&operation, &label);
    }

    /// Adds a step to the text.
    fn step(&mut self, operation: &Operation, label: &str) {
        let Some(base) = self.base() else { return };
        let text = edit::append(base, std::slice::from_ref(operation));
        self.change(label, text, false);
    }

    /// Whether most of what is chosen is wet.
    #[must_use]
    pub fn is_wet(&self) -> bool {
        let Some(seen) = &self.shown else { return false };
        let chosen = self.chosen.wisps.as_deref();
        let is = |i: &usize| chosen.is_none_or(|c| c.get(*i).copied().unwrap_or(false));
        let wetness = &seen.hair.wetness;
        let (sum, count) =
            (0..wetness.len()).filter(is).fold((0.0, 0), |(sum, n), i| (sum + wetness[i], n + 1));
        sum > 0.5 * count as f32
    }

    fn go_to(&mut self, to: impl FnOnce(usize) -> Option<usize>) {
        let Some(document) = &mut self.document else { return };
        // Undoing while a slider is held lets it go where it was.
        document.drop_draft();
        let Some(to) = to(document.at()) else { return };
        if document.go_to(to)
            && let Ok(understood) = understand(document, document.text())
        {
            self.scene = Some(Arc::new(understood));
            self.mass_before = None;
        }
    }

    fn compare(&mut self, edit: Option<usize>) {
        let Some(document) = &self.document else { return };
        self.compared = None;
        let Some((edit, before)) = edit.and_then(|i| document.edits().get(i).map(|e| (i, e)))
        else {
            return;
        };
        let Ok(understood) = understand(document, &before.text) else { return };
        let asked = super::asked(document, &before.text, understood.scene.steps().len());
        let label = before.label.clone();
        self.compared = Some(Compared { edit, label, hair: None, version: 0 });
        let effort = frisure_engine::Quality::Exact;
        let order = frisure_engine::Request::Preview { scene: asked.clone(), quality: effort };
        self.desk.queue(super::Purpose::Compare(edit), asked, order);
    }

    /// Makes the view the scene's camera, from which pictures are taken by the command line, too.
    fn keep_view(&mut self) {
        let Some(base) = self.base() else { return };
        let degrees = |angle: f64| (angle.to_degrees() * 10.0).round() / 10.0;
        let around = (degrees(self.orbit.azimuth) + 180.0).rem_euclid(360.0) - 180.0;
        let keys = [
            ("camera.azimuth", format!("\"{around} deg\"")),
            ("camera.elevation", format!("\"{} deg\"", degrees(self.orbit.elevation))),
        ];
        let keys: Vec<_> = keys.iter().map(|(key, value)| (*key, Some(value.as_str()))).collect();
        let text = edit::set_keys(base, &keys);
        self.change("The scene's camera", text, false);
    }

    /// What the cutting plane would take of the hair that is seen, while the tool is in hand.
    pub fn falling(&mut self) -> Option<Arc<super::Falling>> {
        let seen = self.shown.as_ref().filter(|_| self.tool == Tool::Cut)?;
        let known = self.falling.as_ref();
        if let Some((_, _, falling)) =
            known.filter(|(version, plane, _)| (*version, *plane) == (seen.version, self.plane))
        {
            return Some(falling.clone());
        }
        let chosen = self.chosen.wisps.as_deref();
        if !self.chosen.is_everything() && chosen.is_none() {
            return None;
        }
        let falling = Arc::new(self.plane.falling(&seen.hair.strands, chosen));
        self.falling = Some((seen.version, self.plane, falling.clone()));
        Some(falling)
    }

    /// The wisp whose root is nearest to a place on the skin (m).
    #[must_use]
    pub fn wisp_at(&self, place: DVec3) -> Option<usize> {
        let roots = &self.shown.as_ref()?.hair.roots;
        let far = |i: &usize| glam::Vec3::from_array(roots[*i]).as_dvec3().distance(place);
        (0..roots.len()).min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// Brings the cutting plane to where hair is cut as it hangs, or combed down first.
    pub fn hold_for_cut(&mut self, held: Hold) {
        self.plane.held = held;
    }
}

/// A mean month (s).
const MONTH: f64 = 365.2425 / 12.0 * 86_400.0;

fn comb(selection: Selection, towards: Direction) -> Operation {
    Operation::Comb(Comb { selection, towards, strength: Comb::STRENGTH, hold: true })
}

/// Rounded as finely as a hand is steady.
fn tidy(v: DVec3, to: f64) -> DVec3 {
    let steps = (1.0 / to).round();
    (v * steps).round() / steps + DVec3::ZERO
}

/// A polygon that a hand drew, without the corners that say nothing.
fn simplified(polygon: &[[f64; 2]]) -> Vec<[f64; 2]> {
    /// Part of the picture's half height that corners are apart at least.
    const APART: f64 = 0.015;
    /// Most corners of a lasso.
    const MOST: usize = 200;
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for &[x, y] in polygon.iter().filter(|p| p.iter().all(|x| x.is_finite())) {
        let far = |last: &[f64; 2]| (last[0] - x).hypot(last[1] - y) > APART;
        if kept.last().is_none_or(far) {
            let round = |x: f64| (x * 1e3).round() / 1e3 + 0.0;
            kept.push([round(x), round(y)]);
        }
    }
    let step = kept.len().div_ceil(MOST).max(1);
    kept.into_iter().step_by(step).collect()
}

fn label(control: &Control, value: f64) -> String {
    format!("{}: {}", control.label, control.said(value))
}

/// What a slider did that was let go: the control whose value differs from what it was.
fn changed(before: &str, now: &Understood) -> String {
    let Ok(before) = Scene::parse("before", before, Path::new("")) else {
        return "Changed".into();
    };
    let Ok(spec) = before.hairstyle_spec() else { return "Changed".into() };
    let other = super::CONTROLS.iter().find(|control| {
        let (old, new) = (control.value(&before, &spec), control.value(&now.scene, &now.spec));
        control.clean(old) != control.clean(new)
    });
    other.map_or_else(
        || "Changed".into(),
        |control| label(control, control.value(&now.scene, &now.spec)),
    )
}
