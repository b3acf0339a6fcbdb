//! The Newton minimiser and the reference solver (L-BFGS) find the same minima on random rods.

mod common;

use common::{Spring, hair};
use frisure_rod::minimise::{Lbfgs, Minimiser, Minimum, Newton, Problem, StoppingCriteria};
use frisure_rod::potential::Potential;
use frisure_rod::{Chain, ElementKind, Rod, SplitMix64, Stability};
use glam::DVec3;

const STOPPING: StoppingCriteria = StoppingCriteria { tolerance: 1e-9, max_iterations: 5000 };

fn from_natural(minimiser: &dyn Minimiser, problem: &Problem<'_>) -> Minimum {
    minimiser.minimise(problem, problem.chain().natural_shape(), STOPPING)
}

/// Agreements and differences of the two on random hair.
fn compare(seed: u64, rods: usize, spring: Option<Spring>) {
    let mut random = SplitMix64(seed);
    let external: Vec<&dyn Potential> = spring.iter().map(|s| s as &dyn Potential).collect();
    let (mut same, mut others, mut unfinished) = (0, 0, 0);
    for i in 0..rods {
        let rod = Rod::new(hair(&mut random)).unwrap();
        let kind = if i % 2 == 0 { ElementKind::Helix } else { ElementKind::Jointed };
        let chain = Chain::uniform(&rod, kind, 10);
        let problem = Problem::new(&chain, &external);
        let scale = rod.moment_scale();

        let ours = from_natural(&Newton::default(), &problem);
        let energy = problem.energy(&ours.shape).total();
        assert_eq!(ours.stability, Stability::Stable, "rod {i}: {:?}", rod.spec());
        assert!(problem.min_eigenvalue(&ours.shape) > 0.0, "rod {i}");
        assert!(problem.gradient_norm(&ours.shape) < 1e-8, "rod {i}");
        assert!(ours.iterations < 100, "rod {i}: {} iterations", ours.iterations);

        let reference = from_natural(&Lbfgs::default(), &problem);
        if reference.stability == Stability::NotConverged {
            unfinished += 1;
            continue;
        }
        let reference_energy = problem.energy(&reference.shape).total();
        if (energy - reference_energy).abs() < 1e-8 * scale {
            same += 1;
            let tips = [&ours, &reference].map(|m| m.shape.positions[chain.len()]);
            assert!(tips[0].distance(tips[1]) < 1e-3 * rod.length(), "rod {i}: {tips:?}");
        } else {
            others += 1;
        }
    }
    assert!(unfinished * 50 <= rods, "{unfinished} unfinished");
    assert!(others * 10 <= rods, "{others} in another minimum");
    assert_eq!(same + others + unfinished, rods);
}

#[test]
fn under_gravity() {
    compare(1, 240, None);
}

#[test]
fn with_a_potential_of_position() {
    compare(2, 80, Some(Spring { stiffness: 2e-3, anchor: DVec3::new(0.03, 0.02, -0.05) }));
}
