//! Named pipes: the wait for the program at the other end.
//!
//! To open a named pipe that has nobody at its other end waits for ever, and cannot be interrupted. Pipes are therefore
//! opened with `O_NONBLOCK`, and the wait has a limit.

use std::fs::File;
use std::io;
use std::path::Path;

/// Reads a named pipe to its end, at most `limit` bytes; none if the path is no pipe.
///
/// The wait for a program to write has a limit; once one does, the wait for its bytes has none, as on standard input.
#[cfg(any(target_os = "linux", target_os = "macos"))]
pub(crate) fn read(path: &Path, limit: u64) -> io::Result<Option<Vec<u8>>> {
    use std::io::Read;
    let Some(mut pipe) = open(path, File::options().read(true))? else {
        return Ok(None);
    };
    let start = std::time::Instant::now();
    let (mut bytes, mut block) = (Vec::new(), [0; 1 << 16]);
    let mut written = false;
    while (bytes.len() as u64) < limit {
        let room = block.len().min((limit - bytes.len() as u64) as usize);
        match pipe.read(&mut block[..room]) {
            // The end, or no writer yet.
            Ok(0) if written => break,
            Ok(0) if start.elapsed() > PATIENCE => {
                return Err(io::Error::new(
                    io::ErrorKind::TimedOut,
                    "nobody writes the named pipe",
                ));
            }
            Ok(0) => std::thread::sleep(PAUSE),
            Ok(n) => {
                written = true;
                bytes.extend_from_slice(&block[..n]);
            }
            // There is a writer, and nothing from it yet.
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {
                written = true;
                std::thread::sleep(PAUSE);
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(Some(bytes))
}

/// Waits until a program reads a named pipe, and holds it open; none for other files.
#[cfg(any(target_os = "linux", target_os = "macos"))]
pub(crate) fn await_reader(path: &Path) -> io::Result<Option<File>> {
    // `ENXIO` of <errno.h>; std has no name for it.
    const NOBODY: i32 = 6;
    let start = std::time::Instant::now();
    loop {
        match open(path, File::options().write(true)) {
            Err(e) if e.raw_os_error() == Some(NOBODY) => {}
            opened => return opened,
        }
        if start.elapsed() > PATIENCE {
            return Err(io::Error::new(io::ErrorKind::TimedOut, "nobody reads the named pipe"));
        }
        std::thread::sleep(PAUSE);
    }
}

/// Longest wait for a program at the other end. Chosen: a person starts two programs within it.
#[cfg(any(target_os = "linux", target_os = "macos"))]
const PATIENCE: std::time::Duration = std::time::Duration::from_secs(10);

/// Pause between two looks. Chosen: short for a person, long for a processor.
#[cfg(any(target_os = "linux", target_os = "macos"))]
const PAUSE: std::time::Duration = std::time::Duration::from_millis(20);

/// Opens a named pipe without a wait; none if the path is no pipe.
#[cfg(any(target_os = "linux", target_os = "macos"))]
fn open(path: &Path, options: &mut std::fs::OpenOptions) -> io::Result<Option<File>> {
    use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
    // `O_NONBLOCK` of <fcntl.h>; std has no name for it.
    const NONBLOCK: i32 = if cfg!(target_os = "macos") { 0x4 } else { 0o4000 };
    if !std::fs::metadata(path)?.file_type().is_fifo() {
        return Ok(None);
    }
    options.custom_flags(NONBLOCK).open(path).map(Some)
}

/// Other systems have none among files.
#[cfg(not(any(target_os = "linux", target_os = "macos")))]
pub(crate) fn read(_: &Path, _: u64) -> io::Result<Option<Vec<u8>>> {
    Ok(None)
}

/// Other systems have none among files.
#[cfg(not(any(target_os = "linux", target_os = "macos")))]
pub(crate) fn await_reader(_: &Path) -> io::Result<Option<File>> {
    Ok(None)
}
