//! Keywords: values that are one word of a set.

use std::marker::PhantomData;

use schemars::{Schema, json_schema};
use toml::Value;

use crate::error::ValueError;
use crate::kind::{Kind, ToText};
use crate::similar::near;

/// A set of keywords.
pub(crate) trait Choice: Sized + Copy + 'static {
    /// Each keyword, what it means, and its value.
    fn keywords() -> Vec<(&'static str, &'static str, Self)>;

    /// Other words, each with the keyword that means the same.
    fn synonyms() -> &'static [(&'static str, &'static str)] {
        &[]
    }

    /// Keywords that programs display by another title than the keyword itself, each with its title.
    fn titles() -> &'static [(&'static str, &'static str)] {
        &[]
    }
}

/// One keyword of a set.
pub(crate) struct OneOf<C>(PhantomData<C>);

impl<C: Choice> Kind for OneOf<C> {
    type Value = C;

    fn read(value: &Value) -> Result<C, ValueError> {
        let words = C::keywords();
        let list = words.iter().map(|w| format!("\"{}\"", w.0)).collect::<Vec<_>>().join(", ");
        let outside = || ValueError::new(format!("one of {list}"));
        let word = value.as_str().ok_or_else(outside)?;
        words.iter().find(|w| w.0 == word).map(|w| w.2).ok_or_else(|| match suggestion::<C>(word) {
            Some(near) => outside().hint(format!("did you mean \"{near}\"?")),
            None => outside(),
        })
    }

    fn schema() -> Schema {
        let one_of: Vec<_> = C::keywords()
            .iter()
            .map(|(word, meaning, _)| {
                json_schema!({ "const": word, "title": title::<C>(word), "description": meaning })
            })
            .collect();
        json_schema!({ "oneOf": one_of })
    }
}

impl<C: Choice + PartialEq> ToText for OneOf<C> {
    fn text(value: &C) -> String {
        let word = C::keywords().into_iter().find(|(_, _, known)| known == value);
        format!("\"{}\"", word.map_or("", |word| word.0))
    }
}

/// Returns the title of a keyword: its own, or the keyword as a sentence begins.
fn title<C: Choice>(word: &str) -> String {
    if let Some((_, title)) = C::titles().iter().find(|(known, _)| *known == word) {
        return (*title).to_owned();
    }
    let mut title = word.replace('-', " ");
    if let Some(first) = title.get_mut(0..1) {
        first.make_ascii_uppercase();
    }
    title
}

/// Returns the keyword that is a synonym of a word or similar to it.
fn suggestion<C: Choice>(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase();
    let known = || C::keywords().into_iter().map(|w| w.0);
    let synonym = C::synonyms().iter().find(|(other, _)| *other == word).map(|s| s.1);
    let near = near(&word, known());
    synonym.or_else(|| match near {
        // Two words together are near to many, but are both of them.
        Some((2.., _)) if two_words::<C>(&word).is_some() => None,
        near => near.map(|(_, known)| known),
    })
}

/// Returns two keywords that are written as one word, such as `left-back`.
pub(crate) fn two_words<C: Choice>(word: &str) -> Option<[&'static str; 2]> {
    let (one, other) = word.split_once(['-', '_', ' '])?;
    let known = |word: &str| {
        let synonym = C::synonyms().iter().find(|(other, _)| *other == word).map(|s| s.1);
        C::keywords().into_iter().map(|w| w.0).find(|known| *known == word).or(synonym)
    };
    Some([known(one)?, known(other)?])
}
