//! The walk with equal parameter steps, one foot at a time.
//!
//! N equal parameter steps a segment are the paper's parameter; here every joint, inflection and extremum of curvature is
//! added, since branches of the medial axis end there. Where the next foot stands depends on nothing that was found at the
//! last one, so the walk is a small machine that needs no stack: [`UniformWalk::step`] looks at a given number of feet and
//! returns, and a program that must not wait calls it between other things. [`walk_uniform`] calls it until it is done.
//!
//! **Work.** A *turn* is at most one tangent disk, or, at a joint, one look for strokes that touch it and one pass over the
//! ends that meet there, or one contact that is passed. A disk visits each node of the curve's hierarchy at most twice and each
//! arc at most twice (`docs/embedded.md` counts what a visit costs). Between two turns the walk is one struct without borrows
//! of the result, so that medial points can go wherever they are wanted.

use super::foot::{Foot, Side};
use super::trail::{Joint, Passage, Trail};
use super::walk::MedialPoint;
use crate::buffer::{BufferFull, Keep, Sink};
use crate::curve::contact::Contact;
use crate::curve::{Arc, Curve, CurveParam, EndId, Path};
use crate::geometry::Vector;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Walks around one path with `steps` parameter steps a segment and appends its medial points. `polyline` is the number that
/// the first polyline gets; the number after the last one is returned.
///
/// `contacts` are the touchings of the whole curve, as [`crate::curve::contact::find`] gives them.
///
/// # Errors
/// [`BufferFull`] where `out` cannot take more.
pub fn walk_uniform<S: Scalar>(
    curve: &Curve<'_, S>,
    path: u32,
    steps: u32,
    contacts: &[Contact<S>],
    polyline: u32,
    out: &mut impl Sink<MedialPoint<S>>,
) -> Result<u32, BufferFull> {
    let mut walk = UniformWalk::new(curve, path, steps, contacts, polyline);
    // Every turn leads on to the next foot, contact or joint of the path: the loop ends.
    while walk.step(u32::MAX, out)? == Progress::Pending {}
    Ok(walk.polyline())
}

/// Whether a walk is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// The budget is used up; call again.
    Pending,
    /// All medial points of the path have been handed out.
    Done,
}

/// Directions of a fan that wait: it is halved until its parts are narrow, from half a turn at most.
const FAN: usize = 24;

/// Where a cell ends: the parameter, and what is there.
#[derive(Clone, Debug)]
struct Goal<S> {
    t: S,
    kind: GoalKind<S>,
}

#[derive(Clone, Debug)]
enum GoalKind<S> {
    /// The end of the arc.
    Arc,
    /// A contact in one point.
    Point,
    /// A contact along a stretch, with its ends and edges.
    Stretch([S; 2], i32),
}

/// A place among the arcs of a segment, in the walk's direction: how many arcs and contacts of the arc were passed.
#[derive(Clone, Copy, Debug)]
struct Passed {
    arcs: u32,
    contacts: usize,
}

impl Passed {
    const fn contact(self) -> Self {
        Self { arcs: self.arcs, contacts: self.contacts + 1 }
    }

    const fn arc(self) -> Self {
        Self { arcs: self.arcs + 1, contacts: 0 }
    }
}

/// What the next turn is about.
#[derive(Clone, Debug)]
enum Stage<S> {
    /// A side of a segment starts.
    Side,
    /// What comes next behind the parameter.
    Next(Passed, S),
    /// Feet with the grid's parameters, then what the cell ends with.
    Cell { passed: Passed, k: i32, goal: Goal<S> },
    /// The medial axis is the curve itself: the edge k of a stretch.
    Stretch { passed: Passed, k: i32, ends: [S; 2], edges: i32 },
    /// The side ends.
    Joint,
    /// Directions of an end, from the last one that was emitted; the one that is due after a middle, then those that wait.
    Fan { end: EndId, here: Vector<S>, due: Option<Vector<S>>, waiting: ArrayVec<Vector<S>, FAN>, breaks: bool },
    /// Nothing is left.
    Done,
}

