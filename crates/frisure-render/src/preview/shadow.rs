//! Which places the head hides from a lamp: a depth map seen from the lamp.

use std::sync::LazyLock;

use glam::{Vec2, Vec3};

use super::geometry::frame;
use super::head::Head;
use super::raster;

/// Texels along a side, about 1 mm each on a bust with its torso. Chosen.
const SIZE: usize = 640;

/// Thirteen points spread evenly over the unit disc: one, four and eight on three rings. Chosen.
const DISC: [(f32, f32); 13] = [
    (0.0, 0.0),
    (0.31, 0.31),
    (-0.31, 0.31),
    (-0.31, -0.31),
    (0.31, -0.31),
    (0.79, 0.33),
    (0.33, 0.79),
    (-0.33, 0.79),
    (-0.79, 0.33),
    (-0.79, -0.33),
    (-0.33, -0.79),
    (0.33, -0.79),
    (0.79, -0.33),
];

/// Places on a lamp from which a soft shadow is the mean. Chosen: steps of a thirtieth are hardly seen.
const PLACES: usize = 30;

/// These places on the unit disc: a spiral of even steps of area, turned by the golden angle each.
static SPIRAL: LazyLock<[Vec2; PLACES]> = LazyLock::new(|| {
    /// The golden angle (rad).
    const GOLDEN: f32 = 2.399_963;
    std::array::from_fn(|i| {
        let radius = ((i as f32 + 0.5) / PLACES as f32).sqrt();
        radius * Vec2::from_angle(GOLDEN * i as f32)
    })
});

/// How soft the head's shadow on itself is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Penumbra {
    /// Radius at no distance (m).
    pub(super) narrowest: f32,
    /// Radius per distance of what casts the shadow.
    pub(super) spread: f32,
    /// Largest radius (m).
    pub(super) widest: f32,
}

/// Depth of the head seen from a lamp.
pub(super) struct ShadowMap {
    axes: [Vec3; 3],
    low: Vec2,
    texel: f32,
    /// Distance from the lamp's side (m), row by row; infinite where there is no head.
    depth: Vec<f32>,
}

