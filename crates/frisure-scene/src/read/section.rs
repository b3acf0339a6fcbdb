//! Reading `[[section]]`: named parts of the hair for the salon.

use crate::document::Document;
use crate::error::Result;
use crate::kind::{Flag, Text};
use crate::operation::Where;
use crate::scene::Section;

/// Most sections: a list that a person works with. A guard on time.
const MAX_SECTIONS: usize = 200;

/// Longest name of a section (letters), which a list shows in one line.
const MAX_NAME: usize = 60;

/// The sections, in their order.
pub(super) fn sections(document: &Document<'_>) -> Result<Vec<Section>> {
    let count = document.count_items("section");
    let hint =
        "one section can have several parts of the scalp, as in `where = [\"top\", \"nape\"]`";
    document.check_items("section", MAX_SECTIONS, "sections", hint)?;
    let mut sections: Vec<Section> = Vec::with_capacity(count);
    for i in 0..count {
        let section = section(document, &format!("section[{i}]"))?;
        if let Some(other) = sections.iter().position(|other| other.name == section.name) {
            let problem = format!("`section[{other}]` has the same name");
            let hint = "give each section a name of its own";
            return Err(document.error(&format!("section[{i}].name"), problem, hint));
        }
        sections.push(section);
    }
    Ok(sections)
}

fn section(document: &Document<'_>, table: &str) -> Result<Section> {
    let path = |key: &str| format!("{table}.{key}");
    let Some(name) = document.get::<Text>(&path("name"))? else {
        let hint = "add `name = \"left side\"`, or another name";
        return Err(document.error(table, format!("`{table}` has no name"), hint));
    };
    if name.trim().is_empty() || name.chars().count() > MAX_NAME {
        return Err(document.outside(&path("name"), &format!("1 to {MAX_NAME} letters")));
    }
    let Some(selection) = document.get::<Where>(&path("where"))? else {
        let hint =
            "add `where = \"left\"`, another part of the scalp, or `where = { wisps = [0, 1] }`";
        return Err(document.error(table, format!("`{table}` is nowhere"), hint));
    };
    let flag = |key: &str| document.get_or::<Flag>(&path(key), false);
    Ok(Section { name, selection, hidden: flag("hidden")?, locked: flag("locked")? })
}
