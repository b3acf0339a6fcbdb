//! From the keys as written to a [`Scene`]: presets filled in, contradictions refused.

use std::ops::Range;
use std::path::Path;

use frisure_hairstyle::{
    Curl, Fibre, Flow, HairModel, Hairs, HairstyleSpec, InvalidSpec, Lift, Parting, Preset,
    RegionLength, RegionStyle, preset,
};
use frisure_look::{
    Backdrop, CameraSpec, Dye, Fade, HairLook, HairSurface, LookSpec, Melanin, SkinLook, ToneCurve,
    absorption_of_colour, linear_from_srgb,
};
use frisure_rod::{
    Branch, InvalidQuantity, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root,
    Section, StrainProfile,
};
use glam::{DVec3, Vec3};
use serde::Deserialize;

use super::bare;
use super::blame::{blame, out_of_range, place};
use super::error::{Fault, SceneError};
use super::file::{self, File};
use super::key::{Key, Kind};
use super::light::light;
use super::source::Source;
use super::words::{BranchKind, FlowWord, HairType, ShadeWord, Which};
use super::{
    GroomFile, HeadFile, HeadSource, Output, ScalpSource, Scene, SingleHair, schema, shape, step,
};
use frisure_files::frame::FrameChoice;

/// The hair type of a scene that names none.
const DEFAULT_TYPE: &str = "caucasian-straight";

/// Largest weight against elasticity, ρ S g L³ / EI. A hair of a metre has some ten thousand; beyond
/// this a unit was mistaken, and a head would take hours.
const MAX_HEAVINESS: f64 = 1e8;

/// Largest ratio of a section's axes; measured hair reaches 3.
const MAX_AXIS_RATIO: f64 = 20.0;

pub(super) type Result<T, E = SceneError> = std::result::Result<T, E>;

/// Reads the whole scene.
pub(super) fn scene(source: Source, folder: &Path) -> Result<Scene> {
    shape::check(&source, source.document()?.get_ref(), schema())?;
    let deserializer = toml::Deserializer::parse(&source.text).map_err(|e| source.syntax(&e))?;
    let file = File::deserialize(deserializer).map_err(|e| source.syntax(&e))?;

    let default = HairType(preset(DEFAULT_TYPE).expect("the default is a preset"));
    let HairType(preset) = file.hair.kind.or(default, &source)?;
    let mut spec = preset.spec();
    hair(&file, preset, &mut spec, &source)?;
    wisps(&file.wisps, &mut spec, &source)?;
    implantation(&file.implantation, &mut spec, &source)?;
    spec.regions = regions(&file.region, &source)?;
    let steps = step::operations(&file.step, &source)?;
    let c = &file.contact;
    spec.contact.body = c.body.get(&source)?.map_or(spec.contact.body, |b| b.0);
    spec.contact.hair = c.hair.get(&source)?.map_or(spec.contact.hair, |h| h.0);
    set(&mut spec.contact.stiffness, &c.stiffness, &source)?;
    set(&mut spec.contact.hair_stiffness, &c.hair_stiffness, &source)?;
    set(&mut spec.contact.volume, &c.volume, &source)?;
    let branch = equilibrium(&file.equilibrium, &mut spec, &source)?;
    let lit = light(&file.light, folder, &source)?;
    let groom = groom(&file.groom, folder, &source)?;
    if groom.is_some() && spec.wisps.strands == HairModel::Simulated {
        let problem =
            "the hairs of a groom have shapes of their own, and cannot be simulated one by one";
        let hint = "leave out `strands`, or `[groom]`";
        let span = file.wisps.strands.span().unwrap_or_default();
        return Err(Fault::new(problem).key("wisps.strands").hint(hint).at(&source, span));
    }

    Ok(Scene {
        name: file.name.or(String::new(), &source)?,
        hair_type: preset.name,
        head: head(&file.head, folder, &source)?,
        groom,
        look: look(&file.look, spec.seed, lit.backdrop(), &source)?,
        camera: camera(&file.camera, &source)?,
        light: lit.light,
        environment: lit.environment,
        output: output(&file.output, &source)?,
        along: along(&file.hair.curl, &source)?,
        frame: frame(&file.hair.root, &source)?,
        branch,
        spec,
        steps,
        source,
    })
}

