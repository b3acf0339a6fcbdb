//! e^x of four numbers at once, without calls into the mathematics library.
//!
//! A hit needs a dozen exponentials; written so that the compiler makes them four at a time with the
//! vector instructions that every x86-64 and aarch64 has. Also the same bits on every machine.

/// 1.5·2²³: adding it rounds a float to an integer, which then lies in the low bits.
const ROUND: f32 = 12_582_912.0;

/// ln 2 in two parts, the first of few bits, so that n·ln 2 loses nothing.
const LN2_HIGH: f32 = 0.693_359_4;
const LN2_LOW: f32 = -2.121_944_4e-4;

/// e^x, relative error below 2e-7 for x in [−87, 88]; below that range 1.6e-38, above it 1.7e38.
pub(super) fn exp4(x: [f32; 4]) -> [f32; 4] {
    x.map(exp)
}

/// e^x of one number, as [`exp4`].
#[inline(always)]
pub(super) fn exp(x: f32) -> f32 {
    // `clamp` would keep NaN, and is slower.
    #[expect(clippy::manual_clamp)]
    let x = x.max(-87.0).min(88.0);
    let shifted = x * core::f32::consts::LOG2_E + ROUND;
    let n = shifted - ROUND;
    let f = (x - n * LN2_HIGH) - n * LN2_LOW;
    // Cephes' expf: e^f = 1 + f + f² P(f), |f| ≤ ½ ln 2.
    let p = 1.987_569_2e-4;
    let p = p * f + 1.398_199_9e-3;
    let p = p * f + 8.333_452e-3;
    let p = p * f + 4.166_579_6e-2;
    let p = p * f + 1.666_666_5e-1;
    let p = p * f + 0.5;
    let y = p * f * f + f + 1.0;
    y * f32::from_bits((shifted.to_bits() << 23).wrapping_add(0x3f80_0000))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_library() {
        for i in -8_600..8_700_i16 {
            let x = f32::from(i) * 0.01;
            let exact = f64::from(x).exp();
            assert!((f64::from(exp(x)) / exact - 1.0).abs() < 2e-7, "{x}");
        }
        assert_eq!(exp4([0.0; 4]), [1.0; 4]);
    }

    #[test]
    fn is_finite_everywhere() {
        for x in [f32::NEG_INFINITY, -1e9, f32::NAN, 1e9, f32::INFINITY] {
            assert!(exp(x).is_finite() && exp(x) > 0.0);
        }
    }
}
