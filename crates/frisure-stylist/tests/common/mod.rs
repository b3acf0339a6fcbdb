//! Small scenes, and answers taken apart.

#![allow(dead_code, reason = "each test uses some of it")]

use std::sync::atomic::{AtomicUsize, Ordering};

use frisure_stylist::order::{Answer, Asked, Effort, Order, Refusal, Shown};
use frisure_stylist::{Stylist, Watch};

/// A head of few short hairs.
pub(crate) const CURLY: &str = r#"
name = "Small"
[hair]
type = "caucasian-curly"
length = "12 cm"
[hair.curl]
radius = "9 mm"
[wisps]
count = 24
hairs = 300
points = 24
clumping = 0.5
[contact]
hair = "layers"
[equilibrium]
elements = 12
[look]
colour = "brown"
"#;

pub(crate) fn asked(text: &str, done: usize) -> Asked {
    Asked { name: "scene".into(), text: text.into(), folder: String::new(), done }
}

pub(crate) fn show(
    stylist: &mut Stylist,
    asked: &Asked,
    effort: Effort,
    watch: &dyn Watch,
) -> Answer {
    stylist.carry_out(&Order::Show { asked: asked.clone(), effort }, watch)
}

pub(crate) fn shown(answer: Answer) -> Shown {
    match answer {
        Answer::Shown(shown) => *shown,
        other => panic!("{other:?}"),
    }
}

pub(crate) fn exact(stylist: &mut Stylist, asked: &Asked) -> Shown {
    shown(show(stylist, asked, Effort::Exact, &()))
}

pub(crate) fn refused(answer: Answer) -> Refusal {
    match answer {
        Answer::Refused(refusal) => refusal,
        other => panic!("{other:?}"),
    }
}

/// Stops after it was looked at so often, and counts what is told.
pub(crate) struct Counted {
    left: AtomicUsize,
    told: AtomicUsize,
}

impl Counted {
    pub(crate) fn new(most: usize) -> Self {
        Self { left: most.into(), told: 0.into() }
    }

    pub(crate) fn told(&self) -> usize {
        self.told.load(Ordering::Relaxed)
    }
}

impl Watch for Counted {
    fn tell(&self, _answer: Answer) {
        self.told.fetch_add(1, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        let take = |left: usize| left.checked_sub(1);
        self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_err()
    }
}
