//! A straight rod clamped upright buckles under its own weight at Γ = 7.8373 (Greenhill 1881);
//! clamped horizontally it follows the master curve of the heavy cantilever.

mod common;

use std::f64::consts::FRAC_PI_2;

use common::{accuracy, elements, straight};
use frisure_rod::minimise::Problem;
use frisure_rod::{
    AccuracyStatus, Chain, ElementKind, Load, Material, NaturalStrain, Options, Rod, RodSpec, Root,
    Section, Stability, TorsionConstant, equilibrium,
};
use glam::{DVec2, DVec3};

/// The load, ρSgL³/EI: j² · 9/4 with j the first zero of the Bessel function J of order −1/3.
const GREENHILL: f64 = 7.837_347_438_943_481;

/// The load at which N helix elements buckle, computed for this project by the planar matrices.
const DISCRETE: [(usize, f64); 8] = [
    (1, 12.0),
    (2, 8.432_025_502_155_373),
    (3, 8.102_456_006_290_979),
    (5, 7.933_686_013_411_774),
    (10, 7.861_554_548_155_35),
    (15, 7.848_116_920_200_728),
    (60, 7.838_021_044_495_266),
    (240, 7.837_389_541_308_848),
];

/// Smallest eigenvalue of the second variation of the upright shape.
fn upright_eigenvalue(gamma: f64, kind: ElementKind, n: usize) -> f64 {
    let rod = straight(gamma, DVec3::Z);
    let chain = Chain::uniform(&rod, kind, n);
    Problem::new(&chain, &[]).min_eigenvalue(&chain.natural_shape())
}

/// Where it vanishes, by bisection.
fn buckling_load(kind: ElementKind, n: usize) -> f64 {
    let (mut stable, mut unstable) = (5.0, 20.0);
    for _ in 0..40 {
        let middle = 0.5 * (stable + unstable);
        if upright_eigenvalue(middle, kind, n) > 0.0 {
            stable = middle;
        } else {
            unstable = middle;
        }
    }
    0.5 * (stable + unstable)
}

#[test]
fn helix_elements_buckle_where_they_must() {
    for (n, exact) in DISCRETE {
        let load = buckling_load(ElementKind::Helix, n);
        assert!((load / exact - 1.0).abs() < 1e-9, "N={n}: {load} {exact}");
    }
}

#[test]
fn the_buckling_load_is_greenhills() {
    for kind in [ElementKind::Helix, ElementKind::Jointed] {
        let (coarse, fine) = (buckling_load(kind, 60), buckling_load(kind, 120));
        let load = (4.0 * fine - coarse) / 3.0;
        assert!((load - GREENHILL).abs() < 1e-6, "{kind:?}: {load}");
        assert!((fine - GREENHILL).abs() < 5e-4, "{kind:?}: {fine}");
    }
}

#[test]
fn the_eigenvalue_of_the_upright_rod_is_linear_in_its_weight() {
    // H = K/h − Γ G, so the smallest λ of H x = λ (K/h) x is 1 − Γ/Γ_c.
    for gamma in [0.5, 3.0, 7.0, 20.0, 300.0] {
        let eigenvalue = upright_eigenvalue(gamma, ElementKind::Helix, 15);
        let exact = 1.0 - gamma / 7.848_116_920_200_728;
        assert!((eigenvalue - exact).abs() < 1e-9 * exact.abs().max(1.0), "{gamma}: {eigenvalue}");
    }
}

#[test]
fn upright_below_the_load_stays() {
    for gamma in [0.01, 1.0, 5.0, 7.0, 7.8] {
        let rod = straight(gamma, DVec3::Z);
        let found = equilibrium(&rod, &[], &elements(60, ElementKind::Helix));
        assert_eq!(found.certificate.stability, Stability::Stable);
        assert!(found.tip().abs_diff_eq(DVec3::Z * rod.length(), 1e-12), "{gamma}");
    }
}

