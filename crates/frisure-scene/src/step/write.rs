//! Operations as the text of steps, which reads as the same operations to the last bit.

use frisure_hairstyle::styling::{
    Comb, Cut, CutLine, Direction, Dry, Grow, Growth, Height, Held, Hold, Holder, Lasso, Operation,
    Part, Selection, Spot, Wet,
};
use frisure_hairstyle::{self as hair, InvalidSpec, Level, Parting, Place};
use glam::DVec3;
use thiserror::Error;

use crate::key::Choice;
use crate::quantity::{ANGLE, LENGTH, MONTH};
use crate::words::Which;

/// Why an operation cannot be written as a step.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum WriteStepError {
    /// One of its numbers is out of range.
    #[error(transparent)]
    Invalid(#[from] InvalidSpec),
    /// There are no words for it, such as for hair that is held in some way while it is cut to a length.
    #[error("no step says this `{operation}`")]
    Unsaid {
        /// The name of the operation.
        operation: &'static str,
    },
}

/// An operation as a step of a scene: the line `[[step]]` and one with the operation, as a person would
/// write it as far as that is exact. The text reads as the same operation to the last bit.
///
/// # Errors
/// [`WriteStepError`].
pub fn write_step(operation: &Operation) -> Result<String, WriteStepError> {
    operation.check()?;
    let name = operation.name();
    let text = format!("{name} = {}\n", value(operation));
    match super::parse_step(name, text.as_str()) {
        Ok(read) if read == *operation => Ok(format!("[[step]]\n{text}")),
        _ => Err(WriteStepError::Unsaid { operation: name }),
    }
}

/// The value of an operation's key, on one line.
pub(super) fn value(operation: &Operation) -> String {
    let fields = match operation {
        Operation::Humidity(air) => return number(air.relative),
        Operation::Wet(wet) => self::wet(wet),
        Operation::Dry(dry) => self::dry(dry),
        Operation::Cut(cut) => self::cut(cut),
        Operation::Grow(grow) => self::grow(grow),
        Operation::Comb(comb) => self::comb(comb),
        Operation::Part(part) => self::part(part),
        Operation::Hold(hold) => self::hold(hold),
        Operation::Release(_) => Fields::default(),
    };
    match operation.selection() {
        None | Some(Selection::Everything) => fields.text(),
        Some(chosen) => fields.with("where", selection(chosen)).text(),
    }
}

/// The entries of a table on one line.
#[derive(Default)]
struct Fields(Vec<String>);

impl Fields {
    fn with(mut self, key: &str, value: impl AsRef<str>) -> Self {
        self.0.push(format!("{key} = {}", value.as_ref()));
        self
    }

    /// The entry, unless it says what is so anyhow.
    fn unless(self, usual: bool, key: &str, value: impl AsRef<str>) -> Self {
        if usual { self } else { self.with(key, value) }
    }

    fn text(&self) -> String {
        if self.0.is_empty() { "{}".into() } else { format!("{{ {} }}", self.0.join(", ")) }
    }
}

/// Whether two numbers are the same to the last bit.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits()
}

fn wet(wet: &Wet) -> Fields {
    let usual = Wet::default();
    Fields::default().unless(same(wet.to, usual.to), "to", number(wet.to)).unless(
        same(wet.water, usual.water),
        "water",
        number(wet.water),
    )
}

fn dry(dry: &Dry) -> Fields {
    Fields::default().unless(same(dry.keep, Dry::default().keep), "keep", number(dry.keep))
}

fn cut(cut: &Cut) -> Fields {
    let fields = Fields::default();
    let fields = match cut.line {
        CutLine::Below(Height::At(z)) => fields.with("below", length(z)),
        CutLine::Below(Height::Above(level, by)) => {
            let word = word(|w: Which<Level>| w.0 == level);
            fields.with("below", word).unless(same(by, 0.0), "raise", length(by))
        }
        CutLine::Plane { point, normal } => fields.with("plane", plane(point, normal)),
        CutLine::Sphere { centre, radius } => {
            let sphere = Fields::default().with("centre", point(centre));
            fields.with("sphere", sphere.with("radius", length(radius)).text())
        }
        CutLine::OffSkin(distance) => fields.with("off_skin", length(distance)),
        CutLine::Length(left) => fields.with("length", length(left)),
        CutLine::Gathered(to) => fields.with("gathered", point(to)),
    };
    match cut.held {
        Held::Down => fields,
        Held::Hanging => fields.with("held", "\"hanging\""),
        Held::Elevated(angle) => fields.with("elevation", self::angle(angle)),
    }
}

fn grow(grow: &Grow) -> Fields {
    let fields = match grow.amount {
        Growth::By(by) => Fields::default().with("by", length(by)),
        Growth::To(to) => Fields::default().with("to", length(to)),
        Growth::For(time) => {
            // Not every number of seconds is a number of months times those of one.
            let months = time / MONTH;
            let short: f64 = format!("{months:.5e}").parse().unwrap_or(months);
            match [short, months].into_iter().find(|m| same(m * MONTH, time)) {
                Some(months) => Fields::default().with("months", number(months)),
                None => Fields::default().with("time", number(time)),
            }
        }
    };
    fields.unless(grow.stages == 1, "stages", grow.stages.to_string())
}

