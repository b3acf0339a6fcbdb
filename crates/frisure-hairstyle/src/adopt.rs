//! Hair of another program made into hair with physics: the groom hangs as it was modelled, and can then be
//! wetted, cut and grown like any other.

use std::borrow::Cow;
use std::sync::{Arc, Mutex};

use frisure_rod::inverse::{Balance, FittedCurve, InverseSolution};
use frisure_rod::potential::FieldPotential;
use frisure_rod::{Equilibrium, InvalidQuantity, NaturalStrain, Rod, RodSpec, Root as Clamp};
use frisure_strands::{Strand, Strands};
use glam::DVec3;

use crate::contact::{Bed, BodyContact, CombedHold};
use crate::equilibrium::{
    Effort, GuideStart, SettleOptions, combed_hold, held_up, holding, settle,
};
use crate::guides::{Guide, Planned, covered};
use crate::hairstyle::Hairstyle;
use crate::hairstyle::RootPlacement;
use crate::hairstyle::Styling;
use crate::head::Head;
use crate::implantation::{Layout, Ways, out_of_face};
use crate::implantation::{Root, Scalp};
use crate::math::Grid;
use crate::parallel;
use crate::predict::PredictError;
use crate::random::{Purpose, Stream};
use crate::spec::{Body, HairContact, Hairs, HairstyleSpec, Implantation};
use crate::wisps::Wisp;
use crate::wisps::{BoundStrands, WISP_SAMPLES};
use frisure_progress::{Progress, StageCounter};

/// How well a groom was adopted; one entry for each of its guides, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Adoption {
    /// Largest distance (m) of the guide at rest from the groom's, point for point.
    pub distances: Vec<f64>,
    /// Factor on the fibre's stiffness from which on the groom's shape would be stable; 1 where it is.
    pub stiffness_needed: Vec<f64>,
    /// How many strands of the groom were left out for having no length.
    pub left_out: usize,
    /// How many guides the groom has in the head, deeper than 5 mm; they come out of it.
    pub inside: usize,
    /// How many guides are rooted more than 1 cm from the skin; they stay there.
    pub off_skin: usize,
    /// At how many times the groom is known, of which the first was adopted; 0 or 1 of a groom that does not move.
    pub times: usize,
}

/// The hairstyle of a groom: each strand of `guides` (m) becomes a guide whose natural strain is the one with which
/// it hangs so (see [`frisure_rod::inverse`]). Fibre, contact with the body, drawn hairs and everything else are those
/// of `spec`; its length and curl count for nothing. Where the groom has `hairs`, these are drawn, each in its own
/// shape as long as its guides are in theirs; otherwise as many as `spec` says, where the guides are.
///
/// A groom says nothing of the hair that each strand lies on. Within 4 cm of the skin something may lie beneath it; it
/// bears so much that the strand needs the least bending ([`FittedCurve::least_support`]), and stays as high as the groom
/// has it ([`Bed`]), however the hair is styled. Strands that go out of the face may be held there as combed hair is
/// ([`crate::Implantation::hold`]), if that takes less bending. Between each other strands do not push. What was modelled into the
/// head is held as if it were not there, and comes out of it. Strands without length are left out.
///
/// # Errors
/// [`PredictError`], if the description is out of range, a strand has no length, there is none, or the progress says
/// to stop.
pub fn adopt(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &Strands,
    hairs: &Strands,
    progress: &dyn Progress,
) -> Result<(Hairstyle, Adoption), PredictError> {
    let (guides, hairs) = (with_length(guides), with_length(hairs));
    // The same strands may be both.
    let left_out = guides.1.max(hairs.1);
    let (guides, hairs) = (&*guides.0, &*hairs.0);
    let mut spec = spec.clone();
    spec.wisps.count = guides.len();
    spec.contact.hair = HairContact::None;
    if !hairs.is_empty() {
        spec.wisps.hairs = Hairs::Count(hairs.len());
    }
    spec.check()?;
    let lines: Vec<Vec<DVec3>> =
        guides.iter().map(|s| s.points.iter().map(|p| p.as_dvec3()).collect()).collect();
    let stage = StageCounter::new(progress, "finding fibres", lines.len());
    let held = parallel::try_map(lines.len(), |index| -> Result<Held, PredictError> {
        stage.check()?;
        let held = held(&spec, head, &lines[index], fibre(&spec, index)?)?;
        stage.advance();
        Ok(held)
    })?;

    let placement = placement(&mut spec, head, &lines, hairs, &held);
    spec.wisps.check_size(placement.area())?;
    let layout = Layout::new(&spec, head)?;
    let guides = plan(&spec, head, &layout, &placement, &held);
    let before: Vec<_> = held.iter().map(|held| held.fit.equilibrium.clone()).collect();
    let start = GuideStart::At(&before);
    let options = SettleOptions { start, effort: Effort::FULL, locks: Vec::new() };
    let rest = settle(&spec, head, &guides, options, progress)?;
    let distances = parallel::map(lines.len(), |i| apart(&lines[i], &rest.guides[i]));
    let stiffness_needed = held.iter().map(|held| held.fit.stiffness_needed).collect();
    let inside = lines.iter().filter(|line| is_inside(&spec, head, line)).count();
    let off_skin = lines.iter().filter(|line| is_off(head, line)).count();
    let styling = Styling::none(&guides);
    let hairstyle = Hairstyle { spec, placement, layout, guides, rest, styling };
    let adoption = Adoption { distances, stiffness_needed, left_out, inside, off_skin, times: 0 };
    Ok((hairstyle, adoption))
}

