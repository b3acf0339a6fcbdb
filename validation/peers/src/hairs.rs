//! The hairs: one curl, and any number of the same curl with roots rotated at random.

use frisure::rod::{
    InvalidQuantity, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, SplitMix64,
    TorsionConstant,
};
use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// A round hair as plain numbers for any solver; SI units, z up.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(crate) struct Hair {
    /// Length (m).
    pub(crate) length: f64,
    /// Semi-axes of the section along d1 and d2 (m).
    pub(crate) semi_axes: [f64; 2],
    /// Young's modulus (Pa).
    pub(crate) youngs_modulus: f64,
    /// Shear modulus (Pa).
    pub(crate) shear_modulus: f64,
    /// Density (kg/m³).
    pub(crate) density: f64,
    /// Acceleration of gravity along −z (m/s²).
    pub(crate) gravity: f64,
    /// Stiffness in bending about d1, d2 and in twist (N m²).
    pub(crate) stiffness: [f64; 3],
    /// Weight per length (N/m).
    pub(crate) weight_per_length: f64,
    /// Natural strain κ1, κ2, τ (rad/m).
    pub(crate) natural: [f64; 3],
    /// Directors d1, d2 and tangent at the root, which is at the origin.
    pub(crate) root: [[f64; 3]; 3],
}

/// Length (m) of all hairs.
pub(crate) const LENGTH: f64 = 0.15;

/// The root of the one hair: 45° below the horizontal.
pub(crate) fn the_one() -> Result<Rod, InvalidQuantity> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    curl(DMat3::from_cols(DVec3::Y, DVec3::new(half, 0.0, half), DVec3::new(half, 0.0, -half)))
}

/// A hair with a random root, uniform over all rotations: half of them point upwards.
pub(crate) fn turned(seed: u64, item: u64) -> Result<Rod, InvalidQuantity> {
    let mut random = SplitMix64(seed ^ item.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let [x, y, z] = [(); 3].map(|()| random.unit());
    // Shoemake 1992, "Uniform random rotations".
    let (y, z) = (std::f64::consts::TAU * y, std::f64::consts::TAU * z);
    let (a, b) = ((1.0 - x).sqrt(), x.sqrt());
    curl(DMat3::from_quat(DQuat::from_xyzw(a * y.sin(), a * y.cos(), b * z.sin(), b * z.cos())))
}

/// A curl of 5 mm radius and 1 cm of advance per turn, 4.5 turns: an incompressible isotropic round fibre of 70 µm.
fn curl(root: DMat3) -> Result<Rod, InvalidQuantity> {
    let (e, nu) = (3e9, 0.45);
    Rod::new(RodSpec {
        length: LENGTH,
        section: Section::from_semi_axes(35e-6, 35e-6)?,
        material: Material::new(e, e / (2.0 * (1.0 + nu)), 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.005, 0.010)?,
        root: Root::new(DVec3::ZERO, root.x_axis, root.y_axis, root.z_axis)?,
        load: Load::down(9.81),
    })
}

impl Hair {
    pub(crate) fn of(rod: &Rod) -> Self {
        let (spec, frame) = (rod.spec(), rod.root().frame());
        Self {
            length: spec.length,
            semi_axes: [spec.section.a(), spec.section.b()],
            youngs_modulus: spec.material.youngs_modulus(),
            shear_modulus: spec.material.shear_modulus(),
            density: spec.material.density(),
            gravity: spec.load.gravity.length(),
            stiffness: rod.stiffness().to_array(),
            weight_per_length: rod.weight(),
            natural: rod.natural().at(0.0).to_array(),
            root: [frame.x_axis, frame.y_axis, frame.z_axis].map(|d| d.to_array()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hairs_are_the_same_each_time_and_point_everywhere() {
        let rods: Vec<Rod> = (0..400).map(|k| turned(7, k).unwrap()).collect();
        for (k, rod) in rods.iter().enumerate() {
            assert_eq!(*rod, turned(7, k as u64).unwrap());
        }
        // Means of evenly spread unit vectors: 1/√(3n) is their deviation, 0.029 here.
        for axis in 0..3 {
            let mean = rods.iter().map(|r| r.root().frame().col(axis)).sum::<DVec3>() / 400.0;
            assert!(mean.abs().max_element() < 0.1, "{mean}");
        }
        assert!(rods.iter().filter(|r| r.root().frame().z_axis.z > 0.0).count() > 150);
    }

    #[test]
    fn numbers_for_others_are_those_of_the_rod() {
        let hair = Hair::of(&the_one().unwrap());
        // E π r⁴/4, G π r⁴/2, ρ π r² g, by hand.
        let r2: f64 = 35e-6 * 35e-6;
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        near(hair.stiffness[0], 3e9 * std::f64::consts::PI * r2 * r2 / 4.0);
        near(hair.stiffness[2], 3e9 / 2.9 * std::f64::consts::PI * r2 * r2 / 2.0);
        near(hair.weight_per_length, 1300.0 * std::f64::consts::PI * r2 * 9.81);
        // Curvature R/(R²+p²) and twist p/(R²+p²) of the helix.
        let p = 0.010 / std::f64::consts::TAU;
        near(hair.natural[0], 0.005 / (0.005 * 0.005 + p * p));
        near(hair.natural[2].abs(), p / (0.005 * 0.005 + p * p));
    }
}
