//! The guide that a wisp has now: the planned one, cut or grown, wet, set and held.

use std::f64::consts::TAU;

use frisure_rod::{InvalidQuantity, Material, NaturalStrain, Rod, RodSpec, StrainProfile};
use glam::DVec3;

use crate::contact::Pull;
use crate::fibre::Wetting;
use crate::guides::{Guide, grown_strain};
use crate::hairstyle::{Grip, Mould, Styling, WispState};
use crate::presets::Moisture;
use crate::spec::HairstyleSpec;

/// How much stiffer hair is for being held in a shape. Chosen by trial; not measured further.
const MOULD: f64 = 10.0;

/// Knots of a braid's strain per pitch. Chosen by trial; not measured further.
const BRAID_KNOTS: f64 = 16.0;

/// Force (in EI/L³) that bends a hair as a comb does. Chosen by trial; not measured further.
const BENDING: f64 = 20.0;

/// Stiffness (Pa) with which a clip holds a piece of hair, and the length (m) of the piece.
/// Chosen by trial; not measured further.
const CLIP: (f64, f64) = (20.0, 0.012);

/// Shortest hair (m) that a clip bends; it pulls at stubble no harder. Chosen by trial; not measured further.
const CLIPPABLE: f64 = 0.1;

/// Most that a clip pulls (in what it takes to bend the hair or to carry it). Chosen by trial; not measured further.
const CLIPPED: f64 = 30.0;

/// What water does to a wisp: factors, exactly 1 in room-dry hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factors {
    youngs_modulus: f64,
    shear_modulus: f64,
    diameter: f64,
    pub(super) length: f64,
    mass: f64,
    wisp: f64,
}

impl Factors {
    /// Of a wisp in air of a relative humidity. \[paper\] §3.2.1
    pub(super) fn new(wetting: &Wetting, state: &WispState, humidity: f64) -> Self {
        let (air, wet, measured) = (Moisture::in_air(humidity), state.wetness, Wetting::MEASURED);
        // Air is what it is measured to be, whatever water is taken to do; wetness is between them.
        let factor = |share: f64, of: fn(&Wetting) -> f64| {
            let dry = 1.0 + share * (of(&measured) - 1.0);
            dry + wet * (of(wetting) - dry)
        };
        Self {
            youngs_modulus: factor(air.softening, |w| w.youngs_modulus),
            shear_modulus: factor(air.shear_softening, |w| w.shear_modulus),
            diameter: factor(air.swelling, |w| w.diameter),
            length: factor(air.elongation, |w| w.length),
            mass: 1.0 + state.water * wet,
            // What draws hairs together is a film of water, which damp air does not leave.
            wisp: factor(0.0, |w| w.wisp),
        }
    }
}

/// The guide of the wisp `index` as styling has made it; `area` is that of the scalp (m²).
pub(super) fn guide(
    spec: &HairstyleSpec,
    area: f64,
    index: usize,
    styling: &Styling,
) -> Result<Guide, InvalidQuantity> {
    let (planned, state) = (&styling.planned[index], &styling.wisps[index]);
    let factors = Factors::new(&spec.wetting, state, styling.humidity);
    let grown = grown_strain(spec, planned, index, state.length)?;
    let base = planned.rod.spec();
    let dry = Rod::new(RodSpec { length: state.length, natural: grown.clone(), ..base.clone() })?;
    let natural = stretched(&state.with_sets(grown)?, factors.length)?;
    let rod = wetted(&dry, natural, &factors)?;
    let rod = match state.grip {
        Some(Grip::Mould { mould, .. }) => held(rod, mould)?,
        _ => rod,
    };
    let mut guide = planned.with_rod(spec, area, rod, &dry, factors.wisp);
    guide.pull = pull(&guide.rod, state.grip);
    guide.firmness = if state.grip.is_some_and(Grip::moulds) { MOULD } else { 1.0 };
    Ok(guide)
}

/// The strain of hair that has become longer by a factor: as much turn in more length.
fn stretched(natural: &NaturalStrain, factor: f64) -> Result<NaturalStrain, InvalidQuantity> {
    Ok(match natural {
        NaturalStrain::Uniform(strain) => NaturalStrain::Uniform(*strain / factor),
        NaturalStrain::Varying(profile) => {
            let knots = profile.knots().iter().map(|&(s, strain)| (s * factor, strain / factor));
            NaturalStrain::Varying(StrainProfile::new(knots.collect())?)
        }
    })
}

fn wetted(dry: &Rod, natural: NaturalStrain, by: &Factors) -> Result<Rod, InvalidQuantity> {
    let spec = dry.spec();
    let material = spec.material;
    // Swollen hair weighs what it did, and the water in it.
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

/// The rod in what moulds it: stiff in that shape.
fn held(rod: Rod, mould: Mould) -> Result<Rod, InvalidQuantity> {
    let natural = match mould {
        Mould::Straight => NaturalStrain::STRAIGHT,
        Mould::Helix { radius, pitch } => NaturalStrain::helix(radius, pitch)?,
        Mould::Braid { width, pitch } => braid(width, pitch, rod.length())?,
    };
    let material = rod.spec().material;
    let material = Material::new(
        material.youngs_modulus() * MOULD,
        material.shear_modulus() * MOULD,
        material.density(),
    )?;
    Rod::new(RodSpec { natural, material, ..rod.spec().clone() })
}

/// The strain of a part of a braid of three, half as wide as the braid and a third as thick: in each
/// pitch P it goes once to and fro across the braid and twice over and under the others, along about
/// `¼ w cos(2πs/P)` and `w/12 cos(4πs/P)`.
fn braid(width: f64, pitch: f64, length: f64) -> Result<NaturalStrain, InvalidQuantity> {
    let wave = TAU / pitch;
    let (across, over) = (width / 4.0 * wave.powi(2), width / 12.0 * (2.0 * wave).powi(2));
    let step = (pitch / BRAID_KNOTS).max(length / 2000.0);
    let count = (length / step).ceil() as usize + 1;
    let knots = (0..count).map(|i| {
        let s = i as f64 * step;
        (s, DVec3::new(across * (wave * s).cos(), over * (2.0 * wave * s).cos(), 0.0))
    });
    Ok(NaturalStrain::Varying(StrainProfile::new(knots.collect())?))
}

/// Force per length (N/m) that bends a rod of at least `shortest` (m) or carries it, whichever is more.
fn effort(rod: &Rod, shortest: f64) -> f64 {
    let length = rod.length().max(shortest);
    let bending = BENDING * rod.stiffness().truncate().min_element() / length.powi(3);
    rod.weight().max(bending)
}

/// What pulls at a rod that is gripped.
pub(super) fn pull(rod: &Rod, grip: Option<Grip>) -> Option<Pull> {
    match grip? {
        Grip::Comb { direction, strength } => {
            Some(Pull::Comb { force: direction * (strength * effort(rod, 0.0)) })
        }
        Grip::Clip { at, to: point } => {
            let middle = at * rod.length();
            let half = 0.5 * CLIP.1.min(rod.length());
            let middle = middle.clamp(half, rod.length() - half);
            let piece = [middle - half, middle + half];
            let most = CLIPPED * effort(rod, CLIPPABLE) * rod.length() / (2.0 * half);
            Some(Pull::Clip { piece, point, stiffness: CLIP.0, most })
        }
        Grip::Mould { tension, .. } => {
            (tension > 0.0).then(|| Pull::Comb { force: DVec3::NEG_Z * (tension * rod.weight()) })
        }
    }
}
