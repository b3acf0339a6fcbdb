//! Derivatives of an equilibrium, against differences of the solver and closed forms.

#![expect(clippy::print_stderr, reason = "figures, for whoever reads a test's output")]

use frisure_rod::batch::{Batch, BatchLoss, Direction};
use frisure_rod::derivatives::{
    DerivativeError, ParameterChange, ParameterGradient, Regularity, Sensitivity, ShapeChange,
};
use frisure_rod::minimise::Problem;
use frisure_rod::potential::{Field, FieldPotential, Potential};
use frisure_rod::{
    Chain, ElementKind, Load, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root,
    Section, SplitMix64, StrainProfile, TorsionConstant, equilibrium, equilibrium_from,
};
use glam::{DMat3, DQuat, DVec3};

const ELEMENTS: usize = 24;

/// What a hair is made of.
#[derive(Clone, Copy, Debug)]
struct Hair {
    length: f64,
    diameter: f64,
    axis_ratio: f64,
    curl: [f64; 2],
    /// Young's modulus, shear modulus, density.
    material: [f64; 3],
    frame: DMat3,
    position: DVec3,
}

impl Hair {
    fn rod(&self) -> Rod {
        let [young, shear, density] = self.material;
        Rod::new(RodSpec {
            length: self.length,
            section: Section::from_diameter(self.diameter, self.axis_ratio).unwrap(),
            material: Material::new(young, shear, density).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(self.curl[0], self.curl[1]).unwrap(),
            root: Root::from_tangent(self.position, self.frame.z_axis, self.frame.x_axis).unwrap(),
            load: Load::down(9.81),
        })
        .unwrap()
    }

    fn random(random: &mut SplitMix64) -> Self {
        let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
        let turn = DQuat::from_scaled_axis(DVec3::new(
            between(-2.0, 2.0),
            between(-2.0, 2.0),
            between(-2.0, 2.0),
        ));
        Self {
            length: between(0.03, 0.15),
            diameter: between(60e-6, 100e-6),
            axis_ratio: between(1.05, 2.0),
            curl: [between(0.005, 0.05), between(0.01, 0.06)],
            material: [between(2e9, 5e9), between(0.5e9, 1.5e9), 1300.0],
            frame: DMat3::from_quat(turn),
            position: DVec3::new(between(-0.1, 0.1), 0.0, between(-0.1, 0.1)),
        }
    }
}

const KINDS: [ElementKind; 2] = [ElementKind::Helix, ElementKind::Jointed];

fn options(element: ElementKind) -> Options {
    Options {
        resolution: Resolution::Elements(ELEMENTS),
        element,
        estimate_error: false,
        eigenvalue: false,
        ..Options::default()
    }
}

fn sensitivity(
    rod: &Rod,
    kind: ElementKind,
    shape: frisure_rod::Shape,
) -> Result<Sensitivity, DerivativeError> {
    let chain = Chain::uniform(rod, kind, ELEMENTS);
    Sensitivity::new(&Problem::new(&chain, &[]), shape)
}

/// The fourth-order central difference of a vector-valued function.
fn difference(step: f64, f: &impl Fn(f64) -> Vec<DVec3>) -> Vec<DVec3> {
    let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(|k| f(k * step));
    let one = |i: usize| ((a[i] - b[i]) * 8.0 - (c[i] - d[i])) / (12.0 * step);
    (0..a.len()).map(one).collect()
}

/// Largest distance of two lists, relative to the largest of the first.
fn gap(exact: &[DVec3], found: &[DVec3]) -> f64 {
    let size = exact.iter().map(|v| v.length()).fold(0.0, f64::max);
    exact.iter().zip(found).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / size
}

/// How the nodes move with one number of the hair, by the product and by differences.
fn compare(
    hair: &Hair,
    kind: ElementKind,
    at: &Sensitivity,
    change: &ParameterChange,
    changed: impl Fn(f64) -> Hair,
    step: f64,
) -> f64 {
    let before = equilibrium(&hair.rod(), &[], &options(kind));
    // Positions (m), and the three axes of each frame in units of the length.
    let nodes = |x: f64| {
        let rod = changed(x).rod();
        let rest = equilibrium_from(&rod, &[], &options(kind), &before);
        let at = sensitivity(&rod, kind, rest.shape).unwrap();
        let axes = |r: &DMat3| [r.x_axis, r.y_axis, r.z_axis].map(|v| v * hair.length);
        let frames = at.shape().frames.iter().flat_map(axes);
        at.shape().positions.iter().copied().chain(frames).collect::<Vec<_>>()
    };
    let moved = at.jvp(change).unwrap();
    let axes =
        |(w, r): (&DVec3, &DMat3)| [r.x_axis, r.y_axis, r.z_axis].map(|v| w.cross(v) * hair.length);
    let frames = moved.rotations.iter().zip(&at.shape().frames).flat_map(axes);
    let exact: Vec<DVec3> = moved.positions.iter().copied().chain(frames).collect();
    // A long step errs by truncation where the rod is near a loss of stability, a short one by rounding where the number
    // hardly moves it: the better of them is the judge.
    let gaps = [1.0, 0.2, 0.04].map(|share| gap(&exact, &difference(share * step, &nodes)));
    gaps.into_iter().fold(f64::INFINITY, f64::min)
}

