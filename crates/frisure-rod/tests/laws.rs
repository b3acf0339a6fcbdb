//! What holds for every equilibrium, whatever the numbers.

mod common;

use common::{Spring, TipWrench, accuracy, curl, elements, hair, straight};
use frisure_rod::minimise::{Minimiser, Newton, Problem, StoppingCriteria};
use frisure_rod::potential::{Field, FieldPotential, Potential};
use frisure_rod::{
    Chain, ElementKind, Equilibrium, Load, NaturalStrain, Options, Rod, RodSpec, Root, Section,
    SplitMix64, Stability, StrainProfile, equilibrium,
};
use glam::{DMat3, DVec3};

const KINDS: [ElementKind; 2] = [ElementKind::Helix, ElementKind::Jointed];

fn turned(root: &Root, turn: DMat3) -> Root {
    let frame = turn * root.frame();
    Root::new(turn * root.position(), frame.x_axis, frame.y_axis, frame.z_axis).unwrap()
}

/// Moment of the weight beyond arc length `s` about the point there, by fine quadrature.
fn moment_of_weight(found: &Equilibrium, s: f64) -> DVec3 {
    let rod = &found.rod;
    let points = 4801;
    let line = found.centre_line(points);
    let h = rod.length() / (points - 1) as f64;
    let first = (s / h).round() as usize;
    let mut arm = DVec3::ZERO;
    for pair in line[first..].windows(2) {
        arm += ((pair[0] + pair[1]) * 0.5 - line[first]) * h;
    }
    arm.cross(DVec3::NEG_Z * rod.weight())
}

#[test]
fn the_internal_moment_is_that_of_the_weight_beyond() {
    for kind in KINDS {
        let rod = Rod::new(curl()).unwrap();
        let (n, h) = (240, rod.length() / 240.0);
        let found = equilibrium(&rod, &[], &elements(n, kind));
        let chain = Chain::uniform(&rod, kind, n);
        let moments = chain.moments(&found.shape);
        let scale = rod.weight() * rod.length().powi(2);
        for i in (0..n).step_by(30) {
            let exact = moment_of_weight(&found, (i as f64 + 0.5) * h);
            assert!(moments[i].distance(exact) < 2e-4 * scale, "{kind:?} {i}: {}", moments[i]);
            // Weight has no moment about the vertical.
            assert!(moments[i].z.abs() < 5e-5 * scale, "{kind:?} {i}: {}", moments[i]);
        }
    }
}

/// `J⁻ᵀ m` for the right Jacobian J of the rotation vector `c`: the moment in the turned frame whose
/// work in a change of `c` is that of `m`.
fn moment_of(c: DVec3, m: DVec3) -> DVec3 {
    let theta = c.length();
    let b = if theta < 1e-4 {
        1.0 / 12.0
    } else {
        (1.0 - 0.5 * theta / (0.5 * theta).tan()) / (theta * theta)
    };
    m - c.cross(m) * 0.5 + c.cross(c.cross(m)) * b
}

#[test]
fn joints_carry_no_moment_about_the_vertical() {
    // A discrete law, exact for any number of elements: turning all that hangs from a joint about
    // the vertical does not lift it.
    let mut random = SplitMix64(11);
    for i in 0..20 {
        let rod = Rod::new(hair(&mut random)).unwrap();
        for n in [2, 9, 30] {
            let found = equilibrium(&rod, &[], &elements(n, ElementKind::Jointed));
            let h = rod.length() / n as f64;
            let NaturalStrain::Uniform(u) = rod.natural() else { unreachable!() };
            let half = DMat3::from_quat(glam::DQuat::from_scaled_axis(*u * (0.5 * h)));
            for (c, frame) in found.shape.controls.iter().zip(&found.shape.frames) {
                let joint = DMat3::from_quat(glam::DQuat::from_scaled_axis(*c));
                let moment = moment_of(*c, rod.stiffness() / h * *c);
                let moment = *frame * half * joint * moment;
                assert!(moment.z.abs() < 1e-9 * rod.moment_scale(), "rod {i} N={n}: {moment}");
            }
        }
    }
}

