//! The unknowns of a fibre: which there are, in which order, and the rods that they make.

use std::f64::consts::{PI, TAU};

use frisure_rod::batch::Direction;
use frisure_rod::{
    Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, StrainProfile, TorsionConstant,
};
use glam::{DMat3, DQuat, DVec3};

use crate::known::STANDARD_GRAVITY;
use crate::pose::{Fibre, Pose};

/// Diameter (m) and density (kg/m³) of the rods that stand for a fibre. Only EI/(ρSg) moves a rod, so that any would do.
const DIAMETER: f64 = 70e-6;
const DENSITY: f64 = 1300.0;

/// Unknowns of a pose: position of the root (m) and rotation of its frame (rad).
pub(crate) const OF_POSE: usize = 6;

/// Which unknowns a fibre has: curvatures and torsions at knots, the logarithms of EI/(ρSg) and of GJ/EI of each state, that of the larger over the
/// smaller bending stiffness, that of the length of each state, and those of each pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) knots: usize,
    pub(crate) states: usize,
    pub(crate) poses: usize,
}

impl Layout {
    pub(crate) fn of(fibre: &Fibre, knots: usize) -> Self {
        Self { knots, states: fibre.states(), poses: fibre.poses().len() }
    }

    pub(crate) fn curvature(self, knot: usize) -> usize {
        knot
    }

    pub(crate) fn torsion(self, knot: usize) -> usize {
        self.knots + knot
    }

    pub(crate) fn stiffness(self, state: usize) -> usize {
        2 * self.knots + state
    }

    pub(crate) fn ratio(self, state: usize) -> usize {
        2 * self.knots + self.states + state
    }

    pub(crate) fn section(self) -> usize {
        2 * (self.knots + self.states)
    }

    pub(crate) fn length(self, state: usize) -> usize {
        self.section() + 1 + state
    }

    /// How many unknowns all poses share.
    pub(crate) fn shared(self) -> usize {
        2 * self.knots + 3 * self.states + 1
    }

    /// The first unknown of a pose.
    pub(crate) fn pose(self, pose: usize) -> usize {
        self.shared() + OF_POSE * pose
    }

    pub(crate) fn len(self) -> usize {
        self.pose(self.poses)
    }
}

/// Values of the unknowns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unknowns {
    /// Natural curvature about d1 and torsion (rad/m) at each knot.
    pub(crate) strain: Vec<(f64, f64)>,
    /// ln EI/(ρSg) (m³) and ln GJ/EI of each state, with EI about d1.
    pub(crate) stiffness: Vec<f64>,
    pub(crate) ratio: Vec<f64>,
    /// The logarithm of the bending stiffness about d2 over that about d1; it is negative where noise makes it so.
    pub(crate) section: f64,
    /// ln L (m) of each state.
    pub(crate) length: Vec<f64>,
    /// Position of the root (m) and its frame, of each pose; z is up.
    pub(crate) roots: Vec<(DVec3, DMat3)>,
}

impl Unknowns {
    /// After a step.
    pub(crate) fn stepped(&self, layout: Layout, step: &[f64]) -> Self {
        let vector = |first: usize| DVec3::new(step[first], step[first + 1], step[first + 2]);
        let strain = |(k, (u1, u3)): (usize, &(f64, f64))| {
            (u1 + step[layout.curvature(k)], u3 + step[layout.torsion(k)])
        };
        let root = |(p, (position, frame)): (usize, &(DVec3, DMat3))| {
            let first = layout.pose(p);
            let turn = DQuat::from_scaled_axis(vector(first + 3));
            (*position + vector(first), DMat3::from_quat(turn) * *frame)
        };
        let states = |of: &[f64], first: usize| {
            of.iter().enumerate().map(|(i, x)| x + step[first + i]).collect()
        };
        Self {
            strain: self.strain.iter().enumerate().map(strain).collect(),
            stiffness: states(&self.stiffness, layout.stiffness(0)),
            ratio: states(&self.ratio, layout.ratio(0)),
            section: self.section + step[layout.section()],
            length: states(&self.length, layout.length(0)),
            roots: self.roots.iter().enumerate().map(root).collect(),
        }
    }

    /// The size in which each unknown is measured: a step of it changes the line by about its length.
    pub(crate) fn scale(&self, layout: Layout, unknown: usize) -> f64 {
        let length = self.length[0].exp();
        if unknown < layout.stiffness(0) {
            TAU / length
        } else if unknown < layout.shared() || (unknown - layout.shared()) % OF_POSE >= 3 {
            1.0
        } else {
            length
        }
    }

    /// The rod of a pose; `None` if the numbers make none. In the axes of the rod, gravity is along −z.
    pub(crate) fn rod(&self, pose: &Pose, index: usize) -> Option<Rod> {
        // I2/I1 = (a/b)².
        let root = (0.25 * self.section).exp();
        let section = Section::from_semi_axes(0.5 * DIAMETER * root, 0.5 * DIAMETER / root).ok()?;
        let torsion = TorsionConstant::SaintVenant;
        let bending =
            self.stiffness[pose.state()].exp() * DENSITY * section.area() * STANDARD_GRAVITY;
        let young = bending / section.i1();
        let shear = bending * self.ratio[pose.state()].exp() / section.j(torsion);
        let length = self.length[pose.state()].exp();
        let (position, frame) = self.roots[index];
        Rod::new(RodSpec {
            length,
            section,
            material: Material::new(young, shear, DENSITY).ok()?,
            torsion,
            natural: self.natural(length)?,
            root: Root::new(position, frame.x_axis, frame.y_axis, frame.z_axis).ok()?,
            load: Load::down(pose.gravity().length()),
        })
        .ok()
    }

