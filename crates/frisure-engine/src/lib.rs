//! Computes the hairstyle, the strands and the picture of a scene, for every program alike.
//!
//! A [`Runner`] computes hairstyles and strands of scenes and caches them, so that the next scene costs only what
//! changed. [`picture`] makes pictures of them, [`report`] measures them, and [`checkpoint`] saves long work on the way.
//! A [`Session`] is a runner behind plain data that can pass between threads: it executes a [`Request`] about a scene
//! and returns a [`Response`].
//!
//! ```
//! use frisure_engine::{Quality, Request, Response, SceneRef, Session};
//!
//! let text = "[hair]\nlength = '3 cm'\n[wisps]\ncount = 3\nhairs = 30\n";
//! let scene = SceneRef { name: "short".into(), text: text.into(), ..SceneRef::default() };
//! let request = Request::Preview { scene, quality: Quality::Exact };
//! let Response::Preview(preview) = Session::new().execute(&request, &()) else { panic!() };
//! assert_eq!((preview.numbers.wisps, preview.numbers.drawn), (3, 30));
//! ```

#![forbid(unsafe_code)]

mod accessories;
mod adoption;
mod bytes;
#[cfg(not(target_arch = "wasm32"))]
pub mod checkpoint;
mod diagnostic;
mod error;
mod groom;
mod hairstyles;
mod heads;
mod initial;
mod inputs;
pub mod memory;
mod metrics;
pub mod photo;
pub mod picture;
mod placement;
mod preview;
mod quality;
mod replicas;
pub mod report;
mod request;
mod response;
mod runner;
mod session;
mod steps;

pub use adoption::AdoptionReport;
pub use diagnostic::Diagnostic;
pub use error::{Error, catch_panic, message};
pub use heads::{HeadCache, LoadedHead};
pub use inputs::{environment_map, input_files, scene_groom};
pub use metrics::HairstyleMetrics;
pub use picture::Viewpoint;
pub use quality::Quality;
pub use replicas::ReplicaReport;
pub use request::{Request, SceneRef};
pub use response::{
    AccessoryData, AccessoryPart, GuideData, HeadData, Numbers, Preview, Response, StrandsData,
};
pub use runner::{LoadedScene, Runner};
pub use session::Session;
pub use steps::{StyledScene, stage_count};
