//! Wrong scenes, heads and outputs: exit code 2 or 1, a sentence that helps, and no file.

use crate::room::Room;

/// A small triangle mesh of 20 cm with a group and without texture coordinates.
const HEAD: &str = "v 0 0.2 0\nv 0.1 0 0.05\nv -0.1 0 0.05\nv 0 0 -0.1\n\
                    g top\nf 1 3 2\ng rest\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const QUICK: &str =
    "[wisps]\ncount = 3\nhairs = 20\npoints = 8\n[output]\nwidth = 32\nheight = 32\n";

fn room() -> Room {
    Room::new().with("quick.toml", QUICK)
}

/// What is said about a scene, with the place it must name.
fn about(scene: &str, place: &str) -> String {
    let ran = room().with("a.toml", scene).run(&["predict", "a.toml", "-o", "a.hair"]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{scene}\n{}", ran.err);
    assert!(ran.err.contains(&format!(" a.toml:{place}\n")), "{place}: {}", ran.err);
    ran.err
}

#[test]
fn a_fault_in_a_scene_is_shown_with_its_line() {
    let fault = about("seed = 1\n\n[hair]\nlength = \"5 m\" # long\n", "4:10");
    insta::assert_snapshot!("fault-range", fault);
    insta::assert_snapshot!("fault-key", about("[hair]\nlenght = \"5 cm\"\n", "2:1"));
    let both = "[hair.fibre]\ndiameter = \"70 um\"\n\n\n\nmean_radius = \"35 um\"\n";
    insta::assert_snapshot!("fault-twice", about(both, "6:15"));
    insta::assert_snapshot!("fault-toml", about("[hair\nlength = 1\n", "1:6"));
}

#[test]
fn a_number_that_nothing_can_have_is_told_with_its_key_and_range() {
    for (line, place, said) in [
        (
            "seed = 99999999999999999999",
            "1:8",
            "`seed` is 99999999999999999999; it must be within 2^63 of 0",
        ),
        (
            "hair.fibre.eccentricity = 0.9999",
            "1:27",
            "`hair.fibre.eccentricity` is 0.9999; it must be at most 0.9987",
        ),
        ("hair.fibre.youngs_modulus = 1e18", "1:29", "between 1 MPa and 1000 GPa on a head"),
        ("hair.fibre.shear_modulus = \"1 kPa\"", "1:28", "between 0.1 MPa and 1000 GPa on a head"),
        ("hair.fibre.density = \"1000 g/cm^3\"", "1:22", "between 0.01 and 20 g/cm^3 on a head"),
    ] {
        let told = about(&format!("{line}\n"), place);
        assert!(told.contains(said), "{line}: {told}");
    }
    let table = "id,s (mm),x (mm),y (mm),z (mm)\n";
    let ran = room().with("f.csv", table).run(&[
        "fit",
        "f.csv",
        "--known",
        "stiffness-over-weight=1e300",
    ]);
    assert!(ran.code == Some(2) && ran.err.contains(" is 1e300; it must be "), "{}", ran.err);
}

#[test]
fn a_quote_that_never_ends_is_told() {
    let table = "length (cm),radius (mm)\n# \"a remark\n25,\"5\n26,6\n";
    let ran = room().with("m.csv", table).run(&["measured", "m.csv"]);
    assert!(ran.code == Some(2) && ran.err.contains("`m.csv` is not"), "{}", ran.err);
    assert!(
        ran.err.contains("a cell on line 3 begins with a quote that never ends"),
        "{}",
        ran.err
    );
}

#[test]
fn quotes_around_whole_cells_are_read_whatever_ends_a_line() {
    for end in ["\n", "\r\n", "\r"] {
        let rows =
            ["radius (mm),pitch (mm),note", "\"5\",\"20\",\"a, \"\"b\"\"\"", "6,22,\"c\" ", ""];
        let ran = room().with("m.csv", rows.join(end)).run(&["measured", "m.csv"]);
        assert_eq!(ran.code, Some(0), "{end:?}: {}", ran.err);
    }
    let table = "hair,note,diameter (um)\na,\"x,70\nb,\"y,72\n";
    let ran = room().with("m.csv", table).run(&["measured", "m.csv"]);
    assert!(
        ran.code == Some(2) && ran.err.contains("a cell on line 3 goes on behind"),
        "{}",
        ran.err
    );
}

#[test]
fn what_is_long_is_quoted_in_part() {
    let long = "a".repeat(1 << 20);
    for (scene, said) in [
        (format!("[hair]\ntype = \"{long}\"\n"), "aaa…; it must be one of"),
        (format!("seed = 1\n{long} = 1\n"), "aaa…`"),
        (format!("seed = [\n{}]\n", "1,\n".repeat(1 << 18)), "…; it must be"),
        (format!("name = {long}\n"), "TOML"),
    ] {
        let ran = room().with("a.toml", &scene).run(&["predict", "a.toml"]);
        assert_eq!(ran.code, Some(2));
        assert!(ran.err.len() < 20_000, "{} bytes", ran.err.len());
        assert!(ran.err.contains(said) || said == "TOML", "{}", ran.err);
    }
}

#[test]
fn commands_check_what_they_use() {
    let room = room().with("a.toml", "[hair]\nlength = 0\n");
    for command in ["predict", "hair"] {
        let ran = room.run(&[command, "a.toml"]);
        assert_eq!(ran.code, Some(2));
        assert!(ran.err.contains(" a.toml:2:10\n"), "{}", ran.err);
    }
    // What a head alone needs is wrong for one hair and for its steps, too.
    let room = room.with("b.toml", "[hair]\nlength = 0.1\n[contact]\nfriction = -1\n");
    for command in [
        &["predict", "b.toml"][..],
        &["hair", "b.toml"],
        &["style", "b.toml", "--step", "wet = {}"],
    ] {
        let ran = room.run(command);
        assert_eq!(ran.code, Some(2), "{command:?}");
        assert!(ran.err.contains(" b.toml:4:12\n") && ran.err.contains("0 and 1.5"), "{}", ran.err);
    }
    // One hair may be longer than any head's.
    let ran = room.feed(&["hair", "-"], b"[hair]\nlength = \"5 m\"\nfibre.diameter = \"1 cm\"");
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let ran = room.feed(&["hair", "-"], b"[equilibrium]\nelements = 10_000_000");
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("between 1 and 10000"), "{}", ran.err);
}

