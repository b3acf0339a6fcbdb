//! What saving leaves as it was: links, modes, owners, and files of others.
#![cfg(unix)]

use std::fs::{self, File, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::time::Duration;

use frisure_files::{WriteError, check_destination, write_atomically};

#[test]
fn a_link_to_a_file_that_is_not_there_yet_stays_a_link() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("deep")).unwrap();
    symlink("second", path("first")).unwrap();
    symlink("deep/file", path("second")).unwrap();
    write_atomically(&path("first"), |out| out.write_all(b"new")).unwrap();
    assert_eq!(fs::read(path("deep/file")).unwrap(), b"new");
    assert_eq!(fs::read_link(path("first")).unwrap().to_str(), Some("second"));
    // Nothing can be written where links lead in a circle.
    symlink("round", path("round")).unwrap();
    assert!(matches!(check_destination(&path("round")), Err(WriteError::Io { .. })));
    assert!(fs::read_link(path("round")).is_ok());
}

#[test]
fn a_name_that_is_too_long_is_told_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let long = folder.path().join("x".repeat(300));
    assert!(matches!(check_destination(&long), Err(WriteError::Io { .. })));
}

#[test]
fn a_file_keeps_its_mode_and_its_owner() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    fs::write(&path, "old").unwrap();
    // Only root may give a file away.
    let given = chown(&path, Some(12_345), Some(54_321)).is_ok();
    fs::set_permissions(&path, Permissions::from_mode(0o640)).unwrap();
    let before = fs::metadata(&path).unwrap();
    write_atomically(&path, |out| out.write_all(b"new")).unwrap();
    let after = fs::metadata(&path).unwrap();
    assert_eq!(
        (after.mode(), after.uid(), after.gid()),
        (before.mode(), before.uid(), before.gid())
    );
    assert!(!given || after.uid() == 12_345);
    assert_eq!(fs::read(&path).unwrap(), b"new");
}

/// Names of files of others, some nearly such as hidden files have.
const OTHERS: [&str; 6] = [
    "mine.tmp",
    ".frisure-notes.tmp",
    ".frisure-.tmp",
    ".frisure-0123456789abc-YZ.tmp",
    ".frisure-0123456789abcXYZ0.tmp",
    ".frisure-0123456789abcXYZ.tmp.bak",
];

#[test]
fn what_a_killed_run_left_is_removed_and_what_is_being_written_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let now = fs::metadata(folder.path()).unwrap().modified().unwrap();
    let past = now - Duration::from_secs(3600);
    let old = |name: &str| {
        let file = File::create(path(name)).unwrap();
        file.set_modified(past).unwrap();
        file
    };
    drop(old(".frisure-0123456789abcXYZ.tmp"));
    for name in OTHERS {
        drop(old(name));
    }
    let busy = old(".frisure-busybusybusybusy.tmp");
    busy.lock().unwrap();
    File::create(path(".frisure-youngyoungyoung0.tmp")).unwrap();
    write_atomically(&path("out"), |out| out.write_all(b"new")).unwrap();
    let names = fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name());
    let mut names: Vec<_> = names.map(|n| n.into_string().unwrap()).collect();
    names.sort();
    let kept = [".frisure-busybusybusybusy.tmp", ".frisure-youngyoungyoung0.tmp", "out"];
    let mut kept: Vec<_> = kept.into_iter().chain(OTHERS).collect();
    kept.sort_unstable();
    assert_eq!(names, kept);
}
