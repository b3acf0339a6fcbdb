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

/// The key of the batch's digest in the metadata of a part.
const DIGEST: &str = "frisure.batch";

/// The metadata of a part.
pub(crate) struct PartMetadata {
    /// The digest of its batch.
    pub(crate) digest: String,
    pub(crate) heads: usize,
}

/// The bytes of a part.
pub(crate) fn encode(batch: &Batch, rows: &[Row]) -> Result<Vec<u8>, String> {
    try_encode(batch, rows).map_err(|e| e.to_string())
}

fn try_encode(batch: &Batch, rows: &[Row]) -> Result<Vec<u8>> {
    let columns = columns(batch, rows);
    let fields = columns.iter().map(columns::Column::field).collect::<Result<Vec<_>>>()?;
    let schema = parquet::schema::types::Type::group_type_builder("head").with_fields(fields);
    let metadata = vec![
        KeyValue::new(DIGEST.into(), batch.digest()),
        KeyValue::new("frisure.version".into(), env!("CARGO_PKG_VERSION").to_owned()),
    ];
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(metadata))
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

/// Reads the metadata of a part; an error for another file.
pub(crate) fn read_metadata(path: &Path) -> Result<PartMetadata, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
    let reader = SerializedFileReader::new(file).map_err(|e| e.to_string())?;
    let about = reader.metadata().file_metadata();
    let mut pairs = about.key_value_metadata().into_iter().flatten();
    let digest = pairs.find(|pair| pair.key == DIGEST).and_then(|pair| pair.value.clone());
    let digest = digest.ok_or("it does not say of which batch it is")?;
    let heads = usize::try_from(about.num_rows()).map_err(|e| e.to_string())?;
    Ok(PartMetadata { digest, heads })
}