fn comb(comb: &Comb) -> Fields {
    let to = match comb.towards {
        Direction::Named(named) => word(|w: Which<hair::Comb>| w.0 == named),
        Direction::Along(direction) => vector(direction),
    };
    Fields::default()
        .with("to", to)
        .unless(same(comb.strength, Comb::STRENGTH), "strength", number(comb.strength))
        .unless(!comb.hold, "hold", "true")
}

fn part(part: &Part) -> Fields {
    let fields = Fields::default();
    match &part.line {
        Parting::Straight { offset } if same(*offset, 0.0) => fields.with("at", "\"middle\""),
        Parting::Straight { offset } => fields.with("at", length(*offset)),
        // The one zigzag that there is a word for.
        Parting::Zigzag { .. } => fields.with("at", "\"zigzag\""),
        Parting::Through(points) => fields.with("line", list(points, |p| pair(*p))),
    }
}

fn hold(hold: &Hold) -> Fields {
    let fields = Fields::default();
    match hold.by {
        Holder::Roller { radius, pitch } => {
            let fields = fields.with("radius", length(radius));
            fields.unless(same(pitch, super::read::ROLLER_PITCH), "pitch", length(pitch))
        }
        Holder::Braid { width, pitch } => {
            fields.with("width", length(width)).with("pitch", length(pitch))
        }
        Holder::Straight => fields,
        Holder::Clip { at, to } => fields.with("at", number(at)).with("to", point(to)),
    }
}

/// A height that is said in one value: a level without more, or metres.
fn height(height: Height) -> String {
    match height {
        Height::At(z) => length(z),
        Height::Above(level, _) => word(|w: Which<Level>| w.0 == level),
    }
}

fn selection(chosen: &Selection) -> String {
    let table = |key, value| Fields::default().with(key, value).text();
    match chosen {
        Selection::Everything => "\"everything\"".into(),
        Selection::Place(place) => word(|p: Place| p == *place),
        Selection::Any(parts) if !parts.is_empty() && parts.iter().all(is_place) => {
            list(parts, selection)
        }
        Selection::Above(height) => table("above", self::height(*height)),
        Selection::Wisps(wisps) => table("wisps", list(wisps, ToString::to_string)),
        Selection::Beyond { point, normal } => table("plane", plane(*point, *normal)),
        Selection::Brush { spots, radius } => {
            let brush = Fields::default().with("at", list(spots, |s| spot(*s)));
            table("brush", brush.with("radius", length(*radius)).text())
        }
        Selection::Lasso(lasso) => table("lasso", self::lasso(lasso)),
        Selection::Any(parts) => table("any", list(parts, selection)),
        Selection::All(parts) => table("all", list(parts, selection)),
        Selection::Not(part) => table("not", selection(part)),
    }
}

fn is_place(chosen: &Selection) -> bool {
    matches!(chosen, Selection::Place(_))
}

fn lasso(lasso: &Lasso) -> String {
    let view = lasso.view;
    let camera = Fields::default()
        .with("eye", point(view.eye))
        .with("target", point(view.target))
        .with("field_of_view", angle(view.field_of_view))
        .with("aspect", number(view.aspect));
    let corner = |c: &[f64; 2]| format!("[{}, {}]", number(c[0]), number(c[1]));
    Fields::default()
        .with("camera", camera.text())
        .with("polygon", list(&lasso.polygon, corner))
        .unless(!lasso.through, "through", "true")
        .text()
}

fn spot(spot: Spot) -> String {
    match spot {
        Spot::At(p) => point(p),
        Spot::Tape(place) => pair(place),
    }
}

fn plane(point: DVec3, normal: DVec3) -> String {
    Fields::default().with("point", self::point(point)).with("normal", vector(normal)).text()
}

fn list<T>(items: &[T], text: impl Fn(&T) -> String) -> String {
    format!("[{}]", items.iter().map(text).collect::<Vec<_>>().join(", "))
}

fn point(p: DVec3) -> String {
    list(&p.to_array(), |x| length(*x))
}

fn pair(place: [f64; 2]) -> String {
    list(&place, |x| length(*x))
}

fn vector(v: DVec3) -> String {
    list(&v.to_array(), |x| number(*x))
}

/// A length with its unit, if that is exact; nothing is 0 in any.
fn length(x: f64) -> String {
    if same(x, 0.0) {
        return number(x);
    }
    LENGTH.text(x, &["cm", "mm", "m"]).map_or_else(|| number(x), |text| format!("\"{text}\""))
}

fn angle(x: f64) -> String {
    ANGLE.text(x, &["deg"]).map_or_else(|| number(x), |text| format!("\"{text}\""))
}

/// A bare number that reads as exactly this one; whole ones without a point.
fn number(x: f64) -> String {
    let whole = x.fract() == 0.0 && x.abs() < 1e15 && !same(x, -0.0);
    if whole { format!("{x:.0}") } else { format!("{x:?}") }
}

/// The word, in quotes, that means something. Every value has one.
fn word<C: Choice>(is: impl Fn(C) -> bool) -> String {
    let word = C::words().into_iter().find(|(_, _, value)| is(*value)).map_or("", |w| w.0);
    format!("\"{word}\"")
}
