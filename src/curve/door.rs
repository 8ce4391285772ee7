//! The door: from a drawing's paths to the curve C.
//!
//! Everything that real drawings need settled is settled here, once, in this order:
//!
//! 1. every coordinate is checked (finite, in range);
//! 2. segments shorter than [`DoorOptions::short`] × diagonal are dropped and their neighbours snapped together;
//! 3. closed paths whose ends differ by more than that get their straight closing line; open paths whose ends are that
//!    near are closed;
//! 4. straight cubics become lines of uniform speed, cubics with an exact cusp are split there ([`Source`] remembers);
//! 5. repeated cubics are marked: one obstacle ([`super::twin`]);
//! 6. ends that meet form joints: consecutive segments, and ends of open paths that are near each other;
//! 7. joints are classified. A joint that turns by less than the corner angle becomes *smooth*: both branches get one
//!    tangent line, each handle turned by half the kink, unless that would displace the curve by more than
//!    [`DoorOptions::displacement`] × diagonal. Everything else of two or more ends is a corner;
//! 8. strands, arcs and the hierarchy follow.
//!
//! What was changed is counted in [`DoorReport`]. Source: DESIGN section 2 of this project's definitions (`docs/`).

use super::joint::{self, EndId, JointEnd, JointKind};
use super::{Arc, Curve, Path, Segment, Source, arc, twin};
use crate::bezier::{Cubic, critical};
use crate::buffer::{BufferFull, Store};
use crate::geometry::hierarchy::{self, Item, Node};
use crate::geometry::{Aabb, Point, Vector};
use crate::scalar::Scalar;
use core::cmp::Ordering;
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
}

