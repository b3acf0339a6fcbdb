//! The guide of each wisp: where it is rooted, and the rod that it is.

use std::sync::Arc;

use frisure_rod::{InvalidQuantity, NaturalStrain, Rod, RodSpec, StrainProfile};
use glam::{DQuat, DVec3};

use crate::contact::{Bed, Layer, Thickness};
use crate::contact::{FrictionCoefficients, Pull};
use crate::fibre::{Curl, Handedness};
use crate::head::{Head, Region};
use crate::implantation::Root;
use crate::implantation::{self, Layout, Ways};
use crate::parallel;
use crate::random::{Purpose, Stream};
use crate::spec::HairstyleSpec;

/// A guide before it has come to rest.
#[derive(Clone, Debug)]
pub struct Guide {
    /// Where it is rooted.
    pub root: Root,
    /// Which part of the scalp that is.
    pub region: Region,
    /// The fibre, clamped at the root.
    pub rod: Rod,
    /// How thick its wisp is.
    pub thickness: Thickness,
    /// The hair beneath it, as the paper has it.
    pub layer: Layer,
    /// The hair beneath it, as the groom shows it that it comes from.
    pub bed: Option<Arc<Bed>>,
    /// What pulls at it, if it is being combed or is clipped.
    pub pull: Option<Pull>,
    /// How many times as hard as usual it presses on the skin for being held in a shape, which skin
    /// has to bear.
    pub(crate) firmness: f64,
    /// Force per length, in weights of the hair, with which the hair beneath holds it where it was combed.
    pub(crate) hold: DVec3,
    /// Friction of its hair, which is that of its wetness.
    pub friction: FrictionCoefficients,
    /// Mean natural strain (rad/m), about which it varies along the hair.
    pub(crate) curl: DVec3,
    /// Its planned length over that of the head; 1 where a region says the length.
    pub(crate) share: f64,
}

/// Standard deviation (rad) of the direction about the root tangent in which curls lean.
/// Chosen by eye; how follicles turn their curl is not known.
const ROLL: f64 = 0.4;

/// Plans the guides rooted at `roots` on a scalp of the weighted area `area` (m²).
///
/// # Errors
/// [`InvalidQuantity`], if length, curl or fibre cannot make a rod.
pub(crate) fn plan(
    spec: &HairstyleSpec,
    head: &Head,
    layout: &Layout,
    roots: &[Root],
    area: f64,
) -> Result<Vec<Guide>, InvalidQuantity> {
    let ways = Ways::new(spec, head, layout);
    parallel::try_map(roots.len(), |index| {
        let root = roots[index];
        let planned = fibre(spec, head, layout, &root, index)?;
        let hold = layout.held(&root) * spec.implantation.hold;
        Ok(Guide { hold, ..covered(spec, head, area, &ways, root, planned) })
    })
}

/// The guide of a fibre rooted somewhere, with the wisp about it and the hair beneath.
pub(crate) fn covered(
    spec: &HairstyleSpec,
    head: &Head,
    area: f64,
    ways: &Ways<'_>,
    root: Root,
    Planned { rod, curl, share }: Planned,
) -> Guide {
    let region = head.landmarks().region(root.position);
    let thickness = thickness(spec, area, &rod);
    let way = ways.over_hair(&root, rod.length());
    let layer = Layer::new(way, cover(spec, &thickness, &rod));
    let (bed, pull, firmness, hold) = (None, None, 1.0, DVec3::ZERO);
    let (skin, hair) = (spec.contact.skin_friction, spec.contact.friction);
    let friction = FrictionCoefficients {
        skin,
        hair,
        against_scales: spec.contact.scales,
        lock: spec.contact.lock_friction,
        ..FrictionCoefficients::default()
    };
    Guide { root, region, rod, thickness, layer, bed, pull, firmness, hold, friction, curl, share }
}

/// Least factor on the radii of wisps that counts: a wisp of a centimetre has ten nanometres. Chosen.
const LEAST_VOLUME: f64 = 1e-6;

