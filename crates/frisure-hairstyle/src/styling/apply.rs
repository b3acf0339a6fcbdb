//! An operation maps a hairstyle to a hairstyle.

use frisure_rod::{Equilibrium, InvalidQuantity, NaturalStrain};
use rayon::prelude::*;

use super::cut::{Scissors, enough};
use super::ends::Ends;
use super::operation::{
    Comb, Cut, Dry, Grow, Growth, Hold, Humidity, Operation, Part, Release, Wet,
};
use super::wisp_state::{Grip, WispState, strain_of};
use super::{Selection, StyleError, Styling};
use crate::equilibrium::{Change, Effort};
use crate::guides::{Guide, plan};
use crate::hairstyle::{Hairstyle, Rough};
use crate::head::Head;
use crate::implantation::Layout;
use crate::monitor::Monitor;
use crate::spec::{Flow, Parting};

/// Longest guide (m): that of a description.
const LONGEST: f64 = 3.0;

/// How much longer than before hair may be when it comes to rest again while it grows, as a factor
/// and as a length (m), whichever is more: it buckles and falls on its way, not at its end.
const GROWN_AT_ONCE: (f64, f64) = (1.25, 5e-3);

impl Hairstyle {
    /// The hairstyle after something was done to it, at rest again. Each wisp that changed comes to
    /// rest from where it lay; one that is dried without having been touched lies exactly as before
    /// it was wetted.
    ///
    /// # Errors
    /// [`StyleError`]; this hairstyle is as it was.
    pub fn styled(
        &self,
        head: &Head,
        operation: &Operation,
        monitor: &dyn Monitor,
    ) -> Result<Self, StyleError> {
        let mut stages = self.stages(head, operation, monitor)?;
        Ok(stages.pop().expect("at least one stage"))
    }

    /// As [`Self::styled`], for the eye, doing no more than `effort` each time that hair comes to rest.
    /// Guides start from where those of `like` rest, which is the answer of a call that was nearly the
    /// same; without it, from where they lay. Of the drawn hairs, scissors cut those that
    /// [`Self::some_strands`] draws for the same `every`.
    ///
    /// # Errors
    /// As [`Self::styled`].
    pub fn styled_roughly(
        &self,
        head: &Head,
        operation: &Operation,
        like: Option<&Self>,
        (effort, every): (Effort, usize),
        monitor: &dyn Monitor,
    ) -> Result<Self, StyleError> {
        let like = like.filter(|like| like.guides.len() == self.guides.len());
        let like = like.map(|like| like.rest.guides.as_slice().into());
        let rough =
            Self { rough: Some(Rough { effort, every: every.max(1), like }), ..self.clone() };
        Ok(Self { rough: None, ..rough.styled(head, operation, monitor)? })
    }

    /// As [`Self::styled`], with every stage on the way, the result last. Only growth has more than
    /// one, as many as it asks for.
    ///
    /// # Errors
    /// [`StyleError`]; this hairstyle is as it was.
    pub fn stages(
        &self,
        head: &Head,
        operation: &Operation,
        monitor: &dyn Monitor,
    ) -> Result<Vec<Self>, StyleError> {
        operation.check()?;
        match operation {
            Operation::Wet(wet) => self.wet(head, wet, monitor),
            Operation::Dry(dry) => self.dry(head, dry, monitor),
            Operation::Humidity(air) => self.left_in(head, *air, monitor),
            Operation::Cut(cut) => self.cut(head, cut, monitor),
            Operation::Grow(grow) => return self.grow(head, grow, monitor),
            Operation::Comb(comb) => self.comb(head, comb, monitor),
            Operation::Part(part) => self.part(head, part, monitor),
            Operation::Hold(hold) => self.hold(head, hold, monitor),
            Operation::Release(release) => self.release(head, release, monitor),
        }
        .map(|styled| vec![styled])
    }

    /// Which wisps a selection has, by their order in [`Self::guides`].
    ///
    /// # Errors
    /// [`StyleError`], if there is none, or one is named that does not exist.
    pub fn selected(&self, head: &Head, selection: &Selection) -> Result<Vec<bool>, StyleError> {
        selection.check()?;
        selection.wisps(head, &self.guides, &self.rest.guides)
    }

