//! `frisure style`: steps put into a scene, taken out and listed; and scenes left alone.

use std::fs;

use crate::room::Room;

const SCENE: &str = "# Mine\n[hair]   # all of it\nlength = \"20 cm\"\n\n# first\n[[step]]\nwet = {}\n\n\
                     [output]\nwidth = 64 # small\n";

fn room() -> Room {
    Room::new().with("a.toml", SCENE)
}

fn text(room: &Room, name: &str) -> String {
    fs::read_to_string(room.path(name)).expect("a file")
}

#[test]
fn steps_are_added_where_they_belong() {
    let room = room();
    let ran = room.run(&["style", "a.toml", "--step", "dry={}", "--step", "humidity = 0.9"]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(0), "a.toml has 3 steps\n"), "{}", ran.err);
    let added = "wet = {}\n\n[[step]]\ndry = {}\n\n[[step]]\nhumidity = 0.9\n";
    assert_eq!(text(&room, "a.toml"), SCENE.replace("wet = {}\n", added));
    let ran = room.run(&["style", "a.toml", "--at", "1", "--quiet", "--step", "comb={to='left'}"]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(0), ""), "{}", ran.err);
    let list = room.run(&["style", "a.toml", "--list"]).out;
    assert_eq!(list, "1  comb = { to = \"left\" }\n2  wet = {}\n3  dry = {}\n4  humidity = 0.9\n");
    for _ in 0..3 {
        assert_eq!(room.run(&["style", "a.toml", "--remove", "1"]).code, Some(0));
    }
    assert_eq!(room.run(&["style", "a.toml", "--list"]).out, "1  humidity = 0.9\n");
    let ran = room.run(&["style", "a.toml", "--remove", "1", "--at", "1", "--step", "dry = {}"]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(0), "a.toml has 1 step\n"));
    assert_eq!(room.run(&["style", "a.toml", "--remove", "1"]).out, "a.toml has no steps\n");
    assert_eq!(room.run(&["style", "a.toml", "--list"]).out, "the scene has no steps\n");
    let bare = SCENE.replace("# first\n[[step]]\nwet = {}\n\n", "");
    assert_eq!(text(&room, "a.toml"), bare);
    assert_eq!(room.names(), ["a.toml"]);
}

#[test]
fn the_scene_may_go_elsewhere() {
    let room = room();
    let expected = SCENE.replace("wet = {}\n", "wet = {}\n\n[[step]]\ndry = {}\n");
    let ran = room.run(&["style", "a.toml", "--step", "dry = {}", "-o", "b.toml"]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(0), "b.toml has 2 steps\n"), "{}", ran.err);
    assert_eq!((text(&room, "b.toml"), text(&room, "a.toml")), (expected.clone(), SCENE.into()));
    let ran = room.run(&["style", "a.toml", "--step", "dry = {}", "-o", "-"]);
    assert_eq!((ran.code, ran.out), (Some(0), expected.clone()));
    let ran = room.feed(&["style", "-", "--step", "dry = {}"], SCENE.as_bytes());
    assert_eq!((ran.code, ran.out), (Some(0), expected));
    assert_eq!(room.names(), ["a.toml", "b.toml"]);
}

