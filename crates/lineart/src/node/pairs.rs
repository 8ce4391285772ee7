//! Boxes that overlap: all pairs of them, or those that hold a point.
//!
//! One tree over the boxes, asked once for each of them: O(n log n + pairs) for boxes of curve pieces, whatever their
//! sizes. A uniform grid would need a cell size, and drawings have pieces of 1e-6 and of 1 of their diagonal side by side.

use feature_sampling::geometry::hierarchy::{self, Hierarchy, Item};
use feature_sampling::geometry::{Aabb, Point};

/// Boxes that can be searched.
#[derive(Debug)]
pub(crate) struct Boxes {
    nodes: Vec<hierarchy::Node<f64>>,
    boxes: Vec<Aabb<f64>>,
}

impl Boxes {
    /// Indexes the boxes; their numbers are their places in the list.
    pub(crate) fn new(boxes: Vec<Aabb<f64>>) -> Self {
        let item = |(index, bounds): (u32, &Aabb<f64>)| Item { bounds: *bounds, index };
        let mut items: Vec<_> = (0..).zip(&boxes).map(item).collect();
        let mut nodes = Vec::with_capacity(hierarchy::nodes_for(items.len()));
        // A vector is never full.
        let built = hierarchy::build(&mut items, &mut nodes);
        debug_assert!(built.is_ok(), "a tree of at most 2^32 items");
        Self { nodes, boxes }
    }

    /// Calls `found` with every pair i < j of which `wanted` says i or j should be asked about and whose boxes overlap,
    /// in an order that the boxes alone decide.
    pub(crate) fn overlapping(&self, wanted: impl Fn(u32) -> bool, mut found: impl FnMut(u32, u32)) {
        let tree = Hierarchy::new(&self.nodes);
        for (i, bounds) in (0..).zip(&self.boxes) {
            if !wanted(i) {
                continue;
            }
            let centre = bounds.centre();
            tree.traverse(
                &centre,
                &mut (),
                |(), other| overlap(bounds, other),
                // Where both are wanted the pair is met twice and told once.
                |(), j, _| match j {
                    j if j == i || (j < i && wanted(j)) => {}
                    j => found(i.min(j), i.max(j)),
                },
            );
        }
    }

    /// Calls `found` with every box that holds a point, its sides included, in an order that the boxes alone decide.
    pub(crate) fn around(&self, p: &Point<f64>, mut found: impl FnMut(u32)) {
        let here = Aabb { min: *p, max: *p };
        Hierarchy::new(&self.nodes).traverse(p, &mut (), |(), bounds| overlap(&here, bounds), |(), i, _| found(i));
    }
}

fn overlap(a: &Aabb<f64>, b: &Aabb<f64>) -> bool {
    a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y
}
