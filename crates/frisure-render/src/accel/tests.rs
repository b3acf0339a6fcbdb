//! What must be true of rays, hair and heads.

use std::f32::consts::TAU;

use frisure_optics::scattering::{Fibre, FibreFrame, FibreSpec};
use frisure_strands::{Strands, Surface};
use glam::{DVec3, Vec3};

use super::curves::{Curves, Piece, REACH};
use super::hair::HairLeaf;
use super::node::Leaf as _;
use super::*;

/// A small generator of random numbers.
struct Dice(u64);

impl Dice {
    fn uniform(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 40) as f32 / (1 << 24) as f32
    }

    fn direction(&mut self) -> Vec3 {
        let (z, phi) = (2.0 * self.uniform() - 1.0, TAU * self.uniform());
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * phi.cos(), r * phi.sin(), z)
    }

    fn point(&mut self, size: f32) -> Vec3 {
        size * (Vec3::new(self.uniform(), self.uniform(), self.uniform()) - 0.5)
    }
}

/// Random walks of `points` steps of `step` (m) in a cube of 6 cm, as thick as `radius`.
fn tangle(count: usize, points: usize, step: f32, radius: f32) -> Strands {
    let mut dice = Dice(7);
    let mut strands = Strands::new();
    for _ in 0..count {
        let (mut p, mut d) = (dice.point(0.06), dice.direction());
        let walk: Vec<Vec3> = (0..points)
            .map(|_| {
                d = (d + 0.5 * dice.direction()).normalize();
                p += step * d;
                p
            })
            .collect();
        let radii: Vec<f32> = walk.iter().map(|_| radius * (0.6 + 0.8 * dice.uniform())).collect();
        strands.push(&walk, &radii);
    }
    strands
}

fn ball(radius: f64) -> Surface {
    let n = 24_u32;
    let at = |i: u32, j: u32| {
        let (st, ct) = (f64::from(i) / f64::from(n) * std::f64::consts::PI).sin_cos();
        let (sp, cp) = (f64::from(j) / f64::from(n) * std::f64::consts::TAU).sin_cos();
        radius * DVec3::new(st * cp, st * sp, ct)
    };
    let positions = (0..=n).flat_map(|i| (0..n).map(move |j| at(i, j))).collect();
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let k = (j + 1) % n;
        let [a, b, c, d] = [i * n + j, i * n + k, (i + 1) * n + j, (i + 1) * n + k];
        [[a, c, d], [a, d, b]]
    });
    Surface::new(positions, triangles.collect()).unwrap()
}

fn scene(strands: &Strands, head: Option<&Surface>) -> SceneBvh {
    SceneBvh::new(strands, head, &CurveOptions::default()).unwrap()
}

fn pieces(strands: &Strands) -> Vec<Piece> {
    pieces_of(strands, &CurveOptions::default())
}

fn pieces_of(strands: &Strands, options: &CurveOptions) -> Vec<Piece> {
    let curves = Curves::new(strands, options).unwrap();
    let boxes = curves.boxes();
    let leaves = boxes.chunks(8).map(|eight| HairLeaf::new(&curves, eight));
    let pieces = leaves.flat_map(|leaf| (0..8).map(move |i| leaf.piece(i)));
    pieces.filter(|piece| piece.radius > 0.0).collect()
}

/// Rays of which many pass near the tangle, from near, far and inside.
fn rays(count: usize, reach: f32) -> Vec<Ray> {
    let mut dice = Dice(99);
    (0..count)
        .map(|i| {
            let far = [0.0, 0.1, 1.0][i % 3];
            let from = far * dice.direction() + dice.point(reach);
            Ray::new(from, dice.point(reach) - from)
        })
        .collect()
}