/// The checked description of the whole head.
pub(super) fn hairstyle(scene: &Scene) -> Result<HairstyleSpec> {
    let source = &scene.source;
    if scene.along.is_some() {
        let span = source.locate("hair.curl.along");
        let problem = "natural strains along the hair are for one hair (`frisure hair`)";
        let hint = "give a whole head `radius` and `pitch`, and let it vary by \
                    `variation_along` and `variation_between`";
        return Err(Fault::new(problem).key("hair.curl.along").hint(hint).at(source, span));
    }
    scene.spec.check().map_err(|e| out_of_range(&e, source))?;
    // What a fibre cannot be, whichever way it leaves the scalp.
    single_hair(scene)?;
    Ok(scene.spec.clone())
}

/// The single hair, with its root at the origin.
pub(super) fn single_hair(scene: &Scene) -> Result<SingleHair> {
    let (source, spec) = (&scene.source, &scene.spec);
    let [d1, d2, t] = scene.frame;
    let refuse = |e: InvalidQuantity| blame(&e, source);
    let rod = RodSpec {
        length: spec.length.mean,
        section: spec.fibre.section,
        material: spec.fibre.material,
        torsion: spec.fibre.torsion,
        natural: match &scene.along {
            Some(profile) => NaturalStrain::Varying(profile.clone()),
            None => NaturalStrain::Uniform(spec.curl.strain),
        },
        root: Root::new(DVec3::ZERO, d1, d2, t).map_err(refuse)?,
        gravity: spec.gravity,
    };
    let rod = Rod::new(rod).map_err(refuse)?;
    if !(rod.heaviness() <= MAX_HEAVINESS) {
        let (key, span, _) = place(&["hair.fibre", "hair.length"], source);
        let problem = format!(
            "the hair is too limp to compute: rho S g L^3 / EI is {:.0e}, and may be {MAX_HEAVINESS:.0e}",
            rod.heaviness()
        );
        let hint = "check the units of length, diameter, moduli and density";
        return Err(Fault::new(problem).key(key).hint(hint).at(source, span));
    }
    let (resolution, element) = (spec.equilibrium.resolution, spec.equilibrium.element);
    let branch = scene.branch;
    Ok(SingleHair { rod, options: Options { resolution, element, branch, ..Options::default() } })
}

fn set<K: Kind>(target: &mut K::Value, key: &Key<K>, source: &Source) -> Result<()> {
    if let Some(value) = key.get(source)? {
        *target = value;
    }
    Ok(())
}

fn hair(file: &File, preset: &Preset, spec: &mut HairstyleSpec, source: &Source) -> Result<()> {
    let hair = &file.hair;
    spec.fibre = fibre(hair, preset, spec.fibre, source)?;
    if let Some(seed) = file.seed.get(source)? {
        spec.seed = seed as u64;
    }
    set(&mut spec.gravity, &file.gravity, source)?;
    set(&mut spec.length.mean, &hair.length, source)?;
    set(&mut spec.length.variation_between, &hair.length_variation, source)?;
    set(&mut spec.length.growth_rate, &hair.growth_rate, source)?;
    if let Some(Which(wetting)) = hair.wetting.get(source)? {
        spec.wetting = wetting.of(preset.hair_type());
    }
    let curl = &mut spec.curl;
    curl.strain = strain(&hair.curl, curl, source)?;
    curl.handedness = hair.curl.handedness.get(source)?.map_or(curl.handedness, |h| h.0);
    set(&mut curl.variation_between, &hair.curl.variation_between, source)?;
    set(&mut curl.variation_along, &hair.curl.variation_along, source)?;
    set(&mut curl.variation_scale, &hair.curl.variation_scale, source)
}

fn fibre(file: &file::Hair, preset: &Preset, default: Fibre, source: &Source) -> Result<Fibre> {
    let keys = &file.fibre;
    let axes = [keys.semi_axis_a.span(), keys.semi_axis_b.span()];
    let shape = [keys.eccentricity.span(), keys.axis_ratio.span()];
    one_way(source, &[&[file.ellipticity.span()], &shape, &axes])?;
    let base = match file.ellipticity.get(source)? {
        Some(Which(which)) => preset.hair_type().fibre(which).map_err(|e| blame(&e, source))?,
        None => default,
    };
    Ok(Fibre {
        section: section(keys, base.section, source)?,
        material: material(keys, base.material, source)?,
        torsion: keys.torsion.get(source)?.map_or(base.torsion, |t| t.0),
        variation: keys.variation.or(base.variation, source)?,
        axis_ratio_variation: keys.axis_ratio_variation.or(base.axis_ratio_variation, source)?,
    })
}

