//! lfs at fixed places along C, gathered while the medial walk goes on: no medial point is kept.
//!
//! lfs(q) is the least distance from q to an edge of the medial polylines. Usually the edges are kept and searched for each q.
//! Here it is the other way round: the places q are fixed, a table of values ([`super::table`]) begins with bounds from above,
//! and each edge that the walk finds lowers the values of the places that it is nearer to. Then it is forgotten. 200 cubics
//! have 14 000 medial points at 32 foot points each, and some thousand places: a value of two bytes at each is all that is
//! left of the medial axis, and no index is searched while the sampler runs.
//!
//! **Few places are looked at.** Before the walk four disks a segment give bounds: a disk of radius r that stands on f has its
//! centre at r from f, so that lfs(q) ≤ r + |q − f|. Each node of the hierarchy over the arcs of C keeps a
//! number that no value below it exceeds, and an edge enters only nodes whose boxes are nearer than that. On an arc a place at
//! distance d from the edge, where no value is above m, says that the places within d − m along the curve are not concerned.
//!
//! **Exactness.** The values are those of a search of all edges, and of the centres of the first disks, to a few roundoffs of
//! coordinates (bounds that exclude a place are computed in plain arithmetic): every number that enters is the distance from
//! some medial point or edge, or larger. How much lfs of the polylines exceeds lfs is a matter of the foot points. A value
//! that is *stored* with fewer bits must be rounded down.
//!
//! **Work.** A turn is one of the medial walk ([`crate::medial::uniform`]) and, for the medial point that it finds, one visit
//! to each node at most, with a look at each place of the leaves that are entered; or one of the first disks, with a look at
//! each place of its segment. One turn between these reads all values.

use super::table::Column;
use crate::buffer::{BufferFull, Keep, Sink};
use crate::curve::contact::Contact;
use crate::curve::{Arc, Curve, CurveParam, Segment};
use crate::geometry::hierarchy::{Below, MAX_DEPTH};
use crate::geometry::{Aabb, Point, project_to_segment};
use crate::medial::uniform::{Progress, UniformWalk};
use crate::medial::{Foot, MedialPoint, Side};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Disks a segment before the walk: two on each side.
const DISKS: u32 = 4;

/// Nodes whose numbers are brought up to date after each medial point.
const REFRESH: u32 = 4;

/// The values of a table of lfs, as they come about. `get` and `set` read and write the list of all values, in whatever form it
/// is kept; `set` may round down.
pub struct Gather<'c, S, G, P> {
    stage: Stage,
    path: u32,
    walk: UniformWalk<'c, S>,
    values: Values<'c, S, G, P>,
}

/// What the next turn is about.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// The first disks, so many of which were looked at.
    Disks(u32),
    /// All values are read.
    Begin,
    /// The walk.
    Walk,
}

/// What the walk writes into.
struct Values<'c, S, G, P> {
    curve: &'c Curve<'c, S>,
    columns: &'c [Column],
    /// For each node of the hierarchy: no value below it is above this.
    most: &'c mut [S],
    get: G,
    set: P,
    last: Point<S>,
    polyline: u32,
    taken: u32,
    /// The node that was brought up to date last.
    stale: usize,
}

impl<'c, S: Scalar, G: Fn(u32) -> S, P: Fn(u32, S)> Gather<'c, S, G, P> {
    /// Before the first turn. `columns` has an entry a segment, `contacts` are the touchings of the whole curve. Every value is
    /// set to infinity. `most` has an entry a node of the curve's hierarchy; where there are fewer, more places are looked at.
    pub fn new(
        curve: &'c Curve<'c, S>,
        columns: &'c [Column],
        contacts: &'c [Contact<S>],
        foot_points: u32,
        most: &'c mut [S],
        (get, set): (G, P),
    ) -> Self {
        for column in columns {
            (column.first..column.first.saturating_add(column.count)).for_each(|k| set(k, S::infinity()));
        }
        let (last, polyline) = (Point::new(S::zero(), S::zero()), u32::MAX);
        Self {
            stage: Stage::Disks(0),
            path: 0,
            walk: UniformWalk::new(curve, 0, foot_points, contacts, 0),
            values: Values { curve, columns, most, get, set, last, polyline, taken: 0, stale: 0 },
        }
    }

    /// Medial points so far.
    pub const fn taken(&self) -> u32 {
        self.values.taken
    }

    /// Takes at most `budget` turns, at least one. Once it is done, no value changes.
    pub fn step(&mut self, budget: u32) -> Progress {
        for _ in 0..budget.max(1) {
            if self.path as usize >= self.values.curve.paths.len() {
                return Progress::Done;
            }
            self.turn();
        }
        Progress::Pending
    }

    fn turn(&mut self) {
        let curve = self.values.curve;
        self.stage = match self.stage {
            Stage::Disks(n) => {
                self.disk(n / DISKS, n % DISKS);
                if ((n + 1) / DISKS) as usize >= curve.segments.len() { Stage::Begin } else { Stage::Disks(n + 1) }
            }
            Stage::Begin => {
                (0..curve.nodes.len()).rev().for_each(|i| self.values.refresh(i));
                Stage::Walk
            }
            Stage::Walk => {
                // The values take everything: there is no error.
                if matches!(self.walk.step(1, &mut self.values), Ok(Progress::Done)) {
                    self.path += 1;
                    self.walk.go_on(self.path);
                }
                Stage::Walk
            }
        };
    }

    /// One of the first disks of a segment: at a quarter of its parameters from either end, on either side.
    fn disk(&mut self, segment: u32, n: u32) {
        let curve = self.values.curve;
        let t = S::ratio(if n & 2 == 0 { 1 } else { 3 }, 4);
        let side = if n & 1 == 0 { Side::Left } else { Side::Right };
        if curve.segment(segment).is_some_and(|s| s.twin.is_none())
            && let Some(foot) = Foot::normal(curve, CurveParam { segment, t }, side)
        {
            let radius = self.walk.radius(&foot);
            self.values.bound(segment, &foot.point, &radius);
        }
    }
}

