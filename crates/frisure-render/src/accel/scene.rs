//! The BVHs of a scene: hair and head, ready for rays.

use fearless_simd::Level;
use frisure_strands::{Strands, Surface};
use glam::Vec3;

use super::aabb::Aabb;
use super::bvh::{Bvh, LeafHit};
use super::curves::Curves;
use super::error::FARTHEST;
use super::hair::{HairLeaf, entry};
use super::node::Primitive;
use super::skin::{SkinLeaf, Triangle};
use super::{AccelError, CurveOptions, HairHit, Hit, Ray, SkinHit};

/// Hair and head in two BVHs, ready for rays.
///
/// Tracing uses the best instructions that the machine has (AVX-512, AVX2 with FMA, SSE, NEON, SIMD of WebAssembly); all
/// find the same hits to rounding.
///
/// ```
/// use frisure_render::accel::{CurveOptions, Hit, Ray, SceneBvh};
/// use frisure_strands::Strands;
/// use glam::Vec3;
///
/// // One hair of 80 µm along the x axis, and a ray down on its middle from 1 m above.
/// let mut strands = Strands::new();
/// strands.push(&[Vec3::ZERO, Vec3::X * 0.1], &[4e-5; 2]);
/// let bvh = SceneBvh::new(&strands, None, &CurveOptions::default())?;
/// let ray = Ray::new(Vec3::new(0.05, 0.0, 1.0), -Vec3::Z);
/// let Some(Hit::Hair(hit)) = bvh.closest_hit(&ray, 10.0) else { panic!("the ray hits") };
/// assert_eq!(hit.strand, 0);
/// assert!((hit.t - (1.0 - 4e-5)).abs() < 1e-6, "on the surface, not on the axis");
/// assert!(!bvh.occluded(&ray, 0.5), "nothing is within half a metre");
/// # Ok::<(), frisure_render::accel::AccelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneBvh {
    curves: Curves,
    hair: Bvh<HairLeaf>,
    skin: Bvh<SkinLeaf>,
    faces: Vec<[u32; 3]>,
    corners: Vec<Vec3>,
    normals: Vec<Vec3>,
    level: Level,
}

impl SceneBvh {
    /// Builds the BVHs of strands and, if there is one, of the head. Strands with fewer than two points are
    /// nowhere; the result is the same on any number of threads.
    ///
    /// # Errors
    /// [`AccelError`], if a coordinate, a radius or an option is out of range.
    pub fn new(
        strands: &Strands,
        head: Option<&Surface>,
        options: &CurveOptions,
    ) -> Result<Self, AccelError> {
        let curves = Curves::new(strands, options)?;
        let mut scene = Self {
            hair: hair(&curves),
            curves,
            skin: Bvh::new(&[][..], &mut []),
            faces: Vec::new(),
            corners: Vec::new(),
            normals: Vec::new(),
            level: Level::new(),
        };
        if let Some(head) = head {
            scene.put_head(head)?;
        }
        Ok(scene)
    }

    /// The same scene without the instructions that only some machines have: to compare.
    #[must_use]
    pub fn portable(mut self) -> Self {
        self.level = Level::baseline();
        self
    }

