//! A guide at rest with friction: shape, normal forces and friction agree.
//!
//! Friction has no energy, but with the normal forces fixed it has one (docs/theory.md, "Friction"). So the shape is
//! sought with the normal forces of the one before until both agree (Picard's iteration); then the anchors of what slipped
//! follow, and the load takes its next step.

use frisure_rod::potential::{FieldPotential, Potential};
use frisure_rod::{Equilibrium, Options, Rod, Stability, equilibrium_from};
use glam::DVec3;

use super::tether::{Tether, farthest, firmness};
use crate::contact::{Friction, FrictionGap, FrictionSurface};

/// Change of the limits of friction, relative to them, at which normal forces and shape agree (F3).
const AGREEMENT: f64 = 5e-4;

/// The same relative to the weight of the guide, which decides where it hardly touches.
const LIGHT_AGREEMENT: f64 = 1e-5;

/// Largest move (m) of the last shape that is sought: what slides is at rest then. A hundredth of the slip distance.
const STILL: f64 = 5e-7;

/// Most iterations for one step of the load, and for one shape on the way: a shape that is not at rest yet goes on in the next.
/// Guards: a hundred and ten are usual.
const MOST_ITERATIONS: usize = 1500;
const MOST_PER_SHAPE: usize = 60;

/// First stiffness of the tether, in those at which its weight moves a guide by 4 mm: about half a millimetre. The tether is
/// loosened by a factor while limits change by less than [`CALM`] of themselves, tightened while they change by more, and
/// let go below the loosest. Chosen by trial with the capstan and combed heads.
const FIRST_TETHER: f64 = 8.0;
const FIRMEST: f64 = 500.0;
const LOOSENING: f64 = 0.25;
const TIGHTENING: f64 = 4.0;
const LOOSEST: f64 = 1e-2;
const CALM: f64 = 0.1;

/// A guide at rest, and how friction holds it.
pub(super) struct Rested {
    pub(super) rest: Equilibrium,
    /// Largest |f_t| / μ f_n; 0 without friction.
    pub(super) friction: f64,
}

impl Rested {
    /// A guide that no friction holds.
    pub(super) fn free(rest: Equilibrium) -> Self {
        Self { rest, friction: 0.0 }
    }
}

/// Whether friction holds a guide near where it starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hold {
    /// It slides freely.
    Free,
    /// It sticks where it starts, as far as the scene has friction.
    ByFriction,
}

/// A guide that is moved by steps of the load, with friction on what it lies on.
pub(super) struct Rubbing<'a> {
    rod: &'a Rod,
    surface: &'a dyn FrictionSurface,
    /// Points per element at which the surface is felt.
    samples: u32,
    options: Options,
    friction: Friction,
    rest: Equilibrium,
    /// Largest |f_t| / μ f_n after the last step.
    ratio: f64,
}

impl<'a> Rubbing<'a> {
    /// Starts where the guide lies in `before`, with the division of the options: there it sticks, without force.
    pub(super) fn new(
        rod: &'a Rod,
        surface: &'a dyn FrictionSurface,
        samples: u32,
        options: Options,
        before: &Equilibrium,
    ) -> Self {
        // No iteration: the shape is transferred by its frames and stays as it is. docs/theory.md, "Warm starts"
        let still = Options { max_iterations: 0, tolerance: 0.0, ..options };
        let rest = equilibrium_from(rod, &[], &still, before);
        let points = rest.chain().sample_points(&rest.shape, samples);
        let spacing = rod.length() / points.len() as f64;
        let friction = Friction::stuck_at(&points, spacing);
        Self { rod, surface, samples, options, friction, rest, ratio: 0.0 }
    }

