//! Rods that several tests use.

#![allow(dead_code, reason = "each test file uses some of these")]

use frisure_rod::minimise::Problem;
use frisure_rod::potential::{Derivatives, ElementState, Field, NodeState, Potential};
use frisure_rod::{
    ElementKind, Load, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Section,
    SplitMix64, TorsionConstant,
};
use glam::{DMat3, DVec3};
use serde_json::Value;

/// A 15 cm curl of radius 5 mm and pitch 10 mm, its elliptical section 100 µm wide.
pub(crate) fn curl() -> RodSpec {
    RodSpec {
        length: 0.15,
        section: Section::from_semi_axes(50e-6, 35e-6).unwrap(),
        material: Material::new(3e9, 1.1e9, 1300.0).unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::helix(0.005, 0.010).unwrap(),
        root: Root::from_tangent(DVec3::ZERO, DVec3::new(1.0, 0.3, 0.4), DVec3::Y).unwrap(),
        load: Load::down(9.81),
    }
}

/// A straight circular rod of given heaviness Γ = ρSgL³/EI, leaving along `tangent`.
pub(crate) fn straight(gamma: f64, tangent: DVec3) -> Rod {
    let section = Section::circular(40e-6).unwrap();
    let material = Material::isotropic(3e9, 0.45, 1300.0).unwrap();
    let ei = 3e9 * section.i1();
    let length = (gamma * ei / (1300.0 * section.area() * 9.81)).cbrt();
    let across = tangent.any_orthonormal_vector();
    Rod::new(RodSpec {
        length,
        section,
        material,
        torsion: TorsionConstant::SaintVenant,
        natural: NaturalStrain::STRAIGHT,
        root: Root::from_tangent(DVec3::ZERO, tangent, across).unwrap(),
        load: Load::down(9.81),
    })
    .unwrap()
}

/// A given number of elements of one kind, and nothing beyond the equilibrium itself.
pub(crate) fn elements(n: usize, element: ElementKind) -> Options {
    Options {
        resolution: Resolution::Elements(n),
        element,
        estimate_error: false,
        ..Options::default()
    }
}

/// The default search to an accuracy that is a fraction of the length.
pub(crate) fn accuracy(rod: &Rod, fraction: f64) -> Options {
    Options { resolution: Resolution::Accuracy(fraction * rod.length()), ..Options::default() }
}

/// A spring that pulls every node to a point: a user's own potential.
pub(crate) struct Spring {
    /// Stiffness per length of rod (N/m²).
    pub(crate) stiffness: f64,
    /// Where it pulls (m).
    pub(crate) anchor: DVec3,
}

impl Potential for Spring {
    fn depends_on_position(&self) -> bool {
        true
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        let away = node.position - self.anchor;
        0.5 * self.stiffness * node.weight * away.length_squared()
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        let k = self.stiffness * node.weight;
        sum.position += (node.position - self.anchor) * k;
        sum.position_position += DMat3::from_diagonal(DVec3::splat(k));
    }
}

/// A field with a Hessian that varies and a slope along the rod: `½ k (1 + s/L) |r − a|² (1 + |r − a|²/b²)`.
pub(crate) struct Well {
    /// Stiffness per length of rod (N/m²).
    pub(crate) stiffness: f64,
    /// Its middle (m).
    pub(crate) anchor: DVec3,
    /// Distance b at which it has become twice as deep (m).
    pub(crate) breadth: f64,
    /// Length L (m).
    pub(crate) length: f64,
}

impl Field for Well {
    fn energy(&self, s: f64, position: DVec3) -> f64 {
        let square = (position - self.anchor).length_squared();
        let k = self.stiffness * (1.0 + s / self.length);
        0.5 * k * square * (1.0 + square / self.breadth.powi(2))
    }

    fn derivatives(&self, s: f64, position: DVec3) -> Option<(DVec3, DMat3)> {
        let away = position - self.anchor;
        let b2 = self.breadth.powi(2);
        let k = self.stiffness * (1.0 + s / self.length);
        let slope = k * (1.0 + 2.0 * away.length_squared() / b2);
        let outer = DMat3::from_cols(away * away.x, away * away.y, away * away.z);
        Some((away * slope, DMat3::from_diagonal(DVec3::splat(slope)) + outer * (4.0 * k / b2)))
    }
}

