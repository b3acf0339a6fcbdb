//! The tour: five steps that a newcomer does on a head of curly hair.

use frisure::hairstyle::styling::Operation;

use super::orbit::Orbit;
use super::salon::Salon;
use super::tour::Tour;

/// A step of the tour.
#[derive(Debug)]
pub struct TourStep {
    /// The message of what is done; its attribute `text` says how, with the pointer and with keys.
    pub id: &'static str,
    /// Whether it has been done, given the view when the step began.
    done: fn(&Salon, &Orbit) -> bool,
}

/// The steps, in their order.
pub const TOUR: [TourStep; 5] = [
    TourStep { id: "tour-turn", done: |salon, before| salon.orbit != *before },
    TourStep { id: "tour-wet", done: |salon, _| salon.is_wet() },
    TourStep { id: "tour-select", done: |salon, _| !salon.selected.is_everything() },
    TourStep {
        id: "tour-cut",
        done: |salon, _| last_is(salon, |operation| matches!(operation, Operation::Cut(_))),
    },
    TourStep { id: "tour-dry", done: |salon, _| salon.comparison.is_some() && !salon.is_wet() },
];

impl Salon {
    /// Begins the tour, with curly hair.
    pub(super) fn begin_tour(&mut self) {
        self.begin("curly");
        self.tour = Some(Tour { at: 0, before: self.orbit });
    }

    /// Goes to the next step, or ends the tour.
    pub(super) fn next_of_tour(&mut self) {
        let before = self.orbit;
        self.tour = (self.tour.take())
            .filter(|tour| tour.at < TOUR.len())
            .map(|tour| Tour { at: tour.at + 1, before });
    }

    /// Whether the present step of the tour has been done.
    #[must_use]
    pub fn is_step_done(&self) -> bool {
        let Some(tour) = &self.tour else { return false };
        TOUR.get(tour.at).is_none_or(|step| (step.done)(self, &tour.before))
    }
}

/// Whether the last step of the scene is such an operation.
fn last_is(salon: &Salon, such: impl Fn(&Operation) -> bool) -> bool {
    salon.scene.as_ref().is_some_and(|parsed| parsed.scene.steps().last().is_some_and(such))
}
