//! The salon in a page: `page/start.js` starts it, `page/worker.js` starts its workers.

mod aria_tree;
mod failure;
pub mod files;
mod graphics;
pub mod js_api;
mod options;
mod platform;
mod start;
pub mod storage;
pub mod worker;
mod worker_client;

pub use options::PageOptions;
pub use start::start;
