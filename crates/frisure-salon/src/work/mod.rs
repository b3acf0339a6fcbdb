//! Work behind the window: the stylist, on threads of a desktop or in the workers of a page.

#[cfg(not(target_arch = "wasm32"))]
mod native;
#[cfg(target_arch = "wasm32")]
mod web;

#[cfg(not(target_arch = "wasm32"))]
pub use native::Thread;
#[cfg(target_arch = "wasm32")]
pub use web::WebWorker;

use std::path::Path;

use frisure_stylist::order::{Answer, Order};

use crate::state::Ticket;

/// Someone who carries out orders, one after the other, somewhere else. Nothing here blocks.
pub trait Worker {
    /// Hands an order over.
    fn send(&mut self, ticket: Ticket, order: Order);

    /// The answer to an order does not matter any more.
    fn cancel(&mut self, ticket: Ticket);

    /// The next answer, if there is one.
    fn poll(&mut self) -> Option<(Ticket, Answer)>;

    /// Hands over a file that orders may name, where there is no file system.
    fn provide(&mut self, path: &Path, bytes: &[u8]);
}

/// Called, from any thread, when there is an answer to poll.
pub type Wake = Box<dyn Fn() + Send + Sync>;
