//! A curl hangs in its own weight: its shape, energies and certificate.
//!
//! `cargo run -p frisure-rod --example one_hair`

#![expect(clippy::print_stdout, reason = "an example prints")]

use frisure_rod::{
    InvalidQuantity, Load, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root,
    Section, TorsionConstant, equilibrium,
};
use glam::DVec3;

fn main() -> Result<(), InvalidQuantity> {
    // A curl of 15 cm with a radius of 5 mm and a pitch of 1 cm, leaving the scalp sideways.
    let rod = Rod::new(RodSpec {
        length: 0.15,
        section: Section::from_diameter(70e-6, 1.4)?,
        material: Material::new(3.9e9, 0.9e9, 1300.0)?,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.005, 0.010)?,
        root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
        load: Load::down(9.81),
    })?;

    // Every point of the centre line within 0.1 mm of the exact equilibrium.
    let options = Options { resolution: Resolution::Accuracy(1e-4), ..Options::default() };
    let hair = equilibrium(&rod, &[], &options);

    println!("centre line (cm):");
    for point in hair.centre_line(11) {
        println!("  {:7.3} {:7.3} {:7.3}", 100.0 * point.x, 100.0 * point.y, 100.0 * point.z);
    }
    let certificate = hair.certificate;
    println!("elastic energy {:.3e} J, weight {:.3e} J", hair.energy.elastic, hair.energy.gravity);
    println!("{:?}, smallest eigenvalue {:?}", certificate.stability, certificate.min_eigenvalue);
    println!("relative gradient {:.1e}", certificate.gradient_norm);
    println!("{} elements, {} Newton steps", hair.elements, certificate.iterations);
    println!("estimated error {:.1e} m", hair.error_estimate.unwrap_or(f64::NAN));
    Ok(())
}