    /// Brings the guide to rest under one more step of the load, of which `felt` is all but friction.
    pub(super) fn step(&mut self, felt: &[&dyn Potential]) {
        let mut iterations = self.rest.certificate.iterations;
        // A draft has fewer: what is left then is done by the exact rest.
        let most = iterations + self.options.max_iterations.min(MOST_ITERATIONS);
        let mut tether = FIRST_TETHER;
        let at_rest;
        let mut limit = self.friction.press(self.surface, &self.points()).limit;
        loop {
            // An implicit step of an overdamped motion: the tether keeps the move small while normal forces follow.
            let firm = firmness(self.rod, limit);
            let found = self.sought(felt, tether * firm);
            let before = std::mem::replace(&mut self.rest, found);
            // Each counts one at least, so that this ends.
            iterations += self.rest.certificate.iterations.max(1);
            let points = self.points();
            let gap = self.friction.press(self.surface, &points);
            self.friction.slip(&points);
            (self.ratio, limit) = (gap.ratio, gap.limit);
            let still = farthest(&self.rest.shape, &before.shape) <= STILL;
            let converged = self.rest.certificate.stability != Stability::NotConverged;
            let rests = tether == 0.0 && still && converged && self.agrees(gap);
            if rests || iterations >= most {
                at_rest = rests;
                break;
            }
            let calm = gap.change <= CALM * gap.limit + LIGHT_AGREEMENT * self.weight();
            tether = match (calm, tether) {
                (true, tether) if tether > LOOSEST => tether * LOOSENING,
                (true, _) => 0.0,
                (false, tether) => (tether.max(LOOSEST) * TIGHTENING).min(FIRMEST),
            };
        }
        // Friction's own energy says where it would go back to; it is no energy of the hair.
        let chain = self.rest.chain();
        self.rest.energy.external =
            felt.iter().map(|felt| chain.energy(&self.rest.shape, *felt)).sum();
        self.rest.certificate.iterations = iterations;
        if !at_rest {
            self.rest.certificate.stability = Stability::NotConverged;
        }
    }

    /// The guide at rest.
    pub(super) fn finish(self) -> Rested {
        Rested { rest: self.rest, friction: self.ratio }
    }

    /// The rest with the normal forces as they are, held where the guide is by a tether of a stiffness (Pa).
    fn sought(&self, felt: &[&dyn Potential], tether: f64) -> Equilibrium {
        let friction = FieldPotential::new(&self.friction, self.samples);
        let chain = self.rest.chain();
        let tethered = Tether::new(tether, &chain, &self.rest.shape);
        let tethered = FieldPotential::new(&tethered, 1);
        let mut felt = felt.to_vec();
        felt.push(&friction);
        if tether > 0.0 {
            felt.push(&tethered);
        }
        let most = self.options.max_iterations.min(MOST_PER_SHAPE);
        let options = Options { max_iterations: most, ..self.options };
        equilibrium_from(self.rod, &felt, &options, &self.rest)
    }

    /// Weight of the whole guide (N).
    fn weight(&self) -> f64 {
        self.rod.weight() * self.rod.length()
    }

    fn points(&self) -> Vec<DVec3> {
        self.rest.chain().sample_points(&self.rest.shape, self.samples)
    }

    fn agrees(&self, gap: FrictionGap) -> bool {
        gap.ratio <= 1.0 + AGREEMENT
            && gap.change <= AGREEMENT * gap.limit + LIGHT_AGREEMENT * self.weight()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use frisure_rod::potential::Field;
    use frisure_rod::{
        ElementKind, Load, Material, NaturalStrain, Resolution, RodSpec, Root, Section,
        StrainProfile, TorsionConstant, equilibrium,
    };
    use glam::{DMat3, DVec3};

    use super::*;
    use crate::contact::{FrictionSurface, Pressed};
    use crate::math::outer;

    /// A hard surface that presses back with `k d` per length at the depth d.
    struct Ground {
        stiffness: f64,
        coefficient: f64,
        form: Form,
    }

    enum Form {
        /// Through the origin.
        Plane { normal: DVec3 },
        /// About the y axis.
        Cylinder { radius: f64 },
    }

    impl Ground {
        /// Distance (m), gradient and Hessian (1/m).
        fn distance(&self, p: DVec3) -> (f64, DVec3, DMat3) {
            match self.form {
                Form::Plane { normal } => (normal.dot(p), normal, DMat3::ZERO),
                Form::Cylinder { radius } => {
                    let away = DVec3::new(p.x, 0.0, p.z);
                    let (reach, normal) = (away.length(), away.normalize());
                    let around = DVec3::new(normal.z, 0.0, -normal.x);
                    (reach - radius, normal, outer(around, around) * (1.0 / reach))
                }
            }
        }
    }

    impl Field for Ground {
        fn energy(&self, _: f64, p: DVec3) -> f64 {
            0.5 * self.stiffness * (-self.distance(p).0).max(0.0).powi(2)
        }

        fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
            let (distance, normal, bend) = self.distance(p);
            let (k, depth) = (self.stiffness, -distance);
            (depth > 0.0)
                .then(|| (normal * (-k * depth), outer(normal, normal) * k - bend * (k * depth)))
        }
    }

