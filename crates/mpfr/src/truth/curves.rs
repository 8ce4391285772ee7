//! Cases of whole curves: a closed outline and an open wave beside it, through the door in both scalars.

use feature_sampling::bezier::Cubic;
use feature_sampling::curve::door::{DoorOptions, sine_of_degrees as sine};
use feature_sampling::curve::{CurveParam, contact, nearest as curve_nearest};
use feature_sampling::geometry::Point;
use feature_sampling::medial::walk::relevance;
use feature_sampling::medial::{Foot, Guard, Resolution, Side, tangent_disk, tangent_disk_beside};
use feature_sampling::model::{CurveModel, MedialModel};
use feature_sampling::sampling::chord::{chord_error as chord, piece_error_sq};
use feature_sampling::sampling::grading::{self, GapLimit};
use feature_sampling::sampling::run::{Pos, Run, RunEnd};
use feature_sampling::sampling::{Sample, SamplingOptions};
use feature_sampling::scalar::{Field, Scalar};
use num_traits::{One, Zero};

use super::input::{Gen, lift_cubic, lift_point};
use super::{Truth, lift, ulps};

/// The same drawing in both scalars.
struct Pair<S> {
    model: CurveModel<S>,
    truth: CurveModel<Truth>,
}

/// A closed spline through points around a centre (Catmull–Rom, hence smooth), and a wave below it.
fn drawing<S: Scalar>(g: &mut Gen) -> Vec<(bool, Vec<Cubic<S>>)> {
    let n = 5 + usize::try_from(g.below(3)).unwrap_or(0);
    let corners: Vec<[f64; 2]> = (0..n)
        .map(|i| {
            let (angle, r) = (std::f64::consts::TAU * i as f64 / n as f64, g.between(25.0, 45.0));
            [50.0 + r * angle.cos(), 50.0 + r * angle.sin()]
        })
        .collect();
    let at = |i: usize| corners[i % n];
    let along = |a: [f64; 2], b: [f64; 2], k: f64| [a[0] + k * b[0], a[1] + k * b[1]];
    let slope = |i: usize| [(at(i + 1)[0] - at(i + n - 1)[0]) / 6.0, (at(i + 1)[1] - at(i + n - 1)[1]) / 6.0];
    let point = |p: [f64; 2]| Point::new(S::from_f64(p[0]), S::from_f64(p[1]));
    let cubic = |p: [[f64; 2]; 4]| {
        let [a, b, c, d] = p.map(point);
        Cubic::new(a, b, c, d)
    };
    let outline = (0..n)
        .map(|i| cubic([at(i), along(at(i), slope(i), 1.0), along(at(i + 1), slope(i + 1), -1.0), at(i + 1)]))
        .collect();
    let (y, swing) = (g.between(105.0, 130.0), g.between(-30.0, 30.0));
    let wave = cubic([[0.0, y], [30.0, y + swing], [70.0, y - swing], [100.0, y + 3.0]]);
    vec![(true, outline), (false, vec![wave])]
}

fn model<S: Scalar>(paths: &[(bool, Vec<Cubic<S>>)]) -> CurveModel<S> {
    let borrowed: Vec<(bool, &[Cubic<S>])> = paths.iter().map(|(closed, cubics)| (*closed, &cubics[..])).collect();
    // These drawings are finite and not empty: the door refuses nothing else.
    CurveModel::new(&borrowed, &DoorOptions::default()).expect("a drawing that the door takes")
}

fn pair<S: Scalar>(g: &mut Gen) -> Pair<S> {
    let paths = drawing::<S>(g);
    let lifted: Vec<(bool, Vec<Cubic<Truth>>)> =
        paths.iter().map(|(closed, cubics)| (*closed, cubics.iter().map(lift_cubic).collect())).collect();
    Pair { model: model(&paths), truth: model(&lifted) }
}

