//! The stylist on a thread.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use frisure_stylist::order::{Answer, Order, Refusal};
use frisure_stylist::{Stylist, Watch};

use super::{Wake, Worker};
use crate::state::Ticket;

/// A thread with a stylist.
pub struct Thread {
    orders: Sender<Job>,
    answers: Receiver<(Ticket, Answer)>,
    /// Orders up to this ticket were cancelled.
    cancelled: Arc<AtomicU64>,
}

enum Job {
    Order(Ticket, Order),
    File(PathBuf, Vec<u8>),
}

impl Thread {
    /// Starts it. It ends when this is dropped, after the order that it is at.
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
    out: Sender<(Ticket, Answer)>,
    wake: Wake,
    told: Arc<AtomicU64>,
}

impl Outbox {
    fn send(&self, ticket: Ticket, answer: Answer) {
        // A window that is gone needs no answer.
        if self.out.send((ticket, answer)).is_ok() {
            (self.wake)();
        }
    }
}

struct Watching<'a>(Ticket, &'a Outbox);

impl Watch for Watching<'_> {
    fn tell(&self, answer: Answer) {
        self.1.send(self.0, answer);
    }

    fn cancelled(&self) -> bool {
        self.1.told.load(Ordering::Relaxed) >= self.0
    }
}

fn serve(jobs: &Receiver<Job>, outbox: &Outbox) {
    let mut stylist = Stylist::new();
    while let Ok(job) = jobs.recv() {
        let (ticket, order) = match job {
            Job::Order(ticket, order) => (ticket, order),
            Job::File(path, bytes) => {
                stylist.provide(&path, bytes);
                continue;
            }
        };
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
    fn send(&mut self, ticket: Ticket, order: Order) {
        // The thread ends only with this.
        let _ = self.orders.send(Job::Order(ticket, order));
    }

    fn cancel(&mut self, ticket: Ticket) {
        self.cancelled.fetch_max(ticket, Ordering::Relaxed);
    }

    fn poll(&mut self) -> Option<(Ticket, Answer)> {
        self.answers.try_recv().ok()
    }

    fn provide(&mut self, path: &Path, bytes: &[u8]) {
        let _ = self.orders.send(Job::File(path.into(), bytes.to_vec()));
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.cancelled.store(u64::MAX, Ordering::Relaxed);
    }
}
