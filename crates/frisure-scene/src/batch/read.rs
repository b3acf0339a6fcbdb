//! The description of a batch, understood.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::heads::{Batch, MOST_HEADS};
use super::names::{self, ValueType};
use super::sheet::{Column, Sheet};
use super::way::{Kind, Parameter, Scale, Value, Way, Written, kind_of, word};
use crate::error::{Diagnostic, SceneError};
use crate::kind::read_quantity;
use crate::scene::Scene;
use crate::similar::nearest;
use crate::source::Source;

/// Keys of a batch.
const KEYS: [&str; 10] =
    ["scene", "samples", "seed", "same_seed", "rows", "points", "volume", "set", "grid", "vary"];

/// Keys that say how a key varies.
const WAYS: [&str; 11] = [
    "from",
    "to",
    "log",
    "steps",
    "normal",
    "lognormal",
    "values",
    "weights",
    "table",
    "column",
    "unit",
];

/// Those of them of which one has to be there.
const FIRST: [&str; 6] = ["from", "to", "normal", "lognormal", "values", "table"];

/// Most values of one key in a grid.
const MOST_STEPS: i64 = 1_000_000;

/// Deviations from the mean that a limit may be away on its far side: beyond, nothing would be drawn.
const FAR: f64 = 3.0;

type Result<T, E = SceneError> = std::result::Result<T, E>;

/// Understands a description; the ends of its ranges have not been tried yet.
pub(super) fn batch(source: Source, folder: &Path) -> Result<Batch> {
    let reader = Reader { source: &source, folder };
    let document = source.document()?;
    let fields = reader.fields(document.get_ref(), "", &KEYS)?;
    let (base, scene_folder) = reader.base(&fields)?;
    let fixed = reader.fixed(&fields)?;
    let grid = reader.grid(&fields)?;
    let (vary, sheets) = reader.vary(&fields)?;
    let parameters: Vec<Varied> = grid.into_iter().chain(vary).collect();
    reader.check_once(&fixed, &parameters)?;
    let has_grid = parameters.iter().any(|varied| varied.parameter.cells().is_some());
    let samples = reader.samples(&fields, has_grid)?;
    let batch = Batch {
        seed: reader.whole(&fields, "seed", 0, i64::MAX)?.unwrap_or(1) as u64,
        same_seed: reader.flag(&fields, "same_seed")?.unwrap_or(false),
        samples,
        rows: reader.whole(&fields, "rows", 1, 100_000)?.unwrap_or(16) as usize,
        points: reader.whole(&fields, "points", 2, 10_000)?.map(|points| points as usize),
        volume: reader.flag(&fields, "volume")?.unwrap_or(true),
        fixed: fixed.into_iter().map(|entry| (entry.path, entry.text)).collect(),
        parameters: parameters.into_iter().map(|varied| varied.parameter).collect(),
        sheets,
        base,
        folder: scene_folder,
        digest: [0; 16],
        source: source.clone(),
    };
    let cells = batch.parameters.iter().filter_map(Parameter::cells).map(<[Written]>::len);
    let heads = cells.chain([samples]).try_fold(1_usize, usize::checked_mul);
    if heads.is_none_or(|heads| heads > MOST_HEADS) {
        let problem = format!("these are more than {MOST_HEADS} heads");
        let place = fields.get("grid").or(fields.get("samples"));
        let span = place.map_or(0..0, |field| field.key.clone());
        return Err(Diagnostic::new(problem)
            .hint("a grid is the product of all its lists")
            .at(&source, span));
    }
    Ok(batch)
}

/// A key with its value, in the text.
#[derive(Clone)]
struct Field<'a> {
    key: Range<usize>,
    value: &'a Spanned<DeValue<'a>>,
}

type Fields<'a> = BTreeMap<String, Field<'a>>;

/// A key of the scene, and what is written for it.
struct Entry<'a> {
    path: String,
    text: String,
    field: Field<'a>,
}

/// A key that varies, and where that is said.
struct Varied {
    parameter: Parameter,
    place: Range<usize>,
}

struct Reader<'a> {
    source: &'a Source,
    folder: &'a Path,
}

