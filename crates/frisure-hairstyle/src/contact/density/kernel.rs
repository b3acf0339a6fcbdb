//! The kernel over which the volume of a piece of hair is spread.

use std::f64::consts::PI;

/// The factor of [`Kernel`] that makes its integral over space 1.
pub(super) const WENDLAND: f64 = 21.0 / (2.0 * PI);

/// Wendland's kernel of three dimensions that is twice differentiable (Wendland 1995), over the reach R (m):
/// `W(r) = 21/(2πR³) (1 − r/R)⁴ (1 + 4 r/R)`, whose integral over space is 1.
///
/// Its Fourier transform is positive, so that points that repel each other by it spread evenly and do not gather in pairs
/// (Dehnen & Aly 2012).
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    /// R (m).
    reach: f64,
    /// 1/R³ (1/m³).
    scale: f64,
}

impl Kernel {
    #[inline]
    pub(super) fn new(reach: f64) -> Self {
        Self { reach, scale: 1.0 / (reach * reach * reach) }
    }

    /// W (1/m³) at a distance (m); 0 from the reach on.
    #[inline]
    pub(super) fn value(self, distance: f64) -> f64 {
        let x = distance / self.reach;
        if x >= 1.0 {
            return 0.0;
        }
        let left = (1.0 - x) * (1.0 - x);
        WENDLAND * self.scale * left * left * (1.0 + 4.0 * x)
    }

    /// W′/r (1/m⁵) and W″ (1/m⁵) at a distance (m); both are 0 from the reach on, and equal at 0.
    #[inline]
    pub(super) fn derivatives(self, distance: f64) -> (f64, f64) {
        let x = distance / self.reach;
        if x >= 1.0 {
            return (0.0, 0.0);
        }
        let left = 1.0 - x;
        // W′ = −20 x (1 − x)³ · 21/(2πR⁴), W″ = −20 (1 − x)² (1 − 4x) · 21/(2πR⁵).
        let scale = -210.0 / PI * self.scale / (self.reach * self.reach) * left * left;
        (scale * left, scale * (1.0 - 4.0 * x))
    }

    /// ∫ W ds (1/m²) along a straight line through the centre, `7/(πR²)`.
    pub(super) fn line(self) -> f64 {
        7.0 / (PI * self.reach * self.reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_is_normalised_and_its_derivatives_are_its_own() {
        let kernel = Kernel::new(0.02);
        let n = 20_000;
        let step = 0.02 / f64::from(n);
        let at = |i: i32| (f64::from(i) + 0.5) * step;
        let volume: f64 =
            (0..n).map(|i| 4.0 * PI * at(i) * at(i) * kernel.value(at(i)) * step).sum();
        assert!((volume - 1.0).abs() < 1e-6, "{volume}");
        let line: f64 = (0..n).map(|i| 2.0 * kernel.value(at(i)) * step).sum();
        assert!((line / kernel.line() - 1.0).abs() < 1e-6, "{line}");
        for r in [1e-3, 4e-3, 0.012, 0.019] {
            let h = 1e-7;
            let (by_r, second) = kernel.derivatives(r);
            let slope = (kernel.value(r + h) - kernel.value(r - h)) / (2.0 * h);
            assert!((by_r * r - slope).abs() < 1e-5 * slope.abs().max(1.0), "{by_r} {slope}");
            let slope = |r: f64| kernel.derivatives(r).0 * r;
            let bend = (slope(r + h) - slope(r - h)) / (2.0 * h);
            assert!((second - bend).abs() < 1e-4 * bend.abs().max(1.0), "{second} {bend}");
        }
        assert_eq!(kernel.value(0.02), 0.0);
        assert_eq!(kernel.derivatives(0.03), (0.0, 0.0));
    }
}
