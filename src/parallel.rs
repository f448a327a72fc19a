//! The same work on many things, on several threads.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// How many threads there are processors for.
pub fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Does `work` on each item once, on `threads` threads, beginning them in order. The results stand in the order of the
/// items; there is none where the work panicked, and for what was not begun before `stop` was set.
pub fn map<T, R>(items: &[T], threads: usize, stop: &AtomicBool, work: impl Fn(&T) -> R + Sync) -> Vec<Option<R>>
where
    T: Sync,
    R: Send,
{
    let next = AtomicUsize::new(0);
    let results: Vec<std::sync::Mutex<Option<R>>> = items.iter().map(|_| std::sync::Mutex::new(None)).collect();
    let each = || {
        while !stop.load(Ordering::Relaxed) {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let (Some(item), Some(place)) = (items.get(index), results.get(index)) else { return };
            // The panic hook has told of a panic already; the other items do not depend on this one.
            let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| work(item)));
            *place.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = result.ok();
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, items.len().max(1)) {
            scope.spawn(each);
        }
    });
    results.into_iter().map(|place| place.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;
    use std::sync::{Barrier, Mutex};

    #[test]
    fn each_item_is_worked_on_once_and_results_keep_the_order() {
        let items: Vec<usize> = (0..1000).collect();
        let seen = Mutex::new(Vec::new());
        let results = map(&items, 8, &AtomicBool::new(false), |&item| {
            seen.lock().unwrap().push(item);
            item * 2
        });
        assert_eq!(results, items.iter().map(|item| Some(item * 2)).collect::<Vec<_>>());
        let seen = seen.into_inner().unwrap();
        assert_eq!((seen.len(), seen.iter().collect::<HashSet<_>>().len()), (1000, 1000));
    }

    #[test]
    fn as_many_are_at_work_as_there_are_threads() {
        // Would hang if fewer than three were.
        let together = Barrier::new(3);
        map(&[(), (), ()], 3, &AtomicBool::new(false), |()| {
            together.wait();
        });
    }

    #[test]
    fn a_panic_costs_its_own_item_only() {
        let results = map(&[1, 2, 3], 2, &AtomicBool::new(false), |&item| {
            assert_ne!(item, 2);
            item
        });
        assert_eq!(results, [Some(1), None, Some(3)]);
    }

    #[test]
    fn nothing_is_begun_after_the_stop() {
        let stop = AtomicBool::new(false);
        let results = map(&[1, 2, 3, 4], 1, &stop, |&item| {
            stop.store(item == 2, Ordering::Relaxed);
            item
        });
        assert_eq!(results, [Some(1), Some(2), None, None]);
        assert_eq!(map(&[] as &[i32], 4, &AtomicBool::new(false), |&item| item), [] as [Option<i32>; 0]);
    }
}
