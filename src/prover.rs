//! What is proved about a curve, in vectors: verdicts, the effective ε, enclosures of lfs and of the reach.
//!
//! A thin owner (feature `alloc`) like [`crate::model`], without an algorithm of its own. It keeps the cells of the foot set from one
//! question to the next: what is known of them is known for good, whatever samples and whatever ε are asked about.

use crate::buffer::BufferFull;
use crate::certificate::condition::{Workspace, judge};
use crate::certificate::effective::{Decision, EffectiveEpsilon, bracket};
use crate::certificate::singular::neighbourhoods;
use crate::certificate::{Claim, Extent, Neighbourhood, Piece, Placed, Step, Verdict};
use crate::curve::ideal::{self, IdealSegment};
use crate::geometry::Point;
use crate::lfs::bound::{Band, LfsBounds};
use crate::lfs::enclose::{Precision, ReachBounds};
use crate::medial::cell::{Capsule, Cell};
use crate::medial::clear::Scene;
use crate::model::{CurveModel, Judgement};
use crate::scalar::Directed;
use alloc::vec::Vec;

/// The cells of a curve's foot set, with everything that was proved of them so far.
#[derive(Debug)]
pub struct Prover<'m, S> {
    model: &'m CurveModel<S>,
    coefficients: Vec<IdealSegment<S>>,
    cells: Vec<Cell<S>>,
    limit: usize,
    open: Vec<u32>,
    stretches: Option<Stretches<S>>,
}

/// Where floors serve: it depends on the claim and not on the samples.
#[derive(Debug)]
struct Stretches<S> {
    claim: Claim<S>,
    places: Vec<Neighbourhood<S>>,
    steps: Vec<Step<S>>,
    extents: Vec<Extent<S>>,
}

impl<S: Directed> Stretches<S> {
    /// The same floors and the same ε.
    fn serve(&self, claim: &Claim<S>) -> bool {
        let Claim { epsilon, min_distance, singular_floor, floor, .. } = &self.claim;
        *epsilon == claim.epsilon
            && *min_distance == claim.min_distance
            && *singular_floor == claim.singular_floor
            && *floor == claim.floor
    }
}

impl<'m, S: Directed> Prover<'m, S> {
    /// Nothing is known yet. No more than `limit` cells are made, whatever is asked.
    pub fn new(model: &'m CurveModel<S>, limit: usize) -> Self {
        let (mut coefficients, mut cells) = (Vec::new(), Vec::new());
        let curve = model.curve();
        // Vectors are never full.
        if ideal::coefficients(&curve, &mut coefficients).is_ok()
            && let Ok(band) = Band::new(Scene { curve: &curve, ideal: &coefficients }, Vec::new(), limit)
        {
            cells = band.into_cells();
        }
        Self { model, coefficients, cells, limit, open: Vec::new(), stretches: None }
    }

    /// All cells so far: roots first, then pairs of halves.
    pub fn cells(&self) -> &[Cell<S>] {
        &self.cells
    }

    /// The cells, once nothing more is to be asked.
    pub fn into_cells(self) -> Vec<Cell<S>> {
        self.cells
    }

