//! The hairs of benchmarks: 15 cm long, of 70 µm, with roots all over a sphere.

use frisure_rod::{Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant};
use glam::{DQuat, DVec3};

/// Name and turns of the natural curl in 15 cm.
pub(crate) const CURLS: [(&str, f64); 4] =
    [("straight", 0.0), ("a wave of one turn", 1.0), ("four turns", 4.0), ("ten turns", 10.0)];

/// Roots in a spiral on the sphere.
pub(crate) fn heads(turns: f64, hairs: usize) -> Vec<Rod> {
    let natural = match turns {
        0.0 => NaturalStrain::STRAIGHT,
        // A third of the curl's turn is torsion.
        _ => {
            let strain = std::f64::consts::TAU * turns / 0.15;
            NaturalStrain::Uniform(DVec3::new(strain, 0.0, strain / 3.0))
        }
    };
    (0..hairs)
        .map(|k| {
            let height = 1.0 - 2.0 * (k as f64 + 0.5) / hairs as f64;
            let around = DQuat::from_rotation_z(2.399_963_229_728_653 * k as f64);
            let tangent = around * DVec3::new((1.0 - height * height).sqrt(), 0.0, height);
            rod(natural.clone(), tangent)
        })
        .collect()
}

fn rod(natural: NaturalStrain, tangent: DVec3) -> Rod {
    Rod::new(RodSpec {
        length: 0.15,
        section: Section::from_diameter(70e-6, 1.2).unwrap(),
        material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural,
        root: Root::from_tangent(DVec3::ZERO, tangent, DVec3::new(0.1, 0.9, -0.2)).unwrap(),
        load: Load::down(9.81),
    })
    .unwrap()
}