/// A force and a moment on the tip, both conservative.
pub(crate) struct TipWrench {
    /// Index of the tip's node.
    pub(crate) node: usize,
    /// Force (N), in the world.
    pub(crate) force: DVec3,
    /// Moment (N m) when the tip's frame is `frame`, in that frame.
    pub(crate) moment: DVec3,
    /// Where the moment is that.
    pub(crate) frame: DMat3,
}

impl TipWrench {
    /// `½ R*[M]×`: the energy −⟨A, R⟩ is linear in the frame and has the slope −M at R = R*.
    fn matrix(&self) -> DMat3 {
        let m = self.moment * 0.5;
        let cross = DMat3::from_cols(m.cross(DVec3::X), m.cross(DVec3::Y), m.cross(DVec3::Z));
        self.frame * cross
    }
}

impl Potential for TipWrench {
    fn depends_on_position(&self) -> bool {
        true
    }

    fn node_energy(&self, node: &NodeState) -> f64 {
        if node.index != self.node {
            return 0.0;
        }
        let (a, r) = (self.matrix().to_cols_array(), node.frame.to_cols_array());
        let product: f64 = a.iter().zip(r).map(|(a, r)| a * r).sum();
        -self.force.dot(node.position) - product
    }

    fn add_node_derivatives(&self, node: &NodeState, sum: &mut Derivatives) {
        if node.index != self.node {
            return;
        }
        sum.position -= self.force;
        // ⟨A, R exp[η]⟩ = ⟨B, I + [η] + ½[η]²⟩ with B = RᵀA, and [η]² = ηηᵀ − |η|² I.
        let b = node.frame.transpose() * self.matrix();
        let skew =
            DVec3::new(b.y_axis.z - b.z_axis.y, b.z_axis.x - b.x_axis.z, b.x_axis.y - b.y_axis.x);
        sum.rotation -= skew;
        let trace = b.x_axis.x + b.y_axis.y + b.z_axis.z;
        sum.rotation_rotation -= (b + b.transpose()) * 0.5;
        sum.rotation_rotation += DMat3::from_diagonal(DVec3::splat(trace));
    }
}

/// A dead load on the controls that makes any shape an equilibrium, and adds nothing to its second
/// variation.
pub(crate) struct Hold {
    /// Gradient without it (J), one per element.
    pub(crate) gradient: Vec<DVec3>,
}

impl Potential for Hold {
    fn depends_on_position(&self) -> bool {
        false
    }

    fn element_energy(&self, element: &ElementState<'_>) -> f64 {
        -self.gradient[element.index].dot(element.control)
    }

    fn add_element_derivatives(&self, element: &ElementState<'_>, sum: &mut Derivatives) {
        sum.control -= self.gradient[element.index];
    }
}

/// Hair of all kinds: any root, section, curl and heaviness.
pub(crate) fn hair(random: &mut SplitMix64) -> RodSpec {
    let (tangent, d1) = (random.direction(), random.direction());
    let curl = if random.unit() < 0.2 {
        NaturalStrain::STRAIGHT
    } else {
        let pitch = random.decades(0.003, 0.1) * if random.unit() < 0.5 { 1.0 } else { -1.0 };
        NaturalStrain::helix(random.decades(0.002, 0.05), pitch).unwrap()
    };
    RodSpec {
        length: random.between(0.02, 0.3),
        section: Section::from_diameter(random.between(45e-6, 100e-6), random.between(1.0, 1.9))
            .unwrap(),
        material: Material::new(random.between(1e9, 4e9), random.between(0.4e9, 1.3e9), 1300.0)
            .unwrap(),
        torsion: TorsionConstant::SaintVenant,
        natural: curl,
        root: Root::from_tangent(DVec3::ZERO, tangent, d1).unwrap(),
        load: Load::down(9.81),
    }
}
/// One of the equilibria in tests/data/reference_cases.json; its header names their source.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) rod: Rod,
    pub(crate) tip: DVec3,
    pub(crate) elastic: f64,
    pub(crate) gravity: f64,
    /// At 240 helix elements.
    pub(crate) min_eigenvalue: f64,
    /// Errors of plain helix elements: number, tip over length, energy (J).
    pub(crate) helix_errors: Vec<(usize, f64, f64)>,
}

