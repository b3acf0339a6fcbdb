//! Rollers, ties, elastics, pins and clips: laws that hold for any hair that is held.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use frisure_hairstyle::head::{Head, Region};
use frisure_hairstyle::styling::{
    Braid, Clip, Comb, Operation, Release, Roll, Selection, Sides, Straighten, Tie, TiePlace, Tuck,
    Twist,
};
use frisure_hairstyle::{
    Accessory, AccessoryKind, HairContact, Hairs, Hairstyle, Place, PredictOptions, StyleOptions,
    accessories, accessory_meshes, predict, preset, style,
};
use frisure_strands::Surface;
use glam::DVec3;

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

/// Straight hair of a length (m) as it falls.
fn free(wisps: usize, length: f64) -> Hairstyle {
    let mut spec = preset("caucasian-straight").unwrap().spec();
    (spec.wisps.count, spec.length.mean) = (wisps, length);
    spec.wisps.hairs = Hairs::Count(300);
    spec.contact.hair = HairContact::Layers;
    predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap()
}

fn done(before: &Hairstyle, operation: impl Into<Operation>) -> Hairstyle {
    style(before, &HEAD, &operation.into(), StyleOptions::default(), &()).unwrap()
}

/// The accessories of hair, of which what holds for all is checked, and that they are gone after release.
fn found(held: &Hairstyle) -> Vec<Accessory> {
    let found = accessories(held, &HEAD);
    for accessory in &found {
        let Accessory { kind, wisps, mesh, .. } = accessory;
        assert!(is_closed(mesh) && volume(mesh) > 0.0, "{kind:?} is open or inside out");
        let skin = HEAD.signed_distance();
        let depth = mesh.positions().iter().map(|p| skin.value(*p)).fold(f64::INFINITY, f64::min);
        assert!(depth > 0.0, "{kind:?} of {wisps:?} is {depth} m in the skin");
        assert!(wisps.iter().all(|wisp| held.wisps()[*wisp].is_held()));
    }
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one.install(|| accessories(held, &HEAD)), found, "the same on one thread");
    let meshes = accessory_meshes(&found);
    let names: BTreeSet<&str> = meshes.iter().map(|mesh| mesh.name.as_str()).collect();
    assert_eq!(names.len(), found.len(), "each has a name of its own");
    let released = done(held, Release::default());
    assert_eq!(accessories(&released, &HEAD), [], "nothing is left after release");
    found
}

/// Whether each edge has one face on either side.
fn is_closed(mesh: &Surface) -> bool {
    let edges = mesh.triangles().iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let once: BTreeSet<(u32, u32)> = edges.clone().collect();
    once.len() == edges.count() && once.iter().all(|&(a, b)| once.contains(&(b, a)))
}

