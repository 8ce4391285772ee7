//! Enclosures of lfs and of the reach, to a relative width that is asked for.
//!
//! Both are branch and bound over the cells of a [`Band`], with no bound known beforehand. A *goal* is the number that is to be
//! proved as a lower bound. It starts a little above an estimate, where it cannot be proved if the estimate is right, and falls to
//! (1−share)·U as soon as a cell shows the upper bound U. Cells that are discharged for a goal are discharged for all smaller ones, so none is
//! looked at twice. If everything is discharged, the estimate was too small: the goal rises to (1−share)·U, or doubles.
//!
//! **lfs** on a disk around a point: cells are discharged as in [`super::bound`]. What cannot be divided any more bounds lfs by what is
//! known of it. **The reach**, inf lfs, is also the infimum of the radii r(f, d): with m = f + r d, |p − m| ≥ r for every p ∈ C since
//! disks are empty, and |f − m| = r. So no pieces of C are needed, only radii of cells; at corners, crossings and contacts it is 0.
//!
//! Proofs: `docs/certificates.md`, sections 2 and 10.

use super::bound::{Band, Discharge, LfsBounds};
use crate::buffer::{BufferFull, Store};
use crate::geometry::Point;
use crate::medial::cell::{Capsule, Cell};
use crate::scalar::Directed;

/// How exactly something is to be enclosed, and what it may cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Precision<S> {
    /// upper − lower, as a share of upper.
    pub share: S,
    /// An upper bound as small as this need not be made any better (a length).
    pub least: S,
    /// Cells looked at, at most; then bounds are what is known by then.
    pub steps: u32,
}

/// Two-sided bounds of the reach.
#[derive(Clone, Debug, PartialEq)]
pub struct ReachBounds<S> {
    /// lfs is at least this on all of C.
    pub lower: S,
    /// lfs is at most this at some foot of the cell; infinite where no medial point was proved.
    pub upper: S,
    /// The cell of the band that shows the upper bound: where the reach is attained, or nearly.
    pub cell: Option<u32>,
}

