//! The checkpoint of simulated hairs: parts of them in a file that grows.
//!
//! `FRISKEPT`, the key of the work (u64), then records: the number of a part and its length (u32 each), its digest
//! (16 bytes), and its bytes; all little-endian, in the order in which parts were done. Where a record is broken, as
//! the last can be, the file ends.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use frisure::files::{ReadError, read_bytes};
use frisure::hairstyle::{Checkpoint, HairModel, HairstyleSpec, StrandContact, simulation_key};
use frisure_digest::checksum;

use super::{first_bytes, foreign, with_suffix};
use crate::error::Error;
use crate::runner::LoadedScene;

/// The first bytes of such a file.
const MAGIC: &[u8; 8] = b"FRISKEPT";

/// Size of the magic and the key (bytes).
const HEADER: usize = 16;

/// Size of a record before its bytes (bytes).
const RECORD: usize = 24;

/// Largest file that is read (bytes).
const LARGEST: u64 = 64 << 30;

/// Fewer hairs than this get no file: they take seconds. Chosen.
const MANY: usize = 50_000;

/// The simulated hairs of an output that have come to rest, in a file from which the same work resumes.
#[derive(Debug)]
pub struct HairCheckpoint {
    path: PathBuf,
    bytes: Vec<u8>,
    /// Where in the bytes each part is that was found.
    found: Vec<Option<(usize, usize)>>,
    /// None since a part could not be written.
    file: Mutex<Option<File>>,
    /// Is called once, when the first part cannot be written.
    failed: fn(&io::Error),
}

impl HairCheckpoint {
    /// The file of an output, such as `curls.hair.hairs.part`; none for hairs that are interpolated, for hairs in contact with each
    /// other, of which no part is at rest before all are, and for devices.
    #[must_use]
    pub fn path_for(output: &Path, spec: &HairstyleSpec) -> Option<PathBuf> {
        let device = std::fs::metadata(output).is_ok_and(|found| !found.is_file());
        let simulated =
            spec.wisps.strands == HairModel::Simulated && spec.wisps.contact == StrandContact::Tube;
        (simulated && !device).then(|| with_suffix(output, ".hairs.part"))
    }

    /// Checks that a file is a checkpoint, as little of one as a crash leaves, or missing.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub fn check(path: &Path) -> Result<(), Error> {
        match first_bytes(path) {
            Ok(None) => Ok(()),
            Ok(Some(bytes)) if MAGIC.starts_with(&bytes) => Ok(()),
            _ => Err(foreign(
                path,
                "it keeps no hairs",
                "simulated hairs so far are kept under that name; move the file away",
            )),
        }
    }

    /// Opens the checkpoint of the hairs of a scene; none if there are so few that they take seconds.
    ///
    /// Hairs that cannot be kept, as on a full disk, are no reason to stop: `failed` is called once with the reason, when
    /// it is found.
    ///
    /// # Errors
    /// [`Error::Failed`], for a file that cannot be read.
    pub fn open(
        path: &Path,
        loaded: &LoadedScene,
        failed: fn(&io::Error),
    ) -> Result<Option<Self>, Error> {
        if loaded.hairstyle.drawn() < MANY {
            return Ok(None);
        }
        let key = simulation_key(&loaded.hairstyle, &loaded.head);
        key.map(|key| Self::with_key(path, key, failed))
            .transpose()
            .map_err(|e| Error::failed(&e, ""))
    }

    /// Opens the file of the work with a key, or begins it. A file of other work is overwritten.
    fn with_key(path: &Path, key: u64, failed: fn(&io::Error)) -> Result<Self, ReadError> {
        let mut bytes = match read_bytes(path, LARGEST, "a checkpoint of simulated hairs") {
            Err(ReadError::Missing { .. }) => Vec::new(),
            found => found?,
        };
        if !bytes.starts_with(&header(key)) {
            bytes.clear();
        }
        let (found, end) = parts(&bytes);
        bytes.truncate(end);
        let file = begin(path, key, end).inspect_err(failed).ok();
        Ok(Self { path: path.into(), bytes, found, file: Mutex::new(file), failed })
    }

    /// The number of parts that were found.
    #[must_use]
    pub fn found(&self) -> usize {
        self.found.iter().flatten().count()
    }

    /// Removes the file: the hairs are written.
    ///
    /// # Errors
    /// The error of the system.
    pub fn remove(self) -> io::Result<()> {
        match std::fs::remove_file(&self.path) {
            // It could not be begun.
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            removed => removed,
        }
    }
}

impl Checkpoint for HairCheckpoint {
    fn find(&self, part: usize) -> Option<&[u8]> {
        let (from, to) = (*self.found.get(part)?)?;
        self.bytes.get(from..to)
    }

