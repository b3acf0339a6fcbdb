//! The columns of a part, and their values.

use frisure::scene::batch::{Batch, Kind, Value};

use super::column::{Column, Values};
use crate::row::{Measured, Row};

/// All columns of some rows.
pub(super) fn columns(batch: &Batch, rows: &[Row]) -> Vec<Column> {
    let mut all = vec![
        whole("index", rows, |row| Some(row.index as i64)),
        text("status", rows, |row| Some(if row.outcome.is_ok() { "ok" } else { "failed" }.into())),
        text("error", rows, |row| row.outcome.as_ref().err().cloned()),
        whole("seed", rows, |row| i64::try_from(row.seed).ok()),
    ];
    let varied = batch.parameters().enumerate().filter(|(_, (key, _))| *key != "seed");
    all.extend(varied.map(|(place, (key, kind))| parameter(key, kind, rows, place)));
    all.extend(measured(rows));
    all.push(text("scene", rows, |row| row.scene.clone()));
    all
}

fn measured(rows: &[Row]) -> Vec<Column> {
    let count = |name: &str, of: fn(&Measured) -> usize| {
        let values = rows.iter().map(|row| row.outcome.as_ref().ok().map(of));
        let values = values.map(|n| n.and_then(|n| i32::try_from(n).ok())).collect();
        Column { name: name.into(), values: Values::Count(values) }
    };
    let number = |name: &str, of: fn(&Measured) -> Option<f64>| {
        let values = rows.iter().map(|row| row.outcome.as_ref().ok().and_then(of)).collect();
        Column { name: name.into(), values: Values::Number(values) }
    };
    let lines = rows.iter().map(|row| row.outcome.as_ref().ok().map(|m| m.lines.clone()));
    vec![
        count("guide_count", |m| m.metrics.settling.guides),
        count("guides_stable", |m| m.metrics.settling.stable),
        count("guides_saddle", |m| m.metrics.settling.saddles),
        count("guides_undecided", |m| m.metrics.settling.undecided),
        count("guides_not_converged", |m| m.metrics.settling.not_converged),
        count("guides_accuracy_missed", |m| m.metrics.settling.accuracy_missed),
        number("length", |m| Some(m.metrics.length)),
        number("drop", |m| Some(m.metrics.drop)),
        number("penetration", |m| Some(m.metrics.settling.penetration)),
        number("energy_elastic", |m| Some(m.metrics.settling.energy.elastic)),
        number("energy_gravity", |m| Some(m.metrics.settling.energy.gravity)),
        number("energy_contact", |m| Some(m.metrics.settling.energy.external)),
        number("mass", |m| Some(m.metrics.mass)),
        number("volume", |m| m.volume.map(|v| v[0])),
        number("fibre_volume", |m| m.volume.map(|v| v[1])),
        count("guide_points", |m| m.points),
        Column { name: "guides".into(), values: Values::Lists(lines.collect()) },
    ]
}

fn whole(name: &str, rows: &[Row], of: impl Fn(&Row) -> Option<i64>) -> Column {
    Column { name: name.into(), values: Values::Whole(rows.iter().map(of).collect()) }
}

fn text(name: &str, rows: &[Row], of: impl Fn(&Row) -> Option<String>) -> Column {
    Column { name: name.into(), values: Values::Text(rows.iter().map(of).collect()) }
}

/// The column of a key that varies.
fn parameter(key: &str, kind: Kind, rows: &[Row], place: usize) -> Column {
    let values = || rows.iter().map(|row| row.values.get(place));
    let values = match kind {
        Kind::Number => Values::Number(
            values()
                .map(|v| if let Some(Value::Number(x)) = v { Some(*x) } else { None })
                .collect(),
        ),
        Kind::Whole => Values::Whole(
            values().map(|v| if let Some(Value::Whole(i)) = v { Some(*i) } else { None }).collect(),
        ),
        Kind::Flag => Values::Flag(
            values().map(|v| if let Some(Value::Flag(f)) = v { Some(*f) } else { None }).collect(),
        ),
        Kind::Text => Values::Text(
            values()
                .map(|v| if let Some(Value::Text(t)) = v { Some(t.clone()) } else { None })
                .collect(),
        ),
    };
    Column { name: key.into(), values }
}
