//! The distance of measured points from the rods of a fibre, and its derivatives by the unknowns.

use frisure_rod::batch::{BatchTangents, NodeMotion};
use glam::{DMat3, DQuat, DVec3};

use crate::dense::Symmetric;
use crate::pose::Pose;
use crate::unknowns::{Layout, Unknowns};

/// The points of a pose in the axes in which gravity is along −z, each at its fraction of the length.
#[derive(Clone, Debug)]
pub(crate) struct Observed {
    /// From the pose's axes to those.
    pub(crate) turn: DQuat,
    pub(crate) points: Vec<DVec3>,
    pub(crate) fractions: Vec<f64>,
    /// Whether the fractions are known. Otherwise only the distance from the line counts, but for both ends.
    pub(crate) placed: bool,
}

impl Observed {
    /// `length` (m) is that of the fibre, where arc lengths are known.
    pub(crate) fn new(pose: &Pose, length: Option<f64>) -> Self {
        let down = pose.gravity().normalize_or(DVec3::NEG_Z);
        let turn = DQuat::from_rotation_arc(down, DVec3::NEG_Z);
        let points = pose.points().iter().map(|p| turn * *p).collect();
        match (pose.arc(), length) {
            (Some(arc), Some(length)) => {
                let fractions = arc.iter().map(|s| s / length).collect();
                Self { turn, points, fractions, placed: true }
            }
            _ => Self { turn, points, fractions: Vec::new(), placed: false },
        }
    }

    /// How many numbers count.
    pub(crate) fn count(&self) -> usize {
        let points = self.points.len();
        if self.placed { 3 * points } else { 2 * points + 2 }
    }

    /// Whether all three coordinates of a point count.
    fn whole(&self, point: usize) -> bool {
        self.placed || point == 0 || point + 1 == self.points.len()
    }
}

/// The square of the distance in units of the noise, half its gradient and half its Hessian (Gauss–Newton).
#[derive(Clone, Debug)]
pub(crate) struct Normal {
    pub(crate) square: f64,
    pub(crate) gradient: Vec<f64>,
    pub(crate) matrix: Symmetric,
}

impl Normal {
    pub(crate) fn zero(n: usize) -> Self {
        Self { square: 0.0, gradient: vec![0.0; n], matrix: Symmetric::zero(n) }
    }

    /// All of it in another unit.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.square *= factor;
        self.gradient.iter_mut().for_each(|x| *x *= factor);
        self.matrix.scale(factor);
    }

    /// Adds that an unknown has this distance from what is known of it, with this deviation.
    pub(crate) fn add_prior(&mut self, unknown: usize, distance: f64, deviation: f64) {
        let weight = deviation.powi(-2);
        self.square += weight * distance * distance;
        self.gradient[unknown] += weight * distance;
        self.matrix.add_diagonal(unknown, weight);
    }
}

/// A place between two nodes: the weights of their positions and tangents.
struct Place {
    element: usize,
    /// Of both positions and both tangents; then their derivatives by the fraction of the element.
    weights: [f64; 4],
    slopes: [f64; 4],
}

impl Place {
    fn at(fraction: f64, elements: usize) -> Self {
        let x = fraction.clamp(0.0, 1.0) * elements as f64;
        let element = (x as usize).min(elements - 1);
        let t = x - element as f64;
        // Hermite's cubics.
        let (a, b) = (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t));
        Self {
            element,
            weights: [1.0 - a, a, t * (1.0 - t) * (1.0 - t), t * t * (t - 1.0)],
            slopes: [-b, b, (1.0 - t) * (1.0 - 3.0 * t), t * (3.0 * t - 2.0)],
        }
    }
}

/// The line between two nodes: a cubic with tangents that are 4 tan(θ/4)/θ as long as the element, so that it goes through the middle of
/// an arc of a circle, as in `frisure_rod::centre_line`.
struct Piece<'a> {
    nodes: &'a [(DVec3, DMat3)],
    /// Length of an element (m), its stretch, and the derivative of that by 1 − cos θ.
    spacing: f64,
    stretch: f64,
    slope: f64,
}

