//! Reports: a hairstyle, its steps and its adopted groom as data for files and people.

mod adoption;
mod hairstyle;
mod step;

pub use adoption::AdoptionReport;
pub use hairstyle::{
    ContactReport, EnergyReport, GuideReport, HairstyleReport, SimulationReport, ThicknessReport,
    VolumeReport,
};
pub use step::{CutReport, StepReport};
