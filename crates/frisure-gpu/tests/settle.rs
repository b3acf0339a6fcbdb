//! What comes to rest on a graphics processor, against the processor. On a machine without any, these tests pass
//! without a look, unless `FRISURE_NEEDS_GPU` says that there must be one.

use std::io::Write as _;
use std::sync::OnceLock;

use frisure_gpu::{Device, Error};
use frisure_rod::batch::{Batch, Batched, Precision, Settle, Unsettled};
use frisure_rod::{
    Chain, ElementKind, Material, NaturalStrain, Rod, RodSpec, Root, Section, Stability,
    StrainProfile, TorsionConstant,
};
use glam::{DQuat, DVec3};

/// The device, if there is one.
fn device() -> Option<&'static Device> {
    static DEVICE: OnceLock<Result<Device, Error>> = OnceLock::new();
    match DEVICE.get_or_init(Device::new) {
        Ok(device) => Some(device),
        Err(error) => {
            let needed = std::env::var_os("FRISURE_NEEDS_GPU").is_some();
            assert!(!needed, "FRISURE_NEEDS_GPU is set: {error}");
            // A closed pipe is no reason to fail.
            let _ = writeln!(std::io::stderr(), "{error}");
            None
        }
    }
}

/// Straight, wavy, curly and coily hair, by radius and pitch of the natural helix (m).
const HAIR: [(f64, f64); 4] = [(0.0, 0.1), (0.012, 0.09), (0.010, 0.024), (0.004, 0.006)];

/// A number in 0 to 1 that differs from one `i` to the next (the fractional parts of multiples of an irrational number).
fn scattered(i: usize, irrational: f64) -> f64 {
    (i as f64 * irrational).fract()
}

/// Hair of all kinds, lengths, sections and roots.
fn hairs(count: usize) -> Vec<Rod> {
    (0..count)
        .map(|i| {
            let height = 1.0 - 2.0 * scattered(i, 0.618_033_988_75);
            let around = DQuat::from_rotation_z(2.399_963_229_728_653 * i as f64);
            let tangent = around * DVec3::new((1.0 - height * height).sqrt(), 0.0, height);
            let (radius, pitch) = HAIR[i % 4];
            let natural = match radius {
                0.0 => NaturalStrain::STRAIGHT,
                _ => NaturalStrain::helix(radius, pitch).unwrap(),
            };
            Rod::new(RodSpec {
                length: 0.05 + 0.2 * scattered(i, 0.754_877_666_25),
                section: Section::from_diameter(
                    50e-6 + 50e-6 * scattered(i, 0.569_840_290_998),
                    1.0 + 0.8 * scattered(i, 0.414_213_562_37),
                )
                .unwrap(),
                material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
                torsion: TorsionConstant::SaintVenant,
                natural,
                root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(0.1, 0.9, -0.2)).unwrap(),
                gravity: 9.81,
            })
            .unwrap()
        })
        .collect()
}

/// Hairs whose energy differs from the processor's by more than 1e-10 of it, or of the moment of the weight where it
/// vanishes.
fn elsewhere(rods: &[Rod], found: &Batched, judge: &Batched) -> Vec<usize> {
    let differs = |i: &usize| {
        let (a, b) = (found.hairs[*i].energy, judge.hairs[*i].energy);
        !((a - b).abs() <= 1e-10 * b.abs().max(rods[*i].moment_scale()))
    };
    (0..rods.len()).filter(differs).collect()
}

fn tip(rod: &Rod, elements: usize, controls: &[DVec3]) -> DVec3 {
    let chain = Chain::uniform(rod, ElementKind::Jointed, elements);
    *chain.shape(controls.to_vec()).positions.last().unwrap()
}

/// Energies and stability are the processor's; hairs of all kinds, none at another equilibrium.
#[test]
fn the_device_finds_what_the_processor_finds() {
    let Some(device) = device() else { return };
    let rods = hairs(6000);
    for elements in [15, 40] {
        let batch = Batch { elements, ..Batch::default() };
        let (found, report) = device.with(batch).settle(&rods).unwrap();
        let judge = batch.settle(&rods);
        for (i, (hair, judge)) in found.hairs.iter().zip(&judge.hairs).enumerate() {
            assert_eq!(hair.stability, judge.stability, "{i}");
            assert!(hair.gradient_norm <= batch.tolerance, "{i}: {hair:?}");
        }
        assert_eq!(elsewhere(&rods, &found, &judge), [0; 0]);
        // What the device gives up costs the judge as much as without a device.
        assert!(report.given_up < rods.len() / 100, "{report:?}");
        assert_eq!((report.hairs, report.parts), (6000, 1));
    }
}

