//! What is to be refined next: buckets by how bad it is.
//!
//! A heap would cost more than the insertions it orders. The order only matters roughly (large before small, flat before
//! fair), so a number goes into a bucket by its exponent and its first two binary digits, four buckets to the octave, and
//! buckets are emptied from the worst, last in first out. Nothing is removed: whoever takes an entry sees by its stamp
//! whether the triangle is still the one that was meant.

/// Something at a place in an array, as it was at a stamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) item: u32,
    pub(super) stamp: u32,
}

/// How many buckets; what is worse than the last is in the last.
const BUCKETS: usize = 256;

/// Entries by how bad they are, a number from 1 upwards.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    buckets: Vec<Vec<Entry>>,
    /// No bucket above it has an entry.
    top: usize,
}

impl Queue {
    pub(super) fn new() -> Self {
        Self { buckets: vec![Vec::new(); BUCKETS], top: 0 }
    }

    #[expect(clippy::cast_possible_truncation, reason = "cut to the number of buckets")]
    pub(super) fn push(&mut self, badness: f64, entry: Entry) {
        // The bits of positive doubles are ordered as the doubles are.
        let steps = (badness.max(1.0).to_bits() >> 50) - (1.0_f64.to_bits() >> 50);
        let bucket = steps.min(BUCKETS as u64 - 1) as usize;
        self.buckets[bucket].push(entry);
        self.top = self.top.max(bucket);
    }

    pub(super) fn pop(&mut self) -> Option<Entry> {
        loop {
            if let Some(entry) = self.buckets[self.top].pop() {
                return Some(entry);
            }
            if self.top == 0 {
                return None;
            }
            self.top -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_first() {
        let mut queue = Queue::new();
        for (item, badness) in [(0, 1.1), (1, 1e300), (2, 7.0), (3, 1.0), (4, 40.0), (5, f64::INFINITY)] {
            queue.push(badness, Entry { item, stamp: 0 });
        }
        let order: Vec<u32> = std::iter::from_fn(|| queue.pop()).map(|entry| entry.item).collect();
        assert_eq!(order, [5, 1, 4, 2, 3, 0], "by octaves, the last first within a bucket");
    }
}
