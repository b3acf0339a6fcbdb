//! Ctrl-C (and a request to terminate): a flag that long work looks at, and a way out for work that does not.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use crate::failure::Failure;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// How often the flag is looked at.
const POLL: Duration = Duration::from_millis(20);

/// How long work is given to notice the flag itself.
const GRACE: Duration = Duration::from_millis(500);

/// Catches Ctrl-C and termination from here on.
pub(crate) fn install() -> Result<(), Failure> {
    ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed))
        .map_err(|e| Failure::failed(&e))
}

/// Whether Ctrl-C was pressed.
pub(crate) fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// An error if Ctrl-C was pressed.
pub(crate) fn check() -> Result<(), Failure> {
    if interrupted() { Err(Failure::Interrupted) } else { Ok(()) }
}

/// Computes on a thread of its own and waits for it, or for Ctrl-C.
///
/// Work that does not look at the flag is left behind when the process ends. It must not write
/// files: those are written by the main thread, which always finishes or cleans up the one it is at. Only what may end
/// anywhere is written here ([`frisure_engine::CheckpointFile`]).
pub(crate) fn computing<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Failure> + Send + 'static,
) -> Result<T, Failure> {
    let (sender, receiver) = mpsc::channel();
    let worker = thread::spawn(move || {
        // The receiver is gone if Ctrl-C was pressed.
        let _ = sender.send(work());
    });
    let mut since: Option<Instant> = None;
    loop {
        match receiver.recv_timeout(POLL) {
            Ok(result) => return check().and(result),
            Err(RecvTimeoutError::Timeout) if interrupted() => {
                if since.get_or_insert_with(Instant::now).elapsed() > GRACE {
                    return Err(Failure::Interrupted);
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                // It panicked, and the panic told its story.
                let _ = worker.join();
                return Err(Failure::failed(&InternalError));
            }
        }
    }
}

#[derive(Debug, thiserror::Error)]
#[error("internal error; please report the message above")]
struct InternalError;
