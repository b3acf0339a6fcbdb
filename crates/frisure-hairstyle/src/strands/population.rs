//! All drawn hairs of a head: where each is rooted, and which guides it follows.

use frisure_rod::Equilibrium;
use glam::DVec3;

use super::binding::{StrandBinding, StrandVariation, winding};
use super::gathering::Tier;
use super::locks::Locks;
use super::skin::{PRESSED, Skin};
use super::splits::{Plan, Splits};
use crate::capillary::Coalescence;
use crate::fibre::Wetting;
use crate::guides::Guide;
use crate::hairstyle::Hairstyle;
use crate::hairstyle::WispState;
use crate::head::Head;
use crate::implantation::Layout;
use crate::implantation::Root;
use crate::implantation::rim::Rim;
use crate::math::Grid;
use crate::math::smooth_step;
use crate::parallel;
use crate::random::{Purpose, Stream};
use crate::spec::HairstyleSpec;
use crate::wisps::BoundStrands;
use crate::wisps::Wisp;

/// How many neighbouring guides a hair can follow. Chosen by trial; not measured further.
const FOLLOWED: usize = 5;

/// How many guides are looked at where the nearest are across a parting. Chosen by trial; not measured further.
const SOUGHT: usize = 24;

/// Width of the strip along the hairline in which baby hairs grow (m). docs/theory.md, "Roots and implantation".
const BABY_RIM: f64 = 0.015;

/// Shortest and longest baby hair at the inner edge of the strip (m); at the hairline itself they are [`SHORTER`] times as long.
/// docs/theory.md, "Roots and implantation".
const BABY_LENGTH: (f64, f64) = (0.02, 0.05);

/// Factor on the length of baby hairs at the hairline. Chosen by eye.
const SHORTER: f64 = 0.3;

/// How far over the outline of an ear baby hairs reach, and how long they are at least for that (m). Chosen by eye.
const INTO_EAR: f64 = 2e-3;
const LEAST_BABY: f64 = 6e-3;

/// Diameter of a baby hair, and of every hair at the hairline, as a fraction of other hair's. docs/theory.md, "Roots and
/// implantation".
const THIN: f64 = 0.5;

/// Distance from the hairline at which hair is as thick as elsewhere (m). docs/theory.md, "Roots and implantation".
const FULL: f64 = 0.01;

/// Least length of a hair that is cut to a line, as a fraction: a cut leaves no short hairs.
/// Chosen by eye; not measured.
const CUT: f64 = 0.97;

/// How much farther away a guide seems for going another way than the hair's own root.
/// Chosen by trial; not measured further.
const AGAINST: f64 = 8.0;

/// Everything that drawing a hair needs.
pub(crate) struct Population<'a> {
    pub(super) spec: &'a HairstyleSpec,
    pub(super) head: &'a Head,
    pub(super) layout: &'a Layout,
    /// Strands of a groom, which keep their own shapes.
    pub(super) bound: Option<&'a BoundStrands>,
    rim: Rim,
    pub(super) planned: &'a [Guide],
    pub(super) guides: &'a [Guide],
    pub(super) states: &'a [WispState],
    /// Length (m) at which each hair has been cut.
    limits: Option<&'a [f32]>,
    /// Whether that is its own length, rather than that along its guides.
    straight: Option<&'a [bool]>,
    pub(super) wisps: Vec<Wisp>,
    /// The radius that the hairs of each wisp need at its stations, over that of its patch.
    pub(super) packed: Vec<Box<[f64]>>,
    /// Where (m) the axis of each wisp is at [`MARKS`].
    pub(super) marks: Vec<[DVec3; 4]>,
    grid: Grid,
    pub(super) roots: Vec<DVec3>,
    /// Mean distance of neighbouring guides (m).
    pub(super) spacing: f64,
    /// The thinner wisps into which hair splits.
    pub(super) splits: Splits,
    /// The locks of wet hair.
    pub(super) locks: Locks,
    pub(super) skin: Skin<'a>,
}

/// Reach of blending at full blending, in spacings of guides. docs/theory.md, "Wisps"; chosen by eye.
const BLENDING_REACH: f64 = 0.9;

/// Weight, relative to the nearest guide's, below which a guide is not followed. Chosen: it moves a hair by a thousandth.
const LEAST_WEIGHT: f64 = 1e-3;

/// Ratios of distances along two guides to that of their roots: up to the first they go the same way, from the second on they
/// do not. Chosen by eye; not measured.
const AGREEING: (f64, f64) = (0.8, 1.6);