#[test]
fn energy_falls_with_weight_at_the_rate_of_the_height() {
    // dE/d(weight) = E_g/weight along a branch, since E is stationary in the shape.
    let at = |gravity: f64| {
        let rod = Rod::new(RodSpec { load: Load::down(gravity), ..curl() }).unwrap();
        let found = equilibrium(&rod, &[], &elements(40, ElementKind::Jointed));
        (rod.weight(), found.energy)
    };
    for gravity in [0.1, 1.0, 9.81, 50.0] {
        let step = 1e-3 * gravity;
        let ((w0, e0), (w, e), (w1, e1)) = (at(gravity - step), at(gravity), at(gravity + step));
        let slope = (e1.total() - e0.total()) / (w1 - w0);
        let exact = e.gravity / w;
        assert!((slope - exact).abs() < 1e-5 * exact.abs(), "{gravity}: {slope} {exact}");
    }
}

#[test]
fn a_world_that_is_turned_with_its_load_turns_the_solution() {
    let mut random = SplitMix64(12);
    for i in 0..8 {
        let spec = hair(&mut random);
        let turn = DMat3::from_quat(glam::DQuat::from_scaled_axis(random.cube() * 2.0));
        let turned = RodSpec {
            root: turned(&spec.root, turn),
            load: Load { gravity: turn * spec.load.gravity, ..Load::NONE },
            ..spec.clone()
        };
        for kind in KINDS {
            let found = [&spec, &turned].map(|spec| {
                let rod = Rod::new(spec.clone()).unwrap();
                equilibrium(&rod, &[], &elements(24, kind))
            });
            let scale = found[0].energy.elastic + found[0].energy.gravity.abs();
            let energy = found[1].energy.total() - found[0].energy.total();
            assert!(energy.abs() < 1e-9 * scale, "hair {i}: {energy} J");
            for (a, b) in found[0].shape.positions.iter().zip(&found[1].shape.positions) {
                // Relative gradients of 1e-10 leave about this much of a shape open.
                assert!((turn * *a).distance(*b) < 1e-6 * spec.length, "hair {i}: {a} {b}");
            }
        }
    }
}

#[test]
fn a_force_on_the_length_is_gravity_of_the_same_size() {
    let mut random = SplitMix64(13);
    for _ in 0..8 {
        let spec = hair(&mut random);
        let mass = Rod::new(spec.clone()).unwrap().mass();
        let wind = random.direction() * 3e-5;
        let both = Load { gravity: spec.load.gravity, force: wind };
        let alike = Load { gravity: spec.load.gravity + wind / mass, ..Load::NONE };
        let tip = [both, alike].map(|load| {
            let rod = Rod::new(RodSpec { load, ..spec.clone() }).unwrap();
            assert!((rod.load() - both.per_length(mass)).length() < 1e-15 * rod.weight());
            *equilibrium(&rod, &[], &elements(24, ElementKind::Jointed))
                .shape
                .positions
                .last()
                .unwrap()
        });
        assert!(tip[0].distance(tip[1]) < 1e-6 * spec.length);
    }
}

#[test]
fn a_circular_straight_rod_does_not_twist() {
    let mut random = SplitMix64(3);
    for kind in KINDS {
        for _ in 0..10 {
            let rod = straight(random.decades(1.0, 500.0), random.direction());
            let found = equilibrium(&rod, &[], &elements(20, kind));
            for c in &found.shape.controls {
                assert!(c.z.abs() < 1e-9, "{c}");
            }
        }
    }
}

#[test]
fn planar_data_have_planar_equilibria() {
    for kind in KINDS {
        for curvature in [-30.0, 20.0, 40.0] {
            let rod = Rod::new(RodSpec {
                natural: NaturalStrain::Uniform(DVec3::X * curvature),
                root: Root::from_tangent(DVec3::ZERO, DVec3::new(1.0, 0.0, -0.3), DVec3::Y)
                    .unwrap(),
                ..curl()
            })
            .unwrap();
            let found = equilibrium(&rod, &[], &elements(30, kind));
            assert_eq!(found.certificate.stability, Stability::Stable);
            for p in found.centre_line(50) {
                assert!(p.y.abs() < 1e-9, "{curvature}: {p}");
            }
        }
    }
}

