//! What was done to a hairstyle, step by step.

use std::sync::Arc;

use thiserror::Error;

use crate::hairstyle::Hairstyle;
use crate::head::Head;
use crate::styling::{Operation, StyleError, StyleOptions, style};
use frisure_progress::Progress;

/// A hairstyle and the list of what was done to it, which can be undone, done again and edited.
///
/// The list is what counts: hairstyles between the steps are kept only to be quick, and what has
/// been dropped is computed again, to the same bytes.
#[derive(Clone, Debug)]
pub struct History {
    start: Arc<Hairstyle>,
    operations: Vec<Operation>,
    /// How many of the operations are done; the rest are undone.
    done: usize,
    /// The hairstyle after each operation, if it is still known.
    known: Vec<Option<Arc<Hairstyle>>>,
    current: Arc<Hairstyle>,
}

/// Why a list of operations cannot be done; the history is as it was.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("step {}: {error}", step + 1)]
pub struct HistoryError {
    /// Which operation, from 0.
    pub step: usize,
    /// What is wrong.
    pub error: StyleError,
}

/// How many hairstyles of the past are kept, some megabytes each. Chosen; no result depends on it.
const KEPT: usize = 32;

impl History {
    /// Nothing has been done yet.
    #[must_use]
    pub fn new(start: Hairstyle) -> Self {
        let start = Arc::new(start);
        let (operations, known) = (Vec::new(), Vec::new());
        Self { current: start.clone(), start, operations, done: 0, known }
    }

