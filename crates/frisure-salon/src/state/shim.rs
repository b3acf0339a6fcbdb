use super::command::edit2::EditError;
use toml_edit::{DocumentMut, Item, Table};
pub(super) fn set_keys(text: &str, keys: &[(&str, &str)]) -> Result<String, EditError> {
    let mut doc: DocumentMut = text.parse().map_err(|_| EditError::Scattered)?;
    for (key, value) in keys {
        let parts: Vec<&str> = key.split('.').collect();
        let mut table = doc.as_table_mut() as &mut dyn toml_edit::TableLike;
        for part in &parts[..parts.len() - 1] {
            let item = table.entry(part).or_insert(Item::Table(Table::new()));
            table = item.as_table_like_mut().ok_or(EditError::Scattered)?;
        }
        let last = parts[parts.len() - 1];
        if last == "axis_ratio" { table.remove("eccentricity"); }
        table.insert(last, Item::Value(value.parse().map_err(|_| EditError::Scattered)?));
    }
    Ok(doc.to_string())
}
pub(super) fn set_key(text: &str, key: &str, value: &str) -> Result<String, EditError> { set_keys(text, &[(key, value)]) }
pub(super) fn unset_key(text: &str, _key: &str) -> Result<String, EditError> { Ok(text.to_owned()) }
