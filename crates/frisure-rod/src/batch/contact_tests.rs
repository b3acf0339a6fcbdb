//! Rods in contact: the batch against the energy by its definition.

use glam::{DMat3, DQuat, DVec3};

use super::contact::{ConfinementTube, Contact, ContactField};
use super::division::Joints;
use super::joint_chain::JointChain;
use super::solver::Batch;
use super::start::InitialShape;
use crate::load::Load;
use crate::material::Material;
use crate::minimise::Stability;
use crate::rod::{Rod, RodSpec, Root};
use crate::section::{Section, TorsionConstant};
use crate::strain::NaturalStrain;

/// Springs to a point, different for each hair; or a soft ball that hair lies on.
enum Near {
    Springs(f64),
    Ball(DVec3, f64),
    Tubes(f64),
    Nothing,
}

impl ContactField for Near {
    fn confinement(&self, hair: usize, s: f64) -> ConfinementTube {
        let Self::Tubes(stiffness) = *self else { return ConfinementTube::UNBOUNDED };
        // Along a line that sinks and turns away.
        let centre = DVec3::new(s, 0.1 * s * hair as f64, 0.01 - 4.0 * s * s);
        ConfinementTube { centre, radius: 0.01 + 0.1 * s, stiffness, clearance: f64::INFINITY }
    }

    fn contact(&self, hair: usize, s: f64, position: DVec3) -> Contact {
        let (away, stiffness) = match *self {
            Self::Nothing | Self::Tubes(_) => return Contact::Clear(f64::INFINITY),
            Self::Springs(k) => {
                let anchor = DVec3::new(0.02, 0.01 * hair as f64, -0.03);
                (position - anchor, k * (1.0 + 10.0 * s))
            }
            Self::Ball(centre, radius) => {
                let away = position - centre;
                let distance = away.length() - radius;
                if distance > 0.0 {
                    return Contact::Clear(distance);
                }
                let (normal, bend) = (away.normalize(), 2000.0);
                let square =
                    DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
                let round = (DMat3::IDENTITY - square) * (bend * distance / away.length());
                return Contact::Active {
                    energy: 0.5 * bend * distance * distance,
                    gradient: normal * (bend * distance),
                    hessian: square * bend + round,
                };
            }
        };
        Contact::Active {
            energy: 0.5 * stiffness * away.length_squared(),
            gradient: away * stiffness,
            hessian: DMat3::IDENTITY * stiffness,
        }
    }
}

fn rods() -> Vec<Rod> {
    let rod = |k: usize| {
        let angle = 0.7 * k as f64;
        let tangent = DVec3::new(angle.cos(), angle.sin(), 0.9 - 0.1 * k as f64);
        Rod::new(RodSpec {
            length: 0.08 + 0.01 * k as f64,
            section: Section::from_diameter(70e-6, 1.5).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(0.012, 0.02 + 0.01 * k as f64).unwrap(),
            root: Root::from_tangent(DVec3::Z * 0.01, tangent, DVec3::new(0.1, 0.2, 0.9)).unwrap(),
            load: Load { force: DVec3::new(1e-5, -2e-5, 0.0), ..Load::down(9.81) },
        })
        .unwrap()
    };
    (0..11).map(rod).collect()
}

/// The energy (J) of a hair whose joints are turned as given, by nothing but the definition.
fn energy(rod: &Rod, hair: usize, controls: &[DVec3], around: &Near) -> f64 {
    let n = controls.len();
    let mut joints = Joints::default();
    joints.divide(rod, n);
    let (mut frame, mut at) = (joints.frame, joints.start);
    let mut energy = joints.constant;
    for (i, c) in controls.iter().enumerate() {
        frame *= DMat3::from_quat(DQuat::from_scaled_axis(*c));
        at += frame * joints.links[i];
        energy +=
            0.5 * c.dot(joints.stiffness * *c) + joints.arms[i].dot(frame.transpose() * rod.up());
        let (s, share) = match i + 1 == n {
            true => (rod.length(), 0.5 * joints.h),
            false => ((i as f64 + 1.5) * joints.h, joints.h),
        };
        if let Contact::Active { energy: felt, .. } = around.contact(hair, s, at) {
            energy += felt * share;
        }
        let ConfinementTube { centre, radius, stiffness, .. } = around.confinement(hair, s);
        let beyond = (at.distance(centre) - radius).max(0.0);
        if beyond > 0.0 {
            energy += stiffness * beyond.powi(3) / (6.0 * radius) * share;
        }
        if i + 1 < n {
            frame *= *joints.turn(i);
        }
    }
    energy
}

#[test]
fn what_touches_nothing_hangs() {
    let rods = rods();
    let batch = Batch { elements: 12, tolerance: 1e-10, ..Batch::default() };
    let start = InitialShape::Controls(vec![DVec3::ZERO; rods.len() * 12]);
    let free = batch.solve(&rods);
    let (around, _) = batch.solve_in_contact(&rods, start, &Near::Nothing, 0);
    for (a, b) in free.controls.iter().zip(&around.controls) {
        assert!(a.distance(*b) < 1e-7, "{a} {b}");
    }
    for (a, b) in free.rods.iter().zip(&around.rods) {
        assert_eq!(b.stability, Stability::Stable);
        assert!((a.energy - b.energy).abs() < 1e-12 * a.energy.abs());
    }
}