/// How far apart two guides that stand beside each other may end, as a share of how far from the skin they end, up to a length
/// (m). Chosen by eye; not measured.
const FAN: f64 = 0.3;
const SHORT: f64 = 0.08;

/// Where along two guides it shows whether they go the same way, from root to tip.
/// Chosen by trial; not measured further.
const MARKS: [f64; 4] = [0.0, 0.3, 0.65, 1.0];

/// Where every `stride`-th drawn hair of a head is rooted, with the index of the hair.
pub(crate) fn roots(hairstyle: &Hairstyle, head: &Head, stride: usize) -> Vec<(usize, Root)> {
    let Hairstyle { spec, layout, placement, .. } = hairstyle;
    let roots = placement.hairs(spec, head);
    // Hair of a groom is rooted where the groom has it.
    let own = placement.bound(spec, head).is_some();
    let place = |root: &Root| if own { *root } else { layout.gathered(head, *root) };
    let stride = stride.max(1);
    parallel::map(roots.len().div_ceil(stride), |k| (k * stride, place(&roots[k * stride])))
}

/// How hairs would gather into locks if the hair that was planned were soaked: the sizes of locks that hair is divided into, which
/// stay the same while it dries or is cut.
fn soaked(spec: &HairstyleSpec, planned: &Guide) -> Option<Coalescence> {
    let wisp = WispState { wetness: 1.0, ..WispState::new(planned.rod.length()) };
    let dry = wisp.coalescence(spec, &planned.rod, &planned.thickness)?;
    let Wetting { youngs_modulus, diameter, .. } = spec.wetting;
    // EI goes with the modulus and the fourth power of the diameter.
    Some(Coalescence { bending: dry.bending * youngs_modulus * diameter.powi(4), ..dry })
}

impl<'a> Population<'a> {
    pub(crate) fn new(hairstyle: &'a Hairstyle, head: &'a Head) -> Self {
        let Hairstyle { spec, layout, guides, rest, styling, .. } = hairstyle;
        // ℓ of docs/theory.md, "Wisps": the side of a square of scalp for each guide.
        let spacing = (hairstyle.placement.area() / guides.len() as f64).sqrt();
        let samples = (2 * spec.wisps.points).max(64);
        let limits = styling.limits();
        let roots: Vec<DVec3> = guides.iter().map(|g| g.root.position).collect();
        // A disc of the same area.
        let patch = spacing / std::f64::consts::PI.sqrt();
        let thickest = |g: &Guide| g.thickness.packed(0.0).max(g.thickness.packed(g.rod.length()));
        let wisp = |rest: &Equilibrium| Wisp::new(rest, samples);
        let packed = |(guide, wisp): (&Guide, &Wisp)| -> Box<[f64]> {
            let radius = |x: f64| guide.thickness.packed(x * wisp.length) / patch;
            wisp.stations().map(radius).collect()
        };
        let wisps = parallel::map_slice(&rest.guides, wisp);
        let bound = hairstyle.placement.bound(spec, head);
        let planned = styling.planned.iter().map(|g| g.rod.length()).sum::<f64>();
        let plan = Plan {
            wisps: &spec.wisps,
            seed: spec.seed,
            hairs: &hairstyle.placement.hairs(spec, head),
            area: hairstyle.placement.area(),
            length: planned / guides.len() as f64,
            purpose: Purpose::Split,
        };
        let place = |root: &Root| layout.gathered(head, *root);
        let water = |(guide, wisp): (&Guide, &WispState)| {
            wisp.coalescence(spec, &guide.rod, &guide.thickness)
        };
        let water: Vec<_> = guides.iter().zip(&styling.wisps).map(water).collect();
        Self {
            spec,
            head,
            layout,
            bound,
            rim: Rim::new(head, head.edge(&spec.implantation.hairline, spec.seed), BABY_RIM),
            planned: &styling.planned,
            guides,
            states: &styling.wisps,
            limits,
            straight: styling.ends.as_ref().map(|ends| &*ends.straight),
            marks: wisps.iter().map(|wisp| MARKS.map(|x| wisp.axis(&wisp.place(x)))).collect(),
            packed: guides.iter().zip(&wisps).map(packed).collect(),
            wisps,
            grid: Grid::new(&roots, spacing),
            roots,
            spacing,
            splits: match bound {
                Some(_) => Splits::NONE,
                None => Splits::new(&plan, place),
            },
            locks: match bound {
                Some(_) => Locks::NONE,
                None => {
                    let plan = Plan { purpose: Purpose::WetLock, ..plan };
                    let soaked = styling.planned.iter().filter_map(|guide| soaked(spec, guide));
                    Locks::new(&plan, hairstyle.grown(), &water, soaked, place)
                }
            },
            skin: Skin {
                head,
                body: spec.contact.body,
                widest: PRESSED * guides.iter().map(thickest).fold(0.0, f64::max),
            },
        }
    }

