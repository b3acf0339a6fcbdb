//! Resolving the keys of `[light]`.

use std::ops::Range;
use std::path::{Path, PathBuf};

use frisure_look::{
    Backdrop, Daylight, Face, LampFace, LampPlace, LampSpec, LightSpec, Setup,
    colour_of_temperature, linear_from_srgb,
};

use super::error::Fault;
use super::file;
use super::key::{Key, Kind};
use super::resolve::{Result, missing, one_way, outside, within};
use super::source::Source;
use super::words::Which;

/// The lights of a scene, with the file of its environment map.
pub(super) struct Lit {
    pub(super) light: LightSpec,
    pub(super) environment: Option<PathBuf>,
}

impl Lit {
    /// What is behind the head, if the scene does not say it.
    pub(super) fn backdrop(&self) -> Backdrop {
        match self.light.setup {
            Setup::Daylight(_) | Setup::Overcast => Backdrop::Environment,
            _ if self.environment.is_some() => Backdrop::Environment,
            _ => Backdrop::Wall,
        }
    }
}

const ROUND: &str = "between -180 and 180 deg";
const UP: &str = "between -90 and 90 deg";
const STRENGTH: &str = "between 0 and 100";

/// Understands the keys; paths are relative to `folder`.
pub(super) fn light(file: &file::Light, folder: &Path, source: &Source) -> Result<Lit> {
    let environment_rotation = file.rotation.or(0.0, source)?;
    let environment = file.environment.get(source)?.map(|name| folder.join(name));
    let sun_keys = [file.sun_azimuth.span(), file.sun_elevation.span(), file.turbidity.span()];
    let default = match (&environment, sun_keys.iter().any(Option::is_some)) {
        (Some(_), _) => Setup::Dark,
        // A sun by itself asks for the day.
        (None, true) => Setup::Daylight(Daylight::default()),
        (None, false) => Setup::Studio,
    };
    let Which(setup) = file.setup.or(Which(default), source)?;
    check_setup(file, setup, source)?;
    let direction = (
        // Where the studio's main lamp stands, for a scene that gives one of the two.
        within(&file.azimuth, -0.68, ROUND, source)?,
        within(&file.elevation, 0.72, UP, source)?,
    );
    let is_aimed = file.azimuth.is_given() || file.elevation.is_given();
    let lamps = file.lamp.iter().enumerate().map(|(i, file)| lamp(i, file, source));
    let size = angle(&file.size, source)?;
    let strength = within(&file.strength, 1.0, STRENGTH, source)?;
    let sky_strength = within(&file.sky_strength, 1.0, "between 0 and 1000", source)?;
    let sun = sun(file, source)?;
    let light = LightSpec {
        setup: if matches!(setup, Setup::Daylight(_)) { Setup::Daylight(sun) } else { setup },
        direction: is_aimed.then_some(direction),
        size,
        strength,
        sky_strength,
        environment_rotation,
        lamps: lamps.collect::<Result<_>>()?,
    };
    Ok(Lit { light, environment })
}

/// Refuses keys of lamps that a setup does not have.
fn check_setup(file: &file::Light, setup: Setup, source: &Source) -> Result<()> {
    let refuse = |given: Option<Range<usize>>, problem: &str, hint: &str| match given {
        None => Ok(()),
        Some(span) => {
            let key = source.path_at(&span);
            Err(Fault::new(format!("`{key}` {problem}")).key(key).hint(hint).at(source, span))
        }
    };
    let first = |spans: &[Option<Range<usize>>]| {
        spans.iter().flatten().min_by_key(|span| span.start).cloned()
    };
    if !matches!(setup, Setup::Daylight(_)) {
        let sun = [file.sun_azimuth.span(), file.sun_elevation.span(), file.turbidity.span()];
        refuse(first(&sun), "is about a sun that is not there", "add `setup = \"daylight\"`")?;
    }
    let main = [file.azimuth.span(), file.elevation.span()];
    let sized = [main[0].clone(), main[1].clone(), file.size.span()];
    match setup {
        Setup::Daylight(_) => {
            let hint = "the sun has `sun_azimuth` and `sun_elevation`";
            refuse(first(&main), "is about a studio's lamp; there is the sun", hint)?;
        }
        Setup::Dark | Setup::Overcast => {
            let hint = "give a `setup` with lamps, or a lamp of its own as `[[light.lamp]]`";
            refuse(first(&sized), "is about a main lamp; there is none", hint)?;
        }
        _ => {}
    }
    if matches!(setup, Setup::Daylight(_) | Setup::Overcast) {
        let hint = "keep `setup` or `environment`";
        refuse(file.environment.span(), "is a second sky", hint)?;
    }
    if !file.environment.is_given() {
        let hint = "add `environment = \"studio.hdr\"`";
        refuse(file.rotation.span(), "is about an environment, and there is none", hint)?;
    }
    Ok(())
}

