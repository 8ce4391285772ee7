//! lfs at single points, to nearly all digits: a judge for whatever claims a bound of it.
//!
//! The medial polylines of the kernel approximate M between their vertices. Here they only say where to look. Every point of M
//! is f + r(f, d)·d for a foot (f, d), so on each stretch of feet whose edge comes near to p, the distance |p − m(f, d)| is
//! minimised over the *feet*, by golden sections. Each value that this looks at is the distance to a point of M: the result
//! is **never below lfs(p)** by more than rounding of the scalar, however coarse the polylines. It *is* lfs(p), to about
//! half of the scalar's digits at a branch point and all of them elsewhere, where the polylines have an edge near the true
//! place: where no feature is missing from them altogether.
//!
//! So a claimed lower bound above the result is wrong, and a claimed upper bound below it is wrong unless a feature was
//! missed, which a finer tolerance shows. Cost: about a hundred tangent disks for each stretch looked at; in 128 bits, which
//! `feature-sampling-mpfr` brings, a few milliseconds.

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::{CurveError, DoorOptions, sine_of_degrees};
use feature_sampling::curve::{Curve, CurveParam, EndId};
use feature_sampling::geometry::{Point, Vector, distance_sq_to_segment};
use feature_sampling::medial::{Foot, MedialPoint, Resolution, Side, tangent_disk};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::scalar::Scalar;

/// Stretches that are looked at for one point, at most, nearest first: more are only near where M is nearly a point, as in a
/// circle, and all of them then give the same distance.
const STRETCHES: usize = 12;

/// Values on a stretch before golden sections begin.
const PROBES: i32 = 6;

/// A path: closed or not, and its cubics.
pub type Stroke = (bool, Vec<Cubic<f64>>);

/// A curve, and coarse medial polylines that say where to look.
#[derive(Debug)]
pub struct Oracle<S> {
    curve: CurveModel<S>,
    medial: MedialModel<S>,
    tolerance: f64,
    /// Centres as doubles, to sift quickly.
    centres: Vec<Point<f64>>,
}

/// What was found for a point.
#[derive(Clone, Debug)]
pub struct Found<S> {
    /// The least distance to a point of M that was looked at; infinite if there is none.
    pub lfs: S,
    /// That point of M.
    pub medial: Option<Point<S>>,
    /// What it is the medial point of.
    pub origin: Option<Origin<S>>,
    /// The distance to the coarse polylines.
    pub polylines: S,
}

/// What a point of M comes from: the same in every arithmetic, though the point is not.
#[derive(Clone, Debug)]
pub enum Origin<S> {
    /// A normal of the curve.
    Normal(CurveParam<S>, Side),
    /// A direction at an end.
    Fan(EndId, Vector<S>),
    /// The curve itself, at corners, crossings and cusps and along strokes that coincide.
    Curve(CurveParam<S>),
}

impl<S: Scalar> Origin<S> {
    /// The medial point of this on a curve; `None` if there is none within finite distance.
    pub fn medial_point(&self, curve: &Curve<'_, S>) -> Option<Point<S>> {
        let foot = match self {
            Self::Curve(at) => return curve.point(at),
            Self::Normal(at, side) => Foot::normal(curve, at.clone(), *side)?,
            Self::Fan(end, direction) => Foot::fan(curve, *end, into_cone(curve, *end, direction)?)?,
        };
        let radius = tangent_disk(curve, &foot).radius;
        radius.is_finite().then(|| foot.point.plus_scaled(&radius, &foot.direction))
    }

    /// Of a vertex of the polylines.
    fn of(vertex: &MedialPoint<S>) -> Option<Self> {
        Some(match vertex.side {
            Side::Corner => Self::Curve(vertex.at.clone()),
            Side::Fan => {
                let end = EndId::new(vertex.at.segment, usize::from(vertex.at.t > S::zero()));
                Self::Fan(end, vertex.centre.minus(&vertex.foot).unit()?)
            }
            side => Self::Normal(vertex.at.clone(), side),
        })
    }
}

/// A direction at an end that a rounding has moved out of the cone of feet, where no tangent disk is empty, put back on its verge.
fn into_cone<S: Scalar>(curve: &Curve<'_, S>, end: EndId, direction: &Vector<S>) -> Option<Vector<S>> {
    let mut branches = curve.joint(end).filter_map(|id| curve.end(id).map(|end| &end.leaving));
    branches.try_fold(direction.clone(), |d, branch| {
        let along = d.dot(branch);
        if along <= S::zero() { Some(d) } else { d.plus(&branch.scaled(&-along)).unit() }
    })
}