/// Distance (m) of a root from the skin that is told. Chosen: heads in files differ from those that grooms were made on by less.
const OFF_SKIN: f64 = 0.01;

/// Whether the root of a line (m) is off the skin.
fn is_off(head: &Head, line: &[DVec3]) -> bool {
    head.signed_distance().value(line[0]) > OFF_SKIN
}

/// Least length (m) of a strand that is hair. Chosen: far below any hair, far above rounding.
const SHORTEST: f32 = 1e-6;

/// The strands that have a length, and how many have none.
fn with_length(strands: &Strands) -> (Cow<'_, Strands>, usize) {
    let has = |strand: &Strand<'_>| {
        strand.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f32>() > SHORTEST
    };
    let count = strands.iter().filter(has).count();
    if count == strands.len() || count == 0 {
        return (Cow::Borrowed(strands), 0);
    }
    let mut kept = Strands::new();
    strands.iter().filter(has).for_each(|strand| kept.push(strand.points, strand.radii));
    (Cow::Owned(kept), strands.len() - count)
}

/// Depth (m) in the head, and distance (m) along a strand, from which on it is not on the skin but in it.
/// Chosen by trial; not measured further.
const INSIDE: f64 = 5e-3;

/// Whether a strand goes through the head. No fibre is bent by a skull that it is in.
fn is_inside(spec: &HairstyleSpec, head: &Head, line: &[DVec3]) -> bool {
    let mut s = 0.0;
    let deep = |k: usize| {
        s += if k > 0 { line[k - 1].distance(line[k]) } else { 0.0 };
        // Long pieces go through the head between their ends.
        let from = line[k.saturating_sub(1)];
        let steps = (from.distance(line[k]) / INSIDE).ceil().clamp(1.0, 1000.0);
        let at = |x: f64| head.signed_distance().value(from.lerp(line[k], x / steps));
        s > INSIDE && (1..=steps as usize).any(|x| at(x as f64) < -INSIDE)
    };
    spec.contact.body != Body::None && (0..line.len()).any(deep)
}

/// How far (m) from the skin there can be other hair under a strand. Chosen by trial; not measured further.
const DEEPEST_BED: f64 = 0.04;

/// Longest distance (m) between the points at which the bed is evaluated. Chosen by trial; not measured further.
const FELT: f64 = 1e-3;

/// The strand of a groom as a rod that rests in its shape.
struct Held {
    fit: InverseSolution,
    /// The hair beneath it.
    bed: Bed,
    /// Force per length, in weights of the hair, that holds it out of the face.
    hold: DVec3,
}