    fn wet(&self, head: &Head, wet: &Wet, monitor: &dyn Monitor) -> Result<Self, StyleError> {
        let chosen = self.selected(head, &wet.selection)?;
        let mut styling = self.styling.changed(&chosen, |_, wisp| {
            wisp.wet(wet.to);
            wisp.water = if wet.to > 0.0 { wet.water } else { 0.0 };
        });
        styling.lay = Some(self.lay());
        self.with(head, styling, monitor)
    }

    fn dry(&self, head: &Head, dry: &Dry, monitor: &dyn Monitor) -> Result<Self, StyleError> {
        let chosen = self.selected(head, &dry.selection)?;
        let kept = self.shapes_kept(&chosen)?;
        let styling = self.styling.changed(&chosen, |index, wisp| {
            let closed = wisp.wetness;
            wisp.wet(0.0);
            if let Some(held) = &kept[index] {
                wisp.keep(held.clone(), dry.keep * closed);
            }
        });
        self.with(head, styling, monitor)
    }

    /// The strain of each chosen wisp that is wet and held.
    fn shapes_kept(&self, chosen: &[bool]) -> Result<Vec<Option<NaturalStrain>>, InvalidQuantity> {
        let kept = |(index, wisp): (usize, &WispState)| {
            let setting = chosen[index] && wisp.wetness > 0.0 && wisp.is_held();
            let stretch = self.guides[index].rod.length() / wisp.length;
            setting.then(|| strain_of(&self.rest.guides[index], stretch)).transpose()
        };
        self.styling.wisps.par_iter().enumerate().map(kept).collect()
    }

    fn left_in(
        &self,
        head: &Head,
        air: Humidity,
        monitor: &dyn Monitor,
    ) -> Result<Self, StyleError> {
        let styling = Styling { humidity: air.relative, ..self.styling.clone() };
        self.with(head, styling, monitor)
    }

    fn cut(&self, head: &Head, cut: &Cut, monitor: &dyn Monitor) -> Result<Self, StyleError> {
        let chosen = self.selected(head, &cut.selection)?;
        let scissors = Scissors::new(cut, head);
        let left = |(guide, rest): (&Guide, &Equilibrium)| match scissors.hanging() {
            true => scissors.left_hanging(rest),
            false => scissors.left_straight(&guide.root),
        };
        let left: Vec<f64> = self.guides.par_iter().zip(&self.rest.guides).map(left).collect();
        let none = |i: &usize| chosen[*i] && !enough(left[*i]);
        let wisps: Vec<usize> = (0..left.len()).filter(none).collect();
        if !wisps.is_empty() {
            let selected = chosen.iter().filter(|chosen| **chosen).count();
            return Err(StyleError::AboveRoot { wisps, selected });
        }
        let stretch = |i: usize| self.guides[i].rod.length() / self.styling.wisps[i].length;
        let mut styling = self.styling.changed(&chosen, |index, wisp| {
            wisp.length = wisp.length.min(left[index] / stretch(index));
        });
        styling.ends = Some(Ends::cut(self, head, &chosen, |population, root, index, wisp| {
            if scissors.hanging() {
                let left = population.cut_where(root, index, |p| scissors.beyond(p));
                left.unwrap_or(f64::INFINITY)
            } else {
                scissors.left_straight(root) / stretch(wisp)
            }
        }));
        if scissors.hanging() {
            return self.with(head, styling, monitor);
        }
        self.at_rest(head, styling, Change::Handled, monitor)
    }

    fn grow(
        &self,
        head: &Head,
        grow: &Grow,
        monitor: &dyn Monitor,
    ) -> Result<Vec<Self>, StyleError> {
        let chosen = self.selected(head, &grow.selection)?;
        let spec = &self.spec.length;
        let by: Vec<f64> = (self.styling.wisps.iter().zip(&self.guides).zip(&chosen))
            .map(|((wisp, guide), &chosen)| match grow.amount {
                _ if !chosen => 0.0,
                Growth::By(length) => length,
                Growth::For(time) => time * spec.growth_rate,
                Growth::To(length) => (length * guide.share - wisp.length).max(0.0),
            })
            .collect();
        let too_long = |(wisp, by): (&WispState, &f64)| wisp.length + by > LONGEST;
        if let Some(wisp) = self.styling.wisps.iter().zip(&by).position(too_long) {
            let length = self.styling.wisps[wisp].length + by[wisp];
            return Err(StyleError::TooLong { wisp, length, most: LONGEST });
        }
        let mut stages: Vec<Self> = Vec::with_capacity(grow.stages);
        for _ in 0..grow.stages {
            let before = stages.last().unwrap_or(self);
            let share: Vec<f64> = by.iter().map(|by| by / grow.stages as f64).collect();
            stages.push(before.grown_by(head, &share, monitor)?);
        }
        Ok(stages)
    }

