//! Ten thousand curls at once, side by side in the lanes of SIMD vectors.
//!
//! `cargo run --release -p frisure-rod --example many_rods`

#![expect(clippy::print_stdout, reason = "an example prints")]

use std::time::Instant;

use frisure_rod::batch::Batch;
use frisure_rod::{
    InvalidQuantity, Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, Stability,
    TorsionConstant,
};
use glam::DVec3;

const RODS: usize = 10_000;

fn main() -> Result<(), InvalidQuantity> {
    let rods: Vec<Rod> = (0..RODS).map(curl).collect::<Result<_, _>>()?;
    let batch = Batch { elements: 30, ..Batch::default() };

    let start = Instant::now();
    let found = batch.solve(&rods);
    let seconds = start.elapsed().as_secs_f64();

    let stable = found.rods.iter().filter(|rod| rod.stability == Stability::Stable).count();
    let steps: usize = found.rods.iter().map(|rod| rod.iterations).sum();
    let drop: f64 =
        rods.iter().enumerate().map(|(i, rod)| -found.shape(rod, i).positions[30].z).sum();
    println!("{stable} of {RODS} rods in a stable minimum");
    println!("{:.1} Newton steps per rod", steps as f64 / RODS as f64);
    println!("tips {:.1} cm below their roots on average", 100.0 * drop / RODS as f64);
    println!("{:.0} rods per second on one thread", RODS as f64 / seconds);
    Ok(())
}

/// A curl that leaves the scalp in one of the directions of a spiral over the sphere.
fn curl(i: usize) -> Result<Rod, InvalidQuantity> {
    let z = 1.0 - 2.0 * (i as f64 + 0.5) / RODS as f64;
    let (sin, cos) = (2.399_963 * i as f64).sin_cos();
    let r = (1.0 - z * z).sqrt();
    Rod::new(RodSpec {
        length: 0.15,
        section: Section::from_diameter(70e-6, 1.4)?,
        material: Material::new(3.9e9, 0.9e9, 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.005, 0.010)?,
        root: Root::from_tangent(DVec3::ZERO, DVec3::new(r * cos, r * sin, z), DVec3::Y)?,
        load: Load::down(9.81),
    })
}