fn section(file: &file::Fibre, preset: Section, source: &Source) -> Result<Section> {
    let section = any_section(file, preset, source)?;
    let value = section.axis_ratio();
    if value > MAX_AXIS_RATIO {
        let (quantity, allowed) = ("axis ratio", "at most 20; that of hair is between 1 and 3");
        return Err(blame(&InvalidQuantity { quantity, value, unit: "", allowed }, source));
    }
    Ok(section)
}

fn any_section(file: &file::Fibre, preset: Section, source: &Source) -> Result<Section> {
    let axes = [file.semi_axis_a.span(), file.semi_axis_b.span()];
    one_way(source, &[&[file.diameter.span()], &[file.mean_radius.span()], &axes])?;
    one_way(source, &[&[file.eccentricity.span()], &[file.axis_ratio.span()], &axes])?;
    let refuse = |e: InvalidQuantity| blame(&e, source);
    match (file.semi_axis_a.get(source)?, file.semi_axis_b.get(source)?) {
        (Some(a), Some(b)) => return Section::from_semi_axes(a, b).map_err(refuse),
        (Some(_), None) => return Err(missing(&file.semi_axis_a, "semi_axis_b", source)),
        (None, Some(_)) => return Err(missing(&file.semi_axis_b, "semi_axis_a", source)),
        (None, None) => {}
    }
    let sizes = [file.diameter.span(), file.mean_radius.span()];
    let shapes = [file.eccentricity.span(), file.axis_ratio.span()];
    if sizes.iter().chain(&shapes).all(Option::is_none) {
        return Ok(preset);
    }
    let diameter = file.diameter.get(source)?;
    let radius = file.mean_radius.get(source)?;
    let preset_diameter = 2.0 * preset.mean_radius();
    if let Some(eccentricity) = file.eccentricity.get(source)? {
        let radius = radius.unwrap_or(0.5 * diameter.unwrap_or(preset_diameter));
        return Section::from_mean_radius(radius, eccentricity).map_err(refuse);
    }
    let diameter = diameter.or(radius.map(|r| 2.0 * r)).unwrap_or(preset_diameter);
    let ratio = file.axis_ratio.or(preset.axis_ratio(), source)?;
    Section::from_diameter(diameter, ratio).map_err(refuse)
}

fn material(file: &file::Fibre, preset: Material, source: &Source) -> Result<Material> {
    one_way(source, &[&[file.shear_modulus.span()], &[file.poisson_ratio.span()]])?;
    let youngs = file.youngs_modulus.or(preset.youngs_modulus(), source)?;
    let shear = file.shear_modulus.or(preset.shear_modulus(), source)?;
    let density = file.density.or(preset.density(), source)?;
    match file.poisson_ratio.get(source)? {
        Some(ratio) => Material::isotropic(youngs, ratio, density),
        None => Material::new(youngs, shear, density),
    }
    .map_err(|e| blame(&e, source))
}

fn strain(file: &file::Curl, preset: &Curl, source: &Source) -> Result<DVec3> {
    let along = file.along.first().and_then(knot_span);
    let helix = [file.radius.span(), file.pitch.span()];
    let strains = [file.kappa1.span(), file.kappa2.span(), file.tau.span()];
    one_way(source, &[&helix, &strains, &[along]])?;
    if strains.iter().any(Option::is_some) {
        let kappa1 = file.kappa1.or(0.0, source)?;
        let kappa2 = file.kappa2.or(0.0, source)?;
        return Ok(DVec3::new(kappa1, kappa2, file.tau.or(0.0, source)?));
    }
    if helix.iter().all(Option::is_none) {
        return Ok(preset.strain);
    }
    let (radius, pitch) = preset.radius_pitch().unwrap_or_default();
    let radius = file.radius.or(radius, source)?;
    let pitch = file.pitch.or(pitch, source)?;
    Curl::helix(radius, pitch).map(|c| c.strain).map_err(|e| blame(&e, source))
}

fn along(file: &file::Curl, source: &Source) -> Result<Option<StrainProfile>> {
    let mut knots: Vec<(f64, DVec3)> = Vec::new();
    for knot in &file.along {
        let s = knot.s.or(0.0, source)?;
        if knots.last().is_some_and(|last| s <= last.0) {
            let span = knot.s.span().or(knot_span(knot)).unwrap_or(0..0);
            let value = source.slice(span.clone());
            let fault = Fault::outside("greater than the one before: knots go from root to tip");
            return Err(fault.key(source.path_at(&span)).value(value).at(source, span));
        }
        let kappa1 = knot.kappa1.or(0.0, source)?;
        let kappa2 = knot.kappa2.or(0.0, source)?;
        knots.push((s, DVec3::new(kappa1, kappa2, knot.tau.or(0.0, source)?)));
    }
    if knots.is_empty() {
        return Ok(None);
    }
    StrainProfile::new(knots).map(Some).map_err(|e| blame(&e, source))
}