/// Γ, distance of the tip from the axis and its height over the length: post-buckled states
/// computed for this project by shooting, planar.
const POST_BUCKLED: [(f64, f64, f64); 10] = [
    (7.9, 0.188_405_104_006_710_5, 0.978_893_245_134_435_1),
    (8.0, 0.298_219_787_662_509_5, 0.946_057_948_007_679_7),
    (8.5, 0.552_499_529_173_835_4, 0.796_216_240_403_243_1),
    (9.0, 0.674_983_097_744_553_7, 0.666_932_720_580_427_9),
    (10.0, 0.792_967_972_986_961_1, 0.456_023_293_313_048_2),
    (12.0, 0.849_526_933_032_027_2, 0.162_135_277_437_362_75),
    (15.0, 0.812_154_349_921_608_5, -0.102_195_796_554_658_77),
    (20.0, 0.704_969_563_366_486, -0.334_133_013_537_640_5),
    (50.0, 0.376_112_751_663_259_37, -0.673_128_103_270_571_9),
    (100.0, 0.235_629_438_117_073_07, -0.782_207_652_895_282_2),
];

#[test]
fn upright_beyond_the_load_falls_to_the_post_buckled_state() {
    for (gamma, radial, height) in POST_BUCKLED {
        let rod = straight(gamma, DVec3::Z);
        let l = rod.length();
        let found = equilibrium(&rod, &[], &accuracy(&rod, 1e-5));
        assert_eq!(found.certificate.stability, Stability::Stable, "{gamma}");
        assert!(found.energy.total() < 0.5 * rod.weight() * l * l, "{gamma}: did not fall");
        let tip = found.tip() / l;
        let error = DVec2::new(tip.truncate().length() - radial, tip.z - height).length();
        assert!(error < 1e-5, "{gamma}: {error}");
        // The fallen rod may turn about the vertical freely: one eigenvalue is zero.
        let eigenvalue = found.certificate.min_eigenvalue.unwrap();
        assert!(eigenvalue.abs() < 1e-6, "{gamma}: {eigenvalue}");
    }
}

/// Γ, drop and reach of the tip over the length for a rod clamped horizontally, computed for this
/// project by backward shooting.
const CANTILEVER: [(f64, f64, f64); 9] = [
    (0.01, 0.001_249_998_437_505_500_1, 0.999_999_107_144_651_5),
    (0.1, 0.012_498_437_848_051_84, 0.999_910_732_224_119),
    (1.0, 0.123_471_401_983_352_3, 0.991_246_395_346_636_5),
    (5.623_413_251_9, 0.533_422_911_963_690_7, 0.819_719_867_529_877_8),
    (42.169_650_342_9, 0.898_016_065_591_936_4, 0.273_839_259_011_293_25),
    (237.137_370_566, 0.960_453_163_360_756, 0.097_909_857_242_990_52),
    (1_778.279_410_04, 0.985_923_363_674_029_8, 0.034_230_642_523_720_205),
    (10_000.0, 0.994_109_933_910_915_7, 0.014_260_889_759_754_45),
    (100_000.0, 0.998_144_397_147_933_4, 0.004_483_796_902_045_021),
];

#[test]
fn the_cantilever_follows_its_master_curve() {
    for (gamma, drop, reach) in CANTILEVER {
        let rod = straight(gamma, DVec3::X);
        let found = equilibrium(&rod, &[], &accuracy(&rod, 1e-5));
        let tip = found.tip() / rod.length();
        let error = tip.distance(DVec3::new(reach, 0.0, -drop));
        assert_eq!(found.certificate.stability, Stability::Stable, "{gamma}");
        assert!(error < 1e-5, "{gamma}: {error}");
    }
}

