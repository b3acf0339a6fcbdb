//! Heads and grooms of other programs, without a window.

mod common;

use std::fmt::Write;
use std::path::Path;
use std::sync::LazyLock;

use common::World;
use frisure::hairstyle::head::Head;
use frisure::scene::Panel;
use frisure_salon::state::{Badge, Command, Destination, Message, panel_title};

/// A head of few hairs as grooms of other programs: some of them do not tell guides from hairs.
fn exported(format: &str) -> Vec<u8> {
    static FILES: LazyLock<Vec<(String, Vec<u8>)>> = LazyLock::new(|| {
        let mut world = World::new();
        let text =
            "[hair]\ntype = \"wavy\"\n[wisps]\ncount = 20\nhairs = 30\npoints = 12\n".to_owned();
        world.run(Command::Open { path: None, name: "a".into(), text });
        let file = |format: &&str| {
            let name = format!("a.{format}");
            world.run(Command::Export(Destination::Path(name.clone().into())));
            (name.clone(), world.files[&name].clone())
        };
        ["npz", "obj", "hair", "usda"].iter().map(file).collect()
    });
    let found = FILES.iter().find(|(name, _)| Path::new(name).extension().unwrap() == format);
    found.unwrap().1.clone()
}

/// The mannequin as an OBJ mesh in centimetres, y up.
fn head_in_cm() -> Vec<u8> {
    let head = Head::mannequin();
    let mut text = String::new();
    for p in head.surface().positions() {
        writeln!(text, "v {} {} {}", 100.0 * p.x, 100.0 * p.z, -100.0 * p.y).unwrap();
    }
    for [a, b, c] in head.surface().triangles() {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
    }
    text.into_bytes()
}

fn last(world: &World) -> Message {
    world.salon.messages.last().cloned().unwrap_or_default()
}

fn errors(world: &World) -> Vec<&Message> {
    world.salon.messages.iter().filter(|m| m.is_error).collect()
}

fn is_held(world: &World) -> bool {
    let hair = world.salon.preview().expect("hair").0;
    hair.adoption.as_ref().is_some_and(|held| held.within_a_millimetre * 10 >= held.strands * 8)
}

#[test]
fn a_groom_dropped_on_the_gallery_is_shown_and_can_be_wetted() {
    let mut world = World::new();
    world.drop("her-hair.npz", &exported("npz"));
    assert!(!world.salon.is_gallery() && world.salon.is_settled(), "{:?}", world.salon.messages);
    assert_eq!(world.salon.document.as_ref().unwrap().name(), "her-hair");
    assert!(world.text().contains("file = \"her-hair.npz\""), "{}", world.text());
    assert!(is_held(&world));
    let message = last(&world);
    assert!(
        message.text.starts_with("groom: ") && message.text.contains("stay within 1 mm"),
        "{message:?}"
    );
    let dry = world.salon.preview().unwrap().0.strands.clone();
    world.run(Command::ToggleWet);
    assert!(world.salon.is_wet() && world.salon.preview().unwrap().0.strands != dry);
    assert!(errors(&world).is_empty(), "{:?}", errors(&world));
}

#[test]
fn a_groom_replaces_the_hair_and_is_undone_like_any_edit() {
    let mut world = World::new();
    world.small("curly");
    let before = (world.text().to_owned(), world.salon.preview().unwrap().0.strands.clone());
    world.drop("wavy.hair", &exported("hair"));
    assert!(is_held(&world), "{:?}", world.salon.messages);
    assert_eq!(
        world.salon.document.as_ref().unwrap().edits().last().unwrap().label,
        "Hair of wavy.hair"
    );
    let after = (world.text().to_owned(), world.salon.preview().unwrap().0.strands.clone());
    assert!(after.1 != before.1);
    world.run(Command::Undo);
    assert_eq!((world.text().to_owned(), world.salon.preview().unwrap().0.strands.clone()), before);
    assert!(world.salon.preview().unwrap().0.adoption.is_none());
    world.run(Command::Redo);
    assert_eq!((world.text().to_owned(), world.salon.preview().unwrap().0.strands.clone()), after);
    world.run(Command::Groom(None));
    assert!(!world.text().contains("wavy.hair") && world.salon.is_settled());
    assert!(world.salon.preview().unwrap().0.adoption.is_none());
}

#[test]
fn a_wrong_unit_or_axis_is_reported_with_a_hint_for_the_window() {
    let mut world = World::new();
    world.small("wavy");
    world.drop("a.obj", &exported("obj"));
    assert!(is_held(&world), "{:?}", world.salon.messages);
    let hint = |world: &World| {
        let message = last(world);
        assert!(
            message.is_error && message.hint.contains(&*panel_title(Panel::Files)),
            "{message:?}"
        );
        assert!(!message.hint.contains('`'), "no keys of scenes: {message:?}");
        assert!(matches!(world.salon.badge(), Badge::Refused(_)));
        message.text
    };
    world.run(Command::SetOption("groom.up", "\"z\"".into()));
    assert!(hint(&world).ends_with("but with y up they fit"));
    world.run(Command::Reset("groom.up"));
    assert!(is_held(&world) && world.salon.is_settled());
    let label = &world.salon.document.as_ref().unwrap().edits().last().unwrap().label;
    assert_eq!(label, "Up in the groom: as in the file");

    world.run(Command::SetOption("groom.unit", "\"mm\"".into()));
    assert!(hint(&world).contains("is it in m?"));
    world.run(Command::SetOption("groom.unit", "\"m\"".into()));
    assert!(is_held(&world) && world.salon.is_settled());

    // Another file has a unit of its own.
    world.drop("b.hair", &exported("hair"));
    assert!(!world.text().contains("unit"), "{}", world.text());
    assert!(is_held(&world), "{:?}", world.salon.messages);
}

