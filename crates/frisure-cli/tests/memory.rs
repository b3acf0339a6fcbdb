//! Memory that runs out, at any allocation: what was saved before is there, or what was to be saved, as a whole.
//!
//! This program runs itself. With `VICTIM` it does a piece of work with a limit on the memory that it may take; what goes beyond it
//! fails, and Rust then ends the process. Without, it is the test, which tries one limit after the other.

use std::alloc::System;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::time::Duration;

use cap::Cap;
use frisure::files::frame::FrameChoice;
use frisure::formats::groom::{read_groom, write_groom};

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// The environment of a victim: the words of its work, its limit (bytes), and the file for the most that it took.
const VICTIM: &str = "FRISURE_TEST_VICTIM";
const LIMIT: &str = "FRISURE_TEST_LIMIT";
const PEAK: &str = "FRISURE_TEST_PEAK";

const SCENE: &str = r#"
seed = 3
[hair]
type = "caucasian-curly"
length = "8 cm"
[wisps]
count = 6
hairs = 40
[contact]
body = "none"
hair = "none"
"#;

fn main() -> ExitCode {
    match std::env::var(VICTIM) {
        Ok(work) => victim(&work),
        Err(_) => {
            // `cargo test NAME` and `cargo test -- --list` call every test program.
            let mut arguments = std::env::args().skip(1).filter(|a| !a.starts_with("--"));
            let wanted = arguments.next().is_none_or(|name| "memory".contains(&name));
            if wanted && !std::env::args().any(|a| a == "--list") {
                test();
            }
            ExitCode::SUCCESS
        }
    }
}

/// Does its work with as much memory as it is given.
fn victim(work: &str) -> ExitCode {
    let limit = std::env::var(LIMIT).ok().and_then(|bytes| bytes.parse::<usize>().ok());
    let restrict = || {
        let most = limit.map_or(usize::MAX, |bytes| ALLOCATOR.allocated() + bytes);
        ALLOCATOR.set_limit(most).expect("a limit above what is allocated");
    };
    let status = if let Some(to) = work.strip_prefix("save ") {
        let groom = read_groom(Path::new("in.npz"), FrameChoice::default()).expect("a groom");
        restrict();
        match write_groom(Path::new(to), &groom, FrameChoice::default()) {
            Ok(()) => 0,
            Err(_) => 1,
        }
    } else {
        restrict();
        frisure_cli::run(["frisure"].into_iter().chain(work.split(' ')).map(OsString::from))
    };
    if let Ok(path) = std::env::var(PEAK) {
        let taken = ALLOCATOR.max_allocated().to_string();
        std::fs::write(path, taken).expect("a file for the peak");
    }
    status.into()
}

/// Whether a victim did its work.
fn did(folder: &Path, work: &str, limit: Option<usize>, peak: Option<&str>) -> bool {
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    command.current_dir(folder).env(VICTIM, work).env("RAYON_NUM_THREADS", "2");
    if let Some(bytes) = limit {
        command.env(LIMIT, bytes.to_string());
    }
    if let Some(path) = peak {
        command.env(PEAK, path);
    }
    let status = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.expect("a victim").success()
}

/// All files of a folder, by their names.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let file = |entry: std::io::Result<std::fs::DirEntry>| {
        let path = entry.expect("a file").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        (name, std::fs::read(&path).expect("its bytes"))
    };
    entries.map(file).collect()
}

/// Tries limits on the memory of a piece of work, whose files are `named`; returns how many it failed with.
fn starve(work: &str, named: &[&str], limits: impl Fn(usize) -> Vec<usize>) -> usize {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("a.toml"), SCENE).expect("a scene");
    assert!(did(folder.path(), "predict a.toml -o in.npz", None, None));
    let before = |name: &str| match name {
        "a.toml" => SCENE.as_bytes().to_vec(),
        _ => b"what was there".to_vec(),
    };
    // As it is when there is memory.
    assert!(did(folder.path(), work, None, Some("peak")), "{work}");
    let after = files(folder.path());
    let peak: usize = String::from_utf8_lossy(&after["peak"]).parse().expect("a number");
    let mut failed = 0;
    for limit in limits(peak) {
        named.iter().for_each(|name| std::fs::write(path(name), before(name)).expect("a file"));
        let done = did(folder.path(), work, Some(limit), None);
        failed += usize::from(!done);
        for name in named {
            let found = std::fs::read(path(name)).expect("a file");
            let whole = found == after[*name] || !done && found == before(name);
            assert!(whole, "{work} with {limit} bytes: {name} has {} bytes", found.len());
        }
    }
    // The next run removes what those that ended left, once it is old enough not to be another's.
    for name in files(folder.path()).into_keys().filter(|name| name.starts_with(".frisure-")) {
        let file = std::fs::File::options().write(true).open(path(&name)).expect("a hidden file");
        let made = file.metadata().and_then(|found| found.modified()).expect("a time");
        file.set_modified(made - Duration::from_secs(120)).expect("a time");
    }
    assert!(did(folder.path(), work, None, Some("peak")), "{work}");
    let left: Vec<_> = files(folder.path()).into_keys().collect();
    assert_eq!(left, after.into_keys().collect::<Vec<_>>(), "{work}");
    failed
}

fn test() {
    // A save: from nothing to what it needs, by steps smaller than most of its allocations.
    let fine = |_| {
        let next = |k: &usize| Some(k + 32.max(k / 12));
        std::iter::successors(Some(0), next).take_while(|k| *k < 4 << 20).collect()
    };
    for to in ["out.usda", "out.npz"] {
        let failed = starve(&format!("save {to}"), &[to], fine);
        assert!(failed > 20, "only {failed} limits were too small for {to}");
    }
    // Whole commands: shares of what they take.
    let shares = |peak: usize| (1..24).map(|k| peak * k / 20).collect();
    for (work, named) in [
        ("predict a.toml -o out.usdc --report r.json", &["out.usdc", "r.json"][..]),
        ("style a.toml --step wet={}", &["a.toml"]),
    ] {
        let failed = starve(work, named, shares);
        assert!(failed > 5, "only {failed} limits were too small for {work}");
    }
}
