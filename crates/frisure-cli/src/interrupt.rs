//! Ctrl-C (and a request to terminate): a flag for long work, and a way out of work that does not read it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use frisure::progress::Cancelled;
use frisure_engine::{Error, catch_panic};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Locked while files are written.
static WRITING: Mutex<()> = Mutex::new(());

/// How to resume the work at hand.
static RESUME: Mutex<Option<String>> = Mutex::new(None);

/// Time between two reads of the flag.
const POLL: Duration = Duration::from_millis(20);

/// Time in which work can stop by itself.
const GRACE: Duration = Duration::from_millis(500);

/// Size of the stack of a command (bytes), as large as that of a main thread on Linux.
const STACK: usize = 8 << 20;

/// Whether Ctrl-C was pressed.
pub(crate) fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// An error if Ctrl-C was pressed.
pub(crate) fn check() -> Result<(), Error> {
    if interrupted() { Err(Cancelled.into()) } else { Ok(()) }
}

/// Runs work that writes a file: the program does not end before it.
pub(crate) fn writing<T>(write: impl FnOnce() -> T) -> T {
    let _lock = lock(&WRITING);
    write()
}

/// Makes a write beyond the largest file that the user allows (`ulimit -f`) an error like that of a full disk: the system
/// also sends a signal, which ends the program before it can tell, with a hidden file left. Call it before threads start,
/// which inherit it.
pub(crate) fn let_writes_fail() {
    #[cfg(unix)]
    {
        use nix::sys::signal::{SigSet, Signal};
        let mut blocked = SigSet::empty();
        blocked.add(Signal::SIGXFSZ);
        // Where it cannot be blocked, all is as it would be without.
        let _ = blocked.thread_block();
    }
}

/// Sets what to print after Ctrl-C: how to resume the work at hand.
pub(crate) fn set_resume(how: Option<String>) {
    *lock(&RESUME) = how;
}

/// How to resume the work at hand.
pub(crate) fn resume() -> Option<String> {
    lock(&RESUME).clone()
}

fn lock<T>(mutex: &'static Mutex<T>) -> MutexGuard<'static, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs a command on another thread and waits for it, or for Ctrl-C.
///
/// Work that does not read the flag is left behind when the process ends, except while it writes a file ([`writing`]).
/// Only a file that may end anywhere ([`frisure_engine::checkpoint::HairCheckpoint`]) is written without that.
pub(crate) fn run<T: Send + 'static>(
    command: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> Result<T, Error> {
    ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed))
        .map_err(|e| Error::failed(&e, ""))?;
    let (sender, receiver) = mpsc::channel();
    let command = move || {
        // The receiver is gone if the command was left behind.
        let _ = sender.send(catch_panic(command));
    };
    let thread = thread::Builder::new().name("command".into()).stack_size(STACK).spawn(command);
    thread.map_err(|e| Error::failed(&e, ""))?;
    let mut since = None;
    loop {
        match receiver.recv_timeout(POLL) {
            Ok(result) => return result,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Error::Internal("the thread ended without a result".into()));
            }
            Err(RecvTimeoutError::Timeout) if interrupted() => match WRITING.try_lock() {
                Ok(lock) if since.get_or_insert_with(Instant::now).elapsed() > GRACE => {
                    // No other file is begun.
                    std::mem::forget(lock);
                    return Err(Cancelled.into());
                }
                Ok(_) => {}
                Err(_) => since = None,
            },
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
}
