//! A straight rod clamped upright buckles under its own weight at Γ = 7.8373 (Greenhill 1881);
//! clamped horizontally it follows the master curve of the heavy cantilever.

mod common;

use std::f64::consts::FRAC_PI_2;

use common::{accuracy, elements, straight};
use frisure_rod::minimise::Problem;
use frisure_rod::{Chain, ElementKind, Stability, equilibrium};
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