impl Origin<f64> {
    /// The same in another arithmetic; a direction is made a unit vector again.
    pub fn widened<T: Scalar>(&self) -> Option<Origin<T>> {
        let place = |at: &CurveParam<f64>| CurveParam { segment: at.segment, t: T::from_f64(at.t) };
        Some(match self {
            Self::Normal(at, side) => Origin::Normal(place(at), *side),
            Self::Fan(end, d) => Origin::Fan(*end, Vector::new(T::from_f64(d.x), T::from_f64(d.y)).unit()?),
            Self::Curve(at) => Origin::Curve(place(at)),
        })
    }
}

/// Feet between two neighbouring vertices of a polyline.
enum Stretch<S> {
    /// Normals to one side of a segment, from one parameter to another.
    Normals { segment: u32, side: Side, span: [S; 2] },
    /// Directions at an end.
    Fan { end: EndId, span: [Vector<S>; 2] },
    /// Points of the curve itself, along coinciding strokes.
    Curve { segment: u32, span: [S; 2] },
}

impl<S: Scalar> Oracle<S> {
    /// For a drawing; joints that turn by less than `corner_degrees` are smooth. `tolerance` is that of the polylines: 1e-4 is
    /// a good one.
    ///
    /// # Errors
    /// What the door has against the drawing.
    pub fn new(strokes: &[Stroke], corner_degrees: f64, tolerance: f64) -> Result<Self, CurveError> {
        let rounded = |c: &Cubic<f64>| Cubic { points: c.points.map(|p| Point::from_f64(p.x, p.y)) };
        let paths: Vec<(bool, Vec<Cubic<S>>)> =
            strokes.iter().map(|(closed, cubics)| (*closed, cubics.iter().map(rounded).collect())).collect();
        let borrowed: Vec<(bool, &[Cubic<S>])> = paths.iter().map(|(closed, cubics)| (*closed, &cubics[..])).collect();
        let corner_sine = sine_of_degrees(&S::from_f64(corner_degrees));
        let curve = CurveModel::new(&borrowed, &DoorOptions { corner_sine, ..DoorOptions::default() })?;
        let medial = MedialModel::new(&curve, &Resolution::Tolerance(S::from_f64(tolerance)));
        let centres = medial.points().iter().map(|m| Point::new(m.centre.x.to_f64(), m.centre.y.to_f64())).collect();
        Ok(Self { curve, medial, tolerance, centres })
    }

    /// The curve.
    pub const fn curve(&self) -> &CurveModel<S> {
        &self.curve
    }

    /// The coarse medial polylines.
    pub const fn medial(&self) -> &MedialModel<S> {
        &self.medial
    }

    /// lfs of a point of C.
    pub fn lfs(&self, p: &Point<S>) -> Found<S> {
        let polylines = self.medial.lfs(p);
        let mut best = Found { lfs: S::infinity(), medial: None, origin: None, polylines };
        for edge in self.near(p) {
            for vertex in [edge, edge + 1] {
                if let Some(vertex) = self.medial.points().get(vertex) {
                    best.offer(p, vertex.centre.clone(), || Origin::of(vertex));
                }
            }
            if let Some(stretch) = self.stretch(edge) {
                self.minimise(p, &stretch, &mut best);
            }
        }
        best
    }

    /// Edges (by their first vertex) that may be nearest to p but for the tolerance, nearest first.
    fn near(&self, p: &Point<S>) -> Vec<usize> {
        let (p, points) = (Point::new(p.x.to_f64(), p.y.to_f64()), self.medial.points());
        let distances: Vec<f64> = (0..points.len())
            .map(|i| {
                let joined = points.get(i + 1).is_some_and(|next| next.polyline == points[i].polyline);
                let end = if joined { i + 1 } else { i };
                distance_sq_to_segment(&p, &self.centres[i], &self.centres[end])
            })
            .collect();
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        // The polylines are a target and no bound: sixteen times their tolerance (of lengths; these are squares).
        let limit = least * (1.0 + 32.0 * self.tolerance) + f64::MIN_POSITIVE;
        let mut edges: Vec<(f64, usize)> =
            distances.into_iter().zip(0..).filter(|(distance, _)| *distance <= limit).collect();
        edges.sort_by(|a, b| a.0.total_cmp(&b.0));
        let taken = edges.iter().take(STRETCHES);
        let mut chosen: Vec<usize> = taken.map(|(_, i)| *i).collect();
        // The least distance may lie just beyond a vertex of the nearest edge; near any other edge its neighbour is taken too.
        if let Some(&i) = chosen.first() {
            chosen.extend([i.checked_sub(1), Some(i + 1)].into_iter().flatten());
        }
        // Nearest first: what is found there spares the others.
        let mut known = std::collections::BTreeSet::new();
        chosen.retain(|i| known.insert(*i));
        chosen
    }

