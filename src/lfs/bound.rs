//! Certified bounds of lfs: the medial axis in a band of capsules, refined where it matters.
//!
//! A [`Band`] is a forest of [cells](crate::medial::cell): a subdivision of the whole foot set, each cell with an enclosure of
//! the medial points that stand on it. Since every point of M is a medial point of the foot set (or a limit of such), every
//! level of the forest encloses M: the union of its capsules is a *band* around the medial axis. Nothing is computed before it
//! is asked for, nothing twice, and no bound on the reach is needed beforehand.
//!
//! **Lower bounds.** Let m = f + r d stand on a cell and p be any point of C. Disks are empty, so |p−m| ≥ r, and |p−m| ≥ |p−f| −
//! r, hence |p−m| ≥ |p−f|/2. To prove lfs(p) ≥ G each cell may therefore be discharged in one of three ways: it is farther than
//! 2G from p, its radii are at least G, or the part of its capsule with radii below G is at least G away. Radii above G are
//! never needed: far cells, inflections and half-planes cost nothing.
//!
//! **Upper bounds.** A cell whose radii have an upper bound contains a point of M within the capsule: |p−m| is at most the
//! distance to its farther end, and the spread.
//!
//! Proofs: `docs/certificates.md`, sections 1, 2 and 6.

use crate::buffer::{BufferFull, Store};
use crate::geometry::Point;
use crate::medial::cell::{Cell, UNDIVIDED, slop};
use crate::medial::clear::Scene;
use crate::medial::foot_set::roots;
use crate::scalar::Directed;

/// Two-sided bounds of lfs.
#[derive(Clone, Debug, PartialEq)]
pub struct LfsBounds<S> {
    /// lfs is at least this.
    pub lower: S,
    /// lfs is at most this; infinite where no medial point was proved.
    pub upper: S,
}

/// A forest of cells over the whole foot set.
#[derive(Debug)]
pub struct Band<'a, S, B> {
    scene: Scene<'a, S>,
    cells: B,
    /// Number of roots over arcs: two for each arc, in the order of the arcs.
    arcs: usize,
    /// Number of all roots.
    roots: usize,
    /// No more cells than this.
    limit: usize,
    slop: S,
}

/// What became of a cell in a proof of lfs ≥ G.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Discharge {
    /// It cannot come nearer than G.
    Done,
    /// It may.
    Open,
}

impl<'a, S: Directed, B: Store<Cell<S>>> Band<'a, S, B> {
    /// The roots of the forest, in a store that is emptied first. `limit` bounds the number of cells for good.
    ///
    /// # Errors
    /// [`BufferFull`] where the store cannot take the roots.
    pub fn new(scene: Scene<'a, S>, mut cells: B, limit: usize) -> Result<Self, BufferFull> {
        cells.shorten(0);
        roots(&scene, |feet| cells.push(Cell::new(&scene, feet)))?;
        Ok(Self::resumed(scene, cells, limit))
    }

    /// A forest whose cells another band of the same scene left ([`Band::into_cells`]), with all that they know.
    pub fn resumed(scene: Scene<'a, S>, cells: B, limit: usize) -> Self {
        let mut roots = 0;
        // Where there are cells they start with all roots, and counting these cannot fail.
        let _: Result<(), BufferFull> = crate::medial::foot_set::roots(&scene, |_| {
            roots += 1;
            Ok(())
        });
        let (arcs, roots) = (2 * scene.curve.arcs.len(), roots.min(cells.items().len()));
        let slop = slop(&scene);
        Self { scene, cells, arcs, roots, limit, slop }
    }

