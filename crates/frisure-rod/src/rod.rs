//! The rod: length, section, material, natural strain, clamp and load, checked when made.

use glam::{DMat3, DVec3};

use crate::error::{InvalidQuantity, finite, positive};
use crate::load::{Load, direction_and_length};
use crate::material::Material;
use crate::section::{Section, TorsionConstant};
use crate::strain::NaturalStrain;

/// Where and how a rod is clamped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    position: DVec3,
    frame: DMat3,
}

impl Root {
    /// Creates a clamp from a position (m) and the three directors of the material frame there: d1 and d2 along
    /// the principal axes of the section, t the tangent. They are made orthonormal exactly.
    ///
    /// # Errors
    /// [`InvalidQuantity`] if a number is not finite, or if the directors are not right-handed and
    /// orthonormal to within 1e-3.
    pub fn new(position: DVec3, d1: DVec3, d2: DVec3, t: DVec3) -> Result<Self, InvalidQuantity> {
        for x in position.to_array() {
            finite("coordinate of the root", x, "m")?;
        }
        let given = DMat3::from_cols(d1, d2, t);
        for x in given.to_cols_array() {
            finite("component of a root director", x, "")?;
        }
        // RᵀR − I vanishes for an orthonormal frame; det R < 0 is a left-handed one.
        let gram = given.transpose() * given - DMat3::IDENTITY;
        let error = gram.to_cols_array().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if !(error < 1e-3) || given.determinant() < 0.0 {
            return Err(InvalidQuantity {
                quantity: "departure of the root frame from a right-handed orthonormal one",
                value: if given.determinant() < 0.0 { 2.0 } else { error },
                unit: "",
                allowed: "less than 1e-3: d1, d2, t of length 1, at right angles, d1 × d2 = t",
            });
        }
        // Gram–Schmidt from the tangent, which matters most: the direction in which the hair leaves stays as given.
        let t = t.normalize();
        let d1 = (d1 - t * t.dot(d1)).normalize();
        Ok(Self { position, frame: DMat3::from_cols(d1, t.cross(d1), t) })
    }

    /// Creates a clamp from a position (m), the tangent, and a direction to which d1 is as close as possible.
    ///
    /// # Errors
    /// [`InvalidQuantity`] if a number is not finite, the tangent has no length, or d1 is along it.
    pub fn from_tangent(
        position: DVec3,
        tangent: DVec3,
        d1: DVec3,
    ) -> Result<Self, InvalidQuantity> {
        let length = positive("length of the root tangent", tangent.length(), "")?;
        let t = tangent / length;
        let across = d1 - t * t.dot(d1);
        let length = positive("part of d1 at right angles to the tangent", across.length(), "")?;
        let d1 = across / length;
        Self::new(position, d1, t.cross(d1), t)
    }

    /// Position (m).
    #[must_use]
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Material frame, columns d1, d2, t.
    #[must_use]
    pub fn frame(&self) -> DMat3 {
        self.frame
    }
}

/// Everything that a [`Rod`] is made from; SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct RodSpec {
    /// Length (m).
    pub length: f64,
    /// Elliptical section.
    pub section: Section,
    /// Moduli and density.
    pub material: Material,
    /// Which torsion constant the section is given.
    pub torsion: TorsionConstant,
    /// Natural strain.
    pub natural: NaturalStrain,
    /// Where it is clamped.
    pub root: Root,
    /// Gravity and other forces all along it; may be none.
    pub load: Load,
}

/// An inextensible, unshearable rod, clamped at its root and free at its tip.
///
/// ```
/// use frisure_rod::{Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant};
/// use glam::DVec3;
///
/// let spec = RodSpec {
///     length: 0.15,
///     section: Section::circular(35e-6)?,
///     material: Material::new(3.9e9, 0.9e9, 1300.0)?, // E and μ (Pa), density (kg/m³)
///     torsion: TorsionConstant::SaintVenant,
///     natural: NaturalStrain::STRAIGHT,
///     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
///     load: Load::down(9.81), // m/s²
/// };
/// let rod = Rod::new(spec.clone())?;
/// assert!((rod.heaviness() - 36.0).abs() < 1.0); // Γ: weight against elasticity
///
/// let error = Rod::new(RodSpec { length: -0.15, ..spec }).unwrap_err();
/// assert_eq!(error.to_string(), "length is -0.15 m; it must be a finite number greater than zero");
/// # Ok::<(), frisure_rod::InvalidQuantity>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Rod {
    spec: RodSpec,
    stiffness: DVec3,
    mass: f64,
    up: DVec3,
    weight: f64,
}

