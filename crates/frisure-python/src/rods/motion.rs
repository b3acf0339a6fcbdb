//! How many rods at rest move along changes of their properties.

use frisure::progress::{Cancelled, Progress, StageCounter};
use frisure::rod::batch::{Batch, BatchGradient, BatchLoss, BatchSolution, Direction, NodeMotion};
use frisure::rod::derivatives::{FibreChange, LEAST_EIGENVALUE, ParameterChange, Sensitivity};
use frisure::rod::minimise::Problem;
use frisure::rod::{Chain, ElementKind, Rod};
use frisure_engine::Error;
use glam::DVec3;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSlice;

use super::clamp::Clamps;
use super::kept::{Kept, mass_per_length};

/// Changes of rods in SI units: each has one row for all rods, or one for each; none where nothing changes.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Changes<'py> {
    length: Option<PyReadonlyArray1<'py, f64>>,
    diameter: Option<PyReadonlyArray1<'py, f64>>,
    axis_ratio: Option<PyReadonlyArray1<'py, f64>>,
    youngs_modulus: Option<PyReadonlyArray1<'py, f64>>,
    shear_modulus: Option<PyReadonlyArray1<'py, f64>>,
    density: Option<PyReadonlyArray1<'py, f64>>,
    gravity: Option<PyReadonlyArray1<'py, f64>>,
    gravity_vector: Option<PyReadonlyArray2<'py, f64>>,
    root: Option<PyReadonlyArray2<'py, f64>>,
    tangent: Option<PyReadonlyArray2<'py, f64>>,
    d1: Option<PyReadonlyArray2<'py, f64>>,
    root_rotation: Option<PyReadonlyArray2<'py, f64>>,
    /// Of the natural strain: one all along, or one for each half of an element.
    strain: Option<PyReadonlyArray3<'py, f64>>,
}

/// [`Changes`] in memory of their own.
pub(super) struct OwnedChanges {
    length: Numbers,
    diameter: Numbers,
    axis_ratio: Numbers,
    youngs_modulus: Numbers,
    shear_modulus: Numbers,
    density: Numbers,
    gravity: Numbers,
    gravity_vector: Vectors,
    root: Vectors,
    tangent: Vectors,
    d1: Vectors,
    root_rotation: Vectors,
    strain: Vectors,
    /// Strains in a row.
    strains: usize,
}

/// A number of each rod, one for all, or none.
struct Numbers(Vec<f64>);

/// Vectors of each rod, those for all, or none.
struct Vectors(Vec<DVec3>);

/// How rods move: coordinates of nodes one rod after the other.
pub(super) struct Moved {
    /// Shifts of the nodes (m).
    pub(super) points: Vec<f64>,
    /// Rotations of their frames (rad, world).
    pub(super) frames: Vec<f64>,
    /// Changes of the energy (J).
    pub(super) energy: Vec<f64>,
    /// Whether each rod is far from a loss of stability, and whether it has derivatives.
    pub(super) regular: Vec<bool>,
    pub(super) exists: Vec<bool>,
}

impl Numbers {
    fn new(given: Option<&PyReadonlyArray1<'_, f64>>) -> Self {
        Self(given.map(|array| array.as_array().to_vec()).unwrap_or_default())
    }

    fn at(&self, rod: usize) -> f64 {
        match self.0.len() {
            0 => 0.0,
            1 => self.0[0],
            _ => self.0[rod],
        }
    }
}

impl Vectors {
    fn new(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        Self(values.chunks_exact(3).map(DVec3::from_slice).collect())
    }

    fn table(given: Option<&PyReadonlyArray2<'_, f64>>) -> Self {
        given.map_or(Self(Vec::new()), |array| Self::new(array.as_array().iter().copied()))
    }

