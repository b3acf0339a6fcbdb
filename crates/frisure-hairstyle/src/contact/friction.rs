//! Friction of a guide against what it lies on: anchored springs that slip (Cundall & Strack 1979).
//!
//! docs/theory.md, "Friction"

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

use crate::math::outer;

/// Distance δ (m) that a point moves from its anchor before it slips. Chosen: below what can be seen (a hair is 0.07 mm
/// thick), and large enough that Newton's method sees the stick as a spring of less than the stiffness of skin.
pub(crate) const SLIP_DISTANCE: f64 = 5e-5;

/// Share of the mean friction limit of a guide below which a point does not count in [`FrictionGap::ratio`]: where contact
/// begins and ends the limit goes to zero, and a ratio to it says nothing.
const LIGHT: f64 = 0.01;

/// What hair rubs against.
pub trait FrictionSurface: Sync {
    /// How a piece of hair at arc length `s` (m) and position `p` (m, world) is pressed on the surface; `None` where it does
    /// not touch it, or the surface has no friction.
    fn pressed(&self, s: f64, p: DVec3) -> Option<Pressed>;

    /// Friction of hair that goes on it towards its tip, against its scales, over that towards its root; 1 without scales.
    fn against_scales(&self) -> f64 {
        1.0
    }
}

/// The scales of a hair at one of its points, which lie towards its tip: where hair goes the way of its tip over something, that rubs
/// them up, and there is more friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales {
    /// Direction (unit) towards the tip.
    along: DVec3,
    /// Friction against the scales over that along them, squared, less 1.
    excess: f64,
}

impl Scales {
    /// No scales.
    pub(crate) const NONE: Self = Self { along: DVec3::ZERO, excess: 0.0 };

    /// Those of a hair that goes towards its tip `along` (unit), with so much more friction against them.
    pub(crate) fn new(along: DVec3, against: f64) -> Self {
        Self { along, excess: against * against - 1.0 }
    }

    /// `share` of them.
    pub(crate) fn weighed(self, share: f64) -> Self {
        Self { excess: self.excess * share, ..self }
    }

    /// The same, of the other of two hairs that go over each other.
    pub(crate) fn of_other(self) -> Self {
        Self { along: -self.along, ..self }
    }

    /// What they add to the square of a way `u` (m), half of its gradient (m), and the vector of which half of its second
    /// derivative is the outer square.
    fn add(self, u: DVec3) -> (f64, DVec3, DVec3) {
        let forth = u.dot(self.along);
        if forth <= 0.0 {
            return (0.0, DVec3::ZERO, DVec3::ZERO);
        }
        let gradient = self.along * (self.excess * forth);
        (self.excess * forth * forth, gradient, self.along * self.excess.sqrt())
    }
}

/// The way from an anchor as friction measures it: what goes against scales counts for longer, N² = |u|² + Σ e max(0, u·t)², so that the
/// most friction is that of the direction. (F5)
pub(crate) struct Way {
    /// N (m).
    pub(crate) length: f64,
    /// ½ ∇N² (m).
    rise: DVec3,
    /// Vectors c of ½ ∇²N² = I + Σ c cᵀ.
    pub(crate) ridges: [DVec3; 2],
}

impl Way {
    pub(crate) fn new(u: DVec3, scales: [Scales; 2]) -> Self {
        let [(a, p, c), (b, q, d)] = scales.map(|scales| scales.add(u));
        Self { length: (u.length_squared() + a + b).sqrt(), rise: u + p + q, ridges: [c, d] }
    }

    /// H(N) (m): a spring up to `slip` (m), then as far as it goes. (F1)
    pub(crate) fn energy(&self, slip: f64) -> f64 {
        let n = self.length;
        if n < slip { 0.5 * n * n / slip } else { n - 0.5 * slip }
    }

    /// ∇H(N).
    pub(crate) fn force(&self, slip: f64) -> DVec3 {
        self.rise / self.length.max(slip)
    }

    /// H′(N): how much of the most friction is used.
    pub(crate) fn used(&self, slip: f64) -> f64 {
        (self.length / slip).min(1.0)
    }

    /// ∇²H(N) as s (I + Σ c cᵀ) − b bᵀ with the ridges c: s (1/m), and b (m^−½).
    pub(crate) fn stiffness(&self, slip: f64) -> (f64, DVec3) {
        let n = self.length;
        if n < slip {
            return (1.0 / slip, DVec3::ZERO);
        }
        // What slips keeps the size of its force: no stiffness along the way.
        (1.0 / n, self.rise / (n * n.sqrt()))
    }
}

