//! Reading a scene.

use std::path::Path;

use frisure_files::read_text;
use frisure_hairstyle::{HairModel, Hairline, HairstyleSpec, Pose, Wetting, preset};
use frisure_look::{CameraSpec, ToneCurve};
use frisure_rod::{Branch, Resolution};
use glam::DVec3;

use super::{hair, head, implantation, light, look, section};
use crate::choice::OneOf;
use crate::document::Document;
use crate::error::{Result, SceneError};
use crate::exclusive::check_given;
use crate::key_groups::POSE;
use crate::keywords::{BranchKind, FrictionWord, HairType, WettingWord};
use crate::kind::{Count, Flag, Gravity, Text, Vector};
use crate::natural_look::NaturalLook;
use crate::scene::{HeadSource, MAX_SIZE, Output, Scene};
use crate::schema::schema;
use crate::source::Source;
use crate::{key_location, step, unit_hint, unknown_keys};

/// The hair type of a scene that names none.
const DEFAULT_TYPE: &str = "caucasian-straight";

/// Starting shapes of `branch = "lowest"`, if the scene gives no number.
const DEFAULT_STARTS: f64 = 16.0;

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let text = read_text(path, MAX_SIZE, "a scene")?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), text, folder)
    }

    /// Reads the text of a scene; errors call it `name`, and paths in it are relative to `folder`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn parse(name: &str, text: impl Into<String>, folder: &Path) -> Result<Self, SceneError> {
        scene(&Source::new(name, text), folder).map_err(unit_hint::add)
    }
}

fn scene(source: &Source, folder: &Path) -> Result<Scene> {
    unknown_keys::check(source, source.document()?.get_ref(), schema())?;
    let document = Document::read(source)?;
    document.check_exclusive()?;
    let default = HairType(preset(DEFAULT_TYPE).expect("the default is a preset"));
    let HairType(preset) = document.get_or::<OneOf<HairType>>("hair.type", default)?;
    let mut spec = preset.spec();
    if let Some(seed) = document.get::<Count>("seed")? {
        spec.seed = seed as u64;
    }
    spec.fibre = hair::fibre(&document, preset, spec.fibre)?;
    spec.wetting = wetting(&document, preset.hair_type(), spec.wetting)?;
    hair::curl(&document, &mut spec.curl)?;
    hair::wisps(&document, &mut spec)?;
    implantation::implantation(&document, &mut spec.implantation)?;
    let head = head::head(&document, folder)?;
    if let HeadSource::Person { name, .. } = head {
        spec.implantation.hairline = Hairline::usual(name);
    }
    spec.regions = implantation::regions(&document)?;
    let contact = &mut spec.contact;
    contact.body = document.keyword("contact.body", contact.body)?;
    contact.hair = document.keyword("contact.hair", contact.hair)?;
    if document.get::<OneOf<FrictionWord>>("contact.coefficients")? == Some(FrictionWord::Measured)
    {
        let measured = preset.hair_type().friction;
        (contact.friction, contact.skin_friction) = (measured, measured);
    }
    spec.pose = pose(&document, spec.pose)?;
    let branch = equilibrium(&document, &mut spec)?;
    let (light, environment) = light::light(&document, folder)?;
    let groom = head::groom(&document, folder)?;
    if groom.is_some() && spec.wisps.strands == HairModel::Simulated {
        let problem =
            "the hairs of a groom have shapes of their own, and cannot be simulated one by one";
        let hint = "leave out `strands`, or `[groom]`";
        return Err(document.error("wisps.strands", problem, hint));
    }
    let backdrop = light::backdrop(&light, environment.is_some());
    let mut scene = Scene {
        name: document.get_or::<Text>("name", String::new())?,
        hair_type: preset.name,
        head,
        groom,
        look: look::look(&document, &NaturalLook::of(preset), spec.seed, backdrop)?,
        sections: section::sections(&document)?,
        camera: camera(&document)?,
        light,
        environment,
        output: Output {
            tone: document.get_or::<OneOf<ToneCurve>>("output.tone", ToneCurve::default())?,
            accessories: document.get_or::<Flag>("output.accessories", true)?,
            ..Output::default()
        },
        along: hair::along(&document)?,
        frame: hair::frame(&document)?,
        branch,
        spec,
        steps: step::operations(&document)?,
        source: source.clone(),
    };
    document.set_fields(&mut scene);
    Ok(scene)
}

fn wetting(
    document: &Document<'_>,
    hair: &frisure_hairstyle::HairType,
    default: Wetting,
) -> Result<Wetting> {
    let word = document.get::<OneOf<WettingWord>>("hair.wetting")?;
    Ok(word.map_or(default, |word| word.of(hair)))
}

/// How the head is held, where the scene gives the direction of gravity; angles are [numbers](Document::set_fields).
fn pose(document: &Document<'_>, default: Pose) -> Result<Pose> {
    if let Some(vector) = document.value("gravity").and_then(Gravity::vector) {
        let held = POSE.map(str::to_owned);
        let held: Vec<_> = held.into_iter().filter(|key| document.has(key)).collect();
        if !held.is_empty() {
            check_given(document.source, &[vec!["gravity".to_owned()], held])?;
        }
        let vector = vector.map_err(|error| error.at_path("gravity", document.source))?;
        // Without gravity every pose is the same.
        return Ok(pose_of(vector).unwrap_or(default));
    }
    let Some(down) = document.get::<Vector>("pose.down")? else { return Ok(default) };
    pose_of(down).ok_or_else(|| document.outside("pose.down", "a vector that is not zero"))
}

/// The pose in which gravity pulls along a vector of any length but zero.
fn pose_of(down: DVec3) -> Option<Pose> {
    // The square of a large or small length would leave the range of numbers.
    let largest = down.abs().max_element();
    Pose::of(down / largest).filter(|_| largest > 0.0)
}

fn equilibrium(document: &Document<'_>, spec: &mut HairstyleSpec) -> Result<Branch> {
    let settings = &mut spec.equilibrium;
    settings.element = document.keyword("equilibrium.element", settings.element)?;
    settings.method = document.keyword("equilibrium.method", settings.method)?;
    if let Some(elements) = document.number("equilibrium.elements") {
        settings.resolution = Resolution::Elements(elements as usize);
    }
    if let Some(accuracy) = document.number("equilibrium.accuracy") {
        settings.resolution = Resolution::Accuracy(accuracy);
    }
    settings.resolution.check().map_err(|e| key_location::quantity_error(&e, document.source))?;
    let starts = document.number("equilibrium.starts");
    let branch = document.get_or::<OneOf<BranchKind>>("equilibrium.branch", BranchKind::Gravity)?;
    match (branch, starts) {
        (BranchKind::Gravity, None) => Ok(Branch::Gravity),
        (BranchKind::Gravity, Some(_)) => {
            let problem = "only the lowest branch is searched from several starts";
            Err(document.error("equilibrium.starts", problem, "add `branch = \"lowest\"`"))
        }
        (BranchKind::Lowest, starts) => {
            let starts = starts.unwrap_or(DEFAULT_STARTS) as u32;
            Ok(Branch::Lowest { starts, seed: spec.seed })
        }
    }
}

/// The camera, whose angles are [numbers](Document::set_fields).
fn camera(document: &Document<'_>) -> Result<CameraSpec> {
    let f_number = document.number("camera.f_number");
    let focus = document.number("camera.focus");
    if f_number.is_none() && focus.is_some() {
        return Err(document.missing("camera.focus", "f_number"));
    }
    Ok(CameraSpec { f_number, focus, ..CameraSpec::default() })
}
