//! An operation maps a hairstyle to a hairstyle.

use frisure_rod::{Equilibrium, InvalidQuantity, NaturalStrain};
use rayon::prelude::*;

use super::cut::{Scissors, enough};
use super::error::StyleError;
use super::operation::{
    Comb, Cut, Dry, Grow, Growth, Hold, Humidity, Operation, Part, Release, Wet,
};
use super::selection::Selection;
use super::settle::{Act, DraftRest};
use crate::equilibrium::{Change, Effort};
use crate::guides::{Guide, plan};
use crate::hairstyle::Hairstyle;
use crate::hairstyle::{Ends, Grip, Styling, WispState, strain_of};
use crate::head::Head;
use crate::implantation::Layout;
use crate::implantation::Root;
use crate::spec::{Flow, Parting};
use crate::strands::Population;
use frisure_progress::Progress;

/// Longest guide (m): that of a description.
const LONGEST: f64 = 3.0;

/// How much longer than before hair may be when it comes to rest again while it grows, as a factor
/// and as a length (m), whichever is more: it buckles and falls on its way, not at its end.
const GROWN_AT_ONCE: (f64, f64) = (1.25, 5e-3);

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
    match operation {
        Operation::Wet(wet) => act.wet(wet),
        Operation::Dry(dry) => act.dry(dry),
        Operation::Humidity(air) => act.left_in(*air),
        Operation::Cut(cut) => act.cut(cut),
        Operation::Grow(grow) => act.grow(grow, options.stages),
        Operation::Comb(comb) => act.comb(comb),
        Operation::Part(part) => act.part(part),
        Operation::Hold(hold) => act.hold(hold),
        Operation::Release(release) => act.release(release),
    }
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

