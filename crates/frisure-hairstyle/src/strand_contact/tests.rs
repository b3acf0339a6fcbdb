//! Hairs in contact against closed forms and an independent minimiser.

use frisure_progress::StageCounter;
use frisure_rod::batch::{Batch, Contact, ContactField, InitialShape, JointChain};
use frisure_rod::{Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant};
use glam::{DMat3, DVec3};

use super::density_system::{DensitySystem, SOLID, law};
use super::energy::Head;
use super::interaction::Interaction;
use super::pair_system::PairSystem;
use super::{InteractionForm, SettledStrands, StrandSystem, settle, stages};
use crate::contact::FrictionCoefficients;

/// Nothing but hairs.
struct Nothing;

impl ContactField for Nothing {
    fn contact(&self, _: usize, _: f64, _: DVec3) -> Contact {
        Contact::Clear(f64::INFINITY)
    }
}

const RADIUS: f64 = 2e-4;

/// A straight hair, so many times as thick as one of 70 µm, in the acceleration (m/s²) of its load.
fn hair(from: DVec3, along: DVec3, length: f64, times: f64, load: DVec3) -> Rod {
    let section = Section::from_diameter(times * 70e-6, 1.0).unwrap();
    // A hair that is nearly rigid has no weight, so that it does not bend by itself.
    let density = if times > 1.0 { 1e-6 } else { 1300.0 };
    let weight = density * section.area();
    Rod::new(RodSpec {
        length,
        section,
        material: Material::new(3.9e9, 0.9e9, density).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::Uniform(DVec3::ZERO),
        root: Root::from_tangent(from, along, DVec3::new(0.3, 0.0, 1.0)).unwrap(),
        load: Load { force: load * weight, ..Load::down(0.0) },
    })
    .unwrap()
}

/// Hairs of `elements` elements each.
struct Tuft {
    rods: Vec<Rod>,
    elements: usize,
    friction: f64,
}

