//! The elliptical section of a fibre and its moments: area, I1, I2, torsion constant.

use std::f64::consts::PI;

use crate::error::{InvalidQuantity, positive};

/// An elliptical section with semi-axis `a` along the director d1 and `b` along d2.
///
/// Hair has `a ≥ b`, so that it bends most easily about d1; nothing here needs that.
///
/// ```
/// use frisure_rod::Section;
///
/// // A hair of 70 µm whose section has axes as 1.4 to 1.
/// let section = Section::from_diameter(70e-6, 1.4)?;
/// assert!((section.axis_ratio() - 1.4).abs() < 1e-12);
/// assert!((2.0 * section.mean_radius() - 70e-6).abs() < 1e-18);
/// // It bends more easily about d1 than about d2, by the square of the ratio.
/// assert!((section.i2() / section.i1() - 1.96).abs() < 1e-12);
/// # Ok::<(), frisure_rod::InvalidQuantity>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    a: f64,
    b: f64,
}

/// Which torsion constant J an elliptical section is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TorsionConstant {
    /// J = π a³b³/(a² + b²), exact for an ellipse that may warp (Saint-Venant).
    #[default]
    SaintVenant,
    /// J = I1 + I2, the axial moment that the paper uses; the two agree for a circle.
    Polar,
}

impl Section {
    /// Creates a section from its semi-axes along d1 and d2 (m).
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless both are finite and positive.
    pub fn from_semi_axes(a: f64, b: f64) -> Result<Self, InvalidQuantity> {
        Ok(Self { a: positive("semi-axis a", a, "m")?, b: positive("semi-axis b", b, "m")? })
    }

    /// Creates a circular section from its radius (m).
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the radius is finite and positive.
    pub fn circular(radius: f64) -> Result<Self, InvalidQuantity> {
        let r = positive("radius", radius, "m")?;
        Ok(Self { a: r, b: r })
    }

    /// Creates a section from its mean radius √(ab) (m) and eccentricity ε = √(1 − b²/a²), 0 for a circle.
    ///
    /// The area does not depend on ε, so neither does the weight: docs/theory.md, "The section and the material".
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the radius is positive and 0 ≤ ε < 1.
    pub fn from_mean_radius(radius: f64, eccentricity: f64) -> Result<Self, InvalidQuantity> {
        let r = positive("mean radius", radius, "m")?;
        if !(0.0..1.0).contains(&eccentricity) {
            return Err(InvalidQuantity {
                quantity: "eccentricity",
                value: eccentricity,
                unit: "",
                allowed: "at least 0 (a circle) and less than 1",
            });
        }
        // b/a = √(1 − ε²) and ab = r².
        let root = (1.0 - eccentricity * eccentricity).sqrt().sqrt();
        Ok(Self { a: r / root, b: r * root })
    }

    /// Creates a section from its mean diameter 2√(ab) (m) and axis ratio a/b ≥ 1, as fibres are measured.
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the diameter is positive and the ratio finite and at least 1.
    pub fn from_diameter(diameter: f64, axis_ratio: f64) -> Result<Self, InvalidQuantity> {
        let r = 0.5 * positive("mean diameter", diameter, "m")?;
        if !(axis_ratio >= 1.0 && axis_ratio.is_finite()) {
            return Err(InvalidQuantity {
                quantity: "axis ratio",
                value: axis_ratio,
                unit: "",
                allowed: "a finite number of at least 1 (a circle)",
            });
        }
        // a/b is the ratio and ab = r².
        let root = axis_ratio.sqrt();
        Ok(Self { a: r * root, b: r / root })
    }

    /// Semi-axis along d1 (m).
    #[must_use]
    pub fn a(&self) -> f64 {
        self.a
    }

    /// Semi-axis along d2 (m).
    #[must_use]
    pub fn b(&self) -> f64 {
        self.b
    }

    /// Mean radius √(ab) (m).
    #[must_use]
    pub fn mean_radius(&self) -> f64 {
        (self.a * self.b).sqrt()
    }

    /// Ratio of the longer to the shorter axis, at least 1.
    #[must_use]
    pub fn axis_ratio(&self) -> f64 {
        (self.a / self.b).max(self.b / self.a)
    }

    /// Eccentricity ε = √(1 − (short/long)²), 0 for a circle.
    #[must_use]
    pub fn eccentricity(&self) -> f64 {
        (1.0 - self.axis_ratio().powi(-2)).max(0.0).sqrt()
    }

    /// Area S = πab (m²).
    #[must_use]
    pub fn area(&self) -> f64 {
        PI * self.a * self.b
    }

    /// Second moment I1 = πab³/4 about d1 (m⁴). \[paper\] §2.3
    #[must_use]
    pub fn i1(&self) -> f64 {
        0.25 * PI * self.a * self.b.powi(3)
    }

    /// Second moment I2 = πa³b/4 about d2 (m⁴). \[paper\] §2.3
    #[must_use]
    pub fn i2(&self) -> f64 {
        0.25 * PI * self.a.powi(3) * self.b
    }

    /// Torsion constant J (m⁴), see [`TorsionConstant`].
    #[must_use]
    pub fn j(&self, kind: TorsionConstant) -> f64 {
        match kind {
            TorsionConstant::SaintVenant => {
                // Warping lowers J below the axial moment. docs/theory.md, "The section and the material"
                PI * (self.a * self.b).powi(3) / (self.a * self.a + self.b * self.b)
            }
            TorsionConstant::Polar => self.i1() + self.i2(),
        }
    }

    /// The same section, larger by a factor, as hair swells when wet.
    ///
    /// # Errors
    /// [`InvalidQuantity`] unless the factor is finite and positive.
    pub fn scaled(&self, factor: f64) -> Result<Self, InvalidQuantity> {
        Self::from_semi_axes(self.a * factor, self.b * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_ways_to_say_a_section_agree() {
        let s = Section::from_semi_axes(50e-6, 30e-6).unwrap();
        let r = Section::from_mean_radius(s.mean_radius(), s.eccentricity()).unwrap();
        let d = Section::from_diameter(2.0 * s.mean_radius(), s.axis_ratio()).unwrap();
        for t in [r, d] {
            assert!((t.a() / s.a() - 1.0).abs() < 1e-14 && (t.b() / s.b() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn both_torsion_constants_agree_on_a_circle() {
        let s = Section::circular(40e-6).unwrap();
        let exact = 0.5 * PI * 40e-6_f64.powi(4);
        assert!((s.j(TorsionConstant::SaintVenant) / exact - 1.0).abs() < 1e-14);
        assert!((s.j(TorsionConstant::Polar) / exact - 1.0).abs() < 1e-14);
    }

    #[test]
    fn ellipticity_leaves_the_area() {
        let circle = Section::from_mean_radius(40e-6, 0.0).unwrap();
        let ellipse = Section::from_mean_radius(40e-6, 0.8).unwrap();
        assert!((circle.area() / ellipse.area() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn nonsense_is_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Section::circular(bad).is_err());
            assert!(Section::from_semi_axes(1e-5, bad).is_err());
            assert!(Section::from_mean_radius(bad, 0.0).is_err());
        }
        assert!(Section::from_mean_radius(1e-5, 1.0).is_err());
        assert!(Section::from_mean_radius(1e-5, f64::NAN).is_err());
        assert!(Section::from_diameter(1e-5, 0.9).is_err());
    }
}