/// The strand of a groom as a rod that rests in its shape, and what it rests on. Where hair that is combed out of the face
/// is held (`implantation.hold`), it is if that takes less bending.
fn held(
    spec: &HairstyleSpec,
    head: &Head,
    line: &[DVec3],
    fibre: RodSpec,
) -> Result<Held, InvalidQuantity> {
    let fitted = FittedCurve::new(line, &fibre)?;
    if is_inside(spec, head, line) {
        let bed = Bed::new(fitted.rod().length(), [(0.0, 0.0); 2], 0.0);
        return Ok(Held { fit: fitted.solve(&[], &holding(spec))?, bed, hold: DVec3::ZERO });
    }
    let skin: Vec<(f64, DVec3)> =
        fitted.nodes().iter().map(|p| head.signed_distance().value_gradient(*p)).collect();
    let strand = GroomStrand { spec, head, fitted: &fitted, skin: &skin };
    let root = fitted.rod().root();
    let normal = skin[0].1.normalize_or_zero();
    let along = root.frame().z_axis;
    let along = along - normal * along.dot(normal);
    let marks = head.landmarks();
    let out = marks.face * -out_of_face(marks, root.position(), along);
    let free = strand.support(fitted.rod(), DVec3::ZERO);
    let hold = spec.implantation.hold;
    if out == DVec3::ZERO || hold <= 0.0 {
        return strand.held(free);
    }
    // 1. Without a hold, with that of the description, and where that is stronger than usual with the usual one: nobody knows how well
    // the hair of a groom was combed. How far a hold reaches depends on the curl that is found.
    let usual = Implantation::default().hold;
    let mut tried = vec![free];
    let weaker = Some(usual).filter(|usual| *usual < hold);
    for hold in [Some(hold), weaker].into_iter().flatten() {
        let guess = strand.balance(&strand.support(fitted.rod(), out * hold))?;
        tried.push(strand.support(&guess.rod, out * hold));
    }
    // 2. Of these in the order of the stiffness that a stable shape needs, then of bending. Balance tells, in a small part of the time in
    // which the rest is found.
    let effort = |needed: f64, target: &Equilibrium| [needed, target.energy.elastic];
    let mut tried = tried
        .into_iter()
        .map(|support| {
            let balance = strand.balance(&support)?;
            Ok((effort(balance.stiffness_needed, &balance.target), support))
        })
        .collect::<Result<Vec<_>, InvalidQuantity>>()?;
    tried.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    // 3. The next one only where the one before is unstable after all, in a finer division.
    let mut best: Option<([f64; 2], Held)> = None;
    for (_, support) in tried {
        let held = strand.held(support)?;
        let of = effort(held.fit.stiffness_needed, &held.fit.target);
        if of[0] <= 1.0 {
            return Ok(held);
        }
        if best.as_ref().is_none_or(|(least, _)| of < *least) {
            best = Some((of, held));
        }
    }
    Ok(best.expect("hair without a hold is among them").1)
}

/// A strand of a groom on a head; `skin` has the distance from it (m) and its gradient at each node.
struct GroomStrand<'a> {
    spec: &'a HairstyleSpec,
    head: &'a Head,
    fitted: &'a FittedCurve,
    skin: &'a [(f64, DVec3)],
}

/// What bears a strand besides its own stiffness.
struct Support {
    /// The hair beneath it.
    bed: Bed,
    /// Force per length, in weights of the hair, that holds it out of the face, …
    hold: DVec3,
    /// … and how far.
    combed: CombedHold,
}

