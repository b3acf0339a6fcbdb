//! The numbers of a description: path in scenes, field, and range, stated once.
//!
//! `HairstyleSpec::check` compares every number with its range; scene files read, document and display the numbers of this table.

use std::f64::consts::PI;

use super::description::{Flow, Hairs, HairstyleSpec, Lift};
use super::ranges::{InvalidSpec, Range};

/// A type of numeric fields.
pub trait Scalar: Copy {
    /// Returns the number (SI units).
    fn to_f64(self) -> f64;

    /// Converts from a number (SI units); whole numbers are truncated.
    fn from_f64(value: f64) -> Self;
}

impl Scalar for f64 {
    fn to_f64(self) -> f64 {
        self
    }

    fn from_f64(value: f64) -> Self {
        value
    }
}

impl Scalar for f32 {
    /// Returns the decimal number, of at most six digits after the point, that the field was set to.
    fn to_f64(self) -> f64 {
        (f64::from(self) * 1e6).round() / 1e6
    }

    fn from_f64(value: f64) -> Self {
        value as Self
    }
}

impl Scalar for usize {
    fn to_f64(self) -> f64 {
        self as f64
    }

    fn from_f64(value: f64) -> Self {
        value as Self
    }
}

/// A number of a description.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// Path in scenes and range.
    pub range: Range,
    access: Access,
}

/// Where a number is in a description.
#[derive(Clone, Copy, Debug)]
enum Access {
    /// In a field of its own.
    Field { get: fn(&HairstyleSpec) -> f64, set: fn(&mut HairstyleSpec, f64) },
    /// In a variant of a field, in several fields, or derived from them.
    Derived(fn(&HairstyleSpec) -> Vec<f64>),
    /// In a list; `HairstyleSpec::check` checks its items.
    Listed,
}

impl Number {
    /// Returns the number, if it is in a field of its own (SI units).
    #[must_use]
    pub fn get(&self, spec: &HairstyleSpec) -> Option<f64> {
        match self.access {
            Access::Field { get, .. } => Some(get(spec)),
            Access::Derived(_) | Access::Listed => None,
        }
    }

    /// Sets the number, if it is in a field of its own (SI units).
    pub fn set(&self, spec: &mut HairstyleSpec, value: f64) {
        if let Access::Field { set, .. } = self.access {
            set(spec, value);
        }
    }

    /// Whether the number is in a field of its own.
    #[must_use]
    pub fn is_field(&self) -> bool {
        matches!(self.access, Access::Field { .. })
    }

    /// Checks the number against its range.
    pub(super) fn check(&self, spec: &HairstyleSpec) -> Result<(), InvalidSpec> {
        match self.access {
            Access::Field { get, .. } => self.range.check(get(spec)),
            Access::Derived(get) => get(spec).into_iter().try_for_each(|x| self.range.check(x)),
            Access::Listed => Ok(()),
        }
    }
}

/// The accessors of a field, such as `wisps.fuzziness`.
macro_rules! field {
    ($($field:ident).+) => {
        Access::Field {
            get: |spec| spec.$($field).+.to_f64(),
            set: |spec, value| spec.$($field).+ = Scalar::from_f64(value),
        }
    };
}

/// Rows of the table: path, access, `min..max` and the allowed range in words.
macro_rules! numbers {
    ($($path:literal, $access:expr, $min:expr, $max:expr, $allowed:literal;)*) => {
        &[$(Number { range: Range::new($path, $min, $max, $allowed), access: $access }),*]
    };
}

