//! A bounding hierarchy over boxes: the one index of the kernel.
//!
//! A binary tree of axis-aligned boxes, split at the median of the box centres along the wider side. It serves the curve's
//! arcs (tangent disks, closest points) and the edges of the medial polylines (lfs). Nodes are laid out in preorder: the
//! left child of node i is i + 1, the right child is named in the node. n items make 2n − 1 nodes and at most
//! ⌈log₂ n⌉ + 1 levels, so a traversal needs a stack of [`MAX_DEPTH`] entries whatever the input. Building costs
//! O(n log n) and no memory beside the nodes and the list of items, both lent.

use super::{Aabb, Point};
use crate::buffer::{BufferFull, Keep, Store};
use crate::order::select;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Levels of a tree over u32::MAX items, and the room that a traversal needs.
pub const MAX_DEPTH: usize = 40;

const LEAF: u32 = u32::MAX;

/// One node: a box, and either an item or two children.
#[derive(Clone, Copy, Debug, Default)]
pub struct Node<S> {
    /// Holds everything below this node.
    pub bounds: Aabb<S>,
    /// Item of a leaf, otherwise unused.
    item: u32,
    /// Right child, or [`LEAF`].
    right: u32,
}

/// What a tree is built of: a box and the item's number.
#[derive(Clone, Copy, Debug, Default)]
pub struct Item<S> {
    /// The item's box.
    pub bounds: Aabb<S>,
    /// What [`Hierarchy`] hands to its visitors.
    pub index: u32,
}

/// A borrowed tree.
#[derive(Clone, Copy, Debug)]
pub struct Hierarchy<'a, S> {
    nodes: &'a [Node<S>],
}

/// Nodes that a hierarchy over `items` boxes needs.
pub const fn nodes_for(items: usize) -> usize {
    (2 * items).saturating_sub(1)
}

/// Fills `nodes` with the tree over `items`, which is permuted on the way.
///
/// # Errors
/// [`BufferFull`] if `nodes` cannot hold [`nodes_for`] nodes.
#[inline(never)]
pub fn build<S: Scalar>(items: &mut [Item<S>], nodes: &mut impl Store<Node<S>>) -> Result<(), BufferFull> {
    nodes.shorten(0);
    // Ranges of items still to be placed, with the node whose right child they are.
    let mut pending: ArrayVec<(usize, usize, Option<usize>), MAX_DEPTH> = ArrayVec::new();
    if !items.is_empty() {
        pending.keep((0, items.len(), None));
    }
    while let Some((from, to, parent)) = pending.pop() {
        let here = nodes.items().len();
        if let Some(parent) = parent.and_then(|p| nodes.items_mut().get_mut(p)) {
            parent.right = u32::try_from(here).unwrap_or(LEAF);
        }
        let Some(range) = items.get_mut(from..to) else { continue };
        if let [item] = range {
            nodes.push(Node { bounds: item.bounds.clone(), item: item.index, right: LEAF })?;
            continue;
        }
        let mut all = Aabb::empty();
        let mut centres = Aabb::empty();
        for item in range.iter() {
            centres.include(&item.bounds.centre());
            all.merge(&item.bounds);
        }
        nodes.push(Node { bounds: all, item: 0, right: LEAF })?;
        let extent = centres.extent();
        let half = range.len() / 2;
        // Twice the centre orders as well as the centre. Equal keys are ordered by index, so that the tree is a function
        // of the boxes alone.
        let wide = extent.x >= extent.y;
        let key = |item: &Item<S>| {
            let Aabb { min, max } = &item.bounds;
            if wide { min.x.clone() + &max.x } else { min.y.clone() + &max.y }
        };
        select(range, half, |a, b| {
            let (i, j) = (key(a), key(b));
            i < j || (i == j && a.index < b.index)
        });
        let middle = from + half;
        // The left part is placed next (preorder), the right part after all of it.
        if pending.try_push((middle, to, Some(here))).is_err() || pending.try_push((from, middle, None)).is_err() {
            return Err(BufferFull { capacity: MAX_DEPTH });
        }
    }
    Ok(())
}

