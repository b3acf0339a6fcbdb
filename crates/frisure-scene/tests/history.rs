//! Histories: saved and read to the last bit, and what happens to those that are not whole.

use std::path::Path;

use frisure_hairstyle::styling::{Dry, Humidity, Operation};
use frisure_scene::history::{
    HistoryFile, ReadHistoryError, WriteHistoryError, recover, recover_text,
};
use frisure_scene::{parse_step, write_step};
use proptest::prelude::*;

fn steps(texts: &[&str]) -> Vec<Operation> {
    texts.iter().map(|text| parse_step("step", *text).unwrap()).collect()
}

fn history() -> HistoryFile {
    let operations = steps(&[
        "wet = {}",
        "cut = { below = \"brows\", where = { not = [\"nape\"] } }",
        "humidity = 0.95",
        "grow = { time = 12345.678, where = { wisps = [0, 1] } }",
    ]);
    let scene_text = "# Ma coiffure \u{e9}\r\n[hair]\ntype = \"curly\" # \"\"\"\\\u{1}\n\n[[step]]\ndry = \
                      {}\nname = \"\"";
    HistoryFile { scene_text: scene_text.into(), operations, done: 3 }
}

fn refused(text: &str) -> String {
    HistoryFile::parse("a.history", text).unwrap_err().to_string()
}

#[test]
fn a_history_is_read_as_it_was_saved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.history");
    for history in [history(), HistoryFile::default()] {
        history.write(&path).unwrap();
        assert_eq!(HistoryFile::read(&path).unwrap(), history);
        // The same history, the same bytes.
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(HistoryFile::parse("a", &text).unwrap().text().unwrap(), text);
    }
    let names: Vec<_> = std::fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(names.len(), 1, "nothing else is left behind");
}

#[test]
fn a_history_is_legible() {
    let history =
        HistoryFile { scene_text: "seed = 1\n".into(), operations: steps(&["wet = {}"]), done: 0 };
    let text = history.text().unwrap();
    let (body, end) = text.split_once("# end: 1 steps, checksum ").unwrap();
    let start = "history = 1\ndone = 0\nsteps = 1\nscene = \"\"\"\nseed = 1\n\"\"\"\n\n";
    assert_eq!(body, format!("{start}[[step]]\nwet = {{}}\n"));
    assert_eq!(end.len(), 17);
}

#[test]
fn cut_off_anywhere_it_is_never_taken_for_a_shorter_one() {
    let history = history();
    let text = history.text().unwrap();
    let mut ends = Vec::new();
    for operation in &history.operations {
        let (step, from) = (write_step(operation).unwrap(), ends.last().copied().unwrap_or(0));
        // The first is also in the scene, without a line between.
        ends.push(text[from..].find(&format!("\n\n{step}")).unwrap() + from + 2 + step.len() - 1);
    }
    let ends: Vec<_> = ends.iter().map(|end| end + 1).collect();
    for length in (0..text.len()).filter(|i| text.is_char_boundary(*i)) {
        let cut = &text[..length];
        match HistoryFile::parse("a.history", cut) {
            // All but the end of the last line.
            Ok(read) => assert_eq!((read, length), (history.clone(), text.len() - 1)),
            Err(ReadHistoryError::CutOff { whole, promised, .. }) => {
                let recovered = recover_text("a.history", cut).unwrap();
                assert_eq!(recovered.history.operations, history.operations[..whole]);
                assert_eq!(recovered.history.scene_text, history.scene_text);
                assert_eq!((recovered.history.done, promised), (history.done.min(whole), 4));
                assert_eq!(recovered.lost, 4 - whole);
                // Each step is there as soon as its line is.
                assert_eq!(whole, ends.iter().filter(|end| **end <= length).count());
            }
            Err(ReadHistoryError::NothingLeft { .. }) => {
                assert!(length < text.find("\n\n[[step]]\nwet = {}\n\n").unwrap() + 1, "{cut}");
                assert!(recover_text("a.history", cut).is_err());
            }
            Err(other) => panic!("{length}: {other}"),
        }
    }
    let after_two = text.find("[[step]]\nhumidity").unwrap() + "[[step]]\nhumidity = 0.9".len();
    assert_eq!(
        refused(&text[..after_two]),
        "`a.history` ends after step 2 of 4: it was cut off; the 2 whole steps can be recovered"
    );
    assert!(refused("history = 1\nscene = ").contains("ends before its first step"));
}