    fn save(&self, part: usize, bytes: &[u8]) {
        let mut record = Vec::with_capacity(RECORD + bytes.len());
        record.extend((part as u32).to_le_bytes());
        record.extend((bytes.len() as u32).to_le_bytes());
        record.extend(checksum(bytes));
        record.extend(bytes);
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        // No record after a broken one would be found.
        if let Some(open) = &mut *file
            && let Err(error) = open.write_all(&record)
        {
            *file = None;
            (self.failed)(&error);
        }
    }
}

fn header(key: u64) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    header[..8].copy_from_slice(MAGIC);
    header[8..].copy_from_slice(&key.to_le_bytes());
    header
}

/// The file, open for writing after `end` bytes.
fn begin(path: &Path, key: u64, end: usize) -> io::Result<File> {
    let mut file = OpenOptions::new().create(true).append(true).open(path)?;
    file.set_len(end as u64)?;
    if end == 0
        && let Err(error) = file.write_all(&header(key))
    {
        // An empty file would be found next time, and keeps nothing.
        let _ = std::fs::remove_file(path);
        return Err(error);
    }
    Ok(file)
}

/// The range of each part, and the end of the last whole record.
fn parts(bytes: &[u8]) -> (Vec<Option<(usize, usize)>>, usize) {
    let mut found = Vec::new();
    if bytes.is_empty() {
        return (found, 0);
    }
    let mut end = HEADER;
    while let Some(head) = bytes[end..].first_chunk::<RECORD>() {
        let (numbers, digest) = head.split_at(8);
        let (numbers, _) = numbers.as_chunks::<4>();
        let [part, length] = [0, 1].map(|i| u32::from_le_bytes(numbers[i]) as usize);
        let (from, to) = (end + RECORD, end + RECORD + length);
        let whole = bytes.get(from..to).is_some_and(|bytes| checksum(bytes) == digest);
        if !whole || part > bytes.len() {
            break;
        }
        found.resize(found.len().max(part + 1), None);
        found[part] = Some((from, to));
        end = to;
    }
    (found, end)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unexpected(error: &io::Error) {
        panic!("{error}");
    }

    #[test]
    fn what_is_whole_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("curls.hair.hairs.part");
        let checkpoint = HairCheckpoint::with_key(&path, 7, unexpected).unwrap();
        assert_eq!(checkpoint.found(), 0);
        checkpoint.save(3, b"three");
        checkpoint.save(0, b"");
        drop(checkpoint);
        let whole = std::fs::read(&path).unwrap();
        HairCheckpoint::check(&path).unwrap();
        // A part that a crash left unfinished, and one that a disk changed.
        for spoilt in [[&whole[..], b"\x01\0\0\0\x09\0\0\0rest"].concat(), {
            let mut more = whole.clone();
            more.extend_from_slice(&whole[HEADER..HEADER + RECORD + 5]);
            *more.last_mut().unwrap() ^= 1;
            more
        }] {
            std::fs::write(&path, &spoilt).unwrap();
            let checkpoint = HairCheckpoint::with_key(&path, 7, unexpected).unwrap();
            assert_eq!(
                (checkpoint.find(3), checkpoint.find(0)),
                (Some(&b"three"[..]), Some(&b""[..]))
            );
            assert_eq!(
                (checkpoint.find(1), checkpoint.find(9), checkpoint.found()),
                (None, None, 2)
            );
            drop(checkpoint);
            assert_eq!(std::fs::read(&path).unwrap(), whole);
        }
        for left in [0, 5, HEADER - 1] {
            std::fs::write(&path, &whole[..left]).unwrap();
            HairCheckpoint::check(&path).unwrap();
            assert_eq!(HairCheckpoint::with_key(&path, 7, unexpected).unwrap().found(), 0);
        }
        std::fs::write(&path, b"letters").unwrap();
        assert!(HairCheckpoint::check(&path).is_err());
        // Another work begins anew.
        let other = HairCheckpoint::with_key(&path, 8, unexpected).unwrap();
        assert_eq!(other.found(), 0);
        other.remove().unwrap();
        assert!(!path.exists());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_part_that_cannot_be_written_is_told_at_once_and_once() {
        use std::sync::atomic::{AtomicUsize, Ordering};
        static TOLD: AtomicUsize = AtomicUsize::new(0);
        let told = || TOLD.load(Ordering::Relaxed);
        let count: fn(&io::Error) = |_| {
            TOLD.fetch_add(1, Ordering::Relaxed);
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("curls.hair.hairs.part");
        let checkpoint = HairCheckpoint::with_key(&path, 7, count).unwrap();
        // The device of a disk that is full.
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        *checkpoint.file.lock().unwrap() = Some(full);
        checkpoint.save(0, b"zero");
        assert_eq!(told(), 1);
        checkpoint.save(1, b"one");
        assert_eq!(told(), 1);
        checkpoint.remove().unwrap();
        assert!(!path.exists());
        // Nor one that cannot be begun.
        let nowhere = folder.path().join("none/curls.hair.hairs.part");
        HairCheckpoint::with_key(&nowhere, 7, count).unwrap().remove().unwrap();
        assert_eq!(told(), 2);
    }
}
