//! Work off the window's thread: orders in, answers out.

use frisure_stylist::order::{Answer, Order};

#[cfg(target_arch = "wasm32")]
pub mod web;

/// Someone who carries out orders elsewhere.
pub trait Worker {
    /// Hands in an order; its answers come back under this ticket.
    fn send(&mut self, ticket: u64, order: Order);
    /// An order is outdated: [`Answer::Cancelled`] comes back soon.
    fn cancel(&mut self, ticket: u64);
    /// The next answer, if there is one.
    fn poll(&mut self) -> Option<(u64, Answer)>;
}
