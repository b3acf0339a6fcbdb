//! Hairs as the device reads them: what hangs from their joints, in single precision, hair beside hair.

use frisure_rod::batch::Joints;
use frisure_rod::{MAX_ELEMENTS, NaturalStrain, Rod};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::Error;

/// Hairs of a workgroup, as in `shaders/hairs.wgsl`.
pub(crate) const LANES: usize = 64;

/// Numbers of a hair's root, and of the work on a joint, as there.
const OF_ROOT: usize = 7;
pub(crate) const OF_WORK: usize = 21;

/// Most joints on the device at once: some 200 MB of work, and dispatches of less than a second on slow devices.
const MOST_JOINTS: usize = 1 << 21;

/// How many numbers hairs have, and how many hairs are on the device at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measure {
    /// Joints of each hair.
    pub(crate) joints: usize,
    /// Turns of frames that are stored of each.
    pub(crate) turns: usize,
    /// Room for so many hairs, whole workgroups.
    pub(crate) hairs: usize,
}

impl Measure {
    /// For `rods` of `joints` joints on a device that takes buffers of `bytes`, `at_once` or fewer at a time.
    pub(crate) fn of(
        rods: &[Rod],
        joints: usize,
        bytes: u64,
        at_once: usize,
    ) -> Result<Self, Error> {
        let numbers = usize::try_from(bytes / 4).unwrap_or(usize::MAX).min(OF_WORK * MOST_JOINTS);
        let most = (numbers / OF_WORK / LANES).min(MAX_ELEMENTS);
        if joints == 0 || joints > most {
            return Err(Error::Elements { given: joints, most });
        }
        let alike = rods.iter().all(|rod| matches!(rod.natural(), NaturalStrain::Uniform(_)));
        let room = (numbers / (OF_WORK * joints)).min(at_once.max(LANES)) / LANES * LANES;
        let hairs = room.min(rods.len().next_multiple_of(LANES));
        Ok(Self { joints, turns: if alike { 1 } else { joints }, hairs })
    }
}

/// Hairs that are on the device at once.
#[derive(Debug)]
pub(crate) struct Part {
    measure: Measure,
    pub(crate) roots: Vec<f32>,
    pub(crate) arms: Vec<f32>,
    pub(crate) turns: Vec<f32>,
    pub(crate) controls: Vec<f32>,
}

/// Room for the numbers of `LANES` hairs.
struct Block<'a> {
    roots: &'a mut [f32],
    arms: &'a mut [f32],
    turns: &'a mut [f32],
    controls: &'a mut [f32],
}

impl Part {
    pub(crate) fn new(measure: Measure) -> Self {
        let Measure { joints, turns, hairs } = measure;
        Self {
            measure,
            roots: vec![0.0; OF_ROOT * hairs],
            arms: vec![0.0; 3 * joints * hairs],
            turns: vec![0.0; 9 * turns * hairs],
            controls: vec![0.0; 3 * joints * hairs],
        }
    }

    /// Takes hairs in, for which there is room.
    pub(crate) fn fill(&mut self, rods: &[Rod], start: &[DVec3]) {
        let Measure { joints, turns, .. } = self.measure;
        let blocks = (self.roots.par_chunks_mut(OF_ROOT * LANES))
            .zip(self.arms.par_chunks_mut(3 * joints * LANES))
            .zip(self.turns.par_chunks_mut(9 * turns * LANES))
            .zip(self.controls.par_chunks_mut(3 * joints * LANES));
        let given = rods.par_chunks(LANES).zip(start.par_chunks(joints * LANES));
        blocks.zip(given).for_each_init(Joints::default, |divided, (room, (rods, start))| {
            let (((roots, arms), turns), controls) = room;
            let mut block = Block { roots, arms, turns, controls };
            for (lane, (rod, start)) in rods.iter().zip(start.chunks(joints)).enumerate() {
                divided.divide(rod, joints);
                block.set(lane, divided, rod.moment_scale(), start);
            }
        });
    }

