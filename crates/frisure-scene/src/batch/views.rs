//! The pictures of each head of a batch: cameras, size, and what is stored.

use std::f64::consts::{PI, TAU};

use frisure_digest::digest_fields;
use frisure_look::CAMERAS;
use toml::Spanned;
use toml::de::DeValue;

use super::names::ValueType;
use super::table::{Field, Table};
use crate::error::{Diagnostic, Result, SceneError};
use crate::quantity::ANGLE;
use crate::similar::nearest;
use crate::source::Source;

/// Keys of the pictures.
const KEYS: [&str; 5] = ["cameras", "size", "hairs", "samples", "outputs"];

/// Largest width and height (pixels); chosen.
const MOST_PIXELS: i64 = 4096;

/// Most cameras of a head; chosen.
const MOST_CAMERAS: i64 = 360;

/// Most hairs of a head.
const MOST_HAIRS: i64 = 1_000_000;

/// Largest elevation (rad): above it a camera has no upright picture.
const STEEPEST: f64 = 85.0 * PI / 180.0;

/// The pictures of each head.
#[derive(Clone, Debug, PartialEq)]
pub struct Views {
    /// The cameras, in the order of the views.
    pub cameras: Vec<ViewCamera>,
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Most hairs that are drawn of a head.
    pub hairs: usize,
    /// Rays along each side of a pixel that measure what is in it.
    pub samples: usize,
    /// What is stored.
    pub outputs: Vec<ViewOutput>,
}
digest_fields!(Views { cameras, width, height, hairs, samples, outputs });

/// A camera by its direction from the head.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewCamera {
    /// Its name in the batch; `orbit-03` on an orbit, `camera-02` for other angles, both by the index of the view.
    pub name: String,
    /// Around the head (rad): 0 faces it, π/2 sees its left side.
    pub azimuth: f64,
    /// Above the horizon (rad).
    pub elevation: f64,
}
digest_fields!(ViewCamera { name, azimuth, elevation });

/// A picture or a map of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ViewOutput {
    /// The picture.
    Color,
    /// Coverage by hair.
    Mask,
    /// Coverage by the body.
    Body,
    /// Depth along the optical axis.
    Depth,
    /// Direction of the hair in the picture.
    Direction,
    /// Direction of the hair in space.
    Tangent,
    /// Index of the hair.
    Strand,
    /// Index of the guide of the hair.
    Guide,
}

impl ViewOutput {
    /// All of them, in the order of their columns.
    pub const ALL: [Self; 8] = [
        Self::Color,
        Self::Mask,
        Self::Body,
        Self::Depth,
        Self::Direction,
        Self::Tangent,
        Self::Strand,
        Self::Guide,
    ];

    /// Its name in a batch, and that of its column.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Mask => "mask",
            Self::Body => "body",
            Self::Depth => "depth",
            Self::Direction => "direction",
            Self::Tangent => "tangent",
            Self::Strand => "strand",
            Self::Guide => "guide",
        }
    }
}

impl frisure_digest::Digestible for ViewOutput {
    fn add_to(&self, digest: &mut frisure_digest::Digest) {
        self.name().add_to(digest);
    }
}

impl Views {
    /// Number of pixels of one view.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }
}

/// Reads the table `views` of a batch; none without one.
pub(super) fn views(batch: &Table<'_>, source: &Source) -> Result<Option<Views>> {
    let Some(field) = batch.field("views") else { return Ok(None) };
    let table = field.value.get_ref().as_table().ok_or_else(|| batch.refuse("views", "a table"))?;
    let table = Table::read(source, table, "views", &KEYS)?;
    let [width, height] = size(&table)?;
    Ok(Some(Views {
        cameras: cameras(&table, field, source)?,
        width,
        height,
        hairs: table.whole("hairs", 1, MOST_HAIRS)?.unwrap_or(20_000) as usize,
        samples: table.whole("samples", 1, 8)?.unwrap_or(3) as usize,
        outputs: outputs(&table, source)?,
    }))
}

fn size(table: &Table<'_>) -> Result<[usize; 2]> {
    if !table.has("size") {
        return Ok([512; 2]);
    }
    let allowed = format!("width and height, each a whole number between 1 and {MOST_PIXELS}");
    let refused = || table.refuse("size", allowed.clone());
    let sides = table.list("size").filter(|items| items.len() == 2).ok_or_else(refused)?;
    let mut size = [0; 2];
    for (side, item) in size.iter_mut().zip(sides) {
        let whole = item.get_ref().as_integer().and_then(|i| i.as_str().parse::<i64>().ok());
        *side = match whole {
            Some(pixels) if (1..=MOST_PIXELS).contains(&pixels) => pixels as usize,
            _ => return Err(table.refuse_at("size", item.span(), allowed)),
        };
    }
    Ok(size)
}

