//! The whole chain in vectors: curve, contacts, medial polylines, index.
//!
//! A thin owner (feature `alloc`) around what the kernel's functions fill; it has no algorithm of its own. Programs without
//! an allocator call the same functions with lent slices, as `tests/kernel/core_only.rs` shows.

use crate::bezier::Cubic;
use crate::buffer::{BufferFull, Store};
use crate::certificate::{Claim, Neighbourhood, Piece, Placed, Step, Verdict};
use crate::curve::contact::{self, Contact};
use crate::curve::door::{self, CurveBuffers, CurveError, DoorOptions, DoorReport, Entered, PathInput};
use crate::curve::{ArcStart, Curve, CurveParam, Path, Segment, Source};
use crate::geometry::Point;
use crate::geometry::hierarchy::{Item, Node};
use crate::lfs::{self, LfsIndex};
use crate::medial::cell::Cell;
use crate::medial::{self, MedialPoint, Resolution};
use crate::prover::Prover;
use crate::sampling::{self, Sample, SamplingError, SamplingOptions};
use crate::scalar::{Directed, Scalar};
use alloc::vec::Vec;

type Buffers<S> =
    CurveBuffers<Vec<Segment<S>>, Vec<Source<S>>, Vec<Path>, Vec<ArcStart<S>>, Vec<Node<S>>, Vec<Item<S>>, Vec<u32>>;

/// A curve C in vectors.
#[derive(Debug)]
pub struct CurveModel<S> {
    buffers: Buffers<S>,
    entered: Entered<S>,
    contacts: Vec<Contact<S>>,
}

impl<S: Scalar> CurveModel<S> {
    /// Takes paths through the door and finds where they touch.
    ///
    /// # Errors
    /// See [`CurveError`].
    pub fn new(paths: &[(bool, &[Cubic<S>])], options: &DoorOptions<S>) -> Result<Self, CurveError> {
        let mut buffers: Buffers<S> = CurveBuffers {
            segments: Vec::new(),
            sources: Vec::new(),
            paths: Vec::new(),
            arcs: Vec::new(),
            nodes: Vec::new(),
            items: Vec::new(),
            order: Vec::new(),
        };
        let input = paths.iter().map(|&(closed, cubics)| PathInput { closed, cubics });
        let entered = door::enter(input, options, &mut buffers)?;
        let mut model = Self { buffers, entered, contacts: Vec::new() };
        let mut contacts = Vec::new();
        let curve = model.curve();
        for (_, segment) in curve.segments.iter().zip(0_u32..) {
            contact::find(&curve, segment, &mut contacts)?;
        }
        model.contacts = contacts;
        Ok(model)
    }

    /// The curve.
    pub fn curve(&self) -> Curve<'_, S> {
        self.buffers.curve(&self.entered)
    }

    /// Where it touches itself, by segment and parameter.
    pub fn contacts(&self) -> &[Contact<S>] {
        &self.contacts
    }

    /// What the door did.
    pub const fn report(&self) -> &DoorReport<S> {
        &self.entered.report
    }

    /// Diagonal of the box of all control points, in user units.
    pub const fn diagonal(&self) -> &S {
        &self.entered.diagonal
    }

    /// Translates a place on C back to the drawing: path, cubic of that path, parameter of that cubic.
    pub fn source(&self, at: &CurveParam<S>) -> (u32, u32, S) {
        let curve = self.curve();
        let Some((segment, source)) = curve.segment(at.segment).zip(curve.source(at.segment)) else {
            return (0, 0, at.t.clone());
        };
        let path = curve.paths.get(segment.path as usize).map_or(0, |p| p.source);
        (path, source.segment, source.parameter(&at.t))
    }

    /// The medial points of one path, polylines numbered from 0.
    pub fn walk(&self, path: u32, resolution: &Resolution<S>, relevance: &S) -> Vec<MedialPoint<S>> {
        let mut out = Vec::new();
        // A vector is never full.
        let _ = medial::walk(&self.curve(), path, resolution, &self.contacts, relevance, 0, &mut out);
        out
    }

    /// The same, if there are no more than `limit` of them.
    ///
    /// # Errors
    /// [`BufferFull`] where the limit is too low.
    pub fn walk_within(
        &self,
        path: u32,
        resolution: &Resolution<S>,
        relevance: &S,
        limit: usize,
    ) -> Result<Vec<MedialPoint<S>>, BufferFull> {
        let mut out = Capped { items: Vec::new(), limit };
        medial::walk(&self.curve(), path, resolution, &self.contacts, relevance, 0, &mut out)?;
        Ok(out.items)
    }

    /// The samples of one path.
    ///
    /// # Errors
    /// See [`SamplingError`].
    pub fn sample_path(
        &self,
        medial: &MedialModel<S>,
        path: u32,
        options: &SamplingOptions<S>,
    ) -> Result<Vec<Sample<S>>, SamplingError> {
        let (mut out, mut scratch) = (Vec::new(), Vec::new());
        let (curve, index) = (self.curve(), medial.index());
        sampling::sample_path(&curve, &index, &self.contacts, path, options, &mut out, &mut scratch)?;
        Ok(out)
    }

    /// The samples of all paths, in order.
    ///
    /// # Errors
    /// See [`SamplingError`].
    pub fn sample(
        &self,
        medial: &MedialModel<S>,
        options: &SamplingOptions<S>,
    ) -> Result<Vec<Sample<S>>, SamplingError> {
        let mut all = Vec::new();
        for (path, _) in (0_u32..).zip(self.curve().paths) {
            all.append(&mut self.sample_path(medial, path, options)?);
        }
        Ok(all)
    }
}

