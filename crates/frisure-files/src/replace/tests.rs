//! Disks that fail, and a disk that loses its power.

use super::*;
use std::fs;
use tempfile::TempDir;

const OLD: &[u8] = b"the old bytes";

/// Larger than the buffer, so that there are several writes.
fn new() -> Vec<u8> {
    (0..3 * BUFFER + 17).map(|i| (i * i % 251) as u8).collect()
}

/// What is done at the operation that fails.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Error(ErrorKind),
    /// Half of the bytes are written before the disk is full; an error of the others.
    Half,
}

/// A disk whose `fails`-th operation, from 0, fails, and all after it, if it stays broken.
struct Faulty {
    fails: usize,
    fault: Fault,
    stays: bool,
    /// Whether the owner of a file can be given away.
    gives: bool,
    done: usize,
    failed: bool,
}

impl Faulty {
    fn new(fails: usize, fault: Fault, stays: bool, gives: bool) -> Self {
        Self { fails, fault, stays, gives, done: 0, failed: false }
    }

    fn next(&mut self) -> io::Result<()> {
        let now = self.done;
        self.done += 1;
        if now == self.fails || self.stays && now > self.fails {
            self.failed = true;
            return Err(match self.fault {
                Fault::Error(kind) => kind.into(),
                Fault::Half => ErrorKind::StorageFull.into(),
            });
        }
        Ok(())
    }
}

impl Disk for Faulty {
    fn create(&mut self, folder: &Path) -> io::Result<NamedTempFile> {
        self.next()?;
        System.create(folder)
    }

    fn write(&mut self, file: &mut File, bytes: &[u8]) -> io::Result<usize> {
        if let Err(e) = self.next() {
            if self.fault == Fault::Half {
                System.write(file, &bytes[..bytes.len() / 2])?;
            }
            return Err(e);
        }
        System.write(file, bytes)
    }

    fn keep_owner(&mut self, _: &File, _: &Metadata) -> bool {
        self.gives
    }

    fn set_permissions(&mut self, file: &File, permissions: Permissions) -> io::Result<()> {
        self.next()?;
        System.set_permissions(file, permissions)
    }

    fn sync(&mut self, _: &File) -> io::Result<()> {
        self.next()
    }

    fn rename(&mut self, file: NamedTempFile, target: &Path) -> io::Result<()> {
        self.next()?;
        System.rename(file, target)
    }

    fn sync_folder(&mut self, _: &Path) -> io::Result<()> {
        self.next()
    }

    fn truncate(&mut self, target: &Path) -> io::Result<File> {
        self.next()?;
        System.truncate(target)
    }
}

/// Saves over an old file, or as a new one, on such a disk; returns the folder with the result.
fn saved(disk: &mut Faulty, over: bool) -> (TempDir, io::Result<()>) {
    let room = tempfile::tempdir().unwrap();
    let target = room.path().join("a.hair");
    if over {
        fs::write(&target, OLD).unwrap();
    }
    let existing = over.then(|| Box::new(fs::metadata(&target).unwrap()));
    let bytes = new();
    let fill = |out: &mut dyn Write| bytes.chunks(1000).try_for_each(|part| out.write_all(part));
    let result = replace(disk, &target, room.path(), existing, fill);
    (room, result)
}

/// The names in a folder, sorted.
fn names(room: &TempDir) -> Vec<String> {
    let name = |e: io::Result<fs::DirEntry>| e.unwrap().file_name().into_string().unwrap();
    let mut names: Vec<String> = fs::read_dir(room.path()).unwrap().map(name).collect();
    names.sort();
    names
}

/// All faults at all operations, until a save has no fault.
fn every_fault(gives: bool, over: bool, check: impl Fn(&TempDir, io::Result<()>, &str)) -> usize {
    let kinds = [ErrorKind::StorageFull, ErrorKind::Other, ErrorKind::PermissionDenied];
    let mut tried = 0;
    for fault in kinds.map(Fault::Error).into_iter().chain([Fault::Half]) {
        for stays in [false, true] {
            for fails in 0.. {
                let mut disk = Faulty::new(fails, fault, stays, gives);
                let (room, result) = saved(&mut disk, over);
                if !disk.failed {
                    result.unwrap();
                    assert!(fs::read(room.path().join("a.hair")).unwrap() == new());
                    break;
                }
                check(&room, result, &format!("{fault:?} at {fails}, stays {stays}"));
                tried += 1;
            }
        }
    }
    tried
}

#[test]
fn whatever_fails_the_file_is_the_old_or_the_new_one_and_nothing_else_is_left() {
    for over in [false, true] {
        let tried = every_fault(true, over, |room, result, what| {
            let error = result.expect_err(what);
            let found = fs::read(room.path().join("a.hair")).ok();
            let before = over.then(|| OLD.to_vec());
            // The new one only where the folder alone was not flushed, which the error tells.
            match error.to_string().contains("it is written") {
                true => assert!(found == Some(new()), "{what}"),
                false => assert_eq!(found, before, "{what}: {error}"),
            }
            assert_eq!(
                names(room).len(),
                usize::from(found.is_some()),
                "{what}: {:?}",
                names(room)
            );
        });
        assert!(tried > 50, "{tried}");
    }
}

