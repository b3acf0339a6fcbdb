//! Which modules of a crate use which, and the circles among them.

use crate::source::Module;
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use std::collections::{BTreeMap, BTreeSet};
use syn::{Item, UseTree, Visibility};

/// The names that a module defines and imports.
#[derive(Default)]
struct Scope {
    parent: usize,
    children: BTreeMap<String, usize>,
    defined: BTreeSet<String>,
    imports: BTreeMap<String, Vec<String>>,
    globs: Vec<Vec<String>>,
    /// Every path that the module's code names; a re-export is not a use.
    used: BTreeSet<Vec<String>>,
}

/// Groups of modules in which each uses each, directly or through others, as paths from the crate's root.
///
/// A name that a module re-exports belongs to the module that defines it, and re-exporting is not a use.
pub fn circles(modules: &[Module]) -> Vec<Vec<String>> {
    let mut graph: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
    for (from, to) in uses(modules) {
        graph.entry(from).or_default().insert(to);
    }
    let name =
        |&index: &usize| [&["crate".to_owned()], &modules[index].path[..]].concat().join("::");
    components(&graph).iter().map(|group| group.iter().map(name).collect()).collect()
}

/// The same between neighbouring modules with all that is inside them, at every level of the tree: what is in `a` uses what is in
/// `b`, and the other way round. The file of the module that has both is a neighbour too.
pub fn folder_circles(modules: &[Module]) -> Vec<Vec<String>> {
    let uses = uses(modules);
    let mut found = Vec::new();
    for parent in modules {
        let within = |index: usize| {
            let path = &modules[index].path;
            let inside = path.starts_with(&parent.path);
            inside.then(|| &path[..path.len().min(parent.path.len() + 1)])
        };
        let mut graph: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
        for &(from, to) in &uses {
            if let (Some(from), Some(to)) = (within(from), within(to))
                && from != to
            {
                graph.entry(from).or_default().insert(to);
            }
        }
        let name = |path: &&[String]| [&["crate".to_owned()], *path].concat().join("::");
        found.extend(components(&graph).iter().map(|group| group.iter().map(name).collect()));
    }
    found
}

/// Which module uses an item of which other.
fn uses(modules: &[Module]) -> BTreeSet<(usize, usize)> {
    let scopes = scopes(modules);
    let mut uses = BTreeSet::new();
    for (from, scope) in scopes.iter().enumerate() {
        let targets = scope.used.iter().filter_map(|path| item(&scopes, from, path, 0));
        uses.extend(targets.filter(|&to| to != from).map(|to| (from, to)));
    }
    uses
}

/// Strongly connected components of more than one node.
fn components<N: Copy + Ord>(graph: &BTreeMap<N, BTreeSet<N>>) -> Vec<BTreeSet<N>> {
    let reach: BTreeMap<N, BTreeSet<N>> = graph
        .keys()
        .map(|&from| {
            let (mut seen, mut next) = (BTreeSet::new(), vec![from]);
            while let Some(node) = next.pop() {
                next.extend(graph.get(&node).into_iter().flatten().filter(|&&to| seen.insert(to)));
            }
            (from, seen)
        })
        .collect();
    let group = |node: &N| -> BTreeSet<N> {
        reach[node]
            .iter()
            .filter(|to| reach.get(to).is_some_and(|back| back.contains(node)))
            .copied()
            .collect()
    };
    let groups: BTreeSet<_> = graph.keys().map(group).filter(|group| group.len() > 1).collect();
    groups.into_iter().collect()
}

fn scopes(modules: &[Module]) -> Vec<Scope> {
    let index: BTreeMap<_, _> = modules.iter().enumerate().map(|(i, m)| (&m.path[..], i)).collect();
    let mut scopes: Vec<Scope> = modules.iter().map(|_| Scope::default()).collect();
    for (number, module) in modules.iter().enumerate() {
        if let Some((name, parent)) = module.path.split_last() {
            scopes[number].parent = index[parent];
            scopes[index[parent]].children.insert(name.clone(), number);
        }
        for item in &module.items {
            scopes[number].declare(item);
        }
    }
    scopes
}