#[test]
fn without_weight_the_natural_helix_is_exact() {
    // The helix of radius R and pitch P about an axis through its curvature and twist.
    let (radius, pitch) = (0.005_f64, 0.010);
    let rod = Rod::new(RodSpec { load: Load::NONE, ..curl() }).unwrap();
    let p = pitch / std::f64::consts::TAU;
    let per_length = 1.0 / radius.hypot(p);
    let NaturalStrain::Uniform(u) = rod.natural() else { unreachable!() };
    let frame = rod.root().frame();
    let axis = frame * (*u / u.length());
    let tangent = frame.z_axis;
    let along = axis * tangent.dot(axis);
    let across = tangent - along;
    let exact = |s: f64| {
        let angle = s * per_length;
        along * s + (across * angle.sin() + axis.cross(across) * (1.0 - angle.cos())) / per_length
    };
    for kind in KINDS {
        for n in [1, 2, 3, 15, 1000, 10_000] {
            let found = equilibrium(&rod, &[], &elements(n, kind));
            assert_eq!(found.certificate.stability, Stability::Stable);
            assert!((found.certificate.min_eigenvalue.unwrap() - 1.0).abs() < 1e-9);
            for (k, point) in found.centre_line(101).iter().enumerate() {
                let error = point.distance(exact(rod.length() * k as f64 / 100.0));
                assert!(error < 1e-12, "{kind:?} N={n} point {k}: {error}");
            }
        }
    }
}

#[test]
fn turning_the_root_about_the_vertical_turns_the_solution() {
    let mut random = SplitMix64(7);
    for i in 0..20 {
        let spec = hair(&mut random);
        let angle = random.between(-3.0, 3.0);
        let turn = DMat3::from_rotation_z(angle);
        let rod = Rod::new(spec.clone()).unwrap();
        let other = Rod::new(RodSpec { root: turned(&spec.root, turn), ..spec }).unwrap();
        let options = elements(15, ElementKind::Auto);
        let (a, b) = (equilibrium(&rod, &[], &options), equilibrium(&other, &[], &options));
        let gap = b.tip().distance(turn * a.tip()) / rod.length();
        assert!(gap < 1e-6, "rod {i}: {gap}");
        let scale = rod.moment_scale();
        assert!((a.energy.total() - b.energy.total()).abs() < 1e-10 * scale);
    }
}

#[test]
fn moving_the_root_moves_the_solution() {
    let rod = Rod::new(curl()).unwrap();
    let (frame, away) = (rod.root().frame(), DVec3::new(0.3, -1.2, 1.7));
    let root = Root::new(away, frame.x_axis, frame.y_axis, frame.z_axis).unwrap();
    let other = Rod::new(RodSpec { root, ..curl() }).unwrap();
    let options = elements(15, ElementKind::Auto);
    let (a, b) = (equilibrium(&rod, &[], &options), equilibrium(&other, &[], &options));
    assert!(b.tip().abs_diff_eq(a.tip() + away, 1e-12));
    assert!((a.energy.gravity - b.energy.gravity).abs() < 1e-12 * rod.moment_scale());
}

#[test]
fn names_of_the_principal_axes_do_not_matter() {
    // d1 → d2, d2 → −d1 with the semi-axes and the natural curvatures following.
    let mut random = SplitMix64(9);
    for i in 0..20 {
        let spec = hair(&mut random);
        let NaturalStrain::Uniform(u) = spec.natural else { unreachable!() };
        let frame = spec.root.frame();
        let relabelled = RodSpec {
            section: Section::from_semi_axes(spec.section.b(), spec.section.a()).unwrap(),
            natural: NaturalStrain::Uniform(DVec3::new(u.y, -u.x, u.z)),
            root: Root::new(DVec3::ZERO, frame.y_axis, -frame.x_axis, frame.z_axis).unwrap(),
            ..spec.clone()
        };
        let (rod, other) = (Rod::new(spec).unwrap(), Rod::new(relabelled).unwrap());
        let options = elements(15, ElementKind::Auto);
        let (a, b) = (equilibrium(&rod, &[], &options), equilibrium(&other, &[], &options));
        assert!(a.tip().distance(b.tip()) < 1e-7 * rod.length(), "rod {i}");
    }
}