/// Weight and stiffness of any size, natural strain that varies along some of the hairs, in one batch.
#[test]
fn all_kinds_of_rods() {
    let Some(device) = device() else { return };
    let mut rods = hairs(500);
    for (i, rod) in rods.iter_mut().enumerate() {
        let size = 10_f64.powf(12.0 * scattered(i, 0.324_717_957_245) - 6.0);
        let (strain, length) = (rod.natural().at(0.0) / size, rod.length() * size);
        let knots = vec![(0.0, strain), (0.4 * length, -0.5 * strain), (length, 1.5 * strain)];
        let natural = match i % 3 {
            0 => NaturalStrain::Varying(StrainProfile::new(knots).unwrap()),
            _ => NaturalStrain::Uniform(strain),
        };
        // The same shape at any size, and hair of any weight.
        let size = size.powf(1.5);
        let gravity = 9.81 * [0.0, 1e-3, 1.0, 10.0][i / 4 % 4];
        let section = Section::from_diameter(70e-6 * size, 1.5).unwrap();
        *rod =
            Rod::new(RodSpec { length, section, natural, gravity, ..rod.spec().clone() }).unwrap();
    }
    let batch = Batch { elements: 24, ..Batch::default() };
    let (found, report) = device.with(batch).settle(&rods).unwrap();
    let judge = batch.settle(&rods);
    assert!(found.hairs.iter().all(|hair| hair.stability == Stability::Stable));
    // Curls that turn round, of ten times the weight, have several equilibria; single precision may go to another.
    let elsewhere = elsewhere(&rods, &found, &judge);
    assert!(elsewhere.len() <= 5, "{elsewhere:?}");
    assert!(report.given_up < rods.len() / 20, "{report:?}");
}

/// What single precision leaves of error: moments of 1e-5 of the hair's own on each joint, which turn it by no more than
/// that over its stiffness against turning. That is the weight's moment or EI/L, some four times less than the hair's own moment
/// for the soft axis of a section of 1.8 to 1.
#[test]
fn the_device_alone_is_near() {
    let Some(device) = device() else { return };
    let rods = hairs(3000);
    for elements in [15, 60] {
        let there = device.with(Batch { elements, ..Batch::default() });
        let before = there.unjudged(&rods).unwrap();
        let (after, _) = there.settle_from(&rods, before.controls.clone()).unwrap();
        let mut worst = 0.0_f64;
        for (i, rod) in rods.iter().enumerate().filter(|(i, _)| before.settled[*i]) {
            let of = i * elements..(i + 1) * elements;
            let tips = [&before.controls, &after.controls]
                .map(|controls| tip(rod, elements, &controls[of.clone()]));
            worst = worst.max(tips[0].distance(tips[1]) / (4e-5 * elements as f64 * rod.length()));
        }
        assert!(worst < 1.0, "{elements}: {worst}");
    }
}

/// Neither how many hairs there are, nor in which parts they go to the device, changes any; nor does doing it again.
#[test]
fn neighbours_change_nothing() {
    let Some(device) = device() else { return };
    let rods = hairs(300);
    let there = device.with(Batch { elements: 10, ..Batch::default() });
    let all = there.unjudged(&rods).unwrap();
    let again = there.unjudged(&rods).unwrap();
    assert_eq!((&again.controls, &again.sweeps), (&all.controls, &all.sweeps));
    let parts = there.at_once(128).unjudged(&rods).unwrap();
    assert_eq!((parts.report.parts, all.report.parts), (3, 1));
    assert_eq!((&parts.controls, &parts.sweeps), (&all.controls, &all.sweeps));
    for few in [1, 63, 64, 65] {
        let found = there.unjudged(&rods[..few]).unwrap();
        assert_eq!(found.controls, all.controls[..10 * few]);
    }
    let (judged, _) = there.settle(&rods).unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let (one, _) = pool.install(|| there.settle(&rods)).unwrap();
    assert_eq!(one, judged);
}

