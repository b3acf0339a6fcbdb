//! `frisure transfer`: the hair of a groom on another head, and what cannot be.

use crate::room::Room;

const SCENE: &str =
    "[hair]\ntype = \"wavy\"\nlength = \"8 cm\"\n[wisps]\ncount = 12\nhairs = 60\npoints = 12\n";

fn room() -> Room {
    Room::with_groom(SCENE)
}

#[test]
fn a_groom_goes_to_a_person_as_a_scene_has_it() {
    let scene =
        "[head]\nmodel = \"asian-man\"\n[groom]\nfile = \"a.usdc\"\nhead_model = \"mannequin\"\n";
    let room = room().with("b.toml", scene);
    let heads = ["--from", "mannequin", "--to", "asian-man"];
    let ran = room.run(&[&["transfer", "a.usdc", "-o", "b.hair"][..], &heads].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert!(ran.out.contains("60 hairs") && ran.out.contains("groom: "), "{}", ran.out);
    let ran = room.run(&["predict", "b.toml", "-o", "c.hair"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let bytes = |name: &str| std::fs::read(room.path(name)).unwrap();
    assert_eq!(bytes("b.hair"), bytes("c.hair"));
}

#[test]
fn what_cannot_be_is_told() {
    let room = room()
        .with("ball.obj", "f 1 2 3\n")
        .with(
            "both.toml",
            "[groom]\nfile = \"a.usdc\"\nhead_model = \"mannequin\"\nhead_mesh = \"ball.obj\"\n",
        )
        .with("no.toml", "[groom]\nhead_model = \"mannequin\"\n");
    let before = room.names();
    let transfer = |from, to| ["transfer", "a.usdc", "--from", from, "--to", to, "-o", "b.hair"];
    let cases: [(&[&str], &str); 5] = [
        (&transfer("nobody", "mannequin"), "no built-in head of this name: mannequin, "),
        (&transfer("ball.obj", "mannequin"), "ball.obj:1: the face names vertex 1"),
        (&transfer("mannequin", "ball.obj"), "ball.obj:1: the face names vertex 1"),
        (&["predict", "both.toml", "-o", "b.hair"], "head_mesh"),
        (&["predict", "no.toml", "-o", "b.hair"], "`groom.head_model` is about a groom"),
    ];
    for (arguments, expected) in cases {
        let ran = room.run(arguments);
        assert_eq!(ran.code, Some(2), "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(expected), "{arguments:?}: {}", ran.err);
    }
    assert_eq!(room.names(), before);
}
