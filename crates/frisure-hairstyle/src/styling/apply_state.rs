//! The guide that a wisp has now: the planned one, cut or grown, wet, set and held.

use std::f64::consts::TAU;

use frisure_rod::{InvalidQuantity, Material, NaturalStrain, Rod, RodSpec, StrainProfile};
use glam::DVec3;

use crate::contact::{Pull, Thickness};
use crate::guides::{Guide, grown_strain};
use crate::hairstyle::{Fastener, Grip, Mould, Styling};
use crate::product::Applied;
use crate::spec::HairstyleSpec;
use crate::styling::wet_law::{WetFactors, stretched, wetted};

/// How many times as stiff hair is for being held in a shape, and how many times as firm the skin under it. Chosen by trial;
/// not measured further.
const MOULD: f64 = 10.0;

/// Knots of a braid's strain per pitch. Chosen by trial; not measured further.
const BRAID_KNOTS: f64 = 16.0;

/// Most knots of a braid's strain. A guard on memory.
const MOST_BRAID_KNOTS: f64 = 2000.0;

/// Force (in EI/L³) that bends a hair as a comb does. Chosen by trial; not measured further.
const BENDING: f64 = 20.0;

/// The way of hair over the head from its root to a comb, over the straight one; and the smallest share of a hair that a comb takes, however near
/// to the root it stops. Chosen.
const COMBED_WAY: f64 = 1.1;
const LEAST_COMBED: f64 = 0.25;

/// Stiffness (Pa) with which a clip holds a piece of hair, and the length (m) of the piece.
/// Chosen by trial; not measured further.
const CLIP: (f64, f64) = (20.0, 0.012);

/// Shortest hair (m) that a clip bends; it pulls at stubble no harder. Chosen by trial; not measured further.
const CLIPPABLE: f64 = 0.1;

/// Acceleration of gravity on Earth (m/s²), by which hands are as strong as they are.
const EARTH: f64 = 9.81;

/// Share of EI κ² (κ the natural curvature) with which [`CLIPPED`] times as much draws a curl straight: three times EI κ², under which its
/// ends turn by 0.6 rad. Chosen.
const UNCURLING: f64 = 0.1;

/// Most that a clip pulls, as a multiple of what it takes to bend the hair or to carry it. Chosen by trial; not measured
/// further.
const CLIPPED: f64 = 30.0;

/// The guide of the wisp `index` as styling has made it; `area` is that of the scalp (m²).
pub(super) fn guide(
    spec: &HairstyleSpec,
    area: f64,
    index: usize,
    styling: &Styling,
) -> Result<Guide, InvalidQuantity> {
    let (planned, state) = (&styling.planned[index], &styling.wisps[index]);
    let factors = WetFactors::new(&spec.wetting, state, styling.humidity);
    // In the order of docs/theory.md, "Styling". 1. Grown: the planned strain goes on beyond the planned length.
    let grown = grown_strain(spec, planned, index, state.length)?;
    let base = planned.rod.spec();
    let dry = Rod::new(RodSpec { length: state.length, natural: grown.clone(), ..base.clone() })?;
    // 2. Set: u⁰ ← u⁰ + k (u_h − u⁰) for each shape in which hair was dried. 3. Wet. (W1) to (W3)
    let natural = stretched(&state.with_sets(grown)?, factors.length)?;
    let rod = wetted(&dry, natural, &factors)?;
    // 4. Held in a shape. The thickness of the wisp stays that of the dry hair, times what water makes of it.
    let wet = rod.clone();
    let packed = |dry: &Thickness| match state.coalescence(spec, &wet, dry) {
        Some(water) => water.closeness(dry.area_per_hair(0.5 * state.length)),
        None => factors.wisp,
    };
    let packed = |dry: &Thickness| packed(dry) * state.product.map_or(1.0, Applied::wisp);
    let rod = match state.grip {
        Some(Grip::Mould { mould, .. }) => held(rod, mould)?,
        _ => rod,
    };
    let mut guide = planned.with_rod(spec, area, rod, &dry, packed);
    guide.pull = pull(&guide.rod, state.grip);
    let wetter = 1.0 + state.wetness * (spec.contact.wet_friction - 1.0);
    let smoother = state.product.map_or(1.0, Applied::friction);
    guide.friction = planned.friction.scaled(wetter * smoother);
    let diameter = 2.0 * guide.rod.spec().section.mean_radius();
    guide.friction.cohesion = state.product.map_or(0.0, |product| product.cohesion(diameter));
    let in_wisp = state.product.map_or(0.0, |product| product.cohesion_in_wisp(diameter));
    guide.friction.lock_cohesion = in_wisp;
    // What a hand or a clip holds needs no friction, which would pull it elsewhere.
    guide.hold = if state.grip.is_some() { DVec3::ZERO } else { planned.hold };
    // What is drawn tight over the head presses on skin as what is held in a shape does.
    guide.firmness = if state.grip.is_some_and(Grip::presses) { MOULD } else { 1.0 };
    Ok(guide)
}

