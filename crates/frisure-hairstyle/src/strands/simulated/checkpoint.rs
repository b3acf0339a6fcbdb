//! Checkpoints of simulated hairs: long work that was interrupted goes on from there.

use glam::Vec3;

use super::super::curve::Hair;
use super::simulation::Simulation;

/// Saves simulated hairs part by part, and finds them again; called from any thread.
pub trait Checkpoint: Sync {
    /// What was saved of a part; none if nothing was.
    fn find(&self, part: usize) -> Option<&[u8]>;

    /// Saves the result of a part. If it cannot, the work goes on.
    fn save(&self, part: usize, bytes: &[u8]);
}

/// The bytes of a part: how its hairs came to rest, then for each guide, thickness, whether it was cut, and points.
pub(super) fn part_to_bytes(hairs: &[Hair], simulation: Simulation) -> Vec<u8> {
    let Simulation { hairs: of, at_rest, elements, iterations, contact: _ } = simulation;
    let mut bytes = Vec::new();
    for number in [of, at_rest, elements, iterations] {
        bytes.extend((number as u64).to_le_bytes());
    }
    for Hair { guide, thickness, cut, points } in hairs {
        bytes.extend(guide.to_le_bytes());
        bytes.extend(thickness.to_le_bytes());
        bytes.push(u8::from(*cut));
        bytes.extend((points.len() as u32).to_le_bytes());
        points.iter().for_each(|p| bytes.extend(p.to_array().map(f32::to_le_bytes).as_flattened()));
    }
    bytes
}

/// The part of `count` hairs that these are the bytes of; none if they are not.
pub(super) fn part_from_bytes(mut bytes: &[u8], count: usize) -> Option<(Vec<Hair>, Simulation)> {
    let bytes = &mut bytes;
    let mut number = || Some(u64::from_le_bytes(*bytes.split_off(..8)?.first_chunk()?) as usize);
    let simulation = Simulation {
        hairs: number()?,
        at_rest: number()?,
        elements: number()?,
        iterations: number()?,
        // Hairs in contact with each other are not saved.
        contact: None,
    };
    let hairs = (0..count).map(|_| hair(bytes)).collect::<Option<_>>()?;
    bytes.is_empty().then_some((hairs, simulation))
}

fn hair(bytes: &mut &[u8]) -> Option<Hair> {
    let guide = u32::from_le_bytes(*bytes.split_off(..4)?.first_chunk()?);
    let thickness = f64::from_le_bytes(*bytes.split_off(..8)?.first_chunk()?);
    let cut = bytes.split_off_first()? == &1;
    let count = u32::from_le_bytes(*bytes.split_off(..4)?.first_chunk()?) as usize;
    let (points, _) = bytes.split_off(..12 * count)?.as_chunks::<12>();
    let coordinate = |p: &[u8; 12], i: usize| {
        f32::from_le_bytes([p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]])
    };
    let point = |p: &[u8; 12]| Vec3::from_array([0, 1, 2].map(|i| coordinate(p, i)));
    Some(Hair { guide, thickness, cut, points: points.iter().map(point).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_comes_back_whole_or_not_at_all() {
        let hair = |n: usize| Hair {
            guide: n as u32,
            thickness: 0.5 * n as f64,
            cut: n == 1,
            points: (0..n).map(|k| Vec3::new(k as f32, -1.5, 0.1)).collect(),
        };
        let simulation =
            Simulation { hairs: 3, at_rest: 2, elements: 50, iterations: 17, contact: None };
        let hairs = [hair(2), hair(0), hair(1)];
        let bytes = part_to_bytes(&hairs, simulation);
        let (again, counts) = part_from_bytes(&bytes, 3).unwrap();
        assert_eq!(counts, simulation);
        assert_eq!(part_to_bytes(&again, counts), bytes);
        assert!(part_from_bytes(&bytes, 2).is_none() && part_from_bytes(&bytes, 4).is_none());
        for cut in 0..bytes.len() {
            assert!(part_from_bytes(&bytes[..cut], 3).is_none());
        }
    }
}
