//! A whole head of hair: fibre and head → roots → guides → equilibrium → wisps → strands.
//!
//! [`Hairstyle`] is plain data. [`predict()`] makes one from a [`HairstyleSpec`] and a [`head::Head`], [`style`] makes
//! another from it, [`strands()`] draws it. Long work reports to a `Progress` and can be cancelled; `&()` reports nothing.
//!
//! ```
//! use frisure_hairstyle::{PredictOptions, StrandOptions, head::Head, predict, preset, settling_report, strands};
//!
//! let mut spec = preset("wavy").expect("a preset").spec();
//! spec.wisps.count = 20; // few guides: quick
//! spec.wisps.hairs = frisure_hairstyle::Hairs::Count(100);
//! let head = Head::mannequin();
//! let hairstyle = predict(&spec, &head, PredictOptions::default(), &())?;
//! assert_eq!(settling_report(&hairstyle, &head).stable, 20);
//! let drawn = strands(&hairstyle, &head, StrandOptions::default(), &())?;
//! assert_eq!(drawn.strands.len(), 100);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Modules, in the order of computation: `head`, `spec`, `presets`, `implantation` (roots and directions), `contact`,
//! `guides`, `wisps`, `hairstyle` (data), `equilibrium`, `predict`, `adopt` and `transfer`, `strand_contact`, `strands`, `accessories`, `styling`, `history`. None uses
//! one that comes later.

#![forbid(unsafe_code)]

mod math;
mod parallel;
mod random;
mod rod_digest;

pub mod capillary;
mod fibre;
pub mod head;
mod product;
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
mod transfer;

mod strand_contact;
mod strands;
mod volume;

mod accessories;

pub mod styling;

mod history;

pub use accessories::{Accessory, AccessoryKind, accessories, accessory_meshes};
pub use adopt::{Adoption, adopt};
pub use contact::Pull;
pub use equilibrium::{
    Effort, FrictionalRod, HeadChange, HeadDerivativeError, HeadGradient, HeadSensitivity,
    MOST_ELEMENTS, SettlingReport, settling_report,
};
pub use fibre::{Curl, Fibre, Handedness, WetLocks, Wetting};
pub use guides::Guide;
pub use hairstyle::{Crowded, Hairstyle, JointCertificate, WetLockSizes};
pub use history::{History, HistoryError};
pub use implantation::{PartingError, Root, scalp_area};
pub use predict::{PredictError, PredictOptions, Start, predict, redrawn};
pub use presets::{Ellipticity, HairType, Moisture, NaturalCurl, PRESETS, Preset, preset};
pub use product::{Product, ProductLaw};
pub use random::Draws;
pub use spec::{
    Body, Comb, Contact, Flow, HairContact, HairModel, Hairline, Hairs, HairstyleSpec, HeadMethod,
    Implantation, InvalidSpec, Length, Level, Lift, Number, Parting, Place, Pose, Range,
    RegionLength, RegionStyle, Scalar, Settling, StrandContact, Turn, Whorls, Wind, Wisps, number,
};
pub use strand_contact::{InteractionForm, StrandCertificate};
pub use strands::{
    Checkpoint, DrawnHair, Simulation, StrandOptions, add_natural_strains, add_sections, describe,
    described_guides, guide_strands, penetration, simulation_key, strands,
};
pub use styling::{Draft, StyleOptions, selected, style};
pub use transfer::transfer;
pub use volume::{Volume, volume};