#[test]
fn a_light_cantilever_is_the_linear_beam() {
    // Small deflections: the drop is Γ/8 of the length, the tip turns by Γ/6.
    let gamma = 1e-4;
    let rod = straight(gamma, DVec3::X);
    let found = equilibrium(&rod, &[], &accuracy(&rod, 1e-6));
    assert!((-found.tip().z / rod.length() / (gamma / 8.0) - 1.0).abs() < 1e-6);
    let (_, frame) = *found.sample(2).last().unwrap();
    let angle = FRAC_PI_2 - frame.z_axis.angle_between(DVec3::NEG_Z);
    assert!((angle / (gamma / 6.0) - 1.0).abs() < 1e-4, "{angle}");
}

/// Excess over Greenhill's load, and the lean over the length of the elastica θ″ = −Γ s sin θ (s from the tip), computed for this test
/// by shooting from the tip with a Runge–Kutta method of fourth order.
const LEANS: [(f64, f64); 4] = [
    (1e-3, 0.067_294_386_3),
    (1e-4, 0.021_307_404_9),
    (1e-5, 0.006_738_849_5),
    (1e-6, 0.002_131_038_3),
];

#[test]
fn just_beyond_the_load_the_lean_is_that_of_the_exact_rod() {
    for (excess, lean) in LEANS {
        let rod = straight(GREENHILL * (1.0 + excess), DVec3::Z);
        let found = equilibrium(&rod, &[], &accuracy(&rod, 1e-6));
        let (certificate, tip) = (found.certificate, found.tip().truncate().length());
        assert_eq!(certificate.stability, Stability::Stable, "{excess}: {certificate:?}");
        assert_eq!(certificate.accuracy, AccuracyStatus::Met, "{excess}: {certificate:?}");
        assert!((tip / rod.length() - lean).abs() < 1e-6, "{excess}: {tip} {lean}");
    }
}

#[test]
fn extrapolations_of_a_lean_do_not_agree_by_chance() {
    // lean² / ε is linear in ε between the elasticas of LEANS, to a part in a million.
    let squared = |k: usize| LEANS[k].1.powi(2) / LEANS[k].0;
    let slope = (squared(0) - squared(3)) / (LEANS[0].0 - LEANS[3].0);
    for k in 0..48 {
        let excess = 1e-5 * 100.0_f64.powf(f64::from(k) / 47.0);
        let lean = (excess * (squared(3) + slope * (excess - LEANS[3].0))).sqrt();
        let rod = straight(GREENHILL * (1.0 + excess), DVec3::Z);
        for asked in [1e-3, 2e-4, 5e-5, 1e-5] {
            let found = equilibrium(&rod, &[], &accuracy(&rod, asked));
            let error = (found.tip().truncate().length() / rod.length() - lean).abs();
            assert_eq!(found.certificate.accuracy, AccuracyStatus::Met);
            assert!(error < asked, "{excess} {asked}: {}", error / asked);
        }
    }
}

#[test]
fn what_is_not_known_to_be_stable_has_no_estimate_of_its_error() {
    // Both divisions stand, and do not differ; the rod leans by a fifth of its length.
    let rod = straight(1.01 * GREENHILL, DVec3::Z);
    let options = Options { estimate_error: true, ..elements(2, ElementKind::Auto) };
    let found = equilibrium(&rod, &[], &options);
    assert_ne!(found.certificate.stability, Stability::Stable);
    assert_eq!(found.error_estimate, None);
}

#[test]
fn the_stability_is_that_of_the_exact_rod() {
    // λ of the upright rod is 1 − Γ/Γ_c.
    for excess in [-1e-2_f64, -1e-4, -1e-6, -1e-9, 0.0, 1e-9] {
        let rod = straight(GREENHILL * (1.0 + excess), DVec3::Z);
        let found = equilibrium(&rod, &[], &accuracy(&rod, 1e-6));
        let (certificate, told) = (found.certificate, excess.abs() > 1e-8);
        let expected = match told {
            true => (Stability::Stable, AccuracyStatus::Met),
            false => (Stability::Undecided, AccuracyStatus::Missed),
        };
        let says = (certificate.stability, certificate.accuracy);
        assert_eq!(says, expected, "{excess}: {certificate:?}");
        let (least, error) =
            (certificate.min_eigenvalue.unwrap(), certificate.eigenvalue_error.unwrap());
        assert!((least + excess).abs() < error, "{excess}: {certificate:?}");
        assert!(found.tip().truncate().length() < 1e-12);
    }
}