impl<'a> Reader<'a> {
    /// The keys of a table, all of them known.
    fn fields<'b>(&self, table: &'b DeTable<'b>, path: &str, known: &[&str]) -> Result<Fields<'b>> {
        let mut fields = Fields::new();
        for (key, value) in table {
            let name = key.get_ref().as_ref();
            if !known.contains(&name) {
                let hint = match nearest(name, known.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("known keys: {}", known.join(", ")),
                };
                let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
                let diagnostic =
                    Diagnostic::new(format!("unknown key `{name}`")).hint(hint).key(path);
                return Err(diagnostic.at(self.source, key.span()));
            }
            fields.insert(name.to_owned(), Field { key: key.span(), value });
        }
        Ok(fields)
    }

    fn text(&self, value: &Spanned<DeValue<'_>>) -> &'a str {
        self.source.slice(value.span())
    }

    /// A value that is not what it must be.
    fn refuse(
        &self,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        allowed: impl Into<String>,
    ) -> SceneError {
        let diagnostic = Diagnostic::outside(allowed).key(key).value(self.text(value));
        diagnostic.at(self.source, value.span())
    }

    fn whole(&self, fields: &Fields<'_>, key: &str, least: i64, most: i64) -> Result<Option<i64>> {
        let Some(field) = fields.get(key) else { return Ok(None) };
        let whole = Written::literal(self.text(field.value), None).value;
        match whole {
            Value::Whole(x) if (least..=most).contains(&x) => Ok(Some(x)),
            _ if most == i64::MAX => {
                Err(self.refuse(key, field.value, format!("a whole number, {least} or more")))
            }
            _ => {
                let allowed = format!("a whole number between {least} and {most}");
                Err(self.refuse(key, field.value, allowed))
            }
        }
    }

    fn flag(&self, fields: &Fields<'_>, key: &str) -> Result<Option<bool>> {
        let Some(field) = fields.get(key) else { return Ok(None) };
        let flag = field.value.get_ref().as_bool();
        flag.map(Some).ok_or_else(|| self.refuse(key, field.value, "true or false"))
    }

    fn word(&self, fields: &Fields<'_>, key: &str) -> Result<Option<String>> {
        let Some(field) = fields.get(key) else { return Ok(None) };
        let word = word(self.text(field.value));
        word.map(Some).ok_or_else(|| self.refuse(key, field.value, "a text in quotes"))
    }

    /// The scene, and its folder.
    fn base(&self, fields: &Fields<'_>) -> Result<(Scene, std::path::PathBuf)> {
        let Some(name) = self.word(fields, "scene")? else {
            let scene = Scene::parse("scene", "", self.folder)?;
            return Ok((scene, self.folder.into()));
        };
        let path = self.folder.join(&name);
        let scene = Scene::read(&path).map_err(|error| match error {
            SceneError::Read(error) => {
                let diagnostic =
                    Diagnostic::new(error.to_string()).key("scene").value(name.as_str());
                let hint = "the scene's path is relative to the batch";
                diagnostic.hint(hint).at(self.source, fields["scene"].value.span())
            }
            diagnostic => diagnostic,
        })?;
        scene.hairstyle_spec()?;
        let folder = path.parent().unwrap_or(Path::new("")).into();
        Ok((scene, folder))
    }

    fn samples(&self, fields: &Fields<'_>, has_grid: bool) -> Result<usize> {
        let most = i64::try_from(MOST_HEADS).unwrap_or(i64::MAX);
        match self.whole(fields, "samples", 1, most)? {
            Some(samples) => Ok(samples as usize),
            None if has_grid => Ok(1),
            None => {
                let diagnostic = Diagnostic::new("`samples` is missing").key("samples");
                let hint =
                    "`samples = 1000` at the top is a thousand heads; only a `[grid]` needs none";
                Err(diagnostic.hint(hint).at(self.source, 0..0))
            }
        }
    }

    /// The keys of the scene in one of the tables, in the order in which they are written. `is_whole` tells
    /// whether a table is a value.
    fn entries<'b>(
        &self,
        fields: &Fields<'b>,
        name: &str,
        is_whole: fn(&str, &DeTable<'_>) -> bool,
    ) -> Result<Vec<Entry<'b>>> {
        let Some(field) = fields.get(name) else { return Ok(Vec::new()) };
        let Some(table) = field.value.get_ref().as_table() else {
            return Err(self.refuse(name, field.value, "a table"));
        };
        let mut found = Vec::new();
        self.flatten(table, "", is_whole, &mut found);
        found.sort_by_key(|entry| entry.field.key.start);
        Ok(found)
    }

