//! The scene that both renderers draw: strands, head, camera, lights, materials.

use std::borrow::Cow;

use frisure_look::{Camera, Lights, Look};
use frisure_strands::{AccessoryMesh, Attribute, AttributeValues, Domain, Strands, Surface};
use glam::DVec3;

/// Everything that a picture shows.
///
/// Three attributes of the strands are used where they are present: `guide` (u32 per strand), whose
/// wisps then differ slightly in pigment; `tint` (f32 per strand), a factor on the pigment that
/// replaces all variation of our own; `wetness` (f32 per point, 0 to 1), which darkens the hair and
/// sharpens its highlights.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// The hair. Strands with fewer than two points or with a coordinate or radius that is not
    /// finite are left out.
    pub strands: &'a Strands,
    /// The head, which hides hair and is hidden by it; none draws hair alone.
    pub surface: Option<&'a Surface>,
    /// What holds the hair, which hides it and casts shadows as the head does.
    pub accessories: &'a [AccessoryMesh],
    /// The camera.
    pub camera: Camera,
    /// The lights.
    pub lights: Lights,
    /// The materials.
    pub look: Look,
}

/// Attribute of strands: a factor on their pigment beside `tint`.
pub(crate) const PIGMENT: &str = "frisure:pigment";

/// Pigment of brows and of lashes over that of hair: those of fair people are darker than their hair, lashes most. Chosen by eye.
const BROW_PIGMENT: f32 = 4.0;
pub(crate) const LASH_PIGMENT: f32 = 16.0;

impl<'a> Scene<'a> {
    /// The scene in the default look, framed from the three-quarter front view of a portrait for a
    /// square picture, in a studio that turns with that camera.
    #[must_use]
    pub fn portrait(strands: &'a Strands, surface: Option<&'a Surface>) -> Self {
        let camera = Camera::framing(framed_bounds(strands, surface), 0.5, 0.08, 1.0);
        let lights = Lights::studio(&camera);
        Self { strands, surface, accessories: &[], camera, lights, look: Look::default() }
    }
}

impl Scene<'_> {
    /// The hair together with the brows and lashes of the head, which have its colour, only darker: the attribute `frisure:pigment` says by
    /// how much.
    ///
    /// # Panics
    /// As [`Strands::followed_by`].
    #[must_use]
    pub fn all_hair(&self) -> Cow<'_, Strands> {
        all_hair(self.strands, self.surface)
    }

    /// The head with the accessories as one mesh; none if there is neither.
    #[must_use]
    pub fn all_surfaces(&self) -> Option<Cow<'_, Surface>> {
        if self.accessories.is_empty() {
            return self.surface.map(Cow::Borrowed);
        }
        Surface::with_accessories(self.surface, self.accessories).map(Cow::Owned)
    }
}

/// The strands, followed by the brows and lashes of a head; see [`Scene::all_hair`].
///
/// # Panics
/// As [`Strands::followed_by`].
#[must_use]
pub fn all_hair<'a>(strands: &'a Strands, surface: Option<&Surface>) -> Cow<'a, Strands> {
    let features = surface.and_then(Surface::features);
    let Some(features) = features.filter(|features| !features.hairs.is_empty()) else {
        return Cow::Borrowed(strands);
    };
    let mut all = strands.followed_by(&features.hairs).with_attributes(|name| name != PIGMENT);
    let mut factors = vec![1.0; strands.len()];
    factors.resize(all.len() - features.lashes.min(features.hairs.len()), BROW_PIGMENT);
    factors.resize(all.len(), LASH_PIGMENT);
    let values = AttributeValues::F32(factors);
    all.set_attribute(Attribute { name: PIGMENT.into(), domain: Domain::Strand, values })
        .expect("one value for each strand, of a name that is free");
    Cow::Owned(all)
}

/// How many strands at the end are brows and lashes, which [`all_hair`] has added. They are all there, however few hairs of the head are
/// drawn, and so are never drawn wider than they are.
#[must_use]
pub fn facial_hairs(strands: &Strands) -> usize {
    match strands.attribute(PIGMENT).map(|attribute| &attribute.values) {
        Some(AttributeValues::F32(factors)) => {
            factors.iter().rev().take_while(|&&factor| factor > 1.0).count()
        }
        _ => 0,
    }
}

/// The box (smallest and largest corner, m) that a picture of this hair should show, for
/// [`Camera::framing`]: all finite points of the strands, and of the surface its upper 0.27 m, the
/// head without the shoulders. Without strands it is the whole surface; without either, a box around
/// a head at the origin.
#[must_use]
pub fn framed_bounds(strands: &Strands, surface: Option<&Surface>) -> (DVec3, DVec3) {
    let hair = enclose(strands.points().iter().map(|p| p.as_dvec3()).filter(|p| p.is_finite()));
    let head = surface.and_then(|surface| {
        let top = surface.bounds().1.z;
        let shown = |p: &DVec3| hair.is_none() || p.z > top - HEAD;
        enclose(surface.positions().iter().copied().filter(shown))
    });
    match (hair, head) {
        (Some(a), Some(b)) => (a.0.min(b.0), a.1.max(b.1)),
        (Some(all), None) | (None, Some(all)) => all,
        (None, None) => (DVec3::splat(-0.15), DVec3::splat(0.15)),
    }
}

/// The middle of the head (m), or of the hair where there is no head: what lamps are aimed at.
#[must_use]
pub fn head_centre(strands: &Strands, surface: Option<&Surface>) -> DVec3 {
    let head = surface.and_then(|surface| {
        let top = surface.bounds().1.z;
        enclose(surface.positions().iter().copied().filter(|p| p.z > top - HEAD))
    });
    let (low, high) = head.unwrap_or_else(|| framed_bounds(strands, None));
    0.5 * (low + high)
}

/// From the crown to below the chin (m). That of the mannequin and a margin.
const HEAD: f64 = 0.27;

/// The box around some points; `None` without points.
fn enclose(mut points: impl Iterator<Item = DVec3>) -> Option<(DVec3, DVec3)> {
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
}
