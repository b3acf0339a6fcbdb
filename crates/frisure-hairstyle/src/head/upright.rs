//! Whether the mesh of a head stands upright with its face to −y, and how it would have to be turned.

use std::f64::consts::{PI, TAU};

use frisure_strands::Surface;
use glam::{DMat3, DVec3, EulerRot};

use super::distance::SignedDistance;
use super::guess::Cranium;
use crate::parallel;

/// Mean distance (m at the size of the mannequin) from the skin of an average head, beyond which a mesh is looked at from other sides.
/// Measured: an upright head of a person 0.0024, one that lies on its side or back 0.016 to 0.023; wrong turns near which none is better
/// have 0.0045 and more, a ball 0.012.
const UNLIKE: f64 = 0.006;

/// The same of a mesh that is surely a human head once it is turned.
const ALIKE: f64 = 0.005;

/// Farther points count as much as one so far away (m at the size of the mannequin): a hat or a missing ear decides nothing.
const FAR: f64 = 0.03;

/// Smallest angle (rad) by which a head lies. Chosen: people nod by as much when they sit still.
const LIES: f64 = 30.0 * PI / 180.0;

/// Smallest angle (rad) between the vertical and that of a head that leans. Chosen: as they are measured here heads that stand differ from each
/// other by up to 4 degrees, and of one that is tilted by 8 hair grew on an eighth of the scalp's area where none is.
const LEANS: f64 = 7.0 * PI / 180.0;

/// Smallest angle (rad) by which a face is turned aside. Chosen: above the 6 degrees that are measured of symmetric heads.
const TURNED: f64 = 10.0 * PI / 180.0;

/// How far (rad) the mannequin's head is bent back against an average one. Measured: the mean of the built-in people and of
/// `scenes/heads/female-head.obj`, which are from 1 to 7 degrees.
const BENT_BACK: f64 = 5.0 * PI / 180.0;

/// How a mesh stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stance {
    /// Upright with its face to −y, as far as can be told; also what is not like a human head from any side.
    Upright,
    /// A head whose vertical leans by 7 degrees or more, or whose face is turned aside by 10; with the rotation that stands it upright.
    Leans(DMat3),
    /// A head that lies otherwise by 30 degrees or more; with the rotation that stands it upright.
    Lies(DMat3),
}

/// Distance of neighbouring turns that are tried (rad): the best is within half of it, where the distance above is still half as large
/// as of a wrong turn.
const STEP: f64 = 20.0 * PI / 180.0;

/// Finest step of the search (rad).
const FINEST: f64 = 1.0 * PI / 180.0;

/// Most vertices that measure a head in the search.
const MOST_VERTICES: usize = 2000;

/// The best coarse turns that are refined.
const REFINED: usize = 6;

/// How a head stands, and the rotation that would stand it upright, its face towards −y.
///
/// A mesh is compared with points on the skin of the mannequin's head, brought to its place and size by the measures that
/// landmarks are guessed from.
pub(super) fn stance(surface: &Surface, skin: &SignedDistance) -> Stance {
    let vertices = surface.positions();
    let stride = vertices.len().div_ceil(MOST_VERTICES);
    let sparse: Vec<DVec3> = vertices.iter().step_by(stride).copied().collect();
    let unlike = |turn: &DMat3| unlikeness(&sparse, skin, turn);
    let as_it_is = unlike(&DMat3::IDENTITY);
    let near = refine(&unlike, as_it_is, DMat3::IDENTITY);
    let (value, turn) = if as_it_is <= UNLIKE {
        near
    } else {
        let mut coarse = parallel::map_slice(&turns(), |turn| (unlike(turn), *turn));
        // A stable sort: of equal turns the first, on any number of threads.
        coarse.sort_by(|a, b| a.0.total_cmp(&b.0));
        let refined = coarse[..REFINED].iter().map(|&(value, turn)| refine(&unlike, value, turn));
        refined.fold(near, |best, other| if other.0 < best.0 { other } else { best })
    };
    // From the mannequin's bearing to that of an average head.
    let turn = DMat3::from_rotation_x(-BENT_BACK) * turn;
    if value > ALIKE {
        return Stance::Upright;
    }
    if angle(&turn) >= LIES && as_it_is > UNLIKE {
        return Stance::Lies(turn);
    }
    // About the vertical after the vertical is upright: a face that is hardly turned looks ahead.
    let (aside, left, forward) = turn.to_euler(EulerRot::ZYX);
    let ahead = DMat3::from_rotation_y(left) * DMat3::from_rotation_x(forward);
    match aside.abs() >= TURNED {
        true => Stance::Leans(turn),
        false if angle(&ahead) >= LEANS => Stance::Leans(ahead),
        false => Stance::Upright,
    }
}

