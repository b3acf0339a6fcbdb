//! Hairs that can touch something, into and out of the lanes.

use glam::{DMat3, DQuat, DVec3};

use super::joints::Joints;
use super::lanes::{Lanes, Mat3, Vec3};
use super::settle::{Around, Sweeps};
use super::sweep::Backward;
use super::touch::{Bundle, Felt, Joint};
use super::tube::{ConfinementTube, Tubes};
use super::turns::Turns;
use crate::Node;

/// What hairs can touch.
pub trait ContactField: Sync {
    /// The room that neighbours leave the hair of an index at arc length `s` (m).
    fn confinement(&self, hair: usize, s: f64) -> ConfinementTube {
        let _ = (hair, s);
        ConfinementTube::UNBOUNDED
    }

    /// What else it feels at arc length `s` (m) where it is at `position` (m, world).
    fn contact(&self, hair: usize, s: f64, position: DVec3) -> Contact;
}

/// What is felt at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// Nothing, nor anywhere nearer than this distance (m).
    Clear(f64),
    /// Something.
    Active {
        /// Energy per length of hair (J/m).
        energy: f64,
        /// Its gradient by the position (J/m²).
        gradient: DVec3,
        /// Its symmetric Hessian (J/m³).
        hessian: DMat3,
    },
}

/// The material frames that hairs start with, by their index and arc length (m).
pub type Frames<'a> = &'a (dyn Fn(usize, f64) -> DMat3 + Sync);

/// A ball (m) in which a hair feels nothing.
#[derive(Clone, Copy)]
struct Free {
    centre: DVec3,
    radius: f64,
}

const NOWHERE: Free = Free { centre: DVec3::ZERO, radius: -1.0 };

/// What a lane's hair is, for those around it.
#[derive(Clone)]
struct Place {
    hair: usize,
    /// Length of an element (m).
    h: f64,
    /// Where it is rooted.
    root: Node,
    /// From each joint to the end of its element (m) and the tangent there, in the frame after the joint; one for
    /// all if they are alike.
    halves: Vec<(DVec3, DVec3)>,
}

impl Place {
    const EMPTY: Self = Self {
        hair: 0,
        h: 0.0,
        root: Node { position: DVec3::ZERO, tangent: DVec3::Z },
        halves: Vec::new(),
    };

    /// Arc length (m) of the end of a joint's link, of `n`, and the length (m) of hair that it stands for.
    ///
    /// The next joint is half an element into the next element; the tip has half a share.
    fn end(h: f64, joint: usize, n: usize) -> (f64, f64) {
        match joint + 1 == n {
            true => (n as f64 * h, 0.5 * h),
            false => ((joint as f64 + 1.5) * h, h),
        }
    }
}

/// The way from root to tip of a hair that starts in the middle of its tubes.
struct Way<'a> {
    joints: &'a Joints,
    frames: Frames<'a>,
    /// The frame before the next joint.
    before: DMat3,
    /// Where (m) that joint is, and where it would be in the middle of its tube.
    at: DVec3,
    wanted: DVec3,
}

/// Part of the way that a hair is off the middles of its tubes by which it comes nearer with each link.
const NEARER: f64 = 0.2;

/// Most that a joint is turned at the start (rad).
const LARGEST_START: f64 = 1.0;

impl<'a> Way<'a> {
    fn new(joints: &'a Joints, frames: Frames<'a>) -> Self {
        Self { joints, frames, before: joints.frame, at: joints.start, wanted: joints.start }
    }

    /// The turn (rad) of the next joint, after which its link goes along the tube, about which it is turned as the
    /// given frames.
    fn turn(&mut self, joint: usize, hair: usize, tube: &ConfinementTube) -> DVec3 {
        let Self { joints, frames, before, at, wanted } = self;
        let link = joints.links[joint];
        let node = frames(hair, (joint + 1) as f64 * joints.h);
        let mut frame = node * joints.halves(joint)[1].turn.transpose();
        if tube.radius.is_finite() {
            let along = tube.centre - *wanted + (*wanted - *at) * NEARER;
            let (from, to) = (frame * link.normalize_or(DVec3::Z), along.normalize_or_zero());
            if to != DVec3::ZERO {
                frame = DMat3::from_quat(DQuat::from_rotation_arc(from, to)) * frame;
            }
            *wanted = tube.centre;
        }
        let turn = DQuat::from_mat3(&(before.transpose() * frame)).normalize().to_scaled_axis();
        let turn = turn.clamp_length_max(LARGEST_START);
        frame = *before * DMat3::from_quat(DQuat::from_scaled_axis(turn));
        *at += frame * link;
        if joint + 1 < joints.links.len() {
            *before = frame * *joints.turn(joint);
        }
        turn
    }
}

/// Hairs in their own weight, and what they touch.
pub(super) struct Touching<'a, F> {
    bundle: Bundle<F>,
    around: Around<'a>,
    /// Of all hairs, those of a hair one after the other.
    nodes: &'a mut [Node],
    /// By joint.
    tubes: Vec<Tubes<F>>,
    /// Of each lane, and whether there is a hair in it.
    places: Vec<Place>,
    taken: Vec<bool>,
    /// By joint, then by lane.
    free: Vec<Free>,
    nothing: Felt<F>,
}

