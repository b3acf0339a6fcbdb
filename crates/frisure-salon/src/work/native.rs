//! The stylist on a thread.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use frisure_stylist::order::{Answer, Order, Refusal};
use frisure_stylist::{Stylist, Watch};

use super::Worker;

/// Called, from any thread, when there is an answer to poll.
pub type Wake = Box<dyn Fn() + Send + Sync>;

/// A thread with a stylist. Dropped, it ends.
pub struct Thread {
    orders: Sender<(u64, Order)>,
    answers: Receiver<(u64, Answer)>,
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
    out: Sender<(u64, Answer)>,
    wake: Wake,
    told: Arc<AtomicU64>,
}

impl Outbox {
    fn send(&self, ticket: u64, answer: Answer) {
        // A window that is gone needs no answer.
        if self.out.send((ticket, answer)).is_ok() {
            (self.wake)();
        }
    }
}

struct Watching<'a>(u64, &'a Outbox);

impl Watch for Watching<'_> {
    fn tell(&self, answer: Answer) {
        self.1.send(self.0, answer);
    }

    fn cancelled(&self) -> bool {
        self.1.told.load(Ordering::Relaxed) >= self.0
    }
}

fn serve(jobs: &Receiver<(u64, Order)>, outbox: &Outbox) {
    let mut stylist = Stylist::new();
    while let Ok((ticket, order)) = jobs.recv() {
        let work = AssertUnwindSafe(|| stylist.carry_out(&order, &Watching(ticket, outbox)));
        let answer = catch_unwind(work).unwrap_or_else(|_| {
            // What it knew may be half done.
            stylist = Stylist::new();
            Answer::Refused(Refusal {
                problem: "the computation failed inside; this is our mistake".into(),
                hint: "Your scene is kept. Undo the last change, and please report it.".into(),
                ..Refusal::default()
            })
        });
        outbox.send(ticket, answer);
    }
}

impl Worker for Thread {
    fn send(&mut self, ticket: u64, order: Order) {
        // The thread ends only with this.
        let _ = self.orders.send((ticket, order));
    }

    fn cancel(&mut self, ticket: u64) {
        self.cancelled.fetch_max(ticket, Ordering::Relaxed);
    }

    fn poll(&mut self) -> Option<(u64, Answer)> {
        self.answers.try_recv().ok()
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.cancelled.store(u64::MAX, Ordering::Relaxed);
    }
}
