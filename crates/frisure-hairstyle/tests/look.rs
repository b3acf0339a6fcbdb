//! What a head of hair looks like, as laws: the face is free, a parting is a line, hairs are a population.

use std::sync::OnceLock;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::{
    Flow, Hairs, HairstyleSpec, PredictOptions, StrandOptions, predict, preset, strands as draw,
};
use frisure_strands::Strands;
use glam::DVec3;

fn head() -> &'static Head {
    static HEAD: OnceLock<Head> = OnceLock::new();
    HEAD.get_or_init(Head::mannequin)
}

fn spec(name: &str, guides: usize, hairs: usize) -> HairstyleSpec {
    let mut spec = preset(name).unwrap().spec();
    (spec.wisps.count, spec.wisps.hairs) = (guides, Hairs::Count(hairs));
    spec
}

fn strands(spec: &HairstyleSpec) -> Strands {
    let hairstyle = predict(spec, head(), PredictOptions::default(), &()).unwrap();
    draw(&hairstyle, head(), StrandOptions::default(), &()).unwrap().strands
}

/// The share of strands that cross one of two boxes before the eyes: 2.6 cm wide, 2.4 cm high, from the front half of the
/// head on.
fn before_the_eyes(strands: &Strands) -> f64 {
    let marks = head().landmarks();
    let height = marks.brow.z - 0.35 * (marks.hairline.z - marks.brow.z);
    let front = marks.cranium_centre.y - 0.4 * marks.cranium_radii.y;
    let inside = |p: DVec3| {
        let aside = (p.x.abs() - 0.21 * marks.width).abs();
        aside < 0.013 && (p.z - height).abs() < 0.012 && p.y < front
    };
    let crosses = strands.iter().filter(|hair| hair.points.iter().any(|p| inside(p.as_dvec3())));
    crosses.count() as f64 / strands.len() as f64
}

#[test]
fn eyes_are_free_where_hair_is_combed() {
    for name in ["asian-straight", "caucasian-straight", "caucasian-wavy", "frizzy", "coily"] {
        let combed = before_the_eyes(&strands(&spec(name, 100, 2000)));
        assert!(combed <= 0.01, "{name}: {combed}");
    }
}

/// Of curls that nothing holds several times as many fall over the eyes.
#[test]
fn combed_hair_is_held_out_of_the_face() {
    let mut spec = spec("caucasian-curly", 100, 2000);
    let held = before_the_eyes(&strands(&spec));
    spec.implantation.hold = 0.0;
    let loose = before_the_eyes(&strands(&spec));
    assert!(held <= 0.015 && held < 0.5 * loose, "{held} {loose}");
}

/// A parting is 1 to 3 mm wide on photographs; the strip where hair hides less than 63 % of the skin.
#[test]
fn a_parting_is_a_line() {
    let mut spec = spec("caucasian-straight", 100, 60_000);
    spec.implantation.flow = Flow::Parted { offset: 0.0 };
    spec.length.mean = 0.06;
    let marks = head().landmarks();
    // From 3 cm behind the hairline to above the ears, where the head is nearly level.
    let (from, to) = (marks.hairline.y + 0.03, marks.cranium_centre.y);
    const BIN: f64 = 2.5e-4;
    let mut hidden = [0.0; 24];
    let hairs = strands(&spec);
    for hair in hairs.iter() {
        for (pair, radius) in hair.points.windows(2).zip(hair.radii) {
            let (a, b) = (pair[0].as_dvec3(), pair[1].as_dvec3());
            // Each segment in pieces shorter than a bin.
            let pieces = (a.distance(b) / (0.5 * BIN)).ceil() as usize;
            for k in 0..pieces {
                let p = a.lerp(b, (k as f64 + 0.5) / pieces as f64);
                let over = p.y > from && p.y < to && head().signed_distance().value(p) > 0.0;
                let bin = (p.x.abs() / BIN) as usize;
                if over && bin < hidden.len() && p.z > marks.cranium_centre.z {
                    let across = (b - a).truncate().length() / pieces as f64;
                    hidden[bin] += across * 2.0 * f64::from(*radius);
                }
            }
        }
    }
    // Both sides of the line; of a scalp with twice as many hairs as are drawn here.
    let grown = 2.0e6 * frisure_hairstyle::scalp_area(&spec, head()) / hairs.len() as f64;
    let covered = |area: f64| grown * area / (2.0 * BIN * (to - from)) > 1.0;
    let bare = hidden.iter().position(|&area| covered(area)).unwrap() as f64 * 2.0 * BIN;
    assert!(bare <= 3e-3, "{:.2} mm", 1e3 * bare);
}

