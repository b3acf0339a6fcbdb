//! Smooth noise in space, with its gradient: the fine structure of surfaces.
//!
//! Gradient noise after Perlin 2002, *Improving noise*. Ours, since what renderers need of it is the gradient, in single precision and the same on
//! every machine; libraries of noise give values only, or more than a renderer reads.

use glam::{IVec3, Vec3};

use crate::hash::mix;

/// Random bits of a cell of a lattice. The factors are odd, and far from multiples of each other (Teschner et al. 2003 multiply by large primes and combine by
/// exclusive or; these are those of MurmurHash3 and the golden ratio).
pub(crate) fn cell(at: IVec3, seed: u32) -> u32 {
    let [x, y, z] = at.to_array().map(|x| x as u32);
    let (x, y) = (x.wrapping_mul(0x9e37_79b9), y.wrapping_mul(0x85eb_ca6b));
    mix(seed.wrapping_mul(0x27d4_eb2f) ^ x ^ y ^ z.wrapping_mul(0xc2b2_ae35))
}

/// A number in [0, 1) of some bits.
pub(crate) fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

/// The noise at `p`, in lattice units: about −0.8 to 0.8 with a mean of 0 and a deviation of 0.25; and its gradient.
pub(crate) fn noise(p: Vec3, seed: u32) -> (f32, Vec3) {
    // By a cast: rounding is a call into the C library on processors without SSE 4.1.
    let towards_zero = p.as_ivec3();
    let above = towards_zero.as_vec3().cmpgt(p);
    let corner = towards_zero - IVec3::select(above, IVec3::ONE, IVec3::ZERO);
    let t = p - corner.as_vec3();
    // Perlin's quintic, whose second derivatives vanish at corners.
    let weight = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let slope = 30.0 * t * t * (t * (t - 2.0) + 1.0);
    let (mut value, mut gradient) = (0.0, Vec3::ZERO);
    for k in 0..8 {
        let at = IVec3::new(k & 1, k >> 1 & 1, k >> 2 & 1);
        let direction = edge(cell(corner + at, seed));
        let distance = direction.dot(t - at.as_vec3());
        // w = Π (x or 1 − x); its derivative along an axis leaves that factor out.
        let one = at.as_vec3();
        let part = one * weight + (Vec3::ONE - one) * (Vec3::ONE - weight);
        let change = (2.0 * one - Vec3::ONE) * slope;
        let w = part.x * part.y * part.z;
        let dw = Vec3::new(part.y * part.z, part.x * part.z, part.x * part.y) * change;
        value += w * distance;
        gradient += w * direction + dw * distance;
    }
    (value, gradient)
}

/// One of the twelve directions to the edges of a cube.
fn edge(bits: u32) -> Vec3 {
    let (a, b) = (if bits & 1 == 0 { 1.0 } else { -1.0 }, if bits & 2 == 0 { 1.0 } else { -1.0 });
    match (bits >> 2) % 3 {
        0 => Vec3::new(a, b, 0.0),
        1 => Vec3::new(a, 0.0, b),
        _ => Vec3::new(0.0, a, b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_is_the_slope_of_the_value() {
        for i in 0..200 {
            let p = Vec3::new(0.37, -0.83, 0.21) * i as f32 + Vec3::new(0.1, 0.2, 0.3);
            let (_, gradient) = noise(p, 7);
            for axis in Vec3::AXES {
                let h = 1e-2 * axis;
                let slope = (noise(p + h, 7).0 - noise(p - h, 7).0) / 2e-2;
                assert!((slope - gradient.dot(axis)).abs() < 5e-3, "{p} {slope} {gradient}");
            }
        }
    }

    #[test]
    fn it_has_no_mean_and_the_stated_spread() {
        let values: Vec<f32> =
            (0..20_000).map(|i| noise(Vec3::new(0.61, 0.37, 0.29) * i as f32, 3).0).collect();
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let variance = values.iter().map(|x| x * x).sum::<f32>() / values.len() as f32;
        assert!(mean.abs() < 0.01, "{mean}");
        assert!((0.2..0.32).contains(&variance.sqrt()), "{}", variance.sqrt());
        assert!(values.iter().all(|x| x.abs() < 1.0));
    }
}