/// The factor on the radii of wisps. What is thinner than the least touches nothing, and its square would leave the range of numbers.
fn volume(spec: &HairstyleSpec) -> f64 {
    let given = spec.contact.volume;
    if given < LEAST_VOLUME { 0.0 } else { given }
}

/// Cross-section of hair per area of skin, in the middle of a guide.
fn cover(spec: &HairstyleSpec, thickness: &Thickness, rod: &Rod) -> f64 {
    // ν A, docs/theory.md, "Hair against hair: layers and wisps".
    let taken = thickness.area_per_hair(0.5 * rod.length());
    volume(spec) * spec.implantation.density * taken
}

impl Guide {
    /// The guide with another rod in its place, its wisp as thick as that of the rod `dry` times what
    /// `packed` makes of that; `area` is that of the scalp (m²).
    pub(crate) fn with_rod(
        &self,
        spec: &HairstyleSpec,
        area: f64,
        rod: Rod,
        dry: &Rod,
        packed: impl FnOnce(&Thickness) -> f64,
    ) -> Self {
        let thickness = thickness(spec, area, dry);
        let packed = packed(&thickness);
        let slope = cover(spec, &thickness, dry);
        Self {
            rod,
            thickness: thickness.scaled(volume(spec) * packed),
            layer: self.layer.with_slope(slope).scaled(packed),
            ..self.clone()
        }
    }
}

/// The wisp about a guide. Hairs that stray from their wisp are those that do not share its curl:
/// the share of the spread between wisps that is found within one.
fn thickness(spec: &HairstyleSpec, scalp: f64, rod: &Rod) -> Thickness {
    let patch = scalp / spec.wisps.count as f64;
    let hairs = spec.implantation.density * patch;
    let spread = spec.wisps.fuzziness * spec.curl.variation_between;
    Thickness::new(rod, spec.curl.strain, hairs, patch, spread, volume(spec))
}

/// The fibre that a guide is.
pub(crate) struct Planned {
    pub(crate) rod: Rod,
    /// Mean natural strain (rad/m).
    pub(crate) curl: DVec3,
    /// Length over that of the head.
    pub(crate) share: f64,
}

fn fibre(
    spec: &HairstyleSpec,
    head: &Head,
    layout: &Layout,
    root: &Root,
    index: usize,
) -> Result<Planned, InvalidQuantity> {
    let mut random = Stream::new(spec.seed, Purpose::GuideFibre, index);
    let varied = random.factor(spec.length.variation_between);
    let (length, share) = match layout.length(head, root) {
        // Cut to a line: there it does not vary.
        Some(length) => (length + layout.spare(root), 1.0),
        None => (spec.length.mean * varied, varied),
    };
    let curl = mean_strain(&spec.curl, layout.curl(root), &mut random);
    // How many numbers it takes depends on the length, so it has a stream of its own: what else is drawn does not change with the length.
    let mut along = Stream::new(spec.seed, Purpose::CurlAlong, index);
    let natural = natural_strain(&spec.curl, curl, length, &mut along)?;
    let tangent = jittered(spec, head, layout, root, index);
    let strain = natural.at(0.0);
    let d1 = leaning(strain, tangent, layout.lean(root, tangent, strain), &mut random);
    // Drawn last: seeds keep their curls whatever the section does.
    let section = spec.fibre.of_wisp(&mut random)?;
    let rod = Rod::new(RodSpec {
        length,
        section,
        material: spec.fibre.material,
        torsion: spec.fibre.torsion,
        natural,
        root: frisure_rod::Root::from_tangent(root.position, tangent, d1)?,
        load: spec.load(&section),
    })?;
    Ok(Planned { rod, curl, share })
}

/// The root's direction, turned at random, but never into the skin.
fn jittered(
    spec: &HairstyleSpec,
    head: &Head,
    layout: &Layout,
    root: &Root,
    index: usize,
) -> DVec3 {
    let mut random = Stream::new(spec.seed, Purpose::GuideDirection, index);
    let mean = layout.direction(root);
    let axis = DVec3::new(random.normal(), random.normal(), random.normal());
    // Three independent components: jitter is the root mean square of the angle.
    let turn = DQuat::from_scaled_axis(axis * (spec.implantation.jitter / 3.0_f64.sqrt()));
    let turned = turn * mean;
    let outwards = turned.dot(root.normal);
    // Sine of the least angle to the skin, 3°. Chosen; hair that starts along the skin is soon in it.
    const LEAST: f64 = 0.05;
    let raised = turned + root.normal * (LEAST - outwards).max(0.0);
    implantation::clear_of_skin(head, root, raised.normalize_or(root.normal))
}

