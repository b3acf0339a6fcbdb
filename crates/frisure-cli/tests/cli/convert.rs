//! `frisure convert`: fewer hairs and points, programs, and what cannot be.

use crate::room::Room;

const SCENE: &str =
    "[hair]\ntype = \"curly\"\nlength = \"8 cm\"\n[wisps]\ncount = 12\nhairs = 200\npoints = 20\n";

/// A room with a groom of 200 hairs of 20 points and 12 guides.
fn room() -> Room {
    let room = Room::new().with("a.toml", SCENE);
    let ran = room.run(&["predict", "a.toml", "-o", "a.usdc", "-o", "a.hair"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    room
}

/// What is said about a conversion that is done.
fn said(room: &Room, arguments: &[&str]) -> String {
    let ran = room.run(&[&["convert", "a.usdc"], arguments].concat());
    assert_eq!(ran.code, Some(0), "{arguments:?}: {}", ran.err);
    ran.out
}

/// Number of strands and of points of a `.hair` file, and its first thickness (cm).
fn header(room: &Room, name: &str) -> (u32, u32, f32) {
    let bytes = std::fs::read(room.path(name)).unwrap();
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    (word(4), word(8), f32::from_bits(word(20)))
}

#[test]
fn fewer_hairs_and_points_are_written_and_told() {
    let room = room();
    let out = said(&room, &["--hairs", "50", "--max-points", "9", "-o", "b.hair"]);
    assert!(out.contains("wrote b.hair (50 of 200 hairs, "), "{out}");
    assert!(out.contains(" times as wide; at most 9 points each, within "), "{out}");
    let (strands, points, wide) = header(&room, "b.hair");
    assert_eq!((strands, points), (50, 450));
    let out = said(&room, &["--hairs", "50", "--keep-widths", "-o", "c.hair"]);
    assert!(out.contains("(50 of 200 hairs, as wide)"), "{out}");
    let (strands, points, narrow) = header(&room, "c.hair");
    assert_eq!((strands, points), (50, 1000));
    assert!((3.0..5.0).contains(&(wide / narrow)), "{}", wide / narrow);
    // The same on any number of threads.
    said(&room, &["--hairs", "50", "--max-points", "9", "--threads", "1", "-o", "d.hair"]);
    let bytes = |name: &str| std::fs::read(room.path(name)).unwrap();
    assert_eq!(bytes("b.hair"), bytes("d.hair"));
}

#[test]
fn a_program_gets_what_it_expects() {
    let room = room();
    let out = said(&room, &["--for", "unity", "-o", "u.abc"]);
    assert!(out.contains("32 points each"), "{out}");
    let out = said(&room, &["--for", "unreal", "--hairs", "100", "-o", "v.abc"]);
    assert!(out.contains("100 of 200 hairs"), "{out}");
    let has = |name: &str, word: &str| {
        let bytes = std::fs::read(room.path(name)).unwrap();
        bytes.windows(word.len()).any(|w| w == word.as_bytes())
    };
    // Unity draws guides as hairs; Unreal needs them.
    assert!(!has("u.abc", "guidesShape") && has("v.abc", "guidesShape"));
    assert!(has("v.abc", "groom_clumpid") && !has("v.abc", "frisure_axis_ratio"));
    said(&room, &["--for", "blender", "-o", "b.usdc", "-o", "b.abc"]);
    let out = said(&room, &["--for", "web", "-o", "w.html", "-o", "w.glb"]);
    assert!(out.contains("wrote w.html (at most 32 points each, within 0.000 mm"), "{out}");
    let page = std::fs::read_to_string(room.path("w.html")).unwrap();
    assert!(page.contains("\"strands\":200") && page.contains("200 hairs"));
}

#[test]
fn what_cannot_be_written_is_told() {
    let room = room();
    let before = room.names();
    let cases: &[(&[&str], i32, &str)] = &[
        (&["--hairs", "0", "-o", "b.hair"], 2, "a whole number between 1 and 10000000"),
        (&["--hairs", "many", "-o", "b.hair"], 2, "a whole number between 1 and 10000000"),
        (&["--hairs", "201", "-o", "b.hair"], 2, "201 hairs are more than the groom has: 200"),
        (&["--max-points", "1", "-o", "b.hair"], 2, "between 2 and 65536"),
        (&["--max-points", "9", "--points", "9", "-o", "b.hair"], 2, "cannot be used with"),
        (&["--keep-widths", "-o", "b.hair"], 2, "--hairs"),
        (&["--content", "guides", "--hairs", "5", "-o", "b.hair"], 2, "no hairs to choose from"),
        (&["--for", "maya", "-o", "b.abc"], 2, "unreal, blender, unity, web"),
        (&["--for", "unreal", "-o", "b.usdc"], 2, "`b.usdc` is not for unreal, which opens .abc"),
        (&["--for", "web", "--unit", "cm", "-o", "b.html"], 2, "a .html file is in metres, z up"),
        (&["--up", "y", "-o", "b.html"], 2, "a .html file is in metres, z up"),
    ];
    for (arguments, code, part) in cases {
        let ran = room.run(&[&["convert", "a.usdc"], *arguments].concat());
        assert_eq!(ran.code, Some(*code), "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
        assert_eq!(room.names(), before, "{arguments:?}");
    }
    let ran = room.run(&["convert", "w.html", "-o", "b.hair"]);
    assert!(ran.code == Some(2) && ran.err.contains("cannot be read"), "{}", ran.err);
}

#[test]
fn what_a_program_will_not_take_as_hair_is_told() {
    let line = "v 0 0 0\nv 0 -0.1 0\nv 0.1 0 0\nv 0.1 0 0\nl 1 2\nl 3 4\n";
    let room = Room::new().with("a.obj", line).with("none.obj", "# nothing\n");
    let ran = room.run(&["convert", "a.obj", "--for", "unreal", "-o", "a.abc"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert!(ran.err.contains("1 of 2 hairs have no length"), "{}", ran.err);
    assert!(ran.err.contains("no head in it") && ran.err.contains("`unreal`"), "{}", ran.err);
    let ran = room.run(&["convert", "none.obj", "-o", "b.usdc"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("there is no hair in `none.obj`"), "{}", ran.err);
    // A unit is no remedy for a file that is damaged.
    assert!(!ran.err.contains("--from-unit"), "{}", ran.err);
}