/// Uniform change of the strain along a derivative of curvature and twist.
fn strain(by: DVec3) -> ParameterChange {
    ParameterChange { natural_strain: vec![by; ELEMENTS], ..ParameterChange::default() }
}

/// Worst gap of all parameters of a hair.
fn worst(hair: &Hair, kind: ElementKind, at: &Sensitivity) -> f64 {
    let rod = hair.rod();
    let (k, [young, shear, density]) = (rod.stiffness(), hair.material);
    let stiffness = |stiffness| ParameterChange { stiffness, ..ParameterChange::default() };
    let with = |index: usize, factor: f64| {
        let mut material = hair.material;
        material[index] *= factor;
        Hair { material, ..*hair }
    };
    let by_young = stiffness(DVec3::new(k.x, k.y, 0.0) / young);
    let by_shear = stiffness(DVec3::Z * k.z / shear);
    let load = rod.load() / density;
    let by_density = ParameterChange { load, ..ParameterChange::default() };
    let h = 1e-3;
    let mut gaps = vec![
        compare(hair, kind, at, &by_young, |x| with(0, 1.0 + x / young), h * young),
        compare(hair, kind, at, &by_shear, |x| with(1, 1.0 + x / shear), h * shear),
        compare(hair, kind, at, &by_density, |x| with(2, 1.0 + x / density), h * density),
    ];
    // Radius and pitch of the curl, by the chain rule of `ParameterGradient::curl`: its rows are these strains.
    let unit = |v: DVec3| ParameterGradient {
        natural_strain: vec![v],
        length: None,
        stiffness: DVec3::ZERO,
        load: DVec3::ZERO,
        root_position: DVec3::ZERO,
        root_rotation: DVec3::ZERO,
    };
    for index in 0..2 {
        let [x, z] = [DVec3::X, DVec3::Z].map(|v| unit(v).curl(hair.curl[0], hair.curl[1])[index]);
        let changed = |by: f64| {
            let mut curl = hair.curl;
            curl[index] += by;
            Hair { curl, ..*hair }
        };
        let by_curl = strain(DVec3::new(x, 0.0, z));
        gaps.push(compare(hair, kind, at, &by_curl, changed, h * hair.curl[index]));
    }
    let longer = |x: f64| Hair { length: hair.length + x, ..*hair };
    let by_length = ParameterChange { length: 1.0, ..ParameterChange::default() };
    gaps.push(compare(hair, kind, at, &by_length, longer, h * hair.length));
    // Mean diameter and axis ratio move stiffness and weight, by the rows of `ParameterGradient::diameter`.
    for index in 0..2 {
        let row = |stiffness: DVec3, load: DVec3| {
            ParameterGradient { stiffness, load, ..unit(DVec3::ZERO) }.diameter(&rod)[index]
        };
        let stiffness = DVec3::new(
            row(DVec3::X, DVec3::ZERO),
            row(DVec3::Y, DVec3::ZERO),
            row(DVec3::Z, DVec3::ZERO),
        );
        let load = DVec3::Z * row(DVec3::ZERO, DVec3::Z);
        let changed = |by: f64| match index {
            0 => Hair { diameter: hair.diameter + by, ..*hair },
            _ => Hair { axis_ratio: hair.axis_ratio + by, ..*hair },
        };
        let size = [hair.diameter, 0.1][index];
        let by_section = ParameterChange { stiffness, load, ..ParameterChange::default() };
        gaps.push(compare(hair, kind, at, &by_section, changed, h * size));
    }
    // The clamp: turned about an axis, and moved.
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    let turned = |x: f64| Hair { frame: DMat3::from_axis_angle(axis, x) * hair.frame, ..*hair };
    let by_turn = ParameterChange { root_rotation: axis, ..ParameterChange::default() };
    gaps.push(compare(hair, kind, at, &by_turn, turned, 1e-3));
    let moved = |x: f64| Hair { position: hair.position + axis * x, ..*hair };
    let by_move = ParameterChange { root_position: axis, ..ParameterChange::default() };
    gaps.push(compare(hair, kind, at, &by_move, moved, 1e-3));
    gaps.into_iter().fold(0.0, f64::max)
}

/// Regular hairs of `count` random ones with their sensitivities.
fn regular(kind: ElementKind, count: usize, seed: u64) -> Vec<(Hair, Sensitivity)> {
    let mut random = SplitMix64(seed);
    let hairs = (0..count).map(|_| Hair::random(&mut random)).collect::<Vec<_>>();
    let at_rest = |hair: Hair| {
        let rod = hair.rod();
        let shape = equilibrium(&rod, &[], &options(kind)).shape;
        sensitivity(&rod, kind, shape).ok().map(|at| (hair, at))
    };
    let found = hairs.into_iter().filter_map(at_rest);
    found.filter(|(_, at)| at.regularity() == Regularity::Regular).collect()
}

