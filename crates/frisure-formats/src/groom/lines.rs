//! Strands of lines between numbered points, as meshes have them.

use super::curves::Curves;

/// Lines, one strand after another.
#[derive(Default)]
pub(super) struct Lines {
    counts: Vec<usize>,
    indices: Vec<u32>,
}

impl Lines {
    /// Adds a line of points; one that begins where the last ended goes on with it.
    pub(super) fn push(&mut self, line: &[u32]) {
        if line.len() < 2 {
            return;
        }
        match (self.counts.last_mut(), self.indices.last()) {
            (Some(count), Some(last)) if *last == line[0] => {
                *count += line.len() - 1;
                self.indices.extend_from_slice(&line[1..]);
            }
            _ => {
                self.counts.push(line.len());
                self.indices.extend_from_slice(line);
            }
        }
    }

    /// Whether there is no line.
    pub(super) fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }

    /// Curves through points, with their diameters if there are any.
    pub(super) fn curves(self, points: &[[f32; 3]], diameters: &[f32]) -> Result<Curves, String> {
        let beyond = |i: &&u32| **i as usize >= points.len();
        if let Some(i) = self.indices.iter().find(beyond) {
            return Err(format!("a line names point {i} of {}, counted from 0", points.len()));
        }
        let at = |i: &u32| *i as usize;
        Ok(Curves {
            points: self.indices.iter().map(|i| points[at(i)]).collect(),
            diameters: if diameters.is_empty() {
                Vec::new()
            } else {
                self.indices.iter().map(|i| diameters[at(i)]).collect()
            },
            counts: self.counts,
            ..Curves::default()
        })
    }
}
