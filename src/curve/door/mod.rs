//! The door: from a drawing's paths to the curve C.
//!
//! Everything that real drawings need settled is settled here, once, in this order:
//!
//! 1. every coordinate is checked (finite, in range);
//! 2. segments shorter than [`DoorOptions::short`] × diagonal are dropped and their neighbours snapped together;
//! 3. closed paths whose ends differ by more than that get their straight closing line; open paths whose ends are that
//!    near are closed;
//! 4. straight cubics become lines of uniform speed, cubics with an exact cusp are split there ([`Source`]
//!    remembers);
//! 5. repeated cubics are marked: one obstacle (`twin`);
//! 6. ends that meet form joints: consecutive segments, and ends of open paths that are near each other;
//! 7. joints are classified. A joint that turns by less than the corner angle becomes *smooth*: both branches get one
//!    tangent line, each handle turned by half the kink, unless that would displace the curve by more than
//!    [`DoorOptions::displacement`] × diagonal. Everything else of two or more ends is a corner;
//! 8. strands, arcs and the hierarchy follow.
//!
//! What was changed is counted in [`DoorReport`]. The definitions stand in `docs/mathematics.md`, section 1.

mod joints;
mod paths;

use super::given::Extent;
use super::{ArcStart, Curve, Path, Segment, Source, arc, index_of, strands, twin};
use crate::bezier::Cubic;
use crate::buffer::{BufferFull, Store};
use crate::geometry::hierarchy::{Item, Node};
use crate::geometry::{Aabb, Point};
use crate::scalar::Scalar;
use core::fmt;

/// A path as it comes from the drawing: its cubics in order, each starting where the one before ends.
#[derive(Clone, Copy, Debug)]
pub struct PathInput<'a, S> {
    /// The path says that it is closed.
    pub closed: bool,
    /// Its cubics.
    pub cubics: &'a [Cubic<S>],
}

/// Thresholds of the door; lengths are relative to the diagonal of the box of all control points.
#[derive(Clone, Debug)]
pub struct DoorOptions<S> {
    /// Sine of the turn from which a joint is a corner.
    pub corner_sine: S,
    /// Segments, and gaps between ends, below this are nothing (2e-6).
    pub short: S,
    /// A joint whose smoothing would displace the curve by more stays a corner (1e-4).
    pub displacement: S,
    /// Consecutive arcs that share a leaf of the hierarchy (1). More need less memory for nodes and more time.
    pub leaf: u32,
}

impl<S: Scalar> Default for DoorOptions<S> {
    /// Corners from 1°, short below 2e-6, displacement up to 1e-4.
    fn default() -> Self {
        Self {
            corner_sine: sine_of_degrees(&S::one()),
            short: S::int(2) / &S::int(1_000_000),
            displacement: S::one() / &S::int(10_000),
            leaf: 1,
        }
    }
}

/// sin of an angle of 0° to 90°, by its Taylor series: the kernel has no trigonometry.
///
/// Relative error below 1e-9 plus a few roundoffs; angles outside the range are brought to its ends.
pub fn sine_of_degrees<S: Scalar>(degrees: &S) -> S {
    let degrees = degrees.clone().clamp(S::zero(), S::int(90));
    // π to 19 digits as a fraction of integers: 3 + 0.141592653 + 0.000000000589793…
    let billion = S::int(1_000_000_000);
    let pi = (S::int(589_793_238) / &billion + &S::int(141_592_653)) / &billion + &S::int(3);
    let x = degrees * &pi / &S::int(180);
    let x2 = x.clone().square();
    // x − x³/3! + x⁵/5! … nested, eight terms.
    let mut sum = S::one();
    for k in (1..9).rev() {
        sum = S::one() - &(x2.clone() * &sum / &S::int(2 * k * (2 * k + 1)));
    }
    (x * &sum).min(S::one())
}

/// What the door did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoorReport<S> {
    /// Segments dropped because they were short.
    pub dropped: u32,
    /// Paths that vanished with them.
    pub vanished: u32,
    /// Straight closing lines added.
    pub closing_lines: u32,
    /// Open paths closed because their ends nearly met.
    pub closed: u32,
    /// Straight cubics with uneven speed that now run at uniform speed.
    pub straightened: u32,
    /// Cubics split at an exact cusp.
    pub cusps: u32,
    /// Cubics that repeat another one.
    pub twins: u32,
    /// Joints of ends of different paths.
    pub joined: u32,
    /// Joints that were made tangent-continuous, with a kink above roundoff.
    pub smoothed: u32,
    /// Joints by kind.
    pub smooth_joints: u32,
    /// Joints that are corners.
    pub corners: u32,
    /// Open ends.
    pub open_ends: u32,
    /// Largest displacement of the curve by smoothing, in user units.
    pub displacement: S,
    /// Largest displacement by snapping, in user units.
    pub snap: S,
}

