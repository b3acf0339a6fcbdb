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
    /// Covered part of the pixel, 0 to 1.
    pub(super) coverage: f32,
    /// Mean depth of the covered part (m).
    pub(super) depth: f32,
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
        let features = self.features.as_ref();
        let tint = features.filter(|f| !f.tints.is_empty()).map_or(Tint::default(), |features| {
            let [a, b, c] = corners.map(|v| features.tints[v]);
            a * weights.x + b * weights.y + c * weights.z
        });
        complexion::material(features, tint, (position, None), &self.look)
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

    /// What each pixel of a tile (rows of [`TILE`]) sees of the faces named, with `samples` samples
    /// along each side of a pixel.
    pub(super) fn cover(
        &self,
        faces: &[u32],
        view: &Projection,
        area: &Area,
        samples: usize,
    ) -> Vec<HeadPixel> {
        let side = TILE * samples;
        let mut nearest = vec![(f32::INFINITY, u32::MAX, Vec3::ZERO); side * side];
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
                if depth < sample.0 {
                    *sample = (depth, face, weights * inverse * depth);
                }
            });
        }
        let mut pixels = vec![HeadPixel::default(); TILE * TILE];
        for (i, &(depth, face, weights)) in nearest.iter().enumerate() {
            if face != u32::MAX {
                let (x, y) = (i % side / samples, i / side / samples);
                self.add(&mut pixels[y * TILE + x], face, depth, weights, view);
            }
        }
        let part = 1.0 / (samples * samples) as f32;
        for pixel in pixels.iter_mut().filter(|p| p.coverage > 0.0) {
            let mean = 1.0 / pixel.coverage;
            pixel.depth *= mean;
            pixel.position *= mean;
            pixel.environment *= mean;
            pixel.colour *= mean;
            pixel.gloss *= mean;
            pixel.wet *= mean;
            pixel.deep *= mean;
            pixel.coverage *= part;
        }
        pixels
    }

    /// Adds one sample to a pixel.
    fn add(&self, pixel: &mut HeadPixel, face: u32, depth: f32, weights: Vec3, view: &Projection) {
        let [a, b, c] = self.triangles[face as usize].map(|v| v as usize);
        let mix = |of: &[Vec3]| of[a] * weights.x + of[b] * weights.y + of[c] * weights.z;
        let (position, normal) = (mix(&self.positions), mix(&self.normals));
        let material = self.material(face, [a, b, c], weights, position);
        let normal = material.normal.unwrap_or(normal);
        pixel.colour += material.colour;
        pixel.gloss += material.gloss;
        pixel.deep += f32::from(u8::from(material.scatters));
        pixel.wet += f32::from(u8::from(material.normal.is_some()));
        // Seen from inside (an open neck), a face is lit on the side that is seen.
        let towards = normal.dot(view.eye - position) >= 0.0;
        pixel.coverage += 1.0;
        pixel.depth += depth;
        pixel.position += position;
        pixel.normal += if towards { normal } else { -normal };
        pixel.environment += mix(&self.environment);
    }
}

/// What each face is made of that is no head; empty without such faces.
fn accessories(surface: &Surface) -> Vec<Option<AccessoryMaterial>> {
    let all: Vec<_> =
        (0..surface.triangles().len()).map(|i| surface.accessory(i).copied()).collect();
    if all.iter().any(Option::is_some) { all } else { Vec::new() }
}