    fn flatten<'b>(
        &self,
        table: &'b DeTable<'b>,
        path: &str,
        is_whole: fn(&str, &DeTable<'_>) -> bool,
        found: &mut Vec<Entry<'b>>,
    ) {
        for (key, value) in table {
            let name = key.get_ref();
            let path = if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
            match value.get_ref() {
                DeValue::Table(inner) if !is_whole(&path, inner) => {
                    self.flatten(inner, &path, is_whole, found);
                }
                _ => {
                    let field = Field { key: key.span(), value };
                    found.push(Entry { path, text: self.text(value).to_owned(), field });
                }
            }
        }
    }

    fn value_type(&self, entry: &Entry<'_>) -> Result<ValueType> {
        names::value_type(&entry.path).map_err(|no_key| {
            let diagnostic =
                Diagnostic::new(no_key.problem).hint(no_key.hint).key(entry.path.as_str());
            diagnostic.at(self.source, entry.field.key.clone())
        })
    }

    fn fixed<'b>(&self, fields: &Fields<'b>) -> Result<Vec<Entry<'b>>> {
        let entries = self.entries(fields, "set", |_, _| false)?;
        entries.iter().try_for_each(|entry| self.value_type(entry).map(drop))?;
        Ok(entries)
    }

    fn grid(&self, fields: &Fields<'_>) -> Result<Vec<Varied>> {
        let entries = self.entries(fields, "grid", is_way)?;
        entries.iter().map(|entry| self.grid_key(entry)).collect()
    }

    fn grid_key(&self, entry: &Entry<'_>) -> Result<Varied> {
        let value_type = self.value_type(entry)?;
        let choices = match entry.field.value.get_ref() {
            DeValue::Array(_) => self.list(&entry.path, entry.field.value, value_type)?,
            DeValue::Table(table) => {
                let fields = self.fields(table, &entry.path, &WAYS)?;
                match fields.get("values") {
                    Some(list) => {
                        self.only(entry, &fields, &["values"])?;
                        self.list(&entry.path, list.value, value_type)?
                    }
                    None => {
                        self.only(entry, &fields, &["from", "to", "steps", "log"])?;
                        self.steps(entry, &fields, value_type)?
                    }
                }
            }
            _ => {
                let allowed = "a list, or a table with `from`, `to` and `steps`";
                return Err(self.one_value(entry, allowed));
            }
        };
        Ok(varied(entry, kind_of(&choices), Way::Grid(choices)))
    }

    fn one_value(&self, entry: &Entry<'_>, allowed: &str) -> SceneError {
        let diagnostic =
            Diagnostic::outside(allowed).key(entry.path.as_str()).value(entry.text.as_str());
        let hint = "`[set]` gives all heads one value";
        diagnostic.hint(hint).at(self.source, entry.field.value.span())
    }

    /// The values of a grid from one number to another.
    fn steps(
        &self,
        entry: &Entry<'_>,
        fields: &Fields<'_>,
        value_type: ValueType,
    ) -> Result<Vec<Written>> {
        let [from, to] = self.range(entry, fields, value_type)?;
        let scale = self.scale(entry, fields, from)?;
        let steps = self.whole(fields, "steps", 2, MOST_STEPS)?;
        let steps = steps.ok_or_else(|| self.missing(entry, "steps"))?;
        let last = (steps - 1) as f64;
        let ends = if scale == Scale::Log { [from.ln(), to.ln()] } else { [from, to] };
        let at = |i: i64| match i {
            0 => from,
            i if i == steps - 1 => to,
            i => {
                let x = ends[0] + (ends[1] - ends[0]) * (i as f64 / last);
                if scale == Scale::Log { x.exp() } else { x }
            }
        };
        let is_whole = matches!(value_type, ValueType::Whole);
        let mut all: Vec<Written> = (0..steps)
            .map(|i| if is_whole { Written::whole(at(i)) } else { Written::number(at(i)) })
            .collect();
        all.dedup();
        Ok(all)
    }

    fn missing(&self, entry: &Entry<'_>, key: &str) -> SceneError {
        let diagnostic = Diagnostic::new(format!("`{}` has no `{key}`", entry.path));
        diagnostic.key(entry.path.as_str()).at(self.source, entry.field.value.span())
    }

    /// Refuses a table that says two things.
    fn only(&self, entry: &Entry<'_>, fields: &Fields<'_>, allowed: &[&str]) -> Result<()> {
        match fields.iter().find(|(name, _)| !allowed.contains(&name.as_str())) {
            None => Ok(()),
            Some((name, field)) => {
                let with = allowed.join("`, `");
                let problem = format!("`{name}` does not go with the rest: it would be `{with}`");
                let path = format!("{}.{name}", entry.path);
                Err(Diagnostic::new(problem).key(path).at(self.source, field.key.clone()))
            }
        }
    }

    /// The items of a list.
    fn list(
        &self,
        path: &str,
        value: &Spanned<DeValue<'_>>,
        value_type: ValueType,
    ) -> Result<Vec<Written>> {
        let items = value.get_ref().as_array().filter(|items| !items.is_empty());
        let items = items.ok_or_else(|| self.refuse(path, value, "a list of values"))?;
        let written = |item| Written::literal(self.text(item), value_type.dimension());
        Ok(items.iter().map(written).collect())
    }

    /// `from` and `to`, in order.
    fn range(
        &self,
        entry: &Entry<'_>,
        fields: &Fields<'_>,
        value_type: ValueType,
    ) -> Result<[f64; 2]> {
        let from = self.number(entry, fields, "from", value_type)?;
        let to = self.number(entry, fields, "to", value_type)?;
        let from = from.ok_or_else(|| self.missing(entry, "from"))?;
        let to = to.ok_or_else(|| self.missing(entry, "to"))?;
        self.in_order(entry, fields, from, to)?;
        Ok([from, to])
    }

    fn in_order(&self, entry: &Entry<'_>, fields: &Fields<'_>, from: f64, to: f64) -> Result<()> {
        if from < to {
            return Ok(());
        }
        let low = fields.get("from").map_or("", |field| self.text(field.value));
        let path = format!("{}.to", entry.path);
        let to = fields.get("to").expect("there is one, or it would be in order");
        Err(self.refuse(&path, to.value, format!("more than `from`, which is {low}")))
    }

    fn scale(&self, entry: &Entry<'_>, fields: &Fields<'_>, from: f64) -> Result<Scale> {
        if !self.flag(fields, "log")?.unwrap_or(false) {
            return Ok(Scale::Linear);
        }
        if from > 0.0 {
            return Ok(Scale::Log);
        }
        let path = format!("{}.from", entry.path);
        let field = fields.get("from").expect("a range was read");
        Err(self.refuse(&path, field.value, "more than 0, with `log`"))
    }

    /// A number of a key of its table, SI units.
    fn number(
        &self,
        entry: &Entry<'_>,
        fields: &Fields<'_>,
        name: &str,
        value_type: ValueType,
    ) -> Result<Option<f64>> {
        let Some(field) = fields.get(name) else { return Ok(None) };
        self.quantity(&format!("{}.{name}", entry.path), &entry.path, field.value, value_type)
            .map(Some)
    }

    /// A number that a key may have, SI units; `path` is where it stands.
    fn quantity(
        &self,
        path: &str,
        key: &str,
        value: &Spanned<DeValue<'_>>,
        value_type: ValueType,
    ) -> Result<f64> {
        match value_type {
            ValueType::Quantity(dimension) => {
                let toml = super::way::understood(self.text(value));
                let toml = toml.ok_or_else(|| self.refuse(path, value, "a number"))?;
                read_quantity(&toml, dimension)
                    .map_err(|e| e.at_path(&self.source.path_at(&value.span()), self.source))
            }
            ValueType::Whole => match Written::literal(self.text(value), None).value {
                Value::Whole(x) => Ok(x as f64),
                _ => Err(self.refuse(path, value, "a whole number")),
            },
            ValueType::Other => {
                let diagnostic = Diagnostic::new(format!("`{key}` has no numbers between two"));
                let diagnostic = diagnostic.key(path).hint("list what it may be: `values = [...]`");
                Err(diagnostic.at(self.source, value.span()))
            }
        }
    }

    fn vary(&self, fields: &Fields<'_>) -> Result<(Vec<Varied>, Vec<Sheet>)> {
        let entries = self.entries(fields, "vary", is_way)?;
        let mut sheets: Vec<Sheet> = Vec::new();
        let mut all = Vec::new();
        for entry in &entries {
            let value_type = self.value_type(entry)?;
            let Some(table) = entry.field.value.get_ref().as_table() else {
                let list = entry.field.value.get_ref().as_array().map(|_| ());
                if list.is_none() {
                    let allowed = "a list, or a table that says how it varies, such as \
                                   { from = ..., to = ... }";
                    return Err(self.one_value(entry, allowed));
                }
                let choices = self.list(&entry.path, entry.field.value, value_type)?;
                all.push(chosen(entry, choices, None));
                continue;
            };
            let fields = self.fields(table, &entry.path, &WAYS)?;
            all.push(self.way(entry, &fields, value_type, &mut sheets)?);
        }
        for sheet in &mut sheets {
            let cells = sheet.settle(self.source)?;
            for (key, cells) in cells {
                let found = all.iter_mut().find(|varied| varied.parameter.key == key);
                let found = &mut found.expect("its column was taken").parameter;
                found.kind = kind_of(&cells);
                if let Way::Column { cells: here, .. } = &mut found.way {
                    *here = cells;
                }
            }
        }
        Ok((all, sheets))
    }

    fn way(
        &self,
        entry: &Entry<'_>,
        fields: &Fields<'_>,
        value_type: ValueType,
        sheets: &mut Vec<Sheet>,
    ) -> Result<Varied> {
        let is = |name: &str| fields.contains_key(name);
        if is("values") {
            self.only(entry, fields, &["values", "weights"])?;
            let choices = self.list(&entry.path, fields["values"].value, value_type)?;
            let weights = self.weights(entry, fields, choices.len())?;
            return Ok(chosen(entry, choices, weights));
        }
        if is("table") {
            self.only(entry, fields, &["table", "column", "unit"])?;
            let sheet = self.column(entry, fields, value_type, sheets)?;
            return Ok(varied(entry, Kind::Text, Way::Column { sheet, cells: Vec::new() }));
        }
        let whole = matches!(value_type, ValueType::Whole);
        let kind = if whole { Kind::Whole } else { Kind::Number };
        for (name, scale) in [("normal", Scale::Linear), ("lognormal", Scale::Log)] {
            if is(name) {
                self.only(entry, fields, &[name, "from", "to"])?;
                let way = self.normal(entry, fields, name, value_type, scale)?;
                return Ok(varied(entry, kind, way));
            }
        }
        if is("from") || is("to") {
            self.only(entry, fields, &["from", "to", "log"])?;
            let range = self.range(entry, fields, value_type)?;
            let scale = self.scale(entry, fields, range[0])?;
            return Ok(varied(entry, kind, Way::Uniform { range, scale, whole }));
        }
        let diagnostic = Diagnostic::new(format!("nothing says how `{}` varies", entry.path));
        let hint = format!("one of `{}` does", FIRST.join("`, `"));
        Err(diagnostic
            .key(entry.path.as_str())
            .hint(hint)
            .at(self.source, entry.field.value.span()))
    }

    /// Sums of weights, all of the list's length.
    fn weights(
        &self,
        entry: &Entry<'_>,
        fields: &Fields<'_>,
        count: usize,
    ) -> Result<Option<Vec<f64>>> {
        let Some(field) = fields.get("weights") else { return Ok(None) };
        let path = format!("{}.weights", entry.path);
        let allowed = format!("{count} numbers of 0 or more, one for each value, and not all 0");
        let refuse = || self.refuse(&path, field.value, allowed.as_str());
        let items = field.value.get_ref().as_array().filter(|items| items.len() == count);
        let mut sum = 0.0;
        let mut sums = Vec::with_capacity(count);
        for item in items.ok_or_else(refuse)? {
            let weight = match Written::literal(self.text(item), None).value {
                Value::Number(x) => x,
                Value::Whole(i) => i as f64,
                _ => return Err(refuse()),
            };
            if !(weight >= 0.0 && weight.is_finite()) {
                return Err(refuse());
            }
            sum += weight;
            sums.push(sum);
        }
        if sum > 0.0 { Ok(Some(sums)) } else { Err(refuse()) }
    }

    fn normal(
        &self,
        entry: &Entry<'_>,
        fields: &Fields<'_>,
        name: &str,
        value_type: ValueType,
        scale: Scale,
    ) -> Result<Way> {
        let is_log = scale == Scale::Log;
        let (path, list) = (format!("{}.{name}", entry.path), fields[name].value);
        let allowed = if is_log {
            "the median and the relative deviation, such as [\"70 um\", 0.2]"
        } else {
            "the mean and the standard deviation, such as [\"35 um\", \"5 um\"]"
        };
        let items = list.get_ref().as_array().filter(|items| items.len() == 2);
        let items = items.ok_or_else(|| self.refuse(&path, list, allowed))?;
        let centre = self.quantity(&path, &entry.path, &items[0], value_type)?;
        let ratio = ValueType::Quantity(&crate::quantity::RATIO);
        let nature_of_deviation = if is_log { ratio } else { value_type };
        let deviation = self.quantity(&path, &entry.path, &items[1], nature_of_deviation)?;
        if is_log && centre <= 0.0 {
            return Err(self.refuse(&path, &items[0], "more than 0"));
        }
        if deviation <= 0.0 {
            return Err(self.refuse(&path, &items[1], "more than 0"));
        }
        let lowest = if is_log { 0.0 } else { f64::NEG_INFINITY };
        let from = self.number(entry, fields, "from", value_type)?.unwrap_or(lowest);
        let to = self.number(entry, fields, "to", value_type)?.unwrap_or(f64::INFINITY);
        if is_log && from < 0.0 {
            let path = format!("{}.from", entry.path);
            return Err(self.refuse(&path, fields["from"].value, "0 or more, with `lognormal`"));
        }
        self.in_order(entry, fields, from, to)?;
        let away = |x: f64| match scale {
            Scale::Linear => (x - centre) / deviation,
            Scale::Log => (x / centre).ln() / deviation,
        };
        for (end, far) in [("from", away(from) > FAR), ("to", away(to) < -FAR)] {
            if far {
                let allowed = "within three deviations of the mean, or nearly nothing is left";
                let path = format!("{}.{end}", entry.path);
                return Err(self.refuse(&path, fields[end].value, allowed));
            }
        }
        let whole = matches!(value_type, ValueType::Whole);
        Ok(Way::Normal { centre, deviation, limits: [from, to], scale, whole })
    }

    /// Takes a column of a table, and gives the number of its sheet.
    fn column(
        &self,
        entry: &Entry<'_>,
        fields: &Fields<'_>,
        value_type: ValueType,
        sheets: &mut Vec<Sheet>,
    ) -> Result<usize> {
        let name = self.word(fields, "table")?.expect("it is there");
        let column = self.word(fields, "column")?.ok_or_else(|| self.missing(entry, "column"))?;
        let unit = self.word(fields, "unit")?;
        let place = match sheets.iter().position(|sheet| sheet.name == name) {
            Some(place) => place,
            None => {
                let sheet = Sheet::read(&name, self.folder).map_err(|error| {
                    let diagnostic = Diagnostic::new(error.to_string()).hint(error.hint());
                    let diagnostic = diagnostic.key(format!("{}.table", entry.path));
                    diagnostic.at(self.source, fields["table"].value.span())
                })?;
                sheets.push(sheet);
                sheets.len() - 1
            }
        };
        let span = fields["column"].value.span();
        let wanted = Column { key: entry.path.clone(), heading: column, unit, value_type, span };
        sheets[place].take(wanted, self.source)?;
        Ok(place)
    }

    /// Refuses a key that is said twice.
    fn check_once(&self, fixed: &[Entry<'_>], varied: &[Varied]) -> Result<()> {
        let fixed = fixed.iter().map(|entry| (entry.path.as_str(), entry.field.key.clone()));
        let varied = varied.iter().map(|v| (v.parameter.key.as_str(), v.place.clone()));
        let mut said: BTreeMap<&str, Range<usize>> = BTreeMap::new();
        for (path, place) in fixed.chain(varied) {
            if let Some(first) = said.insert(path, place.clone()) {
                let diagnostic = Diagnostic::new(format!("`{path}` is said twice")).key(path);
                return Err(diagnostic.related(first, "here first").at(self.source, place));
            }
        }
        Ok(())
    }
}

/// Whether a table at a path says how a key varies, and does not hold keys itself.
fn is_way(path: &str, table: &DeTable<'_>) -> bool {
    let says = |name: &str| table.get(name).is_some_and(|value| !value.get_ref().is_table());
    names::value_type(path).is_ok() || WAYS.iter().any(|name| says(name))
}

fn varied(entry: &Entry<'_>, kind: Kind, way: Way) -> Varied {
    let parameter = Parameter { key: entry.path.clone(), kind, way };
    Varied { parameter, place: entry.field.key.clone() }
}

fn chosen(entry: &Entry<'_>, choices: Vec<Written>, sums: Option<Vec<f64>>) -> Varied {
    let equal = || (1..=choices.len()).map(|i| i as f64).collect();
    let sums = sums.unwrap_or_else(equal);
    varied(entry, kind_of(&choices), Way::Choice { choices, sums })
}