/// Where the ray enters a piece: the quadratic of a cone, straight from the page, in f64. The second
/// number is how near to a miss that is, in radii.
fn enters(piece: &Piece, ray: &Ray) -> Option<(f64, f64)> {
    let length = piece.axis.as_dvec3().length();
    let axis = piece.axis.as_dvec3() / length;
    let slope = f64::from(piece.widening) / length;
    let (x, d) = (ray.origin().as_dvec3() - piece.start.as_dvec3(), ray.direction().as_dvec3());
    let (xa, da) = (x.dot(axis), d.dot(axis));
    let r0 = f64::from(piece.radius) + slope * xa;
    let a = d.length_squared() - da * da - slope * slope * da * da;
    let b = x.dot(d) - xa * da - r0 * slope * da;
    let c = x.length_squared() - xa * xa - r0 * r0;
    let root = b * b - a * c;
    let t = (-b - root.max(0.0).sqrt()) / a;
    let s = xa + t * da;
    let reach = f64::from(REACH * piece.radius);
    let slack = (root / a).min(s + reach).min(length + reach - s).min(t) / f64::from(piece.radius);
    (root > 0.0 && t >= 0.0 && s >= -reach && s <= length + reach).then_some((t, slack))
}

fn brute_force(pieces: &[Piece], ray: &Ray) -> Option<(f64, f64)> {
    pieces.iter().filter_map(|piece| enters(piece, ray)).min_by(|a, b| a.0.total_cmp(&b.0))
}

fn meet(hit: Option<Hit>) -> HairHit {
    match hit {
        Some(Hit::Hair(hit)) => hit,
        other => panic!("no hair: {other:?}"),
    }
}

#[test]
fn the_closest_hit_is_that_of_a_loop_over_all_pieces() {
    for radius in [3.5e-5, 1e-3] {
        let strands = tangle(60, 9, 0.006, radius);
        let (scene, pieces) = (scene(&strands, None), pieces(&strands));
        let (mut hits, mut doubtful) = (0, 0);
        for ray in rays(6000, 0.06) {
            let found = scene.closest_hit(&ray, f32::INFINITY);
            assert_eq!(found.is_some(), scene.occluded(&ray, f32::INFINITY));
            match (brute_force(&pieces, &ray), found) {
                (None, None) => {}
                (Some((t, _)), Some(hit)) if (t - f64::from(hit.t())).abs() < 2e-6 => {
                    hits += 1;
                    assert!(!scene.occluded(&ray, hit.t() - 1e-6));
                    assert!(scene.occluded(&ray, hit.t() + 1e-6));
                }
                // Rounding may tell a graze from a miss.
                _ => doubtful += 1,
            }
        }
        assert!(hits > 30 && doubtful * 200 <= hits, "{radius}: {hits} hits, {doubtful} doubtful");
    }
}

#[test]
fn thin_hair_covers_exactly_its_width() {
    // A hair 60 µm wide among rays 1 µm apart, seen from 0.1, 1 and 10 m.
    let mut strands = Strands::new();
    strands.push(&[Vec3::new(-0.05, 0.0, 0.1), Vec3::new(0.05, 0.0, 0.1)], &[3e-5; 2]);
    let scene = scene(&strands, None);
    for distance in [0.1, 1.0, 10.0] {
        let hits = (-60_i16..60)
            .map(|i| Vec3::new(0.003, -distance, 0.1 + 1e-6 * (f32::from(i) + 0.5)))
            .filter(|&from| scene.closest_hit(&Ray::new(from, Vec3::Y), f32::INFINITY).is_some());
        assert_eq!(hits.count(), 60, "from {distance} m");
    }
}

#[test]
fn plain_rust_finds_the_same() {
    let (strands, head) = (tangle(80, 9, 0.006, 4e-4), ball(0.02));
    let (fast, plain) = (scene(&strands, Some(&head)), scene(&strands, Some(&head)).portable());
    let mut differing = 0;
    for ray in rays(6000, 0.06) {
        let [a, b] = [&fast, &plain].map(|s| s.closest_hit(&ray, f32::INFINITY));
        let same = match (a, b) {
            (Some(a), Some(b)) => (a.t() - b.t()).abs() < 1e-6,
            (a, b) => a.is_none() && b.is_none(),
        };
        differing += u32::from(!same);
        assert_eq!(b.is_some(), plain.occluded(&ray, f32::INFINITY));
    }
    assert!(differing <= 3, "{differing} of 6000 differ");
}

#[test]
fn the_hierarchy_is_the_same_on_any_number_of_threads() {
    let strands = tangle(3000, 16, 0.012, 4e-5);
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| scene(&strands, None))
    };
    let (one, three) = (build(1), build(3));
    assert!(one.pieces() > 100_000, "{}", one.pieces());
    assert!(one.same_trees(&three));
}

