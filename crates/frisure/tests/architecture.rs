//! ARCHITECTURE.md against the tree: the folders that it names, and who uses whom.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Rows of the table under a heading, as cells.
fn table(text: &str, heading: &str) -> Vec<Vec<String>> {
    let start = text.find(heading).unwrap_or_else(|| panic!("no heading {heading}"));
    text[start + heading.len()..]
        .lines()
        .take_while(|line| !line.starts_with("## "))
        .filter(|line| line.starts_with('|'))
        .skip(2)
        .map(|line| line.trim_matches('|').split('|').map(|c| c.trim().to_owned()).collect())
        .collect()
}

fn architecture() -> String {
    std::fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md")
}

#[test]
fn every_folder_on_the_map_exists() {
    let text = architecture();
    let rows = table(&text, "## The map");
    assert!(rows.len() > 8);
    for row in rows {
        let folder = row[0].trim_matches('`');
        assert!(root().join(folder).is_dir(), "{folder} is on the map but not in the tree");
    }
}

/// The crates of ours that a manifest depends on, on any machine; what tests use does not count.
fn used(manifest: &str) -> BTreeSet<String> {
    let mut counts = false;
    let mut found = BTreeSet::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            let is_dependencies = line.ends_with("dependencies]");
            counts = is_dependencies && !line.contains("dev-") && !line.contains("build-");
        } else if counts && line.starts_with("frisure") {
            found.extend(line.split(['.', ' ', '=']).next().map(str::to_owned));
        }
    }
    found
}

#[test]
fn crates_use_each_other_as_the_table_says() {
    let text = architecture();
    let told: BTreeMap<String, BTreeSet<String>> = table(&text, "## Who may use whom")
        .into_iter()
        .map(|row| {
            let names = row[1].split(", ").filter(|n| !n.is_empty());
            (row[0].clone(), names.map(str::to_owned).collect())
        })
        .collect();
    let mut found = BTreeMap::new();
    let crates = std::fs::read_dir(root().join("crates")).expect("crates");
    let folders = crates.map(|entry| entry.expect("entry").path());
    let validation = ["evidence", "fuzz", "peers"].map(|name| root().join("validation").join(name));
    for folder in folders.chain(validation) {
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).expect("manifest");
        let name = manifest.lines().find_map(|line| line.strip_prefix("name = "));
        let name = name.expect("a crate has a name").trim_matches('"').to_owned();
        found.insert(name, used(&manifest));
    }
    assert_eq!(told, found);
}