/// Where a knot stands: its first key, as tables in lists have no span of their own here.
fn knot_span(knot: &file::Knot) -> Option<Range<usize>> {
    let keys = [knot.s.span(), knot.kappa1.span(), knot.kappa2.span(), knot.tau.span()];
    keys.into_iter().flatten().min_by_key(|s| s.start)
}

fn frame(file: &file::Root, source: &Source) -> Result<[DVec3; 3]> {
    let given = (file.d1.get(source)?, file.d2.get(source)?, file.t.get(source)?);
    Ok(match given {
        (None, None, None) => [DVec3::Y, DVec3::Z, DVec3::X],
        (Some(d1), Some(d2), t) => [d1, d2, t.unwrap_or(d1.cross(d2))],
        (Some(d1), None, Some(t)) => [d1, t.cross(d1), t],
        (None, Some(d2), Some(t)) => [d2.cross(t), d2, t],
        (Some(_), None, None) => return Err(missing(&file.d1, "t", source)),
        (None, Some(_), None) => return Err(missing(&file.d2, "t", source)),
        (None, None, Some(_)) => return Err(missing(&file.t, "d1", source)),
    })
}

fn head(file: &file::Head, folder: &Path, source: &Source) -> Result<HeadSource> {
    let scalp = [
        file.scalp_group.span(),
        file.scalp_colour.span(),
        file.scalp_mask.span(),
        file.scalp_weights.span(),
    ];
    one_way(source, &scalp.each_ref().map(std::slice::from_ref))?;
    one_way(source, &[&[file.unit.span()], &[file.scale.span()]])?;
    let Some(mesh) = file.mesh.get(source)? else {
        let rest = [file.up.span(), file.unit.span(), file.scale.span()];
        let stray = scalp.into_iter().chain(rest).flatten().min_by_key(|s| s.start);
        return stray.map_or(Ok(HeadSource::Mannequin), |span| {
            let key = source.path_at(&span);
            let problem = format!("`{key}` is about a mesh, and the scene has none");
            let hint = "add `mesh = \"head.obj\"` to `[head]`";
            Err(Fault::new(problem).key(key).hint(hint).at(source, span))
        });
    };
    let metres = match file.scale.get(source)? {
        Some(scale) if scale > 0.0 => Some(scale),
        Some(_) => return Err(outside(&file.scale, "greater than zero (metres per unit)", source)),
        None => file.unit.get(source)?.map(|unit| unit.0),
    };
    let scalp = if let Some(group) = file.scalp_group.get(source)? {
        ScalpSource::Group(group)
    } else if let Some(name) = file.scalp_colour.get(source)? {
        ScalpSource::Colour(name)
    } else if let Some(mask) = file.scalp_mask.get(source)? {
        ScalpSource::Mask(folder.join(mask))
    } else if let Some(weights) = file.scalp_weights.get(source)? {
        ScalpSource::Weights(folder.join(weights))
    } else {
        ScalpSource::Guess
    };
    let frame = FrameChoice { metres, up: file.up.get(source)?.map(|Which(up)| up) };
    Ok(HeadSource::Mesh(HeadFile { path: folder.join(mesh), frame, scalp }))
}

/// Most guides of a groom, where the scene says nothing.
const GROOM_GUIDES: usize = 300;

fn groom(file: &file::Groom, folder: &Path, source: &Source) -> Result<Option<GroomFile>> {
    let Some(path) = file.file.get(source)? else {
        let rest = [file.up.span(), file.unit.span(), file.guides.span()];
        let stray = rest.into_iter().flatten().min_by_key(|s| s.start);
        return stray.map_or(Ok(None), |span| {
            let key = source.path_at(&span);
            let problem = format!("`{key}` is about a groom, and the scene has none");
            let hint = "add `file = \"hair.usd\"` to `[groom]`";
            Err(Fault::new(problem).key(key).hint(hint).at(source, span))
        });
    };
    let guides = match file.guides.get(source)? {
        None => GROOM_GUIDES,
        Some(guides @ 1..=100_000) => guides,
        Some(_) => return Err(outside(&file.guides, "between 1 and 100000", source)),
    };
    let metres = file.unit.get(source)?.map(|unit| unit.0);
    let frame = FrameChoice { metres, up: file.up.get(source)?.map(|Which(up)| up) };
    Ok(Some(GroomFile { path: folder.join(path), frame, guides }))
}