fn cameras(table: &Table<'_>, views: &Field<'_>, source: &Source) -> Result<Vec<ViewCamera>> {
    let Some(field) = table.field("cameras") else {
        let hint = "such as `cameras = [\"front\", \"side\", \"back\"]`, or `{ count = 8 }` around the head";
        let missing = Diagnostic::new("`views` has no cameras").key("views.cameras").hint(hint);
        return Err(missing.at(source, views.key.clone()));
    };
    if let DeValue::Table(orbit) = field.value.get_ref() {
        let orbit =
            Table::read(source, orbit, "views.cameras", &["count", "elevation", "azimuth"])?;
        if !orbit.has("count") {
            return Err(table.refuse("cameras", "a table with the `count` of cameras"));
        }
        return around(&orbit);
    }
    let allowed = format!(
        "a list of 1 to {MOST_CAMERAS} cameras, or a table with the `count` of them around the head"
    );
    let items = table.list("cameras").filter(|items| items.len() as i64 <= MOST_CAMERAS);
    let items = items.ok_or_else(|| table.refuse("cameras", allowed))?;
    let mut found: Vec<ViewCamera> = Vec::new();
    for (index, item) in items.iter().enumerate() {
        let camera = camera(table, item, index, source)?;
        let place = |camera: &ViewCamera| (camera.azimuth, camera.elevation);
        if let Some(other) = found.iter().find(|other| place(other) == place(&camera)) {
            let problem = format!("the camera `{}` before it takes the same pictures", other.name);
            let twice = Diagnostic::new(problem).hint("leave one of them out");
            return Err(twice.key("views.cameras").at(source, item.span()));
        }
        found.push(camera);
    }
    Ok(found)
}

fn camera(
    table: &Table<'_>,
    item: &Spanned<DeValue<'_>>,
    index: usize,
    source: &Source,
) -> Result<ViewCamera> {
    match item.get_ref() {
        DeValue::String(name) => {
            let known = CAMERAS.iter().find(|known| known.name == name.as_ref());
            let names = CAMERAS.map(|known| known.name);
            let known = known.ok_or_else(|| unknown(source, "views.cameras", item, &names))?;
            Ok(ViewCamera { name: known.name.into(), azimuth: known.azimuth, elevation: 0.0 })
        }
        DeValue::Table(angles) => {
            let angles = Table::read(source, angles, "views.cameras", &["azimuth", "elevation"])?;
            let name = format!("camera-{index:02}");
            let azimuth = angle(&angles, "azimuth", TAU)?;
            Ok(ViewCamera { name, azimuth, elevation: angle(&angles, "elevation", STEEPEST)? })
        }
        _ => {
            let allowed = "a name in quotes, or a table with `azimuth` and `elevation`";
            Err(table.refuse_at("cameras", item.span(), allowed))
        }
    }
}

/// Cameras evenly around the head.
fn around(orbit: &Table<'_>) -> Result<Vec<ViewCamera>> {
    let count = orbit.whole("count", 1, MOST_CAMERAS)?.unwrap_or(1);
    let (first, elevation) = (angle(orbit, "azimuth", TAU)?, angle(orbit, "elevation", STEEPEST)?);
    let camera = |index: i64| ViewCamera {
        name: format!("orbit-{index:02}"),
        azimuth: first + index as f64 / count as f64 * TAU,
        elevation,
    };
    Ok((0..count).map(camera).collect())
}

/// An angle (rad) that is at most `most` to either side; 0 if it is not given.
fn angle(table: &Table<'_>, key: &str, most: f64) -> Result<f64> {
    let angle = table.number(key, ValueType::Quantity(&ANGLE))?.unwrap_or(0.0);
    // A rounding error beyond is still within.
    if angle.abs() <= most * (1.0 + 1e-9) {
        return Ok(angle);
    }
    let most = most.to_degrees().round();
    Err(table.refuse(key, format!("between -{most} deg and {most} deg")))
}

fn outputs(table: &Table<'_>, source: &Source) -> Result<Vec<ViewOutput>> {
    if !table.has("outputs") {
        return Ok(ViewOutput::ALL.to_vec());
    }
    let names = ViewOutput::ALL.map(ViewOutput::name);
    let allowed = format!("a list of {}", names.join(", "));
    let items = table.list("outputs").ok_or_else(|| table.refuse("outputs", allowed))?;
    let mut found = Vec::new();
    for item in items {
        let name = item.get_ref().as_str().unwrap_or_default();
        let known = ViewOutput::ALL.into_iter().find(|output| output.name() == name);
        found.push(known.ok_or_else(|| unknown(source, "views.outputs", item, &names))?);
    }
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

/// The error about a name that is none of those that are known.
fn unknown(
    source: &Source,
    key: &str,
    item: &Spanned<DeValue<'_>>,
    known: &[&'static str],
) -> SceneError {
    let name = item.get_ref().as_str().unwrap_or_default();
    let all = known.iter().map(|known| format!("\"{known}\"")).collect::<Vec<_>>().join(", ");
    let near = nearest(name, known.iter().copied());
    let hint = near.map(|near| format!("did you mean \"{near}\"?")).unwrap_or_default();
    let refused = Diagnostic::outside(format!("one of {all}")).key(key).hint(hint);
    refused.value(source.slice(item.span())).at(source, item.span())
}
