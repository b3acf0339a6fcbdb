//! What pieces of constant strain leave out of a natural strain that varies within them.
//!
//! An element sees the mean strain of each of its halves. Divisions whose pieces all leave out a whole number of waves agree with each
//! other, and with none of the waves: their agreement says nothing of the fibre. docs/theory.md, "Extrapolation, accuracy and the estimate
//! of error"

use glam::{DQuat, DVec3};

use crate::rod::Rod;
use crate::strain::{NaturalStrain, StrainProfile};

/// Standard deviations of a sum of independent terms that count. Chosen.
const DEVIATIONS: f64 = 3.0;

/// How far (rad) the load turns a hair in all: from upright to hanging.
const TURN_BY_LOAD: f64 = std::f64::consts::PI;

/// What a piece leaves out: w is its turn (rad) from its beginning on beyond that by its mean strain ū, and u its strain; in the axes of the section.
#[derive(Clone, Copy, Debug, Default)]
struct LeftOut {
    /// ∫w ds (rad m). The part across the tangent displaces its end.
    turned: DVec3,
    /// Shortening ½∫|w|² ds (m), by the same part.
    shortening: f64,
    /// Turn ½∫ w × (u + ū) ds (rad) that is left at its end, because turns about different axes do not commute: to second order.
    turn: DVec3,
}

/// An estimate (m) of how far the line of a fibre is from one that is extrapolated from divisions into pieces of
/// the length `piece` and half of it, because the natural strain varies within pieces; from the root on.
///
/// Where the strain is smooth within a piece, halves of it leave out a quarter of offset and turn and a sixteenth of the shortening, and extrapolation takes
/// these away. What is left of a piece is 4/3 of what its halves leave out beyond a quarter, and 16/15 beyond a sixteenth. The lever of a turn is at most the length.
///
/// A section that is turned by w takes the moment of the load in other directions: with stiffnesses that differ the load bends it otherwise, by w times that
/// bend and their relative difference.
pub(crate) fn unresolved(rod: &Rod, piece: f64) -> f64 {
    let NaturalStrain::Varying(profile) = rod.natural() else { return 0.0 };
    let length = rod.length();
    let pieces = (length / piece).round().max(1.0) as usize;
    let mut next = profile.knots().partition_point(|knot| knot.0 <= 0.0);
    let [mut offsets, mut twists, mut turns] = [Sum::default(); 3];
    let mut shortening = 0.0;
    // The section turns with the natural curl: what adds up in its axes may cancel in space, and the other way.
    let mut section = DQuat::IDENTITY;
    for k in 0..pieces {
        let [from, middle, to] = [0.0, 0.5, 1.0].map(|share| piece * (k as f64 + share));
        let mut again = next;
        let whole = left_out(profile, [from, to], &mut next);
        let halves = [[from, middle], [middle, to]].map(|half| left_out(profile, half, &mut again));
        let [turned, turn] = [
            halves[0].turned + halves[1].turned - whole.turned * 0.25,
            halves[0].turn + halves[1].turn - whole.turn * 0.25,
        ];
        offsets.add(turned.with_z(0.0) * (4.0 / 3.0), section);
        twists.add(turned.with_x(0.0).with_y(0.0) * (4.0 / 3.0), section);
        turns.add(turn * (4.0 / 3.0), section);
        let beyond = halves[0].shortening + halves[1].shortening - whole.shortening / 16.0;
        shortening += beyond.max(0.0) * (16.0 / 15.0);
        let turned = profile.integral(to) - profile.integral(from);
        section = (section * DQuat::from_scaled_axis(turned)).normalize();
    }
    // Bending along d1 and d2, and twist.
    let stiffness = rod.stiffness();
    let (soft, hard) = (stiffness.x.min(stiffness.y), stiffness.x.max(stiffness.y));
    let by_tilt = TURN_BY_LOAD * (hard / stiffness.z - 1.0).abs();
    let by_twist = TURN_BY_LOAD * (1.0 - soft / hard);
    offsets.size() * (1.0 + by_tilt) + twists.size() * by_twist + shortening + length * turns.size()
}

/// What the piece from one arc length (m) to another leaves out; `next` is the first knot behind its beginning, and then behind its end.
fn left_out(profile: &StrainProfile, [from, to]: [f64; 2], next: &mut usize) -> LeftOut {
    let knots = profile.knots();
    let before = profile.integral(from);
    let mean = (profile.integral(to) - before) / (to - from);
    let mut all = LeftOut::default();
    let mut begin = from;
    while begin < to {
        let knot = knots.get(*next).map_or(f64::INFINITY, |knot| knot.0);
        let end = knot.min(to);
        // Between knots w is quadratic: three points of Gauss integrate |w|² exactly.
        for (place, weight) in GAUSS {
            let s = begin + (end - begin) * place;
            let share = (end - begin) * weight;
            let w = profile.integral(s) - before - mean * (s - from);
            all.turned += w * share;
            all.turn += w.cross(profile.at(s) + mean) * (0.5 * share);
            all.shortening += 0.5 * w.with_z(0.0).length_squared() * share;
        }
        if knot <= to {
            *next += 1;
        }
        begin = end;
    }
    all
}

/// Places and weights of the three points of Gauss on an interval from 0 to 1.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// A sum of vectors that may be alike, in the axes of the section or in space, or independent.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    in_section: DVec3,
    in_space: DVec3,
    squares: f64,
}

