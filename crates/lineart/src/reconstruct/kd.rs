//! Nearest points in order of distance: an implicit kd-tree.
//!
//! The points are permuted so that the middle of each range splits it by x or y, in turns; no node is stored. Two questions
//! are asked of it: the k nearest points of one place, ties by number, and whether a disk holds a point.

use feature_sampling::geometry::Point;

/// Below this many points a range is searched through.
const LEAF: usize = 8;

/// Points in an implicit kd-tree.
pub(crate) struct Kd {
    items: Vec<(Point<f64>, u32)>,
}

impl Kd {
    /// O(n log n).
    pub(crate) fn new(points: &[Point<f64>]) -> Self {
        let mut items: Vec<(Point<f64>, u32)> = points.iter().copied().zip(0_u32..).collect();
        let mut ranges = vec![(0, items.len(), false)];
        while let Some((from, to, by_y)) = ranges.pop() {
            if to - from <= LEAF {
                continue;
            }
            let middle = (to - from) / 2;
            items[from..to].select_nth_unstable_by(middle, |a, b| key(&a.0, by_y).total_cmp(&key(&b.0, by_y)));
            ranges.push((from, from + middle, !by_y));
            ranges.push((from + middle + 1, to, !by_y));
        }
        Self { items }
    }

    /// The k points nearest to `place`, nearest first, ties by number, into `found` as (squared distance, number).
    pub(crate) fn nearest(&self, place: &Point<f64>, k: usize, found: &mut Vec<(f64, u32)>) {
        found.clear();
        if k > 0 {
            self.visit(0, self.items.len(), false, place, k, found);
        }
    }

    fn visit(&self, from: usize, to: usize, by_y: bool, place: &Point<f64>, k: usize, found: &mut Vec<(f64, u32)>) {
        if to - from <= LEAF {
            for item in &self.items[from..to] {
                offer(item, place, k, found);
            }
            return;
        }
        let middle = from + (to - from) / 2;
        let item = &self.items[middle];
        let beyond = key(place, by_y) - key(&item.0, by_y);
        let halves = [(from, middle), (middle + 1, to)];
        let [near, far] = if beyond < 0.0 { halves } else { [halves[1], halves[0]] };
        self.visit(near.0, near.1, !by_y, place, k, found);
        offer(item, place, k, found);
        // Equal distances matter: the tie goes to the lower number.
        if found.len() < k || found.last().is_none_or(|last| beyond * beyond <= last.0) {
            self.visit(far.0, far.1, !by_y, place, k, found);
        }
    }

    /// Some point lies at less than √`radius_sq` from `place`.
    pub(crate) fn any_within(&self, place: &Point<f64>, radius_sq: f64) -> bool {
        self.find(place, radius_sq.sqrt(), |p| p.distance_sq(place) < radius_sq).is_some()
    }

    /// A point that fulfils a condition which only holds within a disk, up to a relative 1e−9 of its radius.
    pub(crate) fn find(
        &self,
        place: &Point<f64>,
        radius: f64,
        condition: impl Fn(&Point<f64>) -> bool,
    ) -> Option<Point<f64>> {
        let reach = radius * (1.0 + 1e-9);
        let mut ranges = vec![(0, self.items.len(), false)];
        while let Some((from, to, by_y)) = ranges.pop() {
            if to - from <= LEAF {
                if let Some(item) = self.items[from..to].iter().find(|item| condition(&item.0)) {
                    return Some(item.0);
                }
                continue;
            }
            let middle = from + (to - from) / 2;
            let item = &self.items[middle];
            if condition(&item.0) {
                return Some(item.0);
            }
            let beyond = key(place, by_y) - key(&item.0, by_y);
            let [near, far] =
                if beyond < 0.0 { [(from, middle), (middle + 1, to)] } else { [(middle + 1, to), (from, middle)] };
            if beyond.abs() <= reach {
                ranges.push((far.0, far.1, !by_y));
            }
            ranges.push((near.0, near.1, !by_y));
        }
        None
    }
}

fn key(p: &Point<f64>, by_y: bool) -> f64 {
    if by_y { p.y } else { p.x }
}

/// Keeps the k best, sorted.
fn offer(item: &(Point<f64>, u32), place: &Point<f64>, k: usize, found: &mut Vec<(f64, u32)>) {
    let entry = (item.0.distance_sq(place), item.1);
    let before = |a: &(f64, u32)| a.0.total_cmp(&entry.0).then(a.1.cmp(&entry.1)).is_lt();
    if found.len() == k && found.last().is_some_and(before) {
        return;
    }
    let at = found.partition_point(before);
    if found.len() == k {
        found.pop();
    }
    found.insert(at, entry);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_a_search_through_all() {
        // A grid with repeated distances, and a cluster.
        let mut points: Vec<_> = (0..200_u32).map(|i| Point::new(f64::from(i % 14), f64::from(i / 14))).collect();
        points.extend((0..50_u32).map(|i| Point::new(3.0 + f64::from(i) * 1e-9, 4.0)));
        let kd = Kd::new(&points);
        let mut found = Vec::new();
        for place in &points {
            let mut all: Vec<_> = points.iter().zip(0_u32..).map(|(p, i)| (p.distance_sq(place), i)).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            kd.nearest(place, 15, &mut found);
            assert_eq!(found, all[..15], "in order, ties by number");
            assert!(!kd.any_within(&Point::new(place.x + 100.0, place.y), 80.0 * 80.0), "none there");
            let (radius, expected) = (all[20].0, all[0].0 < all[20].0);
            assert_eq!(kd.any_within(place, radius), expected, "some there");
        }
        kd.nearest(&points[0], 1000, &mut found);
        assert_eq!(found.len(), points.len(), "no more than there are");
    }
}
