//! The report as an HTML page.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::book::Book;
use super::tables::{checked, timed};
use super::words;
use crate::plot::escaped;
use crate::{Finding, Item, Table};

const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:54em;margin:2em auto;padding:0 1em;\
    color:#222;background:#fff}h1,h2{line-height:1.2}h2{margin-top:2.5em;border-top:1px solid #ccc;\
    padding-top:1em}table{border-collapse:collapse;font-size:.85em;margin:1em 0}caption{text-align:left;\
    font-weight:bold;padding:.3em 0}td,th{border:1px solid #ccc;padding:.2em .6em;text-align:right}\
    td:first-child,th:first-child{text-align:left}figure{margin:1.5em 0}figcaption{color:#555;\
    font-size:.9em}svg,img{max-width:100%;height:auto}.holds{color:#176f2c}.fails{color:#b00020;\
    font-weight:bold}.q{font-style:italic}.wide{overflow-x:auto}";

impl Book<'_> {
    /// The whole report as one HTML page with its pictures inside.
    #[must_use]
    pub fn html(&self) -> String {
        page(self)
    }
}

fn page(book: &Book<'_>) -> String {
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>{0}</title>\
         <style>{STYLE}</style></head><body>\n<h1>{0}</h1>\n",
        escaped(words::TITLE)
    );
    paragraph(&mut out, words::INTRODUCTION);
    paragraph(&mut out, &words::written(book));
    if let Some(names) = words::left_out(book) {
        paragraph(&mut out, &names);
    }
    contents(&mut out, book);
    for (experiment, finding) in &book.chapters {
        let _ = writeln!(
            out,
            "<section id=\"{}\"><h2>{}</h2>\n<p class=\"q\">{}</p>",
            experiment.name,
            escaped(experiment.title),
            escaped(experiment.question)
        );
        paragraph(&mut out, experiment.method);
        for item in &finding.items {
            add(&mut out, item);
        }
        criteria(&mut out, finding);
        out.push_str("</section>\n");
    }
    times(&mut out, book);
    out.push_str("</body></html>\n");
    out
}

fn paragraph(out: &mut String, text: &str) {
    for part in text.split("\n\n") {
        let _ = writeln!(out, "<p>{}</p>", inline(part));
    }
}

/// Text with `code` in it.
fn inline(text: &str) -> String {
    let parts = text.split('`').enumerate();
    parts
        .map(|(i, part)| match i % 2 {
            0 => escaped(part),
            _ => format!("<code>{}</code>", escaped(part)),
        })
        .collect()
}

fn contents(out: &mut String, book: &Book<'_>) {
    out.push_str("<ul>\n");
    for (experiment, finding) in &book.chapters {
        let class = if finding.holds() { "holds" } else { "fails" };
        let _ = writeln!(
            out,
            "<li><a href=\"#{}\">{}</a>: <span class=\"{class}\">{}</span></li>",
            experiment.name,
            escaped(experiment.title),
            escaped(&finding.verdict())
        );
    }
    out.push_str("</ul>\n");
}

fn add(out: &mut String, item: &Item) {
    match item {
        Item::Text(text) => paragraph(out, text),
        Item::Table(shown) => table(out, shown, |_, _| ""),
        Item::Plot(plot) => {
            let _ = writeln!(out, "<figure>{plot}</figure>");
        }
        Item::Picture(picture) => {
            let caption = escaped(&picture.caption);
            let _ = writeln!(
                out,
                "<figure><img width=\"{}\" alt=\"{caption}\" src=\"data:image/png;base64,{}\">\
                 <figcaption>{caption}</figcaption></figure>",
                picture.width,
                STANDARD.encode(&picture.png)
            );
        }
    }
}

fn table(out: &mut String, table: &Table, class: impl Fn(usize, usize) -> &'static str) {
    let _ =
        write!(out, "<div class=\"wide\"><table><caption>{}</caption><tr>", escaped(&table.title));
    for name in &table.head {
        let _ = write!(out, "<th>{}</th>", escaped(name));
    }
    for (i, row) in table.rows.iter().enumerate() {
        out.push_str("</tr>\n<tr>");
        for (j, cell) in row.iter().enumerate() {
            let _ = write!(out, "<td class=\"{}\">{}</td>", class(i, j), escaped(cell));
        }
    }
    out.push_str("</tr></table></div>\n");
}

fn criteria(out: &mut String, finding: &Finding) {
    if finding.failure.is_some() {
        let _ = writeln!(out, "<p class=\"fails\">{}</p>", escaped(&finding.verdict()));
        return;
    }
    let class = |row: usize, column: usize| match (column, finding.criteria[row].holds()) {
        (3, true) => "holds",
        (3, false) => "fails",
        _ => "",
    };
    table(out, &checked(finding), class);
}

fn times(out: &mut String, book: &Book<'_>) {
    let Some(shown) = timed(book) else { return };
    out.push_str("<section id=\"times\"><h2>Times</h2>\n");
    paragraph(out, &words::times());
    table(out, &shown, |_, _| "");
    out.push_str("</section>\n");
}
