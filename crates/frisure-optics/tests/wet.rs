//! Wet hair is darker: much hair of one fibre, followed by random walk.

mod support;

use frisure_look::{Melanin, absorption};
use frisure_optics::scattering::{Fibre, FibreFrame, FibreSpec, HairBsdf};
use glam::Vec3;
use support::Random;

/// Colour of a layer of round fibres that lie along x in no order, as thick as `thickness` free paths,
/// under light from everywhere: mean weight of walks that enter from above and come out again.
fn colour(spec: FibreSpec, thickness: f32) -> Vec3 {
    const WALKS: u16 = 6000;
    let fibre = Fibre::new(spec).unwrap();
    let frame = FibreFrame::new(Vec3::X, Vec3::Z);
    let (mut random, mut sum) = (Random(11), Vec3::ZERO);
    for _ in 0..WALKS {
        let (mut depth, mut weight) = (0.0_f32, Vec3::ONE);
        let mut way = Vec3::new(0.3, 0.2, -0.93).normalize();
        for _ in 0..400 {
            // Fibres stand in the way in proportion to the sine of the angle to them.
            let free = -(1.0 - random.next()).ln() as f32 / way.y.hypot(way.z).max(1e-3);
            depth -= free * way.z;
            if depth < 0.0 || depth > thickness {
                sum += weight;
                break;
            }
            let h = (2.0 * random.next() - 1.0) as f32;
            let s = HairBsdf::new(&fibre, frame.to_local(-way), h).sample(random.four());
            (weight, way) = (weight * s.weight, frame.to_world(s.wi));
            if weight.max_element() < 1e-4 {
                break;
            }
        }
    }
    sum / f32::from(WALKS)
}

/// The pigment of the traced head.
const DARK: Melanin = Melanin { eumelanin: 1.3, pheomelanin: 0.0 };

fn brown(wetness: f32) -> FibreSpec {
    FibreSpec { wetness, absorption: absorption(DARK), ..Default::default() }
}

#[test]
fn water_darkens_deep_brown_hair_and_more_water_more() {
    let [dry, damp, wet] = [0.0, 0.5, 1.0].map(|w| colour(brown(w), f32::INFINITY));
    assert!(damp.cmplt(dry * 0.85).all() && wet.cmplt(damp * 0.85).all(), "{dry} {damp} {wet}");
}

#[test]
fn water_darkens_a_lock_lit_from_all_sides_and_blue_most() {
    // A traced head of brown hair in a white room has 0.84, 0.79, 0.72 of its dry colour, 0.80 of its
    // luminance, its shape unchanged; the paper (§3.2.1) has a fifth less for hair that also clumps.
    let ratio = colour(brown(1.0), 5.0) / colour(brown(0.0), 5.0);
    assert!(ratio.x > ratio.y && ratio.y > ratio.z, "{ratio}");
    assert!(ratio.min_element() > 0.65 && ratio.max_element() < 0.9, "{ratio}");
}
