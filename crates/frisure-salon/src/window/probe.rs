//! Where widgets are, by the label that a person reads: for tests of a page, whose canvas has no
//! elements of its own.

use std::cell::RefCell;
use std::collections::BTreeMap;

use eframe::egui::Rect;

thread_local! {
    static PLACES: RefCell<BTreeMap<String, Rect>> = const { RefCell::new(BTreeMap::new()) };
}

/// A widget is here in this frame (points of the window).
pub(crate) fn record(label: &str, rect: Rect) {
    PLACES.with_borrow_mut(|places| {
        places.insert(label.to_owned(), rect);
    });
}

/// A frame begins: nothing is anywhere yet.
pub(crate) fn begin() {
    PLACES.with_borrow_mut(BTreeMap::clear);
}

/// Where a widget is.
#[must_use]
pub fn place(label: &str) -> Option<Rect> {
    PLACES.with_borrow(|places| places.get(label).copied())
}