#[test]
fn scenes_that_are_no_files() {
    let room = room().with("binary.toml", [0xff, 0xfe, 0x00]);
    std::fs::create_dir(room.path("folder")).unwrap();
    for (scene, part) in [
        ("none.toml", "there is no file `none.toml`"),
        ("folder", "`folder` is a directory, not a file"),
        ("binary.toml", "is not UTF-8 text (byte 1 of line 1)"),
    ] {
        let ran = room.run(&["hair", scene]);
        assert_eq!(ran.code, Some(2));
        assert!(ran.err.contains(part), "{}", ran.err);
    }
    let ran = room.feed(&["hair", "-"], &[b'#'; (16 << 20) + 1]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("larger than 16777216 bytes"), "{}", ran.err);
}

#[test]
fn more_threads_than_a_machine_has_are_refused() {
    let room = room();
    for (threads, code, part) in [
        ("999999", 2, "`RAYON_NUM_THREADS` asks for 999999 threads"),
        ("abc", 2, "`RAYON_NUM_THREADS` is \"abc\"; it must be a whole number of threads, at most"),
        ("-1", 2, "it must be a whole number"),
        ("", 0, ""),
        ("2", 0, ""),
    ] {
        let ran = room.command(&["hair", "quick.toml"]).env("RAYON_NUM_THREADS", threads).output();
        let ran = ran.unwrap();
        let err = String::from_utf8_lossy(&ran.stderr);
        assert_eq!(ran.status.code(), Some(code), "{err}");
        assert!(err.contains(part), "{err}");
    }
}

#[test]
fn names_command_no_terminal_and_fill_no_screen() {
    let name = r#"name = "\u001b[31mred\u0007\n\u001b]0;title\u0007\u009b\u007f\tend""#;
    let long = format!("name = \"{}\"", "a".repeat(1 << 20));
    let room = room()
        .with("a.toml", format!("{name}\n{QUICK}"))
        .with("long.toml", format!("{long}\n{QUICK}"));
    let ran = room.run(&["predict", "a.toml"]);
    let shown = r"\u{1b}[31mred\u{7}\n\u{1b}]0;title\u{7}\u{9b}\u{7f}\tend: ";
    assert!(ran.code == Some(0) && ran.out.starts_with(shown), "{}", ran.out.escape_debug());
    let ran = room.run(&["predict", "long.toml"]);
    assert!(ran.code == Some(0) && ran.out.len() < 1000, "{} bytes", ran.out.len());
    assert!(ran.out.contains("aaa…: "), "{}", ran.out);
    // Names of files: of every kind that is written.
    #[cfg(unix)]
    {
        let files = ["o\u{1b}[2J.hair", "i\u{7}\n.png", "r\u{9b}.json"];
        let ran = room
            .run(&["predict", "a.toml", "-o", files[0], "--image", files[1], "--report", files[2]]);
        let lines: Vec<&str> = ran.out.lines().filter(|line| line.starts_with("wrote ")).collect();
        assert_eq!(lines.len(), 3, "{}", ran.out);
        let ran_convert = room.run(&["convert", files[0], "-o", "c\u{1b}.obj"]);
        let ran_style = room.run(&["style", "a.toml", "--step", "wet = {}", "-o", "s\u{1b}.toml"]);
        for ran in [ran, ran_convert, ran_style] {
            assert_eq!(ran.code, Some(0), "{}", ran.err);
            let commands = |c: char| c.is_control() && c != '\n';
            assert!(!(ran.out + &ran.err).contains(commands));
        }
    }
}

