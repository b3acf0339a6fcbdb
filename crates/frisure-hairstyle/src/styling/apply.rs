//! An operation maps a hairstyle to a hairstyle.

use super::error::StyleError;
use super::operations::Operation;
use super::selection::Selection;
use super::settle::{Act, DraftRest};
use crate::equilibrium::Effort;
use crate::hairstyle::Hairstyle;
use crate::head::Head;
use frisure_progress::Progress;

/// How [`style`] works. The default gives the exact result.
#[derive(Debug, Default)]
pub struct StyleOptions<'a> {
    /// Does the operation roughly, for the eye; none for the exact result.
    pub draft: Option<Draft<'a>>,
    /// Receives the hairstyle after each stage but the last, which is the result. Only growth has more than
    /// one, as many as it asks for.
    pub stages: Option<&'a mut Vec<Hairstyle>>,
}

/// How roughly an operation is done.
#[derive(Clone, Copy, Debug)]
pub struct Draft<'a> {
    /// How much work is done at most each time that hair comes to rest.
    pub effort: Effort,
    /// Of the drawn hairs, scissors cut those that [`crate::strands()`] draws for the same stride.
    pub stride: usize,
    /// A hairstyle whose guides lie where these are likely to end, such as the result of a call that was
    /// nearly the same: guides start from there. Without it, or if it has another number of guides, they
    /// start from where they lay.
    pub like: Option<&'a Hairstyle>,
}

/// The hairstyle after something was done to it, at rest again. Each wisp that changed comes to
/// rest from where it lay; one that is dried without having been touched lies exactly as before
/// it was wetted.
///
/// ```
/// use frisure_hairstyle::styling::{Operation, Wet};
/// use frisure_hairstyle::{PredictOptions, StyleOptions, head::Head, predict, preset, style};
///
/// let mut spec = preset("curly").expect("a preset").spec();
/// spec.wisps.count = 20;
/// let head = Head::mannequin();
/// let dry = predict(&spec, &head, PredictOptions::default(), &())?;
/// let wet = style(&dry, &head, &Operation::Wet(Wet::default()), StyleOptions::default(), &())?;
/// assert!(wet.wisps().iter().all(|wisp| wisp.wetness == 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`StyleError`], if the operation is out of range or cannot be done to this hair, or the work is cancelled.
pub fn style(
    hairstyle: &Hairstyle,
    head: &Head,
    operation: &Operation,
    options: StyleOptions<'_>,
    progress: &dyn Progress,
) -> Result<Hairstyle, StyleError> {
    operation.check()?;
    let draft = options.draft.map(|Draft { effort, stride, like }| {
        let like = like.filter(|like| like.guides.len() == hairstyle.guides.len());
        DraftRest { effort, stride, like: like.map(|like| like.rest.guides.as_slice()) }
    });
    let act = Act { before: hairstyle, head, draft, progress };
    let mut made = operation.inner().stages(&act)?;
    let result = made.pop().expect("an operation makes at least one hairstyle");
    if let Some(stages) = options.stages {
        stages.append(&mut made);
    }
    Ok(result)
}

/// Which wisps of a hairstyle a selection has, in the order of [`Hairstyle::guides`].
///
/// # Errors
/// [`StyleError`], if there is none, or one is named that does not exist.
pub fn selected(
    hairstyle: &Hairstyle,
    head: &Head,
    selection: &Selection,
) -> Result<Vec<bool>, StyleError> {
    selection.check()?;
    selection.wisps(head, &hairstyle.guides, &hairstyle.rest.guides)
}