impl Tuft {
    fn with<T>(&self, act: impl FnOnce(&StrandSystem<'_>) -> T) -> T {
        let count = self.rods.len();
        let hair = FrictionCoefficients { hair: self.friction, ..FrictionCoefficients::default() };
        act(&StrandSystem {
            elements: vec![self.elements; count],
            radii: vec![RADIUS; count],
            friction: vec![hair; count],
            form: InteractionForm::Contacts,
            field: &Nothing,
            rods: self.rods.clone(),
        })
    }

    fn settle(&self, start: Option<Vec<DVec3>>, tolerance: f64) -> SettledStrands {
        let stage = StageCounter::new(&(), "test", stages());
        let start = start.unwrap_or_else(|| vec![DVec3::ZERO; self.rods.len() * self.elements]);
        self.with(|system| settle(system, start, tolerance, &stage).unwrap())
    }

    /// Contact points (m) of each hair.
    fn points(&self, controls: &[DVec3]) -> Vec<Vec<DVec3>> {
        let n = self.elements;
        let points = |(rod, controls): (&Rod, &[DVec3])| {
            let (mut points, mut frames) = (vec![DVec3::ZERO; n + 1], vec![DMat3::ZERO; n]);
            JointChain::new(rod, n).shape(controls, &mut points, &mut frames);
            points
        };
        self.rods.iter().zip(controls.chunks(n)).map(points).collect()
    }

    /// Gradient (N) of the contact between hairs by the points of each hair, without friction; and its energy (J).
    fn forces(&self, controls: &[DVec3]) -> (Vec<Vec<DVec3>>, f64) {
        self.with(|system| {
            let head = Head::new(system);
            let mut state = head.state(controls.to_vec());
            head.place(&mut state);
            let without = state.energy;
            let mut pairs = PairSystem::new(head.properties());
            pairs.search(&state.points, true);
            head.evaluate(&mut pairs, &mut state);
            let of = |strand: usize| state.forces[head.layout.points(strand)].to_vec();
            ((0..self.rods.len()).map(of).collect(), state.energy - without)
        })
    }
}

/// Elements of mirrored hairs: a place on the line of a hair is a mean of three points, where its mirror image has one.
const MIRRORED: usize = 96;

/// Two parallel hairs side by side without weight, whose roots are nearer than the contact distance.
fn mirrored(friction: f64) -> Tuft {
    let one = |side: f64| hair(DVec3::X * (side * 1.5e-4), DVec3::Y, 0.03, 1.0, DVec3::ZERO);
    Tuft { rods: vec![one(1.0), one(-1.0)], elements: MIRRORED, friction }
}

/// One of two mirrored hairs: contact with its own mirror image in x, where both have half of the energy.
struct Mirror {
    /// Of k e³/6D.
    stiffness: f64,
}

impl ContactField for Mirror {
    fn contact(&self, _: usize, _: f64, position: DVec3) -> Contact {
        let distance = 2.0 * RADIUS;
        let e = distance - 2.0 * position.x;
        if e < 0.0 {
            return Contact::Clear(-0.5 * e);
        }
        let (k, n) = (self.stiffness / distance, DVec3::X);
        Contact::Active {
            energy: 0.5 * k * e * e * e / 6.0,
            gradient: n * (-0.5 * k * e * e),
            hessian: DMat3::from_cols(n * (2.0 * k * e), DVec3::ZERO, DVec3::ZERO),
        }
    }
}

#[test]
fn two_mirrored_hairs_are_where_one_rests_at_its_mirror_image() {
    let tuft = mirrored(0.0);
    let settled = tuft.settle(None, 1e-7);
    let certificate = settled.certificate;
    assert_eq!(certificate.balanced, 2, "{certificate:?}");
    assert!(certificate.contacts > 10 && certificate.imbalance < 1e-12, "{certificate:?}");
    let points = tuft.points(&settled.controls);
    for (a, b) in points[0].iter().zip(&points[1]) {
        assert!((a.x + b.x).abs() < 1e-9 && (a.y - b.y).abs() < 1e-9, "{a} {b}");
        assert!(a.z.abs() < 1e-9 && a.x > 1.4e-4);
    }
    // The same of one hair by the batch solver: its energy is half of both, its tip in the same place.
    let rod = &tuft.rods[0];
    let scale = rod.moment_scale() / rod.length().powi(2);
    let mirror = Mirror { stiffness: 2.0 * scale / (0.01 * 2.0 * RADIUS) };
    let batch = Batch { elements: MIRRORED, tolerance: 1e-9, ..Batch::default() };
    let start = InitialShape::Controls(vec![DVec3::ZERO; MIRRORED]);
    let (one, _) = batch.solve_in_contact(std::slice::from_ref(rod), start, &mirror, 0);
    let alone = tuft.points(&[one.controls.clone(), vec![DVec3::ZERO; MIRRORED]].concat());
    let (tip, other) = (points[0][MIRRORED], alone[0][MIRRORED]);
    let moved = other.x - 1.5e-4;
    assert!(moved > 2e-5 && (tip.x - other.x).abs() < 1e-3 * moved, "{tip} {other}");
    let bent = |controls: &[DVec3], rod: &Rod| {
        let (mut points, mut frames) =
            (vec![DVec3::ZERO; MIRRORED + 1], vec![DMat3::ZERO; MIRRORED]);
        JointChain::new(rod, MIRRORED).shape(controls, &mut points, &mut frames)
    };
    let elastic: f64 =
        settled.controls.chunks(MIRRORED).zip(&tuft.rods).map(|(c, rod)| bent(c, rod)).sum();
    let both = elastic + tuft.forces(&settled.controls).1;
    let half = one.rods[0].energy;
    assert!((both - 2.0 * half).abs() < 1e-3 * half, "{both} {half}");
}

#[test]
fn forces_between_hairs_are_equal_and_opposite() {
    // Crossing at an angle, not in one plane.
    let along = [DVec3::Y, DVec3::new(0.01, 1.0, 0.005), DVec3::new(-0.01, 1.0, 0.002)];
    let rods = along.map(|along| hair(along.cross(DVec3::Y) * 0.01, along, 0.03, 1.0, DVec3::ZERO));
    let tuft = Tuft { rods: rods.to_vec(), elements: 24, friction: 0.0 };
    let bend = |k: usize| DVec3::new(1e-3 * (k % 7) as f64, -1e-3 * (k % 5) as f64, 0.0);
    let (forces, energy) = tuft.forces(&(0..72).map(bend).collect::<Vec<_>>());
    let sum: DVec3 = forces.iter().flatten().sum();
    let all: f64 = forces.iter().flatten().map(|force| force.length()).sum();
    assert!(energy > 0.0 && all > 0.0 && sum.length() < 1e-12 * all, "{sum} of {all}");
}

#[test]
fn without_friction_the_answer_is_that_of_friction_that_vanishes() {
    let [none, little] = [0.0, 1e-7].map(|mu| {
        let tuft = mirrored(mu);
        tuft.points(&tuft.settle(None, 1e-7).controls)[0][MIRRORED]
    });
    assert!(none.distance(little) < 1e-8, "{none} {little}");
}

/// A groove of two nearly rigid hairs bears what lies in it, far from its ends: per length the weight, half on either.
#[test]
fn what_lies_on_rigid_hairs_is_borne_by_them() {
    let (length, n) = (0.12, 60);
    let rigid = |side: f64| hair(DVec3::X * (side * RADIUS), DVec3::Y, length, 30.0, DVec3::ZERO);
    let above = DVec3::Z * (3.0_f64.sqrt() * RADIUS);
    let light = hair(above, DVec3::Y, length, 1.0, DVec3::NEG_Z * 9.81);
    let weight = 1300.0 * light.spec().section.area() * 9.81;
    let tuft = Tuft { rods: vec![light, rigid(1.0), rigid(-1.0)], elements: n, friction: 0.0 };
    let settled = tuft.settle(None, 1e-7);
    assert_eq!(settled.certificate.balanced, 3, "{:?}", settled.certificate);
    let (forces, _) = tuft.forces(&settled.controls);
    let borne: f64 = forces[0][25..45].iter().map(|force| -force.z).sum();
    let expected = weight * 20.0 * length / n as f64;
    assert!((borne / expected - 1.0).abs() < 0.01, "{borne} of {expected}");
    let across: f64 = forces[0][25..45].iter().map(|force| force.x).sum();
    assert!(across.abs() < 1e-6 * borne);
}

/// A hair whose tip is propped on one that is nearly rigid and crosses it, in a weight that is tilted by an angle α across it. The tip
/// has to be held sideways with tan α times the force that props it, and slips where that is more than μ.
#[test]
fn a_propped_tip_holds_up_to_the_angle_of_friction() {
    let (length, n, mu) = (0.03, 24, 0.5);
    let tuft = |tangent: f64| {
        let (sin, cos) = tangent.atan().sin_cos();
        let load = DVec3::new(sin, 0.0, -cos) * 9.81;
        let light = hair(DVec3::Z * (1.9 * RADIUS), DVec3::Y, length, 1.0, load);
        let prop = hair(DVec3::new(-0.5 * length, length, 0.0), DVec3::X, length, 30.0, load);
        Tuft { rods: vec![light, prop], elements: n, friction: mu }
    };
    let level = tuft(0.0).settle(None, 1e-6);
    assert_eq!(level.certificate.balanced, 2, "{:?}", level.certificate);
    let tip = |tuft: &Tuft, controls: &[DVec3]| tuft.points(controls)[0][n];
    let before = tip(&tuft(0.0), &level.controls);
    let moved = |tangent: f64| {
        let tuft = tuft(tangent);
        let settled = tuft.settle(Some(level.controls.clone()), 1e-6);
        assert_eq!(settled.certificate.balanced, 2, "{tangent}: {:?}", settled.certificate);
        assert!(settled.certificate.friction_ratio < 1.002, "{:?}", settled.certificate);
        tip(&tuft, &settled.controls)
    };
    // It holds within the distance at which friction slips.
    let held = moved(0.45).x - before.x;
    assert!(held.abs() < 6e-5, "{held}");
    // It slips. 3/8 of the weight pulls the tip of a propped beam, less what its prop gives way; what friction does not hold of it
    // bends it by F L³/3EI.
    let tangent: f64 = 0.9;
    let (sin, cos) = tangent.atan().sin_cos();
    let rod = &tuft(tangent).rods[0];
    let weight = 1300.0 * rod.spec().section.area() * 9.81 * length;
    let spring = 3.0 * rod.stiffness().x / length.powi(3);
    let tip = moved(tangent);
    let pressed = 0.375 * weight * cos - spring * (1.9 * RADIUS - tip.z);
    let free = (0.375 * weight * sin - mu * pressed) / spring;
    let slipped = tip.x - before.x;
    assert!((slipped / free - 1.0).abs() < 0.02, "{slipped} {free}");
}

/// Hairs in a square, so near that together they take more of the space than hair packs; they have no weight.
fn crowd(side: i32, apart: f64) -> Tuft {
    let place = |i: i32, j: i32| DVec3::new(f64::from(i), 0.0, f64::from(j)) * apart;
    let middle = place(side - 1, side - 1) * 0.5;
    let rods = (0..side).flat_map(|i| (0..side).map(move |j| place(i, j)));
    let rods = rods.map(|at| hair(at - middle, DVec3::Y, 0.03, 1.0, DVec3::ZERO)).collect();
    Tuft { rods, elements: 24, friction: 0.0 }
}

#[test]
fn the_energy_of_a_volume_is_that_of_a_bundle_and_has_its_derivatives() {
    for fraction in [0.81, 0.9, 1.3, 2.0] {
        let h = 1e-5;
        let (energy, first, second) = law(fraction);
        let (below, above) = (law(fraction - h), law(fraction + h));
        assert!(((above.0 - below.0) / (2.0 * h) - first).abs() < 1e-6, "{fraction}");
        assert!(((above.1 - below.1) / (2.0 * h) - second).abs() < 1e-5, "{fraction}");
        // A hexagonal bundle whose distances are s has 3 pairs a hair, each with e³ of the overlap e = 1 − s/D.
        let s = (SOLID / fraction).sqrt();
        assert!((energy / fraction - (1.0 - s).powi(3)).abs() < 1e-14);
    }
    assert_eq!(law(0.8), (0.0, 0.0, 0.0));
}

/// The gradient of a volume that is the same everywhere along hairs, against its energy, by the motion of one hair.
#[test]
fn the_force_of_a_volume_is_the_derivative_of_its_energy() {
    let tuft = crowd(32, 2e-4);
    tuft.with(|system| {
        let head = Head::new(system);
        let mut state = head.state(vec![DVec3::ZERO; 1024 * 24]);
        head.place(&mut state);
        let mut density = DensitySystem::new(&head.properties());
        let summary = density.search(&state.points, true);
        assert!(summary.touching > 1000 && summary.deepest > 0.05, "{summary:?}");
        // Cells do not move with hair, so forces balance only as far as the grid is fine.
        assert!(summary.imbalance < 0.1, "{summary:?}");
        let mut forces = vec![DVec3::ZERO; state.points.len()];
        density.add_forces(&state.points, &mut forces);
        let motion: Vec<DVec3> = (0..state.points.len())
            .map(|k| DVec3::new((k as f64).sin(), (k as f64 * 0.7).cos(), (k as f64 * 1.3).sin()))
            .collect();
        let h = 1e-8;
        let energy = |density: &mut DensitySystem<'_>, t: f64| {
            // Links keep their lengths to first order only: volumes are those of the lengths.
            let points: Vec<DVec3> = (state.points.iter().zip(&motion))
                .map(|(p, u)| *p + DVec3::new(u.x, 0.0, u.z) * t)
                .collect();
            density.add_forces(&points, &mut vec![DVec3::ZERO; points.len()])
        };
        let slope = (energy(&mut density, h) - energy(&mut density, -h)) / (2.0 * h);
        let expected: f64 =
            forces.iter().zip(&motion).map(|(f, u)| f.dot(DVec3::new(u.x, 0.0, u.z))).sum();
        assert!((slope / expected - 1.0).abs() < 1e-5, "{slope} {expected}");
    });
}

