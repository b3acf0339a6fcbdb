//! From the keys of a step to its operation: exactly one, with every number in range.

use std::ops::Range;

use frisure_hairstyle::Parting;
use frisure_hairstyle::styling::{
    Comb, Cut, CutLine, Dry, Grow, Growth, Height, Held, Hold, Holder, Humidity, Operation, Part,
    Release, Selection, Wet,
};

use super::blame;
use super::chosen::Where;
use super::keys::{self, Step};
use crate::error::{Fault, SceneError};
use crate::key::{Key, Kind};
use crate::quantity::MONTH;
use crate::resolve::{Result, one_way};
use crate::source::Source;
use crate::words::Which;

/// Advance per turn of hair on a roller (m), if nothing is said: a strand's width.
pub(super) const ROLLER_PITCH: f64 = 5e-3;

/// The operation of the step at a path such as `step[1]`, which is empty if the step is all there is.
pub(super) fn operation(step: &Step, here: &str, source: &Source) -> Result<Operation> {
    one_thing(step, here, source)?;
    let operation = any_operation(step, here, source)?;
    operation.check().map_err(|e| blame::out_of_range(&e, here, operation.name(), source))?;
    Ok(operation)
}

/// Each operation, and where it is written.
fn written(step: &Step) -> [(&'static str, Option<Range<usize>>); 12] {
    [
        ("wet", step.wet.span()),
        ("dry", step.dry.span()),
        ("humidity", step.humidity.span()),
        ("cut", step.cut.span()),
        ("grow", step.grow.span()),
        ("comb", step.comb.span()),
        ("part", step.part.span()),
        ("roll", step.roll.span()),
        ("braid", step.braid.span()),
        ("straighten", step.straighten.span()),
        ("clip", step.clip.span()),
        ("release", step.release.span()),
    ]
}

/// Refuses a step that does nothing, and one that does two things.
fn one_thing(step: &Step, here: &str, source: &Source) -> Result<()> {
    let all = written(step);
    let mut given: Vec<_> =
        all.iter().filter_map(|(name, span)| Some((*name, span.clone()?))).collect();
    given.sort_by_key(|(_, span)| span.start);
    match given.as_slice() {
        [] => {
            let problem = match here {
                "" => "this step does nothing".to_owned(),
                here => format!("`{here}` does nothing"),
            };
            let names: Vec<_> = all.iter().map(|(name, _)| *name).collect();
            let hint = format!("a step has one of {}", names.join(", "));
            Err(Fault::new(problem).key(here).hint(hint).at(source, source.locate(here)))
        }
        [_] => Ok(()),
        [(one, first), (other, span), ..] => {
            let problem = format!("a step does one thing, and this one has `{one}` and `{other}`");
            let hint = "write each as a `[[step]]` of its own";
            let fault = Fault::new(problem).key(blame::join(here, other)).hint(hint);
            Err(fault.related(first.clone(), "the other").at(source, span.clone()))
        }
    }
}

fn any_operation(step: &Step, here: &str, source: &Source) -> Result<Operation> {
    let at = |name: &str| blame::join(here, name);
    let held = |place: &Key<Where>, by| -> Result<Operation> {
        Ok(Operation::Hold(Hold { selection: selection(place, source)?, by }))
    };
    if let Some(wet) = step.wet.get() {
        return self::wet(wet, source);
    }
    if let Some(dry) = step.dry.get() {
        let (selection, keep) = (selection(&dry.place, source)?, Dry::default().keep);
        return Ok(Operation::Dry(Dry { selection, keep: dry.keep.or(keep, source)? }));
    }
    if let Some(cut) = step.cut.get() {
        return self::cut(cut, &at("cut"), source).map(Operation::Cut);
    }
    if let Some(grow) = step.grow.get() {
        return self::grow(grow, &at("grow"), source).map(Operation::Grow);
    }
    if let Some(comb) = step.comb.get() {
        return self::comb(comb, &at("comb"), source).map(Operation::Comb);
    }
    if let Some(part) = step.part.get() {
        return self::part(part, &at("part"), source).map(Operation::Part);
    }
    if let Some(roll) = step.roll.get() {
        let radius = need(&roll.radius, "radius = \"1 cm\"", &at("roll"), source)?;
        let pitch = roll.pitch.or(ROLLER_PITCH, source)?;
        return held(&roll.place, Holder::Roller { radius, pitch });
    }
    if let Some(braid) = step.braid.get() {
        let width = need(&braid.width, "width = \"2 cm\"", &at("braid"), source)?;
        let pitch = need(&braid.pitch, "pitch = \"4 cm\"", &at("braid"), source)?;
        return held(&braid.place, Holder::Braid { width, pitch });
    }
    if let Some(all) = step.straighten.get() {
        return held(&all.place, Holder::Straight);
    }
    if let Some(clip) = step.clip.get() {
        let place = need(&clip.at, "at = 0.5", &at("clip"), source)?;
        let to = need(&clip.to, "to = [0, \"-10 cm\", \"12 cm\"]", &at("clip"), source)?;
        return held(&clip.place, Holder::Clip { at: place, to });
    }
    if let Some(all) = step.release.get() {
        return Ok(Operation::Release(Release { selection: selection(&all.place, source)? }));
    }
    let relative = need(&step.humidity, "humidity = 0.9", here, source)?;
    Ok(Operation::Humidity(Humidity { relative }))
}

fn selection(place: &Key<Where>, source: &Source) -> Result<Selection> {
    place.or(Selection::Everything, source)
}

/// The value of a key that a step cannot do without.
fn need<K: Kind>(key: &Key<K>, example: &str, here: &str, source: &Source) -> Result<K::Value> {
    key.get(source)?.ok_or_else(|| lacks(example, here, source))
}

/// A step without a key that it needs.
fn lacks(example: &str, here: &str, source: &Source) -> SceneError {
    let name = example.split(' ').next().unwrap_or(example);
    let fault = Fault::new(format!("`{here}` needs `{name}`")).key(here);
    fault.hint(format!("write for example `{example}`")).at(source, source.locate(here))
}

fn wet(keys: &keys::Wet, source: &Source) -> Result<Operation> {
    let default = Wet::default();
    Ok(Operation::Wet(Wet {
        selection: selection(&keys.place, source)?,
        to: keys.to.or(default.to, source)?,
        water: keys.water.or(default.water, source)?,
    }))
}

fn cut(keys: &keys::Cut, here: &str, source: &Source) -> Result<Cut> {
    let line = line(keys, here, source)?;
    Ok(Cut { selection: selection(&keys.place, source)?, line, held: held(keys, &line, source)? })
}

fn line(keys: &keys::Cut, here: &str, source: &Source) -> Result<CutLine> {
    let (plane, sphere) = (keys.plane.span(), keys.sphere.span());
    let (length, gathered) = (keys.length.span(), keys.gathered.span());
    let lines = [keys.below.span(), plane, sphere, keys.off_skin.span(), length, gathered];
    one_way(source, &lines.each_ref().map(std::slice::from_ref))?;
    let raise = keys.raise.get(source)?;
    let below = keys.below.get(source)?;
    if let (Some(_), None | Some(Height::At(_))) = (raise, below) {
        let problem = "only a level of the head is raised";
        let hint = "write `below = \"brows\"` or another level beside it";
        return Err(stray(&keys.raise, problem, hint, source));
    }
    if let Some(height) = below {
        return Ok(CutLine::Below(match height {
            Height::Above(level, _) => Height::Above(level, raise.unwrap_or(0.0)),
            at @ Height::At(_) => at,
        }));
    }
    let plane = keys.plane.get(source)?.map(|(point, normal)| CutLine::Plane { point, normal });
    let sphere = keys.sphere.get(source)?;
    let sphere = sphere.map(|(centre, radius)| CutLine::Sphere { centre, radius });
    let off_skin = keys.off_skin.get(source)?.map(CutLine::OffSkin);
    let length = keys.length.get(source)?.map(CutLine::Length);
    let gathered = keys.gathered.get(source)?.map(CutLine::Gathered);
    let line = plane.or(sphere).or(off_skin).or(length).or(gathered);
    line.ok_or_else(|| {
        let problem = format!("`{here}` does not say where");
        let hint = "add `below = \"chin\"`, or one of `plane`, `sphere`, `off_skin`, `length`, \
                    `gathered`";
        Fault::new(problem).key(here).hint(hint).at(source, source.locate(here))
    })
}

fn held(keys: &keys::Cut, line: &CutLine, source: &Source) -> Result<Held> {
    one_way(source, &[&[keys.held.span()], &[keys.elevation.span()]])?;
    if matches!(line, CutLine::Length(_) | CutLine::Gathered(_)) {
        let problem =
            "how the hair is held changes nothing where it is cut to a length or gathered";
        let hint = "take it away";
        if keys.held.is_given() {
            return Err(stray(&keys.held, problem, hint, source));
        }
        if keys.elevation.is_given() {
            return Err(stray(&keys.elevation, problem, hint, source));
        }
    }
    if let Some(angle) = keys.elevation.get(source)? {
        return Ok(Held::Elevated(angle));
    }
    Ok(keys.held.or(Which(Held::default()), source)?.0)
}

/// A key that means nothing here.
fn stray<K>(key: &Key<K>, problem: &str, hint: &str, source: &Source) -> SceneError {
    let span = key.span().unwrap_or(0..0);
    Fault::new(problem).key(source.path_at(&span)).hint(hint).at(source, span)
}

fn grow(keys: &keys::Grow, here: &str, source: &Source) -> Result<Grow> {
    let ways = [keys.by.span(), keys.to.span(), keys.months.span(), keys.time.span()];
    one_way(source, &ways.each_ref().map(std::slice::from_ref))?;
    let by = keys.by.get(source)?.map(Growth::By);
    let to = keys.to.get(source)?.map(Growth::To);
    let months = keys.months.get(source)?.map(|months| Growth::For(months * MONTH));
    let time = keys.time.get(source)?.map(Growth::For);
    let amount = by.or(to).or(months).or(time).ok_or_else(|| {
        let problem = format!("`{here}` does not say how much");
        let hint = "add `by = \"2 cm\"`, `to = \"20 cm\"`, `months = 3` or `time = \"6 weeks\"`";
        Fault::new(problem).key(here).hint(hint).at(source, source.locate(here))
    })?;
    let stages = keys.stages.or(1, source)?;
    Ok(Grow { selection: selection(&keys.place, source)?, amount, stages })
}

fn comb(keys: &keys::Comb, here: &str, source: &Source) -> Result<Comb> {
    Ok(Comb {
        selection: selection(&keys.place, source)?,
        towards: need(&keys.to, "to = \"left\"", here, source)?,
        strength: keys.strength.or(Comb::STRENGTH, source)?,
        hold: keys.hold.or(false, source)?,
    })
}

fn part(keys: &keys::Part, here: &str, source: &Source) -> Result<Part> {
    one_way(source, &[&[keys.at.span()], &[keys.line.span()]])?;
    let through = keys.line.get(source)?.map(Parting::Through);
    let line = keys.at.get(source)?.or(through);
    Ok(Part { line: line.ok_or_else(|| lacks("at = \"middle\"", here, source))? })
}
