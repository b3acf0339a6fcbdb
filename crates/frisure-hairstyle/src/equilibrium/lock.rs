//! The hairs inside each wisp on the way to rest: what of a bend they keep.
//!
//! docs/theory.md, "A lock that yields"

use frisure_rod::Equilibrium;
use frisure_rod::potential::{Potential, YieldState, Yielding};

use super::fields::{body, body_samples, layer};
use crate::contact::LockFriction;
use crate::guides::Guide;
use crate::hairstyle::Rest;
use crate::head::Head;
use crate::spec::HairstyleSpec;

/// How the hairs of a wisp begin.
#[derive(Clone, Debug)]
pub(crate) enum LockStart {
    /// They stick as they lie, without a moment.
    Anew,
    /// They stick as they did before, if the guide is the same.
    Like(Yielding),
    /// They slide freely on the way to rest and stick there: hair that is washed, or grown.
    Free,
}

impl LockStart {
    /// As hairs of a wisp stuck before, if they did.
    pub(crate) fn like(before: Option<&Yielding>) -> Self {
        before.map_or(Self::Anew, |lock| Self::Like(lock.clone()))
    }
}

/// The hairs of a wisp that lies as in `rest`, where they stick without a moment; `None` if they always slide.
pub(super) fn stuck(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    rest: &Equilibrium,
) -> Option<Yielding> {
    if guide.friction.lock == 0.0 {
        return None;
    }
    let (chain, samples) = (rest.chain(), body_samples(guide, rest.elements));
    let surface = body(spec, head, guide, layer(spec, guide));
    let points = chain.sample_points(&rest.shape, samples);
    let spacing = guide.rod.length() / points.len() as f64;
    let pressed = points.iter().enumerate();
    let pressed: Vec<f64> =
        pressed.map(|(k, &p)| surface.normal_force((k + 1) as f64 * spacing, p)).collect();
    let (rod, thickness, friction) = (&guide.rod, &guide.thickness, guide.friction);
    let laws = LockFriction { rod, thickness, friction, pressed: &pressed }.laws(rest.elements);
    let step = rod.length() / rest.elements as f64;
    let law = |s: f64| laws[((s / step) as usize).min(laws.len() - 1)];
    Some(Yielding::stuck_at(&chain, &rest.shape, law))
}

/// The hairs of a wisp that begins in the shape of `rest`, which is that in which it lay before; `None` if they slide.
pub(super) fn started(
    spec: &HairstyleSpec,
    head: &Head,
    guide: &Guide,
    rest: &Equilibrium,
    start: &LockStart,
) -> Option<Yielding> {
    let before = match start {
        LockStart::Free => return None,
        LockStart::Anew => None,
        LockStart::Like(before) => Some(before),
    };
    let anew = stuck(spec, head, guide, rest)?;
    // Of another division or length nothing is kept.
    Some(before.and_then(|before| anew.sticking_like(before)).unwrap_or(anew))
}

/// Lets hairs that slipped on the way to a rest stick there.
pub(super) fn follow(lock: &mut Option<Yielding>, rest: &Equilibrium) {
    if let Some(lock) = lock {
        lock.follow(&rest.chain(), &rest.shape);
    }
}

/// The hairs of a wisp as a potential of its guide, if they stick.
pub(super) fn felt(lock: Option<&Yielding>) -> Option<&dyn Potential> {
    lock.map(|lock| lock as &dyn Potential)
}

/// How the hairs of each wisp hold at rest; none of those that slide.
pub(super) fn states(rest: &Rest) -> impl Iterator<Item = YieldState> {
    let held = rest.guides.iter().zip(&rest.locks);
    held.filter_map(|(rest, lock)| Some(lock.as_ref()?.state(&rest.chain(), &rest.shape)))
}
