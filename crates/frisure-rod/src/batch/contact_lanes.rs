//! Rods in contact, into and out of the lanes.

use glam::DVec3;

use super::contact::{Contact, ContactField};
use super::contact_sweep::{Bundle, Joint};
use super::contact_term::{ContactTerm, TubeTerm};
use super::division::Joints;
use super::elimination::SweepResult;
use super::lanes::Lanes;
use super::linear::{Mat3, Vec3};
use super::newton::LaneSweeps;
use super::start::{Frames, GuidedStart};
use super::transport::Transport;
use crate::centre_line::Node;

/// The contacts of rods, and their start; the first rod has the index `first` in the contact field.
#[derive(Clone, Copy)]
pub(super) struct ContactSetup<'a> {
    pub(super) contacts: &'a dyn ContactField,
    pub(super) first: usize,
    /// The frames that rods start with; `None`: their joints are turned as given.
    pub(super) frames: Option<Frames<'a>>,
}

/// A ball (m) without contact.
#[derive(Clone, Copy)]
struct ClearBall {
    centre: DVec3,
    radius: f64,
}

impl ClearBall {
    const NONE: Self = Self { centre: DVec3::ZERO, radius: -1.0 };

    fn contains(&self, position: DVec3) -> bool {
        // r |r| is negative for an unknown ball: no distance is less.
        position.distance_squared(self.centre) < self.radius * self.radius.abs()
    }
}

/// The rod in a lane.
#[derive(Clone)]
struct Resident {
    /// Its index in the contact field.
    rod: usize,
    /// Length of an element (m).
    h: f64,
    root: Node,
    /// From each joint to the end of its element (m) and the tangent there, in the frame after the joint; one for
    /// all if they are equal.
    halves: Vec<(DVec3, DVec3)>,
}

impl Resident {
    const NONE: Self = Self {
        rod: 0,
        h: 0.0,
        root: Node { position: DVec3::ZERO, tangent: DVec3::Z },
        halves: Vec::new(),
    };
}

/// Arc length (m) of the end of a joint's link, of `n`, and the length (m) of rod at it.
///
/// The next joint is half an element into the next element; the tip has half a share.
fn link_end(h: f64, joint: usize, n: usize) -> (f64, f64) {
    // The lengths add up to that of the rod beyond the first joint, (n − ½) h; what is before it is clamped.
    match joint + 1 == n {
        true => (n as f64 * h, 0.5 * h),
        false => ((joint as f64 + 1.5) * h, h),
    }
}

/// Lanes of rods in contact.
pub(super) struct ContactLanes<'a, F> {
    pub(super) bundle: Bundle<F>,
    setup: ContactSetup<'a>,
    /// Of all rods, those of a rod one after the other.
    nodes: &'a mut [Node],
    /// By joint.
    tubes: Vec<TubeTerm<F>>,
    /// By lane; and whether there is a rod in it.
    residents: Vec<Resident>,
    taken: Vec<bool>,
    /// Where no contact needs to be computed, by joint, then by lane.
    clear: Vec<ClearBall>,
    no_contact: ContactTerm<F>,
}

impl<'a, F: Lanes> ContactLanes<'a, F> {
    /// Lanes for rods of `n` joints. `uniform`: every rod has the same rotation between all of its joints.
    #[inline(always)]
    pub(super) fn new(
        zero: F,
        n: usize,
        uniform: bool,
        setup: ContactSetup<'a>,
        nodes: &'a mut [Node],
    ) -> Self {
        Self {
            bundle: Bundle {
                joints: vec![Joint::zero(zero); n],
                transport: Transport::new(zero, n, uniform),
                frame: Mat3::splat(zero),
                start: Vec3::splat(zero),
                up: Vec3::splat(zero),
                stiffness: Vec3::splat(zero.splat(1.0)),
            },
            setup,
            nodes,
            tubes: vec![TubeTerm::unbounded(zero); n],
            residents: vec![Resident::NONE; F::LANES],
            taken: vec![false; F::LANES],
            clear: vec![ClearBall::NONE; n * F::LANES],
            no_contact: ContactTerm::zero(zero),
        }
    }
}

