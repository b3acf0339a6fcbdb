//! How far cards are from the strands that they stand for, seen from six sides.

use frisure_strands::{Strands, Surface};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::atlas::Atlas;
use crate::mesh::CardMesh;
use crate::raster;

/// Names of the views, and the direction in which each looks (z up, the face towards −y).
pub const VIEWS: [(&str, Vec3); 6] = [
    ("front", Vec3::Y),
    ("back", Vec3::NEG_Y),
    ("left", Vec3::NEG_X),
    ("right", Vec3::X),
    ("top", Vec3::NEG_Z),
    ("three-quarter", Vec3::new(-0.55, 0.75, -0.37)),
];

/// Pixels along the longer side of a view.
const PIXELS: usize = 256;
/// Samples along each side of a pixel, for cards.
const SAMPLES: usize = 3;
/// How far hair may be behind the skin and still be seen (m): roots lie in it.
const IN_SKIN: f32 = 3e-3;

/// What a view shows of the strands and of the cards.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Pixels that are in one silhouette alone, over those in either; a silhouette is where half of a pixel is covered. 0 where the
    /// strands cover nothing.
    pub silhouette: f64,
    /// Mean difference of the covered part of a pixel, over the mean covered part of the strands; 0 where these cover nothing.
    pub coverage: f64,
    /// What the cards cover over what the strands cover; 1 where these cover nothing.
    pub ratio: f64,
}

/// A view without perspective, of a box around the hair.
struct View {
    right: Vec3,
    down: Vec3,
    forward: Vec3,
    low: Vec2,
    /// Side of a pixel (m).
    pixel: f32,
    size: (usize, usize),
}

impl View {
    fn new(forward: Vec3, strands: &Strands) -> Self {
        let forward = forward.normalize();
        let up = if forward.z.abs() > 0.99 { Vec3::NEG_Y } else { Vec3::Z };
        let right = forward.cross(up).normalize();
        let down = forward.cross(right);
        let flat = |p: &Vec3| Vec2::new(p.dot(right), p.dot(down));
        let all = strands.points().iter().map(flat);
        let (low, high) =
            all.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
        let pixel = ((high - low).max_element() / (PIXELS - 8) as f32).max(1e-6);
        let size = ((high - low) / pixel).ceil() + 8.0;
        let low = low - 4.0 * pixel;
        Self { right, down, forward, low, pixel, size: (size.x as usize, size.y as usize) }
    }

    /// Place on the picture (pixels), and depth (m).
    fn project(&self, p: Vec3) -> (Vec2, f32) {
        let flat = Vec2::new(p.dot(self.right), p.dot(self.down));
        ((flat - self.low) / self.pixel, p.dot(self.forward))
    }

    /// Depth of the head in each pixel (m); infinite beside it.
    fn head(&self, head: Option<&Surface>) -> Vec<f32> {
        let mut depths = vec![f32::INFINITY; self.size.0 * self.size.1];
        for face in 0..head.map_or(0, |head| head.triangles().len()) {
            let corners = head.map(|h| h.corners(face)).unwrap_or_default();
            let corners = corners.map(|p| self.project(p.as_vec3()));
            raster::triangle(corners.map(|c| c.0), self.size, |x, y, w| {
                let depth: f32 = (0..3).map(|k| w[k] * corners[k].1).sum();
                let at = &mut depths[y * self.size.0 + x];
                *at = at.min(depth);
            });
        }
        depths
    }

