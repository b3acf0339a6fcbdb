//! A groom placed on the head, and where one may belong that lies elsewhere.

use frisure::hairstyle::head::Head;
use frisure::scene::Placement;
use frisure::strands::Strands;
use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;
use std::ops::RangeInclusive;

/// Units that a guess names, and their metres.
const UNITS: [(&str, f64); 6] = [
    ("metres", 1.0),
    ("decimetres", 0.1),
    ("centimetres", 0.01),
    ("millimetres", 0.001),
    ("inches", 0.0254),
    ("feet", 0.3048),
];

/// Roots that a guess looks at. Chosen: enough to see the scalp's outline.
const MOST_ROOTS: usize = 200;

/// Steps of the search for a displacement. Chosen with room: it converges in ten to twenty.
const STEPS: usize = 40;

/// Largest median distance (m) of roots from the skin at a guess. Chosen: other heads differ by that much.
const NEAR: f64 = 5e-3;

/// Smallest and largest size of the groom's roots over that of the scalp. Chosen: half a scalp may be bald, and hair may
/// grow down the neck.
const SIZES: [f64; 2] = [0.6, 1.4];

/// Least part of the roots on the scalp at a guess. Chosen: turned heads are as round, but have their scalp elsewhere.
const ON_SCALP: f64 = 0.7;

/// Distance (m) from a point of the scalp at which a root is on it. Chosen: a triangle of a coarse head.
const SCALP_REACH: f64 = 0.015;

/// Part of the miss of a unit to which another scale must bring it to be proposed instead. Chosen: on a head of another
/// form than its own, a groom in a unit misses about as much at any scale.
const OTHER_SCALE: f64 = 0.3;

/// Part by which a scale may differ from that of a unit and be the same. Chosen: roots are that far from the skin.
const SAME_SCALE: f64 = 0.02;

/// Significant digits of a scale that is proposed. Chosen: the place of a groom 100 m away is then right within a
/// tenth of a millimetre.
const DIGITS: usize = 6;

/// Scales that a scene may ask for.
const SAID: RangeInclusive<f64> = 1e-6..=1e6;

/// Largest displacement (m) that a scene may ask for.
const FARTHEST: f64 = 1000.0;

/// The strands, which have their scale, at their places on the head.
pub(crate) fn placed(strands: &Strands, placement: &Placement) -> Strands {
    let placement = &Placement { scale: 1.0, ..*placement };
    if *placement == Placement::default() {
        return strands.clone();
    }
    let mut out = Strands::with_capacity(strands.len(), strands.points().len());
    for strand in strands.iter() {
        let place = |p: &Vec3| placement.position(p.as_dvec3()).as_vec3();
        let points: Vec<Vec3> = strand.points.iter().map(place).collect();
        out.push(&points, strand.radii);
    }
    for attribute in strands.attributes() {
        out.set_attribute(attribute.clone()).expect("as many strands and points as before");
    }
    out
}

/// A placement that brings roots (m) onto the scalp, if there is one: the same unit wherever that fits, then another
/// unit, then any scale; and turns by quarters.
pub(crate) fn guess(head: &Head, roots: &[DVec3]) -> Option<Placement> {
    let stride = roots.len().div_ceil(MOST_ROOTS).max(1);
    let roots: Vec<DVec3> = roots.iter().step_by(stride).copied().collect();
    let scalp: Vec<DVec3> = head
        .surface()
        .positions()
        .iter()
        .zip(head.scalp())
        .filter(|(_, weight)| **weight > 0.5)
        .map(|(p, _)| *p)
        .collect();
    if roots.is_empty() || scalp.is_empty() {
        return None;
    }
    let size = extent(&roots) / extent(&scalp);
    let fits = |scale: &f64| (SIZES[0]..=SIZES[1]).contains(&(scale * size));
    let starts = |scales: &[f64]| -> Vec<Placement> {
        let turned =
            |&scale| quarters().map(move |turn| Placement { scale, turn, shift: DVec3::ZERO });
        scales.iter().flat_map(turned).collect()
    };
    let nearest = |starts: &mut dyn Iterator<Item = Placement>| {
        let mut best: Option<(f64, Placement)> = None;
        for (miss, placement) in starts.filter_map(|start| moved(head, &scalp, &roots, start)) {
            // A later guess has to be clearly nearer: the first ones have fewer lines.
            if best.is_none_or(|(least, _)| miss < 0.9 * least) {
                best = Some((miss, placement));
            }
        }
        best
    };
    // No scale at all where all roots are one point.
    let own = Some(rounded(size.recip())).filter(|scale| scale.is_finite());
    let sized = |start: Placement| {
        let scale = scaled(head, &scalp, &roots, start)?;
        fits(&scale).then_some(Placement { scale, shift: DVec3::ZERO, ..start })
    };
    if fits(&1.0)
        && let Some((_, same)) = nearest(&mut starts(&[1.0]).into_iter())
    {
        return Some(same);
    }
    let units: Vec<f64> = unit_scales().into_iter().filter(fits).collect();
    let Some((miss, unit)) = nearest(&mut starts(&units).into_iter()) else {
        let found = nearest(&mut starts(own.as_slice()).into_iter().filter_map(sized));
        return found.map(|(_, placement)| placement);
    };
    let other = nearest(&mut sized(unit).into_iter());
    let is_other = |(less, other): &(f64, Placement)| {
        *less < OTHER_SCALE * miss && (other.scale / unit.scale - 1.0).abs() > SAME_SCALE
    };
    let other = other.filter(is_other);
    Some(other.map_or(unit, |(_, placement)| placement))
}

