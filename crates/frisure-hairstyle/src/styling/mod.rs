//! What can be done to a hairstyle: wet, dry, cut, grow, comb, hold.
//!
//! An [`Operation`] is data; [`crate::Hairstyle::styled`] maps a hairstyle to another one. What
//! styling has made of each wisp is a [`WispState`], and the guide that the wisp has now follows from
//! it and from the guide that was planned (`fibre_now`). So drying is the exact inverse of wetting,
//! whatever has been rounded on the way.

mod apply;
mod cut;
mod ends;
mod error;
mod fibre_now;
mod operation;
mod selection;
mod settle;
mod wisp_state;

use std::sync::Arc;

use frisure_rod::Equilibrium;

use crate::equilibrium::Rest;
use crate::guides::Guide;

use ends::Ends;
pub use error::StyleError;
pub use operation::{
    Comb, Cut, CutLine, Direction, Dry, Grow, Growth, Height, Held, Hold, Holder, Humidity,
    Operation, Part, Release, Wet,
};
pub use selection::{Lasso, Selection, Spot, View};
pub use wisp_state::WispState;

/// Relative humidity of the air that every hairstyle begins in.
const ROOM: f64 = 0.6;

/// What styling has made of a hairstyle.
#[derive(Clone, Debug)]
pub(crate) struct Styling {
    /// The guides as they were planned.
    planned: Arc<[Guide]>,
    wisps: Vec<WispState>,
    /// Relative humidity of the air.
    humidity: f64,
    /// Where drawn hairs have been cut, if they have.
    ends: Option<Ends>,
    /// How the hair lay before it was wetted.
    lay: Option<Arc<Lay>>,
}

/// How dry hair lay before it was wetted: hair that dries lies so again, if nothing else was done to
/// it. \[paper\] §3.2.1 has drying as the inverse of wetting.
#[derive(Debug)]
struct Lay {
    humidity: f64,
    /// State and equilibrium of each wisp that was dry.
    wisps: Vec<Option<(WispState, Equilibrium)>>,
    /// All of the head when all of it was dry.
    whole: Option<(Vec<WispState>, Rest)>,
}

impl Styling {
    /// Nothing has been done.
    pub(crate) fn none(planned: &[Guide]) -> Self {
        let wisps = planned.iter().map(|g| WispState::new(g.rod.length())).collect();
        Self { planned: planned.into(), wisps, humidity: ROOM, ends: None, lay: None }
    }

    /// Whether nothing has been done to guides.
    pub(crate) fn is_none(&self, guides: &[Guide]) -> bool {
        let untouched = guides.iter().map(|g| WispState::new(g.rod.length()));
        self.humidity == ROOM
            && self.ends.is_none()
            && self.lay.is_none()
            && self.wisps.iter().cloned().eq(untouched)
    }

    /// The guides as they were planned.
    pub(crate) fn planned(&self) -> &[Guide] {
        &self.planned
    }

    /// What has been made of each wisp.
    pub(crate) fn wisps(&self) -> &[WispState] {
        &self.wisps
    }

    /// Length (m, dry) at which each drawn hair has been cut, if any has.
    pub(crate) fn limits(&self) -> Option<&[f32]> {
        self.ends.as_ref().map(Ends::limits)
    }
}
