//! The way of a ray through a section of the fibre: where each lobe leaves, what each surface
//! reflects, how far it is through the inside.
//!
//! Seen along its axis, a ray of inclination θ bends as in two dimensions with the index
//! η' = √(η² − sin²θ)/cos θ (Bravais); Fresnel's reflectance is that of the angles in space. For an
//! ellipse every surface is met at an angle of its own, and total reflection inside is possible.

use core::f32::consts::PI;

use glam::{Vec2, Vec2Swizzles, Vec4};

use super::elementary::atan2;
use super::film::{fresnel, reflectance};

/// What becomes of one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// Azimuth at which R, TT and TRT leave (rad, any turn); of no meaning where all is reflected, nor
    /// the fourth.
    pub(super) azimuth: Vec4,
    /// Reflectance where the ray enters and where it meets the surface from inside, three times.
    pub(super) fresnel: Vec4,
    /// Length of the first three ways through the inside, in mean radii; the fourth counts for nothing.
    pub(super) chord: Vec4,
}

/// A ray before it meets the fibre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incident {
    /// Unit direction to where it comes from, in the section (x along d1, y along d2).
    pub(super) towards: Vec2,
    /// Its offset h across the projected width, −1 to 1.
    pub(super) offset: f32,
    /// cos θ outside.
    pub(super) cosine: f32,
    /// cos θ inside.
    pub(super) inner_cosine: f32,
    /// Relative index of the inside.
    pub(super) index: f32,
    /// 0 dry, 1 under a full film of water.
    pub(super) wetness: f32,
}

impl Incident {
    /// 1/η', which stays finite along the fibre.
    fn inverse_index(&self) -> f32 {
        self.cosine / (self.index * self.inner_cosine)
    }

    /// cos γ where the ray meets a circle.
    fn offset_cosine(&self) -> f32 {
        ((1.0 - self.offset) * (1.0 + self.offset)).max(0.0).sqrt()
    }

    /// Reflectances between rays outside and inside that meet the surface at these cosines, as seen in
    /// the section; 1 where `outer` is 0.
    #[inline]
    fn fresnel(&self, outer: Vec4, inner: Vec4) -> Vec4 {
        let (outer, inner) = (outer * self.cosine, inner * self.inner_cosine);
        let dry = fresnel(outer, inner, self.index);
        // Most hair is dry.
        if self.wetness > 0.0 {
            return dry.lerp(reflectance(outer, inner, self.index), self.wetness);
        }
        dry
    }
}

/// A circle of radius 1.
pub(super) fn circle(ray: &Incident) -> Crossing {
    // sin γi = h and sin γt = h/η'; φ_p = φ − 2γi + p (2γt + π), and every way is 2 cos γt long. docs/theory.md, "Light in a
    // fibre"
    let (sine, cosine) = (ray.offset, ray.offset_cosine());
    let inner_sine = sine * ray.inverse_index();
    let inner = (1.0 - inner_sine * inner_sine).max(0.0).sqrt();
    let angles = atan2(
        Vec4::new(ray.towards.y, sine, inner_sine, 0.0),
        Vec4::new(ray.towards.x, cosine, inner, 1.0),
    );
    let (mirror, each) = (angles.x - 2.0 * angles.y, 2.0 * angles.z + PI);
    Crossing {
        azimuth: Vec4::splat(mirror) + Vec4::new(0.0, 1.0, 2.0, 0.0) * each,
        fresnel: ray.fresnel(Vec4::splat(cosine), Vec4::splat(inner)),
        chord: Vec4::splat(2.0 * inner),
    }
}

/// An ellipse of semi-axes `axes`, whose product is 1.
pub(super) fn ellipse(ray: &Incident, axes: Vec2) -> Crossing {
    // 1. Entry: the normal of the ellipse at (a u.x, b u.y) is along (u.x/a, u.y/b) = (b u.x, a u.y), as a b = 1.
    let at = entry(ray, axes);
    let normal = (at * axes.yx()).normalize();
    let ratio = ray.inverse_index();
    let outer = normal.dot(ray.towards).clamp(0.0, 1.0);
    let inner = (1.0 - (1.0 - outer * outer) * ratio * ratio).max(0.0).sqrt();
    // 2. Snell's law as vectors: ratio · d + (ratio cos γi − cos γt) n, with d = −towards.
    let way = normal * (outer * ratio - inner) - ray.towards * ratio;
    let (meetings, chord) = Meetings::within(at, way, axes);
    // 3. Where it leaves after none, one and two reflections inside; lane 0 is R, mirrored at the entry.
    let ([x, y], outers, inners) = meetings.leave(ratio.recip());
    let mirrored = normal * (2.0 * outer) - ray.towards;
    let azimuth = atan2(y.with_x(mirrored.y), x.with_x(mirrored.x));
    let fresnel = ray.fresnel(outers.with_x(outer), inners.with_x(inner));
    Crossing { azimuth, fresnel, chord }
}

