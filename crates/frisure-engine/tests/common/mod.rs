//! Small scenes, and the content of responses.

#![allow(dead_code, reason = "each test uses some of it")]

use std::sync::atomic::{AtomicUsize, Ordering};

use frisure::progress::Progress;
use frisure_engine::Session;
use frisure_engine::{Diagnostic, Preview, Quality, Request, Response, SceneRef};

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

pub(crate) fn asked(text: &str, done: usize) -> SceneRef {
    SceneRef { name: "scene".into(), text: text.into(), folder: String::new(), done }
}

pub(crate) fn show(
    session: &mut Session,
    asked: &SceneRef,
    effort: Quality,
    progress: &dyn Progress,
) -> Response {
    session.execute(&Request::Preview { scene: asked.clone(), quality: effort }, progress)
}

pub(crate) fn shown(answer: Response) -> Preview {
    match answer {
        Response::Preview(shown) => *shown,
        other => panic!("{other:?}"),
    }
}

pub(crate) fn exact(session: &mut Session, asked: &SceneRef) -> Preview {
    shown(show(session, asked, Quality::Exact, &()))
}

pub(crate) fn failed(answer: Response) -> Diagnostic {
    match answer {
        Response::Failed(diagnostic) => diagnostic,
        other => panic!("{other:?}"),
    }
}

/// Cancels after a number of checks, and counts reports.
pub(crate) struct Counted {
    left: AtomicUsize,
    reports: AtomicUsize,
}

impl Counted {
    pub(crate) fn new(most: usize) -> Self {
        Self { left: most.into(), reports: 0.into() }
    }

    pub(crate) fn reports(&self) -> usize {
        self.reports.load(Ordering::Relaxed)
    }
}

impl Progress for Counted {
    fn report(&self, _stage: &str, _fraction: f64) {
        self.reports.fetch_add(1, Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        let take = |left: usize| left.checked_sub(1);
        self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_err()
    }
}
