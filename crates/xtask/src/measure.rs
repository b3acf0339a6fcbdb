//! Figures about the code: its size, its functions, its comments, its circles, and what the command line compiles.

use crate::circles::{circles, folder_circles};
use crate::source::{self, Package, SourceFile};
use anyhow::Result;
use proc_macro2::{Delimiter, LineColumn, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// The longest function that is allowed, in lines.
pub const LONGEST_FUNCTION: usize = 80;

/// What a package, or all of them together, amounts to.
#[derive(Default)]
pub struct Measures {
    /// Lines with code, without tests, documentation, comments and blanks.
    pub code: usize,
    /// Lines with a `//` comment that is not documentation.
    pub comments: usize,
    /// Each function's lines from `fn` to its closing brace, and where it is.
    pub functions: Vec<(usize, String)>,
    /// Modules that use each other.
    pub circles: Vec<Vec<String>>,
    /// The same with whole folders as modules.
    pub folder_circles: Vec<Vec<String>>,
}

impl Measures {
    /// Measures a package without its tests, examples and benchmarks.
    pub fn of(package: &Package) -> Result<Self> {
        let mut measures = Self::default();
        for file in package.files()? {
            measures.add(&file)?;
        }
        for target in &package.targets {
            measures.circles.extend(circles(target));
            measures.folder_circles.extend(folder_circles(target));
        }
        Ok(measures)
    }

    fn add(&mut self, file: &SourceFile) -> Result<()> {
        let tokens: TokenStream = file.text.parse().map_err(|error| anyhow::anyhow!("{error}"))?;
        let mut ends = BTreeMap::new();
        code_lines(tokens, &mut ends);
        for (number, line) in (1..).zip(file.text.lines()) {
            if file.tests.iter().any(|lines| lines.contains(&number)) {
                continue;
            }
            let rest: String = line.chars().skip(ends.get(&number).copied().unwrap_or(0)).collect();
            let rest = rest.trim_start();
            self.code += usize::from(ends.contains_key(&number));
            let documents = rest.starts_with("//!") || rest.starts_with("///");
            self.comments += usize::from(rest.starts_with("//") && !documents);
        }
        let mut functions = Functions { file, found: Vec::new() };
        functions.visit_file(&syn::parse_file(&file.text)?);
        self.functions.append(&mut functions.found);
        Ok(())
    }

    fn join(&mut self, other: &Self) {
        self.code += other.code;
        self.comments += other.comments;
        self.functions.extend_from_slice(&other.functions);
        self.circles.extend_from_slice(&other.circles);
        self.folder_circles.extend_from_slice(&other.folder_circles);
    }

    /// The functions that are longer than is allowed.
    pub fn long_functions(&self) -> impl Iterator<Item = &(usize, String)> {
        self.functions.iter().filter(|(lines, _)| *lines > LONGEST_FUNCTION)
    }
}

/// The lines that tokens stand on, with the column where the last of them ends; documentation is none.
fn code_lines(tokens: TokenStream, ends: &mut BTreeMap<usize, usize>) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        if matches!(&token, TokenTree::Punct(punct) if punct.as_char() == '#') {
            let inner = matches!(tokens.peek(), Some(TokenTree::Punct(p)) if p.as_char() == '!');
            let bang = if inner { tokens.next() } else { None };
            if tokens.peek().is_some_and(documents) {
                tokens.next();
                continue;
            }
            for punct in [Some(token), bang].into_iter().flatten() {
                occupy(punct.span().start(), punct.span().end(), ends);
            }
            continue;
        }
        if let TokenTree::Group(group) = &token {
            occupy(group.span_open().start(), group.span_open().end(), ends);
            code_lines(group.stream(), ends);
            occupy(group.span_close().start(), group.span_close().end(), ends);
        } else {
            occupy(token.span().start(), token.span().end(), ends);
        }
    }
}

