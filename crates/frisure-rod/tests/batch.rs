//! Hairs side by side come to the same rest as each alone.

mod common;

use common::{elements, hair, reference_cases, straight};
use frisure_rod::batch::{Batch, Precision};
use frisure_rod::minimise::Problem;
use frisure_rod::{
    Chain, ElementKind, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, SplitMix64,
    Stability, StrainProfile, TorsionConstant, equilibrium,
};
use glam::DVec3;

/// Hair from straight to coiled, rooted all over a head.
fn head(count: usize) -> Vec<Rod> {
    (0..count)
        .map(|i| {
            let z = 1.0 - 1.6 * (i as f64 + 0.5) / count as f64;
            let angle = 2.399_963 * i as f64;
            let r = (1.0 - z * z).sqrt();
            let tangent = DVec3::new(r * angle.cos(), r * angle.sin(), z);
            let (radius, pitch) = [(0.12, 0.3), (0.012, 0.09), (0.010, 0.024)][i % 3];
            Rod::new(RodSpec {
                length: 0.10 + 0.15 * ((i * 7) % 13) as f64 / 13.0,
                section: Section::from_diameter(70e-6 + 1e-6 * (i % 9) as f64, 1.5).unwrap(),
                material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
                torsion: TorsionConstant::SaintVenant,
                natural: NaturalStrain::helix(radius, pitch).unwrap(),
                root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(0.1, 0.9, -0.2)).unwrap(),
                load: Load::down(9.81),
            })
            .unwrap()
        })
        .collect()
}

#[test]
fn a_batch_finds_what_each_hair_finds_alone() {
    let rods = head(120);
    let options = elements(24, ElementKind::Jointed);
    for precision in [Precision::Double, Precision::Single] {
        let batch = Batch { elements: 24, precision, ..Batch::default() };
        let batched = batch.solve(&rods);
        let mut elsewhere = 0;
        for (i, rod) in rods.iter().enumerate() {
            let (hair, alone) = (&batched.rods[i], equilibrium(rod, &[], &options));
            assert_eq!(hair.stability, Stability::Stable, "{i}");
            assert!(hair.gradient_norm <= batch.tolerance);
            let shape = batched.shape(rod, i);
            let tip = shape.positions[24];
            if tip.distance(alone.tip()) < 1e-6 * rod.length() {
                let energy = alone.energy.total();
                assert!((hair.energy - energy).abs() < 1e-10 * energy.abs().max(1e-12), "{i}");
            } else {
                elsewhere += 1;
            }
        }
        assert!(elsewhere <= 2, "{elsewhere} of 120 at another equilibrium ({precision:?})");
    }
}

/// Weight and stiffness of any size, natural strain of any kind: whatever a batch calls rest is one by the scalar
/// code's own derivatives.
#[test]
fn rest_is_rest() {
    let mut random = SplitMix64(7);
    let mut rods: Vec<Rod> = (0..200).map(|_| Rod::new(hair(&mut random)).unwrap()).collect();
    // Natural strain that varies along the hair, in some of a batch of both.
    for rod in rods.iter_mut().step_by(3) {
        let (strain, length) = (rod.natural().at(0.0), rod.length());
        let knots = vec![(0.0, strain), (0.4 * length, -0.5 * strain), (length, 1.5 * strain)];
        let natural = NaturalStrain::Varying(StrainProfile::new(knots).unwrap());
        *rod = Rod::new(RodSpec { natural, ..rod.spec().clone() }).unwrap();
    }
    for precision in [Precision::Double, Precision::Single] {
        let batch = Batch { elements: 20, precision, ..Batch::default() };
        let batched = batch.solve(&rods);
        for (i, rod) in rods.iter().enumerate() {
            let chain = Chain::uniform(rod, ElementKind::Jointed, 20);
            let (problem, shape) = (Problem::new(&chain, &[]), batched.shape(rod, i));
            assert_eq!(batched.rods[i].stability, Stability::Stable, "{i}");
            let gradient = problem.gradient_norm(&shape);
            assert!(gradient < 2e-8, "{i}: {gradient}");
            assert!(problem.min_eigenvalue(&shape) > -1e-9, "{i}");
            let energy = problem.energy(&shape).total();
            let reported = batched.rods[i].energy;
            assert!(
                (reported - energy).abs() < 1e-9 * rod.moment_scale(),
                "{i}: {reported} {energy}"
            );
        }
    }
}