/// The angle of a rotation (rad), from its trace.
fn angle(turn: &DMat3) -> f64 {
    let trace = turn.x_axis.x + turn.y_axis.y + turn.z_axis.z;
    (0.5 * (trace - 1.0)).clamp(-1.0, 1.0).acos()
}

/// Mean distance of the mannequin's skin from that of a turned head (m at the size of the mannequin).
fn unlikeness(vertices: &[DVec3], skin: &SignedDistance, turn: &DMat3) -> f64 {
    let turned: Vec<DVec3> = vertices.iter().map(|p| *turn * *p).collect();
    let (centre, scale) = Cranium::place(&turned);
    let back = turn.transpose();
    let distance = |p: &[i8; 3]| {
        let p = DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])) * 1e-3;
        (skin.value(back * (centre + p * scale)).abs() / scale).min(FAR)
    };
    SKIN.iter().map(distance).sum::<f64>() / SKIN.len() as f64
}

/// Turns all over, [`STEP`] apart.
fn turns() -> Vec<DMat3> {
    // As many directions of the vertical as there are patches of that width, on a spiral of the golden angle.
    let count = (2.0 * TAU / (STEP * STEP)).ceil() as usize;
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    let spins = (TAU / STEP).round() as usize;
    let mut turns = Vec::with_capacity(count * spins);
    for i in 0..count {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let up = DVec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z;
        let (a, b) = up.any_orthonormal_pair();
        for k in 0..spins {
            let (sin, cos) = (k as f64 * TAU / spins as f64).sin_cos();
            let left = a * cos + b * sin;
            // Rows: what becomes x, y and z.
            turns.push(DMat3::from_cols(left, up.cross(left), up).transpose());
        }
    }
    turns
}

/// Descends in turns about the three axes, with steps that are halved.
fn refine(unlike: &impl Fn(&DMat3) -> f64, mut best: f64, mut turn: DMat3) -> (f64, DMat3) {
    let mut step = 0.5 * STEP;
    while step >= FINEST {
        let mut better = false;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            for angle in [step, -step] {
                let tried = DMat3::from_axis_angle(axis, angle) * turn;
                let value = unlike(&tried);
                if value < best {
                    (best, turn, better) = (value, tried, true);
                }
            }
        }
        if !better {
            step *= 0.5;
        }
    }
    (best, turn)
}

