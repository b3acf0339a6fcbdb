//! Parts as Parquet: one row a head, and one a view of it. `docs/batch.md` describes the columns.

mod column;
mod heads;
mod views;

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use bytes::Bytes;
use frisure::scene::batch::{Batch, Views};
use parquet::basic::{Compression, GzipLevel};
use parquet::column::writer::ColumnCloseResult;
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesBuilder};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use crate::row::{Row, StoredView};
use column::Column;

/// The key of the batch's digest in the metadata of a part.
const DIGEST: &str = "frisure.batch";

/// The key of the number of heads in the metadata of a file of views, which has no rows of heads that failed.
const HEADS: &str = "frisure.heads";

/// The metadata of a part.
pub(crate) struct PartMetadata {
    /// The digest of its batch.
    pub(crate) digest: String,
    pub(crate) heads: usize,
}

/// The bytes of a part.
pub(crate) fn encode(batch: &Batch, rows: &[Row]) -> Result<Vec<u8>, String> {
    let properties = WriterProperties::builder().set_compression(Compression::SNAPPY);
    let properties = properties.set_key_value_metadata(Some(about(batch)));
    write(&heads::columns(batch, rows), properties).map_err(|e| e.to_string())
}

/// The names of the columns of a part.
pub(crate) fn column_names(batch: &Batch) -> Vec<String> {
    heads::columns(batch, &[]).into_iter().map(|column| column.name).collect()
}

/// What every file says of its batch.
fn about(batch: &Batch) -> Vec<KeyValue> {
    vec![
        KeyValue::new(DIGEST.into(), batch.digest()),
        KeyValue::new("frisure.version".into(), env!("CARGO_PKG_VERSION").to_owned()),
    ]
}

/// The schema of some columns.
fn schema(columns: &[Column]) -> Result<TypePtr> {
    let fields = columns.iter().map(Column::field).collect::<Result<Vec<_>>>()?;
    Type::group_type_builder("head").with_fields(fields).build().map(Arc::new)
}

/// A file of one group of rows.
fn write(columns: &[Column], properties: WriterPropertiesBuilder) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut file =
        SerializedFileWriter::new(&mut bytes, schema(columns)?, Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    for column in columns {
        let mut writer = group.next_column()?.expect("as many columns as the schema has");
        column.write(&mut writer)?;
        writer.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(bytes)
}

/// The views of the head of an index, as a file of one group of rows.
pub(crate) fn encode_views(
    index: usize,
    views: &Views,
    stored: &[StoredView],
) -> Result<Bytes, String> {
    let mut properties = WriterProperties::builder();
    for output in &views.outputs {
        let column = parquet::schema::types::ColumnPath::from(output.name());
        let compression = match views::is_png(*output) {
            true => Compression::UNCOMPRESSED,
            false => Compression::GZIP(GzipLevel::default()),
        };
        // Pictures have no order and do not repeat.
        properties = properties
            .set_column_compression(column.clone(), compression)
            .set_column_dictionary_enabled(column.clone(), false)
            .set_column_statistics_enabled(column, EnabledStatistics::None);
    }
    let bytes = write(&views::columns(index, views, stored), properties);
    bytes.map(Bytes::from).map_err(|e| e.to_string())
}

/// The file of the views of some heads, one group of rows for each head that has not failed.
pub(crate) fn join_views(batch: &Batch, views: &Views, rows: &[Row]) -> Result<Vec<u8>, String> {
    try_join_views(batch, views, rows).map_err(|e| e.to_string())
}

fn try_join_views(batch: &Batch, views: &Views, rows: &[Row]) -> Result<Vec<u8>> {
    let mut about = about(batch);
    about.push(KeyValue::new(HEADS.into(), rows.len().to_string()));
    let properties = WriterProperties::builder().set_key_value_metadata(Some(about)).build();
    let mut bytes = Vec::new();
    let schema = schema(&views::columns(0, views, &[]))?;
    let mut file = SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties))?;
    for head in rows.iter().filter_map(|row| row.outcome.as_ref().ok()) {
        let reader = SerializedFileReader::new(head.views.clone())?;
        for from in reader.metadata().row_groups() {
            let mut group = file.next_row_group()?;
            for column in from.columns() {
                let encoded = ColumnCloseResult {
                    bytes_written: column.compressed_size() as u64,
                    rows_written: from.num_rows() as u64,
                    metadata: column.clone(),
                    bloom_filter: None,
                    column_index: None,
                    offset_index: None,
                };
                group.append_column(&head.views, encoded)?;
            }
            group.close()?;
        }
    }
    file.close()?;
    Ok(bytes)
}

/// Reads the metadata of a part or of its views; an error for another file.
pub(crate) fn read_metadata(path: &Path) -> Result<PartMetadata, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
    let reader = SerializedFileReader::new(file).map_err(|e| e.to_string())?;
    let about = reader.metadata().file_metadata();
    let pairs = || about.key_value_metadata().into_iter().flatten();
    let value = |key: &str| pairs().find(|pair| pair.key == key).and_then(|p| p.value.clone());
    let digest = value(DIGEST).ok_or("it does not say of which batch it is")?;
    let said = value(HEADS).and_then(|heads| heads.parse().ok());
    let heads = said.or_else(|| usize::try_from(about.num_rows()).ok());
    Ok(PartMetadata { digest, heads: heads.ok_or("it has no number of heads")? })
}