/// The system ends a program at the limit of files, if it does not ask for an error.
#[cfg(target_os = "linux")]
#[test]
fn a_file_beyond_the_limit_is_an_error_and_leaves_nothing() {
    let room = room();
    let program = env!("CARGO_BIN_EXE_frisure");
    let line = format!("ulimit -f 1; exec {program} predict quick.toml -o a.obj");
    let mut shell = std::process::Command::new("sh");
    let ran = shell.current_dir(room.path("")).args(["-c", &line]).output().unwrap();
    let err = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(1), "{err}");
    assert!(err.contains("`a.obj`") && err.contains("too large"), "{err}");
    assert_eq!(room.names(), ["quick.toml"]);
}

#[cfg(target_os = "linux")]
/// A `.hair` file of straight hairs of 20 cm, of so many points each.
fn straight_groom(hairs: u32, points: u32) -> Vec<u8> {
    let mut bytes = b"HAIR".to_vec();
    // With points and nothing else for each of them (bit 1).
    for number in [hairs, hairs * points, 2, points - 1] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.resize(128, 0);
    for hair in 0..hairs {
        for point in 0..points {
            let across = f64::from(hair) / f64::from(hairs) - 0.5;
            let down = f64::from(point) / f64::from(points - 1);
            for x in [0.2 * across, 0.0, 1.7 - 0.2 * down] {
                bytes.extend((x as f32).to_le_bytes());
            }
        }
    }
    bytes
}

#[test]
fn a_long_word_of_a_file_or_an_argument_is_quoted_in_part() {
    let long = "x".repeat(1_000_000);
    let room = room().with("a.obj", format!("v 0 0 0\nl {long}\n"));
    let room = room.with("a.csv", format!("diameter (um)\n{long}\n"));
    for arguments in [
        &["convert", "a.obj", "-o", "b.ply"][..],
        &["measured", "a.csv"],
        &["convert", &long[..9000]],
    ] {
        let ran = room.run(arguments);
        assert_eq!(ran.code, Some(2), "{}", ran.err);
        assert!(ran.err.len() < 1000, "{} bytes", ran.err.len());
    }
}

#[test]
fn what_has_no_room_in_memory_is_refused_before_the_work() {
    let large = format!("{QUICK}width = 16384\nheight = 16384\n");
    let large = large.replacen("width = 32\nheight = 32\n", "", 1);
    let kinky = "hair.type = \"african-kinky\"\n[head]\nmodel = \"african-woman\"\n";
    let room = room().with("a.toml", large).with("quick.toml", QUICK).with("k.toml", kinky);
    let room = room.with("many.hair", straight_groom(20_000, 100));
    for (limit, arguments, code) in [
        // These went on for seconds, and were ended by the system.
        (2_000_000, "predict k.toml --image a.png", 2),
        (700_000, "hair quick.toml --points 1000000 --json", 2),
        (4_000_000, "predict a.toml --image a.png", 2),
        (4_000_000, "render quick.toml --size 8192x8192 -o a.png", 2),
        (4_000_000, "predict quick.toml --image a.png", 0),
        // These are read, and the picture is what has no room.
        (600_000, "render many.hair --paths 1 --size 64x64 -o a.png", 2),
        (500_000, "view many.hair --size 64x64 -o a.png", 2),
        (4_000_000, "view many.hair --size 64x64 -o a.png", 0),
    ] {
        let program = env!("CARGO_BIN_EXE_frisure");
        let line = format!("ulimit -v {limit}; exec {program} --threads 2 {arguments}");
        let mut shell = std::process::Command::new("sh");
        let ran = shell.current_dir(room.path("")).args(["-c", &line]).output().unwrap();
        let err = String::from_utf8_lossy(&ran.stderr);
        assert_eq!(ran.status.code(), Some(code), "{err}");
        assert_eq!(err.contains("B of memory, and "), code == 2, "{err}");
    }
}