    /// The feet of an edge; `None` where two vertices have nothing between them that is known.
    fn stretch(&self, edge: usize) -> Option<Stretch<S>> {
        let (a, b) = (self.medial.points().get(edge)?, self.medial.points().get(edge + 1)?);
        if a.polyline != b.polyline {
            return None;
        }
        match (a.side, b.side) {
            (_, Side::Fan) => {
                let end = EndId::new(b.at.segment, usize::from(b.at.t > S::zero()));
                let span = [a.centre.minus(&a.foot).unit()?, b.centre.minus(&b.foot).unit()?];
                Some(Stretch::Fan { end, span })
            }
            (Side::Corner, Side::Corner) => {
                let span = [a.at.t.clone(), b.at.t.clone()];
                (a.at.segment == b.at.segment).then_some(Stretch::Curve { segment: a.at.segment, span })
            }
            (_, Side::Left | Side::Right) => self.normals(a, b, b.side),
            (Side::Left | Side::Right, Side::Corner) => self.normals(b, a, a.side).map(Stretch::reversed),
            (Side::Fan, Side::Corner) => None,
        }
    }

    /// From whatever precedes it to a vertex on a normal: from another segment, a fan or a corner the walk comes by the end
    /// that the foot of that vertex lies on.
    fn normals(&self, from: &MedialPoint<S>, to: &MedialPoint<S>, side: Side) -> Option<Stretch<S>> {
        let segment = to.at.segment;
        let start = if from.at.segment == segment && from.side != Side::Fan {
            from.at.t.clone()
        } else {
            let ends = [S::zero(), S::one()];
            let near = self.curve.diagonal().clone().mul_pow2(-24);
            let curve = self.curve.curve();
            ends.into_iter().find(|t| {
                let at = CurveParam { segment, t: t.clone() };
                curve.point(&at).is_some_and(|p| p.distance(&from.foot) <= near)
            })?
        };
        Some(Stretch::Normals { segment, side, span: [start, to.at.t.clone()] })
    }

    /// What a medial point of the stretch comes from; s runs from 0 to 1.
    fn origin(stretch: &Stretch<S>, s: &S) -> Option<Origin<S>> {
        let place = |segment: u32, span: &[S; 2]| {
            let t = (span[1].clone() - &span[0]) * s + &span[0];
            CurveParam { segment, t }
        };
        Some(match stretch {
            Stretch::Curve { segment, span } => Origin::Curve(place(*segment, span)),
            Stretch::Normals { segment, side, span } => Origin::Normal(place(*segment, span), *side),
            Stretch::Fan { end, span } => {
                Origin::Fan(*end, span[0].scaled(&(S::one() - s)).plus(&span[1].scaled(s)).unit()?)
            }
        })
    }

    /// Offers the medial points of a stretch, down to the nearest one.
    fn minimise(&self, p: &Point<S>, stretch: &Stretch<S>, best: &mut Found<S>) {
        let at = |i: i32| S::ratio(i.clamp(0, PROBES), PROBES);
        let curve = self.curve.curve();
        let medial = |s: &S| {
            let origin = Self::origin(stretch, s)?;
            Some((origin.medial_point(&curve)?, origin))
        };
        let (mut least, mut reach) = ((0, S::infinity()), S::zero());
        let mut before: Option<Point<S>> = None;
        for i in 0..=PROBES {
            let Some((m, origin)) = medial(&at(i)) else { continue };
            let distance = m.distance(p);
            if let Some(before) = before.replace(m.clone()) {
                reach = reach.max(before.distance(&m));
            }
            best.offer(p, m, || Some(origin));
            if distance < least.1 {
                least = (i, distance);
            }
        }
        let (least, distance) = least;
        // Between two probes the distance can hardly fall by more than they are apart.
        if distance - &reach > best.lfs {
            return;
        }
        let mut value = |s: &S| match medial(s) {
            Some((m, origin)) => {
                let distance = m.distance(p);
                best.offer(p, m, || Some(origin));
                distance
            }
            None => S::infinity(),
        };
        let (mut lo, mut hi) = (at(least - 1), at(least + 1));
        // (√5 − 1)/2
        let golden = (S::int(5).sqrt() - S::one()).half();
        let inner = |lo: &S, hi: &S, share: &S| (hi.clone() - lo) * share + lo;
        let other = S::one() - &golden;
        let (mut left, mut right) = (inner(&lo, &hi, &other), inner(&lo, &hi, &golden));
        let (mut at_left, mut at_right) = (value(&left), value(&right));
        // Each turn leaves 0.618 of the bracket; half the digits of s are all the digits of a smooth minimum.
        for _ in 0..(S::BITS * 3 / 4) {
            if at_left <= at_right {
                hi = right;
                right = left;
                at_right = at_left;
                left = inner(&lo, &hi, &other);
                at_left = value(&left);
            } else {
                lo = left;
                left = right;
                at_left = at_right;
                right = inner(&lo, &hi, &golden);
                at_right = value(&right);
            }
        }
    }
}

