//! Checks of the curves of a file, which make them strands.

use frisure_strands::{AttributeValues, Strands};
use glam::{DVec3, Vec3};

use super::attributes::{self as names, indices};
use super::curves::Curves;
use super::data::Groom;
use frisure_files::frame::Frame;

/// Most strands that are read from a file.
pub const MAX_STRANDS: usize = 10_000_000;

/// Sizes (m) that hair can have, from one end of the groom to the other.
const SENSIBLE: (f64, f64) = (2e-3, 5.0);

/// Largest coordinate of a point (m). Chosen: beyond, coordinates of 32 bits are more than half a millimetre apart.
const FARTHEST: f64 = 5e3;

/// What errors say that another unit may mend.
const TOO_FAR: &str = "is more than";
const NO_SIZE: &str = "and hair is between 2 mm and 5 m";

/// Whether an error of this module says that the hair has a size or a place that none has.
pub(super) fn may_be_of_unit(what: &str) -> bool {
    [TOO_FAR, NO_SIZE].iter().any(|part| what.contains(part))
}

/// Largest radius of a fibre (m).
pub(super) const THICKEST: f32 = 0.01;

/// Radius of fibres where a file says nothing of it (m): a common human hair.
pub(super) const USUAL_RADIUS: f32 = 35e-6;

impl Curves {
    /// The strands (m), or what is wrong with them.
    pub(super) fn strands(self, frame: Frame) -> Result<Strands, String> {
        let Self { counts, points, diameters, attributes } = self;
        check_counts(&counts, points.len())?;
        if !(frame.metres.is_finite() && frame.metres > 0.0) {
            return Err(format!("its unit is {} m", frame.metres));
        }
        let strand_of = |point: usize| {
            let mut end = 0;
            let owns = |&count: &usize| {
                end += count;
                point < end
            };
            counts.iter().position(owns).unwrap_or(0)
        };
        if let Some(i) = points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
            return Err(format!("point {i}, of strand {}, is not finite", strand_of(i)));
        }
        let inside: Vec<DVec3> = points
            .iter()
            .map(|p| frame.position_from_file(Vec3::from_array(*p).as_dvec3()))
            .collect();
        check_size(&inside, frame, strand_of)?;
        if let Some(i) = inside.iter().position(|p| p.abs().max_element() > FARTHEST) {
            let strand = strand_of(i);
            return Err(format!("point {i}, of strand {strand}, {TOO_FAR} {FARTHEST} m away"));
        }
        let radii = radii(&diameters, points.len(), frame)?;

        let mut strands = Strands::with_capacity(counts.len(), points.len());
        let points: Vec<Vec3> = inside.iter().map(|p| p.as_vec3()).collect();
        let mut start = 0;
        for count in counts {
            strands.push(&points[start..start + count], &radii[start..start + count]);
            start += count;
        }
        // A value of another kind under a name of ours would be written as a file that no reader takes.
        for attribute in attributes.into_iter().filter(names::is_as_named) {
            strands.set_attribute(attribute).map_err(|e| e.to_string())?;
        }
        Ok(strands)
    }
}

/// Checks that curves can hold hairs and guides.
pub(super) fn check_curves(groom: &Groom) -> Result<(), String> {
    check_strands("hair", &groom.hairs)?;
    check_strands("guide", &groom.guides)
}

/// Checks that every strand is a line, of at least two points: no reader takes others.
pub(super) fn check_lines(groom: &Groom) -> Result<(), String> {
    check_each("hair", &groom.hairs)?;
    check_each("guide", &groom.guides)
}

fn check_each(kind: &str, strands: &Strands) -> Result<(), String> {
    match strands.iter().position(|strand| strand.points.len() < 2) {
        None => Ok(()),
        Some(i) => {
            let points = strands.strand(i).points.len();
            Err(format!("{kind} {i} of {points} points: a curve has at least 2"))
        }
    }
}

/// Checks that curves can hold strands: at least two points each, and counts that are signed.
pub(super) fn check_strands(kind: &str, strands: &Strands) -> Result<(), String> {
    check_each(kind, strands)?;
    let points = strands.points().len();
    i32::try_from(points).map(drop).map_err(|_| format!("{points} points of {kind}s"))
}

/// Refuses hairs that follow guides which are not there.
pub(super) fn check_following(groom: &Groom) -> Result<(), String> {
    let guides = groom.guides.len();
    // A file of hairs alone may name guides of another file.
    if guides == 0 {
        return Ok(());
    }
    let first = indices(&groom.hairs, names::GUIDE).unwrap_or_default();
    let three = match groom.hairs.attribute(names::CLOSEST_GUIDES).map(|a| &a.values) {
        Some(AttributeValues::U32x3(three)) => three.as_flattened(),
        _ => &[],
    };
    for (all, each) in [(first, 1), (three, 3)] {
        if let Some(at) = all.iter().position(|guide| *guide as usize >= guides) {
            let (strand, guide) = (at / each, all[at]);
            return Err(format!("strand {strand} follows guide {guide}, and it has {guides}"));
        }
    }
    Ok(())
}

fn check_counts(counts: &[usize], points: usize) -> Result<(), String> {
    if counts.len() > MAX_STRANDS {
        return Err(format!("it has {} strands, and at most {MAX_STRANDS} are read", counts.len()));
    }
    if let Some(i) = counts.iter().position(|&count| count < 2) {
        return Err(match counts[i] {
            0 => format!("strand {i} has no point"),
            _ => format!("strand {i} has one point; a strand has at least 2"),
        });
    }
    let total = counts.iter().try_fold(0_usize, |sum, &n| sum.checked_add(n));
    if total != Some(points) {
        let total = total.map_or("too many".into(), |n| n.to_string());
        return Err(format!("its strands have {total} points, and it has {points}"));
    }
    if u32::try_from(points).is_err() {
        return Err(format!("it has {points} points, and at most {} are read", u32::MAX));
    }
    Ok(())
}