#[test]
fn a_hit_tells_where_it_is() {
    let strands = tangle(60, 9, 0.006, 1e-3);
    let scene = scene(&strands, None);
    let mut hits = 0;
    for ray in rays(3000, 0.06) {
        let Some(Hit::Hair(hit)) = scene.closest_hit(&ray, f32::INFINITY) else { continue };
        hits += 1;
        let strand = strands.strand(hit.strand as usize);
        let segment = hit.segment as usize;
        let [r0, r1] = [strand.radii[segment], strand.radii[segment + 1]];
        assert!((hit.radius - (r0 + (r1 - r0) * hit.u)).abs() < 1e-6);
        let (p, out) = (ray.at(hit.t), ray.at(hit.t) - hit.centre);
        assert!((out.length() - hit.radius).abs() < 0.05 * hit.radius, "{p} is on the surface");
        assert!(hit.normal.dot(ray.direction()) < 1e-3 && hit.normal.dot(out) > 0.0);
        assert!(hit.tangent.dot(hit.axis) > 0.8 && hit.tangent.is_normalized());
        // The normal leans to `direction × tangent` by asin h.
        let (a, d) = (hit.axis.as_dvec3(), ray.direction().as_dvec3());
        let across = d.cross(a).normalize();
        let sine = hit.normal.as_dvec3().reject_from(a).normalize().dot(across);
        assert!((sine - f64::from(hit.h)).abs() < 0.03, "{sine} {}", hit.h);
    }
    assert!(hits > 500);
}

#[test]
fn h_is_positive_towards_direction_cross_tangent_and_linear() {
    let mut strands = Strands::new();
    strands.push(&[Vec3::new(-0.05, 0.0, 0.0), Vec3::new(0.05, 0.0, 0.0)], &[4e-5; 2]);
    let scene = scene(&strands, None);
    // Tangent +x, ray along +y: direction × tangent is −z.
    for h in [-0.9_f32, -0.25, 0.0, 0.5, 0.99] {
        let ray = Ray::new(Vec3::new(0.01, -0.3, -h * 4e-5), Vec3::Y);
        let hit = meet(scene.closest_hit(&ray, f32::INFINITY));
        assert!((hit.h - h).abs() < 1e-3, "{} for {h}", hit.h);
        let depth = 4e-5 * (1.0 - h * h).sqrt();
        assert!((hit.t - (0.3 - depth)).abs() < 1e-7);
        assert!((hit.u - 0.6).abs() < 1e-5);
    }
}

#[test]
fn optics_counts_the_offset_the_other_way_round() {
    let strands = tangle(40, 9, 0.006, 1e-3);
    let scene = scene(&strands, None);
    let fibre = Fibre::new(FibreSpec::default()).unwrap();
    assert!((fibre.spec().axis_ratio - 1.0).abs() < 1e-6);
    let mut hits = 0;
    for ray in rays(900, 0.06) {
        let Some(Hit::Hair(hit)) = scene.closest_hit(&ray, f32::INFINITY) else { continue };
        let frame = FibreFrame::new(hit.axis, hit.axis.any_orthonormal_vector());
        let at = frame.to_local(ray.at(hit.t) - hit.centre).truncate() / hit.radius;
        let offset = fibre.offset(frame.to_local(-ray.direction()), at);
        assert!((offset + hit.h).abs() < 0.03, "{offset} {}", hit.h);
        hits += 1;
    }
    assert!(hits > 100);
}

#[test]
fn light_that_goes_on_leaves_the_fibre() {
    // A straight hair in many pieces, of changing radius: no direction meets it again.
    let points: Vec<Vec3> = (0..9_u8).map(|i| Vec3::new(0.1, 0.02 * f32::from(i), 0.07)).collect();
    let mut strands = Strands::new();
    strands.push(&points, &[5e-5, 4e-5, 4.5e-5, 5e-5, 4e-5, 4.5e-5, 5e-5, 4e-5, 4.5e-5]);
    let scene = scene(&strands, None);
    let mut dice = Dice(3);
    for _ in 0..2000 {
        let at = Vec3::new(0.1, 0.16 * dice.uniform(), 0.07) + 5e-5 * dice.direction();
        let from = at + dice.direction();
        let ray = Ray::new(from, at - from);
        let Some(hit) = scene.closest_hit(&ray, f32::INFINITY) else { continue };
        let towards = dice.direction();
        let on = Ray::new(hit.ray_origin(towards), towards);
        assert_eq!(scene.closest_hit(&on, f32::INFINITY), None);
    }
}

