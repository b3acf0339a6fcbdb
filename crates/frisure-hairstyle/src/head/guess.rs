//! Finding the landmarks of an unknown head.

use frisure_strands::Surface;
use glam::{DMat3, DVec3};

use super::landmarks::Landmarks;

impl Landmarks {
    /// Measures a head mesh in our frame (m), of any size near human, that `upright` stands upright.
    pub(crate) fn guess_leaning(surface: &Surface, upright: DMat3) -> Self {
        let turned = surface.positions().iter().map(|p| upright * *p).collect();
        let turned = Surface::new(turned, surface.triangles().to_vec());
        let marks = Self::guess(&turned.expect("a rotation keeps a surface valid"));
        let back = |p: DVec3| upright.transpose() * p;
        Self {
            cranium_centre: back(marks.cranium_centre),
            whorl: back(marks.whorl),
            upright,
            face: back(marks.face),
            hairline: back(marks.hairline),
            brow: back(marks.brow),
            ear: back(marks.ear),
            nape: back(marks.nape),
            ..marks
        }
    }

    /// Measures a head mesh in our frame (m), of any size near human, that stands upright.
    pub(crate) fn guess(surface: &Surface) -> Self {
        let (low, high) = surface.bounds();
        let (middle, top) = (0.5 * (low.x + high.x), high.z);
        let (cranium, scale) = Cranium::with_scale(surface.positions(), middle, top);
        cranium.landmarks(surface, middle, top, scale)
    }
}

/// Height of the vertex above the cranium's centre (m at scale 1), that of the mannequin.
const ABOVE_CENTRE: f64 = 0.108;

/// Box of the skull between the ears and the vertex (m).
#[derive(Clone, Copy, Default)]
pub(super) struct Cranium {
    half_width: f64,
    half_depth: f64,
    middle_y: f64,
}

impl Cranium {
    /// The centre of the cranium (m) and the size of the head against the mannequin's, from points of its skin.
    pub(super) fn place(points: &[DVec3]) -> (DVec3, f64) {
        let bounds = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = points.iter().fold(bounds, |(a, b), p| (a.min(p.x), b.max(p.x)));
        let top = points.iter().fold(f64::NEG_INFINITY, |a, p| a.max(p.z));
        let middle = 0.5 * (low + high);
        let (cranium, scale) = Self::with_scale(points, middle, top);
        (DVec3::new(middle, cranium.middle_y, top - ABOVE_CENTRE * scale), scale)
    }

    /// The measures, and the size of the head against the mannequin's.
    fn with_scale(points: &[DVec3], middle: f64, top: f64) -> (Self, f64) {
        let (mut scale, mut cranium) = (1.0, Self::default());
        // Where to measure depends on the size, and the size on the measures.
        for _ in 0..4 {
            cranium = Self::measure(points, middle, top, scale);
            scale =
                (0.5 * (cranium.half_width / 0.0735 + cranium.half_depth / 0.0965)).clamp(0.4, 2.0);
        }
        (cranium, scale)
    }

    fn measure(points: &[DVec3], middle: f64, top: f64, scale: f64) -> Self {
        let band = |from: f64, to: f64| {
            let p = points.iter();
            p.filter(move |p| p.z < top - from * scale && p.z > top - to * scale)
        };
        // Above the ears for the width, from brow to occiput for the depth.
        let half_width = band(0.05, 0.088).map(|p| (p.x - middle).abs()).fold(0.0, f64::max);
        let (front, back) = band(0.05, 0.095)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p.y), b.max(p.y)));
        if !(front < back) {
            return Self { half_width: 0.0735 * scale, half_depth: 0.0965 * scale, middle_y: 0.0 };
        }
        Self { half_width, half_depth: 0.5 * (back - front), middle_y: 0.5 * (back + front) }
    }

    fn landmarks(self, surface: &Surface, middle: f64, top: f64, scale: f64) -> Landmarks {
        // Proportions of an adult head, those of the mannequin (m at scale 1).
        let centre = DVec3::new(middle, self.middle_y, top - ABOVE_CENTRE * scale);
        let at = |x: f64, forward: f64, z: f64| centre + DVec3::new(x, -forward, z) * scale;
        let brow_z = brow_height(surface, middle, centre, scale);
        let ear = find_ear(surface, centre, self.half_width, scale)
            .unwrap_or_else(|| at(self.half_width / scale, -0.012, -0.02));
        let skin = |guess: DVec3| nearest_on_line(surface, centre, guess);
        Landmarks {
            cranium_centre: centre,
            cranium_radii: DVec3::new(self.half_width, self.half_depth, ABOVE_CENTRE * scale),
            whorl: skin(at(0.0, -0.069, 0.079)),
            upright: DMat3::IDENTITY,
            face: -DVec3::Y,
            width: 2.0 * self.half_width,
            hairline: skin(DVec3::new(middle, centre.y - 0.083 * scale, brow_z + 0.056 * scale)),
            brow: skin(DVec3::new(middle, centre.y - 0.098 * scale, brow_z)),
            ear,
            nape: skin(at(0.0, -0.064, -0.088)),
        }
    }
}

/// Height between the brows (m): the nose's root is where the profile starts to come forward below
/// the forehead; without a nose, a proportion of the head.
fn brow_height(surface: &Surface, middle: f64, centre: DVec3, scale: f64) -> f64 {
    let usual = centre.z + 0.013 * scale;
    let front = surface.positions().iter().filter(|p| {
        (p.x - middle).abs() < 0.02 * scale && (p.z - centre.z + 0.04 * scale).abs() < 0.04 * scale
    });
    let Some(tip) = front.min_by(|a, b| a.y.total_cmp(&b.y)) else { return usual };
    let proud = centre.y - tip.y > 0.1 * scale;
    let guess = tip.z + 0.052 * scale;
    if proud { guess.clamp(usual - 0.02 * scale, usual + 0.02 * scale) } else { usual }
}

