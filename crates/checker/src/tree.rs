//! A box tree over segments of the plane: nearest segments to a point.
//!
//! Serves the medial stretches and the samples alike (a point is a segment of length zero). Built once by halving at
//! the median, so that its depth does not depend on the drawing.

use crate::plane::{V2, v2};

struct Node {
    low: V2,
    high: V2,
    /// Range of items below, or the two children.
    range: (usize, usize),
    children: Option<(usize, usize)>,
}

/// The tree.
pub(crate) struct Tree {
    nodes: Vec<Node>,
    items: Vec<(usize, V2, V2)>,
}

impl Node {
    fn distance(&self, p: V2) -> f64 {
        let dx = (self.low.x - p.x).max(p.x - self.high.x).max(0.0);
        let dy = (self.low.y - p.y).max(p.y - self.high.y).max(0.0);
        dx.hypot(dy)
    }
}

impl Tree {
    /// A tree over segments, numbered in their order.
    pub(crate) fn new(segments: impl Iterator<Item = (V2, V2)>) -> Tree {
        let items: Vec<_> = segments.enumerate().map(|(i, (a, b))| (i, a, b)).collect();
        let mut tree = Tree { nodes: Vec::new(), items };
        if !tree.items.is_empty() {
            tree.build(0, tree.items.len());
        }
        tree
    }

    fn build(&mut self, from: usize, to: usize) -> usize {
        let (mut low, mut high) = (v2(f64::MAX, f64::MAX), v2(f64::MIN, f64::MIN));
        for &(_, a, b) in &self.items[from..to] {
            low = v2(low.x.min(a.x).min(b.x), low.y.min(a.y).min(b.y));
            high = v2(high.x.max(a.x).max(b.x), high.y.max(a.y).max(b.y));
        }
        let me = self.nodes.len();
        self.nodes.push(Node { low, high, range: (from, to), children: None });
        if to - from > 6 {
            let wide = high.x - low.x > high.y - low.y;
            let key = |item: &(usize, V2, V2)| if wide { item.1.x + item.2.x } else { item.1.y + item.2.y };
            let middle = usize::midpoint(from, to);
            self.items[from..to].select_nth_unstable_by(middle - from, |a, b| key(a).total_cmp(&key(b)));
            let left = self.build(from, middle);
            let right = self.build(middle, to);
            self.nodes[me].children = Some((left, right));
        }
        me
    }

    /// Number and distance of the nearest segment that is nearer than `limit`.
    pub(crate) fn nearest(&self, p: V2, limit: f64) -> Option<(usize, f64)> {
        let mut best = (None, limit);
        let mut stack: Vec<(usize, f64)> = self.nodes.first().map(|n| (0, n.distance(p))).into_iter().collect();
        while let Some((node, distance)) = stack.pop() {
            if distance >= best.1 {
                continue;
            }
            match self.nodes[node].children {
                Some((a, b)) => {
                    let (da, db) = (self.nodes[a].distance(p), self.nodes[b].distance(p));
                    let order = if da < db { [(b, db), (a, da)] } else { [(a, da), (b, db)] };
                    stack.extend(order);
                }
                None => {
                    for &(i, a, b) in &self.items[self.nodes[node].range.0..self.nodes[node].range.1] {
                        let d = p.distance_to_segment(a, b).0;
                        if d < best.1 {
                            best = (Some(i), d);
                        }
                    }
                }
            }
        }
        best.0.map(|i| (i, best.1))
    }

    /// All segments within `limit`, with their distances.
    pub(crate) fn within(&self, p: V2, limit: f64) -> Vec<(usize, f64)> {
        let mut out = Vec::new();
        let mut stack: Vec<usize> = (0..self.nodes.len().min(1)).collect();
        while let Some(node) = stack.pop() {
            if self.nodes[node].distance(p) > limit {
                continue;
            }
            match self.nodes[node].children {
                Some((a, b)) => stack.extend([a, b]),
                None => {
                    for &(i, a, b) in &self.items[self.nodes[node].range.0..self.nodes[node].range.1] {
                        let d = p.distance_to_segment(a, b).0;
                        if d <= limit {
                            out.push((i, d));
                        }
                    }
                }
            }
        }
        out
    }
}
