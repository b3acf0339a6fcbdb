//! What an equilibrium is differentiated by, and what of it is differentiated.

use glam::DVec3;

use crate::rod::Rod;
use crate::section::TorsionConstant;

/// A change of the nodes of a rod, or the derivative of a number by one; one vector for each node, the root's first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShapeChange {
    /// Of positions (m, world), or derivatives by them.
    pub positions: Vec<DVec3>,
    /// Rotations of material frames (rad, world), or derivatives by them; empty for none.
    pub rotations: Vec<DVec3>,
}

impl From<Vec<DVec3>> for ShapeChange {
    /// Of positions alone.
    fn from(positions: Vec<DVec3>) -> Self {
        Self { positions, rotations: Vec::new() }
    }
}

/// A change of the parameters of a rod; zero by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterChange {
    /// Change of the natural strain u⁰ (rad/m) all along each element; empty for none.
    pub natural_strain: Vec<DVec3>,
    /// Change of the length (m): all elements become longer in proportion, each with its natural strain. Only where no other
    /// potentials than the weight act.
    pub length: f64,
    /// Change of the stiffnesses E I1, E I2, μ J (N m²).
    pub stiffness: DVec3,
    /// Change of the load per length (N/m, world): weight is `ρS g`.
    pub load: DVec3,
    /// Change of the root's position (m, world).
    pub root_position: DVec3,
    /// Rotation of the root's frame (rad, world) about the root.
    pub root_rotation: DVec3,
}

/// The derivative of a number by each parameter of a rod; units are those of the number over those of the parameter in
/// [`ParameterChange`].
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterGradient {
    /// By the natural strain all along each element.
    pub natural_strain: Vec<DVec3>,
    /// By the length; `None` where other potentials than the weight act.
    pub length: Option<f64>,
    /// By the stiffnesses E I1, E I2, μ J.
    pub stiffness: DVec3,
    /// By the load per length.
    pub load: DVec3,
    /// By the root's position.
    pub root_position: DVec3,
    /// By a rotation of the root's frame about the root.
    pub root_rotation: DVec3,
}

/// A change of what a fibre is made of; zero by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FibreChange {
    /// Of Young's modulus (Pa).
    pub youngs_modulus: f64,
    /// Of the shear modulus (Pa).
    pub shear_modulus: f64,
    /// Of the density (kg/m³).
    pub density: f64,
    /// Of the mean diameter 2√(ab) of the section (m).
    pub diameter: f64,
    /// Of the axis ratio a/b of the section.
    pub axis_ratio: f64,
}

impl FibreChange {
    /// Relative changes of a rod's stiffnesses E I1, E I2, μ J, and of its mass.
    #[must_use]
    pub fn relative(&self, rod: &Rod) -> (DVec3, f64) {
        let (material, section) = (rod.spec().material, rod.spec().section);
        let ratio = section.a() / section.b();
        let wider = self.diameter / (2.0 * section.mean_radius());
        let flatter = self.axis_ratio / ratio;
        let stiffer = self.youngs_modulus / material.youngs_modulus();
        let shear = self.shear_modulus / material.shear_modulus();
        // With the diameter d and the axis ratio q: S is as d², I1 as d⁴/q, I2 as d⁴q, J as d⁴/(q + 1/q) or, polar, d⁴(q + 1/q).
        let square = ratio * ratio;
        let rounder = match rod.spec().torsion {
            TorsionConstant::SaintVenant => (1.0 - square) / (square + 1.0),
            TorsionConstant::Polar => (square - 1.0) / (square + 1.0),
        };
        let of_section = DVec3::splat(4.0 * wider) + DVec3::new(-1.0, 1.0, rounder) * flatter;
        let stiffness = DVec3::new(stiffer, stiffer, shear) + of_section;
        (stiffness, self.density / material.density() + 2.0 * wider)
    }
}

impl ParameterGradient {
    /// The derivative along a change.
    #[must_use]
    pub fn along(&self, change: &ParameterChange) -> f64 {
        let strain = self.natural_strain.iter().zip(&change.natural_strain);
        strain.map(|(g, x)| g.dot(*x)).sum::<f64>()
            + self.length.map_or(0.0, |by| by * change.length)
            + self.stiffness.dot(change.stiffness)
            + self.load.dot(change.load)
            + self.root_position.dot(change.root_position)
            + self.root_rotation.dot(change.root_rotation)
    }