#[test]
fn products_agree_with_differences_of_the_solver() {
    // More of them for the figures of docs/theory.md.
    let count = std::env::var("FRISURE_HAIRS").map_or(100, |n| n.parse().expect("a number"));
    for kind in KINDS {
        let hairs = regular(kind, count, 1);
        assert!(hairs.len() * 10 > count * 9, "{kind:?}: {}", hairs.len());
        let checked = hairs.iter().map(|(hair, at)| (worst(hair, kind, at), at, hair));
        let bad: Vec<_> = checked.filter(|(worst, ..)| !(*worst < 1e-7)).collect();
        for (worst, at, hair) in &bad {
            eprintln!("{kind:?} {worst} {} {hair:?}", at.min_eigenvalue());
        }
        eprintln!("{kind:?}: {} of {} regular hairs disagree", bad.len(), hairs.len());
        assert!(bad.is_empty(), "{kind:?}: {} of {} hairs", bad.len(), hairs.len());
    }
}

#[test]
fn both_products_are_adjoint() {
    let mut random = SplitMix64(2);
    let mut vector = |size: f64| {
        DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5) * size
    };
    for (hair, at) in KINDS.into_iter().flat_map(|kind| regular(kind, 40, 3)) {
        let rod = hair.rod();
        let mut nodes = |size: f64| (0..=ELEMENTS).map(|_| vector(size)).collect::<Vec<_>>();
        let loss = ShapeChange { positions: nodes(1.0), rotations: nodes(0.1) };
        let change = ParameterChange {
            natural_strain: (0..ELEMENTS).map(|_| vector(10.0)).collect(),
            length: vector(0.1).x,
            stiffness: vector(1.0) * rod.stiffness(),
            load: vector(rod.weight()),
            root_position: vector(0.01),
            root_rotation: vector(0.1),
        };
        let moved = at.jvp(&change).unwrap();
        let dot = |a: &[DVec3], b: &[DVec3]| a.iter().zip(b).map(|(x, g)| x.dot(*g)).sum::<f64>();
        let forward =
            dot(&moved.positions, &loss.positions) + dot(&moved.rotations, &loss.rotations);
        let backward = at.vjp(&loss).unwrap().along(&change);
        assert!(
            (forward - backward).abs() < 1e-10 * forward.abs().max(1e-3),
            "{forward} {backward}"
        );
    }
}

#[test]
fn a_stiff_cantilever_sags_by_its_load_over_its_stiffness() {
    // δ = w L⁴/8EI: dδ/dEI = −δ/EI, dδ/dw = δ/w, and a curvature κ lifts the tip by L²/2.
    let hair = Hair {
        length: 0.02,
        diameter: 120e-6,
        axis_ratio: 1.0,
        curl: [10.0, 0.0],
        material: [5e9, 2e9, 1300.0],
        frame: DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
        position: DVec3::ZERO,
    };
    let rod = hair.rod();
    let kind = ElementKind::Helix;
    let at = sensitivity(&rod, kind, equilibrium(&rod, &[], &options(kind)).shape).unwrap();
    let mut loss = vec![DVec3::ZERO; ELEMENTS + 1];
    loss[ELEMENTS] = DVec3::NEG_Z;
    let gradient = at.vjp(&loss.into()).unwrap();
    let (length, k) = (hair.length, rod.stiffness().x);
    let sag = rod.weight() * length.powi(4) / (8.0 * k);
    assert!((gradient.weight(&rod) * rod.weight() / sag - 1.0).abs() < 2e-3);
    assert!(
        (gradient.stiffness.x * k / -sag - 1.0).abs() < 2e-3,
        "{}",
        gradient.stiffness.x * k / sag
    );
    let lift = gradient.uniform_strain().length() / (0.5 * length * length);
    assert!((lift - 1.0).abs() < 2e-3, "{lift}");
}

#[test]
fn the_energy_at_rest_changes_as_the_envelope_theorem_says() {
    for kind in KINDS {
        for (hair, at) in regular(kind, 20, 5) {
            let rod = hair.rod();
            let before = equilibrium(&rod, &[], &options(kind));
            let energy = |hair: Hair| {
                let rod = hair.rod();
                let rest = equilibrium_from(&rod, &[], &options(kind), &before);
                let at = sensitivity(&rod, kind, rest.shape).unwrap();
                let chain = Chain::uniform(&rod, kind, ELEMENTS);
                Problem::new(&chain, &[]).energy(at.shape()).total()
            };
            let slope = |changed: &dyn Fn(f64) -> Hair| {
                let h = 1e-4;
                (energy(changed(1.0 + h)) - energy(changed(1.0 - h))) / (2.0 * h)
            };
            let heavier = |x: f64| {
                let [young, shear, density] = hair.material;
                Hair { material: [young, shear, density * x], ..hair }
            };
            let longer = |x: f64| Hair { length: hair.length * x, ..hair };
            let [radius, pitch] = hair.curl;
            let wider = |x: f64| Hair { curl: [radius * x, pitch], ..hair };
            let by = at.by_energy();
            let pairs = [
                (slope(&heavier), by.weight(&rod) * rod.weight()),
                (slope(&longer), by.length.unwrap() * hair.length),
                (slope(&wider), by.curl(radius, pitch)[0] * radius),
            ];
            let size = Problem::new(&Chain::uniform(&rod, kind, ELEMENTS), &[]).energy(at.shape());
            let size = size.elastic + size.gravity.abs();
            for (found, exact) in pairs {
                assert!((found - exact).abs() < 1e-6 * size, "{kind:?} {found} {exact} {size}");
            }
        }
    }
}

