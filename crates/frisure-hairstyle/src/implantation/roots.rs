//! Where hair grows: points spread evenly over the scalp.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::head::{Edge, Head};
use crate::parallel;
use crate::random::{Purpose, Stream};
use crate::spec::HairstyleSpec;

/// A point of the scalp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Position on the skin (m).
    pub position: DVec3,
    /// Outward unit normal of the skin.
    pub normal: DVec3,
}

/// Samples points of the scalp with a density proportional to how densely hair grows.
pub(crate) struct Scalp<'a> {
    head: &'a Head,
    normals: Vec<DVec3>,
    /// A natural hairline is known everywhere, not only at vertices: it does not follow the mesh.
    edge: Option<Edge>,
    /// Faces with hair, in an order in which neighbours are near each other, and the sum of their
    /// weighted areas (m²) up to and including each.
    faces: Vec<(usize, f64)>,
}

/// Distance (m) from the hairline beyond which hair is full, or none: longer than its feather and
/// the sides of the faces. Chosen; no result depends on it.
const SURELY: f64 = 0.03;

/// Area (m²) of the scalp of a head on which hair of this description grows, each part weighted with
/// its density of hair: what [`crate::Wisps::hair_count`] counts on.
#[must_use]
pub fn scalp_area(spec: &HairstyleSpec, head: &Head) -> f64 {
    Scalp::grown(head, spec).area()
}

impl<'a> Scalp<'a> {
    /// The scalp as the mesh's vertices have it.
    #[cfg(test)]
    pub(crate) fn new(head: &'a Head) -> Self {
        Self::with_edge(head, None)
    }

    /// The scalp of a description: with its hairline, unless the scalp came with the mesh.
    pub(crate) fn grown(head: &'a Head, spec: &HairstyleSpec) -> Self {
        Self::with_edge(head, head.edge(&spec.implantation.hairline, spec.seed))
    }

    fn with_edge(head: &'a Head, edge: Option<Edge>) -> Self {
        let surface = head.surface();
        let (low, high) = head.frame();
        let size = (high - low).max_element().max(f64::MIN_POSITIVE);
        let density = densities(head, edge.as_ref());
        let mut faces: Vec<(u32, usize, f64)> = (0..surface.triangles().len())
            .map(|face| {
                let corner = (surface.corners(face)[0] - low) / size;
                let area = 0.5 * surface.doubled_area_vector(face).length();
                (morton(corner), face, area * density[face])
            })
            .filter(|f| f.2 > 0.0)
            .collect();
        faces.sort_by_key(|f| (f.0, f.1));
        let mut sum = 0.0;
        let faces = faces
            .into_iter()
            .map(|(_, face, weight)| {
                sum += weight;
                (face, sum)
            })
            .collect();
        Self { head, normals: surface.vertex_normals(), edge, faces }
    }

    /// Area of the scalp (m²), each part weighted with its density of hair.
    pub(crate) fn area(&self) -> f64 {
        self.faces.last().map_or(0.0, |f| f.1)
    }

    /// `count` roots, one in each of as many parts of equal weighted area.
    pub(crate) fn stratified(&self, count: usize, seed: u64, purpose: Purpose) -> Vec<Root> {
        let mut random = Stream::new(seed, purpose, 0);
        let step = self.area() / count as f64;
        (0..count)
            .map(|i| {
                // One point in each of `count` strata of the running sum of areas; faces in Morton order keep strata compact.
                let target = (i as f64 + random.unit()) * step;
                let at = self.faces.partition_point(|f| f.1 <= target);
                self.on_face(self.faces[at.min(self.faces.len() - 1)].0, &mut random)
            })
            .collect()
    }

    /// A point of a face, denser where hair grows more densely.
    fn on_face(&self, face: usize, random: &mut Stream) -> Root {
        let surface = self.head.surface();
        let (triangle, corners) = (surface.triangles()[face], surface.corners(face));
        let weights = triangle.map(|v| self.head.scalp()[v as usize]);
        let largest = match self.edge {
            Some(_) => 1.0,
            None => weights.iter().copied().fold(0.0, f64::max),
        };
        let mut b = [1.0 / 3.0; 3];
        for _ in 0..TRIES {
            // Uniform on the triangle: the root makes up for its narrowing towards the first corner.
            let (u, v) = (random.unit().sqrt(), random.unit());
            b = [1.0 - u, u * (1.0 - v), u * v];
            let here = match &self.edge {
                Some(edge) => edge.density(at(b, corners)),
                None => b.iter().zip(weights).map(|(b, w)| b * w).sum(),
            };
            // Rejection sampling in proportion to the density.
            if random.unit() * largest <= here {
                break;
            }
        }
        Root {
            position: at(b, corners),
            normal: at(b, triangle.map(|v| self.normals[v as usize])).normalize_or(DVec3::Z),
        }
    }

    /// `count` roots as far from each other as can be: blue noise by weighted sample elimination
    /// (Yuksel 2015), from five times as many.
    pub(crate) fn even(&self, count: usize, seed: u64, purpose: Purpose) -> Vec<Root> {
        let candidates = self.stratified(5 * count, seed, purpose);
        // Largest possible distance of `count` points on this area: a hexagonal packing.
        let reach = 2.0 * (self.area() / (2.0 * 3.0_f64.sqrt() * count as f64)).sqrt();
        eliminate(candidates, count, reach)
    }
}

