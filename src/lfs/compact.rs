//! Medial polylines in a tenth of the memory, and lfs from them: for programs on a chip.
//!
//! The sampler asks the medial axis for one thing, its distance from a point. Of a [`MedialPoint`] (36 bytes in f32) that
//! needs the centre alone, and the centre only to a small share of its radius, because |p − m| ≥ r for every p ∈ C: an error
//! of τ·r in m is a relative error of lfs of at most τ. So consecutive vertices of one polyline share a [`Block`]: a box,
//! and three bytes a vertex, 12 bits a coordinate, between the box's sides. A block ends with its polyline, with
//! [`VERTICES`] vertices, or where its box becomes larger than [`SPREAD`] times the smallest radius inside; so a coordinate
//! is off by at most SPREAD/8190 of that radius, a vertex by √2 times as much: 0.55 %. Below a *floor* of radii that the caller names
//! (d_min/ε: where the sampler's floor wins anyway) blocks are not cut further, and the error is that share of the floor.
//! An edge that is off by τ·r at both ends is off by no more between them.
//!
//! The index over the blocks is a binary tree of boxes over consecutive blocks whose shape follows from their number: the
//! left half of `count` blocks has `count / 2`. In preorder the left child of node i is i + 1 and the right one i + count/2,
//! so nothing but the boxes is stored.
//!
//! Memory in f32: 164 bytes a block and 16 a box, one less than blocks: 3.75 bytes a vertex where blocks are full. A look-up
//! visits each node at most once.

use super::{FeatureSize, below_bound};
use crate::buffer::{BufferFull, Keep, Sink, SliceStore, Store};
use crate::curve::CurveParam;
use crate::geometry::{Aabb, Point, Vector, project_to_segment};
use crate::medial::MedialPoint;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Vertices that a block can hold.
pub const VERTICES: usize = 48;

/// A block's box is at most this many times as large as its smallest radius.
pub const SPREAD: i32 = 32;

/// Parts of a block's side.
const PARTS: i32 = 4095;

/// Levels of the tree over u32::MAX blocks, and a few more.
const DEPTH: usize = 40;

/// Consecutive vertices of one medial polyline.
#[derive(Clone, Copy, Debug)]
pub struct Block<S> {
    /// Lower corner of the box.
    low: Point<S>,
    /// Size of a part of each side.
    part: Vector<S>,
    count: u8,
    /// An edge leads to the first vertex of the next block.
    joined: bool,
    /// Parts from the lower corner: eight bits of x, four of each, eight of y.
    vertices: [[u8; 3]; VERTICES],
}

impl<S: Default> Default for Block<S> {
    fn default() -> Self {
        Self { low: Point::default(), part: Vector::default(), count: 0, joined: false, vertices: [[0; 3]; VERTICES] }
    }
}

impl<S: Scalar> Block<S> {
    fn vertex(&self, k: usize) -> Point<S> {
        let [a, b, c] = self.vertices.get(k).copied().unwrap_or_default();
        let x = i32::from(a) << 4 | i32::from(b) >> 4;
        let y = (i32::from(b) & 15) << 8 | i32::from(c);
        Point::new(S::int(x) * &self.part.x + &self.low.x, S::int(y) * &self.part.y + &self.low.y)
    }

    /// Holds every vertex as it is decoded.
    fn bounds(&self) -> Aabb<S> {
        let parts = S::int(PARTS);
        let high = Point::new(parts.clone() * &self.part.x + &self.low.x, parts * &self.part.y + &self.low.y);
        Aabb { min: self.low.clone(), max: high }
    }
}

/// Parts of `size` in `v`, to the nearest, in [0, [`PARTS`]].
fn parts<S: Scalar>(v: S, size: &S) -> [u8; 2] {
    if size.is_zero() {
        return [0, 0];
    }
    let n = (v / size + &S::one().half()).to_i64().clamp(0, i64::from(PARTS));
    let [low, high, ..] = n.to_le_bytes();
    [high, low]
}