/// Why a drawing is no curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CurveError {
    /// No path has a cubic: draw something.
    Empty,
    /// A control point is infinite or not a number.
    NotFinite {
        /// Index of the path.
        path: u32,
        /// Index of the cubic in it.
        segment: u32,
    },
    /// All control points coincide, or all segments are too short to be anything.
    NoExtent,
    /// The drawing is so large or so small that products of six lengths leave the scalar's range: scale it.
    OutOfRange,
    /// A cubic does not start where the one before it ends.
    Disconnected {
        /// Index of the path.
        path: u32,
        /// Index of the cubic in it.
        segment: u32,
    },
    /// More segments than an index holds (2^30).
    TooMany,
    /// A lent buffer is too small.
    Full(BufferFull),
}

impl From<BufferFull> for CurveError {
    fn from(full: BufferFull) -> Self {
        Self::Full(full)
    }
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "there is no curve"),
            Self::NotFinite { path, segment } => {
                write!(f, "path {path}, segment {segment}: a coordinate is not a finite number")
            }
            Self::NoExtent => write!(f, "all points coincide: the drawing has no extent"),
            Self::OutOfRange => write!(f, "the drawing's coordinates are too large or too small to compute with"),
            Self::Disconnected { path, segment } => {
                write!(f, "path {path}, segment {segment} does not start where the segment before it ends")
            }
            Self::TooMany => write!(f, "more than 2^30 segments"),
            Self::Full(full) => full.fmt(f),
        }
    }
}

impl core::error::Error for CurveError {}

/// The buffers that hold a curve. Each part is a [`Store`]: lent slices, or vectors.
#[derive(Debug, Default)]
pub struct CurveBuffers<Segments, Sources, Paths, Arcs, Nodes, Items, Order> {
    /// One entry a segment: the cubics of the drawing, plus closing lines and cusps.
    pub segments: Segments,
    /// One entry a segment: where it comes from. A [`Forget`](crate::buffer::Forget) where places on C need not be translated
    /// back to the drawing.
    pub sources: Sources,
    /// One entry a path.
    pub paths: Paths,
    /// About 4 to 12 entries a segment, as it bends.
    pub arcs: Arcs,
    /// Two entries a leaf, that is, an arc ([`DoorOptions::leaf`]).
    pub nodes: Nodes,
    /// Scratch, one entry a leaf.
    pub items: Items,
    /// Scratch, one entry a segment or two a path, whichever is more.
    pub order: Order,
}

/// What [`enter`] found beside the curve itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entered<S> {
    /// Diagonal of the box of all control points.
    pub diagonal: S,
    /// See [`Curve::noise`].
    pub noise: S,
    /// See [`Curve::leaf`].
    pub leaf: u32,
    /// What was changed.
    pub report: DoorReport<S>,
}

/// Makes the curve C in `buffers` from a drawing's paths.
///
/// # Errors
/// See [`CurveError`]. The buffers' contents are then of no use.
#[inline(never)]
pub fn enter<'a, S, Sg, So, Pa, Ar, No, It, Or>(
    paths: impl Iterator<Item = PathInput<'a, S>> + Clone,
    options: &DoorOptions<S>,
    buffers: &mut CurveBuffers<Sg, So, Pa, Ar, No, It, Or>,
) -> Result<Entered<S>, CurveError>
where
    S: Scalar + 'a,
    Sg: Store<Segment<S>>,
    So: Store<Source<S>>,
    Pa: Store<Path>,
    Ar: Store<ArcStart<S>>,
    No: Store<Node<S>>,
    It: Store<Item<S>>,
    Or: Store<u32>,
{
    let CurveBuffers { segments, sources, paths: out, arcs, nodes, items, order } = buffers;
    segments.shorten(0);
    sources.shorten(0);
    out.shorten(0);
    arcs.shorten(0);
    items.shorten(0);
    order.shorten(0);
    let (diagonal, noise) = measure(paths.clone())?;
    let mut report = DoorReport { displacement: S::zero(), snap: S::zero(), ..DoorReport::default_counts() };
    let mut door = Door { options, diagonal: &diagonal, report: &mut report };
    for (index, path) in paths.enumerate() {
        let index = u32::try_from(index).map_err(|_| CurveError::TooMany)?;
        door.take_path(index, &path, segments, sources, out)?;
    }
    if segments.items().is_empty() {
        return Err(CurveError::NoExtent);
    }
    if segments.items().len() >= 1 << 30 {
        return Err(CurveError::TooMany);
    }
    for i in 0..segments.items().len().max(2 * out.items().len()) {
        order.push(u32::try_from(i).map_err(|_| CurveError::TooMany)?)?;
    }
    let count = segments.items().len();
    let segments = segments.items_mut();
    twin::mark(segments, order.items_mut().get_mut(..count).unwrap_or_default());
    door.report.twins = index_of(segments.iter().filter(|s| s.twin.is_some()).count());
    door.join(segments, out.items(), order);
    door.classify(segments);
    twin::follow(segments);
    for s in segments.iter_mut() {
        s.power = s.cubic.power_basis();
    }
    for (i, s) in segments.iter_mut().enumerate() {
        let first = arcs.items().len();
        if s.twin.is_none() {
            arc::cut(index_of(i), s, arcs)?;
        }
        s.arcs = (index_of(first), index_of(arcs.items().len() - first));
    }
    strands::number(segments, arcs.items_mut());
    let leaf = options.leaf.max(1);
    arc::enclose(segments, arcs.items(), leaf, items, nodes)?;
    Ok(Entered { diagonal, noise, leaf, report })
}

