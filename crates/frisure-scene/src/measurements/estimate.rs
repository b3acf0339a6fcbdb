//! What measured numbers make of a fibre and its curl, and what they leave open.

use std::f64::consts::{PI, TAU};

use frisure_hairstyle::{NaturalCurl, PRESETS, Preset, preset};

use super::choices::{Choices, Steepness};
use super::error::{MeasurementError, per_millimetre};
use super::heading::Property;
use super::readings::Readings;
use super::sample::Sample;
use super::table::Table;
use crate::quantity::LENGTH;

/// Types that differ in nothing but the curl, from which the nearest is taken.
const BY_CURL: [&str; 5] = ["straight", "wavy", "curly", "coily", "kinky"];

/// The type of hair whose curl nobody measured.
const WITHOUT_CURL: &str = "caucasian-straight";

/// Mean diameters that scalp hair has (m).
const DIAMETERS: (f64, f64) = (35e-6, 140e-6);

/// Mean curvature (1/m) below which short fragments do not tell hair that is straight from hair that
/// is wavy.
const FRAGMENTS_TELL_FROM: f64 = 150.0;

/// A fibre and its curl, as far as measured. SI units.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// The type that everything else comes from.
    pub hair_type: &'static Preset,
    /// Mean diameter, that of a circle of the same area (m).
    pub diameter: Option<Sample>,
    /// Ratio of the longer to the shorter axis.
    pub axis_ratio: Option<Sample>,
    /// Natural curvature (1/m): of hair laid flat without weight.
    pub curvature: Option<Sample>,
    /// Standard deviation of the curvature along a hair, as a fraction, and of how many hairs that is
    /// the median.
    pub variation_along: Option<(f64, usize)>,
    /// Radius and pitch of the natural helix (m).
    pub helix: Option<(f64, f64)>,
    /// Length of the hair (m).
    pub length: Option<Sample>,
    /// Young's modulus (Pa).
    pub youngs_modulus: Option<Sample>,
    /// Shear modulus (Pa).
    pub shear_modulus: Option<Sample>,
    /// Mass per volume (kg/m³).
    pub density: Option<Sample>,
    /// The tables' file names.
    pub(super) sources: Vec<String>,
    /// In words: what was not measured and how it is filled in, and what looks odd.
    pub notes: Vec<String>,
}

impl Estimate {
    pub(super) fn of(tables: &[Table], choices: &Choices) -> Result<Self, MeasurementError> {
        let readings = Readings::of(tables, choices)?;
        let sample = |property| readings.sample(property);
        let curvature = sample(Property::Curvature);
        let radius = sample(Property::CurlRadius);
        let hair_type = choices.hair_type.unwrap_or_else(|| nearest(&curvature, &radius));
        let mut estimate = Self {
            hair_type,
            diameter: sample(Property::Diameter),
            axis_ratio: sample(Property::AxisRatio),
            variation_along: readings.variation_along(Property::Curvature),
            length: sample(Property::Length),
            youngs_modulus: sample(Property::YoungsModulus),
            shear_modulus: sample(Property::ShearModulus),
            density: sample(Property::Density),
            sources: tables.iter().map(Table::name).collect(),
            notes: readings.notes.clone(),
            curvature,
            helix: None,
        };
        estimate.helix = estimate.find_helix(&readings, choices.steepness)?;
        estimate.look_for_oddities(readings.of_fragments, choices);
        Ok(estimate)
    }

