//! From tables to numbers by property: of single hairs, of windows along hairs, of groups.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use super::choices::Choices;
use super::error::{MeasurementError, known_headings, per_millimetre};
use super::heading::{Aggregate, Meaning, Name, Property};
use super::sample::{Group, Sample, median, robust_variation};
use super::table::{Row, Table};
use crate::quantity::{Dimension, LENGTH};

/// What fibermorph writes into the names of its samples and files, before the window's length.
const WINDOW: &str = "WindowSize-";

/// What a column is said to be that is to be passed over.
const OTHER: &str = "other";

/// Numbers of one property.
#[derive(Debug, Default)]
struct Numbers {
    hairs: Vec<f64>,
    /// By table and hair.
    windows: BTreeMap<(usize, String), Vec<f64>>,
    groups: Vec<Group>,
}

/// All that tables tell.
#[derive(Debug, Default)]
pub(super) struct Readings {
    numbers: BTreeMap<Property, Numbers>,
    /// What a person should know of how they were read.
    pub(super) notes: Vec<String>,
    /// Whether curvature was read as such, which is done on fragments.
    pub(super) of_fragments: bool,
}

/// What a row is about.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    Window,
    Hair,
    Group,
}

/// A column that tells a property.
struct Column {
    index: usize,
    name: &'static Name,
    /// SI units per unit.
    factor: f64,
    aggregates: Vec<Aggregate>,
}

impl Column {
    fn is_centre(&self) -> bool {
        !self.aggregates.iter().any(|a| matches!(a, Aggregate::Deviation | Aggregate::Other))
    }

    /// Which of several columns of a property is taken: of one hair the median, since windows that
    /// went wrong do not move it; of many hairs the mean, which is what [`Sample`] takes.
    fn rank(&self, level: Level) -> usize {
        let (within, across) = match self.aggregates[..] {
            [] => (None, None),
            [one] if level == Level::Group => (None, Some(one)),
            [one] => (Some(one), None),
            [.., within, across] => (Some(within), Some(across)),
        };
        usize::from(within == Some(Aggregate::Mean))
            + 2 * usize::from(across == Some(Aggregate::Median))
    }
}

/// The columns of a table, understood.
struct Layout {
    columns: Vec<Column>,
    count: Option<usize>,
    hair: Option<usize>,
    level: Level,
    of_fragments: bool,
    /// Headings that say nothing of hair.
    passed_over: Vec<String>,
}

impl Readings {
    pub(super) fn of(tables: &[Table], choices: &Choices) -> Result<Self, MeasurementError> {
        check_columns(tables, choices)?;
        let mut readings = Self::default();
        let window = choices.window.or_else(|| largest_window(tables));
        let mut windows_left_out = false;
        for (index, table) in tables.iter().enumerate() {
            let layout = Layout::of(table, choices)?;
            if !layout.passed_over.is_empty() {
                let columns = layout.passed_over.join("`, `");
                readings.notes.push(format!("Passed over in `{}`: `{columns}`.", table.name()));
            }
            readings.of_fragments |= layout.of_fragments;
            for row in &table.rows {
                let its_window = window_of(table, row);
                if its_window.is_some_and(|w| window.is_some_and(|x| (w / x - 1.0).abs() > 1e-6)) {
                    windows_left_out = true;
                } else if chosen(table, row, &choices.rows) {
                    readings.take(index, table, &layout, row, choices.shape_only)?;
                }
            }
        }
        if let Some(window) = window.filter(|_| windows_left_out) {
            let text = LENGTH.written(window);
            readings.notes.push(format!(
                "Of several lengths of window, {text} is taken (`--window`): shorter ones read more \
                 of the noise."
            ));
        }
        if readings.numbers.is_empty() {
            return Err(MeasurementError::Nothing { known: known_headings() });
        }
        readings.notes.dedup();
        readings.compare_groups();
        Ok(readings)
    }

    /// Groups as different as this are not one head of hair.
    fn compare_groups(&mut self) {
        let Some(curvature) = self.numbers.get(&Property::Curvature) else { return };
        if !curvature.hairs.is_empty() || !curvature.windows.is_empty() {
            return;
        }
        let centres = || curvature.groups.iter().map(|g| g.centre);
        let (least, most) =
            (centres().fold(f64::INFINITY, f64::min), centres().fold(0.0, f64::max));
        if most > 2.0 * least {
            self.notes.push(format!(
                "Rows differ from {} to {} in curvature, and their mean is taken: `--rows` says which are \
                 of one head.",
                per_millimetre(least),
                per_millimetre(most)
            ));
        }
    }

