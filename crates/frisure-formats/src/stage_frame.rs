//! Unit and axes of a stage of USD.

use frisure_files::frame::{Frame, FrameChoice, UpAxis};
use frisure_usd::Stage;

/// The frame that a stage states, or what `choice` says in its place.
pub(crate) fn stage_frame(stage: &Stage<'_>, choice: FrameChoice) -> Frame {
    let up = if stage.is_z_up { UpAxis::Z } else { UpAxis::Y };
    choice.or(Frame { metres: stage.metres_per_unit, up })
}