/// Volume (m³) inside a closed mesh.
fn volume(mesh: &Surface) -> f64 {
    let corners = (0..mesh.triangles().len()).map(|i| mesh.corners(i));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

/// Place along the axis of an accessory and distance from it (m).
fn split(accessory: &Accessory, p: DVec3) -> (f64, f64) {
    let away = p - accessory.centre;
    let along = away.dot(accessory.axis);
    (along, (away - along * accessory.axis).length())
}

#[test]
fn free_hair_and_hair_that_a_hand_or_a_comb_holds_has_no_accessories() {
    let before = free(30, 0.2);
    assert_eq!(accessories(&before, &HEAD), []);
    let combed = done(&before, Comb { hold: true, ..Comb::default() });
    assert_eq!(accessories(&combed, &HEAD), []);
    assert_eq!(accessories(&done(&before, Straighten::default()), &HEAD), []);
}

#[test]
fn hair_on_a_roller_lies_around_it_and_rollers_do_not_pass_through_each_other() {
    let helix = 0.015;
    let held = done(&free(90, 0.27), Roll { radius: helix, ..Roll::default() });
    let rollers = found(&held);
    assert!(rollers.len() >= 8, "{}", rollers.len());
    for roller in &rollers {
        assert_eq!(roller.kind, AccessoryKind::Roller);
        assert!(roller.radius <= helix && roller.radius >= 0.5 * helix, "{}", roller.radius);
        assert!(roller.length >= 1.59 * roller.radius && roller.length <= 0.0701);
        for &wisp in &roller.wisps {
            let line = held.equilibria()[wisp].centre_line(500);
            // The first centimetre comes from the root.
            let wound = line[19..].iter().map(|p| split(roller, *p));
            let inside = wound.filter(|(z, _)| z.abs() <= 0.5 * roller.length);
            let least = inside.map(|(_, off)| off).fold(f64::INFINITY, f64::min);
            assert!(least > roller.radius - 1e-3, "{least} inside a roller of {}", roller.radius);
        }
    }
    let ends = |r: &Accessory| [-0.5, 0.0, 0.5].map(|x| r.centre + x * r.length * r.axis);
    for (i, a) in rollers.iter().enumerate() {
        for b in &rollers[..i] {
            let apart = ends(a).into_iter().flat_map(|p| ends(b).map(|q| p.distance(q)));
            assert!(apart.fold(f64::INFINITY, f64::min) > a.radius + b.radius);
        }
    }
}

#[test]
fn a_tie_encloses_the_guides_that_it_ties_and_is_tight() {
    let before = free(60, 0.4);
    for to in [TiePlace::High, TiePlace::Low, TiePlace::Left] {
        let held = done(&before, Tie { selection: Selection::Everything, to, braided: false });
        let ties = found(&held);
        assert_eq!(ties.len(), 1, "{to:?}");
        let tie = &ties[0];
        assert_eq!(tie.kind, AccessoryKind::Tie);
        let tied = held.wisps().iter().filter(|wisp| wisp.is_held()).count();
        assert!(10 * tie.wisps.len() >= 9 * tied, "{to:?}: {} of {tied}", tie.wisps.len());
        let through = |wisp: usize| {
            let line = held.equilibria()[wisp].centre_line(2000);
            let at: Vec<(f64, f64)> = line.iter().map(|p| split(tie, *p)).collect();
            let crossing = |pair: &[(f64, f64)]| {
                ((pair[0].0 <= 0.0) != (pair[1].0 <= 0.0)).then(|| pair[0].1.min(pair[1].1))
            };
            at.windows(2).filter_map(crossing).fold(f64::INFINITY, f64::min)
        };
        let farthest = tie.wisps.iter().map(|&wisp| through(wisp)).fold(0.0, f64::max);
        assert!(farthest <= tie.radius, "{to:?}: {farthest} {}", tie.radius);
        assert!(tie.radius <= 1.3 * farthest, "{to:?}: {farthest} {}", tie.radius);
        assert!(tie.radius < 0.03, "{to:?}: {}", tie.radius);
    }
}

#[test]
fn two_ties_are_two_objects_and_one_of_them_can_be_taken_out() {
    let before = free(60, 0.4);
    let side = |left: bool| {
        let normal = DVec3::X * if left { 1.0 } else { -1.0 };
        Selection::Beyond { point: DVec3::ZERO, normal }
    };
    let left = done(&before, Tie { selection: side(true), to: TiePlace::Left, braided: false });
    let both = done(&left, Tie { selection: side(false), to: TiePlace::Right, braided: false });
    assert_eq!(found(&both).len(), 2);
    let right = done(&both, Release { selection: side(true) });
    let found = accessories(&right, &HEAD);
    assert!(found.len() == 1 && found[0].centre.x < 0.0, "{found:?}");
}

#[test]
fn the_ends_of_braids_and_twists_are_in_elastics() {
    let before = free(40, 0.25);
    for held in [done(&before, Braid::default()), done(&before, Twist::default())] {
        let elastics = found(&held);
        let wisps: Vec<usize> = elastics.iter().flat_map(|e| e.wisps.iter().copied()).collect();
        assert!(wisps.len() >= 36, "{}", wisps.len());
        let once: BTreeSet<usize> = wisps.iter().copied().collect();
        assert_eq!(once.len(), wisps.len(), "no wisp has two");
        for elastic in &elastics {
            assert_eq!(elastic.kind, AccessoryKind::Elastic);
            assert!(elastic.radius <= 0.0101, "{}", elastic.radius);
            for &wisp in &elastic.wisps {
                let line = held.equilibria()[wisp].centre_line(1000);
                let passes = |p: &DVec3| {
                    let (along, off) = split(elastic, *p);
                    along.abs() < 0.006 && off <= elastic.radius + 1e-3
                };
                assert!(line[800..].iter().any(passes), "{wisp} is outside of its elastic");
            }
        }
    }
}

#[test]
fn tucked_hair_that_is_held_has_a_pin_at_the_ear_and_a_clip_is_where_it_clips() {
    let before = free(80, 0.3);
    let tucked = done(&before, Tuck { sides: Sides::Left, hold: true, ..Tuck::default() });
    let pins = found(&tucked);
    assert_eq!((pins.len(), pins[0].kind), (1, AccessoryKind::Pin));
    let away = pins[0].centre.distance(HEAD.landmarks().ear);
    assert!(away < 0.05, "{away}");
    let wisp = (0..80).find(|&i| before.guides()[i].region == Region::Sides).unwrap();
    let to = HEAD.landmarks().whorl + DVec3::new(0.0, 0.03, 0.03);
    let clipped = done(&before, Clip { selection: Selection::Wisps(vec![wisp]), at: 1.0, to });
    let clips = found(&clipped);
    assert_eq!((clips.len(), clips[0].kind), (1, AccessoryKind::Clip));
    let away = clips[0].centre.distance(to);
    assert!(away < 0.012, "{away}");
    // Of a whole region each wisp has the one clip, or none.
    let fringe = Selection::Place(Place::Region(Region::Fringe));
    let all = done(&before, Clip { selection: fringe, at: 0.5, to: DVec3::new(0.0, -0.06, 0.14) });
    assert_eq!(found(&all).len(), 1);
}
