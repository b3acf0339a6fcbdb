//! The report as Markdown.

use std::fmt::Write;

use super::book::{Book, plot_name};
use super::tables::{checked, timed};
use super::words;
use crate::{Item, Table};

impl Book<'_> {
    /// The report as Markdown that refers to the files of [`Self::pictures`].
    #[must_use]
    pub fn markdown(&self) -> String {
        page(self)
    }
}

fn page(book: &Book<'_>) -> String {
    let mut out =
        format!("# {}\n\n{}\n\n{}\n\n", words::TITLE, words::INTRODUCTION, words::written(book));
    if let Some(names) = words::left_out(book) {
        let _ = write!(out, "{names}\n\n");
    }
    for (experiment, finding) in &book.chapters {
        let _ = writeln!(out, "- {}: {}", experiment.title, finding.verdict());
    }
    for (experiment, finding) in &book.chapters {
        let (title, question, method) = (experiment.title, experiment.question, experiment.method);
        let _ = write!(out, "\n## {title}\n\n*{question}*\n\n{method}\n\n");
        for (number, item) in finding.items.iter().enumerate() {
            match item {
                Item::Text(text) => {
                    let _ = write!(out, "{text}\n\n");
                }
                Item::Table(shown) => table(&mut out, shown),
                Item::Plot(plot) => {
                    let file = plot_name(experiment, number);
                    let _ = write!(out, "![{}]({file})\n\n", plot.title);
                }
                Item::Picture(picture) => {
                    let _ = write!(out, "![{}]({}.png)\n\n", picture.caption, picture.name);
                }
            }
        }
        match &finding.failure {
            Some(_) => {
                let _ = write!(out, "**{}**\n\n", finding.verdict());
            }
            None => table(&mut out, &checked(finding)),
        }
    }
    if let Some(times) = timed(book) {
        let _ = write!(out, "\n## Times\n\n{}\n\n", words::times());
        table(&mut out, &times);
    }
    out
}

fn table(out: &mut String, table: &Table) {
    if !table.title.is_empty() {
        let _ = write!(out, "**{}**\n\n", table.title);
    }
    let mut line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
        let _ = writeln!(out, "| {} |", cells.join(" | "));
    };
    line(&table.head);
    line(&vec!["---".to_owned(); table.head.len()]);
    for row in &table.rows {
        line(row);
    }
    out.push('\n');
}