/// The walk around one path, between two turns.
pub struct UniformWalk<'c, S> {
    trail: Trail<'c, S>,
    path: Path,
    steps: i32,
    side: Side,
    /// Segments of this side that were passed.
    passed: u32,
    stage: Stage<S>,
}

/// A path, and the first stage of a walk around it.
fn beginning<S>(curve: &Curve<'_, S>, path: u32) -> (Path, Stage<S>) {
    let path = curve.paths.get(path as usize).copied().unwrap_or_default();
    (path, if path.count > 0 { Stage::Side } else { Stage::Done })
}

impl<'c, S: Scalar> UniformWalk<'c, S> {
    /// At the start of a path; the parameters are those of [`walk_uniform`]. A path that does not exist has no medial points.
    pub fn new(curve: &'c Curve<'c, S>, path: u32, steps: u32, contacts: &'c [Contact<S>], polyline: u32) -> Self {
        let steps = i32::try_from(steps.clamp(1, 1 << 24)).unwrap_or(1);
        let (path, stage) = beginning(curve, path);
        Self { trail: Trail::new(curve, contacts, polyline), path, steps, side: Side::Left, passed: 0, stage }
    }

    /// Goes on with another path, and the next number of a polyline.
    pub(crate) fn go_on(&mut self, path: u32) {
        (self.path, self.stage) = beginning(self.trail.curve, path);
        (self.side, self.passed) = (Side::Left, 0);
    }

    /// The radius of the disk at some foot.
    pub(crate) fn radius(&mut self, foot: &Foot<S>) -> S {
        self.trail.disk(foot).radius
    }

    /// The number of the polyline in hand; once the walk is done, the number after the last one.
    pub const fn polyline(&self) -> u32 {
        self.trail.polyline()
    }

    /// Takes at most `budget` turns (at least one).
    ///
    /// # Errors
    /// [`BufferFull`] where `out` cannot take more; the walk is then of no use.
    pub fn step(&mut self, budget: u32, out: &mut impl Sink<MedialPoint<S>>) -> Result<Progress, BufferFull> {
        for _ in 0..budget.max(1) {
            if matches!(self.stage, Stage::Done) {
                return Ok(Progress::Done);
            }
            self.turn(out)?;
        }
        Ok(if matches!(self.stage, Stage::Done) { Progress::Done } else { Progress::Pending })
    }

    /// Index of the segment in hand.
    const fn segment(&self) -> u32 {
        let Path { first, count, .. } = self.path;
        if self.forwards() { first + self.passed } else { first + count - 1 - self.passed }
    }

    const fn forwards(&self) -> bool {
        matches!(self.side, Side::Left)
    }

    /// The place at a parameter of the segment in hand.
    const fn at(&self, t: S) -> CurveParam<S> {
        CurveParam { segment: self.segment(), t }
    }

    #[inline(never)]
    fn turn(&mut self, out: &mut impl Sink<MedialPoint<S>>) -> Result<(), BufferFull> {
        self.stage = match core::mem::replace(&mut self.stage, Stage::Joint) {
            Stage::Side => self.start(out)?,
            Stage::Next(passed, from) => self.next(passed, &from),
            Stage::Cell { passed, k, goal } => self.foot(passed, k, goal, out)?,
            Stage::Stretch { passed, k, ends, edges } => {
                let t = Passage::edge(&ends, k, edges);
                if let Some(there) = self.trail.on_curve(self.at(t.clone())) {
                    self.trail.emit(&there, out)?;
                }
                if k < edges {
                    Stage::Stretch { passed, k: k + 1, ends, edges }
                } else {
                    Stage::Next(passed.contact(), t)
                }
            }
            Stage::Joint => self.joint(out)?,
            Stage::Fan { end, here, due, waiting, breaks } => self.fan(end, here, due, waiting, breaks, out)?,
            Stage::Done => Stage::Done,
        };
        Ok(())
    }

