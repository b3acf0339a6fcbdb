//! Long work on another thread, while the calling thread waits, reports progress to Python and listens to Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use frisure::progress::Progress;
use frisure_engine::{Error, catch_panic};
use pyo3::prelude::*;

use crate::errors::{argument_type, raise};

/// Time between two looks at signals and progress.
const POLL: Duration = Duration::from_millis(20);

/// Time that cancelled work has to end; after that the exception is raised, and the work ends later, unseen. With
/// [`POLL`] it is below the 0.2 s in which Ctrl-C has to act.
const GRACE: Duration = Duration::from_millis(100);

/// Whether threads of this library have been started in this process, or in one that it was forked from.
static STARTED: AtomicBool = AtomicBool::new(false);

/// Whether this process was forked after that: it has none of those threads, and would wait for them without end.
static FORKED: AtomicBool = AtomicBool::new(false);

/// Size of the stack of the work (bytes), as large as that of a main thread on Linux.
const STACK: usize = 8 << 20;

/// Notes that this process is a fork; Python calls it in the child.
#[pyfunction]
pub(crate) fn after_fork() {
    if STARTED.load(Ordering::Relaxed) {
        FORKED.store(true, Ordering::Relaxed);
    }
}

/// Notes that threads are started now.
///
/// # Errors
/// `FailedError`, in a process that was forked from one with threads.
pub(crate) fn begin(py: Python<'_>) -> PyResult<()> {
    STARTED.store(true, Ordering::Relaxed);
    if !FORKED.load(Ordering::Relaxed) {
        return Ok(());
    }
    let problem = "this process was forked from one in which frisure had started threads, which a fork does not have";
    let hint = "use the start method \"spawn\": multiprocessing.set_start_method(\"spawn\"), or \
                multiprocessing_context=\"spawn\" of a DataLoader";
    Err(raise(py, &Error::Failed { problem: problem.into(), hint: hint.into() }))
}

/// Runs work without the interpreter's lock, and returns its result.
///
/// `callback(stage, done)` is called on this thread with the name of each stage and the fraction that is done, at most
/// every 20 ms. An exception that it raises, and Ctrl-C, cancel the work and are raised here.
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    callback: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Progress) -> Result<T, Error> + Send + 'static,
) -> PyResult<T> {
    if let Some(callback) = callback.filter(|callback| !callback.is_callable()) {
        let problem = format!(
            "progress is {}; it must be a function of a stage and a fraction, or None",
            callback.repr()?
        );
        return Err(argument_type(py, &problem));
    }
    begin(py)?;
    let reports = Arc::new(Reports::default());
    let mut end = start(work, reports.clone()).map_err(|e| raise(py, &e))?;
    loop {
        let (result, receiver) = py.detach(move || (end.recv_timeout(POLL), end));
        end = receiver;
        let heard = tell(&reports, callback).and_then(|()| py.check_signals());
        if let Err(exception) = heard {
            reports.cancelled.store(true, Ordering::Relaxed);
            py.detach(move || await_end(&end));
            return Err(exception);
        }
        match result {
            Ok(result) => return result.map_err(|e| raise(py, &e)),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                let lost = Error::Internal("the thread ended without a result".into());
                return Err(raise(py, &lost));
            }
        }
    }
}

/// The result of work, when it is there.
type End<T> = Receiver<Result<T, Error>>;

/// Starts work on a thread of its own.
fn start<T: Send + 'static>(
    work: impl FnOnce(&dyn Progress) -> Result<T, Error> + Send + 'static,
    reports: Arc<Reports>,
) -> Result<End<T>, Error> {
    let (sender, receiver) = mpsc::channel();
    let work = move || {
        // The receiver is gone if the work was left behind.
        let _ = sender.send(catch_panic(|| work(&*reports)));
    };
    let thread = thread::Builder::new().name("frisure".into()).stack_size(STACK).spawn(work);
    thread.map(|_| receiver).map_err(|e| Error::failed(&e, ""))
}

/// Waits for cancelled work, but not for long.
fn await_end<T>(end: &End<T>) {
    let since = Instant::now();
    while let Some(left) = GRACE.checked_sub(since.elapsed()) {
        if !matches!(end.recv_timeout(left), Err(RecvTimeoutError::Timeout)) {
            return;
        }
    }
}

/// Passes on what was reported meanwhile.
fn tell(reports: &Reports, callback: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    let Some(callback) = callback else { return Ok(()) };
    for (stage, fraction) in reports.take() {
        callback.call1((stage, fraction))?;
    }
    Ok(())
}

/// What work has reported and was not passed on yet, and whether it is cancelled.
#[derive(Default)]
struct Reports {
    cancelled: AtomicBool,
    /// Stages with their last fractions.
    waiting: Mutex<Vec<(String, f64)>>,
}

impl Reports {
    fn take(&self) -> Vec<(String, f64)> {
        std::mem::take(&mut *self.waiting.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Progress for Reports {
    fn report(&self, stage: &str, fraction: f64) {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        match waiting.last_mut() {
            Some((last, done)) if last == stage => *done = fraction,
            _ => waiting.push((stage.to_owned(), fraction)),
        }
    }

    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}
