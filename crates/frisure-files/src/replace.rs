//! A file replaced as a whole: the bytes go to a hidden file, which is flushed to the disk and renamed.

use std::ffi::OsString;
use std::fs::{File, Metadata, Permissions};
use std::io::{self, BufWriter, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::temporary;

/// Bytes that are written at once.
const BUFFER: usize = 1 << 18;

/// The operations on the disk of which a replacement consists; tests make them fail.
pub(crate) trait Disk {
    /// Makes the hidden file.
    fn create(&mut self, folder: &Path) -> io::Result<NamedTempFile>;
    /// Writes some of the bytes to a file; returns how many.
    fn write(&mut self, file: &mut File, bytes: &[u8]) -> io::Result<usize>;
    /// Gives a file the owner and the group of another; whether it has them then.
    fn keep_owner(&mut self, file: &File, other: &Metadata) -> bool;
    /// Sets the mode of a file.
    fn set_permissions(&mut self, file: &File, permissions: Permissions) -> io::Result<()>;
    /// Flushes the bytes of a file to the disk.
    fn sync(&mut self, file: &File) -> io::Result<()>;
    /// Gives the hidden file its name.
    fn rename(&mut self, file: NamedTempFile, target: &Path) -> io::Result<()>;
    /// Flushes the names in a folder to the disk.
    fn sync_folder(&mut self, folder: &Path) -> io::Result<()>;
    /// Opens a file that exists, without its bytes.
    fn truncate(&mut self, target: &Path) -> io::Result<File>;
}

/// The disk itself.
pub(crate) struct System;

impl Disk for System {
    fn create(&mut self, folder: &Path) -> io::Result<NamedTempFile> {
        temporary::create(folder)
    }

    fn write(&mut self, file: &mut File, bytes: &[u8]) -> io::Result<usize> {
        file.write(bytes)
    }

    #[cfg(unix)]
    fn keep_owner(&mut self, file: &File, other: &Metadata) -> bool {
        use std::os::unix::fs::{MetadataExt, fchown};
        let same = |m: Metadata| (m.uid(), m.gid()) == (other.uid(), other.gid());
        file.metadata().is_ok_and(same)
            || fchown(file, Some(other.uid()), Some(other.gid())).is_ok()
    }

    /// Other systems give a file in a folder the owner that it should have.
    #[cfg(not(unix))]
    fn keep_owner(&mut self, _: &File, _: &Metadata) -> bool {
        true
    }

    fn set_permissions(&mut self, file: &File, permissions: Permissions) -> io::Result<()> {
        file.set_permissions(permissions)
    }

    fn sync(&mut self, file: &File) -> io::Result<()> {
        file.sync_all()
    }

    fn rename(&mut self, file: NamedTempFile, target: &Path) -> io::Result<()> {
        file.persist(target)?;
        Ok(())
    }

    fn sync_folder(&mut self, folder: &Path) -> io::Result<()> {
        // A folder that this user may write but not read cannot be opened; nor can any on Windows.
        match File::open(folder) {
            Ok(folder) => folder.sync_all(),
            Err(e) if e.kind() == ErrorKind::PermissionDenied => Ok(()),
            Err(e) => Err(e),
        }
    }

    fn truncate(&mut self, target: &Path) -> io::Result<File> {
        File::options().write(true).truncate(true).open(target)
    }
}

/// A file that is written through a disk.
struct Through<'a, D> {
    disk: &'a mut D,
    file: &'a mut File,
}

impl<D: Disk> Write for Through<'_, D> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.disk.write(self.file, bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Replaces `target` in `folder`, which keeps the owner and the mode of `existing`, by the bytes that `fill` writes.
///
/// # Errors
/// Those of the system. The target is then as it was, but for two cases that the error tells: it was replaced, and its name
/// may not survive a loss of power; or it is of another owner, was written in place, and is cut off, with all bytes in a file
/// beside it.
pub(crate) fn replace(
    disk: &mut impl Disk,
    target: &Path,
    folder: &Path,
    existing: Option<Box<Metadata>>,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = disk.create(folder)?;
    let through = Through { disk: &mut *disk, file: file.as_file_mut() };
    let mut buffer = BufWriter::with_capacity(BUFFER, through);
    fill(&mut buffer)?;
    buffer.flush()?;
    drop(buffer);
    if let Some(existing) = existing {
        if !disk.keep_owner(file.as_file(), &existing) {
            return write_in_place(disk, file, target);
        }
        // After the owner: a change of it clears bits of the mode (`chown(2)`).
        disk.set_permissions(file.as_file(), existing.permissions())?;
    }
    // The bytes before the name: a name that reaches the disk first would be that of an empty file.
    disk.sync(file.as_file())?;
    disk.rename(file, target)?;
    // The rename itself reaches the disk with the folder.
    match disk.sync_folder(folder) {
        // Not every file system can.
        Err(e) if !matches!(e.kind(), ErrorKind::Unsupported | ErrorKind::InvalidInput) => {
            let told = format!("it is written, but may be as before after a loss of power: {e}");
            Err(io::Error::new(e.kind(), told))
        }
        _ => Ok(()),
    }
}

/// Copies a whole file into one that exists, whose owner this user cannot give to another file. What cannot be copied stays
/// beside it.
fn write_in_place(disk: &mut impl Disk, mut file: NamedTempFile, target: &Path) -> io::Result<()> {
    // All bytes are on the disk before the first of the target is lost.
    disk.sync(file.as_file())?;
    let Err(error) = copy(disk, file.as_file_mut(), target) else { return Ok(()) };
    let rescued = beside(target);
    let place = match file.persist_noclobber(&rescued) {
        Ok(_) => rescued,
        Err(e) => e.file.keep().map_err(|e| e.error)?.1,
    };
    let told = format!("{error}; it may be cut off, and all of it is in `{}`", place.display());
    Err(io::Error::new(error.kind(), told))
}

fn copy(disk: &mut impl Disk, file: &mut File, target: &Path) -> io::Result<()> {
    file.rewind()?;
    let mut out = disk.truncate(target)?;
    let mut out = Through { disk, file: &mut out };
    io::copy(file, &mut out)?;
    out.disk.sync(out.file)
}

/// The name of a file with `.new` at its end.
fn beside(target: &Path) -> PathBuf {
    let mut name = target.as_os_str().to_owned();
    name.push(OsString::from(".new"));
    name.into()
}

#[cfg(test)]
mod tests;
