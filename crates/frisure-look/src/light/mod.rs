//! Lights: lamps, the environment light, and how photographers set them.

mod daylight;
mod environment_light;
mod environment_map;
mod error;
mod lamp;
mod lights;
mod setup;
mod spec;

pub use daylight::{Daylight, SUN_RADIUS};
pub use environment_light::EnvironmentLight;
pub use environment_map::{EnvironmentMap, MAX_ENVIRONMENT_WIDTH};
pub use error::InvalidLight;
pub use lamp::{AreaLight, AreaShape, DistantLight, Lamp, PointLight, SOFTBOX};
pub use lights::Lights;
pub use setup::{Setup, beside_camera};
pub use spec::{Face, LampFace, LampPlace, LampSpec, LightSpec};