impl<S: Directed, B: Store<Cell<S>>> Band<'_, S, B> {
    /// Encloses lfs at all points of C within `h` of p. `estimate` only decides where the search starts; `open` is room for cells to
    /// look at.
    ///
    /// # Errors
    /// [`BufferFull`] where `open` is too small.
    pub fn lfs(
        &mut self,
        p: &Point<S>,
        h: &S,
        estimate: &S,
        precision: &Precision<S>,
        open: &mut impl Store<u32>,
    ) -> Result<LfsBounds<S>, BufferFull> {
        let most = self.scene().curve.diagonal.clone().twice();
        let mut steps = precision.steps;
        let mut goal = start(estimate, &precision.share, &most);
        let mut known = LfsBounds { lower: S::zero(), upper: S::infinity() };
        loop {
            let bounds = self.lfs_below(p, h, goal.clone(), precision, &mut steps, open)?;
            known.upper = known.upper.min(bounds.upper);
            let reached = bounds.lower >= goal;
            known.lower = known.lower.max(bounds.lower);
            match higher(&known.lower, &known.upper, &goal, &precision.share, &most) {
                Some(next) if reached => goal = next,
                _ => return Ok(known),
            }
        }
    }

    /// The same, as far as lfs is below the goal.
    fn lfs_below(
        &mut self,
        p: &Point<S>,
        h: &S,
        mut goal: S,
        precision: &Precision<S>,
        steps: &mut u32,
        open: &mut impl Store<u32>,
    ) -> Result<LfsBounds<S>, BufferFull> {
        let margin = h.clone() + self.slop();
        let outward = S::one() + &S::unit_roundoff().mul_pow2(4);
        let (mut upper, mut left) = (S::infinity(), S::infinity());
        open.shorten(0);
        self.near(p, &(goal.clone().twice() + h), open)?;
        while let Some(index) = pop(open) {
            if self.discharge(index, p, h, &goal) == Discharge::Done {
                continue;
            }
            let spent = *steps == 0;
            *steps = steps.saturating_sub(1);
            if (self.farthest_hoped(index, p, &goal) + &margin) * &outward < upper {
                self.enclose(index, &goal);
            }
            let far = self.cell(index).map_or_else(S::infinity, |cell| cell.farthest(p));
            let far = (far + &margin) * &outward;
            if far < upper {
                // An eighth of the width is for cells that are small enough not to be divided.
                goal = goal.min(far.clone() * &(S::one() - &(precision.share.clone() * &S::ratio(7, 8))));
                upper = far;
                if self.discharge(index, p, h, &goal) == Discharge::Done {
                    continue;
                }
            }
            let [extent, movable] = self.extent(index, &goal);
            // Nothing is gained beyond a part of the width, or of the disk around p.
            let fine = (goal.clone() * &precision.share.clone().mul_pow2(-4)).max(h.clone().mul_pow2(-2));
            let enough = spent || upper <= precision.least || extent <= fine || movable <= fine.mul_pow2(-4);
            match if enough { None } else { self.divide(index) } {
                Some([a, b]) => {
                    open.push(a)?;
                    open.push(b)?;
                }
                None => {
                    self.enclose(index, &goal);
                    left = left.min(self.at_least(index, p, &margin, &goal));
                }
            }
        }
        let lower = goal.min(left).max(S::zero());
        Ok(LfsBounds { lower, upper })
    }

    /// No medial point of a cell is nearer than this to points within `margin` of p; at most `goal`.
    fn at_least(&self, index: u32, p: &Point<S>, margin: &S, goal: &S) -> S {
        let Some(cell) = self.cell(index) else { return goal.clone() };
        let inward = S::one() - &S::unit_roundoff().mul_pow2(4);
        let feet = (cell.centre.distance(p) - &cell.half - margin).half();
        let axis = cell.distance(p, goal) - margin;
        (axis.max(feet) * &inward).max(cell.lower.clone()).min(goal.clone())
    }

    /// Encloses the reach: the least lfs on all of C. `estimate` only decides where the search starts.
    ///
    /// # Errors
    /// [`BufferFull`] where `open` is too small.
    pub fn reach(
        &mut self,
        estimate: &S,
        precision: &Precision<S>,
        open: &mut impl Store<u32>,
    ) -> Result<ReachBounds<S>, BufferFull> {
        let most = self.scene().curve.diagonal.clone().twice();
        let mut steps = precision.steps;
        let mut goal = start(estimate, &precision.share, &most);
        let mut known = ReachBounds { lower: S::zero(), upper: S::infinity(), cell: None };
        loop {
            let bounds = self.reach_below(goal.clone(), precision, &mut steps, open)?;
            if bounds.upper < known.upper {
                (known.upper, known.cell) = (bounds.upper, bounds.cell);
            }
            let reached = bounds.lower >= goal;
            known.lower = known.lower.max(bounds.lower);
            match higher(&known.lower, &known.upper, &goal, &precision.share, &most) {
                Some(next) if reached => goal = next,
                _ => return Ok(known),
            }
        }
    }

    fn reach_below(
        &mut self,
        mut goal: S,
        precision: &Precision<S>,
        steps: &mut u32,
        open: &mut impl Store<u32>,
    ) -> Result<ReachBounds<S>, BufferFull> {
        let mut found = ReachBounds { lower: S::zero(), upper: S::infinity(), cell: None };
        let mut left = S::infinity();
        open.shorten(0);
        for root in (0..self.roots()).rev() {
            open.push(u32::try_from(root).unwrap_or(u32::MAX))?;
        }
        while let Some(index) = pop(open) {
            let spent = *steps == 0;
            *steps = steps.saturating_sub(1);
            if !spent {
                self.enclose(index, &goal);
            }
            let Some(cell) = self.cell(index) else { continue };
            // lfs is nowhere above the longest radius.
            if cell.upper < found.upper {
                found.upper = cell.upper.clone();
                found.cell = Some(index);
                goal = goal.min(cell.upper.clone() * &(S::one() - &precision.share));
            }
            if cell.lower >= goal {
                continue;
            }
            let lower = cell.lower.clone();
            let enough = spent || found.upper <= precision.least;
            match if enough { None } else { self.divide(index) } {
                Some([a, b]) => {
                    open.push(a)?;
                    open.push(b)?;
                }
                None => left = left.min(lower),
            }
        }
        found.lower = goal.min(left).max(S::zero());
        Ok(found)
    }

    /// Calls `each` with capsules that together hold all medial points with radii below `cap`, divided until they are no larger than
    /// `share` of their radius, or `least`.
    ///
    /// # Errors
    /// [`BufferFull`] where `open` is too small, or what `each` answers.
    pub fn capsules<E: From<BufferFull>>(
        &mut self,
        cap: &S,
        precision: &Precision<S>,
        open: &mut impl Store<u32>,
        mut each: impl FnMut(Capsule<S>) -> Result<(), E>,
    ) -> Result<(), E> {
        open.shorten(0);
        for root in (0..self.roots()).rev() {
            open.push(u32::try_from(root).unwrap_or(u32::MAX))?;
        }
        let mut steps = precision.steps;
        while let Some(index) = pop(open) {
            let spent = steps == 0;
            steps = steps.saturating_sub(1);
            if !spent {
                self.enclose(index, cap);
            }
            let Some(cell) = self.cell(index) else { continue };
            if cell.lower >= *cap {
                continue;
            }
            let fine = (cell.lower.clone() * &precision.share).max(precision.least.clone());
            let [extent, movable] = self.extent(index, cap);
            if extent > fine
                && movable > fine.mul_pow2(-4)
                && !spent
                && let Some([a, b]) = self.divide(index)
            {
                open.push(b)?;
                open.push(a)?;
                continue;
            }
            if let Some(cell) = self.cell(index) {
                each(cell.capsule(cap))?;
            }
        }
        Ok(())
    }

    fn cell(&self, index: u32) -> Option<&Cell<S>> {
        self.cells().get(index as usize)
    }
}

/// The first goal: where a right estimate cannot be proved.
fn start<S: Directed>(estimate: &S, share: &S, most: &S) -> S {
    let goal = estimate.clone() * &(S::one() + share);
    if goal > S::zero() && goal < *most { goal } else { most.clone() }
}

/// The next goal where one was reached and bounds are still too far apart.
fn higher<S: Directed>(lower: &S, upper: &S, goal: &S, share: &S, most: &S) -> Option<S> {
    // Below the upper bound by the share: if that is reached, it is narrow enough.
    let enough = upper.clone() * &(S::one() - share);
    if *lower >= enough || goal >= most {
        return None;
    }
    Some(if upper.is_finite() { enough.min(most.clone()) } else { goal.clone().twice().min(most.clone()) })
}

fn pop(open: &mut impl Store<u32>) -> Option<u32> {
    let last = *open.items().last()?;
    open.shorten(open.items().len() - 1);
    Some(last)
}