/// The director d1 at which the natural curl leans towards `lean`, give or take a roll.
///
/// A helix advances along `±(κ1 d1 + κ2 d2 + τ t)`. In which direction follicles turn their curl is
/// not known; one that started into the skin would come out of it within a turn, so it leans out.
fn leaning(strain: DVec3, tangent: DVec3, lean: DVec3, random: &mut Stream) -> DVec3 {
    let out = (lean - tangent * tangent.dot(lean))
        .try_normalize()
        .unwrap_or_else(|| tangent.any_orthonormal_vector());
    // Angle of the strain's bending part from d1, in the plane of d1 and d2.
    let phase = strain.y.atan2(strain.x);
    // The axis of a left-handed helix points the other way.
    let hand = if strain.z < 0.0 { std::f64::consts::PI } else { 0.0 };
    DQuat::from_axis_angle(tangent, ROLL * random.normal() + hand - phase) * out
}

/// How far the curl of a wisp is from the mean at most, in standard deviations.
/// Chosen: a wisp is the mean of hundreds of hairs.
const ODDEST: f64 = 1.6;

/// The mean natural strain of one guide (rad/m): the head's, varied between guides.
fn mean_strain(curl: &Curl, factor: f64, random: &mut Stream) -> DVec3 {
    // A wisp is the mean of hundreds of hairs: it is no freak.
    let off = random.normal().clamp(-ODDEST, ODDEST);
    let mut mean = curl.strain * (factor * (curl.variation_between * off).exp());
    if curl.handedness == Handedness::Random && random.unit() < 0.5 {
        mean.z = -mean.z;
    }
    mean
}

/// The natural strain of one guide: its mean, varied along the hair.
fn natural_strain(
    curl: &Curl,
    mean: DVec3,
    length: f64,
    random: &mut Stream,
) -> Result<NaturalStrain, InvalidQuantity> {
    if curl.variation_along == 0.0 || mean == DVec3::ZERO {
        return Ok(NaturalStrain::Uniform(mean));
    }
    // Half a correlation length, over which the process keeps 0.6 of its value; at most 500 knots. Chosen.
    let step = (0.5 * curl.variation_scale).max(length / 500.0);
    let first = [curl.variation_along * random.normal(), curl.variation_along * random.normal()];
    let knots = Wander { curl, mean, step, at: 0.0, off: first }.knots(length, random);
    Ok(NaturalStrain::Varying(StrainProfile::new(knots)?))
}

/// The natural strain of a planned guide that has grown to a length (m): the hair that it was
/// planned with, and beyond it hair that varies as that does.
pub(crate) fn grown_strain(
    spec: &HairstyleSpec,
    guide: &Guide,
    index: usize,
    length: f64,
) -> Result<NaturalStrain, InvalidQuantity> {
    let planned = guide.rod.natural();
    let NaturalStrain::Varying(profile) = planned else { return Ok(planned.clone()) };
    let mut knots = profile.knots().to_vec();
    let Some(&(at, strain)) = knots.last() else { return Ok(planned.clone()) };
    if at >= length {
        return Ok(planned.clone());
    }
    let step = knots.get(1).map_or(0.5 * spec.curl.variation_scale, |second| second.0);
    // The state of the process at the last knot, read back from the strain there, so that it goes on without a jump.
    let off = |x: f64, mean: f64| if mean == 0.0 { 0.0 } else { x / mean - 1.0 };
    let mean = guide.curl;
    let bend = if mean.x == 0.0 { off(strain.y, mean.y) } else { off(strain.x, mean.x) };
    let off = [bend, off(strain.z, mean.z)];
    let mut random = Stream::new(spec.seed, Purpose::GrownCurl, index);
    let more = Wander { curl: &spec.curl, mean, step, at, off }.knots(length, &mut random);
    knots.extend(more.into_iter().skip(1));
    Ok(NaturalStrain::Varying(StrainProfile::new(knots)?))
}