/// Most points of a face that are tried: where hair is sparse, most are bald. A guard on time.
const TRIES: usize = 200;

/// The mean of three values with weights that sum to 1.
fn at(weights: [f64; 3], values: [DVec3; 3]) -> DVec3 {
    weights.iter().zip(values).map(|(b, x)| x * *b).sum()
}

/// Mean density of hair on each face, 0 to 1.
fn densities(head: &Head, edge: Option<&Edge>) -> Vec<f64> {
    let surface = head.surface();
    let scalp = head.scalp();
    let faces = surface.triangles().len();
    let Some(edge) = edge else {
        let mean = |i: usize| surface.triangles()[i].iter().map(|&v| scalp[v as usize] / 3.0).sum();
        return (0..faces).map(mean).collect();
    };
    let inside =
        parallel::map_slice(surface.positions(), |&p| edge.inside_within(p, SURELY + edge.reach));
    let mean = |i: usize| -> f64 {
        let triangle = surface.triangles()[i].map(|v| v as usize);
        if triangle.iter().all(|&v| inside[v] < -SURELY) {
            return 0.0;
        }
        if triangle.iter().all(|&v| inside[v] > SURELY && scalp[v] == 1.0) {
            return 1.0;
        }
        QUADRATURE.iter().map(|&b| edge.density(at(b, surface.corners(i))) / 4.0).sum()
    };
    parallel::map(faces, mean)
}

/// Centres of the four quarters of a triangle.
const QUADRATURE: [[f64; 3]; 4] = {
    let (near, far) = (2.0 / 3.0, 1.0 / 6.0);
    [[1.0 / 3.0; 3], [near, far, far], [far, near, far], [far, far, near]]
};

/// Bits of a position in the unit cube, interleaved.
fn morton(p: DVec3) -> u32 {
    let spread = |x: f64| {
        let x = (x.clamp(0.0, 0.999) * 1024.0) as u32;
        (0..10).fold(0, |bits, i| bits | ((x >> i) & 1) << (3 * i))
    };
    spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2
}

#[derive(PartialEq)]
struct Crowded {
    weight: f64,
    index: usize,
}

impl Eq for Crowded {}

impl Ord for Crowded {
    fn cmp(&self, other: &Self) -> Ordering {
        self.weight.total_cmp(&other.weight).then(other.index.cmp(&self.index))
    }
}

impl PartialOrd for Crowded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Removes the most crowded of the candidates until `count` are left.
fn eliminate(candidates: Vec<Root>, count: usize, reach: f64) -> Vec<Root> {
    let positions: Vec<DVec3> = candidates.iter().map(|r| r.position).collect();
    let grid = crate::math::Grid::new(&positions, reach);
    let closeness = |i: usize, j: usize| {
        let d = candidates[i].position.distance(candidates[j].position);
        // Yuksel's weight (1 − d/2r)⁸ with 2r the reach; the exponent is his. docs/theory.md, "Roots and implantation"
        (1.0 - (d / reach).min(1.0)).powi(8)
    };
    let neighbours = |i: usize| grid.near(candidates[i].position).filter(move |&j| j != i);
    let mut weights: Vec<f64> =
        (0..candidates.len()).map(|i| neighbours(i).map(|j| closeness(i, j)).sum()).collect();
    let mut heap: BinaryHeap<Crowded> =
        weights.iter().enumerate().map(|(index, &weight)| Crowded { weight, index }).collect();
    let mut kept = vec![true; candidates.len()];
    let mut left = candidates.len();
    while left > count {
        let Some(Crowded { weight, index }) = heap.pop() else { break };
        if !kept[index] {
            continue;
        }
        if weight > weights[index] {
            // Neighbours have gone since: it is less crowded than it was.
            heap.push(Crowded { weight: weights[index], index });
            continue;
        }
        kept[index] = false;
        left -= 1;
        for j in neighbours(index) {
            weights[j] -= closeness(index, j);
        }
    }
    candidates.into_iter().zip(kept).filter_map(|(root, kept)| kept.then_some(root)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::mannequin;

    #[test]
    fn guides_are_spread_evenly() {
        let head = mannequin();
        let scalp = Scalp::new(head);
        let roots = scalp.even(150, 1, Purpose::GuideRoots);
        assert_eq!(roots.len(), 150);
        let hexagonal = (2.0 * scalp.area() / (3.0_f64.sqrt() * 150.0)).sqrt();
        let nearest = |i: usize| {
            let others = (0..150).filter(|&j| j != i);
            others
                .map(|j| roots[i].position.distance(roots[j].position))
                .fold(f64::INFINITY, f64::min)
        };
        let smallest = (0..150).map(nearest).fold(f64::INFINITY, f64::min);
        assert!(smallest > 0.55 * hexagonal, "{smallest} of {hexagonal}");
    }

    #[test]
    fn roots_are_on_the_scalp_and_depend_on_the_seed_alone() {
        let head = mannequin();
        let scalp = Scalp::new(head);
        let roots = scalp.stratified(5000, 3, Purpose::HairRoots);
        for r in &roots {
            assert!(head.signed_distance().value(r.position).abs() < 1e-3);
            assert!((r.normal.length() - 1.0).abs() < 1e-12);
        }
        assert_eq!(roots, scalp.stratified(5000, 3, Purpose::HairRoots));
        assert_ne!(roots, scalp.stratified(5000, 4, Purpose::HairRoots));
    }
}
