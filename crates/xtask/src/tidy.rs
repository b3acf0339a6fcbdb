//! Rules about the tree that no compiler checks. Each returns what breaks it, one line per place.

use crate::measure::Measures;
use crate::source::{self, Package};
use anyhow::{Context, Result, ensure};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A rule: its name, and the places that break it.
type Rule = (&'static str, fn(&Tree) -> Result<Vec<String>>);

/// What the rules look at: to parse all files takes longer than any rule.
struct Tree {
    root: PathBuf,
    packages: Vec<(Package, Measures)>,
}

/// All rules.
const RULES: [Rule; 6] = [
    ("no retired words", retired_words),
    ("no long functions", long_functions),
    ("no circles between modules", module_circles),
    ("links lead to files", links),
    ("the README is short", short_readme),
    ("crates have the workspace's lints and forbid unsafe code", lints),
];

/// What breaks the rules, a line per place.
pub fn broken(root: &Path) -> Result<Vec<String>> {
    let mut packages = Vec::new();
    for package in source::packages(root)? {
        let measures = Measures::of(&package)?;
        packages.push((package, measures));
    }
    let tree = Tree { root: root.to_owned(), packages };
    let mut broken = Vec::new();
    for (name, rule) in RULES {
        broken.extend(rule(&tree)?.into_iter().map(|place| format!("{name}: {place}")));
    }
    Ok(broken)
}

/// Crates with `unsafe` code: calls of a library of the system.
const UNSAFE: [&str; 1] = ["frisure-denoise"];

/// The most lines of the README.
const LONGEST_README: usize = 100;

/// Words that were replaced, one a line: the word, what to say, and after `in` the files where it may stand.
const RETIRED: &str = "crates/xtask/retired-words.txt";

/// The tracked text files, with their paths from the root.
fn texts(root: &Path) -> Result<Vec<(String, String)>> {
    let output = Command::new("git").args(["ls-files", "-z"]).current_dir(root).output()?;
    ensure!(
        output.status.success(),
        "git ls-files fails: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    let names = String::from_utf8(output.stdout)?;
    let kinds = [".rs", ".md", ".toml", ".py", ".wgsl", ".js", ".html", ".css", ".snap", "run"];
    let kept = names.split('\0').filter(|name| kinds.iter().any(|kind| name.ends_with(kind)));
    Ok(kept
        .filter_map(|name| Some((name.to_owned(), fs::read_to_string(root.join(name)).ok()?)))
        .collect())
}

fn retired_words(Tree { root, .. }: &Tree) -> Result<Vec<String>> {
    let list = fs::read_to_string(root.join(RETIRED)).context(RETIRED)?;
    let mut broken = Vec::new();
    let texts = texts(root)?;
    for entry in list.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let (word, rest) =
            entry.split_once(" -> ").with_context(|| format!("no ` -> ` in {entry}"))?;
        let (instead, allowed) = rest.split_once(" in ").unwrap_or((rest, ""));
        let allowed: Vec<_> = allowed.split_whitespace().collect();
        for (file, text) in &texts {
            // Most files have no such word at all, and their lines are not looked at.
            if !text.contains(word) || allowed.iter().any(|start| file.starts_with(start)) {
                continue;
            }
            for (number, line) in (1..).zip(text.lines()) {
                if has_word(line, word) {
                    broken.push(format!("{file}:{number}: {word:?} is retired; say {instead:?}"));
                }
            }
        }
    }
    Ok(broken)
}

/// Whether a line has a word with no letter, digit or `_` on either side.
fn has_word(line: &str, word: &str) -> bool {
    let joins = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(at, _)| {
        !line[..at].chars().next_back().is_some_and(joins)
            && !line[at + word.len()..].chars().next().is_some_and(joins)
    })
}

fn long_functions(tree: &Tree) -> Result<Vec<String>> {
    let long = tree.packages.iter().flat_map(|(_, measures)| measures.long_functions());
    Ok(long.map(|(lines, place)| format!("{lines} lines: {place}")).collect())
}

fn module_circles(tree: &Tree) -> Result<Vec<String>> {
    let of = |(package, measures): &(Package, Measures)| -> Vec<String> {
        let groups = measures.circles.iter().chain(&measures.folder_circles);
        groups.map(|group| format!("{}: {}", package.name, group.join(", "))).collect()
    };
    Ok(tree.packages.iter().flat_map(of).collect())
}

/// Links in Markdown, and paths of the tree between backquotes in Markdown and comments, to files that are not there.
fn links(Tree { root, .. }: &Tree) -> Result<Vec<String>> {
    let mut broken = Vec::new();
    for (file, text) in texts(root)? {
        let markdown = file.ends_with(".md") && file != "CHANGELOG.md";
        let folder = root.join(&file).parent().map(Path::to_owned).unwrap_or_default();
        for (number, line) in (1..).zip(text.lines()) {
            let mut paths = Vec::new();
            if markdown {
                paths.extend(local_links(line).map(|link| folder.join(link)));
            }
            if markdown || (file.ends_with(".rs") && line.trim_start().starts_with("//")) {
                paths.extend(quoted_paths(line).map(|path| root.join(path)));
            }
            let missing = paths.iter().filter(|path| !path.exists());
            broken.extend(
                missing.map(|path| format!("{file}:{number}: there is no {}", path.display())),
            );
        }
    }
    Ok(broken)
}

/// The files that a line of Markdown links to, from the folder of its file.
fn local_links(line: &str) -> impl Iterator<Item = &str> {
    let links = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let local = links.filter(|link| !link.contains(':') && !link.starts_with('#'));
    local.map(|link| link.split('#').next().unwrap_or(link))
}

/// The paths of the tree that a line has between backquotes, from the root.
fn quoted_paths(line: &str) -> impl Iterator<Item = &str> {
    const FOLDERS: [&str; 6] = [".ci/", ".github/", "crates/", "docs/", "scenes/", "validation/"];
    line.split('`').skip(1).step_by(2).filter(|text| {
        FOLDERS.iter().any(|folder| text.starts_with(folder))
            && !text.contains([' ', '*', '{', '<', '…'])
    })
}

fn short_readme(Tree { root, .. }: &Tree) -> Result<Vec<String>> {
    let lines = fs::read_to_string(root.join("README.md"))?.lines().count();
    let long = lines > LONGEST_README;
    Ok(long.then(|| format!("it has {lines} lines of {LONGEST_README}")).into_iter().collect())
}

fn lints(tree: &Tree) -> Result<Vec<String>> {
    let mut broken = Vec::new();
    for (package, _) in &tree.packages {
        let manifest = fs::read_to_string(package.folder.join("Cargo.toml"))?;
        for file in ["src/lib.rs", "src/main.rs"].map(|file| package.folder.join(file)) {
            let text = fs::read_to_string(&file).unwrap_or_default();
            let forbids = text.contains("forbid(unsafe_code)");
            if file.exists() && !forbids && !UNSAFE.contains(&package.name.as_str()) {
                broken.push(format!("{}: no `#![forbid(unsafe_code)]`", file.display()));
            }
        }
        if !manifest.contains("[lints]\nworkspace = true") {
            broken.push(format!("{}: no `[lints] workspace = true`", package.name));
        }
    }
    Ok(broken)
}

#[cfg(test)]
mod tests {
    use super::has_word;

    #[test]
    fn a_word_is_found_only_whole() {
        assert!(has_word("a Grid, and", "Grid"));
        assert!(has_word("so many", "so many"));
        assert!(!has_word("Gridline", "Grid") && !has_word("my_Grid", "Grid"));
        assert!(has_word("Gridline Grid", "Grid"));
    }
}