#[test]
fn few_elements_do_not_make_an_unstable_rod_stable() {
    // 48 elements buckle at 1.00013 of the load: the rod stands, and is reported as what it is. 24 cannot tell.
    for excess in [1e-4, 1e-5] {
        let rod = straight(GREENHILL * (1.0 + excess), DVec3::Z);
        for (most, expected) in [(48, Stability::Saddle), (24, Stability::Undecided)] {
            let options = Options { max_elements: most, ..accuracy(&rod, 1e-3) };
            let found = equilibrium(&rod, &[], &options);
            let (certificate, radial) = (found.certificate, found.tip().truncate().length());
            assert!(found.elements == most && radial < 1e-12);
            assert_eq!(certificate.stability, expected, "{excess}: {certificate:?}");
            assert_eq!(certificate.accuracy, AccuracyStatus::Missed);
            // The same without the eigenvalue.
            let plain = equilibrium(&rod, &[], &Options { eigenvalue: false, ..options });
            assert_eq!(plain.certificate.stability, expected);
            assert_eq!(plain.certificate.min_eigenvalue, None);
        }
    }
}

#[test]
fn what_has_fallen_is_no_saddle_by_rounding() {
    // Its free turn about the vertical has an eigenvalue of zero, which is as far off as the gradient is.
    // A rod that was a saddle with 158 joints.
    let rod = straight(50.936_871_701_296_19, DVec3::Z);
    let material = Material::new(3e9, 1e9, 1300.0).unwrap();
    let rod = Rod::new(RodSpec { material, ..rod.spec().clone() }).unwrap();
    for kind in [ElementKind::Helix, ElementKind::Jointed] {
        for n in 140..180 {
            let found = equilibrium(&rod, &[], &elements(n, kind));
            let certificate = found.certificate;
            assert_eq!(certificate.stability, Stability::Stable, "{kind:?} {n}: {certificate:?}");
        }
    }
}

/// ρSgL³/EI at which a straight hair with half axes of 0.3 to 1, clamped horizontally and on edge, twists out of its
/// vertical plane; by Jacobi's condition on Kirchhoff's equations (`frisure-evidence`, `reference`), to ten digits.
const BEND_TWIST: f64 = 1.196_038_244_6;

/// That hair at a multiple of the load.
fn on_edge(multiple: f64) -> Rod {
    let root = 0.3_f64.sqrt();
    let section = Section::from_semi_axes(40e-6 * root, 40e-6 / root).unwrap();
    let bend = 3e9 * section.i1();
    Rod::new(RodSpec {
        length: 0.1,
        section,
        material: Material::new(3e9, 3e9 * 0.9 / 3.9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::STRAIGHT,
        root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap(),
        load: Load::down(multiple * BEND_TWIST * bend / (1300.0 * section.area() * 1e-3)),
    })
    .unwrap()
}

#[test]
fn a_hair_on_edge_twists_just_beyond_its_load() {
    for excess in [-1e-3, -1e-5, 1e-5, 1e-4, 1e-3] {
        let rod = on_edge(1.0 + excess);
        let found = equilibrium(&rod, &[], &accuracy(&rod, 1e-6));
        let (certificate, out) = (found.certificate, found.tip().y.abs() / rod.length());
        assert_eq!(certificate.stability, Stability::Stable, "{excess}: {certificate:?}");
        assert_eq!(certificate.accuracy, AccuracyStatus::Met, "{excess}: {certificate:?}");
        // The square root of the excess times 1.065, of the boundary-value problem at 1e-4.
        let expected = 1.065 * f64::max(excess, 0.0).sqrt();
        assert!((out - expected).abs() <= 0.01 * expected, "{excess}: {out} {expected}");
    }
}
