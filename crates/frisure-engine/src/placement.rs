//! A groom placed on the head, and where one may belong that lies elsewhere.

use frisure::hairstyle::head::Head;
use frisure::scene::Placement;
use frisure::strands::Strands;
use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;

/// Factors that are tried: one, between units, and between units and inches or feet.
const SCALES: [f64; 13] = [
    1.0,
    0.001,
    0.01,
    0.0254,
    0.1,
    0.3048,
    2.54,
    1.0 / 2.54,
    10.0,
    1.0 / 0.3048,
    1.0 / 0.0254,
    100.0,
    1000.0,
];

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

/// The strands at their places on the head.
pub(crate) fn placed(strands: &Strands, placement: &Placement) -> Strands {
    if *placement == Placement::default() {
        return strands.clone();
    }
    let mut out = Strands::with_capacity(strands.len(), strands.points().len());
    for strand in strands.iter() {
        let place = |p: &Vec3| placement.position(p.as_dvec3()).as_vec3();
        let points: Vec<Vec3> = strand.points.iter().map(place).collect();
        let radii: Vec<f32> = strand.radii.iter().map(|r| r * placement.scale as f32).collect();
        out.push(&points, &radii);
    }
    for attribute in strands.attributes() {
        out.set_attribute(attribute.clone()).expect("as many strands and points as before");
    }
    out
}

/// A placement that brings roots (m) onto the scalp, if there is one: the same unit wherever that fits, and turns by
/// quarters.
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
    let mut best: Option<(f64, Placement)> = None;
    for scale in SCALES.into_iter().filter(fits) {
        for turn in quarters() {
            let start = Placement { scale, turn, shift: DVec3::ZERO };
            let Some((miss, placement)) = moved(head, &scalp, &roots, start) else { continue };
            // A later guess has to be clearly nearer: the first ones have fewer lines.
            if best.is_none_or(|(least, _)| miss < 0.9 * least) {
                best = Some((miss, placement));
            }
        }
        if best.is_some() {
            break;
        }
    }
    best.map(|(_, placement)| placement)
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
    let near = median < NEAR && share > ON_SCALP;
    near.then_some((median + NEAR * (1.0 - share), Placement { shift, ..start }))
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
            None if *scale > 1.0 => format!("{} times too small", number(*scale, 4)),
            None => format!("{} times too large", number(scale.recip(), 4)),
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
        lines.push(format!("scale = {}", number(*scale, 6)));
    }
    if *turn != DVec3::ZERO {
        let [x, y, z] = turn.to_array().map(|angle| number(angle.to_degrees(), 1));
        lines.push(format!("turn = [{x}, {y}, {z}]"));
    }
    let [x, y, z] = shift.to_array().map(|x| number(x, 4));
    lines.push(format!("move = [{x}, {y}, {z}]"));
    lines.join("\n")
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
        let small: Vec<DVec3> = roots.iter().map(|p| 7e-5 * *p).collect();
        assert_eq!(guess(&head, &small), None);
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
