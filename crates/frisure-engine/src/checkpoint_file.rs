//! A checkpoint file: parts of long work in a file that grows, so that interrupted work goes on.
//!
//! `FRISKEPT`, the key of the work (u64), then records: the number of a part and its length (u32 each), its digest
//! (16 bytes), and its bytes; all little-endian, in the order in which parts were done. Where a record is broken, as
//! the last can be, the file ends.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use frisure::files::{ReadError, read_bytes};
use frisure::hairstyle::Checkpoint;
use frisure_digest::checksum;

/// What such a file begins with.
const MARK: &[u8; 8] = b"FRISKEPT";

/// The mark and the key (bytes), and the head of a record.
const HEADER: usize = 16;
const RECORD: usize = 24;

/// Largest file that is read (bytes).
const LARGEST: u64 = 64 << 30;

/// The parts of one work that are done, in a file.
#[derive(Debug)]
pub struct CheckpointFile {
    path: PathBuf,
    bytes: Vec<u8>,
    /// Where in the bytes each part is that there was.
    found: Vec<Option<(usize, usize)>>,
    /// None: it could not be written to.
    file: Mutex<Result<File, io::Error>>,
}

impl CheckpointFile {
    /// Opens the file of the work with a key, or begins it. What is there of another work is given up.
    ///
    /// # Errors
    /// [`ReadError`], if there is a file that cannot be read.
    pub fn open(path: &Path, key: u64) -> Result<Self, ReadError> {
        let mut bytes = match read_bytes(path, LARGEST, "a checkpoint of simulated hairs") {
            Err(ReadError::Missing { .. }) => Vec::new(),
            found => found?,
        };
        if !bytes.starts_with(&header(key)) {
            bytes.clear();
        }
        let (found, end) = parts(&bytes);
        bytes.truncate(end);
        let file = begin(path, key, end);
        Ok(Self { path: path.into(), bytes, found, file: Mutex::new(file) })
    }

    /// How many parts there were.
    #[must_use]
    pub fn found(&self) -> usize {
        self.found.iter().flatten().count()
    }

    /// Takes the file away: the work is done.
    ///
    /// # Errors
    /// What the system said, now or when a part could not be written.
    pub fn remove(self) -> io::Result<()> {
        let file = self.file.into_inner().unwrap_or_else(PoisonError::into_inner);
        std::fs::remove_file(&self.path)?;
        file.map(drop)
    }

    /// Whether a file is of this kind, or as little of one as a crash leaves, so that it may be written to.
    ///
    /// # Errors
    /// What the system said.
    pub fn is_one(path: &Path) -> io::Result<bool> {
        let mut mark = Vec::new();
        File::open(path)?.take(MARK.len() as u64).read_to_end(&mut mark)?;
        Ok(MARK.starts_with(&mark))
    }
}

impl Checkpoint for CheckpointFile {
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
        // After a record that is broken no other would be found.
        if let Ok(open) = &mut *file
            && let Err(error) = open.write_all(&record)
        {
            *file = Err(error);
        }
    }
}

fn header(key: u64) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    header[..8].copy_from_slice(MARK);
    header[8..].copy_from_slice(&key.to_le_bytes());
    header
}

/// The file, open for writing after `end` bytes.
fn begin(path: &Path, key: u64, end: usize) -> io::Result<File> {
    let mut file = OpenOptions::new().create(true).append(true).open(path)?;
    file.set_len(end as u64)?;
    if end == 0 {
        file.write_all(&header(key))?;
    }
    Ok(file)
}

/// Where the parts are, and where what is whole ends.
fn parts(bytes: &[u8]) -> (Vec<Option<(usize, usize)>>, usize) {
    let mut found = Vec::new();
    if bytes.is_empty() {
        return (found, 0);
    }
    let mut end = HEADER;
    while let Some(head) = bytes[end..].first_chunk::<RECORD>() {
        let (numbers, told) = head.split_at(8);
        let (numbers, _) = numbers.as_chunks::<4>();
        let [part, length] = [0, 1].map(|i| u32::from_le_bytes(numbers[i]) as usize);
        let (from, to) = (end + RECORD, end + RECORD + length);
        let whole = bytes.get(from..to).is_some_and(|bytes| checksum(bytes) == told);
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

    #[test]
    fn what_is_whole_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("curls.hair.hairs.part");
        let checkpoint = CheckpointFile::open(&path, 7).unwrap();
        assert_eq!(checkpoint.found(), 0);
        checkpoint.save(3, b"three");
        checkpoint.save(0, b"");
        drop(checkpoint);
        let whole = std::fs::read(&path).unwrap();
        assert!(CheckpointFile::is_one(&path).unwrap());
        // A part that a crash left unfinished, and one that a disk changed.
        for spoilt in [[&whole[..], b"\x01\0\0\0\x09\0\0\0rest"].concat(), {
            let mut more = whole.clone();
            more.extend_from_slice(&whole[HEADER..HEADER + RECORD + 5]);
            *more.last_mut().unwrap() ^= 1;
            more
        }] {
            std::fs::write(&path, &spoilt).unwrap();
            let checkpoint = CheckpointFile::open(&path, 7).unwrap();
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
            assert!(CheckpointFile::is_one(&path).unwrap());
            assert_eq!(CheckpointFile::open(&path, 7).unwrap().found(), 0);
        }
        std::fs::write(&path, b"letters").unwrap();
        assert!(!CheckpointFile::is_one(&path).unwrap());
        // Another work begins anew.
        let other = CheckpointFile::open(&path, 8).unwrap();
        assert_eq!(other.found(), 0);
        other.remove().unwrap();
        assert!(!path.exists());
    }
}