/// Threads take turns at one device.
#[test]
fn threads_share_a_device() {
    let Some(device) = device() else { return };
    let rods = hairs(200);
    let there = device.with(Batch::default()).at_once(64);
    let alone = there.unjudged(&rods).unwrap();
    std::thread::scope(|scope| {
        let settle = || there.unjudged(&rods).unwrap();
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(settle)).collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap().controls, alone.controls);
        }
    });
}

#[test]
fn short_chains_and_none() {
    let Some(device) = device() else { return };
    let rods = hairs(100);
    for elements in [1, 2, 3] {
        let batch = Batch { elements, ..Batch::default() };
        let (found, _) = device.with(batch).settle(&rods).unwrap();
        let judge = batch.settle(&rods);
        assert_eq!(elsewhere(&rods, &found, &judge), [0; 0], "{elements}");
    }
    let (none, report) = device.with(Batch::default()).settle(&[]).unwrap();
    assert!(none.hairs.is_empty() && none.controls.is_empty());
    assert_eq!((report.hairs, report.parts, report.sweeps), (0, 0, 0));
}

/// Upright hair is at a saddle from the start, which the device cannot leave; the judge does.
#[test]
fn saddles_are_left_to_the_judge() {
    let Some(device) = device() else { return };
    let up = Root::from_tangent(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap();
    let spec = hairs(1)[0].spec().clone();
    let rod = Rod::new(RodSpec { root: up, length: 0.25, ..spec }).unwrap();
    let rods = [rod];
    let (found, report) = device.with(Batch::default()).settle(&rods).unwrap();
    assert_eq!(report.given_up, 1);
    assert_eq!(found.hairs[0].stability, Stability::Stable);
    assert_eq!(found.controls, Batch::default().settle(&rods).controls);
}

/// From other shapes: from rest there is nothing to do, and a start without sense is given up, not believed.
#[test]
fn other_starts() {
    let Some(device) = device() else { return };
    let rods = hairs(64);
    let batch = Batch::default();
    let there = device.with(batch);
    let (rest, cold) = there.settle(&rods).unwrap();
    let (again, warm) = there.settle_from(&rods, rest.controls.clone()).unwrap();
    assert!(warm.sweeps * 4 < cold.sweeps, "{} {}", warm.sweeps, cold.sweeps);
    assert_eq!(elsewhere(&rods, &again, &rest), [0; 0]);
    let wild = vec![DVec3::new(f64::NAN, 1e300, -4.0); rods.len() * batch.elements];
    let (found, report) = there.settle_from(&rods, wild).unwrap();
    assert_eq!(report.given_up, 64);
    assert!(found.hairs.iter().all(|hair| hair.stability == Stability::Stable));
}

/// Behind the interface it is one way among others.
#[test]
fn one_interface() {
    let Some(device) = device() else { return };
    let rods = hairs(50);
    let batch = Batch { elements: 12, precision: Precision::Single, ..Batch::default() };
    let there = device.with(batch);
    let ways: [&dyn Settle; 2] = [&batch, &there];
    let [here, found] = ways.map(|way| way.settle(&rods).unwrap());
    assert_eq!(elsewhere(&rods, &found, &here), [0; 0]);
    for way in ways {
        let wrong = way.settle_from(&rods, vec![DVec3::ZERO; 7]).unwrap_err();
        assert!(matches!(wrong, Unsettled::Turns { given: 7, needed: 600 }), "{wrong}");
    }
}

#[test]
fn too_many_elements_are_told() {
    let Some(device) = device() else { return };
    let with = |elements| device.with(Batch { elements, ..Batch::default() });
    for elements in [0, 1_000_000, usize::MAX] {
        let error = with(elements).settle(&hairs(2)).unwrap_err();
        let Error::Elements { given, most } = error else { panic!("{error}") };
        assert!(given == elements && (1000..=10_000).contains(&most));
        assert!(error.to_string().contains("this device takes 1 to"), "{error}");
    }
    let error = Settle::settle(&with(0), &[]).unwrap_err();
    assert!(matches!(error, Unsettled::NoElements));
}
