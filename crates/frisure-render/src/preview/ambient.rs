//! Ambient light: how much of the environment light reaches each point through the hair and past the head
//! (ambient occlusion).
//!
//! A coarse grid holds how much hair each cell has; hairs met along fourteen directions (those of
//! Lebedev's 14-point rule, exact to degree 5) are sums along rows and diagonals of the grid, so the
//! whole costs a few operations per cell.

use frisure_strands::Surface;
use glam::{IVec3, UVec3, Vec3};
use rayon::prelude::*;

use super::curves::{Curves, NOWHERE, Vertex};
use super::directions::{DIRECTION_COUNT, DIRECTIONS, direction};
use super::geometry::split;
use super::head::Head;
use super::lumps::Lumps;

/// Part of the environment's light that comes to skin through skin where nothing else does, as between the lips: red goes farthest.
/// Chosen by eye beside the tracer, whose light goes beneath the skin.
const SEEPING: Vec3 = Vec3::new(0.1, 0.05, 0.04);

/// Finest cell (m); chosen by trial, not measured further.
const MIN_CELL: f32 = 4.5e-3;
/// Most cells along a side; chosen by trial for speed.
pub(super) const MAX_CELLS: f32 = 88.0;
/// Hairs met in crossing a cell of the head's shell: opaque; chosen.
const SHELL: f32 = 40.0;

/// Part of the hair of its own cell that shades a node. The hair that is seen lies on the outside of its
/// cell: half of it would be too much. Fitted to traced heads.
const OWN: f32 = 0.1;

/// A point of hair that occludes light.
#[derive(Clone, Copy, Debug)]
pub struct Occluder {
    /// Position (m).
    pub position: Vec3,
    /// Half the width of the hair that it stands for (m).
    pub half_width: f32,
    /// Index of the strand; points of one strand follow each other.
    pub strand: u32,
}

/// The environment light inside and around the hair, on a grid.
pub struct AmbientLight {
    low: Vec3,
    cell: f32,
    size: UVec3,
    /// Per direction and node, hairs met between the node and the environment.
    met: Vec<Vec<f32>>,
    /// Radiance that white hair at each node would have in the environment.
    mean: Vec<Vec3>,
    /// Radiance of the environment in each direction.
    environment: [Vec3; DIRECTION_COUNT],
    /// Extinction per hair.
    extinction: Vec3,
}

impl AmbientLight {
    /// Measures an environment light ([`super::DirectionalLights::environment`]) around occluders and head; its light falls
    /// by the factor exp(−`extinction`) for each hair on the way. The grid has at most `cells` cells along a side.
    #[must_use]
    pub fn new(
        hair: impl Iterator<Item = Occluder>,
        head: Option<&Surface>,
        environment: [Vec3; DIRECTION_COUNT],
        extinction: Vec3,
        cells: f32,
    ) -> Self {
        let vertex = |Occluder { position, half_width, strand }| Vertex {
            position,
            half_width,
            strand,
            ..NOWHERE
        };
        let curves = Curves { vertices: hair.map(vertex).collect() };
        let hair = Lumps::new(&curves, MIN_CELL, cells);
        Self::around(&hair, head.map(Head::new).as_ref(), environment, extinction, cells)
    }

    /// Lowest corner of the grid (m), distance between its nodes (m), and nodes along each side.
    #[must_use]
    pub fn grid(&self) -> (Vec3, f32, UVec3) {
        (self.low, self.cell, self.size)
    }

    /// Radiance that white hair at each node would have, x fastest and z slowest.
    #[must_use]
    pub fn nodes(&self) -> &[Vec3] {
        &self.mean
    }