    /// How the hair of this index, rooted somewhere, is bound to guides.
    pub(super) fn bind(&self, root: &Root, index: usize) -> StrandBinding<'_> {
        let mut random = Stream::new(self.spec.seed, Purpose::Hair, index);
        let followed = self.followed(root, index);
        let own = self.bound.map(|bound| bound.strand(index));
        let main = followed[0].0;
        let mean = |of: &dyn Fn(usize) -> f64| followed.iter().map(|&(g, w)| w * of(g)).sum();
        let length: f64 = mean(&|g| self.wisps[g].length);
        let uncut: f64 = mean(&|g| self.states[g].uncut);
        let planned: f64 = mean(&|g| self.planned[g].rod.length());
        let variation = StrandVariation::new(&self.spec.wisps, planned, self.spacing, &mut random);
        let grown = match (&own, self.layout.length(self.head, root)) {
            (Some(own), _) => own.length() + (uncut - planned),
            // Roots behind and before the guide's reach the same line.
            (_, Some(own)) => (variation.length.max(CUT) * own + (uncut - planned)).min(uncut),
            _ => variation.length * uncut,
        };
        let (baby, thickness) = if own.is_some() { (None, 1.0) } else { self.fine(root, index) };
        let grown = baby.map_or(grown, |baby| baby.min(grown));
        let limit = self.limits.map_or(f64::INFINITY, |limits| f64::from(limits[index]));
        let (dry, cut) = (grown.min(limit), limit < grown);
        let stretch = self.stretch(main);
        let known = if own.is_some() { f64::INFINITY } else { self.wisps[main].end() };
        let split = if own.is_none() && variation.gathers() {
            self.gathers_to(Tier::Splits, root.position, main)
        } else {
            None
        };
        let mut binding = StrandBinding {
            root: *root,
            winding: winding(split.as_ref(), main, variation.curl),
            split,
            // Water draws in hairs that leave their wisp when dry, too.
            lock: self.gathers_to(Tier::Locks, root.position, main),
            followed,
            variation,
            length,
            planned,
            uncut,
            end: (dry * stretch / length).min(known),
            dry,
            cut,
            most: if cut && self.straight.is_some_and(|straight| straight[index]) {
                dry * stretch
            } else {
                f64::INFINITY
            },
            thickness,
            narrow: 1.0,
            own,
            shift: DVec3::ZERO,
        };
        if binding.own.is_some() {
            binding.shift = root.position - self.followed_point(&binding, 0.0);
        }
        binding
    }

    /// How many times as long as dry the hair of a guide is: wet hair is longer.
    pub(super) fn stretch(&self, guide: usize) -> f64 {
        self.guides[guide].rod.length() / self.states[guide].length
    }

    /// The mean length (m, dry) of the guides that a hair follows.
    pub(crate) fn followed_length(&self, root: &Root, index: usize) -> f64 {
        let followed = self.followed(root, index);
        followed.iter().map(|&(g, weight)| weight * self.states[g].length).sum()
    }

    /// A guide's wisp.
    pub(super) fn wisp(&self, guide: usize) -> &Wisp {
        &self.wisps[guide]
    }

    /// The guide of the hair of this index that is rooted somewhere.
    pub(crate) fn main(&self, root: &Root, index: usize) -> usize {
        match self.bound {
            Some(bound) => bound.bindings(index)[0].0,
            None => {
                let from = self.layout.combed_from(root, self.spec.seed, index);
                self.sorted(root, &from, self.layout.direction(&from))[0]
            }
        }
    }

    /// Guides near a root that its hair, which is combed from another root in the direction `own`, can go with; the one most
    /// like it first.
    fn sorted(&self, root: &Root, from: &Root, own: DVec3) -> Vec<usize> {
        let near = self.near(root.position, from.position);
        // Beside a parting the nearest guide may go to the other side.
        let mut ranked: Vec<_> = near.iter().map(|&g| (self.farness(root, own, g), g)).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        ranked.into_iter().map(|(_, g)| g).collect()
    }

    /// How far (m²) a guide is from a root whose hair leaves in the direction `own`.
    fn farness(&self, root: &Root, own: DVec3, guide: usize) -> f64 {
        let against = 1.0 - own.dot(self.guides[guide].rod.root().frame().z_axis);
        // `against` is 0 for the same direction and 2 for the opposite one.
        root.position.distance_squared(self.roots[guide]) * (1.0 + AGAINST * against)
    }

    /// Guides that a hair follows, with weights that sum to one; the nearest first.
    pub(super) fn followed(&self, root: &Root, index: usize) -> Vec<(usize, f64)> {
        if let Some(bound) = self.bound {
            return bound.bindings(index).to_vec();
        }
        self.following(root, &self.layout.combed_from(root, self.spec.seed, index))
    }

    /// The same of hair that is no groom's and is combed from another root beside its own.
    pub(super) fn following(&self, root: &Root, from: &Root) -> Vec<(usize, f64)> {
        let own = self.layout.direction(from);
        let near = self.sorted(root, from, own);
        let first = near[0];
        let farness = |g: usize| self.farness(root, own, g);
        // exp(−(d² − d₀²)/(0.9 b ℓ)²) times how far the guides go the same way. docs/theory.md, "Wisps"
        let reach = (BLENDING_REACH * self.spacing * self.spec.wisps.blending).max(1e-9);
        let weight = |g: usize| {
            let excess = (farness(g) - farness(first)).max(0.0);
            (-excess / (reach * reach)).exp() * self.agreement(first, g)
        };
        let mut followed: Vec<_> = near.iter().map(|&g| (g, weight(g))).collect();
        followed.retain(|f| f.1 > LEAST_WEIGHT);
        let sum: f64 = followed.iter().map(|f| f.1).sum();
        for f in &mut followed {
            f.1 /= sum;
        }
        followed
    }

    /// Guides near a root that its hair, combed from the point `from` (m), can go with, nearest first; at least one.
    fn near(&self, root: DVec3, from: DVec3) -> Vec<usize> {
        let mut near = self.grid.nearest(root, FOLLOWED, &self.roots);
        if !self.layout.divides() {
            return near;
        }
        let nearest = near[0];
        let together = |g: &usize| !self.layout.apart(root, from, self.roots[*g]);
        near.retain(together);
        if near.is_empty() {
            near = self.grid.nearest(root, SOUGHT, &self.roots);
            near.retain(together);
            near.truncate(FOLLOWED);
        }
        if near.is_empty() { vec![nearest] } else { near }
    }

    /// The length (m) of a baby hair, none for other hair; and a factor on the diameter of the fibre.
    fn fine(&self, root: &Root, index: usize) -> (Option<f64>, f64) {
        let share = self.spec.implantation.baby_hairs;
        if share == 0.0 {
            return (None, 1.0);
        }
        let inside = self.rim.distance(root.position, BABY_RIM) / BABY_RIM;
        if inside >= 1.0 {
            return (None, 1.0);
        }
        // The share falls to none across the strip; twice as much at the line makes it the mean, up to a share of a half.
        let chance = 2.0 * share * (1.0 - inside);
        let mut random = Stream::new(self.spec.seed, Purpose::BabyHair, index);
        if random.unit() < chance {
            let length = random.between(BABY_LENGTH.0, BABY_LENGTH.1);
            let length = length * (SHORTER + (1.0 - SHORTER) * inside);
            // Those that grow before an ear do not reach into it, wherever hair is combed to.
            let before_ear = self.head.landmarks().off_ear(root.position) + INTO_EAR;
            return (Some(length.min(before_ear.max(LEAST_BABY))), THIN);
        }
        (None, THIN + (1.0 - THIN) * smooth_step(0.0, FULL / BABY_RIM, inside))
    }

    /// Whether two guides go the same way, from 1 to 0: hair beside a parting or around an ear falls
    /// on one side or the other, not in the middle.
    pub(super) fn agreement(&self, a: usize, b: usize) -> f64 {
        let (a, b) = (&self.marks[a], &self.marks[b]);
        let apart = |mark: usize| a[mark].distance(b[mark]);
        let most = apart(1).max(apart(2)).max(apart(3));
        // How many times as far apart they end as they start; a spacing is added so that neighbours may spread a little, and
        // short hair may fan out.
        let fan = FAN * a[0].distance(a[3]).min(SHORT);
        1.0 - smooth_step(AGREEING.0, AGREEING.1, most / (apart(0) + self.spacing + fan))
    }

    /// Factor on the diameter of a guide that gives a hair one of its own.
    pub(super) fn own_diameter(&self, guide: usize, index: usize) -> f64 {
        if self.bound.is_some() {
            return 1.0;
        }
        let mut random = Stream::new(self.spec.seed, Purpose::HairFibre, index);
        let mean = self.spec.fibre.section.mean_radius();
        let of_guide = self.planned[guide].rod.spec().section.mean_radius();
        mean / of_guide * random.positive(self.spec.fibre.variation)
    }
}