    /// The first foot of a side, unless the walk comes by it.
    fn start(&mut self, out: &mut impl Sink<MedialPoint<S>>) -> Result<Stage<S>, BufferFull> {
        if self.trail.curve.segment(self.segment()).is_none_or(|s| s.twin.is_some()) {
            self.trail.break_line();
            return Ok(Stage::Joint);
        }
        let t = if self.forwards() { S::zero() } else { S::one() };
        let at = self.at(t.clone());
        // A fan that comes to this normal does not come to the curve.
        if (!self.trail.joined || self.trail.runs_in(&at, self.side))
            && let Some(here) = self.trail.side_station(at, self.side)
        {
            self.trail.emit(&here, out)?;
        }
        Ok(Stage::Next(Passed { arcs: 0, contacts: 0 }, t))
    }

    /// The next arc of the side, where there is one.
    fn arc(&self, passed: Passed) -> Option<Arc<S>> {
        let curve = self.trail.curve;
        let (first, count) = curve.segment(self.segment())?.arcs;
        let left = count.checked_sub(1 + passed.arcs)?;
        curve.arc(first + if self.forwards() { passed.arcs } else { left })
    }

    /// What lies ahead: a contact on the arc, or its end.
    fn next(&mut self, passed: Passed, from: &S) -> Stage<S> {
        let Some(arc) = &self.arc(passed) else {
            self.trail.joined = true;
            return Stage::Joint;
        };
        let contacts = self.trail.contacts_in(self.segment(), arc);
        let n = if self.forwards() { Some(passed.contacts) } else { contacts.len().checked_sub(1 + passed.contacts) };
        let goal = match n.and_then(|n| contacts.get(n)) {
            None => Goal { t: arc.span[usize::from(self.forwards())].clone(), kind: GoalKind::Arc },
            Some(contact) => match self.trail.passage(contact, arc, self.side) {
                Passage::Elsewhere => return Stage::Next(passed.contact(), from.clone()),
                Passage::Point(t) => Goal { t, kind: GoalKind::Point },
                Passage::Stretch(ends, edges) if ends[0] == *from => {
                    return Stage::Stretch { passed, k: 1, ends, edges };
                }
                Passage::Stretch(ends, edges) => Goal { t: ends[0].clone(), kind: GoalKind::Stretch(ends, edges) },
            },
        };
        Stage::Cell { passed, k: self.first_behind(from), goal }
    }

    /// The grid's parameter k/N.
    fn grid(&self, k: i32) -> S {
        S::int(k) / &S::int(self.steps)
    }

    /// The first grid parameter strictly behind another one, by search: the kernel has no floor function.
    fn first_behind(&self, t: &S) -> i32 {
        let (mut lo, mut hi) = (-1, self.steps + 1);
        while hi - lo > 1 {
            let k = lo + (hi - lo) / 2;
            let grid = self.grid(k);
            if if self.forwards() { grid > *t } else { grid >= *t } {
                hi = k;
            } else {
                lo = k;
            }
        }
        if self.forwards() { hi } else { lo }
    }

    /// One foot of a cell: on the grid, or its end.
    fn foot(
        &mut self,
        passed: Passed,
        k: i32,
        goal: Goal<S>,
        out: &mut impl Sink<MedialPoint<S>>,
    ) -> Result<Stage<S>, BufferFull> {
        let t = self.grid(k);
        if (0..=self.steps).contains(&k) && if self.forwards() { t < goal.t } else { t > goal.t } {
            if let Some(foot) = Foot::on_obstacle(self.trail.curve, self.at(t), self.side) {
                let station = self.trail.station(foot);
                self.trail.emit(&station, out)?;
            }
            return Ok(Stage::Cell { passed, k: if self.forwards() { k + 1 } else { k - 1 }, goal });
        }
        let at = self.at(goal.t.clone());
        let station = match goal.kind {
            GoalKind::Arc => self.trail.side_station(at, self.side),
            _ => self.trail.on_curve(at),
        };
        if let Some(station) = station {
            self.trail.emit(&station, out)?;
        }
        Ok(match goal.kind {
            GoalKind::Arc => Stage::Next(passed.arc(), goal.t),
            GoalKind::Point => Stage::Next(passed.contact(), goal.t),
            GoalKind::Stretch(ends, edges) => Stage::Stretch { passed, k: 1, ends, edges },
        })
    }

