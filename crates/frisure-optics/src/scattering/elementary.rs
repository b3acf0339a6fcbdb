//! Elementary functions without calls into the mathematics library, four at a time where four are
//! needed.
//!
//! A hit needs some thirty of them, and they are most of its cost. Polynomials are those of Cephes
//! (S. L. Moshier, *Methods and Programs for Mathematical Functions*); errors are a few units in the
//! last place.

use core::f32::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E, PI, TAU};

use glam::Vec4;

/// 1.5·2²³: adding it rounds a float to an integer, which then lies in the low bits.
const ROUND: f32 = 12_582_912.0;

/// ln 2 in two parts, the first of few bits, so that n·ln 2 loses nothing.
const LN2_HIGH: f32 = 0.693_359_4;
const LN2_LOW: f32 = -2.121_944_4e-4;

/// Σ c_i x^i, by Horner; coefficients from the highest down.
#[inline(always)]
pub(super) fn polynomial<const N: usize>(x: Vec4, coefficients: [f32; N]) -> Vec4 {
    let mut sum = Vec4::splat(coefficients[0]);
    for &c in &coefficients[1..] {
        sum = sum * x + Vec4::splat(c);
    }
    sum
}

/// e^x for x in [−87, 88]; the values at the ends beyond.
#[inline(always)]
pub(super) fn exp(x: Vec4) -> Vec4 {
    let x = x.max(Vec4::splat(-87.0)).min(Vec4::splat(88.0));
    // x = n ln 2 + f with |f| ≤ ½ ln 2; 2ⁿ is put together from the bits of its exponent.
    let shifted = x * LOG2_E + Vec4::splat(ROUND);
    let n = shifted - Vec4::splat(ROUND);
    let f = (x - n * LN2_HIGH) - n * LN2_LOW;
    const C: [f32; 6] =
        [1.987_569_2e-4, 1.398_199_9e-3, 8.333_452e-3, 4.166_579_6e-2, 1.666_666_5e-1, 0.5];
    let y = polynomial(f, C) * f * f + f + Vec4::ONE;
    let power = |bits: f32| f32::from_bits((bits.to_bits() << 23).wrapping_add(0x3f80_0000));
    y * Vec4::from_array(shifted.to_array().map(power))
}

/// ln x for positive normal x.
#[inline(always)]
pub(super) fn ln(x: f32) -> f32 {
    // x = 2^e m with m in [√½, √2).
    let bits = x.to_bits().wrapping_sub(0x3f35_04f3);
    let e = (bits as i32 >> 23) as f32;
    let m = f32::from_bits((bits & 0x007f_ffff).wrapping_add(0x3f35_04f3)) - 1.0;
    let mut p = 7.037_684e-2;
    for c in [
        -0.115_146_1,
        0.116_77,
        -0.124_201_41,
        0.142_493_23,
        -0.166_680_58,
        0.200_007_15,
        -0.249_999_94,
        0.333_333_3,
    ] {
        p = p * m + c;
    }
    e * LN_2 + (m + m * m * (m * p - 0.5))
}

/// The angle of the vector (x, y), in [−π, π]; 0 for the null vector.
#[inline(always)]
pub(super) fn atan2(y: Vec4, x: Vec4) -> Vec4 {
    let (ax, ay) = (x.abs(), y.abs());
    let (most, least) = (ax.max(ay), ax.min(ay));
    // Beyond tan(π/8), from π/4.
    let far = least.cmpgt(most * 0.414_213_57);
    let above = Vec4::select(far, least - most, least);
    let below = Vec4::select(far, least + most, most).max(Vec4::splat(1e-30));
    let q = above / below;
    let z = q * q;
    const C: [f32; 4] = [8.053_745e-2, -0.138_776_86, 0.199_777_11, -0.333_329_5];
    let angle = polynomial(z, C) * z * q + q;
    let angle = angle + Vec4::select(far, Vec4::splat(FRAC_PI_4), Vec4::ZERO);
    let angle = Vec4::select(ay.cmpgt(ax), Vec4::splat(FRAC_PI_2) - angle, angle);
    let angle = Vec4::select(x.cmplt(Vec4::ZERO), Vec4::splat(PI) - angle, angle);
    Vec4::select(y.cmplt(Vec4::ZERO), -angle, angle)
}

