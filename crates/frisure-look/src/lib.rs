//! Camera, lights, materials and colours: the plain data that scene files describe and renderers draw with.
//!
//! A picture needs a [`Camera`], [`Lights`] (lamps and an environment light) and a [`Look`] (the materials of hair,
//! skin, background and floor). A scene file describes them relative to the head that it shows: [`CameraSpec`],
//! [`LightSpec`] and [`LookSpec`] become the former once the head and the camera are known. Nothing here traces a ray
//! or reads a file.
//!
//! Lengths are metres, angles radians, z is up, the face looks towards −y; colours are linear sRGB.

#![forbid(unsafe_code)]

mod camera;
mod colour;
mod hair;
mod light;
mod look;
mod pigment;
mod shade;
mod tone;

pub use camera::{Aperture, CAMERAS, Camera, CameraError, CameraSpec, NamedCamera};
pub use colour::{colour_of_temperature, linear_from_srgb};
pub use hair::{Dye, Fade, HairLook, HairSurface, Scattering};
pub use light::{
    AreaLight, AreaShape, Daylight, DistantLight, EnvironmentLight, EnvironmentMap, Face,
    InvalidLight, Lamp, LampFace, LampPlace, LampSpec, LightSpec, Lights, MAX_ENVIRONMENT_WIDTH,
    PointLight, SOFTBOX, SUN_RADIUS, Setup, beside_camera,
};
pub use look::{Backdrop, Background, Floor, Look, LookSpec, SkinLook};
pub use pigment::{Melanin, absorption, absorption_of_colour, apparent_colour};
pub use shade::{SHADES, Shade};
pub use tone::ToneCurve;
