//! Reading `[light]`.

use std::path::{Path, PathBuf};

use frisure_look::{
    Backdrop, Daylight, Face, LampFace, LampPlace, LampSpec, LightSpec, Setup,
    colour_of_temperature, linear_from_srgb,
};

use crate::document::Document;
use crate::error::Result;
use crate::key_groups::{ENVIRONMENT, MAIN_LAMP, SUN};
use crate::kind::{Colour, FaceSize, Flag, Point, Text};

/// Direction of the studio's main lamp (rad), for a scene that gives one of the two angles.
const STUDIO: (f64, f64) = (-0.68, 0.72);

/// Most lamps. Chosen: ten times those of a studio.
const MAX_LAMPS: usize = 100;

/// Farthest place of a lamp (m).
const FAR: f64 = 1e3;

/// What is behind the head, if the scene does not say it.
pub(super) fn backdrop(light: &LightSpec, has_environment: bool) -> Backdrop {
    match light.setup {
        Setup::Daylight(_) | Setup::Overcast => Backdrop::Environment,
        _ if has_environment => Backdrop::Environment,
        _ => Backdrop::Wall,
    }
}

/// The lights, whose other fields are [numbers](Document::set_fields), and the file of their environment map, relative to `folder`.
pub(super) fn light(
    document: &Document<'_>,
    folder: &Path,
) -> Result<(LightSpec, Option<PathBuf>)> {
    let environment = document.get::<Text>(ENVIRONMENT[0])?.map(|name| folder.join(name));
    let default = match (&environment, SUN.iter().any(|key| document.has(key))) {
        (Some(_), _) => Setup::Dark,
        // Keys about the sun mean daylight.
        (None, true) => Setup::Daylight(Daylight::default()),
        (None, false) => Setup::Studio,
    };
    let setup = document.keyword("light.setup", default)?;
    check_setup(document, setup)?;
    let [azimuth, elevation, size] = MAIN_LAMP.map(|key| document.number(key));
    let is_aimed = azimuth.is_some() || elevation.is_some();
    let direction = (azimuth.unwrap_or(STUDIO.0), elevation.unwrap_or(STUDIO.1));
    let lamps = 0..document.count_items("light.lamp");
    let hint = "`size` makes one lamp as wide as many";
    document.check_items("light.lamp", MAX_LAMPS, "lamps", hint)?;
    let light = LightSpec {
        setup: match setup {
            Setup::Daylight(sun) => Setup::Daylight(daylight(document, sun)),
            setup => setup,
        },
        direction: is_aimed.then_some(direction),
        size,
        strength: 1.0,
        sky_strength: 1.0,
        environment_rotation: 0.0,
        lamps: lamps.map(|i| lamp(document, &format!("light.lamp[{i}]"))).collect::<Result<_>>()?,
    };
    Ok((light, environment))
}

/// Refuses keys about lamps that a setup does not have.
fn check_setup(document: &Document<'_>, setup: Setup) -> Result<()> {
    let refuse = |keys: &[&str], problem: &str, hint: &str| match document.first(keys) {
        None => Ok(()),
        Some(key) => Err(document.error(key, format!("`{key}` {problem}"), hint)),
    };
    if !matches!(setup, Setup::Daylight(_)) {
        refuse(&SUN, "is about a sun that is not there", "add `setup = \"daylight\"`")?;
    }
    match setup {
        Setup::Daylight(_) => {
            let hint = "the sun has `sun_azimuth` and `sun_elevation`";
            refuse(&MAIN_LAMP[..2], "is about a studio's lamp; there is the sun", hint)?;
        }
        Setup::Dark | Setup::Overcast => {
            let hint = "give a `setup` with lamps, or a lamp of its own as `[[light.lamp]]`";
            refuse(&MAIN_LAMP, "is about a main lamp; there is none", hint)?;
        }
        _ => {}
    }
    if matches!(setup, Setup::Daylight(_) | Setup::Overcast) {
        refuse(&ENVIRONMENT[..1], "is a second sky", "keep `setup` or `environment`")?;
    }
    if !document.has(ENVIRONMENT[0]) {
        let problem = "is about an environment, and there is none";
        refuse(&ENVIRONMENT[1..], problem, "add `environment = \"studio.hdr\"`")?;
    }
    Ok(())
}

fn daylight(document: &Document<'_>, default: Daylight) -> Daylight {
    let [azimuth, elevation, turbidity] = SUN.map(|key| document.number(key));
    Daylight {
        sun_azimuth: azimuth.unwrap_or(default.sun_azimuth),
        sun_elevation: elevation.unwrap_or(default.sun_elevation),
        turbidity: turbidity.unwrap_or(default.turbidity),
    }
}

fn lamp(document: &Document<'_>, table: &str) -> Result<LampSpec> {
    let path = |key: &str| format!("{table}.{key}");
    let has = |key: &str| document.has(&path(key));
    let is_near = has("distance") || has("position");
    if !has("azimuth") && !has("elevation") && !is_near {
        let hint = "add `azimuth`, `elevation`, `distance` or `position`";
        return Err(document.error(table, format!("`{table}` is nowhere"), hint));
    }
    if has("size") && !is_near {
        return Err(document.missing(&path("size"), "distance"));
    }
    if has("angle") && is_near {
        let key = path("angle");
        let problem = format!("`{key}` is that of a lamp very far away");
        return Err(document.error(&key, problem, "a lamp at a place has a `size`"));
    }
    if has("shown") && !has("size") {
        return Err(document.missing(&path("shown"), "size"));
    }
    let colour = document.get_or::<Colour>(&path("colour"), [1.0; 3])?;
    let temperature = document.number(&path("temperature")).map(colour_of_temperature);
    Ok(LampSpec {
        place: place(document, table)?,
        strength: document.number(&path("strength")).unwrap_or(1.0),
        colour: temperature.unwrap_or_else(|| linear_from_srgb(colour)),
    })
}

fn place(document: &Document<'_>, table: &str) -> Result<LampPlace> {
    let number = |key: &str| document.number(&format!("{table}.{key}"));
    let face = face(document, table)?;
    let path = format!("{table}.position");
    if let Some(position) = document.get::<Point>(&path)? {
        if position.abs().max_element() > FAR {
            return Err(document.outside(&path, "within 1 km"));
        }
        return Ok(LampPlace::At { position, face });
    }
    let direction = (number("azimuth").unwrap_or(0.0), number("elevation").unwrap_or(0.0));
    Ok(match number("distance") {
        Some(distance) => LampPlace::Beside { direction, distance, face },
        None => LampPlace::Far { direction, angle: number("angle") },
    })
}

fn face(document: &Document<'_>, table: &str) -> Result<Option<LampFace>> {
    let path = format!("{table}.size");
    let Some(size) = document.get::<FaceSize>(&path)? else { return Ok(None) };
    let sides = match size {
        Face::Disc(diameter) => [diameter; 2],
        Face::Rectangle(sides) => sides,
    };
    if !sides.iter().all(|side| (1e-3..=100.0).contains(side)) {
        return Err(document.outside(&path, "between 1 mm and 100 m"));
    }
    let shown = document.get_or::<Flag>(&format!("{table}.shown"), false)?;
    Ok(Some(LampFace { size, shown }))
}
