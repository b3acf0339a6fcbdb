//! What relative humidity makes of a fibre. How sure each number is: `docs/hair-types.md`, "Humidity".

/// What air of some relative humidity makes of a fibre, against air of 60 %, the state of every
/// [`HairType`](super::HairType): shares of what full wetting does.
///
/// All are 0 at 60 % and 1 in water, and negative in drier air: drier hair is stiffer, thinner and
/// shorter. The state is that of equilibrium; hair that dries holds a little more water than hair
/// that takes it up.
///
/// ```
/// use frisure_hairstyle::{Moisture, Wetting};
///
/// // A rainy day, 90 % of relative humidity.
/// let rain = Moisture::in_air(0.9);
/// // The diameter has taken about half of the way to that in water …
/// assert!((0.4..0.7).contains(&rain.swelling));
/// // … which is 6.5 % more than in a room.
/// assert_eq!(Wetting::MEASURED.diameter, 1.065);
/// assert_eq!(Moisture::in_air(0.6).swelling, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moisture {
    /// Share of the fall of Young's modulus.
    pub softening: f64,
    /// Share of the fall of the shear modulus.
    pub shear_softening: f64,
    /// Share of the growth of the diameter.
    pub swelling: f64,
    /// Share of the growth of the length.
    pub elongation: f64,
}

/// A quantity at rising relative humidities from 0 to 1, straight lines between.
type Curve = [(f64, f64)];

/// Relative humidity of the presets.
const ROOM: f64 = 0.6;

/// GPa. Dry is 2.7 times the wet, as in wool (Feughelman 1959, recalled); 90 % is derived from his
/// two-phase model, in which both moduli fall together.
const YOUNGS_MODULUS: &Curve = &[(0.0, 4.6), (ROOM, 3.9), (0.9, 3.1), (1.0, 1.7)];

/// GPa. Dry and 90 % are the ends of an axis of Harper & Kamath (2007), read, and 60 % lies on the
/// line between them; wet by the ratio of Wolfram & Albrecht (1985), recalled.
const SHEAR_MODULUS: &Curve = &[(0.0, 1.5), (ROOM, 0.97), (0.9, 0.7), (1.0, 0.21)];

/// Growth from bone-dry (%). Robbins (2012) after Stam et al. (1952), recalled.
const DIAMETER: &Curve =
    &[(0.0, 0.0), (0.1, 2.3), (0.4, 5.1), (ROOM, 6.9), (0.9, 10.6), (1.0, 13.9)];

/// Growth from bone-dry (%). Robbins (2012) after Stam et al. (1952), recalled.
const LENGTH: &Curve =
    &[(0.0, 0.0), (0.1, 0.56), (0.4, 1.29), (ROOM, 1.53), (0.9, 1.72), (1.0, 1.86)];

impl Moisture {
    /// The moisture of hair in air of a relative humidity of 0 (dry) to 1 (as in water); what lies outside is taken as
    /// the nearer of the two.
    #[must_use]
    pub fn in_air(relative_humidity: f64) -> Self {
        let humidity = relative_humidity.clamp(0.0, 1.0);
        Self {
            softening: share(YOUNGS_MODULUS, humidity),
            shear_softening: share(SHEAR_MODULUS, humidity),
            swelling: share(DIAMETER, humidity),
            elongation: share(LENGTH, humidity),
        }
    }

    /// Share of the hydrogen bonds that hold a set which the air keeps open: 0 up to room air, 1 as in water. It is taken to be that of
    /// the swelling, the water that goes between the chains. docs/hair-types.md, "Humidity"
    #[must_use]
    pub fn open(&self) -> f64 {
        self.swelling.max(0.0)
    }
}

/// How far the quantity has gone from the room's to the wet one.
fn share(curve: &Curve, humidity: f64) -> f64 {
    let (room, wet) = (at(curve, ROOM), at(curve, 1.0));
    (at(curve, humidity) - room) / (wet - room)
}

