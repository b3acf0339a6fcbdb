//! Which hair the next step is about.

use frisure::hairstyle::Place;
use frisure::hairstyle::head::Region;
use frisure::hairstyle::styling::Selection;

/// How a new choice and the one there was become one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The new one alone.
    #[default]
    Replace,
    /// Both.
    Add,
    /// What is in the old one and not in the new.
    Remove,
}

/// Parts of the scalp that can be chosen by name.
pub const PLACES: [(&str, Place); 8] = [
    ("Fringe", Place::Region(Region::Fringe)),
    ("Top", Place::Region(Region::Top)),
    ("Crown", Place::Region(Region::Crown)),
    ("Sides", Place::Region(Region::Sides)),
    ("Back", Place::Region(Region::Back)),
    ("Nape", Place::Region(Region::Nape)),
    ("Left half", Place::Left),
    ("Right half", Place::Right),
];

/// A choice, and which wisps it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// The choice as steps say it.
    pub selection: Selection,
    /// In words, such as "fringe".
    pub label: String,
    /// Which wisps, once that is known.
    pub wisps: Option<Vec<bool>>,
}

impl Default for Chosen {
    fn default() -> Self {
        Self { selection: Selection::Everything, label: "all hair".into(), wisps: None }
    }
}

impl Chosen {
    /// Whether it is all hair.
    #[must_use]
    pub fn is_everything(&self) -> bool {
        self.selection == Selection::Everything
    }

    /// This choice and a new one.
    #[must_use]
    pub fn with(&self, new: Selection, label: &str, mode: Mode) -> Self {
        let old = self.selection.clone();
        let (selection, label) = match mode {
            Mode::Add if !self.is_everything() => {
                (joined(old, new), format!("{} and {label}", self.label))
            }
            Mode::Replace | Mode::Add => (new, label.to_owned()),
            Mode::Remove => {
                let not = Selection::Not(Box::new(new));
                let label = format!("{} without {label}", self.label);
                (if self.is_everything() { not } else { both(old, not) }, label)
            }
        };
        Self { selection, label, wisps: None }
    }

    /// All hair but this; of all hair, all of it, since nothing cannot be chosen.
    #[must_use]
    pub fn inverted(&self) -> Self {
        if self.is_everything() {
            return self.clone();
        }
        let label = format!("all but {}", self.label);
        let (selection, label) = match self.selection.clone() {
            Selection::Not(inner) => {
                (*inner, self.label.strip_prefix("all but ").unwrap_or(&label).to_owned())
            }
            other => (Selection::Not(Box::new(other)), label),
        };
        Self { selection, label, wisps: None }
    }

    /// How many wisps it has.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        self.wisps.as_ref().map(|w| w.iter().filter(|c| **c).count())
    }

    /// The same wisps by number, for a step that comes after the hair has moved: a lasso drawn on it
    /// as it was would be about other hair now. Wisps by place stay what they are.
    #[must_use]
    pub fn fixed(&self) -> Self {
        let Some(wisps) = self.wisps.as_ref().filter(|_| looks(&self.selection)) else {
            return self.clone();
        };
        let numbers = (0..wisps.len()).filter(|i| wisps[*i]).collect();
        Self { selection: Selection::Wisps(numbers), ..self.clone() }
    }
}

/// Whether a choice depends on how the hair lies.
fn looks(selection: &Selection) -> bool {
    match selection {
        Selection::Lasso(_) => true,
        Selection::Any(parts) | Selection::All(parts) => parts.iter().any(looks),
        Selection::Not(part) => looks(part),
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
    fn choices_add_up() {
        let none = Chosen::default();
        let fringe = none.with(place(Region::Fringe), "fringe", Mode::Add);
        assert_eq!(fringe.selection, place(Region::Fringe));
        let both = fringe.with(place(Region::Top), "top", Mode::Add);
        assert_eq!(both.label, "fringe and top");
        let less = both.with(Selection::Place(Place::Left), "left half", Mode::Remove);
        let Selection::All(parts) = &less.selection else { panic!("{less:?}") };
        assert_eq!(parts.len(), 2);
        assert_eq!(fringe.inverted().inverted().selection, fringe.selection);
        assert!(less.selection.check().is_ok());
    }
}