/// Part of the light that goes on from random places of a curl in random directions and meets the
/// curl again, at any distance and within 20 radii, with pieces that lie beside it by `tolerance`.
fn meets_itself_again(tolerance: f32) -> (f32, f32) {
    let radius = 3.5e-5;
    let curl: Vec<Vec3> = (0..90_u8)
        .map(|i| {
            let turn = 0.35 * f32::from(i);
            Vec3::new(6e-3 * turn.cos(), 6e-3 * turn.sin(), 4e-3 * turn)
        })
        .collect();
    let mut strands = Strands::new();
    strands.push(&curl, &[radius; 90]);
    let options = CurveOptions { tolerance, ..CurveOptions::default() };
    let scene = SceneBvh::new(&strands, None, &options).unwrap();
    let mut dice = Dice(11);
    let (mut all, mut again, mut near) = (0.0_f32, 0.0, 0.0);
    for i in 0..40_000 {
        // Beside a joint, where pieces could be in each other's way.
        let at = curl[i % 89] + 0.05 * dice.uniform() * (curl[i % 89 + 1] - curl[i % 89]);
        let from = at + 0.1 * dice.direction();
        let Some(hit) = scene.closest_hit(&Ray::new(from, at - from), 1.0) else { continue };
        let towards = dice.direction();
        let next = scene.closest_hit(&Ray::new(hit.ray_origin(towards), towards), 1.0);
        all += 1.0;
        again += f32::from(u8::from(next.is_some()));
        near += f32::from(u8::from(next.is_some_and(|next| next.t() < 20.0 * radius)));
    }
    (again / all, near / all)
}

#[test]
fn a_curl_cut_into_pieces_does_not_shade_itself_more() {
    let (again, near) = meets_itself_again(5e-5);
    let (smooth, near_smooth) = meets_itself_again(1.1e-6);
    assert!((again - smooth).abs() < 0.002, "{again}, smooth {smooth}");
    assert!((near - near_smooth).abs() < 0.002, "{near}, smooth {near_smooth}");
}

#[test]
fn a_ray_inside_a_fibre_or_along_it_meets_nothing() {
    let mut strands = Strands::new();
    strands.push(&[Vec3::ZERO, 0.01 * Vec3::X, 0.02 * Vec3::X], &[1e-3; 3]);
    let scene = scene(&strands, None);
    let meets = |from, towards| scene.closest_hit(&Ray::new(from, towards), f32::INFINITY);
    assert_eq!(meets(Vec3::new(0.012, 0.0, 1e-4), Vec3::Y), None);
    assert_eq!(meets(Vec3::new(-0.1, 0.0, 2e-3), Vec3::X), None);
    assert_eq!(meets(Vec3::new(0.005, 0.0, 0.0), Vec3::X), None);
    assert_eq!(meets(Vec3::new(-0.1, 0.0, 0.0), Vec3::X), None);
    assert!(meets(Vec3::new(0.012, -0.1, 1e-4), Vec3::Y).is_some());
}

#[test]
fn a_bent_strand_has_no_gaps_at_its_joints() {
    // Rays in the plane of a circle of 4 mm, from outside towards its middle, all must hit.
    let circle: Vec<Vec3> = (0..12_u8)
        .map(|i| 4e-3 * Vec3::new((0.45 * f32::from(i)).cos(), (0.45 * f32::from(i)).sin(), 0.0))
        .collect();
    let mut strands = Strands::new();
    strands.push(&circle, &[5e-4; 12]);
    let scene = scene(&strands, None);
    for i in 0..4000_u16 {
        let turn = 0.05 + 4.85 * f32::from(i) / 4000.0;
        let out = Vec3::new(turn.cos(), turn.sin(), 0.0);
        let hit = meet(scene.closest_hit(&Ray::new(0.05 * out, -out), f32::INFINITY));
        assert!((0.05 - hit.t - 4.5e-3).abs() < 8e-5);
    }
}

