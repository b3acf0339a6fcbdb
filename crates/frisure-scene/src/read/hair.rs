//! Reading `[hair]` and `[wisps]`.

use frisure_hairstyle::{Curl, Fibre, HairModel, Hairs, HairstyleSpec, Preset, StrandContact};
use frisure_rod::{InvalidQuantity, Material, Section, StrainProfile};
use glam::DVec3;

use crate::choice::OneOf;
use crate::document::Document;
use crate::error::{Result, SceneError};
use crate::key_location::quantity_error;
use crate::keywords::Keyword;
use crate::kind::Vector;

/// Largest ratio of a section's axes; measured hair reaches 3.
const MAX_AXIS_RATIO: f64 = 20.0;

/// Largest radius and pitch of a natural helix (m). Chosen: hair is straight long before, and a unit was mistaken.
const WIDEST: f64 = 100.0;

/// Largest natural curvature and torsion (rad/m): a radius of 10 µm, less than a hair is thick. Chosen: heads have at most 20 000, a unit
/// was mistaken, and a hair of a million turns in an element is not computed.
const CURLIEST: f64 = 1e5;

/// Farthest place of a natural strain along a hair (m): no hair is as long.
const FARTHEST: f64 = 100.0;

/// The fibre, whose variations are [numbers](Document::set_fields).
pub(super) fn fibre(document: &Document<'_>, preset: &Preset, default: Fibre) -> Result<Fibre> {
    let refuse = |e: InvalidQuantity| quantity_error(&e, document.source);
    let base = match document.get::<OneOf<Keyword<_>>>("hair.ellipticity")? {
        Some(Keyword(ellipticity)) => preset.hair_type().fibre(ellipticity).map_err(refuse)?,
        None => default,
    };
    let section = section(document, base.section)?;
    let value = section.axis_ratio();
    // The ratio of the two semi-axes, which are what is kept, has rounding.
    if value > MAX_AXIS_RATIO * (1.0 + 1e-12) {
        let (quantity, allowed) = match document.number("hair.fibre.eccentricity") {
            Some(_) => (
                "eccentricity",
                "at most 0.9987, an axis ratio of 20; that of hair is at most 0.94",
            ),
            None => ("axis ratio", "at most 20; that of hair is between 1 and 3"),
        };
        return Err(refuse(InvalidQuantity { quantity, value, unit: "", allowed }));
    }
    Ok(Fibre {
        section,
        material: material(document, base.material).map_err(refuse)?,
        torsion: document.keyword("hair.fibre.torsion", base.torsion)?,
        ..base
    })
}

fn section(document: &Document<'_>, preset: Section) -> Result<Section> {
    let number = |key: &str| document.number(&format!("hair.fibre.{key}"));
    let missing = |given: &str, other| document.missing(&format!("hair.fibre.{given}"), other);
    let section = match (number("semi_axis_a"), number("semi_axis_b")) {
        (Some(a), Some(b)) => Section::from_semi_axes(a, b),
        (Some(_), None) => return Err(missing("semi_axis_a", "semi_axis_b")),
        (None, Some(_)) => return Err(missing("semi_axis_b", "semi_axis_a")),
        (None, None) => {
            let (eccentricity, ratio) = (number("eccentricity"), number("axis_ratio"));
            let (diameter, radius) = (number("diameter"), number("mean_radius"));
            if [eccentricity, ratio, diameter, radius].iter().all(Option::is_none) {
                return Ok(preset);
            }
            let diameter = diameter.or(radius.map(|r| 2.0 * r));
            let diameter = diameter.unwrap_or(2.0 * preset.mean_radius());
            match eccentricity {
                Some(eccentricity) => {
                    Section::from_mean_radius(radius.unwrap_or(0.5 * diameter), eccentricity)
                }
                None => Section::from_diameter(diameter, ratio.unwrap_or(preset.axis_ratio())),
            }
        }
    };
    section.map_err(|e| quantity_error(&e, document.source))
}

fn material(document: &Document<'_>, preset: Material) -> Result<Material, InvalidQuantity> {
    let number = |key: &str| document.number(&format!("hair.fibre.{key}"));
    let youngs = number("youngs_modulus").unwrap_or(preset.youngs_modulus());
    let shear = number("shear_modulus").unwrap_or(preset.shear_modulus());
    let density = number("density").unwrap_or(preset.density());
    match number("poisson_ratio") {
        Some(ratio) => Material::isotropic(youngs, ratio, density),
        None => Material::new(youngs, shear, density),
    }
}