#[test]
fn the_mirror_image_has_the_mirror_image() {
    // Reflection in the plane x–z: twist and one curvature change sign.
    let mut random = SplitMix64(13);
    let mirror = |v: DVec3| DVec3::new(v.x, -v.y, v.z);
    for i in 0..20 {
        let spec = hair(&mut random);
        let NaturalStrain::Uniform(u) = spec.natural else { unreachable!() };
        let frame = spec.root.frame();
        let (d1, t) = (mirror(frame.x_axis), mirror(frame.z_axis));
        let mirrored = RodSpec {
            // d1 and t are mirrored, d2 = t × d1 is mirrored and reversed.
            natural: NaturalStrain::Uniform(DVec3::new(-u.x, u.y, -u.z)),
            root: Root::new(DVec3::ZERO, d1, t.cross(d1), t).unwrap(),
            ..spec.clone()
        };
        let (rod, other) = (Rod::new(spec).unwrap(), Rod::new(mirrored).unwrap());
        let options = elements(15, ElementKind::Auto);
        let (a, b) = (equilibrium(&rod, &[], &options), equilibrium(&other, &[], &options));
        assert!(mirror(a.tip()).distance(b.tip()) < 1e-6 * rod.length(), "rod {i}");
    }
}

/// Strains, frames and centre line of a rod on a fine grid, integrated from the root.
struct Fine {
    strains: Vec<DVec3>,
    frames: Vec<DMat3>,
    points: Vec<DVec3>,
}

impl Fine {
    fn new(root: &Root, length: f64, steps: usize, strain: impl Fn(f64) -> DVec3) -> Self {
        let h = length / steps as f64;
        let (mut frame, mut point) = (root.frame(), root.position());
        let mut fine = Self { strains: vec![], frames: vec![frame], points: vec![point] };
        for i in 0..=steps {
            let s = i as f64 * h;
            fine.strains.push(strain(s));
            if i == steps {
                break;
            }
            let turn = strain(s + 0.5 * h) * h;
            let rotate = |part: f64| DMat3::from_quat(glam::DQuat::from_scaled_axis(turn * part));
            // Gauss–Legendre of two points for the tangent.
            let g = 0.5 / 3.0_f64.sqrt();
            point += frame * (rotate(0.5 - g) * DVec3::Z + rotate(0.5 + g) * DVec3::Z) * (0.5 * h);
            frame *= rotate(1.0);
            fine.frames.push(frame);
            fine.points.push(point);
        }
        fine
    }

    /// Moment (N m, world) of the weight beyond each point.
    fn moments(&self, h: f64, weight: f64) -> Vec<DVec3> {
        let n = self.points.len();
        let mut moments = vec![DVec3::ZERO; n];
        for i in (0..n - 1).rev() {
            let beyond = (n - 2 - i) as f64 * h;
            let step = self.points[i + 1] - self.points[i];
            let arm = step * beyond + step * (0.5 * h);
            moments[i] = moments[i + 1] + arm.cross(DVec3::NEG_Z * weight);
        }
        moments
    }
}

#[test]
fn the_solver_finds_a_shape_that_was_chosen_first() {
    // Choose strains u(s); u⁰ = u − K⁻¹ m makes them an equilibrium. The solver must find them.
    let down = DVec3::new(0.5, 0.2, -0.7);
    let base = RodSpec {
        root: Root::from_tangent(DVec3::ZERO, down, DVec3::Y).unwrap(),
        length: 0.1,
        ..curl()
    };
    let l = base.length;
    let strain = |s: f64| {
        let x = s / l;
        DVec3::new(60.0 + 30.0 * (7.0 * x).sin(), -20.0 * (5.0 * x).cos(), 40.0 - 30.0 * x)
    };
    let steps = 6000;
    let h = l / steps as f64;
    let plain = Rod::new(base.clone()).unwrap();
    let fine = Fine::new(&base.root, l, steps, strain);
    let moments = fine.moments(h, plain.weight());
    let knots = (0..=steps)
        .map(|i| {
            let inside = fine.frames[i].transpose() * moments[i];
            (i as f64 * h, fine.strains[i] - inside / plain.stiffness())
        })
        .collect();
    let natural = NaturalStrain::Varying(StrainProfile::new(knots).unwrap());
    let rod = Rod::new(RodSpec { natural, ..base }).unwrap();
    for kind in KINDS {
        let options = Options { element: kind, ..accuracy(&rod, 1e-6) };
        let found = equilibrium(&rod, &[], &options);
        assert_eq!(found.certificate.stability, Stability::Stable);
        for (k, (point, frame)) in found.sample(61).iter().enumerate() {
            let i = k * (steps / 60);
            let error = point.distance(fine.points[i]) / l;
            assert!(error < 1.5e-6, "{kind:?} point {k}: {error}");
            let angle = frame.z_axis.angle_between(fine.frames[i].z_axis);
            assert!(angle < 1e-3, "{kind:?} point {k}: {angle} rad");
        }
    }
}

