//! The Rust files of the workspace as syntax: each crate's modules without its tests.

use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::{Attribute, Expr, Item, ItemMod, Lit, Meta};

/// A package of the workspace.
pub struct Package {
    /// Its name in its manifest.
    pub name: String,
    /// The folder of its manifest.
    pub folder: PathBuf,
    /// Its library and its programs, each a tree of modules.
    pub targets: Vec<Vec<Module>>,
}

/// A module; the first of a target is its root.
pub struct Module {
    /// `crate::a::b`, as `["a", "b"]`.
    pub path: Vec<String>,
    /// Where it is.
    pub file: PathBuf,
    /// Its items without tests and without the items of modules inside it.
    pub items: Vec<Item>,
}

/// A file of a package.
pub struct SourceFile {
    /// Where it is.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
    /// The lines that only tests compile, from 1.
    pub tests: Vec<RangeInclusive<usize>>,
}

/// The packages under `crates` and `validation`, by name.
pub fn packages(root: &Path) -> Result<Vec<Package>> {
    let mut packages = Vec::new();
    for parent in ["crates", "validation"].map(|name| root.join(name)) {
        if !parent.is_dir() {
            continue;
        }
        for entry in fs::read_dir(&parent)? {
            let folder = entry?.path();
            if let Ok(manifest) = fs::read_to_string(folder.join("Cargo.toml")) {
                packages.push(package(&manifest, folder)?);
            }
        }
    }
    packages.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(packages)
}

fn package(manifest: &str, folder: PathBuf) -> Result<Package> {
    let name = manifest.lines().find_map(|line| line.strip_prefix("name = "));
    let name = name.context("a package has a name")?.trim_matches('"').to_owned();
    let mut roots: Vec<_> = ["src/lib.rs", "src/main.rs"].map(|file| folder.join(file)).into();
    if let Ok(programs) = fs::read_dir(folder.join("src/bin")) {
        roots.extend(programs.filter_map(|entry| Some(entry.ok()?.path())));
    }
    roots.retain(|file| file.is_file());
    let targets = roots.iter().map(|file| {
        let mut modules = Vec::new();
        read(file, Vec::new(), file.parent().unwrap_or(file), &mut modules)?;
        Ok(modules)
    });
    let targets = targets.collect::<Result<_>>()?;
    Ok(Package { name, folder, targets })
}

impl Package {
    /// The files that the package compiles without its tests.
    pub fn files(&self) -> Result<Vec<SourceFile>> {
        let modules = self.targets.iter().flatten();
        let paths: BTreeSet<_> = modules.map(|module| module.file.clone()).collect();
        let files = paths.into_iter().map(|path| {
            let text = fs::read_to_string(&path)?;
            let mut tests = Vec::new();
            test_lines(&syn::parse_file(&text)?.items, &mut tests);
            Ok(SourceFile { path, text, tests })
        });
        files.collect()
    }
}

fn test_lines(items: &[Item], lines: &mut Vec<RangeInclusive<usize>>) {
    for item in items {
        if is_test(item) {
            lines.push(item.span().start().line..=item.span().end().line);
        } else if let Item::Mod(ItemMod { content: Some((_, items)), .. }) = item {
            test_lines(items, lines);
        }
    }
}

/// Reads the file of a module whose modules are in `folder`.
fn read(file: &Path, path: Vec<String>, folder: &Path, modules: &mut Vec<Module>) -> Result<()> {
    let text = fs::read_to_string(file).with_context(|| format!("{}", file.display()))?;
    let items = syn::parse_file(&text).with_context(|| format!("{}", file.display()))?.items;
    descend(items, path, file, folder, modules)
}

fn descend(
    items: Vec<Item>,
    path: Vec<String>,
    file: &Path,
    folder: &Path,
    modules: &mut Vec<Module>,
) -> Result<()> {
    let index = modules.len();
    modules.push(Module { path: path.clone(), file: file.to_owned(), items: Vec::new() });
    for item in items {
        if is_test(&item) {
            continue;
        }
        let Item::Mod(module) = item else {
            modules[index].items.push(item);
            continue;
        };
        let name = module.ident.to_string();
        let path = [&path[..], std::slice::from_ref(&name)].concat();
        let inside = folder.join(&name);
        if let Some((_, items)) = module.content {
            descend(items, path, file, &inside, modules)?;
        } else if let Some(other) = other_path(&module.attrs) {
            let other = file.parent().unwrap_or(file).join(other);
            read(&other, path, other.parent().unwrap_or(&other), modules)?;
        } else {
            let flat = folder.join(format!("{name}.rs"));
            let file = if flat.is_file() { flat } else { inside.join("mod.rs") };
            read(&file, path, &inside, modules)?;
        }
    }
    Ok(())
}

fn is_test(item: &Item) -> bool {
    let attributes = match item {
        Item::Mod(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Const(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        _ => return false,
    };
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg") => {
            let condition = list.tokens.to_string();
            condition == "test"
                || condition.starts_with("all (test")
                || condition.starts_with("all(test")
        }
        _ => false,
    })
}

/// The value of `#[path = "…"]`.
fn other_path(attributes: &[Attribute]) -> Option<String> {
    attributes.iter().find_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("path") => match &pair.value {
            Expr::Lit(value) => match &value.lit {
                Lit::Str(text) => Some(text.value()),
                _ => None,
            },
            _ => None,
        },
        _ => None,
    })
}