#[test]
fn pieces_follow_the_curve_within_the_tolerance() {
    let strands = tangle(40, 9, 0.01, 5e-5);
    let options = CurveOptions { longest_piece: 3e-3, tolerance: 3e-5 };
    let coarse: Vec<Piece> = pieces_of(&strands, &options);
    let fine = CurveOptions { longest_piece: 1e-3, tolerance: 2e-6 };
    let fine: Vec<Piece> = pieces_of(&strands, &fine);
    assert!(coarse.iter().all(|p| p.axis.length() < 1.3 * options.longest_piece));
    for p in &fine {
        let own = coarse.iter().filter(|q| q.name.point == p.name.point);
        let aside = own.map(|q| {
            let s = (p.start - q.start).dot(q.axis) / q.axis.length_squared();
            p.start.distance(q.start + s.clamp(0.0, 1.0) * q.axis)
        });
        assert!(aside.fold(f32::INFINITY, f32::min) < 3.2e-5);
    }
}

#[test]
fn the_head_is_met_where_it_is_and_has_no_holes() {
    let head = ball(0.1);
    let scene = scene(&Strands::new(), Some(&head));
    let mut dice = Dice(5);
    for i in 0..20_000 {
        // Every other ray aims at a vertex, where holes would be.
        let vertex = head.positions()[i % head.positions().len()].as_vec3();
        let target = if i % 2 == 0 { 0.999 * vertex } else { 0.09 * dice.direction() };
        let from = target + 0.5 * dice.direction();
        let ray = Ray::new(from, target - from);
        let Some(Hit::Skin(hit)) = scene.closest_hit(&ray, f32::INFINITY) else {
            let inside = Ray::new(Vec3::ZERO, target);
            assert!(scene.occluded(&inside, 1.0), "a hole towards {target}");
            continue;
        };
        let corners = head.corners(hit.face as usize);
        let weights = hit.barycentric.map(f64::from);
        let at = corners.into_iter().zip(weights).map(|(c, w)| w * c).sum::<DVec3>();
        assert!(at.distance(ray.at(hit.t).as_dvec3()) < 2e-6, "{at}");
        assert!(hit.smooth_normal.dot(hit.position.normalize()) > 0.98);
        let on = Ray::new(hit.ray_origin(hit.normal), hit.normal);
        assert_eq!(scene.closest_hit(&on, f32::INFINITY), None);
    }
}

#[test]
fn hair_and_head_hide_each_other() {
    let mut strands = Strands::new();
    strands.push(&[Vec3::new(-0.05, -0.12, 0.0), Vec3::new(0.05, -0.12, 0.0)], &[5e-5; 2]);
    let head = ball(0.1);
    let scene = scene(&strands, Some(&head));
    let from = |y, z| Ray::new(Vec3::new(0.0, y, z), -y * Vec3::Y);
    assert!(matches!(scene.closest_hit(&from(-1.0, 0.0), 9.0), Some(Hit::Hair(_))));
    assert!(matches!(scene.closest_hit(&from(-1.0, 1e-3), 9.0), Some(Hit::Skin(_))));
    assert!(matches!(scene.closest_hit(&from(1.0, 0.0), 9.0), Some(Hit::Skin(_))));
    assert!(scene.closest_hit(&from(-1.0, 0.0), 0.85).is_none());
    let (low, high) = scene.bounds().unwrap();
    assert!(low.y < -0.12 && low.y > -0.1205 && high.y > 0.0999 && high.y < 0.101);
}

#[test]
fn nothing_is_met_where_nothing_is() {
    let empty = scene(&Strands::new(), None);
    assert_eq!(empty.bounds(), None);
    let ray = Ray::new(Vec3::Y, -Vec3::Y);
    assert!(empty.closest_hit(&ray, f32::INFINITY).is_none() && !empty.occluded(&ray, 1.0));
    // A lone point is no strand.
    let mut strands = Strands::new();
    strands.push(&[Vec3::ZERO], &[1e-3]);
    assert!(scene(&strands, None).closest_hit(&ray, f32::INFINITY).is_none());
    // And no ray is no ray.
    let tangle = scene(&tangle(9, 9, 0.006, 1e-3), Some(&ball(0.02)));
    for (from, towards) in [
        (Vec3::NAN, Vec3::X),
        (Vec3::ZERO, Vec3::ZERO),
        (Vec3::ZERO, Vec3::NAN),
        (Vec3::splat(f32::INFINITY), Vec3::X),
    ] {
        assert!(tangle.closest_hit(&Ray::new(from, towards), f32::INFINITY).is_none());
        assert!(!tangle.occluded(&Ray::new(from, towards), f32::INFINITY));
    }
    assert!(tangle.closest_hit(&Ray::new(Vec3::ZERO, Vec3::X), f32::NAN).is_none());
    assert!(!tangle.occluded(&Ray::new(Vec3::ZERO, Vec3::X), -1.0));
}