    /// The helix, from the curvature and a second number, or from radius and pitch.
    fn find_helix(
        &mut self,
        readings: &Readings,
        asked: Option<Steepness>,
    ) -> Result<Option<(f64, f64)>, MeasurementError> {
        let mean = |property| readings.sample(property).map(|s| s.mean);
        let told = asked
            .or(mean(Property::Pitch).map(Steepness::Pitch))
            .or(mean(Property::CurlRadius).map(Steepness::Radius))
            .or(mean(Property::CurlIndex).map(Steepness::CurlIndex))
            .or(mean(Property::Turns).map(Steepness::Turns));
        let name = self.hair_type.name;
        let of_type = self.hair_type.hair_type().curl;
        let curvature = self.curvature.as_ref().map(|c| c.mean).filter(|c| *c > 0.0);
        let curl = match (curvature, told, mean(Property::CurlRadius)) {
            (Some(curvature), Some(steepness), _) => helix(curvature, steepness)?,
            (Some(curvature), None, _) => {
                let angle = (TAU * of_type.radius).atan2(of_type.pitch).to_degrees();
                self.notes.push(format!(
                    "Torsion was not measured: a hair laid flat does not tell how far its curl advances \
                     in a turn. The curl is as steep as that of the type `{name}` ({angle:.0} deg between \
                     hair and axis); `--pitch`, `--radius`, `--curl-index` or `--turns` says better."
                ));
                with_slope(curvature, of_type.pitch / (TAU * of_type.radius))
            }
            (None, Some(Steepness::Pitch(pitch)), Some(radius)) => (radius, pitch),
            (None, _, Some(radius)) => {
                let pitch = of_type.pitch * radius / of_type.radius;
                self.notes.push(format!(
                    "The pitch was not measured: the curl is as steep as that of the type `{name}`."
                ));
                (radius, pitch)
            }
            (None, _, None) => {
                self.notes.push(format!("No curl was measured: it is that of the type `{name}`."));
                return Ok(None);
            }
        };
        Ok(Some(curl))
    }

    fn look_for_oddities(&mut self, of_fragments: bool, choices: &Choices) {
        let name = self.hair_type.name;
        let mut note = |text: String| self.notes.push(text);
        if choices.shape_only {
            note(format!("Sizes of sections were left out; the diameter is that of `{name}`."));
        }
        if let Some(d) = &self.diameter
            && !(DIAMETERS.0..DIAMETERS.1).contains(&d.mean)
        {
            note(format!(
                "A mean diameter of {} is not that of scalp hair, which has 40 to 120 um: is the scale of \
                 the micrographs right? `--shape-only` takes the axis ratio and no size.",
                LENGTH.written(d.mean)
            ));
        }
        if let Some(c) = &self.curvature {
            if of_fragments && c.mean < FRAGMENTS_TELL_FROM {
                note(format!(
                    "A curvature of {} is near what fragments of a few millimetres read where hair is \
                     straight (0.03 to 0.1 1/mm): the hair may be straighter than this.",
                    per_millimetre(c.mean)
                ));
            }
            if c.mean > 1.25 * c.median {
                note(format!(
                    "The mean curvature, {}, is well above the median, {}: a few hairs rule it, or \
                     hairs that crossed were read as curls.",
                    per_millimetre(c.mean),
                    per_millimetre(c.median)
                ));
            }
        }
        let few = |s: &Option<Sample>| s.as_ref().is_some_and(|s| s.deviation.is_none());
        let left_out = [
            (few(&self.diameter), "diameters"),
            (few(&self.axis_ratio), "axis ratios"),
            (few(&self.curvature), "curvatures"),
        ];
        let left_out: Vec<&str> =
            left_out.into_iter().filter(|(few, _)| *few).map(|(_, what)| what).collect();
        if !left_out.is_empty() {
            note(format!(
                "How much {} differ between hairs is not told (it takes single hairs, five or more, or a \
                 deviation): that of the type `{name}`.",
                left_out.join(" and ")
            ));
        }
        if self.curvature.is_some() && self.variation_along.is_none() {
            note(format!(
                "How the curvature varies along a hair is not told (it takes windows along hairs): that \
                 of the type `{name}`."
            ));
        } else if self.curvature.is_some() {
            note(format!(
                "Fragments tell how curvature varies along their own length and no more; over which length \
                 it varies is that of the type `{name}`."
            ));
        }
    }
}

/// The type with the nearest curvature, or the nearest radius of the curl.
fn nearest(curvature: &Option<Sample>, radius: &Option<Sample>) -> &'static Preset {
    let far = |curl: &NaturalCurl| match (curvature, radius) {
        (Some(c), _) if c.mean > 0.0 => (curl.curvature() / c.mean).ln().abs(),
        (Some(_), _) => curl.curvature(),
        (None, Some(r)) => (curl.radius / r.mean).ln().abs(),
        (None, None) => 0.0,
    };
    if curvature.is_none() && radius.is_none() {
        return preset(WITHOUT_CURL).unwrap_or(&PRESETS[0]);
    }
    let types = PRESETS.iter().filter(|p| BY_CURL.contains(&p.name));
    let near = types.min_by(|a, b| far(&a.hair_type().curl).total_cmp(&far(&b.hair_type().curl)));
    near.unwrap_or(&PRESETS[0])
}

