//! Disks that are taken away when a segment meets them.
//!
//! A bounding hierarchy over disks that counts in each node what is left below it: each disk is reported once and empty
//! parts are passed by, so that all reports together cost O(n log n) and a segment that meets nothing new costs little.

use feature_sampling::geometry::Point;

/// Disks of a leaf.
const LEAF: usize = 4;

struct Node {
    low: Point<f64>,
    high: Point<f64>,
    from: usize,
    to: usize,
    left: u32,
    /// The right child; 0 in a leaf.
    right: u32,
    left_over: u32,
}

/// The disks.
pub(crate) struct Disks {
    nodes: Vec<Node>,
    /// Centre, radius and number; a radius below 0 marks a disk that is gone.
    items: Vec<(Point<f64>, f64, u32)>,
}

impl Disks {
    /// Numbers are positions in `disks`.
    pub(crate) fn new(disks: Vec<(Point<f64>, f64)>) -> Self {
        let items = disks.into_iter().zip(0_u32..).map(|((centre, radius), number)| (centre, radius, number)).collect();
        let mut all = Self { nodes: Vec::new(), items };
        if !all.items.is_empty() {
            all.build(0, all.items.len());
        }
        all
    }

    /// The depth is logarithmic: halves are equal.
    fn build(&mut self, from: usize, to: usize) -> u32 {
        let (mut low, mut high) =
            (Point::new(f64::INFINITY, f64::INFINITY), Point::new(-f64::INFINITY, -f64::INFINITY));
        for (c, r, _) in &self.items[from..to] {
            low = Point::new(low.x.min(c.x - r), low.y.min(c.y - r));
            high = Point::new(high.x.max(c.x + r), high.y.max(c.y + r));
        }
        let number = self.nodes.len();
        let left_over = u32::try_from(to - from).unwrap_or(u32::MAX);
        self.nodes.push(Node { low, high, from, to, left: 0, right: 0, left_over });
        if to - from > LEAF {
            let middle = (to - from) / 2;
            let wide = high.x - low.x >= high.y - low.y;
            let key = |item: &(Point<f64>, f64, u32)| if wide { item.0.x } else { item.0.y };
            self.items[from..to].select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
            let children = (self.build(from, from + middle), self.build(from + middle, to));
            (self.nodes[number].left, self.nodes[number].right) = children;
        }
        u32::try_from(number).unwrap_or(u32::MAX)
    }

    /// Takes out the disks that the segment enters (nearer to the centre than the radius) and appends their numbers.
    pub(crate) fn take_meeting(&mut self, a: &Point<f64>, b: &Point<f64>, met: &mut Vec<u32>) {
        if !self.nodes.is_empty() {
            self.take(0, a, b, met);
        }
    }

    fn take(&mut self, node: usize, a: &Point<f64>, b: &Point<f64>, met: &mut Vec<u32>) {
        let Node { low, high, from, to, left, right, left_over } = self.nodes[node];
        if left_over == 0 || !meets_box(a, b, &low, &high) {
            return;
        }
        let before = met.len();
        if right == 0 {
            for (centre, radius, number) in &mut self.items[from..to] {
                if *radius > 0.0 && distance_sq(centre, a, b) < *radius * *radius {
                    *radius = -1.0;
                    met.push(*number);
                }
            }
        } else {
            self.take(left as usize, a, b, met);
            self.take(right as usize, a, b, met);
        }
        self.nodes[node].left_over -= u32::try_from(met.len() - before).unwrap_or(0);
    }
}

/// The segment may meet the box: no axis and not the segment's own normal separates them.
fn meets_box(a: &Point<f64>, b: &Point<f64>, low: &Point<f64>, high: &Point<f64>) -> bool {
    if a.x.max(b.x) < low.x || a.x.min(b.x) > high.x || a.y.max(b.y) < low.y || a.y.min(b.y) > high.y {
        return false;
    }
    let n = Point::new(a.y - b.y, b.x - a.x);
    let (cx, cy) = (0.5 * (low.x + high.x) - a.x, 0.5 * (low.y + high.y) - a.y);
    let reach = 0.5 * ((high.x - low.x) * n.x.abs() + (high.y - low.y) * n.y.abs());
    // A little more than the box: rounding must not hide a disk.
    (n.x * cx + n.y * cy).abs() <= reach + 1e-12 * (n.x.abs() + n.y.abs()) * (cx.abs() + cy.abs())
}

/// Squared distance of a point from a segment.
fn distance_sq(p: &Point<f64>, a: &Point<f64>, b: &Point<f64>) -> f64 {
    let (u, v) = (b.minus(a), p.minus(a));
    let uu = u.norm_sq();
    let t = if uu > 0.0 { ((u.x * v.x + u.y * v.y) / uu).clamp(0.0, 1.0) } else { 0.0 };
    let (dx, dy) = (v.x - t * u.x, v.y - t * u.y);
    dx * dx + dy * dy
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_disk_once_and_none_missed() {
        let number = |i: u32| f64::from((i.wrapping_mul(2_654_435_761)) >> 16) / 65_536.0;
        let list: Vec<_> =
            (0..300).map(|i| (Point::new(number(3 * i), number(3 * i + 1)), 0.03 * number(3 * i + 2))).collect();
        let mut disks = Disks::new(list.clone());
        let mut left = vec![true; list.len()];
        for k in 1000..1200 {
            let (a, b) = (Point::new(number(k), number(2 * k)), Point::new(number(5 * k), number(7 * k)));
            let mut met = Vec::new();
            disks.take_meeting(&a, &b, &mut met);
            met.sort_unstable();
            let expected: Vec<u32> = (0_u32..)
                .zip(&list)
                .filter(|&(i, (c, r))| left[i as usize] && distance_sq(c, &a, &b) < r * r)
                .map(|(i, _)| i)
                .collect();
            assert_eq!(met, expected, "segment {k}");
            met.iter().for_each(|&i| left[i as usize] = false);
        }
        assert!(left.iter().any(|l| *l) && left.iter().any(|l| !*l), "some of both");
    }
}
