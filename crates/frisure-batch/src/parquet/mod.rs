//! Parts as Parquet: one row a head. `docs/batch.md` describes the columns.

mod columns;

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use frisure::scene::batch::Batch;
use parquet::basic::Compression;
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;

use crate::head::Row;
use columns::columns;

/// Under which name a part tells of which batch it is.
const DIGEST: &str = "frisure.batch";

/// What a part tells of itself.
pub(crate) struct Found {
    /// Of its batch.
    pub(crate) digest: String,
    pub(crate) heads: usize,
}

/// The bytes of a part.
pub(crate) fn encode(batch: &Batch, rows: &[Row]) -> Result<Vec<u8>, String> {
    written(batch, rows).map_err(|e| e.to_string())
}

fn written(batch: &Batch, rows: &[Row]) -> Result<Vec<u8>> {
    let columns = columns(batch, rows);
    let fields = columns.iter().map(columns::Column::field).collect::<Result<Vec<_>>>()?;
    let schema = parquet::schema::types::Type::group_type_builder("head").with_fields(fields);
    let told = vec![
        KeyValue::new(DIGEST.into(), batch.digest()),
        KeyValue::new("frisure.version".into(), env!("CARGO_PKG_VERSION").to_owned()),
    ];
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(told))
        .build();
    let mut bytes = Vec::new();
    let mut file =
        SerializedFileWriter::new(&mut bytes, Arc::new(schema.build()?), Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    for column in &columns {
        let mut writer = group.next_column()?.expect("as many columns as the schema has");
        column.write(&mut writer)?;
        writer.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(bytes)
}

/// What a file tells of itself, if it is a part.
pub(crate) fn find(path: &Path) -> Result<Found, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
    let reader = SerializedFileReader::new(file).map_err(|e| e.to_string())?;
    let about = reader.metadata().file_metadata();
    let told = about.key_value_metadata().into_iter().flatten();
    let digest = told.filter(|told| told.key == DIGEST).find_map(|told| told.value.clone());
    let digest = digest.ok_or("it does not say of which batch it is")?;
    let heads = usize::try_from(about.num_rows()).map_err(|e| e.to_string())?;
    Ok(Found { digest, heads })
}
