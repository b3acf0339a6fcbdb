//! The salon: a head of hair that is seen, changed and styled, in a window and in a page.
//!
//! [`state`] is all of it without a toolkit.

pub mod state;
