//! `frisure batch`: whole parts, the same bytes by any way, and nothing lost.

use std::collections::BTreeMap;
use std::fs;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::room::Room;

/// Heads that take no time.
const QUICK: &str = "\
rows = 2
volume = false
[set]
wisps = { count = 3, hairs = 20, points = 8 }
[vary]
\"hair.length\" = { from = \"2 cm\", to = \"6 cm\" }
\"hair.type\" = [\"straight\", \"curly\"]
";

fn spec(samples: usize) -> String {
    format!("samples = {samples}\n{QUICK}")
}

/// The parts in a folder, with their bytes.
fn parts(room: &Room, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(room.path(folder)).into_iter().flatten();
    let file = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().expect("a name in UTF-8");
        name.starts_with("part-").then(|| (name, fs::read(entry.path()).expect("a file")))
    };
    entries.filter_map(|entry| file(entry.expect("an entry"))).collect()
}

fn well(room: &Room, arguments: &[&str]) -> String {
    let ran = room.run(&[&["batch"], arguments].concat());
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{arguments:?}");
    ran.out
}

#[test]
fn shards_and_threads_make_the_same_bytes() {
    let room = Room::new().with("a.toml", spec(7));
    let out = well(&room, &["a.toml", "-o", "whole", "--threads", "1"]);
    assert!(out.contains("7 heads are there, 7 of them new"), "{out}");
    for shard in ["1/3", "2/3", "3/3"] {
        well(&room, &["a.toml", "-o", "shards", "--shard", shard, "--threads", "2"]);
    }
    let whole = parts(&room, "whole");
    let names: Vec<&str> = whole.keys().map(String::as_str).collect();
    let expected = [0, 2, 4, 6].map(|first| format!("part-{first:09}.parquet"));
    assert_eq!(names, expected);
    assert!(whole == parts(&room, "shards"));

    // Another seed, other heads.
    let room = room.with("b.toml", format!("seed = 2\n{}", spec(7)));
    well(&room, &["b.toml", "-o", "other", "--quiet"]);
    assert!(whole != parts(&room, "other"));
}

#[test]
fn views_are_listed_and_written_beside_the_parts() {
    let views =
        "views = { cameras = ['front', { azimuth = '9 deg' }], size = [24, 16], hairs = 9 }";
    let room = Room::new().with("a.toml", format!("{views}\n{}", spec(2)));
    let out = well(&room, &["a.toml", "--list"]);
    let lines: Vec<&str> = out.lines().collect();
    assert!(lines[0].ends_with(",hair.type,views"), "{out}");
    assert!(lines[1..].iter().all(|line| line.ends_with(",front camera-01")), "{out}");
    let out = well(&room, &["a.toml", "-o", "heads"]);
    assert!(out.contains("2 heads with 2 views of 24 × 16 pixels each"), "{out}");
    assert!(room.path("heads/_views/views-000000000.parquet").is_file());
}

/// Waits until a run has written some parts.
fn await_parts(room: &Room, child: &mut Child, count: usize) {
    let since = Instant::now();
    while parts(room, "cut").len() < count && since.elapsed() < Duration::from_secs(60) {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be killed");
        sleep(Duration::from_millis(5));
    }
}

#[cfg(unix)]
#[test]
fn what_was_killed_goes_on_to_the_same_bytes() {
    let room = Room::new().with("a.toml", spec(20));
    let mut child = room.command(&["batch", "a.toml", "-o", "cut"]).spawn().unwrap();
    await_parts(&room, &mut child, 2);
    // SIGKILL: nothing can be cleaned up.
    child.kill().unwrap();
    child.wait().unwrap();
    let left = parts(&room, "cut");
    assert!((2..10).contains(&left.len()), "{} parts", left.len());

    // Ctrl-C: what was finished stays, and it says so.
    let child = room.command(&["batch", "a.toml", "-o", "cut"]).spawn().unwrap();
    sleep(Duration::from_millis(300));
    let id = child.id().to_string();
    std::process::Command::new("kill").args(["-INT", &id]).status().unwrap();
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{err}");
    assert!(err.contains("of 20 heads are in `cut`; the same command resumes"), "{err}");

    let out = well(&room, &["a.toml", "-o", "cut"]);
    assert!(out.contains("of which are there already"), "{out}");
    well(&room, &["a.toml", "-o", "whole"]);
    let cut = parts(&room, "cut");
    assert!(cut == parts(&room, "whole"));
    assert!(left.iter().all(|(name, bytes)| cut.get(name) == Some(bytes)));
}