impl<S: Scalar> Default for DoorOptions<S> {
    /// Corners from 1°, short below 2e-6, displacement up to 1e-4.
    fn default() -> Self {
        Self {
            corner_sine: sine_of_degrees(&S::one()),
            short: S::int(2) / &S::int(1_000_000),
            displacement: S::one() / &S::int(10_000),
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
pub struct CurveBuffers<Segments, Paths, Arcs, Nodes, Items, Order> {
    /// One entry a segment: the cubics of the drawing, plus closing lines and cusps.
    pub segments: Segments,
    /// One entry a path.
    pub paths: Paths,
    /// About 4 to 12 entries a segment, as it bends.
    pub arcs: Arcs,
    /// Two entries an arc.
    pub nodes: Nodes,
    /// Scratch, one entry an arc.
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
    /// What was changed.
    pub report: DoorReport<S>,
}

/// Makes the curve C in `buffers` from a drawing's paths.
///
/// # Errors
/// See [`CurveError`]. The buffers' contents are then of no use.
pub fn enter<'a, S, Sg, Pa, Ar, No, It, Or>(
    paths: impl Iterator<Item = PathInput<'a, S>> + Clone,
    options: &DoorOptions<S>,
    buffers: &mut CurveBuffers<Sg, Pa, Ar, No, It, Or>,
) -> Result<Entered<S>, CurveError>
where
    S: Scalar + 'a,
    Sg: Store<Segment<S>>,
    Pa: Store<Path>,
    Ar: Store<Arc<S>>,
    No: Store<Node<S>>,
    It: Store<Item<S>>,
    Or: Store<u32>,
{
    let CurveBuffers { segments, paths: out, arcs, nodes, items, order } = buffers;
    segments.shorten(0);
    out.shorten(0);
    arcs.shorten(0);
    items.shorten(0);
    order.shorten(0);
    let (diagonal, noise) = measure(paths.clone())?;
    let mut report = DoorReport { displacement: S::zero(), snap: S::zero(), ..DoorReport::default_counts() };
    let mut door = Door { options, diagonal: &diagonal, report: &mut report };
    for (index, path) in paths.enumerate() {
        let index = u32::try_from(index).map_err(|_| CurveError::TooMany)?;
        door.take_path(index, &path, segments, out)?;
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
    door.follow_twins(segments);
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
    strand(segments, arcs.items_mut());
    for (i, a) in arcs.items().iter().enumerate() {
        if let Some(s) = segments.get(a.segment as usize) {
            items.push(Item { bounds: a.bounds(s), index: index_of(i) })?;
        }
    }
    hierarchy::build(items.items_mut(), nodes)?;
    Ok(Entered { diagonal, noise, report })
}

/// An index below 2^31 as u32; larger counts were refused before.
fn index_of(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
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
    let diagonal = bounds.extent().norm();
    if diagonal.is_zero() {
        return Err(CurveError::NoExtent);
    }
    let cube = diagonal.clone().square() * &diagonal;
    let sixth = cube.square();
    if !sixth.is_finite() || !(S::one() / &sixth).is_finite() {
        return Err(CurveError::OutOfRange);
    }
    let largest = (bounds.min.x.abs().max(bounds.max.x.abs())).max(bounds.min.y.abs().max(bounds.max.y.abs()));
    let noise = largest * &S::unit_roundoff() * &S::int(4);
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

    /// Steps 2 to 4 for one path.
    fn take_path(
        &mut self,
        index: u32,
        input: &PathInput<'_, S>,
        segments: &mut impl Store<Segment<S>>,
        paths: &mut impl Store<Path>,
    ) -> Result<(), CurveError> {
        let first = segments.items().len();
        let short = self.short();
        let path = index_of(paths.items().len());
        let mut last: Option<Point<S>> = None;
        for (k, cubic) in input.cubics.iter().enumerate() {
            let k = index_of(k);
            if let Some(end) = &last
                && end.distance(cubic.start()) > short
            {
                return Err(CurveError::Disconnected { path: index, segment: k });
            }
            if length_of_polygon(cubic) < short {
                self.report.dropped += 1;
                // The chain of dropped pieces must not drift: `last` stays where the last kept segment ends, but a run of
                // them that leads away from it is a gap.
                if last.is_none() {
                    last = Some(cubic.start().clone());
                }
                continue;
            }
            let mut cubic = cubic.clone();
            if segments.items().len() > first
                && let Some(end) = &last
            {
                self.note_snap(end, cubic.start());
                cubic.points[0] = end.clone();
            }
            last = Some(cubic.end().clone());
            self.take_cubic(path, k, cubic, segments)?;
        }
        let count = segments.items().len() - first;
        if count == 0 {
            if !input.cubics.is_empty() {
                self.report.vanished += 1;
            }
            return Ok(());
        }
        let closed = self.close(path, input, first, segments)?;
        let count = index_of(segments.items().len() - first);
        paths.push(Path { source: index, first: index_of(first), count, closed })?;
        Ok(())
    }

    fn note_snap(&mut self, a: &Point<S>, b: &Point<S>) {
        let d = a.distance(b);
        if d > self.report.snap {
            self.report.snap = d;
        }
    }

    /// Step 3: is the path closed, and with what.
    fn close(
        &mut self,
        path: u32,
        input: &PathInput<'_, S>,
        first: usize,
        segments: &mut impl Store<Segment<S>>,
    ) -> Result<bool, CurveError> {
        let Some((start, end)) = segments
            .items()
            .get(first)
            .zip(segments.items().last())
            .map(|(a, b)| (a.cubic.start().clone(), b.cubic.end().clone()))
        else {
            return Ok(false);
        };
        if start.distance(&end) <= self.short() {
            self.note_snap(&start, &end);
            if let Some(last) = segments.items_mut().last_mut() {
                last.cubic.points[3] = start;
            }
            if !input.closed {
                self.report.closed += 1;
            }
            return Ok(true);
        }
        if input.closed {
            let k = index_of(input.cubics.len());
            self.take_cubic(path, k, Cubic::line(end, start), segments)?;
            self.report.closing_lines += 1;
        }
        Ok(input.closed)
    }

    /// Step 4: a straight cubic becomes a line, a cusped one two cubics.
    fn take_cubic(
        &mut self,
        path: u32,
        source: u32,
        mut cubic: Cubic<S>,
        segments: &mut impl Store<Segment<S>>,
    ) -> Result<(), CurveError> {
        let whole = Source { segment: source, from: S::zero(), to: S::one(), handles: None };
        if let Some(handles) = self.straight(&cubic) {
            let [a, _, _, b] = cubic.points;
            let third = S::ratio(1, 3);
            let uniform = (handles[0].clone() - &third).abs().max((handles[1].clone() - &third.twice()).abs())
                <= S::unit_roundoff().mul_pow2(4);
            if !uniform {
                self.report.straightened += 1;
            }
            let handles = (!uniform).then_some(handles);
            return Self::add(path, Source { handles, ..whole }, Cubic::line(a, b), segments);
        }
        // Handles that rounding left over point anywhere, and would hook the curve at a scale below every floor.
        let left_over = self.nothing() * &S::int(100);
        for (near, far) in [(0, 1), (3, 2)] {
            if let (Some(a), Some(b)) = (cubic.points.get(near).cloned(), cubic.points.get_mut(far))
                && a.distance(b) < left_over
            {
                *b = a;
            }
        }
        let power = cubic.power_basis();
        let mut from = S::zero();
        let mut rest = cubic.clone();
        for t in critical::slowest(&power) {
            if !self.is_cusp(&cubic, &power, &t, &from) {
                continue;
            }
            let inner = (t.clone() - &from) / &(S::one() - &from);
            let (mut left, mut right) = rest.split_at(&inner);
            // The derivative is nothing at the cusp: make it exactly so.
            left.points[2] = left.points[3].clone();
            right.points[1] = right.points[0].clone();
            Self::add(path, Source { segment: source, from, to: t.clone(), handles: None }, left, segments)?;
            self.report.cusps += 1;
            from = t;
            rest = right;
        }
        Self::add(path, Source { segment: source, from, to: S::one(), handles: None }, rest, segments)
    }

    /// A cusp in the open interval (from, 1): so slow that the circle of curvature is below every floor.
    fn is_cusp(&self, cubic: &Cubic<S>, power: &crate::bezier::PowerBasis<S>, t: &S, from: &S) -> bool {
        let margin = S::ratio(1, 1000);
        if *t < from.clone() + &margin || *t > S::one() - &margin {
            return false;
        }
        let speed_sq = power.derivative(t).norm_sq();
        let acceleration = power.second_derivative(t).norm();
        let size = length_of_polygon(cubic);
        acceleration > S::zero() && speed_sq <= self.nothing() * &acceleration.min(size)
    }

    fn add(
        path: u32,
        source: Source<S>,
        cubic: Cubic<S>,
        segments: &mut impl Store<Segment<S>>,
    ) -> Result<(), CurveError> {
        let index = index_of(segments.items().len());
        let end = |side: usize| {
            let (leaving, retracted) = leaving_direction(&cubic, side);
            JointEnd { kind: JointKind::Open, next: EndId::new(index, side), leaving, retracted }
        };
        let segment = Segment {
            ends: [end(0), end(1)],
            power: cubic.power_basis(),
            cubic,
            path,
            source,
            arcs: (0, 0),
            twin: None,
            strand: u32::MAX,
            loop_turn: S::zero(),
        };
        Ok(segments.push(segment)?)
    }

    /// The positions of the inner control points along a straight cubic that does not turn back, in [0, 1].
    fn straight(&self, cubic: &Cubic<S>) -> Option<[S; 2]> {
        let [a, b, c, d] = &cubic.points;
        let chord = d.minus(a);
        let length_sq = chord.norm_sq();
        let length = length_sq.clone().sqrt();
        if length <= self.nothing() {
            return None;
        }
        let (ab, ac) = (b.minus(a), c.minus(a));
        let off = ab.cross(&chord).abs().max(ac.cross(&chord).abs()) / &length;
        // Control points that were rounded lie off the line by a few roundoffs of the coordinates.
        let largest = [a, b, c, d].iter().fold(S::zero(), |m, p| m.max(p.x.clone().abs()).max(p.y.clone().abs()));
        if off > largest * &S::unit_roundoff().mul_pow2(3) {
            return None;
        }
        let slack = S::unit_roundoff().mul_pow2(4);
        let alpha = ab.dot(&chord) / &length_sq;
        let beta = ac.dot(&chord) / &length_sq;
        let ordered = alpha >= -slack.clone() && beta >= alpha.clone() - &slack && beta <= S::one() + &slack;
        ordered.then(|| {
            let alpha = alpha.clamp(S::zero(), S::one());
            let beta = beta.clamp(alpha.clone(), S::one());
            [alpha, beta]
        })
    }

    /// Step 6: consecutive segments, then ends of open paths.
    fn join(&mut self, segments: &mut [Segment<S>], paths: &[Path], order: &mut impl Store<u32>) {
        for path in paths {
            for k in 0..path.count {
                let here = path.first + k;
                let next = if k + 1 < path.count { here + 1 } else { path.first };
                if k + 1 == path.count && !path.closed {
                    continue;
                }
                unite(segments, EndId::new(here, 1), EndId::new(next, 0));
            }
        }
        // Ends of open paths, in cells of the snapping distance, so that near ends lie in neighbouring cells.
        let ends = |i: u32| {
            let p = paths.get((i >> 1) as usize)?;
            (!p.closed).then(|| if i & 1 == 0 { EndId::new(p.first, 0) } else { EndId::new(p.first + p.count - 1, 1) })
        };
        let short = self.short();
        let cell_of = |p: &Point<S>| {
            let cell = |v: &S| grid_index(&(v.clone() / &short));
            (cell(&p.x), cell(&p.y))
        };
        order.shorten(0);
        for i in 0..index_of(2 * paths.len()) {
            if ends(i).is_some() && order.push(i).is_err() {
                return;
            }
        }
        let view: &[Segment<S>] = segments;
        let point = |i: u32| {
            let e = ends(i)?;
            view.get(e.segment() as usize).map(|s| s.end_point(e.side()).clone())
        };
        let key = |i: u32| point(i).map_or((i64::MAX, i64::MAX, i), |p| (cell_of(&p).0, cell_of(&p).1, i));
        order.items_mut().sort_unstable_by_key(|&i| key(i));
        for n in 0..order.items().len() {
            let Some(&i) = order.items().get(n) else { break };
            let (Some(e), Some(p)) = (ends(i), segments_point(segments, ends(i))) else { continue };
            if let Some(leader) = near_earlier_end(segments, order.items(), i, &p, &short, &ends, &cell_of)
                && let Some(q) = segments_point(segments, Some(leader))
            {
                self.note_snap(&p, &q);
                if unite(segments, leader, e) {
                    self.report.joined += 1;
                    set_end_point(segments, e, q);
                }
            }
        }
    }

    /// Step 7: every joint gets its kind, and smooth ones their common tangent.
    fn classify(&mut self, segments: &mut [Segment<S>]) {
        for i in 0..index_of(segments.len()) {
            if segments.get(i as usize).is_none_or(|s| s.twin.is_some()) {
                continue;
            }
            for side in 0..2 {
                let first = EndId::new(i, side);
                let mut others = members_of(segments, first).skip(1);
                let (second, third) = (others.next(), others.next());
                let lowest = members_of(segments, first).all(|e| e >= first);
                drop(others);
                match (second, third) {
                    _ if !lowest => {}
                    (None, _) => self.report.open_ends += 1,
                    (Some(second), None) if self.smooth(segments, first, second) => self.report.smooth_joints += 1,
                    _ => {
                        self.report.corners += 1;
                        let mut e = first;
                        while let Some(end) = end_mut(segments, e) {
                            if end.kind == JointKind::Corner {
                                break;
                            }
                            end.kind = JointKind::Corner;
                            e = end.next;
                        }
                    }
                }
            }
        }
    }

    /// Makes a joint of two ends smooth if it turns little and both branches have handles there.
    fn smooth(&mut self, segments: &mut [Segment<S>], a: EndId, b: EndId) -> bool {
        let (Some(ea), Some(eb)) = (end_ref(segments, a), end_ref(segments, b)) else { return false };
        let (ua, ub) = (ea.leaving.clone(), eb.leaving.clone());
        if ea.retracted || eb.retracted {
            return false;
        }
        let sine = ua.cross(&ub).abs();
        if ua.dot(&ub) >= S::zero() || sine >= self.options.corner_sine {
            return false;
        }
        let Some(u) = ub.minus(&ua).unit() else { return false };
        let (Some(ha), Some(hb)) = (handle_length(segments, a), handle_length(segments, b)) else { return false };
        // Turning a handle of length h by half the kink moves the curve by at most 4/9 of h · kink/2. A kink below 1° and
        // its sine agree to 5e-5.
        let moved = ha.max(hb) * &sine * &S::ratio(2, 9);
        if moved > self.options.displacement.clone() * self.diagonal {
            return false;
        }
        if sine > S::unit_roundoff().mul_pow2(6) {
            self.report.smoothed += 1;
        }
        if moved > self.report.displacement {
            self.report.displacement = moved;
        }
        turn_handle(segments, a, u.opposite());
        turn_handle(segments, b, u);
        true
    }

    /// A twin is the same curve as its leader, to the bit, and its ends are of the same kinds.
    fn follow_twins(&self, segments: &mut [Segment<S>]) {
        for i in 0..segments.len() {
            let Some(t) = segments.get(i).and_then(|s| s.twin) else { continue };
            let Some(leader) = segments.get(t.segment as usize) else { continue };
            let (cubic, ends) = if t.reversed {
                let [a, b] = leader.ends.clone();
                (leader.cubic.reversed(), [b, a])
            } else {
                (leader.cubic.clone(), leader.ends.clone())
            };
            if let Some(s) = segments.get_mut(i) {
                s.cubic = cubic;
                s.ends = ends;
            }
        }
    }
}

/// Length of the control polygon: at least the curve's.
fn length_of_polygon<S: Scalar>(cubic: &Cubic<S>) -> S {
    let [a, b, c, d] = &cubic.points;
    a.distance(b) + &b.distance(c) + &c.distance(d)
}

/// The unit direction in which a cubic leaves an end, and whether its handle there is retracted.
fn leaving_direction<S: Scalar>(cubic: &Cubic<S>, side: usize) -> (Vector<S>, bool) {
    let [a, b, c, d] = if side == 0 { cubic.points.clone() } else { cubic.reversed().points };
    if let Some(u) = b.minus(&a).unit() {
        return (u, false);
    }
    let u = c.minus(&a).unit().or_else(|| d.minus(&a).unit());
    (u.unwrap_or_else(|| Vector::new(S::one(), S::zero())), true)
}

/// A grid coordinate; far outside of any grid for numbers that no grid holds.
#[allow(clippy::cast_possible_truncation, reason = "a saturating cast is meant: coordinates beyond 2^63 cells share a cell")]
fn grid_index<S: Scalar>(v: &S) -> i64 {
    // Truncation makes one cell around zero twice as wide; neighbours are still neighbours.
    v.to_f64() as i64
}

/// The segment that stands for a twin, and the end of it.
fn obstacle_end<S>(segments: &[Segment<S>], e: EndId) -> EndId {
    match segments.get(e.segment() as usize).and_then(|s| s.twin) {
        Some(t) => EndId::new(t.segment, if t.reversed { 1 - e.side() } else { e.side() }),
        None => e,
    }
}

fn end_ref<S>(segments: &[Segment<S>], e: EndId) -> Option<&JointEnd<S>> {
    segments.get(e.segment() as usize).and_then(|s| s.ends.get(e.side()))
}

fn end_mut<S>(segments: &mut [Segment<S>], e: EndId) -> Option<&mut JointEnd<S>> {
    segments.get_mut(e.segment() as usize).and_then(|s| s.ends.get_mut(e.side()))
}

fn members_of<S>(segments: &[Segment<S>], e: EndId) -> impl Iterator<Item = EndId> + '_ {
    joint::members(e, |e| end_ref(segments, e).map(|end| end.next))
}

fn segments_point<S: Scalar>(segments: &[Segment<S>], e: Option<EndId>) -> Option<Point<S>> {
    let e = e?;
    segments.get(e.segment() as usize).map(|s| s.end_point(e.side()).clone())
}

fn set_end_point<S>(segments: &mut [Segment<S>], e: EndId, p: Point<S>) {
    if let Some(s) = segments.get_mut(e.segment() as usize) {
        let [a, _, _, d] = &mut s.cubic.points;
        *(if e.side() == 0 { a } else { d }) = p;
    }
}

/// Splices the lists of two ends into one; false if they were one already.
fn unite<S>(segments: &mut [Segment<S>], a: EndId, b: EndId) -> bool {
    let (a, b) = (obstacle_end(segments, a), obstacle_end(segments, b));
    // A list that holds b when walked from b's side is usually one entry long: walk that one.
    if a == b || members_of(segments, b).any(|e| e == a) {
        return false;
    }
    let (Some(na), Some(nb)) = (end_ref(segments, a).map(|e| e.next), end_ref(segments, b).map(|e| e.next)) else {
        return false;
    };
    if let Some(e) = end_mut(segments, a) {
        e.next = nb;
    }
    if let Some(e) = end_mut(segments, b) {
        e.next = na;
    }
    true
}

/// The end of an open path, earlier in `order` than end `i`, that lies within `short` of p.
fn near_earlier_end<S: Scalar>(
    segments: &[Segment<S>],
    order: &[u32],
    i: u32,
    p: &Point<S>,
    short: &S,
    ends: &impl Fn(u32) -> Option<EndId>,
    cell_of: &impl Fn(&Point<S>) -> (i64, i64),
) -> Option<EndId> {
    let cell_at = |n: usize| {
        let &j = order.get(n)?;
        let q = segments_point(segments, ends(j))?;
        Some((cell_of(&q), j))
    };
    let own = cell_of(p);
    for dx in -1..=1_i64 {
        for dy in -1..=1_i64 {
            let cell = (own.0.saturating_add(dx), own.1.saturating_add(dy));
            let mut n = order.partition_point(|&j| {
                segments_point(segments, ends(j)).is_some_and(|q| cell_of(&q).cmp(&cell) == Ordering::Less)
            });
            while let Some((c, j)) = cell_at(n) {
                if c != cell || (c, j) >= (own, i) {
                    break;
                }
                if let Some(e) = ends(j)
                    && segments_point(segments, Some(e)).is_some_and(|q| q.distance(p) <= *short)
                {
                    return Some(e);
                }
                n += 1;
            }
        }
    }
    None
}

fn handle_length<S: Scalar>(segments: &[Segment<S>], e: EndId) -> Option<S> {
    let [a, b, c, d] = &segments.get(e.segment() as usize)?.cubic.points;
    Some(if e.side() == 0 { a.distance(b) } else { d.distance(c) })
}

/// Turns the handle at an end into a direction, keeping its length.
fn turn_handle<S: Scalar>(segments: &mut [Segment<S>], e: EndId, leaving: Vector<S>) {
    let Some(h) = handle_length(segments, e) else { return };
    if let Some(s) = segments.get_mut(e.segment() as usize) {
        let [a, b, c, d] = &mut s.cubic.points;
        if e.side() == 0 {
            *b = a.plus_scaled(&h, &leaving);
        } else {
            *c = d.plus_scaled(&h, &leaving);
        }
    }
    if let Some(end) = end_mut(segments, e) {
        end.kind = JointKind::Smooth;
        end.leaving = leaving;
    }
}

/// The strand that follows a segment left through an end: the other end of a smooth joint.
fn smooth_neighbour<S>(segments: &[Segment<S>], e: EndId) -> Option<EndId> {
    let end = end_ref(segments, e)?;
    (end.kind == JointKind::Smooth).then_some(end.next)
}

/// Step 8: numbers the strands and accumulates turning along them.
fn strand<S: Scalar>(segments: &mut [Segment<S>], arcs: &mut [Arc<S>]) {
    let total = index_of(segments.len());
    let mut strands = 0;
    for i in 0..total {
        if segments.get(i as usize).is_none_or(|s| s.strand != u32::MAX || s.twin.is_some()) {
            continue;
        }
        // Back to where the strand begins, or once around its loop.
        let mut begin = EndId::new(i, 0);
        let mut closed = false;
        for _ in 0..total {
            let Some(before) = smooth_neighbour(segments, begin) else { break };
            begin = before.opposite();
            if begin == EndId::new(i, 0) {
                closed = true;
                break;
            }
        }
        let mut turn = S::zero();
        let mut entry = begin;
        for _ in 0..total {
            let k = entry.segment() as usize;
            let forwards = entry.side() == 0;
            if let Some(s) = segments.get_mut(k) {
                s.strand = strands;
                let (first, count) = s.arcs;
                let own = arcs.get_mut(first as usize..(first + count) as usize).unwrap_or_default();
                let pass = |a: &mut Arc<S>, turn: &mut S| {
                    let after = a.turning(s) + &*turn;
                    a.turn = if forwards { [turn.clone(), after.clone()] } else { [after.clone(), turn.clone()] };
                    *turn = after;
                };
                if forwards {
                    own.iter_mut().for_each(|a| pass(a, &mut turn));
                } else {
                    own.iter_mut().rev().for_each(|a| pass(a, &mut turn));
                }
            }
            match smooth_neighbour(segments, entry.opposite()) {
                Some(next) if next != begin => entry = next,
                _ => break,
            }
        }
        if closed {
            let mut entry = begin;
            for _ in 0..total {
                if let Some(s) = segments.get_mut(entry.segment() as usize) {
                    s.loop_turn = turn.clone();
                }
                match smooth_neighbour(segments, entry.opposite()) {
                    Some(next) if next != begin => entry = next,
                    _ => break,
                }
            }
        }
        strands += 1;
    }
}

impl<Sg, Pa, Ar, No, It, Or> CurveBuffers<Sg, Pa, Ar, No, It, Or> {
    /// The curve in these buffers, as [`enter`] made it.
    pub fn curve<'b, S: Scalar>(&'b self, entered: &'b Entered<S>) -> Curve<'b, S>
    where
        Sg: Store<Segment<S>>,
        Pa: Store<Path>,
        Ar: Store<Arc<S>>,
        No: Store<Node<S>>,
    {
        Curve {
            segments: self.segments.items(),
            paths: self.paths.items(),
            arcs: self.arcs.items(),
            nodes: self.nodes.items(),
            diagonal: &entered.diagonal,
            noise: &entered.noise,
        }
    }
}
