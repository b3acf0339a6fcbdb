//! The selection of hair, and the steps that style it.

use std::sync::Arc;

use frisure::hairstyle::styling::{
    Comb, Direction, Dry, Grow, Growth, Lasso, Operation, Selection, Spot, View, Wet,
};
use frisure::scene::edit;
use glam::{DVec3, Vec3};

use super::combing::CombStroke;
use super::command::Command;
use super::cut_plane::{CutPlane, CutPreview, rounded};
use super::salon::{Salon, Tool, parse};
use super::scissors::Snip;
use super::selection::{PLACES, Selected};
use crate::locale::{self, tr};

impl Salon {
    pub(super) fn take_tool(&mut self, tool: Tool) {
        if tool == Tool::Cut && self.tool != Tool::Cut {
            // Starts just above the tips, so that the preview shows a cut.
            let tips = self.current.as_ref().map_or(-0.1, |current| current.hair.numbers.tips);
            self.plane = CutPlane::level(tips + 0.02);
        }
        if tool != Tool::Pick {
            self.isolated = None;
        }
        // A stroke of the comb that has not ended belongs to no other tool.
        if tool != self.tool {
            self.combing = None;
            self.drop_draft();
        }
        self.tool = tool;
    }

    pub(super) fn move_plane(&mut self, plane: CutPlane) {
        if plane.point.is_finite() && plane.normal().is_finite() {
            self.plane = plane;
        }
    }

    /// Sets the radius of the brush (m), within 2 mm and 10 cm.
    pub(super) fn set_brush(&mut self, radius: f64) {
        self.brush.radius = if radius.is_nan() { 0.02 } else { radius.clamp(0.002, 0.1) };
    }

    /// Executes a command that selects hair.
    pub(super) fn select(&mut self, command: Command) {
        let selected = match command {
            Command::Select(place, mode) => {
                let name = PLACES.iter().find(|(_, p)| *p == place);
                let name =
                    name.map_or_else(|| tr!("a-part"), |(id, _)| tr!(&format!("{id}.selected")));
                self.selected.with(Selection::Place(place), &name, mode)
            }
            Command::InvertSelection => self.selected.inverted(),
            Command::DrawLasso { polygon, aspect, mode } => {
                let view = View {
                    eye: rounded(self.orbit.eye(), 1e-5),
                    target: rounded(self.orbit.target, 1e-5),
                    field_of_view: self.orbit.field_of_view,
                    aspect: (aspect * 1e4).round() / 1e4,
                };
                let lasso = Lasso { view, polygon: simplified(&polygon), through: false };
                self.selected.with(Selection::Lasso(lasso), &tr!("a-lasso"), mode)
            }
            Command::Paint(places, mode) => match self.under_brush(&places) {
                Some(selection) => self.selected.with(selection, &tr!("a-brush-stroke"), mode),
                None => return,
            },
            _ => Selected::default(),
        };
        self.selected_in = self.base().map(str::to_owned);
        match selected.selection.check() {
            Ok(()) => self.selected = selected,
            Err(error) => self.notify(error.to_string(), tr!("draw-larger"), true),
        }
        self.cut_preview = None;
    }

    /// The hair with roots under a brush that passed over positions on the skin (m).
    fn under_brush(&self, places: &[DVec3]) -> Option<Selection> {
        let radius = self.brush.radius;
        let mut spots: Vec<DVec3> = Vec::new();
        for &place in places.iter().filter(|p| p.is_finite()) {
            // A third of the radius between spots covers the stroke.
            if spots.last().is_none_or(|last| last.distance(place) > radius / 3.0) {
                spots.push(place);
            }
        }
        let spots: Vec<Spot> = spots.into_iter().map(|p| Spot::At(rounded(p, 1e-4))).collect();
        (!spots.is_empty()).then_some(Selection::Brush { spots, radius })
    }

