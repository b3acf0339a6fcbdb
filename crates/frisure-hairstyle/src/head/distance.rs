//! The signed distance to a head, smooth enough for a Newton solver.

use frisure_strands::Surface;
use glam::{DMat3, DVec3};

use super::spline::Spline;
use super::voxels::{Region, sample};

/// Signed distance to the skin (m), positive outside: a tricubic B-spline on a regular grid, and on a coarser one for the
/// torso of a head that has one.
///
/// Inside its grids it is C² and its derivatives are those of the splines themselves, so that they agree
/// with finite differences everywhere. Near smooth skin it is within 0.3 mm of the distance to the
/// mesh it was made from. Holes of the mesh are closed first: an open rim (a bust cut at the
/// shoulders) gets a lid, and what can only be reached through a slit (a mouth bag) counts as
/// inside. Outside the grids, some centimetres away from the skin, the value grows with the distance
/// to the grid; only there does the slope have a kink.
#[derive(Clone, Debug, PartialEq)]
pub struct SignedDistance {
    head: Spline,
    torso: Option<Torso>,
}

/// The part of a head below the neck.
#[derive(Clone, Debug, PartialEq)]
struct Torso {
    distance: Spline,
    /// Height (m) below which the torso's distance is the one, and the head's above [`BLEND`] more.
    below: f64,
}

/// Height over which the distance goes from the torso's to the head's (m). Chosen: a tenth of a neck's width per grid cell,
/// so that their differences, below 0.3 mm, make slopes of less than 0.02.
const BLEND: f64 = 0.03;

/// Room below and above the blend that both parts of a mesh cover (m): within it the nearest skin is in either part.
/// Chosen.
const ROOM: f64 = 0.045;

impl SignedDistance {
    /// Samples the distance to `surface` (m) on a grid of about 3 mm: near the skin here, elsewhere where it is asked for.
    ///
    /// Larger meshes get a wider spacing, so that memory stays below 40 MB, and below 100 MB where all places are asked for.
    #[must_use]
    pub fn new(surface: &Surface) -> Self {
        Self { head: Spline::through(sample(surface, &Region::whole(surface))), torso: None }
    }

    /// The same with a coarser grid for what is lower than `neck` (m), the lower end of the neck.
    ///
    /// The box of the fine grid is that of `frame` (smallest and largest corner, m), or of the mesh above the neck.
    pub(crate) fn with_torso(surface: &Surface, neck: f64, frame: Option<(DVec3, DVec3)>) -> Self {
        let below = neck - BLEND;
        let head = Region::above(surface, below - ROOM, frame);
        let torso = Region::below(surface, neck + ROOM);
        let (head, torso) = rayon::join(
            || Spline::through(sample(surface, &head)),
            || Spline::through(sample(surface, &torso)),
        );
        Self { head, torso: Some(Torso { distance: torso, below }) }
    }

