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
fn for_each_problem(n: usize, mut check: impl FnMut(&str, &Chain<'_>, &[&dyn Potential])) {
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

/// Differences of a function of the controls along a step, per unit of the step.
fn difference(
    controls: &[DVec3],
    step: &[DVec3],
    of: impl Fn(Vec<DVec3>) -> Vec<DVec3>,
) -> Vec<DVec3> {
    let h = 1e-5;
    let at = |h: f64| of(controls.iter().zip(step).map(|(c, x)| *c + *x * h).collect());
    at(h).into_iter().zip(at(-h)).map(|(a, b)| (a - b) / (2.0 * h)).collect()
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

fn size(a: &[DVec3]) -> f64 {
    dot(a, a).sqrt()
}

fn gap(a: &[DVec3], b: &[DVec3]) -> f64 {
    size(&a.iter().zip(b).map(|(a, b)| *a - *b).collect::<Vec<_>>()) / size(b)
}

#[test]
fn the_second_variation_times_a_step_is_the_derivative_of_the_gradient() {
    let mut random = SplitMix64(5);
    for_each_problem(6, |name, chain, external| {
        let problem = Problem::new(chain, external);
        let controls = bent(chain);
        let step: Vec<DVec3> = (0..6).map(|_| random.cube()).collect();
        let found = problem.second_variation(&chain.shape(controls.clone()), 1).apply(&step);
        let exact = difference(&controls, &step, |c| problem.gradient(&chain.shape(c)));
        assert!(gap(&found, &exact) < 1e-7, "{name}: {}", gap(&found, &exact));
    });
}

#[test]
fn the_factors_of_the_second_variation_solve_it() {
    let mut random = SplitMix64(6);
    for_each_problem(6, |name, chain, external| {
        let problem = Problem::new(chain, external);
        let operator = problem.second_variation(&chain.shape(bent(chain)), 1);
        let x: Vec<DVec3> = (0..6).map(|_| random.cube()).collect();
        let stiffness = chain.rod().stiffness() * (6.0 / chain.rod().length());
        let factor = operator.factor(30.0).expect("elasticity thirty times over is positive");
        let right: Vec<DVec3> =
            operator.apply(&x).iter().zip(&x).map(|(y, x)| *y + stiffness * *x * 30.0).collect();
        let found = factor.solve(&right);
        assert!(gap(&found, &x) < 1e-10, "{name}: {}", gap(&found, &x));
    });
}

#[test]
fn displacements_are_the_derivative_of_sample_points_and_their_transpose_that_of_energies() {
    let mut random = SplitMix64(7);
    for kind in KINDS {
        let rod = Rod::new(curl()).unwrap();
        let chain = Chain::uniform(&rod, kind, 6);
        let problem = Problem::new(&chain, &[]);
        let controls = bent(&chain);
        let operator = problem.second_variation(&chain.shape(controls.clone()), 3);
        let step: Vec<DVec3> = (0..6).map(|_| random.cube()).collect();
        let moved = operator.displacements(&step);
        let exact = difference(&controls, &step, |c| chain.sample_points(&chain.shape(c), 3));
        assert!(gap(&moved, &exact) < 1e-8, "{kind:?}: {}", gap(&moved, &exact));
        let forces: Vec<DVec3> = (0..18).map(|_| random.cube()).collect();
        let (work, same) = (dot(&forces, &moved), dot(&operator.by_controls(&forces), &step));
        assert!((work - same).abs() < 1e-12 * work.abs(), "{kind:?}: {work} {same}");
    }
}

#[test]
fn tethers_add_what_a_displacement_of_the_nodes_costs() {
    let mut random = SplitMix64(9);
    let (x, y): (Vec<DVec3>, Vec<DVec3>) = (0..6).map(|_| (random.cube(), random.cube())).unzip();
    for_each_problem(6, |name, chain, external| {
        // With one sample in each element the sample points are the nodes.
        let free = Problem::new(chain, external).second_variation(&chain.shape(bent(chain)), 1);
        let mut held = free.clone();
        held.tether(1e3);
        let moved = [&x, &y].map(|step| free.displacements(step));
        let (found, without) = (dot(&y, &held.apply(&x)), dot(&y, &free.apply(&x)));
        let exact = 1e3 * dot(&moved[0], &moved[1]);
        assert!((found - without - exact).abs() < 1e-10 * exact.abs(), "{name}");
    });
}

#[test]
fn one_pass_gives_the_product_and_the_forces_by_the_controls() {
    let mut random = SplitMix64(8);
    for_each_problem(6, |name, chain, external| {
        let problem = Problem::new(chain, external);
        let operator = problem.second_variation(&chain.shape(bent(chain)), 2);
        assert_eq!(operator.sample_count(), 12);
        let step: Vec<DVec3> = (0..6).map(|_| random.cube()).collect();
        let forces: Vec<DVec3> = (0..12).map(|_| random.cube()).collect();
        let changes = operator.node_changes(&step);
        let found = operator.apply_with(&step, &changes, &forces);
        let apart = operator.apply(&step).into_iter().zip(operator.by_controls(&forces));
        let sum: Vec<DVec3> = apart.map(|(product, by_control)| product + by_control).collect();
        assert!(gap(&found, &sum) < 1e-14, "{name}: {}", gap(&found, &sum));
        assert_eq!(operator.displacements(&step), operator.displacements_with(&step, &changes));
    });
}

#[test]
fn the_gradient_of_the_second_variation_is_that_of_the_energy() {
    let mut random = SplitMix64(9);
    for_each_problem(6, |name, chain, external| {
        let problem = Problem::new(chain, external);
        let controls = bent(chain);
        let operator = problem.second_variation(&chain.shape(controls.clone()), 1);
        let step: Vec<DVec3> = (0..6).map(|_| random.cube()).collect();
        let exact = difference(&controls, &step, |c| {
            vec![DVec3::X * problem.energy(&chain.shape(c)).total()]
        })[0]
            .x;
        let found = dot(operator.gradient(), &step);
        assert!((found - exact).abs() < 1e-6 * exact.abs(), "{name}: {found} {exact}");
    });
}
