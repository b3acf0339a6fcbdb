//! Where drawn strands go: the curves of their guides, transported and laid on the skin.

use glam::{DVec3, Vec3};

use super::binding::StrandBinding;
use super::gathering::{Gathering, Tier};
use super::population::Population;
use super::skin::{Free, LAID, PRESSED, below};
use super::splits::{SplitId, SplitLine, Splits};
use super::winding::Winding;
use crate::implantation::Root;
use crate::math::{Crossing, smooth_step};
use crate::wisps::{BoundStrand, BoundStrands, Place};

/// Least length (m) along which hair gathers into wisps: short hair stands by itself. Chosen by eye; not measured.
const GATHERING: f64 = 0.12;

/// Arc length (m) over which deviations grow to their full size. Chosen by eye; not measured.
const RISE: f64 = 0.06;

/// Agreement of two guides from which on hair of the one gathers to hair of the other. Chosen: the middle.
const LEAST_AGREEMENT: f64 = 0.5;

/// Arc length (m) over which the own curl of a hair departs from that of its guide. Chosen by eye; not measured.
const DEPARTING: f64 = 0.015;

/// Length (m) along which hair that would be stretched is drawn in to its guides. Chosen by eye; not measured.
const DRAWN_IN: f64 = 0.02;

/// Distance (m) between the points between which the place of a cut is searched. Chosen by trial; not measured further.
const CUT_STEP: f64 = 5e-3;
/// How far (m) before the place of a cut a hair ends at most. Chosen: a thousandth of its thickness.
const BEFORE_CUT: f64 = 5e-8;
/// How much nearer to a line a hair comes at most, as a multiple of the length that it goes on: what would be stretched more is drawn
/// in later ([`STRETCHED`]), and skin moves it aside. Chosen.
const NEARER: f64 = 2.0;

/// One drawn hair.
pub(super) struct Hair {
    pub(super) guide: u32,
    /// Factor on its diameter.
    pub(super) thickness: f64,
    /// Whether its end was cut.
    pub(super) cut: bool,
    pub(super) points: Vec<Vec3>,
}

/// Largest ratio of drawn to true length of a hair. Chosen by trial; not measured further.
const STRETCHED: f64 = 1.12;
/// Factors by which a hair that would be stretched more comes nearer to its guides, tried in order. Chosen by trial; not measured further.
const NARROWER: [f64; 4] = [0.6, 0.3, 0.1, 0.0];

/// How much longer hair may be drawn than it was cut, as a factor. Chosen: less than is seen.
const CUT_SPARE: f64 = 1.005;

/// How often a drawn hair that is still too long is shortened at most. Chosen.
const SHORTENED: usize = 4;

/// How far the hairs of a wisp have gathered at the arc length `along` (m), of hair that would be `uncut` (m) long had it never
/// been cut: what is left after a cut does not gather more. The exponent is chosen by eye.
fn gathered(along: f64, uncut: f64) -> f64 {
    smooth_step(0.0, 1.0, (along / uncut.max(GATHERING)).powf(0.8))
}

/// Where along a hair, and how wide its wisp is there.
struct HairPlace {
    /// In lengths of its guides.
    x: f64,
    /// Arc length (m).
    along: f64,
    /// How far hairs have gathered.
    gathered: f64,
    /// Factor on the distance from the guides.
    width: f64,
}

/// Length of a line (m).
fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