impl<'a> Piece<'a> {
    fn new(nodes: &'a [(DVec3, DMat3)], spacing: f64) -> Self {
        // Series of 4 tan(θ/4)/θ in q = 1 − cos θ, with θ² = 2q + q²/3 + …: 1e-4 at a radian.
        let q = 1.0 - nodes[0].1.z_axis.dot(nodes[1].1.z_axis);
        let stretch = 1.0 + q * (1.0 / 24.0 + q * 0.00903);
        Self { nodes, spacing, stretch, slope: 1.0 / 24.0 + q * 0.01806 }
    }

    fn value(&self, weights: &[f64; 4]) -> DVec3 {
        let [(x0, r0), (x1, r1)] = [self.nodes[0], self.nodes[1]];
        let tangents = r0.z_axis * weights[2] + r1.z_axis * weights[3];
        x0 * weights[0] + x1 * weights[1] + tangents * (self.spacing * self.stretch)
    }

    /// The motion of a place with those of the nodes; `longer` is the relative change of the length.
    fn moved(&self, weights: &[f64; 4], motions: &[NodeMotion], longer: f64) -> DVec3 {
        let (t0, t1) = (self.nodes[0].1.z_axis, self.nodes[1].1.z_axis);
        let (d0, d1) = (motions[0].rotation.cross(t0), motions[1].rotation.cross(t1));
        let length = self.spacing * self.stretch;
        let change = length * longer - self.spacing * self.slope * (d0.dot(t1) + t0.dot(d1));
        motions[0].shift * weights[0]
            + motions[1].shift * weights[1]
            + (d0 * weights[2] + d1 * weights[3]) * length
            + (t0 * weights[2] + t1 * weights[3]) * change
    }
}

/// Sums of products of vectors over points: of each with the rest, and of each with those up to it.
struct Products {
    count: usize,
    square: f64,
    with_rest: Vec<f64>,
    /// By rows.
    pairs: Vec<f64>,
    /// The vectors of the present point, coordinate by coordinate.
    coordinates: [Vec<f64>; 3],
}

impl Products {
    fn new(count: usize) -> Self {
        let zeros = || vec![0.0; count];
        let pairs = vec![0.0; count * count];
        let coordinates = [zeros(), zeros(), zeros()];
        Self { count, square: 0.0, with_rest: zeros(), pairs, coordinates }
    }

    /// Adds those of a point, each vector as `seen`.
    fn add(&mut self, rest: DVec3, vectors: &[DVec3], seen: impl Fn(DVec3) -> DVec3) {
        let n = self.count;
        let rest = seen(rest);
        self.square += rest.length_squared();
        let [xs, ys, zs] = &mut self.coordinates;
        for (i, vector) in vectors.iter().enumerate() {
            let vector = seen(*vector);
            self.with_rest[i] += vector.dot(rest);
            (xs[i], ys[i], zs[i]) = (vector.x, vector.y, vector.z);
        }
        for (i, row) in self.pairs.chunks_exact_mut(n).enumerate() {
            let (x, y, z) = (xs[i], ys[i], zs[i]);
            let others = xs.iter().zip(ys.iter()).zip(zs.iter());
            for (sum, ((a, b), c)) in row.iter_mut().zip(others).take(i + 1) {
                *sum += x * a + y * b + z * c;
            }
        }
    }

    /// Adds the sums to those of a fibre, of which they are some rows and columns.
    fn add_to(&self, index: &[usize], sums: &mut Normal) {
        sums.square += self.square;
        for (a, &i) in index.iter().enumerate() {
            sums.gradient[i] += self.with_rest[a];
            for (b, &k) in index.iter().enumerate().take(a + 1) {
                sums.matrix.add(i, k, self.pairs[a * self.count + b]);
            }
        }
    }
}

/// The rods of some fibres, and how they move.
pub(crate) struct Rods<'a> {
    pub(crate) tangents: &'a BatchTangents,
    /// The index of the first rod of the fibre.
    pub(crate) first: usize,
    pub(crate) layout: Layout,
    /// Standard deviation of a coordinate (m).
    pub(crate) noise: f64,
}