/// Directions (unit) of a line of points towards its tip, which begins at its second point.
pub(super) fn directions(points: &[DVec3]) -> Vec<DVec3> {
    let last = points.len().saturating_sub(1);
    let at = |k: usize| points[(k + 1).min(last)] - points[k.saturating_sub(1)];
    (0..points.len()).map(|k| at(k).normalize_or_zero()).collect()
}

/// A piece of hair that is pressed on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressed {
    /// Normal of the surface (unit).
    pub normal: DVec3,
    /// Largest friction μ λ_n per length of hair (N/m) along the scales: the coefficient times the normal force per length.
    pub limit: f64,
}

/// Friction of one guide, as an energy per length of hair while normal and limit are fixed.
///
/// At a distance u along the surface from its anchor a point pays `μλ u²/2δ` up to u = δ and `μλ (u − δ/2)` beyond: it
/// sticks as a spring, then slips at the force μλ (F1). Between steps of the load anchors follow what has slipped (F2),
/// normals and limits follow the shape until both agree (F3). Points are those of
/// [`frisure_rod::Chain::sample_points`]; the field must be evaluated there.
#[derive(Clone, Debug)]
pub(crate) struct Friction {
    /// Distance between points along the guide (m).
    spacing: f64,
    points: Vec<FrictionPoint>,
}

#[derive(Clone, Copy, Debug)]
struct FrictionPoint {
    /// Where it stuck (m).
    anchor: DVec3,
    /// Normal of the surface (unit).
    normal: DVec3,
    /// μ λ_n (N/m); 0 off the surface.
    limit: f64,
    /// Scales along the surface.
    scales: Scales,
}

impl FrictionPoint {
    /// How far the surface has moved under a point (m): the tangential part of the way from its anchor.
    fn slid(&self, p: DVec3) -> DVec3 {
        let away = p - self.anchor;
        away - self.normal * self.normal.dot(away)
    }

    /// The way from its anchor.
    fn way(&self, p: DVec3) -> Way {
        Way::new(self.slid(p), [self.scales, Scales::NONE])
    }
}

impl Friction {
    /// A guide that sticks where its points (m), `spacing` (m) apart, are: no force yet.
    pub(crate) fn stuck_at(points: &[DVec3], spacing: f64) -> Self {
        let (normal, limit, scales) = (DVec3::Z, 0.0, Scales::NONE);
        let stuck = |&anchor: &DVec3| FrictionPoint { anchor, normal, limit, scales };
        Self { spacing, points: points.iter().map(stuck).collect() }
    }

    /// Arc length (m) of point `k`.
    fn arc(&self, k: usize) -> f64 {
        (k + 1) as f64 * self.spacing
    }

    /// Takes over how the surface is pressed where points are now; returns how far the forces of friction are from the law
    /// there (F3).
    pub(crate) fn press(&mut self, surface: &dyn FrictionSurface, points: &[DVec3]) -> FrictionGap {
        let against = surface.against_scales();
        let along = directions(points);
        let now = |(k, &p): (usize, &DVec3)| surface.pressed(self.arc(k), p);
        let now: Vec<Option<Pressed>> = points.iter().enumerate().map(now).collect();
        let limit = |pressed: &Option<Pressed>| pressed.map_or(0.0, |pressed| pressed.limit);
        let total: f64 = now.iter().map(limit).sum();
        let light = LIGHT * total / now.len() as f64;
        let mut gap = FrictionGap { limit: total * self.spacing, ..FrictionGap::default() };
        for (((held, &p), pressed), along) in
            self.points.iter_mut().zip(points).zip(&now).zip(along)
        {
            let (used, limit) = (held.limit * held.way(p).used(SLIP_DISTANCE), limit(pressed));
            gap.change += (held.limit - limit).abs() * self.spacing;
            if limit > light {
                gap.ratio = gap.ratio.max(used / limit);
            }
            if held.limit == 0.0 && limit > 0.0 {
                // It touches down here: it sticks where it touched.
                held.anchor = p;
            }
            held.limit = limit;
            if let Some(Pressed { normal, .. }) = *pressed {
                held.normal = normal;
                let along = (along - normal * normal.dot(along)).normalize_or_zero();
                held.scales = Scales::new(along, against);
            }
        }
        gap
    }