/// What came of judging samples.
#[derive(Clone, Debug)]
pub struct Judgement<S> {
    /// The answer.
    pub verdict: Verdict<S>,
    /// Pieces that cover C, by path and parameter (fewer where the first witness ended it), with indices into the samples.
    pub pieces: Vec<Piece<S>>,
    /// Where a floor serves.
    pub neighbourhoods: Vec<Neighbourhood<S>>,
    /// Their steps.
    pub steps: Vec<Step<S>>,
    /// Cells of the foot set: roots first, then pairs of halves. None where a [`Prover`] keeps them for what is asked next.
    pub cells: Vec<Cell<S>>,
    /// How many of them are roots.
    pub roots: usize,
}

impl<S: Directed> CurveModel<S> {
    /// Judges samples, sorted by path, segment and parameter ([`crate::certificate`]). No more than `cells` cells are made;
    /// with `stop` the first witness ends it.
    pub fn certify(&self, samples: &[Placed<S>], claim: &Claim<S>, cells: usize, stop: bool) -> Judgement<S> {
        let mut prover = Prover::new(self, cells);
        let judgement = prover.judge(samples, claim, stop);
        Judgement { cells: prover.into_cells(), ..judgement }
    }
}

/// Medial polylines in vectors, with their index.
#[derive(Debug, Default)]
pub struct MedialModel<S> {
    points: Vec<MedialPoint<S>>,
    nodes: Vec<Node<S>>,
}

impl<S: Scalar> MedialModel<S> {
    /// The medial polylines of all paths.
    pub fn new(curve: &CurveModel<S>, resolution: &Resolution<S>) -> Self {
        let relevance = medial::walk::relevance(&curve.curve());
        let paths = (0_u32..).zip(curve.curve().paths);
        Self::from_paths(paths.map(|(i, _)| curve.walk(i, resolution, &relevance)))
    }

    /// Puts together the medial points of the paths, in their order; polylines are renumbered.
    pub fn from_paths(paths: impl IntoIterator<Item = Vec<MedialPoint<S>>>) -> Self {
        let mut points: Vec<MedialPoint<S>> = Vec::new();
        let mut base = 0;
        for mut path in paths {
            for p in &mut path {
                p.polyline += base;
            }
            base = path.last().map_or(base, |p| p.polyline + 1);
            // A drawing of one path, or of one long one, is not copied.
            if points.is_empty() {
                points = path;
            } else {
                points.append(&mut path);
            }
        }
        let (mut items, mut nodes) = (Vec::new(), Vec::new());
        // Vectors are never full.
        let _ = lfs::build(&points, &mut items, &mut nodes);
        Self { points, nodes }
    }

    /// The index.
    pub fn index(&self) -> LfsIndex<'_, S> {
        LfsIndex::new(&self.points, &self.nodes)
    }

    /// The medial points.
    pub fn points(&self) -> &[MedialPoint<S>] {
        &self.points
    }

    /// lfs of a point of C.
    pub fn lfs(&self, p: &Point<S>) -> S {
        self.index().distance(p)
    }
}

/// A vector that takes no more than so many items.
struct Capped<T> {
    items: Vec<T>,
    limit: usize,
}

impl<T> Store<T> for Capped<T> {
    fn push(&mut self, item: T) -> Result<(), BufferFull> {
        if self.items.len() >= self.limit {
            return Err(BufferFull { capacity: self.limit });
        }
        self.items.push(item);
        Ok(())
    }

    fn items(&self) -> &[T] {
        &self.items
    }

    fn items_mut(&mut self) -> &mut [T] {
        &mut self.items
    }

    fn shorten(&mut self, len: usize) {
        self.items.truncate(len);
    }
}