    /// A list of operations of which the first `done` are done; at most all.
    ///
    /// # Errors
    /// [`HistoryError`], if one of those cannot be done.
    pub fn replay(
        start: Hairstyle,
        operations: Vec<Operation>,
        done: usize,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<Self, HistoryError> {
        let done = done.min(operations.len());
        let known = vec![None; operations.len()];
        let mut history = Self { operations, known, ..Self::new(start) };
        history.go_to(done, head, progress)?;
        Ok(history)
    }

    /// The hairstyle that it begins with.
    #[must_use]
    pub fn start(&self) -> &Hairstyle {
        &self.start
    }

    /// The hairstyle as it is now.
    #[must_use]
    pub fn current(&self) -> &Hairstyle {
        &self.current
    }

    /// Everything that was done, and after [`Self::done`] what was undone.
    #[must_use]
    pub fn operations(&self) -> &[Operation] {
        &self.operations
    }

    /// How many operations are done.
    #[must_use]
    pub fn done(&self) -> usize {
        self.done
    }

    /// Does something more; what was undone is forgotten.
    ///
    /// # Errors
    /// [`HistoryError`]; nothing is forgotten then.
    pub fn apply(
        &mut self,
        operation: Operation,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<&Hairstyle, HistoryError> {
        let mut operations = self.operations[..self.done].to_vec();
        operations.push(operation);
        self.become_list(operations, self.done, self.done + 1, head, progress)
    }

    /// Undoes the last operation; `false` if there is none.
    ///
    /// # Errors
    /// [`HistoryError`], if the hairstyle before it is not known any more and its computing is
    /// cancelled.
    pub fn undo(&mut self, head: &Head, progress: &dyn Progress) -> Result<bool, HistoryError> {
        let Some(done) = self.done.checked_sub(1) else { return Ok(false) };
        self.go_to(done, head, progress)?;
        Ok(true)
    }

    /// Does the first undone operation again; `false` if there is none.
    ///
    /// # Errors
    /// [`HistoryError`], if it cannot be done, or its computing is cancelled.
    pub fn redo(&mut self, head: &Head, progress: &dyn Progress) -> Result<bool, HistoryError> {
        if self.done == self.operations.len() {
            return Ok(false);
        }
        self.go_to(self.done + 1, head, progress)?;
        Ok(true)
    }

    /// Undoes or does again until `done` operations are done; at most all.
    ///
    /// # Errors
    /// [`HistoryError`], if one cannot be done, or its computing is cancelled.
    pub fn go_to(
        &mut self,
        done: usize,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<(), HistoryError> {
        let done = done.min(self.operations.len());
        let (mut at, mut current) = self.nearest(done);
        while at < done {
            let options = StyleOptions::default();
            let styled = style(&current, head, &self.operations[at], options, progress);
            current = Arc::new(styled.map_err(|error| HistoryError { step: at, error })?);
            self.known[at] = Some(current.clone());
            at += 1;
        }
        (self.done, self.current) = (done, current);
        self.forget();
        Ok(())
    }

    /// Puts another operation in the place of one, and does what follows it again.
    ///
    /// # Errors
    /// [`HistoryError`], if one cannot be done any more; the history is as it was.
    ///
    /// # Panics
    /// If there is no operation `step`.
    pub fn replace(
        &mut self,
        step: usize,
        operation: Operation,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<&Hairstyle, HistoryError> {
        let mut operations = self.operations.clone();
        operations[step] = operation;
        self.become_list(operations, step, self.done, head, progress)
    }

    /// Inserts an operation before another, as if it had been done there; one that is inserted among
    /// what is undone is not done.
    ///
    /// # Errors
    /// [`HistoryError`], if one cannot be done any more; the history is as it was.
    ///
    /// # Panics
    /// If `step` is larger than the number of operations.
    pub fn insert(
        &mut self,
        step: usize,
        operation: Operation,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<&Hairstyle, HistoryError> {
        let mut operations = self.operations.clone();
        operations.insert(step, operation);
        let done = self.done + usize::from(step <= self.done);
        self.become_list(operations, step, done, head, progress)
    }

    /// Takes an operation out, as if it had never been done.
    ///
    /// # Errors
    /// [`HistoryError`], if one cannot be done any more; the history is as it was.
    ///
    /// # Panics
    /// If there is no operation `step`.
    pub fn remove(
        &mut self,
        step: usize,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<&Hairstyle, HistoryError> {
        let mut operations = self.operations.clone();
        operations.remove(step);
        let done = self.done - usize::from(step < self.done);
        self.become_list(operations, step, done, head, progress)
    }

    /// The hairstyle after `done` operations, if it is known.
    #[must_use]
    pub fn known(&self, done: usize) -> Option<&Arc<Hairstyle>> {
        match done.checked_sub(1) {
            None => Some(&self.start),
            Some(last) => self.known.get(last)?.as_ref(),
        }
    }

    /// Takes another list over, of which the first `done` are to be done; at most all. What is known of
    /// the operations that both lists begin with stays known, also where it fails: then as many are done
    /// as could be.
    ///
    /// # Errors
    /// [`HistoryError`], if one cannot be done.
    pub fn follow(
        &mut self,
        operations: Vec<Operation>,
        done: usize,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<&Hairstyle, HistoryError> {
        let same = self.operations.iter().zip(&operations).take_while(|(a, b)| a == b).count();
        self.known.truncate(same);
        self.known.resize(operations.len(), None);
        self.operations = operations;
        if let Err(error) = self.go_to(done, head, progress) {
            (self.done, self.current) = self.nearest(error.step);
            return Err(error);
        }
        Ok(&self.current)
    }

    /// Takes another list over, the same up to `step`, of which `done` are done; all or nothing.
    fn become_list(
        &mut self,
        operations: Vec<Operation>,
        step: usize,
        done: usize,
        head: &Head,
        progress: &dyn Progress,
    ) -> Result<&Hairstyle, HistoryError> {
        let mut known = self.known[..step].to_vec();
        known.resize(operations.len(), None);
        let (start, current) = (self.start.clone(), self.current.clone());
        let mut edited = Self { start, operations, done: 0, known, current };
        edited.go_to(done, head, progress)?;
        *self = edited;
        Ok(&self.current)
    }

    /// The last known hairstyle with at most `done` operations done, and how many it has.
    fn nearest(&self, done: usize) -> (usize, Arc<Hairstyle>) {
        let known = (0..done).rev().find_map(|i| self.known[i].clone().map(|h| (i + 1, h)));
        known.unwrap_or((0, self.start.clone()))
    }

    /// Drops hairstyles far from the current one.
    fn forget(&mut self) {
        let done = self.done;
        for (i, known) in self.known.iter_mut().enumerate() {
            if (i + 1).abs_diff(done) > KEPT / 2 {
                *known = None;
            }
        }
    }
}