impl<'a, F: Lanes> Touching<'a, F> {
    /// Lanes for hairs of `n` joints, between which those of each hair turn alike or not.
    #[inline(always)]
    pub(super) fn new(
        zero: F,
        n: usize,
        alike: bool,
        around: Around<'a>,
        nodes: &'a mut [Node],
    ) -> Self {
        Self {
            bundle: Bundle {
                joints: vec![Joint::nothing(zero); n],
                turns: Turns::new(zero, n, alike),
                frame: Mat3::all(zero),
                start: Vec3::all(zero),
                stiffness: Vec3::all(zero.all(1.0)),
            },
            around,
            nodes,
            tubes: vec![Tubes::none(zero); n],
            places: vec![Place::EMPTY; F::COUNT],
            taken: vec![false; F::COUNT],
            free: vec![NOWHERE; n * F::COUNT],
            nothing: Felt::nothing(zero),
        }
    }
}

impl<F: Lanes> Sweeps<F> for Touching<'_, F> {
    #[inline(always)]
    fn load(&mut self, lane: usize, hair: usize, joints: &Joints, start: &[DVec3]) -> Option<f64> {
        let Self { bundle, around, .. } = self;
        let Around { contacts, first, frames } = *around;
        let hair = first + hair;
        let n = start.len();
        bundle.frame.set(lane, &joints.frame);
        bundle.start.set(lane, joints.start);
        bundle.stiffness.set(lane, joints.stiffness);
        bundle.turns.set(lane, joints);
        let mut way = frames.map(|frames| Way::new(joints, frames));
        for (i, control) in start.iter().enumerate() {
            let (s, share) = Place::end(joints.h, i, n);
            let tube = contacts.confinement(hair, s);
            let control = match &mut way {
                Some(way) => way.turn(i, hair, &tube),
                None => *control,
            };
            let joint = &mut bundle.joints[i];
            joint.arm.set(lane, joints.arms[i]);
            joint.link.set(lane, joints.links[i]);
            joint.begin(lane, control);
            self.tubes[i].set(lane, &tube, share);
            self.free[i * F::COUNT + lane] = Free { centre: tube.centre, radius: tube.clearance };
        }
        let place = &mut self.places[lane];
        (place.hair, place.h) = (hair, joints.h);
        let (position, frame) = joints.root;
        place.root = Node { position, tangent: frame.z_axis };
        place.halves.clear();
        place.halves.extend(joints.seconds().map(|half| (half.advance, half.turn.z_axis)));
        self.taken[lane] = true;
        None
    }

    #[inline(always)]
    fn begin(&mut self, lane: usize) {
        for joint in &mut self.bundle.joints {
            let control = joint.control(lane);
            joint.begin(lane, control);
        }
    }

    #[inline(always)]
    fn backward(&mut self, accepted: F::Truth, damping: F) -> Backward<F> {
        self.bundle.backward(accepted, damping)
    }

    #[inline(always)]
    fn forward(&mut self) -> F {
        let Self { bundle, around, tubes, places, taken, free, nothing, .. } = self;
        let n = bundle.joints.len();
        bundle.forward(|joint, ends| {
            let mut felt = tubes[joint].felt(ends, nothing);
            for lane in 0..F::COUNT {
                if !taken[lane] {
                    continue;
                }
                let end = ends.get(lane);
                let known = &mut free[joint * F::COUNT + lane];
                if end.distance_squared(known.centre) < known.radius * known.radius.abs() {
                    continue;
                }
                let Place { hair, h, .. } = places[lane];
                let (s, share) = Place::end(h, joint, n);
                match around.contacts.contact(hair, s, end) {
                    Contact::Clear(radius) => *known = Free { centre: end, radius },
                    Contact::Active { energy, gradient, hessian } => {
                        felt.add(lane, energy * share, gradient * share, &(hessian * share));
                    }
                }
            }
            felt
        })
    }

    #[inline(always)]
    fn save(&mut self, lane: usize, hair: usize, controls: &mut [DVec3]) {
        let n = controls.len();
        let place = &self.places[lane];
        let nodes = &mut self.nodes[hair * (n + 1)..(hair + 1) * (n + 1)];
        nodes[0] = place.root;
        let mut at = self.bundle.start.get(lane);
        for (i, control) in controls.iter_mut().enumerate() {
            let joint = &self.bundle.joints[i];
            *control = joint.control(lane);
            let (frame, end) = joint.link(lane);
            let (advance, tangent) = place.halves[i.min(place.halves.len() - 1)];
            nodes[i + 1] = Node { position: at + frame * advance, tangent: frame * tangent };
            at = end;
        }
        self.taken[lane] = false;
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Batch, InitialShape};
    use super::*;
    use crate::{Material, NaturalStrain, Rod, RodSpec, Root, Section, Stability, TorsionConstant};

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
                root: Root::from_tangent(DVec3::Z * 0.01, tangent, DVec3::new(0.1, 0.2, 0.9))
                    .unwrap(),
                gravity: 9.81,
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
            energy += 0.5 * c.dot(joints.stiffness * *c)
                + joints.arms[i].dot(frame.transpose() * DVec3::Z);
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
}