    impl FrictionSurface for Ground {
        fn pressed(&self, _: f64, p: DVec3) -> Option<Pressed> {
            let (distance, normal, _) = self.distance(p);
            let limit = self.coefficient * self.stiffness * -distance;
            (limit > 0.0).then_some(Pressed { normal, limit })
        }
    }

    /// The same force per length (N/m) on a piece of the rod.
    struct Push {
        piece: [f64; 2],
        force: DVec3,
    }

    impl Field for Push {
        fn energy(&self, s: f64, p: DVec3) -> f64 {
            if (self.piece[0]..self.piece[1]).contains(&s) { -self.force.dot(p) } else { 0.0 }
        }

        fn derivatives(&self, s: f64, _: DVec3) -> Option<(DVec3, DMat3)> {
            (self.piece[0]..self.piece[1]).contains(&s).then(|| (-self.force, DMat3::ZERO))
        }
    }

    fn fibre(length: f64, radius: f64, gravity: f64, natural: NaturalStrain, root: Root) -> Rod {
        Rod::new(RodSpec {
            length,
            section: Section::circular(radius).unwrap(),
            material: Material::new(3.9e9, 1.5e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural,
            root,
            load: Load::down(gravity),
        })
        .unwrap()
    }

    fn options(elements: usize) -> Options {
        Options {
            resolution: Resolution::Elements(elements),
            element: ElementKind::Helix,
            tolerance: 1e-10,
            estimate_error: false,
            eigenvalue: false,
            ..Options::default()
        }
    }

    /// Tip of a straight fibre along x on a plane inclined by `angle` (rad) sideways, and its move downhill (m).
    fn on_incline(length: f64, gravity: f64, angle: f64, coefficient: f64) -> (Rod, f64) {
        let normal = DVec3::new(0.0, angle.sin(), angle.cos());
        let ground = Ground { stiffness: 50.0, coefficient, form: Form::Plane { normal } };
        let root = |depth: f64| Root::from_tangent(normal * -depth, DVec3::X, normal).unwrap();
        let straight = |depth| fibre(length, 1e-4, gravity, NaturalStrain::STRAIGHT, root(depth));
        // The root is as deep as the fibre sinks in, so that it does not bend.
        let rod = straight(straight(0.0).weight() * angle.cos() / ground.stiffness);
        let weightless = Rod::new(RodSpec { load: Load::NONE, ..rod.spec().clone() }).unwrap();
        let options = options(40);
        let start = equilibrium(&weightless, &[], &options);
        let samples = 32;
        let mut rubbing = Rubbing::new(&rod, &ground, samples, options, &start);
        rubbing.step(&[&FieldPotential::new(&ground, samples)]);
        let rested = rubbing.finish();
        assert_eq!(rested.rest.certificate.stability, Stability::Stable);
        assert!(rested.friction <= 1.001, "{}", rested.friction);
        let downhill = DVec3::new(0.0, angle.cos(), -angle.sin());
        let moved = (rested.rest.tip() - start.tip()).dot(downhill);
        (rod, moved)
    }

    #[test]
    fn an_incline_holds_a_fibre_below_the_angle_of_friction() {
        // Not at the angle itself: near the clamp the springs of what sticks overshoot by 4 %.
        let coefficient = 0.4;
        let moved = |tan: f64| on_incline(0.2, 9.81, tan.atan(), coefficient).1;
        assert!(moved(0.95 * coefficient) < 5e-5);
        assert!(moved(1.05 * coefficient) > 1e-3);
    }

    #[test]
    fn what_slides_on_an_incline_bends_by_what_friction_leaves_of_its_weight() {
        // A cantilever under w (sin α − μ cos α) per length: q L⁴/8EI. Near the root it has not slipped: δ/tip is 1/40.
        let (angle, coefficient) = (0.785, 0.3);
        let (rod, moved) = on_incline(0.2, 0.15, angle, coefficient);
        let load = rod.weight() * (angle.sin() - coefficient * angle.cos());
        let tip = load * rod.length().powi(4) / (8.0 * rod.stiffness().x);
        assert!((moved / tip - 1.0).abs() < 1e-3, "{moved} of {tip}");
    }

    #[test]
    fn tension_grows_around_a_capstan_by_the_exponential_of_friction_and_angle() {
        // T₁/T₂ = exp(μ φ) of a light fibre over a quarter of a cylinder, in slow slip (Euler, Eytelwein).
        let (radius, coefficient, held) = (5e-3, 0.3, 0.02);
        // From the root a U-turn that gives way, a straight piece, the quarter turn downwards, a straight tail.
        let (turn, straight, tail) = (0.01, 0.02, 0.02);
        let (u, quarter) = (std::f64::consts::PI * turn, FRAC_PI_2 * radius);
        let wrap = u + straight;
        let length = wrap + quarter + tail;
        let step = |at: f64| [at - 1e-9, at + 1e-9];
        let bends = [
            (u, [-1.0 / turn, 0.0]),
            (wrap, [0.0, 1.0 / radius]),
            (wrap + quarter, [1.0 / radius, 0.0]),
        ];
        let mut knots = vec![(0.0, DVec3::NEG_X / turn)];
        for (at, [before, after]) in bends {
            let [low, high] = step(at);
            knots.extend([(low, DVec3::X * before), (high, DVec3::X * after)]);
        }
        let natural = NaturalStrain::Varying(StrainProfile::new(knots).unwrap());
        let top = DVec3::new(-straight, 0.0, radius + 2.0 * turn);
        let root = Root::from_tangent(top, DVec3::NEG_X, DVec3::Y).unwrap();
        let rod = fibre(length, 1e-5, 0.0, natural, root);
        let options = options(400);
        let start = equilibrium(&rod, &[], &options);
        let ground = Ground { stiffness: 4e6, coefficient, form: Form::Cylinder { radius } };
        let samples = 8;
        let spacing = length / (400.0 * f64::from(samples));
        let mut rubbing = Rubbing::new(&rod, &ground, samples, options, &start);
        let (before, after) = ([u + 0.005, u + 0.007], [length - 0.005, length - 0.003]);
        let points = |piece: [f64; 2]| {
            (1..=3200).filter(|&k| (piece[0]..piece[1]).contains(&(f64::from(k) * spacing))).count()
        };
        let push = |piece: [f64; 2], force: DVec3| Push {
            piece,
            force: force / (points(piece) as f64 * spacing),
        };
        let capstan = (coefficient * FRAC_PI_2).exp();
        // Drawn tight without slip, then ever harder until it slips.
        let tight = [(0.25, 1.0), (0.5, 1.0), (1.0, 1.0)];
        let harder = [0.8, 0.9, 0.99, 0.999, 1.001].map(|share| (1.0, share * capstan));
        let mut tails = Vec::new();
        for (held_share, share) in tight.into_iter().chain(harder) {
            let back = push(before, DVec3::NEG_X * held * held_share);
            let ahead = push(after, DVec3::NEG_Z * (held * held_share * share));
            rubbing.step(&[
                &FieldPotential::new(&ground, samples),
                &FieldPotential::new(&back, samples),
                &FieldPotential::new(&ahead, samples),
            ]);
            tails.push(rubbing.rest.tip());
        }
        let moved = |k: usize| tails[k].distance(start.tip());
        assert!(moved(6) < 2e-4, "{}: it holds at 0.999 of the tension", moved(6));
        assert!(moved(7) > 1e-2, "{}: it slips at 1.001", moved(7));
    }
}
