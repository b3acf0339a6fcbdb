//! Where a point of hair is, and the density that one makes at another.

use glam::DVec3;

use super::kernel::Kernel;

/// What is read of a point for each of its neighbours, in one place of the memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site {
    pub(super) position: DVec3,
    /// Half of the reach (m) of the kernel between two points of the same kind.
    pub(super) half_reach: f64,
    /// Volume (m³) that its hairs take, by the cross-section of the wisp.
    pub(super) volume: f64,
}

impl Site {
    /// The kernel between two points.
    #[inline]
    pub(super) fn kernel(&self, other: &Self) -> Kernel {
        Kernel::new(self.half_reach + other.half_reach)
    }

    /// Fraction of space that the hair of `other` takes here.
    #[inline]
    pub(super) fn density_of(&self, other: &Self) -> f64 {
        let (square, reach) =
            (self.position.distance_squared(other.position), self.half_reach + other.half_reach);
        // Before the root and the divisions: of those that may be within reach half are not.
        if square >= reach * reach {
            return 0.0;
        }
        other.volume * self.kernel(other).value(square.sqrt())
    }
}
