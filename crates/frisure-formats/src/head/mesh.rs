//! A mesh as it stands in a file of whatever format.

use std::collections::BTreeMap;

use frisure_files::frame::Frame;

/// Corners of one face in a file, at most; a fan of more triangles is no head.
pub(super) const MAX_CORNERS: usize = 1000;

/// Numbers at vertices that are kept, at most.
const MOST_CHANNELS: usize = 64;

/// A named group of faces (of OBJ `g`, `o` or `usemtl`; a prim, a subset, a node, a material).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// Name in the file.
    pub name: String,
    /// Indices of its triangles.
    pub triangles: Vec<usize>,
}

/// A mesh as it stands in the file.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Mesh {
    /// Unit and axes that the format or the file has.
    pub(super) frame: Option<Frame>,
    /// Whether the file or its format states the unit.
    pub(super) states_unit: bool,
    /// Vertices, in the file's own unit and axes.
    pub(super) positions: Vec<[f64; 3]>,
    /// Texture coordinates.
    pub(super) uvs: Vec<[f64; 2]>,
    /// Vertices of each triangle; polygons are cut into fans.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Texture coordinates of each triangle's corners, where it has them.
    pub(super) triangle_uvs: Vec<Option<[u32; 3]>>,
    /// Groups, by name.
    pub(super) groups: BTreeMap<String, Group>,
    /// Numbers that the file has for each vertex, such as `red`, by name.
    pub(super) channels: BTreeMap<String, Vec<f64>>,
    /// Index of the vertex that each vertex of the file became; empty where they are the same.
    pub(super) joined: Vec<u32>,
}

/// Names of the parts of a colour.
pub(super) const COLOURS: [&str; 4] = ["red", "green", "blue", "alpha"];

/// The mean of red, green and blue.
pub(super) const BRIGHTNESS: &str = "brightness";

impl Mesh {
    /// Adds triangles, from one on, to a group.
    pub(super) fn group(&mut self, name: &str, first: usize) {
        let triangles = first..self.triangles.len();
        self.group_of(name, triangles);
    }

    /// Adds triangles to a group.
    pub(super) fn group_of(&mut self, name: &str, triangles: impl Iterator<Item = usize>) {
        if name.is_empty() {
            return;
        }
        let group = self.groups.entry(name.to_owned()).or_default();
        name.clone_into(&mut group.name);
        group.triangles.extend(triangles);
    }

    /// Sets a number of vertices from one on; those of other parts of the file have 0.
    pub(super) fn channel(&mut self, name: &str, first: usize, values: impl Iterator<Item = f64>) {
        // Each has room for all vertices of the file.
        if self.channels.len() >= MOST_CHANNELS && !self.channels.contains_key(name) {
            return;
        }
        let channel = self.channels.entry(name.to_owned()).or_default();
        channel.resize(self.positions.len(), 0.0);
        for (slot, value) in channel[first..].iter_mut().zip(values) {
            *slot = value;
        }
    }

    /// Sets the colours of vertices from one on: each red, green, blue, and alpha where there is one.
    pub(super) fn colours(&mut self, first: usize, colours: &[f64], width: usize) {
        if width < 3 {
            return;
        }
        for (i, name) in COLOURS.into_iter().enumerate().take(width) {
            self.channel(name, first, colours.chunks_exact(width).map(|c| c[i]));
        }
        self.channel(BRIGHTNESS, first, colours.chunks_exact(width).map(mean));
    }

    /// Sets values of vertices from one on: single numbers, or colours as their means. Others are left out.
    pub(super) fn values(&mut self, name: &str, first: usize, values: &[f64], width: usize) {
        match width {
            1 => self.channel(name, first, values.iter().copied()),
            3 | 4 => self.channel(name, first, values.chunks_exact(width).map(mean)),
            _ => {}
        }
    }

    /// Makes vertices in the same place one: formats that cannot give a corner of its own a texture coordinate
    /// repeat vertices along seams, where the surface would have a hole.
    pub(super) fn join(&mut self) {
        let mut places = BTreeMap::new();
        let mut positions = Vec::new();
        for position in &self.positions {
            // Zeros of either sign are one place.
            let key = position.map(|x| (x + 0.0).to_bits());
            let place = *places.entry(key).or_insert_with(|| {
                positions.push(*position);
                u32::try_from(positions.len() - 1).unwrap_or(u32::MAX)
            });
            self.joined.push(place);
        }
        for corner in self.triangles.as_flattened_mut() {
            *corner = self.joined[*corner as usize];
        }
        let count = positions.len();
        self.positions = positions;
        let mut channels = std::mem::take(&mut self.channels);
        for values in channels.values_mut() {
            values.resize(self.joined.len(), 0.0);
            *values = self.averaged(values, count);
        }
        self.channels = channels;
    }

    /// Numbers of the file's vertices as the means of those that became one.
    pub(super) fn averaged(&self, values: &[f64], count: usize) -> Vec<f64> {
        let mut sums = vec![(0.0, 0_u32); count];
        for (value, &place) in values.iter().zip(&self.joined) {
            let (sum, n) = &mut sums[place as usize];
            *sum += value;
            *n += 1;
        }
        sums.into_iter().map(|(sum, n)| sum / f64::from(n.max(1))).collect()
    }

    /// Texture coordinates at the corners of all triangles; none if a triangle has none or all are in one point.
    pub(super) fn texture(&self) -> Option<Vec<[[f32; 2]; 3]>> {
        let uv = |&i: &u32| self.uvs.get(i as usize).map(|uv| uv.map(|x| x as f32));
        let corners = |t: &Option<[u32; 3]>| {
            let [a, b, c] = t.as_ref()?;
            Some([uv(a)?, uv(b)?, uv(c)?])
        };
        let all: Vec<_> = self.triangle_uvs.iter().map(corners).collect::<Option<_>>()?;
        let first = all.first()?[0];
        let spread = all.as_flattened().iter().any(|uv| *uv != first);
        (spread && all.len() == self.triangles.len()).then_some(all)
    }

    /// How many vertices the file has.
    pub(super) fn file_vertices(&self) -> usize {
        if self.joined.is_empty() { self.positions.len() } else { self.joined.len() }
    }
}

/// The mean of red, green and blue.
fn mean(colour: &[f64]) -> f64 {
    (colour[0] + colour[1] + colour[2]) / 3.0
}

/// A number of a file as the index of a vertex, if it is one of `count`.
pub(super) fn vertex_index(number: f64, count: usize) -> Option<u32> {
    let is_index = number >= 0.0 && number < count as f64 && number <= f64::from(u32::MAX);
    is_index.then_some(number as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_in_one_place_become_one() {
        let mut mesh = Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [-0.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 3], [2, 3, 1]],
            ..Mesh::default()
        };
        mesh.colours(0, &[1.0, 0.5, 0.0].repeat(2), 3);
        mesh.join();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 1]]);
        assert_eq!(mesh.joined, [0, 1, 0, 2]);
        assert_eq!(mesh.channels["red"], [0.5, 1.0, 0.0]);
        assert_eq!(mesh.channels[BRIGHTNESS], [0.25, 0.5, 0.0]);
    }
}
