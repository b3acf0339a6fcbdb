//! A stroke of the comb through hair, and the hair that its teeth take.

use std::collections::BTreeMap;

use frisure_engine::StrandsData;
use glam::{DVec3, Vec3};

use super::orbit::Orbit;

/// A stroke of the comb over the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct CombStroke {
    /// Where the comb has been, in order.
    pub path: Vec<CombPlace>,
    /// Width over height of the picture.
    pub aspect: f64,
}

/// A place of the comb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CombPlace {
    /// In the picture: −1 to 1, right and up.
    pub at: [f64; 2],
    /// The skin there (m), where the head is.
    pub skin: Option<DVec3>,
}

/// How deep (m) teeth reach into hair from its outermost point beneath the comb. Chosen: the length of the teeth of a dressing comb.
const TEETH: f64 = 0.03;

/// How far (m) behind the skin hair still lies before the head: roots are in it. Chosen.
const IN_SKIN: f64 = 5e-3;

/// Share of its drawn strands from which on the comb takes a wisp. Chosen by trial.
const TAKEN: f64 = 0.2;

/// Strands that are looked at, so that hair follows at once: of a head of 100 000 hairs each twelfth. Chosen.
const LOOKED_AT: usize = 8_000;

/// Most places of a stroke that are looked at. Chosen.
const MOST_PLACES: usize = 40;

impl CombStroke {
    /// The direction of combing (unit): between the skin at both ends, or in the plane of the picture where the comb was beside the head.
    /// None for a stroke that ends where it began.
    #[must_use]
    pub fn direction(&self, orbit: &Orbit) -> Option<DVec3> {
        let [from, .., to] = self.path[..] else { return None };
        let way = match (from.skin, to.skin) {
            (Some(from), Some(to)) => to - from,
            _ => {
                let camera = orbit.camera();
                let [x, y] = [0, 1].map(|axis| to.at[axis] - from.at[axis]);
                x * self.aspect * camera.right() + y * camera.up()
            }
        };
        way.try_normalize()
    }

    /// Where the comb ended (m): on the skin, or beside the head as far away as the skin where it began, or as what the camera turns about.
    #[must_use]
    pub fn end(&self, orbit: &Orbit) -> Option<DVec3> {
        let [from, .., to] = self.path[..] else { return None };
        to.skin.or_else(|| {
            let (camera, view) = (orbit.camera(), View::new(orbit));
            let middle = from.skin.unwrap_or(orbit.target);
            let depth = (middle - view.eye).dot(view.forward);
            let [x, y] = to.at;
            let across = x * self.aspect * camera.right() + y * camera.up();
            Some(view.eye + depth * (view.forward + view.tan * across))
        })
    }

    /// Whether the comb ended on the head, where it presses hair to the skin.
    #[must_use]
    pub fn ends_on_skin(&self) -> bool {
        self.path.last().is_some_and(|place| place.skin.is_some())
    }

    /// The wisps that a comb of a radius (m) takes: those of which it has passed over enough strands, before the head and not below
    /// the reach of its teeth.
    #[must_use]
    pub fn wisps(&self, orbit: &Orbit, radius: f64, strands: &StrandsData) -> Vec<usize> {
        let count = strands.guide.iter().max().map_or(0, |most| *most as usize + 1);
        let view = View::new(orbit);
        let places = self.places(&view);
        let end = |of: fn(f64, f64) -> f64, from: f64| {
            [0, 1].map(|axis| places.iter().map(|place| place.at[axis]).fold(from, of))
        };
        let (low, high) = (end(f64::min, f64::INFINITY), end(f64::max, f64::NEG_INFINITY));
        let (points, _) = strands.points.as_chunks::<3>();
        let stride = strands.guide.len().div_ceil(LOOKED_AT).max(1);
        let mut looked_at = vec![0_u32; count];
        // Depth of the outermost hair at each place, and of each strand of each wisp beneath it.
        let mut outermost = vec![f64::INFINITY; places.len()];
        let mut beneath: BTreeMap<(u32, usize), Vec<(usize, f64)>> = BTreeMap::new();
        let ends = strands.offsets.windows(2).zip(&strands.guide).enumerate();
        for (strand, (ends, &wisp)) in ends.step_by(stride) {
            looked_at[wisp as usize] += 1;
            for point in &points[ends[0] as usize..ends[1] as usize] {
                let Some((at, depth)) = view.seen(Vec3::from_array(*point).as_dvec3()) else {
                    continue;
                };
                let reach = radius / (depth * view.tan);
                // Most hair is far from the stroke.
                let apart =
                    |axis: usize| at[axis] < low[axis] - reach || at[axis] > high[axis] + reach;
                if apart(0) || apart(1) {
                    continue;
                }
                for (i, place) in places.iter().enumerate() {
                    let near = (at[0] - place.at[0]).hypot(at[1] - place.at[1]) < reach;
                    if near && depth < place.skin + IN_SKIN {
                        outermost[i] = outermost[i].min(depth);
                        beneath.entry((wisp, strand)).or_default().push((i, depth));
                    }
                }
            }
        }
        let mut taken = vec![0_u32; count];
        for ((wisp, _), passed) in beneath {
            let reached = passed.iter().any(|&(place, depth)| depth < outermost[place] + TEETH);
            taken[wisp as usize] += u32::from(reached);
        }
        let enough =
            |w: &usize| taken[*w] > 0 && f64::from(taken[*w]) >= TAKEN * f64::from(looked_at[*w]);
        (0..count).filter(enough).collect()
    }

