//! The head: its triangles, what of the environment reaches them, and which pixels of a tile it covers.

use frisure_look::SkinLook;
use frisure_strands::{AccessoryMaterial, Features, Surface, Tint};
use glam::Vec3;

use super::area::{Area, TILE};
use super::projection::{NEAR, Projection};
use super::raster;
use crate::complexion::{self, Material};

/// The surface that hair grows on, ready to be drawn.
pub(super) struct Head {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Irradiance / π of the environment at each vertex.
    environment: Vec<Vec3>,
    features: Option<Features>,
    /// What each face is made of that is no head; empty without such faces.
    accessories: Vec<Option<AccessoryMaterial>>,
    look: SkinLook,
}

/// The part of the head in a pixel, averaged over its samples.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct HeadPixel {
    /// Mean position of the covered part (m).
    pub(super) position: Vec3,
    /// Mean normal towards the eye; not of unit length.
    pub(super) normal: Vec3,
    /// Mean irradiance / π of the environment.
    pub(super) environment: Vec3,
    /// Mean diffuse reflectance.
    pub(super) colour: Vec3,
    /// Mean strength of the gloss.
    pub(super) gloss: f32,
    /// Part beneath whose surface light scatters.
    pub(super) deep: f32,
    /// Part that is an eye's wet surface.
    pub(super) wet: f32,
}

impl HeadPixel {
    /// The mean of the sum of `count` samples.
    fn mean(self, count: u32) -> Self {
        let mean = 1.0 / count.max(1) as f32;
        Self {
            position: self.position * mean,
            normal: self.normal,
            environment: self.environment * mean,
            colour: self.colour * mean,
            gloss: self.gloss * mean,
            deep: self.deep * mean,
            wet: self.wet * mean,
        }
    }
}

impl Head {
    pub(super) fn new(surface: &Surface) -> Self {
        let positions: Vec<Vec3> = surface.positions().iter().map(|p| p.as_vec3()).collect();
        let normals = surface.vertex_normals().iter().map(|n| n.as_vec3()).collect();
        let environment = vec![Vec3::ONE; positions.len()];
        let features = surface.features().map(|features| Features {
            tints: features.tints.clone(),
            eyes: features.eyes.clone(),
            ..Features::default()
        });
        Self {
            positions,
            normals,
            triangles: surface.triangles().to_vec(),
            environment,
            features,
            accessories: accessories(surface),
            look: SkinLook::default(),
        }
    }

    /// The same head in this look.
    pub(super) fn looking(self, look: SkinLook) -> Self {
        Self { look, ..self }
    }

    /// The material at a point of face `index` with these corners and weights.
    fn material(&self, index: u32, corners: [usize; 3], weights: Vec3, position: Vec3) -> Material {
        if let Some(Some(object)) = self.accessories.get(index as usize) {
            return complexion::accessory_material(object);
        }
        let tint = self.tints().map_or(Tint::default(), |tints| {
            let [a, b, c] = corners.map(|v| tints[v]);
            a * weights.x + b * weights.y + c * weights.z
        });
        complexion::material(self.features.as_ref(), tint, (position, None), &self.look)
    }

    /// The tint of each vertex, if there are tints.
    fn tints(&self) -> Option<&[Tint]> {
        self.features.as_ref().map(|features| &features.tints[..]).filter(|tints| !tints.is_empty())
    }

    /// Whether the head is dressed at the place of face `index` with these weights.
    fn is_garment(&self, index: u32, weights: Vec3) -> bool {
        self.tints().is_some_and(|tints| {
            let [a, b, c] = self.triangles[index as usize].map(|v| tints[v as usize].garment);
            complexion::is_garment(a * weights.x + b * weights.y + c * weights.z)
        })
    }

    /// Sets the ambient irradiance / π at each vertex.
    pub(super) fn set_ambient(&mut self, ambient: impl Fn(Vec3, Vec3) -> Vec3) {
        let places = self.positions.iter().zip(&self.normals);
        self.environment = places.map(|(&p, &n)| ambient(p, n)).collect();
    }

    pub(super) fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Number of faces.
    pub(super) fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Corners of each face (m).
    pub(super) fn faces(&self) -> impl Iterator<Item = [Vec3; 3]> {
        (0..self.len()).map(|i| self.face(i))
    }

    /// Corners of face `index` (m).
    pub(super) fn face(&self, index: usize) -> [Vec3; 3] {
        self.triangles[index].map(|v| self.positions[v as usize])
    }

    /// Which of the faces named each sample of a tile sees, with `samples` samples along each side of a pixel.
    pub(super) fn cover<'a>(
        &'a self,
        faces: &[u32],
        view: &'a Projection,
        area: &Area,
        samples: usize,
    ) -> Cover<'a> {
        let side = TILE * samples;
        let mut nearest = vec![Seen::NOTHING; side * side];
        let window = ((area.x1 - area.x0) * samples, (area.y1 - area.y0) * samples);
        let corner = Vec3::new(area.x0 as f32, area.y0 as f32, 0.0);
        let scale = Vec3::new(samples as f32, samples as f32, 1.0);
        for &face in faces {
            let at = self.face(face as usize).map(|p| (view.project(p) - corner) * scale);
            if at.iter().any(|p| p.z < NEAR) {
                continue;
            }
            let inverse = Vec3::new(1.0 / at[0].z, 1.0 / at[1].z, 1.0 / at[2].z);
            raster::triangle(at.map(Vec3::truncate), (0, 0), window, |x, y, weights| {
                // 1/z is linear on the screen, and weights over z give those on the face (perspective-correct).
                let depth = 1.0 / weights.dot(inverse);
                let sample = &mut nearest[y * side + x];
                if depth < sample.depth {
                    *sample = Seen { depth, face, weights: weights * inverse * depth };
                }
            });
        }
        Cover { head: self, view, samples, nearest }
    }
}

