//! Synthetic fibres, measured with noise.

#![allow(dead_code, reason = "each test uses some of it")]

use frisure_fit::{Fibre, Pose};
use frisure_rod::batch::Batch;
use frisure_rod::{
    Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, SplitMix64, TorsionConstant,
};
use glam::{DQuat, DVec3};

/// Elements of the rods that stand for the truth: three times those of a fit or more.
pub(crate) const TRUE_ELEMENTS: usize = 160;

/// A standard normal number.
pub(crate) fn normal(random: &mut SplitMix64) -> f64 {
    // Box and Muller.
    let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.unit()).cos()
}

/// The numbers of a fibre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Truth {
    pub(crate) length: f64,
    pub(crate) radius: f64,
    pub(crate) pitch: f64,
    /// EI/(ρSg) (m³) and GJ/EI.
    pub(crate) stiffness: f64,
    pub(crate) ratio: f64,
    /// Bending stiffness across the natural curl over that along it, its root.
    pub(crate) axis_ratio: f64,
}

impl Truth {
    /// Curly hair of any hand: 6 to 18 cm, one to eight turns.
    pub(crate) fn random(random: &mut SplitMix64) -> Self {
        let hand = if random.unit() < 0.5 { -1.0 } else { 1.0 };
        Self {
            length: random.between(0.06, 0.18),
            radius: random.decades(0.003, 0.015),
            pitch: hand * random.decades(0.006, 0.05),
            stiffness: random.decades(3e-5, 3e-4),
            ratio: (0.46_f64.ln() + 0.3 * normal(random)).exp(),
            axis_ratio: 1.0,
        }
    }

    /// The same of any section that hair has, with the torsional stiffness of an ellipse.
    pub(crate) fn elliptical(random: &mut SplitMix64) -> Self {
        let round = Self::random(random);
        let axis_ratio = (1.25_f64.ln() + 0.2 * normal(random)).exp();
        // 2 r²/(1 + r²) with r = 1.25.
        Self { ratio: round.ratio * 1.2195, axis_ratio, ..round }
    }

    pub(crate) fn curvature(&self) -> f64 {
        let p = self.pitch / std::f64::consts::TAU;
        self.radius / (self.radius * self.radius + p * p)
    }

    pub(crate) fn torsion(&self) -> f64 {
        let p = self.pitch / std::f64::consts::TAU;
        p / (self.radius * self.radius + p * p)
    }

    /// The rod, in gravity along −z times `gravity`.
    pub(crate) fn rod(&self, tangent: DVec3, d1: DVec3, gravity: f64) -> Rod {
        let root = self.axis_ratio.sqrt();
        let section = Section::from_semi_axes(35e-6 * root, 35e-6 / root).unwrap();
        let weight = 1300.0 * section.area() * 9.81;
        let young = self.stiffness * weight / section.i1();
        let shear = self.ratio * self.stiffness * weight / section.j(TorsionConstant::SaintVenant);
        Rod::new(RodSpec {
            length: self.length,
            section,
            material: Material::new(young, shear, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(self.radius, self.pitch).unwrap(),
            root: Root::from_tangent(DVec3::new(0.01, -0.02, 0.03), tangent, d1).unwrap(),
            load: Load::down(9.81 * gravity),
        })
        .unwrap()
    }
}

/// Any way to clamp a fibre: sideways, and somewhat up or down.
pub(crate) fn clamp(random: &mut SplitMix64) -> (DVec3, DVec3) {
    let tangent = random.direction() * DVec3::new(1.0, 1.0, 0.6);
    (tangent, random.direction())
}

/// Every fourth node of rods at rest (m), 41 of each.
pub(crate) fn lines(rods: &[Rod]) -> Vec<Vec<DVec3>> {
    let batch = Batch { elements: TRUE_ELEMENTS, tolerance: 1e-9, ..Batch::default() };
    let found = batch.solve(rods);
    let nodes =
        |(i, rod): (usize, &Rod)| found.shape(rod, i).positions.into_iter().step_by(4).collect();
    rods.iter().enumerate().map(nodes).collect()
}

/// With noise in each coordinate (m).
pub(crate) fn noisy(line: &[DVec3], noise: f64, random: &mut SplitMix64) -> Vec<DVec3> {
    let mut one = || noise * normal(random);
    line.iter().map(|x| *x + DVec3::new(one(), one(), one())).collect()
}

/// The arc lengths of evenly spaced points (m).
pub(crate) fn even(length: f64, points: usize) -> Vec<f64> {
    (0..points).map(|i| length * i as f64 / (points - 1) as f64).collect()
}

/// Fibres of some numbers seen once each, with their arc lengths or without.
pub(crate) fn seen_once(
    truths: &[Truth],
    noise: f64,
    placed: bool,
    random: &mut SplitMix64,
) -> Vec<Fibre> {
    let rods: Vec<Rod> = truths
        .iter()
        .map(|truth| {
            let (tangent, d1) = clamp(random);
            truth.rod(tangent, d1, 1.0)
        })
        .collect();
    let pose = |(truth, line): (&Truth, Vec<DVec3>)| {
        let points = noisy(&line, noise, random);
        let arc = placed.then(|| even(truth.length, points.len()));
        let pose = Pose::new(points, arc, DVec3::NEG_Z * 9.81, 0).unwrap();
        Fibre::new(vec![pose], None).unwrap()
    };
    truths.iter().zip(lines(&rods)).map(pose).collect()
}

/// Fibres of some numbers seen as clamped, and turned upside down.
pub(crate) fn seen_twice(truths: &[Truth], noise: f64, random: &mut SplitMix64) -> Vec<Fibre> {
    let turn = DQuat::from_rotation_x(2.8);
    let rods: Vec<Rod> = truths
        .iter()
        .flat_map(|truth| {
            let (tangent, d1) = clamp(random);
            [truth.rod(tangent, d1, 1.0), truth.rod(turn * tangent, turn * d1, 1.0)]
        })
        .collect();
    let lines = lines(&rods);
    let fibre = |(truth, pair): (&Truth, &[Vec<DVec3>])| {
        let poses = pair.iter().map(|line| {
            let points = noisy(line, noise, random);
            let arc = even(truth.length, points.len());
            Pose::new(points, Some(arc), DVec3::NEG_Z * 9.81, 0).unwrap()
        });
        Fibre::new(poses.collect(), None).unwrap()
    };
    truths.iter().zip(lines.chunks_exact(2)).map(fibre).collect()
}