    /// Those of a rod, `each` in a row.
    fn at(&self, rod: usize, each: usize) -> &[DVec3] {
        match self.0.len() / each.max(1) {
            0 => &[],
            1 => &self.0,
            _ => &self.0[rod * each..(rod + 1) * each],
        }
    }

    fn one(&self, rod: usize) -> DVec3 {
        self.at(rod, 1).first().copied().unwrap_or_default()
    }
}

impl Changes<'_> {
    pub(super) fn owned(&self) -> OwnedChanges {
        let strain = self.strain.as_ref().map(PyReadonlyArray3::as_array);
        OwnedChanges {
            length: Numbers::new(self.length.as_ref()),
            diameter: Numbers::new(self.diameter.as_ref()),
            axis_ratio: Numbers::new(self.axis_ratio.as_ref()),
            youngs_modulus: Numbers::new(self.youngs_modulus.as_ref()),
            shear_modulus: Numbers::new(self.shear_modulus.as_ref()),
            density: Numbers::new(self.density.as_ref()),
            gravity: Numbers::new(self.gravity.as_ref()),
            gravity_vector: Vectors::table(self.gravity_vector.as_ref()),
            root: Vectors::table(self.root.as_ref()),
            tangent: Vectors::table(self.tangent.as_ref()),
            d1: Vectors::table(self.d1.as_ref()),
            root_rotation: Vectors::table(self.root_rotation.as_ref()),
            strain: Vectors::new(strain.iter().flat_map(|array| array.iter().copied())),
            strains: strain.map_or(0, |array| array.dim().1),
        }
    }
}

impl OwnedChanges {
    /// The change of a rod as a direction of the solver in lanes, in parts of what the rod has.
    fn direction(&self, rod: &Rod, clamps: &Clamps, index: usize) -> Direction {
        let turned = clamps.of(index).rotation(self.tangent.one(index), self.d1.one(index));
        let fibre = FibreChange {
            youngs_modulus: self.youngs_modulus.at(index),
            shear_modulus: self.shear_modulus.at(index),
            density: self.density.at(index),
            diameter: self.diameter.at(index),
            axis_ratio: self.axis_ratio.at(index),
        };
        let (stiffness, heavier) = fibre.relative(rod);
        let gravity = rod.spec().load.gravity.length();
        let stronger = if gravity > 0.0 { self.gravity.at(index) / gravity } else { 0.0 };
        Direction {
            natural_strain: self.strain.at(index, self.strains).to_vec(),
            stiffness,
            weight: heavier + stronger,
            length: self.length.at(index) / rod.length(),
            root_rotation: self.root_rotation.one(index) + turned,
        }
    }

    /// The change of the load per length (N/m) that is none of its size: another direction, or of a rod without weight.
    fn load(&self, rod: &Rod, index: usize) -> DVec3 {
        let weightless = rod.spec().load.gravity == DVec3::ZERO;
        let down = if weightless { DVec3::NEG_Z * self.gravity.at(index) } else { DVec3::ZERO };
        (self.gravity_vector.one(index) + down) * mass_per_length(rod)
    }
}

