//! Findings as documents: a single page that opens offline, and Markdown with picture files.

mod book;
mod folder;
mod html;
mod markdown;
mod tables;
mod words;

pub use book::Book;
pub use folder::in_the_way;

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::plot::{Mark, Plot, Scale};
    use crate::{Effort, Experiment, Finding, Limit, Picture, Table};

    const EXPERIMENT: Experiment = Experiment {
        name: "test",
        title: "Is 1 < 2?",
        question: "Is it?",
        method: "By `counting`.\n\nTwice.",
        run: |_, _| Ok(Finding::default()),
    };

    fn book() -> Book<'static> {
        let mut finding = Finding::default();
        finding.text("a & b");
        let mut table = Table::new("cells", &["a", "b"]);
        table.row(["x|y".to_owned(), "<z>".to_owned()]);
        finding.table(table);
        let mut plot = Plot::new("line", "x", "y", [Scale::Linear; 2]);
        plot.add("", Mark::Line, [(0.0, 1.0), (1.0, 2.0)]);
        finding.plot(plot);
        let (name, caption) = ("dot".to_owned(), "a dot".to_owned());
        finding.picture(Picture { name, caption, width: 1, png: vec![1, 2, 3] });
        finding.check("one", 1.0, Limit::AtMost(2.0));
        Book { effort: Effort::Quick, chapters: vec![(&EXPERIMENT, finding)] }
    }

    #[test]
    fn reports_a_failed_verdict() {
        let mut book = book();
        assert!(book.holds() && book.html().contains("1 of 1 criterion hold"));
        book.chapters[0].1.check("two", 3.0, Limit::AtMost(2.0));
        assert!(!book.holds());
        for text in [book.html(), book.markdown()] {
            assert!(text.contains("1 of 2 criteria FAIL") && text.contains("FAILS"), "{text}");
        }
    }

    #[test]
    fn text_is_escaped_and_pictures_are_inside() {
        let page = book().html();
        for text in
            ["Is 1 &lt; 2?", "a &amp; b", "&lt;z&gt;", "<code>counting</code>", "base64,AQID"]
        {
            assert!(page.contains(text), "{text}");
        }
        assert!(book().markdown().contains("| x\\|y | <z> |"));
    }

    #[test]
    fn reports_an_experiment_that_could_not_be_run() {
        let mut book = book();
        book.chapters[0].1 = Finding::failed(&std::fmt::Error);
        assert!(!book.holds());
        for text in [book.html(), book.markdown()] {
            assert_eq!(text.matches("COULD NOT BE RUN: an error occurred").count(), 2, "{text}");
            assert!(text.contains("Not run: elastica, "), "{text}");
            assert!(text.contains(env!("CARGO_PKG_VERSION")), "{text}");
        }
    }

    #[test]
    fn the_markdown_names_files_that_are_written() {
        let folder = std::env::temp_dir().join(format!("frisure-book-{}", std::process::id()));
        book().write(&folder).unwrap();
        let text = fs::read_to_string(folder.join("report.md")).unwrap();
        let names: Vec<&str> =
            text.split("](").skip(1).filter_map(|link| link.split(')').next()).collect();
        assert_eq!(names, ["test-2.svg", "dot.png"]);
        assert!(names.iter().all(|name| folder.join(name).is_file()));

        // A later report removes the pictures that only the earlier one showed, and nothing else.
        fs::write(folder.join("mine.png"), "mine").unwrap();
        let mut later = book();
        later.chapters[0].1.items.pop();
        later.write(&folder).unwrap();
        let is = |name: &str| folder.join(name).is_file();
        assert!(is("test-2.svg") && !is("dot.png") && is("mine.png") && is("index.html"));
        fs::remove_dir_all(&folder).unwrap();
    }
}
