//! Ctrl-C (and a request to terminate): a flag for long work, and a way out of work that does not read it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use frisure::progress::Cancelled;
use frisure_engine::{Error, catch_panic};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Time between two reads of the flag.
const POLL: Duration = Duration::from_millis(20);

/// Time in which work can stop by itself.
const GRACE: Duration = Duration::from_millis(500);

/// Catches Ctrl-C and termination from here on.
pub(crate) fn install() -> Result<(), Error> {
    ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed))
        .map_err(|e| Error::failed(&e, ""))
}

/// Whether Ctrl-C was pressed.
pub(crate) fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// An error if Ctrl-C was pressed.
pub(crate) fn check() -> Result<(), Error> {
    if interrupted() { Err(Cancelled.into()) } else { Ok(()) }
}

/// Runs work on another thread and waits for it, or for Ctrl-C.
///
/// Work that does not read the flag is left behind when the process ends. It must not write files: the main thread does,
/// and finishes or removes the file at hand. The exception is a file that may end anywhere
/// ([`frisure_engine::checkpoint::HairCheckpoint`]).
pub(crate) fn compute<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> Result<T, Error> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        // The receiver is gone if Ctrl-C was pressed.
        let _ = sender.send(catch_panic(work));
    });
    let mut since: Option<Instant> = None;
    loop {
        match receiver.recv_timeout(POLL) {
            Ok(result) => return check().and(result),
            Err(RecvTimeoutError::Timeout) if interrupted() => {
                if since.get_or_insert_with(Instant::now).elapsed() > GRACE {
                    return Err(Cancelled.into());
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Error::Internal("the thread ended without a result".into()));
            }
        }
    }
}
