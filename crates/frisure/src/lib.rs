//! frisure predicts how natural hair falls, from the physics of its fibres.
//!
//! This crate re-exports the libraries of the project and holds nothing of its own. What they do, in the order of the
//! computation:
//!
//! 1. **A fibre.** A hair is an elastic rod with an elliptical section and a natural curl, clamped in the scalp
//!    ([`rod::Rod`]). A [`scene`] describes its length, section, stiffness and curl with units; hair types
//!    ([`hairstyle::preset`]) have measured values for what the scene leaves out.
//! 2. **A head.** A mesh, or the built-in mannequin, with a scalp, landmarks and a signed distance to the skin
//!    ([`hairstyle::head::Head`]).
//! 3. **A hairstyle.** [`hairstyle::predict`] places some hundred guides on the scalp, each a rod with its own variation of
//!    the fibre. [`hairstyle::style`] changes them: wet, cut, comb, dry and more.
//! 4. **Equilibrium.** Each guide comes to rest at a minimum of its potential energy: elasticity, weight, contact with the
//!    body and with other hair ([`rod::equilibrium()`] for one rod). Each result has a certificate of its stability.
//! 5. **Strands.** [`hairstyle::strands()`] interpolates the drawn hairs between the guides, or simulates each. They are
//!    plain points and radii ([`strands::Strands`]).
//! 6. **A picture or a file.** [`render::preview`] makes a picture in seconds, [`render::trace`] the final one, with the
//!    scattering of light by an elliptical fibre ([`optics::scattering`]); [`formats::groom`] writes a groom that other
//!    programs read.
//!
//! ```
//! use frisure::formats::groom::{Format, Groom, encode};
//! use frisure::hairstyle::head::Head;
//! use frisure::hairstyle::{
//!     PredictOptions, StrandOptions, StyleOptions, predict, settling_report, strands, style,
//! };
//! use frisure::scene::Scene;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let text = r#"
//!     hair = { type = "caucasian-curly", length = "12 cm" }
//!     wisps = { count = 12, hairs = 100 }
//!     step = [{ wet = {} }]
//! "#;
//! let scene = Scene::parse("small.toml", text, "".as_ref())?; // 1. the fibre, with units
//! let head = Head::mannequin(); // 2.
//! let dry = predict(&scene.hairstyle_spec()?, &head, PredictOptions::default(), &())?; // 3., 4.
//! let wet = style(&dry, &head, &scene.steps()[0], StyleOptions::default(), &())?;
//! assert_eq!(settling_report(&wet, &head).stable, 12);
//! let hairs = strands(&wet, &head, StrandOptions::default(), &())?.strands; // 5.
//! assert_eq!(hairs.len(), 100);
//! let format = Format::named("hair").unwrap();
//! let bytes = encode(format, &Groom::of(hairs), Default::default())?; // 6.
//! assert!(bytes.starts_with(b"HAIR"));
//! # Ok(())
//! # }
//! ```
//!
//! # Where is …
//!
//! | what | where |
//! | --- | --- |
//! | the elastic energy of a rod, its gradient and Hessian | [`rod::potential::Elastic`], `crates/frisure-rod/src/potential/elastic.rs` |
//! | the Newton step: Hessian, factorisation, line search | [`rod::minimise::Newton`], `crates/frisure-rod/src/minimise` |
//! | contact (collision) of hair with the head | `crates/frisure-hairstyle/src/contact/body.rs`, on the signed distance of `crates/frisure-hairstyle/src/head/distance.rs` |
//! | contact of hair with hair | `crates/frisure-hairstyle/src/contact/neighbours.rs`, solved by `crates/frisure-hairstyle/src/equilibrium/head_solver.rs` |
//! | the wet law: water, swelling, softening, humidity | `crates/frisure-hairstyle/src/styling/wet_law.rs`, [`hairstyle::Wetting`], [`hairstyle::Moisture`]; the look of wet hair: `crates/frisure-optics/src/scattering/film.rs` |
//! | sampling of the elliptical fibre | [`optics::scattering::HairBsdf::sample`], `crates/frisure-optics/src/scattering` |
//! | the declaration of a scene key: unit, range, text | [`scene::keys`], `crates/frisure-scene/src/keys.rs`; how to add one: `CONTRIBUTING.md`, "Add a scene key with a slider" |
//! | the declaration of a styling operation | `crates/frisure-scene/src/operation/operations.rs`; `CONTRIBUTING.md`, "Add an operation" |
//! | the groom formats | [`formats::groom::Format`], `crates/frisure-formats/src/groom`; `CONTRIBUTING.md`, "Add a groom format" |
//! | the equations and their sources | `docs/theory.md` |
//!
//! `docs/glossary.md` has the words of the field and where each is in the code, `ARCHITECTURE.md` the map of the crates.

#![forbid(unsafe_code)]

pub use frisure_cards as cards;
#[cfg(not(target_arch = "wasm32"))]
pub use frisure_denoise as denoise;
pub use frisure_files as files;
pub use frisure_fit as fit;
pub use frisure_formats as formats;
pub use frisure_hairstyle as hairstyle;
pub use frisure_look as look;
pub use frisure_measure as measure;
pub use frisure_optics as optics;
pub use frisure_progress as progress;
pub use frisure_render as render;
pub use frisure_rod as rod;
pub use frisure_scene as scene;
pub use frisure_strands as strands;

#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