    /// Distance between neighbouring nodes of the grid about the head (m).
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.head.spacing()
    }

    /// Smallest and largest corner of the box around the grids (m).
    #[must_use]
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let (low, high) = self.head.bounds();
        match &self.torso {
            None => (low, high),
            Some(torso) => {
                let (torso_low, torso_high) = torso.distance.bounds();
                (low.min(torso_low), high.max(torso_high))
            }
        }
    }

    /// Signed distance (m) at `p` (m), positive outside.
    #[must_use]
    pub fn value(&self, p: DVec3) -> f64 {
        match self.share(p) {
            (None, _) => self.head.value(p),
            (Some(torso), [0.0, ..]) => torso.distance.value(p),
            (Some(torso), [share, ..]) => {
                let (a, b) = (self.head.value(p), torso.distance.value(p));
                b + share * (a - b)
            }
        }
    }

    /// False only if [`Self::value`] at `p` (m) is larger than `distance` (m). A bound: it takes a fraction of the time.
    #[inline]
    pub(crate) fn may_be_nearer(&self, p: DVec3, distance: f64) -> bool {
        match self.share(p) {
            (None, _) => self.head.may_be_nearer(p, distance),
            (Some(torso), [0.0, ..]) => torso.distance.may_be_nearer(p, distance),
            // Between two distances, one of which is not larger then.
            (Some(torso), _) => {
                self.head.may_be_nearer(p, distance) || torso.distance.may_be_nearer(p, distance)
            }
        }
    }

    /// Signed distance (m) at `p` (m) and its gradient.
    #[must_use]
    pub fn value_gradient(&self, p: DVec3) -> (f64, DVec3) {
        match self.share(p) {
            (None, _) => self.head.value_gradient(p),
            (Some(torso), [0.0, ..]) => torso.distance.value_gradient(p),
            (Some(torso), [share, slope, _]) => {
                let (a, ga) = self.head.value_gradient(p);
                let (b, gb) = torso.distance.value_gradient(p);
                (b + share * (a - b), gb + share * (ga - gb) + slope * (a - b) * DVec3::Z)
            }
        }
    }

    /// Signed distance (m) at `p` (m), its gradient and its Hessian (1/m).
    #[must_use]
    pub fn value_gradient_hessian(&self, p: DVec3) -> (f64, DVec3, DMat3) {
        match self.share(p) {
            (None, _) => self.head.value_gradient_hessian(p),
            (Some(torso), [0.0, ..]) => torso.distance.value_gradient_hessian(p),
            (Some(torso), [share, slope, bend]) => {
                let (a, ga, ha) = self.head.value_gradient_hessian(p);
                let (b, gb, hb) = torso.distance.value_gradient_hessian(p);
                // φ = b + w (a − b) with w of z: the product rule.
                let (gap, turn) = (a - b, slope * (ga - gb));
                let cross =
                    DMat3::from_cols(turn.x * DVec3::Z, turn.y * DVec3::Z, turn.z * DVec3::Z);
                let mut hessian = hb + (ha - hb) * share + cross + cross.transpose();
                hessian.z_axis.z += bend * gap;
                (b + share * gap, gb + share * (ga - gb) + slope * gap * DVec3::Z, hessian)
            }
        }
    }

    /// The torso where it matters, and the head's share of the distance with its first two derivatives by height (1/m, 1/m²).
    fn share(&self, p: DVec3) -> (Option<&Torso>, [f64; 3]) {
        let Some(torso) = &self.torso else { return (None, [1.0, 0.0, 0.0]) };
        let t = (p.z - torso.below) / BLEND;
        if t >= 1.0 {
            return (None, [1.0, 0.0, 0.0]);
        }
        let t = t.max(0.0);
        // t³ (10 − 15t + 6t²), whose first two derivatives vanish at both ends.
        let share = t * t * t * (10.0 - t * (15.0 - 6.0 * t));
        let slope = 30.0 * t * t * (1.0 - t) * (1.0 - t) / BLEND;
        let bend = 60.0 * t * (1.0 - t) * (1.0 - 2.0 * t) / (BLEND * BLEND);
        (Some(torso), [share, slope, bend])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::{ball, mannequin, open_ball_with_bag};
    use crate::head::triangles::closest_point;

    #[test]
    fn the_distance_to_a_ball_is_accurate() {
        let field = SignedDistance::new(&ball(0.08, 64));
        for i in 0..200 {
            let a = f64::from(i);
            let d = DVec3::new(a.sin(), (1.7 * a).cos(), (0.3 * a).sin()).normalize();
            for r in [0.03, 0.06, 0.078, 0.08, 0.083, 0.1, 0.115] {
                let (v, g) = field.value_gradient(d * r);
                assert!((v - (r - 0.08)).abs() < 1e-4, "{v} at {r}");
                assert!((g - d).length() < 0.02, "{g} at {d}");
            }
        }
        assert!(field.value(DVec3::ZERO) < -0.07);
    }

    #[test]
    fn derivatives_agree_with_differences_inside_and_outside_the_grid() {
        let field = SignedDistance::new(&ball(0.08, 32));
        let about = |a: f64| DVec3::new(a.sin(), (1.7 * a).cos(), (0.3 * a).sin());
        check_derivatives(&field, |a| about(a) * (0.01 + 0.01 * a));
        // In the torso, in the neck's blend, and beside both.
        let low = DVec3::new(0.0, 0.02, -0.3);
        check_derivatives(mannequin().signed_distance(), |a| low + 0.2 * about(a));
        let blend = DVec3::new(0.0, 0.02, -0.181);
        check_derivatives(mannequin().signed_distance(), |a| {
            blend + about(a) * DVec3::new(0.2, 0.1, 0.014)
        });
    }

    fn check_derivatives(field: &SignedDistance, place: impl Fn(f64) -> DVec3) {
        let h = 1e-6;
        for i in 0..60 {
            let p = place(f64::from(i) + 0.5);
            let (value, gradient, hessian) = field.value_gradient_hessian(p);
            assert_eq!((value, gradient), field.value_gradient(p));
            assert!((value - field.value(p)).abs() < 1e-12);
            assert!(field.may_be_nearer(p, value));
            // The bound is about as far below as a block is wide.
            assert!(!field.may_be_nearer(p, value - 0.06), "{value} at {p}");
            for axis in 0..3 {
                let e = DVec3::AXES[axis] * h;
                let (up, gu) = field.value_gradient(p + e);
                let (down, gd) = field.value_gradient(p - e);
                assert!(((up - down) / (2.0 * h) - gradient[axis]).abs() < 1e-6);
                let bend = (gu - gd) / (2.0 * h);
                assert!((bend - hessian.col(axis)).length() < 1e-3, "{bend} {}", hessian.col(axis));
            }
        }
    }

    #[test]
    fn the_torso_is_as_far_as_its_triangles() {
        let (field, surface) = (mannequin().signed_distance(), mannequin().surface());
        let exact = |p: DVec3| {
            let faces = 0..surface.triangles().len();
            let gaps = faces.map(|f| closest_point(p, surface.corners(f)).distance(p));
            gaps.fold(f64::INFINITY, f64::min)
        };
        // From the skin of chest, back, shoulder and neck outwards.
        for (x, forward, z) in [
            (0.05, 0.2, -0.30),
            (0.08, -0.2, -0.28),
            (0.3, -0.03, -0.23),
            (0.1, -0.2, -0.2),
            (0.02, -0.2, -0.17),
            (0.09, 0.0, -0.16),
        ] {
            let middle = DVec3::new(0.5 * x, 0.01, z);
            let out = DVec3::new(x, -forward, z);
            let places = (0..40).map(|step| middle.lerp(out, f64::from(step) / 40.0));
            for p in places.filter(|p| field.value(*p) > -5e-3) {
                let (found, gap) = (field.value(p).abs(), exact(p));
                // Beside the boxes of the grids the distance is an estimate.
                let most = match gap {
                    near if near < 0.02 => 5e-4,
                    near if near < 0.06 => 2e-3,
                    _ => 1e-2,
                };
                assert!((found - gap).abs() < most, "{found}, not {gap}, at {p}");
            }
        }
    }

    #[test]
    fn distances_are_the_same_in_any_order_and_on_any_number_of_threads() {
        use rayon::prelude::*;
        let [first, second] = [(); 2].map(|()| SignedDistance::new(&open_ball_with_bag()));
        let (low, high) = first.bounds();
        let place = |n: u32| {
            let at = DVec3::new(0.618, 0.414, 0.732) * f64::from(n);
            low + (high - low) * (at - at.floor())
        };
        let values: Vec<f64> = (0..3000).map(|n| first.value(place(n))).collect();
        // A copy has what was computed before, and an equal one nothing.
        assert!(first == second && first.clone() == second);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(5).build().unwrap();
        let on_threads = |field: &SignedDistance| -> Vec<f64> {
            pool.install(|| {
                (0..3000).into_par_iter().rev().map(|n| field.value(place(n))).collect()
            })
        };
        for field in [&second, &first.clone()] {
            assert!(on_threads(field).iter().rev().eq(&values));
        }
        assert_ne!(first, SignedDistance::new(&ball(0.08, 16)));
    }

    #[test]
    fn an_open_mesh_with_an_inner_bag_is_solid() {
        let field = SignedDistance::new(&open_ball_with_bag());
        assert!(field.value(DVec3::ZERO) < -0.03, "{}", field.value(DVec3::ZERO));
        let below = field.value(DVec3::new(0.0, 0.0, -0.1));
        assert!(below > 0.02, "below the open rim is outside: {below}");
        // Where the bag is: deeper than its wall by far.
        let bag = field.value(DVec3::new(0.0, -0.05, 0.0));
        assert!((bag + 0.03).abs() < 3e-3, "{bag}");
        assert!(field.value(DVec3::new(0.0, -2.0, 0.0)) > 1.8);
    }
}