    /// What the band is about.
    pub const fn scene(&self) -> &Scene<'a, S> {
        &self.scene
    }

    /// All cells of all levels.
    pub fn cells(&self) -> &[Cell<S>] {
        self.cells.items()
    }

    /// Changes what is known of a cell.
    pub(super) fn with_cell(&mut self, index: u32, change: impl FnOnce(&Scene<'a, S>, &mut Cell<S>)) {
        if let Some(cell) = self.cells.items_mut().get_mut(index as usize) {
            change(&self.scene, cell);
        }
    }

    /// How many cells were made so far.
    pub fn len(&self) -> usize {
        self.cells.items().len()
    }

    /// No more cells can be made.
    pub fn is_full(&self) -> bool {
        self.len() + 2 > self.limit
    }

    /// How many of the cells are roots; they come first.
    pub const fn roots(&self) -> usize {
        self.roots
    }

    /// All cells, with what is known of them.
    pub fn into_cells(self) -> B {
        self.cells
    }

    /// There is no foot at all.
    pub fn is_empty(&self) -> bool {
        self.cells.items().is_empty()
    }

    /// The rounding that comparisons of plain numbers allow for.
    pub const fn slop(&self) -> &S {
        &self.slop
    }

    /// Appends the roots that may have feet nearer to p than `reach`.
    ///
    /// # Errors
    /// [`BufferFull`].
    pub fn near(&self, p: &Point<S>, reach: &S, out: &mut impl Store<u32>) -> Result<(), BufferFull> {
        let reach = reach.clone() + &self.slop;
        let reach_sq = reach.clone().square();
        let mut result = Ok(());
        self.scene.curve.hierarchy().traverse(
            p,
            &mut (),
            |(), bounds| bounds.distance_sq(p) <= reach_sq,
            |(), arc, _| {
                for side in 0..2 {
                    if result.is_ok() {
                        result = out.push(2 * arc + side);
                    }
                }
            },
        );
        result?;
        for index in self.arcs..self.roots {
            let Some(cell) = self.cells.items().get(index) else { break };
            if cell.centre.distance(p) <= reach {
                out.push(u32::try_from(index).unwrap_or(u32::MAX))?;
            }
        }
        Ok(())
    }

    /// Whether no medial point of a cell lies nearer than `g` to any point within `h` of p.
    pub fn discharge(&mut self, index: u32, p: &Point<S>, h: &S, g: &S) -> Discharge {
        let Some(cell) = self.cells.items_mut().get_mut(index as usize) else { return Discharge::Done };
        let margin = h.clone() + &self.slop;
        let far = cell.centre.distance(p) - &cell.half - &margin;
        if far >= g.clone().twice() {
            return Discharge::Done;
        }
        // A cell longer than the distance in question is better divided than enclosed.
        if cell.half > g.clone().half() {
            return Discharge::Open;
        }
        cell.look(&self.scene);
        // Where not even the best of all lower bounds would do, none is proved.
        let hoped = cell.hoped(&self.scene, g);
        if hoped < *g && cell.distance_from(p, &hoped, g) - &margin < *g {
            return Discharge::Open;
        }
        cell.enclose(&self.scene, g);
        if cell.lower >= *g || cell.distance(p, g) - &margin >= *g {
            return Discharge::Done;
        }
        Discharge::Open
    }

    /// Encloses the radii of a cell, as far as they are below `g`.
    pub fn enclose(&mut self, index: u32, g: &S) {
        self.with_cell(index, |scene, cell| cell.enclose(scene, g));
    }

    /// The least that the distance of a cell's farther end from p may come out as once its radii below `g` are enclosed.
    pub fn farthest_hoped(&self, index: u32, p: &Point<S>, g: &S) -> S {
        let cell = self.cells.items().get(index as usize);
        cell.map_or_else(S::infinity, |cell| cell.farthest_from(p, &cell.hoped(&self.scene, g)))
    }

    /// How large the part of a cell's capsule with radii below `g` is: half its length and its spread, and the spread alone.
    pub fn extent(&self, index: u32, g: &S) -> [S; 2] {
        let Some(cell) = self.cells.items().get(index as usize) else { return [S::zero(), S::zero()] };
        let lower = cell.hoped(&self.scene, g);
        let far = cell.upper.clone().min(g.clone()).max(lower.clone());
        let axis = far.clone() - &lower;
        let spread = cell.spread(&lower, &far);
        // The spread may vanish where the capsule is long: what counts is what another division would change.
        let movable = cell.half.clone() + &(cell.turning().clone() * &far);
        // Where C touches a foot nothing is known from below, however small the cell: its capsule gets thinner and not shorter. From above, a
        // smaller one may know more as long as it knows nothing that helps.
        if lower <= self.slop && cell.upper < *g && movable < axis.clone().mul_pow2(-5) {
            return [spread, movable];
        }
        [axis.half() + &spread, movable]
    }

    /// The cell has halves already.
    pub fn divided(&self, index: u32) -> bool {
        self.cells.items().get(index as usize).is_some_and(|c| c.children != UNDIVIDED)
    }

    /// The two halves of a cell, made where they do not exist yet; `None` where it cannot be divided or the limit is reached.
    pub fn divide(&mut self, index: u32) -> Option<[u32; 2]> {
        let len = self.cells.items().len();
        let cell = self.cells.items().get(index as usize)?;
        if cell.children != UNDIVIDED {
            return Some([cell.children, cell.children + 1]);
        }
        if len + 2 > self.limit {
            return None;
        }
        let [a, b] = cell.halves(&self.scene)?;
        let first = u32::try_from(len).ok()?;
        self.cells.push(a).ok()?;
        if self.cells.push(b).is_err() {
            self.cells.shorten(len);
            return None;
        }
        if let Some(cell) = self.cells.items_mut().get_mut(index as usize) {
            cell.children = first;
        }
        Some([first, first + 1])
    }
}