impl<S: Scalar> DoorReport<S> {
    fn default_counts() -> Self {
        Self {
            dropped: 0,
            vanished: 0,
            closing_lines: 0,
            closed: 0,
            straightened: 0,
            cusps: 0,
            twins: 0,
            joined: 0,
            smoothed: 0,
            smooth_joints: 0,
            corners: 0,
            open_ends: 0,
            displacement: S::zero(),
            snap: S::zero(),
        }
    }
}

/// Checks all coordinates; the diagonal of their box and the error of a difference of two of them.
fn measure<'a, S: Scalar + 'a>(paths: impl Iterator<Item = PathInput<'a, S>>) -> Result<(S, S), CurveError> {
    let mut bounds = Aabb::empty();
    let mut any = false;
    for (path, input) in paths.enumerate() {
        for (segment, cubic) in input.cubics.iter().enumerate() {
            if !cubic.is_finite() {
                return Err(CurveError::NotFinite { path: index_of(path), segment: index_of(segment) });
            }
            bounds.merge(&cubic.control_box());
            any = true;
        }
    }
    if !any {
        return Err(CurveError::Empty);
    }
    let Extent { diagonal, noise } = Extent::of_box(&bounds);
    if diagonal.is_zero() {
        return Err(CurveError::NoExtent);
    }
    let cube = diagonal.clone().square() * &diagonal;
    let sixth = cube.square();
    if !sixth.is_finite() || !(S::one() / &sixth).is_finite() {
        return Err(CurveError::OutOfRange);
    }
    Ok((diagonal, noise))
}

/// The state of one passage.
struct Door<'d, S> {
    options: &'d DoorOptions<S>,
    diagonal: &'d S,
    report: &'d mut DoorReport<S>,
}

impl<S: Scalar> Door<'_, S> {
    fn short(&self) -> S {
        self.options.short.clone() * self.diagonal
    }

    /// Handles and speeds below this share of the diagonal are zero: what they bend is below every floor.
    fn nothing(&self) -> S {
        let billionth = S::one() / &S::int(1_000_000_000);
        billionth.max(S::unit_roundoff().mul_pow2(2)) * self.diagonal
    }

    fn note_snap(&mut self, a: &Point<S>, b: &Point<S>) {
        let d = a.distance(b);
        if d > self.report.snap {
            self.report.snap = d;
        }
    }
}

impl<Sg, So, Pa, Ar, No, It, Or> CurveBuffers<Sg, So, Pa, Ar, No, It, Or> {
    /// The curve in these buffers, as [`enter`] made it.
    pub fn curve<'b, S: Scalar>(&'b self, entered: &'b Entered<S>) -> Curve<'b, S>
    where
        Sg: Store<Segment<S>>,
        So: Store<Source<S>>,
        Pa: Store<Path>,
        Ar: Store<ArcStart<S>>,
        No: Store<Node<S>>,
    {
        Curve {
            segments: self.segments.items(),
            sources: self.sources.items(),
            paths: self.paths.items(),
            arcs: self.arcs.items(),
            nodes: self.nodes.items(),
            leaf: entered.leaf,
            diagonal: &entered.diagonal,
            noise: &entered.noise,
        }
    }
}
