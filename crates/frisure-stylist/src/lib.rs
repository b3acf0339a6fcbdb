//! Does what a scene asks for.
//!
//! A scene is data; this crate carries it out, for every program alike: its head, its hair with
//! every step, and what a picture of it is made with.

mod bytes;
pub mod order;
pub mod picture;
