//! What styling has made of a hairstyle, wisp by wisp, as data.

use std::sync::Arc;

use frisure_rod::potential::Yielding;
use frisure_rod::{Equilibrium, InvalidQuantity, NaturalStrain, Rod, StrainProfile};
use glam::{DMat3, DQuat, DVec3};

use super::rest::Rest;
use crate::capillary::{Coalescence, Liquid};
use crate::contact::{BraidPath, Thickness};
use crate::fibre::WetLocks;
use crate::guides::Guide;
use crate::product::{Applied, Product};
use crate::spec::HairstyleSpec;

/// Relative humidity of the air that every hairstyle begins in.
/// That of the measured hair types (docs/hair-types.md, "Humidity").
pub(crate) const ROOM: f64 = 0.6;

/// What styling has made of a hairstyle.
#[derive(Clone, Debug)]
pub(crate) struct Styling {
    /// The guides as they were planned.
    pub(crate) planned: Arc<[Guide]>,
    pub(crate) wisps: Vec<WispState>,
    /// Relative humidity of the air.
    pub(crate) humidity: f64,
    /// Where drawn hairs have been cut, if they have.
    pub(crate) ends: Option<Ends>,
    /// How the hair lay before it was wetted.
    pub(crate) lay: Option<Arc<Lay>>,
}

/// How dry hair lay before it was wetted: hair that dries lies so again, if nothing else was done to
/// it. \[paper\] §3.2.1 has drying as the inverse of wetting.
#[derive(Debug)]
pub(crate) struct Lay {
    pub(crate) humidity: f64,
    /// State and equilibrium of each wisp that was dry, and how its hairs stuck.
    pub(crate) wisps: Vec<Option<(WispState, Equilibrium, Option<Yielding>)>>,
    /// All of the head when all of it was dry.
    pub(crate) whole: Option<(Vec<WispState>, Rest)>,
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

    /// Length (m, dry) at which each drawn hair has been cut, if any has.
    pub(crate) fn limits(&self) -> Option<&[f32]> {
        self.ends.as_ref().map(|ends| &*ends.limits)
    }
}

/// The length at which each drawn hair has been cut.
#[derive(Clone, Debug)]
pub(crate) struct Ends {
    /// Length (m) of the dry hair, infinite where it has never been cut.
    pub(crate) limits: Arc<[f32]>,
    /// Whether that is the length of the hair itself, which was held straight when it was cut, rather than the length along its guides at which it
    /// crossed a line.
    pub(crate) straight: Arc<[bool]>,
    /// The wisp of each hair.
    pub(crate) wisps: Arc<[u32]>,
    /// How many cuts there have been.
    pub(crate) cuts: u32,
    /// What thinning scissors have left, which cut hairs and no guides; none before they did.
    pub(crate) thinned: Option<Thinned>,
}

/// The length at which thinning scissors have cut each drawn hair.
#[derive(Clone, Debug)]
pub(crate) struct Thinned {
    /// Length (m) of the dry hair, infinite where they have not cut it.
    pub(crate) limits: Arc<[f32]>,
    /// Only of every so many-th hair it is known: in a draft not all are drawn.
    pub(crate) every: usize,
}

/// What styling has made of one wisp. Lengths are those of dry hair, in air of 60 %.
#[derive(Clone, Debug, PartialEq)]
pub struct WispState {
    /// Length of the guide (m).
    pub length: f64,
    /// Length that the guide would have if it had never been cut (m).
    pub uncut: f64,
    /// 0 (dry) to 1 (wet).
    pub wetness: f64,
    /// Mass of the water in the wisp when it is fully wet, over that of the dry hair.
    pub water: f64,
    /// Shapes that it was dried in and keeps part of, the oldest first.
    pub(crate) sets: Vec<Set>,
    /// The styling product on it.
    pub(crate) product: Option<Applied>,
    /// What holds it.
    pub(crate) grip: Option<Grip>,
    /// How often it was moved by hand: where it lay before means nothing then.
    pub(crate) moved: u32,
}

