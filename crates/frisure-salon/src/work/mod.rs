//! Work off the window's thread: orders in, answers out.

#[cfg(not(target_arch = "wasm32"))]
pub mod native;
#[cfg(target_arch = "wasm32")]
pub mod web;

use frisure_engine::{Request, Response};

/// Someone who carries out orders elsewhere, one after the other. Nothing here waits.
pub trait Worker {
    /// Hands in an order; its answers come back under this ticket.
    fn send(&mut self, ticket: u64, order: Request);
    /// An order is outdated: [`Response::Cancelled`] comes back soon.
    fn cancel(&mut self, ticket: u64);
    /// The next answer, if there is one.
    fn poll(&mut self) -> Option<(u64, Response)>;
}
