//! Which wisps an operation is about.

use frisure_rod::Equilibrium;
use glam::DVec3;

use super::error::StyleError;
use super::height::Height;
use crate::guides::Guide;
use crate::head::{Head, Landmarks};
use crate::implantation::Tape;
use crate::parallel;
use crate::spec::{InvalidSpec, Place, range};

/// A choice of wisps.
#[derive(Clone, Debug, PartialEq)]
pub enum Selection {
    /// All.
    Everything,
    /// Those rooted in a part of the scalp.
    Place(Place),
    /// By number, in the order of [`crate::Hairstyle::guides`].
    Wisps(Vec<usize>),
    /// Those rooted above a height, by 3 mm at least: of these a cut at that height leaves something.
    Above(Height),
    /// Those rooted on the side of a plane that its normal points to.
    Beyond {
        /// A point of the plane (m).
        point: DVec3,
        /// Any length but zero.
        normal: DVec3,
    },
    /// Those rooted under a brush drawn over the scalp: near one of its places.
    Brush {
        /// Where it was.
        spots: Vec<Spot>,
        /// Radius of the brush (m).
        radius: f64,
    },
    /// Those of which most of what can be seen lies within a polygon drawn on a picture.
    Lasso(Lasso),
    /// Those in any of these.
    Any(Vec<Selection>),
    /// Those in all of these.
    All(Vec<Selection>),
    /// Those that are not in this one.
    Not(Box<Selection>),
}

/// A place on the skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// The skin nearest to a point (m).
    At(DVec3),
    /// Measured with a tape on the skin (m): across to the head's left, and back from the forehead's
    /// hairline.
    Tape([f64; 2]),
}

/// A polygon drawn on a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Lasso {
    /// The camera.
    pub view: View,
    /// Corners in the picture: from −1 to 1 from left to right and from bottom to top.
    pub polygon: Vec<[f64; 2]>,
    /// Whether it also takes hair that the head hides.
    pub through: bool,
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Its place (m).
    pub eye: DVec3,
    /// The point it looks at (m).
    pub target: DVec3,
    /// Field of view from the picture's bottom to its top (rad).
    pub field_of_view: f64,
    /// Width over height of the picture.
    pub aspect: f64,
}