impl Sum {
    fn add(&mut self, term: DVec3, section: DQuat) {
        self.in_section += term;
        self.in_space += section * term;
        self.squares += term.length_squared();
    }

    fn size(&self) -> f64 {
        let independent = DEVIATIONS * self.squares.sqrt();
        self.in_section.length().max(self.in_space.length()).max(independent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Load, Material, RodSpec, Root, Section, TorsionConstant};

    /// What is left out of a strain in a fibre of 10 cm, with the stiffnesses of hair.
    fn told(natural: &NaturalStrain, piece: f64) -> f64 {
        flat(natural, piece, 1.5)
    }

    /// The same, of a section with an axis ratio.
    fn flat(natural: &NaturalStrain, piece: f64, axis_ratio: f64) -> f64 {
        let rod = Rod::new(RodSpec {
            length: 0.1,
            section: Section::from_diameter(70e-6, axis_ratio).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: natural.clone(),
            root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap(),
            load: Load::down(9.81),
        });
        unresolved(&rod.unwrap(), piece)
    }

    /// A planar zigzag of so many waves, of ±`most` (rad/m), in a fibre of 10 cm.
    fn zigzag(waves: usize, most: f64) -> NaturalStrain {
        let knots = (0..=2 * waves).map(|k| {
            let strain = if k % 2 == 0 { most } else { -most };
            (0.1 * k as f64 / (2 * waves) as f64, DVec3::X * strain)
        });
        NaturalStrain::Varying(StrainProfile::new(knots.collect()).unwrap())
    }

    #[test]
    fn waves_within_pieces_are_told_until_pieces_resolve_them() {
        let strain = zigzag(512, 1148.0);
        // Shortened by ½ θ² in the mean: θ is a parabola between its largest and its smallest, m Δ/4 apart, Δ a half of a wave.
        let amplitude = 1148.0 * 0.1 / 1024.0 / 4.0;
        let shortening = 0.5 * amplitude * amplitude * (8.0 / 15.0) * 0.1;
        for pieces in [64.0, 128.0, 256.0, 512.0] {
            let told = told(&strain, 0.1 / pieces);
            assert!(told > 0.9 * shortening && told < 100.0 * shortening, "{pieces}: {told}");
        }
        // Pieces that end at knots leave out what extrapolation takes away.
        for pieces in [2048.0, 4096.0] {
            let told = told(&strain, 0.1 / pieces);
            assert!(told < 1e-3 * shortening, "{pieces}: {told}");
        }
    }

    /// A small crimp on a curl that varies smoothly, in waves that pieces hold whole.
    #[test]
    fn a_crimp_is_told_beside_what_is_smooth() {
        let waves = 256;
        let knots = (0..=8 * waves).map(|k| {
            let s = 0.1 * f64::from(k) / f64::from(8 * waves);
            let crimp = 30.0 * (std::f64::consts::TAU * f64::from(k) / 8.0).sin();
            (s, DVec3::new(40.0 + 80.0 * (40.0 * s).sin() + crimp, 0.0, 20.0))
        });
        let strain = NaturalStrain::Varying(StrainProfile::new(knots.collect()).unwrap());
        // Tilted by A/k in the mean, times the length.
        let tilt = 30.0 * (0.1 / 256.0) / std::f64::consts::TAU;
        for pieces in [64.0, 128.0] {
            let told = told(&strain, 0.1 / pieces);
            assert!(told > 0.5 * tilt * 0.1, "{pieces}: {told} {tilt}");
        }
    }

    /// A twist that goes to and fro turns the section where the load bends it, which a round section does not feel.
    #[test]
    fn waves_of_twist_are_told_of_sections_that_are_not_round() {
        let waves = 768;
        let knots = (0..=8 * waves).map(|k| {
            let s = 0.1 * f64::from(k) / f64::from(8 * waves);
            (s, DVec3::Z * (12.0 * (std::f64::consts::TAU * f64::from(k) / 8.0).sin()))
        });
        let strain = NaturalStrain::Varying(StrainProfile::new(knots.collect()).unwrap());
        // Turned by A/k in the mean, times the length.
        let turn = 12.0 * (0.1 / 768.0) / std::f64::consts::TAU;
        for pieces in [96.0, 192.0, 384.0] {
            let [round, flat] = [1.0, 1.2].map(|ratio| flat(&strain, 0.1 / pieces, ratio));
            assert!(round < 1e-6 * flat && flat > 0.5 * turn * 0.1, "{pieces}: {round} {flat}");
        }
    }

    #[test]
    fn what_is_smooth_within_pieces_is_left_to_extrapolation() {
        let knots = (0..=4000).map(|k| {
            let s = 0.1 * f64::from(k) / 4000.0;
            (s, DVec3::new(200.0 * (60.0 * s).sin(), 50.0 * (90.0 * s).cos(), 30.0))
        });
        let strain = NaturalStrain::Varying(StrainProfile::new(knots.collect()).unwrap());
        for pieces in [60.0, 120.0] {
            let [coarse, fine] = [pieces, 2.0 * pieces].map(|n| told(&strain, 0.1 / n));
            assert!(coarse < 1e-4 && fine < 0.15 * coarse, "{pieces}: {coarse} {fine}");
        }
        // As fine as the knots it has kinks.
        assert!(told(&strain, 0.1 / 240.0) < 1e-9);
        assert_eq!(told(&NaturalStrain::Uniform(DVec3::ONE), 0.01), 0.0);
    }
}