impl ShadowMap {
    /// The map for a lamp in unit direction `to_light`.
    pub(super) fn new(head: &Head, to_light: Vec3) -> Self {
        let (u, v) = frame(-to_light);
        let axes = [u, v, -to_light];
        let flat = |p: Vec3| Vec2::new(p.dot(u), p.dot(v));
        let (low, high) = head
            .positions()
            .iter()
            .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), &p| {
                (low.min(flat(p)), high.max(flat(p)))
            });
        let texel = ((high - low).max_element() / (SIZE - 8) as f32).max(1e-6);
        let low = low - Vec2::splat(4.0 * texel);
        let mut map = Self { axes, low, texel, depth: vec![f32::INFINITY; SIZE * SIZE] };
        for corners in head.faces() {
            let at = corners.map(|p| map.project(p));
            raster::triangle(at.map(Vec3::truncate), (0, 0), (SIZE, SIZE), |x, y, b| {
                let depth = at[0].z * b.x + at[1].z * b.y + at[2].z * b.z;
                let texel = &mut map.depth[y * SIZE + x];
                *texel = texel.min(depth);
            });
        }
        map
    }

    /// Part of the lamp (0 to 1) that is seen from `point`, moved towards it by `bias` (m).
    pub(super) fn lit(&self, point: Vec3, bias: f32) -> f32 {
        let p = self.project(point);
        let g = p.truncate() - Vec2::splat(1.5);
        if !(g.min_element() >= 0.0 && g.max_element() < (SIZE - 5) as f32) {
            return 1.0;
        }
        // A cubic kernel over 4×4 texels: a soft edge two texels wide, without steps.
        let (x, y) = (g.x as usize, g.y as usize);
        let (wx, wy) = (kernel(g.x - x as f32), kernel(g.y - y as f32));
        let nearer = p.z - bias;
        let mut lit = 0.0;
        for (j, wy) in wy.iter().enumerate() {
            let row = (y + j) * SIZE + x;
            for (depth, wx) in self.depth[row..row + 4].iter().zip(wx) {
                lit += if nearer <= *depth { wx * wy } else { 0.0 };
            }
        }
        lit
    }

    /// Mean over a lamp as wide as a soft box of the part that is seen from `point`, moved towards it by `bias` (m): shadows
    /// blur over `radius` (m), and more the farther away what casts them is, by `spread` of the distance and `widest` (m) at most.
    ///
    /// The distance is the mean one of what lies before the point within the widest blur (percentage-closer soft shadows,
    /// Fernando 2005).
    pub(super) fn softly_lit(&self, point: Vec3, bias: f32, blur: Penumbra) -> f32 {
        let p = self.project(point);
        // In the map, the lamp's disc around the point is a disc at one depth.
        let (middle, nearer) = (p.truncate(), p.z - bias);
        let (mut sum, mut count) = (0.0, 0.0);
        for (x, y) in DISC {
            let at = middle + blur.widest / self.texel * Vec2::new(x, y);
            if let Some(depth) = self.blocker(at, nearer) {
                sum += p.z - depth;
                count += 1.0;
            }
        }
        if count == 0.0 {
            return 1.0;
        }
        let radius = (blur.spread * sum / count).clamp(blur.narrowest, blur.widest) / self.texel;
        let lit = SPIRAL.iter().map(|place| self.lit_between(middle + radius * place, nearer));
        lit.sum::<f32>() / PLACES as f32
    }

    /// Depth (m) of the head at a place of the map, if it is less than `nearer`.
    fn blocker(&self, at: Vec2, nearer: f32) -> Option<f32> {
        let inside = at.min_element() >= 0.0 && at.max_element() < SIZE as f32;
        let depth = inside.then(|| self.depth[at.y as usize * SIZE + at.x as usize])?;
        (depth < nearer).then_some(depth)
    }

    /// Part (0 to 1) of the four texels around a place of the map that hide nothing at depth `nearer` (m): enough where many
    /// places are averaged.
    fn lit_between(&self, at: Vec2, nearer: f32) -> f32 {
        let g = at - Vec2::splat(0.5);
        if !(g.min_element() >= 0.0 && g.max_element() < (SIZE - 1) as f32) {
            return 1.0;
        }
        let (x, y) = (g.x as usize, g.y as usize);
        let f = g - Vec2::new(x as f32, y as f32);
        let row = |y: usize| {
            let [a, b] = [0, 1].map(|i| {
                let open = nearer <= self.depth[y * SIZE + x + i];
                f32::from(u8::from(open))
            });
            a + (b - a) * f.x
        };
        let (above, below) = (row(y), row(y + 1));
        above + (below - above) * f.y
    }

    /// Texel coordinates and depth (m).
    fn project(&self, p: Vec3) -> Vec3 {
        let [u, v, w] = self.axes;
        let flat = (Vec2::new(p.dot(u), p.dot(v)) - self.low) / self.texel;
        flat.extend(p.dot(w))
    }
}

/// Weights of four texels around a place `f` (0 to 1) past the second: the uniform cubic B-spline.
fn kernel(f: f32) -> [f32; 4] {
    let g = 1.0 - f;
    let (f3, g3) = (f * f * f, g * g * g);
    [g3 / 6.0, (4.0 - 6.0 * f * f + 3.0 * f3) / 6.0, (4.0 - 6.0 * g * g + 3.0 * g3) / 6.0, f3 / 6.0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use frisure_strands::Surface;
    use glam::DVec3;

    #[test]
    fn a_plate_hides_what_is_below_it() {
        let corners = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)];
        let positions = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        let surface = Surface::new(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let map = ShadowMap::new(&Head::new(&surface), Vec3::Z);
        assert!(map.lit(Vec3::Z * 0.01, 0.0) > 0.999);
        assert!(map.lit(Vec3::Z * -0.01, 0.001) < 0.001);
        assert_eq!(map.lit(Vec3::new(0.2, 0.0, -0.01), 0.001), 1.0);
        let edge = map.lit(Vec3::new(0.1, 0.0, -0.01), 0.001);
        assert!(edge > 0.2 && edge < 0.8, "{edge}");
    }
}