/// What holds a wisp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Grip {
    /// Gives the hair another shape, and draws it down with a force (in weights of the hair).
    Mould {
        /// The shape.
        mould: Mould,
        /// How hard it is drawn down.
        tension: f64,
    },
    /// Brings a place, 0 (root) to 1 (tip), to a point (m).
    Clip {
        /// Which place.
        at: f64,
        /// The point.
        to: DVec3,
        /// With what.
        by: Fastener,
    },
    /// Holds a place in a tie, and what is beyond it in a braid.
    Braid {
        /// Which place is in the tie, 0 (root) to 1 (tip).
        at: f64,
        /// The way of the hair from there.
        path: BraidPath,
    },
    /// A comb that is not taken away.
    Comb {
        /// A unit vector.
        direction: DVec3,
        /// As [`crate::styling::Comb::strength`].
        strength: f64,
        /// As [`crate::styling::Comb::until`].
        until: Option<DVec3>,
    },
}

/// What holds a place of a wisp at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fastener {
    /// A clip.
    Clip,
    /// A hair tie round a bundle with this middle (m) and axis (unit, off the head), which all wisps in the tie share.
    Tie { middle: DVec3, axis: DVec3 },
    /// A pin over a bundle with this middle (m).
    Pin { middle: DVec3 },
}

/// A shape into which hair is forced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mould {
    /// A straight line.
    Straight,
    /// A helix on a roller, by radius and pitch (m).
    Roller { radius: f64, pitch: f64 },
    /// A helix about another lock, by radius and pitch (m).
    Twist { radius: f64, pitch: f64 },
    /// A part of a braid of three, by the braid's width and pitch (m).
    Braid { width: f64, pitch: f64 },
}

/// Tension in hair that is braided or drawn straight, in weights; chosen by trial, not measured further.
pub(crate) const DRAWN: f64 = 25.0;

impl Grip {
    /// Whether it presses hair on the skin harder than hair lies there.
    pub(crate) fn presses(self) -> bool {
        matches!(self, Self::Mould { .. } | Self::Clip { .. } | Self::Braid { .. })
    }

    /// Whether it gives hair another shape, rather than another place.
    pub(crate) fn moulds(self) -> bool {
        matches!(self, Self::Mould { .. })
    }
}

/// A shape that hair was dried in: hydrogen bonds that water had opened close again, and keep part
/// of it until water opens them again.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Set {
    /// Strain (rad/m) of the shape along the dry hair, from where it begins.
    held: NaturalStrain,
    /// Where it begins (m): hair that has grown since does not have it.
    from: f64,
    /// How much of it is kept, 0 to 1.
    share: f64,
}

/// A set of which less is left is gone. Chosen: it changes a curl by a thousandth.
const LEAST_SHARE: f64 = 1e-3;

/// Distance of the knots (m) of a natural strain that has a set in it, at least …
const KNOTS: f64 = 2e-3;
/// … and their most number. Chosen; a guard on memory.
const MOST_KNOTS: f64 = 1000.0;

impl WispState {
    pub(crate) fn new(length: f64) -> Self {
        let (sets, product, grip) = (Vec::new(), None, None);
        Self { length, uncut: length, wetness: 0.0, water: 0.0, sets, product, grip, moved: 0 }
    }

