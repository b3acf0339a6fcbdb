//! The drawn hairs: a stochastic population around the guides.
//!
//! After Choe & Ko 2005, the hairs of a wisp keep their place in a cross-section that gathers from
//! the patch of skin where they grow to the thickness of the wisp, deviate from it by a coherent
//! random process (never white noise), and vary in length. Beyond it: a wisp splits into thinner
//! ones, neighbouring wisps blend where hair is a smooth mass, every hair is rooted in the skin where
//! its root is, and hairs that would lie in the body are laid on it, in the order in which they lay.

use frisure_rod::Equilibrium;
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::grid::Grid;
use crate::guides::Guide;
use crate::head::Head;
use crate::implantation::rim::Rim;
use crate::implantation::{Layout, smooth};
use crate::monitor::{Cancelled, Monitor, Stage};
use crate::random::{Purpose, Stream};
use crate::roots::{Root, Scalp};
use crate::spec::{Body, HairstyleSpec, Wisps};
use crate::splits::{Split, Waves, splits};
use crate::wisps::Wisp;

/// How many neighbouring guides a hair can follow.
const FOLLOWED: usize = 5;

/// How many guides are looked at where the nearest are across a parting.
const SOUGHT: usize = 24;

/// Width of the strip along the hairline in which baby hairs grow (m).
const BABY_RIM: f64 = 0.015;

/// Shortest and longest baby hair (m).
const BABY_LENGTH: (f64, f64) = (0.02, 0.05);

/// Diameter of a baby hair, as a fraction of other hair's.
const THIN: f64 = 0.5;

/// Least length of a hair that is cut to a line, as a fraction: a cut leaves no short hairs.
const CUT: f64 = 0.97;

/// How much farther away a guide seems for going another way than the hair's own root.
const AGAINST: f64 = 8.0;

/// Depth of the first point of a hair below the skin (m), so that no root floats.
const ROOT_DEPTH: f64 = 3e-4;

/// Radius at the tip, as a fraction of the fibre's.
const TIP: f64 = 0.35;

/// How much of the way to the middle of its split a hair has come at the tip.
const GATHERED: f64 = 0.75;

/// Least distance of a hair from the skin far from its root (m).
const LEAST_DISTANCE: f64 = 4e-4;

/// Width over which hairs are moved out of the body, as a fraction of the radius of their wisp …
const PRESSED: f64 = 0.3;

/// … and how many of them farther out no hair is moved.
const FREE: f64 = 6.0;

/// Everything that drawing a hair needs.
struct Population<'a> {
    spec: &'a HairstyleSpec,
    head: &'a Head,
    layout: &'a Layout,
    rim: Rim,
    guides: &'a [Guide],
    wisps: Vec<Wisp>,
    grid: Grid,
    roots: Vec<DVec3>,
    /// Mean distance of neighbouring guides (m).
    spacing: f64,
    /// Radius of the patch of skin that a wisp grows from (m).
    patch: f64,
    /// The thinner wisps that each wisp splits into.
    splits: Vec<Vec<Split>>,
    /// Largest width (m) over which hairs of any wisp are moved out of the body.
    widest: f64,
}

