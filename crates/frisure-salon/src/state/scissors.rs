//! Scissors, clippers and fingers that lift hair: what the cutting tools do to the hair under them.

use std::f64::consts::FRAC_PI_2;

use frisure::hairstyle::styling::{Cut, CutLine, Held, Operation};
use frisure_engine::StrandsData;
use glam::{DVec3, Vec3};

use super::cut_plane::rounded;
use super::head_mesh::HeadMesh;
use super::orbit::Orbit;

/// How the scissors and the clippers are set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scissors {
    /// The position of the hair during a cut at a line.
    pub hold: CutHold,
    /// How far before the line hairs end, by chance (m).
    pub soft: f64,
    /// The fraction of hairs that is cut; thinning scissors leave the others.
    pub share: f64,
    /// Angle (rad) from flat along the skin at which fingers lift hair.
    pub elevation: f64,
    /// How far from the skin lifted hair is cut (m).
    pub lifted: f64,
    /// What the guard of the clippers leaves (m).
    pub guard: f64,
}

/// The position of hair while scissors cut it at a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CutHold {
    /// As it hangs.
    #[default]
    Hanging,
    /// As it hangs, and again until it rests at the line.
    Resting,
    /// Combed straight down. \[paper\] §3.2
    Down,
}

impl CutHold {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Hanging, Self::Resting, Self::Down];

    /// The message that names it.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Hanging => "cut-hanging",
            Self::Resting => "cut-resting",
            Self::Down => "cut-down",
        }
    }
}

impl Default for Scissors {
    /// A blunt cut; layers of 8 cm; a guard of 6 mm.
    fn default() -> Self {
        Self {
            hold: CutHold::Hanging,
            soft: 0.0,
            share: 1.0,
            elevation: FRAC_PI_2,
            lifted: 0.08,
            guard: 6e-3,
        }
    }
}

impl Scissors {
    /// The same with every number in its range.
    #[must_use]
    pub fn clean(self) -> Self {
        let within =
            |x: f64, low: f64, high: f64| if x.is_nan() { low } else { x.clamp(low, high) };
        Self {
            hold: self.hold,
            soft: within(self.soft, 0.0, 0.1),
            share: within(self.share, 0.05, 1.0),
            elevation: within(self.elevation, 0.0, std::f64::consts::PI),
            lifted: within(self.lifted, 5e-3, 1.0),
            guard: within(self.guard, 1e-3, 0.05),
        }
    }

    /// The operation that cuts all hair at a plane; what is on the side of the normal falls.
    #[must_use]
    pub fn at_plane(&self, point: DVec3, normal: DVec3) -> Operation {
        let held = match self.hold {
            CutHold::Hanging | CutHold::Resting => Held::Hanging,
            CutHold::Down => Held::Down,
        };
        // 0.1 mm and 0.01° are finer than a pointer.
        let line = CutLine::Plane { point: rounded(point, 1e-4), normal: rounded(normal, 1e-4) };
        let resting = self.hold == CutHold::Resting;
        self.cut(Cut { line, held, resting, ..Cut::default() })
    }

    /// The operation that cuts hair which fingers lift off the skin.
    #[must_use]
    pub fn lifted(&self) -> Operation {
        let degree = std::f64::consts::PI / 180.0;
        let held = Held::Elevated((self.elevation / degree).round() * degree);
        self.cut(Cut { line: off_skin(self.lifted), held, ..Cut::default() })
    }

    /// Where lifted hair that is rooted at `root` (m), where the skin has this normal, ends at the scissors (m).
    #[must_use]
    pub fn lifted_end(&self, root: DVec3, normal: DVec3) -> DVec3 {
        let down = (DVec3::NEG_Z + normal * normal.z).normalize_or(DVec3::Y);
        root + self.lifted * (down * self.elevation.cos() + normal * self.elevation.sin())
    }

    /// The operation of clippers, which cut hair straight off the skin.
    #[must_use]
    pub fn clippers(&self) -> Operation {
        let held = Held::Elevated(FRAC_PI_2);
        Operation::Cut(Cut { line: off_skin(self.guard), held, ..Cut::default() })
    }

    fn cut(&self, cut: Cut) -> Operation {
        let rounded = |x: f64| (x * 1e4).round() / 1e4;
        Operation::Cut(Cut { point_cut: rounded(self.soft), share: rounded(self.share), ..cut })
    }
}

/// A line off the skin (m), to a tenth of a millimetre.
fn off_skin(distance: f64) -> CutLine {
    CutLine::OffSkin((distance * 1e4).round() / 1e4)
}

/// A straight stroke of scissors across the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snip {
    /// Where it begins and ends in the picture: −1 to 1, right and up.
    pub ends: [[f64; 2]; 2],
    /// Width over height of the picture.
    pub aspect: f64,
}

impl Snip {
    /// Shortest stroke, as a fraction of half the picture's height: shorter ones are clicks. Chosen by trial.
    const SHORTEST: f64 = 0.02;

    /// The plane through the eye and the stroke: a point (m) and the unit normal, away from `kept` (m), the side of the hair that
    /// stays. `None` for a click.
    #[must_use]
    pub fn plane(&self, orbit: &Orbit, kept: DVec3) -> Option<(DVec3, DVec3)> {
        let [a, b] = self.ends;
        if ((a[0] - b[0]) * self.aspect).hypot(a[1] - b[1]) < Self::SHORTEST {
            return None;
        }
        let [(eye, from), (_, to)] = self.ends.map(|end| orbit.ray(end, self.aspect));
        let normal = from.cross(to).try_normalize()?;
        let away = if (kept - eye).dot(normal) > 0.0 { -normal } else { normal };
        // A point near the hair, where rounding the plane's point moves the cut least.
        Some((eye + orbit.distance * (from + to).normalize_or(from), away))
    }

