//! Gradients and Hessians against finite differences, for both elements, with and without
//! positions; and the quadratic convergence that only exact Hessians give.

mod common;

use common::{Hold, Spring, TipWrench, Well, curl, dense_hessian, hair, smallest_eigenvalue};
use frisure_rod::minimise::{Minimiser, Newton, Problem, StoppingCriteria};
use frisure_rod::potential::{FieldPotential, Potential};
use frisure_rod::{Chain, ElementKind, Rod, SplitMix64};
use glam::{DMat3, DVec3};

const KINDS: [ElementKind; 2] = [ElementKind::Helix, ElementKind::Jointed];

const SPRING: Spring = Spring { stiffness: 1e-3, anchor: DVec3::new(0.02, -0.01, 0.03) };

const WELL: Well =
    Well { stiffness: 1e-3, anchor: DVec3::new(0.03, 0.02, -0.05), breadth: 0.06, length: 0.15 };

/// A force and a moment that are comparable with the weight and with EI/L.
fn wrench(rod: &Rod, node: usize) -> TipWrench {
    TipWrench {
        node,
        force: DVec3::new(0.3, -0.4, 0.8) * rod.weight() * rod.length(),
        moment: DVec3::new(0.6, -0.5, 0.7) * rod.moment_scale(),
        frame: DMat3::from_rotation_y(0.4) * DMat3::from_rotation_x(1.1),
    }
}

fn bent(chain: &Chain<'_>) -> Vec<DVec3> {
    let natural = chain.natural_shape().controls;
    natural
        .iter()
        .enumerate()
        .map(|(i, c)| {
            let x = i as f64;
            *c + DVec3::new((1.3 * x).sin(), (2.1 * x).cos(), (0.7 * x).sin()) * 0.2
        })
        .collect()
}

/// Runs a check for both elements and for no, one and several further potentials.
fn for_each_problem(n: usize, check: impl Fn(&str, &Chain<'_>, &[&dyn Potential])) {
    let rod = Rod::new(curl()).unwrap();
    let wrench = wrench(&rod, n);
    for kind in KINDS {
        let chain = Chain::uniform(&rod, kind, n);
        let (coarse, fine) = (FieldPotential::new(&WELL, 1), FieldPotential::new(&WELL, 5));
        let cases: [&[&dyn Potential]; 6] =
            [&[], &[&SPRING], &[&wrench], &[&SPRING, &wrench], &[&coarse], &[&fine, &wrench]];
        for external in cases {
            let name = format!("{kind:?}, {} further potentials", external.len());
            check(&name, &chain, external);
        }
    }
}

#[test]
fn gradients_agree_with_differences() {
    let n = 7;
    for_each_problem(n, |name, chain, external| {
        let problem = Problem::new(chain, external);
        let controls = bent(chain);
        let gradient = problem.gradient(&chain.shape(controls.clone()));
        let scale = chain.rod().moment_scale();
        for i in 0..n {
            for axis in 0..3 {
                let energy = |h: f64| {
                    let mut c = controls.clone();
                    c[i][axis] += h;
                    problem.energy(&chain.shape(c)).total()
                };
                let h = 1e-5;
                let slope = (energy(h) - energy(-h)) / (2.0 * h);
                let gap = (slope - gradient[i][axis]).abs();
                assert!(gap < 1e-8 * scale, "{name} {i} {axis}: {slope} {}", gradient[i][axis]);
            }
        }
    });
}

/// Compares the smallest eigenvalue at a shape that a dead load holds with that of the dense
/// Hessian from differences of gradients. Every second-order term of rotations counts there.
fn compare_second_variation(
    name: &str,
    chain: &Chain<'_>,
    external: &[&dyn Potential],
    controls: Vec<DVec3>,
) {
    let shape = chain.shape(controls.clone());
    let hold = Hold { gradient: Problem::new(chain, external).gradient(&shape) };
    let held: Vec<&dyn Potential> = external.iter().copied().chain([&hold as _]).collect();
    let problem = Problem::new(chain, &held);
    assert!(problem.gradient_norm(&shape) < 1e-14, "{name}");

    let hessian = dense_hessian(&problem, &controls, chain.rod());
    let size = hessian.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (i, row) in hessian.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            let gap = (x - hessian[j][i]).abs();
            assert!(gap < 1e-7 * size, "{name}: not symmetric at {i} {j}");
        }
    }
    let exact = smallest_eigenvalue(hessian);
    let found = problem.min_eigenvalue(&shape);
    assert!((found - exact).abs() < 1e-7 * size, "{name}: {found} {exact}");
}

#[test]
fn second_variations_agree_with_differences_of_gradients() {
    for n in [1, 2, 5] {
        for_each_problem(n, |name, chain, external| {
            compare_second_variation(name, chain, external, bent(chain));
        });
    }
}

#[test]
fn random_second_variations_agree_with_differences_of_gradients() {
    let mut random = SplitMix64(31);
    for i in 0..40 {
        let rod = Rod::new(hair(&mut random)).unwrap();
        let wrench = wrench(&rod, 4);
        let external: [&[&dyn Potential]; 3] = [&[], &[&SPRING], &[&wrench]];
        let chain = Chain::uniform(&rod, KINDS[i % 2], 4);
        let natural = chain.natural_shape().controls;
        let controls = natural.iter().map(|c| *c + random.cube() * 0.7).collect();
        compare_second_variation(&format!("rod {i}"), &chain, external[i % 3], controls);
    }
}

#[test]
fn convergence_is_quadratic() {
    for_each_problem(12, |name, chain, external| {
        let problem = &Problem::new(chain, external);
        // From beside the minimum: the gradient after each iteration, to rounding.
        let tight = StoppingCriteria { tolerance: 1e-13, max_iterations: 200 };
        let minimum = Newton::default().minimise(problem, chain.natural_shape(), tight);
        let beside: Vec<DVec3> = (minimum.shape.controls.iter().enumerate())
            .map(|(i, c)| *c + DVec3::new(1.0, -1.0, 0.5) * 0.01 * (i as f64).cos())
            .collect();
        let norms: Vec<f64> = (0..6)
            .map(|max_iterations| {
                let stopping = StoppingCriteria { tolerance: 1e-15, max_iterations };
                let start = chain.shape(beside.clone());
                Newton::default().minimise(problem, start, stopping).gradient_norm
            })
            .collect();
        for pair in norms.windows(2) {
            // Each error is about the square of the one before, down to rounding.
            assert!(pair[1] < 30.0 * pair[0] * pair[0] + 1e-14, "{name}: {norms:?}");
        }
        assert!(norms[5] < 1e-13, "{name}: {norms:?}");
    });
}