/// Draws the hairs of a head.
///
/// # Errors
/// [`Cancelled`], if the monitor says so.
pub(crate) fn draw(
    spec: &HairstyleSpec,
    head: &Head,
    layout: &Layout,
    guides: &[Guide],
    rest: &[Equilibrium],
    monitor: &dyn Monitor,
) -> Result<Strands, Cancelled> {
    let scalp = Scalp::grown(head, spec);
    let spacing = (scalp.area() / guides.len() as f64).sqrt();
    let samples = (2 * spec.wisps.points).max(64);
    let roots: Vec<DVec3> = guides.iter().map(|g| g.root.position).collect();
    let patch = spacing / std::f64::consts::PI.sqrt();
    let thickest = |g: &Guide| g.thickness.packed(0.0).max(g.thickness.packed(g.rod.length()));
    let population = Population {
        spec,
        head,
        layout,
        rim: Rim::new(head, head.edge(&spec.implantation.hairline, spec.seed), BABY_RIM),
        guides,
        wisps: rest.par_iter().map(|r| Wisp::new(r, samples)).collect(),
        grid: Grid::new(&roots, spacing),
        roots,
        spacing,
        patch,
        splits: splits(spec, guides, patch),
        widest: PRESSED * guides.iter().map(thickest).fold(0.0, f64::max),
    };
    let count = spec.wisps.hair_count(scalp.area());
    let hair_roots = scalp.stratified(count, spec.seed, Purpose::HairRoots);
    let stage = Stage::new(monitor, "drawing hairs", hair_roots.len());
    let hairs: Vec<Hair> = hair_roots
        .par_iter()
        .enumerate()
        .map(|(index, root)| {
            stage.check()?;
            let hair = population.hair(&layout.gathered(head, *root), index);
            stage.advance();
            Ok(hair)
        })
        .collect::<Result<_, Cancelled>>()?;
    Ok(assemble(spec, guides, &hairs))
}

/// Deepest that a point of the strands, other than a root, is inside the body of a head (m); 0 if
/// none is.
#[must_use]
pub fn penetration(strands: &Strands, head: &Head) -> f64 {
    (0..strands.len())
        .into_par_iter()
        .map(|i| {
            let depth = |p: &Vec3| -head.signed_distance().value(p.as_dvec3());
            strands.strand(i).points.iter().skip(1).map(depth).fold(0.0, f64::max)
        })
        .reduce(|| 0.0, f64::max)
}

struct Hair {
    guide: u32,
    /// Factor on its diameter.
    thickness: f64,
    points: Vec<Vec3>,
}

/// The strands, each as thick as its guide.
fn assemble(spec: &HairstyleSpec, guides: &[Guide], hairs: &[Hair]) -> Strands {
    let points = spec.wisps.points;
    let taper: Vec<f64> = (0..points)
        .map(|i| 1.0 - (1.0 - TIP) * smooth(0.85, 1.0, i as f64 / (points - 1) as f64))
        .collect();
    let mut strands = Strands::with_capacity(hairs.len(), hairs.len() * points);
    let mut radii = vec![0.0; points];
    for hair in hairs {
        let radius = guides[hair.guide as usize].rod.spec().section.mean_radius() * hair.thickness;
        for (here, taper) in radii.iter_mut().zip(&taper) {
            *here = (radius * taper) as f32;
        }
        strands.push(&hair.points, &radii);
    }
    let values = AttributeValues::U32(hairs.iter().map(|h| h.guide).collect());
    let guide = Attribute { name: "guide".into(), domain: Domain::Strand, values };
    strands.set_attribute(guide).expect("one guide per strand, set once");
    strands
}

/// What makes one hair differ from its neighbours.
struct Character {
    /// Length as a fraction of its guides'.
    length: f64,
    /// Factor on the arc length at which it follows its guides: how its curl drifts.
    drift: f64,
    /// Coherent deviation.
    waves: Waves,
}

impl Character {
    fn new(wisps: &Wisps, length: f64, spacing: f64, random: &mut Stream) -> Self {
        let stray = random.unit() < wisps.flyaways;
        let fuzz = wisps.fuzziness * random.factor(0.5) * if stray { 2.5 } else { 1.0 };
        Self {
            waves: Waves::new(0.3 * fuzz * spacing, length, random),
            length: (1.0 - wisps.length_variation * random.normal().abs()).max(0.2),
            drift: 1.0 + (0.006 + 0.06 * wisps.fuzziness) * random.normal(),
        }
    }
}

/// A ball (m) known to be free of the body and of its layers: most points need no look-up.
struct Free {
    centre: DVec3,
    radius: f64,
}

impl Free {
    const NOWHERE: Self = Self { centre: DVec3::ZERO, radius: -1.0 };