    /// Whether something holds the wisp.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.grip.is_some()
    }

    /// What holds the wisp, such as `"tie"`; none if nothing does.
    #[must_use]
    pub fn held_by(&self) -> Option<&'static str> {
        Some(match self.grip? {
            Grip::Mould { mould, .. } => match mould {
                Mould::Straight => "straightener",
                Mould::Roller { .. } => "roller",
                Mould::Twist { .. } => "twist",
                Mould::Braid { .. } => "braid",
            },
            Grip::Clip { by, .. } => match by {
                Fastener::Clip => "clip",
                Fastener::Tie { .. } => "tie",
                Fastener::Pin { .. } => "pin",
            },
            // The tail of a tie.
            Grip::Braid { .. } => "tie",
            Grip::Comb { .. } => "comb",
        })
    }

    /// Which place of the wisp, 0 (root) to 1 (tip), a clip or a tie holds, and at which point (m).
    #[must_use]
    pub fn clipped(&self) -> Option<(f64, DVec3)> {
        match self.grip {
            Some(Grip::Clip { at, to, .. }) => Some((at, to)),
            Some(Grip::Braid { at, path }) => Some((at, path.place(0.0))),
            _ => None,
        }
    }

    /// The styling product on the wisp and how much of it, 0 to 1; none if there is none.
    #[must_use]
    pub fn product(&self) -> Option<(Product, f64)> {
        self.product.map(|applied| (applied.product, applied.amount))
    }

    /// How its hairs gather into locks, if they are wet and do so by the law of capillarity; `rod` is its guide as it is now, and
    /// `thickness` says how much of the curl each hair has of its own.
    pub(crate) fn coalescence(
        &self,
        spec: &HairstyleSpec,
        rod: &Rod,
        thickness: &Thickness,
    ) -> Option<Coalescence> {
        let gathers = self.wetness > 0.0 && spec.wetting.locks == WetLocks::Capillary;
        let density = spec.implantation.density;
        let of = || Coalescence::new(Liquid::WATER, self.wetness, rod, density, thickness.spread());
        gathers.then(of)
    }

    /// Wets the wisp, or lets it dry to some wetness; what water opens loses its set.
    pub(crate) fn wet(&mut self, to: f64) {
        if to > self.wetness {
            // Wetting from w to w′ leaves k (1 − w′)/(1 − w) of a set: water opens the hydrogen bonds that hold it.
            let share = (1.0 - to) / (1.0 - self.wetness);
            self.leave_of_sets(share);
            self.product = self.product.and_then(|applied| applied.washed(share));
        }
        self.wetness = to;
        if to == 0.0 {
            self.water = 0.0;
        }
    }

    /// Leaves a share of what is kept of shapes that it was dried in.
    pub(crate) fn leave_of_sets(&mut self, share: f64) {
        for set in &mut self.sets {
            set.share *= share;
        }
        self.sets.retain(|set| set.share > LEAST_SHARE);
    }

    /// Lets the wisp keep a share of a shape, given as strain along the dry hair.
    pub(crate) fn keep(&mut self, held: NaturalStrain, share: f64) {
        if share > LEAST_SHARE {
            self.sets.push(Set { held, from: 0.0, share });
        }
    }

    /// Lets the wisp grow by a length (m) at its root.
    pub(crate) fn grow(&mut self, by: f64) {
        self.length += by;
        self.uncut += by;
        for set in &mut self.sets {
            set.from += by;
        }
    }

    /// The natural strain (rad/m, along the dry hair) with what is kept of shapes it was dried in.
    pub(crate) fn with_sets(&self, grown: NaturalStrain) -> Result<NaturalStrain, InvalidQuantity> {
        if self.sets.is_empty() {
            return Ok(grown);
        }
        let count = (self.length / KNOTS).ceil().clamp(8.0, MOST_KNOTS);
        let strain = |s: f64| {
            self.sets.iter().fold(grown.at(s), |strain, set| match s - set.from {
                s if s < 0.0 => strain,
                // u⁰ ← u⁰ + k (u_h − u⁰), the oldest set first; hair that grew since is above where it begins.
                s => strain.lerp(set.held.at(s), set.share),
            })
        };
        let knots = (0..=count as usize).map(|i| i as f64 * (self.length / count));
        let profile = StrainProfile::new(knots.map(|s| (s, strain(s))).collect())?;
        Ok(NaturalStrain::Varying(profile))
    }
}

/// Distance (m) of the frames between which the strain of a shape is taken.
/// Chosen.
const FRAMES: f64 = 1e-3;

/// The strain (rad/m) of a guide as it lies, along the dry hair, which is `stretch` times shorter.
pub(crate) fn strain_of(
    guide: &Equilibrium,
    stretch: f64,
) -> Result<NaturalStrain, InvalidQuantity> {
    let length = guide.rod.length();
    let count = (length / FRAMES).ceil().clamp(8.0, MOST_KNOTS) as usize;
    let step = length / count as f64;
    let frames = guide.sample(count + 1);
    let knot = |(i, pair): (usize, &[(DVec3, DMat3)])| {
        // The rotation vector from frame to frame, in the material frame, over its length: the mean strain between them.
        let turn = DQuat::from_mat3(&(pair[0].1.transpose() * pair[1].1)).to_scaled_axis();
        ((i as f64 + 0.5) * step / stretch, turn / step * stretch)
    };
    let knots = frames.windows(2).enumerate().map(knot).collect();
    Ok(NaturalStrain::Varying(StrainProfile::new(knots)?))
}