/// The most that a bending stiffness counts in [`Rod::moment_scale`], in the smallest stiffness of the rod. Chosen: beyond hair, whose
/// stiffnesses differ by up to 28 times, flat by five to one.
const STIFFEST: f64 = 100.0;

impl Rod {
    /// The rod of a specification.
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the length is positive, the load finite, the
    /// natural strain finite, and stiffness and weight representable.
    pub fn new(spec: RodSpec) -> Result<Self, InvalidQuantity> {
        positive("length", spec.length, "m")?;
        spec.natural.check()?;
        spec.load.check()?;
        let (section, material) = (spec.section, spec.material);
        // K = diag(E I1, E I2, μ J). Products of tiny numbers may vanish in f64, hence the checks.
        let stiffness = DVec3::new(
            positive("bending stiffness E I1", material.youngs_modulus() * section.i1(), "N m²")?,
            positive("bending stiffness E I2", material.youngs_modulus() * section.i2(), "N m²")?,
            positive(
                "torsional stiffness G J",
                material.shear_modulus() * section.j(spec.torsion),
                "N m²",
            )?,
        );
        let mass = material.density() * section.area();
        let (up, weight) = direction_and_length(-spec.load.per_length(mass));
        finite("weight per length", weight, "N/m")?;
        Ok(Self { spec, stiffness, mass, up, weight })
    }

    /// What the rod was made from.
    #[must_use]
    pub fn spec(&self) -> &RodSpec {
        &self.spec
    }

    /// Length L (m).
    #[must_use]
    pub fn length(&self) -> f64 {
        self.spec.length
    }

    /// Natural strain (rad/m).
    #[must_use]
    pub fn natural(&self) -> &NaturalStrain {
        &self.spec.natural
    }

    /// The clamp.
    #[must_use]
    pub fn root(&self) -> &Root {
        &self.spec.root
    }

    /// Stiffness against κ1, κ2 and τ: E I1, E I2, μ J (N m²). \[paper\] (2.3)
    #[must_use]
    pub fn stiffness(&self) -> DVec3 {
        self.stiffness
    }

    /// Mass per length ρ S (kg/m).
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Apparent weight per length (N/m): the size of the load, ρ S g where gravity alone acts. \[paper\] (2.4)
    #[must_use]
    pub fn weight(&self) -> f64 {
        self.weight
    }

    /// The apparent vertical (world, unit): against the load; +z where there is none.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// The load per length (N/m, world): [`Self::weight`] against [`Self::up`].
    #[must_use]
    pub fn load(&self) -> DVec3 {
        -self.up * self.weight
    }

    /// Γ = ρ S g L³ / EI with the smaller bending stiffness: weight against elasticity.
    #[must_use]
    pub fn heaviness(&self) -> f64 {
        self.weight * self.length().powi(3) / self.stiffness.x.min(self.stiffness.y)
    }

    /// The moment that gradients are measured against: EI/L + ρ S g L² (N m), with the larger bending
    /// stiffness, but at most a hundred times the smallest of the three. Beside the stiffness of a fibre that hardly
    /// twists, or of one that hardly bends but twists, the moment of its weight would be small, and any shape would be at rest.
    #[must_use]
    pub fn moment_scale(&self) -> f64 {
        let bending = self.stiffness.x.max(self.stiffness.y);
        let counted = bending.min(STIFFEST * self.stiffness.min_element());
        counted / self.length() + self.weight * self.length().powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_frames_are_checked() {
        let o = DVec3::ZERO;
        assert!(Root::new(o, DVec3::X, DVec3::Y, DVec3::Z).is_ok());
        assert!(Root::new(o, DVec3::Y, DVec3::X, DVec3::Z).is_err());
        assert!(Root::new(o, DVec3::X, DVec3::X, DVec3::Z).is_err());
        assert!(Root::new(o, DVec3::X, DVec3::NAN, DVec3::Z).is_err());
        assert!(Root::new(o, DVec3::X * 2.0, DVec3::Y, DVec3::Z).is_err());
        assert!(Root::from_tangent(o, DVec3::Z, DVec3::Z).is_err());
        let r = Root::from_tangent(o, DVec3::new(1.0, 1.0, 0.0), DVec3::Z).unwrap();
        assert!((r.frame().determinant() - 1.0).abs() < 1e-15);
    }
}
