//! Drawn hairs that are rods themselves.

use frisure_hairstyle::head::Head;
use frisure_hairstyle::{
    Body, Checkpoint, HairContact, HairModel, Hairs, Hairstyle, HairstyleSpec, PredictOptions,
    StrandContact, StrandOptions, guide_strands, penetration, predict, preset, simulation_key,
    strands as draw,
};
use frisure_progress::Progress;
use frisure_rod::Resolution;
use frisure_strands::Strands;
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::Mutex;

fn spec(name: &str) -> HairstyleSpec {
    let mut spec = preset(name).unwrap().spec();
    spec.wisps.count = 40;
    spec.wisps.hairs = Hairs::Count(600);
    spec.contact.hair = HairContact::Layers;
    spec.wisps.strands = HairModel::Simulated;
    spec
}

fn length(points: &[Vec3]) -> f64 {
    points.windows(2).map(|pair| f64::from(pair[0].distance(pair[1]))).sum()
}

fn strands(hairstyle: &Hairstyle, head: &Head) -> Strands {
    draw(hairstyle, head, StrandOptions::default(), &()).unwrap().strands
}

/// No point is in the head, and no line between two of them is deeper than chords of a curve that touches it.
fn out_of(head: &Head, hairs: &Strands, name: &str) {
    let depth = |p: &Vec3| -head.signed_distance().value(p.as_dvec3());
    let points = (0..hairs.len()).flat_map(|i| &hairs.strand(i).points[1..]);
    let deepest = points.map(depth).fold(0.0, f64::max);
    assert!(deepest < 1e-5, "{name}: {deepest}");
    let deepest = penetration(hairs, head);
    assert!(deepest < 2.5e-4, "{name}: {deepest}");
}

/// All of them rest, none in the head, and each is as long as it grew.
#[test]
fn every_hair_rests_on_the_skin() {
    let head = Head::mannequin();
    for name in ["straight", "wavy", "curly", "frizzy"] {
        let hairstyle = predict(&spec(name), &head, PredictOptions::default(), &()).unwrap();
        let drawn = draw(&hairstyle, &head, StrandOptions::default(), &()).unwrap();
        let (hairs, simulation) = (drawn.strands, drawn.simulation);
        assert_eq!((simulation.hairs, hairs.len()), (600, 600));
        assert_eq!(simulation.at_rest, 600, "{name}: {simulation:?}");
        out_of(&head, &hairs, name);
    }
}

/// A hair that is what its guide is falls as its guide does, which was solved by itself, to another accuracy.
#[test]
fn a_hair_like_its_guide_falls_as_it_does() {
    let head = Head::mannequin();
    let mut spec = spec("wavy");
    spec.wisps.fuzziness = 0.0;
    spec.wisps.flyaways = 0.0;
    spec.wisps.blending = 0.0;
    spec.wisps.clumping = 0.0;
    spec.wisps.splits = 1;
    spec.wisps.length_variation = 0.0;
    spec.wisps.growing = 0.0;
    spec.length.variation_between = 0.0;
    spec.fibre.variation = 0.0;
    spec.fibre.axis_ratio_variation = 0.0;
    spec.implantation.baby_hairs = 0.0;
    // Next to nothing holds a hair in its place, and that is not far away.
    spec.wisps.count = 400;
    spec.contact.hair_stiffness = 1e-6;
    spec.contact.hair = HairContact::None;
    spec.contact.body = Body::None;
    spec.equilibrium.resolution = Resolution::Accuracy(1e-4);
    let hairstyle = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
    let hairs = strands(&hairstyle, &head);
    let guides = guide_strands(&hairstyle, spec.wisps.points);
    let Some(frisure_strands::AttributeValues::U32(of)) =
        hairs.attribute("guide").map(|a| &a.values)
    else {
        panic!("hairs have guides")
    };
    let mut apart: Vec<f32> = (hairs.iter().zip(of))
        .map(|(hair, guide)| {
            let (hair, guide) = (hair.points, guides.strand(*guide as usize).points);
            let moved = hair[0] - guide[0];
            hair.iter().zip(guide).map(|(a, b)| (*a - moved).distance(*b)).fold(0.0, f32::max)
        })
        .collect();
    apart.sort_by(f32::total_cmp);
    // A per cent of their length, for which they have elements enough, and what still holds them.
    let (median, most) = (apart[300], apart[599]);
    let length = spec.length.mean as f32;
    assert!(median < 0.01 * length && most < 0.03 * length, "{median} {most} of {length}");
}

#[test]
fn hairs_differ_by_their_fibres() {
    let head = Head::mannequin();
    let of = |fuzziness: f64| {
        let mut spec = spec("curly");
        spec.wisps.fuzziness = fuzziness;
        spec.wisps.flyaways = 0.0;
        strands(&predict(&spec, &head, PredictOptions::default(), &()).unwrap(), &head)
    };
    let (alike, unlike) = (of(0.0), of(1.0));
    let apart = |a: &Strands, b: &Strands| -> f64 {
        let tip = |s: &Strands, k: usize| *s.strand(k).points.last().unwrap();
        (0..600).map(|k| f64::from(tip(a, k).distance(tip(b, k)))).sum::<f64>() / 600.0
    };
    assert!(apart(&alike, &unlike) > 1e-3);
    for hair in unlike.iter() {
        assert!(length(hair.points) > 1e-3);
    }
}