/// All numbers of a [`HairstyleSpec`], in the order in which they are checked.
#[rustfmt::skip]
pub(super) static NUMBERS: &[Number] = numbers! {
    "hair.length", field!(length.mean), 1e-3, 3.0, "between 1 mm and 3 m";
    "hair.length_variation", field!(length.variation_between), 0.0, 0.5, "0 to 0.5";
    "hair.fibre.diameter", Access::Derived(|spec| vec![2.0 * spec.fibre.section.mean_radius()]), 5e-6, 5e-4, "between 5 um and 0.5 mm on a head; hair of the scalp has 40 to 120 um";
    "hair.fibre.youngs_modulus", Access::Derived(|spec| vec![spec.fibre.material.youngs_modulus()]), 1e6, 1e12, "between 1 MPa and 1000 GPa on a head; hair has 1 to 7 GPa";
    "hair.fibre.shear_modulus", Access::Derived(|spec| vec![spec.fibre.material.shear_modulus()]), 1e5, 1e12, "between 0.1 MPa and 1000 GPa on a head; hair has 0.2 to 2 GPa";
    "hair.fibre.density", Access::Derived(|spec| vec![spec.fibre.material.density()]), 10.0, 2e4, "between 0.01 and 20 g/cm^3 on a head; hair has 1.3";
    "hair.fibre.variation", field!(fibre.variation), 0.0, 0.5, "between 0 and 0.5";
    "hair.growth_rate", field!(length.growth_rate), 0.0, 1e-7, "between 0 and 26 cm a month";
    "hair.wetting.youngs_modulus", field!(wetting.youngs_modulus), 0.01, 1.0, "between 0.01 and 1";
    "hair.wetting.shear_modulus", field!(wetting.shear_modulus), 0.01, 1.0, "between 0.01 and 1";
    "hair.wetting.diameter", field!(wetting.diameter), 1.0, 1.5, "between 1 and 1.5";
    "hair.wetting.length", field!(wetting.length), 1.0, 1.1, "between 1 and 1.1";
    "hair.wetting.wisp", field!(wetting.wisp), 0.1, 1.0, "between 0.1 and 1";
    "hair.fibre.axis_ratio_variation", field!(fibre.axis_ratio_variation), 0.0, 1.0, "between 0 and 1";
    "hair.fibre.coherence", field!(fibre.coherence), 0.0, 1.0, "between 0 and 1";
    "hair.curl", Access::Derived(|spec| vec![spec.curl.strain.length()]), 0.0, 2e4, "a strain of at most 20000 rad/m (0.05 mm radius)";
    "hair.curl.variation_between", field!(curl.variation_between), 0.0, 1.0, "between 0 and 1";
    "hair.curl.variation_along", field!(curl.variation_along), 0.0, 1.0, "between 0 and 1";
    "hair.curl.variation_scale", field!(curl.variation_scale), 1e-3, 1.0, "1 mm to 1 m";
    "implantation.jitter", field!(implantation.jitter), 0.0, 1.0, "0 to 1 rad (57 deg)";
    "implantation.parting", Access::Derived(parting), -0.06, 0.06, "within 6 cm of the middle";
    "implantation.lift_scale", Access::Derived(lift_scale), 0.0, 6.0, "between 0 and 6";
    "implantation.lift", Access::Derived(lift), 0.0, PI / 2.0, "between 0 and 90 deg";
    "implantation.whorls", field!(implantation.whorls.count), 1.0, 2.0, "1 or 2";
    "implantation.whorl_offset", Access::Derived(|spec| spec.implantation.whorls.offset.to_vec()), -0.05, 0.05, "within 5 cm of the usual place";
    "implantation.hold", field!(implantation.hold), 0.0, 3.0, "between 0 and 3 times the weight";
    "implantation.baby_hairs", field!(implantation.baby_hairs), 0.0, 1.0, "between 0 and 1";
    "implantation.hairline.irregularity", field!(implantation.hairline.irregularity), 0.0, 0.01, "between 0 and 1 cm";
    "implantation.hairline.height", field!(implantation.hairline.height), -0.03, 0.05, "between -3 and 5 cm";
    "implantation.hairline.recession", field!(implantation.hairline.recession), 0.0, 0.04, "between 0 and 4 cm";
    "implantation.hairline.widows_peak", field!(implantation.hairline.widows_peak), 0.0, 0.03, "between 0 and 3 cm";
    "implantation.hairline.sideburns", field!(implantation.hairline.sideburns), 0.0, 0.025, "between 0 and 2.5 cm";
    "implantation.hairline.nape", field!(implantation.hairline.nape), 0.0, 0.03, "between 0 and 3 cm";
    "implantation.partings.offset", Access::Listed, -0.06, 0.06, "within 6 cm of the middle";
    "region.length", Access::Listed, 1e-3, 3.0, "between 1 mm and 3 m";
    "region.lift", Access::Listed, 0.0, PI / 2.0, "between 0 and 90 deg";
    "region.curl", Access::Listed, 0.0, 10.0, "between 0 and 10";
    "wisps.count", field!(wisps.count), 1.0, 2e4, "between 1 and 20000";
    "wisps.hairs", Access::Derived(hairs), 1.0, 1e6, "between 1 and 1000000";
    "wisps.hairs_per_wisp", Access::Derived(hairs_per_wisp), 1.0, 1e5, "between 1 and 100000";
    "wisps.density", Access::Derived(densities), 1e4, 1e7, "between 1 and 1000 1/cm^2";
    "wisps.clumping", field!(wisps.clumping), 0.0, 1.0, "between 0 and 1";
    "wisps.fuzziness", field!(wisps.fuzziness), 0.0, 2.0, "between 0 and 2";
    "wisps.length_variation", field!(wisps.length_variation), 0.0, 0.5, "0 to 0.5";
    "wisps.flyaways", field!(wisps.flyaways), 0.0, 1.0, "between 0 and 1";
    "wisps.growing", field!(wisps.growing), 0.0, 1.0, "between 0 and 1";
    "wisps.splits", field!(wisps.splits), 1.0, 100.0, "between 1 and 100";
    "wisps.split_variation", field!(wisps.split_variation), 0.0, 1.5, "0 to 1.5";
    "wisps.split_clumping", field!(wisps.split_clumping), 0.0, 1.0, "between 0 and 1";
    "wisps.subsplits", field!(wisps.subsplits), 1.0, 100.0, "between 1 and 100";
    "wisps.split_phase", field!(wisps.split_phase), 0.0, 1.0, "between 0 and 1";
    "wisps.hair_phase", field!(wisps.hair_phase), 0.0, 1.0, "between 0 and 1";
    "wisps.radius_variation", field!(wisps.radius_variation), 0.0, 0.5, "0 to 0.5";
    "wisps.profile", Access::Derived(|spec| spec.wisps.profile.to_vec()), 0.0, 10.0, "three factors between 0 and 10 each, such as [1, 1, 0.5]";
    "wisps.blending", field!(wisps.blending), 0.0, 1.0, "between 0 and 1";
    "wisps.points", field!(wisps.points), 2.0, 1000.0, "between 2 and 1000";
    "contact.stiffness", field!(contact.stiffness), 1e-6, 1e5, "between 1e-6 and 1e5 Pa";
    "contact.hair_stiffness", field!(contact.hair_stiffness), 1e-6, 1e5, "between 1e-6 and 1e5 Pa";
    "contact.volume", field!(contact.volume), 0.0, 10.0, "between 0 and 10";
    "contact.friction", field!(contact.friction), 0.0, 1.5, "between 0 and 1.5; measured on hair: 0.47 to 0.84";
    "contact.skin_friction", field!(contact.skin_friction), 0.0, 1.5, "between 0 and 1.5";
    "contact.wet_friction", field!(contact.wet_friction), 0.5, 3.0, "between 0.5 and 3";
    "contact.scales", field!(contact.scales), 1.0, 2.0, "between 1 and 2";
    "contact.lock_friction", field!(contact.lock_friction), 0.0, 1.5, "between 0 and 1.5";
    "gravity", field!(gravity), 0.0, 1000.0, "between 0 and 1000 m/s²";
    "pose.pitch", field!(pose.pitch), -PI, PI, "between -180 and 180 deg";
    "pose.roll", field!(pose.roll), -PI, PI, "between -180 and 180 deg";
    "wind.speed", field!(wind.speed), 0.0, 60.0, "between 0 and 60 m/s";
    "wind.azimuth", field!(wind.azimuth), -2.0 * PI, 2.0 * PI, "a turn at most";
    "wind.elevation", field!(wind.elevation), -PI / 2.0, PI / 2.0, "between -90 and 90 deg";
    "wind.exposure", field!(wind.exposure), 0.0, 1.0, "between 0 and 1";
    "equilibrium.elements", Access::Derived(elements), 1.0, 1000.0, "between 1 and 1000 on a head";
    "equilibrium.tolerance", field!(equilibrium.tolerance), 1e-8, 0.1, "between 1e-8 and 0.1";
};

