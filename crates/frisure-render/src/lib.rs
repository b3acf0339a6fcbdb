//! Strands to picture, on the CPU.
//!
//! A picture is made of a [`Camera`], [`Lights`], a [`Look`] (the colours of hair, head and
//! background) and of what is seen: the strands and, if there is one, the surface they grow on.
//! [`preview::render`] draws them in a few seconds, by projection: every hair is a line of its true
//! width, shaded by one bounce of light and by shadows read from density maps. It writes no file:
//! the [`Image`] it returns holds scene-linear light, and [`Image::to_srgb8`] develops it. [`trace::render`]
//! follows the light itself, in minutes; [`accel`] finds where its rays meet hair and head.
//!
//! Lengths are metres, angles radians, z is up, the face looks towards −y; colours are linear sRGB.

pub mod accel;
mod camera;
mod film;
mod light;
mod look;
mod pigment;
pub mod preview;
pub mod trace;

pub use camera::{Aperture, Camera, CameraError};
pub use film::{Image, ToneCurve};
pub use light::{
    AreaLight, AreaShape, Daylight, DistantLight, EnvironmentLight, EnvironmentMap, InvalidLight,
    Lamp, Lights, MAX_ENVIRONMENT_WIDTH, PointLight, SOFTBOX, SUN_RADIUS, Setup, beside_camera,
    colour_of_temperature,
};
pub use look::{Background, Dye, Fade, Floor, HairLook, HairSurface, Look, SkinLook};