impl<S: Scalar> Stretch<S> {
    fn reversed(self) -> Self {
        match self {
            Self::Normals { segment, side, span: [a, b] } => Self::Normals { segment, side, span: [b, a] },
            Self::Fan { end, span: [a, b] } => Self::Fan { end, span: [b, a] },
            Self::Curve { segment, span: [a, b] } => Self::Curve { segment, span: [b, a] },
        }
    }
}

impl<S: Scalar> Found<S> {
    fn offer(&mut self, p: &Point<S>, medial: Point<S>, origin: impl FnOnce() -> Option<Origin<S>>) {
        let distance = medial.distance(p);
        if distance < self.lfs {
            self.lfs = distance;
            self.medial = Some(medial);
            self.origin = origin();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(a: [f64; 2], b: [f64; 2]) -> Stroke {
        (false, vec![Cubic::line(Point::new(a[0], a[1]), Point::new(b[0], b[1]))])
    }

    /// A line, and a stroke that ends one above it: beside it the medial axis is the parabola y = (x² + 1)/2.
    fn end_above_a_line() -> Vec<Stroke> {
        vec![line([-10.0, 0.0], [10.0, 0.0]), line([0.0, 1.0], [0.0, 6.0])]
    }

    /// Distance of (x, 0) from that parabola: its nearest point has u³ + 3u = 2x.
    fn known<S: Scalar>(x: &S) -> S {
        let mut u = x.clone();
        for _ in 0..64 {
            let value = u.clone().square() * &u + &(u.clone() * &S::int(3)) - &x.clone().twice();
            let slope = (u.clone().square() + &S::one()) * &S::int(3);
            u = u - &(value / &slope);
        }
        let y = (u.clone().square() + &S::one()).half();
        ((u - x).square() + &y.square()).sqrt()
    }

    #[test]
    fn all_digits_where_the_axis_is_curved() {
        let oracle = Oracle::<f64>::new(&end_above_a_line(), 1.0, 1e-3).expect("a curve");
        let mut coarse = 0.0_f64;
        for i in 0..=20 {
            let x = f64::from(i) / 7.0 - 1.0;
            let (found, truth) = (oracle.lfs(&Point::new(x, 0.0)), known(&x));
            assert!((found.lfs / truth - 1.0).abs() < 1e-14, "{x}: {} {truth}", found.lfs);
            coarse = coarse.max((found.polylines / truth - 1.0).abs());
        }
        assert!(coarse > 1e-7, "the polylines alone are not enough: {coarse}");
    }

    #[test]
    fn the_polylines_do_not_matter() {
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings/leaf_01.svg");
        let drawing = lineart::drawing::load(&file).expect("a drawing that comes with the program");
        let strokes: Vec<Stroke> = drawing.paths.into_iter().map(|path| (path.closed, path.cubics)).collect();
        let fine = Oracle::<f64>::new(&strokes, 1.0, 1e-5).expect("a curve");
        let coarse = Oracle::<f64>::new(&strokes, 1.0, 1e-3).expect("a curve");
        for cubic in strokes.iter().flat_map(|stroke| &stroke.1) {
            let p = cubic.eval(&0.3);
            let (a, b) = (fine.lfs(&p), coarse.lfs(&p));
            assert!((a.lfs / b.lfs - 1.0).abs() < 1e-12, "{p:?}: {} {}", a.lfs, b.lfs);
            assert!((b.polylines / b.lfs - 1.0).abs() < 4e-3, "{p:?}: {} {}", b.polylines, b.lfs);
        }
    }
}
