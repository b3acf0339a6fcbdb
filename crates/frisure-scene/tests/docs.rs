//! `docs/scene.md` lists the keys that there are.
//!
//! After a change of keys: `UPDATE_DOCS=1 cargo test -p frisure-scene --test docs`.

use std::fmt::Write;
use std::path::Path;

use frisure_scene::{Scene, schema};
use serde_json::Value;

const START: &str = "<!-- keys: made from the schema; see crates/frisure-scene/tests/docs.rs -->\n";

/// The tables of keys, from the schema.
fn reference() -> String {
    let mut out = String::new();
    rows(schema(), "", &mut out);
    let place = &schema()["$defs"]["where"];
    let _ = write!(out, "\n## `where`\n\n{}\n", text(&place["description"]));
    for way in place["anyOf"].as_array().into_iter().flatten() {
        if way.get("properties").is_some() {
            rows(way, "where", &mut out);
        }
    }
    out
}

fn table(schema: &Value, path: &str, out: &mut String) {
    if schema.get("properties").is_some() {
        let text = text(&schema["description"]).replace('\n', " ");
        let _ = write!(out, "\n## `[{path}]`\n\n{text}\n");
        rows(schema, path, out);
    }
}

/// The keys of a table, and then the tables in it.
fn rows(schema: &Value, path: &str, out: &mut String) {
    let Some(keys) = schema["properties"].as_object() else { return };
    // A table of places or numbers is a value.
    let is_table = |s: &Value| s.get("properties").is_some() && s.get("required").is_none();
    if keys.values().any(|s| !is_table(s)) {
        let _ = write!(out, "\n| key | value | |\n| --- | --- | --- |\n");
    }
    for (key, schema) in keys.iter().filter(|(_, s)| !is_table(s)) {
        let description = schema["description"].as_str().unwrap_or("").replace('\n', " ");
        let _ = writeln!(out, "| `{key}` | {} | {description} |", value(schema));
    }
    for (key, schema) in keys {
        if schema["items"].get("properties").is_some() && key != "along" {
            list(schema, &join(path, key), out);
        }
        if is_table(schema) {
            table(schema, &join(path, key), out);
        }
    }
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// The keys of tables in a list.
fn list(schema: &Value, path: &str, out: &mut String) {
    let text = schema["description"].as_str().unwrap_or("").replace('\n', " ");
    let _ = write!(out, "\n## `[[{path}]]`\n\n{text}\n");
    rows(&schema["items"], path, out);
}

/// What kind of value a key has, in words.
fn value(schema: &Value) -> String {
    if let Some(words) = schema["oneOf"].as_array() {
        let word = |w: &Value| {
            format!("`\"{}\"` {}", w["const"].as_str().unwrap_or(""), text(&w["description"]))
        };
        return words.iter().map(word).collect::<Vec<_>>().join("; ");
    }
    if let Some(ways) = schema["anyOf"].as_array().filter(|_| schema["examples"].is_null()) {
        return ways.iter().map(value).collect::<Vec<_>>().join("; or ");
    }
    if schema["items"]["oneOf"].is_array() {
        return "a list of these".into();
    }
    if schema["$ref"] == "#/$defs/where" {
        return "see [where](#where)".into();
    }
    if schema["items"]["$ref"] == "#/$defs/where" {
        return "list of choices".into();
    }
    if let Some(keys) = schema["properties"].as_object() {
        let each = |(key, schema): (&String, &Value)| {
            format!("`{key}` {}", schema["description"].as_str().unwrap_or(""))
        };
        return format!("table: {}", keys.iter().map(each).collect::<Vec<_>>().join(" "));
    }
    if let Some(items) = schema["items"]["properties"].as_object() {
        let names: Vec<_> = items.keys().map(|k| format!("`{k}`")).collect();
        return format!("list of tables with {}", names.join(", "));
    }
    match schema["x-unit"].as_str().filter(|_| schema["type"] != "array") {
        Some("a pure number") => return "number".into(),
        Some(unit) => return format!("{unit}, or `{}`", schema["examples"][0]),
        None => {}
    }
    let example = &schema["examples"][0];
    match schema["type"].as_str() {
        Some("integer") => "whole number".into(),
        Some("string") => "text".into(),
        Some("boolean") => "true or false".into(),
        Some("array") if example.is_null() => "list of whole numbers".into(),
        _ => format!("such as `{example}`"),
    }
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or("")
}

#[test]
fn the_reference_is_that_of_the_schema() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene.md");
    let found = std::fs::read_to_string(&path).unwrap();
    let (intro, _) = found.split_once(START).expect("the mark before the tables");
    let expected = format!("{intro}{START}{}", reference());
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(&path, &expected).unwrap();
    } else {
        assert!(found == expected, "docs/scene.md is old: run this test with UPDATE_DOCS=1");
    }
}

#[test]
fn the_scenes_in_the_text_are_scenes() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene.md");
    let text = std::fs::read_to_string(path).unwrap();
    let scenes: Vec<_> =
        text.split("```toml\n").skip(1).filter_map(|s| s.split("```").next()).collect();
    assert_eq!(scenes.len(), 3);
    for scene in scenes {
        let scene = Scene::parse("scene.md", scene, Path::new("")).unwrap();
        assert_eq!(scene.hair_type, "caucasian-curly");
        assert!(scene.hairstyle_spec().is_ok());
    }
}