/// Factors from one unit to another.
fn unit_scales() -> Vec<f64> {
    let pairs = UNITS.iter().flat_map(|(_, a)| UNITS.iter().map(move |(_, b)| rounded(a / b)));
    let mut scales: Vec<f64> = pairs.collect();
    scales.sort_by(f64::total_cmp);
    scales.dedup();
    scales
}

/// A number with as many digits as a scale is proposed with.
fn rounded(x: f64) -> f64 {
    format!("{x:.*e}", DIGITS - 1).parse().unwrap_or(x)
}

/// The 24 rotations that turn axes into axes, as turns (rad) about x, y and z, the fewest first: a turn about x or y brings
/// another axis up, one about z follows.
fn quarters() -> impl Iterator<Item = DVec3> {
    let upright = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
    let turns = [0.0, 1.0, -1.0, 2.0];
    upright
        .into_iter()
        .flat_map(move |[x, y]| turns.into_iter().map(move |z| FRAC_PI_2 * DVec3::new(x, y, z)))
}

/// Root mean square distance (m) of points from their centre.
fn extent(points: &[DVec3]) -> f64 {
    let centre = mean(points);
    let squares: f64 = points.iter().map(|p| p.distance_squared(centre)).sum();
    (squares / points.len() as f64).sqrt()
}

fn mean(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len() as f64
}

/// The placement with the displacement that brings the roots nearest to the skin, from centre on centre, and how far they
/// miss the scalp (m); none if they do not come near.
fn moved(
    head: &Head,
    scalp: &[DVec3],
    roots: &[DVec3],
    start: Placement,
) -> Option<(f64, Placement)> {
    let turned: Vec<DVec3> = roots.iter().map(|&p| start.position(p)).collect();
    let mut shift = mean(scalp) - mean(&turned);
    let field = head.signed_distance();
    for _ in 0..STEPS {
        // Gauss and Newton for Σ d²: the normal equations Σ n nᵀ δ = −Σ d n, with n = ∇d.
        let (mut matrix, mut vector) = (DMat3::ZERO, DVec3::ZERO);
        for p in &turned {
            let (d, n) = field.value_gradient(*p + shift);
            matrix += DMat3::from_cols(n * n.x, n * n.y, n * n.z);
            vector += n * d;
        }
        // Roots on a small patch leave directions along it open.
        let damped = matrix + DMat3::from_diagonal(DVec3::splat(1e-3 * roots.len() as f64));
        shift -= damped.inverse() * vector;
    }
    let placed = || turned.iter().map(|p| *p + shift);
    let mut distances: Vec<f64> = placed().map(|p| field.value(p).abs()).collect();
    let half = distances.len() / 2;
    let median = *distances.select_nth_unstable_by(half, f64::total_cmp).1;
    let reach = SCALP_REACH * SCALP_REACH;
    let on_scalp = |p: &DVec3| scalp.iter().any(|q| q.distance_squared(*p) < reach);
    let share = placed().filter(on_scalp).count() as f64 / roots.len() as f64;
    let can_be_said = SAID.contains(&start.scale) && shift.abs().max_element() < FARTHEST;
    let near = can_be_said && median < NEAR && share > ON_SCALP;
    near.then_some((median + NEAR * (1.0 - share), Placement { shift, ..start }))
}

