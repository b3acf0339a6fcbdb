//! Where drawn strands go: the curves of their guides, transported and laid on the skin.

use glam::{DVec3, Vec3};

use super::binding::StrandBinding;
use super::population::Population;
use super::skin::{Free, LAID, PRESSED};
use crate::implantation::Root;
use crate::math::{first_positive, smooth_step};
use crate::wisps::{BoundStrand, BoundStrands};

/// Least length (m) along which hair gathers into wisps: stubble stands by itself. Chosen by eye; not measured.
const GATHERING: f64 = 0.06;

/// How much of the way to the middle of its split a hair has come at the tip. Chosen by eye; not measured.
const GATHERED: f64 = 0.75;

/// Length (m) along which hair that would be stretched is drawn in to its guides. Chosen by eye; not measured.
const DRAWN_IN: f64 = 0.02;

/// Distance (m) between the points between which the place of a cut is searched. Chosen by trial; not measured further.
const CUT_STEP: f64 = 5e-3;
/// How often the piece between two such points is halved: to a millionth of it.
const HALVINGS: u32 = 20;

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

/// Length of a line (m).
fn length(points: &[Vec3]) -> f64 {
    points.windows(2).map(|pair| f64::from(pair[0].distance(pair[1]))).sum()
}

impl Population<'_> {
    /// The hair rooted somewhere.
    pub(super) fn hair(&self, root: &Root, index: usize) -> Hair {
        let mut binding = self.bind(root, index);
        let mut points = self.points(&binding);
        for narrow in NARROWER {
            if length(&points) <= STRETCHED * binding.end * binding.length {
                break;
            }
            binding.narrow = narrow;
            points = self.points(&binding);
        }
        let StrandBinding { thickness, cut, .. } = binding;
        Hair { guide: binding.main() as u32, thickness, cut, points }
    }

    fn points(&self, binding: &StrandBinding<'_>) -> Vec<Vec3> {
        let last = self.spec.wisps.points - 1;
        let mut free = Free::NOWHERE;
        (0..=last)
            .map(|k| self.point(binding, k as f64 / last as f64 * binding.end, &mut free).as_vec3())
            .collect()
    }

    /// Where a hair is at `x` of its guides' length.
    fn point(&self, binding: &StrandBinding<'_>, x: f64, free: &mut Free) -> DVec3 {
        let p = self.followed_point(binding, x);
        if binding.own.is_some() && x <= 0.0 {
            return p;
        }
        // Hair of a groom lies as it lies; only what is in the body comes out.
        let width = match binding.own {
            Some(_) => LAID,
            None => {
                (PRESSED * self.guides[binding.main()].thickness.at(x * binding.length)).max(LAID)
            }
        };
        self.skin.lay(&binding.root, p, x * binding.length, width, free)
    }

    /// The length (m, of dry hair) that is left of a hair when it is cut where it first comes to
    /// where `outside` is positive; none if it does not.
    pub(crate) fn cut_where(
        &self,
        root: &Root,
        index: usize,
        outside: impl Fn(DVec3) -> f64,
    ) -> Option<f64> {
        let binding = self.bind(root, index);
        let steps = (binding.end * binding.length / CUT_STEP).ceil().clamp(8.0, 400.0) as usize;
        let at = |x: f64| outside(self.point(&binding, x, &mut { Free::NOWHERE }));
        let left = first_positive(binding.end, steps, HALVINGS, at)?;
        Some(left / binding.end * binding.dry)
    }

    /// Point of a hair at `x` of its guides' length.
    pub(super) fn followed_point(&self, binding: &StrandBinding<'_>, x: f64) -> DVec3 {
        if let (Some(own), Some(bound)) = (&binding.own, self.bound) {
            return self.bound_point(binding, own, bound, x);
        }
        let StrandBinding {
            root, followed, variation, split, length, planned, uncut, narrow, ..
        } = binding;
        let along = x * length;
        let rise = smooth_step(0.0, 0.06_f64.min(0.5 * length), along);
        // How far the wisp has gathered, by the length that it would have uncut: what is left after a cut does not gather
        // more. The exponent 0.8 and the 6 cm over which deviations rise are chosen by eye.
        let gathered = smooth_step(0.0, 1.0, (along / uncut.max(GATHERING)).powf(0.8));
        let drifted = x * (1.0 + (variation.drift - 1.0) * rise);
        let mut transported = variation.waves.at(along / planned) * (rise * narrow);
        let drawn_in = 1.0 + (narrow - 1.0) * smooth_step(0.0, DRAWN_IN.min(0.5 * length), along);
        for (rank, &(g, weight)) in followed.iter().enumerate() {
            // C(x) + n(x) T(x) δ, weighted over the guides. docs/theory.md, "Wisps"
            let (centre, turn) = self.wisps[g].at(drifted);
            let mut place = root.position - self.roots[g];
            if rank == 0
                && let Some(split) = split
            {
                // The split belongs to the first wisp alone; over its weight, all of the hair follows it.
                place += (split.middle - place) * (GATHERED * gathered / weight);
                transported += split.waves.at(along / planned) * (rise * narrow);
            }
            transported +=
                (centre + turn * place * (drawn_in * self.narrowing(g, along, gathered))) * weight;
        }
        transported
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
        let mut point = DVec3::ZERO;
        for &(g, weight) in &binding.followed {
            let (now, before) = (&self.wisps[g], &bound.wisps[g]);
            // Lengths (m) of dry hair.
            let length = self.states[g].length;
            let known = before.length.min(now.end() * length);
            let (old, turned) = before.at(s.min(known) / before.length);
            let (new, turn) = now.at((s.min(known) + grown) / length);
            point += (new + turn * (turned.inverse() * (at - old)) * narrow) * weight;
        }
        point
    }

    /// Width of a wisp at arc length `s` (m), as a fraction of its patch of skin.
    fn narrowing(&self, guide: usize, s: f64, gathered: f64) -> f64 {
        let packed = self.guides[guide].thickness.packed(s) / self.patch;
        let [root, middle, tip] = self.spec.wisps.profile;
        let x = (s / self.states[guide].uncut).min(1.0);
        let along = if x < 0.5 {
            root + (middle - root) * 2.0 * x
        } else {
            middle + (tip - middle) * (2.0 * x - 1.0)
        };
        // n from 1, the patch of skin, by the share `clumping` to the packed radius over that of the patch.
        (1.0 + self.spec.wisps.clumping * gathered * (packed - 1.0)) * along
    }
}