fn sun(file: &file::Light, source: &Source) -> Result<Daylight> {
    let deg = f64::to_radians;
    let (elevation, up) = (&file.sun_elevation, "between 0 and 90 deg");
    Ok(Daylight {
        sun_azimuth: within(&file.sun_azimuth, deg(50.0), "a turn at most", source)?,
        sun_elevation: within(elevation, deg(40.0), up, source)?,
        turbidity: within(&file.turbidity, 3.0, "between 1.9 and 10", source)?,
    })
}

fn lamp(index: usize, file: &file::Lamp, source: &Source) -> Result<LampSpec> {
    let beside = [file.azimuth.span(), file.elevation.span(), file.distance.span()];
    one_way(source, &[&beside, &[file.position.span()]])?;
    one_way(source, &[&[file.colour.span()], &[file.temperature.span()]])?;
    one_way(source, &[&[file.angle.span()], &[file.size.span()]])?;
    let is_near = file.distance.is_given() || file.position.is_given();
    if beside.iter().all(Option::is_none) && !is_near {
        let key = format!("light.lamp[{index}]");
        let span = source.locate(&key);
        let hint = "add `azimuth` and `elevation`, or `position`";
        let problem = format!("`{key}` is nowhere");
        return Err(Fault::new(problem).key(key).hint(hint).at(source, span));
    }
    if file.size.is_given() && !is_near {
        return Err(missing(&file.size, "distance", source));
    }
    if file.angle.is_given() && is_near {
        let span = file.angle.span().unwrap_or(0..0);
        let key = source.path_at(&span);
        let hint = "a lamp at a place has a `size`";
        let problem = format!("`{key}` is that of a lamp very far away");
        return Err(Fault::new(problem).key(key).hint(hint).at(source, span));
    }
    if file.shown.is_given() && !file.size.is_given() {
        return Err(missing(&file.shown, "size", source));
    }
    let temperature = "between 1667 and 25000 K";
    let temperature = match file.temperature.is_given() {
        true => {
            let kelvin = within(&file.temperature, 6500.0, temperature, source)?;
            Some(colour_of_temperature(kelvin))
        }
        false => None,
    };
    let colour = linear_from_srgb(file.colour.or([1.0; 3], source)?);
    Ok(LampSpec {
        place: place(file, source)?,
        strength: within(&file.strength, 1.0, STRENGTH, source)?,
        colour: temperature.unwrap_or(colour),
    })
}

fn place(file: &file::Lamp, source: &Source) -> Result<LampPlace> {
    let face = face(file, source)?;
    let far = 1e3;
    if let Some(position) = file.position.get(source)? {
        if position.abs().max_element() > far {
            return Err(outside(&file.position, "within 1 km", source));
        }
        return Ok(LampPlace::At { position, face });
    }
    let direction =
        (within(&file.azimuth, 0.0, ROUND, source)?, within(&file.elevation, 0.0, UP, source)?);
    if !file.distance.is_given() {
        return Ok(LampPlace::Far { direction, angle: angle(&file.angle, source)? });
    }
    let distance = within(&file.distance, 1.0, "between 1 cm and 1 km", source)?;
    Ok(LampPlace::Beside { direction, distance, face })
}

fn face(file: &file::Lamp, source: &Source) -> Result<Option<LampFace>> {
    let Some(size) = file.size.get(source)? else { return Ok(None) };
    let sides = match size {
        Face::Disc(diameter) => [diameter; 2],
        Face::Rectangle(sides) => sides,
    };
    if !sides.iter().all(|side| (1e-3..=100.0).contains(side)) {
        return Err(outside(&file.size, "between 1 mm and 100 m", source));
    }
    Ok(Some(LampFace { size, shown: file.shown.or(false, source)? }))
}

fn angle<K: Kind<Value = f64>>(key: &Key<K>, source: &Source) -> Result<Option<f64>> {
    let angle = within(key, 0.0, "between 0 and 170 deg", source)?;
    Ok(key.is_given().then_some(angle))
}
