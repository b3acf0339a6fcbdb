//! The paths of a scene, rewritten for another folder.

use std::iter;
use std::path::{Component, Path, PathBuf};

use toml_edit::{DocumentMut, Value};

use super::{EditError, set_keys};
use crate::key_groups::PATHS;

/// The text of a scene in the folder `from` as it names the same files from the folder `to`: paths of files in or near `to` are relative to it,
/// others absolute. Both folders are absolute; of others the text stays as it is. What does not change keeps its bytes.
///
/// # Errors
/// [`EditError`], if the text is no TOML or a path cannot be replaced in it.
pub fn in_folder(text: &str, from: &Path, to: &Path) -> Result<String, EditError> {
    let Ok(table) = text.parse::<DocumentMut>() else {
        return set_keys(text, &[]);
    };
    let moved = PATHS.iter().filter_map(|key| {
        let item = key.split('.').try_fold(table.as_item(), |item, part| item.get(part))?;
        let whole = normalized(&from.join(item.as_str()?));
        let from_there = relative_path(to, &whole).or_else(|| whole.to_str().map(str::to_owned))?;
        let other = whole.is_absolute() && item.as_str() != Some(&from_there);
        other.then(|| (*key, Value::from(from_there).to_string()))
    });
    let moved: Vec<_> = moved.collect();
    let keys: Vec<_> = moved.iter().map(|(key, value)| (*key, Some(value.as_str()))).collect();
    if keys.is_empty() { Ok(text.to_owned()) } else { set_keys(text, &keys) }
}

/// The relative path from a folder to a file in it, or in a folder at most two levels up; both are absolute paths.
#[must_use]
pub fn relative_path(folder: &Path, file: &Path) -> Option<String> {
    if !folder.is_absolute() || !file.is_absolute() {
        return None;
    }
    let ups = folder.ancestors().take(3).position(|above| file.starts_with(above))?;
    let above = folder.ancestors().nth(ups)?;
    // Relative to the root of the file system, an absolute path is clearer.
    above.parent().filter(|_| ups == 0 || above.components().count() > 2)?;
    let inside = file.strip_prefix(above).ok()?;
    let parts = inside.components().map(|part| match part {
        Component::Normal(name) => name.to_str(),
        _ => None,
    });
    let parts: Option<Vec<&str>> = parts.collect();
    Some(iter::repeat_n("..", ups).chain(parts?).collect::<Vec<_>>().join("/"))
}

/// A path without `..`.
fn normalized(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut all, part| {
        match part {
            Component::ParentDir => drop(all.pop()),
            part => all.push(part),
        }
        all
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_names_its_files_from_any_folder() {
        let text = "seed = 1 # kept\n[head]\nmesh = \"heads/a.obj\" # a mesh\n[groom]\nfile = \"/far/b.hair\"\n";
        let moved =
            |to: &str| in_folder(text, Path::new("/home/me/scenes"), Path::new(to)).unwrap();
        assert_eq!(moved("/home/me/scenes"), text);
        assert!(moved("/home/me/scenes/new").contains("mesh = \"../heads/a.obj\" # a mesh"));
        assert!(moved("/home/me").contains("mesh = \"scenes/heads/a.obj\""));
        assert!(moved("/srv/x").contains("mesh = \"/home/me/scenes/heads/a.obj\""));
        assert!(
            moved("/srv/x").contains("file = \"/far/b.hair\"")
                && moved("/srv/x").contains("# kept")
        );
    }
}