fn at(curve: &Curve, humidity: f64) -> f64 {
    // The piece that ends at the first point of at least this humidity; the first piece below it, the last beyond.
    let next = curve.partition_point(|p| p.0 < humidity).clamp(1, curve.len() - 1);
    let ((from, a), (to, b)) = (curve[next - 1], curve[next]);
    let t = (humidity - from) / (to - from);
    // Both ends exactly, so that the presets' own air changes nothing.
    a * (1.0 - t) + b * t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fibre::Wetting;

    fn shares(humidity: f64) -> [f64; 4] {
        let m = Moisture::in_air(humidity);
        [m.softening, m.shear_softening, m.swelling, m.elongation]
    }

    #[test]
    fn the_air_of_the_presets_changes_nothing_and_saturated_air_wets() {
        assert_eq!(shares(0.6), [0.0; 4]);
        assert_eq!(shares(1.0), [1.0; 4]);
    }

    #[test]
    fn each_share_grows_with_humidity_without_a_jump() {
        let steps: Vec<_> = (0..=1000).map(|i| shares(f64::from(i) / 1000.0)).collect();
        for pair in steps.windows(2) {
            for (drier, damper) in pair[0].into_iter().zip(pair[1]) {
                assert!(drier < damper && damper - drier < 0.02);
            }
        }
    }

    #[test]
    fn what_is_no_relative_humidity_is_the_nearest_that_is() {
        assert_eq!(shares(-0.2), shares(0.0));
        assert_eq!(shares(65.0), shares(1.0));
        assert_eq!(shares(f64::NEG_INFINITY), shares(0.0));
        assert!([0.0, 1.0].map(shares).as_flattened().iter().all(|s| s.is_finite()));
    }

    /// Growth from bone-dry in %, Robbins (2012) after Stam et al. (1952).
    #[test]
    fn hair_swells_as_tabulated() {
        let diameters = [(0.0, 0.0), (0.1, 2.3), (0.4, 5.1), (0.6, 6.9), (0.9, 10.6), (1.0, 13.9)];
        for (humidity, percent) in diameters {
            let growth = 6.9 + Moisture::in_air(humidity).swelling * (13.9 - 6.9);
            assert!((growth - percent).abs() < 1e-9);
        }
        let lengths = [(0.0, 0.0), (0.1, 0.56), (0.4, 1.29), (0.6, 1.53), (0.9, 1.72), (1.0, 1.86)];
        for (humidity, percent) in lengths {
            let growth = 1.53 + Moisture::in_air(humidity).elongation * (1.86 - 1.53);
            assert!((growth - percent).abs() < 1e-9);
        }
    }

    fn factors(humidity: f64) -> [f64; 2] {
        let (air, wet) = (Moisture::in_air(humidity), Wetting::MEASURED);
        [
            1.0 - air.softening * (1.0 - wet.youngs_modulus),
            1.0 - air.shear_softening * (1.0 - wet.shear_modulus),
        ]
    }

    /// In tension dry wool is 2.7 times as stiff as wet (Feughelman 1959); in torsion hair at 0 % is
    /// 15/7 times as stiff as at 90 % (Harper & Kamath 2007).
    #[test]
    fn with_the_measured_wetting_the_moduli_keep_their_ratios() {
        let [dry, damp, wet] = [0.0, 0.9, 1.0].map(factors);
        assert!((dry[0] / wet[0] - 2.7).abs() < 0.1);
        assert!((dry[1] / damp[1] - 15.0 / 7.0).abs() < 0.05);
    }

    /// Only the matrix takes up water (Feughelman 1959), so both moduli have fallen by the same share.
    #[test]
    fn damp_air_softens_alike_in_tension_and_in_torsion() {
        let damp = Moisture::in_air(0.9);
        assert!((damp.softening - damp.shear_softening).abs() < 0.02);
    }
}