/// Points (mm) on the skin of the mannequin's head above the neck, as far from each other as they can be, from the centre and at
/// the size that [`Cranium::place`] finds there. A test holds them to the mannequin.
#[rustfmt::skip]
const SKIN: [[i8; 3]; 160] = [
    [1, 3, 108], [-2, -91, -97], [-1, 72, -48], [64, -31, -1], [-65, -29, 0], [53, 68, 42], [-54, 66, 44], [-1, -86, 58],
    [40, -3, -93], [-49, -14, -87], [3, -104, -19], [52, -35, 71], [-52, -33, 72], [58, 37, -25], [-59, 39, -22], [50, -65,
    -60], [1, 67, 86], [-44, 54, -96], [-47, -70, -50], [-1, 95, 15], [40, 62, -96], [52, 23, 82], [-41, -80, 14], [-48, 24,
    86], [40, -80, 19], [74, 16, 30], [-73, 14, 37], [4, -50, 97], [62, -9, -47], [39, 78, -5], [-39, -61, -96], [-63, -6,
    -42], [-42, 77, -1], [-4, 73, -95], [16, -90, -58], [-46, 29, -62], [45, 30, -66], [17, 88, 53], [-41, -69, 55], [44,
    -46, -97], [37, -77, -23], [-4, -95, 19], [60, -48, 34], [78, 4, -11], [36, -71, 59], [-22, 84, 57], [67, 49, 11], [38,
    59, 78], [-69, 45, 14], [-75, 8, -3], [33, -14, 97], [-33, -11, 97], [-62, -42, 37], [-17, 38, 101], [34, 59, -44],
    [-26, -81, -21], [-38, 59, 78], [-34, 64, -34], [22, 33, 101], [-20, -89, -66], [65, -2, 61], [-55, -59, -17], [-58,
    -40, -64], [-11, 85, -17], [61, -43, -35], [29, -77, -88], [-28, 69, -70], [-29, -52, 86], [64, 39, 56], [-44, 17, -97],
    [-63, 0, 66], [70, -16, 30], [-63, 38, 58], [57, -33, -70], [21, 72, -73], [30, 89, 24], [-32, 88, 27], [54, -60, -2],
    [45, 27, -97], [18, -85, 0], [-5, -108, -48], [68, 20, -49], [17, 79, -26], [-61, -34, -33], [29, -56, 83], [-69, 22,
    -44], [-71, -16, 26], [-24, -87, 38], [-9, -24, 105], [-57, -55, 12], [18, -89, 36], [-6, -70, 81], [-51, 3, -65], [49,
    4, -68], [53, 71, 17], [74, 24, 5], [-27, 14, 102], [66, -17, -23], [40, 54, -72], [-56, 68, 19], [51, -2, 83], [-65,
    -22, 52], [-58, 58, -5], [56, 59, -10], [34, 11, 98], [17, 90, -2], [-40, -73, -74], [-5, 93, 41], [-51, -39, -88],
    [-67, -13, -19], [16, -86, -33], [64, -27, 51], [-23, -80, -91], [73, 0, 12], [-77, 7, -28], [-20, -87, 3], [-17, -87,
    -42], [-44, 43, -43], [24, -36, 97], [54, -66, -35], [34, -79, -47], [16, -75, 72], [-51, -64, 34], [22, 75, 73], [-22,
    90, 5], [-27, 72, -95], [-41, 50, -72], [-51, -11, 82], [45, 38, -45], [66, 51, 34], [51, -55, 55], [-71, 30, -4], [-4,
    74, -72], [19, 54, 92], [-53, -50, 57], [1, -96, -74], [-67, 46, 37], [-22, -77, 65], [19, 73, -95], [-44, -76, -8],
    [49, -24, -92], [-20, 72, 78], [47, -68, 38], [-2, 83, 67], [37, 77, 57], [12, -16, 106], [69, 17, 52], [69, 17, -27],
    [-38, -31, 89], [40, 67, -24], [47, -61, -81], [-59, -18, -65], [-59, -54, -41], [53, 58, 61], [-74, 19, 15], [2, 27,
    106], [40, 40, 88], [-52, 43, 75], [54, -61, 19], [-42, 70, 61],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::{ball, mannequin, read_obj};
    use crate::head::{Head, ScalpSource};

    /// A surface turned by a rotation.
    fn turned(surface: &Surface, turn: DMat3) -> Surface {
        let positions = surface.positions().iter().map(|p| turn * *p).collect();
        Surface::new(positions, surface.triangles().to_vec()).unwrap()
    }

    fn found(surface: &Surface) -> Stance {
        stance(surface, &SignedDistance::new(surface))
    }

    fn a_person() -> Surface {
        read_obj(include_str!("../../../../scenes/heads/female-head.obj"))
    }

    #[test]
    fn the_points_are_on_the_mannequins_skin() {
        let head = mannequin();
        let (centre, scale) = Cranium::place(head.surface().positions());
        for [x, y, z] in SKIN.map(|p| p.map(|x| f64::from(x) * 1e-3)) {
            let p = centre + DVec3::new(x, y, z) * scale;
            assert!(head.signed_distance().value(p).abs() < 2.5e-3, "{p}");
        }
    }

    #[test]
    fn heads_that_stand_are_left_alone() {
        for name in Head::names() {
            assert_eq!(found(Head::named(name).unwrap().surface()), Stance::Upright, "{name}");
        }
        for nod in [0.0, 4.0_f64, -4.0] {
            let nods = DMat3::from_rotation_x(nod.to_radians());
            assert_eq!(found(&turned(&a_person(), nods)), Stance::Upright, "{nod}");
        }
    }

    #[test]
    fn heads_that_lean_either_way_are_told_the_turn_that_stands_them_up() {
        for (x, y) in [(20.0, 0.0), (-20.0, 0.0), (25.0, 0.0), (-25.0, 0.0), (0.0, 20.0_f64)] {
            let turn = DMat3::from_rotation_y(f64::to_radians(y))
                * DMat3::from_rotation_x(f64::to_radians(x));
            let Stance::Leans(back) = found(&turned(&a_person(), turn)) else {
                panic!("{x} {y}: {:?}", found(&turned(&a_person(), turn)));
            };
            let off = angle(&(back * turn)).to_degrees();
            assert!(off < 12.0, "{x} {y}: {off}");
        }
        for x in [40.0, -40.0_f64] {
            let nods = DMat3::from_rotation_x(x.to_radians());
            assert!(matches!(found(&turned(&a_person(), nods)), Stance::Lies(_)), "{x}");
        }
    }

    /// By area: how much of the scalp another has that this one has not.
    fn beyond(surface: &Surface, scalp: &[f64], other: &[f64]) -> f64 {
        let share = |weight: &dyn Fn(usize) -> f64| -> f64 {
            let corners =
                |f: usize| surface.triangles()[f].map(|v| weight(v as usize)).iter().sum::<f64>();
            let faces = 0..surface.triangles().len();
            faces.map(|f| surface.doubled_area_vector(f).length() * corners(f)).sum()
        };
        share(&|v| (other[v] - scalp[v]).max(0.0)) / share(&|v| scalp[v])
    }

    #[test]
    fn the_scalp_of_a_head_leans_with_it() {
        let stands = Head::from_surface(a_person(), ScalpSource::Guess).unwrap();
        for (x, y) in [(8.0, 0.0), (14.0, 0.0), (-14.0, 0.0), (25.0, 0.0), (0.0, 12.0), (70.0, 0.0)]
        {
            let turn = DMat3::from_rotation_y(f64::to_radians(y))
                * DMat3::from_rotation_x(f64::to_radians(x));
            let leans = Head::from_surface(turned(&a_person(), turn), ScalpSource::Guess).unwrap();
            let beyond = beyond(stands.surface(), stands.scalp(), leans.scalp());
            // Taken as upright, 0.10 with 8 degrees and 0.18 with 14.
            assert!(beyond < 0.04, "{x} {y}: {beyond}");
            let off = leans.landmarks().brow.distance(turn * stands.landmarks().brow);
            assert!(off < 0.012, "{x} {y}: {off}");
        }
    }

    #[test]
    fn heads_that_lie_are_turned_back() {
        for (x, y, z) in
            [(70.0, 0.0, 0.0), (-90.0, 0.0, 0.0), (0.0, 0.0, 180.0), (40.0, 50.0, -60.0)]
        {
            let (x, y, z) = (f64::to_radians(x), f64::to_radians(y), f64::to_radians(z));
            let turn =
                DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
            let Stance::Lies(back) = found(&turned(&a_person(), turn)) else {
                panic!("{x} {y} {z}: it stands");
            };
            // People hold their heads differently: within 12 degrees of how the mesh was made.
            let off = angle(&(back * turn)).to_degrees();
            assert!(off < 12.0, "{x} {y} {z}: {off}");
        }
    }

    #[test]
    fn what_is_no_head_is_not_turned() {
        assert_eq!(found(&ball(0.1, 24)), Stance::Upright);
    }
}