#[test]
fn near_a_loss_of_stability_the_derivatives_say_so() {
    // A straight hair upright, just below the load of Greenhill: Γ = 7.8373 with equal stiffnesses.
    let hair = |length: f64| Hair {
        length,
        diameter: 80e-6,
        axis_ratio: 1.0,
        curl: [1e6, 0.0],
        material: [3e9, 1e9, 1300.0],
        frame: DMat3::IDENTITY,
        position: DVec3::ZERO,
    };
    let upright = |share: f64| {
        let unit = hair(1.0).rod();
        let length = (share * 7.8373 / unit.heaviness()).cbrt();
        let rod = Rod::new(RodSpec {
            natural: NaturalStrain::STRAIGHT,
            ..hair(length).rod().spec().clone()
        })
        .unwrap();
        let shape = Chain::uniform(&rod, ElementKind::Helix, ELEMENTS).natural_shape();
        sensitivity(&rod, ElementKind::Helix, shape)
    };
    assert_eq!(upright(0.5).unwrap().regularity(), Regularity::Regular);
    assert_eq!(upright(0.9999).unwrap().regularity(), Regularity::IllConditioned);
    assert_eq!(upright(1.2).unwrap_err(), DerivativeError::NotAMinimum);
    // In lanes too, also for a loss that asks nothing of the soft direction: the height of the tip.
    // Jointed elements fall over a little earlier: the first share at which they still stand.
    let rod = |share: f64| {
        let length = (share * 7.8373 / hair(1.0).rod().heaviness()).cbrt();
        let natural = NaturalStrain::STRAIGHT;
        Rod::new(RodSpec { natural, ..hair(length).rod().spec().clone() }).unwrap()
    };
    let alone = |rod: &Rod| {
        let shape = Chain::uniform(rod, ElementKind::Jointed, ELEMENTS).natural_shape();
        sensitivity(rod, ElementKind::Jointed, shape)
    };
    let standing = (0..100).map(|k| rod(1.0 - 2e-4 * f64::from(k)));
    let last = standing.into_iter().find(|rod| alone(rod).is_ok()).expect("one that stands");
    assert!(alone(&last).unwrap().min_eigenvalue() < 1e-3);
    let rods = [rod(0.5), last];
    let batch = Batch { elements: ELEMENTS, tolerance: 1e-10, ..Batch::default() };
    let mut loss = vec![DVec3::ZERO; 2 * (ELEMENTS + 1)];
    (loss[ELEMENTS], loss[2 * ELEMENTS + 1]) = (DVec3::Z, DVec3::Z);
    let gradient = batch.vjp(&rods, &batch.solve(&rods), BatchLoss::of_positions(&loss));
    let found = [0, 1].map(|i| gradient.rods[i].regularity);
    assert_eq!(found, [Ok(Regularity::Regular), Ok(Regularity::IllConditioned)]);
}

/// A spring along the whole rod to a point (m), of a stiffness (Pa).
struct Spring(DVec3, f64);

impl Field for Spring {
    fn energy(&self, _: f64, p: DVec3) -> f64 {
        0.5 * self.1 * p.distance_squared(self.0)
    }

    fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        Some(((p - self.0) * self.1, DMat3::from_diagonal(DVec3::splat(self.1))))
    }
}

/// A hair that a spring holds, by the turn of both (rad) about an axis and the radius of its curl.
fn held(
    hair: Hair,
    kind: ElementKind,
    samples: u32,
    turn: DMat3,
    radius: f64,
) -> Result<Sensitivity, DerivativeError> {
    let hair = Hair { curl: [radius, hair.curl[1]], ..hair };
    let rod = Hair { frame: turn * hair.frame, ..hair }.rod();
    let away = turn * DVec3::new(0.02, 0.03, 0.01);
    let spring = Spring(hair.position + away, 0.05 * rod.weight() / 0.01);
    let spring = FieldPotential::new(&spring, samples);
    let rest = equilibrium(&rod, &[&spring], &options(kind));
    let chain = Chain::uniform(&rod, kind, ELEMENTS);
    let felt: [&dyn Potential; 1] = [&spring];
    Sensitivity::new(&Problem::new(&chain, &felt), rest.shape)
}

