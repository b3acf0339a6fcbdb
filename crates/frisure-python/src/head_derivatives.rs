//! Derivatives of a head at rest, as arrays.

use std::sync::Arc;

use frisure::hairstyle::contact::SwitchDistance;
use frisure::hairstyle::{HeadChange, HeadDerivativeError, HeadGradient, HeadSensitivity};
use frisure::progress::Cancelled;
use frisure::rod::Rod;
use frisure::rod::derivatives::{FibreChange, ParameterChange, Regularity, ShapeChange};
use frisure_engine::Error;
use frisure_engine::memory::{self, Work};
use glam::DVec3;
use numpy::ndarray::ArrayView2;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::hairstyle::Prediction;
use crate::work;

/// A head at rest, kept for its derivatives.
#[pyclass(frozen, module = "frisure._frisure")]
pub(crate) struct HeadAtRest(Arc<Kept>);

struct Kept {
    sensitivity: HeadSensitivity,
    rods: Vec<Rod>,
    /// What water and a hold make of the fibre of each guide.
    factors: Vec<FibreFactors>,
    /// Nodes of each guide.
    nodes: Vec<usize>,
}

/// Moduli, density and diameter of the rod of a guide over those of its room-dry fibre, which is what the keys of a scene describe.
struct FibreFactors {
    youngs_modulus: f64,
    shear_modulus: f64,
    density: f64,
    diameter: f64,
}

impl FibreFactors {
    fn new(rod: &Rod, fibre: &Rod) -> Self {
        let [(now, section), (dry, dry_section)] =
            [rod, fibre].map(|rod| (rod.spec().material, rod.spec().section));
        Self {
            youngs_modulus: now.youngs_modulus() / dry.youngs_modulus(),
            shear_modulus: now.shear_modulus() / dry.shear_modulus(),
            density: now.density() / dry.density(),
            diameter: section.mean_radius() / dry_section.mean_radius(),
        }
    }
}

/// The derivatives of G guides of E elements in all: by the natural strain of each element (E, 3); by a strain that is the same all along a guide, and by gravity
/// as a vector (G, 3); by moduli and density (G, 3): Young's, shear, density; by section (G, 2): diameter, axis ratio; by the stiffness of hair and of skin; by a
/// rotation of the head.
type Gradient<'py> = (
    Bound<'py, PyArray2<f64>>,
    [Bound<'py, PyArray2<f64>>; 2],
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    [f64; 2],
    [f64; 3],
);

/// The nodes of all guides (N, 3), and how many each has (G,).
type Nodes<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>);

/// Distances of each guide (G, 3), and a flag for each (G,).
type Switches<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<bool>>);

/// The changes of G guides with E elements in all, SI units: (G,) or (G, 3), and of the natural strain of each element (E, 3).
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Changes<'py> {
    natural_strain: PyReadonlyArray2<'py, f64>,
    element_strain: PyReadonlyArray2<'py, f64>,
    youngs_modulus: PyReadonlyArray1<'py, f64>,
    shear_modulus: PyReadonlyArray1<'py, f64>,
    density: PyReadonlyArray1<'py, f64>,
    diameter: PyReadonlyArray1<'py, f64>,
    axis_ratio: PyReadonlyArray1<'py, f64>,
    gravity_vector: PyReadonlyArray2<'py, f64>,
}

#[pymethods]
impl HeadAtRest {
    /// Brings the head of a prediction to rest, and prepares its derivatives.
    #[staticmethod]
    #[pyo3(signature = (prediction, progress))]
    fn of(
        py: Python<'_>,
        prediction: &Prediction,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let hair = prediction.hair.clone();
        let kept = work::run(py, progress, move |p| {
            let (hairstyle, head) = (&hair.loaded.hairstyle, &hair.loaded.head);
            memory::check(hairstyle.spec(), Work::Guides)?;
            let sensitivity = HeadSensitivity::new(hairstyle, head, p).map_err(told)?;
            let rods = hairstyle.guides().iter().map(|guide| guide.rod.clone()).collect();
            let pairs = hairstyle.guides().iter().zip(hairstyle.planned());
            let factors = pairs.map(|(now, dry)| FibreFactors::new(&now.rod, &dry.rod)).collect();
            let nodes = sensitivity.shapes().map(|shape| shape.positions.len()).collect();
            Ok(Kept { sensitivity, rods, factors, nodes })
        })?;
        Ok(Self(Arc::new(kept)))
    }

