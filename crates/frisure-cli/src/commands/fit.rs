//! `frisure fit`: digitised fibres into natural strain and stiffness, with error bars.

use std::fmt::Write;
use std::path::Path;

use frisure::files;
use frisure::fit::{
    Entry, Estimate, Fibre, Fit, FitStatus, Known, NamedFibre, Options, Pose, STANDARD_GRAVITY,
    fit, html, json, read_table,
};
use frisure::scene::quoted;
use frisure_engine::Error;
use glam::DVec3;

use super::read_groom;
use crate::args::{Axes, FitFibres as Arguments, FitQuantity};
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, outputs};

/// Largest table (bytes): some ten million points.
const LARGEST_TABLE: u64 = 1 << 30;

/// Fibres whose numbers are printed; reports have all.
const PRINTED: usize = 20;

/// Reads the lines, fits them, prints the numbers and writes the reports.
pub(crate) fn run(arguments: &Arguments, quiet: bool) -> Result<ExitStatus, Error> {
    let given: Vec<&Path> = arguments.lines.iter().map(AsRef::as_ref).collect();
    let reports: Vec<&Path> = arguments.outputs.iter().map(AsRef::as_ref).collect();
    outputs::prepare(&reports, &given)?;
    if let Some(report) = reports.iter().find(|path| !(is(path, "html") || is(path, "json"))) {
        let problem = format!("{} is no report", report.display());
        return Err(Error::invalid(problem, "write a file that ends in .html or .json"));
    }
    let (known, options) = (known(arguments)?, options(arguments)?);
    let fibres = read(arguments)?;
    let lines: Vec<Fibre> = fibres.iter().map(|named| named.fibre.clone()).collect();
    let bar = Bar::new(quiet);
    let fits = fit(&lines, &[known], &options, &bar)?;
    drop(bar);
    let entries: Vec<Entry<'_>> = fibres
        .iter()
        .zip(&fits)
        .map(|(named, fit)| Entry { name: &named.name, fibre: &named.fibre, fit })
        .collect();
    for report in reports {
        let text = if is(report, "html") { html(&entries) } else { json(&entries) };
        outputs::write_text(report, &text)?;
    }
    if !quiet {
        console::say(&summary(&entries, known.axis_ratio.is_none()))?;
    }
    let all = fits.iter().all(|fit| fit.status == FitStatus::Fitted);
    Ok(if all { ExitStatus::Success } else { ExitStatus::NotConverged })
}

