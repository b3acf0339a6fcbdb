//! What colours of hair must do, in the preview and in the traced picture.

use frisure_look::{Background, Camera, Dye, Fade, HairLook, Lights, Look};
use frisure_look::{SHADES, Shade, absorption_of_colour};
use frisure_render::Scene;
use frisure_render::preview::{self, PreviewOptions};
use frisure_render::trace::{self, TraceOptions};
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::{DVec3, Vec3};

/// A slab of hair 8 cm long, hanging along z, `deep` layers of 50 hairs of 0.3 mm; the camera sees its
/// middle only.
fn slab(deep: u8) -> Strands {
    let mut strands = Strands::new();
    for layer in 0..deep {
        for column in 0..50_u8 {
            // Golden offsets, so that no two layers stand behind each other.
            let x = (f32::from(column) + f32::from(layer) * 0.618 % 1.0 - 25.0) * 4e-4;
            let y = f32::from(layer) * 4e-4;
            let at = |k: u8| Vec3::new(x, y, 0.04 - 0.01 * f32::from(k));
            let points: Vec<Vec3> = (0..9).map(at).collect();
            strands.push(&points, &[1.5e-4; 9]);
        }
    }
    strands
}

fn look(hair: HairLook) -> Look {
    Look { hair, background: Background::Transparent, ..Look::default() }
}

/// The slab from in front, of which the picture shows a strip 1 cm wide and `heights` (m) high.
fn scene(strands: &Strands, hair: HairLook, (low, high): (f64, f64)) -> Scene<'_> {
    let mut scene = Scene { look: look(hair), ..Scene::portrait(strands, None) };
    let target = DVec3::new(0.0, 0.0, 0.5 * (low + high));
    let fov = 2.0 * (0.5 * (high - low)).atan();
    scene.camera = Camera::look_at(target - DVec3::Y, target, DVec3::Z, fov).unwrap();
    scene.lights = Lights::studio(&scene.camera);
    scene
}

fn mean(image: &frisure_render::Image) -> Vec3 {
    let sum = image
        .pixels()
        .iter()
        .fold([0.0; 4], |s: [f32; 4], p| [s[0] + p[0], s[1] + p[1], s[2] + p[2], s[3] + p[3]]);
    Vec3::new(sum[0], sum[1], sum[2]) / sum[3]
}

fn traced(scene: &Scene<'_>, paths: usize) -> Vec3 {
    let options = TraceOptions {
        width: 10,
        height: 10,
        samples: paths,
        bounces: 200,
        seed: 3,
        ..Default::default()
    };
    mean(&trace::render(scene, &options, &()).unwrap())
}

fn drawn(scene: &Scene<'_>) -> Vec3 {
    let options = PreviewOptions { width: 40, height: 40, samples: 1, width_scale: Some(1.0) };
    mean(&preview::render(scene, &options, &()).unwrap())
}

const MIDDLE: (f64, f64) = (-0.005, 0.005);

fn plain() -> HairLook {
    HairLook { variation: 0.0, ..HairLook::default() }
}

fn named(name: &str) -> HairLook {
    let shade = Shade::named(name).unwrap();
    HairLook { melanin: shade.melanin, white_share: shade.white_share, ..plain() }
}