/// What is below a node.
pub(crate) enum Below {
    /// An item.
    Item(u32),
    /// The indices of two nodes, both larger than its own.
    Nodes([u32; 2]),
}

impl<S> Node<S> {
    /// What is below this node, whose index is `i`.
    pub(crate) const fn below(&self, i: u32) -> Below {
        if self.right == LEAF { Below::Item(self.item) } else { Below::Nodes([i + 1, self.right]) }
    }
}

impl<'a, S: Scalar> Hierarchy<'a, S> {
    /// The tree in these nodes, as [`build`] wrote them.
    pub const fn new(nodes: &'a [Node<S>]) -> Self {
        Self { nodes }
    }

    /// Visits every item whose box passes `enter`; of two children the one nearer to `towards` first.
    ///
    /// `enter` sees the box of a node and says whether anything below may matter; `visit` sees an item and its box. Both
    /// share `state`, so that what a visit finds narrows what is entered later: the sooner the nearer.
    #[inline]
    pub fn traverse<T>(
        &self,
        towards: &Point<S>,
        state: &mut T,
        enter: impl Fn(&T, &Aabb<S>) -> bool,
        mut visit: impl FnMut(&mut T, u32, &Aabb<S>),
    ) {
        let mut stack: ArrayVec<u32, MAX_DEPTH> = ArrayVec::new();
        let mut next = if self.nodes.is_empty() { None } else { Some(0_u32) };
        while let Some(i) = next {
            let Some(node) = self.nodes.get(i as usize) else { break };
            if enter(state, &node.bounds) {
                if node.right == LEAF {
                    visit(state, node.item, &node.bounds);
                } else {
                    let (left, right) = (i + 1, node.right);
                    let distance = |k: u32| self.nodes.get(k as usize).map(|n| n.bounds.distance_sq(towards));
                    let (near, far) = if distance(right) < distance(left) { (right, left) } else { (left, right) };
                    if stack.try_push(far).is_ok() {
                        next = Some(near);
                        continue;
                    }
                }
            }
            next = stack.pop();
        }
    }

    /// Visits items by nearness to a point, as far as `bound_sq` (a squared distance that the visits may lower) reaches.
    ///
    /// The nearer child is entered first; a node is left out when its box is not nearer than the bound.
    #[inline]
    pub fn nearest_first<T>(
        &self,
        p: &Point<S>,
        state: &mut T,
        bound_sq: impl Fn(&T) -> S,
        mut visit: impl FnMut(&mut T, u32),
    ) {
        let mut stack: ArrayVec<(u32, S), MAX_DEPTH> = ArrayVec::new();
        if let Some(root) = self.nodes.first() {
            stack.keep((0, root.bounds.distance_sq(p)));
        }
        while let Some((mut i, distance_sq)) = stack.pop() {
            if distance_sq >= bound_sq(state) {
                continue;
            }
            // Down to a leaf along the nearer children, remembering the others.
            while let Some(node) = self.nodes.get(i as usize) {
                if node.right == LEAF {
                    visit(state, node.item);
                    break;
                }
                let left = i + 1;
                let (Some(l), Some(r)) = (self.nodes.get(left as usize), self.nodes.get(node.right as usize)) else {
                    break;
                };
                let (dl, dr) = (l.bounds.distance_sq(p), r.bounds.distance_sq(p));
                let (near, near_sq, far, far_sq) =
                    if dr < dl { (node.right, dr, left, dl) } else { (left, dl, node.right, dr) };
                let bound = bound_sq(state);
                if far_sq < bound && stack.try_push((far, far_sq)).is_err() {
                    break;
                }
                if near_sq >= bound {
                    break;
                }
                i = near;
            }
        }
    }

    /// The box of everything; empty without items.
    pub fn bounds(&self) -> Aabb<S> {
        self.nodes.first().map_or_else(Aabb::empty, |n| n.bounds.clone())
    }
}