fn parting(spec: &HairstyleSpec) -> Vec<f64> {
    match spec.implantation.flow {
        Flow::Parted { offset } => vec![offset],
        Flow::Whorl | Flow::SweptBack => Vec::new(),
    }
}

fn lift_scale(spec: &HairstyleSpec) -> Vec<f64> {
    match spec.implantation.lift {
        Lift::Regional { scale } => vec![scale],
        Lift::Uniform(_) => Vec::new(),
    }
}

fn lift(spec: &HairstyleSpec) -> Vec<f64> {
    match spec.implantation.lift {
        Lift::Regional { .. } => Vec::new(),
        Lift::Uniform(angle) => vec![angle],
    }
}

fn hairs(spec: &HairstyleSpec) -> Vec<f64> {
    match spec.wisps.hairs {
        Hairs::Count(count) => vec![count as f64],
        Hairs::PerWisp(_) | Hairs::Density(_) => Vec::new(),
    }
}

fn hairs_per_wisp(spec: &HairstyleSpec) -> Vec<f64> {
    match spec.wisps.hairs {
        Hairs::PerWisp(each) => vec![each as f64],
        Hairs::Count(_) | Hairs::Density(_) => Vec::new(),
    }
}

/// The density of the drawn hairs, and that of the hairs that grow.
fn densities(spec: &HairstyleSpec) -> Vec<f64> {
    match spec.wisps.hairs {
        Hairs::Density(drawn) => vec![drawn, spec.implantation.density],
        Hairs::Count(_) | Hairs::PerWisp(_) => vec![spec.implantation.density],
    }
}