impl GroomStrand<'_> {
    /// The bed that it needs where it is held with `hold` times its weight per length as far as a rod with the curl of `like` is.
    fn support(&self, like: &Rod, hold: DVec3) -> Support {
        let &Self { spec, fitted, skin, .. } = self;
        let combed = combed_hold(like, hold);
        let bears = spec.contact.body != Body::None;
        let beneath = |(distance, out): &(f64, DVec3)| {
            (bears && *distance < DEEPEST_BED).then(|| out.normalize_or_zero())
        };
        let ways: Vec<Option<DVec3>> = skin.iter().map(beneath).collect();
        // The forces of (I2), docs/theory.md, "Inverse statics", as forces per length on a bed of the height that bears them.
        let forces = spread(&fitted.least_support(&ways, |s| combed.force(s)));
        let spacing = self.spacing();
        let borne = skin.iter().zip(&forces);
        let borne = borne.map(|((distance, _), force)| (*distance, force / spacing));
        Support { bed: Bed::new(spacing, borne, spec.contact.hair_stiffness), hold, combed }
    }

    /// Distance (m) along it from node to node.
    fn spacing(&self) -> f64 {
        self.fitted.rod().length() / (self.skin.len() - 1) as f64
    }

    fn contact<'a>(&'a self, Support { bed, combed, .. }: &'a Support) -> BodyContact<'a> {
        held_up(self.spec, self.head, self.fitted.rod(), bed, *combed)
    }

    /// The potential of a contact along it.
    fn along<'a>(&self, contact: &'a BodyContact<'a>) -> FieldPotential<'a, BodyContact<'a>> {
        FieldPotential::new(contact, (self.spacing() / FELT).ceil().max(1.0) as u32)
    }

    /// The fibre that is in balance on a support.
    fn balance(&self, support: &Support) -> Result<Balance, InvalidQuantity> {
        let contact = self.contact(support);
        self.fitted.balance(&[&self.along(&contact)])
    }

    /// The fibre that rests on a support.
    fn held(&self, support: Support) -> Result<Held, InvalidQuantity> {
        let contact = self.contact(&support);
        let fit = self.fitted.solve(&[&self.along(&contact)], &holding(self.spec))?;
        let Support { bed, hold, .. } = support;
        Ok(Held { fit, bed, hold })
    }
}

/// Forces at nodes, each shared with its neighbours: hair lies on hair, not on the points of a comb.
fn spread(forces: &[f64]) -> Vec<f64> {
    let mut spread = forces.to_vec();
    // Weights ¼, ½, ¼ three times over (chosen): a bell with a standard deviation of 1.2 nodes.
    for _ in 0..3 {
        let at = |i: usize| spread.get(i).copied().unwrap_or(0.0);
        let last = spread.len() - 1;
        spread =
            (0..=last).map(|i| 0.25 * (at(i.wrapping_sub(1)) + at(i + 1)) + 0.5 * at(i)).collect();
    }
    spread
}

/// The fibre of a guide, without a shape.
fn fibre(spec: &HairstyleSpec, index: usize) -> Result<RodSpec, InvalidQuantity> {
    let mut random = Stream::new(spec.seed, Purpose::GuideFibre, index);
    let section = spec.fibre.of_wisp(&mut random)?;
    Ok(RodSpec {
        length: 1.0,
        section,
        material: spec.fibre.material,
        torsion: spec.fibre.torsion,
        natural: NaturalStrain::STRAIGHT,
        root: Clamp::from_tangent(DVec3::ZERO, DVec3::Z, DVec3::X)?,
        load: spec.load(&section),
    })
}

/// Where guides and hairs are rooted.
fn placement(
    spec: &mut HairstyleSpec,
    head: &Head,
    lines: &[Vec<DVec3>],
    hairs: &Strands,
    held: &[Held],
) -> RootPlacement {
    let root = |p: DVec3| Root {
        position: p,
        normal: head.signed_distance().value_gradient(p).1.normalize_or(DVec3::Z),
    };
    let roots: Vec<Root> = lines.iter().map(|line| root(line[0])).collect();
    let scalp = Scalp::grown(head, spec);
    // Of the scalp counts what is about as near to some guide as guides are to each other.
    let samples = scalp.stratified(SAMPLES, spec.seed, Purpose::HairRoots);
    let near = near(&roots, &samples);
    let area = scalp.area() * (near.len().max(1) as f64 / SAMPLES as f64);
    let drawn: Vec<Root> = if hairs.is_empty() {
        let wanted = spec.wisps.hair_count(area);
        let share = near.len().max(1) as f64 / SAMPLES as f64;
        let all = (wanted as f64 / share).ceil() as usize;
        self::near(&roots, &scalp.stratified(all, spec.seed, Purpose::HairRoots))
    } else {
        hairs.iter().map(|hair| root(hair.points[0].as_dvec3())).collect()
    };
    let drawn = if drawn.is_empty() { roots.clone() } else { drawn };
    spec.wisps.hairs = Hairs::Count(drawn.len());
    let bound = (!hairs.is_empty()).then(|| {
        spec.wisps.points = spec.wisps.points.max(usual_points(hairs));
        let wisp = |held: &Held| Wisp::new(&held.fit.target, WISP_SAMPLES);
        Arc::new(BoundStrands::new(hairs, parallel::map_slice(held, wisp)))
    });
    let hairs = Arc::new(Mutex::new(Some(drawn.into())));
    RootPlacement { of: RootPlacement::key(spec, head), area, roots, hairs, bound }
}

