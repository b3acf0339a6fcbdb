//! The tour: five steps that a newcomer does on a head of curly hair.

use frisure::hairstyle::styling::Operation;

use super::orbit::Orbit;
use super::salon::Salon;
use super::tour::Tour;

/// A step of the tour.
#[derive(Debug)]
pub struct TourStep {
    /// What is done.
    pub title: &'static str,
    /// How, with the pointer and with keys.
    pub text: &'static str,
    /// Whether it has been done, given the view when the step began.
    done: fn(&Salon, &Orbit) -> bool,
}

/// The steps, in their order.
pub const TOUR: [TourStep; 5] = [
    TourStep {
        title: "Turn the head",
        text: "Drag in the picture, or press the arrow keys. 1 to 6 show the head from the front, from its sides, from behind and from above; F frames \
               all of it.",
        done: |salon, before| salon.orbit != *before,
    },
    TourStep {
        title: "Wet the hair",
        text: "Press Wet (W). Wet hair is heavier and softer: curls hang lower. It takes a moment until all hair rests; the badge in the corner says so.",
        done: |salon, _| salon.is_wet(),
    },
    TourStep {
        title: "Select the fringe",
        text: "Press Fringe below the picture, or draw around hair with the lasso (L). The next steps are done to the selected hair alone, which has a blue tint.",
        done: |salon, _| !salon.selected.is_everything(),
    },
    TourStep {
        title: "Cut it",
        text: "Choose Cut (C) and drag the plane up to the eyes: what is red falls. Then press Cut here (Enter). Scissors (S) cut along a line that you draw.",
        done: |salon, _| last_is(salon, |operation| matches!(operation, Operation::Cut(_))),
    },
    TourStep {
        title: "Dry it, and compare",
        text: "Select all hair (A), press Dry (W): the fringe springs up. Compare (X) shows the hair before the last edit; drag the bar. Undo (Ctrl Z) takes any edit back.",
        done: |salon, _| salon.comparison.is_some() && !salon.is_wet(),
    },
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
