//! A whole head of hair: fibre and head → roots → guides → equilibrium → wisps → strands.

mod math;
mod random;

mod fibre;
pub mod head;
mod spec;

mod presets;

mod implantation;

pub mod contact;

mod guides;

mod wisps;

mod hairstyle;

mod equilibrium;

mod adopt;
mod predict;

mod strands;
mod volume;

pub mod styling;

mod history;

pub use adopt::{Adoption, adopt};
pub use contact::Pull;
pub use equilibrium::{Effort, SettlingReport, settling_report};
pub use fibre::{Curl, Fibre, Handedness, Wetting};
pub use guides::Guide;
pub use hairstyle::{Crowded, Hairstyle};
pub use history::{History, HistoryError};
pub use implantation::{PartingError, Root, scalp_area};
pub use predict::{PredictError, PredictOptions, Start, predict, redrawn};
pub use presets::{Ellipticity, HairType, Moisture, NaturalCurl, PRESETS, Preset, preset};
pub use random::Draws;
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