fn occupy(start: LineColumn, end: LineColumn, ends: &mut BTreeMap<usize, usize>) {
    for line in start.line..end.line {
        ends.insert(line, usize::MAX);
    }
    let column = ends.entry(end.line).or_default();
    *column = end.column.max(*column);
}

/// Whether a token is the `[doc = "…"]` of a documentation comment.
fn documents(token: &TokenTree) -> bool {
    let TokenTree::Group(group) = token else { return false };
    let first = group.stream().into_iter().next();
    group.delimiter() == Delimiter::Bracket
        && matches!(first, Some(TokenTree::Ident(name)) if name == "doc")
}

struct Functions<'a> {
    file: &'a SourceFile,
    found: Vec<(usize, String)>,
}

impl Functions<'_> {
    fn add(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let (start, end) = (signature.span().start().line, block.span().end().line);
        if !self.file.tests.iter().any(|lines| lines.contains(&start)) {
            let place = format!("{} {}:{start}", signature.ident, self.file.path.display());
            self.found.push((end - start + 1, place));
        }
    }
}

impl<'ast> Visit<'ast> for Functions<'_> {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.add(&item.sig, &item.block);
        visit::visit_item_fn(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.add(&item.sig, &item.block);
        visit::visit_impl_item_fn(self, item);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.add(&item.sig, block);
        }
        visit::visit_trait_item_fn(self, item);
    }
}

/// All figures about a workspace as one text.
pub fn report(root: &Path) -> Result<String> {
    let mut text = format!(
        "{:20} {:>7} {:>9} {:>6} {:>4} {:>4} {:>5} {:>8} {:>8} {:>9}\n",
        "package",
        "code",
        "comments",
        "fns",
        "p50",
        "p90",
        "max",
        "over 80",
        "circles",
        "(folders)"
    );
    let (mut all, mut notes) = (Measures::default(), String::new());
    for package in source::packages(root)? {
        let measures = Measures::of(&package)?;
        row(&mut text, &package.name, &measures);
        for group in &measures.circles {
            writeln!(notes, "circle in {}: {}", package.name, group.join(", "))?;
        }
        all.join(&measures);
    }
    row(&mut text, "all", &all);
    for (lines, place) in all.long_functions() {
        writeln!(notes, "{lines} lines: {}", place.replace(&format!("{}/", root.display()), ""))?;
    }
    let share = 100.0 * all.comments as f64 / all.code.max(1) as f64;
    writeln!(text, "\nline comments per line of code: {share:.1} %")?;
    if let Some(count) = compiled(root) {
        writeln!(text, "crates that the command line compiles: {count}")?;
    }
    Ok(text + "\n" + &notes)
}

fn row(text: &mut String, name: &str, measures: &Measures) {
    let mut lengths: Vec<_> = measures.functions.iter().map(|(lines, _)| *lines).collect();
    lengths.sort_unstable();
    let quantile = |share: usize| lengths.get(lengths.len() * share / 100).copied().unwrap_or(0);
    let _ = writeln!(
        text,
        "{name:20} {:>7} {:>9} {:>6} {:>4} {:>4} {:>5} {:>8} {:>8} {:>9}",
        measures.code,
        measures.comments,
        lengths.len(),
        quantile(50),
        quantile(90),
        lengths.last().unwrap_or(&0),
        measures.long_functions().count(),
        measures.circles.len(),
        measures.folder_circles.len()
    );
}

/// How many packages `cargo build -p frisure-cli` compiles, build scripts and procedural macros included.
fn compiled(root: &Path) -> Option<usize> {
    let mut cargo = Command::new("cargo");
    cargo.args(["tree", "--locked", "-p", "frisure-cli", "-e", "normal,build", "--prefix", "none"]);
    let output = cargo.args(["-f", "{p}"]).current_dir(root).output().ok()?;
    let lines = String::from_utf8(output.stdout).ok()?;
    let names = lines.lines().map(|line| line.split(" (").next().unwrap_or(line));
    let count = names.filter(|name| !name.is_empty()).collect::<BTreeSet<_>>().len();
    (output.status.success() && count > 0).then_some(count)
}
