//! Interactive pictures of hair on a GPU, for a window or a page. No GUI toolkit is in it: a [`Renderer`] draws a
//! [`Frame`] into a [`Canvas`], and shows that in a pass of the caller.
//!
//! The picture is that of [`frisure_render::preview`], drawn again for each camera: materials, the environment's light,
//! widths, lobes and numbers are the same code or the same formulas, and tests compare the two.
//!
//! In the order in which a picture is drawn:
//!
//! 1. **Shadow maps of each lamp.** `shaders/density.wgsl` adds pieces of hair up in layers behind one another: the
//!    light-oriented density map of Bertails, Ménier & Cani 2005, "A practical self-shadowing algorithm for
//!    interactive hair animation". Their slices are planes across the light, evenly spaced; ours begin at the
//!    first hair of each texel, as in Yuksel & Keyser 2008, "Deep opacity maps", and are the farther apart the
//!    deeper they are, since hair is dark after a few millimetres. The head has a map of depths. ShadowMaps are drawn
//!    again when a lamp has moved (a studio turns with the camera), hair or head are others.
//! 2. **The environment's light.** The preview's grid, computed here where hair, head or environment are others.
//! 3. **Light along the hairs** (`shaders/shade.wgsl`): one texel for each vertex. Diffuse light of Kajiya &
//!    Kay 1989, highlights of Marschner et al. 2003 as [`frisure_optics::lobes`] has them, wet hair, marks.
//! 4. **How far away the head is**, so that it hides hair.
//! 5. **Hair** (`shaders/hair.wgsl`): ribbons that face the eye, with the exact part of each pixel that they
//!    cover, so that thin hair is faint and does not flicker. Pieces are sorted by depth and laid under one
//!    another, nearest first, in a few parts; between parts, pixels that let nothing through any more are closed
//!    by the depth buffer, and most of the hair is never painted.
//! 6. **The head** in the same light, with several samples per pixel, where hair leaves it free.
//! 7. **Hair over head over background**, developed as [`frisure_look::ToneCurve`] says; then lines.
//!
//! A [`Plane`] is no surface among others: it tints whatever lies behind it, which for straight lines of sight is
//! the same, and needs no sorting.
//!
//! A share of the hairs is the beginning of an order in which each beginning is spread evenly over the head; the
//! fewer are drawn, the wider they are. Only textures, vertex buffers and one uniform buffer are used, no storage
//! and no compute: it runs on WebGL 2.
//!
//! What it does not do: light that bounces between hairs is a colour, not a computation, as in the preview; four
//! lamps at most cast shadows, and the light of others is added to the nearest of these; strands are not cut into
//! finer pieces as the eye comes near; pieces that cross may be seen in the wrong order; what lies behind the
//! head's edge is guessed from the pixels beside it; a floor ([`frisure_look::Floor`]) is left out.

#![forbid(unsafe_code)]

mod ambient;
mod cache;
mod canvas;
mod context;
mod error;
mod frame;
mod gpu;
mod hair;
mod lamps;
mod marks;
mod paint;
mod pieces;
mod renderer;
mod ribbons;
mod shadow_maps;
mod skin;
mod uniforms;

pub use canvas::Canvas;
pub use error::ViewError;
pub use frame::{Frame, Line, MAX_PLANES, Plane, Shadows};
pub use hair::Hair;
pub use marks::{Mark, MarkColours};
pub use renderer::Renderer;
pub use skin::Skin;