impl<S: Scalar> Pair<S> {
    /// A place on the curve, in both scalars.
    fn place(&self, g: &mut Gen) -> (CurveParam<S>, CurveParam<Truth>) {
        let count = self.model.curve().segments.len() as u64;
        let (segment, t) = (u32::try_from(g.below(count)).unwrap_or(0), g.parameter::<S>());
        let lifted = CurveParam { segment, t: lift(&t) };
        (CurveParam { segment, t }, lifted)
    }

    fn size(&self) -> &Truth {
        self.truth.diagonal()
    }
}

/// Places tried on each drawing.
const PLACES: usize = 12;

/// The largest of several errors; a NaN wins.
fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, |w: f64, e| if e <= w { w } else { e })
}

/// Points and unit tangents of segments.
pub fn segment_point<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    worst((0..PLACES).map(|_| {
        let (at, known) = pair.place(g);
        let (curve, truth) = (pair.model.curve(), pair.truth.curve());
        match (curve.point(&at), truth.point(&known)) {
            (Some(f), Some(k)) => ulps(&f.x, &k.x, pair.size()).max(ulps(&f.y, &k.y, pair.size())),
            _ => f64::INFINITY,
        }
    }))
}

/// Unit tangents of segments, and how much arcs turn.
pub fn segment_tangent<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    worst((0..PLACES).map(|_| {
        let (at, known) = pair.place(g);
        match (curve.segment(at.segment), truth.segment(known.segment)) {
            (Some(f), Some(k)) => {
                let (f, k) = (f.tangent(&at.t), k.tangent(&known.t));
                ulps(&f.x, &k.x, &Truth::one()).max(ulps(&f.y, &k.y, &Truth::one()))
            }
            _ => f64::INFINITY,
        }
    }))
}

/// The diagonal.
pub fn diagonal<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    ulps(pair.model.diagonal(), pair.size(), pair.size())
}

/// How near is touching: this depends on the precision on purpose, so the true value is that of the formula.
pub fn contact_reach<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let known = (Truth::one() / &Truth::int(1_000_000_000)).max(lift(&S::unit_roundoff()).mul_pow2(3)) * pair.size();
    ulps(&contact::reach(&pair.model.curve()), &known, &known)
}

/// sin of an angle in degrees.
pub fn sine_of_degrees<S: Scalar>(g: &mut Gen) -> f64 {
    let angle = S::from_f64(g.between(0.0, 90.0));
    let known = sine(&lift(&angle));
    ulps(&sine(&angle), &known, &known)
}

/// A parameter taken back to the drawing.
pub fn source_parameter<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    worst((0..PLACES).map(|_| {
        let (at, known) = pair.place(g);
        ulps(&pair.model.source(&at).2, &pair.truth.source(&known).2, &Truth::one())
    }))
}

/// The box of an arc holds the arc, but for so much.
pub fn arc_bounds<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    worst((0..).map_while(|index| curve.arc(index)).map(|arc| {
        let (Some(segment), Some(exact)) = (curve.segment(arc.segment), truth.segment(arc.segment)) else {
            return f64::INFINITY;
        };
        let bounds = arc.bounds(segment);
        let t = g.unit();
        let s = lift(&arc.span[0]) + &((lift(&arc.span[1]) - &lift(&arc.span[0])) * &Truth::from_f64(t));
        let p = exact.power.eval(&s);
        let lifted = feature_sampling::geometry::Aabb { min: lift_point(&bounds.min), max: lift_point(&bounds.max) };
        let outside = lifted.distance_sq(&p).sqrt();
        ulps(&S::zero(), &outside, pair.size())
    }))
}

/// How much arcs turn.
pub fn arc_turning<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    worst((0..).map_while(|index| curve.arc(index)).map(|arc| {
        let (Some(segment), Some(exact)) = (curve.segment(arc.segment), truth.segment(arc.segment)) else {
            return f64::INFINITY;
        };
        let (u, w) = (exact.tangent(&lift(&arc.span[0])), exact.tangent(&lift(&arc.span[1])));
        ulps(&arc.turning(segment), &u.minus(&w).norm(), &Truth::one())
    }))
}

