//! Triangles as the distance grid needs them: closed, with neighbours, some left out.

use std::collections::BTreeMap;

use frisure_strands::Surface;
use glam::DVec3;

/// Corners in front of a plane by no more than this, times the distance from `p` (m²), may be in it: above the rounding of
/// both on a bust, which is 1e-17. Chosen; no result depends on it.
const LEVEL: f64 = 1e-15;
/// Corners farther behind a plane than this, times the distance from `p` (m²), are not in it. Chosen; no result depends on it.
const DEEP: f64 = 1e-10;
/// Squared distance (m²) beyond which a corner is not the nearest point. Chosen; no result depends on it.
const APART: f64 = 1e-10;

/// Triangles over welded corners: vertices at the same place are one.
#[derive(Debug, PartialEq)]
pub(crate) struct Soup {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// The faces of `surface` that are `chosen` by their corners (m), and a lid over each of their open rims.
    pub(crate) fn closed(surface: &Surface, chosen: impl Fn([DVec3; 3]) -> bool) -> Self {
        let positions = surface.positions().to_vec();
        let same = weld(&positions);
        let mut triangles: Vec<[u32; 3]> =
            surface.triangles().iter().map(|t| t.map(|v| same[v as usize])).collect();
        triangles.retain(|[a, b, c]| a != b && b != c && c != a);
        triangles.retain(|t| chosen(t.map(|v| positions[v as usize])));
        let mut soup = Self { positions, triangles };
        for rim in soup.rims() {
            soup.cover(&rim);
        }
        soup
    }

    pub(crate) fn len(&self) -> usize {
        self.triangles.len()
    }

    pub(crate) fn corners(&self, face: usize) -> [DVec3; 3] {
        self.triangles[face].map(|v| self.positions[v as usize])
    }

    /// Whether face `index` has not been taken out by [`Soup::only`].
    pub(crate) fn has(&self, index: usize) -> bool {
        let [a, b, _] = self.triangles[index];
        a != b
    }

    /// Keeps only the faces for which `kept` is true; the others keep their number, but are a point.
    pub(crate) fn only(mut self, kept: &[bool]) -> Self {
        for (triangle, _) in self.triangles.iter_mut().zip(kept).filter(|(_, kept)| !**kept) {
            *triangle = [triangle[0]; 3];
        }
        self
    }

    /// Adds to the chosen faces those connected to them within `reach` (m), which are too small to
    /// be the nearest of any node.
    pub(crate) fn grow(&self, chosen: &[bool], reach: f64) -> Vec<bool> {
        let around = self.faces_of_vertices();
        let mut grown = chosen.to_vec();
        let centre = |f: usize| self.corners(f).iter().sum::<DVec3>() / 3.0;
        let mut front: Vec<(usize, DVec3)> =
            (0..self.len()).filter(|&f| chosen[f]).map(|f| (f, centre(f))).collect();
        while !front.is_empty() {
            let mut next = Vec::new();
            for &(face, seed) in &front {
                for &v in &self.triangles[face] {
                    for &f in around.of(v) {
                        if !grown[f as usize] && centre(f as usize).distance(seed) < reach {
                            grown[f as usize] = true;
                            next.push((f as usize, seed));
                        }
                    }
                }
            }
            front = next;
        }
        grown
    }

    /// Distance (m) from `p` to the face nearest to it that is reached from `face` by going to a
    /// nearer neighbour again and again.
    pub(crate) fn descend(&self, around: &Rows, mut face: u32, p: DVec3) -> f64 {
        let measure = |f: u32| {
            let foot = closest_point(p, self.corners(f as usize));
            (p.distance_squared(foot), foot)
        };
        let (mut best, mut foot) = measure(face);
        loop {
            let from = face;
            for &f in around.of(from) {
                if self.behind(f, p, foot) {
                    continue;
                }
                let (d, q) = measure(f);
                if d < best {
                    (best, foot, face) = (d, q, f);
                }
            }
            if face == from {
                return best.sqrt();
            }
        }
    }

    /// Whether a face is farther from `p` than `foot` is, by more than rounding; false also for some that are.
    fn behind(&self, face: u32, p: DVec3, foot: DVec3) -> bool {
        // |p − x|² = |p − q|² − 2h + |x − q|² with q the foot and h = (x − q)·(p − q): where h ≤ 0 at all corners, it is at
        // all points of the face. It vanishes at most at one corner. If that one is apart from q, −2h or |x − q|² exceeds the
        // rounding at each point of the face; if it is q, to the bit, `closest_point` finds it there, which is as far.
        let away = p - foot;
        let mut level = 0;
        for v in self.triangles[face as usize] {
            let x = self.positions[v as usize] - foot;
            let h = x.dot(away);
            if h > LEVEL || (h > -DEEP && x != DVec3::ZERO && x.length_squared() < APART) {
                return false;
            }
            level += usize::from(h > -DEEP);
        }
        level <= 1
    }

    /// For each face, the others that share a corner with it.
    pub(crate) fn faces_around(&self) -> Rows {
        let of_vertices = self.faces_of_vertices();
        let (mut starts, mut items) = (vec![0], Vec::with_capacity(12 * self.len()));
        for (face, corners) in self.triangles.iter().enumerate() {
            for (n, &v) in corners.iter().enumerate().take(if self.has(face) { 3 } else { 0 }) {
                let around = of_vertices.of(v).iter().copied().filter(|&f| f as usize != face);
                // Those at an earlier corner are in the list.
                let new = |&f: &u32| {
                    n == 0 || !self.triangles[f as usize].iter().any(|u| corners[..n].contains(u))
                };
                items.extend(around.filter(new));
            }
            starts.push(items.len());
        }
        Rows { starts, items }
    }