    /// As [`Self::new`], around lumps that are not longer than about a cell.
    pub(super) fn around(
        hair: &Lumps,
        head: Option<&Head>,
        environment: [Vec3; DIRECTION_COUNT],
        extinction: Vec3,
        cells: f32,
    ) -> Self {
        let skin = head.into_iter().flat_map(|h| h.positions().iter().copied());
        let (mut low, mut high) =
            skin.fold(hair.bounds, |(low, high), p| (low.min(p), high.max(p)));
        if !low.is_finite() || !high.is_finite() {
            (low, high) = (Vec3::ZERO, Vec3::ZERO);
        }
        let cell = ((high - low).max_element() / cells).max(MIN_CELL);
        let low = low - Vec3::splat(1.5 * cell);
        let size = ((high - low) / cell).ceil().as_uvec3() + UVec3::splat(2);
        let mut ambient =
            Self { low, cell, size, met: Vec::new(), mean: Vec::new(), environment, extinction };
        let hair = ambient.hair_density(hair);
        let shell = ambient.shell(head);
        ambient.met = DIRECTIONS
            .par_iter()
            .map(|&(step, _)| ambient.hairs_met(&hair, &shell, step))
            .collect();
        let whole: Vec3 = (0..DIRECTION_COUNT).map(|d| DIRECTIONS[d].1 * environment[d]).sum();
        ambient.mean = (0..hair.len())
            .into_par_iter()
            .map(|i| {
                let light: Vec3 = (0..DIRECTION_COUNT)
                    .map(|d| DIRECTIONS[d].1 * environment[d] * ambient.passed(ambient.met[d][i]))
                    .sum();
                whole * gathered(light / whole.max(Vec3::splat(1e-9)))
            })
            .collect();
        ambient
    }

    /// Radiance that white hair at a point would have in the environment.
    pub(super) fn mean(&self, point: Vec3) -> Vec3 {
        let mut sum = Vec3::ZERO;
        self.visit_nodes(point, |i, weight| sum += weight * self.mean[i]);
        sum
    }

    /// Irradiance / π from the environment on a surface at `point` (m) with unit normal `normal`.
    #[must_use]
    pub fn on_surface(&self, point: Vec3, normal: Vec3) -> Vec3 {
        // Outside the surface's own shell, which would shade it.
        // The reach of trilinear weights is a cell along each axis, √3 along a diagonal.
        let point = point + 1.7 * self.cell * normal;
        // Of the light that passes and not of the hairs met: behind the edge of the head these jump, and light would in a
        // fortieth of a cell.
        let mut passed = [Vec3::ZERO; DIRECTION_COUNT];
        self.visit_nodes(point, |i, weight| {
            for (sum, field) in passed.iter_mut().zip(&self.met) {
                *sum += weight * self.passed(field[i]);
            }
        });
        let (mut light, mut open, mut whole) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for (d, &(step, weight)) in DIRECTIONS.iter().enumerate() {
            let weight = weight * normal.dot(direction(step)).max(0.0);
            light += weight * self.environment[d] * passed[d];
            open += weight * self.environment[d];
            whole += weight;
        }
        light.max(SEEPING * open) / f32::max(whole, 1e-6)
    }

    /// Part of the light that `hairs` hairs let pass.
    fn passed(&self, hairs: f32) -> Vec3 {
        // Open air and the head, the most frequent, need no exponential.
        match hairs {
            0.0 => Vec3::ONE,
            SHELL.. => Vec3::ZERO,
            _ => (-hairs * self.extinction).exp(),
        }
    }

    fn index(&self, p: UVec3) -> usize {
        (p.z as usize * self.size.y as usize + p.y as usize) * self.size.x as usize + p.x as usize
    }

    /// The eight nodes around a point, with their trilinear weights.
    fn visit_nodes(&self, point: Vec3, mut visit: impl FnMut(usize, f32)) {
        let g = (point - self.low) / self.cell;
        let g = g.clamp(Vec3::ZERO, self.size.as_vec3() - Vec3::splat(1.001));
        let (base, f) = split(g);
        for corner in 0..8 {
            let bit = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
            let w = Vec3::select(bit.cmpeq(UVec3::ONE), f, Vec3::ONE - f);
            visit(self.index(base + bit), w.x * w.y * w.z);
        }
    }

    /// Projected area of hair per volume at each node (1/m), mean over directions.
    fn hair_density(&self, hair: &Lumps) -> Vec<f32> {
        let mut density = vec![0.0; (self.size.x * self.size.y * self.size.z) as usize];
        // A cylinder of width w and length l shows π/4 w l on average.
        let scale = std::f32::consts::FRAC_PI_4 / self.cell.powi(3);
        for lump in hair.iter() {
            let value = lump.area.length() * scale;
            self.visit_nodes(lump.position, |i, weight| density[i] += weight * value);
        }
        density
    }