/// The scale that brings turned roots nearest to the skin, with the displacement that is best for it; none if the search
/// finds none.
fn scaled(head: &Head, scalp: &[DVec3], roots: &[DVec3], start: Placement) -> Option<f64> {
    let turned: Vec<DVec3> = roots.iter().map(|&p| start.position(p)).collect();
    let (from, to) = (mean(&turned), mean(scalp));
    let field = head.signed_distance();
    // Scale and place are told from each other best about the centre.
    let (mut shift, mut factor) = (DVec3::ZERO, 1.0);
    for _ in 0..STEPS {
        let (mut matrix, mut vector, mut mixed) = (DMat3::ZERO, DVec3::ZERO, DVec3::ZERO);
        let (mut square, mut slope) = (0.0, 0.0);
        for p in &turned {
            let arm = *p - from;
            let (d, n) = field.value_gradient(to + factor * arm + shift);
            let along = n.dot(arm);
            matrix += DMat3::from_cols(n * n.x, n * n.y, n * n.z);
            vector += n * d;
            mixed += n * along;
            square += along * along;
            slope += along * d;
        }
        let inverse =
            (matrix + DMat3::from_diagonal(DVec3::splat(1e-3 * roots.len() as f64))).inverse();
        // The scale by elimination of the displacement.
        let pivot = square - mixed.dot(inverse * mixed);
        let change = -(slope - mixed.dot(inverse * vector)) / pivot;
        if !change.is_finite() {
            return None;
        }
        let change = change.clamp(-0.2 * factor, 0.2 * factor);
        shift -= inverse * (vector + mixed * change);
        factor += change;
    }
    Some(rounded(start.scale * factor))
}

/// What a guess takes the groom for: `the groom looks as if it were in inches, turned and moved`. A unit has a name where
/// the scene says as how many `metres` it is read.
pub(crate) fn words(placement: &Placement, metres: Option<f64>) -> String {
    let Placement { scale, turn, shift } = placement;
    let mut found = Vec::new();
    if *scale != 1.0 {
        let is_unit = |unit: f64| metres.is_some_and(|m| (m * scale / unit - 1.0).abs() < 1e-6);
        let unit = UNITS.iter().find(|(_, unit)| is_unit(*unit));
        found.push(match unit {
            Some((name, _)) => format!("in {name}"),
            None if *scale > 1.0 => format!("{} times too small", digits(*scale, 4)),
            None => format!("{} times too large", digits(scale.recip(), 4)),
        });
    }
    if *turn != DVec3::ZERO {
        found.push("turned".into());
    }
    if *shift != DVec3::ZERO {
        found.push("moved".into());
    }
    let last = found.pop().unwrap_or_else(|| "in its place".into());
    let list = if found.is_empty() { last } else { format!("{} and {last}", found.join(", ")) };
    format!("the groom looks as if it were {list}")
}

/// The lines of `[groom]` that say a placement, one after the other.
pub(crate) fn lines(placement: &Placement) -> String {
    let Placement { scale, turn, shift } = placement;
    let mut lines = Vec::new();
    if *scale != 1.0 {
        lines.push(format!("scale = {}", digits(*scale, DIGITS)));
    }
    if *turn != DVec3::ZERO {
        let [x, y, z] = turn.to_array().map(|angle| number(angle.to_degrees(), 1));
        lines.push(format!("turn = [{x}, {y}, {z}]"));
    }
    let [x, y, z] = shift.to_array().map(|x| number(x, 4));
    lines.push(format!("move = [{x}, {y}, {z}]"));
    lines.join("\n")
}

/// A number with at most this many significant digits.
fn digits(x: f64, digits: usize) -> String {
    let whole = x.abs().log10().floor() as i32 + 1;
    number(x, usize::try_from(digits as i32 - whole).unwrap_or(0))
}

