//! The cutting plane, and a preview of the hair that it would cut off.

use frisure_engine::StrandsData;
use glam::{DVec3, Vec3};

/// A plane; hair on the side of its normal is cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutPlane {
    /// Its middle (m).
    pub point: DVec3,
    /// Tilt to the head's left (rad): a positive one leaves more hair there.
    pub roll: f64,
    /// Tilt to the back (rad): a positive one leaves more hair there.
    pub pitch: f64,
}

/// Maximum tilt (rad); less than vertical.
const MAX_LEAN: f64 = 1.4;
/// Maximum distance from the origin (m); beyond the longest hair.
const MAX_DISTANCE: f64 = 2.0;

impl Default for CutPlane {
    fn default() -> Self {
        Self::level(-0.1)
    }
}

impl CutPlane {
    /// A level plane at a height (m).
    #[must_use]
    pub fn level(z: f64) -> Self {
        let point = DVec3::new(0.0, 0.0, z);
        Self { point, roll: 0.0, pitch: 0.0 }
    }

    /// The unit normal, which points to the hair that is cut off.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        let (sr, cr) = self.roll.sin_cos();
        let (sp, cp) = self.pitch.sin_cos();
        DVec3::new(-sr * cp, -sp * cr, -cr * cp).normalize()
    }

    /// Moves it against its normal (m): up, for a level plane.
    pub fn raise(&mut self, by: f64) {
        if by.is_finite() {
            self.point = (self.point - by * self.normal()).clamp_length_max(MAX_DISTANCE);
        }
    }

    /// Tilts it by angles (rad).
    pub fn tilt(&mut self, roll: f64, pitch: f64) {
        if roll.is_finite() && pitch.is_finite() {
            self.roll = (self.roll + roll).clamp(-MAX_LEAN, MAX_LEAN);
            self.pitch = (self.pitch + pitch).clamp(-MAX_LEAN, MAX_LEAN);
        }
    }

    /// A preview of the cut of the drawn strands of some wisps (`None`: of all).
    #[must_use]
    pub fn preview(&self, strands: &StrandsData, wisps: Option<&[bool]>) -> CutPreview {
        let (point, normal) = (self.point.as_vec3(), self.normal().as_vec3());
        let (points, _) = strands.points.as_chunks();
        let beyond = |p: &[f32; 3]| (Vec3::from_array(*p) - point).dot(normal);
        let mut kept = Vec::with_capacity(strands.guide.len());
        let (mut cut_off, mut all) = (0.0_f64, 0.0_f64);
        for (ends, guide) in strands.offsets.windows(2).zip(&strands.guide) {
            let distances: Vec<f32> =
                points[ends[0] as usize..ends[1] as usize].iter().map(beyond).collect();
            let is_selected =
                wisps.is_none_or(|w| w.get(*guide as usize).copied().unwrap_or(false));
            let pieces = distances.len().saturating_sub(1).max(1) as f32;
            let part = if is_selected { kept_pieces(&distances) / pieces } else { 1.0 };
            all += f64::from(pieces);
            cut_off += f64::from(pieces) * f64::from(1.0 - part);
            kept.push(part);
        }
        let hairs = kept.iter().filter(|part| **part < 1.0).count();
        CutPreview { kept, share: if all > 0.0 { cut_off / all } else { 0.0 }, hairs }
    }
}

/// The pieces of a strand before it first crosses the plane, from the signed distances of its points. A strand
/// whose root is beyond the plane is cut where it crosses the plane again.
fn kept_pieces(distances: &[f32]) -> f32 {
    let crossing = distances.windows(2).position(|d| d[0] <= 0.0 && d[1] > 0.0);
    crossing.map_or(distances.len().saturating_sub(1) as f32, |k| {
        let [before, after] = [distances[k], distances[k + 1]];
        k as f32 + before / (before - after)
    })
}

/// Rounds each coordinate; −0 becomes 0.
pub(super) fn rounded(v: DVec3, to: f64) -> DVec3 {
    let steps = (1.0 / to).round();
    (v * steps).round() / steps + DVec3::ZERO
}

/// The preview of a cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutPreview {
    /// For each strand, the fraction of its length that remains.
    pub kept: Vec<f32>,
    /// Fraction of the length of all drawn strands that is cut off.
    pub share: f64,
    /// Number of drawn strands that are cut.
    pub hairs: usize,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hairs of 10 cm that hang straight down from height 0, with points every centimetre.
    fn curtain(count: usize) -> StrandsData {
        let mut strands = StrandsData { offsets: vec![0], ..Default::default() };
        for i in 0..count {
            for k in 0..11 {
                strands.points.extend([0.01 * i as f32, 0.0, -0.01 * k as f32]);
                strands.radii.push(4e-5);
            }
            strands.offsets.push(strands.radii.len() as u32);
            strands.guide.push(i as u32);
        }
        strands
    }

    #[test]
    fn a_level_plane_cuts_off_what_is_below_it() {
        let strands = curtain(4);
        let preview = CutPlane::level(-0.025).preview(&strands, None);
        assert_eq!(preview.hairs, 4);
        assert!(preview.kept.iter().all(|f| (f - 0.25).abs() < 1e-5), "{preview:?}");
        assert!((preview.share - 0.75).abs() < 1e-6);
        let one = CutPlane::level(-0.025).preview(&strands, Some(&[true, false, false, false]));
        assert_eq!(one.hairs, 1);
    }

    #[test]
    fn a_tilted_plane_leaves_more_hair_on_the_side_it_leans_to() {
        let mut plane = CutPlane::level(-0.05);
        plane.tilt(0.5, 0.0);
        let preview = plane.preview(&curtain(4), None);
        assert!(preview.kept.windows(2).all(|f| f[0] < f[1]), "{:?}", preview.kept);
    }
}