/// The distance of the closest point of the curve.
pub fn nearest<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    worst((0..PLACES).map(|_| {
        let q = Point::new(S::from_f64(g.between(0.0, 100.0)), S::from_f64(g.between(0.0, 130.0)));
        let found = curve_nearest::nearest(&curve, &q, S::infinity());
        let known = curve_nearest::nearest(&truth, &lift_point(&q), Truth::infinity());
        match (found, known) {
            (Some(f), Some(k)) => ulps(&f.distance_sq.sqrt(), &k.distance_sq.sqrt(), pair.size()),
            _ => f64::INFINITY,
        }
    }))
}

/// Radii of tangent disks, as curvatures in units of the diagonal.
///
/// Where the truth has a disk beyond the diagonal, both are half-planes to all that uses them.
fn disk_error<S: Scalar>(pair: &Pair<S>, found: &S, known: &Truth) -> f64 {
    let limit = pair.size();
    if known > limit {
        return if lift(found) > limit.clone().half() { 0.0 } else { f64::INFINITY };
    }
    ulps(found, known, known)
}

/// Radii of tangent disks.
pub fn disks<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    worst((0..PLACES).map(|_| {
        let (at, known) = pair.place(g);
        let side = if g.below(2) == 0 { Side::Left } else { Side::Right };
        match (Foot::normal(&curve, at, side), Foot::normal(&truth, known, side)) {
            (Some(f), Some(k)) => {
                let (found, known) = (tangent_disk(&curve, &f).radius, tangent_disk(&truth, &k).radius);
                disk_error(&pair, &found, &known)
            }
            _ => f64::INFINITY,
        }
    }))
}

/// Radii of a row of tangent disks, each found beside the one before.
pub fn disks_beside<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    let mut guard = Guard::new();
    worst((0..PLACES).map(|i| {
        let t = S::from_f64((i as f64 + 0.5) / PLACES as f64);
        let (at, known) = (CurveParam { segment: 0, t: t.clone() }, CurveParam { segment: 0, t: lift(&t) });
        match (Foot::normal(&curve, at, Side::Left), Foot::normal(&truth, known, Side::Left)) {
            (Some(f), Some(k)) => {
                let found = tangent_disk_beside(&curve, &f, &mut guard).radius;
                disk_error(&pair, &found, &tangent_disk(&truth, &k).radius)
            }
            _ => f64::INFINITY,
        }
    }))
}

/// Directions of feet.
pub fn foot<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    worst((0..PLACES).map(|_| {
        let (at, known) = pair.place(g);
        match (Foot::normal(&curve, at, Side::Left), Foot::normal(&truth, known, Side::Left)) {
            (Some(f), Some(k)) => ulps(&f.speed, &k.speed, pair.size())
                .max(ulps(&f.direction.x, &k.direction.x, &Truth::one()))
                .max(ulps(&f.direction.y, &k.direction.y, &Truth::one())),
            _ => f64::INFINITY,
        }
    }))
}

/// The bound of lfs over the whole curve.
pub fn relevance_bound<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let known = relevance(&pair.truth.curve());
    ulps(&relevance(&pair.model.curve()), &known, &known)
}

/// Steps a segment of the medial polylines that are compared.
const STEPS: u32 = 6;

/// lfs from the medial polylines at the same number of steps: all of the chain's rounding, none of its discretisation.
pub fn lfs<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let medial = MedialModel::new(&pair.model, &Resolution::Steps(STEPS));
    let known = MedialModel::new(&pair.truth, &Resolution::Steps(STEPS));
    worst((0..PLACES).map(|_| {
        let (at, place) = pair.place(g);
        match (pair.model.curve().point(&at), pair.truth.curve().point(&place)) {
            (Some(p), Some(q)) => ulps(&medial.lfs(&p), &known.lfs(&q), pair.size()),
            _ => f64::INFINITY,
        }
    }))
}