#[test]
fn a_head_that_is_turned_takes_what_holds_the_rod_along() {
    let hair = Hair { length: 0.06, ..Hair::random(&mut SplitMix64(9)) };
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    for kind in KINDS {
        let turned =
            |x: f64| held(hair, kind, 2, DMat3::from_axis_angle(axis, x), hair.curl[0]).unwrap();
        let at = turned(0.0);
        assert_eq!(at.regularity(), Regularity::Regular);
        let by_turn = ParameterChange { root_rotation: axis, ..ParameterChange::default() };
        let found = difference(1e-3, &|x| turned(x).shape().positions.clone());
        assert!(gap(&at.jvp(&by_turn).unwrap().positions, &found) < 1e-7);
    }
}

#[test]
fn natural_strain_counts_where_a_field_acts_between_the_nodes() {
    let hair = Hair { length: 0.06, ..Hair::random(&mut SplitMix64(9)) };
    let [radius, pitch] = hair.curl;
    for (kind, samples) in [ElementKind::Helix, ElementKind::Jointed]
        .into_iter()
        .flat_map(|kind| [1, 2, 3, 4].map(|samples| (kind, samples)))
    {
        let curled = |x: f64| held(hair, kind, samples, DMat3::IDENTITY, radius + x).unwrap();
        let at = curled(0.0);
        assert_eq!(at.regularity(), Regularity::Regular);
        let found = difference(1e-3 * radius, &|x| curled(x).shape().positions.clone());
        // The tip along each axis, by the gradient.
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let mut loss = vec![DVec3::ZERO; ELEMENTS + 1];
            loss[ELEMENTS] = axis;
            let by = at.vjp(&loss.into()).unwrap();
            assert_eq!(by.length, None);
            let exact = by.curl(radius, pitch)[0];
            let size = found[ELEMENTS].length();
            let gap = (exact - found[ELEMENTS].dot(axis)).abs();
            assert!(gap < 1e-7 * size, "{kind:?} {samples}: {gap} {size}");
        }
        let longer = ParameterChange { length: 0.001, ..ParameterChange::default() };
        assert_eq!(at.jvp(&longer).unwrap_err(), DerivativeError::Length);
    }
}

/// A floor at a height (m) of a stiffness (Pa): what is below it is pushed up.
struct Floor {
    height: f64,
    stiffness: f64,
}

impl Field for Floor {
    fn energy(&self, _: f64, p: DVec3) -> f64 {
        0.5 * self.stiffness * (self.height - p.z).max(0.0).powi(2)
    }

    fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let depth = self.height - p.z;
        let push = DVec3::NEG_Z * (self.stiffness * depth);
        let hessian = DMat3::from_diagonal(DVec3::new(0.0, 0.0, self.stiffness));
        (depth > 0.0).then_some((push, hessian))
    }
}

/// The derivative of the energy of a floor by its height.
struct ByHeight(Floor);

impl Field for ByHeight {
    fn energy(&self, _: f64, p: DVec3) -> f64 {
        self.0.stiffness * (self.0.height - p.z).max(0.0)
    }

    fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        (p.z < self.0.height).then_some((DVec3::NEG_Z * self.0.stiffness, DMat3::ZERO))
    }
}

#[test]
fn numbers_of_a_contact_are_parameters_too() {
    let hair = Hair { length: 0.06, ..Hair::random(&mut SplitMix64(9)) };
    let rod = hair.rod();
    let free = equilibrium(&rod, &[], &options(ElementKind::Helix));
    let lowest = free.shape.positions.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let usual = (lowest + 0.3 * (hair.position.z - lowest), 2.0 * rod.weight() / 0.01);
    for kind in KINDS {
        let chain = Chain::uniform(&rod, kind, ELEMENTS);
        let at = |height: f64, stiffness: f64| {
            let floor = Floor { height, stiffness };
            let floor = FieldPotential::new(&floor, 2);
            let rest = equilibrium(&rod, &[&floor], &options(kind));
            let felt: [&dyn Potential; 1] = [&floor];
            Sensitivity::new(&Problem::new(&chain, &felt), rest.shape).unwrap()
        };
        let (height, stiffness) = usual;
        let rest = at(height, stiffness);
        assert_eq!(rest.regularity(), Regularity::Regular);
        let (unit, slope) =
            (Floor { height, stiffness: 1.0 }, ByHeight(Floor { height, stiffness }));
        let (unit, slope) = (FieldPotential::new(&unit, 2), FieldPotential::new(&slope, 2));
        let by_stiffness =
            difference(1e-3 * stiffness, &|x| at(height, stiffness + x).shape().positions.clone());
        let by_height = difference(2e-6, &|x| at(height + x, stiffness).shape().positions.clone());
        let numbers: [(&dyn Potential, &[DVec3]); 2] =
            [(&unit, &by_stiffness), (&slope, &by_height)];
        for (number, found) in numbers {
            let moved = rest.jvp_by_potential(&chain, number).unwrap();
            assert!(
                gap(&moved.positions, found) < 1e-6,
                "{kind:?}: {}",
                gap(&moved.positions, found)
            );
            // Backwards: the tip along a direction.
            let mut loss = vec![DVec3::ZERO; ELEMENTS + 1];
            loss[ELEMENTS] = DVec3::new(0.3, -0.5, 0.8);
            let along = moved.positions[ELEMENTS].dot(loss[ELEMENTS]);
            let back = rest.vjp_by_potentials(&chain, &loss.into(), &[number]).unwrap()[0];
            assert!((along - back).abs() < 1e-9 * along.abs(), "{along} {back}");
        }
        let coarse = Chain::uniform(&rod, kind, ELEMENTS - 1);
        let wrong = rest.jvp_by_potential(&coarse, &unit).unwrap_err();
        assert!(matches!(wrong, DerivativeError::Elements { .. }));
    }
}

