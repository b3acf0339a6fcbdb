//! From a scene to a hairstyle, strands and a picture, for every program alike.
//!
//! A [`Session`] executes a [`Request`] about a scene and returns a [`Response`], both plain data; it
//! caches heads, hairstyles and strands, so that the next request computes only what changed.
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

mod accumulate;
mod adoption;
mod bytes;
mod checkpoint_file;
mod error;
mod groom;
mod hairstyles;
mod heads;
mod initial;
mod inputs;
pub mod picture;
mod preview;
mod request;
mod response;
mod session;

pub use adoption::AdoptionReport;
pub use checkpoint_file::CheckpointFile;
pub use error::{Error, catch_panic};
pub use groom::groom;
pub use heads::{HeadCache, LoadedHead};
pub use initial::initial_hairstyle;
pub use inputs::{environment_map, head_mesh, scene_groom};
pub use request::{Quality, Request, SceneRef, Viewpoint};
pub use response::{Diagnostic, GuideData, HeadData, Numbers, Preview, Response, StrandsData};
pub use session::Session;