fn implantation(
    file: &file::Implantation,
    spec: &mut HairstyleSpec,
    source: &Source,
) -> Result<()> {
    one_way(source, &[&[file.lift.span()], &[file.lift_scale.span()]])?;
    let implantation = &mut spec.implantation;
    implantation.flow = flow(file, implantation.flow, source)?;
    implantation.partings = partings(file, source)?;
    if let Some(angle) = file.lift.get(source)? {
        implantation.lift = Lift::Uniform(angle);
    }
    if let Some(scale) = file.lift_scale.get(source)? {
        implantation.lift = Lift::Regional { scale };
    }
    set(&mut implantation.jitter, &file.jitter, source)?;
    set(&mut implantation.baby_hairs, &file.baby_hairs, source)?;
    let whorls = &mut implantation.whorls;
    set(&mut whorls.count, &file.whorls, source)?;
    set(&mut whorls.offset, &file.whorl_offset, source)?;
    whorls.turn = file.whorl_turn.get(source)?.map_or(whorls.turn, |t| t.0);
    let (hairline, file) = (&mut implantation.hairline, &file.hairline);
    set(&mut hairline.irregularity, &file.irregularity, source)?;
    set(&mut hairline.height, &file.height, source)?;
    set(&mut hairline.recession, &file.recession, source)?;
    set(&mut hairline.widows_peak, &file.widows_peak, source)
}

fn flow(file: &file::Implantation, preset: Flow, source: &Source) -> Result<Flow> {
    // A parting by itself asks for parted hair.
    let parting = file.parting.span().or(file.partings.first().and_then(parting_span));
    let offset = match (file.parting.get(source)?, preset) {
        (Some(Parting::Straight { offset } | Parting::Zigzag { offset }), _) => offset,
        (None, Flow::Parted { offset }) => offset,
        _ => 0.0,
    };
    Ok(match file.flow.get(source)? {
        Some(FlowWord::Parted) => Flow::Parted { offset },
        None if parting.is_some() => Flow::Parted { offset },
        None => preset,
        Some(_) if file.parting.is_given() => {
            let problem = "only parted hair has a parting";
            let span = file.parting.span().unwrap_or(0..0);
            let hint = "write `flow = \"parted\"`, or take `parting` away";
            let key = source.path_at(&span);
            return Err(Fault::new(problem).key(key).hint(hint).at(source, span));
        }
        Some(FlowWord::Whorl) => Flow::Whorl,
        Some(FlowWord::SweptBack) => Flow::SweptBack,
    })
}

/// Partings that a straight one at the flow's own place does not say.
fn partings(file: &file::Implantation, source: &Source) -> Result<Vec<Parting>> {
    let list = file.partings.first().and_then(parting_span);
    one_way(source, &[&[file.parting.span()], &[list]])?;
    if let Some(zigzag @ Parting::Zigzag { .. }) = file.parting.get(source)? {
        return Ok(vec![zigzag]);
    }
    file.partings.iter().enumerate().map(|(i, p)| parting(i, p, source)).collect()
}

fn parting(index: usize, file: &file::Parting, source: &Source) -> Result<Parting> {
    one_way(source, &[&[file.at.span()], &[file.line.span()]])?;
    let parting = match (file.at.get(source)?, file.line.get(source)?) {
        (Some(at), _) => at,
        (None, Some(line)) => Parting::Through(line),
        (None, None) => {
            let key = format!("implantation.partings[{index}]");
            let span = source.locate(&key);
            let problem = format!("`{key}` says nothing: a parting has `at` or `line`");
            return Err(Fault::new(problem).key(key).at(source, span));
        }
    };
    let written = file.at.span().or(file.line.span()).unwrap_or(0..0);
    parting.check().map_err(|e| at_value(&e, written, source))?;
    Ok(parting)
}

/// Where a parting stands: its first key, as tables in lists have no span of their own here.
fn parting_span(parting: &file::Parting) -> Option<Range<usize>> {
    [parting.at.span(), parting.line.span()].into_iter().flatten().min_by_key(|s| s.start)
}

fn regions(files: &[file::Region], source: &Source) -> Result<Vec<RegionStyle>> {
    files.iter().enumerate().map(|(i, file)| region(i, file, source)).collect()
}

