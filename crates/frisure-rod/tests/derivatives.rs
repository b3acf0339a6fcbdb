//! Gradients against finite differences, for both elements, with and without positions.

mod common;

use common::{Spring, curl};
use frisure_rod::minimise::Problem;
use frisure_rod::potential::Potential;
use frisure_rod::{Chain, ElementKind, Rod};
use glam::DVec3;

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

#[test]
fn gradients_agree_with_differences() {
    let rod = Rod::new(curl()).unwrap();
    let spring = Spring { stiffness: 1e-3, anchor: DVec3::new(0.02, -0.01, 0.03) };
    for kind in [ElementKind::Helix, ElementKind::Jointed] {
        for external in [&[][..], &[&spring as &dyn Potential][..]] {
            let chain = Chain::uniform(&rod, kind, 7);
            let problem = Problem::new(&chain, external);
            let controls = bent(&chain);
            let gradient = problem.gradient(&chain.shape(controls.clone()));
            let scale = rod.moment_scale();
            for i in 0..7 {
                for axis in 0..3 {
                    let energy = |h: f64| {
                        let mut c = controls.clone();
                        c[i][axis] += h;
                        problem.energy(&chain.shape(c)).total()
                    };
                    let h = 1e-5;
                    let slope = (energy(h) - energy(-h)) / (2.0 * h);
                    assert!(
                        (slope - gradient[i][axis]).abs() < 1e-8 * scale,
                        "{kind:?} {i} {axis}: {slope} {}",
                        gradient[i][axis]
                    );
                }
            }
        }
    }
}
