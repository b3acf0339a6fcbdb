//! The columns of a part, and their values.

use std::sync::Arc;

use frisure::scene::batch::{Batch, Kind, Value};
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{
    BoolType, ByteArrayType, DataType, DoubleType, FloatType, Int32Type, Int64Type,
};
use parquet::errors::Result;
use parquet::file::writer::SerializedColumnWriter;
use parquet::schema::types::{Type, TypePtr};

use crate::head::{Measured, Row};

/// One column, with a value for each row.
pub(super) struct Column {
    name: String,
    values: Values,
}

/// Values; failed rows have none.
enum Values {
    Whole(Vec<Option<i64>>),
    Count(Vec<Option<i32>>),
    Number(Vec<Option<f64>>),
    Flag(Vec<Option<bool>>),
    Text(Vec<Option<String>>),
    /// A list of numbers in each row.
    Lists(Vec<Option<Vec<f32>>>),
}

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

impl Column {
    /// Its entry in the schema.
    pub(super) fn field(&self) -> Result<TypePtr> {
        let plain = |name: &str, kind: Physical, repetition: Repetition| {
            let text = (kind == Physical::BYTE_ARRAY).then_some(LogicalType::String);
            let builder = Type::primitive_type_builder(name, kind).with_repetition(repetition);
            builder.with_logical_type(text).build().map(Arc::new)
        };
        let kind = match self.values {
            Values::Whole(_) => Physical::INT64,
            Values::Count(_) => Physical::INT32,
            Values::Number(_) => Physical::DOUBLE,
            Values::Flag(_) => Physical::BOOLEAN,
            Values::Text(_) => Physical::BYTE_ARRAY,
            Values::Lists(_) => {
                // The three levels that the format prescribes for lists.
                let element = plain("element", Physical::FLOAT, Repetition::REQUIRED)?;
                let list = Type::group_type_builder("list")
                    .with_repetition(Repetition::REPEATED)
                    .with_fields(vec![element]);
                let whole = Type::group_type_builder(&self.name)
                    .with_repetition(Repetition::OPTIONAL)
                    .with_logical_type(Some(LogicalType::List))
                    .with_fields(vec![Arc::new(list.build()?)]);
                return whole.build().map(Arc::new);
            }
        };
        plain(&self.name, kind, Repetition::OPTIONAL)
    }

    /// Writes all values.
    pub(super) fn write(&self, writer: &mut SerializedColumnWriter<'_>) -> Result<()> {
        match &self.values {
            Values::Whole(values) => write_values::<Int64Type, _>(writer, values, |x| *x),
            Values::Count(values) => write_values::<Int32Type, _>(writer, values, |x| *x),
            Values::Number(values) => write_values::<DoubleType, _>(writer, values, |x| *x),
            Values::Flag(values) => write_values::<BoolType, _>(writer, values, |x| *x),
            Values::Text(values) => {
                write_values::<ByteArrayType, _>(writer, values, |text| text.as_str().into())
            }
            Values::Lists(lists) => {
                let (values, defined, repeated) = flattened(lists);
                let writer = writer.typed::<FloatType>();
                writer.write_batch(&values, Some(&defined), Some(&repeated)).map(drop)
            }
        }
    }
}

/// Writes the values of the rows that have one.
fn write_values<D: DataType, T>(
    writer: &mut SerializedColumnWriter<'_>,
    values: &[Option<T>],
    of: impl Fn(&T) -> D::T,
) -> Result<()> {
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let present: Vec<D::T> = values.iter().flatten().map(of).collect();
    writer.typed::<D>().write_batch(&present, Some(&levels), None).map(drop)
}

/// Lists one after the other, with the definition levels of Dremel (0 no list, 1 an empty one, 2 a value) and its
/// repetition levels (1 continues a list, 0 begins another).
fn flattened(lists: &[Option<Vec<f32>>]) -> (Vec<f32>, Vec<i16>, Vec<i16>) {
    let (mut defined, mut repeated) = (Vec::new(), Vec::new());
    for list in lists {
        let length = list.as_ref().map_or(0, Vec::len);
        let level = if list.is_some() { 1 } else { 0 };
        defined.extend(if length == 0 { vec![level] } else { vec![2; length] });
        repeated.push(0);
        repeated.extend(std::iter::repeat_n(1, length.saturating_sub(1)));
    }
    (lists.iter().flatten().flatten().copied().collect(), defined, repeated)
}