/// A place of the head that a sample sees.
#[derive(Clone, Copy)]
struct Seen {
    /// Depth (m); infinite where the sample sees no head.
    depth: f32,
    face: u32,
    /// Weights of the face's corners.
    weights: Vec3,
}

impl Seen {
    const NOTHING: Self = Self { depth: f32::INFINITY, face: u32::MAX, weights: Vec3::ZERO };
}

/// What the samples of a tile see of the head.
pub(super) struct Cover<'a> {
    head: &'a Head,
    view: &'a Projection,
    /// Samples along each side of a pixel.
    samples: usize,
    /// Row by row.
    nearest: Vec<Seen>,
}

impl Cover<'_> {
    /// Covered part (0 to 1) of each pixel (rows of [`TILE`]), and the mean depth of that part (m).
    pub(super) fn depths(&self) -> Vec<(f32, f32)> {
        let part = 1.0 / (self.samples * self.samples) as f32;
        let mean = |pixel: usize| {
            let (mut count, mut depth) = (0.0, 0.0);
            self.visit(pixel, |_, seen| {
                count += 1.0;
                depth += seen.depth;
            });
            if count > 0.0 { (count * part, depth / count) } else { (0.0, 0.0) }
        };
        (0..TILE * TILE).map(mean).collect()
    }

    /// The head in a pixel of which it covers a part.
    pub(super) fn pixel(&self, pixel: usize) -> HeadPixel {
        // Spots of skin and threads of cloth are as large as a pixel of a portrait: the mean of every fourth sample, on a turned
        // grid, is that of all.
        if self.samples >= 4 && self.is_even(pixel) {
            let (mut some, mut count) = (HeadPixel::default(), 0);
            self.visit(pixel, |at, seen| {
                if on_turned_grid(at) {
                    count += 1;
                    self.add(&mut some, seen);
                }
            });
            // Eyes have finer parts.
            if some.wet == 0.0 {
                return some.mean(count);
            }
        }
        let (mut all, mut count) = (HeadPixel::default(), 0);
        self.visit(pixel, |_, seen| {
            count += 1;
            self.add(&mut all, seen);
        });
        all.mean(count)
    }

    /// Whether a pixel lies within one part of the head, with no edge in it.
    fn is_even(&self, pixel: usize) -> bool {
        /// How much deeper than wide a pixel may be: more than that there is an edge in it, or nearly. Chosen.
        const STEEPEST: f32 = 4.0;
        let (mut count, mut dressed) = (0, 0);
        let (mut near, mut far) = (f32::INFINITY, 0.0_f32);
        self.visit(pixel, |_, seen| {
            count += 1;
            dressed += usize::from(self.head.is_garment(seen.face, seen.weights));
            (near, far) = (near.min(seen.depth), far.max(seen.depth));
        });
        count == self.samples * self.samples
            && (dressed == 0 || dressed == count)
            && (far - near) * self.view.focal < STEEPEST * near
    }

    /// Calls `visit` with each sample of a pixel that sees the head, and its column and row in the pixel.
    fn visit(&self, pixel: usize, mut visit: impl FnMut((usize, usize), &Seen)) {
        let (n, side) = (self.samples, TILE * self.samples);
        for y in 0..n {
            let first = (pixel / TILE * n + y) * side + pixel % TILE * n;
            for (x, seen) in self.nearest[first..first + n].iter().enumerate() {
                if seen.face != u32::MAX {
                    visit((x, y), seen);
                }
            }
        }
    }

    /// Adds what one sample sees.
    fn add(&self, pixel: &mut HeadPixel, seen: &Seen) {
        let (head, weights) = (self.head, seen.weights);
        let [a, b, c] = head.triangles[seen.face as usize].map(|v| v as usize);
        let mix = |of: &[Vec3]| of[a] * weights.x + of[b] * weights.y + of[c] * weights.z;
        let (position, normal) = (mix(&head.positions), mix(&head.normals));
        let material = head.material(seen.face, [a, b, c], weights, position);
        let normal = material.normal.unwrap_or(normal);
        pixel.colour += material.colour;
        pixel.gloss += material.gloss;
        pixel.deep += f32::from(u8::from(material.scatters));
        pixel.wet += f32::from(u8::from(material.normal.is_some()));
        // Seen from inside (an open neck), a face is lit on the side that is seen.
        let towards = normal.dot(self.view.eye - position) >= 0.0;
        pixel.position += position;
        pixel.normal += if towards { normal } else { -normal };
        pixel.environment += mix(&head.environment);
    }
}

/// Whether a sample, in this column and row of its pixel, is one of those that stand for all: one of four in each row, in another column
/// in each of four rows.
fn on_turned_grid((x, y): (usize, usize)) -> bool {
    (x + 2 * y + y / 2) % 4 == 1
}

/// What each face is made of that is no head; empty without such faces.
fn accessories(surface: &Surface) -> Vec<Option<AccessoryMaterial>> {
    let all: Vec<_> =
        (0..surface.triangles().len()).map(|i| surface.accessory(i).copied()).collect();
    if all.iter().any(Option::is_some) { all } else { Vec::new() }
}