/// How rods move along changes.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn of(
    kept: &Kept,
    changes: &OwnedChanges,
    progress: &dyn Progress,
) -> Result<Moved, Error> {
    let nodes = kept.elements + 1;
    let stage = StageCounter::new(progress, "derivatives", kept.found.len());
    let chunks = kept.rods.par_chunks(kept.chunk).zip(&kept.found).enumerate();
    let moved = chunks.map(|(chunk, (rods, found))| {
        stage.check()?;
        let first = chunk * kept.chunk;
        // At rest the shape does not count: the energy changes as its own derivatives say.
        let ones = vec![1.0; rods.len()];
        let loss = BatchLoss { energies: &ones, ..BatchLoss::default() };
        let energies = Batch::default().vjp(rods, found, loss);
        let least = found.min_eigenvalues(rods);
        let moved = |i: usize| {
            let direction = changes.direction(&rods[i], &kept.clamps, first + i);
            let motions = one(&rods[i], found, i, changes, (first + i, &direction))?;
            let load = changes.load(&rods[i], first + i);
            let energy = energy(&rods[i], &energies, i, &direction, load);
            let finite =
                |motion: &NodeMotion| motion.shift.is_finite() && motion.rotation.is_finite();
            let regular = least[i] >= LEAST_EIGENVALUE && motions.iter().all(finite);
            Some((motions, energy, regular))
        };
        let moved: Vec<Option<_>> = (0..rods.len()).map(moved).collect();
        stage.advance();
        Ok::<_, Cancelled>(moved)
    });
    let moved: Vec<_> = moved.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    let exists = moved.iter().map(Option::is_some).collect();
    let still = vec![NodeMotion::default(); nodes];
    let energy = moved.iter().map(|moved| moved.as_ref().map_or(0.0, |(_, energy, _)| *energy));
    let energy = energy.collect();
    let regular = moved.iter().map(|moved| matches!(moved, Some((_, _, true)))).collect();
    let motions =
        moved.iter().flat_map(|moved| moved.as_ref().map_or(&still, |(motions, _, _)| motions));
    let (mut points, mut frames) = (Vec::new(), Vec::new());
    for motion in motions {
        points.extend(motion.shift.to_array());
        frames.extend(motion.rotation.to_array());
    }
    Ok(Moved { points, frames, energy, regular, exists })
}

/// By how much the energy of a rod changes (J) along a direction and a change of its load (N/m), from its derivatives; `place` as in [`one`].
fn energy(rod: &Rod, by: &BatchGradient, place: usize, direction: &Direction, load: DVec3) -> f64 {
    let load = rod.load() * direction.weight + load;
    let n = by.elements;
    let halves = by.natural_strain[place * n..(place + 1) * n].iter().flatten();
    let by = &by.rods[place];
    let strain: f64 = match direction.natural_strain.as_slice() {
        [same] => halves.map(|half| half.dot(*same)).sum(),
        each => halves.zip(each).map(|(half, change)| half.dot(*change)).sum(),
    };
    strain
        + by.stiffness.dot(direction.stiffness * rod.stiffness())
        + by.load.dot(load)
        + by.length * direction.length * rod.length()
        + by.root_rotation.dot(direction.root_rotation)
}

/// How the nodes of a rod move; none without derivatives. `place` is its index in the solution, `index` that of all rods, and `direction` the change
/// that is one for the solver in lanes.
fn one(
    rod: &Rod,
    found: &BatchSolution,
    place: usize,
    changes: &OwnedChanges,
    (index, direction): (usize, &Direction),
) -> Option<Vec<NodeMotion>> {
    let n = found.elements;
    // The directions of a call are those of all its rods, and here each rod has its own.
    let alone = BatchSolution {
        elements: n,
        controls: found.controls[place * n..(place + 1) * n].to_vec(),
        rods: vec![found.rods[place]],
    };
    let directions = std::slice::from_ref(direction);
    let tangents = Batch::default().jvp(std::slice::from_ref(rod), &alone, directions);
    tangents.existence[0].ok()?;
    let mut motions = tangents.motions(0, 0).to_vec();
    let shift = changes.root.one(index);
    motions.iter_mut().for_each(|motion| motion.shift += shift);
    let load = changes.load(rod, index);
    if load != DVec3::ZERO {
        let chain = Chain::uniform(rod, ElementKind::Jointed, n);
        let at = Sensitivity::new(&Problem::new(&chain, &[]), alone.shape(rod, 0)).ok()?;
        let more = at.jvp(&ParameterChange { load, ..ParameterChange::default() }).ok()?;
        for (motion, (shift, turn)) in
            motions.iter_mut().zip(more.positions.iter().zip(&more.rotations))
        {
            motion.shift += *shift;
            motion.rotation += *turn;
        }
    }
    Some(motions)
}