#[test]
fn the_same_bytes_whatever_the_number_of_threads_and_whichever_are_drawn() {
    let head = Head::mannequin();
    let mut spec = spec("curly");
    spec.wisps.hairs = Hairs::Count(1500);
    let hairstyle = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| strands(&hairstyle, &head))
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one.points(), three.points());
    let some =
        draw(&hairstyle, &head, StrandOptions { stride: 7, ..StrandOptions::default() }, &())
            .unwrap()
            .strands;
    for (k, hair) in some.iter().enumerate() {
        assert_eq!(hair.points, one.strand(7 * k).points);
    }
}

/// Keeps parts until there are enough of them, and then asks to stop.
#[derive(Default)]
struct Kept {
    before: BTreeMap<usize, Vec<u8>>,
    now: Mutex<BTreeMap<usize, Vec<u8>>>,
    enough: usize,
}

impl Checkpoint for Kept {
    fn find(&self, part: usize) -> Option<&[u8]> {
        self.before.get(&part).map(Vec::as_slice)
    }

    fn save(&self, part: usize, bytes: &[u8]) {
        self.now.lock().unwrap().insert(part, bytes.to_vec());
    }
}

impl Progress for Kept {
    fn report(&self, _: &str, _: f64) {}

    fn is_cancelled(&self) -> bool {
        self.now.lock().unwrap().len() >= self.enough
    }
}

fn saved_in(checkpoint: &Kept) -> StrandOptions<'_> {
    StrandOptions { checkpoint: Some(checkpoint), ..StrandOptions::default() }
}

#[test]
fn work_that_was_cut_off_goes_on_to_the_same_bytes() {
    let head = Head::mannequin();
    let mut spec = spec("wavy");
    spec.wisps.hairs = Hairs::Count(5000);
    let hairstyle = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
    let whole = draw(&hairstyle, &head, StrandOptions::default(), &()).unwrap();
    let cut = Kept { enough: 2, ..Kept::default() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let stopped = pool.install(|| draw(&hairstyle, &head, saved_in(&cut), &cut));
    assert!(stopped.is_err());
    let before = cut.now.into_inner().unwrap();
    assert_eq!(before.len(), 2);
    let mut on = Kept { before, enough: usize::MAX, ..Kept::default() };
    // What is spoilt is done again.
    on.before.values_mut().next().unwrap().pop();
    let again = draw(&hairstyle, &head, saved_in(&on), &()).unwrap();
    assert_eq!(on.now.lock().unwrap().len(), 4);
    assert_eq!(again, whole);
    let key = simulation_key(&hairstyle, &head);
    spec.wisps.fuzziness += 0.01;
    assert!(
        key.is_some()
            && key
                != simulation_key(
                    &predict(&spec, &head, PredictOptions::default(), &()).unwrap(),
                    &head
                )
    );
}

fn in_contact(name: &str, hairs: usize, friction: f64) -> HairstyleSpec {
    let mut spec = spec(name);
    spec.wisps.hairs = Hairs::Count(hairs);
    spec.wisps.contact = StrandContact::Contacts;
    spec.contact.friction = friction;
    spec
}

/// Forces between hairs of a head are equal and opposite, and no hair is in the head. How near to rest they come is a part of the
/// certificate, and is not always near (docs/performance.md).
#[test]
fn hairs_in_contact_push_equally() {
    let head = Head::mannequin();
    for (name, friction) in [("straight", 0.3), ("curly", 0.0)] {
        let spec = in_contact(name, 200, friction);
        let hairstyle = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
        let drawn = draw(&hairstyle, &head, StrandOptions::default(), &()).unwrap();
        let certificate = drawn.simulation.contact.unwrap();
        assert!(certificate.contacts > 100 && certificate.imbalance < 1e-9, "{certificate:?}");
        assert_eq!(certificate.friction_ratio > 0.0, friction > 0.0);
        assert!((certificate.represented - hairstyle.grown() / 200.0).abs() < 1e-9);
        out_of(&head, &drawn.strands, name);
    }
}

#[test]
fn hairs_in_contact_are_the_same_whatever_the_number_of_threads() {
    let head = Head::mannequin();
    let spec = in_contact("wavy", 100, 0.4);
    let hairstyle = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| draw(&hairstyle, &head, StrandOptions::default(), &()).unwrap())
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(8));
}

#[test]
fn hairs_in_contact_can_be_cancelled_and_are_not_saved() {
    let head = Head::mannequin();
    let spec = in_contact("straight", 120, 0.3);
    let hairstyle = predict(&spec, &head, PredictOptions::default(), &()).unwrap();
    let token = frisure_progress::CancellationToken::default();
    token.cancel();
    assert!(draw(&hairstyle, &head, StrandOptions::default(), &token).is_err());
    let kept = Kept { enough: usize::MAX, ..Kept::default() };
    draw(&hairstyle, &head, saved_in(&kept), &kept).unwrap();
    assert!(kept.now.into_inner().unwrap().is_empty());
}