    /// The wisps of which half or more of the drawn strands that the stroke crosses can be seen there.
    #[must_use]
    pub fn wisps(
        &self,
        orbit: &Orbit,
        strands: &StrandsData,
        head: Option<&HeadMesh>,
    ) -> Vec<usize> {
        let count = strands.guide.iter().max().map_or(0, |most| *most as usize + 1);
        let (mut crossed, mut seen) = (vec![0_u32; count], vec![0_u32; count]);
        let (points, _) = strands.points.as_chunks::<3>();
        let eye = orbit.eye();
        for (ends, guide) in strands.offsets.windows(2).zip(&strands.guide) {
            let points = &points[ends[0] as usize..ends[1] as usize];
            let Some(at) = self.crossing(orbit, points) else { continue };
            let wisp = *guide as usize;
            crossed[wisp] += 1;
            // A few of each wisp say whether the head hides it.
            if crossed[wisp] > Self::LOOKED_AT {
                continue;
            }
            let way = at - eye;
            let hidden = head.and_then(|head| head.hit(eye, way.normalize_or_zero()));
            seen[wisp] += u32::from(hidden.is_none_or(|hit| hit.distance(eye) > way.length()));
        }
        let half = |wisp: &usize| {
            let looked_at = crossed[*wisp].min(Self::LOOKED_AT);
            looked_at > 0 && 2 * seen[*wisp] >= looked_at
        };
        (0..count).filter(half).collect()
    }

    /// Strands of a wisp that are looked at. Chosen: a head has 90 000 faces.
    const LOOKED_AT: u32 = 5;

    /// Where (m) a strand first crosses the stroke in the picture.
    fn crossing(&self, orbit: &Orbit, points: &[[f32; 3]]) -> Option<DVec3> {
        let place = |p: &[f32; 3]| Vec3::from_array(*p).as_dvec3();
        let [a, b] = self.ends;
        let side = |p: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        let mut before = orbit.project(place(points.first()?), self.aspect)?;
        for pair in points.windows(2) {
            let now = orbit.project(place(&pair[1]), self.aspect)?;
            let (first, second) = (side(before), side(now));
            if (first < 0.0) != (second < 0.0) {
                let t = first / (first - second);
                let at = [0, 1].map(|axis| before[axis] + t * (now[axis] - before[axis]));
                // Along the stroke, 0 at its begin and 1 at its end.
                let (along, across) = (b[0] - a[0], b[1] - a[1]);
                let u = ((at[0] - a[0]) * along + (at[1] - a[1]) * across)
                    / (along * along + across * across);
                if (0.0..=1.0).contains(&u) {
                    return Some(place(&pair[0]).lerp(place(&pair[1]), t));
                }
            }
            before = now;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strands that hang from (x, −0.1, 0.1) to 20 cm lower.
    fn hanging(xs: &[f32]) -> StrandsData {
        let mut strands = StrandsData { offsets: vec![0], ..StrandsData::default() };
        for (i, x) in xs.iter().enumerate() {
            for k in 0..21 {
                strands.points.extend([*x, -0.1, 0.1 - 0.01 * k as f32]);
            }
            strands.offsets.push(21 * (i as u32 + 1));
            strands.guide.push(i as u32);
        }
        strands
    }

    #[test]
    fn a_stroke_cuts_the_wisps_that_it_crosses_below_it() {
        let orbit = Orbit { azimuth: 0.0, elevation: 0.0, ..Orbit::default() };
        let at = |x: f64| orbit.project(DVec3::new(x, -0.1, 0.0), 1.5).unwrap();
        let snip = Snip { ends: [at(-0.01), at(0.03)], aspect: 1.5 };
        let strands = hanging(&[-0.04, 0.0, 0.02, 0.06]);
        assert_eq!(snip.wisps(&orbit, &strands, None), [1, 2]);
        let (point, normal) = snip.plane(&orbit, DVec3::Z * 0.11).unwrap();
        assert!(normal.z < -0.9, "what is below falls: {normal}");
        let height = (DVec3::new(0.0, -0.1, 0.0) - point).dot(normal);
        assert!(height.abs() < 1e-9, "{height}");
        // A stroke beside the head takes what is outside of it.
        let upright = [[0.1, -0.05], [0.1, 0.05]]
            .map(|[x, z]| orbit.project(DVec3::new(x, -0.1, z), 1.5).unwrap());
        let (_, out) = Snip { ends: upright, aspect: 1.5 }.plane(&orbit, DVec3::Z * 0.11).unwrap();
        assert!(out.x > 0.9, "{out}");
        let click = Snip { ends: [at(0.0), at(0.0)], aspect: 1.5 };
        assert_eq!(click.plane(&orbit, DVec3::Z), None);
    }

    #[test]
    fn numbers_stay_in_their_ranges() {
        let wild = Scissors { soft: f64::NAN, share: -3.0, guard: 9.0, ..Scissors::default() };
        let tame = wild.clean();
        assert_eq!((tame.soft, tame.share, tame.guard), (0.0, 0.05, 0.05));
        for operation in [tame.lifted(), tame.clippers(), tame.at_plane(DVec3::ZERO, DVec3::NEG_Z)]
        {
            assert_eq!(operation.check(), Ok(()));
        }
    }
}