/// Takes medial points as the walk finds them, and keeps blocks.
#[derive(Debug)]
pub struct Blocks<'a, S> {
    blocks: SliceStore<'a, Block<S>>,
    floor: S,
    /// Vertices of the block in hand, its box and smallest radius.
    pending: ArrayVec<Point<S>, VERTICES>,
    bounds: Aabb<S>,
    least: S,
    polyline: u32,
    taken: u32,
}

impl<'a, S: Scalar> Blocks<'a, S> {
    /// An empty list in these slots. Radii below `floor` need not be kept better than it.
    pub fn new(slots: &'a mut [Block<S>], floor: S) -> Self {
        Self {
            blocks: SliceStore::new(slots),
            floor,
            pending: ArrayVec::new(),
            bounds: Aabb::empty(),
            least: S::infinity(),
            polyline: 0,
            taken: 0,
        }
    }

    /// Medial points so far.
    pub const fn taken(&self) -> u32 {
        self.taken
    }

    /// The blocks.
    ///
    /// # Errors
    /// [`BufferFull`] where there is no room for the last one.
    pub fn finish(mut self) -> Result<&'a mut [Block<S>], BufferFull> {
        self.close(false)?;
        Ok(self.blocks.into_items())
    }

    /// Ends the block in hand.
    fn close(&mut self, joined: bool) -> Result<(), BufferFull> {
        if self.pending.is_empty() {
            return Ok(());
        }
        let Vector { x, y } = self.bounds.extent();
        let sides = S::int(PARTS);
        let part = Vector::new(x / &sides, y / &sides);
        let low = self.bounds.min.clone();
        let mut block = Block { low, part, count: 0, joined, vertices: [[0; 3]; VERTICES] };
        for (slot, p) in block.vertices.iter_mut().zip(self.pending.iter()) {
            let [high_x, low_x] = parts(p.x.clone() - &block.low.x, &block.part.x);
            let [high_y, low_y] = parts(p.y.clone() - &block.low.y, &block.part.y);
            *slot = [high_x << 4 | low_x >> 4, low_x << 4 | high_y, low_y];
            block.count += 1;
        }
        self.pending.clear();
        self.bounds = Aabb::empty();
        self.least = S::infinity();
        self.blocks.push(block)
    }
}

impl<S: Scalar> Sink<MedialPoint<S>> for Blocks<'_, S> {
    fn take(&mut self, m: MedialPoint<S>) -> Result<(), BufferFull> {
        let joined = m.polyline == self.polyline;
        let mut bounds = self.bounds.clone();
        bounds.include(&m.centre);
        let own = m.radius.max(self.floor.clone());
        let mut least = self.least.clone().min(own.clone());
        let extent = bounds.extent();
        if !joined || self.pending.is_full() || extent.x.max(extent.y) > least.clone() * &S::int(SPREAD) {
            self.close(joined)?;
            bounds = Aabb::around([&m.centre]);
            least = own;
        }
        self.bounds = bounds;
        self.least = least;
        self.polyline = m.polyline;
        self.taken += 1;
        self.pending.keep(m.centre);
        Ok(())
    }
}

/// Boxes that the tree over blocks needs.
pub const fn boxes_for(blocks: usize) -> usize {
    blocks.saturating_sub(1)
}

/// Blocks with the tree over them, borrowed.
#[derive(Clone, Copy, Debug)]
pub struct CompactIndex<'a, S> {
    blocks: &'a [Block<S>],
    boxes: &'a [Aabb<S>],
}

/// A node of the tree: its index among the boxes and the blocks below it.
#[derive(Clone, Copy, Debug)]
struct Branch {
    node: usize,
    from: usize,
    count: usize,
}

impl Branch {
    const fn halves(self) -> [Self; 2] {
        let Self { node, from, count } = self;
        let left = count / 2;
        [Self { node: node + 1, from, count: left }, Self { node: node + left, from: from + left, count: count - left }]
    }
}