    /// Every wisp longer by so much (m), in as many steps as that takes.
    fn grown_by(&self, head: &Head, by: &[f64], monitor: &dyn Monitor) -> Result<Self, StyleError> {
        let (factor, least) = GROWN_AT_ONCE;
        let steps = |(wisp, by): (&WispState, &f64)| {
            let steps = ((wisp.length + by) / wisp.length).ln() / factor.ln();
            steps.min(by / least).ceil().max(1.0) as usize
        };
        let steps = self.styling.wisps.iter().zip(by).map(steps).max().unwrap_or(1);
        let mut grown = self.clone();
        for step in 1..=steps {
            // In equal ratios: what is short buckles soon.
            let share = |length: f64, by: f64| {
                let ratio = (length + by) / length;
                if step == steps {
                    by
                } else {
                    length * (ratio.powf(step as f64 / steps as f64) - 1.0)
                }
            };
            let mut styling = self.styling.clone();
            let now: Vec<f64> = (styling.wisps.iter().zip(by))
                .map(|(wisp, &by)| if by > 0.0 { share(wisp.length, by) } else { 0.0 })
                .collect();
            for (wisp, &by) in styling.wisps.iter_mut().zip(&now) {
                wisp.grow(by);
            }
            styling.ends = styling.ends.as_ref().map(|ends| ends.grown(&now));
            grown = grown.with(head, styling, monitor)?;
        }
        Ok(grown)
    }

    fn comb(&self, head: &Head, comb: &Comb, monitor: &dyn Monitor) -> Result<Self, StyleError> {
        let chosen = self.selected(head, &comb.selection)?;
        let direction = comb.towards.vector();
        let combing = self.styling.changed(&chosen, |_, wisp| {
            wisp.moved += 1;
            wisp.grip = Some(Grip::Comb { direction, strength: comb.strength });
        });
        let combed = self.with(head, combing, monitor)?;
        if comb.hold {
            return Ok(combed);
        }
        let free = combed.styling.changed(&chosen, |_, wisp| wisp.grip = None);
        combed.with(head, free, monitor)
    }

    /// Roots turn as if the hair had been planted with this parting; fibres stay what they are.
    fn part(&self, head: &Head, part: &Part, monitor: &dyn Monitor) -> Result<Self, StyleError> {
        let mut spec = self.spec.clone();
        let offset = match part.line {
            Parting::Straight { offset } | Parting::Zigzag { offset } => offset,
            Parting::Through(_) => 0.0,
        };
        spec.implantation.flow = Flow::Parted { offset };
        spec.implantation.partings = vec![part.line.clone()];
        let layout = Layout::new(&spec, head)?;
        let planned = plan(&spec, head, &layout, &self.planting)?;
        let everyone = vec![true; planned.len()];
        let mut styling = self.styling.changed(&everyone, |_, wisp| wisp.moved += 1);
        styling.planned = planned.into();
        let mut parted = Self { spec, layout, ..self.clone() }.with(head, styling, monitor)?;
        let ends = parted.styling.ends.take();
        parted.styling.ends = ends.map(|ends| ends.replanted(&parted, head));
        Ok(parted)
    }

    fn hold(&self, head: &Head, hold: &Hold, monitor: &dyn Monitor) -> Result<Self, StyleError> {
        let chosen = self.selected(head, &hold.selection)?;
        let styling = self.styling.changed(&chosen, |_, wisp| {
            wisp.moved += 1;
            wisp.grip = Some(Grip::Holder(hold.by));
        });
        self.with(head, styling, monitor)
    }

    fn release(
        &self,
        head: &Head,
        release: &Release,
        monitor: &dyn Monitor,
    ) -> Result<Self, StyleError> {
        let chosen = self.selected(head, &release.selection)?;
        let styling = self.styling.changed(&chosen, |_, wisp| wisp.grip = None);
        self.with(head, styling, monitor)
    }
}

impl Styling {
    /// The same with chosen wisps changed.
    fn changed(&self, chosen: &[bool], mut change: impl FnMut(usize, &mut WispState)) -> Self {
        let mut styling = self.clone();
        for (index, wisp) in styling.wisps.iter_mut().enumerate() {
            if chosen[index] {
                change(index, wisp);
            }
        }
        styling
    }
}
