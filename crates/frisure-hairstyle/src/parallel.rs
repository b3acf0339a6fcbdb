//! Loops over many items on all threads of the current pool of rayon.
//!
//! Rayon's own iterators are compiled once more for each chain of adapters: with a hundred of them they were half of what this crate was
//! compiled to. Here a loop is divided by one function for each type of item, and rayon's [`rayon::join`] is compiled once. No result
//! depends on the number of threads or on how a loop is divided: each item is computed by itself, and lists are in the order of items.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Most parts that a loop is divided into: more than threads, so that parts that take longer are waited for by none; few enough that
/// dividing (30 ns a part) is cheap beside the work. Chosen.
const PARTS: usize = 256;

/// The value of `f` for each index below `count`, in order.
pub(crate) fn map<T: Send>(count: usize, f: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut values: Vec<Option<T>> = (0..count).map(|_| None).collect();
    for_each_mut(&mut values, |i, value| *value = Some(f(i)));
    values.into_iter().map(|value| value.expect("the loop went over all")).collect()
}

/// The value of `f` for each item of a slice, in order.
pub(crate) fn map_slice<'a, A: Sync, T: Send>(
    items: &'a [A],
    f: impl Fn(&'a A) -> T + Sync,
) -> Vec<T> {
    map(items.len(), |i| f(&items[i]))
}

/// The value of `f` for each item of a slice that it may change and its index, in order.
pub(crate) fn map_mut<A: Send, T: Send>(
    items: &mut [A],
    f: impl Fn(usize, &mut A) -> T + Sync,
) -> Vec<T> {
    let mut pairs: Vec<(&mut A, Option<T>)> = items.iter_mut().map(|item| (item, None)).collect();
    for_each_mut(&mut pairs, |i, (item, value)| *value = Some(f(i, item)));
    pairs.into_iter().map(|(_, value)| value.expect("the loop went over all")).collect()
}

/// The value of `f` for each index below `count`, in order, or the error of the lowest index that has one. Items beyond it may be left out.
pub(crate) fn try_map<T: Send, E: Send>(
    count: usize,
    f: impl Fn(usize) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let failed = AtomicUsize::new(usize::MAX);
    let values = map(count, |i| {
        // The order of other memory does not matter: the value is only a reason to do less.
        if i > failed.load(Ordering::Relaxed) {
            return None;
        }
        let value = f(i);
        if value.is_err() {
            failed.fetch_min(i, Ordering::Relaxed);
        }
        Some(value)
    });
    // Before the lowest error nothing was left out.
    values.into_iter().map_while(|value| value).collect()
}

/// Calls `f` with each item of a slice, which it may change, and its index.
pub(crate) fn for_each_mut<A: Send>(items: &mut [A], f: impl Fn(usize, &mut A) + Sync) {
    let most = items.len().div_ceil(PARTS).max(1);
    divide(items, 0, most, &|first, part| {
        part.iter_mut().enumerate().for_each(|(k, item)| f(first + k, item));
    });
}

/// Calls `work` with parts of a slice of at most so many items and the index of the first item of each.
fn divide<A: Send>(
    items: &mut [A],
    first: usize,
    most: usize,
    work: &(dyn Fn(usize, &mut [A]) + Sync),
) {
    if items.len() <= most {
        return work(first, items);
    }
    let half = items.len().div_ceil(most) / 2 * most;
    let (left, right) = items.split_at_mut(half);
    both(&mut || divide(left, first, most, work), &mut || divide(right, first + half, most, work));
}

/// Calls both, at the same time where a thread is free. Not generic: it is compiled once.
fn both(left: &mut (dyn FnMut() + Send), right: &mut (dyn FnMut() + Send)) {
    rayon::join(left, right);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_threads<T: Send>(threads: usize, f: impl FnOnce() -> T + Send) -> T {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(f)
    }

    #[test]
    fn every_item_is_met_once_and_in_its_place() {
        for count in [0, 1, 2, 255, 256, 257, 1000, 100_003] {
            for threads in [1, 3] {
                let squares = on_threads(threads, || map(count, |i| i * i));
                assert!(squares.iter().enumerate().all(|(i, square)| *square == i * i));
                assert_eq!(squares.len(), count);
                let mut seen = vec![0; count];
                let places = on_threads(threads, || {
                    map_mut(&mut seen, |i, times| {
                        *times += 1;
                        i
                    })
                });
                assert!(seen.iter().all(|times| *times == 1));
                assert!(places.into_iter().eq(0..count));
            }
        }
    }

    #[test]
    fn the_error_is_that_of_the_lowest_index() {
        let odd = |i: usize| if i >= 700 && i % 2 == 1 { Err(i) } else { Ok(i) };
        for threads in [1, 3, 8] {
            for _ in 0..20 {
                assert_eq!(on_threads(threads, || try_map(10_000, odd)), Err(701));
            }
            assert_eq!(on_threads(threads, || try_map(700, odd)), Ok((0..700).collect()));
        }
    }

    #[test]
    fn a_panic_of_an_item_is_that_of_the_loop() {
        let panics = || map(1000, |i| assert!(i != 900, "item 900"));
        assert!(std::panic::catch_unwind(panics).is_err());
    }
}