    /// Lets the anchors of points that slipped follow them, and those off the surface go along. (F2)
    pub(crate) fn slip(&mut self, points: &[DVec3]) {
        for (held, &p) in self.points.iter_mut().zip(points) {
            let way = held.way(p).length;
            if held.limit == 0.0 {
                held.anchor = p;
            } else if way > SLIP_DISTANCE {
                held.anchor = p - held.slid(p) * (SLIP_DISTANCE / way);
            }
        }
    }

    fn at(&self, s: f64) -> &FrictionPoint {
        // Rounding finds the point at s again; point 0 is one spacing from the root.
        let k = ((s / self.spacing).round() as usize).clamp(1, self.points.len());
        &self.points[k - 1]
    }
}

impl Field for Friction {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        let point = self.at(s);
        point.limit * point.way(p).energy(SLIP_DISTANCE)
    }

    fn derivatives(&self, s: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let point = self.at(s);
        if point.limit == 0.0 {
            return None;
        }
        let (way, n) = (point.way(p), point.normal);
        let (s, b) = way.stiffness(SLIP_DISTANCE);
        let [c, d] = way.ridges;
        let along = DMat3::IDENTITY - outer(n, n) + outer(c, c) + outer(d, d);
        let stiffness = along * s - outer(b, b);
        Some((way.force(SLIP_DISTANCE) * point.limit, stiffness * point.limit))
    }
}

/// How far the forces of friction are from the law at a shape.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FrictionGap {
    /// Largest |f_t| / μ f_n of any point that is pressed with more than [`LIGHT`] of the mean.
    pub(crate) ratio: f64,
    /// Change of the limits since the shape was sought, summed along the guide (N).
    pub(crate) change: f64,
    /// Friction that the present normal forces allow, summed along the guide (N).
    pub(crate) limit: f64,
}

impl FrictionGap {
    /// That of two surfaces together.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            ratio: self.ratio.max(other.ratio),
            change: self.change + other.change,
            limit: self.limit + other.limit,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::test_field::agrees_with_differences;

    /// A surface with a fixed normal and limit.
    struct Plate(Pressed);

    impl FrictionSurface for Plate {
        fn pressed(&self, _: f64, _: DVec3) -> Option<Pressed> {
            Some(self.0)
        }
    }

    const LIMIT: f64 = 3e-4;

    fn plate() -> Plate {
        Plate(Pressed { normal: DVec3::new(0.6, 0.0, 0.8), limit: LIMIT })
    }

    fn held() -> Friction {
        let mut friction = Friction::stuck_at(&[DVec3::X, DVec3::Y], 0.1);
        friction.press(&plate(), &[DVec3::X, DVec3::Y]);
        friction
    }

    #[test]
    fn derivatives_agree_with_differences() {
        for away in [DVec3::new(1e-5, 2e-5, -1e-5), DVec3::new(2e-3, -1e-3, 1e-3)] {
            agrees_with_differences(&held(), 0.1, DVec3::X + away);
        }
    }

    #[test]
    fn force_is_along_the_surface_and_at_most_the_limit() {
        let (friction, normal) = (held(), plate().0.normal);
        for scale in [1e-6, 1e-4, 1.0] {
            let away = DVec3::new(0.3, 0.5, -0.2) * scale;
            let (force, _) = friction.derivatives(0.2, DVec3::Y + away).unwrap();
            assert!(force.dot(normal).abs() < 1e-12 * force.length());
            assert!(force.length() <= LIMIT * (1.0 + 1e-12));
            assert!(force.dot(away) > 0.0, "the gradient is against the way back");
        }
    }

    #[test]
    fn anchors_of_points_that_slipped_follow_at_the_slip_distance() {
        let mut friction = held();
        let across = DVec3::Y;
        let moved = [DVec3::X + across * 3e-3, DVec3::Y + across * 2e-5];
        let force =
            |friction: &Friction, k: usize| friction.points[k].way(moved[k]).force(SLIP_DISTANCE);
        let before = [0, 1].map(|k| force(&friction, k));
        friction.slip(&moved);
        for k in [0, 1] {
            assert!(force(&friction, k).distance(before[k]) < 1e-12);
        }
        assert!(friction.points[0].anchor.distance(moved[0]) < SLIP_DISTANCE * (1.0 + 1e-9));
        assert_eq!(friction.points[1].anchor, DVec3::Y, "what sticks keeps its anchor");
    }
}
