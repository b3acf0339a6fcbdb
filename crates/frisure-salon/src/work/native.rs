//! A thread that executes requests.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use frisure::progress::Progress;
use frisure_engine::{Request, Response, Session};

use super::{Wake, Worker};

/// A thread with a session of the engine, which ends when this is dropped.
pub struct Thread {
    requests: Sender<(u64, Request)>,
    responses: Receiver<(u64, Response)>,
    /// Jobs up to this one are cancelled.
    cancelled: Arc<AtomicU64>,
}

impl Thread {
    /// Starts the thread.
    ///
    /// # Errors
    /// The error of the system if it cannot start a thread.
    pub fn start(wake: Wake) -> std::io::Result<Self> {
        let (requests, jobs) = channel();
        let (sender, responses) = channel();
        let cancelled = Arc::new(AtomicU64::new(0));
        let outbox = Outbox { sender, wake, cancelled: cancelled.clone() };
        thread::Builder::new().name("engine".into()).spawn(move || serve(&jobs, &outbox))?;
        Ok(Self { requests, responses, cancelled })
    }
}

struct Outbox {
    sender: Sender<(u64, Response)>,
    wake: Wake,
    cancelled: Arc<AtomicU64>,
}

impl Outbox {
    fn send(&self, job: u64, response: Response) {
        // The window may be closed.
        if self.sender.send((job, response)).is_ok() {
            (self.wake)();
        }
    }
}

struct JobProgress<'a>(u64, &'a Outbox);

impl Progress for JobProgress<'_> {
    fn report(&self, stage: &str, fraction: f64) {
        self.1.send(self.0, Response::progress(stage, fraction));
    }

    fn is_cancelled(&self) -> bool {
        self.1.cancelled.load(Ordering::Relaxed) >= self.0
    }
}

fn serve(jobs: &Receiver<(u64, Request)>, outbox: &Outbox) {
    let mut session = Session::new();
    while let Ok((job, request)) = jobs.recv() {
        let partial = &mut |response| outbox.send(job, response);
        let response = session.execute_with(&request, &JobProgress(job, outbox), partial);
        outbox.send(job, response);
    }
}

impl Worker for Thread {
    fn send(&mut self, job: u64, request: Request) {
        // The thread lives as long as this sender.
        let _ = self.requests.send((job, request));
    }

    fn cancel(&mut self, job: u64) {
        self.cancelled.fetch_max(job, Ordering::Relaxed);
    }

    fn poll(&mut self) -> Option<(u64, Response)> {
        self.responses.try_recv().ok()
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.cancelled.store(u64::MAX, Ordering::Relaxed);
    }
}