/// Hair from a parting at the side lies over the top of the head, uphill, and does not fall back over the line.
#[test]
fn hair_stays_on_its_side_of_a_parting() {
    const OFFSET: f64 = 0.035;
    for (name, seed) in [("caucasian-straight", 3), ("caucasian-wavy", 1), ("caucasian-wavy", 4)] {
        let mut spec = spec(name, 250, 500);
        spec.seed = seed;
        spec.implantation.flow = Flow::Parted { offset: OFFSET };
        let marks = head().landmarks();
        let hairstyle = predict(&spec, head(), PredictOptions::default(), &()).unwrap();
        let (mut above, mut back) = (0, 0);
        for (guide, rest) in hairstyle.guides().iter().zip(hairstyle.equilibria()) {
            let root = guide.root.position;
            // In front, where the line is straight.
            let front = root.y < marks.cranium_centre.y - 0.03 && root.z > marks.cranium_centre.z;
            let beside = root.x < OFFSET - 5e-3 && root.x > OFFSET - 0.03;
            if !(front && beside) {
                continue;
            }
            let after = rest.at(&rest.chain(), 0.06 / rest.rod.length()).0;
            above += 1;
            back += usize::from(after.x > root.x);
        }
        assert!(above >= 5 && back == 0, "{name}, seed {seed}: {back} of {above}");
    }
}

#[test]
fn some_hairs_are_still_growing() {
    let mut spec = spec("straight", 30, 4000);
    spec.implantation.baby_hairs = 0.0;
    spec.wisps.length_variation = 0.0;
    spec.length.variation_between = 0.0;
    let shorter = |growing: f64| {
        let spec = HairstyleSpec {
            wisps: frisure_hairstyle::Wisps { growing, ..spec.wisps },
            ..spec.clone()
        };
        let length = |points: &[glam::Vec3]| -> f32 {
            points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
        };
        let all = strands(&spec);
        let least = 0.7 * spec.length.mean as f32;
        all.iter().filter(|hair| length(hair.points) < least).count() as f64 / all.len() as f64
    };
    assert!(shorter(0.0) < 0.01, "{}", shorter(0.0));
    // Of lengths spread evenly from 12 % to all of it, 66 % are below 70 %.
    let share = shorter(0.3);
    assert!((share - 0.3 * 0.66).abs() < 0.03, "{share}");
}

/// Root mean square (m) of what the outline of the hair, seen from the front, departs from its mean over 40°.
fn roughness(strands: &Strands) -> f64 {
    const BINS: usize = 90;
    let centre = head().landmarks().cranium_centre;
    let mut reach: Vec<Vec<f64>> = vec![Vec::new(); BINS];
    for p in strands.points() {
        let d = p.as_dvec3() - centre;
        if d.z > 0.0 {
            let bin = d.z.atan2(d.x) / std::f64::consts::PI * BINS as f64;
            reach[(bin as usize).min(BINS - 1)].push(d.x.hypot(d.z));
        }
    }
    // The outline is where all but 1 % of what lies in that direction ends.
    let edge = |all: &mut Vec<f64>| {
        all.sort_by(f64::total_cmp);
        all[(0.99 * all.len() as f64) as usize]
    };
    let edge: Vec<f64> = reach.iter_mut().map(edge).collect();
    let around = |k: usize| edge[k - 10..=k + 10].iter().sum::<f64>() / 21.0;
    let off: Vec<f64> = (10..BINS - 10).map(|k| (edge[k] - around(k)).powi(2)).collect();
    (off.iter().sum::<f64>() / off.len() as f64).sqrt()
}

#[test]
fn kinky_hair_has_an_even_outline() {
    let soft = spec("african-kinky", 300, 12_000);
    let mut tufts = soft.clone();
    tufts.wisps.blending = 0.0;
    tufts.wisps.clumping = 0.8;
    (tufts.wisps.split_phase, tufts.wisps.hair_phase) = (0.0, 0.0);
    let (soft, tufts) = (roughness(&strands(&soft)), roughness(&strands(&tufts)));
    assert!(soft < 0.8 * tufts, "{soft} {tufts}");
}
