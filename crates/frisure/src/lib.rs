//! frisure predicts how natural hair falls, from the physics of its fibres.
//!
//! One hair is an elastic rod, clamped in the scalp, that rests where elasticity and weight balance
//! ([`rod`]). A head of hair is some hundred such rods, its guides, with the drawn hairs around them
//! ([`hairstyle`]); what comes out are [`strands`], to be drawn ([`render`], with the [`optics`] of
//! a fibre) or written to a file ([`formats`]).
//!
//! This crate is a door: it holds nothing of its own.
//!
//! ```
//! use frisure::scene::Scene;
//! use frisure::rod::equilibrium;
//!
//! // A ringlet of 20 cm, held out horizontally.
//! let text = r#"
//!     [hair]
//!     length = "20 cm"
//!     curl = { radius = "1 cm", pitch = "3 cm" }
//! "#;
//! let hair = Scene::parse("ringlet", text, "".as_ref())?.single_hair()?;
//! let rest = equilibrium(&hair.rod, &[], &hair.options);
//! assert!(rest.tip().z < 0.0, "it hangs");
//! # Ok::<(), frisure::scene::SceneError>(())
//! ```

#![forbid(unsafe_code)]

#[cfg(not(target_arch = "wasm32"))]
pub use frisure_denoise as denoise;
pub use frisure_files as files;
pub use frisure_formats as formats;
pub use frisure_hairstyle as hairstyle;
pub use frisure_look as look;
pub use frisure_optics as optics;
pub use frisure_progress as progress;
pub use frisure_render as render;
pub use frisure_rod as rod;
pub use frisure_scene as scene;
pub use frisure_strands as strands;

#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
