//! Where hair is cut.

use frisure_rod::Equilibrium;
use glam::DVec3;

use super::cut_line::{CutLine, Held};
use crate::head::Head;
use crate::implantation::Root;
use crate::math::Crossing;

/// A cut on a head.
pub(super) struct Scissors<'a> {
    head: &'a Head,
    line: CutLine,
    held: Held,
}

/// Least length (m) that a cut leaves of a wisp. Chosen.
const LEAST: f64 = 1e-3;

/// How far (m) from a line off the skin is on it.
const ON_LINE: f64 = 1e-9;

/// Points (per guide) between which a line is looked for. Chosen: two crossings within a piece are missed.
const LOOKED_AT: usize = 256;

/// How far (m) before the line a guide is cut at most: rounding.
const BEFORE_LINE: f64 = 1e-13;

impl<'a> Scissors<'a> {
    pub(super) fn new(line: CutLine, held: Held, head: &'a Head) -> Self {
        let line = match line {
            CutLine::Below(height) => {
                CutLine::Plane { point: DVec3::Z * height.on(head), normal: DVec3::NEG_Z }
            }
            CutLine::Plane { point, normal } => {
                CutLine::Plane { point, normal: normal.normalize_or(DVec3::NEG_Z) }
            }
            line => line,
        };
        Self { head, line, held }
    }

    /// Whether hair is cut as it hangs: by its curve, not by its root.
    pub(super) fn hanging(&self) -> bool {
        let held = matches!(self.line, CutLine::Length(_) | CutLine::Gathered(_));
        self.held == Held::Hanging && !held
    }

    /// How far (m) a point is beyond the line; negative before it.
    pub(super) fn beyond(&self, p: DVec3) -> f64 {
        match self.line {
            CutLine::Plane { point, normal } => (p - point).dot(normal),
            CutLine::Sphere { centre, radius } => p.distance(centre) - radius,
            CutLine::OffSkin(distance) => self.head.signed_distance().value(p) - distance,
            CutLine::Below(_) | CutLine::Length(_) | CutLine::Gathered(_) => f64::NEG_INFINITY,
        }
    }

    /// How much (m) is left of hair that is held straight from its root; infinite where the line is
    /// never met, nothing where the root is beyond it.
    pub(super) fn left_straight(&self, root: &Root) -> f64 {
        let from = root.position;
        match self.line {
            CutLine::Length(length) => return length,
            CutLine::Gathered(point) => return from.distance(point),
            _ => {}
        }
        let gone = self.beyond(from);
        if gone >= 0.0 {
            return 0.0;
        }
        let way = self.way(root);
        match self.line {
            CutLine::Plane { normal, .. } => {
                let rate = way.dot(normal);
                if rate > 0.0 { -gone / rate } else { f64::INFINITY }
            }
            CutLine::Sphere { centre, radius } => {
                // |from + t way − centre| = radius, from inside.
                let (b, c) = ((from - centre).dot(way), (from - centre).length_squared());
                (b * b - c + radius * radius).max(0.0).sqrt() - b
            }
            _ => self.march(from, way),
        }
    }

    /// The direction (unit) in which hair is held.
    fn way(&self, root: &Root) -> DVec3 {
        let Held::Elevated(angle) = self.held else { return DVec3::NEG_Z };
        let down = DVec3::NEG_Z + root.normal * root.normal.z;
        let away = root.position - self.head.landmarks().cranium_centre;
        let away = away - root.normal * root.normal.dot(away);
        // At the vertex, down is any way off it.
        let flat = down.try_normalize().or(away.try_normalize()).unwrap_or(DVec3::Y);
        flat * angle.cos() + root.normal * angle.sin()
    }

    /// Length (m) of a straight way to a line off the skin: what is so far from it can go so far.
    fn march(&self, from: DVec3, way: DVec3) -> f64 {
        // Sphere tracing: what is so far from the line can go so far. 10 000 steps and 10 m are guards.
        let mut gone = 0.0;
        for _ in 0..10_000 {
            let before = -self.beyond(from + way * gone);
            if before <= ON_LINE {
                return gone;
            }
            gone += before;
            if gone > 10.0 {
                break;
            }
        }
        f64::INFINITY
    }

    /// How far (m) beyond the line a guide reaches as it hangs; negative if all of it is before the line.
    pub(super) fn reach(&self, guide: &Equilibrium) -> f64 {
        let chain = guide.chain();
        let beyond = |k: usize| self.beyond(guide.at(&chain, k as f64 / LOOKED_AT as f64).0);
        (0..=LOOKED_AT).map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }

    /// How much (m) is left of a guide as it hangs.
    pub(super) fn left_hanging(&self, guide: &Equilibrium) -> f64 {
        let chain = guide.chain();
        let length = guide.rod.length();
        // An inextensible rod comes no nearer to the line than it goes on.
        let rise = length / LOOKED_AT as f64;
        let line = Crossing { end: 1.0, steps: LOOKED_AT, rise, near: BEFORE_LINE };
        let left = line.first(|x| self.beyond(guide.at(&chain, x).0));
        left.map_or(f64::INFINITY, |left| left * length)
    }
}

/// Whether so much (m) is enough to be a wisp.
pub(super) fn enough(left: f64) -> bool {
    left >= LEAST
}
