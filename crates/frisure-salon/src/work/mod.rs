//! Execution of requests away from the window's thread.

#[cfg(not(target_arch = "wasm32"))]
pub mod native;

use std::sync::Arc;

use frisure_engine::{Request, Response};

/// Repaints the window; called from any thread when there is a response to poll.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// Executes requests one after the other. Nothing here blocks.
pub trait Worker {
    /// Sends a request; its responses come back under this job.
    fn send(&mut self, job: u64, request: Request);
    /// Cancels a job; [`Response::Cancelled`] comes back soon.
    fn cancel(&mut self, job: u64);
    /// The next response.
    fn poll(&mut self) -> Option<(u64, Response)>;
}
