//! Exercises: hair to begin with, a goal, and a measure of how near to it hair is.

use std::path::Path;
use std::sync::Arc;

use frisure::scene::{Scene, edit};
use frisure_engine::{Preview, StrandsData};
use glam::Vec3;

use crate::locale;

/// An exercise of the gallery.
#[derive(Debug)]
pub struct ExerciseCard {
    /// Its name, after `exercise-` the name of its message: the title, with the attributes `about` and `text`.
    pub name: &'static str,
    /// The picture of its goal (JPEG).
    pub picture: &'static [u8],
    /// The scene of the goal: its steps are a good solution.
    pub scene: &'static str,
}

macro_rules! exercise {
    ($name:literal) => {
        ExerciseCard {
            name: $name,
            picture: include_bytes!(concat!("../../gallery/exercise-", $name, ".jpg")),
            scene: include_str!(concat!("../../exercises/", $name, ".toml")),
        }
    };
}

/// The exercises of the gallery, the easiest first.
pub const EXERCISES: [ExerciseCard; 6] = [
    exercise!("fringe"),
    exercise!("bob"),
    exercise!("layers"),
    exercise!("curly-cut"),
    exercise!("braid"),
    exercise!("twist-out"),
];

impl ExerciseCard {
    /// An attribute of its message, or with an empty name its title.
    #[must_use]
    pub fn says(&self, attribute: &str) -> String {
        let dot = if attribute.is_empty() { "" } else { "." };
        locale::text(&format!("exercise-{}{dot}{attribute}", self.name))
    }
}

/// The exercise that somebody does.
#[derive(Clone, Debug)]
pub struct Exercise {
    /// Its title.
    pub title: String,
    /// What is to be done.
    pub text: String,
    /// The scene with none of the steps of the solution, with one, and so on; the last one is the goal.
    pub(super) scenes: Vec<String>,
    /// The hair to begin with, and the goal; `None` until they are computed.
    pub(super) hair: [Option<Arc<Preview>>; 2],
    pub(super) version: u64,
    /// Whether hair that is not at its goal is marked.
    pub marks: bool,
    /// The step that the solution shows next; `None` while it is not shown.
    pub replay: Option<usize>,
    /// Since when the hair of the last step is at rest (s).
    pub(super) rests_since: Option<f64>,
    /// How near the hair of a version is.
    pub(super) measured: Option<(u64, Nearness)>,
}

impl Exercise {
    /// An exercise whose goal is a scene; `None` for a scene without steps.
    pub(super) fn new(title: String, text: String, scene: &str) -> Option<Self> {
        let steps = Scene::parse("exercise", scene, Path::new("")).ok()?.steps().len();
        let mut scenes = vec![scene.to_owned()];
        for last in (0..steps).rev() {
            scenes.push(edit::remove(scenes.last()?, last).ok()?);
        }
        scenes.reverse();
        (steps > 0).then_some(Self {
            title,
            text,
            scenes,
            hair: [None, None],
            version: 0,
            marks: false,
            replay: None,
            rests_since: None,
            measured: None,
        })
    }

    /// How many steps its solution has.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.scenes.len() - 1
    }

    /// The goal.
    #[must_use]
    pub fn goal(&self) -> Option<&Arc<Preview>> {
        self.hair[1].as_ref()
    }

    /// Differs for each goal.
    #[must_use]
    pub fn version(&self) -> u64 {
        self.version
    }

    /// How near to its goal hair was when it was measured last; `None` before.
    #[must_use]
    pub fn last_nearness(&self) -> Option<Nearness> {
        self.measured.map(|(_, nearness)| nearness)
    }

    /// How near to the goal hair is; `None` until the goal is computed, and for hair of other roots.
    pub(super) fn nearness(&self, hair: &Preview) -> Option<Nearness> {
        let [Some(start), Some(goal)] = &self.hair else { return None };
        Nearness::of(&start.strands, &hair.strands, &goal.strands)
    }
}

/// How near to a goal hair is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearness {
    /// How much of the way from the start is done: 1 at the goal, 0 as far away as at the start.
    pub done: f64,
    /// Fraction of the hairs that are longer than in the goal.
    pub long: f64,
    /// Fraction that are shorter.
    pub short: f64,
    /// Fraction that are as long, and lie elsewhere.
    pub elsewhere: f64,
}

/// Distance (m) within which a hair is at its goal, as a mean along it. Chosen: what a hairdresser calls the same line.
const NEAR: f32 = 0.01;

/// Distance (m) from which a hair counts as no farther away, so that single hairs which fall on the other side of a shoulder do not
/// outweigh all others. Chosen.
const FAR: f32 = 0.06;

/// Difference of length (m) from which hair is longer or shorter. Chosen.
const LENGTH: f32 = 0.005;

/// How much of the way has to be done. Chosen.
const PASSED: f64 = 0.8;

impl Nearness {
    /// Of drawn hairs that were at a start and have a goal; `None` if they are not the same hairs.
    fn of(start: &StrandsData, now: &StrandsData, goal: &StrandsData) -> Option<Self> {
        let same = |other: &StrandsData| other.guide == now.guide;
        if now.guide.is_empty() || !same(start) || !same(goal) {
            return None;
        }
        let count = now.guide.len();
        let (mut before, mut after) = (0.0, 0.0);
        let [mut long, mut short, mut elsewhere] = [0_usize; 3];
        for hair in 0..count {
            before += f64::from(away(start, goal, hair).min(FAR));
            let distance = away(now, goal, hair);
            after += f64::from(distance.min(FAR));
            match Way::of(now, goal, hair) {
                Some(Way::Long(_)) => long += 1,
                Some(Way::Short) => short += 1,
                Some(Way::Elsewhere) => elsewhere += 1,
                None => {}
            }
        }
        let part = |n: usize| n as f64 / count as f64;
        let done = if before > 0.0 { 1.0 - after / before } else { 1.0 };
        Some(Self { done, long: part(long), short: part(short), elsewhere: part(elsewhere) })
    }

