//! What the workspace's own checks share: its Rust files as syntax, their modules, and figures about them.

#![forbid(unsafe_code)]

pub mod circles;
pub mod measure;
pub mod source;
pub mod tidy;
pub mod workspace;