impl Rods<'_> {
    /// The positions (m) of the points of a pose on its rod.
    pub(crate) fn line(&self, pose: usize, spacing: f64, observed: &Observed) -> Vec<DVec3> {
        let nodes = self.tangents.nodes(self.first + pose);
        let at = |fraction: &f64| {
            let place = Place::at(*fraction, self.tangents.elements);
            Piece::new(&nodes[place.element..], spacing).value(&place.weights)
        };
        observed.fractions.iter().map(at).collect()
    }

    /// Puts each point of unknown arc length at the nearest point of the rod beside where it was.
    pub(crate) fn place(&self, pose: usize, spacing: f64, observed: &mut Observed) {
        if observed.placed {
            return;
        }
        let nodes = self.tangents.nodes(self.first + pose);
        let elements = self.tangents.elements as f64;
        let last = observed.points.len() - 1;
        for (point, at) in observed.points.iter().zip(&mut observed.fractions).take(last).skip(1) {
            // Newton's method on the distance, with the curvature of the line left out: two steps of at most an element.
            for _ in 0..2 {
                let place = Place::at(*at, self.tangents.elements);
                let piece = Piece::new(&nodes[place.element..], spacing);
                let tangent = piece.value(&place.slopes);
                let step =
                    (*point - piece.value(&place.weights)).dot(tangent) / tangent.length_squared();
                if step.is_finite() {
                    *at = (*at + step.clamp(-1.0, 1.0) / elements).clamp(0.0, 1.0);
                }
            }
        }
    }

    /// Adds the points of a pose to the sums of its fibre.
    pub(crate) fn add(
        &self,
        pose: usize,
        state: usize,
        spacing: f64,
        observed: &Observed,
        sums: &mut Normal,
    ) {
        let rod = self.first + pose;
        let (nodes, layout) = (self.tangents.nodes(rod), self.layout);
        let unknowns = self.columns(pose, state);
        let longer = unknowns.len() - 4;
        let weight = self.noise.recip();
        let place_of = layout.pose(pose);
        let index: Vec<usize> = unknowns.iter().copied().chain(place_of..place_of + 3).collect();
        let mut moved = vec![DVec3::ZERO; index.len()];
        moved[unknowns.len()..].copy_from_slice(&DVec3::AXES);
        let mut products = Products::new(index.len());
        for (j, (point, fraction)) in observed.points.iter().zip(&observed.fractions).enumerate() {
            let place = Place::at(*fraction, self.tangents.elements);
            let pair = place.element..place.element + 2;
            let piece = Piece::new(&nodes[pair.clone()], spacing);
            let rest = piece.value(&place.weights) - *point;
            for (k, moved) in moved.iter_mut().take(unknowns.len()).enumerate() {
                let motions = &self.tangents.motions(rod, k)[pair.clone()];
                let by_length = if k == longer { 1.0 } else { 0.0 };
                *moved = piece.moved(&place.weights, motions, by_length);
            }
            if observed.whole(j) {
                products.add(rest, &moved, |v| v * weight);
            } else {
                // The place of the point along the line is free.
                let tangent = piece.value(&place.slopes).normalize_or_zero();
                products.add(rest, &moved, |v| (v - tangent * tangent.dot(v)) * weight);
            }
        }
        products.add_to(&index, sums);
    }

    /// The unknown of each direction of [`crate::unknowns::directions`].
    fn columns(&self, pose: usize, state: usize) -> Vec<usize> {
        let layout = self.layout;
        let turn = layout.pose(pose) + 3;
        (0..2 * layout.knots)
            .chain([layout.stiffness(state), layout.ratio(state)])
            .chain([layout.section(), layout.length(state)])
            .chain(turn..turn + 3)
            .collect()
    }
}

/// Length of an element (m) of a pose's rod.
pub(crate) fn spacing(unknowns: &Unknowns, pose: &Pose, elements: usize) -> f64 {
    unknowns.length[pose.state()].exp() / elements as f64
}