impl<'a, S: Scalar> CompactIndex<'a, S> {
    /// Builds the tree into `boxes` ([`boxes_for`]).
    ///
    /// # Errors
    /// [`BufferFull`] where there are too few boxes.
    pub fn build(blocks: &'a [Block<S>], boxes: &'a mut [Aabb<S>]) -> Result<Self, BufferFull> {
        let capacity = boxes.len();
        let boxes = boxes.get_mut(..boxes_for(blocks.len())).ok_or(BufferFull { capacity })?;
        boxes.fill(Aabb::empty());
        let mut index = Self { blocks, boxes: &[] };
        for k in 0..blocks.len() {
            let bounds = index.leaf(k);
            let mut at = index.root();
            while at.count > 1 {
                if let Some(all) = boxes.get_mut(at.node) {
                    all.merge(&bounds);
                }
                let [left, right] = at.halves();
                at = if k < right.from { left } else { right };
            }
        }
        index.boxes = boxes;
        Ok(index)
    }

    const fn root(&self) -> Branch {
        Branch { node: 0, from: 0, count: self.blocks.len() }
    }

    /// The box of a block and of the edge that leads on from it.
    fn leaf(&self, k: usize) -> Aabb<S> {
        let Some(block) = self.blocks.get(k) else { return Aabb::empty() };
        let mut bounds = block.bounds();
        if let Some(next) = self.blocks.get(k + 1).filter(|_| block.joined) {
            bounds.include(&next.vertex(0));
        }
        bounds
    }

    fn distance_sq(&self, at: Branch, p: &Point<S>) -> S {
        if at.count <= 1 {
            return self.leaf(at.from).distance_sq(p);
        }
        self.boxes.get(at.node).map_or_else(S::infinity, |b| b.distance_sq(p))
    }

    /// Squared distance from p to the polylines, if it is below `limit_sq`.
    pub fn nearest_sq(&self, p: &Point<S>, limit_sq: S) -> Option<S> {
        let mut bound = limit_sq;
        let mut found = false;
        let mut stack: ArrayVec<(Branch, S), DEPTH> = ArrayVec::new();
        if !self.blocks.is_empty() {
            stack.keep((self.root(), self.distance_sq(self.root(), p)));
        }
        while let Some((mut at, distance_sq)) = stack.pop() {
            if distance_sq >= bound {
                continue;
            }
            // Down to a block along the nearer halves, remembering the others.
            let mut inside = true;
            while at.count > 1 && inside {
                let [left, right] = at.halves();
                let (l, r) = (self.distance_sq(left, p), self.distance_sq(right, p));
                let (near, near_sq, far, far_sq) = if r < l { (right, r, left, l) } else { (left, l, right, r) };
                if far_sq < bound {
                    stack.keep((far, far_sq));
                }
                inside = near_sq < bound;
                at = near;
            }
            if inside {
                let d = self.in_block(at.from, p);
                if d < bound {
                    bound = d;
                    found = true;
                }
            }
        }
        found.then_some(bound)
    }

    /// Squared distance to the edges that start in a block.
    fn in_block(&self, k: usize, p: &Point<S>) -> S {
        let Some(block) = self.blocks.get(k) else { return S::infinity() };
        let after = self.blocks.get(k + 1).filter(|_| block.joined).map(|next| next.vertex(0));
        let mut a = block.vertex(0);
        let mut least = a.distance_sq(p);
        for n in 1..=usize::from(block.count) {
            let b = if n < usize::from(block.count) { Some(block.vertex(n)) } else { after.clone() };
            let Some(b) = b else { break };
            least = least.min(project_to_segment(p, &a, &b).1.distance_sq(p));
            a = b;
        }
        least
    }

    /// Distance from p to the polylines; infinite if there are none.
    pub fn distance(&self, p: &Point<S>) -> S {
        self.nearest_sq(p, S::infinity()).map_or_else(S::infinity, S::sqrt)
    }
}