    /// Covered part of each pixel, where hairs lie at random before each other.
    fn strands(&self, strands: &Strands, head: &[f32]) -> Vec<f32> {
        let mut through = vec![1.0; head.len()];
        let metres = Vec2::splat(self.pixel);
        for strand in strands.iter() {
            for (p, r) in strand.points.windows(2).zip(strand.radii.windows(2)) {
                let (a, b) = (self.project(p[0]), self.project(p[1]));
                raster::piece(
                    [a.0, b.0],
                    0.5 * (r[0] + r[1]),
                    metres,
                    self.size,
                    |x, y, part, t| {
                        let at = y * self.size.0 + x;
                        if a.1 + t * (b.1 - a.1) < head[at] + IN_SKIN {
                            // A piece ends within a pixel: what its neighbour covers counts once.
                            let within = (a.0.distance(b.0)).min(1.0);
                            through[at] *= 1.0 - part * within;
                        }
                    },
                );
            }
        }
        through.iter().map(|t| 1.0 - t).collect()
    }

    fn cards(&self, mesh: &CardMesh, atlas: &Atlas, head: &[f32]) -> Vec<f32> {
        let size = (SAMPLES * self.size.0, SAMPLES * self.size.1);
        let mut through = vec![1.0_f32; size.0 * size.1];
        for corners in &mesh.triangles {
            let corners = corners.map(|v| v as usize);
            let places = corners.map(|v| self.project(mesh.positions[v]));
            let flat = places.map(|p| SAMPLES as f32 * p.0);
            raster::triangle(flat, size, |x, y, w| {
                let of =
                    |value: &dyn Fn(usize) -> f32| (0..3).map(|k| w[k] * value(k)).sum::<f32>();
                let depth = of(&|k| places[k].1);
                if depth < head[y / SAMPLES * self.size.0 + x / SAMPLES] + IN_SKIN {
                    let uv = [0, 1].map(|axis| of(&|k| mesh.uvs[corners[k]][axis]));
                    through[y * size.0 + x] *= 1.0 - atlas.alpha(uv[0], uv[1]);
                }
            });
        }
        let each = (SAMPLES * SAMPLES) as f32;
        let mut covered = vec![0.0; head.len()];
        for (i, t) in through.iter().enumerate() {
            let (x, y) = (i % size.0 / SAMPLES, i / size.0 / SAMPLES);
            covered[y * self.size.0 + x] += (1.0 - t) / each;
        }
        covered
    }
}

/// The strands from all sides, to compare cards with.
pub(crate) struct Reference {
    views: Vec<(View, Vec<f32>, Vec<f32>)>,
}

impl Reference {
    pub(crate) fn new(strands: &Strands, head: Option<&Surface>) -> Self {
        let view = |(_, way): &(&str, Vec3)| {
            let view = View::new(*way, strands);
            let depths = view.head(head);
            let covered = view.strands(strands, &depths);
            (view, depths, covered)
        };
        Self { views: VIEWS.par_iter().map(view).collect() }
    }

    /// The differences of all views.
    pub(crate) fn differences(&self, mesh: &CardMesh, atlas: &Atlas) -> [Difference; VIEWS.len()] {
        let all: Vec<Difference> = self
            .views
            .par_iter()
            .map(|(view, depths, strands)| difference(strands, &view.cards(mesh, atlas, depths)))
            .collect();
        all.try_into().expect("one for each view")
    }
}

fn difference(strands: &[f32], cards: &[f32]) -> Difference {
    let (mut either, mut one, mut apart) = (0_u32, 0_u32, 0.0);
    let (mut of_strands, mut of_cards) = (0.0, 0.0);
    for (a, b) in strands.iter().zip(cards) {
        let inside = (*a >= 0.5, *b >= 0.5);
        either += u32::from(inside.0 || inside.1);
        one += u32::from(inside.0 != inside.1);
        apart += f64::from((a - b).abs());
        of_strands += f64::from(*a);
        of_cards += f64::from(*b);
    }
    if of_strands == 0.0 {
        // Straight hair seen along itself: there is nothing to be compared with.
        return Difference { silhouette: 0.0, coverage: 0.0, ratio: 1.0 };
    }
    Difference {
        silhouette: f64::from(one) / f64::from(either.max(1)),
        coverage: apart / of_strands,
        ratio: of_cards / of_strands,
    }
}
