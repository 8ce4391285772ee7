//! The ε-condition, proved piece by piece.
//!
//! A piece P is served by a sample s if |p−s| < ε·lfs(p) for all of its points: if lfs ≥ G on P with G = max |p−s| / ε. Whether
//! that holds is *decided* by the band, not by enclosing lfs: each cell of the foot set near P is discharged or divided, until
//! its capsule is no larger than P; what is left then divides P, and the halves inherit it. This dual recursion spends its time
//! only where ε·lfs and the distance nearly agree. Before a piece is divided its middle is tried as a witness of the
//! contrary.

use super::{Claim, Extent, Piece, Placed, Reason, Verdict, Witness};
use crate::bezier::Cubic;
use crate::buffer::{BufferFull, Store};
use crate::curve::{CurveParam, Path};
use crate::geometry::Point;
use crate::lfs::bound::{Band, Discharge};
use crate::medial::cell::Cell;
use crate::scalar::Directed;
use arrayvec::ArrayVec;

/// Halvings of a piece between two samples.
const DEPTH: usize = 60;

/// What [`judge`] works with and answers in; nothing is allocated.
#[derive(Debug)]
pub struct Workspace<'w, S, P, C> {
    /// Pieces of an earlier judgement of the same claim on fewer samples, by path and parameter, with the samples' new numbers. Where they
    /// prove a gap that is still one, it is not looked at again.
    pub known: &'w [Piece<S>],
    /// The pieces, by path and parameter, when it is done.
    pub pieces: P,
    /// Cells that are not yet discharged.
    pub cells: C,
}

/// Judges samples, sorted by path, segment and parameter.
///
/// `extents` are those of [`super::singular::neighbourhoods`]. With `stop`, the first witness ends it; else every piece is looked at and the pieces cover C.
///
/// # Errors
/// [`BufferFull`] where the workspace is too small.
pub fn judge<S, B, P, C>(
    band: &mut Band<'_, S, B>,
    samples: &[Placed<S>],
    claim: &Claim<S>,
    extents: &[Extent<S>],
    stop: bool,
    work: &mut Workspace<'_, S, P, C>,
) -> Result<Verdict<S>, BufferFull>
where
    S: Directed,
    B: Store<Cell<S>>,
    P: Store<Piece<S>>,
    C: Store<u32>,
{
    work.pieces.shorten(0);
    let mut judge = Judge {
        band,
        samples,
        claim,
        extents,
        stop,
        known: work.known,
        pieces: &mut work.pieces,
        cells: &mut work.cells,
        verdict: Verdict::Proved,
        compared: 0,
        full: 0,
    };
    let paths = judge.band.scene().curve.paths;
    for (path, index) in paths.iter().zip(0_u32..) {
        judge.path(path, index)?;
        if judge.done() {
            break;
        }
    }
    Ok(judge.verdict)
}

struct Judge<'j, 'b, S, B, P, C> {
    band: &'j mut Band<'b, S, B>,
    samples: &'j [Placed<S>],
    claim: &'j Claim<S>,
    extents: &'j [Extent<S>],
    stop: bool,
    known: &'j [Piece<S>],
    pieces: &'j mut P,
    cells: &'j mut C,
    verdict: Verdict<S>,
    compared: u64,
    /// No cells beyond this number for the current gap.
    full: usize,
}

/// A piece still to be proved, and the cells that matter to it.
struct Task<S> {
    span: [S; 2],
    open: [usize; 2],
    fresh: bool,
}

/// A piece in plain numbers.
struct Shape<S> {
    middle: Point<S>,
    /// No point of it is farther than this from the middle.
    half: S,
    /// The nearer neighbour, the largest distance from it.
    sample: u32,
    distance: S,
}

