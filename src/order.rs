//! Sorting and selection in place, in little code.
//!
//! The standard library's unstable sort and selection are each several kilobytes of machine code an instance: more than the
//! rest of the door on a microcontroller. The kernel sorts short lists once and splits boxes at medians, so heapsort and a
//! quickselect with a heapsort to fall back on serve as well. Both are in place, without recursion, O(n log n) at worst;
//! for a total order the result does not depend on the algorithm.

/// Sorts by `less`, a strict total order.
pub(crate) fn sort<T>(items: &mut [T], less: impl Fn(&T, &T) -> bool) {
    let len = items.len();
    for root in (0..len / 2).rev() {
        sift(items, root, &less);
    }
    for end in (1..len).rev() {
        swap(items, 0, end);
        sift(items.get_mut(..end).unwrap_or_default(), 0, &less);
    }
}

/// Permutes so that the item that belongs at `rank` in the order is there, and what comes before it in the order lies
/// before it.
pub(crate) fn select<T>(items: &mut [T], rank: usize, less: impl Fn(&T, &T) -> bool) {
    let (mut from, mut to) = (0, items.len());
    // Halving twice as often as luck would need ends the trust in luck.
    let mut rounds = 2 * (usize::BITS - to.leading_zeros());
    while to - from > 1 {
        let Some(range) = items.get_mut(from..to) else { return };
        if rounds == 0 {
            sort(range, less);
            return;
        }
        rounds -= 1;
        let pivot = from + partition(range, &less);
        if rank < pivot {
            to = pivot;
        } else if rank > pivot {
            from = pivot + 1;
        } else {
            return;
        }
    }
}

/// Brings the median of first, middle and last to its place; what comes before it in the order to its left.
fn partition<T>(items: &mut [T], less: &impl Fn(&T, &T) -> bool) -> usize {
    let last = items.len().saturating_sub(1);
    let middle = last / 2;
    for (i, j) in [(0, middle), (middle, last), (0, middle)] {
        if before(items, j, i, less) {
            swap(items, i, j);
        }
    }
    swap(items, middle, last);
    let mut kept = 0;
    for i in 0..last {
        if before(items, i, last, less) {
            swap(items, i, kept);
            kept += 1;
        }
    }
    swap(items, kept, last);
    kept
}

/// Restores the heap below `root`, whose largest item is on top.
fn sift<T>(heap: &mut [T], mut root: usize, less: &impl Fn(&T, &T) -> bool) {
    loop {
        let mut child = 2 * root + 1;
        if child >= heap.len() {
            return;
        }
        if before(heap, child, child + 1, less) {
            child += 1;
        }
        if !before(heap, root, child, less) {
            return;
        }
        swap(heap, root, child);
        root = child;
    }
}

/// Both items exist and the first comes before the second.
#[inline]
fn before<T>(items: &[T], i: usize, j: usize, less: &impl Fn(&T, &T) -> bool) -> bool {
    matches!((items.get(i), items.get(j)), (Some(a), Some(b)) if less(a, b))
}

/// Exchanges two items that exist.
#[inline]
fn swap<T>(items: &mut [T], i: usize, j: usize) {
    if i < items.len() && j < items.len() {
        items.swap(i, j);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lists of many lengths and shapes: random, constant, ascending, descending, sawtooth.
    fn lists() -> impl Iterator<Item = Vec<(u32, usize)>> {
        let mut state = 1_u32;
        let mut random = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state >> 16
        };
        (0..200_usize).map(move |n| {
            (0..n)
                .map(|i| {
                    let k = u32::try_from(i).unwrap_or(0);
                    let v = match n % 5 {
                        0 => random(),
                        1 => 7,
                        2 => k,
                        3 => 1000 - k,
                        _ => k % 5,
                    };
                    (v, i)
                })
                .collect()
        })
    }

    #[test]
    fn sorts_as_the_standard_library_does() {
        for list in lists() {
            let (mut ours, mut theirs) = (list.clone(), list);
            sort(&mut ours, |a, b| a < b);
            theirs.sort_unstable();
            assert_eq!(ours, theirs);
        }
    }

    #[test]
    fn selects_every_rank() {
        for list in lists().step_by(7) {
            let mut sorted = list.clone();
            sorted.sort_unstable();
            for rank in 0..list.len() {
                let mut ours = list.clone();
                select(&mut ours, rank, |a, b| a < b);
                assert_eq!(ours.get(rank), sorted.get(rank));
                let mut low = ours.get(..rank).unwrap_or_default().to_vec();
                low.sort_unstable();
                assert_eq!(Some(low.as_slice()), sorted.get(..rank));
            }
        }
    }

    #[test]
    fn a_list_that_defeats_the_median_of_three_is_still_selected_in_little_work() {
        // Organ pipes: medians of three are extreme again and again.
        let n = 4096_u32;
        let list: Vec<u32> = (0..n / 2).chain((0..n / 2).rev()).collect();
        let compared = core::cell::Cell::new(0_u64);
        let mut ours = list;
        select(&mut ours, 2048, |a, b| {
            compared.set(compared.get() + 1);
            a < b
        });
        assert!(compared.get() < 64 * 13 * u64::from(n), "{} comparisons", compared.get());
    }
}