    /// For each vertex, those that faces have after it, lowest first.
    fn vertices_after(&self) -> Rows {
        let edges = || self.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let mut after = Rows::of_pairs(self.positions.len(), edges);
        after.starts.windows(2).for_each(|ends| after.items[ends[0]..ends[1]].sort_unstable());
        after
    }

    /// For each vertex, the faces that meet there.
    fn faces_of_vertices(&self) -> Rows {
        let present = || (0..self.len()).filter(|&f| self.has(f));
        Rows::of_pairs(self.positions.len(), || {
            present().flat_map(|f| self.triangles[f].map(|v| (v, f as u32)))
        })
    }

    /// Closed chains of edges that have a face on one side only, in the direction of a lid's edges.
    fn rims(&self) -> Vec<Vec<u32>> {
        let after = self.vertices_after();
        let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for a in 0..self.positions.len() as u32 {
            for &b in after.of(a) {
                if after.of(b).binary_search(&a).is_err() {
                    next.entry(b).or_default().push(a);
                }
            }
        }
        let mut rims = Vec::new();
        while let Some((&first, _)) = next.iter().next() {
            let mut rim = vec![first];
            let mut at = first;
            while let Some(to) = take(&mut next, at) {
                if to == first {
                    break;
                }
                rim.push(to);
                at = to;
            }
            rims.push(rim);
        }
        rims
    }

    /// A fan from the middle of a rim.
    fn cover(&mut self, rim: &[u32]) {
        let sum: DVec3 = rim.iter().map(|&v| self.positions[v as usize]).sum();
        let middle = self.positions.len() as u32;
        self.positions.push(sum / rim.len() as f64);
        for (i, &a) in rim.iter().enumerate() {
            self.triangles.push([a, rim[(i + 1) % rim.len()], middle]);
        }
    }
}

/// Lists of faces or vertices, one list per face or vertex.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    starts: Vec<usize>,
    items: Vec<u32>,
}

impl Rows {
    /// The second of the pairs for each first, of which there are `count`, in their order.
    fn of_pairs<I: Iterator<Item = (u32, u32)>>(count: usize, pairs: impl Fn() -> I) -> Self {
        let mut starts = vec![0; count + 1];
        pairs().for_each(|(row, _)| starts[row as usize + 1] += 1);
        for row in 0..count {
            starts[row + 1] += starts[row];
        }
        let (mut next, mut items) = (starts.clone(), vec![0; starts[count]]);
        for (row, item) in pairs() {
            items[next[row as usize]] = item;
            next[row as usize] += 1;
        }
        Self { starts, items }
    }

    fn of(&self, row: u32) -> &[u32] {
        &self.items[self.starts[row as usize]..self.starts[row as usize + 1]]
    }
}

/// Removes and returns one of the vertices that follow `at`.
fn take(next: &mut BTreeMap<u32, Vec<u32>>, at: u32) -> Option<u32> {
    let followers = next.get_mut(&at)?;
    let to = followers.pop();
    if followers.is_empty() {
        next.remove(&at);
    }
    to
}

/// For each vertex, the first vertex at the same place.
pub(super) fn weld(positions: &[DVec3]) -> Vec<u32> {
    // Adding 0 turns −0 into 0: equal coordinates have equal bits.
    let key = |p: &DVec3| p.to_array().map(|c| (c + 0.0).to_bits());
    let keys = positions.iter().zip(0..);
    let mut order: Vec<([u64; 3], u32)> = keys.map(|(p, v)| (key(p), v)).collect();
    order.sort_unstable();
    let mut same = vec![0; positions.len()];
    for group in order.chunk_by(|a, b| a.0 == b.0) {
        group.iter().for_each(|&(_, v)| same[v as usize] = group[0].1);
    }
    same
}

/// The point of a triangle that is nearest to `p`. \[Ericson\] §5.1.5
pub(crate) fn closest_point(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    // The Voronoi region of p: a corner, an edge or the face. d1 … d6 are projections on both edges, va, vb and vc areas
    // (times |ab × ac|) that vanish on the lines through the edges.
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let scale = (va + vb + vc).recip();
    a + ab * (vb * scale) + ac * (vc * scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::ball;

    #[test]
    fn a_face_behind_the_nearest_point_is_no_nearer() {
        let soup = Soup::closed(&ball(0.08, 16), |_| true);
        let (mut behind, mut in_front) = (0, 0);
        for i in 0..80 {
            let a = f64::from(i);
            let p = DVec3::new(a.sin(), (1.7 * a).cos(), (0.3 * a).sin()) * (0.002 * a);
            // The foot in a face, on its edge or at its corner, as it comes.
            let own = (37 * i as usize) % soup.len();
            let foot = closest_point(p, soup.corners(own));
            for face in 0..soup.len() {
                let distance = p.distance_squared(closest_point(p, soup.corners(face)));
                if soup.behind(face as u32, p, foot) {
                    assert!(distance >= p.distance_squared(foot), "{face} is nearer to {p}");
                    behind += 1;
                } else {
                    in_front += usize::from(distance < p.distance_squared(foot));
                }
            }
        }
        assert!(behind > 1000 && in_front > 1000, "{behind} {in_front}");
    }
}