    /// Whether each node lies on the head's surface.
    fn shell(&self, head: Option<&Head>) -> Vec<bool> {
        let mut shell = vec![false; (self.size.x * self.size.y * self.size.z) as usize];
        let Some(head) = head else { return shell };
        for corners in head.faces() {
            let [a, ab, ac] = [corners[0], corners[1] - corners[0], corners[2] - corners[0]];
            let n = (ab.length().max(ac.length()) / (0.5 * self.cell)).ceil().max(1.0) as u32;
            for i in 0..=n {
                for j in 0..=n - i {
                    let p = a + ab * (i as f32 / n as f32) + ac * (j as f32 / n as f32);
                    let g = ((p - self.low) / self.cell).round();
                    let node = g.as_uvec3().min(self.size - UVec3::ONE);
                    shell[self.index(node)] = true;
                }
            }
        }
        shell
    }

    /// Hairs met from each node to the outside along `step`; a node counts little of its own hair and
    /// none of its own shell.
    fn hairs_met(&self, hair: &[f32], shell: &[bool], step: [i32; 3]) -> Vec<f32> {
        let step = IVec3::from_array(step);
        let length = self.cell * step.as_vec3().length();
        let mut whole = vec![0.0; hair.len()];
        let mut met = vec![0.0; hair.len()];
        let order = |n: u32, step: i32| (0..n).map(move |i| if step > 0 { n - 1 - i } else { i });
        for z in order(self.size.z, step.z) {
            for y in order(self.size.y, step.y) {
                for x in order(self.size.x, step.x) {
                    let p = UVec3::new(x, y, z);
                    let next = p.as_ivec3() + step;
                    let inside =
                        next.cmpge(IVec3::ZERO).all() && next.cmplt(self.size.as_ivec3()).all();
                    let before = if inside { whole[self.index(next.as_uvec3())] } else { 0.0 };
                    let i = self.index(p);
                    // One pass against the direction: what a node adds to those behind it is known when they are reached.
                    met[i] = before + OWN * hair[i] * length;
                    whole[i] = before + hair[i] * length + if shell[i] { SHELL } else { 0.0 };
                }
            }
        }
        met
    }
}

/// Radiance of white hair in an environment of radiance 1, of whose directions it sees the part `seen`.
///
/// A fibre alone sends back what it meets, and has 1. Hair among hair scatters as a matt surface does (the
/// diffuse light of lamps, E sin(t, l)/π): over all directions that is π times, and with the light that
/// other hair sends on about four times, the part that it sees.
fn gathered(seen: Vec3) -> Vec3 {
    let hidden = Vec3::ONE - seen.clamp(Vec3::ZERO, Vec3::ONE);
    Vec3::ONE - hidden * hidden * hidden * hidden
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preview::projection::Projection;
    use frisure_look::Camera;
    use frisure_strands::Strands;

    fn hair(curves: &Curves) -> Lumps {
        Lumps::new(curves, MIN_CELL, MAX_CELLS)
    }

    fn environment(radiance: f32) -> [Vec3; DIRECTION_COUNT] {
        [Vec3::splat(radiance); DIRECTION_COUNT]
    }

    #[test]
    fn open_air_has_all_the_room() {
        let curves = Curves::new(&Strands::new(), &Projection::new(&Camera::default(), 8, 8), 1.0);
        let ambient =
            AmbientLight::around(&hair(&curves), None, environment(2.0), Vec3::ONE, MAX_CELLS);
        assert!((ambient.mean(Vec3::ONE) - Vec3::splat(2.0)).length() < 1e-5);
        let on = ambient.on_surface(Vec3::ZERO, Vec3::new(0.6, 0.0, 0.8));
        assert!((on - Vec3::splat(2.0)).length() < 1e-5);
    }

    #[test]
    fn the_middle_of_a_ball_of_hair_is_darker_than_its_edge() {
        let mut strands = Strands::new();
        for i in 0..40_u8 {
            for j in 0..40_u8 {
                let at = |x: f32| Vec3::new(x, f32::from(i) - 19.5, f32::from(j) - 19.5) * 2e-3;
                strands.push(&[at(-20.0), at(20.0)], &[1e-4; 2]);
            }
        }
        let curves = Curves::new(&strands, &Projection::new(&Camera::default(), 64, 64), 1.0);
        let ambient =
            AmbientLight::around(&hair(&curves), None, environment(1.0), Vec3::ONE, MAX_CELLS);
        let (middle, edge) = (ambient.mean(Vec3::ZERO).x, ambient.mean(Vec3::Z * 0.038).x);
        assert!(middle < 0.5 * edge && edge < 0.95, "{middle} {edge}");
    }
}