/// Most points that hairs are drawn with because the groom's have as many, on one hair and on all. A guard on memory.
const MOST_POINTS: (usize, usize) = (256, 20_000_000);

/// The number of points that strands of a groom have, in the median, as far as memory allows.
fn usual_points(hairs: &Strands) -> usize {
    let mut counts: Vec<usize> = hairs.iter().map(|hair| hair.points.len()).collect();
    let half = counts.len() / 2;
    let usual = *counts.select_nth_unstable(half).1;
    usual.min(MOST_POINTS.0).min(MOST_POINTS.1 / hairs.len()).max(2)
}

/// Points of the scalp that tell where the groom grows. Chosen: the area is within half a per cent.
const SAMPLES: usize = 20_000;

/// How far from the nearest guide hair is drawn, in distances of guides from each other: to half-way and a little.
/// Chosen by eye; not measured.
const REACH: f64 = 1.0;

/// The roots that are near guides.
fn near(guides: &[Root], roots: &[Root]) -> Vec<Root> {
    let places: Vec<DVec3> = guides.iter().map(|root| root.position).collect();
    let (low, high) =
        places.iter().fold((places[0], places[0]), |(l, h), p| (l.min(*p), h.max(*p)));
    let guess = ((high - low).length() / (places.len() as f64).sqrt()).max(1e-3);
    let grid = Grid::new(&places, guess);
    // The distance that most guides have to the nearest other.
    let mut apart: Vec<f64> = (places.iter().enumerate())
        .filter_map(|(i, p)| {
            let other = grid.nearest(*p, 2, &places).into_iter().find(|&j| j != i)?;
            Some(places[other].distance(*p))
        })
        .collect();
    apart.sort_by(f64::total_cmp);
    let usual = apart.get(apart.len() * 9 / 10).copied().unwrap_or(LONELY).max(1e-3);
    let is_near = |root: &&Root| {
        let nearest = grid.nearest(root.position, 1, &places)[0];
        places[nearest].distance(root.position) < REACH * usual
    };
    roots.iter().filter(is_near).copied().collect()
}

/// Reach (m) of a guide that is alone. Chosen by eye; not measured.
const LONELY: f64 = 0.01;

/// The guides, with the fibres that were found.
fn plan(
    spec: &HairstyleSpec,
    head: &Head,
    layout: &Layout,
    placement: &RootPlacement,
    held: &[Held],
) -> Vec<Guide> {
    let ways = Ways::new(spec, head, layout);
    let guide = |(root, Held { fit, bed, hold }): (&Root, &Held)| {
        let curl = fit.rod.natural().mean(0.0, fit.rod.length());
        let planned = Planned { rod: fit.rod.clone(), curl, share: 1.0 };
        let guide = covered(spec, head, placement.area(), &ways, *root, planned);
        Guide { bed: Some(Arc::new(bed.clone())), hold: *hold, ..guide }
    };
    placement.roots().iter().zip(held).map(guide).collect()
}

/// Largest distance (m) of a line's points from a guide at rest, each at its part of the length.
fn apart(line: &[DVec3], rest: &Equilibrium) -> f64 {
    let chain = rest.chain();
    let length: f64 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let every = line.len().div_ceil(COMPARED);
    let mut s = 0.0;
    let mut largest = 0.0_f64;
    for (i, p) in line.iter().enumerate() {
        s += if i > 0 { line[i - 1].distance(*p) } else { 0.0 };
        // The tip, which moves most, is among them.
        if (line.len() - 1 - i).is_multiple_of(every) {
            largest = largest.max(rest.at(&chain, s / length).0.distance(*p));
        }
    }
    largest
}

/// Most points of a strand, evenly chosen, that are compared. A guard on time.
const COMPARED: usize = 512;