/// An Ornstein–Uhlenbeck process in arc length: strain that is correlated over `variation_scale`.
struct Wander<'a> {
    curl: &'a Curl,
    mean: DVec3,
    /// Distance of knots (m).
    step: f64,
    /// Where it begins (m) …
    at: f64,
    /// … and how far bending and twist are off their mean there, relative to it.
    off: [f64; 2],
}

impl Wander<'_> {
    /// Arc lengths (m) and strains, from where it begins to `length` (m) or a little beyond.
    fn knots(self, length: f64, random: &mut Stream) -> Vec<(f64, DVec3)> {
        let Self { curl, mean, step, at, off: [mut bend, mut twist] } = self;
        // x(s + Δs) = k x + σ √(1 − k²) N(0, 1) with k = e^(−Δs/ℓ): exact for any step, and stationary with deviation σ.
        let keep = (-step / curl.variation_scale).exp();
        let fresh = curl.variation_along * (1.0 - keep * keep).sqrt();
        let count = ((length - at) / step).ceil() as usize + 1;
        (0..count)
            .map(|i| {
                let factor = DVec3::new(1.0 + bend, 1.0 + bend, 1.0 + twist);
                bend = keep * bend + fresh * random.normal();
                twist = keep * twist + fresh * random.normal();
                (at + i as f64 * step, mean * factor)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::mannequin;
    use crate::presets::preset;
    use crate::spec::{Place, RegionLength, RegionStyle};

    #[test]
    fn a_guide_that_is_longer_by_a_picometre_is_the_same_fibre() {
        let mut spec = preset("caucasian-straight").unwrap().spec();
        // One more knot of the strain just where it becomes longer.
        let knot = 0.5 * spec.curl.variation_scale;
        let mut planned = |length: f64| {
            let region = RegionStyle {
                places: vec![Place::Everywhere],
                length: Some(RegionLength::Mean(length)),
                ..RegionStyle::default()
            };
            spec.regions = vec![region];
            let layout = Layout::new(&spec, mannequin()).unwrap();
            let position = mannequin().landmarks().whorl;
            let (_, normal) = mannequin().signed_distance().value_gradient(position);
            fibre(&spec, mannequin(), &layout, &Root { position, normal }, 3).unwrap().rod
        };
        // As long as the region says, to the last bit.
        assert_eq!(planned(0.002).length(), 0.002);
        let [shorter, longer] = [-1e-12, 1e-12].map(|more| planned(4.0 * knot + more));
        let knots = |rod: &Rod| match rod.natural() {
            NaturalStrain::Varying(profile) => profile.knots().to_vec(),
            NaturalStrain::Uniform(_) => Vec::new(),
        };
        let (few, more) = (knots(&shorter), knots(&longer));
        assert_eq!(more.len(), few.len() + 1);
        assert_eq!(few, more[..few.len()]);
        assert_eq!(shorter.spec().section, longer.spec().section);
        assert_eq!(shorter.root(), longer.root());
    }

    #[test]
    fn curls_lean_out_of_the_skin() {
        let mut random = Stream::new(1, Purpose::GuideFibre, 0);
        let (tangent, normal) = (DVec3::new(0.8, 0.0, 0.6), DVec3::Z);
        for strain in [DVec3::new(80.0, 0.0, 30.0), DVec3::new(30.0, 70.0, -20.0)] {
            let mut outwards = 0.0;
            for _ in 0..400 {
                let d1 = leaning(strain, tangent, normal, &mut random);
                let d2 = tangent.cross(d1);
                let axis = d1 * strain.x + d2 * strain.y + tangent * strain.z;
                outwards += axis.dot(normal) * strain.z.signum() / 400.0;
            }
            assert!(outwards > 0.3 * strain.length(), "{outwards}");
        }
    }
}