    /// The nodes of all guides (N, 3), and how many each has (G,).
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Nodes<'py>> {
        let points = self.0.sensitivity.shapes().flat_map(|shape| &shape.positions);
        let counts = self.0.nodes.iter().map(|&count| count as i64).collect();
        Ok((rows(py, points)?, PyArray1::from_vec(py, counts)))
    }

    /// The lowest eigenvalue, its residual, the relative gradient, and whether the derivatives are regular.
    fn certificate(&self) -> (f64, f64, f64, bool) {
        let head = &self.0.sensitivity;
        let (value, error) = head.lowest_eigenvalue();
        (value, error, head.gradient_norm(), head.regularity() == Regularity::Regular)
    }

    /// How far (m) each guide is from where skin begins to press, a clip pulls as hard as it can, and hair begins to press, (G, 3), and whether its
    /// derivatives hold on one side only (G,).
    fn switches<'py>(&self, py: Python<'py>) -> PyResult<Switches<'py>> {
        let switches = self.0.sensitivity.switch_distances();
        let distances: Vec<DVec3> =
            switches.iter().map(|at| DVec3::new(at.skin, at.hold, at.hair)).collect();
        let one_sided = switches.iter().map(SwitchDistance::is_one_sided).collect();
        Ok((rows(py, &distances)?, PyArray1::from_vec(py, one_sided)))
    }

    /// The derivatives of a loss from those by the nodes, (N, 3), and by their frames.
    #[pyo3(signature = (by_points, by_frames, progress))]
    fn vjp<'py>(
        &self,
        py: Python<'py>,
        by_points: PyReadonlyArray2<'py, f64>,
        by_frames: Option<PyReadonlyArray2<'py, f64>>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Gradient<'py>> {
        let kept = Arc::clone(&self.0);
        let positions = kept.by_guides(&vectors(by_points.as_array(), kept.nodes.iter().sum())?);
        let rotations = match by_frames {
            Some(by) => kept.by_guides(&vectors(by.as_array(), kept.nodes.iter().sum())?),
            None => vec![Vec::new(); kept.nodes.len()],
        };
        let by_nodes: Vec<ShapeChange> = (positions.into_iter().zip(rotations))
            .map(|(positions, rotations)| ShapeChange { positions, rotations })
            .collect();
        let of = kept.clone();
        let gradient =
            work::run(py, progress, move |_| of.sensitivity.vjp(&by_nodes).map_err(told))?;
        kept.arrays(py, &gradient)
    }

    /// How the nodes move along a change, and how their frames turn, (N, 3). `contact` are the stiffnesses of hair and of skin.
    #[pyo3(signature = (changes, contact, rotation, progress))]
    fn jvp<'py>(
        &self,
        py: Python<'py>,
        changes: Changes<'py>,
        contact: [f64; 2],
        rotation: [f64; 3],
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<[Bound<'py, PyArray2<f64>>; 2]> {
        let kept = Arc::clone(&self.0);
        let [hair_stiffness, skin_stiffness] = contact;
        let change = HeadChange {
            guides: kept.changes(&changes)?,
            hair_stiffness,
            skin_stiffness,
            rotation: DVec3::from_array(rotation),
        };
        let moved = work::run(py, progress, move |_| kept.sensitivity.jvp(&change).map_err(told))?;
        let positions = rows(py, moved.iter().flat_map(|change| &change.positions))?;
        Ok([positions, rows(py, moved.iter().flat_map(|change| &change.rotations))?])
    }
}

impl Kept {
    /// The vectors of all nodes, guide by guide.
    fn by_guides(&self, all: &[DVec3]) -> Vec<Vec<DVec3>> {
        let mut rest = all;
        let of = |&count: &usize| {
            let (own, others) = rest.split_at(count);
            rest = others;
            own.to_vec()
        };
        self.nodes.iter().map(of).collect()
    }

