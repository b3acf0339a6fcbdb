//! A whole head of hair: fibre and head → roots → guides → equilibrium → wisps → strands.

mod fibre;
pub mod head;
mod presets;
mod spec;

mod implantation;
mod roots;

pub mod contact;
mod pull;

mod adopted;
mod equilibrium;
mod guides;
mod hairstyle;
mod splits;
mod strands;
mod volume;
mod wisps;

pub mod styling;

mod history;

mod crossing;
mod grid;
mod monitor;
mod random;

pub use adopted::{Adoption, adopt};
pub use equilibrium::{Effort, SettlingReport};
pub use fibre::{Curl, Fibre, Handedness};
pub use guides::{Crowded, Guide};
pub use hairstyle::{
    Hairstyle, PredictError, predict, predict_again, predict_from, predict_roughly,
};
pub use history::{History, HistoryError};
pub use implantation::PartingError;
pub use monitor::{Cancelled, Monitor};
pub use presets::{Ellipticity, HairType, Moisture, NaturalCurl, PRESETS, Preset, Wetting, preset};
pub use pull::Pull;
pub use random::Draws;
pub use roots::{Root, scalp_area};
pub use spec::{
    Body, Comb, Contact, Flow, HairContact, HairModel, Hairline, Hairs, HairstyleSpec,
    Implantation, InvalidSpec, Length, Level, Lift, Parting, Place, RegionLength, RegionStyle,
    Settling, Turn, Whorls, Wisps,
};
pub use strands::{Keep, Simulation, penetration};
pub use volume::{Volume, volume};
