//! Where a function first becomes positive.

/// How a function's first crossing of zero is searched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// The search goes from 0 to here.
    pub(crate) end: f64,
    /// In how many steps: two crossings within a step are missed.
    pub(crate) steps: usize,
    /// The most that the function rises in a step, infinite where that is not known: steps that end below zero for certain are
    /// skipped.
    pub(crate) rise: f64,
    /// The place is found where the function is below zero by no more than this.
    pub(crate) near: f64,
}

/// Most evaluations within a step. Chosen: every third halves what is left of it, so a place of a jump is found to 2⁻²⁰ of a step.
const MOST: usize = 60;

impl Crossing {
    /// Where the function first becomes positive, from below; 0 if it is positive there, none if it is positive nowhere.
    pub(crate) fn first(self, mut value: impl FnMut(f64) -> f64) -> Option<f64> {
        let Self { end, steps, rise, near } = self;
        let place = |k: usize| k as f64 / steps as f64 * end;
        // 1. The step in which it is.
        let mut k = 0;
        let (mut before, mut below) = (0.0, f64::NAN);
        let mut above = loop {
            let found = value(place(k));
            if found > 0.0 {
                break found;
            }
            if k == steps {
                return None;
            }
            (before, below) = (place(k), found);
            k = k.saturating_add(((-found / rise) as usize).max(1)).min(steps);
        };
        if k == 0 {
            return Some(0.0);
        }
        // 2. The place within it: regula falsi, halving the value of an end that stays (the Illinois algorithm, Dowell & Jarratt
        // 1971, BIT 11, 168–174), and a bisection at every third place.
        let mut after = place(k);
        let (mut found, mut side) = (below, 0);
        for evaluation in 0..MOST {
            if found <= 0.0 && -found <= near {
                break;
            }
            let share = if evaluation % 3 == 2 { 0.5 } else { below / (below - above) };
            let middle = before + share * (after - before);
            found = value(middle);
            if found > 0.0 {
                (after, above) = (middle, found);
                below *= if side == 1 { 0.5 } else { 1.0 };
                side = 1;
            } else {
                (before, below) = (middle, found);
                above *= if side == -1 { 0.5 } else { 1.0 };
                side = -1;
            }
        }
        Some(before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_several_crossings_is_found() {
        let search = Crossing { end: 4.0, steps: 64, rise: f64::INFINITY, near: 1e-13 };
        let found = |f: fn(f64) -> f64| search.first(f);
        let third = found(|x| (x - 1.0 / 3.0) * (1.0 - x)).unwrap();
        assert!((third - 1.0 / 3.0).abs() < 1e-11);
        assert_eq!(found(|_| 1.0), Some(0.0));
        assert_eq!(found(|_| -1.0), None);
        // A jump, which no line through two values finds.
        let jump = found(|x| if x < 2.7 { -1.0 } else { 5.0 }).unwrap();
        assert!(jump < 2.7 && jump > 2.7 - 1e-6, "{jump}");
    }

    #[test]
    fn steps_that_end_below_for_certain_are_skipped() {
        let mut places = Vec::new();
        let search = Crossing { end: 1.0, steps: 1000, rise: 1e-3, near: 1e-9 };
        let place = search.first(|x| {
            places.push(x);
            (x - 0.7).min(0.1 * (x - 0.3))
        });
        assert!((place.unwrap() - 0.7).abs() < 1e-8, "{place:?}");
        assert!(places.len() < 40, "{places:?}");
    }
}