#[test]
fn a_file_may_end_in_the_middle_of_a_letter() {
    let whole = HistoryFile { scene_text: "é".into(), operations: steps(&["wet = {}"]), done: 1 };
    let text = whole.text().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.history");
    for length in 0..text.len() - 1 {
        std::fs::write(&path, &text.as_bytes()[..length]).unwrap();
        let cut = HistoryFile::read(&path).unwrap_err();
        match cut {
            ReadHistoryError::CutOff { .. } => assert!(recover(&path).unwrap().lost <= 1),
            ReadHistoryError::NothingLeft { .. } => assert!(recover(&path).is_err()),
            other => panic!("{length}: {other}"),
        }
    }
    std::fs::write(&path, b"history = 1\n\xff\n").unwrap();
    let error = HistoryFile::read(&path).unwrap_err().to_string();
    assert!(error.contains("not UTF-8 text (byte 1 of line 2)"), "{error}");
}

#[test]
fn changed_and_foreign_files_say_so() {
    let text = history().text().unwrap();
    let changed = text.replace("humidity = 0.95", "humidity = 0.96");
    assert!(refused(&changed).contains("checksum is wrong"));
    // What is there can still be had.
    let recovered = recover_text("a", &changed).unwrap();
    assert_eq!(recovered.lost, 0);
    assert_eq!(recovered.history.operations[2], Operation::Humidity(Humidity { relative: 0.96 }));
    assert_eq!(
        refused(&text.replacen("history = 1", "history = 2", 1)),
        "`a.history` was written by a newer frisure, in version 2; this one reads 1"
    );
    for other in ["[hair]\n", "history = 0\n", "history = \"1\"\n", "\u{7f}ELF", "historie"] {
        assert!(refused(other).contains("is no history"), "{other}");
    }
    for (path, part) in [("none.history", "there is no file"), (".", "is a directory")] {
        let error = HistoryFile::read(Path::new(path)).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn what_cannot_be_saved_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.history");
    std::fs::write(&path, "old").unwrap();
    let bad = Operation::Dry(Dry { keep: f64::NAN, ..Dry::default() });
    let bad = HistoryFile { operations: vec![bad], ..HistoryFile::default() };
    let refused = bad.write(&path);
    assert!(matches!(refused, Err(WriteHistoryError::Step { index: 0, .. })));
    let ahead = HistoryFile { done: 1, ..HistoryFile::default() };
    assert!(matches!(ahead.write(&path), Err(WriteHistoryError::Done { done: 1, count: 0 })));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
    assert!(history().write(&folder.path().join("none/a.history")).is_err());
}

proptest! {
    #[test]
    fn any_scene_text_comes_back(scene_text in "[\\PC\"\\\\\n\r\t\u{0}-\u{1f}\u{7f}-\u{9f}]{0,60}") {
        let history = HistoryFile { scene_text, operations: steps(&["dry = {}"]), done: 1 };
        let text = history.text().unwrap();
        prop_assert_eq!(HistoryFile::parse("a", &text).unwrap(), history);
    }

    #[test]
    fn any_text_as_a_history(
        text in "\\PC{0,100}", at in 0_usize..400, length in 0_usize..40, start in any::<bool>(),
    ) {
        let whole = history().text().unwrap();
        let near = |mut i: usize| {
            while !whole.is_char_boundary(i.min(whole.len())) { i -= 1 }
            i.min(whole.len())
        };
        let (from, to) = (near(at), near(at + length));
        let text = if start { format!("{}{text}{}", &whole[..from], &whole[to..]) } else { text };
        if let Ok(read) = HistoryFile::parse("a", &text) {
            prop_assert_eq!(read, history());
        }
        let _ = recover_text("a", &text);
    }
}
