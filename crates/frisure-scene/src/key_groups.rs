//! Groups of keys about the same thing.

/// The keys about the file of the head, its path first; without it, the others have no effect.
pub const HEAD: [&str; 9] = [
    "head.mesh",
    "head.up",
    "head.unit",
    "head.scale",
    "head.turn",
    "head.scalp_group",
    "head.scalp_colour",
    "head.scalp_mask",
    "head.scalp_weights",
];

/// The keys about the file of the groom, its path first; without it, the others have no effect.
pub const GROOM: [&str; 9] = [
    "groom.file",
    "groom.up",
    "groom.unit",
    "groom.scale",
    "groom.turn",
    "groom.move",
    "groom.guides",
    "groom.head_model",
    "groom.head_mesh",
];

/// The keys whose values are paths.
pub const PATHS: [&str; 6] = [
    "head.mesh",
    "head.scalp_mask",
    "head.scalp_weights",
    "groom.file",
    "groom.head_mesh",
    "light.environment",
];

/// The keys about how the head is held.
pub(crate) const POSE: [&str; 3] = ["pose.pitch", "pose.roll", "pose.down"];

/// The keys about the sun of daylight.
pub(crate) const SUN: [&str; 3] = ["light.sun_azimuth", "light.sun_elevation", "light.turbidity"];

/// The keys about the main lamp of a setup.
pub(crate) const MAIN_LAMP: [&str; 3] = ["light.azimuth", "light.elevation", "light.size"];

/// The keys about an environment map, its path first.
pub(crate) const ENVIRONMENT: [&str; 2] = ["light.environment", "light.rotation"];
