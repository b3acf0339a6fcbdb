//! The same on the other side of the head: left and right change places (x becomes −x).

use glam::DVec3;

use super::operations::Operation;
use super::selection::{Lasso, Selection, Spot, View};
use crate::spec::Place;

impl Operation {
    /// The operation on the other side of the head, in the head's frame. `opposite` names the counterpart of a wisp by number, for
    /// example the one rooted nearest to its mirrored root.
    ///
    /// ```
    /// use frisure_hairstyle::styling::{Clip, Operation};
    /// use glam::DVec3;
    ///
    /// let clip = Clip { to: DVec3::new(0.08, 0.02, 0.1), ..Clip::default() };
    /// let Operation::Clip(other) = Operation::from(clip).mirrored(&|wisp| wisp) else { panic!("a clip") };
    /// assert_eq!(other.to, DVec3::new(-0.08, 0.02, 0.1));
    /// ```
    #[must_use]
    pub fn mirrored(&self, opposite: &dyn Fn(usize) -> usize) -> Self {
        let mut other = self.clone();
        if let Some(selection) = other.selection_mut() {
            *selection = selection.mirrored(opposite);
        }
        other.inner_mut().mirror();
        other
    }
}

impl Selection {
    /// The counterpart on the other side of the head, in the head's frame; `opposite` names that of a wisp by number.
    #[must_use]
    pub fn mirrored(&self, opposite: &dyn Fn(usize) -> usize) -> Self {
        let each = |parts: &[Self]| parts.iter().map(|part| part.mirrored(opposite)).collect();
        match self {
            Self::Everything => Self::Everything,
            Self::Place(place) => Self::Place(mirrored_place(*place)),
            Self::Wisps(wisps) => {
                let mut others: Vec<usize> = wisps.iter().map(|wisp| opposite(*wisp)).collect();
                others.sort_unstable();
                others.dedup();
                Self::Wisps(others)
            }
            Self::Above(height) => Self::Above(*height),
            Self::Beyond { point, normal } => {
                Self::Beyond { point: mirrored(*point), normal: mirrored(*normal) }
            }
            Self::Brush { spots, radius } => {
                let spot = |spot: &Spot| match *spot {
                    Spot::At(p) => Spot::At(mirrored(p)),
                    Spot::Tape([across, back]) => Spot::Tape([-across, back]),
                };
                Self::Brush { spots: spots.iter().map(spot).collect(), radius: *radius }
            }
            Self::Lasso(lasso) => Self::Lasso(mirrored_lasso(lasso)),
            Self::Any(parts) => Self::Any(each(parts)),
            Self::All(parts) => Self::All(each(parts)),
            Self::Not(part) => Self::Not(Box::new(part.mirrored(opposite))),
        }
    }
}

/// A place (m) or a direction on the other side.
pub(super) fn mirrored(p: DVec3) -> DVec3 {
    // Adding 0 turns −0 into 0, which texts do not tell apart.
    DVec3::new(-p.x, p.y, p.z) + DVec3::ZERO
}

fn mirrored_place(place: Place) -> Place {
    match place {
        Place::Left => Place::Right,
        Place::Right => Place::Left,
        Place::LeftOf(region) => Place::RightOf(region),
        Place::RightOf(region) => Place::LeftOf(region),
        place @ (Place::Region(_) | Place::Everywhere) => place,
    }
}

/// The camera changes sides, and so do left and right of its picture.
fn mirrored_lasso(lasso: &Lasso) -> Lasso {
    let View { eye, target, .. } = lasso.view;
    let view = View { eye: mirrored(eye), target: mirrored(target), ..lasso.view };
    let polygon = lasso.polygon.iter().map(|[x, y]| [-x + 0.0, *y]).collect();
    Lasso { view, polygon, through: lasso.through }
}