impl Selection {
    /// Checks what can be checked without a head.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first number that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        let number = |field, x: f64, allowed| range(field, x, -100.0, 100.0, allowed);
        let place = |field, p: DVec3| {
            let allowed = "three numbers within 100 m of the origin";
            p.to_array().into_iter().try_for_each(|x| number(field, x, allowed))
        };
        match self {
            Self::Everything | Self::Place(_) => Ok(()),
            Self::Wisps(wisps) => some("where.wisps", wisps.len()),
            Self::Above(Height::At(z)) => number("where.above", *z, "within 100 m of the origin"),
            Self::Above(Height::Above(_, by)) => {
                range("where.above", *by, -1.0, 1.0, "within 1 m of a level")
            }
            Self::Beyond { point, normal } => {
                place("where.plane.point", *point)?;
                let allowed = "a direction, which has a length between 1e-9 and 1e9";
                range("where.plane.normal", normal.length(), 1e-9, 1e9, allowed)
            }
            Self::Brush { spots, radius } => {
                some("where.brush.at", spots.len())?;
                range("where.brush.radius", *radius, 1e-4, 1.0, "between 0.1 mm and 1 m")?;
                spots.iter().try_for_each(|spot| match *spot {
                    Spot::At(p) => place("where.brush.at", p),
                    Spot::Tape(tape) => {
                        let allowed = "within 100 m";
                        tape.into_iter().try_for_each(|x| number("where.brush.at", x, allowed))
                    }
                })
            }
            Self::Lasso(lasso) => lasso.check(),
            Self::Any(parts) => {
                some("where.any", parts.len())?;
                parts.iter().try_for_each(Self::check)
            }
            Self::All(parts) => {
                some("where.all", parts.len())?;
                parts.iter().try_for_each(Self::check)
            }
            Self::Not(part) => part.check(),
        }
    }

    /// Which wisps of a hairstyle it has; at least one.
    pub(super) fn wisps(
        &self,
        head: &Head,
        guides: &[Guide],
        rest: &[Equilibrium],
    ) -> Result<Vec<bool>, StyleError> {
        let chosen = self.chosen(head, guides, rest)?;
        if chosen.contains(&true) { Ok(chosen) } else { Err(StyleError::NothingSelected) }
    }

    fn chosen(
        &self,
        head: &Head,
        guides: &[Guide],
        rest: &[Equilibrium],
    ) -> Result<Vec<bool>, StyleError> {
        let rooted = |inside: &(dyn Fn(&Guide) -> bool + Sync)| -> Vec<bool> {
            parallel::map_slice(guides, inside)
        };
        let marks = head.landmarks();
        Ok(match self {
            Self::Everything => vec![true; guides.len()],
            Self::Place(place) => rooted(&|g| holds(*place, g, marks)),
            Self::Wisps(wisps) => numbered(wisps, guides.len())?,
            Self::Above(height) => {
                let height = height.on(head) + CLEAR;
                rooted(&|g| g.root.position.z > height)
            }
            Self::Beyond { point, normal } => {
                rooted(&|g| (g.root.position - *point).dot(*normal) > 0.0)
            }
            Self::Brush { spots, radius } => {
                let tape = Tape::new(head);
                let spots: Vec<DVec3> = spots.iter().map(|spot| spot.on(head, &tape)).collect();
                let touched = |p: DVec3| spots.iter().any(|s| s.distance(p) <= *radius);
                rooted(&|g| touched(g.root.position))
            }
            Self::Lasso(lasso) => parallel::map_slice(rest, |r| lasso.holds(head, r)),
            Self::Any(parts) => join(parts, false, head, guides, rest)?,
            Self::All(parts) => join(parts, true, head, guides, rest)?,
            Self::Not(part) => {
                part.chosen(head, guides, rest)?.into_iter().map(|chosen| !chosen).collect()
            }
        })
    }
}

/// A list that chooses has something in it: one that a program left empty must not mean all hair.
fn some(field: &'static str, count: usize) -> Result<(), InvalidSpec> {
    let allowed = "a list of one or more";
    if count > 0 { Ok(()) } else { Err(InvalidSpec { field, value: "empty".into(), allowed }) }
}

/// How far (m) above a height is above it. Chosen.
const CLEAR: f64 = 3e-3;

fn holds(place: Place, guide: &Guide, marks: &Landmarks) -> bool {
    let left = guide.root.position.x > marks.cranium_centre.x;
    match place {
        Place::Everywhere => true,
        Place::Left => left,
        Place::Right => !left,
        Place::Region(region) => guide.region == region,
        Place::LeftOf(region) => guide.region == region && left,
        Place::RightOf(region) => guide.region == region && !left,
    }
}

fn numbered(wisps: &[usize], count: usize) -> Result<Vec<bool>, StyleError> {
    let mut chosen = vec![false; count];
    for &wisp in wisps {
        *chosen.get_mut(wisp).ok_or(StyleError::NoSuchWisp { wisp, count })? = true;
    }
    Ok(chosen)
}

/// Wisps in all of some selections, or in any.
fn join(
    parts: &[Selection],
    all: bool,
    head: &Head,
    guides: &[Guide],
    rest: &[Equilibrium],
) -> Result<Vec<bool>, StyleError> {
    let mut chosen = vec![all; guides.len()];
    for part in parts {
        for (have, more) in chosen.iter_mut().zip(part.chosen(head, guides, rest)?) {
            *have = if all { *have && more } else { *have || more };
        }
    }
    Ok(chosen)
}

impl Spot {
    fn on(self, head: &Head, tape: &Tape<'_>) -> DVec3 {
        match self {
            Self::Tape(place) => tape.at(place),
            Self::At(p) => {
                let (distance, away) = head.signed_distance().value_gradient(p);
                p - away.normalize_or_zero() * distance
            }
        }
    }
}

/// Points along a guide that are looked for in a lasso. Chosen.
const LOOKED_AT: usize = 32;

/// How far (m) in front of a point the head may begin to hide it: hair lies on skin. Chosen by eye.
const HIDING: f64 = 5e-3;

