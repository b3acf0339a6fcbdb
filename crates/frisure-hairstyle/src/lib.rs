//! A whole head of hair: fibre and head → roots → guides → equilibrium → wisps → strands.

mod fibre;
pub mod head;
mod presets;
mod spec;

mod implantation;
mod roots;

pub mod contact;
mod pull;

mod bound_strands;
mod guides;
mod placement;
mod splits;
mod wisps;

mod hairstyle;
mod rest;
mod wisp_state;

mod adopt;
mod equilibrium;
mod predict;
mod strands;
mod volume;

pub mod styling;

mod history;

mod crossing;
mod grid;
mod monitor;
mod random;

pub use adopt::{Adoption, adopt};
pub use equilibrium::{Effort, SettlingReport, settling_report};
pub use fibre::{Curl, Fibre, Handedness};
pub use guides::Guide;
pub use hairstyle::Hairstyle;
pub use history::{History, HistoryError};
pub use implantation::PartingError;
pub use monitor::{Cancelled, Monitor};
pub use placement::Crowded;
pub use predict::{PredictError, PredictOptions, Start, predict, redrawn};
pub use presets::{Ellipticity, HairType, Moisture, NaturalCurl, PRESETS, Preset, Wetting, preset};
pub use pull::Pull;
pub use random::Draws;
pub use roots::{Root, scalp_area};
pub use spec::{
    Body, Comb, Contact, Flow, HairContact, HairModel, Hairline, Hairs, HairstyleSpec,
    Implantation, InvalidSpec, Length, Level, Lift, Parting, Place, RegionLength, RegionStyle,
    Settling, Turn, Whorls, Wisps,
};
pub use strands::{
    Checkpoint, DrawnHair, Simulation, StrandOptions, add_natural_strains, add_sections, describe,
    described_guides, guide_strands, penetration, simulation_key, strands,
};
pub use styling::{Draft, StyleOptions, selected, style};
pub use volume::{Volume, volume};