    /// The closest hit of a ray before `t_max` (m).
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray, t_max: f32) -> Option<Hit> {
        // The head first: few triangles, and its hit shortens the search among the hair.
        let skin = self.skin.closest_hit(self.level, ray, t_max);
        let t_max = skin.map_or(t_max, |found| found.t);
        match (self.hair.closest_hit(self.level, ray, t_max), skin) {
            (Some(hair), _) => Some(Hit::Hair(self.hair_hit(ray, &hair))),
            (None, Some(skin)) => Some(Hit::Skin(self.skin_hit(ray, &skin))),
            (None, None) => None,
        }
    }

    /// The closest hit of a ray on the head before `t_max` (m), whatever hair is before it.
    #[must_use]
    pub fn closest_skin_hit(&self, ray: &Ray, t_max: f32) -> Option<SkinHit> {
        self.skin.closest_hit(self.level, ray, t_max).map(|found| self.skin_hit(ray, &found))
    }

    /// Whether the ray hits anything before `t_max` (m): for shadow rays, faster than the closest hit.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, t_max: f32) -> bool {
        self.skin.occluded(self.level, ray, t_max) || self.hair.occluded(self.level, ray, t_max)
    }

    /// Whether most ways out of a point pass through the head's skin from its inside.
    #[must_use]
    pub fn is_inside_head(&self, point: Vec3) -> bool {
        // Eight rays, one into each octant, no two of them opposite.
        let corner =
            |i: u8| Vec3::from_array([1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 0.9 }));
        let leaves = |direction: Vec3| {
            let ray = Ray::new(point, direction);
            let found = self.skin.closest_hit(self.level, &ray, f32::INFINITY);
            found.is_some_and(|found| self.skin_hit(&ray, &found).normal.dot(direction) > 0.0)
        };
        (0..8).filter(|i| leaves(corner(*i))).count() > 4
    }

    /// Smallest and largest corner of a box around everything (m); `None` if there is nothing.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let Aabb { low, high } = self.hair.bounds().union(self.skin.bounds());
        low.cmple(high).all().then(|| (low.into(), high.into()))
    }

    /// Number of straight pieces into which the strands are cut.
    #[must_use]
    pub fn pieces(&self) -> usize {
        self.curves.count()
    }

    /// Bytes of memory held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.curves.bytes()
            + self.hair.bytes()
            + self.skin.bytes()
            + size_of_val(&self.faces[..])
            + size_of_val(&self.corners[..])
            + size_of_val(&self.normals[..])
    }

    #[cfg(test)]
    pub(super) fn same_trees(&self, other: &Self) -> bool {
        self.hair == other.hair && self.skin == other.skin && self.curves == other.curves
    }

    fn put_head(&mut self, head: &Surface) -> Result<(), AccelError> {
        let far = |p: &glam::DVec3| p.abs().max_element() > f64::from(FARTHEST);
        if let Some(vertex) = head.positions().iter().position(far) {
            return Err(AccelError::Vertex { vertex, position: head.positions()[vertex] });
        }
        let triangles = Triangle::of(head);
        let boxes = triangles.iter().map(Triangle::bounds).zip(0..);
        let mut primitives: Vec<_> = boxes.map(|(b, i)| Primitive::new(b, i, 0)).collect();
        self.skin = Bvh::new(&triangles[..], &mut primitives);
        self.faces = head.triangles().to_vec();
        self.corners = head.positions().iter().map(|p| p.as_vec3()).collect();
        self.normals = head.vertex_normals().iter().map(|n| n.as_vec3()).collect();
        Ok(())
    }

    fn hair_hit(&self, ray: &Ray, found: &LeafHit<'_, HairLeaf>) -> HairHit {
        let piece = found.leaf.piece(found.lane);
        let (origin, direction) = (ray.origin().as_dvec3(), ray.direction().as_dvec3());
        let at = entry(&piece, origin, direction);
        let (strand, segment) = self.curves.segment(piece.name.point);
        let s = at.s.clamp(0.0, 1.0) as f32;
        let u = self.curves.parameter(piece.name, s);
        let length = piece.axis.length();
        let axis = piece.axis / length;
        let radius = piece.radius + piece.widening * s;
        // h = ± the distance at which ray and axis pass each other over the radius.
        let side = direction.cross(axis.as_dvec3()).dot(at.pass);
        let h = at.pass.length().copysign(side) as f32 / radius;
        let out = at.out.normalize_or_zero().as_vec3();
        HairHit {
            t: at.t as f32,
            strand,
            segment,
            u,
            tangent: self.curves.tangent(strand, piece.name.point, u).unwrap_or(axis),
            radius,
            h: h.clamp(-1.0, 1.0),
            normal: (out - piece.widening / length * axis).normalize_or(-ray.direction()),
            centre: (origin + at.t * direction - at.out).as_vec3(),
            axis,
        }
    }

    fn skin_hit(&self, ray: &Ray, found: &LeafHit<'_, SkinLeaf>) -> SkinHit {
        let face = found.leaf.face(found.lane);
        let corners = self.faces[face as usize];
        let [a, b, c] = corners.map(|v| self.corners[v as usize].as_dvec3());
        let (origin, direction) = (ray.origin().as_dvec3(), ray.direction().as_dvec3());
        let area = (b - a).cross(c - a);
        // Again in f64, on the plane of the face: a secondary ray must start on the right side of it.
        let t = (a - origin).dot(area) / direction.dot(area);
        let position = origin + t * direction;
        let weight = |p: glam::DVec3, q: glam::DVec3| {
            ((p - position).cross(q - position).dot(area) / area.length_squared()).clamp(0.0, 1.0)
        };
        let (v, w) = (weight(c, a), weight(a, b));
        let barycentric = [(1.0 - v - w).max(0.0), v, w].map(|x| x as f32);
        let normal = area.normalize_or_zero().as_vec3();
        let smooth: Vec3 =
            corners.iter().zip(barycentric).map(|(&v, x)| x * self.normals[v as usize]).sum();
        SkinHit {
            t: t as f32,
            face,
            barycentric,
            position: position.as_vec3(),
            normal,
            smooth_normal: smooth.normalize_or(normal),
        }
    }
}

fn hair(curves: &Curves) -> Bvh<HairLeaf> {
    Bvh::new(curves, &mut curves.boxes())
}
