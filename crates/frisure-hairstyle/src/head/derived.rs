//! What follows from other values, and is computed when it is first asked for.

use std::sync::OnceLock;

/// A value that follows from others beside it: as those are compared, two of them are equal, computed or not.
///
/// Whoever asks first computes it, and others wait. So computing it must not wait for threads of a pool: one of them could take up
/// work that asks for the same value.
#[derive(Clone, Debug)]
pub(crate) struct Derived<T>(OnceLock<T>);

impl<T> Derived<T> {
    /// A value that nobody has asked for.
    pub(crate) const fn new() -> Self {
        Self(OnceLock::new())
    }

    /// The value; `compute` gives it at the first time, and must give the same at any time.
    #[inline]
    pub(crate) fn get_or(&self, compute: impl FnOnce() -> T) -> &T {
        match self.0.get() {
            Some(value) => value,
            None => self.first(compute),
        }
    }

    /// Kept apart, so that what asks many times is short.
    #[cold]
    #[inline(never)]
    fn first(&self, compute: impl FnOnce() -> T) -> &T {
        self.0.get_or_init(compute)
    }
}

impl<T> PartialEq for Derived<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