/// Radius and pitch (m) of the helix of a curvature (1/m) whose pitch is so many times its
/// circumference.
fn with_slope(curvature: f64, slope: f64) -> (f64, f64) {
    let radius = 1.0 / (curvature * (1.0 + slope * slope));
    (radius, TAU * radius * slope)
}

/// Radius and pitch (m) of the helix of curvature κ (1/m) and torsion τ: R = κ/(κ² + τ²),
/// P = 2πτ/(κ² + τ²).
fn helix(curvature: f64, steepness: Steepness) -> Result<(f64, f64), MeasurementError> {
    let refuse = |what: &str, allowed: String| MeasurementError::NoHelix {
        what: what.to_owned(),
        curvature: per_millimetre(curvature),
        allowed,
    };
    let torsion = match steepness {
        Steepness::Pitch(0.0) => 0.0,
        Steepness::Pitch(pitch) => {
            let turn = TAU / pitch;
            let square = turn * turn - 4.0 * curvature * curvature;
            if !(square >= 0.0) {
                let what = format!("a pitch of {}", LENGTH.written(pitch));
                let most = LENGTH.written(PI / curvature);
                return Err(refuse(&what, format!("at most {most}")));
            }
            // Of two helices of this curvature and pitch the one that is more curl than wave.
            0.5 * (turn - square.sqrt())
        }
        Steepness::Radius(radius) => {
            if !(radius * curvature <= 1.0) {
                let what = format!("a radius of {}", LENGTH.written(radius));
                return Err(refuse(&what, format!("at most {}", LENGTH.written(1.0 / curvature))));
            }
            (curvature / radius - curvature * curvature).max(0.0).sqrt()
        }
        Steepness::CurlIndex(index) => {
            if !(index > 1.0) {
                return Err(refuse(&format!("a curl index of {index}"), "more than 1".to_owned()));
            }
            curvature / (index * index - 1.0).sqrt()
        }
        Steepness::Turns(turns) => {
            let square = (TAU * turns).powi(2) - curvature * curvature;
            if !(square >= 0.0) {
                let what = format!("{turns:.4} turns per metre");
                return Err(refuse(&what, format!("at least {:.4}", curvature / TAU)));
            }
            square.sqrt()
        }
    };
    let square = curvature * curvature + torsion * torsion;
    Ok((curvature / square, TAU * torsion / square))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_second_number_finds_the_same_helix() {
        let curl = NaturalCurl {
            radius: 0.010,
            pitch: 0.024,
            variation_between: 0.0,
            variation_along: 0.0,
            variation_scale: 0.03,
        };
        let second = [
            Steepness::Pitch(curl.pitch),
            Steepness::Radius(curl.radius),
            Steepness::CurlIndex(curl.curl_index()),
            Steepness::Turns(curl.turns_per_length()),
        ];
        for steepness in second {
            let (radius, pitch) = helix(curl.curvature(), steepness).unwrap();
            assert!((radius - curl.radius).abs() < 1e-12, "{steepness:?}: {radius}");
            assert!((pitch - curl.pitch).abs() < 1e-12, "{steepness:?}: {pitch}");
        }
        let slope = curl.pitch / (TAU * curl.radius);
        let (radius, pitch) = with_slope(curl.curvature(), slope);
        assert!((radius - curl.radius).abs() < 1e-12 && (pitch - curl.pitch).abs() < 1e-12);
    }

    #[test]
    fn what_no_helix_of_the_curvature_has() {
        let impossible = [
            Steepness::Pitch(0.1),
            Steepness::Radius(0.02),
            Steepness::CurlIndex(1.0),
            Steepness::Turns(1.0),
        ];
        for steepness in impossible {
            let error = helix(100.0, steepness).unwrap_err();
            assert!(matches!(error, MeasurementError::NoHelix { .. }), "{steepness:?}: {error}");
        }
    }
}