    /// The turns of joints that came back, those of a hair one after the other; of hairs that are not at rest, and of any
    /// that has become no number, what is in `found` stays.
    pub(crate) fn unpack(&self, numbers: &[f32], at_rest: &mut [bool], found: &mut [DVec3]) {
        let joints = self.measure.joints;
        let blocks = numbers.par_chunks(3 * joints * LANES).zip(at_rest.par_chunks_mut(LANES));
        found.par_chunks_mut(joints * LANES).zip(blocks).for_each(|(found, (block, at_rest))| {
            for (lane, (found, at_rest)) in found.chunks_mut(joints).zip(at_rest).enumerate() {
                let number = |k: usize| f64::from(block[k * LANES + lane]);
                *at_rest &= (0..3 * joints).all(|k| number(k).is_finite());
                if *at_rest {
                    for (joint, c) in found.iter_mut().enumerate() {
                        let k = 3 * joint;
                        *c = DVec3::new(number(k), number(k + 1), number(k + 2));
                    }
                }
            }
        });
    }
}

impl Block<'_> {
    /// A hair, its moments in units of its own.
    fn set(&mut self, lane: usize, divided: &Joints, scale: f64, start: &[DVec3]) {
        put(self.roots, lane, 0, divided.up());
        put(self.roots, lane, 3, divided.stiffness() / scale);
        self.roots[6 * LANES + lane] = (divided.constant() / scale) as f32;
        for (joint, (arm, control)) in divided.arms().iter().zip(start).enumerate() {
            put(self.arms, lane, 3 * joint, *arm / scale);
            put(self.controls, lane, 3 * joint, *control);
        }
        // Turns that are alike stand for all, unless other hairs' are not.
        let stored = self.turns.len() / (9 * LANES);
        let last = divided.turns().len().saturating_sub(1);
        for turn in 0..stored {
            let none = DMat3::ZERO;
            let turned = divided.turns().get(turn.min(last)).unwrap_or(&none);
            put(self.turns, lane, 9 * turn, turned.x_axis);
            put(self.turns, lane, 9 * turn + 3, turned.y_axis);
            put(self.turns, lane, 9 * turn + 6, turned.z_axis);
        }
    }
}

/// Puts a vector where numbers `k` and the two after it of a lane are.
fn put(numbers: &mut [f32], lane: usize, k: usize, v: DVec3) {
    for (i, x) in v.to_array().into_iter().enumerate() {
        numbers[(k + i) * LANES + lane] = x as f32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_whole_workgroups_that_fit() {
        let rods = vec![crate::tests::rod(); 1000];
        let of = |joints, bytes| Measure::of(&rods, joints, bytes, usize::MAX);
        assert_eq!(of(15, 128 << 20), Ok(Measure { joints: 15, turns: 1, hairs: 1024 }));
        // 1 MiB is 12 483 joints: 780 hairs of 16, 768 in whole workgroups.
        assert_eq!(of(16, 1 << 20), Ok(Measure { joints: 16, turns: 1, hairs: 768 }));
        let few = |at_once| Measure::of(&rods, 16, 1 << 20, at_once).unwrap().hairs;
        assert_eq!([0, 63, 64, 127, 200, 5000].map(few), [64, 64, 64, 64, 192, 768]);
        assert_eq!(of(195, 1 << 20), Ok(Measure { joints: 195, turns: 1, hairs: 64 }));
        assert_eq!(of(196, 1 << 20), Err(Error::Elements { given: 196, most: 195 }));
        assert_eq!(of(0, 1 << 20), Err(Error::Elements { given: 0, most: 195 }));
        assert_eq!(
            of(usize::MAX, 1 << 40),
            Err(Error::Elements { given: usize::MAX, most: MAX_ELEMENTS })
        );
    }
}