/// The rod in what moulds it: stiff in that shape.
fn held(rod: Rod, mould: Mould) -> Result<Rod, InvalidQuantity> {
    let natural = match mould {
        Mould::Straight => NaturalStrain::STRAIGHT,
        Mould::Roller { radius, pitch } | Mould::Twist { radius, pitch } => {
            NaturalStrain::helix(radius, pitch)?
        }
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
    // Second derivatives of the two displacements: the curvatures of a line that hardly leaves its axis.
    let (across, over) = (width / 4.0 * wave.powi(2), width / 12.0 * (2.0 * wave).powi(2));
    let step = (pitch / BRAID_KNOTS).max(length / MOST_BRAID_KNOTS);
    let count = (length / step).ceil() as usize + 1;
    let knots = (0..count).map(|i| {
        let s = i as f64 * step;
        (s, DVec3::new(across * (wave * s).cos(), over * (2.0 * wave * s).cos(), 0.0))
    });
    Ok(NaturalStrain::Varying(StrainProfile::new(knots.collect())?))
}

/// Force per length (N/m) that bends a rod of at least `shortest` (m) or carries it, whichever is more.
fn effort(rod: &Rod, shortest: f64) -> f64 {
    // EI/L³ is the force per length that bends a clamped rod by an eighth of its length.
    let length = rod.length().max(shortest);
    let bending = BENDING * rod.stiffness().truncate().min_element() / length.powi(3);
    rod.weight().max(bending)
}

/// The same of a hand that gathers hair into a clip: it also draws curls straight, and carries hair as on Earth wherever the head is.
fn hand_effort(rod: &Rod) -> f64 {
    // Under a force F a rod of the curvature κ is straight but for a length √(EI/F) at its ends, over which it turns by κ √(EI/F).
    let bend = rod.natural().mean(0.0, rod.length()).truncate().length_squared();
    let straight = UNCURLING * rod.stiffness().truncate().min_element() * bend / rod.length();
    let weight = rod.mass() / rod.length() * EARTH;
    effort(rod, CLIPPABLE).max(weight).max(straight)
}

/// What pulls at a rod that is gripped.
pub(super) fn pull(rod: &Rod, grip: Option<Grip>) -> Option<Pull> {
    match grip? {
        Grip::Comb { direction, strength, until } => {
            let force = direction * (strength * effort(rod, 0.0));
            Some(match until {
                None => Pull::Comb { force, until: f64::INFINITY },
                Some(comb) => {
                    // As hard as it pulls at the whole hair, on the piece from the root to the comb.
                    let piece = COMBED_WAY * comb.distance(rod.root().position());
                    let until = piece.clamp(LEAST_COMBED * rod.length(), rod.length());
                    Pull::Comb { force: force * (rod.length() / until), until }
                }
            })
        }
        Grip::Clip { at, to: point, by } => {
            let long = CLIP.1.min(rod.length());
            let (before, way) = match by {
                // A tie turns hair into its axis, whichever side of the head it comes from, so that all of a tail hangs together.
                Fastener::Tie { axis, .. } => (0.0, axis),
                Fastener::Clip | Fastener::Pin { .. } => (0.5 * long, DVec3::ZERO),
            };
            // The whole piece stays on the hair, however near to an end it is held.
            let from = (at * rod.length() - before).clamp(0.0, rod.length() - long);
            // A force per length of the piece that adds up to one on the whole hair.
            let most = CLIPPED * hand_effort(rod) * rod.length() / long;
            Some(Pull::Clip { piece: [from, from + long], point, way, stiffness: CLIP.0, most })
        }
        Grip::Braid { at, path } => {
            let from = (at * rod.length()).min(rod.length());
            let piece = [from, (from + path.reach()).min(rod.length())];
            // As hard on each length as a clip pulls at the piece that it holds.
            let most = CLIPPED * hand_effort(rod) * rod.length() / CLIP.1;
            Some(Pull::Braid { path, piece, stiffness: CLIP.0, most })
        }
        Grip::Mould { tension, .. } => {
            let force = -rod.up() * (tension * rod.weight());
            (tension > 0.0).then_some(Pull::Comb { force, until: f64::INFINITY })
        }
    }
}