fn elements(spec: &HairstyleSpec) -> Vec<f64> {
    match spec.equilibrium.resolution {
        frisure_rod::Resolution::Elements(n) => vec![n as f64],
        frisure_rod::Resolution::Accuracy(_) => Vec::new(),
    }
}

/// Returns the number with a path, such as `wisps.clumping`, if there is one.
#[must_use]
pub fn number(path: &str) -> Option<&'static Number> {
    NUMBERS.iter().find(|number| number.range.field == path)
}

/// Checks a number against the range of a path.
///
/// # Errors
/// [`InvalidSpec`], if it is outside.
///
/// # Panics
/// If the path is not in the table.
pub(super) fn within(path: &str, value: f64) -> Result<(), InvalidSpec> {
    number(path).expect("every checked number is in the table").range.check(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_path_has_one_range_with_room_in_it() {
        for (i, Number { range, .. }) in NUMBERS.iter().enumerate() {
            assert!(range.min < range.max, "{}", range.field);
            let other = |other: &Number| other.range.field != range.field;
            assert!(NUMBERS[..i].iter().all(other), "{}", range.field);
        }
    }

    #[test]
    fn a_field_that_is_set_out_of_its_range_is_refused_by_its_path() {
        let spec = crate::preset("caucasian-curly").unwrap().spec();
        for number in NUMBERS.iter().filter(|number| number.is_field()) {
            let mut changed = spec.clone();
            number.set(&mut changed, number.range.max + 1.0);
            assert_eq!(changed.check().unwrap_err().field, number.range.field);
            assert!(number.get(&changed) > number.get(&spec));
        }
    }
}