/// The distance to given polylines, without the chain before.
pub fn index_distance<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let medial = MedialModel::new(&pair.model, &Resolution::Steps(STEPS));
    let p = Point::new(S::from_f64(g.between(0.0, 100.0)), S::from_f64(g.between(0.0, 130.0)));
    let q = lift_point(&p);
    // The truth searches all edges, one by one.
    let mut known = Truth::infinity();
    let points = medial.points();
    for (i, a) in points.iter().enumerate() {
        let to = points.get(i + 1).filter(|b| b.polyline == a.polyline).unwrap_or(a);
        let edge = (lift_point(&a.centre), lift_point(&to.centre));
        known = known.min(feature_sampling::geometry::distance_sq_to_segment(&q, &edge.0, &edge.1).sqrt());
    }
    let size = pair.size().clone() + &known;
    ulps(&medial.index().distance(&p), &known, &size)
}

/// Samples: where they lie, with the same lfs on both sides' polylines. Counts that differ are no rounding.
pub fn samples<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let medial = MedialModel::new(&pair.model, &Resolution::Steps(STEPS));
    let known = MedialModel::new(&pair.truth, &Resolution::Steps(STEPS));
    // The open path: its samples follow each other from a fixed start.
    let found = pair.model.sample_path(&medial, 1, &SamplingOptions::default()).unwrap_or_default();
    let truth = pair.truth.sample_path(&known, 1, &SamplingOptions::default()).unwrap_or_default();
    if found.len() != truth.len() || found.is_empty() {
        return f64::INFINITY;
    }
    let errors = found.iter().zip(&truth);
    worst(errors.map(|(f, k)| ulps(&f.point.x, &k.point.x, pair.size()).max(ulps(&f.point.y, &k.point.y, pair.size()))))
}

/// A run over the open path.
fn run<'c, S: Scalar>(curve: &'c feature_sampling::curve::Curve<'c, S>) -> Run<'c, S> {
    let path = curve.paths[1];
    Run {
        curve,
        path,
        index: 1,
        first: 0,
        start: Pos { k: 0, t: S::zero() },
        end: Pos { k: path.count - 1, t: S::one() },
        ends: [RunEnd::Open, RunEnd::Open],
    }
}

/// Chord errors.
pub fn chord_error<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    let (run, known) = (run(&curve), run(&truth));
    let last = run.path.count - 1;
    worst((0..PLACES).map(|_| {
        let (s, t) = (g.parameter::<S>(), g.parameter::<S>());
        let (s, t) = if s < t { (s, t) } else { (t, s) };
        let (a, b) = (Pos { k: 0, t: s.clone() }, Pos { k: last, t: t.clone() });
        let found = chord(&run, &a, &b);
        let exact = chord(&known, &Pos { k: 0, t: lift(&s) }, &Pos { k: last, t: lift(&t) });
        ulps(&found, &exact, pair.size())
    }))
}

/// Chord error of one cubic.
pub fn piece_error<S: Scalar>(g: &mut Gen) -> f64 {
    let c = g.tame_cubic::<S>();
    let truth = lift_cubic(&c);
    let (s, t) = (g.parameter::<S>(), g.parameter::<S>());
    let (s, t) = if s < t { (s, t) } else { (t, s) };
    let (from, to) = (c.eval(&s), c.eval(&t));
    let found = piece_error_sq(&c.power_basis(), &s, &t, &from, &to).sqrt();
    let known = piece_error_sq(&truth.power_basis(), &lift(&s), &lift(&t), &lift_point(&from), &lift_point(&to)).sqrt();
    let size = truth.points.iter().fold(Truth::zero(), |m, p| m.max(p.x.clone().abs()).max(p.y.clone().abs()));
    ulps(&found, &known, &size)
}