/// Hairs of which every third has a natural strain that varies, and one in seven has no weight.
fn of_all_kinds(count: usize, seed: u64) -> Vec<Rod> {
    let mut random = SplitMix64(seed);
    let rod = |i: usize| {
        let rod = Hair::random(&mut random).rod();
        let spec = rod.spec().clone();
        let strain = spec.natural.at(0.0);
        let knots = [(0.0, 0.5), (0.3, 1.3), (0.7, 0.9), (1.0, 1.1)];
        let knots = knots.map(|(s, x)| (s * rod.length(), strain * x)).to_vec();
        let natural = match i % 3 {
            0 => NaturalStrain::Varying(StrainProfile::new(knots).unwrap()),
            _ => spec.natural.clone(),
        };
        let load = match i % 7 {
            3 => Load::NONE,
            // A head that lies, in wind.
            5 => Load {
                gravity: DVec3::new(6.0, -7.0, 3.5),
                force: DVec3::new(1.0, 2.0, -0.5) * 2e-5,
            },
            _ => Load::down(9.81),
        };
        Rod::new(RodSpec { natural, load, ..spec }).unwrap()
    };
    (0..count).map(rod).collect()
}

#[test]
fn lanes_give_what_one_rod_alone_gives() {
    let rods = of_all_kinds(301, 21);
    // Also all alike, where lanes share what they have of the natural helix.
    let uniform: Vec<Rod> = rods
        .iter()
        .filter(|rod| matches!(rod.natural(), NaturalStrain::Uniform(_)))
        .cloned()
        .collect();
    for (rods, tolerance) in [(&rods, 1e-10), (&uniform, 1e-10), (&uniform, 1e-4)] {
        let batch = Batch { elements: ELEMENTS, tolerance, ..Batch::default() };
        let found = batch.solve(rods);
        let mut random = SplitMix64(22);
        let mut vectors = |size: f64| -> Vec<DVec3> {
            let mut one = || (random.unit() - 0.5) * size;
            (0..rods.len() * (ELEMENTS + 1)).map(|_| DVec3::new(one(), one(), one())).collect()
        };
        let (positions, frames) = (vectors(1.0), vectors(0.05));
        // An energy in the unit of the loss: by the moment of a rod.
        let energies: Vec<f64> =
            rods.iter().map(|rod| (random.unit() - 0.5) / rod.moment_scale()).collect();
        let loss = BatchLoss { positions: &positions, frames: &frames, energies: &energies };
        let gradient = batch.vjp(rods, &found, loss);
        let shape = batch.vjp(rods, &found, BatchLoss { energies: &[], ..loss });
        let energy =
            batch.vjp(rods, &found, BatchLoss { energies: &energies, ..Default::default() });
        let mut regular = 0;
        for (i, rod) in rods.iter().enumerate() {
            let nodes = i * (ELEMENTS + 1)..(i + 1) * (ELEMENTS + 1);
            let loss = ShapeChange {
                positions: positions[nodes.clone()].to_vec(),
                rotations: frames[nodes].to_vec(),
            };
            let chain = Chain::uniform(rod, ElementKind::Jointed, ELEMENTS);
            let at = Sensitivity::new(&Problem::new(&chain, &[]), found.shape(rod, i)).unwrap();
            assert!(gradient.rods[i].eigenvalue_bound > at.min_eigenvalue() * (1.0 - 1e-6));
            if (at.min_eigenvalue() / 1e-3 - 1.0).abs() > 1e-3 {
                assert_eq!(gradient.rods[i].regularity, Ok(at.regularity()), "{i}");
            }
            if at.regularity() == Regularity::IllConditioned {
                continue;
            }
            regular += 1;
            let (of_shape, of_energy) = (at.vjp(&loss).unwrap(), at.by_energy());
            // A rod that goes to the scalar code has the smallest of all.
            assert!(tolerance > 1e-10 || energy.rods[i].eigenvalue_bound == 1.0);
            // All in units of the loss: stiffness and load by their sizes, strain by one turn in the length.
            let turn = 1.0 / rod.length();
            let sizes = |by: &ParameterGradient| -> Vec<DVec3> {
                let numbers = [
                    by.stiffness * rod.stiffness(),
                    by.load * (rod.weight() + 1e-7),
                    by.root_position * rod.length(),
                    by.root_rotation,
                    DVec3::X * (by.length.unwrap() * rod.length()),
                ];
                let strains = by.natural_strain.iter().map(|by| *by * turn);
                numbers.into_iter().chain(strains).collect()
            };
            let of_shape = sizes(&of_shape);
            let of_energy: Vec<DVec3> =
                sizes(&of_energy).iter().map(|by| *by * energies[i]).collect();
            let both = of_shape.iter().zip(&of_energy).map(|(a, b)| *a + *b).collect::<Vec<_>>();
            for (alone, lanes) in [(of_shape, &shape), (of_energy, &energy), (both, &gradient)] {
                let lanes = sizes(&lanes.of(i));
                let largest = alone.iter().map(|v| v.length()).fold(0.0, f64::max);
                for (k, (a, b)) in alone.iter().zip(&lanes).enumerate() {
                    let (gap, size) = (a.distance(*b), a.length() + 1e-3 * largest);
                    assert!(gap < 1e-7 * size, "{i}, {k}: {a} {b} {}", at.min_eigenvalue());
                }
            }
        }
        assert!(regular > rods.len() * 9 / 10, "{regular}");
    }
}