    /// Hairs one by one before groups of them: groups do not tell how hairs differ. Of a hair that is
    /// told by its windows, the median.
    pub(super) fn sample(&self, property: Property) -> Option<Sample> {
        let numbers = self.numbers.get(&property)?;
        if !numbers.hairs.is_empty() {
            return Sample::of(&numbers.hairs);
        }
        if !numbers.windows.is_empty() {
            let hairs: Vec<f64> = numbers.windows.values().map(|w| median(w)).collect();
            return Sample::of(&hairs);
        }
        Sample::of_groups(&numbers.groups)
    }

    /// How much a property varies along a hair, as a fraction of its median: that of the hair in the
    /// middle.
    pub(super) fn variation_along(&self, property: Property) -> Option<(f64, usize)> {
        let windows = self.numbers.get(&property)?.windows.values();
        let each: Vec<f64> = windows.filter_map(|w| robust_variation(w)).collect();
        (!each.is_empty()).then(|| (median(&each), each.len()))
    }

    fn take(
        &mut self,
        index: usize,
        table: &Table,
        layout: &Layout,
        row: &Row,
        shape_only: bool,
    ) -> Result<(), MeasurementError> {
        let mut values = layout.values(table, row)?;
        self.section(table, layout, row, &mut values)?;
        if shape_only {
            values.remove(&Property::Diameter);
        }
        let count = match layout.count {
            Some(column) => match table.number(row, column)? {
                Some(n) if (1.0..1e9).contains(&n) && n.fract() == 0.0 => n as usize,
                None => 1,
                Some(_) => {
                    let allowed = "a whole number of at least 1";
                    return Err(refused(table, row, column, allowed));
                }
            },
            None => 1,
        };
        for (property, (value, deviation)) in values {
            let numbers = self.numbers.entry(property).or_default();
            match layout.level {
                Level::Group => {
                    numbers.groups.push(Group { centre: value, deviation, count });
                }
                Level::Hair => numbers.hairs.push(value),
                Level::Window => {
                    let hair = layout.hair.map_or(String::new(), |c| row.cells[c].clone());
                    numbers.windows.entry((index, hair)).or_default().push(value);
                }
            }
        }
        Ok(())
    }

    /// Diameter and axis ratio in place of whatever told them.
    fn section(
        &mut self,
        table: &Table,
        layout: &Layout,
        row: &Row,
        values: &mut Values,
    ) -> Result<(), MeasurementError> {
        let mut of = |property| values.remove(&property);
        let (short, long) = (of(Property::ShortAxis), of(Property::LongAxis));
        let (area, eccentricity) = (of(Property::Area), of(Property::Eccentricity));
        if let (Some((short, _)), Some((long, _))) = (short, long) {
            if short > long {
                let column = layout.column(Property::ShortAxis);
                return Err(refused(table, row, column, "at most the longer diameter"));
            }
            let ellipse = PI / 4.0 * short * long;
            if let Some((area, _)) = area
                && !(0.8..1.25).contains(&(area / ellipse))
            {
                self.notes.push(format!(
                    "In `{}` areas are not those of ellipses of these diameters (one is {:.1} times as \
                     large): diameters are taken. Are they radii, or in another unit?",
                    table.name(),
                    area / ellipse
                ));
            }
            // What is told outright stands: of groups the ratio of medians is not the median ratio.
            values.entry(Property::Diameter).or_insert(((short * long).sqrt(), None));
            values.entry(Property::AxisRatio).or_insert((long / short, None));
            return Ok(());
        }
        if let Some((area, _)) = area {
            values.entry(Property::Diameter).or_insert(((4.0 * area / PI).sqrt(), None));
        }
        if let Some((eccentricity, _)) = eccentricity {
            let ratio = (1.0 - eccentricity * eccentricity).sqrt().recip();
            values.entry(Property::AxisRatio).or_insert((ratio, None));
        }
        Ok(())
    }
}

/// Of one row: centre and deviation.
type Values = BTreeMap<Property, (f64, Option<f64>)>;