impl<S: Scalar> FeatureSize<S> for CompactIndex<'_, S> {
    #[inline]
    fn lfs(&self, _at: &CurveParam<S>, p: &Point<S>) -> S {
        self.distance(p)
    }

    #[inline]
    fn lfs_below(&self, _at: &CurveParam<S>, p: &Point<S>, bound: &S) -> S {
        below_bound(bound, |limit| self.nearest_sq(p, limit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::medial::Side;

    /// Spirals and zigzags at several scales, as polylines of their own.
    fn points() -> Vec<MedialPoint<f64>> {
        let mut all = Vec::new();
        for (line, scale) in (0_u32..).zip([1.0, 0.05, 40.0]) {
            for k in 0..150_u32 {
                let a = f64::from(k) * 0.07;
                let centre = Point::new(scale * a * a.cos() + 3.0 * scale, scale * a * a.sin());
                let at = CurveParam { segment: 0, t: 0.0 };
                let foot = centre;
                all.push(MedialPoint { at, foot, side: Side::Left, centre, radius: scale * 0.3, polyline: line });
            }
        }
        all
    }

    fn reference(points: &[MedialPoint<f64>], p: &Point<f64>) -> f64 {
        points
            .windows(2)
            .filter(|w| w[0].polyline == w[1].polyline)
            .fold(f64::INFINITY, |least, w| least.min(project_to_segment(p, &w[0].centre, &w[1].centre).1.distance(p)))
    }

    #[test]
    fn distances_are_those_of_the_polylines_within_a_share_of_the_radius() {
        let points = points();
        let (mut slots, mut boxes) = ([Block::default(); 64], [Aabb::default(); 64]);
        let mut blocks = Blocks::new(&mut slots, 0.0);
        for m in &points {
            blocks.take(*m).unwrap();
        }
        assert_eq!(blocks.taken(), 450);
        let blocks = blocks.finish().unwrap();
        assert!(blocks.len() < 40, "{} blocks", blocks.len());
        let index = CompactIndex::build(blocks, &mut boxes).unwrap();
        for k in 0..4000_u32 {
            let (r, a) = (f64::from(k % 67), f64::from(k) * 0.37);
            let p = Point::new(r * a.cos(), r * a.sin());
            let (own, truth) = (index.distance(&p), reference(&points, &p));
            // Never worse than 0.55 % of the largest radius of a polyline, here 12; the small ones are much better.
            assert!((own - truth).abs() <= 0.0056 * 12.0, "{own} for {truth}");
        }
        // Beside the smallest polyline its own radius counts.
        let p = Point::new(0.15, 0.01);
        assert!(
            (index.distance(&p) - reference(&points, &p)).abs() <= 0.0056 * 0.015,
            "the scale of the nearest counts"
        );
    }

    #[test]
    fn the_tree_finds_what_a_search_of_all_blocks_finds() {
        let points = points();
        for count in 1..points.len() {
            if count % 29 != 0 && count > 40 {
                continue;
            }
            let (mut slots, mut boxes) = ([Block::default(); 64], [Aabb::default(); 64]);
            let mut blocks = Blocks::new(&mut slots, 0.0);
            for m in points.iter().take(count) {
                blocks.take(*m).unwrap();
            }
            let blocks = blocks.finish().unwrap();
            let index = CompactIndex::build(blocks, &mut boxes).unwrap();
            for k in 0..60_u32 {
                let p = Point::new(f64::from(k), f64::from(k * k % 37));
                let all = (0..index.blocks.len()).fold(f64::INFINITY, |d, b| d.min(index.in_block(b, &p)));
                assert_eq!(index.nearest_sq(&p, f64::INFINITY), Some(all));
                assert_eq!(index.nearest_sq(&p, all), None);
            }
        }
    }

    #[test]
    fn full_slots_say_so() {
        let points = points();
        let mut slots = [Block::default(); 2];
        let mut blocks = Blocks::new(&mut slots, 0.0);
        let refused = points.iter().find_map(|m| blocks.take(*m).err());
        assert_eq!(refused, Some(BufferFull { capacity: 2 }));
        let (mut slots, mut none) = ([Block::default(); 8], []);
        let mut blocks = Blocks::new(&mut slots, 0.0);
        points.iter().take(80).for_each(|m| blocks.take(*m).unwrap());
        assert!(CompactIndex::build(blocks.finish().unwrap(), &mut none).is_err());
    }

    #[test]
    fn nothing_is_infinitely_far() {
        let index = CompactIndex::<f64>::build(&[], &mut []).unwrap();
        assert_eq!(index.distance(&Point::new(1.0, 2.0)), f64::INFINITY);
    }
}