    fn natural(&self, length: f64) -> Option<NaturalStrain> {
        let strain = |(u1, u3): (f64, f64)| DVec3::new(u1, 0.0, u3);
        if let [one] = self.strain.as_slice() {
            return strain(*one).is_finite().then(|| NaturalStrain::Uniform(strain(*one)));
        }
        let step = length / (self.strain.len() - 1) as f64;
        let knots = self.strain.iter().enumerate().map(|(k, u)| (step * k as f64, strain(*u)));
        StrainProfile::new(knots.collect()).ok().map(NaturalStrain::Varying)
    }

    /// Means over the knots: curvature and torsion (rad/m).
    pub(crate) fn mean_strain(&self) -> (f64, f64) {
        let count = self.strain.len() as f64;
        let sum = self.strain.iter().fold((0.0, 0.0), |(a, b), (u1, u3)| (a + u1, b + u3));
        (sum.0 / count, sum.1 / count)
    }

    /// With a curvature that is not negative: half a turn of the root's frame changes its sign.
    pub(crate) fn with_positive_curvature(mut self) -> Self {
        if self.mean_strain().0 < 0.0 {
            self.strain.iter_mut().for_each(|(u1, _)| *u1 = -*u1);
            let half = DMat3::from_rotation_z(PI);
            self.roots.iter_mut().for_each(|(_, frame)| *frame *= half);
        }
        self
    }
}

/// The directions of a rod's parameters, in the order of [`Layout`]: curvatures, torsions, stiffness over weight, torsion ratio, section, length, and three rotations of the root.
pub(crate) fn directions(knots: usize, elements: usize) -> Vec<Direction> {
    let mut directions = Vec::new();
    for axis in [DVec3::X, DVec3::Z] {
        for knot in 0..knots {
            let natural_strain = hat(knot, knots, elements).into_iter().map(|x| axis * x).collect();
            directions.push(Direction { natural_strain, ..Direction::default() });
        }
    }
    // Only the ratio of stiffness and weight counts: a stiffer rod is a lighter one.
    directions.push(Direction { weight: -1.0, ..Direction::default() });
    directions.push(Direction { stiffness: DVec3::Z, ..Direction::default() });
    directions.push(Direction { stiffness: DVec3::Y, ..Direction::default() });
    directions.push(Direction { length: 1.0, ..Direction::default() });
    for root_rotation in [DVec3::X, DVec3::Y, DVec3::Z] {
        directions.push(Direction { root_rotation, ..Direction::default() });
    }
    directions
}

/// The mean over each half of an element of the function that is 1 at a knot, 0 at the others and linear between; one number if there is one knot.
fn hat(knot: usize, knots: usize, elements: usize) -> Vec<f64> {
    if knots == 1 {
        return vec![1.0];
    }
    let pieces = 2 * elements;
    let spans = (knots - 1) as f64;
    // Integral up to x, in spans between knots.
    let integral = |x: f64| {
        let y = (x - knot as f64).clamp(-1.0, 1.0);
        let whole = if y < 0.0 { 0.5 * (1.0 + y).powi(2) } else { 1.0 - 0.5 * (1.0 - y).powi(2) };
        // The first and the last knot have one side.
        whole - if knot == 0 { 0.5 } else { 0.0 }
    };
    let at = |i: usize| spans * i as f64 / pieces as f64;
    let width = spans / pieces as f64;
    (0..pieces).map(|i| (integral(at(i + 1)) - integral(at(i))) / width).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hats_are_what_a_strain_between_knots_changes_by() {
        let elements = 7;
        for knots in [2, 3, 5] {
            let sum: Vec<f64> = (0..2 * elements)
                .map(|i| (0..knots).map(|k| hat(k, knots, elements)[i]).sum())
                .collect();
            assert!(sum.iter().all(|x| (x - 1.0_f64).abs() < 1e-14), "{sum:?}");
            for k in 0..knots {
                let mut u: Vec<(f64, DVec3)> =
                    (0..knots).map(|k| (k as f64 / (knots - 1) as f64, DVec3::ZERO)).collect();
                u[k].1.x = 1.0;
                let profile = NaturalStrain::Varying(StrainProfile::new(u).unwrap());
                for (i, x) in hat(k, knots, elements).into_iter().enumerate() {
                    let at = |i: usize| i as f64 / (2 * elements) as f64;
                    assert!((profile.mean(at(i), at(i + 1)).x - x).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn each_unknown_has_its_place() {
        let layout = Layout { knots: 3, states: 2, poses: 2 };
        let mut places: Vec<usize> =
            (0..3).flat_map(|k| [layout.curvature(k), layout.torsion(k)]).collect();
        places.extend([layout.stiffness(0), layout.stiffness(1)]);
        places.extend([layout.ratio(0), layout.ratio(1), layout.section()]);
        places.extend([layout.length(0), layout.length(1)]);
        places.sort_unstable();
        assert_eq!(places, (0..layout.shared()).collect::<Vec<_>>());
        assert_eq!(layout.len(), layout.shared() + 12);
        assert_eq!(directions(3, 5).len(), 2 * 3 + 4 + 3);
    }
}