    /// By the apparent weight per length of a rod (N/m), which pulls against [`Rod::up`].
    #[must_use]
    pub fn weight(&self, rod: &Rod) -> f64 {
        -self.load.dot(rod.up())
    }

    /// By a factor of a rod's mass: other forces stay as they are.
    fn mass_factor(&self, rod: &Rod) -> f64 {
        self.load.dot(rod.spec().load.gravity * rod.mass())
    }

    /// By density (kg/m³), Young's modulus and shear modulus (Pa) of the rod's material.
    #[must_use]
    pub fn material(&self, rod: &Rod) -> [f64; 3] {
        // Each stiffness is proportional to its modulus, the weight, of gravity alone, to the density.
        let (material, k) = (rod.spec().material, rod.stiffness());
        [
            self.mass_factor(rod) / material.density(),
            (self.stiffness.x * k.x + self.stiffness.y * k.y) / material.youngs_modulus(),
            self.stiffness.z * k.z / material.shear_modulus(),
        ]
    }

    /// By the semi-axes a and b (m) of the rod's section, with its moduli and density.
    #[must_use]
    pub fn section(&self, rod: &Rod) -> [f64; 2] {
        let (section, k) = (rod.spec().section, rod.stiffness());
        let (a, b) = (section.a(), section.b());
        // S = πab, I1 = πab³/4, I2 = πa³b/4: d ln(S, I1, I2)/d ln(a, b) are their exponents.
        let weight = self.mass_factor(rod);
        let [by_i1, by_i2] = [self.stiffness.x * k.x, self.stiffness.y * k.y];
        // J = π a³b³/(a² + b²) has d ln J/d ln a = 3 − 2a²/(a² + b²); J = I1 + I2 has (I1 + 3 I2)/(I1 + I2) = 3 − 2b²/(a² + b²).
        let part = a * a / (a * a + b * b);
        let [by_a, by_b] = match rod.spec().torsion {
            TorsionConstant::SaintVenant => [3.0 - 2.0 * part, 1.0 + 2.0 * part],
            TorsionConstant::Polar => [1.0 + 2.0 * part, 3.0 - 2.0 * part],
        };
        let twist = self.stiffness.z * k.z;
        [
            (weight + by_i1 + 3.0 * by_i2 + by_a * twist) / a,
            (weight + 3.0 * by_i1 + by_i2 + by_b * twist) / b,
        ]
    }

    /// By the mean diameter 2√(ab) (m) and the axis ratio a/b of the rod's section.
    #[must_use]
    pub fn diameter(&self, rod: &Rod) -> [f64; 2] {
        // a = d √q/2, b = d/(2√q).
        let section = rod.spec().section;
        let [by_a, by_b] = self.section(rod);
        let (a, b) = (section.a() * by_a, section.b() * by_b);
        [(a + b) / (2.0 * section.mean_radius()), 0.5 * (a - b) * section.b() / section.a()]
    }

    /// By a natural strain that is the same in all elements (rad/m).
    #[must_use]
    pub fn uniform_strain(&self) -> DVec3 {
        self.natural_strain.iter().sum()
    }

    /// By the radius and the pitch (m) of a helix of [`crate::NaturalStrain::helix`].
    #[must_use]
    pub fn curl(&self, radius: f64, pitch: f64) -> [f64; 2] {
        // κ1 = R/(R² + p²), τ = p/(R² + p²), p = P/2π; d = R² + p².
        let p = pitch / std::f64::consts::TAU;
        let (square, sum) = ((radius * radius + p * p).powi(2), self.uniform_strain());
        let (away, twice) = (p * p - radius * radius, 2.0 * radius * p);
        let by_radius = (sum.x * away - sum.z * twice) / square;
        let by_p = (-sum.x * twice - sum.z * away) / square;
        [by_radius, by_p / std::f64::consts::TAU]
    }
}
