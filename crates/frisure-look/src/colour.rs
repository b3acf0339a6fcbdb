//! Colour spaces: sRGB, CIE XYZ and black-body temperatures.

use glam::{DVec3, Vec3};

/// Linear light of an sRGB colour (IEC 61966-2-1), each channel from 0 to 1.
#[must_use]
pub fn linear_from_srgb(srgb: [f64; 3]) -> Vec3 {
    let decode = |c: f64| {
        if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    Vec3::from_array(srgb.map(|c| decode(c) as f32))
}

/// Linear sRGB of CIE XYZ (IEC 61966-2-1).
pub(crate) fn srgb_from_xyz(xyz: DVec3) -> DVec3 {
    DVec3::new(
        xyz.dot(DVec3::new(3.240_97, -1.537_383, -0.498_611)),
        xyz.dot(DVec3::new(-0.969_244, 1.875_968, 0.041_555)),
        xyz.dot(DVec3::new(0.055_63, -0.203_977, 1.056_972)),
    )
}

/// Luminance of linear sRGB (IEC 61966-2-1).
pub(crate) fn luminance(rgb: DVec3) -> f64 {
    rgb.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// The colour of a glowing body at a temperature (K, kept between 1667 and 25 000), linear sRGB of
/// luminance 1: 2900 a lamp, 5500 noon, 6500 white, 10 000 blue sky. After Kim et al. 2002, US patent
/// 7 024 034, cubic in 1/T.
#[must_use]
pub fn colour_of_temperature(kelvin: f64) -> Vec3 {
    let t = if kelvin.is_finite() { kelvin.clamp(1667.0, 25_000.0) } else { 6500.0 };
    let k = 1e3 / t;
    let cubic = |[a, b, c, d]: [f64; 4], x: f64| ((a * x + b) * x + c) * x + d;
    let x = match t <= 4000.0 {
        true => cubic([-0.266_123_9, -0.234_358_9, 0.877_695_6, 0.179_91], k),
        false => cubic([-3.025_846_9, 2.107_037_9, 0.222_634_7, 0.240_39], k),
    };
    let y = cubic(
        match t {
            ..=2222.0 => [-1.106_381_4, -1.348_110_2, 2.185_558_32, -0.202_196_83],
            ..=4000.0 => [-0.954_947_6, -1.374_185_93, 2.091_370_15, -0.167_488_67],
            _ => [3.081_758, -5.873_386_7, 3.751_129_97, -0.370_014_83],
        },
        x,
    );
    srgb_from_xyz(DVec3::new(x / y, 1.0, (1.0 - x - y) / y)).max(DVec3::ZERO).as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn temperatures_go_from_red_to_blue_through_white() {
        let white = colour_of_temperature(6504.0);
        assert!((white - Vec3::ONE).abs().max_element() < 0.06, "{white}");
        let colours = [1800.0, 2900.0, 5000.0, 9000.0, 20_000.0].map(colour_of_temperature);
        assert!(colours.windows(2).all(|c| c[1].x < c[0].x && c[1].z > c[0].z), "{colours:?}");
        for colour in colours {
            assert!((luminance(colour.as_dvec3()) - 1.0).abs() < 0.03);
        }
    }
}
