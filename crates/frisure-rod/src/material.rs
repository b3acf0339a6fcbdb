//! The elastic material of a fibre: Young's modulus, shear modulus and density.

use crate::error::{InvalidQuantity, positive};

/// Young's modulus along the fibre, shear modulus across it, and density.
///
/// The two moduli are independent: hair measures E ≈ 3.9 GPa and G ≈ 0.9 GPa \[Robbins\], which no
/// isotropic Poisson's ratio gives.
///
/// ```
/// use frisure_rod::Material;
///
/// let hair = Material::new(3.9e9, 0.9e9, 1300.0)?; // E and μ (Pa), density (kg/m³)
/// // No isotropic material is as soft in shear: ν = 0.5, the limit, gives μ = E/3.
/// let isotropic = Material::isotropic(3.9e9, 0.5, 1300.0)?;
/// assert!(hair.shear_modulus() < isotropic.shear_modulus());
/// assert!(Material::new(3.9e9, -0.9e9, 1300.0).is_err());
/// # Ok::<(), frisure_rod::InvalidQuantity>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    youngs_modulus: f64,
    shear_modulus: f64,
    density: f64,
}

impl Material {
    /// Creates a material from Young's modulus (Pa), shear modulus (Pa) and density (kg/m³).
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless all three are finite and positive.
    pub fn new(
        youngs_modulus: f64,
        shear_modulus: f64,
        density: f64,
    ) -> Result<Self, InvalidQuantity> {
        Ok(Self {
            youngs_modulus: positive("Young's modulus", youngs_modulus, "Pa")?,
            shear_modulus: positive("shear modulus", shear_modulus, "Pa")?,
            density: positive("density", density, "kg/m³")?,
        })
    }

    /// Creates a material from Young's modulus (Pa), Poisson's ratio and density (kg/m³); μ = E / 2(1 + ν).
    /// \[paper\] footnote 3
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless E and ρ are positive and −1 < ν ≤ 0.5.
    pub fn isotropic(
        youngs_modulus: f64,
        poisson_ratio: f64,
        density: f64,
    ) -> Result<Self, InvalidQuantity> {
        if !(poisson_ratio > -1.0 && poisson_ratio <= 0.5) {
            return Err(InvalidQuantity {
                quantity: "Poisson's ratio",
                value: poisson_ratio,
                unit: "",
                allowed: "greater than -1 and at most 0.5",
            });
        }
        Self::new(youngs_modulus, youngs_modulus / (2.0 * (1.0 + poisson_ratio)), density)
    }

    /// Young's modulus E (Pa).
    #[must_use]
    pub fn youngs_modulus(&self) -> f64 {
        self.youngs_modulus
    }

    /// Shear modulus μ (Pa).
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }

    /// Density ρ (kg/m³).
    #[must_use]
    pub fn density(&self) -> f64 {
        self.density
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poissons_ratio_gives_the_shear_modulus() {
        let m = Material::isotropic(3e9, 0.5, 1300.0).unwrap();
        assert!((m.shear_modulus() - 1e9).abs() < 1.0);
        assert!(Material::isotropic(3e9, 0.51, 1300.0).is_err());
        assert!(Material::isotropic(3e9, f64::NAN, 1300.0).is_err());
        assert!(Material::new(3e9, 0.0, 1300.0).is_err());
    }
}