    /// Whether the exercise is done well.
    #[must_use]
    pub fn is_passed(&self) -> bool {
        self.done >= PASSED
    }
}

/// In which way a hair is not at its goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// It is longer; with the fraction of its length that the goal has.
    Long(f32),
    /// It is shorter.
    Short,
    /// It is as long, and lies elsewhere.
    Elsewhere,
}

impl Way {
    /// That of a hair; `None` if it is at its goal.
    #[must_use]
    pub fn of(now: &StrandsData, goal: &StrandsData, hair: usize) -> Option<Self> {
        if away(now, goal, hair) <= NEAR {
            return None;
        }
        let (own, wanted) = (length(points(now, hair)), length(points(goal, hair)));
        Some(match own - wanted {
            longer if longer > LENGTH => Self::Long(wanted / own),
            longer if longer < -LENGTH => Self::Short,
            _ => Self::Elsewhere,
        })
    }
}

/// The points of a hair, three numbers each (m).
fn points(strands: &StrandsData, hair: usize) -> &[[f32; 3]] {
    let at = |i: usize| strands.offsets.get(i).map_or(0, |o| 3 * *o as usize);
    strands.points.get(at(hair)..at(hair + 1)).unwrap_or_default().as_chunks().0
}

fn length(points: &[[f32; 3]]) -> f32 {
    points.windows(2).map(|p| Vec3::from_array(p[0]).distance(Vec3::from_array(p[1]))).sum()
}

/// Mean distance (m) of a hair from its goal, between points at the same fraction of their lengths.
fn away(now: &StrandsData, goal: &StrandsData, hair: usize) -> f32 {
    /// Points along a hair that are compared. Chosen: a hair has some 24.
    const POINTS: usize = 9;
    let (a, b) = (points(now, hair), points(goal, hair));
    if a.is_empty() || b.is_empty() {
        return if a.len() == b.len() { 0.0 } else { FAR };
    }
    let at = |points: &[[f32; 3]], i: usize| {
        let place = i as f32 / (POINTS - 1) as f32 * (points.len() - 1) as f32;
        let (before, part) = (place.floor() as usize, place.fract());
        let after = (before + 1).min(points.len() - 1);
        Vec3::from_array(points[before]).lerp(Vec3::from_array(points[after]), part)
    };
    (0..POINTS).map(|i| at(a, i).distance(at(b, i))).sum::<f32>() / POINTS as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hairs that hang straight down, of these lengths (m).
    fn hanging(lengths: &[f32]) -> StrandsData {
        let mut data = StrandsData { offsets: vec![0], ..StrandsData::default() };
        for (i, length) in lengths.iter().enumerate() {
            for k in 0..5 {
                data.points.extend([i as f32 * 0.01, 0.0, -length * k as f32 / 4.0]);
            }
            data.guide.push(i as u32);
            data.offsets.push(5 * (i as u32 + 1));
        }
        data
    }

    #[test]
    fn the_way_is_measured_from_the_start_to_the_goal() {
        let (start, goal) = (hanging(&[0.2; 4]), hanging(&[0.1; 4]));
        let of = |now: &StrandsData| Nearness::of(&start, now, &goal).expect("the same hairs");
        assert_eq!(of(&start), Nearness { done: 0.0, long: 1.0, short: 0.0, elsewhere: 0.0 });
        assert!(of(&goal).done == 1.0 && of(&goal).is_passed());
        let half = of(&hanging(&[0.1, 0.1, 0.2, 0.2]));
        assert!((half.done - 0.5).abs() < 1e-6 && half.long == 0.5 && !half.is_passed());
        let short = of(&hanging(&[0.05; 4]));
        assert!(short.short == 1.0 && short.done < 0.6, "{short:?}");
        let mut aside = goal.clone();
        aside.points.chunks_exact_mut(3).for_each(|p| p[1] += 0.03);
        assert_eq!(of(&aside).elsewhere, 1.0);
        assert_eq!(Way::of(&start, &goal, 0), Some(Way::Long(0.5)));
        assert_eq!(Nearness::of(&start, &hanging(&[0.1; 3]), &goal), None);
    }

    #[test]
    fn every_exercise_has_a_solution_of_steps() {
        for card in &EXERCISES {
            let exercise = Exercise::new(card.says(""), card.says("text"), card.scene);
            let exercise = exercise.expect("a scene with steps");
            assert!(!card.says("about").is_empty() && exercise.steps() > 0, "{}", card.name);
            for (count, text) in exercise.scenes.iter().enumerate() {
                let scene =
                    Scene::parse("exercise", text.as_str(), Path::new("")).expect("a scene");
                assert_eq!(scene.steps().len(), count, "{}", card.name);
                assert!(scene.hairstyle_spec().is_ok());
            }
        }
        assert!(Exercise::new(String::new(), String::new(), "[hair]\n").is_none());
        assert!(Exercise::new(String::new(), String::new(), "[hair").is_none());
    }
}