/// Height above the cranium's centre (m at scale 1) below which an ear is: that of the brows. Higher up the skull is wider behind the
/// ears than above them, and stands out too.
const EAR_TOP: f64 = 0.015;

/// Middle of what stands out beside the skull, mirrored to the left; none on a head without ears.
fn find_ear(surface: &Surface, centre: DVec3, half_width: f64, scale: f64) -> Option<DVec3> {
    let out = half_width + 0.004 * scale;
    // What stands out sideways by 4 mm and more between brows and jaw; the ear if it is 2.5 to 9 cm high.
    let (mut low, mut high, mut any) = (DVec3::INFINITY, DVec3::NEG_INFINITY, false);
    for p in surface.positions() {
        let d = *p - centre;
        let beside = (-0.075 * scale..EAR_TOP * scale).contains(&d.z) && d.y.abs() < 0.06 * scale;
        if beside && d.x.abs() > out {
            let q = DVec3::new(d.x.abs(), d.y, d.z);
            (low, high, any) = (low.min(q), high.max(q), true);
        }
    }
    let size = high - low;
    let plausible = any && size.z > 0.025 * scale && size.z < 0.09 * scale;
    plausible
        .then(|| centre + DVec3::new(half_width, 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)))
}

/// Where the ray from `centre` through `guess` leaves the skin, or `guess`.
fn nearest_on_line(surface: &Surface, centre: DVec3, guess: DVec3) -> DVec3 {
    let ray = (guess - centre).normalize_or(DVec3::Z);
    let hits = (0..surface.triangles().len()).filter_map(|f| hit(centre, ray, surface.corners(f)));
    hits.max_by(f64::total_cmp).map_or(guess, |t| centre + ray * t)
}

/// Distance along a ray to a triangle. [Möller and Trumbore 1997]
fn hit(from: DVec3, ray: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (e, f) = (b - a, c - a);
    let h = ray.cross(f);
    // Parallel to the face, within rounding of areas of m².
    let det = e.dot(h);
    if det.abs() < 1e-18 {
        return None;
    }
    let s = from - a;
    let u = s.dot(h) / det;
    let q = s.cross(e);
    let v = ray.dot(q) / det;
    let t = f.dot(q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::{mannequin, read_obj};
    use crate::head::{Head, ScalpSource};

    fn scaled(scale: f64, shift: DVec3) -> Surface {
        let surface = mannequin().surface();
        let positions = surface.positions().iter().map(|p| *p * scale + shift).collect();
        Surface::new(positions, surface.triangles().to_vec()).unwrap()
    }

    #[test]
    fn the_mannequin_is_measured_as_it_was_made() {
        let known = mannequin().landmarks();
        for (scale, shift) in [(1.0, DVec3::ZERO), (0.85, DVec3::new(0.3, -1.0, 1.6))] {
            let found = Landmarks::guess(&scaled(scale, shift));
            let close = |name: &str, a: DVec3, b: DVec3, tolerance: f64| {
                let b = b * scale + shift;
                assert!(a.distance(b) < tolerance, "{name}: {a}, not {b}");
            };
            close("centre", found.cranium_centre, known.cranium_centre, 0.01);
            close("hairline", found.hairline, known.hairline, 0.012);
            close("brow", found.brow, known.brow, 0.012);
            close("ear", found.ear, known.ear, 0.015);
            close("nape", found.nape, known.nape, 0.02);
            close("whorl", found.whorl, known.whorl, 0.01);
            assert!((found.width / (scale * known.width) - 1.0).abs() < 0.05);
        }
    }

    /// Real busts, in a folder of `*.obj` named by `FRISURE_TEST_HEADS` (metres, y up, z forward).
    #[test]
    #[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
    fn real_busts_get_a_scalp_and_are_solid() {
        let Some(folder) = std::env::var_os("FRISURE_TEST_HEADS") else {
            eprintln!("skipped: set FRISURE_TEST_HEADS to a folder of head meshes (*.obj)");
            return;
        };
        for file in std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()) {
            if file.extension().is_some_and(|e| e == "obj") {
                let surface = read_obj(&std::fs::read_to_string(&file).unwrap());
                let head = Head::from_surface(surface, ScalpSource::Guess).unwrap();
                check_bust(&head);
            }
        }
    }

    fn check_bust(head: &Head) {
        let l = head.landmarks();
        let value = |forward: f64, z: f64| {
            head.signed_distance().value(l.cranium_centre + DVec3::new(0.0, -forward, z))
        };
        // Empty eye sockets count as outside: nearer than the skull's sides.
        assert!(value(0.0, 0.0) < -0.045, "{}", value(0.0, 0.0));
        // The mouth's bag is behind the lips, and the neck is closed at its cut.
        assert!(value(0.06, -0.065) < -5e-3, "{}", value(0.06, -0.065));
        assert!(value(0.0, -0.1) < -0.02, "{}", value(0.0, -0.1));
        assert!(value(0.0, -0.4) > 0.05, "{}", value(0.0, -0.4));
        let weight = |t: &[u32; 3]| t.iter().map(|&v| head.scalp()[v as usize]).sum::<f64>() / 3.0;
        let area = |i: usize| 0.5 * head.surface().doubled_area_vector(i).length();
        let faces = head.surface().triangles().iter().enumerate();
        let scalp: f64 = faces.map(|(i, t)| area(i) * weight(t)).sum();
        assert!((0.04..0.075).contains(&scalp), "{scalp}");
    }
}
