//! What pulls on hair: gravity, in the direction that the pose of the head gives it, and wind.

use frisure_digest::digestible;
use glam::DVec3;

digestible! {
    /// How the head is held against gravity. The frame of the head stays as it is; gravity turns in it.
    #[derive(Clone, Copy, Debug, Default, PartialEq)]
    pub struct Pose {
        /// How far the head nods: forward, the face down, is positive (rad).
        pub pitch: f64,
        /// How far the head leans to its left (rad), before it nods.
        pub roll: f64,
    }
}

impl Pose {
    /// The direction in which gravity pulls, in the frame of the head: x to its left, y back, z up (unit).
    #[must_use]
    pub fn down(&self) -> DVec3 {
        // The head is turned by R = R_x(pitch) R_y(roll): gravity, −z of the world, is −Rᵀ e_z in its frame.
        let (sp, cp) = self.pitch.sin_cos();
        let (sr, cr) = self.roll.sin_cos();
        DVec3::new(cp * sr, -sp, -cp * cr)
    }

    /// The pose in which gravity pulls in this direction of the head's frame; none without a direction.
    ///
    /// ```
    /// use frisure_hairstyle::Pose;
    /// use glam::DVec3;
    ///
    /// let on_the_back = Pose::of(DVec3::Y).unwrap();
    /// assert!((on_the_back.pitch.to_degrees() + 90.0).abs() < 1e-9);
    /// assert!(on_the_back.down().distance(DVec3::Y) < 1e-15);
    /// ```
    #[must_use]
    pub fn of(down: DVec3) -> Option<Self> {
        let down = down.try_normalize()?;
        // Where the head lies on its face or back, any lean is the same pose.
        let across = down.x.hypot(down.z);
        let roll = if across > 1e-12 { down.x.atan2(-down.z) } else { 0.0 };
        Some(Self { pitch: (-down.y).atan2(across), roll })
    }
}

digestible! {
    /// A steady wind: a force that is the same on every length of hair, whatever its direction.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Wind {
        /// Speed far from the head (m/s).
        pub speed: f64,
        /// Where it comes from (rad): 0 from before the face, π/2 from the head's left.
        pub azimuth: f64,
        /// How far above the level of the head it comes from (rad); negative is from below.
        pub elevation: f64,
        /// Part of the drag of a single hair in the open that acts on each hair of the head, 0 to 1; the others shelter it.
        pub exposure: f64,
    }
}

/// Part of the drag in the open that reaches a hair on a head, on average.
///
/// All hairs together feel about the drag of the head as a bluff body, ½ρ v² · 0.035 m². Each of 100 000 hairs of 25 cm and 70 µm
/// in the open would feel [`Wind::drag`]: in all 110 times as much at 5 m/s, 90 times at 10 m/s. An estimate, not measured.
const SHELTERED: f64 = 0.01;

/// Density (kg/m³) and kinematic viscosity (m²/s) of air at 20 °C and 1013 hPa. \[White 2006\] table A.2
const AIR: (f64, f64) = (1.204, 1.51e-5);

impl Default for Wind {
    /// Calm air.
    fn default() -> Self {
        Self { speed: 0.0, azimuth: 0.0, elevation: 0.0, exposure: SHELTERED }
    }
}

impl Wind {
    /// Force (N/m) on a cylinder of this diameter (m) across the wind.
    ///
    /// `½ ρ v² d C_D` with `C_D = 1 + 10 Re^(−2/3)` and `Re = v d/ν`, a fit to measurements for 1e-4 < Re < 2e5:
    /// \[White 2006\] (3-225). Hair in wind of 1 to 20 m/s has Re of 5 to 100.
    #[must_use]
    pub fn drag(&self, diameter: f64) -> f64 {
        let (density, viscosity) = AIR;
        let reynolds = self.speed * diameter / viscosity;
        if reynolds <= 0.0 {
            return 0.0;
        }
        let coefficient = 1.0 + 10.0 * reynolds.powf(-2.0 / 3.0);
        0.5 * density * self.speed * self.speed * diameter * coefficient
    }

    /// The direction in which it blows, in the frame of the head (unit).
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        let (sa, ca) = self.azimuth.sin_cos();
        let (se, ce) = self.elevation.sin_cos();
        -DVec3::new(sa * ce, -ca * ce, se)
    }
}

#[cfg(test)]
mod tests {
    use frisure_rod::{Load, Section};

    use super::*;

    #[test]
    fn an_upright_head_has_gravity_along_minus_z_to_the_bit() {
        let spec = crate::preset("caucasian-curly").unwrap().spec();
        let section = Section::circular(35e-6).unwrap();
        assert_eq!(spec.load(&section), Load::down(9.81));
    }

    #[test]
    fn poses_and_directions_are_the_same() {
        let half = std::f64::consts::FRAC_PI_2;
        let down = |pitch, roll| Pose { pitch, roll }.down();
        // The face down; on the back; the left ear down.
        assert!(down(half, 0.0).distance(DVec3::NEG_Y) < 1e-15);
        assert!(down(-half, 0.0).distance(DVec3::Y) < 1e-15);
        assert!(down(0.0, half).distance(DVec3::X) < 1e-15);
        assert!(down(2.0 * half, 0.0).distance(DVec3::Z) < 1e-15);
        for i in 0..200 {
            let i = f64::from(i);
            let way = DVec3::new((1.7 * i).sin(), (2.3 * i).sin(), (0.9 * i + 1.0).sin());
            let way = way.normalize();
            assert!(Pose::of(way).unwrap().down().distance(way) < 1e-12, "{way}");
        }
        assert_eq!(Pose::of(DVec3::ZERO), None);
    }

    #[test]
    fn drag_is_that_of_measured_cylinders() {
        // [Tritton 1959] fig. 2: C_D of circular cylinders, read to 10 %.
        for (reynolds, measured) in
            [(1.0, 10.0), (5.0, 4.3), (10.0, 2.9), (40.0, 1.6), (100.0, 1.24)]
        {
            let diameter = 70e-6;
            let speed = reynolds * AIR.1 / diameter;
            let drag = Wind { speed, ..Wind::default() }.drag(diameter);
            let coefficient = drag / (0.5 * AIR.0 * speed * speed * diameter);
            assert!((coefficient / measured - 1.0).abs() < 0.2, "Re {reynolds}: {coefficient}");
        }
        assert_eq!(Wind::default().drag(70e-6), 0.0);
    }

    #[test]
    fn wind_blows_away_from_where_it_comes_from() {
        let of = |azimuth: f64, elevation: f64| Wind { azimuth, elevation, ..Wind::default() };
        assert!(of(0.0, 0.0).direction().distance(DVec3::Y) < 1e-15);
        assert!(of(1.0_f64.asin(), 0.0).direction().distance(DVec3::NEG_X) < 1e-15);
        assert!(of(0.0, -1.0_f64.asin()).direction().distance(DVec3::Z) < 1e-15);
    }
}