    /// Some of the places, with the depth of the skin there; in half heights of the picture.
    fn places(&self, view: &View) -> Vec<Place> {
        let step = self.path.len().div_ceil(MOST_PLACES).max(1);
        let place = |p: &CombPlace| Place {
            at: [p.at[0] * self.aspect, p.at[1]],
            skin: p.skin.map_or(f64::INFINITY, |skin| (skin - view.eye).dot(view.forward)),
        };
        self.path.iter().step_by(step).map(place).collect()
    }
}

/// A place of the comb in half heights of the picture, with the depth of the skin there (m).
struct Place {
    at: [f64; 2],
    skin: f64,
}

/// A camera, for many points.
struct View {
    eye: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// Of half the field of view.
    tan: f64,
}

impl View {
    fn new(orbit: &Orbit) -> Self {
        let camera = orbit.camera();
        let tan = (0.5 * orbit.field_of_view).tan();
        Self {
            eye: camera.eye(),
            forward: camera.forward(),
            right: camera.right(),
            up: camera.up(),
            tan,
        }
    }

    /// Where a point (m) is in the picture, in half heights of it, and its depth (m); none behind the camera.
    fn seen(&self, p: DVec3) -> Option<([f64; 2], f64)> {
        let offset = p - self.eye;
        let depth = offset.dot(self.forward);
        let scale = self.tan * depth;
        (depth > 1e-6)
            .then(|| ([offset.dot(self.right) / scale, offset.dot(self.up) / scale], depth))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One strand for each wisp, which hangs from (x, y, 0.1) to 20 cm lower.
    fn hanging(places: &[(f32, f32)]) -> StrandsData {
        let mut strands = StrandsData { offsets: vec![0], ..StrandsData::default() };
        for (i, (x, y)) in places.iter().enumerate() {
            for k in 0..21 {
                strands.points.extend([*x, *y, 0.1 - 0.01 * k as f32]);
            }
            strands.offsets.push(21 * (i as u32 + 1));
            strands.guide.push(i as u32);
        }
        strands
    }

    fn stroke(orbit: &Orbit, skin: Option<DVec3>, ends: [DVec3; 2]) -> CombStroke {
        let place = |i: i32| {
            let p = ends[0].lerp(ends[1], f64::from(i) / 10.0);
            CombPlace { at: orbit.project(p, 1.5).unwrap(), skin }
        };
        CombStroke { path: (0..=10).map(place).collect(), aspect: 1.5 }
    }

    #[test]
    fn a_comb_takes_the_hair_beneath_it_that_its_teeth_reach() {
        let orbit = Orbit { azimuth: 0.0, elevation: 0.0, ..Orbit::default() };
        // Two beside each other, one deeper than the teeth reach, one beside the stroke.
        let strands = hanging(&[(0.0, -0.1), (0.02, -0.1), (0.01, -0.05), (0.08, -0.1)]);
        let at = |x: f64| DVec3::new(x, -0.1, 0.0);
        let over = stroke(&orbit, None, [at(-0.01), at(0.03)]);
        assert_eq!(over.wisps(&orbit, 0.01, &strands), [0, 1]);
        assert!(over.direction(&orbit).unwrap().distance(DVec3::X) < 1e-3);
        // It ends where the hand is, on the skin or beside the head.
        let seen = orbit.project(over.end(&orbit).unwrap(), 1.5).unwrap();
        assert!([0, 1].iter().all(|&i| (seen[i] - over.path[10].at[i]).abs() < 1e-9));
        // None of it is before skin that is nearer.
        let skin = Some(DVec3::new(0.0, -0.12, 0.0));
        let hidden = stroke(&orbit, skin, [at(-0.01), at(0.03)]);
        assert_eq!(hidden.end(&orbit), skin);
        assert!(hidden.wisps(&orbit, 0.01, &strands).is_empty());
        assert_eq!(stroke(&orbit, None, [at(0.0), at(0.0)]).direction(&orbit), None);
    }
}