/// A crowd presses itself apart, and is in balance and symmetric then.
#[test]
fn a_volume_spreads_as_its_mirror_image() {
    let side = 24;
    let tuft = crowd(side, 2e-4);
    let stage = StageCounter::new(&(), "test", stages());
    let count = tuft.rods.len();
    let settled = tuft.with(|system| {
        let system = StrandSystem {
            form: InteractionForm::Density,
            rods: system.rods.clone(),
            elements: system.elements.clone(),
            radii: system.radii.clone(),
            friction: system.friction.clone(),
            field: &Nothing,
        };
        settle(&system, vec![DVec3::ZERO; count * 24], 1e-6, &stage).unwrap()
    });
    assert_eq!(settled.certificate.balanced, count, "{:?}", settled.certificate);
    let points = tuft.points(&settled.controls);
    let extent = |k: usize| {
        points.iter().map(|hair| DVec3::new(hair[k].x, 0.0, hair[k].z).length()).sum::<f64>()
    };
    assert!(extent(24) > 1.02 * extent(0), "{} {}", extent(24), extent(0));
    let side = side as usize;
    let far = (0..count).map(|k| {
        let (a, b) = (points[k][24], points[(side - 1 - k / side) * side + k % side][24]);
        DVec3::new(a.x + b.x, a.y - b.y, a.z - b.z).length()
    });
    let far = far.fold(0.0, f64::max);
    assert!(far < 1e-6, "{far}");
}
