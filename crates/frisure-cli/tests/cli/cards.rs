//! `frisure cards`: from a scene and from a groom to files, and what cannot be.

use crate::room::Room;

const SCENE: &str = "[hair]\ntype = \"straight\"\nlength = \"8 cm\"\n[wisps]\ncount = 12\nhairs = 400\npoints = 12\n";

const SMALL: [&str; 6] = ["--cards", "20", "--lods", "2", "--texture-size", "256"];

fn room() -> Room {
    Room::with_groom(SCENE)
}

#[test]
fn a_scene_and_its_groom_have_as_many_cards_on_any_number_of_threads() {
    let room = room();
    for (input, output, threads) in
        [("a.toml", "a.glb", "2"), ("a.usdc", "b.glb", "1"), ("a.usdc", "c.glb", "2")]
    {
        let arguments = ["cards", input, "-o", output, "--threads", threads];
        let ran = room.run(&[&arguments[..], &SMALL].concat());
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        assert!(
            ran.out.contains("400 strands, 400 with a length and a width, drawn as 400\n"),
            "{}",
            ran.out
        );
        let cards = |level: &str| -> f64 {
            let mut rows = ran.out.lines().map(str::split_whitespace);
            let row = rows.find_map(|mut row| (row.next() == Some(level)).then_some(row));
            row.and_then(|mut row| row.next()?.parse().ok()).expect("a row of the level")
        };
        // Round locks have two cards, flat ones one: about as many as asked for.
        assert!((15.0..=25.0).contains(&cards("0")), "{}", ran.out);
        assert!((6.0..=10.0).contains(&cards("1")), "{}", ran.out);
    }
    let bytes = |name: &str| std::fs::read(room.path(name)).unwrap();
    assert_eq!(&bytes("a.glb")[..4], b"glTF");
    assert_eq!(bytes("b.glb"), bytes("c.glb"));
}

#[test]
fn files_beside_are_written_once_and_told() {
    let room = room();
    let arguments = ["cards", "a.usdc", "-o", "c/hair.obj", "-o", "c/hair.usda"];
    let ran = room.run(&[&arguments[..], &SMALL].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    for name in ["hair.obj", "hair.mtl", "hair.usda", "hair-lod0-color.png", "hair-lod1-data.png"] {
        assert_eq!(ran.out.matches(&format!("wrote c/{name}\n")).count(), 1, "{name}: {}", ran.out);
        assert!(room.path("c").join(name).is_file(), "{name}");
    }
    let text = std::fs::read_to_string(room.path("c").join("hair.obj")).unwrap();
    assert!(text.contains("mtllib hair.mtl\n") && text.contains("o hair_LOD1\n"));
}

#[test]
fn what_cannot_be_is_told() {
    let room = room().with("dots.obj", "v 0 0 0\nv 0.1 0 0\nl 1 1\nl 2 2\n");
    let before = room.names();
    let cases: &[(&[&str], &str)] = &[
        (&["a.usdc", "-o", "b.ply"], "known are .glb, .obj, .usdc, .usda"),
        (&["a.usdc", "-o", "b.glb", "--cards", "0"], "between 1 and 20000"),
        (&["a.usdc", "-o", "b.glb", "--lods", "9"], "between 1 and 8"),
        (&["a.usdc", "-o", "b.glb", "--texture-size", "32"], "between 64 and 8192"),
        (&["a.usdc", "-o", "b.glb", "--cards", "400", "--texture-size", "64"], "`--texture-size`"),
        (&["a.toml", "-o", "b.glb", "--unit", "cm"], "are for grooms"),
        (&["dots.obj", "-o", "b.glb"], "no strand with a length and a width"),
        (&["a.usdc", "-o", "b.glb", "-o", "b.glb"], "is given twice"),
    ];
    for (arguments, part) in cases {
        let ran = room.run(&[&["cards"], *arguments].concat());
        assert_eq!(ran.code, Some(2), "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
        assert_eq!(room.names(), before, "{arguments:?}");
    }
}