    fn holds(&self, p: DVec3) -> bool {
        self.radius > 0.0 && p.distance_squared(self.centre) < self.radius * self.radius
    }
}

impl Population<'_> {
    fn hair(&self, root: &Root, index: usize) -> Hair {
        let mut random = Stream::new(self.spec.seed, Purpose::Hair, index);
        let followed = self.followed(root);
        let main = followed[0].0;
        let length: f64 = followed.iter().map(|&(g, w)| w * self.wisps[g].length).sum();
        let wisps = &self.spec.wisps;
        let mut character = Character::new(wisps, length, self.spacing, &mut random);
        let split = self.split(main, root.position);
        if let Some(own) = self.layout.length(self.head, root) {
            // Roots behind and before the guide's reach the same line.
            character.length = (character.length.max(CUT) * own / length).min(1.0);
        }
        let baby = self.baby(root, index);
        character.length = baby.map_or(character.length, |l| character.length.min(l / length));
        let last = wisps.points - 1;
        let mut free = Free::NOWHERE;
        let points = (0..=last)
            .map(|k| {
                let x = k as f64 / last as f64 * character.length;
                let p = self.followed_point(root, &followed, &character, split, x, length);
                self.laid_on_body(root, p, x * length, main, &mut free).as_vec3()
            })
            .collect();
        Hair { guide: main as u32, thickness: if baby.is_some() { THIN } else { 1.0 }, points }
    }

    /// Guides that a hair follows, with weights that sum to one; the nearest first.
    fn followed(&self, root: &Root) -> Vec<(usize, f64)> {
        let mut near = self.near(root.position);
        // Beside a parting the nearest guide may go to the other side.
        let own = self.layout.direction(root);
        let farness = |g: usize| {
            let against = 1.0 - own.dot(self.guides[g].rod.root().frame().z_axis);
            root.position.distance_squared(self.roots[g]) * (1.0 + AGAINST * against)
        };
        near.sort_by(|&a, &b| farness(a).total_cmp(&farness(b)).then(a.cmp(&b)));
        let first = near[0];
        let reach = (0.9 * self.spacing * self.spec.wisps.blending).max(1e-9);
        let weight = |g: usize| {
            let excess = (farness(g) - farness(first)).max(0.0);
            (-excess / (reach * reach)).exp() * self.agreement(first, g)
        };
        let mut followed: Vec<_> = near.iter().map(|&g| (g, weight(g))).collect();
        followed.retain(|f| f.1 > 1e-3);
        let sum: f64 = followed.iter().map(|f| f.1).sum();
        for f in &mut followed {
            f.1 /= sum;
        }
        followed
    }

    /// Guides near a root that its hair can go with, nearest first; at least one.
    fn near(&self, root: DVec3) -> Vec<usize> {
        let mut near = self.grid.nearest(root, FOLLOWED, &self.roots);
        if !self.layout.divides() {
            return near;
        }
        let nearest = near[0];
        let together = |g: &usize| !self.layout.apart(root, self.roots[*g]);
        near.retain(together);
        if near.is_empty() {
            near = self.grid.nearest(root, SOUGHT, &self.roots);
            near.retain(together);
            near.truncate(FOLLOWED);
        }
        if near.is_empty() { vec![nearest] } else { near }
    }

    /// The length (m) of a baby hair; none for other hair.
    fn baby(&self, root: &Root, index: usize) -> Option<f64> {
        let share = self.spec.implantation.baby_hairs;
        if share == 0.0 {
            return None;
        }
        let mut random = Stream::new(self.spec.seed, Purpose::BabyHair, index);
        let chosen = random.unit() < share;
        (chosen && self.rim.distance(root.position) < BABY_RIM)
            .then(|| random.between(BABY_LENGTH.0, BABY_LENGTH.1))
    }

    /// Whether two guides go the same way, from 1 to 0: hair beside a parting or around an ear falls
    /// on one side or the other, not in the middle.
    fn agreement(&self, a: usize, b: usize) -> f64 {
        let apart = |x: f64| self.wisps[a].at(x).0.distance(self.wisps[b].at(x).0);
        let least = apart(0.0) + self.spacing;
        let most = [0.3, 0.65, 1.0].into_iter().map(apart).fold(0.0, f64::max);
        1.0 - smooth(0.8, 1.6, most / least)
    }

    /// The split of a wisp that a hair belongs to: the nearest in the skin.
    fn split(&self, guide: usize, root: DVec3) -> Option<&Split> {
        let place = root - self.roots[guide];
        let far = |s: &&Split| s.middle.distance_squared(place);
        self.splits[guide].iter().min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// Point of a hair at `x` of its guides' length.
    fn followed_point(
        &self,
        root: &Root,
        followed: &[(usize, f64)],
        character: &Character,
        split: Option<&Split>,
        x: f64,
        length: f64,
    ) -> DVec3 {
        let along = x * length;
        let rise = smooth(0.0, 0.06_f64.min(0.5 * length), along);
        let gathered = smooth(0.0, 1.0, x.powf(0.8));
        let drifted = x * (1.0 + (character.drift - 1.0) * rise);
        let mut carried = character.waves.at(x) * rise;
        for (rank, &(g, weight)) in followed.iter().enumerate() {
            let (centre, turn) = self.wisps[g].at(drifted);
            let mut place = root.position - self.roots[g];
            if rank == 0
                && let Some(split) = split
            {
                // All of the hair goes with its split, of which only the first wisp knows.
                place += (split.middle - place) * (GATHERED * gathered / weight);
                carried += split.waves.at(x) * rise;
            }
            carried += (centre + turn * place * self.narrowing(g, along, gathered)) * weight;
        }
        carried
    }

    /// Width of a wisp at arc length `s` (m), as a fraction of its patch of skin.
    fn narrowing(&self, guide: usize, s: f64, gathered: f64) -> f64 {
        let packed = self.guides[guide].thickness.packed(s) / self.patch;
        let [root, middle, tip] = self.spec.wisps.profile;
        let x = s / self.wisps[guide].length;
        let along = if x < 0.5 {
            root + (middle - root) * 2.0 * x
        } else {
            middle + (tip - middle) * (2.0 * x - 1.0)
        };
        (1.0 + self.spec.wisps.clumping * gathered * (packed - 1.0)) * along
    }

    /// Moves a point at arc length `s` (m) that is in the body, or nearly, out of it.
    ///
    /// What would lie at the depths of a wisp that is pressed on the skin comes to lie at
    /// `m + w ln(1 + exp((d − m)/w))`, d its distance before: in the same order, nothing in the skin,
    /// and no two layers in one.
    fn laid_on_body(&self, root: &Root, p: DVec3, s: f64, guide: usize, free: &mut Free) -> DVec3 {
        if s <= 0.0 {
            return root.position - root.normal * ROOT_DEPTH;
        }
        if self.spec.contact.body == Body::None || free.holds(p) {
            return p;
        }
        let least = LEAST_DISTANCE * (s / 0.003).min(1.0);
        let width = (PRESSED * self.guides[guide].thickness.at(s)).max(2e-5);
        let (distance, gradient) = self.head.signed_distance().value_gradient(p);
        let beyond = (distance - least) / width;
        if beyond > FREE {
            *free = Free { centre: p, radius: distance - least - FREE * self.widest };
            return p;
        }
        let wanted = least + width * beyond.exp().ln_1p();
        let mut p = p + gradient.normalize_or(root.normal) * (wanted - distance);
        for _ in 0..4 {
            // Where the skin is curved the way out is not straight.
            let (distance, gradient) = self.head.signed_distance().value_gradient(p);
            if distance >= least {
                break;
            }
            p += gradient.normalize_or(root.normal) * (least - distance);
        }
        p
    }
}