impl Layout {
    fn of(table: &Table, choices: &Choices) -> Result<Self, MeasurementError> {
        let titled = |heading: &String| {
            let renamed = choices.columns.iter().find(|(from, _)| from == heading);
            renamed.map_or(heading.clone(), |(_, title)| title.clone())
        };
        let meanings: Vec<Meaning> =
            table.headings.iter().map(|h| Meaning::of(&titled(h))).collect();
        let has = |text: &str| {
            meanings.iter().any(|m| matches!(m, Meaning::Value { name, .. } if name.is(text)))
        };
        let sections = ["area", "eccentricity", "min", "max"].into_iter().all(has);
        let (mut columns, mut count, mut hair, mut of_fragments) = (Vec::new(), None, None, false);
        let mut passed_over = Vec::new();
        for (index, meaning) in meanings.into_iter().enumerate() {
            match meaning {
                Meaning::Count => count = Some(index),
                Meaning::Hair => hair = Some(index),
                Meaning::Other if table.headings[index].is_empty() => {}
                Meaning::Other => passed_over.push(table.headings[index].clone()),
                Meaning::Value { name, unit, aggregates } => {
                    // fibermorph's columns have no unit: its documentation has.
                    let unit = unit.or_else(|| match () {
                        () if name.is("curv") => Some("1/mm".to_owned()),
                        () if sections && name.is("area") => Some("um^2".to_owned()),
                        () if sections && (name.is("min") || name.is("max")) => Some("um".into()),
                        () => None,
                    });
                    of_fragments |= name.is("curv") || name.is("curvature");
                    let factor = factor(name.dimension, unit.as_deref()).map_err(|problem| {
                        let (path, column) = (table.path.clone(), table.headings[index].clone());
                        let heading = name.example();
                        MeasurementError::Unit { path, column, heading, problem }
                    })?;
                    columns.push(Column { index, name, factor, aggregates });
                }
            }
        }
        for (k, column) in columns.iter().enumerate().filter(|(_, column)| column.is_centre()) {
            let same = |other: &&Column| {
                other.name.property == column.name.property && other.aggregates == column.aggregates
            };
            if let Some(other) = columns[..k].iter().find(same) {
                let heading = |c: &Column| table.headings[c.index].clone();
                let (first, second) = (heading(other), heading(column));
                return Err(MeasurementError::SameColumns {
                    path: table.path.clone(),
                    first,
                    second,
                });
            }
        }
        let spread = columns.iter().any(|c| !c.is_centre());
        let level = match hair {
            _ if count.is_some() || spread => Level::Group,
            Some(hair) if repeats(table, hair) => Level::Window,
            _ => Level::Hair,
        };
        Ok(Self { columns, count, hair, level, of_fragments, passed_over })
    }

    /// Where a property stands.
    fn column(&self, property: Property) -> usize {
        self.columns.iter().find(|c| c.name.property == property).map_or(0, |c| c.index)
    }

    fn values(&self, table: &Table, row: &Row) -> Result<Values, MeasurementError> {
        let mut columns: Vec<&Column> = self.columns.iter().filter(|c| c.is_centre()).collect();
        columns.sort_by_key(|c| c.rank(self.level));
        let mut values = Values::new();
        for column in columns {
            let property = column.name.property;
            if values.contains_key(&property) {
                continue;
            }
            if let Some(value) = value(table, row, column)? {
                let deviation = self.deviation(table, row, column, value)?;
                values.insert(property, (value, deviation));
            }
        }
        Ok(values)
    }

    /// The deviation that goes with a property, in its units.
    fn deviation(
        &self,
        table: &Table,
        row: &Row,
        centre: &Column,
        value: f64,
    ) -> Result<Option<f64>, MeasurementError> {
        let property = centre.name.property;
        let is_its = |c: &&Column| {
            c.name.property == property && c.aggregates.last() == Some(&Aggregate::Deviation)
        };
        let Some(column) = self.columns.iter().find(is_its) else { return Ok(None) };
        let Some(number) = table.number(row, column.index)? else { return Ok(None) };
        if !(number >= 0.0) {
            return Err(refused(table, row, column.index, "at least 0"));
        }
        let deviation = number * column.factor;
        if column.name.keeps_scale() {
            return Ok(Some(column.name.property_of(deviation)));
        }
        // To first order what is 2/x varies by as large a part as x does.
        let told = table.number(row, centre.index)?.unwrap_or(value) * centre.factor;
        Ok(Some(value * deviation / told))
    }
}

/// The property that a cell tells (SI).
fn value(table: &Table, row: &Row, column: &Column) -> Result<Option<f64>, MeasurementError> {
    let Some(number) = table.number(row, column.index)? else { return Ok(None) };
    let value = column.name.property_of(number * column.factor);
    let (least, most) = column.name.property.range();
    if (least..=most).contains(&value) {
        return Ok(Some(value));
    }
    let dimension = column.name.dimension;
    let bounds = [least, most].map(|bound| column.name.number_of(bound));
    let [low, high] = [bounds[0].min(bounds[1]), bounds[0].max(bounds[1])];
    let allowed = match high.is_finite() {
        true => format!("between {} and {}", dimension.written(low), dimension.written(high)),
        false => format!("at least {}", dimension.written(low)),
    };
    Err(refused(table, row, column.index, &allowed))
}