fn is(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

fn known(arguments: &Arguments) -> Result<Known, Error> {
    let mut known = Known::default();
    for (i, &(quantity, value, deviation)) in arguments.known.iter().enumerate() {
        if arguments.known[..i].iter().any(|(before, ..)| *before == quantity) {
            let problem = format!("`--known {}` is given twice", quantity.name());
            return Err(Error::invalid(problem, "keep one of the two"));
        }
        let estimate = Some(Estimate { value, deviation });
        match quantity {
            FitQuantity::StiffnessOverWeight => known.stiffness_over_weight = estimate,
            FitQuantity::TorsionRatio => known.torsion_ratio = estimate,
            FitQuantity::Curvature => known.curvature = estimate,
            FitQuantity::Torsion => known.torsion = estimate,
            FitQuantity::AxisRatio => known.axis_ratio = estimate,
        }
    }
    known.check().map_err(|e| Error::because(&e, "see --known"))?;
    Ok(known)
}

fn options(arguments: &Arguments) -> Result<Options, Error> {
    let options = Options { noise: arguments.noise, knots: arguments.knots };
    options.check().map_err(|e| Error::because(&e, "see --noise and --knots"))?;
    Ok(options)
}

fn read(arguments: &Arguments) -> Result<Vec<NamedFibre>, Error> {
    let table = |path: &Path| ["csv", "tsv", "txt"].iter().any(|extension| is(path, extension));
    match arguments.lines.as_slice() {
        [path] if table(path) => {
            if !arguments.gravity.is_empty() {
                let problem = "--gravity is for grooms";
                let hint = "a table has the columns gx, gy, gz";
                return Err(Error::invalid(problem.to_owned(), hint));
            }
            let text = files::read_text(path, LARGEST_TABLE, "a table of lines")?;
            let found = read_table(&text, arguments.length).map_err(|e| {
                let problem = format!("{}: {e}", path.display());
                Error::invalid(problem, "`frisure fit --help` describes the table")
            })?;
            if found.is_empty() {
                let problem = format!("{}: the table has no rows", path.display());
                return Err(Error::invalid(problem, "write one row for each point"));
            }
            Ok(found)
        }
        paths if paths.iter().any(|path| table(path)) => {
            let problem = "of several files one is a table".to_owned();
            Err(Error::invalid(
                problem,
                "give one table, whose column `pose` tells poses apart, or grooms",
            ))
        }
        paths => read_grooms(paths, arguments),
    }
}

/// Each groom is a pose of the same fibres.
fn read_grooms<P: AsRef<Path>>(
    paths: &[P],
    arguments: &Arguments,
) -> Result<Vec<NamedFibre>, Error> {
    let directions = &arguments.gravity;
    if directions.len() > 1 && directions.len() != paths.len() {
        let problem =
            format!("{} directions of gravity for {} grooms", directions.len(), paths.len());
        return Err(Error::invalid(problem, "give one for all, or one for each in their order"));
    }
    let mut poses: Vec<Vec<Pose>> = Vec::new();
    for (file, path) in paths.iter().enumerate() {
        let path = path.as_ref();
        let groom = read_groom(path, Axes::default(), "convert it with `frisure convert` first")?;
        let strands = groom.strands();
        if file > 0 && strands.len() != poses.len() {
            let problem = format!(
                "{} has {} lines, the first groom {}",
                path.display(),
                strands.len(),
                poses.len()
            );
            return Err(Error::invalid(
                problem,
                "each groom has the same fibres in the same order",
            ));
        }
        poses.resize_with(strands.len(), Vec::new);
        let direction = directions.get(file).or(directions.first()).copied();
        let gravity = DVec3::from_array(direction.unwrap_or([0.0, 0.0, -1.0])) * STANDARD_GRAVITY;
        for (strand, poses) in poses.iter_mut().enumerate() {
            let points = strands.strand(strand).points.iter().map(|p| p.as_dvec3()).collect();
            let pose = Pose::new(points, None, gravity, 0).map_err(|e| {
                let problem = format!("{}: line {strand}, from 0: {e}", path.display());
                Error::invalid(problem, "")
            })?;
            poses.push(pose);
        }
    }
    let named = |(i, poses): (usize, Vec<Pose>)| {
        let fibre = Fibre::new(poses, arguments.length)
            .map_err(|e| Error::invalid(format!("fibre {i}: {e}"), ""))?;
        Ok(NamedFibre { name: i.to_string(), fibre })
    };
    poses.into_iter().enumerate().map(named).collect()
}

fn summary(entries: &[Entry<'_>], any_section: bool) -> String {
    let mut text = String::new();
    for entry in entries.iter().take(PRINTED) {
        let fit = entry.fit;
        let _ = writeln!(text, "fibre {}: {}", quoted(entry.name), numbers(fit));
        for said in fit.statements() {
            let _ = writeln!(text, "  {said}");
        }
    }
    if entries.len() > PRINTED {
        let fitted = entries.iter().filter(|e| e.fit.status == FitStatus::Fitted).count();
        let _ = writeln!(text, "… {} fibres in all, {fitted} of them fitted", entries.len());
    }
    if any_section {
        text.push_str(
            "The section is not known, and is taken to be an ellipse with an axis ratio of 1.25 within 20 %, which the deviations contain; \
             `--known axis-ratio=1.4` says what was measured.\n",
        );
    }
    text
}

fn numbers(fit: &Fit) -> String {
    let stiffness = fit.stiffness_over_weight[0];
    format!(
        "radius {}, pitch {}, EI/(ρSg) {}, GJ/EI {}, distance {:.2} times the noise",
        with_deviation(fit.curl_radius, 1e3, " mm"),
        with_deviation(fit.curl_pitch, 1e3, " mm"),
        with_deviation(stiffness, 1e6, " cm³"),
        with_deviation(fit.torsion_ratio, 1.0, ""),
        fit.reduced_square.sqrt()
    )
}

fn with_deviation(estimate: Estimate, factor: f64, unit: &str) -> String {
    let (value, deviation) = (estimate.value * factor, estimate.deviation * factor);
    format!("{value:.3} ± {deviation:.3}{unit}")
}