#[test]
fn heads_that_are_none_point_at_their_key() {
    let cases: &[(&str, &str, &str, &str)] = &[
        ("", "", "2:8", "it has no vertices"),
        ("v 0 0 0\n", "", "2:8", "it has vertices and no faces"),
        ("v 0 0 0\nv 0.2 0 0\nf 1 2 2\n", "", "2:8", "no face with an area"),
        ("v 0 0 0\nf 1 2 3\n", "", "2:8", "head.obj:2: the face names vertex 2"),
        ("v 0 0 nan\n", "", "2:8", "head.obj:1: `nan` is not a finite number"),
        (
            "v 0 200 0\nv 100 0 50\nv -100 0 50\nf 1 2 3\n",
            "unit = \"m\"",
            "2:8",
            "set `unit = \"mm\"`",
        ),
        (HEAD, "scalp_colour = \"red\"", "3:16", "no `red` at its vertices; it has none"),
        (HEAD, "scalp_group = \"hat\"", "3:15", "no group `hat`; it has `rest`, `top`"),
        (HEAD, "scalp_mask = \"mask.png\"", "2:8", "texture coordinates"),
        (HEAD, "scalp_weights = \"w.txt\"", "3:17", "there is no file"),
        (HEAD, "scalp_weights = \"quick.toml\"", "3:17", "quick.toml:1: `[wisps]` is not a number"),
        (HEAD, "scale = 1e-9", "2:8", "2.000e-10 m across"),
    ];
    for (head, key, place, part) in cases {
        let scene = format!("[head]\nmesh = \"head.obj\"\n{key}\n");
        let room = room().with("a.toml", scene).with("head.obj", head);
        let ran = room.run(&["predict", "a.toml", "-o", "a.hair"]);
        assert_eq!(ran.code, Some(2), "{}", ran.err);
        assert!(ran.err.contains(&format!(" a.toml:{place}\n")), "{place}: {}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
        assert_eq!(room.names(), ["a.toml", "head.obj", "quick.toml"]);
    }
    about("[head]\nmesh = \"none.obj\"\n", "2:8");
    about("[head]\nmesh = \".\"\n", "2:8");
    // A scalp in the air.
    let cap = format!("{HEAD}v 0 0.5 0\nv 0.1 0.5 0\nv 0 0.5 0.1\ng cap\nf 5 6 7\n");
    let scene = "[head]\nmesh = 'head.obj'\nscalp_group = 'cap'";
    let ran = room().with("a.toml", scene).with("head.obj", cap).run(&["predict", "a.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("cm away from the head: hair would grow in the air"), "{}", ran.err);
    assert!(about("[groom]\nhead = 'mannequin'\n", "2:1").contains("`head_mesh` or `head_model`"));
    // A scalp on which nothing grows.
    let zeros = room().with("head.obj", HEAD).with("w.txt", "0\n0\n0\n0\n");
    let zeros = zeros.with("a.toml", "[head]\nmesh = 'head.obj'\nscalp_weights = 'w.txt'");
    let ran = zeros.run(&["predict", "a.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("the scalp has no area"), "{}", ran.err);
}

#[test]
fn outputs_are_checked_before_the_work() {
    let room = room().with("old.hair", "old").with("file", "");
    let path = room.path("old.hair");
    let mut permissions = std::fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).unwrap();
    std::fs::create_dir(room.path("folder.hair")).unwrap();
    let cases: &[(&[&str], i32, &str)] = &[
        (&["-o", "a.xyz"], 2, "known are .hair, .obj, .ply"),
        (&["-o", "a"], 2, "known are .hair, .obj, .ply"),
        (&["-o", "a.png"], 2, "pictures go to `--image`"),
        (&["-o", "a.json"], 2, "numbers go to `--report`"),
        (&["--image", "a.jpg"], 2, "pictures are written as `.png`"),
        (&["-o", "a.hair", "-o", "a.hair"], 2, "`a.hair` is given twice"),
        (&["-o", "a.hair", "-o", "./x/../a.hair"], 2, "is given twice"),
        (&["-o", "a.glb", "--unit", "cm"], 2, "a .glb file is in metres, y up"),
        (&["-o", "a.glb", "--up", "z"], 2, "without `--unit` and `--up`"),
        (&["-o", "a.ply", "--report", "a.ply"], 2, "`a.ply` is given twice"),
        (&["--report", "quick.toml"], 2, "`quick.toml` is read and would be overwritten"),
        (&["-o", "old.hair"], 1, "`old.hair` is read-only"),
        (&["-o", "folder.hair"], 1, "`folder.hair` is a directory"),
        (&["-o", "file/a.hair"], 1, "cannot write `file`"),
        (&["-o", "/proc/none/a.hair"], 1, "cannot write `/proc/none`"),
    ];
    std::fs::create_dir(room.path("x")).unwrap();
    let before = room.names();
    for (arguments, code, part) in cases {
        let ran = room.run(&[&["predict", "quick.toml"], *arguments].concat());
        assert_eq!(ran.code, Some(*code), "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
        assert_eq!(room.names(), before, "{arguments:?}");
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
}