/// (sin x, cos x) for |x| of a few turns.
#[inline(always)]
pub(super) fn sin_cos(x: f32) -> (f32, f32) {
    let shifted = x * FRAC_2_PI + ROUND;
    let quarters = shifted - ROUND;
    // π/2 in three parts.
    let x = ((x - quarters * 1.570_312_5) - quarters * 4.837_513e-4) - quarters * 7.549_79e-8;
    let z = x * x;
    let sine = ((-1.951_529_6e-4 * z + 8.332_161e-3) * z - 0.166_666_55) * z * x + x;
    let cosine =
        ((2.443_315_7e-5 * z - 1.388_731_6e-3) * z + 4.166_664_6e-2) * z * z - 0.5 * z + 1.0;
    // The low two bits are the quarter: odd ones exchange sine and cosine, the second bit is the sign.
    let turn = shifted.to_bits();
    let (sine, cosine) = if turn & 1 == 1 { (cosine, sine) } else { (sine, cosine) };
    let negative = |flag: u32, v: f32| f32::from_bits(v.to_bits() ^ ((flag & 2) << 30));
    (negative(turn, sine), negative(turn.wrapping_add(1), cosine))
}

/// The same angles within [−π, π], for angles of a few turns.
#[inline(always)]
pub(super) fn wrap(angle: Vec4) -> Vec4 {
    let turns = (angle * (1.0 / TAU) + Vec4::splat(ROUND)) - Vec4::splat(ROUND);
    angle - turns * TAU
}

#[cfg(test)]
mod tests {
    use super::*;

    fn each(n: i16, step: f32, test: impl Fn(f32)) {
        (-n..=n).for_each(|i| test(f32::from(i) * step));
    }

    #[test]
    fn exponential() {
        each(8_600, 0.01, |x| {
            let ours = f64::from(exp(Vec4::splat(x)).y);
            assert!((ours / f64::from(x).exp() - 1.0).abs() < 2e-7, "{x}");
        });
        assert_eq!(exp(Vec4::ZERO), Vec4::ONE);
        for x in [f32::NEG_INFINITY, -1e9, 1e9, f32::INFINITY] {
            let ours = exp(Vec4::splat(x)).x;
            assert!(ours.is_finite() && ours > 0.0);
        }
    }

    #[test]
    fn logarithm() {
        each(8_700, 0.01, |x| {
            let x = x.exp();
            let exact = f64::from(x).ln();
            assert!((f64::from(ln(x)) - exact).abs() < 3e-7 * exact.abs().max(0.3), "{x}");
        });
        assert_eq!(ln(1.0), 0.0);
    }

    #[test]
    fn angle() {
        each(1_000, 0.003_141, |phi| {
            let (y, x) = (phi.sin() * 0.3, phi.cos() * 0.3);
            let ours = f64::from(atan2(Vec4::splat(y), Vec4::splat(x)).z);
            assert!((ours - f64::from(y).atan2(f64::from(x))).abs() < 4e-7, "{phi}");
        });
        assert_eq!(atan2(Vec4::ZERO, Vec4::ZERO), Vec4::ZERO);
        assert!((atan2(Vec4::ONE, Vec4::ZERO).x - FRAC_PI_2).abs() < 1e-6);
    }

    #[test]
    fn sine_and_cosine() {
        each(3_000, 0.01, |x| {
            let (sine, cosine) = sin_cos(x);
            assert!((f64::from(sine) - f64::from(x).sin()).abs() < 2e-7, "{x} {sine}");
            assert!((f64::from(cosine) - f64::from(x).cos()).abs() < 2e-7, "{x} {cosine}");
        });
    }

    #[test]
    fn wraps() {
        each(40, 0.3, |x| {
            let w = wrap(Vec4::splat(x)).x;
            assert!(w.abs() <= PI + 1e-5);
            assert!((w.sin() - x.sin()).abs() < 1e-5 && (w.cos() - x.cos()).abs() < 1e-5);
        });
    }
}
