//! Does what a scene asks for.
//!
//! A scene is data; this crate carries it out, for every program alike: its head, its hair with
//! every step, and what a picture of it is made with. [`order`] is what can be asked of a [`Stylist`],
//! who remembers what it has done; [`carry`] and [`picture`] are the parts by themselves.

mod bytes;
pub mod carry;
mod exposing;
pub mod groom;
mod hair;
mod heads;
pub mod held;
pub mod order;
pub mod picture;
mod refusal;
mod shown;
mod stylist;
mod watch;

pub use stylist::Stylist;
pub use watch::Watch;
