//! Local feature size: the distance to the medial axis (paper, section 3.2).
//!
//! lfs(p) = dist(p, M) for p ∈ C. The medial polylines M' stand for M, and [`LfsIndex`] finds the nearest *edge* of all of
//! them: lfs is global, the nearest medial point may belong to any path. (The paper takes the nearest vertex and its two
//! edges, which need not hold the nearest point; `lfs::kd` offers that for comparison, behind the feature `kiddo`.)
//!
//! The estimate is exact for M': |lfs'(p) − lfs(p)| is at most the Hausdorff distance of M' and M near p. Like lfs itself
//! it is 1-Lipschitz. M' may be empty (a lone straight segment): lfs is then infinite.

pub mod bound;
pub mod enclose;
pub mod gather;
#[cfg(feature = "kiddo")]
pub mod kd;
pub mod table;

use crate::buffer::{BufferFull, Store};
use crate::curve::CurveParam;
use crate::geometry::hierarchy::{self, Hierarchy, Item, Node};
use crate::geometry::{Aabb, Point, project_to_segment};
use crate::medial::MedialPoint;
use crate::scalar::Scalar;

/// Where the sampler gets lfs from: an index over medial polylines, or values that were computed elsewhere.
pub trait FeatureSize<S> {
    /// lfs at the point p of C, which lies at `at`; infinity where M is empty.
    fn lfs(&self, at: &CurveParam<S>, p: &Point<S>) -> S;

    /// The same, where a value is known that lfs does not exceed (lfs is 1-Lipschitz: a neighbour's plus the distance). It
    /// may make the look-up faster and does not change its result.
    fn lfs_below(&self, at: &CurveParam<S>, p: &Point<S>, bound: &S) -> S {
        let _ = bound;
        self.lfs(at, p)
    }
}

/// Consecutive edges that share a leaf of the index.
const CHUNK: usize = 8;

/// The medial polylines with a hierarchy over chunks of their edges, borrowed.
#[derive(Clone, Copy, Debug)]
pub struct LfsIndex<'a, S> {
    points: &'a [MedialPoint<S>],
    nodes: &'a [Node<S>],
}

/// The nearest point of the medial polylines.
#[derive(Clone, Debug, PartialEq)]
pub struct NearestMedial<S> {
    /// Squared distance.
    pub distance_sq: S,
    /// The point of M'.
    pub point: Point<S>,
    /// The vertex that starts the edge it lies on.
    pub vertex: u32,
}

/// Entries that the scratch list of [`build`] needs; [`hierarchy::nodes_for`] of it are the nodes.
pub const fn items_for(medial_points: usize) -> usize {
    medial_points.div_ceil(CHUNK)
}

/// Builds the hierarchy over medial polylines into `nodes`; `items` is scratch.
///
/// # Errors
/// [`BufferFull`] where a store cannot take its entries ([`items_for`]).
pub fn build<S: Scalar>(
    points: &[MedialPoint<S>],
    items: &mut impl Store<Item<S>>,
    nodes: &mut impl Store<Node<S>>,
) -> Result<(), BufferFull> {
    items.shorten(0);
    for (index, start) in (0_u32..).zip((0..points.len()).step_by(CHUNK)) {
        let end = (start + CHUNK).min(points.len());
        let chunk = points.get(start..end).unwrap_or_default();
        let mut bounds = Aabb::around(chunk.iter().map(|p| &p.centre));
        if let (Some(last), Some(after)) = (chunk.last(), points.get(end))
            && last.polyline == after.polyline
        {
            bounds.include(&after.centre);
        }
        items.push(Item { bounds, index })?;
    }
    hierarchy::build(items.items_mut(), nodes)
}

impl<'a, S: Scalar> LfsIndex<'a, S> {
    /// The index over these points, with the nodes that [`build`] made for them.
    pub const fn new(points: &'a [MedialPoint<S>], nodes: &'a [Node<S>]) -> Self {
        Self { points, nodes }
    }

    /// The medial points.
    pub const fn points(&self) -> &'a [MedialPoint<S>] {
        self.points
    }

    /// The nearest point of the medial polylines, if it is nearer than `limit_sq` (a squared distance).
    pub fn nearest(&self, p: &Point<S>, limit_sq: S) -> Option<NearestMedial<S>> {
        let mut state: (S, Option<NearestMedial<S>>) = (limit_sq, None);
        Hierarchy::new(self.nodes).nearest_first(
            p,
            &mut state,
            |s| s.0.clone(),
            |(bound, best), chunk| {
                let start = chunk as usize * CHUNK;
                let chunk = self.points.get(start..(start + CHUNK + 1).min(self.points.len())).unwrap_or_default();
                for (i, a) in chunk.iter().enumerate().take(CHUNK) {
                    let q = match chunk.get(i + 1) {
                        Some(b) if b.polyline == a.polyline => project_to_segment(p, &a.centre, &b.centre).1,
                        _ => a.centre.clone(),
                    };
                    let d = q.distance_sq(p);
                    if d < *bound {
                        *bound = d.clone();
                        let vertex = u32::try_from(start + i).unwrap_or(u32::MAX);
                        *best = Some(NearestMedial { distance_sq: d, point: q, vertex });
                    }
                }
            },
        );
        state.1
    }

    /// Distance from p to the medial polylines; infinite if there are none.
    pub fn distance(&self, p: &Point<S>) -> S {
        self.nearest(p, S::infinity()).map_or_else(S::infinity, |n| n.distance_sq.sqrt())
    }
}

/// The distance that a search for the squared distance finds, where it is known not to exceed `bound` by more than rounding.
#[inline]
fn below_bound<S: Scalar>(bound: &S, nearest_sq: impl Fn(S) -> Option<S>) -> S {
    let everywhere = || nearest_sq(S::infinity()).map_or_else(S::infinity, S::sqrt);
    if !bound.is_finite() {
        return everywhere();
    }
    // A thousandth more, so that the rounding of the bound does not matter.
    let limit = bound.clone() * &(S::one() + &S::one().mul_pow2(-10));
    nearest_sq(limit.square()).map_or_else(everywhere, S::sqrt)
}

impl<S: Scalar> FeatureSize<S> for LfsIndex<'_, S> {
    #[inline]
    fn lfs(&self, _at: &CurveParam<S>, p: &Point<S>) -> S {
        self.distance(p)
    }

    #[inline]
    fn lfs_below(&self, _at: &CurveParam<S>, p: &Point<S>, bound: &S) -> S {
        below_bound(bound, |limit| self.nearest(p, limit).map(|n| n.distance_sq))
    }
}
