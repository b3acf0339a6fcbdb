//! Columns of values, and how they are written.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int32Type, Int64Type,
};
use parquet::errors::Result;
use parquet::file::writer::SerializedColumnWriter;
use parquet::schema::types::{Type, TypePtr};

/// One column, with a value for each row.
pub(super) struct Column {
    pub(super) name: String,
    pub(super) values: Values,
}

/// Values; failed rows have none.
pub(super) enum Values {
    Whole(Vec<Option<i64>>),
    Count(Vec<Option<i32>>),
    Number(Vec<Option<f64>>),
    Flag(Vec<Option<bool>>),
    Text(Vec<Option<String>>),
    /// A picture or a map in each row.
    Bytes(Vec<Option<ByteArray>>),
    /// A list of numbers in each row.
    Lists(Vec<Option<Vec<f32>>>),
    /// The same in double precision.
    Doubles(Vec<Option<Vec<f64>>>),
}

impl Column {
    /// Its entry in the schema.
    pub(super) fn field(&self) -> Result<TypePtr> {
        let plain = |name: &str, kind: Physical, repetition: Repetition| {
            let text = matches!(self.values, Values::Text(_)).then_some(LogicalType::String);
            let builder = Type::primitive_type_builder(name, kind).with_repetition(repetition);
            builder.with_logical_type(text).build().map(Arc::new)
        };
        let kind = match self.values {
            Values::Whole(_) => Physical::INT64,
            Values::Count(_) => Physical::INT32,
            Values::Number(_) => Physical::DOUBLE,
            Values::Flag(_) => Physical::BOOLEAN,
            Values::Text(_) | Values::Bytes(_) => Physical::BYTE_ARRAY,
            Values::Lists(_) | Values::Doubles(_) => {
                let single = matches!(self.values, Values::Lists(_));
                let number = if single { Physical::FLOAT } else { Physical::DOUBLE };
                // The three levels that the format prescribes for lists.
                let element = plain("element", number, Repetition::REQUIRED)?;
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
            Values::Bytes(values) => write_values::<ByteArrayType, _>(writer, values, Clone::clone),
            Values::Lists(lists) => write_lists::<FloatType>(writer, lists),
            Values::Doubles(lists) => write_lists::<DoubleType>(writer, lists),
        }
    }
}

/// Writes the lists of the rows that have one.
fn write_lists<D: DataType>(
    writer: &mut SerializedColumnWriter<'_>,
    lists: &[Option<Vec<D::T>>],
) -> Result<()> {
    let (values, defined, repeated) = flattened(lists);
    let writer = writer.typed::<D>();
    writer.write_batch(&values, Some(&defined), Some(&repeated)).map(drop)
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
fn flattened<T: Clone>(lists: &[Option<Vec<T>>]) -> (Vec<T>, Vec<i16>, Vec<i16>) {
    let (mut defined, mut repeated) = (Vec::new(), Vec::new());
    for list in lists {
        let length = list.as_ref().map_or(0, Vec::len);
        let level = if list.is_some() { 1 } else { 0 };
        defined.extend(if length == 0 { vec![level] } else { vec![2; length] });
        repeated.push(0);
        repeated.extend(std::iter::repeat_n(1, length.saturating_sub(1)));
    }
    (lists.iter().flatten().flatten().cloned().collect(), defined, repeated)
}
