//! Reports: a hairstyle and its steps as data for files and people.

mod hairstyle;
mod step;

pub use hairstyle::{
    CoarseLines, ContactReport, DEEP, EnergyReport, GuideReport, HairstyleReport, SimulationReport,
    StrandContactReport, ThicknessReport, VolumeReport, WetLockReport, status,
};
pub use step::{CutReport, StepReport};
