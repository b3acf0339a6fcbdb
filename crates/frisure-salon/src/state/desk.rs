//! Which work is under way, and what is to be done next.
//!
//! One lane computes the hair that is seen; outdated work in it is cancelled. The other does what takes
//! its time beside it: final pictures, files, the hair to compare with.

use std::collections::VecDeque;

use frisure_engine::{Quality, Request, SceneRef};

/// Names one order and its answers.
pub type Ticket = u64;

/// Where work is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lane {
    /// The hair that is seen.
    Hair,
    /// What takes its time.
    Aside,
}

/// What the world outside has to do for the salon.
#[derive(Clone, Debug, PartialEq)]
pub enum Errand {
    /// Carry out an order; its answers come back through [`super::Salon::receive`].
    Work(Lane, Ticket, Box<Request>),
    /// Stop it: the answer does not matter any more.
    Cancel(Lane, Ticket),
    /// Write a file, or hand it to the browser to keep.
    Save(super::Save),
    /// Keep a text that is offered at the next start if there is no other end; `None` forgets it.
    Autosave(Option<String>),
}

/// What an order is for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Purpose {
    /// To know what is in a file.
    Contents,
    Show(Quality),
    Choose,
    Hair,
    Compare(usize),
    /// A file that is to go somewhere.
    File(super::Destination),
}

#[derive(Clone, Debug)]
pub(super) struct Job {
    pub(super) ticket: Ticket,
    pub(super) purpose: Purpose,
    pub(super) asked: SceneRef,
    /// Its answer does not matter any more.
    pub(super) outdated: bool,
}

/// Orders under way and those that wait.
#[derive(Debug, Default)]
pub(super) struct Desk {
    next: Ticket,
    pub(super) hair: Option<Job>,
    pub(super) aside: Option<Job>,
    waiting: VecDeque<(Purpose, SceneRef, Request)>,
    pub(super) errands: VecDeque<Errand>,
}

impl Desk {
    fn ticket(&mut self) -> Ticket {
        self.next += 1;
        self.next
    }

    /// Starts work on the hair; there is none under way.
    pub(super) fn start(&mut self, purpose: Purpose, asked: SceneRef, order: Request) {
        let ticket = self.ticket();
        self.hair = Some(Job { ticket, purpose, asked, outdated: false });
        self.errands.push_back(Errand::Work(Lane::Hair, ticket, Box::new(order)));
    }

    /// Tells the work on the hair that it is for nothing.
    pub(super) fn outdate(&mut self) {
        if let Some(job) = self.hair.as_mut().filter(|job| !job.outdated) {
            job.outdated = true;
            self.errands.push_back(Errand::Cancel(Lane::Hair, job.ticket));
        }
    }

    /// Work beside, when what is before it is done.
    pub(super) fn queue(&mut self, purpose: Purpose, asked: SceneRef, order: Request) {
        self.waiting.push_back((purpose, asked, order));
        self.advance();
    }

    /// Begins what waits, if nothing is under way beside.
    pub(super) fn advance(&mut self) {
        if self.aside.is_some() {
            return;
        }
        let Some((purpose, asked, order)) = self.waiting.pop_front() else { return };
        let ticket = self.ticket();
        self.aside = Some(Job { ticket, purpose, asked, outdated: false });
        self.errands.push_back(Errand::Work(Lane::Aside, ticket, Box::new(order)));
    }

    /// Stops what is done beside, and what waits for it.
    pub(super) fn stop_aside(&mut self) {
        self.waiting.clear();
        if let Some(job) = self.aside.as_mut().filter(|job| !job.outdated) {
            job.outdated = true;
            self.errands.push_back(Errand::Cancel(Lane::Aside, job.ticket));
        }
    }

    /// Nothing is under way any more, and nothing waits.
    pub(super) fn forget(&mut self) {
        (self.hair, self.aside) = (None, None);
        self.waiting.clear();
        self.errands.retain(|errand| !matches!(errand, Errand::Work(..) | Errand::Cancel(..)));
    }

    /// The lane that an order is done in.
    pub(super) fn lane_of(&self, ticket: Ticket) -> Option<Lane> {
        let is = |job: &Option<Job>| job.as_ref().is_some_and(|job| job.ticket == ticket);
        match (is(&self.hair), is(&self.aside)) {
            (true, _) => Some(Lane::Hair),
            (_, true) => Some(Lane::Aside),
            _ => None,
        }
    }

    /// Orders that wait for the one beside.
    pub(super) fn waiting(&self) -> usize {
        self.waiting.len()
    }
}