/// From the middle of its tubes, or from not far of where that ends: to the same rest.
#[test]
fn hairs_start_along_their_tubes() {
    let rods = rods();
    let batch = Batch { elements: 12, tolerance: 1e-10, ..Batch::default() };
    let around = Near::Tubes(0.01);
    let frames = |hair: usize, _: f64| rods[hair].root().frame();
    let (along, _) = batch.solve_in_contact(&rods, InitialShape::Frames(&frames), &around, 0);
    let start = InitialShape::Controls(along.controls.iter().map(|c| *c * 0.9).collect());
    let (again, _) = batch.solve_in_contact(&rods, start, &around, 0);
    for (a, b) in along.rods.iter().zip(&again.rods) {
        assert_eq!((a.stability, b.stability), (Stability::Stable, Stability::Stable));
        assert!((a.energy - b.energy).abs() < 1e-9 * a.energy.abs());
    }
}

#[test]
fn rest_is_a_minimum_of_the_energy() {
    let rods = rods();
    let ball = Near::Ball(DVec3::new(0.0, 0.0, -0.03), 0.035);
    for around in [Near::Springs(1e-4), Near::Springs(1.0), ball, Near::Tubes(0.01)] {
        let batch = Batch { elements: 12, max_iterations: 5000, ..Batch::default() };
        let start = InitialShape::Controls(vec![DVec3::ZERO; rods.len() * 12]);
        let (found, nodes) = batch.solve_in_contact(&rods, start, &around, 3);
        for (i, rod) in rods.iter().enumerate() {
            let settled = &found.rods[i];
            assert_eq!(settled.stability, Stability::Stable, "{i}: {settled:?}");
            let shape = found.shape(rod, i);
            for (k, node) in nodes[i * 13..(i + 1) * 13].iter().enumerate() {
                assert!(node.position.distance(shape.positions[k]) < 1e-12, "{i} {k}");
                assert!(node.tangent.distance(shape.frames[k].z_axis) < 1e-10, "{i} {k}");
            }
            let controls = &found.controls[i * 12..(i + 1) * 12];
            let at = |controls: &[DVec3]| energy(rod, i + 3, controls, &around);
            let least = at(controls);
            let scale = rod.moment_scale();
            assert!((settled.energy - least).abs() < 1e-9 * scale.max(least.abs()), "{i}");
            for joint in 0..12 {
                for axis in 0..3 {
                    let moved = |by: f64| {
                        let mut moved = controls.to_vec();
                        moved[joint][axis] += by;
                        at(&moved)
                    };
                    // Small against the kink where skin begins.
                    let h = 1e-8;
                    let slope = (moved(h) - moved(-h)) / (2.0 * h);
                    assert!(slope.abs() < 1e-4 * scale, "{i} {joint}: {}", slope / scale);
                    assert!(moved(1e-4) + moved(-1e-4) > 2.0 * least, "{i} {joint}");
                }
            }
        }
    }
}

/// Energy and gradient of [`JointChain`] are those of the definition, with a force at every contact point.
#[test]
fn a_chain_by_itself_has_the_energy_and_its_gradient() {
    for (k, rod) in rods().iter().enumerate() {
        let n = 12;
        let chain = JointChain::new(rod, n);
        let force = |point: usize| DVec3::new(1e-6, 2e-6 * point as f64, -1e-6 * k as f64);
        let forces: Vec<DVec3> = (0..=n).map(force).collect();
        let shape = |controls: &[DVec3]| {
            let (mut points, mut frames) = (vec![DVec3::ZERO; n + 1], vec![DMat3::ZERO; n]);
            let energy = chain.shape(controls, &mut points, &mut frames);
            let pulled: f64 = points.iter().zip(&forces).map(|(p, f)| p.dot(*f)).sum();
            (energy + pulled, energy, points, frames)
        };
        let bent = |i: usize| DVec3::new(0.1, -0.05 * i as f64, 0.02 * k as f64);
        let controls: Vec<DVec3> = (0..n).map(bent).collect();
        let (_, own, points, frames) = shape(&controls);
        let scale = rod.moment_scale();
        assert!((own - energy(rod, k, &controls, &Near::Nothing)).abs() < 1e-12 * scale);
        let mut gradient = vec![DVec3::ZERO; n];
        chain.gradient(&controls, &points, &frames, &forces, &mut gradient);
        for joint in 0..n {
            for axis in 0..3 {
                let moved = |by: f64| {
                    let mut moved = controls.clone();
                    moved[joint][axis] += by;
                    shape(&moved).0
                };
                let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                assert!((slope - gradient[joint][axis]).abs() < 1e-7 * scale, "{k} {joint} {axis}");
            }
        }
        let lengths: f64 = (0..=n).map(|point| chain.at(point).1).sum();
        assert!((lengths - rod.length() * 11.5 / 12.0).abs() < 1e-12);
    }
}