#[test]
fn loves_helix_under_a_wrench_is_exact() {
    // Uniform strain u with axis a = u/|u|, a force f a on the tip and the body moment
    // M = c u + (f/|u|) t: an equilibrium of u⁰ = u − K⁻¹ M. Love, Treatise, §270.
    let base = RodSpec { load: Load::NONE, length: 0.05, ..curl() };
    let stiffness = Rod::new(base.clone()).unwrap().stiffness();
    let u = DVec3::new(60.0, -25.0, 80.0);
    let (f, c) = (2e-6, 0.2 * stiffness.x);
    let moment = u * c + DVec3::Z * (f / u.length());
    let natural = NaturalStrain::Uniform(u - moment / stiffness);
    let rod = Rod::new(RodSpec { natural, ..base }).unwrap();
    let root = rod.root().frame();
    let turn = DMat3::from_quat(glam::DQuat::from_scaled_axis(u * rod.length()));
    for n in [1, 2, 7, 40] {
        let wrench =
            TipWrench { node: n, force: root * (u / u.length()) * f, moment, frame: root * turn };
        let options = elements(n, ElementKind::Helix);
        let found = equilibrium(&rod, &[&wrench as &dyn Potential], &options);
        assert_eq!(found.certificate.stability, Stability::Stable, "N={n}");
        for control in &found.shape.controls {
            let strain = *control * (n as f64 / rod.length());
            assert!(strain.abs_diff_eq(u, 1e-6 * u.length()), "N={n}: {strain}");
        }
    }
}

#[test]
fn energy_never_rises_along_the_iterations() {
    let mut random = SplitMix64(17);
    let spring = Spring { stiffness: 5e-3, anchor: DVec3::new(0.05, 0.0, 0.1) };
    for i in 0..20 {
        let rod = Rod::new(hair(&mut random)).unwrap();
        let external: &[&dyn Potential] = if i % 2 == 0 { &[] } else { &[&spring] };
        let chain = Chain::uniform(&rod, ElementKind::Jointed, 15);
        let problem = Problem::new(&chain, external);
        let mut before = f64::INFINITY;
        for max_iterations in 0..25 {
            let stopping = StoppingCriteria { tolerance: 1e-12, max_iterations };
            let end = Newton::default().minimise(&problem, chain.natural_shape(), stopping);
            let energy = problem.energy(&end.shape).total();
            assert!(energy <= before + 1e-13 * before.abs(), "rod {i}: {before} {energy}");
            assert!(end.iterations <= max_iterations + 1);
            before = energy;
        }
    }
}

#[test]
fn a_field_is_felt_the_same_however_finely_it_is_sampled() {
    let rod = Rod::new(curl()).unwrap();
    let well = common::Well {
        stiffness: 1e-3,
        anchor: DVec3::new(0.03, 0.02, -0.05),
        breadth: 0.06,
        length: 0.15,
    };
    for kind in [ElementKind::Helix, ElementKind::Jointed] {
        let energy = |elements, samples| {
            let chain = Chain::uniform(&rod, kind, elements);
            // The root, which is clamped and left out, is the first point of the sum.
            let spacing = 0.15 / (elements as f64 * f64::from(samples));
            let root = well.energy(0.0, rod.root().position()) * 0.5 * spacing;
            chain.energy(&chain.natural_shape(), &FieldPotential::new(&well, samples)) + root
        };
        // The natural curl is the same curve at any division, so 8 elements of 30 points are 240 of
        // one; and the sum is of second order.
        assert!((energy(8, 30) / energy(240, 1) - 1.0).abs() < 1e-12);
        let (coarse, fine, exact) = (energy(8, 8), energy(8, 16), energy(8, 512));
        let order = ((coarse - exact) / (fine - exact)).log2();
        assert!((order - 2.0).abs() < 0.1, "{order}");
    }
}