    /// Executes a command that adds a step for the selected hair.
    pub(super) fn style(&mut self, command: Command) {
        if self.current.is_none() {
            return;
        }
        if self.is_all_locked() {
            return self.notify(tr!("all-locked"), tr!("all-locked.hint"), false);
        }
        let is_same = self.base().is_some_and(|base| self.selected_in.as_deref() == Some(base));
        let Selected { selection, label: of, .. } =
            if is_same { self.selected.clone() } else { self.selected.fixed() };
        let selection = self.touched(selection);
        let within = |part: Selection| match &selection {
            Selection::Everything => part,
            selection => Selection::All(vec![selection.clone(), part]),
        };
        let draft = matches!(command, Command::DragComb(_));
        let operation = match command {
            Command::Apply(operation) => operation.on(selection),
            Command::ToggleWet if self.is_wet() => Operation::from(Dry::default()).on(selection),
            Command::ToggleWet => Operation::from(Wet::default()).on(selection),
            Command::Comb(ref stroke) | Command::DragComb(ref stroke) => {
                // In the hand it stays where the comb is. Pressed on the head it is held there; beside the head the comb lets go of it, and
                // what friction does not hold slides back.
                let hold = draft || stroke.ends_on_skin();
                let combed = self.combed(stroke, hold);
                if !draft {
                    self.combing = None;
                }
                let Some((comb, wisps)) = combed else { return self.drop_draft() };
                comb.on(within(Selection::Wisps(wisps)))
            }
            Command::Lift(places) => {
                let Some(under) = self.under_brush(&places) else { return };
                self.weigh();
                self.scissors.lifted().on(within(under))
            }
            Command::Clip(places) => {
                let Some(under) = self.under_brush(&places) else { return };
                self.weigh();
                self.scissors.clippers().on(within(under))
            }
            Command::Snip(snip) => {
                let Some((cut, wisps)) = self.snipped(&snip) else { return };
                self.weigh();
                cut.on(within(Selection::Wisps(wisps)))
            }
            Command::Cut => {
                self.weigh();
                self.scissors.at_plane(self.plane.point, self.plane.normal()).on(selection)
            }
            _ => return,
        };
        let label = tr!("set-to", name = title(&operation), value = of);
        if let Some(base) = self.base() {
            let mut steps = vec![operation];
            if self.mirror {
                let other = steps[0].mirrored(&|wisp| self.opposite(wisp));
                if other != steps[0] {
                    steps.push(other);
                }
            }
            let text = edit::append(base, &steps);
            self.change(&label, text, draft);
        }
    }

    /// Keeps the mass of the hair, for the message about what falls.
    fn weigh(&mut self) {
        self.mass_before = self.current.as_ref().map(|c| c.hair.numbers.mass);
    }

    /// The cut of a stroke across the picture, and the wisps that it crosses; `None` and a message if there are none.
    fn snipped(&mut self, snip: &Snip) -> Option<(Operation, Vec<usize>)> {
        let (point, normal) = snip.plane(&self.orbit, self.top())?;
        let (hair, _) = self.drawn()?;
        let wisps = snip.wisps(&self.orbit, &hair.strands, self.head.as_deref());
        if wisps.is_empty() {
            self.notify(tr!("crosses-no-hair"), tr!("crosses-no-hair.hint"), false);
            return None;
        }
        Some((self.scissors.at_plane(point, normal), wisps))
    }

    /// What a stroke of the comb does, and the wisps that it takes; `None` for one that ends where it began, or takes none.
    fn combed(&mut self, stroke: &CombStroke, hold: bool) -> Option<(Operation, Vec<usize>)> {
        // Of the hair as it lay when the stroke began: what follows the comb must not bring it more.
        if self.combing.is_none() {
            self.combing = self.drawn().map(|(hair, _)| hair);
        }
        let direction = rounded(stroke.direction(&self.orbit)?, 1e-3);
        let strands = &self.combing.as_ref()?.strands;
        let wisps = stroke.wisps(&self.orbit, self.brush.radius, strands);
        let until = stroke.end(&self.orbit).map(|end| rounded(end, 1e-4));
        (!wisps.is_empty()).then(|| (combing(Direction::Along(direction), until, hold), wisps))
    }

    /// The top of the head (m).
    pub(super) fn top(&self) -> DVec3 {
        self.head.as_ref().map_or(DVec3::Z * 0.1, |head| {
            let (low, high) = head.framed();
            (0.5 * (low + high)).with_z(high.z)
        })
    }

    /// The wisp rooted nearest to the mirror image of another one's root.
    fn opposite(&self, wisp: usize) -> usize {
        let root = self.current.as_ref().and_then(|current| current.hair.roots.get(wisp));
        let mirrored = root.map(|&[x, y, z]| Vec3::new(-x, y, z).as_dvec3());
        mirrored.and_then(|place| self.wisp_at(place)).unwrap_or(wisp)
    }

