//! The two formulations of a joint, that of the lanes and that of the scalar solver, agree at random shapes to rounding:
//! energy, gradient and Newton step.

use fearless_simd::{Level, dispatch};
use glam::{DMat3, DVec3};

use super::contact::{Contact, ContactField};
use super::contact_lanes::{ContactLanes, ContactSetup};
use super::division::Joints;
use super::lanes::Lanes;
use super::newton::LaneSweeps;
use super::solver::f64s;
use super::weight_lanes::WeightLanes;
use crate::centre_line::Node;
use crate::chain::Chain;
use crate::load::Load;
use crate::material::Material;
use crate::minimise::{Minimiser, Newton, Problem, Stability, StoppingCriteria, damped_step};
use crate::potential::{Derivatives, ElementState, NodeState, Potential};
use crate::resolution::ElementKind;
use crate::rod::{Rod, RodSpec, Root};
use crate::section::{Section, TorsionConstant};
use crate::strain::{NaturalStrain, StrainProfile};

const ELEMENTS: usize = 9;

/// Fractions of the stiffness; with the last every pivot is positive definite.
const DAMPINGS: [f64; 3] = [0.0, 3.0, 1e3];

/// A number from −1 to 1 for an index.
fn noise(index: usize) -> f64 {
    let x = (index as f64 * 12.9898).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

fn random(index: usize) -> DVec3 {
    DVec3::new(noise(3 * index), noise(3 * index + 1), noise(3 * index + 2))
}

/// Curls of all kinds and directions; every third one varies along its length.
fn rod(k: usize) -> Rod {
    let length = 0.08 + 0.01 * k as f64;
    let strain = DVec3::new(90.0, 20.0, 60.0) + random(100 + k) * 40.0;
    let natural = match k % 3 {
        0 => {
            let knots = vec![(0.0, strain), (0.4 * length, -0.5 * strain), (length, 1.5 * strain)];
            NaturalStrain::Varying(StrainProfile::new(knots).unwrap())
        }
        _ => NaturalStrain::Uniform(strain),
    };
    Rod::new(RodSpec {
        length,
        section: Section::from_diameter(70e-6, 1.5).unwrap(),
        material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural,
        root: Root::from_tangent(
            random(200 + k) * 0.01,
            random(300 + k),
            DVec3::new(0.1, 0.2, 0.9),
        )
        .unwrap(),
        load: match k % 2 {
            0 => Load::down(9.81),
            _ => Load { gravity: random(400 + k) * 9.81, force: random(500 + k) * 3e-5 },
        },
    })
    .unwrap()
}

fn controls(k: usize) -> Vec<DVec3> {
    (0..ELEMENTS).map(|i| random(1000 + ELEMENTS * k + i) * 0.5).collect()
}

/// A field that pulls to a point, `½ κ r² (1 + r²/b²)` per length, with r the distance: its Hessian varies.
struct Well {
    stiffness: f64,
    anchor: DVec3,
    breadth: f64,
}

impl Well {
    fn at(&self, position: DVec3) -> (f64, DVec3, DMat3) {
        let away = position - self.anchor;
        let (square, b2) = (away.length_squared(), self.breadth.powi(2));
        let slope = self.stiffness * (1.0 + 2.0 * square / b2);
        let outer = DMat3::from_cols(away * away.x, away * away.y, away * away.z);
        (
            0.5 * self.stiffness * square * (1.0 + square / b2),
            away * slope,
            DMat3::from_diagonal(DVec3::splat(slope)) + outer * (4.0 * self.stiffness / b2),
        )
    }
}

impl ContactField for Well {
    fn contact(&self, _: usize, _: f64, position: DVec3) -> Contact {
        let (energy, gradient, hessian) = self.at(position);
        Contact::Active { energy, gradient, hessian }
    }
}

/// For the scalar solver: at the joints of all elements but the first, and at the tip, as the batch has its contacts.
impl Potential for Well {
    fn depends_on_position(&self) -> bool {
        true
    }

    fn element_energy(&self, e: &ElementState<'_>) -> f64 {
        if e.index == 0 { 0.0 } else { self.at(e.point(0.5)).0 * e.length }
    }

    fn add_element_derivatives(&self, e: &ElementState<'_>, sum: &mut Derivatives) {
        if e.index > 0 {
            let (_, gradient, hessian) = self.at(e.point(0.5));
            e.add_point_derivatives(0.5, gradient * e.length, &(hessian * e.length), sum);
        }
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        if node.index < ELEMENTS { 0.0 } else { self.at(node.position).0 * node.weight }
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        if node.index == ELEMENTS {
            let (_, gradient, hessian) = self.at(node.position);
            sum.position += gradient * node.weight;
            sum.position_position += hessian * node.weight;
        }
    }
}

/// What one lane computes of one rod at a shape.
struct LaneStep {
    /// Energy of the shape (J), and largest derivative by a joint's turn (N m).
    energy: f64,
    gradient: f64,
    /// Whether all pivots are positive.
    positive: bool,
    /// The step without feedback, and after the forward sweep (rad).
    feedforward: Vec<DVec3>,
    rollout: Vec<DVec3>,
}

#[inline(always)]
fn weight_step<F: Lanes>(zero: F, rod: &Rod, controls: &[DVec3], damping: f64) -> LaneStep {
    let mut joints = Joints::default();
    joints.divide(rod, ELEMENTS);
    let mut lanes = WeightLanes::new(zero, ELEMENTS, false);
    let energy = lanes.load(0, 0, &joints, controls).expect("the shape is known");
    let found = lanes.backward(zero.mask(0), zero.splat(damping));
    let _ = lanes.forward();
    LaneStep {
        energy: energy + joints.constant,
        gradient: found.gradient.get(0).sqrt(),
        positive: found.pivot.get(0) > 0.0,
        feedforward: lanes.0.joints.iter().map(|joint| joint.feedforward(0)).collect(),
        rollout: Vec::new(),
    }
}

#[inline(always)]
fn contact_step<F: Lanes>(
    zero: F,
    rod: &Rod,
    controls: &[DVec3],
    damping: f64,
    contacts: &Well,
) -> LaneStep {
    let mut joints = Joints::default();
    joints.divide(rod, ELEMENTS);
    let mut nodes = vec![Node::default(); ELEMENTS + 1];
    let setup = ContactSetup { contacts, first: 0, frames: None };
    let mut lanes = ContactLanes::new(zero, ELEMENTS, false, setup, &mut nodes);
    assert!(lanes.load(0, 0, &joints, controls).is_none());
    let energy = lanes.forward().get(0);
    let found = lanes.backward(zero.mask(1), zero.splat(damping));
    let _ = lanes.forward();
    let joint = lanes.bundle.joints.iter();
    LaneStep {
        energy: energy + joints.constant,
        gradient: found.gradient.get(0).sqrt(),
        positive: found.pivot.get(0) > 0.0,
        feedforward: joint.clone().map(|joint| joint.feedforward(0)).collect(),
        rollout: joint.map(|joint| joint.trial_control(0) - joint.control(0)).collect(),
    }
}

/// Compares energy and gradient of a lane with those of the scalar solver, to the rounding of moments of `scale` (N m).
fn compare_gradients(
    name: &str,
    lane: &LaneStep,
    problem: &Problem<'_>,
    controls: &[DVec3],
    scale: f64,
) {
    let shape = problem.chain().shape(controls.to_vec());
    let energy = problem.energy(&shape).total();
    assert!((lane.energy - energy).abs() < 1e-13 * scale.max(energy.abs()), "{name}: energy");
    let gradient = problem.gradient_norm(&shape) * problem.chain().rod().moment_scale();
    let gap = (lane.gradient - gradient).abs();
    assert!(gap < 1e-12 * gradient + 1e-14 * scale, "{name}: gradient {gap}");
}

/// Compares the step of a lane with that of the scalar solver, relative to its length; whether the Hessian is positive
/// definite.
fn compare_steps(
    name: &str,
    lane: &LaneStep,
    problem: &Problem<'_>,
    controls: &[DVec3],
    (damping, tolerance): (f64, f64),
) -> bool {
    let shape = problem.chain().shape(controls.to_vec());
    let step = damped_step(problem, &shape, damping);
    assert_eq!(lane.positive, step.is_some(), "{name}: stability");
    let Some([feedforward, rollout]) = step else { return false };
    let near = |a: &[DVec3], b: &[DVec3]| {
        let largest = b.iter().map(|b| b.length()).fold(0.0, f64::max);
        a.iter().zip(b).all(|(a, b)| a.distance(*b) < tolerance * largest)
    };
    assert!(near(&lane.feedforward, &feedforward), "{name}: Newton step");
    assert!(lane.rollout.is_empty() || near(&lane.rollout, &rollout), "{name}: forward sweep");
    true
}

#[test]
fn lanes_and_scalar_solver_agree_in_weight_alone() {
    let mut positive = [0; 3];
    for k in 0..24 {
        let (rod, controls) = (rod(k), controls(k));
        let chain = Chain::uniform(&rod, ElementKind::Jointed, ELEMENTS);
        let problem = Problem::new(&chain, &[]);
        for (damping, positive) in DAMPINGS.into_iter().zip(&mut positive) {
            let lane: LaneStep = dispatch!(
                Level::new(),
                simd => weight_step(f64s(simd), &rod, &controls, damping)
            );
            let name = format!("rod {k}, damping {damping}");
            compare_gradients(&name, &lane, &problem, &controls, rod.moment_scale());
            *positive +=
                usize::from(compare_steps(&name, &lane, &problem, &controls, (damping, 1e-9)));
        }
    }
    assert!(positive[1] > 6 && positive[2] == 24, "{positive:?}");
}

/// Far from a minimum the steps differ by second-order terms, since the scalar solver measures positions at the start
/// of an element and the lanes at its joint: dynamic programming depends on the coordinates of the state there. So steps
/// are compared beside a minimum, 1e-6 rad away, where these terms are 1e-6 of the step.
#[test]
fn lanes_and_scalar_solver_agree_in_contact() {
    for k in 0..24 {
        let rod = rod(k);
        let stiffness = [1e-3, 0.1, 10.0][k % 3];
        let scale = rod.moment_scale() + stiffness * rod.length().powi(3);
        let well = Well { stiffness, anchor: random(400 + k) * 0.03, breadth: 0.05 };
        let chain = Chain::uniform(&rod, ElementKind::Jointed, ELEMENTS);
        let external: [&dyn Potential; 1] = [&well];
        let problem = Problem::new(&chain, &external);
        let stopping = StoppingCriteria { tolerance: 1e-12, max_iterations: 1000 };
        let minimum = Newton::default().minimise(&problem, chain.natural_shape(), stopping);
        assert_eq!(minimum.stability, Stability::Stable);
        let beside: Vec<DVec3> = (minimum.shape.controls.iter().zip(controls(k)))
            .map(|(control, random)| *control + random * 1e-6)
            .collect();
        for damping in DAMPINGS {
            let name = format!("rod {k}, damping {damping}, stiffness {stiffness}");
            let step = |controls: &[DVec3]| -> LaneStep {
                dispatch!(
                    Level::new(),
                    simd => contact_step(f64s(simd), &rod, controls, damping, &well)
                )
            };
            compare_gradients(&name, &step(&controls(k)), &problem, &controls(k), scale);
            let lane = step(&beside);
            compare_gradients(&name, &lane, &problem, &beside, scale);
            assert!(compare_steps(&name, &lane, &problem, &beside, (damping, 1e-3)), "{name}");
        }
    }
}
