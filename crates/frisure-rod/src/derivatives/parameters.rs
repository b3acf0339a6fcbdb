//! What an equilibrium is differentiated by.

use glam::DVec3;

use crate::rod::Rod;

/// A change of the parameters of a rod; zero by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterChange {
    /// Change of the mean natural strain u⁰ (rad/m) of each element; empty for none.
    pub natural_strain: Vec<DVec3>,
    /// Change of the stiffnesses E I1, E I2, μ J (N m²).
    pub stiffness: DVec3,
    /// Change of the load per length (N/m, world): weight is `−ρSg e_z`.
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
    /// By the mean natural strain of each element.
    pub natural_strain: Vec<DVec3>,
    /// By the stiffnesses E I1, E I2, μ J.
    pub stiffness: DVec3,
    /// By the load per length.
    pub load: DVec3,
    /// By the root's position.
    pub root_position: DVec3,
    /// By a rotation of the root's frame about the root.
    pub root_rotation: DVec3,
}

impl ParameterGradient {
    /// The derivative along a change.
    #[must_use]
    pub fn along(&self, change: &ParameterChange) -> f64 {
        let strain = self.natural_strain.iter().zip(&change.natural_strain);
        strain.map(|(g, x)| g.dot(*x)).sum::<f64>()
            + self.stiffness.dot(change.stiffness)
            + self.load.dot(change.load)
            + self.root_position.dot(change.root_position)
            + self.root_rotation.dot(change.root_rotation)
    }

    /// By the weight per length ρSg (N/m), which pulls along −z.
    #[must_use]
    pub fn weight(&self) -> f64 {
        -self.load.z
    }

    /// By density (kg/m³), Young's modulus and shear modulus (Pa) of the rod's material.
    #[must_use]
    pub fn material(&self, rod: &Rod) -> [f64; 3] {
        // Each stiffness is proportional to its modulus, the weight to the density.
        let (material, k) = (rod.spec().material, rod.stiffness());
        [
            self.weight() * rod.weight() / material.density(),
            (self.stiffness.x * k.x + self.stiffness.y * k.y) / material.youngs_modulus(),
            self.stiffness.z * k.z / material.shear_modulus(),
        ]
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
