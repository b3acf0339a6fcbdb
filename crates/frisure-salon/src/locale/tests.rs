//! Laws of the catalogues: complete, parsed without errors, and used.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use fluent_bundle::FluentResource;
use frisure::hairstyle::PRESETS;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::Operation;
use frisure::scene::Panel;

use super::*;
use crate::state::{CHOICES, CONTROLS, EXERCISES, SCENES, TYPES};

/// The messages of a catalogue: each id with its variables and its attributes with theirs.
fn messages(locale: Locale) -> BTreeMap<String, BTreeSet<String>> {
    let resource = FluentResource::try_new(locale.catalogue().to_owned());
    assert!(resource.is_ok(), "{:?}: {:?}", locale, resource.err().map(|(_, errors)| errors));
    let (mut all, mut last) = (BTreeMap::new(), String::new());
    for line in locale.catalogue().lines() {
        let attribute = line.trim_start().strip_prefix('.').and_then(|l| l.split_once(" ="));
        let message = line.split_once(" =").filter(|(id, _)| {
            id.starts_with(|c: char| c.is_ascii_lowercase()) && !id.contains(' ')
        });
        let id = match (attribute, message) {
            (Some((name, _)), _) => {
                let message = last.split('.').next().unwrap_or_default();
                format!("{message}.{name}")
            }
            (_, Some((id, _))) => id.to_owned(),
            _ => last.clone(),
        };
        let variables = line
            .split('$')
            .skip(1)
            .map(|rest| rest.chars().take_while(char::is_ascii_alphanumeric).collect::<String>());
        all.entry(id.clone()).or_insert_with(BTreeSet::new).extend(variables);
        last = id;
    }
    all.remove("");
    all
}

/// All source files of the salon, one after the other.
fn sources() -> String {
    fn walk(folder: &Path, all: &mut String) {
        let mut entries: Vec<_> = std::fs::read_dir(folder)
            .expect("a folder")
            .map(|e| e.expect("an entry").path())
            .collect();
        entries.sort();
        for path in entries {
            if path.is_dir() {
                walk(&path, all);
            } else if path.extension().is_some_and(|e| e == "rs") {
                all.push_str(&std::fs::read_to_string(&path).expect("a source file"));
            }
        }
    }
    let mut all = String::new();
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut all);
    all
}

#[test]
fn every_catalogue_has_the_messages_of_the_english_one_with_the_same_variables() {
    let english = messages(Locale::English);
    for locale in Locale::ALL {
        let own = messages(locale);
        for (id, variables) in &english {
            assert_eq!(own.get(id), Some(variables), "{id} in {locale:?}");
        }
    }
}

#[test]
fn every_message_is_used_and_every_used_message_exists() {
    let (english, sources) = (messages(Locale::English), sources());
    let cards = EXERCISES.iter().map(|card| format!("exercise-{}", card.name));
    let cards: BTreeSet<String> = cards.collect();
    for id in english.keys().filter(|id| !id.contains('.') && !cards.contains(*id)) {
        let quoted = [format!("\"{id}\""), format!("\"{id}.")];
        assert!(quoted.iter().any(|q| sources.contains(q)), "{id} is not used");
    }
    // Not the end of `include_str!(`.
    for used in sources.replace("_str!(", "").split("tr!(").skip(1) {
        let Some(rest) = used.trim_start().strip_prefix('"') else { continue };
        let id = rest.split('"').next().unwrap_or_default();
        if id.contains(['{', ' ']) {
            continue;
        }
        let variables = english.get(id).unwrap_or_else(|| panic!("no message {id}"));
        for variable in variables {
            let end = rest.find(");").unwrap_or(rest.len()).min(600);
            let shown: String = rest.chars().take(end.max(400)).collect();
            assert!(shown.contains(&format!("{variable} =")), "{id} lacks {variable}");
        }
    }
}

/// Whether the catalogue of a language has its own text for a name of the library.
fn translates(locale: Locale, group: &str, name: &str) -> bool {
    format(&bundle(locale), &id_of(group, name), None).is_some()
}

#[test]
fn what_the_library_declares_is_translated() {
    let mut missing = Vec::new();
    let mut check = |group: &str, name: &str| {
        if !name.is_empty() && !translates(Locale::French, group, name) {
            missing.push(id_of(group, name));
        }
    };
    Panel::ALL.iter().for_each(|panel| check("panel", panel.title()));
    for control in CONTROLS.iter() {
        check("key", control.key);
        check("key", &format!("{}#help", control.key));
    }
    for choice in CHOICES.iter() {
        check("key", choice.key);
        check("key", &format!("{}#help", choice.key));
        choice.options.iter().for_each(|(written, _)| check("option", written));
    }
    for card in TYPES.iter().chain(SCENES) {
        check("card", card.name);
        check("card", &format!("{}#about", card.name));
    }
    frisure::scene::buttons().for_each(|button| check("button", button.label));
    Operation::NAMES.iter().for_each(|operation| check("operation", operation));
    frisure::scene::levels().for_each(|(name, _)| check("level", name));
    Head::names().for_each(|name| check("head", name));
    ["settling guides", "wisps making way", "drawing hairs", "picture", "turntable", "film"]
        .iter()
        .for_each(|stage| check("stage", stage));
    assert!(missing.is_empty(), "French lacks {missing:#?}");
    assert!(PRESETS.iter().all(|preset| translates(Locale::French, "card", preset.name)));
}

#[test]
fn numbers_choose_their_plural_and_tags_their_language() {
    assert!(tr!("badge-unstable", count = 1).ends_with("1 guide"));
    assert!(tr!("badge-unstable", count = 2).ends_with("2 guides"));
    set(Locale::French);
    // In French, none is singular.
    assert!(tr!("badge-unstable", count = 0).ends_with("0 guide"));
    assert_eq!(tr!("badge-at-rest"), "Au repos");
    assert_eq!(named("level", "no such level", "no such level"), "no such level");
    set(Locale::English);
    assert_eq!(tr!("badge-at-rest"), "At rest");
    let of = |tag| Locale::of(tag);
    assert_eq!(
        [of("fr-CA"), of("fr_FR.UTF-8"), of("EN"), of("de"), of("")],
        [Some(Locale::French), Some(Locale::French), Some(Locale::English), None, None]
    );
}

#[test]
fn numbers_have_the_sign_of_the_language_and_are_read_with_either() {
    set(Locale::English);
    assert_eq!(number(12.25, 1), "12.2");
    set(Locale::French);
    assert_eq!((number(12.25, 1), localized("0.5 cm")), ("12,2".into(), "0,5 cm".into()));
    set(Locale::English);
    for text in ["12,5", "12.5", " 12,5", "+12.5"] {
        assert_eq!(parse_number(text), Some(12.5), "{text}");
    }
    assert_eq!(parse_number("−3,5"), Some(-3.5));
    for text in ["", "1,2,3", "nan", "inf", "cm"] {
        assert_eq!(parse_number(text), None, "{text}");
    }
}