#[test]
fn a_longer_batch_keeps_the_heads_that_are_there() {
    let room = Room::new().with("a.toml", spec(3)).with("b.toml", spec(6));
    well(&room, &["a.toml", "-o", "heads"]);
    let first = parts(&room, "heads");
    let out = well(&room, &["b.toml", "-o", "heads"]);
    // The part that was not full is made again.
    assert!(out.contains("2 of which are there already"), "{out}");
    let all = parts(&room, "heads");
    assert_eq!(all["part-000000000.parquet"], first["part-000000000.parquet"]);
    well(&room, &["b.toml", "-o", "fresh"]);
    assert!(all == parts(&room, "fresh"));
    let shorter = room.run(&["batch", "a.toml", "-o", "heads"]);
    assert_eq!(shorter.code, Some(2));
    assert!(shorter.err.contains("begins with head 4; the batch has 3"), "{}", shorter.err);
}

#[test]
fn a_head_that_cannot_be_is_a_row_and_no_end() {
    // Half of these lengths are below zero.
    let text =
        spec(6).replace("{ from = \"2 cm\", to = \"6 cm\" }", "{ normal = [\"2 mm\", \"4 cm\"] }");
    let room = Room::new().with("a.toml", text);
    let out = well(&room, &["a.toml", "-o", "heads"]);
    assert!(out.contains("failed, the first as head "), "{out}");
    assert!(out.contains("it must be between 1 mm and 3 m"), "{out}");
    assert_eq!(parts(&room, "heads").len(), 3);
}

#[test]
fn folders_of_something_else_are_left_alone() {
    let room = Room::new().with("a.toml", spec(2)).with("b.toml", spec(2).replace("6 cm", "7 cm"));
    well(&room, &["a.toml", "-o", "heads"]);
    let before = parts(&room, "heads");
    let other = room.run(&["batch", "b.toml", "-o", "heads"]);
    assert_eq!(other.code, Some(2), "{}", other.err);
    assert!(other.err.contains("belongs to another batch"), "{}", other.err);
    assert!(before == parts(&room, "heads"));
    // Comments and what comes to the same do not make another batch.
    let room = room.with("c.toml", spec(2).replace("\"2 cm\"", "\"20 mm\"") + "# short");
    assert!(well(&room, &["c.toml", "-o", "heads"]).contains("2 of which are there already"));

    fs::write(room.path("heads/part-000000000.parquet"), "no part").unwrap();
    let broken = room.run(&["batch", "a.toml", "-o", "heads"]);
    assert_eq!(broken.code, Some(2));
    assert!(broken.err.contains("is no part of a batch"), "{}", broken.err);
    let room = room.with("file", "");
    let file = room.run(&["batch", "a.toml", "-o", "file"]);
    assert_eq!(file.code, Some(1), "{}", file.err);
}

#[test]
fn heads_are_listed_and_made_again() {
    let room = Room::new().with("a.toml", spec(5));
    let table = well(&room, &["a.toml", "--list"]);
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "index,seed,hair.length,hair.type");
    assert_eq!(lines.len(), 6);
    let length = |line: &str| line.split(',').nth(2).unwrap().parse::<f64>().unwrap();
    assert!(lines[1..].iter().all(|line| (0.02..=0.06).contains(&length(line))), "{table}");
    let second = well(&room, &["a.toml", "--list", "--shard", "2/2"]);
    assert_eq!(second.lines().skip(1).collect::<Vec<_>>(), lines[3..5]);

    let scene = well(&room, &["a.toml", "--scene", "3"]);
    assert!(scene.contains(lines[4].split(',').nth(2).unwrap()), "{scene}");
    well(&room, &["a.toml", "--scene", "3", "-o", "scenes/one.toml"]);
    let ran = room.run(&["predict", "scenes/one.toml", "-o", "one.npz"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""));
}

#[test]
fn wrong_batches_and_arguments_are_told() {
    let room = Room::new().with("a.toml", spec(5)).with("b.toml", spec(5).replace("6 cm", "6 m"));
    for (arguments, part) in [
        (&["a.toml"][..], "`-o DIR` names the folder"),
        (&["a.toml", "-o", "x", "--shard", "0/3"], "numbered from 1"),
        (&["a.toml", "-o", "x", "--shard", "4/3"], "the last is 3/3"),
        (&["a.toml", "-o", "x", "--shard", "one"], "such as 3/8"),
        (&["a.toml", "--scene", "5"], "there is no head 5; the batch has 5"),
        (&["a.toml", "--scene", "1", "-o", "a.toml"], "would be overwritten"),
        (&["b.toml", "-o", "x"], "between 1 mm and 3 m"),
        (&["none.toml", "-o", "x"], "there is no file `none.toml`"),
    ] {
        let ran = room.run(&[&["batch"], arguments].concat());
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    assert_eq!(room.names(), ["a.toml", "b.toml"]);
}
