//! The stylist on a thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use frisure::progress::Progress;
use frisure_engine::{Request, Response, Session};

use super::Worker;

/// Called, from any thread, when there is an answer to poll.
pub type Wake = Box<dyn Fn() + Send + Sync>;

/// A thread with a stylist. Dropped, it ends.
pub struct Thread {
    orders: Sender<(u64, Request)>,
    answers: Receiver<(u64, Response)>,
    /// Orders up to this ticket were cancelled.
    cancelled: Arc<AtomicU64>,
}

impl Thread {
    /// Starts it.
    ///
    /// # Errors
    /// If the system has no room for a thread.
    pub fn start(wake: Wake) -> std::io::Result<Self> {
        let (orders, jobs) = channel();
        let (out, answers) = channel();
        let cancelled = Arc::new(AtomicU64::new(0));
        let told = cancelled.clone();
        thread::Builder::new()
            .name("stylist".into())
            .spawn(move || serve(&jobs, &Outbox { out, wake, told }))?;
        Ok(Self { orders, answers, cancelled })
    }
}

struct Outbox {
    out: Sender<(u64, Response)>,
    wake: Wake,
    told: Arc<AtomicU64>,
}

impl Outbox {
    fn send(&self, ticket: u64, answer: Response) {
        // A window that is gone needs no answer.
        if self.out.send((ticket, answer)).is_ok() {
            (self.wake)();
        }
    }
}

struct Watching<'a>(u64, &'a Outbox);

impl Progress for Watching<'_> {
    fn report(&self, stage: &str, fraction: f64) {
        self.1.send(self.0, Response::progress(stage, fraction));
    }

    fn is_cancelled(&self) -> bool {
        self.1.told.load(Ordering::Relaxed) >= self.0
    }
}

fn serve(jobs: &Receiver<(u64, Request)>, outbox: &Outbox) {
    let mut session = Session::new();
    while let Ok((ticket, order)) = jobs.recv() {
        let progress = Watching(ticket, outbox);
        let send = &mut |answer| outbox.send(ticket, answer);
        let answer = session.execute_with(&order, &progress, send);
        outbox.send(ticket, answer);
    }
}

impl Worker for Thread {
    fn send(&mut self, ticket: u64, order: Request) {
        // The thread ends only with this.
        let _ = self.orders.send((ticket, order));
    }

    fn cancel(&mut self, ticket: u64) {
        self.cancelled.fetch_max(ticket, Ordering::Relaxed);
    }

    fn poll(&mut self) -> Option<(u64, Response)> {
        self.answers.try_recv().ok()
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.cancelled.store(u64::MAX, Ordering::Relaxed);
    }
}