/// With weight that bends, buckles and stretches, and without any.
#[test]
fn nodes_and_smallest_eigenvalues_in_lanes_are_those_of_one_rod_alone() {
    let rods = of_all_kinds(101, 41);
    let uniform = |rod: &&Rod| matches!(rod.natural(), NaturalStrain::Uniform(_));
    let uniform: Vec<Rod> = rods.iter().filter(uniform).cloned().collect();
    for (rods, elements) in [(&rods, ELEMENTS), (&uniform, ELEMENTS), (&rods, 1), (&rods, 2)] {
        let batch = Batch { elements, tolerance: 1e-10, ..Batch::default() };
        let found = batch.solve(rods);
        let (positions, nodes) = (found.positions(rods), found.nodes(rods));
        let eigenvalues = found.min_eigenvalues(rods);
        for (i, rod) in rods.iter().enumerate() {
            let shape = found.shape(rod, i);
            for (k, (x, r)) in shape.positions.iter().zip(&shape.frames).enumerate() {
                let node = i * (elements + 1) + k;
                assert!(x.distance(positions[node]) < 1e-13 + 1e-12 * rod.length(), "{i} {k}");
                assert_eq!(positions[node], nodes[node].0);
                assert!(r.abs_diff_eq(nodes[node].1, 1e-11), "{i} {k}");
            }
            let chain = Chain::uniform(rod, ElementKind::Jointed, elements);
            let alone = Problem::new(&chain, &[]).min_eigenvalue(&shape);
            assert!((eigenvalues[i] - alone).abs() < 1e-7 * alone.abs() + 1e-9, "{i}: {alone}");
        }
    }
    assert!(Batch::default().solve(&[]).positions(&[]).is_empty());
}

#[test]
fn wrong_input_is_refused() {
    let (hair, at) = regular(ElementKind::Helix, 5, 7).swap_remove(0);
    let few = at.vjp(&vec![DVec3::X; 3].into()).unwrap_err();
    assert_eq!(few, DerivativeError::Nodes { given: 3, nodes: ELEMENTS + 1 });
    let rotations = vec![DVec3::X; 2];
    let few = at.vjp(&ShapeChange { positions: vec![DVec3::X; ELEMENTS + 1], rotations });
    assert_eq!(few.unwrap_err(), DerivativeError::Nodes { given: 2, nodes: ELEMENTS + 1 });
    let change = ParameterChange { natural_strain: vec![DVec3::X; 2], ..Default::default() };
    let few = at.jvp(&change).unwrap_err();
    assert_eq!(few, DerivativeError::Elements { given: 2, elements: ELEMENTS });
    // A potential that is told nothing of the halves of jointed elements.
    struct Still;
    impl Potential for Still {
        fn depends_on_position(&self) -> bool {
            true
        }
    }
    let rod = hair.rod();
    let chain = Chain::uniform(&rod, ElementKind::Jointed, ELEMENTS);
    let felt: [&dyn Potential; 1] = [&Still];
    let shape = equilibrium(&rod, &felt, &options(ElementKind::Jointed)).shape;
    let jointed = Sensitivity::new(&Problem::new(&chain, &felt), shape);
    assert_eq!(jointed.unwrap_err(), DerivativeError::JointedElements);
}

/// A direction of each kind; the strains of halves differ from half to half.
fn directions(random: &mut SplitMix64) -> Vec<Direction> {
    let strain = |natural_strain| Direction { natural_strain, ..Direction::default() };
    vec![
        strain(vec![DVec3::new(3.0, -1.0, 2.0)]),
        strain((0..2 * ELEMENTS).map(|_| random.cube()).collect()),
        Direction { stiffness: DVec3::new(0.2, -0.1, 0.3), ..Direction::default() },
        Direction { weight: 0.1, ..Direction::default() },
        Direction { length: 0.1, ..Direction::default() },
        Direction { root_rotation: DVec3::new(0.1, 0.2, -0.1), ..Direction::default() },
    ]
}

