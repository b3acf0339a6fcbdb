//! The hair that the next step applies to.

use frisure::hairstyle::Place;
use frisure::hairstyle::head::Region;
use frisure::hairstyle::styling::Selection;

use crate::locale::tr;

/// The combination of a new selection with the current one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SelectMode {
    /// The new one replaces it.
    #[default]
    Replace,
    /// The new one is added.
    Add,
    /// The new one is removed.
    Remove,
}

/// Parts of the scalp, with the messages that name them; their attribute `selected` is the name within a sentence.
pub const PLACES: [(&str, Place); 8] = [
    ("place-fringe", Place::Region(Region::Fringe)),
    ("place-top", Place::Region(Region::Top)),
    ("place-crown", Place::Region(Region::Crown)),
    ("place-sides", Place::Region(Region::Sides)),
    ("place-back", Place::Region(Region::Back)),
    ("place-nape", Place::Region(Region::Nape)),
    ("place-left", Place::Left),
    ("place-right", Place::Right),
];

/// A selection, and the wisps that it covers.
#[derive(Clone, Debug, PartialEq)]
pub struct Selected {
    /// The selection as steps store it.
    pub selection: Selection,
    /// Its name, such as "fringe".
    pub label: String,
    /// Whether each wisp is selected; `None` until this is computed.
    pub wisps: Option<Vec<bool>>,
}

impl Default for Selected {
    fn default() -> Self {
        Self { selection: Selection::Everything, label: tr!("all-hair"), wisps: None }
    }
}

impl Selected {
    /// Whether it covers all hair.
    #[must_use]
    pub fn is_everything(&self) -> bool {
        self.selection == Selection::Everything
    }

    /// The combination with a new selection.
    #[must_use]
    pub fn with(&self, new: Selection, label: &str, mode: SelectMode) -> Self {
        let old = self.selection.clone();
        let (selection, label) = match mode {
            SelectMode::Add if !self.is_everything() => {
                (joined(old, new), tr!("selected-and", first = &*self.label, second = label))
            }
            SelectMode::Replace | SelectMode::Add => (new, label.to_owned()),
            SelectMode::Remove => {
                let not = Selection::Not(Box::new(new));
                let label = tr!("selected-without", first = &*self.label, second = label);
                (if self.is_everything() { not } else { both(old, not) }, label)
            }
        };
        Self { selection, label, wisps: None }
    }

    /// The complement; all hair stays all hair, because a selection cannot be empty.
    #[must_use]
    pub fn inverted(&self) -> Self {
        if self.is_everything() {
            return self.clone();
        }
        let label = tr!("selected-all-but", label = &*self.label);
        let (selection, label) = match self.selection.clone() {
            Selection::Not(inner) => {
                let prefix = tr!("selected-all-but", label = "");
                (*inner, self.label.strip_prefix(&prefix).unwrap_or(&label).to_owned())
            }
            other => (Selection::Not(Box::new(other)), label),
        };
        Self { selection, label, wisps: None }
    }

    /// The number of selected wisps.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        self.wisps.as_ref().map(|w| w.iter().filter(|c| **c).count())
    }

    /// The same wisps by index, for a step after the hair has moved: a lasso that was drawn before would cover
    /// other hair. Selections by place do not change.
    #[must_use]
    pub fn fixed(&self) -> Self {
        let Some(wisps) = self.wisps.as_ref().filter(|_| depends_on_shape(&self.selection)) else {
            return self.clone();
        };
        let indices = (0..wisps.len()).filter(|i| wisps[*i]).collect();
        Self { selection: Selection::Wisps(indices), ..self.clone() }
    }
}

/// Whether a selection depends on the shape of the hair.
fn depends_on_shape(selection: &Selection) -> bool {
    match selection {
        Selection::Lasso(_) => true,
        Selection::Any(parts) | Selection::All(parts) => parts.iter().any(depends_on_shape),
        Selection::Not(part) => depends_on_shape(part),
        _ => false,
    }
}

fn joined(a: Selection, b: Selection) -> Selection {
    match a {
        Selection::Any(mut parts) => {
            parts.push(b);
            Selection::Any(parts)
        }
        a => Selection::Any(vec![a, b]),
    }
}

fn both(a: Selection, b: Selection) -> Selection {
    match a {
        Selection::All(mut parts) => {
            parts.push(b);
            Selection::All(parts)
        }
        a => Selection::All(vec![a, b]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(region: Region) -> Selection {
        Selection::Place(Place::Region(region))
    }

    #[test]
    fn selections_combine_by_mode() {
        let none = Selected::default();
        let fringe = none.with(place(Region::Fringe), "fringe", SelectMode::Add);
        assert_eq!(fringe.selection, place(Region::Fringe));
        let both = fringe.with(place(Region::Top), "top", SelectMode::Add);
        assert_eq!(both.label, "fringe and top");
        let less = both.with(Selection::Place(Place::Left), "left half", SelectMode::Remove);
        let Selection::All(parts) = &less.selection else { panic!("{less:?}") };
        assert_eq!(parts.len(), 2);
        assert_eq!(fringe.inverted().inverted().selection, fringe.selection);
        assert!(less.selection.check().is_ok());
    }
}