    /// The joint behind the segment in hand.
    fn joint(&mut self, out: &mut impl Sink<MedialPoint<S>>) -> Result<Stage<S>, BufferFull> {
        let (side, Path { first, count, closed, .. }) = (usize::from(self.forwards()), self.path);
        let (last, end) = (first + count - 1, EndId::new(self.segment(), side));
        let next = match (self.passed + 1 < count, self.forwards()) {
            (true, true) => Some(self.segment() + 1),
            (true, false) => Some(self.segment() - 1),
            (false, forwards) => closed.then_some(if forwards { first } else { last }),
        };
        match self.trail.joint(end, next.map(|n| EndId::new(n, 1 - side))) {
            Joint::On => Ok(self.leave(false, true)),
            Joint::Break => Ok(self.leave(true, true)),
            Joint::Corner(breaks) => {
                let t = if side == 0 { S::zero() } else { S::one() };
                if let Some(corner) = self.trail.on_curve(self.at(t)) {
                    self.trail.emit(&corner, out)?;
                }
                Ok(self.leave(breaks, false))
            }
            Joint::Fan([first, middle, last], breaks) => {
                let mut waiting = ArrayVec::new();
                waiting.keep(last);
                waiting.keep(middle);
                Ok(Stage::Fan { end, here: first, due: None, waiting, breaks })
            }
        }
    }

    /// One direction of a fan.
    fn fan(
        &mut self,
        end: EndId,
        here: Vector<S>,
        due: Option<Vector<S>>,
        mut waiting: ArrayVec<Vector<S>, FAN>,
        breaks: bool,
        out: &mut impl Sink<MedialPoint<S>>,
    ) -> Result<Stage<S>, BufferFull> {
        let mut next = due;
        let mut after = None;
        if next.is_none() {
            let steps = S::int(self.steps.clamp(16, 1 << 20));
            // Halved until it is narrow, and then once more: at most as often as there is room.
            while let Some(top) = waiting.pop() {
                let middle = here.plus(&top).unit();
                let wide = here.minus(&top).norm() * &steps > S::int(16) && waiting.remaining_capacity() >= 2;
                match middle {
                    Some(middle) if wide => {
                        waiting.keep(top);
                        waiting.keep(middle);
                    }
                    Some(middle) => {
                        (next, after) = (Some(middle), Some(top));
                        break;
                    }
                    None => {
                        next = Some(top);
                        break;
                    }
                }
            }
        }
        let Some(next) = next else { return Ok(self.leave(breaks, true)) };
        if let Some(station) = self.trail.fan_station(end, next.clone()) {
            self.trail.emit(&station, out)?;
        }
        Ok(Stage::Fan { end, here: next, due: after, waiting, breaks })
    }

    /// Goes on behind a joint; `kept` where the next side need not repeat its first foot.
    fn leave(&mut self, breaks: bool, kept: bool) -> Stage<S> {
        if breaks {
            self.trail.break_line();
        }
        // The next side starts with its own normal, which the fan ended with, or which the corner point precedes.
        self.trail.joined &= kept;
        self.passed += 1;
        if self.passed < self.path.count {
            return Stage::Side;
        }
        self.passed = 0;
        if self.forwards() {
            if self.path.closed {
                self.trail.break_line();
            }
            self.side = Side::Right;
            return Stage::Side;
        }
        self.trail.break_line();
        Stage::Done
    }
}
