//! Sections of the hair: what the scene says of them, and what they do to the picture and to steps.

use std::sync::Arc;

use frisure::hairstyle::styling::Selection;
use frisure::scene::{edit, write_selection};
use frisure_engine::{Preview, SceneRef};
use glam::Vec3;

use super::command::Command;
use super::files::quoted;
use super::jobs::Purpose;
use super::salon::{DrawnHair, Salon};
use super::scissors::Snip;
use super::section::{Section, shown};
use super::selection::{SelectMode, Selected};
use crate::locale::tr;

impl Salon {
    /// Executes a command about sections.
    pub(super) fn section(&mut self, command: Command) {
        match command {
            Command::AddSection => self.add_section(),
            Command::Part(snip) => self.part(&snip),
            Command::SelectSection(index, mode) => self.select_section(index, mode),
            Command::RenameSection(index, name) => self.rename_section(index, name.trim()),
            Command::HideSection(index, hidden) => {
                let id = if hidden { "section-hidden" } else { "section-shown" };
                self.set_section(index, "hidden", hidden, id);
            }
            Command::LockSection(index, locked) => {
                let id = if locked { "section-locked" } else { "section-unlocked" };
                self.set_section(index, "locked", locked, id);
            }
            Command::RemoveSection(index) => {
                let Some(section) = self.sections.get(index) else { return };
                let label = tr!("section-removed", name = &*section.name);
                self.edit_sections(&label, &[(&format!("section[{index}]"), None)]);
            }
            _ => {}
        }
    }

    /// Takes the sections of the current text; what is known of those that are the same is kept.
    pub(super) fn update_sections(&mut self) {
        let Some(parsed) = &self.scene else {
            self.sections.clear();
            return;
        };
        if parsed.scene.sections.is_empty() {
            self.sections.clear();
            return;
        }
        let count = self.current.as_ref().map_or(0, |current| current.hair.roots.len());
        let known = std::mem::take(&mut self.sections);
        let new = parsed.scene.sections.iter().map(|section| {
            let before = known.iter().find(|other| other.selection == section.selection);
            let wisps = before.and_then(|other| other.wisps.clone());
            Section {
                name: section.name.clone(),
                selection: section.selection.clone(),
                hidden: section.hidden,
                locked: section.locked,
                // After the number of wisps has changed they are others.
                wisps: wisps.filter(|wisps| wisps.len() == count),
            }
        });
        self.sections = new.collect();
    }

    /// Requests the wisps of the first section of which they are not known; returns whether there is one.
    pub(super) fn request_section(&mut self, scene: &SceneRef) -> bool {
        let Some(index) = self.sections.iter().position(|section| section.wisps.is_none()) else {
            return false;
        };
        self.request_selection(scene, index)
    }

    fn request_selection(&mut self, scene: &SceneRef, index: usize) -> bool {
        let selection = self.sections[index].selection.clone();
        let Some(request) = self.select_request(scene, &selection) else {
            self.sections[index].wisps = Some(Vec::new());
            return true;
        };
        self.jobs.start(Purpose::Section(index), scene.clone(), request);
        true
    }

    /// Takes the wisps of a section.
    pub(super) fn take_section(&mut self, index: usize, wisps: Vec<bool>) {
        if let Some(section) = self.sections.get_mut(index) {
            section.wisps = Some(wisps);
        }
    }

    fn edit_sections(&mut self, label: &str, changes: &[(&str, Option<&str>)]) {
        let Some(base) = self.base() else { return };
        let text = edit::set_keys(base, changes);
        let fresh = self.selected_in.as_deref() == Some(base);
        if self.change(label, text, false) && fresh {
            // Sections change no hair: a selection by shape is still that of this text.
            self.selected_in = self.base().map(str::to_owned);
        }
        self.update_sections();
    }

    fn set_section(&mut self, index: usize, key: &str, value: bool, id: &str) {
        let Some(section) = self.sections.get(index) else { return };
        let label = tr!(id, name = &*section.name);
        self.edit_sections(
            &label,
            &[(&format!("section[{index}].{key}"), value.then_some("true"))],
        );
    }

    fn rename_section(&mut self, index: usize, name: &str) {
        let Some(section) = self.sections.get(index) else { return };
        if name.is_empty() || name == section.name {
            return;
        }
        let label = tr!("section-renamed", before = &*section.name, name = name);
        let written = quoted(name);
        self.edit_sections(&label, &[(&format!("section[{index}].name"), Some(&written))]);
    }

    fn select_section(&mut self, index: usize, mode: SelectMode) {
        let Some(section) = self.sections.get(index) else { return };
        let Section { name, selection, wisps, .. } = section.clone();
        self.selected = match mode {
            SelectMode::Replace => Selected { selection, label: name, wisps },
            _ => self.selected.with(selection, &name, mode),
        };
        self.selected_in = self.base().map(str::to_owned);
        self.cut_preview = None;
    }

    /// A name that no section has.
    fn new_name(&self, more: usize) -> String {
        let taken = |name: &String| self.sections.iter().any(|section| section.name == *name);
        let names = (self.sections.len() + more + 1..).map(|n| tr!("section-name", number = n));
        names.into_iter().find(|name| !taken(name)).unwrap_or_default()
    }

    /// Makes a section of the selected hair.
    fn add_section(&mut self) {
        if self.selected.is_everything() {
            return self.notify(tr!("section-of-nothing"), tr!("section-of-nothing.hint"), false);
        }
        // The shape of hair changes; a section keeps its wisps.
        let selection = self.selected.fixed().selection;
        let name = self.new_name(0);
        self.add_sections(&tr!("section-added", name = &*name), vec![(name, selection)]);
    }

