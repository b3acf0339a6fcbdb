//! Named pipes, devices and large files as inputs.
#![cfg(any(target_os = "linux", target_os = "macos"))]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::Duration;

use frisure_files::{ReadError, read_bytes};

fn pipe(folder: &Path) -> PathBuf {
    let path = folder.join("pipe");
    let made = Command::new("mkfifo").arg(&path).status().expect("mkfifo is part of POSIX");
    assert!(made.success());
    path
}

#[test]
fn a_named_pipe_is_read_to_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = pipe(folder.path());
    let long: Vec<u8> = (0..300_000_u32).map(|i| i as u8).collect();
    let (to, bytes) = (path.clone(), long.clone());
    let writer = thread::spawn(move || {
        // The reader is there first, and then waits for the rest.
        thread::sleep(Duration::from_millis(100));
        let mut out = fs::File::options().write(true).open(to).unwrap();
        for half in bytes.chunks(bytes.len() / 2) {
            std::io::Write::write_all(&mut out, half).unwrap();
            thread::sleep(Duration::from_millis(100));
        }
    });
    assert_eq!(read_bytes(&path, 1 << 20, "bytes").unwrap(), long);
    writer.join().unwrap();
}

#[test]
fn a_named_pipe_that_nobody_writes_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let error = read_bytes(&pipe(folder.path()), 1 << 20, "bytes").unwrap_err();
    let ReadError::Io { source, .. } = &error else { panic!("{error}") };
    assert!(source.to_string().contains("nobody writes the named pipe"), "{source}");
}

#[test]
fn what_is_too_large_is_refused_without_reading_all_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let large = folder.path().join("large");
    // A terabyte of nothing, which takes no room.
    fs::File::create(&large).unwrap().set_len(1 << 40).unwrap();
    let too_large = |path: &Path, limit: u64| match read_bytes(path, limit, "bytes") {
        Err(ReadError::TooLarge { limit, .. }) => limit,
        other => panic!("{:?}", other.map(|bytes| bytes.len())),
    };
    assert_eq!(too_large(&large, 8 << 30), 8 << 30);
    assert_eq!(too_large(Path::new("/dev/zero"), 1 << 20), 1 << 20);
    // Of what has no end, less than a file may have.
    assert_eq!(too_large(Path::new("/dev/zero"), 8 << 30), 1 << 30);
}
