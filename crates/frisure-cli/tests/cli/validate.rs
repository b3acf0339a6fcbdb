//! `frisure validate`.

use std::fs;

use crate::room::Room;

#[test]
fn an_experiment_is_run_and_told() {
    let room = Room::new();
    let ran = room.run(&["validate", "elastica", "-o", "book"]);
    assert_eq!(ran.code, Some(0), "{}{}", ran.out, ran.err);
    // Where no one sees a bar, a line tells that an experiment is finished.
    assert!(
        ran.err.starts_with("1 of 1 elastica: ") && ran.err.lines().count() == 1,
        "{}",
        ran.err
    );
    assert!(ran.out.contains("elastica") && ran.out.contains("criteria hold"), "{}", ran.out);
    let page = fs::read_to_string(room.path("book/index.html")).unwrap();
    // It opens offline: everything is inside.
    assert!(page.contains("<svg") && !page.contains("src=\"http") && !page.contains("href=\"http"));
    let text = fs::read_to_string(room.path("book/report.md")).unwrap();
    for link in text.split("](").skip(1) {
        let file = link.split(')').next().unwrap();
        assert!(room.path("book").join(file).is_file(), "{file}");
    }

    let again = room.run(&["validate", "elastica", "-o", "again", "--threads", "1"]);
    assert_eq!(again.code, Some(0));
    assert_eq!(fs::read_to_string(room.path("again/index.html")).unwrap(), page);
}

#[test]
fn the_list_names_what_can_be_run() {
    let list = Room::new().run(&["validate", "--list"]);
    let name = list.out.split_whitespace().next().unwrap();
    assert_eq!((list.code, name), (Some(0), "elastica"));
    let ran = Room::new().run(&["validate", "nonesuch"]);
    assert_eq!(ran.code, Some(2), "{}", ran.err);
}

#[test]
fn what_cannot_be_written_is_told_before_the_work() {
    let room = Room::new();
    fs::write(room.path("file"), "").unwrap();
    let ran = room.run(&["validate", "elastica", "-o", "file"]);
    assert_eq!(ran.code, Some(2), "{}", ran.err);
    assert!(
        ran.err.contains("`file` is not a folder") && ran.err.contains("name a folder"),
        "{}",
        ran.err
    );
    fs::create_dir_all(room.path("book/elastica-7.svg")).unwrap();
    let ran = room.run(&["validate", "elastica", "-o", "book"]);
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert!(ran.err.contains("elastica-7.svg"), "{}", ran.err);
}

#[test]
fn another_run_into_the_folder_replaces_the_report() {
    let room = Room::new();
    let pictures = || {
        let names = fs::read_dir(room.path("book")).unwrap().map(|e| e.unwrap().file_name());
        names.filter(|n| n.to_string_lossy().ends_with(".svg")).count()
    };
    assert_eq!(room.run(&["-q", "validate", "elastica", "-o", "book"]).code, Some(0));
    assert!(pictures() > 0);
    fs::write(room.path("book/notes.svg"), "").unwrap();
    let ran = room.run(&["validate", "-q", "types", "-o", "book"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""));
    let page = fs::read_to_string(room.path("book/index.html")).unwrap();
    assert!(page.contains("Not run: elastica, "));
    let text = fs::read_to_string(room.path("book/report.md")).unwrap();
    assert_eq!(pictures(), text.matches(".svg)").count() + 1);
}