#[test]
fn a_file_of_another_owner_that_cannot_be_written_in_place_leaves_all_bytes_beside_it() {
    let tried = every_fault(false, true, |room, result, what| {
        let error = result.expect_err(what).to_string();
        let found = fs::read(room.path().join("a.hair")).unwrap();
        match error.contains("all of it is in") {
            true => {
                assert!(fs::read(room.path().join("a.hair.new")).unwrap() == new(), "{what}");
                assert!(error.contains("a.hair.new"), "{what}: {error}");
            }
            false => {
                assert_eq!(found, OLD, "{what}: {error}");
                assert_eq!(names(room), ["a.hair"], "{what}");
            }
        }
    });
    assert!(tried > 50, "{tried}");
}

#[test]
fn a_disk_that_cannot_flush_folders_is_no_fault() {
    for kind in [ErrorKind::Unsupported, ErrorKind::InvalidInput] {
        // The last operation is that of the folder.
        let mut disk = Faulty::new(usize::MAX, Fault::Half, false, true);
        saved(&mut disk, true).1.unwrap();
        let mut disk = Faulty::new(disk.done - 1, Fault::Error(kind), false, true);
        saved(&mut disk, true).1.unwrap();
        assert!(disk.failed);
    }
}

/// An operation that reached the system, for a loss of power after it.
#[derive(Clone, Debug, PartialEq)]
enum Done {
    Write(Vec<u8>),
    Sync,
    Rename,
    SyncFolder,
}

/// A disk that records what was done.
#[derive(Default)]
struct Recorder(Vec<Done>);

impl Disk for Recorder {
    fn create(&mut self, folder: &Path) -> io::Result<NamedTempFile> {
        System.create(folder)
    }

    fn write(&mut self, file: &mut File, bytes: &[u8]) -> io::Result<usize> {
        self.0.push(Done::Write(bytes.to_vec()));
        System.write(file, bytes)
    }

    fn keep_owner(&mut self, file: &File, other: &Metadata) -> bool {
        System.keep_owner(file, other)
    }

    fn set_permissions(&mut self, file: &File, permissions: Permissions) -> io::Result<()> {
        System.set_permissions(file, permissions)
    }

    fn sync(&mut self, file: &File) -> io::Result<()> {
        self.0.push(Done::Sync);
        System.sync(file)
    }

    fn rename(&mut self, file: NamedTempFile, target: &Path) -> io::Result<()> {
        self.0.push(Done::Rename);
        System.rename(file, target)
    }

    fn sync_folder(&mut self, folder: &Path) -> io::Result<()> {
        self.0.push(Done::SyncFolder);
        System.sync_folder(folder)
    }

    fn truncate(&mut self, target: &Path) -> io::Result<File> {
        System.truncate(target)
    }
}

/// What may be found after the power is lost once these operations were done: what was not flushed may be there as a whole,
/// in part or not at all, and a name may have reached the disk before the bytes.
fn found_after(done: &[Done]) -> Vec<Vec<u8>> {
    let (mut bytes, mut safe) = (Vec::new(), 0);
    let (mut renamed, mut surely) = (false, false);
    for operation in done {
        match operation {
            Done::Write(more) => bytes.extend_from_slice(more),
            Done::Sync => safe = bytes.len(),
            Done::Rename => renamed = true,
            Done::SyncFolder => surely = renamed,
        }
    }
    let mut found = Vec::new();
    if !surely {
        found.push(OLD.to_vec());
    }
    if renamed {
        let middle = usize::midpoint(safe, bytes.len());
        found.extend([safe, middle, bytes.len()].map(|length| bytes[..length].to_vec()));
    }
    found
}

#[test]
fn a_loss_of_power_leaves_the_old_or_the_new_file() {
    let room = tempfile::tempdir().unwrap();
    let target = room.path().join("a.hair");
    fs::write(&target, OLD).unwrap();
    let existing = Some(Box::new(fs::metadata(&target).unwrap()));
    let (mut disk, bytes) = (Recorder::default(), new());
    replace(&mut disk, &target, room.path(), existing, |out| out.write_all(&bytes)).unwrap();
    let done = disk.0;
    assert!(done.len() >= 4, "{}", done.len());
    for n in 0..=done.len() {
        for found in found_after(&done[..n]) {
            assert!(found == OLD || found == bytes, "{} bytes after {n} operations", found.len());
        }
    }
    // After success it is the new one.
    assert!(found_after(&done) == vec![bytes.clone(); 3]);
    // The model finds what is wrong: a name before its bytes, and a name that was not flushed.
    let swapped: Vec<Done> = done.iter().filter(|d| **d != Done::Sync).cloned().collect();
    assert!(found_after(&swapped).contains(&Vec::new()));
    assert!(found_after(&done[..done.len() - 1]).contains(&OLD.to_vec()));
}