impl Scope {
    fn declare(&mut self, item: &Item) {
        if let Item::Use(item) = item {
            let exported = !matches!(item.vis, Visibility::Inherited);
            self.import(&item.tree, Vec::new(), exported);
            return;
        }
        let name = match item {
            Item::Const(item) => Some(&item.ident),
            Item::Enum(item) => Some(&item.ident),
            Item::Fn(item) => Some(&item.sig.ident),
            Item::Macro(item) => item.ident.as_ref(),
            Item::Static(item) => Some(&item.ident),
            Item::Struct(item) => Some(&item.ident),
            Item::Trait(item) => Some(&item.ident),
            Item::Type(item) => Some(&item.ident),
            Item::Union(item) => Some(&item.ident),
            _ => None,
        };
        self.defined.extend(name.map(ToString::to_string));
        paths(item.to_token_stream(), &mut self.used);
    }

    fn import(&mut self, tree: &UseTree, mut path: Vec<String>, exported: bool) {
        let (name, last) = match tree {
            UseTree::Path(tree) => {
                path.push(tree.ident.to_string());
                return self.import(&tree.tree, path, exported);
            }
            UseTree::Group(group) => {
                return group
                    .items
                    .iter()
                    .for_each(|tree| self.import(tree, path.clone(), exported));
            }
            UseTree::Glob(_) => {
                self.globs.push(path.clone());
                path.push("*".to_owned());
                self.used.extend((!exported).then_some(path));
                return;
            }
            UseTree::Name(tree) => (tree.ident.to_string(), tree.ident.to_string()),
            UseTree::Rename(tree) => (tree.rename.to_string(), tree.ident.to_string()),
        };
        let name = if name == "self" { path.last().cloned().unwrap_or(name) } else { name };
        if last != "self" {
            path.push(last);
        }
        if !exported {
            self.used.insert(path.clone());
        }
        self.imports.insert(name, path);
    }
}

/// Collects `a::b::c` of code and of the arguments of macros.
fn paths(tokens: TokenStream, found: &mut BTreeSet<Vec<String>>) {
    let (mut path, mut colons): (Vec<String>, usize) = (Vec::new(), 0);
    for token in tokens {
        match token {
            TokenTree::Ident(name) => {
                if colons != 2 {
                    found.extend((path.len() > 1).then(|| std::mem::take(&mut path)));
                    path.clear();
                }
                path.push(name.to_string());
                colons = 0;
                continue;
            }
            TokenTree::Punct(punct) if punct.as_char() == ':' => {
                colons += 1;
                continue;
            }
            TokenTree::Group(group) => paths(group.stream(), found),
            _ => {}
        }
        found.extend((path.len() > 1).then(|| std::mem::take(&mut path)));
        path.clear();
        colons = 0;
    }
    found.extend((path.len() > 1).then_some(path));
}

/// The module that defines what a path names; none for other crates and for modules themselves.
fn item(scopes: &[Scope], from: usize, path: &[String], depth: usize) -> Option<usize> {
    let (mut at, mut moved) = (from, false);
    for (i, name) in path.iter().enumerate() {
        let scope = &scopes[at];
        let next = match name.as_str() {
            "crate" => Some(0),
            "self" => Some(at),
            "super" => Some(scope.parent),
            "*" => return Some(at),
            name => scope.children.get(name).copied(),
        };
        if let Some(next) = next {
            (at, moved) = (next, true);
            continue;
        }
        if scope.defined.contains(name) || depth > 20 {
            return Some(at);
        }
        let rest = &path[i + 1..];
        if let Some(import) = scope.imports.get(name) {
            return item(scopes, at, &[&import[..], rest].concat(), depth + 1);
        }
        let through = scope.globs.iter().find_map(|glob| {
            item(scopes, at, &[&glob[..], &path[i..]].concat(), depth + 1).filter(|&to| to != at)
        });
        // What is made by a macro is not seen.
        return through.or(moved.then_some(at));
    }
    None
}