fn refused(table: &Table, row: &Row, column: usize, allowed: &str) -> MeasurementError {
    MeasurementError::Value {
        at: Box::new(table.place(row, column)),
        value: row.cells[column].clone(),
        allowed: allowed.to_owned(),
        hint: "is the unit in the heading right? `--column` says another",
    }
}

/// SI units per unit; a pure number needs none.
fn factor(dimension: &Dimension, unit: Option<&str>) -> Result<f64, String> {
    let example = dimension.units().collect::<Vec<_>>().join(", ");
    match unit {
        None if dimension.si.is_empty() => Ok(1.0),
        None => Err(format!("it has no unit; {} has one of {example}", dimension.name)),
        Some("") if dimension.si.is_empty() => Ok(1.0),
        Some(unit) => dimension.parse(&format!("1 {unit}")).map_err(|_| {
            format!("`{unit}` is not a unit of {}; one of {example} is", dimension.name)
        }),
    }
}

fn repeats(table: &Table, column: usize) -> bool {
    let hairs: BTreeSet<&String> = table.rows.iter().map(|r| &r.cells[column]).collect();
    hairs.len() < table.rows.len()
}

/// The length of the window that a row was measured with, if it or its file says so.
fn window_of(table: &Table, row: &Row) -> Option<f64> {
    let own = row.cells.iter().find_map(|cell| window_in(cell));
    own.or_else(|| window_in(&table.name()))
}

fn window_in(text: &str) -> Option<f64> {
    let (_, after) = text.split_once(WINDOW)?;
    let end = after.find("mm")?;
    after[..end].parse().ok().map(|mm: f64| mm * 1e-3).filter(|w| *w > 0.0 && w.is_finite())
}

fn largest_window(tables: &[Table]) -> Option<f64> {
    let rows = tables.iter().flat_map(|t| t.rows.iter().map(move |r| (t, r)));
    rows.filter_map(|(table, row)| window_of(table, row)).max_by(f64::total_cmp)
}

/// Whether a row has all the values that are asked for, where its table has such a column.
fn chosen(table: &Table, row: &Row, asked: &[(String, String)]) -> bool {
    asked.iter().all(|(heading, pattern)| {
        let column = table.headings.iter().position(|h| h == heading);
        column.is_none_or(|c| matches(&row.cells[c], pattern))
    })
}

/// The whole text, or what stands before or after a star.
fn matches(text: &str, pattern: &str) -> bool {
    match pattern.split_once('*') {
        Some((start, end)) => {
            text.len() >= start.len() + end.len() && text.starts_with(start) && text.ends_with(end)
        }
        None => text == pattern,
    }
}

/// Columns that are asked for have to be there, and what they are said to be has to mean something.
fn check_columns(tables: &[Table], choices: &Choices) -> Result<(), MeasurementError> {
    let known = || {
        let all = tables.iter().flat_map(|t| &t.headings).filter(|h| !h.is_empty());
        let all: BTreeSet<String> = all.cloned().collect();
        all.into_iter().collect::<Vec<_>>().join(", ")
    };
    let asked = choices.columns.iter().chain(&choices.rows).map(|(heading, _)| heading);
    for column in asked {
        if !tables.iter().any(|t| t.headings.contains(column)) {
            return Err(MeasurementError::NoColumn { column: column.clone(), known: known() });
        }
    }
    let meant = |title: &String| title != OTHER && matches!(Meaning::of(title), Meaning::Other);
    if let Some((_, title)) = choices.columns.iter().find(|(_, title)| meant(title)) {
        let (title, known) = (title.clone(), known_headings());
        return Err(MeasurementError::NoMeaning { title, known });
    }
    for (heading, pattern) in &choices.rows {
        let of = |t: &Table| t.headings.iter().position(|h| h == heading);
        let some = tables.iter().any(|t| {
            of(t).is_some_and(|c| t.rows.iter().any(|row| matches(&row.cells[c], pattern)))
        });
        if !some {
            let (column, value) = (heading.clone(), pattern.clone());
            return Err(MeasurementError::NoRows { column, value });
        }
    }
    Ok(())
}
