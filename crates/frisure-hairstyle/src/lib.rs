//! A whole head of hair: fibre and head → roots → guides → equilibrium → wisps → strands.

mod fibre;
pub mod head;
mod presets;
mod spec;

pub use fibre::{Curl, Fibre, Handedness};
pub use presets::{PRESETS, Preset, preset};
pub use spec::{
    Body, Contact, Flow, HairstyleSpec, Implantation, InvalidSpec, Length, Lift, Settling, Wisps,
};