#[test]
fn reference_equilibria() {
    for case in reference_cases() {
        let batch = Batch { elements: 240, tolerance: 1e-11, ..Batch::default() };
        let batched = batch.solve(std::slice::from_ref(&case.rod));
        let tip = batched.shape(&case.rod, 0).positions[240];
        let alone = equilibrium(&case.rod, &[], &elements(240, ElementKind::Jointed)).tip();
        let (error, gap) = (tip.distance(case.tip), tip.distance(alone));
        let length = case.rod.length();
        assert!(error < 1e-2 * length, "{}: {error}", case.name);
        assert!(gap < 1e-7 * length, "{}: {gap}", case.name);
    }
}

/// Hairs that share a vector do not see each other.
#[test]
fn neighbours_change_nothing() {
    let rods = head(50);
    for precision in [Precision::Double, Precision::Single] {
        let batch = Batch { elements: 10, precision, ..Batch::default() };
        let together = batch.solve(&rods);
        for (i, rod) in rods.iter().enumerate() {
            let alone = batch.solve(std::slice::from_ref(rod));
            assert_eq!(alone.rods[0], together.rods[i]);
            assert_eq!(alone.controls, together.controls[i * 10..(i + 1) * 10]);
        }
    }
}

#[test]
fn saddles_and_limits() {
    let mut rods: Vec<Rod> = [1e-6, 1.0, 30.0, 1e4]
        .into_iter()
        .flat_map(|gamma| [DVec3::Z, -DVec3::Z, DVec3::X].map(|t| straight(gamma, t)))
        .collect();
    // A planar curl in the plane of gravity, and hair without weight.
    let planar = RodSpec {
        natural: NaturalStrain::helix(0.01, 0.0).unwrap(),
        root: Root::new(DVec3::ZERO, DVec3::Y, DVec3::Z, DVec3::X).unwrap(),
        ..common::curl()
    };
    rods.push(Rod::new(planar.clone()).unwrap());
    rods.push(Rod::new(RodSpec { load: Load::NONE, ..planar }).unwrap());
    let batched = Batch { elements: 30, ..Batch::default() }.solve(&rods);
    for (i, hair) in batched.rods.iter().enumerate() {
        assert_eq!(hair.stability, Stability::Stable, "{i}: {hair:?}");
    }
    assert!(Batch::default().solve(&[]).rods.is_empty());
    let one = Batch { elements: 1, ..Batch::default() }.solve(&rods);
    assert!(one.rods.iter().all(|hair| hair.stability == Stability::Stable));
}

/// A rod that hardly bends under its weight and twists a lot (length in m, E and G in Pa, g in m/s², natural strain in rad/m).
fn stiff_but_twisting(
    length: f64,
    axis_ratio: f64,
    [e, g, gravity]: [f64; 3],
    strain: DVec3,
    tangent: DVec3,
) -> Rod {
    Rod::new(RodSpec {
        length,
        section: Section::from_diameter(72e-6, axis_ratio).unwrap(),
        material: Material::new(e, g, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::Uniform(strain),
        root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(0.1, 0.3, 1.0)).unwrap(),
        load: Load::down(gravity),
    })
    .unwrap()
}

#[test]
fn what_hardly_bends_but_twists_comes_to_rest() {
    let rods = [
        stiff_but_twisting(
            0.034,
            5.1,
            [7e12, 3.7e3, 4.4e-3],
            DVec3::new(-53.0, -44.0, 9.0),
            DVec3::new(0.52, 0.67, 0.28),
        ),
        stiff_but_twisting(1e-3, 1.0, [1e13, 1e3, 9.81], DVec3::X * 1000.0, DVec3::X),
        stiff_but_twisting(0.1, 1.3, [3.9e9, 1e6, 9.81], DVec3::new(60.0, 0.0, 5.0), DVec3::X),
    ];
    let batch = Batch::default();
    let exact = Batch { tolerance: 1e-15, ..batch };
    let (found, exact) = (batch.solve(&rods), exact.solve(&rods));
    let options = elements(batch.elements, ElementKind::Jointed);
    for (i, rod) in rods.iter().enumerate() {
        assert_eq!(found.rods[i].stability, Stability::Stable, "{i}");
        assert!(found.rods[i].iterations > 0, "{i}");
        let tip = |of: &frisure_rod::batch::BatchSolution| {
            *of.shape(rod, i).positions.last().expect("a rod has nodes")
        };
        // It has moved, and as far as to a gradient that is only rounding.
        let gap = tip(&found).distance(tip(&exact)) / rod.length();
        assert!(gap < 1e-5, "{i}: {gap}");
        let alone = equilibrium(rod, &[], &options);
        assert_eq!(alone.certificate.stability, Stability::Stable, "{i}");
        let gap = tip(&found).distance(alone.tip()) / rod.length();
        assert!(gap < 1e-5, "{i}: {gap}");
    }
}