    /// Whether most of the selected hair is wet.
    #[must_use]
    pub fn is_wet(&self) -> bool {
        let Some(current) = &self.current else { return false };
        let selected = self.selected.wisps.as_deref();
        let is = |i: &usize| selected.is_none_or(|s| s.get(*i).copied().unwrap_or(false));
        let wetness = &current.hair.wetness;
        let (sum, count) =
            (0..wetness.len()).filter(is).fold((0.0, 0), |(sum, n), i| (sum + wetness[i], n + 1));
        sum > 0.5 * count as f32
    }

    /// A preview of the cut of the shown hair, while the cutting tool is active.
    pub fn cut_preview(&mut self) -> Option<Arc<CutPreview>> {
        let (hair, version) = self.drawn().filter(|_| self.tool == Tool::Cut)?;
        let plane = self.plane;
        if let Some((.., preview)) =
            self.cut_preview.as_ref().filter(|(v, p, _)| (*v, *p) == (version, plane))
        {
            return Some(preview.clone());
        }
        let wisps = self.selected.wisps.as_deref();
        if !self.selected.is_everything() && wisps.is_none() {
            return None;
        }
        let untouched = self.untouched();
        let free: Vec<bool>;
        let wisps = match untouched.is_empty() {
            true => wisps,
            false => {
                let is_in = |wisp: &usize| wisps.is_none_or(|of| of.get(*wisp) == Some(&true));
                free = (0..untouched.len()).map(|w| is_in(&w) && !untouched[w]).collect();
                Some(&free[..])
            }
        };
        let preview = Arc::new(plane.preview(&hair.strands, wisps));
        self.cut_preview = Some((version, plane, preview.clone()));
        Some(preview)
    }

    /// The wisp whose root is nearest to a position on the skin (m).
    #[must_use]
    pub fn wisp_at(&self, place: DVec3) -> Option<usize> {
        let roots = &self.current.as_ref()?.hair.roots;
        let far = |i: &usize| Vec3::from_array(roots[*i]).as_dvec3().distance(place);
        (0..roots.len()).min_by(|a, b| far(a).total_cmp(&far(b)))
    }
}

/// An operation that combs hair in a direction and holds it there.
#[must_use]
pub fn comb(towards: Direction) -> Operation {
    combing(towards, None, true)
}

fn combing(towards: Direction, until: Option<DVec3>, hold: bool) -> Operation {
    let selection = Selection::Everything;
    Operation::Comb(Comb { selection, towards, strength: Comb::STRENGTH, until, hold })
}

impl Salon {
    /// The label of the last step of a text in the history.
    pub(super) fn label_of_last_step(&self, text: &str) -> String {
        let parsed = self.document.as_ref().and_then(|document| parse(document, text).ok());
        let last = parsed.and_then(|parsed| parsed.scene.steps().last().map(title));
        last.unwrap_or_else(|| tr!("changed"))
    }
}

/// The title of an operation in the history.
fn title(operation: &Operation) -> String {
    match operation {
        Operation::Grow(Grow { amount: Growth::By(length), .. }) => {
            tr!("operation-grow-by", cm = locale::number(length * 100.0, 1))
        }
        Operation::Comb(Comb { towards: Direction::Named(side), .. }) => {
            let english = format!("comb {side:?}").to_lowercase();
            capitalized(&locale::named("operation", &english, &english))
        }
        other => capitalized(&locale::named("operation", other.name(), other.name())),
    }
}

/// A text with its first letter in upper case.
pub(super) fn capitalized(text: &str) -> String {
    let mut text = text.to_owned();
    if let Some(first) = text.get_mut(0..1) {
        first.make_ascii_uppercase();
    }
    text
}

/// A drawn polygon without the corners that are close to the one before.
fn simplified(polygon: &[[f64; 2]]) -> Vec<[f64; 2]> {
    /// Minimum distance of corners (as a fraction of the picture's half height). Chosen by trial.
    const MIN_DISTANCE: f64 = 0.015;
    /// Maximum number of corners of a lasso, which limits the size of the scene's text.
    const MAX_CORNERS: usize = 200;
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for &[x, y] in polygon.iter().filter(|p| p.iter().all(|x| x.is_finite())) {
        let far = |last: &[f64; 2]| (last[0] - x).hypot(last[1] - y) > MIN_DISTANCE;
        if corners.last().is_none_or(far) {
            let round = |x: f64| (x * 1e3).round() / 1e3 + 0.0;
            corners.push([round(x), round(y)]);
        }
    }
    let step = corners.len().div_ceil(MAX_CORNERS).max(1);
    corners.into_iter().step_by(step).collect()
}