/// A number with at most this many decimals.
fn number(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frisure::hairstyle::{PredictOptions, predict, preset};

    /// Roots (m) of a mannequin's hair.
    fn roots(head: &Head) -> Vec<DVec3> {
        let mut spec = preset("wavy").unwrap().spec();
        (spec.wisps.count, spec.length.mean) = (150, 0.01);
        let hairstyle = predict(&spec, head, PredictOptions::default(), &()).unwrap();
        hairstyle.equilibria().iter().map(|guide| guide.rod.root().position()).collect()
    }

    #[test]
    fn a_groom_in_another_unit_with_other_axes_and_elsewhere_is_found() {
        let head = Head::mannequin();
        let roots = roots(&head);
        for (scale, turn, shift) in [
            (1.0 / 0.0254, DVec3::new(-1.0, 0.0, 0.0), DVec3::new(0.0, 60.0, 3.0)),
            (100.0, DVec3::new(0.0, 0.0, 1.0), DVec3::new(-40.0, 5.0, 170.0)),
            (1.0, DVec3::new(0.0, 0.0, 0.0), DVec3::new(0.0, 0.0, 3.0)),
            (10.0, DVec3::new(1.0, 0.0, 2.0), DVec3::new(1.0, -1.0, 0.0)),
            // The axis x points up.
            (1.0, DVec3::new(0.0, -1.0, 0.0), DVec3::new(2.0, 0.0, -1.0)),
            (100.0, DVec3::new(0.0, 1.0, 1.0), DVec3::new(0.0, 30.0, 0.0)),
        ] {
            let elsewhere = Placement { scale, turn: FRAC_PI_2 * turn, shift };
            let lying: Vec<DVec3> = roots.iter().map(|&p| elsewhere.position(p)).collect();
            let found = guess(&head, &lying).expect("a guess");
            let back: f64 = lying
                .iter()
                .zip(&roots)
                .map(|(p, root)| found.position(*p).distance(*root))
                .fold(0.0, f64::max);
            // Up to the slack of a search that knows the skin, and not which root is which.
            assert!(back < 6e-3, "{scale} {turn}: {found:?} misses by {back} m");
        }
        let line: Vec<DVec3> = (0..100).map(|i| 0.002 * f64::from(i) * DVec3::X).collect();
        assert_eq!(guess(&head, &line), None);
        assert_eq!(guess(&head, &[DVec3::ONE; 9]), None);
    }

    #[test]
    fn any_unit_read_as_any_other_is_found_and_so_is_a_scale_of_no_unit() {
        let head = Head::mannequin();
        let roots = roots(&head);
        let units = UNITS.iter().flat_map(|(_, a)| UNITS.iter().map(move |(_, b)| a / b));
        for scale in units.chain([37.0, 0.011]) {
            let lying: Vec<DVec3> =
                roots.iter().map(|p| scale * (*p + DVec3::new(0.3, 0.0, -3.0))).collect();
            let found = guess(&head, &lying).expect("a guess");
            assert!((found.scale * scale - 1.0).abs() < 0.03, "{scale}: {found:?}");
            let text = format!("[groom]\nfile = 'a.obj'\n{}", lines(&found));
            let scene = frisure::scene::Scene::parse("a", text, "".as_ref()).unwrap();
            let read = scene.groom.unwrap().placement;
            assert_eq!(read.scale, found.scale);
            let far = |p: &DVec3| head.signed_distance().value(read.position(*p)).abs();
            let mut distances: Vec<f64> = lying.iter().map(far).collect();
            distances.sort_by(f64::total_cmp);
            assert!(distances[distances.len() / 2] < 2e-3, "{scale}: {read:?}");
        }
    }

    #[test]
    fn turns_by_quarters_are_the_24_rotations_of_a_cube() {
        let rotation = |turn| Placement { turn, ..Placement::default() }.rotation();
        let rotations: Vec<DMat3> = quarters().map(rotation).collect();
        assert_eq!(rotations.len(), 24);
        for (i, a) in rotations.iter().enumerate() {
            assert!(rotations[..i].iter().all(|b| !a.abs_diff_eq(*b, 1e-9)), "{a}");
        }
    }

    #[test]
    fn words_name_the_unit_where_there_is_one() {
        let turn = DVec3::new(FRAC_PI_2, 0.0, 0.0);
        let all = Placement { scale: 2.54, turn, shift: DVec3::ONE };
        assert_eq!(
            words(&all, Some(0.01)),
            "the groom looks as if it were in inches, turned and moved"
        );
        let large = Placement { scale: 0.1, ..Placement::default() };
        assert_eq!(words(&large, Some(0.1)), "the groom looks as if it were in centimetres");
        assert_eq!(words(&large, None), "the groom looks as if it were 10 times too large");
        let small = Placement { shift: DVec3::X, ..Placement { scale: 2.54, ..large } };
        assert_eq!(
            words(&small, Some(1.0)),
            "the groom looks as if it were 2.54 times too small and moved"
        );
    }

    #[test]
    fn lines_say_what_is_not_as_it_is() {
        let still = Placement { shift: DVec3::new(0.5, -0.0, 1.25), ..Placement::default() };
        assert_eq!(lines(&still), "move = [0.5, 0, 1.25]");
        let turn = DVec3::new(FRAC_PI_2, 0.0, -FRAC_PI_2);
        let all = Placement { scale: 0.0254, turn, ..still };
        assert_eq!(lines(&all), "scale = 0.0254\nturn = [90, 0, -90]\nmove = [0.5, 0, 1.25]");
    }
}
