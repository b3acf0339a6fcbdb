//! The wet law: what water, and the humidity of the air, make of a fibre and of its wisp.
//!
//! Wet hair is softer (both moduli fall), swollen (the diameter grows), a little longer and heavier, and a film of water
//! draws the hairs of a wisp together. The factors in water are [`Wetting`]'s; what air of some relative humidity does is
//! a measured share of them ([`Moisture`]). docs/theory.md, "Styling", *Wet*, (W1) to (W3); \[paper\] §3.2.1.
//!
//! The operations that change wetness and humidity are in `operations/wet.rs`, `operations/dry.rs` and
//! `operations/humidity.rs`.

use frisure_rod::{InvalidQuantity, Material, NaturalStrain, Rod, RodSpec, StrainProfile};

use crate::fibre::Wetting;
use crate::hairstyle::WispState;
use crate::presets::Moisture;

/// What water makes of a wisp and its fibres: factors on their properties, exactly 1 in room-dry hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WetFactors {
    youngs_modulus: f64,
    shear_modulus: f64,
    diameter: f64,
    pub(super) length: f64,
    mass: f64,
    /// On the radius of the wisp and on the distances that contact keeps.
    pub(super) wisp: f64,
}

impl WetFactors {
    /// The factors of a wisp in air of a relative humidity. \[paper\] §3.2.1
    pub(super) fn new(wetting: &Wetting, state: &WispState, humidity: f64) -> Self {
        let (air, wet, measured) = (Moisture::in_air(humidity), state.wetness, Wetting::MEASURED);
        // (W1): d = 1 + a (f_measured − 1) in air, d + w (f − d) at the wetness w. Air is what it is measured to be, whatever
        // factor f water is taken to have.
        let factor = |share: f64, of: fn(&Wetting) -> f64| {
            let dry = 1.0 + share * (of(&measured) - 1.0);
            dry + wet * (of(wetting) - dry)
        };
        Self {
            youngs_modulus: factor(air.softening, |w| w.youngs_modulus),
            shear_modulus: factor(air.shear_softening, |w| w.shear_modulus),
            diameter: factor(air.swelling, |w| w.diameter),
            length: factor(air.elongation, |w| w.length),
            // The water that the wisp holds, as a share of the mass of its dry hair.
            mass: 1.0 + state.water * wet,
            // What draws hairs together is a film of water, which damp air does not leave.
            wisp: factor(0.0, |w| w.wisp),
        }
    }
}

/// The natural strain of hair that water has made longer by a factor: as much turn in more length. (W2)
pub(super) fn stretched(
    natural: &NaturalStrain,
    factor: f64,
) -> Result<NaturalStrain, InvalidQuantity> {
    Ok(match natural {
        NaturalStrain::Uniform(strain) => NaturalStrain::Uniform(*strain / factor),
        NaturalStrain::Varying(profile) => {
            let knots = profile.knots().iter().map(|&(s, strain)| (s * factor, strain / factor));
            NaturalStrain::Varying(StrainProfile::new(knots.collect())?)
        }
    })
}

/// The rod of a dry fibre in water: softer, swollen, longer and heavier, with the natural strain `natural`. (W3)
///
/// # Errors
/// [`InvalidQuantity`], if the factors make no rod.
pub(super) fn wetted(
    dry: &Rod,
    natural: NaturalStrain,
    by: &WetFactors,
) -> Result<Rod, InvalidQuantity> {
    let spec = dry.spec();
    let material = spec.material;
    // Swollen hair weighs what it did, and the water in it: mass over volume, d² λ times the dry one.
    let volume = by.diameter * by.diameter * by.length;
    Rod::new(RodSpec {
        length: spec.length * by.length,
        section: spec.section.scaled(by.diameter)?,
        material: Material::new(
            material.youngs_modulus() * by.youngs_modulus,
            material.shear_modulus() * by.shear_modulus,
            material.density() * (by.mass / volume),
        )?,
        natural,
        ..spec.clone()
    })
}