impl Population<'_> {
    /// The hair rooted somewhere.
    pub(super) fn hair(&self, root: &Root, index: usize) -> Hair {
        let mut binding = self.bind(root, index);
        let mut points = self.points(&binding);
        let most = STRETCHED * binding.end * binding.length;
        for narrow in NARROWER {
            if length(&points) <= most {
                break;
            }
            binding.narrow = narrow;
            points = self.points(&binding);
        }
        // Where its guides go another way, such as on both sides of an ear, it ends sooner; hair of a groom is as long as the groom has it.
        for _ in 0..SHORTENED {
            let long = length(&points);
            if long <= most || binding.own.is_some() {
                break;
            }
            binding.end *= most / long;
            points = self.points(&binding);
        }
        // What was cut to a length is no longer than that, however much it goes round its guides.
        for _ in 0..SHORTENED {
            let long = length(&points);
            if long <= CUT_SPARE * binding.most {
                break;
            }
            binding.end *= binding.most / long;
            points = self.points(&binding);
        }
        // Neither does a line between two of its points go through one.
        for _ in 0..SHORTENED {
            let Some(cut) = self.skin.lift_lines(&mut points) else { break };
            if binding.own.is_some() {
                break;
            }
            binding.end *= (cut as f64 / (points.len() - 1) as f64).max(0.1);
            points = self.points(&binding);
        }
        let points = points.into_iter().map(DVec3::as_vec3).collect();
        let StrandBinding { thickness, cut, .. } = binding;
        let thickness = thickness * self.own_diameter(binding.main(), index);
        Hair { guide: binding.main() as u32, thickness, cut, points }
    }

    fn points(&self, binding: &StrandBinding<'_>) -> Vec<DVec3> {
        let last = self.spec.wisps.points - 1;
        let mut free = Free::NOWHERE;
        (0..=last)
            .map(|k| self.point(binding, k as f64 / last as f64 * binding.end, &mut free))
            .collect()
    }

    /// Where a hair is at `x` of its guides' length.
    fn point(&self, binding: &StrandBinding<'_>, x: f64, free: &mut Free) -> DVec3 {
        if binding.own.is_none() && x <= 0.0 {
            return below(&binding.root, self.leaving(binding));
        }
        let p = self.followed_point(binding, x);
        // Hair of a groom lies as it lies; only what is in the body comes out.
        let width = match binding.own {
            Some(_) => LAID,
            None => {
                (PRESSED * self.guides[binding.main()].thickness.at(x * binding.length)).max(LAID)
            }
        };
        self.skin.lay(&binding.root, p, x * binding.length, width, free)
    }

    /// The direction (unit) in which a hair leaves the skin: that of the guides that it follows.
    fn leaving(&self, binding: &StrandBinding<'_>) -> DVec3 {
        let tangent = |g: usize| self.guides[g].rod.root().frame().z_axis;
        let mean: DVec3 = binding.followed.iter().map(|&(g, w)| tangent(g) * w).sum();
        mean.normalize_or(binding.root.normal)
    }

    /// The length (m, of dry hair) that is left of a hair when it is cut where it first comes to where `outside`, a distance (m), is
    /// positive; none if it does not.
    pub(crate) fn cut_where(
        &self,
        root: &Root,
        index: usize,
        outside: impl Fn(DVec3) -> f64,
    ) -> Option<f64> {
        let binding = self.bind(root, index);
        let StrandBinding { end, length, .. } = binding;
        let steps = (end * length / CUT_STEP).ceil().clamp(8.0, 400.0) as usize;
        let rise = NEARER * end * length / steps as f64;
        let mut free = Free::NOWHERE;
        let line = Crossing { end, steps, rise, near: BEFORE_CUT };
        let left = line.first(|x| outside(self.point(&binding, x, &mut free)))?;
        Some(left * length / self.stretch(binding.main()))
    }

    /// Point of a hair at `x` of its guides' length.
    pub(super) fn followed_point(&self, binding: &StrandBinding<'_>, x: f64) -> DVec3 {
        if let (Some(own), Some(bound)) = (&binding.own, self.bound) {
            return self.bound_point(binding, own, bound, x);
        }
        let StrandBinding { root, variation, length, planned, uncut, narrow, .. } = binding;
        let along = x * length;
        let rise = smooth_step(0.0, RISE.min(0.5 * length), along);
        let gathered = gathered(along, *uncut);
        let drifted = x * (1.0 + (variation.drift - 1.0) * rise);
        let drawn_in = 1.0 + (narrow - 1.0) * smooth_step(0.0, DRAWN_IN.min(0.5 * length), along);
        let place = HairPlace { x: drifted, along, gathered, width: drawn_in };
        let mut point = self.between(root.position, &binding.followed, &binding.winding, &place);
        // What makes a hair stray is in a lock smaller than all else: there it is held by its neighbours. The power of two is chosen.
        let mut free = 1.0;
        if let Some(to) = &binding.split {
            point = point.lerp(to.line.at(drifted), to.share(along, gathered, 1.0));
        }
        if let Some(to) = &binding.lock {
            let main = binding.main();
            let at = self.wisps[main].place(x);
            let width = drawn_in * self.narrowing(main, &at, along, gathered);
            let share = to.share(along, gathered, width);
            point = point.lerp(to.line.at(drifted), share);
            free -= share;
        }
        point + variation.waves.at(along / planned) * (rise * narrow * free * free)
    }

    /// The same, of a hair of a groom.
    ///
    /// What a hair is away from a guide is known as far as the guide was and still is; from there on it goes
    /// straight on. What has grown since stays as far away as the tip is.
    fn bound_point(
        &self,
        binding: &StrandBinding<'_>,
        own: &BoundStrand,
        bound: &BoundStrands,
        x: f64,
    ) -> DVec3 {
        let dry = x / binding.end.max(1e-12) * binding.dry;
        let (s, grown) = (dry.min(own.length()), (dry - own.length()).max(0.0));
        let at = own.at(s);
        let along = x * binding.length;
        let narrow = 1.0
            + (binding.narrow - 1.0) * smooth_step(0.0, DRAWN_IN.min(0.5 * binding.length), along);
        let mut point = binding.shift;
        for &(g, weight) in &binding.followed {
            let (now, before) = (&self.wisps[g], &bound.wisps[g]);
            // Lengths (m) of dry hair.
            let length = self.states[g].length;
            let known = before.length.min(now.end() * length);
            let (old, new) = (
                before.place(s.min(known) / before.length),
                now.place((s.min(known) + grown) / length),
            );
            let away = before.turn(&old).inverse() * (at - before.guide(&old));
            point += (now.guide(&new) + now.turned(&new, away) * narrow) * weight;
        }
        point
    }

    /// How hair rooted at a point (m) of the skin that follows `guide` most gathers to the smallest split of a tier.
    pub(super) fn gathers_to(&self, tier: Tier, p: DVec3, guide: usize) -> Option<Gathering<'_>> {
        self.gathering(tier, self.tier(tier).smallest(self.layout, p)?, guide)
    }

    fn tier(&self, tier: Tier) -> &Splits {
        match tier {
            Tier::Splits => &self.splits,
            Tier::Locks => &self.locks.splits,
        }
    }

    /// How hair that follows `guide` most gathers to the line of a split; none to one that goes another way: at the
    /// end of a parting that hair would hang half-way between both sides, before the face.
    fn gathering(&self, tier: Tier, id: SplitId, guide: usize) -> Option<Gathering<'_>> {
        let (clumping, wet) = match tier {
            Tier::Splits => (self.splits.get(id).clumping, None),
            Tier::Locks => (1.0, Some(self.locks.gathering(guide, id.level)?)),
        };
        let line = self.split_line(tier, id);
        let agreement = self.agreement(guide, line.followed);
        (agreement > LEAST_AGREEMENT).then_some(Gathering { line, most: agreement * clumping, wet })
    }

    /// The line of a split: hair rooted there, which gathers to the larger split that it is in.
    fn split_line(&self, tier: Tier, id: SplitId) -> &SplitLine {
        let splits = self.tier(tier);
        let split = splits.get(id);
        split.line.get_or_init(|| {
            let position = split.root.position;
            let larger = id.level.checked_sub(1);
            let larger = larger.and_then(|l| splits.of_level(l, self.layout, position));
            let followed = self.following(&split.root, &split.root);
            let larger = larger.and_then(|id| self.gathering(tier, id, followed[0].0));
            let larger = larger.as_ref();
            let main = larger.map_or(followed[0].0, |to| to.line.winding.main);
            let curl = larger.map_or(split.curl, |to| to.line.winding.curl.and(split.curl));
            let winding = Winding::new(main, curl);
            let mean =
                |of: &dyn Fn(usize) -> f64| followed.iter().map(|&(g, w)| w * of(g)).sum::<f64>();
            let length = mean(&|g| self.wisps[g].length);
            let uncut = mean(&|g| self.states[g].uncut);
            let planned = mean(&|g| self.planned[g].rod.length());
            let end = self.wisps[followed[0].0].end();
            // As close as if it ended with its guides.
            let samples = (end * (2 * self.spec.wisps.points.max(16)) as f64) as usize;
            let point = |k: usize| {
                let x = k as f64 / (samples - 1) as f64 * end;
                let along = x * length;
                let place = HairPlace { x, along, gathered: gathered(along, uncut), width: 1.0 };
                let mut p = self.between(position, &followed, &winding, &place);
                let mut free = 1.0;
                if let Some(to) = larger {
                    let nearest = followed[0].0;
                    let at = self.wisps[nearest].place(x);
                    let width = self.narrowing(nearest, &at, along, place.gathered);
                    let share = to.share(along, place.gathered, width);
                    p = p.lerp(to.line.at(x), share);
                    if to.wet.is_some() {
                        free -= share;
                    }
                }
                let rise = smooth_step(0.0, RISE.min(0.5 * length), along);
                (p + split.waves.at(along / planned) * (rise * free * free)).as_vec3()
            };
            let points = (0..samples).map(point).collect();
            SplitLine::new(followed[0].0, winding, end, points)
        })
    }

    /// Where (m) hair rooted at a point (m) of the skin goes that follows some guides, at a place: between their axes, with the curl
    /// of one guide, turned and widened.
    fn between(
        &self,
        root: DVec3,
        followed: &[(usize, f64)],
        winding: &Winding,
        place: &HairPlace,
    ) -> DVec3 {
        let &HairPlace { x, along, gathered, width } = place;
        let main = winding.main;
        let mut centre = DVec3::ZERO;
        let mut of_main = None;
        for &(g, weight) in followed {
            // A(x) + n(x) T(x) δ, weighted over the guides. docs/theory.md, "Wisps"
            let wisp = &self.wisps[g];
            let at = wisp.place(x);
            let axis = wisp.axis(&at);
            let across = (root - self.roots[g]) * (width * self.narrowing(g, &at, along, gathered));
            centre += (axis + wisp.turned(&at, across)) * weight;
            if g == main {
                of_main = Some((at, axis));
            }
        }
        let departed = smooth_step(0.0, DEPARTING, along);
        if departed < 1.0 {
            // Every curl begins in its follicle: what those of the guides differ by there is lost on the first centimetre.
            let begin = |g: usize| self.roots[g] - self.marks[g][0];
            let mean: DVec3 = followed.iter().map(|&(g, weight)| begin(g) * weight).sum();
            centre += (mean - begin(main)) * (1.0 - departed);
        }
        let wisp = &self.wisps[main];
        let (at, axis) = of_main.unwrap_or_else(|| {
            let at = wisp.place(x);
            (at, wisp.axis(&at))
        });
        centre + winding.turned(wisp.guide(&at) - axis, wisp.direction(&at), departed)
    }

    /// Width of a wisp at a place of it and the arc length `s` (m) of a hair, as a fraction of its patch of skin.
    fn narrowing(&self, guide: usize, at: &Place, s: f64, gathered: f64) -> f64 {
        let packed = &self.packed[guide][at.station..at.station + 2];
        let packed = packed[0] + (packed[1] - packed[0]) * at.part;
        // n from 1, the patch of skin, by the share `clumping` to the packed radius over that of the patch.
        let narrow = 1.0 + self.spec.wisps.clumping * gathered * (packed - 1.0);
        let [root, middle, tip] = self.spec.wisps.profile;
        if root == middle && middle == tip {
            return narrow * root;
        }
        let x = (s / self.states[guide].uncut).min(1.0);
        let along = if x < 0.5 {
            root + (middle - root) * 2.0 * x
        } else {
            middle + (tip - middle) * (2.0 * x - 1.0)
        };
        narrow * along
    }
}