fn luminance(colour: Vec3) -> f32 {
    colour.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

#[test]
fn names_go_from_light_to_dark_in_both_pictures() {
    let strands = slab(24);
    let of = |name: &str| {
        let scene = scene(&strands, named(name), MIDDLE);
        [luminance(traced(&scene, 48)), luminance(drawn(&scene))]
    };
    let scale: Vec<[f32; 2]> = SHADES[..10].iter().map(|shade| of(shade.name)).collect();
    for pair in scale.windows(2) {
        // Of the darkest, nearly all light is that of the surface.
        assert!(pair[1][0] < 1.01 * pair[0][0] && pair[1][1] < pair[0][1], "{scale:?}");
    }
    let reds = ["copper", "red", "auburn"].map(|name| of(name)[0]);
    assert!(reds.is_sorted_by(|a, b| a > b), "{reds:?}");
    let [white, half, dark] = ["white", "salt-and-pepper", "dark-brown"].map(|name| of(name)[0]);
    assert!(half < white && half > dark);
}

#[test]
fn red_is_redder_than_brown_and_black_has_no_colour() {
    let strands = slab(24);
    let of = |name| traced(&scene(&strands, named(name), MIDDLE), 64);
    let (red, brown, black) = (of("red"), of("brown"), of("jet-black"));
    assert!(red.x / red.y > 1.1 * brown.x / brown.y, "{red} {brown}");
    assert!(black.max_element() < 1.25 * black.min_element(), "{black}");
}

#[test]
fn much_dyed_hair_has_the_colour_of_the_dye() {
    // Light from everywhere on deep hair is what the published fit is for.
    let strands = slab(60);
    let colour = Vec3::new(0.55, 0.2, 0.4);
    let surface = HairLook::default().surface;
    let dye = Dye {
        absorption: absorption_of_colour(colour, surface.azimuthal_roughness),
        strength: 1.0,
        regrowth: 0.0,
    };
    // White hairs and black ones take it alike.
    for white_share in [0.0, 1.0] {
        let mut scene =
            scene(&strands, HairLook { dye: Some(dye), white_share, ..plain() }, MIDDLE);
        scene.lights = Lights::even(Vec3::ONE);
        let seen = traced(&scene, 128);
        assert!(((seen - colour) / colour).abs().max_element() < 0.25, "{seen} {colour}");
    }
}

#[test]
fn white_hairs_are_the_share_that_is_asked_for_and_the_seed_says_which() {
    // Black hairs are seen as such one by one: pixels a hair wide.
    let mut strands = Strands::new();
    for i in 0..400_u16 {
        let x = (f32::from(i) - 199.5) * 2.5e-4;
        strands.push(&[Vec3::new(x, 0.0, 0.01), Vec3::new(x, 0.0, -0.01)], &[1e-4; 2]);
    }
    let light = |share: f32, seed: u32| -> Vec<f32> {
        let hair = HairLook { white_share: share, seed, ..named("jet-black") };
        let scene = scene(&strands, hair, (-0.05, 0.05));
        let options = PreviewOptions { width: 400, height: 400, samples: 1, width_scale: None };
        let image = preview::render(&scene, &options, &()).unwrap();
        (0..400).map(|x| luminance(Vec3::from_slice(&image.pixel(x, 200)))).collect()
    };
    let [black, white] = [0.0, 1.0].map(|share| light(share, 1));
    let is_white = |seen: &[f32]| -> Vec<bool> {
        (0..400).map(|i| seen[i] > 0.5 * (black[i] + white[i])).collect()
    };
    let some = is_white(&light(0.3, 1));
    let share = some.iter().filter(|w| **w).count() as f32 / 400.0;
    // Three standard deviations.
    assert!((share - 0.3).abs() < 0.07, "{share}");
    assert_eq!(some, is_white(&light(0.3, 1)));
    assert_ne!(some, is_white(&light(0.3, 2)));
    // More white hairs are the same ones and others.
    let more = is_white(&light(0.6, 1));
    assert!(some.iter().zip(&more).all(|(some, more)| more >= some));
}

#[test]
fn roots_and_tips_fade_without_a_step_and_dye_begins_where_hair_has_grown() {
    let strands = slab(24);
    let light = |hair: HairLook| -> Vec<f32> {
        // From root to tip in steps of 4 mm.
        let strip = |k: u8| {
            let middle = 0.038 - 0.004 * f64::from(k);
            drawn(&scene(&strands, hair, (middle - 0.002, middle + 0.002))).x
        };
        (1..19).map(strip).collect()
    };
    // Lighter hair sees its neighbours: in the preview, blond hair beside such dye is a sixth darker.
    let none = light(named("dark-blond"));
    let roots = Fade { factor: 3.0, length: 0.04 };
    let tips = Fade { factor: 0.3, length: 0.03 };
    let faded: Vec<f32> = light(HairLook { roots, tips, ..named("dark-blond") });
    let ratio: Vec<f32> = faded.iter().zip(&none).map(|(f, n)| f / n).collect();
    for pair in ratio.windows(2) {
        assert!(pair[1] > 0.99 * pair[0] && pair[1] - pair[0] < 0.25, "{ratio:?}");
    }
    assert!(ratio[0] < 0.7 && ratio[17] > 1.2, "{ratio:?}");
    let dye = Dye { absorption: Vec3::splat(4.0), strength: 1.0, regrowth: 0.04 };
    let dyed = light(HairLook { dye: Some(dye), ..named("dark-blond") });
    assert!((dyed[3] / none[3] - 1.0).abs() < 0.15 && dyed[15] < 0.5 * none[15], "{dyed:?}");
}

#[test]
fn wetness_counts_where_it_is() {
    let strands = |wet_half: bool| {
        let mut strands = slab(24);
        let values = (0..strands.points().len())
            .map(|i| if wet_half && strands.points()[i].z < 0.0 { 1.0 } else { 0.0 });
        let values = AttributeValues::F32(values.collect());
        let wetness = Attribute { name: "wetness".into(), domain: Domain::Point, values };
        strands.set_attribute(wetness).unwrap();
        strands
    };
    let (wet, dry) = (strands(true), strands(false));
    let light = |strands: &Strands, at: f64| {
        let mut scene = scene(strands, named("light-brown"), (at - 0.004, at + 0.004));
        scene.lights = Lights::even(Vec3::ONE);
        luminance(traced(&scene, 64))
    };
    // The slab, too, loses about a fifth, and none of it where it is dry.
    let ratio = |at| light(&wet, at) / light(&dry, at);
    let (upper, lower) = (ratio(0.03), ratio(-0.025));
    assert!((upper - 1.0).abs() < 0.06 && lower > 0.6 && lower < 0.9, "{upper} {lower}");
}
