//! Reading the description of a batch.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

use super::heads::{Batch, MOST_HEADS};
use super::names;
use super::sheet::Sheet;
use super::table::{Field, Table, join};
use super::variation::{self, Entry, Varied};
use super::views;
use super::way::{Parameter, Way, Written, kind_of};
use crate::error::{Diagnostic, Result, SceneError};
use crate::scene::Scene;
use crate::source::Source;

/// Keys of a batch.
const KEYS: [&str; 11] = [
    "scene",
    "samples",
    "seed",
    "same_seed",
    "rows",
    "points",
    "volume",
    "views",
    "set",
    "grid",
    "vary",
];

/// Reads a description; paths are relative to `folder`, and the ends of its ranges are not tried.
pub(super) fn batch(source: Source, folder: &Path) -> Result<Batch> {
    let document = source.document()?;
    let table = Table::read(&source, document.get_ref(), "", &KEYS)?;
    let (base, scene_folder) = base(&table, &source, folder)?;
    let fixed = entries(&table, "set", &source, |_, _| false)?;
    fixed.iter().try_for_each(|entry| entry.value_type(&source).map(drop))?;
    let grid = entries(&table, "grid", &source, varies)?;
    let grid: Vec<Varied> = grid.iter().map(|e| e.on_grid(&source)).collect::<Result<_>>()?;
    let (drawn, sheets) = drawn(&table, &source, folder)?;
    let samples = samples(&table, &source, !grid.is_empty())?;
    let parameters: Vec<Varied> = grid.into_iter().chain(drawn).collect();
    check_once(&fixed, &parameters, &source)?;
    let batch = Batch {
        seed: table.whole("seed", 0, i64::MAX)?.unwrap_or(1) as u64,
        same_seed: table.flag("same_seed")?.unwrap_or(false),
        samples,
        rows: table.whole("rows", 1, 100_000)?.unwrap_or(16) as usize,
        points: table.whole("points", 2, 10_000)?.map(|points| points as usize),
        volume: table.flag("volume")?.unwrap_or(true),
        views: views::views(&table, &source)?,
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
        let place = table.field("grid").or(table.field("samples"));
        let span = place.map_or(0..0, |field| field.key.clone());
        return Err(Diagnostic::new(problem)
            .hint("a grid is the product of all its lists")
            .at(&source, span));
    }
    Ok(batch)
}

/// The scene, and its folder.
fn base(table: &Table<'_>, source: &Source, folder: &Path) -> Result<(Scene, PathBuf)> {
    let Some(name) = table.word("scene")? else {
        return Ok((Scene::parse("scene", "", folder)?, folder.into()));
    };
    let path = folder.join(&name);
    let scene = Scene::read(&path).map_err(|error| match error {
        SceneError::Read(error) => {
            let diagnostic = Diagnostic::new(error.to_string()).key("scene").value(name.as_str());
            let hint = "the scene's path is relative to the batch";
            diagnostic.hint(hint).at(source, table.span("scene"))
        }
        error => error,
    })?;
    scene.hairstyle_spec()?;
    let folder = path.parent().unwrap_or(Path::new("")).into();
    Ok((scene, folder))
}

fn samples(table: &Table<'_>, source: &Source, has_grid: bool) -> Result<usize> {
    let most = i64::try_from(MOST_HEADS).unwrap_or(i64::MAX);
    match table.whole("samples", 1, most)? {
        Some(samples) => Ok(samples as usize),
        None if has_grid => Ok(1),
        None => {
            let hint =
                "`samples = 1000` at the top is a thousand heads; only a `[grid]` needs none";
            let missing = Diagnostic::new("`samples` is missing").key("samples");
            Err(missing.hint(hint).at(source, 0..0))
        }
    }
}

/// The keys of the scene in one of the tables, in the order of the text. `is_value` returns whether a table
/// at a path is a value.
fn entries<'a>(
    table: &Table<'a>,
    name: &str,
    source: &Source,
    is_value: fn(&str, &DeTable<'_>) -> bool,
) -> Result<Vec<Entry<'a>>> {
    let Some(field) = table.field(name) else { return Ok(Vec::new()) };
    let keys = field.value.get_ref().as_table().ok_or_else(|| table.refuse(name, "a table"))?;
    let mut found = Vec::new();
    flatten(keys, "", source, is_value, &mut found);
    found.sort_by_key(|entry| entry.field.key.start);
    Ok(found)
}

fn flatten<'a>(
    table: &'a DeTable<'a>,
    path: &str,
    source: &Source,
    is_value: fn(&str, &DeTable<'_>) -> bool,
    found: &mut Vec<Entry<'a>>,
) {
    for (key, value) in table {
        let path = join(path, key.get_ref());
        match value.get_ref() {
            DeValue::Table(inner) if !is_value(&path, inner) => {
                flatten(inner, &path, source, is_value, found);
            }
            _ => {
                let text = source.slice(value.span()).to_owned();
                found.push(Entry { path, text, field: Field { key: key.span(), value } });
            }
        }
    }
}

/// Whether a table at a path says how a key varies, and does not hold keys itself.
fn varies(path: &str, table: &DeTable<'_>) -> bool {
    let says = |name: &str| table.get(name).is_some_and(|value| !value.get_ref().is_table());
    names::value_type(path).is_ok() || variation::KEYS.iter().any(|name| says(name))
}

/// The keys that are drawn, and the tables that they are columns of.
fn drawn(table: &Table<'_>, source: &Source, folder: &Path) -> Result<(Vec<Varied>, Vec<Sheet>)> {
    let mut sheets: Vec<Sheet> = Vec::new();
    let entries = entries(table, "vary", source, varies)?;
    let drawn = entries.iter().map(|entry| entry.drawn(source, folder, &mut sheets));
    let mut all: Vec<Varied> = drawn.collect::<Result<_>>()?;
    for sheet in &mut sheets {
        for (key, cells) in sheet.settle(source)? {
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

/// Refuses a key that is given twice.
fn check_once(fixed: &[Entry<'_>], varied: &[Varied], source: &Source) -> Result<()> {
    let fixed = fixed.iter().map(|entry| (entry.path.as_str(), entry.field.key.clone()));
    let varied = varied.iter().map(|v| (v.parameter.key.as_str(), v.place.clone()));
    let mut given: BTreeMap<&str, Range<usize>> = BTreeMap::new();
    for (path, place) in fixed.chain(varied) {
        if let Some(first) = given.insert(path, place.clone()) {
            let twice = Diagnostic::new(format!("`{path}` is said twice")).key(path);
            return Err(twice.related(first, "here first").at(source, place));
        }
    }
    Ok(())
}
