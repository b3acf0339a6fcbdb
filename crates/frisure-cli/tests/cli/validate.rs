//! `frisure validate`.

use std::fs;

use crate::room::Room;

#[test]
fn an_experiment_is_run_and_told() {
    let room = Room::new();
    let ran = room.run(&["validate", "elastica", "-o", "book"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{}", ran.out);
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