#[test]
fn what_is_wrong_leaves_the_scene_alone() {
    let cases: &[(&[&str], &str)] = &[
        (&["--step", "wett = {}"], " --step:1:1\n"),
        (&["--step", "dry = {}", "--step", "wet = { to = 2 }"], " --step:1:14\n"),
        (&["--step", "wet = {"], " --step:1:8\n"),
        (&["--step", ""], "this step does nothing"),
        (&["--step", "[[step]]\nwet = {}"], "leave out `[[step]]`"),
        (&["--step", "[[step]] wet = {}"], "leave out `[[step]]`"),
        (&["--step", "dry"], "write `dry = {}`"),
        (&["--step", "wet = {} dry = {}"], "give each a `--step` of its own"),
        (&["--step", "cut = 'chin'"], "write `cut = { below = 'chin' }`"),
        (&["--step", "cut = { length = 8 }"], "did you mean \"8 cm\"?"),
        (&["--step", "dry = {}", "--at", "3"], "there is no step 3; the scene has 1"),
        (&["--remove", "2"], "there is no step 2; the scene has 1"),
        (&["--step", "dry = {}", "--at", "0"], "steps are numbered from 1"),
        (&["--at", "1", "--remove", "1"], "--step"),
        (&["--list", "--remove", "1"], "cannot be used with"),
        (&[], "required"),
    ];
    let room = room();
    for (arguments, part) in cases {
        let ran = room.run(&[&["style", "a.toml"], *arguments].concat());
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
        assert_eq!((text(&room, "a.toml").as_str(), room.names().len()), (SCENE, 1));
    }
    let wrong = room.run(&["style", "a.toml", "--step", "cut = { below = \"brow\" }"]);
    insta::assert_snapshot!("step", wrong.err);
    // The scene itself.
    let room = Room::new().with("b.toml", "[hare]\n");
    let ran = room.run(&["style", "b.toml", "--step", "dry = {}"]);
    assert!(ran.code == Some(2) && ran.err.contains(" b.toml:1:2\n"), "{}", ran.err);
}

#[test]
fn a_scene_that_cannot_be_written_is_as_it_was() {
    let room = room();
    let path = room.path("a.toml");
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let ran = room.run(&["style", "a.toml", "--step", "dry = {}"]);
    assert_eq!(ran.code, Some(1));
    assert!(ran.err.contains("`a.toml` is read-only"), "{}", ran.err);
    let ran = room.run(&["style", "a.toml", "--step", "dry = {}", "-o", "none/a.toml"]);
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert_eq!((text(&room, "a.toml").as_str(), room.names().len()), (SCENE, 1));
}

#[cfg(unix)]
#[test]
fn a_scene_keeps_its_permissions_and_a_link_its_target() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let room = room();
    fs::set_permissions(room.path("a.toml"), fs::Permissions::from_mode(0o640)).unwrap();
    symlink("a.toml", room.path("link.toml")).unwrap();
    assert_eq!(room.run(&["style", "link.toml", "--step", "dry = {}"]).code, Some(0));
    assert!(fs::symlink_metadata(room.path("link.toml")).unwrap().is_symlink());
    assert!(text(&room, "a.toml").contains("dry = {}"));
    assert_eq!(fs::metadata(room.path("a.toml")).unwrap().permissions().mode() & 0o777, 0o640);
}

#[test]
fn several_at_once_lose_no_step() {
    let room = Room::new().with("scene.toml", "name = \"Busy\"\n");
    let add = || room.command(&["style", "scene.toml", "--step", "dry = {}"]).spawn().unwrap();
    let running: Vec<_> = (0..8).map(|_| add()).collect();
    for child in running {
        assert!(child.wait_with_output().unwrap().status.success());
    }
    let text = fs::read_to_string(room.path("scene.toml")).unwrap();
    assert_eq!(text.matches("dry = {}").count(), 8, "{text}");
}

#[test]
fn a_scene_does_not_replace_a_groom_or_a_picture() {
    let room = room().with("gg.hair", "hair").with("a.png", "picture");
    let before = text(&room, "a.toml");
    for (output, hint) in [
        ("gg.hair", "`frisure predict SCENE -o gg.hair`"),
        ("new.usda", "`frisure predict SCENE -o new.usda`"),
        ("a.png", "`-o` writes the scene"),
        ("scene", "such as `styled.toml`"),
    ] {
        let ran = room.run(&["style", "a.toml", "--step", "wet = {}", "-o", output]);
        assert_eq!(ran.code, Some(2), "{}", ran.err);
        assert!(ran.err.contains(&format!("`{output}` does not end in .toml")), "{}", ran.err);
        assert!(ran.err.contains(hint), "{}", ran.err);
    }
    assert_eq!((text(&room, "gg.hair"), text(&room, "a.toml")), ("hair".to_owned(), before));
    assert!(!room.path("new.usda").exists() && !room.path("scene").exists());
}