fn region(index: usize, file: &file::Region, source: &Source) -> Result<RegionStyle> {
    one_way(source, &[&[file.length.span()], &[file.down_to.span()]])?;
    let Some(places) = file.place.get(source)? else {
        let key = format!("region[{index}]");
        let span = source.locate(&key);
        let problem = format!("`{key}` is nowhere");
        let hint = "add `where = \"fringe\"`, or another part of the scalp";
        return Err(Fault::new(problem).key(key).hint(hint).at(source, span));
    };
    let down_to = file.down_to.get(source)?.map(|l| RegionLength::DownTo(l.0));
    let style = RegionStyle {
        places,
        length: file.length.get(source)?.map(RegionLength::Mean).or(down_to),
        comb: file.comb.get(source)?.map(|c| c.0),
        lift: file.lift.get(source)?,
        curl: file.curl.get(source)?,
    };
    style.check().map_err(|e| {
        let key = match e.field {
            "region.length" => file.length.span(),
            "region.lift" => file.lift.span(),
            "region.curl" => file.curl.span(),
            _ => file.place.span(),
        };
        at_value(&e, key.unwrap_or(0..0), source)
    })?;
    Ok(style)
}

/// A value that a hairstyle refuses, where it is written.
pub(super) fn at_value(error: &InvalidSpec, span: Range<usize>, source: &Source) -> SceneError {
    let key = source.path_at(&span);
    // A list is long, and only what is wrong with it is worth a sentence.
    let written = source.slice(span.clone());
    let value = if written.starts_with('[') { error.value.as_str() } else { written };
    Fault::outside(error.allowed).key(key).value(value).at(source, span)
}

fn wisps(file: &file::Wisps, spec: &mut HairstyleSpec, source: &Source) -> Result<()> {
    let wisps = &mut spec.wisps;
    set(&mut wisps.count, &file.count, source)?;
    wisps.hairs = hairs(file, wisps.hairs, source)?;
    set(&mut spec.implantation.density, &file.density, source)?;
    set(&mut wisps.clumping, &file.clumping, source)?;
    set(&mut wisps.splits, &file.splits, source)?;
    if let Some(profile) = file.profile.get(source)? {
        wisps.profile = profile.to_array();
    }
    set(&mut wisps.fuzziness, &file.fuzziness, source)?;
    set(&mut wisps.length_variation, &file.length_variation, source)?;
    set(&mut wisps.flyaways, &file.flyaways, source)?;
    set(&mut wisps.blending, &file.blending, source)?;
    if let Some(strands) = file.strands.get(source)? {
        wisps.strands = strands.0;
    }
    set(&mut wisps.points, &file.points, source)
}

fn hairs(file: &file::Wisps, default: Hairs, source: &Source) -> Result<Hairs> {
    let spans = [file.hairs.span(), file.hairs_per_wisp.span(), file.density.span()];
    one_way(source, &spans.each_ref().map(std::slice::from_ref))?;
    let count = file.hairs.get(source)?.map(Hairs::Count);
    let each = file.hairs_per_wisp.get(source)?.map(Hairs::PerWisp);
    let density = file.density.get(source)?.map(Hairs::Density);
    Ok(count.or(each).or(density).unwrap_or(default))
}

fn equilibrium(
    file: &file::Equilibrium,
    spec: &mut HairstyleSpec,
    source: &Source,
) -> Result<Branch> {
    one_way(source, &[&[file.elements.span()], &[file.accuracy.span()]])?;
    let settling = &mut spec.equilibrium;
    settling.element = file.element.get(source)?.map_or(settling.element, |e| e.0);
    if let Some(elements) = file.elements.get(source)? {
        settling.resolution = Resolution::Elements(elements);
    }
    if let Some(accuracy) = file.accuracy.get(source)? {
        settling.resolution = Resolution::Accuracy(accuracy);
    }
    set(&mut settling.tolerance, &file.tolerance, source)?;
    settling.resolution.check().map_err(|e| blame(&e, source))?;
    let seed = spec.seed;
    let starts = file.starts.get(source)?;
    match (file.branch.or(Which(BranchKind::Gravity), source)?.0, starts) {
        (BranchKind::Gravity, None) => Ok(Branch::Gravity),
        (BranchKind::Gravity, Some(_)) => {
            let span = file.starts.span().unwrap_or(0..0);
            let problem = "only the lowest branch is searched from several starts";
            let hint = "add `branch = \"lowest\"`";
            Err(Fault::new(problem).key("equilibrium.starts").hint(hint).at(source, span))
        }
        (BranchKind::Lowest, starts) => match starts.unwrap_or(16) {
            #[expect(clippy::cast_possible_truncation, reason = "at most 1000")]
            n @ 1..=1000 => Ok(Branch::Lowest { starts: n as u32, seed }),
            _ => Err(outside(&file.starts, "between 1 and 1000", source)),
        },
    }
}