#[test]
fn a_stage_with_a_head_and_hair_is_used_as_both() {
    let mut world = World::new();
    world.drop("all.usda", &exported("usda"));
    assert!(world.salon.is_settled(), "{:?}", world.salon.messages);
    let files = world.salon.files();
    assert!(files.head && files.groom && is_held(&world));
    assert!(world.salon.messages.iter().any(|m| m.text.contains("both")));
    world.run(Command::Head(None));
    assert!(is_held(&world), "the mannequin is the head that it was made on");
}

#[test]
fn head_and_groom_can_be_opened_in_any_order() {
    for groom_first in [false, true] {
        let mut world = World::new();
        let mut files = [("face.obj", head_in_cm()), ("hair.npz", exported("npz"))];
        files.iter().for_each(|(name, bytes)| world.upload(name, bytes));
        if groom_first {
            files.reverse();
        }
        for (name, _) in &files {
            world.salon.run(Command::File((*name).to_owned()));
        }
        world.settle();
        let files = world.salon.files();
        assert!(files.head && files.groom && is_held(&world), "{:?}", world.salon.messages);
        assert!(errors(&world).is_empty(), "{:?}", errors(&world));
        let unit = world.salon.messages.iter().find(|m| m.text.contains("cm is assumed"));
        assert!(
            unit.is_some_and(|m| m.hint.contains(&*panel_title(Panel::Files))),
            "{:?}",
            world.salon.messages
        );
    }
}

#[test]
fn a_file_that_is_opened_again_is_read_again() {
    let mut world = World::new();
    world.small("curly");
    let (groom, text) = (exported("npz"), world.text().to_owned());
    world.drop("a.npz", &groom[..groom.len() / 2]);
    assert!(matches!(world.salon.badge(), Badge::Refused(_)));
    let refused = world.text().to_owned();
    assert!(refused != text);
    world.drop("a.npz", &groom);
    assert_eq!(world.text(), refused);
    assert!(world.salon.is_settled() && is_held(&world), "{:?}", world.salon.messages);
}

#[test]
fn paths_of_files_near_the_scene_are_relative() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    std::fs::create_dir(place("scenes")).unwrap();
    std::fs::create_dir(place("grooms")).unwrap();
    for name in ["scenes/a.npz", "grooms/a.npz"] {
        std::fs::write(place(name), exported("npz")).unwrap();
    }
    for (name, written) in [("scenes/a.npz", "a.npz"), ("grooms/a.npz", "../grooms/a.npz")] {
        let mut world = World::new();
        let text = "[wisps]\nhairs = 500\n".to_owned();
        let path = Some(place("scenes/x.toml"));
        world.salon.run(Command::Open { path, name: "x.toml".into(), text });
        world.run(Command::File(place(name).display().to_string()));
        assert!(world.text().contains(&format!("file = \"{written}\"")), "{}", world.text());
        assert!(is_held(&world), "{:?}", world.salon.messages);
    }
    // Saved elsewhere, it names the same file.
    let mut world = World::new();
    let text = "[wisps]\nhairs = 500\n\n[groom]\nfile = \"a.npz\" # hers\n".to_owned();
    let path = Some(place("scenes/x.toml"));
    world.run(Command::Open { path, name: "x.toml".into(), text });
    world.run(Command::Save(Destination::Path(place("y.toml"))));
    assert!(world.text().contains("file = \"scenes/a.npz\" # hers"), "{}", world.text());
    assert_eq!(world.files[&place("y.toml").display().to_string()], world.text().as_bytes());
    assert!(!world.salon.document.as_ref().unwrap().is_changed() && is_held(&world));
    world.run(Command::Save(Destination::Path(place("scenes/z.toml"))));
    assert!(world.text().contains("file = \"a.npz\""), "{}", world.text());
    // A scene without a file has no folder.
    let mut world = World::new();
    let whole = place("grooms/a.npz").display().to_string();
    world.run(Command::File(whole.clone()));
    assert!(world.text().contains(&whole) && is_held(&world), "{}", world.text());
}

#[test]
fn unusable_files_are_reported_and_change_nothing() {
    let mut world = World::new();
    world.small("curly");
    let text = world.text().to_owned();
    for (name, bytes, problem) in [
        ("a.docx", &b"hair"[..], "cannot be opened here"),
        ("a.obj", b"v 0 0 0\n", "neither faces nor lines"),
        ("a.usda", b"#usda 1.0\ndef Xform \"x\"\n{\n}\n", "neither meshes nor curves"),
        ("a.ply", b"ply\n", "header"),
        ("a.pbrt", b"Shape", "cannot be opened here"),
    ] {
        world.drop(name, bytes);
        let message = last(&world);
        assert!(message.is_error && message.text.contains(problem), "{name}: {message:?}");
        assert_eq!(world.text(), text);
        assert!(world.salon.is_settled());
    }
    world.run(Command::File("nowhere.abc".into()));
    assert!(last(&world).text.contains("there is no file"), "{:?}", last(&world));
    assert_eq!(world.text(), text);
}
