//! The rod that a drawn hair is.

use frisure_rod::{InvalidQuantity, NaturalStrain, Rod, RodSpec, StrainProfile};
use glam::{DMat3, DQuat, DVec3};

use crate::random::{Purpose, Stream};
use crate::strands::binding::StrandBinding;
use crate::strands::population::Population;
use crate::strands::skin::below;

/// Shortest hair (m) that is a rod. Shorter than any cut leaves. Chosen.
const SHORTEST: f64 = 1e-3;

/// How far a hair's curl is from its guide's at most, in standard deviations of its logarithm.
/// Chosen: no hair is an outlier.
const ODDEST: f64 = 2.5;

/// The rod of a hair; none if it is too short for one.
///
/// It is of its guide's material, as wet, and has its guide's natural strain but for what hairs of a wisp do not
/// share: the fraction `fuzziness` of what differs between wisps. Its section is drawn as those of guides are.
pub(super) fn rod(
    population: &Population<'_>,
    binding: &StrandBinding<'_>,
    index: usize,
) -> Option<Rod> {
    let length = binding.end * binding.length;
    (length >= SHORTEST).then(|| fibre(population, binding, index, length).ok()).flatten()
}

fn fibre(
    population: &Population<'_>,
    binding: &StrandBinding<'_>,
    index: usize,
    length: f64,
) -> Result<Rod, InvalidQuantity> {
    let spec = population.spec;
    let mut random = Stream::new(spec.seed, Purpose::HairFibre, index);
    let guide = &population.guides[binding.main()].rod;
    let dry = &population.planned[binding.main()].rod;
    // The guide as it is now over the guide as planned: what water makes of its section applies to every hair.
    let swollen = guide.spec().section.mean_radius() / dry.spec().section.mean_radius();
    let section = spec.fibre.varied(&mut random)?.scaled(swollen * binding.thickness)?;
    let own = spec.wisps.fuzziness;
    let off = random.normal().clamp(-ODDEST, ODDEST);
    // Log-normal, as between guides, with a standard deviation `fuzziness` times theirs.
    let factor = (own * spec.curl.variation_between * off).exp();
    let along = own * spec.curl.variation_along;
    let natural = match guide.natural() {
        NaturalStrain::Uniform(strain) if along == 0.0 => NaturalStrain::Uniform(*strain * factor),
        shared => {
            let mut wander = Wander { along, scale: spec.curl.variation_scale, at: None };
            let knots = places(shared, length, spec.curl.variation_scale);
            let knot = |s: f64| (s, shared.at(s) * (factor * wander.at(s, &mut random)));
            NaturalStrain::Varying(StrainProfile::new(knots.map(knot).collect())?)
        }
    };
    Rod::new(RodSpec {
        length,
        section,
        natural,
        root: root(population, binding)?,
        ..guide.spec().clone()
    })
}

/// The clamp of a hair: in its own follicle, in the direction of the guides that it follows.
fn root(
    population: &Population<'_>,
    binding: &StrandBinding<'_>,
) -> Result<frisure_rod::Root, InvalidQuantity> {
    let frame = |guide: usize| population.guides[guide].rod.root().frame();
    let mean: DVec3 = binding.followed.iter().map(|&(g, w)| frame(g).z_axis * w).sum();
    let own = frame(binding.main());
    let tangent = mean.normalize_or(own.z_axis);
    let turn = DQuat::from_rotation_arc(own.z_axis, tangent);
    let d1 = (DMat3::from_quat(turn) * own).x_axis;
    frisure_rod::Root::from_tangent(below(&binding.root, tangent), tangent, d1)
}

/// Where (m) the natural strain of a hair is given: where its guide's is, and beyond that as far apart.
fn places(shared: &NaturalStrain, length: f64, scale: f64) -> impl Iterator<Item = f64> {
    let known: Vec<f64> = match shared {
        NaturalStrain::Uniform(_) => vec![0.0],
        NaturalStrain::Varying(profile) => profile.knots().iter().map(|knot| knot.0).collect(),
    };
    let last = known.last().copied().unwrap_or(0.0);
    // Half a correlation length, over which the process keeps 0.6 of its value; at most 500 knots. Chosen.
    let step = (0.5 * scale).max(length / 500.0);
    let more = ((length - last) / step).ceil().max(0.0) as usize;
    known.into_iter().chain((1..=more).map(move |k| last + k as f64 * step))
}

/// What the strain of a hair is over that of its guide: an Ornstein–Uhlenbeck process in arc length, as along guides.
struct Wander {
    /// Standard deviation.
    along: f64,
    /// Correlation length (m).
    scale: f64,
    /// Arc length (m) that it has come to, and how far it is off there.
    at: Option<(f64, f64)>,
}

impl Wander {
    /// The factor at the next arc length (m).
    fn at(&mut self, s: f64, random: &mut Stream) -> f64 {
        let Self { along, scale, at } = self;
        // x(s) = e^(−Δs/ℓ) x + σ √(1 − e^(−2Δs/ℓ)) N(0, 1): the exact step of the process, of any length. It is stationary,
        // so that the first value is drawn from N(0, σ²).
        let keep = at.map_or(0.0, |(before, _)| (-(s - before) / *scale).exp());
        let off = at.map_or(0.0, |(_, off)| off);
        let off = keep * off + *along * (1.0 - keep * keep).sqrt() * random.normal();
        *at = Some((s, off));
        1.0 + off
    }
}