    fn add_sections(&mut self, label: &str, sections: Vec<(String, Selection)>) {
        let first = self.sections.len();
        let mut keys = Vec::new();
        for (index, (name, selection)) in (first..).zip(sections) {
            let Ok(written) = write_selection(&selection) else { return };
            let name = quoted(&name);
            keys.push((format!("section[{index}].name"), name));
            keys.push((format!("section[{index}].where"), written));
        }
        let changes: Vec<_> =
            keys.iter().map(|(key, v)| (key.as_str(), Some(v.as_str()))).collect();
        self.edit_sections(label, &changes);
    }

    /// Parts the selected hair along a stroke across the picture, into a section on each side.
    fn part(&mut self, snip: &Snip) {
        let top = self.top();
        let Some((point, normal)) = snip.plane(&self.orbit, top) else { return };
        let Some(current) = &self.current else { return };
        let untouched = self.untouched();
        let selected = self.selected.wisps.as_deref();
        let candidate = |wisp: usize| {
            let is_in = |of: Option<&[bool]>| of.is_none_or(|of| of.get(wisp) == Some(&true));
            is_in(selected) && untouched.get(wisp) != Some(&true)
        };
        let sides = current.hair.roots.iter().enumerate().filter(|(wisp, _)| candidate(*wisp));
        let beyond =
            |root: &[f32; 3]| (Vec3::from_array(*root).as_dvec3() - point).dot(normal) > 0.0;
        let (beyond, within): (Vec<_>, Vec<_>) = sides.partition(|(_, root)| beyond(root));
        if beyond.is_empty() || within.is_empty() {
            return self.notify(tr!("parts-no-hair"), tr!("parts-no-hair.hint"), false);
        }
        let wisps =
            |side: Vec<(usize, _)>| Selection::Wisps(side.into_iter().map(|(i, _)| i).collect());
        let (first, second) = (self.new_name(0), self.new_name(1));
        let label = tr!("section-parted", first = &*first, second = &*second);
        self.add_sections(&label, vec![(first, wisps(within)), (second, wisps(beyond))]);
    }

    /// Whether each wisp is in a section that is hidden or locked; empty if there are none.
    pub(super) fn untouched(&self) -> Vec<bool> {
        self.union(|section| section.hidden || section.locked)
    }

    fn union(&self, such: impl Fn(&Section) -> bool) -> Vec<bool> {
        let mut all = Vec::new();
        for wisps in self.sections.iter().filter(|s| such(s)).filter_map(|s| s.wisps.as_ref()) {
            all.resize(wisps.len().max(all.len()), false);
            all.iter_mut().zip(wisps).for_each(|(all, is)| *all |= is);
        }
        all
    }

    /// A selection without the hair of sections that are hidden or locked.
    pub(super) fn touched(&self, selection: Selection) -> Selection {
        let locked = self.sections.iter().filter(|section| section.hidden || section.locked);
        let locked: Vec<_> = locked.map(|section| section.selection.clone()).collect();
        if locked.is_empty() {
            return selection;
        }
        let rest = Selection::Not(Box::new(match <[Selection; 1]>::try_from(locked) {
            Ok([one]) => one,
            Err(several) => Selection::Any(several),
        }));
        match selection {
            Selection::Everything => rest,
            selection => Selection::All(vec![selection, rest]),
        }
    }

    /// Whether no selected wisp is left that steps may change.
    pub(super) fn is_all_locked(&self) -> bool {
        let untouched = self.untouched();
        let Some(current) = self.current.as_ref().filter(|_| !untouched.is_empty()) else {
            return false;
        };
        let selected = self.selected.wisps.as_deref();
        let is_in = |wisp: usize| selected.is_none_or(|of| of.get(wisp) == Some(&true));
        (0..current.hair.roots.len()).all(|wisp| !is_in(wisp) || untouched.get(wisp) == Some(&true))
    }

    /// Hair of this head without that of hidden sections.
    pub(super) fn without_hidden(&self, hair: &Arc<Preview>) -> Arc<Preview> {
        let hidden = self.union(|section| section.hidden);
        if !hidden.contains(&true) {
            return hair.clone();
        }
        let strands = shown(&hair.strands, &hidden);
        Arc::new(Preview { strands, ..Preview::clone(hair) })
    }

    /// The hair that is drawn, without hidden sections, with a number that differs for each.
    pub fn drawn(&mut self) -> Option<(Arc<Preview>, u64)> {
        let current = self.current.as_ref()?;
        Some(self.visible(0, current.hair.clone(), current.version))
    }

    /// The same of the hair that is shown beside it.
    pub fn drawn_comparison(&mut self) -> Option<(Arc<Preview>, u64)> {
        let comparison = self.comparison.as_ref()?;
        Some(self.visible(1, comparison.hair.clone()?, comparison.version))
    }

    /// What is visible of the hair of a version; `which` is the place where it is kept.
    fn visible(&mut self, which: usize, hair: Arc<Preview>, of: u64) -> (Arc<Preview>, u64) {
        let hidden = self.union(|section| section.hidden);
        if !hidden.contains(&true) {
            return (hair, of);
        }
        let known = self.drawn[which].as_ref();
        if let Some(drawn) = known.filter(|drawn| drawn.of == of && drawn.hidden == hidden) {
            return (drawn.hair.clone(), drawn.version);
        }
        let hair = self.without_hidden(&hair);
        self.version += 1;
        let version = self.version;
        self.drawn[which] = Some(DrawnHair { of, hidden, hair: hair.clone(), version });
        (hair, version)
    }
}