impl Act<'_> {
    fn wet(&self, wet: &Wet) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(&wet.selection)?;
        let mut styling = self.before.styling.changed(&chosen, |_, wisp| {
            wisp.wet(wet.to);
            wisp.water = if wet.to > 0.0 { wet.water } else { 0.0 };
        });
        styling.lay = Some(self.lay());
        self.with(styling)
    }

    fn dry(&self, dry: &Dry) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(&dry.selection)?;
        let kept = self.shapes_kept(&chosen)?;
        let styling = self.before.styling.changed(&chosen, |index, wisp| {
            let closed = wisp.wetness;
            wisp.wet(0.0);
            if let Some(held) = &kept[index] {
                wisp.keep(held.clone(), dry.keep * closed);
            }
        });
        self.with(styling)
    }

    /// The strain of each chosen wisp that is wet and held.
    fn shapes_kept(&self, chosen: &[bool]) -> Result<Vec<Option<NaturalStrain>>, InvalidQuantity> {
        let kept = |(index, wisp): (usize, &WispState)| {
            let setting = chosen[index] && wisp.wetness > 0.0 && wisp.is_held();
            let stretch = self.before.guides[index].rod.length() / wisp.length;
            setting.then(|| strain_of(&self.before.rest.guides[index], stretch)).transpose()
        };
        self.before.styling.wisps.par_iter().enumerate().map(kept).collect()
    }

    fn left_in(&self, air: Humidity) -> Result<Hairstyle, StyleError> {
        let styling = Styling { humidity: air.relative, ..self.before.styling.clone() };
        self.with(styling)
    }

    fn cut(&self, cut: &Cut) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(&cut.selection)?;
        let scissors = Scissors::new(cut, self.head);
        let left = |(guide, rest): (&Guide, &Equilibrium)| match scissors.hanging() {
            true => scissors.left_hanging(rest),
            false => scissors.left_straight(&guide.root),
        };
        let Hairstyle { guides, rest, styling, .. } = self.before;
        let left: Vec<f64> = guides.par_iter().zip(&rest.guides).map(left).collect();
        let none = |i: &usize| chosen[*i] && !enough(left[*i]);
        let wisps: Vec<usize> = (0..left.len()).filter(none).collect();
        if !wisps.is_empty() {
            let selected = chosen.iter().filter(|chosen| **chosen).count();
            return Err(StyleError::AboveRoot { wisps, selected });
        }
        let stretch = |i: usize| guides[i].rod.length() / styling.wisps[i].length;
        let mut styling = styling.changed(&chosen, |index, wisp| {
            wisp.length = wisp.length.min(left[index] / stretch(index));
        });
        let stride = self.draft.map_or(1, |draft| draft.stride);
        let left = |population: &Population<'_>, root: &Root, index: usize, wisp: usize| {
            if scissors.hanging() {
                let left = population.cut_where(root, index, |p| scissors.beyond(p));
                left.unwrap_or(f64::INFINITY)
            } else {
                scissors.left_straight(root) / stretch(wisp)
            }
        };
        styling.ends = Some(Ends::cut(self.before, self.head, stride, &chosen, left));
        if scissors.hanging() {
            return self.with(styling);
        }
        self.at_rest(styling, Change::Handled)
    }

    fn grow(
        &self,
        grow: &Grow,
        mut stages: Option<&mut Vec<Hairstyle>>,
    ) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(&grow.selection)?;
        let spec = &self.before.spec.length;
        let by: Vec<f64> = (self.before.styling.wisps.iter().zip(&self.before.guides).zip(&chosen))
            .map(|((wisp, guide), &chosen)| match grow.amount {
                _ if !chosen => 0.0,
                Growth::By(length) => length,
                Growth::For(time) => time * spec.growth_rate,
                Growth::To(length) => (length * guide.share - wisp.length).max(0.0),
            })
            .collect();
        let too_long = |(wisp, by): (&WispState, &f64)| wisp.length + by > LONGEST;
        if let Some(wisp) = self.before.styling.wisps.iter().zip(&by).position(too_long) {
            let length = self.before.styling.wisps[wisp].length + by[wisp];
            return Err(StyleError::TooLong { wisp, length, most: LONGEST });
        }
        let share: Vec<f64> = by.iter().map(|by| by / grow.stages as f64).collect();
        let mut grown = self.grown_by(&share)?;
        for _ in 1..grow.stages {
            let next = self.on(&grown).grown_by(&share)?;
            let before = std::mem::replace(&mut grown, next);
            if let Some(stages) = &mut stages {
                stages.push(before);
            }
        }
        Ok(grown)
    }

    /// Every wisp longer by so much (m), in as many steps as that takes.
    fn grown_by(&self, by: &[f64]) -> Result<Hairstyle, StyleError> {
        let (factor, least) = GROWN_AT_ONCE;
        let steps = |(wisp, by): (&WispState, &f64)| {
            let steps = ((wisp.length + by) / wisp.length).ln() / factor.ln();
            steps.min(by / least).ceil().max(1.0) as usize
        };
        let steps = self.before.styling.wisps.iter().zip(by).map(steps).max().unwrap_or(1);
        let mut grown = self.before.clone();
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
            let mut styling = self.before.styling.clone();
            let now: Vec<f64> = (styling.wisps.iter().zip(by))
                .map(|(wisp, &by)| if by > 0.0 { share(wisp.length, by) } else { 0.0 })
                .collect();
            for (wisp, &by) in styling.wisps.iter_mut().zip(&now) {
                wisp.grow(by);
            }
            styling.ends = styling.ends.as_ref().map(|ends| ends.grown(&now));
            grown = self.on(&grown).with(styling)?;
        }
        Ok(grown)
    }

    fn comb(&self, comb: &Comb) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(&comb.selection)?;
        let direction = comb.towards.vector();
        let combing = self.before.styling.changed(&chosen, |_, wisp| {
            wisp.moved += 1;
            wisp.grip = Some(Grip::Comb { direction, strength: comb.strength });
        });
        let combed = self.with(combing)?;
        if comb.hold {
            return Ok(combed);
        }
        let free = combed.styling.changed(&chosen, |_, wisp| wisp.grip = None);
        self.on(&combed).with(free)
    }

    /// Roots turn as if the hair had been planted with this parting; fibres stay what they are.
    fn part(&self, part: &Part) -> Result<Hairstyle, StyleError> {
        let mut spec = self.before.spec.clone();
        let offset = match part.line {
            Parting::Straight { offset } | Parting::Zigzag { offset } => offset,
            Parting::Through(_) => 0.0,
        };
        spec.implantation.flow = Flow::Parted { offset };
        spec.implantation.partings = vec![part.line.clone()];
        let layout = Layout::new(&spec, self.head)?;
        let placement = &self.before.placement;
        let planned = plan(&spec, self.head, &layout, placement.roots(), placement.area())?;
        let everyone = vec![true; planned.len()];
        let mut styling = self.before.styling.changed(&everyone, |_, wisp| wisp.moved += 1);
        styling.planned = planned.into();
        let before = Hairstyle { spec, layout, ..self.before.clone() };
        let mut parted = self.on(&before).with(styling)?;
        let ends = parted.styling.ends.take();
        parted.styling.ends = ends.map(|ends| ends.replanted(&parted, self.head));
        Ok(parted)
    }

    fn hold(&self, hold: &Hold) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(&hold.selection)?;
        let styling = self.before.styling.changed(&chosen, |_, wisp| {
            wisp.moved += 1;
            wisp.grip = Some(Grip::Holder(hold.by));
        });
        self.with(styling)
    }

    fn release(&self, release: &Release) -> Result<Hairstyle, StyleError> {
        let chosen = self.selected(&release.selection)?;
        let styling = self.before.styling.changed(&chosen, |_, wisp| wisp.grip = None);
        self.with(styling)
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