/// The slope of the grading field.
pub fn grading_slope<S: Scalar>(g: &mut Gen) -> f64 {
    let (ratio, tighten) = (S::from_f64(g.between(1.01, 4.0)), S::from_f64(g.between(0.1, 1.0)));
    let known = grading::slope(&lift(&ratio), &lift(&tighten));
    // 1 − 1/g cancels where g is near 1.
    ulps(&grading::slope(&ratio, &tighten), &known, &Truth::one())
}

/// The grading field between limits that were smoothed.
pub fn grading_value<S: Scalar>(g: &mut Gen) -> f64 {
    let mut limits: Vec<GapLimit<S>> = (0..6)
        .map(|i| GapLimit { point: Point::new(S::int(10 * i), g.number()), at: (0, S::zero()), gap: g.positive() })
        .collect();
    let mut lifted: Vec<GapLimit<Truth>> = limits
        .iter()
        .map(|l| GapLimit { point: lift_point(&l.point), at: (0, Truth::zero()), gap: lift(&l.gap) })
        .collect();
    let slope = S::from_f64(g.between(0.05, 0.7));
    let (p, t) = (g.point::<S>(), lift(&slope));
    grading::smooth(&mut limits, false, &slope);
    grading::smooth(&mut lifted, false, &t);
    match (grading::value(&limits, 2, &p, &slope), grading::value(&lifted, 2, &lift_point(&p), &t)) {
        (Some(found), Some(known)) => ulps(&found, &known, &known),
        _ => f64::INFINITY,
    }
}

/// The largest ratio of neighbouring gaps.
pub fn grading_measure<S: Scalar>(g: &mut Gen) -> f64 {
    let points: Vec<Point<S>> = (0..6).map(|i| Point::new(S::int(10 * i), S::from_f64(g.between(0.0, 9.0)))).collect();
    let samples = |points: &[Point<S>]| -> Vec<Sample<S>> {
        points
            .iter()
            .map(|p| Sample {
                path: 0,
                at: CurveParam { segment: 0, t: S::zero() },
                point: p.clone(),
                lfs: S::one(),
                bound: feature_sampling::sampling::Bound::Epsilon,
            })
            .collect()
    };
    let lifted: Vec<Sample<Truth>> = points
        .iter()
        .map(|p| Sample {
            path: 0,
            at: CurveParam { segment: 0, t: Truth::zero() },
            point: lift_point(p),
            lfs: Truth::one(),
            bound: feature_sampling::sampling::Bound::Epsilon,
        })
        .collect();
    let known = grading::measure(&lifted, false);
    ulps(&grading::measure(&samples(&points), false), &known, &known)
}

/// Positions moved along a run.
pub fn run_advance<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    let (run, known) = (run(&curve), run(&truth));
    worst((0..PLACES).map(|_| {
        let (t, length) = (S::from_f64(g.between(0.0, 0.6)), S::from_f64(g.between(0.1, 5.0)));
        let found = run.advance(&Pos { k: 0, t: t.clone() }, &length);
        let exact = known.advance(&Pos { k: 0, t: lift(&t) }, &lift(&length));
        if found.k == exact.k { ulps(&found.t, &exact.t, &Truth::one()) } else { f64::INFINITY }
    }))
}

/// Positions between positions, and a number of parameters on.
pub fn run_between<S: Scalar>(g: &mut Gen) -> f64 {
    let pair = pair::<S>(g);
    let (curve, truth) = (pair.model.curve(), pair.truth.curve());
    let (run, known) = (run(&curve), run(&truth));
    let (a, b, at) = (S::from_f64(g.between(0.0, 0.5)), S::from_f64(g.between(0.5, 1.0)), g.parameter::<S>());
    let found = run.between(&Pos { k: 0, t: a.clone() }, &Pos { k: 0, t: b.clone() }, &at);
    let exact = known.between(&Pos { k: 0, t: lift(&a) }, &Pos { k: 0, t: lift(&b) }, &lift(&at));
    ulps(&found.t, &exact.t, &Truth::one())
}
