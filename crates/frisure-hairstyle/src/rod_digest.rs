//! Parts of a rod as fields of a digest.

use frisure_digest::Digest;
use frisure_rod::{ElementKind, Material, Resolution, Section, TorsionConstant};

pub(crate) fn add_section(digest: &mut Digest, section: &Section) {
    digest.field("semi-axes", &[section.a(), section.b()]);
}

pub(crate) fn add_material(digest: &mut Digest, material: &Material) {
    let moduli = [material.youngs_modulus(), material.shear_modulus(), material.density()];
    digest.field("moduli, density", &moduli);
}

pub(crate) fn add_torsion(digest: &mut Digest, torsion: &TorsionConstant) {
    let name = match torsion {
        TorsionConstant::SaintVenant => "Saint-Venant",
        TorsionConstant::Polar => "polar",
    };
    digest.field("torsion", name);
}

pub(crate) fn add_resolution(digest: &mut Digest, resolution: &Resolution) {
    match resolution {
        Resolution::Elements(n) => digest.field("elements", n),
        Resolution::Accuracy(accuracy) => digest.field("accuracy", accuracy),
    };
}

pub(crate) fn add_element(digest: &mut Digest, element: &ElementKind) {
    let name = match element {
        ElementKind::Auto => "auto",
        ElementKind::Jointed => "jointed",
        ElementKind::Helix => "helix",
    };
    digest.field("element", name);
}