    fn changes(&self, changes: &Changes<'_>) -> PyResult<Vec<ParameterChange>> {
        let guides = self.rods.len();
        let strain = vectors(changes.natural_strain.as_array(), guides)?;
        let gravity = vectors(changes.gravity_vector.as_array(), guides)?;
        let elements = self.nodes.iter().sum::<usize>() - guides;
        let each = vectors(changes.element_strain.as_array(), elements)?;
        let mut each = each.as_slice();
        let guide = |(i, rod): (usize, &Rod)| {
            let at = |change: &PyReadonlyArray1<'_, f64>| change.as_array()[i];
            let by = &self.factors[i];
            let fibre = FibreChange {
                youngs_modulus: at(&changes.youngs_modulus) * by.youngs_modulus,
                shear_modulus: at(&changes.shear_modulus) * by.shear_modulus,
                density: at(&changes.density) * by.density,
                diameter: at(&changes.diameter) * by.diameter,
                axis_ratio: at(&changes.axis_ratio),
            };
            let (stiffer, heavier) = fibre.relative(rod);
            let (own, others) = each.split_at(self.nodes[i] - 1);
            each = others;
            ParameterChange {
                natural_strain: own.iter().map(|change| *change + strain[i]).collect(),
                stiffness: rod.stiffness() * stiffer,
                load: (rod.spec().load.gravity * heavier + gravity[i]) * rod.mass(),
                ..ParameterChange::default()
            }
        };
        Ok(self.rods.iter().enumerate().map(guide).collect())
    }

    fn arrays<'py>(&self, py: Python<'py>, gradient: &HeadGradient) -> PyResult<Gradient<'py>> {
        let (mut uniform, mut gravity) = (Vec::new(), Vec::new());
        let (mut material, mut section) = (Vec::new(), Vec::new());
        for ((rod, by), dry) in self.rods.iter().zip(&gradient.guides).zip(&self.factors) {
            uniform.push(by.uniform_strain());
            gravity.push(by.load * rod.mass());
            let [density, youngs_modulus, shear_modulus] = by.material(rod);
            material.push(DVec3::new(
                youngs_modulus * dry.youngs_modulus,
                shear_modulus * dry.shear_modulus,
                density * dry.density,
            ));
            let [diameter, axis_ratio] = by.diameter(rod);
            section.extend([diameter * dry.diameter, axis_ratio]);
        }
        let strains = gradient.guides.iter().flat_map(|by| &by.natural_strain);
        Ok((
            rows(py, strains)?,
            [rows(py, &uniform)?, rows(py, &gravity)?],
            rows(py, &material)?,
            PyArray1::from_vec(py, section).reshape([self.rods.len(), 2])?,
            [gradient.hair_stiffness, gradient.skin_stiffness],
            gradient.rotation.to_array(),
        ))
    }
}

/// The error of a head without derivatives: what the scene asks for, or what the numerics cannot do.
fn told(error: HeadDerivativeError) -> Error {
    match error {
        HeadDerivativeError::Cancelled => Cancelled.into(),
        HeadDerivativeError::Friction | HeadDerivativeError::NotAtRest { .. } => {
            Error::because(&error, "")
        }
        _ => Error::failed(&error, ""),
    }
}

/// The rows of an array of `count` vectors.
fn vectors(view: ArrayView2<'_, f64>, count: usize) -> PyResult<Vec<DVec3>> {
    if view.shape() != [count, 3] {
        let shape = view.shape();
        let message = format!("the shape is {shape:?}; it must be [{count}, 3]");
        return Err(PyValueError::new_err(message));
    }
    Ok(view.rows().into_iter().map(|row| DVec3::new(row[0], row[1], row[2])).collect())
}

/// An array with one vector in each row.
fn rows<'py, 'a>(
    py: Python<'py>,
    vectors: impl IntoIterator<Item = &'a DVec3>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers: Vec<f64> = vectors.into_iter().flat_map(DVec3::to_array).collect();
    let count = numbers.len() / 3;
    PyArray1::from_vec(py, numbers).reshape([count, 3])
}