/// Random hair: from short to long, from straight to coiled, in all directions.
fn random_hair(count: usize) -> Vec<Rod> {
    let mut random = SplitMix64(7);
    let mut draw = || {
        let radius = random.decades(1.5e-3, 0.1);
        Rod::new(RodSpec {
            length: random.decades(0.03, 0.6),
            section: Section::from_diameter(
                random.between(50e-6, 100e-6),
                random.between(1.0, 2.0),
            )
            .unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(radius, radius * random.decades(0.3, 20.0)).unwrap(),
            root: Root::from_tangent(DVec3::ZERO, random.direction(), random.direction()).unwrap(),
            load: Load::down(9.81),
        })
        .unwrap()
    };
    (0..count).map(|_| draw()).collect()
}

/// The largest distance (m) of the nodes of each rod from the same of a finer division.
fn true_errors(rods: &[Rod], elements: usize) -> Vec<f64> {
    let fine = 512;
    let solve = |elements| Batch { elements, ..Batch::default() }.solve(rods).positions(rods);
    let (coarse, exact) = (solve(elements), solve(fine));
    let pairs = coarse.chunks(elements + 1).zip(exact.chunks(fine + 1));
    pairs
        .map(|(coarse, exact)| {
            let exact = exact.iter().step_by(fine / elements);
            coarse.iter().zip(exact).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
        })
        .collect()
}

#[test]
fn errors_are_at_most_as_estimated_and_not_much_less() {
    let rods = random_hair(1000);
    for elements in [8, 16, 32] {
        let batch = Batch { elements, ..Batch::default() };
        let estimates = batch.errors(&rods, &batch.solve(&rods));
        let mut shares: Vec<f64> = true_errors(&rods, elements)
            .iter()
            .zip(&estimates)
            .filter(|(_, estimate)| estimate.is_finite())
            .map(|(error, estimate)| error / estimate)
            .collect();
        shares.sort_by(f64::total_cmp);
        assert!(shares.len() > 700, "{elements} elements: {} have an estimate", shares.len());
        let share_at = |part: f64| shares[(part * (shares.len() - 1) as f64) as usize];
        assert!(share_at(0.98) < 1.0, "{elements} elements: {}", share_at(0.98));
        assert!(share_at(0.50) > 0.25, "{elements} elements: {}", share_at(0.50));
    }
}

#[test]
fn no_error_is_estimated_where_divisions_say_nothing() {
    let rods = random_hair(300);
    let odd = Batch::default();
    let errors = odd.errors(&rods, &odd.solve(&rods));
    assert!(errors.iter().all(|error| error.is_infinite()), "an odd number of elements");
    // Elements that turn by more than half a turn with the curl.
    let few = Batch { elements: 8, ..odd };
    let errors = few.errors(&rods, &few.solve(&rods));
    for (rod, error) in rods.iter().zip(errors) {
        let turn = rod.natural().at(0.0).length() * rod.length() / 8.0;
        assert_eq!(error.is_infinite(), turn > std::f64::consts::PI, "a turn of {turn}");
    }
}

#[test]
fn waves_that_all_divisions_leave_out_are_in_the_error() {
    // 64 whole waves: each half of an element, of 8 as of 16 and 4, has a mean of nothing.
    let knots = (0..=64 * 8).map(|k| {
        let s = f64::from(k) / (64.0 * 8.0);
        (0.1 * s, DVec3::X * 900.0 * (64.0 * std::f64::consts::TAU * s).sin())
    });
    let natural = NaturalStrain::Varying(StrainProfile::new(knots.collect()).unwrap());
    let rod = Rod::new(RodSpec {
        length: 0.1,
        section: Section::from_diameter(70e-6, 1.4).unwrap(),
        material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural,
        root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap(),
        load: Load::down(9.81),
    })
    .unwrap();
    let rods = [rod];
    let error = true_errors(&rods, 16)[0];
    let batch = Batch { elements: 16, ..Batch::default() };
    let estimate = batch.errors(&rods, &batch.solve(&rods))[0];
    assert!(error > 1e-4 && estimate > error, "{estimate} m of {error} m");
}