fn look(file: &file::Look, seed: u64, behind: Backdrop, source: &Source) -> Result<LookSpec> {
    let shade = file.colour.get(source)?;
    let white = shade.map_or(0.0, |ShadeWord(shade)| f64::from(shade.white_share));
    let (unit, rough) = ("between 0 and 1", "between 0.05 and 1");
    let tilt = within(&file.tilt, 0.0, "between -20 and 20 deg", source)?;
    let natural = natural_colour(file, source)?;
    let usual = HairLook::default();
    let given = |key: &Key<super::key::Ratio>, default: f32, allowed: &str| {
        within(key, f64::from(default), allowed, source).map(|value| value as f32)
    };
    let white_share = within(&file.white_share, white, unit, source)? as f32;
    let variation = given(&file.variation, usual.variation, unit)?;
    let (roots, tips) = (look_end(&file.roots, source)?, look_end(&file.tips, source)?);
    let dye = dye(&file.dye, source)?;
    let plain = usual.surface;
    let surface = HairSurface {
        longitudinal_roughness: given(&file.roughness, plain.longitudinal_roughness, rough)?,
        azimuthal_roughness: given(&file.roughness_around, plain.azimuthal_roughness, rough)?,
        tilt: if file.tilt.is_given() { tilt as f32 } else { plain.tilt },
        index: given(&file.index, plain.index, "between 1.05 and 3")?,
    };
    let absorption_of = |colour| absorption_of_colour(colour, surface.azimuthal_roughness);
    let (melanin, absorption) = match natural {
        NaturalColour::Pigments(melanin) => (melanin, None),
        NaturalColour::Reflectance(colour) => (usual.melanin, Some(absorption_of(colour))),
        NaturalColour::Absorption(absorption) => (usual.melanin, Some(absorption)),
    };
    let dye = dye.map(|(colour, dye)| Dye { absorption: absorption_of(colour), ..dye });
    // The low bits of the seed are as good a seed.
    let seed = seed as u32;
    let skin = SkinLook::default();
    Ok(LookSpec {
        hair: HairLook {
            melanin,
            absorption,
            white_share,
            variation,
            roots,
            tips,
            dye,
            surface,
            seed,
        },
        skin: SkinLook {
            colour: file.skin.get(source)?.map_or(skin.colour, linear_from_srgb),
            ..skin
        },
        backdrop: file.background.get(source)?.unwrap_or(behind),
        floor: file.floor.get(source)?.map(linear_from_srgb),
    })
}

/// One of the ways to give the colour of hair.
enum NaturalColour {
    Pigments(Melanin),
    /// The colour of much hair, linear sRGB.
    Reflectance(Vec3),
    /// Absorption of red, green and blue per mean radius.
    Absorption(Vec3),
}

fn natural_colour(file: &file::Look, source: &Source) -> Result<NaturalColour> {
    let pigments = [file.colour.span(), file.eumelanin.span(), file.pheomelanin.span()];
    one_way(source, &[&pigments, &[file.reflectance.span()], &[file.absorption.span()]])?;
    if let Some(colour) = file.reflectance.get(source)? {
        return Ok(NaturalColour::Reflectance(linear_from_srgb(colour)));
    }
    if let Some(absorption) = file.absorption.get(source)? {
        return match absorption.to_array().iter().all(|a| (0.0..=1000.0).contains(a)) {
            true => Ok(NaturalColour::Absorption(absorption.as_vec3())),
            false => Err(outside(&file.absorption, "each between 0 and 1000", source)),
        };
    }
    let shade = file.colour.get(source)?.map_or_else(Melanin::default, |word| word.0.melanin);
    let of = |key, default: f32| {
        within(key, f64::from(default), "between 0 and 100", source).map(|x| x as f32)
    };
    let eumelanin = of(&file.eumelanin, shade.eumelanin)?;
    let pheomelanin = of(&file.pheomelanin, shade.pheomelanin)?;
    Ok(NaturalColour::Pigments(Melanin { eumelanin, pheomelanin }))
}

fn look_end(file: &file::LookEnd, source: &Source) -> Result<Fade> {
    let factor = within(&file.pigment, 1.0, "between 0 and 10", source)? as f32;
    let length = within(&file.fade, 0.05, "between 0 and 3 m", source)? as f32;
    Ok(if file.pigment.is_given() { Fade { factor, length } } else { Fade::default() })
}