#[test]
fn nodes_move_in_lanes_as_those_of_one_rod_alone() {
    let rods = of_all_kinds(161, 31);
    let uniform: Vec<Rod> = rods
        .iter()
        .filter(|rod| matches!(rod.natural(), NaturalStrain::Uniform(_)))
        .cloned()
        .collect();
    let mut random = SplitMix64(32);
    let directions = directions(&mut random);
    let mut regular = 0;
    for (rods, tolerance) in [(&rods, 1e-10), (&uniform, 1e-10), (&uniform, 1e-4)] {
        let batch = Batch { elements: ELEMENTS, tolerance, ..Batch::default() };
        let found = batch.solve(rods);
        let moved = batch.jvp(rods, &found, &directions);
        for (i, rod) in rods.iter().enumerate() {
            let chain = Chain::uniform(rod, ElementKind::Jointed, ELEMENTS);
            let at = Sensitivity::new(&Problem::new(&chain, &[]), found.shape(rod, i)).unwrap();
            assert_eq!(moved.existence[i], Ok(()));
            for (node, (x, r)) in moved.nodes(i).iter().enumerate() {
                assert!(x.distance(at.shape().positions[node]) < 1e-8 * rod.length());
                assert!((r.x_axis - at.shape().frames[node].x_axis).length() < 1e-7);
            }
            if at.regularity() == Regularity::IllConditioned {
                continue;
            }
            regular += 1;
            for (k, direction) in directions.iter().enumerate() {
                if direction.natural_strain.len() > 1 {
                    continue;
                }
                let strain = direction.natural_strain.first().map(|u| vec![*u; ELEMENTS]);
                let alone = at.jvp(&ParameterChange {
                    natural_strain: strain.unwrap_or_default(),
                    length: direction.length * rod.length(),
                    stiffness: direction.stiffness * rod.stiffness(),
                    load: rod.load() * direction.weight,
                    root_position: DVec3::ZERO,
                    root_rotation: direction.root_rotation,
                });
                let alone = alone.unwrap();
                let lanes = moved.motions(i, k);
                let shifts: Vec<DVec3> = lanes.iter().map(|motion| motion.shift).collect();
                let turns: Vec<DVec3> = lanes.iter().map(|motion| motion.rotation).collect();
                if rod.weight() == 0.0 && k < 4 && k > 1 {
                    // Stiffness and weight move nothing where there is no weight.
                    assert!(shifts.iter().all(|v| v.length() < 1e-12), "{i}, {k}");
                    continue;
                }
                let worst = gap(&alone.positions, &shifts).max(gap(&alone.rotations, &turns));
                assert!(worst < 1e-7, "{i}, {k}: {worst} {}", at.min_eigenvalue());
            }
        }
    }
    assert!(regular > 300, "{regular}");
}

/// A loss of nodes and frames has the same derivative along a direction forwards and backwards, also where each half of an element
/// has a strain of its own.
#[test]
fn products_in_lanes_agree_forwards_and_backwards() {
    let rods = of_all_kinds(60, 33);
    let batch = Batch { elements: ELEMENTS, tolerance: 1e-10, ..Batch::default() };
    let found = batch.solve(&rods);
    let mut random = SplitMix64(34);
    let directions = directions(&mut random);
    let mut vectors = |size: f64| -> Vec<DVec3> {
        (0..rods.len() * (ELEMENTS + 1)).map(|_| random.cube() * size).collect()
    };
    let (positions, frames) = (vectors(1.0), vectors(0.05));
    let moved = batch.jvp(&rods, &found, &directions);
    let loss = BatchLoss { positions: &positions, frames: &frames, energies: &[] };
    let gradient = batch.vjp(&rods, &found, loss);
    for (i, rod) in rods.iter().enumerate() {
        let by = gradient.rods[i];
        if by.regularity != Ok(Regularity::Regular) {
            continue;
        }
        let halves = &gradient.natural_strain[i * ELEMENTS..(i + 1) * ELEMENTS];
        for (k, direction) in directions.iter().enumerate() {
            let nodes = moved.motions(i, k).iter().enumerate();
            let forwards: f64 = nodes
                .map(|(node, motion)| {
                    let node = i * (ELEMENTS + 1) + node;
                    positions[node].dot(motion.shift) + frames[node].dot(motion.rotation)
                })
                .sum();
            let given = |half: usize| match direction.natural_strain.as_slice() {
                [] => DVec3::ZERO,
                [same] => *same,
                halves => halves[half],
            };
            let strains = halves.iter().flatten().enumerate();
            let by_strain: f64 = strains.map(|(half, by)| by.dot(given(half))).sum();
            let backwards = by_strain
                + by.length * direction.length * rod.length()
                + by.stiffness.dot(direction.stiffness * rod.stiffness())
                + by.load.dot(rod.load()) * direction.weight
                + by.root_rotation.dot(direction.root_rotation);
            let size = moved.motions(i, k).iter().map(|m| m.shift.length()).sum::<f64>() + 1e-6;
            assert!((forwards - backwards).abs() < 1e-7 * size, "{i}, {k}: {forwards} {backwards}");
        }
    }
}