impl<S, B, P, C> Judge<'_, '_, S, B, P, C>
where
    S: Directed,
    B: Store<Cell<S>>,
    P: Store<Piece<S>>,
    C: Store<u32>,
{
    fn done(&self) -> bool {
        self.stop && matches!(self.verdict, Verdict::Refuted(_))
    }

    /// All pieces between neighbouring samples, and between samples and the ends of segments.
    fn path(&mut self, path: &Path, index: u32) -> Result<(), BufferFull> {
        let first = self.samples.partition_point(|s| s.path < index);
        let last = self.samples.partition_point(|s| s.path <= index);
        let own = self.samples.get(first..last).unwrap_or_default();
        let name = |i: usize| u32::try_from(first + i).unwrap_or(u32::MAX);
        // The neighbours of a position: the sample before it and the one behind it.
        let before = |i: usize| match (i, path.closed) {
            (0, true) => own.len().checked_sub(1).map(name),
            (0, false) => None,
            (i, _) => Some(name(i - 1)),
        };
        let behind = |i: usize| match (i < own.len(), path.closed) {
            (true, _) => Some(name(i)),
            (false, true) if !own.is_empty() => Some(name(0)),
            _ => None,
        };
        let mut next = 0;
        for segment in path.first..path.first + path.count {
            let mut from = S::zero();
            loop {
                let here = own.get(next).filter(|s| s.at.segment == segment);
                let to = here.map_or_else(S::one, |s| s.at.t.clone());
                if to > from {
                    self.gap(segment, [from, to.clone()], [before(next), behind(next)])?;
                    if self.done() {
                        return Ok(());
                    }
                }
                if here.is_none() {
                    break;
                }
                from = to;
                next += 1;
            }
        }
        Ok(())
    }

    /// A piece in plain numbers.
    fn shape(&self, cubic: &Cubic<S>, span: &[S; 2], neighbours: [Option<u32>; 2]) -> Option<Shape<S>> {
        let piece = cubic.part(&span[0], &span[1]);
        let farthest = |p: &Point<S>| piece.points.iter().map(|c| c.distance(p)).fold(S::zero(), S::max);
        let middle = piece.points[0].middle(&piece.points[3]).middle(&piece.points[1].middle(&piece.points[2]));
        let half = farthest(&middle);
        let (sample, distance) = neighbours
            .into_iter()
            .flatten()
            .filter_map(|i| self.samples.get(i as usize).map(|s| (i, farthest(&s.point))))
            .reduce(|a, b| if b.1 < a.1 { b } else { a })?;
        Some(Shape { middle, half, sample, distance: distance + self.band.slop() })
    }

    /// Proves, refutes or gives up the stretch between two neighbouring samples on one segment.
    fn gap(&mut self, segment: u32, span: [S; 2], neighbours: [Option<u32>; 2]) -> Result<(), BufferFull> {
        if self.again(segment, &span, neighbours)? {
            return Ok(());
        }
        let Some(cubic) = self.band.scene().curve.segment(segment).map(|s| s.cubic.clone()) else { return Ok(()) };
        let mut pending: ArrayVec<Task<S>, DEPTH> = ArrayVec::new();
        self.full = self.band.len().saturating_add(self.claim.gap_cells);
        self.cells.shorten(0);
        let mut given_up = false;
        pending.push(Task { span, open: [0, 0], fresh: true });
        while let Some(task) = pending.pop() {
            self.cells.shorten(task.open[1]);
            let Some(shape) = self.shape(&cubic, &task.span, neighbours) else {
                // A path without samples.
                self.verdict = Verdict::Unknown;
                self.add(segment, task.span, u32::MAX, Reason::Fine)?;
                continue;
            };
            // What lfs must be at least; the last factor makes the inequality strict and covers this line's rounding.
            let strict = S::one() + &S::unit_roundoff().mul_pow2(10);
            let need = shape.distance.clone() / &self.claim.epsilon * &strict;
            if let Some(reason) = self.floored(segment, &task.span, &shape) {
                self.add(segment, task.span, shape.sample, reason)?;
                continue;
            }
            if given_up {
                self.add(segment, task.span, shape.sample, Reason::Fine)?;
                continue;
            }
            let limited = self.discharge_all(&task, &shape, &need)?;
            let [from, to] = [task.open[1], self.cells.items().len()];
            if from == to {
                self.add(segment, task.span, shape.sample, Reason::Feature(need))?;
                continue;
            }
            let [a, b] = &task.span;
            let m = S::midpoint(a, b);
            if shape.half <= need.clone() * &S::ratio(1, 8)
                && let Some(witness) = self.witness(segment, &m, &need, [from, to])
            {
                self.verdict = Verdict::Refuted(witness);
                if self.stop {
                    return Ok(());
                }
            }
            let fine = shape.half <= need * &self.claim.finest || m <= *a || m >= *b;
            let full = pending.remaining_capacity() < 2;
            if limited || fine || full || self.pieces.items().len() >= self.claim.pieces {
                let reason = if limited {
                    Reason::Cells
                } else if fine || full {
                    Reason::Fine
                } else {
                    Reason::Pieces
                };
                if self.verdict == Verdict::Proved {
                    self.verdict = Verdict::Unknown;
                }
                given_up = self.claim.give_up;
                self.add(segment, task.span, shape.sample, reason)?;
                if self.done() {
                    return Ok(());
                }
                continue;
            }
            pending.push(Task { span: [m.clone(), b.clone()], open: [from, to], fresh: false });
            pending.push(Task { span: [a.clone(), m], open: [from, to], fresh: false });
        }
        Ok(())
    }

    /// Takes over the pieces of an earlier judgement, if they prove all of a gap: lfs is what it was, and a floor serves as long as its
    /// sample is still a neighbour.
    fn again(&mut self, segment: u32, span: &[S; 2], neighbours: [Option<u32>; 2]) -> Result<bool, BufferFull> {
        let first =
            self.known.partition_point(|p| p.segment < segment || (p.segment == segment && p.span[0] < span[0]));
        let known = self.known.get(first..).unwrap_or_default();
        let count = known.partition_point(|p| p.segment == segment && p.span[1] <= span[1]);
        let known = known.get(..count).unwrap_or_default();
        let holds = |p: &Piece<S>| match p.reason {
            Reason::Feature(_) => true,
            _ => p.reason.proves() && neighbours.contains(&Some(p.sample)),
        };
        let whole = known.first().is_some_and(|p| p.span[0] == span[0])
            && known.last().is_some_and(|p| p.span[1] == span[1])
            && known.windows(2).all(|pair| pair[0].span[1] == pair[1].span[0]);
        if !whole || !known.iter().all(holds) {
            return Ok(false);
        }
        for piece in known {
            self.pieces.push(piece.clone())?;
        }
        Ok(true)
    }

    /// Discharges or divides cells; appends those that are left. Whether the limit of cells was met.
    fn discharge_all(&mut self, task: &Task<S>, shape: &Shape<S>, need: &S) -> Result<bool, BufferFull> {
        let start = task.open[1];
        if task.fresh {
            let reach = need.clone().twice() + &shape.half;
            self.band.near(&shape.middle, &reach, self.cells)?;
        } else {
            for i in task.open[0]..task.open[1] {
                if let Some(&cell) = self.cells.items().get(i) {
                    self.cells.push(cell)?;
                }
            }
        }
        let mut limited = false;
        // Cells behind `next` are still to be looked at; those between `start` and `kept` stay open.
        let (mut kept, mut next) = (start, start);
        while let Some(&cell) = self.cells.items().get(next) {
            next += 1;
            self.compared += 1;
            if self.compared > self.claim.work {
                // Give up here: what is left stays open.
                self.cells.shorten(kept.max(start + 1));
                return Ok(true);
            }
            if self.band.discharge(cell, &shape.middle, &shape.half, need) == Discharge::Done {
                continue;
            }
            // Halves that were made for other pieces cost nothing; the last pieces are worth finer cells. Nothing is gained
            // where a cell is long only because its radii are not known.
            let fine = shape.half <= need.clone() * &self.claim.finest;
            // A medial point that is nearer than the claim allows: only a shorter piece can hold, and asks less of all other cells.
            if !fine && self.band.farthest_hoped(cell, &shape.middle, need) < *need {
                let count = self.cells.items().len();
                for from in next - 1..count {
                    self.cells.items_mut().swap(kept, from);
                    kept += 1;
                }
                break;
            }
            let [extent, movable] = self.band.extent(cell, need);
            let least = need.clone() * &self.claim.finest.clone().mul_pow2(-4);
            let large = (extent > shape.half || (fine && extent > least)) && movable > least.mul_pow2(-4);
            if large || self.band.divided(cell) {
                let may = self.band.divided(cell) || self.band.len() < self.full;
                if let Some([a, b]) = if may { self.band.divide(cell) } else { None } {
                    self.cells.push(a)?;
                    self.cells.push(b)?;
                    continue;
                }
                // A cell that is as small as it will ever be is no reason to give up: smaller pieces ask less of it.
                limited |= large && (!may || self.band.is_full());
            }
            if let Some(slot) = self.cells.items_mut().get_mut(kept) {
                *slot = cell;
            }
            kept += 1;
        }
        self.cells.shorten(kept);
        Ok(limited)
    }

    /// The piece is served by a floor.
    fn floored(&self, segment: u32, span: &[S; 2], shape: &Shape<S>) -> Option<Reason<S>> {
        if let Some(min) = &self.claim.min_distance {
            return (shape.distance < *min).then_some(Reason::Floor);
        }
        let diagonal = self.band.scene().curve.diagonal;
        if shape.distance < self.claim.floor.clone() * diagonal {
            return Some(Reason::Floor);
        }
        if shape.distance >= self.claim.singular_floor.clone() * diagonal {
            return None;
        }
        let first = self.extents.partition_point(|e| e.segment < segment);
        let mut own = self.extents.get(first..)?.iter().take_while(|e| e.segment == segment);
        own.find(|e| e.span[0] <= span[0] && span[1] <= e.span[1]).map(|e| Reason::Neighbourhood(e.neighbourhood))
    }

    /// The condition fails at a point: every sample is farther away than ε times an upper bound of its lfs.
    fn witness(&mut self, segment: u32, t: &S, need: &S, open: [usize; 2]) -> Option<Witness<S>> {
        let curve = self.band.scene().curve;
        let point = curve.segment(segment)?.point(t);
        let slop = self.band.slop().clone();
        // First by the best that could be shown of each cell, then by what is shown of the best one.
        let mut best = (S::infinity(), 0);
        for &cell in self.cells.items().get(open[0]..open[1])? {
            let farthest = self.band.farthest_hoped(cell, &point, need);
            if farthest < best.0 {
                best = (farthest, cell);
            }
        }
        let (mut lfs, cell) = (best.0 + &slop, best.1);
        if !lfs.is_finite() {
            return None;
        }
        let distance =
            self.samples.iter().map(|s| s.point.distance_sq(&point)).fold(S::infinity(), S::min).sqrt() - &slop;
        let floor = match &self.claim.min_distance {
            Some(min) => min.clone(),
            None => self.claim.singular_floor.clone() * curve.diagonal,
        };
        let fails = |lfs: &S| {
            let allowed = lfs.clone() * &self.claim.epsilon * &(S::one() + &S::unit_roundoff().mul_pow2(4));
            distance >= allowed && distance >= floor
        };
        if !fails(&lfs) {
            return None;
        }
        self.band.enclose(cell, need);
        lfs = self.band.cells().get(cell as usize)?.farthest(&point) + &slop;
        let at = CurveParam { segment, t: t.clone() };
        fails(&lfs).then_some(Witness { at, point, distance, lfs, cell })
    }

    fn add(&mut self, segment: u32, span: [S; 2], sample: u32, reason: Reason<S>) -> Result<(), BufferFull> {
        self.pieces.push(Piece { segment, span, sample, reason })
    }
}