/// A dye whose absorption is still to be found from its colour (linear sRGB).
fn dye(file: &file::LookDye, source: &Source) -> Result<Option<(Vec3, Dye)>> {
    let strength = within(&file.strength, 1.0, "between 0 and 1", source)? as f32;
    let regrowth = within(&file.regrowth, 0.0, "between 0 and 3 m", source)? as f32;
    let colour = file.colour.get(source)?;
    if colour.is_none() && file.strength.is_given() {
        return Err(missing(&file.strength, "colour", source));
    }
    if colour.is_none() && file.regrowth.is_given() {
        return Err(missing(&file.regrowth, "colour", source));
    }
    let dye = Dye { absorption: Vec3::ZERO, strength, regrowth };
    Ok(colour.map(|colour| (linear_from_srgb(colour), dye)))
}

fn camera(file: &file::Camera, source: &Source) -> Result<CameraSpec> {
    let deg = f64::to_radians;
    let (azimuth, elevation, field) = (&file.azimuth, &file.elevation, &file.field_of_view);
    let up = "between -85 and 85 deg";
    Ok(CameraSpec {
        azimuth: azimuth.or(deg(30.0), source)?,
        elevation: within(elevation, deg(5.0), up, source)?,
        field_of_view: within(field, deg(24.0), "between 1 and 120 deg", source)?,
        f_number: f_number(file, source)?,
        focus: file.focus.get(source)?,
    })
}

fn f_number(file: &file::Camera, source: &Source) -> Result<Option<f64>> {
    within(&file.focus, 1.0, "between 1 cm and 1 km", source)?;
    if !file.f_number.is_given() {
        return if file.focus.is_given() {
            Err(missing(&file.focus, "f_number", source))
        } else {
            Ok(None)
        };
    }
    within(&file.f_number, 8.0, "between 0.5 and 64", source).map(Some)
}

fn output(file: &file::Output, source: &Source) -> Result<Output> {
    let size = |key: &Key<super::key::Count>, default, max, allowed| match key.get(source)? {
        Some(n) if n == 0 || n > max => Err(outside(key, allowed, source)),
        n => Ok(n.unwrap_or(default)),
    };
    Ok(Output {
        width: size(&file.width, 900, 16_384, "between 1 and 16384")?,
        height: size(&file.height, 1100, 16_384, "between 1 and 16384")?,
        samples: size(&file.samples, 4, 8, "between 1 and 8")?,
        exposure: within(&file.exposure, 0.0, "between -20 and 20", source)?,
        tone: file.tone.or(ToneCurve::default(), source)?,
    })
}

/// The value of a key, inside the range that is declared for it.
pub(super) fn within<K: Kind<Value = f64>>(
    key: &Key<K>,
    default: f64,
    allowed: &str,
    source: &Source,
) -> Result<f64> {
    let Some(value) = key.get(source)? else { return Ok(default) };
    let path = source.path_at(&key.span().unwrap_or_default());
    let range = bare::quantity(schema(), &path);
    let inside = range.is_none_or(|range| {
        value >= range.least.unwrap_or(f64::NEG_INFINITY)
            && value <= range.most.unwrap_or(f64::INFINITY)
    });
    if inside { Ok(value) } else { Err(outside(key, allowed, source)) }
}

pub(super) fn outside<K>(key: &Key<K>, allowed: &str, source: &Source) -> SceneError {
    let span = key.span().unwrap_or(0..0);
    let value = source.slice(span.clone());
    Fault::outside(allowed).key(source.path_at(&span)).value(value).at(source, span)
}

/// A key that says nothing without another.
pub(super) fn missing<K>(given: &Key<K>, other: &str, source: &Source) -> SceneError {
    let span = given.span().unwrap_or(0..0);
    let key = source.path_at(&span);
    let problem = format!("`{key}` needs `{other}` beside it");
    Fault::new(problem).key(key).at(source, span)
}

/// Refuses keys of more than one group: groups are different ways to say the same thing.
pub(super) fn one_way(source: &Source, groups: &[&[Option<Range<usize>>]]) -> Result<()> {
    let first =
        |group: &&[Option<Range<usize>>]| group.iter().flatten().min_by_key(|s| s.start).cloned();
    let mut given: Vec<Range<usize>> = groups.iter().filter_map(first).collect();
    given.sort_by_key(|s| s.start);
    let [one, other, ..] = given.as_slice() else { return Ok(()) };
    let (a, b) = (source.path_at(one), source.path_at(other));
    let (line, _) = source.position(one.start);
    let problem = format!("`{b}` says again what `{a}` says on line {line}");
    Err(Fault::new(problem)
        .key(b)
        .value(source.slice(other.clone()))
        .hint("keep one of the two")
        .related(one.clone(), "said here")
        .at(source, other.clone()))
}