fn radii(diameters: &[f32], points: usize, frame: Frame) -> Result<Vec<f32>, String> {
    if diameters.is_empty() {
        return Ok(vec![USUAL_RADIUS; points]);
    }
    if diameters.len() != points {
        return Err(format!("it has {} widths for {points} points", diameters.len()));
    }
    let radius = |(i, &diameter): (usize, &f32)| {
        let radius = 0.5 * frame.length_from_file(diameter);
        if (0.0..=THICKEST).contains(&radius) {
            return Ok(radius);
        }
        let (radius, most) = (f64::from(radius) * 1e3, f64::from(THICKEST) * 1e3);
        Err(format!("the radius at point {i} is {radius} mm, not between 0 and {most} mm"))
    };
    diameters.iter().enumerate().map(radius).collect()
}

/// Refuses hair of a size that none has: mostly its unit is another.
fn check_size(
    points: &[DVec3],
    frame: Frame,
    strand_of: impl Fn(usize) -> usize,
) -> Result<(), String> {
    let Some(&first) = points.first() else { return Ok(()) };
    let (low, high) = points.iter().fold((first, first), |(l, h), p| (l.min(*p), h.max(*p)));
    let size = (high - low).max_element();
    let (least, most) = SENSIBLE;
    if size >= least && size <= most || points.len() == 1 {
        return Ok(());
    }
    let middle = median(points);
    let mut distances: Vec<f64> = points.iter().map(|p| p.distance(middle)).collect();
    let half = distances.len() / 2;
    let usual = *distances.select_nth_unstable_by(half, f64::total_cmp).1;
    if size > most && usual * 20.0 < most {
        let distance = |i: &usize| points[*i].distance(middle);
        let far = (0..points.len()).max_by(|a, b| distance(a).total_cmp(&distance(b)));
        let i = far.unwrap_or(0);
        let strand = strand_of(i);
        return Err(format!(
            "point {i}, of strand {strand}, is {:.3e} m from the others",
            points[i].distance(middle)
        ));
    }
    let hint = unit_hint(size / frame.metres);
    Err(format!("it is {size:.3e} m across, {NO_SIZE}{hint}"))
}

fn median(points: &[DVec3]) -> DVec3 {
    let middle = |axis: usize| {
        let mut values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        let half = values.len() / 2;
        *values.select_nth_unstable_by(half, f64::total_cmp).1
    };
    DVec3::new(middle(0), middle(1), middle(2))
}

/// The units in which hair of a size, in units of the file, would be as large as a head of hair.
fn unit_hint(size: f64) -> String {
    let units = [("m", 1.0), ("cm", 0.01), ("mm", 0.001), ("dm", 0.1), ("in", 0.0254)];
    let fits = |(_, metres): &&(&str, f64)| (0.1..1.5).contains(&(size * metres));
    let names: Vec<&str> = units.iter().filter(fits).map(|(name, _)| *name).collect();
    match names.split_last() {
        None => String::new(),
        Some((last, [])) => format!("; is it in {last}?"),
        Some((last, others)) => format!("; is it in {} or {last}?", others.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curves(points: &[[f32; 3]]) -> Curves {
        Curves { counts: vec![points.len()], points: points.to_vec(), ..Curves::default() }
    }

    const LINE: [[f32; 3]; 3] = [[0.0; 3], [0.0, 0.0, -10.0], [0.0, 0.0, -20.0]];

    #[test]
    fn centimetres_become_metres() {
        let strands = curves(&LINE).strands(Frame::CENTIMETRES_Z).unwrap();
        assert_eq!(strands.points()[2], Vec3::new(0.0, 0.0, -0.2));
        assert_eq!(strands.radii(), [USUAL_RADIUS; 3]);
    }

    #[test]
    fn a_wrong_unit_is_told() {
        let error = curves(&LINE).strands(Frame::METRES_Z).unwrap_err();
        assert!(error.ends_with("5 m; is it in cm or in?"), "{error}");
    }

    #[test]
    fn a_stray_point_is_named() {
        let mut points = LINE.map(|p| p.map(|x| 0.01 * x)).to_vec();
        points.extend(points.clone());
        points[4][0] = 1e7;
        let mut two = curves(&points);
        two.counts = vec![3, 3];
        let error = two.strands(Frame::METRES_Z).unwrap_err();
        assert!(error.starts_with("point 4, of strand 1, is 1.000e7 m"), "{error}");
    }

    #[test]
    fn hair_beyond_the_horizon_is_refused() {
        let away = LINE.map(|p| [1e9 + p[0], p[1] * 0.01, p[2] * 0.01]);
        let error = curves(&away).strands(Frame::METRES_Z).unwrap_err();
        assert!(error.starts_with("point 0, of strand 0, is more than 5000 m away"), "{error}");
    }

    #[test]
    fn counts_must_fit() {
        for counts in [vec![2], vec![4], vec![3, 0], vec![usize::MAX, 4]] {
            let lying = Curves { counts, ..curves(&LINE) };
            assert!(lying.strands(Frame::CENTIMETRES_Z).is_err());
        }
        let widths = Curves { diameters: vec![0.01; 2], ..curves(&LINE) };
        assert!(widths.strands(Frame::CENTIMETRES_Z).is_err());
    }
}