/// Reads the natural curl, whose variations are [numbers](Document::set_fields).
pub(super) fn curl(document: &Document<'_>, curl: &mut Curl) -> Result<()> {
    curl.handedness = document.keyword("hair.curl.handedness", curl.handedness)?;
    let number = |key: &str| document.number(&format!("hair.curl.{key}"));
    let (radius, pitch) = (number("radius"), number("pitch"));
    if ["kappa1", "kappa2", "tau"].into_iter().any(|key| number(key).is_some()) {
        curl.strain = strain(document, "hair.curl")?;
    } else if radius.is_some() || pitch.is_some() {
        let preset = curl.radius_pitch().unwrap_or_default();
        for (quantity, value, allowed) in [
            ("curl radius", radius, "at most 100 m; leave it out for straight hair"),
            ("curl pitch", pitch, "between -100 and 100 m; leave it out for straight hair"),
        ] {
            if let Some(value) = value.filter(|value| value.abs() > WIDEST) {
                let error = InvalidQuantity { quantity, value, unit: "m", allowed };
                return Err(quantity_error(&error, document.source));
            }
        }
        let helix = Curl::helix(radius.unwrap_or(preset.0), pitch.unwrap_or(preset.1));
        curl.strain = helix.map_err(|e| quantity_error(&e, document.source))?.strain;
        // Of a helix, neither is larger than the radius inverted.
        if !(curl.strain.abs().max_element() <= CURLIEST) {
            let (quantity, value) = ("curl radius", radius.unwrap_or(preset.0));
            let error = InvalidQuantity {
                quantity,
                value,
                unit: "m",
                allowed: "at least 10 um, unless `pitch` is longer",
            };
            return Err(quantity_error(&error, document.source));
        }
    }
    Ok(())
}

/// The strains of a table; those that it does not have are 0.
fn strain(document: &Document<'_>, table: &str) -> Result<DVec3> {
    let number = |key: &str| {
        let path = format!("{table}.{key}");
        let value = document.number(&path).unwrap_or(0.0);
        if value.abs() > CURLIEST {
            return Err(document.outside(&path, "between -1e5 and 1e5 rad/m (10 um radius)"));
        }
        Ok(value)
    };
    Ok(DVec3::new(number("kappa1")?, number("kappa2")?, number("tau")?))
}

/// Most knots of the strain along a hair. Chosen: as many as a hair has elements at most.
const MAX_KNOTS: usize = 10_000;

/// The natural strains along a hair, if they are given.
pub(super) fn along(document: &Document<'_>) -> Result<Option<StrainProfile>> {
    let mut knots: Vec<(f64, DVec3)> = Vec::new();
    if document.value("hair.curl.along").is_some() && document.count_items("hair.curl.along") == 0 {
        return Err(document.outside("hair.curl.along", "a list of at least one table"));
    }
    let hint = "strains are linear between knots: leave out those that lie between others";
    document.check_items("hair.curl.along", MAX_KNOTS, "knots", hint)?;
    for i in 0..document.count_items("hair.curl.along") {
        let knot = format!("hair.curl.along[{i}]");
        let path = format!("{knot}.s");
        let s = document.number(&path).unwrap_or(0.0);
        if s.abs() > FARTHEST {
            return Err(document.outside(&path, "between -100 and 100 m"));
        }
        if knots.last().is_some_and(|last| s <= last.0) {
            let path = if document.has(&path) { path } else { knot };
            let allowed = "greater than the one before: knots go from root to tip";
            return Err(document.outside(&path, allowed));
        }
        knots.push((s, strain(document, &knot)?));
    }
    if knots.is_empty() {
        return Ok(None);
    }
    StrainProfile::new(knots).map(Some).map_err(|e| quantity_error(&e, document.source))
}

/// The material frame at the root of a single hair.
pub(super) fn frame(document: &Document<'_>) -> Result<[DVec3; 3]> {
    let vector = |key| document.get::<Vector>(key);
    let missing = |given: &str, other| -> Result<[DVec3; 3], SceneError> {
        Err(document.missing(given, other))
    };
    match (vector("hair.root.d1")?, vector("hair.root.d2")?, vector("hair.root.t")?) {
        (None, None, None) => Ok([DVec3::Y, DVec3::Z, DVec3::X]),
        (Some(d1), Some(d2), t) => Ok([d1, d2, t.unwrap_or(d1.cross(d2))]),
        (Some(d1), None, Some(t)) => Ok([d1, t.cross(d1), t]),
        (None, Some(d2), Some(t)) => Ok([d2.cross(t), d2, t]),
        (Some(_), None, None) => missing("hair.root.d1", "t"),
        (None, Some(_), None) => missing("hair.root.d2", "t"),
        (None, None, Some(_)) => missing("hair.root.t", "d1"),
    }
}

/// Reads the number of drawn hairs and the profile of wisps; the rest are [numbers](Document::set_fields).
pub(super) fn wisps(document: &Document<'_>, spec: &mut HairstyleSpec) -> Result<()> {
    let wisps = &mut spec.wisps;
    if let Some(count) = document.number("wisps.hairs") {
        wisps.hairs = Hairs::Count(count as usize);
    }
    if let Some(each) = document.number("wisps.hairs_per_wisp") {
        wisps.hairs = Hairs::PerWisp(each as usize);
    }
    if let Some(density) = document.number("wisps.density") {
        wisps.hairs = Hairs::Density(density);
        spec.implantation.density = density;
    }
    if let Some(profile) = document.get::<Vector>("wisps.profile")? {
        wisps.profile = profile.to_array();
    }
    wisps.strands = document.keyword("wisps.strands", wisps.strands)?;
    wisps.contact = document.keyword("wisps.contact", wisps.contact)?;
    if wisps.contact != StrandContact::Tube && wisps.strands != HairModel::Simulated {
        let problem = "only simulated hairs touch each other";
        return Err(document.error("wisps.contact", problem, "add `strands = \"simulated\"`"));
    }
    Ok(())
}