    /// Asks a band of all cells so far, and keeps those that it makes.
    fn with<T>(&mut self, ask: impl FnOnce(&mut Band<'_, S, Vec<Cell<S>>>, &mut Vec<u32>) -> T) -> T {
        let curve = self.model.curve();
        let scene = Scene { curve: &curve, ideal: &self.coefficients };
        let mut band = Band::resumed(scene, core::mem::take(&mut self.cells), self.limit);
        let answer = ask(&mut band, &mut self.open);
        self.cells = band.into_cells();
        answer
    }

    /// Judges samples, sorted by path, segment and parameter ([`crate::certificate`]); with `stop` the first witness ends it. The
    /// judgement holds no cells: they stay here.
    pub fn judge(&mut self, samples: &[Placed<S>], claim: &Claim<S>, stop: bool) -> Judgement<S> {
        self.judge_again(samples, claim, stop, &[])
    }

    /// The same after samples were added, or dropped where nothing relies on them: `known` are the pieces of the earlier judgement, with the
    /// new numbers of their samples.
    pub fn judge_again(
        &mut self,
        samples: &[Placed<S>],
        claim: &Claim<S>,
        stop: bool,
        known: &[Piece<S>],
    ) -> Judgement<S> {
        let contacts = self.model.contacts();
        let known_stretches = self.stretches.take().filter(|stretches| stretches.serve(claim));
        let (judgement, stretches) = self.with(|band, _| {
            let stretches = known_stretches.unwrap_or_else(|| {
                let (mut places, mut steps, mut extents) = (Vec::new(), Vec::new(), Vec::new());
                // Vectors are never full.
                let _ = neighbourhoods(band.scene(), contacts, claim, &mut places, &mut steps, &mut extents);
                Stretches { claim: claim.clone(), places, steps, extents }
            });
            let mut work = Workspace { known, pieces: Vec::new(), cells: Vec::new() };
            // Vectors are never full.
            let verdict = judge(band, samples, claim, &stretches.extents, stop, &mut work).unwrap_or(Verdict::Unknown);
            let judgement = Judgement {
                verdict,
                pieces: work.pieces,
                neighbourhoods: stretches.places.clone(),
                steps: stretches.steps.clone(),
                cells: Vec::new(),
                roots: band.roots(),
            };
            (judgement, stretches)
        });
        self.stretches = Some(stretches);
        judgement
    }

    /// Bounds of the effective ε of samples, sorted as for [`Prover::judge`], with upper ≤ (1 + tolerance)·lower if the limits of the
    /// claim allow; its ε is the first one that is asked about.
    pub fn effective(&mut self, samples: &[Placed<S>], claim: &Claim<S>, tolerance: &S) -> EffectiveEpsilon<S> {
        // Nothing is gained from pieces so small that only a small part of the tolerance depends on them.
        let finest = claim.finest.clone().max(tolerance.clone().mul_pow2(-2));
        let decide = |epsilon: &S| -> Result<Decision<S>, BufferFull> {
            let claim = Claim { epsilon: epsilon.clone(), finest: finest.clone(), ..claim.clone() };
            Ok(match self.judge(samples, &claim, true).verdict {
                Verdict::Proved => Decision::Proved,
                Verdict::Refuted(w) => Decision::Refuted(w.ratio()),
                Verdict::Unknown => Decision::Unknown,
            })
        };
        let nothing = EffectiveEpsilon { lower: S::zero(), upper: S::infinity() };
        bracket(&claim.epsilon, tolerance, decide).unwrap_or(nothing)
    }

    /// Encloses lfs at all points of C within `h` of p ([`Band::lfs`]).
    pub fn lfs(&mut self, p: &Point<S>, h: &S, estimate: &S, precision: &Precision<S>) -> LfsBounds<S> {
        let nothing = LfsBounds { lower: S::zero(), upper: S::infinity() };
        self.with(|band, open| band.lfs(p, h, estimate, precision, open)).unwrap_or(nothing)
    }

    /// Encloses the reach ([`Band::reach`]).
    pub fn reach(&mut self, estimate: &S, precision: &Precision<S>) -> ReachBounds<S> {
        let nothing = ReachBounds { lower: S::zero(), upper: S::infinity(), cell: None };
        self.with(|band, open| band.reach(estimate, precision, open)).unwrap_or(nothing)
    }

    /// Capsules that hold all medial points with radii below `cap` ([`Band::capsules`]).
    pub fn capsules(&mut self, cap: &S, precision: &Precision<S>) -> Vec<Capsule<S>> {
        self.with(|band, open| {
            let mut all = Vec::new();
            let kept: Result<(), BufferFull> = band.capsules(cap, precision, open, |capsule| {
                all.push(capsule);
                Ok(())
            });
            // Vectors are never full.
            kept.map_or_else(|_| Vec::new(), |()| all)
        })
    }
}
