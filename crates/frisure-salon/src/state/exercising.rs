//! The exercise that somebody does: its hair, how near it is to the goal, and the solution step by step.

use std::path::Path;
use std::sync::Arc;

use frisure::scene::Scene;
use frisure_engine::{Preview, Quality, Request};

use super::command::Command;
use super::document::Document;
use super::exercise::{EXERCISES, Exercise, Nearness, Way};
use super::jobs::Purpose;
use super::salon::{Compared, Comparison, Salon, parse, scene_ref};
use super::sharing;
use crate::locale::tr;

/// Time (s) that hair at rest is shown before the solution goes on. Chosen: long enough to see what a step has done.
const PAUSE: f64 = 1.2;

impl Salon {
    /// Executes a command of exercises.
    pub(super) fn practise(&mut self, command: Command) {
        match command {
            Command::BeginExercise(name) => self.begin_exercise(&name),
            Command::CompareGoal => self.compare_with_goal(),
            Command::ToggleGoalMarks => {
                if let Some(exercise) = &mut self.exercise {
                    exercise.marks = !exercise.marks;
                }
            }
            Command::RestartExercise => self.restart_exercise(),
            Command::ToggleReplay => self.toggle_replay(),
            Command::EndExercise => self.end_exercise(),
            _ => {}
        }
    }

    /// Begins an exercise of the gallery by its name, or one whose goal is the scene of a link.
    fn begin_exercise(&mut self, name: &str) {
        let exercise = match sharing::decoded(name) {
            Some(Ok(scene)) => {
                let title = match Scene::parse("exercise", scene.as_str(), Path::new("")) {
                    Ok(parsed) if !parsed.name.is_empty() => parsed.name,
                    Ok(_) => tr!("exercise-shared"),
                    Err(error) => return self.report_error(&(&error).into()),
                };
                Exercise::new(title, tr!("exercise-shared.text"), &scene)
            }
            Some(Err(problem)) => {
                let text = tr!("link-damaged", problem = problem);
                return self.notify(text, tr!("link-damaged.hint"), true);
            }
            None => EXERCISES
                .iter()
                .find(|card| card.name == name)
                .and_then(|card| Exercise::new(card.says(""), card.says("text"), card.scene)),
        };
        let Some(exercise) = exercise else {
            let text = tr!("no-such-exercise", name = name);
            return self.notify(text, tr!("no-such-exercise.hint"), true);
        };
        let (title, scenes) = (exercise.title.clone(), exercise.scenes.clone());
        if !self.open_document(Document::new(&title, None, &title, &*scenes[0])) {
            return;
        }
        self.tour = None;
        self.version += 1;
        self.exercise = Some(Exercise { version: self.version, ..exercise });
        // The goal continues from the hair to begin with, which the same worker has then.
        for (part, text) in [&scenes[0], &scenes[scenes.len() - 1]].into_iter().enumerate() {
            let Some(document) = &self.document else { return };
            let Ok(parsed) = parse(document, text) else { return };
            let scene = scene_ref(document, text, &parsed);
            let request = Request::Preview { scene: scene.clone(), quality: Quality::Exact };
            self.jobs.enqueue(Purpose::Exercise(self.version, part), scene, request);
        }
    }

    /// Takes the hair to begin with (part 0), or the goal (part 1) of the exercise of a version.
    pub(super) fn take_goal(&mut self, version: u64, part: usize, hair: Preview) {
        if let Some(exercise) = self.exercise.as_mut().filter(|e| e.version == version) {
            exercise.hair[part] = Some(Arc::new(hair));
            exercise.measured = None;
            if let Some(comparison) = self.comparison.as_mut().filter(|c| c.of == Compared::Goal) {
                comparison.hair = exercise.hair[1].clone();
                comparison.version = version;
            }
        }
    }

    /// Shows the goal beside the current hair, or no longer.
    fn compare_with_goal(&mut self) {
        let Some(exercise) = &self.exercise else { return };
        let shown = self.comparison.as_ref().is_some_and(|c| c.of == Compared::Goal);
        self.comparison = (!shown).then(|| Comparison {
            of: Compared::Goal,
            label: tr!("exercise-goal"),
            hair: exercise.hair[1].clone(),
            version: exercise.version,
        });
    }

    /// Goes back to the hair to begin with.
    fn restart_exercise(&mut self) {
        let Some(exercise) = &mut self.exercise else { return };
        (exercise.replay, exercise.rests_since) = (None, None);
        let text = exercise.scenes[0].clone();
        self.change(&tr!("exercise-restarted"), Ok(text), false);
    }

    /// Shows the solution from the beginning, or stops.
    fn toggle_replay(&mut self) {
        let Some(exercise) = &mut self.exercise else { return };
        if exercise.replay.take().is_none() {
            self.restart_exercise();
            if let Some(exercise) = &mut self.exercise {
                exercise.replay = Some(1);
            }
        }
    }

    /// Whether a solution is shown, whose next step comes with time and not with an event.
    #[must_use]
    pub fn shows_solution(&self) -> bool {
        self.exercise.as_ref().is_some_and(|exercise| exercise.replay.is_some())
    }

    /// Shows the next step of the solution, when the hair of the last one has been at rest for a moment.
    pub(super) fn advance_replay(&mut self, now: f64) {
        let settled = self.is_settled();
        let Some(exercise) = self.exercise.as_mut() else { return };
        let Some(next) = exercise.replay else { return };
        // Whoever undoes or edits meanwhile goes on alone.
        let shown = self.document.as_ref().map(Document::text);
        if shown != exercise.scenes.get(next - 1).map(|scene| &**scene) {
            (exercise.replay, exercise.rests_since) = (None, None);
            return;
        }
        if !settled {
            exercise.rests_since = None;
            return;
        }
        let since = *exercise.rests_since.get_or_insert(now);
        if now - since < PAUSE {
            return;
        }
        exercise.rests_since = None;
        exercise.replay = (next < exercise.steps()).then_some(next + 1);
        let Some(text) = exercise.scenes.get(next).cloned() else { return };
        let label = self.label_of_last_step(&text);
        self.change(&label, Ok(text), false);
    }

    /// Ends the exercise; the hair stays.
    fn end_exercise(&mut self) {
        self.exercise = None;
        if self.comparison.as_ref().is_some_and(|c| c.of == Compared::Goal) {
            self.comparison = None;
        }
    }

    /// How near to the goal the shown hair is; `None` without an exercise, and until hair and goal are at rest.
    pub fn nearness(&mut self) -> Option<Nearness> {
        if !self.is_settled() {
            return self.exercise.as_ref()?.measured.map(|(_, nearness)| nearness);
        }
        let current = self.current.as_ref()?;
        let (hair, version) = (current.hair.clone(), current.version);
        let exercise = self.exercise.as_mut()?;
        if exercise.measured.is_none_or(|(measured, _)| measured != version) {
            exercise.measured = exercise.nearness(&hair).map(|nearness| (version, nearness));
        }
        exercise.measured.map(|(_, nearness)| nearness)
    }

    /// In which way a drawn hair is not at its goal, where that is to be marked.
    #[must_use]
    pub fn way_to_goal(&mut self) -> Option<impl Fn(usize) -> Option<Way> + use<>> {
        let exercise = self.exercise.as_ref().filter(|exercise| exercise.marks)?;
        // Of the goal, too, what is hidden is left out: hairs correspond by their numbers.
        let goal = self.without_hidden(exercise.goal()?);
        let (hair, _) = self.drawn()?;
        let same = goal.strands.guide == hair.strands.guide;
        same.then_some(move |i: usize| Way::of(&hair.strands, &goal.strands, i))
    }
}
