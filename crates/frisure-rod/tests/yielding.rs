//! A lock that yields, against closed forms.

mod common;

use frisure_rod::potential::{Derivatives, NodeState, Potential, YieldLaw, Yielding};
use frisure_rod::{
    Chain, ElementKind, Equilibrium, Load, Material, NaturalStrain, Options, Resolution, Rod,
    RodSpec, Root, Section, Stability, TorsionConstant, equilibrium, equilibrium_from,
};
use glam::DVec3;

use common::{curl, elements};

const LENGTH: f64 = 0.1;

/// A straight fibre that leaves its clamp level.
fn fibre(load: Load) -> Rod {
    Rod::new(RodSpec {
        length: LENGTH,
        section: Section::circular(50e-6).unwrap(),
        material: Material::new(3.9e9, 1.5e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::STRAIGHT,
        root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap(),
        load,
    })
    .unwrap()
}

fn options(n: usize) -> Options {
    Options { tolerance: 1e-13, eigenvalue: false, ..elements(n, ElementKind::Helix) }
}

/// A moment (N m) about −y of the world on the tip, of a rod that bends in the plane of x and z.
struct TipMoment(f64);

impl Potential for TipMoment {
    fn depends_on_position(&self) -> bool {
        false
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        let t = node.frame.z_axis;
        if (node.s - LENGTH).abs() < 1e-9 { -self.0 * t.z.atan2(t.x) } else { 0.0 }
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        // A turn η turns the tangent about −y by −y·R η; in the plane there is no second derivative.
        if (node.s - LENGTH).abs() < 1e-9 {
            sum.rotation -= node.frame.transpose() * DVec3::NEG_Y * self.0;
        }
    }
}

/// Curvature (1/m) towards +z of a rod that is bent to a circle.
fn curvature(rest: &Equilibrium) -> f64 {
    let t = rest.shape.frames.last().unwrap().z_axis;
    t.z.atan2(t.x) / LENGTH
}

/// A lock of K_f = 9 K whose fibres slip at half of K times 1/m, as it is bent by moments of so many times K (1/m), one after the
/// other; the curvature (1/m) after each, and the energy (J) dissipated in all.
fn bent_by(moments: &[f64]) -> (Vec<f64>, f64) {
    let rod = fibre(Load::NONE);
    let stiffness = rod.stiffness().x;
    let law = |_| YieldLaw { stiffness: 9.0 * stiffness, moment: 0.5 * stiffness };
    let mut rest = equilibrium(&rod, &[], &options(10));
    let mut lock = Yielding::stuck_at(&rest.chain(), &rest.shape, law);
    let mut dissipated = 0.0;
    let curvatures = moments.iter().map(|moment| {
        rest =
            equilibrium_from(&rod, &[&lock, &TipMoment(moment * stiffness)], &options(10), &rest);
        assert_eq!(rest.certificate.stability, Stability::Stable);
        dissipated += lock.follow(&rest.chain(), &rest.shape);
        curvature(&rest)
    });
    (curvatures.collect(), dissipated / stiffness)
}

#[test]
fn a_lock_is_stiff_below_its_moment_and_soft_with_an_offset_above_it() {
    // It slips where K_f e = m_y: at 1/18 1/m, by the moment (1 + 1/9)/2.
    let (found, _) = bent_by(&[0.2, 0.5, 1.0, 3.0]);
    for (found, expected) in found.iter().zip([0.02, 0.05, 0.5, 2.5]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

#[test]
fn a_cycle_of_bending_has_the_loop_of_the_closed_form() {
    // Loaded to e = 2.5 1/m by 3; unloaded it keeps (9·2.5 − 0.5)/10 where its fibres do not slip back, and m_y/K = 0.5 where they do.
    let (found, _) = bent_by(&[3.0, 2.5, 0.0, -3.0, 3.0]);
    for (found, expected) in found.iter().zip([2.5, 2.45, 0.5, -2.5, 2.5]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    // From one end to the other and back it loses 4 m_y (e − m_y/K_f) per length, however many steps that has.
    let once = bent_by(&[3.0]).1;
    for steps in [1, 2, 8, 64] {
        let way = |from: f64, to: f64| {
            (1..=steps).map(move |k| from + (to - from) * f64::from(k) / f64::from(steps))
        };
        let cycle: Vec<f64> =
            [3.0].into_iter().chain(way(3.0, -3.0)).chain(way(-3.0, 3.0)).collect();
        let (curvatures, all) = bent_by(&cycle);
        let expected = 4.0 * 0.5 * (2.5 - 0.5 / 9.0) * LENGTH;
        assert!(((all - once) / expected - 1.0).abs() < 1e-9, "{steps}: {all} {expected}");
        if steps == 64 {
            // The work of the moment over the loop, by trapezia.
            let path: Vec<(f64, f64)> = cycle.iter().copied().zip(curvatures).collect();
            let work: f64 =
                path.windows(2).map(|p| 0.5 * (p[0].0 + p[1].0) * (p[1].1 - p[0].1)).sum();
            assert!((work * LENGTH / expected - 1.0).abs() < 2e-3, "{work}");
        }
    }
}

/// Set of the tip (m) of a cantilever of `n` elements that was bent by a weight and is weightless again, and that of the closed form.
fn set(n: usize) -> (f64, f64) {
    // So light that it stays straight to 1e-4 of its length.
    let (heavy, free) = (fibre(Load::down(1e-3)), fibre(Load::NONE));
    let (k, q) = (heavy.stiffness().x, heavy.weight());
    let law = YieldLaw { stiffness: 4.0 * k, moment: 0.256 * q * LENGTH * LENGTH };
    let straight = equilibrium(&free, &[], &options(n));
    let mut lock = Yielding::stuck_at(&straight.chain(), &straight.shape, |_| law);
    let bent = equilibrium_from(&heavy, &[&lock], &options(n), &straight);
    lock.follow(&bent.chain(), &bent.shape);
    let released = equilibrium_from(&free, &[&lock], &options(n), &bent);
    assert_eq!(released.certificate.stability, Stability::Stable);
    // Fibres slip where q ξ²/2, ξ from the tip, is above M = m_y (K + K_f)/K_f. There the bend (qξ²/2 − m_y)/K is left as
    // K_f (qξ²/2 − M)/(K (K + K_f)), less than m_y/K, so that none slip back.
    let most = law.moment * (k + law.stiffness) / law.stiffness;
    let from = (2.0 * most / q).sqrt();
    let left = law.stiffness / (k * (k + law.stiffness));
    let whole = |x: f64| q * x.powi(4) / 8.0 - most * x * x / 2.0;
    (-released.tip().z, left * (whole(LENGTH) - whole(from)))
}

#[test]
fn a_cantilever_that_was_bent_keeps_the_set_of_the_closed_form() {
    let (found, expected) = set(320);
    assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
    // Of second order in the elements: slip ends at 0.8 L from the tip, which is a node of them all.
    let errors = [20, 40, 80, 160].map(|n| {
        let (found, expected) = set(n);
        (found / expected - 1.0).abs()
    });
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.05, "{errors:?}");
    }
}

#[test]
fn steps_of_the_load_hardly_matter() {
    // A curl in a wind from the side that is turned on in steps: its elements turn as they bend.
    let spec = curl();
    let rod = |share: f64| {
        let force = DVec3::new(0.0, 2e-4 * share, -1e-4 * share);
        Rod::new(RodSpec { load: Load { gravity: DVec3::ZERO, force }, ..spec.clone() }).unwrap()
    };
    let options = elements(60, ElementKind::Auto);
    let free = equilibrium(&rod(0.0), &[], &options);
    let whole = equilibrium_from(&rod(1.0), &[], &options, &free);
    let tip = |steps: u32| {
        let stiffness = free.rod.stiffness().x;
        let law = |_| YieldLaw { stiffness: 20.0 * stiffness, moment: 20.0 * stiffness };
        let mut rest = free.clone();
        let mut lock = Yielding::stuck_at(&rest.chain(), &rest.shape, law);
        for step in 1..=steps {
            let rod = rod(f64::from(step) / f64::from(steps));
            rest = equilibrium_from(&rod, &[&lock], &options, &rest);
            assert_eq!(rest.certificate.stability, Stability::Stable);
            lock.follow(&rest.chain(), &rest.shape);
        }
        rest.tip()
    };
    let tips = [4, 8, 16].map(tip);
    let slip = tips[2].distance(whole.tip());
    assert!(slip > 1e-3, "{slip}");
    assert!(tips[1].distance(tips[2]) < 0.01 * slip, "{tips:?} {slip}");
    assert!(tips[0].distance(tips[1]) < 0.02 * slip, "{tips:?} {slip}");
}

#[test]
fn fibres_that_do_not_stick_change_no_bit() {
    let rod = Rod::new(curl()).unwrap();
    let options = elements(30, ElementKind::Auto);
    let alone = equilibrium(&rod, &[], &options);
    for law in [(0.0, 1e-7), (1e-7, 0.0)].map(|(stiffness, moment)| YieldLaw { stiffness, moment })
    {
        let chain = Chain::uniform(&rod, ElementKind::Auto, 30);
        let lock = Yielding::stuck_at(&chain, &chain.natural_shape(), |_| law);
        assert_eq!(equilibrium(&rod, &[&lock], &options).shape, alone.shape);
    }
}

#[test]
fn stiff_locks_take_few_iterations() {
    for factor in [1.0, 10.0, 100.0, 1000.0] {
        let rod = Rod::new(curl()).unwrap();
        let options = Options {
            resolution: Resolution::Elements(60),
            estimate_error: false,
            eigenvalue: false,
            ..Options::default()
        };
        let free = Rod::new(RodSpec { load: Load::NONE, ..curl() }).unwrap();
        let start = equilibrium(&free, &[], &options);
        let stiffness = rod.stiffness().x;
        let law = |_| YieldLaw { stiffness: factor * stiffness, moment: 10.0 * stiffness };
        let lock = Yielding::stuck_at(&start.chain(), &start.shape, law);
        let rest = equilibrium_from(&rod, &[&lock], &options, &start);
        assert_eq!(rest.certificate.stability, Stability::Stable);
        assert!(rest.certificate.iterations < 60, "{factor}: {}", rest.certificate.iterations);
    }
}