impl<F: Lanes> LaneSweeps<F> for ContactLanes<'_, F> {
    #[inline(always)]
    fn load(&mut self, lane: usize, rod: usize, joints: &Joints, start: &[DVec3]) -> Option<f64> {
        let Self { bundle, setup, .. } = self;
        let ContactSetup { contacts, first, frames } = *setup;
        let rod = first + rod;
        let n = start.len();
        bundle.frame.set(lane, &joints.frame);
        bundle.start.set(lane, joints.start);
        bundle.up.set(lane, joints.vertical);
        bundle.stiffness.set(lane, joints.stiffness);
        bundle.transport.set(lane, joints);
        let mut guided = frames.map(|frames| GuidedStart::new(joints, frames));
        for (i, control) in start.iter().enumerate() {
            let (s, share) = link_end(joints.h, i, n);
            let tube = contacts.confinement(rod, s);
            let control = match &mut guided {
                Some(guided) => guided.turn(i, rod, &tube),
                None => *control,
            };
            let joint = &mut bundle.joints[i];
            joint.arm.set(lane, joints.arms[i]);
            joint.link.set(lane, joints.links[i]);
            joint.begin(lane, control);
            self.tubes[i].set(lane, &tube, share);
            // What the tube states about the surroundings of its centre saves the first query of the field.
            self.clear[i * F::LANES + lane] =
                ClearBall { centre: tube.centre, radius: tube.clearance };
        }
        let resident = &mut self.residents[lane];
        (resident.rod, resident.h) = (rod, joints.h);
        let (position, frame) = joints.root;
        resident.root = Node { position, tangent: frame.z_axis };
        resident.halves.clear();
        resident.halves.extend(joints.seconds().map(|half| (half.advance, half.turn.z_axis)));
        // The energy depends on the positions of the given shape, which the next forward sweep computes.
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
    fn backward(&mut self, accepted: F::Mask, damping: F) -> SweepResult<F> {
        self.bundle.backward(accepted, damping)
    }

    #[inline(always)]
    fn forward(&mut self) -> F {
        let Self { bundle, setup, tubes, residents, taken, clear, no_contact, .. } = self;
        let n = bundle.joints.len();
        bundle.forward(|joint, ends| {
            // Tubes in all lanes at once; the field one lane after the other, and only where contact is possible.
            let mut term = tubes[joint].contact(ends, no_contact);
            for lane in 0..F::LANES {
                if !taken[lane] {
                    continue;
                }
                let end = ends.get(lane);
                let known = &mut clear[joint * F::LANES + lane];
                if known.contains(end) {
                    continue;
                }
                let Resident { rod, h, .. } = residents[lane];
                let (s, share) = link_end(h, joint, n);
                match setup.contacts.contact(rod, s, end) {
                    // Newton's steps shrink towards rest: most later trials stay in this ball and need no query.
                    Contact::Clear(radius) => *known = ClearBall { centre: end, radius },
                    Contact::Active { energy, gradient, hessian } => {
                        term.add(lane, energy * share, gradient * share, &(hessian * share));
                    }
                }
            }
            term
        })
    }

    #[inline(always)]
    fn save(&mut self, lane: usize, rod: usize, controls: &mut [DVec3]) {
        let n = controls.len();
        let resident = &self.residents[lane];
        let nodes = &mut self.nodes[rod * (n + 1)..(rod + 1) * (n + 1)];
        nodes[0] = resident.root;
        let mut at = self.bundle.start.get(lane);
        for (i, control) in controls.iter_mut().enumerate() {
            let joint = &self.bundle.joints[i];
            *control = joint.control(lane);
            let (frame, end) = joint.link_end(lane);
            let (advance, tangent) = resident.halves[i.min(resident.halves.len() - 1)];
            // The node is at the end of the element, half an element after the joint; the link goes on to the next joint.
            nodes[i + 1] = Node { position: at + frame * advance, tangent: frame * tangent };
            at = end;
        }
        self.taken[lane] = false;
    }
}