fn vector(v: &Value) -> DVec3 {
    DVec3::new(v[0].as_f64().unwrap(), v[1].as_f64().unwrap(), v[2].as_f64().unwrap())
}

pub(crate) fn reference_cases() -> Vec<Case> {
    let data: Value = serde_json::from_str(include_str!("../data/reference_cases.json")).unwrap();
    data["cases"].as_array().unwrap().iter().map(reference_case).collect()
}

fn reference_case(case: &Value) -> Case {
    let f = |v: &Value| v.as_f64().unwrap();
    let (axes, moduli, root) = (&case["semi_axes"], &case["moduli"], &case["root"]);
    let spec = RodSpec {
        length: f(&case["length"]),
        section: Section::from_semi_axes(f(&axes[0]), f(&axes[1])).unwrap(),
        material: Material::new(f(&moduli[0]), f(&moduli[1]), f(&case["density"])).unwrap(),
        torsion: match case["torsion"].as_str().unwrap() {
            "polar" => TorsionConstant::Polar,
            "saint_venant" => TorsionConstant::SaintVenant,
            other => panic!("{other}"),
        },
        natural: NaturalStrain::Uniform(vector(&case["natural"])),
        root: Root::new(DVec3::ZERO, vector(&root[0]), vector(&root[1]), vector(&root[2])).unwrap(),
        load: Load::down(f(&case["gravity"])),
    };
    let helix_errors = [5, 10, 15, 20, 30, 60, 120, 240]
        .map(|n: usize| {
            let at = |key: &str| f(&case[key][n.to_string().as_str()]);
            (n, at("helix_tip_error"), at("helix_energy_error"))
        })
        .to_vec();
    Case {
        name: case["name"].as_str().unwrap().to_owned(),
        rod: Rod::new(spec).unwrap(),
        tip: vector(&case["tip"]),
        elastic: f(&case["elastic"]),
        gravity: f(&case["weight_energy"]),
        min_eigenvalue: f(&case["min_eigenvalue_n240"]),
        helix_errors,
    }
}

/// The Hessian of the energy by all controls, from central differences of the gradient, scaled by
/// the elastic stiffness on both sides: K^(−1/2) H K^(−1/2).
pub(crate) fn dense_hessian(problem: &Problem<'_>, controls: &[DVec3], rod: &Rod) -> Vec<Vec<f64>> {
    let n = controls.len();
    let step = 1e-5;
    let chain = problem.chain();
    let stiffness = rod.stiffness() * (n as f64 / rod.length());
    let gradient = |i: usize, axis: usize, h: f64| {
        let mut c = controls.to_vec();
        c[i][axis] += h;
        problem.gradient(&chain.shape(c))
    };
    let mut rows = vec![vec![0.0; 3 * n]; 3 * n];
    for i in 0..n {
        for axis in 0..3 {
            let (up, down) = (gradient(i, axis, step), gradient(i, axis, -step));
            for j in 0..n {
                let slope = (up[j] - down[j]) / (2.0 * step);
                for k in 0..3 {
                    rows[3 * j + k][3 * i + axis] =
                        slope[k] / (stiffness[k] * stiffness[axis]).sqrt();
                }
            }
        }
    }
    rows
}

/// The smallest eigenvalue of a symmetric matrix, by Jacobi's rotations.
pub(crate) fn smallest_eigenvalue(mut a: Vec<Vec<f64>>) -> f64 {
    let n = a.len();
    for _ in 0..60 {
        for p in 0..n {
            for q in p + 1..n {
                let theta = 0.5 * (a[p][q] + a[q][p]).atan2(a[q][q] - a[p][p]);
                let (s, c) = theta.sin_cos();
                for row in &mut a {
                    let (x, y) = (row[p], row[q]);
                    (row[p], row[q]) = (c * x - s * y, s * x + c * y);
                }
                let (above, below) = a.split_at_mut(q);
                for (x, y) in above[p].iter_mut().zip(&mut below[0]) {
                    (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
                }
            }
        }
    }
    (0..n).map(|i| a[i][i]).fold(f64::INFINITY, f64::min)
}