/// Unit ways through the inside and normals, of any length, where they end, as x and y of lanes 1 to
/// 3; lane 0 counts for nothing.
#[derive(Clone, Copy, Debug)]
struct Meetings {
    way: [Vec4; 2],
    normal: [Vec4; 2],
}

impl Meetings {
    /// Three ways on from the point `at` of the surface, and their lengths.
    ///
    /// Points are kept as points u on the unit circle, (a u.x, b u.y): a way through the ellipse is a
    /// chord of the circle. Roots wait until they can be taken together.
    #[inline(always)]
    fn within(mut at: Vec2, mut way: Vec2, axes: Vec2) -> (Self, Vec4) {
        let (mut ways, mut normals, mut chord) = ([way; 4], [at; 4], [0.0; 4]);
        for i in 0..3 {
            // On the circle the way is (w.x/a, w.y/b); |u + ℓ f| = 1 again at ℓ = −2 u·f/|f|².
            let flat = way * axes.yx();
            let length = -2.0 * at.dot(flat) / flat.length_squared();
            at += flat * length;
            let normal = at * axes.yx();
            (ways[i + 1], normals[i + 1], chord[i]) = (way, normal, length.max(0.0));
            way -= normal * (2.0 * way.dot(normal) / normal.length_squared());
        }
        let lanes = |v: [Vec2; 4]| {
            [Vec4::new(v[0].x, v[1].x, v[2].x, v[3].x), Vec4::new(v[0].y, v[1].y, v[2].y, v[3].y)]
        };
        (Self { way: lanes(ways), normal: lanes(normals) }, Vec4::from_array(chord))
    }

    /// Directions in which light leaves, and its cosines outside and inside.
    ///
    /// Where all is reflected the cosine outside is 0; what leaves then has no energy, and its
    /// direction no meaning.
    #[inline(always)]
    fn leave(&self, index: f32) -> ([Vec4; 2], Vec4, Vec4) {
        let ([x, y], [wx, wy]) = (self.normal, self.way);
        let scale = (x * x + y * y).sqrt().recip();
        let (x, y) = (x * scale, y * scale);
        // cos γ inside, and sin γ outside by Snell from the cross product of way and normal.
        let inner = (wx * x + wy * y).max(Vec4::ZERO).min(Vec4::ONE);
        let sine = (wx * y - wy * x) * index;
        let outer = (Vec4::ONE - sine * sine).max(Vec4::ZERO).sqrt();
        let turn = outer - inner * index;
        ([wx * index + x * turn, wy * index + y * turn], outer, inner)
    }
}

/// Where the ray meets the ellipse, as a point of the unit circle.
///
/// Across the ray the point (a cos ψ, b sin ψ) lies at W (cos ψ, sin ψ)·m, with m a unit vector and W
/// half the projected width, so that h is minus this product.
fn entry(ray: &Incident, axes: Vec2) -> Vec2 {
    let front = (ray.towards * axes.yx()).normalize();
    front * ray.offset_cosine() - front.perp() * ray.offset
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(phi: f32, offset: f32, theta: f32) -> Incident {
        let inner_cosine = (1.0 - (theta.sin() / 1.55).powi(2)).sqrt();
        let towards = Vec2::from_angle(phi);
        Incident { towards, offset, cosine: theta.cos(), inner_cosine, index: 1.55, wetness: 0.0 }
    }

    #[test]
    fn an_ellipse_of_equal_axes_is_the_circle() {
        for phi in [0.3, -2.0] {
            for h in [-0.999, -0.6, 0.0, 0.2, 0.95] {
                for theta in [0.0, 0.8, -1.5] {
                    let ray = ray(phi, h, theta);
                    let (c, e) = (circle(&ray), ellipse(&ray, Vec2::ONE));
                    for i in 0..3 {
                        let turn = 0.5 * (c.azimuth[i] - e.azimuth[i]);
                        assert!(turn.sin().abs() < 5e-5, "{ray:?} {c:?} {e:?}");
                        assert!((c.chord[i] - e.chord[i]).abs() < 1e-5);
                    }
                    for i in 0..4 {
                        assert!((c.fresnel[i] - e.fresnel[i]).abs() < 1e-4, "{ray:?} {c:?} {e:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn total_reflection_keeps_light_inside() {
        // Thin and met near the end of its long side: what enters runs along it.
        let axes = Vec2::new(3.0_f32.sqrt(), 3.0_f32.sqrt().recip());
        let crossings = [0.5, 0.7, 0.9].map(|h| ellipse(&ray(0.6, h, 0.0), axes));
        assert!(crossings.iter().any(|c| c.fresnel.max_element() == 1.0));
    }
}