#[test]
fn what_cannot_be_traced_is_refused_by_strand_and_point() {
    let good = [Vec3::ZERO, 0.01 * Vec3::X, 0.02 * Vec3::X];
    let with = |points: &[Vec3; 3], radii: &[f32; 3]| {
        let mut strands = Strands::new();
        strands.push(&good, &[1e-4; 3]);
        strands.push(points, radii);
        SceneBvh::new(&strands, None, &CurveOptions::default()).map(|_| ()).unwrap_err()
    };
    for bad in [f32::NAN, f32::INFINITY, 1e4] {
        let error = with(&[Vec3::ZERO, Vec3::X * bad, Vec3::Y], &[1e-4; 3]);
        assert!(matches!(error, AccelError::Position { strand: 1, point: 1, .. }));
    }
    for bad in [f32::NAN, 0.0, -1e-4, 1.0] {
        let error = with(&good, &[1e-4, 1e-4, bad]);
        assert!(matches!(error, AccelError::Radius { strand: 1, point: 2, .. }));
    }
    let error = with(&[Vec3::ZERO, Vec3::X, Vec3::NAN], &[1e-4; 3]);
    assert!(error.to_string().contains("point 2 of strand 1"));
    for bad in [0.0, f32::NAN, -1.0] {
        let options = CurveOptions { tolerance: bad, ..CurveOptions::default() };
        let error = SceneBvh::new(&Strands::new(), None, &options).unwrap_err();
        assert!(matches!(error, AccelError::Option { option: "tolerance", .. }));
    }
}

#[test]
fn a_thousand_hairs_in_one_place_are_still_found() {
    let mut strands = Strands::new();
    for _ in 0..1000 {
        strands.push(&[Vec3::ZERO, 0.002 * Vec3::X], &[5e-5; 2]);
    }
    let ray = Ray::new(Vec3::new(0.001, -0.1, 0.0), Vec3::Y);
    let hit = meet(scene(&strands, None).closest_hit(&ray, f32::INFINITY));
    assert!((hit.t - (0.1 - 5e-5)).abs() < 1e-7);
}

#[test]
fn points_that_coincide_change_next_to_nothing() {
    let along = |xs: &[f32]| {
        let mut strands = Strands::new();
        let points: Vec<Vec3> = xs.iter().map(|x| 0.01 * x * Vec3::X).collect();
        strands.push(&points, &vec![1e-4; xs.len()]);
        SceneBvh::new(&strands, None, &CurveOptions::default()).unwrap()
    };
    let plain = along(&[0.0, 1.0, 2.0, 3.0]);
    for twice in [
        &[0.0, 0.0, 1.0, 2.0, 3.0][..],
        &[0.0, 1.0, 1.0, 1.0, 2.0, 3.0],
        &[0.0, 1.0, 2.0, 3.0, 3.0],
    ] {
        let scene = along(twice);
        for i in 0..100_u8 {
            let x = 0.03 * (f32::from(i) + 0.5) / 100.0;
            let ray = Ray::new(Vec3::new(x, 3e-5, 0.1), -Vec3::Z);
            let t = |scene: &SceneBvh| scene.closest_hit(&ray, 1.0).map(|hit| hit.t());
            let (a, b) = (t(&plain).unwrap(), t(&scene).unwrap());
            assert!((a - b).abs() < 1e-6, "{x}: {a} {b}");
        }
    }
    // All in one place: nowhere.
    let nothing = along(&[1.0, 1.0, 1.0]);
    assert!(nothing.closest_hit(&Ray::new(Vec3::new(0.01, 0.0, 0.1), -Vec3::Z), 1.0).is_none());
}
