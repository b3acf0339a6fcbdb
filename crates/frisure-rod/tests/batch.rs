//! Hairs side by side come to the same rest as each alone.

mod common;

use common::elements;
use frisure_rod::batch::{Batch, Precision};
use frisure_rod::{
    ElementKind, Material, NaturalStrain, Rod, RodSpec, Root, Section, Stability, TorsionConstant,
    equilibrium,
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
                gravity: 9.81,
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
        let batched = batch.settle(&rods);
        let mut elsewhere = 0;
        for (i, rod) in rods.iter().enumerate() {
            let (hair, alone) = (&batched.hairs[i], equilibrium(rod, &[], &options));
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