impl<S: Scalar, G: Fn(u32) -> S, P: Fn(u32, S)> Sink<MedialPoint<S>> for Values<'_, S, G, P> {
    fn take(&mut self, m: MedialPoint<S>) -> Result<(), BufferFull> {
        self.taken += 1;
        let from = if m.polyline == self.polyline { self.last.clone() } else { m.centre.clone() };
        self.polyline = m.polyline;
        self.lower(&from, &m.centre);
        self.last = m.centre;
        // In preorder backwards: children before their parents.
        for _ in 0..REFRESH {
            self.stale = self.stale.checked_sub(1).unwrap_or(self.curve.nodes.len().saturating_sub(1));
            self.refresh(self.stale);
        }
        Ok(())
    }
}

impl<'c, S: Scalar, G: Fn(u32) -> S, P: Fn(u32, S)> Values<'c, S, G, P> {
    /// lfs(q) ≤ r + |q − f| for every place q of the segment of f.
    fn bound(&self, segment: u32, foot: &Point<S>, radius: &S) {
        let Some(column) = self.columns.get(segment as usize) else { return };
        for k in 0..column.count {
            let Some(q) = self.curve.point(&CurveParam { segment, t: column.parameter(k) }) else { break };
            self.offer(column.first.saturating_add(k), q.distance(foot) + radius);
        }
    }

    fn offer(&self, index: u32, v: S) {
        if v < (self.get)(index) {
            (self.set)(index, v);
        }
    }

    /// No value below the node is above this.
    fn most(&self, i: u32) -> S {
        self.most.get(i as usize).cloned().unwrap_or_else(S::infinity)
    }

    fn below(&self, i: usize) -> Option<Below> {
        self.curve.nodes.get(i).map(|node| node.below(u32::try_from(i).unwrap_or(u32::MAX)))
    }

    /// The number of a node from the values below it, or from its children's.
    fn refresh(&mut self, i: usize) {
        let most = match self.below(i) {
            Some(Below::Item(leaf)) => self.stretches(leaf).fold(S::zero(), |most, stretch| {
                (stretch.from..stretch.to)
                    .fold(most, |most, k| most.max((self.get)(stretch.column.first.saturating_add(k))))
            }),
            Some(Below::Nodes(nodes)) => {
                let [left, right] = nodes.map(|n| self.most(n));
                left.max(right)
            }
            None => return,
        };
        if let Some(slot) = self.most.get_mut(i) {
            *slot = most;
        }
    }

    /// Lowers the values that an edge is nearer than.
    #[inline(never)]
    fn lower(&mut self, a: &Point<S>, b: &Point<S>) {
        let edge = Aabb::around([a, b]);
        let mut waiting: ArrayVec<u32, MAX_DEPTH> = ArrayVec::new();
        let mut next = Some(0);
        while let Some(i) = next {
            let node = i as usize;
            let Some(bounds) = self.curve.nodes.get(node).map(|n| &n.bounds) else { break };
            let most = self.most(i);
            next = None;
            if bounds.gap_sq(&edge) < most.clone().square() {
                match self.below(node) {
                    Some(Below::Item(leaf)) => self.look(leaf, &most, a, b),
                    Some(Below::Nodes([left, right])) => {
                        waiting.keep(right);
                        next = Some(left);
                    }
                    None => {}
                }
            }
            next = next.or_else(|| waiting.pop());
        }
    }

    /// Looks at the places of a leaf. No value there is above `most`.
    fn look(&self, leaf: u32, most: &S, a: &Point<S>, b: &Point<S>) {
        for Stretch { segment, column, from, to } in self.stretches(leaf) {
            // The curve between two places is no longer than this.
            let [p0, p1, p2, p3] = &segment.cubic.points;
            let leg = p0.distance_sq(p1).max(p1.distance_sq(p2)).max(p2.distance_sq(p3)).sqrt();
            let length = leg * &S::int(3) / &S::int(i32::try_from(column.count - 1).unwrap_or(i32::MAX));
            let mut k = from;
            while k < to {
                let q = segment.point(&column.parameter(k));
                let d = project_to_segment(&q, a, b).1.distance(&q);
                // How far along the curve no value can change.
                let mut clear = d.clone() - most;
                self.offer(column.first.saturating_add(k), d);
                k += 1;
                clear = clear - &length;
                while clear > S::zero() && k < to {
                    k += 1;
                    clear = clear - &length;
                }
            }
        }
    }

    /// The places on the arcs of a leaf, segment by segment.
    fn stretches(&self, leaf: u32) -> impl Iterator<Item = Stretch<'c, S>> + use<'c, S, G, P> {
        let (curve, columns) = (self.curve, self.columns);
        let mut arcs = curve.arcs_in(leaf).map(|(_, arc)| arc);
        let mut next = arcs.next();
        core::iter::from_fn(move || {
            let Arc { segment: index, span: [start, mut end], .. } = next.take()?;
            for arc in arcs.by_ref() {
                if arc.segment != index {
                    next = Some(arc);
                    break;
                }
                [_, end] = arc.span;
            }
            let column = *columns.get(index as usize).filter(|column| column.count > 1)?;
            let segment = curve.segment(index)?;
            Some(Stretch { segment, column, from: column.step(&start), to: column.step(&end) + 2 })
        })
    }
}

/// Places in a row on one segment: from `from` to the one before `to`.
struct Stretch<'c, S> {
    segment: &'c Segment<S>,
    column: Column,
    from: u32,
    to: u32,
}