impl Lasso {
    fn check(&self) -> Result<(), InvalidSpec> {
        let View { eye, target, field_of_view, aspect } = self.view;
        let far = "three numbers within 100 m of the origin";
        for x in [eye.to_array(), target.to_array()].concat() {
            range("where.lasso.camera", x, -100.0, 100.0, far)?;
        }
        let away = eye.distance(target);
        range("where.lasso.camera", away, 1e-6, 1e3, "an eye apart from its target")?;
        let lens = "between 0.1 and 179 deg";
        let (least, most) = (0.1_f64.to_radians(), 179_f64.to_radians());
        range("where.lasso.camera.field_of_view", field_of_view, least, most, lens)?;
        range("where.lasso.camera.aspect", aspect, 1e-3, 1e3, "between 0.001 and 1000")?;
        let corners = self.polygon.len() as f64;
        range("where.lasso.polygon", corners, 3.0, 1e5, "of 3 to 100000 corners")?;
        for x in self.polygon.iter().flatten() {
            range("where.lasso.polygon", *x, -1e3, 1e3, "of corners between -1000 and 1000")?;
        }
        Ok(())
    }

    /// Whether more than half of what can be seen of a guide is inside.
    fn holds(&self, head: &Head, guide: &Equilibrium) -> bool {
        let (mut seen, mut inside) = (0, 0);
        for p in guide.centre_line(LOOKED_AT) {
            let Some(place) = self.view.picture(p) else { continue };
            if self.through || !self.view.hidden(head, p) {
                seen += 1;
                inside += usize::from(within(&self.polygon, place));
            }
        }
        2 * inside > seen
    }
}

impl View {
    /// Where a point (m) is in the picture, from −1 to 1; none behind the camera.
    fn picture(&self, p: DVec3) -> Option<[f64; 2]> {
        let forward = (self.target - self.eye).normalize_or(DVec3::Y);
        let up = if forward.z.abs() > 0.999 { DVec3::Y } else { DVec3::Z };
        let right = forward.cross(up).normalize();
        let away = p - self.eye;
        let depth = away.dot(forward);
        let scale = (0.5 * self.field_of_view).tan() * depth;
        let place =
            [away.dot(right) / (scale * self.aspect), away.dot(right.cross(forward)) / scale];
        (depth > 0.0 && place.iter().all(|x| x.is_finite())).then_some(place)
    }

    /// Whether the head is between the eye and a point (m).
    fn hidden(&self, head: &Head, p: DVec3) -> bool {
        let (way, far) = ((self.eye - p).normalize_or(DVec3::Z), self.eye.distance(p));
        let mut gone = HIDING;
        while gone < far.min(1.0) {
            let free = head.signed_distance().value(p + way * gone);
            if free < 0.0 {
                return true;
            }
            gone += free.max(1e-3);
        }
        false
    }
}

/// Whether a point is inside a polygon: whether a ray from it crosses an odd number of sides.
fn within(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let before = polygon.iter().cycle().skip(polygon.len().saturating_sub(1));
    let crossed = |(a, b): &(&[f64; 2], &[f64; 2])| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    polygon.iter().zip(before).filter(crossed).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polygon_holds_what_is_inside() {
        // An L.
        let polygon = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        assert!(within(&polygon, [0.5, 1.5]) && within(&polygon, [1.5, 0.5]));
        assert!(!within(&polygon, [1.5, 1.5]) && !within(&polygon, [-0.5, 0.5]));
    }

    #[test]
    fn the_picture_of_a_view_is_that_of_a_pinhole() {
        let view = View {
            eye: DVec3::new(0.0, -1.0, 0.0),
            target: DVec3::ZERO,
            field_of_view: std::f64::consts::FRAC_PI_2,
            aspect: 2.0,
        };
        let [x, y] = view.picture(DVec3::new(0.5, 0.0, 0.25)).unwrap();
        assert!((x - 0.25).abs() < 1e-12 && (y - 0.25).abs() < 1e-12, "{x} {y}");
        assert_eq!(view.picture(DVec3::new(0.0, -2.0, 0.0)), None);
    }
}
