//! What pulls on a rod all along it: gravity on its mass, and a constant force on its length.

use glam::DVec3;

use crate::error::{InvalidQuantity, finite};

/// A uniform load: gravity on the mass of a rod, and a force on its length.
///
/// The world frame is that of the root. Nothing in the theory needs the load to be along −z: \[paper\] (2.4) holds with the
/// height along [`Rod::up`](crate::Rod::up).
///
/// ```
/// use frisure_rod::Load;
/// use glam::DVec3;
///
/// let upright = Load::down(9.81);
/// assert_eq!(upright.gravity, DVec3::new(0.0, 0.0, -9.81));
/// let windy = Load { force: DVec3::X * 2e-5, ..upright };
/// assert_eq!(windy.per_length(5e-6), DVec3::new(2e-5, 0.0, -9.81 * 5e-6));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Acceleration of gravity (m/s², world).
    pub gravity: DVec3,
    /// Force per length that does not depend on the mass (N/m, world), such as that of a steady wind.
    pub force: DVec3,
}

impl Load {
    /// No load.
    pub const NONE: Self = Self { gravity: DVec3::ZERO, force: DVec3::ZERO };

    /// Gravity (m/s²) along −z, without any other force.
    #[must_use]
    pub const fn down(gravity: f64) -> Self {
        Self { gravity: DVec3::new(0.0, 0.0, -gravity), force: DVec3::ZERO }
    }

    /// The load per length (N/m, world) of a rod with this mass per length (kg/m).
    #[must_use]
    pub fn per_length(&self, mass: f64) -> DVec3 {
        self.gravity * mass + self.force
    }

    /// # Errors
    /// [`InvalidQuantity`] if a number is not finite.
    pub(crate) fn check(&self) -> Result<(), InvalidQuantity> {
        for x in self.gravity.to_array() {
            finite("component of gravity", x, "m/s²")?;
        }
        for x in self.force.to_array() {
            finite("component of the force per length", x, "N/m")?;
        }
        Ok(())
    }
}

/// A vector's direction and length; +z for none. Exact for vectors along z.
pub(crate) fn direction_and_length(v: DVec3) -> (DVec3, f64) {
    // Squares of loads of very light rods would vanish in f64.
    let largest = v.abs().max_element();
    if largest == 0.0 {
        return (DVec3::Z, 0.0);
    }
    let scaled = v / largest;
    let length = scaled.length();
    (scaled / length, length * largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_along_z_are_exact() {
        for w in [4.9e-5, 1.0 / 3.0, 1e-200, 1e200] {
            assert_eq!(direction_and_length(DVec3::Z * w), (DVec3::Z, w));
            assert_eq!(direction_and_length(DVec3::NEG_Z * w), (DVec3::NEG_Z, w));
        }
        assert_eq!(direction_and_length(DVec3::ZERO), (DVec3::Z, 0.0));
        let (way, length) = direction_and_length(DVec3::new(3e-180, 0.0, -4e-180));
        assert!((length / 5e-180 - 1.0).abs() < 1e-15 && (way.length() - 1.0).abs() < 1e-15);
    }
}
